//! What numbers may be that texts write.

mod jumping;

use super::*;

/// Number `a` is 0, and so on; each write is a text.
fn value<W: AsRef<str>>(numbers: &Numbers<W>, number: u32) -> Quantity {
    numbers.value(number, &|text, of| {
        evaluated(
            Arithmetic::Real,
            text.as_ref().as_bytes(),
            &mut |operand| match operand {
                Operand::Name([letter]) => Some(of(u32::from(letter - b'a'))),
                Operand::Name(_) => Some(Quantity::unknown()),
                Operand::Other(_) => None,
            },
        )
    })
}

#[test]
fn what_is_written_once_is_known_and_what_several_write_is_between_them() {
    let mut numbers = Numbers::default();
    numbers.write(0, "40", None);
    numbers.write(1, "a/4", None);
    numbers.write(2, "a", None);
    numbers.write(2, "b", Some(Blocks::default().site()));
    numbers.write(3, "a", None);
    numbers.lose(3);
    assert_eq!(value(&numbers, 1).exact(), Some(10.0));
    assert_eq!(value(&numbers, 2).ends(), Some((10.0, 40.0)));
    assert!(value(&numbers, 3).unknown.is_some());
    assert_eq!(value(&numbers, 4), Quantity::unknown());
}

#[test]
fn what_is_added_counts_as_often_as_the_loops_behind_what_sets_it_anew() {
    let grown = |inside: &dyn Fn(&mut Blocks), jumps: bool| {
        let (mut numbers, mut blocks) = (Numbers::default(), Blocks::default());
        blocks.begin(7);
        numbers.write(0, "0", None);
        numbers.write(0, "0", Some(blocks.site()));
        inside(&mut blocks);
        numbers.write(0, "a+40", Some(blocks.site()));
        if jumps {
            numbers.jumps(7);
        }
        value(&numbers, 0)
    };
    let counted = grown(&|blocks| blocks.open(Some(10)), false);
    assert_eq!(counted, Quantity::counted(0.0, 40.0, Some(10)));
    let nested = |blocks: &mut Blocks| {
        blocks.open(Some(3));
        blocks.open(Some(1));
        blocks.branch();
        blocks.open(Some(4));
    };
    assert_eq!(grown(&nested, false).ends(), Some((0.0, 480.0)));
    let endless = Quantity::counted(0.0, 40.0, None);
    assert_eq!(grown(&nested, true), endless);
    assert_eq!(grown(&|blocks| blocks.open(None), false), endless);
    // elsewhere: nothing says how often
    assert_eq!(grown(&|blocks| blocks.begin(8), false), endless);
    assert_eq!(grown(&|_| (), false), Quantity::counted(0.0, 40.0, Some(1)));
}

#[test]
fn a_routine_that_calls_itself_adds_any_number_of_times() {
    let grown = |calls: &[(u32, u32)]| {
        let (mut numbers, mut blocks) = (Numbers::default(), Blocks::default());
        blocks.begin(7);
        numbers.write(0, "0", Some(blocks.site()));
        numbers.write(0, "a-4", Some(blocks.site()));
        for &(caller, callee) in calls {
            numbers.calls(caller, callee);
        }
        value(&numbers, 0).ends()
    };
    assert_eq!(grown(&[(7, 8)]), Some((-4.0, 0.0)));
    assert_eq!(grown(&[(7, 7)]), None);
    assert_eq!(grown(&[(7, 8), (8, 9), (9, 7)]), None);
}

#[test]
fn loops_run_as_often_as_their_counter_passes_the_end() {
    assert_eq!(rounds(1.0, 10.0, 2.0), Some(5));
    assert_eq!(rounds(5.0, 1.0, 1.0), Some(1));
    // four in single precision
    assert_eq!(rounds(0.0, 0.3, 0.1), Some(4));
    assert_eq!(rounds(0.0, 1.0, 0.0), None);
    assert_eq!(rounds(0.0, 1.0, 1e-300), None);
    assert_eq!(rounds(1.0, 2e6, 1.0), None);
}

#[test]
fn what_a_function_makes_of_a_number_itself_may_add_up() {
    let mut numbers = Numbers::default();
    numbers.write(0, "0", None);
    numbers.write(0, "Round(a-5)", Some(Blocks::default().site()));
    numbers.write(1, "Round(c)", None);
    numbers.write(2, "3", None);
    numbers.write(3, "c{a}", None);
    assert!(value(&numbers, 0).is_endless());
    assert_eq!(value(&numbers, 1).exact(), Some(3.0));
    assert_eq!(value(&numbers, 3).exact(), Some(3.0));
    // an element may be any
    numbers.write(4, "[[0,-c],[7,5]]", None);
    numbers.write(5, "e{1,2}+1", None);
    assert_eq!(value(&numbers, 5).ends(), Some((-2.0, 8.0)));
}

#[test]
fn calls_inside_calls_are_followed_to_a_depth() {
    let nested = |depth: usize| "abs(".repeat(depth) + "-3" + &")".repeat(depth);
    let (few, many) = (nested(5), nested(20_000));
    let mut numbers = Numbers::default();
    numbers.write(0, &*few, None);
    numbers.write(1, &*many, None);
    assert_eq!(value(&numbers, 0).exact(), Some(3.0));
    assert!(value(&numbers, 1).is_endless());
}

#[test]
fn what_is_set_in_one_branch_is_not_set_in_the_other() {
    let (mut numbers, mut blocks) = (Numbers::default(), Blocks::default());
    blocks.open(Some(1));
    numbers.write(0, "0", Some(blocks.site()));
    blocks.branch();
    numbers.write(0, "a-5", Some(blocks.site()));
    assert_eq!(value(&numbers, 0), Quantity::counted(0.0, -5.0, None));
}

#[test]
fn circles_and_growth_by_what_nobody_knows_have_no_bound() {
    let mut numbers = Numbers::default();
    numbers.write(0, "b+1", None);
    numbers.write(1, "a+1", None);
    numbers.write(2, "c+camera", Some(Blocks::default().site()));
    numbers.write(3, "2*d", None);
    for number in 0..4 {
        assert!(value(&numbers, number).is_endless(), "{number}");
    }
    numbers.write(4, "1", None);
    numbers.write(4, "-e", None);
    assert_eq!(value(&numbers, 4).ends(), Some((-1.0, 1.0)));
}

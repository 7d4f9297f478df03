//! Numbers that add up between labels, against programs that are run.

use super::super::bounds::Relation;
use super::*;
use proptest::prelude::*;

/// A statement of a routine that goes from label to label, with numbers 0 and 1.
#[derive(Clone, Debug)]
enum Op {
    Set(u32, i32),
    Add(u32, i32),
    Label(u64),
    /// To a label where a number is to a limit as given; always, or as an input says, where there is
    /// none.
    Jump(u64, Option<(u32, Relation, i32)>, bool),
    /// Statements that are run where a number is to a limit as given.
    If(u32, Relation, i32),
    Else,
    EndIf,
    /// A loop that begins again as long as a number is to a limit as given.
    While(u32, Relation, i32),
    EndWhile,
    /// A loop that ends where it is.
    Repeat,
    Until(u32, Relation, i32),
    /// Behind the innermost loop.
    Leave,
    End,
}

fn is_so(relation: Relation, value: i32, limit: i32) -> bool {
    match relation {
        Relation::Below { is_strict: true } => value < limit,
        Relation::Below { is_strict: false } => value <= limit,
        Relation::Above { is_strict: true } => value > limit,
        Relation::Above { is_strict: false } => value >= limit,
        Relation::Equal => value == limit,
        Relation::NotEqual => value != limit,
    }
}

fn relation() -> impl Strategy<Value = Relation> + Clone {
    prop_oneof![
        any::<bool>().prop_map(|is_strict| Relation::Below { is_strict }),
        any::<bool>().prop_map(|is_strict| Relation::Above { is_strict }),
        Just(Relation::Equal),
        Just(Relation::NotEqual),
    ]
}

fn op() -> impl Strategy<Value = Op> {
    let condition = (0..2_u32, relation(), -3..7_i32);
    prop_oneof![
        2 => (0..2_u32, -1..3_i32).prop_map(|(number, to)| Op::Set(number, to)),
        4 => (0..2_u32, prop_oneof![Just(1), Just(2), Just(-1)]).prop_map(|(n, by)| Op::Add(n, by)),
        3 => (0..4_u64).prop_map(Op::Label),
        4 => (0..4_u64, proptest::option::weighted(0.8, condition.clone()), any::<bool>())
            .prop_map(|(to, condition, may)| Op::Jump(to, condition, may)),
        2 => condition.clone().prop_map(|(number, relation, limit)| Op::If(number, relation, limit)),
        1 => Just(Op::Else),
        2 => Just(Op::EndIf),
        1 => condition.clone().prop_map(|(n, relation, limit)| Op::While(n, relation, limit)),
        1 => Just(Op::EndWhile),
        1 => Just(Op::Repeat),
        1 => condition.prop_map(|(n, relation, limit)| Op::Until(n, relation, limit)),
        1 => Just(Op::Leave),
        1 => Just(Op::End),
    ]
}

/// Each label once, ELSE once in its IF, blocks inside each other and ended.
fn tidy(ops: Vec<Op>) -> Vec<Op> {
    let (mut labels, mut open, mut tidied) = (Vec::new(), Vec::<Op>::new(), Vec::new());
    for op in ops {
        let inner = open.last();
        let fits = match &op {
            Op::Label(key) => !labels.contains(key),
            Op::Else => matches!(inner, Some(Op::If(..))),
            Op::EndIf => matches!(inner, Some(Op::If(..) | Op::Else)),
            Op::EndWhile => matches!(inner, Some(Op::While(..))),
            Op::Until(..) => matches!(inner, Some(Op::Repeat)),
            Op::Leave => open
                .iter()
                .any(|op| matches!(op, Op::While(..) | Op::Repeat)),
            _ => true,
        };
        if !fits {
            continue;
        }
        match &op {
            Op::Label(key) => labels.push(*key),
            Op::If(..) | Op::While(..) | Op::Repeat => open.push(op.clone()),
            Op::Else => *open.last_mut().expect("an IF") = Op::Else,
            Op::EndIf | Op::EndWhile | Op::Until(..) => _ = open.pop(),
            _ => {}
        }
        tidied.push(op);
    }
    let ends = open.iter().rev().map(|op| match op {
        Op::While(..) => Op::EndWhile,
        Op::Repeat => Op::Until(0, Relation::Equal, 0),
        _ => Op::EndIf,
    });
    tidied.extend(ends);
    tidied
}

/// Notes a condition that holds on an edge, and (`both`) not on the other one of its step.
fn note_on(
    numbers: &mut Numbers<String>,
    (step, is_next): (u32, bool),
    (number, relation, limit): (u32, Relation, i32),
    both: bool,
) {
    let limit = format!("{limit}");
    numbers.check(7, (step, is_next), number, (relation, limit.clone()));
    if both {
        let contrary = (relation.negated(), limit);
        numbers.check(7, (step, !is_next), number, contrary);
    }
}

fn note(numbers: &mut Numbers<String>, edge: (u32, bool), condition: (u32, Relation, i32)) {
    note_on(numbers, edge, condition, true);
}

fn read(ops: &[Op]) -> Numbers<String> {
    let (mut numbers, mut blocks) = (Numbers::default(), Blocks::default());
    let name = |number: &u32| ["a", "b"][*number as usize];
    for number in 0..2 {
        numbers.write(number, "0".into(), None);
    }
    blocks.begin(7);
    numbers.jumps(7);
    for op in ops {
        match op {
            Op::Set(number, to) => {
                numbers.write(*number, format!("{to}"), Some(blocks.site()));
            }
            Op::Add(number, by) => {
                let text = format!("{}+({by})", name(number));
                numbers.write(*number, text, Some(blocks.site()));
            }
            Op::Label(key) => blocks.flow.label(*key),
            Op::Jump(key, condition, may) => {
                let step = blocks.flow.jump(*key, condition.is_some() || *may);
                if let Some(condition) = *condition {
                    // an input may keep it from being made
                    let both = !may;
                    note_on(&mut numbers, (step, false), condition, both);
                }
            }
            Op::If(number, relation, limit) => {
                let step = blocks.open_branch();
                note(&mut numbers, (step, true), (*number, *relation, *limit));
            }
            Op::Else => blocks.branch(),
            Op::EndIf | Op::EndWhile => blocks.close(),
            Op::While(number, relation, limit) => {
                let step = blocks.open_loop(None);
                note(&mut numbers, (step, true), (*number, *relation, *limit));
            }
            Op::Repeat => _ = blocks.open_loop(None),
            Op::Until(number, relation, limit) => {
                let step = blocks.close_or_repeat().expect("a loop");
                note(&mut numbers, (step, true), (*number, *relation, *limit));
            }
            Op::Leave => blocks.flow.leave(),
            Op::End => blocks.flow.stop(),
        }
    }
    numbers.goes(7, std::mem::take(&mut blocks.flow));
    numbers
}

fn begins(op: &Op) -> bool {
    matches!(op, Op::If(..) | Op::While(..) | Op::Repeat)
}

fn ends(op: &Op) -> bool {
    matches!(op, Op::EndIf | Op::EndWhile | Op::Until(..))
}

/// Where the block ends in which a statement stands, or its ELSE.
fn end_of(ops: &[Op], at: usize, or_else: bool) -> usize {
    let mut depth = 0;
    let end = ops[at..].iter().position(|op| {
        if depth == 0 && (ends(op) || or_else && matches!(op, Op::Else)) {
            return true;
        }
        depth += i32::from(begins(op)) - i32::from(ends(op));
        false
    });
    end.map_or(ops.len(), |end| at + end)
}

/// Where the block begins that ends there.
fn start_of(ops: &[Op], end: usize) -> usize {
    let mut depth = 0;
    let start = ops[..end].iter().rposition(|op| {
        if depth == 0 && begins(op) {
            return true;
        }
        depth += i32::from(ends(op)) - i32::from(begins(op));
        false
    });
    start.expect("blocks are tidy")
}

/// Behind the innermost loop.
fn behind_loop(ops: &[Op], mut at: usize) -> usize {
    loop {
        let end = end_of(ops, at, false);
        match ops.get(end) {
            Some(Op::EndIf) => at = end + 1,
            _ => return end + 1,
        }
    }
}

/// Runs the routine again and again, and hands over all that its numbers are.
fn run(ops: &[Op], inputs: &[bool]) -> [Vec<i32>; 2] {
    let mut values = [0; 2];
    let mut seen = [vec![0], vec![0]];
    let (mut at, mut inputs) = (0, inputs.iter().cycle());
    for _ in 0..400 {
        let Some(op) = ops.get(at) else {
            at = 0;
            continue;
        };
        at += 1;
        match op {
            Op::Set(number, to) => values[*number as usize] = *to,
            Op::Add(number, by) => values[*number as usize] += by,
            Op::Jump(key, condition, may) => {
                let holds = condition.is_none_or(|(number, relation, limit)| {
                    is_so(relation, values[number as usize], limit)
                });
                let is_made = holds && (!may || *inputs.next().expect("endless"));
                if is_made {
                    let label = |op: &Op| matches!(op, Op::Label(label) if label == key);
                    at = ops.iter().position(label).unwrap_or(ops.len());
                }
            }
            Op::If(number, relation, limit) => {
                if !is_so(*relation, values[*number as usize], *limit) {
                    at = end_of(ops, at, true) + 1;
                }
            }
            Op::Else => at = end_of(ops, at, false) + 1,
            Op::While(number, relation, limit) => {
                if !is_so(*relation, values[*number as usize], *limit) {
                    at = end_of(ops, at, false) + 1;
                }
            }
            Op::EndWhile => at = start_of(ops, at - 1),
            Op::Until(number, relation, limit) => {
                if !is_so(*relation, values[*number as usize], *limit) {
                    at = start_of(ops, at - 1);
                }
            }
            Op::Leave => at = behind_loop(ops, at),
            Op::End => at = ops.len(),
            Op::Label(_) | Op::EndIf | Op::Repeat => {}
        }
        for (seen, value) in seen.iter_mut().zip(values) {
            seen.push(value);
        }
    }
    seen
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(20_000))]

    /// Whatever a program does its numbers are among what is said of them.
    #[test]
    fn numbers_are_what_the_program_makes_of_them(
        ops in proptest::collection::vec(op(), 1..18),
        inputs in proptest::collection::vec(any::<bool>(), 7),
    ) {
        let ops = tidy(ops);
        let numbers = read(&ops);
        for (number, seen) in (0..).zip(run(&ops, &inputs)) {
            let Some((least, greatest)) = value(&numbers, number).ends() else {
                continue;
            };
            for value in seen {
                let is_within = f64::from(value) >= least && f64::from(value) <= greatest;
                prop_assert!(is_within, "{} in {least} to {greatest}: {ops:?}", value);
            }
        }
    }
}

const BELOW: Relation = Relation::Below { is_strict: true };
const AT_LEAST: Relation = Relation::Above { is_strict: false };

/// A routine, and from where to where its number 0 is.
type Case<'a> = (&'a [Op], Option<(f64, f64)>);

#[test]
fn conditions_bound_what_adds_up_between_labels() {
    use Op::{Add, EndIf, If, Jump, Label, Set};
    let cases: Vec<Case> = vec![
        // behind what is repeated
        (
            &[
                Set(0, 0),
                Label(1),
                Add(0, 1),
                Jump(1, Some((0, BELOW, 4)), false),
            ],
            Some((0.0, 4.0)),
        ),
        // before it
        (
            &[
                Set(0, 0),
                Label(1),
                Jump(2, Some((0, AT_LEAST, 4)), false),
                Add(0, 1),
                Jump(1, None, false),
                Label(2),
            ],
            Some((0.0, 4.0)),
        ),
        (
            &[
                Set(0, 0),
                Label(1),
                Add(0, 2),
                Jump(1, Some((0, Relation::NotEqual, 4)), false),
            ],
            Some((0.0, 4.0)),
        ),
        // passes the limit by
        (
            &[
                Set(0, 0),
                Label(1),
                Add(0, 2),
                Jump(1, Some((0, Relation::NotEqual, 5)), false),
            ],
            None,
        ),
        // each time anew
        (
            &[Label(1), Set(0, 0), Add(0, 1), Jump(1, None, false)],
            Some((0.0, 1.0)),
        ),
        // begins anew where it comes to its end
        (
            &[
                Set(0, 0),
                Label(1),
                Add(0, 1),
                If(0, AT_LEAST, 4),
                Set(0, 0),
                EndIf,
                Jump(1, None, false),
            ],
            Some((0.0, 4.0)),
        ),
        // another number counts along
        (
            &[
                Set(0, 0),
                Set(1, 0),
                Label(1),
                Add(0, 2),
                Add(1, 1),
                Jump(1, Some((1, BELOW, 4)), false),
            ],
            Some((0.0, 8.0)),
        ),
        // that begins anew on the way
        (
            &[
                Set(0, 0),
                Label(2),
                Set(1, 0),
                Label(1),
                Add(0, 2),
                Add(1, 1),
                Jump(1, Some((1, BELOW, 4)), false),
                Jump(2, None, true),
            ],
            None,
        ),
        // nothing sets it anew when the routine runs next
        (
            &[Label(1), Add(0, 1), Jump(1, Some((0, BELOW, 4)), false)],
            None,
        ),
    ];
    for (ops, wanted) in cases {
        assert_eq!(value(&read(ops), 0).ends(), wanted, "{ops:?}");
    }
}

#[test]
fn what_takes_too_much_work_has_no_bound() {
    let ops = |count: u32| {
        let grow = (0..count).map(|_| Op::Add(0, 1));
        let all = [Op::Set(0, 0), Op::Label(1)].into_iter().chain(grow);
        all.chain([Op::Jump(1, Some((0, BELOW, 4)), false)])
            .collect::<Vec<Op>>()
    };
    assert_eq!(value(&read(&ops(1)), 0).ends(), Some((0.0, 4.0)));
    // once nothing is left
    let numbers = read(&ops(1));
    numbers.work_left.set(2);
    assert_eq!(value(&numbers, 0).ends(), None);
    // several places
    assert_eq!(value(&read(&ops(2)), 0).ends(), None);
}

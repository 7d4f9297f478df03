//! What sums and products come to.

use super::*;

/// `i` counts 0 to 9, `e` grows by 40, `c` is 5, `x` nobody knows.
fn value(text: &str) -> Option<Quantity> {
    evaluate(text.as_bytes(), &mut |name| match name {
        b"i" => Quantity::counted(0.0, 1.0, Some(9)),
        b"e" => Quantity::counted(0.0, 40.0, None),
        b"c" => Quantity::exactly(5.0),
        b"me" => Quantity::own(),
        _ => Quantity::unknown(),
    })
}

#[test]
fn numbers_and_constants_are_computed() {
    for (text, expected) in [
        ("3", 3.0),
        ("-c*4+2", -18.0),
        ("2*(c-1)/4", 2.0),
        ("- -c", 5.0),
        ("17 DIV c", 3.0),
        ("0*x", 0.0),
    ] {
        assert_eq!(
            value(text).and_then(|q| q.exact()),
            Some(expected),
            "{text}"
        );
    }
    for text in ["", "3 4", "(3", "3)", "c c", "\"a\"", "3+", "2^3", "0x10"] {
        assert_eq!(value(text), None, "{text}");
    }
}

#[test]
fn what_is_counted_has_ends() {
    let ends = |text: &str| value(text).and_then(|q| q.ends());
    for (text, expected) in [
        ("-i*40", (-360.0, 0.0)),
        ("(i-1)*c", (-5.0, 40.0)),
        ("i*i", (0.0, 81.0)),
        ("i*40-i*10", (-90.0, 360.0)),
        ("40/(i+1)", (4.0, 40.0)),
        ("(i MOD 4)*10", (0.0, 30.0)),
        ("(-i) % 3", (-2.0, 2.0)),
        ("(i*0.5) MOD 4", (0.0, 4.0)),
        ("i div 4", (0.0, 2.25)),
    ] {
        let found = ends(text).expect(text);
        assert!((found.0 - expected.0).abs() < 1e-9, "{text}: {found:?}");
        assert!((found.1 - expected.1).abs() < 1e-9, "{text}: {found:?}");
    }
    assert_eq!(
        value("20-i*40"),
        Some(Quantity::counted(20.0, -40.0, Some(9)))
    );
    assert_eq!(value("c-e"), Some(Quantity::counted(5.0, -40.0, None)));
    assert_eq!(value("i*40").and_then(|q| q.exact()), None);
}

#[test]
fn numbers_of_the_text_are_the_least_that_a_product_comes_to() {
    let of_text = |text: &str| value(text).map(|q| q.of_text());
    for (text, expected) in [
        ("x", 0.0),
        ("x*y", 0.0),
        ("-x*40", 40.0),
        ("x*c*2", 10.0),
        ("x/2", 0.5),
        ("(x-3)*40", 40.0),
        ("(x-3)*y", 3.0),
        ("x*i*10", 90.0),
        ("Abs(x)*40", 40.0),
        ("x*40+y*10", 50.0),
        ("40/x", 40.0),
        ("p{i}.z*20", 20.0),
    ] {
        assert!(
            (of_text(text).expect(text) - expected).abs() < 1e-9,
            "{text}"
        );
    }
    assert_eq!(
        value("c*x+3").map(|q| (q.first, q.of_text())),
        Some((3.0, 5.0))
    );
    assert!(value("e*x").is_some_and(|q| q.is_endless()));
}

#[test]
fn what_is_assigned_is_kept_apart_from_the_rest() {
    let (own, rest) = value("me+40").expect("a sum").apart();
    assert_eq!((own, rest.exact()), (1.0, Some(40.0)));
    assert!(value("me*x").is_some_and(|q| q.is_endless()));
    assert!(value("-(me-c)").is_some_and(|q| q.apart() == (-1.0, Quantity::exactly(5.0))));
}

#[test]
fn any_of_several_is_between_the_ends() {
    let any = |all: &[f64]| {
        Quantity::any(
            &all.iter()
                .copied()
                .map(Quantity::exactly)
                .collect::<Vec<_>>(),
        )
    };
    assert_eq!(any(&[3.0, 3.0]).exact(), Some(3.0));
    assert_eq!(any(&[3.0, 1.0]), Quantity::counted(1.0, 2.0, Some(1)));
    assert_eq!(any(&[3.0, 1.0, 2.0]).ends(), Some((1.0, 3.0)));
    let with = Quantity::any(&[Quantity::exactly(7.0), Quantity::unknown()]);
    assert!(with.unknown.is_some() && with.known_ends() == Some((0.0, 7.0)));
}

#[test]
fn what_a_counter_comes_to_anyway_makes_no_other_of_it() {
    let counter = Quantity::counted(0.0, 1.0, Some(7));
    let any = |others: &[f64]| {
        let others = others.iter().map(|other| Quantity::exactly(*other));
        let all: Vec<_> = others.chain([counter.clone()]).collect();
        Quantity::any(&all)
    };
    assert_eq!(any(&[]), counter);
    assert_eq!(any(&[0.0, 7.0]), counter);
    for other in [8.0, 0.5, -1.0] {
        assert_ne!(any(&[other]), counter, "{other}");
    }
    let beyond = counter.clone().plus(Quantity::counted(0.0, 1.0, Some(1)));
    assert_eq!(beyond, Quantity::counted(0.0, 1.0, Some(8)));
}

/// `a` is 10, coordinate 0 of target 0, `b` is 30, that of target 1; rewritten they are 1 and 3 more.
#[test]
fn what_is_worked_out_from_coordinates_changes_with_them() {
    let of = |text: &str| {
        evaluate(text.as_bytes(), &mut |name| match name {
            b"a" => Quantity::coordinate(10.0, 0, 0),
            b"b" => Quantity::coordinate(30.0, 1, 0),
            b"i" => Quantity::counted(0.0, 1.0, Some(3)),
            b"e" => Quantity::counted(0.0, 1.0, None),
            _ => Quantity::unknown(),
        })
        .expect("an expression")
    };
    let changes = |of: &Quantity| of.readings.most(&|target, _| [1.0, 3.0][target]);
    for (text, first, change) in [
        ("a", 10.0, 1.0),
        ("a-a", 0.0, 0.0),
        ("(b-a)/4", 5.0, 0.5),
        ("(b-a)*i/4", 0.0, 1.5),
        ("i*(b-a)/4-a", -10.0, 2.5),
        ("a*b", 300.0, 30.0 + 30.0),
        ("2*(a+5)", 30.0, 2.0),
    ] {
        let of = of(text);
        assert!((of.first - first).abs() < 1e-12, "{text}: {of:?}");
        assert!((changes(&of) - change).abs() < 1e-12, "{text}: {of:?}");
        assert_eq!(of.exact().is_some(), change == 0.0, "{text}");
    }
    for text in ["1/a", "a MOD 4", "a*e", "a*x"] {
        assert!(of(text).is_endless(), "{text}");
    }
    let either = Quantity::any(&[of("a"), of("b")]);
    assert_eq!(changes(&either), 4.0);
    assert_eq!(changes(&Quantity::any(&[of("b-a"), of("b-a")])), 2.0);
}

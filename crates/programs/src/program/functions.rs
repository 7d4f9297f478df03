//! Functions of arithmetic that several languages have: what they make of all that a number may be.

use super::quantity::Quantity;

/// What sums and quotients of decimals are off at most.
const OFF: f64 = 1e-9;

/// The value of a function of this name, in any letters; nothing bounds that of another one.
pub(super) fn value(name: &[u8], given: &[Quantity]) -> Quantity {
    let name = name.to_ascii_lowercase();
    // of the double numbers of RAPID
    let name = name.strip_suffix(b"dnum").unwrap_or(&name);
    match (name, given) {
        (b"abs", [of]) => absolute(of),
        (b"sqrt", [of]) => rising(of, f64::sqrt),
        (b"floor" | b"int" | b"rounddown", [of]) => whole(of, f64::floor, f64::trunc),
        (b"ceil" | b"roundup", [of]) => whole(of, f64::ceil, f64::ceil),
        // to whole numbers, or to decimals
        (b"round", [of, ..]) => near(of, 0.5),
        (b"trunc" | b"fix", [of, ..]) => near(of, 1.0),
        (b"min" | b"max", [_, ..]) => Quantity::any(given),
        (b"sin", [of]) => of_angle(of, f64::sin),
        (b"cos", [of]) => of_angle(of, f64::cos),
        (b"numto" | b"dnumtonum", [of]) => of.clone(),
        _ => Quantity::endless(),
    }
}

/// Without its sign.
fn absolute(of: &Quantity) -> Quantity {
    match of.ends() {
        Some((least, greatest)) if least == greatest => Quantity::exactly(least.abs()),
        Some((least, greatest)) => {
            let (a, b) = (least.abs(), greatest.abs());
            let is_across = least < 0.0 && greatest > 0.0;
            Quantity::between(if is_across { 0.0 } else { a.min(b) }, a.max(b))
        }
        // what nobody knows has either sign, and what is counted without an end goes on either way
        None if of.adds_up() => Quantity::endless(),
        None => Quantity::any(&[of.clone(), of.clone().times(-1.0)]),
    }
}

fn rising(of: &Quantity, function: fn(f64) -> f64) -> Quantity {
    let Some((least, greatest)) = of.ends() else {
        return if of.adds_up() || of.unknown.is_none() {
            Quantity::endless()
        } else {
            of.clone()
        };
    };
    let (a, b) = (function(least.max(0.0)), function(greatest.max(0.0)));
    if a == b {
        Quantity::exactly(a)
    } else {
        Quantity::between(a, b)
    }
}

/// Whole numbers between what these functions make of the ends.
fn whole(of: &Quantity, least: fn(f64) -> f64, most: fn(f64) -> f64) -> Quantity {
    match (of.exact(), of.ends()) {
        (Some(whole), _) if whole.fract() == 0.0 => Quantity::exactly(whole),
        (_, Some((a, b))) => {
            let off = |of: f64, by: f64| if of.fract() == 0.0 { of } else { of + by };
            Quantity::whole_between(least(off(a, -OFF)), most(off(b, OFF)))
        }
        _ => near(of, 1.0),
    }
}

/// No farther from a number than this.
fn near(of: &Quantity, by: f64) -> Quantity {
    match of.exact() {
        Some(whole) if whole.fract() == 0.0 => Quantity::exactly(whole),
        _ if of.adds_up() => Quantity::endless(),
        _ => of.clone().plus(Quantity::between(-by, by)),
    }
}

/// In the units of angles of the language: degrees or radians, which is not looked at.
fn of_angle(of: &Quantity, function: fn(f64) -> f64) -> Quantity {
    match of.exact() {
        Some(0.0) => Quantity::exactly(function(0.0)),
        _ => Quantity::between(-1.0, 1.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_functions_make_of_numbers_is_between_ends() {
        let of = |name: &str, given: &[Quantity]| value(name.as_bytes(), given);
        let exactly = Quantity::exactly;
        assert_eq!(of("Abs", &[exactly(-200.0)]).exact(), Some(200.0));
        assert_eq!(of("SQRT", &[exactly(9.0)]).exact(), Some(3.0));
        assert_eq!(of("Round", &[exactly(7.0)]).exact(), Some(7.0));
        assert_eq!(of("trunc", &[exactly(7.5)]).ends(), Some((6.5, 8.5)));
        // a third of 0 to 5 is 0 or 1
        let third = Quantity::counted(0.0, 1.0 / 3.0, Some(5));
        let expected = Quantity::counted(0.0, 1.0, Some(1));
        assert_eq!(of("INT", std::slice::from_ref(&third)), expected);
        assert_eq!(
            of("roundUp", std::slice::from_ref(&third)).ends(),
            Some((0.0, 2.0))
        );
        // downwards, or to zero
        assert_eq!(of("int", &[third.times(-1.0)]).ends(), Some((-2.0, 0.0)));
        let whole = Quantity::counted(0.0, 0.1, Some(10));
        assert_eq!(of("roundDown", &[whole]).ends(), Some((0.0, 1.0)));
        assert_eq!(
            of("max", &[exactly(1.0), exactly(4.0)]).ends(),
            Some((1.0, 4.0))
        );
        assert_eq!(of("cos", &[exactly(0.0)]).exact(), Some(1.0));
        assert_eq!(of("sin", &[exactly(30.0)]).ends(), Some((-1.0, 1.0)));
        let across = of("abs", &[Quantity::between(-3.0, 1.0)]);
        assert_eq!(across.ends(), Some((0.0, 3.0)));
        let counted = Quantity::counted(0.0, 40.0, None);
        for name in ["pow", "distance", "f"] {
            assert!(of(name, &[exactly(2.0)]).is_endless(), "{name}");
        }
        assert!(of("abs", &[Quantity::own()]).is_endless());
        assert!(of("sqrt", &[counted]).is_endless());
        assert!(!of("abs", &[Quantity::unknown()]).is_endless());
    }
}

//! Names of columns: those of the format, and what others call them.

use super::units::{Unit, in_name};
use crate::nearest::plain;

/// Columns that hold lengths (an external axis is linear or rotary: without its unit it is linear),
/// by the names that mappings use for them.
const LENGTHS: [&str; 29] = [
    "x", "y", "z", "target_x", "target_y", "target_z", "diff_x", "diff_y", "diff_z", "px", "py",
    "pz", "distance", "from_x", "from_y", "from_z", "sigma", "e1", "e2", "e3", "e4", "e5", "e6",
    "e7", "e8", "e9", "e10", "e11", "e12",
];
/// Columns that hold angles.
const ANGLES: [&str; 29] = [
    "q1", "q2", "q3", "q4", "q5", "q6", "rx", "ry", "rz", "rz2", "move1", "move2", "move3",
    "move4", "move5", "move6", "e1", "e2", "e3", "e4", "e5", "e6", "e7", "e8", "e9", "e10", "e11",
    "e12", "sigma",
];
/// Columns that hold neither.
const OTHERS: [&str; 42] = [
    "id",
    "on",
    "tool",
    "point",
    "set",
    "qw",
    "qx",
    "qy",
    "qz",
    "temperature_c",
    "time_s",
    "dir1",
    "dir2",
    "dir3",
    "dir4",
    "dir5",
    "dir6",
    "fx_n",
    "fy_n",
    "fz_n",
    "contact",
    "feature",
    "probe_radius_mm",
    "radius_mm",
    "nx",
    "ny",
    "nz",
    "cx_mm",
    "cy_mm",
    "cz_mm",
    "dir_e1",
    "dir_e2",
    "dir_e3",
    "dir_e4",
    "dir_e5",
    "dir_e6",
    "dir_e7",
    "dir_e8",
    "dir_e9",
    "dir_e10",
    "dir_e11",
    "dir_e12",
];

/// Names that a mapping may use for columns of the format: without the unit where `--units` tells
/// it.
pub fn keys() -> impl Iterator<Item = &'static str> {
    LENGTHS.iter().chain(&ANGLES).chain(&OTHERS).copied()
}

/// What a column of the format holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// A length, in millimetres.
    Length,
    /// An angle, in degrees.
    Angle,
    /// Something else.
    Other,
}

/// A column of the format by a name with or without its unit (`x`, `x_mm`, `q1_deg`); of a point on
/// the tool with its name before (`smr1.x`). `None` where there is no such column.
#[must_use]
pub(super) fn column(name: &str) -> Option<(String, Quantity)> {
    let (point, own) = match name.rsplit_once('.') {
        Some((point, own)) if !point.is_empty() => (Some(point), own),
        _ => (None, name),
    };
    let base = own.strip_suffix("_mm").or_else(|| own.strip_suffix("_deg"));
    let base = base.unwrap_or(own);
    let (full, quantity) = if LENGTHS.contains(&base) && !own.ends_with("_deg") {
        (format!("{base}_mm"), Quantity::Length)
    } else if ANGLES.contains(&base) && !own.ends_with("_mm") {
        (format!("{base}_deg"), Quantity::Angle)
    } else if keys().any(|key| key == own) {
        (own.to_owned(), Quantity::Other)
    } else {
        return None;
    };
    match point {
        None => Some((full, quantity)),
        Some(point) => ["x", "y", "z"]
            .contains(&base)
            .then(|| (format!("{point}.{full}"), quantity)),
    }
}

/// Whether a name is that of a column of the format, with its unit.
#[must_use]
pub fn is_of_format(name: &str) -> bool {
    column(name).is_some_and(|(full, _)| full == name)
}

/// A column of the format whose name has another unit (`x_m`, `q1_rad`), and that unit.
#[must_use]
pub(super) fn in_another_unit(name: &str) -> Option<(String, Unit)> {
    let (base, unit) = name.rsplit_once('_')?;
    let unit = Unit::named(unit)?;
    let ending = match unit.quantity() {
        Quantity::Angle => "_deg",
        _ => "_mm",
    };
    let (column, quantity) = column(&format!("{base}{ending}")).or_else(|| column(base))?;
    (column != name && unit.quantity() == quantity).then_some((column, unit))
}

/// What others add to the name of a coordinate that was measured, …
const MEASURED: [&str; 9] = [
    "", "meas", "measured", "act", "actual", "ist", "pos", "tcp", "coord",
];
/// … that was wanted, …
const WANTED: [&str; 8] = [
    "nom",
    "nominal",
    "soll",
    "target",
    "ref",
    "reference",
    "theo",
    "theoretical",
];
/// … and of the difference.
const DIFFERENCE: [&str; 7] = [
    "d",
    "dev",
    "deviation",
    "delta",
    "diff",
    "difference",
    "abw",
];
/// Names of joints before their number.
const JOINTS: [&str; 11] = [
    "j", "joint", "a", "axis", "ax", "q", "theta", "achse", "rax", "jt", "angle",
];
/// Names of rows.
const IDS: [&str; 17] = [
    "id",
    "name",
    "point",
    "pointname",
    "pointid",
    "pt",
    "ptid",
    "no",
    "nr",
    "number",
    "pose",
    "index",
    "label",
    "punkt",
    "feature",
    "measurement",
    "pointno",
];

/// The column of the format that a name of others may mean.
#[must_use]
pub(super) fn meant(theirs: &str) -> Option<&'static str> {
    let bare = in_name(theirs).map_or(theirs, |(bare, _)| bare);
    let name = plain(bare);
    let affixed = |axis: &str, affixes: &[&str]| {
        let mut all = affixes.iter();
        all.any(|affix| name == format!("{axis}{affix}") || name == format!("{affix}{axis}"))
    };
    for (axis, keys) in [
        ("x", ["x", "target_x", "diff_x"]),
        ("y", ["y", "target_y", "diff_y"]),
        ("z", ["z", "target_z", "diff_z"]),
    ] {
        let all = [&MEASURED[..], &WANTED, &DIFFERENCE];
        if let Some(at) = all.iter().position(|affixes| affixed(axis, affixes)) {
            return Some(keys[at]);
        }
    }
    let number = name.trim_start_matches(|c: char| !c.is_ascii_digit());
    if let Ok(number @ 1..=6) = number.parse::<usize>()
        && JOINTS.contains(&name.trim_end_matches(|c: char| c.is_ascii_digit()))
    {
        return Some(ANGLES[number - 1]);
    }
    match name.as_str() {
        "q0" | "qw" | "quatw" => Some("qw"),
        "qx" | "quatx" => Some("qx"),
        "qy" | "quaty" => Some("qy"),
        "qz" | "quatz" => Some("qz"),
        "rx" | "roll" | "w" => Some("rx"),
        "ry" | "pitch" | "p" => Some("ry"),
        "rz" | "yaw" | "r" => Some("rz"),
        "temperature" | "temp" => Some("temperature_c"),
        "reflector" | "smr" | "nest" | "marker" => Some("point"),
        _ => IDS.contains(&name.as_str()).then_some("id"),
    }
}

/// What the columns of a header may mean, as an option that says so. Empty where nothing is alike.
#[must_use]
pub fn proposal(header: &[String]) -> String {
    let mut taken: Vec<&str> = Vec::new();
    let mut pairs = Vec::new();
    for theirs in header {
        if is_of_format(theirs) {
            continue;
        }
        let Some(key) = meant(theirs).filter(|key| !taken.contains(key)) else {
            continue;
        };
        taken.push(key);
        if key != theirs {
            pairs.push(format!("{key}={theirs}"));
        }
    }
    // measured coordinates need no sum
    if ["x", "y", "z"].iter().all(|axis| taken.contains(axis)) {
        pairs.retain(|pair| !pair.starts_with("target_") && !pair.starts_with("diff_"));
    }
    if pairs.is_empty() {
        return String::new();
    }
    let text = pairs.join(",");
    if text.contains([' ', '#', '[', '(', '\'']) {
        format!("--columns \"{text}\"")
    } else {
        format!("--columns {text}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_the_format_may_leave_the_unit_out() {
        assert_eq!(column("x"), Some(("x_mm".into(), Quantity::Length)));
        assert_eq!(column("q3_deg"), Some(("q3_deg".into(), Quantity::Angle)));
        assert_eq!(
            column("smr 1.y"),
            Some(("smr 1.y_mm".into(), Quantity::Length))
        );
        assert_eq!(column("smr.q1"), None);
        assert_eq!(column("x_deg"), None);
        assert_eq!(
            in_another_unit("q1_rad"),
            Some(("q1_deg".into(), Unit::Radian))
        );
        assert_eq!(in_another_unit("x_rad"), None);
    }

    #[test]
    fn names_of_others_are_recognised() {
        for (theirs, key) in [
            ("X  [mm]", "x"),
            ("Y Measured", "y"),
            ("Nom Z", "target_z"),
            ("dX", "diff_x"),
            ("J1", "q1"),
            ("Axis 6", "q6"),
            ("rax_2", "q2"),
            ("Point Name", "id"),
            ("Temperature  [\u{b0}C]", "temperature_c"),
        ] {
            assert_eq!(meant(theirs), Some(key), "{theirs}");
        }
        assert_eq!(meant("Humidity  [%]"), None);
        let header = ["Punkt", "J1", "X (m)"].map(str::to_owned);
        assert_eq!(proposal(&header), "--columns \"id=Punkt,q1=J1,x=X (m)\"");
    }
}

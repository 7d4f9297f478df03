//! Names that are nearly one that is not known: "did you mean".

/// Names are alike from this similarity on (Jaro–Winkler: 1 is the same name).
const ALIKE: f64 = 0.8;
/// A slip of the keys leaves a name so similar, and no more letters longer or shorter.
const SLIP: f64 = 0.93;
const SLIP_LETTERS: usize = 2;
/// So many are proposed at most.
const MOST: usize = 3;
/// Longer lists are not written out.
const MOST_LISTED: usize = 40;

/// Letters and digits in lower case: case and punctuation are typed in many ways.
pub fn plain(name: &str) -> String {
    let letters = name.chars().filter(|c| c.is_alphanumeric());
    letters.flat_map(char::to_lowercase).collect()
}

fn first_word(name: &str) -> String {
    plain(name.split(['_', '-', ' ']).next().unwrap_or_default())
}

/// Units that stand behind the last `_` of columns of other programs.
const UNITS: [&str; 11] = [
    "mm", "m", "cm", "um", "in", "inch", "inches", "ft", "mil", "deg", "rad",
];

/// What is to be done with a column that is nearly called as one that is missing: where its unit is
/// another one, a new name alone makes other numbers of it.
pub fn instead_of_column(near: &str, column: &str) -> String {
    let unit = |name: &str| {
        let (_, unit) = name.rsplit_once('_')?;
        let mut units = UNITS.iter();
        units
            .find(|known| unit.eq_ignore_ascii_case(known))
            .copied()
    };
    match unit(near).zip(unit(column)) {
        Some((from, to)) if from != to => {
            format!("convert `{near}` from {from} to {to}, and call it `{column}`;")
        }
        _ => format!("is `{near}` meant as `{column}`?"),
    }
}

/// Known names that may be meant, the likeliest first: three at most, none where none is alike.
///
/// # Source
/// W. E. Winkler, "String comparator metrics and enhanced decision rules in the Fellegi–Sunter
/// model of record linkage" (1990). A name that holds what was typed, or begins with the same word,
/// counts as alike, too.
pub fn nearest<'a>(wanted: &str, known: impl IntoIterator<Item = &'a str>) -> Vec<&'a str> {
    let (wanted, first) = (plain(wanted), first_word(wanted));
    let likeness = |name: &str| {
        // the first word is left out by many, as the maker of a robot
        let parts = [name, name.split_once('_').map_or(name, |(_, rest)| rest)];
        let alike = parts.map(|part| strsim::jaro_winkler(&wanted, &plain(part)));
        let alike = alike[0].max(alike[1]);
        let held = wanted.len() >= 3 && plain(name).contains(&wanted);
        if held || first_word(name) == first {
            alike.max(ALIKE + 0.01 * alike)
        } else {
            alike
        }
    };
    let mut rated: Vec<(f64, &str)> = known
        .into_iter()
        .map(|name| (likeness(name), name))
        .collect();
    rated.retain(|(likeness, _)| *likeness >= ALIKE);
    rated.sort_by(|a, b| b.0.total_cmp(&a.0));
    rated.dedup();
    rated.into_iter().take(MOST).map(|(_, name)| name).collect()
}

/// The known name that a name surely means, which is spelt otherwise, lacks its unit, or has a slip
/// of the keys in it.
pub fn misspelt<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let wanted = plain(name);
    let means = |known: &&str| {
        let stem = known.rsplit_once('_').map_or(*known, |(stem, _)| stem);
        let known = plain(known);
        wanted == known
            || wanted == plain(stem)
            || wanted.len().abs_diff(known.len()) <= SLIP_LETTERS
                && strsim::jaro_winkler(&wanted, &known) >= SLIP
    };
    known.into_iter().find(means)
}

/// The way out of a name that is not known: what may be meant, and the known names unless they are
/// too many. `what` names these: `tools of the profile`.
pub fn hint<'a>(wanted: &str, what: &str, known: impl IntoIterator<Item = &'a str>) -> String {
    let known: Vec<&str> = known.into_iter().collect();
    let mut sentences = Vec::new();
    let near: Vec<String> = nearest(wanted, known.iter().copied())
        .iter()
        .map(|name| format!("`{name}`"))
        .collect();
    if let Some((last, before)) = near.split_last() {
        let before = before.join(", ");
        let or = if before.is_empty() { "" } else { " or " };
        sentences.push(format!("did you mean {before}{or}{last}?"));
    }
    if known.is_empty() {
        sentences.push(format!("there are no {what}"));
    } else if known.len() <= MOST_LISTED {
        sentences.push(format!("{what}: {}", known.join(", ")));
    } else if sentences.is_empty() {
        sentences.push(format!("none of the {} {what} is alike", known.len()));
    }
    sentences.join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_misspelt_name_finds_the_one_that_is_meant() {
        let known = [
            "joint_compliance",
            "joint_coupling",
            "backlash",
            "base_frame",
        ];
        assert_eq!(nearest("back_lash", known)[0], "backlash");
        assert_eq!(nearest("joint_complience", known)[0], "joint_compliance");
        assert_eq!(nearest("Base-Frame", known)[0], "base_frame");
        assert!(nearest("xyz", known).is_empty());
        let robots = ["abb_irb120", "abb_irb1600_6_145", "kuka_kr6_r900"];
        assert_eq!(nearest("irb120", robots)[0], "abb_irb120");
        assert!(nearest("irb16oo", robots).contains(&"abb_irb1600_6_145"));
    }

    #[test]
    fn a_slip_of_the_keys_is_no_other_name() {
        let known = ["temperature_c", "time_s", "sigma_mm", "move1_deg", "dir1"];
        let cases = [
            ("tempreature_c", Some("temperature_c")),
            ("Temperature", Some("temperature_c")),
            ("sigma", Some("sigma_mm")),
            ("sigma_m", Some("sigma_mm")),
            ("DIR_1", Some("dir1")),
            ("timestamp", None),
            ("move_id", None),
            ("direction", None),
            ("comment", None),
        ];
        for (name, means) in cases {
            assert_eq!(misspelt(name, known), means, "{name}");
        }
    }

    #[test]
    fn the_hint_proposes_and_lists() {
        let sentences = hint("gripr", "tools of the profile", ["gripper", "torch"]);
        assert_eq!(
            sentences,
            "did you mean `gripper`? tools of the profile: gripper, torch"
        );
        assert_eq!(
            hint("x", "tools of the profile", []),
            "there are no tools of the profile"
        );
        assert_eq!(hint("q", "columns", ["a", "b"]), "columns: a, b");
        let many = ["a"; MOST_LISTED + 1];
        assert_eq!(
            hint("q", "columns", many),
            "none of the 41 columns is alike"
        );
    }
}

//! A check against one that was stored: what got worse, what better.
//!
//! The stored run is the JSON report of a check. Moves are paired by file and by their place among
//! the file's moves, so that a line inserted above changes nothing. A file is the same where its
//! absolute path is, `.` and double slashes left out.

use crate::geometry::Pose;
use crate::geometry::units::DEG;
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::PathBuf;

/// Differences below these are none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerances {
    /// Of errors, clearances and coordinates of targets, mm.
    pub mm: f64,
    /// Of angles, degrees.
    pub deg: f64,
}

impl Default for Tolerances {
    fn default() -> Self {
        Self {
            mm: 0.0005,
            deg: 0.0005,
        }
    }
}

/// One difference.
#[derive(Clone, Debug, PartialEq, serde::Serialize, schemars::JsonSchema)]
pub struct Difference {
    /// Program file.
    pub file: String,
    /// Line in the present file (in the stored one where the move is gone); 0 for the whole file.
    pub line: u64,
    /// What differs: a key of a move, `moves` (how many), `body` (one that is gone: the moves
    /// have no clearance to it), or the id of a finding.
    pub what: String,
    /// The stored value.
    pub before: Value,
    /// The present one.
    pub now: Value,
}

/// What differs from a stored run.
#[derive(Clone, Debug, PartialEq, Default, serde::Serialize, schemars::JsonSchema)]
pub struct Comparison {
    /// Larger errors, less room, new findings, other targets.
    pub worse: Vec<Difference>,
    /// The reverse.
    pub better: Vec<Difference>,
    /// Moves in which nothing differs.
    pub same: usize,
}

/// Why two runs cannot be compared.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum BaselineError {
    /// No JSON.
    #[error("not a stored check: {message}")]
    Json {
        /// What the parser says.
        message: String,
    },
    /// A number that no check stores.
    #[error("`{key}` is {found:?}; a check stores {low:?} to {high:?}")]
    TooLarge {
        /// The line, from 1.
        line: usize,
        /// The key.
        key: &'static str,
        /// What stands there.
        found: f64,
        /// The least.
        low: f64,
        /// The most.
        high: f64,
    },
    /// Another kind of report.
    #[error("a report of the kind `{found}`; a stored check is `check/1`")]
    Kind {
        /// What it says.
        found: String,
    },
}

/// A joint that stands farther off at the same pose, degrees, stands in another posture or a rotation
/// on: another branch, or another place of an external axis, moves one by more.
const POSTURE_DEG: f64 = 1.0;

/// Keys of a move of which more is worse, and whether they are angles.
const MORE_IS_WORSE: [(&str, bool); 4] = [
    ("target_error_mm", false),
    ("target_error_deg", true),
    ("max_path_error_mm", false),
    ("max_path_error_deg", true),
];
/// Keys of a move of which less is worse.
const LESS_IS_WORSE: [&str; 3] = ["clearance_mm", "room_mm", "nominal_clearance_mm"];

/// Reads a stored run.
///
/// # Errors
/// If it is not the report of a check.
pub fn read(text: &str) -> Result<Value, BaselineError> {
    let value: Value = serde_json::from_str(text).map_err(|error| BaselineError::Json {
        message: error.to_string(),
    })?;
    let kind = value["poseshift"].as_str().unwrap_or("nothing");
    if kind != "check/1" || !value["moves"].is_array() {
        return Err(BaselineError::Kind { found: kind.into() });
    }
    refuse_endless(&value, text)?;
    Ok(value)
}

/// No room is as large, mm: 1000 km. Against a larger error no other would be worse.
const MOST_MM: f64 = 1e9;
/// No rotation is as large, degrees.
const MOST_DEG: f64 = 360.0;

/// Refuses what is compared where no check can have stored it.
fn refuse_endless(run: &Value, text: &str) -> Result<(), BaselineError> {
    let errors = MORE_IS_WORSE.into_iter();
    let errors = errors.map(|(key, deg)| (key, 0.0, if deg { MOST_DEG } else { MOST_MM }));
    let rooms = LESS_IS_WORSE.into_iter();
    let rooms = rooms.map(|key| (key, -MOST_MM, MOST_MM));
    let keys: Vec<(&str, f64, f64)> = errors.chain(rooms).collect();
    for one in run["moves"].as_array().into_iter().flatten() {
        for &(key, low, high) in &keys {
            let found = one[key].as_f64();
            if let Some(found) = found.filter(|found| !(low..=high).contains(found)) {
                let line = line_of(text, key, found);
                return Err(BaselineError::TooLarge {
                    line,
                    key,
                    found,
                    low,
                    high,
                });
            }
        }
    }
    Ok(())
}

/// The first line on which a key has this number.
fn line_of(text: &str, key: &str, number: f64) -> usize {
    let quoted = format!("\"{key}\"");
    let is_it = |(at, _): &(usize, &str)| {
        let behind = text[at + quoted.len()..].trim_start();
        let value = behind.strip_prefix(':').map_or("", str::trim_start);
        let end = value.find(|c: char| c == ',' || c == '}' || c.is_whitespace());
        value[..end.unwrap_or(value.len())].parse() == Ok(number)
    };
    let at = text.match_indices(&quoted).find(is_it);
    1 + at.map_or(0, |(at, _)| text[..at].matches('\n').count())
}

/// The names of files as the present run spells them, whatever the stored one wrote.
struct Spelling<'a>(BTreeMap<PathBuf, &'a str>);

impl<'a> Spelling<'a> {
    fn of(now: &'a Value) -> Self {
        let entries = [&now["moves"], &now["findings"]].map(Value::as_array);
        let names = entries.into_iter().flatten().flatten();
        let names = names.filter_map(|entry| entry["file"].as_str());
        Self(names.map(|name| (place(name), name)).collect())
    }

    /// The file of a move or a finding.
    fn file(&self, entry: &'a Value) -> &'a str {
        let name = entry["file"].as_str().unwrap_or_default();
        self.0.get(&place(name)).copied().unwrap_or(name)
    }
}

/// The absolute path of a name; the name where there is no folder that it could begin at.
fn place(name: &str) -> PathBuf {
    std::path::absolute(name).unwrap_or_else(|_| name.into())
}

/// Moves by file, in the order of the report.
fn by_file<'a>(report: &'a Value, spelling: &Spelling<'a>) -> BTreeMap<&'a str, Vec<&'a Value>> {
    let mut files: BTreeMap<&str, Vec<&Value>> = BTreeMap::new();
    for entry in report["moves"].as_array().into_iter().flatten() {
        let file = spelling.file(entry);
        files.entry(file).or_default().push(entry);
    }
    files
}

/// How many findings of each id each file has on each move's line, notes left out.
fn findings_by<'a>(
    report: &'a Value,
    spelling: &Spelling<'a>,
) -> BTreeMap<(&'a str, &'a str), Vec<u64>> {
    let mut found: BTreeMap<(&str, &str), Vec<u64>> = BTreeMap::new();
    for finding in report["findings"].as_array().into_iter().flatten() {
        if finding["severity"] == "note" {
            continue;
        }
        let key = (
            spelling.file(finding),
            finding["id"].as_str().unwrap_or_default(),
        );
        let line = finding["line"].as_u64().unwrap_or(0);
        found.entry(key).or_default().push(line);
    }
    found
}

/// Compares a stored run with the present one.
#[must_use]
pub fn compare(before: &Value, now: &Value, tolerances: Tolerances) -> Comparison {
    let mut comparison = Comparison::default();
    let spelling = Spelling::of(now);
    let (old, new) = (by_file(before, &spelling), by_file(now, &spelling));
    let none = Vec::new();
    let files: std::collections::BTreeSet<_> = old.keys().chain(new.keys()).copied().collect();
    for file in files {
        let (old, new) = (
            old.get(file).unwrap_or(&none),
            new.get(file).unwrap_or(&none),
        );
        if old.len() != new.len() {
            comparison.worse.push(Difference {
                file: file.into(),
                line: 0,
                what: "moves".into(),
                before: old.len().into(),
                now: new.len().into(),
            });
        }
        for (old, new) in old.iter().zip(new) {
            compare_move(file, old, new, tolerances, &mut comparison);
        }
    }
    comparison.worse.extend(bodies_gone(before, now));
    let (old, new) = (findings_by(before, &spelling), findings_by(now, &spelling));
    let keys: std::collections::BTreeSet<_> = old.keys().chain(new.keys()).copied().collect();
    for key in keys {
        let lines =
            |of: &BTreeMap<(&str, &str), Vec<u64>>| of.get(&key).cloned().unwrap_or_default();
        let (old, new) = (lines(&old), lines(&new));
        let difference = |line: Option<&u64>| Difference {
            file: key.0.into(),
            line: line.copied().unwrap_or(0),
            what: key.1.into(),
            before: old.len().into(),
            now: new.len().into(),
        };
        // the line that is reported is the first that the other run has not
        let extra = |some: &[u64], other: &[u64]| some.iter().find(|l| !other.contains(l)).copied();
        if new.len() > old.len() {
            let line = extra(&new, &old);
            comparison
                .worse
                .push(difference(line.as_ref().or(new.first())));
        } else if new.len() < old.len() {
            let line = extra(&old, &new);
            comparison
                .better
                .push(difference(line.as_ref().or(old.first())));
        }
    }
    for list in [&mut comparison.worse, &mut comparison.better] {
        list.sort_by(|a, b| (&a.file, a.line, &a.what).cmp(&(&b.file, b.line, &b.what)));
    }
    comparison
}

/// Bodies that only the stored run knows; a run stored before bodies were reported says nothing.
fn bodies_gone(before: &Value, now: &Value) -> impl Iterator<Item = Difference> {
    let listed = |run: &Value| run["bodies"].as_array().cloned().unwrap_or_default();
    let kept = listed(now);
    let gone = listed(before)
        .into_iter()
        .filter(move |b| !kept.contains(b));
    let input = now["input"].as_str().or(now["input"][0].as_str());
    let file = input.unwrap_or_default().to_owned();
    gone.map(move |body| Difference {
        file: file.clone(),
        line: 0,
        what: "body".into(),
        before: body,
        now: Value::Null,
    })
}

fn compare_move(
    file: &str,
    old: &Value,
    new: &Value,
    tolerances: Tolerances,
    comparison: &mut Comparison,
) {
    let before = comparison.worse.len() + comparison.better.len();
    let difference = |key: &str| Difference {
        file: file.into(),
        line: new["line"].as_u64().unwrap_or(0),
        what: key.into(),
        before: old[key].clone(),
        now: new[key].clone(),
    };
    let keys = MORE_IS_WORSE
        .iter()
        .map(|(key, angle)| (*key, *angle, 1.0))
        .chain(LESS_IS_WORSE.iter().map(|key| (*key, false, -1.0)));
    for (key, angle, sense) in keys {
        let tolerance = if angle { tolerances.deg } else { tolerances.mm };
        match (old[key].as_f64(), new[key].as_f64()) {
            (Some(a), Some(b)) if sense * (b - a) > tolerance => {
                comparison.worse.push(difference(key));
            }
            (Some(a), Some(b)) if sense * (a - b) > tolerance => {
                comparison.better.push(difference(key));
            }
            // a key that is younger than the stored run says nothing
            (None, Some(_)) if old.get(key).is_none() => {}
            (Some(_), None) | (None, Some(_)) => comparison.worse.push(difference(key)),
            _ => {}
        }
    }
    let is_moved = |key: &str, tolerance: &dyn Fn(usize) -> f64, turns: &dyn Fn(usize) -> bool| {
        let [a, b] = [&old[key], &new[key]].map(numbers);
        let is_far = |(i, (a, b)): (usize, (&f64, &f64))| {
            let gap = (a - b).abs();
            // an angle of an orientation and one a whole revolution on are the same
            let gap = if turns(i) {
                gap.min((gap - 360.0).abs())
            } else {
                gap
            };
            gap > tolerance(i)
        };
        a.len() != b.len() || a.iter().zip(&b).enumerate().any(is_far)
    };
    // a key that is younger than the stored run says nothing
    let is_known = |key: &str| old.get(key).is_some();
    if old["kind"] != new["kind"] {
        comparison.worse.push(difference("kind"));
    }
    let of_pose = |i: usize| if i < 3 { tolerances.mm } else { tolerances.deg };
    // three other angles may be nearly the same rotation
    let [old_pose, new_pose] = [&old["target"], &new["target"]].map(numbers);
    let poses = old_pose.first_chunk::<6>().zip(new_pose.first_chunk::<6>());
    let is_alike = poses.is_some_and(|(a, b)| {
        let is_there = (0..3).all(|i| (a[i] - b[i]).abs() <= tolerances.mm);
        let apart = rotation_of(a).separation(&rotation_of(b)).angle_rad;
        is_there && apart <= tolerances.deg * DEG
    });
    if !is_alike && is_moved("target", &of_pose, &|i| i >= 3) {
        comparison.worse.push(difference("target"));
    } else if is_known("joints_deg") {
        let is_joints = new["joint_target"] == Value::Bool(true);
        let apart = if is_joints {
            tolerances.deg
        } else {
            tolerances.deg + POSTURE_DEG
        };
        if is_moved("joints_deg", &|_| apart, &|_| false) {
            comparison.worse.push(difference("joints_deg"));
        }
    }
    let others = [
        ("via_mm", tolerances.mm),
        ("external", tolerances.mm.min(tolerances.deg)),
    ];
    for (key, tolerance) in others {
        if is_known(key) && is_moved(key, &|_| tolerance, &|_| false) {
            comparison.worse.push(difference(key));
        }
    }
    if comparison.worse.len() + comparison.better.len() == before {
        comparison.same += 1;
    }
}

/// The rotation of a target as reports have it.
fn rotation_of(target: &[f64; 6]) -> Pose {
    let [rx, ry, rz] = [target[3], target[4], target[5]].map(|angle| angle * DEG);
    Pose::from_xyz_rxryrz([0.0, 0.0, 0.0, rx, ry, rz])
}

/// The numbers of a list; what is no number equals none.
fn numbers(list: &Value) -> Vec<f64> {
    let all = list.as_array().into_iter().flatten();
    all.map(|value| value.as_f64().unwrap_or(f64::MAX))
        .collect()
}

/// Short lines on what got worse, `file:line: what before → now`.
#[must_use]
pub fn text(comparison: &Comparison) -> String {
    let mut out = format!(
        "baseline: {} worse, {} better, {} moves the same\n",
        comparison.worse.len(),
        comparison.better.len(),
        comparison.same
    );
    for difference in &comparison.worse {
        let Difference {
            file,
            line,
            what,
            before,
            now,
        } = difference;
        let place = if *line == 0 {
            file.clone()
        } else {
            format!("{file}:{line}")
        };
        out += &format!(
            "{place}: worse: {what} {} -> {}\n",
            short(before),
            short(now)
        );
    }
    out
}

fn short(value: &Value) -> String {
    match (value.as_f64(), value.as_array()) {
        (Some(number), _) if number.fract() != 0.0 => format!("{number:.4}"),
        (_, Some(list)) => {
            let parts: Vec<_> = list.iter().map(short).collect();
            format!("[{}]", parts.join(", "))
        }
        (_, None) if value.is_null() => "none".into(),
        _ => value.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn run(error: f64, clearance: f64, x: f64, findings: usize) -> Value {
        let finding = json!({"id": "collision", "severity": "error", "file": "a.mod", "line": 7});
        json!({
            "poseshift": "check/1",
            "moves": [{"file": "a.mod", "line": 7, "kind": "linear", "target": [x, 0.0, 0.0, 180.0, 0.0, 0.0],
                "max_path_error_mm": error, "clearance_mm": clearance}],
            "findings": vec![finding; findings],
        })
    }

    #[test]
    fn worse_and_better_are_reported_with_their_line_and_small_changes_are_not() {
        let base = run(0.1, 5.0, 1.0, 0);
        let compare = |now: &Value| compare(&base, now, Tolerances::default());
        assert_eq!(compare(&run(0.1002, 4.9998, 1.0, 0)).same, 1);
        let cases = [
            (run(0.2, 5.0, 1.0, 0), "max_path_error_mm"),
            (run(0.1, 4.0, 1.0, 0), "clearance_mm"),
            (run(0.1, 5.0, 1.001, 0), "target"),
            (run(0.1, 5.0, 1.0, 1), "collision"),
        ];
        for (now, what) in cases {
            let found = compare(&now);
            assert_eq!(found.worse.len(), 1, "{what}");
            assert_eq!(
                (found.worse[0].what.as_str(), found.worse[0].line),
                (what, 7)
            );
            assert!(text(&found).contains(&format!("a.mod:7: worse: {what}")));
        }
        assert_eq!(compare(&run(0.05, 6.0, 1.0, 0)).better.len(), 2);
        let mut turned = base.clone();
        turned["moves"][0]["target"][3] = json!(-180.0);
        assert_eq!(compare(&turned).same, 1);
        // nearly the same rotation by three other angles
        let upright = |angles: [f64; 3]| {
            let mut run = base.clone();
            for (i, angle) in angles.into_iter().enumerate() {
                run["moves"][0]["target"][3 + i] = json!(angle);
            }
            run
        };
        let found = super::compare(
            &upright([0.0, 90.0, 0.0]),
            &upright([-180.0, 89.99999, -180.0]),
            Tolerances::default(),
        );
        assert_eq!(found.same, 1);
        let found = super::compare(
            &upright([0.0, 90.0, 0.0]),
            &upright([-180.0, 89.99, -180.0]),
            Tolerances::default(),
        );
        assert_eq!(found.worse[0].what, "target");
        turned["moves"] = json!([]);
        assert_eq!(compare(&turned).worse[0].what, "moves");
    }

    #[test]
    fn another_path_to_the_same_target_is_worse() {
        let with = |key: &str, value: Value| {
            let mut run = run(0.1, 5.0, 1.0, 0);
            run["moves"][0][key] = value;
            run
        };
        let what = |before: &Value, now: &Value| {
            let found = compare(before, now, Tolerances::default())
                .worse
                .into_iter();
            found.map(|of| of.what).collect::<Vec<_>>()
        };
        for (key, a, b) in [
            ("kind", json!("linear"), json!("joint")),
            ("via_mm", json!([350, 250, 300]), json!([350, 150, 300])),
            ("external", json!([1000.0, null]), json!([1150.0, null])),
            (
                "joints_deg",
                json!([-3.2, 10.0, 5.0, 0.0, 60.0, 0.0]),
                json!([-21.3, 10.0, 5.0, 0.0, 60.0, 0.0]),
            ),
        ] {
            let (a, b) = (with(key, a), with(key, b));
            assert_eq!(what(&a, &b), [key]);
            assert_eq!(what(&a, &a), [""; 0]);
        }
        // a run that was stored before they were reported says nothing of them
        let older = run(0.1, 5.0, 1.0, 0);
        assert_eq!(what(&older, &with("via_mm", json!([1, 2, 3]))), [""; 0]);
        assert_eq!(what(&older, &with("external", json!([1]))), [""; 0]);
        // of a target in joints each counts, also by whole rotations
        let joints = |j6: f64| {
            let mut run = with("joints_deg", json!([0.0, 0.0, 0.0, 0.0, 60.0, j6]));
            run["moves"][0]["joint_target"] = json!(true);
            run
        };
        assert_eq!(what(&joints(0.0), &joints(360.0)), ["joints_deg"]);
        assert_eq!(what(&joints(0.0), &joints(0.1)), ["joints_deg"]);
        assert_eq!(what(&joints(0.0), &joints(0.0004)), [""; 0]);
    }

    #[test]
    fn less_room_is_worse_and_a_run_stored_before_it_was_reported_says_nothing_of_it() {
        let with_room = |room: f64| {
            let mut run = run(0.1, 5.0, 1.0, 0);
            run["moves"][0]["room_mm"] = json!(room);
            run
        };
        let compare = |before: &Value| compare(before, &with_room(1.0), Tolerances::default());
        assert_eq!(compare(&with_room(2.0)).worse[0].what, "room_mm");
        assert_eq!(compare(&with_room(0.5)).better[0].what, "room_mm");
        assert_eq!(compare(&run(0.1, 5.0, 1.0, 0)).same, 1);
    }

    #[test]
    fn a_body_that_is_gone_is_worse_though_the_clearance_to_others_is_larger() {
        let with = |bodies: Value, clearance: f64| {
            let mut run = run(0.1, clearance, 1.0, 0);
            run["input"] = json!("a.mod");
            run["bodies"] = bodies;
            run
        };
        let old = with(json!(["link1", "table"]), 5.0);
        let found = compare(&old, &with(json!(["link1"]), 90.0), Tolerances::default());
        assert_eq!((found.worse.len(), found.better.len()), (1, 1));
        assert!(text(&found).contains("a.mod: worse: body \"table\" -> none"));
        let more = with(json!(["link1", "table", "jig"]), 5.0);
        assert_eq!(compare(&old, &more, Tolerances::default()).same, 1);
        let older = run(0.1, 5.0, 1.0, 0);
        assert!(
            compare(&older, &old, Tolerances::default())
                .worse
                .is_empty()
        );
    }

    #[test]
    fn a_file_is_the_same_however_its_path_is_spelled() {
        let spelled = |file: &str| {
            let mut run = run(0.1, 5.0, 1.0, 1);
            run["moves"][0]["file"] = json!(file);
            run["findings"][0]["file"] = json!(file);
            run
        };
        let compare = |a: &str, b: &str| compare(&spelled(a), &spelled(b), Tolerances::default());
        let here = std::path::absolute("cells/a.mod").expect("a present folder");
        let here = here.to_str().expect("UTF-8");
        let spellings = ["cells/a.mod", "./cells//a.mod", "cells/./a.mod", here];
        for (a, b) in spellings.iter().flat_map(|a| spellings.map(|b| (*a, b))) {
            let found = compare(a, b);
            assert!(found.worse.is_empty() && found.same == 1, "{a} {b}");
        }
        let other = compare("cells/a.mod", "../cells/a.mod");
        assert_eq!((other.same, other.better.len()), (0, 1));
        // moves more, moves fewer and a new finding
        assert_eq!(other.worse.len(), 3);
    }

    #[test]
    fn other_files_are_no_baseline() {
        assert!(read("{").is_err());
        assert!(read(r#"{"poseshift": "compensation/1", "moves": []}"#).is_err());
        assert!(read(&run(0.1, 1.0, 0.0, 0).to_string()).is_ok());
    }
}

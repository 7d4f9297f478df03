//! What changes in a session, or was there from its first row on: which of the arm, the device and
//! the tool it is.

use super::commands::diagnosed as by_command;
use super::standing::{found, moved};
use super::{group, with_csv};
use crate::trial::{Case, case};
use poseshift::diagnose::{Diagnosis, Options, Standing, Verdict};
use poseshift::geometry::Pose;
use poseshift::model::effects::Kind;
use poseshift::model::{Conditions, Model};

/// A session of nothing but noise in which a joint is elsewhere, by this angle in radians from the
/// row's number.
fn turning(seed: u64, joint: usize, by: impl Fn(usize) -> f64) -> Case {
    let base = case(group("clean"), 0, seed, 150);
    let name = base.profile.tools.keys().next().expect("its tool").clone();
    let tool = base.profile.tool(&name).expect("its tool");
    let model = base.profile.real_model(&tool, &Conditions::default());
    moved(base, |row, degrees| {
        let q = degrees.map(f64::to_radians);
        let mut turned = q;
        turned[joint] += by(row);
        let at = |q: &[f64; 6]| model.forward(q, &Conditions::default()).translation;
        let (a, b) = (at(&q), at(&turned));
        std::array::from_fn(|k| 1e3 * (b[k] - a[k]))
    })
}

fn diagnosed(case: &Case) -> Diagnosis {
    found(case, &Options::default())
}

fn is_drift(of: &poseshift::diagnose::Found) -> bool {
    of.effect.label().contains("drift")
}

#[test]
fn a_joint_at_an_end_of_the_arm_that_drifts_may_be_the_device_or_the_tool() {
    for (joint, size, words) in [
        (0, 4e-4, "turns about the axis of joint 1"),
        (5, 3e-3, "turns about the axis of joint 6"),
    ] {
        let d = diagnosed(&turning(4, joint, |row| size * row as f64 / 150.0));
        let drift = d.found.iter().find(|f| is_drift(f));
        let drift = drift.expect("a drift");
        assert_eq!(drift.effect.site.index, joint);
        assert_eq!(drift.standing, Standing::Likely);
        let first = drift.against.first().expect("a device or a tool");
        assert!(first.what.contains(words), "{}", first.what);
        assert!((first.odds - 1.0).abs() < 1e-12);
    }
    // a joint within the arm is none of them
    let d = diagnosed(&turning(4, 2, |row| 4e-4 * row as f64 / 150.0));
    assert_eq!(d.found.len(), 1);
    assert_eq!(d.found[0].standing, Standing::Certain);
}

#[test]
fn what_is_there_from_the_first_row_on_is_no_drift() {
    for seed in 1..9 {
        for joint in [0, 3] {
            let d = diagnosed(&turning(seed, joint, |_| 1.3e-4));
            let named: Vec<String> = d.found.iter().map(|f| f.effect.label()).collect();
            assert!(!d.found.iter().any(is_drift), "{seed} {joint}: {named:?}");
        }
    }
}

#[test]
fn a_device_that_tilts_slowly_is_not_surely_one_that_moved_at_once() {
    // about a stand 2 m away
    let base = case(group("clean"), 0, 4, 150);
    let name = base.profile.tools.keys().next().expect("its tool").clone();
    let tool = base.profile.tool(&name).expect("its tool");
    let model = base.profile.real_model(&tool, &Conditions::default());
    let tilted = moved(base, |row, degrees| {
        let q = degrees.map(f64::to_radians);
        let p = model.forward(&q, &Conditions::default()).translation;
        let angle = 6e-5 * row as f64 / 150.0;
        let (y, z) = (p[1] - 0.5, p[2] + 1.2);
        [0.0, -1e3 * angle * z, 1e3 * angle * y]
    });
    let d = diagnosed(&tilted);
    for one in &d.found {
        let is_step = one.effect.definition().begins_at_a_row();
        assert!(!is_step || one.standing != Standing::Certain);
    }
}

#[test]
fn a_joint_that_scatters_has_no_certain_wave() {
    for seed in 1..5 {
        // numbers that no effect follows
        let by = |row: usize| (((row * row * 31 + 17 * row) % 211) as f64 / 211.0 - 0.5) * 2e-3;
        let d = diagnosed(&turning(seed, 3, by));
        for one in &d.found {
            let is_wave = one.effect.definition().is_wave();
            let is_high = is_wave && one.effect.site.periods() > 12.0;
            assert!(!is_high || one.standing != Standing::Certain, "{seed}");
        }
    }
}

/// A session of nothing but noise in which some rows are off by this, mm, by their joint angles.
fn off_in(rows: std::ops::Range<usize>, by: impl Fn([f64; 6]) -> [f64; 3]) -> Case {
    let base = case(group("clean"), 0, 4, 150);
    moved(base, |row, joints| {
        if rows.contains(&row) {
            by(joints)
        } else {
            [0.0; 3]
        }
    })
}

#[test]
fn rows_in_a_row_that_fit_no_model_are_named_and_something_is_missing() {
    let device = |_| [300.0, -150.0, 0.0];
    let less = |_| [80.0, 60.0, 0.0];
    for (rows, by, off, lines, when) in [
        (
            140..150,
            device as fn([f64; 6]) -> [f64; 3],
            335.4,
            "lines 142 to 151, 10 rows",
            "before line 142 (",
        ),
        (
            146..150,
            device,
            335.4,
            "lines 148 to 151, 4 rows",
            "before line 148 (",
        ),
        (0..5, less, 100.0, "lines 2 to 6, 5 rows", "after line 6 ("),
        (
            70..77,
            device,
            335.4,
            "lines 72 to 78, 7 rows",
            "before line 72 and after line 78 (",
        ),
        (
            130..150,
            device,
            335.4,
            "lines 132 to 151, 20 rows",
            "before line 132 (",
        ),
    ] {
        let d = diagnosed(&off_in(rows, by));
        assert_eq!(d.verdict, Verdict::Undetermined, "{lines}");
        let reason = d.reasons.iter().find(|r| r.contains(lines));
        let reason = reason.unwrap_or_else(|| panic!("{lines}: {:?}", d.reasons));
        assert!(reason.contains(when), "{reason}");
        let size = reason
            .split(" are ")
            .nth(1)
            .and_then(|rest| rest.split(' ').next());
        let size: f64 = size.and_then(|word| word.parse().ok()).expect("a size");
        assert!(f64::abs(size - off) < 0.1, "{reason}");
        assert!(
            reason.contains("mostly the measuring device or the base"),
            "{reason}"
        );
        // a table of where the model misses does not hide it
        let spot = d.spots.iter().find(|s| s.column == "row").expect("by rows");
        assert!(spot.largest_m > 0.01, "{}", spot.largest_m);
    }
}

#[test]
fn rows_in_a_row_with_a_slipped_tool_or_a_lost_zero_say_so() {
    let base = case(group("clean"), 0, 4, 150);
    let name = base.profile.tools.keys().next().expect("its tool").clone();
    let tool = base.profile.tool(&name).expect("its tool");
    let model = base.profile.real_model(&tool, &Conditions::default());
    let pose = |q: [f64; 6]| model.forward(&q.map(f64::to_radians), &Conditions::default());
    let slipped = diagnosed(&off_in(144..150, |q| {
        let pose = pose(q);
        let at = pose.transform([0.02, 0.01, -0.03]);
        std::array::from_fn(|k| 1e3 * (at[k] - pose.translation[k]))
    }));
    let lost = diagnosed(&off_in(144..150, |q| {
        let mut turned = q;
        turned[2] += 10.0;
        let (a, b) = (pose(q).translation, pose(turned).translation);
        std::array::from_fn(|k| 1e3 * (b[k] - a[k]))
    }));
    for (d, words) in [
        (slipped, "mostly the tool or the reflector"),
        (lost, "a joint lost its zero"),
    ] {
        assert_eq!(d.verdict, Verdict::Undetermined);
        let reason = d.reasons.iter().find(|r| r.contains("lines 146 to 151"));
        let reason = reason.expect("these rows");
        assert!(reason.contains(words), "{reason}");
    }
}

#[test]
fn single_rows_that_fit_no_model_are_none_in_a_row() {
    let case = case(group("clean"), 0, 4, 150);
    let single = moved(case, |row, _| {
        let is_wrong = [10, 11, 12, 60, 90, 149].contains(&row);
        [if is_wrong { 40.0 } else { 0.0 }, 0.0, 0.0]
    });
    let d = diagnosed(&single);
    assert_eq!(d.verdict, Verdict::NothingMissing, "{:?}", d.reasons);
    assert_eq!(d.outliers.len(), 6);
}

#[test]
fn the_command_ends_with_one_where_rows_in_a_row_fit_no_model() {
    let case = off_in(140..150, |_| [300.0, -150.0, 0.0]);
    let (status, out, error) = by_command(&case, &[]);
    assert_eq!(status, 1, "{error}");
    assert!(out.contains("lines 142 to 151"), "{out}");
}

/// A session of nothing but noise whose rows from this one on a device sees that was moved so.
fn stepped(elsewhere: Pose, step: Pose, first: usize) -> Case {
    let base = case(group("clean"), 0, 4, 150);
    let name = base.profile.tools.keys().next().expect("its tool").clone();
    let tool = base.profile.tool(&name).expect("its tool");
    let model = base.profile.real_model(&tool, &Conditions::default());
    moved(base, |row, degrees| {
        let q = degrees.map(f64::to_radians);
        let place = model.forward(&q, &Conditions::default()).translation;
        let mut seen = elsewhere.transform(place);
        if row + 1 >= first {
            seen = step.transform(seen);
        }
        std::array::from_fn(|k| 1e3 * (seen[k] - place[k]))
    })
}

#[test]
fn a_large_step_of_the_device_is_solved_until_it_rests() {
    let here = Pose::identity();
    let elsewhere = Pose::from_xyz_rxryrz([2.1, -0.7, 0.3, 0.0, 0.0, 0.9]);
    let turned = Pose::from_xyz_rxryrz([0.3, 0.2, 0.0, 0.0, 0.0, 10_f64.to_radians()]);
    let far = Pose::from_xyz_rxryrz([0.06, 0.03, 0.0, 0.0, 0.0, 0.0]);
    let farther = Pose::from_xyz_rxryrz([0.3, -0.15, 0.0, 0.0, 0.0, 0.0]);
    for (at, step, first) in [
        (here, turned, 76),
        (here, far, 76),
        (elsewhere, turned, 76),
        (elsewhere, far, 76),
        // of few rows, and of most
        (here, farther, 111),
        (here, farther, 51),
    ] {
        let case = stepped(at, step, first);
        let d = diagnosed(&case);
        let labels: Vec<String> = d.found.iter().map(|f| f.effect.label()).collect();
        assert_eq!(labels, [format!("frame_shift row {first}")], "{step:?}");
        // the noise, and nothing of the step
        assert!(d.residual_m < 1.1 * d.noise_m, "{}", d.residual_m);
        assert!(d.reasons.iter().all(|r| !r.contains("no arm has")));
        // the arm and its tool are as they were
        for effect in &d.profile.effects {
            let before = case.profile.effects.iter().find(|e| e.same_place(effect));
            let before = before.map_or([0.0; 6], |e| e.parameters);
            let off = (effect.parameters.iter().zip(before)).map(|(a, b)| (a - b).abs());
            let most = off.fold(0.0, f64::max);
            assert!(most < 2e-5, "{}: {most:e}, {step:?}", effect.label());
        }
    }
}

#[test]
fn the_uncertainty_of_a_drift_counts_its_constant() {
    // a row in 45 s, and up to 5 s more
    let (angle, constant) = (3e-4, 2250.0);
    let (mut of_angle, mut of_constant, mut count) = (0.0, 0.0, 0.0);
    for seed in 1..17 {
        let drift = |row: usize| angle * (1.0 - (-(45.0 * row as f64 + 2.5) / constant).exp());
        let d = diagnosed(&turning(seed, 2, drift));
        let one = d.found.iter().find(|f| is_drift(f)).expect("a drift");
        assert_eq!((one.effect.site.index, &one.sought[..]), (2, &[0][..]));
        let (number, sigma) = one.listed.expect("a constant that was chosen");
        of_angle += ((one.effect.parameters[0] - angle) / one.sigmas[0]).powi(2);
        of_constant += ((one.effect.parameters[number] - constant) / sigma).powi(2);
        count += 1.0;
    }
    let [angle, constant] = [of_angle, of_constant].map(|sum: f64| (sum / count).sqrt());
    assert!((0.5..1.6).contains(&angle), "{angle} {constant}");
    assert!((0.5..1.6).contains(&constant), "{angle} {constant}");
}

/// A session of nothing but noise, measured from a device that stands elsewhere, of an arm and a tool
/// that are these changes off.
fn elsewhere(seed: u64, joint_2: f64, tool_m: [f64; 3]) -> Case {
    let base = case(group("clean"), 0, seed, 150);
    let name = base.profile.tools.keys().next().expect("its tool").clone();
    let tool = base.profile.tool(&name).expect("its tool");
    let model = base.profile.real_model(&tool, &Conditions::default());
    let device = Pose::from_xyz_rxryrz([0.4, -0.3, 0.1, 0.02, -0.03, 0.5]);
    moved(base, |_, degrees| {
        let q = degrees.map(f64::to_radians);
        let mut off = q;
        off[1] += joint_2;
        let at = |q: &[f64; 6]| model.forward(q, &Conditions::default());
        let (was, is) = (at(&q).translation, at(&off).transform(tool_m));
        let seen = device.transform(is);
        std::array::from_fn(|k| 1e3 * (seen[k] - was[k]))
    })
}

#[test]
fn a_tool_that_is_elsewhere_is_named_wherever_the_device_stands() {
    for (seed, x_m) in [(7, 1.1e-3), (8, 3e-3)] {
        let d = diagnosed(&elsewhere(seed, 0.0, [x_m, 0.0, 0.0]));
        let named: Vec<String> = d.found.iter().map(|f| f.effect.label()).collect();
        assert_eq!(named.len(), 1, "{named:?}");
        let found = &d.found[0].effect;
        assert!(found.kind == Kind::ToolFrame, "{named:?}");
        let off = found.parameters[0] - x_m;
        assert!(off.abs() < 5e-5, "{off}");
    }
}

#[test]
fn a_tool_that_is_where_it_was_is_not_named_wherever_the_device_stands() {
    for seed in [7, 8] {
        let d = diagnosed(&elsewhere(seed, 1e-3, [0.0; 3]));
        let named: Vec<String> = d.found.iter().map(|f| f.effect.label()).collect();
        assert_eq!(named.len(), 1, "{named:?}");
        let found = &d.found[0].effect;
        let is_zero = found.kind == Kind::LinkGeometry && found.site.index == 1;
        assert!(is_zero, "{named:?}");
    }
}

#[test]
fn a_wrong_load_is_that_of_the_tool_that_was_measured() {
    let base = case(group("clean"), 0, 7, 150);
    let name = base.profile.tools.keys().next().expect("its tool").clone();
    let tool = base.profile.tool(&name).expect("its tool");
    let mut heavy = tool.clone();
    heavy.load = tool.load.map(|(mass_kg, cog_m)| (mass_kg + 1.5, cog_m));
    let [light, heavy] =
        [tool, heavy].map(|tool| base.profile.real_model(&tool, &Conditions::default()));
    let mut measured = moved(base, |_, degrees| {
        let q = degrees.map(f64::to_radians);
        let at = |model: &Model| model.forward(&q, &Conditions::default()).translation;
        let (was, is) = (at(&light), at(&heavy));
        std::array::from_fn(|k| 1e3 * (is[k] - was[k]))
    });
    let rows = measured.csv.lines().enumerate();
    let csv: String = rows
        .map(|(row, line)| format!("{line},{}\n", if row == 0 { "tool" } else { &name }))
        .collect();
    measured = with_csv(measured, csv);
    let other = measured.profile.tools[&name].clone();
    measured.profile.tools.insert("other".into(), other);
    let d = diagnosed(&measured);
    let found = d.found.iter().find(|f| f.effect.kind == Kind::PayloadError);
    let found = found.expect("the load");
    assert_eq!(found.effect.site.tool.as_deref(), Some(&*name));
}

/// An arm that is as its profile says at 26 degrees, and grows by 12 ppm a degree. The device's lengths would do
/// what is left at the mean temperature.
#[test]
fn an_arm_that_grows_from_another_temperature_than_20_is_no_wrong_scale_of_the_device() {
    for seed in 1..4 {
        let base = case(group("clean"), 0, seed, 150);
        let name = base.profile.tools.keys().next().expect("its tool").clone();
        let tool = base.profile.tool(&name).expect("its tool");
        let model = base.profile.real_model(&tool, &Conditions::default());
        let off = tool.flange_from_tool.inverse();
        let stands = base.profile.world_from_base.translation;
        let celsius = |row: usize| 26.0 + 8.0 * row as f64 / 149.0;
        let warm = moved(base, |row, degrees| {
            let q = degrees.map(f64::to_radians);
            let flange = (model.forward(&q, &Conditions::default()) * off).translation;
            let grown = 12e-6 * (celsius(row) - 26.0);
            std::array::from_fn(|k| 1e3 * grown * (flange[k] - stands[k]))
        });
        let mut lines = warm.csv.lines();
        let header = lines
            .next()
            .expect("a header")
            .replace("temperature_c", "room");
        let mut csv = format!("{header},temperature_c\n");
        for (row, line) in lines.enumerate() {
            csv += &format!("{line},{:.2}\n", celsius(row));
        }
        let d = diagnosed(&with_csv(warm, csv));
        let named: Vec<Kind> = d.found.iter().map(|f| f.effect.kind).collect();
        assert_eq!(named, [Kind::ThermalGrowth], "{seed}");
        let [per_k, reference_c, ..] = d.found[0].effect.parameters;
        assert!((per_k - 12e-6).abs() < 4e-6, "{seed}: {per_k}");
        assert!((reference_c - 26.0).abs() < 2.0, "{seed}: {reference_c}");
    }
}

/// An arm that warms up, by 12 ppm a degree and 12 degrees, and nobody wrote down the temperature.
#[test]
fn an_arm_that_warms_up_without_a_thermometer_is_said_to_grow() {
    for seed in 1..4 {
        let base = case(group("clean"), 0, seed, 150);
        let name = base.profile.tools.keys().next().expect("its tool").clone();
        let tool = base.profile.tool(&name).expect("its tool");
        let model = base.profile.real_model(&tool, &Conditions::default());
        let off = tool.flange_from_tool.inverse() * base.profile.link6_from_flange.inverse();
        let stands = base.profile.world_from_base.translation;
        let warm = moved(base, |row, degrees| {
            let q = degrees.map(f64::to_radians);
            let end = (model.forward(&q, &Conditions::default()) * off).translation;
            // as its profile says in the middle
            let grown = 144e-6 * ((-75.0_f64 / 40.0).exp() - (-(row as f64) / 40.0).exp());
            std::array::from_fn(|k| 1e3 * grown * (end[k] - stands[k]))
        });
        let csv = warm.csv.replacen("temperature_c", "room", 1);
        let with = with_csv(warm, csv);
        let d = diagnosed(&with);
        let named: Vec<Kind> = d.found.iter().map(|f| f.effect.kind).collect();
        assert_eq!(named, [Kind::SessionGrowth], "{seed}");
        let [part, rows, ..] = d.found[0].effect.parameters;
        assert!((part - 144e-6).abs() < 30e-6, "{seed}: {part}");
        assert!((20.0..80.0).contains(&rows), "{seed}: {rows}");
        assert_eq!(d.found[0].standing, Standing::Likely);
        assert!(d.found[0].against[0].what.contains("measuring device"));
        // what a session does is none of the profile's
        assert_eq!(d.profile.effects, with.profile.effects);
    }
}

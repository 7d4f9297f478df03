//! What is not believed: effects of rows that fit no model, of a joint that comes from one side
//! only, of a tool that is mounted otherwise.

use super::commands::{case_with, diagnosed as by_command};
use super::standing::{found, moved};
use super::{group, with_csv};
use crate::trial::{Case, case};
use poseshift::diagnose::{Options, Standing, Verdict};
use poseshift::geometry::Pose;
use poseshift::identify::pick::Pick;
use poseshift::model::Conditions;
use poseshift::model::effects::Kind;

fn clean(seed: u64) -> Case {
    case(group("clean"), 0, seed, 150)
}

/// Joint angles in degrees to the tool's place, mm.
fn places(case: &Case) -> impl Fn([f64; 6]) -> [f64; 3] + use<> {
    let name = case.profile.tools.keys().next().expect("its tool");
    let tool = case.profile.tool(name).expect("its tool");
    let model = case.profile.real_model(&tool, &Conditions::default());
    move |degrees| {
        let pose = model.forward(&degrees.map(f64::to_radians), &Conditions::default());
        pose.translation.map(|x| 1e3 * x)
    }
}

#[test]
fn a_block_of_wrong_rows_makes_nothing_of_the_robot() {
    for seed in [4, 5] {
        let base = clean(seed);
        let at = places(&base);
        // joint 6 has the wrong sign in a third of the rows
        let wrong = moved(base, |row, q| {
            let mut turned = q;
            turned[5] = if (60..105).contains(&row) {
                -q[5]
            } else {
                q[5]
            };
            let (a, b) = (at(q), at(turned));
            std::array::from_fn(|k| b[k] - a[k])
        });
        let d = found(&wrong, &Options::default());
        assert_eq!(d.verdict, Verdict::Undetermined, "{:?}", d.reasons);
        assert!(
            d.reasons.iter().any(|r| r.contains("rows fit no model")),
            "{:?}",
            d.reasons
        );
        assert!(d.found.iter().all(|f| f.standing == Standing::Possible));
    }
}

/// The rows of a case as those of three reflectors, which are measured in turn.
fn of_three(case: Case) -> Case {
    let mut csv = String::new();
    for (row, line) in case.csv.lines().enumerate() {
        let point = match row {
            0 => "point",
            _ => ["A", "B", "C"][(row - 1) % 3],
        };
        csv += &format!("{line},{point}\n");
    }
    with_csv(case, csv)
}

/// Of three reflectors one slips: what it does is none of the robot, and the profile stays as good.
#[test]
fn a_reflector_that_slips_alone_is_named() {
    for (seed, mm) in [(4, 0.1), (5, 0.4), (6, 1.5)] {
        let base = clean(seed);
        let name = base.profile.tools.keys().next().expect("its tool");
        let tool = base.profile.tool(name).expect("its tool");
        let model = base.profile.real_model(&tool, &Conditions::default());
        let slipped = moved(base, |row, degrees| {
            let pose = model.forward(&degrees.map(f64::to_radians), &Conditions::default());
            let is_moved = row % 3 == 1 && row >= 80;
            pose.rotation * [if is_moved { mm } else { 0.0 }, 0.0, 0.0]
        });
        let d = found(&of_three(slipped), &Options::default());
        assert_eq!(d.verdict, Verdict::Explained, "{mm} mm: {:?}", d.reasons);
        let [slip] = &d.found[..] else {
            panic!("{mm} mm: {} effects", d.found.len());
        };
        assert_eq!(slip.effect.label(), "reflector_slip point 2 row 83");
        assert_eq!(slip.standing, Standing::Certain);
        assert!((1e3 * slip.effect.parameters[0] - mm).abs() < 0.03);
        let sentence = slip.effect.sentence(&slip.seen);
        assert!(
            sentence.contains("reflector B slipped before row 83"),
            "{sentence}"
        );
    }
}

/// Of three reflectors, measured in turn, one moves with the floor: between its rows stand those of
/// the others.
#[test]
fn rows_of_one_point_in_a_row_that_fit_no_model_are_missing_something() {
    let moved = moved(clean(4), |row, _| {
        let is_moved = row % 3 == 1 && row >= 105;
        [0.0, 0.0, if is_moved { 1.0 } else { 0.0 }]
    });
    let d = found(&of_three(moved), &Options::default());
    assert_eq!(d.verdict, Verdict::Undetermined, "{:?}", d.reasons);
    let is_said = |reason: &String| reason.contains("15 rows of point B one after another");
    assert!(d.reasons.iter().any(is_said), "{:?}", d.reasons);
}

#[test]
fn from_one_side_backlash_and_a_moved_zero_are_both_possible() {
    let base = clean(6);
    let at = places(&base);
    let moved = moved(base, |_, q| {
        let mut turned = q;
        turned[2] += 0.03;
        let (a, b) = (at(q), at(turned));
        std::array::from_fn(|k| b[k] - a[k])
    });
    let header = moved.csv.lines().next().expect("a header");
    let first = header.split(',').position(|cell| cell == "dir1");
    let first = first.expect("directions");
    let rows = moved.csv.lines().enumerate().map(|(row, line)| {
        let mut cells: Vec<&str> = line.split(',').collect();
        if row > 0 {
            cells[first..first + 6].fill("1");
        }
        cells.join(",") + "\n"
    });
    let csv = rows.collect();
    let one_sided = with_csv(moved, csv);
    let d = found(&one_sided, &Options::default());
    let zero = d.found.iter().find(|f| f.effect.kind == Kind::LinkGeometry);
    let zero = zero.expect("the zero of joint 3");
    assert_eq!(
        (zero.effect.site.index, zero.standing),
        (2, Standing::Likely)
    );
    assert!(
        zero.against.iter().any(|a| a.what.contains("backlash")),
        "{:?}",
        zero.against
    );
    assert_eq!(d.verdict, Verdict::Improved, "{:?}", d.reasons);
    assert!(
        d.reasons.iter().any(|r| r.contains("from one side (dir3")),
        "{:?}",
        d.reasons
    );
}

#[test]
fn a_tool_that_is_rotated_on_the_flange_is_not_diagnosed() {
    for (degrees, status) in [(3.0, 0), (40.0, 2)] {
        let base = clean(7);
        let name = base.profile.tools.keys().next().expect("its tool").clone();
        let tool = base.profile.tool(&name).expect("its tool");
        let model = base.profile.real_model(&tool, &Conditions::default());
        let turn = Pose::from_xyz_rxryrz([0.0, 0.0, 0.0, 0.0, 0.0, f64::to_radians(degrees)]);
        let flange = tool.flange_from_tool;
        // rotated about the flange's z: the tool from where it was
        let by = flange.inverse() * turn * flange;
        let header = "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg,x_mm,y_mm,z_mm,qw,qx,qy,qz\n";
        let rows = base.measurements.rows.iter().map(|row| {
            let pose = model.forward(&row.q, &Conditions::default()) * by;
            let [x, y, z] = pose.translation.map(|x| 1e3 * x);
            let [w, i, j, k] = pose.rotation.quaternion().0;
            let q = row.q.map(|q| q.to_degrees().to_string()).join(",");
            format!("{q},{x},{y},{z},{w},{i},{j},{k}\n")
        });
        let csv = rows.fold(header.to_owned(), |all, row| all + &row);
        let turned = with_csv(base, csv);
        let (found, _, error) = by_command(&turned, &[]);
        assert_eq!(found, status, "{degrees}: {error}");
        if status == 2 {
            assert!(
                error.contains("is rotated on the flange by 40.0 deg"),
                "{error}"
            );
            assert!(error.contains("calibrate --level 0"), "{error}");
        }
    }
}

#[test]
fn what_the_profile_has_already_is_said_with_the_new_value() {
    let base = clean(8);
    let effects = base.profile.effects.iter();
    let mut own = effects.filter(|e| e.kind == Kind::LinkGeometry && e.site.index == 2);
    let before = own.next().expect("link 3 of a calibration").parameters[3];
    let at = places(&base);
    let moved = moved(base, |_, q| {
        let mut turned = q;
        turned[2] += 0.03;
        let (a, b) = (at(q), at(turned));
        std::array::from_fn(|k| b[k] - a[k])
    });
    let d = found(&moved, &Options::default());
    let zero = d.found.iter().find(|f| f.effect.kind == Kind::LinkGeometry);
    let zero = zero.expect("the zero of joint 3");
    let was = zero.was.as_ref().expect("the profile has link 3");
    assert!((was.parameters[3] - before).abs() < 1e-12);
    let by = (zero.effect.parameters[3] - before).to_degrees().abs();
    assert!((by - 0.03).abs() < 0.003, "{by}");
    let (_, out, _) = by_command(&moved, &[]);
    assert!(out.contains("The profile has"), "{out}");
}

#[test]
fn a_noise_that_is_stated_far_too_large_is_said_and_hides_nothing() {
    let base = case_with("backlash");
    let mut lines = base.csv.lines();
    let mut csv = lines.next().expect("a header").to_owned() + "\n";
    for line in lines {
        let (cells, sigma) = line.rsplit_once(',').expect("several columns");
        let sigma: f64 = sigma.parse().expect("a number");
        csv += &format!("{cells},{}\n", 1000.0 * sigma);
    }
    let d = found(&with_csv(base, csv), &Options::default());
    assert_eq!(d.verdict, Verdict::Undetermined, "{:?}", d.reasons);
    assert!(d.remarks.iter().any(|r| r.id == "sigma-large"));
    assert!(
        d.reasons
            .iter()
            .any(|r| r.contains("too large by a factor"))
    );
    // 30 mm are stated
    assert!(d.residual_m < 1e-3, "{}", d.residual_m);
}

#[test]
fn one_lost_row_does_not_make_the_others_hopeless_and_many_do() {
    let lost = |rows: usize| {
        moved(case_with("backlash"), |row, _| match row % 11 {
            5 if row / 11 < rows => [3000.0, -2000.0, 1000.0],
            _ => [0.0; 3],
        })
    };
    let is_far = |reason: &String| reason.contains("no arm is that far");
    let d = found(&lost(1), &Options::default());
    assert!(!d.reasons.iter().any(is_far), "{:?}", d.reasons);
    assert_eq!(d.found.len(), 1);
    assert_eq!(d.found[0].effect.kind, Kind::Backlash);
    let d = found(&lost(6), &Options::default());
    assert!(d.reasons.iter().any(is_far), "{:?}", d.reasons);
    assert_eq!(d.verdict, Verdict::Undetermined);
}

#[test]
fn a_point_elsewhere_on_the_tool_is_said() {
    let base = clean(8);
    let name = base.profile.tools.keys().next().expect("its tool").clone();
    let tool = base.profile.tool(&name).expect("its tool");
    let model = base.profile.real_model(&tool, &Conditions::default());
    let by = |along_mm: f64| {
        let model = &model;
        move |_: usize, degrees: [f64; 6]| {
            let pose = model.forward(&degrees.map(f64::to_radians), &Conditions::default());
            let end = pose.transform([0.0, 0.0, along_mm]);
            std::array::from_fn(|k| end[k] - pose.translation[k])
        }
    };
    let said = |case: &Case| {
        let d = found(case, &Options::default());
        d.remarks.iter().any(|r| r.id == "tool-elsewhere")
    };
    assert!(said(&moved(clean(8), by(12.7))));
    assert!(!said(&base));
}

#[test]
fn what_the_measurements_say_against_an_accepted_effect_is_said() {
    let case = case_with("joint_scale");
    let own = found(&case, &Options::default());
    let right = own.found[0].effect.site.index + 1;
    let wrong = if right == 2 { 3 } else { 2 };
    let accepted = |word: &str| {
        let accept = Pick::parse_list(word).expect("a word");
        let options = Options {
            accept,
            ..Options::default()
        };
        found(&case, &options)
    };
    let d = accepted(&format!("joint_scale:{right}"));
    assert_eq!(d.verdict, Verdict::Explained, "{:?}", d.reasons);
    let d = accepted(&format!("backlash:{wrong}"));
    assert_ne!(d.verdict, Verdict::Explained);
    let said = d.reasons.join("\n");
    assert!(said.contains("was accepted"), "{said}");
    let better = format!("joint_scale joint {right} explains the measurements better");
    assert!(said.contains(&better), "{said}");
}

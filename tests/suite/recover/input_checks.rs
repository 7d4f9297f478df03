//! Files that are not what they seem, and robots that are not those of the profile: never a
//! confident wrong answer.

use super::identify::{DEG, MM, commands, effect, hidden, measure, nominal, worst_mm};
use crate::support::repository;
use poseshift::geometry::{Pose, Rotation};
use poseshift::identify::Calibration;
use poseshift::identify::calibration::{Options, calibrate};
use poseshift::identify::identifiability::WEAK;
use poseshift::identify::measurements::{Measurement, Measurements, Observed};
use poseshift::identify::parameters::{FIRST_PHYSICAL, Level, Selection};
use poseshift::identify::pick::Pick;
use poseshift::identify::robust::Shape;
use poseshift::identify::simulate::{Command, Device, Session};
use poseshift::model::effects::{Kind, Site};
use poseshift::model::profile::Profile;
use rand::SeedableRng;
use rand::rngs::StdRng;

fn session() -> Session {
    Session {
        noise_m: 0.03 * MM,
        seed: 3,
        ..Session::default()
    }
}

/// A compliant robot and a hundred of its postures.
fn robot(seed: u64) -> (Profile, Vec<Command>) {
    let mut random = StdRng::seed_from_u64(seed);
    let truth = hidden(&mut random, 0.5 * MM, 0.1 * DEG, true);
    let commands = commands(&mut random, &truth, 100);
    (truth, commands)
}

fn with(shape: Shape) -> Options {
    Options {
        shape,
        ..Options::default()
    }
}

fn reported(found: &Calibration, id: &str) -> bool {
    found.remarks.iter().any(|remark| remark.id == id)
}

fn changed(good: &Measurements, change: impl Fn(usize, &mut Measurement)) -> Measurements {
    let mut other = good.clone();
    for (i, row) in other.rows.iter_mut().enumerate() {
        change(i, row);
    }
    other
}

fn moved(row: &mut Measurement, by: impl Fn([f64; 3]) -> [f64; 3]) {
    match &mut row.observed {
        Observed::Position(p) => *p = by(*p),
        Observed::Pose(pose) => pose.translation = by(pose.translation),
        _ => unreachable!("positions and poses"),
    }
}

#[test]
fn gross_errors_are_outliers_and_bend_nothing() {
    let (truth, commands) = robot(41);
    let good = measure(&truth, &commands, &session());
    let clean = calibrate(&nominal(), &good, &Options::default()).expect("an answer");
    let (clean_mm, _) = worst_mm(&clean.profile(), &truth, 200);
    let far = |by: f64| {
        changed(&good, |i, row| {
            if i == 20 {
                moved(row, |[x, y, z]| [x + by, y, z]);
            }
        })
    };
    let mut exchanged = good.clone();
    exchanged.rows[7].observed = good.rows[60].observed;
    exchanged.rows[60].observed = good.rows[7].observed;
    let none = changed(&good, |i, row| {
        if i == 3 {
            moved(row, |_| [0.0; 3]);
        }
    });
    let tenth = changed(&good, |i, row| {
        if i % 10 == 5 {
            moved(row, |[x, y, z]| [x, y + 10.0 * MM, z]);
        }
    });
    for (name, bad, shape, lines) in [
        ("5 mm", far(5.0 * MM), Shape::Huber, 1),
        ("100 mm", far(100.0 * MM), Shape::Huber, 1),
        ("300 mm", far(0.3), Shape::Tukey, 1),
        ("1 km", far(1000.0), Shape::Huber, 1),
        ("exchanged", exchanged, Shape::Huber, 2),
        ("origin", none, Shape::Huber, 1),
        ("a tenth", tenth, Shape::Tukey, 10),
    ] {
        let found =
            calibrate(&nominal(), &bad, &with(shape)).unwrap_or_else(|e| panic!("{name}: {e}"));
        let (mean, _) = worst_mm(&found.profile(), &truth, 200);
        assert_eq!(found.outliers.len(), lines, "{name}");
        assert_eq!(
            found.solution.parameters.len(),
            clean.solution.parameters.len(),
            "{name}"
        );
        assert!(mean < 1.5 * clean_mm, "{name}: {mean} mm, clean {clean_mm}");
    }
}

#[test]
fn a_bad_orientation_is_an_outlier_and_orientations_of_something_else_are_refused() {
    let (truth, commands) = robot(42);
    let poses = Session {
        device: Device::Pose,
        noise_rad: 1e-4,
        ..session()
    };
    let good = measure(&truth, &commands, &poses);
    let turned = |i_wanted: Option<usize>, by: &dyn Fn(Rotation) -> Rotation| {
        changed(&good, |i, row| {
            if let Observed::Pose(pose) = &mut row.observed
                && i_wanted.is_none_or(|wanted| i == wanted)
            {
                pose.rotation = by(pose.rotation);
            }
        })
    };
    let clean = calibrate(&nominal(), &good, &Options::default()).expect("an answer");
    let (clean_mm, _) = worst_mm(&clean.profile(), &truth, 200);
    let quarter = |r: Rotation| r * Rotation::about_x(90.0 * DEG);
    for row in [0, 30] {
        let one = turned(Some(row), &quarter);
        let found = calibrate(&nominal(), &one, &Options::default()).expect("an answer");
        let (mean, _) = worst_mm(&found.profile(), &truth, 200);
        assert_eq!(found.outliers.len(), 1, "row {row}");
        assert!(
            mean < 1.5 * clean_mm,
            "row {row}: {mean} mm, clean {clean_mm}"
        );
    }
    for (bad, word) in [
        (turned(None, &|_| Rotation::identity()), "same orientation"),
        (turned(None, &|r| r.transpose()), "orientation"),
    ] {
        let error = calibrate(&nominal(), &bad, &Options::default()).expect_err("nonsense");
        assert!(error.to_string().contains(word), "{error}");
    }
}

#[test]
fn units_zeros_and_orders_of_other_makers_are_suggested() {
    let (truth, commands) = robot(43);
    let good = measure(&truth, &commands, &session());
    let refused = |change: &dyn Fn(usize, &mut Measurement)| {
        let bad = changed(&good, change);
        match calibrate(&nominal(), &bad, &Options::default()) {
            Err(error) => error.to_string(),
            Ok(found) => panic!("believed with {:?}", found.after),
        }
    };
    let by =
        |factor: f64| move |_: usize, row: &mut Measurement| moved(row, |p| p.map(|x| x * factor));
    assert!(refused(&by(0.1)).contains("centimetres"));
    assert!(refused(&by(1.0 / 304.8)).contains("feet"));
    assert!(refused(&by(1.0 / 25.4)).contains("inches"));
    let both = refused(&|_, row| {
        row.q = row.q.map(|q| q * DEG);
        moved(row, |p| p.map(|x| x / 1000.0));
    });
    assert!(both.contains("radians and the lengths metres"), "{both}");
    let zero = refused(&|_, row| row.q[1] += 90.0 * DEG);
    assert!(zero.contains("zero of joint 2 is -90 deg"), "{zero}");
    let two = refused(&|_, row| {
        row.q[1] = -row.q[1];
        row.q[4] = -row.q[4];
    });
    assert!(two.contains("joints 2 and 5 count the other way"), "{two}");
    let coupled = refused(&|_, row| row.q[2] += row.q[1]);
    assert!(coupled.contains("from the horizontal"), "{coupled}");
    let order = refused(&|_, row| row.q.reverse());
    assert!(order.contains("opposite order"), "{order}");
    // every odd exchange of axes fits alike: the one that leaves the base upright is named
    let swapped = refused(&|_, row| moved(row, |[x, y, z]| [y, x, z]));
    assert!(
        swapped.contains("if the columns x_mm and y_mm are swapped"),
        "{swapped}"
    );
    // of a device that lies on a corner no exchange does
    let lying = Rotation::about_x(0.7) * Rotation::about_y(0.6);
    let mirrored = refused(&|_, row| {
        moved(row, |p| {
            let [x, y, z] = lying * p;
            [y, x, z]
        });
    });
    assert!(
        mirrored.contains("if they are a mirror image") && mirrored.contains("x_mm and z_mm"),
        "{mirrored}"
    );
}

#[test]
fn a_frame_on_its_side_is_reported() {
    let (truth, commands) = robot(44);
    let good = measure(&truth, &commands, &session());
    let lying = changed(&good, |_, row| moved(row, |[x, y, z]| [y, z, x]));
    let found = calibrate(&nominal(), &lying, &Options::default()).expect("it fits");
    assert!(reported(&found, "base-tilted"), "{:?}", found.remarks);
    let found = calibrate(&nominal(), &good, &Options::default()).expect("it fits");
    assert!(found.remarks.is_empty(), "{:?}", found.remarks);
}

#[test]
fn of_a_robot_on_a_wall_the_heading_of_the_device_is_no_tilt() {
    let (truth, commands) = robot(44);
    let quarter = std::f64::consts::FRAC_PI_2;
    let on_wall = |turned: f64| {
        Pose::from_xyz_rxryrz([0.0, 0.0, 1.2, 0.0, quarter, 0.0])
            * Pose::from_xyz_rxryrz([0.0, 0.0, 0.0, 0.0, 0.0, turned])
    };
    let standing = |of: &Profile, base: Pose| Profile {
        world_from_base: base,
        ..of.clone()
    };
    let profile = standing(&nominal(), on_wall(0.0));
    let found = |truth_base: Pose, heading: f64| {
        let device = Pose::from_xyz_rxryrz([2.0, -1.0, 0.3, 0.0, 0.0, heading]);
        let seen = measure(&standing(&truth, truth_base), &commands, &session());
        let seen = seen.moved(&device.inverse());
        let found = calibrate(&profile, &seen, &Options::default()).expect("it fits");
        reported(&found, "base-tilted")
    };
    for heading in [0.0, 0.5, 2.3] {
        assert!(!found(on_wall(0.0), heading), "{heading}");
        // rotated about its own axis 1, gravity acts elsewhere
        assert!(found(on_wall(quarter), heading), "{heading}");
    }
}

#[test]
fn another_robot_is_refused() {
    let (truth, commands) = robot(45);
    let seen = measure(&truth, &commands, &session());
    let text = std::fs::read_to_string(repository("robots/abb_irb1600_6_145.yaml"));
    let mut other = Profile::from_yaml(&text.expect("a shipped profile")).expect("a profile");
    other.effects.clear();
    other.tools = nominal().tools;
    let error = calibrate(&other, &seen, &Options::default()).expect_err("it is another robot");
    let text = error.to_string();
    assert!(
        text.contains("typical size") || text.contains("mm rms"),
        "{text}"
    );
    assert!(error.hint().contains("this robot"), "{}", error.hint());
}

#[test]
fn a_tool_that_is_fixed_and_elsewhere_is_refused() {
    let (truth, commands) = robot(46);
    let seen = measure(&truth, &commands, &session());
    let mut longer = nominal();
    let tool = longer.tools.get_mut("artifact").expect("its tool");
    tool.flange_from_tool =
        tool.flange_from_tool * Pose::from_xyz_rxryrz([0.1, 0.0, 0.1, 0.0, 0.0, 0.0]);
    let mut options = Options::default();
    options.selection.fix = Pick::parse_list("tool_frame").expect("a word");
    let error = calibrate(&longer, &seen, &options).expect_err("it contradicts");
    assert!(
        error.to_string().contains("141") && error.hint().contains("--fix tool_frame"),
        "{error}; {}",
        error.hint()
    );
}

#[test]
fn distances_from_one_or_two_points_leave_the_base_s_turn_to_the_profile() {
    let (truth, commands) = robot(47);
    for from in [
        vec![[0.9, 0.8, 0.2]],
        vec![[0.9, 0.8, 0.2], [1.1, -0.7, 0.4]],
    ] {
        let count = from.len();
        let distances = Session {
            device: Device::Distance(from),
            ..session()
        };
        let seen = measure(&truth, &commands, &distances);
        // the device's frame is turned from what the profile believes
        let mut turned = nominal();
        turned.world_from_base =
            turned.world_from_base * Pose::from_xyz_rxryrz([0.0, 0.0, 0.0, 0.0, 0.0, 40.0 * DEG]);
        let found = calibrate(&turned, &seen, &Options::default()).expect("an answer");
        assert!(
            reported(&found, "base-not-determined"),
            "{count}: {:?}",
            found.remarks
        );
        let bad = changed(&seen, |_, row| row.q.swap(1, 2));
        let error = calibrate(&nominal(), &bad, &Options::default()).expect_err("swapped");
        assert!(
            error.to_string().contains("q2_deg and q3_deg are swapped"),
            "{error}"
        );
    }
}

#[test]
fn measurements_that_tell_nothing_of_the_arm_elsewhere_are_reported() {
    let (truth, all) = robot(48);
    let found = calibrate(
        &nominal(),
        &measure(&truth, &all, &session()),
        &Options::default(),
    )
    .expect("an answer");
    let expected = found.expected_m.expect("positions") / MM;
    let (mean, _) = worst_mm(&found.profile(), &truth, 300);
    assert!(
        expected < 0.1 && mean < 2.0 * expected,
        "{mean} of {expected}"
    );
    // every joint within two degrees
    let narrow: Vec<Command> = all
        .iter()
        .map(|c| Command {
            q: std::array::from_fn(|i| 0.4 + 0.02 * (c.q[i] - all[0].q[i])),
            stand: c.stand.clone(),
            plate: None,
            direction: None,
            force_n: [0.0; 3],
        })
        .collect();
    let seen = measure(&truth, &narrow, &session());
    let found = calibrate(&nominal(), &seen, &Options::default()).expect("an answer");
    assert!(
        reported(&found, "hardly-determined"),
        "{:?} {:?}",
        found.expected_m,
        found.remarks
    );
    // ten postures ten times each
    let few: Vec<Command> = all.iter().take(10).cycle().take(100).cloned().collect();
    let error = calibrate(
        &nominal(),
        &measure(&truth, &few, &session()),
        &Options::default(),
    )
    .expect_err("30 numbers");
    assert!(error.to_string().contains("are too few"), "{error}");
}

#[test]
fn no_value_of_the_arm_is_kept_that_is_hardly_known() {
    let mut weak = 0;
    for seed in 0..8 {
        let mut random = StdRng::seed_from_u64(seed);
        let truth = hidden(&mut random, 0.5 * MM, 0.1 * DEG, true);
        let seen = measure(&truth, &commands(&mut random, &truth, 30), &session());
        let found = calibrate(&nominal(), &seen, &Options::default()).expect("an answer");
        let (mean, _) = worst_mm(&found.profile(), &truth, 200);
        assert!(mean < 0.1, "seed {seed}: {mean} mm");
        for (parameter, value, sigma) in found.parameters() {
            let physical = parameter.rank >= FIRST_PHYSICAL;
            let known = sigma.is_none_or(|sigma| sigma < 1.5 * WEAK * parameter.scale);
            assert!(!physical || known, "{} {value} ± {sigma:?}", parameter.key);
        }
        weak += found
            .solution
            .identifiable
            .dropped
            .iter()
            .filter(|dropped| dropped.weak.is_some())
            .count();
    }
    assert!(weak > 0, "somewhere something is hardly known");
}

#[test]
fn effects_that_show_only_besides_others_are_identified_with_them() {
    let (mut truth, commands) = robot(49);
    let mut heavier = effect(Kind::PayloadError, 0, &[1.0, 0.0, 0.0, 0.0]);
    heavier.site = Site {
        tool: Some("artifact".into()),
        ..Site::default()
    };
    truth.effects.push(heavier);
    let seen = measure(&truth, &commands, &session());
    let mut selection = Selection::level(Level::Compliance);
    selection.identify = Pick::parse_list("payload_error.mass_kg").expect("a word");
    let options = Options {
        selection,
        ..Options::default()
    };
    let found = calibrate(&nominal(), &seen, &options).expect("an answer");
    let mass = found
        .parameters()
        .find(|(p, _, _)| p.key.contains("mass_kg"))
        .expect("it was asked for");
    let sigma = mass.2.expect("it is determined");
    assert!((mass.1 - 1.0).abs() < 4.0 * sigma, "{} ± {sigma}", mass.1);
}

#[test]
fn missing_masses_negative_springs_and_unlikely_sigmas_are_reported() {
    let (truth, commands) = robot(50);
    let seen = measure(&truth, &commands, &session());
    let mut light = nominal();
    light.bodies.clear();
    for tool in light.tools.values_mut() {
        tool.load = None;
    }
    let found = calibrate(&light, &seen, &Options::default()).expect("an answer");
    assert!(reported(&found, "no-masses"), "{:?}", found.remarks);
    // the arm's own masses alone
    light.bodies = nominal().bodies;
    let found = calibrate(&light, &seen, &Options::default()).expect("an answer");
    assert!(reported(&found, "no-tool-mass"), "{:?}", found.remarks);
    let found = calibrate(&nominal(), &seen, &Options::default()).expect("an answer");
    assert!(!reported(&found, "no-tool-mass"), "{:?}", found.remarks);
    for factor in [1e-3, 1e3] {
        let other = changed(&seen, |_, row| {
            row.sigma_m = row.sigma_m.map(|sigma| factor * sigma);
        });
        let found = calibrate(&nominal(), &other, &Options::default()).expect("an answer");
        let id = if factor < 1.0 {
            "sigma-small"
        } else {
            "sigma-large"
        };
        assert!(reported(&found, id), "{factor}: {:?}", found.remarks);
    }
    let mut springs = truth;
    springs.effects.retain(|e| e.kind != Kind::JointCompliance);
    springs
        .effects
        .push(effect(Kind::JointCompliance, 1, &[-2e-4]));
    let seen = measure(&springs, &commands, &session());
    let found = calibrate(&nominal(), &seen, &Options::default()).expect("an answer");
    assert!(
        reported(&found, "negative-compliance"),
        "{:?}",
        found.remarks
    );
}

#[test]
fn a_device_whose_scale_is_wrong_is_reported() {
    let scaled =
        |seen: &Measurements, by: f64| changed(seen, |_, row| moved(row, |p| p.map(|x| by * x)));
    for seed in [43, 44, 45] {
        let (truth, commands) = robot(seed);
        let seen = measure(&truth, &commands, &session());
        for (by, expected) in [(1.0, false), (1.01, true), (0.99, true)] {
            let other = scaled(&seen, by);
            let found = calibrate(&nominal(), &other, &Options::default()).expect("an answer");
            assert_eq!(reported(&found, "scale"), expected, "{seed}, {by}");
        }
    }
}

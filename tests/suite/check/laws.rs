//! What is promised about everything between samples, against dense sampling by other means.

use super::{THESIS, joint_move, part, profile, rapid, run};
use crate::support::text;
use nalgebra::{Isometry3, Point3, Vector3};
use poseshift::check::Options;
use poseshift::check::cell::Cell;
use poseshift::inverse::Arm;
use poseshift::model::profile::{Mounted, Profile, SHIPPED};
use poseshift::model::shape::Form;
use poseshift::model::{Conditions, Model};

/// How far joints keep from narrow limits: 0.05 degrees.
const LITTLE_RAD: f64 = 8.7e-4;

/// Dense sampling misses the extreme by less than this, mm.
const SAMPLING_MM: f64 = 1e-4;

fn random_joints(profile: &Profile, state: &mut u64, part_of_range: f64) -> [f64; 6] {
    std::array::from_fn(|i| {
        let joint = &profile.mechanism.joints[i];
        let (low, high) = (joint.min_rad.max(-3.0), joint.max_rad.min(3.0));
        let middle = 0.5 * (low + high);
        (middle + (part(state) - 0.5) * part_of_range * (high - low)).to_degrees()
    })
}

fn moved(a: &[f64; 6], b: &[f64; 6], s: f64) -> [f64; 6] {
    std::array::from_fn(|i| (a[i] + s * (b[i] - a[i])).to_radians())
}

#[test]
fn no_point_of_a_joint_move_is_farther_off_than_its_bound() {
    let profile = profile(THESIS);
    let tool = profile.tool("artifact").expect("its tool");
    let conditions = Conditions::default();
    let (real, nominal) = (
        profile.real_model(&tool, &conditions),
        profile.controller_model(&tool),
    );
    let mut state = 1;
    for _ in 0..25 {
        let (a, b) = (
            random_joints(&profile, &mut state, 0.8),
            random_joints(&profile, &mut state, 0.8),
        );
        let sources = rapid(&(joint_move(a) + &joint_move(b)));
        let found = run(&profile, None, &sources, None, &Options::default());
        let path = found.moves[1].path.expect("it comes from the first");
        assert!(path.certified);
        let (mut far, mut turned) = (0.0_f64, 0.0_f64);
        for k in 0..=4000 {
            let q = moved(&a, &b, f64::from(k) / 4000.0);
            let gap = real
                .forward(&q, &conditions)
                .separation(&nominal.forward(&q, &conditions));
            far = far.max(gap.distance_m);
            turned = turned.max(gap.angle_rad);
        }
        let bound = path.bound;
        assert!(
            far <= bound.distance_m && turned <= bound.angle_rad + 1e-12,
            "{far} {path:?}"
        );
        assert!(bound.distance_m <= 1.02 * far + 3e-6, "{far} {path:?}");
        assert!(bound.angle_rad <= 1.05 * turned + 1e-5, "{turned} {path:?}");
    }
}

fn isometry(pose: poseshift::geometry::Pose) -> Isometry3<f64> {
    pose.into()
}

/// Straight moves of a profile's arm with its tool `artifact`, against a thousand points of each.
fn compare_straight_moves(profile: &Profile) {
    let tool = profile.tool("artifact").expect("its tool");
    let conditions = Conditions::default();
    let (real, nominal) = (
        profile.real_model(&tool, &conditions),
        profile.controller_model(&tool),
    );
    let arm = Arm::of(&profile.geometry(&tool), &profile.mechanism).expect("a closed form");
    let (mut state, mut compared) = (7, 0);
    for _ in 0..60 {
        let a = random_joints(profile, &mut state, 0.5);
        let b: [f64; 6] = std::array::from_fn(|i| a[i] + 25.0 * (part(&mut state) - 0.5));
        let pose = nominal.forward(&b.map(f64::to_radians), &conditions);
        let t = pose
            .translation
            .map(|x| format!("{:.4}", 1000.0 * x))
            .join(",");
        let q = pose
            .rotation
            .quaternion()
            .0
            .map(|x| format!("{x:.9}"))
            .join(",");
        let line = format!(
            "    ConfL\\Off;\n    MoveL \
             [[{t}],[{q}],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,artifact;\n"
        );
        let sources = rapid(&(joint_move(a) + &line));
        let found = run(profile, None, &sources, None, &Options::default());
        if found.is_refused() || found.moves.len() < 2 {
            continue;
        }
        let path = found.moves[1].path.expect("it comes from the first");
        if !path.certified {
            continue;
        }
        let start = a.map(f64::to_radians);
        let branch = arm.posture(&start).0;
        let (from, to) = (
            isometry(nominal.forward(&start, &conditions)),
            isometry(nominal.forward(found.joints(&found.moves[1]), &conditions)),
        );
        let (mut near, mut far, mut rate) = (start, 0.0_f64, 0.0_f64);
        let (mut low, mut high) = (start, start);
        for k in 0..=1000 {
            let s = f64::from(k) / 1000.0;
            let between = from.lerp_slerp(&to, s);
            let q = between.rotation.quaternion();
            let pose = poseshift::geometry::Pose::from_parts(
                between.translation.vector.into(),
                poseshift::geometry::Quaternion([q.w, q.i, q.j, q.k]),
            );
            let next = arm.solve_branch(&pose, branch, &near);
            assert_eq!(next.beyond, 0.0, "{path:?}");
            let leap = (0..6)
                .map(|i| (next.q[i] - near[i]).abs())
                .fold(0.0, f64::max);
            if k > 0 {
                rate = rate.max(1000.0 * leap);
            }
            assert!(
                k == 0 || leap < 0.3,
                "{s} {:?} {near:?} {:?}",
                next.q,
                arm.posture(&near).1
            );
            near = next.q;
            low = std::array::from_fn(|i| low[i].min(near[i]));
            high = std::array::from_fn(|i| high[i].max(near[i]));
            let landed = real.forward(&near, &conditions);
            far =
                far.max((isometry(landed).translation.vector - between.translation.vector).norm());
        }
        assert!(far <= path.bound.distance_m + 1e-9, "{far} {path:?}");
        assert!(path.bound.distance_m <= 1.02 * far + 4e-6, "{far} {path:?}");
        let reported = found.moves[1].limits.expect("limits").rate_rad;
        assert!(
            reported > 0.97 * rate - 1e-6 && reported < 1.05 * rate + 1e-6,
            "{reported} {rate}"
        );
        // limits that all joints keep by little
        let mut narrow = profile.clone();
        for (i, joint) in narrow.mechanism.joints.iter_mut().enumerate() {
            (joint.min_rad, joint.max_rad) = (low[i] - LITTLE_RAD, high[i] + LITTLE_RAD);
        }
        let found = run(&narrow, None, &sources, None, &Options::default());
        let margin = found.moves[1].limits.expect("limits").margin_rad;
        assert!(
            margin < LITTLE_RAD + 1e-7 && margin > LITTLE_RAD - 1e-4,
            "{margin} {LITTLE_RAD}"
        );
        compared += 1;
    }
    assert!(compared >= 30, "{compared}");
}

#[test]
fn no_point_of_a_straight_move_is_farther_off_than_its_bound() {
    compare_straight_moves(&profile(THESIS));
}

#[test]
fn the_same_holds_where_joint_6_is_found_by_iteration() {
    let effects = "effects:
    - {effect: link_geometry, link: 2, a_mm: 0.3, alpha_deg: 0.05, theta_deg: -0.12}
    - {effect: link_geometry, link: 6, alpha_deg: -0.08, a_mm: 0.25}
";
    let tool = "tools:
  artifact: {frame: {x_mm: 50, y_mm: 25, z_mm: 100, rx_deg: 0, ry_deg: 0, rz_deg: 0}}";
    let nominal = text("robots/yaskawa_ma1400.yaml");
    let calibrated = nominal
        .replace("effects: []", effects)
        .replace("tools: {}", tool);
    compare_straight_moves(&Profile::from_yaml(&calibrated).expect("a calibrated profile"));
}

/// Distance of a point from a body of a cell.
fn outside(form: &Form, place: &Isometry3<f64>, point: &Point3<f64>) -> f64 {
    let p = place.inverse_transform_point(point);
    match form {
        Form::Box { size_m } => {
            let out = Vector3::from_fn(|i, _| (p[i].abs() - 0.5 * size_m[i]).max(0.0));
            out.norm()
        }
        Form::Sphere { radius_m } => (p.coords.norm() - radius_m).max(0.0),
        Form::Cylinder { radius_m, height_m } => {
            let across = (p.x.hypot(p.y) - radius_m).max(0.0);
            across.hypot((p.z.abs() - 0.5 * height_m).max(0.0))
        }
        Form::Plane { normal, offset_m } => {
            (p.coords.dot(&Vector3::from(*normal)) - offset_m).max(0.0)
        }
        _ => unreachable!("not in these scenes"),
    }
}

/// Least value of a convex function over [0, 1].
fn least(f: &dyn Fn(f64) -> f64) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..60 {
        let (a, b) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
        if f(a) < f(b) {
            high = b;
        } else {
            low = a;
        }
    }
    f(0.5 * (low + high)).min(f(0.0)).min(f(1.0))
}

/// Least distance of the arm from the cell's bodies and of its far links from each other, at one
/// posture, metres.
fn clearance(profile: &Profile, cell: &Cell, model: &Model, q: &[f64; 6]) -> f64 {
    let frames = model.link_frames(q, &Conditions::default()).map(isometry);
    let rods: Vec<(usize, Point3<f64>, Point3<f64>, f64)> = profile
        .shapes
        .iter()
        .map(|shape| {
            let Form::Capsule {
                from_m,
                to_m,
                radius_m,
            } = shape.shape.form
            else {
                unreachable!("shipped shapes are capsules")
            };
            let end = |p: [f64; 3]| frames[shape.link] * Point3::from(p);
            (shape.link, end(from_m), end(to_m), radius_m)
        })
        .collect();
    let along = |a: &Point3<f64>, b: &Point3<f64>, t: f64| a + t * (b - a);
    let mut nearest = f64::INFINITY;
    for (i, (link, a, b, radius)) in rods.iter().enumerate() {
        if *link > 0 {
            for body in &cell.bodies {
                let place = isometry(body.shape.frame_from_shape);
                let gap = least(&|t| outside(&body.shape.form, &place, &along(a, b, t)));
                nearest = nearest.min((gap - radius).max(0.0));
            }
        }
        for (other, c, d, thick) in &rods[..i] {
            if link.abs_diff(*other) >= 3 {
                let gap = least(&|t| least(&|u| (along(a, b, t) - along(c, d, u)).norm()));
                nearest = nearest.min((gap - radius - thick).max(0.0));
            }
        }
    }
    nearest
}

fn random_cell(state: &mut u64) -> Cell {
    let mut number = |low: f64, high: f64| low + (high - low) * part(state);
    let mut text = String::from("poseshift: cell/1\nbodies:\n");
    for k in 0..3 {
        let (r, a) = (number(350.0, 700.0), number(-3.1, 3.1));
        let at = format!(
            "at: {{x_mm: {}, y_mm: {}, z_mm: {}, rx_deg: {}, ry_deg: {}, rz_deg: {}}}",
            r * a.cos(),
            r * a.sin(),
            number(100.0, 700.0),
            number(-90.0, 90.0),
            number(-90.0, 90.0),
            number(-90.0, 90.0)
        );
        let form = match k {
            0 => format!(
                "box_mm: [{}, {}, {}]",
                number(5.0, 100.0),
                number(5.0, 100.0),
                number(5.0, 200.0)
            ),
            1 => format!(
                "cylinder_mm: {{radius: {}, height: {}}}",
                number(5.0, 50.0),
                number(10.0, 200.0)
            ),
            _ => format!("sphere_mm: {{radius: {}}}", number(5.0, 60.0)),
        };
        text += &format!("  - {{name: b{k}, {form}, {at}}}\n");
    }
    text += "  - {name: floor, plane: {normal: [0, 0, 1], offset_mm: -40}}\n";
    Cell::from_yaml(&text).expect("a cell")
}

#[test]
fn clearance_is_that_of_dense_sampling_and_never_more() {
    let profile = profile(THESIS);
    let tool = profile.tool("artifact").expect("its tool");
    let real = profile.real_model(&tool, &Conditions::default());
    let (mut state, mut apart) = (3, 0);
    let options = Options {
        horizon_m: 1.0,
        ..Options::default()
    };
    for _ in 0..40 {
        let cell = random_cell(&mut state);
        let a = random_joints(&profile, &mut state, 0.5);
        let b: [f64; 6] = std::array::from_fn(|i| a[i] + 40.0 * (part(&mut state) - 0.5));
        let sources = rapid(&(joint_move(a) + &joint_move(b)));
        let found = run(&profile, Some(&cell), &sources, None, &options);
        let reported = found.moves[1]
            .clearance
            .as_deref()
            .expect("there are bodies");
        assert!(reported.certified);
        let at = |s: f64| clearance(&profile, &cell, &real, &moved(&a, &b, s));
        let steps = 150;
        let best = (0..=steps)
            .map(|k| f64::from(k) / f64::from(steps))
            .min_by(|s, t| at(*s).total_cmp(&at(*t)))
            .expect("samples");
        let step = 1.0 / f64::from(steps);
        let (low, high) = ((best - step).max(0.0), (best + step).min(1.0));
        let dense = (0..=60)
            .map(|k| at(low + (high - low) * f64::from(k) / 60.0))
            .fold(at(best), f64::min);
        let (reported_mm, dense_mm) = (1e3 * reported.clearance_m, 1e3 * dense);
        assert!(reported_mm <= dense_mm + 1e-6, "{reported_mm} {dense_mm}");
        // the bound's own slack is 0.005 mm; the rest is what sampling misses
        assert!(
            dense_mm - reported_mm <= 0.01 + 50.0 * SAMPLING_MM,
            "{reported_mm} {dense_mm}"
        );
        apart += usize::from(dense > 0.0);
    }
    assert!(apart >= 10, "{apart}");
}

#[test]
fn a_wall_of_1_mm_between_two_targets_is_found_though_no_target_touches_it() {
    let profile = profile(THESIS);
    let cell = |y: f64| {
        let text = format!(
            "poseshift: cell/1\nclearance_mm: 2\nbodies:\n  - {{name: wall, box_mm: [200, 1, 200], \
             at: {{x_mm: 480, y_mm: {y}, z_mm: 500, rx_deg: 0, ry_deg: 0, rz_deg: 0}}}}\n"
        );
        Cell::from_yaml(&text).expect("a cell")
    };
    let (a, b) = (
        [-60.0, 10.0, 0.0, 0.0, 30.0, 0.0],
        [60.0, 10.0, 0.0, 0.0, 30.0, 0.0],
    );
    let sources = rapid(&(joint_move(a) + &joint_move(b)));
    // anywhere between the two, so that no fixed set of samples would do
    for y in [-173.3, -59.1, 0.7, 31.9, 101.3] {
        let found = run(
            &profile,
            Some(&cell(y)),
            &sources,
            None,
            &Options::default(),
        );
        let clear = found.moves[0].clearance.as_deref().expect("bodies");
        assert!(clear.clearance_m > 0.01, "the start is clear: {clear:?}");
        let finding = found
            .findings
            .iter()
            .find(|f| f.id == "collision")
            .expect("the wall is found");
        assert!(
            finding.message.contains("wall") && finding.line == 5,
            "{finding:?}"
        );
        assert!(found.is_refused());
    }
    assert!(
        !run(
            &profile,
            Some(&cell(900.0)),
            &sources,
            None,
            &Options::default()
        )
        .is_refused()
    );
}

#[test]
fn a_collision_that_only_the_real_arm_has_is_named() {
    let profile = profile(THESIS);
    let tool = profile.tool("artifact").expect("its tool");
    let q = [0.0, 20.0, 10.0, 0.0, 30.0, 0.0];
    let conditions = Conditions::default();
    let frame =
        |model: &Model| model.link_frames(&moved(&q, &q, 0.0), &conditions)[6].translation[2];
    let (real, nominal) = (
        frame(&profile.real_model(&tool, &conditions)),
        frame(&profile.controller_model(&tool)),
    );
    assert!(nominal - real > 1e-3, "the real arm sags");
    // a ball just below the last link of the nominal arm
    let at = profile
        .controller_model(&tool)
        .link_frames(&moved(&q, &q, 0.0), &conditions)[6]
        .translation;
    let text = format!(
        "poseshift: cell/1\nbodies:\n  - {{name: ball, sphere_mm: {{radius: 1}}, at: {{x_mm: {}, \
         y_mm: {}, z_mm: {}, rx_deg: 0, ry_deg: 0, rz_deg: 0}}}}\nattached: [{{name: tip, to: \
         link6, sphere_mm: {{radius: 20}}}}]\npairs: [{{a: link5, b: ball, allow: true}}, {{a: \
         link6, b: ball, allow: true}}, {{a: link4, b: ball, allow: true}}]\n",
        1e3 * at[0],
        1e3 * at[1],
        1e3 * at[2] - 21.0 - 0.5 * 1e3 * (nominal - real)
    );
    let cell = Cell::from_yaml(&text).expect("a cell");
    let sources = rapid(&joint_move(q));
    let found = run(&profile, Some(&cell), &sources, None, &Options::default());
    let finding = found
        .findings
        .iter()
        .find(|f| f.id == "collision")
        .expect("it is found");
    assert!(
        finding.message.contains("the nominal arm stays clear by"),
        "{}",
        finding.message
    );
    assert_eq!(
        (found.summary.collisions, found.summary.nominal_collisions),
        (1, 0)
    );
}

#[test]
fn shipped_arms_have_a_body_for_each_link_and_do_not_touch_themselves_in_the_middle_of_their_ranges()
 {
    for (name, text) in SHIPPED {
        let profile = profile(text);
        for link in 0..=6 {
            assert!(
                profile.shapes.iter().any(|s| s.link == link),
                "{name} link {link}"
            );
        }
        let mechanism = &profile.mechanism;
        let straight = mechanism
            .joints
            .map(|joint| 0.0_f64.clamp(joint.min_rad, joint.max_rad));
        let model = profile.controller_model(&Mounted::flange());
        let gap = clearance(&profile, &Cell::default(), &model, &straight);
        assert!(gap > 0.0, "{name} touches itself at zero");
        // each body is where its link is: within half a metre of the way from its frame to the next
        let frames = model.link_frames(&straight, &Conditions::default());
        for shape in &profile.shapes {
            let Form::Capsule {
                from_m,
                to_m,
                radius_m,
            } = shape.shape.form
            else {
                panic!("{name}: a capsule")
            };
            let middle: [f64; 3] = std::array::from_fn(|i| 0.5 * (from_m[i] + to_m[i]));
            let here = frames[shape.link].transform(middle);
            let gap = |i: usize| {
                let o = frames[i].translation;
                (0..3).map(|k| (o[k] - here[k]).powi(2)).sum::<f64>().sqrt()
            };
            let near = gap(shape.link).min(gap((shape.link + 1).min(6)));
            assert!(
                near < 0.5 + radius_m,
                "{name} link {} is {near} m off",
                shape.link
            );
        }
    }
}

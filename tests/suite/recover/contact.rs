//! A probe's ball touches spheres, planes and points: what it touched and the arm that touched it
//! must be found again.

use crate::support::{poseshift, random_joints, repository, scratch};
use nalgebra::{Matrix3, SMatrix, SVector, Vector3};
use poseshift::geometry::{Pose, Vector, add, dot, norm, scale, sub};
use poseshift::identify::IdentifyError;
use poseshift::identify::base::BasePolicy;
use poseshift::identify::calibration::{Calibration, Options, calibrate};
use poseshift::identify::measurements::Measurements;
use poseshift::identify::normal::Normal;
use poseshift::identify::parameters::{Level, Selection, Subject};
use poseshift::identify::pick::Pick;
use poseshift::identify::problem::Problem;
use poseshift::identify::robust::{Loss, Shape};
use poseshift::model::effects::{Effect, Kind, Site};
use poseshift::model::profile::Profile;
use poseshift::model::{Conditions, Model};
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};

const DEG: f64 = std::f64::consts::PI / 180.0;
const SIGMA_M: f64 = 2e-5;
const PROBE_M: f64 = 0.003;
const BALL_IN_TOOL_M: Vector = [0.012, -0.02, 0.08];
const HEADER: &str = "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg,px_mm,py_mm,pz_mm,sigma_mm,contact,feature,probe_radius_mm,radius_mm,cx_mm,cy_mm,cz_mm,nx,ny,nz\n";

fn nominal() -> Profile {
    let path = repository("robots/abb_irb120_thesis.yaml");
    let text = std::fs::read_to_string(path).expect("a shipped profile");
    let mut profile = Profile::from_yaml(&text).expect("a shipped profile");
    profile.effects.clear();
    profile
}

/// The arm with errors of up to 0.5 mm and 0.05° in a complete and minimal set, its base out of
/// place by as much.
fn hidden(random: &mut StdRng) -> Profile {
    let mut profile = nominal();
    let mut even = |size: f64| size * random.random_range(-1.0..1.0);
    let (length, angle) = (5e-4, 0.05 * DEG);
    for link in 1..6 {
        let beta = if link == 2 { even(angle) } else { 0.0 };
        let d = if link == 1 { 0.0 } else { even(length) };
        // alpha, a, beta, theta, d in the order of the effect's definition
        let parameters = [even(angle), even(length), beta, even(angle), d, 0.0];
        profile.effects.push(Effect {
            kind: Kind::LinkGeometry,
            site: Site {
                index: link,
                ..Site::default()
            },
            parameters,
        });
    }
    profile.effects.push(Effect {
        kind: Kind::BaseFrame,
        site: Site::default(),
        parameters: std::array::from_fn(|i| even(if i < 3 { length } else { angle })),
    });
    profile
}

struct Cell {
    random: StdRng,
    profile: Profile,
    arm: Model,
}

impl Cell {
    fn new(seed: u64) -> Self {
        let mut random = StdRng::seed_from_u64(seed);
        let profile = hidden(&mut random);
        let tool = profile.tool("artifact").expect("its tool");
        let arm = profile.real_model(&tool, &Conditions::default());
        Self {
            random,
            profile,
            arm,
        }
    }

    fn ball(&self, q: &[f64; 6]) -> Vector {
        let pose = self.arm.forward(q, &Conditions::default());
        pose.transform(BALL_IN_TOOL_M)
    }

    fn normal(&mut self) -> f64 {
        (0..12)
            .map(|_| self.random.random_range(-0.5..0.5))
            .sum::<f64>()
    }

    fn direction(&mut self) -> Vector {
        let v = [self.normal(), self.normal(), self.normal()];
        scale(1.0 / norm(v), v)
    }

    /// Joint angles within their limits that bring the real ball here, from a random posture.
    fn bring(&mut self, target: Vector) -> [f64; 6] {
        for _ in 0..500 {
            let mut q = random_joints(&mut self.random, &self.profile);
            for _ in 0..40 {
                let at = self.ball(&q);
                let left = Vector3::from(sub(target, at));
                let slopes: SMatrix<f64, 3, 6> = SMatrix::from_fn(|i, j| {
                    let mut other = q;
                    other[j] += 1e-6;
                    (self.ball(&other)[i] - at[i]) / 1e-6
                });
                let square: Matrix3<f64> = slopes * slopes.transpose() + Matrix3::identity() * 1e-8;
                let Some(inverse) = square.try_inverse() else {
                    break;
                };
                let step: SVector<f64, 6> = slopes.transpose() * inverse * left;
                let most = f64::min(0.3 / step.amax().max(1e-12), 1.0);
                for j in 0..6 {
                    q[j] += most * step[j];
                }
                if left.norm() < 1e-11 {
                    break;
                }
            }
            let joints = &self.profile.mechanism.joints;
            let inside = (0..6).all(|i| (joints[i].min_rad..joints[i].max_rad).contains(&q[i]));
            if inside && norm(sub(self.ball(&q), target)) < 1e-10 {
                return q;
            }
        }
        panic!("the target is out of reach");
    }

    /// Rows of touches whose ball stands at `targets`, with noise.
    fn touches(&mut self, targets: &[Vector], contact: &str) -> String {
        let mut text = String::new();
        for target in targets {
            let noise = [self.normal(), self.normal(), self.normal()];
            let q = self.bring(add(*target, scale(SIGMA_M, noise)));
            for q in q {
                text += &format!("{:.12},", q / DEG);
            }
            for p in BALL_IN_TOOL_M {
                text += &format!("{},", p * 1e3);
            }
            text += &format!("{},{contact}\n", SIGMA_M * 1e3);
        }
        text
    }

    fn on_sphere(&mut self, centre: Vector, radius: f64, count: usize) -> Vec<Vector> {
        let one = |_| {
            let mut away = self.direction();
            away[2] = away[2].abs();
            add(centre, scale(radius + PROBE_M, away))
        };
        (0..count).map(one).collect()
    }

    fn on_plane(&mut self, point: Vector, normal: Vector, count: usize) -> Vec<Vector> {
        let one = |_| {
            let along = scale(0.1 * self.random.random_range(0.2..1.0), self.direction());
            let flat = sub(along, scale(dot(along, normal), normal));
            add(add(point, flat), scale(PROBE_M, normal))
        };
        (0..count).map(one).collect()
    }
}

fn cells(values: Vector, factor: f64) -> String {
    values.map(|v| format!("{:.9}", v * factor)).join(",")
}

fn read(text: &str) -> Measurements {
    Measurements::from_csv(text.as_bytes()).expect("a file of contacts")
}

fn options() -> Options {
    let mut selection = Selection::level(Level::Geometry);
    selection.fix = Pick::parse_list("tool_frame").expect("a word");
    Options {
        selection,
        shape: Shape::Squares,
        base: BasePolicy::Profile,
    }
}

const LEFT: Vector = [0.28, 0.25, 0.15];
const RIGHT: Vector = [0.3, -0.22, 0.3];
const HIGH: Vector = [0.25, 0.05, 0.55];
const NEST: Vector = [0.33, 0.1, 0.35];
const FLOOR: (Vector, Vector) = ([0.35, 0.0, 0.12], [0.0, 0.0, 1.0]);
const WALL: (Vector, Vector) = ([0.4, 0.0, 0.4], [-0.8, 0.0, 0.6]);
const RADIUS_M: f64 = 0.0127;

/// Two known spheres, a known plane; a sphere, a plane and a point that are not known.
fn all_kinds(cell: &mut Cell, count: usize) -> String {
    let probe = PROBE_M * 1e3;
    let radius = RADIUS_M * 1e3;
    let mut text = HEADER.to_owned();
    for (name, centre) in [("left", LEFT), ("right", RIGHT)] {
        let balls = cell.on_sphere(centre, RADIUS_M, count);
        let at = cells(centre, 1e3);
        text += &cell.touches(&balls, &format!("sphere,{name},{probe},{radius},{at},,,"));
    }
    let balls = cell.on_plane(FLOOR.0, FLOOR.1, count);
    let (at, normal) = (cells(FLOOR.0, 1e3), cells(FLOOR.1, 1.0));
    text += &cell.touches(&balls, &format!("plane,floor,{probe},,{at},{normal}"));
    let balls = cell.on_sphere(HIGH, RADIUS_M, count);
    text += &cell.touches(&balls, &format!("sphere,high,{probe},,,,,,,"));
    let balls = cell.on_plane(WALL.0, WALL.1, count);
    text += &cell.touches(&balls, &format!("plane,wall,{probe},,,,,,,"));
    text + &cell.touches(&vec![NEST; count], &format!("point,nest,{probe},,,,,,,"))
}

#[test]
fn touches_find_the_arm_and_what_was_touched_within_their_uncertainty() {
    let mut cell = Cell::new(71);
    let text = all_kinds(&mut cell, 40);
    let found = calibrate(&nominal(), &read(&text), &options()).expect("a calibration");
    let factor = found.uncertainty.sigma_factor;
    assert!((0.9..1.1).contains(&factor), "{factor}");
    let mut squares = Vec::new();
    let truth = |key: &str| {
        cell.profile.effects.iter().find_map(|e| {
            let all = e.definition().parameters.iter().zip(e.parameters);
            let mut named = all.map(|(p, value)| (format!("{} {}", e.label(), p.key), value));
            named.find_map(|(name, value)| (name == key).then_some(value))
        })
    };
    for (parameter, value, sigma) in found.parameters() {
        let Some(sigma) = sigma else { continue };
        let true_value = match parameter.key.as_str() {
            "sphere high x_mm" => HIGH[0],
            "sphere high y_mm" => HIGH[1],
            "sphere high z_mm" => HIGH[2],
            "sphere high radius_mm" => RADIUS_M,
            "point nest x_mm" => NEST[0],
            "point nest y_mm" => NEST[1],
            "point nest z_mm" => NEST[2],
            key if key.starts_with("plane wall") => continue,
            key => truth(key).unwrap_or_else(|| panic!("{key}")),
        };
        let off = (value - true_value) / sigma;
        assert!(off.abs() < 4.5, "{}: {off:.1} sigma", parameter.key);
        squares.push(off * off);
    }
    assert!(squares.len() > 30, "{}", squares.len());
    let mean = squares.iter().sum::<f64>() / squares.len() as f64;
    assert!((0.4..2.0).contains(&mean), "{mean}");
    let wall = found.features().find(|(f, _)| f.name == "wall");
    let (_, place) = wall.expect("it was touched");
    let normal = place.normal.expect("a plane");
    assert!(norm(sub(normal, WALL.1)) < 2e-4, "{normal:?}");
    let height = dot(normal, sub(place.centre_m, WALL.0));
    assert!(height.abs() < 5e-5, "{height}");

    let tool = cell.profile.tool("artifact").expect("its tool");
    let model = |profile: &Profile| profile.real_model(&tool, &Conditions::default());
    let miss = |arm: &Model| {
        let mut random = StdRng::seed_from_u64(5);
        let gap = |_| {
            let q = random_joints(&mut random, &cell.profile);
            let pose: Pose = arm.forward(&q, &Conditions::default());
            norm(sub(pose.transform(BALL_IN_TOOL_M), cell.ball(&q)))
        };
        (0..200).map(gap).sum::<f64>() / 200.0
    };
    let (before, after) = (miss(&model(&nominal())), miss(&model(&found.profile())));
    println!(
        "mean error {:.4} mm before, {:.4} mm after",
        before * 1e3,
        after * 1e3
    );
    assert!(before > 5e-4 && after < 5e-5, "{before} {after}");
}

#[test]
fn repeated_unknown_points_leave_the_base_where_the_profile_has_it() {
    let mut cell = Cell::new(72);
    let mut text = HEADER.to_owned();
    for (name, at) in [("a", LEFT), ("b", RIGHT), ("c", HIGH), ("d", NEST)] {
        text += &cell.touches(&vec![at; 30], &format!("point,{name},3,,,,,,,"));
    }
    let found = calibrate(&nominal(), &read(&text), &options()).expect("a calibration");
    let factor = found.uncertainty.sigma_factor;
    assert!((0.9..1.1).contains(&factor), "{factor}");
    assert!(!found.base_replaced);
    for (parameter, value, sigma) in found.parameters() {
        if parameter.key.starts_with("base_frame") {
            assert!(sigma.is_none() && value == 0.0, "{}", parameter.key);
        }
    }
}

#[test]
fn about_the_only_point_of_a_tool_its_rotation_is_not_sought() {
    let mut cell = Cell::new(73);
    let text = all_kinds(&mut cell, 30);
    let measurements = read(&text);
    let selection = Selection::level(Level::Geometry);
    let free = Options {
        selection,
        ..options()
    };
    let found = calibrate(&nominal(), &measurements, &free).expect("a calibration");
    let sought: Vec<String> = found
        .parameters()
        .filter(|(parameter, _, sigma)| parameter.key.starts_with("tool_frame") && sigma.is_some())
        .map(|(parameter, ..)| parameter.key.clone())
        .collect();
    assert!(!sought.is_empty());
    assert!(sought.iter().all(|key| key.contains("_mm")), "{sought:?}");
    let tool = nominal().tool("artifact").expect("its tool");
    let arm = found.profile().real_model(&tool, &Conditions::default());
    let mut random = StdRng::seed_from_u64(8);
    for _ in 0..100 {
        let q = random_joints(&mut random, &cell.profile);
        let pose: Pose = arm.forward(&q, &Conditions::default());
        let missed = norm(sub(pose.transform(BALL_IN_TOOL_M), cell.ball(&q)));
        assert!(missed < 5e-4, "{missed}");
    }
    // a ball that is not where its columns have it
    let says = |found: &Calibration| {
        let mut all = found.remarks.iter().filter(|r| r.id == "tool-elsewhere");
        all.next().map(|r| r.message.clone())
    };
    assert_eq!(says(&found), None);
    let elsewhere = read(&text.replace(",12,-20,80,", ",52,-20,50,"));
    let found = calibrate(&nominal(), &elsewhere, &free).expect("a calibration");
    let message = says(&found).expect("50 mm off");
    assert!(message.contains("`artifact` is 5"), "{message}");
}

#[test]
fn derivatives_of_contacts_are_those_of_the_residuals() {
    let mut cell = Cell::new(73);
    let text = all_kinds(&mut cell, 6);
    let selection = Selection::level(Level::Geometry);
    let profile = nominal();
    let (problem, mut estimate) =
        Problem::new(&profile, &read(&text), &selection, profile.world_from_base)
            .expect("a problem");
    // away from the start, where planes are tilted
    for (i, parameter) in problem.parameters.iter().enumerate() {
        *estimate.value_mut(parameter.subject) += 0.2 * parameter.scale * (i as f64).sin();
    }
    let loss = Loss::squares();
    let all = Normal::of(&problem, &estimate, &problem.parameters, loss);
    let features = |s: &Subject| matches!(s, Subject::Feature { .. });
    assert_eq!(
        problem
            .parameters
            .iter()
            .filter(|p| features(&p.subject))
            .count(),
        10
    );
    for (i, parameter) in problem.parameters.iter().enumerate() {
        let cost = |side: f64| {
            let mut other = estimate.clone();
            *other.value_mut(parameter.subject) += side * 1e-4 * parameter.scale;
            Normal::of(&problem, &other, &[], loss).cost
        };
        let slope = (cost(1.0) - cost(-1.0)) / 2e-4;
        let mine = -2.0 * all.gradient[i];
        let size = (all.cost * all.matrix[(i, i)]).sqrt();
        assert!(
            (slope - mine).abs() < 1e-5 * size,
            "{}: {slope} {mine}",
            parameter.key
        );
    }
}

#[test]
fn bad_contacts_are_named_with_their_line() {
    let row = |rest: &str| format!("{HEADER}1,2,3,4,5,6,0,0,0,0.1,{rest}\n");
    let cases = [
        ("ball,a,3,10,1,2,3,,,", "sphere, plane or point"),
        ("sphere,,3,10,1,2,3,,,", "a name"),
        ("sphere,a,3,10,1,,3,,,", "column cy_mm: an empty cell"),
        ("sphere,a,3,-10,1,2,3,,,", "greater than zero"),
        ("sphere,a,3,10,1,2,3,0,0,1", "only a plane has a normal"),
        ("plane,a,3,,1,2,3,0,0,2", "a normal of length 2.0000"),
        ("point,a,3,10,1,2,3,,,", "only a sphere has a radius"),
        (",a,3,10,1,2,3,,,", "the contact is missing"),
        (",,,,,,,,,", "neither"),
    ];
    for (rest, reported) in cases {
        let error = Measurements::from_csv(row(rest).as_bytes()).expect_err(rest);
        assert!(error.to_string().contains(reported), "{rest}: {error}");
        assert_eq!(error.line, 2, "{rest}");
    }
    let twice = row("sphere,a,3,10,1,2,3,,,") + "1,2,3,4,5,7,0,0,0,0.1,sphere,a,3,11,1,2,3,,,\n";
    let error = Measurements::from_csv(twice.as_bytes()).expect_err("two radii");
    assert_eq!(
        (error.line, error.to_string().contains("line 2")),
        (3, true)
    );
    let alone = "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg,contact\n1,2,3,4,5,6,point\n";
    let error = Measurements::from_csv(alone.as_bytes()).expect_err("no feature");
    assert!(error.to_string().contains("feature"), "{error}");

    let mut cell = Cell::new(74);
    let balls = cell.on_sphere(HIGH, RADIUS_M, 4);
    let few = HEADER.to_owned() + &cell.touches(&balls, "sphere,high,3,,,,,,,");
    let error = calibrate(&nominal(), &read(&few), &options()).expect_err("too few");
    let IdentifyError::Feature { line, feature, .. } = &error else {
        panic!("{error}");
    };
    assert_eq!((line.number, feature.as_str()), (2, "high"));
    assert!(error.to_string().contains("5 are needed"), "{error}");
}

#[test]
fn files_of_touches_are_calibrated_validated_and_refused_by_command() {
    let folder = scratch();
    let at = folder.path();
    let mut cell = Cell::new(75);
    std::fs::write(at.join("fit.csv"), all_kinds(&mut cell, 40)).expect("scratch");
    std::fs::write(at.join("check.csv"), all_kinds(&mut cell, 12)).expect("scratch");
    let thesis = std::fs::read_to_string(repository("robots/abb_irb120_thesis.yaml"));
    let thesis = thesis.expect("a shipped profile");
    let effects = thesis.find("  effects:").expect("its calibration");
    let nominal = format!("{}  effects: []\n", &thesis[..effects]);
    std::fs::write(at.join("nominal.yaml"), nominal).expect("scratch");
    let run = |arguments: &[&str]| {
        let mut command = poseshift();
        let output = command.current_dir(at).args(arguments).arg("--json");
        let output = output.output().expect("the program starts");
        let reported = String::from_utf8_lossy(&output.stderr).into_owned();
        (output.status.code(), output.stdout, reported)
    };
    let report = |arguments: &[&str]| -> serde_json::Value {
        let (status, out, reported) = run(arguments);
        assert_eq!(status, Some(0), "{reported}");
        serde_json::from_slice(&out).expect("JSON and nothing else")
    };
    let number = |value: &serde_json::Value| value.as_f64().expect("a number");
    let calibrate = |file: &'static str| {
        [
            "calibrate",
            "--profile",
            "nominal.yaml",
            "--measurements",
            file,
            "--level",
            "2",
            "--fix",
            "tool_frame",
            "-o",
            "found.yaml",
        ]
    };
    let found = report(&calibrate("fit.csv"));
    let features = found["features"].as_array().expect("what was touched");
    let names: Vec<&str> = features
        .iter()
        .filter_map(|f| f["feature"].as_str())
        .collect();
    assert_eq!(names, ["high", "wall", "nest"]);
    assert!((number(&features[0]["radius_mm"]) - RADIUS_M * 1e3).abs() < 0.02);
    for k in 0..3 {
        assert!((number(&features[0]["centre_mm"][k]) - HIGH[k] * 1e3).abs() < 0.1);
        assert!((number(&features[1]["normal"][k]) - WALL.1[k]).abs() < 1e-3);
        assert!((number(&features[2]["centre_mm"][k]) - NEST[k] * 1e3).abs() < 0.1);
    }
    let range = |of: &serde_json::Value| number(&of["range"]["rms_mm"]);
    assert!(range(&found["after"]) < 0.03, "{}", found["after"]);
    assert!(range(&found["before"]) > 0.1, "{}", found["before"]);

    // new touches of the same things: the calibrated arm closes them, the nominal one does not
    let seen = |profile: &str| {
        report(&[
            "validate",
            "--profile",
            profile,
            "--measurements",
            "check.csv",
            "--all-sets",
        ])
    };
    let (before, after) = (seen("nominal.yaml"), seen("found.yaml"));
    let gap = |report: &serde_json::Value| number(&report["range"]["real"]["rms_mm"]);
    assert!(
        gap(&before) > 0.1 && gap(&after) < 0.04,
        "{} {}",
        before["range"],
        after["range"]
    );

    let judged = report(&[
        "diagnose",
        "--profile",
        "found.yaml",
        "--measurements",
        "fit.csv",
    ]);
    assert_eq!(judged["verdict"], "nothing_missing", "{judged}");

    std::fs::remove_file(at.join("found.yaml")).expect("written");
    let lines = std::fs::read_to_string(at.join("fit.csv")).expect("scratch");
    let bad = lines.replacen("plane,floor,3,,", "plane,floor,3,5,", 1);
    std::fs::write(at.join("bad.csv"), &bad).expect("scratch");
    let (status, _, reported) = run(&calibrate("bad.csv"));
    let place = 1 + bad
        .lines()
        .position(|l| l.contains("plane,floor,3,5,"))
        .expect("a row");
    assert_eq!(status, Some(2));
    assert!(
        reported.contains("only a sphere has a radius"),
        "{reported}"
    );
    assert!(
        reported.contains(&format!("bad.csv:{place}:")),
        "{reported}"
    );
    assert!(!at.join("found.yaml").exists());
}

#[test]
fn a_diameter_for_a_radius_and_a_normal_the_other_way_are_refused() {
    let mut cell = Cell::new(75);
    let text = all_kinds(&mut cell, 30);
    let probe = PROBE_M * 1e3;
    let thicker = text.replace(&format!(",{probe},"), &format!(",{},", 2.0 * probe));
    let (up, down) = (cells(FLOOR.1, 1.0), cells(scale(-1.0, FLOOR.1), 1.0));
    for bad in [thicker, text.replace(&up, &down)] {
        assert_ne!(bad, text);
        match calibrate(&nominal(), &read(&bad), &options()) {
            Err(error) => assert!(error.to_string().contains("touches miss"), "{error}"),
            Ok(found) => panic!("believed with {:?}", found.after),
        }
    }
}

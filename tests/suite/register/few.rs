//! `handeye` of few poses, and of copies of them: what they do not show is not given.

use super::mistakes::{HANDEYE, boards, has, registered, write};
use super::{noisy, random_pose, seeded};
use crate::support::scratch;
use poseshift::geometry::{Pose, Rotation, norm, sub};
use poseshift::register::handeye::{HandEye, Method, Setup};
use rand::RngExt;
use rand::rngs::StdRng;

const MM: f64 = 1e-3;

/// A camera in a hand that looks at a board, with noise of positions (m) and of rotations (rad).
struct Scene {
    camera: Pose,
    robot: Vec<Pose>,
    board: Vec<Pose>,
}

impl Scene {
    fn new(random: &mut StdRng, count: usize, noise: [f64; 2]) -> Self {
        let camera = Pose::from_xyz_rxryrz([0.062, -0.031, 0.115, 2.2, -0.9, 2.5]);
        let board = Pose::from_xyz_rxryrz([0.6, 0.1, 0.02, 0.1, -0.05, 0.7]);
        let down = Pose::from_xyz_rxryrz([0.5, 0.0, 0.4, std::f64::consts::PI, 0.0, 0.0]);
        let (mut robot, mut seen) = (Vec::new(), Vec::new());
        for _ in 0..count {
            let turn = random_pose(random, 1.0).rotation.vector();
            let angle = random.random_range(0.16..0.52) / norm(turn);
            let place = random_pose(random, 0.15).translation;
            let flange = Pose {
                rotation: Rotation::from_vector(turn.map(|v| angle * v)) * down.rotation,
                translation: std::array::from_fn(|k| down.translation[k] + place[k]),
            };
            let off = Pose {
                rotation: Rotation::from_vector(noisy(random, [0.0; 3], noise[1])),
                translation: noisy(random, [0.0; 3], noise[0]),
            };
            robot.push(flange);
            seen.push(camera.inverse() * flange.inverse() * board * off);
        }
        Self {
            camera,
            robot,
            board: seen,
        }
    }

    fn problem(&self) -> HandEye {
        HandEye::new(Setup::EyeInHand, &self.robot, &self.board).expect("a good set")
    }

    /// Whether the poses rotate well about two directions.
    fn is_tilted(&self) -> bool {
        let problem = HandEye::new(Setup::EyeInHand, &self.robot, &self.board);
        problem.is_ok_and(|problem| problem.spread_rad[1] > 0.05)
    }

    fn miss_m(&self, found: &Pose) -> f64 {
        norm(sub(found.translation, self.camera.translation))
    }
}

fn middle(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

/// A tenth of a millimetre, and 0.03 degrees.
const USUAL: [f64; 2] = [1e-4, 5.2e-4];

#[test]
fn few_poses_do_not_give_up_rotations_for_positions() {
    for count in [3, 4, 5] {
        let mut random = seeded(50);
        let (mut refined, mut tsai) = (Vec::new(), Vec::new());
        for _ in 0..100 {
            let scene = Scene::new(&mut random, count, USUAL);
            if !scene.is_tilted() {
                continue;
            }
            let problem = scene.problem();
            let found = problem.refined().expect("a solution");
            refined.push(scene.miss_m(&found.camera));
            tsai.push(scene.miss_m(&problem.by(Method::Tsai).expect("a solution")));
            assert_eq!(found.shows_noise(), count > 3);
        }
        assert!(refined.len() > 90, "{}", refined.len());
        let largest = |all: &[f64]| all.iter().copied().fold(0.0, f64::max) / MM;
        let largest = [largest(&refined), largest(&tsai)];
        let middle = [middle(refined) / MM, middle(tsai) / MM];
        println!("{count} poses, refined and Tsai: {middle:.3?} mm, largest {largest:.3?}");
        assert!(middle[0] < 0.9 * middle[1], "{count}: {middle:?}");
        assert!(largest[0] < largest[1], "{count}: {largest:?}");
    }
    // positions that are far better than the bound has it are believed where the rows show it
    let mut random = seeded(51);
    let each = (0..30).map(|_| {
        let scene = Scene::new(&mut random, 6, [1e-5, 1.7e-3]);
        let found = scene.problem().refined().expect("a solution");
        scene.miss_m(&found.camera)
    });
    let believed = middle(each.collect()) / MM;
    assert!(believed < 0.06, "{believed}");
}

#[test]
fn sigma_of_few_poses_is_that_of_their_scatter() {
    // of a deviation from so many residuals: root mean square of Student's t
    for (count, freedom) in [(5, 6.0_f64), (8, 15.0), (15, 36.0)] {
        let mut random = seeded(52);
        let (mut sum, mut runs) = (0.0, 0.0);
        for _ in 0..150 {
            let scene = Scene::new(&mut random, count, USUAL);
            let found = scene.problem().refined().expect("a solution");
            let at = found.camera.translation;
            let sigma = found.camera_covariance.sigma_at_m(at);
            let off = sub(at, scene.camera.translation);
            sum += (0..3).map(|k| (off[k] / sigma[k]).powi(2)).sum::<f64>();
            runs += 3.0;
            let [rotations, positions] = found.redundancy;
            #[allow(clippy::cast_precision_loss)]
            let all = (6 * count - 12) as f64;
            assert!((rotations + positions - all).abs() < 1e-6);
        }
        let (found, student) = ((sum / runs).sqrt(), (freedom / (freedom - 2.0)).sqrt());
        println!("{count} poses: {found:.3}, of Student's t {student:.3}");
        assert!((found / student - 1.0).abs() < 0.1, "{count}: {found}");
    }
}

#[test]
fn few_poses_and_copies_of_them_have_no_sigma_or_a_warning() {
    let folder = scratch();
    let at = folder.path();
    let mut random = seeded(53);
    let scene = Scene::new(&mut random, 12, USUAL);
    let run = |rows: &[usize]| {
        let of = |poses: &[Pose]| rows.iter().map(|k| poses[*k]).collect::<Vec<_>>();
        write(at, "robot.csv", &boards(&of(&scene.robot)));
        write(at, "board.csv", &boards(&of(&scene.board)));
        let (status, report, reported) = registered(at, &HANDEYE);
        assert_eq!(status, 0, "{reported}");
        report
    };
    let three = run(&[0, 1, 2]);
    for key in ["sigma", "board_sigma", "noise_mm", "noise_deg"] {
        assert!(three[key].is_null(), "{key}: {three}");
    }
    assert!(has(&three, "few-points") && !has(&three, "duplicate-rows"));
    let (robot, board) = (at.join("robot.csv"), at.join("board.csv"));
    let (frame, page) = (at.join("frame.yaml"), at.join("page.html"));
    let path = |path: &std::path::Path| path.to_str().expect("plain").to_owned();
    let all = [robot, board, frame.clone(), page.clone()].map(|one| path(&one));
    let words = [
        "handeye",
        &all[0],
        &all[1],
        "--setup",
        "eye-in-hand",
        "-o",
        &all[2],
        "--report",
        &all[3],
    ];
    let (status, out, reported) = crate::support::run(&words);
    assert_eq!(status, 0, "{reported}");
    assert!(out.contains("sigma is not known"), "{out}");
    assert!(
        !std::fs::read_to_string(frame)
            .expect("written")
            .contains("sigma")
    );
    let page = std::fs::read_to_string(page).expect("written");
    assert!(page.contains("not known from so few poses"));

    let copied = run(&[0, 1, 2, 1, 0, 2, 2, 1, 0]);
    assert!(has(&copied, "few-points") && has(&copied, "duplicate-rows"));
    assert!(copied["sigma"].is_null());
    assert_eq!(copied["camera"], three["camera"]);
    assert_eq!(copied["poses"][6], three["poses"][2]);

    let six = run(&[0, 1, 2, 3, 4, 5]);
    assert!(has(&six, "few-points") && six["sigma"].is_object(), "{six}");
    let twelve: Vec<usize> = (0..12).collect();
    let good = run(&twelve);
    assert!(!has(&good, "few-points"), "{good}");
    let twice = run(&[&twelve[..], &twelve[..]].concat());
    assert!(has(&twice, "duplicate-rows"), "{twice}");
    assert_eq!(twice["sigma"], good["sigma"]);

    // copies of two poses are two poses
    let two = |poses: &[Pose]| boards(&[&poses[..2], &poses[..2]].concat());
    write(at, "robot.csv", &two(&scene.robot));
    write(at, "board.csv", &two(&scene.board));
    let (status, _, reported) = registered(at, &HANDEYE);
    assert!(status == 2 && reported.contains("2 poses"), "{reported}");
}

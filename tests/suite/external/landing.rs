//! Hundreds of targets on rails and positioners, in each language.

use super::programs::{Line, Said, numbers_of, pose_of, program, round, written_numbers};
use super::{profile, tool, written};
use crate::physics::external::{Rail, RailFault, Table, TableFault, carried, plate};
use crate::physics::matrix::{M4, frame, times};
use crate::physics::{Fault, Moment, Robot, tool_pose};
use crate::trial::truth::robot_of;
use nalgebra::{Matrix6, Vector6};
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};

/// Numbers with three decimals of a millimetre, and what their angles are worth at the tool, mm.
const LANDS_MM: f64 = 0.004;
const TARGETS: usize = 300;

/// A cell as the reference knows it.
pub(super) struct Cell {
    pub(super) external: &'static str,
    pub(super) effects: Vec<String>,
    rails: Vec<Rail>,
    pub(super) tables: Vec<Table>,
    pub(super) on_axis: M4,
    pub(super) plate_fault: [f64; 6],
    /// The names of its axes in each language.
    pub names: [&'static [&'static str]; 4],
}

/// A rigid pose's inverse.
pub(super) fn inverse(m: &M4) -> M4 {
    let mut out = [[0.0, 0.0, 0.0, 0.0]; 4];
    for i in 0..3 {
        for j in 0..3 {
            out[i][j] = m[j][i];
        }
    }
    for row in out.iter_mut().take(3) {
        row[3] = -(0..3).map(|k| row[k] * m[k][3]).sum::<f64>();
    }
    out[3][3] = 1.0;
    out
}

impl Cell {
    /// The same cell as the controller has it.
    fn nominal(&self) -> (Vec<Rail>, Vec<Table>) {
        let rails = self.rails.iter().map(|rail| Rail {
            faults: Vec::new(),
            ..rail.clone()
        });
        let tables = self.tables.iter().map(|table| Table {
            faults: Vec::new(),
            ..table.clone()
        });
        (rails.collect(), tables.collect())
    }

    fn base(rails: &[Rail], home: &M4, e: &[f64], direction: f64) -> M4 {
        rails
            .iter()
            .zip(e)
            .fold(*home, |base, (rail, e)| carried(rail, &base, *e, direction))
    }

    fn part(&self, tables: &[Table], fault: &[f64; 6], e: &[f64]) -> M4 {
        plate(tables, &self.on_axis, fault, &e[self.rails.len()..])
    }
}

/// What is wrong with the arm, in both words.
pub(super) fn arm() -> (Vec<String>, Vec<Fault>) {
    let effects = [
        "{effect: link_geometry, link: 2, a_mm: 0.4, alpha_deg: 0.02}",
        "{effect: link_geometry, link: 3, theta_deg: 0.05, a_mm: -0.2}",
        "{effect: joint_compliance, joint: 2, rad_per_n_m: 4.0e-5}",
        "{effect: joint_compliance, joint: 3, rad_per_n_m: 3.0e-5}",
        "{effect: base_frame, x_mm: 0.3, y_mm: -0.2, rz_deg: 0.01}",
    ];
    let rad = f64::to_radians;
    let faults = vec![
        Fault::Link(1, [rad(0.02), 0.4e-3, 0.0, 0.0, 0.0]),
        Fault::Link(2, [0.0, -0.2e-3, 0.0, rad(0.05), 0.0]),
        Fault::Compliance(1, 4.0e-5),
        Fault::Compliance(2, 3.0e-5),
        Fault::Base([0.3e-3, -0.2e-3, 0.0, 0.0, 0.0, rad(0.01)]),
    ];
    (effects.map(str::to_owned).to_vec(), faults)
}

fn rail_cell() -> Cell {
    let rad = f64::to_radians;
    Cell {
        external: "external_axes:\n  track:\n    - {axis: AXIS1, direction: [0.6, 0.8, 0.0], up: \
            [0, 0, 1], zero_mm: 500, min_mm: 0, max_mm: 3000}\n",
        effects: [
            "{effect: track_scale, axis: 1, ratio: 2.5e-4}",
            "{effect: track_direction, axis: 1, y_deg: 0.05, z_deg: -0.04}",
            "{effect: track_straightness, axis: 1, along: y, degree: 2, mm: 0.8}",
            "{effect: track_straightness, axis: 1, along: z, degree: 3, mm: -0.5}",
            "{effect: track_rotation, axis: 1, about: x, degree: 1, deg: 0.06}",
            "{effect: track_rotation, axis: 1, about: y, degree: 2, deg: -0.05}",
            "{effect: track_rotation, axis: 1, about: z, degree: 1, deg: 0.04}",
            "{effect: track_ripple, axis: 1, along: x, period_mm: 12.566, cos_mm: 0.05, sin_mm: \
             -0.08}",
            "{effect: track_backlash, axis: 1, width_mm: 0.12}",
        ]
        .map(str::to_owned)
        .to_vec(),
        rails: vec![Rail {
            direction: [0.6, 0.8, 0.0],
            up: [0.0, 0.0, 1.0],
            zero: 0.5,
            low: 0.0,
            high: 3.0,
            faults: vec![
                RailFault::Scale(2.5e-4),
                RailFault::Direction(rad(0.05), rad(-0.04)),
                RailFault::Bent(1, 2, 0.8e-3),
                RailFault::Bent(2, 3, -0.5e-3),
                RailFault::Turned(0, 1, rad(0.06)),
                RailFault::Turned(1, 2, rad(-0.05)),
                RailFault::Turned(2, 1, rad(0.04)),
                RailFault::Ripple(0, 12.566e-3, 0.05e-3, -0.08e-3),
                RailFault::Backlash(0.12e-3),
            ],
        }],
        tables: Vec::new(),
        on_axis: frame(&[0.0; 6]),
        plate_fault: [0.0; 6],
        names: [&["eax_a"], &["E1"], &["E1"], &["BC1"]],
    }
}

const PLATE: [f64; 6] = [0.02, -0.01, 0.05, 0.1, -0.2, 0.3];

pub(super) fn table_cell(axes: usize) -> Cell {
    let rad = f64::to_radians;
    let one = "        - {axis: AXIS1, at: {x_mm: 700, y_mm: -150, z_mm: 600, rx_deg: 5, ry_deg: \
        20, rz_deg: 40}, sign: -1, zero_deg: 10, min_deg: -180, max_deg: 180}\n";
    let two = "        - {axis: AXIS2, at: {x_mm: 40, y_mm: 0, z_mm: 120, rx_deg: -85, ry_deg: 3, \
        rz_deg: 0}, min_deg: -180, max_deg: 180}\n";
    let head =
        "external_axes:\n  positioners:\n    - name: UNIT\n      follows: FOLLOWS\n      axes:\n";
    let plate = "      plate: {x_mm: 20, y_mm: -10, z_mm: 50, rx_deg: 5.729577951308232, ry_deg: \
        -11.459155902616464, rz_deg: 17.188733853924695}\n";
    let external: String = match axes {
        1 => [head, one, plate].concat(),
        _ => [head, one, two, plate].concat(),
    };
    let mut effects: Vec<String> = [
        "{effect: positioner_axis, axis: 1, x_mm: 1.1, y_mm: -0.7, rx_deg: 0.08, ry_deg: -0.06}",
        "{effect: positioner_zero, axis: 1, deg: 0.05}",
        "{effect: positioner_scale, axis: 1, ratio: 2.0e-4}",
        "{effect: positioner_ripple, axis: 1, order: 2, cos_deg: 0.01, sin_deg: -0.02}",
        "{effect: positioner_runout, axis: 1, along: z, order: 1, cos_mm: 0.1, sin_mm: 0.05}",
    ]
    .map(str::to_owned)
    .to_vec();
    let mut tables = vec![Table {
        at: frame(&[0.7, -0.15, 0.6, rad(5.0), rad(20.0), rad(40.0)]),
        sign: -1.0,
        zero: rad(10.0),
        faults: vec![
            TableFault::Axis([1.1e-3, -0.7e-3, rad(0.08), rad(-0.06)]),
            TableFault::Zero(rad(0.05)),
            TableFault::Scale(2.0e-4),
            TableFault::Ripple(2.0, rad(0.01), rad(-0.02)),
            TableFault::Runout(2, 1.0, 0.1e-3, 0.05e-3),
        ],
    }];
    if axes == 2 {
        effects.push(
            "{effect: positioner_axis, axis: 2, x_mm: -0.5, y_mm: 0.4, rx_deg: -0.03, ry_deg: 0.05}"
                .into(),
        );
        tables.push(Table {
            at: frame(&[0.04, 0.0, 0.12, rad(-85.0), rad(3.0), 0.0]),
            sign: 1.0,
            zero: 0.0,
            faults: vec![TableFault::Axis([-0.5e-3, 0.4e-3, rad(-0.03), rad(0.05)])],
        });
    }
    effects.push(format!(
        "{{effect: positioner_plate, axis: {axes}, x_mm: 0.6, y_mm: -0.4, z_mm: 0.3, rx_deg: 0.04, \
         ry_deg: -0.05, rz_deg: 0.06}}"
    ));
    Cell {
        external: external.leak(),
        effects,
        rails: Vec::new(),
        tables,
        on_axis: frame(&PLATE),
        plate_fault: [0.6e-3, -0.4e-3, 0.3e-3, rad(0.04), rad(-0.05), rad(0.06)],
        names: [
            &["eax_b", "eax_c"],
            &["E1", "E2"],
            &["G2J1", "G2J2"],
            &["EC1", "EC2"],
        ],
    }
}

// ---- where the real tool lands

fn missing(is: &M4, wanted: &M4) -> Vector6<f64> {
    let at = |m: &M4, i: usize, j: usize| m[i][j];
    // wanted · isᵀ
    let r = |i: usize, j: usize| (0..3).map(|k| at(wanted, i, k) * at(is, j, k)).sum::<f64>();
    Vector6::new(
        wanted[0][3] - is[0][3],
        wanted[1][3] - is[1][3],
        wanted[2][3] - is[2][3],
        0.5 * (r(2, 1) - r(1, 2)),
        0.5 * (r(0, 2) - r(2, 0)),
        0.5 * (r(1, 0) - r(0, 1)),
    )
}

/// The joints with which the controller's arm brings its tool to a pose: Newton with central
/// differences.
pub(super) fn joints(robot: &Robot, wanted: &M4, near: &[f64; 6]) -> [f64; 6] {
    let of = |q: &[f64; 6]| missing(&tool_pose(robot, &[], q, &Moment::default()), wanted);
    let mut q = *near;
    for _ in 0..12 {
        let error = of(&q);
        if error.norm() < 1e-12 {
            break;
        }
        let step = 1e-6;
        let mut jacobian = Matrix6::zeros();
        for j in 0..6 {
            let moved = |by: f64| {
                let mut q = q;
                q[j] += by;
                of(&q)
            };
            jacobian.set_column(j, &((moved(-step) - moved(step)) / (2.0 * step)));
        }
        let change = jacobian
            .lu()
            .solve(&error)
            .expect("away from singularities");
        q = std::array::from_fn(|i| q[i] + change[i]);
    }
    assert!(of(&q).norm() < 1e-10, "{near:?} {q:?} {wanted:?}");
    q
}

/// Straight moves that are coordinated, to the poses.
fn coordinated_fanuc(text: &str) -> String {
    let lines = text.lines().map(|line| {
        let point = line
            .split("P[")
            .nth(1)
            .and_then(|rest| rest.split(']').next());
        let is_pose = |number: &str| number.parse().is_ok_and(|n: u32| n.is_multiple_of(2));
        match point.filter(|number| line.contains(":J P[") && is_pose(number)) {
            Some(_) => line
                .replace(":J P[", ":L P[")
                .replace("10% FINE", "50mm/sec FINE COORD"),
            None => line.to_owned(),
        }
    });
    lines.map(|line| line + "\n").collect()
}

fn lands(said: Said, cell: &Cell) {
    let (arm_effects, arm_faults) = arm();
    let names = cell.names[said as usize];
    let (unit, follows) = match said {
        Said::Rapid => ("STN1", "frame"),
        Said::Krl => ("\"2\"", "frame"),
        Said::Fanuc | Said::Inform => ("group2", "always"),
    };
    let mut external = cell
        .external
        .replace("UNIT", unit)
        .replace("FOLLOWS", follows);
    for (n, name) in names.iter().enumerate() {
        external = external.replace(&format!("AXIS{}", n + 1), name);
    }
    let effects: Vec<&str> = arm_effects
        .iter()
        .chain(&cell.effects)
        .map(String::as_str)
        .collect();
    let profile = profile(&external, &effects);
    let robot = robot_of(&profile, &tool());
    let (nominal_rails, nominal_tables) = cell.nominal();
    let offset = match said {
        Said::Rapid | Said::Krl if !cell.tables.is_empty() => [0.015, -0.025, 0.035, 0.0, 0.0, 0.0],
        _ => [0.0; 6],
    };
    // what is said of the part, in the world
    let part = |tables: &[Table], fault: &[f64; 6], e: &[f64]| match cell.tables.len() {
        0 => frame(&offset),
        _ => times(&cell.part(tables, fault, e), &frame(&offset)),
    };
    let standing = |rails: &[Rail], e: &[f64], direction: f64| Robot {
        base: Cell::base(rails, &robot.base, e, direction),
        ..robot.clone()
    };
    let mut random = StdRng::seed_from_u64(18);
    let mut lines = Vec::new();
    let mut known = Vec::new();
    for _ in 0..TARGETS {
        let q_deg = [
            random.random_range(-150.0..150.0),
            // the wrist stays before axis 1
            random.random_range(-10.0..60.0),
            random.random_range(-40.0..30.0),
            random.random_range(-140.0..140.0),
            random.random_range(25.0..100.0),
            random.random_range(-170.0..170.0),
        ]
        .map(|x: f64| (x * 1e6).round() / 1e6);
        let mut e: Vec<f64> = cell
            .rails
            .iter()
            .map(|_| random.random_range(0.0..3000.0))
            .collect();
        e.extend(
            cell.tables
                .iter()
                .map(|_| random.random_range(-170.0..170.0)),
        );
        let e: Vec<f64> = e
            .iter()
            .map(|x: &f64| (x * 100.0).round() / 100.0)
            .collect();
        let si: Vec<f64> = e
            .iter()
            .enumerate()
            .map(|(n, e)| {
                if n < cell.rails.len() {
                    e * 1e-3
                } else {
                    e.to_radians()
                }
            })
            .collect();
        let q = q_deg.map(f64::to_radians);
        let world = tool_pose(
            &standing(&nominal_rails, &si, 0.0),
            &[],
            &q,
            &Moment::default(),
        );
        let on_part = times(&inverse(&part(&nominal_tables, &[0.0; 6], &si)), &world);
        let mut numbers = numbers_of(said, &on_part);
        round(said, &mut numbers);
        // nobody knows from where the first comes
        let before = known
            .last()
            .map_or(si[0], |(_, before, _): &(_, Vec<f64>, f64)| before[0]);
        let direction = if si[0] == before {
            0.0
        } else {
            (si[0] - before).signum()
        };
        known.push((q, si, direction));
        lines.push(Line { q_deg, numbers, e });
    }
    let (name, text) = program(said, cell, &lines);
    let out = written(&profile, &[(name, &text)]);
    let fakes = written_numbers(said, &out);
    assert_eq!(fakes.len(), TARGETS, "{said:?}");
    let (mut before, mut after) = (0.0_f64, 0.0_f64);
    for ((line, (q, e, direction)), fake) in lines.iter().zip(&known).zip(&fakes) {
        let wanted = times(
            &part(&cell.tables, &cell.plate_fault, e),
            &pose_of(said, &line.numbers),
        );
        let controller = standing(&nominal_rails, e, 0.0);
        let real = standing(&cell.rails, e, *direction);
        let land = |numbers: &[f64]| {
            let reported = times(
                &part(&nominal_tables, &[0.0; 6], e),
                &pose_of(said, numbers),
            );
            let q = joints(&controller, &reported, q);
            let is = tool_pose(&real, &arm_faults, &q, &Moment::default());
            let by = missing(&is, &wanted);
            1e3 * by.fixed_rows::<3>(0).norm()
        };
        before = before.max(land(&line.numbers));
        after = after.max(land(fake));
    }
    assert!(before > 2.0, "{said:?}: {before} mm before");
    assert!(
        after < LANDS_MM,
        "{said:?}: {after} mm after, {before} before"
    );
    // moves relative to what carries the part go to the same numbers
    let coordinated = match said {
        _ if cell.tables.is_empty() => None,
        Said::Fanuc => Some(coordinated_fanuc(&text)),
        Said::Inform => Some(text.replace("MOVL C", "SMOVL C")),
        Said::Rapid | Said::Krl => None,
    };
    if let Some(text) = coordinated {
        assert!(text.contains("SMOVL") || text.contains("COORD"));
        let other = written_numbers(said, &written(&profile, &[(name, &text)]));
        assert_eq!(other, fakes, "{said:?}");
    }
    // nothing but the six numbers of a pose is another
    for line in &lines {
        for e in &line.e {
            assert!(out.contains(&e.to_string()), "{said:?}: {e} is gone");
        }
    }
}

#[test]
fn three_hundred_targets_on_a_rail_land_in_rapid() {
    lands(Said::Rapid, &rail_cell());
}

#[test]
fn three_hundred_targets_on_a_rail_land_in_krl() {
    lands(Said::Krl, &rail_cell());
}

#[test]
fn three_hundred_targets_on_a_rail_land_in_fanuc() {
    lands(Said::Fanuc, &rail_cell());
}

#[test]
fn three_hundred_targets_on_a_rail_land_in_inform() {
    lands(Said::Inform, &rail_cell());
}

#[test]
fn three_hundred_targets_on_one_rotary_axis_land_in_rapid_and_krl() {
    for said in [Said::Rapid, Said::Krl] {
        lands(said, &table_cell(1));
    }
}

#[test]
fn three_hundred_targets_on_two_rotary_axes_land_in_rapid_and_krl() {
    for said in [Said::Rapid, Said::Krl] {
        lands(said, &table_cell(2));
    }
}

#[test]
fn three_hundred_targets_on_two_rotary_axes_land_in_fanuc_and_inform() {
    for said in [Said::Fanuc, Said::Inform] {
        lands(said, &table_cell(2));
    }
}

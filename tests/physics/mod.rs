//! A second implementation of the physics: plain numbers, 4 × 4 matrices, no code of the product.
//!
//! It states every effect in its full form (a base that tilts is rotated about its origin, an arm
//! that grows has longer lengths), where the product adds up small motions. Metres, radians,
//! newtons. See docs/model.md for the equations.

pub mod external;
pub mod matrix;

use matrix::{M4, V3, add, cross, dot, point, sub, times};

/// A rigid mass on a link, 0 to 5, in its frame.
#[derive(Clone, Debug)]
pub struct Mass {
    pub link: usize,
    pub kg: f64,
    pub cog: V3,
}

/// A robot in numbers.
#[derive(Clone, Debug)]
pub struct Robot {
    pub base: M4,
    /// alpha, a, beta, theta, d of each row.
    pub rows: [[f64; 5]; 6],
    pub sign: [f64; 6],
    pub offset: [f64; 6],
    /// (joint, on, ratio): the controller counts `on` in.
    pub counted: Vec<(usize, usize, f64)>,
    pub flange: M4,
    pub tool: M4,
    pub masses: Vec<Mass>,
    /// Mass and centre of gravity of the tool in the flange frame.
    pub load: (f64, V3),
    pub gravity: V3,
}

/// The circumstances of one reading.
#[derive(Clone, Debug, Default)]
pub struct Moment {
    pub direction: [f64; 6],
    pub force: V3,
    pub temperature: f64,
    pub time: f64,
    /// Which of the points on the tool, from 0.
    pub point: Option<u32>,
    /// From 1.
    pub row: usize,
    pub rows: usize,
    /// From the posture before.
    pub moved: [f64; 6],
}

/// What may be wrong with a robot, its set-up or the session.
#[derive(Clone, Debug)]
pub enum Fault {
    /// Row, and what is added to alpha, a, beta, theta, d.
    Link(usize, [f64; 5]),
    /// x, y, z, rx, ry, rz in the base's frame.
    Base([f64; 6]),
    /// Likewise in the tool's frame.
    Tool([f64; 6]),
    Scale(usize, f64),
    Compliance(usize, f64),
    /// Mass and what is added to the centre of gravity.
    Payload(f64, V3),
    /// Joint, order, cosine and sine.
    Harmonic(usize, f64, f64, f64),
    /// Joint, full width.
    Backlash(usize, f64),
    /// Joint, the joint it leaks from, ratio.
    Leak(usize, usize, f64),
    /// Joint, torque, additional compliance below it.
    Knee(usize, f64, f64),
    /// Link, rad/(N m) about x and y of its frame.
    Bending(usize, f64, f64),
    /// rad/(N m) about x and y of the base.
    Pedestal(f64, f64),
    /// 1/K and the reference temperature.
    Growth(f64, f64),
    /// Joint, amplitude, time constant.
    JointDrift(usize, f64, f64),
    /// Displacement in the world, time constant.
    BaseDrift(V3, f64),
    /// First row, x, y, z, rx, ry, rz in the world.
    Shift(usize, [f64; 6]),
    /// First row, displacement in the tool's frame.
    Slip(usize, V3),
    /// Of this point alone.
    Reflector(u32, usize, V3),
    /// Joint, the part of its last move that is missing.
    Unsettled(usize, f64),
    /// Joint, rad/(N m) by the side it comes from.
    Friction(usize, f64),
    /// rad/(N m) about x and y of the flange under the tool's own weight.
    Adapter(f64, f64),
    /// The device's lengths are longer by this part.
    Longer(f64),
    /// Joint, amplitude, rows.
    JointCreep(usize, f64, f64),
    /// Displacement in the world, rows.
    BaseCreep(V3, f64),
    /// Part of all lengths, from the middle of the session on; rows.
    Lengthening(f64, f64),
    /// Not known to the product: a joint's error by any function of its commanded angles, torques
    /// and the moment.
    Joint(usize, fn(&[f64; 6], &[f64; 6], &Moment) -> f64, f64),
    /// Not known to the product: displacement of the measured point in the world.
    World(fn(&M4, &[f64; 6], &Moment) -> V3, f64),
}

/// The joint angles a controller means, in its own sense.
pub fn commanded(robot: &Robot, q: &[f64; 6]) -> [f64; 6] {
    let mut u = *q;
    for (joint, on, ratio) in &robot.counted {
        u[*joint] += ratio * q[*on];
    }
    u
}

fn row_matrix(row: &[f64; 5], angle: f64) -> M4 {
    let [alpha, a, beta, theta, d] = *row;
    let crossing = times(
        &matrix::turn_x(alpha),
        &times(&matrix::shift([a, 0.0, 0.0]), &matrix::turn_y(beta)),
    );
    times(
        &crossing,
        &times(
            &matrix::turn_z(theta + angle),
            &matrix::shift([0.0, 0.0, d]),
        ),
    )
}

/// The frame after each row, each row's angle being `angles`.
fn frames(base: &M4, rows: &[[f64; 5]; 6], angles: &[f64; 6]) -> [M4; 6] {
    let mut at = *base;
    std::array::from_fn(|i| {
        at = times(&at, &row_matrix(&rows[i], angles[i]));
        at
    })
}

/// Moment of all weights from link `from` on, and of the force, about a point of the world.
fn moment_about(
    robot: &Robot,
    load: (f64, V3),
    links: &[M4; 6],
    from: usize,
    about: V3,
    at: &Moment,
) -> V3 {
    let mut sum = [0.0; 3];
    let mut weigh = |kg: f64, place: V3| {
        let weight = robot.gravity.map(|g| g * kg);
        sum = add(sum, cross(sub(place, about), weight));
    };
    for mass in robot.masses.iter().filter(|m| m.link >= from) {
        weigh(mass.kg, point(&links[mass.link], mass.cog));
    }
    let flange = times(&links[5], &robot.flange);
    weigh(load.0, point(&flange, load.1));
    let nominal_tip = point(
        &flange,
        [robot.tool[0][3], robot.tool[1][3], robot.tool[2][3]],
    );
    add(sum, cross(sub(nominal_tip, about), at.force))
}

/// Moment of the tool's weight alone about the flange.
fn moment_about_flange(robot: &Robot, load: (f64, V3), flange: &M4) -> V3 {
    let origin = [flange[0][3], flange[1][3], flange[2][3]];
    let weight = robot.gravity.map(|g| g * load.0);
    cross(sub(point(flange, load.1), origin), weight)
}

/// All lengths of an arm in proportion.
fn lengthen(rows: &mut [[f64; 5]; 6], factor: f64) {
    for row in rows {
        row[1] *= factor;
        row[4] *= factor;
    }
}

/// Where the tool really is in the world at the controller's joint angles `q`.
pub fn tool_pose(robot: &Robot, faults: &[Fault], q: &[f64; 6], at: &Moment) -> M4 {
    let (mut base, mut tool, mut rows, mut load) = (robot.base, robot.tool, robot.rows, robot.load);
    for fault in faults {
        match fault {
            Fault::Base(p) => base = times(&base, &matrix::frame(p)),
            Fault::Tool(p) => tool = times(&tool, &matrix::frame(p)),
            Fault::Link(i, by) => (0..5).for_each(|k| rows[*i][k] += by[k]),
            Fault::Payload(kg, cog) => load = (load.0 + kg, add(load.1, *cog)),
            _ => {}
        }
    }
    let u = commanded(robot, q);
    let angle = |i: usize, u: f64| robot.sign[i] * u + robot.offset[i];
    let plain: [f64; 6] = std::array::from_fn(|i| angle(i, u[i]));
    let still = frames(&base, &rows, &plain);
    let origin = |m: &M4| [m[0][3], m[1][3], m[2][3]];
    let axis = |m: &M4, k: usize| [m[0][k], m[1][k], m[2][k]];
    let moments: [V3; 6] =
        std::array::from_fn(|i| moment_about(robot, load, &still, i, origin(&still[i]), at));
    let torques: [f64; 6] =
        std::array::from_fn(|i| robot.sign[i] * dot(moments[i], axis(&still[i], 2)));
    let mut own = u;
    let mut bent = [[0.0; 2]; 6];
    let mut tilt = [0.0; 2];
    let warm = |constant: f64| 1.0 - (-at.time / constant).exp();
    let later = |rows: f64| 1.0 - (-(at.row as f64) / rows).exp();
    let half = at.rows as f64 / 2.0;
    let from_half = |rows: f64| (-half / rows).exp() - (-(at.row as f64) / rows).exp();
    let still_flange = times(&still[5], &robot.flange);
    let hanging = moment_about_flange(robot, load, &still_flange);
    let mut adapter = [0.0; 2];
    for fault in faults {
        match fault {
            Fault::Scale(i, k) => own[*i] += k * u[*i],
            Fault::Compliance(i, c) => own[*i] += c * torques[*i],
            Fault::Harmonic(i, n, c, s) => own[*i] += c * (n * u[*i]).cos() + s * (n * u[*i]).sin(),
            Fault::Backlash(i, b) => own[*i] += 0.5 * b * at.direction[*i],
            Fault::Leak(i, on, k) => own[*i] += k * u[*on],
            Fault::Knee(i, t, c) => own[*i] += c * torques[*i].clamp(-t, *t),
            Fault::JointDrift(i, a, constant) => own[*i] += a * warm(*constant),
            Fault::Unsettled(i, part) => own[*i] -= part * at.moved[*i],
            Fault::Friction(i, c) => own[*i] += c * torques[*i].abs() * at.direction[*i],
            Fault::JointCreep(i, a, rows) => own[*i] += a * later(*rows),
            Fault::Adapter(x, y) => {
                adapter[0] += x * dot(hanging, axis(&still_flange, 0));
                adapter[1] += y * dot(hanging, axis(&still_flange, 1));
            }
            Fault::Joint(i, of, size) => own[*i] += size * of(&u, &torques, at),
            Fault::Bending(i, x, y) => {
                bent[*i][0] += x * dot(moments[*i], axis(&still[*i], 0));
                bent[*i][1] += y * dot(moments[*i], axis(&still[*i], 1));
            }
            Fault::Pedestal(x, y) => {
                let whole = moment_about(robot, load, &still, 0, origin(&base), at);
                tilt[0] += x * dot(whole, axis(&base, 0));
                tilt[1] += y * dot(whole, axis(&base, 1));
            }
            Fault::Growth(k, reference) => {
                lengthen(&mut rows, 1.0 + k * (at.temperature - reference));
            }
            Fault::Lengthening(part, constant) => {
                lengthen(&mut rows, 1.0 + part * from_half(*constant));
            }
            _ => {}
        }
    }
    let mut here = times(
        &base,
        &times(&matrix::turn_x(tilt[0]), &matrix::turn_y(tilt[1])),
    );
    for i in 0..6 {
        here = times(&here, &row_matrix(&rows[i], angle(i, own[i])));
        here = times(
            &here,
            &times(&matrix::turn_x(bent[i][0]), &matrix::turn_y(bent[i][1])),
        );
    }
    let bent = times(&matrix::turn_x(adapter[0]), &matrix::turn_y(adapter[1]));
    here = times(&here, &times(&robot.flange, &times(&bent, &tool)));
    for fault in faults {
        match fault {
            Fault::Slip(row, by) if at.row >= *row => here = times(&here, &matrix::shift(*by)),
            Fault::Reflector(point, row, by) if at.point == Some(*point) && at.row >= *row => {
                here = times(&here, &matrix::shift(*by));
            }
            Fault::BaseDrift(by, constant) => {
                here = times(&matrix::shift(by.map(|x| x * warm(*constant))), &here);
            }
            Fault::BaseCreep(by, rows) => {
                here = times(&matrix::shift(by.map(|x| x * later(*rows))), &here);
            }
            Fault::Longer(part) => (0..3).for_each(|k| here[k][3] *= 1.0 + part),
            Fault::Shift(row, p) if at.row >= *row => here = times(&matrix::frame(p), &here),
            Fault::World(of, size) => {
                here = times(&matrix::shift(of(&here, &u, at).map(|x| x * size)), &here);
            }
            _ => {}
        }
    }
    here
}

//! Tracks and positioners, written a second time: matrices, no code of the product. Metres and
//! radians.

use super::matrix::{M4, V3, cross, dot, frame, shift, times, turn_x, turn_y, turn_z};

/// What is wrong with a linear axis.
#[derive(Clone, Debug)]
pub enum RailFault {
    Scale(f64),
    /// Pitch and yaw.
    Direction(f64, f64),
    /// Along 0, 1, 2 of the rail; degree; metres at the end.
    Bent(usize, i32, f64),
    /// Along; period; cosine and sine.
    Ripple(usize, f64, f64, f64),
    /// About; degree; radians at the end.
    Turned(usize, i32, f64),
    /// Full width.
    Backlash(f64),
}

/// A linear axis.
#[derive(Clone, Debug)]
pub struct Rail {
    pub direction: V3,
    pub up: V3,
    pub zero: f64,
    pub low: f64,
    pub high: f64,
    pub faults: Vec<RailFault>,
}

/// What is wrong with a rotary axis.
#[derive(Clone, Debug)]
pub enum TableFault {
    /// x, y, rx, ry.
    Axis([f64; 4]),
    Zero(f64),
    Scale(f64),
    /// Order, cosine, sine.
    Ripple(f64, f64, f64),
    /// Along; order; cosine, sine.
    Runout(usize, f64, f64, f64),
}

/// A rotary axis.
#[derive(Clone, Debug)]
pub struct Table {
    pub at: M4,
    pub sign: f64,
    pub zero: f64,
    pub faults: Vec<TableFault>,
}

/// The rail's axes as columns: along, across, up.
fn columns(rail: &Rail) -> [V3; 3] {
    let x = rail.direction;
    let across = cross(rail.up, x);
    let length = dot(across, across).sqrt();
    let y = across.map(|c| c / length);
    [x, y, cross(x, y)]
}

/// Where the base stands when the rail is at `e` and was moving in `direction`, from where it
/// stands at zero.
pub fn carried(rail: &Rail, home: &M4, e: f64, direction: f64) -> M4 {
    let middle = f64::midpoint(rail.low, rail.high);
    let d = e - middle;
    let s = d / ((rail.high - rail.low) / 2.0);
    let (mut scale, mut pitch, mut yaw) = (0.0, 0.0, 0.0);
    let mut off = [0.0; 3];
    let mut turn = [0.0; 3];
    for fault in &rail.faults {
        match fault {
            RailFault::Scale(k) => scale += k,
            RailFault::Direction(y, z) => (pitch, yaw) = (pitch + y, yaw + z),
            RailFault::Bent(k, n, end) => off[*k] += end * s.powi(*n),
            RailFault::Ripple(k, period, c, sine) => {
                let phase = std::f64::consts::TAU * d / period;
                off[*k] += c * (phase.cos() - 1.0) + sine * phase.sin();
            }
            RailFault::Turned(k, n, end) => turn[*k] += end * s.powi(*n),
            RailFault::Backlash(width) => off[0] += 0.5 * width * direction,
        }
    }
    let gone = times(&turn_y(pitch), &turn_z(yaw));
    for (k, o) in off.iter_mut().enumerate() {
        *o += (1.0 + scale) * d * gone[k][0];
    }
    off[0] += middle - rail.zero;
    let axes = columns(rail);
    let r: M4 = {
        let mut m = shift([0.0; 3]);
        for i in 0..3 {
            for (j, axis) in axes.iter().enumerate() {
                m[i][j] = axis[i];
            }
        }
        m
    };
    let mut back = r;
    for i in 0..3 {
        for j in 0..3 {
            back[i][j] = r[j][i];
        }
    }
    let small = times(&turn_x(turn[0]), &times(&turn_y(turn[1]), &turn_z(turn[2])));
    let mut placed = times(&r, &times(&small, &back));
    let mut turned = *home;
    for i in 0..3 {
        turned[i][3] = 0.0;
    }
    placed = times(&placed, &turned);
    for i in 0..3 {
        placed[i][3] = home[i][3] + (0..3).map(|k| r[i][k] * off[k]).sum::<f64>();
    }
    placed
}

/// Where a positioner's plate is in the world.
pub fn plate(tables: &[Table], on_axis: &M4, plate_fault: &[f64; 6], e: &[f64]) -> M4 {
    let mut at = shift([0.0; 3]);
    for (table, e) in tables.iter().zip(e) {
        let u = table.sign * (e - table.zero);
        let mut place = [0.0; 6];
        let mut out = [0.0; 3];
        let mut angle = u;
        for fault in &table.faults {
            match fault {
                TableFault::Axis([x, y, rx, ry]) => place = [*x, *y, 0.0, *rx, *ry, 0.0],
                TableFault::Zero(by) => angle += by,
                TableFault::Scale(k) => angle += k * u,
                TableFault::Ripple(n, c, s) => angle += c * (n * u).cos() + s * (n * u).sin(),
                TableFault::Runout(k, n, c, s) => {
                    out[*k] += c * (n * u).cos() + s * (n * u).sin();
                }
            }
        }
        at = times(&at, &table.at);
        at = times(&at, &times(&frame(&place), &shift(out)));
        at = times(&at, &turn_z(angle));
    }
    times(&at, &times(on_axis, &frame(plate_fault)))
}

//! What measures, and the table it gives.

use super::{Group, NOISE_MM, normal};
use crate::physics::matrix::M4;
use poseshift::geometry::{Pose, Quaternion, Rotation};
use poseshift::model::Conditions;
use poseshift::model::effects::{Effect, Kind, Need};
use rand::RngExt;
use rand::rngs::StdRng;

/// Standard deviation of an orientation about each axis, radians.
const NOISE_RAD: f64 = 1e-4;
/// Reflectors in the tool's frame, metres.
const REFLECTORS: [[f64; 3]; 3] = [[0.0, 0.0, 0.0], [0.09, -0.02, -0.03], [-0.04, 0.08, 0.02]];
/// From where lengths are measured, metres.
const POSTS: [[f64; 3]; 4] = [
    [1.9, 1.6, 0.3],
    [1.7, -1.5, 0.2],
    [-1.4, 1.5, 1.9],
    [-1.6, -1.7, 0.1],
];

/// What a device reads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Reads {
    Positions,
    /// Of three points.
    Reflectors,
    /// From four posts in turn.
    Distances,
    Poses,
}

/// A device and the columns of its table.
#[derive(Clone, Debug)]
pub struct Device {
    reads: Reads,
    /// Heavy tails, gross errors in 3 % of the rows.
    rough: bool,
    sigma: bool,
    /// Columns that no effect hidden needs are left out.
    few: bool,
}

impl Device {
    /// Of a case.
    pub fn of(group: &Group, number: usize) -> Self {
        let plain = Self {
            reads: Reads::Positions,
            rough: group.rough,
            sigma: !group.rough,
            few: false,
        };
        if !group.devices {
            return plain;
        }
        // every robot meets every device
        let turn = (number + number / group.robots) % 6;
        Self {
            reads: [
                Reads::Positions,
                Reads::Reflectors,
                Reads::Distances,
                Reads::Poses,
                Reads::Positions,
                Reads::Poses,
            ][turn],
            sigma: !matches!(turn, 0 | 5),
            few: turn == 4,
            ..plain
        }
    }

    /// What the robot was calibrated with: the same, but positions where lengths from posts are too
    /// few numbers.
    pub fn calibrating(&self) -> Self {
        let reads = match self.reads {
            Reads::Distances => Reads::Positions,
            reads => reads,
        };
        Self {
            reads,
            few: true,
            ..self.clone()
        }
    }

    /// How many rows each pose has.
    pub fn rows_a_pose(&self) -> usize {
        match self.reads {
            Reads::Reflectors => REFLECTORS.len(),
            _ => 1,
        }
    }

    /// Whether its rows are positions of one point.
    pub fn reads_positions(&self) -> bool {
        self.reads == Reads::Positions
    }

    /// Effects that move what it reads: a device of lengths that are wrong reads other lengths from
    /// its posts, and no other place.
    pub fn moving(&self, hidden: &[Effect]) -> Vec<Effect> {
        let is_read =
            |e: &&Effect| self.reads != Reads::Distances || e.kind != Kind::MeasurementScale;
        hidden.iter().filter(is_read).cloned().collect()
    }

    /// The table of what it reads where the tool stands so, and the length of each position's noise
    /// in mm.
    pub fn table(
        &self,
        q: &[[f64; 6]],
        seen: &[M4],
        conditions: &[Conditions],
        hidden: &[Effect],
        random: &mut StdRng,
    ) -> (String, Vec<f64>) {
        let needs = |need| {
            let all = hidden.iter();
            !self.few || all.clone().any(|e| e.definition().needs.contains(&need))
        };
        let directions = needs(Need::Directions);
        let (temperature, time) = (needs(Need::Temperature), needs(Need::Time));
        let mut header = vec!["q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg"];
        header.push(match self.reads {
            Reads::Positions => "x_mm,y_mm,z_mm",
            Reads::Reflectors => "x_mm,y_mm,z_mm,px_mm,py_mm,pz_mm",
            Reads::Distances => "distance_mm,from_x_mm,from_y_mm,from_z_mm",
            Reads::Poses => "x_mm,y_mm,z_mm,qw,qx,qy,qz",
        });
        let optional = [
            (directions, "dir1,dir2,dir3,dir4,dir5,dir6"),
            (temperature, "temperature_c"),
            (time, "time_s"),
            (self.sigma, "sigma_mm"),
        ];
        header.extend(
            optional
                .iter()
                .filter(|(has, _)| *has)
                .map(|(_, name)| *name),
        );
        let mut text = header.join(",") + "\n";
        let mut noise = Vec::new();
        let scales = hidden.iter().filter(|e| e.kind == Kind::MeasurementScale);
        let longer = 1.0 + scales.map(|e| e.parameters[0]).sum::<f64>();
        for (r, pose) in seen.iter().enumerate() {
            let mut cells: Vec<String> = q[r]
                .iter()
                .map(|a| format!("{:.9}", a.to_degrees()))
                .collect();
            let (read, length) = self.read(r, pose, longer, random);
            noise.push(length);
            cells.extend(read);
            let c = &conditions[r];
            if directions {
                cells.extend(c.direction.iter().map(|d| format!("{d}")));
            }
            if temperature {
                cells.push(format!("{}", c.temperature_c.unwrap_or(0.0)));
            }
            if time {
                cells.push(format!("{}", c.time_s.unwrap_or(0.0)));
            }
            if self.sigma {
                cells.push(format!("{NOISE_MM}"));
            }
            text += &(cells.join(",") + "\n");
        }
        (text, noise)
    }

    /// The cells of one row, and the length of its noise in mm; distances are so many times `longer`.
    fn read(&self, row: usize, pose: &M4, longer: f64, random: &mut StdRng) -> (Vec<String>, f64) {
        let reflector = match self.reads {
            Reads::Reflectors => REFLECTORS[row % REFLECTORS.len()],
            _ => [0.0; 3],
        };
        let place: [f64; 3] = std::array::from_fn(|i| {
            let turned: f64 = (0..3).map(|k| pose[i][k] * reflector[k]).sum();
            1e3 * (pose[i][3] + turned)
        });
        let mut p = place;
        // Student's t with three degrees of freedom, and gross errors
        let heavy = if self.rough {
            let chi: f64 = (0..3).map(|_| normal(random).powi(2)).sum();
            (3.0 / chi).sqrt()
        } else {
            1.0
        };
        let gross = if self.rough && random.random_range(0.0..1.0) < 0.03 {
            random.random_range(1.0..10.0)
        } else {
            0.0
        };
        let mm = |x: f64| format!("{x:.6}");
        if self.reads == Reads::Distances {
            let from = POSTS[row % POSTS.len()].map(|m| 1e3 * m);
            let length = (0..3).map(|k| (p[k] - from[k]).powi(2)).sum::<f64>().sqrt();
            let error = NOISE_MM * normal(random);
            let mut cells = vec![mm(longer * length + error)];
            cells.extend(from.map(mm));
            return (cells, error.abs());
        }
        for x in &mut p {
            *x += NOISE_MM * heavy * normal(random) + gross * normal(random);
        }
        let length = (0..3)
            .map(|k| (p[k] - place[k]).powi(2))
            .sum::<f64>()
            .sqrt();
        let mut cells: Vec<String> = p.map(mm).to_vec();
        match self.reads {
            Reads::Reflectors => cells.extend(reflector.map(|m| mm(1e3 * m))),
            Reads::Poses => {
                let by: [f64; 3] = std::array::from_fn(|_| NOISE_RAD * normal(random));
                let error = Pose::from_xyz_rxryrz([0.0, 0.0, 0.0, by[0], by[1], by[2]]);
                let rotation =
                    Rotation(std::array::from_fn(|i| std::array::from_fn(|k| pose[i][k])));
                let Quaternion(quaternion) = (rotation * error.rotation).quaternion();
                cells.extend(quaternion.map(|x| format!("{x:.12}")));
            }
            _ => {}
        }
        (cells, length)
    }
}

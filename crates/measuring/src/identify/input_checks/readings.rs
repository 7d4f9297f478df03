//! Other ways in which a file of measurements may be meant: units, order of columns and rows,
//! signs, zeros.

use crate::geometry::units::DEG;
use crate::geometry::{Pose, Vector, scale};
use crate::identify::measurements::{Measurement, Measurements, Observed};

/// Another reading of the file: what it supposes, and the way out.
pub(super) struct Reading {
    pub supposes: String,
    pub hint: String,
    pub measurements: Measurements,
    /// Which two coordinates it exchanges: what is seen becomes its mirror image.
    pub exchanged: Option<[&'static str; 2]>,
}

/// Units that lengths may be in: how many millimetres, their name, and as columns and `--units` have
/// them.
pub(super) const LENGTHS: [(f64, &str, &str); 5] = [
    (1000.0, "metres", "m"),
    (10.0, "centimetres", "cm"),
    (25.4, "inches", "in"),
    (304.8, "feet", "ft"),
    (0.001, "micrometres", "um"),
];

/// What is to be done with lengths in another unit than millimetres.
pub(super) fn in_millimetres(unit: &str) -> String {
    format!(
        "x_mm,y_mm,z_mm and distance_mm are millimetres: with others their unit is in their names \
         (x_{unit}), or map them with --columns and --units {unit}"
    )
}

pub(super) const IN_DEGREES: &str = "q1_deg…q6_deg are degrees: with others their unit is in their names \
    (q1_rad), or map them with --columns and --units rad";
const SAME_ORDER: &str = "check that joints and points are in the same order and none is missing";

/// What was observed with lengths by a factor.
fn scaled(observed: Observed, factor: f64) -> Observed {
    match observed {
        Observed::Position(p) => Observed::Position(scale(factor, p)),
        Observed::Pose(pose) => Observed::Pose(Pose {
            translation: scale(factor, pose.translation),
            ..pose
        }),
        Observed::Distance { distance_m, from_m } => Observed::Distance {
            distance_m: factor * distance_m,
            from_m: scale(factor, from_m),
        },
        Observed::Contact(kind) => Observed::Contact(kind),
    }
}

/// What was observed with two coordinates exchanged.
fn exchanged(observed: Observed, a: usize, b: usize) -> Observed {
    let swap = |mut p: Vector| {
        p.swap(a, b);
        p
    };
    match observed {
        Observed::Position(p) => Observed::Position(swap(p)),
        Observed::Pose(pose) => Observed::Pose(Pose {
            translation: swap(pose.translation),
            ..pose
        }),
        Observed::Distance { distance_m, from_m } => Observed::Distance {
            distance_m,
            from_m: swap(from_m),
        },
        Observed::Contact(kind) => Observed::Contact(kind),
    }
}

struct Readings<'a> {
    measurements: &'a Measurements,
    all: Vec<Reading>,
}

impl Readings<'_> {
    fn add(
        &mut self,
        supposes: impl Into<String>,
        hint: impl Into<String>,
        change: impl Fn(usize, &mut Measurement),
    ) {
        let mut measurements = self.measurements.clone();
        for (i, row) in measurements.rows.iter_mut().enumerate() {
            change(i, row);
        }
        self.all.push(Reading {
            supposes: supposes.into(),
            hint: hint.into(),
            measurements,
            exchanged: None,
        });
    }

    fn units(&mut self) {
        let radians = |q: [f64; 6]| q.map(|q| q / DEG);
        self.add(
            "the joint angles are radians, not degrees",
            IN_DEGREES,
            move |_, row| row.q = radians(row.q),
        );
        for (factor, name, unit) in LENGTHS {
            self.add(
                format!("the lengths are {name}, not millimetres"),
                in_millimetres(unit),
                |_, row| row.observed = scaled(row.observed, factor),
            );
        }
        self.add(
            "the joint angles are radians and the lengths metres",
            format!("{IN_DEGREES}, {}", in_millimetres("m")),
            move |_, row| {
                row.q = radians(row.q);
                row.observed = scaled(row.observed, 1000.0);
            },
        );
    }

    fn axes(&mut self) {
        for (a, b) in [(0, 1), (0, 2), (1, 2)] {
            let names = ["x_mm", "y_mm", "z_mm"];
            self.add(
                format!("the columns {} and {} are swapped", names[a], names[b]),
                "the device's frame must be right-handed: look at the order of its columns and \
                 which way its axes point",
                |_, row| row.observed = exchanged(row.observed, a, b),
            );
            if let Some(added) = self.all.last_mut() {
                added.exchanged = Some([names[a], names[b]]);
            }
        }
    }

    fn joints(&mut self) {
        let order = "check the order of the joint columns";
        let measurements = self.measurements;
        let rows = &measurements.rows;
        // one that stands at zero counts in no direction
        let stands = |joint: &usize| rows.iter().all(|row| row.q[*joint] == 0.0);
        let turned: Vec<usize> = (0..6).filter(|joint| !stands(joint)).collect();
        for (at, &a) in turned.iter().enumerate() {
            self.add(
                format!("joint {} counts the other way", a + 1),
                format!(
                    "negate q{}_deg, or set the sign of joint {} in the profile",
                    a + 1,
                    a + 1
                ),
                |_, row| row.q[a] = -row.q[a],
            );
            for &b in &turned[at + 1..] {
                self.add(
                    format!("joints {} and {} count the other way", a + 1, b + 1),
                    format!(
                        "negate q{}_deg and q{}_deg, or set their signs in the profile",
                        a + 1,
                        b + 1
                    ),
                    |_, row| {
                        row.q[a] = -row.q[a];
                        row.q[b] = -row.q[b];
                    },
                );
            }
        }
        for a in 0..6 {
            for b in a + 1..6 {
                self.add(
                    format!("the columns q{}_deg and q{}_deg are swapped", a + 1, b + 1),
                    order,
                    |_, row| row.q.swap(a, b),
                );
            }
        }
        self.add(
            "the joint columns stand in the opposite order",
            order,
            |_, row| {
                row.q.reverse();
            },
        );
        for by in [1, 5] {
            self.add(
                "the joint columns begin with another joint",
                order,
                |_, row| {
                    row.q.rotate_left(by);
                },
            );
        }
        // where the base and the tool do not absorb it
        for joint in 1..5 {
            for by in [-90.0, 90.0] {
                self.add(
                    format!("the zero of joint {} is {by} deg elsewhere", joint + 1),
                    format!(
                        "add {by} to q{}_deg, or set the offset of joint {} in the profile",
                        joint + 1,
                        joint + 1
                    ),
                    |_, row| row.q[joint] += by * DEG,
                );
            }
        }
        for (sign, which) in [(-1.0, "q3 + q2"), (1.0, "q3 - q2")] {
            self.add(
                format!(
                    "q3_deg is {which} of the profile's joints: joint 3 counts from the horizontal"
                ),
                "`coupling` in the profile's joints says which joint a controller counts along",
                |_, row| row.q[2] += sign * row.q[1],
            );
        }
    }

    fn rows(&mut self) {
        let observed: Vec<Observed> = self.measurements.rows.iter().map(|r| r.observed).collect();
        let count = observed.len();
        for (by, word) in [(1, "later"), (count - 1, "earlier")] {
            self.add(
                format!("the measured points belong to the joint angles one row {word}"),
                SAME_ORDER,
                |i, row| row.observed = observed[(i + by) % count],
            );
        }
        self.add(
            "the measured points stand in the opposite order",
            SAME_ORDER,
            |i, row| row.observed = observed[count - 1 - i],
        );
    }
}

/// All that is tried.
pub(super) fn readings(measurements: &Measurements) -> Vec<Reading> {
    let mut all = Readings {
        measurements,
        all: Vec::new(),
    };
    if measurements.rows.is_empty() {
        return Vec::new();
    }
    all.units();
    all.axes();
    all.joints();
    all.rows();
    all.all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_joint_at_zero_counts_in_no_direction() {
        let text = "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg,x_mm,y_mm,z_mm\n\
                    10,20,30,0,40,50,1,2,3\n20,10,25,0,30,60,2,3,4\n";
        let rows = Measurements::from_csv(text.as_bytes()).expect("rows");
        let all = readings(&rows);
        let of_signs = all.iter().filter(|r| r.supposes.contains("the other way"));
        let of_signs: Vec<&str> = of_signs.map(|r| &*r.supposes).collect();
        // five joints, and ten pairs of them; each before its pairs
        assert_eq!(of_signs.len(), 15);
        assert_eq!(of_signs[0], "joint 1 counts the other way");
        assert!(of_signs.iter().all(|supposes| !supposes.contains('4')));
    }
}

//! Hand-eye calibration: where a camera is, from poses of the robot and of a board that the camera
//! sees.
//!
//! Eye in hand: `base_from_board = base_from_flange · X · camera_from_board` stays, `X =
//! flange_from_camera`. Eye to hand: `flange_from_board = base_from_flange⁻¹ · X ·
//! camera_from_board` stays, `X = base_from_camera`. With `A = base_from_flange` or its inverse
//! both are `Y = A_i X B_i`, and pairs of rows give `A X = X B`.
//!
//! Four closed forms ([`Method`]) give the start; [`refined`](HandEye::refined) fits X and Y to all
//! rows together, with covariance. The work is linear in the number of poses.

mod corners;
mod methods;
mod refine;

pub use corners::{Corners, refine_by_corners};
pub use refine::{PoseResidual, Refined};

use crate::geometry::{Pose, Quaternion, norm};
use nalgebra::Matrix3;

/// Where the camera is mounted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Setup {
    /// The camera stands in the cell, the board is on the flange: X is `base_from_camera`, Y
    /// `flange_from_board`.
    EyeToHand,
    /// The camera is on the flange, the board stands in the cell: X is `flange_from_camera`, Y
    /// `base_from_board`.
    EyeInHand,
}

/// A closed form for `A X = X B`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// R. Tsai, R. Lenz, "A new technique for fully autonomous and efficient 3D robotics hand/eye
    /// calibration" (1989).
    Tsai,
    /// F. Park, B. Martin, "Robot sensor calibration: solving AX = XB on the Euclidean group"
    /// (1994).
    Park,
    /// R. Horaud, F. Dornaika, "Hand-eye calibration" (1995), with whole quaternions.
    Horaud,
    /// K. Daniilidis, "Hand-eye calibration using dual quaternions" (1999).
    Daniilidis,
}

impl Method {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Tsai, Self::Park, Self::Horaud, Self::Daniilidis];

    /// Name in reports.
    #[must_use]
    pub fn id(self) -> &'static str {
        match self {
            Self::Tsai => "tsai",
            Self::Park => "park",
            Self::Horaud => "horaud",
            Self::Daniilidis => "daniilidis",
        }
    }
}

/// Rows whose rotations about the second strongest direction stay below this give no camera pose,
/// radians.
const REFUSED_RAD: f64 = 0.01;
/// Below this they give a poor one, radians.
pub const WEAK_RAD: f64 = 0.17;
/// Rotation angles of robot and board may differ by so much (root mean square), radians.
const ANGLES_RAD: f64 = 0.05;
/// Rotations left over above this are no noise, radians.
const GROSS_RAD: f64 = 0.1;
/// Distances left over above this part of the spread of the positions are no noise.
const GROSS_PART: f64 = 0.05;
/// Positions of robot and board that spread less are in another unit, metres.
const SMALLEST_M: f64 = 3e-3;
/// Another unit is meant where it leaves less than this part of the distances.
const OTHER_UNIT: f64 = 0.1;
/// With so many poses or fewer every pair is used.
const ALL_PAIRS: usize = 25;

/// Why poses give no camera pose.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum HandEyeError {
    /// Different numbers of poses.
    #[error("the robot has {robot} poses and the board has {board}: rows must match")]
    Counts {
        /// Of the robot.
        robot: usize,
        /// Of the board.
        board: usize,
    },
    /// Too few poses.
    #[error("{found} poses; hand-eye calibration takes at least 3, and about 15 to be any good")]
    TooFew {
        /// How many there are.
        found: usize,
    },
    /// The robot does not rotate.
    #[error(
        "the robot's poses do not rotate: {found_deg:.3} deg between them (limit {limit_deg:.2} \
         deg)"
    )]
    NoRotation {
        /// Root mean square rotation between poses, degrees.
        found_deg: f64,
        /// The least that is accepted, degrees.
        limit_deg: f64,
    },
    /// All rotations about one axis.
    #[error("all poses rotate about one axis ({:.3}, {:.3}, {:.3}), with {across_deg:.3} deg about \
        others (limit {limit_deg:.2} deg): the camera's place along it is not \
        determined", axis[0], axis[1], axis[2])]
    OneAxis {
        /// The axis in the flange (eye in hand) or base frame.
        axis: [f64; 3],
        /// Root mean square rotation about the second direction, degrees.
        across_deg: f64,
        /// The least that is accepted, degrees.
        limit_deg: f64,
    },
    /// Robot and board rotate by different angles.
    #[error(
        "robot and board turn by different angles: {apart_deg:.2} deg root mean square (limit \
         {limit_deg:.1} deg), most at row {row}: do the rows belong together?"
    )]
    Angles {
        /// Root mean square difference, degrees.
        apart_deg: f64,
        /// The most that is accepted, degrees.
        limit_deg: f64,
        /// Row (from 1) that is in the worst pairs.
        row: usize,
    },
    /// Neither robot nor board moves.
    #[error(
        "the positions of robot and board spread over {spread_mm:.3} mm only (limit {limit_mm:.0} \
         mm): are they in metres?"
    )]
    TooSmall {
        /// Root mean square distance from the middle, mm.
        spread_mm: f64,
        /// The least that is accepted, mm.
        limit_mm: f64,
    },
    /// The best solution leaves more than noise.
    #[error("the best solution leaves {left_deg:.2} deg and {left_mm:.1} mm: {advice}")]
    Gross {
        /// Root mean square rotation left, degrees.
        left_deg: f64,
        /// Root mean square distance left, mm.
        left_mm: f64,
        /// What fits better.
        advice: String,
    },
    /// A closed form has no solution.
    #[error("the {method} method has no solution for these poses")]
    NoSolution {
        /// Which.
        method: &'static str,
    },
}

/// A motion of the robot and of the board between two rows: `A X = X B`.
#[derive(Clone, Copy, Debug)]
struct Motion {
    a: Pose,
    b: Pose,
    rows: [usize; 2],
}

/// Rows of robot and board poses that are known to suffice.
#[derive(Clone, Debug)]
pub struct HandEye {
    setup: Setup,
    /// `base_from_flange` or its inverse.
    a: Vec<Pose>,
    /// `camera_from_board`.
    b: Vec<Pose>,
    motions: Vec<Motion>,
    /// Root mean square distance of the robot's or the board's positions from their middle.
    reach_m: f64,
    /// Root mean square rotations about the main directions, largest first, radians.
    pub spread_rad: [f64; 3],
}

impl HandEye {
    /// Takes rows of `base_from_flange` and `camera_from_board`.
    ///
    /// # Errors
    /// If rows are too few, do not rotate about two directions, or do not belong together.
    pub fn new(setup: Setup, robot: &[Pose], board: &[Pose]) -> Result<Self, HandEyeError> {
        if robot.len() != board.len() {
            return Err(HandEyeError::Counts {
                robot: robot.len(),
                board: board.len(),
            });
        }
        if robot.len() < 3 {
            return Err(HandEyeError::TooFew { found: robot.len() });
        }
        let a: Vec<Pose> = match setup {
            Setup::EyeInHand => robot.to_vec(),
            Setup::EyeToHand => robot.iter().map(Pose::inverse).collect(),
        };
        let b = board.to_vec();
        let motions = motions(&a, &b);
        let spread_rad = spread(&motions)?;
        agree(&motions, a.len())?;
        let reach_m = reach_m(robot).max(reach_m(board));
        if reach_m < SMALLEST_M {
            return Err(HandEyeError::TooSmall {
                spread_mm: reach_m * 1e3,
                limit_mm: SMALLEST_M * 1e3,
            });
        }
        Ok(Self {
            setup,
            a,
            b,
            motions,
            reach_m,
            spread_rad,
        })
    }

    /// How the camera is mounted.
    #[must_use]
    pub fn setup(&self) -> Setup {
        self.setup
    }

    /// Number of rows.
    #[must_use]
    pub fn count(&self) -> usize {
        self.a.len()
    }

    /// The camera's pose X by a closed form.
    ///
    /// # Errors
    /// If the method has no solution.
    pub fn by(&self, method: Method) -> Result<Pose, HandEyeError> {
        let found = match method {
            Method::Tsai => methods::tsai(&self.motions),
            Method::Park => methods::park(&self.motions),
            Method::Horaud => methods::horaud(&self.motions),
            Method::Daniilidis => methods::daniilidis(&self.motions),
        };
        found.ok_or(HandEyeError::NoSolution {
            method: method.id(),
        })
    }

    /// The camera's and the board's pose that fit all rows best, with covariance.
    ///
    /// # Errors
    /// If no method has a start, or more is left than noise; then with what would fit.
    pub fn refined(&self) -> Result<Refined, HandEyeError> {
        let refined = self.refine()?;
        let turned = refined.rotation_rad >= GROSS_RAD;
        if self.fits(&refined) {
            return Ok(refined);
        }
        Err(HandEyeError::Gross {
            left_deg: refined.rotation_rad.to_degrees(),
            left_mm: refined.distance_m * 1e3,
            advice: if turned {
                self.advice()
            } else {
                self.unit_advice(refined.distance_m)
            },
        })
    }

    /// Whether no more than noise is left.
    fn fits(&self, found: &Refined) -> bool {
        found.rotation_rad < GROSS_RAD && found.distance_m <= GROSS_PART * self.reach_m
    }

    fn refine(&self) -> Result<Refined, HandEyeError> {
        let start = [Method::Park, Method::Daniilidis, Method::Horaud]
            .into_iter()
            .find_map(|method| self.by(method).ok());
        let start = start.ok_or(HandEyeError::NoSolution { method: "park" })?;
        Ok(refine::refine(&self.a, &self.b, start))
    }

    /// What else the files may hold, by what fits.
    ///
    /// `A⁻¹ X B = Y` is `A Y B⁻¹ = X`: where ROBOT's poses inverted fit, BOARD's inverted fit as
    /// well, with X and Y in each other's place.
    fn advice(&self) -> String {
        let a: Vec<Pose> = self.a.iter().map(Pose::inverse).collect();
        let other = Self {
            motions: motions(&a, &self.b),
            a,
            ..self.clone()
        };
        let fit = other.refine().ok();
        let Some(fit) = fit.filter(|fit| other.fits(fit)) else {
            return self.order_advice();
        };
        let (holder, other_holder) = match self.setup {
            Setup::EyeInHand => ("flange", "base"),
            Setup::EyeToHand => ("base", "flange"),
        };
        let away_mm = |pose: &Pose| norm(pose.translation) * 1e3;
        let (camera, board) = (away_mm(&fit.camera), away_mm(&fit.board));
        format!(
            "it fits with the other --setup (the camera {camera:.0} mm from the {other_holder}), \
             with ROBOT inverted (flange_from_base given for base_from_flange; {camera:.0} mm from \
             the {holder}), or with BOARD inverted (board_from_camera given for camera_from_board; \
             {board:.0} mm from the {holder}); the poses do not say which: see where the camera \
             stands"
        )
    }

    /// In which files quaternions may have the scalar last, by what fits.
    fn order_advice(&self) -> String {
        let last = |poses: &[Pose], is_last: bool| -> Vec<Pose> {
            if is_last {
                poses.iter().map(scalar_last).collect()
            } else {
                poses.to_vec()
            }
        };
        for (names, robot, board) in [
            ("BOARD's", false, true),
            ("ROBOT's", true, false),
            ("both files'", true, true),
        ] {
            let (a, b) = (last(&self.a, robot), last(&self.b, board));
            let motions = motions(&a, &b);
            let other = Self {
                a,
                b,
                motions,
                ..self.clone()
            };
            if other.refine().is_ok_and(|found| other.fits(&found)) {
                return format!(
                    "with {names} quaternions in the order x, y, z, w it fits: name the columns \
                     qx,qy,qz,qw as they stand"
                );
            }
        }
        TOGETHER.to_owned()
    }

    /// In which unit the positions may be, by what fits.
    fn unit_advice(&self, left_m: f64) -> String {
        let fits = |robot: f64, board: f64| {
            let (a, b) = (scaled(&self.a, robot), scaled(&self.b, board));
            let motions = motions(&a, &b);
            let other = Self {
                a,
                b,
                motions,
                ..self.clone()
            };
            other
                .refine()
                .is_ok_and(|r| r.distance_m < OTHER_UNIT * left_m)
        };
        for (factor, unit) in UNITS {
            for (name, robot, board) in [("ROBOT", factor, 1.0), ("BOARD", 1.0, factor)] {
                if fits(robot, board) {
                    return format!("with {name}'s positions times {factor} ({unit}) it fits");
                }
            }
        }
        // both files read otherwise fit in rotation
        self.order_advice()
    }
}

/// A pose whose quaternion was read in the order w, x, y, z and stood in the order x, y, z, w.
fn scalar_last(pose: &Pose) -> Pose {
    let Quaternion([x, y, z, w]) = pose.rotation.quaternion();
    Pose::from_parts(pose.translation, Quaternion([w, x, y, z]))
}

/// What positions in other units are multiplied by to be millimetres.
const UNITS: [(f64, &str); 3] = [(1e3, "metres"), (10.0, "centimetres"), (25.4, "inches")];

/// Advice where nothing else fits.
const TOGETHER: &str = "do the rows of ROBOT and BOARD belong together?";

fn scaled(poses: &[Pose], factor: f64) -> Vec<Pose> {
    let one = |pose: &Pose| Pose {
        translation: pose.translation.map(|x| x * factor),
        ..*pose
    };
    poses.iter().map(one).collect()
}

/// Root mean square distance of positions from their middle, metres.
#[allow(clippy::cast_precision_loss)]
fn reach_m(poses: &[Pose]) -> f64 {
    let n = poses.len() as f64;
    let squares = (0..3).map(|k| {
        let mean = poses.iter().map(|p| p.translation[k]).sum::<f64>() / n;
        let off = poses.iter().map(|p| (p.translation[k] - mean).powi(2));
        off.sum::<f64>() / n
    });
    squares.sum::<f64>().sqrt()
}

/// Pairs of rows: all of few; of many each with its next ones and some far away, so that their
/// number stays linear.
fn motions(a: &[Pose], b: &[Pose]) -> Vec<Motion> {
    let n = a.len();
    let motion = |i: usize, j: usize| Motion {
        a: a[j].inverse() * a[i],
        b: b[j] * b[i].inverse(),
        rows: [i, j],
    };
    if n <= ALL_PAIRS {
        return (0..n)
            .flat_map(|i| (i + 1..n).map(move |j| (i, j)))
            .map(|(i, j)| motion(i, j))
            .collect();
    }
    let strides = [1, 2, n / 3, n / 2];
    (0..n)
        .flat_map(|i| strides.map(|s| (i, (i + s) % n)))
        .map(|(i, j)| motion(i, j))
        .collect()
}

/// Root mean square rotation about the main directions, or why it does not suffice.
fn spread(motions: &[Motion]) -> Result<[f64; 3], HandEyeError> {
    let mut sum = Matrix3::zeros();
    for motion in motions {
        let v = nalgebra::Vector3::from(motion.a.rotation.vector());
        sum += v * v.transpose();
    }
    #[allow(clippy::cast_precision_loss)]
    let eigen = (sum / motions.len() as f64).symmetric_eigen();
    let mut order = [0, 1, 2];
    order.sort_by(|i, j| eigen.eigenvalues[*j].total_cmp(&eigen.eigenvalues[*i]));
    let spread = order.map(|i| eigen.eigenvalues[i].max(0.0).sqrt());
    let limit_deg = REFUSED_RAD.to_degrees();
    if spread[0].is_nan() || spread[0] < REFUSED_RAD {
        return Err(HandEyeError::NoRotation {
            found_deg: spread[0].to_degrees(),
            limit_deg,
        });
    }
    if spread[1] < REFUSED_RAD {
        let axis = eigen.eigenvectors.column(order[0]);
        return Err(HandEyeError::OneAxis {
            axis: [axis[0], axis[1], axis[2]],
            across_deg: spread[1].to_degrees(),
            limit_deg,
        });
    }
    Ok(spread)
}

/// Both sides of `A X = X B` turn by the same angle, whatever X is.
fn agree(motions: &[Motion], rows: usize) -> Result<(), HandEyeError> {
    let mut sum = 0.0;
    let mut blame = vec![0.0; rows];
    for motion in motions {
        let gap = norm(motion.a.rotation.vector()) - norm(motion.b.rotation.vector());
        sum += gap * gap;
        for row in motion.rows {
            blame[row] += gap * gap;
        }
    }
    #[allow(clippy::cast_precision_loss)]
    let apart = (sum / motions.len() as f64).sqrt();
    if apart > ANGLES_RAD {
        let worst = (0..rows).fold(0, |w, i| if blame[i] > blame[w] { i } else { w });
        return Err(HandEyeError::Angles {
            apart_deg: apart.to_degrees(),
            limit_deg: ANGLES_RAD.to_degrees(),
            row: worst + 1,
        });
    }
    Ok(())
}

//! Measurements: what a device saw of the tool, one row a reading.

use super::contact::{Contact, ContactKind};
use super::error::IdentifyError;
use super::external;
use super::line::Line;
use crate::geometry::units::DEG;
use crate::geometry::{Pose, Vector};
use crate::model::effects::MOST_EXTERNAL_AXES;
use crate::model::external::Stand;
use crate::model::{Conditions, Mechanism};
use crate::profile::Profile;
use std::borrow::Cow;
use std::collections::HashMap;

pub use super::fault::{MeasurementError, MeasurementFault, beyond};

/// Joint angles nearer than this are those of one configuration, radians: encoders read the same pose
/// a little otherwise each time.
const SAME_RAD: f64 = 0.01 * DEG;
/// Parts of a sum of angles that differs from configuration to configuration.
const ALONG: [f64; 6] = [0.31, 0.23, 0.17, 0.13, 0.11, 0.05];
const MOST_EXTERNAL: usize = MOST_EXTERNAL_AXES as usize;

/// Columns of joint angles.
pub const JOINT_COLUMNS: [&str; 6] = ["q1_deg", "q2_deg", "q3_deg", "q4_deg", "q5_deg", "q6_deg"];
/// Columns of a position.
pub const POSITION_COLUMNS: [&str; 3] = ["x_mm", "y_mm", "z_mm"];
/// Columns of an orientation.
pub const QUATERNION_COLUMNS: [&str; 4] = ["qw", "qx", "qy", "qz"];
/// Columns of a distance from a fixed point of the world.
pub const DISTANCE_COLUMNS: [&str; 4] = ["distance_mm", "from_x_mm", "from_y_mm", "from_z_mm"];
/// Columns of the measured point in the tool frame.
pub const POINT_COLUMNS: [&str; 3] = ["px_mm", "py_mm", "pz_mm"];
/// Columns of the directions in which the joints last moved.
pub const DIRECTION_COLUMNS: [&str; 6] = ["dir1", "dir2", "dir3", "dir4", "dir5", "dir6"];
/// Columns of how far the joints moved last.
pub const MOVE_COLUMNS: [&str; 6] = [
    "move1_deg",
    "move2_deg",
    "move3_deg",
    "move4_deg",
    "move5_deg",
    "move6_deg",
];
/// Columns of where linear external axes stood, in the order in which a profile lists its axes.
pub const EXTERNAL_MM_COLUMNS: [&str; MOST_EXTERNAL] = [
    "e1_mm", "e2_mm", "e3_mm", "e4_mm", "e5_mm", "e6_mm", "e7_mm", "e8_mm", "e9_mm", "e10_mm",
    "e11_mm", "e12_mm",
];
/// Columns of where rotary external axes stood, likewise.
pub const EXTERNAL_DEG_COLUMNS: [&str; MOST_EXTERNAL] = [
    "e1_deg", "e2_deg", "e3_deg", "e4_deg", "e5_deg", "e6_deg", "e7_deg", "e8_deg", "e9_deg",
    "e10_deg", "e11_deg", "e12_deg",
];
/// Columns of the directions in which external axes last moved.
pub const EXTERNAL_DIRECTION_COLUMNS: [&str; MOST_EXTERNAL] = [
    "dir_e1", "dir_e2", "dir_e3", "dir_e4", "dir_e5", "dir_e6", "dir_e7", "dir_e8", "dir_e9",
    "dir_e10", "dir_e11", "dir_e12",
];
/// Columns of the external force on the tool.
pub const FORCE_COLUMNS: [&str; 3] = ["fx_n", "fy_n", "fz_n"];

/// Columns of a wanted position, for tables that have no measured one but the difference from it.
pub const TARGET_COLUMNS: [&str; 3] = ["target_x_mm", "target_y_mm", "target_z_mm"];
/// Columns of the measured position less the wanted one.
pub const DIFFERENCE_COLUMNS: [&str; 3] = ["diff_x_mm", "diff_y_mm", "diff_z_mm"];
/// Columns of a touched sphere's centre, of a point of a touched plane, or of a touched point.
pub const CENTRE_COLUMNS: [&str; 3] = ["cx_mm", "cy_mm", "cz_mm"];
/// Columns of the outward normal of a touched plane.
pub const NORMAL_COLUMNS: [&str; 3] = ["nx", "ny", "nz"];

/// What the device gave.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Observed {
    /// The measured point in the world, metres.
    Position(Vector),
    /// The measured point with the tool's axes in the world.
    Pose(Pose),
    /// Distance of the measured point from a point of the world, metres.
    Distance {
        /// The distance.
        distance_m: f64,
        /// Where it is measured from.
        from_m: Vector,
    },
    /// Contact with something of which not all is known; see [`Measurement::contact`].
    Contact(ContactKind),
}

impl Observed {
    /// How many numbers are compared: 3, 6, 1, or those of the contact.
    #[must_use]
    pub const fn count(&self) -> usize {
        match self {
            Self::Position(_) => 3,
            Self::Pose(_) => 6,
            Self::Distance { .. } => 1,
            Self::Contact(kind) => kind.count(),
        }
    }

    /// The measured point in the world, where it was seen.
    #[must_use]
    pub const fn point_m(&self) -> Option<Vector> {
        match self {
            Self::Position(p) => Some(*p),
            Self::Pose(pose) => Some(pose.translation),
            Self::Distance { .. } | Self::Contact(_) => None,
        }
    }
}

/// What a row is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Purpose {
    /// To identify with.
    Fit,
    /// To judge with.
    Validate,
}

impl Purpose {
    /// Its name in the column `set`.
    #[must_use]
    pub const fn id(self) -> &'static str {
        match self {
            Self::Fit => "fit",
            Self::Validate => "validate",
        }
    }
}

/// One reading.
#[derive(Clone, Debug, PartialEq)]
pub struct Measurement {
    /// Where it stands.
    pub line: Line,
    /// The column `id`, else the row's number from 1.
    pub id: String,
    /// Commanded joint angles in the controller's sense, radians.
    pub q: [f64; 6],
    /// What the device gave.
    pub observed: Observed,
    /// Name of the tool.
    pub tool: Option<String>,
    /// Name of the measured point.
    pub point: Option<String>,
    /// The measured point in the tool frame, or in the plate's, metres.
    pub point_in_tool_m: Option<Vector>,
    /// Direction, force, temperature, time.
    pub conditions: Conditions,
    /// Where external axes stood.
    pub stand: Stand,
    /// Name of the positioner on whose plate the point is; else it is on the tool, and `q` says
    /// where.
    pub plate: Option<String>,
    /// Standard uncertainty of a coordinate or distance, metres.
    pub sigma_m: Option<f64>,
    /// Standard uncertainty of an orientation about an axis, radians.
    pub sigma_rad: Option<f64>,
    /// What the row is for.
    pub purpose: Option<Purpose>,
    /// What the probe touched.
    pub contact: Option<Contact>,
}

/// A file's readings in the order in which they were measured.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Measurements {
    /// The readings.
    pub rows: Vec<Measurement>,
    /// Names of the columns, as the file has them.
    pub columns: Vec<String>,
}

/// How far the joints moved last at each of these postures, one after another: an arm that stands
/// still has not moved since. Of the first nothing is known.
#[must_use]
pub fn last_moves(postures: &[[f64; 6]]) -> Vec<[f64; 6]> {
    let mut moved = [0.0; 6];
    let mut moves = vec![moved; postures.len().min(1)];
    moves.extend(postures.windows(2).map(|pair| {
        if pair[0] != pair[1] {
            moved = std::array::from_fn(|i| pair[1][i] - pair[0][i]);
        }
        moved
    }));
    moves
}

/// A joint that moves by less has not moved: a controller's readings differ in their last digits.
/// Radians.
const STILL_RAD: f64 = 0.005 * DEG;

/// From which side each joint comes at each of these postures, one after another: that of the angle
/// which turns the joint, a coupled one's with the other joint's part. A joint that stands still
/// keeps its side; of the first posture nothing is known.
#[must_use]
pub fn last_directions(arm: &Mechanism, postures: &[[f64; 6]]) -> Vec<[f64; 6]> {
    let mut last = [0.0; 6];
    let mut before: Option<[f64; 6]> = None;
    let direction = |q: &[f64; 6]| {
        let q = arm.commanded(q);
        let from = before.get_or_insert(q);
        for joint in 0..6 {
            let moved = q[joint] - from[joint];
            if moved.abs() > STILL_RAD {
                last[joint] = moved.signum();
                from[joint] = q[joint];
            }
        }
        last
    };
    postures.iter().map(direction).collect()
}

impl Measurement {
    /// Gives the reading in another frame; forces stay along the axes of the world.
    pub(crate) fn move_by(&mut self, to_from_here: &Pose) {
        self.conditions.device_m = to_from_here.transform(self.conditions.device_m);
        match &mut self.observed {
            Observed::Position(point) => *point = to_from_here.transform(*point),
            Observed::Pose(pose) => *pose = *to_from_here * *pose,
            Observed::Distance { from_m, .. } => *from_m = to_from_here.transform(*from_m),
            Observed::Contact(_) => {}
        }
        if let Some(contact) = &mut self.contact {
            contact.centre_m = contact
                .centre_m
                .map(|centre| to_from_here.transform(centre));
            contact.normal = contact.normal.map(|normal| to_from_here.rotation * normal);
        }
    }
}

impl Measurements {
    /// Whether the file has all these columns.
    #[must_use]
    pub fn has(&self, columns: &[&str]) -> bool {
        let has = |column: &&str| self.columns.iter().any(|name| name == *column);
        columns.iter().all(has)
    }

    /// The same readings in another frame; forces stay along the axes of the world.
    #[must_use]
    pub fn moved(mut self, to_from_here: &Pose) -> Self {
        for row in &mut self.rows {
            row.move_by(to_from_here);
        }
        self
    }

    /// The readings in the controller's world, by where the profile has the device.
    ///
    /// # Errors
    /// External axes that the profile lists and the readings do not say, or the other way round;
    /// one beyond its limits.
    pub fn in_world_of(&self, profile: &Profile) -> Result<Cow<'_, Self>, IdentifyError> {
        external::agree(self, profile)?;
        Ok(match &profile.device {
            Some(device) => Cow::Owned(self.clone().moved(&device.world_from_device)),
            None => Cow::Borrowed(self),
        })
    }

    /// Those rows that `keep` wants.
    #[must_use]
    pub fn filtered(&self, mut keep: impl FnMut(usize, &Measurement) -> bool) -> Self {
        let kept = self
            .rows
            .iter()
            .enumerate()
            .filter(|(i, row)| keep(*i, row));
        Self {
            rows: kept.map(|(_, row)| row.clone()).collect(),
            columns: self.columns.clone(),
        }
    }

    /// The rows of the tool, and those of points on plates.
    #[must_use]
    pub fn split(mut self) -> (Self, Self) {
        let plates = self.filtered(|_, row| row.plate.is_some());
        self.rows.retain(|row| row.plate.is_none());
        (self, plates)
    }

    /// The number of the configuration of each row, from 0 by first appearance: rows with external
    /// axes at the same places and joint angles nearer than 0.01° are one, whenever they were
    /// measured.
    #[must_use]
    pub fn configurations(&self) -> Vec<usize> {
        numbered(self.rows.iter().map(|row| (&row.q, &row.stand)))
    }
}

/// The number of the configuration of each of these joint angles and places of external axes, as
/// [`Measurements::configurations`].
pub(super) fn numbered<'a>(rows: impl Iterator<Item = (&'a [f64; 6], &'a Stand)>) -> Vec<usize> {
    // a sum of angles differs by no more than they do
    let cell = |q: &[f64; 6]| {
        let along: f64 = q.iter().zip(ALONG).map(|(q, part)| q * part).sum();
        #[allow(
            clippy::cast_possible_truncation,
            reason = "angles are far below 2^52 of these"
        )]
        let cell = (along / SAME_RAD).floor() as i64;
        cell
    };
    let mut known: HashMap<i64, Vec<usize>> = HashMap::new();
    let mut firsts: Vec<(&[f64; 6], &Stand)> = Vec::new();
    let mut all = Vec::new();
    for (q, stand) in rows {
        let is_same = |number: usize| {
            let (first, at) = firsts[number];
            let mut angles = q.iter().zip(first);
            angles.all(|(a, b)| (a - b).abs() < SAME_RAD) && stand.bits() == at.bits()
        };
        let own = cell(q);
        let near = (own - 1..=own + 1)
            .filter_map(|cell| known.get(&cell))
            .flatten();
        let same = near.copied().filter(|number| is_same(*number)).min();
        all.push(same.unwrap_or_else(|| {
            known.entry(own).or_default().push(firsts.len());
            firsts.push((q, stand));
            firsts.len() - 1
        }));
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEADER: &str = "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg,";

    fn read(columns: &str, rows: &[&str]) -> Result<Measurements, MeasurementError> {
        let mut text = format!("# a comment\n{HEADER}{columns}\n");
        for row in rows {
            text += &format!("1,2,3,4,5,6,{row}\n");
        }
        Measurements::from_csv(text.as_bytes())
    }

    fn fault(columns: &str, rows: &[&str]) -> MeasurementError {
        read(columns, rows).expect_err("it should be refused")
    }

    #[test]
    fn an_arm_that_stands_still_has_not_moved_since() {
        let at = |q: f64| [q, 0.0, 0.0, 0.0, 0.0, 2.0 * q];
        let moves = last_moves(&[at(1.0), at(3.0), at(3.0), at(2.0)]);
        assert_eq!(moves, [at(0.0), at(2.0), at(2.0), at(-1.0)]);
        assert!(last_moves(&[]).is_empty());
    }

    #[test]
    fn positions_poses_and_distances_stand_in_one_file() {
        let columns = "x_mm,y_mm,z_mm,qw,qx,qy,qz,distance_mm,from_x_mm,from_y_mm,from_z_mm";
        let rows = ["1,2,3,,,,,,,,", "1,2,3,1,0,0,0,,,,", ",,,,,,,500,1,2,3"];
        let all = read(columns, &rows).expect("a mixed file");
        assert_eq!(
            all.rows
                .iter()
                .map(|r| r.observed.count())
                .collect::<Vec<_>>(),
            [3, 6, 1]
        );
        assert_eq!(all.rows[0].q[1], 2.0 * DEG);
        assert_eq!(all.rows[2].line, Line::from(5));
        let both = fault(columns, &["1,2,3,,,,,500,1,2,3"]);
        assert_eq!(both.fault, MeasurementFault::Kind { both: true });
        let neither = fault(columns, &[",,,,,,,,,,"]);
        assert_eq!(neither.fault, MeasurementFault::Kind { both: false });
    }

    #[test]
    fn a_bad_cell_is_named_with_its_line_and_column() {
        let error = fault("x_mm,y_mm,z_mm", &["1,2,3", "1,NaN,3"]);
        assert_eq!((error.line, error.column, error.length), (4, 15, 3));
        assert!(error.to_string().contains("y_mm"));
        for (columns, row) in [
            ("x_mm,y_mm,z_mm", "1,,3"),
            ("x_mm,y_mm,z_mm", "1,2"),
            ("x_mm,y_mm", "1,2"),
            ("x_mm,x_mm,y_mm,z_mm", "1,1,2,3"),
            ("x_mm,y_mm,z_mm,sigma_mm", "1,2,3,0"),
            ("x_mm,y_mm,z_mm,set", "1,2,3,other"),
            ("x_mm,y_mm,z_mm,point", "1,2,3,"),
            (
                "x_mm,y_mm,z_mm,dir1,dir2,dir3,dir4,dir5,dir6",
                "1,2,3,1,1,1,1,1,2",
            ),
            ("x_mm,y_mm,z_mm,qw,qx,qy,qz", "1,2,3,1,1,0,0"),
            ("distance_mm,from_x_mm,from_y_mm,from_z_mm", "-1,0,0,0"),
            ("sigma_mm", "1"),
        ] {
            assert!(read(columns, &[row]).is_err(), "{columns} {row}");
        }
        assert_eq!(fault("x_mm,y_mm,z_mm", &[]).fault, MeasurementFault::NoRows);
    }

    #[test]
    fn named_points_may_have_no_coordinates() {
        let all = read(
            "x_mm,y_mm,z_mm,point,px_mm,py_mm,pz_mm",
            &["1,2,3,a,,,", "1,2,3,b,4,5,6"],
        );
        let all = all.expect("a file of two points");
        assert_eq!(all.rows[0].point_in_tool_m, None);
        assert_eq!(all.rows[1].point_in_tool_m, Some([0.004, 0.005, 0.006]));
        assert_eq!(all.configurations(), [0, 0]);
    }

    #[test]
    fn a_pose_measured_again_later_is_the_same_configuration() {
        let mut text = format!("{HEADER}x_mm,y_mm,z_mm\n");
        // encoders read it a little otherwise, on either side of any rounding
        for (q2, q3) in [
            (20.0, 30.0),
            (20.5, 29.5),
            (20.004, 29.997),
            (20.5, 29.502),
            (20.0, 31.0),
        ] {
            text += &format!("10,{q2},{q3},0,0,0,1,2,3\n");
        }
        let all = Measurements::from_csv(text.as_bytes()).expect("five rows");
        assert_eq!(all.configurations(), [0, 1, 0, 1, 2]);
    }
}

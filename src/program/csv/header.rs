//! The columns of a table of poses or joints.

use super::records::{Cell, Records};
use crate::program::{Configuration, Layout, Shape, Source};

const POSE: [&[u8]; 7] = [b"x_mm", b"y_mm", b"z_mm", b"qw", b"qx", b"qy", b"qz"];
const JOINTS: [&[u8]; 6] = [
    b"q1_deg", b"q2_deg", b"q3_deg", b"q4_deg", b"q5_deg", b"q6_deg",
];
const NEAR: [&[u8]; 6] = [
    b"near1_deg",
    b"near2_deg",
    b"near3_deg",
    b"near4_deg",
    b"near5_deg",
    b"near6_deg",
];

/// Which column is what.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Header {
    pub shape: Shape,
    /// The columns of a target's numbers.
    pub numbers: Vec<usize>,
    pub near: Option<[usize; 6]>,
    pub branch: Option<usize>,
    pub tool: Option<usize>,
    pub frame: Option<usize>,
    pub id: Option<usize>,
    /// How many there are.
    pub count: usize,
}

/// Why a header is not one.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Wrong {
    /// It has neither all columns of poses nor all of joints.
    Missing,
    /// It has both.
    Both,
    /// A column stands twice, the one at this index the second time.
    Twice(usize),
    /// Only some of `near1_deg` to `near6_deg`.
    Near,
}

impl Header {
    /// The columns that names tell.
    pub(super) fn of(names: &[&[u8]]) -> Result<Self, Wrong> {
        let find = |name: &[u8]| names.iter().position(|found| *found == name);
        let pose: Option<Vec<usize>> = POSE.into_iter().map(find).collect();
        let joints: Option<Vec<usize>> = JOINTS.into_iter().map(find).collect();
        let (shape, numbers) = match (pose, joints) {
            (Some(pose), None) => (Shape::Pose, pose),
            // a position next to the joints makes measurements of them
            (None, Some(joints)) if find(POSE[0]).is_none() => (Shape::Joints, joints),
            (None, None) => return Err(Wrong::Missing),
            _ => return Err(Wrong::Both),
        };
        let near: Vec<usize> = NEAR.into_iter().filter_map(find).collect();
        let near = match near.len() {
            0 => None,
            _ => Some(near.try_into().map_err(|_| Wrong::Near)?),
        };
        let header = Self {
            shape,
            numbers,
            near,
            branch: find(b"branch"),
            tool: find(b"tool"),
            frame: find(b"frame"),
            id: find(b"id"),
            count: names.len(),
        };
        let singles = [header.branch, header.tool, header.frame, header.id];
        let used = header.numbers.iter().chain(header.near.iter().flatten());
        let used = used.copied().chain(singles.into_iter().flatten());
        for column in used {
            let again = names[column + 1..].iter().position(|n| *n == names[column]);
            if let Some(again) = again {
                return Err(Wrong::Twice(column + 1 + again));
            }
        }
        Ok(header)
    }

    /// The layout of a target on a branch, 0 to 7.
    pub(super) fn layout(&self, branch: Option<u8>) -> Layout {
        Layout {
            shape: self.shape,
            variant: branch.map_or(0, |branch| branch + 1),
        }
    }
}

/// Whether the first record names the columns of poses or of joints.
pub(super) fn recognises(source: &Source) -> bool {
    let mut cells = Vec::new();
    let is_text = memchr::memchr(0, &source.bytes).is_none();
    is_text
        && Records::of(&source.bytes).next(&mut cells) == Ok(true)
        && Header::of(&names(source, &cells)).is_ok()
}

/// The text of the cells.
pub(super) fn names<'a>(source: &'a Source, cells: &[Cell]) -> Vec<&'a [u8]> {
    cells
        .iter()
        .map(|cell| &source.bytes[cell.start..cell.end])
        .collect()
}

/// What the variant of a layout says: the branch, where the table has one.
pub(super) fn configuration(variant: u8) -> Configuration {
    let Some(branch) = variant.checked_sub(1) else {
        return Configuration::default();
    };
    Configuration {
        behind_axis_1: Some(branch & 4 != 0),
        behind_lower_arm: Some(branch & 2 != 0),
        joint_5_negative: Some(branch & 1 != 0),
        ..Configuration::default()
    }
}

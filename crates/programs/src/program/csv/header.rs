//! The columns of a table of poses or joints.

use super::records::{Cell, Records};
use crate::program::{Configuration, Layout, Shape, Source, number};

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
    pub external: Vec<Axis>,
    /// Columns that nothing is read from: those that may well matter, and others.
    pub unread: [Vec<usize>; 2],
    /// How many there are.
    pub count: usize,
}

/// What columns are called that are none of the format, in letters alone; whether they have numbers;
/// what is meant.
const MEANT: [(&str, bool, &str); 4] = [
    (
        "frame framename workobject wobj workframe userframe uframe base",
        false,
        "the column `frame`",
    ),
    (
        "tool toolname tooldata toolframe utool tcp",
        false,
        "the column `tool`",
    ),
    (
        "near neardeg nearrad",
        true,
        "one of the columns `near1_deg` … `near6_deg`",
    ),
    (
        "e emm em edeg erad ext extax eax",
        true,
        "a column `e1_mm` or `e1_deg`",
    ),
];
/// What columns of measurements are called, and others that say how the arm stands at a row, likewise
/// in letters alone.
const MAY_MATTER: &str = "dir dire move movedeg fx fy fz fxn fyn fzn temperature temperaturec times \
    on point px py pz pxmm pymm pzmm config configuration";

/// Whether the letters of a name, in lower case, are one of these words.
fn is_one_of(name: &[u8], words: &str) -> bool {
    let letters = name.iter().filter(|b| b.is_ascii_alphabetic());
    let letters: Vec<u8> = letters.map(u8::to_ascii_lowercase).collect();
    let mut words = words.split_ascii_whitespace();
    words.any(|word| word.as_bytes() == letters)
}

/// What a column that is none of the format is meant as.
fn meant(name: &[u8]) -> Option<&'static str> {
    let has_number = name.iter().any(u8::is_ascii_digit);
    let is_it = |(words, numbered, _): &&(&str, bool, &str)| {
        (has_number || !numbered) && is_one_of(name, words)
    };
    MEANT.iter().find(is_it).map(|(.., what)| *what)
}

/// The column of an external axis: `e1_mm`, `e2_deg`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Axis {
    pub column: usize,
    /// Its number among those of the profile, from 0.
    pub number: u8,
    pub is_linear: bool,
}

impl Axis {
    fn of((column, name): (usize, &&[u8])) -> Option<Self> {
        let name = name.to_ascii_lowercase();
        let name = name.strip_prefix(b"e")?;
        let (digits, is_linear) = match name.strip_suffix(b"_mm") {
            Some(digits) => (digits, true),
            None => (name.strip_suffix(b"_deg")?, false),
        };
        let number = number::whole(digits)?.checked_sub(1)?;
        Some(Self {
            column,
            number: u8::try_from(number).ok()?,
            is_linear,
        })
    }
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
    /// `branch` next to these.
    Branch(usize),
    /// The column of this index is one of the format under another name.
    Meant(usize, &'static str),
    /// Cells are separated by something else.
    Separator,
    /// This column alone, or with others, is missing.
    Without(&'static str),
}

impl Header {
    /// The columns that names tell, in small letters or capitals.
    pub(super) fn of(names: &[&[u8]]) -> Result<Self, Wrong> {
        let find = |name: &[u8]| {
            names
                .iter()
                .position(|found| found.eq_ignore_ascii_case(name))
        };
        let pose: Option<Vec<usize>> = POSE.into_iter().map(find).collect();
        let joints: Option<Vec<usize>> = JOINTS.into_iter().map(find).collect();
        let (shape, numbers) = match (pose, joints) {
            (Some(pose), None) => (Shape::Pose, pose),
            // a position next to the joints makes measurements of them
            (None, Some(joints)) if find(POSE[0]).is_none() => (Shape::Joints, joints),
            (None, None) => return Err(missing(names)),
            _ => return Err(Wrong::Both),
        };
        let near: Vec<usize> = NEAR.into_iter().filter_map(find).collect();
        let near = match near.len() {
            0 => None,
            _ => Some(near.try_into().map_err(|_| Wrong::Near)?),
        };
        let mut header = Self {
            shape,
            numbers,
            near,
            branch: find(b"branch"),
            tool: find(b"tool"),
            frame: find(b"frame"),
            id: find(b"id"),
            external: names.iter().enumerate().filter_map(Axis::of).collect(),
            unread: [Vec::new(), Vec::new()],
            count: names.len(),
        };
        let singles = [header.branch, header.tool, header.frame, header.id];
        let used = header.numbers.iter().chain(header.near.iter().flatten());
        let axes = header.external.iter();
        for (at, axis) in axes.clone().enumerate() {
            let is_same = |other: &&Axis| other.number == axis.number;
            if let Some(again) = axes.clone().skip(at + 1).find(is_same) {
                return Err(Wrong::Twice(again.column));
            }
        }
        let used: Vec<usize> = used.copied().chain(singles.into_iter().flatten()).collect();
        for &column in &used {
            let is_same = |name: &&[u8]| name.eq_ignore_ascii_case(names[column]);
            if let Some(again) = names[column + 1..].iter().position(is_same) {
                return Err(Wrong::Twice(column + 1 + again));
            }
        }
        let is_axis = |column: usize| axes.clone().any(|axis| axis.column == column);
        let is_unread = |at: &usize| !used.contains(at) && !is_axis(*at);
        // lines may end with a comma
        let unread = (0..names.len()).filter(|at| is_unread(at) && !names[*at].is_empty());
        let (may_matter, others) = unread.partition(|at| is_one_of(names[*at], MAY_MATTER));
        header.unread = [may_matter, others];
        for &at in header.unread.iter().flatten() {
            if let Some(what) = meant(names[at]) {
                return Err(Wrong::Meant(at, what));
            }
        }
        match header.branch.filter(|_| header.near.is_some()) {
            Some(branch) => Err(Wrong::Branch(branch)),
            None => Ok(header),
        }
    }

    /// The layout of a target on a branch, 0 to 7.
    pub(super) fn layout(&self, branch: Option<u8>) -> Layout {
        Layout {
            shape: self.shape,
            variant: branch.map_or(0, |branch| branch + 1),
        }
    }
}

/// What is nearly right where neither all columns of poses nor all of joints are there.
fn missing(names: &[&[u8]]) -> Wrong {
    let is_known = |name: &&[u8]| {
        let mut of_tables = POSE.iter().chain(&JOINTS);
        of_tables.any(|known| known.eq_ignore_ascii_case(name))
    };
    let parts = names
        .iter()
        .flat_map(|name| name.split(|b| matches!(b, b';' | b'\t')));
    if parts.filter(|name| is_known(&name.trim_ascii())).count() > names.len() {
        return Wrong::Separator;
    }
    let has = |column: &&[u8]| names.iter().any(|name| name.eq_ignore_ascii_case(column));
    let is_pose = POSE[3..].iter().any(&has) || POSE[..3].iter().all(&has);
    let found: &[&'static [u8]] = if is_pose {
        &POSE
    } else if JOINTS.iter().any(&has) {
        &JOINTS
    } else {
        return Wrong::Missing;
    };
    let without = found.iter().find(|column| !has(column));
    let without = without.and_then(|column| std::str::from_utf8(column).ok());
    without.map_or(Wrong::Missing, Wrong::Without)
}

/// Whether the first record names the columns of poses or of joints.
pub(super) fn recognises(source: &Source) -> bool {
    let mut cells = Vec::new();
    let is_text = memchr::memchr(0, &source.bytes).is_none();
    is_text
        && Records::of(&source.bytes).next(&mut cells) == Ok(true)
        && matches!(
            Header::of(&names(source, &cells)),
            Ok(_) | Err(Wrong::Branch(_) | Wrong::Meant(..))
        )
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

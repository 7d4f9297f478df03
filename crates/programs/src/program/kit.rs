//! What readers of all languages share.

use super::script::{Place, Remark, Script, short};
use super::{About, MOST_ANGLE_DEG, Marker, ReadError, Settings, Source};
use crate::geometry::Pose;
use crate::geometry::units::{DEG, MM, mm_from_m};
use foldhash::{HashMap, HashSet};
use std::hash::Hash;
use std::ops::Range;
use std::path::Path;

/// No text has a zero byte, and places are kept in 32 bits.
///
/// # Errors
/// Where the file is none that a program can be in.
pub(crate) fn check_bytes(source: &Source) -> Result<(), ReadError> {
    let limit = u32::MAX as usize;
    let (file, size) = (source.name.clone(), source.bytes.len());
    if size >= limit {
        return Err(ReadError::TooLarge { file, size, limit });
    }
    match memchr::memchr(0, &source.bytes) {
        Some(offset) => Err(ReadError::Binary {
            file,
            byte: 0,
            offset,
        }),
        None => Ok(()),
    }
}

/// Why a text cannot be read, by offsets; becomes a [`ReadError`] with the source.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Fault {
    /// What opens here is not closed.
    Unclosed { at: u32, what: &'static str },
    /// Something else stands where one thing belongs.
    Unexpected {
        start: u32,
        end: u32,
        expected: &'static str,
    },
    /// A number no robot can use.
    BadValue {
        start: u32,
        end: u32,
        meaning: &'static str,
        limit: &'static str,
    },
    /// A byte that no text has.
    Binary { at: u32 },
}

/// Bytes of a wrong part that an error message repeats at most.
const SHOWN: usize = 40;

impl Fault {
    /// The thing that opens at a byte is not closed.
    pub(super) fn unclosed(at: usize, what: &'static str) -> Self {
        Self::Unclosed {
            at: short(at),
            what,
        }
    }

    /// Something else stands at these bytes.
    pub(super) fn unexpected(at: Range<usize>, expected: &'static str) -> Self {
        Self::Unexpected {
            start: short(at.start),
            end: short(at.end),
            expected,
        }
    }

    /// The number at these bytes is none that a robot can use.
    pub(super) fn bad_value(at: Range<usize>, meaning: &'static str, limit: &'static str) -> Self {
        Self::BadValue {
            start: short(at.start),
            end: short(at.end),
            meaning,
            limit,
        }
    }

    /// The error with file, line and column.
    pub(super) fn in_source(self, source: &Source) -> ReadError {
        let file = source.name.clone();
        let at = match self {
            Self::Unclosed { at, .. } | Self::Binary { at } => at,
            Self::Unexpected { start, .. } | Self::BadValue { start, .. } => start,
        };
        let (line, column) = source.line_column(at as usize);
        match self {
            Self::Unclosed { what, .. } => ReadError::Unclosed {
                file,
                line,
                column,
                what,
            },
            Self::Unexpected {
                start,
                end,
                expected,
            } => ReadError::Unexpected {
                file,
                line,
                column,
                found: shown(&source.bytes, start as usize, end as usize),
                expected,
            },
            Self::BadValue {
                start,
                end,
                meaning,
                limit,
            } => ReadError::BadValue {
                file,
                line,
                column,
                value: shown(&source.bytes, start as usize, end as usize),
                meaning,
                limit,
            },
            Self::Binary { at } => ReadError::Binary {
                file,
                byte: source.bytes[at as usize],
                offset: at as usize,
            },
        }
    }
}

/// What stands at these bytes, for messages.
fn shown(bytes: &[u8], start: usize, end: usize) -> String {
    let text = bytes.get(start..end.min(start + SHOWN)).unwrap_or_default();
    match (text.trim_ascii(), bytes.get(start)) {
        ([], None) => "the end of the file".into(),
        ([], Some(b'\n' | b'\r')) => "the end of the line".into(),
        ([], Some(_)) => "nothing".into(),
        (text, _) => format!("`{}`", Source::text(text)),
    }
}

/// Whether a file's name has this ending, in letters of any case.
pub(super) fn has_ending(name: &str, ending: &str) -> bool {
    let own = Path::new(name).extension();
    own.is_some_and(|own| own.eq_ignore_ascii_case(ending))
}

/// A file that has nothing of the language that it is read as.
pub(super) fn not_this_language(about: &'static About, source: &Source) -> ReadError {
    ReadError::NotThisLanguage {
        file: source.name.clone(),
        language: about.name,
        missing: about.has,
    }
}

/// The first byte of a text behind a byte order mark.
pub(super) fn content_start(bytes: &[u8]) -> usize {
    let mark = b"\xef\xbb\xbf";
    if bytes.starts_with(mark) {
        mark.len()
    } else {
        0
    }
}

/// The first byte of the line behind the one of `at`; `None` where that is the last and has no end.
/// Lines end with LF, CR LF or CR.
pub(super) fn line_behind(bytes: &[u8], at: usize) -> Option<usize> {
    let end = at + memchr::memchr2(b'\n', b'\r', &bytes[at..])?;
    let is_pair = bytes[end] == b'\r' && bytes.get(end + 1) == Some(&b'\n');
    Some(end + 1 + usize::from(is_pair))
}

/// The lines of a marker as comments, each behind this sign.
pub(super) fn comments(source: &Source, marker: &Marker, sign: &str) -> Vec<u8> {
    let end = source.line_end();
    let lines = marker.lines();
    let line = |line: &String| [sign.as_bytes(), line.as_bytes(), end].concat();
    lines.iter().flat_map(line).collect()
}

/// A position that only the running program knows.
pub(super) const fn computed(id: &'static str, hint: &'static str) -> Remark {
    Remark::warning(
        id,
        "the position that this move goes to is known at run time only; the move stays as it is",
        hint,
    )
}

/// A target that the files do not have.
pub(super) fn not_in_files(id: &'static str, name: &str, hint: &'static str) -> Remark {
    Remark::error_about(
        id,
        format!("{name} is not declared in the files; this move is not compensated"),
        hint,
    )
}

/// Joints that the files do not have: a move to them needs no correction.
pub(super) fn joints_not_in_files(id: &'static str, name: &str, hint: &'static str) -> Remark {
    Remark::note_about(
        id,
        format!("{name} has no value in the files; as a joint target it stays"),
        hint,
    )
}

/// A tool or work frame with an angle that none has.
pub(super) fn angle_too_large(name: &str, angle: f64, hint: &'static str) -> Remark {
    let text = format!("`{name}` has an angle of {angle} deg; the limit is {MOST_ANGLE_DEG} deg");
    Remark::error_about("angle-too-large", text, hint)
}

/// A load that the text does not say.
pub(super) const fn load_chosen(id: &'static str, hint: &'static str) -> Remark {
    Remark::warning(
        id,
        "only the running program knows the load that is set here; moves are taken with that of \
         the tool",
        hint,
    )
}

/// Where a profile may have the base of an arm whose controller counts positions from there.
pub(super) const MOST_BASE_GAP_M: f64 = 0.1 * MM;
const MOST_BASE_TURN_RAD: f64 = 0.01 * DEG;

/// Refuses a profile that has the base elsewhere than at the origin, where the controller counts
/// positions from the robot's own base, with this finding. `at_any_height`: not from its foot.
pub(super) fn judge_base(
    script: &mut Script,
    sources: &[Source],
    settings: &Settings,
    (id, at_any_height): (&'static str, bool),
) {
    let Some(mut base) = settings.world_from_base.filter(|_| !sources.is_empty()) else {
        return;
    };
    if at_any_height {
        base.translation[2] = 0.0;
    }
    let gap = Pose::identity().separation(&base);
    if gap.distance_m <= MOST_BASE_GAP_M && gap.angle_rad <= MOST_BASE_TURN_RAD {
        return;
    }
    let message = format!(
        "the controller counts positions from the robot's own base, and `kinematics.base` of the \
         profile is {:.1} mm and {:.2} deg from it",
        mm_from_m(gap.distance_m),
        gap.angle_rad / DEG
    );
    let hint = "make `kinematics.base` zero, and add its `rz_deg` to `theta_deg` of joint 1 where the \
        pendant shows the poses that `poseshift fk` has with it; how the robot is mounted \
        `gravity_m_s2` says, along the axes of its base";
    let remark = Remark::error_about(id, message, hint);
    script.say(sources, Place::new(0, 0), remark);
}

/// The name of a label as a number: FNV-1a. Two names of one routine with the same would be one
/// label; at 64 bits there are none.
pub(super) fn label_key(name: &[u8]) -> u64 {
    name.iter().fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3)
    })
}

/// Adds to a set all that it leads to: of each pair the second, where the first is in it.
pub(super) fn spread<T: Copy + Eq + Hash>(
    set: &mut HashSet<T>,
    pairs: impl IntoIterator<Item = (T, T)>,
) {
    if set.is_empty() {
        return;
    }
    let mut behind: HashMap<T, Vec<T>> = HashMap::default();
    for (from, to) in pairs {
        behind.entry(from).or_default().push(to);
    }
    let mut open: Vec<T> = set.iter().copied().collect();
    while let Some(from) = open.pop() {
        for &to in behind.get(&from).into_iter().flatten() {
            if set.insert(to) {
                open.push(to);
            }
        }
    }
}

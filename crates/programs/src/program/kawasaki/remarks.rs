//! What is wrong with targets, tools and moves, in words.

use crate::finding::Severity;
use crate::program::script::Remark;

/// Against an array that a program is handed.
pub(super) fn unfollowed() -> Remark {
    Remark::error(
        "target-passed-to-routine",
        "a program is handed this array, and which of its elements it goes to or writes is not \
         followed",
        "hand one element over, or an array that has at most 32",
    )
}

/// Why a position has to stay, or a move runs without correction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Cause {
    Computed,
    Partial,
    Axes,
    Assigned,
    Relative,
    Search,
    ArcChain,
    Switched,
    Saved,
}

impl Cause {
    pub(super) fn remark(self) -> Remark {
        let (id, severity, text, hint) = match self {
            Self::Computed => (
                "computed-target",
                Severity::Warning,
                "the position that this move goes to is known at run time only; the move stays as \
                 it is",
                "move to a name of .TRANS or .JOINTS where it must be exact",
            ),
            Self::Partial => (
                "partial-target",
                Severity::Error,
                "the target does not have all six numbers",
                "write all six numbers of TRANS",
            ),
            Self::Axes => (
                "target-not-six-axes",
                Severity::Error,
                "the target does not have six numbers: it has another axis (JT7), or is one of \
                 another arm",
                "only robots with six joints and without other axes are compensated",
            ),
            Self::Assigned => (
                "frame-assigned-at-run-time",
                Severity::Error,
                "the running program computes the tool or base",
                "set it with numbers, or with a name of .TRANS",
            ),
            Self::Relative => (
                "relative-move",
                Severity::Warning,
                "the move starts where the robot stands, and the text does not tell where: it \
                 stays as it is",
                "move to a name of .TRANS or .JOINTS where it must be exact",
            ),
            Self::Search => (
                "search-move",
                Severity::Error,
                "a signal decides where the move (XMOVE) ends",
                "searches are not compensated",
            ),
            Self::ArcChain => (
                "arc-chain",
                Severity::Error,
                "C1MOVE follows C1MOVE: each part of the path lies on the circle through its two \
                 ends and the next point, and is not followed",
                "end each arc with C2MOVE",
            ),
            Self::Switched => (
                "configuration-not-understood",
                Severity::Error,
                "the program switches the arm's configuration (LEFTY, RIGHTY, ABOVE, BELOW, \
                 UWRIST, DWRIST) before this move",
                "go to joints (#name) with the configuration that is wanted instead",
            ),
            Self::Saved => (
                "frame-as-saved",
                Severity::Warning,
                "the program does not set the tool or base before this move: it is taken as it was \
                 when the controller was saved (.SYSDATA)",
                "set TOOL and BASE in the program, or compare them with the pendant",
            ),
        };
        Remark {
            id,
            severity,
            text: text.into(),
            hint,
        }
    }
}

/// A target that the files do not have.
pub(super) fn not_in_files(name: &str) -> Remark {
    Remark::error(
        "target-not-in-files",
        format!("{name} is not declared in the files; this move is not compensated"),
        "give the file with its .TRANS or .JOINTS too",
    )
}

/// A target whose numbers a statement adds to those of others.
pub(super) fn added_up(file: &str, line: usize) -> Remark {
    Remark::error(
        "target-used-as-frame",
        format!(
            "this target is part of a tool, base or displacement, too (see {file} line {line})"
        ),
        "give what is added a name of its own in .TRANS",
    )
}

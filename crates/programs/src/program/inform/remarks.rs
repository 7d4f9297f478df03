//! What is wrong with positions and moves, in words.

use crate::finding::Severity;
use crate::program::script::Remark;

/// Why a position has to stay, or a move runs without correction.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Cause {
    Ambiguous,
    FrameAmbiguous,
    FrameAssigned,
    FrameCopied,
    Shifted,
    SeamTracked,
    Coordinated,
    Conveyor,
    Relative,
    Incremental,
    Search,
    SecondRobot,
    SeveralRobots,
    OtherMove,
    ToolCoordinates,
    FrameNotNamed,
    AxisCount,
    NotInFiles,
    Computed,
    Pulses,
}

impl Cause {
    /// Identifier, what is wrong, and the way out.
    pub(super) fn words(self) -> (&'static str, &'static str, &'static str) {
        match self {
            Self::Ambiguous => (
                "target-name-ambiguous",
                "this name stands for different positions",
                "pass only the jobs that run together, with one value for each P variable",
            ),
            Self::FrameAmbiguous => (
                "frame-name-ambiguous",
                "condition files (TOOL.CND, UFRAME.CND) have different values for its tool or user \
                 frame",
                "pass the condition files of one controller only",
            ),
            Self::FrameAssigned => (
                "frame-assigned-at-run-time",
                "the running program changes the tool or user frame",
                "set it once, outside these jobs, and give its value with --tool or --frame",
            ),
            Self::FrameCopied => (
                "frame-chosen-at-run-time",
                "positions with other tools or frames are copied into the variable that the move \
                 goes to",
                "move to each of the positions by its own name",
            ),
            Self::Shifted => (
                "displacement-active",
                "a shift (SFTON) may be on",
                "switch it off with SFTOF before the move, or write the shifted positions",
            ),
            Self::SeamTracked => (
                "corrected-by-sensor",
                "from here on the arc (COMARCON) corrects moves: each goes to its position, \
                 compensated, and what the sensor adds",
                "look at the first part: what the correction of the seam still has to do is less",
            ),
            Self::Coordinated => (
                "moving-frame",
                "the path is relative to a station or another robot (SMOV)",
                "describe the station under `external_axes` of the profile, with `follows: \
                 always`; moves relative to another robot are not compensated",
            ),
            Self::Conveyor => (
                "moving-frame",
                "the path is relative to a conveyor (SYMOV)",
                "moves on a conveyor are not compensated",
            ),
            Self::Relative => (
                "moving-frame",
                "the job is relative (RJ) to a station: its user frame rotates with the station",
                "relative jobs of stations are not compensated: write the positions in a fixed \
                 frame, and the station under `external_axes` with `follows: always`",
            ),
            Self::Incremental => (
                "relative-move",
                "where the move (IMOV) starts only the running program knows",
                "write the position that it leads to",
            ),
            Self::Search => (
                "search-move",
                "where the move (SRCH) ends only the sensor knows",
                "searches are not compensated",
            ),
            Self::SecondRobot => (
                "second-robot",
                "the position is one of a second robot",
                "compensate the jobs of each robot on their own",
            ),
            Self::SeveralRobots => (
                "second-robot",
                "the jobs are of several robots (///GROUP1), and the profile is of one",
                "compensate the jobs of each robot on their own",
            ),
            Self::OtherMove => (
                "move-not-supported",
                "moves of this kind are not known",
                "use MOVJ, MOVL, MOVC or MOVS",
            ),
            Self::ToolCoordinates => (
                "tool-coordinates",
                "the position is relative to a tool",
                "write the position in base, robot or user coordinates",
            ),
            Self::FrameNotNamed => (
                "frame-not-named",
                "the header does not tell the frame (POSTYPE, USER) of this position",
                "add ///POSTYPE, and ///USER with the frame's number, above it",
            ),
            Self::AxisCount => (
                "target-not-six-axes",
                "the position does not have six numbers",
                "only robots with six joints are compensated; decimals are behind a point, not a comma",
            ),
            Self::NotInFiles => (
                "target-not-in-files",
                "the files do not have the position that this move goes to",
                "give the job that holds the position too",
            ),
            Self::Computed => (
                "computed-target",
                "the position that this move goes to is known at run time only; the move stays as \
                 it is",
                "move to a C position or a P variable by its number where it must be exact",
            ),
            Self::Pulses => (
                "pulses-per-degree-unknown",
                "positions of this job are in pulses, and the profile does not say how many make a \
                 degree: they stay as they are, and \
                 where the robot is there is not known",
                "add `pulses_per_deg: [S, L, U, R, B, T]` to the profile (ALL.PRM, or pulses and \
                 angles on the pendant)",
            ),
        }
    }

    /// An error, but for what the running program computes: that the move stays is right or not,
    /// and said.
    pub(super) fn remark(self) -> Remark {
        let (id, text, hint) = self.words();
        Remark {
            id,
            severity: match self {
                Self::Computed | Self::SeamTracked => Severity::Warning,
                _ => Severity::Error,
            },
            text: text.into(),
            hint,
        }
    }
}

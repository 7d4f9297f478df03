//! What is wrong with targets, tools and moves, in words.

use crate::program::kit;
use crate::program::script::Remark;

/// Against an array that a program is handed.
pub(super) const UNFOLLOWED: Remark = Remark::error(
    "target-passed-to-routine",
    "a program is handed this array, and which of its elements it goes to or writes is not \
         followed",
    "hand one element over, or an array that has at most 32",
);

/// A position that only the running program knows.
pub(super) const COMPUTED: Remark = kit::computed(
    "computed-target",
    "move to a name of .TRANS or .JOINTS where it must be exact",
);

/// A target without all numbers.
pub(super) const PARTIAL: Remark = Remark::error(
    "partial-target",
    "a number of the target is left out between others, or of joints",
    "write all six numbers",
);

/// `TRANS(1e999,…)`
pub(super) const TOO_LARGE: Remark = Remark::error(
    "partial-target",
    "a number of the target is larger than any that is meant",
    "write it in mm, or degrees",
);

/// A target of an arm that has not six axes.
pub(super) const AXES: Remark = Remark::error(
    "target-not-six-axes",
    "the target does not have six numbers: it has another axis (JT7), or is one of \
                 another arm",
    "only robots with six joints and without other axes are compensated",
);

/// A tool or base that only the running program knows.
pub(super) const ASSIGNED: Remark = Remark::error(
    "frame-assigned-at-run-time",
    "the running program computes the tool or base",
    "set it with numbers, or with a name of .TRANS",
);

/// A move from a place that the text does not tell.
pub(super) const RELATIVE: Remark = Remark::warning(
    "relative-move",
    "the move starts where the robot stands, and the text does not tell where: it \
                 stays as it is",
    "move to a name of .TRANS or .JOINTS where it must be exact",
);

/// A joint that turns from where it is.
pub(super) const TURNED: Remark = Remark::note(
    "relative-joint-move",
    "this move turns a joint from where the robot is; it is left as it is",
    "",
);

/// A move that a signal ends.
pub(super) const SEARCH: Remark = Remark::error(
    "search-move",
    "a signal decides where the move (XMOVE) ends",
    "searches are not compensated",
);

/// A move of a kind that is not read.
pub(super) const OTHER_MOVE: Remark = Remark::error(
    "move-not-supported",
    "this kind of move is not read: where it goes, and where the robot stands then, is not \
                 known",
    "JMOVE, LMOVE, C1MOVE, C2MOVE, HMOVE, XMOVE and what departs and approaches are read",
);

/// An arc on an arc.
pub(super) const ARC_CHAIN: Remark = Remark::error(
    "arc-chain",
    "C1MOVE follows C1MOVE: each part of the path lies on the circle through its two \
                 ends and the next point, and is not followed",
    "end each arc with C2MOVE",
);

/// A load that the text does not say.
pub(super) const LOAD: Remark = kit::load_chosen(
    "load-chosen-at-run-time",
    "write mass and centre of gravity with numbers: WEIGHT 6,0,0,100",
);

/// A configuration that is switched.
pub(super) const SWITCHED: Remark = Remark::error(
    "configuration-not-understood",
    "the program switches the arm's configuration (LEFTY, RIGHTY, ABOVE, BELOW, \
                 UWRIST, DWRIST) before this move",
    "go to joints (#name) with the configuration that is wanted instead",
);

/// A tool or base as it was saved.
pub(super) const SAVED: Remark = Remark::warning(
    "frame-as-saved",
    "the program does not set the tool or base before this move: it is taken as it was \
                 when the controller was saved (.SYSDATA)",
    "set TOOL and BASE in the program, or compare them with the pendant",
);

/// A program of a name that another has.
pub(super) fn declared_again(name: &str) -> Remark {
    Remark::warning_about(
        "target-name-ambiguous",
        format!("another program is called {name}, too: either may be the one that runs"),
        "pass only the one that was loaded last",
    )
}

/// A target that the files do not have.
pub(super) fn not_in_files(name: &str) -> Remark {
    let hint = "give the file with its .TRANS or .JOINTS too";
    if name.contains('#') {
        kit::joints_not_in_files("joint-target-not-in-files", name, hint)
    } else {
        kit::not_in_files("target-not-in-files", name, hint)
    }
}

/// A target whose numbers a statement adds to those of others.
pub(super) fn added_up(file: &str, line: usize) -> Remark {
    Remark::error_about(
        "target-used-as-frame",
        format!(
            "this target is part of a tool, base or displacement, too (see {file} line {line})"
        ),
        "give what is added a name of its own in .TRANS",
    )
}

/// A target whose numbers a program reads: they would be those that are written here.
pub(super) fn taken_apart(file: &str, line: usize) -> Remark {
    Remark::error_about(
        "target-used-as-frame",
        format!(
            "FRAME, DECOMPOSE or DX, DY, DZ read the numbers of this target (see {file} line {line}), and \
             what the program makes of corrected ones is not followed"
        ),
        "give what is read a name of its own in .TRANS",
    )
}

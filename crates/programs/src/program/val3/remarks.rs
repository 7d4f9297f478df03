//! What is wrong with targets, frames and moves, in words.

use crate::program::kit;
use crate::program::script::Remark;

/// A target that the files do not have.
pub(super) fn not_in_files(name: &str) -> Remark {
    kit::not_in_files(
        "target-not-in-files",
        name,
        "give the whole project with its .dtx, and the libraries that it loads",
    )
}

/// A target that only the running program knows.
pub(super) const COMPUTED: Remark = kit::computed(
    "computed-target",
    "move to a point of the .dtx where it must be exact",
);

/// Against an array that a program is given.
pub(super) const UNFOLLOWED: Remark = Remark::error(
    "target-passed-to-routine",
    "a program is given this array, and which of its elements it goes to or writes is not \
         followed",
    "give it the name alone of an array that has at most 32 elements, or one element as a \
         parameter that is none",
);

/// Against an array whose elements are moved about.
pub(super) const REORDERED: Remark = Remark::error(
    "target-assigned-at-run-time",
    "the running program inserts, deletes or resizes (insert, delete, resize): which point an \
         element of this array is then is not followed",
    "keep the points of moves in an array that stays as it is",
);

/// A declared point without numbers, and whether the program writes into it.
pub(super) fn not_taught(name: &str, is_written: bool) -> Remark {
    let (why, hint) = if is_written {
        (
            "what the program writes into parts of it (p.trsf=…) is not followed",
            "assign a point as a whole (p=q, p=appro(q,…)), or go to a point of the .dtx",
        )
    } else {
        (
            "it was never taught",
            "teach the point, or leave the move out",
        )
    };
    let text = format!("{name} has no numbers in the .dtx: {why}");
    Remark::error_about("target-uninitialised", text, hint)
}

/// Likewise one of an array that programs fill.
pub(super) fn filled(name: &str) -> Remark {
    Remark::warning_about(
        "target-uninitialised",
        format!(
            "{name} has no numbers in the .dtx, and only the running program knows whether it has \
             filled it before (p[n]=…): the move is taken to go to what the program writes there"
        ),
        "see that the program fills the element before the move, or teach the point",
    )
}

/// Declared joints without numbers.
pub(super) fn joints_not_taught(name: &str) -> Remark {
    kit::joints_not_in_files(
        "joint-target-not-in-files",
        name,
        "teach the joints, to see the move checked",
    )
}

/// Points without numbers among others that only the running program chooses from.
pub(super) fn some_not_taught(name: &str, untaught: &str) -> Remark {
    Remark::warning_about(
        "target-uninitialised",
        format!(
            "only the running program knows to which {name} a move goes, and {untaught} was never \
             taught: it is taken to go to the others"
        ),
        "teach the point, or see that no move goes to it",
    )
}

/// A name that files of one project declare more than once.
pub(super) fn declared_again(name: &str) -> Remark {
    Remark::error_about(
        "target-name-ambiguous",
        format!("the files of this project declare {name} more than once"),
        "name in the .pjx only the files that the robot loads, with each name once",
    )
}

/// A file that the project file of its folder does not name.
pub(super) fn not_in_project(project: &str) -> Remark {
    Remark::note_about(
        "file-not-in-project",
        format!("{project} does not name this file: it is left out"),
        "name the file in the .pjx if the robot loads it",
    )
}

/// A file that a project file names and that is not given, while others of its kind are there.
pub(super) fn file_missing(file: &str) -> Remark {
    Remark::error_about(
        "target-not-in-files",
        format!("the .pjx names {file}, which is not among the files: another is not taken for it"),
        "give the file that the robot loads, or name in the .pjx the one that is there",
    )
}

/// A point of an arm with other axes.
pub(super) fn other_arm(name: &str) -> Remark {
    Remark::error_about(
        "target-not-six-axes",
        format!("{name} is a point or joints of an arm that does not have six axes"),
        "only robots with six joints are compensated",
    )
}

/// A tool or frame whose fathers lead back to it, or that has more than are followed.
pub(super) fn endless_fathers(name: &str) -> Remark {
    Remark::error_about(
        "frame-unknown",
        format!("the fathers of {name} in the .dtx lead back to it, or there are too many of them"),
        "give one of them a father that hangs on world, a tool one that hangs on flange",
    )
}

/// A tool or frame that the running program changes, and in which file and line where the move does
/// not say it.
pub(super) fn frame_assigned(name: &str, place: Option<(&str, usize)>) -> Remark {
    let at = place.map_or(String::new(), |(file, line)| {
        format!(" ({file} line {line})")
    });
    Remark::error_about(
        "frame-assigned-at-run-time",
        format!("the running program changes the tool or frame {name}{at}"),
        "set it in the .dtx, or keep the moves with it out of the compensation",
    )
}

/// A target that `setFrame` reads.
pub(super) fn frame_of_points(file: &str, line: usize) -> Remark {
    Remark::error_about(
        "target-used-as-frame",
        format!(
            "setFrame makes a frame of this target (see {file} line {line}): of a corrected one it \
             would be another frame"
        ),
        "teach a point of its own for the frame",
    )
}

/// Likewise where nothing uses the frame.
pub(super) const FRAME_OF_POINTS_UNUSED: Remark = Remark::note(
    "target-used-as-frame",
    "setFrame makes a frame of points that a move may go to: of corrected ones it is another frame, \
     which nothing in the files uses",
    "teach points of their own for the frame where another program uses it",
);

/// A tool or frame that only the running program knows.
pub(super) const FRAME_CHOSEN: Remark = Remark::error(
    "frame-chosen-at-run-time",
    "only the running program knows which tool the move has: it is chosen by a variable",
    "name the tool in the move",
);

/// A path that the running program alters.
pub(super) const ALTERED: Remark = Remark::warning(
    "corrected-by-sensor",
    "the running program alters this path (alter)",
    "the correction of the target goes with it: look at the first part",
);

/// Another kind of move.
pub(super) fn move_not_known(name: &str) -> Remark {
    Remark::error_about(
        "move-not-supported",
        format!("{name} is not understood: its target is not compensated"),
        "use movej, movel or movec with a target, a tool and a mdesc",
    )
}

/// A library that is loaded while the program runs.
pub(super) fn library(name: &str) -> Remark {
    Remark::warning_about(
        "library-at-run-time",
        format!(
            "{name} is loaded while the program runs: its data are taken to be those of the \
             files"
        ),
        "give the project that is loaded too, or keep its points out of the path",
    )
}

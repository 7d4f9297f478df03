//! What speaks against targets and moves, as sentences.

use crate::program::kit;
use crate::program::script::Remark;

/// Why a target has to stay: a sentence without its subject.
pub(super) const PARTIAL: Remark = Remark::error(
    "partial-target",
    "components are missing, which keep the value of the position before",
    "write X, Y, Z, A, B and C",
);

pub(super) const EXPRESSIONS: Remark = Remark::error(
    "target-has-expressions",
    "parts of this target are expressions, not numbers",
    "write the target with numbers in the offline system",
);

pub(super) const ASSIGNED: Remark = Remark::error(
    "target-assigned-at-run-time",
    "the running program changes elements of this array, and which only it knows",
    "correct the value where the program computes it, or keep the target out of the path",
);

pub(super) const PASSED: Remark = Remark::error(
    "target-passed-to-routine",
    "elements of this array are given to a routine that is not in the files, which may use \
         them with any tool and base",
    "give the file with the routine too, or move to the target where its tool and base are set",
);

/// Against an array that a routine of the files is given.
pub(super) const UNFOLLOWED: Remark = Remark::error(
    "target-passed-to-routine",
    "a routine is given this array, and which of its elements it goes to or writes is not \
         followed",
    "give it one element of an array that has at most 32, or move to the elements where the \
         array is declared",
);

pub(super) const AMBIGUOUS: Remark = Remark::error(
    "target-name-ambiguous",
    "this name is declared more than once, and a use does not tell which one is meant",
    "pass only the programs of one robot",
);

pub(super) const ACCURATE: Remark = Remark::error(
    "absolutely-accurate",
    "taught on an absolutely accurate robot (S has bit 4, 16), which corrects its targets \
         itself",
    "switch the correction of the controller off, or --force",
);

/// A position that only the running program knows.
pub(super) const COMPUTED: Remark = kit::computed(
    "computed-target",
    "write the position with numbers where it must be exact",
);

/// A position that a function makes of positions that may be rewritten.
pub(super) const COPIED: Remark = Remark::error(
    "target-copied",
    "this move goes to a position that the program computes from targets, which may be \
         corrected for other moves",
    "write the position with numbers",
);

/// A joint target without numbers in the files.
pub(super) fn home(name: &str) -> Remark {
    kit::joints_not_in_files(
        "joint-target-not-in-files",
        name,
        "give the $config.dat that declares it, too, to see it checked",
    )
}

/// Against a straight move or arc whose target has another orientation than where it starts.
pub(super) const KEEPS_ORIENTATION: Remark = Remark::error(
    "orientation-kept",
    "with $ORI_TYPE=#CONSTANT the tool keeps the orientation that it has where the move starts, \
         and that of the target is another or not known to be the same",
    "write A, B and C of the start into the target, or set $ORI_TYPE=#VAR",
);

/// Of a straight move or arc whose target has the orientation of where it starts.
pub(super) const KEEPS_SAME_ORIENTATION: Remark = Remark::warning(
    "orientation-not-corrected",
    "with $ORI_TYPE=#CONSTANT the tool keeps the orientation that it has where the move starts: it does \
         not turn by what the corrections of both ends differ",
    "set $ORI_TYPE=#VAR before the move, which does the same between ends of one orientation",
);

/// Against a target whose orientation the controller leaves out.
pub(super) const IGNORES_ORIENTATION: Remark = Remark::error(
    "orientation-kept",
    "the controller ignores A, B and C of this target ($ORI_TYPE=#IGNORE) and turns the tool on \
         from the points around it: how it stands there is not known",
    "set $ORI_TYPE=#VAR, with the A, B and C that the tool has there",
);

/// Only the running program knows the tool or base.
pub(super) const CHOSEN: Remark = Remark::error(
    "frame-chosen-at-run-time",
    "only the running program knows the tool or base",
    "set $TOOL and $BASE before the move in the same routine",
);

pub(super) const DECLARED_TWICE: Remark = Remark::error(
    "frame-name-ambiguous",
    "the tool, base or load is declared more than once with different values",
    "pass one $config.dat only",
);

/// Against moves with the tool and base of data that are not in the files.
pub(super) fn fdat_missing(name: &str) -> Remark {
    Remark::error_about(
        "frame-chosen-at-run-time",
        format!("{name} is not in the files: the numbers of its tool and base are not known"),
        "give the file that declares it by --with: the $config.dat of the controller, the .dat of the \
         same name as the program, or a $config.dat with a line of your own: DECL FDAT NAME={TOOL_NO \
         1,BASE_NO 0,IPO_FRAME #BASE}",
    )
}

pub(super) const FRAME_ASSIGNED: Remark = Remark::error(
    "frame-assigned-at-run-time",
    "the running program changes the tool or base",
    "assign it with numbers, or use another entry for each place",
);

pub(super) const MOVING: Remark = Remark::error(
    "moving-frame",
    "another kinematic moves the base (EK, MACHINE_FRAME_DAT)",
    "moves in a moving base are not compensated",
);

/// Against a base of another controller's kinematic.
pub(super) const OF_ANOTHER_ROBOT: Remark = Remark::error(
    "two-robots",
    "the base is on a kinematic of another controller (COOP_KRC_INDEX): where it stands only \
         that one knows",
    "moves on another robot's part are not compensated",
);

/// Against a base that another robot carries. What else of `RoboTeam` waits for another robot (`PROGSYNC`,
/// `$SYNC_LIST`) moves no frame.
pub(super) const LINKED: Remark = Remark::error(
    "two-robots",
    "another robot carries the base (LK): where it is only that one knows",
    "moves on another robot's part are not compensated",
);

/// Of moves that a sensor corrects.
pub(super) const SENSED: Remark = Remark::warning(
    "corrected-by-sensor",
    "from here on a sensor corrects moves (RSI_ON): each goes to its target, compensated, and what \
         the sensor adds",
    "look at the first part: what the sensor still has to correct is less",
);

/// Against moves behind a routine of a conveyor that is not in the files.
pub(super) fn conveyor(name: &str) -> Remark {
    Remark::error_about(
        "moving-frame",
        format!("since {name} the base may follow a conveyor"),
        "set $BASE behind it where it does not, or give the file with the routine, too",
    )
}

pub(super) const TURNED: Remark = Remark::note(
    "relative-joint-move",
    "this move turns axes from where the robot is; it is left as it is",
    "",
);

/// `XP = XQ:{Z 20}` on a track: which values of external axes XP has then is not documented.
pub(super) const WITHOUT_AXES: Remark = Remark::error(
    "run-time-target",
    "this position becomes a FRAME or POS, also as a product that ends with one, which has no external \
     axes; where they go with it is not known, and moves to it are not compensated",
    "move to the FRAME, POS or product itself (`LIN XQ:{Z 20}`), or write the position out with its \
     E1 to E6",
);

/// Of a joint move to some of the axes.
pub(super) const SOME_AXES: Remark = Remark::warning(
    "partial-target",
    "this move leaves axes out, which stay where they are; it is left as it is",
    "write A1 to A6",
);

pub(super) const FROM_NOWHERE: Remark = Remark::error(
    "relative-move",
    "this move goes relative to a position that the text does not tell, in another tool or base \
         than the move before, or by angles; it is not compensated",
    "write the target, or put the move behind one to a known target in the same tool and base, \
         without angles",
);

/// Against arcs with an angle.
pub(super) const ANGLE: Remark = Remark::error(
    "circular-angle",
    "this arc goes on to an angle (CA): where it ends is not where its points are",
    "write the arc without CA, with the point where it ends",
);

/// An entry of `LOAD_DATA` that the files do not have, behind another tool than that of its number.
pub(super) fn not_in_files(entry: u32) -> Remark {
    Remark::warning_about(
        "load-chosen-at-run-time",
        format!(
            "`LOAD_DATA[{entry}]` is not in the files: moves are taken with the load of the tool"
        ),
        "give the $config.dat that has it (--with), or write the load with numbers",
    )
}

/// A load that the text does not say.
pub(super) fn carried() -> Remark {
    kit::load_chosen(
        "load-chosen-at-run-time",
        "write the load with numbers, or choose an entry of LOAD_DATA",
    )
}

//! Everything that there is to find: each id once, with its severity, what it means and what to do.

use super::Severity::{self, Error, Note, Warning};

/// A finding by its id.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Kind {
    /// Stable name in kebab-case.
    pub id: &'static str,
    /// How much it usually matters.
    pub severity: Severity,
    /// What it means.
    pub meaning: &'static str,
    /// What to do.
    pub remedy: &'static str,
    /// The commands that find it.
    pub commands: &'static [&'static str],
    /// The languages in whose programs it is found; none where it is not a matter of the language.
    pub languages: &'static [&'static str],
    /// What it was called in earlier versions: still known by these names.
    pub was: &'static [&'static str],
    /// `--accept` does not take it: a number, a reach, a tool or a frame that nobody knows stays
    /// unknown.
    pub never_accepted: bool,
}

impl Kind {
    const fn was(self, was: &'static [&'static str]) -> Self {
        Self { was, ..self }
    }

    const fn never_accepted(self) -> Self {
        Self {
            never_accepted: true,
            ..self
        }
    }
}

const fn row(
    id: &'static str,
    severity: Severity,
    meaning: &'static str,
    remedy: &'static str,
    commands: &'static [&'static str],
    languages: &'static [&'static str],
) -> Kind {
    Kind {
        id,
        severity,
        meaning,
        remedy,
        commands,
        languages,
        was: &[],
        never_accepted: false,
    }
}

/// The finding of this id, or that was called so.
#[must_use]
pub fn kind(id: &str) -> Option<&'static Kind> {
    TABLE
        .iter()
        .find(|kind| kind.id == id || kind.was.contains(&id))
}

/// Every finding, by id.
pub const TABLE: &[Kind] = &[
    row("absolutely-accurate", Error, "S bit 4: the controller corrects the target itself; with `--force` a warning, once a file", "compensate a program that was written without absolute accuracy", &["compensate", "check"], &["krl"]),
    row("acceptance-unused", Warning, "an error that --accept names is not there", "leave the option out", &["compensate", "check"], &[]),
    row("angle-too-large", Error, "an angle of a target, tool or frame is in another unit than the language's", "degrees; radians in URScript: write angles of a few revolutions at most", &["compensate", "check"], &[]).never_accepted(),
    row("arc-chain", Error, "an arc has more than two points: each part of its path lies on another circle", "end each arc with its second point", &["compensate", "check"], &["kawasaki"]),
    row("at-singularity", Warning, "a target at the singularity of the wrist, where the real arm has no posture on the meant side, is solved as --at-singularity says", "check the move slowly, or move the target", &["compensate"], &[]),
    row("axes-unlike", Warning, "two measured joint axes lie otherwise to one another than in the profile", "is it this robot? does one joint move at a time?", &["axes"], &[]),
    row("bad-touch", Warning, "a touch contradicts the others and is left out (--robust)", "touch it again", &["register"], &[]),
    row("base-not-determined", Warning, "distances from few fixed points do not show how the base is rotated", "believe the arm's own values only; distances from three fixed points, or some positions, determine the base", &["calibrate", "validate", "diagnose"], &[]),
    row("base-tilted", Warning, "axis 1 is tilted from where the profile has it in the device's frame", "right where the robot is mounted so and the device is level; else gravity acts wrongly", &["calibrate", "validate", "diagnose"], &[]),
    row("beyond-limit", Warning, "a joint stands beyond its limit", "check the order and the unit of the joint columns, and the limits in the profile", &["calibrate", "validate", "diagnose"], &[]),
    row("branch-lost", Error, "the calibrated arm does not reach the pose on the configuration that the file gives", "move the target away from the singularity", &["compensate"], &[]).never_accepted(),
    row("circular-angle", Error, "an arc goes on to an angle (`CA`), and ends where none of its points is", "write the arc to the point where it ends, without an angle", &["compensate", "check"], &["krl"]),
    row("clearance", Error, "the real arm comes nearer to a body than is allowed", "move the target or the body, or give the pair another clearance in the cell", &["check"], &[]),
    row("clearance-uncertified", Warning, "the clearance along the move is bounded at samples only", "lead the path around the singularity", &["check"], &[]),
    row("collision", Error, "the real arm touches a body; a warning of `plan`, of its own program", "move the target or the body", &["check", "plan"], &[]),
    row("columns-not-read", Note, "columns of a table that nothing is read from: their names are none of the format", "name what they are with --columns", &["calibrate", "validate", "diagnose"], &[]),
    row("computed-target", Error, "a move goes to a position that only the running program knows", "move to a target that the files declare with numbers", &["compensate", "check"], &[]),
    row(
        "configuration-ambiguous",
        Error,
        "several postures of an arm with an offset wrist have the configuration that the file gives",
        "put a joint target before it",
        &["compensate", "check"],
        &[],
    ),
    row("configuration-change", Error, "a straight or circular move would have to change the arm's configuration", "a joint move can change it", &["check"], &[]),
    row("configuration-changed", Warning, "the fake target lies in another quarter of a revolution or on another side than the target: its configuration data are changed", "check the move on the robot slowly", &["compensate"], &[]),
    row("configuration-kept", Error, "the fake target needs other configuration data, and the file has no place for them", "go there on a straight line, or move the target away from the border", &["compensate"], &[]),
    row("configuration-mismatch", Warning, "no solution at the pose has the configuration data that the file gives", "check the configuration data, and that robot, tool and frame are those of the program", &["compensate", "check"], &[]),
    row("configuration-not-understood", Error, "other letters than `N F`, `U D`, `T B`, or not three of them and three turns; in AS a word that switches the configuration", "write CONFIG as the controller does: `CONFIG : 'N U T, 0, 0, 0'`", &["compensate", "check"], &["fanuc", "kawasaki"]),
    row("configuration-unknown", Error, "no solution has the configuration that the file gives, and no target before shows how the robot comes here", "check that robot, tool and frame are those of the program; start with a joint target", &["compensate", "check"], &[]),
    row("convex-corner", Note, "other poses fit the touched planes as well: they are taken as faces of a convex corner", "touch a point off the planes, too", &["register"], &[]),
    row("corner-direction", Note, "the robot cuts the corner at a target: joints with backlash are taken to come from the side of the programmed path", "stop at targets that must be exact", &["compensate"], &[]),
    row("corners-not-accepted", Warning, "the refinement by corners is left out: left-out corners do not improve", "touch and see more corners", &["handeye"], &[]),
    row("corrected-by-sensor", Warning, "a sensor or an offset corrects the move while it runs", "the correction of the program goes with it: look at the first part", &["compensate", "check"], &["rapid", "fanuc", "val3"]).was(&["path-corrected"]),
    row("direction-uncertain", Warning, "the text does not say in which direction joints with backlash come to the target", "come to the target on a longer move, from a point with numbers of its own, or give --start-joints", &["compensate", "check"], &[]),
    row("displaced-target", Warning, "a point that a move displaces from its target by known numbers is compensated with the target, not for itself; a note below --max-derived-error", "give the point a target of its own if it must be exact", &["compensate"], &[]),
    row("displacement-active", Error, "a shift of the program may be active at the move", "switch it off in the same routine before the move", &["compensate", "check"], &["rapid", "inform"]),
    row("displacement-unknown", Warning, "a move displaces its target by what the text does not say", "give the point a target of its own if it must be exact", &["compensate"], &[]),
    row("duplicate-rows", Warning, "rows repeat an earlier one to the last digit: they count twice", "a device never repeats itself exactly: leave copies out", &["calibrate", "validate", "diagnose"], &[]),
    row("effect-unused", Warning, "an effect of one tool applies to no move, and the profile has no tool of its name", "correct `tool` of the effect; without it the effect is of every tool", &["compensate", "check"], &[]),
    row("encoding", Note, "a table is no UTF-8: it is read as Latin-1, or UTF-16 by its mark", "save it as UTF-8 to be sure of its names", &["calibrate", "validate", "diagnose"], &[]),
    row("export-recognised", Note, "a table is read by the layout of an export of measuring software", "say what its columns are with --columns and --units where that is not so", &["calibrate", "validate", "diagnose"], &[]),
    row("external-axis-direction", Warning, "another direction of the rail, or another rotation of the base on it, fits the configuration data of the program better than the profile's", "correct `direction` of the track, or `kinematics.base`: they are those of the cell that the program was made for", &["compensate"], &[]),
    row("external-axis-limit", Error, "an external axis goes beyond its limits in the profile", "correct the program, or the limits under `external_axes`", &["compensate", "check"], &[]).never_accepted(),
    row("external-axis-unknown", Error, "an external axis does not stand at zero, and the profile does not say what it carries", "describe it under `external_axes`: in `track:`, in one of `positioners:`, or in `other:` where it moves nothing that a pose depends on", &["compensate", "check"], &[]).was(&["external-axis", "base-axis", "extended-axis"]),
    row("external-chain", Error, "what carries the work frame is carried itself, or carries the base", "stations on tracks are not compensated", &["compensate", "check"], &[]),
    row("external-offset-unknown", Error, "external axes are shifted by an amount that only the running program knows", "write EOffsSet with numbers, or switch it off with EOffsOff before the move", &["compensate", "check"], &[]),
    row("external-value-unknown", Error, "nothing says where an external axis of the profile stands at a move", "write its value into the target, or into one that is certainly before it", &["compensate", "check"], &[]).never_accepted(),
    row("feature-radius", Warning, "a sphere or hole has another radius than in FROM", "is the probe's radius right?", &["register"], &[]),
    row("few-points", Note, "three points check each other little: the noise comes from three redundant distances", "measure more points", &["register"], &[]),
    row("file-not-in-project", Note, "the project file (.pjx) does not name a file of its folder: it is left out", "name the file in the .pjx if the robot loads it", &["compensate", "check"], &["val3"]),
    row("frame-as-saved", Warning, "no statement sets the tool or base before the move: it is taken as it was when the controller was saved", "set TOOL and BASE in the program, or compare them with the pendant", &["compensate", "check"], &["kawasaki"]),
    row("frame-assigned-at-run-time", Error, "the running program changes the tool or the frame", "assign it once, with numbers, or declare one for each place", &["compensate", "check"], &["rapid", "krl", "fanuc", "urscript", "inform", "val3", "kawasaki"]).never_accepted(),
    row("frame-chosen-at-run-time", Error, "only the running program knows which tool or frame a move has", "name the tool and the frame in the move", &["compensate", "check"], &[]).was(&["frame-known-at-run-time", "tool-known-at-run-time"]).never_accepted(),
    row("frame-name-ambiguous", Error, "a tool or frame is declared more than once", "pass only the files of one controller, or make the data local", &["compensate", "check"], &["rapid", "krl"]).never_accepted(),
    row("frame-not-named", Error, "a rectangular position without POSTYPE, or without the number of its user frame", "write POSTYPE, and UFNO of a user frame", &["compensate", "check"], &["inform"]).never_accepted(),
    row("frame-number-differs", Warning, "another number is selected than the point was taught with", "see which frame and tool the point was taught with", &["compensate", "check"], &["fanuc"]),
    row("frame-unknown", Error, "neither files nor profile nor command line say where a tool or work frame is (with --write-good an error of the programs that use it)", "give the files that declare it, or --tool and --frame", &["compensate"], &[]).never_accepted(),
    row("frames-rounded", Note, "FRAME.DG shows tools and frames with one decimal", "give SYSFRAME.VA, or --tool and --frame with their decimals", &["compensate", "check"], &["fanuc"]),
    row("gravity-by-device", Warning, "axis 1 is tilted from where the profile has it in the device's frame, and the arm bends as if the device were level: gravity is along the device's z in what is written", "right where the robot is mounted so; where the device was tilted, look for what else bends the arm", &["calibrate"], &[]),
    row("grip-load", Warning, "the robot carries something that is not in the tool's load (GripLoad): the correction is that of the tool alone", "name the load at the moves with \\TLoad, or put it into the tool of the profile that is used there", &["compensate", "check"], &["rapid"]),
    row("group-without-geometry", Error, "a move is coordinated with another motion group (COORD), and how that one moves the work piece is not known", "describe the positioner under `external_axes` with `follows: always`", &["compensate", "check"], &["fanuc"]),
    row("hardly-determined", Warning, "the model has nearly as many parameters as the rows have numbers", "measure more configurations, or identify less with --level", &["calibrate", "validate", "diagnose"], &[]),
    row("held-work-piece", Error, "the robot holds the work piece, and the tool stands still", "moves with a held work piece are not compensated", &["compensate", "check"], &["rapid", "krl"]).was(&["external-tcp"]),
    row("icp-ambiguous", Error, "another pose fits as well: the part is symmetric, or the points do not show what breaks its symmetry", "--start says which pose is meant", &["register"], &[]),
    row("icp-free-motion", Error, "the surface leaves a motion free", "scan more of the part", &["register"], &[]),
    row("icp-local-minimum", Error, "the residual is larger than the noise of the points explains", "give a --start, or --sigma-mm if the noise is known to be larger", &["register"], &[]),
    row("icp-not-converged", Error, "the search still moves the points", "give a better --start", &["register"], &[]),
    row("icp-overlap", Error, "too little of FROM lies on TO", "give a --start; where only a part was scanned, a smaller --keep and --min-overlap", &["register"], &[]),
    row("inverse-start-unknown", Warning, "`qnear` is known at run time only; the present joints are taken", "give `qnear` with numbers", &["compensate", "check"], &["urscript"]),
    row("joined-in-order", Note, "--joints and --points are joined row by row, as not both have a column id", "give both a column id, so that a missing row is found", &["calibrate", "validate", "diagnose"], &[]),
    row("joint-limit", Error, "a joint leaves its range", "move the target, or take another configuration", &["compensate", "check"], &[]).never_accepted(),
    row("joint-never-moved", Warning, "a joint stands still: its parameters cannot be separated from those of its neighbours", "measure configurations in which every joint moves", &["calibrate", "validate", "diagnose"], &[]),
    row("joint-speed", Warning, "a joint would have to run faster than it can", "the controller will slow down: give the move more time", &["check"], &[]),
    row("joint-target-not-in-files", Note, "a move goes to axes without a value in the files, such as XHOME", "give the file that declares them, if they matter", &["compensate", "check"], &["rapid", "krl"]),
    row("keep-out", Warning, "a move of the program goes into a --keep-out-mm", "drive it by hand, over a pose between, or leave the configuration out", &["plan"], &[]),
    row("large-turn", Note, "a joint rotates by more than half a revolution in one move", "cables and hoses rotate along: look at them", &["check"], &[]),
    row("leaves-box", Warning, "a move of the program takes the tool out of --inside-mm", "drive it by hand, over a pose between, or leave the configuration out", &["plan"], &[]),
    row("library-at-run-time", Warning, "a library is loaded while the program runs: its data are taken to be those of the files", "give the project that is loaded too, or keep its points out of the path", &["compensate", "check"], &["val3"]),
    row("little-variety", Warning, "the rows are of too few configurations to fit base and tool", "validate on more configurations", &["validate"], &[]),
    row("load-beyond-payload", Error, "the load of a tool is more than robot.payload_kg of the profile; a warning of `check`", "masses are in kg; correct the load, or robot.payload_kg", &["compensate", "check"], &[]),
    row("load-chosen-at-run-time", Warning, "only the running program knows the load that the robot carries; that of the tool is taken", "write the load with numbers; in KRL choose an entry of LOAD_DATA", &["compensate", "check"], &["krl", "rapid", "urscript"]),
    row("load-unknown", Warning, "a tool counts as 0 kg, while the profile has masses of tools of other names and effects that depend on them", "call the tool in the profile as the program does", &["compensate", "check"], &[]),
    row("long-line", Warning, "new numbers may make the line longer than the controller takes", "break the line before compensating, or use fewer decimals", &["compensate", "check"], &["krl"]),
    row("mesh-unit", Error, "a mesh in a format without units is a hundred times smaller than another body or the arm, if its unit is a millimetre", "write `scale: 1000` next to `mesh` if the file is in metres, `scale: 1` if it is in millimetres", &["check"], &[]),
    row("motion-without-target", Note, "moves by speed or force: they have no target", "they stay as they are", &["compensate", "check"], &["urscript"]),
    row("move-not-supported", Error, "other moves: conveyors, external reference points, arcs with which the tool rotates", "move to targets with MOVJ, MOVL, MOVC or MOVS; in VAL 3 with movej, movel or movec; in URScript with movec and mode=0", &["compensate", "check"], &["urscript", "inform", "val3"]),
    row("moving-frame", Error, "a conveyor or another mechanical unit moves the frame", "moves in a moving frame are not compensated", &["compensate", "check"], &["rapid", "krl", "fanuc", "urscript", "inform"]).was(&["coordinated-move", "line-tracking"]),
    row("near-joint-limit", Warning, "a joint comes nearer to its limit than --limit-margin", "move the target, or take another configuration", &["check"], &[]),
    row("near-singularity", Warning, "near a singularity small shifts of the tool are large rotations of joints", "check the move on the robot slowly, or move the target away", &["compensate", "check"], &[]),
    row("negative-compliance", Warning, "a compliance is below zero: nothing springs against its load", "are the masses in the profile those that were there? --fix leaves it out", &["calibrate"], &[]),
    row("no-agreement", Warning, "no motion agrees with more than half of the points", "see that the rows of both files belong together", &["register"], &[]),
    row("no-masses", Note, "the profile has no masses: compliance of the joints is not identified", "give `bodies` and the tool's mass, or --level 2 if the arm is light and stiff", &["calibrate", "validate", "diagnose"], &[]),
    row("no-shapes", Note, "the profile has no shapes: whether the arm touches itself is not looked at", "give the links shapes in the profile", &["plan"], &[]),
    row("no-targets", Warning, "no target in the program: nothing is changed", "a program that calls others is compensated together with them", &["compensate"], &[]),
    row("no-tool-mass", Note, "a tool has no mass: what it weighs goes into the compliance of the joints", "give the tool `mass_kg` and `cog_mm` in the profile", &["calibrate", "validate", "diagnose"], &[]),
    row("nominal-clearance", Warning, "the nominal arm comes nearer to a body than is allowed", "look at the simulation: it had that already", &["check"], &[]),
    row("nominal-collision", Warning, "the nominal arm touches a body", "look at the simulation: it had that already", &["check"], &[]),
    row("not-as-calibrated", Error, "the arm errs by more than it did when it was calibrated (--as-calibrated)", "measure as for a calibration, and let `diagnose` say what has changed", &["validate"], &[]),
    row("not-checked", Warning, "whether the arm touches itself on its path is not looked at", "drive it by hand the first time", &["plan"], &[]),
    row("not-converged", Error, "the search for the fake target did not come to an end", "report the program: this should not happen where the arm reaches the pose", &["compensate"], &[]).never_accepted(),
    row("not-finite", Error, "a pose, joint or number is not finite: nothing is written for the target, nothing is known of the move", "look for a number out of all bounds in the profile and in the tool", &["compensate", "check"], &[]).never_accepted(),
    row("not-measured", Note, "poses of --joints have no row in --points: they are left out", "see that both files name their rows alike", &["calibrate", "validate", "diagnose"], &[]),
    row("number-inserted", Note, "a target leaves out numbers that are zero, and the correction needs them: they are put in, in the order of the format", "nothing: the text of each is in the message", &["compensate"], &[]),
    row("orientation-kept", Error, "a straight move or arc keeps the orientation of its start ($ORI_TYPE=#CONSTANT), and the target may have another", "write the angles of the start into the target, or let the orientation change", &["compensate", "check"], &["krl"]),
    row("orientation-not-read", Warning, "a table has three angles of an orientation, and nothing names their convention: positions alone are read", "name the convention with --euler", &["calibrate", "validate", "diagnose"], &[]),
    row("other-group", Note, "moves to points that have no group 1", "they stay as they are", &["compensate", "check"], &["fanuc"]),
    row("out-of-reach", Error, "the calibrated arm does not reach the wanted pose", "check the tool and the work frame; move the part nearer", &["compensate"], &[]).never_accepted(),
    row("outlier", Warning, "a row does not fit the others; `axes` leaves it out, `handeye` does not", "measure them again, or leave them out", &["axes", "handeye"], &[]),
    row("outliers", Warning, "rows do not fit the others", "measure them again, or leave them out", &["calibrate", "validate", "diagnose"], &[]),
    row("partial-target", Error, "components are missing: they keep the value of the position before, or are zero", "write all components of the target", &["compensate", "check"], &["krl", "kawasaki"]),
    row("path-at-reversal", Warning, "joints with backlash reverse where a move begins: the tool is farther off its wanted path than --max-path-error until the backlash is taken up", "accept the path's beginning, or come to it from the side to which the move leaves", &["compensate"], &[]),
    row("path-error", Error, "the path between targets is farther from the wanted one than --max-path-error", "`poseshift compensate --max-path-error` inserts targets where the path needs them", &["check"], &[]),
    row("path-from-kept-target", Warning, "the path begins or ends at a target that stays as it is, or is off itself", "compensate that one, too, or accept the path's beginning", &["compensate"], &[]),
    row("path-not-refined", Error, "the path between two targets cannot be kept within --max-path-error", "give the move a target of its own, or leave --max-path-error out", &["compensate"], &[]),
    row("path-out-of-reach", Error, "the path between two targets leaves the arm's reach", "go round with a target between, or a joint move", &["check"], &[]),
    row("path-uncertified", Note, "the error along the move is bounded at samples only", "look at the move near its singularity", &["check"], &[]),
    row("plate-rows-left-out", Note, "points on plates do not fit their positioner at all: no error of it is sought", "the device's place, the columns `e1_deg` … and the names of the points", &["diagnose"], &[]),
    row("poor-fit", Warning, "the model misses the rows by more than few arms are from their drawing", "is it this robot, this tool, this order of rows, every column in its unit?", &["calibrate", "validate", "diagnose", "axes"], &[]),
    row("position-count", Warning, "NPOS announces another number of C positions", "write the header anew on the controller", &["compensate", "check"], &["inform"]),
    row("position-variable", Note, "moves go to P variables, which jobs that are not given may change", "give all jobs that write into them", &["compensate", "check"], &["inform"]),
    row("positioner-unknown", Error, "the program says that a unit carries the work frame, and the profile does not describe it", "describe it under `external_axes`: `positioners:`", &["compensate", "check"], &[]),
    row("posture-assumed", Warning, "neither configuration data nor a move before say in which posture the robot comes to a target", "begin with a joint move to joints, or give --start-joints", &["compensate", "check"], &[]),
    row("pulses-per-degree-unknown", Warning, "positions in pulses, and a profile without `pulses_per_deg`: they stay; once a job", "write controller.pulses_per_deg into the profile", &["compensate", "check"], &["inform"]),
    row("rconf-of-post", Warning, "RCONF of a post that is known to mix its fields up; it is not used", "see that the controller stands so, or teach the joints", &["compensate", "check"], &["inform"]),
    row("relative-joint-move", Note, "a relative move of axes", "it stays as it is", &["compensate", "check"], &["krl"]),
    row("relative-move", Error, "a relative move from a position that the text does not give", "move to a target with its own numbers", &["compensate", "check"], &["krl", "fanuc", "inform", "kawasaki"]).was(&["incremental-move"]),
    row("robot-root-differs", Error, "$ROBROOT of the machine data is not `kinematics.base` of the profile", "write $ROBROOT into `kinematics.base`: every tool and base of the program counts from there", &["compensate", "check"], &["krl"]),
    row("rounding", Error, "the decimals that the file can hold leave the tool more than 0.01 mm or 0.01 deg off its wanted pose; a warning of targets in joints", "--decimals 4 writes more, where the controller takes them", &["compensate"], &[]),
    row("run-time-position", Note, "a move goes to where the robot itself was; that is right as it is", "it stays as it is", &["compensate", "check"], &[]),
    row("scale", Warning, "TO is larger or smaller than FROM; `handeye`: the board than the camera was given; `calibrate`: the arm than its profile, in all lengths", "other units, or a part that is warmer or colder than its drawing; `handeye`: measure the board's squares; `calibrate`: see the device's temperature, pressure and prism constant", &["register", "handeye", "calibrate", "validate", "diagnose"], &[]),
    row("search-move", Error, "a search decides where the move ends", "move to a target that the files declare with numbers", &["compensate", "check"], &["inform", "kawasaki"]),
    row("second-robot", Error, "the move has a target for a second robot", "compensate the jobs of each robot alone", &["compensate", "check"], &["inform"]),
    row("seen-before", Warning, "the profile was calibrated with these rows: its error on them is too small", "mark rows `validate` in the column `set` before calibrating, measure others, or use --folds", &["validate"], &[]),
    row("seven-axis-arm", Error, "the arm has a seventh joint, which stands where other arms have an external axis", "only arms with six joints are compensated", &["compensate", "check"], &["rapid"]),
    row("several-postures", Warning, "the controller may reach the pose in another posture than the one it was compensated for", "see that the controller stands so, or teach the joints", &["compensate"], &[]),
    row("shift-too-large", Error, "the correction shifts a target farther than ten times what the profile's effects usually do, or than 20 mm or 2 deg, or than --max-shift", "check the effects of the profile and the load of the tool; --max-shift MM,DEG raises the limit", &["compensate"], &[]),
    row("sigma-large", Warning, "the stated standard deviations are larger than the residuals allow", "sigma_mm is one standard deviation of a coordinate in mm, not in micrometres", &["calibrate", "validate", "diagnose", "register"], &[]),
    row("sigma-small", Warning, "the residuals are larger than the stated standard deviations allow", "`poseshift diagnose` looks for what the model misses", &["calibrate", "validate", "diagnose", "register"], &[]),
    row("stationary-tool", Error, "the tool does not hang on the robot", "moves with a stationary tool are not compensated", &["compensate", "check"], &["rapid", "fanuc"]).was(&["remote-tool"]),
    row("streamed-motion", Error, "servoj or servoc to a pose", "write the path with movej, movel, movep or movec", &["compensate", "check"], &["urscript"]),
    row("suspect-touch", Warning, "a touch contradicts the others; it is in the fit", "--robust leaves such touches out", &["register"], &[]),
    row("sync-move", Note, "the move runs together with one of another robot", "check both robots together", &["compensate", "check"], &["rapid"]),
    row("target-assigned-at-run-time", Error, "the running program changes the target", "correct the value where the program computes it, or keep the target out of the path", &["compensate", "check"], &[]).was(&["target-used-by-instruction"]),
    row("target-copied", Warning, "another target is computed from this one", "see whether the other one should be compensated, too", &["compensate", "check"], &["krl", "fanuc", "urscript", "inform"]),
    row("target-has-expressions", Error, "parts of the target are expressions, not numbers", "write the target with numbers in the offline system", &["compensate", "check"], &["rapid", "krl", "urscript"]).was(&["joints-have-expressions"]),
    row("target-in-context", Error, "a move goes to a target in a file that is read for its declarations only", "give that file as a program too", &["compensate"], &[]),
    row("target-name-ambiguous", Error, "a name is declared more than once, and its use does not say which is meant", "pass only the files of one controller, or make the data local", &["compensate", "check"], &["rapid", "krl", "fanuc", "inform", "val3", "kawasaki"]).was(&["target-declared-twice"]),
    row("target-not-in-files", Error, "a move goes to a target that the files do not declare", "give the file that declares it together", &["compensate", "check"], &["rapid", "krl", "fanuc", "urscript", "inform", "val3", "kawasaki"]).was(&["target-not-in-file"]),
    row("target-not-six-axes", Error, "the target does not have the six joints of the arm", "compensate programs of arms with six joints", &["compensate", "check"], &["fanuc", "inform", "val3", "kawasaki"]).was(&["axis-count"]),
    row("target-overwritten", Error, "the running program writes numbers over some of a copy of a target: these lose its correction; a warning below --max-derived-error", "give the point a target of its own", &["compensate"], &[]),
    row("target-passed-to-routine", Error, "the target is handed to a routine, which may use it with any tool and frame", "move to the target where its tool and frame are named", &["compensate", "check"], &[]).was(&["target-passed-to-function"]),
    row("target-shared", Error, "one target is used with several tools or frames", "give each use a target of its own", &["compensate"], &[]),
    row("target-uninitialised", Error, "a move goes to a point that was never taught", "teach the point", &["compensate", "check"], &["fanuc", "val3"]),
    row("target-unused", Error, "no move of these files uses the target: its tool and frame are not known", "give the files that use it together, or --tool and --frame for it, or --keep-going to leave it as it is", &["compensate"], &[]).never_accepted(),
    row("target-unused-here", Note, "no move in these files uses the targets: they stay as they are", "give the files that use them together with these, or nothing if none does", &["compensate", "check"], &[]).was(&["target-never-used"]),
    row("target-used-as-frame", Error, "the target is a tool or base, too", "give the frame data of its own", &["compensate", "check"], &[]),
    row("target-used-as-offset", Error, "a target is also the offset of another", "give the offset a variable of its own", &["compensate", "check"], &["urscript"]),
    row("too-many-uses", Error, "the robot comes to a move, or data to a place, in more cases than are followed; the rest is not checked", "compensate the parts of the program on their own", &["compensate", "check"], &[]),
    row("tool-coordinates", Error, "POSTYPE TOOL or MTOOL: the position hangs on where the arm stands", "write the position in base, robot or user coordinates", &["compensate", "check"], &["inform"]),
    row("tool-elsewhere", Warning, "the measured point is far from where the profile has the tool", "is another point or tool measured, or a joint counted in the other direction?", &["calibrate", "validate", "diagnose", "axes"], &[]),
    row("tool-unit", Error, "a tool is off the flange by less than 1 mm in each coordinate: metres are meant; a warning of `check`", "write it in the unit of the language, or 0 for the flange itself", &["compensate", "check"], &[]),
    row("track-extrapolated", Warning, "a move goes beyond the part of the rail that was measured, and the rail's errors are powers of the place", "measure the rail as far as programs use it", &["compensate", "check"], &[]),
    row("two-robots", Error, "another robot carries the work piece or moves with this one", "moves relative to another robot are not compensated", &["compensate", "check"], &["rapid", "krl"]),
    row("unmatched-ids", Warning, "rows without a partner are left out", "see that both files name their points alike", &["register"], &[]),
    row("unusual-value", Warning, "an identified value is far beyond the usual", "is it this robot, this tool, this order of rows, every column in its unit?", &["calibrate", "validate", "diagnose"], &[]),
    row("weak-rotation", Warning, "the poses rotate about one direction only", "add poses that tilt the flange in another direction", &["handeye"], &[]),
    row("worse-than-nominal", Warning, "the calibrated model is worse on these rows than the nominal one", "is it this robot, and the tool and load of the calibration?", &["validate"], &[]),
    row("wrist-not-told", Warning, "a job starts with a rectangular position, so that nothing gives the solution of the wrist", "start the job with a position in pulses", &["compensate", "check"], &["inform"]),
    row("write-not-called", Warning, "a routine that changes a target or a frame is called by none of these files", "give the file that calls it, too", &["compensate", "check"], &[]),
];

//! What programs of one controller share: tools, user frames, position registers, and states that
//! last until they change.

use super::frames;
use super::words::{LOCAL, words};
use crate::finding::Severity;
use crate::geometry::Pose;
use crate::program::script::{
    Expected, Expr, Held, Place, Remark, RemarkId, Script, TableId, ValueId, Variable, VariableId,
    short,
};
use foldhash::{HashMap, HashMapExt};

/// The highest number of a tool or frame.
const MOST_FRAMES: u32 = 255;

/// Tool or user frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Tool,
    Frame,
}

/// The one, or with a word of another dictionary either.
pub(super) type Which = Option<Kind>;

/// Both, or the one.
pub(super) fn kinds(which: Which) -> impl Iterator<Item = Kind> {
    let is_meant = move |kind: &Kind| which.is_none_or(|which| which == *kind);
    [Kind::Tool, Kind::Frame].into_iter().filter(is_meant)
}

/// The tools or user frames of a controller.
#[derive(Debug)]
pub(super) struct Numbered {
    /// Which the program has selected.
    pub selected: VariableId,
    /// Which is active: what is selected, or what a point was taught with that the robot went to.
    pub active: VariableId,
    /// Those that can be set: not the flange and the world.
    pub others: TableId,
    all: TableId,
    what: &'static str,
    name: &'static str,
    shown: frames::Numbered,
    variables: HashMap<u32, VariableId>,
    taught: HashMap<u32, RemarkId>,
}

/// A state in which a sensor or an earlier search corrects moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Mode {
    TouchOffset,
    Search,
    Track,
    /// `MP Offset`: what the first pass of a weld has recorded.
    PassOffset,
}

/// What is said of points and moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Why {
    /// `INC`. The first four speak against moves, see [`Controller::guards`].
    Incremental,
    /// `RTCP`
    StationaryTool,
    /// `COORD`
    Coordinated,
    LineTracking,
    /// A register, or a position of a pallet.
    Computed,
    /// A register whose numbers the program writes one by one.
    Written,
    Missing,
    FrameAssigned,
    FrameChosen,
    Corrected,
    Uninitialised,
    Axes,
    Configuration,
    Ambiguous,
}

impl Why {
    /// The finding, what is wrong, and the way out.
    pub(super) fn remark(self) -> Remark {
        let six = "only arms with six joints are compensated";
        let moving = "moves in a moving frame are not compensated";
        let (id, text, hint) = match self {
            Self::Incremental => (
                "relative-move",
                "this point is an increment (INC), not a place",
                "move to a point of its own instead",
            ),
            Self::StationaryTool => (
                "stationary-tool",
                "the tool stands still and the robot holds the work piece (RTCP)",
                "moves with a stationary tool are not compensated",
            ),
            Self::Coordinated => (
                "group-without-geometry",
                "the move is coordinated with a positioner (COORD), which moves the work piece",
                "describe the positioner under `external_axes` of the profile (G2J1…), with \
                 `follows: always`",
            ),
            Self::LineTracking => ("moving-frame", "the program follows a conveyor", moving),
            Self::Computed => (
                "computed-target",
                "only the running program knows the position (a register); what goes there stays \
                 as it is",
                "write the position as a point of the program where it must be exact",
            ),
            Self::Written => (
                "computed-target",
                "the program itself writes all numbers of the register that this move goes to: it \
                 goes there as they are, uncorrected",
                "write the position as a point of the program where it must be exact",
            ),
            Self::Missing => (
                "target-not-in-files",
                "the point that this move goes to is not in /POS of this file; this move is not \
                 compensated",
                "export the program again, whole",
            ),
            Self::FrameAssigned => (
                "frame-assigned-at-run-time",
                "the running program changes the tool or user frame",
                "set it up once, and give its value",
            ),
            Self::FrameChosen => (
                "frame-chosen-at-run-time",
                "only the running program knows which tool or user frame is selected",
                "select it with UTOOL_NUM and UFRAME_NUM and a number, or teach the point again",
            ),
            Self::Corrected => (
                "corrected-by-sensor",
                "from here on a sensor or a search corrects moves: each goes to its point, \
                 compensated, and what the sensor adds",
                "look whether the sensor was set up with the same arm",
            ),
            Self::Uninitialised => (
                "target-uninitialised",
                "this point was never taught (********), and a move goes there: the controller stops \
                 at it",
                "teach the point at the robot, where it is exact as it is, or take the move out",
            ),
            Self::Axes => (
                "target-not-six-axes",
                "group 1 of this point is neither X Y Z W P R in mm and deg nor J1 to J6 in deg",
                six,
            ),
            Self::Configuration => (
                "configuration-not-understood",
                "these configuration data are not those of an arm with six joints and a spherical \
                 wrist",
                six,
            ),
            Self::Ambiguous => (
                "target-name-ambiguous",
                "this point stands in /POS more than once",
                "keep the one that is meant",
            ),
        };
        let severity = match self {
            Self::Computed | Self::Written | Self::Corrected | Self::Uninitialised => {
                Severity::Warning
            }
            _ => Severity::Error,
        };
        let text = text.into();
        Remark {
            id,
            severity,
            text,
            hint,
        }
    }
}

/// What all programs share.
#[derive(Debug)]
pub(super) struct Controller {
    kinds: [Numbered; 2],
    /// Position registers.
    pub registers: TableId,
    modes: [VariableId; 4],
    /// Variables that speak against moves.
    refusals: [VariableId; 4],
    guards: [Option<u32>; 16],
    expected: HashMap<(Option<u32>, Option<u32>), u32>,
    numbers: HashMap<u32, ValueId>,
    corrected: ValueId,
    /// Configuration data count.
    pub honoured: ValueId,
    /// Where the robot is.
    pub actual: ValueId,
    pub computed: RemarkId,
    pub written: RemarkId,
    pub missing: RemarkId,
    pub assigned: RemarkId,
    pub chosen: RemarkId,
}

impl Controller {
    pub(super) fn new(script: &mut Script, values: frames::All) -> Self {
        let numbered = |script: &mut Script, [what, name, active]: [&'static str; 3], shown| {
            // what is active before a program selects any is called as points call it
            let declared = script.frame("F", None);
            Numbered {
                selected: variable(script, active, Expr::Value(declared), true, true),
                active: variable(script, active, Expr::Value(declared), true, true),
                all: script.table(name),
                others: script.table(name),
                what,
                name,
                shown,
                variables: HashMap::new(),
                taught: HashMap::new(),
            }
        };
        let kinds = [
            numbered(script, ["tool", "UTOOL", "UTOOL_NUM"], values.tools),
            numbered(
                script,
                ["user frame", "UFRAME", "UFRAME_NUM"],
                values.frames,
            ),
        ];
        let against = [
            Why::Incremental,
            Why::StationaryTool,
            Why::Coordinated,
            Why::LineTracking,
        ];
        let refusals = against.map(|why| {
            let remark = script.remark(why.remark());
            let value = script.value(Held::Remark(remark));
            variable(script, "", Expr::Value(value), false, false)
        });
        let corrected = script.remark(Why::Corrected.remark());
        Self {
            kinds,
            registers: script.table("PR"),
            modes: ["Touch Offset", "Search", "Track", "MP Offset"]
                .map(|name| variable(script, name, Expr::Absent, false, false)),
            refusals,
            guards: [None; 16],
            expected: HashMap::new(),
            numbers: HashMap::new(),
            corrected: script.value(Held::Remark(corrected)),
            honoured: script.value(Held::Flag(true)),
            actual: script.value(Held::Actual),
            computed: script.remark(Why::Computed.remark()),
            written: script.remark(Why::Written.remark()),
            missing: script.remark(Why::Missing.remark()),
            assigned: script.remark(Why::FrameAssigned.remark()),
            chosen: script.remark(Why::FrameChosen.remark()),
        }
    }

    pub(super) fn of(&self, kind: Kind) -> &Numbered {
        &self.kinds[kind as usize]
    }

    /// The variable of a tool or frame.
    pub(super) fn entry(&mut self, script: &mut Script, kind: Kind, number: u32) -> VariableId {
        let of = &mut self.kinds[kind as usize];
        if let Some(&known) = of.variables.get(&number) {
            return known;
        }
        let name = format!("{}[{number}]", of.name);
        let shown = of.shown.get(&number).filter(|_| number > 0);
        let declared = if let Some([one, other]) = shown.and_then(frames::Shown::disagreeing) {
            script.unknown(Remark::error_about(
                "frame-name-ambiguous",
                format!("{one} and {other} show another {name}"),
                "give the files of one controller only, and of its backups one",
            ))
        } else {
            let zero = (number == 0).then(Pose::identity);
            let pose = zero.or_else(|| shown.map(|shown| shown.pose));
            Expr::Value(script.frame(number.to_string(), pose))
        };
        let made = variable(script, &name, declared, true, false);
        of.variables.insert(number, made);
        let tables = [Some(of.all), (number > 0).then_some(of.others)];
        for table in tables.into_iter().flatten() {
            let entries = &mut script.tables[table as usize].entries;
            entries.insert(i64::from(number), made);
        }
        made
    }

    /// The tool or frame that a point names.
    pub(super) fn selected(
        &mut self,
        script: &mut Script,
        kind: Kind,
        selected: Option<u32>,
    ) -> Expr {
        match selected {
            Some(number) => Expr::Variable(self.entry(script, kind, number)),
            None => self.active(kind),
        }
    }

    /// The tool or frame that is selected when the robot goes there.
    pub(super) fn active(&self, kind: Kind) -> Expr {
        let of = self.of(kind);
        Expr::Element {
            table: of.all,
            number: of.active,
        }
    }

    /// A number that selects a tool or frame.
    pub(super) fn number(&mut self, script: &mut Script, which: Which, number: u32) -> Expr {
        for kind in kinds(which).filter(|_| number <= MOST_FRAMES) {
            self.entry(script, kind, number);
        }
        let value = self.numbers.entry(number);
        Expr::Value(*value.or_insert_with(|| script.value(Held::Number(i64::from(number)))))
    }

    /// The controller stops at moves to points where other numbers are selected than the points
    /// were taught with.
    pub(super) fn expected(
        &mut self,
        script: &mut Script,
        tool: Option<u32>,
        frame: Option<u32>,
    ) -> u32 {
        let key = (tool, frame);
        if let Some(&known) = self.expected.get(&key) {
            return known;
        }
        let mut all = Vec::new();
        for (number, of) in [key.0, key.1].into_iter().zip(&mut self.kinds) {
            let Some(number) = number else { continue };
            let text = format!(
                "another {} is selected here than the {number} of points that are gone to: the \
                 controller stops at such a move",
                of.what
            );
            let remark = of.taught.entry(number).or_insert_with(|| {
                script.remark(Remark::warning_about(
                    "frame-number-differs",
                    text,
                    "select the number that the point was taught with",
                ))
            });
            all.push(Expected {
                variable: of.selected,
                number: i64::from(number),
                remark: *remark,
            });
        }
        script.expected.push(all.into());
        let at = short(script.expected.len() - 1);
        self.expected.insert(key, at);
        at
    }

    /// The variable of a position register.
    pub(super) fn register(&mut self, script: &mut Script, number: u32) -> VariableId {
        let (table, entry) = (self.registers as usize, i64::from(number));
        if let Some(&known) = script.tables[table].entries.get(&entry) {
            return known;
        }
        let unknown = Expr::Unknown(self.computed);
        let name = match number.checked_sub(LOCAL) {
            Some(number) => format!("LPR[{number}]"),
            None => format!("PR[{number}]"),
        };
        let made = variable(script, &name, unknown, true, false);
        script.tables[table].entries.insert(entry, made);
        made
    }

    /// What may speak against a move, by the first four of [`Why`].
    pub(super) fn guards(&mut self, script: &mut Script, against: [bool; 4]) -> u32 {
        let bits = against
            .iter()
            .fold(0, |bits, is| 2 * bits + usize::from(*is));
        *self.guards[bits].get_or_insert_with(|| {
            let refused = self.refusals.iter().zip(against).filter(|(_, is)| *is);
            let all = refused.map(|(variable, _)| *variable).chain(self.modes);
            script.guard(all)
        })
    }

    /// The mode that `Touch Offset PR[1]`, `Search Start[1] PR[1]`, `Track TAST[1]`, `MP Offset PR[1]
    /// RPM[1]` and their ends switch: its variable, and what it holds then.
    pub(super) fn mode(&self, name: &[u8], rest: &[u8]) -> Option<(Mode, VariableId, Expr)> {
        let mut words = words(rest);
        let mode = match name {
            b"TOUCH" => words
                .next()
                .filter(|word| word.eq_ignore_ascii_case(b"OFFSET"))
                .map(|_| Mode::TouchOffset)?,
            b"SEARCH" => Mode::Search,
            b"MP" => words
                .next()
                .filter(|word| word.eq_ignore_ascii_case(b"OFFSET"))
                .map(|_| Mode::PassOffset)?,
            _ => Mode::Track,
        };
        let ends = words
            .next()
            .is_some_and(|word| word.eq_ignore_ascii_case(b"END"));
        let holds = if ends {
            Expr::Absent
        } else {
            Expr::Value(self.corrected)
        };
        Some((mode, self.modes[mode as usize], holds))
    }
}

/// A variable that the files do not declare.
fn variable(
    script: &mut Script,
    name: &str,
    declared: Expr,
    kept: bool,
    shared: bool,
) -> VariableId {
    script.variable(Variable {
        kept,
        shared,
        ..Variable::new(name, Place::NOWHERE, declared)
    })
}

//! From what was noted to statements: who may be where, is for [`crate::motion`].

use super::EXTERNAL;
use super::behind::Asked;
use super::derived::Origins;
use super::handlers::Handlers;
use super::modes::{Modes, switched};
use super::resolved::{Entity, Resolved};
use super::syntax::{StatementKind, Storage, Type};
use crate::program::contexts::Calls;
use crate::program::names::{Context, Symbol};
use crate::program::script::{
    Builder, Call, Expr, Held, How, Instruction, Modal, Place, Remark, RemarkId, Script, Start,
    TableId, ValueId, Variable, VariableId, Written,
};
use crate::program::{External, ExternalNames, ExternalUse, Settings, Shape, TargetId};
use foldhash::{HashMap, HashMapExt, HashSet, HashSetExt};

/// Names of options.
#[derive(Debug, Default)]
pub(super) struct Words {
    pub wobj: Option<Symbol>,
    pub tool: Option<Symbol>,
    pub v: Option<Symbol>,
    pub t: Option<Symbol>,
    pub z: Option<Symbol>,
    pub tload: Option<Symbol>,
    pub id: Option<Symbol>,
    pub corr: Option<Symbol>,
    pub track: Option<Symbol>,
    pub noeoffs: Option<Symbol>,
    pub off: Option<Symbol>,
    pub wrist: Option<Symbol>,
    pub lock_axis_4: Option<Symbol>,
    pub path_frame: Option<Symbol>,
}

/// Puts a script together.
pub(super) struct Translator<'a> {
    pub resolved: &'a Resolved<'a>,
    /// What data that are no targets get, where a move needed that.
    pub origins: Option<Origins>,
    /// Where data are that are no targets.
    pub behind: HashMap<Asked, Vec<Expr>>,
    pub builder: Builder,
    /// Where the present statement stands.
    pub here: Place,
    pub context: Context,
    /// The present routine is open.
    is_open: bool,
    pub handlers: Handlers,
    /// Routines of whose errors handlers of their callers may hear.
    guarded: HashSet<u32>,
    /// The present statement is a function of another one.
    pub is_function: bool,
    pub words: Words,
    pub modes: Modes,
    pub actual: ValueId,
    pub wobj0: ValueId,
    pub variables: HashMap<(Entity, u32), VariableId>,
    pub records: HashMap<Entity, ValueId>,
    pub frame_elements: HashMap<(Entity, [u32; 3]), ValueId>,
    /// By whether a tool carries it and by its numbers.
    pub loads: HashMap<(bool, Option<[u64; 4]>), ValueId>,
    /// What the gripper carries.
    pub gripped: Option<VariableId>,
    pub lists: HashMap<Entity, (u32, u32)>,
    pub tables: HashMap<Entity, TableId>,
    /// The tables of what any element of large arrays has held, by array and by element.
    pub gathered: HashMap<Entity, TableId>,
    pub gathers: HashMap<VariableId, TableId>,
    pub remarks: HashMap<(&'static str, Symbol), RemarkId>,
    /// Which calls of routines say by what these displace.
    pub by_calls: Calls,
    /// What functions of the files give, by routine.
    pub results: HashMap<u32, VariableId>,
    /// What functions that the present statement calls give, where that is kept apart.
    pub kept_results: HashMap<u32, VariableId>,
    /// Whether optional parameters are given, by parameter.
    presences: HashMap<u32, VariableId>,
    /// What parameters are about which branches ask.
    pub(super) choices: HashMap<u32, VariableId>,
    /// Targets whose numbers no robot can use and that are written over.
    dead: HashSet<TargetId>,
    /// Names that the files do not declare and that moves use: what for.
    pub wanted: HashMap<Symbol, Type>,
    /// Variables that tasks share.
    pub shared: HashSet<VariableId>,
    /// Of each routine whether others move the robot while it writes.
    pub writes_meanwhile: Vec<bool>,
    /// What is written so.
    pub meanwhile: Vec<(Place, Written, How)>,
    /// Data of each routine's own that are written in it.
    own: HashMap<u32, Vec<u32>>,
    /// A name in the present expression is declared more than once.
    pub ambiguous: bool,
    /// There are positioners, which work objects may ride on.
    pub has_positioners: bool,
    pub external: &'a ExternalNames,
}

/// The script of what was noted. `dead` are targets that are written over and have no numbers of
/// their own.
pub(super) fn translate(
    resolved: &Resolved,
    script: Script,
    dead: HashSet<TargetId>,
    settings: &Settings,
) -> Script {
    let mut builder = Builder::default();
    builder.script = script;
    for (at, routine) in (0..).zip(&resolved.parsed.routines) {
        let name = resolved.spelling(routine.name);
        let start = if routine.is_trap {
            Start::Concurrent
        } else if resolved.is_main(at) {
            Start::Main
        } else {
            Start::Called
        };
        builder.declare(name, routine.place, start);
    }
    let find = |word: &[u8]| resolved.parsed.symbols.find(word);
    let units = switched(resolved, &settings.external);
    let modes = Modes::new(&mut builder.script, units);
    let script = &mut builder.script;
    let mut translator = Translator {
        resolved,
        origins: None,
        behind: HashMap::default(),
        here: Place::NOWHERE,
        context: Context {
            module: 0,
            routine: None,
        },
        is_open: false,
        handlers: Handlers::default(),
        guarded: resolved.guarded(),
        is_function: false,
        words: Words {
            wobj: find(b"wobj"),
            tool: find(b"tool"),
            v: find(b"v"),
            t: find(b"t"),
            z: find(b"z"),
            tload: find(b"tload"),
            id: find(b"id"),
            noeoffs: find(b"noeoffs"),
            corr: find(b"corr"),
            track: find(b"track"),
            off: find(b"off"),
            wrist: find(b"wrist"),
            lock_axis_4: find(b"lockaxis4"),
            path_frame: find(b"pathframe"),
        },
        modes,
        actual: script.value(Held::Actual),
        wobj0: script.frame("wobj0", Some(crate::geometry::Pose::identity())),
        variables: HashMap::new(),
        records: HashMap::new(),
        frame_elements: HashMap::new(),
        loads: HashMap::new(),
        gripped: None,
        lists: HashMap::new(),
        tables: HashMap::new(),
        gathered: HashMap::new(),
        gathers: HashMap::new(),
        remarks: HashMap::new(),
        by_calls: Calls::default(),
        results: HashMap::new(),
        kept_results: HashMap::new(),
        presences: HashMap::new(),
        choices: HashMap::new(),
        dead,
        wanted: HashMap::new(),
        shared: HashSet::new(),
        writes_meanwhile: resolved.written_meanwhile(),
        meanwhile: Vec::new(),
        own: HashMap::new(),
        ambiguous: false,
        has_positioners: !settings.external.units.is_empty(),
        external: &settings.external,
        builder,
    };
    translator.find_own();
    translator.find_wanted();
    translator.find_grips();
    translator.external_axes(&settings.external);
    for at in 0..resolved.parsed.statements.len() {
        translator.statement(at);
    }
    translator.close();
    translator.run_meanwhile();
    let by_calls = std::mem::take(&mut translator.by_calls);
    by_calls.hand_over(&resolved.given, &mut translator.builder.script);
    translator.builder.finish()
}

impl Translator<'_> {
    pub(super) fn place(&self, offset: u32) -> Place {
        Place::new(self.here.file, offset)
    }

    pub(super) fn say(&mut self, remark: Remark) {
        let sources = self.resolved.sources;
        self.builder.script.say(sources, self.here, remark);
    }

    pub(super) fn is_dead(&self, target: TargetId) -> bool {
        self.dead.contains(&target)
    }

    // ---- what statements become

    pub(super) fn emit_move(&mut self, instruction: Instruction, modal: Modal) {
        self.may_fail();
        self.builder.go(instruction, modal);
    }

    pub(super) fn emit_write(&mut self, place: Place, variable: Written, how: How) {
        self.may_fail();
        self.note_meanwhile(place, variable, &how);
        self.builder.write(place, variable, how);
        if let Written::One(element) = variable {
            self.gather(element);
        }
    }

    pub(super) fn emit_call(&mut self, call: Call) {
        self.may_fail();
        let given = call.arguments.clone();
        self.call_caught(call);
        for at in given {
            if let Some(element) = self.builder.script.arguments[at as usize].back {
                self.gather(element);
                let how = How::PartSomehow(self.changed());
                self.note_meanwhile(self.here, Written::One(element), &how);
            }
        }
    }

    /// Text begins that stands elsewhere.
    fn text(&mut self, at: usize, file: u32, context: Context) {
        self.close();
        self.here.file = file;
        self.context = context;
        let Some(routine) = context.routine else {
            return;
        };
        self.builder.open(routine);
        self.is_open = true;
        let of = &self.resolved.parsed.routines[routine as usize];
        if of.has_handler {
            self.handlers = self.handlers_of(at + 1);
        }
        self.handlers.is_guarded = self.guarded.contains(&routine);
        for datum in self.own.get(&routine).cloned().unwrap_or_default() {
            self.begin_own(datum);
        }
    }

    fn close(&mut self) {
        if self.is_open {
            self.end_handlers();
            self.builder.close();
        }
        self.handlers = Handlers::default();
        self.is_open = false;
    }

    fn statement(&mut self, at: usize) {
        let statement = self.resolved.parsed.statements[at];
        self.here.offset = statement.offset;
        if let StatementKind::Text { file, context } = statement.kind {
            self.text(at, file, context);
            return;
        }
        if self.handlers.is_skipping && !matches!(statement.kind, StatementKind::Handler(_)) {
            return;
        }
        if !self.is_open {
            // statements outside routines
            let routine = self.builder.declare("", self.here, Start::Called);
            self.builder.open(routine);
            self.is_open = true;
        }
        self.is_function = matches!(statement.kind, StatementKind::Function(_));
        let is_block = !matches!(
            statement.kind,
            StatementKind::Function(_)
                | StatementKind::Assign { .. }
                | StatementKind::Call(_)
                | StatementKind::Return(_)
        );
        if is_block {
            self.behind_functions();
        }
        match statement.kind {
            StatementKind::Text { .. } => {}
            StatementKind::Assign {
                name,
                index,
                component,
                value,
            } => self.assign(name, index, component, value),
            StatementKind::Call(call) => {
                self.call(call.callee, call.verb, call.arguments, call.end);
            }
            StatementKind::Function(function) => {
                let next = self.resolved.parsed.statements.get(at + 1);
                let is_last = !next.is_some_and(|n| matches!(n.kind, StatementKind::Function(_)));
                self.function(function, is_last);
            }
            StatementKind::If(asked) => {
                let tests = self.tests_of(asked);
                self.builder.begin_if(tests);
            }
            StatementKind::ElseIf(asked) => {
                let tests = self.tests_of(asked);
                self.builder.next_branch(true);
                self.builder.pass_branch(tests);
            }
            StatementKind::Case(asked) => {
                let numbers = asked.map_or(Vec::new(), |asked| self.cases(asked));
                self.builder.next_branch(true);
                self.builder.pass_cases(&numbers);
            }
            StatementKind::Else => self.builder.next_branch(true),
            StatementKind::Test(asked) => {
                let of = asked.and_then(|asked| self.tested(asked));
                self.builder.begin_switch(of);
            }
            StatementKind::EndChoice => self.builder.end_choice(),
            StatementKind::Loop { may_pass, most } => self.builder.begin_rounds(may_pass, most),
            StatementKind::EndLoop { endless } => self.builder.end_loop(endless),
            StatementKind::Leave => self.builder.leave_loop(),
            StatementKind::Label(name) => self.builder.label(u64::from(name.0)),
            StatementKind::Goto(name) => self.builder.go_to(u64::from(name.0)),
            StatementKind::Connect(trap) => self.connect(trap),
            StatementKind::Handler(_) => self.handler(),
            StatementKind::Retry { .. } => self.retry(),
            StatementKind::Raise => self.raise(),
            StatementKind::Return(value) => {
                self.give_back(value);
                self.builder.back();
            }
            StatementKind::Exit => self.builder.exit(),
        }
        if !self.is_function {
            self.kept_results.clear();
            self.behind_functions();
        }
    }

    /// The variable that holds whether an optional parameter is given of which its routine asks.
    pub(super) fn presence(&mut self, routine: u32, name: Symbol) -> Option<VariableId> {
        let resolved = self.resolved;
        if !resolved.parsed.asked.contains(&(routine, name)) {
            return None;
        }
        let (first, end) = resolved.parsed.routines[routine as usize].parameters;
        let datum = (first..end).find(|&datum| {
            let of = resolved.datum(datum);
            of.name == name && matches!(of.storage, Storage::Parameter { optional: true, .. })
        })?;
        if let Some(&known) = self.presences.get(&datum) {
            return Some(known);
        }
        let variable = self.builder.script.variable(Variable {
            routine: Some(routine),
            ..Variable::new(resolved.spelling(name), self.here, Expr::Absent)
        });
        self.presences.insert(datum, variable);
        Some(variable)
    }

    pub(super) fn set(&mut self, variable: VariableId, value: Expr) {
        let place = self.here;
        self.emit_write(place, Written::One(variable), How::Whole(value));
    }

    // ---- before the first statement

    /// Data of routines' own begin with what they are declared with each time.
    fn find_own(&mut self) {
        let resolved = self.resolved;
        for (at, datum) in (0..).zip(&resolved.parsed.data) {
            let matters = datum.kind.is_target() || datum.kind.is_frame();
            if let Some(routine) = datum.context.routine
                && matters
                && datum.storage == Storage::Variable
                && resolved.is_written(Entity::Declared(at))
            {
                self.own.entry(routine).or_default().push(at);
            }
        }
    }

    fn begin_own(&mut self, datum: u32) {
        if let Expr::Variable(variable) = self.held_by(datum) {
            let declared = self.builder.script.variables[variable as usize].declared;
            self.set(variable, declared);
        }
    }

    /// What the names are for that are written and not declared.
    fn find_wanted(&mut self) {
        let resolved = self.resolved;
        if !resolved.has_undeclared() {
            return;
        }
        for at in 0..resolved.parsed.statements.len() {
            match resolved.parsed.statements[at].kind {
                StatementKind::Text { file, context } => {
                    self.here.file = file;
                    self.context = context;
                }
                StatementKind::Call(call) => {
                    for (name, kind) in self.wants(call.callee, call.verb, call.arguments) {
                        if resolved.kind(name, self.context).is_none() {
                            self.wanted.entry(name).or_insert(kind);
                        }
                    }
                }
                _ => {}
            }
        }
    }

    /// External axes say where the robot or the work piece is carried: the profile knows what, or
    /// that they carry nothing.
    fn external_axes(&mut self, names: &ExternalNames) {
        let parsed = &self.resolved.parsed;
        let moving = parsed
            .external
            .iter()
            .fold(0, |axes, (_, axis, _)| axes | 1 << axis);
        let meanings = EXTERNAL.map(|name| names.meaning(name));
        let is_listed = |axis: usize| matches!(meanings[axis], ExternalUse::Listed(_));
        if moving == 0 && !(0..6).any(is_listed) {
            return;
        }
        let mut all: Vec<(TargetId, u8, f64)> = parsed.external.clone();
        for (target, zeros) in parsed.external_zeros.iter().enumerate() {
            for axis in 0..6_u8 {
                let listed = is_listed(usize::from(axis));
                let is_zero = zeros & 1 << axis != 0;
                if is_zero && (listed || moving & 1 << axis != 0) {
                    all.push((target, axis, 0.0));
                } else if listed {
                    // before the value that it may have: the last one counts
                    all.push((target, axis, f64::NAN));
                }
            }
        }
        all.sort_by(|a, b| {
            let key =
                |(target, axis, value): &(TargetId, u8, f64)| (*target, *axis, !value.is_nan());
            key(a).cmp(&key(b))
        });
        let mut known: HashMap<(u8, u64), RemarkId> = HashMap::new();
        let script = &mut self.builder.script;
        for (target, axis, value) in all {
            let name = EXTERNAL[usize::from(axis)];
            match meanings[usize::from(axis)] {
                ExternalUse::Listed(axis) => {
                    script.externals.push((target, External { axis, value }));
                    continue;
                }
                ExternalUse::Ignored => continue,
                ExternalUse::Unknown => {}
            }
            let found = &script.targets[target];
            if found.layout.shape == Shape::Joints {
                continue;
            }
            // an arm with seven joints has the seventh here, and data of its configuration that no
            // other has
            let numbers = &script.numbers[found.numbers.start as usize..found.numbers.end as usize];
            let seven = axis == 0 && numbers.last().is_some_and(|cfx| cfx.value >= 100.0);
            let remarks = &mut script.remarks;
            let key = (axis + 6 * u8::from(seven), value.to_bits());
            let remark = *known.entry(key).or_insert_with(|| {
                remarks.push(if seven {
                    Remark::error_about(
                        "seven-axis-arm",
                        format!(
                            "{name} is {value} and cfx has hundreds: it is the seventh joint \
                            of the arm"
                        ),
                        "only arms with six joints are compensated",
                    )
                } else {
                    Remark::external_unknown(name, value)
                });
                crate::program::script::short(remarks.len() - 1)
            });
            script.refused.push((target, remark));
        }
    }
}

//! What each move drives to, with which tool, in which work object.

use super::findings::{Cause, Report};
use super::names::{Context, Symbol};
use super::syntax::{
    Argument, Base, Element, Expression, Index, Part, Path, Place, Statement, StatementKind,
    Stored, Verb, indices,
};
use super::uses::{Used, Uses};
use super::world::{Points, World};
use crate::finding::Severity;
use crate::program::{
    Displacement, FrameId, Motion, Move, Pace, ReadError, Shift, TargetId, ToolId,
};
use std::collections::HashSet;

/// The most uses of elements of arrays with indices that only the running program knows.
const MOST_USES: usize = 500_000;

/// Resolves the moves of all files.
pub(super) struct Moves<'a> {
    pub world: &'a World,
    pub report: Report<'a>,
    uses: Uses<'a>,
    /// Uses of whole arrays that are listed.
    listed: HashSet<(u32, ToolId, FrameId, Motion, bool, [u64; 3])>,
    /// Parts of the elements that are blocked as a whole.
    blocked: HashSet<(Part, Cause)>,
    /// More uses than are listed.
    full: bool,
    conf_l: bool,
    conf_j: bool,
    routine: Option<Context>,
}

impl<'a> Moves<'a> {
    pub fn new(world: &'a World, report: Report<'a>) -> Self {
        Self {
            world,
            report,
            uses: Uses::new(world),
            listed: HashSet::new(),
            blocked: HashSet::new(),
            full: false,
            conf_l: true,
            conf_j: true,
            routine: None,
        }
    }

    /// Lists the moves of all statements, in their order.
    ///
    /// # Errors
    /// Where a tool or work object that is used has a number no robot can use.
    pub fn list(&mut self) -> Result<(), ReadError> {
        let displaced = self.world.displacements();
        for (at, &displaced) in displaced.iter().enumerate() {
            let statement = self.world.notes.statements[at];
            let StatementKind::Call {
                name,
                verb,
                arguments,
            } = statement.kind
            else {
                continue;
            };
            if self.routine != Some(statement.context) {
                self.routine = Some(statement.context);
                (self.conf_l, self.conf_j) = (true, true);
            }
            match verb {
                Verb::ConfL => self.conf_l = self.switch(arguments),
                Verb::ConfJ => self.conf_j = self.switch(arguments),
                Verb::GripLoad => self.grip_load(&statement, arguments),
                Verb::Move { path, .. } if !self.is_routine(name, statement.context) => {
                    self.instruction(at, &statement, verb, path, arguments, displaced)?;
                }
                Verb::Move { .. } | Verb::Other => {
                    self.call(at, &statement, name, arguments, displaced)?;
                }
                _ => {}
            }
        }
        Ok(())
    }

    fn is_routine(&self, name: Option<Symbol>, context: Context) -> bool {
        name.is_some_and(|name| self.world.is_routine(name, context))
    }

    /// `\On` or nothing is on, `\Off` is off.
    fn switch(&self, arguments: Part) -> bool {
        let off = self.world.notes.symbols.find(b"off");
        let all = &self.world.notes.arguments[indices(arguments)];
        !all.iter()
            .any(|argument| argument.option.is_some() && argument.option == off)
    }

    fn grip_load(&mut self, statement: &Statement, arguments: Part) {
        let load = self.world.plain_names(arguments).next();
        self.other_load(statement, load);
    }

    /// A load that is not that of the tool.
    fn other_load(&mut self, statement: &Statement, load: Option<Symbol>) {
        let symbols = &self.world.notes.symbols;
        if let Some(load) = load
            && Some(load) != symbols.find(b"load0")
        {
            let message = format!(
                "{} is carried here; its mass is not in the tool's load",
                symbols.spelling(load)
            );
            let hint = "where joints bend under load, give the profile a tool with this load";
            self.report
                .say("grip-load", Severity::Note, statement.place, message, hint);
        }
    }

    fn instruction(
        &mut self,
        at: usize,
        statement: &Statement,
        verb: Verb,
        path: Path,
        arguments: Part,
        displaced: Option<Place>,
    ) -> Result<(), ReadError> {
        let Some(parts) = self.world.parts(statement, verb, arguments) else {
            return Ok(());
        };
        if matches!(verb, Verb::Move { first: 2, .. }) {
            self.written_by_search(statement, arguments);
        }
        self.other_load(statement, parts.load);
        if parts.synchronised {
            let message = "this move runs together with one of another robot";
            let hint = "both robots' programs have to be compensated";
            self.report.say(
                "sync-move",
                Severity::Note,
                statement.place,
                message.into(),
                hint,
            );
        }
        let absolute = path == Path::Absolute;
        let tool = self
            .uses
            .tool(&mut self.report, at, statement, parts.tool)?;
        let frame = match parts.frame {
            Ok(_) if absolute => self.uses.frame(&mut self.report, at, statement, None)?,
            Ok(frame) => self.uses.frame(&mut self.report, at, statement, frame)?,
            Err(()) => Err((Cause::FrameChosen, statement.place, Symbol(0))),
        };
        let configured = match path {
            Path::Joint => self.conf_j,
            Path::Absolute => false,
            Path::Linear | Path::Arc => self.conf_l,
        };
        let displaced = displaced.filter(|_| !absolute);
        let targets = indices(parts.targets);
        for argument in targets.clone() {
            let argument_is = &self.world.notes.arguments[argument];
            // an option between the two targets of an arc
            if argument_is.option.is_some() {
                continue;
            }
            let expression = argument_is.expression;
            let motion = match path {
                Path::Joint | Path::Absolute => Motion::Joint,
                Path::Linear => Motion::Linear,
                Path::Arc if argument == targets.start => Motion::ArcVia,
                Path::Arc => Motion::ArcEnd,
            };
            let with = With {
                motion,
                tool: &tool,
                frame: &frame,
                configured,
                displaced,
                pace: parts.pace,
            };
            self.go(statement, expression, &with);
        }
        Ok(())
    }

    /// A search writes the point it found.
    fn written_by_search(&mut self, statement: &Statement, arguments: Part) {
        let found = self.world.notes.arguments[indices(arguments)]
            .iter()
            .filter(|argument| argument.option.is_none())
            .nth(1)
            .and_then(|argument| self.world.plain(argument));
        if let Some((name, index)) = found {
            self.block_name(
                statement.context,
                name,
                index,
                Cause::Assigned,
                statement.place,
            );
        }
    }

    /// Blocks every target that a name may lead to.
    pub fn block_name(
        &mut self,
        context: Context,
        name: Symbol,
        index: Index,
        cause: Cause,
        because: Place,
    ) {
        let elements = match self.world.points(name, index, context) {
            Points::Elements { elements, .. } => vec![elements],
            Points::Ambiguous(list) => self
                .world
                .several(list)
                .iter()
                .filter_map(|&datum| match self.world.datum(datum).value {
                    Stored::Elements { elements, .. } => Some(elements),
                    _ => None,
                })
                .collect(),
            _ => Vec::new(),
        };
        let what = self.world.notes.symbols.spelling(name);
        for part in elements {
            if !self.blocked.insert((part, cause)) {
                continue;
            }
            for target in self.world.own_targets(part) {
                self.report.block(target, cause, because, what);
            }
        }
    }

    /// A procedure call, or an instruction that is not known.
    fn call(
        &mut self,
        at: usize,
        statement: &Statement,
        name: Option<Symbol>,
        arguments: Part,
        displaced: Option<Place>,
    ) -> Result<(), ReadError> {
        let world = self.world;
        let all = &world.notes.arguments[indices(arguments)];
        let context = statement.context;
        if !all
            .iter()
            .any(|argument| self.leads_to_target(argument, context))
        {
            return Ok(());
        }
        let wobj = world.notes.symbols.find(b"wobj");
        let has_tool = all.iter().any(|argument| {
            (argument.option.is_some() && argument.option == wobj)
                || world
                    .plain(argument)
                    .is_some_and(|(name, _)| world.is_tool(name, context))
        });
        if has_tool && name.is_some() && !self.is_routine(name, context) {
            // an instruction of an option or of another cell: it moves like the ones we know
            let verb = Verb::Move {
                path: Path::Linear,
                first: 0,
                tool_inside: false,
            };
            return self.instruction(at, statement, verb, Path::Linear, arguments, displaced);
        }
        let callee = name.map_or("a late-bound call", |name| {
            world.notes.symbols.spelling(name)
        });
        for argument in all {
            match argument.expression {
                Expression::Point {
                    base: Base::Target(target),
                    ..
                } => self
                    .report
                    .block(target as usize, Cause::Passed, statement.place, callee),
                Expression::Point {
                    base: Base::Named { name, index },
                    ..
                } => {
                    let index = world.notes.index(index);
                    self.block_name(context, name, index, Cause::Passed, statement.place);
                }
                Expression::Computed(part) => {
                    for &name in &world.notes.mentions[indices(part)] {
                        let whole = Index::Whole;
                        self.block_name(context, name, whole, Cause::Passed, statement.place);
                    }
                }
                Expression::Nothing => {}
            }
        }
        Ok(())
    }

    fn leads_to_target(&self, argument: &Argument, context: Context) -> bool {
        let named = |name: Symbol| {
            matches!(
                self.world.points(name, Index::Whole, context),
                Points::Elements { .. } | Points::Ambiguous(_)
            )
        };
        match argument.expression {
            Expression::Point { base, .. } => match base {
                Base::Target(_) => true,
                Base::Named { name, .. } => named(name),
            },
            Expression::Computed(part) => self.world.notes.mentions[indices(part)]
                .iter()
                .any(|&name| named(name)),
            Expression::Nothing => false,
        }
    }

    /// Lists a move to what one argument says.
    fn go(&mut self, statement: &Statement, expression: Expression, with: &With) {
        match expression {
            Expression::Nothing => {}
            Expression::Point { base, steps } => {
                let displacement = self.world.displacement(steps, statement.context);
                match base {
                    Base::Target(target) => {
                        self.use_target(statement, target as usize, displacement, with);
                    }
                    Base::Named { name, index } => {
                        let index = self.world.notes.index(index);
                        self.use_name(statement, name, index, &displacement, with, true);
                    }
                }
            }
            Expression::Computed(part) => {
                let world = self.world;
                let mut any = false;
                for &name in &world.notes.mentions[indices(part)] {
                    let unknown = Displacement::Unknown;
                    any |= self.use_name(statement, name, Index::Whole, &unknown, with, false);
                }
                if !any {
                    self.not_written_out(statement, "a position");
                }
            }
        }
    }

    fn not_written_out(&mut self, statement: &Statement, what: &str) {
        self.report.say(
            "computed-target",
            Severity::Error,
            statement.place,
            format!(
                "{what} that this move goes to is known at run time only; it is not compensated"
            ),
            "",
        );
    }

    /// Lists a move to a name; whether it is a target. What is none is reported where it should be one.
    fn use_name(
        &mut self,
        statement: &Statement,
        name: Symbol,
        index: Index,
        displacement: &Displacement,
        with: &With,
        wanted: bool,
    ) -> bool {
        let world = self.world;
        let spelled = world.notes.symbols.spelling(name);
        match world.points(name, index, statement.context) {
            Points::Elements { datum, elements } => {
                if elements.1 - elements.0 > 1 {
                    if !self.first_use(datum, displacement, with) {
                        return true;
                    }
                    if self.report.program.moves.len() >= MOST_USES {
                        self.too_many(statement);
                        return true;
                    }
                }
                for element in indices(elements) {
                    match world.notes.elements[element] {
                        Element::Target(target) => {
                            self.use_target(statement, target, displacement.clone(), with);
                        }
                        Element::Named(other) => {
                            let declared = world.datum(datum);
                            let (context, because) = (declared.context, declared.place);
                            let whole = Index::Whole;
                            self.block_name(context, other, whole, Cause::Named, because);
                        }
                        Element::Computed => self.not_written_out(statement, spelled),
                    }
                }
                true
            }
            Points::Ambiguous(_) => {
                let cause = Cause::Ambiguous;
                self.block_name(statement.context, name, index, cause, statement.place);
                true
            }
            Points::Computed if wanted => {
                self.not_written_out(statement, spelled);
                false
            }
            Points::Unknown | Points::Other if wanted => {
                self.report.say(
                    "target-not-in-files",
                    Severity::Error,
                    statement.place,
                    format!("{spelled} is not declared in the files; this move is not compensated"),
                    "name the module that declares it, too",
                );
                false
            }
            _ => false,
        }
    }

    /// Whether an array was not used in this way before: one index that only the running program knows is like another.
    fn first_use(&mut self, datum: u32, displacement: &Displacement, with: &With) -> bool {
        let (tool, frame) = match (*with.tool, *with.frame) {
            (Ok(tool), Ok(frame)) => (tool, frame),
            (Err((cause, ..)), _) | (_, Err((cause, ..))) => {
                return self.blocked.insert(((datum, u32::MAX), cause));
            }
        };
        let by = match displacement {
            Displacement::None => [0; 3],
            Displacement::By(shift) if **shift == Shift::in_frame(shift.in_frame_m) => {
                shift.in_frame_m.map(f64::to_bits)
            }
            Displacement::By(_) => return true,
            Displacement::Unknown => [u64::MAX; 3],
        };
        self.listed
            .insert((datum, tool, frame, with.motion, with.configured, by))
    }

    fn too_many(&mut self, statement: &Statement) {
        if std::mem::replace(&mut self.full, true) {
            return;
        }
        self.report.say(
            "too-many-uses",
            Severity::Error,
            statement.place,
            format!("from here on moves to elements of arrays are not checked: there are more than {MOST_USES}"),
            "give fewer files in one call",
        );
    }

    fn use_target(
        &mut self,
        statement: &Statement,
        target: TargetId,
        displacement: Displacement,
        with: &With,
    ) {
        if let Some(because) = with.displaced {
            let what = "the displacement";
            self.report.block(target, Cause::Displaced, because, what);
        }
        let symbols = &self.world.notes.symbols;
        let mut ids = [0; 2];
        for (id, used) in ids.iter_mut().zip([with.tool, with.frame]) {
            match used {
                Ok(found) => *id = *found,
                Err((cause, because, name)) => {
                    let what = if cause == &Cause::FrameChosen {
                        "the move"
                    } else {
                        symbols.spelling(*name)
                    };
                    self.report.block(target, *cause, *because, what);
                }
            }
        }
        if let (Ok(tool), Ok(frame)) = (*with.tool, *with.frame) {
            self.report.program.moves.push(Move {
                file: statement.place.file,
                offset: statement.place.offset,
                motion: with.motion,
                target: Some(target),
                tool,
                frame,
                displacement,
                configured: with.configured,
                near: None,
                pace: with.pace,
                ..Move::default()
            });
        }
    }
}

/// How a move goes to all its targets.
struct With<'a> {
    motion: Motion,
    tool: &'a Used<ToolId>,
    frame: &'a Used<FrameId>,
    configured: bool,
    displaced: Option<Place>,
    pace: Pace,
}

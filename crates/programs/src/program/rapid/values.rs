//! Names and expressions as values: targets, tools, work objects, and the variables that hold them.

use super::builtins::Known;
use super::elements::element_name;
use super::records::{ASSIGNED, load_of, part_of};
use super::resolved::Entity;
use super::syntax::{
    Amount, Argument, Base, Expression, Index, Part, Step, Storage, Stored, Type, indices,
};
use super::translate::Translator;
use crate::finding::Severity;
use crate::geometry::units::{DEG, MM};
use crate::program::displacing::Displacing;
use crate::program::kit;
use crate::program::names::{Context, Meaning, Symbol};
use crate::program::quantity::Quantity;
use crate::program::script::{
    DISPLACED_SOMEHOW, Expr, Held, OVERWRITTEN, Place, Remark, RemarkId, UNBOUNDED, Variable,
    VariableId, short,
};
use crate::program::transformations::Of;

/// Copies of copies of a target that are followed.
pub(super) const DEEPEST: u32 = 8;

/// What is said of a position that the files do not tell.
pub(super) const AT_RUN_TIME: &str = "write the position with numbers where it must be exact";

impl Translator<'_> {
    // ---- remarks

    /// A remark about a name, the same for every use of it.
    pub(super) fn remark(&mut self, name: Symbol, make: impl FnOnce(&str) -> Remark) -> RemarkId {
        let remark = make(self.resolved.spelling(name));
        let key = (remark.id, name);
        if let Some(&known) = self.remarks.get(&key) {
            return known;
        }
        let remarks = &mut self.builder.script.remarks;
        remarks.push(remark);
        let id = short(remarks.len() - 1);
        self.remarks.insert(key, id);
        id
    }

    /// A position that only the running program knows.
    pub(super) fn computed(&mut self) -> Expr {
        Expr::Unknown(
            self.builder
                .script
                .remark(kit::computed("computed-target", AT_RUN_TIME)),
        )
    }

    pub(super) fn computed_name(&mut self, name: Symbol) -> Expr {
        Expr::Unknown(self.remark(name, |name| {
            Remark::warning_about(
                "computed-target",
                format!(
                    "{name}, where this move goes to, is known at run time only; the move \
                stays as it is"
                ),
                AT_RUN_TIME,
            )
        }))
    }

    /// A constant that marks what is not set.
    pub(super) fn blank_constant(&mut self, name: Symbol) -> Expr {
        Expr::Unknown(self.remark(name, |name| {
            Remark::error_about(
                "target-uninitialised",
                format!("{name}, where this move goes to, is a constant without a position"),
                "move to a target with numbers",
            )
        }))
    }

    pub(super) fn not_in_files(&mut self, name: Symbol, wanted: Type) -> Expr {
        let (id, severity) = match wanted {
            Type::Jointtarget => ("joint-target-not-in-files", Severity::Note),
            _ => ("target-not-in-files", Severity::Error),
        };
        Expr::Unknown(self.remark(name, |name| Remark {
            id,
            severity,
            text:
                format!("{name} is not declared in the files; this move is not compensated").into(),
            hint: "name the module that declares it, too",
        }))
    }

    fn frame_refused(&mut self, remark: Remark) -> Expr {
        self.builder.script.unknown(remark)
    }

    pub(super) fn frame_chosen(&mut self) -> Expr {
        self.frame_refused(Remark::error(
            "frame-chosen-at-run-time",
            "only the running program knows the tool or work object",
            "name the tool and the work object in the move",
        ))
    }

    pub(super) fn frame_assigned(&mut self) -> Expr {
        self.frame_refused(ASSIGNED)
    }

    // ---- targets

    /// The position that a name with an index means.
    pub(super) fn position(&mut self, name: Symbol, index: Index, wanted: Type) -> Expr {
        self.position_in(name, index, wanted, self.context, 0)
    }

    pub(super) fn position_in(
        &mut self,
        name: Symbol,
        index: Index,
        wanted: Type,
        context: Context,
        depth: u32,
    ) -> Expr {
        match self.resolved.meaning(name, context) {
            Meaning::Nothing if self.resolved.is_written(Entity::Undeclared(name)) => {
                let declared = self.not_in_files(name, wanted);
                self.without_value(Entity::Undeclared(name), index, declared)
            }
            Meaning::Nothing => self.not_in_files(name, wanted),
            Meaning::One(datum) => self.position_of(datum, index, wanted, depth),
            Meaning::Several(list) => {
                let resolved = self.resolved;
                let all: Vec<Expr> = resolved
                    .several(list)
                    .iter()
                    .filter(|&&datum| resolved.datum(datum).kind.is_target())
                    .map(|&datum| self.position_of(datum, index, wanted, depth))
                    .collect();
                if all.is_empty() {
                    return self.not_in_files(name, wanted);
                }
                self.ambiguous |= !resolved.are_alike(list);
                self.builder.script.any(all)
            }
        }
    }

    /// The position that a declaration with an index means.
    pub(super) fn position_of_datum(&mut self, datum: u32, index: Index) -> Expr {
        let wanted = self.resolved.datum(datum).kind;
        self.position_of(datum, index, wanted, 0)
    }

    /// What a name is taken for that the files do not declare.
    pub(super) fn undeclared(&mut self, name: Symbol) -> Expr {
        match self.wanted.get(&name) {
            Some(Type::Tooldata | Type::Wobjdata) => self.record(Entity::Undeclared(name)),
            Some(&wanted) => self.not_in_files(name, wanted),
            None => self.not_in_files(name, Type::Robtarget),
        }
    }

    /// The position that a move goes to, from an expression in its own text.
    pub(super) fn position_of_move(&mut self, expression: Expression, wanted: Type) -> Expr {
        if let Some(unknown) = self.axes_of_move(&expression) {
            return unknown;
        }
        match expression {
            Expression::Composed(composed) => self.composed(composed),
            Expression::List(_) => self.near_or_computed(&expression),
            _ => self.position_from(expression, wanted),
        }
    }

    /// A target some of whose parts are expressions.
    fn composed(&mut self, composed: u32) -> Expr {
        if let Some(known) = self.other_place(composed) {
            return known;
        }
        let value = Expression::Composed(composed);
        self.somewhere_near(&value).unwrap_or_else(|| {
            self.builder.script.unknown(Remark::warning(
                "target-has-expressions",
                "parts of the target that this move goes to are expressions, not numbers; it \
                    stays as it is",
                "write the target with numbers in the offline system",
            ))
        })
    }

    /// A position that is worked out from targets; `None` where it names none. Coordinates that come
    /// from none of them do not know of a correction.
    fn somewhere_near(&mut self, value: &Expression) -> Option<Expr> {
        let resolved = self.resolved;
        let by = if resolved.has_own_place(value, self.context) {
            OVERWRITTEN
        } else {
            UNBOUNDED
        };
        let mut all = Vec::new();
        for &name in resolved.parsed.names_in(value) {
            let kind = resolved.kind(name, self.context);
            if kind.is_some_and(Type::is_target) {
                let base = self.position(name, Index::Whole, Type::Robtarget);
                all.push(self.builder.script.displaced(base, by));
            } else {
                all.extend(self.at_targets_behind(name, None));
            }
        }
        (!all.is_empty()).then(|| self.builder.script.any(all))
    }

    /// The position that an expression gives.
    pub(super) fn position_from(&mut self, expression: Expression, wanted: Type) -> Expr {
        match expression {
            Expression::Nothing | Expression::Text(..) | Expression::Load(_) => self.computed(),
            Expression::Point { base, steps } => {
                let base = match base {
                    Base::Named { name, index } => {
                        let index = self.resolved.parsed.index(index);
                        self.position(name, index, wanted)
                    }
                    Base::Target(target) => Expr::Target(target as usize),
                    Base::Function(function) => self.given_by(function, wanted),
                };
                self.stepped(base, steps)
            }
            Expression::Member { name, .. } => {
                let own = self.computed_name(name);
                self.at_member(name, None, own)
            }
            Expression::Composed(composed) => self.composed_apart(composed),
            Expression::List(composed) => self
                .with_other_axes(composed)
                .unwrap_or_else(|| self.near_or_computed(&expression)),
            Expression::Computed(_) => self.near_or_computed(&expression),
        }
    }

    /// As [`Self::composed`], where it does not stand in a move itself.
    pub(super) fn composed_apart(&mut self, composed: u32) -> Expr {
        self.with_other_axes(composed)
            .unwrap_or_else(|| self.composed(composed))
    }

    fn near_or_computed(&mut self, expression: &Expression) -> Expr {
        self.somewhere_near(expression)
            .unwrap_or_else(|| self.computed())
    }

    /// The position that a function gives.
    fn given_by(&mut self, function: u32, wanted: Type) -> Expr {
        let called = self.resolved.parsed.functions[function as usize];
        if self.resolved.known(&called, self.context) != Known::Actual {
            return match self.result_of(function) {
                Some(result) => Expr::Variable(result),
                None => self.computed(),
            };
        }
        let resolved = self.resolved;
        let given = &resolved.parsed.given[indices(called.arguments)];
        if given
            .iter()
            .any(|argument| self.is_constant_joints(argument))
        {
            return self.builder.script.unknown(Remark::warning(
                "computed-target",
                "the position that this move goes to is that of joints in the text, as the \
                       controller computes it: without a correction; the move stays as it is",
                AT_RUN_TIME,
            ));
        }
        let mut near = Vec::new();
        for argument in given {
            let Some(name) = super::resolved::named(&argument.expression) else {
                continue;
            };
            match resolved.kind(name, self.context) {
                Some(Type::Robtarget) if wanted == Type::Robtarget => {
                    let base = self.position(name, Index::Whole, wanted);
                    near.push(self.builder.script.displaced(base, DISPLACED_SOMEHOW));
                }
                // joints for a position: they follow what is written for it
                Some(Type::Robtarget) => return self.computed(),
                _ => {}
            }
        }
        if !near.is_empty() {
            return self.builder.script.any(near);
        }
        let own = given.iter().find(|argument| argument.option.is_none());
        let is_of_robot = own.is_some_and(|of| resolved.is_of_robot(&of.expression, self.context));
        if resolved.converts(called.name) && !is_of_robot {
            return self.computed();
        }
        if wanted == Type::Jointtarget {
            return Expr::Value(self.actual);
        }
        let option = |word: Option<Symbol>| {
            let mut all = given.iter();
            all.find(|of| of.option.is_some() && of.option == word)
        };
        let frame = option(self.words.wobj);
        let tool = option(self.words.tool).or_else(|| given.iter().find(|of| self.is_tool(of)));
        let is_of_joints = resolved
            .spelling(called.name)
            .eq_ignore_ascii_case("calcrobt");
        let tool = tool.map_or(Expr::Absent, |of| self.frame_from(of.expression));
        let frame = match frame {
            Some(of) => self.frame_from(of.expression),
            None if is_of_joints => Expr::Value(self.wobj0),
            None => Expr::Absent,
        };
        self.builder.script.held(Held::ActualWith { tool, frame })
    }

    /// Whether an argument of `CalcRobT` is joints that nothing writes, or that are written out.
    fn is_constant_joints(&self, argument: &Argument) -> bool {
        if argument.option.is_some() {
            return false;
        }
        if let Expression::Computed((from, to)) = argument.expression {
            return from == to;
        }
        let name = super::resolved::named(&argument.expression);
        let meaning = name.map(|name| self.resolved.meaning(name, self.context));
        let Some(Meaning::One(datum)) = meaning else {
            return false;
        };
        let of = self.resolved.datum(datum);
        let is_parameter = matches!(of.storage, Storage::Parameter { .. });
        of.kind == Type::Jointtarget
            && !is_parameter
            && !self.resolved.is_written(Entity::Declared(datum))
    }

    // ---- tools and work objects

    /// The tool or work object that an expression gives.
    pub(super) fn frame_from(&mut self, expression: Expression) -> Expr {
        match expression {
            Expression::Point {
                base: Base::Named { name, index },
                steps: (a, b),
            } if a == b => {
                let index = self.resolved.parsed.index(index);
                self.frame(name, index)
            }
            Expression::Point {
                base: Base::Function(function),
                steps: (a, b),
            } if a == b => match self.result_of(function) {
                Some(result) => Expr::Variable(result),
                None => self.frame_chosen(),
            },
            _ => self.frame_chosen(),
        }
    }

    /// The tool or work object that a name with an index means.
    pub(super) fn frame(&mut self, name: Symbol, index: Index) -> Expr {
        let entity = match self.resolved.meaning(name, self.context) {
            Meaning::One(datum) => Entity::Declared(datum),
            Meaning::Nothing => Entity::Undeclared(name),
            Meaning::Several(_) => {
                return self.frame_refused(Remark::error(
                    "frame-name-ambiguous",
                    "the tool or work object is declared more than once",
                    "pass only the modules of one task, or make the data LOCAL",
                ));
            }
        };
        let is_written = self.resolved.is_written(entity);
        match index {
            Index::Variable if !is_written => self.frame_of_row(entity, name),
            Index::Variable => self.frame_chosen(),
            Index::At(_) if is_written => self.frame_assigned(),
            Index::At(place) => self.frame_element(entity, name, place),
            Index::Whole => self.whole_frame(entity),
        }
    }

    /// What data hold that are a target, a tool or a work object.
    pub(super) fn held_by(&mut self, datum: u32) -> Expr {
        if self.resolved.datum(datum).kind.is_target() {
            self.position_of_datum(datum, Index::Whole)
        } else {
            self.whole_frame(Entity::Declared(datum))
        }
    }

    fn whole_frame(&mut self, entity: Entity) -> Expr {
        if let Entity::Declared(datum) = entity
            && matches!(
                self.resolved.datum(datum).storage,
                Storage::Parameter { .. }
            )
        {
            let chosen = self.frame_chosen();
            return Expr::Variable(self.variable(entity, 0, chosen));
        }
        let is_written = self.resolved.is_written(entity);
        if let Entity::Undeclared(name) = entity
            && !is_written
            && self.resolved.spelling(name).eq_ignore_ascii_case("wobj0")
        {
            return Expr::Value(self.wobj0);
        }
        let declared = self.record(entity);
        if is_written {
            return Expr::Variable(self.variable(entity, 0, declared));
        }
        declared
    }

    /// One of the elements of an array of tools or work objects that is written out.
    fn frame_of_row(&mut self, entity: Entity, name: Symbol) -> Expr {
        let count = match entity {
            Entity::Declared(datum) => match self.resolved.datum(datum).value {
                Stored::Row { count, .. } => count,
                _ => 0,
            },
            Entity::Undeclared(_) => 0,
        };
        if !(1..=MOST_FRAMES).contains(&count) {
            return self.frame_chosen();
        }
        let all: Vec<Expr> = (1..=count)
            .map(|at| self.frame_element(entity, name, [at, 0, 0]))
            .collect();
        self.builder.script.any(all)
    }

    /// An element of an array of tools or work objects.
    fn frame_element(&mut self, entity: Entity, name: Symbol, place: [u32; 3]) -> Expr {
        if let Some(&known) = self.frame_elements.get(&(entity, place)) {
            return Expr::Value(known);
        }
        let name = element_name(self.resolved.spelling(name), place);
        let parts = if let Entity::Declared(datum) = entity
            && let datum = *self.resolved.datum(datum)
            && let Some(leaves) = of_row(datum.value, place)
        {
            self.record_parts(leaves, datum.place)
        } else {
            0..0
        };
        let value = Held::Record {
            name: name.into(),
            parts,
            on: Box::default(),
        };
        let value = self.builder.script.value(value);
        self.frame_elements.insert((entity, place), value);
        Expr::Value(value)
    }

    /// A tool or work object as it is declared.
    fn record(&mut self, entity: Entity) -> Expr {
        if let Some(&known) = self.records.get(&entity) {
            return Expr::Value(known);
        }
        let (name, place, leaves) = match entity {
            Entity::Undeclared(name) => (name, self.place(0), Stored::Nothing),
            Entity::Declared(datum) => {
                let datum = self.resolved.datum(datum);
                (datum.name, datum.place, datum.value)
            }
        };
        let parts = match leaves {
            Stored::Leaves(leaves) => self.record_parts(leaves, place),
            Stored::Computed | Stored::Row { .. } => {
                let computed = part_of(super::aggregate::Leaf::Computed, place);
                self.add_parts(vec![computed; super::aggregate::MOST])
            }
            _ => 0..0,
        };
        let name = self.resolved.spelling(name).into();
        let value = self.builder.script.value(Held::Record {
            name,
            parts,
            on: Box::default(),
        });
        self.records.insert(entity, value);
        Expr::Value(value)
    }

    /// Leaves as parts of records.
    pub(super) fn record_parts(&mut self, leaves: Part, place: Place) -> std::ops::Range<u32> {
        let leaves = &self.resolved.parsed.leaves[indices(leaves)];
        let parts = leaves.iter().map(|&leaf| part_of(leaf, place)).collect();
        self.add_parts(parts)
    }

    pub(super) fn add_parts(
        &mut self,
        parts: Vec<crate::program::script::Part>,
    ) -> std::ops::Range<u32> {
        let all = &mut self.builder.script.parts;
        let start = short(all.len());
        all.extend(parts);
        start..short(all.len())
    }

    /// The load of a name that nothing writes, where its numbers are in the files.
    pub(super) fn load(&self, name: Symbol) -> Option<crate::program::Load> {
        let Meaning::One(datum) = self.resolved.meaning(name, self.context) else {
            return None;
        };
        let Stored::Leaves(leaves) = self.resolved.datum(datum).value else {
            return None;
        };
        let is_load = self.resolved.datum(datum).kind == Type::Loaddata;
        let fixed = is_load && !self.resolved.is_written(Entity::Declared(datum));
        fixed.then(|| load_of(&self.resolved.parsed.leaves[indices(leaves)]))?
    }

    // ---- variables

    /// The variable of data, or of an element of it; `holds` is what it is declared with.
    pub(super) fn variable(&mut self, entity: Entity, element: u32, holds: Expr) -> VariableId {
        if let Some(&known) = self.variables.get(&(entity, element)) {
            return known;
        }
        let script = &mut self.builder.script;
        let variable = match entity {
            Entity::Declared(datum) => {
                let datum = self.resolved.datum(datum);
                let name = match holds {
                    Expr::Target(target) => script.targets[target].name.clone(),
                    _ => None,
                };
                Variable {
                    // VAR data of a module begin anew only where the program does
                    kept: datum.context.routine.is_none(),
                    routine: datum.context.routine,
                    ..Variable::new(
                        name.unwrap_or_else(|| self.resolved.spelling(datum.name).into()),
                        datum.place,
                        holds,
                    )
                }
            }
            Entity::Undeclared(name) => Variable {
                kept: true,
                ..Variable::new(self.resolved.spelling(name), self.here, holds)
            },
        };
        let made = script.variable(variable);
        if self.resolved.is_shared(entity) {
            self.shared.insert(made);
        }
        self.variables.insert((entity, element), made);
        made
    }

    // ---- displacements

    /// A position with these steps added; Offs shifts in the work object and `RelTool` in the tool,
    /// so their order among each other does not matter.
    fn stepped(&mut self, base: Expr, steps: Part) -> Expr {
        if steps.0 == steps.1 {
            return base;
        }
        let (here, context) = (self.here, self.context);
        let steps = &self.resolved.parsed.steps[indices(steps)];
        let by = (self.resolved).varied(here, context, &mut |of| self.displacing(steps, of));
        let script = &mut self.builder.script;
        let Some(routine) = context.routine else {
            let by = script.displacement(by.all.displacement());
            return script.displaced(base, by);
        };
        (self.by_calls).displaced(base, by, routine, script)
    }

    fn displacing(&self, steps: &[Step], of: &mut Of) -> Displacing {
        let mut by = Displacing::new();
        let mut frame_mm = [0.0; 3].map(Quantity::exactly);
        for step in steps {
            match step {
                Step::Offs(amounts) => {
                    for (sum, amount) in frame_mm.iter_mut().zip(self.amounts(amounts, of)) {
                        *sum = sum.clone().plus(amount);
                    }
                }
                Step::RelTool(amounts) => {
                    let [x, y, z, rx, ry, rz] = self.amounts(amounts, of);
                    let [x, y, z] = [x, y, z].map(|mm| mm.in_unit(MM));
                    let [rx, ry, rz] = [rx, ry, rz].map(|degrees| degrees.in_unit(DEG));
                    by.in_tool(&[x, y, z, rx, ry, rz]);
                }
            }
        }
        by.along_frame(&frame_mm.map(|mm| mm.in_unit(MM)));
        by
    }

    fn amounts<const N: usize>(&self, amounts: &[Amount; N], of: &mut Of) -> [Quantity; N] {
        amounts.map(|amount| match amount {
            Amount::Number(number) => Quantity::exactly(number),
            Amount::Text(start, end) => {
                let here = Place {
                    file: self.here.file,
                    offset: start,
                };
                let bytes = &self.resolved.sources[here.file as usize].bytes;
                let text = &bytes[start as usize..end as usize];
                self.resolved.quantity_of(text, here, self.context, of)
            }
        })
    }
}

/// Tools or work objects that a move keeps apart.
const MOST_FRAMES: u32 = 4;

/// The leaves of a tool or frame in a row.
fn of_row(value: Stored, place: [u32; 3]) -> Option<Part> {
    let Stored::Row { leaves, count } = value else {
        return None;
    };
    let (1.., [at, 0, 0]) = (place[0], place) else {
        return None;
    };
    let each = (leaves.1 - leaves.0) / count;
    let first = leaves.0 + (at - 1) * each;
    (at <= count).then_some((first, first + each))
}

//! Which variable a name means, and whether its value is one that the text tells.
//!
//! A `global` is one in the whole file, a `local` and what a function alone assigns belong to that
//! function; what one around it assigns too is one variable, which the inner one may leave as it is.

use super::syntax::{
    Assignment, At, Called, Event, Expr, ExprId, FunctionId, LiteralId, Parsed, Reach, Symbol,
};
use super::verbs;
use crate::geometry::Pose;
use crate::program::quantity::is_letter;
use crate::program::script::short;
use foldhash::{HashMap, HashMapExt, HashSet, HashSetExt};
use std::collections::BTreeMap;

/// Names that stand for each other in turn, and calls inside each other, that are followed.
pub(super) const MOST_STEPS: u32 = 12;
/// Functions of one name that are distinguished: a program has one.
const MOST_OF_A_NAME: usize = 4;
/// No source follows.
const NONE: u32 = u32::MAX;

/// Index in [`Variables::list`].
pub(super) type VarId = u32;

/// How a variable gets a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Assigned {
    /// `x = …`
    Whole,
    /// `x[i] = …`, `x.a = …`
    Part(At),
    /// `x[i][j] = …`
    Deep,
    /// By a call, or as the result of a function.
    Given,
}

impl Assigned {
    /// Something else of the variable stays.
    pub(super) fn is_part(self) -> bool {
        matches!(self, Self::Part(_) | Self::Deep)
    }
}

/// One of the values that a variable gets.
#[derive(Clone, Copy, Debug)]
pub(super) struct Source {
    pub value: ExprId,
    /// In which the names of the value are looked up.
    pub function: FunctionId,
    pub way: Assigned,
    next: u32,
}

/// A variable, a parameter, or what a function returns.
#[derive(Clone, Debug)]
pub(super) struct Variable {
    pub name: Symbol,
    pub offset: u32,
    /// The function whose parameter it is.
    pub parameter: Option<FunctionId>,
    /// Some of its elements are assigned.
    pub has_parts: bool,
    /// It has one value, which the text tells: whoever names it means that.
    pub is_fixed: bool,
    /// Moves go to it; it is a feature or tool.
    pub is_position: bool,
    pub is_frame: bool,
    /// The positions that it has may stand in features, or be computed with tools of their own.
    pub in_features: bool,
    pub with_tools: bool,
    first: u32,
    last: u32,
}

/// Why a pose is not constant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum NotConstant {
    /// A variable has more than one value; it is the whole pose.
    Changing(VarId),
    /// This name is assigned nowhere; it is the whole pose.
    Unknown(Symbol),
    /// Its rotation vector is longer than any that is meant.
    Endless(f64),
    /// Anything else.
    Computed,
}

/// The variables of a file.
#[derive(Debug)]
pub(super) struct Variables<'n, 'a> {
    pub parsed: &'n Parsed<'a>,
    pub list: Vec<Variable>,
    sources: Vec<Source>,
    /// The variable of each assignment.
    pub assigned: Vec<VarId>,
    names: HashMap<(FunctionId, Symbol), VarId>,
    /// What functions return.
    results: HashMap<FunctionId, VarId>,
    /// Of each file, and by 0 those that any file may call.
    functions: HashMap<(FunctionId, Symbol), Vec<FunctionId>>,
    /// The tool is set somewhere: a position whose joints are computed keeps the one of that
    /// place.
    pub sets_tool: bool,
    /// Variables in whose assignments others are named, with those.
    pub(super) mentioned: HashMap<VarId, Vec<VarId>>,
    /// The same of assignments of elements, each by its place.
    pub(super) mentioned_in_parts: HashMap<u32, Vec<VarId>>,
    /// What is assigned to numbers.
    pub(super) numbers: crate::program::numbers::Numbers<super::numbers::Written>,
    /// Literals that moves go to: their numbers change, so nothing that holds them is constant.
    pub targets: Vec<bool>,
    /// Literals of features that targets stand in.
    pub(super) features: HashSet<LiteralId>,
    /// Parameters about which branches ask, and that only calls give a value.
    pub(super) asked: HashSet<VarId>,
}

impl<'n, 'a> Variables<'n, 'a> {
    pub(super) fn new(parsed: &'n Parsed<'a>) -> Self {
        let mut functions: HashMap<(FunctionId, Symbol), Vec<FunctionId>> = HashMap::new();
        for (at, function) in parsed.functions.iter().enumerate() {
            let Some(name) = function.name else { continue };
            let of_any = function.unit != 0 && function.parent == function.unit;
            for unit in [Some(function.unit), of_any.then_some(0)]
                .into_iter()
                .flatten()
            {
                functions.entry((unit, name)).or_default().push(short(at));
            }
        }
        functions.retain(|_, all| all.len() <= MOST_OF_A_NAME);
        let mut variables = Self {
            parsed,
            list: Vec::new(),
            sources: Vec::new(),
            assigned: Vec::new(),
            names: HashMap::new(),
            results: HashMap::new(),
            functions,
            sets_tool: false,
            mentioned: HashMap::new(),
            mentioned_in_parts: HashMap::new(),
            numbers: crate::program::numbers::Numbers::default(),
            targets: vec![false; parsed.literals.len()],
            features: HashSet::default(),
            asked: HashSet::default(),
        };
        variables.declare_parameters();
        variables.assign();
        variables.bind();
        variables.fix();
        variables.find_asked();
        variables.find_mentions();
        variables.find_numbers();
        variables.find_targets();
        variables.find_frames();
        variables
    }

    // ---- names

    fn add(&mut self, name: Symbol, offset: u32, parameter: Option<FunctionId>) -> VarId {
        self.list.push(Variable {
            name,
            offset,
            parameter,
            has_parts: false,
            is_fixed: false,
            is_position: false,
            is_frame: false,
            in_features: false,
            with_tools: false,
            first: NONE,
            last: NONE,
        });
        short(self.list.len() - 1)
    }

    fn source(&mut self, variable: VarId, value: ExprId, function: FunctionId, way: Assigned) {
        let at = short(self.sources.len());
        self.sources.push(Source {
            value,
            function,
            way,
            next: NONE,
        });
        let of = &mut self.list[variable as usize];
        of.has_parts |= way.is_part();
        if of.first == NONE {
            of.first = at;
        } else {
            self.sources[of.last as usize].next = at;
        }
        of.last = at;
    }

    /// The values that a variable gets.
    pub(super) fn sources(&self, variable: VarId) -> impl Iterator<Item = Source> + '_ {
        let mut at = self.list[variable as usize].first;
        std::iter::from_fn(move || {
            let source = *self.sources.get(at as usize)?;
            at = source.next;
            Some(source)
        })
    }

    /// The function that a variable belongs to alone: no function in it assigns it.
    pub(super) fn routine_of(&self, variable: VarId) -> Option<FunctionId> {
        let of = &self.list[variable as usize];
        if of.parameter.is_some() {
            return of.parameter;
        }
        let mut owners = self.sources(variable).filter(|s| s.way != Assigned::Given);
        let first = owners.next()?.function;
        let is_own = self.names.get(&(first, of.name)) == Some(&variable);
        (first != 0 && is_own && owners.all(|s| s.function == first)).then_some(first)
    }

    fn declare_parameters(&mut self) {
        for (at, function) in self.parsed.functions.iter().enumerate() {
            let at = short(at);
            for &(name, _) in &function.parameters {
                let variable = self.add(name, function.offset, Some(at));
                self.names.insert((at, name), variable);
            }
        }
    }

    fn assign(&mut self) {
        let parsed = self.parsed;
        let global = |a: &&Assignment| {
            a.reach == Reach::Global || (a.function == 0 && a.reach == Reach::Plain)
        };
        let all = &parsed.assignments;
        let globals: HashSet<Symbol> = all.iter().filter(global).map(|a| a.name).collect();
        let plain: HashSet<(FunctionId, Symbol)> = all
            .iter()
            .filter(|a| a.reach != Reach::Global)
            .map(|a| (a.function, a.name))
            .collect();
        let hiding = self.hiding(&globals, &plain);
        let own_local = |(number, a): (u32, &Assignment)| {
            let is_own = a.reach == Reach::Local && !hiding.contains(&number);
            is_own.then_some((a.function, a.name))
        };
        let locals: HashSet<_> = (0..).zip(all).filter_map(own_local).collect();
        for assignment in all {
            let name = assignment.name;
            let mut owner = assignment.function;
            let parameter =
                self.names.get(&(owner, name)).copied().filter(|known| {
                    self.list[*known as usize].parameter == Some(assignment.function)
                });
            let is_global = assignment.reach == Reach::Global;
            if is_global && let Some(parameter) = parameter {
                // which of both the function then names is not known
                self.source(parameter, assignment.value, owner, Assigned::Whole);
            }
            // behind `local`, the name means that variable
            let is_own = !is_global && locals.contains(&(owner, name));
            if !is_own && (is_global || parameter.is_none()) {
                if globals.contains(&name) {
                    owner = 0;
                }
                let mut around = owner;
                while around != 0 {
                    around = parsed.functions[around as usize].parent;
                    if plain.contains(&(around, name)) {
                        owner = around;
                    }
                }
            }
            let variable = if let Some(known) = self.names.get(&(owner, name)) {
                *known
            } else {
                let made = self.add(name, assignment.offset, None);
                self.names.insert((owner, name), made);
                made
            };
            let way = match assignment {
                Assignment { deep: true, .. } => Assigned::Deep,
                Assignment {
                    part: true,
                    element,
                    ..
                } => Assigned::Part(*element),
                _ => Assigned::Whole,
            };
            self.source(variable, assignment.value, assignment.function, way);
            self.assigned.push(variable);
        }
    }

    /// Assignments of `local` variables that may not be all that their names mean in the function,
    /// where one around it has a variable of the name: it is named before them, or they stand in a
    /// branch or loop.
    fn hiding(
        &self,
        globals: &HashSet<Symbol>,
        plain: &HashSet<(FunctionId, Symbol)>,
    ) -> HashSet<u32> {
        let parsed = self.parsed;
        let is_around = |assignment: &Assignment| {
            let mut around = assignment.function;
            globals.contains(&assignment.name) || {
                std::iter::from_fn(|| {
                    around = parsed.functions.get(around as usize)?.parent;
                    (around != 0).then_some(around)
                })
                .any(|around| plain.contains(&(around, assignment.name)))
            }
        };
        let all = (0..).zip(&parsed.assignments);
        let hiding = all.filter(|(_, a)| a.reach == Reach::Local && is_around(a));
        let mut by_function: BTreeMap<FunctionId, Vec<(u32, &Assignment)>> = BTreeMap::new();
        for (number, assignment) in hiding {
            let own = by_function.entry(assignment.function).or_default();
            own.push((number, assignment));
        }
        let mut found = HashSet::new();
        for (function, own) in by_function {
            let start = parsed.functions[function as usize].offset as usize;
            let end = own.iter().map(|(_, a)| a.offset as usize).max();
            let text = parsed
                .text
                .get(start..end.unwrap_or(start))
                .unwrap_or_default();
            let mut first: HashMap<&[u8], usize> = HashMap::new();
            let mut at = start;
            for word in text.split(|b| !is_letter(*b)) {
                first.entry(word).or_insert(at);
                at += word.len() + 1;
            }
            found.extend(own.iter().filter_map(|(number, assignment)| {
                let first = first.get(parsed.bytes(assignment.name));
                let is_named = first.is_some_and(|at| *at < assignment.offset as usize);
                (assignment.in_block || is_named).then_some(*number)
            }));
        }
        found
    }

    /// Whether an assignment may be of a variable of its own function, not of one around it.
    ///
    /// # Source
    /// Universal Robots, "The `URScript` Programming Language", scoping rules: a name without
    /// `local` or `global` is looked for among the global ones, else it is local.
    pub(super) fn may_be_local(&self, number: u32) -> bool {
        let assignment = &self.parsed.assignments[number as usize];
        if assignment.reach == Reach::Global {
            return false;
        }
        let is = |function| {
            let known = self.names.get(&(function, assignment.name));
            known == Some(&self.assigned[number as usize])
        };
        let unit = self.parsed.functions[assignment.function as usize].unit;
        if assignment.reach == Reach::Local {
            return !is(assignment.function);
        }
        ![0, unit, assignment.function].into_iter().any(is)
    }

    /// What calls give and functions return.
    fn bind(&mut self) {
        let parsed = self.parsed;
        for (at, function) in parsed.functions.iter().enumerate() {
            for event in &function.events {
                match *event {
                    Event::Return(value, offset) => {
                        let at = short(at);
                        let Some(name) = function.name else { continue };
                        let result = if let Some(known) = self.results.get(&at) {
                            *known
                        } else {
                            let made = self.add(name, offset, None);
                            self.results.insert(at, made);
                            made
                        };
                        self.source(result, value, at, Assigned::Given);
                    }
                    Event::Tool(..) => self.sets_tool = true,
                    _ => {}
                }
            }
        }
        for call in &parsed.calls {
            for callee in self.callees(call).to_vec() {
                let count = parsed.functions[callee as usize].parameters.len();
                for position in 0..count {
                    let (parameter, value) = self.given(call, callee, position);
                    if let Some((value, function)) = value {
                        self.source(parameter, value, function, Assigned::Given);
                    }
                }
            }
        }
    }

    /// Functions of the files that a call may mean.
    pub(super) fn callees(&self, call: &Called) -> &[FunctionId] {
        self.functions_of(call.name, call.function)
    }

    /// The functions that a name means in a function: of its file, else of the others.
    pub(super) fn functions_of(&self, name: Symbol, function: FunctionId) -> &[FunctionId] {
        let unit = self.parsed.functions[function as usize].unit;
        let own = self.functions.get(&(unit, name));
        let own = own.or_else(|| self.functions.get(&(0, name)));
        own.map_or(&[], Vec::as_slice)
    }

    /// Whether a call is of a function of the language that moves nothing.
    pub(super) fn is_of_language(&self, call: &Called) -> bool {
        self.callees(call).is_empty() && verbs::is_of_language(self.parsed.bytes(call.name))
    }

    /// A parameter of a function, and what a call gives it with the function where that is meant.
    pub(super) fn given(
        &self,
        call: &Called,
        callee: FunctionId,
        position: usize,
    ) -> (VarId, Option<(ExprId, FunctionId)>) {
        let function = &self.parsed.functions[callee as usize];
        let (name, default) = function.parameters[position];
        let arguments = self.parsed.arguments_of(call);
        let named = arguments.iter().find(|(by, _)| *by == Some(name));
        let placed = arguments.get(position).filter(|(by, _)| by.is_none());
        let value = named.or(placed).map(|(_, value)| (*value, call.function));
        let default = default.map(|value| (value, function.parent));
        (self.names[&(callee, name)], value.or(default))
    }

    /// The variable that a name means in a function.
    pub(super) fn meaning(&self, name: Symbol, function: FunctionId) -> Option<VarId> {
        let mut function = function;
        loop {
            if let Some(variable) = self.names.get(&(function, name)) {
                return Some(*variable);
            }
            if function == 0 {
                return None;
            }
            function = self.parsed.functions[function as usize].parent;
        }
    }

    /// What a call of a function of the file returns.
    pub(super) fn result(&self, call: u32) -> Option<VarId> {
        let call = &self.parsed.calls[call as usize];
        self.result_named(call.name, call.function)
    }

    /// What the function returns that a name means in a function.
    pub(super) fn result_named(&self, name: Symbol, function: FunctionId) -> Option<VarId> {
        match *self.functions_of(name, function) {
            [one] => self.result_of(one),
            _ => None,
        }
    }

    /// What a function returns.
    pub(super) fn result_of(&self, function: FunctionId) -> Option<VarId> {
        self.results.get(&function).copied()
    }

    // ---- variables that stand for their value

    /// Finds the variables that have one value which says the same at any time.
    fn fix(&mut self) {
        let mut users: HashMap<VarId, Vec<VarId>> = HashMap::new();
        let mut open = Vec::new();
        for at in 0..short(self.list.len()) {
            let mut sources = self.sources(at);
            let (first, more) = (sources.next(), sources.next());
            drop(sources);
            let one = first.filter(|source| {
                more.is_none()
                    && source.way == Assigned::Whole
                    && self.list[at as usize].parameter.is_none()
            });
            let mut named = Vec::new();
            let is_plain =
                one.is_some_and(|one| self.is_plain(one.value, one.function, &mut named));
            self.list[at as usize].is_fixed = is_plain;
            if is_plain {
                for name in named {
                    users.entry(name).or_default().push(at);
                }
            } else {
                open.push(at);
            }
        }
        while let Some(changing) = open.pop() {
            for user in users.remove(&changing).unwrap_or_default() {
                if std::mem::replace(&mut self.list[user as usize].is_fixed, false) {
                    open.push(user);
                }
            }
        }
    }

    /// Whether a value says the same at any time if the variables that it names do.
    fn is_plain(&self, value: ExprId, function: FunctionId, named: &mut Vec<VarId>) -> bool {
        match self.parsed.expression(value) {
            // what it is computed from may change before a move goes there
            Expr::Literal(id) => {
                let names = self.parsed.names_in(id).iter();
                named.extend(names.filter_map(|name| self.meaning(*name, function)));
                true
            }
            Expr::Made(from, to) => {
                named.extend(self.named(self.parsed.composed_in(from..to), function));
                true
            }
            Expr::List(_) | Expr::Element(..) | Expr::Number(_) | Expr::Other => true,
            // a pose is that of the tool which is set where it is read
            Expr::Actual { is_pose } => !is_pose || !self.sets_tool,
            Expr::Name(name, _) => {
                named.extend(self.meaning(name, function));
                true
            }
            Expr::Trans(a, b) | Expr::Add(a, b) => {
                self.is_plain(a, function, named) && self.is_plain(b, function, named)
            }
            Expr::Inverse(a) => self.is_plain(a, function, named),
            Expr::Kinematics { pose, tcp, .. } => {
                (tcp.is_some() || !self.sets_tool)
                    && self.is_plain(pose, function, named)
                    && tcp.is_none_or(|tcp| self.is_plain(tcp, function, named))
            }
            Expr::Call(call) => self.result(call).is_none(),
        }
    }

    /// The value of a variable that stands for it.
    pub(super) fn fixed(&self, variable: VarId) -> Option<Source> {
        let is_fixed = self.list[variable as usize].is_fixed;
        self.sources(variable).next().filter(|_| is_fixed)
    }

    /// The value behind names that stand for theirs.
    pub(super) fn follow(&self, value: ExprId, function: FunctionId) -> (Expr, FunctionId) {
        let (mut value, mut function) = (value, function);
        for _ in 0..MOST_STEPS {
            let Expr::Name(name, _) = self.parsed.expression(value) else {
                break;
            };
            let Some(next) = self.meaning(name, function).and_then(|v| self.fixed(v)) else {
                break;
            };
            (value, function) = (next.value, next.function);
        }
        (self.parsed.expression(value), function)
    }

    /// The joint angles that a value is, of a variable with several values those of each.
    pub(super) fn joints(&self, value: ExprId, function: FunctionId) -> Option<LiteralId> {
        self.joints_within(value, function, MOST_STEPS)
    }

    fn joints_within(&self, value: ExprId, function: FunctionId, steps: u32) -> Option<LiteralId> {
        let steps = steps.checked_sub(1)?;
        let (expression, function) = self.follow(value, function);
        match expression {
            Expr::Literal(id) => Some(id),
            Expr::Name(name, _) => {
                let variable = self.meaning(name, function)?;
                let has_parts = self.list[variable as usize].has_parts;
                let mut sources = self.sources(variable).filter(|_| !has_parts);
                let mut joints = |s: Source| self.joints_within(s.value, s.function, steps / 2);
                let values = |id| {
                    let literal = self.parsed.literal(id);
                    (literal.content, self.parsed.values(literal))
                };
                let first = sources.next().and_then(&mut joints)?;
                let same = |s| joints(s).is_some_and(|id| values(id) == values(first));
                sources.all(same).then_some(first)
            }
            Expr::Element(..) => {
                let (value, function) = self.one_of(expression, function)?;
                self.joints_within(value, function, steps)
            }
            _ => None,
        }
    }

    /// A pose that the text tells.
    ///
    /// # Errors
    /// Where it does not.
    pub(super) fn constant(
        &self,
        value: ExprId,
        function: FunctionId,
    ) -> Result<Pose, NotConstant> {
        self.evaluate(value, function, MOST_STEPS)
    }

    /// The value of an element of a list, or of a call, where it has one.
    fn one_of(&self, of: Expr, function: FunctionId) -> Option<(ExprId, FunctionId)> {
        let one = match of {
            Expr::Element(name, at) => {
                let elements = self.elements(name, at, function)?;
                elements.changed.is_none().then_some(elements.values)?
            }
            Expr::Call(call) => {
                let sources = self.sources(self.result(call)?);
                sources
                    .map(|source| (source.value, source.function))
                    .collect()
            }
            _ => return None,
        };
        match one[..] {
            [one] => Some(one),
            _ => None,
        }
    }

    fn evaluate(
        &self,
        value: ExprId,
        function: FunctionId,
        steps: u32,
    ) -> Result<Pose, NotConstant> {
        let (expression, function) = self.follow(value, function);
        let steps = steps.checked_sub(1).ok_or(NotConstant::Computed)?;
        let within = |value, function| {
            self.evaluate(value, function, steps)
                .map_err(|error| match error {
                    NotConstant::Endless(_) => error,
                    _ => NotConstant::Computed,
                })
        };
        let inner = |value| within(value, function);
        match expression {
            Expr::Literal(id) => {
                let literal = self.parsed.literal(id);
                let values = self.parsed.values(literal);
                let values = values.filter(|_| literal.pose && !self.targets[id as usize]);
                let values = values.or_else(|| self.exactly(id, function));
                let degrees = literal.content.degrees();
                let values = values.ok_or(NotConstant::Computed)?;
                match super::rotation::endless(&values, degrees) {
                    Some(angle) => Err(NotConstant::Endless(angle)),
                    None => Ok(super::rotation::pose(values, degrees)),
                }
            }
            Expr::Name(name, _) => Err(match self.meaning(name, function) {
                Some(variable) if !self.list[variable as usize].is_fixed => {
                    NotConstant::Changing(variable)
                }
                Some(_) => NotConstant::Computed,
                None => NotConstant::Unknown(name),
            }),
            Expr::Trans(a, b) => Ok(inner(a)? * inner(b)?),
            Expr::Add(a, b) => {
                let (a, b) = (inner(a)?, inner(b)?);
                let [x, y, z] = b.translation;
                Ok(Pose::from_translation(x, y, z) * a * Pose::from_rotation(b.rotation))
            }
            Expr::Inverse(a) => Ok(inner(a)?.inverse()),
            Expr::Element(..) | Expr::Call(_) => match self.one_of(expression, function) {
                Some((value, function)) => within(value, function),
                None => Err(NotConstant::Computed),
            },
            _ => Err(NotConstant::Computed),
        }
    }
}

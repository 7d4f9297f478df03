//! What literals and variables are used for.
//!
//! Poses of targets, features, offsets and tools look alike. What a literal is follows from where
//! it goes: to a move it is a target. In `pose_trans(a, b)` a is a target and b its offset where
//! other moves go to a, or where b is a step of several such a or one that counts (`steps`); else a
//! is a feature and b the target in it.

use super::syntax::{At, Event, Expr, ExprId, FunctionId, LiteralId, Symbol};
use super::variables::{Assigned, MOST_STEPS, VarId, Variables};
use crate::program::script::{DisplacementId, OVERWRITTEN, UNBOUNDED, short};
use foldhash::{HashSet, HashSetExt};

/// What moves have been found to go to.
struct Seen {
    variables: Vec<bool>,
    /// Values of elements of lists.
    elements: HashSet<ExprId>,
}

/// What an element of a list may be.
pub(super) struct Elements {
    pub values: Vec<(ExprId, FunctionId)>,
    /// One of the values with something else done to it; `None` where it is as it was given.
    pub changed: Option<DisplacementId>,
}

/// Elements of one list that are kept apart by their numbers.
const MOST_NUMBERS: usize = 4;

/// The places in lists and structures from which an element may come, each once.
#[derive(Default)]
struct Places {
    all: Vec<(VarId, At)>,
    looked_into: usize,
}

impl Places {
    /// `None` where it is not looked into.
    fn add(
        &mut self,
        variables: &Variables,
        (name, at): (Symbol, At),
        function: FunctionId,
    ) -> Option<()> {
        if variables.is_deep(at) {
            return None;
        }
        let variable = variables.meaning(name, function)?;
        let of_it = self.all.iter().filter(|(of, _)| *of == variable);
        if at.number().is_some() && of_it.count() >= MOST_NUMBERS {
            self.add_all(variable);
        } else {
            self.add_one(variable, at);
        }
        (self.all.len() <= MOST_STEPS as usize).then_some(())
    }

    /// Every element of a list.
    fn add_all(&mut self, variable: VarId) {
        self.add_one(variable, At::Any);
    }

    fn add_one(&mut self, variable: VarId, at: At) {
        if !self.all.contains(&(variable, at)) {
            self.all.push((variable, at));
        }
    }

    fn next(&mut self) -> Option<(VarId, At)> {
        let next = self.all.get(self.looked_into).copied();
        self.looked_into += usize::from(next.is_some());
        next
    }

    fn is_at_end(&self) -> bool {
        self.looked_into == self.all.len()
    }

    fn have(&self, variable: VarId) -> bool {
        self.all.iter().any(|(of, _)| *of == variable)
    }
}

impl Variables<'_, '_> {
    /// Whether a variable may hold the joints that a position has, or others.
    pub(super) fn holds_joints(&self, variable: VarId) -> bool {
        let all = self.parsed.assignments.iter().zip(&self.assigned);
        let mut own = all.filter(|(of, assigned)| **assigned == variable && !of.part);
        own.any(|(of, _)| {
            let value = self.parsed.expression(of.value);
            matches!(value, Expr::Kinematics { .. } | Expr::List(_))
        })
    }

    /// Finds the literals and variables that moves go to.
    pub(super) fn find_targets(&mut self) {
        self.find_features();
        let parsed = self.parsed;
        let mut open = Vec::new();
        // what `pose_trans(a, b)` goes to depends on whether others go to a
        for round in 0..4 {
            let mut changed = false;
            let mut seen = Seen {
                variables: vec![false; self.list.len()],
                elements: HashSet::new(),
            };
            for (at, function) in parsed.functions.iter().enumerate() {
                for event in &function.events {
                    if let Event::Step(step) = event
                        && let Some(target) = parsed.steps[*step as usize].target
                    {
                        open.push((target, short(at)));
                        changed |= self.mark_targets(&mut open, &mut seen, round > 0);
                    }
                }
            }
            if round > 0 && !changed {
                break;
            }
        }
    }

    /// Marks what values go to; whether that is new.
    fn mark_targets(
        &mut self,
        open: &mut Vec<(ExprId, FunctionId)>,
        seen: &mut Seen,
        through_features: bool,
    ) -> bool {
        let parsed = self.parsed;
        let mut changed = false;
        while let Some((value, function)) = open.pop() {
            let variable = match parsed.expression(value) {
                Expr::Literal(id) => {
                    changed |= !std::mem::replace(&mut self.targets[id as usize], true);
                    // a pose of the elements of another goes to that one
                    let of = self.grown_from(id, function).filter(|_| through_features);
                    of.filter(|of| !self.holds_actual(*of))
                }
                Expr::List(list) => {
                    if let Some(id) = self.joints_of(list) {
                        changed |= !std::mem::replace(&mut self.targets[id as usize], true);
                    }
                    None
                }
                Expr::Element(name, at) => {
                    if let Some(elements) = self.elements(name, at, function) {
                        let new = |(value, _): &(ExprId, _)| seen.elements.insert(*value);
                        open.extend(elements.values.into_iter().filter(new));
                    }
                    None
                }
                Expr::Name(name, _) => self.meaning(name, function),
                Expr::Call(call) => self.result(call),
                Expr::Kinematics { pose, .. } => {
                    open.push((pose, function));
                    None
                }
                Expr::Trans(a, b) if through_features => {
                    // an inverse is a displacement backwards, no target
                    let is_back = matches!(self.follow(b, function).0, Expr::Inverse(_));
                    let is_offset =
                        is_back || self.goes_to(a, function) || self.is_actual(a, function);
                    let is_offset = is_offset || self.is_stepped_from(a, b, function);
                    open.push((if is_offset { a } else { b }, function));
                    None
                }
                // of a sum the robot's own position is no offset
                Expr::Add(a, b) if through_features => {
                    let is_offset = self.is_actual(b, function);
                    open.push((if is_offset { b } else { a }, function));
                    None
                }
                _ => None,
            };
            if let Some(variable) = variable
                && !std::mem::replace(&mut seen.variables[variable as usize], true)
            {
                let of = &mut self.list[variable as usize];
                changed |= !std::mem::replace(&mut of.is_position, true);
                let whole = self.sources(variable).filter(|s| !s.way.is_part());
                open.extend(whole.map(|source| (source.value, source.function)));
            }
        }
        changed
    }

    /// A list of six values that are no literals: joints.
    pub(super) fn joints_of(&self, list: u32) -> Option<LiteralId> {
        let list = &self.parsed.lists[list as usize];
        let is_plain = |value: &ExprId| {
            let value = self.parsed.expression(*value);
            matches!(value, Expr::Name(..) | Expr::Other)
        };
        (list.elements.len() == 6 && list.elements.iter().all(is_plain)).then_some(list.literal)
    }

    /// What an element of a list, or a member of a structure, may be; of elements with a number only
    /// what is put there. `None` where the text does not tell them all.
    pub(super) fn elements(&self, name: Symbol, at: At, function: FunctionId) -> Option<Elements> {
        let mut changed = None;
        let mut found = Vec::new();
        let mut places = Places::default();
        places.add(self, (name, at), function)?;
        let mut is_looked_into = 0;
        while let Some((variable, at)) = places.next() {
            if self.put_into(variable, at, &mut places, &mut found)? {
                changed = Some(OVERWRITTEN);
            }
            if places.is_at_end() {
                // one that is made of elements of these lists is made of what it is itself, any
                // number of times; of other lists one is looked into
                while let Some(&(value, function)) = found.get(is_looked_into) {
                    let mut inside = Vec::new();
                    self.lists_in(value, function, MOST_STEPS, &mut inside);
                    let is_again = |of: &VarId| places.have(*of) || self.has_composed_elements(*of);
                    if inside.iter().any(is_again) {
                        changed = changed.or(Some(UNBOUNDED));
                        found.swap_remove(is_looked_into);
                        for of in inside {
                            places.add_all(of);
                        }
                    } else {
                        is_looked_into += 1;
                    }
                }
            }
        }
        Some(Elements {
            values: found,
            changed,
        })
    }

    /// Adds what is put into a place; whether something within it is written. `None` where the text
    /// does not tell all.
    fn put_into(
        &self,
        variable: VarId,
        at: At,
        places: &mut Places,
        found: &mut Vec<(ExprId, FunctionId)>,
    ) -> Option<bool> {
        let mut is_written = false;
        for source in self.sources(variable) {
            let function = source.function;
            let mut put = |value| {
                if let (Expr::Element(name, at), function) = self.follow(value, function) {
                    return places.add(self, (name, at), function);
                }
                found.push((value, function));
                Some(())
            };
            match source.way {
                Assigned::Deep => is_written = true,
                Assigned::Part(part) => {
                    if self.is_deep(part) && matches!(at, At::Member(_)) {
                        return None;
                    }
                    if part.may_be(at) {
                        put(source.value)?;
                    }
                }
                Assigned::Whole | Assigned::Given => match self.parsed.expression(source.value) {
                    Expr::Call(call) if self.is_structure(call) => {
                        let members = self.parsed.arguments_of(&self.parsed.calls[call as usize]);
                        for (_, value) in members.iter().filter(|(member, _)| {
                            member.is_some_and(|member| At::Member(member).may_be(at))
                        }) {
                            put(*value)?;
                        }
                    }
                    Expr::List(list) if !matches!(at, At::Member(_)) => {
                        let elements = &self.parsed.lists[list as usize].elements;
                        let numbered = (0..).zip(elements);
                        for (_, value) in numbered.filter(|(n, _)| At::Number(*n).may_be(at)) {
                            put(*value)?;
                        }
                    }
                    Expr::Name(name, _) => places.add(self, (name, at), function)?,
                    // an empty list is filled by its elements
                    Expr::Literal(id) if self.parsed.literal(id).elements <= 1 => {}
                    _ => return None,
                },
            }
        }
        Some(is_written)
    }

    /// Structures in structures are not looked into.
    fn is_deep(&self, at: At) -> bool {
        match at {
            At::Member(member) => self.parsed.bytes(member).contains(&b'.'),
            At::Any | At::Number(_) => false,
        }
    }

    /// Whether a call makes a structure of its arguments: `struct(a=…, b=…)`.
    pub(super) fn is_structure(&self, call: u32) -> bool {
        let call = &self.parsed.calls[call as usize];
        self.parsed.bytes(call.name) == b"struct" && self.callees(call).is_empty()
    }

    /// The lists that a value takes elements of.
    fn lists_in(&self, value: ExprId, function: FunctionId, steps: u32, found: &mut Vec<VarId>) {
        let Some(steps) = steps.checked_sub(1) else {
            return;
        };
        let (expression, function) = self.follow(value, function);
        match expression {
            Expr::Element(name, _) => found.extend(self.meaning(name, function)),
            Expr::Trans(a, b) => {
                self.lists_in(a, function, steps, found);
                self.lists_in(b, function, steps, found);
            }
            Expr::Add(a, _) | Expr::Inverse(a) | Expr::Kinematics { pose: a, .. } => {
                self.lists_in(a, function, steps, found);
            }
            _ => {}
        }
    }

    /// Whether elements of a list are made of elements of lists.
    fn has_composed_elements(&self, list: VarId) -> bool {
        let mut inside = Vec::new();
        for source in self.sources(list) {
            match self.parsed.expression(source.value) {
                Expr::List(of) => {
                    for value in &self.parsed.lists[of as usize].elements {
                        self.lists_in(*value, source.function, MOST_STEPS, &mut inside);
                    }
                }
                _ => self.lists_in(source.value, source.function, MOST_STEPS, &mut inside),
            }
        }
        !inside.is_empty()
    }

    /// Whether a value is a position that moves go to, in a feature or displaced, too.
    pub(super) fn goes_to(&self, value: ExprId, function: FunctionId) -> bool {
        self.goes_within(value, function, MOST_STEPS)
    }

    fn goes_within(&self, value: ExprId, function: FunctionId, steps: u32) -> bool {
        let Some(steps) = steps.checked_sub(1) else {
            return false;
        };
        match self.parsed.expression(value) {
            Expr::Literal(id) => self.targets[id as usize],
            Expr::Name(name, _) => self.meaning(name, function).is_some_and(|variable| {
                let is_position = self.list[variable as usize].is_position;
                let Some(source) = self.fixed(variable) else {
                    let mut given = self.sources(variable).filter(|s| s.way == Assigned::Given);
                    return is_position
                        || given.any(|s| self.goes_within(s.value, s.function, steps / 2));
                };
                let value = self.parsed.expression(source.value);
                is_position && matches!(value, Expr::Trans(..) | Expr::Add(..))
                    || self.goes_within(source.value, source.function, steps)
            }),
            Expr::Trans(a, b) => {
                self.goes_within(a, function, steps / 2) || self.goes_within(b, function, steps)
            }
            Expr::Add(a, _) => self.goes_within(a, function, steps),
            Expr::Element(name, at) => {
                let elements = self.elements(name, at, function);
                let mut values = elements.into_iter().flat_map(|of| of.values);
                values.any(|(value, function)| self.goes_within(value, function, steps / 2))
            }
            _ => false,
        }
    }

    /// Whether a value is where the robot is, or displaced from there: what stands in it is no
    /// target.
    pub(super) fn is_actual(&self, value: ExprId, function: FunctionId) -> bool {
        self.comes_from_actual(value, function, MOST_STEPS)
    }

    fn comes_from_actual(&self, value: ExprId, function: FunctionId, steps: u32) -> bool {
        let Some(steps) = steps.checked_sub(1) else {
            return false;
        };
        match self.parsed.expression(value) {
            Expr::Actual { .. } => true,
            Expr::Trans(a, _) => self.comes_from_actual(a, function, steps),
            Expr::Add(a, b) => {
                let mut both = [a, b].into_iter();
                both.any(|of| self.comes_from_actual(of, function, steps / 2))
            }
            Expr::Name(name, _) => (self.meaning(name, function))
                .is_some_and(|variable| self.holds_actual_within(variable, steps)),
            _ => false,
        }
    }

    /// Whether a variable only has values that are where the robot is.
    fn holds_actual(&self, variable: VarId) -> bool {
        self.holds_actual_within(variable, MOST_STEPS)
    }

    fn holds_actual_within(&self, variable: VarId, steps: u32) -> bool {
        let mut sources = self.sources(variable).filter(|s| !s.way.is_part());
        let mut all = sources.by_ref().take(MOST_STEPS as usize).peekable();
        all.peek().is_some()
            && all.all(|s| self.comes_from_actual(s.value, s.function, steps / 2))
            && sources.next().is_none()
    }

    /// Finds the variables that are features and tools, and those whose positions have some of
    /// their own.
    pub(super) fn find_frames(&mut self) {
        let parsed = self.parsed;
        let mut open = Vec::new();
        for (at, function) in parsed.functions.iter().enumerate() {
            for event in &function.events {
                match *event {
                    Event::Tool(value, _) => open.push((value, short(at))),
                    Event::Step(step) => {
                        if let Some(target) = parsed.steps[step as usize].target {
                            self.frames_in(target, short(at), &mut open);
                        }
                    }
                    _ => {}
                }
            }
        }
        for variable in 0..short(self.list.len()) {
            if self.list[variable as usize].is_position {
                for source in self.sources(variable) {
                    self.frames_in(source.value, source.function, &mut open);
                }
            }
        }
        while let Some((value, function)) = open.pop() {
            let variable = match parsed.expression(value) {
                Expr::Name(name, _) => self.meaning(name, function),
                _ => None,
            };
            if let Some(variable) = variable
                && !std::mem::replace(&mut self.list[variable as usize].is_frame, true)
            {
                let sources = self.sources(variable);
                open.extend(sources.map(|source| (source.value, source.function)));
            }
        }
        for pass in 0..=MOST_STEPS {
            let mut changed = false;
            for variable in 0..self.list.len() {
                let of = &self.list[variable];
                if of.is_fixed || !of.is_position {
                    continue;
                }
                let (mut features, mut tools) = (pass == MOST_STEPS, pass == MOST_STEPS);
                for source in self.sources(short(variable)) {
                    let (feature, tool) = self.has_own(source.value, source.function, MOST_STEPS);
                    features |= feature;
                    tools |= tool;
                }
                let of = &mut self.list[variable];
                changed |= (features && !of.in_features) || (tools && !of.with_tools);
                of.in_features |= features;
                of.with_tools |= tools;
            }
            if !changed {
                break;
            }
        }
    }

    /// The features and tools in a position.
    fn frames_in(
        &self,
        value: ExprId,
        function: FunctionId,
        found: &mut Vec<(ExprId, FunctionId)>,
    ) {
        match self.parsed.expression(value) {
            Expr::Trans(a, _) if self.goes_to(a, function) => self.frames_in(a, function, found),
            Expr::Trans(a, b) => {
                found.push((a, function));
                self.frames_in(b, function, found);
            }
            Expr::Add(a, _) => self.frames_in(a, function, found),
            Expr::Kinematics { pose, tcp, .. } => {
                found.extend(tcp.map(|tcp| (tcp, function)));
                self.frames_in(pose, function, found);
            }
            _ => {}
        }
    }

    /// Whether a position has a feature, and a tool, of its own.
    fn has_own(&self, value: ExprId, function: FunctionId, steps: u32) -> (bool, bool) {
        let Some(steps) = steps.checked_sub(1) else {
            return (true, true);
        };
        let of = |variable: Option<VarId>| {
            let Some(variable) = variable else {
                return (false, false);
            };
            if let Some(source) = self.fixed(variable) {
                self.has_own(source.value, source.function, steps)
            } else {
                let of = &self.list[variable as usize];
                (of.in_features, of.with_tools)
            }
        };
        match self.parsed.expression(value) {
            Expr::Name(name, _) => of(self.meaning(name, function)),
            Expr::Call(call) => of(self.result(call)),
            Expr::Trans(a, b) if !self.goes_to(a, function) => {
                (true, self.has_own(b, function, steps).1)
            }
            Expr::Trans(a, _) | Expr::Add(a, _) => self.has_own(a, function, steps),
            Expr::Kinematics { pose, tcp, .. } => {
                let (feature, tool) = self.has_own(pose, function, steps);
                (feature, tool || tcp.is_some() || self.sets_tool)
            }
            _ => (false, false),
        }
    }
}

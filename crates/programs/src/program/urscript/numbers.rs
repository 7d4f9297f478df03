//! What numbers may be, from all that the text assigns to them.

use super::syntax::{Content, Event, Expr, ExprId, FunctionId, LiteralId, Symbol, unit};
use super::variables::{VarId, Variables};
use crate::geometry::units::DEG;
use crate::geometry::{Pose, Rotation, norm};
use crate::program::displacing::Displacing;
use crate::program::numbers::{Blocks, Numbers, Operand, Site, bounds_in, evaluated, parts};
use crate::program::quantity::{Arithmetic, Quantity, evaluate, is_letter};
use crate::program::script::short;
use crate::program::{Displacement, number};

/// Numbers in a pose.
const OF_POSE: usize = 6;

/// What is written into a number.
#[derive(Clone, Copy, Debug)]
pub(super) enum Written {
    /// By the assignment of this number.
    Assigned(u32),
    /// By a call, which gives it.
    Given {
        call: u32,
        callee: FunctionId,
        position: usize,
    },
    /// By the RETURN that begins at this byte of a function.
    Returned(u32, FunctionId),
    /// Nothing: between these bytes is what a condition of a function compares a number with.
    Limit(u32, u32, FunctionId),
}

/// What functions give has the number of the function, above this.
const RESULT: u32 = 1 << 31;
/// Beginnings of the names of functions that make positions of positions.
const COMPUTING: [&[u8]; 7] = [
    b"pose_",
    b"interpolate_",
    b"get_forward_kin",
    b"get_inverse_kin",
    b"inv",
    b"transpose",
    b"wrench_",
];
/// Beginnings of the names of functions that say where the robot is: that may be anywhere.
const PLACES: [&[u8]; 3] = [b"get_actual_t", b"get_actual_joint_pos", b"get_target_t"];
/// Functions whose value is worked out of what they are given.
///
/// # Source
/// Universal Robots, "The `URScript` Programming Language", module urmath.
const WORKED_OUT: [&[u8]; 18] = [
    b"abs", b"acos", b"asin", b"atan", b"atan2", b"ceil", b"cos", b"d2r", b"floor", b"length",
    b"log", b"norm", b"pow", b"r2d", b"round", b"sin", b"sqrt", b"tan",
];

impl Variables<'_, '_> {
    /// Notes all that is written into variables; each write is one of the assignments.
    pub(super) fn find_numbers(&mut self) {
        let parsed = self.parsed;
        let mut numbers = Numbers::default();
        let mut blocks = Blocks::default();
        for (at, function) in (0..).zip(&parsed.functions) {
            blocks.begin(at);
            if function.thread {
                numbers.runs_at_any_time(at);
            }
            for event in &function.events {
                match *event {
                    Event::Assign(number) => {
                        let variable = self.assigned[number as usize];
                        // an element sets the others not anew
                        let is_whole = !parsed.assignments[number as usize].part;
                        let site = is_whole.then(|| blocks.site());
                        numbers.write(variable, Written::Assigned(number), site);
                    }
                    Event::Return(_, offset) => {
                        numbers.write(RESULT | at, Written::Returned(offset, at), None);
                    }
                    Event::If | Event::Never | Event::Switch => blocks.open(Some(1)),
                    Event::Branch { .. } => blocks.branch(),
                    Event::Loop => blocks.open(None),
                    Event::Condition(start, end) => {
                        self.bound(at, blocks.last(), (start, end), &mut numbers);
                    }
                    Event::EndIf | Event::EndLoop { .. } => blocks.close(),
                    _ => {}
                }
            }
        }
        for (at, call) in (0..).zip(&parsed.calls) {
            for &callee in self.callees(call) {
                numbers.calls(call.function, callee);
                for position in 0..parsed.functions[callee as usize].parameters.len() {
                    let (parameter, _) = self.given(call, callee, position);
                    let given = Written::Given {
                        call: at,
                        callee,
                        position,
                    };
                    numbers.write(parameter, given, Some(Site::at_start(callee)));
                }
            }
        }
        self.numbers = numbers;
    }

    /// Notes what the condition of a loop between these bytes bounds: `while i < 5:`.
    fn bound(
        &self,
        function: FunctionId,
        block: (u32, u32),
        (start, end): (u32, u32),
        numbers: &mut Numbers<Written>,
    ) {
        let text = self.parsed.text;
        let condition = &text[start as usize..end as usize];
        let condition = condition.trim_ascii_end();
        let condition = condition.strip_suffix(b":").unwrap_or(condition);
        for (name, relation, limit) in bounds_in(condition) {
            let name = self.parsed.known_symbol(name);
            let Some(variable) = name.and_then(|name| self.meaning(name, function)) else {
                continue;
            };
            let start = short(limit.as_ptr() as usize - text.as_ptr() as usize);
            let limit = Written::Limit(start, start + short(limit.len()), function);
            numbers.bound(block, variable, (relation, limit));
        }
    }

    /// What an assignment writes, or what a call gives in its brackets.
    pub(super) fn text_of(&self, written: Written) -> Option<(&[u8], FunctionId)> {
        match written {
            Written::Assigned(number) => {
                let assignment = &self.parsed.assignments[number as usize];
                let text = self.parsed.text.get(assignment.offset as usize..)?;
                let is_end = |b: &u8| matches!(b, b'\n' | b'\r' | b'#' | b';');
                let end = text.iter().position(is_end).unwrap_or(text.len());
                let start = memchr::memchr(b'=', &text[..end]).map_or(end, |at| at + 1);
                Some((&text[start..end], assignment.function))
            }
            Written::Returned(offset, function) => {
                let text = self.parsed.text.get(offset as usize..)?;
                let is_end = |b: &u8| matches!(b, b'\n' | b'\r' | b'#' | b';');
                let end = text.iter().position(is_end).unwrap_or(text.len());
                let start = text.iter().take_while(|b| b.is_ascii_alphabetic()).count();
                Some((&text[start.min(end)..end], function))
            }
            Written::Limit(start, end, function) => {
                Some((&self.parsed.text[start as usize..end as usize], function))
            }
            Written::Given {
                call,
                callee,
                position,
            } => {
                let call = &self.parsed.calls[call as usize];
                let of = &self.parsed.functions[callee as usize];
                let (name, default) = of.parameters[position];
                let arguments = self.parsed.arguments_of(call);
                let named = arguments.iter().position(|(by, _)| *by == Some(name));
                let is_placed = arguments.get(position).is_some_and(|(by, _)| by.is_none());
                // behind the bracket of the call, or of the function where that has a default
                let (offset, at, function) = match named.or(is_placed.then_some(position)) {
                    Some(at) => (call.offset, at, call.function),
                    None => (default.map(|_| of.offset)?, position, of.parent),
                };
                let text = self.parsed.text.get(offset as usize..)?;
                let inside = &text[memchr::memchr(b'(', text)? + 1..];
                let part = parts(inside).nth(at)?;
                let has_name = named.is_some() || !is_placed;
                let equals = memchr::memchr(b'=', part).filter(|_| has_name);
                Some((&part[equals.map_or(0, |at| at + 1)..], function))
            }
        }
    }

    /// The six numbers of a pose with expressions in it, or of a variable that has one of several.
    pub(super) fn amounts(
        &self,
        pose: ExprId,
        function: FunctionId,
    ) -> Option<[Quantity; OF_POSE]> {
        match self.follow(pose, function) {
            (Expr::Literal(id), function) => self.amounts_of(id, function),
            (Expr::Name(name, _), function) => {
                let variable = self.meaning(name, function)?;
                let all: Option<Vec<_>> = self
                    .sources(variable)
                    .map(|source| match self.follow(source.value, source.function) {
                        (Expr::Literal(id), function) => self.amounts_of(id, function),
                        _ => None,
                    })
                    .collect();
                let all = all.filter(|all| !all.is_empty())?;
                Some(std::array::from_fn(|part| {
                    let each: Vec<_> = all.iter().map(|of| of[part].clone()).collect();
                    Quantity::any(&each)
                }))
            }
            _ => None,
        }
    }

    /// The six numbers of a pose that is written out.
    pub(super) fn amounts_of(
        &self,
        id: LiteralId,
        function: FunctionId,
    ) -> Option<[Quantity; OF_POSE]> {
        let literal = self.parsed.literal(id);
        match literal.content {
            _ if !literal.pose => None,
            Content::Numbers => Some(self.parsed.values(literal)?.map(Quantity::exactly)),
            Content::Degrees(bits) => {
                let mut values = self.parsed.values(literal)?;
                for (at, angle) in values.iter_mut().enumerate() {
                    *angle *= unit(bits, at);
                }
                Some(values.map(Quantity::exactly))
            }
            Content::Expressions => {
                let range = literal.offset as usize..literal.end as usize;
                let text = self.parsed.text.get(range)?;
                let open = memchr::memchr(b'[', text)?;
                let inside = text[open + 1..].trim_ascii_end().strip_suffix(b"]")?;
                let parts = parts(inside);
                let all: Vec<_> = parts.map(|part| self.quantity(part, function)).collect();
                all.try_into().ok()
            }
        }
    }

    /// The six numbers of a pose with expressions in it, where the text tells each, and none comes
    /// from a position that moves go to or that the robot has.
    pub(super) fn exactly(&self, id: LiteralId, function: FunctionId) -> Option<[f64; OF_POSE]> {
        let literal = self.parsed.literal(id);
        if literal.content != Content::Expressions || !self.is_made_of_numbers(id, function) {
            return None;
        }
        let amounts = self.amounts_of(id, function)?;
        let exact: Vec<f64> = amounts.iter().map_while(Quantity::exact).collect();
        exact.try_into().ok()
    }

    /// The position whose elements a pose has, and what is added to the first three of them.
    pub(super) fn grown(
        &self,
        id: LiteralId,
        function: FunctionId,
    ) -> Option<(Symbol, [Quantity; 3])> {
        let is_position = |variable: u32| self.list[variable as usize].is_position;
        self.grown_of(id, function, &is_position)
    }

    /// The variable whose elements a pose has, where moves go to that or not.
    pub(super) fn grown_from(&self, id: LiteralId, function: FunctionId) -> Option<VarId> {
        let (name, _) = self.grown_of(id, function, &|_| true)?;
        self.meaning(name, function)
    }

    fn grown_of(
        &self,
        id: LiteralId,
        function: FunctionId,
        is_term: &dyn Fn(VarId) -> bool,
    ) -> Option<(Symbol, [Quantity; 3])> {
        let literal = self.parsed.literal(id);
        let is_composed = literal.pose && literal.content == Content::Expressions;
        let range = literal.offset as usize..literal.end as usize;
        let text = self.parsed.text.get(range).filter(|_| is_composed)?;
        let open = memchr::memchr(b'[', text)?;
        let inside = text[open + 1..].trim_ascii_end().strip_suffix(b"]")?;
        let mut of = None;
        let mut along = [0.0; 3].map(Quantity::exactly);
        let mut count = 0;
        for (at, part) in parts(inside).enumerate() {
            let (name, rest) = self.term_and_rest(part, at, function, is_term)?;
            if *of.get_or_insert(name) != name {
                return None;
            }
            match along.get_mut(at) {
                Some(along) => *along = rest,
                None if rest.exact() == Some(0.0) => {}
                None => return None,
            }
            count += 1;
        }
        of.filter(|_| count == OF_POSE).map(|of| (of, along))
    }

    /// What an assignment adds to an element of a position, and of which.
    pub(super) fn growth(&self, number: u32) -> Option<(Symbol, usize, Quantity)> {
        let at = self.parsed.assignments[number as usize].element.number()? as usize;
        let (text, function) = self.text_of(Written::Assigned(number))?;
        let is_position = |variable: u32| self.list[variable as usize].is_position;
        let (name, by) = self.term_and_rest(text, at, function, &is_position)?;
        (at < 3).then_some((name, at, by))
    }

    /// The one element of such a variable that stands in a sum, and the rest of that.
    fn term_and_rest(
        &self,
        text: &[u8],
        at: usize,
        function: FunctionId,
        is_term: &dyn Fn(VarId) -> bool,
    ) -> Option<(Symbol, Quantity)> {
        let mut term = None;
        let mut is_one = true;
        let mut of = |variable| self.value_of(variable);
        let value = self.evaluated(text, function, &mut of, &mut |operand| {
            let inside = operand.strip_suffix(b"]")?;
            let open = memchr::memchr(b'[', inside)?;
            let index = number::parse(inside[open + 1..].trim_ascii())?;
            let name = self.parsed.known_symbol(inside[..open].trim_ascii())?;
            let variable = self.meaning(name, function)?;
            #[allow(clippy::cast_precision_loss)]
            let is_element = index == at as f64;
            if !is_element || !is_term(variable) {
                return None;
            }
            is_one &= term.is_none();
            term = Some(name);
            Some(Quantity::own())
        });
        let (count, rest) = value.apart();
        term.filter(|_| is_one && count == 1.0)
            .map(|term| (term, rest))
    }

    /// Whether only the running robot, or a file that is not here, tells a value.
    pub(super) fn is_of_robot(&self, value: ExprId, function: FunctionId) -> bool {
        match self.follow(value, function) {
            (Expr::Name(name, _), function) => match self.meaning(name, function) {
                None => true,
                Some(variable) => {
                    let mut sources = self.sources(variable).peekable();
                    sources.peek().is_some()
                        && sources.all(|of| match self.follow(of.value, of.function) {
                            (Expr::Call(call), _) => self.is_sensing(call),
                            _ => false,
                        })
                }
            },
            (Expr::Call(call), _) => self.is_sensing(call),
            _ => false,
        }
    }

    /// Whether a call asks the robot, or what is not in the files.
    fn is_sensing(&self, call: u32) -> bool {
        let of = &self.parsed.calls[call as usize];
        self.callees(of).is_empty() && !makes_position(self.parsed.bytes(of.name))
    }

    fn quantity(&self, text: &[u8], function: FunctionId) -> Quantity {
        let mut of = |variable| self.value_of(variable);
        self.evaluated(text, function, &mut of, &mut |_| None)
    }

    fn value_of(&self, variable: u32) -> Quantity {
        self.numbers
            .value(variable, &|written, of| match self.text_of(*written) {
                Some((text, function)) => self.evaluated(text, function, of, &mut |_| None),
                None => Quantity::unknown(),
            })
    }

    fn evaluated(
        &self,
        text: &[u8],
        function: FunctionId,
        of: &mut dyn FnMut(u32) -> Quantity,
        own: &mut dyn FnMut(&[u8]) -> Option<Quantity>,
    ) -> Quantity {
        evaluated(Arithmetic::Real, text, &mut |operand| match operand {
            Operand::Name(name) => {
                let name = self.parsed.known_symbol(name);
                let variable = name.and_then(|name| self.meaning(name, function));
                Some(variable.map_or_else(Quantity::unknown, &mut *of))
            }
            Operand::Other(operand) => own(operand).or_else(|| self.operand(operand, function, of)),
        })
    }

    /// The value of an operand that is no name alone; `None` where it is worked out of the numbers
    /// in it.
    fn operand(
        &self,
        operand: &[u8],
        function: FunctionId,
        of: &mut dyn FnMut(u32) -> Quantity,
    ) -> Option<Quantity> {
        if let Some(degrees) = operand.strip_prefix(b"d2r(") {
            let degrees = degrees.strip_suffix(b")")?;
            let exactly = evaluate(degrees, &mut |_| Quantity::unknown())?.exact()?;
            return Some(Quantity::exactly(exactly * DEG));
        }
        let length = operand.iter().take_while(|b| is_letter(**b)).count();
        let (name, rest) = operand.split_at(length);
        match rest.trim_ascii_start() {
            [b'(', ..] if WORKED_OUT.contains(&name) => None,
            [b'(', ..] if makes_position(name) => Some(Quantity::endless()),
            [b'(', ..] => {
                let name = self.parsed.known_symbol(name);
                let own = name.map_or(&[][..], |name| self.functions_of(name, function));
                let all: Vec<_> = own.iter().map(|at| of(RESULT | at)).collect();
                // of the robot, or of files that are not here
                Some(Quantity::any(&all))
            }
            // any number of a pose
            [b'[', inside @ .., b']'] if name == b"p" && memchr::memchr(b',', inside).is_some() => {
                if memchr::memchr(b'[', inside).is_some() {
                    return Some(Quantity::endless());
                }
                let all =
                    parts(inside).map(|part| self.evaluated(part, function, of, &mut |_| None));
                Some(Quantity::any(&all.collect::<Vec<_>>()))
            }
            _ => None,
        }
    }
}

/// Whether the value of a function is a position: one made of others, or where the robot is.
fn makes_position(name: &[u8]) -> bool {
    let mut all = COMPUTING.iter().chain(&PLACES);
    all.any(|begin| name.starts_with(begin))
}

/// What is added along the axes of the base.
pub(super) fn along_base(along: &[Quantity; 3]) -> Displacement {
    let mut by = Displacing::new();
    by.along_frame(along);
    by.displacement()
}

/// What `pose_add` adds whose offset has these numbers; `None` where the text does not tell how it
/// turns.
pub(super) fn in_base(amounts: [Quantity; 6]) -> Option<Displacement> {
    let [x, y, z, rotation @ ..] = amounts;
    let mut by = Displacing::new();
    by.along_frame(&[x, y, z]);
    turn(&rotation, by)
}

/// Likewise `pose_trans`.
pub(super) fn in_tool(amounts: [Quantity; 6]) -> Option<Displacement> {
    let [x, y, z, rotation @ ..] = amounts;
    let mut by = Displacing::new();
    let none = || Quantity::exactly(0.0);
    by.in_tool(&[x, y, z, none(), none(), none()]);
    turn(&rotation, by)
}

fn turn(rotation: &[Quantity; 3], mut by: Displacing) -> Option<Displacement> {
    let [x, y, z] = rotation.each_ref().map(Quantity::exact);
    if let (Some(x), Some(y), Some(z)) = (x, y, z) {
        let endless = super::rotation::endless(&[0.0, 0.0, 0.0, x, y, z], 0);
        if endless.is_some() {
            return None;
        }
        by.in_tool_exactly(Pose::from_rotation(Rotation::from_vector([x, y, z])));
    } else {
        let mut largest = [0.0; 3];
        for (largest, of) in largest.iter_mut().zip(rotation) {
            let (least, most) = of.ends()?;
            *largest = most.abs().max(least.abs());
        }
        by.turned_up_to(norm(largest));
    }
    Some(by.displacement())
}

//! What numbers may be, from all that the text assigns to them.

use super::syntax::{Content, Event, Expr, ExprId, FunctionId};
use super::variables::Variables;
use crate::geometry::units::DEG;
use crate::geometry::{Pose, Rotation, norm};
use crate::program::Displacement;
use crate::program::displacing::Displacing;
use crate::program::numbers::{Blocks, Numbers, Site, evaluated, parts};
use crate::program::quantity::{Arithmetic, Quantity, evaluate};

/// Numbers in a pose.
const OF_POSE: usize = 6;

/// What is written into a number.
#[derive(Clone, Copy, Debug)]
pub(super) enum Written {
    /// By the assignment of this number.
    Assigned(u32),
    /// By a call, which gives it.
    Given { call: u32, position: usize },
}

impl Variables<'_, '_> {
    /// Notes all that is written into variables; each write is one of the assignments.
    pub(super) fn find_numbers(&mut self) {
        let parsed = self.parsed;
        let mut numbers = Numbers::default();
        let mut blocks = Blocks::default();
        for (at, function) in (0..).zip(&parsed.functions) {
            blocks.begin(at);
            for event in &function.events {
                match *event {
                    Event::Assign(number) => {
                        let variable = self.assigned[number as usize];
                        if parsed.assignments[number as usize].part {
                            numbers.lose(variable);
                        } else {
                            let written = Written::Assigned(number);
                            numbers.write(variable, written, Some(blocks.site()));
                        }
                    }
                    Event::If | Event::Never | Event::Switch => blocks.open(Some(1)),
                    Event::Branch { .. } => blocks.branch(),
                    Event::Loop => blocks.open(None),
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
                    let given = Written::Given { call: at, position };
                    numbers.write(parameter, given, Some(Site::at_start(callee)));
                }
            }
        }
        self.numbers = numbers;
    }

    /// What an assignment writes, or what a call gives in its brackets.
    fn text_of(&self, written: Written) -> Option<(&[u8], FunctionId)> {
        match written {
            Written::Assigned(number) => {
                let assignment = &self.parsed.assignments[number as usize];
                let text = self.parsed.text.get(assignment.offset as usize..)?;
                let is_end = |b: &u8| matches!(b, b'\n' | b'\r' | b'#' | b';');
                let end = text.iter().position(is_end).unwrap_or(text.len());
                let start = memchr::memchr(b'=', &text[..end]).map_or(end, |at| at + 1);
                Some((&text[start..end], assignment.function))
            }
            Written::Given { call, position } => {
                let call = &self.parsed.calls[call as usize];
                // arguments by name, or left out, are not followed
                let arguments = self.parsed.arguments_of(call);
                let is_plain = arguments.iter().all(|(name, _)| name.is_none());
                let text = self.parsed.text.get(call.offset as usize..)?;
                let inside = &text[memchr::memchr(b'(', text)? + 1..];
                let part = parts(inside).nth(position).filter(|_| is_plain)?;
                (position < arguments.len()).then_some((part, call.function))
            }
        }
    }

    /// The six numbers of a pose with expressions in it.
    pub(super) fn amounts(
        &self,
        pose: ExprId,
        function: FunctionId,
    ) -> Option<[Quantity; OF_POSE]> {
        let (Expr::Literal(id), function) = self.follow(pose, function) else {
            return None;
        };
        let literal = self.parsed.literal(id);
        if !literal.pose || literal.content != Content::Expressions {
            return None;
        }
        let text = self
            .parsed
            .text
            .get(literal.offset as usize..literal.end as usize)?;
        let open = memchr::memchr(b'[', text)?;
        let inside = text[open + 1..].trim_ascii_end().strip_suffix(b"]")?;
        let parts = parts(inside);
        let all: Vec<_> = parts.map(|part| self.quantity(part, function)).collect();
        all.try_into().ok()
    }

    fn quantity(&self, text: &[u8], function: FunctionId) -> Quantity {
        self.evaluated(text, function, &mut |variable| {
            self.numbers
                .value(variable, &|written, of| match self.text_of(*written) {
                    Some((text, function)) => self.evaluated(text, function, of),
                    None => Quantity::unknown(),
                })
        })
    }

    fn evaluated(
        &self,
        text: &[u8],
        function: FunctionId,
        of: &mut dyn FnMut(u32) -> Quantity,
    ) -> Quantity {
        let mut named = |operand: &[u8]| {
            let name = self.parsed.known_symbol(operand);
            let variable = name.and_then(|name| self.meaning(name, function));
            variable.map_or_else(Quantity::unknown, &mut *of)
        };
        evaluated(Arithmetic::Real, text, &mut named, &mut |operand| {
            let degrees = operand.strip_prefix(b"d2r(")?.strip_suffix(b")")?;
            let exactly = evaluate(degrees, &mut |_| Quantity::unknown())?.exact()?;
            Some(Quantity::exactly(exactly * DEG))
        })
    }
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
        let endless = super::rotation::endless(&[0.0, 0.0, 0.0, x, y, z], false);
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

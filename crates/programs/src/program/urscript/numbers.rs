//! What numbers may be, from all that the text assigns to them.

use super::syntax::{Content, Event, Expr, ExprId, FunctionId};
use super::variables::Variables;
use crate::geometry::{Pose, Rotation};
use crate::program::Displacement;
use crate::program::displacing::Displacing;
use crate::program::numbers::{Blocks, Numbers};
use crate::program::quantity::{Quantity, evaluate};

/// Numbers in a pose.
const OF_POSE: usize = 6;

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
                            numbers.write(variable, number, Some(blocks.site()));
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
        for (at, variable) in (0..).zip(&self.list) {
            if variable.parameter.is_some() {
                numbers.lose(at);
            }
        }
        self.numbers = numbers;
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
        let mut depth = 0_i32;
        let parts = inside.split(|&byte| {
            depth +=
                i32::from(matches!(byte, b'(' | b'[')) - i32::from(matches!(byte, b')' | b']'));
            depth == 0 && byte == b','
        });
        let all: Vec<_> = parts.map(|part| self.quantity(part, function)).collect();
        all.try_into().ok()
    }

    fn quantity(&self, text: &[u8], function: FunctionId) -> Quantity {
        self.evaluated(text, function, &mut |variable| {
            self.numbers.value(variable, &|assignment, of| {
                let assignment = &self.parsed.assignments[*assignment as usize];
                let text = &self.parsed.text[assignment.offset as usize..];
                let end = text
                    .iter()
                    .position(|b| matches!(b, b'\n' | b'\r' | b'#' | b';'));
                let text = &text[..end.unwrap_or(text.len())];
                let start = memchr::memchr(b'=', text).map_or(text.len(), |at| at + 1);
                self.evaluated(&text[start..], assignment.function, of)
            })
        })
    }

    fn evaluated(
        &self,
        text: &[u8],
        function: FunctionId,
        of: &mut dyn FnMut(u32) -> Quantity,
    ) -> Quantity {
        let value = evaluate(text, &mut |operand| {
            let name = self.parsed.known_symbol(operand);
            let variable = name.and_then(|name| self.meaning(name, function));
            variable.map_or_else(Quantity::unknown, &mut *of)
        });
        value.unwrap_or_else(Quantity::unknown)
    }
}

/// What `pose_add` adds whose offset has these numbers; `None` where the text does not tell how it
/// turns.
pub(super) fn in_base(amounts: [Quantity; 6]) -> Option<Displacement> {
    let [x, y, z, rotation @ ..] = amounts;
    let turned = turned(&rotation)?;
    let mut by = Displacing::new();
    by.along_frame(&[x, y, z]);
    by.in_tool_exactly(turned);
    Some(by.displacement())
}

/// Likewise `pose_trans`.
pub(super) fn in_tool(amounts: [Quantity; 6]) -> Option<Displacement> {
    let [x, y, z, rotation @ ..] = amounts;
    let turned = turned(&rotation)?;
    let mut by = Displacing::new();
    let none = || Quantity::exactly(0.0);
    by.in_tool(&[x, y, z, none(), none(), none()]);
    by.in_tool_exactly(turned);
    Some(by.displacement())
}

fn turned(rotation: &[Quantity; 3]) -> Option<Pose> {
    let [x, y, z] = rotation.each_ref().map(Quantity::exact);
    let vector = [x?, y?, z?];
    let is_meant =
        super::rotation::endless(&[0.0, 0.0, 0.0, vector[0], vector[1], vector[2]], false);
    is_meant
        .is_none()
        .then(|| Pose::from_rotation(Rotation::from_vector(vector)))
}

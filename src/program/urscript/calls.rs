//! Calls: moves, tools, loads, and their arguments.

use super::expressions::OTHER;
use super::reader::{Read, Reader};
use super::syntax::{Event, Expr, ExprId, Step, index};
use super::tokens::{Kind, Token};
use super::verbs::{self, Verb};
use crate::program::{Load, Motion};

/// Calls of moves and poses inside each other that a program may have.
const MOST_CALLS: u32 = 16;

/// An argument of a call: its name where it has one, its value, and its first token.
type Argument<'a> = (Option<&'a [u8]>, ExprId, Token);

impl<'a> Reader<'a> {
    /// The arguments of a call whose name was just read: values by position and by name.
    fn arguments(&mut self) -> Read<Vec<Argument<'a>>> {
        let open = self.next()?;
        if self.depth >= MOST_CALLS {
            return Err(self.unexpected(open, "a call inside fewer others"));
        }
        self.depth += 1;
        let arguments = self.arguments_of(open);
        self.depth -= 1;
        arguments
    }

    fn arguments_of(&mut self, open: Token) -> Read<Vec<Argument<'a>>> {
        let mut arguments = Vec::new();
        loop {
            let mut first = self.scanner.peek();
            match first.kind {
                Kind::Line => {
                    self.next()?;
                    continue;
                }
                Kind::Sign(b')') => {
                    self.next()?;
                    return Ok(arguments);
                }
                _ => {}
            }
            let mut name = None;
            if first.kind == Kind::Word {
                let mut ahead = self.scanner;
                let second = ahead.next().and_then(|_| ahead.next());
                if let Ok(second) = second
                    && second.is(b'=')
                    && self.scanner.bytes.get(second.end) != Some(&b'=')
                {
                    name = Some(self.text(first));
                    self.scanner = ahead;
                    first = self.scanner.peek();
                }
            }
            let mut value = self.operand(None)?;
            loop {
                let token = self.next()?;
                match token.kind {
                    Kind::Sign(b',') => {
                        arguments.push((name, value, first));
                        break;
                    }
                    Kind::Sign(b')') => {
                        arguments.push((name, value, first));
                        return Ok(arguments);
                    }
                    Kind::Line => {}
                    Kind::End => return Err(self.unclosed(open.start, "a bracket")),
                    Kind::Word if verbs::starts_block(self.text(token)) => {
                        return Err(self.unclosed(open.start, "a bracket"));
                    }
                    _ => {
                        value = OTHER;
                        self.part(token)?;
                    }
                }
            }
        }
    }

    pub(super) fn pose_call(&mut self, call: verbs::PoseCall) -> Read<ExprId> {
        let arguments = self.arguments()?;
        let at = |position: usize, names: &[&[u8]]| argument(&arguments, position, names);
        let expression = match call {
            verbs::PoseCall::Trans => at(0, &[b"p_from", b"T_from"])
                .zip(at(1, &[b"p_from_to", b"T_from_to"]))
                .map(|(a, b)| Expr::Trans(a, b)),
            verbs::PoseCall::Add => at(0, &[b"p_1"])
                .zip(at(1, &[b"p_2"]))
                .map(|(a, b)| Expr::Add(a, b)),
            verbs::PoseCall::Inverse => at(0, &[b"p_from"]).map(Expr::Inverse),
            verbs::PoseCall::Kinematics => at(0, &[b"x"]).map(|pose| Expr::Kinematics {
                pose,
                near: at(1, &[b"qnear"]),
                tcp: at(4, &[b"tcp", b"tcp_offset"]),
            }),
        };
        Ok(expression.map_or(OTHER, |expression| self.notes.add(expression)))
    }

    /// A call whose name was just read, with its arguments.
    pub(super) fn call(&mut self, name: Token) -> Read<()> {
        let text = self.text(name);
        let verb = verbs::verb(text);
        self.recognised |= verb != Verb::Other;
        let offset = index(name.start);
        match verb {
            Verb::Other => {
                let symbol = self.notes.symbol(text);
                self.event(Event::Call(symbol));
                let open = self.next()?;
                self.brackets(open)
            }
            Verb::Known => {
                let open = self.next()?;
                self.brackets(open)
            }
            Verb::Odd(oddity) => {
                self.notes.oddities.push((oddity, offset));
                let open = self.next()?;
                self.brackets(open)
            }
            Verb::Tool => {
                let arguments = self.arguments()?;
                let pose = argument(&arguments, 0, &[b"pose"]);
                let pose = pose.unwrap_or(OTHER);
                self.event(Event::Tool(pose, offset));
                Ok(())
            }
            Verb::Load => {
                let arguments = self.arguments()?;
                let load = self.load(&arguments);
                self.event(Event::Load(load));
                Ok(())
            }
            Verb::Move(motion) => {
                let arguments = self.arguments()?;
                let names: [&[u8]; 3] = [b"pose", b"q", b"path"];
                let target = argument(&arguments, 0, &names);
                self.step(offset, motion, target, false);
                Ok(())
            }
            Verb::Stream => {
                let arguments = self.arguments()?;
                let target = argument(&arguments, 0, &[b"pose", b"q"]);
                self.step(offset, Motion::Joint, target, true);
                Ok(())
            }
            Verb::Arc => {
                let arguments = self.arguments()?;
                let via = argument(&arguments, 0, &[b"pose_via"]);
                let end = argument(&arguments, 1, &[b"pose_to"]);
                self.step(offset, Motion::ArcVia, via, false);
                self.step(offset, Motion::ArcEnd, end, false);
                Ok(())
            }
        }
    }

    fn step(&mut self, offset: u32, motion: Motion, target: Option<ExprId>, streamed: bool) {
        let target = target.unwrap_or(OTHER);
        self.notes.steps.push(Step {
            offset,
            function: self.function,
            motion,
            target,
            streamed,
        });
        let step = index(self.notes.steps.len() - 1);
        self.event(Event::Step(step));
    }

    /// `set_payload(mass, [x, y, z])` with numbers.
    fn load(&self, arguments: &[Argument]) -> Option<Load> {
        let (mass, cog) = (arguments.first()?, arguments.get(1)?);
        let number = |text: &[u8]| crate::program::number::parse(text);
        let mass_kg = number(self.text(mass.2))?;
        if mass.2.kind != Kind::Number || mass_kg <= 0.0 {
            return None;
        }
        let Expr::Literal(id) = self.notes.expression(cog.1) else {
            return None;
        };
        let literal = self.notes.literal(id);
        let start = literal.offset as usize + 1;
        let rest = &self.scanner.bytes[start..];
        let inside = &rest[..memchr::memchr(b']', &rest[..rest.len().min(400)])?];
        let mut values = inside
            .split(|b| *b == b',')
            .map(<[u8]>::trim_ascii)
            .map(number);
        let cog_m = [values.next()??, values.next()??, values.next()??];
        (literal.elements == 3 && !literal.pose).then_some(Load { mass_kg, cog_m })
    }
}

/// The argument at a position, or by one of its names.
fn argument(arguments: &[Argument], position: usize, names: &[&[u8]]) -> Option<ExprId> {
    let named = arguments
        .iter()
        .find(|(name, _, _)| name.is_some_and(|name| names.contains(&name)));
    let placed = arguments
        .get(position)
        .filter(|(name, _, _)| name.is_none());
    named.or(placed).map(|(_, value, _)| *value)
}

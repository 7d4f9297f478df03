//! Calls: moves, tools, loads, and their arguments.

use super::expressions::MOST_LOOKED_INTO;
use super::reader::{Read, Reader};
use super::syntax::{Called, Cog, Event, Expr, ExprId, OTHER, Payload, Step, Symbol};
use super::tokens::{Kind, Token};
use super::verbs::{self, LoadParts, Verb};
use crate::program::script::short;
use crate::program::{Motion, SpeedZone, number};

/// Calls of moves and poses inside each other that a program may have.
const MOST_CALLS: u32 = 16;

/// An argument of a call.
struct Argument<'a> {
    /// Its name where it has one.
    name: Option<&'a [u8]>,
    value: ExprId,
    text: &'a [u8],
}

impl Argument<'_> {
    /// Its value where that is a number.
    fn number(&self) -> Option<f64> {
        number::parse(self.text)
    }
}

/// Whether a text says that the tool that is set counts, as it does where none is given.
///
/// # Source
/// Universal Robots, script manual, `get_inverse_kin`: `tcp="active_tcp"` is the default.
fn is_active_tcp(text: &[u8]) -> bool {
    let inside = |quote: u8| {
        let text = text.strip_prefix(&[quote]).unwrap_or_default();
        text.strip_suffix(&[quote])
    };
    let inside = inside(b'"').or_else(|| inside(b'\''));
    inside.is_some_and(|text| text.eq_ignore_ascii_case(b"active_tcp"))
}

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
        let may_pass = self.may_pass;
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
                    Kind::Sign(sign @ (b',' | b')')) => {
                        let text = &self.scanner.bytes[first.start..token.start.max(first.start)];
                        self.may_pass = may_pass;
                        // of a call whose values count, and no speed or the like
                        let counts = self.depth < MOST_LOOKED_INTO
                            && name.is_none_or(|name| name.len() > 1 || name == b"q");
                        if value == OTHER && counts {
                            value = self.made_of_names(first.start, token.start);
                        }
                        arguments.push(Argument {
                            name,
                            value,
                            text: text.trim_ascii(),
                        });
                        if sign == b')' {
                            return Ok(arguments);
                        }
                        break;
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
                tcp: given(&arguments, 4, &[b"tcp", b"tcp_offset"])
                    .filter(|tcp| !is_active_tcp(tcp.text))
                    .map(|tcp| tcp.value),
            }),
            // `get_forward_kin()` is of the present joints
            verbs::PoseCall::Actual { is_pose } => {
                arguments.is_empty().then_some(Expr::Actual { is_pose })
            }
        };
        Ok(expression.map_or(OTHER, |expression| self.parsed.add(expression)))
    }

    /// A call whose name was just read, with its arguments; its value.
    pub(super) fn call(&mut self, name: Token) -> Read<ExprId> {
        let text = self.text(name);
        let verb = verbs::verb(text);
        self.recognised |= verb != Verb::Other;
        let offset = short(name.start);
        match verb {
            Verb::Other if self.depth < MOST_LOOKED_INTO && !text.contains(&b'.') => {
                let arguments = self.arguments()?;
                let named = |reader: &mut Self, argument: &Argument<'a>| {
                    let name = argument.name.map(|name| reader.parsed.symbol(name));
                    (name, argument.value)
                };
                let arguments = arguments.iter().map(|one| named(self, one)).collect();
                return Ok(self.called(name, arguments));
            }
            Verb::Other if !text.contains(&b'.') => {
                let open = self.next()?;
                self.brackets(open)?;
                return Ok(self.called(name, Vec::new()));
            }
            Verb::Known | Verb::Other => {
                let open = self.next()?;
                self.brackets(open)?;
            }
            Verb::Tracking(on) => {
                let open = self.next()?;
                self.brackets(open)?;
                self.event(Event::Tracking(on, offset));
            }
            Verb::Force => {
                let open = self.next()?;
                self.brackets(open)?;
                self.parsed.forces.push(offset);
            }
            Verb::Tool => {
                let arguments = self.arguments()?;
                let pose = argument(&arguments, 0, &[b"pose"]);
                self.event(Event::Tool(pose.unwrap_or(OTHER), offset));
            }
            Verb::Load(parts) => {
                let arguments = self.arguments()?;
                let payload = self.payload(&arguments, parts);
                self.event(Event::Load(payload, offset));
            }
            Verb::Gravity => {
                let arguments = self.arguments()?;
                let value = argument(&arguments, 0, &[b"d"]).unwrap_or(OTHER);
                self.parsed.gravities.push((value, self.function, offset));
            }
            Verb::Move(motion, places) => {
                let arguments = self.arguments()?;
                let target = argument(&arguments, 0, &[b"pose", b"q", b"path"]);
                let step = self.step_at(offset, motion, target, &arguments, places);
                self.step(step);
            }
            Verb::Somewhere => {
                let open = self.next()?;
                self.brackets(open)?;
                let step = self.step_at(offset, Motion::Joint, None, &[], verbs::Places::NONE);
                self.step(Step {
                    target: None,
                    ..step
                });
            }
            Verb::Stream => {
                let arguments = self.arguments()?;
                let target = argument(&arguments, 0, &[b"pose", b"q"]);
                let places = verbs::Places::NONE;
                let step = self.step_at(offset, Motion::Joint, target, &arguments, places);
                self.step(Step {
                    streamed: true,
                    ..step
                });
            }
            Verb::Arc(places) => {
                let arguments = self.arguments()?;
                let via = argument(&arguments, 0, &[b"pose_via"]);
                let end = argument(&arguments, 1, &[b"pose_to"]);
                let mode = arguments
                    .iter()
                    .enumerate()
                    .find(|(at, argument)| argument.name.map_or(*at == 5, |name| name == b"mode"));
                let rotates_with_arc = mode.is_some_and(|(_, mode)| mode.number() != Some(0.0));
                for (motion, target) in [(Motion::ArcVia, via), (Motion::ArcEnd, end)] {
                    let step = self.step_at(offset, motion, target, &arguments, places);
                    self.step(Step {
                        rotates_with_arc,
                        ..step
                    });
                }
            }
        }
        Ok(OTHER)
    }

    /// A call of a function that is none of the language; its value.
    pub(super) fn called(
        &mut self,
        name: Token,
        arguments: Vec<(Option<Symbol>, ExprId)>,
    ) -> ExprId {
        let first = short(self.parsed.arguments.len());
        self.parsed.arguments.extend(arguments);
        let symbol = self.parsed.symbol(self.text(name));
        self.parsed.calls.push(Called {
            name: symbol,
            function: self.function,
            offset: short(name.start),
            arguments: first..short(self.parsed.arguments.len()),
        });
        let call = short(self.parsed.calls.len() - 1);
        self.event(Event::Call(call));
        self.parsed.add(Expr::Call(call))
    }

    fn step_at(
        &self,
        offset: u32,
        motion: Motion,
        target: Option<ExprId>,
        arguments: &[Argument],
        places: verbs::Places,
    ) -> Step {
        let find = |place: Option<usize>, name: &[u8]| {
            let placed = |at: usize| Some(at) == place;
            arguments
                .iter()
                .enumerate()
                .find(|(at, argument)| argument.name.map_or(placed(*at), |known| known == name))
                .map(|(_, argument)| argument)
        };
        let speed = places.speed.and_then(|_| find(places.speed, b"v"));
        let radius = places.radius.and_then(|_| find(places.radius, b"r"));
        // with a time for the whole path the speed is not obeyed
        let time = places.time.and_then(|_| find(places.time, b"t"));
        let is_timed = time.is_some_and(|time| time.number() != Some(0.0));
        let speed_zone = if places.radius.is_none() {
            SpeedZone::default()
        } else {
            // not given is none: the robot stops; a variable says how far
            let zone_m = radius.map_or(Some(0.0), Argument::number);
            SpeedZone {
                speed_m_s: speed.filter(|_| !is_timed).and_then(Argument::number),
                zone_m,
                blends: zone_m.is_none(),
            }
        };
        let end = self.scanner.at;
        let text = &self.scanner.bytes[offset as usize..end];
        let is_broken = memchr::memchr3(b'\n', b'\r', b'#', text).is_some();
        Step {
            offset,
            end: short(end),
            motion,
            target: Some(target.unwrap_or(OTHER)),
            streamed: false,
            rotates_with_arc: false,
            speed_zone,
            repeatable: !is_timed && !is_broken,
        }
    }

    fn step(&mut self, step: Step) {
        self.parsed.steps.push(step);
        let step = short(self.parsed.steps.len() - 1);
        self.event(Event::Step(step));
    }

    /// What a call says of the load; what the robot reports of it stays as it is. Without a centre
    /// of gravity the tool's origin is it.
    ///
    /// # Source
    /// Universal Robots, "The `URScript` Programming Language", `set_payload`, `set_payload_mass`,
    /// `set_payload_cog`, `set_target_payload`.
    fn payload(&mut self, arguments: &[Argument], parts: LoadParts) -> Payload {
        let mass = match given(arguments, 0, &[b"m", b"mass"]) {
            _ if parts == LoadParts::Cog => None,
            None => Some(OTHER),
            Some(mass) if self.is_call_of(b"get_target_payload", mass.value) => None,
            Some(mass) => Some(match mass.number() {
                Some(number) => self.parsed.add(Expr::Number(number)),
                None => mass.value,
            }),
        };
        let position = usize::from(parts == LoadParts::Both);
        let cog = match argument(arguments, position, &[b"cog", b"CoG"]) {
            _ if parts == LoadParts::Mass => Cog::Stays,
            None if parts == LoadParts::Both => Cog::Tool,
            Some(cog) if self.is_call_of(b"get_target_payload_cog", cog) => Cog::Stays,
            cog => Cog::At(cog.unwrap_or(OTHER)),
        };
        Payload { mass, cog }
    }

    fn is_call_of(&self, name: &[u8], value: ExprId) -> bool {
        let Expr::Call(call) = self.parsed.expression(value) else {
            return false;
        };
        self.parsed.bytes(self.parsed.calls[call as usize].name) == name
    }
}

/// The argument at a position, or by one of its names.
fn given<'g, 'a>(
    arguments: &'g [Argument<'a>],
    position: usize,
    names: &[&[u8]],
) -> Option<&'g Argument<'a>> {
    let named = arguments
        .iter()
        .find(|argument| argument.name.is_some_and(|name| names.contains(&name)));
    let placed = arguments
        .get(position)
        .filter(|argument| argument.name.is_none());
    named.or(placed)
}

/// Its value.
fn argument(arguments: &[Argument], position: usize, names: &[&[u8]]) -> Option<ExprId> {
    given(arguments, position, names).map(|argument| argument.value)
}

//! Moves: what goes where with what.

use super::reader::Reader;
use super::remarks::{OTHER_MOVE, RELATIVE, SEARCH, TURNED};
use super::sections::Statement;
use super::targets::Position;
use crate::geometry::units::DEG;
use crate::program::contexts::Varied;
use crate::program::script::{Expr, Held, Instruction, Modal, Remark, Span, Turn, Variable, short};
use crate::program::transformations::{Steps, exactly};
use crate::program::words::Words;
use crate::program::{Motion, Source};

/// What a move does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Verb {
    /// `JMOVE p`, `LMOVE p`, `HMOVE p`: the motion, and whether the orientation is free on the way.
    To(Motion, bool),
    /// `C1MOVE p`, `C2MOVE p`: whether the arc ends there.
    Arc(bool),
    /// `LAPPRO p,mm`
    Near(Motion),
    /// `LDEPART mm`
    Away(Motion),
    /// `DRAW x,y,z`, `TDRAW x,y,z`: whether along the axes of the tool.
    Draw(bool),
    /// `XMOVE p TILL signal`
    Search,
    /// Others: of conveyors, of two robots, weaving, arc welding, steps of other kinds.
    Other,
    /// `DRIVE joint,degrees`: one joint turns.
    Drive,
    /// `ALIGN`, `HOME`
    Elsewhere,
    /// A step of a taught program: `JOINT SPEED9 ACCU1 TOOL1 … #[…]`.
    Step(Motion),
}

impl Verb {
    /// The move that a statement is.
    pub(super) fn of(statement: &Statement) -> Option<Self> {
        let words = statement.words;
        let step = |motion| match step_target(words) {
            Some(_) => Some(Self::Step(motion)),
            // `joint = 3` and `joint[1] = 3` set a variable
            None => (words.len() > 1 && !is_variable(words)).then_some(Self::Other),
        };
        Some(match statement.keyword {
            "JMove" => Self::To(Motion::Joint, false),
            "LMove" => Self::To(Motion::Linear, false),
            "HMove" => Self::To(Motion::Linear, true),
            "C1move" => Self::Arc(false),
            "C2move" => Self::Arc(true),
            "JAppro" => Self::Near(Motion::Joint),
            "LAppro" => Self::Near(Motion::Linear),
            "JDepart" => Self::Away(Motion::Joint),
            "LDepart" => Self::Away(Motion::Linear),
            "DRAw" => Self::Draw(false),
            "TDraw" => Self::Draw(true),
            "Xmove" => Self::Search,
            "" if is_other(words) => Self::Other,
            "DRIve" => Self::Drive,
            "ALign" | "HOme" => Self::Elsewhere,
            "JOINT" => step(Motion::Joint)?,
            "LINEAR" | "LIN2" => step(Motion::Linear)?,
            "CIR1" => step(Motion::ArcVia)?,
            "CIR2" => step(Motion::ArcEnd)?,
            _ => return None,
        })
    }
}

/// Moves of arc welding, which start, weave and end seams, and taught steps of other kinds.
///
/// # Source
/// Kawasaki AS Language Reference Manual, arc welding (90209-1018DED). *Not verified on a
/// controller.*
const OTHERS: &[&[u8]] = &[
    b"JWS", b"LWS", b"LWC", b"LWE", b"C1WC", b"C2WC", b"C2WE", b"FLIN", b"FJOINT", b"FCIR1",
    b"FCIR2",
];

/// Whether a statement that is not known moves: by its name (`FLMOVE p`, `CVLAPPRO p,50`), or as
/// taught steps do (`… SPEED9 ACCU1 …`).
fn is_other(words: Words) -> bool {
    let word = words.text(0).to_ascii_uppercase();
    let mut endings = [&b"MOVE"[..], b"APPRO", b"DEPART"].into_iter();
    let has = |name: &[u8]| (1..words.len()).any(|at| is_numbered(words.text(at), name));
    let is_step = || has(b"SPEED") && has(b"ACCU");
    let mut is_named =
        || endings.any(|ending| word.ends_with(ending)) || OTHERS.contains(&&word[..]);
    !is_variable(words) && (is_named() || is_step())
}

/// Whether a statement sets the variable that it begins with.
fn is_variable(words: Words) -> bool {
    words.is(1, b'=') || words.is(1, b'[')
}

/// Whether a word is a name with a number behind it: `SPEED9`.
fn is_numbered(word: &[u8], name: &[u8]) -> bool {
    let start = word.get(..name.len());
    start.is_some_and(|start| start.eq_ignore_ascii_case(name))
        && word.get(name.len()).is_some_and(u8::is_ascii_digit)
}

/// Where the joints of a taught step stand: `#[…]`, `#name`.
fn step_target(part: Words) -> Option<usize> {
    let is_joints = |at: &usize| {
        let behind = part.is(at + 1, b'[') || part.is_name(at + 1);
        part.is(*at, b'#') && behind && !is_variable(part)
    };
    (1..part.len()).find(is_joints)
}

impl<'a> Reader<'a> {
    /// A statement that moves.
    pub(super) fn moves(&mut self, part: Words<'a, '_>, verb: Verb) {
        let list = part.behind(1).list();
        let first = list.first().copied().unwrap_or(part.part(0..0));
        let second = list.get(1).copied().unwrap_or(part.part(0..0));
        match verb {
            Verb::To(motion, is_free) => {
                if is_joints(first) {
                    // joints say the configuration themselves
                    self.switch(true);
                }
                let found = self.position(first);
                self.go(part, Some(first), &found, motion, is_free, None);
            }
            Verb::Arc(is_end) => {
                let motion = if is_end {
                    Motion::ArcEnd
                } else {
                    Motion::ArcVia
                };
                let found = self.position(first);
                let mut modal = self.modal_of(motion, &found);
                if !is_end {
                    modal.guards = self.chains;
                }
                self.go(part, Some(first), &found, motion, false, Some(modal));
                self.end_part(is_end);
            }
            Verb::Near(motion) => {
                let found = self.position(first).in_tool(self.back(second));
                self.go(part, None, &found, motion, false, None);
            }
            Verb::Away(motion) => {
                let found = self.stands().in_tool(self.back(first));
                self.relative(part, &found, motion);
            }
            Verb::Draw(in_tool) => {
                let last = self.stands();
                // behind the angles stands how fast
                let by = self.quantities(&list[..list.len().min(6)]);
                let found = if in_tool {
                    last.in_tool(by.map(Steps::one))
                } else {
                    let angles = by.clone().map(|[.., a, b, c]| [a, b, c]);
                    last.along(by.map(|[x, y, z, ..]| [x, y, z])).turned(angles)
                };
                self.relative(part, &found, Motion::Linear);
            }
            Verb::Search | Verb::Other => {
                let till = first.find(b"TILL").unwrap_or(first.len());
                let mut found = self.position(first.part(0..till));
                let why = || match verb {
                    Verb::Other => OTHER_MOVE,
                    _ => SEARCH,
                };
                if matches!(found.base, Expr::Unknown(_)) {
                    found = Position::plain(self.unknown(why()));
                }
                let modal = self.refused(why(), Motion::Linear, &found);
                self.go(part, None, &found, Motion::Linear, false, Some(modal));
                self.here.last = None;
            }
            Verb::Drive => self.drive(part, first, second),
            Verb::Elsewhere => {
                let unknown = Position::plain(self.unknown(RELATIVE));
                self.relative(part, &unknown, Motion::Joint);
            }
            Verb::Step(motion) => {
                let at = step_target(part).expect("it was found");
                // its joints say the configuration themselves
                self.switch(true);
                let target = part.behind(at);
                let is_tool =
                    |name: &&[u8]| name.len() > 4 && name[..4].eq_ignore_ascii_case(b"TOOL");
                let tool = (0..part.len()).map(|at| part.text(at)).find(is_tool);
                let found = self.position(target);
                let mut modal = self.modal_of(motion, &found);
                if let Some(tool) = tool {
                    modal.tool = self.frame_value(&Source::text(tool), None);
                }
                self.go(part, Some(target), &found, motion, false, Some(modal));
            }
        }
    }

    /// One joint turns from where the robot stands, by degrees.
    ///
    /// # Source
    /// Kawasaki AS Language Reference Manual (90209-1022DED), DRIVE.
    fn drive(&mut self, part: Words<'a, '_>, joint: Words<'a, '_>, by: Words<'a, '_>) {
        let [joint, by] = [joint, by].map(|of| self.quantity(of).exact());
        let of_six = (1..=6)
            .zip(0..)
            .find(|(number, _)| joint == Some(f64::from(*number)));
        let turned = of_six.zip(by).map(|((_, at), by): ((i32, usize), f64)| {
            let mut turned = [Turn::Stays; 6];
            turned[at] = Turn::By(by * DEG);
            Box::new(turned)
        });
        let remark = turned.as_ref().map_or(RELATIVE, |_| TURNED);
        let unknown = Position::plain(self.unknown(remark));
        let modal = self.modal_of(Motion::Joint, &unknown);
        let whole = part.span();
        let instruction = Instruction {
            end: short(whole.end),
            target: unknown.base,
            turned,
            ..Instruction::at(self.place(whole.start))
        };
        self.builder.go(instruction, modal);
        self.here.last = None;
    }

    /// A move from where the robot stands.
    fn relative(&mut self, part: Words<'a, '_>, to: &Position, motion: Motion) {
        self.go(part, None, to, motion, false, None);
        if matches!(to.base, Expr::Unknown(_)) {
            self.here.last = None;
        }
    }

    /// Where the robot stands: on a target as far as the text before tells.
    fn stands(&mut self) -> Position {
        let last = self.here.last.take();
        last.unwrap_or_else(|| Position::plain(self.unknown(RELATIVE)))
    }

    /// With what a move to a position runs.
    fn modal_of(&mut self, motion: Motion, to: &Position) -> Modal {
        let configured = match motion {
            Motion::Joint => Expr::Value(self.honoured),
            _ => Expr::Absent,
        };
        Modal {
            tool: Expr::Variable(self.tool),
            frame: Expr::Variable(to.on.map_or(self.base, |(frame, _)| frame)),
            load: Expr::Variable(self.load),
            configured,
            guards: self.switches,
            speed_zone: self.here.next.take().unwrap_or(self.here.always),
            ..Modal::default()
        }
    }

    /// Likewise of one that something speaks against.
    fn refused(&mut self, remark: Remark, motion: Motion, to: &Position) -> Modal {
        let place = self.place(self.here.at);
        let script = &mut self.builder.script;
        let remark = script.remark(remark);
        let value = script.held(Held::Remark(remark));
        let reason = script.variable(Variable::new("move", place, value));
        Modal {
            guards: script.guard([reason]),
            ..self.modal_of(motion, to)
        }
    }

    /// A move to a position, which stands in the text by itself where it is named.
    fn go(
        &mut self,
        part: Words<'a, '_>,
        named: Option<Words<'a, '_>>,
        to: &Position,
        motion: Motion,
        is_free: bool,
        modal: Option<Modal>,
    ) {
        let target = self.expr(to);
        let modal = modal.unwrap_or_else(|| self.modal_of(motion, to));
        // on a plate another object may stand in the place of this one
        let named = named.map(|named| self.on_plate(named).map_or(named, |(.., words)| words));
        let (whole, named) = (part.span(), named.map_or(0..0, |named| named.span()));
        let instruction = Instruction {
            end: short(whole.end),
            motion,
            free_orientation: is_free,
            target,
            target_span: Span::of(named),
            ..Instruction::at(self.place(whole.start))
        };
        self.builder.go(instruction, modal);
        self.here.last = Some(to.clone());
    }

    /// Back along the tool, mm.
    fn back(&self, by: Words<'a, '_>) -> Varied<Steps> {
        self.quantities(&[by]).map(|[by, ..]| {
            let mut step = exactly([0.0; 6]);
            step[2] = by.times(-1.0);
            Steps::one(step)
        })
    }
}

/// Whether words are joints: `#p`, `.#p`, `#[…]`.
pub(super) fn is_joints(part: Words) -> bool {
    part.is(0, b'#') || part.is_word(0, b".") && part.is(1, b'#')
}

//! Moves: `movej(target,tool,mdesc)`, `movel(point,tool,mdesc)`, `movec(via,end,tool,mdesc)`.

use super::data::Kind;
use super::line::{Index, Line};
use super::reader::Reader;
use super::remarks::move_not_known;
use super::targets::Place;
use crate::program::script::{Expr, Instruction, Modal, Script, Span, short};
use crate::program::{Motion, Source, SpeedZone};

/// What a move is called.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Verb {
    /// `None`: it is not known.
    motion: Option<Motion>,
    /// The running program alters the path.
    alters: bool,
}

impl Verb {
    /// The move of a name; `None` where it is none.
    pub(super) fn of(name: &[u8]) -> Option<Self> {
        let (alters, plain) = match name {
            b"alterMovej" => (true, &b"movej"[..]),
            b"alterMovel" => (true, &b"movel"[..]),
            b"alterMovec" => (true, &b"movec"[..]),
            _ => (false, name),
        };
        let motion = match plain {
            b"movej" => Some(Motion::Joint),
            b"movel" => Some(Motion::Linear),
            b"movec" => Some(Motion::ArcEnd),
            _ => {
                let stem = plain.strip_prefix(b"$").unwrap_or(plain);
                let is_move = stem.starts_with(b"mov")
                    && matches!(stem.get(3..5), Some(b"ej" | b"el" | b"ec"));
                return is_move.then_some(Self {
                    motion: None,
                    alters: false,
                });
            }
        };
        Some(Self { motion, alters })
    }
}

impl<'a> Reader<'a> {
    /// The move at a word.
    pub(super) fn moves(&mut self, line: &Line<'a, '_>, at: usize, verb: Verb) {
        let (arguments, close) = line.list(at + 1);
        let last = line.tokens[close.min(line.tokens.len() - 1)];
        // the statement is the move where nothing but its result is kept
        let is_result = line
            .reference(0)
            .is_some_and(|result| line.is(result.words, b'=') && result.words + 1 == at);
        let first = if is_result { 0 } else { at };
        let place = self.place(line.tokens[first].start);
        let mut instruction = Instruction {
            end: short(last.end),
            ..Instruction::at(place)
        };
        let (via, rest) = match (verb.motion, &arguments[..]) {
            (Some(Motion::ArcEnd), [via, rest @ ..]) if rest.len() == 3 => (Some(via), rest),
            (Some(Motion::Joint | Motion::Linear), rest) if rest.len() == 3 => (None, rest),
            _ => {
                let name = Source::text(line.text(at));
                instruction.target = self.unknown(move_not_known(&name));
                self.builder.go(instruction, Modal::default());
                return;
            }
        };
        let [end, tool, mdesc] = rest else {
            unreachable!("the arms above have three")
        };
        let (tool, _) = self.tool(tool);
        let mut modal = Modal {
            tool,
            speed_zone: self.speed_zone(mdesc),
            guards: if verb.alters {
                self.variables.altered
            } else {
                0
            },
            ..Modal::default()
        };
        if let Some(via) = via {
            let through = Instruction {
                motion: Motion::ArcVia,
                ..instruction.clone()
            };
            self.go(through, modal, via);
        }
        instruction.motion = verb.motion.expect("the arms above have one");
        if instruction.motion == Motion::Joint {
            modal.configured = Expr::Value(self.variables.honoured);
        }
        self.go(instruction, modal, end);
    }

    fn go(&mut self, mut instruction: Instruction, modal: Modal, target: &Line<'a, '_>) {
        let joints = match instruction.motion {
            Motion::Joint => self.joints(target),
            _ => None,
        };
        let (value, roots) = match joints {
            Some(joints) => (joints, Vec::new()),
            None => self.position(target),
        };
        instruction.target = value;
        if let (Some(first), Some(last)) = (target.tokens.first(), target.tokens.last()) {
            instruction.target_span = Span {
                start: short(first.start),
                end: short(last.end),
            };
        }
        let number = short(self.builder.script.instructions.len());
        self.roots.push((number, roots));
        self.builder.go(instruction, modal);
    }

    /// Speed and corner of a descriptor.
    fn speed_zone(&self, text: &Line<'a, '_>) -> SpeedZone {
        let somehow = SpeedZone {
            blends: true,
            ..SpeedZone::default()
        };
        let Some(name) = text.reference(0) else {
            return somehow;
        };
        let Place::Datum(datum) = self.meaning(&name) else {
            return somehow;
        };
        let of = &self.world.data[datum as usize];
        let key = match name.index {
            Index::None => b"0",
            Index::Key(key) => key,
            Index::Any => return somehow,
        };
        let is_constant = of.kind == Kind::Mdesc && !self.assigned.contains(&datum);
        match of.element(key).filter(|_| is_constant) {
            Some(at) => of.elements[at].speed_zone,
            None => somehow,
        }
    }

    /// The script: moves get the frames of their points once all copies are known.
    pub(super) fn finish(mut self) -> Script {
        for (instruction, roots) in std::mem::take(&mut self.roots) {
            let frame = self.frame_of(&roots);
            let script = &mut self.builder.script;
            let of = script.modals[script.instructions[instruction as usize].modal as usize];
            let modal = script.modal(Modal { frame, ..of });
            script.instructions[instruction as usize].modal = modal;
        }
        self.builder.finish()
    }
}

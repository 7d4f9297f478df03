//! Moves: `movej(target,tool,mdesc)`, `movel(point,tool,mdesc)`, `movec(via,end,tool,mdesc)`.

use super::data::Kind;
use super::reader::Reader;
use super::remarks::move_not_known;
use crate::program::script::{Expr, Instruction, Modal, Script, Span, short};
use crate::program::words::Words;
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
    /// The move at a word, with its result where that is kept.
    pub(super) fn moves(&mut self, line: Words<'a, '_>, at: usize, verb: Verb) {
        let (inside, words) = line.inside(at + 1);
        let arguments = inside.list();
        let is_result = super::code::Reference::of(line)
            .is_some_and(|result| line.is(result.words, b'=') && result.words + 1 == at);
        let whole = line.part(if is_result { 0 } else { at }..at + 1 + words);
        let mut instruction = Instruction {
            end: short(whole.span().end),
            ..Instruction::at(self.place(whole.span().start))
        };
        let (motion, via, [end, tool, mdesc]) = match (verb.motion, &arguments[..]) {
            (Some(Motion::ArcEnd), &[via, ref rest @ ..]) if rest.len() == 3 => {
                (Motion::ArcEnd, Some(via), [rest[0], rest[1], rest[2]])
            }
            (Some(motion @ (Motion::Joint | Motion::Linear)), &[end, tool, mdesc]) => {
                (motion, None, [end, tool, mdesc])
            }
            _ => {
                let name = Source::text(line.text(at));
                instruction.target = self.unknown(move_not_known(&name));
                self.builder.go(instruction, Modal::default());
                return;
            }
        };
        let mut modal = Modal {
            tool: self.tool(tool),
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
        instruction.motion = motion;
        if motion == Motion::Joint {
            modal.configured = Expr::Value(self.variables.honoured);
        }
        self.go(instruction, modal, end);
    }

    fn go(&mut self, mut instruction: Instruction, modal: Modal, target: Words<'a, '_>) {
        let joints = match instruction.motion {
            Motion::Joint => self.joints(target),
            _ => None,
        };
        instruction.target = joints.unwrap_or_else(|| self.position(target));
        instruction.target_span = Span::of(target.span());
        self.builder.go(instruction, modal);
    }

    /// Speed and corner of a descriptor.
    fn speed_zone(&self, mdesc: Words<'a, '_>) -> SpeedZone {
        let somehow = SpeedZone {
            blends: true,
            ..SpeedZone::default()
        };
        self.constant(mdesc, Kind::Mdesc)
            .map_or(somehow, |known| known.speed_zone)
    }

    /// The script, once all copies are known.
    pub(super) fn finish(mut self) -> Script {
        let by_calls = std::mem::take(&mut self.by_calls);
        by_calls.hand_over(&self.entries.given, &mut self.builder.script);
        self.settle_composed();
        self.refuse_arrays();
        self.settle_framing();
        self.frame_points();
        self.tell_apart();
        self.builder.finish()
    }
}

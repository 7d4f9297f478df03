//! What one instruction does, as far as it concerns positions.

use super::lines::{Line, index, whole, words};

/// A position that an instruction names.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operand {
    /// `C00012`
    C(u32),
    /// `P012` or `PX012`
    P(u32),
    /// `P[I000]`, `LP000`: only the running program knows.
    Computed,
}

/// What a move does beside going to its position.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    Joint,
    Linear,
    Circular,
    /// `SMOVL`: the path is relative to a station or another robot.
    Coordinated,
    /// `IMOV`
    Incremental,
    /// `... SRCH RIN#(1)=ON`
    Search,
    /// `... +MOVL C00002`: a position of a second robot.
    SecondRobot,
    Other,
}

/// One thing that the instructions do, in the order of the text.
#[derive(Clone, Copy, Debug)]
pub enum Event<'a> {
    Move {
        offset: u32,
        kind: Kind,
        operand: Operand,
        /// The base axes go along, to the `BC` position of this number.
        base: Option<u32>,
    },
    /// A move that names no position of the robot, or one that cannot be told.
    BlindMove {
        offset: u32,
    },
    /// Something puts a new value into a position variable.
    Assign {
        offset: u32,
        operand: Operand,
    },
    /// A value is computed from a position variable.
    Copy {
        offset: u32,
        from: u32,
    },
    /// `MFRAME UF#(n)`; `None` where only the running program knows n.
    SetFrame {
        offset: u32,
        number: Option<u32>,
    },
    /// `SETTOOL TL#(n)`
    SetTool {
        offset: u32,
        number: Option<u32>,
    },
    ShiftOn,
    ShiftOff,
    /// `*NAME`, or the start of a loop.
    Label,
    /// To a label of this job.
    Jump,
    Call {
        job: &'a [u8],
    },
    Return,
    OpenBlock {
        is_loop: bool,
    },
    NextBranch,
    CloseBlock {
        is_loop: bool,
    },
}

/// Most letters that a word for a kind of move has.
const LONGEST_VERB: usize = 8;

/// Reads one instruction.
pub fn read<'a>(line: Line<'a>, events: &mut Vec<Event<'a>>) {
    let offset = index(line.start);
    let mut rest = words(line.text);
    let Some(first) = rest.next() else { return };
    if first[0] == b'*' {
        events.push(Event::Label);
        return;
    }
    if is_move(first) {
        moves(line, offset, events);
        return;
    }
    if first[0] == b'L' && first.last().is_some_and(u8::is_ascii_digit) {
        // the name of a local variable, below ///LVARS
        return;
    }
    let second = rest.next().unwrap_or_default();
    let conditional = || words(line.text).skip(1).any(|word| word == b"IF");
    match first {
        b"JUMP" => match second.strip_prefix(b"JOB:") {
            Some(job) => events.extend([Event::Call { job }, Event::Return]),
            None => events.push(Event::Jump),
        },
        b"CALL" => {
            if let Some(job) = second.strip_prefix(b"JOB:") {
                events.push(Event::Call { job });
            }
        }
        b"RET" => events.push(Event::Return),
        b"WHILE" | b"WHILEEXP" | b"FOR" => events.push(Event::OpenBlock { is_loop: true }),
        b"NEXT" | b"ENDWHILE" => events.push(Event::CloseBlock { is_loop: true }),
        b"IFTHEN" | b"IFTHENEXP" | b"SWITCH" => events.push(Event::OpenBlock { is_loop: false }),
        b"ELSE" | b"ELSEIF" | b"ELSEIFEXP" | b"CASE" | b"DEFAULT" => {
            events.push(Event::NextBranch);
        }
        b"ENDIF" | b"ENDSWITCH" => events.push(Event::CloseBlock { is_loop: false }),
        _ if first.starts_with(b"SFTON") => events.push(Event::ShiftOn),
        _ if first.starts_with(b"SFTOF") && !conditional() => events.push(Event::ShiftOff),
        b"MFRAME" => events.push(Event::SetFrame {
            offset,
            number: numbered(second, b"UF#"),
        }),
        b"SETTOOL" => events.push(Event::SetTool {
            offset,
            number: numbered(second, b"TL#"),
        }),
        _ if first.starts_with(b"SET") && second.starts_with(b"UF#") => {
            events.push(Event::SetFrame {
                offset,
                number: numbered(second, b"UF#"),
            });
        }
        _ => {
            if let Some(operand) = operand(second) {
                events.push(Event::Assign { offset, operand });
                let others = rest.filter_map(self::operand);
                events.extend(others.filter_map(|other| match other {
                    Operand::P(from) if Operand::P(from) != operand => {
                        Some(Event::Copy { offset, from })
                    }
                    _ => None,
                }));
            }
        }
    }
}

/// The n of `UF#(n)`.
fn numbered(word: &[u8], prefix: &[u8]) -> Option<u32> {
    let inside = word.strip_prefix(prefix)?.strip_prefix(b"(")?;
    whole(inside.strip_suffix(b")")?)
}

/// Whether a word is MOVJ, SMOVL, +MOVC, IMOV or any other kind of move, known or not.
fn is_move(word: &[u8]) -> bool {
    let verb = word.strip_prefix(b"+").unwrap_or(word);
    verb.len() <= LONGEST_VERB
        && verb.iter().all(u8::is_ascii_alphabetic)
        && memchr::memmem::find(verb, b"MOV").is_some()
}

/// The robot's position that a word names.
fn operand(word: &[u8]) -> Option<Operand> {
    match word {
        [b'C', digits @ ..] => whole(digits).map(Operand::C),
        [b'P', b'[', ..] | [b'P', b'X', b'[', ..] | [b'L', b'P', b'X', ..] => {
            Some(Operand::Computed)
        }
        [b'L', b'P', digits @ ..] => {
            (digits.first() == Some(&b'[') || whole(digits).is_some()).then_some(Operand::Computed)
        }
        [b'P', b'X', digits @ ..] | [b'P', digits @ ..] => whole(digits).map(Operand::P),
        _ => None,
    }
}

/// A line with one or more moves: `MOVL C00001 EC00001 V=100.0 +MOVJ EC00002`.
fn moves(line: Line, offset: u32, events: &mut Vec<Event>) {
    let searches = words(line.text).any(|word| word.starts_with(b"SRCH"));
    let mut is_first = true;
    let mut coordinated = false;
    let mut parts = words(line.text).peekable();
    while let Some(verb) = parts.next() {
        // what stands between moves
        if !is_move(verb) {
            continue;
        }
        let added = verb.starts_with(b"+");
        let kind = match verb.strip_prefix(b"+").unwrap_or(verb) {
            _ if searches => Kind::Search,
            _ if added && coordinated => Kind::Coordinated,
            _ if added => Kind::SecondRobot,
            b"MOVJ" => Kind::Joint,
            b"MOVL" | b"MOVS" => Kind::Linear,
            b"MOVC" => Kind::Circular,
            b"IMOV" => Kind::Incremental,
            [b'S', b'M', b'O', b'V', ..] => Kind::Coordinated,
            _ => Kind::Other,
        };
        coordinated |= kind == Kind::Coordinated;
        let (mut robot, mut base, mut station) = (None, None, false);
        while let Some(word) = parts.next_if(|word| !is_move(word)) {
            if robot.is_none() {
                robot = operand(word);
            }
            match word {
                [b'B', b'C', digits @ ..] => base = whole(digits).or(base),
                [b'B', b'P', ..] | [b'L', b'B', b'P', ..] => base = base.or(Some(u32::MAX)),
                [b'E', b'C' | b'X', ..] | [b'L', b'E', b'X', ..] => station = true,
                _ => {}
            }
        }
        events.extend(match robot {
            Some(operand) => Some(Event::Move {
                offset,
                kind,
                operand,
                base,
            }),
            // a station or the base moves alone, or a form that is not known
            None => (is_first && base.is_none() && !station).then_some(Event::BlindMove { offset }),
        });
        is_first = false;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn events(text: &str) -> Vec<Event<'_>> {
        let mut found = Vec::new();
        let text = text.as_bytes();
        read(Line { start: 0, text }, &mut found);
        found
    }

    fn moved(text: &str) -> Vec<(Kind, Operand)> {
        let found = events(text);
        let moves = found.iter().filter_map(|event| match event {
            Event::Move { kind, operand, .. } => Some((*kind, *operand)),
            _ => None,
        });
        moves.collect()
    }

    #[test]
    fn moves_name_their_position_in_many_ways() {
        for (text, kind, operand) in [
            ("MOVJ C00000 VJ=0.78", Kind::Joint, Operand::C(0)),
            ("MOVL P018 V=I004 PL=0 NWAIT", Kind::Linear, Operand::P(18)),
            ("MOVL BC00001 C00001", Kind::Linear, Operand::C(1)),
            ("MOVC C0003 V=50.0 FPT", Kind::Circular, Operand::C(3)),
            ("MOVS PX002 V=50.0", Kind::Linear, Operand::P(2)),
            ("MOVL P[I000] V=5.0", Kind::Linear, Operand::Computed),
            ("MOVJ LP003 VJ=5.0", Kind::Joint, Operand::Computed),
            ("IMOV P001 V=5.0 RF", Kind::Incremental, Operand::P(1)),
            (
                "MOVL C00001 V=5 SRCH RIN#(1)=ON",
                Kind::Search,
                Operand::C(1),
            ),
            ("SYMOVL C00001 V=5 CV#(1)", Kind::Other, Operand::C(1)),
        ] {
            assert_eq!(moved(text), [(kind, operand)], "{text}");
        }
        assert_eq!(
            moved("SMOVL C00001 BC00001 V=1000.0 +MOVJ EC00001"),
            [(Kind::Coordinated, Operand::C(1))]
        );
        assert_eq!(
            moved("MOVJ C00001 VJ=5 +MOVJ C00002 VJ=5"),
            [
                (Kind::Joint, Operand::C(1)),
                (Kind::SecondRobot, Operand::C(2))
            ]
        );
        assert!(matches!(events("MOVJ EC00001 VJ=5")[..], []));
        assert!(matches!(events("MOVL V=5")[..], [Event::BlindMove { .. }]));
    }

    #[test]
    fn assignments_are_told_from_uses() {
        assert!(matches!(
            events("SETE P070 (3) 100000")[..],
            [Event::Assign {
                operand: Operand::P(70),
                ..
            }]
        ));
        assert!(matches!(
            events("ADD P002 P001")[..],
            [Event::Assign { .. }, Event::Copy { from: 1, .. }]
        ));
        assert!(matches!(events("GETE D000 P000 (3)")[..], []));
        assert!(matches!(events("REFP 1 C00004")[..], []));
        assert!(matches!(
            events("MFRAME UF#(15) P001 P002 P003")[..],
            [Event::SetFrame {
                number: Some(15),
                ..
            }]
        ));
        assert!(matches!(events("SFTON P001 UF#(1)")[..], [Event::ShiftOn]));
    }
}

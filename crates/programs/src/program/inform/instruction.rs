//! The words of instructions: what positions they name, and what they write.

use crate::program::number::whole;

/// A position of the robot that an instruction names.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Operand {
    /// `C00012`
    C(u32),
    /// `P012` or `PX012`
    P(u32),
    /// `LP012` or `LPX012`, a variable of the job
    Local(u32),
    /// `P[I000]`: only the running program knows which.
    AnyP,
    /// `LP[I000]`
    AnyLocal,
}

impl Operand {
    /// The position that a word names.
    pub(super) fn of(word: &[u8]) -> Option<Self> {
        let (is_local, word) = match word {
            [b'L', rest @ ..] => (true, rest),
            _ => (false, word),
        };
        let digits = match word {
            [b'C', digits @ ..] if !is_local => return whole(digits).map(Self::C),
            [b'P', b'X', digits @ ..] | [b'P', digits @ ..] => digits,
            _ => return None,
        };
        let (one, any): (fn(u32) -> Self, _) = if is_local {
            (Self::Local, Self::AnyLocal)
        } else {
            (Self::P, Self::AnyP)
        };
        if digits.first() == Some(&b'[') {
            return Some(any);
        }
        whole(digits).map(one)
    }
}

/// What a move does besides going to its position.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Joint,
    Linear,
    Spline,
    Circular,
    /// `SMOVL`: the path is relative to a station or another robot.
    Coordinated,
    /// `SYMOVL`: the path is relative to a conveyor.
    Conveyor,
    /// `IMOV`
    Incremental,
    /// `... SRCH RIN#(1)=ON`
    Search,
    /// `... +MOVL C00002`: a position of a second robot.
    SecondRobot,
    Other,
}

impl Kind {
    /// The kind that a verb alone tells.
    pub(super) fn of(verb: &[u8]) -> Self {
        match verb {
            b"MOVJ" => Self::Joint,
            b"MOVL" => Self::Linear,
            b"MOVS" => Self::Spline,
            b"MOVC" => Self::Circular,
            b"IMOV" => Self::Incremental,
            [b'S', b'M', b'O', b'V', ..] => Self::Coordinated,
            [b'S', b'Y', b'M', b'O', b'V', ..] => Self::Conveyor,
            _ => Self::Other,
        }
    }
}

/// Most letters that a word for a kind of move has: SVSPOTMOV.
const LONGEST_VERB: usize = 9;

/// Whether a word is MOVJ, SMOVL, +MOVC, IMOV or any other kind of move, known or not.
pub(super) fn is_move(word: &[u8]) -> bool {
    let verb = word.strip_prefix(b"+").unwrap_or(word);
    verb.len() <= LONGEST_VERB
        && verb.iter().all(u8::is_ascii_alphabetic)
        && memchr::memmem::find(verb, b"MOV").is_some()
}

/// What an instruction does to the first thing that it names.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Effect {
    /// It becomes the second; `CNVRT` tells the same place in other coordinates.
    Copy,
    /// It becomes a system variable.
    System,
    /// It becomes what the caller gives.
    Argument,
    /// It becomes the position of a step of the job.
    Taught,
    /// Some of its numbers become others.
    Part,
    /// It becomes what is computed of the others.
    Computed,
    /// Nothing.
    None,
    /// It is not known what: perhaps something.
    Perhaps,
}

/// Instructions with a position variable in front.
///
/// Source: Yaskawa, FS100 instructions, "INFORM explanation", operating, control and shift
/// instructions.
const EFFECTS: &[(&[u8], Effect)] = &[
    (b"SET", Effect::Copy),
    (b"CNVRT", Effect::Copy),
    (b"GETS", Effect::System),
    (b"GETARG", Effect::Argument),
    (b"ADD", Effect::Part),
    (b"SUB", Effect::Part),
    (b"MUL", Effect::Part),
    (b"DIV", Effect::Part),
    (b"SETE", Effect::Part),
    (b"MULMAT", Effect::Computed),
    (b"INVMAT", Effect::Computed),
    (b"CONVSFT", Effect::Computed),
    (b"GETPOS", Effect::Taught),
    (b"COMM", Effect::None),
    (b"REFP", Effect::None),
    (b"PRINT", Effect::None),
    (b"MSG", Effect::None),
];

/// What an instruction does to the position variable in front.
pub(super) fn effect(word: &[u8]) -> Effect {
    let known = EFFECTS.iter().find(|(name, _)| *name == word);
    known.map_or(Effect::Perhaps, |(_, effect)| *effect)
}

/// System variables that hold where the robot is: `$PX000` in pulses, `$PX001` in coordinates. The
/// others are results of searches.
pub(super) fn is_actual(word: &[u8]) -> bool {
    let number = word
        .strip_prefix(b"$PX")
        .or_else(|| word.strip_prefix(b"$P"));
    number.and_then(whole).is_some_and(|number| number < 2)
}

/// The n of `UF#(n)`; `None` where only the running program knows.
pub(super) fn numbered(word: &[u8], prefix: &[u8]) -> Option<u32> {
    let inside = word.strip_prefix(prefix)?.strip_prefix(b"(")?;
    whole(inside.strip_suffix(b")")?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn positions_are_named_in_many_ways() {
        for (text, operand) in [
            ("C00012", Some(Operand::C(12))),
            ("P018", Some(Operand::P(18))),
            ("PX002", Some(Operand::P(2))),
            ("LP003", Some(Operand::Local(3))),
            ("LPX024", Some(Operand::Local(24))),
            ("P[I000]", Some(Operand::AnyP)),
            ("PX[B000]", Some(Operand::AnyP)),
            ("LP[LI001]", Some(Operand::AnyLocal)),
            ("BC00001", None),
            ("PL=0", None),
            ("LC001", None),
            ("P", None),
        ] {
            assert_eq!(Operand::of(text.as_bytes()), operand, "{text}");
        }
    }

    #[test]
    fn verbs_tell_the_kind_of_move() {
        for (verb, kind) in [
            ("MOVJ", Kind::Joint),
            ("MOVS", Kind::Spline),
            ("MOVC", Kind::Circular),
            ("SMOVL", Kind::Coordinated),
            ("IMOV", Kind::Incremental),
            ("SYMOVL", Kind::Conveyor),
            ("EIMOVL", Kind::Other),
            ("SVSPOTMOV", Kind::Other),
            ("SVDRESMOV", Kind::Other),
        ] {
            assert!(is_move(verb.as_bytes()));
            assert_eq!(Kind::of(verb.as_bytes()), kind, "{verb}");
        }
        assert!(is_move(b"+MOVJ") && !is_move(b"SET") && !is_move(b"REMOVE-ALL"));
    }

    #[test]
    fn only_two_system_variables_tell_where_the_robot_is() {
        assert!(is_actual(b"$PX000") && is_actual(b"$PX001"));
        assert!(!is_actual(b"$PX002") && !is_actual(b"$B002"));
    }
}

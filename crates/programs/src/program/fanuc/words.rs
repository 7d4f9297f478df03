//! The words of instructions: positions, indices, numbers.

use crate::program::number;

/// Registers of one program, `LR[1]` and `LPR[1]`, count from here on: no controller has so many.
pub(super) const LOCAL: u32 = 1 << 18;
/// Bytes of an index with its name.
const MOST_INDEX: usize = 256;

/// A position that an instruction names.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Named {
    /// `P[3]`, `P[3:name]`
    Point(u32),
    /// `P[R[1]]`: any point of the program.
    AnyPoint,
    /// `PR[4]`
    Register(Register),
    /// `PAL_1[BTM]`: a position that the controller computes.
    Computed,
}

/// A position register, or one number of it: `PR[4]`, `PR[4,2]`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Register {
    /// `None` where another register says which: `PR[R[1]]`.
    pub number: Option<u32>,
    pub is_element: bool,
}

/// Letters of instructions, of any dictionary.
pub(super) fn is_word(b: u8) -> bool {
    b.is_ascii_alphanumeric() || matches!(b, b'_' | b'$' | b'.') || !b.is_ascii()
}

/// How many bytes of a word a text starts with.
pub(super) fn word_length(text: &[u8]) -> usize {
    text.iter().take_while(|b| is_word(**b)).count()
}

/// The letter of a move, and where the text of its position starts: `J P[`, `L PR[`.
pub(super) fn motion(text: &[u8]) -> Option<(u8, usize)> {
    let letter = text.first()?.to_ascii_uppercase();
    if !b"JLSCA".contains(&letter) {
        return None;
    }
    let blanks = text[1..].iter().take_while(|b| b.is_ascii_whitespace());
    let mut at = 1 + blanks.count();
    // the listing of a pendant marks where the robot is
    at += usize::from(text.get(at) == Some(&b'@'));
    let (named, length) = position(&text[at..])?;
    // `LPR[1]=P[2]` is no move
    let is_assigned = text[at + length..].trim_ascii_start().starts_with(b"=");
    (!is_assigned && (named != Named::Computed || at > 1)).then_some((letter, at))
}

/// The position that a text starts with, and its length.
pub(super) fn position(text: &[u8]) -> Option<(Named, usize)> {
    if text.starts_with(b"LPR[") {
        let (named, length) = position(&text[1..])?;
        let of_program = match named {
            Named::Register(Register { number, is_element }) => Named::Register(Register {
                number: number.and_then(local),
                is_element,
            }),
            other => other,
        };
        return Some((of_program, length + 1));
    }
    if !text.first()?.eq_ignore_ascii_case(&b'P') {
        return None;
    }
    let name = word_length(&text[..text.len().min(MOST_INDEX)]);
    if text.get(name) != Some(&b'[') {
        return None;
    }
    let inside = &text[name + 1..];
    let length = bracket_end(inside)?;
    let index = inside[..length].trim_ascii();
    let named = match &text[1..name] {
        [] => whole(index).map_or(Named::AnyPoint, Named::Point),
        [b'R' | b'r'] => Named::Register(register(index)),
        [b'A' | b'a', b'L' | b'l', b'_', ..] => Named::Computed,
        _ => return None,
    };
    Some((named, name + 1 + length + 1))
}

/// The number by which a register of one program goes.
pub(super) fn local(number: u32) -> Option<u32> {
    number
        .checked_add(LOCAL)
        .filter(|number| *number < 2 * LOCAL)
}

/// `4`, `4:name`, `GP1:4`, `4,2:name`, `R[1]`
pub(super) fn register(index: &[u8]) -> Register {
    let index = behind_group(index);
    let comma = comma_of_element(index);
    Register {
        number: whole(index[..comma.unwrap_or(index.len())].trim_ascii()),
        is_element: comma.is_some(),
    }
}

/// Which number of a register is meant: 2 of `4,2:name`.
pub(super) fn element(index: &[u8]) -> Option<u32> {
    let index = behind_group(index);
    whole(index[comma_of_element(index)? + 1..].trim_ascii())
}

/// The comma behind the number of a register: one may be a part of the name, too.
fn comma_of_element(index: &[u8]) -> Option<usize> {
    let (at, ends) = outside(index).find(|(_, byte)| matches!(byte, b',' | b':'))?;
    (ends == b',').then_some(at)
}

/// The length of what stands before the `]` that closes a bracket: `4,2:name`, `GP1:R[1:name]`.
pub(super) fn bracket_end(inside: &[u8]) -> Option<usize> {
    let inside = &inside[..inside.len().min(MOST_INDEX)];
    let mut at = 0;
    loop {
        match inside.get(at)? {
            b'[' => at += bracket_end(&inside[at + 1..])? + 2,
            b']' => return Some(at),
            b':' if !is_group(&inside[..at]) => {
                return name_end(&inside[at..]).map(|length| at + length);
            }
            _ => at += 1,
        }
    }
}

/// The length of a name, which may have any letters: to the `]` up to which its brackets are in
/// pairs, else to the first.
fn name_end(name: &[u8]) -> Option<usize> {
    let mut depth = 0_u32;
    let paired = name.iter().position(|&b| {
        match b {
            b'[' => depth += 1,
            b']' if depth == 0 => return true,
            b']' => depth -= 1,
            _ => {}
        }
        false
    });
    paired.or_else(|| memchr::memchr(b']', name))
}

/// Whether a text is `GP1`, `GP2`.
fn is_group(text: &[u8]) -> bool {
    let text = text.trim_ascii();
    text.len() > 2
        && text[..2].eq_ignore_ascii_case(b"GP")
        && text[2..].iter().all(u8::is_ascii_digit)
}

/// A whole number, and nothing else but the name behind its colon.
pub(super) fn whole(text: &[u8]) -> Option<u32> {
    let (number, digits) = number::whole_start(text)?;
    let rest = text[digits..].trim_ascii_start();
    (rest.is_empty() || rest[0] == b':').then_some(number)
}

/// The number between the brackets behind a word: 2 of `LBL[2:name]`; `None` where something else
/// says it.
#[allow(clippy::option_option)]
pub(super) fn indexed(text: &[u8]) -> Option<Option<u32>> {
    let inside = text.trim_ascii_start().strip_prefix(b"[")?;
    Some(whole(inside[..bracket_end(inside)?].trim_ascii()))
}

/// Index and value of `[index]=value`.
pub(super) fn assigned(rest: &[u8]) -> Option<(&[u8], &[u8])> {
    let inside = rest.strip_prefix(b"[")?;
    let length = bracket_end(inside)?;
    let value = inside[length + 1..].trim_ascii_start().strip_prefix(b"=")?;
    Some((inside[..length].trim_ascii(), value.trim_ascii()))
}

/// Whether `GP1`, `GP1,GP2` or a text that names no group concerns group 1.
pub(super) fn concerns_group_1(text: &[u8]) -> bool {
    let group = |word: &&[u8]| word.len() > 2 && word[..2].eq_ignore_ascii_case(b"GP");
    let mut groups = text.split(|&b| !is_word(b)).filter(group).peekable();
    groups.peek().is_none() || groups.any(|group| &group[2..] == b"1")
}

/// `6` of `GP1:6`.
pub(super) fn behind_group(index: &[u8]) -> &[u8] {
    let is_group = index.len() > 2 && index[..2].eq_ignore_ascii_case(b"GP");
    match memchr::memchr(b':', index) {
        Some(colon) if is_group => index[colon + 1..].trim_ascii(),
        _ => index,
    }
}

/// The words of a text.
pub(super) fn words(text: &[u8]) -> impl Iterator<Item = &[u8]> {
    text.split(|&b| !is_word(b)).filter(|word| !word.is_empty())
}

/// The bytes of a text outside strings and names, each with where it stands and in how many
/// brackets. In a name an apostrophe or a semicolon is a letter: `DI[1:FIN D'USINAGE;]`.
fn letters(text: &[u8]) -> impl Iterator<Item = (usize, u8, usize)> {
    let mut at = 0;
    let mut is_string = false;
    let mut open = Vec::new();
    std::iter::from_fn(move || {
        loop {
            let byte = *text.get(at)?;
            let here = at;
            at += 1;
            match byte {
                b'\'' => is_string = !is_string,
                _ if is_string => {}
                b'[' if bracket_end(&text[at..]).is_some() => {
                    open.push(at);
                    return Some((here, byte, open.len() - 1));
                }
                b']' => {
                    open.pop();
                    return Some((here, byte, open.len()));
                }
                b':' if open
                    .last()
                    .is_some_and(|start| !is_group(&text[*start..here])) =>
                {
                    let name = &text[at..text.len().min(at + MOST_INDEX)];
                    at += name_end(name).unwrap_or(0);
                    return Some((here, byte, open.len()));
                }
                _ => return Some((here, byte, open.len())),
            }
        }
    })
}

/// The bytes of a text outside strings and brackets, each with where it stands.
pub(super) fn outside(text: &[u8]) -> impl Iterator<Item = (usize, u8)> {
    let outside = letters(text).filter(|(.., depth)| *depth == 0);
    outside.map(|(at, byte, _)| (at, byte))
}

/// Hands over the positions of a text that stand outside strings.
pub(super) fn each_position(text: &[u8], mut take: impl FnMut(Named)) {
    for (at, ..) in letters(text) {
        let alone = at == 0 || !is_word(text[at - 1]);
        if alone && let Some((named, _)) = position(&text[at..]) {
            take(named);
        }
    }
}

/// The first comma that stands outside brackets and strings.
pub(super) fn comma(text: &[u8]) -> Option<usize> {
    let mut open = 0_u32;
    let ends = |&(_, byte): &(usize, u8)| {
        match byte {
            b'(' => open += 1,
            b')' => open = open.saturating_sub(1),
            _ => return open == 0 && byte == b',',
        }
        false
    };
    outside(text).find(ends).map(|(at, _)| at)
}

/// The parts of a text between its commas.
pub(super) fn parts(text: &[u8]) -> impl Iterator<Item = &[u8]> {
    let mut rest = Some(text);
    std::iter::from_fn(move || {
        let text = rest?;
        let end = comma(text);
        rest = end.map(|end| &text[end + 1..]);
        Some(text[..end.unwrap_or(text.len())].trim_ascii())
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn positions_are_points_and_registers_of_group_1() {
        let register = |number, is_element| Named::Register(Register { number, is_element });
        for (text, wanted) in [
            ("P[3]", Named::Point(3)),
            ("P[ 3 : a[b] ]", Named::Point(3)),
            ("P[R[3]]", Named::AnyPoint),
            ("PR[4:home, left]", register(Some(4), false)),
            ("PR[4,2]", register(Some(4), true)),
            ("PR[GP1:4,2:x]", register(Some(4), true)),
            ("PR[R[1:a]]", register(None, false)),
            ("PR[R[1:a],3]", register(None, true)),
            ("PAL_1[BTM]", Named::Computed),
            ("LPR[4,2]", register(Some(LOCAL + 4), true)),
            ("LPR[R[4]]", register(None, false)),
        ] {
            let found = position(text.as_bytes());
            assert_eq!(found, Some((wanted, text.len())), "{text}");
        }
        // any letter may be part of a name
        for name in ["a;b", "off[", "a[b]", "it's", "a,b", "GP2:x", ":"] {
            for (text, wanted) in [
                (format!("P[3:{name}]"), Named::Point(3)),
                (format!("PR[4,2:{name}]"), register(Some(4), true)),
                (format!("PR[R[1:{name}],2:{name}]"), register(None, true)),
            ] {
                let behind = format!("{text}=LPOS ;");
                let found = position(behind.as_bytes());
                assert_eq!(found, Some((wanted, text.len())), "{text}");
            }
        }
        for text in ["", "P", "P[1", "PX[1]", "R[1]", "PAL"] {
            assert_eq!(position(text.as_bytes()), None, "{text}");
        }
    }

    #[test]
    fn moves_start_with_a_letter_and_a_position() {
        for (text, wanted) in [
            ("J P[1] 5%", Some((b'J', 2))),
            ("L   PR[1]", Some((b'L', 4))),
            ("JP[1]", Some((b'J', 1))),
            ("J @P[1] 5%", Some((b'J', 3))),
            ("J PAL_1[A_1] 5%", Some((b'J', 2))),
            ("SPAL_1[1]", None),
            ("L LPR[1] 5%", Some((b'L', 2))),
            ("LPR[1]=P[1]", None),
            ("LBL[1]", None),
            ("CALL P", None),
        ] {
            assert_eq!(motion(text.as_bytes()), wanted, "{text}");
        }
    }

    #[test]
    fn parts_stand_outside_brackets_and_strings() {
        let all: Vec<_> = parts(b"1, R[2,3] ,'a,b',(4,5)").collect();
        assert_eq!(all, [&b"1"[..], b"R[2,3]", b"'a,b'", b"(4,5)"]);
        let all: Vec<_> = parts(b"DI[1:l'a (b,c]=ON,JMP LBL[2:d']").collect();
        assert_eq!(all, [&b"DI[1:l'a (b,c]=ON"[..], b"JMP LBL[2:d']"]);
    }

    #[test]
    fn positions_stand_outside_strings_and_behind_names_with_apostrophes() {
        let of = |text: &[u8]| {
            let mut all = Vec::new();
            each_position(text, |named| all.push(named));
            all
        };
        let register = |number| {
            Named::Register(Register {
                number: Some(number),
                is_element: false,
            })
        };
        assert_eq!(of(b"PR[1:l'axe]+PR[2]"), [register(1), register(2)]);
        assert_eq!(of(b"LOG('P[1]',P[2])"), [Named::Point(2)]);
        assert_eq!(
            of(b"PR[1:P[9]]=MATRIX[P[1:a],PR[GP1:2:b;P[7]]"),
            [register(1), Named::Point(1), register(2)]
        );
    }
}

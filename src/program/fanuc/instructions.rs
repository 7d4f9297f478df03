//! `/MN`: the instructions of a program, as far as they concern points, tools and frames.

use super::points::offset;
use super::sections::line_end;
use std::ops::Range;

/// Which point an instruction names.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Named {
    /// `P[3]`, `P[3:name]`
    Point(u32),
    /// `P[R[1]]`: any point of the program.
    Any,
    /// `PR[..]`: a position register.
    Register,
}

/// How the robot gets to a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Way {
    Joint,
    Linear,
    ArcVia,
    ArcEnd,
    /// `A`: a point of a row that arcs are laid through.
    ArcRow,
}

/// What follows the point in a move, as far as it matters.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Extras {
    /// `Offset`, `Tool_Offset`, `VOFFSET` and the like.
    pub displaced: bool,
    /// `INC`
    pub incremental: bool,
    /// `RTCP`
    pub remote: bool,
    /// `COORD`
    pub coordinated: bool,
    /// `Wjnt`
    pub wrist_joint: bool,
}

/// Tool or work frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Which {
    Tool,
    Frame,
    /// A word of another dictionary that may be either.
    Either,
}

/// What one instruction does.
#[derive(Clone, Debug, PartialEq)]
pub enum Event {
    /// A move to a point.
    Move { way: Way, to: Named, extras: Extras },
    /// `UTOOL_NUM=1`; `None` where a register says which.
    Select { which: Which, number: Option<u32> },
    /// `UFRAME[6]=PR[60]`; `None` where a register says which.
    Assign { which: Which, number: Option<u32> },
    /// A place that the program may come to from elsewhere, or a block that it may pass over.
    Join,
    /// A call of this program, in capitals.
    Call(Box<[u8]>),
    /// `PR[4]=P[2]`
    Copy(Named),
    /// A point in an instruction that is not known.
    Mention(Named),
}

/// Reads the instructions of a section.
pub struct Instructions<'a> {
    bytes: &'a [u8],
    at: usize,
    end: usize,
    text: Vec<u8>,
}

impl<'a> Instructions<'a> {
    /// The instructions in this range.
    pub fn new(bytes: &'a [u8], range: Range<usize>) -> Self {
        Self {
            bytes,
            at: range.start,
            end: range.end,
            text: Vec::new(),
        }
    }

    /// Hands over what each instruction does, with its first byte.
    pub fn each(mut self, mut take: impl FnMut(u32, Event)) {
        while let Some(start) = self.next() {
            let text = std::mem::take(&mut self.text);
            understand(&text, |event| take(offset(start), event));
            self.text = text;
        }
    }

    /// Brings the next instruction's text, its lines joined, into `self.text`; returns its first byte.
    fn next(&mut self) -> Option<usize> {
        self.text.clear();
        loop {
            let (start, _) = self.line_start()?;
            let rest = &self.bytes[start..self.end];
            if rest.starts_with(b"!") || rest.starts_with(b"--") {
                self.at = line_end(self.bytes, start).min(self.end);
                continue;
            }
            self.at = start;
            self.collect();
            return Some(start);
        }
    }

    /// The first byte of what stands behind blanks, empty lines, line number and colon, and whether there was a number.
    fn line_start(&self) -> Option<(usize, bool)> {
        let bytes = &self.bytes[..self.end];
        let mut at = self.at;
        let skip = |at: &mut usize| {
            while bytes
                .get(*at)
                .is_some_and(|b| b.is_ascii_whitespace() || *b == b';')
            {
                *at += 1;
            }
        };
        skip(&mut at);
        let digits = bytes[at..]
            .iter()
            .take_while(|b| b.is_ascii_digit())
            .count();
        let mut behind = at + digits;
        while matches!(bytes.get(behind), Some(b' ' | b'\t')) {
            behind += 1;
        }
        let colon = bytes.get(behind) == Some(&b':');
        if colon {
            at = behind + 1;
            while matches!(bytes.get(at), Some(b' ' | b'\t')) {
                at += 1;
            }
        }
        (at < bytes.len()).then_some((at, colon && digits > 0))
    }

    /// Joins lines up to the `;`. A line with a number of its own, or that starts a move, is another instruction.
    fn collect(&mut self) {
        loop {
            let line = line_end(self.bytes, self.at).min(self.end);
            let rest = &self.bytes[self.at..line];
            if let Some(semicolon) = semicolon(rest) {
                self.text.extend_from_slice(&rest[..semicolon]);
                self.at += semicolon + 1;
                return;
            }
            self.text.extend_from_slice(rest.trim_ascii_end());
            self.text.push(b' ');
            self.at = line;
            let Some((start, numbered)) = self.line_start() else {
                self.at = self.end;
                return;
            };
            let ahead = &self.bytes[start..self.end];
            let other = numbered || motion(ahead).is_some() || ahead.starts_with(b"!");
            if other || self.text.len() > MOST_TEXT {
                return;
            }
            self.at = start;
        }
    }
}

/// Bytes of an index with its name.
const MOST_INDEX: usize = 256;
/// Bytes of an instruction; what is longer is none.
const MOST_TEXT: usize = 1 << 16;

/// The `;` that ends an instruction: not one in a string.
fn semicolon(line: &[u8]) -> Option<usize> {
    let found = memchr::memchr(b';', line)?;
    if memchr::memchr(b'\'', &line[..found]).is_none() {
        return Some(found);
    }
    let mut inside = false;
    let outside = line.iter().position(|&b| {
        inside ^= b == b'\'';
        b == b';' && !inside
    });
    outside.or(Some(found))
}

/// The way of a move and where the text of its point starts: `J P[`, `L PR[`.
fn motion(text: &[u8]) -> Option<(Way, usize)> {
    let way = match text.first()? {
        b'J' | b'j' => Way::Joint,
        b'L' | b'S' | b'l' | b's' => Way::Linear,
        b'C' | b'c' => Way::ArcVia,
        b'A' | b'a' => Way::ArcRow,
        _ => return None,
    };
    let blanks = text[1..].iter().take_while(|b| b.is_ascii_whitespace());
    let at = 1 + blanks.count();
    point(&text[at..]).map(|_| (way, at))
}

/// The point that a text starts with, and its length.
fn point(text: &[u8]) -> Option<(Named, usize)> {
    let register = text.len() > 1 && text[1].eq_ignore_ascii_case(&b'R');
    let open = 1 + usize::from(register);
    if !text.first()?.eq_ignore_ascii_case(&b'P') || text.get(open) != Some(&b'[') {
        return None;
    }
    let inside = &text[open + 1..];
    let length = bracket_end(inside)?;
    let index = inside[..length].trim_ascii();
    let digits = index.iter().take_while(|b| b.is_ascii_digit()).count();
    let behind = index[digits..].trim_ascii_start();
    let named = if register {
        Named::Register
    } else if digits > 0 && (behind.is_empty() || behind[0] == b':') {
        let number = std::str::from_utf8(&index[..digits]).ok()?.parse();
        number.map_or(Named::Any, Named::Point)
    } else {
        Named::Any
    };
    Some((named, open + 1 + length + 1))
}

/// The length of what stands before the `]` that closes a bracket.
fn bracket_end(inside: &[u8]) -> Option<usize> {
    let mut depth = 0_u32;
    inside.iter().take(MOST_INDEX).position(|&b| {
        match b {
            b'[' => depth += 1,
            b']' if depth == 0 => return true,
            b']' => depth -= 1,
            _ => {}
        }
        false
    })
}

/// What an instruction does.
fn understand(text: &[u8], mut take: impl FnMut(Event)) {
    let text = text.trim_ascii();
    if text.starts_with(b"//") || text.is_empty() {
        return;
    }
    if let Some((way, at)) = motion(text) {
        return go(way, &text[at..], take);
    }
    let word = text.iter().take_while(|b| is_word(**b)).count();
    let (name, rest) = (&text[..word], text[word..].trim_ascii_start());
    let name = name.to_ascii_uppercase();
    match (name.as_slice(), rest.first()) {
        (b"LBL", _) => take(Event::Join),
        (b"ELSE" | b"ENDIF" | b"FOR" | b"ENDFOR" | b"SELECT", _) => {
            take(Event::Join);
            calls(text, take);
        }
        (b"JMP" | b"MESSAGE" | b"MSG", _) => {}
        (_, Some(b'=')) if selects(&name).is_some() => {
            let which = selects(&name).expect("just asked");
            let number = whole(rest[1..].trim_ascii());
            take(Event::Select { which, number });
        }
        (b"$MNUTOOLNUM" | b"$MNUFRAMENUM", Some(b'[')) => {
            if let Some((index, value)) = assigned(rest)
                && whole(index).is_none_or(|group| group == 1)
            {
                let which = which_of(&name[3..]);
                let number = whole(value);
                take(Event::Select { which, number });
            }
        }
        (b"$MNUTOOL" | b"$MNUFRAME", Some(b'[')) => {
            if let Some((index, _)) = assigned(rest) {
                assign_variable(&name[3..], index, take);
            }
        }
        (_, Some(b'[')) if assigned(rest).is_some() => {
            let (index, value) = assigned(rest).expect("just asked");
            assignment(&name, index, value, take);
        }
        _ => other(text, take),
    }
}

/// Letters of instructions, of any dictionary.
fn is_word(b: u8) -> bool {
    b.is_ascii_alphanumeric() || matches!(b, b'_' | b'$' | b'.') || !b.is_ascii()
}

/// `UTOOL_NUM` and its translations.
fn selects(name: &[u8]) -> Option<Which> {
    let stem = name.strip_suffix(b"_NUM")?;
    Some(which_of(stem))
}

fn which_of(name: &[u8]) -> Which {
    match name {
        [b'U', b'T', ..] | [b'W', b'K', b'Z', ..] => Which::Tool,
        [b'U', b'F', ..] | [b'B', b'E', b'N', ..] => Which::Frame,
        _ => Which::Either,
    }
}

/// A whole number, and nothing else but the name behind its colon.
fn whole(text: &[u8]) -> Option<u32> {
    let digits = text.iter().take_while(|b| b.is_ascii_digit()).count();
    let rest = text[digits..].trim_ascii_start();
    let plain = rest.is_empty() || rest[0] == b':';
    let number = std::str::from_utf8(&text[..digits]).ok()?.parse().ok();
    number.filter(|_| plain)
}

/// Index and value of `[index]=value`.
fn assigned(rest: &[u8]) -> Option<(&[u8], &[u8])> {
    let inside = &rest[1..];
    let length = bracket_end(inside)?;
    let value = inside[length + 1..].trim_ascii_start().strip_prefix(b"=")?;
    Some((inside[..length].trim_ascii(), value.trim_ascii()))
}

/// `$MNUTOOL[1,3]=…`
fn assign_variable(name: &[u8], index: &[u8], mut take: impl FnMut(Event)) {
    let comma = memchr::memchr(b',', index);
    let (group, number) = comma.map_or((index, &b""[..]), |at| (&index[..at], &index[at + 1..]));
    if whole(group.trim_ascii()).is_none_or(|group| group == 1) {
        let which = which_of(name);
        let number = whole(number.trim_ascii());
        take(Event::Assign { which, number });
    }
}

/// `NAME[index]=value`
fn assignment(name: &[u8], index: &[u8], value: &[u8], mut take: impl FnMut(Event)) {
    let position = point(value).is_some();
    match name {
        b"P" => {
            let named = whole(index).map_or(Named::Any, Named::Point);
            take(Event::Mention(named));
        }
        b"UFRAME" | b"UTOOL" => take(Event::Assign {
            which: which_of(name),
            number: whole(index),
        }),
        b"PR" => mentions(value, |named| take(Event::Copy(named))),
        // a position goes into nothing else, in any dictionary
        _ if position && !element(value) && !is_data(name) => take(Event::Assign {
            which: which_of(name),
            number: whole(index),
        }),
        _ => mentions(value, |named| take(Event::Copy(named))),
    }
}

/// Whether a value is one number of a register: `PR[2,3]`.
fn element(value: &[u8]) -> bool {
    let Some(open) = memchr::memchr(b'[', value) else {
        return false;
    };
    let inside = &value[open + 1..];
    bracket_end(inside).is_some_and(|end| memchr::memchr(b',', &inside[..end]).is_some())
}

/// Registers and signals.
fn is_data(name: &[u8]) -> bool {
    const DATA: [&[u8]; 16] = [
        b"R", b"AR", b"SR", b"VR", b"DO", b"RO", b"GO", b"AO", b"DI", b"RI", b"GI", b"AI", b"F",
        b"M", b"TIMER", b"PR",
    ];
    DATA.contains(&name)
}

/// An instruction that is none of those above.
fn other(text: &[u8], mut take: impl FnMut(Event)) {
    let mut words = text.split(|&b| !is_word(b));
    if words.any(|word| word.eq_ignore_ascii_case(b"THEN")) {
        take(Event::Join);
    }
    calls(text, &mut take);
    mentions(text, |named| take(Event::Mention(named)));
}

/// The programs that a text calls.
fn calls(text: &[u8], mut take: impl FnMut(Event)) {
    let mut call = false;
    let words = text.split(|&b| !is_word(b));
    for word in words.filter(|word| !word.is_empty()) {
        if call {
            take(Event::Call(word.to_ascii_uppercase().into()));
        }
        call = is_call(word);
    }
}

fn is_call(word: &[u8]) -> bool {
    word.eq_ignore_ascii_case(b"CALL") || word.eq_ignore_ascii_case(b"AUFRUF")
}

/// The points that a text names, outside strings.
fn mentions(text: &[u8], mut take: impl FnMut(Named)) {
    let (mut counted, mut quotes) = (0, 0_usize);
    for open in memchr::memmem::find_iter(text, b"P[") {
        quotes += memchr::memchr_iter(b'\'', &text[counted..open]).count();
        counted = open;
        let alone = open == 0 || !is_word(text[open - 1]);
        if alone
            && quotes.is_multiple_of(2)
            && let Some((named, _)) = point(&text[open..])
        {
            take(named);
        }
    }
}

/// A move; the text starts with its point.
fn go(way: Way, text: &[u8], mut take: impl FnMut(Event)) {
    let Some((to, length)) = point(text) else {
        return;
    };
    let mut rest = text[length..].trim_ascii_start();
    let mut second = None;
    if way == Way::ArcVia {
        rest = rest.strip_prefix(b":").unwrap_or(rest).trim_ascii_start();
        if let Some((end, length)) = point(rest) {
            second = Some(end);
            rest = &rest[length..];
        }
    }
    let extras = extras(rest);
    // `C P[1]` without a second point is a row of points as `A` is
    let first = match (way, second) {
        (Way::ArcVia, None) => Way::ArcRow,
        _ => way,
    };
    take(Event::Move {
        way: first,
        to,
        extras,
    });
    if let Some(to) = second {
        let way = Way::ArcEnd;
        take(Event::Move { way, to, extras });
    }
    calls(rest, &mut take);
    mentions(rest, |named| take(Event::Copy(named)));
}

/// The words behind the point; what stands in brackets or is the name of a program that is called is none of them.
fn extras(text: &[u8]) -> Extras {
    let mut extras = Extras::default();
    let (mut at, mut depth, mut call) = (0, 0_u32, false);
    while at < text.len() {
        let byte = text[at];
        match byte {
            b'[' | b'(' => depth += 1,
            b']' | b')' => depth = depth.saturating_sub(1),
            _ => {}
        }
        let length = text[at..].iter().take_while(|b| is_word(**b)).count();
        if length == 0 || depth > 0 {
            at += 1;
            continue;
        }
        let word = &text[at..at + length];
        at += length;
        if !std::mem::replace(&mut call, is_call(word)) {
            extras.word(word);
        }
    }
    extras
}

impl Extras {
    fn word(&mut self, word: &[u8]) {
        let is = |all: &[&[u8]]| all.iter().any(|w| word.eq_ignore_ascii_case(w));
        self.incremental |= is(&[b"INC", b"INK"]);
        self.remote |= is(&[b"RTCP"]);
        self.coordinated |= is(&[b"COORD", b"KOORD"]);
        self.wrist_joint |= is(&[b"WJNT"]);
        let offset = word.len() >= 6 && word[word.len() - 6..].eq_ignore_ascii_case(b"OFFSET");
        self.displaced |= offset;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn events(text: &str) -> Vec<Event> {
        let mut all = Vec::new();
        let bytes = text.as_bytes();
        Instructions::new(bytes, 0..bytes.len()).each(|_, event| all.push(event));
        all
    }

    fn goes(text: &str) -> Vec<(Way, Named)> {
        let moves = events(text).into_iter().filter_map(|event| match event {
            Event::Move { way, to, .. } => Some((way, to)),
            _ => None,
        });
        moves.collect()
    }

    fn extras_of(text: &str) -> Extras {
        match events(text).first() {
            Some(Event::Move { extras, .. }) => *extras,
            other => panic!("{other:?}"),
        }
    }

    use Named::{Any, Point, Register};

    #[test]
    fn moves_are_read_with_and_without_numbers_and_blanks() {
        for text in [
            "   5:J P[1] 100% FINE    ;\n",
            "5: J P[1:a name] 100% CNT100 ;",
            "    :J P[1] 100% FINE ;",
            "J P[1:\"x\"] 5% CNT2 ;\r",
            "\t5:J   P[ 1 : n ] R[5:INC]% CNT R[1] ;",
        ] {
            assert_eq!(goes(text), [(Way::Joint, Point(1))], "{text}");
        }
        let two = "1:L P[1] 100mm/sec FINE\n2:L P[2] 100mm/sec FINE ;\n";
        assert_eq!(
            goes(two),
            [(Way::Linear, Point(1)), (Way::Linear, Point(2))]
        );
        let unnumbered = ":L P[1] 100mm/sec FINE\n:J P[2] 100% FINE ;\n";
        assert_eq!(goes(unnumbered).len(), 2);
        let one_line = "1:L P[1] 9mm/sec FINE ; ! then L P[9] ;\n2:S P[2] 9mm/sec CNT5 ; L P[3] 9mm/sec FINE ;";
        assert_eq!(goes(one_line).len(), 3);
    }

    #[test]
    fn arcs_have_two_points_on_one_line_or_two() {
        for text in [
            "  31:C P[23] \n       P[24] 250mm/sec CNT2 ;\n",
            "  31:C P[23]    \r\n    :  P[24:end] 250mm/sec CNT2 ;\r\n",
            "  31:C P[23] P[24] 250mm/sec CNT2 ;",
        ] {
            assert_eq!(
                goes(text),
                [(Way::ArcVia, Point(23)), (Way::ArcEnd, Point(24))],
                "{text}"
            );
        }
        assert_eq!(goes("1:A P[2] 9mm/sec FINE ;"), [(Way::ArcRow, Point(2))]);
        assert_eq!(
            goes("1:C P[R[1]]\n : PR[2:x] 9mm/sec FINE ;"),
            [(Way::ArcVia, Any), (Way::ArcEnd, Register)]
        );
    }

    #[test]
    fn comments_remarks_and_strings_are_no_instructions() {
        for text in [
            "  1:  !L P[1] 40mm/sec FINE ;\n",
            "  1:  --eg:L P[1] 40mm/sec FINE ;\n",
            "  1:  //L P[1] 40mm/sec FINE ;\n",
            "  1:  MESSAGE[L P[1] now] ;\n",
            "  1:  CALL LOG('P[1]') ;\n  2:   ;\n   : ;\n",
            "  1:  ! no end\n",
        ] {
            let moving = events(text)
                .into_iter()
                .filter(|event| !matches!(event, Event::Call(_)));
            assert_eq!(moving.count(), 0, "{text}");
        }
    }

    #[test]
    fn blocks_inside_moves_are_read_as_instructions() {
        let text = "   5:J P[1] 100% CNT0 ACC100 TB    .10sec,P-SPS    ;\n      1:  TC_ONLINE (ON) ;\n      2:  UFRAME_NUM=3 ;\n       ------ ;\n   6:J P[2] 100% CNT100 ;\n";
        let select = Event::Select {
            which: Which::Frame,
            number: Some(3),
        };
        assert!(events(text).contains(&select));
        assert_eq!(goes(text).len(), 2);
    }

    #[test]
    fn what_follows_a_point_is_told() {
        let plain =
            "L P[1] R[25:INC Offset]mm/sec FINE ACC100 TB .10sec,CALL RTCP(1) Skip,LBL[3:COORD] ;";
        assert_eq!(extras_of(plain), Extras::default());
        assert!(extras_of("J P[1] 100% FINE Tool_Offset,PR[2] ;").displaced);
        assert!(extras_of("J P[1] 100% FINE Offset,PR[60:Corr] ;").displaced);
        assert!(extras_of("J P[1] 100% FINE WKZ_Offset ;").displaced);
        assert!(extras_of("L P[1] 9mm/sec FINE VOFFSET,VR[1] ;").displaced);
        assert!(extras_of("L P[1] 9mm/sec FINE INC ;").incremental);
        assert!(extras_of("L P[1] 9mm/sec FINE RTCP ;").remote);
        assert!(extras_of("L P[1] WELD_SPEED CNT100 COORD PTH ;").coordinated);
        assert!(extras_of("L P[1] 9mm/sec FINE Wjnt ;").wrist_joint);
    }

    #[test]
    fn tools_and_frames_are_selected_and_assigned() {
        use Which::{Either, Frame, Tool};
        let select = |which, number| vec![Event::Select { which, number }];
        let assign = |which, number| vec![Event::Assign { which, number }];
        for (text, wanted) in [
            ("UTOOL_NUM=5 ;", select(Tool, Some(5))),
            ("UFRAME_NUM=R[20:Rack] ;", select(Frame, None)),
            ("WKZ_NUM=24 ;", select(Tool, Some(24))),
            ("BENUTZER_NUM=0 ;", select(Frame, Some(0))),
            ("$MNUTOOLNUM[1]= 1;", select(Tool, Some(1))),
            ("$MNUTOOLNUM[2]= 1;", vec![]),
            ("UFRAME[6]=PR[60] ;", assign(Frame, Some(6))),
            ("UTOOL[R[1]]=PR[60] ;", assign(Tool, None)),
            ("$MNUTOOL[1,3]=PR[2] ;", assign(Tool, Some(3))),
            ("XYZ[6]=PR[60] ;", assign(Either, Some(6))),
            ("R[6]=PR[60,3] ;", vec![]),
            ("PR[4]=P[2:x] ;", vec![Event::Copy(Point(2))]),
            ("P[2]=PR[4] ;", vec![Event::Mention(Point(2))]),
            ("GOTO_P P[7],5 ;", vec![Event::Mention(Point(7))]),
            ("LBL[3:P[1]] ;", vec![Event::Join]),
        ] {
            assert_eq!(events(text), wanted, "{text}");
        }
    }
}

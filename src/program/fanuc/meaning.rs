//! What one instruction does, as far as it concerns points, tools and frames.

use super::instructions::{Event, Extras, Named, Way, Which};

/// Bytes of an index with its name.
const MOST_INDEX: usize = 256;

/// The way of a move and where the text of its point starts: `J P[`, `L PR[`.
pub fn motion(text: &[u8]) -> Option<(Way, usize)> {
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
pub fn understand(text: &[u8], mut take: impl FnMut(Event)) {
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
        (b"LBL" | b"LABEL", _) => take(Event::Join),
        (b"ELSE" | b"ENDIF" | b"FOR" | b"ENDFOR" | b"SELECT", _) => {
            take(Event::Join);
            calls(text, take);
        }
        (b"JMP" | b"SPRUNG" | b"MESSAGE" | b"MSG", _) => {}
        (_, Some(b'=')) if selects(&name).is_some() => {
            let which = selects(&name).expect("just asked");
            let number = whole(rest[1..].trim_ascii());
            take(Event::Select { which, number });
        }
        (_, Some(b'[')) if selects(&name).is_some() && assigned(rest).is_some() => {
            let which = selects(&name).expect("just asked");
            let (groups, value) = assigned(rest).expect("just asked");
            if concerns_group_1(groups) {
                let number = whole(value);
                take(Event::Select { which, number });
            }
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

/// Whether `GP1`, `GP1,GP2` or a text that names no group concerns group 1.
fn concerns_group_1(text: &[u8]) -> bool {
    let group = |word: &&[u8]| word.len() > 2 && word[..2].eq_ignore_ascii_case(b"GP");
    let mut groups = text.split(|&b| !is_word(b)).filter(group).peekable();
    groups.peek().is_none() || groups.any(|group| &group[2..] == b"1")
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
        b"UFRAME" | b"UTOOL" => {
            if concerns_group_1(index) {
                take(Event::Assign {
                    which: which_of(name),
                    number: whole(behind_group(index)),
                });
            }
        }
        b"PR" => mentions(value, |named| take(Event::Copy(named))),
        // a position goes into nothing else, in any dictionary
        _ if position && !element(value) && !is_data(name) => take(Event::Assign {
            which: which_of(name),
            number: whole(index),
        }),
        _ => mentions(value, |named| take(Event::Copy(named))),
    }
}

/// `6` of `GP1:6`.
fn behind_group(index: &[u8]) -> &[u8] {
    let is_group = index.len() > 2 && index[..2].eq_ignore_ascii_case(b"GP");
    match memchr::memchr(b':', index) {
        Some(colon) if is_group => index[colon + 1..].trim_ascii(),
        _ => index,
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
    let first = words.clone().next().unwrap_or_default();
    if words.any(|word| word.eq_ignore_ascii_case(b"THEN")) {
        take(Event::Join);
    }
    for at in memchr::memchr_iter(b',', text) {
        selects_behind(&text[at + 1..], &mut take);
    }
    if is_macro(first, text) {
        take(Event::Call(text.to_ascii_uppercase().into()));
    }
    calls(text, &mut take);
    mentions(text, |named| take(Event::Mention(named)));
}

/// `UTOOL_NUM=2` behind a condition: what is active then is not certain.
fn selects_behind(text: &[u8], mut take: impl FnMut(Event)) {
    let text = text.trim_ascii_start();
    let name = text.iter().take_while(|b| is_word(**b)).count();
    let rest = text[name..].trim_ascii_start();
    if rest.starts_with(b"=") || rest.starts_with(b"[") {
        let which = selects(&text[..name].to_ascii_uppercase());
        if let Some(which) = which {
            let number = None;
            take(Event::Select { which, number });
        }
    }
}

/// Whether an instruction may be a macro of the user's, which is a call: words of the language, and those with an index or
/// an assignment, are none.
fn is_macro(first: &[u8], text: &[u8]) -> bool {
    const KNOWN: [&[u8]; 36] = [
        b"ABORT",
        b"ABBRUCH",
        b"BREAK",
        b"CALL",
        b"AUFRUF",
        b"CASE",
        b"COL",
        b"CONTINUE",
        b"DEFAULT",
        b"ENABLE",
        b"END",
        b"ENDE",
        b"ENDFOR",
        b"IF",
        b"WENN",
        b"JOINT_MAX_SPEED",
        b"LINEAR_MAX_SPEED",
        b"LOCK",
        b"MONITOR",
        b"MOVE",
        b"OFFSET",
        b"OVERRIDE",
        b"PAUSE",
        b"RESET",
        b"RESUME_PROG",
        b"RETURN_PATH_DSBL",
        b"RUN",
        b"SEMAPHORE",
        b"SKIP",
        b"SONST",
        b"STOP",
        b"TOOL_OFFSET",
        b"UNLOCK",
        b"VOFFSET",
        b"WAIT",
        b"WARTEN",
    ];
    let is_known = KNOWN.iter().any(|known| first.eq_ignore_ascii_case(known));
    let plain = !text.iter().any(|b| matches!(b, b'[' | b'='));
    plain && !is_known && first.first().is_some_and(|b| !matches!(b, b'$' | b'-'))
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

//! Statements of a routine, one a line.

use super::aggregate::{self, EXTERNAL};
use super::calls::{is_of_form, only_reads};
use super::frames::Table;
use super::interrupts::Action;
use super::moves::{With, motion};
use super::names::Index;
use super::reader::Reader;
use super::tokens::{Cursor, Kind, Read, Token, capitals};
use crate::program::names::Symbol;
use crate::program::script::{Call, Expr, Held, How, Place, Variable, VariableId, Written};
use crate::program::{ExternalUse, Source, SpeedZone};

/// Whether a number of bits says no axis, by any of the ways to write it.
fn is_no_axis(value: &[u8]) -> bool {
    value.trim_ascii().iter().all(|b| b"0'BbHh ".contains(b))
}

/// Whether a word in capitals starts a move.
pub(super) fn is_motion(word: &[u8]) -> bool {
    motion(word).is_some()
}

/// Words in front of what may stand in brackets, and is no argument.
pub(super) const CONDITIONS: [&[u8]; 7] = [
    b"IF", b"WHILE", b"UNTIL", b"SWITCH", b"CASE", b"RETURN", b"WAIT",
];

fn is_any(name: &[u8], known: &[&[u8]]) -> bool {
    known.iter().any(|known| name.eq_ignore_ascii_case(known))
}

/// Which element `name[..].part=` writes, and which parts, behind the name; `None` where it is no
/// assignment.
fn written(mut cursor: Cursor) -> Option<(Index, Vec<(Token, Index)>)> {
    let at = Index::of(cursor.brackets().ok()?, &cursor);
    let mut parts = Vec::new();
    while cursor.take(b'.') {
        let part = cursor.next();
        // of an FDAT what says nothing of tool and frame
        if is_any(cursor.text(part), &[b"TQ_STATE", b"POINT2"]) {
            return None;
        }
        parts.push((part, Index::of(cursor.brackets().ok()?, &cursor)));
    }
    cursor.take(b'=').then_some((at, parts))
}

/// What an interrupt or trigger does, behind DO: its first word and the rest.
pub(super) fn action(mut cursor: Cursor) -> Option<(Token, Cursor)> {
    loop {
        let token = cursor.next();
        match token.kind {
            Kind::End => return None,
            Kind::Name if cursor.text(token).eq_ignore_ascii_case(b"DO") => break,
            _ => {}
        }
    }
    let name = cursor.next();
    (name.kind == Kind::Name).then_some((name, cursor))
}

/// What stands in front of DO.
fn in_front_of_do(cursor: Cursor) -> Cursor {
    let mut ahead = cursor;
    loop {
        let token = ahead.next();
        let is_do = ahead.text(token).eq_ignore_ascii_case(b"DO");
        if token.kind == Kind::End || is_do {
            return cursor.part(cursor.at, token.start as usize);
        }
    }
}

/// Whether a trigger is at the end of the next move, or at a point of it: `TRIGGER WHEN PATH=-50`,
/// `WHEN DISTANCE=1`.
fn refers_to_end(mut cursor: Cursor) -> bool {
    loop {
        let token = cursor.next();
        match token.kind {
            Kind::End => return true,
            Kind::Name if cursor.text(token).eq_ignore_ascii_case(b"DISTANCE") => {
                return !(cursor.take(b'=') && cursor.text(cursor.peek()) == b"0");
            }
            Kind::Name if cursor.text(token).eq_ignore_ascii_case(b"PATH") => return true,
            _ => {}
        }
    }
}

/// Whether what stands behind DO and a name is read at the end of the file: an assignment, or
/// arguments of a routine.
pub(super) fn is_kept(mut rest: Cursor) -> bool {
    written(rest).is_some() || rest.take(b'(') && rest.blanks() != b')'
}

impl Reader {
    /// Notes which names a statement may write, before any is read.
    pub(super) fn note(&mut self, first: Token, mut cursor: Cursor) {
        let mut buffer = [0; 24];
        let word = capitals(cursor.text(first), &mut buffer);
        let next = cursor.blanks();
        self.note_numbers(word, first, cursor);
        self.note_displacing(cursor);
        self.note_asked(word, cursor);
        let is_spline = matches!(word, b"SPLINE" | b"PTP_SPLINE" | b"ENDSPLINE");
        if (is_motion(word) || is_spline) && !matches!(next, b'=' | b':' | b'.') {
            self.note_loud();
            // WITH $BASE=BASE_DATA[n]
            let line = &cursor.bytes[cursor.at..cursor.end];
            if memchr::memchr(b'[', line).is_some() {
                self.note_indices(cursor);
            }
            // LIN f(XP1)
            if memchr::memchr(b'(', line).is_some() {
                self.note_arguments(cursor);
                self.note_given(first, cursor);
            }
            return;
        }
        match word {
            b"GOTO" | b"ELSE" | b"ENDIF" | b"LOOP" | b"ENDLOOP" | b"EXIT" | b"HALT" => return,
            b"BAS" => {
                self.note_loud();
                while !matches!(cursor.blanks(), 0 | b';' | b',') {
                    cursor.next();
                }
                cursor.take(b',');
                let name = cursor.next();
                if name.kind == Kind::Name {
                    let name = self.symbol(&cursor, name);
                    self.names.choosing.insert(name);
                }
                self.note_arguments(cursor);
                self.note_given(name, cursor);
                return;
            }
            b"INTERRUPT" | b"TRIGGER" => {
                self.note_loud();
                let declares = cursor.text(cursor.peek()).eq_ignore_ascii_case(b"DECL");
                let routine = self.context().routine.filter(|_| declares);
                self.names.interrupted.extend(routine);
                self.concurrent(cursor);
            }
            b"RESUME" => self.names.resumes = true,
            b"FOR" => {
                let name = cursor.next();
                let name = self.symbol(&cursor, name);
                self.names.touched.insert(name);
                self.names.note_own_written(name, self.context());
            }
            _ => {
                if next == b'(' && !CONDITIONS.contains(&word) {
                    let name = self.symbol(&cursor, first);
                    self.note_called(name);
                }
                self.note_assignment(first, cursor);
                match cursor.brackets() {
                    Ok(Some((at, end))) => {
                        let inside = Cursor { at, end, ..cursor };
                        self.note_arguments(inside);
                        self.note_given(first, inside);
                    }
                    Ok(None) => {}
                    Err(_) => return,
                }
            }
        }
        self.note_arguments(cursor);
        self.note_given(first, cursor);
    }

    /// Notes which names are given to which parameters; the cursor stands behind the first word.
    fn note_given(&mut self, first: Token, mut cursor: Cursor) {
        // brackets that are open: of which routine, and which argument comes next
        let mut open: Vec<(Option<Symbol>, usize)> = Vec::new();
        let mut before = first;
        // where the present argument begins
        let mut start = cursor.at;
        loop {
            let token = cursor.next();
            match token.kind {
                Kind::End => return,
                Kind::Sign(b'(') => {
                    let is_call = before.kind == Kind::Name;
                    let routine = is_call.then(|| self.symbol(&cursor, before));
                    if let Some(routine) = routine {
                        let context = self.context();
                        self.names.known.called.insert((routine, context));
                    }
                    open.push((routine, 0));
                    start = cursor.at;
                }
                Kind::Sign(b'[' | b'{') => open.push((None, 0)),
                Kind::Sign(b')' | b']' | b'}') => {
                    if let Some((Some(routine), at)) = open.pop() {
                        self.number_given((routine, at), start, &cursor);
                    }
                }
                Kind::Sign(b',') => {
                    if let Some((routine, at)) = open.last_mut() {
                        let given = routine.map(|routine| (routine, *at));
                        *at += 1;
                        if let Some(given) = given {
                            self.number_given(given, start, &cursor);
                            start = cursor.at;
                        }
                    }
                }
                Kind::Name if matches!(before.kind, Kind::Sign(b'(' | b',')) => {
                    if let Some(&(Some(routine), at)) = open.last()
                        && matches!(cursor.peek().kind, Kind::Sign(b')' | b','))
                    {
                        let name = self.symbol(&cursor, token);
                        let context = self.context();
                        self.names.given.push((name, routine, at, context));
                    }
                }
                _ => {}
            }
            before = token;
        }
    }

    /// Notes what `name[..].part=` writes; the cursor stands behind the name.
    pub(super) fn note_assignment(&mut self, name: Token, cursor: Cursor) {
        let Some((mut at, parts)) = written(cursor) else {
            return;
        };
        let mut name = self.symbol(&cursor, name);
        self.note_written(name);
        self.names.note_own_written(name, self.context());
        self.touch(name, at);
        // what is behind may be a member of a structure that is not declared yet
        for (part, inner) in &parts {
            let path = self.names.symbols.path(name, cursor.text(*part));
            (name, at) = (self.names.symbols.intern(&path), at.inside(*inner));
            self.note_written(name);
            self.touch(name, at);
        }
        // a whole structure, on any level
        self.names.handed.insert(name);
    }

    fn touch(&mut self, name: Symbol, at: Index) {
        self.names.touched.insert(name);
        self.names.elements.insert((name, at));
    }

    /// Names between brackets may be written by the routine that they are handed to; those in
    /// brackets behind a table choose its entry.
    fn note_arguments(&mut self, mut cursor: Cursor) {
        let mut fresh = false;
        // brackets that are open, and whether all in them is only read
        let mut open: Vec<bool> = Vec::new();
        loop {
            let token = cursor.next();
            match token.kind {
                Kind::End => return,
                Kind::Name if only_reads(cursor.text(token)) && cursor.peek().is(b'(') => {
                    cursor.take(b'(');
                    open.push(is_of_form(cursor.text(token)));
                    fresh = false;
                }
                Kind::Name if fresh => {
                    let mut after = cursor;
                    let at = after.brackets().unwrap_or(None);
                    let mut at = Index::of(at, &cursor);
                    let mut parts = Vec::new();
                    while after.take(b'.') {
                        let part = after.next();
                        let inner = after.brackets().unwrap_or(None);
                        parts.push((part, Index::of(inner, &after)));
                    }
                    if matches!(after.blanks(), b',' | b')') {
                        let mut name = self.symbol(&cursor, token);
                        self.note_given_number(name);
                        self.touch(name, at);
                        for (part, inner) in parts {
                            let path = self.names.symbols.path(name, cursor.text(part));
                            (name, at) = (self.names.symbols.intern(&path), at.inside(inner));
                            self.touch(name, at);
                        }
                        self.names.handed.insert(name);
                        self.names.given_away.insert(name);
                        cursor = after;
                    }
                    fresh = false;
                }
                Kind::Name => self.note_index(token, &mut cursor),
                Kind::Sign(b'(') => {
                    open.push(false);
                    fresh = true;
                }
                Kind::Sign(b')') => {
                    open.pop();
                    fresh = false;
                }
                Kind::Sign(b',') => fresh = open.last() != Some(&true),
                _ => fresh = false,
            }
        }
    }

    /// Notes what chooses tools, bases and loads in a line.
    fn note_indices(&mut self, mut cursor: Cursor) {
        loop {
            let token = cursor.next();
            match token.kind {
                Kind::End => return,
                Kind::Name => self.note_index(token, &mut cursor),
                _ => {}
            }
        }
    }

    /// `BASE_DATA[n]`: what `n` is chooses.
    fn note_index(&mut self, token: Token, cursor: &mut Cursor) {
        let mut buffer = [0; 24];
        if cursor.bytes.get(cursor.at) == Some(&b'[')
            && Table::named(capitals(cursor.text(token), &mut buffer)).is_some()
        {
            cursor.take(b'[');
            let name = cursor.next();
            let name = self.symbol(cursor, name);
            self.names.choosing.insert(name);
        }
    }

    /// One line of a routine.
    pub(super) fn statement(&mut self, first: Token, mut cursor: Cursor) -> Read<()> {
        self.here = self.place(first);
        self.results.clear();
        let mut buffer = [0; 24];
        let word = capitals(cursor.text(first), &mut buffer);
        let calls = self.builder.script.calls.len();
        match word {
            // what stands behind DO is not run here, and a condition in every round
            b"INTERRUPT" | b"WHILE" => {}
            b"TRIGGER" => self.calls_in(in_front_of_do(cursor)),
            _ => self.calls_in(cursor),
        }
        if let Some((path, relative)) = motion(word) {
            let next = cursor.peek();
            // a variable or label may have such a name
            if !next.is(b'=') && !next.is(b':') && !next.is(b'.') {
                self.is_referred |= self.builder.script.calls.len() > calls;
                return if relative {
                    self.relative(first, path, cursor)
                } else {
                    self.motion(first, path, cursor)
                };
            }
        }
        if word == b"RETURN" {
            self.return_value(cursor)?;
            self.builder.back();
            self.lose_place();
            return Ok(());
        }
        if !cursor.peek().is(b'=') && self.flow(word, cursor) {
            self.lose_place();
            return Ok(());
        }
        match word {
            b"SPLINE" | b"PTP_SPLINE" => {
                (self.spline, self.in_spline) = (With::default(), true);
                let with = cursor.next();
                if cursor.text(with).eq_ignore_ascii_case(b"WITH") {
                    self.spline = self.with(&mut cursor, &mut SpeedZone::default())?;
                }
                self.last = self.last.filter(|_| !self.spline.has_frame());
                return Ok(());
            }
            b"ENDSPLINE" => {
                self.last = self.last.filter(|_| !self.spline.has_frame());
                (self.spline, self.in_spline) = (With::default(), false);
                return Ok(());
            }
            b"ASYPTP" | b"ASYCONT" | b"ASYSTOP" if !cursor.peek().is(b'=') => {
                self.apart(cursor);
                return Ok(());
            }
            b"BAS" if cursor.peek().is(b'(') => {
                self.bas(first, cursor);
                return Ok(());
            }
            b"STOP" | b"CONST_VEL" if !cursor.peek().is(b'=') => {
                self.is_referred = true;
                return Ok(());
            }
            b"INTERRUPT" | b"TRIGGER" => {
                self.is_referred |= word == b"TRIGGER" && refers_to_end(cursor);
                match action(cursor) {
                    Some((name, rest)) if is_kept(rest) => {
                        // an interrupt is started where it is switched on
                        let starts = (word == b"TRIGGER").then(|| {
                            let starts = self.builder.script.calls.len();
                            let call = Call::of(self.here, Box::default(), "INTERRUPT", 0..0);
                            self.builder.start(call, false);
                            starts
                        });
                        self.actions.push(Action {
                            routine: self.context().routine,
                            at: name.start as usize,
                            end: rest.end,
                            starts,
                        });
                    }
                    Some((name, rest)) if word == b"TRIGGER" && rest.peek().is(b'(') => {
                        self.interrupts(cursor, Some((name, rest)));
                    }
                    None => self.interrupts(cursor, None),
                    Some(_) => {}
                }
                return Ok(());
            }
            b"WAIT" | b"HALT" | b"BRAKE" | b"RESUME" | b"CONTINUE" | b"ANIN" | b"ANOUT"
            | b"PULSE" => return Ok(()),
            _ => {}
        }
        let behind_name = cursor;
        let at = cursor.brackets()?;
        let symbol = self.symbol(&cursor, first);
        let written = self.member(symbol, at, &mut cursor)?;
        let mut part = None;
        while cursor.take(b'.') {
            part = Some(cursor.next());
            cursor.brackets()?;
        }
        let next = cursor.next();
        match next.kind {
            Kind::Sign(b'=') if word == b"$ASYNC_AXIS" || word == b"$EX_AX_IGNORE" => {
                self.asynchronous(cursor);
                Ok(())
            }
            Kind::Sign(b'=') if word == b"$ACT_EX_AX" => {
                self.active(cursor);
                Ok(())
            }
            Kind::Sign(b'=') => self.assignment((first, word), (written, at), part, cursor),
            Kind::Sign(b':') if cursor.peek().kind == Kind::End => {
                let label = self.symbol(&cursor, first);
                self.builder.label(u64::from(label.0));
                self.lose_place();
                Ok(())
            }
            Kind::Sign(b'(') => {
                self.call(first, behind_name);
                Ok(())
            }
            _ => Ok(()),
        }
    }

    /// `ASYPTP {E1 100}`: from here on nothing says where listed axes stand.
    fn apart(&mut self, mut cursor: Cursor) {
        let named = aggregate::read(&mut cursor)
            .ok()
            .map(|found| found.external);
        // a variable may name any
        let is_listed = named.is_none_or(|values| {
            let mut named = EXTERNAL.iter().zip(values);
            named.any(|(name, value)| value.is_some() && self.bit_of(name) != 0)
        });
        if is_listed {
            self.axes_off(0, self.external.every_axis());
        }
    }

    /// `$ASYNC_AXIS='B0001'`
    fn asynchronous(&mut self, cursor: Cursor) {
        if !is_no_axis(&cursor.bytes[cursor.at..cursor.end]) {
            self.axes_off(0, self.external.every_axis());
        }
    }

    /// What stands elsewhere in a move `WITH $EX_AX_IGNORE='B0001'`.
    pub(super) fn ignored_axes(&mut self, value: &[u8]) -> Option<VariableId> {
        let all = self.external.every_axis();
        if self.external.listed.is_empty() || is_no_axis(value) {
            return None;
        }
        let value = *self.every_axis_off.get_or_insert_with(|| {
            let value = self.builder.script.value(Held::AxesOff(all));
            let variable = Variable::new("$EX_AX_IGNORE", Place::NOWHERE, Expr::Value(value));
            self.builder.script.variable(variable)
        });
        Some(value)
    }

    /// `$ACT_EX_AX=1`: axes beyond this number are not moved.
    fn active(&mut self, cursor: Cursor) {
        let rest = cursor.bytes[cursor.at..cursor.end].trim_ascii();
        let count = Source::text(rest).trim().parse().unwrap_or(0_usize);
        let still = EXTERNAL.iter().skip(count);
        let axes = still.fold(0, |axes, name| axes | self.bit_of(name));
        self.axes_off(1, axes);
    }

    /// The bit of a listed axis.
    pub(super) fn bit_of(&self, name: &str) -> u16 {
        match self.external.meaning(name) {
            ExternalUse::Listed(at) => 1 << at,
            _ => 0,
        }
    }

    /// These axes stand elsewhere than targets say.
    fn axes_off(&mut self, which: usize, axes: u16) {
        if self.external.listed.is_empty() {
            return;
        }
        let value = match axes {
            0 => self.states.on,
            axes => self.builder.script.value(Held::AxesOff(axes)),
        };
        self.builder.write(
            self.here,
            Written::One(self.states.apart[which]),
            How::Whole(Expr::Value(value)),
        );
    }

    /// Branches, loops and jumps; whether it is one.
    fn flow(&mut self, word: &[u8], mut cursor: Cursor) -> bool {
        match word {
            b"IF" => {
                let tests = self.tests(cursor);
                self.builder.begin_if(tests);
            }
            b"ELSE" | b"DEFAULT" => self.builder.next_branch(true),
            b"ENDIF" | b"ENDSWITCH" => self.builder.end_choice(),
            b"SWITCH" => {
                let of = self.switched(cursor);
                self.builder.begin_switch(of);
            }
            b"CASE" => {
                self.builder.next_branch(true);
                let numbers = self.cases(cursor);
                self.builder.pass_cases(&numbers);
            }
            b"LOOP" | b"REPEAT" => self.builder.begin_loop(false),
            b"WHILE" => {
                self.builder.begin_loop(false);
                self.calls_in(cursor);
                self.builder.begin_if(None);
                self.builder.leave_loop();
                self.builder.end_choice();
            }
            b"FOR" => {
                let name = cursor.next();
                let name = self.symbol(&cursor, name);
                let most = self.names.known.rounds(self.file, cursor.end);
                self.builder.begin_rounds(true, most);
                self.count(name, Index::Whole, None);
            }
            b"ENDLOOP" | b"ENDWHILE" => self.builder.end_loop(true),
            b"ENDFOR" | b"UNTIL" => self.builder.end_loop(false),
            b"EXIT" => self.builder.leave_loop(),
            b"GOTO" => {
                let label = cursor.next();
                let label = self.symbol(&cursor, label);
                self.builder.go_to(u64::from(label.0));
            }
            _ => return false,
        }
        true
    }
}

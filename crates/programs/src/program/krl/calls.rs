//! Calls of routines and functions.

use super::frames::{State, Table};
use super::names::{DataKind, Index, whole};
use super::reader::Reader;
use super::remarks::{COMPUTED, FRAME_ASSIGNED, WITHOUT_AXES, carried, conveyor};
use super::sensors::leads;
use super::targets::Owner;
use super::tokens::{Cursor, Kind, Token, capitals};
use crate::program::names::Symbol;
use crate::program::number;
use crate::program::numbers::Literal;
use crate::program::script::{Argument, Call, Expr, How, Place};

/// Calls in one expression; a line of the controller has no room for more.
const MOST_CALLS: usize = 64;

/// How the routines of KUKA.ConveyorTech begin, which couple `$BASE` to a conveyor: not checked on
/// files.
const CONVEYORS: [&[u8]; 2] = [b"CONV_", b"CONVEYOR"];

/// What a routine of the controller or of its packages does with what it is given.
enum Known {
    /// It only reads it.
    Reads,
    /// It writes the arguments from this one on.
    Writes(usize),
}

/// Routines of the controller and its packages that change neither tool nor base.
///
/// # Source
/// KUKA System Software, Operating and Programming Instructions for System Integrators ("Standard
/// functions", "String functions", "Message programming"); KUKA, CREAD/CWRITE; KUKA.Ethernet KRL,
/// "Functions".
fn known(word: &[u8]) -> Option<Known> {
    Some(match word {
        _ if is_of_form(word) => Known::Reads,
        b"ABS"
        | b"SQRT"
        | b"SIN"
        | b"COS"
        | b"TAN"
        | b"ACOS"
        | b"ATAN2"
        | b"FORWARD"
        | b"INVERSE"
        | b"INV_POS"
        | b"EK"
        | b"LK"
        | b"K_ROOT"
        | b"K_TYPE"
        | b"K_OFFS"
        | b"USE_CM_PRO_VALUES"
        | b"VARSTATE"
        | b"SWRITE"
        | b"CWRITE"
        | b"COPEN"
        | b"CCLOSE"
        | b"CIOCTL"
        | b"STRDECLLEN"
        | b"STRLEN"
        | b"STRCLEAR"
        | b"STRADD"
        | b"STRFIND"
        | b"STRCOMP"
        | b"STRCOPY"
        | b"SET_CD_PARAMS"
        | b"IR_STOPM"
        | b"TIMER_LIMIT"
        | b"CLEAR_KRLMSG"
        | b"SET_KRLMSG"
        | b"SET_KRLDLG"
        | b"EXISTS_KRLMSG"
        | b"EXISTS_KRLDLG"
        | b"MSGNOTIFY"
        | b"MSGQUIT"
        | b"MSGSTATUS"
        | b"MSGDIALOG"
        | b"DELETE_BACKWARD_BUFFER"
        | b"SYNC_INTERRUPT"
        | b"EKI_INIT"
        | b"EKI_OPEN"
        | b"EKI_CLOSE"
        | b"EKI_CLEAR"
        | b"EKI_SEND"
        | b"EKI_SETREAL"
        | b"EKI_SETINT"
        | b"EKI_SETBOOL"
        | b"EKI_SETFRAME"
        | b"EKI_SETSTRING" => Known::Reads,
        // CREAD(handle, state, mode, timeout, offset, format, variables)
        b"CREAD" => Known::Writes(6),
        // SREAD(string, state, offset, format, variables)
        b"SREAD" => Known::Writes(4),
        b"CAST_TO" => Known::Writes(0),
        // CAST_FROM(buffer, offset, variables), EKI_GetFrame(channel, element, frame)
        b"CAST_FROM" | b"EKI_GETREAL" | b"EKI_GETINT" | b"EKI_GETBOOL" | b"EKI_GETFRAME"
        | b"EKI_GETSTRING" | b"EKI_GETREALARRAY" | b"EKI_GETINTARRAY" | b"EKI_GETFRAMEARRAY" => {
            Known::Writes(2)
        }
        _ => return None,
    })
}

/// Whether a routine of the controller only reads what it is given.
pub(super) fn only_reads(name: &[u8]) -> bool {
    matches!(known(capitals(name, &mut [0; 24])), Some(Known::Reads))
}

/// Whether it is a function of inline forms, which reads data such as LDAT.
pub(super) fn is_of_form(name: &[u8]) -> bool {
    matches!(
        capitals(name, &mut [0; 24]),
        b"STOOL"
            | b"STOOL2"
            | b"SBASE"
            | b"SLOAD"
            | b"SIPO_MODE"
            | b"SORI_TYP"
            | b"SCIRC_TYP"
            | b"SCIRC_M"
            | b"SVEL_CP"
            | b"SVEL_JOINT"
            | b"SACC_CP"
            | b"SACC_JOINT"
            | b"SGEAR_JERK"
            | b"SJERK"
            | b"SAPO"
            | b"SAPO_PTP"
    )
}

/// Whether an index leaves out which element is meant: `[]`, `[,]`, `[2,]`.
fn is_whole(index: &[u8]) -> bool {
    let mut parts = index.split(|&b| b == b',');
    parts.any(|part| part.trim_ascii().is_empty())
}

/// An argument as it is written.
pub(super) enum Given {
    /// A variable.
    Named(Symbol, Index),
    /// All of an array: `p[]`.
    Array(Symbol),
    /// A tool, base, load or mode, or a part of it: `$BASE`, `$LOAD.M`.
    State(State),
    /// An entry of a table, or a part of it: `BASE_DATA[1]`, `TOOL_DATA[n].X`.
    Entry {
        table: Table,
        at: Index,
        is_part: bool,
    },
    /// A part of a position: `XP1.Z`.
    Part(Symbol, Index, Box<[u8]>),
    /// A position that is written out, or a product.
    Position(Expr, DataKind),
    Number(u32),
    /// TRUE, FALSE, `#NAME` or a number below zero.
    Literal(Literal),
    Other,
}

impl Reader {
    /// `routine(a, b)`; the cursor stands in front of the bracket.
    pub(super) fn call(&mut self, name: Token, mut cursor: Cursor) {
        self.lose_place();
        self.call_here(name, &mut cursor, true);
    }

    /// The functions that a part of a statement calls, those in arguments of others first.
    pub(super) fn calls_in(&mut self, mut cursor: Cursor) {
        if memchr::memchr(b'(', &cursor.bytes[cursor.at..cursor.end]).is_none() {
            return;
        }
        // brackets that are open, and the function in front with what follows it
        let mut open: Vec<Option<(Token, Cursor)>> = Vec::new();
        let mut calls = 0;
        loop {
            let token = cursor.next();
            match token.kind {
                Kind::End => return,
                Kind::Name if cursor.blanks() == b'(' => {
                    open.push(Some((token, cursor)));
                    cursor.take(b'(');
                }
                Kind::Sign(b'(') => open.push(None),
                Kind::Sign(b')') => {
                    if let Some(Some((name, mut inner))) = open.pop() {
                        calls += 1;
                        if calls > MOST_CALLS {
                            return;
                        }
                        self.call_here(name, &mut inner, false);
                    }
                }
                _ => {}
            }
        }
    }

    fn call_here(&mut self, name: Token, cursor: &mut Cursor, is_statement: bool) {
        let mut buffer = [0; 24];
        let known = known(capitals(cursor.text(name), &mut buffer));
        let symbol = self.symbol(cursor, name);
        let callee = self.names.routine(symbol, self.context());
        if callee.is_none() && matches!(known, Some(Known::Reads)) {
            return;
        }
        let arguments = self.arguments(cursor);
        let place = Place::new(self.file, name.start);
        match (callee, known) {
            (None, Some(Known::Writes(from))) => {
                for given in arguments.into_iter().skip(from) {
                    match given {
                        Given::Named(name, at) => self.write_by_controller(name, at),
                        Given::Array(name) => self.write_by_controller(name, Index::Variable),
                        other => self.lose_given(place, &other),
                    }
                }
            }
            (callee, _) => {
                self.emit(place, symbol, callee, &arguments, is_statement);
                if let Some(callee) = callee {
                    self.note_returned(name, callee);
                    if self.names.is_loud(callee) {
                        self.lose_place();
                    }
                }
                let word = capitals(cursor.text(name), &mut buffer);
                if callee.is_none() {
                    self.switch_sensor(place, word);
                }
                if callee.is_none() && CONVEYORS.iter().any(|begins| word.starts_with(begins)) {
                    let spelled = self.names.symbols.spelling(symbol).to_owned();
                    let base = self.unknown(conveyor(&spelled));
                    self.set(place, State::Base, base);
                }
            }
        }
    }

    /// What the controller writes into a variable that it is given.
    fn write_by_controller(&mut self, name: Symbol, at: Index) {
        let Some(datum) = self.names.datum(name, self.context()) else {
            return;
        };
        match self.names.data[datum as usize].kind {
            DataKind::Number => self.count(name, at, None),
            kind if kind.is_place() => {
                let how = How::Whole(self.unknown(COMPUTED));
                self.write_element(Owner::Datum(datum), at, how);
            }
            kind => self.structure_becomes((name, at), kind, None),
        }
    }

    /// A tool, base, load, mode or part of a position is written with what the text does not tell.
    fn lose_given(&mut self, place: Place, given: &Given) {
        match given {
            Given::State(state) => {
                let value = match state {
                    State::Tool | State::Base => self.unknown(FRAME_ASSIGNED),
                    State::Load => self.unknown(carried()),
                    State::Ipo | State::FdatIpo => self.mode_value(None),
                    State::Orientation | State::LdatOrientation => return,
                    State::FdatTool | State::FdatBase | State::ActTool | State::ActBase => {
                        self.number_of(None)
                    }
                };
                self.set(place, *state, value);
            }
            Given::Entry { table, at, .. } => {
                let remark = match table {
                    Table::Load => carried(),
                    Table::Tool | Table::Base => FRAME_ASSIGNED,
                };
                let how = How::Whole(self.unknown(remark));
                let variable = self.entry_written(*table, *at);
                self.builder.write(place, variable, how);
            }
            Given::Part(name, at, part) => {
                let Some(datum) = self.names.datum(*name, self.context()) else {
                    return;
                };
                let kind = self.names.data[datum as usize].kind;
                if kind == DataKind::Fdat {
                    self.lose_fdat(*name, *at, part);
                } else if kind.is_place() {
                    let how = match self.axis_written(part) {
                        Some(how) => how,
                        None => How::part(false, false, self.builder.script.remark(COMPUTED)),
                    };
                    self.write_element(Owner::Datum(datum), *at, how);
                }
            }
            _ => {}
        }
    }

    /// Whether a routine may write what it is given.
    fn may_write(&self, callee: Option<u32>, parameter: Option<(u32, bool)>) -> bool {
        match parameter {
            Some((datum, by_reference)) => {
                let name = self.names.data[datum as usize].name;
                by_reference && self.names.touched.contains(&name)
            }
            None => callee.is_none(),
        }
    }

    fn emit(
        &mut self,
        place: Place,
        name: Symbol,
        callee: Option<u32>,
        given: &[Given],
        is_statement: bool,
    ) {
        let mut arguments = Vec::with_capacity(given.len());
        let mut gives = false;
        let mut written = Vec::new();
        let mut lost = Vec::new();
        let parameter = |reader: &Self, at: usize| {
            let head = &reader.names.heads[callee? as usize];
            head.parameters.get(at).copied()
        };
        // a routine writes it before or behind its moves
        let changed = |reader: &mut Self| {
            for (at, given) in given.iter().enumerate() {
                if reader.may_write(callee, parameter(reader, at)) {
                    reader.lose_given(place, given);
                }
            }
        };
        changed(self);
        for (at, given) in given.iter().enumerate() {
            let parameter = parameter(self, at);
            if let Some((of, choice)) = self.choice_given(given, parameter) {
                arguments.push(Argument::new(Some(of), choice, None));
                continue;
            }
            if let Given::Named(name, at) = *given {
                let positions = self.positions_given((name, at), parameter);
                gives |= !positions.is_empty();
                arguments.extend(positions);
            }
            let value = self.value_given(place, given, parameter, callee.is_none());
            let Some((value, kind)) = value else {
                continue;
            };
            written.extend(self.array_written(given, parameter));
            let mut is_number = false;
            let mut to = DataKind::Other;
            let is_given = parameter.is_some_and(|(datum, _)| {
                let datum = &self.names.data[datum as usize];
                to = datum.kind;
                is_number = datum.kind == DataKind::Number;
                datum.kind.is_place() || is_number && self.names.choosing.contains(&datum.name)
            });
            if value == Expr::Absent && !is_given {
                continue;
            }
            gives |= value != Expr::Absent;
            let by_reference = parameter.is_none_or(|(_, by_reference)| by_reference);
            let back = match value {
                Expr::Variable(variable) if by_reference => Some(variable),
                _ => None,
            };
            // a number that chooses, of which the routine makes another type
            if callee.is_some() && kind == Some(DataKind::Number) && !is_given {
                lost.extend(back);
            }
            let value = match (value, kind) {
                // a frame that no move goes to is an offset
                (_, Some(DataKind::Frame)) if callee.is_none() => Expr::Absent,
                (Expr::Absent, _) if is_number => self.chosen(),
                (Expr::Absent, _) => self.unknown(COMPUTED),
                (_, Some(kind)) if self.lacks_axes(kind, to) => self.unknown(WITHOUT_AXES),
                (value, _) => value,
            };
            let parameter = parameter.filter(|_| is_given);
            let parameter = parameter.map(|(datum, _)| self.variable_of(datum));
            arguments.push(Argument::new(parameter, value, back));
        }
        // a function that is not in the files matters where it is given something only
        let leads = callee.is_none()
            && (is_statement || leads(self.names.symbols.spelling(name).as_bytes()));
        if callee.is_none() && !leads && !gives {
            return;
        }
        let arguments = self.builder.script.give(arguments);
        let callees = callee.into_iter().collect();
        let name = self.names.symbols.spelling(name);
        self.builder.call(Call {
            // functions do not move the robot
            leads,
            ..Call::of(place, callees, name, arguments)
        });
        let caller = self.context().routine;
        let is_interrupted = caller.is_some_and(|caller| self.names.interrupted.contains(&caller));
        if callee.is_some() && is_statement && is_interrupted && self.names.resumes {
            self.builder.call(Call {
                foreign: false,
                ..Call::of(place, [].into(), "RESUME", 0..0)
            });
        }
        changed(self);
        for variable in lost {
            let value = self.chosen();
            self.put(place, variable, value);
        }
        for array in written {
            let how = How::PartSomehow(self.builder.script.remark(COMPUTED));
            self.write_element(Owner::Datum(array), Index::Variable, how);
        }
    }

    /// What an argument is, and its kind; `None` where it is not followed.
    fn value_given(
        &mut self,
        call: Place,
        given: &Given,
        parameter: Option<(u32, bool)>,
        is_foreign: bool,
    ) -> Option<(Expr, Option<DataKind>)> {
        let nothing = Some((Expr::Absent, None));
        let (name, at) = match *given {
            Given::Named(name, at) => (name, at),
            Given::Array(name) => (name, Index::Variable),
            // nothing else has those numbers
            Given::Position(value, kind) if !is_foreign => {
                return Some((value, Some(kind)));
            }
            Given::Number(number) => {
                let is_chosen = parameter.is_some_and(|(datum, _)| {
                    let name = self.names.data[datum as usize].name;
                    self.names.choosing.contains(&name)
                });
                if !is_chosen {
                    return nothing;
                }
                return Some((self.number_value(number), Some(DataKind::Number)));
            }
            Given::State(state @ (State::Tool | State::Base)) => {
                return Some((self.states.expr(state), Some(DataKind::Frame)));
            }
            Given::Entry {
                table: table @ (Table::Tool | Table::Base),
                at,
                is_part: false,
            } => return Some((self.entry_value(table, at), Some(DataKind::Frame))),
            _ => return nothing,
        };
        let Some(datum) = self.names.datum(name, self.context()) else {
            return nothing;
        };
        let kind = self.names.data[datum as usize].kind;
        let is_number = kind == DataKind::Number && self.names.choosing.contains(&name);
        if kind.is_place() && at == Index::Variable {
            let is_whole = matches!(given, Given::Array(_));
            if !self.follows_array(call, datum, is_whole, is_foreign) {
                return None;
            }
        } else if !kind.is_place() && (!is_number || at == Index::Variable) {
            return nothing;
        }
        Some((self.named(name, at).unwrap_or(Expr::Absent), Some(kind)))
    }

    /// The array of which a routine may write an element that only the running program knows.
    fn array_written(&self, given: &Given, parameter: Option<(u32, bool)>) -> Option<u32> {
        let (&Given::Named(name, Index::Variable), Some((parameter, true))) = (given, parameter)
        else {
            return None;
        };
        let datum = self.names.datum(name, self.context())?;
        let is_place = self.names.data[datum as usize].kind.is_place();
        let parameter = self.names.data[parameter as usize].name;
        (is_place && self.names.touched.contains(&parameter)).then_some(datum)
    }

    /// The arguments of a call; the cursor stands in front of the bracket.
    fn arguments(&mut self, cursor: &mut Cursor) -> Vec<Given> {
        let mut all = Vec::new();
        if !cursor.take(b'(') {
            return all;
        }
        loop {
            if matches!(cursor.blanks(), 0 | b')' | b';') {
                return all;
            }
            all.push(self.argument(cursor));
            cursor.skip();
            if !cursor.take(b',') {
                return all;
            }
        }
    }

    fn argument(&mut self, cursor: &mut Cursor) -> Given {
        let mut ahead = *cursor;
        if ahead.blanks() == b'{' {
            return self.position_argument(cursor);
        }
        let mut behind = *cursor;
        behind.skip();
        let text = cursor.bytes[ahead.at..behind.at].trim_ascii();
        let token = ahead.next();
        if !matches!(token.kind, Kind::Number)
            && let Some(literal) = self.names.literal(text)
        {
            return Given::Literal(literal);
        }
        let alone = |ahead: &mut Cursor| matches!(ahead.blanks(), b',' | b')');
        match token.kind {
            Kind::Number if alone(&mut ahead) => {
                whole(number::parse(ahead.text(token))).map_or(Given::Other, Given::Number)
            }
            Kind::Name => {
                let Ok(at) = ahead.brackets() else {
                    return Given::Other;
                };
                let mut buffer = [0; 24];
                let word = capitals(ahead.text(token), &mut buffer);
                let symbol = self.symbol(&ahead, token);
                let Ok((symbol, index)) = self.member(symbol, at, &mut ahead) else {
                    return Given::Other;
                };
                let part = ahead.take(b'.').then(|| ahead.next());
                if part.is_some() || word.starts_with(b"$") || Table::named(word).is_some() {
                    if !alone(&mut ahead) {
                        return Given::Other;
                    }
                    let at = index;
                    if let Some(state) = State::named(word) {
                        return Given::State(state);
                    }
                    if let Some(table) = Table::named(word) {
                        let is_part = part.is_some();
                        return Given::Entry { table, at, is_part };
                    }
                    let part = part.map(|part| ahead.text(part).to_ascii_uppercase());
                    return part.map_or(Given::Named(symbol, at), |part| {
                        Given::Part(symbol, at, part.into())
                    });
                }
                if let Some((value, kind)) = self.returned(token)
                    && super::states::inside(&mut ahead).is_some()
                    && alone(&mut ahead)
                {
                    return Given::Position(value, kind);
                }
                if alone(&mut ahead) {
                    return match at {
                        Some((start, end)) if is_whole(&ahead.bytes[start..end]) => {
                            Given::Array(symbol)
                        }
                        _ => Given::Named(symbol, index),
                    };
                }
                if ahead.blanks() == b':' {
                    return self.position_argument(cursor);
                }
                Given::Other
            }
            _ => Given::Other,
        }
    }

    fn position_argument(&mut self, cursor: &mut Cursor) -> Given {
        match self.point(cursor) {
            Ok(point) => Given::Position(self.value_of(&point, point.kind), point.kind),
            Err(_) => Given::Other,
        }
    }

    /// Whether an expression names a position with numbers in the files.
    pub(super) fn mentions_position(&self, mut cursor: Cursor) -> bool {
        let mut before = b' ';
        let mut open = 0_u32;
        loop {
            let token = cursor.next();
            match token.kind {
                Kind::End => return false,
                // in an aggregate it is a number that is taken, not a position
                Kind::Sign(b'{') => open += 1,
                Kind::Sign(b'}') => open = open.saturating_sub(1),
                Kind::Name if open == 0 && before != b'.' && before != b'#' => {
                    let is_whole = !cursor.peek().is(b'.');
                    let folded = cursor.text(token).to_ascii_lowercase();
                    let name = self.names.symbols.find(&folded).filter(|_| is_whole);
                    let kind = name.and_then(|name| self.names.kind(name, self.context()));
                    if kind.is_some_and(DataKind::is_position) {
                        return true;
                    }
                }
                _ => {}
            }
            before = match token.kind {
                Kind::Sign(sign) => sign,
                _ => b' ',
            };
        }
    }
}

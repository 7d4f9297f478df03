//! Statements that set tools, bases, loads and modes: `$TOOL=`, BAS, entries of tables.

use super::aggregate;
use super::data::{Carried, is_external, load};
use super::frames::{Choice, State, Table, carried_record, part, record, unit};
use super::names::{DataKind, Index, Stored, Turning, whole};
use super::reader::Reader;
use super::remarks::{CHOSEN, FRAME_ASSIGNED, LINKED, MOVING, carried};
use super::tokens::{Cursor, Kind, Read, Token, capitals};
use crate::program::names::Symbol;
use crate::program::number;
use crate::program::script::{Expr, How, Part, PartValue, Place, VariableId, Written, short};

impl Reader {
    /// Sets a state of the controller.
    pub(super) fn set(&mut self, place: Place, state: State, value: Expr) {
        if matches!(state, State::Tool | State::Base | State::Ipo) {
            self.lose_place();
        }
        let variable = self.states.states[state as usize];
        self.put(place, variable, value);
        let [by_state, by_ldat] = self.states.keeping;
        let keeping = match state {
            State::Orientation => Some(by_state),
            State::LdatOrientation => Some(by_ldat),
            _ => None,
        };
        if let Some(keeping) = keeping.filter(|_| self.keeps) {
            self.put(place, keeping, self.kept_same(value));
        }
        if state == State::Orientation && self.ignores {
            let ignored = if value == self.ignored() {
                value
            } else {
                self.orientation_value(Turning::Evenly)
            };
            self.put(place, self.states.ignoring, ignored);
        }
    }

    pub(super) fn put(&mut self, place: Place, variable: VariableId, value: Expr) {
        self.builder
            .write(place, Written::One(variable), How::Whole(value));
    }

    /// The number of a tool, base or load up to the end of the cursor: `3`, `n`, `FP1.TOOL_NO`.
    pub(super) fn choice(&mut self, mut cursor: Cursor, table: Table) -> Option<Choice> {
        let token = cursor.next();
        if token.kind == Kind::Number {
            let alone = cursor.peek().kind == Kind::End;
            let value = whole(number::parse(cursor.text(token))).filter(|_| alone)?;
            return Some(Choice::Entry(value));
        }
        if token.kind != Kind::Name {
            return None;
        }
        let mut buffer = [0; 24];
        let word = capitals(cursor.text(token), &mut buffer);
        if let (Some(state @ (State::ActTool | State::ActBase)), Kind::End) =
            (State::named(word), cursor.peek().kind)
        {
            return Some(Choice::By(self.states.states[state as usize]));
        }
        let is_active = word == b"FDAT_ACT";
        let name = self.symbol(&cursor, token);
        let at = Index::of(cursor.brackets().ok()?, &cursor);
        if cursor.take(b'.') {
            let mut buffer = [0; 24];
            let part = cursor.next();
            let is_tool = match capitals(cursor.text(part), &mut buffer) {
                b"TOOL_NO" => true,
                b"BASE_NO" => false,
                _ => return None,
            };
            if is_active {
                let state = if is_tool {
                    State::FdatTool
                } else {
                    State::FdatBase
                };
                return Some(Choice::By(self.states.states[state as usize]));
            }
            return self.number_in(name, at, is_tool);
        }
        if cursor.peek().kind != Kind::End {
            return None;
        }
        let context = self.context();
        if self.names.kind(name, context) == Some(DataKind::Fdat) {
            return self.number_in(name, at, table != Table::Base);
        }
        if let Some(Stored::Number(number)) = self.names.constant(name, at, context) {
            return Some(Choice::Entry(number));
        }
        if !self.names.choosing.contains(&name) || at != Index::Whole {
            return None;
        }
        match self.named(name, at) {
            Some(Expr::Variable(variable)) => Some(Choice::By(variable)),
            _ => None,
        }
    }

    /// The value given to a state, up to a comma or the end of the line.
    pub(super) fn state_value(&mut self, state: State, cursor: &mut Cursor) -> Read<Expr> {
        Ok(match state {
            State::Tool => self.frame(Table::Tool, "$TOOL", cursor)?,
            State::Base => self.frame(Table::Base, "$BASE", cursor)?,
            State::Load => self.load_expr(cursor)?,
            State::Ipo => self.mode(cursor),
            State::Orientation => self.orientation(cursor),
            _ => {
                let choice = self.choice(*cursor, Table::Tool);
                self.number_of(choice)
            }
        })
    }

    /// `#TCP`, `SIPO_MODE(FP1.IPO_FRAME)`
    pub(super) fn mode(&mut self, cursor: &mut Cursor) -> Expr {
        let mut inner = *cursor;
        if !cursor.peek().is(b'#') {
            let name = cursor.next();
            let is_function = cursor.text(name).eq_ignore_ascii_case(b"SIPO_MODE");
            let Some(inside) = inside(cursor).filter(|_| is_function) else {
                return self.mode_value(None);
            };
            inner = inside;
        }
        if inner.take(b'#') {
            let name = inner.next();
            *cursor = Cursor {
                at: cursor.at.max(inner.at),
                ..*cursor
            };
            return self.mode_value(is_external(inner.text(name)));
        }
        let token = inner.next();
        let name = self.symbol(&inner, token);
        match inner.brackets() {
            Ok(at) => self.mode_in(name, Index::of(at, &inner)),
            Err(_) => self.mode_value(None),
        }
    }

    /// A tool or base up to a comma or the end of the line; one that is written out is called
    /// `name`.
    pub(super) fn frame(&mut self, table: Table, name: &str, cursor: &mut Cursor) -> Read<Expr> {
        // `BASE_DATA[3]:{X 10,...}`
        let mut factors = vec![self.plain_frame(table, name, cursor)?];
        while cursor.take(b':') {
            factors.push(self.plain_frame(table, name, cursor)?);
        }
        // C_DIS behind the last WITH
        let ends = matches!(cursor.blanks(), 0 | b',' | b';') || cursor.peek().kind == Kind::Name;
        if !ends {
            super::moves::skip_value(cursor);
            return Ok(self.chosen());
        }
        if let [one] = factors[..] {
            return Ok(one);
        }
        let script = &mut self.builder.script;
        let otherwise = script.remark(CHOSEN);
        Ok(script.product(name, factors, otherwise))
    }

    fn plain_frame(&mut self, table: Table, called: &str, cursor: &mut Cursor) -> Read<Expr> {
        if cursor.blanks() == b'{' {
            let found = aggregate::read(cursor)?;
            let file = self.file;
            return Ok(match found.frame() {
                Some(numbers) => {
                    let parts = numbers.map(|number| part(number, file));
                    Expr::Value(record(&mut self.builder.script, called, &parts))
                }
                None => self.chosen(),
            });
        }
        let name = cursor.next();
        if name.kind != Kind::Name {
            return Ok(self.chosen());
        }
        let at = cursor.brackets()?;
        let mut buffer = [0; 24];
        let word = capitals(cursor.text(name), &mut buffer);
        if let (Some(of @ (Table::Tool | Table::Base)), Some((start, end))) =
            (Table::named(word), at)
            && !matches!(cursor.blanks(), b'.' | b'(')
        {
            let choice = self.choice(cursor.part(start, end), of);
            return Ok(self.element(of, choice));
        }
        if matches!(cursor.blanks(), b'(') {
            let inner = inside(cursor);
            return Ok(match (word, inner) {
                (b"STOOL" | b"STOOL2", Some(inner)) => {
                    let choice = self.choice(inner, Table::Tool);
                    let choice = choice.or_else(|| self.missing_in(inner));
                    self.element(Table::Tool, choice)
                }
                (b"SBASE", Some(inner)) => {
                    let choice = self.choice(inner, Table::Base);
                    self.element(Table::Base, choice)
                }
                (b"EK", Some(inner)) if table == Table::Base => self.carried(called, inner)?,
                (b"EK", None) if table == Table::Base => self.unknown(MOVING),
                (b"LK", _) if table == Table::Base => self.unknown(LINKED),
                _ => self.chosen(),
            });
        }
        if cursor.blanks() == b'.' {
            cursor.skip();
            return Ok(self.chosen());
        }
        match (table, word) {
            (_, b"$NULLFRAME") | (Table::Base, b"$WORLD") => {
                let name = std::str::from_utf8(word).unwrap_or_default();
                Ok(self.known_frame(name, PartValue::Number(0.0)))
            }
            (_, b"$TOOL") => Ok(self.states.expr(State::Tool)),
            (_, b"$BASE") => Ok(self.states.expr(State::Base)),
            (Table::Base, b"$ROBROOT") => Ok(match self.root {
                Some(root) => self.fixed_frame("$ROBROOT", &root),
                None => self.chosen(),
            }),
            _ => {
                let symbol = self.symbol(cursor, name);
                let at = Index::of(at, cursor);
                Ok(self.frame_named(symbol, at))
            }
        }
    }

    /// `EK(MACHINE_DEF[2].ROOT,MACHINE_DEF[2].MECH_TYPE,{X 0,...})`: a base on a kinematic.
    fn carried(&mut self, called: &str, mut inner: Cursor) -> Read<Expr> {
        let machine = |cursor: &mut Cursor| -> Read<Option<u32>> {
            let name = cursor.next();
            let at = cursor.brackets()?;
            let is_machine = cursor.text(name).eq_ignore_ascii_case(b"MACHINE_DEF");
            let index = Index::of(at, cursor).first().filter(|_| is_machine);
            let is_part = cursor.take(b'.') && cursor.next().kind == Kind::Name;
            Ok(index.filter(|_| is_part && cursor.take(b',')))
        };
        let (root, kind) = (machine(&mut inner)?, machine(&mut inner)?);
        let known = root.filter(|root| Some(*root) == kind && inner.blanks() == b'{');
        let Some(number) = known else {
            return Ok(self.unknown(MOVING));
        };
        let found = aggregate::read(&mut inner)?;
        let file = self.file;
        Ok(match found.frame() {
            Some(numbers) => {
                let parts = numbers.map(|number| part(number, file));
                let script = &mut self.builder.script;
                Expr::Value(carried_record(script, called, &parts, unit(number)))
            }
            None => self.chosen(),
        })
    }

    /// A tool or base that is a variable.
    fn frame_named(&mut self, name: Symbol, at: Index) -> Expr {
        match self.named(name, at) {
            Some(Expr::Unknown(_)) => self.chosen(),
            Some(found) => found,
            None => {
                let spelled = self.names.symbols.spelling(name).to_owned();
                self.known_frame(&spelled, PartValue::Missing)
            }
        }
    }

    /// A load up to a comma or the end of the line.
    fn load_expr(&mut self, cursor: &mut Cursor) -> Read<Expr> {
        if cursor.blanks() == b'{' {
            return Ok(match load(cursor)? {
                Carried::Load(load) => self.load_value(Some(load)),
                Carried::OfTool => self.load_value(None),
                Carried::Unknown => self.unknown(carried()),
            });
        }
        let name = cursor.next();
        let at = cursor.brackets()?;
        let mut buffer = [0; 24];
        let choice = match (capitals(cursor.text(name), &mut buffer), at) {
            (b"LOAD_DATA", Some((start, end))) => self.choice(cursor.part(start, end), Table::Load),
            (b"SLOAD", None) => inside(cursor).and_then(|inner| self.choice(inner, Table::Load)),
            _ => None,
        };
        let is_whole = !matches!(cursor.blanks(), b'.' | b':');
        Ok(match choice.filter(|_| is_whole) {
            None => {
                cursor.skip();
                self.unknown(carried())
            }
            Some(Choice::Entry(at)) => {
                let of_nobody = self.load_of_nobody(at);
                of_nobody.unwrap_or_else(|| self.element(Table::Load, choice))
            }
            choice => self.element(Table::Load, choice),
        })
    }

    /// `BAS(#TOOL,1)`
    pub(super) fn bas(&mut self, first: Token, mut cursor: Cursor) {
        let place = self.place(first);
        cursor.take(b'(');
        if !cursor.take(b'#') {
            return self.anything_chosen(place);
        }
        let command = cursor.next();
        let argument = cursor.take(b',').then(|| {
            let start = cursor.at;
            cursor.skip();
            cursor.part(start, cursor.at)
        });
        let choice = |reader: &mut Self, table| match argument {
            Some(argument) => reader.choice(argument, table),
            None => Some(Choice::Entry(0)),
        };
        let mut buffer = [0; 24];
        match capitals(cursor.text(command), &mut buffer) {
            b"INITMOV" => {
                let [tool, base] = self.states.initial.map(Expr::Value);
                self.set(place, State::Tool, tool);
                self.set(place, State::Base, base);
                self.set(place, State::Ipo, Expr::Value(self.states.on));
                self.set(
                    place,
                    State::Orientation,
                    self.orientation_value(Turning::Evenly),
                );
                let [circle, ..] = self.circles.states;
                self.put(place, circle, self.circles.value(true));
            }
            b"TOOL" => {
                let choice = choice(self, Table::Tool);
                self.choose(place, Table::Tool, choice);
            }
            b"BASE" => {
                let choice = choice(self, Table::Base);
                self.choose(place, Table::Base, choice);
            }
            b"EX_BASE" => {
                let carried = self.unknown(MOVING);
                self.set(place, State::Base, carried);
            }
            command @ (b"FRAMES" | b"PTP_PARAMS" | b"CP_PARAMS" | b"PARAMS") => {
                let active = self.active;
                let is_same = active.is_some() && active == self.applied;
                let (last, heading) = (self.last, self.heading);
                let [tool, base] = [State::FdatTool, State::FdatBase]
                    .map(|state| Choice::By(self.states.states[state as usize]));
                self.choose(place, Table::Tool, Some(tool));
                self.choose(place, Table::Base, Some(base));
                self.set(place, State::Ipo, self.states.expr(State::FdatIpo));
                (self.active, self.applied) = (active, active);
                if is_same {
                    (self.last, self.heading) = (last, heading);
                }
                if command == b"CP_PARAMS" {
                    self.take_ldat(place);
                }
            }
            b"CP_DAT" => self.take_ldat(place),
            b"PTP_DAT" | b"GROUP" => {}
            // speeds and outputs
            command
                if [&b"ACC"[..], b"VEL", b"OUT"]
                    .iter()
                    .any(|of| command.starts_with(of)) => {}
            _ => self.anything_chosen(place),
        }
    }

    /// What `LDAT_ACT` says of how the tool turns holds from here on.
    fn take_ldat(&mut self, place: Place) {
        self.set(
            place,
            State::Orientation,
            self.states.expr(State::LdatOrientation),
        );
        let [circle, ..] = self.circles.states;
        self.put(place, circle, Expr::Variable(self.circles.active));
    }

    /// A command that nobody knows may set any tool and base.
    fn anything_chosen(&mut self, place: Place) {
        for state in [State::Tool, State::Base] {
            let chosen = self.chosen();
            self.set(place, state, chosen);
        }
    }

    /// Sets a tool with its load, or a base, of a table.
    fn choose(&mut self, place: Place, table: Table, choice: Option<Choice>) {
        let (state, active, name) = match table {
            Table::Base => (State::Base, State::ActBase, &b"$act_base"[..]),
            _ => (State::Tool, State::ActTool, &b"$act_tool"[..]),
        };
        let frame = self.element(table, choice);
        self.set(place, state, frame);
        if table == Table::Tool {
            let load = match choice {
                Some(_) => self.element(Table::Load, choice),
                None => self.load_value(None),
            };
            self.set(place, State::Load, load);
        }
        let used = self.names.symbols.find(name);
        if used.is_some_and(|name| self.names.choosing.contains(&name)) {
            let number = self.number_of(choice);
            self.set(place, active, number);
        }
    }

    /// A write of a state, or of one of its parts; the cursor stands behind `=`.
    pub(super) fn write_state(
        &mut self,
        place: Place,
        state: State,
        part: Option<&[u8]>,
        cursor: &mut Cursor,
    ) -> Read<()> {
        let variable = Written::One(self.states.states[state as usize]);
        match part {
            None => {
                let value = self.state_value(state, cursor)?;
                self.set(place, state, value);
            }
            Some(part) if matches!(state, State::Tool | State::Base) => {
                self.lose_place();
                self.write_part(place, variable, part, *cursor);
            }
            Some(_) => {
                let unknown = self.unknown(carried());
                self.set(place, state, unknown);
            }
        }
        Ok(())
    }

    /// `$TOOL.X=...`, `BASE_DATA[1].X=...`
    fn write_part(&mut self, place: Place, variable: Written, part: &[u8], cursor: Cursor) {
        if let Some(how) = self.part_of_frame(place, part, cursor) {
            self.builder.write(place, variable, how);
        }
    }

    /// What a write of a component makes of a frame.
    pub(super) fn part_of_frame(
        &mut self,
        place: Place,
        part: &[u8],
        mut cursor: Cursor,
    ) -> Option<How> {
        let at = match part {
            [letter] => b"XYZABC".iter().position(|known| known == letter)?,
            _ => return None,
        };
        cursor.blanks();
        let start = cursor.at;
        let text = &cursor.bytes[start..cursor.end];
        let text = text.split(|&b| b == b';').next().unwrap_or_default();
        let text = text.trim_ascii_end();
        let value = number::parse(text).filter(|value| value.abs() < aggregate::LARGEST);
        let script = &mut self.builder.script;
        script.parts.push(Part {
            value: value.map_or(PartValue::Computed, PartValue::Number),
            place: Place::new(place.file, short(start)),
            length: u16::try_from(text.len()).unwrap_or(u16::MAX),
        });
        let parts = short(script.parts.len() - 1)..short(script.parts.len());
        let first = short(at);
        Some(How::Parts { first, parts })
    }

    /// What a write of an entry of a table writes.
    pub(super) fn entry_written(&mut self, table: Table, at: Index) -> Written {
        match at.first() {
            Some(entry) => Written::One(self.entry(table, entry)),
            None => Written::AnyOf(self.states.tables[table as usize]),
        }
    }

    /// What an entry of a table holds.
    pub(super) fn entry_value(&mut self, table: Table, at: Index) -> Expr {
        self.element(table, at.first().map(Choice::Entry))
    }

    /// `BASE_DATA[2]={...}`, `TOOL_DATA[n].X=...`; the cursor stands behind `=`.
    pub(super) fn write_entry(
        &mut self,
        place: Place,
        table: Table,
        at: Option<(usize, usize)>,
        part: Option<&[u8]>,
        cursor: &mut Cursor,
    ) -> Read<()> {
        (self.heading, self.applied) = (None, None);
        let at = Index::of(at, cursor);
        let variable = self.entry_written(table, at);
        if let Some(part) = part {
            if table == Table::Load {
                let how = How::Whole(self.unknown(carried()));
                self.builder.write(place, variable, how);
            } else {
                self.write_part(place, variable, part, *cursor);
            }
            return Ok(());
        }
        let entry = at.first().unwrap_or_default();
        let name = format!("{}[{entry}]", table.name());
        let value = match table {
            Table::Load => self.load_expr(cursor)?,
            _ => match self.frame(table, &name, cursor)? {
                Expr::Unknown(_) => self.unknown(FRAME_ASSIGNED),
                Expr::Product(product) => {
                    let script = &mut self.builder.script;
                    let otherwise = script.remark(FRAME_ASSIGNED);
                    script.products[product as usize].otherwise = otherwise;
                    Expr::Product(product)
                }
                known => known,
            },
        };
        self.builder.write(place, variable, How::Whole(value));
        Ok(())
    }
}

/// What stands in the brackets in front, which are taken.
pub(super) fn inside<'a>(cursor: &mut Cursor<'a>) -> Option<Cursor<'a>> {
    if !cursor.take(b'(') {
        return None;
    }
    let start = cursor.at;
    loop {
        cursor.skip();
        let end = cursor.at;
        if cursor.take(b')') {
            return Some(cursor.part(start, end));
        }
        if !cursor.take(b',') && !cursor.take(b':') {
            return None;
        }
    }
}

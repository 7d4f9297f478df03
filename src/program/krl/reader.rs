//! One file into [`Notes`]: modules, routines, data lists.

use super::aggregate::{self, Aggregate, STATUS, TURN, WHOLE};
use super::notes::{
    DataKind, Datum, Entry, Fdat, Flaw, Index, Initial, Ipo, LoadEntry, Module, Notes, Operand,
    Part, Read, Routine, Stored, Table,
};
use super::tokens::{Cursor, Fault, Kind, Place, Token, capitals, content_start, index, lines};
use crate::program::rapid::names::{Context, Symbol};
use crate::program::{Layout, Shape, Source, Target, TargetId, number};

/// Reads one file at a time.
pub struct Reader<'a, 'n> {
    pub(super) notes: &'n mut Notes,
    pub(super) file: u32,
    pub(super) module: u32,
    /// The routine that is open, and where it starts.
    pub(super) routine: Option<(u32, u32)>,
    in_data: Option<u32>,
    bytes: &'a [u8],
}

impl<'a, 'n> Reader<'a, 'n> {
    /// Reads a file.
    ///
    /// # Errors
    /// Where it is broken.
    pub fn read(source: &'a Source, file: u32, notes: &'n mut Notes) -> Read<()> {
        let key = module_key(&source.name);
        let known = notes.modules.iter().rposition(|module| module.key == key);
        let module = known.unwrap_or_else(|| {
            notes.modules.push(Module {
                is_system: is_system(&key),
                key,
                has_source: false,
            });
            notes.modules.len() - 1
        });
        let mut reader = Reader {
            notes,
            file,
            module: index(module),
            routine: None,
            in_data: None,
            bytes: &source.bytes,
        };
        let start = content_start(&source.bytes);
        for (start, end) in lines(&source.bytes, start) {
            reader.line(start, end)?;
        }
        if let Some((_, at)) = reader.routine
            && !reader.implicit()
        {
            return Err(Fault::Unclosed {
                at,
                what: "a routine (DEF without END)",
            });
        }
        reader.close();
        if let Some(at) = reader.in_data {
            return Err(Fault::Unclosed {
                at,
                what: "a data list (DEFDAT without ENDDAT)",
            });
        }
        Ok(())
    }

    fn line(&mut self, start: usize, end: usize) -> Read<()> {
        let mut cursor = Cursor {
            bytes: self.bytes,
            at: start,
            end,
        };
        match cursor.blanks() {
            0 | b';' | b'&' => return Ok(()),
            _ => {}
        }
        let first = cursor.next();
        if first.kind != Kind::Name {
            return Ok(());
        }
        let mut buffer = [0; 24];
        let word = capitals(cursor.text(first), &mut buffer);
        match word {
            b"GLOBAL" | b"DECL" | b"PUBLIC" | b"CONST" => return self.declaration(first, cursor),
            b"DEF" => self.define(&mut cursor, first, false),
            b"DEFFCT" => {
                let mut rest = cursor;
                rest.next();
                self.define(&mut rest, first, false);
            }
            b"END" | b"ENDFCT" => self.close(),
            b"DEFDAT" => {
                self.in_data = Some(first.start);
                let name = cursor.next();
                if cursor.text(name).first() == Some(&b'$') {
                    self.notes.modules[self.module as usize].is_system = true;
                }
            }
            b"ENDDAT" => self.in_data = None,
            b"EXT" | b"EXTFCT" | b"ENUM" | b"STRUC" | b"SIGNAL" | b"IMPORT" => {}
            b"INT" | b"REAL" | b"BOOL" | b"CHAR" | b"POS" | b"E3POS" | b"E6POS" | b"FRAME"
            | b"AXIS" | b"E3AXIS" | b"E6AXIS" | b"FDAT"
                if cursor.peek().kind == Kind::Name =>
            {
                let kind = DataKind::named(word);
                return self.declared(kind, false, cursor);
            }
            _ if self.in_data.is_some() => return self.initial(first, cursor),
            _ => return self.statement(first, word, cursor),
        }
        Ok(())
    }

    /// `DEF name(a:IN, b:OUT)`
    fn define(&mut self, cursor: &mut Cursor, first: Token, global: bool) {
        self.close();
        let name = cursor.next();
        if name.kind != Kind::Name {
            return;
        }
        self.open(name, first.start, global);
        let context = self.context();
        while !matches!(cursor.peek().kind, Kind::End) {
            let token = cursor.next();
            if token.kind == Kind::Name {
                let name = self.symbol(cursor, token);
                self.notes.data.push(Datum {
                    name,
                    context,
                    global: false,
                    kind: DataKind::Other,
                    place: self.place(token),
                });
                // `:IN`
                if cursor.take(b':') {
                    cursor.next();
                }
            }
        }
    }

    fn open(&mut self, name: Token, start: u32, global: bool) {
        let first = index(self.notes.statements.len());
        let name = self
            .notes
            .symbols
            .intern(&self.bytes[name.start as usize..name.end as usize]);
        self.notes.modules[self.module as usize].has_source = true;
        self.routine = Some((index(self.notes.routines.len()), start));
        self.notes.routines.push(Routine {
            name,
            module: self.module,
            global,
            statements: (first, first),
        });
    }

    /// The routine that is open; statements outside of all make one of their own, without a name.
    pub(super) fn routine(&mut self) -> u32 {
        if self.routine.is_none() {
            let nameless = Token {
                kind: Kind::Name,
                start: 0,
                end: 0,
            };
            self.open(nameless, 0, false);
        }
        self.routine.expect("just opened").0
    }

    fn implicit(&self) -> bool {
        let none = self.notes.symbols.find(b"");
        self.routine
            .is_some_and(|(routine, _)| Some(self.notes.routines[routine as usize].name) == none)
    }

    fn close(&mut self) {
        if let Some((routine, _)) = self.routine.take() {
            self.notes.routines[routine as usize].statements.1 = index(self.notes.statements.len());
        }
    }

    pub(super) fn context(&self) -> Context {
        Context {
            module: self.module,
            routine: self.routine.map(|(routine, _)| routine),
        }
    }

    pub(super) fn place(&self, token: Token) -> Place {
        Place {
            file: self.file,
            offset: token.start,
        }
    }

    pub(super) fn symbol(&mut self, cursor: &Cursor, token: Token) -> Symbol {
        self.notes.symbols.intern(cursor.text(token))
    }

    /// `[GLOBAL] [DECL] [GLOBAL] [CONST] type names`, or `GLOBAL DEF`, `GLOBAL INTERRUPT DECL`.
    fn declaration(&mut self, first: Token, mut cursor: Cursor<'a>) -> Read<()> {
        let mut token = first;
        let mut global = false;
        loop {
            let mut buffer = [0; 24];
            match capitals(cursor.text(token), &mut buffer) {
                b"GLOBAL" => global = true,
                b"DECL" | b"PUBLIC" | b"CONST" => {}
                b"DEF" => {
                    self.define(&mut cursor, first, global);
                    return Ok(());
                }
                b"DEFFCT" => {
                    cursor.next();
                    self.define(&mut cursor, first, global);
                    return Ok(());
                }
                b"INTERRUPT" | b"SIGNAL" | b"ENUM" | b"STRUC" | b"EXT" | b"EXTFCT" => {
                    return Ok(());
                }
                word => {
                    let kind = DataKind::named(word);
                    return self.declared(kind, global, cursor);
                }
            }
            token = cursor.next();
            if token.kind != Kind::Name {
                return Ok(());
            }
        }
    }

    /// The names behind a type, each with sizes and a value or without.
    fn declared(&mut self, kind: DataKind, global: bool, mut cursor: Cursor<'a>) -> Read<()> {
        let in_data = self.in_data.is_some();
        let is_table = kind == DataKind::Frame || kind == DataKind::Other;
        if kind == DataKind::Other && in_data {
            // data of other types cannot be targets; their names do not matter
            return Ok(());
        }
        loop {
            let name = cursor.next();
            if name.kind != Kind::Name {
                return Ok(());
            }
            let symbol = self.symbol(&cursor, name);
            let context = self.context();
            let system = self.notes.modules[self.module as usize].is_system;
            self.notes.data.push(Datum {
                name: symbol,
                context,
                global: in_data && (global || system),
                kind,
                place: self.place(name),
            });
            let sizes = cursor.brackets()?;
            if cursor.take(b'=') {
                if is_table && self.table(name, sizes, &mut cursor)? {
                    return Ok(());
                }
                let index = self.element(sizes, &cursor);
                let value = self.stored(kind, name, &mut cursor)?;
                if let Some(value) = value {
                    self.notes.initials.push(Initial {
                        name: symbol,
                        index,
                        context,
                        value,
                    });
                }
            }
            if !cursor.take(b',') {
                return Ok(());
            }
        }
    }

    /// `name[1,2]={...}` in a data list.
    fn initial(&mut self, name: Token, mut cursor: Cursor<'a>) -> Read<()> {
        let at = cursor.brackets()?;
        if !cursor.take(b'=') || cursor.blanks() != b'{' || self.table(name, at, &mut cursor)? {
            return Ok(());
        }
        let symbol = self.symbol(&cursor, name);
        let kind = self.last_kind(symbol);
        let index = self.element(at, &cursor);
        if let Some(value) = self.stored(kind, name, &mut cursor)? {
            let context = self.context();
            self.notes.initials.push(Initial {
                name: symbol,
                index,
                context,
                value,
            });
        }
        Ok(())
    }

    /// The kind of an array whose elements follow its declaration.
    fn last_kind(&self, name: Symbol) -> DataKind {
        let module = self.module;
        let mut near = self.notes.data.iter().rev().take(4096);
        near.find(|datum| datum.name == name && datum.context.module == module)
            .map_or(DataKind::Other, |datum| datum.kind)
    }

    /// The value behind `=`; `None` where it does not matter.
    fn stored(
        &mut self,
        kind: DataKind,
        name: Token,
        cursor: &mut Cursor<'a>,
    ) -> Read<Option<Stored>> {
        if kind == DataKind::Other {
            return Ok(None);
        }
        if cursor.blanks() != b'{' {
            return Ok(Some(Stored::Computed));
        }
        if kind == DataKind::Fdat {
            return Ok(Some(Stored::Fdat(fdat(cursor)?)));
        }
        let start = cursor.at;
        let aggregate = aggregate::read(cursor)?;
        let text = &self.bytes[name.start as usize..start];
        let text = text.split(|&b| b == b'=').next().unwrap_or(text);
        let name = Source::text(text.trim_ascii());
        let target = self.add(&aggregate, start, Some(name.into()));
        Ok(Some(Stored::Target(target)))
    }

    /// A target with the numbers of an aggregate; one that cannot be rewritten is blocked and has none.
    pub(super) fn add(
        &mut self,
        aggregate: &Aggregate,
        start: usize,
        name: Option<Box<str>>,
    ) -> TargetId {
        let notes = &mut *self.notes;
        let first = index(notes.numbers.len());
        let id = notes.targets.len();
        let is_axes = aggregate.is_axes();
        let whole = if is_axes {
            aggregate.has_axes == WHOLE && aggregate.has == 0
        } else {
            aggregate.has & WHOLE == WHOLE
        };
        let flaw = if aggregate.computed {
            Some(Flaw::Computed)
        } else if whole {
            None
        } else {
            Some(Flaw::Partial)
        };
        let shape = if is_axes { Shape::Joints } else { Shape::Pose };
        let mut variant = 0;
        if let Some(flaw) = flaw {
            notes.flaws.push((id, flaw));
        } else if is_axes {
            notes.numbers.extend_from_slice(&aggregate.axes);
        } else {
            variant = aggregate.has >> 6;
            notes.numbers.extend_from_slice(&aggregate.position[..6]);
            for (bit, at) in [(STATUS, 6), (TURN, 7)] {
                if aggregate.has & bit != 0 {
                    notes.numbers.push(aggregate.position[at]);
                }
            }
        }
        notes.targets.push(Target {
            name,
            file: self.file,
            offset: index(start),
            layout: Layout { shape, variant },
            numbers: first..index(notes.numbers.len()),
            blocked: flaw.is_some(),
        });
        id
    }

    /// Values of the controller's tables; whether it is one of them.
    pub(super) fn table(
        &mut self,
        name: Token,
        at: Option<(usize, usize)>,
        cursor: &mut Cursor<'a>,
    ) -> Read<bool> {
        let mut buffer = [0; 24];
        let word = capitals(cursor.text(name), &mut buffer);
        let table = match word {
            b"TOOL_DATA" => Some(Table::Tool),
            b"BASE_DATA" => Some(Table::Base),
            b"LOAD_DATA" | b"MACHINE_FRAME_DAT" => None,
            _ => return Ok(false),
        };
        let element = match self.element(at, cursor) {
            Index::At([element, 0, 0]) => Some(element),
            _ => None,
        };
        let is_aggregate = cursor.blanks() == b'{';
        if let Some(table) = table {
            let value = if is_aggregate {
                aggregate::read(cursor)?.frame()
            } else {
                None
            };
            let assigned = self.in_data.is_none();
            let place = self.place(name);
            self.notes.entries.push(Entry {
                table,
                index: element,
                place,
                assigned,
                value,
            });
        } else if let (true, Some(element)) = (is_aggregate, element) {
            if word == b"LOAD_DATA" {
                self.load(element, cursor)?;
            } else {
                let mut moving = false;
                aggregate::each(cursor, |key, _, field| {
                    if let (b"MACH_DEF_INDEX", aggregate::Field::Number(number)) = (key, field) {
                        moving = number.value > 0.0;
                    }
                    Ok(())
                })?;
                if moving {
                    self.notes.moving_bases.push(element);
                }
            }
        }
        Ok(true)
    }

    /// `LOAD_DATA[1]={M 10.0,CM {X 0,Y 0,Z 100,...},J {...}}`
    fn load(&mut self, element: u32, cursor: &mut Cursor<'a>) -> Read<()> {
        let (mut mass, mut inside) = (None, None);
        aggregate::each(cursor, |key, _, field| {
            match (key, field) {
                (b"M", aggregate::Field::Number(number)) => mass = Some(number.value),
                (b"CM", aggregate::Field::Nested(start)) => inside = Some(start),
                _ => {}
            }
            Ok(())
        })?;
        if let (Some(mass_kg), Some(start)) = (mass, inside) {
            let mut inner = *cursor;
            inner.at = start;
            let centre = aggregate::read(&mut inner)?;
            if centre.has & 0b111 == 0b111 && !centre.computed && mass_kg > 0.0 {
                self.notes.loads.push(LoadEntry {
                    index: element,
                    mass_kg,
                    cog_mm: std::array::from_fn(|i| centre.position[i].value),
                });
            }
        }
        Ok(())
    }

    /// The element between brackets.
    pub(super) fn element(&self, at: Option<(usize, usize)>, cursor: &Cursor) -> Index {
        let Some((start, end)) = at else {
            return Index::Whole;
        };
        let mut place = [0; 3];
        let mut parts = cursor.bytes[start..end].split(|&b| b == b',');
        for slot in &mut place {
            let Some(part) = parts.next() else { break };
            let text = part.trim_ascii();
            let value = number::parse(text).filter(|v| v.fract() == 0.0 && (0.0..1e9).contains(v));
            let Some(value) = value else {
                return Index::Variable;
            };
            // 0 to 1e9 is checked
            #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
            {
                *slot = value as u32;
            }
        }
        if parts.next().is_some() {
            return Index::Variable;
        }
        Index::At(place)
    }

    /// A list of operands.
    pub(super) fn push_operands(&mut self, operands: &[Operand]) -> Part {
        let first = index(self.notes.operands.len());
        self.notes.operands.extend_from_slice(operands);
        (first, index(self.notes.operands.len()))
    }
}

/// `{TOOL_NO 1,BASE_NO 2,IPO_FRAME #BASE,...}`
///
/// # Errors
/// Where it is broken.
pub fn fdat(cursor: &mut Cursor) -> Read<Fdat> {
    let bytes = cursor.bytes;
    let mut found = Fdat {
        tool: None,
        base: None,
        ipo: Ipo::Base,
    };
    aggregate::each(cursor, |key, _, field| {
        let whole = match field {
            aggregate::Field::Number(number)
                if number.value.fract() == 0.0 && (0.0..1e6).contains(&number.value) =>
            {
                // 0 to 1e6 is checked
                #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
                Some(number.value as u32)
            }
            _ => None,
        };
        match (key, field) {
            (b"TOOL_NO", _) => found.tool = whole,
            (b"BASE_NO", _) => found.base = whole,
            (b"IPO_FRAME", aggregate::Field::Enum(name)) => {
                found.ipo = ipo(&bytes[name.start as usize..name.end as usize]);
            }
            (b"IPO_FRAME", _) => found.ipo = Ipo::Computed,
            _ => {}
        }
        Ok(())
    })?;
    Ok(found)
}

/// The mode of a name behind `#`.
pub fn ipo(name: &[u8]) -> Ipo {
    match name.to_ascii_uppercase().as_slice() {
        b"BASE" | b"NONE" => Ipo::Base,
        b"TCP" => Ipo::Tcp,
        _ => Ipo::Computed,
    }
}

/// What the files of one module have in common: folder and name without ending, in lower case.
fn module_key(name: &str) -> String {
    let lower = name.to_ascii_lowercase();
    let name_start = lower.rfind(['/', '\\']).map_or(0, |at| at + 1);
    match lower[name_start..].rfind('.') {
        Some(dot) if dot > 0 => lower[..name_start + dot].to_owned(),
        _ => lower,
    }
}

/// Whether a data list is one of the controller's own.
fn is_system(key: &str) -> bool {
    let mut parts = key.rsplit(['/', '\\']);
    parts.next().is_some_and(|name| name.starts_with('$'))
        || parts.any(|folder| matches!(folder, "mada" | "steu"))
}

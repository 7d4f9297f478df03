//! Files into a [`Script`]: first what all of them declare, then their statements.

use super::frames::{Declared, States};
use super::guards::Guards;
use super::interrupts::{Action, Concurrent};
use super::moves::{Heading, Last};
use super::names::{DataKind, Datum, Head, Index, Names};
use super::targets::Owner;
use super::tokens::{Cursor, Kind, Read, Token, capitals, lines};
use super::turning::Circles;
use crate::geometry::Pose;
use crate::program::kit::{Fault, content_start};
use crate::program::names::{Context, Symbol};
use crate::program::script::{Builder, Expr, Place, RemarkId, Start, TableId, VariableId, short};
use crate::program::{ExternalNames, Settings, Source};
use foldhash::{HashMap, HashMapExt, HashSet, HashSetExt};

/// Reads files into one script.
pub(super) struct Reader {
    pub(super) builder: Builder,
    pub(super) names: Names,
    pub(super) states: States,
    pub(super) circles: Circles,
    pub(super) guards: Guards,
    /// Some file says `#IGNORE`.
    pub(super) ignores: bool,
    /// A text says `#CONSTANT`: the tool may keep its orientation.
    pub(super) keeps: bool,
    /// Some file switches a sensor on.
    pub(super) senses: bool,
    /// Tools, bases and loads of data lists.
    pub(super) declared: Declared,
    pub(super) file: u32,
    pub(super) module: u32,
    pub(super) routine: Option<u32>,
    pub(super) in_data: Option<u32>,
    /// Routines that were begun, in the second reading.
    begun: u32,
    pub(super) variables: HashMap<(Owner, Index), VariableId>,
    pub(super) tables: HashMap<Owner, TableId>,
    /// Parts of FDAT that statements write.
    pub(super) fdats: HashMap<(u32, super::fdat::Part), VariableId>,
    pub(super) fdats_missing: HashMap<Symbol, VariableId>,
    /// The numbers of tool and base in `FDAT_ACT`, and those of the tool and base that are set, where
    /// both come from there.
    pub(super) active: Option<(Expr, Expr)>,
    pub(super) applied: Option<(Expr, Expr)>,
    /// All elements of an array.
    pub(super) arrays: HashMap<Owner, Expr>,
    /// What a name stands for that is declared more than once.
    pub(super) ambiguous: HashMap<(u32, Index), Expr>,
    /// Arrays that were refused, and why.
    pub(super) refused: HashSet<(u32, &'static str)>,
    pub(super) missing: HashMap<Symbol, RemarkId>,
    /// Routines of interrupts and triggers.
    pub(super) concurrent: Vec<Concurrent>,
    /// What interrupts and triggers assign or hand to routines.
    pub(super) actions: Vec<Action>,
    pub(super) switched: super::interrupts::Switched,
    /// Calls that are given an array whose elements are not followed.
    pub(super) unfollowed: Vec<Place>,
    /// Moves to the pose where the robot is.
    pub(super) stays: Vec<Place>,
    /// External axes that the profile describes.
    pub(super) external: ExternalNames,
    /// Where the robot stands in the world, where it stands still.
    pub(super) root: Option<Pose>,
    /// Set so for one move.
    pub(super) every_axis_off: Option<VariableId>,
    /// The present statement.
    pub(super) here: Place,
    /// What the functions returned that it calls, by their first bytes.
    pub(super) results: Vec<(u32, VariableId, DataKind)>,
    /// The positions in structures that functions return, by routine and by their path in it.
    pub(super) structures_returned: HashMap<(u32, Vec<u8>), VariableId>,
    /// Between SPLINE and ENDSPLINE.
    pub(super) in_spline: bool,
    /// What the spline that is open sets for its moves.
    pub(super) spline: super::moves::With,
    /// Where the robot is, for moves relative to it.
    pub(super) last: Option<Last>,
    /// The orientation of the position where the robot is.
    pub(super) heading: Option<Heading>,
    /// A trigger or stop stands before the next move and counts from its end, or the move calls
    /// functions.
    pub(super) is_referred: bool,
}

/// The words in front of a type.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct AsDeclared {
    pub global: bool,
    pub constant: bool,
}

/// What a line is.
enum Line<'a> {
    Nothing,
    Define {
        name: Token,
        /// The type of what a function returns.
        returns: Option<Token>,
        global: bool,
        rest: Cursor<'a>,
    },
    End,
    DataList(Token, Token),
    EndData,
    /// Names behind a type.
    Typed {
        of: Token,
        as_declared: AsDeclared,
        rest: Cursor<'a>,
    },
    Import(Cursor<'a>),
    /// A value in a data list.
    Initial(Token, Cursor<'a>),
    Statement(Token, Cursor<'a>),
}

impl Reader {
    pub(super) fn new(settings: &Settings) -> Self {
        let mut builder = Builder::default();
        Self {
            states: States::new(&mut builder.script),
            circles: Circles::new(&mut builder.script),
            guards: Guards::default(),
            ignores: false,
            keeps: false,
            senses: false,
            builder,
            external: settings.external.clone(),
            root: settings.world_from_base,
            names: Names::default(),
            declared: Declared::default(),
            file: 0,
            module: 0,
            routine: None,
            in_data: None,
            begun: 0,
            variables: HashMap::new(),
            tables: HashMap::new(),
            fdats: HashMap::new(),
            fdats_missing: HashMap::new(),
            active: None,
            applied: None,
            arrays: HashMap::new(),
            ambiguous: HashMap::new(),
            refused: HashSet::new(),
            missing: HashMap::new(),
            concurrent: Vec::new(),
            actions: Vec::new(),
            switched: super::interrupts::Switched::default(),
            unfollowed: Vec::new(),
            stays: Vec::new(),
            every_axis_off: None,
            here: Place::NOWHERE,
            results: Vec::new(),
            structures_returned: HashMap::default(),
            in_spline: false,
            spline: super::moves::With::default(),
            last: None,
            heading: None,
            is_referred: false,
        }
    }

    /// Nothing is known of where the robot is, and with which tool and base.
    pub(super) fn lose_place(&mut self) {
        (self.last, self.heading) = (None, None);
        (self.active, self.applied) = (None, None);
    }

    /// Reads what a file declares, and which names its statements write.
    ///
    /// # Errors
    /// Where it is broken.
    pub(super) fn declarations(&mut self, source: &Source, file: u32) -> Read<()> {
        self.begin(source, file);
        let bytes = &source.bytes;
        let says = |word: &[u8]| {
            let is_it = |at: usize| {
                let name = bytes.get(at + 1..at + 1 + word.len());
                name.is_some_and(|name| name.eq_ignore_ascii_case(word))
            };
            memchr::memchr_iter(b'#', bytes).any(is_it)
        };
        self.declared.has_fixed_tools |= says(b"TCP");
        self.ignores |= says(b"IGNORE");
        self.keeps |= says(b"CONSTANT");
        self.senses |= super::sensors::are_in(bytes);
        let is_submit = source.name.to_ascii_lowercase().ends_with(".sub");
        let mut open = None;
        for (start, end) in lines(&source.bytes, content_start(&source.bytes)) {
            match self.line(&source.bytes, start, end) {
                Line::Nothing => {}
                Line::Define {
                    name,
                    returns,
                    global,
                    rest,
                } => {
                    let first = short(start);
                    open = Some(first);
                    self.define(name, global, rest);
                    if let Some(of) = returns {
                        let returns = self.kind_of_type(of, &rest);
                        let head = self.names.heads.last_mut();
                        head.expect("it was just added").returns = returns;
                    }
                    if is_submit && self.first_of_file(file) {
                        // it runs concurrently with the robot's program
                        self.builder.script.routines[self.names.heads.len() - 1].start =
                            Start::Concurrent;
                    }
                }
                Line::End => {
                    self.routine = None;
                    open = None;
                }
                Line::DataList(first, name) => {
                    self.in_data = Some(first.start);
                    if source.bytes.get(name.start as usize) == Some(&b'$') {
                        self.names.modules[self.module as usize].is_system = true;
                    }
                }
                Line::EndData => self.in_data = None,
                Line::Import(rest) => self.import(rest),
                Line::Typed {
                    of,
                    as_declared,
                    rest,
                } => {
                    let kind = self.kind_of_type(of, &rest);
                    self.declared(kind, as_declared, rest)?;
                    if matches!(kind, DataKind::Number | DataKind::Other) {
                        self.numbers_declared(rest);
                    }
                }
                Line::Initial(name, rest) => {
                    self.number_initial(name, rest);
                    self.initial(name, rest)?;
                }
                Line::Statement(first, rest) => {
                    if self.routine.is_none() {
                        self.add_routine(b"", short(start), false);
                    }
                    self.note(first, rest);
                }
            }
        }
        if let Some(at) = open {
            return Err(Fault::unclosed(at as usize, "a routine (DEF without END)"));
        }
        if let Some(at) = self.in_data {
            return Err(Fault::unclosed(
                at as usize,
                "a data list (DEFDAT without ENDDAT)",
            ));
        }
        Ok(())
    }

    fn first_of_file(&self, file: u32) -> bool {
        let mut of_file = self.builder.script.routines.iter();
        of_file.rposition(|routine| routine.place.file != file)
            == self.names.heads.len().checked_sub(2)
    }

    /// Once the declarations of all files are read.
    pub(super) fn settle(&mut self) {
        self.names.known.end();
        self.names.settle();
        self.settle_components();
        self.mark_concurrent();
        // interrupts and triggers are known where they are declared, and in what is called there
        self.builder.script.ends_what_runs = true;
    }

    /// Reads the statements of a file whose declarations are known.
    ///
    /// # Errors
    /// Where it is broken.
    pub(super) fn statements(&mut self, source: &Source, file: u32) -> Read<()> {
        self.begin(source, file);
        for (start, end) in lines(&source.bytes, content_start(&source.bytes)) {
            match self.line(&source.bytes, start, end) {
                Line::Define { .. } => self.next_routine(),
                Line::End => {
                    self.builder.close();
                    self.routine = None;
                }
                Line::DataList(first, _) => self.in_data = Some(first.start),
                Line::EndData => self.in_data = None,
                Line::Statement(first, rest) => {
                    if self.routine.is_none() {
                        self.next_routine();
                    }
                    self.statement(first, rest)?;
                }
                Line::Nothing | Line::Typed { .. } | Line::Import(_) | Line::Initial(..) => {}
            }
        }
        self.builder.close();
        self.act_at_any_time(&source.bytes)
    }

    fn begin(&mut self, source: &Source, file: u32) {
        self.file = file;
        self.module = self.names.module(&source.name);
        (self.routine, self.in_data) = (None, None);
    }

    fn next_routine(&mut self) {
        self.builder.open(self.begun);
        self.routine = Some(self.begun);
        self.begun += 1;
        (self.spline, self.in_spline) = (super::moves::With::default(), false);
        self.lose_place();
        self.is_referred = false;
    }

    fn line<'a>(&self, bytes: &'a [u8], start: usize, end: usize) -> Line<'a> {
        let mut cursor = Cursor {
            bytes,
            at: start,
            end,
        };
        match cursor.blanks() {
            0 | b';' | b'&' => return Line::Nothing,
            _ => {}
        }
        let first = cursor.next();
        if first.kind != Kind::Name {
            return Line::Nothing;
        }
        let mut buffer = [0; 24];
        let word = capitals(cursor.text(first), &mut buffer);
        match word {
            b"GLOBAL" | b"DECL" | b"PUBLIC" | b"CONST" | b"DEF" | b"DEFFCT" => {
                declaration(first, cursor)
            }
            b"END" | b"ENDFCT" => Line::End,
            b"DEFDAT" => Line::DataList(first, cursor.next()),
            b"ENDDAT" => Line::EndData,
            b"EXT" | b"EXTFCT" | b"ENUM" | b"STRUC" | b"SIGNAL" => Line::Nothing,
            b"IMPORT" => Line::Import(cursor),
            b"INT" | b"REAL" | b"BOOL" | b"CHAR" | b"POS" | b"E3POS" | b"E6POS" | b"FRAME"
            | b"AXIS" | b"E3AXIS" | b"E6AXIS" | b"FDAT" | b"LDAT"
                if cursor.peek().kind == Kind::Name =>
            {
                Line::Typed {
                    of: first,
                    as_declared: AsDeclared::default(),
                    rest: cursor,
                }
            }
            _ if self.in_data.is_some() => Line::Initial(first, cursor),
            _ => Line::Statement(first, cursor),
        }
    }

    /// The kind of the type that a word names.
    fn kind_of_type(&mut self, of: Token, cursor: &Cursor) -> DataKind {
        let kind = DataKind::named(capitals(cursor.text(of), &mut [0; 24]));
        if kind != DataKind::Other || self.names.structures.is_empty() {
            return kind;
        }
        let of = self.symbol(cursor, of);
        self.structure_of(of)
    }

    /// `DEF name(a:IN, b:OUT)`
    fn define(&mut self, name: Token, global: bool, mut cursor: Cursor) {
        self.add_routine(cursor.text(name), name.start, global);
        let context = self.context();
        let mut parameters = Vec::new();
        while cursor.peek().kind != Kind::End {
            let token = cursor.next();
            if token.kind != Kind::Name {
                continue;
            }
            let name = self.names.symbols.intern(cursor.text(token));
            let datum = Datum {
                name,
                context,
                kind: DataKind::Other,
                place: self.place(token),
                kept: false,
                constant: false,
            };
            let datum = self.names.declare(datum, false);
            let mut by_reference = true;
            if cursor.take(b':') {
                let manner = cursor.next();
                by_reference = !cursor.text(manner).eq_ignore_ascii_case(b"IN");
            }
            parameters.push((datum, by_reference));
        }
        let head = self.names.heads.last_mut().expect("it was just added");
        head.parameters = parameters;
    }

    fn add_routine(&mut self, name: &[u8], offset: u32, global: bool) {
        let file = self.file;
        let spelled = Source::text(name);
        let place = Place::new(file, offset);
        self.routine = Some(self.builder.declare(spelled, place, Start::Called));
        let head = Head {
            module: self.module,
            parameters: Vec::new(),
            returns: DataKind::Other,
            result: None,
        };
        let name = self.names.symbols.intern(name);
        self.names.add_routine(name, head, global);
        self.names.known.begin(self.routine.unwrap_or_default());
    }

    pub(super) fn context(&self) -> Context {
        Context {
            module: self.module,
            routine: self.routine,
        }
    }

    pub(super) fn place(&self, token: Token) -> Place {
        Place::new(self.file, token.start)
    }

    pub(super) fn symbol(&mut self, cursor: &Cursor, token: Token) -> Symbol {
        self.names.symbols.intern(cursor.text(token))
    }
}

/// `[GLOBAL] [DECL] [GLOBAL] [CONST] type names`, or `[GLOBAL] DEF`, `GLOBAL INTERRUPT DECL`.
fn declaration(first: Token, mut cursor: Cursor) -> Line {
    let mut token = first;
    let mut as_declared = AsDeclared::default();
    loop {
        let mut buffer = [0; 24];
        match capitals(cursor.text(token), &mut buffer) {
            b"GLOBAL" => as_declared.global = true,
            b"CONST" => as_declared.constant = true,
            b"DECL" | b"PUBLIC" => {}
            word @ (b"DEF" | b"DEFFCT") => {
                let returns = (word == b"DEFFCT").then(|| cursor.next());
                let name = cursor.next();
                if name.kind != Kind::Name {
                    return Line::Nothing;
                }
                return Line::Define {
                    name,
                    returns,
                    global: as_declared.global,
                    rest: cursor,
                };
            }
            b"INTERRUPT" => return Line::Statement(token, cursor),
            b"SIGNAL" | b"ENUM" | b"STRUC" | b"EXT" | b"EXTFCT" => return Line::Nothing,
            _ => {
                return Line::Typed {
                    of: token,
                    as_declared,
                    rest: cursor,
                };
            }
        }
        token = cursor.next();
        if token.kind != Kind::Name {
            return Line::Nothing;
        }
    }
}

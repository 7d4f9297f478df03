//! What branches ask of the parameters of routines: `IF n==2 THEN`, `SWITCH tool`. Where a call gives
//! a number, TRUE or a value of an ENUM, it runs the branch that it is given.

use super::calls::{Given, only_reads};
use super::names::{DataKind, Index, Names};
use super::numbers::OF_ROUTINE;
use super::reader::Reader;
use super::statements::CONDITIONS;
use super::tokens::{Cursor, Kind};
use crate::program::kit::spread;
use crate::program::names::{Context, Symbol};
use crate::program::number;
use crate::program::numbers::{First, Literal, Question, cases, names_asked, questions, word};
use crate::program::script::{Expr, Test, Tests, VariableId};
use foldhash::HashSet;

/// The largest INT.
const MOST_INT: u32 = i32::MAX.unsigned_abs();
/// Values of ENUM are numbers from here on, which no INT reaches.
const OF_ENUM: i64 = 1 << 40;

/// Words of expressions in front of brackets.
const OPERATORS: [&[u8]; 10] = [
    b"NOT", b"AND", b"OR", b"EXOR", b"B_NOT", b"B_AND", b"B_OR", b"B_EXOR", b"DIV", b"THEN",
];

/// Routines of the controller that tell by an argument what came of them: a handle, a state, an
/// offset, an error.
///
/// # Source
/// KUKA, CREAD/CWRITE; KUKA System Software, Operating and Programming Instructions for System
/// Integrators, `FORWARD`, `INVERSE`.
const TELLING: [&[u8]; 9] = [
    b"FORWARD",
    b"INVERSE",
    b"INV_POS",
    b"COPEN",
    b"CCLOSE",
    b"CWRITE",
    b"CIOCTL",
    b"SWRITE",
    b"VARSTATE",
];

/// What is known of parameters that branches ask about, all as variables of their routines.
#[derive(Debug, Default)]
pub(super) struct Asked {
    /// Those that branches depend on, or that are given to such.
    parameters: HashSet<u32>,
    /// What statements write.
    written: HashSet<u32>,
}

impl Names {
    /// The value that a text is.
    pub(super) fn literal(&mut self, text: &[u8]) -> Option<Literal> {
        if let Some(value) = text.strip_prefix(b"#") {
            let value = value.trim_ascii();
            let symbol = self.symbols.intern(value);
            return (!value.is_empty()).then(|| Literal::Number(OF_ENUM + i64::from(symbol.0)));
        }
        Literal::flag(text).or_else(|| Literal::whole(number::parse(text)?, MOST_INT))
    }

    /// The variable of the present routine that a name is.
    fn own(&self, name: Symbol, context: Context) -> Option<u32> {
        let own = self.number(name, context);
        (own & OF_ROUTINE != 0).then_some(own & !OF_ROUTINE)
    }

    /// Notes that a statement writes a name.
    pub(super) fn note_own_written(&mut self, name: Symbol, context: Context) {
        let own = self.own(name, context);
        self.asked.written.extend(own);
    }

    /// What branches ask for, once all calls are known: also what is given to parameters that they
    /// ask about.
    pub(super) fn settle_asked(&mut self) {
        let mut pairs = Vec::new();
        let mut written = std::mem::take(&mut self.asked.written);
        for &(name, routine, at, context) in &self.given {
            let Some(own) = self.own(name, context) else {
                continue;
            };
            let Some(callee) = self.routine(routine, context) else {
                // a routine that is not in the files may write it
                if !is_reading(self.symbols.spelling(routine).as_bytes()) {
                    written.insert(own);
                }
                continue;
            };
            let parameter = self.heads[callee as usize].parameters.get(at);
            pairs.extend(parameter.map(|parameter| (own, *parameter)));
        }
        let back = pairs.iter().filter(|(_, (_, by_reference))| *by_reference);
        spread(&mut written, back.map(|&(own, (to, _))| (to, own)));
        let mut asked = std::mem::take(&mut self.asked.parameters);
        spread(&mut asked, pairs.iter().map(|&(own, (to, _))| (to, own)));
        let all = self.heads.iter().flat_map(|head| &head.parameters);
        let parameters: HashSet<u32> = all.map(|(parameter, _)| *parameter).collect();
        asked.retain(|own| parameters.contains(own) && !written.contains(own));
        self.asked.parameters = asked;
    }

    /// Whether branches ask about a parameter, which nothing but calls gives a value.
    pub(super) fn is_asked(&self, parameter: u32) -> bool {
        self.asked.parameters.contains(&parameter)
    }
}

/// Whether what stands in front of brackets writes nothing in them: no routine, or one that only
/// reads.
fn is_reading(word: &[u8]) -> bool {
    let is = |of: &&[u8]| of.eq_ignore_ascii_case(word);
    let is_word = CONDITIONS.iter().chain(&OPERATORS).any(is);
    is_word || only_reads(word) && !TELLING.iter().any(is)
}

/// The text of a line, without its comment.
fn text_of(mut cursor: Cursor<'_>) -> &[u8] {
    let start = cursor.at;
    let mut end = start;
    loop {
        let token = cursor.next();
        if token.kind == Kind::End {
            return cursor.bytes[start..end].trim_ascii();
        }
        end = token.end as usize;
    }
}

/// What stands between IF and THEN.
fn condition(cursor: Cursor<'_>) -> &[u8] {
    let text = text_of(cursor);
    let end = word(&text.to_ascii_uppercase(), "THEN");
    text[..end.unwrap_or(text.len())].trim_ascii()
}

impl Reader {
    /// Notes what an IF or SWITCH asks about.
    pub(super) fn note_asked(&mut self, word: &[u8], cursor: Cursor) {
        let names = match word {
            b"IF" => names_asked(condition(cursor)),
            b"SWITCH" => vec![text_of(cursor)],
            _ => Vec::new(),
        };
        let names = names
            .into_iter()
            .filter_map(|name| self.names.symbols.find(name));
        let own = names.filter_map(|name| self.names.own(name, self.context()));
        let own: Vec<u32> = own.collect();
        self.names.asked.parameters.extend(own);
    }

    /// What an IF asks of parameters.
    pub(super) fn tests(&mut self, cursor: Cursor) -> Tests {
        questions(condition(cursor), First::Joins).map(&mut |of| self.test(of.as_ref()?))
    }

    fn test(&mut self, of: &Question) -> Option<Test> {
        let wanted = of.wanted(|text| self.names.literal(text))?;
        Some((self.asked_of(of.name)?, wanted))
    }

    /// What a SWITCH asks about.
    pub(super) fn switched(&mut self, cursor: Cursor) -> Option<VariableId> {
        self.asked_of(text_of(cursor))
    }

    /// The numbers of a CASE; none where it has another value.
    pub(super) fn cases(&mut self, cursor: Cursor) -> Vec<i64> {
        cases(text_of(cursor), &mut |text| self.names.literal(text))
    }

    fn asked_of(&mut self, name: &[u8]) -> Option<VariableId> {
        let name = self.names.symbols.find(name)?;
        let own = self.names.own(name, self.context())?;
        self.names.is_asked(own).then(|| self.variable_of(own))
    }

    /// What a call gives a parameter that branches alone ask about, and its variable; `None` where the
    /// text does not tell.
    pub(super) fn choice_given(
        &mut self,
        given: &Given,
        parameter: Option<(u32, bool)>,
    ) -> Option<(VariableId, Expr)> {
        let (parameter, _) = parameter?;
        let of = &self.names.data[parameter as usize];
        // one that chooses a tool or base, too, has it as these
        let chooses = of.kind == DataKind::Number && self.names.choosing.contains(&of.name);
        if chooses || of.kind.is_place() || !self.names.is_asked(parameter) {
            return None;
        }
        let literal = match *given {
            Given::Number(number) => Literal::Number(i64::from(number)),
            Given::Literal(literal) => literal,
            Given::Named(name, Index::Whole) => {
                let own = self.names.own(name, self.context())?;
                let is_asked = self.names.is_asked(own);
                let own = is_asked.then(|| Expr::Variable(self.variable_of(own)))?;
                return Some((self.variable_of(parameter), own));
            }
            _ => return None,
        };
        let value = self.builder.script.held(literal.held());
        Some((self.variable_of(parameter), value))
    }
}

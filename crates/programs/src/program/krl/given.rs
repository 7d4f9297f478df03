//! What calls give to the parameters of routines.

use super::components::{Value, part_of};
use super::names::Names;
use super::numbers::{OF_ROUTINE, Written, is_worked_out};
use super::reader::Reader;
use super::tokens::Cursor;
use crate::program::names::Symbol;
use crate::program::numbers::Site;
use crate::program::quantity::is_letter;
use crate::program::script::{Place, short};

/// An argument of a call.
#[derive(Debug)]
pub(super) struct Given {
    routine: Symbol,
    at: usize,
    value: Written,
    /// The variable that it is, or an element of which, and which component of that.
    variable: Option<(Symbol, Option<u8>)>,
}

/// Longer arguments are not followed.
const LONGEST: usize = 200;

impl Names {
    /// Parameters have what calls give them, once all routines are known.
    pub(super) fn give_numbers(&mut self) {
        for (routine, context) in std::mem::take(&mut self.known.called) {
            let callee = self.routine(routine, context);
            if let (Some(callee), Some(caller)) = (callee, context.routine) {
                self.known.numbers.calls(caller, callee);
            }
        }
        for (routine, context) in std::mem::take(&mut self.known.interrupting) {
            if let Some(callee) = self.routine(routine, context) {
                self.known.numbers.runs_at_any_time(callee);
            }
        }
        for given in std::mem::take(&mut self.known.given) {
            let Given { routine, at, .. } = given;
            let Written::Value(text, place, context) = given.value else {
                continue;
            };
            let Some(callee) = self.routine(routine, context) else {
                // a routine that is not in the files may write it
                let is_known = is_worked_out(self.symbols.spelling(routine).as_bytes());
                if let Some((name, part)) = given.variable.filter(|_| !is_known) {
                    let number = self.number(name, context);
                    self.known.numbers.lose(number);
                    self.known.frame_lost((name, context), part, Value::Lost);
                }
                continue;
            };
            let parameter = self.heads[callee as usize].parameters.get(at);
            let Some(&(datum, is_written_back)) = parameter else {
                continue;
            };
            let of = &self.data[datum as usize];
            let (name, within) = (of.name, of.context);
            let datum = self.datum(name, within).unwrap_or(datum);
            let number = OF_ROUTINE | datum;
            let site = Site::at_start(callee);
            let back = given.variable.filter(|_| is_written_back);
            if let Some((name, part)) = back {
                self.known
                    .frame_lost((name, context), part, Value::Unfollowed);
            }
            if self.data[datum as usize].kind.is_place() {
                let value = Value::Text(text, place, context);
                self.known.frame_given((name, within), value, site);
                continue;
            }
            match back {
                Some((variable, None)) => {
                    let variable = self.number(variable, context);
                    self.known.numbers.unite(variable, number);
                }
                Some((_, Some(_))) => self.known.numbers.give_up(number),
                None if self.known.declared.contains(&number) => {
                    let value = Written::Value(text, place, context);
                    self.known.numbers.write(number, value, Some(site));
                }
                None => {}
            }
        }
    }
}

impl Reader {
    /// What a call gives a routine as one of its arguments, up to the sign behind it.
    pub(super) fn number_given(
        &mut self,
        (routine, at): (Symbol, usize),
        start: usize,
        cursor: &Cursor,
    ) {
        let text = cursor.bytes[start..cursor.at.max(start + 1) - 1].trim_ascii();
        if !text.is_empty() && !text.starts_with(b"#") {
            let place = Place::new(self.file, short(start));
            let followed = if text.len() > LONGEST { b"?" } else { text };
            let value = Written::Value(followed.into(), place, self.context());
            let (whole, part) = match memchr::memrchr(b'.', text) {
                Some(dot) => (&text[..dot], part_of(&text[dot + 1..])),
                None => (text, None),
            };
            let length = whole.iter().take_while(|b| is_letter(**b)).count();
            let rest = whole[length..].trim_ascii();
            let is_place = rest.is_empty() || rest.starts_with(b"[") && rest.ends_with(b"]");
            let is_name = length > 0 && !text[0].is_ascii_digit() && is_place;
            let variable = is_name.then(|| (self.names.symbols.intern(&text[..length]), part));
            self.names.known.given.push(Given {
                routine,
                at,
                value,
                variable,
            });
        }
    }
}

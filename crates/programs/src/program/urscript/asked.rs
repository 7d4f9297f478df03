//! What branches ask of the parameters of functions: `if n == 2:`, `switch tool:`. Where a call gives
//! a number, a variable that has one value, `True` or `False`, it runs the branch that it is given.

use super::numbers::Written;
use super::reader::Reader;
use super::syntax::{Event, Expr, FunctionId};
use super::translate::Translator;
use super::variables::{Assigned, VarId, Variables};
use crate::program::kit::spread;
use crate::program::number;
use crate::program::numbers::{First, Literal, Question, inside_brackets, names_asked, questions};
use crate::program::script::{self, Test, Tests, Variable, VariableId, short};
use foldhash::HashSet;

/// The largest int.
const MOST_INT: u32 = i32::MAX.unsigned_abs();

/// The bytes of a condition, without the colon behind it; nothing where a comment stands in it.
fn condition(text: &[u8]) -> &[u8] {
    if text.contains(&b'#') {
        return b"";
    }
    let text = text.trim_ascii_end();
    inside_brackets(text.strip_suffix(b":").unwrap_or(text))
}

impl Reader<'_> {
    /// Notes what the condition asks that has been read from a byte on, if that is a parameter; what
    /// a CASE has is always noted.
    pub(super) fn note_question(&mut self, word: &[u8], start: usize) {
        let text = &self.scanner.bytes[start..self.scanner.at];
        let text = condition(text);
        let names = match word {
            b"switch" => vec![text],
            b"case" => Vec::new(),
            _ => names_asked(text),
        };
        let own = &self.parsed.functions[self.function as usize].parameters;
        let mut symbols = names
            .into_iter()
            .filter_map(|name| self.parsed.known_symbol(name));
        let is_own = symbols.any(|symbol| own.iter().any(|(of, _)| *of == symbol));
        if is_own || word == b"case" && !own.is_empty() {
            self.event(Event::Question(short(start), short(self.scanner.at)));
        }
    }
}

impl Variables<'_, '_> {
    /// The parameters that branches ask about or that are given to such, and that nothing but calls
    /// gives a value.
    pub(super) fn find_asked(&mut self) {
        let parsed = self.parsed;
        let mut asked = HashSet::default();
        for (at, function) in (0..).zip(&parsed.functions) {
            for event in &function.events {
                if let Event::Question(start, end) = *event {
                    let names = names_asked(self.condition_of((start, end))).into_iter();
                    asked.extend(names.filter_map(|name| self.parameter(name, at)));
                }
            }
        }
        if asked.is_empty() {
            return;
        }
        let mut pairs = Vec::new();
        for call in &parsed.calls {
            for &callee in self.callees(call) {
                for position in 0..parsed.functions[callee as usize].parameters.len() {
                    let (parameter, given) = self.given(call, callee, position);
                    if let Some((value, function)) = given
                        && let Expr::Name(name, _) = parsed.expression(value)
                    {
                        let own = self.parameter(parsed.bytes(name), function);
                        pairs.extend(own.map(|own| (parameter, own)));
                    }
                }
            }
        }
        spread(&mut asked, pairs);
        let is_given = |of: &VarId| self.sources(*of).all(|one| one.way == Assigned::Given);
        asked.retain(is_given);
        self.asked = asked;
    }

    fn condition_of(&self, (start, end): (u32, u32)) -> &[u8] {
        condition(&self.parsed.text[start as usize..end as usize])
    }

    /// The parameter of a function that a name means in it.
    fn parameter(&self, name: &[u8], function: FunctionId) -> Option<VarId> {
        let variable = self.meaning(self.parsed.known_symbol(name)?, function)?;
        let is_own = self.list[variable as usize].parameter == Some(function);
        is_own.then_some(variable)
    }

    /// The value that a text is: `True`, `False`, a whole number, or a variable that has one.
    fn literal(&self, text: &[u8], function: FunctionId) -> Option<Literal> {
        let fixed = || {
            let name = self.parsed.known_symbol(text)?;
            let variable = self.meaning(name, function)?;
            // of a variable of a function around this one and of a global one either may be meant
            let unit = self.parsed.functions[function as usize].unit;
            let global = self.meaning(name, unit);
            if global.is_some_and(|global| global != variable) {
                return None;
            }
            match self.parsed.expression(self.fixed(variable)?.value) {
                Expr::Number(value) => Some(value),
                _ => None,
            }
        };
        let value = || number::parse(text).or_else(fixed);
        Literal::flag(text).or_else(|| Literal::whole(value()?, MOST_INT))
    }
}

impl Translator<'_, '_, '_> {
    /// On what the condition between these bytes depends.
    pub(super) fn tests_of(&mut self, part: (u32, u32), function: FunctionId) -> Tests {
        let variables = self.goals.variables;
        let questions = questions(variables.condition_of(part), First::Comparisons);
        questions.map(&mut |of| self.test(of.as_ref()?, function))
    }

    fn test(&mut self, of: &Question, function: FunctionId) -> Option<Test> {
        let variables = self.goals.variables;
        let wanted = of.wanted(|text| variables.literal(text, function))?;
        Some((self.asked(of.name, function)?, wanted))
    }

    /// About what a `switch` asks.
    pub(super) fn switched(
        &mut self,
        part: (u32, u32),
        function: FunctionId,
    ) -> Option<VariableId> {
        let variables = self.goals.variables;
        self.asked(variables.condition_of(part), function)
    }

    /// The number of a `case`.
    pub(super) fn case(&self, part: (u32, u32), function: FunctionId) -> Option<i64> {
        let variables = self.goals.variables;
        let literal = variables.literal(variables.condition_of(part), function);
        literal.and_then(Literal::number)
    }

    /// What a call gives a parameter about which branches ask, and its variable; `None` where the
    /// text does not tell.
    pub(super) fn choice_given(
        &mut self,
        call: u32,
        callee: FunctionId,
        position: usize,
    ) -> Option<script::Argument> {
        let parsed = self.goals.parsed;
        let variables = self.goals.variables;
        let of = &parsed.calls[call as usize];
        let (parameter, _) = variables.given(of, callee, position);
        if !variables.asked.contains(&parameter) {
            return None;
        }
        let given = Written::Given {
            call,
            callee,
            position,
        };
        let (text, function) = variables.text_of(given)?;
        let text = inside_brackets(text);
        let value = match variables.literal(text, function) {
            Some(literal) => self.goals.builder.script.held(literal.held()),
            None => script::Expr::Variable(self.asked(text, function)?),
        };
        let choice = self.choice(parameter);
        Some(script::Argument::new(Some(choice), value, None))
    }

    fn asked(&mut self, name: &[u8], function: FunctionId) -> Option<VariableId> {
        let variables = self.goals.variables;
        let parameter = variables.parameter(name, function)?;
        let is_asked = variables.asked.contains(&parameter);
        is_asked.then(|| self.choice(parameter))
    }

    fn choice(&mut self, parameter: VarId) -> VariableId {
        if let Some(&known) = self.choices.get(&parameter) {
            return known;
        }
        let of = &self.goals.variables.list[parameter as usize];
        let name = self.goals.parsed.spelling(of.name);
        let variable = Variable {
            routine: of.parameter.map(|function| self.first_routine + function),
            ..Variable::new(name, self.at(of.offset), script::Expr::Absent)
        };
        let made = self.goals.builder.script.variable(variable);
        self.choices.insert(parameter, made);
        made
    }
}

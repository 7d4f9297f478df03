//! What routines are given: by parameters, and by variables that others write.

use crate::program::Target;
use crate::program::script::{
    Expr, How, Instruction, Place, Script, VariableId, Write, Written, short,
};
use foldhash::{HashMap, HashMapExt};

/// Copies of copies that are followed.
const MOST_COPIES: usize = 8;

/// Writes of one variable that are looked at.
const MOST_WRITES: usize = 64;

/// What routines are given.
pub(super) struct Given {
    /// Variables that calls give values.
    parameters: Vec<bool>,
    /// The writes of variables, by index in [`Script::writes`].
    writes: HashMap<VariableId, Vec<u32>>,
}

impl Given {
    pub(super) fn of(script: &Script) -> Self {
        let mut parameters = vec![false; script.variables.len()];
        for parameter in script.arguments.iter().filter_map(|of| of.parameter) {
            parameters[parameter as usize] = true;
        }
        let mut writes: HashMap<VariableId, Vec<u32>> = HashMap::new();
        for (at, write) in script.writes.iter().enumerate() {
            if let Written::One(variable) = write.variable {
                writes.entry(variable).or_default().push(short(at));
            }
        }
        Self { parameters, writes }
    }

    /// Whether an instruction goes to what its routine is given: its target is another one where
    /// another routine calls it.
    pub(super) fn is_given(
        &self,
        script: &Script,
        targets: &[Target],
        instruction: &Instruction,
    ) -> bool {
        let at = (instruction.target, instruction.place);
        self.is_other((script, targets), at, MOST_COPIES)
    }

    fn is_other(
        &self,
        (script, targets): (&Script, &[Target]),
        (value, place): (Expr, Place),
        steps: usize,
    ) -> bool {
        let Expr::Variable(variable) = value else {
            return false;
        };
        if self.parameters[variable as usize] || steps == 0 {
            return true;
        }
        let Some(writes) = self.writes.get(&variable) else {
            return false;
        };
        // the only numbers that it is ever given are as good as declared; those of another name are a
        // copy
        let name = &script.variables[variable as usize].name;
        let is_numbers = |at: &u32| match script.writes[*at as usize].how {
            How::Whole(Expr::Target(target)) => {
                let of = targets[target].name.as_ref();
                of.is_none_or(|of| of.eq_ignore_ascii_case(name))
            }
            _ => false,
        };
        let declared = script.variables[variable as usize].declared;
        if writes.len() > MOST_WRITES {
            return true;
        }
        if !matches!(declared, Expr::Target(_)) && writes.len() == 1 && is_numbers(&writes[0]) {
            return false;
        }
        // what its own routine writes before it is used there, whatever others write
        let routine = routine_at(script, place);
        let writes = writes.iter().map(|at| &script.writes[*at as usize]);
        let is_before =
            |write: &&Write| write.place < place && routine_at(script, write.place) == routine;
        let mut own = writes.filter(is_before).peekable();
        own.peek().is_none()
            || own.any(|write| match write.how {
                How::Whole(of) => self.is_other((script, targets), (of, write.place), steps - 1),
                _ => false,
            })
    }
}

/// The routine that a place stands in.
fn routine_at(script: &Script, place: Place) -> usize {
    script
        .routines
        .partition_point(|routine| routine.place <= place)
}

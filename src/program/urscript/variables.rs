//! Which variable a name means, and whether its value is one that the text tells.
//!
//! A `global` is one in the whole file, a `local` and what a function alone assigns belong to that function; what a function
//! and one around it assign is taken for one variable.

use super::syntax::{Assignment, Expr, ExprId, FunctionId, Notes, Reach, Symbol};
use crate::geometry::{Pose, Quaternion};
use std::collections::{HashMap, HashSet};

/// Names that stand for each other in turn, and calls inside each other, that are followed.
const MOST_STEPS: u32 = 12;

/// A variable.
#[derive(Clone, Copy, Debug)]
struct Variable {
    /// Index of its first assignment.
    first: usize,
    /// Place of another one, or of one of a part.
    again: Option<u32>,
}

/// What a name means.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Meaning {
    /// Assigned once: its value, the function of the assignment, and its place.
    Value(ExprId, FunctionId, u32),
    /// Assigned more than once: its first value, the function and place of that, and the place of another.
    Changing(ExprId, FunctionId, u32),
    /// A parameter of a function.
    Parameter,
    /// Assigned nowhere.
    Unknown,
}

/// Why a pose is not constant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NotConstant {
    /// A variable is assigned more than once, the second time here.
    Assigned(u32),
    /// This name is assigned nowhere; it is the whole pose.
    Unknown(Symbol),
    /// Anything else.
    Computed,
}

/// The variables of a file.
#[derive(Debug)]
pub struct Variables<'n, 'a> {
    pub notes: &'n Notes<'a>,
    variables: HashMap<(FunctionId, Symbol), Variable>,
    parameters: HashSet<(FunctionId, Symbol)>,
    /// Literals that moves go to: their numbers change, so nothing that holds them is constant.
    pub targets: Vec<bool>,
}

impl<'n, 'a> Variables<'n, 'a> {
    pub fn new(notes: &'n Notes<'a>) -> Self {
        let mut parameters = HashSet::new();
        for (at, function) in notes.functions.iter().enumerate() {
            let at = super::syntax::index(at);
            parameters.extend(function.parameters.iter().map(|&name| (at, name)));
        }
        let mut variables = Self {
            notes,
            variables: HashMap::new(),
            parameters,
            targets: vec![false; notes.literals.len()],
        };
        let global = |a: &&Assignment| {
            a.reach == Reach::Global || (a.function == 0 && a.reach == Reach::Plain)
        };
        let globals: HashSet<Symbol> = notes
            .assignments
            .iter()
            .filter(global)
            .map(|a| a.name)
            .collect();
        let plain: HashSet<(FunctionId, Symbol)> = notes
            .assignments
            .iter()
            .filter(|a| a.reach == Reach::Plain)
            .map(|a| (a.function, a.name))
            .collect();
        for (number, assignment) in notes.assignments.iter().enumerate() {
            let name = assignment.name;
            let mut owner = assignment.function;
            if assignment.reach != Reach::Local {
                if globals.contains(&name) {
                    owner = 0;
                }
                let mut around = owner;
                while around != 0 {
                    around = notes.functions[around as usize].parent;
                    if plain.contains(&(around, name)) {
                        owner = around;
                    }
                }
            }
            let entry = variables.variables.entry((owner, name));
            let variable = entry
                .and_modify(|variable| variable.again = Some(assignment.offset))
                .or_insert(Variable {
                    first: number,
                    again: None,
                });
            if assignment.part {
                variable.again = Some(assignment.offset);
            }
        }
        variables
    }

    pub fn meaning(&self, name: Symbol, function: FunctionId) -> Meaning {
        let mut function = function;
        loop {
            if let Some(variable) = self.variables.get(&(function, name)) {
                let first = &self.notes.assignments[variable.first];
                return match variable.again {
                    None if self.parameters.contains(&(function, name)) => Meaning::Parameter,
                    None => Meaning::Value(first.value, first.function, first.offset),
                    Some(again) => Meaning::Changing(first.value, first.function, again),
                };
            }
            if self.parameters.contains(&(function, name)) {
                return Meaning::Parameter;
            }
            if function == 0 {
                return Meaning::Unknown;
            }
            function = self.notes.functions[function as usize].parent;
        }
    }

    /// The value behind names that are assigned once.
    pub fn follow(&self, value: ExprId, function: FunctionId) -> (Expr, ExprId, FunctionId) {
        let (mut value, mut function) = (value, function);
        for _ in 0..MOST_STEPS {
            let Expr::Name(name) = self.notes.expression(value) else {
                break;
            };
            let Meaning::Value(next, within, _) = self.meaning(name, function) else {
                break;
            };
            (value, function) = (next, within);
        }
        (self.notes.expression(value), value, function)
    }

    /// A pose that the text tells.
    ///
    /// # Errors
    /// Where it does not.
    pub fn constant(&self, value: ExprId, function: FunctionId) -> Result<Pose, NotConstant> {
        self.evaluate(value, function, MOST_STEPS)
    }

    fn evaluate(
        &self,
        value: ExprId,
        function: FunctionId,
        steps: u32,
    ) -> Result<Pose, NotConstant> {
        let (expression, _, function) = self.follow(value, function);
        let steps = steps.checked_sub(1).ok_or(NotConstant::Computed)?;
        let inner = |value| self.evaluate(value, function, steps).map_err(computed);
        match expression {
            Expr::Literal(id) => {
                let literal = self.notes.literal(id);
                let values = self.notes.values(literal);
                let values = values.filter(|_| literal.pose && !self.targets[id as usize]);
                let degrees = literal.content == super::syntax::Content::Degrees;
                values
                    .map(|values| super::rotation::pose(values, degrees))
                    .ok_or(NotConstant::Computed)
            }
            Expr::Name(name) => Err(match self.meaning(name, function) {
                Meaning::Changing(_, _, again) => NotConstant::Assigned(again),
                Meaning::Unknown => NotConstant::Unknown(name),
                _ => NotConstant::Computed,
            }),
            Expr::Trans(a, b) => Ok(inner(a)? * inner(b)?),
            Expr::Add(a, b) => {
                let (a, b) = (inner(a)?, inner(b)?);
                let [x, y, z] = b.translation;
                Ok(Pose::from_translation(x, y, z) * a * Pose::from_rotation(b.rotation))
            }
            Expr::Inverse(a) => Ok(inner(a)?.inverse()),
            Expr::Kinematics { .. } | Expr::Other => Err(NotConstant::Computed),
        }
    }
}

/// Part of a pose that is not constant.
fn computed(why: NotConstant) -> NotConstant {
    match why {
        NotConstant::Unknown(_) => NotConstant::Computed,
        other => other,
    }
}

/// The same pose as a number that tells poses apart.
pub fn bits(pose: &Pose) -> [u64; 7] {
    let Quaternion([w, x, y, z]) = pose.rotation.quaternion();
    let [a, b, c] = pose.translation;
    // -0 is 0
    [a, b, c, w, x, y, z].map(|number| (number + 0.0).to_bits())
}

//! The arguments of a move instruction, told apart.

use super::names::{Context, Meaning, Symbol};
use super::reader::index;
use super::syntax::{
    Argument, Base, Expression, Index, Part, Path, Statement, Type, Verb, indices,
};
use super::world::World;
use crate::geometry::units::MM;
use crate::program::Pace;

/// The parts of a move instruction.
pub(super) struct Parts {
    /// Arguments that are or should be targets.
    pub targets: Part,
    /// The tool, where it is a plain name.
    pub tool: Option<(Symbol, Index)>,
    /// The work object; `Err` where it is no plain name.
    pub frame: Result<Option<(Symbol, Index)>, ()>,
    /// It has an ID for synchronised robots.
    pub synchronised: bool,
    /// The load that stands for that of the tool.
    pub load: Option<Symbol>,
    /// Speed and zone where they are predefined ones.
    pub pace: Pace,
}

/// Millimetres that a predefined name ends on: `v100`, `z10`.
fn predefined(name: &str, letter: char) -> Option<f64> {
    let rest = name.strip_prefix([letter, letter.to_ascii_uppercase()])?;
    let whole = !rest.is_empty() && rest.len() < 6 && rest.bytes().all(|b| b.is_ascii_digit());
    whole.then(|| rest.parse().ok()).flatten()
}

/// What a predefined name says of a move's speed and zone.
fn read_pace(name: &str, pace: &mut Pace) {
    if let Some(mm) = predefined(name, 'v') {
        pace.speed_m_s = pace.speed_m_s.or(Some(mm * MM));
    } else if let Some(mm) = predefined(name, 'z') {
        // z0 is 0.3 mm
        pace.zone_m = pace.zone_m.or(Some(mm.max(0.3) * MM));
    } else if name.eq_ignore_ascii_case("fine") {
        pace.zone_m = pace.zone_m.or(Some(0.0));
    }
}

impl World {
    /// Arguments that are plain names.
    pub fn plain_names(&self, arguments: Part) -> impl Iterator<Item = Symbol> {
        self.notes.arguments[indices(arguments)]
            .iter()
            .filter_map(|argument| self.plain(argument).map(|(name, _)| name))
    }

    /// Whether an argument can be a target.
    fn is_target(&self, argument: &Argument, context: Context) -> bool {
        match argument.expression {
            Expression::Point { steps, base } => match base {
                Base::Target(_) => true,
                Base::Named { name, .. } => {
                    steps.0 < steps.1
                        || match self.meaning(name, context) {
                            Meaning::One(datum) => self.datum(datum).kind.is_target(),
                            Meaning::Several(list) => {
                                self.datum(self.several(list)[0]).kind.is_target()
                            }
                            Meaning::Nothing => false,
                        }
                }
            },
            _ => false,
        }
    }

    pub fn is_tool(&self, name: Symbol, context: Context) -> bool {
        match self.meaning(name, context) {
            Meaning::One(datum) => self.datum(datum).kind == Type::Tooldata,
            Meaning::Several(list) => self.datum(self.several(list)[0]).kind == Type::Tooldata,
            Meaning::Nothing => false,
        }
    }

    /// Takes a move instruction apart; `None` where it has no target.
    pub fn parts(&self, statement: &Statement, verb: Verb, arguments: Part) -> Option<Parts> {
        let Verb::Move {
            path,
            first,
            tool_inside,
        } = verb
        else {
            return None;
        };
        let context = statement.context;
        let all = &self.notes.arguments[indices(arguments)];
        let positional = || {
            all.iter()
                .enumerate()
                .filter(|(_, argument)| argument.option.is_none())
        };
        let first = usize::from(first);
        let candidates = || positional().skip(first);
        let start = candidates()
            .find(|(_, argument)| self.is_target(argument, context))
            .or_else(|| candidates().next())?
            .0;
        let behind = || positional().filter(move |(at, _)| *at > start);
        let arc = path == Path::Arc;
        let end = if arc {
            behind().next().map_or(start + 1, |(at, _)| at + 1)
        } else {
            start + 1
        };
        // options stand behind the argument they belong to
        let option = |word: &[u8]| {
            let word = self.notes.symbols.find(word)?;
            all.iter()
                .position(|argument| argument.option == Some(word))
        };
        let wobj = option(b"wobj");
        let mut declared = None;
        let mut last = None;
        let mut before_wobj = None;
        let mut inside = None;
        let mut pace = Pace::default();
        for (place, (at, argument)) in positional().filter(|(at, _)| *at >= end).enumerate() {
            let named = self.plain(argument);
            last = named;
            if let Some((name, _)) = named {
                read_pace(self.notes.symbols.spelling(name), &mut pace);
            }
            if place == 2 {
                inside = named;
            }
            if wobj.is_some_and(|wobj| at < wobj) {
                before_wobj = Some(named);
            }
            if let Some((name, _)) = named
                && self.is_tool(name, context)
            {
                declared = named;
            }
        }
        let tool = declared.or(match before_wobj {
            Some(named) => named,
            None if tool_inside => inside,
            None => last,
        });
        let frame = match wobj.map(|at| &all[at]) {
            None => Ok(None),
            Some(argument) => match argument.expression {
                Expression::Point {
                    base: Base::Named { name, index },
                    steps: (a, b),
                } if a == b => Ok(Some((name, self.notes.index(index)))),
                _ => Err(()),
            },
        };
        let part = |at: usize| arguments.0 + index(at);
        Some(Parts {
            pace,
            targets: (part(start), part(end)),
            tool,
            frame,
            synchronised: option(b"id").is_some(),
            load: option(b"tload").and_then(|at| match all[at].expression {
                Expression::Point {
                    base: Base::Named { name, .. },
                    ..
                } => Some(name),
                _ => None,
            }),
        })
    }

    /// The name that a positional argument is.
    pub fn plain(&self, argument: &Argument) -> Option<(Symbol, Index)> {
        match argument.expression {
            Expression::Point {
                base: Base::Named { name, index },
                steps,
            } if steps.0 == steps.1 && argument.option.is_none() => {
                Some((name, self.notes.index(index)))
            }
            _ => None,
        }
    }
}

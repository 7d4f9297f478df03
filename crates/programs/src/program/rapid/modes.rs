//! What the controller keeps in mind from one statement to the next: whether configuration data
//! count, offsets, units that are switched.

use super::arguments::NOT_CONNECTED;
use super::resolved::Resolved;
use super::syntax::{Mode, Part, Set, StatementKind, Verb, indices};
use super::translate::Translator;
use crate::program::names::Symbol;
use crate::program::script::{Expr, Held, Place, Remark, Script, ValueId, Variable, VariableId};
use crate::program::{ExternalNames, Source};

/// What the controller keeps in mind from one statement to the next.
#[derive(Debug)]
pub(super) struct Modes {
    pub conf_j: VariableId,
    pub conf_l: VariableId,
    pub wrist: VariableId,
    circle: VariableId,
    program_displacement: VariableId,
    external_offset: VariableId,
    /// The guards of moves that a displacement concerns, and of those whose target's name is
    /// ambiguous.
    pub guards: u32,
    pub arc_guards: u32,
    pub ambiguous_guards: u32,
    /// Those of moves to joints, which only external axes concern, and of those without an offset.
    pub absolute_guards: u32,
    pub unshifted_guards: u32,
    /// Units that the program switches, whose axes matter: name, whether it follows targets, and
    /// what holds where it does not.
    units: Vec<(String, VariableId, ValueId)>,
    on: ValueId,
    off: ValueId,
    displaced: ValueId,
    rotates: ValueId,
    /// By an amount that nobody knows, and by nothing.
    shifted: ValueId,
    unshifted: ValueId,
}

/// The name that an instruction is given, in capitals.
fn unit_name(resolved: &Resolved, file: u32, arguments: Part) -> String {
    let argument = resolved.parsed.arguments[indices(arguments)].first();
    let span = argument.map_or(0..0, |a| a.span.0 as usize..a.span.1 as usize);
    let text = resolved.sources[file as usize].bytes[span].trim_ascii();
    Source::text(text).to_ascii_uppercase()
}

/// Units that the program switches on or off, with those of their axes that matter.
pub(super) fn switched(resolved: &Resolved, names: &ExternalNames) -> Vec<(String, u16)> {
    let mut units: Vec<(String, u16)> = Vec::new();
    let mut here = 0;
    for statement in &resolved.parsed.statements {
        match statement.kind {
            StatementKind::Text { file, .. } => here = file,
            StatementKind::Call(call) if matches!(call.verb, Verb::Mode(Mode::Unit, _)) => {
                let name = unit_name(resolved, here, call.arguments);
                let axes = names.axes_of_unit(&name);
                if axes != 0 && !units.iter().any(|(known, _)| *known == name) {
                    units.push((name, axes));
                }
            }
            _ => {}
        }
    }
    units
}

impl Modes {
    pub(super) fn new(script: &mut Script, units: Vec<(String, u16)>) -> Self {
        let on = script.value(Held::Flag(true));
        let off = script.value(Held::Flag(false));
        let remark = script.remark(Remark::error(
            "displacement-active",
            "a program displacement may be active",
            "switch it off with PDispOff before the move",
        ));
        let displaced = script.value(Held::Remark(remark));
        let remark = script.remark(Remark::error(
            "move-not-supported",
            "CirPathMode may be another than \\PathFrame: how the tool rotates on this arc is not \
             followed",
            "set CirPathMode\\PathFrame before the arc, or write it in straight moves",
        ));
        let rotates = script.value(Held::Remark(remark));
        let remark = script.remark(Remark::error(
            "external-offset-unknown",
            "external axes are shifted by an amount that only the running program knows (EOffsOn, \
             or EOffsSet without numbers)",
            "write EOffsSet with numbers, or switch it off with EOffsOff before the move",
        ));
        let shifted = script.value(Held::Remark(remark));
        let unshifted = script.value(Held::ExternalOffset(Box::default()));
        let remark = script.remark(Remark::error(
            "target-name-ambiguous",
            "this name is declared more than once, and a use does not tell which one is meant",
            "pass only the modules of one task, or make the data LOCAL",
        ));
        let ambiguous = script.value(Held::Remark(remark));
        // a program displacement lasts over the end of a cycle
        let mut mode = |name: &str, holds: ValueId, kept: bool| {
            script.variable(Variable {
                kept,
                ..Variable::new(name, Place::NOWHERE, Expr::Value(holds))
            })
        };
        let (conf_j, conf_l) = (mode("ConfJ", on, false), mode("ConfL", on, false));
        let wrist = mode("SingArea", off, false);
        let circle = mode("CirPathMode", off, false);
        let program_displacement = mode("PDispOn", off, true);
        let external_offset = mode("EOffsOn", unshifted, false);
        let ambiguous = mode("", ambiguous, false);
        let follows: Vec<VariableId> = units
            .iter()
            .map(|(name, _)| mode(name, on, false))
            .collect();
        let units: Vec<(String, VariableId, ValueId)> = follows
            .into_iter()
            .zip(units)
            .map(|(follows, (name, axes))| (name, follows, script.value(Held::AxesOff(axes))))
            .collect();
        let mut guard = |own: &[VariableId]| {
            let all = own.iter().copied().chain(units.iter().map(|unit| unit.1));
            script.guard(all)
        };
        let guards = guard(&[program_displacement, external_offset]);
        let arc_guards = guard(&[program_displacement, external_offset, circle]);
        let ambiguous_guards = guard(&[program_displacement, external_offset, ambiguous]);
        let absolute_guards = guard(&[external_offset]);
        let unshifted_guards = guard(&[]);
        Self {
            conf_j,
            conf_l,
            wrist,
            circle,
            program_displacement,
            external_offset,
            guards,
            arc_guards,
            ambiguous_guards,
            absolute_guards,
            unshifted_guards,
            units,
            on,
            off,
            displaced,
            rotates,
            shifted,
            unshifted,
        }
    }
}

impl Translator<'_> {
    /// A mode of the controller is set.
    pub(super) fn mode(&mut self, mode: Mode, set: Set, arguments: Part) {
        let resolved = self.resolved;
        let has = |word: Option<Symbol>| {
            let all = &resolved.parsed.arguments[indices(arguments)];
            word.is_some() && all.iter().any(|argument| argument.option == word)
        };
        let (modes, words) = (&self.modes, &self.words);
        let flag = |on: bool| if on { modes.on } else { modes.off };
        if mode == Mode::Wrist && has(words.lock_axis_4) {
            let text = "axis 4 stays at 0 or 180 degrees from here on (SingArea\\LockAxis4): what a \
                correction turns it by is not reached";
            let hint = "see how far the robot is from the target there, or use SingArea\\Wrist";
            self.say(Remark::warning("axis-locked", text, hint));
            let (wrist, off) = (self.modes.wrist, self.modes.off);
            return self.set(wrist, Expr::Value(off));
        }
        let (variable, value) = match mode {
            Mode::ConfJ => (modes.conf_j, flag(!has(words.off))),
            Mode::ConfL => (modes.conf_l, flag(!has(words.off))),
            Mode::Wrist => (modes.wrist, flag(has(words.wrist))),
            Mode::Circle if has(words.path_frame) => (modes.circle, modes.off),
            Mode::Circle => (modes.circle, modes.rotates),
            Mode::ProgramDisplacement if set == Set::Off => (modes.program_displacement, modes.off),
            Mode::ProgramDisplacement => (modes.program_displacement, modes.displaced),
            Mode::Unit => {
                let name = self.unit(arguments);
                let Some((_, follows, off)) = modes.units.iter().find(|unit| unit.0 == name) else {
                    return;
                };
                (*follows, if set == Set::On { modes.on } else { *off })
            }
            Mode::ExternalOffset if set == Set::Off => (modes.external_offset, modes.unshifted),
            Mode::ExternalOffset => {
                let (variable, unknown) = (modes.external_offset, modes.shifted);
                let given = (set == Set::Given)
                    .then(|| self.offsets(arguments))
                    .flatten();
                let known = |by| {
                    self.builder
                        .script
                        .value(Held::ExternalOffset(Box::new(by)))
                };
                (variable, given.map_or(unknown, known))
            }
        };
        self.set(variable, Expr::Value(value));
    }

    /// The unit of `DeactUnit STN1`.
    fn unit(&self, arguments: Part) -> String {
        unit_name(self.resolved, self.here.file, arguments)
    }

    /// The six numbers of `EOffsSet [100,0,0,0,0,0]`; axes that are not connected are not shifted.
    fn offsets(&self, arguments: Part) -> Option<[f64; 6]> {
        let argument = self.resolved.parsed.arguments[indices(arguments)].first()?;
        let (start, end) = argument.span;
        let bytes = &self.resolved.sources[self.here.file as usize].bytes;
        let text = bytes[start as usize..end as usize].trim_ascii();
        let inside = text.strip_prefix(b"[")?.strip_suffix(b"]")?;
        let mut parts = inside.split(|b| *b == b',');
        let mut by = [0.0; 6];
        for slot in &mut by {
            let value = crate::program::number::parse(parts.next()?.trim_ascii())?;
            *slot = if value.abs() < NOT_CONNECTED {
                value
            } else {
                0.0
            };
        }
        parts.next().is_none().then_some(by)
    }
}

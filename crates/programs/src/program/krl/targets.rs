//! Variables that hold positions, and which targets the script has in the end.

use super::data::root_differs;
use super::names::{DataKind, Index, Stored};
use super::reader::Reader;
use super::remarks::{ACCURATE, AMBIGUOUS, COMPUTED, PASSED, UNFOLLOWED, home};
use super::{GROWTH, LONGEST_LINE, status, status_and_turn, whole};
use crate::finding::Severity;
use crate::program::kit;
use crate::program::names::{Meaning, Symbol};
use crate::program::script::{Expr, Place, Remark, Script, Table, Variable, VariableId, short};
use crate::program::{Settings, Source};

/// Elements of an array that are followed each.
const MOST_ELEMENTS: usize = 32;

/// Whose variable it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Owner {
    /// Of a declaration.
    Datum(u32),
    /// The files do not declare the name.
    Nobody(Symbol),
}

impl Reader {
    /// What a name stands for; `None` where the files neither declare nor write it.
    pub(super) fn named(&mut self, name: Symbol, at: Index) -> Option<Expr> {
        let context = self.context();
        let is_touched = self.names.touched.contains(&name);
        let datum = match self.names.meaning(name, context) {
            Meaning::One(datum) => datum,
            Meaning::Several(list) => return Some(self.ambiguous(list, at)),
            Meaning::Nothing if is_touched && at != Index::Variable => {
                let variable = self.variable(Owner::Nobody(name), at);
                return Some(Expr::Variable(variable));
            }
            Meaning::Nothing => return None,
        };
        let owner = Owner::Datum(datum);
        let is_local = self.names.data[datum as usize].context.routine.is_some();
        if at == Index::Variable {
            return Some(self.any_element(owner, name, is_touched));
        }
        if is_touched || is_local {
            return Some(Expr::Variable(self.variable(owner, at)));
        }
        Some(self.declared_value(datum, at))
    }

    /// What data lists give to a variable.
    fn declared_value(&mut self, datum: u32, at: Index) -> Expr {
        let found = self.names.values(datum, at).last().copied();
        if let Some((_, _, Stored::Target(target))) = found {
            return Expr::Target(target);
        }
        let declared = self.names.data[datum as usize];
        if let (Some((_, _, Stored::Number(number))), DataKind::Number) = (found, declared.kind) {
            return self.number_value(number);
        }
        let remark = match declared.kind {
            DataKind::Axes => home(self.names.symbols.spelling(declared.name)),
            DataKind::Number | DataKind::Frame => super::remarks::CHOSEN,
            _ => COMPUTED,
        };
        self.unknown(remark)
    }

    /// The variable of a name or element.
    pub(super) fn variable(&mut self, owner: Owner, at: Index) -> VariableId {
        if let Some(&known) = self.variables.get(&(owner, at)) {
            return known;
        }
        let (name, place, kept, routine, declared) = match owner {
            Owner::Datum(datum) => {
                let of = self.names.data[datum as usize];
                let declared = self.declared_value(datum, at);
                (of.name, of.place, of.kept, of.context.routine, declared)
            }
            Owner::Nobody(name) => {
                let place = Place::new(self.file, 0);
                let missing = self.not_in_files(name);
                (name, place, true, None, missing)
            }
        };
        let spelled = self.names.symbols.spelling(name);
        let name = match at {
            Index::At([a, 0, 0]) => format!("{spelled}[{a}]"),
            Index::At([a, b, 0]) => format!("{spelled}[{a},{b}]"),
            Index::At([a, b, c]) => format!("{spelled}[{a},{b},{c}]"),
            _ => spelled.to_owned(),
        };
        let made = self.builder.script.variable(Variable {
            kept,
            routine,
            ..Variable::new(name, place, declared)
        });
        self.variables.insert((owner, at), made);
        if at != Index::Whole {
            let table = self.table_of(owner);
            let entries = &mut self.builder.script.tables[table as usize].entries;
            let key = entries.len();
            entries.insert(i64::from(short(key)), made);
        }
        made
    }

    /// The variables of an array's elements.
    pub(super) fn table_of(&mut self, owner: Owner) -> u32 {
        if let Some(&known) = self.tables.get(&owner) {
            return known;
        }
        let tables = &mut self.builder.script.tables;
        tables.push(Table::default());
        let made = short(tables.len() - 1);
        self.tables.insert(owner, made);
        if let Owner::Datum(datum) = owner {
            for at in self.elements(datum) {
                self.variable(owner, at);
            }
        }
        made
    }

    /// Elements with a value in a data list, or that statements write; one in the place of all where
    /// only the running program knows which they write.
    fn elements(&self, datum: u32) -> Vec<Index> {
        let values = self.names.values(datum, Index::Variable).iter();
        let mut all: Vec<Index> = values.map(|&(_, at, _)| at).collect();
        let name = self.names.data[datum as usize].name;
        let written = (name, Index::At([0; 3]))..(name, Index::Variable);
        let written = self.names.elements.range(written);
        all.extend(written.map(|&(_, at)| at));
        if all.is_empty() && self.names.elements.contains(&(name, Index::Variable)) {
            all.push(Index::Variable);
        }
        all.sort_unstable();
        all.dedup();
        all
    }

    /// An element that only the running program knows.
    fn any_element(&mut self, owner: Owner, name: Symbol, is_touched: bool) -> Expr {
        if let Some(&known) = self.arrays.get(&owner) {
            return known;
        }
        let Owner::Datum(datum) = owner else {
            return self.unknown(COMPUTED);
        };
        let all = self.elements(datum);
        let mut of = Vec::with_capacity(all.len());
        for at in all {
            of.push(if is_touched {
                Expr::Variable(self.variable(owner, at))
            } else {
                self.declared_value(datum, at)
            });
        }
        let found = match of.as_slice() {
            [] => {
                let is_axes = self.names.data[datum as usize].kind == DataKind::Axes;
                let remark = if is_axes {
                    home(self.names.symbols.spelling(name))
                } else {
                    COMPUTED
                };
                self.unknown(remark)
            }
            _ => self.builder.script.any(of),
        };
        self.arrays.insert(owner, found);
        found
    }

    /// Refuses all elements of a long array, where which of them a statement concerns is not known;
    /// whether it is one. Those of a short one are followed each.
    pub(super) fn refuse_array(&mut self, owner: Owner, remark: Remark) -> bool {
        let Owner::Datum(datum) = owner else {
            return false;
        };
        if self.refused.contains(&(datum, remark.id)) {
            return true;
        }
        let values = self.names.values(datum, Index::Variable);
        if values.len() <= MOST_ELEMENTS {
            return false;
        }
        self.refused.insert((datum, remark.id));
        let script = &mut self.builder.script;
        let remark = script.remark(remark);
        for (_, _, value) in values {
            if let Stored::Target(target) = value {
                script.refused.push((*target, remark));
            }
        }
        true
    }

    /// Whether the elements of an array that a call is given are followed; if not they are refused.
    pub(super) fn follows_array(
        &mut self,
        call: Place,
        datum: u32,
        is_whole: bool,
        is_foreign: bool,
    ) -> bool {
        if is_foreign {
            return !self.refuse_array(Owner::Datum(datum), PASSED);
        }
        let values = self.names.values(datum, Index::Variable);
        if !is_whole && values.len() <= MOST_ELEMENTS {
            return true;
        }
        if self.refused.insert((datum, "given to a routine")) {
            self.unfollowed.push(call);
            let script = &mut self.builder.script;
            let remark = script.remark(UNFOLLOWED);
            for (_, _, value) in values {
                if let Stored::Target(target) = value {
                    script.refused.push((*target, remark));
                }
            }
        }
        false
    }

    /// Whatever a name that is declared more than once may mean has to stay.
    fn ambiguous(&mut self, list: u32, at: Index) -> Expr {
        if let Some(&known) = self.ambiguous.get(&(list, at)) {
            return known;
        }
        let candidates = self.names.several(list).to_vec();
        let whole = if at == Index::Whole {
            Index::Variable
        } else {
            at
        };
        let (mut of, mut refused) = (Vec::new(), Vec::new());
        for datum in candidates {
            for &(_, _, value) in self.names.values(datum, whole) {
                if let Stored::Target(target) = value {
                    refused.push(target);
                    of.push(Expr::Target(target));
                }
            }
        }
        let script = &mut self.builder.script;
        let remark = script.remark(AMBIGUOUS);
        let refused = refused.into_iter().map(|target| (target, remark));
        script.refused.extend(refused);
        let found = if of.is_empty() {
            self.unknown(COMPUTED)
        } else {
            self.builder.script.any(of)
        };
        self.ambiguous.insert((list, at), found);
        found
    }

    /// A name that the files do not declare.
    pub(super) fn not_in_files(&mut self, name: Symbol) -> Expr {
        if let Some(&known) = self.missing.get(&name) {
            return Expr::Unknown(known);
        }
        let spelled = self.names.symbols.spelling(name);
        let remark = if is_home(spelled) {
            home(spelled)
        } else {
            kit::not_in_files(
                "target-not-in-files",
                spelled,
                "give the .dat file or the $config.dat that declares it, too",
            )
        };
        // each name once: no need to look for the same
        let remarks = &mut self.builder.script.remarks;
        remarks.push(remark);
        let made = short(remarks.len() - 1);
        self.missing.insert(name, made);
        Expr::Unknown(made)
    }

    /// The script, with the targets that matter.
    pub(super) fn finish(self, sources: &[Source], settings: &Settings) -> Script {
        let names = self.names;
        let mut script = self.builder.finish();
        for place in self.stays {
            let message = "this move goes to where the robot is: it stays there";
            script.say(
                sources,
                place,
                Remark::note("run-time-position", message, ""),
            );
        }
        for place in self.unfollowed {
            script.say(sources, place, UNFOLLOWED);
        }
        if let Some(base) = &settings.world_from_base {
            let roots = self.declared.roots.iter();
            let differ = roots.filter_map(|root| root_differs(root, base, sources));
            script.findings.extend(differ);
        }
        let mut kept = named_targets(&mut script);
        accurate_targets(&mut script, &kept, settings, sources);
        long_lines(sources, &mut script, &kept);
        // points that are taught are targets, used or not; those of the controller and frames are
        // where moves use them
        for &(datum, _, value) in &names.values {
            let datum = &names.data[datum as usize];
            let module = &names.modules[datum.context.module as usize];
            if let Stored::Target(target) = value {
                kept[target] |= datum.kind != DataKind::Frame && !module.is_system;
            }
        }
        script.keep(&kept);
        script
    }
}

/// Points of absolutely accurate robots; where they are to be rewritten that is said once a file.
fn accurate_targets(script: &mut Script, kept: &[bool], settings: &Settings, sources: &[Source]) {
    let remark = script.remark(ACCURATE);
    let mut reported = None;
    for (id, target) in script.targets.iter().enumerate() {
        let (has_status, _) = status_and_turn(target.layout);
        if !has_status || target.numbers.is_empty() {
            continue;
        }
        let bits = script.numbers[target.numbers.start as usize + 6].value;
        if whole(bits) & status::ABSOLUTELY_ACCURATE == 0 {
            continue;
        }
        if !settings.accept_absolutely_accurate {
            script.refused.push((id, remark));
        } else if kept[id] && reported.replace(target.file) != Some(target.file) {
            let message = "S of this target has bit 4 (16): taught on an absolutely accurate \
                robot; it is compensated all \
                           the same, as all of its kind in this file";
            let hint =
                "the correction of the controller must be off, or the robot is corrected twice";
            let source = &sources[target.file as usize];
            let (at, id) = (target.offset as usize, "absolutely-accurate");
            let finding = source.finding(at, id, Severity::Warning, message.to_owned(), hint);
            script.findings.push(finding);
        }
    }
}

/// Warns where new numbers may make a line too long.
fn long_lines(sources: &[Source], script: &mut Script, kept: &[bool]) {
    for (id, target) in script.targets.iter().enumerate() {
        if !kept[id] || target.numbers.is_empty() {
            continue;
        }
        let source = &sources[target.file as usize];
        let bytes = &source.bytes;
        let at = target.offset as usize;
        let limit = LONGEST_LINE - GROWTH * target.numbers.len();
        let from = at.saturating_sub(LONGEST_LINE);
        let start =
            memchr::memrchr2(b'\n', b'\r', &bytes[from..at]).map_or(from, |end| from + end + 1);
        let rest = &bytes[at..bytes.len().min(at + LONGEST_LINE)];
        let end = memchr::memchr2(b'\n', b'\r', rest).map_or(at + rest.len(), |end| at + end);
        if end - start > limit {
            let message = format!(
                "this line has {} characters; with new numbers it may exceed the {LONGEST_LINE} \
                 that the controller takes",
                end - start
            );
            let (id, severity) = ("long-line", Severity::Warning);
            let finding = source.finding(at, id, severity, message, "split the line");
            script.findings.push(finding);
        }
    }
}

/// Which targets a statement names.
fn named_targets(script: &mut Script) -> Vec<bool> {
    let mut named = vec![false; script.targets.len()];
    script.each_expression(|expr| {
        if let Expr::Target(target) = expr {
            named[*target] = true;
        }
    });
    named
}

/// Names that every controller has for a joint target in its $config.dat.
fn is_home(name: &str) -> bool {
    let name = name.to_ascii_lowercase();
    if name == "$h_pos" {
        return true;
    }
    let rest = name.strip_prefix("xhome").or(name.strip_prefix("home"));
    rest.is_some_and(|rest| rest.bytes().all(|b| b.is_ascii_digit()))
}

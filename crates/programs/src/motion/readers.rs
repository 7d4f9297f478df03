//! Which routines read a variable, and who starts them.

use crate::program::script::{Expr, How, RoutineId, Script, Statement, VariableId, Written, short};
use foldhash::{HashMap, HashMapExt, HashSet, HashSetExt};

/// The routine that the operator starts to come to a routine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum From {
    Nobody,
    One(RoutineId),
    Several,
}

/// Of `written`, each a variable and the routine that writes it, those that a routine reads which
/// is also reached otherwise.
pub(super) fn read_elsewhere(
    script: &Script,
    entries: &[RoutineId],
    written: &[(VariableId, RoutineId)],
) -> HashSet<(VariableId, RoutineId)> {
    let mut readers: HashMap<VariableId, HashSet<RoutineId>> = HashMap::new();
    for (variable, _) in written {
        readers.entry(*variable).or_default();
    }
    for (at, routine) in script.routines.iter().enumerate() {
        let range = routine.statements.start as usize..routine.statements.end as usize;
        let mut lists = HashSet::new();
        for statement in &script.statements[range] {
            each_read(script, *statement, &mut lists, &mut |variable| {
                if let Some(readers) = readers.get_mut(&variable) {
                    readers.insert(short(at));
                }
            });
        }
    }
    let from = starts(script, entries);
    let is_elsewhere = |&(variable, writer): &(VariableId, RoutineId)| {
        readers[&variable]
            .iter()
            .any(|reader| from[*reader as usize] != From::One(writer))
    };
    written.iter().copied().filter(is_elsewhere).collect()
}

/// Where routines that these start, through calls, write variables; of each the first place.
pub(super) fn written_by(script: &Script, entries: &[RoutineId]) -> HashMap<VariableId, u32> {
    let mut written = HashMap::new();
    for routine in script.reached_from(entries) {
        let routine = &script.routines[routine as usize];
        for at in routine.statements.clone() {
            if let Statement::Write(write) = script.statements[at as usize]
                && let Written::One(variable) = script.writes[write as usize].variable
            {
                written.entry(variable).or_insert(at);
            }
        }
    }
    written
}

/// Who starts each routine, through calls.
fn starts(script: &Script, entries: &[RoutineId]) -> Vec<From> {
    let mut from = vec![From::Nobody; script.routines.len()];
    for &entry in entries {
        let mut open = vec![entry];
        while let Some(routine) = open.pop() {
            let known = &mut from[routine as usize];
            *known = match *known {
                From::Nobody => From::One(entry),
                From::One(other) if other != entry => From::Several,
                _ => continue,
            };
            let range = &script.routines[routine as usize].statements;
            for statement in &script.statements[range.start as usize..range.end as usize] {
                if let Statement::Call(call) = statement {
                    let call = &script.calls[*call as usize];
                    if !call.writes_only {
                        open.extend_from_slice(&call.callees);
                    }
                }
            }
        }
    }
    from
}

/// Visits the variables whose values a statement uses; of each list in `lists` once.
fn each_read(
    script: &Script,
    statement: Statement,
    lists: &mut HashSet<u32>,
    visit: &mut dyn FnMut(VariableId),
) {
    match statement {
        Statement::Move(at) => {
            let instruction = &script.instructions[at as usize];
            let modal = &script.modals[instruction.modal as usize];
            for expr in [
                instruction.target,
                modal.tool,
                modal.frame,
                modal.load,
                modal.configured,
                modal.wrist,
            ] {
                each_variable(script, expr, lists, visit);
            }
            for variable in &*script.guards[modal.guards as usize] {
                visit(*variable);
            }
        }
        Statement::Write(at) => {
            if let How::Whole(value) = &script.writes[at as usize].how {
                each_variable(script, *value, lists, visit);
            }
        }
        Statement::Call(at) | Statement::Start(at) => {
            let range = &script.calls[at as usize].arguments;
            for argument in &script.arguments[range.start as usize..range.end as usize] {
                each_variable(script, argument.value, lists, visit);
            }
        }
        Statement::BranchUnless(at) => visit(script.conditions[at as usize].test.0),
        _ => {}
    }
}

fn each_variable(
    script: &Script,
    expr: Expr,
    lists: &mut HashSet<u32>,
    visit: &mut dyn FnMut(VariableId),
) {
    match expr {
        Expr::Variable(variable) => visit(variable),
        Expr::Element { table, number } => {
            visit(number);
            for variable in script.tables[table as usize].entries.values() {
                visit(*variable);
            }
        }
        Expr::Displaced { base, .. } => {
            each_variable(script, script.lists[base as usize], lists, visit);
        }
        Expr::DisplacedByCall { base, by } => {
            visit(script.by_calls[by as usize].call);
            each_variable(script, script.lists[base as usize], lists, visit);
        }
        Expr::Any { first, end } => {
            if lists.insert(first) {
                for inner in &script.lists[first as usize..end as usize] {
                    each_variable(script, *inner, lists, visit);
                }
            }
        }
        Expr::Product(product) => {
            for factor in &script.products[product as usize].factors {
                each_variable(script, *factor, lists, visit);
            }
        }
        Expr::Absent | Expr::Target(_) | Expr::Value(_) | Expr::Unknown(_) => {}
    }
}

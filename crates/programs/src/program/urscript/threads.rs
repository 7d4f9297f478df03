//! Threads that move the arm.

use super::syntax::{Event, FunctionId};
use super::variables::Variables;
use crate::program::Motion;
use crate::program::script::Remark;
use foldhash::HashSet;

/// What is to be said of a thread that has joint moves, or calls a function with some: the moves
/// behind its start do not know of them.
pub(super) fn moves_joints(variables: &Variables, thread: FunctionId) -> Option<Remark> {
    let parsed = variables.parsed;
    let of = &parsed.functions[thread as usize];
    if !of.thread {
        return None;
    }
    let (mut seen, mut open) = (HashSet::from_iter([thread]), vec![thread]);
    while let Some(function) = open.pop() {
        for event in &parsed.functions[function as usize].events {
            match *event {
                Event::Step(step) if parsed.steps[step as usize].motion == Motion::Joint => {
                    let name = of.name.map(|name| parsed.spelling(name));
                    let message = format!(
                        "thread `{}` moves joints: moves to poses behind its start are taken to \
                         come in the posture of the move before it",
                        name.unwrap_or_default()
                    );
                    let hint = "begin with a joint move to joints behind `join`";
                    return Some(Remark::warning_about("posture-assumed", message, hint));
                }
                Event::Call(call) => {
                    let callees = variables.callees(&parsed.calls[call as usize]);
                    open.extend(callees.iter().filter(|callee| seen.insert(**callee)));
                }
                _ => {}
            }
        }
    }
    None
}

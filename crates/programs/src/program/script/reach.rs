//! The routines that a routine comes to.

use super::{RoutineId, Script, Statement};
use foldhash::{HashSet, HashSetExt};

impl Script {
    /// These routines, and all that they call or start, directly or through others; not those that
    /// a call may go to of which only the writes count.
    #[must_use]
    pub fn reached_from(&self, routines: &[RoutineId]) -> HashSet<RoutineId> {
        let mut reached = HashSet::new();
        let mut open = routines.to_vec();
        while let Some(routine) = open.pop() {
            if !reached.insert(routine) {
                continue;
            }
            let own = &self.routines[routine as usize].statements;
            for statement in &self.statements[own.start as usize..own.end as usize] {
                if let Statement::Call(call) | Statement::Start(call) = *statement {
                    let call = &self.calls[call as usize];
                    if !call.writes_only {
                        open.extend_from_slice(&call.callees);
                    }
                }
            }
        }
        reached
    }
}

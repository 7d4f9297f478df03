//! What assignments make of positions, element by element.

use super::Translator;
use crate::program::script::{Expr, How, RemarkId};
use crate::program::urscript::syntax::Assignment;
use crate::program::urscript::variables::VarId;
use crate::program::{Displacement, Shift};

impl Translator<'_, '_, '_> {
    pub(super) fn assign(&mut self, number: u32) {
        let assignment = &self.goals.parsed.assignments[number as usize];
        let variable = self.goals.variables.assigned[number as usize];
        let offset = assignment.offset;
        if !assignment.part {
            self.whole(variable, assignment.value, assignment.function, offset);
            return;
        }
        let held = self.goals.held[variable as usize];
        let (computed, changes) = (self.goals.common.computed, self.goals.common.frame_changes);
        let how = self.part_becomes(variable, assignment, computed);
        self.write(held.position, how, offset);
        self.write(held.frame, How::PartSomehow(changes), offset);
    }

    /// What an assignment makes of an element of a position.
    fn part_becomes(&mut self, own: VarId, assignment: &Assignment, computed: RemarkId) -> How {
        let element = assignment.element.map(|at| at as usize);
        // an angle of a joint takes the tool somewhere else altogether
        if self.goals.variables.holds_joints(own) {
            return How::PartNumber(computed);
        }
        if let (Some((name, by)), Some(at @ 0..3)) = (assignment.grows, element) {
            let mut along = [0.0; 3];
            along[at] = by;
            let script = &mut self.goals.builder.script;
            let by = script.displacement(Displacement::By(Box::new(Shift::along(along))));
            let variables = &self.goals.variables;
            if let Some(other) = variables.meaning(name, assignment.function) {
                if other == own {
                    return How::PartBy(computed, by);
                }
                if let Some(position) = self.goals.held[other as usize].position {
                    return How::PartOf {
                        remark: computed,
                        of: Expr::Variable(position),
                        axis: at,
                        by,
                    };
                }
            }
        }
        let is_own = !self.goals.variables.writes_own_number(assignment);
        How::part(is_own, element.is_some_and(|at| at > 2), computed)
    }
}

//! What assignments make of positions, element by element.

use super::Translator;
use crate::program::quantity::Quantity;
use crate::program::script::{How, RemarkId};
use crate::program::urscript::numbers::along_base;
use crate::program::urscript::variables::VarId;

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
        let how = self.part_becomes(variable, number, computed);
        self.write(held.position, how, offset);
        self.write(held.frame, How::PartSomehow(changes), offset);
    }

    /// What an assignment makes of an element of a position.
    fn part_becomes(&mut self, own: VarId, number: u32, computed: RemarkId) -> How {
        let assignment = &self.goals.parsed.assignments[number as usize];
        let element = assignment.element.number().map(|at| at as usize);
        // an angle of a joint takes the tool somewhere else altogether
        if self.goals.variables.holds_joints(own) {
            return How::PartNumber(computed);
        }
        if let Some((name, at, by)) = self.goals.variables.growth(number) {
            let mut along = [0.0; 3].map(Quantity::exactly);
            along[at] = by;
            let by = self.goals.builder.script.displacement(along_base(&along));
            let variables = &self.goals.variables;
            if let Some(other) = variables.meaning(name, assignment.function) {
                if other == own {
                    return How::PartBy(computed, by);
                }
                let of = self.goals.position_named(name, assignment.function);
                if let Some(of) = of {
                    return How::PartOf {
                        remark: computed,
                        of,
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

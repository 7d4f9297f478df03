//! Targets in the order of the text.

use super::{Expr, How, Script, short};
use crate::program::TargetId;

impl Script {
    /// Every expression that may be a target.
    pub(in crate::program) fn each_expression(&mut self, mut visit: impl FnMut(&mut Expr)) {
        for instruction in &mut self.instructions {
            visit(&mut instruction.target);
        }
        for modal in &mut self.modals {
            visit(&mut modal.tool);
            visit(&mut modal.frame);
        }
        for argument in &mut self.arguments {
            visit(&mut argument.value);
        }
        for expr in &mut self.lists {
            visit(expr);
        }
        for factor in self.products.iter_mut().flat_map(|of| &mut of.factors) {
            visit(factor);
        }
        for variable in &mut self.variables {
            visit(&mut variable.declared);
        }
        for write in &mut self.writes {
            if let How::Whole(value) | How::PartOf { of: value, .. } = &mut write.how {
                visit(value);
            }
        }
    }

    /// Leaves out the targets that are not kept, and puts the others in the order of the text.
    pub(in crate::program) fn keep(&mut self, kept: &[bool]) {
        let mut order: Vec<TargetId> = (0..kept.len()).filter(|&target| kept[target]).collect();
        let place = |&target: &TargetId| {
            let target = &self.targets[target];
            (target.file, target.offset)
        };
        if order.len() == kept.len() && order.is_sorted_by_key(place) {
            return;
        }
        order.sort_by_key(place);
        let mut new_ids = vec![0; kept.len()];
        let mut targets = Vec::with_capacity(order.len());
        let mut numbers = Vec::with_capacity(self.numbers.len());
        for old in order {
            new_ids[old] = targets.len();
            let mut target = self.targets[old].clone();
            let range = target.numbers.start as usize..target.numbers.end as usize;
            let first = short(numbers.len());
            numbers.extend_from_slice(&self.numbers[range]);
            target.numbers = first..short(numbers.len());
            targets.push(target);
        }
        (self.targets, self.numbers) = (targets, numbers);
        self.each_expression(|expr| {
            if let Expr::Target(target) = expr {
                *target = new_ids[*target];
            }
        });
        for displacement in &mut self.displacements {
            displacement.renumber(|target| kept[target].then(|| new_ids[target]));
        }
        self.named.retain(|&(target, _)| kept[target]);
        for (target, _) in &mut self.named {
            *target = new_ids[*target];
        }
        self.refused.retain(|&(target, _)| kept[target]);
        for (target, _) in &mut self.refused {
            *target = new_ids[*target];
        }
        self.offsets.retain(|target| kept[*target]);
        for target in &mut self.offsets {
            *target = new_ids[*target];
        }
        self.own_frames.retain(|&(target, _)| kept[target]);
        for (target, _) in &mut self.own_frames {
            *target = new_ids[*target];
        }
        self.externals.retain(|&(target, _)| kept[target]);
        for (target, _) in &mut self.externals {
            *target = new_ids[*target];
        }
    }
}

//! Puts parts into a script.

use super::{
    Argument, ByCall, DISPLACED_SOMEHOW, DisplacementId, Expr, Held, How, Modal, ModalId,
    NOT_DISPLACED, NamedFrame, OVERWRITTEN, Place, Product, Remark, RemarkId, Script, Table,
    TableId, UNBOUNDED, ValueId, Variable, VariableId, short,
};
use crate::geometry::Pose;
use crate::program::{Displacement, Number, Source, Target, TargetId};
use std::ops::Range;

/// How many of the last [`Script::modals`] a new one is compared with: moves of a kind mostly
/// alternate with few others.
const MODALS_LOOKED_AT: usize = 8;

impl Script {
    /// Adds a value.
    pub fn value(&mut self, value: Held) -> ValueId {
        self.values.push(value);
        short(self.values.len() - 1)
    }

    /// A value, as it stands in a statement.
    pub fn held(&mut self, value: Held) -> Expr {
        Expr::Value(self.value(value))
    }

    /// A tool or work frame that stands still; without a pose where the files do not tell it.
    pub fn frame(&mut self, name: impl Into<Box<str>>, pose: Option<Pose>) -> ValueId {
        self.value(Held::Frame(NamedFrame::still(name, pose)))
    }

    /// What only the running program knows, or nobody does.
    pub fn unknown(&mut self, remark: Remark) -> Expr {
        Expr::Unknown(self.remark(remark))
    }

    /// Adds a table without entries.
    pub fn table(&mut self, name: impl Into<Box<str>>) -> TableId {
        self.tables.push(Table {
            name: name.into(),
            ..Table::default()
        });
        short(self.tables.len() - 1)
    }

    /// Adds a variable to a table, under the next number.
    pub fn enter(&mut self, table: TableId, variable: VariableId) {
        let entries = &mut self.tables[table as usize].entries;
        let next = entries.last_key_value().map_or(0, |(last, _)| last + 1);
        entries.insert(next, variable);
    }

    /// Adds arguments of a call.
    pub fn give(&mut self, arguments: impl IntoIterator<Item = Argument>) -> Range<u32> {
        let first = short(self.arguments.len());
        self.arguments.extend(arguments);
        first..short(self.arguments.len())
    }

    /// The numbers of a target.
    #[must_use]
    pub fn numbers_of(&self, target: TargetId) -> &[Number] {
        let Range { start, end } = self.targets[target].numbers;
        &self.numbers[start as usize..end as usize]
    }

    /// Adds a target with its numbers.
    pub fn target(
        &mut self,
        target: Target,
        numbers: impl IntoIterator<Item = Number>,
    ) -> TargetId {
        let first = short(self.numbers.len());
        self.numbers.extend(numbers);
        self.targets.push(Target {
            numbers: first..short(self.numbers.len()),
            ..target
        });
        self.targets.len() - 1
    }

    /// Adds a variable.
    pub fn variable(&mut self, variable: Variable) -> VariableId {
        self.variables.push(variable);
        short(self.variables.len() - 1)
    }

    /// Adds a remark; the same is kept once.
    pub fn remark(&mut self, remark: Remark) -> RemarkId {
        let known = self.remarks.iter().rposition(|known| *known == remark);
        short(known.unwrap_or_else(|| {
            self.remarks.push(remark);
            self.remarks.len() - 1
        }))
    }

    /// With what a move runs; one of the last that is the same is kept once.
    pub fn modal(&mut self, modal: Modal) -> ModalId {
        let last = self.modals.len().saturating_sub(MODALS_LOOKED_AT);
        let known = self.modals[last..]
            .iter()
            .rposition(|known| *known == modal);
        short(known.map_or_else(
            || {
                self.modals.push(modal);
                self.modals.len() - 1
            },
            |at| last + at,
        ))
    }

    /// Adds a set of variables that may refuse a move, see [`Modal::guards`].
    pub fn guard(&mut self, of: impl IntoIterator<Item = VariableId>) -> u32 {
        self.guards.push(of.into_iter().collect());
        short(self.guards.len() - 1)
    }

    /// Adds a finding at a byte of a file.
    pub fn say(&mut self, sources: &[Source], place: Place, remark: Remark) {
        let source = &sources[place.file as usize];
        self.findings.push(remark.found_in(source, place.offset));
    }

    /// A target has to stay, should a move go to it.
    pub fn refuse(&mut self, target: TargetId, remark: Remark) {
        let remark = self.remark(remark);
        self.refused.push((target, remark));
    }

    /// Likewise the targets that the variables of a table are declared with.
    pub fn refuse_all(&mut self, table: TableId, remark: Remark) {
        let remark = self.remark(remark);
        let declared = |variable: &VariableId| self.variables[*variable as usize].declared;
        let entries = self.tables[table as usize].entries.values();
        let refused = entries.filter_map(|variable| match declared(variable) {
            Expr::Target(target) => Some((target, remark)),
            _ => None,
        });
        self.refused.extend(refused);
    }

    /// Adds a displacement.
    pub fn displacement(&mut self, displacement: Displacement) -> DisplacementId {
        match displacement {
            Displacement::None => NOT_DISPLACED,
            Displacement::Unknown => DISPLACED_SOMEHOW,
            Displacement::Overwritten => OVERWRITTEN,
            Displacement::Unbounded => UNBOUNDED,
            Displacement::By(_) | Displacement::Within(_) | Displacement::AtLeast(_) => {
                self.displacements.push(displacement);
                short(self.displacements.len() - 1)
            }
        }
    }

    /// A part of a position grows by a number of the text.
    pub fn part_by(&mut self, remark: RemarkId, displacement: Displacement) -> How {
        How::PartBy(remark, self.displacement(displacement))
    }

    /// The expression of several, of which only the running program knows the one.
    pub fn any(&mut self, of: impl IntoIterator<Item = Expr>) -> Expr {
        let first = short(self.lists.len());
        self.lists.extend(of);
        Expr::Any {
            first,
            end: short(self.lists.len()),
        }
    }

    /// A tool or a work frame of this name that is the product of others.
    pub fn product(&mut self, name: &str, factors: Vec<Expr>, otherwise: RemarkId) -> Expr {
        self.products.push(Product {
            name: name.into(),
            factors: factors.into(),
            otherwise,
        });
        Expr::Product(short(self.products.len() - 1))
    }

    /// A position, displaced by what the call says.
    pub fn displaced_by_call(&mut self, base: Expr, by: ByCall) -> Expr {
        self.lists.push(base);
        self.by_calls.push(by);
        Expr::DisplacedByCall {
            base: short(self.lists.len() - 1),
            by: short(self.by_calls.len() - 1),
        }
    }

    /// A position, displaced.
    pub fn displaced(&mut self, base: Expr, by: DisplacementId) -> Expr {
        if by == NOT_DISPLACED {
            return base;
        }
        self.lists.push(base);
        Expr::Displaced {
            base: short(self.lists.len() - 1),
            by,
        }
    }
}

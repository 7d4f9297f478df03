//! Numbers that calls give, call by call.

use super::numbers::{COMPONENT, RESULT, SHARED, Written};
use super::resolved::Resolved;
use crate::program::contexts::{Given, Numbered, Varied, varied};
use crate::program::names::Context;
use crate::program::quantity::Quantity;
use crate::program::script::Place;
use crate::program::transformations::{At, Of};

impl Resolved<'_> {
    /// What comes of texts of a routine, call by call: `evaluate` is given what numbers are.
    pub(super) fn varied<T>(
        &self,
        at: Place,
        context: Context,
        evaluate: &mut dyn FnMut(&mut Of) -> T,
    ) -> Varied<T> {
        let at = (context.routine.unwrap_or(u32::MAX), at.offset);
        varied(self, at, evaluate)
    }

    /// The value of an expression, with what numbers are.
    pub(super) fn quantity_of(
        &self,
        text: &[u8],
        at: Place,
        context: Context,
        of: &mut dyn FnMut(u32) -> Quantity,
    ) -> Quantity {
        self.evaluated(text, at, context, of, &mut |_| None)
    }
}

impl Numbered for Resolved<'_> {
    type W = Written;

    fn given(&self) -> &Given<Written> {
        &self.given
    }

    fn is_only_given(&self, number: u32) -> bool {
        self.numbers
            .is_only_written(number, self.given.times(number))
    }

    fn whenever(&self, number: u32) -> Quantity {
        let written =
            |what: &Written, of: &mut dyn FnMut(u32) -> Quantity| self.written_value(*what, of);
        self.numbers.value(number, &written)
    }

    fn value_at(&self, number: u32, at: At, of: &mut Of) -> Quantity {
        // another task may write what is shared
        if number & (SHARED | RESULT | COMPONENT) != 0 {
            return of(number);
        }
        let written =
            |what: &Written, of: &mut dyn FnMut(u32) -> Quantity| self.written_value(*what, of);
        let present = self.numbers.present(number, at, &written, of);
        present.unwrap_or_else(|| of(number))
    }

    fn written(&self, written: Written, _: At, of: &mut Of) -> Quantity {
        self.written_value(written, of)
    }
}

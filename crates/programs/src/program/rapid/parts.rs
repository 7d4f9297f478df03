//! What assignments make of data, as a whole and part by part.

use super::aggregate::Leaf;
use super::records::part_of;
use super::syntax::{
    Argument, Assigned, Base, Callee, Component, Expression, Index, Type, indices,
};
use super::translate::Translator;
use crate::geometry::units::MM;
use crate::program::displacing::{Displacing, grown_by_any};
use crate::program::names::{Meaning, Symbol};
use crate::program::notation::mentions;
use crate::program::numbers::parts;
use crate::program::quantity::Quantity;
use crate::program::script::{DISPLACED_SOMEHOW, Expr, Held, How, Part, PartValue};
use crate::program::{Displacement, Shift};

/// How a coordinate of a target ends.
const AXES: [&[u8]; 3] = [b".trans.x", b".trans.y", b".trans.z"];

/// The coordinate that the name of a part of a target means.
fn axis_of(part: &[u8]) -> Option<usize> {
    AXES.into_iter().position(|axis| part.ends_with(axis))
}

/// A text in small letters and without blanks.
pub(super) fn small(text: &[u8]) -> Vec<u8> {
    let text = text.iter().filter(|b| !b.is_ascii_whitespace());
    text.map(u8::to_ascii_lowercase).collect()
}

impl Translator<'_> {
    /// `name{i}.part := value`
    pub(super) fn assign(
        &mut self,
        name: Symbol,
        index: Index,
        component: Component,
        value: Assigned,
    ) {
        let kind = self.resolved.kind(name, self.context);
        let is_frame = match kind {
            Some(kind) => kind.is_frame(),
            None => {
                matches!(component, Component::Leaves(..)) || matches!(value, Assigned::Leaves(_))
            }
        };
        if kind.is_some_and(|kind| !kind.is_frame() && !kind.is_target()) {
            return;
        }
        if is_frame && kind.is_none() {
            self.wanted.entry(name).or_insert(Type::Tooldata);
        }
        let all = self.written(name, index);
        if all.is_empty() {
            return;
        }
        let wanted = kind.or_else(|| self.wanted.get(&name).copied());
        let wanted = wanted.unwrap_or(Type::Robtarget);
        let how = if wanted.is_frame() {
            self.frame_becomes(name, component, value)
        } else {
            self.target_becomes(name, component, value, wanted)
        };
        for variable in all {
            let (place, how) = (self.here, how.clone());
            self.emit_write(place, variable, how);
        }
    }

    fn target_becomes(
        &mut self,
        name: Symbol,
        component: Component,
        value: Assigned,
        wanted: Type,
    ) -> How {
        let Assigned::To(expression) = value else {
            return How::Whole(self.computed());
        };
        if component != Component::Whole {
            return self.part_becomes(component, &expression);
        }
        if let Expression::Point {
            base: Base::Target(target),
            ..
        } = expression
        {
            let named = &mut self.builder.script.targets[target as usize].name;
            *named = Some(self.resolved.spelling(name).into());
        }
        How::Whole(self.position_from(expression, wanted))
    }

    fn frame_becomes(&mut self, name: Symbol, component: Component, value: Assigned) -> How {
        match (component, value) {
            (Component::Leaves(first, _), Assigned::Leaves(leaves))
                if !self.resolved.parsed.leaves[indices(leaves)].contains(&Leaf::Computed) =>
            {
                How::Parts {
                    first: u32::from(first),
                    parts: self.record_parts(leaves, self.here),
                }
            }
            (Component::Leaves(first, count), _) => {
                let count = usize::from(count);
                let computed = || vec![part_of(Leaf::Computed, self.here); count];
                let (_, text) = self.own_and_value();
                let parts = self
                    .constant_parts(&text)
                    .or_else(|| self.no_load(&text))
                    .filter(|parts| parts.len() == count);
                let parts = parts.unwrap_or_else(computed);
                How::Parts {
                    first: u32::from(first),
                    parts: self.add_parts(parts),
                }
            }
            (Component::Whole, Assigned::Leaves(leaves)) => {
                let parts = self.record_parts(leaves, self.here);
                let name = self.resolved.spelling(name).into();
                let record = self.builder.script.value(Held::Record {
                    name,
                    parts,
                    on: Box::default(),
                });
                How::Whole(Expr::Value(record))
            }
            (Component::Whole, Assigned::To(expression)) => match expression {
                Expression::Point { .. } => How::Whole(self.frame_from(expression)),
                _ => How::Whole(self.frame_assigned()),
            },
            (Component::Place | Component::Other, _) => How::PartSomehow(self.changed()),
        }
    }

    /// The parts of `load0`, where that is the controller's own.
    ///
    /// # Source
    /// ABB, Technical reference manual RAPID Instructions, Functions and Data types, `loaddata`:
    /// `load0` is a constant of 1 g at 1 um along z.
    fn no_load(&self, text: &[u8]) -> Option<Vec<Part>> {
        let is_own = |name| matches!(self.resolved.meaning(name, self.context), Meaning::Nothing);
        let name = self.resolved.parsed.symbols.find(b"load0");
        if text != b"load0" || !name.is_none_or(is_own) {
            return None;
        }
        let values = [0.001, 0.0, 0.0, 0.001, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
        let part = |value| Part {
            value: PartValue::Number(value),
            place: self.here,
            length: 0,
        };
        Some(values.map(part).to_vec())
    }

    /// What `p.trans.z:=` makes of a target: it displaces it by 200 mm where `p.trans.z+200` is
    /// behind it, or that of the target that it is a copy of.
    fn part_becomes(&mut self, component: Component, value: &Expression) -> How {
        let changed = self.changed();
        let (own, text) = self.own_and_value();
        if let Some(how) = self.axes_written(&own) {
            return how;
        }
        let axis = axis_of(&own);
        if let Some(axis) = axis
            && let Some((term, by)) = self.term_and_rest(&text, &own, AXES[axis])
            && let Some(displacement) = grown_by_any(axis, by)
        {
            if term == own {
                return self.builder.script.part_by(changed, displacement);
            }
            let other = term.strip_suffix(AXES[axis]);
            if let Some(other) = other.and_then(|name| self.resolved.parsed.symbols.find(name)) {
                let other = self.position(other, Index::Whole, Type::Robtarget);
                let by = self.builder.script.displacement(displacement);
                return How::PartOf {
                    remark: changed,
                    of: other,
                    axis,
                    by,
                };
            }
        }
        if let Some(displacement) = self.added_to_all(&own, &text) {
            return self.builder.script.part_by(changed, displacement);
        }
        let has = |part: &[u8]| memchr::memmem::find(&own, part).is_some();
        let is_own = mentions(&text, &own);
        match component {
            // those of another target have its correction, which is another one
            Component::Place if text.ends_with(b".trans") => How::part(is_own, false, changed),
            Component::Place => {
                let is_own = self.resolved.is_from_target(value, self.context);
                How::part(is_own, false, changed)
            }
            _ if has(b".rot") => How::part(true, true, changed),
            // with another posture the correction is another one
            _ if has(b".robconf") => How::PartNumber(changed),
            // external axes that carry nothing
            _ => How::PartBy(changed, DISPLACED_SOMEHOW),
        }
    }

    /// `[[p.trans.x,p.trans.y,p.trans.z+50],p.rot,p.robconf,…]`: `p`, displaced.
    pub(super) fn other_place(&mut self, composed: u32) -> Option<Expr> {
        let at = self.resolved.parsed.composed[composed as usize].at;
        let bytes = &self.resolved.sources[at.file as usize].bytes;
        let inside = bytes.get(at.offset as usize..)?.strip_prefix(b"[")?;
        let letters = |part: &[u8]| -> Vec<u8> {
            let letters = part.iter().filter(|b| !b.is_ascii_whitespace());
            letters.map(u8::to_ascii_lowercase).collect()
        };
        let mut all = parts(inside).map(letters);
        let (place, rotation, posture) = (all.next()?, all.next()?, all.next()?);
        let name = rotation.strip_suffix(b".rot")?;
        let symbol = self.resolved.parsed.symbols.find(name)?;
        let kind = self.resolved.kind(symbol, self.context);
        if kind != Some(Type::Robtarget) || posture != [name, b".robconf"].concat() {
            return None;
        }
        let own = [name, b".trans"].concat();
        let by = match place.strip_prefix(b"[") {
            Some(inside) => {
                let mut along = [0.0; 3].map(Quantity::exactly);
                let axes = [&b".x"[..], b".y", b".z"];
                let mut all = parts(inside);
                for (along, axis) in along.iter_mut().zip(axes) {
                    let own = [&own[..], axis].concat();
                    let axis = [b".trans", axis].concat();
                    let (term, by) = self.term_and_rest(all.next()?, &own, &axis)?;
                    if term != own {
                        return None;
                    }
                    *along = by.in_unit(MM);
                }
                let mut by = Displacing::new();
                by.along_frame(&along);
                by.displacement()
            }
            None if place == own => Displacement::None,
            None => self.added_to_all(&own, &place)?,
        };
        // with other external axes
        let by = match by {
            Displacement::None => Displacement::By(Box::new(Shift::none())),
            by => by,
        };
        let base = self.position(symbol, Index::Whole, Type::Robtarget);
        let by = self.builder.script.displacement(by);
        Some(self.builder.script.displaced(base, by))
    }

    /// `p.trans:=p.trans+[0,0,200]`
    fn added_to_all(&self, own: &[u8], text: &[u8]) -> Option<Displacement> {
        let rest = own.ends_with(b".trans").then(|| text.strip_prefix(own))??;
        let sign = match *rest.first()? {
            b'+' => 1.0,
            b'-' => -1.0,
            _ => return None,
        };
        let of = |part: &[u8]| {
            let value = self
                .resolved
                .quantity(part, self.here, self.context, &mut |_| None);
            value.times(sign).in_unit(MM)
        };
        let inside = rest[1..].strip_prefix(b"[");
        let along = match inside.and_then(|inside| inside.strip_suffix(b"]")) {
            Some(inside) => parts(inside).map(of).collect::<Vec<_>>().try_into().ok()?,
            None => [&b".x"[..], b".y", b".z"].map(|axis| of(&[&rest[1..], axis].concat())),
        };
        let mut by = Displacing::new();
        by.along_frame(&along);
        Some(by.displacement())
    }

    /// What `Add p.trans.x,5`, `Incr p.trans.x` and `Decr p.trans.x` make of a target.
    pub(super) fn grown(&mut self, callee: Callee, all: &[Argument]) -> Option<How> {
        let Callee::Named(name) = callee else {
            return None;
        };
        let bytes = &self.resolved.sources[self.here.file as usize].bytes;
        let text = |argument: &Argument| small(&bytes[indices(argument.span)]);
        let axis = axis_of(&text(all.first()?))?;
        let spelling = self.resolved.spelling(name).to_ascii_lowercase();
        let by = match spelling.as_str() {
            "incr" => Quantity::exactly(1.0),
            "decr" => Quantity::exactly(-1.0),
            "add" => {
                let by = text(all.get(1)?);
                let (here, context) = (self.here, self.context);
                self.resolved.quantity(&by, here, context, &mut |_| None)
            }
            _ => return None,
        };
        let displacement = grown_by_any(axis, by)?;
        let changed = self.changed();
        Some(self.builder.script.part_by(changed, displacement))
    }

    /// What the present assignment writes, and what: in small letters and without blanks.
    pub(super) fn own_and_value(&self) -> (Vec<u8>, Vec<u8>) {
        let bytes = &self.resolved.sources[self.here.file as usize].bytes;
        let text = &bytes[self.here.offset as usize..];
        let end = memchr::memchr(b';', text).unwrap_or(text.len());
        let text = small(&text[..end]);
        match memchr::memmem::find(&text, b":=") {
            Some(at) => (text[..at].to_vec(), text[at + 2..].to_vec()),
            None => (text, Vec::new()),
        }
    }

    /// The one part of a position that stands in a sum, and the rest of that.
    fn term_and_rest(&self, text: &[u8], own: &[u8], axis: &[u8]) -> Option<(Vec<u8>, Quantity)> {
        let mut term: Option<Vec<u8>> = None;
        let mut is_one = true;
        let value = self
            .resolved
            .quantity(text, self.here, self.context, &mut |operand| {
                if operand != own && !self.is_part_of_position(operand, axis) {
                    return None;
                }
                is_one &= term.is_none();
                term = Some(operand.to_vec());
                Some(Quantity::own())
            });
        let (count, rest) = value.apart();
        term.filter(|_| is_one && count == 1.0)
            .map(|term| (term, rest))
    }

    /// Whether an operand is this part of a position.
    fn is_part_of_position(&self, operand: &[u8], axis: &[u8]) -> bool {
        let name = operand.strip_suffix(axis);
        let name = name.and_then(|name| self.resolved.parsed.symbols.find(name));
        let kind = name.and_then(|name| self.resolved.kind(name, self.context));
        kind.is_some_and(Type::is_target)
    }
}

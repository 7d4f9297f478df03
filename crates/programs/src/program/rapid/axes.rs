//! External axes of positions that the running program works out from others.

use super::EXTERNAL;
use super::arguments::NOT_CONNECTED;
use super::resolved::{Entity, Resolved};
use super::syntax::{Expression, Storage, Stored, Type, indices};
use super::translate::Translator;
use crate::program::names::{Context, Meaning, Symbol};
use crate::program::numbers::parts;
use crate::program::script::{Expr, How, Remark, short};
use crate::program::{External, ExternalUse, number};

impl Translator<'_> {
    /// What becomes of a position of which external axes are written (`own`): of those that the
    /// profile lists.
    pub(super) fn axes_written(&mut self, own: &[u8]) -> Option<How> {
        let (_, member) = own.split_at(memchr::memmem::find(own, b".extax")?);
        let is_meant = |name: &&str| {
            let one = member.strip_prefix(b".extax.");
            one.is_none_or(|one| one == name.as_bytes())
        };
        let is_listed = |name: &&str| matches!(self.external.meaning(name), ExternalUse::Listed(_));
        let mut all = EXTERNAL.into_iter().filter(is_meant);
        let name = all.find(is_listed)?;
        let remark = Remark::external_written(name);
        Some(How::Whole(self.builder.script.unknown(remark)))
    }

    /// Against a position with other external axes than that which it is worked out from, where it
    /// does not stand in a move itself.
    pub(super) fn with_other_axes(&mut self, composed: u32) -> Option<Expr> {
        let own = self.resolved.own_axes(composed, self.context)?;
        let remark = EXTERNAL.into_iter().zip(own).find_map(|(name, value)| {
            match self.external.meaning(name) {
                ExternalUse::Listed(_) => Some(Remark::external_written(name)),
                _ => self.carries_unknown(name, value),
            }
        });
        remark.map(|remark| self.builder.script.unknown(remark))
    }

    /// Where external axes stand in the next move, which goes to a position that is worked out from
    /// others in its own text; why nobody knows what one carries.
    pub(super) fn axes_of_move(&mut self, expression: &Expression) -> Option<Expr> {
        let (Expression::Composed(composed) | Expression::List(composed)) = *expression else {
            return None;
        };
        let own = self.resolved.own_axes(composed, self.context)?;
        let mut unknown = None;
        for (name, value) in EXTERNAL.into_iter().zip(own) {
            if let ExternalUse::Listed(axis) = self.external.meaning(name) {
                let script = &mut self.builder.script;
                let at = short(script.instructions.len());
                let external = External { axis, value };
                script.externals_of_moves.push((at, external));
            } else if let Some(remark) = self.carries_unknown(name, value) {
                unknown = Some(self.builder.script.unknown(remark));
            }
        }
        unknown
    }

    /// Against an axis that stands somewhere of which the profile does not say what it carries.
    fn carries_unknown(&self, name: &str, value: f64) -> Option<Remark> {
        let is_unknown = self.external.meaning(name) == ExternalUse::Unknown;
        let stands = value.is_finite() && value != 0.0;
        (is_unknown && stands).then(|| Remark::external_unknown(name, value))
    }
}

impl Resolved<'_> {
    /// The external axes of a target that is worked out from others, where they are not those of
    /// these; not a number where the text does not tell.
    fn own_axes(&self, composed: u32, context: Context) -> Option<[f64; 6]> {
        let composed = &self.parsed.composed[composed as usize];
        let source = &self.sources[composed.at.file as usize].bytes;
        let inside = source
            .get(composed.at.offset as usize..)?
            .strip_prefix(b"[")?;
        let last = parts(inside).last()?.trim_ascii();
        let written = axes_in(last);
        let named = last.split(|byte| *byte == b'.').next().unwrap_or(last);
        let is_of_target = last.len() > named.len();
        let own = written.or_else(|| self.declared_axes(named, is_of_target, context));
        let names = self.parsed.mentions[indices(composed.names)].iter();
        let is_target = |name: &&Symbol| self.kind(**name, context).is_some_and(Type::is_target);
        let mut bases = names.filter(is_target).peekable();
        if written.is_none() && is_of_target {
            let has = |name: &Symbol| self.parsed.symbols.find(base_of(named)) == Some(*name);
            let own = named.trim_ascii_end();
            let elements = parts(inside).flat_map(|part| elements(part, base_of(named)));
            if bases.clone().all(has)
                && elements
                    .into_iter()
                    .all(|element| element.eq_ignore_ascii_case(own))
            {
                return None;
            }
        }
        bases.peek()?;
        let is_alike = |name: &Symbol| {
            let base = self.declared_axes(self.spelling(*name).as_bytes(), true, context);
            base.zip(own).is_some_and(|(base, own)| {
                let same = |(a, b): (f64, f64)| a == b || a.is_nan() && b.is_nan();
                base.into_iter().zip(own).all(same)
            })
        };
        (!bases.all(is_alike)).then(|| own.unwrap_or([f64::NAN; 6]))
    }

    /// The external axes that a target is declared with, or that are declared by themselves, where
    /// nothing writes them.
    fn declared_axes(&self, name: &[u8], is_target: bool, context: Context) -> Option<[f64; 6]> {
        let name = self.parsed.symbols.find(name.trim_ascii())?;
        let Meaning::One(datum) = self.meaning(name, context) else {
            return None;
        };
        let of = self.datum(datum);
        let is_known = if is_target {
            let is_one = matches!(
                of.value,
                Stored::Elements {
                    sizes: [0, 0, 0],
                    ..
                }
            );
            of.kind.is_target() && is_one && !self.is_written(Entity::Declared(datum))
        } else {
            of.storage == Storage::Constant
        };
        let source = &self.sources[of.place.file as usize].bytes;
        let text = source
            .get(of.place.offset as usize..)
            .filter(|_| is_known)?;
        let text = &text[..memchr::memchr(b';', text)?];
        let value = text[memchr::memmem::find(text, b":=")? + 2..].trim_ascii();
        if is_target {
            return axes_in(parts(value.strip_prefix(b"[")?).last()?.trim_ascii());
        }
        axes_in(value)
    }
}

/// The name of an element of an array, or of what is none.
fn base_of(named: &[u8]) -> &[u8] {
    let end = memchr::memchr(b'{', named).unwrap_or(named.len());
    named[..end].trim_ascii()
}

/// Each mention of this name, with the index behind it.
fn elements<'a>(text: &'a [u8], name: &'a [u8]) -> impl Iterator<Item = &'a [u8]> {
    let is_name = |byte: &u8| byte.is_ascii_alphanumeric() || *byte == b'_';
    let mut at = 0;
    std::iter::from_fn(move || {
        while let Some(rest) = text.get(at..) {
            let start = at + rest.iter().position(is_name)?;
            let word = text[start..]
                .iter()
                .take_while(|byte| is_name(byte))
                .count();
            at = start + word;
            if text[start..at].eq_ignore_ascii_case(name) {
                let index = text[at..].strip_prefix(b"{");
                let close = index.and_then(|index| memchr::memchr(b'}', index));
                return Some(&text[start..close.map_or(at, |close| at + close + 2)]);
            }
        }
        None
    })
}

/// The external axes of a list in brackets; not a number where they are no numbers, or not
/// connected.
fn axes_in(text: &[u8]) -> Option<[f64; 6]> {
    let mut axes = [f64::NAN; 6];
    for (axis, text) in axes.iter_mut().zip(parts(text.strip_prefix(b"[")?)) {
        let value = number::parse(text.trim_ascii());
        *axis = value
            .filter(|value| value.abs() < NOT_CONNECTED)
            .unwrap_or(f64::NAN);
    }
    Some(axes)
}

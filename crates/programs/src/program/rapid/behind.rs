//! Targets behind data that are none: what members of records and numbers take along of them.
//!
//! `rc.at:=p1; rc.above:=RelTool(rc.at,0,0,-50); MoveL rc.above,…`

use super::derived::{Holder, Origin, Origins};
use super::parts::small;
use super::resolved::{Entity, Resolved, named};
use super::syntax::{Index, Storage, Type};
use super::translate::Translator;
use crate::program::Source;
use crate::program::names::{Context, Meaning, Symbol};
use crate::program::script::{Expr, OVERWRITTEN, Place, Remark, UNBOUNDED};
use foldhash::{HashSet, HashSetExt};
use std::cell::RefCell;

/// Data by their name, where that stands, and the path of the member that counts.
pub(super) type Asked = (Symbol, Context, Option<Vec<u8>>);

/// The targets behind data.
#[derive(Default)]
struct Behind {
    /// Each with where it is named and whether it is copied as it is.
    targets: HashSet<(Symbol, Context, bool)>,
    /// Numbers that come from no target are written over some of the coordinates.
    overwritten: bool,
}

/// A name with its members, in small letters and without indices: `rc{i}.At` is `rc.at`.
fn path(text: &[u8]) -> Vec<u8> {
    let mut depth = 0;
    let mut path = small(text);
    path.retain(|letter| {
        depth += i32::from(*letter == b'{');
        let is_inside = depth > 0;
        depth -= i32::from(*letter == b'}');
        !is_inside
    });
    path
}

/// The rest of a path behind another one that leads to it.
fn after<'p>(path: &'p [u8], to: &[u8]) -> Option<&'p [u8]> {
    let rest = path.strip_prefix(to)?;
    matches!(rest.first(), None | Some(b'.')).then_some(rest)
}

impl Resolved<'_> {
    /// The targets whose numbers flow into data; `member` is the path of the member that counts.
    fn behind(
        &self,
        origins: &Origins,
        (name, here): (Symbol, Context),
        member: Option<&[u8]>,
    ) -> Behind {
        let mut found = Behind::default();
        let mut open = self.holders(name, here, member);
        let mut seen = HashSet::new();
        while let Some((holder, member)) = open.pop() {
            if !seen.insert((holder, member.is_some())) {
                continue;
            }
            for origin in origins.of(holder) {
                let (value, context, at) = match *origin {
                    Origin::Value(value, context, at) => (value, context, at),
                    Origin::Given(value, context) => (value, context, None),
                    Origin::Parameter(datum) => {
                        open.push((Holder::Data(Entity::Declared(datum)), None));
                        continue;
                    }
                };
                let mut is_copy = false;
                if let (Some(member), Some(at)) = (member, at) {
                    let written = self.path_written(at);
                    let into = after(&written, member);
                    if into.is_none() && after(member, &written).is_none() {
                        continue;
                    }
                    // what a parameter was in a call that is over nobody knows
                    let copied = named(&value).filter(|name| !self.is_parameter(*name, context));
                    is_copy = into.is_some_and(<[u8]>::is_empty) && copied.is_some();
                    found.overwritten |= into.is_some_and(|part| part.starts_with(b".trans"))
                        && !self.is_from_target(&value, context);
                }
                let names = RefCell::new(Vec::new());
                self.any_name(&value, &|name| {
                    names.borrow_mut().push(name);
                    false
                });
                for name in names.into_inner() {
                    let is_target = self.kind(name, context).is_some_and(Type::is_target);
                    // of another routine's parameter what calls give it
                    let is_elsewhere = context.routine != here.routine;
                    if is_target && !(is_elsewhere && self.is_parameter(name, context)) {
                        found.targets.insert((name, context, is_copy));
                    } else {
                        open.extend(self.holders(name, context, None));
                    }
                }
            }
        }
        found
    }

    /// What a name that is no target may hold numbers in.
    fn holders<'p>(
        &self,
        name: Symbol,
        context: Context,
        member: Option<&'p [u8]>,
    ) -> Vec<(Holder, Option<&'p [u8]>)> {
        let several = self.data_named(name, context).into_iter();
        let data = match self.meaning(name, context) {
            Meaning::Nothing => vec![Entity::Undeclared(name)],
            _ => several.map(Entity::Declared).collect(),
        };
        let data = data.into_iter().map(|data| (Holder::Data(data), member));
        let result = self.function_of(name, context).map(Holder::Result);
        data.chain(result.map(|result| (result, None))).collect()
    }

    fn is_parameter(&self, name: Symbol, context: Context) -> bool {
        let is_parameter = |of: &u32| matches!(self.datum(*of).storage, Storage::Parameter { .. });
        self.data_named(name, context).iter().any(is_parameter)
    }

    /// What the assignment in this place writes.
    fn path_written(&self, at: Place) -> Vec<u8> {
        let text = &self.sources[at.file as usize].bytes[at.offset as usize..];
        let end = memchr::memmem::find(text, b":=").unwrap_or(0);
        path(&text[..end])
    }

    /// Whether data have a value before the program runs.
    pub(super) fn has_value(&self, name: Symbol, context: Context) -> bool {
        let has = |datum: &u32| {
            let at = self.datum(*datum).place;
            let text = &self.sources[at.file as usize].bytes[at.offset as usize..];
            let end = memchr::memchr(b';', text).unwrap_or(text.len());
            memchr::memmem::find(&text[..end], b":=").is_some()
        };
        self.data_named(name, context).iter().any(has)
    }
}

impl Translator<'_> {
    /// Where a member of a record is, as the text between these bytes names it: at the targets that
    /// flow into it, and at what it holds before the program runs.
    pub(super) fn in_record(&mut self, name: Symbol, (start, end): (u32, u32)) -> Expr {
        let bytes = &self.resolved.sources[self.here.file as usize].bytes;
        let text = &bytes[start as usize..end as usize];
        let member = path(text);
        let own = self.builder.script.unknown(Remark::warning_about(
            "computed-target",
            format!(
                "{}, where this move goes to, is a part of a record; what it holds is known at run \
                 time only, and the move stays as it is",
                Source::text(text).trim()
            ),
            "declare the target as data of its own, with numbers",
        ));
        self.at_member(name, Some(&member), own)
    }

    /// Where a member of data that are no target is: at the targets behind it; `own` where there are
    /// none, or the data have a value before the program runs.
    pub(super) fn at_member(&mut self, name: Symbol, member: Option<&[u8]>, own: Expr) -> Expr {
        let mut all = self.at_targets_behind(name, member);
        if all.is_empty() || self.resolved.has_value(name, self.context) {
            all.push(own);
        }
        self.builder.script.any(all)
    }

    /// Where data that are no targets have numbers of: the targets behind them, displaced.
    pub(super) fn at_targets_behind(&mut self, name: Symbol, member: Option<&[u8]>) -> Vec<Expr> {
        let key = (name, self.context, member.map(<[u8]>::to_vec));
        if let Some(known) = self.behind.get(&key) {
            return known.clone();
        }
        let resolved = self.resolved;
        let origins = self.origins.get_or_insert_with(|| resolved.origins());
        let behind = resolved.behind(origins, (name, self.context), member);
        let mut targets: Vec<_> = behind.targets.into_iter().collect();
        targets.sort_unstable_by_key(|(name, context, is_copy)| (*name, context.routine, *is_copy));
        let mut all = Vec::new();
        for (name, context, is_copy) in targets {
            let base = self.position_in(name, Index::Whole, Type::Robtarget, context, 0);
            let script = &mut self.builder.script;
            if behind.overwritten {
                all.push(script.displaced(base, OVERWRITTEN));
            }
            all.push(if is_copy {
                base
            } else {
                script.displaced(base, UNBOUNDED)
            });
        }
        self.behind.insert(key, all.clone());
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn members_lie_within_records() {
        assert_eq!(path(b" Rc{i, 2} . At.Trans"), b"rc.at.trans");
        assert_eq!(after(b"rc.at.trans.x", b"rc.at"), Some(&b".trans.x"[..]));
        assert_eq!(after(b"rc.at", b"rc.at"), Some(&b""[..]));
        assert_eq!(after(b"rc.above", b"rc.a"), None);
    }
}

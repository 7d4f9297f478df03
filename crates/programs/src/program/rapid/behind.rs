//! Targets behind data that are none: what members of records and numbers take along of them.
//!
//! `rc.at:=p1; rc.above:=RelTool(rc.at,0,0,-50); MoveL rc.above,…`

use super::derived::{Holder, Origin, Origins};
use super::parts::small;
use super::resolved::{Entity, Resolved, named};
use super::syntax::{Expression, Index, Storage, Type};
use super::translate::Translator;
use crate::program::Source;
use crate::program::names::{Context, Meaning, Symbol};
use crate::program::script::{Expr, OVERWRITTEN, Place, Remark, UNBOUNDED};
use foldhash::{HashSet, HashSetExt};
use std::cell::RefCell;

/// Names of members within members that are followed.
const DEEPEST_MEMBER: usize = 6;

/// Data by their name, where that stands, and the path of the member that counts.
pub(super) type Asked = (Symbol, Context, Option<Vec<u8>>);

/// The targets behind data.
#[derive(Default)]
struct Behind {
    /// Each with where it is named and whether it is copied as it is.
    targets: HashSet<(Symbol, Context, bool)>,
    /// Numbers that come from no target are written over some of the coordinates.
    overwritten: bool,
    /// What is copied as it is may be what a record holds before the program runs.
    declared: bool,
}

/// What is looked into for the targets behind it.
#[derive(Clone, PartialEq, Eq, Hash)]
struct Open {
    holder: Holder,
    /// The path of the member that counts.
    member: Option<Vec<u8>>,
    /// What the member holds is copied as it is.
    is_copy: bool,
}

/// A name with its members, in small letters and without indices: `rc{i}.At` is `rc.at`.
pub(super) fn path(text: &[u8]) -> Vec<u8> {
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
        let mut open = self.holders(name, here, member, true);
        let mut seen = HashSet::new();
        while let Some(next) = open.pop() {
            if !seen.insert(next.clone()) {
                continue;
            }
            let Open {
                holder,
                member,
                is_copy: all_copied,
            } = next;
            for origin in origins.of(holder) {
                let (value, context, at) = match *origin {
                    Origin::Value(value, context, at) => (value, context, at),
                    Origin::Given(value, context) => (value, context, None),
                    Origin::Parameter(datum) => {
                        open.push(Open {
                            holder: Holder::Data(Entity::Declared(datum)),
                            member: None,
                            is_copy: false,
                        });
                        continue;
                    }
                };
                let mut is_copy = false;
                if let (Some(member), Some(at)) = (&member, at) {
                    let (written, text) = self.paths(at);
                    let into = after(&written, member);
                    let within = after(member, &written);
                    if into.is_none() && within.is_none() {
                        continue;
                    }
                    if all_copied
                        && let Some(rest) = within
                        && let Some((of, from)) = self.copied_member((&value, context), &text, rest)
                    {
                        found.declared |= self.has_value(of, context);
                        open.extend(self.holders(of, context, Some(&from), true));
                        continue;
                    }
                    // what a parameter was in a call that is over nobody knows
                    let copied = named(&value).filter(|name| !self.is_parameter(*name, context));
                    is_copy =
                        all_copied && within.is_some_and(<[u8]>::is_empty) && copied.is_some();
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
                        open.extend(self.holders(name, context, None, false));
                    }
                }
            }
        }
        found
    }

    /// The record that a value or the record around it is, and the path to what counts of it:
    /// `rest` within the value. `None` where it is a target, or a parameter's.
    fn copied_member(
        &self,
        (value, context): (&Expression, Context),
        text: &[u8],
        rest: &[u8],
    ) -> Option<(Symbol, Vec<u8>)> {
        let name = named(value).filter(|name| {
            let kind = self.kind(*name, context);
            !kind.is_some_and(Type::is_target) && !self.is_parameter(*name, context)
        })?;
        let is_path = |b: &u8| b.is_ascii_alphanumeric() || matches!(b, b'_' | b'.');
        let mut path = text.to_vec();
        path.extend_from_slice(rest);
        let depth = memchr::memchr_iter(b'.', &path).count();
        (path.iter().all(is_path) && depth <= DEEPEST_MEMBER).then_some((name, path))
    }

    /// What a name that is no target may hold numbers in.
    fn holders(
        &self,
        name: Symbol,
        context: Context,
        member: Option<&[u8]>,
        is_copy: bool,
    ) -> Vec<Open> {
        let several = self.data_named(name, context).into_iter();
        let data = match self.meaning(name, context) {
            Meaning::Nothing => vec![Entity::Undeclared(name)],
            _ => several.map(Entity::Declared).collect(),
        };
        let data = data.into_iter().map(|data| Open {
            holder: Holder::Data(data),
            member: member.map(<[u8]>::to_vec),
            is_copy,
        });
        let result = self.function_of(name, context).map(|result| Open {
            holder: Holder::Result(result),
            member: None,
            is_copy: false,
        });
        data.chain(result).collect()
    }

    fn is_parameter(&self, name: Symbol, context: Context) -> bool {
        let is_parameter = |of: &u32| matches!(self.datum(*of).storage, Storage::Parameter { .. });
        self.data_named(name, context).iter().any(is_parameter)
    }

    /// What the assignment in this place writes, and what it is given.
    fn paths(&self, at: Place) -> (Vec<u8>, Vec<u8>) {
        let text = &self.sources[at.file as usize].bytes[at.offset as usize..];
        let text = &text[..memchr::memchr(b';', text).unwrap_or(text.len())];
        match memchr::memmem::find(text, b":=") {
            Some(end) => (path(&text[..end]), path(&text[end + 2..])),
            None => (Vec::new(), Vec::new()),
        }
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
        if behind.declared {
            all.push(self.computed_name(name));
        }
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

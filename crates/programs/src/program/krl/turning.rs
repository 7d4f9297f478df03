//! How the tool turns on straight moves and arcs: `$ORI_TYPE`, `$CIRC_TYPE`, `$CIRC_MODE`, and what
//! LDAT says of them.

use super::data::{self, is_usual_arc};
use super::frames::State;
use super::moves::skip_value;
use super::names::{Index, Ldat, Stored, Turning};
use super::reader::Reader;
use super::states::inside;
use super::tokens::{Cursor, Token, capitals};
use crate::program::Place;
use crate::program::names::Symbol;
use crate::program::script::{Expr, Held, Remark, Script, ValueId, Variable, VariableId};

/// What of an arc a statement may set: its type, and the orientations of the point between and of
/// the end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Arc {
    Type,
    Between,
    End,
}

/// What speaks against arcs.
#[derive(Debug)]
pub(super) struct Circles {
    /// `$CIRC_TYPE`, `$CIRC_MODE.AUX_PT.ORI`, `$CIRC_MODE.TARGET_PT.ORI`: by [`Arc`].
    pub states: [VariableId; 3],
    /// `LDAT_ACT.CIRC_TYP`
    pub active: VariableId,
    /// Another arc than from beginning to end in the base.
    other: ValueId,
    usual: ValueId,
}

impl Circles {
    pub(super) fn new(script: &mut Script) -> Self {
        let remark = script.remark(Remark::error(
            "move-not-supported",
            "$CIRC_TYPE or $CIRC_MODE may let the tool turn otherwise on this arc than from its \
             beginning to its end",
            "set $CIRC_TYPE=#BASE and $CIRC_MODE.AUX_PT.ORI=#CONSIDER before the arc, or write it \
             in straight moves",
        ));
        let other = script.value(Held::Remark(remark));
        let usual = script.value(Held::Flag(true));
        let mut variable = |name| {
            script.variable(Variable {
                shared: true,
                ..Variable::new(name, Place::NOWHERE, Expr::Value(usual))
            })
        };
        Self {
            states: ["$CIRC_TYPE", "$CIRC_MODE.AUX_PT", "$CIRC_MODE.TARGET_PT"].map(&mut variable),
            active: variable("LDAT_ACT.CIRC_TYP"),
            other,
            usual,
        }
    }

    pub(super) fn value(&self, is_usual: bool) -> Expr {
        Expr::Value(if is_usual { self.usual } else { self.other })
    }
}

impl Reader {
    /// `#CONSTANT`, `SORI_TYP(LCPDAT1)`, `LDAT_ACT.ORI_TYP`
    pub(super) fn orientation(&mut self, cursor: &mut Cursor) -> Expr {
        if cursor.take(b'#') {
            let name = cursor.next();
            let turning = Turning::named(capitals(cursor.text(name), &mut [0; 24]));
            return self.orientation_value(turning);
        }
        if let Some((turning, _)) = self.of_ldat(cursor, b"SORI_TYP") {
            return turning;
        }
        skip_value(cursor);
        self.orientation_value(Turning::Kept)
    }

    /// What the LDAT of `SORI_TYP(LCPDAT1)` or `LDAT_ACT.ORI_TYP` says.
    fn of_ldat(&mut self, cursor: &mut Cursor, function: &[u8]) -> Option<(Expr, [Expr; 3])> {
        let mut ahead = *cursor;
        let name = ahead.next();
        let is_active = ahead.text(name).eq_ignore_ascii_case(b"LDAT_ACT");
        let found = if is_active {
            ahead.take(b'.');
            ahead.next();
            let mut name = cursor.part(name.start as usize, name.end as usize);
            self.ldat(&mut name)
        } else if ahead.text(name).eq_ignore_ascii_case(function) {
            self.ldat(&mut inside(&mut ahead)?)
        } else {
            return None;
        };
        *cursor = ahead;
        Some(found)
    }

    /// How the tool turns by `LCPDAT1`, `{VEL 2,…}` or `LDAT_ACT`.
    pub(super) fn ldat(&mut self, cursor: &mut Cursor) -> (Expr, [Expr; 3]) {
        if cursor.blanks() == b'{' {
            let ldat = data::ldat(cursor).unwrap_or(Ldat::UNKNOWN);
            return self.by_ldat(ldat);
        }
        let token = cursor.next();
        if cursor.text(token).eq_ignore_ascii_case(b"LDAT_ACT") {
            let usual = self.circles.value(true);
            let active = Expr::Variable(self.circles.active);
            return (
                self.states.expr(State::LdatOrientation),
                [active, usual, usual],
            );
        }
        let name = self.symbol(cursor, token);
        let at = Index::of(cursor.brackets().unwrap_or(None), cursor);
        let ldat = self.ldat_of(name, at);
        self.by_ldat(ldat)
    }

    fn by_ldat(&self, ldat: Ldat) -> (Expr, [Expr; 3]) {
        let circles = ldat.arcs.map(|is_usual| self.circles.value(is_usual));
        (self.orientation_value(ldat.turning), circles)
    }

    /// LDAT of a name. That which the files do not have mostly leaves the orientation to the targets.
    fn ldat_of(&mut self, name: Symbol, at: Index) -> Ldat {
        let Some(datum) = self.names.datum(name, self.context()) else {
            return Ldat::default();
        };
        let names = &self.names;
        let is_written = |member: &[u8]| {
            let path = names.symbols.find(&names.symbols.path(name, member));
            path.is_some_and(|path| names.touched.contains(&path))
        };
        let members: [&[u8]; 3] = [b"ORI_TYP", b"CIRC_TYP", b"CB"];
        let is_changed = names.handed.contains(&name) || members.into_iter().any(is_written);
        match names.values(datum, at) {
            _ if is_changed => Ldat::UNKNOWN,
            [(_, _, Stored::Ldat(ldat))] => *ldat,
            [] => Ldat::default(),
            _ => Ldat::UNKNOWN,
        }
    }

    /// What `$CIRC_TYPE=`, `$CIRC_MODE=` or a part of that gives arcs; `of` is the variable in front.
    pub(super) fn circle(&mut self, of: Token, cursor: &mut Cursor) -> [Option<Expr>; 3] {
        let path = cursor.bytes[of.start as usize..cursor.at].to_ascii_uppercase();
        let path = path.trim_ascii_end();
        let path = path.strip_suffix(b"=").unwrap_or(path).trim_ascii_end();
        let names = |word: &[u8]| memchr::memmem::find(path, word).is_some();
        let set = if !names(b"$CIRC_MODE") {
            [true, false, false]
        } else if names(b"AUX_PT") {
            [false, true, false]
        } else if names(b"TARGET_PT") {
            [false, false, true]
        } else {
            [false, true, true]
        };
        // the other members are external axes
        if names(b"_PT.") && !path.ends_with(b".ORI") {
            skip_value(cursor);
            return [None; 3];
        }
        let parts = [Arc::Type, Arc::Between, Arc::End];
        let function: &[u8] = if set[0] { b"SCIRC_TYP" } else { b"SCIRC_M" };
        let of_ldat = self.of_ldat(cursor, function);
        let mut values = [Some(self.circles.value(false)); 3];
        if let Some((_, circles)) = of_ldat {
            values = circles.map(Some);
        } else if cursor.take(b'#') {
            let token = cursor.next();
            let name = cursor.text(token);
            values = parts.map(|part| Some(self.circles.value(is_usual_arc(part, name))));
        } else if cursor.blanks() == b'{' {
            let between = if set[1] { Arc::Between } else { Arc::End };
            if let Ok(found) = data::arcs(cursor, between) {
                let of = |found: Option<bool>| found.map(|is_usual| self.circles.value(is_usual));
                values = found.map(of);
            }
        } else {
            skip_value(cursor);
        }
        let mut found = [None; 3];
        for (at, is_set) in set.into_iter().enumerate() {
            found[at] = values[at].filter(|_| is_set);
        }
        found
    }

    /// Sets what arcs have.
    pub(super) fn set_circles(&mut self, place: Place, values: [Option<Expr>; 3]) {
        for (variable, value) in self.circles.states.into_iter().zip(values) {
            if let Some(value) = value {
                self.put(place, variable, value);
            }
        }
    }

    /// The orientation of `#IGNORE`.
    pub(super) fn ignored(&self) -> Expr {
        self.orientation_value(Turning::Ignored)
    }
}

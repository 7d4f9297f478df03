//! How the tool turns on straight moves and arcs: `$ORI_TYPE`, `$CIRC_TYPE`, `$CIRC_MODE`.

use super::data;
use super::frames::State;
use super::names::{Index, Stored, Turning};
use super::reader::Reader;
use super::states::inside;
use super::tokens::{Cursor, capitals};
use crate::program::script::{Expr, Held, Remark, Script, ValueId, Variable, VariableId};
use crate::program::{Motion, Place};
use foldhash::HashMap;

/// What speaks against arcs.
#[derive(Debug)]
pub(super) struct Circles {
    /// What `$CIRC_TYPE` and `$CIRC_MODE` are.
    pub state: VariableId,
    /// The move itself says that it is another arc.
    own: VariableId,
    /// Another arc than from beginning to end in the base.
    other: ValueId,
    usual: ValueId,
    /// Sets of guards with one of these, by the set without it.
    guards: HashMap<(u32, VariableId), u32>,
}

impl Circles {
    pub(super) fn new(script: &mut Script) -> Self {
        let place = Place::NOWHERE;
        let remark = script.remark(Remark::error(
            "move-not-supported",
            "$CIRC_TYPE or $CIRC_MODE may let the tool turn otherwise on this arc than from its \
             beginning to its end",
            "set $CIRC_TYPE=#BASE and $CIRC_MODE.AUX_PT.ORI=#CONSIDER before the arc, or write it \
             in straight moves",
        ));
        let other = script.value(Held::Remark(remark));
        let usual = script.value(Held::Flag(true));
        let mut variable = |name, declared| {
            script.variable(Variable {
                shared: true,
                ..Variable::new(name, place, Expr::Value(declared))
            })
        };
        Self {
            state: variable("$CIRC_TYPE", usual),
            own: variable("the arc", other),
            other,
            usual,
            guards: HashMap::default(),
        }
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
        let name = cursor.next();
        match capitals(cursor.text(name), &mut [0; 24]) {
            b"SORI_TYP" => {
                let mut ldat = inside(cursor);
                let ldat = ldat.as_mut().map(|inner| self.ldat(inner));
                ldat.unwrap_or_else(|| self.orientation_value(Turning::Kept))
            }
            b"LDAT_ACT" => self.states.expr(State::LdatOrientation),
            _ => self.orientation_value(Turning::Kept),
        }
    }

    /// The orientation of `LCPDAT1`, `{VEL 2,…}` or `LDAT_ACT`.
    pub(super) fn ldat(&mut self, cursor: &mut Cursor) -> Expr {
        if cursor.blanks() == b'{' {
            let turning = data::turning(cursor).unwrap_or(Turning::Kept);
            return self.orientation_value(turning);
        }
        let token = cursor.next();
        if cursor.text(token).eq_ignore_ascii_case(b"LDAT_ACT") {
            return self.states.expr(State::LdatOrientation);
        }
        let name = self.symbol(cursor, token);
        let at = Index::of(cursor.brackets().unwrap_or(None), cursor);
        let stored = self.names.constant(name, at, self.context());
        // LDAT that the files do not have mostly leaves the orientation to the targets
        match stored {
            Some(Stored::Turning(turning)) => self.orientation_value(turning),
            _ => self.orientation_value(Turning::Evenly),
        }
    }

    /// What `$CIRC_TYPE=` or `$CIRC_MODE.AUX_PT.ORI=` behind a byte gives arcs: the orientation of
    /// the point between is to be ignored, or to choose the side to which the tool turns.
    pub(super) fn circle(&mut self, start: usize, cursor: &mut Cursor) -> Expr {
        let of = cursor.bytes[start..cursor.at].to_ascii_uppercase();
        let is_between = memchr::memmem::find(&of, b"AUX_PT").is_some();
        let is_usual = cursor.take(b'#') && {
            let name = cursor.next();
            match capitals(cursor.text(name), &mut [0; 24]) {
                b"BASE" | b"CONSIDER" | b"IGNORE" => true,
                b"INTERPOLATE" => !is_between,
                _ => false,
            }
        };
        Expr::Value(if is_usual {
            self.circles.usual
        } else {
            self.circles.other
        })
    }

    /// Arcs are usual again.
    pub(super) fn usual_circles(&mut self, place: Place) {
        self.put(place, self.circles.state, Expr::Value(self.circles.usual));
    }

    /// What speaks against a move, on an arc; `own` is what it says itself.
    pub(super) fn guards_on_arc(&mut self, motion: Motion, guards: u32, own: Option<Expr>) -> u32 {
        let circles = &mut self.circles;
        let variable = match own {
            _ if !matches!(motion, Motion::ArcVia | Motion::ArcEnd) => return guards,
            Some(own) if own == Expr::Value(circles.usual) => return guards,
            Some(_) => circles.own,
            None => circles.state,
        };
        let script = &mut self.builder.script;
        *circles.guards.entry((guards, variable)).or_insert_with(|| {
            let all = [&script.guards[guards as usize][..], &[variable]].concat();
            script.guard(all)
        })
    }
}

//! What is known of where external axes stand at each move, and from where they come.

use crate::model::effects::Effect;
use crate::profile::Profile;
use crate::program::script::short;
use crate::program::{Before, Program};

/// A value that differs by less from the one before has not moved.
const STILL: f64 = 1e-9;

/// What is known of a value of an axis at a move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Known {
    /// Not looked at yet.
    Open,
    Is(f64),
    /// Only the running program knows, or nobody does.
    Unknown,
}

impl Known {
    fn plus(self, by: f64) -> Self {
        match self {
            Self::Is(value) => Self::Is(value + by),
            other => other,
        }
    }

    fn and(self, other: Self) -> Self {
        match (self, other) {
            (Self::Open, known) | (known, Self::Open) => known,
            (Self::Is(a), Self::Is(b)) if (a - b).abs() <= STILL => self,
            _ => Self::Unknown,
        }
    }
}

/// From where an axis comes to the end of a move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum CameFrom {
    /// Not looked at yet.
    Open,
    /// By the sign of its way.
    Going(f64),
    /// Now from one side, now from the other.
    FromBoth,
    /// Nobody knows.
    Unknown,
}

impl CameFrom {
    fn and(self, other: Self) -> Self {
        match (self, other) {
            (Self::Open, known) | (known, Self::Open) => known,
            (Self::Unknown, _) | (_, Self::Unknown) => Self::Unknown,
            (a, b) if a == b => a,
            _ => Self::FromBoth,
        }
    }

    /// Behind a move of an axis with a backlash of that width.
    fn then(self, from: Known, to: Known, width: f64) -> Self {
        let by = match (from, to) {
            (Known::Is(from), Known::Is(to)) => to - from,
            (Known::Open, _) | (_, Known::Open) => return Self::Open,
            _ => return Self::Unknown,
        };
        let there = Self::Going(by.signum());
        match self {
            _ if by.abs() <= STILL => self,
            // on the way on its backlash stays taken up; where it turns back it may not be yet
            _ if self == there || by.abs() >= width => there,
            Self::Open => Self::Open,
            _ => Self::Unknown,
        }
    }
}

/// The value of each axis at each move, kept from the moves before where it says nothing itself.
/// `added` is what relative moves add to one that is kept, in all since the last move that is none.
pub(super) fn followed(
    program: &Program,
    own: &[Option<f64>],
    added: &[Option<f64>],
    count: usize,
) -> Vec<Known> {
    let mut values: Vec<Known> = own
        .iter()
        .map(|value| match value {
            None => Known::Open,
            Some(value) if value.is_finite() => Known::Is(*value),
            Some(_) => Known::Unknown,
        })
        .collect();
    // a call that may lead the robot elsewhere may lead its external axes there
    for (motion, _) in &program.led {
        let at = *motion as usize * count;
        for (value, own) in values[at..at + count].iter_mut().zip(&own[at..]) {
            if own.is_none() {
                *value = Known::Unknown;
            }
        }
    }
    if own.iter().all(Option::is_some) {
        return values;
    }
    // and an interrupt's own moves lead them there before any other move
    let led_by: Vec<(&[u32], Vec<Known>)> = (program.interrupts.iter())
        .map(|of| (&*of.moves, led_to(own, &of.moves, count)))
        .collect();
    // what is open becomes known, and what is known unknown: this ends
    let mut changed = true;
    while changed {
        changed = false;
        for (at, motion) in program.moves.iter().enumerate() {
            let is_own = |of: &[u32]| of.binary_search(&short(at)).is_ok();
            for k in 0..count {
                let here = at * count + k;
                if own[here].is_some() {
                    continue;
                }
                let by_here = added[here].unwrap_or(0.0);
                let mut value = Known::Open;
                for (_, to) in led_by.iter().filter(|(of, _)| !is_own(of)) {
                    value = value.and(to[k].plus(by_here));
                }
                match stood_with_axes(program, at) {
                    Some(stood) => {
                        value = value.and(values[stood * count + k].plus(by_here));
                    }
                    None => {
                        for before in program.before(motion) {
                            let from = from_of(program, &values, before, (k, count));
                            let by = match before {
                                // both add to the same place
                                Before::One(before) if added[here].is_some() => {
                                    added[*before as usize * count + k]
                                }
                                _ => None,
                            };
                            value = value.and(from.plus(by_here - by.unwrap_or(0.0)));
                        }
                    }
                }
                if values[here] != values[here].and(value) {
                    values[here] = values[here].and(value);
                    changed = true;
                }
            }
        }
    }
    values
}

/// The move behind which a move has the external axes stand as they stood there: it goes back to a
/// position that was read with them.
fn stood_with_axes(program: &Program, motion: usize) -> Option<usize> {
    let stands_as = program.stands_as(short(motion)) as usize;
    let instruction = program.moves[motion].instruction;
    let stay = || program.axes_stay.binary_search(&instruction).is_ok();
    (stands_as != motion && !stay()).then_some(stands_as)
}

/// From where each axis comes to its value at each move.
pub(super) fn directed(
    program: &Program,
    profile: &Profile,
    values: &[Known],
    count: usize,
) -> Vec<CameFrom> {
    let mut directions = vec![CameFrom::Open; values.len()];
    if !has_backlash(&profile.effects, None) {
        return directions;
    }
    let widths: Vec<f64> = (0..count)
        .map(|axis| width(&profile.effects, axis))
        .collect();
    let mut changed = true;
    while changed {
        changed = false;
        for (at, motion) in program.moves.iter().enumerate() {
            for k in 0..count {
                let here = at * count + k;
                let mut direction = CameFrom::Open;
                for before in program.before(motion) {
                    let moved = match before {
                        Before::One(before) => directions[*before as usize * count + k],
                        _ => CameFrom::Unknown,
                    };
                    let from = from_of(program, values, before, (k, count));
                    direction = direction.and(moved.then(from, values[here], widths[k]));
                }
                if directions[here] != directions[here].and(direction) {
                    directions[here] = directions[here].and(direction);
                    changed = true;
                }
            }
        }
    }
    directions
}

/// The value of an axis where a move begins behind another one.
fn from_of(
    program: &Program,
    values: &[Known],
    before: &Before,
    (axis, count): (usize, usize),
) -> Known {
    match before {
        Before::One(before) => values[*before as usize * count + axis],
        Before::Start => match program.stands_at_start.get(axis) {
            Some(Some(start)) => Known::Is(*start),
            _ => Known::Unknown,
        },
        Before::Anywhere | Before::Several(_) | Before::AnyOf { .. } => Known::Unknown,
    }
}

/// Where moves lead each axis; open where none of them does.
fn led_to(own: &[Option<f64>], moves: &[u32], count: usize) -> Vec<Known> {
    let mut all = vec![Known::Open; count];
    for motion in moves {
        let at = *motion as usize * count;
        for (known, own) in all.iter_mut().zip(&own[at..at + count]) {
            *known = match own {
                None => *known,
                Some(value) if value.is_finite() => known.and(Known::Is(*value)),
                Some(_) => Known::Unknown,
            };
        }
    }
    all
}

/// By how much an axis stands elsewhere when it comes from the other side, metres or radians.
pub(super) fn width(effects: &[Effect], axis: usize) -> f64 {
    let of_axis = effects.iter().filter(|effect| {
        effect.definition().needs_external_directions() && effect.site.index == axis
    });
    of_axis.map(|effect| effect.parameters[0].abs()).sum()
}

/// Whether an axis, or any, stands elsewhere when it comes from the other side.
pub(super) fn has_backlash(effects: &[Effect], axis: Option<usize>) -> bool {
    effects.iter().any(|effect| {
        effect.definition().needs_external_directions()
            && !effect.is_zero()
            && axis.is_none_or(|axis| axis == effect.site.index)
    })
}

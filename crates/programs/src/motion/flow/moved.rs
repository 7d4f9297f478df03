//! What displaces a target that is displaced again: behind branches, in loops, by several writes.
//!
//! Where each write adds its step once, the place is known. A write that is come to again adds its
//! step as often as the loops around it count, or any number of times.

use super::{Flow, State};
use crate::geometry::Pose;
use crate::motion::holding::{Atom, Site};
use crate::program::script::{
    DISPLACED_SOMEHOW, DisplacementId, How, NOT_DISPLACED, OVERWRITTEN, Statement, TURNED,
    UNBOUNDED, short,
};
use crate::program::{Displacement, Shift, Stride};
use foldhash::{HashMap, HashMapExt};
use std::rc::Rc;

/// Steps one after another whose sum is one place; beyond, each of them may be made or not.
const MOST_EXACT: usize = 24;
/// Steps that may be made or not.
const MOST_STEPS: usize = 4;
/// The step of a move itself, which nothing keeps.
pub(in crate::motion) const OF_MOVE: Site = Site::MAX - 1;
/// Any number of times.
const ENDLESS: u32 = 0;

/// What a write adds to a copy of a target.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
struct Added {
    site: Site,
    by: DisplacementId,
    /// How often at most; [`ENDLESS`].
    most: u32,
    /// The loop around it has begun again since.
    is_before: bool,
}

/// How a displacement came to be.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
enum Moved {
    /// By these steps, each once.
    Exactly(Box<[Added]>),
    /// By some of them.
    Within(Box<[Added]>),
    /// By what only the running program knows, added there.
    Somehow(Site),
}

/// Displacements of the flow's own, behind those of the script.
#[derive(Debug)]
pub(in crate::motion) struct Displacements {
    all: Vec<(Moved, Displacement)>,
    known: HashMap<Moved, DisplacementId>,
}

impl Displacements {
    pub(super) fn new() -> Self {
        Self {
            all: Vec::new(),
            known: HashMap::new(),
        }
    }
}

impl Flow<'_> {
    /// What a displacement is.
    pub(in crate::motion) fn displacement(&self, id: DisplacementId) -> &Displacement {
        let script = &self.script.displacements;
        match (id as usize).checked_sub(script.len()) {
            Some(own) => &self.displacements.all[own].1,
            None => &script[id as usize],
        }
    }

    /// Whether writes made a displacement, one after another.
    pub(in crate::motion) fn is_made(&self, id: DisplacementId) -> bool {
        id as usize >= self.script.displacements.len()
    }

    /// What displaces a target that is displaced already and then `by` something else at a place. A
    /// part that is known and one that is not are two: either is a displacement of its own.
    pub(in crate::motion) fn displaced_again(
        &mut self,
        before: DisplacementId,
        by: DisplacementId,
        site: Site,
    ) -> Vec<DisplacementId> {
        for absorbing in [OVERWRITTEN, UNBOUNDED] {
            if before == absorbing || by == absorbing {
                return vec![absorbing];
            }
        }
        if by == NOT_DISPLACED {
            return vec![before];
        }
        let old = match (before as usize).checked_sub(self.script.displacements.len()) {
            Some(own) => Some(self.displacements.all[own].0.clone()),
            None if before == NOT_DISPLACED => None,
            None if before == DISPLACED_SOMEHOW => Some(Moved::Somehow(OF_MOVE)),
            None => Some(Moved::Exactly(Box::new([once(before, OF_MOVE)]))),
        };
        if by == DISPLACED_SOMEHOW {
            return match old {
                Some(Moved::Somehow(of)) if of == site && site != OF_MOVE => vec![UNBOUNDED],
                Some(Moved::Somehow(of)) if of == site => vec![before],
                old => {
                    let somehow = self.moved(Moved::Somehow(site));
                    let before = old.map(|_| before);
                    before.into_iter().chain([somehow]).collect()
                }
            };
        }
        let added = once(by, site);
        let (steps, is_exact) = match old {
            None => (Vec::new(), true),
            Some(Moved::Somehow(_)) => {
                let known = self.moved(Moved::Exactly(Box::new([added])));
                return vec![before, known];
            }
            Some(Moved::Exactly(steps)) => (steps.to_vec(), true),
            Some(Moved::Within(steps)) => (steps.to_vec(), false),
        };
        vec![self.with_step(steps, added, is_exact)]
    }

    /// The steps of a displacement, and whether all of them are made.
    fn steps_of(&self, id: DisplacementId) -> Option<(Vec<Added>, bool)> {
        let Some(own) = (id as usize).checked_sub(self.script.displacements.len()) else {
            return match self.displacement(id) {
                Displacement::None => Some((Vec::new(), true)),
                Displacement::By(_) | Displacement::Within(_) | Displacement::AtLeast(_) => {
                    Some((vec![once(id, OF_MOVE)], true))
                }
                _ => None,
            };
        };
        match &self.displacements.all[own].0 {
            Moved::Exactly(steps) => Some((steps.to_vec(), true)),
            Moved::Within(steps) => Some((steps.to_vec(), false)),
            Moved::Somehow(_) => None,
        }
    }

    /// Whether a displacement is one place.
    fn is_one_place(&self, id: DisplacementId) -> bool {
        matches!(
            self.displacement(id),
            Displacement::None | Displacement::By(_)
        )
    }

    /// What displaces a target that is displaced already, and then along one axis as a copy of the
    /// target is that something else displaces, and `by` something more.
    pub(super) fn replaced(
        &mut self,
        (before, of): (DisplacementId, DisplacementId),
        (axis, by): (usize, DisplacementId),
        site: Site,
    ) -> Vec<DisplacementId> {
        if of != NOT_DISPLACED && of == before && self.is_one_place(of) {
            return self.displaced_again(before, by, site);
        }
        vec![self.replaced_along((before, of), (axis, by), site)]
    }

    fn replaced_along(
        &mut self,
        (before, of): (DisplacementId, DisplacementId),
        (axis, by): (usize, DisplacementId),
        site: Site,
    ) -> DisplacementId {
        let is_none = match self.displacement(by) {
            Displacement::None => true,
            Displacement::By(shift) => **shift == Shift::none(),
            _ => false,
        };
        if before == NOT_DISPLACED && of == NOT_DISPLACED {
            return match by {
                _ if is_none => NOT_DISPLACED,
                DISPLACED_SOMEHOW => DISPLACED_SOMEHOW,
                _ => self.moved(Moved::Exactly(Box::new([once(by, site)]))),
            };
        }
        let (Some((mut steps, of_before)), Some((along, of_other))) =
            (self.steps_of(before), self.steps_of(of))
        else {
            return UNBOUNDED;
        };
        let is_exact = of_before && of_other;
        let axes_of = |flow: &Self, id| match flow.displacement(id) {
            Displacement::By(shift) => axes(shift),
            Displacement::Within(of) | Displacement::AtLeast(of) => {
                of.iter().try_fold([false; 3], |all, stride| match stride {
                    Stride::By { shift, .. } | Stride::Read { shift, .. } => {
                        let axes = axes(shift)?;
                        Some([0, 1, 2].map(|axis| all[axis] || axes[axis]))
                    }
                    Stride::Turned(_) => None,
                })
            }
            _ => None,
        };
        let is_along = |axes: [bool; 3]| (0..3).all(|other| other == axis || !axes[other]);
        if !is_none && !axes_of(self, by).is_some_and(is_along) {
            return UNBOUNDED;
        }
        // of what was added along the axis nothing is left, and of the other one that alone is taken
        let mut is_mixed = false;
        let mut is_of_axis = |flow: &Self, step: &Added| {
            let of = axes_of(flow, step.by).unwrap_or([true; 3]);
            is_mixed |= of[axis] && !is_along(of);
            of[axis]
        };
        steps.retain(|step| !is_of_axis(self, step));
        steps.extend(along.into_iter().filter(|step| is_of_axis(self, step)));
        if is_mixed {
            return UNBOUNDED;
        }
        if !is_none {
            steps.push(once(by, site));
        }
        if steps.is_empty() {
            NOT_DISPLACED
        } else if (is_exact || steps.len() == 1) && steps.len() <= MOST_EXACT {
            self.moved(Moved::Exactly(steps.into()))
        } else {
            self.some_of(steps)
        }
    }

    /// Whether parts of a position are written, or what only the running program knows.
    pub(super) fn is_part_written(&self, id: DisplacementId) -> bool {
        let script = self.script;
        let Some(own) = (id as usize).checked_sub(script.displacements.len()) else {
            return matches!(id, DISPLACED_SOMEHOW | OVERWRITTEN | UNBOUNDED | TURNED);
        };
        let is_part = |step: &Added| match script.statements.get(step.site as usize) {
            Some(Statement::Write(at)) => !matches!(script.writes[*at as usize].how, How::Whole(_)),
            _ => false,
        };
        match &self.displacements.all[own].0 {
            Moved::Somehow(_) => true,
            Moved::Exactly(steps) | Moved::Within(steps) => steps.iter().any(is_part),
        }
    }

    fn with_step(&mut self, mut steps: Vec<Added>, added: Added, is_exact: bool) -> DisplacementId {
        // one place may displace by several things, one after another
        let is_again =
            |step: &Added| step.site == added.site && step.by == added.by && added.site != OF_MOVE;
        let known = steps.iter().position(is_again);
        if is_exact && known.is_none() && steps.len() < MOST_EXACT {
            steps.push(added);
            return self.moved(Moved::Exactly(steps.into()));
        }
        match known {
            Some(at) => {
                let most = self.most_at(added.site);
                let before = steps[at];
                steps[at].most = match (before.most, most) {
                    (ENDLESS, _) | (_, ENDLESS) => ENDLESS,
                    // those that the loop made before add up with those that it makes now
                    _ if before.is_before => ENDLESS,
                    (before, most) => before.max(most),
                };
                steps[at].is_before = false;
            }
            None => steps.push(added),
        }
        self.some_of(steps)
    }

    /// A displacement by some of these steps.
    fn some_of(&mut self, mut steps: Vec<Added>) -> DisplacementId {
        let in_tool = |shift: &Shift| shift.in_tool != Pose::identity();
        let turns = |step: &&Added| match self.displacement(step.by) {
            Displacement::By(shift) => in_tool(shift),
            Displacement::Within(of) | Displacement::AtLeast(of) => {
                of.iter().any(|stride| match stride {
                    Stride::By { shift, .. } | Stride::Read { shift, .. } => in_tool(shift),
                    Stride::Turned(_) => true,
                })
            }
            _ => true,
        };
        // where the tool turns first is another place
        let turning = steps.iter().filter(turns).count();
        if steps.len() > MOST_STEPS || turning > 1 {
            return UNBOUNDED;
        }
        steps.sort_unstable();
        self.moved(Moved::Within(steps.into()))
    }

    fn moved(&mut self, moved: Moved) -> DisplacementId {
        if let Some(&known) = self.displacements.known.get(&moved) {
            return known;
        }
        let displacement = self.meaning(&moved);
        let all = &mut self.displacements.all;
        all.push((moved.clone(), displacement));
        let id = short(self.script.displacements.len() + all.len() - 1);
        self.displacements.known.insert(moved, id);
        id
    }

    fn meaning(&self, moved: &Moved) -> Displacement {
        let steps = match moved {
            Moved::Somehow(_) => return Displacement::Unknown,
            Moved::Exactly(steps) | Moved::Within(steps) => steps,
        };
        let is_exact = matches!(moved, Moved::Exactly(_));
        let mut is_least = false;
        let mut sum = Some(Shift::none()).filter(|_| is_exact);
        let mut strides = Vec::with_capacity(steps.len());
        for step in steps {
            match self.displacement(step.by) {
                Displacement::By(shift) => {
                    sum = sum.map(|sum| sum.then(shift));
                    strides.push(Stride::By {
                        shift: **shift,
                        most: (step.most != ENDLESS).then_some(step.most),
                    });
                }
                Displacement::AtLeast(_) if step.most != 1 => return Displacement::Unbounded,
                by @ (Displacement::Within(of) | Displacement::AtLeast(of)) => {
                    sum = None;
                    is_least |= matches!(by, Displacement::AtLeast(_));
                    let once = step.most == 1;
                    let is_read = |stride: &Stride| matches!(stride, Stride::Read { .. });
                    if !once && of.iter().any(is_read) {
                        return Displacement::Unbounded;
                    }
                    strides.extend(of.iter().map(|stride| match stride {
                        Stride::Turned(_) if !once => Stride::Turned(None),
                        Stride::By { shift, .. } if !once => Stride::By {
                            shift: *shift,
                            most: None,
                        },
                        other => other.clone(),
                    }));
                }
                _ => return Displacement::Unbounded,
            }
        }
        match sum {
            Some(sum) => Displacement::By(Box::new(sum)),
            None if is_least => Displacement::AtLeast(strides.into()),
            None => Displacement::Within(strides.into()),
        }
    }

    /// How often at most a write is come to from where the loops around it begin.
    fn most_at(&self, site: Site) -> u32 {
        let mut around: Vec<_> = self.script.loops.iter().collect();
        around.retain(|of| of.statements.contains(&site));
        // what begins last is inside
        around.sort_by_key(|of| std::cmp::Reverse(of.statements.start));
        let mut product = ENDLESS;
        for of in around {
            let Some(most) = of.most else {
                return ENDLESS;
            };
            product = product.max(1).saturating_mul(most.max(1));
            if of.is_outer {
                break;
            }
        }
        product
    }

    /// A loop begins: steps that it made before are no longer counted.
    pub(super) fn begin_rounds(&mut self, number: u32, state: &mut State) {
        if self.displacements.all.is_empty() {
            return;
        }
        let of = self.script.loops[number as usize].statements.clone();
        for slot in 0..state.holds.len() {
            let held = state.holds[slot];
            let mut atoms = self.holdings.of(held).to_vec();
            let mut is_other = false;
            for (atom, _) in &mut atoms {
                if let Atom::Target { displacement, .. } = atom {
                    let before = self.made_before(*displacement, &of);
                    is_other |= before != *displacement;
                    *displacement = before;
                }
            }
            if is_other {
                let holding = self.holdings.intern(atoms);
                self.last_modes = None;
                Rc::make_mut(&mut state.holds)[slot] = holding;
            }
        }
    }

    /// A displacement whose steps at these places were made before the loop around them begins.
    fn made_before(&mut self, id: DisplacementId, of: &std::ops::Range<u32>) -> DisplacementId {
        let own = (id as usize).checked_sub(self.script.displacements.len());
        let Some(own) = own else {
            return id;
        };
        let mut moved = self.displacements.all[own].0.clone();
        let (Moved::Exactly(steps) | Moved::Within(steps)) = &mut moved else {
            return id;
        };
        let mut is_other = false;
        for step in steps.iter_mut().filter(|step| of.contains(&step.site)) {
            is_other |= !step.is_before && step.most != ENDLESS;
            step.is_before |= step.most != ENDLESS;
        }
        if is_other { self.moved(moved) } else { id }
    }
}

/// Along which axes of the work frame a shift goes; `None` where it turns, or goes along the tool's.
fn axes(shift: &Shift) -> Option<[bool; 3]> {
    let is_along = shift.in_tool == Pose::identity() && shift.in_frame.rotation.angle() == 0.0;
    is_along.then(|| shift.in_frame.translation.map(|part| part != 0.0))
}

fn once(by: DisplacementId, site: Site) -> Added {
    Added {
        site,
        by,
        most: 1,
        is_before: false,
    }
}

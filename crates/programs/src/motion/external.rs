//! Where external axes stand at each move, and what they carry then.
//!
//! ```text
//! values of targets and moves, offsets that are active, values that are kept from the move before → stand of each move
//! stand + work frame + profile → the poses that the arm is asked for, in the world of an arm that stands at home
//! ```
//!
//! A move with a stand gets a work frame of its own ([`Program::frames`]): what comes behind knows
//! frames only, and that a wanted pose of the real arm is another than the nominal one's.

use super::external_values::{CameFrom, Known, directed, followed, has_backlash, width};
use super::passed::{Arcs, Fakes};
use super::setting::{Given, Setting};
use crate::finding::{Finding, Severity};
use crate::geometry::Pose;
use crate::geometry::units::{DEG, m_from_mm, mm_from_m};
use crate::model::effects::Need;
use crate::model::external::{ExternalAxes, Follows, Listed};
use crate::profile::Profile;
use crate::program::script::short;
use crate::program::{
    ExternalNames, ExternalState, Frame, FrameId, Language, Move, Program, Settings, Shape, Source,
    Stand, TargetId,
};
use std::collections::{BTreeSet, HashMap};

/// How far beyond its limits a value may be: files round. Metres and radians.
const BORDER: f64 = 1e-6;
/// A rail's polynomial is believed beyond where it was measured by this part of that span.
const EXTRAPOLATED: f64 = 0.02;
/// What languages must know of a profile to read programs.
pub fn settings_of(profile: &Profile, accept_absolutely_accurate: bool) -> Settings {
    let external = &profile.external;
    let ignored = external.positioners.iter();
    let ignored = ignored.filter(|positioner| positioner.follows == Follows::Never);
    let ignored = ignored.flat_map(|positioner| &positioner.axes);
    let ignored = ignored.map(|axis| axis.axis.clone());
    Settings {
        world_from_base: (external.track.is_empty()).then(|| profile.world_from_foot()),
        world_from_base_at_home: (external.listed().next().is_some())
            .then_some(profile.world_from_base),
        gravity_m_s2: (profile.real_effects().iter())
            .any(|of| !of.is_zero() && of.definition().needs.contains(&Need::Masses))
            .then_some(profile.gravity_m_s2),
        pulses_per_deg: profile.pulses_per_deg,
        accept_absolutely_accurate,
        external: ExternalNames {
            carries_every_frame: (external.positioners.iter())
                .any(|positioner| positioner.follows == Follows::Always),
            listed: external
                .listed()
                .map(|axis| axis.name().to_owned())
                .collect(),
            linear: external.listed().map(|axis| axis.is_linear()).collect(),
            pulses: external
                .listed()
                .map(|axis| match axis {
                    Listed::Track(axis) => axis.pulses_per_mm,
                    Listed::Rotary(axis, ..) => axis.pulses_per_deg,
                })
                .collect(),
            ignored: external.other.iter().cloned().chain(ignored).collect(),
            units: (external.positioners.iter().enumerate())
                .map(|(at, positioner)| {
                    let first = external.first_of(at);
                    let axes = first..first + positioner.axes.len();
                    let axes = axes.fold(0, |bits, axis| bits | 1 << axis);
                    let carries = positioner.follows != Follows::Never;
                    (positioner.name.clone(), if carries { axes } else { 0 })
                })
                .collect(),
        },
    }
}

/// Gives moves the stand of external axes, which begin at `start` where that is said, and blocks targets of which it is not known, or beyond
/// limits: of the track, of what carries their work frames, and of the positioners next to the
/// profile, by index.
pub(crate) fn settle(
    (language, settings): (&dyn Language, &Settings),
    program: &mut Program,
    sources: &[Source],
    (profile, positioners): (&Profile, &[usize]),
    (given, start): (&Given, &[f64]),
    fakes: &Fakes,
    findings: &mut Vec<Finding>,
) -> BTreeSet<TargetId> {
    program.stands_at_start = start.iter().copied().map(Some).collect();
    let axes: Vec<Listed> = profile.external.listed().collect();
    if axes.is_empty() && !program.frames.iter().any(Frame::is_carried) {
        return BTreeSet::new();
    }
    let (own, added) = own_values(language, program, &axes);
    let mut values = followed(program, &own, &added, axes.len());
    let arcs = Arcs {
        language,
        settings,
        program,
        sources,
        profile,
        setting: Setting::of(language, program, profile, given),
        axes: &axes,
        fakes,
    };
    let ridden = arcs.pass(&own, &mut values, findings);
    let directions = directed(program, profile, &values, axes.len());
    let is = |known: &Known| match known {
        Known::Is(value) => Some(*value),
        _ => None,
    };
    program.stands = values.iter().map(is).collect();
    let own_of = |at: usize| {
        let first = profile.external.first_of(at);
        first..first + profile.external.positioners[at].axes.len()
    };
    let mut settler = Settler {
        program,
        sources,
        profile,
        findings,
        axes: &axes,
        looked_at: positioners.iter().flat_map(|at| own_of(*at)).collect(),
        backlash: (0..axes.len())
            .map(|k| has_backlash(&profile.effects, Some(k)))
            .collect(),
        widths: (0..axes.len())
            .map(|axis| width(&profile.effects, axis))
            .collect(),
        made: HashMap::new(),
        measured: measured(profile),
    };
    for motion in 0..settler.program.moves.len() {
        let at = motion * axes.len();
        let range = at..at + axes.len();
        settler.motion(motion, &values[range.clone()], &directions[range]);
    }
    ridden
}

/// What each move says itself of each axis, in metres and radians; `None` where it says nothing. Next
/// to it what it adds to a value that is kept.
fn own_values(
    language: &dyn Language,
    program: &Program,
    axes: &[Listed],
) -> (Vec<Option<f64>>, Vec<Option<f64>>) {
    let offset_of: Vec<Option<usize>> = axes
        .iter()
        .map(|axis| {
            let names = language.external_names();
            names
                .iter()
                .position(|name| name.eq_ignore_ascii_case(axis.name()))
        })
        .collect();
    let mut own = vec![None; program.moves.len() * axes.len()];
    let mut added = vec![None; own.len()];
    let each = own.chunks_mut(axes.len().max(1));
    for (at, (motion, slots)) in program.moves.iter().zip(each).enumerate() {
        let of_target = match motion.target {
            Some(target) => part_of(&program.externals, target),
            None if program.turned(motion).is_some() => &[],
            None if program.stands_as(short(at)) != short(at) => &[],
            None => {
                slots.fill(Some(f64::NAN));
                continue;
            }
        };
        let of_move = part_of(&program.externals_of_moves, motion.instruction);
        let stay = program.axes_stay.binary_search(&motion.instruction).is_ok();
        for (_, external) in of_target.iter().filter(|_| !stay) {
            slots[usize::from(external.axis)] = Some(external.value);
        }
        for (_, external) in of_move {
            slots[usize::from(external.axis)] = Some(external.value);
        }
        for (_, shift) in part_of(&program.external_shifts, motion.instruction) {
            let k = usize::from(shift.axis);
            match &mut slots[k] {
                Some(value) => *value += shift.value,
                kept => {
                    let by = in_si(&axes[k], shift.value);
                    added[at * axes.len() + k] = Some(by);
                    // an amount that nobody knows
                    *kept = by.is_nan().then_some(by);
                }
            }
        }
        let state = state_of(program, motion);
        for (k, ((slot, axis), name)) in slots.iter_mut().zip(axes).zip(&offset_of).enumerate() {
            let by = name.map_or(0.0, |at| state.offset[at]);
            if state.off & 1 << k != 0 {
                *slot = Some(f64::NAN);
            }
            *slot = slot.map(|value| in_si(axis, value + by));
        }
    }
    (own, added)
}

/// A value of an axis in metres or radians, from millimetres or degrees.
fn in_si(axis: &Listed, value: f64) -> f64 {
    if axis.is_linear() {
        m_from_mm(value)
    } else {
        value * DEG
    }
}

/// What the program does to external axes besides the target of a move.
fn state_of(program: &Program, motion: &Move) -> ExternalState {
    let at = (motion.external_state as usize).checked_sub(1);
    at.map_or_else(ExternalState::default, |at| program.external_states[at])
}

/// The entries of a key in a list that is sorted by it.
fn part_of<K: Ord + Copy, T>(list: &[(K, T)], key: K) -> &[(K, T)] {
    let first = list.partition_point(|(known, _)| *known < key);
    let count = list[first..].partition_point(|(known, _)| *known == key);
    &list[first..first + count]
}

/// Stands are the same where all their bits are.
type Key = (FrameId, Vec<u64>, [Vec<u64>; 2], Option<usize>, bool);

struct Settler<'a> {
    program: &'a mut Program,
    sources: &'a [Source],
    profile: &'a Profile,
    findings: &'a mut Vec<Finding>,
    axes: &'a [Listed<'a>],
    /// Rotary axes that matter at every move.
    looked_at: Vec<usize>,
    /// Axes that stand elsewhere when they come from the other side.
    backlash: Vec<bool>,
    /// By how much.
    widths: Vec<f64>,
    made: HashMap<Key, FrameId>,
    /// Between which places each axis of the track stood when it was measured, where the profile
    /// says so and it was not said yet that a move goes beyond.
    measured: Vec<Option<[f64; 2]>>,
}

/// Between which places the axes of the track stood when it was measured, metres: of those with
/// errors that are powers of the place.
fn measured(profile: &Profile) -> Vec<Option<[f64; 2]>> {
    let of = |k: usize| {
        let mut powers = profile.effects.iter();
        let is_bent = powers.any(|effect| {
            effect.definition().is_power() && effect.site.index == k && !effect.is_zero()
        });
        let span = profile.quality.as_ref()?.get("track_mm")?.get(k)?;
        let span = [span.get(0)?.as_f64()?, span.get(1)?.as_f64()?];
        is_bent.then(|| span.map(m_from_mm))
    };
    (0..profile.external.track.len()).map(of).collect()
}

impl Settler<'_> {
    fn motion(&mut self, at: usize, values: &[Known], directions: &[CameFrom]) {
        let motion = &self.program.moves[at];
        let Some(target) = motion.target else {
            return;
        };
        let of_joints = self.program.targets[target].layout.shape == Shape::Joints;
        if self.program.targets[target].blocked {
            return;
        }
        let from = motion.frame;
        let frame = &self.program.frames[from];
        let external = &self.profile.external;
        let positioner = match carrier(frame, external) {
            Ok(positioner) => positioner,
            Err(_) if of_joints => None,
            Err((id, why)) => {
                let hint = "describe it under `external_axes` of the profile (positioners: name, \
                    axes with at, limits; see docs/external-axes.md)";
                return self.block(at, id, &why, hint);
            }
        };
        let first = positioner.map_or(0, |positioner| external.first_of(positioner));
        let count = positioner.map_or(0, |positioner| external.positioners[positioner].axes.len());
        let matters = |k: usize| {
            let carries = (first..first + count).contains(&k);
            k < external.track.len() || carries || self.looked_at.contains(&k)
        };
        let mut stand = vec![f64::NAN; values.len()];
        for (k, known) in values.iter().enumerate().filter(|(k, _)| matters(*k)) {
            let axis = &self.axes[k];
            let unit = if axis.is_linear() { "mm" } else { "deg" };
            let shown = |value: f64| {
                let value = if axis.is_linear() {
                    mm_from_m(value)
                } else {
                    value / DEG
                };
                (value * 1e6).round() / 1e6
            };
            let Known::Is(value) = known else {
                let (mut why, hint) = self.unknown_value(at, k);
                let severity = if self.looked_at.contains(&k) {
                    why += "; it carries bodies of the cell";
                    Severity::Error
                } else {
                    self.severity_of(target)
                };
                return self.block_as(at, ("external-value-unknown", severity), &why, hint);
            };
            let (low, high) = axis.limits();
            if *value < low - BORDER || *value > high + BORDER {
                let why = format!(
                    "external axis {} goes to {} {unit}; its limits are {} and {} {unit}",
                    axis.name(),
                    shown(*value),
                    shown(low),
                    shown(high)
                );
                let hint =
                    "correct the program, or the limits under `external_axes` of the profile";
                return self.block(at, "external-axis-limit", &why, hint);
            }
            stand[k] = *value;
        }
        for (k, value) in stand.iter().enumerate() {
            self.tell_extrapolated(at, k, *value);
        }
        for (k, direction) in directions.iter().enumerate() {
            if self.backlash[k] && *direction == CameFrom::Unknown {
                self.tell_direction(at, k);
            }
        }
        if stand.iter().all(|value| value.is_nan()) && !of_joints && positioner.is_none() {
            return;
        }
        let from_both = |both: f64| -> Vec<f64> {
            let of = |(direction, has_backlash): (&CameFrom, &bool)| match direction {
                CameFrom::Going(direction) if *has_backlash => *direction,
                CameFrom::FromBoth if *has_backlash => both,
                _ => 0.0,
            };
            directions.iter().zip(&self.backlash).map(of).collect()
        };
        // joints do not depend on the frame but for what carries the work piece
        let of = if of_joints { FrameId::MAX } else { from };
        let sides = [from_both(1.0), from_both(-1.0)];
        let bits = |numbers: &[f64]| numbers.iter().map(|x| x.to_bits()).collect::<Vec<u64>>();
        let key = (
            of,
            bits(&stand),
            sides.each_ref().map(|of| bits(of)),
            positioner,
            of_joints,
        );
        let frames = &mut self.program.frames;
        let made = *self.made.entry(key).or_insert_with(|| {
            let mut own = frames[from].clone();
            if of_joints {
                own.world_from_frame = Some(Pose::identity());
            }
            let mut other = None;
            let is_one = sides[0] == sides[1];
            for directions in sides.into_iter().rev().skip(usize::from(is_one)) {
                own.stand = Some(Stand {
                    values: stand.as_slice().into(),
                    directions: directions.into(),
                    positioner,
                    on_base: own.rides_on_base(),
                    of_joints,
                    from_other_side: other,
                });
                frames.push(own.clone());
                other = Some(frames.len() - 1);
            }
            frames.len() - 1
        });
        self.program.moves[at].frame = made;
    }

    /// A polynomial says nothing beyond the places that it was found from.
    fn tell_extrapolated(&mut self, at: usize, axis: usize, value: f64) {
        let Some([low, high]) = self.measured.get(axis).copied().flatten() else {
            return;
        };
        let room = EXTRAPOLATED * (high - low);
        // not of an axis that does not matter: it has no number
        if !(value < low - room || value > high + room) {
            return;
        }
        self.measured[axis] = None;
        let [value, low, high] = [value, low, high].map(|m| (mm_from_m(m) * 1e3).round() / 1e3);
        let message = format!(
            "external axis {} goes to {value} mm; its rail was measured from {low} to {high} mm, \
             and powers say nothing beyond",
            self.axes[axis].name()
        );
        let hint = "measure the rail as far as programs use it";
        let motion = &self.program.moves[at];
        let source = &self.sources[motion.file as usize];
        let (id, severity) = ("track-extrapolated", Severity::Warning);
        let finding = source.finding(motion.offset as usize, id, severity, message, hint);
        self.findings.push(finding);
    }

    /// Why nobody knows where an axis stands, and the way out.
    fn unknown_value(&self, at: usize, axis: usize) -> (String, &'static str) {
        let name = self.axes[axis].name();
        let state = state_of(self.program, &self.program.moves[at]);
        let since = state.since.filter(|_| state.off & 1 << axis != 0);
        let Some((file, offset)) = since else {
            let mut why = format!("nothing says where external axis {name} stands at this move");
            if let Some(call) = self.program.call_before(at) {
                why += &format!(": `{call}` before it may move it");
            } else if let Some(of) = self.program.interrupts.first() {
                why += &format!(": `{}`, which may run before it, may move it", of.name);
            }
            let hint = "write its value into the target, or into one that is certainly before it; \
                --with gives files of routines";
            return (why, hint);
        };
        let source = &self.sources[file as usize];
        let (line, _) = source.line_column(offset as usize);
        let why = format!(
            "external axis {name} does not follow targets since line {line} of {}, and nothing \
             says where it stands",
            source.name
        );
        let hint = "let it go with the targets from the start, or again before the move (ActUnit of \
            RAPID, $ACT_EX_AX of KRL; where asynchronous motions leave it is not followed); what \
            carries nothing a pose depends on stands in `other:` under `external_axes` of the \
            profile";
        (why, hint)
    }

    /// Nobody knows from which side an axis with backlash comes.
    fn tell_direction(&mut self, at: usize, axis: usize) {
        let motion = &self.program.moves[at];
        let message = format!(
            "nothing says from which side external axis {} with backlash comes here, or it turns \
             back by less than that: it is taken to stand in the middle, and the tool may be {:.3} \
             mm off",
            self.axes[axis].name(),
            mm_from_m(0.5 * self.widths[axis])
        );
        let hint = "come to the target on a move that is certainly before it, from another value, \
            farther away than its backlash";
        let source = &self.sources[motion.file as usize];
        let (id, severity) = ("direction-uncertain", Severity::Warning);
        let finding = source.finding(motion.offset as usize, id, severity, message, hint);
        self.findings.push(finding);
    }

    /// A joint target that stays as it is does no harm.
    fn severity_of(&self, target: usize) -> Severity {
        match self.program.targets[target].layout.shape {
            Shape::Pose => Severity::Error,
            Shape::Joints => Severity::Warning,
        }
    }

    /// The target of a move has to stay as it is.
    fn block(&mut self, at: usize, id: &'static str, why: &str, hint: &str) {
        let target = self.program.moves[at].target;
        let severity = self.severity_of(target.expect("moves without a target have no stand"));
        self.block_as(at, (id, severity), why, hint);
    }

    fn block_as(
        &mut self,
        at: usize,
        (id, severity): (&'static str, Severity),
        why: &str,
        hint: &str,
    ) {
        let motion: &Move = &self.program.moves[at];
        let target = motion.target.expect("moves without a target have no stand");
        let found = &mut self.program.targets[target];
        found.blocked = true;
        let name = found.name.as_deref().unwrap_or("target");
        let message = format!("{name}: {why}");
        let source = &self.sources[motion.file as usize];
        let finding = source.finding(motion.offset as usize, id, severity, message, hint);
        self.findings.push(finding);
    }
}

/// The positioner that carries a frame.
///
/// # Errors
/// The program says that a unit carries it, and the profile does not know the unit: the finding and
/// why.
pub(super) fn carrier(
    frame: &Frame,
    external: &ExternalAxes,
) -> Result<Option<usize>, (&'static str, String)> {
    let of = |wanted: Follows| {
        let mut all = external.positioners.iter();
        all.position(|positioner| positioner.follows == wanted)
    };
    let Some(name) = frame.on.first().filter(|_| frame.is_carried()) else {
        // what rides on the base rides on nothing else
        return Ok(of(Follows::Always).filter(|_| frame.on.is_empty()));
    };
    let is_named = |named: &str| frame.on.iter().any(|name| name.eq_ignore_ascii_case(named));
    let found = external.positioners.iter().position(|p| is_named(&p.name));
    match found {
        Some(at) if external.positioners[at].follows == Follows::Never => Err((
            "positioner-unknown",
            format!(
                "the unit `{name}` carries the work frame, and the profile says `follows: never` \
                 of it"
            ),
        )),
        Some(at) => Ok(Some(at)),
        None if external.track.iter().any(|axis| is_named(&axis.axis)) => Err((
            "external-chain",
            format!("the unit `{name}`, which carries the base, carries the work frame too"),
        )),
        None => Err((
            "positioner-unknown",
            format!(
                "the unit `{name}` carries the work frame, and the profile does not describe it"
            ),
        )),
    }
}

//! Why one set of numbers does not serve all approaches of a target, for the message that says so.

use super::Job;
use super::approach::{Approach, SAME_RAD, Solved};
use super::rewrite::ROUNDING_LIMIT;
use crate::geometry::Separation;
use crate::geometry::units::{DEG, mm_from_m};
use crate::motion::walk::NOWHERE;
use crate::program::script::Place;
use crate::program::{Move, Stand};
use foldhash::HashSet;

/// What sets the tool or the work frame of a move, and the name of that.
type Set<'a> = dyn Fn(&Move) -> (Option<Place>, &'a str) + 'a;

/// Approaches that a message names.
const MOST_NAMED: usize = 6;

/// In what the approaches of a target differ.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Differing {
    tool: bool,
    load: bool,
    frame: bool,
    external: bool,
    external_side: bool,
    posture: bool,
    arc: bool,
    side: bool,
}

impl Differing {
    fn of(job: &Job, group: &[Solved]) -> Self {
        let ground = &job.ground;
        let setting = &ground.setting;
        let first = group[0].approach;
        let others = || group.iter().map(|solved| solved.approach);
        let load = others().any(|other| mass_kg(job, other) != mass_kg(job, first));
        let same_tool =
            |other: &Approach| setting.same_tool(first.tool as usize, other.tool as usize);
        let same_frame =
            |other: &Approach| setting.same_frame(first.frame as usize, other.frame as usize);
        let has_backlash = ground.arm_with(first.tool as usize).has_backlash;
        Self {
            // what differs in the load alone is another load
            tool: others()
                .any(|other| !same_tool(other) && (!load || is_elsewhere(job, first, other))),
            load,
            frame: others().any(|other| !same_frame(other) && !is_moved(job, first, other)),
            external: others().any(|other| {
                let other_side = is_from_other_side(job, first, other);
                !same_frame(other) && is_moved(job, first, other) && !other_side
            }),
            external_side: others().any(|other| is_from_other_side(job, first, other)),
            posture: others().any(|other| {
                let moved = |i: usize| (other.nominal_q[i] - first.nominal_q[i]).abs() > SAME_RAD;
                let alike = same_tool(other) && same_frame(other);
                other.branch != first.branch || (alike && (0..6).any(moved))
            }),
            arc: others().any(|other| other.middle != first.middle),
            side: others().any(|other| {
                (0..6).any(|i| has_backlash[i] && other.direction[i] != first.direction[i])
            }),
        }
    }

    /// `tool, load and posture`
    fn names(self) -> String {
        let all = [
            (self.tool, "tool"),
            (self.load, "load"),
            (self.frame, "work frame"),
            (self.external, "where external axes stand"),
            (self.external_side, "side from which an external axis comes"),
            (self.posture, "posture"),
            (self.arc, "rotation on an arc"),
            (self.side, "side from which a joint comes"),
        ];
        let names: Vec<&str> = all.iter().filter(|of| of.0).map(|of| of.1).collect();
        match names.as_slice() {
            // the rest of what distinguishes approaches
            [] => "whether configuration data count".into(),
            [one] => (*one).into(),
            [some @ .., last] => format!("{} and {last}", some.join(", ")),
        }
    }
}

fn mass_kg(job: &Job, approach: &Approach) -> Option<f64> {
    let tool = job.ground.setting.tools[approach.tool as usize].as_ref();
    tool.and_then(|tool| tool.load).map(|(mass_kg, _)| mass_kg)
}

/// Whether two approaches have one work frame, with external axes that stand elsewhere.
fn is_moved(job: &Job, a: &Approach, b: &Approach) -> bool {
    let [a, b] = [a, b].map(|of| &job.ground.program.frames[of.frame as usize]);
    a.name == b.name && a.stand.is_some() && a.stand != b.stand
}

/// Whether external axes stand at the same values, and come there from other sides.
fn is_from_other_side(job: &Job, a: &Approach, b: &Approach) -> bool {
    let stand = |of: &Approach| job.ground.stand_in(of.frame as usize);
    match (stand(a), stand(b)) {
        (Some(a), Some(b)) => {
            let bits = |of: &Stand| of.values.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
            a.directions != b.directions && bits(a) == bits(b)
        }
        _ => false,
    }
}

/// Whether two approaches have the tool elsewhere on the flange.
fn is_elsewhere(job: &Job, a: &Approach, b: &Approach) -> bool {
    let tool = |of: &Approach| job.ground.setting.tools[of.tool as usize].as_ref();
    match (tool(a), tool(b)) {
        (Some(a), Some(b)) => a.flange_from_tool != b.flange_from_tool,
        _ => true,
    }
}

/// How large a miss is, in the largest that rounding may leave.
fn size(miss: &Separation) -> f64 {
    (miss.distance_m / ROUNDING_LIMIT.distance_m).max(miss.angle_rad / ROUNDING_LIMIT.angle_rad)
}

/// In what the approaches of a target differ, and what each misses.
pub(super) fn message(job: &Job, group: &[Solved], misses: &[Separation]) -> String {
    let differing = Differing::of(job, group);
    let each = group.iter().zip(misses);
    let mut each: Vec<(String, &Separation)> = each
        .map(|(solved, miss)| (one(job, solved.approach, group, miss, differing), miss))
        .collect();
    let mut named = HashSet::default();
    each.retain(|(one, _)| named.insert(one.clone()));
    let more = each.len().saturating_sub(MOST_NAMED);
    if more > 0 {
        each.sort_by(|(_, a), (_, b)| size(b).total_cmp(&size(a)));
        each.truncate(MOST_NAMED);
    }
    let mut each: Vec<String> = each.into_iter().map(|(one, _)| one).collect();
    if more > 0 {
        each.push(format!("and {more} more, by less"));
    }
    format!(
        "the robot comes to {} by {} approaches that differ in {}, and one fake target cannot serve \
         all; with the best common numbers each would miss by: {}",
        job.ground.name_of(group[0].approach.target as usize),
        group.len(),
        differing.names(),
        each.join("; ")
    )
}

/// One approach, by what distinguishes it from the others.
fn one(
    job: &Job,
    approach: &Approach,
    group: &[Solved],
    miss: &Separation,
    differing: Differing,
) -> String {
    let ground = &job.ground;
    let by = format!(
        "{:.3} mm, {:.3} deg",
        mm_from_m(miss.distance_m),
        miss.angle_rad / DEG
    );
    if approach.motion == NOWHERE {
        return by;
    }
    let motion = &ground.program.moves[approach.motion as usize];
    let file = &ground.sources[motion.file as usize].name;
    let mut text = format!("{file} line {}", ground.line_of(motion));
    let tool = |of: &Move| (of.tool_written, ground.program.tools[of.tool].name.as_str());
    let frame = |of: &Move| {
        (
            of.frame_written,
            ground.program.frames[of.frame].name.as_str(),
        )
    };
    let (tool, frame): (&Set, &Set) = (&tool, &frame);
    let written = [
        (differing.tool, "tool", tool),
        (differing.frame, "work frame", frame),
    ];
    for (_, what, set) in written.into_iter().filter(|(differs, ..)| *differs) {
        let (Some(place), name) = set(motion) else {
            continue;
        };
        // one statement may set each of several
        let mut others = group.iter().map(|solved| solved.approach.motion);
        let is_one = others.all(|other| {
            let moves = &ground.program.moves;
            moves.get(other as usize).is_none_or(|other| {
                let (at, of) = set(other);
                at != Some(place) || of == name
            })
        });
        let name = if is_one {
            String::new()
        } else {
            format!(" `{name}`")
        };
        let source = &ground.sources[place.file as usize];
        let (line, _) = source.line_column(place.offset as usize);
        text += &format!(" with the {what}{name} of line {line}");
        if place.file != motion.file {
            text += &format!(" of {}", source.name);
        }
    }
    if differing.load {
        text += &match mass_kg(job, approach) {
            Some(mass_kg) => format!(" with a load of {mass_kg} kg"),
            None => " without a load".into(),
        };
    }
    let stand = ground.stand_in(approach.frame as usize);
    if let Some(stand) = stand.filter(|_| differing.external_side) {
        let listed = ground.profile.external.listed();
        let sides = listed.zip(&stand.directions).filter_map(|(axis, side)| {
            let sign = if *side > 0.0 { '+' } else { '-' };
            (*side != 0.0).then(|| format!("{sign}{}", axis.name()))
        });
        let sides: Vec<String> = sides.collect();
        text += &format!(" with external axes moving {}", sides.join(" "));
    }
    if differing.posture {
        let joints = approach.nominal_q.map(|q| format!("{:.1}", q / DEG));
        text += &format!(" at joints {} deg", joints.join(", "));
    }
    if differing.arc {
        text += match approach.middle {
            Some(_) => " in the middle of an arc",
            None => " where it stops or passes a corner",
        };
    }
    if differing.side {
        let has_backlash = ground.arm_with(approach.tool as usize).has_backlash;
        let sides = (0..6).filter(|i| has_backlash[*i]).map(|i| {
            let side = match approach.direction[i] {
                1.. => "+",
                0 => "?",
                _ => "-",
            };
            format!("{side}J{}", i + 1)
        });
        text += &format!(
            " with joints moving {}",
            sides.collect::<Vec<_>>().join(" ")
        );
    }
    format!("{text}: {by}")
}

//! Units that cannot be meant: tools of tenths of a millimetre, masses that no robot of this kind
//! carries; tools that profile and program call otherwise; models that give no finite pose.

use super::ground::Ground;
use crate::finding::{Finding, Severity};
use crate::geometry::units::{DEG, MM, mm_from_m};
use crate::geometry::{Pose, Vector};
use crate::model::Conditions;
use crate::model::effects::{Effect, Kind, Need, same_tool};
use crate::nearest;
use crate::profile::{Mounted, Profile, ToolOfProfile, is_tiny};
use crate::program::Move;
use std::f64::consts::TAU;

/// The way out where a number is not finite.
pub(crate) const OUT_OF_BOUNDS: &str = "look for a number out of all bounds in the effects, masses \
    and frames of the profile and in the tool";

/// No arm carries more, kg.
const MOST_LOAD_KG: f64 = 1e4;
/// Places in the range of a joint at which what a kilogram does is looked at.
const PLACES: usize = 5;
/// A shift by less is not worth a word, mm.
const VISIBLE_MM: f64 = 0.01;
/// Tools of program and profile that are nearer are one: files round.
const SAME_TOOL_M: f64 = 0.02 * MM;
const SAME_TOOL_RAD: f64 = 0.02 * DEG;
/// No tool, work frame or target is farther away, metres.
pub(super) const FARTHEST_M: f64 = 1e3;

/// A tool, load or work frame that no arm can have.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{file}:{line}: {what} is {value:e} {unit}; the limit is {limit} {unit}")]
pub struct OutOfBounds {
    /// The file of the first move that has it.
    pub file: String,
    /// The line of the move.
    pub line: usize,
    /// What it is.
    pub what: String,
    /// Its size.
    pub value: f64,
    /// The most that is taken.
    pub limit: f64,
    /// The unit of both.
    pub unit: &'static str,
}

/// The largest coordinate of a point; infinite where one is no number.
pub(super) fn farthest(point: &Vector) -> f64 {
    let sizes = point
        .iter()
        .map(|m| if m.is_nan() { f64::INFINITY } else { m.abs() });
    sizes.fold(0.0, f64::max)
}

/// Refuses tools, loads and work frames of moves that no arm can have: nothing is bounded with them.
///
/// # Errors
/// The first of them.
pub(crate) fn bounds(ground: &Ground) -> Result<(), OutOfBounds> {
    let mut seen = vec![false; ground.program.tools.len()];
    let mut seen_frames = vec![false; ground.program.frames.len()];
    for motion in &ground.program.moves {
        let beyond = |what: String, value: f64, limit: f64, unit: &'static str| {
            // also what is no number
            if value <= limit {
                return Ok(());
            }
            Err(OutOfBounds {
                file: ground.sources[motion.file as usize].name.clone(),
                line: ground.line_of(motion),
                what,
                value,
                limit: (limit * 1e3).round() / 1e3,
                unit,
            })
        };
        let far = |what: String, point: &Vector, most_m: f64| {
            beyond(what, mm_from_m(farthest(point)), mm_from_m(most_m), "mm")
        };
        if let Some(near) = ground.program.near(motion) {
            for (i, (q, joint)) in near
                .iter()
                .zip(&ground.profile.mechanism.joints)
                .enumerate()
            {
                let most = joint.min_rad.abs().max(joint.max_rad.abs()) + TAU;
                let what = format!("joint {} near which this move goes to its target", i + 1);
                beyond(what, (q / DEG).abs(), most / DEG, "deg")?;
            }
        }
        if !std::mem::replace(&mut seen[motion.tool], true)
            && let Some(tool) = &ground.setting.tools[motion.tool]
        {
            let name = &ground.program.tools[motion.tool].name;
            far(
                format!("the distance of tool `{name}` from the flange"),
                &tool.flange_from_tool.translation,
                FARTHEST_M,
            )?;
            if let Some((mass_kg, cog_m)) = tool.load {
                beyond(
                    format!("the load of tool `{name}`"),
                    mass_kg,
                    MOST_LOAD_KG,
                    "kg",
                )?;
                let farthest_m = ground.profile.farthest_cog_m();
                far(
                    format!("the centre of gravity of tool `{name}`"),
                    &cog_m,
                    farthest_m,
                )?;
                let effects = ground.profile.real_effects();
                let effects = effects
                    .iter()
                    .filter(|effect| effect.site.is_of_tool(&tool.name));
                let added = effects.filter_map(|effect| {
                    let number = effect.definition().search.mass?;
                    Some(effect.parameters[number])
                });
                let missing = -(mass_kg + added.sum::<f64>());
                beyond(
                    format!(
                        "what the profile's effects take from the load of tool `{name}` more than it has"
                    ),
                    missing,
                    0.0,
                    "kg",
                )?;
            }
        }
        if !std::mem::replace(&mut seen_frames[motion.frame], true)
            && let Some(frame) = &ground.setting.frames[motion.frame]
        {
            let name = &ground.program.frames[motion.frame].name;
            far(
                format!("the distance of work frame `{name}`"),
                &frame.nominal.translation,
                FARTHEST_M,
            )?;
        }
    }
    Ok(())
}

/// Checks the units of the tools that moves have, each at the first move that has it.
pub(crate) fn units(ground: &Ground, severity: Severity, findings: &mut Vec<Finding>) {
    let mut seen = vec![false; ground.program.tools.len()];
    let sags = sags(ground.profile);
    for motion in &ground.program.moves {
        if std::mem::replace(&mut seen[motion.tool], true) {
            continue;
        }
        let Some(tool) = &ground.setting.tools[motion.tool] else {
            continue;
        };
        let name = &ground.program.tools[motion.tool].name;
        let named = if name.is_empty() {
            "the tool of this move".into()
        } else {
            format!("tool `{name}`")
        };
        let in_text = &ground.program.tools[motion.tool];
        let in_metres = in_text.flange_from_tool.is_some() && ground.language.is_in_metres();
        let on_flange = Some((tool.flange_from_tool.translation, "the flange"));
        let on_tool = in_text
            .on_tool
            .map(|off| (off, "the tool that it stands on"));
        let tiny = on_flange.filter(|(off, _)| is_tiny(off));
        if let Some((off, from)) = tiny.or(on_tool.filter(|(off, _)| is_tiny(off))) {
            let message = format!(
                "{named} is {} mm from {from} at most in each coordinate; below 1 mm {}",
                largest_mm(&off),
                if in_metres {
                    "mostly no tool is meant: the language is in metres"
                } else {
                    "metres are taken for millimetres"
                }
            );
            // what a controller of metres was taught on the bare flange is as small
            let severity = if in_metres {
                Severity::Warning
            } else {
                severity
            };
            findings.push(ground.at_move(
                "tool-unit",
                severity,
                motion,
                message,
                "write it in the unit of the language (mm; metres in URScript), or 0 for the \
                 flange itself",
            ));
        }
        if in_text.load.is_some()
            && sags
            && let Some((mass_kg, cog_m)) = tool.load
            && mass_kg > 0.0
            && is_tiny(&cog_m)
        {
            findings.push(ground.at_move(
                "load-unit",
                Severity::Warning,
                motion,
                format!(
                    "the centre of gravity of {named} is {} mm from the flange at most in each \
                     coordinate; below 1 mm metres are taken for millimetres, or the load was never \
                     measured",
                    largest_mm(&cog_m)
                ),
                "write it in the unit of the language (mm; metres in URScript), as the controller's \
                 identification of loads gives it",
            ));
        }
        let (payload, load) = (ground.profile.payload_kg, tool.load);
        if let (Some(payload), Some((mass_kg, _))) = (payload, load)
            && let Some(load) = beyond_payload(ground.profile, &tool.name, mass_kg, payload)
        {
            findings.push(ground.at_move(
                "load-beyond-payload",
                severity,
                motion,
                format!(
                    "the load of {named} is {load}; robot.payload_kg of the profile is \
                    {payload} kg"
                ),
                "masses are in kg; correct the load, or robot.payload_kg",
            ));
        }
    }
}

/// A load beyond the payload in words: by itself, or with what effects of the profile add to it
/// without a reason for that.
fn beyond_payload(profile: &Profile, tool: &str, mass_kg: f64, payload: f64) -> Option<String> {
    let reasons = &profile.large;
    let is_reasoned = |effect: &Effect| {
        let all = [&reasons.controller, &reasons.calibration];
        all.iter().any(|of| of.contains_key(&effect.label()))
    };
    let mut effects = profile.real_effects();
    effects.retain(|effect| effect.site.is_of_tool(tool) && !is_reasoned(effect));
    let added = effects
        .iter()
        .filter_map(|effect| Some(effect.parameters[effect.definition().search.mass?]));
    let added = added.sum::<f64>().max(0.0);
    if mass_kg > payload {
        Some(format!("{mass_kg} kg"))
    } else if mass_kg + added > payload {
        Some(format!(
            "{mass_kg} kg, and {added} kg more by effects of the profile"
        ))
    } else {
        None
    }
}

/// What the profile says of tools by name, and that no move gets: masses of other names, each at
/// the first move whose tool has none, and effects of names that neither a move nor a tool of the
/// profile has.
pub(crate) fn names(ground: &Ground, findings: &mut Vec<Finding>) {
    let (profile, program) = (ground.profile, ground.program);
    let mut used: Vec<(&str, &Move)> = Vec::new();
    let mut seen = vec![false; program.tools.len()];
    for motion in &program.moves {
        let Some(tool) = &ground.setting.tools[motion.tool] else {
            continue;
        };
        if std::mem::replace(&mut seen[motion.tool], true) {
            continue;
        }
        // as effects see it: the command line may give the profile's tool for it
        used.push((&tool.name, motion));
        findings.extend(other_frame(ground, tool, motion));
        if tool.load.is_none() {
            findings.extend(unknown_load(
                ground,
                &program.tools[motion.tool].name,
                motion,
            ));
        }
    }
    let Some((_, first)) = used.first() else {
        return;
    };
    for effect in &profile.effects {
        let Some(name) = effect.site.tool.as_deref() else {
            continue;
        };
        let of_kind = |other: &&Effect| other.kind == effect.kind;
        let alike: Vec<&Effect> = profile.effects.iter().filter(of_kind).collect();
        let lacks = |(used, _): &(&str, &Move)| alike.iter().all(|e| !e.site.is_of_tool(used));
        let is_used = used.iter().any(|(used, _)| same_tool(used, name));
        if effect.is_zero() || !used.iter().any(lacks) {
            continue;
        }
        let known = profile.tool(name);
        let at_its_place = |(_, motion): &&(&str, &Move)| {
            let own = ground.setting.tools[motion.tool].as_ref();
            let own = own.zip(known.as_ref());
            own.is_some_and(|(own, known)| is_same_place(own, known))
        };
        let unnamed = used.iter().filter(|of| lacks(of)).find(at_its_place);
        if (is_used || known.is_some()) && unnamed.is_none() {
            continue;
        }
        let names = used
            .iter()
            .map(|(name, _)| *name)
            .filter(|name| !name.is_empty());
        let names: Vec<&str> = names.collect();
        let id = effect.definition().id;
        if let Some((other, motion)) = unnamed {
            let applies = if is_used {
                "does not apply to this move"
            } else {
                "applies to no move"
            };
            let message = format!(
                "`{id}` of tool `{name}` {applies}; `{other}` of the program has the place of \
                 `{name}` on the flange, and another name"
            );
            let hint =
                format!("call the tool `{name}` in the program, or `{other}` in the profile");
            findings.push(ground.at_move(
                "effect-unused",
                Severity::Warning,
                motion,
                message,
                &hint,
            ));
            continue;
        }
        let message = format!(
            "`{id}` of tool `{name}` applies to no move, and the profile has no tool of this name"
        );
        let mut hint = nearest::hint(name, "tools of the program", names);
        hint.push_str("; correct `tool` of the effect, or leave `tool` out for every tool");
        findings.push(ground.at_move("effect-unused", Severity::Warning, first, message, &hint));
    }
}

/// Whether two tools are one, but for what files round.
fn is_same_place(a: &Mounted, b: &Mounted) -> bool {
    let gap = a.flange_from_tool.separation(&b.flange_from_tool);
    gap.distance_m <= SAME_TOOL_M && gap.angle_rad <= SAME_TOOL_RAD
}

/// That a program has a tool elsewhere on the flange than the profile does, whose `tool_frame` says how
/// far it really is from there.
fn other_frame(ground: &Ground, tool: &Mounted, motion: &Move) -> Option<Finding> {
    let profile = ground.profile;
    let known = profile.tool(&tool.name)?;
    let mut own = profile.effects.iter();
    let own = own.find(|effect| {
        let site = &effect.site;
        effect.kind == Kind::ToolFrame
            && !effect.is_zero()
            && site.tool.is_some()
            && site.is_of_tool(&tool.name)
    })?;
    if is_same_place(tool, &known) {
        return None;
    }
    let known = known.flange_from_tool;
    let gap = known.separation(&tool.flange_from_tool);
    let at = |pose: &Pose| pose.translation.map(|m| (mm_from_m(m) * 1e3).round() / 1e3);
    let [x, y, z] = at(&tool.flange_from_tool);
    let [of_x, of_y, of_z] = at(&known);
    let message = format!(
        "the program has tool `{}` at ({x}, {y}, {z}) mm on the flange, the profile at ({of_x}, \
         {of_y}, {of_z}) mm, {:.3} mm and {:.3} deg from there; `{}` of the profile counts from the \
         profile's: it would count from another place, or twice",
        tool.name,
        mm_from_m(gap.distance_m),
        gap.angle_rad / DEG,
        own.definition().id
    );
    let hint = "write the tool into the profile as the program has it, and calibrate with it; where \
        the program has it as it was measured, take the effect out of the profile";
    Some(ground.at_move("tool-differs", Severity::Error, motion, message, hint))
}

/// Whether masses move the arm.
fn sags(profile: &Profile) -> bool {
    let bends = |effect: &Effect| !effect.is_zero() && effect.definition().needs_masses();
    profile.real_effects().iter().any(bends)
}

/// The largest coordinate of a point, to a millionth.
fn largest_mm(point_m: &Vector) -> f64 {
    (mm_from_m(farthest(point_m)) * 1e6).round() / 1e6
}

/// A tool counts as weightless although nobody said so, and the arm bends under what it carries.
fn unknown_load(ground: &Ground, name: &str, motion: &Move) -> Option<Finding> {
    let profile = ground.profile;
    // who names it in the profile and gives no mass means none
    if !sags(profile) || profile.tool(name).is_some() {
        return None;
    }
    let heavy = |(_, tool): &(&String, &ToolOfProfile)| tool.load.is_some_and(|(kg, _)| kg > 0.0);
    let heavy = profile.tools.iter().filter(heavy);
    let heavy: Vec<&str> = heavy.map(|(name, _)| name.as_str()).collect();
    let tool = ground.setting.tools[motion.tool].as_ref()?;
    let of_a_kg_mm = of_a_kg_mm(ground, tool);
    if heavy.is_empty() && of_a_kg_mm * profile.payload_kg.unwrap_or(1.0) < VISIBLE_MM {
        return None;
    }
    let named = if name.is_empty() {
        "the tool of this move".into()
    } else {
        format!("tool `{name}`")
    };
    let mut message = format!(
        "neither the program files nor the profile give the mass of {named}: it counts as 0 kg, and \
         each kg moves the tool by up to {of_a_kg_mm:.3} mm"
    );
    let hint = if heavy.is_empty() {
        let name = if name.is_empty() { "NAME" } else { name };
        format!(
            "give it in the profile under this name: poseshift profile add-tool PROFILE \
             '{name}=X,Y,Z,RX,RY,RZ,KG' --in-place (KG 0 where it carries nothing)"
        )
    } else {
        message.push_str("; the profile has the masses of: ");
        message.push_str(&heavy.join(", "));
        "call the tool in the profile as the program does (docs/formats.md has the name in each \
         language)"
            .into()
    };
    let (id, severity) = ("load-unknown", Severity::Warning);
    Some(ground.at_move(id, severity, motion, message, &hint))
}

/// By how much one kilogram at the tool's centre point moves it at most, over the ranges of the
/// joints by which gravity has a lever.
fn of_a_kg_mm(ground: &Ground, tool: &Mounted) -> f64 {
    let conditions = Conditions::default();
    let with = |kg: f64| {
        let load = Some((kg, tool.flange_from_tool.translation));
        let tool = Mounted {
            load,
            ..tool.clone()
        };
        ground.profile.real_model(&tool, &conditions)
    };
    let [loaded, free] = [with(1.0), with(0.0)];
    let mut most = 0.0_f64;
    for number in 0..PLACES.pow(3) {
        let mut q = middle(ground);
        for (i, place) in [
            (1, number),
            (2, number / PLACES),
            (4, number / PLACES.pow(2)),
        ] {
            let joint = &ground.profile.mechanism.joints[i];
            let part = (place % PLACES) as f64 / (PLACES - 1) as f64;
            q[i] = joint.min_rad + part * (joint.max_rad - joint.min_rad);
        }
        let [a, b] = [&loaded, &free].map(|arm| arm.forward(&q, &conditions));
        most = most.max(a.separation(&b).distance_m);
    }
    mm_from_m(most)
}

/// Joints about in the middle of their ranges, and aligned with nothing.
fn middle(ground: &Ground) -> [f64; 6] {
    std::array::from_fn(|i| {
        let joint = &ground.profile.mechanism.joints[i];
        0.4 * joint.min_rad + 0.6 * joint.max_rad
    })
}

/// Tools with which the arm's models give no finite pose, each at the first move that has it.
pub(crate) fn models(ground: &Ground, findings: &mut Vec<Finding>) {
    let mut reported = vec![false; ground.arms.len()];
    for motion in &ground.program.moves {
        let Some(equipped) = ground.equipped(motion.tool) else {
            continue;
        };
        if std::mem::replace(&mut reported[motion.tool], true) {
            continue;
        }
        let q = middle(ground);
        let conditions = &equipped.inverse.conditions;
        let models = [
            ("real arm", equipped.inverse.real.forward(&q, conditions)),
            (
                "controller",
                equipped.controller.forward(&q, &Conditions::default()),
            ),
        ];
        for (name, _) in models.iter().filter(|(_, pose)| !pose.is_finite()) {
            let tool = &ground.program.tools[motion.tool].name;
            findings.push(ground.at_move(
                "not-finite",
                Severity::Error,
                motion,
                format!(
                    "the model of the {name} with tool `{tool}` gives a pose that is not \
                    finite"
                ),
                OUT_OF_BOUNDS,
            ));
        }
    }
}

/// Time in which a robot is warm, seconds: a year.
const WARM_S: f64 = 3e7;
/// By how much a workshop may be warmer than where an arm was measured, kelvin.
const WARMER_K: f64 = 10.0;
/// A move behind which a joint may not have come to rest, radians.
const MOVED_RAD: f64 = 30.0 * DEG;

/// Effects of the profile that programs give nothing to compute with: time, temperature, whether the
/// robot rests. They count as zero, and what that may be off is at least said.
pub(crate) fn left_out(ground: &Ground, findings: &mut Vec<Finding>) {
    let Some(motion) = ground
        .program
        .moves
        .iter()
        .find(|motion| ground.equipped(motion.tool).is_some())
    else {
        return;
    };
    for effect in ground.profile.real_effects() {
        let (because, conditions) = match left_out_for(&effect) {
            Some(found) if !effect.is_zero() => found,
            _ => continue,
        };
        let alone = Profile {
            effects: vec![effect.clone()],
            ..ground.profile.clone()
        };
        let tool = &ground.setting.tools[motion.tool];
        let Some(tool) = tool.as_ref() else { continue };
        let q = middle(ground);
        let at =
            |conditions: &Conditions| alone.real_model(tool, conditions).forward(&q, conditions);
        let by_m = at(&conditions)
            .separation(&at(&Conditions::default()))
            .distance_m;
        let of_joint = effect.site.index < 6 && !effect.definition().site.is_empty();
        let on = if of_joint {
            format!(" of joint {}", effect.site.index + 1)
        } else {
            String::new()
        };
        let message = format!(
            "`{}`{on} of the profile counts for nothing: {because} the tool is elsewhere, by {:.3} mm \
             in the middle of the joints' ranges",
            effect.definition().id,
            mm_from_m(by_m)
        );
        let hint = "run the program on a robot that is as it was when nothing of this acted, or calibrate \
            it as it is at work, without this effect";
        let (id, severity) = ("effect-left-out", Severity::Warning);
        findings.push(ground.at_move(id, severity, motion, message, hint));
    }
}

/// Whether programs say what an effect is computed with.
pub(crate) fn counts(effect: &Effect) -> bool {
    left_out_for(effect).is_none()
}

/// Why an effect counts as zero in a program, and conditions under which it does not.
fn left_out_for(effect: &Effect) -> Option<(String, Conditions)> {
    let plain = Conditions::default();
    effect.definition().needs.iter().find_map(|need| match need {
        Need::Time => Some((
            "a program has no clock, so the robot is taken as cold; once it is warm".to_owned(),
            Conditions { time_s: Some(WARM_S), ..plain },
        )),
        Need::Temperature => {
            let reference_c = effect.parameters[1];
            Some((
                format!(
                    "a program has no thermometer, so the arm is taken as it is at {reference_c} °C; with \
                     {WARMER_K} °C more"
                ),
                Conditions { temperature_c: Some(reference_c + WARMER_K), ..plain },
            ))
        }
        Need::Moves => Some((
            "the robot is taken to rest; right behind moves of 30 degrees".to_owned(),
            Conditions { moved: [MOVED_RAD; 6], ..plain },
        )),
        _ => None,
    })
}

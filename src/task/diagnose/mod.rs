//! `diagnose`: where model and measurement disagree, and which effect is missing.

mod effects;
mod plates;
mod rows;

pub use effects::{Against, ChangedEffect, Effect, Evidence, FoundEffect};
pub use plates::PositionerDiagnosis;
pub(super) use plates::of_the_arm;
pub use rows::{
    Alternative, Compared, Group, HeldOut, ImpossibleGroup, LeverageRow, OutlierRow, Spot,
    TellingPose, Unexplained, Unregistered, Untested,
};

use super::clock::{self, Answer, Doubted, any_timed};
use super::drift::Drift;
use super::failure::Failure;
use super::measurements::{Rows, identify_failure};
use super::parts::{SpreadMm, WorstRow, findings, finite};
use super::profile_file::ProfileFile;
use super::{Document, PROGRAM};
use crate::diagnose::judgement::accepted::NotTaken;
use crate::diagnose::plates::diagnose_plates;
use crate::diagnose::search::stand_ins::{Impossible, StandIn};
use crate::diagnose::{
    self as engine, Diagnosis as Found, NoiseSource, Options, Verdict, diagnose as search,
};
use crate::finding::{Finding, Severity};
use crate::geometry::units::{DEG, mm_from_m};
use crate::identify::measurements::Measurements;
use crate::identify::parameters::Subject;
use crate::identify::pick::Pick;
use crate::identify::validation::{Refit, validate};
use crate::model::effects::{Need, SiteKey};
use crate::model::profile::Profile;
use plates::{left_out, of_arm};
use schemars::JsonSchema;
use serde::Serialize;
use serde_json::{Map, Value, json};

/// What a diagnosis found.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Diagnosis {
    /// `explained`, `improved`, `nothing_missing` or `undetermined`.
    pub verdict: &'static str,
    /// Why, one sentence each.
    pub reasons: Vec<String>,
    /// The errors run by run, where the files are runs: the rows are those since the last change.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub drift: Option<Drift>,
    /// Rows looked at.
    pub rows: usize,
    /// Effects, those first without which most is lost.
    pub effects: Vec<FoundEffect>,
    /// What was found of each positioner whose plate the measurements have points on.
    pub positioners: Vec<PositionerDiagnosis>,
    /// Where the disagreement lies, strongest first.
    #[serde(rename = "where")]
    pub spots: Vec<Spot>,
    /// Effects that explain the data nearly as well.
    pub alternatives: Vec<Alternative>,
    /// What would compete if its values were possible.
    pub impossible: Vec<ImpossibleGroup>,
    /// Effects of one kind that compete with several of those found.
    pub alternative_groups: Vec<Group>,
    /// Functions outside the registry that explain more.
    pub unregistered: Vec<Unregistered>,
    /// Configurations that would separate alternatives.
    pub telling_poses: Vec<TellingPose>,
    /// Effects that cannot be tested.
    pub cannot_test: Vec<Untested>,
    /// What was fitted along with them and is no finding.
    pub absorbed: Vec<&'static str>,
    /// Effects of the profile that were fitted along and are not what they were, the clearest first.
    pub changed: Vec<ChangedEffect>,
    /// Errors on rows not used.
    pub held_out: HeldOut,
    /// The residual that remains.
    pub unexplained: Unexplained,
    /// What `--accept` takes to make this model again.
    pub accept: String,
    /// Noise of a coordinate.
    pub noise_mm: Option<f64>,
    /// Where that comes from: `sigma_mm`, `repeats` or `residuals`.
    pub noise_source: &'static str,
    /// The residual of a coordinate.
    pub left_mm: Option<f64>,
    /// The row with the largest residual.
    pub worst_row: Option<WorstRow>,
    /// Rows that fit no model.
    pub outliers: Vec<OutlierRow>,
    /// Rows that decide parameters alone.
    pub leverage: Vec<LeverageRow>,
    /// What a person should look at.
    pub findings: Vec<Finding>,
    /// SHA-256 of the profile.
    pub profile_sha256: String,
    /// SHA-256 of each file of measurements.
    pub measurements_sha256: Vec<String>,
    /// The profile written.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub output: Option<String>,
    /// The configurations written.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub poses: Option<String>,
    /// The rows, models and effects behind the numbers, which the page draws.
    #[serde(skip)]
    pub found: Found,
    /// Line of each row.
    #[serde(skip)]
    pub lines: Vec<usize>,
    /// How the files of measurements are named.
    #[serde(skip)]
    pub name: String,
}

impl Document for Diagnosis {
    const KIND: &'static str = "diagnosis/1";
}

/// What a person wants is in the model, or it is said what is missing.
fn check_accepted(found: &Found, pick: &Pick) -> Result<(), Failure> {
    let Some(kind) = pick.kind else {
        return Ok(());
    };
    let definition = kind.definition();
    if found.found.iter().any(|one| pick.means(&one.effect)) {
        return Ok(());
    }
    if let Some(untested) = found.cannot_test.iter().find(|one| one.kind == kind) {
        return Err(Failure::with_hint(
            format!(
                "--accept {}: it cannot be tested: needs {}",
                definition.id, untested.missing
            ),
            "measure with it, or leave the effect out of --accept",
        ));
    }
    let counted = definition.site.iter().filter(|p| p.numbers().is_some());
    let not_given = counted.count().saturating_sub(pick.places.len());
    if not_given > 0 && !pick.together {
        let given = pick.places.iter().map(|(first, _)| format!(":{first}"));
        let word = definition.id.to_owned() + &given.collect::<String>();
        let missing = if definition.site.contains(&SiteKey::Order) {
            "no order is given, and none shows in these measurements"
        } else {
            "which one is not given, and none shows in these measurements"
        };
        return Err(Failure::with_hint(
            format!("--accept {word}: {missing}"),
            format!("name one: {word}{}", ":1".repeat(not_given)),
        ));
    }
    Ok(())
}

/// An effect that a person wants and that is not in the model.
fn not_taken(one: &NotTaken, name: &str) -> Finding {
    let message = format!("--accept {}: not in the model: {}", one.word, one.why);
    let finding = Finding::of_file("accepted-not-in-model", Severity::Warning, name, message);
    finding.hint("measure rows that show it, or leave it out of --accept")
}

/// Whether a profile says that it was calibrated with other measurements than these.
fn is_new(file: &ProfileFile, sha256: &[String]) -> bool {
    let provenance = file.profile.provenance.as_ref();
    let used = provenance.and_then(|own| own.get("measurements_sha256")?.as_array());
    used.is_some_and(|used| {
        !used
            .iter()
            .any(|one| sha256.iter().any(|own| *one == **own))
    })
}

/// What is accepted is not rejected, too.
fn refuse_both(accept: &[Pick], reject: &[Pick]) -> Result<(), Failure> {
    let is_within = |accepted: &Pick, rejected: &Pick| {
        let (places, wider) = (&accepted.places, &rejected.places);
        accepted.kind.is_some()
            && !accepted.together
            && (rejected.key.is_none() || rejected.key == accepted.key)
            && accepted.kind == rejected.kind
            && wider.len() <= places.len()
            && wider
                .iter()
                .zip(places)
                .all(|(all, own)| all.0 <= own.0 && own.1 <= all.1)
    };
    let mut both = accept
        .iter()
        .filter(|own| reject.iter().any(|other| is_within(own, other)));
    match both.next().and_then(|own| own.kind) {
        None => Ok(()),
        Some(kind) => Err(Failure::with_hint(
            format!("--accept and --reject both hold `{}`", kind.definition().id),
            "leave one of the two out, or name its joint: `--accept backlash:3 --reject \
             backlash:2`",
        )),
    }
}

/// That a clock begins late, where that matters: the profile counts with it and the rows say that it
/// does not count from switching the robot on, or something changes from row to row, which may be
/// warm-up.
fn late_clock(profile: &Profile, rows: &Measurements, d: &Found, name: &str) -> Option<Finding> {
    let doubted = Doubted::of(rows)?;
    let missed = |rows: &Measurements| validate(profile, rows, Refit::Judged, None).ok();
    let is_timed = any_timed(profile.effects.iter().map(|effect| &effect.kind));
    let both = is_timed.then(|| missed(rows).zip(missed(&doubted.from_first)));
    let answer = both.flatten().map_or(Answer::Open, |(by_it, from_first)| {
        let missed = (&by_it.real.misses, &from_first.real.misses);
        clock::judged(&by_it.measurements, &by_it.problem, missed.0, missed.1)
    });
    let is_in_order = |f: &engine::Found| f.effect.definition().needs.contains(&Need::NoTime);
    let is_doubtful = match answer {
        Answer::Wrong { .. } => true,
        Answer::Open => d.found.iter().any(is_in_order),
        Answer::Right => false,
    };
    is_doubtful.then(|| doubted.finding(name, &answer))
}

/// Searches for the effects that a profile lacks; `hear` is called with what is being done.
///
/// # Errors
/// Measurements that contradict the robot or themselves, or are too few; effects that a person wants
/// and these measurements cannot show.
pub fn diagnose(
    file: &ProfileFile,
    measurements: Rows,
    options: &Options,
    hear: &mut dyn FnMut(&str),
) -> Result<Diagnosis, Failure> {
    let Rows {
        all,
        name,
        sha256,
        findings: mut read,
        ..
    } = measurements;
    refuse_both(&options.accept, &options.reject)?;
    let (tool, plates) = of_the_arm(all, &name)?;
    let of_arm = Options {
        is_new: is_new(file, &sha256),
        ..of_arm(options)
    };
    let d = search(&file.profile, &tool, &of_arm, hear)
        .map_err(|error| identify_failure(&name, &error))?;
    for pick in &of_arm.accept {
        check_accepted(&d, pick)?;
    }
    read.extend(late_clock(&file.profile, &tool, &d, &name));
    let positioners = if plates.rows.is_empty() {
        Vec::new()
    } else {
        hear("looking at the plates of positioners");
        diagnose_plates(&d, &plates, options).unwrap_or_else(|why| {
            read.push(left_out(&plates, &why, &name));
            Vec::new()
        })
    };
    let words = positioners.iter().flat_map(|of| &of.found);
    let words = words.map(|found| Pick::word(&found.effect));
    let own = (!d.found.is_empty()).then(|| d.accept());
    let accept: Vec<String> = own.into_iter().chain(words).collect();
    let label = |i: usize| d.found[i].effect.label();
    let labels = |which: &[usize]| which.iter().map(|i| label(*i)).collect::<Vec<_>>();
    let (before, after) = d.held_out.map_or((None, None), |(b, a)| (Some(b), Some(a)));
    Ok(Diagnosis {
        verdict: d.verdict.id(),
        reasons: d.reasons.clone(),
        drift: None,
        rows: d.problem.rows.len(),
        effects: d.found.iter().map(Into::into).collect(),
        spots: d.spots.iter().map(Into::into).collect(),
        alternatives: d
            .alternatives
            .iter()
            .map(|r: &engine::Alternative| Alternative {
                effect: (&r.effect).into(),
                instead_of: label(r.instead_of),
                chi_squared_fall: finite(r.gain),
                behind: finite(r.behind),
            })
            .collect(),
        impossible: d
            .impossible
            .iter()
            .map(|i: &Impossible| ImpossibleGroup {
                effects: i.effects.iter().map(Into::into).collect(),
                instead_of: labels(&i.instead_of),
                part: finite(i.part),
            })
            .collect(),
        alternative_groups: d
            .stand_ins
            .iter()
            .map(|s: &StandIn| Group {
                effects: s.effects.iter().map(Into::into).collect(),
                instead_of: labels(&s.instead_of),
                chi_squared_fall: finite(s.gain),
                part: finite(s.part),
                behind: finite(s.behind),
                left_mm: finite(mm_from_m(s.residual_m)),
            })
            .collect(),
        unregistered: d
            .unknown
            .iter()
            .map(|u| Unregistered {
                function: u.name.clone(),
                chi_squared_fall: finite(u.gain),
            })
            .collect(),
        telling_poses: d
            .telling
            .iter()
            .map(|t| TellingPose {
                joints_deg: t.q.map(|q| q / DEG),
                apart_mm: mm_from_m(t.apart_m),
                tells: [t.tells.0.clone(), t.tells.1.clone()],
            })
            .collect(),
        cannot_test: d
            .cannot_test
            .iter()
            .map(|c| Untested {
                effect: c.kind.definition().id,
                missing: c.missing.clone(),
            })
            .collect(),
        absorbed: absorbed(&d),
        changed: d.changed.iter().map(Into::into).collect(),
        held_out: HeldOut {
            before: before.map(Into::into),
            absorbed: d.absorbed_only.map(Into::into),
            after: after.map(Into::into),
            compared: d.judged.map(|c| Compared {
                before: c.start.into(),
                after: c.found.into(),
                refitted: c.refitted,
                p_value: finite(c.p_value),
            }),
        },
        unexplained: Unexplained {
            rms_mm: finite(mm_from_m(d.residual_m)),
            spots: d.residual_spots.iter().map(Into::into).collect(),
            function: d.unknown.first().map(|u| u.name.clone()),
        },
        positioners: positioners.iter().map(Into::into).collect(),
        accept: accept.join(","),
        noise_mm: finite(mm_from_m(d.noise_m)),
        noise_source: match d.noise_source {
            NoiseSource::Given => "sigma_mm",
            NoiseSource::Repeats => "repeats",
            NoiseSource::Residuals => "residuals",
        },
        left_mm: finite(mm_from_m(d.residual_m)),
        worst_row: WorstRow::of(&d.problem.rows, &tool, d.offs.iter().copied()),
        outliers: d
            .outliers
            .iter()
            .map(|o| OutlierRow {
                line: o.line.number,
                id: o.id.clone(),
                residual_mm: mm_from_m(o.off.length_m),
                residual_deg: o.off.angle_rad.map(|angle| angle / DEG),
                off: o.off.words(),
                times_noise: finite(o.times),
                file: (&o.line).into(),
            })
            .collect(),
        leverage: d
            .followed
            .iter()
            .map(|f| LeverageRow {
                line: f.line.number,
                id: f.id.clone(),
                leverage: finite(f.leverage),
                file: (&f.line).into(),
            })
            .collect(),
        findings: read
            .into_iter()
            .chain(findings(&d.remarks, &name))
            .chain(d.not_taken.iter().map(|one| not_taken(one, &name)))
            .collect(),
        profile_sha256: file.sha256.clone(),
        measurements_sha256: sha256,
        output: None,
        poses: None,
        lines: tool.rows.iter().map(|row| row.line.number).collect(),
        found: d,
        name,
    })
}

impl Diagnosis {
    /// Whether the answer is sure enough to be written: a verdict, or effects that a person asked
    /// for.
    #[must_use]
    pub fn is_sure(&self) -> bool {
        let found = &self.found.found;
        self.found.verdict != Verdict::Undetermined
            || !found.is_empty() && found.iter().all(|f| f.accepted)
    }

    /// Errors on rows not used, step by step from the present model to everything found; none
    /// without such rows.
    #[must_use]
    pub fn steps(&self) -> Vec<(String, SpreadMm)> {
        let (Some(before), Some(after)) = (self.held_out.before, self.held_out.after) else {
            return Vec::new();
        };
        let mut steps = vec![("present model".to_owned(), before)];
        let absorbed = self.held_out.absorbed.filter(|_| self.found.absorbed);
        steps.extend(absorbed.map(|s| ("frames, geometry fitted".to_owned(), s)));
        for f in &self.effects {
            steps.extend(f.after.map(|s| (format!("+ {}", f.effect.label), s)));
        }
        if self.effects.is_empty() {
            steps.push(("after".into(), after));
        }
        steps
    }

    /// The profile with the effects found, and where they come from.
    ///
    /// # Errors
    /// The profile's text is laid out so that the place of the calibration cannot be found.
    pub fn profile_text(&self, profile: &ProfileFile) -> Result<String, Failure> {
        let found = self.found.found.iter();
        let labels = found.clone().map(|f| f.effect.label());
        let standing: Map<String, Value> = found
            .map(|f| (f.effect.label(), json!(f.standing.id())))
            .collect();
        let mut improved = self.found.profile.clone();
        improved.quality = None;
        improved.provenance = Some(json!({
            "program": PROGRAM,
            "diagnosis": self.verdict,
            "found": labels.collect::<Vec<_>>(),
            "standing": standing,
            "profile_sha256": self.profile_sha256,
            "measurements_sha256": self.measurements_sha256,
            "rows": self.lines.len(),
        }));
        profile.rewritten(&improved)
    }

    /// The telling configurations as a table of joints; `None` of none.
    #[must_use]
    pub fn poses_csv(&self) -> Option<String> {
        let rows = self.telling_poses.iter().map(|telling| {
            let cells = telling.joints_deg.map(|q| format!("{q:.4}"));
            cells.join(",") + "\n"
        });
        let header = super::table::JOINTS.join(",") + "\n";
        (!self.telling_poses.is_empty()).then(|| header + &rows.collect::<String>())
    }
}

/// What was fitted along with them and is no finding.
fn absorbed(d: &Found) -> Vec<&'static str> {
    let mut all = Vec::new();
    if d.elsewhere || d.absorbed {
        all.push("base_frame");
    }
    if d.absorbed {
        all.extend(["tool_frame", "link_geometry"]);
        for parameter in &d.problem.parameters {
            if let Subject::Effect(slot) = parameter.subject {
                let id = d.estimate.effects[slot.effect].definition().id;
                if !all.contains(&id) {
                    all.push(id);
                }
            }
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::effects::Kind;

    #[test]
    fn what_is_accepted_is_not_rejected_too() {
        let backlash = |places: &[(u32, u32)]| Pick {
            kind: Some(Kind::Backlash),
            places: places.to_vec(),
            key: None,
            together: false,
        };
        let (all, third) = (backlash(&[]), backlash(&[(3, 3)]));
        let said = refuse_both(std::slice::from_ref(&third), std::slice::from_ref(&all));
        let message = said.expect_err("a contradiction").message;
        assert!(message.contains("both hold `backlash`"), "{message}");
        // all but one joint, another joint, and one of what a word means together
        let word = Pick {
            together: true,
            ..third.clone()
        };
        for (accept, reject) in [
            (&all, &third),
            (&third, &backlash(&[(2, 2)])),
            (&word, &all),
        ] {
            assert!(
                refuse_both(std::slice::from_ref(accept), std::slice::from_ref(reject)).is_ok()
            );
        }
    }
}

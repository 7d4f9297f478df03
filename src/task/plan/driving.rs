//! The path of a measuring program: which configurations the arm may stand in, in which order, and
//! what its moves meet.

use super::approach::Stop;
use crate::check::passage::Passage;
use crate::check::posture::touching;
use crate::check::{Options, Scene, Subject, check};
use crate::finding::{Finding, Severity};
use crate::geometry::units::{DEG, MM, mm_from_m};
use crate::identify::plan::{Breach, Constraints, Guard};
use crate::identify::route;
use crate::model::profile::{Mounted, Profile};
use crate::model::{Conditions, Model};
use crate::program::Source;
use crate::task::meshes::{Loader, Reader};
use crate::task::programs::language_by_id;
use crate::task::{Failure, ProfileFile};

/// Where moves are sampled, so far apart, radians.
const STEP_RAD: f64 = 2.0 * DEG;
/// The arm's bodies keep this apart on planned moves, metres: a program's angles are rounded.
const ROOM_M: f64 = 0.1 * MM;
/// The way out where moves meet something.
const BY_HAND: &str = "drive it by hand, over a pose between, or leave the configuration out";

/// The arm, its own shapes, and what it must keep to.
pub(super) struct Driving<'a> {
    profile: Profile,
    tool: &'a Mounted,
    scene: Scene,
    arm: Model,
    guard: Guard<'a>,
    constraints: &'a Constraints,
    /// `None` of an arm whose programs cannot be followed.
    passage: Option<Passage>,
}

impl<'a> Driving<'a> {
    /// Reads the meshes that the profile's shapes name.
    pub(super) fn new(
        file: &'a ProfileFile,
        tool: &'a Mounted,
        constraints: &'a Constraints,
        read: Reader,
    ) -> Result<Self, Failure> {
        let profile = &file.profile;
        let mut shaped = profile.clone();
        let mut meshes = Loader::new(read);
        for shape in &mut shaped.shapes {
            meshes.load(&mut shape.shape, &file.name)?;
        }
        let scene = Scene::new(&shaped, None, &meshes.meshes)
            .map_err(|error| Failure::new(error.to_string()))?;
        if let Some(found) = scene.findings.first() {
            let message = format!("{}: {}", found.file, found.message);
            return Err(Failure::with_hint(message, found.hint.clone()));
        }
        Ok(Self {
            arm: profile.real_model(tool, &Conditions::default()),
            guard: Guard::new(profile, tool, constraints),
            passage: Passage::new(&shaped, tool).ok(),
            profile: shaped,
            tool,
            scene,
            constraints,
        })
    }

    /// Whether the arm touches itself nowhere in this posture.
    fn stands(&self, q: &[f64; 6]) -> bool {
        touching(&self.scene, &self.arm, q).is_none()
    }

    /// Whether the arm comes to this configuration from where it is approached from, and does not
    /// touch itself on that path, wherever its base is.
    pub(super) fn admits(&self, q: &[f64; 6]) -> bool {
        self.stands(q) && self.is_clear(&self.approach(q), q)
    }

    /// Where a configuration is approached from.
    pub(super) fn approach(&self, q: &[f64; 6]) -> [f64; 6] {
        self.constraints.approach(&self.profile.mechanism, q)
    }

    /// Postures along a move of joints, coarse ones first.
    fn along(from: &[f64; 6], to: &[f64; 6]) -> impl Iterator<Item = [f64; 6]> {
        let far = from
            .iter()
            .zip(to)
            .map(|(a, b)| (a - b).abs())
            .fold(0.0, f64::max);
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "some turns in steps of degrees"
        )]
        let steps = (far / STEP_RAD).ceil().max(1.0) as usize;
        let (from, to) = (*from, *to);
        let coarse = (0..=steps).filter(|k| k % 8 == 4);
        let fine = (0..=steps).filter(|k| k % 8 != 4);
        coarse.chain(fine).map(move |k| {
            #[allow(clippy::cast_precision_loss)]
            let s = k as f64 / steps as f64;
            std::array::from_fn(|i| from[i] + s * (to[i] - from[i]))
        })
    }

    /// Whether a move meets nothing. Boxes of the world are where they are for a base that is carried
    /// nowhere: for one that is, on moves between places of a track, nothing is said of them.
    fn is_free(&self, from: &[f64; 6], to: &[f64; 6]) -> bool {
        let on_track = !self.profile.external.track.is_empty();
        (on_track || self.guard.keeps(from, to)) && self.is_clear(from, to)
    }

    /// Whether the arm does not touch itself: everywhere on its path, not only at samples, where
    /// its programs can be followed.
    fn is_clear(&self, from: &[f64; 6], to: &[f64; 6]) -> bool {
        match &self.passage {
            _ if self.scene.is_empty() => true,
            Some(passage) => passage.is_clear(&self.scene, from, to, ROOM_M),
            None => Self::along(from, to).all(|q| self.stands(&q)),
        }
    }

    /// An order in which as few moves as possible meet anything.
    pub(super) fn order(&self, joints: &[[f64; 6]]) -> Vec<usize> {
        route::order(joints, &|q| self.approach(q), &|from, to| {
            self.is_free(from, to)
        })
    }

    /// Poses that the arm goes over before it comes to where each configuration is approached from:
    /// none where the straight path of the joints is free, or where no path was found.
    pub(super) fn over(&self, joints: &[[f64; 6]]) -> Vec<Vec<[f64; 6]>> {
        let zero = self
            .profile
            .mechanism
            .joints
            .each_ref()
            .map(|joint| 0.0_f64.clamp(joint.min_rad, joint.max_rad));
        let over = joints.windows(2).map(|ends| {
            let to = self.approach(&ends[1]);
            route::detour(&ends[0], &to, &zero, joints, &|from, to| {
                self.is_free(from, to)
            })
        });
        std::iter::once(Vec::new()).chain(over).collect()
    }

    /// What the moves of a program meet: what each configuration is come to over, its approach,
    /// then the configuration.
    pub(super) fn findings(
        &self,
        language: &str,
        file: &str,
        text: &str,
        stops: &[Stop],
    ) -> Vec<Finding> {
        let mut findings = self.touched(language, file, text, stops);
        let mut at: Option<[f64; 6]> = None;
        for (index, stop) in stops.iter().enumerate() {
            let mut places: Vec<[f64; 6]> = at.into_iter().chain(stop.over.clone()).collect();
            places.extend([stop.from, stop.q]);
            at = Some(stop.q);
            if places
                .windows(2)
                .all(|ends| self.guard.keeps(&ends[0], &ends[1]))
            {
                continue;
            }
            let worst = places
                .windows(2)
                .flat_map(|ends| Self::along(&ends[0], &ends[1]))
                .filter_map(|q| self.guard.breach(&q))
                .max_by(|a, b| a.depth_m().total_cmp(&b.depth_m()));
            let (id, what) = match worst {
                Some(Breach::Outside(deep_m)) => (
                    "leaves-box",
                    format!(
                        "takes the tool {:.1} mm out of --inside-mm",
                        mm_from_m(deep_m)
                    ),
                ),
                Some(Breach::KeptOut(deep_m)) => (
                    "keep-out",
                    format!(
                        "takes tool, wrist or elbow {:.1} mm into a --keep-out-mm",
                        mm_from_m(deep_m)
                    ),
                ),
                None => (
                    "keep-out",
                    "touches a face of --inside-mm or of a --keep-out-mm".to_owned(),
                ),
            };
            findings.push(warning(
                id,
                file,
                0,
                format!("the path to configuration {} {what}", index + 1),
            ));
        }
        findings
    }

    /// Moves on which the arm touches itself, by what `check` says of the program.
    fn touched(&self, language: &str, file: &str, text: &str, stops: &[Stop]) -> Vec<Finding> {
        if self.scene.is_empty() {
            return vec![Finding {
                severity: Severity::Note,
                ..warning(
                    "no-shapes",
                    file,
                    0,
                    "the profile has no shapes: whether the arm touches itself was not looked at"
                        .into(),
                )
            }];
        }
        let unknown = |why: String| {
            vec![warning(
                "not-checked",
                file,
                0,
                format!("whether the arm touches itself on its path was not looked at: {why}"),
            )]
        };
        let Ok(language) = language_by_id(language) else {
            return unknown(format!("`{language}` is not read"));
        };
        let sources = [Source::new(file, text.as_bytes().to_vec())];
        let mut options = Options::default();
        options.given.tools.insert(None, self.tool.clone());
        let subject = Subject {
            language,
            sources: &sources,
            nominal: None,
            profile: &self.profile,
            scene: &self.scene,
        };
        let found = match check(&subject, &options) {
            Ok(found) => found,
            Err(error) => return unknown(error.to_string()),
        };
        let mut findings = Vec::new();
        // the configuration of each move of the program
        let configurations: Vec<usize> = stops
            .iter()
            .enumerate()
            .flat_map(|(i, stop)| std::iter::repeat_n(i + 1, stop.over.len() + 2))
            .collect();
        for motion in &found.moves {
            let Some(near) = motion.clearance.as_deref().filter(|c| c.sampled_m <= 0.0) else {
                continue;
            };
            let Some((a, b)) = self.scene.pair_names(near) else {
                continue;
            };
            findings.push(warning(
                "collision",
                file,
                motion.line as usize,
                format!(
                    "on the path to configuration {} the arm's {a} touches {b}, at {:.0} % of the \
                     move",
                    configurations.get(motion.motion).copied().unwrap_or(0),
                    100.0 * near.at
                ),
            ));
        }
        findings
    }
}

fn warning(id: &'static str, file: &str, line: usize, message: String) -> Finding {
    Finding {
        id,
        severity: Severity::Warning,
        file: file.into(),
        line,
        column: usize::from(line > 0),
        message,
        hint: BY_HAND.into(),
        accepted: false,
    }
}

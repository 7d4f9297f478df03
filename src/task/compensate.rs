//! `compensate`: program files in, program files with fake targets out, and what became of every
//! target.

use super::parts::{Names, Pose};
use super::programs::{LeftOut, common_language, explain, refuse_marked, refuse_unlikely};
use super::{Document, Failure, ProfileFile};
use crate::check::CheckError;
use crate::check::refine::refine;
use crate::compensate::{Check, Compensation, Differs, Options, Written, compensate, meaning};
use crate::finding::Finding;
use crate::geometry::units::{DEG, MM, mm_from_m};
use crate::inverse::{Method, Status};
use crate::program::{Language, Source, Value};
use schemars::JsonSchema;
use serde::{Serialize, Serializer};
use std::collections::BTreeMap;

/// The smallest path error that can be asked for, mm.
const LEAST_PATH_ERROR_MM: f64 = 0.001;

/// What is to be done.
pub struct Request<'a> {
    /// Program files that belong together; those that are read for their declarations only are
    /// marked so.
    pub sources: &'a [Source],
    /// Their language where the user says it.
    pub language: Option<&'static dyn Language>,
    /// The robot.
    pub profile: &'a ProfileFile,
    /// How.
    pub options: Options,
    /// Also files that are compensated already.
    pub force: bool,
    /// Insert targets until the path between targets, too, is within so many mm of the wanted one.
    pub max_path_error_mm: Option<f64>,
    /// What is written where there are errors.
    pub despite_errors: DespiteErrors,
}

/// What is written where there are errors.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum DespiteErrors {
    /// Nothing.
    #[default]
    Nothing,
    /// Programs that share neither targets nor calls with one that has an error.
    Good,
    /// Everything: targets with an error stay as they are.
    All,
}

/// A compensation that is not yet written.
pub struct Prepared<'a> {
    request: &'a Request<'a>,
    /// The programs' language.
    pub language: &'static dyn Language,
    /// What became of their targets.
    pub compensation: Compensation,
}

/// Computes fake targets for programs.
///
/// # Errors
/// Programs that are not understood, of several languages, or compensated already; an arm, a tool
/// or a frame that is not known.
///
/// # Panics
/// By a fault of poseshift alone: the search for markers fails on no bytes.
pub fn prepare<'a>(request: &'a Request<'a>) -> Result<Prepared<'a>, Failure> {
    let (sources, profile) = (request.sources, request.profile);
    refuse_unlikely(profile)?;
    let language = match request.language {
        Some(language) => language,
        None => common_language(sources, Some(&profile.profile))?,
    };
    let mut options = request.options.clone();
    options.accept_absolutely_accurate = request.force;
    options.each_for_itself = request.despite_errors == DespiteErrors::Good;
    // markers are looked for while the programs are compensated
    let mut marked = Ok(());
    let compensation = rayon::in_place_scope(|scope| {
        if !request.force {
            scope.spawn(|_| marked = refuse_marked(sources));
        }
        compensate(language, sources, &profile.profile, &options)
    });
    marked?;
    let mut compensation = compensation.map_err(|error| explain(&error, sources))?;
    if let Some(limit) = request.max_path_error_mm {
        keep_path(request, language, limit, &mut compensation)?;
        compensation.judge(sources, &options.accepted);
    }
    Ok(Prepared {
        request,
        language,
        compensation,
    })
}

/// Inserts targets where the path asks for them.
fn keep_path(
    request: &Request,
    language: &dyn Language,
    limit_mm: f64,
    compensation: &mut Compensation,
) -> Result<(), Failure> {
    if !(limit_mm >= LEAST_PATH_ERROR_MM && limit_mm.is_finite()) {
        return Err(Failure::new(format!(
            "--max-path-error is {limit_mm}; it must be at least {LEAST_PATH_ERROR_MM} mm"
        )));
    }
    let scene = crate::check::Scene::default();
    let subject = crate::check::Subject {
        language,
        sources: request.sources,
        nominal: None,
        profile: &request.profile.profile,
        scene: &scene,
    };
    let checked = crate::check::Options {
        given: request.options.given.clone(),
        start_joints: request.options.start_joints,
        start_external: request.options.start_external.clone(),
        ..crate::check::Options::default()
    };
    let decimals = request.options.decimals;
    refine(&subject, &checked, limit_mm * MM, decimals, compensation).map_err(|error| match error {
        CheckError::Program(error) | CheckError::Nominal(error) => explain(&error, request.sources),
        CheckError::NoCounterpart { .. } => Failure::new(error.to_string()),
    })
}

impl Prepared<'_> {
    /// Whether an error finding says that not every program may be written.
    #[must_use]
    pub fn is_refused(&self) -> bool {
        self.compensation.is_refused()
    }

    /// Whether each of the sources will be written.
    #[must_use]
    pub fn will_write(&self) -> Vec<bool> {
        let refused = self.is_refused();
        let files = self.request.sources.iter().zip(&self.compensation.refused);
        files
            .map(|(source, in_refused)| {
                let despite = match self.request.despite_errors {
                    DespiteErrors::Nothing => !refused,
                    DespiteErrors::Good => !in_refused,
                    DespiteErrors::All => true,
                };
                despite && !source.is_context
            })
            .collect()
    }

    /// The new files, read again and compared with what was meant. Takes what was computed, so that
    /// a long program is not in memory twice.
    ///
    /// # Errors
    /// They would not say what was meant: a fault of this program.
    pub fn written(self) -> Result<Written, Failure> {
        let language = self.language;
        let (written, check) = self.draft();
        read_again(check, &written, language)?;
        Ok(written)
    }

    /// The new files, still to be read again ([`read_again`]): nothing may be put in place before.
    #[must_use]
    pub fn draft(self) -> (Written, Check) {
        let only_good = self.request.despite_errors == DespiteErrors::Good;
        self.compensation.draft(
            self.language,
            self.request.sources,
            &self.request.profile.sha256,
            only_good,
        )
    }
}

/// Reads new files again and compares them with what was meant.
///
/// # Errors
/// They would not say what was meant: a fault of this program.
pub fn read_again(check: Check, written: &Written, language: &dyn Language) -> Result<(), Failure> {
    let fault = |differs: Differs| Failure::internal(differs.to_string());
    check.read_again(written, language).map_err(fault)
}

/// What the report says besides the compensation itself.
pub struct Header<'a> {
    /// Program files, as the user named them, in the order of the sources.
    pub inputs: Vec<String>,
    /// Where they were written; empty where nothing was.
    pub outputs: Vec<String>,
    /// Whether each source is written.
    pub written: Vec<bool>,
    /// The program files.
    pub sources: &'a [Source],
    /// The language.
    pub language: &'a dyn Language,
    /// Hash of the profile file.
    pub profile_sha256: &'a str,
    /// What of folders is no program of the run.
    pub left_out: &'a LeftOut,
}

impl Header<'_> {
    /// The programs themselves, without files that are read for their declarations.
    #[must_use]
    pub fn own_inputs(&self) -> Vec<String> {
        let inputs = self.inputs.iter().zip(self.sources);
        let own = inputs.filter(|(_, source)| !source.is_context);
        own.map(|(name, _)| name.clone()).collect()
    }

    /// The program's own targets, by number, in its order.
    pub fn own_targets<'a>(
        &'a self,
        compensation: &'a Compensation,
    ) -> impl Iterator<Item = usize> + 'a {
        let targets = &compensation.program.targets;
        (0..compensation.targets.len())
            .filter(|index| !self.sources[targets[*index].file as usize].is_context)
    }
}

/// What became of a target.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Target {
    /// Its name, where it has one.
    pub name: Option<String>,
    /// Its file.
    pub file: String,
    /// Its line, from 1.
    pub line: usize,
    /// The tool that goes there.
    pub tool: Option<String>,
    /// The frame that it is in.
    pub frame: Option<String>,
    /// The wanted pose, of a target that is one.
    pub wanted: Option<Pose>,
    /// The wanted joint angles, of a target that is given in joints.
    pub wanted_joints_deg: Option<[f64; 6]>,
    /// The fake target.
    pub fake: Option<Pose>,
    /// The controller's joint angles at the fake target.
    pub joints_deg: Option<[f64; 6]>,
    /// Distance of the real tool from the wanted pose with the target as it was, where that is known.
    pub before_mm: Option<f64>,
    /// Their angle.
    pub before_deg: Option<f64>,
    /// Distance of the fake target from the wanted pose.
    pub shift_mm: f64,
    /// Their angle.
    pub shift_deg: f64,
    /// Distance of the real tool from the wanted pose by the search.
    pub residual_mm: f64,
    /// Their angle.
    pub residual_deg: f64,
    /// Distance of the real tool from the wanted pose with the numbers as they are written, where that
    /// is known.
    pub rounding_mm: Option<f64>,
    /// Their angle.
    pub rounding_deg: Option<f64>,
    /// Evaluations of the real model.
    pub iterations: u32,
    /// Which method found it: `pose-shift` or `newton`.
    pub method: Option<&'static str>,
    /// Evaluations by pose shift.
    pub shift_evaluations: u32,
    /// Evaluations by Newton's method.
    pub newton_evaluations: u32,
    /// The configuration.
    pub branch: Option<String>,
    /// How the search ended.
    pub status: Option<&'static str>,
    /// Whether its numbers are changed.
    pub changed: bool,
    /// Ids of the findings at its line.
    pub findings: Vec<&'static str>,
}

/// The targets, one after another: there may be a million.
pub struct Targets<'a> {
    header: &'a Header<'a>,
    compensation: &'a Compensation,
}

impl Targets<'_> {
    /// Each target in the order of the program.
    pub fn iter(&self) -> impl Iterator<Item = Target> {
        let mut findings: BTreeMap<(&str, usize), Vec<&'static str>> = BTreeMap::new();
        for finding in &self.compensation.findings {
            let place = (finding.file.as_str(), finding.line);
            findings.entry(place).or_default().push(finding.id);
        }
        let own = self.header.own_targets(self.compensation);
        own.map(move |index| self.target(index, &findings))
    }

    fn target(
        &self,
        index: usize,
        findings: &BTreeMap<(&str, usize), Vec<&'static str>>,
    ) -> Target {
        let (header, compensation) = (self.header, self.compensation);
        let program = &compensation.program;
        let (t, text) = (&compensation.targets[index], &program.targets[index]);
        let file = text.file as usize;
        let (line, _) = header.sources[file].line_column(text.offset as usize);
        let name = &header.inputs[file];
        let decoded = meaning(header.language, program, &compensation.settings, index);
        let (wanted, wanted_joints_deg) = match decoded.map(|decoded| decoded.value) {
            Some(Value::Pose(pose)) => (Some((&pose).into()), None),
            Some(Value::Joints(q)) => (None, Some(q.map(|q| q / DEG))),
            None => (None, None),
        };
        Target {
            name: text.name.as_ref().map(ToString::to_string),
            file: name.clone(),
            line,
            tool: t.tool.map(|tool| program.tools[tool as usize].name.clone()),
            frame: t
                .frame
                .map(|frame| program.frames[frame as usize].name.clone()),
            wanted,
            wanted_joints_deg,
            fake: t.fake.as_ref().map(Into::into),
            joints_deg: t.q.map(|q| q.map(|q| q / DEG)),
            before_mm: t.before.map(|before| mm_from_m(before.distance_m)),
            before_deg: t.before.map(|before| before.angle_rad / DEG),
            shift_mm: mm_from_m(t.shift.distance_m),
            shift_deg: t.shift.angle_rad / DEG,
            residual_mm: mm_from_m(t.residual.distance_m),
            residual_deg: t.residual.angle_rad / DEG,
            rounding_mm: t.rounding.map(|after| mm_from_m(after.distance_m)),
            rounding_deg: t.rounding.map(|after| after.angle_rad / DEG),
            iterations: t.iterations,
            method: t.method.map(Method::id),
            shift_evaluations: t.shift_evaluations,
            newton_evaluations: t.newton_evaluations,
            branch: t.branch.map(|b| b.to_string()),
            status: t.status.map(Status::id),
            changed: t.changed,
            findings: findings
                .get(&(name.as_str(), line))
                .cloned()
                .unwrap_or_default(),
        }
    }
}

impl Serialize for Targets<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.iter())
    }
}

/// The numbers of all targets together.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Summary {
    /// How many there are.
    pub targets: usize,
    /// How many are shifted.
    pub compensated: usize,
    /// How many stay as they are.
    pub unchanged: usize,
    /// How many are given in joints and stay.
    pub joint_targets: usize,
    /// Mean distance of the real tool from the wanted poses before.
    pub before_mm: f64,
    /// The largest.
    pub max_before_mm: f64,
    /// Mean distance of the real tool from the wanted poses with the numbers as they are written.
    pub after_mm: f64,
    /// Mean shift.
    pub mean_shift_mm: f64,
    /// Largest shift.
    pub max_shift_mm: f64,
    /// Largest residual of the search.
    pub max_residual_mm: f64,
    /// Largest distance of the real tool from the wanted poses with the numbers as they are
    /// written.
    pub max_rounding_mm: f64,
    /// Largest angle likewise.
    pub max_rounding_deg: f64,
    /// How many searches ended by which method.
    pub methods: MethodCounts,
    /// Targets that were put between others, or given to moves of their own.
    pub added: usize,
    /// Which programs are written.
    pub files: Files,
    /// What of folders is no program of the run.
    pub left_out: LeftOut,
}

/// How many targets' searches ended by which method.
#[derive(Clone, Copy, Debug, Serialize, JsonSchema)]
pub struct MethodCounts {
    /// By the pose shift alone.
    pub pose_shift: usize,
    /// By damped Newton, after the pose shift stalled.
    pub newton: usize,
}

/// Which programs are written.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Files {
    /// These are.
    pub written: Vec<String>,
    /// These are not.
    pub refused: Vec<String>,
}

impl Files {
    pub(crate) fn of(header: &Header) -> Self {
        let (mut written, mut refused) = (Vec::new(), Vec::new());
        for (source, is_written) in header.sources.iter().zip(&header.written) {
            if source.is_context {
                continue;
            }
            let list = if *is_written {
                &mut written
            } else {
                &mut refused
            };
            list.push(source.name.clone());
        }
        Self { written, refused }
    }
}

/// What became of programs.
#[derive(Serialize, JsonSchema)]
pub struct Compensated<'a> {
    /// The programs.
    pub input: Names,
    /// Where they are written; `null` where they are not.
    pub output: Names,
    /// Their language.
    pub language: &'static str,
    /// SHA-256 of the profile.
    pub profile_sha256: &'a str,
    /// Every target.
    #[schemars(with = "Vec<Target>")]
    pub targets: Targets<'a>,
    /// All of them together.
    pub summary: Summary,
    /// What a person should look at.
    pub findings: &'a [Finding],
}

impl Document for Compensated<'_> {
    const KIND: &'static str = "compensation/1";
}

impl<'a> Compensated<'a> {
    /// The report of a compensation.
    #[must_use]
    pub fn new(header: &'a Header<'a>, compensation: &'a Compensation) -> Self {
        let s = &compensation.summary;
        Self {
            input: header.own_inputs().as_slice().into(),
            output: header.outputs.as_slice().into(),
            language: header.language.about().id,
            profile_sha256: header.profile_sha256,
            targets: Targets {
                header,
                compensation,
            },
            summary: Summary {
                targets: s.targets,
                compensated: s.compensated,
                unchanged: s.unchanged,
                joint_targets: s.joint_targets,
                before_mm: mm_from_m(s.mean_before_m),
                max_before_mm: mm_from_m(s.max_before_m),
                after_mm: mm_from_m(s.mean_after_m),
                mean_shift_mm: mm_from_m(s.mean_shift_m),
                max_shift_mm: mm_from_m(s.max_shift_m),
                max_residual_mm: mm_from_m(s.max_residual_m),
                max_rounding_mm: mm_from_m(s.max_rounding_m),
                max_rounding_deg: s.max_rounding_rad / DEG,
                methods: MethodCounts {
                    pose_shift: s.by_pose_shift,
                    newton: s.by_newton,
                },
                added: compensation.added.targets.len(),
                files: Files::of(header),
                left_out: header.left_out.clone(),
            },
            findings: &compensation.findings,
        }
    }
}

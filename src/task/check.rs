//! `check`: where the real robot goes on every move, and what it comes near.

use super::meshes::{Loader, Reader};
use super::parts::{Names, finite};
use super::programs::{
    LeftOut, common_language, compared_where_it_was, compared_with_itself, explain, paired,
    refuse_other_origin, refuse_swapped,
};
use super::{Document, Failure, ProfileFile};
use crate::check::baseline::{self, BaselineError, Comparison, Tolerances};
use crate::check::cell::Cell;
use crate::check::collision::Clearance as Near;
use crate::check::{
    self as engine, Check, CheckError, Meshes, MoveReport, Options, Scene, SceneError, Subject,
};
use crate::finding::{Acceptance, Finding, accept_errors};
use crate::geometry::units::{DEG, mm_from_m};
use crate::model::profile::Profile;
use crate::nearest;
use crate::program::{Language, Motion, Source};
use schemars::JsonSchema;
use serde::{Serialize, Serializer};
use std::borrow::Cow;

/// What is to be checked.
pub struct Request<'a> {
    /// Program files that belong together; those that are read for their declarations only are
    /// marked so.
    pub sources: &'a [Source],
    /// The program that says where the tool is wanted; `None` is the program itself.
    pub nominal: Option<&'a [Source]>,
    /// Their language where the user says it.
    pub language: Option<&'static dyn Language>,
    /// The robot.
    pub profile: &'a ProfileFile,
    /// What stands around it.
    pub cell: Option<&'a Source>,
    /// Reads the meshes that profile and cell name.
    pub read: Reader<'a>,
    /// How.
    pub options: Options,
    /// Errors that the user takes.
    pub accepted: &'a [Acceptance],
    /// Whatever the marker of a program says of its original and profile.
    pub force: bool,
}

/// A program that was followed.
pub struct Checking<'a> {
    /// What was asked.
    pub request: &'a Request<'a>,
    /// The programs' language.
    pub language: &'static dyn Language,
    /// The robot, the meshes of its bodies by their keys.
    pub profile: Profile,
    /// What stands around it, likewise.
    pub cell: Option<Cell>,
    /// These meshes.
    pub meshes: Meshes,
    /// What is to be said of them.
    pub notes: Vec<String>,
    /// The bodies.
    pub scene: Scene,
    /// What was found.
    pub check: Check,
    /// The names of the programs.
    inputs: Vec<String>,
    /// The names of the originals.
    nominal: Vec<String>,
    /// The originals in the order of the programs.
    originals: Option<Cow<'a, [Source]>>,
}

/// Why bodies are none.
fn unplaced(error: &SceneError, cell: Option<&Source>) -> Failure {
    let (SceneError::UnknownPositioner(unknown), Some(cell)) = (error, cell) else {
        return Failure::new(error.to_string());
    };
    let known = unknown.known.iter().map(String::as_str);
    let hint = match unknown.known[..] {
        [] => "`poseshift profile add-positioner` describes one".into(),
        _ => nearest::hint(&unknown.to, "positioners of the profile", known),
    };
    Failure::with_hint(format!("{}: {error}", cell.name), hint)
}

/// Follows programs through the real robot; `hear` is called with how many of how many moves are
/// done.
///
/// # Errors
/// Programs that are not understood, of several languages, or made from another original; an arm, a
/// tool or a frame that is not known; a mesh or a cell that cannot be read.
pub fn check<'a>(
    request: &'a Request<'a>,
    hear: &mut dyn FnMut(usize, usize),
) -> Result<Checking<'a>, Failure> {
    let (sources, file) = (request.sources, request.profile);
    let mut profile = file.profile.clone();
    let mut meshes = Loader::new(request.read);
    for shape in &mut profile.shapes {
        meshes.load(&mut shape.shape, &file.name)?;
    }
    let cell = request.cell.map(|cell| meshes.cell(cell)).transpose()?;
    let Loader { meshes, notes, .. } = meshes;
    let scene = Scene::new(&profile, cell.as_ref(), &meshes)
        .map_err(|error| unplaced(&error, request.cell))?;
    let asked = request.language;
    let language = asked.map_or_else(|| common_language(sources, Some(&profile)), Ok)?;
    let nominal = match request.nominal {
        Some(originals) if !request.force => {
            let originals = paired(sources, originals)?;
            refuse_other_origin(sources, &originals, file)?;
            refuse_swapped(sources, &originals)?;
            Some(originals)
        }
        originals => originals.map(Cow::Borrowed),
    };
    let subject = Subject {
        language,
        sources,
        nominal: nominal.as_deref(),
        profile: &profile,
        scene: &scene,
    };
    let found = engine::check_telling(&subject, &request.options, hear);
    let mut check = found.map_err(|error| match error {
        CheckError::Program(error) => explain(&error, sources),
        CheckError::Nominal(error) => explain(&error, nominal.as_deref().unwrap_or(&[])),
        CheckError::NoCounterpart { .. } => Failure::with_hint(
            error.to_string(),
            "is it the program that this one was made from?",
        ),
    })?;
    check.findings.extend(match nominal {
        None => compared_with_itself(sources),
        Some(_) => compared_where_it_was(sources),
    });
    accept_errors(&mut check.findings, request.accepted, &sources[0].name);
    let names = |sources: &[Source]| -> Vec<String> {
        let own = sources.iter().filter(|source| !source.is_context);
        own.map(|source| source.name.clone()).collect()
    };
    Ok(Checking {
        inputs: names(sources),
        nominal: nominal.as_deref().map(names).unwrap_or_default(),
        originals: nominal,
        request,
        language,
        profile,
        cell,
        meshes,
        notes,
        scene,
        check,
    })
}

impl Checking<'_> {
    /// What the report says besides the check itself.
    #[must_use]
    pub fn header<'h>(&'h self, left_out: &'h LeftOut) -> Header<'h> {
        Header {
            inputs: &self.inputs,
            nominal: &self.nominal,
            language: self.language,
            profile_sha256: &self.request.profile.sha256,
            left_out,
            scene: &self.scene,
        }
    }

    /// What was checked.
    #[must_use]
    pub fn subject(&self) -> Subject<'_> {
        Subject {
            language: self.language,
            sources: self.request.sources,
            nominal: self.originals.as_deref(),
            profile: &self.profile,
            scene: &self.scene,
        }
    }
}

/// What the report says besides the check itself.
pub struct Header<'a> {
    /// Program files, as the user named them.
    pub inputs: &'a [String],
    /// The original's files, where there are any.
    pub nominal: &'a [String],
    /// The language.
    pub language: &'a dyn Language,
    /// Hash of the profile file.
    pub profile_sha256: &'a str,
    /// What of folders is no program of the run.
    pub left_out: &'a LeftOut,
    /// The bodies.
    pub scene: &'a Scene,
}

/// Rounded to a millionth: what is below is arithmetic, and files stay comparable.
fn tidy(number: f64) -> Option<f64> {
    finite((number * 1e6).round() / 1e6)
}

fn tidy_mm(length_m: f64) -> Option<f64> {
    tidy(mm_from_m(length_m))
}

fn tidy_deg(angle_rad: f64) -> Option<f64> {
    tidy(angle_rad / DEG)
}

/// How near two bodies come on a move: the pair, or only that nothing is nearer than looked for.
#[derive(Clone, Debug, Default, Serialize, JsonSchema)]
pub struct Clearance {
    /// The one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub a: Option<String>,
    /// The other.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub b: Option<String>,
    /// What is required of them.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub required_mm: Option<f64>,
    /// The least that was sampled.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sampled_mm: Option<f64>,
    /// Where on the move that is, 0 to 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub at: Option<f64>,
    /// The controller's joint angles there.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub joints_deg: Option<[Option<f64>; 6]>,
    /// The nearest point of the other.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub point_mm: Option<[Option<f64>; 3]>,
    /// Whether nothing between the samples is nearer than reported.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub certified: Option<bool>,
    /// Nothing is nearer than this.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub at_least_mm: Option<f64>,
}

/// What the real robot does on a move.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Move {
    /// Its file.
    pub file: String,
    /// Its line, from 1.
    pub line: usize,
    /// `joint`, `linear`, `arc-via` or `arc`.
    pub kind: &'static str,
    /// Name of its target.
    pub name: Option<String>,
    /// The commanded pose: x, y, z in mm, angles of `Rx · Ry · Rz` in degrees.
    pub target: [Option<f64>; 6],
    /// The commanded point on the path of an arc: x, y, z.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub via_mm: Option<[Option<f64>; 3]>,
    /// Whether its target is given in joints.
    pub joint_target: bool,
    /// The controller's joint angles at its end.
    pub joints_deg: [Option<f64>; 6],
    /// Where the external axes of the profile stand at its end, mm and degrees; null where no pose
    /// depends on one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub external: Option<Vec<Option<f64>>>,
    /// Whether the robot cuts the corner at its end.
    pub cuts_corner: bool,
    /// The size of that corner.
    pub zone_mm: Option<f64>,
    /// Distance of the real tool from where it is wanted, at the end.
    pub target_error_mm: Option<f64>,
    /// Their angle.
    pub target_error_deg: Option<f64>,
    /// Standard deviation of the prediction, by the covariance of the calibrated parameters alone.
    pub uncertainty_mm: Option<f64>,
    /// Bound of that distance along the path.
    pub max_path_error_mm: Option<f64>,
    /// Bound of that angle along the path.
    pub max_path_error_deg: Option<f64>,
    /// The largest distance that was sampled.
    pub sampled_path_error_mm: Option<f64>,
    /// Where on the path that is, 0 to 1.
    pub path_error_at: Option<f64>,
    /// Whether the bound holds between the samples.
    pub path_certified: Option<bool>,
    /// Bound of the clearance of the real arm: of the nearest pair, whatever is required of it.
    pub clearance_mm: Option<f64>,
    /// Where and of what.
    pub clearance: Option<Clearance>,
    /// Bound of the least room of a pair of the real arm: their distance less what is required.
    pub room_mm: Option<f64>,
    /// Where and of what, where that is another pair than the nearest.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub room: Option<Clearance>,
    /// Bound of the clearance of the nominal arm.
    pub nominal_clearance_mm: Option<f64>,
    /// How far a joint is from its limits.
    pub joint_margin_deg: Option<f64>,
    /// Which, from 1.
    pub joint_margin_joint: Option<usize>,
    /// How far the wrist is from its singularity.
    pub wrist_deg: Option<f64>,
    /// How far the elbow is from its singularity.
    pub elbow_deg: Option<f64>,
    /// How far the wrist is from axis 1.
    pub shoulder_mm: Option<f64>,
    /// How long the move takes.
    pub duration_s: Option<f64>,
    /// The speed of the fastest joint.
    pub max_joint_speed_deg_s: Option<f64>,
}

pub(super) fn kind(motion: Motion) -> &'static str {
    match motion {
        Motion::Joint => "joint",
        Motion::Linear => "linear",
        Motion::Spline => "spline",
        Motion::ArcVia => "arc-via",
        Motion::ArcEnd => "arc",
    }
}

/// The moves, one after another: there may be a million.
pub struct Moves<'a> {
    header: &'a Header<'a>,
    check: &'a Check,
}

impl Moves<'_> {
    /// Each move in the order of the program.
    pub fn iter(&self) -> impl Iterator<Item = Move> {
        self.check.moves.iter().map(|report| self.entry(report))
    }

    fn entry(&self, report: &MoveReport) -> Move {
        let path = report.path.as_ref();
        let limits = report.limits.as_ref();
        let program = &self.check.program;
        let motion = &program.moves[report.motion];
        let name = program.target_of(motion).and_then(|of| of.name.as_deref());
        let speed_zone = program.speed_zone(motion);
        let [x, y, z, rx, ry, rz] = self.check.commanded(report).xyz_rxryrz();
        let ([x, y, z], [rx, ry, rz]) = ([x, y, z].map(tidy_mm), [rx, ry, rz].map(tidy_deg));
        Move {
            file: self.header.inputs[motion.file as usize].clone(),
            line: report.line as usize,
            kind: kind(motion.motion),
            name: name.map(str::to_owned),
            target: [x, y, z, rx, ry, rz],
            via_mm: self.check.via(report).map(|via| via.map(tidy_mm)),
            joint_target: report.in_joints(program),
            joints_deg: self.check.joints(report).map(tidy_deg),
            external: self
                .check
                .external(report)
                .map(|values| values.into_iter().map(tidy).collect()),
            cuts_corner: speed_zone.cuts_corner(),
            zone_mm: speed_zone.zone_m.and_then(tidy_mm),
            target_error_mm: tidy_mm(report.target_error.distance_m),
            target_error_deg: tidy_deg(report.target_error.angle_rad),
            uncertainty_mm: report.uncertainty_m.and_then(tidy_mm),
            max_path_error_mm: path.and_then(|p| tidy_mm(p.bound.distance_m)),
            max_path_error_deg: path.and_then(|p| tidy_deg(p.bound.angle_rad)),
            sampled_path_error_mm: path.and_then(|p| tidy_mm(p.sampled.distance_m)),
            path_error_at: path.and_then(|p| tidy(p.at)),
            path_certified: path.map(|p| p.certified),
            clearance_mm: report
                .clearance
                .as_ref()
                .and_then(|c| tidy_mm(c.clearance_m)),
            clearance: report.clearance.as_ref().map(|c| self.clearance(c)),
            room_mm: report.room().and_then(|c| tidy_mm(c.room_m())),
            room: report.least_room.as_ref().map(|c| self.clearance(c)),
            nominal_clearance_mm: report
                .nominal_clearance_m
                .and_then(|[along, _]| tidy_mm(along)),
            joint_margin_deg: limits.and_then(|l| tidy_deg(l.margin_rad)),
            joint_margin_joint: limits.map(|l| l.joint + 1),
            wrist_deg: limits.and_then(|l| tidy_deg(l.margins.wrist_rad)),
            elbow_deg: limits.and_then(|l| tidy_deg(l.margins.elbow_rad)),
            shoulder_mm: limits.and_then(|l| tidy_mm(l.margins.shoulder_m)),
            duration_s: limits.and_then(|l| l.duration_s).and_then(tidy),
            max_joint_speed_deg_s: limits.and_then(|l| tidy_deg(l.rate_rad / l.duration_s?)),
        }
    }

    fn clearance(&self, found: &Near) -> Clearance {
        let Some((a, b)) = self.header.scene.pair_names(found) else {
            return Clearance {
                at_least_mm: tidy_mm(found.clearance_m),
                ..Clearance::default()
            };
        };
        Clearance {
            a: Some(a.to_string()),
            b: Some(b.to_string()),
            required_mm: tidy_mm(found.required_m),
            sampled_mm: tidy_mm(found.sampled_m),
            at: tidy(found.at),
            joints_deg: Some(found.joints.map(tidy_deg)),
            point_mm: Some(found.points[1].map(tidy_mm)),
            certified: Some(found.certified),
            at_least_mm: None,
        }
    }
}

impl Serialize for Moves<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.iter())
    }
}

/// All moves together.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Summary {
    /// How many there are.
    pub moves: usize,
    /// How many could not be followed.
    pub unknown: usize,
    /// Largest error at a target.
    pub max_target_error_mm: Option<f64>,
    /// Largest angle at a target.
    pub max_target_error_deg: Option<f64>,
    /// Largest bound of the error along a path.
    pub max_path_error_mm: Option<f64>,
    /// Largest bound of the angle along a path.
    pub max_path_error_deg: Option<f64>,
    /// Least bound of a clearance.
    pub min_clearance_mm: Option<f64>,
    /// Moves on which the real arm touches something.
    pub collisions: usize,
    /// Moves on which the nominal arm does.
    pub nominal_collisions: usize,
    /// Moves on which the real arm comes too near.
    pub too_near: usize,
    /// Moves that are known by samples only.
    pub uncertified: usize,
    /// Moves with a corner that the robot cuts.
    pub with_zone: usize,
    /// What of folders is no program of the run.
    pub left_out: LeftOut,
}

/// Where the real robot goes with programs.
#[derive(Serialize, JsonSchema)]
pub struct Checked<'a> {
    /// The programs.
    pub input: Names,
    /// What they were made from.
    pub nominal: Names,
    /// Their language.
    pub language: &'static str,
    /// SHA-256 of the profile.
    pub profile_sha256: &'a str,
    /// All bodies: links and tool of the robot that have a shape, what is attached to them, and the
    /// cell's.
    pub bodies: Vec<&'a str>,
    /// Every move.
    #[schemars(with = "Vec<Move>")]
    pub moves: Moves<'a>,
    /// All of them together.
    pub summary: Summary,
    /// What a person should look at.
    pub findings: &'a [Finding],
    /// What differs from a stored run.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub baseline: Option<&'a Comparison>,
}

impl Document for Checked<'_> {
    const KIND: &'static str = "check/1";
}

impl<'a> Checked<'a> {
    /// What differs from a stored run, the text of its JSON; differences below `tolerance` in mm
    /// and degrees are none.
    ///
    /// # Errors
    /// A text that is no stored run.
    #[allow(
        clippy::missing_panics_doc,
        reason = "a report holds only numbers under text keys"
    )]
    pub fn compare(&self, stored: &str, tolerance: f64) -> Result<Comparison, BaselineError> {
        let before = baseline::read(stored)?;
        let tolerances = Tolerances {
            mm: tolerance,
            deg: tolerance,
        };
        let now = serde_json::to_value(self).expect("numbers under text keys");
        Ok(baseline::compare(&before, &now, tolerances))
    }

    /// The report of a check.
    #[must_use]
    pub fn new(
        header: &'a Header<'a>,
        check: &'a Check,
        comparison: Option<&'a Comparison>,
    ) -> Self {
        let s = &check.summary;
        Self {
            input: header.inputs.into(),
            nominal: header.nominal.into(),
            language: header.language.about().id,
            profile_sha256: header.profile_sha256,
            bodies: header.scene.bodies(),
            moves: Moves { header, check },
            summary: Summary {
                moves: s.moves,
                unknown: s.unknown,
                max_target_error_mm: tidy_mm(s.max_target_error.distance_m),
                max_target_error_deg: tidy_deg(s.max_target_error.angle_rad),
                max_path_error_mm: tidy_mm(s.max_path_error.distance_m),
                max_path_error_deg: tidy_deg(s.max_path_error.angle_rad),
                min_clearance_mm: s.min_clearance_m.and_then(tidy_mm),
                collisions: s.collisions,
                nominal_collisions: s.nominal_collisions,
                too_near: s.too_near,
                uncertified: s.uncertified,
                with_zone: s.with_zone,
                left_out: header.left_out.clone(),
            },
            findings: &check.findings,
            baseline: comparison,
        }
    }
}

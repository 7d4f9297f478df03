//! Where the real robot goes when it runs a program as it is, how far that is from the wanted path, and what it comes near.
//!
//! ```text
//! program → route (compensate) → legs (course) → pieces with bounds
//!                                    ├ deviation   real tool against the wanted path, bounded between samples
//!                                    ├ collision   real and nominal arm against themselves and the cell, likewise
//!                                    └ limits      joint limits, singularities, rates
//! ```
//!
//! The controller interpolates in its own model: joints, straight lines and arcs of the tool; the real model says where the
//! tool and the links are then. Corners (zones) are not rounded: the path is that through the programmed corner, and moves
//! with a zone are marked.

pub mod baseline;
pub mod cell;
pub mod collision;
mod course;
pub mod deviation;
pub mod limits;
pub mod mesh;
mod nominal;
mod query;
pub mod refine;
mod scene;
pub mod trace;
mod uncertainty;

pub use course::Turning;
pub use scene::{Meshes, MissingMesh, Scene};

use crate::compensate::route::{Route, Stop, route};
use crate::compensate::{CompensateError, Equipped, Given};
use crate::finding::{Finding, Severity};
use crate::geometry::units::{DEG, MM, mm_from_m};
use crate::geometry::{Jet, Pose, Separation, norm, scale, sub};
use crate::model::profile::{Mounted, Profile};
use crate::model::{Conditions, Model};
use crate::program::{Language, Motion, Program, Source};
use collision::{Clearance, Mover};
use course::{Course, Leg, Piece, ToolCourse};
use deviation::{Models, PathError, Wanted};
use limits::Limits;
use rayon::prelude::*;
use uncertainty::Spread;

/// Moves judged by one thread at a time.
const CHUNK: usize = 16;
/// Two joint angles that differ by less are the same, radians.
const SAME_RAD: f64 = 0.5 * DEG;
/// A landing this near to a wanted pose is the landing at it, metres.
const LANDED_M: f64 = 0.5 * MM;

/// What the user decides.
#[derive(Clone, Debug)]
pub struct Options {
    /// Tools and work frames for names that the program files do not tell.
    pub given: Given,
    /// How the controller turns the tool on straight and circular moves.
    pub turning: Turning,
    /// A path error above this is an error finding, metres.
    pub max_path_error_m: Option<f64>,
    /// Bodies farther apart than this beyond what is required are only known to be, metres.
    pub horizon_m: f64,
    /// A joint nearer to its limits than this is a warning, radians.
    pub limit_margin_rad: f64,
    /// An axis nearer to a singularity than this is a warning, radians.
    pub singularity_rad: f64,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            given: Given::default(),
            turning: Turning::Slerp,
            max_path_error_m: None,
            horizon_m: 100.0 * MM,
            limit_margin_rad: 1.0 * DEG,
            singularity_rad: 1.0 * DEG,
        }
    }
}

/// What is checked.
#[derive(Clone, Copy)]
pub struct Subject<'a> {
    /// The language of the program.
    pub language: &'a dyn Language,
    /// Its files.
    pub sources: &'a [Source],
    /// The program that says where the tool is wanted; `None` is the program itself.
    pub nominal: Option<&'a [Source]>,
    /// The robot.
    pub profile: &'a Profile,
    /// What stands around it.
    pub scene: &'a Scene,
}

/// Why nothing could be checked.
#[derive(Debug, thiserror::Error)]
pub enum CheckError {
    /// The program, its tools and frames, or the arm.
    #[error(transparent)]
    Program(#[from] CompensateError),
    /// The original program, its tools and frames.
    #[error(transparent)]
    Nominal(CompensateError),
    /// The two programs have not the same moves.
    #[error("{file}:{line}: this move of the original has no counterpart in the program")]
    NoCounterpart {
        /// File of the original.
        file: String,
        /// Line of its move.
        line: usize,
    },
}

/// What a move does.
#[derive(Clone, Debug)]
pub struct MoveReport {
    /// Index in [`Program::moves`].
    pub motion: usize,
    /// Index of its file in the sources.
    pub file: usize,
    /// Its line, from 1.
    pub line: usize,
    /// How the robot goes.
    pub kind: Motion,
    /// Name of its target in the program.
    pub target: Option<String>,
    /// Where the controller believes the tool to be at its end, in the world.
    pub commanded: Pose,
    /// How far from the wanted pose the real tool ends.
    pub target_error: Separation,
    /// One standard deviation of the real tool's predicted position at its end in the direction of its error, metres; `None`
    /// where the calibration tells no covariance.
    pub uncertainty_m: Option<f64>,
    /// The controller's joints at its end, radians.
    pub joints: [f64; 6],
    /// The error along the way; `None` where it is unknown where the move begins.
    pub path: Option<PathError>,
    /// The least room of the real arm.
    pub clearance: Option<Clearance>,
    /// The least room of the arm as the controller, or the simulation, believes it.
    pub nominal_clearance: Option<Clearance>,
    /// What it asks of the joints.
    pub limits: Option<Limits>,
    /// Programmed corner, metres; 0 where the robot stops.
    pub zone_m: Option<f64>,
}

/// Numbers of the whole.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Summary {
    /// Moves looked at.
    pub moves: usize,
    /// Moves that could not be followed.
    pub unknown: usize,
    /// Largest error at a target.
    pub max_target_error: Separation,
    /// Largest bound of an error along a path.
    pub max_path_error: Separation,
    /// Least clearance, metres; `None` where no bodies were compared.
    pub min_clearance_m: Option<f64>,
    /// Moves of the real arm that touch something.
    pub collisions: usize,
    /// Moves of the nominal arm that touch something.
    pub nominal_collisions: usize,
    /// Moves nearer than required.
    pub too_near: usize,
    /// Moves whose bounds are only those of samples.
    pub uncertified: usize,
    /// Moves with a corner that is cut.
    pub with_zone: usize,
}

/// What a check found.
#[derive(Debug)]
pub struct Check {
    /// The program as it was read.
    pub program: Program,
    /// Each move that could be followed.
    pub moves: Vec<MoveReport>,
    /// What a person should look at, by file and place.
    pub findings: Vec<Finding>,
    /// Numbers of the whole.
    pub summary: Summary,
}

impl Check {
    /// Whether the answer is no.
    #[must_use]
    pub fn is_refused(&self) -> bool {
        self.findings.iter().any(|f| f.severity == Severity::Error)
    }
}

/// Models of one tool, for plain numbers and for bounds.
struct Arms {
    plain: Models<f64>,
    jets: Models<Jet>,
    reaches: [[f64; 6]; 2],
    real_is_nominal: bool,
    spread: Option<Spread>,
}

impl Arms {
    fn of(equipped: &Equipped, profile: &Profile, tool: &Mounted) -> Self {
        let plain = Models {
            real: equipped.inverse.real.clone(),
            controller: equipped.controller.clone(),
        };
        Self {
            jets: Models {
                real: plain.real.cast(),
                controller: plain.controller.cast(),
            },
            reaches: [plain.real.reaches(), plain.controller.reaches()],
            real_is_nominal: profile.real_effects() == profile.controller_effects(),
            spread: Spread::of(profile, tool),
            plain,
        }
    }
}

/// A program that can be walked: its moves as legs.
struct Walk {
    route: Route,
    arms: Vec<Option<Arms>>,
}

impl Walk {
    fn of(
        language: &dyn Language,
        sources: &[Source],
        profile: &Profile,
        options: &Options,
    ) -> Result<Self, CompensateError> {
        let route = route(language, sources, profile, &options.given)?;
        let arms = route
            .arms
            .iter()
            .zip(&route.tools)
            .map(|(equipped, tool)| Some(Arms::of(equipped.as_ref()?, profile, tool.as_ref()?)))
            .collect();
        Ok(Self { route, arms })
    }

    fn arms(&self, stop: &Stop) -> &Arms {
        self.arms[stop.tool]
            .as_ref()
            .expect("a stop's tool has an arm")
    }

    fn equipped(&self, stop: &Stop) -> &Equipped {
        self.route.arms[stop.tool]
            .as_ref()
            .expect("a stop's tool has an arm")
    }

    fn conditions(&self, stop: &Stop) -> Conditions {
        Conditions {
            direction: stop.direction.map(f64::from),
            ..Conditions::default()
        }
    }

    /// The move from the stop before, where both are known; arcs are one leg at their end.
    fn leg(&self, index: usize, turning: Turning) -> Option<Leg<'_>> {
        let moves = &self.route.program.moves;
        let (motion, stop) = (&moves[index], self.route.stops[index]?);
        if motion.motion == Motion::ArcVia {
            return None;
        }
        let (mut before, mut via) = (index.checked_sub(1)?, None);
        if motion.motion == Motion::ArcEnd && moves[before].motion == Motion::ArcVia {
            via = Some(self.route.stops[before]?);
            before = before.checked_sub(1)?;
        }
        if moves[before].file != motion.file {
            return None;
        }
        let start = self.route.stops[before]?;
        let equipped = self.equipped(&stop);
        // another tool on the same joints
        let from = if start.tool == stop.tool {
            start.pose
        } else {
            equipped
                .controller
                .forward(&start.q, &Conditions::default())
        };
        let course = match (motion.motion, via) {
            (Motion::Joint, _) => Course::Joint {
                from: start.q,
                to: stop.q,
            },
            (_, Some(via)) => {
                let through = via.pose.translation;
                Course::Tool(ToolCourse::arc(&from, through, &stop.pose, turning))
            }
            _ => Course::Tool(ToolCourse::straight(&from, &stop.pose, turning)),
        };
        Some(Leg {
            branch: equipped.arm.posture(&start.q).0,
            equipped,
            course,
            start: start.q,
            conditions: self.conditions(&stop),
        })
    }
}

/// Follows a program through the real robot.
///
/// # Errors
/// If a program cannot be read, a tool or frame is unknown, the arm has no closed-form inverse, or the original has other
/// moves. What a move does wrong is a [`Finding`].
pub fn check(subject: &Subject, options: &Options) -> Result<Check, CheckError> {
    let walk = Walk::of(subject.language, subject.sources, subject.profile, options)?;
    let original = subject
        .nominal
        .map(|sources| Walk::of(subject.language, sources, subject.profile, options))
        .transpose()
        .map_err(CheckError::Nominal)?;
    let parts = original
        .as_ref()
        .map(|original| nominal::align(&walk, original, subject, options))
        .transpose()?;
    let job = Job {
        subject,
        options,
        walk: &walk,
        original: original.as_ref(),
        parts: parts.as_deref(),
    };
    let indices: Vec<usize> = (0..walk.route.stops.len()).collect();
    let judged: Vec<(Option<MoveReport>, Vec<Finding>)> = indices
        .par_chunks(CHUNK)
        .flat_map_iter(|chunk| {
            chunk
                .iter()
                .map(|&index| job.judge(index))
                .collect::<Vec<_>>()
        })
        .collect();
    let mut findings = walk.route.findings.clone();
    let mut moves = Vec::new();
    for (report, found) in judged {
        moves.extend(report);
        findings.extend(found);
    }
    let order = |file: &str| subject.sources.iter().position(|s| s.name == file);
    findings.sort_by_cached_key(|f| (order(&f.file), f.line, f.column, f.id));
    let unknown = walk.route.stops.iter().filter(|s| s.is_none()).count();
    let summary = sum_up(&moves, unknown, subject.scene.is_empty());
    Ok(Check {
        program: walk.route.program,
        moves,
        findings,
        summary,
    })
}

fn sum_up(moves: &[MoveReport], unknown: usize, no_bodies: bool) -> Summary {
    let worse = |a: Separation, b: Separation| Separation {
        distance_m: a.distance_m.max(b.distance_m),
        angle_rad: a.angle_rad.max(b.angle_rad),
    };
    let mut summary = Summary {
        moves: moves.len(),
        unknown,
        ..Summary::default()
    };
    for report in moves {
        summary.max_target_error = worse(summary.max_target_error, report.target_error);
        if let Some(path) = &report.path {
            summary.max_path_error = worse(summary.max_path_error, path.bound);
        }
        let certified =
            report.path.is_none_or(|p| p.certified) && report.clearance.is_none_or(|c| c.certified);
        summary.uncertified += usize::from(!certified);
        summary.with_zone += usize::from(report.zone_m.is_some_and(|zone| zone > 0.0));
        if let Some(c) = report.clearance.filter(|_| !no_bodies) {
            let least = summary.min_clearance_m.unwrap_or(f64::INFINITY);
            summary.min_clearance_m = Some(least.min(c.clearance_m));
            summary.collisions += usize::from(c.sampled_m <= 0.0);
            summary.too_near += usize::from(c.pair.is_some() && c.clearance_m < c.required_m);
        }
        let nominal = report.nominal_clearance;
        summary.nominal_collisions += usize::from(nominal.is_some_and(|c| c.sampled_m <= 0.0));
    }
    summary
}

/// What every move is judged with.
struct Job<'a> {
    subject: &'a Subject<'a>,
    options: &'a Options,
    walk: &'a Walk,
    original: Option<&'a Walk>,
    /// For each move, the part of the original's move that it is.
    parts: Option<&'a [Option<nominal::Part>]>,
}

impl Job<'_> {
    fn finding(
        &self,
        motion: usize,
        id: &'static str,
        severity: Severity,
        message: String,
        hint: &str,
    ) -> Finding {
        let motion = &self.walk.route.program.moves[motion];
        let source = &self.subject.sources[motion.file as usize];
        let (line, column) = source.line_column(motion.offset as usize);
        Finding {
            id,
            severity,
            file: source.name.clone(),
            line,
            column,
            message,
            hint: hint.into(),
        }
    }

    fn judge(&self, index: usize) -> (Option<MoveReport>, Vec<Finding>) {
        let mut findings = Vec::new();
        let program = &self.walk.route.program;
        let motion = &program.moves[index];
        let Some(stop) = self.walk.route.stops[index] else {
            return (None, findings);
        };
        if motion.motion == Motion::ArcVia {
            return (None, findings);
        }
        let arms = self.walk.arms(&stop);
        let source = &self.subject.sources[motion.file as usize];
        let part = self.parts.and_then(|parts| parts[index]);
        let wanted_end = match (self.original, part) {
            (Some(original), Some(part)) => part.end_pose(original, self.options),
            _ => stop.pose,
        };
        let conditions = self.walk.conditions(&stop);
        let landed = arms.plain.real.forward(&stop.q, &conditions);
        let mut report = MoveReport {
            motion: index,
            file: motion.file as usize,
            line: source.line_column(motion.offset as usize).0,
            kind: motion.motion,
            target: program.targets[motion.target]
                .name
                .as_deref()
                .map(str::to_owned),
            commanded: stop.pose,
            target_error: landed.separation(&wanted_end),
            uncertainty_m: arms.spread.as_ref().map(|spread| {
                let by = sub(landed.translation, wanted_end.translation);
                let long = norm(by);
                let direction = (long > 1e-9).then(|| scale(long.recip(), by));
                spread.sigma_m(&stop.q, &conditions, direction)
            }),
            joints: stop.q,
            path: None,
            clearance: None,
            nominal_clearance: None,
            limits: None,
            zone_m: motion.pace.zone_m,
        };
        // where the robot comes from is unknown: its posture alone
        let standing;
        let (leg, comes) = if let Some(leg) = self.walk.leg(index, self.options.turning) {
            (leg, true)
        } else {
            standing = Course::Joint {
                from: stop.q,
                to: stop.q,
            };
            let equipped = self.walk.equipped(&stop);
            let leg = Leg {
                branch: stop.branch,
                equipped,
                course: standing,
                start: stop.q,
                conditions,
            };
            (leg, false)
        };
        let pieces = leg.pieces();
        if comes {
            report.path = Some(self.path_error(&leg, &pieces, arms, index));
            let limits = limits::limits(&leg, &pieces, motion.pace.speed_m_s);
            self.judge_limits(index, &leg, &stop, &limits, &mut findings);
            report.limits = Some(limits);
        }
        if !self.subject.scene.is_empty() {
            self.judge_collisions(
                index,
                &leg,
                &pieces,
                arms,
                !comes,
                &mut report,
                &mut findings,
            );
        }
        self.judge_path(index, &report, &mut findings);
        (Some(report), findings)
    }

    fn path_error(&self, leg: &Leg, pieces: &[Piece], arms: &Arms, index: usize) -> PathError {
        let part = self.parts.and_then(|parts| parts[index]);
        if let (Some(original), Some(part)) = (self.original, part)
            && let Some(wanted) = original.leg(part.motion, self.options.turning)
        {
            let stop = original.route.stops[part.motion].expect("a leg ends at a stop");
            let of_original = original.arms(&stop);
            let wanted = Wanted {
                leg: &wanted,
                from: part.from,
                to: part.to,
                controller: &of_original.plain.controller,
                controller_jet: &of_original.jets.controller,
                own: false,
            };
            return deviation::path_error(leg, pieces, &wanted, &arms.plain, &arms.jets);
        }
        let wanted = Wanted {
            leg,
            from: 0.0,
            to: 1.0,
            controller: &arms.plain.controller,
            controller_jet: &arms.jets.controller,
            own: true,
        };
        deviation::path_error(leg, pieces, &wanted, &arms.plain, &arms.jets)
    }

    fn judge_path(&self, index: usize, report: &MoveReport, findings: &mut Vec<Finding>) {
        let Some(path) = &report.path else { return };
        if !path.certified {
            let message = "bounds between samples cannot be guaranteed here: the move passes near a singularity, or the controller's own chain is calibrated";
            findings.push(self.finding(
                index,
                "path-uncertified",
                Severity::Note,
                message.into(),
                "only samples were looked at",
            ));
        }
        let Some(limit) = self.options.max_path_error_m else {
            return;
        };
        if path.bound.distance_m > limit {
            let message = format!(
                "the real tool is up to {:.3} mm beside the wanted path (limit {:.3} mm; {:.3} mm at {:.0} % of the move)",
                mm_from_m(path.bound.distance_m),
                mm_from_m(limit),
                mm_from_m(path.sampled.distance_m),
                100.0 * path.at
            );
            findings.push(self.finding(
                index,
                "path-error",
                Severity::Error,
                message,
                "`poseshift compensate --max-path-error` inserts targets where the path needs them",
            ));
        }
    }

    fn judge_limits(
        &self,
        index: usize,
        leg: &Leg,
        stop: &Stop,
        limits: &Limits,
        findings: &mut Vec<Finding>,
    ) {
        let joint = &leg.equipped.arm.mechanism().joints[limits.joint];
        let span = format!(
            "limits {:.2} to {:.2} deg",
            joint.min_rad / DEG,
            joint.max_rad / DEG
        );
        if limits.margin_rad < -1e-9 {
            let message = format!(
                "joint {} leaves its limits by {:.3} deg on this move ({span})",
                limits.joint + 1,
                -limits.margin_rad / DEG
            );
            findings.push(self.finding(
                index,
                "joint-limit",
                Severity::Error,
                message,
                "move the target, or another configuration",
            ));
        } else if limits.margin_rad < self.options.limit_margin_rad {
            let message = format!(
                "joint {} comes within {:.3} deg of its limits ({span})",
                limits.joint + 1,
                limits.margin_rad / DEG
            );
            findings.push(self.finding(index, "near-joint-limit", Severity::Warning, message, ""));
        }
        let margins = &limits.margins;
        let least = self.options.singularity_rad;
        let by_tool = matches!(leg.course, Course::Tool(_));
        for (name, margin) in [("wrist", margins.wrist_rad), ("elbow", margins.elbow_rad)] {
            if by_tool && margin < least {
                let message = format!(
                    "this move passes {:.3} deg from the {name} singularity",
                    margin / DEG
                );
                findings.push(self.finding(
                    index,
                    "near-singularity",
                    Severity::Warning,
                    message,
                    "joints move fast there",
                ));
            }
        }
        if by_tool && margins.shoulder_m < 5.0 * MM {
            let message = format!(
                "this move passes {:.2} mm from the shoulder singularity",
                mm_from_m(margins.shoulder_m)
            );
            findings.push(self.finding(
                index,
                "near-singularity",
                Severity::Warning,
                message,
                "joints move fast there",
            ));
        }
        self.judge_end(index, leg, stop, findings);
        let wrist = [3, 5].map(|i| (i, limits.turn_rad[i].abs()));
        if let Some((i, turn)) = wrist
            .into_iter()
            .find(|(_, turn)| *turn > std::f64::consts::PI)
        {
            let message = format!(
                "joint {} turns by {:.1} deg on this move",
                i + 1,
                turn / DEG
            );
            findings.push(self.finding(
                index,
                "large-turn",
                Severity::Note,
                message,
                "cables and hoses turn along",
            ));
        }
        let speeds = &self.subject.profile.joint_speeds;
        let Some(duration) = limits.duration_s else {
            return;
        };
        for i in 0..6 {
            if let Some(most) = speeds[i]
                && limits.rate_rad[i] / duration > most
            {
                let message = format!(
                    "at the programmed speed joint {} would turn at {:.1} deg/s; it can {:.1}",
                    i + 1,
                    limits.rate_rad[i] / duration / DEG,
                    most / DEG
                );
                findings.push(self.finding(
                    index,
                    "joint-speed",
                    Severity::Warning,
                    message,
                    "the controller will slow down",
                ));
                break;
            }
        }
    }

    /// A path of the tool must end in the posture that its target asks for.
    fn judge_end(&self, index: usize, leg: &Leg, stop: &Stop, findings: &mut Vec<Finding>) {
        if !matches!(leg.course, Course::Tool(_)) {
            return;
        }
        let mut q = leg.start;
        for k in 1..=16 {
            let s = f64::from(k) / 16.0;
            if leg.beyond(s) > 0.0 {
                let message = format!(
                    "the straight or circular way is out of reach at {:.0} % of the move",
                    100.0 * s
                );
                findings.push(self.finding(
                    index,
                    "path-out-of-reach",
                    Severity::Error,
                    message,
                    "go round with a target between, or a joint move",
                ));
                return;
            }
            q = leg.joints(s, &q);
        }
        let aligned = leg.equipped.arm.posture(&stop.q).1.wrist_rad < SAME_RAD;
        let other = (0..6)
            .find(|&i| (q[i] - stop.q[i]).abs() > SAME_RAD && !(aligned && (i == 3 || i == 5)));
        if let Some(i) = other {
            let message = format!(
                "the target's configuration cannot be reached on this way: joint {} comes to {:.1} deg, and the target has {:.1}",
                i + 1,
                q[i] / DEG,
                stop.q[i] / DEG
            );
            findings.push(self.finding(
                index,
                "configuration-change",
                Severity::Error,
                message,
                "a joint move can change it",
            ));
        }
    }

    #[allow(clippy::too_many_arguments)]
    fn judge_collisions(
        &self,
        index: usize,
        leg: &Leg,
        pieces: &[Piece],
        arms: &Arms,
        first: bool,
        report: &mut MoveReport,
        findings: &mut Vec<Finding>,
    ) {
        let scene = self.subject.scene;
        let horizon = self.options.horizon_m;
        let mover = |which: usize, model, jet| Mover {
            model,
            jet,
            reaches: arms.reaches[which],
        };
        let real = mover(0, &arms.plain.real, &arms.jets.real);
        let found = collision::clearance(scene, &real, leg, pieces, horizon);
        report.clearance = Some(found);
        report.nominal_clearance = if arms.real_is_nominal && self.original.is_none() {
            Some(found)
        } else {
            self.nominal_clearance(index, leg, pieces, arms)
        };
        if first {
            let model: &Model = &arms.plain.real;
            for pair in collision::inside(scene, model, leg, &leg.start) {
                let (a, b) = scene.names_of(&scene.watched[pair]);
                let message = format!("{a} is inside {b}");
                findings.push(self.finding(
                    index,
                    "collision",
                    Severity::Error,
                    message,
                    "is the cell in the robot's world frame?",
                ));
            }
        }
        let arms_told = [
            ("real", report.clearance),
            ("nominal", report.nominal_clearance),
        ];
        for (which, found) in arms_told {
            let Some(found) = found else { continue };
            let Some(pair) = found.pair else { continue };
            if which == "nominal" && (arms.real_is_nominal && self.original.is_none()) {
                continue;
            }
            if found.clearance_m >= found.required_m && found.sampled_m > 0.0 {
                continue;
            }
            let watched = &scene.watched[pair];
            let (a, b) = scene.names_of(watched);
            let other = if which == "real" {
                report.nominal_clearance
            } else {
                report.clearance
            };
            let comparison = other.map_or(String::new(), |other| {
                let who = if which == "real" { "nominal" } else { "real" };
                if other.sampled_m <= 0.0 {
                    format!("; so does the {who} arm")
                } else if other.pair.is_some() {
                    format!(
                        "; the {who} arm stays clear by {:.3} mm",
                        mm_from_m(other.clearance_m)
                    )
                } else {
                    format!("; the {who} arm stays clear")
                }
            });
            let joints = found.joints.map(|q| format!("{:.2}", q / DEG)).join(", ");
            let [x, y, z] = found.points[1].map(mm_from_m);
            let when = if first {
                "where it begins".to_owned()
            } else {
                format!("at {:.1} % of the move", 100.0 * found.at)
            };
            let place = format!("{when} (joints {joints} deg; point {x:.1}, {y:.1}, {z:.1} mm)");
            let (id, message) = if found.sampled_m <= 0.0 {
                let id = if which == "real" {
                    "collision"
                } else {
                    "nominal-collision"
                };
                (
                    id,
                    format!("the {which} arm's {a} touches {b} {place}{comparison}"),
                )
            } else {
                let id = if which == "real" {
                    "clearance"
                } else {
                    "nominal-clearance"
                };
                let message = format!(
                    "the {which} arm's {a} comes within {:.3} mm of {b}, required {:.3} mm, {place}{comparison}",
                    mm_from_m(found.clearance_m),
                    mm_from_m(found.required_m)
                );
                (id, message)
            };
            let severity = if which == "real" {
                Severity::Error
            } else {
                Severity::Warning
            };
            let hint = if first {
                "this is where the program starts: is the cell in the robot's world frame?"
            } else {
                "`pairs` in the cell file allows what may touch"
            };
            findings.push(self.finding(index, id, severity, message, hint));
        }
    }

    /// The arm as the simulation believes it: in the original program where there is one.
    fn nominal_clearance(
        &self,
        index: usize,
        leg: &Leg,
        pieces: &[Piece],
        arms: &Arms,
    ) -> Option<Clearance> {
        let (scene, horizon) = (self.subject.scene, self.options.horizon_m);
        let part = self.parts.and_then(|parts| parts[index]);
        if let (Some(original), Some(part)) = (self.original, part) {
            let leg = original.leg(part.motion, self.options.turning)?;
            let stop = original.route.stops[part.motion]?;
            let arms = original.arms(&stop);
            let mover = Mover {
                model: &arms.plain.controller,
                jet: &arms.jets.controller,
                reaches: arms.reaches[1],
            };
            return Some(collision::clearance(
                scene,
                &mover,
                &leg,
                &leg.pieces(),
                horizon,
            ));
        }
        let mover = Mover {
            model: &arms.plain.controller,
            jet: &arms.jets.controller,
            reaches: arms.reaches[1],
        };
        Some(collision::clearance(scene, &mover, leg, pieces, horizon))
    }
}

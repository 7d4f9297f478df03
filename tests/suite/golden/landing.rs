//! Where the real tool lands with the written samples, by an inverse that is not the program's own.

use super::{Case, cases, run};
use crate::support::scratch;
use nalgebra::{Matrix6, Vector6};
use poseshift::geometry::{Pose, Rotation, sub};
use poseshift::model::profile::{Mounted, Profile};
use poseshift::model::{Conditions, Model};
use poseshift::motion;
use poseshift::program::{self, Language, Motion, Settings, Source, Target, Value};
use rs_opw_kinematics::glam::{DMat3, DQuat, DVec3};
use rs_opw_kinematics::kinematic_traits::Kinematics;
use rs_opw_kinematics::kinematics_impl::OPWKinematics;
use rs_opw_kinematics::parameters::opw_kinematics::Parameters;
use rs_opw_kinematics::pose::Pose as PeerPose;
use std::path::Path;

/// What the search may leave.
pub(super) const TOLERANCE_MM: f64 = 1e-6;

/// Joints that bring the controller's model to `wanted`: Newton with central differences, from
/// joints nearby.
fn search(controller: &Model, wanted: &Pose, near: [f64; 6]) -> [f64; 6] {
    let missing = |q: &[f64; 6]| {
        let is = controller.forward(q, &Conditions::default());
        let d = sub(wanted.translation, is.translation);
        let r = (wanted.rotation * is.rotation.transpose()).vector();
        Vector6::new(d[0], d[1], d[2], r[0], r[1], r[2])
    };
    let mut q = near;
    for _ in 0..20 {
        let error = missing(&q);
        let step = 1e-6;
        let mut jacobian = Matrix6::zeros();
        for j in 0..6 {
            let moved = |by: f64| {
                let mut q = q;
                q[j] += by;
                missing(&q)
            };
            jacobian.set_column(j, &((moved(-step) - moved(step)) / (2.0 * step)));
        }
        let change = jacobian
            .lu()
            .solve(&error)
            .expect("samples keep away from singularities");
        q = std::array::from_fn(|i| q[i] + change[i]);
    }
    assert!(missing(&q).norm() < 1e-11);
    q
}

/// The joints by an independent closed form of the IRB 120, nearest to `near`.
pub(super) fn closed_form(world_from_tool: &Pose, tool: &Mounted, near: &[f64; 6]) -> [f64; 6] {
    let flange = *world_from_tool * tool.flange_from_tool.inverse();
    let m = flange.rotation.0;
    let columns = [0, 1, 2].map(|j| DVec3::new(m[0][j], m[1][j], m[2][j]));
    let rotation = DQuat::from_mat3(&DMat3::from_cols(columns[0], columns[1], columns[2]));
    let peer = OPWKinematics::new(Parameters::irb120_3_58());
    let pose = PeerPose::from_parts(DVec3::from(flange.translation), rotation);
    let turned = |q: [f64; 6]| {
        let turn = std::f64::consts::TAU;
        std::array::from_fn(|i| q[i] + turn * ((near[i] - q[i]) / turn).round())
    };
    let distance = |q: &[f64; 6]| (0..6).map(|i| (q[i] - near[i]).abs()).fold(0.0, f64::max);
    let solutions = peer.inverse(&pose).into_iter().map(turned);
    solutions
        .min_by(|a, b| distance(a).total_cmp(&distance(b)))
        .expect("the fake target is in the nominal reach")
}

/// A file, or those of a folder.
fn sources(folder: &Path) -> Vec<Source> {
    let read = |path: &Path| {
        let bytes = std::fs::read(path).expect("a file");
        Source::new(path.display().to_string(), bytes)
    };
    if folder.is_file() {
        return vec![read(folder)];
    }
    let files = crate::support::files_below(folder).into_iter();
    files.map(|file| read(&folder.join(file))).collect()
}

/// From the tool as the point in the middle of an arc has it to the tool as a rotation at a constant
/// rate from the beginning of the arc to its end has it there.
fn middle_of_arc(
    language: &dyn Language,
    settings: &Settings,
    program: &program::Program,
    at: usize,
) -> Option<Rotation> {
    let pose = |at: usize| {
        let motion = program.moves.get(at)?;
        let target = &program.targets[motion.target?];
        let numbers: Vec<f64> = program.numbers_of(target).iter().map(|n| n.value).collect();
        let Value::Pose(pose) = language.decode(target.layout, &numbers, settings).value else {
            return None;
        };
        let pose = program.frames[motion.frame].world_from_frame? * pose;
        let m = pose.rotation.0;
        let columns = [0, 1, 2].map(|j| DVec3::new(m[0][j], m[1][j], m[2][j]));
        let turn = DQuat::from_mat3(&DMat3::from_cols(columns[0], columns[1], columns[2]));
        Some((DVec3::from(pose.translation), turn))
    };
    let [(start, from), (via, own), (end, to)] =
        [pose(at.checked_sub(1)?)?, pose(at)?, pose(at + 1)?];
    // the centre of the circle lies on the middle planes of two chords
    let normal = (via - start).cross(end - start).normalize();
    let chord = via - start;
    let across = normal.cross(chord);
    let other = end - start;
    let by = (0.5 * other.dot(other) - 0.5 * chord.dot(other)) / across.dot(other);
    let centre = start + 0.5 * chord + by * across;
    let angle = |point: DVec3| {
        let (first, seen) = (start - centre, point - centre);
        let angle = normal.dot(first.cross(seen)).atan2(first.dot(seen));
        angle.rem_euclid(std::f64::consts::TAU)
    };
    let there = from.slerp(to, angle(via) / angle(end));
    let middle = DMat3::from_quat(own.inverse() * there);
    let rows = [0, 1, 2].map(|i| middle.row(i).to_array());
    Some(Rotation(rows))
}

/// The files of a folder, and behind them those that the sample reads for what they declare.
fn with_context(files: &Path, folder: &Path, case: &Case) -> Vec<Source> {
    let mut all = sources(files);
    let mut options = case.options.iter();
    while let Some(option) = options.next() {
        if option == "--with" {
            let context = sources(&folder.join(options.next().expect("a folder")));
            let as_context = |source: Source| Source::context(source.name, source.bytes);
            all.extend(context.into_iter().map(as_context));
        }
    }
    all
}

#[test]
fn written_samples_bring_the_real_tool_where_it_was_wanted() {
    let (mut landed, mut carried, mut middles) = (0, 0, 0);
    for (folder, case) in cases() {
        let scratch = scratch();
        let out = scratch.path().join("out");
        let report: serde_json::Value =
            serde_json::from_slice(&run(&folder, &case, &out, &["--json"])).expect("JSON");
        let text = std::fs::read_to_string(folder.join(&case.profile)).expect("a profile");
        let profile = Profile::from_yaml(&text).expect("a valid profile");
        if !profile.external.is_empty() {
            // tests/suite/external lands these kinds of programs
            carried += 1;
            continue;
        }
        let is_irb120 = profile.model.starts_with("IRB 120");
        let written = with_context(&out, &folder, &case);
        let language = program::language_of(&written[0]).expect("a known language");
        let settings = Settings {
            pulses_per_deg: profile.pulses_per_deg,
            ..Settings::default()
        };
        let after = motion::read(language, &written, &settings).expect("a program");
        let original = with_context(&folder.join("in"), &folder, &case);
        let before = motion::read(language, &original, &settings).expect("a program");
        let targets = report["targets"].as_array().expect("a list");
        // those of the context stand behind them
        let own = |target: &&Target| !written[target.file as usize].is_context;
        assert_eq!(targets.len(), after.targets.iter().filter(own).count());
        for (at, used) in after.moves.iter().enumerate() {
            let Some(target) = used.target.filter(|target| *target < targets.len()) else {
                continue;
            };
            let reported = &targets[target];
            let findings = reported["findings"].as_array().expect("a list");
            let middle = match used.motion {
                // what no numbers serve exactly is reported
                Motion::ArcVia if findings.iter().any(|id| id == "arc-shared") => continue,
                Motion::ArcVia if !language.turns_through_middle() => {
                    let Some(middle) = middle_of_arc(language, &settings, &before, at) else {
                        continue;
                    };
                    middles += 1;
                    middle
                }
                _ => Rotation::identity(),
            };
            if reported["status"] != "converged" || reported["fake"].is_null() {
                continue;
            }
            let (tool, frame) = (&after.tools[used.tool], &after.frames[used.frame]);
            let (Some(flange_from_tool), Some(world_from_frame)) =
                (tool.flange_from_tool, frame.world_from_frame)
            else {
                continue;
            };
            let value = |program: &program::Program| {
                let target = &program.targets[target];
                let numbers: Vec<f64> =
                    program.numbers_of(target).iter().map(|n| n.value).collect();
                language.decode(target.layout, &numbers, &settings).value
            };
            let (Value::Pose(mut wanted), Value::Pose(mut fake)) = (value(&before), value(&after))
            else {
                continue;
            };
            for pose in [&mut wanted, &mut fake] {
                pose.rotation = pose.rotation * middle;
            }
            let load = tool.load.map(|load| (load.mass_kg, load.cog_m));
            let load = load.or_else(|| profile.tools.get(&tool.name).and_then(|tool| tool.load));
            let mounted = Mounted {
                name: tool.name.clone(),
                flange_from_tool,
                load,
            };
            let near: Vec<f64> =
                serde_json::from_value(reported["joints_deg"].clone()).expect("joints");
            let near = std::array::from_fn(|i| near[i].to_radians());
            let given = world_from_frame * fake;
            let q = if is_irb120 {
                closed_form(&given, &mounted, &near)
            } else {
                search(&profile.controller_model(&mounted), &given, near)
            };
            let real = profile
                .real_model(&mounted, &Conditions::default())
                .forward(&q, &Conditions::default());
            let offset_mm = 1e3 * real.separation(&(world_from_frame * wanted)).distance_m;
            let rounding_mm = reported["rounding_mm"].as_f64().expect("a number");
            assert!(
                (offset_mm - rounding_mm).abs() < TOLERANCE_MM,
                "{}: {reported} {offset_mm}",
                folder.display()
            );
            landed += 1;
        }
    }
    assert!(middles >= 4, "{middles}");
    assert_eq!(carried, 4);
    assert!(landed > 5000, "{landed} targets");
}

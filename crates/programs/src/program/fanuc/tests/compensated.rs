//! Points of an arm whose joints 2 and 3 are coupled, with their corrections.

use super::*;
use crate::compensate::{Compensation, Given, Options, compensate};
use crate::model::Conditions;
use crate::profile::{Mounted, Profile, SHIPPED};

/// An R-2000iC/165F that differs a little from its drawing, the differences made up.
fn profile() -> Profile {
    let (_, nominal) = SHIPPED
        .iter()
        .find(|(name, _)| *name == "fanuc_r2000ic_165f")
        .expect("a shipped profile");
    let effects = "effects: [{effect: link_geometry, link: 3, a_mm: 0.3, theta_deg: 0.05, \
        alpha_deg: 0.02}, {effect: link_geometry, link: 4, theta_deg: 0.06}, {effect: \
        joint_compliance, joint: 2, rad_per_n_m: 1.0e-7}]";
    assert!(nominal.contains("effects: []"));
    Profile::from_yaml(&nominal.replace("effects: []", effects)).expect("a valid profile")
}

fn grip() -> Mounted {
    Mounted {
        name: "1".into(),
        flange_from_tool: Pose::from_translation(0.1, 0.0, 0.3),
        load: None,
    }
}

fn options() -> Options {
    let mut options = Options {
        correct_joint_targets: true,
        ..Options::default()
    };
    let Given { tools, frames, .. } = &mut options.given;
    tools.insert(Some("1".into()), grip());
    frames.insert(Some("2".into()), Pose::from_translation(0.0, 0.1, 0.0));
    options
}

fn compensated(text: &str) -> (Compensation, String) {
    let source = Source::new("a.ls", text.as_bytes().to_vec());
    let mut done = compensate(
        &Fanuc,
        std::slice::from_ref(&source),
        &profile(),
        &options(),
    )
    .expect("compensated");
    let new = done.edits.remove(0).apply(&source.bytes);
    (done, String::from_utf8(new).expect("ASCII"))
}

/// A joint point as controllers write it.
fn joint_point(number: u32, j: [f64; 6]) -> String {
    format!(
        "P[{number}]{{\n   GP1:\n\tUF : 2, UT : 1,\t\n\tJ1={:10.3} deg,\tJ2={:10.3} \
         deg,\tJ3={:10.3} deg,\n\tJ4={:10.3} deg,\tJ5={:10.3} deg,\tJ6={:10.3} deg\n}};\n",
        j[0], j[1], j[2], j[3], j[4], j[5]
    )
}

/// The same place as a Cartesian point.
fn pose_point(number: u32, flags: &str, j: [f64; 6]) -> String {
    let model = profile().controller_model(&grip());
    let world_from_tool = model.forward(&j.map(|angle| angle * DEG), &Conditions::default());
    let pose = Pose::from_translation(0.0, -0.1, 0.0) * world_from_tool;
    let [x, y, z] = pose.translation.map(mm_from_m);
    let [w, p, r] = notation::nearest_angles(&pose.rotation, [0.0; 3], BEYOND_DEG);
    format!(
        "P[{number}]{{\n   GP1:\n\tUF : 2, UT : 1,\t\tCONFIG : '{flags}',\n\tX ={x:11.6}  mm,\tY \
         ={y:11.6}  mm,\tZ ={z:11.6}  mm,\n\tW ={w:11.6} deg,\tP ={p:11.6} deg,\tR ={r:11.6} \
         deg\n}};\n"
    )
}

#[test]
fn a_joint_point_and_its_cartesian_twin_get_one_correction() {
    // J3 counts from the horizontal: J2 alone leaves the forearm level
    for (j, flags) in [
        ([10.0, -20.0, -30.0, 15.0, -70.0, 40.0], "N U T, 0, 0, 0"),
        ([-35.0, 40.0, 10.0, -195.0, 60.0, 200.0], "F U T, 0, -1, 1"),
    ] {
        let points = joint_point(1, j) + &pose_point(2, flags, j);
        let text = listing("1:J P[1] 100% FINE ;\n2:L P[2] 9mm/sec FINE ;", &points);
        let (done, new) = compensated(&text);
        assert_eq!(done.findings, [], "{flags}");
        let [joints, pose] = &done.targets[..] else {
            panic!("two targets")
        };
        assert!(joints.changed && pose.changed);
        assert!(pose.shift.distance_m > 1e-4);
        for i in 0..6 {
            // the file has six decimals of a millimetre and degree
            let apart = joints.q.expect("joints")[i] - pose.q.expect("joints")[i];
            assert!(apart.abs() < 1e-6, "{flags} {i} {apart}");
        }
        assert_eq!(new.len(), text.len(), "columns stay");
        assert!(new.contains(flags));
    }
}

#[test]
fn a_turn_changes_where_the_correction_takes_a_joint_over_a_half_turn() {
    let mut changed = 0;
    for (j4, from, others) in [(179.999, "0", ["1", "-1"]), (-179.999, "0", ["-1", "1"])] {
        let j = [10.0, -20.0, -30.0, j4, -70.0, 40.0];
        let point = pose_point(1, &format!("N U T, 0, {from}, 0"), j);
        let (done, new) = compensated(&listing("1:J P[1] 100% FINE ;", &point));
        let fake = done.targets[0].q.expect("joints")[3] / DEG;
        let wanted = if fake.abs() > 180.0 { others[0] } else { from };
        let ids: Vec<_> = done.findings.iter().map(|finding| finding.id).collect();
        let reported = ids.contains(&"configuration-changed");
        assert_eq!(reported, wanted != from, "{fake} {ids:?}");
        assert!(
            new.contains(&format!("N U T, 0, {wanted}, 0")),
            "{fake} {new}"
        );
        changed += usize::from(reported);
    }
    assert_eq!(changed, 1, "the correction goes one way");
}

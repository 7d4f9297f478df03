//! An engineer's own robot: from the catalogue or a URDF, calibrated again, its tables in other units.

use super::robots::{profile, reported, words};
use crate::support::{repository, scratch};
use poseshift::model::Conditions;
use poseshift::model::profile::{Mounted, catalogue};
use serde_json::Value;

#[test]
fn no_arm_of_the_catalogue_has_its_base_upside_down() {
    for arm in catalogue() {
        let up = arm.profile().world_from_base.rotation.axis(2)[2];
        assert!(up > 0.5, "{}: {up}", arm.name);
    }
    // KUKA's file has axis 1 along a line that points down
    let folder = scratch();
    let new = [
        "profile",
        "new",
        "--robot",
        "kuka_kr16_r1610_2",
        "-o",
        "kr16.yaml",
    ];
    assert_eq!(reported(folder.path(), &new).0, Some(0));
    let arm = profile(&folder.path().join("kr16.yaml"));
    assert_eq!(arm.world_from_base, poseshift::geometry::Pose::identity());
    let model = arm.real_model(&Mounted::flange(), &Conditions::default());
    // at A2 -90 and A3 90 the wrist is before the upright lower arm: 520 + 780 + 150 mm high
    let q = [0.0, -90.0, 90.0, 0.0, 0.0, 0.0].map(f64::to_radians);
    let at = model.forward(&q, &Conditions::default()).translation;
    let mm = [968.0, 0.0, 1450.0];
    assert!((0..3).all(|i| (1e3 * at[i] - mm[i]).abs() < 1e-9), "{at:?}");
    // and positive A1 turns it clockwise, seen from above
    let turned = [30.0, -90.0, 90.0, 0.0, 0.0, 0.0].map(f64::to_radians);
    assert!(model.forward(&turned, &Conditions::default()).translation[1] < 0.0);
}

#[test]
fn a_urdf_whose_first_axis_points_down_gives_a_base_that_stands_upright() {
    let folder = scratch();
    let joint = |k: usize, place: &str, axis: &str| {
        format!(
            "<link name='l{k}'><inertial><origin xyz='0.01 0.02 0.03'/><mass \
             value='{k}'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial></link><joint name='j{k}' type='revolute'><parent \
             link='l{}'/><child link='l{k}'/><origin xyz='{place}'/><axis xyz='{axis}'/><limit \
             lower='-2' upper='2' effort='1' velocity='1'/></joint>",
            k - 1
        )
    };
    let urdf = |first: &str| {
        let all = [
            ("0 0 0.4", first),
            ("0.1 0 0.1", "0 1 0"),
            ("0 0 0.5", "0 1 0"),
            ("0.4 0 0.1", "1 0 0"),
            ("0.1 0 0", "0 1 0"),
            ("0.1 0 0", "1 0 0"),
        ];
        let joints = (1..)
            .zip(all)
            .map(|(k, (place, axis))| joint(k, place, axis));
        let joints: String = joints.collect();
        format!("<robot name='r'><link name='l0'/>{joints}</robot>")
    };
    let read = |first: &str| {
        std::fs::write(folder.path().join("r.urdf"), urdf(first)).expect("scratch");
        let from = ["profile", "from-urdf", "r.urdf", "-o", "r.yaml", "--force"];
        let (status, _, said) = reported(folder.path(), &from);
        assert_eq!(status, Some(0), "{said}");
        profile(&folder.path().join("r.yaml"))
    };
    let [up, down] = ["0 0 1", "0 0 -1"].map(read);
    assert_eq!(down.mechanism.joints[0].sign, -1.0);
    assert_eq!(down.world_from_base, up.world_from_base);
    let at = |arm: &poseshift::model::profile::Profile, first: f64| {
        let model = arm.real_model(&Mounted::flange(), &Conditions::default());
        model.forward(&[first, 0.3, -0.4, 0.5, 0.6, 0.7], &Conditions::default())
    };
    let gap = at(&up, 0.2).separation(&at(&down, -0.2));
    assert!(gap.distance_m < 1e-12 && gap.angle_rad < 1e-12);
    // its masses stand where they stood
    for (a, b) in up.bodies.iter().zip(&down.bodies) {
        assert_eq!(a.mass_kg, b.mass_kg);
        let near = (0..3).all(|i| (a.cog_m[i] - b.cog_m[i]).abs() < 1e-12);
        assert!(near, "{:?} {:?}", a.cog_m, b.cog_m);
    }
}

#[test]
fn calibrated_again_the_error_before_is_that_of_the_profile_as_it_is() {
    let folder = scratch();
    let data = |name: &str| {
        let path = repository("tests/data/walk").join(name);
        path.display().to_string()
    };
    let (urdf, joints, points) = (data("arm.urdf"), data("joints.csv"), data("tracker.csv"));
    let tool = "TOOL_DATA[1]=50,20,130,0,0,0,4";
    let from = [
        "profile",
        "from-urdf",
        &urdf,
        "--language",
        "krl",
        "--tool",
        tool,
    ];
    let made = reported(folder.path(), &[&from[..], &["-o", "a.yaml"]].concat());
    assert_eq!(made.0, Some(0), "{}", made.2);
    let columns = "id=Pose,id=Punkt,q1=J1,q2=J2,q3=J3,q4=J4,q5=J5,q6=J6,x=X,y=Y,z=Z";
    let errors = |from: &str, to: &str| {
        let arguments = [
            "calibrate",
            "--profile",
            from,
            "--joints",
            &joints,
            "--points",
            &points,
            "--columns",
            columns,
            "--units",
            "m,rad",
            "-o",
            to,
            "--json",
        ];
        let (status, out, said) = reported(folder.path(), &arguments);
        assert_eq!(status, Some(0), "{said}");
        let found: Value = serde_json::from_str(&out).expect("JSON");
        let mean = |key: &str| {
            let mean = found[key]["position"]["mean_mm"].as_f64();
            mean.unwrap_or_else(|| panic!("{key}: {found}"))
        };
        [mean("before"), mean("after")]
    };
    let [first, calibrated] = errors("a.yaml", "b.yaml");
    assert!(first > 50.0 * calibrated, "{first} {calibrated}");
    let [again, still] = errors("b.yaml", "c.yaml");
    assert!((again - calibrated).abs() < 1e-4, "{again} {calibrated}");
    assert!((still - calibrated).abs() < 1e-4, "{still} {calibrated}");
}

#[test]
fn a_column_in_another_unit_is_to_be_converted() {
    let folder = scratch();
    let text = "point,x_in,y_in,z_in\na,0,0,0\nb,9,0,0\nc,0,9,0\n";
    for name in ["from.csv", "to.csv"] {
        std::fs::write(folder.path().join(name), text).expect("scratch");
    }
    let (status, _, said) = reported(folder.path(), &["register", "from.csv", "to.csv"]);
    assert_eq!(status, Some(2));
    let said = words(&said);
    assert!(said.contains("convert `x_in` from in to mm"), "{said}");
    assert!(!said.contains("is `x_in` meant"), "{said}");
}

#[test]
fn a_negative_number_is_the_value_of_its_option() {
    let folder = scratch();
    let thesis = repository("robots/abb_irb120_thesis.yaml");
    let thesis = thesis.display().to_string();
    let program = repository("programs/rapid/olp/in/Deburr.mod");
    let program = program.display().to_string();
    let check = ["check", &program, "--profile", &thesis, "--tolerance", "-1"];
    let (status, _, said) = reported(folder.path(), &check);
    assert_eq!(status, Some(2));
    assert!(
        words(&said).contains("--tolerance is -1; it must be"),
        "{said}"
    );
    let joints = "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg\n0,0,0,0,30,0\n10,0,0,0,30,0\n";
    std::fs::write(folder.path().join("q.csv"), joints).expect("scratch");
    let simulate = [
        "simulate",
        "--profile",
        &thesis,
        "--joints",
        "q.csv",
        "--temperature-c",
        "-5,20",
        "-o",
        "m.csv",
    ];
    let (status, _, said) = reported(folder.path(), &simulate);
    assert_eq!(status, Some(0), "{said}");
    let made = std::fs::read_to_string(folder.path().join("m.csv")).expect("written");
    assert!(made.contains("-5"), "{made}");
}

#[test]
fn a_value_that_a_profile_cannot_have_is_shown_in_the_file_that_is_there() {
    let folder = scratch();
    let shipped = repository("robots/abb_irb120.yaml");
    std::fs::copy(shipped, folder.path().join("p.yaml")).expect("scratch");
    let key = "kinematics.joints.1.max_deg=abc";
    let set = ["profile", "set", "p.yaml", key, "-o", "new.yaml"];
    let (status, _, said) = reported(folder.path(), &set);
    assert_eq!(status, Some(2));
    assert!(
        said.contains("p.yaml:") && !said.contains("new.yaml"),
        "{said}"
    );
    assert!(!folder.path().join("new.yaml").exists());
}

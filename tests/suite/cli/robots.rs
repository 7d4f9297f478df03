//! From a robot's name or its URDF to a profile.

use crate::support::{poseshift, repository, run, scratch};
use poseshift::geometry::{Pose, Rotation};
use poseshift::model::Conditions;
use poseshift::model::profile::{Mounted, Profile};
use serde_json::Value;
use std::path::Path;

/// Runs in a folder: exit status, standard output, standard error.
pub(super) fn reported(folder: &Path, arguments: &[&str]) -> (Option<i32>, String, String) {
    let output = poseshift()
        .current_dir(folder)
        .args(arguments)
        .output()
        .expect("the program starts");
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("UTF-8");
    (
        output.status.code(),
        text(output.stdout),
        text(output.stderr),
    )
}

/// Words of a message whatever its line breaks.
pub(super) fn words(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

pub(super) fn profile(path: &Path) -> Profile {
    let text = std::fs::read_to_string(path).expect("a file");
    Profile::from_yaml(&text).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

#[test]
fn robots_are_found_by_parts_of_their_names_and_a_misspelt_one_is_proposed() {
    let listed = |arguments: &[&str]| -> Vec<String> {
        let (status, out, _) = run(&[&["robots", "--json"], arguments].concat());
        assert_eq!(status, 0);
        let report: Value = serde_json::from_str(&out).expect("JSON");
        let robots = report["robots"].as_array().expect("a list").iter();
        robots
            .map(|r| r["name"].as_str().expect("a name").to_owned())
            .collect()
    };
    let all = listed(&[]);
    assert_eq!(all.len(), 14 + 376);
    assert!(all.is_sorted());
    assert_eq!(
        listed(&["--search", "KR 10 R1100-2"]),
        ["kuka_kr10_r1100_2"]
    );
    assert!(listed(&["--search", "fanuc crx"]).len() >= 7);
    let folder = scratch();
    let (status, _, error) = reported(folder.path(), &["robots", "--search", "irb12o0"]);
    assert_eq!(status, Some(2), "{error}");
    assert!(words(&error).contains("did you mean `abb_irb12"), "{error}");
    for (wanted, meant) in [
        ("abb_irb_1200_5_90", "abb_irb1200_5_90"),
        ("fanuc_crx10ial", "fanuc_crx10ia_l"),
        ("ur5e", "universal_robots_ur5e"),
        ("kuka_kr6r900", "kuka_kr6_r900"),
    ] {
        let (status, _, error) = reported(folder.path(), &["profile", "new", "--robot", wanted]);
        assert_eq!(status, Some(2));
        let error = words(&error);
        assert!(
            error.contains("did you mean") && error.contains(&format!("`{meant}`")),
            "{error}"
        );
    }
    let (status, _, error) = reported(folder.path(), &["profile", "show", "abb_irb120"]);
    assert_eq!(status, Some(2));
    assert!(
        words(&error).contains("poseshift profile new --robot abb_irb120 -o"),
        "{error}"
    );
}

#[test]
fn a_profile_of_the_catalogue_says_where_its_numbers_are_from_and_what_is_to_be_set() {
    let folder = scratch();
    let new = [
        "profile",
        "new",
        "--robot",
        "fanuc_crx10ia_l",
        "-o",
        "crx.yaml",
    ];
    let (status, out, error) = reported(folder.path(), &new);
    assert_eq!(status, Some(0), "{error}");
    let file = folder.path().join("crx.yaml");
    let text = std::fs::read_to_string(&file).expect("written");
    for said in [
        "FANUC-CORPORATION/fanuc_description at 250d3fa",
        "ros-industrial/fanuc_experimental: lengths equal, ranges of joints 6 differ",
        "28 of 29",
        "from the data sheet",
        "J3 + J2",
        "Masses: none",
    ] {
        assert!(text.contains(said), "{said}: {text}");
        assert!(words(&out).contains(said), "{said}: {out}");
    }
    let crx = profile(&file);
    assert_eq!(crx.language.as_deref(), Some("fanuc"));
    // on its pedestal in the file; the controller counts from the height of axis 2
    let model = crx.controller_model(&Mounted::flange());
    let at = |q: [f64; 6]| model.forward(&q, &Conditions::default()).translation;
    let zero = at([0.0; 6]);
    assert!(
        (zero[0] - 0.7).abs() < 1e-12 && (zero[2] - 0.71).abs() < 1e-12,
        "{zero:?}"
    );
    // the pendant's J3 is counted from the horizontal: with J2 alone the forearm stays level
    let leaning = at([0.0, 0.3, 0.0, 0.0, 0.0, 0.0]);
    assert!(
        (leaning[2] - 0.71 * 0.3_f64.cos()).abs() < 1e-12,
        "{leaning:?}"
    );
    assert_eq!(
        reported(folder.path(), &new).0,
        Some(2),
        "an existing profile stays"
    );
}

/// An arm of six axes with the frames that real files have.
fn urdf(name: &str, more: &str) -> String {
    let joint = |k: usize, xyz: &str, axis: &str| {
        format!(
            "<link name=\"link_{k}\"><visual><material name=\"a\"/><material \
             name=\"b\"/><geometry><sphere radius=\"1\"/></geometry></visual></link>\
             <joint name=\"joint_{k}\" type=\"revolute\"><parent link=\"{}\"/><child \
                 link=\"link_{k}\"/><origin xyz=\"{xyz}\"/>\
             <axis xyz=\"{axis}\"/><limit lower=\"-2\" upper=\"2.5\" effort=\"0\" \
                 velocity=\"3\"/></joint>",
            if k == 1 {
                "base_link".into()
            } else {
                format!("link_{}", k - 1)
            }
        )
    };
    let joints = [
        joint(1, "0 0 0.45", "0 0 1"),
        joint(2, "0.15 0 0", "0 1 0"),
        joint(3, "0 0 0.6", "0 -1 0"),
        joint(4, "0 0 0.2", "-1 0 0"),
        joint(5, "0.64 0 0", "0 -1 0"),
        joint(6, "0.1 0 0", "-1 0 0"),
    ];
    format!(
        "<robot name=\"{name}\"><link name=\"base_link\"/>{}<link name=\"base\"/><joint name=\"b\" \
         type=\"fixed\"><parent link=\"base_link\"/>\
         <child link=\"base\"/><origin xyz=\"0 0 0.45\" rpy=\"0 0 3.14159\"/></joint><link \
             name=\"tool0\"/><joint name=\"t\" type=\"fixed\">\
         <parent link=\"link_6\"/><child link=\"tool0\"/><origin rpy=\"0 1.5708 \
             0\"/></joint>{more}</robot>",
        joints.concat()
    )
}

#[test]
fn a_urdf_stands_where_its_controller_counts_from() {
    let folder = scratch();
    std::fs::write(folder.path().join("a.urdf"), urdf("fanuc_test", "")).expect("scratch");
    let made = |out: &str, more: &[&str]| {
        let arguments = [&["profile", "from-urdf", "a.urdf", "-o", out], more].concat();
        let (status, text, error) = reported(folder.path(), &arguments);
        assert_eq!(status, Some(0), "{error}");
        (profile(&folder.path().join(out)), words(&text))
    };
    let zero = |profile: &Profile| {
        let model = profile.controller_model(&Mounted::flange());
        model.forward(&[0.0; 6], &Conditions::default())
    };
    let near = |pose: &Pose, xyz: [f64; 3]| {
        let gap = (0..3)
            .map(|i| (pose.translation[i] - xyz[i]).abs())
            .fold(0.0, f64::max);
        assert!(gap < 1e-9, "{:?} {xyz:?}", pose.translation);
    };
    let (fanuc, text) = made("a.yaml", &[]);
    // rotated by half a turn and 450 mm up: from the frame `base`
    near(&zero(&fanuc), [-0.89, 0.0, 0.8]);
    assert!(
        text.contains("the world is link `base`") && text.contains("0 0 450 mm"),
        "{text}"
    );
    assert!(
        text.contains("the maker is FANUC") && text.contains("J3 + J2"),
        "{text}"
    );
    assert!(text.contains("no link has a mass"), "{text}");
    assert_eq!(fanuc.language.as_deref(), Some("fanuc"));
    assert_eq!(
        (fanuc.manufacturer.as_str(), fanuc.mechanism.coupling.len()),
        ("FANUC", 1)
    );
    // the file's J3 is the chain's
    let q = [0.2, 0.4, -0.3, 0.5, 0.6, -0.7];
    let (kuka, text) = made("b.yaml", &["--maker", "kuka", "--base", "base_link"]);
    assert!(!text.contains("the world is"), "{text}");
    near(&zero(&kuka), [0.89, 0.0, 1.25]);
    let chain = |profile: &Profile, q: [f64; 6]| {
        let model = profile.controller_model(&Mounted::flange());
        model.forward(&q, &Conditions::default())
    };
    let pendant = [0.2, 0.4, -0.3 - 0.4, 0.5, 0.6, -0.7];
    let seen = Pose::from_translation(0.0, 0.0, 0.45)
        * Pose::from_rotation(Rotation([
            [-1.0, 0.0, 0.0],
            [0.0, -1.0, 0.0],
            [0.0, 0.0, 1.0],
        ]));
    let gap = (seen * chain(&fanuc, pendant)).separation(&chain(&kuka, q));
    assert!(gap.distance_m < 1e-9 && gap.angle_rad < 1e-9, "{gap:?}");
    let tools = [
        "--tool",
        "gripper=0,0,150,0,0,0,2.5",
        "--tool",
        "probe=10,0,80,0,0,90",
        "--serial",
        "E-17",
    ];
    let (named, _) = made("c.yaml", &tools);
    assert_eq!(named.serial.as_deref(), Some("E-17"));
    assert_eq!(named.tools.len(), 2);
    assert_eq!(named.tools["gripper"].load, Some((2.5, [0.0; 3])));
    let (_, text) = made("d.yaml", &["--maker", "ABB"]);
    assert!(text.contains("IRB 2400, 4400"), "{text}");
    let rod = "kinematics.coupling=[{joint: 3, \"on\": 2, ratio: -1}]";
    let (status, _, error) = reported(
        folder.path(),
        &["profile", "set", "d.yaml", rod, "--in-place"],
    );
    assert_eq!(status, Some(0), "{error}");
    let rod = profile(&folder.path().join("d.yaml"));
    let ratios: Vec<f64> = rod.mechanism.coupling.iter().map(|c| c.ratio).collect();
    assert_eq!(ratios, [-1.0]);
    // an arm that nobody knows
    let (status, text, _) = {
        std::fs::write(folder.path().join("x.urdf"), urdf("arm", "")).expect("scratch");
        reported(
            folder.path(),
            &[
                "profile",
                "from-urdf",
                "x.urdf",
                "--maker",
                "fanuk",
                "-o",
                "x.yaml",
            ],
        )
    };
    assert_eq!(status, Some(0));
    let text = words(&text);
    assert!(
        text.contains("did you mean `FANUC`") && text.contains("--language names it"),
        "{text}"
    );
    assert!(
        profile(&folder.path().join("x.yaml"))
            .mechanism
            .coupling
            .is_empty()
    );
}

#[test]
fn the_language_of_the_controller_tells_the_maker_where_no_name_does() {
    let folder = scratch();
    std::fs::write(folder.path().join("x.urdf"), urdf("arm", "")).expect("scratch");
    let made = |language: &str| {
        let out = format!("{language}.yaml");
        let arguments = [
            "profile",
            "from-urdf",
            "x.urdf",
            "--language",
            language,
            "-o",
            &out,
        ];
        let (status, text, said) = reported(folder.path(), &arguments);
        assert_eq!(status, Some(0), "{text} {said}");
        let coupling = profile(&folder.path().join(out)).mechanism.coupling;
        (coupling.len(), words(&text) + &words(&said))
    };
    let (couplings, said) = made("fanuc");
    assert_eq!(couplings, 1);
    assert!(
        said.contains("the maker is FANUC, by the language"),
        "{said}"
    );
    assert_eq!(made("krl").0, 0);
}

#[test]
fn what_cannot_be_taken_of_a_urdf_is_refused_with_what_was_meant() {
    let folder = scratch();
    let cart = "<link name=\"cart\"/><joint name=\"rail\" type=\"prismatic\"><parent \
        link=\"cart\"/><child link=\"base_link\"/><axis xyz=\"1 0 0\"/>\
                <limit lower=\"0\" upper=\"1\" effort=\"0\" velocity=\"1\"/></joint><link \
                    name=\"finger\"/><joint name=\"grip\" type=\"revolute\"><parent \
                    link=\"tool0\"/>\
                <child link=\"finger\"/><axis xyz=\"0 0 1\"/><limit lower=\"-1\" upper=\"1\" \
                    effort=\"0\" velocity=\"1\"/></joint>";
    std::fs::write(folder.path().join("a.urdf"), urdf("arm", cart)).expect("scratch");
    for (more, says, hint) in [
        (
            &["--tip", "tool"][..],
            "no link `tool`",
            "did you mean `tool0`",
        ),
        (
            &["--base", "bsae_link"],
            "no link `bsae_link`",
            "did you mean `base_link`",
        ),
        (
            &["--base", "link_2", "--tip", "tool0"],
            "4 axes between",
            "choose a part",
        ),
        (
            &["--base", "finger", "--tip", "tool0"],
            "`grip` moves link `finger`",
            "fixed to the foot",
        ),
        (
            &["--base", "base", "--tip", "finger"],
            "7 axes between",
            "endlessly many",
        ),
        (
            &["--base", "link_3", "--tip", "base"],
            "moves link `link_3`",
            "fixed to the foot",
        ),
        (
            &["--base", "base", "--tip", "cart"],
            "`rail` moves link `base`",
            "fixed to the foot",
        ),
        (
            &["--base", "base", "--tip", "tool0", "--language", "rapit"],
            "no language is called `rapit`",
            "did you mean `rapid`",
        ),
        (&["--tool", "t=1,2,3"], "3 numbers", "in mm, degrees and kg"),
        (
            &["--tool", "t=0,0,100,0,0,0", "--tool", "t=0,0,200,0,0,0"],
            "given twice",
            "",
        ),
    ] {
        let arguments = [&["profile", "from-urdf", "a.urdf"][..], more].concat();
        let (status, out, error) = reported(folder.path(), &arguments);
        assert_eq!((status, out.as_str()), (Some(2), ""), "{more:?}");
        let error = words(&error);
        assert!(
            error.contains(says) && error.contains(hint),
            "{more:?}: {error}"
        );
    }
    // six axes in the middle of the tree are fine
    let base = [
        "profile",
        "from-urdf",
        "a.urdf",
        "--base",
        "base",
        "--tip",
        "tool0",
    ];
    assert_eq!(reported(folder.path(), &base).0, Some(0));
}

#[test]
fn numbers_names_and_paths_of_a_urdf_that_none_has_are_named_with_their_element() {
    let folder = scratch();
    let link = |content: &str| {
        let open = "<link name=\"link_3\">";
        urdf("arm", "").replace(open, &format!("{open}{content}"))
    };
    let shape = |form: &str| {
        link(&format!(
            "<collision><geometry>{form}</geometry></collision>"
        ))
    };
    let mesh = |file: &str| shape(&format!("<mesh filename=\"package://{file}\"/>"));
    let mass = |kg: &str, x: &str| {
        link(&format!(
            "<inertial><origin xyz=\"{x} 0 0\"/><mass value=\"{kg}\"/><inertia ixx=\"1\" ixy=\"0\" ixz=\"0\" iyy=\"1\" iyz=\"0\" izz=\"1\"/></inertial>"
        ))
    };
    for (text, wanted) in [
        (
            mass("1e308", "0"),
            "the mass of `link_3` is 1e308 kg; it is from 0 to 10000 kg",
        ),
        (mass("-1", "0"), "the mass of `link_3` is -1.0 kg"),
        (mass("5", "1e9"), "the centre of gravity of `link_3`"),
        (
            shape("<box size=\"1 1e300 1\"/>"),
            "of `link_3` is 1e300; it is above 0 and at most 1000",
        ),
        (
            mesh("../../../etc/passwd"),
            "of link `link_3` leads out of its package",
        ),
        (mesh("a/../../x.stl"), "leads out of its package"),
        (mesh("/etc/passwd"), "leads out of its package"),
        (
            urdf("arm", "<link name=\"link_2\"/>"),
            "is `link_2`, which another one has, too",
        ),
        (
            "<robot name=\"a\"><link/></robot>".into(),
            "missing field `name`",
        ),
        (
            "<robot name=\"a\"><link name=\"\"/></robot>".into(),
            "the name of link number 1 is ``, which is none",
        ),
        (
            "<robot name=\"a\"><link name=\"b\"/></robot>".into(),
            "no joint of the file moves a link",
        ),
        (
            urdf("a&#10;warning: all is well", ""),
            "a\\u{a}warning: all is well`, which holds",
        ),
    ] {
        std::fs::write(folder.path().join("a.urdf"), &text).expect("scratch");
        let arguments = ["profile", "from-urdf", "a.urdf"];
        let (status, out, error) = reported(folder.path(), &arguments);
        assert_eq!((status, out.as_str()), (Some(2), ""), "{wanted}: {error}");
        let error = words(&error);
        assert!(error.contains(wanted), "{wanted}: {error}");
        assert!(error.contains("a.urdf"), "{error}");
    }
}

#[test]
fn a_pedestal_is_reported_and_meshes_are_named_from_the_profile() {
    let folder = scratch();
    let package = folder.path().join("arm_support");
    for made in ["urdf", "meshes"] {
        std::fs::create_dir_all(package.join(made)).expect("scratch");
    }
    std::fs::create_dir(folder.path().join("profiles")).expect("scratch");
    std::fs::write(package.join("meshes/arm.stl"), "solid x\nendsolid x\n").expect("scratch");
    let text = urdf("arm", "")
        .replace("<link name=\"base\"/>", "<link name=\"else\"/>")
        .replace("<child link=\"base\"/>", "<child link=\"else\"/>")
        .replace(
            "<link name=\"base_link\"/>",
            "<link name=\"world\"/><joint name=\"p\" type=\"fixed\"><parent link=\"world\"/><child \
             link=\"base_link\"/><origin xyz=\"0 0 0.75\"/></joint>\
             <link name=\"base_link\"><collision><geometry><mesh \
                 filename=\"package://arm_support/meshes/arm.stl\"/></geometry></collision></link>",
        );
    std::fs::write(package.join("urdf/arm.urdf"), text).expect("scratch");
    let from = [
        "profile",
        "from-urdf",
        "arm_support/urdf/arm.urdf",
        "-o",
        "profiles/arm.yaml",
    ];
    let (status, out, error) = reported(folder.path(), &from);
    assert_eq!(status, Some(0), "{error}");
    let out = words(&out);
    assert!(
        out.contains("`base_link` is 0 0 750 mm")
            && out.contains("--base base_link leaves that out"),
        "{out}"
    );
    let written =
        std::fs::read_to_string(folder.path().join("profiles/arm.yaml")).expect("written");
    assert!(
        written.contains("mesh: \"../arm_support/meshes/arm.stl\""),
        "{written}"
    );
}

#[test]
fn values_are_set_and_tools_added_without_touching_anything_else() {
    let folder = scratch();
    let original =
        std::fs::read_to_string(repository("robots/abb_irb120_thesis.yaml")).expect("a profile");
    let file = folder.path().join("mine.yaml");
    std::fs::write(&file, &original).expect("scratch");
    let set = [
        "profile",
        "set",
        "mine.yaml",
        "kinematics.joints.3.max_deg=65.5",
        "robot.serial=120-7",
        "robot.payload_kg=3",
        "--in-place",
    ];
    let (status, out, error) = reported(folder.path(), &set);
    assert_eq!(status, Some(0), "{error}");
    assert!(out.contains("120-7") && out.contains("65.5"), "{out}");
    let changed = std::fs::read_to_string(&file).expect("written");
    let differing: Vec<(&str, &str)> = original
        .lines()
        .zip(changed.lines())
        .filter(|(a, b)| a != b)
        .collect();
    assert_eq!(differing.len(), 2, "{differing:?}");
    let now = profile(&file);
    assert_eq!(
        (now.serial.as_deref(), now.payload_kg),
        (Some("120-7"), Some(3.0))
    );
    assert!((now.mechanism.joints[2].max_rad.to_degrees() - 65.5).abs() < 1e-12);
    let add = [
        "profile",
        "add-tool",
        "mine.yaml",
        "weld gun=0,0,150,0,45,0,1.5,0,0,60",
        "--in-place",
    ];
    let (status, _, error) = reported(folder.path(), &add);
    assert_eq!(status, Some(0), "{error}");
    let now = profile(&file);
    assert_eq!(now.tools["weld gun"].load, Some((1.5, [0.0, 0.0, 0.06])));
    let bare = "bare=0,0,150,0,45,0,1.5";
    let add = ["profile", "add-tool", "mine.yaml", bare, "-o", "bare.yaml"];
    let (status, out, error) = reported(folder.path(), &add);
    assert_eq!(status, Some(0), "{error}");
    let said = out + &error;
    assert!(said.contains("are taken to be at the flange"), "{said}");
    assert_eq!(
        now.effects,
        profile(&repository("robots/abb_irb120_thesis.yaml")).effects
    );
    for (arguments, says) in [
        (
            &["set", "mine.yaml", "robot.seriel=1", "--in-place"][..],
            "seriel",
        ),
        (
            &[
                "set",
                "mine.yaml",
                "kinematics.joints.7.max_deg=1",
                "--in-place",
            ],
            "no `7`",
        ),
        (
            &[
                "set",
                "mine.yaml",
                "kinematics.joints.3.max_deg=-170",
                "--in-place",
            ],
            "not below",
        ),
        (
            &[
                "set",
                "mine.yaml",
                "kinematics.joints.3.max_deg=x",
                "--in-place",
            ],
            "a number is expected",
        ),
        (
            &[
                "set",
                "mine.yaml",
                "controller.language=rapit",
                "--in-place",
            ],
            "did you mean `rapid`",
        ),
        (&["set", "mine.yaml", "serial", "--in-place"], "no `=`"),
        (
            &[
                "add-tool",
                "mine.yaml",
                "weld gun=0,0,150,0,0,0",
                "--in-place",
            ],
            "already",
        ),
        (
            &[
                "add-tool",
                "mine.yaml",
                "heavy=0,0,150,0,0,0,50",
                "-o",
                "other.yaml",
            ],
            "50",
        ),
        (
            &["set", "mine.yaml", "robot.serial=2", "-o", "mine.yaml"],
            "exists",
        ),
    ] {
        let before = std::fs::read(&file).expect("a file");
        let (status, out, error) = reported(folder.path(), &[&["profile"], arguments].concat());
        assert_eq!(
            (status, out.as_str()),
            (Some(2), ""),
            "{arguments:?} {error}"
        );
        assert!(words(&error).contains(says), "{arguments:?}: {error}");
        assert_eq!(std::fs::read(&file).expect("a file"), before);
        assert!(!folder.path().join("other.yaml").exists());
    }
}

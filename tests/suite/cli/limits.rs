//! What is too large, too small or another file's is refused before anything is written.

use crate::support::{files_below, poseshift, repository, scratch, text};
use poseshift::program::{LANGUAGES, Marker};
use std::path::Path;

const DEBURR: &str = "programs/rapid/olp/in/Deburr.mod";
const THESIS: &str = "robots/abb_irb120_thesis.yaml";
const UR: &str = "programs/urscript/profile.yaml";
const BRACKET: &str = "programs/urscript/olp/in/Deburr_bracket.script";

/// A file of the repository with one text in the place of another.
pub(super) fn changed(file: &str, old: &str, new: &str) -> String {
    let before = text(file);
    assert!(before.contains(old), "{file}: {old}");
    before.replacen(old, new, 1)
}

/// Runs a command in a folder; its status and all that it says.
pub(super) fn run_in(folder: &Path, words: &[&str]) -> (i32, String) {
    let output = poseshift()
        .current_dir(folder)
        .args(words)
        .output()
        .expect("the program starts");
    let said = String::from_utf8_lossy(&output.stderr).into_owned()
        + &String::from_utf8_lossy(&output.stdout);
    let said = said.split_whitespace().collect::<Vec<_>>().join(" ");
    (output.status.code().unwrap_or(-1), said)
}

/// Compensates one program with one profile; status, what is said, and what is written.
pub(super) fn compensated(
    name: &str,
    program: &str,
    profile: &str,
    more: &[&str],
) -> (i32, String, Option<String>) {
    let folder = scratch();
    let out = format!("out_{name}");
    std::fs::write(folder.path().join(name), program).expect("scratch");
    std::fs::write(folder.path().join("robot.yaml"), profile).expect("scratch");
    let mut words = vec!["compensate", name, "--profile", "robot.yaml", "-o", &out];
    words.extend(more);
    let (status, said) = run_in(folder.path(), &words);
    let written = std::fs::read_to_string(folder.path().join(&out)).ok();
    (status, said, written)
}

#[test]
fn nothing_wrong_leaves_in_silence() {
    let (deburr, thesis) = (text(DEBURR), text(THESIS));
    let link = "theta_deg: 0.054, d_mm: 0.006}";
    let ur = "theta_deg: 0.12102099278859778";
    let profile = |old: &str, new: &str| (deburr.clone(), changed(THESIS, old, new));
    let program = |new: &str| (changed(DEBURR, "[1.4,[0,0,60]", new), thesis.clone());
    let rows = [
        (
            "theta_deg",
            profile(link, "theta_deg: 90, d_mm: 0.006}"),
            2,
            "90",
        ),
        ("a_mm", profile("a_mm: 0.236", "a_mm: 50"), 2, "50"),
        ("rad_per_n_m", profile("1.3e-4}", "0.01}"), 2, "0.01"),
        ("x_mm", profile("x_mm: -0.075", "x_mm: 75"), 2, "75"),
        ("shift-too-large", program("[140,[0,0,60]"), 1, "20.000 mm"),
    ];
    for (what, (program, profile), status, value) in rows {
        let (is, said, written) = compensated("a.mod", &program, &profile, &[]);
        assert_eq!(is, status, "{what}: {said}");
        assert!(
            said.contains(what) && said.contains(value),
            "{what}: {said}"
        );
        assert_eq!(written, None, "{what}");
        if status == 2 {
            // the file, the line and the way out
            let line = profile
                .lines()
                .position(|l| l.contains(&format!("{what}: {value}")));
            let place = format!("robot.yaml:{}:", line.expect("the line") + 1);
            assert!(
                said.contains(&place) && said.contains("large: true"),
                "{said}"
            );
        }
    }
    let large = changed(UR, ur, "theta_deg: 1e155");
    let (status, said, written) = compensated("a.script", &text(BRACKET), &large, &[]);
    assert!(status == 2 && said.contains("theta_deg"), "{said}");
    assert_eq!(written, None);
    // what the profile means is no number all the same, whatever else is allowed
    let meant = changed(UR, ur, "large: true, reason: \"a test\", theta_deg: 1e155");
    for more in [&[][..], &["--keep-going", "--max-shift", "1000,180"]] {
        let (status, said, written) = compensated("a.script", &text(BRACKET), &meant, more);
        assert!(status == 1 || status == 2, "{status} {said}");
        assert!(
            said.contains("not-finite") || said.contains("within reach"),
            "{said}"
        );
        assert!(
            written.is_none_or(|text| !text.contains("p[0,0,0,0,0,0]")),
            "{said}"
        );
    }
    let (status, said, _) = compensated(
        "a.script",
        &text(BRACKET),
        &text(UR),
        &["--accept", "not-finite"],
    );
    assert!(status == 2 && said.contains("cannot be accepted"), "{said}");
}

#[test]
fn the_limit_of_shifts_is_raised_by_the_user_and_recorded() {
    let heavy = changed(DEBURR, "[1.4,[0,0,60]", "[140,[0,0,60]");
    let thesis = text(THESIS);
    let (status, said, written) = compensated(
        "a.mod",
        &heavy,
        &thesis,
        &["--max-shift", "100mm,20deg", "--keep-going"],
    );
    assert_eq!(status, 0, "{said}");
    assert!(
        written
            .expect("a program")
            .contains("! max-shift 100mm,20deg")
    );
    let (status, said, written) = compensated("a.mod", &heavy, &thesis, &["--max-shift", "100,20"]);
    assert_eq!(status, 0, "{said}");
    assert!(
        written
            .expect("a program")
            .contains("! max-shift 100mm,20deg")
    );
    // the hint names what all of them need, and works
    let (status, said, _) = compensated("a.mod", &heavy, &thesis, &["--max-shift", "1,1"]);
    assert_eq!(status, 1, "{said}");
    let limits: Vec<&str> = (said.split("--max-shift ").skip(1))
        .filter_map(|behind| behind.split_whitespace().next())
        .filter(|limit| limit.contains(','))
        .collect();
    let [limit] = limits[..] else {
        panic!("{said}")
    };
    let (status, said, _) = compensated("a.mod", &heavy, &thesis, &["--max-shift", limit]);
    assert_eq!(status, 0, "{limit}: {said}");
    // with --keep-going such targets stay as they are
    let (status, said, written) = compensated("a.mod", &heavy, &thesis, &["--keep-going"]);
    assert_eq!(status, 1, "{said}");
    let stays = heavy
        .lines()
        .find(|line| line.contains("MoveL [["))
        .map(str::trim);
    let written = written.expect("a program");
    assert!(stays.is_none_or(|line| written.contains(line)), "{said}");
    for nonsense in ["0,1", "30", "30deg,3mm", "NaN,1", "-5,1"] {
        let option = format!("--max-shift={nonsense}");
        let (status, said, _) = compensated("a.mod", &heavy, &thesis, &[&option]);
        assert!(
            status == 2 && said.contains("30mm,3deg"),
            "{nonsense}: {said}"
        );
    }
}

/// Where the rest of an arm is stiff up to a torque that it reaches nearly outstretched alone, its
/// effects usually do what the other ones do: a link that is 0.05 mm longer shifts the tool by that
/// everywhere.
#[test]
fn the_limit_of_shifts_is_ten_times_what_the_effects_do_in_95_of_100_postures() {
    let nominal = text("robots/abb_irb120.yaml");
    let plain = &nominal[..nominal.find("calibration:").expect("a list of effects")];
    let stiff_below_33_7_nm = "{effect: joint_compliance, joint: 2, rad_per_n_m: 3e-3}, {effect: \
        compliance_knee, joint: 2, torque_n_m: 33.7, rad_per_n_m: -3e-3}";
    let profile = |more: &str| {
        let long = "{effect: link_geometry, link: 2, a_mm: 0.05}";
        format!("{plain}calibration: {{effects: [{long}{more}]}}\n")
    };
    // 34.4 N m about axis 2, of 34.9 at most; 97 of 100 random postures have less than 33.7
    let program = "MODULE far\nPERS tooldata t1:=[TRUE,[[0,0,0],[1,0,0,0]],[1.4,[0,0,60],\
        [1,0,0,0],0,0,0]];\nPROC main()\nMoveAbsJ [[0,88,-80,0,10,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,\
        fine,t1;\nMoveL [[647.114666,0,304.462129],[0.58778525,0,0.80901699,0],[0,0,0,0],\
        [9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,t1;\nENDPROC\nENDMODULE\n";
    let (status, said, written) = compensated("far.mod", program, &profile(""), &[]);
    assert_eq!(status, 0, "{said}");
    assert!(
        written.is_some() && said.contains("largest 0.050 mm"),
        "{said}"
    );
    let more = format!(", {stiff_below_33_7_nm}");
    let (status, said, written) = compensated("far.mod", program, &profile(&more), &[]);
    assert_eq!(status, 1, "{said}");
    assert!(said.contains("shift-too-large"), "{said}");
    assert!(said.contains("the limit is 0.500 mm"), "{said}");
    assert_eq!(written, None);
}

#[test]
fn a_load_that_the_profile_does_not_know_does_not_raise_the_limit_of_shifts() {
    // the thesis's tool weighs 2.6 kg: this arm bends by 0.03 mm under it and itself
    let effect = |line: &&str| !line.contains("{effect:");
    let thesis: String = text(THESIS)
        .lines()
        .filter(effect)
        .map(|line| format!("{line}\n"))
        .collect();
    let stiff = "  effects:\n    - {effect: joint_compliance, joint: 2, rad_per_n_m: 1.0e-6}\n";
    let profile = thesis.replacen("  effects:\n", stiff, 1);
    let with = |kg: &str| changed(DEBURR, "[1.4,[0,0,60]", &format!("[{kg},[0,0,60]"));
    let (status, said, _) = compensated("a.mod", &with("1.4"), &profile, &[]);
    assert_eq!(status, 0, "{said}");
    let (status, said, written) = compensated("a.mod", &with("1000"), &profile, &[]);
    assert!(status == 1 && written.is_none(), "{said}");
    assert!(said.contains("the limit is 0.295 mm"), "{said}");
    // nobody accepts it by name: how far it may shift is to be said
    let accept = ["--accept", "shift-too-large"];
    let (status, said, written) = compensated("a.mod", &with("1000"), &profile, &accept);
    assert!(status == 2 && written.is_none(), "{said}");
    let raised = ["--max-shift", "5mm,1deg"];
    let (status, said, _) = compensated("a.mod", &with("1000"), &profile, &raised);
    assert_eq!(status, 0, "{said}");
}

#[test]
fn what_no_arm_has_is_refused_before_anything_is_followed() {
    let heavy = changed(DEBURR, "[1.4,[0,0,60]", "[1e12,[0,0,60]");
    let far_load = changed(DEBURR, "[1.4,[0,0,60]", "[1.4,[0,0,60000]");
    let far_frame = changed(BRACKET, "p[-0.125000", "p[-1e308");
    for (name, program, profile, words) in [
        ("a.mod", &heavy, THESIS, ["a.mod:", "1e12 kg", "10000 kg"]),
        ("a.mod", &far_load, THESIS, ["a.mod:", "6e4 mm", "2008 mm"]),
        (
            "a.script",
            &far_frame,
            UR,
            ["a.script:", "`bracket`", "1000000 mm"],
        ),
    ] {
        let (status, said, written) = compensated(name, program, &text(profile), &[]);
        assert!(status == 2 && written.is_none(), "{said}");
        let folder = scratch();
        std::fs::write(folder.path().join(name), program).expect("scratch");
        std::fs::write(folder.path().join("robot.yaml"), text(profile)).expect("scratch");
        let checked = run_in(folder.path(), &["check", name, "--profile", "robot.yaml"]);
        assert_eq!(checked.0, 2, "{}", checked.1);
        for word in words {
            assert!(
                said.contains(word) && checked.1.contains(word),
                "{word}: {said}"
            );
        }
    }
    let far = changed(BRACKET, "p[0.238979,", "p[1e290,");
    let (status, said, written) = compensated("a.script", &far, &text(UR), &[]);
    assert!(status == 1 && written.is_none(), "{said}");
    assert!(
        said.contains("out-of-reach") && said.contains("1000000 mm"),
        "{said}"
    );
    let tiny = changed(
        BRACKET,
        "p[0.012500,-0.030000,0.145000",
        "p[0.0000125,-0.00003,0.000145",
    );
    let (status, said, _) = compensated("a.script", &tiny, &text(UR), &[]);
    // where a controller is taught its bare flange, such a tool comes out
    assert!(status == 0 && said.contains("warning[tool-unit]"), "{said}");
}

#[test]
fn other_units_are_questioned() {
    let thesis = text(THESIS);
    let tiny = changed(
        DEBURR,
        "[[12.500, -3.250, 128.400]",
        "[[0.0125, -0.00325, 0.1284]",
    );
    let (status, said, _) = compensated("a.mod", &tiny, &thesis, &[]);
    assert_eq!(status, 1, "{said}");
    for word in ["tool-unit", "rdkTool", "0.1284 mm", "1 mm", "a.mod:"] {
        assert!(said.contains(word), "{word}: {said}");
    }
    let (status, said, _) = compensated("a.mod", &tiny, &thesis, &["--accept", "tool-unit"]);
    assert_eq!(status, 0, "{said}");
    for (old, new, value) in [
        (
            "0.145000,0.000000,0.436332,0.000000]",
            "0.145,0,25,0]",
            "25",
        ),
        ("0.040000,0.000000,0.000000,0.523599]", "0.04,0,0,30]", "30"),
        (".21778, -2.58430, -.09859]", "12.5, -155, -5.6]", "-155"),
    ] {
        let program = changed(BRACKET, old, new);
        let (status, said, _) = compensated("a.script", &program, &text(UR), &[]);
        assert_eq!(status, 1, "{said}");
        assert!(
            said.contains("angle-too-large") && said.contains(value),
            "{said}"
        );
        assert!(
            said.contains("a.script:") && said.contains("radians"),
            "{said}"
        );
    }
    let options: [(&[&str], &str); 6] = [
        (&["--tool", "nope=0,0,50,0,0,0"], "`nope`"),
        (&["--frame", "nope=0,0,50,0,0,0"], "`nope`"),
        (&["--tool", "rdkTool=0,0,50,0,0,0"], "themselves"),
        (&["--tool", "0,0,50,0,1000,0"], "720 deg"),
        (&["--tool", "0,0,100,0,0,0"], "--tool without a name"),
        (&["--frame", "1,2,3,0,0,0"], "--frame without a name"),
    ];
    for (more, word) in options {
        let (status, said, _) = compensated("a.mod", &text(DEBURR), &thesis, more);
        assert!(status == 2 && said.contains(word), "{more:?}: {said}");
    }
}

#[test]
fn names_of_tools_are_read_in_any_case_and_others_are_reported() {
    let effect = |tool: &str| {
        let entry = format!("  effects:\n    - {{effect: tool_frame, tool: {tool}, x_mm: 0.5}}\n");
        changed(THESIS, "  effects:\n", &entry)
    };
    let deburr = text(DEBURR);
    let of = |tool: &str| compensated("a.mod", &deburr, &effect(tool), &[]);
    let numbers = |written: Option<String>| {
        let written = written.expect("a program");
        let lines = written.lines().filter(|line| line.contains("MoveL [["));
        lines.map(str::to_owned).collect::<Vec<_>>()
    };
    let (status, said, right) = of("rdkTool");
    assert!(status == 0 && !said.contains("effect-unused"), "{said}");
    let (status, said, upper) = of("RDKTOOL");
    assert!(status == 0 && !said.contains("effect-unused"), "{said}");
    let (status, said, wrong) = of("rdkTol");
    assert_eq!(status, 0, "{said}");
    for word in [
        "effect-unused",
        "tool_frame",
        "`rdkTol`",
        "did you mean `rdkTool`?",
    ] {
        assert!(said.contains(word), "{word}: {said}");
    }
    let right = numbers(right);
    assert!(!right.is_empty());
    assert_eq!(right, numbers(upper));
    assert_ne!(right, numbers(wrong));
    // a tool of the profile that this program has not
    let (status, said, _) = of("artifact");
    assert!(status == 0 && !said.contains("effect-unused"), "{said}");
}

#[test]
fn a_mass_that_the_profile_has_under_another_name_is_reported() {
    let seal = text("programs/fanuc/olp/in/seal.ls");
    let profile = changed(
        "programs/fanuc/profile.yaml",
        "\n  \"1\": {",
        "\n  gripper: {",
    );
    let with = |tool: &str| {
        let more = ["--tool", tool, "--frame", "4=1400,350,-200,0,0,-15"];
        compensated("seal.ls", &seal, &profile, &more)
    };
    let (status, said, _) = with("1=85,0,420,0,30,0");
    assert_eq!(status, 0, "{said}");
    for word in ["load-unknown", "tool `1`", "0 kg", "gripper"] {
        assert!(said.contains(word), "{word}: {said}");
    }
    let (status, said, _) = with("1=gripper");
    assert!(status == 0 && !said.contains("load-unknown"), "{said}");
}

#[test]
fn a_mass_that_nobody_gives_is_reported_with_what_a_kilogram_moves() {
    let seal = text("programs/fanuc/olp/in/seal.ls");
    let profile = text("programs/fanuc/profile.yaml");
    let massless: String = profile
        .lines()
        .filter(|line| !line.contains("mass_kg: 95") && !line.contains("mass_kg: 38"))
        .map(|line| line.replace("tools:", "tools: {}") + "\n")
        .collect();
    let with = |profile: &str| {
        let more = [
            "--tool",
            "1=85,0,420,0,30,0",
            "--frame",
            "4=1400,350,-200,0,0,-15",
        ];
        compensated("seal.ls", &seal, profile, &more)
    };
    let (status, said, _) = with(&massless);
    assert_eq!(status, 0, "{said}");
    for word in [
        "load-unknown",
        "tool `1`",
        "0 kg",
        "each kg moves",
        "add-tool",
    ] {
        assert!(said.contains(word), "{word}: {said}");
    }
    // an arm that nothing bends
    let rigid: String = massless
        .lines()
        .filter(|line| !line.contains("compliance"))
        .map(|line| format!("{line}\n"))
        .collect();
    let (status, said, _) = with(&rigid);
    assert!(status == 0 && !said.contains("load-unknown"), "{said}");
}

#[test]
fn loads_beyond_the_payload_are_errors() {
    let robot = "robot: {manufacturer";
    let limited = changed(THESIS, robot, "robot: {payload_kg: 2.7, manufacturer");
    let (status, said, _) = compensated("a.mod", &text(DEBURR), &limited, &[]);
    assert_eq!(status, 0, "{said}");
    let heavy = changed(DEBURR, "[1.4,[0,0,60]", "[2.8,[0,0,60]");
    let (status, said, _) = compensated("a.mod", &heavy, &limited, &[]);
    assert!(
        status == 1 && said.contains("load-beyond-payload"),
        "{said}"
    );
    assert!(said.contains("2.8 kg") && said.contains("2.7 kg"), "{said}");
    // however heavy, with a limit or without
    let heaviest = changed(DEBURR, "[1.4,[0,0,60]", "[9e3,[0,0,60]");
    let (status, said, _) = compensated("a.mod", &heaviest, &limited, &[]);
    assert!(
        status == 1 && said.contains("load-beyond-payload"),
        "{said}"
    );
    let (status, said, _) = compensated("a.mod", &heaviest, &text(THESIS), &[]);
    assert_eq!(status, 1, "{said}");
    let floating = changed(DEBURR, "[1.4,[0,0,60]", "[-1.4,[0,0,60]");
    let (status, said, _) = compensated("a.mod", &floating, &limited, &[]);
    assert!(status == 2 && said.contains("a.mod:8:"), "{said}");
    assert!(
        said.contains("-1.4") && said.contains("0 kg or more"),
        "{said}"
    );
    // what effects of the profile add counts for the mass of the program
    let heavier = |more: &str| {
        let entry =
            format!("effects:\n    - {{effect: payload_error, tool: rdkTool, mass_kg: 1.5{more}}}");
        limited.replacen("effects:", &entry, 1)
    };
    assert!(heavier("").contains("payload_error"));
    let (status, said, _) = compensated("a.mod", &text(DEBURR), &heavier(""), &[]);
    assert!(
        status == 1 && said.contains("1.4 kg, and 1.5 kg more by effects of the profile"),
        "{said}"
    );
    let meant = heavier(", large: true, reason: \"a hose\"");
    let (status, said, _) = compensated("a.mod", &text(DEBURR), &meant, &[]);
    assert_eq!(status, 0, "{said}");
    let light = changed(THESIS, robot, "robot: {payload_kg: 2.5, manufacturer");
    let (status, said, _) = compensated("a.mod", &text(DEBURR), &light, &[]);
    assert!(status == 2 && said.contains("`artifact` is 2.6"), "{said}");
}

#[test]
fn a_check_compares_with_the_files_of_the_marker() {
    let folder = scratch();
    let at = folder.path();
    std::fs::copy(repository(DEBURR), at.join("a.mod")).expect("scratch");
    std::fs::copy(repository(THESIS), at.join("robot.yaml")).expect("scratch");
    let words = [
        "compensate",
        "a.mod",
        "--profile",
        "robot.yaml",
        "-o",
        "out.mod",
    ];
    assert_eq!(run_in(at, &words).0, 0);
    let check = |nominal: &str, profile: &str, more: &[&str]| {
        let mut words = vec![
            "check",
            "out.mod",
            "--nominal",
            nominal,
            "--profile",
            profile,
        ];
        words.extend(more);
        run_in(at, &words)
    };
    assert_eq!(check("a.mod", "robot.yaml", &[]).0, 0);
    std::fs::write(at.join("b.mod"), text(DEBURR) + "\n").expect("scratch");
    std::fs::write(at.join("other.yaml"), text(THESIS) + "\n").expect("scratch");
    let (status, said) = check("b.mod", "robot.yaml", &[]);
    assert!(
        status == 2 && said.contains("out.mod:") && said.contains("b.mod has"),
        "{said}"
    );
    assert!(said.contains("--force"), "{said}");
    let (status, said) = check("a.mod", "other.yaml", &[]);
    assert!(status == 2 && said.contains("other.yaml has"), "{said}");
    assert_eq!(check("b.mod", "other.yaml", &["--force"]).0, 0);
    // in the places of each other, and alone
    let swapped = [
        "check",
        "a.mod",
        "--nominal",
        "out.mod",
        "--profile",
        "robot.yaml",
    ];
    let (status, said) = run_in(at, &swapped);
    assert!(
        status == 2 && said.contains("out.mod: --nominal takes original programs"),
        "{said}"
    );
    let (status, said) = run_in(at, &["check", "out.mod", "--profile", "robot.yaml"]);
    assert!(status == 0 && said.contains("nominal-missing"), "{said}");
    let (_, said) = run_in(at, &["check", "a.mod", "--profile", "robot.yaml"]);
    assert!(!said.contains("nominal-missing"), "{said}");
}

#[test]
fn programs_are_compared_with_the_originals_that_their_markers_or_paths_name() {
    let folder = scratch();
    let at = folder.path();
    let copy = |from: &str, to: &str| {
        std::fs::copy(at.join(from), at.join(to)).expect("scratch");
    };
    for name in ["in", "swapped", "other", "same"] {
        std::fs::create_dir(at.join(name)).expect("scratch");
    }
    let poses = "programs/csv/poses/in/inspection.csv";
    std::fs::write(at.join("in/a.csv"), text(poses)).expect("scratch");
    let moved = changed(poses, "460.500", "462.500");
    std::fs::write(at.join("in/b.csv"), moved).expect("scratch");
    std::fs::copy(
        repository("programs/inform/profile.yaml"),
        at.join("p.yaml"),
    )
    .expect("scratch");
    let given = ["--profile", "p.yaml", "--frame", "nest=430,-40,-120,0,0,20"];
    let run = |words: &[&str]| run_in(at, &[words, &given].concat());
    let (status, said) = run(&["compensate", "in", "-o", "out"]);
    assert_eq!(status, 0, "{said}");
    let (status, said) = run(&["check", "out", "--nominal", "in"]);
    assert_eq!(status, 0, "{said}");
    copy("out/a.csv", "swapped/b.csv");
    copy("out/b.csv", "swapped/a.csv");
    let error = |said: &str| {
        let line = said.lines().find(|line| line.contains("target error"));
        line.map(ToOwned::to_owned)
    };
    let named = error(&said);
    let (status, said) = run(&["check", "swapped", "--nominal", "in"]);
    assert_eq!(status, 0, "{said}");
    assert_eq!(error(&said), named, "each with the original of its marker");
    // in the order in which they are given
    let order = [
        "check",
        "out/b.csv",
        "out/a.csv",
        "--nominal",
        "in/a.csv",
        "--nominal",
        "in/b.csv",
    ];
    let (status, said) = run(&order);
    assert_eq!(status, 0, "{said}");
    // not marked, and called otherwise
    copy("in/a.csv", "other/x.csv");
    copy("in/b.csv", "other/y.csv");
    let (status, said) = run(&["check", "other", "--nominal", "in"]);
    assert_eq!(status, 2, "{said}");
    for word in [
        "other/x.csv: nothing tells",
        "in/a.csv, in/b.csv",
        "--force",
    ] {
        assert!(said.contains(word), "{word}: {said}");
    }
    // two made from one
    copy("out/a.csv", "same/a.csv");
    copy("out/a.csv", "same/b.csv");
    let (status, said) = run(&["check", "same", "--nominal", "in"]);
    assert_eq!(status, 2, "{said}");
    let both = "same/a.csv and same/b.csv have the same original, in/a.csv";
    assert!(said.contains(both), "{said}");
}

#[test]
fn a_marker_is_known_by_what_is_left_of_it() {
    let mut languages = 0;
    for language in LANGUAGES.iter().map(|language| language.about().id) {
        let folder = repository(&format!("programs/{language}"));
        let mut seen = 0;
        for file in files_below(&folder) {
            let name = file.to_string_lossy().into_owned();
            if !name.contains("out/") {
                continue;
            }
            let bytes = std::fs::read(folder.join(&file)).expect("a program");
            let Some(first) = Marker::find(&bytes) else {
                continue;
            };
            seen += 1;
            let mut end = first;
            while !matches!(bytes[end], b'\n' | b'\r') {
                end += 1;
            }
            let mut left = bytes.clone();
            left.drain(first..end);
            assert!(
                Marker::find(&left).is_some(),
                "{name}: without its first line"
            );
            assert!(
                Marker::find(&bytes.to_ascii_uppercase()).is_some(),
                "{name}"
            );
            let line = bytes[first..end].to_ascii_uppercase();
            assert!(Marker::find(&line).is_some(), "{name}: only its first line");
        }
        languages += usize::from(seen > 0);
    }
    assert_eq!(languages, LANGUAGES.len());
    for file in files_below(&repository("programs")) {
        if !file.components().any(|part| part.as_os_str() == "out") {
            let bytes = std::fs::read(repository("programs").join(&file)).expect("a file");
            assert_eq!(Marker::find(&bytes), None, "{}", file.display());
        }
    }
}

#[test]
fn a_cell_in_metres_or_with_angles_of_no_frame_is_refused() {
    let folder = scratch();
    let program = repository(DEBURR);
    let profile = repository(THESIS);
    let words = [
        "check",
        program.to_str().expect("UTF-8"),
        "--profile",
        profile.to_str().expect("UTF-8"),
        "--cell",
        "cell.yaml",
    ];
    let check = |body: &str| {
        let cell = format!("poseshift: cell/1\nbodies:\n  - {{name: fixture, {body}}}\n");
        std::fs::write(folder.path().join("cell.yaml"), cell).expect("scratch");
        run_in(folder.path(), &words)
    };
    let at = |rz: &str| {
        format!("at: {{x_mm: 3000, y_mm: 0, z_mm: 0, rx_deg: 0, ry_deg: 0, rz_deg: {rz}}}")
    };
    for (body, says) in [
        (
            format!("box_mm: [0.3, 0.6, 0.2], {}", at("0")),
            "0.6 mm at most",
        ),
        (
            format!("cylinder_mm: {{radius: 0.04, height: 0.9}}, {}", at("0")),
            "in metres",
        ),
        (
            format!("box_mm: [300, 600, 200], {}", at("1000")),
            "rz_deg is 1000",
        ),
    ] {
        let (status, said) = check(&body);
        assert_eq!(status, 2, "{body}: {said}");
        assert!(
            said.contains(says) && said.contains("cell.yaml:3"),
            "{said}"
        );
    }
    // the ball of a stylus is small and none of them
    let (status, said) = check(&format!("sphere_mm: {{radius: 0.5}}, {}", at("0")));
    assert_eq!(status, 0, "{said}");
}

#[test]
fn options_that_no_arm_can_follow_are_refused_with_their_limit() {
    let (deburr, thesis) = (text(DEBURR), text(THESIS));
    let start = |joints: &'static str| ["--start-joints", joints];
    for (more, wanted) in [
        (
            ["--max-shift", "1e308,1e308"],
            "at most 1000 mm and 180 deg",
        ),
        (
            ["--max-shift", "1001mm,1deg"],
            "at most 1000 mm and 180 deg",
        ),
        (["--max-shift", "1mm,181deg"], "at most 1000 mm and 180 deg"),
        (start("1e308,0,0,0,30,0"), "joint 1 is 1e308 deg"),
        // J6 goes from -400 to 400 deg
        (
            start("0,0,0,0,30,9999"),
            "its limits are -400.000 to 400.000",
        ),
        (start("0,0,0,0,30,-761"), "more than a rotation beyond"),
    ] {
        let (status, said, written) = compensated("a.mod", &deburr, &thesis, &more);
        assert_eq!(status, 2, "{more:?}: {said}");
        assert!(said.contains(wanted), "{more:?}: {said}");
        assert_eq!(written, None, "{more:?}");
    }
    for more in [["--max-shift", "1000mm,180deg"], start("0,0,0,0,30,759")] {
        let (status, said, _) = compensated("a.mod", &deburr, &thesis, &more);
        assert!(status < 2, "{more:?}: {said}");
    }
    let points = |name: &str| repository(&format!("tests/data/register/{name}.csv"));
    let [from, to] = ["from", "to"].map(points);
    let [from, to] = [&from, &to].map(|path| path.to_str().expect("a name"));
    let folder = scratch();
    for (at, status) in [("1e308,0,0", 2), ("0,-1.1e6,0", 2), ("1e5,0,0", 0)] {
        let words = ["register", from, to, "--at", at];
        let (found, said) = run_in(folder.path(), &words);
        assert_eq!(found, status, "{at}: {said}");
        assert_eq!(status == 2, said.contains("at most 1e6"), "{at}: {said}");
    }
}

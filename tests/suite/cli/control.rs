//! No file steers a terminal: control characters of names, ids and texts are shown by their codes.

use crate::support::{poseshift, repository, scratch, text};
use std::path::Path;

const PROFILE: &str = "robots/abb_irb120_thesis.yaml";
const SAMPLE: &str = "programs/rapid/olp/in/Deburr.mod";
/// Clears a screen, sets its title, writes over the line, turns the writing round.
const EVIL: &str = "x\u{1b}[2J\u{1b}]0;title\u{7}\u{9b}31m\r\u{202e}y";

/// A text in the quotes of YAML.
fn yaml(text: &str) -> String {
    let sign = |c: char| match c {
        '"' | '\\' => format!("\\{c}"),
        c if c.is_ascii_graphic() || c == ' ' => c.to_string(),
        c => format!("\\u{:04x}", u32::from(c)),
    };
    format!("\"{}\"", text.chars().map(sign).collect::<String>())
}

/// Asserts that nothing of a run would steer a terminal; what it says.
fn run(folder: &Path, arguments: &[&str], steers: &str) -> String {
    let output = poseshift().current_dir(folder).args(arguments).output();
    let output = output.expect("the program starts");
    let said =
        [output.stdout, output.stderr].map(|bytes| String::from_utf8_lossy(&bytes).into_owned());
    for text in &said {
        let raw = text.replace("\r\n", "\n");
        let found = raw
            .chars()
            .find(|c| (c.is_control() && *c != '\n') || *c == '\u{202e}');
        assert_eq!(found, None, "{arguments:?}: {text:?}");
    }
    let said = said.concat();
    assert!(said.contains(steers), "{arguments:?}: {said}");
    said
}

#[cfg(unix)]
#[test]
fn names_of_files_are_shown_by_their_codes() {
    let folder = scratch();
    let path = folder.path();
    std::fs::copy(repository(PROFILE), path.join("p.yaml")).expect("scratch");
    let name = format!("{EVIL}\n.mod");
    let code = "u{1b}[2J";
    std::fs::create_dir(path.join("in")).expect("scratch");
    std::fs::copy(repository(SAMPLE), path.join("in").join(&name)).expect("scratch");
    let file = format!("in/{name}");
    let profile = ["--profile", "p.yaml"];
    // texts that name no file
    for command in [&["check", file.as_str()][..], &["check", "in", "-v"]] {
        run(path, &[command, &profile].concat(), "");
    }
    for command in [
        &["check", file.as_str(), "--json"][..],
        &["check", "in", "--json"],
        &["check", "in", "--max-path-error", "0.001"],
        &["compensate", "in", "-o", "out"],
        &["compensate", &file, "-o", &format!("{EVIL}.out")],
        &["compensate", &file, "-o", &file],
        &["compensate", &format!("{EVIL} is not there"), "-o", "out"],
        &["check", "in", "--junit", &format!("{EVIL}/x.xml/")],
        &["check", "in", "--ignore", &format!("{{{EVIL}")],
        &["compensate", "in", "-o", "out", "--accept", EVIL],
        &[
            "compensate",
            "in",
            "-o",
            "out",
            "--tool",
            &format!("{EVIL}=0,0,0,0,0,0"),
        ],
        &["compensate", "in", "-o", "out", "--language", EVIL],
    ] {
        run(path, &[command, &profile].concat(), code);
    }
    // what the parser of arguments says has no escape sequences at all
    run(path, &[EVIL], "u{9b}31m");
    run(path, &["compensate", &format!("--{EVIL}")], "u{9b}31m");
    run(
        path,
        &["check", &file, "--profile", &format!("{EVIL}.yaml")],
        code,
    );
    // one line stays one
    let said = run(path, &["check", "in", "--profile", "p.yaml"], "");
    assert!(!said.lines().any(|line| line.starts_with(".mod")), "{said}");
}

#[test]
fn what_profiles_cells_and_programs_say_is_shown_by_its_code() {
    let folder = scratch();
    let path = folder.path();
    let code = "\\u{1b}[2J";
    let quoted = yaml(EVIL);
    let profile = text(PROFILE);
    let line = profile
        .lines()
        .find(|line| line.starts_with("robot:"))
        .expect("a robot");
    let named = format!("robot: {{manufacturer: {quoted}, model: {quoted}, serial: {quoted}}}");
    let profile = profile.replace(line, &named);
    std::fs::write(path.join("p.yaml"), &profile).expect("scratch");
    run(path, &["profile", "show", "p.yaml"], code);
    run(
        path,
        &[
            "profile",
            "diff",
            "p.yaml",
            repository(PROFILE).to_str().expect("a name"),
        ],
        code,
    );

    let cell = format!(
        "poseshift: cell/1\nbodies:\n  - {{name: {quoted}, box_mm: [4000, 4000, 4000], at: {{x_mm: \
         0, y_mm: 0, z_mm: 0, \
         rx_deg: 0, ry_deg: 0, rz_deg: 0}}}}\n"
    );
    std::fs::write(path.join("cell.yaml"), cell).expect("scratch");
    std::fs::copy(repository(SAMPLE), path.join("in.mod")).expect("scratch");
    run(
        path,
        &[
            "check",
            "in.mod",
            "--profile",
            "p.yaml",
            "--cell",
            "cell.yaml",
        ],
        code,
    );

    // the line of an error, and a value in it
    let broken = format!("{profile}\n\"{}\": 1\n", "a\\e[2J");
    std::fs::write(path.join("broken.yaml"), broken).expect("scratch");
    run(path, &["profile", "show", "broken.yaml"], code);
    let mut program = text(SAMPLE);
    let last = program.rfind("[[").expect("a target");
    program.insert_str(last + 2, EVIL);
    std::fs::write(path.join("bad.mod"), program).expect("scratch");
    run(
        path,
        &["check", "bad.mod", "--profile", "p.yaml"],
        "bad.mod",
    );

    // ids of tables
    let joints = format!(
        "id,q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg,x_mm,y_mm,z_mm\n\"{EVIL}\",0,0,0,0,30,0,400,0,x\n"
    );
    std::fs::write(path.join("m.csv"), joints).expect("scratch");
    run(
        path,
        &["validate", "--profile", "p.yaml", "--measurements", "m.csv"],
        "m.csv",
    );
    let points = |noise: &str| {
        format!("id,x_mm,y_mm,z_mm\n\"{EVIL}\",0,0,{noise}\nb,500,0,0\nc,0,500,0\nd,300,300,200\n")
    };
    std::fs::write(path.join("a.csv"), points("0")).expect("scratch");
    std::fs::write(path.join("b.csv"), points("3")).expect("scratch");
    run(path, &["register", "a.csv", "b.csv", "-v"], code);
}

#[test]
fn what_is_written_for_programs_is_written_as_it_is() {
    let folder = scratch();
    let path = folder.path();
    std::fs::copy(repository(PROFILE), path.join("p.yaml")).expect("scratch");
    let joints = format!("id,q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg\n\"{EVIL}\",0,0,0,0,30,0\n");
    std::fs::write(path.join("q.csv"), joints).expect("scratch");
    let output = poseshift()
        .current_dir(path)
        .args(["fk", "--profile", "p.yaml", "--joints", "q.csv"])
        .output()
        .expect("the program starts");
    assert!(String::from_utf8_lossy(&output.stdout).contains(EVIL));
}

#[test]
fn names_are_quoted_in_written_profiles() {
    let folder = scratch();
    let path = folder.path();
    // what YAML would take for something else
    for name in [
        "no", "null", "1e3", "a: b", "- x", "#", "~", "'", "\"", "x\\", EVIL, "0x1F", "*a", "{}",
        "ü",
    ] {
        let quoted = yaml(name);
        let profile = text(PROFILE).replace("artifact", &quoted);
        std::fs::write(path.join("p.yaml"), profile).expect("scratch");
        for arguments in [
            &[
                "plan",
                "--count",
                "30",
                "--candidates",
                "200",
                "-o",
                "q.csv",
            ][..],
            &[
                "simulate",
                "--joints",
                "q.csv",
                "--noise-mm",
                "0.02",
                "-o",
                "m.csv",
            ],
            &[
                "calibrate",
                "--measurements",
                "m.csv",
                "--level",
                "1",
                "-o",
                "c.yaml",
            ],
        ] {
            let output = poseshift()
                .current_dir(path)
                .args(arguments)
                .args(["--profile", "p.yaml"])
                .output();
            let output = output.expect("the program starts");
            let reported = String::from_utf8_lossy(&output.stderr);
            assert_eq!(output.status.code(), Some(0), "{name:?}: {reported}");
        }
        let output = poseshift()
            .current_dir(path)
            .args(["profile", "show", "c.yaml", "--json"])
            .output();
        let output = output.expect("the program starts");
        let shown = String::from_utf8_lossy(&output.stdout).into_owned();
        assert_eq!(output.status.code(), Some(0), "{name:?}: {shown}");
        let facts: serde_json::Value = serde_json::from_str(&shown).expect("JSON");
        let fact = serde_json::Value::from(format!("tool {name}")).to_string();
        assert!(facts.to_string().contains(&fact), "{name:?}: {shown}");
    }
}

#[test]
fn names_of_a_urdf_are_quoted_and_its_comments_stay_comments() {
    let folder = scratch();
    let path = folder.path();
    let joint = |k: usize, axis: &str| {
        format!(
            "<link name='l{k}'/><joint name='j{k}' type='revolute'><parent link='l{}'/><child \
             link='l{k}'/>\
             <origin xyz='0 0 0.3'/><axis xyz='{axis}'/><limit lower='-3' upper='3' velocity='2' \
                 effort='1'/></joint>",
            k - 1
        )
    };
    let axes = ["0 0 1", "0 1 0", "0 1 0", "0 0 1", "0 1 0", "0 0 1"];
    let joints: String = (1..7).map(|k| joint(k, axes[k - 1])).collect();
    for (name, status) in [
        ("no", 0),
        ("1e3", 0),
        ("a: b #", 0),
        // what could forge a line is refused
        ("x&#10;tools: {evil: 1}", 2),
        ("x\u{85}y", 2),
    ] {
        let urdf = format!("<robot name=\"{name}\"><link name='l0'/>{joints}</robot>");
        std::fs::write(path.join("a\ntools: 1.urdf"), urdf).expect("scratch");
        let _ = std::fs::remove_file(path.join("p.yaml"));
        let made = [
            "profile",
            "from-urdf",
            "a\ntools: 1.urdf",
            "-o",
            "p.yaml",
            "--no-shapes",
        ];
        let output = poseshift()
            .current_dir(path)
            .args(made)
            .output()
            .expect("the program starts");
        let reported = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(status), "{name}: {reported}");
        assert_eq!(path.join("p.yaml").exists(), status == 0, "{name}");
        if status == 2 {
            let stray = reported.chars().find(|c| c.is_control() && *c != '\n');
            assert!(
                stray.is_none() && reported.contains("the name of the robot"),
                "{reported}"
            );
            continue;
        }
        let written = std::fs::read_to_string(path.join("p.yaml")).expect("written");
        let stray = written.chars().find(|c| c.is_control() && *c != '\n');
        assert_eq!(stray, None, "{name}");
        assert_eq!(
            written
                .lines()
                .filter(|line| line.starts_with("tools:"))
                .count(),
            1,
            "{written}"
        );
    }
}

//! `check` and `compensate --max-path-error` from the command line.

use super::joint_move;
use crate::support::{repository, run, scratch};
use serde_json::Value;
use std::path::Path;

const PROFILE: &str = "robots/abb_irb120_thesis.yaml";

const PROGRAM: &str = "MODULE t
  PERS tooldata artifact := [TRUE,[[50,25,100],[1,0,0,0]],[2.6,[-23,0,100],[1,0,0,0],0,0,0]];
  CONST jointtarget home := [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p1 := [[430.123,-200.456,300.789],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p2 := [[430.123,200.456,300.789],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p3 := [[380,0,300],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveAbsJ home,v1000,z10,artifact;
    MoveJ p1,v200,fine,artifact;
    MoveL p2,v100,z10,artifact;
    MoveC p3,p1,v100,fine,artifact;
  ENDPROC
ENDMODULE
";

fn json(arguments: &[&str]) -> (i32, Value) {
    let all: Vec<&str> = arguments.iter().copied().chain(["--json"]).collect();
    let (status, out, error) = run(&all);
    (
        status,
        serde_json::from_str(&out).unwrap_or_else(|_| panic!("{out} {error}")),
    )
}

pub(super) fn name(path: &Path) -> &str {
    path.to_str().expect("UTF-8")
}

#[test]
fn inserted_targets_bring_the_path_within_the_limit_and_arcs_stay_arcs() {
    let folder = scratch();
    let (program, plain, fine) = (
        folder.path().join("t.mod"),
        folder.path().join("plain.mod"),
        folder.path().join("fine.mod"),
    );
    std::fs::write(&program, PROGRAM).expect("scratch");
    let compensate = ["compensate", name(&program), "--profile", PROFILE, "-o"];
    let (status, ..) = run(&[&compensate[..], &[name(&plain)]].concat());
    assert_eq!(status, 0);
    let (status, out, error) =
        run(&[&compensate[..], &[name(&fine), "--max-path-error", "0.05"]].concat());
    assert_eq!(status, 0, "{out}{error}");
    assert!(out.contains("moves inserted"), "{out}");
    // the first move comes from a joint target that stays
    assert!(out.contains("warning[path-from-kept-target]"), "{out}");
    let check = |file: &Path| {
        json(&[
            "check",
            name(file),
            "--profile",
            PROFILE,
            "--nominal",
            name(&program),
        ])
        .1
    };
    let worst = |report: &Value, kind: &str| {
        let moves = report["moves"].as_array().expect("moves");
        let of_kind = moves.iter().filter(|m| m["kind"] == kind);
        of_kind
            .filter_map(|m| m["max_path_error_mm"].as_f64())
            .fold(0.0, f64::max)
    };
    let (before, after) = (check(&plain), check(&fine));
    assert!(
        worst(&before, "linear") > 0.05,
        "{}",
        worst(&before, "linear")
    );
    assert!(worst(&before, "linear") < 1.0);
    // targets themselves land where they should
    assert!(
        worst(&after, "linear") <= 0.05 && worst(&after, "arc") <= 0.05,
        "{}",
        after["moves"]
    );
    let text = std::fs::read_to_string(&fine).expect("written");
    assert!(text.matches("MoveC").count() > 1, "{text}");
    assert_eq!(
        text.matches("MoveC").count(),
        text.matches(",v100,fine,artifact;").count()
    );
    // refined again from the original it is the same, byte for byte
    let again = folder.path().join("again.mod");
    run(&[&compensate[..], &[name(&again), "--max-path-error", "0.05"]].concat());
    assert_eq!(std::fs::read(&again).expect("written"), text.into_bytes());
}

#[test]
fn a_baseline_catches_a_changed_decimal_and_a_build_server_is_reported() {
    let folder = scratch();
    let (program, base, xml) = (
        folder.path().join("t.mod"),
        folder.path().join("base.json"),
        folder.path().join("junit.xml"),
    );
    std::fs::write(&program, PROGRAM).expect("scratch");
    let command = [
        "check",
        name(&program),
        "--profile",
        PROFILE,
        "--baseline",
        name(&base),
    ];
    let (status, _, error) = run(&command);
    assert_eq!(status, 2, "there is none yet");
    assert!(error.contains("--update-baseline"), "{error}");
    assert_eq!(run(&[&command[..], &["--update-baseline"]].concat()).0, 0);
    let (status, out, _) = run(&command);
    assert!(
        status == 0 && out.contains("0 worse, 0 better, 4 moves the same"),
        "{out}"
    );
    std::fs::write(
        &program,
        PROGRAM.replace("430.123,200.456", "430.125,200.456"),
    )
    .expect("scratch");
    let (status, out, _) = run(&[&command[..], &["--junit", name(&xml)]].concat());
    assert_eq!(status, 1);
    assert!(out.contains("t.mod:10: worse: target ["), "{out}");
    let xml = std::fs::read_to_string(&xml).expect("written");
    assert!(
        xml.contains("<failure") && xml.contains("line 10: linear to p2"),
        "{xml}"
    );
    assert_eq!(xml.matches("<testcase").count(), 4, "{xml}");
    // a comment above moves lines, not moves
    std::fs::write(&program, PROGRAM.replace("  PROC", "  ! new\n  PROC")).expect("scratch");
    assert_eq!(run(&command).0, 0);
}

#[test]
fn a_cell_s_faults_and_its_missing_mesh_are_reported() {
    let folder = scratch();
    let (program, cell) = (folder.path().join("t.mod"), folder.path().join("cell.yaml"));
    std::fs::write(&program, PROGRAM).expect("scratch");
    let command = [
        "check",
        name(&program),
        "--profile",
        PROFILE,
        "--cell",
        name(&cell),
    ];
    let cases = [
        (
            "poseshift: cell/1\nbodies: [{name: a, mesh: none.stl}]\n",
            "cannot read the mesh",
        ),
        (
            "poseshift: cell/1\nbodies:\n  - {name: a, box_mm: [1, 2, 3], colour: red}\n",
            "colour",
        ),
        ("poseshift: cell/1\nbodies:\n  - {name: a}\n", "0 shapes"),
    ];
    for (text, says) in cases {
        std::fs::write(&cell, text).expect("scratch");
        let (status, out, error) = run(&command);
        assert_eq!((status, out.as_str()), (2, ""));
        assert!(
            error.contains(says) && error.contains("cell.yaml"),
            "{error}"
        );
    }
    // a cube as a mesh, in metres by mistake: 2000 m
    let cube = "v 0 0 0\nv 2000 0 0\nv 0 2000 0\nv 0 0 2000\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
    std::fs::write(folder.path().join("c.obj"), cube).expect("scratch");
    std::fs::write(
        &cell,
        "poseshift: cell/1\nbodies: [{name: c, mesh: c.obj, scale: 1000}]\n",
    )
    .expect("scratch");
    let (status, _, error) = run(&command);
    assert!(
        status == 2 && error.contains("2000 m") && error.contains("scale: 1"),
        "{error}"
    );
    // in millimetres the robot stands in it
    std::fs::write(
        &cell,
        "poseshift: cell/1\nbodies: [{name: c, mesh: c.obj, at: {x_mm: -500, \
        y_mm: -500, z_mm: -100, rx_deg: 0, ry_deg: 0, rz_deg: 0}}]\n",
    )
    .expect("scratch");
    let (status, report) = json(&command);
    assert_eq!(status, 1);
    let first = &report["findings"][0];
    assert!(
        first["message"]
            .as_str()
            .expect("text")
            .contains("inside c"),
        "{first}"
    );
}

#[test]
fn speed_zone_and_limits_are_reported() {
    let folder = scratch();
    let program = folder.path().join("t.mod");
    std::fs::write(&program, PROGRAM.replace("MoveL p2,v100", "MoveL p2,v7000")).expect("scratch");
    let (status, report) = json(&["check", name(&program), "--profile", PROFILE]);
    assert_eq!(status, 0, "{}", report["findings"]);
    let moves = report["moves"].as_array().expect("moves");
    assert_eq!((moves.len(), moves[2]["zone_mm"].as_f64()), (4, Some(10.0)));
    assert!((moves[2]["duration_s"].as_f64().expect("seconds") - 0.400_912 / 7.0).abs() < 1e-6);
    let ids = |report: &Value| -> Vec<String> {
        let all = report["findings"].as_array().expect("findings");
        all.iter()
            .map(|f| f["id"].as_str().expect("text").to_owned())
            .collect()
    };
    assert!(ids(&report).contains(&"joint-speed".to_owned()), "{report}");
    // the fifth joint beyond 120 deg
    let beyond = joint_move([0.0, 0.0, 0.0, 0.0, 121.0, 0.0]);
    let text = PROGRAM.replace("  ENDPROC", &format!("{beyond}  ENDPROC"));
    std::fs::write(&program, text).expect("scratch");
    let (status, report) = json(&["check", name(&program), "--profile", PROFILE]);
    assert_eq!(status, 1);
    assert!(ids(&report).contains(&"joint-limit".to_owned()), "{report}");
}

#[test]
fn only_some_programs_of_a_folder_are_checked_and_the_others_declare() {
    let folder = scratch();
    let programs = folder.path().join("in");
    std::fs::create_dir(&programs).expect("scratch");
    // the tool and a target stand in the other file
    let data: Vec<&str> = PROGRAM.lines().filter(|line| line.contains(":=")).collect();
    let rest: Vec<&str> = PROGRAM
        .lines()
        .filter(|line| !line.contains(":="))
        .collect();
    std::fs::write(programs.join("a_main.mod"), rest.join("\n") + "\n").expect("scratch");
    let other = format!(
        "MODULE other\n{}\n  PROC aside()\n    MoveJ p1,v100,fine,artifact;\n  \
         ENDPROC\nENDMODULE\n",
        data.join("\n")
    );
    std::fs::write(programs.join("b_data.mod"), other).expect("scratch");
    let check = |more: &[&str]| {
        let all = ["check", name(&programs), "--profile", PROFILE];
        json(&[&all[..], more].concat())
    };
    let files = |report: &Value| -> Vec<String> {
        let moves = report["moves"].as_array().expect("a list");
        let mut files: Vec<String> = moves
            .iter()
            .map(|one| one["file"].as_str().expect("a name").to_owned())
            .collect();
        files.dedup();
        files
    };
    let (_, all) = check(&[]);
    assert_eq!(files(&all).len(), 2, "{all}");
    let folder = programs.file_name().expect("a folder").to_string_lossy();
    for (only, file) in [
        ("A_MAIN".to_owned(), "a_main.mod"),
        ("b_data.mod".to_owned(), "b_data.mod"),
        (format!("{folder}/a_main"), "a_main.mod"),
        (format!("./{folder}/B_data.mod"), "b_data.mod"),
        (
            programs.join("b_data.mod").display().to_string(),
            "b_data.mod",
        ),
    ] {
        let (_, some) = check(&["--only", &only]);
        let path = programs.join(file).display().to_string();
        assert_eq!(files(&some), std::slice::from_ref(&path), "{some}");
        assert_eq!(some["input"], path);
        let of_file = |report: &Value| -> Vec<Value> {
            let moves = report["moves"].as_array().expect("a list").iter();
            moves.filter(|one| one["file"] == path).cloned().collect()
        };
        assert_eq!(of_file(&some), of_file(&all), "{file}");
    }
    let unknown = [
        "check",
        name(&programs),
        "--profile",
        PROFILE,
        "--only",
        "c",
    ];
    let (status, _, error) = run(&unknown);
    assert_eq!(status, 2);
    assert!(
        error.contains("--only c") && error.contains("b_data.mod"),
        "{error}"
    );
}

#[test]
fn targets_are_split_and_paths_refined_in_one_run() {
    let folder = scratch();
    let at = |name: &str| folder.path().join(name).display().to_string();
    let plain = std::fs::read_to_string(repository("robots/abb_irb120.yaml")).expect("a profile");
    let plain = &plain[..plain.find("calibration:").expect("a list of effects")];
    let effects = "calibration: {effects: [{effect: backlash, joint: 2, width_deg: -0.1}, \
                   {effect: link_geometry, link: 3, theta_deg: 0.1, a_mm: 0.3}]}\n";
    std::fs::write(at("robot.yaml"), format!("{plain}{effects}")).expect("scratch");
    // p is come to from both sides of joint 2, and on the lines from there it goes on as it came
    let (joints, pose) = (
        "[9E9,9E9,9E9,9E9,9E9,9E9]",
        "[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]",
    );
    let program = format!(
        "MODULE t\nCONST robtarget p := [[430,0,400],{pose};\nPROC main()\n\
         MoveAbsJ [[0,-20,0,0,60,0],{joints}],v100,fine,tool0;\nMoveJ p,v100,fine,tool0;\nMoveL \
             [[430,150,300],{pose},v100,fine,tool0;\n\
         MoveAbsJ [[0,60,0,0,60,0],{joints}],v100,fine,tool0;\nMoveJ p,v100,fine,tool0;\nMoveL \
             [[350,-150,420],{pose},v100,fine,tool0;\n\
         ENDPROC\nENDMODULE\n"
    );
    std::fs::write(at("t.mod"), program).expect("scratch");
    let (profile, input, output) = (at("robot.yaml"), at("t.mod"), at("out.mod"));
    let compensate = |more: &[&str]| {
        let all = ["compensate", &input, "--profile", &profile, "-o", &output];
        run(&[&all[..], more].concat())
    };
    let (status, out, _) = compensate(&["--max-path-error", "0.01"]);
    assert!(status == 1 && out.contains("target-shared"), "{out}");
    let (status, out, error) = compensate(&["--split-targets", "--max-path-error", "0.01"]);
    assert_eq!(status, 0, "{out}{error}");
    let written = std::fs::read_to_string(&output).expect("written");
    assert!(written.matches("MoveL").count() > 2, "{written}");
    assert!(!written.contains("MoveJ p"), "{written}");
    let (_, found) = json(&["check", &output, "--nominal", &input, "--profile", &profile]);
    let moves = found["moves"].as_array().expect("a list");
    let number = |one: &Value, key: &str| one[key].as_f64().expect("a number");
    let mut lines = 0;
    for one in moves.iter().filter(|one| one["joint_target"] == false) {
        assert!(number(one, "target_error_mm") < 0.002, "{one}");
        if one["kind"] == "linear" {
            assert!(number(one, "max_path_error_mm") < 0.01, "{one}");
            lines += 1;
        }
    }
    assert!(lines > 2, "{found}");
}

#[test]
fn where_joints_reverse_the_path_is_off_at_its_beginning_alone() {
    let folder = scratch();
    let at = |name: &str| folder.path().join(name).display().to_string();
    let plain = std::fs::read_to_string(repository("robots/abb_irb120.yaml")).expect("a profile");
    let plain = &plain[..plain.find("calibration:").expect("a list of effects")];
    let effects = "calibration: {effects: [{effect: backlash, joint: 1, width_deg: 0.1}]}\n";
    std::fs::write(at("robot.yaml"), format!("{plain}{effects}")).expect("scratch");
    // joint 1 leaves the second line's end to the other side: 0.1 degrees at 424 mm are 0.740 mm
    let joints = "[9E9,9E9,9E9,9E9,9E9,9E9]";
    let program = format!(
        "MODULE t\nPROC main()\nConfL\\Off;\nMoveAbsJ \
         [[-60,0,0,0,60,0],{joints}],v100,fine,tool0;\n\
         MoveL [[300,-300,300],[0,0,1,0],[-1,0,-1,0],{joints}],v100,fine,tool0;\n\
         MoveL [[300,300,300],[0,0,1,0],[0,0,0,0],{joints}],v100,fine,tool0;\n\
         MoveL [[300,-250,300],[0,0,1,0],[-1,0,-1,0],{joints}],v100,fine,tool0;\n\
         ENDPROC\nENDMODULE\n"
    );
    std::fs::write(at("t.mod"), program).expect("scratch");
    let (profile, input, output) = (at("robot.yaml"), at("t.mod"), at("out.mod"));
    let (status, out, error) = run(&[
        "compensate",
        &input,
        "--profile",
        &profile,
        "-o",
        &output,
        "--max-path-error",
        "0.05",
    ]);
    assert_eq!(status, 0, "{out}{error}");
    let is_said = |line: &str| line.contains(":7:") && line.contains("warning[path-at-reversal]");
    let said = out.lines().find(|line| is_said(line));
    assert!(said.is_some_and(|line| line.contains("0.74")), "{out}");
    assert!(!out.contains("path-from-kept-target"), "{out}");
    // from there, and from the joints where nobody knows the side, one line more takes it up
    let written = std::fs::read_to_string(&output).expect("written");
    assert_eq!(written.matches("MoveL").count(), 5, "{written}");
    let (_, found) = json(&["check", &output, "--nominal", &input, "--profile", &profile]);
    let moves = found["moves"].as_array().expect("a list");
    let lines = moves.iter().filter(|one| one["kind"] == "linear");
    let errors: Vec<f64> = lines
        .map(|one| one["max_path_error_mm"].as_f64().expect("a number"))
        .collect();
    assert_eq!(errors.len(), 5, "{found}");
    for rest in [1, 2, 4] {
        assert!(errors[rest] < 0.05, "{errors:?}");
    }
    assert!((errors[3] - 0.740).abs() < 0.01, "{errors:?}");
}

#[test]
fn inserted_targets_are_not_shifted_beyond_the_limit() {
    let folder = scratch();
    let at = |name: &str| folder.path().join(name).display().to_string();
    let plain = std::fs::read_to_string(repository("robots/abb_irb120.yaml")).expect("a profile");
    let plain = &plain[..plain.find("calibration:").expect("a list of effects")];
    // joint 1 is right at 45 degrees to both sides and off between: 0.35 mm a quarter of the path
    // on
    let effects =
        "calibration: {effects: [{effect: joint_harmonic, joint: 1, order: 2, cos_deg: 0.1}]}\n";
    std::fs::write(at("robot.yaml"), format!("{plain}{effects}")).expect("scratch");
    let joints = "[9E9,9E9,9E9,9E9,9E9,9E9]";
    let program = format!(
        "MODULE t\nPROC main()\nConfL\\Off;\nMoveAbsJ \
         [[-45,0,0,0,60,0],{joints}],v100,fine,tool0;\n\
         MoveL [[300,-300,300],[0,0,1,0],[-1,0,0,0],{joints}],v100,fine,tool0;\n\
         MoveL [[300,300,300],[0,0,1,0],[0,0,0,0],{joints}],v100,fine,tool0;\nENDPROC\nENDMODULE\n"
    );
    std::fs::write(at("t.mod"), program).expect("scratch");
    let (profile, input, output) = (at("robot.yaml"), at("t.mod"), at("out.mod"));
    let compensate = |limit: &str| {
        run(&[
            "compensate",
            &input,
            "--profile",
            &profile,
            "-o",
            &output,
            "--max-path-error",
            "0.05",
            "--max-shift",
            limit,
        ])
    };
    let (status, out, _) = compensate("0.3mm,1deg");
    assert_eq!(status, 1, "{out}");
    for word in ["path-not-refined", "0.350 mm", "0.300 mm", "--max-shift"] {
        assert!(out.contains(word), "{word}: {out}");
    }
    assert!(!Path::new(&output).exists());
    let (status, out, _) = compensate("0.6mm,1deg");
    assert_eq!(status, 0, "{out}");
}

#[test]
fn joints_in_no_unit_at_all_are_refused_before_they_are_followed() {
    let folder = scratch();
    let program = folder.path().join("t.script");
    let text = "def p():\n  movej([0,-1.5,1.5,-1.5,-1.5,0], a=1, v=1)\n  \
        movej([1e308,-1.5,1.5,-1.5,-1.5,0], a=1, v=1)\nend\n";
    std::fs::write(&program, text).expect("scratch");
    let (status, found) = json(&[
        "check",
        name(&program),
        "--profile",
        "robots/universal_robots_ur5.yaml",
        "--tool",
        "0,0,100,0,0,0",
    ]);
    let findings = found["findings"].as_array().expect("findings");
    let reported = findings.iter().find(|f| f["id"] == "angle-too-large");
    let reported = reported.unwrap_or_else(|| panic!("{findings:?}"));
    assert_eq!((status, reported["line"].as_u64()), (1, Some(3)));
    assert_eq!(found["summary"]["unknown"], 1, "{found}");
}

#[test]
fn a_limit_of_the_path_error_is_above_zero() {
    let folder = scratch();
    let program = folder.path().join("t.mod");
    std::fs::write(&program, PROGRAM).expect("scratch");
    let command = ["check", name(&program), "--profile", PROFILE];
    let cases = [
        ("--max-path-error", "0", "above 0"),
        ("--horizon", "-1", "not negative"),
    ];
    for (option, value, range) in cases {
        let option = format!("{option}={value}");
        let (status, _, error) = run(&[&command[..], &[&option]].concat());
        assert_eq!(status, 2, "{option}");
        let said = format!("is {value}; it must be a finite number, {range}");
        assert!(error.contains(&said), "{error}");
    }
}

#[test]
fn what_is_worse_in_a_file_that_is_gone_is_a_failure_for_the_build_server() {
    let folder = scratch();
    let programs = folder.path().join("programs");
    std::fs::create_dir(&programs).expect("scratch");
    let [base, xml] = ["base.json", "junit.xml"].map(|file| folder.path().join(file));
    let other = joint_move([0.0, 0.0, 0.0, 0.0, 30.0, 0.0]).replace("artifact", "tool0");
    let other = format!("MODULE b\n  PROC other()\n{other}  ENDPROC\nENDMODULE\n");
    for (file, text) in [("a.mod", PROGRAM), ("b.mod", &other)] {
        std::fs::write(programs.join(file), text).expect("scratch");
    }
    let command = [
        "check",
        name(&programs),
        "--profile",
        PROFILE,
        "--baseline",
        name(&base),
    ];
    let (status, _, error) = run(&[&command[..], &["--update-baseline"]].concat());
    assert_eq!(status, 0, "{error}");
    std::fs::remove_file(programs.join("b.mod")).expect("it is there");
    let (status, ..) = run(&[&command[..], &["--junit", name(&xml)]].concat());
    assert_eq!(status, 1);
    let xml = std::fs::read_to_string(&xml).expect("written");
    assert!(
        xml.contains("b.mod") && xml.contains("worse: moves"),
        "{xml}"
    );
    assert!(xml.contains("failures=\"1\""), "{xml}");
}

#[test]
fn of_a_move_that_begins_nobody_knows_where_the_text_says_the_error_of_its_end() {
    let folder = scratch();
    let program = folder.path().join("t.mod");
    let only = PROGRAM.replace("    MoveJ p1,v200,fine,artifact;\n", "");
    let only = only.replace("    MoveL p2,v100,z10,artifact;\n", "");
    let only = only.replace("    MoveC p3,p1,v100,fine,artifact;\n", "");
    std::fs::write(&program, only).expect("scratch");
    let command = ["check", name(&program), "--profile", PROFILE];
    let (_, report) = json(&command);
    let most_mm = report["summary"]["max_path_error_mm"].as_f64();
    let most_mm = format!("never more than {:.3}", most_mm.expect("a number"));
    let (_, out, _) = run(&command);
    assert!(
        out.contains(&most_mm) && !most_mm.ends_with("0.000"),
        "{out}"
    );
}

#[test]
fn a_spline_is_known_at_its_points_alone() {
    let folder = scratch();
    let program = folder.path().join("t.src");
    for (word, kind, certified) in [("SLIN", "linear", true), ("SPL", "spline", false)] {
        let text = format!(
            "DEF t()\n$TOOL=$NULLFRAME\n$BASE=$WORLD\nPTP {{A1 0,A2 0,A3 0,A4 0,A5 60,A6 \
             0}}\nSPLINE\n{word} {{X 430,Y 0,Z 400,A 0,B 180,C 0}}\n{word} {{X 430,Y 60,Z 400,A \
             0,B 180,C 0}}\nENDSPLINE\nEND\n"
        );
        std::fs::write(&program, text).expect("scratch");
        let language = ["--language", "krl"];
        let command = ["check", name(&program), "--profile", PROFILE];
        let (_, report) = json(&[&command[..], &language].concat());
        let last = report["moves"].as_array().and_then(|all| all.last());
        let last = last.expect("moves");
        assert_eq!(last["kind"], kind, "{report}");
        assert_eq!(last["path_certified"], certified, "{word} {last}");
        let findings = report["findings"].as_array().expect("findings");
        let is_warned = |finding: &Value| {
            finding["id"] == "path-uncertified" && finding["severity"] == "warning"
        };
        assert_eq!(findings.iter().any(is_warned), !certified, "{report}");
    }
}

#[test]
fn originals_of_a_folder_that_have_no_program_are_left_out() {
    let folder = scratch();
    let [originals, out] = ["in", "out"].map(|name| folder.path().join(name));
    std::fs::create_dir(&originals).expect("scratch");
    for module in ["A", "D"] {
        let text = PROGRAM
            .replace("MODULE t", &format!("MODULE {module}"))
            .replace("PROC main", &format!("PROC main_{module}"));
        std::fs::write(originals.join(format!("{module}.mod")), text).expect("scratch");
    }
    let compensate = ["compensate", name(&originals), "--profile", PROFILE, "-o"];
    let (status, said, error) = run(&[&compensate[..], &[name(&out)]].concat());
    assert_eq!(status, 0, "{said}{error}");
    // as --write-good leaves it
    std::fs::remove_file(out.join("D.mod")).expect("scratch");
    let check = ["check", name(&out), "--profile", PROFILE, "--nominal"];
    let all = [&check[..], &[name(&originals)]].concat();
    let (status, said, error) = run(&all);
    assert_eq!(status, 0, "{said}{error}");
    assert!(error.contains("D.mod of --nominal"), "{error}");
    let (_, report) = json(&all);
    assert_eq!(report["moves"].as_array().map(Vec::len), Some(4));
    // --only means originals, too
    let (status, said, error) = run(&[&all[..], &["--only", "A"]].concat());
    assert_eq!(status, 0, "{said}{error}");
    assert!(!error.contains("not compared"), "{error}");
    // no name in common: it is another program
    std::fs::rename(out.join("A.mod"), out.join("E.mod")).expect("scratch");
    let (status, _, error) = run(&all);
    assert!(status == 2 && error.contains("no counterpart"), "{error}");
}

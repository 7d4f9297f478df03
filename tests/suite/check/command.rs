//! `check` and `compensate --max-path-error` from the command line.

use super::joint_move;
use crate::support::{run, scratch};
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

fn name(path: &Path) -> &str {
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
fn a_baseline_catches_a_changed_decimal_and_a_build_server_is_told() {
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
fn a_cell_s_faults_and_its_missing_mesh_are_told() {
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
    std::fs::write(&cell, "poseshift: cell/1\nbodies: [{name: c, mesh: c.obj, at: {x_mm: -500, y_mm: -500, z_mm: -100, rx_deg: 0, ry_deg: 0, rz_deg: 0}}]\n").expect("scratch");
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
fn speed_zone_and_limits_are_told() {
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

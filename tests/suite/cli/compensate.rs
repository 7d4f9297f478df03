//! `compensate`: what is written, and when nothing is.

use crate::support::{files_below, poseshift, repository, scratch};
use std::path::Path;
use std::process::Output;

const SAMPLE: &str = "programs/rapid/olp/in/Deburr.mod";
const PROFILE: &str = "robots/abb_irb120_thesis.yaml";

fn run(folder: &Path, arguments: &[&str]) -> Output {
    let profile = repository(PROFILE);
    let mut command = poseshift();
    command
        .current_dir(folder)
        .arg("compensate")
        .args(arguments);
    if !arguments.contains(&"--profile") {
        command.arg("--profile").arg(profile);
    }
    command.output().expect("the program starts")
}

/// A folder with one sample program `a b.mod` in it.
fn with_sample() -> tempfile::TempDir {
    let folder = scratch();
    std::fs::copy(repository(SAMPLE), folder.path().join("a b.mod")).expect("scratch");
    folder
}

/// Asserts the status and that the folder holds these files only; returns standard error and
/// output.
fn refused(folder: &Path, arguments: &[&str], status: i32, files: &[&str]) -> String {
    let output = run(folder, arguments);
    let reported = String::from_utf8_lossy(&output.stderr).into_owned()
        + &String::from_utf8_lossy(&output.stdout);
    assert_eq!(output.status.code(), Some(status), "{reported}");
    let is: Vec<_> = files_below(folder)
        .iter()
        .map(|p| p.display().to_string())
        .collect();
    assert_eq!(is, files, "{reported}");
    reported
}

#[test]
fn a_program_is_rewritten_and_marked_and_refused_a_second_time() {
    let folder = with_sample();
    let before = std::fs::read(folder.path().join("a b.mod")).expect("the sample");
    let output = run(folder.path(), &["a b.mod", "-o", "out.mod"]);
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    let text = std::fs::read_to_string(folder.path().join("out.mod")).expect("written");
    assert!(text.contains("! poseshift compensated this file (version "));
    assert_eq!(
        std::fs::read(folder.path().join("a b.mod")).expect("the sample"),
        before
    );
    let reported = refused(
        folder.path(),
        &["out.mod", "-o", "twice.mod"],
        2,
        &["a b.mod", "out.mod"],
    );
    assert!(
        reported.contains("already compensated") && reported.contains("--force"),
        "{reported}"
    );
    assert!(
        run(folder.path(), &["out.mod", "-o", "twice.mod", "--force"])
            .status
            .success()
    );
}

#[test]
fn the_report_is_json_and_nothing_else() {
    let folder = with_sample();
    let output = run(folder.path(), &["a b.mod", "-o", "out.mod", "--json"]);
    let report: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
    assert_eq!(report["poseshift"], "compensation/1");
    assert_eq!(
        (&report["input"], &report["output"]),
        (&"a b.mod".into(), &"out.mod".into())
    );
    assert_eq!(report["language"], "rapid");
    assert_eq!(report["profile_sha256"].as_str().map(str::len), Some(64));
    let targets = report["targets"].as_array().expect("a list");
    assert_eq!(report["summary"]["targets"], targets.len());
    let keys = [
        "name",
        "line",
        "tool",
        "frame",
        "wanted",
        "fake",
        "joints_deg",
        "shift_mm",
        "shift_deg",
        "residual_mm",
        "residual_deg",
        "rounding_mm",
        "iterations",
        "branch",
        "findings",
    ];
    for target in targets {
        for key in keys {
            assert!(target.get(key).is_some(), "{key}");
        }
    }
    for key in [
        "targets",
        "compensated",
        "unchanged",
        "max_shift_mm",
        "max_residual_mm",
        "max_rounding_mm",
        "max_rounding_deg",
    ] {
        assert!(report["summary"][key].is_number(), "{key}");
    }
    assert!(report["summary"]["max_residual_mm"].as_f64() < Some(1e-6));
}

#[test]
fn outputs_must_be_said_and_inputs_are_not_written_over_by_accident() {
    let folder = with_sample();
    let only = &["a b.mod"];
    assert!(refused(folder.path(), &["a b.mod"], 2, only).contains("--output"));
    assert!(refused(folder.path(), &["a b.mod", "-o", "a b.mod"], 2, only).contains("--in-place"));
    assert!(
        refused(folder.path(), &["a b.mod", "-o", "./a b.mod"], 2, only).contains("--in-place")
    );
    assert!(
        refused(folder.path(), &["missing.mod", "-o", "o.mod"], 2, only).contains("missing.mod")
    );
    let before = std::fs::read(folder.path().join("a b.mod")).expect("the sample");
    assert!(
        run(folder.path(), &["a b.mod", "--in-place"])
            .status
            .success()
    );
    assert_ne!(
        std::fs::read(folder.path().join("a b.mod")).expect("the sample"),
        before
    );
}

#[test]
fn a_folder_is_rewritten_whole_and_other_files_are_left() {
    let folder = scratch();
    let sub = folder.path().join("in/deeper");
    std::fs::create_dir_all(&sub).expect("scratch");
    for file in files_below(&repository("programs/rapid/modules/in")) {
        std::fs::copy(
            repository("programs/rapid/modules/in").join(&file),
            sub.join(&file),
        )
        .expect("scratch");
    }
    std::fs::write(folder.path().join("in/notes.txt"), "MODULE is a word").expect("scratch");
    std::fs::write(folder.path().join("in/log.prg"), "no program").expect("scratch");
    let output = run(folder.path(), &["in", "-o", "out", "--ignore", "*.prg"]);
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    let programs = files_below(&repository("programs/rapid/modules/in"));
    let written = files_below(&folder.path().join("out"));
    assert_eq!(
        written,
        programs
            .iter()
            .map(|p| Path::new("deeper").join(p))
            .collect::<Vec<_>>()
    );
    let same = |name: &str| {
        std::fs::read(sub.join(name)).ok()
            == std::fs::read(folder.path().join("out/deeper").join(name)).ok()
    };
    assert!(same("CellLogic.mod") && !same("CalibData.mod"));
}

#[test]
fn broken_programs_are_refused_with_their_place() {
    let good = "MODULE m\n  PROC main()\n    MoveL \
        [[374.0,0.0,500.0],[0.5,0,0.8660254,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;\n  \
                ENDPROC\nENDMODULE\n";
    let cases = [
        (
            good[..good.find("500.0").expect("a number")].to_owned(),
            "not closed",
        ),
        (good.replacen("374.0", "1e400", 1), "1e400"),
        (good.replacen("374.0", "9E9", 1), "9E9"),
        (good.replacen("374.0", "NaN", 1), "`NaN` is no number"),
        (
            good.replacen("[0.5,0,0.8660254,0]", "[0,0,0,0]", 1),
            "quaternion",
        ),
        (
            good.replacen("[0.5,0,0.8660254,0]", "[0.9,0.9,0,0]", 1),
            "quaternion",
        ),
        (good.replacen("MODULE", "MO\0ULE", 1), "text"),
        (String::new(), "it is empty"),
    ];
    for (text, reported) in cases {
        let folder = scratch();
        std::fs::write(folder.path().join("a.mod"), &text).expect("scratch");
        let message = refused(folder.path(), &["a.mod", "-o", "out.mod"], 2, &["a.mod"]);
        assert!(
            message.to_lowercase().contains(&reported.to_lowercase()) && message.contains("a.mod"),
            "{reported}: {message}"
        );
    }
}

#[test]
fn a_target_that_cannot_be_compensated_blocks_the_file_unless_asked_to_go_on() {
    let folder = scratch();
    let far = "MODULE m\n  PROC main()\n    MoveAbsJ \
        [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;\n    \
               MoveL [[374,0,500],[0.5,0,0.8660254,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;\n    \
               MoveL [[3740,0,500],[0.5,0,0.8660254,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;\n  ENDPROC\nENDMODULE\n";
    std::fs::write(folder.path().join("a.mod"), far).expect("scratch");
    let reported = refused(folder.path(), &["a.mod", "-o", "out.mod"], 1, &["a.mod"]);
    assert!(
        reported.contains("a.mod:5:") && reported.contains("out-of-reach"),
        "{reported}"
    );
    let reported = refused(
        folder.path(),
        &["a.mod", "-o", "out.mod", "--keep-going"],
        1,
        &["a.mod", "out.mod"],
    );
    assert!(reported.contains("out-of-reach"), "{reported}");
    let text = std::fs::read_to_string(folder.path().join("out.mod")).expect("written");
    assert!(
        text.contains("[[3740,0,500]") && !text.contains("[[374,0,500]"),
        "{text}"
    );
}

#[test]
fn unknown_frames_are_asked_for_and_never_taken_as_identity() {
    let folder = scratch();
    let program = "MODULE m\n  PROC main()\n    MoveAbsJ \
        [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tGun;\n    \
                   MoveL [[374.0,0,400.0],[0.5,0,0.8660254,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tGun\\WObj:=wPart;\n  \
                   ENDPROC\nENDMODULE\n";
    std::fs::write(folder.path().join("a.mod"), program).expect("scratch");
    let reported = refused(folder.path(), &["a.mod", "-o", "out.mod"], 2, &["a.mod"]);
    assert!(
        reported.contains("tGun") && reported.contains("--tool tGun="),
        "{reported}"
    );
    let tool = ["--tool", "tGun=0,0,50,0,0,0"];
    let reported = refused(
        folder.path(),
        &["a.mod", "-o", "out.mod", tool[0], tool[1]],
        2,
        &["a.mod"],
    );
    assert!(
        reported.contains("wPart") && reported.contains("--frame wPart="),
        "{reported}"
    );
    let both = [
        "a.mod",
        "-o",
        "out.mod",
        tool[0],
        tool[1],
        "--frame",
        "wPart=-10,0,20,0,0,5",
    ];
    assert!(run(folder.path(), &both).status.success());
}

#[test]
fn decimals_and_joint_targets_are_the_users_choice() {
    let folder = scratch();
    let program = "MODULE m\n  PROC main()\n    MoveAbsJ \
        [[0.00,0.00,0.00,0.00,30.00,0.00],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;\n    \
                   MoveL [[374,0,500],[0.5,0,0.8660254,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;\n  ENDPROC\nENDMODULE\n";
    std::fs::write(folder.path().join("a.mod"), program).expect("scratch");
    let report = |more: &[&str]| -> serde_json::Value {
        let mut words = vec!["a.mod", "-o", "out.mod", "--json"];
        words.extend(more);
        serde_json::from_slice(&run(folder.path(), &words).stdout).expect("JSON")
    };
    let rounding = |report: &serde_json::Value| {
        report["summary"]["max_rounding_mm"]
            .as_f64()
            .expect("a number")
    };
    let coarse = report(&["--decimals", "0"]);
    assert!(rounding(&coarse) > 0.05);
    let found = coarse["findings"].as_array().expect("a list");
    let rounded = found.iter().find(|finding| finding["id"] == "rounding");
    assert_eq!(rounded.expect("a finding")["severity"], "error");
    let coarse = report(&[]);
    assert!(rounding(&coarse) < 1e-3);
    assert_eq!(coarse["summary"]["joint_targets"], 1);
    assert!(rounding(&report(&["--decimals", "3"])) < 0.002);
    let corrected = report(&["--joint-targets", "correct", "--decimals", "4"]);
    assert_eq!(corrected["summary"]["compensated"], 2);
    assert!(rounding(&corrected) < 1e-3);
    let text = std::fs::read_to_string(folder.path().join("out.mod")).expect("written");
    assert!(
        text.contains("[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0")
            && !text.contains("[[0.00,0.00"),
        "{text}"
    );
}

#[test]
fn a_profile_of_another_robot_is_distinguished() {
    let folder = with_sample();
    let fanuc = repository("robots/fanuc_lrmate200ic.yaml")
        .display()
        .to_string();
    let reported = refused(
        folder.path(),
        &["a b.mod", "-o", "o.mod", "--profile", &fanuc],
        2,
        &["a b.mod"],
    );
    assert!(reported.contains("fanuc"), "{reported}");
    let big =
        std::fs::read_to_string(repository("robots/abb_irb2600_20_165.yaml")).expect("a profile");
    std::fs::write(
        folder.path().join("big.yaml"),
        big.replace("a_mm: 700", "a_mm: 70"),
    )
    .expect("scratch");
    let reported = refused(
        folder.path(),
        &["a b.mod", "-o", "o.mod", "--profile", "big.yaml"],
        2,
        &["a b.mod", "big.yaml"],
    );
    assert!(reported.contains("profile of this robot"), "{reported}");
}

#[cfg(unix)]
#[test]
fn a_folder_that_cannot_be_written_leaves_nothing() {
    let folder = with_sample();
    std::fs::write(folder.path().join("file"), "").expect("scratch");
    let reported = refused(
        folder.path(),
        &["a b.mod", "-o", "file/out.mod"],
        2,
        &["a b.mod", "file"],
    );
    assert!(reported.contains("cannot write"), "{reported}");
    // a limit on the size of files stands for a full disk
    let script = format!(
        "ulimit -f 1; trap '' XFSZ; exec {} compensate 'a b.mod' --profile {} -o big.mod",
        env!("CARGO_BIN_EXE_poseshift"),
        repository(PROFILE).display()
    );
    let output = std::process::Command::new("bash")
        .current_dir(folder.path())
        .args(["-c", &script])
        .output()
        .expect("bash");
    assert_eq!(
        output.status.code(),
        Some(2),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    assert_eq!(files_below(folder.path()).len(), 2);
}

#[test]
fn a_profile_without_calibration_is_said_to_correct_nothing() {
    let folder = with_sample();
    let nominal = repository("robots/abb_irb120.yaml");
    let nominal = nominal.to_str().expect("UTF-8");
    let arguments = ["a b.mod", "-o", "out.mod", "--profile", nominal];
    let reported = refused(folder.path(), &arguments, 2, &["a b.mod"]);
    assert!(reported.contains("has no effect"), "{reported}");
}

#[test]
fn a_program_without_targets_is_said_to_have_none() {
    let folder = with_sample();
    let text = "MODULE empty\n  PROC main()\n    SetDO do1, 1;\n  ENDPROC\nENDMODULE\n";
    std::fs::write(folder.path().join("empty.mod"), text).expect("scratch");
    let output = run(folder.path(), &["empty.mod", "-o", "out.mod"]);
    assert_eq!(output.status.code(), Some(0));
    let reported = String::from_utf8(output.stdout).expect("UTF-8");
    assert!(
        reported.contains("no-targets") && reported.contains("empty.mod"),
        "{reported}"
    );
}

#[test]
fn orientations_rounded_away_are_reported_with_their_size() {
    let folder = scratch();
    let program = "MODULE m
  PERS tooldata artifact := [TRUE,[[50,25,100],[1,0,0,0]],[2.6,[-23,0,100],[1,0,0,0],0,0,0]];
  CONST robtarget p1 := [[430.123,-200.456,300.789],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveJ p1,v200,fine,artifact;
  ENDPROC
ENDMODULE
";
    std::fs::write(folder.path().join("m.mod"), program).expect("scratch");
    let coarse = ["m.mod", "-o", "out.mod", "--json", "--decimals", "0"];
    let output = run(folder.path(), &coarse);
    let report: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let turned = report["summary"]["max_rounding_deg"].as_f64();
    assert!(turned > Some(0.01), "{turned:?}");
    assert_eq!(report["findings"][0]["id"], "rounding");
    let output = run(folder.path(), &["m.mod", "-o", "fine.mod", "--json"]);
    let report: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
    assert!(report["summary"]["max_rounding_deg"].as_f64() < Some(1e-3));
    assert_eq!(report["findings"], serde_json::json!([]));
}

#[test]
fn an_angle_whose_turn_is_lost_in_rounding_is_refused() {
    let folder = scratch();
    let script = "def main():
  set_tcp(p[0,0,0.1,0,0,0])
  movel(p[0.3,0.1,0.4,0.0,-2555555555555555555555.614276,0.1],1.2,0.25)
end
";
    std::fs::write(folder.path().join("a.script"), script).expect("scratch");
    let profile = repository("programs/urscript/profile.yaml");
    let profile = profile.to_str().expect("UTF-8");
    let arguments = ["a.script", "-o", "b.script", "--profile", profile];
    let reported = refused(folder.path(), &arguments, 1, &["a.script"]);
    assert!(reported.contains("a.script:3:"), "{reported}");
    assert!(reported.contains("-2.5555"), "{reported}");
}

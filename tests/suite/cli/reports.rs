//! What holds for the report of every command.

use crate::support::{poseshift, repository, scratch};
use std::path::Path;

/// Commands in an order in which each finds what it needs, their status, and the kind of their
/// report. `@` is the repository.
pub const COMMANDS: &[(&str, i32, &str)] = &[
    (
        "plan --profile @robots/abb_irb120_thesis.yaml --count 40 -o joints.csv",
        0,
        "plan/1",
    ),
    (
        "simulate --profile @robots/abb_irb120_thesis.yaml --joints joints.csv --noise-mm 0.02 \
         --seed 1 -o measured.csv",
        0,
        "simulation/1",
    ),
    (
        "calibrate --profile @robots/abb_irb120_thesis.yaml --measurements measured.csv -o \
         calibrated.yaml",
        0,
        "calibration/1",
    ),
    (
        "validate --profile calibrated.yaml --measurements measured.csv",
        0,
        "validation/1",
    ),
    (
        "validate --as-calibrated --profile calibrated.yaml --measurements measured.csv",
        0,
        "validation/1",
    ),
    (
        "diagnose --quick --profile calibrated.yaml --measurements measured.csv",
        0,
        "diagnosis/1",
    ),
    (
        "fk --profile @robots/abb_irb120_thesis.yaml --joints joints.csv",
        0,
        "poses/1",
    ),
    (
        "compensate @programs/rapid/olp/in/Deburr.mod --profile @robots/abb_irb120_thesis.yaml -o \
         out.mod",
        0,
        "compensation/1",
    ),
    (
        "check out.mod --nominal @programs/rapid/olp/in/Deburr.mod --profile \
         @robots/abb_irb120_thesis.yaml",
        0,
        "check/1",
    ),
    (
        "register @docs/measuring/nominal.csv @docs/measuring/probed.csv",
        0,
        "registration/1",
    ),
    (
        "handeye @docs/measuring/robot.csv @docs/measuring/board.csv --setup eye-in-hand",
        0,
        "handeye/1",
    ),
    ("hexapod @docs/measuring/lengths.csv", 0, "hexapod/1"),
    (
        "axes @docs/measuring/sweeps.csv --profile @robots/abb_irb120_thesis.yaml",
        0,
        "axes/1",
    ),
    (
        "ik --profile @robots/abb_irb120_thesis.yaml --poses @docs/measuring/robot.csv --all",
        0,
        "solutions/1",
    ),
    (
        "register @docs/measuring/nominal.csv @docs/measuring/probed.csv --at 100,0,0 --sigma-mm \
         0.05 -v",
        0,
        "registration/1",
    ),
    (
        "register @docs/measuring/drawing.csv @docs/measuring/scan.csv --icp",
        0,
        "registration/1",
    ),
    (
        "hexapod --taught @docs/measuring/taught.csv --base-mm 300.01,299.98,300.02 -o device.yaml",
        0,
        "hexapod/1",
    ),
    (
        "hexapod --reach --base-mm 300,300,300 --tool-mm 150,150,150 --frame device.yaml --profile \
         @robots/fanuc_lrmate200ic.yaml",
        0,
        "hexapod/1",
    ),
    ("explain near-singularity", 0, "findings/1"),
    ("schema", 0, "schemas/1"),
    ("completions bash", 0, "completions/1"),
    ("man", 0, "manual/1"),
    ("robots", 0, "robots/1"),
    ("effects", 0, "effects/1"),
    ("languages", 0, "languages/1"),
    ("profile show @robots/ur5.yaml", 2, ""),
    (
        "profile show @robots/universal_robots_ur5.yaml",
        0,
        "profile-facts/1",
    ),
    ("profile new --robot abb_irb120", 0, "new-profile/1"),
    ("profile new --robot fanuc_m20ia", 0, "new-profile/1"),
    ("robots --search kuka", 0, "robots/1"),
    ("robots --search nothing-like-it", 2, ""),
    (
        "profile set @robots/abb_irb120.yaml robot.serial=120-1 -o numbered.yaml",
        0,
        "changed-profile/1",
    ),
    (
        "profile add-tool @robots/abb_irb120.yaml gripper=0,0,150,0,0,0,2.5 -o tooled.yaml",
        0,
        "changed-profile/1",
    ),
    (
        "profile add-track @robots/abb_irb120.yaml eax_a --direction 1,0,0 --min-mm 0 --max-mm \
         3000 -o railed.yaml",
        0,
        "changed-profile/1",
    ),
    (
        "profile export @robots/abb_irb120_thesis.yaml --urdf -o arm.urdf",
        0,
        "exported-profile/1",
    ),
    (
        "profile export @robots/abb_irb120_thesis.yaml",
        0,
        "exported-profile/1",
    ),
    (
        "profile from-urdf arm.urdf -o back.yaml",
        0,
        "new-profile/1",
    ),
    (
        "profile diff @robots/abb_irb120.yaml @robots/abb_irb120_thesis.yaml",
        1,
        "profile-diff/1",
    ),
];

/// A command of a line in which `@` is the repository, to be run in a folder.
pub fn given(line: &str, folder: &Path) -> assert_cmd::Command {
    let mut command = poseshift();
    command.current_dir(folder);
    for word in line.split(' ') {
        match word.strip_prefix('@') {
            Some(path) => command.arg(repository(path)),
            None => command.arg(word),
        };
    }
    command
}

#[test]
fn reports_begin_with_their_kind_and_are_alone_on_standard_output() {
    let folder = scratch();
    for (line, status, kind) in COMMANDS {
        let output = given(line, folder.path())
            .arg("--json")
            .output()
            .expect("the program starts");
        let reported = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(*status), "{line}: {reported}");
        let report = String::from_utf8(output.stdout).expect("UTF-8");
        if kind.is_empty() {
            assert_eq!(report, "", "{line}");
            continue;
        }
        let begins = format!("{{\n  \"poseshift\": \"{kind}\"");
        assert!(report.starts_with(&begins), "{line}: {}", &report[..80]);
        let _: serde_json::Value = serde_json::from_str(&report).expect("one document");
    }
}

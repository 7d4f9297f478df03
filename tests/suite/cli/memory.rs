//! What commands hold in memory for each move and row that they read.

use crate::path;
use crate::support::{repository, scratch};
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Duration;

/// The most memory that a command had, in bytes.
fn most(folder: &Path, arguments: &[&str]) -> f64 {
    let mut child = Command::new(env!("CARGO_BIN_EXE_poseshift"))
        .current_dir(folder)
        .args(arguments)
        // each thread has blocks of its own
        .env("RAYON_NUM_THREADS", "2")
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .expect("the program starts");
    let mut most = 0.0_f64;
    let status = loop {
        let status = std::fs::read_to_string(format!("/proc/{}/status", child.id()));
        let line = status.unwrap_or_default();
        let line = line.lines().find_map(|line| line.strip_prefix("VmHWM:"));
        let kilobytes = line.and_then(|line| line.split_whitespace().next()?.parse::<f64>().ok());
        most = most.max(1024.0 * kilobytes.unwrap_or(0.0));
        if let Some(status) = child.try_wait().expect("a child") {
            break status;
        }
        std::thread::sleep(Duration::from_millis(1));
    };
    assert!(
        matches!(status.code(), Some(0 | 1)),
        "{arguments:?}: {status}"
    );
    most
}

#[cfg(target_os = "linux")]
#[test]
fn memory_grows_by_what_is_read_and_no_more() {
    let folder = scratch();
    let robot = repository("robots/abb_irb120_thesis.yaml");
    let robot = robot.to_str().expect("a plain name");
    let profile = ["--profile", robot, "--tool", "artifact"];
    let rows = |count: u32| {
        let line = |n: u32| format!("{},{},-20,{},60,10\n", n % 90, n % 37, n % 71);
        let lines: String = (0..count).map(line).collect();
        "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg\n".to_owned() + &lines
    };
    let mut taken = Vec::new();
    for count in [15_000, 45_000] {
        let write = |name: &str, text: String| {
            std::fs::write(folder.path().join(name), text).expect("scratch");
        };
        write("path.mod", path::program("rapid", count, 1));
        write("asked.csv", rows(count));
        let simulate = ["simulate", "--joints", "asked.csv", "--noise-mm", "0.02"];
        most(
            folder.path(),
            &[&simulate[..], &profile, &["-o", "measured.csv"]].concat(),
        );
        let compensate = [
            "compensate",
            "path.mod",
            "-o",
            "out.mod",
            "--force",
            "--json",
        ];
        let validate = [
            "validate",
            "--measurements",
            "measured.csv",
            "--profile",
            robot,
        ];
        taken.push([
            most(
                folder.path(),
                &[&["check", "path.mod"], &profile[..]].concat(),
            ),
            most(
                folder.path(),
                &[&["check", "path.mod", "--json"], &profile[..]].concat(),
            ),
            most(folder.path(), &[&compensate[..], &profile].concat()),
            most(folder.path(), &validate),
        ]);
    }
    // bytes a move or row: 1 kB; 300 MB for 100 000; 232 MB for 100 000 were measured
    let limits = [1024.0, 1024.0, 3000.0, 3500.0];
    for (which, limit) in limits.into_iter().enumerate() {
        let each = (taken[1][which] - taken[0][which]) / 30_000.0;
        assert!(each < limit, "command {which}: {each:.0} bytes each");
    }
}

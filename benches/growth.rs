//! How time and memory grow with what is read: the program on 1 000, 10 000 and 100 000 moves, rows
//! and (a tenth) files.
//!
//! Prints the table of docs/performance.md: seconds and MB at most in memory.
//! `GROWTH=10000,1000000` takes other sizes. Memory is read from `/proc` while the program runs,
//! where there is one.

#[path = "../tests/suite/path.rs"]
#[allow(dead_code, reason = "one language is enough here")]
mod path;

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

const SIZES: [u32; 3] = [1_000, 10_000, 100_000];
/// Moves of one file of a folder.
const MOVES_OF_A_FILE: u32 = 10;
const PROFILE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/robots/abb_irb120_thesis.yaml");
/// How often the memory is looked at.
const LOOK: Duration = Duration::from_millis(2);

/// What a command took.
struct Taken {
    seconds: f64,
    megabytes: Option<f64>,
}

/// The most memory that a process has had so far.
fn megabytes(process: u32) -> Option<f64> {
    let status = std::fs::read_to_string(format!("/proc/{process}/status")).ok()?;
    let line = status
        .lines()
        .find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kilobytes: f64 = line.trim().trim_end_matches(" kB").trim().parse().ok()?;
    Some(kilobytes / 1024.0)
}

fn run(arguments: &[&str]) -> Taken {
    let started = Instant::now();
    let mut child = Command::new(env!("CARGO_BIN_EXE_poseshift"))
        .args(arguments)
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .expect("the program starts");
    let mut most = None;
    let status = loop {
        most = megabytes(child.id()).or(most);
        if let Some(status) = child.try_wait().expect("a child") {
            break status;
        }
        std::thread::sleep(LOOK);
    };
    let seconds = started.elapsed().as_secs_f64();
    // 1 is an answer, too: measurements made up have their findings
    assert!(
        matches!(status.code(), Some(0 | 1)),
        "{arguments:?}: {status}"
    );
    Taken {
        seconds,
        megabytes: most,
    }
}

/// Postures all over the work space, the same in each run.
fn joints(count: u32) -> String {
    let mut text = String::from("q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg\n");
    let mut state = 1u64;
    let mut random = |low: f64, high: f64| {
        // Knuth's constants; the upper bits are good enough
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        let part = f64::from(u32::try_from(state >> 32).expect("32 bits")) / f64::from(u32::MAX);
        low + (high - low) * part
    };
    for _ in 0..count {
        let _ = writeln!(
            text,
            "{:.4},{:.4},{:.4},{:.4},{:.4},{:.4}",
            random(-90.0, 90.0),
            random(-40.0, 60.0),
            random(-60.0, 40.0),
            random(-120.0, 120.0),
            random(20.0, 100.0),
            random(-150.0, 150.0)
        );
    }
    text
}

fn write(folder: &Path, name: &str, text: &str) -> PathBuf {
    let path = folder.join(name);
    std::fs::write(&path, text).expect("the target folder is writable");
    path
}

fn name(path: &Path) -> &str {
    path.to_str().expect("a path in UTF-8")
}

/// The commands on inputs of this size, in the order of [`HEADER`].
fn row(folder: &Path, count: u32) -> Vec<Taken> {
    let program = write(folder, "path.mod", &path::program("rapid", count, 1));
    let out = folder.join("path_out.mod");
    let asked = write(folder, "joints.csv", &joints(count));
    let measured = folder.join("measured.csv");
    run(&[
        "simulate",
        "--profile",
        PROFILE,
        "--joints",
        name(&asked),
        "--tool",
        "artifact",
        "--noise-mm",
        "0.02",
        "-o",
        name(&measured),
    ]);
    let programs = folder.join("programs");
    std::fs::create_dir_all(&programs).expect("the target folder is writable");
    for k in 0..count / 10 {
        let text = path::program("rapid", MOVES_OF_A_FILE, 100);
        let text = text.replace("MODULE Path", &format!("MODULE Path{k}"));
        let text = text.replace("PROC main()", &format!("PROC path{k}()"));
        write(&programs, &format!("path{k}.mod"), &text);
    }
    let compensated = folder.join("compensated");
    let tool = ["--tool", "artifact", "--profile", PROFILE];
    let compensate = |input: &Path, output: &Path, more: &[&str]| {
        let command = ["compensate", name(input), "-o", name(output)];
        run(&[&command[..], &tool, more].concat())
    };
    let measuring = ["--measurements", name(&measured), "--profile", PROFILE];
    let better = folder.join("better.yaml");
    vec![
        compensate(&program, &out, &[]),
        compensate(&program, &out, &["--json"]),
        run(&[&["check", name(&program)], &tool[..]].concat()),
        run(&[&["check", name(&program), "--json"], &tool[..]].concat()),
        run(&[&["calibrate"], &measuring[..], &["-o", name(&better)]].concat()),
        run(&[&["validate"], &measuring[..]].concat()),
        run(&[&["diagnose"], &measuring[..]].concat()),
        compensate(&programs, &compensated, &[]),
    ]
}

const HEADER: [&str; 8] = [
    "compensate",
    "compensate --json",
    "check",
    "check --json",
    "calibrate",
    "validate",
    "diagnose",
    "a folder of a tenth as many files",
];

fn main() {
    let sizes: Vec<u32> = match std::env::var("GROWTH") {
        Ok(text) => text
            .split(',')
            .map(|size| size.trim().parse().expect("GROWTH: numbers with commas"))
            .collect(),
        Err(_) => SIZES.to_vec(),
    };
    println!("| n | {} |", HEADER.join(" | "));
    println!("|{}", "---|".repeat(HEADER.len() + 1));
    for size in sizes {
        let folder = tempfile::tempdir().expect("a folder for files");
        let cell = |taken: &Taken| {
            let megabytes = taken
                .megabytes
                .map_or_else(String::new, |mb| format!(", {mb:.0} MB"));
            format!("{:.2} s{megabytes}", taken.seconds)
        };
        let cells: Vec<String> = row(folder.path(), size).iter().map(cell).collect();
        println!("| {size} | {} |", cells.join(" | "));
    }
}

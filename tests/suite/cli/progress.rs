//! Whoever waits at a terminal sees what is going on, and nobody else does.
//!
//! The commands read a pipe that gives nothing until the bar is seen: however fast the machine is,
//! they take as long as the bar needs.
#![cfg(unix)]

use crate::path;
use crate::support::{poseshift, repository, scratch};
use rustix::fs::OFlags;
use rustix::pty::{OpenptFlags, grantpt, openpt, ptsname, unlockpt};
use std::fs::File;
use std::io::{Read, Write};
use std::os::unix::fs::OpenOptionsExt;
use std::path::Path;
use std::process::{Command, ExitStatus, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

const PROFILE: &str = "robots/abb_irb120_thesis.yaml";
/// The pipe that is read.
const PIPE: &str = "pipe";
/// Nobody waits longer for a bar.
const LONGEST: Duration = Duration::from_mins(5);
/// So many moves and rows take every machine some time.
const MANY: u32 = 200_000;

/// A terminal, and what is written to it.
struct Terminal {
    written: Receiver<Vec<u8>>,
    reader: JoinHandle<()>,
    seen: String,
}

impl Terminal {
    /// A terminal, and the end of it that a program gets.
    fn new() -> (Self, File) {
        let own = openpt(OpenptFlags::RDWR | OpenptFlags::NOCTTY).expect("a terminal");
        grantpt(&own).expect("a terminal");
        unlockpt(&own).expect("a terminal");
        let name = ptsname(&own, Vec::new()).expect("a terminal");
        let name = name.to_str().expect("a plain name");
        let other = File::options().read(true).write(true).open(name);
        let (send, written) = channel();
        let reader = std::thread::spawn(move || {
            let (mut own, mut bytes) = (File::from(own), [0; 4096]);
            // it ends with an error when nobody has the other end any more
            while let Ok(length) = own.read(&mut bytes) {
                if length == 0 || send.send(bytes[..length].to_vec()).is_err() {
                    break;
                }
            }
        });
        let terminal = Self {
            written,
            reader,
            seen: String::new(),
        };
        (terminal, other.expect("a terminal"))
    }

    /// Waits until a text is seen.
    fn wait_for(&mut self, text: &str) {
        while !self.seen.contains(text) {
            let more = self.written.recv_timeout(LONGEST);
            let more = more.unwrap_or_else(|_| panic!("no `{text}`: {}", self.seen));
            self.seen += &String::from_utf8_lossy(&more);
        }
    }

    /// All that was written.
    fn end(mut self) -> String {
        self.reader.join().expect("a reader");
        for more in self.written.try_iter() {
            self.seen += &String::from_utf8_lossy(&more);
        }
        self.seen
    }
}

/// A folder with a profile, a pipe, and files of every kind that is read.
fn world() -> tempfile::TempDir {
    let folder = scratch();
    let copy = |from: &str, to: &str| {
        std::fs::copy(repository(from), folder.path().join(to)).expect("scratch");
    };
    copy(PROFILE, "p.yaml");
    for name in [
        "robot", "board", "nominal", "probed", "lengths", "taught", "sweeps",
    ] {
        copy(
            &format!("docs/measuring/{name}.csv"),
            &format!("{name}.csv"),
        );
    }
    copy("fuzz/seeds/frame/angles.yaml", "frame.yaml");
    copy("fuzz/seeds/urdf/r.urdf", "r.urdf");
    copy("fuzz/seeds/joints/poses.csv", "poses.csv");
    copy("programs/rapid/olp/in/Deburr.mod", "Deburr.mod");
    let made = Command::new("mkfifo")
        .arg(folder.path().join(PIPE))
        .status();
    assert!(made.expect("mkfifo").success());
    std::fs::write(folder.path().join("joints.csv"), joints(40)).expect("scratch");
    measure(folder.path());
    folder
}

/// Postures all over the work space.
fn joints(count: u32) -> String {
    let header = "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg\n".to_owned();
    let row = |n: u32| {
        let n = f64::from(n);
        let wave = |rate: f64, size: f64| size * (rate * n).sin();
        format!(
            "{:.4},{:.4},{:.4},{:.4},{:.4},{:.4}\n",
            wave(0.7, 90.0),
            10.0 + wave(1.1, 45.0),
            wave(1.7, 45.0) - 10.0,
            wave(2.3, 110.0),
            60.0 + wave(2.9, 40.0),
            wave(3.1, 150.0)
        )
    };
    (0..count).map(row).fold(header, |all, row| all + &row)
}

/// Measures what `joints.csv` asks for.
fn measure(folder: &Path) {
    let measured = poseshift()
        .current_dir(folder)
        .args(["simulate", "--joints", "joints.csv", "--profile", "p.yaml"])
        .args(["--noise-mm", "0.02", "-o", "measured.csv"])
        .output()
        .expect("the program starts");
    let said = String::from_utf8_lossy(&measured.stderr);
    assert_eq!(measured.status.code(), Some(0), "{said}");
}

/// Runs a command that reads the pipe: `bytes` come when `ready` says so. The exit status and
/// standard output.
fn run(
    folder: &Path,
    command: &str,
    errors: Stdio,
    bytes: &[u8],
    ready: impl FnOnce(),
) -> (ExitStatus, Vec<u8>) {
    let mut child = Command::new(env!("CARGO_BIN_EXE_poseshift"))
        .current_dir(folder)
        .args(command.split(' '))
        .env("TERM", "xterm")
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(errors)
        .spawn()
        .expect("the program starts");
    let mut out = child.stdout.take().expect("a pipe");
    let printed = std::thread::spawn(move || {
        let mut all = Vec::new();
        out.read_to_end(&mut all).map(|_| all)
    });
    // until somebody reads there it cannot be opened without waiting
    let free = loop {
        let mut options = File::options();
        options
            .write(true)
            .custom_flags(OFlags::NONBLOCK.bits().cast_signed());
        if let Ok(free) = options.open(folder.join(PIPE)) {
            break free;
        }
        let ended = child.try_wait().expect("a child");
        assert!(ended.is_none(), "{command}: nothing is read: {ended:?}");
        std::thread::sleep(Duration::from_millis(2));
    };
    let mut options = File::options();
    let mut pipe = options
        .write(true)
        .open(folder.join(PIPE))
        .expect("the pipe");
    drop(free);
    ready();
    pipe.write_all(bytes).expect("the program reads");
    drop(pipe);
    let status = child.wait().expect("it ends");
    let printed = printed.join().expect("a reader").expect("a pipe");
    (status, printed)
}

/// Runs it at a terminal, where the bar is seen before anything can be read; what is seen, and how
/// long the bar let wait.
fn at_terminal(
    folder: &Path,
    command: &str,
    bytes: &[u8],
) -> ((ExitStatus, Vec<u8>), String, Duration) {
    let (mut terminal, other) = Terminal::new();
    let begun = Instant::now();
    let mut waited = Duration::ZERO;
    let done = run(folder, command, other.into(), bytes, || {
        terminal.wait_for("reading");
        waited = begun.elapsed();
    });
    (done, terminal.end(), waited)
}

#[test]
fn every_command_that_waits_for_what_it_reads_shows_it_to_people_alone() {
    let folder = world();
    let folder = folder.path();
    for (command, file) in [
        ("compensate pipe --profile p.yaml -o out.mod", "Deburr.mod"),
        ("check pipe --profile p.yaml", "Deburr.mod"),
        (
            "calibrate --measurements pipe --profile p.yaml",
            "measured.csv",
        ),
        (
            "validate --measurements pipe --profile p.yaml",
            "measured.csv",
        ),
        (
            "diagnose --quick --measurements pipe --profile p.yaml",
            "measured.csv",
        ),
        ("fk --joints pipe --profile p.yaml", "joints.csv"),
        ("ik --poses pipe --profile p.yaml", "poses.csv"),
        ("simulate --joints pipe --profile p.yaml", "joints.csv"),
        (
            "plan --count 12 --given pipe --profile p.yaml",
            "joints.csv",
        ),
        ("register pipe probed.csv", "nominal.csv"),
        ("handeye robot.csv pipe --setup eye-in-hand", "board.csv"),
        ("hexapod pipe", "lengths.csv"),
        ("axes pipe --profile p.yaml", "sweeps.csv"),
        ("profile from-urdf pipe", "r.urdf"),
    ] {
        let bytes = std::fs::read(folder.join(file)).expect("scratch");
        let ((status, printed), seen, waited) = at_terminal(folder, command, &bytes);
        assert!(matches!(status.code(), Some(0 | 1)), "{command}: {seen}");
        assert!(!printed.is_empty() && !printed.contains(&0x1b), "{command}");
        // behind it the line is empty again
        let (_, behind) = seen.rsplit_once("reading").expect("it was seen");
        assert!(behind.contains("\u{1b}[2K"), "{command}: {seen}");

        // nobody sees it: neither a file nor a pipe has it, however long it lasts
        let errors = folder.join("errors");
        let file = File::create(&errors).expect("scratch");
        let quiet = run(folder, command, file.into(), &bytes, || {
            std::thread::sleep(2 * waited);
        });
        let written = std::fs::read_to_string(&errors).expect("UTF-8");
        assert_eq!(quiet.0, status, "{command}: {written}");
        assert!(
            !written.contains(['\u{1b}', '\r']) && !written.contains("reading"),
            "{command}: {written}"
        );
        assert_eq!(quiet.1, printed, "{command}");
        let _ = std::fs::remove_file(folder.join("out.mod"));
    }
}

#[test]
fn a_quiet_run_shows_no_bar() {
    let folder = world();
    let bytes = std::fs::read(folder.path().join("Deburr.mod")).expect("scratch");
    let command = "check pipe --profile p.yaml";
    let (_, _, waited) = at_terminal(folder.path(), command, &bytes);
    let (terminal, other) = Terminal::new();
    let command = format!("{command} --quiet");
    let (status, _) = run(folder.path(), &command, other.into(), &bytes, || {
        std::thread::sleep(2 * waited);
    });
    let seen = terminal.end();
    assert!(status.success() && !seen.contains("reading"), "{seen}");
}

/// What is drawn with another message than that something is read.
fn drawn(seen: &str) -> Vec<&str> {
    let parts = seen.split(['\u{1b}', '\r', '\n']).map(str::trim);
    let parts = parts.filter(|part| part.ends_with('s') && !part.contains("reading"));
    parts.collect()
}

#[test]
fn long_work_is_shown_with_what_is_done_of_it() {
    let folder = world();
    let folder = folder.path();
    for (command, with_bar) in [
        (
            "compensate pipe --profile p.yaml --tool artifact -o out.mod",
            None,
        ),
        (
            "check pipe --profile p.yaml --tool artifact",
            Some("checking ["),
        ),
        ("calibrate --measurements pipe --profile p.yaml", None),
        ("validate --measurements pipe --profile p.yaml", None),
        (
            "validate --folds 3 --measurements pipe --profile p.yaml",
            Some("validating ["),
        ),
        ("diagnose --measurements pipe --profile p.yaml", None),
    ] {
        let mut count = 2_000;
        loop {
            let bytes = if command.contains("--measurements") {
                std::fs::write(folder.join("joints.csv"), joints(count)).expect("scratch");
                measure(folder);
                std::fs::read(folder.join("measured.csv")).expect("scratch")
            } else {
                path::program("rapid", count, 1).into_bytes()
            };
            let ((status, _), seen, _) = at_terminal(folder, command, &bytes);
            assert!(matches!(status.code(), Some(0 | 1)), "{command}: {seen}");
            let is_shown = match with_bar {
                Some(bar) => seen.contains(bar),
                None => !drawn(&seen).is_empty(),
            };
            if is_shown {
                break;
            }
            assert!(count < MANY, "{command}: nothing of {count}: {seen:?}");
            count *= 4;
        }
    }
}

//! What a run writes appears whole or not at all: whatever stops it, at the latest the next run in
//! that folder sees to it.

use crate::support::{files_below, poseshift, repository, scratch, skipped};
use rand::rngs::StdRng;
use rand::{RngExt, SeedableRng};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

const PROFILE: &str = "robots/abb_irb120_thesis.yaml";
/// Programs that belong together.
const PROGRAMS: &str = "programs/rapid/modules/in";
const OLD_REPORT: &str = "the report of before";

type Content = BTreeMap<PathBuf, Vec<u8>>;

fn content(folder: &Path) -> Content {
    let read = |path: PathBuf| {
        let bytes = std::fs::read(folder.join(&path)).expect("a file");
        (path, bytes)
    };
    files_below(folder).into_iter().map(read).collect()
}

/// A folder with a profile, four programs in `work` and an earlier report among them.
fn world() -> tempfile::TempDir {
    let folder = scratch();
    reset(folder.path());
    folder
}

fn reset(folder: &Path) {
    let work = folder.join("work");
    let _ = std::fs::remove_dir_all(&work);
    std::fs::create_dir(&work).expect("scratch");
    for name in files_below(&repository(PROGRAMS)) {
        std::fs::copy(repository(PROGRAMS).join(&name), work.join(name)).expect("scratch");
    }
    std::fs::write(work.join("report.html"), OLD_REPORT).expect("scratch");
    std::fs::copy(repository(PROFILE), work.join("p.yaml")).expect("scratch");
}

const IN_PLACE: [&str; 7] = [
    "compensate",
    "work",
    "--profile",
    "work/p.yaml",
    "--in-place",
    "--report",
    "work/report.html",
];

fn run(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = poseshift();
    command.current_dir(folder).args(arguments);
    // pages of two runs are the same
    let output = command.env("SOURCE_DATE_EPOCH", "0").output();
    output.expect("the program starts")
}

fn reported(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned() + &String::from_utf8_lossy(&output.stdout)
}

/// Asserts that a run that writes is refused, and that nothing is changed.
fn refused(folder: &Path, arguments: &[&str], words: &[&str]) {
    let before = content(folder);
    let output = run(folder, arguments);
    let reported = reported(&output);
    assert_eq!(output.status.code(), Some(2), "{reported}");
    for word in words {
        assert!(reported.contains(word), "{word}: {reported}");
    }
    assert_eq!(content(folder), before, "{reported}");
}

/// What a run that nothing stops writes.
fn wanted() -> Content {
    let folder = world();
    let output = run(folder.path(), &IN_PLACE);
    assert_eq!(output.status.code(), Some(0), "{}", reported(&output));
    content(folder.path())
}

/// Runs a tool of the system; whether it could.
fn tool(program: &str, arguments: &[&str], folder: &Path) -> bool {
    let done = Command::new(program)
        .args(arguments)
        .current_dir(folder)
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .status();
    done.is_ok_and(|status| status.success())
}

#[test]
fn a_file_that_cannot_be_changed_stops_all_others() {
    let folder = world();
    let second = "work/LeftModule.mod";
    if !tool("chattr", &["+i", second], folder.path()) {
        return skipped("chattr +i is not permitted here");
    }
    refused(
        folder.path(),
        &IN_PLACE,
        &["cannot write work/LeftModule.mod"],
    );
    assert!(tool("chattr", &["-i", second], folder.path()));
    let output = run(folder.path(), &IN_PLACE);
    assert_eq!(output.status.code(), Some(0), "{}", reported(&output));

    // a folder in which nothing can be made
    reset(folder.path());
    assert!(tool("chattr", &["+i", "work"], folder.path()));
    refused(folder.path(), &IN_PLACE, &["cannot write"]);
    assert!(tool("chattr", &["-i", "work"], folder.path()));
}

/// Kills runs at random moments; how many left something to finish, and to undo.
fn kill(times: usize, seed: u64) -> (usize, usize) {
    let folder = world();
    let path = folder.path();
    let (old, new) = (content(path), wanted());
    let started = Instant::now();
    run(path, &IN_PLACE);
    let whole = started.elapsed();
    let mut random = StdRng::seed_from_u64(seed);
    let (mut finished, mut undone) = (0, 0);
    for number in 0..times {
        reset(path);
        let mut child = Command::new(env!("CARGO_BIN_EXE_poseshift"))
            .current_dir(path)
            .env("SOURCE_DATE_EPOCH", "0")
            .args(IN_PLACE)
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .expect("the program starts");
        // most of the time after all was computed
        let part = if number % 3 == 0 {
            random.random_range(0.0..1.1)
        } else {
            random.random_range(0.5..1.1)
        };
        std::thread::sleep(whole.mul_f64(part));
        let _ = child.kill();
        child.wait().expect("it ended");
        // any run that reads there
        let next = run(path, &["profile", "show", "work/p.yaml"]);
        let said = reported(&next);
        assert_eq!(next.status.code(), Some(0), "{said}");
        let is = content(path);
        assert!(
            is == old || is == new,
            "kill {number} at {part}: {said}: {:?}",
            is.keys()
        );
        finished += usize::from(said.contains("finished what a run that was stopped"));
        undone += usize::from(said.contains("undone what a run that was stopped"));
        let silent = said.lines().filter(|line| line.contains("stopped")).count();
        assert!(silent <= 1, "{said}");
    }
    (finished, undone)
}

#[test]
fn five_hundred_runs_that_are_killed_are_finished_or_undone_by_the_next() {
    let (finished, undone) = kill(500, 2);
    println!("of 500 kills {finished} were finished and {undone} undone by the next run");
    assert!(finished > 0 && undone > 0, "{finished} {undone}");
}

/// Runs a command line of a shell in a folder, with `$POSESHIFT`.
fn shell(folder: &Path, line: &str) -> Output {
    let output = Command::new("bash")
        .args(["-c", line])
        .current_dir(folder)
        .env("POSESHIFT", env!("CARGO_BIN_EXE_poseshift"))
        .output();
    output.expect("a shell")
}

#[cfg(unix)]
#[test]
fn a_limit_of_file_sizes_stops_all_or_is_undone() {
    use std::os::unix::process::ExitStatusExt;
    let folder = world();
    let before = content(folder.path());
    let line = format!("ulimit -f 8; exec \"$POSESHIFT\" {}", IN_PLACE.join(" "));
    // the signal ignored: the program sees a closed pipe
    let output = shell(folder.path(), &format!("trap '' XFSZ; {line}"));
    assert_eq!(output.status.code(), Some(2), "{}", reported(&output));
    assert!(
        reported(&output).contains("cannot write work/"),
        "{}",
        reported(&output)
    );
    assert_eq!(content(folder.path()), before);
    // the signal kills it, with its new files half written
    let output = shell(folder.path(), &line);
    assert!(output.status.signal().is_some(), "{}", reported(&output));
    let left = content(folder.path());
    assert!(
        left.len() > before.len(),
        "nothing was begun: {:?}",
        left.keys()
    );
    let next = run(folder.path(), &["profile", "show", "work/p.yaml"]);
    assert!(
        reported(&next).contains("undone what a run that was stopped"),
        "{}",
        reported(&next)
    );
    assert_eq!(content(folder.path()), before);
}

/// A file system in memory that is unmounted when it is dropped.
struct Mounted(PathBuf);

impl Mounted {
    fn new(place: &Path, options: &str) -> Option<Self> {
        std::fs::create_dir_all(place).expect("scratch");
        let at = place.to_str().expect("a plain name");
        tool(
            "mount",
            &["-t", "tmpfs", "-o", options, "tmpfs", at],
            Path::new("/"),
        )
        .then(|| Self(place.to_owned()))
    }
}

impl Drop for Mounted {
    fn drop(&mut self) {
        let at = self.0.to_str().expect("a plain name");
        assert!(tool("umount", &[at], Path::new("/")), "{at} stays mounted");
    }
}

#[test]
fn a_disk_that_is_full_stops_all() {
    let place = scratch();
    let Some(disk) = Mounted::new(place.path(), "size=256k") else {
        return skipped("no file system can be mounted here");
    };
    reset(&disk.0);
    // room for some of the new files
    let free = "work/ballast";
    std::fs::write(disk.0.join(free), vec![1; 196 * 1024]).expect("scratch");
    refused(&disk.0, &IN_PLACE, &["cannot write", "No space left"]);
    std::fs::remove_file(disk.0.join(free)).expect("scratch");
}

#[cfg(unix)]
#[test]
fn a_quota_stops_all() {
    use std::os::unix::fs::{PermissionsExt, chown};
    use std::os::unix::process::CommandExt;
    const NOBODY: u32 = 65534;
    let place = scratch();
    let Some(disk) = Mounted::new(place.path(), "size=4m,usrquota_block_hardlimit=100k") else {
        return skipped("no file system with a quota can be mounted here");
    };
    reset(&disk.0);
    let open = std::fs::Permissions::from_mode(0o755);
    std::fs::set_permissions(place.path(), open).expect("scratch");
    for path in [disk.0.clone(), disk.0.join("work")] {
        chown(path, Some(NOBODY), Some(NOBODY)).expect("scratch");
    }
    for name in files_below(&disk.0) {
        chown(disk.0.join(name), Some(NOBODY), Some(NOBODY)).expect("scratch");
    }
    let program = Path::new(env!("CARGO_BIN_EXE_poseshift"));
    let may = program.ancestors().all(|above| {
        let mode = std::fs::metadata(above)
            .expect("a folder")
            .permissions()
            .mode();
        mode & 0o001 != 0
    });
    if !may {
        return skipped("another user cannot run the program");
    }
    let before = content(&disk.0.join("work"));
    let output = Command::new(program)
        .current_dir(&disk.0)
        .args(IN_PLACE)
        .uid(NOBODY)
        .gid(NOBODY)
        .output()
        .expect("the program starts");
    let reported = reported(&output);
    assert_eq!(output.status.code(), Some(2), "{reported}");
    assert!(
        reported.contains("cannot write") && reported.contains("uota"),
        "{reported}"
    );
    assert_eq!(content(&disk.0.join("work")), before);
}

/// What is preloaded so that calls on the files of a folder fail.
#[cfg(target_os = "linux")]
fn failing_disk(folder: &Path) -> PathBuf {
    let library = folder.join("failing_disk.so");
    let source = repository("tests/suite/cli/failing_disk.c");
    let built = Command::new("cc")
        .args(["-shared", "-fPIC", "-Wall", "-Werror", "-o"])
        .args([&library, &source])
        .status();
    assert!(built.expect("the linker of Rust").success());
    library
}

/// Lets each call of a kind on the files of a run fail in its turn, and so many behind it: all is
/// old or all is new, as the exit status says, and nothing is left next to it.
#[cfg(target_os = "linux")]
fn each_call_fails(call: &str, error: i32, times: usize, word: &str) -> (usize, usize) {
    let library = scratch();
    let library = failing_disk(library.path());
    let folder = world();
    let path = folder.path().canonicalize().expect("scratch");
    let (old, new) = (content(&path), wanted());
    let (mut refused, mut written) = (0, 0);
    for number in 0_usize.. {
        reset(&path);
        let output = poseshift()
            .current_dir(&path)
            .args(IN_PLACE)
            .env("SOURCE_DATE_EPOCH", "0")
            .env("LD_PRELOAD", &library)
            .env("FAIL_BELOW", &path)
            .env("FAIL_CALL", call)
            .env("FAIL_FROM", number.to_string())
            .env("FAIL_TIMES", times.to_string())
            .env("FAIL_WITH", error.to_string())
            .output()
            .expect("the program starts");
        let said = format!("{call} {number}: {}", reported(&output));
        let has_failed = said.contains("the disk fails");
        let next = run(&path, &["profile", "show", "work/p.yaml"]);
        assert_eq!(next.status.code(), Some(0), "{said}{}", reported(&next));
        let is = content(&path);
        match output.status.code() {
            Some(0) => {
                assert!(is == new, "{said}: {:?}", is.keys());
                written += usize::from(has_failed);
            }
            Some(2) => {
                assert!(has_failed && said.contains(word), "{said}");
                assert!(is == old, "{said}: {:?}", is.keys());
                refused += 1;
            }
            other => panic!("{other:?}: {said}"),
        }
        if !has_failed {
            break;
        }
    }
    (refused, written)
}

#[cfg(target_os = "linux")]
#[test]
fn a_quota_that_is_used_up_at_any_call_leaves_all_as_it_was_or_all_new() {
    const EDQUOT: i32 = 122;
    let (refused, _) = each_call_fails("write", EDQUOT, usize::MAX >> 1, "uota");
    assert!(refused > 5, "{refused}");
    // network file systems say it when a file is closed, too: by then it was synced
    let (_, written) = each_call_fails("close", EDQUOT, usize::MAX >> 1, "uota");
    assert!(written > 5, "{written}");
}

#[cfg(target_os = "linux")]
#[test]
fn a_disk_that_breaks_at_any_call_leaves_all_as_it_was_or_all_new() {
    const EIO: i32 = 5;
    for call in ["fsync", "write"] {
        let (refused, _) = each_call_fails(call, EIO, 1, "nput/output error");
        assert!(refused > 5, "{refused}");
    }
}

#[test]
fn a_new_output_folder_appears_whole_and_reports_with_it() {
    let folder = world();
    let arguments = [
        "compensate",
        "work",
        "--profile",
        "work/p.yaml",
        "-o",
        "new/below",
        "--report",
        "new/report.html",
    ];
    // the report cannot be made: there is no folder either
    let mut bad = arguments;
    bad[7] = "work/CellLogic.mod/report.html";
    refused(
        folder.path(),
        &bad,
        &["cannot write work/CellLogic.mod/report.html"],
    );

    // seen from outside: nothing, then everything
    let mut child = Command::new(env!("CARGO_BIN_EXE_poseshift"))
        .current_dir(folder.path())
        .args(arguments)
        .stdout(Stdio::null())
        .spawn()
        .expect("the program starts");
    let new = folder.path().join("new");
    let first = loop {
        if new.exists() {
            break files_below(&new);
        }
        if child.try_wait().expect("a child").is_some() {
            break files_below(&new);
        }
    };
    assert_eq!(child.wait().expect("it ends").code(), Some(0));
    assert_eq!(first, files_below(&new));
    assert_eq!(first.len(), 5, "{first:?}");
    let left = files_below(folder.path());
    let left: Vec<_> = left.iter().map(|path| path.to_string_lossy()).collect();
    assert!(
        !left.iter().any(|name| name.contains(".poseshift-")),
        "{left:?}"
    );
}

#[test]
fn a_run_that_waits_to_print_has_replaced_nothing_and_is_undone_when_killed() {
    let folder = world();
    let before = content(folder.path());
    let cam = repository("programs/rapid/cam/in/cam.mod");
    std::fs::copy(cam, folder.path().join("cam.mod")).expect("scratch");
    // a report of megabytes that nobody reads
    let mut child = Command::new(env!("CARGO_BIN_EXE_poseshift"))
        .current_dir(folder.path())
        .args([
            "compensate",
            "cam.mod",
            "--profile",
            "work/p.yaml",
            "--json",
        ])
        .args(["-o", "work/CellLogic.mod", "--report", "work/report.html"])
        .stdout(Stdio::piped())
        .spawn()
        .expect("the program starts");
    let journal = folder.path().join("work/.poseshift-journal");
    while !journal.exists() {
        let ended = child.try_wait().expect("a child");
        assert!(ended.is_none(), "nothing is begun");
        std::thread::sleep(Duration::from_millis(2));
    }
    std::thread::sleep(Duration::from_millis(100));
    child.kill().expect("it runs");
    child.wait().expect("it ended");
    assert!(journal.exists());
    // a run that reads the folder
    let next = run(
        folder.path(),
        &[
            "check",
            "work",
            "--profile",
            "work/p.yaml",
            "--ignore",
            "*.html",
        ],
    );
    let said = reported(&next);
    assert!(
        said.contains("undone what a run that was stopped"),
        "{said}"
    );
    std::fs::remove_file(folder.path().join("cam.mod")).expect("scratch");
    assert_eq!(content(folder.path()), before, "{said}");
}

#[test]
fn what_was_begun_in_new_folders_is_undone_by_a_run_that_reads_in_them() {
    let folder = world();
    let cam = repository("programs/rapid/cam/in/cam.mod");
    std::fs::copy(cam, folder.path().join("cam.mod")).expect("scratch");
    let before = content(folder.path());
    let mut child = Command::new(env!("CARGO_BIN_EXE_poseshift"))
        .current_dir(folder.path())
        .args([
            "compensate",
            "cam.mod",
            "--profile",
            "work/p.yaml",
            "--json",
        ])
        .args(["-o", "new/deep/cam.mod", "--report", "work/report.html"])
        .stdout(Stdio::piped())
        .spawn()
        .expect("the program starts");
    // it stands above the first folder that is new
    let journal = folder.path().join(".poseshift-journal");
    while !journal.exists() {
        let ended = child.try_wait().expect("a child");
        assert!(ended.is_none(), "nothing is begun");
        std::thread::sleep(Duration::from_millis(2));
    }
    std::thread::sleep(Duration::from_millis(100));
    child.kill().expect("it runs");
    child.wait().expect("it ended");
    assert!(journal.exists());
    let read = ["check", "new/deep/cam.mod", "--profile", "work/p.yaml"];
    let said = reported(&run(folder.path(), &read));
    assert!(
        said.contains("undone what a run that was stopped"),
        "{said}"
    );
    assert!(!journal.exists(), "{said}");
    assert_eq!(content(folder.path()), before, "{said}");
}

/// Runs two commands at the same time; their exit statuses and what they said.
fn at_once(folder: &Path, commands: [&[&str]; 2]) -> [(Option<i32>, String); 2] {
    let begun = commands.map(|arguments| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_poseshift"));
        command.current_dir(folder).args(arguments);
        command.env("SOURCE_DATE_EPOCH", "0");
        command.stdout(Stdio::piped()).stderr(Stdio::piped());
        command.spawn().expect("the program starts")
    });
    begun.map(|child| {
        let output = child.wait_with_output().expect("it ended");
        (output.status.code(), reported(&output))
    })
}

#[test]
fn two_runs_at_once_leave_whole_files_and_no_journal() {
    let new = wanted();
    let folder = world();
    let path = folder.path();
    for _ in 0..20 {
        reset(path);
        // the same files: one comes first, the other sees it
        let both = at_once(path, [&IN_PLACE, &IN_PLACE]);
        let done = both.iter().filter(|(status, _)| *status == Some(0)).count();
        assert!(done > 0, "{both:?}");
        for (status, said) in &both {
            assert!(matches!(status, Some(0..=2)), "{both:?}");
            assert!(!said.contains("stopped"), "{both:?}");
        }
        assert!(content(path) == new, "{both:?}: {:?}", content(path).keys());
    }
    // other files next to one another
    let into = |output: &'static str| {
        [
            "compensate",
            "work",
            "--profile",
            "work/p.yaml",
            "-o",
            output,
        ]
    };
    for number in 0..20 {
        reset(path);
        for output in ["a", "b"] {
            let _ = std::fs::remove_dir_all(path.join(output));
        }
        let both = at_once(path, [&into("a"), &into("b")]);
        let left: Vec<&str> = ["a", "b"]
            .into_iter()
            .filter(|output| path.join(output).exists())
            .collect();
        for ((status, said), output) in both.iter().zip(["a", "b"]) {
            let waited = said.contains("another run of poseshift");
            assert!(*status == Some(0) || waited, "{number}: {both:?}");
            assert_eq!(*status == Some(0), left.contains(&output), "{both:?}");
        }
        for output in &left {
            let made = files_below(&path.join(output));
            assert_eq!(
                made.len(),
                files_below(&repository(PROGRAMS)).len(),
                "{made:?}"
            );
        }
        let names = files_below(path);
        let mut names = names.iter().map(|name| name.to_string_lossy());
        assert!(!names.any(|name| name.contains(".poseshift-")), "{both:?}");
    }
}

//! A transaction that is stopped at each of its steps: by a kill, after which nothing is done any
//! more, and by one step that fails.

use super::disk::Disk;
use super::journal;
use super::recovery::recover;
use super::transaction::{New, Transaction};
use super::{Files, NewFile};
use crate::task::Failure;
use std::collections::BTreeMap;
use std::fs;
use std::io::Error;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Places, what they hold before (none where they are not there), and what they hold after.
const FILES: [(&str, Option<&str>, &str); 7] = [
    ("a/1.mod", Some("old 1"), "new 1"),
    ("a/2.mod", Some("old 2"), "new 2, longer"),
    ("a/same.mod", Some("same"), "same"),
    ("a/first.mod", None, "new"),
    ("a/out/x/1.mod", None, "in a new folder"),
    ("a/out/2.mod", None, "in it, too"),
    ("b/report.html", Some("old report"), "new report"),
];

type Content = BTreeMap<PathBuf, String>;

/// A folder with the files of before.
fn world() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("scratch");
    for name in ["a", "b"] {
        fs::create_dir(folder.path().join(name)).expect("scratch");
    }
    for (name, old, _) in FILES {
        if let Some(old) = old {
            fs::write(folder.path().join(name), old).expect("scratch");
        }
    }
    folder
}

/// Every file and folder, leftovers as well.
fn content(folder: &Path) -> Content {
    let all = walkdir::WalkDir::new(folder).min_depth(1);
    all.into_iter()
        .map(|found| {
            let found = found.expect("scratch");
            let below = found.path().strip_prefix(folder).expect("below").to_owned();
            let text = fs::read_to_string(found.path()).unwrap_or_default();
            (below, text)
        })
        .collect()
}

fn expected(after: bool) -> Content {
    let mut all = Content::new();
    for (name, old, new) in FILES {
        let text = if after { Some(new) } else { old };
        let Some(text) = text else { continue };
        for folder in Path::new(name).ancestors().skip(1) {
            if folder != Path::new("") {
                all.insert(folder.to_owned(), String::new());
            }
        }
        all.insert(name.into(), text.into());
    }
    all
}

fn run(disk: &Disk, folder: &Path) -> Result<(), Failure> {
    run_with(disk, folder, |_| ())
}

/// Likewise; `meanwhile` is done between all files are made and they are put into their places.
fn run_with(disk: &Disk, folder: &Path, meanwhile: impl Fn(&Path)) -> Result<(), Failure> {
    let folder = folder.canonicalize().expect("scratch");
    let names: Vec<PathBuf> = FILES.iter().map(|(name, ..)| name.into()).collect();
    let new: Vec<New> = FILES
        .iter()
        .zip(&names)
        .map(|((place, _, text), name)| New {
            place: folder.join(place),
            name,
            bytes: text.as_bytes(),
        })
        .collect();
    let staged = Transaction::stage(disk, &new, &mut Vec::new())?;
    meanwhile(&folder);
    staged.commit().map(|_| ())
}

/// What the runs after a stop in both folders say.
fn settle(folder: &Path, first: &str) -> Vec<String> {
    let second = if first == "a" { "b" } else { "a" };
    let folder = folder.canonicalize().expect("scratch");
    [first, second]
        .iter()
        .filter_map(|name| {
            recover(&Disk::default(), &folder.join(name)).unwrap_or_else(|f| panic!("{f:?}"))
        })
        .collect()
}

/// A disk of which these steps fail.
fn stopped(fails: impl Fn(usize) -> bool + Send + Sync + 'static) -> (Disk, Arc<AtomicUsize>) {
    let count = Arc::new(AtomicUsize::new(0));
    let steps = count.clone();
    let disk = Disk::gated(move || {
        if fails(steps.fetch_add(1, Ordering::SeqCst)) {
            return Err(Error::other("stopped"));
        }
        Ok(())
    });
    (disk, count)
}

#[test]
fn what_a_kill_at_any_step_leaves_is_finished_or_undone_as_a_whole() {
    let (mut undone, mut finished, mut steps) = (0, 0, 0);
    for last in 0.. {
        let folder = world();
        let (disk, count) = stopped(move |step| step >= last);
        let done = run(&disk, folder.path());
        // from either folder
        let said = settle(folder.path(), ["a", "b"][last % 2]);
        let is = content(folder.path());
        assert!(
            is == expected(false) || is == expected(true),
            "killed at step {last}: {is:?}"
        );
        undone += usize::from(said.iter().any(|said| said.starts_with("undone")));
        finished += usize::from(said.iter().any(|said| said.starts_with("finished")));
        assert!(said.len() <= 1, "{said:?}");
        if said.iter().any(|said| said.starts_with("undone")) {
            assert_eq!(is, expected(false), "step {last}");
        }
        steps = count.load(Ordering::SeqCst);
        if done.is_ok() && steps <= last {
            break;
        }
    }
    assert!(
        steps > 40 && undone > 10 && finished > 10,
        "{steps} {undone} {finished}"
    );
}

#[test]
fn a_step_that_fails_changes_nothing_and_leaves_nothing() {
    for last in 0.. {
        let folder = world();
        let (disk, count) = stopped(move |step| step == last);
        match run(&disk, folder.path()) {
            Ok(()) => {
                settle(folder.path(), "a");
                assert_eq!(content(folder.path()), expected(true), "step {last}");
            }
            Err(failure) => {
                assert!(failure.message.contains("stopped"), "{failure:?}");
                // a step of cleaning up may be the one that failed
                settle(folder.path(), "b");
                assert_eq!(content(folder.path()), expected(false), "step {last}");
            }
        }
        if count.load(Ordering::SeqCst) <= last {
            break;
        }
    }
}

#[test]
fn a_kill_while_all_is_put_back_is_put_back_by_the_next_run() {
    // the renames of the second folder fail: from then on two kinds of steps are killed one after
    // another
    for last in 0..60 {
        let folder = world();
        let report = folder
            .path()
            .canonicalize()
            .expect("scratch")
            .join("b/report.html");
        let place = report.clone();
        let (disk, _) = stopped(move |step| {
            let renamed = fs::read_to_string(place.with_file_name("../a/1.mod"));
            let has_begun = renamed.is_ok_and(|text| text.starts_with("new"));
            let report_is_locked = has_begun && step.is_multiple_of(7);
            report_is_locked || step > last
        });
        let _ = run(&disk, folder.path());
        settle(folder.path(), "b");
        let is = content(folder.path());
        assert!(
            is == expected(false) || is == expected(true),
            "step {last}: {is:?}"
        );
    }
}

#[test]
fn what_was_changed_after_a_kill_stays_and_the_rest_is_put_back() {
    let mut seen = 0;
    for last in 0..200 {
        let folder = world();
        let (disk, _) = stopped(move |step| step >= last);
        let _ = run(&disk, folder.path());
        let text = |name: &str| fs::read_to_string(folder.path().join(name)).unwrap_or_default();
        // put in place in part
        if text("a/1.mod") != "new 1" || text("b/report.html") != "old report" {
            continue;
        }
        seen += 1;
        fs::write(folder.path().join("b/report.html"), "mine").expect("scratch");
        let said = settle(folder.path(), "a");
        assert!(said[0].contains("changed by another program"), "{said:?}");
        let mut mine = expected(false);
        mine.insert("b/report.html".into(), "mine".into());
        assert_eq!(content(folder.path()), mine);
    }
    assert!(seen > 1, "{seen}");
}

/// Worlds stopped between two renames: the first files of `a` are new, those of `b` are not.
fn stopped_halfway() -> Vec<tempfile::TempDir> {
    let worlds = (0..200).map(|last| {
        let folder = world();
        let _ = run(&stopped(move |step| step >= last).0, folder.path());
        folder
    });
    let is_half = |folder: &tempfile::TempDir| {
        let text = |name: &str| fs::read_to_string(folder.path().join(name)).expect("scratch");
        text("a/1.mod") == "new 1" && text("b/report.html") == "old report"
    };
    worlds.filter(is_half).collect()
}

/// Files of a run next to their places, those of `a` and `b`.
fn next_to(folder: &Path, ending: &str) -> Vec<PathBuf> {
    let all = ["a", "b"].into_iter().flat_map(|name| {
        let read = fs::read_dir(folder.join(name)).expect("scratch");
        read.map(|found| found.expect("scratch").path())
    });
    let of_run = |path: &PathBuf| {
        let name = path.file_name().expect("a name").to_string_lossy();
        name.starts_with(".poseshift-") && name.ends_with(ending)
    };
    all.filter(of_run).collect()
}

/// A new file that waits for its place; not that of `same.mod`, which is the same without it.
fn waiting(folder: &Path) -> Option<PathBuf> {
    let changes =
        |path: &PathBuf| fs::read_to_string(path).is_ok_and(|text| text.starts_with("new"));
    next_to(folder, ".new").into_iter().find(changes)
}

/// What is done to a file.
type Damage = fn(&Path);
const DAMAGES: [Damage; 3] = [
    |path| fs::write(path, "x").expect("scratch"),
    |path| fs::write(path, "new 2, lonGer").expect("scratch"),
    |path| fs::remove_file(path).expect("scratch"),
];

#[test]
fn a_new_file_that_is_damaged_or_gone_comes_to_no_place_and_all_is_put_back() {
    let mut seen = 0;
    for damage in DAMAGES {
        for folder in stopped_halfway() {
            let Some(file) = waiting(folder.path()) else {
                continue;
            };
            damage(&file);
            seen += 1;
            let said = settle(folder.path(), "a");
            assert!(said[0].starts_with("undone"), "{said:?}");
            assert_eq!(content(folder.path()), expected(false), "{said:?}");
        }
    }
    assert!(seen > 5, "{seen}");
}

#[test]
fn a_new_file_that_another_program_removes_meanwhile_comes_to_no_place_nor_do_the_others() {
    for number in 0..3 {
        let folder = world();
        let failure = run_with(&Disk::default(), folder.path(), |folder| {
            let mut made = next_to(folder, ".new");
            made.sort();
            fs::remove_file(&made[number % made.len()]).expect("scratch");
        })
        .expect_err("one is gone");
        assert!(failure.message.contains("gone"), "{failure:?}");
        assert_eq!(content(folder.path()), expected(false));
    }
}

#[test]
fn what_can_be_neither_finished_nor_undone_is_refused_and_stays_as_it_is() {
    let mut seen = 0;
    for damage in DAMAGES {
        for folder in stopped_halfway() {
            let Some(file) = waiting(folder.path()) else {
                continue;
            };
            damage(&file);
            // what was there before is lost as well
            for backup in next_to(folder.path(), ".old") {
                fs::remove_file(&backup).expect("scratch");
                fs::write(&backup, "nothing of before").expect("scratch");
            }
            seen += 1;
            let places = |folder: &Path| {
                let mut all = content(folder);
                all.retain(|path, _| !path.to_string_lossy().contains(".poseshift-"));
                all
            };
            let before = places(folder.path());
            let whole = folder.path().canonicalize().expect("scratch");
            for _ in 0..2 {
                let refused = recover(&Disk::default(), &whole.join("a")).expect_err("damaged");
                assert!(refused.hint.contains(".old"), "{refused:?}");
                assert_eq!(places(folder.path()), before);
            }
        }
    }
    assert!(seen > 5, "{seen}");
}

#[test]
fn a_journal_from_elsewhere_reaches_no_file_outside_its_folder() {
    let folder = world();
    let whole = folder.path().canonicalize().expect("scratch");
    // as if it came with an archive: what it would rename stands ready
    let (target, id) = (whole.join("b/report.html"), "0123456789abcdef");
    let hash = crate::program::sha256(b"old report");
    fs::write(whole.join(format!("b/.poseshift-{id}-0.new")), "theirs").expect("scratch");
    let entry = format!(
        "{{\"target\": {:?}, \"old\": {hash:?}, \"new\": [[\"\", \"00\"]]}}",
        target.to_str().expect("a plain name")
    );
    let stage = journal::Stage::Commit.line();
    let text = format!(
        "{stage}{{\"what\": \"\", \"id\": {id:?}, \"main\": null, \"entries\": [{entry}]}}"
    );
    fs::write(journal::of(&whole.join("a")), text).expect("scratch");
    recover(&Disk::default(), &whole.join("a")).expect("nothing to do");
    assert_eq!(fs::read_to_string(target).expect("scratch"), "old report");

    // and what is no journal is not taken for one
    fs::write(journal::of(&whole.join("a")), "PK\u{3}\u{4}").expect("scratch");
    let failure = recover(&Disk::default(), &whole.join("a")).expect_err("no journal");
    assert!(failure.hint.contains("remove this one"), "{failure:?}");
}

#[test]
fn new_files_without_a_journal_are_removed_and_named() {
    let folder = world();
    let before = content(folder.path());
    let place = folder.path().canonicalize().expect("scratch").join("a");
    let id = "0123456789abcdef";
    fs::write(place.join(format!(".poseshift-{id}-0.new")), "half").expect("scratch");
    fs::create_dir_all(place.join(format!(".poseshift-{id}-1.new/x"))).expect("scratch");
    // whatever else begins so is somebody's own, and what was replaced is never removed
    for name in [".poseshift-notes.new", &format!(".poseshift-{id}-0.old")] {
        fs::write(place.join(name), "kept").expect("scratch");
    }
    let said = recover(&Disk::default(), &place).expect("nothing in the way");
    let said = said.expect("it is named");
    assert!(said.contains(&format!(".poseshift-{id}-0.new")), "{said}");
    for name in [".poseshift-notes.new", &format!(".poseshift-{id}-0.old")] {
        fs::remove_file(place.join(name)).expect("it is there");
    }
    assert_eq!(content(folder.path()), before);
    let again = recover(&Disk::default(), &place).expect("nothing to do");
    assert_eq!(again, None);
}

#[test]
fn two_runs_into_one_folder_follow_one_another() {
    let folder = world();
    let path = folder.path();
    std::thread::scope(|scope| {
        for _ in 0..4 {
            scope.spawn(|| {
                for _ in 0..5 {
                    run(&Disk::default(), path).unwrap_or_else(|f| panic!("{f:?}"));
                }
            });
        }
    });
    assert_eq!(content(path), expected(true));
}

#[test]
fn what_is_refused_while_it_is_made_leaves_nothing() {
    let folder = world();
    let before = content(folder.path());
    let output = |name: &str| -> NewFile { (folder.path().join(name), b"new".as_slice().into()) };
    let outputs = [output("a/1.mod"), output("a/out/2.mod")];
    let refuse = || Err(Failure::new("it differs"));
    let print = || -> Result<(), Failure> { panic!("it is printed") };
    let refused = Files::default().write(&outputs, refuse, print);
    assert_eq!(refused.expect_err("refused").message, "it differs");
    assert_eq!(content(folder.path()), before);
}

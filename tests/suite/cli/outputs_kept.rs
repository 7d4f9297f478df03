//! Where an output goes: through links to the real file, whose mode and owner stay; never to a
//! device.
#![cfg(unix)]

use crate::support::{WithoutRights, files_below, permit, poseshift, repository, scratch, skipped};
use std::os::unix::fs::{MetadataExt, PermissionsExt, chown, symlink};
use std::path::Path;
use std::process::{Command, Output};
use std::time::SystemTime;

const PROFILE: &str = "robots/abb_irb120_thesis.yaml";
const SAMPLE: &str = "programs/rapid/olp/in/Deburr.mod";

fn world() -> tempfile::TempDir {
    let folder = scratch();
    std::fs::copy(repository(PROFILE), folder.path().join("p.yaml")).expect("scratch");
    std::fs::copy(repository(SAMPLE), folder.path().join("in.mod")).expect("scratch");
    folder
}

fn compensate(folder: &Path, output: &str) -> Output {
    let command = ["compensate", "in.mod", "--profile", "p.yaml", "-o", output];
    let output = poseshift().current_dir(folder).args(command).output();
    output.expect("the program starts")
}

fn reported(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned() + &String::from_utf8_lossy(&output.stdout)
}

fn is_marked(path: &Path) -> bool {
    let text = std::fs::read_to_string(path).unwrap_or_default();
    text.contains("poseshift compensated this file")
}

#[test]
fn links_are_followed_to_the_real_file() {
    let folder = world();
    let path = folder.path();
    std::fs::create_dir(path.join("real")).expect("scratch");
    std::fs::write(path.join("real/out.mod"), "old").expect("scratch");
    symlink("real/out.mod", path.join("first")).expect("scratch");
    symlink("first", path.join("second")).expect("scratch");
    symlink("real/new.mod", path.join("to nothing")).expect("scratch");
    symlink("turn", path.join("round")).expect("scratch");
    symlink("round", path.join("turn")).expect("scratch");
    for (link, file) in [("second", "real/out.mod"), ("to nothing", "real/new.mod")] {
        let output = compensate(path, link);
        assert_eq!(output.status.code(), Some(0), "{}", reported(&output));
        assert!(path.join(link).is_symlink(), "{link} is no link any more");
        assert!(
            !path.join(file).is_symlink() && is_marked(&path.join(file)),
            "{file}"
        );
    }
    let output = compensate(path, "round");
    assert_eq!(output.status.code(), Some(2), "{}", reported(&output));
    assert!(
        reported(&output).contains("too many links"),
        "{}",
        reported(&output)
    );
}

#[test]
fn devices_pipes_sockets_and_folders_are_no_outputs() {
    let folder = world();
    let path = folder.path();
    let pipe = Command::new("mkfifo").arg(path.join("pipe")).status();
    assert!(pipe.expect("mkfifo").success());
    let socket = std::os::unix::net::UnixListener::bind(path.join("socket"));
    let _socket = socket.expect("a socket");
    symlink("/dev/null", path.join("null")).expect("scratch");
    for output in ["/dev/null", "/dev/full", "null", "pipe", "socket"] {
        let reported = reported(&compensate(path, output));
        assert!(
            reported.contains("a device, a pipe or a socket"),
            "{output}: {reported}"
        );
    }
    for output in ["new/", "p.yaml/out.mod"] {
        let done = compensate(path, output);
        assert_eq!(done.status.code(), Some(2), "{output}: {}", reported(&done));
    }
    // other outputs likewise
    for command in [
        "compensate in.mod --profile p.yaml -o out.mod --report pipe",
        "check in.mod --profile p.yaml --junit socket",
        "check in.mod --profile p.yaml --baseline /dev/null --update-baseline",
        "profile new --robot abb_irb120 -o pipe",
    ] {
        let output = poseshift()
            .current_dir(path)
            .args(command.split(' '))
            .output();
        let output = output.expect("the program starts");
        assert_eq!(
            output.status.code(),
            Some(2),
            "{command}: {}",
            reported(&output)
        );
    }
    assert!(!path.join("out.mod").exists());
}

#[test]
fn mode_and_owner_of_a_replaced_file_stay_and_its_time_is_new() {
    let folder = world();
    let out = folder.path().join("out.mod");
    for (mode, owner) in [(0o640, None), (0o604, Some((65534, 65533))), (0o755, None)] {
        std::fs::write(&out, "old").expect("scratch");
        let long_ago = SystemTime::UNIX_EPOCH + std::time::Duration::from_secs(1_000_000_000);
        let file = std::fs::File::options()
            .write(true)
            .open(&out)
            .expect("scratch");
        file.set_modified(long_ago).expect("scratch");
        if let Some((user, group)) = owner
            && chown(&out, Some(user), Some(group)).is_err()
        {
            skipped("owners cannot be changed here");
            continue;
        }
        let permissions = std::fs::Permissions::from_mode(mode);
        std::fs::set_permissions(&out, permissions).expect("scratch");
        let before = std::fs::metadata(&out).expect("a file");
        let done = compensate(folder.path(), "out.mod");
        assert_eq!(done.status.code(), Some(0), "{}", reported(&done));
        let after = std::fs::metadata(&out).expect("a file");
        assert!(is_marked(&out));
        assert_eq!(after.mode(), before.mode());
        assert_eq!((after.uid(), after.gid()), (before.uid(), before.gid()));
        assert!(after.modified().expect("a time") > long_ago, "{mode:o}");
        std::fs::remove_file(&out).expect("scratch");
    }
    std::fs::write(&out, "old").expect("scratch");
    let locked = std::fs::Permissions::from_mode(0o444);
    std::fs::set_permissions(&out, locked).expect("scratch");
    let done = compensate(folder.path(), "out.mod");
    assert_eq!(done.status.code(), Some(2), "{}", reported(&done));
    assert_eq!(std::fs::read(&out).expect("a file"), b"old");
}

#[test]
fn new_files_and_folders_obey_the_umask() {
    for (umask, file, below) in [
        ("022", 0o644, 0o755),
        ("077", 0o600, 0o700),
        ("002", 0o664, 0o775),
    ] {
        let folder = world();
        let line = format!(
            "umask {umask}; exec \"$POSESHIFT\" compensate in.mod --profile p.yaml -o new/out.mod \
             --report r.html"
        );
        let output = Command::new("bash")
            .args(["-c", &line])
            .current_dir(folder.path())
            .env("POSESHIFT", env!("CARGO_BIN_EXE_poseshift"))
            .output()
            .expect("a shell");
        assert_eq!(output.status.code(), Some(0), "{}", reported(&output));
        for (name, mode) in [("new/out.mod", file), ("r.html", file), ("new", below)] {
            let found = std::fs::metadata(folder.path().join(name)).expect(name);
            assert_eq!(found.mode() & 0o777, mode, "{name} with {umask}");
        }
    }
}

#[test]
fn who_may_not_write_there_changes_nothing() {
    let folder = world();
    let path = folder.path();
    for name in ["closed", "open"] {
        std::fs::create_dir(path.join(name)).expect("scratch");
        std::fs::write(path.join(name).join("out.mod"), "old").expect("scratch");
    }
    let Some(without) = WithoutRights::new() else {
        return;
    };
    let compensate = |output: &str| {
        let command = ["compensate", "in.mod", "--profile", "p.yaml", "-o", output];
        let done = without.run(path, &command);
        let said = reported(&done);
        let said = said.split_whitespace().collect::<Vec<_>>().join(" ");
        (done.status.code(), said)
    };
    let old = |name: &str| std::fs::read(path.join(name)).expect("a file") == b"old";

    permit(&path.join("closed"), 0o555);
    for output in ["closed/out.mod", "closed/new.mod", "closed/new/new.mod"] {
        let before = files_below(path);
        let (status, said) = compensate(output);
        assert_eq!(status, Some(2), "{said}");
        for word in ["cannot write", "closed", "ermission denied"] {
            assert!(said.contains(word), "{output}: {said}");
        }
        assert_eq!(files_below(path), before);
        assert!(old("closed/out.mod"));
    }
    permit(&path.join("closed"), 0o755);

    // what is one's own stays so
    let out = path.join("open/out.mod");
    permit(&out, 0o640);
    let owner = std::fs::metadata(&out).expect("a file").uid();
    let (status, said) = compensate("open/out.mod");
    assert_eq!(status, Some(0), "{said}");
    let after = std::fs::metadata(&out).expect("a file");
    assert!(is_marked(&out));
    assert_eq!((after.uid(), after.mode() & 0o777), (owner, 0o640));

    // what is another's cannot stay so, and is left
    std::fs::write(&out, "old").expect("scratch");
    if chown(&out, Some(owner + 1), None).is_err() {
        return skipped("owners cannot be changed here");
    }
    permit(&out, 0o666);
    let (status, said) = compensate("open/out.mod");
    assert_eq!(status, Some(2), "{said}");
    for word in ["its owner", "cannot be kept"] {
        assert!(said.contains(word), "{said}");
    }
    assert!(old("open/out.mod"));
    assert_eq!(files_below(&path.join("open")).len(), 1);
}

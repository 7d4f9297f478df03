//! Nothing that is read is written over, whatever it is called; and nothing is written of what has
//! changed since it was read.

use crate::support::{poseshift, repository, scratch};
use std::io::Read;
use std::path::Path;
use std::process::{Command, Output, Stdio};

const PROFILE: &str = "robots/abb_irb120_thesis.yaml";
const SAMPLE: &str = "programs/rapid/olp/in/Deburr.mod";
const CELL: &str = "poseshift: cell/1\nbodies:\n  - {name: far, mesh: mesh.stl, scale: 1.0, at: \
    {x_mm: 9000, y_mm: 0, z_mm: 0, \
                    rx_deg: 0, ry_deg: 0, rz_deg: 0}}\n";
const MESH: &str = "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 900 0 0\nvertex \
    0 900 0\nendloop\nendfacet\nendsolid s\n";

/// A profile, a program, and a cell with a mesh.
fn world() -> tempfile::TempDir {
    let folder = scratch();
    std::fs::copy(repository(PROFILE), folder.path().join("p.yaml")).expect("scratch");
    std::fs::copy(repository(SAMPLE), folder.path().join("in.mod")).expect("scratch");
    std::fs::create_dir(folder.path().join("originals")).expect("scratch");
    let original = folder.path().join("originals/Deburr.mod");
    std::fs::copy(repository(SAMPLE), original).expect("scratch");
    std::fs::write(folder.path().join("cell.yaml"), CELL).expect("scratch");
    std::fs::write(folder.path().join("mesh.stl"), MESH).expect("scratch");
    folder
}

fn run(folder: &Path, arguments: &[&str]) -> Output {
    let output = poseshift().current_dir(folder).args(arguments).output();
    output.expect("the program starts")
}

fn reported(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned() + &String::from_utf8_lossy(&output.stdout)
}

fn bytes(folder: &Path, name: &str) -> Vec<u8> {
    std::fs::read(folder.join(name)).expect("a file")
}

/// Asserts that an output onto this input is refused.
fn refused(folder: &Path, input: &str, command: &str) {
    let before = bytes(folder, input);
    let arguments: Vec<&str> = command.split(' ').collect();
    let output = run(folder, &arguments);
    let reported = reported(&output);
    assert_eq!(output.status.code(), Some(2), "{command}: {reported}");
    assert!(
        reported.contains("would be written over"),
        "{command}: {reported}"
    );
    assert_eq!(bytes(folder, input), before, "{command}");
}

#[cfg(unix)]
#[test]
fn an_output_onto_an_input_is_refused_whatever_its_name() {
    use std::os::unix::fs::symlink;
    let folder = world();
    let path = folder.path();
    symlink("in.mod", path.join("link.mod")).expect("scratch");
    symlink("link.mod", path.join("link of link.mod")).expect("scratch");
    symlink(".", path.join("here")).expect("scratch");
    std::fs::hard_link(path.join("in.mod"), path.join("hard.mod")).expect("scratch");
    let compensate = |output: &str| format!("compensate in.mod --profile p.yaml -o {output}");
    for output in [
        "in.mod",
        "./in.mod",
        "newdir/../in.mod",
        "originals/../in.mod",
        "here/here/in.mod",
        "link.mod",
        "hard.mod",
        "p.yaml",
        "here/p.yaml",
    ] {
        refused(path, "in.mod", &compensate(output));
        assert!(!path.join("newdir").exists());
    }
    let spaced = [
        "compensate",
        "in.mod",
        "--profile",
        "p.yaml",
        "-o",
        "link of link.mod",
    ];
    let output = run(path, &spaced);
    assert_eq!(output.status.code(), Some(2), "{}", reported(&output));
    // the input by another name, the output by its own
    for input in ["link.mod", "hard.mod", "here/in.mod", "newer/../in.mod"] {
        let command = format!("compensate {input} --profile p.yaml -o in.mod");
        if input.starts_with("newer") {
            std::fs::create_dir(path.join("newer")).expect("scratch");
        }
        refused(path, "in.mod", &command);
    }
    // through standard input
    let line = "\"$POSESHIFT\" compensate - --profile p.yaml -o in.mod < in.mod";
    let before = bytes(path, "in.mod");
    let output = Command::new("bash")
        .args(["-c", line])
        .current_dir(path)
        .env("POSESHIFT", env!("CARGO_BIN_EXE_poseshift"))
        .output()
        .expect("a shell");
    assert_eq!(output.status.code(), Some(2), "{}", reported(&output));
    assert_eq!(bytes(path, "in.mod"), before);
}

#[cfg(target_os = "linux")]
#[test]
fn names_that_are_no_text_are_files_like_others() {
    use std::ffi::OsStr;
    use std::os::unix::ffi::OsStrExt;
    let folder = world();
    let path = folder.path();
    let (one, other) = (
        OsStr::from_bytes(b"a\xff.mod"),
        OsStr::from_bytes(b"a\xfe.mod"),
    );
    std::fs::rename(path.join("in.mod"), path.join(one)).expect("scratch");
    let compensate = |output: &OsStr| {
        let mut command = poseshift();
        command.current_dir(path).arg("compensate").arg(one);
        command.args(["--profile", "p.yaml", "-o"]).arg(output);
        command.output().expect("the program starts")
    };
    let before = std::fs::read(path.join(one)).expect("a file");
    let output = compensate(one);
    assert_eq!(output.status.code(), Some(2), "{}", reported(&output));
    assert_eq!(std::fs::read(path.join(one)).expect("a file"), before);
    // both look the same in messages, and are not
    let output = compensate(other);
    assert_eq!(output.status.code(), Some(0), "{}", reported(&output));
    assert_ne!(std::fs::read(path.join(other)).expect("written"), before);
}

#[test]
fn what_profiles_cells_and_folders_name_is_an_input_too() {
    let folder = world();
    let path = folder.path();
    let check = "check in.mod --profile p.yaml --cell cell.yaml --nominal originals --force";
    for (input, option) in [
        ("mesh.stl", "--junit mesh.stl"),
        ("mesh.stl", "--report ./mesh.stl"),
        ("cell.yaml", "--junit cell.yaml"),
        ("originals/Deburr.mod", "--junit originals/Deburr.mod"),
        (
            "originals/Deburr.mod",
            "--baseline originals/Deburr.mod --update-baseline",
        ),
        ("in.mod", "--report originals/../in.mod"),
    ] {
        refused(path, input, &format!("{check} {option}"));
    }
    refused(
        path,
        "originals/Deburr.mod",
        "compensate in.mod --profile p.yaml --with originals -o originals/Deburr.mod",
    );
}

/// A frame, a baseline, and a cell with a part in glTF, next to the rest of a [`world`].
fn world_of_all_inputs() -> tempfile::TempDir {
    let folder = world();
    let path = folder.path();
    let write = |name: &str, text: &str| {
        std::fs::write(path.join(name), text).expect("scratch");
    };
    let cam = repository("programs/rapid/cam/in/cam.mod");
    for name in ["in.mod", "originals/in.mod"] {
        std::fs::copy(&cam, path.join(name)).expect("scratch");
    }
    let at = "at: {x_mm: 9000, y_mm: 0, z_mm: 0, rx_deg: 0, ry_deg: 0, rz_deg: 0}";
    write(
        "cell.yaml",
        &format!("{CELL}  - {{name: part, mesh: part.gltf, {at}}}\n"),
    );
    let corners = [[0.0_f32; 3], [0.1, 0.0, 0.0], [0.0, 0.1, 0.0]];
    let bytes: Vec<u8> = corners
        .iter()
        .flatten()
        .flat_map(|m| m.to_le_bytes())
        .collect();
    std::fs::write(path.join("part.bin"), bytes).expect("scratch");
    write(
        "part.gltf",
        r#"{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
        "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],
        "bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"uri":"part.bin","byteLength":36}]}"#,
    );
    write(
        "offset.yaml",
        "poseshift: frame/1\npose: {x_mm: 0.5, y_mm: 0, z_mm: 0, rx_deg: 0, ry_deg: 0, rz_deg: 0}\n",
    );
    folder
}

#[test]
fn an_input_that_changes_before_the_end_is_an_error() {
    const COMPENSATE: &str = "compensate in.mod --profile p.yaml -o out.mod --json";
    const CHECK: &str =
        "check in.mod --profile p.yaml --cell cell.yaml --json --report out.html --force";
    let with = &format!("{COMPENSATE} --with originals/Deburr.mod");
    let offset = &format!("{COMPENSATE} --work-offset offset.yaml");
    let nominal = &format!("{CHECK} --nominal originals/in.mod");
    let baseline = &format!("{CHECK} --baseline base.json");
    for (input, how, command) in [
        ("in.mod", "changed", COMPENSATE),
        ("p.yaml", "removed", COMPENSATE),
        ("in.mod", "replaced", COMPENSATE),
        ("originals/Deburr.mod", "changed", with),
        ("offset.yaml", "changed", offset),
        ("in.mod", "changed", CHECK),
        ("p.yaml", "changed", CHECK),
        ("cell.yaml", "changed", CHECK),
        ("mesh.stl", "changed", CHECK),
        ("part.gltf", "removed", CHECK),
        ("part.bin", "changed", CHECK),
        ("originals/in.mod", "changed", nominal),
        ("base.json", "changed", baseline),
    ] {
        let folder = world_of_all_inputs();
        let path = folder.path();
        if input == "base.json" {
            let made = format!("{baseline} --update-baseline");
            let made = run(path, &made.split(' ').collect::<Vec<_>>());
            assert!(path.join(input).exists(), "{}", reported(&made));
            std::fs::remove_file(path.join("out.html")).expect("a page");
        }
        // it waits for whoever reads its report, with all files ready
        let mut child = Command::new(env!("CARGO_BIN_EXE_poseshift"))
            .current_dir(path)
            .args(command.split(' '))
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("the program starts");
        let mut out = child.stdout.take().expect("a pipe");
        let mut first = [0];
        out.read_exact(&mut first).expect("a report");
        let file = path.join(input);
        match how {
            "changed" => {
                let mut text = std::fs::read(&file).expect("the input");
                let at = text.len() / 2;
                text[at] = if text[at] == b' ' { b'0' } else { b' ' };
                std::fs::write(&file, text).expect("scratch");
            }
            "removed" => std::fs::remove_file(&file).expect("scratch"),
            _ => {
                std::fs::write(path.join("other"), "MODULE m\nENDMODULE\n").expect("scratch");
                std::fs::rename(path.join("other"), &file).expect("scratch");
            }
        }
        out.read_to_end(&mut Vec::new()).expect("a report");
        let output = child.wait_with_output().expect("it ended");
        let reported = reported(&output);
        assert_eq!(output.status.code(), Some(2), "{input} {how}: {reported}");
        assert!(
            reported.contains(&format!("{input} was ")),
            "{input} {how}: {reported}"
        );
        for output in ["out.mod", "out.html"] {
            assert!(!path.join(output).exists(), "{input} {how}");
        }
        let left = std::fs::read_dir(path).expect("scratch");
        let left = left.filter(|entry| {
            let name = entry.as_ref().expect("an entry").file_name();
            name.to_string_lossy().starts_with(".poseshift")
        });
        assert_eq!(left.count(), 0, "{input} {how}");
    }
}

#[test]
fn a_program_that_comes_to_the_folder_before_the_end_is_an_error() {
    for (new, says) in [
        ("in/new.mod", Some("in/new.mod was added")),
        ("in/below/new.sys", Some("in/below/new.sys was added")),
        ("with/new.mod", Some("with/new.mod was added")),
        // what is left out, and what no run reads
        ("in/old.mod", None),
        ("in/notes.txt", None),
        ("new.mod", None),
    ] {
        let folder = world();
        let path = folder.path();
        let cam = repository("programs/rapid/cam/in/cam.mod");
        for name in ["in/below", "with"] {
            std::fs::create_dir_all(path.join(name)).expect("scratch");
        }
        std::fs::copy(cam, path.join("in/cam.mod")).expect("scratch");
        std::fs::copy(repository(SAMPLE), path.join("with/Deburr.mod")).expect("scratch");
        // it waits for whoever reads its report, with all files ready
        let mut child = Command::new(env!("CARGO_BIN_EXE_poseshift"))
            .current_dir(path)
            .args(["compensate", "in", "--with", "with", "--profile", "p.yaml"])
            .args(["-o", "out", "--json", "--ignore", "old.*"])
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("the program starts");
        let mut out = child.stdout.take().expect("a pipe");
        let mut first = [0];
        out.read_exact(&mut first).expect("a report");
        std::fs::copy(repository(SAMPLE), path.join(new)).expect("scratch");
        out.read_to_end(&mut Vec::new()).expect("a report");
        let output = child.wait_with_output().expect("it ended");
        let reported = reported(&output);
        let status = if says.is_some() { 2 } else { 0 };
        assert_eq!(output.status.code(), Some(status), "{new}: {reported}");
        assert!(
            says.is_none_or(|says| reported.contains(says)),
            "{new}: {reported}"
        );
        assert_eq!(path.join("out").exists(), says.is_none(), "{new}");
        let left = std::fs::read_dir(path).expect("scratch");
        let left = left.filter(|entry| {
            let name = entry.as_ref().expect("an entry").file_name();
            name.to_string_lossy().starts_with(".poseshift")
        });
        assert_eq!(left.count(), 0, "{new}");
    }
}

#[test]
fn an_input_that_is_only_touched_has_not_changed() {
    let folder = world();
    let path = folder.path();
    let fresh = std::fs::File::options()
        .write(true)
        .open(path.join("in.mod"));
    let fresh = fresh.expect("the input");
    fresh
        .set_modified(std::time::SystemTime::now())
        .expect("scratch");
    let output = run(
        path,
        &[
            "compensate",
            "in.mod",
            "--profile",
            "p.yaml",
            "-o",
            "out.mod",
        ],
    );
    assert_eq!(output.status.code(), Some(0), "{}", reported(&output));
}

//! A folder passes nothing over in silence.

#[cfg(unix)]
use crate::support::{WithoutRights, permit};
use crate::support::{files_below, poseshift, repository, scratch};
use serde_json::Value;
use std::path::Path;
use std::process::Output;

const PROFILE: &str = "robots/abb_irb120_thesis.yaml";
const SAMPLE: &str = "programs/rapid/olp/in/Deburr.mod";

/// A folder `in` with one program.
fn world() -> tempfile::TempDir {
    let folder = scratch();
    std::fs::copy(repository(PROFILE), folder.path().join("p.yaml")).expect("scratch");
    std::fs::create_dir(folder.path().join("in")).expect("scratch");
    std::fs::copy(repository(SAMPLE), folder.path().join("in/Deburr.mod")).expect("scratch");
    folder
}

fn run(folder: &Path, command: &[&str]) -> Output {
    let output = poseshift()
        .current_dir(folder)
        .args(command)
        .args(["--profile", "p.yaml"])
        .output();
    output.expect("the program starts")
}

fn reported(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned() + &String::from_utf8_lossy(&output.stdout)
}

/// Asserts that the folder is refused with these words, and taken when the files are left out.
fn refused(folder: &Path, words: &[&str], glob: &str) {
    let before = files_below(folder);
    for command in [&["compensate", "in", "-o", "out"][..], &["check", "in"]] {
        let output = run(folder, command);
        let said = reported(&output);
        assert_eq!(output.status.code(), Some(2), "{said}");
        let flat = said.split_whitespace().collect::<Vec<_>>().join(" ");
        for word in words {
            assert!(flat.contains(word), "{word}: {said}");
        }
        assert!(said.contains("--ignore"), "{said}");
        assert_eq!(files_below(folder), before);
        let taken = run(folder, &[command, &["--ignore", glob]].concat());
        let said = reported(&taken);
        assert!(
            said.contains("--ignore)") && said.contains("ignored"),
            "{said}"
        );
        assert_eq!(taken.status.code(), Some(0), "{said}");
        let _ = std::fs::remove_dir_all(folder.join("out"));
    }
}

fn utf_16(text: &str, little: bool) -> Vec<u8> {
    let units = std::iter::once(0xfeff).chain(text.encode_utf16());
    units
        .flat_map(|unit: u16| {
            if little {
                unit.to_le_bytes()
            } else {
                unit.to_be_bytes()
            }
        })
        .collect()
}

#[test]
fn texts_that_cannot_be_read_as_programs_are_named() {
    let sample = std::fs::read_to_string(repository(SAMPLE)).expect("the sample");
    for (content, words) in [
        (Vec::new(), "x.mod: it is empty"),
        (b" \r\n\r\n".to_vec(), "x.mod: it is empty"),
        (utf_16(&sample, true), "x.mod: it is UTF-16"),
        (utf_16(&sample, false), "x.mod: it is UTF-16"),
        (
            utf_16(&sample, true)[2..].to_vec(),
            "x.mod: it holds bytes that are 0",
        ),
        (vec![0; 4096], "x.mod: it holds bytes that are 0"),
        (
            b"MODU".to_vec(),
            "x.mod: it is called as ABB RAPID, and is none",
        ),
        (
            b"\xff\xd8\xff\xe0 a picture".to_vec(),
            "x.mod: it is called as ABB RAPID, and is none",
        ),
    ] {
        let folder = world();
        std::fs::write(folder.path().join("in/x.mod"), content).expect("scratch");
        refused(folder.path(), &[words], "x.mod");
    }
    for (content, why) in [
        (
            "x_mm;y_mm;z_mm;qw;qx;qy;qz\n1;2;3;1;0;0;0\n",
            "1:1: found a semicolon or a tab",
        ),
        (
            "x_mm,y_mm,z_mm,rx_deg\n",
            "1:1: found a header without `qw`",
        ),
        ("a,b\n1,2\n", "truncated?"),
    ] {
        let folder = world();
        std::fs::write(folder.path().join("in/x.csv"), content).expect("scratch");
        let words = format!("x.csv: it is called as CSV of poses or joints, and is none: {why}");
        refused(folder.path(), &[&words], "x.csv");
    }
    // given alone likewise
    let folder = world();
    std::fs::write(folder.path().join("x.mod"), utf_16(&sample, true)).expect("scratch");
    std::fs::write(folder.path().join("y.mod"), "").expect("scratch");
    for (name, word) in [("x.mod", "UTF-16"), ("y.mod", "empty")] {
        let output = run(folder.path(), &["compensate", name, "-o", "out.mod"]);
        assert_eq!(output.status.code(), Some(2), "{}", reported(&output));
        assert!(reported(&output).contains(word), "{}", reported(&output));
    }
}

#[test]
fn a_program_that_ends_too_early_is_named() {
    let sample = std::fs::read_to_string(repository(SAMPLE)).expect("the sample");
    for end in [
        sample.len() / 2,
        sample.len() / 3,
        sample.trim_end().len() - 2,
    ] {
        let folder = world();
        std::fs::write(folder.path().join("in/Deburr.mod"), &sample[..end]).expect("scratch");
        let output = run(folder.path(), &["compensate", "in", "-o", "out"]);
        assert_eq!(
            output.status.code(),
            Some(2),
            "{end}: {}",
            reported(&output)
        );
        assert!(
            reported(&output).contains("Deburr.mod"),
            "{}",
            reported(&output)
        );
        assert!(!folder.path().join("out").exists());
    }
}

#[test]
fn a_script_that_ends_inside_its_last_call_is_named() {
    let folder = scratch();
    let script =
        "def a():\n  set_tcp(p[0,0,0,0,0,0])\n  movej([0,-1.5,1.5,-1.5,-1.5,0])\nend\na()\n";
    for (end, expected) in [
        (script.len(), 1),
        (script.len() - 3, 2),
        (script.len() - 2, 2),
    ] {
        std::fs::write(folder.path().join("a.script"), &script[..end]).expect("scratch");
        let output = poseshift()
            .current_dir(folder.path())
            .args(["check", "a.script", "--profile"])
            .arg(repository("robots/universal_robots_ur5.yaml"))
            .output()
            .expect("the program starts");
        let is_refused = output.status.code() == Some(2);
        assert_eq!(is_refused, expected == 2, "{end}: {}", reported(&output));
        assert!(!is_refused || reported(&output).contains("a.script"));
    }
}

#[cfg(unix)]
#[test]
fn links_pipes_and_what_may_not_be_read_are_named() {
    use std::os::unix::fs::symlink;
    let folder = world();
    let path = folder.path();
    std::fs::copy(repository(SAMPLE), path.join("other.mod")).expect("scratch");
    std::fs::create_dir(path.join("elsewhere")).expect("scratch");
    for (link, target) in [
        ("in/l.mod", "../other.mod"),
        ("in/l.mod", "nothing"),
        ("in/l.mod", "l.mod"),
        ("in/l", "../elsewhere"),
    ] {
        symlink(target, path.join(link)).expect("scratch");
        refused(path, &[&format!("{link}: it is a link")], "l*");
        std::fs::remove_file(path.join(link)).expect("scratch");
    }
    let pipe = std::process::Command::new("mkfifo")
        .arg(path.join("in/f.mod"))
        .status();
    assert!(pipe.expect("mkfifo").success());
    refused(
        path,
        &["in/f.mod: it is a device, a pipe or a socket"],
        "f.*",
    );
    std::fs::remove_file(path.join("in/f.mod")).expect("scratch");
    // all of them are named at once
    symlink("nothing", path.join("in/a.mod")).expect("scratch");
    std::fs::write(path.join("in/b.mod"), "").expect("scratch");
    refused(
        path,
        &["in/a.mod: it is a link", "in/b.mod: it is empty"],
        "[ab].mod",
    );
}

#[cfg(unix)]
#[test]
fn files_and_folders_without_permission_are_named() {
    let folder = world();
    let path = folder.path();
    std::fs::copy(repository(SAMPLE), path.join("in/x.mod")).expect("scratch");
    std::fs::create_dir(path.join("in/locked")).expect("scratch");
    std::fs::write(path.join("in/locked/y.mod"), "MODULE y\nENDMODULE\n").expect("scratch");
    let Some(without) = WithoutRights::new() else {
        return;
    };
    let check = ["check", "in", "--profile", "p.yaml"];
    let folders = ["compensate", "in", "-o", "out", "--profile", "p.yaml"];
    let one = [
        "compensate",
        "in/x.mod",
        "-o",
        "x.mod",
        "--profile",
        "p.yaml",
    ];
    for (closed, command, glob) in [
        ("in/x.mod", &check[..], Some("x.*")),
        ("in/x.mod", &folders, Some("x.*")),
        ("in/x.mod", &one, None),
        ("in/locked", &check, Some("locked")),
        ("in/locked", &folders, Some("locked")),
        ("p.yaml", &check, None),
        ("p.yaml", &folders, None),
    ] {
        let before = files_below(path);
        permit(&path.join(closed), 0o000);
        let refused = without.run(path, command);
        let said = reported(&refused);
        let said = said.split_whitespace().collect::<Vec<_>>().join(" ");
        assert_eq!(refused.status.code(), Some(2), "{closed}: {said}");
        for word in [closed, "ermission denied"] {
            assert!(said.contains(word), "{closed}: {said}");
        }
        if let Some(glob) = glob {
            let taken = without.run(path, &[command, &["--ignore", glob]].concat());
            assert_eq!(taken.status.code(), Some(0), "{}", reported(&taken));
            let written = std::fs::remove_dir_all(path.join("out"));
            assert_eq!(written.is_ok(), command == folders);
        }
        permit(&path.join(closed), 0o755);
        assert_eq!(files_below(path), before);
    }
}

#[test]
fn logs_of_a_backup_are_passed_over_and_listed() {
    let folder = scratch();
    let path = folder.path();
    std::fs::create_dir_all(path.join("in")).expect("scratch");
    let sample = repository("programs/fanuc/olp/in/seal.ls");
    std::fs::copy(sample, path.join("in/seal.ls")).expect("scratch");
    for name in ["ERRALL.LS", "logbook.ls", "posreg.va", "sysmast.va"] {
        std::fs::write(path.join("in").join(name), "F Number: F00000\n").expect("scratch");
    }
    let profile = repository("programs/fanuc/profile.yaml");
    std::fs::copy(profile, path.join("p.yaml")).expect("scratch");
    let check = ["check", "in", "--frame", "4=1400,350,-200,0,0,-15"];
    let output = run(path, &[&check[..], &["--json"]].concat());
    let report: Value =
        serde_json::from_slice(&output.stdout).unwrap_or_else(|_| panic!("{}", reported(&output)));
    let other = [
        "in/ERRALL.LS",
        "in/logbook.ls",
        "in/posreg.va",
        "in/sysmast.va",
    ];
    assert_eq!(
        report["summary"]["left_out"]["other"],
        serde_json::json!(other)
    );
    for (name, word) in [
        ("weld.ls", "weld.ls"),
        ("sysframe.va", "sysframe.va"),
        ("FRAME.DG", "FRAME.DG"),
    ] {
        let at = path.join("in").join(name);
        std::fs::write(&at, "F Number: F00000\n").expect("scratch");
        let output = run(path, &check);
        assert_eq!(output.status.code(), Some(2), "{name}");
        assert!(reported(&output).contains(word), "{}", reported(&output));
        std::fs::remove_file(at).expect("scratch");
    }
}

#[test]
fn what_is_left_out_stands_in_the_summary() {
    let folder = world();
    let path = folder.path();
    std::fs::create_dir_all(path.join("in/old/older")).expect("scratch");
    for name in ["in/old/a.mod", "in/old/older/b.mod", "in/Deburr copy.mod"] {
        std::fs::write(path.join(name), "").expect("scratch");
    }
    std::fs::write(path.join("in/notes.txt"), "of the shift").expect("scratch");
    std::fs::write(path.join("in/cell.yaml"), "poseshift: cell/1").expect("scratch");
    for globs in [
        &["old", "* copy.mod"][..],
        &["old/", "*copy*"],
        &["old/**", "{Deburr copy,x}.mod"],
        // as the summary shows them
        &["in/old/", "in/Deburr copy.mod"],
    ] {
        let mut command = vec!["check", "in"];
        for glob in globs {
            command.extend(["--ignore", glob]);
        }
        let output = run(path, &[&command[..], &["--json"]].concat());
        let report: Value = serde_json::from_slice(&output.stdout)
            .unwrap_or_else(|_| panic!("{}", reported(&output)));
        let left_out = &report["summary"]["left_out"];
        let names = |key: &str| -> Vec<String> {
            let list = left_out[key].as_array().expect("names");
            list.iter()
                .map(|name| name.as_str().expect("a name").to_owned())
                .collect()
        };
        assert_eq!(names("other"), ["in/cell.yaml", "in/notes.txt"]);
        assert!(
            names("ignored").contains(&"in/Deburr copy.mod".to_owned()),
            "{left_out}"
        );
        assert!(
            names("ignored")
                .iter()
                .any(|name| name.starts_with("in/old/")),
            "{left_out}"
        );
        let text = reported(&run(path, &command));
        assert!(
            text.contains("2 (no programs, by their names): in/cell.yaml, in/notes.txt"),
            "{text}"
        );
        assert!(text.contains("(--ignore): in/Deburr copy.mod"), "{text}");
        assert!(!text.contains("nothing is left out for it"), "{text}");
    }
    // one that means nothing is a misspelt one
    for words in [vec!["check"], vec!["compensate", "-o", "out.mod"]] {
        let ignored = ["--ignore", "zzz"];
        let text = reported(&run(
            path,
            &[&words[..], &["in/Deburr.mod"], &ignored].concat(),
        ));
        assert!(text.contains("--ignore zzz: no file or folder"), "{text}");
    }
    let output = run(path, &["check", "in", "--ignore", "a[.mod"]);
    assert_eq!(output.status.code(), Some(2), "{}", reported(&output));
    assert!(
        reported(&output).contains("--ignore a[.mod"),
        "{}",
        reported(&output)
    );
    // files that are read for their declarations likewise
    let output = run(path, &["check", "in/Deburr.mod", "--with", "in"]);
    assert_eq!(output.status.code(), Some(2), "{}", reported(&output));
    let output = run(
        path,
        &[
            "check",
            "in/Deburr.mod",
            "--with",
            "in",
            "--ignore",
            "old",
            "--ignore",
            "*copy*",
        ],
    );
    assert_eq!(output.status.code(), Some(0), "{}", reported(&output));
}

#[test]
fn a_file_that_is_given_twice_is_refused() {
    let folder = world();
    let path = folder.path();
    let below = path.join("in/below");
    std::fs::create_dir(&below).expect("scratch");
    std::fs::hard_link(path.join("in/Deburr.mod"), below.join("Deburr.mod")).expect("scratch");
    for twice in [["in", "in/below"], ["in/Deburr.mod", "./in/Deburr.mod"]] {
        let output = run(path, &["compensate", twice[0], twice[1], "-o", "out"]);
        let said = reported(&output);
        assert_eq!(output.status.code(), Some(2), "{said}");
        assert!(said.contains("Deburr.mod is given twice"), "{said}");
        assert!(!path.join("out").exists());
    }
    // another name of the same bytes is a file of its own
    let output = run(path, &["check", "in", "--only", "below/Deburr"]);
    let said = reported(&output);
    assert!(!said.contains("given twice"), "{said}");
}

#[test]
fn one_file_of_a_module_means_the_others_of_its_name() {
    let folder = scratch();
    let path = folder.path();
    std::fs::create_dir(path.join("in")).expect("scratch");
    std::fs::copy(repository("programs/krl/profile.yaml"), path.join("p.yaml")).expect("scratch");
    let data = "&ACCESS RVP\nDEFDAT $CONFIG\nDECL FRAME TOOL_DATA[16]\nTOOL_DATA[1]={X 0.0,Y 0.0,Z \
        100.0,A 0.0,B 0.0,C 0.0}\nDECL FRAME BASE_DATA[32]\nBASE_DATA[1]={X 0.0,Y 0.0,Z 0.0,A \
        0.0,B 0.0,C 0.0}\nENDDAT\n";
    std::fs::write(path.join("in/$config.dat"), data).expect("scratch");
    for (name, x) in [("a", 700), ("b", 720)] {
        let program = format!(
            "DEF {name}()\nBAS(#TOOL,1)\nBAS(#BASE,1)\nPTP {{A1 0,A2 -90,A3 90,A4 0,A5 30,A6 \
             0}}\nLIN XP1\nEND\n"
        );
        let point = format!(
            "DEFDAT {name}\nDECL E6POS XP1={{X {x}.0,Y 0.0,Z 700.0,A 180.0,B 30.0,C 180.0}}\nENDDAT\n"
        );
        std::fs::write(path.join(format!("in/{name}.src")), program).expect("scratch");
        std::fs::write(path.join(format!("in/{name}.dat")), point).expect("scratch");
    }
    for only in ["b", "b.src", "b.dat", "in/b.src"] {
        let command = ["compensate", "in", "-o", "out", "--only", only, "--json"];
        let output = run(path, &command);
        let said = reported(&output);
        let report: Value = serde_json::from_slice(&output.stdout).expect("JSON");
        assert_eq!(
            report["input"],
            serde_json::json!(["in/b.dat", "in/b.src"]),
            "{said}"
        );
        let _ = std::fs::remove_dir_all(path.join("out"));
    }
}

#[test]
fn of_several_files_the_text_of_check_names_the_one_that_is_worst() {
    let folder = world();
    let path = folder.path();
    let said = |folder: &str| reported(&run(path, &["check", folder]));
    let one = said("in");
    assert!(one.contains("mm (line "), "{one}");
    let text = std::fs::read_to_string(path.join("in/Deburr.mod")).expect("scratch");
    let other = text.replace("MODULE Deburr", "MODULE Other");
    std::fs::create_dir(path.join("in/next")).expect("scratch");
    std::fs::write(path.join("in/next/Other.mod"), other).expect("scratch");
    let both = run(path, &["check", "in", "--json"]);
    let report: Value = serde_json::from_slice(&both.stdout).expect("JSON");
    let files: Vec<&str> = report["moves"]
        .as_array()
        .expect("moves")
        .iter()
        .map(|one| one["file"].as_str().expect("a name"))
        .collect();
    assert!(files.contains(&"in/next/Other.mod"), "{files:?}");
    let both = said("in").split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(
        both.contains("mm (in/next/Other.mod line ") || both.contains("mm (in/Deburr.mod line "),
        "{both}"
    );
}

#[test]
fn what_is_refused_next_to_good_programs_is_named_with_the_reason() {
    let folder = world();
    let path = folder.path();
    let module = |name: &str, data: &str, target: &str| {
        let text = format!(
            "MODULE {name}\n{data}PROC p{name}()\nMoveJ {target},v100,fine,artifact;\nENDPROC\nENDMODULE\n"
        );
        std::fs::write(path.join(format!("in/{name}.mod")), text).expect("scratch");
    };
    let data = |name: &str, x: f64| {
        format!(
            "PERS robtarget {name} := [[{x},50,420],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\n"
        )
    };
    module("Bad", &(data("far", 1400.0) + &data("near", 400.0)), "far");
    module("Shares", "", "near");
    std::fs::remove_file(path.join("in/Deburr.mod")).expect("scratch");
    let command = [
        "compensate",
        "in",
        "--write-good",
        "-o",
        "out",
        "--report",
        "r.html",
    ];
    let output = run(path, &command);
    let flat = |output: &Output| {
        let said = reported(output);
        said.split_whitespace().collect::<Vec<_>>().join(" ")
    };
    assert_eq!(output.status.code(), Some(1));
    assert!(flat(&output).contains("nothing is written: each program has an error"));
    module("Good", &data("own", 410.0), "own");
    let output = run(path, &command);
    let said = flat(&output);
    assert_eq!(output.status.code(), Some(1), "{said}");
    let lists = "written in/Good.mod refused in/Bad.mod, in/Shares.mod (shares data or calls with a refused one)";
    assert!(said.contains(lists), "{said}");
    // errors are printed whatever else is not
    let quiet = flat(&run(path, &[&command[..], &["--quiet"]].concat()));
    assert!(quiet.starts_with("in/Bad.mod:"), "{quiet}");
    assert!(quiet.contains("error[out-of-reach]"), "{quiet}");
    assert!(!quiet.contains("written in/Good.mod"), "{quiet}");
    let page = std::fs::read_to_string(path.join("r.html")).expect("a page");
    assert!(page.contains("1 of 3 programs are written, 2 refused: 1 error"));
    assert!(page.contains("in/Bad.mod, in/Shares.mod"));
}

/// Writes files, each with its text.
fn written(folder: &Path, files: &[(&str, &str)]) {
    let _ = std::fs::remove_dir_all(folder);
    std::fs::create_dir_all(folder).expect("scratch");
    for (name, text) in files {
        std::fs::write(folder.join(name), text).expect("scratch");
    }
}

const LISTING: &str = "/PROG  A\n/ATTR\nDEFAULT_GROUP\t= 1,*,*,*,*;\n/MN\n   1:J P[1] 50% FINE ;\n/POS\nP[1]{\n   \
    GP1:\n\tUF : 0, UT : 1,\n\tJ1=     0.000 deg,\tJ2=     0.000 deg,\tJ3=     0.000 deg,\n\tJ4=     0.000 \
    deg,\tJ5=   -30.000 deg,\tJ6=     0.000 deg\n};\n/END\n";
const LIST: &str = "DEFDAT a\nDECL E6POS XP1={X 1,Y 2,Z 3,A 0,B 0,C 0,S 2,T 2}\nENDDAT\n";

#[test]
fn files_of_another_controller_are_passed_over_by_name() {
    let folder = world();
    let path = folder.path().join("in");
    let order = ("ORDERFIL.DAT", "! Generated\nH552 Base Software\n");
    let system = ("SYSTEM.SYS", "/SYSTEM 8\n//DATE : 2023/09/19\n");
    for (files, is_refused) in [
        (
            &[("A.LS", LISTING), order, system, ("e.dat", "")][..],
            false,
        ),
        (&[("A.LS", LISTING), ("a.dat", "XP1"), order], false),
        (&[("A.LS", LISTING), ("a.dat", "1,\nENDDAT\n")], true),
        (&[("A.LS", LISTING), ("a.src", "1,\n")], true),
        // in a folder of KRL, and next to nothing
        (&[("A.LS", LISTING), ("b.dat", LIST), order], true),
        (&[("b.dat", LIST), ("a.dat", "")], true),
        (&[order], true),
        (
            &[
                ("t.csv", "x_mm,y_mm,z_mm,qw,qx,qy,qz\n1,2,3,1,0,0,0\n"),
                order,
            ],
            true,
        ),
    ] {
        written(&path, files);
        let said = reported(&run(folder.path(), &["check", "in"]));
        let of_folder = said.contains("passed over in silence");
        assert_eq!(of_folder, is_refused, "{files:?}: {said}");
    }
}

#[test]
fn programs_that_move_nothing_are_read_in_folders() {
    let folder = scratch();
    let path = folder.path();
    let profile = repository("robots/universal_robots_ur5.yaml");
    let main = "def a():\n  set_tcp(p[0,0,0,0,0,0])\n  movej([0,-1.5,1.5,-1.5,-1.5,0])\nend\na()\n";
    let helper = "def helper(x):\n  return x+1\nend\n";
    for (text, status) in [
        (helper, 0),
        ("global n = 2\n", 0),
        (&helper[..helper.len() - 4], 2),
    ] {
        written(&path.join("in"), &[("a.script", main), ("h.script", text)]);
        let output = poseshift()
            .current_dir(path)
            .args(["check", "in", "--profile"])
            .arg(&profile)
            .output()
            .expect("the program starts");
        let is_refused = output.status.code() == Some(2);
        assert_eq!(is_refused, status == 2, "{}", reported(&output));
    }
}

#[test]
fn options_that_say_nothing_or_the_contrary_are_said() {
    let folder = world();
    for (command, words) in [
        (&["check", "in", "--ignore", ""][..], "--ignore is empty"),
        (&["check", "in", "--accept", ""], "--accept is empty"),
    ] {
        let output = run(folder.path(), command);
        assert_eq!(output.status.code(), Some(2));
        assert!(reported(&output).contains(words), "{}", reported(&output));
    }
    let output = run(folder.path(), &["check", "in", "--with", "in/Deburr.mod"]);
    let said = reported(&output);
    assert_eq!(output.status.code(), Some(0), "{said}");
    assert!(
        said.contains("--with in/Deburr.mod: it is a program of this run already"),
        "{said}"
    );
}

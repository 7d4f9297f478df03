//! Numbers that nothing has are errors where they are read, with file, line and key.

use crate::support::{poseshift, repository, scratch, text};
use std::path::Path;

const PROFILE: &str = "robots/abb_irb120_thesis.yaml";
const SAMPLE: &str = "programs/rapid/olp/in/Deburr.mod";

fn run(folder: &Path, command: &str) -> (Option<i32>, String) {
    let output = poseshift()
        .current_dir(folder)
        .args(command.split(' '))
        .output()
        .expect("the program starts");
    let said = String::from_utf8_lossy(&output.stderr) + String::from_utf8_lossy(&output.stdout);
    (output.status.code(), said.into_owned())
}

/// A profile, a program, joints and measurements.
fn world() -> tempfile::TempDir {
    let folder = scratch();
    std::fs::copy(repository(PROFILE), folder.path().join("p.yaml")).expect("scratch");
    std::fs::copy(repository(SAMPLE), folder.path().join("in.mod")).expect("scratch");
    folder
}

fn write(folder: &Path, name: &str, text: &str) {
    std::fs::write(folder.join(name), text).expect("scratch");
}

/// The line, from 1, that holds these words.
fn line_of(text: &str, words: &str) -> usize {
    let line = text.lines().position(|line| line.contains(words));
    line.unwrap_or_else(|| panic!("no {words}")) + 1
}

#[test]
fn a_stored_check_with_numbers_of_no_check_is_refused() {
    let folder = world();
    let path = folder.path();
    let check = "check in.mod --profile p.yaml --baseline base.json";
    let (status, said) = run(path, &format!("{check} --update-baseline"));
    assert_eq!(status, Some(0), "{said}");
    let stored = std::fs::read_to_string(path.join("base.json")).expect("it was stored");
    let (status, said) = run(path, check);
    assert_eq!(status, Some(0), "{said}");
    for (key, value) in [
        ("target_error_mm", "1e308"),
        ("max_path_error_deg", "361.0"),
        ("target_error_deg", "-0.1"),
        ("clearance_mm", "-1e12"),
        ("nominal_clearance_mm", "1e300"),
    ] {
        let line = stored
            .lines()
            .find(|line| line.contains(&format!("\"{key}\": ")) && !line.contains("null"))
            .expect(key);
        let other = format!("      \"{key}\": {value},");
        let changed = stored.replacen(line, &other, 1);
        write(path, "base.json", &changed);
        let (status, said) = run(path, check);
        assert_eq!(status, Some(2), "{key}: {said}");
        let place = format!("base.json:{}", line_of(&changed, &other));
        assert!(
            said.contains(&place) && said.contains(key),
            "{place}: {said}"
        );
        assert!(said.contains("--update-baseline"), "{said}");
    }
}

#[test]
fn times_that_are_no_seconds_are_refused() {
    let folder = world();
    let path = folder.path();
    let joints = |times: [&str; 3]| {
        let mut text = "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg,time_s\n".to_owned();
        for (number, time) in times.iter().enumerate() {
            text += &format!("{number},10,20,0,30,0,{time}\n");
        }
        write(path, "joints.csv", &text);
    };
    // seconds since 1970 are taken, milliseconds and more are not
    let simulate = "simulate --joints joints.csv --profile p.yaml -o m.csv";
    joints(["0", "1.7e9", "9.9e9"]);
    let (status, said) = run(path, simulate);
    assert_eq!(status, Some(0), "{said}");
    let measured = std::fs::read_to_string(path.join("m.csv")).expect("measurements");
    for time in ["1.7e11", "1.1e10", "-1.1e10"] {
        joints(["0", time, "2"]);
        for command in [simulate, "fk --joints joints.csv --profile p.yaml"] {
            let (status, said) = run(path, command);
            assert_eq!(status, Some(2), "{command}: {said}");
            assert!(
                said.contains("joints.csv:3:")
                    && said.contains("time_s")
                    && said.contains("1e10 s"),
                "{command}: {said}"
            );
        }
        let changed = measured.replace("9900000000", time);
        assert_ne!(changed, measured);
        write(path, "m.csv", &changed);
        for command in ["calibrate", "validate", "diagnose"] {
            let (status, said) = run(
                path,
                &format!("{command} --measurements m.csv --profile p.yaml"),
            );
            assert_eq!(status, Some(2), "{command}: {said}");
            assert!(
                said.contains("m.csv:4:") && said.contains("time_s") && said.contains("1e10 s"),
                "{command}: {said}"
            );
        }
    }
}

#[test]
fn a_link_of_five_tonnes_needs_a_reason() {
    let folder = world();
    let path = folder.path();
    let shipped = text(PROFILE);
    let heavy = |entry: &str| {
        let body = shipped
            .lines()
            .find(|line| line.contains("{link: 2, mass_kg: "))
            .expect("a body");
        let text = shipped.replacen(body, entry, 1);
        write(path, "p.yaml", &text);
        let (status, said) = run(path, "profile show p.yaml");
        (status, said, line_of(&text, entry.trim_start()))
    };
    let body = |rest: &str| format!("  - {{link: 2, {rest}, cog_mm: [140, 0, 0]}}");
    let reason = "large: true, reason: \"the boom of a press robot\"";
    for taken in [
        body("mass_kg: 4999"),
        body(&format!("mass_kg: 5000, {reason}")),
        body(&format!("mass_kg: 9000, {reason}")),
    ] {
        let (status, said, _) = heavy(&taken);
        assert_eq!(status, Some(0), "{taken}: {said}");
    }
    for (refused, says) in [
        (body("mass_kg: 5000"), "mass_kg"),
        (body("mass_kg: 5000, large: false"), "large: true"),
        (body("mass_kg: 5000, large: true"), "reason"),
        (body("mass_kg: 5000, large: true, reason: \" \""), "reason"),
        (body("mass_kg: 5, reason: \"it is\""), "large: true"),
        (body(&format!("mass_kg: 2e4, {reason}")), "mass_kg"),
    ] {
        let (status, said, line) = heavy(&refused);
        assert_eq!(status, Some(2), "{refused}: {said}");
        assert!(said.contains(&format!("p.yaml:{line}:")), "{line}: {said}");
        assert!(said.contains(says), "{says}: {said}");
    }
    // commands that use it say the same, and write nothing
    heavy(&body("mass_kg: 5000"));
    let (status, said) = run(path, "compensate in.mod --profile p.yaml -o out.mod");
    assert_eq!(status, Some(2), "{said}");
    assert!(
        said.contains("large: true") && !path.join("out.mod").exists(),
        "{said}"
    );
    // the reason stays where the profile is written anew
    heavy(&body(&format!("mass_kg: 5000, {reason}")));
    let (status, said) = run(path, "profile set p.yaml robot.serial=7 -o q.yaml");
    assert_eq!(status, Some(0), "{said}");
    let set = std::fs::read_to_string(path.join("q.yaml")).expect("it was written");
    assert!(set.contains(reason), "{set}");
}

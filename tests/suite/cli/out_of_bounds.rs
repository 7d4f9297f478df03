//! Numbers that no robot has, and options that nothing needs, in every language that has them.

use super::limits::{changed, compensated, run_in};
use crate::support::{files_below, repository, scratch, text};

const DEBURR: &str = "programs/rapid/olp/in/Deburr.mod";
const THESIS: &str = "robots/abb_irb120_thesis.yaml";

/// Compensates a folder of samples with options; its status and all that is said.
fn sample(folder: &str, profile: &str, more: &[&str]) -> (i32, String) {
    let at = scratch();
    let (input, profile) = (repository(folder), repository(profile));
    let mut words = vec![
        "compensate",
        input.to_str().expect("a plain name"),
        "--profile",
    ];
    words.extend([profile.to_str().expect("a plain name"), "-o", "out"]);
    words.extend(more);
    run_in(at.path(), &words)
}

#[test]
fn options_without_a_name_that_nothing_needs_are_refused_in_every_language() {
    let (tool, frame) = (["--tool", "0,0,500,0,0,0"], ["--frame", "100,2,3,0,0,0"]);
    let nest = ["--frame", "nest=430,-40,-120,0,0,20"];
    let fixture = ["--frame", "4=1400,350,-200,0,0,-15"];
    for (folder, profile, needed, needless) in [
        ("csv/poses/in", "inform", &nest[..], tool),
        ("inform/olp/in", "inform", &[], tool),
        ("fanuc/olp/in", "fanuc", &fixture, tool),
        ("fanuc/olp/in", "fanuc", &fixture, frame),
        ("val3/olp/in", "val3", &[], frame),
        ("kawasaki/olp/in", "kawasaki", &[], frame),
        ("krl/olp/in", "krl", &[], tool),
        ("urscript/olp/in", "urscript", &[], frame),
    ] {
        let folder = format!("programs/{folder}");
        let profile = format!("programs/{profile}/profile.yaml");
        let (status, said) = sample(&folder, &profile, needed);
        assert_eq!(status, 0, "{folder}: {said}");
        let (status, said) = sample(&folder, &profile, &[needed, &needless].concat());
        let word = format!("{} without a name", needless[0]);
        assert!(status == 2 && said.contains(&word), "{folder}: {said}");
    }
}

#[test]
fn loads_that_no_arm_carries_are_refused_wherever_they_stand() {
    let far = changed(DEBURR, "[1.4,[0,0,60]", "[1.4,[0,0,60000]");
    let heavy = |kg: &str| {
        let entry = format!(
            "  effects:\n    - {{effect: payload_error, tool: rdkTool, mass_kg: {kg}, large: true, \
             reason: test}}\n"
        );
        changed(THESIS, "  effects:\n", &entry)
    };
    for (program, profile, words) in [
        (far, text(THESIS), ["`rdkTool`", "6e4 mm"]),
        (text(DEBURR), heavy("-50"), ["`rdkTool`", "4.86e1 kg"]),
    ] {
        let (status, said, written) = compensated("a.mod", &program, &profile, &[]);
        assert!(status == 2 && written.is_none(), "{said}");
        for word in words {
            assert!(said.contains(word), "{word}: {said}");
        }
        let folder = scratch();
        std::fs::write(folder.path().join("a.mod"), &program).expect("scratch");
        std::fs::write(folder.path().join("robot.yaml"), &profile).expect("scratch");
        let (status, said) = run_in(
            folder.path(),
            &["check", "a.mod", "--profile", "robot.yaml"],
        );
        assert_eq!(status, 2, "{said}");
    }
    // no more is taken away than there is
    let (status, said, _) = compensated("a.mod", &text(DEBURR), &heavy("-1"), &[]);
    assert_eq!(status, 0, "{said}");
}

#[test]
fn joints_that_an_inverse_starts_from_are_those_of_the_arm() {
    let folder = scratch();
    let table = text("programs/csv/poses/in/inspection.csv");
    let line = table
        .lines()
        .find(|line| line.starts_with("P1,"))
        .expect("P1");
    let near = "world,5,15,-15,-5,-95,-5";
    assert!(line.contains(near), "{line}");
    let profile = repository("programs/inform/profile.yaml");
    for (value, status) in [("5", 0), ("755", 2), ("1e308", 2)] {
        let other = table.replacen(
            near,
            &near.replacen("world,5", &format!("world,{value}"), 1),
            1,
        );
        std::fs::write(folder.path().join("inspection.csv"), other).expect("scratch");
        let (found, said) = run_in(
            folder.path(),
            &[
                "compensate",
                "inspection.csv",
                "--profile",
                profile.to_str().expect("a plain name"),
                "--frame",
                "nest=430,-40,-120,0,0,20",
                "-o",
                "out.csv",
            ],
        );
        assert_eq!(found, status, "{value}: {said}");
        assert_eq!(
            status == 2,
            said.contains("joint 1 near which"),
            "{value}: {said}"
        );
    }
}

#[test]
fn joints_that_two_tools_go_to_are_shifted_by_no_more_than_with_one() {
    let moves = |tools: &[&str]| {
        let tool = |name: &str, z: f64| {
            format!(
                "PERS tooldata {name} := [TRUE,[[0,0,{z}],[1,0,0,0]],[1,[0,0,50],[1,0,0,0],0,0,0]];\n"
            )
        };
        let moves: String = tools
            .iter()
            .map(|tool| format!("MoveAbsJ j1,v100,fine,{tool};\n"))
            .collect();
        format!(
            "MODULE m\n{}{}CONST jointtarget j1 := \
             [[0,10,20,10,40,5],[9E9,9E9,9E9,9E9,9E9,9E9]];\nPROC main()\n{moves}ENDPROC\nENDMODULE\n",
            tool("tA", 20.0),
            tool("tB", 320.0)
        )
    };
    let profile = text(THESIS);
    let correct = ["--joint-targets", "correct"];
    let (status, said, one) = compensated("a.mod", &moves(&["tA"]), &profile, &correct);
    assert_eq!(status, 0, "{said}");
    let (status, said, both) = compensated("a.mod", &moves(&["tA", "tB"]), &profile, &correct);
    assert_eq!(status, 0, "{said}");
    let joints = |written: Option<String>| {
        let written = written.expect("a program");
        let line = written.lines().find(|line| line.contains("jointtarget"));
        line.expect("the target").to_owned()
    };
    assert_eq!(joints(one), joints(both));
}

#[test]
fn no_correction_turns_a_target_by_more_than_two_degrees() {
    let turned = |deg: &str| {
        let effect = format!(
            "  effects:\n    - {{effect: tool_frame, tool: rdkTool, rx_deg: {deg}, ry_deg: {deg}}}\n"
        );
        changed(THESIS, "  effects:\n", &effect)
    };
    let (status, said, _) = compensated("a.mod", &text(DEBURR), &turned("1.2"), &[]);
    assert_eq!(status, 0, "{said}");
    let (status, said, written) = compensated("a.mod", &text(DEBURR), &turned("1.9"), &[]);
    assert!(status == 1 && written.is_none(), "{said}");
    assert!(
        said.contains("shift-too-large") && said.contains("2.000 deg"),
        "{said}"
    );
    let more = ["--max-shift", "20mm,3deg"];
    let (status, said, _) = compensated("a.mod", &text(DEBURR), &turned("1.9"), &more);
    assert_eq!(status, 0, "{said}");
}

#[test]
fn effects_that_programs_say_nothing_of_are_named_with_what_they_do() {
    let program = text(DEBURR);
    for (effect, words) in [
        (
            "warm_up_drift, joint: 1, angle_deg: 0.1, time_constant_s: 600",
            "once it is warm",
        ),
        (
            "thermal_growth, per_k: 2.0e-5, reference_c: 20",
            "no thermometer",
        ),
        ("settling, joint: 2, share: 0.001", "rest"),
    ] {
        let more = format!("  effects:\n    - {{effect: {effect}}}\n");
        let profile = changed(THESIS, "  effects:\n", &more);
        let (status, said, written) = compensated("t.mod", &program, &profile, &[]);
        assert_eq!((status, written.is_some()), (0, true), "{said}");
        let found = said
            .lines()
            .find(|line| line.contains("warning[effect-left-out]"));
        let found = found.unwrap_or_else(|| panic!("{said}"));
        assert!(found.contains(words), "{found}");
        // alone it corrects nothing
        let at = profile.find("  effects:\n").expect("effects") + more.len();
        let (status, said, written) = compensated("t.mod", &program, &profile[..at], &[]);
        assert_eq!((status, written), (2, None), "{said}");
        assert!(
            said.contains("no effect that moves the tool in a program"),
            "{said}"
        );
    }
}

#[test]
fn a_part_that_was_moved_stands_in_the_marker_and_check_says_so() {
    let at = scratch();
    let (input, profile) = (repository(DEBURR), repository(THESIS));
    let [input, profile] = [&input, &profile].map(|path| path.to_str().expect("a plain name"));
    let offset = "poseshift: frame/1\npose: {x_mm: 3, y_mm: 4, z_mm: 0, rx_deg: 0, ry_deg: 0, rz_deg: 0.5}\n";
    std::fs::write(at.path().join("offset.yaml"), offset).expect("scratch");
    let words = ["compensate", input, "--profile", profile, "-o", "out.mod"];
    for (more, is_moved) in [(&["--work-offset", "offset.yaml"][..], true), (&[], false)] {
        let words = [&words[..], more, &["--force"]].concat();
        let (status, said) = run_in(at.path(), &words);
        assert_eq!(status, 0, "{said}");
        let written = std::fs::read_to_string(at.path().join("out.mod")).expect("written");
        assert_eq!(
            written.contains("! work-offset 5mm,0.5deg"),
            is_moved,
            "{written}"
        );
        let words = ["check", "out.mod", "--nominal", input, "--profile", profile];
        let (_, said) = run_in(at.path(), &words);
        let is_said = said.contains("warning[part-moved]") && said.contains("by 5mm,0.5deg");
        assert_eq!(is_said, is_moved, "{said}");
    }
}

/// Compensates, or checks, a sample with one change; its status and all that is said.
fn slipped(command: &str, language: &str, [file, old, new]: [&str; 3]) -> (i32, String) {
    let (at, case) = (scratch(), format!("programs/{language}/olp/in"));
    for name in files_below(&repository(&case)) {
        let to = at.path().join("in").join(&name);
        std::fs::create_dir_all(to.parent().expect("a folder")).expect("scratch");
        std::fs::copy(repository(&case).join(&name), to).expect("scratch");
    }
    let to = at.path().join("in").join(file);
    let new_text = changed(&format!("{case}/{file}"), old, new);
    std::fs::write(to, new_text).expect("scratch");
    let profile = match language {
        "rapid" => repository(THESIS),
        _ => repository(&format!("programs/{language}/profile.yaml")),
    };
    let mut words = vec![command, "in", "--profile"];
    words.push(profile.to_str().expect("a plain name"));
    words.extend(match command {
        "check" => &[][..],
        _ => &["-o", "out"],
    });
    if language == "fanuc" {
        words.extend(["--frame", "4=1400,350,-200,0,0,-15"]);
    }
    run_in(at.path(), &words)
}

#[test]
fn numbers_in_another_unit_are_questioned_in_every_language() {
    let said_of = |language: &str, slip: [&str; 3], id: &str, statuses: [i32; 2], word: &str| {
        for (command, status) in ["compensate", "check"].into_iter().zip(statuses) {
            let (ended, said) = slipped(command, language, slip);
            assert!(
                ended == status && said.contains(id) && said.contains(word),
                "{command} {language} {slip:?}: {ended}, {said}"
            );
        }
    };
    let too_large = "error[angle-too-large]: an angle of ";
    let (seal, job) = ("seal.ls", "DEBURR.JBI");
    let (station, edges) = ("Station_20.src", "Deburr/Deburr.dtx");
    let trim = "TRIM.pg";
    for (language, slip, angle) in [
        ("fanuc", [seal, "W = 180.000", "W = 3780.000"], "3780"),
        (
            "inform",
            [job, "180.00,-6.00,25.00", "18180.00,-6.00,25.00"],
            "18180",
        ),
        (
            "krl",
            [
                station,
                "A 180.000000, B 0.000000, C 180.000000, S",
                "A 3617, B 0, C 180, S",
            ],
            "3617",
        ),
        (
            "val3",
            [edges, "rz=\"174.0305\"", "rz=\"3617.4\""],
            "3617.4",
        ),
        (
            "kawasaki",
            [
                trim,
                "1.0550,153.5429,-156.7195",
                "1.0550,153.5429,-1567.195",
            ],
            "-1567.195",
        ),
    ] {
        said_of(language, slip, too_large, [1, 1], angle);
    }
    // the tool, and the tool on which it stands together are none that is doubted
    let on_tool = [
        edges,
        "x=\"12.5\" z=\"118.75\" ry=\"30\"",
        "x=\"0.0125\" z=\"0.11875\" ry=\"30\"",
    ];
    said_of(
        "val3",
        on_tool,
        "[tool-unit]",
        [1, 0],
        "0.11875 mm from the tool that it stands on",
    );
    let centre = ["Deburr.mod", "[1.4,[0,0,60]", "[1.4,[0,0,0.06]"];
    said_of("rapid", centre, "warning[load-unit]", [0, 0], "0.06 mm");
    // and a tool or frame that is refused is why nothing can be checked
    let (base, tool) = ([station, "A -25", "A -2500"], [station, "B 45", "B 4500"]);
    said_of(
        "krl",
        base,
        "`BASE_DATA[5]` has an angle of -2500 deg",
        [1, 2],
        "720 deg",
    );
    said_of(
        "krl",
        tool,
        "`TOOL_DATA[7]` has an angle of 4500 deg",
        [1, 2],
        "720 deg",
    );
}

#[test]
fn a_tool_given_by_name_keeps_the_mass_that_the_profile_has_for_that_name() {
    let profile = text("programs/fanuc/profile.yaml");
    let program = text("programs/fanuc/olp/in/seal.ls");
    let of = |tool: &[&str]| {
        let frame = ["--frame", "4=1400,350,-200,0,0,-15"];
        let (status, said, written) =
            compensated("seal.ls", &program, &profile, &[&frame[..], tool].concat());
        assert_eq!(status, 0, "{said}");
        written.expect("a program")
    };
    let of_profile = of(&[]);
    assert_eq!(of(&["--tool", "1=85,0,420,0,30,0"]), of_profile);
    assert_ne!(of(&["--tool", "1=85,0,420.1,0,30,0"]), of_profile);
}

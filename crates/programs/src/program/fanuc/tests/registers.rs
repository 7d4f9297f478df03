//! Position registers, and points that the program writes.

use super::*;

fn two() -> String {
    usual("1") + &usual("2")
}

/// Where moves go, and whether offset from that by something.
fn to(program: &Program) -> Vec<(Option<&str>, bool)> {
    let moves = program.moves.iter();
    moves
        .map(|motion| {
            let target = program.target_of(motion);
            let name = target.and_then(|target| target.name.as_deref());
            let is_unknown = matches!(
                motion.displacement,
                Displacement::Unknown | Displacement::Unbounded
            );
            (name, is_unknown)
        })
        .collect()
}

#[test]
fn moves_to_registers_stay_with_one_warning_a_place() {
    for line in [
        "L PR[1:home] 9mm/sec FINE ;",
        "J PR[R[1]] 9% FINE ;",
        "J PAL_1[A_1] 9% FINE ;",
    ] {
        let program = read(
            &format!("J P[1] 1% FINE ;\n{line}\nJ P[2] 1% FINE ;"),
            &two(),
        );
        assert_eq!(ids(&program), ["computed-target"], "{line}");
        let found = &program.findings[0];
        assert_eq!((found.line, found.severity), (6, Severity::Warning));
        assert!(blocked(&program).is_empty());
        assert_eq!(to(&program)[1], (None, false));
    }
}

#[test]
fn where_the_robot_was_is_a_note_and_a_warning_where_it_is_displaced() {
    for line in [
        "PR[1]=LPOS ;\nL PR[1] 9mm/sec FINE ;",
        "PR[1]=JPOS ;\nPR[2]=PR[1] ;\nJ PR[2] 9% FINE ;",
        // displaced from there
        "PR[91]=LPOS ;\nPR[91,2]=PR[91,2]-100 ;\nL PR[91] 9mm/sec FINE ;",
        "PR[91]=LPOS ;\nPR[91,2]=PR[91,2]-100 ;\nPR[91,3]=PR[91,3]+5 ;\nL PR[91] 9mm/sec FINE ;",
    ] {
        let program = read(&format!("J P[1] 1% FINE ;\n{line}"), &usual("1"));
        assert_eq!(ids(&program), ["run-time-position"], "{line}");
        let is_displaced = line.contains("-100");
        let severity = program.findings[0].severity;
        assert_eq!(severity == Severity::Warning, is_displaced, "{line}");
    }
    // a pose is that of its tool and frame
    for (line, id) in [
        (
            "PR[1]=LPOS ;\nUTOOL_NUM=2 ;\nL PR[1] 9mm/sec FINE ;",
            "computed-target",
        ),
        (
            "PR[1]=LPOS ;\nPR[1,2]=PR[1,2]-100 ;\nUTOOL_NUM=2 ;\nL PR[1] 9mm/sec FINE ;",
            "computed-target",
        ),
        (
            "PR[1]=LPOS ;\nPR[1,2]=PR[1,2]-R[5] ;\nL PR[1] 9mm/sec FINE ;",
            "computed-target",
        ),
        (
            "PR[1]=LPOS ;\nPR[1,2]=100 ;\nL PR[1] 9mm/sec FINE ;",
            "computed-target",
        ),
        (
            "PR[1]=LPOS ;\nUFRAME_NUM=3 ;\nL PR[1] 9mm/sec FINE ;",
            "computed-target",
        ),
        (
            "PR[1]=JPOS ;\nUTOOL_NUM=2 ;\nJ PR[1] 9% FINE ;",
            "run-time-position",
        ),
    ] {
        let program = read(&format!("J P[1] 1% FINE ;\n{line}"), &usual("1"));
        assert_eq!(ids(&program), [id], "{line}");
    }
}

#[test]
fn a_register_that_is_a_copy_of_a_point_is_that_point() {
    let copied =
        "UTOOL_NUM=1 ;\nUFRAME_NUM=2 ;\nPR[4]=P[2] ;\nJ P[1] 1% FINE ;\nL PR[4] 9mm/sec FINE ;";
    let program = read(copied, &two());
    assert_eq!(to(&program), [(Some("P[1]"), false), (Some("P[2]"), false)]);
    assert_eq!(program.findings, []);
    let names = program
        .moves
        .iter()
        .map(|m| program.tools[m.tool].name.as_str());
    assert!(names.eq(["1", "1"]));
    // through another register, in another program, by a register as index
    let through = copied.replace("L PR[4]", "PR[5]=PR[4] ;\nL PR[5]");
    assert_eq!(to(&read(&through, &two()))[1], (Some("P[2]"), false));
    let indirect = read(&copied.replace("L PR[4]", "L PR[R[1]]"), &two());
    assert!(to(&indirect).contains(&(Some("P[2]"), false)));
    assert_eq!(ids(&indirect), ["computed-target"]);
    // one number of it is changed, or something is added: offset from the point by what only the
    // running program knows
    for line in [
        "PR[4,3]=PR[4,3]-R[1] ;",
        "PR[4]=P[2]+PR[3] ;",
        "PR[4]=PR[4]+PR[3] ;",
    ] {
        let changed = copied.replace("J P[1]", &format!("{line}\nJ P[1]"));
        assert!(
            to(&read(&changed, &two())).contains(&(Some("P[2]"), true)),
            "{line}"
        );
    }
}

#[test]
fn a_number_of_the_text_displaces_a_register_by_what_it_says() {
    let by = |lines: &str| {
        let lines = format!(
            "UTOOL_NUM=1 ;\nUFRAME_NUM=2 ;\nJ P[1] 1% FINE ;\nPR[4]=P[2] ;\n{lines}\nL PR[4] \
             9mm/sec FINE ;"
        );
        let program = read(&lines, &two());
        assert_eq!(to(&program)[1].0, Some("P[2]"), "{lines}");
        program.moves[1].displacement.clone()
    };
    let along = |by| Displacement::By(Box::new(Shift::along(by)));
    for (lines, wanted) in [
        ("PR[4,3]=PR[4,3]+200 ;", along([0.0, 0.0, 0.2])),
        (
            "PR[4,1:above]=PR[GP1:4,1:above]+(-30) ;\nPR[4,3]=PR[4,3]+40 ;",
            along([-0.03, 0.0, 0.04]),
        ),
        (
            "PR[6]=P[2] ;\nPR[4,3]=PR[6,3]+200 ;",
            along([0.0, 0.0, 0.2]),
        ),
        (
            "PR[6]=P[1] ;\nPR[4,3]=PR[6,3]+200 ;",
            Displacement::Overwritten,
        ),
        ("PR[4,3]=PR[5,3]+200 ;", Displacement::Overwritten),
        ("PR[4,3]=PR[4,2]+200 ;", Displacement::Overwritten),
        ("PR[4,3]=R[1] ;", Displacement::Overwritten),
        (
            "R[1]=PR[4,3] ;\nR[1]=R[1]+5 ;\nPR[4,3]=R[1] ;",
            along([0.0, 0.0, 0.005]),
        ),
        ("PR[4,3]=PR[4,3]+R[1] ;", Displacement::Unknown),
        (
            "PR[4,6]=PR[4,6]+90 ;",
            Displacement::Within(Box::new([Stride::Turned(Some(90_f64.to_radians()))])),
        ),
        ("PR[4,3]=(-200) ;", Displacement::Overwritten),
    ] {
        assert_eq!(by(lines), wanted, "{lines}");
    }
    let Displacement::By(turned) = by("PR[4,4]=PR[4,4]+90 ;") else {
        panic!("about the axis of the tool");
    };
    let angle = turned.in_tool.rotation.angle();
    assert!((angle - 90_f64.to_radians()).abs() < 1e-12);
}

#[test]
fn a_register_goes_with_the_active_numbers_which_points_tell() {
    // the controller went to P[1], so that its numbers are selected
    let lines = "PR[4]=P[2] ;\nJ P[1] 1% FINE ;\nL PR[4] 9mm/sec FINE ;";
    let program = read(lines, &two());
    let names = program.moves.iter().map(|m| {
        let (tool, frame) = (&program.tools[m.tool], &program.frames[m.frame]);
        (tool.name.as_str(), frame.name.as_str())
    });
    assert!(names.eq([("1", "2"), ("1", "2")]));
    let other = read(&format!("UTOOL_NUM=7 ;\nUFRAME_NUM=2 ;\n{lines}"), &two());
    assert_eq!(ids(&other), ["frame-number-differs"]);
}

#[test]
fn copies_that_nothing_in_the_files_uses_are_reported() {
    let program = read("J P[1] 100% FINE ;\nPR[4]=P[1] ;", &usual("1"));
    assert_eq!(ids(&program), ["target-copied"]);
    assert!(blocked(&program).is_empty());
    let used = read(
        "J P[1] 100% FINE ;\nPR[4]=P[1] ;\nJ PR[4] 1% FINE ;",
        &usual("1"),
    );
    assert_eq!(used.findings, []);
}

#[test]
fn points_that_the_program_writes_are_what_it_writes() {
    // read from the robot: right as it is; what the file has may be there in the first run
    let program = read(
        "J P[1] 1% FINE ;\nP[1]=LPOS ;\nL P[1] 9mm/sec FINE ;",
        &usual("1"),
    );
    let all = to(&program);
    assert!(all.contains(&(Some("P[1]"), false)) && all.contains(&(None, false)));
    assert!(ids(&program).iter().all(|id| *id == "run-time-position"));
    assert!(blocked(&program).is_empty());
    let program = read(
        "P[1]=PR[2] ;\nL P[1] 9mm/sec FINE ;\nL P[2] 9mm/sec FINE ;",
        &two(),
    );
    assert_eq!(to(&program), [(None, false), (Some("P[2]"), false)]);
    assert!(ids(&program).contains(&"computed-target"));
    assert_eq!(
        blocked(&program),
        ["P[1]"],
        "no move goes to what the file has"
    );
    let any = read("P[R[1]]=PR[2] ;\nL P[1] 9mm/sec FINE ;", &two());
    assert_eq!(to(&any), [(Some("P[1]"), false), (None, false)]);
}

#[test]
fn a_register_as_index_means_any_point() {
    let points = usual("1") + &usual("2");
    let lines = "L P[R[1]] 9mm/sec FINE ;\nL P[R[2:x]] 9mm/sec FINE ;\nL P[1] 9mm/sec FINE ;";
    let program = read(lines, &points);
    let to: Vec<usize> = program.moves.iter().map(|m| m.target.unwrap()).collect();
    assert_eq!(to, [0, 1, 0, 1, 0]);
    assert_eq!(program.findings, []);
    // each with its own tool
    let points = usual("1") + &usual("2").replace("UT : 1", "UT : 3");
    let program = read(lines, &points);
    let tools = program
        .moves
        .iter()
        .map(|m| (m.target.unwrap(), &*program.tools[m.tool].name));
    assert!(tools.eq([(0, "1"), (1, "3"), (0, "1"), (1, "3"), (0, "1")]));
}

#[test]
fn a_frame_is_what_a_register_is_copied_from() {
    let lines = "PR[3]=P[2] ;\nUFRAME[2]=PR[3] ;\nL P[1] 9mm/sec FINE ;";
    let program = read(lines, &two());
    let frame = &program.frames[program.moves[0].frame];
    assert_eq!(
        (frame.name.as_str(), frame.world_from_frame.is_some()),
        ("P[2]", true)
    );
    assert_eq!(blocked(&program), ["P[2]"], "a frame stays");
    let program = read("UFRAME[2]=UFRAME[0] ;\nL P[1] 9mm/sec FINE ;", &usual("1"));
    assert_eq!(
        program.frames[program.moves[0].frame].world_from_frame,
        Some(Pose::identity())
    );
}

#[test]
fn a_frame_is_what_the_program_has_just_written() {
    let numbers = "PR[3,1]=(-30) ;\nPR[3,2]=0 ;\n! a tool ;\nPR[3,3:tool]=40.5 ;\nPR[GP1:3,4]=0 \
        ;\nPR[3,5]=-60 ;\nPR[3,6]=0 ;\n";
    let behind = "UTOOL[1]=PR[3] ;\nL P[1] 9mm/sec FINE ;";
    let tool = |lines: &str| {
        let program = read(lines, &usual("1"));
        let ids: Vec<_> = ids(&program).into_iter().map(str::to_owned).collect();
        (program.tools[program.moves[0].tool].flange_from_tool, ids)
    };
    let (known, found) = tool(&format!("{numbers}{behind}"));
    let pose = known.expect("the tool");
    assert!((pose.translation[0] + 0.03).abs() < 1e-12 && found.is_empty());
    assert!((pose.rotation.angle() - 60_f64.to_radians()).abs() < 1e-12);
    let (computed, _) = tool(&format!(
        "{numbers}R[5]=2 ;\nPR[3,1]=PR[3,1]+R[5]/4 ;\n{behind}"
    ));
    assert!((computed.expect("the tool").translation[0] + 0.0295).abs() < 1e-12);
    // behind a label, a call, a condition, a move that does more; another register, one from
    // elsewhere, one that is not whole
    for line in [
        "LBL[1] ;",
        "CALL OTHER ;",
        "IF R[1]=1,PR[3,1]=R[5] ;",
        "L P[1] 9mm/sec CNT50 TB .10sec,CALL OTHER ;",
        "L P[1] 9mm/sec FINE Skip,LBL[1],PR[3]=LPOS ;",
        "ELSE ;\nPR[3,1]=5 ;",
        "PR[R[1]]=PR[4] ;",
        "PR[3,1]=R[5] ;",
        "PR[3,1]=PR[3,1]+R[5] ;",
    ] {
        let (_, found) = tool(&format!("{numbers}{line}\n{behind}"));
        assert!(
            found.iter().any(|id| id.starts_with("frame-")),
            "{line}: {found:?}"
        );
    }
    let (_, found) = tool(&format!("{}{behind}", numbers.replace("PR[3,2]=0 ;\n", "")));
    assert_eq!(found, ["frame-assigned-at-run-time"]);
}

//! What a program does by names and by routines that only the controller knows: never wrong without
//! a word.

use super::{P, PLAIN, done, errors, given, message, profile, profile_of, rapid};
use poseshift::compensate::{Compensation, Options, compensate};
use poseshift::program::{Source, language_of};

const DATA: &str = "CONST jointtarget jh:=[[5,10,15,3,60,10],[9E9,9E9,9E9,9E9,9E9,9E9]];\n\
     PERS tooldata t1:=[TRUE,[[50,25,100],[1,0,0,0]],[1,[0,0,50],[1,0,0,0],0,0,0]];\n\
     PERS tooldata t2:=[TRUE,[[0,0,150],[1,0,0,0]],[2,[20,0,60],[1,0,0,0],0,0,0]];\n\
     PERS wobjdata w1:=[FALSE,TRUE,\"\",[[300,0,100],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];\n\
     PERS wobjdata w2:=[FALSE,TRUE,\"\",[[280,60,80],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];\n\
     PERS loaddata l:=[4,[30,0,80],[1,0,0,0],0,0,0];\nVAR robtarget q;\n";
const SAGGING: &str = "{effect: joint_compliance, joint: 2, rad_per_n_m: 1.0e-4}";

fn text(body: &str, rest: &str) -> String {
    let data = format!(
        "{DATA}CONST robtarget p:=[[50,20,150],{P};\nCONST robtarget r:=[[80,30,160],{P};\n{rest}\n"
    );
    rapid(&data, &format!("MoveAbsJ jh,v100,fine,t1;\n{body}"))
}

/// A program with these statements behind a first move, what else its module has, and other files.
fn program(body: &str, rest: &str, others: &[(&str, &str)]) -> Compensation {
    let text = text(body, rest);
    let own = [("t.mod", &*text)];
    let files: Vec<_> = own.into_iter().chain(others.iter().copied()).collect();
    done(&[PLAIN, SAGGING], &files)
}

const TO_P: &str = "MoveL p,v100,fine,t1\\WObj:=w1;";

#[test]
fn what_may_have_changed_behind_the_text_is_an_error() {
    let to_r = "MoveL r,v100,fine,t1\\WObj:=w1;";
    let set = "PROC set()\nPDispSet [[0,0,50],[1,0,0,0]];\nENDPROC";
    let grip = "PROC set()\nGripLoad l;\nENDPROC";
    let on_its_way = format!("MoveLSync p,v100,z10,t1\\WObj:=w1,\"set\";\n{to_r}");
    for (body, rest, expected) in [
        (
            format!("Pick p,r,v100,fine,t1\\WObj:=w1;\n{TO_P}"),
            "",
            "target-passed-to-routine",
        ),
        ("Pick p,t1,w1;".into(), "", "target-passed-to-routine"),
        (
            format!("CamPose w1.oframe;\n{TO_P}"),
            "",
            "frame-chosen-at-run-time",
        ),
        (
            format!("gunchange t1;\n{TO_P}"),
            "",
            "frame-chosen-at-run-time",
        ),
        (
            format!("SetDataVal \"w1\",x;\n{TO_P}"),
            "",
            "frame-assigned-at-run-time",
        ),
        (on_its_way.clone(), set, "displacement-active"),
        (on_its_way, grip, "target-shared"),
        (
            format!("{TO_P}\nPDispSet [[0,0,50],[1,0,0,0]];"),
            "",
            "displacement-active",
        ),
        (format!("{TO_P}\nGripLoad l;"), "", "target-shared"),
    ] {
        let done = program(&body, rest, &[]);
        assert!(
            errors(&done).contains(&expected),
            "{body}: {:?}",
            done.findings
        );
    }
    let said = program(&format!("gunchange t1;\n{TO_P}"), "", &[]);
    let said = message(&said, "frame-chosen-at-run-time");
    assert!(said.contains("gunchange") && said.contains("t1"), "{said}");
}

#[test]
fn a_position_that_is_read_with_another_tool_is_no_note() {
    for read in [
        "q:=CRobT(\\Tool:=t1\\WObj:=w1);",
        "SearchL\\Stop,di1,q,p,v100,t1\\WObj:=w1;",
    ] {
        let ids = |with: &str| {
            let done = program(
                &format!("{TO_P}\n{read}\nMoveL q,v100,fine,{with};"),
                "",
                &[],
            );
            let ids = done.findings.into_iter().map(|finding| finding.id);
            ids.filter(|id| ["computed-target", "run-time-position"].contains(id))
                .collect::<Vec<_>>()
        };
        assert_eq!(ids("t1\\WObj:=w1"), ["run-time-position"], "{read}");
        assert_eq!(ids("t2\\WObj:=w1"), ["computed-target"], "{read}");
        assert_eq!(ids("t1\\WObj:=w2"), ["computed-target"], "{read}");
    }
}

/// The line of a target in a corrected file of a program.
fn corrected(done: &Compensation, (file, text): (usize, &str), name: &str) -> String {
    assert_eq!(errors(done), [""; 0], "{:?}", done.findings);
    let written = done.edits[file].apply(text.as_bytes());
    let written = String::from_utf8(written).expect("text");
    let declares = format!("robtarget {name}:");
    let mut lines = written.lines();
    let line = lines.find(|line| line.contains(&declares)).expect(name);
    line.to_owned()
}

/// The corrections are those of a program that names the work object in the move itself.
#[test]
fn late_bound_calls_with_a_module_go_on_with_the_frame_of_their_caller() {
    let part = |name: &str, local: &str| {
        format!(
            "MODULE n\nCONST robtarget s:=[[60,10,150],{P};\n{local}PROC {name}()\nMoveL \
             s,v100,fine,t1\\WObj:=w1;\nENDPROC\nENDMODULE\n"
        )
    };
    let line = |body: &str, part: &str| {
        let done = program(body, "", &[("n.mod", part)]);
        corrected(&done, (1, part), "s")
    };
    let direct = part("run", "").replace("\\WObj:=w1", "\\WObj:=w2");
    let truth = line("run;", &direct);
    assert!(!direct.contains(&truth), "nothing is corrected");
    for (name, local) in [("run", ""), ("run", "LOCAL "), ("Main", "")] {
        let body = format!("w1:=w2;\n%\"N:{name}\"%;");
        assert_eq!(line(&body, &part(name, local)), truth, "{local}{name}");
    }
}

#[test]
fn a_call_that_is_taken_for_a_move_is_corrected_like_one() {
    let line = |body: &str| {
        let done = program(body, "", &[]);
        let assumed = done.findings.iter().any(|of| of.id == "move-assumed");
        (corrected(&done, (0, &text(body, "")), "p"), assumed)
    };
    let (moved, plain) = line(TO_P);
    assert_eq!(line("Pick p,v100,fine,t1\\WObj:=w1;"), (moved, true));
    assert!(!plain);
}

#[test]
fn joint_targets_of_context_files_are_refused_where_joints_are_corrected() {
    let in_rapid = (
        ("t.mod", rapid("", "MoveAbsJ jRest,v100,fine,tool0;")),
        (
            "cell.sys",
            "MODULE cell\nCONST jointtarget jRest:=[[5,10,15,3,60,10],[9E9,9E9,9E9,9E9,9E9,\
             9E9]];\nENDMODULE\n",
        ),
        profile(&[PLAIN]),
    );
    let body = "$TOOL=$NULLFRAME\n$BASE=$WORLD\nPTP XREST\n";
    let in_krl = (
        ("t.src", format!("DEF t()\n{body}END\n")),
        (
            "$config.dat",
            "DEFDAT $CONFIG\nDECL E6AXIS XREST={A1 8.0,A2 -77.0,A3 88.0,A4 28.0,A5 48.0,A6 \
             23.0}\nENDDAT\n",
        ),
        profile_of("robots/kuka_kr6_r900.yaml", &[PLAIN]),
    );
    for ((name, text), (context, declared), profile) in [in_rapid, in_krl] {
        let run = |joints: bool, as_program: bool| {
            let declared = declared.as_bytes().to_vec();
            let sources = [
                Source::new(name, text.clone().into_bytes()),
                if as_program {
                    Source::new(context, declared)
                } else {
                    Source::context(context, declared)
                },
            ];
            let language = language_of(&sources[0]).expect("a language");
            let options = Options {
                correct_joint_targets: joints,
                ..given()
            };
            compensate(language, &sources, &profile, &options).expect("read")
        };
        let refused = run(true, false);
        assert_eq!(errors(&refused), ["target-in-context"], "{name}");
        let said = message(&refused, "target-in-context");
        assert!(said.contains(&format!("{context} line 2")), "{said}");
        // they stay anyway, or their file is written too
        assert_eq!(errors(&run(false, false)), [""; 0], "{name}");
        let corrected = run(true, true);
        assert_eq!(errors(&corrected), [""; 0], "{name}");
        assert_eq!(corrected.summary.compensated, 1, "{name}");
    }
}

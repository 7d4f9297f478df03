//! What routines of KRL write through parameters, what calls do to the side from which joints come, and
//! corrections across half a rotation.

use super::{P, PLAIN, done, errors};
use poseshift::compensate::Compensation;
use poseshift::model::Conditions;
use poseshift::model::profile::Mounted;

const CONFIG: &str = "DEFDAT $CONFIG\nDECL FRAME TOOL_DATA[16]\nTOOL_DATA[1]={X 0,Y 0,Z 50,A 0,B \
    0,C 0}\nDECL FRAME BASE_DATA[32]\nBASE_DATA[1]={X 100,Y 0,Z 50,A 0,B 0,C 0}\nBASE_DATA[2]={X \
    120,Y 10,Z 50,A 5,B 0,C 0}\nDECL LOAD LOAD_DATA[16]\nLOAD_DATA[1]={M 1.0,CM {X 0,Y 0,Z 40,A \
    0,B 0,C 0},J {X 0,Y 0,Z 0}}\nENDDAT\n";
const DATA: &str = "DEFDAT t\nDECL FDAT FP1={TOOL_NO 1,BASE_NO 1,IPO_FRAME #BASE}\nDECL FRAME \
    F={X 0,Y 0,Z 0,A 0,B 0,C 0}\nDECL E6POS XP1={X 320.0,Y 10.0,Z 380.0,A 160,B 20,C 180,S 2,T 2,E1 \
    0.0,E2 0.0,E3 0.0,E4 0.0,E5 0.0,E6 0.0}\nENDDAT\n";
const START: &str = "PTP {A1 0,A2 -20,A3 40,A4 0,A5 70,A6 -60}\n$TOOL=TOOL_DATA[1]\n\
    $BASE=BASE_DATA[1]\n$LOAD=LOAD_DATA[1]\n";

fn module(body: &str, routines: &str) -> Compensation {
    let text = format!("DEF t()\n{START}{body}END\n{routines}");
    done(
        &[PLAIN],
        &[("$config.dat", CONFIG), ("t.dat", DATA), ("t.src", &text)],
    )
}

/// The worst of what is found, without notes.
fn found(done: &Compensation) -> Vec<&'static str> {
    let mut found = errors(done);
    if found.is_empty() {
        let warnings = done
            .findings
            .iter()
            .filter(|f| f.severity > poseshift::finding::Severity::Note);
        found = warnings.map(|f| f.id).collect();
    }
    found.dedup();
    found
}

const CHANGED: &str = "frame-assigned-at-run-time";

#[test]
fn a_routine_of_the_files_may_write_what_it_is_given_by_reference() {
    let number = "DEF set(n:OUT)\nREAL n\nn=350\nEND\n";
    let base = "DEF set(b:OUT)\nFRAME b\nb.Z=0\nEND\n";
    for (body, routine, expected) in [
        ("set($BASE)\nLIN XP1\n", base, CHANGED),
        ("set($TOOL)\nLIN XP1\n", base, CHANGED),
        ("set($BASE.Z)\nLIN XP1\n", number, CHANGED),
        (
            "set(BASE_DATA[1])\n$BASE=BASE_DATA[1]\nLIN XP1\n",
            base,
            CHANGED,
        ),
        (
            "set(BASE_DATA[1].X)\n$BASE=BASE_DATA[1]\nLIN XP1\n",
            number,
            CHANGED,
        ),
        (
            "set(TOOL_DATA[1].X)\n$TOOL=TOOL_DATA[1]\nLIN XP1\n",
            number,
            CHANGED,
        ),
        ("set($LOAD.M)\nLIN XP1\n", number, "load-chosen-at-run-time"),
        ("set(F.Z)\nLIN XP1:F\n", number, "displacement-unknown"),
        (
            "set(FP1.BASE_NO)\nFDAT_ACT=FP1\nBAS(#CP_PARAMS,2)\nLIN XP1\n",
            number,
            "frame-chosen-at-run-time",
        ),
        (
            "set(XP1.Z)\nLIN XP1\n",
            number,
            "target-assigned-at-run-time",
        ),
    ] {
        let by_default = routine.replace(":OUT", "");
        for routine in [routine, &by_default] {
            let done = module(body, routine);
            assert_eq!(
                found(&done),
                [expected],
                "{body}{routine}{:?}",
                done.findings
            );
        }
        if body.contains("FP1") {
            continue; // data of inline forms that any routine is given are not followed
        }
        // by value it stays
        let by_value = routine.replace(":OUT", ":IN");
        let done = module(body, &by_value);
        assert_eq!(found(&done), [""; 0], "{body}{by_value}{:?}", done.findings);
    }
    // through another routine
    let nested = "DEF set(b:OUT)\nFRAME b\ninner(b)\nEND\nDEF inner(b:OUT)\nFRAME b\nb.Z=0\nEND\n";
    let done = module("set(BASE_DATA[1])\n$BASE=BASE_DATA[1]\nLIN XP1\n", nested);
    assert_eq!(found(&done), [CHANGED], "{:?}", done.findings);
    // a function in a condition
    let function =
        "DEFFCT BOOL set(b:OUT)\nFRAME b\nb={X 0,Y 0,Z 0,A 0,B 0,C 0}\nRETURN TRUE\nENDFCT\n";
    let body = "IF set(BASE_DATA[1]) THEN\nENDIF\n$BASE=BASE_DATA[1]\nLIN XP1\n";
    let done = module(body, function);
    assert_eq!(found(&done), [CHANGED], "{:?}", done.findings);
}

#[test]
fn routines_that_are_not_in_the_files_and_the_controller_write_what_they_are_given() {
    let base = "$BASE=BASE_DATA[1]\nLIN XP1\n";
    for (body, expected) in [
        (format!("see(BASE_DATA[1])\n{base}"), CHANGED),
        (format!("see(BASE_DATA[1].Z)\n{base}"), CHANGED),
        (
            format!("r=EKI_GETFRAME(\"c\",\"f\",BASE_DATA[1])\n{base}"),
            CHANGED,
        ),
        (
            format!("SREAD(text[],state,offset,\"%f\",BASE_DATA[1].X)\n{base}"),
            CHANGED,
        ),
        (
            "CREAD(handle,state,mode,timeout,offset,\"%r\",$BASE)\nLIN XP1\n".to_owned(),
            CHANGED,
        ),
        (
            "r=EKI_GETREAL(\"c\",\"x\",XP1.X)\nLIN XP1\n".to_owned(),
            "target-assigned-at-run-time",
        ),
        (
            "SREAD(text[],state,offset,\"%f\",XP1.X)\nLIN XP1\n".to_owned(),
            "target-assigned-at-run-time",
        ),
    ] {
        let done = module(&body, "");
        assert_eq!(found(&done), [expected], "{body}{:?}", done.findings);
    }
}

#[test]
fn a_base_that_a_routine_is_given_is_known_in_it() {
    // with the numbers of its entry, however it is handed over
    let direct = module("$BASE=BASE_DATA[2]\nLIN XP1\n", "");
    let want = &direct.targets[0].q;
    for argument in ["b:IN", "b:OUT"] {
        let routine = format!("DEF go({argument})\nFRAME b\n$BASE=b\nLIN XP1\nEND\n");
        let done = module("go(BASE_DATA[2])\n", &routine);
        assert_eq!(errors(&done), [""; 0], "{:?}", done.findings);
        assert_eq!(&done.targets[0].q, want, "{argument}");
    }
}

#[test]
fn a_routine_that_may_lead_the_robot_elsewhere_makes_directions_uncertain() {
    let backlash = "{effect: backlash, joint: 2, width_deg: -0.1}";
    let body = "LIN {X 340.0,Y 10.0,Z 420.0,A 160,B 20,C 180}\nhome()\nLIN XP1\nLIN {X 340.0,Y \
        10.0,Z 300.0,A 160,B 20,C 180}\n";
    let text = format!("DEF t()\n{START}{body}END\n");
    let files = [
        ("$config.dat", CONFIG),
        ("t.dat", DATA),
        ("t.src", text.as_str()),
    ];
    let line = text
        .lines()
        .position(|line| line == "home()")
        .expect("the call")
        + 1;
    let reported = |effects: &[&str], files: &[(&str, &str)]| {
        let done = done(effects, files);
        let found = done
            .findings
            .iter()
            .filter(|f| f.id == "direction-uncertain");
        found
            .map(|f| (f.line, f.message.clone()))
            .collect::<Vec<_>>()
    };
    let found = reported(&[backlash], &files);
    assert_eq!(found.len(), 1, "{found:?}");
    assert_eq!(found[0].0, line);
    assert!(
        found[0].1.contains("`home`") && found[0].1.contains("joint 2"),
        "{found:?}"
    );
    // a width of 0.1 deg at joint 2, half a metre from the tool: some 0.9 mm between the two sides
    let off: f64 = found[0]
        .1
        .split(" mm off")
        .next()
        .and_then(|text| text.rsplit(' ').next())
        .and_then(|text| text.parse().ok())
        .expect("a number");
    assert!((0.5..1.2).contains(&off), "{off}");
    // without backlash, or with the routine in the files, nothing is uncertain
    assert_eq!(reported(&[PLAIN], &files), []);
    let whole = format!("{text}DEF home()\nEND\n");
    assert_eq!(
        reported(&[backlash], &[files[0], files[1], ("t.src", &whole)]),
        []
    );
}

#[test]
fn a_correction_across_half_a_rotation_from_where_a_joint_stands_is_reported() {
    // a program without data of rotations: the controller takes the nearest one
    let wrist = |deg: f64| format!("{{effect: link_geometry, link: 6, theta_deg: {deg}}}");
    let plain = super::profile(&[PLAIN]);
    let at = |j6: f64| {
        let q = [10.0, 20.0, -10.0, 30.0, 60.0, j6].map(f64::to_radians);
        let controller = plain.controller_model(&Mounted::flange());
        let pose = controller.forward(&q, &Conditions::default());
        let numbers = [pose.translation, pose.rotation.vector()].concat();
        numbers
            .iter()
            .map(|x| format!("{x:.7}"))
            .collect::<Vec<_>>()
            .join(",")
    };
    let program = |j6: f64| {
        format!(
            "movej([0.1745,0.3491,-0.1745,0.5236,1.0472,-1.5707963])\nmovej(p[{}])\n",
            at(j6)
        )
    };
    // the first takes joint 6 to 90.05 deg, half a rotation from -90 is 90
    for (deg, j6, expected) in [(-0.1, 89.95, 1), (0.1, 89.95, 0), (-0.1, 89.0, 0)] {
        let text = program(j6);
        let done = done(&[&wrist(deg)], &[("t.script", &text)]);
        let found: Vec<_> = done
            .findings
            .iter()
            .filter(|f| f.id == "several-postures")
            .collect();
        assert_eq!(
            found.len(),
            expected,
            "{deg} {j6} {:?} {:?}",
            done.findings,
            done.targets[0].q
        );
        for found in found {
            assert!(
                found.message.contains("joint 6") && found.message.contains("90.05 deg"),
                "{found:?}"
            );
        }
    }
}

#[test]
fn a_search_that_stops_leaves_the_robot_on_its_way() {
    let backlash = "{effect: backlash, joint: 2, width_deg: -0.1}";
    for (switch, call, expected) in [
        ("\\Stop,", "", 1),
        ("\\SStop,", "", 1),
        ("", "", 0),
        ("", "rHome;\n", 1),
        ("", "TPWrite \"x\";\n", 0),
    ] {
        let data = format!(
            "CONST robtarget a := [[330,10,420],{P};\nCONST robtarget b := [[330,10,380],{P};\nCONST \
             robtarget c := [[330,10,330],{P};\nVAR robtarget f;"
        );
        let body = format!(
            "MoveAbsJ [[0,0,0,0,60,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;\nMoveL \
             a,v100,fine,tool0;\nSearchL{} di1,f,b,v100,tool0;\n{call}MoveL c,v100,fine,tool0;",
            switch.trim_end_matches(',')
        );
        let body = body.replace("Stop di1", "Stop,di1");
        let done = done(&[backlash], &[("t.mod", &super::rapid(&data, &body))]);
        let found = done
            .findings
            .iter()
            .filter(|f| f.id == "direction-uncertain");
        assert_eq!(
            found.count(),
            expected,
            "{switch} {call} {:?}",
            done.findings
        );
    }
}

#[test]
fn resume_leaves_the_robot_anywhere_in_the_routine_that_is_interrupted() {
    let backlash = "{effect: backlash, joint: 2, width_deg: -0.1}";
    let away = "LIN {X 340.0,Y 10.0,Z 420.0,A 160,B 20,C 180}\n";
    let declared = "INTERRUPT DECL 4 WHEN $IN[1]==TRUE DO hit()\nINTERRUPT ON 4\n";
    for (declared, ending, expected) in [
        (declared, "RESUME\n", 1),
        (declared, "", 0),
        ("", "RESUME\n", 0),
    ] {
        let text = format!(
            "DEF t()\n{START}{declared}{away}seek()\nLIN XP1\nEND\nDEF seek()\nLIN {{X 340.0,Y \
             10.0,Z 440.0,A 160,B 20,C 180}}\nEND\nDEF hit()\nBRAKE\n{ending}END\n"
        );
        let done = done(
            &[backlash],
            &[("$config.dat", CONFIG), ("t.dat", DATA), ("t.src", &text)],
        );
        let led = |f: &&poseshift::finding::Finding| {
            f.id == "direction-uncertain" && f.message.contains("`RESUME`")
        };
        assert_eq!(
            done.findings.iter().filter(led).count(),
            expected,
            "{text}{:?}",
            done.findings
        );
    }
}

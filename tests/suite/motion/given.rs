//! What routines of KRL write through parameters: tools, bases, loads and parts of positions.

use super::{P, PLAIN, done, errors, given, message};
use poseshift::compensate::Compensation;

pub(super) const CONFIG: &str = "DEFDAT $CONFIG\nDECL FRAME TOOL_DATA[16]\nTOOL_DATA[1]={X 0,Y 0,Z 50,A 0,B \
    0,C 0}\nDECL FRAME BASE_DATA[32]\nBASE_DATA[1]={X 100,Y 0,Z 50,A 0,B 0,C 0}\nBASE_DATA[2]={X \
    120,Y 10,Z 50,A 5,B 0,C 0}\nDECL LOAD LOAD_DATA[16]\nLOAD_DATA[1]={M 1.0,CM {X 0,Y 0,Z 40,A \
    0,B 0,C 0},J {X 0,Y 0,Z 0}}\nENDDAT\n";
pub(super) const DATA: &str = "DEFDAT t\nDECL FDAT FP1={TOOL_NO 1,BASE_NO 1,IPO_FRAME #BASE}\nDECL FRAME \
    F={X 0,Y 0,Z 0,A 0,B 0,C 0}\nDECL E6POS XP1={X 320.0,Y 10.0,Z 380.0,A 160,B 20,C 180,S 2,T 2,E1 \
    0.0,E2 0.0,E3 0.0,E4 0.0,E5 0.0,E6 0.0}\nENDDAT\n";
pub(super) const START: &str = "PTP {A1 0,A2 -20,A3 40,A4 0,A5 70,A6 -60}\n$TOOL=TOOL_DATA[1]\n\
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
fn a_tool_that_program_and_profile_have_at_different_places_is_refused_where_it_was_measured() {
    let text = std::fs::read_to_string(crate::support::repository("robots/abb_irb120.yaml"));
    let text = text.expect("a profile");
    let plain = &text[..text.find("calibration:").expect("a list of effects")];
    let plain = plain.replace("tools: {}\n", "");
    let run = |effect: &str, z_mm: f64| {
        let profile = format!(
            "{plain}tools:\n  tGun: {{frame: {{x_mm: 0, y_mm: 0, z_mm: 100, rx_deg: 0, ry_deg: 0, \
             rz_deg: 0}}, mass_kg: 1, cog_mm: [0, 0, 50]}}\ncalibration: {{effects: [{PLAIN}, {effect}]}}\n"
        );
        let profile = poseshift::model::profile::Profile::from_yaml(&profile).expect("a profile");
        let text = super::rapid(
            &format!(
                "PERS tooldata tGun := [TRUE,[[0,0,{z_mm}],[1,0,0,0]],[1,[0,0,50],[1,0,0,0],0,0,0]];"
            ),
            &format!("MoveJ [[430,0,300],{P},v100,fine,tGun;"),
        );
        let sources = [poseshift::program::Source::new("t.mod", text.into_bytes())];
        let language = poseshift::program::language_of(&sources[0]).expect("a language");
        poseshift::compensate::compensate(language, &sources, &profile, &given()).expect("read")
    };
    let off = "{effect: tool_frame, tool: tGun, x_mm: 0.6, z_mm: 0.5}";
    let refused = run(off, 100.5);
    assert_eq!(errors(&refused), ["tool-differs"]);
    let said = message(&refused, "tool-differs");
    assert!(
        said.contains("100.5") && said.contains("0.500 mm"),
        "{said}"
    );
    assert_eq!(errors(&run(off, 100.0)), [""; 0]);
    // nothing counts from the profile's place
    let other = "{effect: tool_frame, tool: tOther, x_mm: 0.6, z_mm: 0.5}";
    assert_eq!(errors(&run(other, 100.5)), [""; 0]);
}

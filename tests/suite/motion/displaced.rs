//! Copies of targets that a program displaces again and again, or turns: how far from their wanted
//! poses they land, over all that the text allows.

use super::{P, PLAIN, done, errors, given, message, profile_of, rapid, try_with};
use poseshift::compensate::{Compensation, Options, compensate};
use poseshift::program::{Source, language_of};

const START: &str = "MoveAbsJ [[0,0,0,0,60,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;\nMoveL \
    p,v100,fine,tool0;\n";

fn program(body: &str) -> String {
    let data = format!("CONST robtarget p := [[430,0,400],{P};\nVAR robtarget q;\nVAR num n;");
    rapid(&data, &format!("{START}{body}"))
}

/// What a message says to be off, millimetres: the last number before those words.
fn miss_mm(message: &str) -> f64 {
    let before = message.split(" mm off").next().expect("a number");
    let number = before.rsplit(' ').next().expect("a number");
    number.parse().expect("a number")
}

fn unknown(done: &Compensation) -> Vec<f64> {
    let found = done
        .findings
        .iter()
        .filter(|f| f.id == "displacement-unknown");
    found.map(|f| miss_mm(&f.message)).collect()
}

#[test]
fn a_loop_that_lowers_a_copy_is_judged_at_the_lowest_place_that_it_may_come_to() {
    let each = |k: usize| format!("MoveL Offs(p,0,0,-{}),v100,fine,tool0;\n", 20 * k);
    let explicit = program(&(1..=10).map(each).collect::<String>());
    let explicit = done(&[PLAIN], &[("t.mod", &explicit)]);
    let places = explicit
        .findings
        .iter()
        .filter(|f| f.id == "displaced-target");
    let places: Vec<f64> = places.map(|f| miss_mm(&f.message)).collect();
    assert_eq!(places.len(), 10, "{:?}", explicit.findings);
    let most = places.iter().copied().fold(0.0, f64::max);
    let lower = "MoveL q,v100,fine,tool0;\nq.trans.z:=q.trans.z-20;";
    for counted in [
        format!("q:=p;\nFOR i FROM 1 TO 10 DO\n{lower}\nENDFOR"),
        "q:=p;\nFOR i FROM 1 TO 10 DO\nMoveL q,v100,fine,tool0;\nq:=Offs(q,0,0,-20);\nENDFOR"
            .into(),
    ] {
        let counted = done(&[PLAIN], &[("t.mod", &program(&counted))]);
        let said = unknown(&counted);
        assert_eq!(said.len(), 1, "{:?}", counted.findings);
        assert!((said[0] - most).abs() < 0.0015, "{said:?} of {places:?}");
        assert_eq!(errors(&counted), ["displacement-unknown"], "beyond 0.05 mm");
    }
    // how often nobody says: as far as the arm reaches
    let endless = program(&format!("q:=p;\nWHILE n>0 DO\n{lower}\nENDWHILE"));
    let refused = done(&[PLAIN], &[("t.mod", &endless)]);
    let said = unknown(&refused)[0];
    assert!(said >= most - 0.0015, "{said}");
    assert_eq!(errors(&refused), ["displacement-unknown"]);
    let options = Options {
        max_derived_error_m: Some(1e-3 * (said + 0.001)),
        ..given()
    };
    let taken = try_with(options, &[PLAIN], &[("t.mod", &endless)]).expect("read");
    assert_eq!(errors(&taken), [""; 0], "the bound holds");
}

#[test]
fn what_only_the_running_program_knows_may_be_added_once_and_not_again_and_again() {
    let add = "q.trans.z:=q.trans.z+n;\nMoveL q,v100,fine,tool0;";
    let once = program(&format!("WHILE n>0 DO\nq:=p;\n{add}\nENDWHILE"));
    let once = done(&[PLAIN], &[("t.mod", &once)]);
    assert_eq!(errors(&once), [""; 0], "{:?}", once.findings);
    assert_eq!(unknown(&once).len(), 1);
    let again = program(&format!("q:=p;\nWHILE n>0 DO\n{add}\nENDWHILE"));
    let options = Options {
        max_derived_error_m: Some(1.0),
        ..given()
    };
    let again = try_with(options, &[PLAIN], &[("t.mod", &again)]).expect("read");
    assert_eq!(
        errors(&again),
        ["displacement-unknown"],
        "no limit is high enough"
    );
    assert!(message(&again, "displacement-unknown").contains("nothing bounds"));
}

#[test]
fn growth_is_bounded_in_every_language() {
    let kuka = "DEF t()\nDECL E6POS p\n$TOOL=$NULLFRAME\n$BASE=$NULLFRAME\nPTP {A1 0,A2 -90,A3 \
        90,A4 0,A5 30,A6 0}\nLIN XP\np=XP\nLOOP\nLIN p\np.Z=p.Z-50\nENDLOOP\nEND\n";
    let data = "DEFDAT t\nDECL E6POS XP={X 500,Y 0,Z 600,A 0,B 90,C 0}\nENDDAT\n";
    let turned = kuka.replace("LOOP\nLIN p\np.Z=p.Z-50\nENDLOOP", "p.A=p.A+90\nLIN p");
    let fanuc = "/PROG T\n/MN\n 1: UFRAME_NUM=0 ;\n 2: UTOOL_NUM=1 ;\n 3:J P[1] 10% FINE ;\n \
        4: PR[1]=P[1] ;\n 5: LBL[1] ;\n 6:L PR[1] 100mm/sec FINE ;\n 7: PR[1,3]=PR[1,3]-10 ;\n 8: \
        JMP LBL[1] ;\n/POS\nP[1]{\n GP1:\n UF : 0, UT : 1, CONFIG : 'N U T, 0, 0, 0',\n X = 500.0 \
        mm, Y = 0.0 mm, Z = 300.0 mm,\n W = 180.0 deg, P = 0.0 deg, R = 0.0 deg\n};\n/END\n";
    let script = "def t():\n  set_tcp(p[0,0,0,0,0,0])\n  w = p[0.43,0.1,0.3,0.0,3.14159,0.0]\n  \
        movej([0,-1.2,1.5,-1.8,-1.5,0])\n  movel(w)\n  q = w\n  while True:\n    movel(q)\n    q[2] = \
        q[2] - 0.01\n  end\nend\n";
    let effect = "{effect: link_geometry, link: 3, theta_deg: 0.1, a_mm: 0.3}";
    let read = |robot: &str, files: &[(&str, &str)]| {
        let sources = files
            .iter()
            .map(|(name, text)| Source::new(*name, text.as_bytes().to_vec()));
        let sources: Vec<Source> = sources.collect();
        let language = language_of(&sources[0]).expect("a language");
        compensate(language, &sources, &profile_of(robot, &[effect]), &given()).expect("read")
    };
    for (robot, files) in [
        (
            "robots/kuka_kr6_r900.yaml",
            vec![("t.src", kuka), ("t.dat", data)],
        ),
        (
            "robots/kuka_kr6_r900.yaml",
            vec![("t.src", turned.as_str()), ("t.dat", data)],
        ),
        ("robots/fanuc_lrmate200ic.yaml", vec![("t.ls", fanuc)]),
        (
            "robots/universal_robots_ur5.yaml",
            vec![("t.script", script)],
        ),
    ] {
        let done = read(robot, &files);
        let said = unknown(&done);
        assert!(
            said.iter().any(|miss| *miss > 0.05),
            "{}: {:?}",
            files[0].0,
            done.findings
        );
        assert_eq!(errors(&done), ["displacement-unknown"], "{}", files[0].0);
    }
}

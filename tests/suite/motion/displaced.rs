//! Copies of targets that a program displaces again and again, or turns: how far from their wanted
//! poses they land, over all that the text allows.

use super::{P, PLAIN, done, errors, fakes, given, message, profile_of, rapid, try_with};
use poseshift::compensate::{Compensation, Options, compensate};
use poseshift::program::{Source, language_of};

const START: &str = "MoveAbsJ [[0,0,0,0,60,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;\nMoveL \
    p,v100,fine,tool0;\n";

fn program(body: &str) -> String {
    let data = format!("CONST robtarget p := [[430,0,400],{P};\nVAR robtarget q;\nVAR num n;");
    rapid(&data, &format!("{START}{body}"))
}

/// What a message says to be off, millimetres: the last number before those words.
pub(super) fn miss_mm(message: &str) -> f64 {
    let before = message.split(" mm off").next().expect("a number");
    let number = before.rsplit(' ').next().expect("a number");
    number.parse().expect("a number")
}

pub(super) fn unknown(done: &Compensation) -> Vec<f64> {
    let found = done
        .findings
        .iter()
        .filter(|f| f.id == "displacement-unknown" && f.message.contains(" mm off"));
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
fn of_several_displacements_that_come_to_a_move_the_worst_is_reported_once() {
    let at_z = |z: u32| {
        let body = format!("MoveL Offs(p,0,0,-{z}),v100,fine,tool0;");
        let found = done(&[PLAIN], &[("t.mod", &program(&body))]);
        miss_mm(message(&found, "displaced-target"))
    };
    // the point is displaced in three ways; the move to it stands once
    let copies = [20, 300, 100].map(|z| format!("q:=Offs(p,0,0,-{z});\ngo;\n"));
    let go = "PROC go()\nMoveL q,v100,fine,tool0;\nENDPROC";
    let data = format!("CONST robtarget p := [[430,0,400],{P};\nVAR robtarget q;\n{go}");
    let body = format!("{START}{}", copies.concat());
    let found = done(&[PLAIN], &[("t.mod", &rapid(&data, &body))]);
    let said = found.findings.iter().filter(|f| f.id == "displaced-target");
    let said: Vec<&str> = said.map(|f| f.message.as_str()).collect();
    assert_eq!(said.len(), 1, "{said:?}");
    assert!(
        said[0].ends_with("2 other displacements lead here"),
        "{said:?}"
    );
    assert_eq!(miss_mm(said[0]), at_z(300));
    assert!(at_z(300) > at_z(100), "the farthest is the worst");
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
    assert!(message(&again, "displacement-unknown").contains("not bound"));
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

/// How far off points land whose displacement the text tells, millimetres.
pub(super) fn misses(done: &Compensation) -> Vec<f64> {
    let found = done.findings.iter().filter(|f| f.id == "displaced-target");
    found.map(|f| miss_mm(&f.message)).collect()
}

pub(super) fn of_rapid(data: &str, body: &str) -> Compensation {
    let text = program(body).replace("VAR num n;", &format!("VAR num n;\n{data}"));
    done(&[PLAIN], &[("t.mod", &text)])
}

#[test]
fn a_number_with_one_value_counts_as_that() {
    let go = |by: &str| format!("MoveL Offs(p,{by}),v100,fine,tool0;");
    let row =
        |data: &str, by: &str| of_rapid(data, &format!("FOR i FROM 0 TO 9 DO\n{}\nENDFOR", go(by)));
    let literal = row("", "0,-i*20,0");
    assert_eq!(unknown(&literal).len(), 1, "{:?}", literal.findings);
    assert_eq!(errors(&literal), ["displacement-unknown"]);
    for data in [
        "CONST num pitch:=20;",
        "VAR num pitch:=20;",
        "CONST num half:=10;\nCONST num pitch:=2*half;",
    ] {
        let named = row(data, "0,-i*pitch,0");
        assert_eq!(unknown(&named), unknown(&literal), "{data}");
        assert_eq!(errors(&named), ["displacement-unknown"], "{data}");
    }
    let numbers = "CONST num offPick:=90;\nCONST num n1:=2;";
    let (one, other) = (
        of_rapid(numbers, &go("0,-(offPick*n1+20),0")),
        of_rapid("", &go("0,-200,0")),
    );
    assert_eq!(misses(&one), misses(&other));
    assert_eq!(misses(&one).len(), 1);
}

#[test]
fn a_number_that_adds_up_displaces_as_a_copy_does_that_is_displaced_again_and_again() {
    let copy = of_rapid(
        "",
        "q:=p;\nWHILE DInput(di1)=1 DO\nMoveL q,v100,fine,tool0;\nq:=Offs(q,0,-40,0);\nENDWHILE",
    );
    assert_eq!(errors(&copy), ["displacement-unknown"]);
    let number = "VAR num e:=0;";
    let go = "MoveL Offs(p,0,-e,0),v100,fine,tool0;";
    for add in ["e:=e+40;", "Add e,40;", "e:=40+e;"] {
        let body = format!("e:=0;\nWHILE DInput(di1)=1 DO\n{go}\n{add}\nENDWHILE");
        let number = of_rapid(number, &body);
        assert_eq!(errors(&number), ["displacement-unknown"], "{add}");
        let (number, copy) = (unknown(&number)[0], unknown(&copy));
        let copy = copy.into_iter().fold(0.0, f64::max);
        assert!((number - copy).abs() < 0.0015, "{add}: {number}, {copy}");
    }
    // as often as the text counts
    let counted = format!("e:=0;\nFOR i FROM 1 TO 5 DO\n{go}\ne:=e+40;\nENDFOR");
    let counted = of_rapid(number, &counted);
    let explicit = of_rapid(
        "",
        "FOR i FROM 0 TO 5 DO\nMoveL Offs(p,0,-i*40,0),v100,fine,tool0;\nENDFOR",
    );
    assert_eq!(unknown(&counted), unknown(&explicit));
    // by what only the running program knows: nothing bounds it
    let camera = format!("WHILE DInput(di1)=1 DO\n{go}\ne:=e+AInput(ai1);\nENDWHILE");
    let camera = of_rapid(number, &camera);
    assert!(message(&camera, "displacement-unknown").contains("not bound"));
    assert_eq!(errors(&camera), ["displacement-unknown"]);
    // what is read from elsewhere is no number of the text
    let read = of_rapid(number, &format!("TPReadNum e,\"e\";\n{go}"));
    assert_eq!(errors(&read), [""; 0]);
    assert!(message(&read, "displacement-unknown").contains("up to 5 mm"));
}

#[test]
fn numbers_of_the_text_are_the_least_that_a_displacement_is() {
    let go = |by: &str| format!("MoveL Offs(p,0,{by},0),v100,fine,tool0;");
    let most = |of: &[f64]| of.iter().copied().fold(0.0, f64::max);
    let explicit = |mm: f64| {
        let both = format!("{}\n{}", go(&mm.to_string()), go(&(-mm).to_string()));
        most(&misses(&of_rapid("", &both)))
    };
    for (by, mm) in [("-n*200", 200.0), ("n*150+50", 200.0), ("(n-1)*100", 200.0)] {
        let found = of_rapid("", &format!("n:=AInput(ai1);\n{}", go(by)));
        let said = most(&unknown(&found));
        assert!(
            said > explicit(mm) - 0.0015,
            "{by}: {said}, {}",
            explicit(mm)
        );
        assert_eq!(errors(&found), ["displacement-unknown"], "{by}");
        assert!(message(&found, "displacement-unknown").contains("with 1 for each factor"));
    }
    let small = of_rapid("", &format!("n:=AInput(ai1);\n{}", go("n*2")));
    assert!(message(&small, "displacement-unknown").contains("up to 5 mm"));
}

/// What is said of a program of another language.
pub(super) fn of_language(robot: &str, effects: &[&str], files: &[(&str, &str)]) -> Compensation {
    let sources = files.iter();
    let sources = sources.map(|(name, text)| Source::new(*name, text.as_bytes().to_vec()));
    let sources: Vec<Source> = sources.collect();
    let language = language_of(&sources[0]).expect("a language");
    compensate(language, &sources, &profile_of(robot, effects), &given()).expect("read")
}

/// A program in `URScript` that has moved to `w`, functions before it.
pub(super) fn of_urscript(functions: &str, body: &str) -> Compensation {
    let text = format!(
        "def t():\n{functions}  set_tcp(p[0,0,0,0,0,0])\n  w = \
         p[0.43,0.1,0.3,0.0,3.14159,0.0]\n  movej([0,-1.2,1.5,-1.8,-1.5,0])\n  \
         movel(w)\n{body}end\n"
    );
    of_language(
        "robots/universal_robots_ur5.yaml",
        &[PLAIN],
        &[("t.script", &text)],
    )
}

/// A KRL program that has moved to `XP`, with data of its list.
pub(super) fn of_krl(data: &str, body: &str) -> Compensation {
    let text = format!(
        "DEF t()\nDECL INT i\nDECL E6POS q\n$TOOL=$NULLFRAME\n$BASE=$NULLFRAME\nPTP {{A1 0,A2 \
         -90,A3 90,A4 0,A5 30,A6 0}}\nLIN XP\n{body}END\n"
    );
    let data = format!(
        "DEFDAT t\nDECL REAL PITCH=40\n{data}DECL E6POS XP={{X 500,Y 0,Z 600,A 0,B 90,C \
         0}}\nENDDAT\n"
    );
    let files = [("t.src", text.as_str()), ("t.dat", &data)];
    of_language("robots/kuka_kr6_r900.yaml", &[PLAIN], &files)
}

#[test]
fn numbers_of_other_languages_count_too() {
    let script = |body: &str| of_urscript("", body);
    let literal = script("  movel(pose_add(w, p[0,-0.2,0,0,0,0]))\n");
    let named = script("  pitch = 0.04\n  movel(pose_add(w, p[0,-pitch*5,0,0,0,0]))\n");
    assert_eq!(misses(&literal).len(), 1);
    assert_eq!(misses(&named), misses(&literal));
    let grown = script(
        "  e = 0\n  while True:\n    movel(pose_add(w, p[0,-e,0,0,0,0]))\n    e = e + 0.04\n  end\n",
    );
    assert_eq!(errors(&grown), ["displacement-unknown"]);

    let kuka = |body: &str| of_krl("", body);
    let each = |k: i32| format!("q=XP\nq.Y=q.Y-{}\nLIN q\n", 40 * k);
    let explicit = kuka(&(1..=9).map(each).collect::<String>());
    let most = misses(&explicit).into_iter().fold(0.0, f64::max);
    assert!(most > 0.05, "{:?}", explicit.findings);
    for by in ["i*40", "i*PITCH"] {
        let counted = kuka(&format!(
            "FOR i=0 TO 9\nq=XP\nq.Y=q.Y-{by}\nLIN q\nENDFOR\n"
        ));
        let said = unknown(&counted);
        assert_eq!(said.len(), 1, "{by}: {:?}", counted.findings);
        assert!((said[0] - most).abs() < 0.0015, "{by}: {said:?}, {most}");
        assert_eq!(errors(&counted), ["displacement-unknown"], "{by}");
    }
}

/// What a script lands off at the farthest of the steps that it makes from `w`.
fn farthest_step(lines: &str) -> Compensation {
    of_urscript("", lines)
}

#[test]
fn steps_that_a_loop_of_urscript_counts_are_judged_at_the_farthest() {
    let base = "  base = p[0.35,-0.2,0.45,0,3.1,0]\n";
    let step = |k: u32| format!("  movel(pose_trans(base, p[{}.0e-2,0,0,0,0,0]))\n", 5 * k);
    let explicit: String = (0..6).map(step).collect();
    let explicit = farthest_step(&format!("{base}  movel(base)\n{explicit}"));
    let most = misses(&explicit).into_iter().fold(0.0, f64::max);
    assert!(most > 0.001, "{:?}", explicit.findings);
    let counted = farthest_step(&format!(
        "{base}  i = 0\n  while i < 5:\n    movel(pose_trans(base, p[i*0.05,0,0,0,0,0]))\n    i = i + 1\n  \
         end\n"
    ));
    let said = unknown(&counted);
    assert_eq!(said.len(), 1, "{:?}", counted.findings);
    assert!(said[0] >= most - 0.0015, "{said:?}, {most}");
    // the position itself is corrected
    assert_eq!(
        counted
            .targets
            .iter()
            .filter(|of| of.fake.is_some())
            .count(),
        2
    );
    // a function that steps back from what it is given
    let above = "  def above(at):\n    return pose_trans(at, p[0,0,-0.05,0,0,0])\n  end\n  a = \
        p[0.35,-0.2,0.45,0,3.1,0]\n  b = p[0.35,-0.1,0.45,0,3.1,0]\n  movel(above(a))\n  movel(a)\n  \
        movel(above(b))\n  movel(b)\n";
    let above = farthest_step(above);
    assert_eq!(errors(&above), [""; 0], "{:?}", above.findings);
    assert_eq!(misses(&above).len(), 2, "{:?}", above.findings);
}

/// What functions make of a rewritten target takes its correction along, however they are nested.
#[test]
fn what_nested_functions_of_urscript_make_of_a_target_does_not_stay_as_it_is() {
    let functions = "  def side(w):\n    return pose_trans(w, p[0.05,0,0,0,0,0.3])\n  end\n  def \
        up(w,h):\n    return pose_trans(w, p[0,0,h,0,0,0])\n  end\n  a = \
        p[0.35,-0.2,0.45,0,3.1,0]\n  movel(a)\n";
    for made in [
        "movej(up(side(a),0.05))",
        "s = up(side(a),0.05)\n  movel(s)",
    ] {
        let done = farthest_step(&format!("{functions}  {made}\n"));
        assert_eq!(
            errors(&done),
            ["displacement-unknown"],
            "{made}: {:?}",
            done.findings
        );
    }
}

/// A height less that of a target: rewritten, the target has another one, and what is added to it is
/// that much less.
#[test]
fn what_is_worked_out_from_coordinates_of_a_target_loses_their_correction() {
    let wide = || {
        let mut options = given();
        options.max_derived_error_m = Some(5e-3);
        options
    };
    let of = |text: &str| try_with(wide(), &[PLAIN], &[("t.mod", text)]).expect("read");
    let plain = of(&program("MoveL Offs(p,0,0,50),v100,fine,tool0;\n"));
    let lifted = fakes(&plain)[0].translation[2] * 1e3 - 400.0;
    assert!(lifted.abs() > 0.2, "{lifted} mm");
    let derived = plain.findings.iter().find(|f| f.id == "displaced-target");
    let derived = miss_mm(&derived.expect("a note").message);
    for (amount, times) in [
        ("450-p.trans.z", 1.0),
        ("(450-p.trans.z)/2+25", 0.5),
        ("p.trans.z-350", 1.0),
        ("50+p.trans.z-p.trans.z", 0.0),
        ("up", 1.0),
    ] {
        let body = format!(
            "VAR num up;\nup:=450-p.trans.z;\n{START}MoveL Offs(p,0,0,{amount}),v100,fine,tool0;\n"
        );
        let data = format!("CONST robtarget p := [[430,0,400],{P};");
        let done = of(&rapid(&data, &body));
        let said = if times == 0.0 {
            let found = done.findings.iter().find(|f| f.id == "displaced-target");
            miss_mm(&found.expect("a note").message)
        } else {
            unknown(&done)[0]
        };
        let expected = derived + times * lifted.abs();
        assert!(
            said > expected - 0.02 && said < expected + 0.02,
            "{amount}: {said} for {expected} mm"
        );
    }
    // between two targets the corrections cancel as far as they are alike
    let data =
        format!("CONST robtarget p := [[430,0,400],{P};\nCONST robtarget p2 := [[430,0,380],{P};");
    let body = format!(
        "{START}MoveL p2,v100,fine,tool0;\nMoveL Offs(p,0,0,(p2.trans.z-p.trans.z)/4),v100,fine,tool0;\n"
    );
    let done = of(&rapid(&data, &body));
    let z = |at: usize| fakes(&done)[at].translation[2] * 1e3;
    let change = ((z(1) - 380.0) - (z(0) - 400.0)).abs() / 4.0;
    let said = unknown(&done)[0];
    assert!(
        said > change && said < change + 0.02,
        "{said} for {change} mm"
    );
}

/// However many calls a routine has, each goes with its own numbers.
#[test]
fn many_calls_each_displace_by_what_they_give() {
    const CALLS: u16 = 400;
    let point = |i: u16| {
        format!(
            "CONST robtarget p{i} := [[430,{},400],{P};\n",
            f64::from(i) * 1e-3
        )
    };
    let call = |i: u16| format!("go p{i},{};\n", i % 100);
    let data: String = (0..CALLS).map(point).collect();
    let calls: String = (0..CALLS).map(call).collect();
    let go = "PROC go(robtarget p,num h)\nMoveL Offs(p,0,0,h),v100,fine,tool0;\nMoveL \
        p,v100,fine,tool0;\nENDPROC";
    let start = "MoveAbsJ [[0,0,0,0,60,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;\n";
    let text = rapid(&format!("{data}{go}"), &format!("{start}{calls}"));
    let found = done(&[PLAIN], &[("t.mod", &text)]);
    assert_eq!(errors(&found), [""; 0], "{:?}", found.findings.first());
    assert_eq!(fakes(&found).len(), usize::from(CALLS));
}

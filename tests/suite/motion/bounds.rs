//! What displaces a point is never judged smaller than what the text allows.

use super::displaced::{misses, of_krl, of_rapid, of_urscript, unknown};
use super::{BACKLASH, P, PLAIN, done, errors, given, message, profile_of, rapid};
use poseshift::compensate::{Compensation, Options, compensate};
use poseshift::program::{Source, language_of};

fn most(of: &[f64]) -> f64 {
    of.iter().copied().fold(0.0, f64::max)
}

/// What is said is no less than what a point with the displacement written out misses, and blocks.
fn covers(done: &Compensation, written_out: &Compensation, case: &str) {
    let truth = most(&misses(written_out));
    assert!(truth > 0.05, "{case}: {:?}", written_out.findings);
    let has_no_bound = done
        .findings
        .iter()
        .any(|found| found.message.contains("not bound"));
    let said = most(&[unknown(done), misses(done)].concat());
    assert!(
        has_no_bound || said > 0.9 * truth,
        "{case}: {said} of {truth}"
    );
    assert!(!errors(done).is_empty(), "{case}: {:?}", done.findings);
}

fn go(by: &str) -> String {
    format!("MoveL Offs(p,{by}),v100,fine,tool0;")
}

fn rapid_at(by: &str) -> Compensation {
    of_rapid("", &go(by))
}

#[test]
fn steps_of_loops_are_counted_as_the_text_counts_them() {
    for header in ["1 TO 4 * 40", "1 TO 160 STEP 1 / 1", "1 TO 3 - -157"] {
        let body = format!(
            "e:=0;\nFOR i FROM {header} DO\ne:=e-1;\n{}\nENDFOR",
            go("0,0,e")
        );
        let done = of_rapid("VAR num e;", &body);
        covers(&done, &rapid_at("0,0,-160"), header);
    }
    let rec = "VAR num e;\nPROC rec()\ne:=0;\nIF DInput(di1)=1 THEN\nrec;\nENDIF\ne:=e-4;\n";
    let rec = format!("{rec}{}\nENDPROC", go("0,0,e"));
    covers(
        &of_rapid(&rec, "rec;"),
        &rapid_at("0,0,-200"),
        "a routine that calls itself",
    );
}

#[test]
fn conditions_of_loops_bound_what_adds_up() {
    let said = |done: &Compensation| message(done, "displacement-unknown").to_owned();
    let lower = "q=XP\nq.Y=q.Y-n*40\nLIN q\nn=n+1";
    let krl = |body: &str| of_krl("DECL INT n=0\nDECL INT m=0\n", body);
    for (body, is_bounded) in [
        (format!("n=0\nWHILE n<4\n{lower}\nENDWHILE\n"), true),
        (format!("n=0\nREPEAT\n{lower}\nUNTIL n>=4\n"), true),
        (
            format!("n=0\nREPEAT\n{lower}\nUNTIL (n==4) OR $IN[1]\n"),
            true,
        ),
        (
            format!("n=0\nLOOP\n{lower}\nIF n>3 THEN\nEXIT\nENDIF\nENDLOOP\n"),
            true,
        ),
        (
            format!("n=0\nm=0\nREPEAT\n{lower}\nm=m+1\nUNTIL m>=4\n"),
            true,
        ),
        (
            format!("n=0\nLOOP\n{lower}\nIF n>=4 THEN\nn=0\nENDIF\nENDLOOP\n"),
            true,
        ),
        (
            format!("n=0\nREPEAT\n{lower}\nUNTIL (n>=4) AND $IN[1]\n"),
            false,
        ),
        (
            format!("n=0\nLOOP\n{lower}\nIF n>3 THEN\nHALT\nENDIF\nENDLOOP\n"),
            false,
        ),
        (
            format!("n=0\nREPEAT\nm=0\n{lower}\nm=m+1\nUNTIL m>=4\n"),
            false,
        ),
        (format!("REPEAT\n{lower}\nUNTIL n>=4\n"), false),
    ] {
        let said = said(&krl(&body));
        let wanted = if is_bounded {
            "up to 4 times"
        } else {
            "any number"
        };
        assert!(said.contains(wanted), "{body}: {said}");
    }
    let e = "VAR num e;";
    let rapid = format!(
        "e:=0;\nWHILE e>-160 DO\n{}\ne:=e-40;\nENDWHILE",
        go("0,0,e")
    );
    let rapid = said(&of_rapid(e, &rapid));
    assert!(rapid.contains("up to 4 times"), "{rapid}");
    let script = "  e = 0\n  while e < 4:\n    movel(pose_add(w, p[0,-0.04*e,0,0,0,0]))\n    e = e + 1\n  \
                  end\n";
    let script = said(&of_urscript("", script));
    assert!(script.contains("up to 4 times"), "{script}");
}

#[test]
fn a_routine_that_an_interrupt_runs_too_adds_up_without_a_bound() {
    let step = |trap: &str| {
        format!(
            "VAR num e;\nPROC step()\ne:=0;\nFOR i FROM 1 TO 2 DO\ne:=e-10;\n{}\nENDFOR\nENDPROC\nTRAP \
            t\n{trap}\nENDTRAP\n",
            go("0,0,e")
        )
    };
    let said = |done: &Compensation| message(done, "displacement-unknown").to_owned();
    let alone = of_rapid(&step("stopmove;"), "step;");
    assert!(said(&alone).contains("up to 2 times"), "{}", said(&alone));
    let inside = of_rapid(&step("step;"), "step;");
    assert!(said(&inside).contains("any number"), "{}", said(&inside));
}

#[test]
fn a_part_set_to_that_of_the_original_takes_back_what_was_added() {
    let step = |by: &str| format!("q.trans.z:={by};\nMoveL q,v100,fine,tool0;\n");
    let all = ["q.trans.z+50", "p.trans.z", "q.trans.z-200"].map(step);
    let done = of_rapid("", &format!("q:=p;\n{}", all.concat()));
    let of = |by: &str| misses(&rapid_at(by))[0];
    assert_eq!(
        misses(&done),
        [of("0,0,50"), of("0,0,-200")],
        "{:?}",
        done.findings
    );
    // and again in a loop, each time from there
    let body = format!(
        "q:=p;\nFOR i FROM 1 TO 5 DO\n{}{}ENDFOR",
        step("p.trans.z"),
        step("q.trans.z-i*40")
    );
    covers(&of_rapid("", &body), &rapid_at("0,0,-200"), "a loop");
    let all = of_rapid(
        "",
        "q:=p;\nq.trans:=q.trans+[0,0,-200];\nMoveL q,v100,fine,tool0;",
    );
    assert_eq!(misses(&all), [of("0,0,-200")]);
}

#[test]
fn places_near_the_target_count_however_far_or_fine_the_steps_are() {
    let jog = |to: &str| {
        let one = |at: usize, axis: &str| {
            format!(
                "IF DInput(di{at})=1 THEN\n{axis}:={axis}+0.1;\nENDIF\nIF DInput(di{at})=2 THEN\n\
                {axis}:={axis}-0.1;\nENDIF\n"
            )
        };
        let all = [one(1, "x"), one(2, "y"), one(3, "z")].concat();
        format!("FOR i FROM 1 TO 3 DO\n{all}{}\nENDFOR", go(to))
    };
    let data = "PERS num x:=0;\nPERS num y:=0;\nPERS num z:=0;";
    covers(
        &of_rapid(data, &jog("x+i,y+i,z+i")),
        &rapid_at("0,0,-100"),
        "jog",
    );
    let either = "IF DInput(di1)=1 THEN\nh:=-200;\nELSEIF DInput(di1)=2 THEN\nh:=0;\nENDIF\n";
    let either = of_rapid("VAR num h:=-99999;", &format!("{either}{}", go("0,0,h")));
    covers(&either, &rapid_at("0,0,-180"), "one that is far");
    let two = "z:=0;\nWHILE DInput(di1)=1 DO\nIF DInput(di2)=1 THEN\nz:=z-0.00005;\nELSE\n\
        z:=z-20;\nENDIF\n";
    let two = of_rapid("VAR num z;", &format!("{two}{}\nENDWHILE", go("0,0,z")));
    covers(&two, &rapid_at("0,0,-200"), "two steps");
    let sensor = of_rapid("", &format!("n:=AInput(ai1);\n{}", go("0,0,-2000*n")));
    covers(&sensor, &rapid_at("0,0,-180"), "a large factor");
    // steps that rotate the tool, too
    let turned = "MoveL Offs(RelTool(p,x+i,y+i,z+i),x+i,y+i,z+i),v100,fine,tool0;";
    let turned = jog("x,y,z").replace(&go("x,y,z"), turned);
    covers(
        &of_rapid(data, &turned),
        &rapid_at("0,0,-100"),
        "in the tool, too",
    );
}

#[test]
fn numbers_are_followed_through_parameters_functions_and_arrays() {
    let truth = rapid_at("0,0,-200");
    let routine = format!("PROC go(num h)\n{}\nENDPROC", go("0,0,h"));
    let given = of_rapid(&routine, "go -200;");
    assert_eq!(misses(&given), misses(&truth), "{:?}", given.findings);
    let optional = format!("PROC go(\\num h)\n{}\nENDPROC", go("0,0,h"));
    assert_eq!(misses(&of_rapid(&optional, "go\\h:=-200;")), misses(&truth));
    let several = of_rapid(&routine, "FOR i FROM 1 TO 5 DO\ngo -40*i;\nENDFOR");
    covers(&several, &truth, "of a counter");
    for add in [
        "e:=Round(e-5);",
        "e:=Max(e-20,-200);",
        "e:=Trunc(e*1);\ne:=e-4;",
    ] {
        let body = format!("WHILE DInput(di1)=1 DO\n{add}\n{}\nENDWHILE", go("0,0,e"));
        covers(&of_rapid("VAR num e;", &body), &truth, add);
    }
    let data = "VAR num h{3}:=[0,0,0];";
    for add in [
        "h{1}:=h{1}-5;",
        "Add h{1},-5;",
        "Decr h{1};",
        "h{2}:=0;\nAdd h{1},-5;",
        "Clear h{2};\nAdd h{1},-5;",
    ] {
        let array = format!(
            "WHILE DInput(di1)=1 DO\n{add}\n{}\nENDWHILE",
            go("0,0,h{1}")
        );
        covers(&of_rapid(data, &array), &truth, add);
        let counted = array.replace("WHILE DInput(di1)=1", "FOR i FROM 1 TO 200");
        let counted = counted.replace("ENDWHILE", "ENDFOR");
        covers(&of_rapid(data, &counted), &truth, add);
    }
    let declared = of_rapid("CONST num h{2}:=[0,-200];", &go("0,0,h{2}"));
    covers(&declared, &truth, "an element of the declaration");
    let script = of_urscript(
        "  def go(w, h):\n    movel(pose_add(w, p[0,h,0,0,0,0]))\n  end\n",
        "  go(w, -0.2)\n",
    );
    let written_out = of_urscript("", "  movel(pose_add(w, p[0,-0.2,0,0,0,0]))\n");
    assert_eq!(
        misses(&script),
        misses(&written_out),
        "{:?}",
        script.findings
    );
}

#[test]
fn rotations_of_the_text_count() {
    let go = |by: &str| format!("  movel(pose_trans(w, p[0,0,0,0,{by},0]))\n");
    let written_out = of_urscript("", &go("0.5235987755982988"));
    let degrees = of_urscript("", &go("d2r(30)"));
    assert_eq!(
        misses(&degrees),
        misses(&written_out),
        "{:?}",
        degrees.findings
    );
    let either = "  a = 0.1\n  if (n == 1):\n    a = 0.5236\n  end\n";
    let either = of_urscript("", &format!("{either}{}", go("a")));
    covers(&either, &written_out, "one of two");
}

#[test]
fn what_krl_writes_into_numbers_counts() {
    let truth = of_krl("", "q=XP\nq.Y=q.Y-200\nLIN q\n");
    let lower = "q=XP\nq.Y=q.Y-h\nLIN q\n";
    let data = "DECL REAL h=0\nDECL INT n=0\n";
    let read = of_krl(data, &format!("ANIN ON h=300*s1+0\n{lower}"));
    assert_eq!(unknown(&read).len(), 1, "a sensor: {:?}", read.findings);
    let again =
        format!("h=0\nFOR i=1 TO 3\nIF $IN[1]==FALSE THEN\ni=i-1\nENDIF\nh=h+5\n{lower}ENDFOR\n");
    covers(&of_krl(data, &again), &truth, "a counter that is set back");
    let many = format!("h=0\nFOR i=1 TO 2000000\nh=h+0.2\n{lower}ENDFOR\n");
    covers(&of_krl(data, &many), &truth, "many rounds");
    // whole numbers: 3/2 is 1
    let odd = of_krl(data, "n=3\nq=XP\nq.Y=q.Y-(n-n/2*2)*200\nLIN q\n");
    covers(&odd, &truth, "an odd number");
    let given = of_krl(
        data,
        "sub(200.0)\nEND\nDEF sub(d:IN)\nDECL REAL d\nDECL E6POS \
        r\nr=XP\nr.Y=r.Y-d\nLIN r\n",
    );
    assert_eq!(misses(&given), misses(&truth), "{:?}", given.findings);
    let written_out = of_krl("", "LIN XP:{X 0,Y 0,Z 200,A 0,B 0,C 0}\n");
    for frame in [
        "{Z 200}",
        "{FRAME: Z 200}",
        "{X 0,Y 0,Z PITCH*5,A 0,B 0,C 0}",
    ] {
        let done = of_krl("", &format!("LIN XP:{frame}\n"));
        assert_eq!(
            misses(&done),
            misses(&written_out),
            "{frame}: {:?}",
            done.findings
        );
    }
}

#[test]
fn a_joint_of_a_copy_that_changes_has_no_bound() {
    let text = "DEF t()\nDECL E6AXIS a,b\n$TOOL=$NULLFRAME\n$BASE=$NULLFRAME\na={A1 0,A2 -90,A3 \
        90,A4 0,A5 60,A6 0}\nPTP a\nb=a\nb.A2=b.A2+40\nPTP b\nEND\n";
    let options = Options {
        correct_joint_targets: true,
        ..given()
    };
    let source = Source::new("t.src", text.as_bytes().to_vec());
    let language = language_of(&source).expect("KRL");
    let profile = profile_of("robots/kuka_kr6_r900.yaml", &[PLAIN]);
    let done = compensate(language, &[source], &profile, &options).expect("read");
    assert!(message(&done, "displacement-unknown").contains("not bound"));
    assert_eq!(errors(&done), ["displacement-unknown"]);
}

#[test]
fn elements_made_of_their_own_list_end_in_a_refusal() {
    let of = |line: &str| {
        let text = format!(
            "def t():\n  set_tcp(p[0,0,0,0,0,0])\n  movej([0,0,0,0,1.0,0])\n  \
             l=[p[0.43,0,0.4,0,3.14159,0],p[0.43,0.05,0.4,0,3.14159,0]]\n  i=0\n  movel(l[0])\n  \
             {line}\n  movel(l[0])\nend\n"
        );
        done(&[PLAIN], &[("t.script", &text)])
    };
    for line in [
        "l[0]=pose_add(l[0],p[0,0,-0.1,0,0,0])",
        "l[0]=pose_add(l[1],p[0,0,-0.1,0,0,0])",
        "l[i]=pose_add(l[i],p[0,0,-0.1,0,0,0])",
    ] {
        let made = of(line);
        assert!(
            errors(&made).contains(&"displacement-unknown"),
            "{line}: {:?}",
            made.findings
        );
    }
    let over = of("l[0][2]=0.3");
    assert!(
        errors(&over).contains(&"target-overwritten"),
        "{:?}",
        over.findings
    );
}

#[test]
fn kept_joints_in_another_unit_are_refused_and_such_a_little_beyond_are_reported() {
    let of = |joint: &str| {
        let text = rapid(
            &format!("CONST robtarget p := [[430,0,400],{P};"),
            &format!(
                "MoveAbsJ [[{joint},0,0,0,60,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;\nMoveJ \
                 p,v100,fine,tool0;"
            ),
        );
        done(&[PLAIN], &[("t.mod", &text)])
    };
    // the arm's joint 1 goes to 165 degrees
    let inside = of("160");
    assert!(inside.findings.iter().all(|f| f.id != "beyond-limit"));
    assert_eq!(errors(&inside), [""; 0], "{:?}", inside.findings);
    let beyond = of("170");
    assert_eq!(errors(&beyond), [""; 0], "{:?}", beyond.findings);
    assert!(message(&beyond, "beyond-limit").contains("165.000"));
    let other_unit = of("9167");
    let said = errors(&other_unit);
    let of_limits = said.iter().filter(|id| **id == "joint-limit");
    assert_eq!(of_limits.count(), 1, "{said:?}");
}

#[test]
fn joint_moves_of_threads_are_reported_where_moves_to_poses_follow() {
    let of = |inside: &str| {
        let text = format!(
            "def t():\n  set_tcp(p[0,0,0,0,0,0])\n  thread away():\n    {inside}\n  end\n  \
             movej([0,0,0,0,1.0,0])\n  h=run away()\n  join h\n  \
             movej(p[0.43,0,0.4,0,3.14159,0])\nend\n"
        );
        done(&[PLAIN], &[("t.script", &text)])
    };
    let joints = of("movej([0,0,1.0,0,-1.0,0])");
    let said = message(&joints, "posture-assumed");
    assert!(said.contains("thread `away`"), "{said}");
    // on a straight line the arm stays on its branch
    let straight = of("movel(p[0.43,0,0.45,0,3.14159,0])");
    assert!(
        straight.findings.iter().all(|f| f.id != "posture-assumed"),
        "{:?}",
        straight.findings
    );
}

#[test]
fn the_side_from_which_joints_come_to_a_derived_point_is_named_where_nothing_says_it() {
    // down to p, then up from far below to points that a counter raises
    let body = |at: &str| {
        format!(
            "MoveAbsJ [[0,0,0,0,60,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;\nMoveL p,v100,fine,tool0;\n\
             FOR i FROM 1 TO 3 DO\nMoveL low,v100,fine,tool0;\nMoveL Offs(p,0,0,{at}),v100,fine,tool0;\nENDFOR"
        )
    };
    let data = format!(
        "CONST robtarget p := [[330,10,380],{P};\nCONST robtarget low := [[330,10,300],{P};"
    );
    let of = |effects: &[&str], at: &str| done(effects, &[("t.mod", &rapid(&data, &body(at)))]);
    let is_said = |done: &Compensation| {
        done.findings
            .iter()
            .any(|f| f.message.contains("whichever side"))
    };
    let known = of(&[BACKLASH], "2");
    assert!(!is_said(&known), "{:?}", known.findings);
    let off = most(&misses(&known));
    assert!(off > 0.3, "{off}");
    // nearly all of it is the side, and the side is in the figure that the limit is for
    let unknown_side = of(&[BACKLASH], "i*2");
    let said = message(&unknown_side, "displacement-unknown");
    assert!(
        said.contains("from whichever side joint 2 with backlash comes"),
        "{said}"
    );
    let bound = most(&unknown(&unknown_side));
    assert!((0.99 * off..1.1 * off).contains(&bound), "{bound} {off}");
    assert_eq!(errors(&unknown_side), ["displacement-unknown"]);
    assert!(!is_said(&of(&[PLAIN], "i*2")));
}

#[test]
fn behind_a_point_that_nobody_knows_both_sides_are_in_the_figure() {
    let data = format!(
        "CONST robtarget p := [[330,10,380],{P};\nCONST robtarget low := [[330,10,300],{P};"
    );
    let of = |before: &str| {
        let body = format!(
            "MoveAbsJ [[0,0,0,0,60,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;\nMoveL p,v100,fine,tool0;\n\
             FOR i FROM 1 TO 3 DO\nMoveL {before},v100,fine,tool0;\nENDFOR\nMoveL Offs(p,0,0,2),v100,fine,tool0;"
        );
        done(&[BACKLASH], &[("t.mod", &rapid(&data, &body))])
    };
    let known = misses(&of("low"));
    let unknown = misses(&of("Offs(low,0,0,i)"));
    // from there joint 2 comes from below all the same
    assert!(
        unknown[0] > 0.99 * known[0] && known[0] > 0.3,
        "{known:?} {unknown:?}"
    );
}

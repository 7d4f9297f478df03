//! Targets with parts from elsewhere: which parts take the correction along.

use super::*;

/// By what each move is displaced from its target.
fn displaced(statements: &str) -> Vec<Displacement> {
    let program = path(&format!("VAR robtarget q;\n{statements}"));
    let moves = program.moves.iter();
    moves.map(|m| m.displacement.clone()).collect()
}

#[test]
fn coordinates_that_come_from_no_target_lose_its_correction() {
    let numbers = "VAR pos s:=[1,2,3];\nPERS num up:=150;\nq:=p1;\n";
    for statements in [
        "MoveL [[150,35,82],p1.rot,p1.robconf,p1.extax],v5,z5,t;",
        "MoveL [[p1.trans.x,p1.trans.y,150],p1.rot,p1.robconf,p1.extax],v5,z5,t;",
        "q:=[[150,35,82],p1.rot,p1.robconf,p1.extax];\nMoveL q,v5,z5,t;",
        "VAR pos s:=[1,2,3];\nq:=[s,p1.rot,p1.robconf,p1.extax];\nMoveL q,v5,z5,t;",
        "VAR num z;\nq:=p1;\nIF a z:=150;\nIF b z:=p1.trans.z;\nq.trans.z:=z;\nMoveL q,v5,z5,t;",
        "VAR pos s;\nq:=p1;\ns:=[p1.trans.x,p1.trans.y,9];\nq.trans:=s;\nMoveL q,v5,z5,t;",
        "q:=p1;\nlift q,150;\nENDPROC\nPROC lift(robtarget p,num z)\np.trans.z:=z;\nMoveL \
         p,v5,z5,t;",
        "CONST jointtarget j:=[[1,2,3,4,5,6],[9E9,9E9,9E9,9E9,9E9,9E9]];\nMoveAbsJ \
         [[0,0,j.robax.rax_3,0,0,0],j.extax],v5,z5,t;",
    ] {
        let all = displaced(statements);
        assert!(
            !all.is_empty() && all.iter().all(|by| *by == Displacement::Overwritten),
            "{statements}: {all:?}"
        );
    }
    for write in [
        "q.trans:=s;",
        "q.trans.z:=up;",
        "q.trans.z:=-up+5;",
        "q.trans.x:=nCamera;",
        "q.trans:=[p1.trans.x,p1.trans.y,150];",
        "q.trans:=p2.trans;",
        "q.robconf:=[0,-2,1,1];",
    ] {
        let all = displaced(&format!("{numbers}{write}\nMoveL q,v5,z5,t;"));
        assert_eq!(all, [Displacement::Overwritten], "{write}");
    }
}

#[test]
fn coordinates_computed_from_a_target_keep_its_correction() {
    let functions = "\nENDPROC\nFUNC num up(num z)\nRETURN z+50;\nENDFUNC\nFUNC num \
                     height()\nRETURN p1.trans.z+50;\nENDFUNC\nPROC last()";
    for write in [
        "q.trans:=[p1.trans.x,p2.trans.y,p1.trans.z+50];",
        "q.trans:=CPos(\\Tool:=t);",
        "q.trans.z:=up(p1.trans.z);",
        "q.trans.z:=height();",
        "z:=p1.trans.z+50;\nz:=z+1;\nq.trans.z:=z;",
        "s:=[p1.trans.x,p2.trans.y,p1.trans.z];\nq.trans:=s;",
        "s:=p1.trans;\nset z;\nq.trans.z:=z;",
    ] {
        let all = displaced(&format!(
            "VAR num z:=0;\nVAR pos s;\nq:=p1;\n{write}\nMoveL q,v5,z5,t;\nENDPROC\nPROC set(INOUT \
             num z)\nz:=p1.trans.z;{functions}"
        ));
        assert_eq!(all, [Displacement::Unbounded], "{write}");
    }
    // what nobody knows, and other parts than coordinates
    for write in ["q.trans.z:=q.trans.z+h;", "q.extax.eax_a:=rail;"] {
        let all = displaced(&format!("q:=p1;\n{write}\nMoveL q,v5,z5,t;"));
        assert_eq!(all, [Displacement::Unknown], "{write}");
    }
    for target in [
        "[p2.trans,p1.rot,p1.robconf,p1.extax]",
        "[[p1.trans.x,p1.trans.y,p1.trans.z+h],o,p1.robconf,p1.extax]",
    ] {
        for all in [
            displaced(&format!("MoveL {target},v5,z5,t;")),
            displaced(&format!("q:={target};\nMoveL q,v5,z5,t;")),
        ] {
            assert!(
                !all.is_empty() && all.iter().all(|by| *by == Displacement::Unbounded),
                "{target}: {all:?}"
            );
        }
    }
}

#[test]
fn arithmetic_of_a_copy_displaces_it_by_what_the_text_says() {
    let along = |by| Displacement::By(Box::new(Shift::along(by)));
    let turned = |angle| Displacement::Within(Box::new([Stride::Turned(angle)]));
    for (write, by) in [
        ("q.trans.z:=q.trans.z+50;", along([0.0, 0.0, 0.05])),
        (
            "q.trans.Z := 5 + Q.trans.z - up;",
            along([0.0, 0.0, -0.025]),
        ),
        ("q.trans.z:=p1.trans.z+up;", along([0.0, 0.0, 0.03])),
        // a copy of what is displaced itself
        (
            "VAR robtarget u;\nq.trans.x:=p1.trans.x+80;\nu:=q;\nu.trans.z:=q.trans.z+150;\nq:=u;",
            along([0.08, 0.0, 0.15]),
        ),
        (
            "VAR robtarget u;\nu:=Offs(p1,80,0,50);\nq.trans.z:=u.trans.z+20;",
            Displacement::Unbounded,
        ),
        ("Add Q.trans.z, 2*up;", along([0.0, 0.0, 0.06])),
        ("Add q.trans.y,-20;", along([0.0, -0.02, 0.0])),
        ("Incr q.trans.x;", along([0.001, 0.0, 0.0])),
        ("Decr q.trans.x;", along([-0.001, 0.0, 0.0])),
        ("Clear q.trans.x;", Displacement::Overwritten),
        (
            "q.trans.x:=p1.trans.x+10;\nIF a Stop;\nq.trans.z:=p1.trans.z+50;",
            along([0.01, 0.0, 0.05]),
        ),
        // along the same axis the last one counts
        (
            "q.trans.z:=p1.trans.z+10;\nIF a Stop;\nq.trans.z:=p1.trans.z+50;",
            along([0.0, 0.0, 0.05]),
        ),
        ("q.trans.z:=p2.trans.z+50;", Displacement::Overwritten),
        ("q.rot:=o;", turned(None)),
        (
            "q.rot:=OrientZYX(EulerZYX(\\Z,q.rot)+90,0,180);",
            turned(None),
        ),
        (
            "UnpackRawBytes rb,1,q.trans.x\\Float4;",
            Displacement::Overwritten,
        ),
        ("ReadAnyBin file,q.trans.z;", Displacement::Overwritten),
        ("ok:=StrToVal(s,q.trans.x);", Displacement::Overwritten),
        ("set q.trans.z;", Displacement::Overwritten),
        ("lift q.trans.z;", Displacement::Unbounded),
    ] {
        let all = displaced(&format!(
            "CONST num up:=30;\nq:=p1;\n{write}\nMoveL q,v5,z5,t;\nENDPROC\nPROC set(INOUT num \
             z)\nz:=150;\nENDPROC\nPROC lift(INOUT num z)\nz:=z+10;"
        ));
        assert_eq!(all, [by], "{write}");
    }
}

#[test]
fn steps_of_several_writes_add_up() {
    let lower = "q.trans.z:=q.trans.z-10;\nMoveL q,v5,z5,t;\n";
    let all = displaced(&format!("q:=p1;\n{}", lower.repeat(6)));
    assert_eq!(all.len(), 6);
    for (count, by) in (1_u32..).zip(all) {
        let Displacement::By(shift) = by else {
            panic!("{by:?}");
        };
        let [x, y, z] = shift.in_frame.translation;
        assert!(x == 0.0 && y == 0.0 && (z + 0.01 * f64::from(count)).abs() < 1e-12);
    }
}

#[test]
fn what_counted_loops_add_is_each_of_their_rounds() {
    let pallet = "FOR i FROM 0 TO 3 DO\nFOR k FROM 1 TO 5 DO\nMoveL Offs(p1,i*40,(k-1)*50,-5),\
                  v5,z5,t;\nENDFOR\nENDFOR";
    let by = |shift, most| Stride::By {
        shift: Shift::along(shift),
        most: Some(most),
    };
    let steps = [
        by([0.0, 0.0, -0.005], 1),
        by([0.04, 0.0, 0.0], 3),
        by([0.0, 0.05, 0.0], 4),
    ];
    assert_eq!(displaced(pallet), [Displacement::Within(Box::new(steps))]);
    // nobody knows how many: one at least
    let open = pallet.replace("TO 3", "TO n");
    let steps = [
        by([0.0, 0.0, -0.005], 1),
        by([0.04, 0.0, 0.0], 1),
        by([-0.04, 0.0, 0.0], 1),
        by([0.0, 0.05, 0.0], 4),
    ];
    assert_eq!(displaced(&open), [Displacement::AtLeast(Box::new(steps))]);
}

/// What a step of the text may come to in a loop.
fn grown(shift: Shift, most: Option<u32>) -> Displacement {
    Displacement::Within(Box::new([Stride::By { shift, most }]))
}

#[test]
fn what_a_loop_adds_again_counts_as_often_as_the_text_says() {
    let down = Shift::along([0.0, 0.0, -0.02]);
    let once = Displacement::By(Box::new(down));
    let lower = "MoveL q,v5,z5,t;\nq.trans.z:=q.trans.z-20;";
    for (loops, most) in [
        (
            format!("q:=p1;\nFOR i FROM 1 TO 10 DO\n{lower}\nENDFOR"),
            Some(10),
        ),
        (
            format!("q:=p1;\nFOR i FROM 9 TO 1 STEP -4 DO\n{lower}\nENDFOR"),
            Some(3),
        ),
        (
            format!("WHILE a DO\nq:=p1;\nFOR i FROM 1 TO 10 DO\n{lower}\nENDFOR\nENDWHILE"),
            Some(10),
        ),
        (
            format!("q:=p1;\nFOR i FROM 1 TO 3 DO\nFOR k FROM 1 TO 4 DO\n{lower}\nENDFOR\nENDFOR"),
            Some(12),
        ),
        (
            format!("q:=p1;\nFOR i FROM 1 TO n DO\n{lower}\nENDFOR"),
            None,
        ),
        (format!("q:=p1;\nWHILE a DO\n{lower}\nENDWHILE"), None),
        (
            format!("q:=p1;\nFOR i FROM 1 TO 10 DO\nback:\n{lower}\nIF a GOTO back;\nENDFOR"),
            None,
        ),
        // the loop begins again where it ended
        (
            format!("q:=p1;\nWHILE a DO\nFOR i FROM 1 TO 10 DO\n{lower}\nENDFOR\nENDWHILE"),
            None,
        ),
    ] {
        let all = displaced(&loops);
        let last = grown(down, most);
        assert!(all.contains(&Displacement::None), "{loops}: {all:?}");
        assert!(all.contains(&once) || most.is_none(), "{loops}: {all:?}");
        assert!(all.contains(&last), "{loops}: {all:?}");
        let others = |by: &&Displacement| **by != last && matches!(by, Displacement::Within(_));
        assert!(
            most.is_none() || !all.iter().any(|by| others(&by)),
            "{loops}: {all:?}"
        );
    }
    let whole = displaced("q:=p1;\nWHILE a DO\nMoveL q,v5,z5,t;\nq:=Offs(q,0,0,-20);\nENDWHILE");
    assert!(whole.contains(&grown(down, None)), "{whole:?}");
}

#[test]
fn what_only_the_running_program_knows_is_bounded_by_nothing_where_it_is_added_again() {
    let all = displaced("q:=p1;\nWHILE a DO\nMoveL q,v5,z5,t;\nq.trans.z:=q.trans.z+dz;\nENDWHILE");
    assert!(all.contains(&Displacement::Unbounded), "{all:?}");
    let all = displaced("WHILE a DO\nq:=p1;\nq.trans.z:=q.trans.z+dz;\nMoveL q,v5,z5,t;\nENDWHILE");
    assert_eq!(all, [Displacement::Unknown]);
    // three writes of a camera are one displacement each
    let all = displaced(
        "q:=p1;\nq.trans.x:=q.trans.x+dx;\nIF a Stop;\nq.trans.y:=q.trans.y+dy;\nMoveL q,v5,z5,t;",
    );
    assert_eq!(all, [Displacement::Unknown]);
}

#[test]
fn targets_inside_records_are_named() {
    let program = path("MoveL s.above,v5,z5,t;\nMoveL s.below,v5,z5,t;");
    assert_eq!(ids(&program), ["computed-target"; 2]);
    assert!(said(&program)[0].message.contains("s.above"));
    assert!(said(&program)[1].message.contains("s.below"));
}

#[test]
fn a_position_computed_from_joints_of_the_text_is_not_corrected() {
    let joints = "[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]]";
    for given in ["j", "js{1}", joints] {
        for go in [
            format!("MoveJ CalcRobT({given},t\\WObj:=w),v5,z5,t\\WObj:=w;"),
            format!("q:=CalcRobT({given},t);\nMoveJ q,v5,z5,t;"),
        ] {
            let program = path(&format!(
                "VAR robtarget q;\nCONST jointtarget j:={joints};\nCONST jointtarget \
                 js{{1}}:=[{joints}];\n{go}"
            ));
            assert_eq!(ids(&program), ["computed-target"], "{go}");
        }
    }
    let program = path("VAR jointtarget j;\nj:=CJointT();\nMoveJ CalcRobT(j,t),v5,z5,t;");
    assert_eq!(ids(&program), ["run-time-position"]);
}

#[test]
fn a_seam_tracker_corrects_the_path() {
    let program =
        path("ArcL p1,v5,seam,weld,fine,t\\WObj:=w\\Track:=trk;\nArcL p2,v5,seam,weld,fine,t;");
    assert_eq!(ids(&program), ["corrected-by-sensor"]);
    assert!(said(&program)[0].message.contains("\\Track"));
}

#[test]
fn counters_of_loops_with_a_bound_come_no_farther() {
    let strides = |text: &str| match &path(text).moves[0].displacement {
        Displacement::Within(strides) => strides
            .iter()
            .map(|stride| match stride {
                Stride::By { shift, most } => {
                    ((shift.in_frame.translation[2] * 1e3).round(), *most)
                }
                _ => panic!("it turns nothing"),
            })
            .collect::<Vec<_>>(),
        other => panic!("{other:?}"),
    };
    let go = "MoveL Offs(p1,0,0,h),v5,z5,t;";
    // 0, 20, ... 100
    for condition in ["h<100", "h < 100 AND di1=1", "(100>h)", "h<limit"] {
        let text = format!(
            "CONST num limit:=100;\nVAR num h:=0;\nWHILE {condition} DO\n{go}\nh:=h+20;\nENDWHILE"
        );
        let all = strides(&text);
        assert_eq!(all.len(), 1, "{condition}");
        let (by, most) = all[0];
        assert_eq!(by, 20.0, "{condition}");
        assert!((5..=6).contains(&most.unwrap_or(99)), "{condition}{most:?}");
    }
    // down, and up from below
    let down = format!("VAR num h:=50;\nWHILE h>0 DO\n{go}\nh:=h-10;\nENDWHILE");
    assert!(strides(&down).iter().any(|(by, _)| *by == -10.0));
    for text in [
        format!("VAR num h:=0;\nWHILE h<100 OR di1=1 DO\n{go}\nh:=h+20;\nENDWHILE"),
        format!("VAR num h:=0;\nWHILE h>-1 DO\n{go}\nh:=h+20;\nENDWHILE"),
        format!("VAR num h:=0;\nWHILE h<100 DO\n{go}\nh:=h+20;\nENDWHILE\nh:=h+5;"),
        format!(
            "VAR num h:=0;\nWHILE h<100 DO\nWHILE di1=1 DO\n{go}\nh:=h+20;\nENDWHILE\nENDWHILE"
        ),
        format!("VAR num h:=0;\nGOTO in;\nWHILE h<100 DO\nin:\n{go}\nh:=h+20;\nENDWHILE"),
    ] {
        assert!(
            strides(&text).iter().any(|(_, most)| most.is_none()),
            "{text}"
        );
    }
}

#[test]
fn a_point_that_the_text_displaces_from_where_the_robot_was_stays_with_a_warning() {
    for displaced in [
        "p3:=CRobT();\nMoveL Offs(p3,0,0,50),v5,z5,t;",
        "MoveL Offs(CRobT(),0,0,50),v5,z5,t;",
        "p3:=Offs(CRobT(),0,0,50);\nMoveL p3,v5,z5,t;",
        "p3:=CRobT(\\Tool:=t);\np3.trans.z:=p3.trans.z+100;\nMoveL p3,v5,z5,t;",
    ] {
        let program = path(displaced);
        assert_eq!(ids(&program), ["run-time-position"], "{displaced}");
        assert_eq!(program.findings[0].severity, Severity::Warning);
        assert!(program.findings[0].message.contains("displaced"));
    }
}

#[test]
fn numbers_of_a_call_are_those_of_that_call() {
    let up = |z: f64| Displacement::By(Box::new(Shift::along([0.0, 0.0, z / 1e3])));
    let go = |main: &str, routines: &str| -> Vec<(String, Displacement)> {
        let program = path(&format!("{main}\nENDPROC\n{routines}\nPROC last()"));
        let moves = program.moves.iter().filter(|one| one.target.is_some());
        let named = |one: &crate::program::Move| {
            let target = program.target_of(one).expect("a target");
            target.name.as_deref().unwrap_or_default().to_owned()
        };
        let mut all: Vec<_> = moves
            .map(|one| (named(one), one.displacement.clone()))
            .collect();
        all.sort_by(|(a, _), (b, _)| a.cmp(b));
        all
    };
    let each = [("p1".to_owned(), up(10.0)), ("p2".to_owned(), up(80.0))];
    let near = "PROC pick(robtarget p,num h)\nMoveL Offs(p,0,0,h),v5,z5,t;\nENDPROC\n";
    let by = "PROC by(robtarget p,num n)\npick p,n*2;\nENDPROC\n";
    let kept = "PROC pick(robtarget p,num h)\nVAR robtarget q;\nq:=Offs(p,0,0,h);\nMoveL \
        q,v5,z5,t;\nENDPROC\n";
    let option = "PROC pick(robtarget p\\num h)\nMoveL Offs(p,0,0,h),v5,z5,t;\nENDPROC\n";
    for (main, routines) in [
        ("pick p1,10;\npick p2,80;", near.to_owned()),
        ("pick p1,10;\npick p2,80;", kept.to_owned()),
        ("by p1,5;\nby p2,40;", format!("{by}{near}")),
        ("by p1,5;\npick p2,80;", format!("{by}{near}")),
        ("pick p1\\h:=10;\npick p2\\h:=80;", option.to_owned()),
    ] {
        assert_eq!(go(main, &routines), each, "{main}\n{routines}");
    }
    // what the routine writes itself is as all calls have it
    let own = near.replace("MoveL", "h:=h+1;\nMoveL");
    let found = go("pick p1,10;\npick p2,80;", &own);
    assert!(
        found
            .iter()
            .all(|(_, by)| !matches!(by, Displacement::By(_)))
    );
}

#[test]
fn members_of_records_take_the_correction_of_the_targets_behind_them_along() {
    let records = "RECORD rec\nrobtarget at;\nrobtarget above;\nnum z;\nENDRECORD\n";
    let of = |statements: &str| {
        let text = format!(
            "{statements}\nENDPROC\nFUNC rec both(robtarget p)\nVAR rec v;\nv.at:=p;\n\
             v.above:=Offs(p,0,0,40);\nRETURN v;\nENDFUNC\nPROC last()"
        );
        read(&format!(
            "MODULE m\n{records}CONST robtarget p1:=[[1,2,3],[1,0,0,0],CONF;\n\
             PERS tooldata t:=[TRUE,[[0,0,100],[1,0,0,0]],[1.5,[0,0,50],[1,0,0,0],0,0,0]];\n\
             VAR rec a;\nVAR rec many{{3}};\nPROC main()\n{text}\nENDPROC\nENDMODULE\n"
        ))
    };
    let by = |program: &Program| -> Vec<Displacement> {
        let moves = program.moves.iter();
        moves.map(|m| m.displacement.clone()).collect()
    };
    // a copy, whatever else is in the record
    for write in [
        "a.at:=p1;\na.above:=Offs(a.at,0,0,40);\na.z:=p1.trans.z;\nMoveL a.at,v5,z5,t;",
        "many{2}.at:=p1;\nMoveL many{i} . At,v5,z5,t;",
    ] {
        let program = of(write);
        assert_eq!(
            (to(&program), by(&program)),
            (vec!["p1"], vec![Displacement::None]),
            "{write}"
        );
        assert!(!ids(&program).contains(&"computed-target"), "{write}");
    }
    for write in [
        "a.at:=p1;\na.above:=Offs(a.at,0,0,40);\nMoveL a.above,v5,z5,t;",
        "VAR rec b;\nb.at:=p1;\na:=b;\nMoveL a.at,v5,z5,t;",
        "a:=both(p1);\nMoveL a.above,v5,z5,t;",
        "VAR robtarget q;\na.at:=p1;\nq:=a.at;\nMoveL q,v5,z5,t;",
        "a.at:=p1;\nMoveL Offs(a.at,0,0,40),v5,z5,t;",
        "a.z:=p1.trans.z;\nMoveL [[1,2,a.z],[1,0,0,0],CONF,v5,z5,t;",
    ] {
        let all = by(&of(write));
        assert!(all.contains(&Displacement::Unbounded), "{write}: {all:?}");
    }
    // a record by reference, and one that a routine fills
    for statements in [
        "MoveL p1,v5,z5,t;\na.at:=p1;\nlift a,150;\nENDPROC\nPROC lift(INOUT rec s,num h)\n\
         s.at.trans.z:=s.at.trans.z+h;\nMoveL s.at,v5,z5,t;",
        "MoveL p1,v5,z5,t;\nfill a,p1;\nMoveL a.at,v5,z5,t;\nENDPROC\nPROC fill(INOUT rec s,robtarget q)\n\
         s.at:=Offs(q,-150,0,0);",
        "MoveL p1,v5,z5,t;\nfill a,p1;\nMoveL a.at,v5,z5,t;\nENDPROC\nPROC fill(INOUT rec s,robtarget q)\n\
         s.at:=q;",
    ] {
        let all = by(&of(statements));
        assert!(
            all.contains(&Displacement::Unbounded),
            "{statements}: {all:?}"
        );
    }
    let all = by(&of("a.at:=p1;\na.at.trans.y:=-200;\nMoveL a.at,v5,z5,t;"));
    assert!(all.contains(&Displacement::Overwritten), "{all:?}");
    // nothing of a target flows into these
    for write in [
        "a.at:=[[1,2,h],[1,0,0,0],CONF;\nMoveL a.at,v5,z5,t;",
        "a.above:=p1;\nMoveL a.at,v5,z5,t;",
    ] {
        let program = of(write);
        assert_eq!(
            (to(&program), ids(&program)),
            (vec!["?"], vec!["computed-target"]),
            "{write}"
        );
    }
}

#[test]
fn what_is_displaced_from_where_the_robot_stopped_is_next_to_the_target_there() {
    const READ: &str = "CRobT(\\Tool:=t\\WObj:=wobj0)";
    let along = |by| Displacement::By(Box::new(Shift::along(by)));
    for (go, by) in [
        (
            format!("MoveL Offs({READ},0,0,50),v5,fine,t;"),
            [0.0, 0.0, 0.05],
        ),
        (
            format!("q:={READ};\nMoveL Offs(q,0,0,50),v5,fine,t;"),
            [0.0, 0.0, 0.05],
        ),
        (
            format!("q:=Offs({READ},0,0,50);\nMoveL q,v5,fine,t;"),
            [0.0, 0.0, 0.05],
        ),
        (
            format!("MoveL Offs(p1,5,0,0),v5,fine,t;\nMoveL Offs({READ},0,0,50),v5,fine,t;"),
            [0.005, 0.0, 0.05],
        ),
    ] {
        let program = path(&format!("VAR robtarget q;\nMoveL p1,v5,fine,t;\n{go}"));
        assert_eq!(ids(&program), [""; 0], "{go}");
        let last = program.moves.last().expect("a move");
        assert_eq!(last.displacement, along(by), "{go}");
    }
    // elsewhere than at p1, displaced twice, in a corner, with another tool, where a routine led it
    for go in [
        format!("WHILE a DO\nMoveL Offs({READ},0,0,50),v5,fine,t;\nENDWHILE"),
        format!("q:=Offs({READ},0,0,50);\nq:=Offs(q,0,0,50);\nMoveL q,v5,fine,t;"),
        format!("MoveL p1,v5,z5,t;\nMoveL Offs({READ},0,0,50),v5,fine,t;"),
        format!("elsewhere;\nMoveL Offs({READ},0,0,50),v5,fine,t;"),
    ] {
        let program = path(&format!("VAR robtarget q;\nMoveL p1,v5,fine,t;\n{go}"));
        assert!(
            ids(&program).contains(&"run-time-position"),
            "{go}: {:?}",
            ids(&program)
        );
    }
}

//! Which tool and base hold at a move.

use super::*;

pub(super) const CONFIG: &str = "&ACCESS RV\n&REL 2\nDEFDAT  $CONFIG\nBOOL B_IN\nDECL E6AXIS XHOME={A1 0,A2 \
    -90,A3 90,A4 0,A5 0,A6 0}\n\
    FRAME TOOL_DATA[16]\nTOOL_DATA[1]={X 100.0,Y 0.0,Z 0.0,A 0.0,B 0.0,C 0.0}\nTOOL_DATA[2]={x 0,y \
        0,z 50,a 0,b 90,c 0}\n\
    FRAME BASE_DATA[32]\nBASE_DATA[1]={X 0.0,Y 0.0,Z 0.0,A 0.0,B 0.0,C 0.0}\nBASE_DATA[2]={X \
        500.0,Y 0.0,Z 0.0,A 90.0,B 0.0,C 0.0}\n\
    LOAD_DATA[1]={M 5.5,CM {X 10.0,Y 0.0,Z 80.0,A 0.0,B 0.0,C 0.0},J {X 0.0,Y 0.0,Z 0.0}}\n\
    LOAD_DATA[2]={M -1.0,CM {X 0.0,Y 0.0,Z 0.0,A 0.0,B 0.0,C 0.0},J {X 0.0,Y 0.0,Z 0.0}}\n\
    DECL MACHINE_FRAME_DATA_TYPE x\nMACHINE_FRAME_DAT[7]={MACH_DEF_INDEX 2,COOP_KRC_INDEX 0,PARENT[] \" \",GEO \" \"}\nENDDAT\n";

pub(super) fn in_cell(statements: &str) -> Program {
    let text = format!("DEF M()\n{statements}\nEND\n");
    read_files(&[
        ("System/$config.dat", CONFIG),
        ("m.src", &text),
        ("m.dat", DATA),
    ])
}

pub(super) fn used(program: &Program) -> Vec<(&str, &str)> {
    let moves = program.moves.iter();
    moves
        .map(|used| {
            (
                program.tools[used.tool].name.as_str(),
                program.frames[used.frame].name.as_str(),
            )
        })
        .collect()
}

#[test]
fn tools_bases_and_loads_are_in_the_config_given_with_the_program() {
    let program = in_cell("BAS(#TOOL,1)\nBAS (#BASE,2)\nLIN XP1");
    assert_eq!(used(&program), [("TOOL_DATA[1]", "BASE_DATA[2]")]);
    let Tool {
        flange_from_tool,
        load,
        ..
    } = &program.tools[0];
    assert_eq!(
        flange_from_tool.expect("a tool").translation,
        [0.1, 0.0, 0.0]
    );
    let load = load.expect("a load");
    assert_eq!((load.mass_kg, load.cog_m), (5.5, [0.01, 0.0, 0.08]));
    let base = program.frames[0].world_from_frame.expect("a base");
    assert_eq!(base.translation, [0.5, 0.0, 0.0]);
    assert!((base.rotation.0[1][0] - 1.0).abs() < 1e-12);
    assert_eq!(reported(&program), [""; 0]);
}

#[test]
fn entries_without_the_config_are_asked_for_by_name() {
    let program = path("LIN XP1");
    assert_eq!(used(&program), [("TOOL_DATA[1]", "BASE_DATA[2]")]);
    assert_eq!(program.tools[0].flange_from_tool, None);
    assert_eq!(program.frames[0].world_from_frame, None);
    let program = read("DEF M()\nLIN {X 1,Y 2,Z 3,A 0,B 0,C 0}\nEND");
    assert_eq!(used(&program), [("$TOOL", "$BASE")]);
    assert_eq!(program.tools[0].flange_from_tool, None);
}

#[test]
fn every_way_to_set_tool_and_base_is_understood() {
    for set in [
        "$TOOL=TOOL_DATA[2]\n$BASE=BASE_DATA[2]",
        "$tool = tool_data[2] ; the gun\n$Base = Base_Data[2]",
        "FDAT_ACT={TOOL_NO 2,BASE_NO 2,IPO_FRAME #BASE,POINT2[] \" \"}\nBAS(#FRAMES)",
        "PDAT_ACT=PPDAT1\nFDAT_ACT=FP9\nBAS(#PTP_PARAMS,100)",
        "FDAT_ACT=FP9\nBAS(#CP_PARAMS,2)",
    ] {
        let data = "DEFDAT M\nDECL E6POS XP1={X 1,Y 2,Z 3,A 0,B 0,C 0}\n\
            DECL FDAT FP9={TOOL_NO 2,BASE_NO 2,IPO_FRAME #BASE,POINT2[] \" \",TQ_STATE \
                FALSE}\nENDDAT\n";
        let text = format!("DEF M()\n{set}\nLIN XP1\nEND\n");
        let files = [("$config.dat", CONFIG), ("m.src", &text), ("m.dat", data)];
        let program = read_files(&files);
        assert_eq!(used(&program), [("TOOL_DATA[2]", "BASE_DATA[2]")], "{set}");
        assert!(program.tools[0].flange_from_tool.is_some());
        assert_eq!(ids(&program), [""; 0], "{set}");
    }
}

#[test]
fn inline_forms_of_newer_controllers_set_tool_and_base_in_the_move() {
    let program = in_cell(
        ";FOLD SLIN P1 Vel=2 m/s CPDAT1 Tool[1]:gun Base[2] ;%{PE}\n;FOLD Parameters ;%{h}\n\
         ;Params IlfProvider=kukaroboter.basistech.inlineforms.movement.spline; \
             Kuka.PointName=P1\n;ENDFOLD\n\
         SLIN XP1 WITH $VEL=SVEL_CP(2.0, , LCPDAT1), $TOOL=STOOL2(FP1), $BASE=SBASE(FP1.BASE_NO), \
         $IPO_MODE=SIPO_MODE(FP1.IPO_FRAME), $LOAD=SLOAD(FP1.TOOL_NO), $ACC=SACC_CP(LCPDAT1) \
             C_Spl\n;ENDFOLD",
    );
    assert_eq!(used(&program), [("TOOL_DATA[1]", "BASE_DATA[2]")]);
    assert_eq!(reported(&program), [""; 0]);
}

#[test]
fn spline_blocks_and_functions_leave_the_fdat_that_they_are_given() {
    for text in [
        "SPLINE WITH $VEL=SVEL_CP(2.0, , LCPDAT1), $TOOL=STOOL2(FP1), $BASE=SBASE(FP1.BASE_NO), \
         $IPO_MODE=SIPO_MODE(FP1.IPO_FRAME), $LOAD=SLOAD(FP1.TOOL_NO)\nSPL XP1\nENDSPLINE",
        "PTP_SPLINE WITH $TOOL=STOOL2(FP1), $BASE=SBASE(FP1.BASE_NO)\nSPTP XP1\nENDSPLINE",
        "$TOOL=STOOL2(FP1)\n$BASE=SBASE(FP1.BASE_NO)\nLIN XP1",
    ] {
        let program = in_cell(text);
        assert_eq!(used(&program), [("TOOL_DATA[1]", "BASE_DATA[2]")], "{text}");
        assert_eq!(reported(&program), [""; 0], "{text}");
    }
}

#[test]
fn frames_written_out_have_their_value() {
    let program = in_cell(
        "$TOOL={FRAME: X 1,Y 2,Z 3,A 0,B 0,C 90}\n$BASE={X 0,Y 0,Z 0,A 0,B 0,C 0}\nLIN \
         XP1\n$TOOL=$NULLFRAME\n$BASE=$WORLD\nLIN XP2\n\
         BAS(#TOOL,0)\nBAS(#BASE)\nLIN XP3",
    );
    assert_eq!(
        used(&program),
        [
            ("$TOOL", "$BASE"),
            ("$NULLFRAME", "$WORLD"),
            ("TOOL_DATA[0]", "BASE_DATA[0]")
        ]
    );
    let tool = program.tools[0].flange_from_tool.expect("a tool");
    assert_eq!(tool.translation, [0.001, 0.002, 0.003]);
    // C rotates about x
    assert!((tool.rotation.0[2][1] - 1.0).abs() < 1e-12);
    assert!(program.tools[2].flange_from_tool.is_some());
    assert_eq!(reported(&program), [""; 0]);
}

fn translations(program: &Program) -> Vec<Option<f64>> {
    let moves = program.moves.iter();
    moves
        .map(|used| Some(program.frames[used.frame].world_from_frame?.translation[0]))
        .collect()
}

#[test]
fn entries_that_the_program_writes_have_that_value_from_there_on() {
    let use_it = "BAS(#TOOL,1)\nBAS(#BASE,2)\nLIN XP1";
    let program = path(&format!(
        "TOOL_DATA[1]={{X 0,Y 0,Z 120,A 0,B 0,C 0}}\nBASE_DATA[2]={{FRAME: X 1,Y 0,Z 0,A 0,B 0,C \
         0}}\n{use_it}"
    ));
    let tool = program.tools[0].flange_from_tool.expect("a tool");
    assert_eq!(tool.translation, [0.0, 0.0, 0.12]);
    assert_eq!(translations(&program), [Some(0.001)]);
    assert_eq!(reported(&program), [""; 0]);
    for (change, x) in [
        ("BASE_DATA[2]={X 9,Y 0,Z 0,A 0,B 0,C 0}", Some(0.009)),
        ("BASE_DATA[2].X=-5.0", Some(-0.005)),
        // asked for by name
        ("BASE_DATA[2]=BASE_DATA[1]", None),
    ] {
        let program = path(&format!(
            "BASE_DATA[2]={{X 1,Y 0,Z 0,A 0,B 0,C 0}}\n{change}\n{use_it}"
        ));
        assert_eq!(reported(&program), [""; 0], "{change}");
        assert_eq!(translations(&program), [x], "{change}");
    }
    for change in [
        "BASE_DATA[2].X=BASE_DATA[2].X+1",
        "BASE_DATA[i]=measured()",
        "BASE_DATA[2]=BASE_DATA[1]:shift",
    ] {
        let program = path(&format!(
            "BASE_DATA[2]={{X 1,Y 0,Z 0,A 0,B 0,C 0}}\n{change}\n{use_it}"
        ));
        assert_eq!(
            reported(&program),
            ["frame-assigned-at-run-time"],
            "{change}"
        );
        assert_eq!(blocked(&program), ["XP1"], "{change}");
    }
}

#[test]
fn entries_that_are_written_here_and_there_have_several_values() {
    let write = "BASE_DATA[2]={X 7,Y 0,Z 0,A 0,B 0,C 0}";
    let both = [Some(0.5), Some(0.007)];
    for (text, expected) in [
        (
            format!("IF $IN[1] THEN\n{write}\nENDIF\nBAS(#BASE,2)\nLIN XP1"),
            &both[..],
        ),
        // data lists are kept from run to run
        (format!("BAS(#BASE,2)\nLIN XP1\n{write}"), &both[..]),
        (format!("{write}\nBAS(#BASE,2)\nLIN XP1"), &both[1..]),
        (
            format!("BAS(#BASE,2)\nLIN XP1\nEND\nDEF never()\n{write}"),
            &both[..1],
        ),
    ] {
        let program = in_cell(&format!("BAS(#TOOL,1)\n{text}"));
        assert_eq!(translations(&program), expected, "{text}");
        let is_unseen = text.contains("never");
        let expected: &[&str] = if is_unseen {
            &["write-not-called"]
        } else {
            &[]
        };
        assert_eq!(reported(&program), expected, "{text}");
        let written = program.moves.iter().filter(|m| m.frame_written.is_some());
        assert_eq!(
            written.count() > 0,
            !is_unseen || text.contains("BAS"),
            "{text}"
        );
    }
}

#[test]
fn frames_that_only_the_running_program_knows_are_refused() {
    for set in [
        "$BASE=measured()",
        "$BASE=BASE_DATA[n]",
        "BAS(#BASE,n)",
        "$BASE=BASE_DATA[1]:shift",
        "$BASE.X=shift.X",
        "$TOOL=tools[1]",
    ] {
        let program = in_cell(&format!(
            "DECL FRAME tools[2]\nDECL FRAME shift\nBAS(#TOOL,1)\nBAS(#BASE,1)\n{set}\nLIN XP1"
        ));
        assert!(
            reported(&program).iter().any(|id| id.starts_with("frame-")),
            "{set}: {:?}",
            program.findings
        );
        assert!(blocked(&program).contains(&"XP1"), "{set}");
    }
    let program = in_cell("BAS(#TOOL,1)\nBAS(#BASE,1)\n$BASE.X=100\nLIN XP1");
    assert_eq!(translations(&program), [Some(0.1)]);
}

#[test]
fn a_base_displaced_by_numbers_is_known() {
    let set = "BAS(#TOOL,1)\n$BASE=BASE_DATA[2]:{X 10,Y 0,Z 0,A 0,B 0,C 0}\nLIN XP1";
    let program = in_cell(set);
    assert_eq!(reported(&program), [""; 0]);
    let base = program.frames[program.moves[0].frame].world_from_frame;
    let base = base.expect("a base");
    // BASE_DATA[2] is turned by a right angle about z
    let found = base.translation;
    for (found, wanted) in found.into_iter().zip([0.5, 0.01, 0.0]) {
        assert!((found - wanted).abs() < 1e-12, "{base:?}");
    }
    assert!((base.rotation.0[1][0] - 1.0).abs() < 1e-12);
    // not on a kinematic; where the program writes some entry it is one of two
    let other = set.replace("[2]", "[7]");
    assert_eq!(blocked(&in_cell(&other)), ["XP1"], "{other}");
    let program = in_cell(&format!("BASE_DATA[i].X=5\n{set}"));
    let x_mm = |motion: &crate::program::Move| -> f64 {
        let base = program.frames[motion.frame].world_from_frame;
        (1e3 * base.expect("it is known").translation[0]).round()
    };
    let mut all: Vec<f64> = program.moves.iter().map(x_mm).collect();
    all.sort_by(f64::total_cmp);
    assert_eq!(all, [5.0, 500.0]);
}

#[test]
fn frames_of_branches_are_several() {
    for set in [
        "IF $IN[1] THEN\nBAS(#BASE,2)\nENDIF",
        "WHILE $IN[1]\nLIN XP2\nBAS(#BASE,2)\nENDWHILE",
        "SWITCH n\nCASE 1\nBAS(#BASE,2)\nDEFAULT\nBAS(#BASE,1)\nENDSWITCH",
    ] {
        let program = in_cell(&format!("BAS(#TOOL,1)\nBAS(#BASE,1)\n{set}\nLIN XP1"));
        let mut found: Vec<_> = used(&program).into_iter().map(|(_, base)| base).collect();
        found = found.split_off(found.len() - 2);
        found.sort_unstable();
        assert_eq!(found, ["BASE_DATA[1]", "BASE_DATA[2]"], "{set}");
        assert_eq!(reported(&program), [""; 0], "{set}");
    }
}

#[test]
fn numbers_of_the_program_choose_tools_and_bases() {
    for text in [
        "DECL INT n\nn=2\nBAS(#BASE,n)\nLIN XP1",
        "DECL INT n\nn=2\n$BASE=BASE_DATA[n]\nLIN XP1",
        "BAS(#BASE,2)\n$BASE=$NULLFRAME\n$BASE=BASE_DATA[$ACT_BASE]\nLIN XP1",
        "FDAT_ACT=FP1\n$BASE=BASE_DATA[FDAT_ACT.BASE_NO]\nLIN XP1",
        "choose(2)\nLIN XP1\nEND\nDEF choose(k:IN)\nDECL INT k\nBAS(#BASE,k)",
    ] {
        let program = in_cell(&format!("BAS(#TOOL,1)\n{text}"));
        assert_eq!(used(&program), [("TOOL_DATA[1]", "BASE_DATA[2]")], "{text}");
        assert_eq!(reported(&program), [""; 0], "{text}");
    }
}

#[test]
fn a_tool_that_is_written_out_keeps_the_load() {
    let tool = "$TOOL={X 0,Y 0,Z 150,A 0,B 0,C 0}";
    for text in [
        format!("BAS(#TOOL,1)\n{tool}"),
        format!("$LOAD=LOAD_DATA[1]\n{tool}"),
        format!("{tool}\n$LOAD={{M 5.5,CM {{X 10,Y 0,Z 80,A 0,B 0,C 0}},J {{X 0,Y 0,Z 0}}}}"),
        format!("BAS(#TOOL,1)\nsub()\n{tool}"),
    ] {
        let program = in_cell(&format!(
            "BAS(#BASE,1)\n{text}\nLIN XP1\nEND\nDEF sub()\n$VEL.CP=1"
        ));
        let used = &program.tools[program.moves[0].tool];
        assert_eq!(
            used.flange_from_tool.map(|tool| tool.translation[2]),
            Some(0.15),
            "{text}"
        );
        assert_eq!(used.load.map(|load| load.mass_kg), Some(5.5), "{text}");
    }
    let program = in_cell("BAS(#BASE,1)\nBAS(#TOOL,2)\n$TOOL=TOOL_DATA[1]\nLIN XP1");
    let load = program.tools[program.moves[0].tool].load;
    assert_eq!(load.map(|load| load.mass_kg), Some(5.5));
}

#[test]
fn ways_that_agree_are_followed() {
    for set in [
        "IF $IN[1] THEN\nBAS(#BASE,1)\nELSE\nBAS(#BASE,1)\nENDIF",
        "SWITCH n\nCASE 1,2\nLIN XP2\nBAS(#BASE,1)\nDEFAULT\nBAS(#BASE,1)\nENDSWITCH",
        "LOOP\nBAS(#BASE,1)\nEXIT\nENDLOOP",
        "REPEAT\nBAS(#BASE,1)\nUNTIL $IN[1]",
        "sub()",
        "GOTO over\nBAS(#BASE,2)\nover:\nBAS(#BASE,1)",
        "ptp_home()\nBAS(#BASE,1)",
    ] {
        let text = format!(
            "DEF M()\nBAS(#TOOL,1)\nBAS(#BASE,1)\n{set}\nLIN XP1\nEND\nDEF \
             sub()\nBAS(#BASE,1)\nEND\n"
        );
        let program = read_files(&[("$config.dat", CONFIG), ("m.src", &text), ("m.dat", DATA)]);
        assert_eq!(reported(&program), [""; 0], "{set}");
        assert!(
            used(&program)
                .iter()
                .all(|names| *names == ("TOOL_DATA[1]", "BASE_DATA[1]"))
        );
    }
}

#[test]
fn routines_take_what_their_callers_have() {
    let text = "DEF M()\nBAS(#TOOL,1)\nBAS(#BASE,2)\nsub()\nEND\nDEF sub()\nLIN {X 1,Y 2,Z 3,A 0,B \
        0,C 0}\nEND\n";
    assert_eq!(used(&read(text)), [("TOOL_DATA[1]", "BASE_DATA[2]")]);
    let text = "DEF M()\nBAS(#TOOL,1)\nBAS(#BASE,2)\nsub()\nBAS(#BASE,3)\nsub()\nEND\nDEF \
        sub()\nLIN {X 1,Y 2,Z 3,A 0,B 0,C 0}\nEND\n";
    let program = read(text);
    let bases: Vec<_> = used(&program).into_iter().map(|(_, base)| base).collect();
    assert_eq!(bases, ["BASE_DATA[2]", "BASE_DATA[3]"]);
    assert_eq!(reported(&program), [""; 0]);
}

#[test]
fn routines_outside_the_files_matter_where_several_frames_are_in_use() {
    let one =
        "DEF M()\nBAS(#TOOL,1)\nBAS(#BASE,1)\ngripper(1)\nLIN {X 1,Y 2,Z 3,A 0,B 0,C 0}\nEND\n";
    assert_eq!(reported(&read(one)), [""; 0]);
    let two = "DEF M()\nBAS(#TOOL,1)\nBAS(#BASE,1)\nLIN {X 1,Y 2,Z 3,A 0,B 0,C \
        0}\nBAS(#BASE,2)\ngripper(1)\nLIN {X 1,Y 2,Z 3,A 0,B 0,C 0}\nEND\n";
    assert_eq!(reported(&read(two)), ["frame-chosen-at-run-time"]);
}

#[test]
fn fixed_tools_are_refused_by_name() {
    for set in [
        "$IPO_MODE=#TCP",
        "FDAT_ACT={TOOL_NO 1,BASE_NO 2,IPO_FRAME #TCP,POINT2[] \" \"}\nBAS(#FRAMES)",
    ] {
        let program = in_cell(&format!("BAS(#TOOL,1)\nBAS(#BASE,2)\n{set}\nLIN XP1"));
        assert_eq!(reported(&program), ["held-work-piece"], "{set}");
        assert_eq!(blocked(&program), ["XP1"]);
    }
    let program = in_cell("BAS(#TOOL,1)\nBAS(#BASE,2)\n$IPO_MODE=#TCP\n$IPO_MODE=#BASE\nLIN XP1");
    assert_eq!(reported(&program), [""; 0]);
}

#[test]
fn bases_on_other_kinematics_are_refused() {
    for set in [
        "BAS(#BASE,7)",
        "$BASE=EK(MACHINE_DEF[2].ROOT,MACHINE_DEF[3].MECH_TYPE,{X 0,Y 0,Z 0,A 0,B 0,C 0})",
        "SLIN XP1 WITH $BASE=EK(K_ROOT(FP1.BASE_NO),K_TYPE(FP1.BASE_NO),K_OFFS(FP1.BASE_NO)), \
         $APO=SAPO(L) C_SPL",
    ] {
        let program = in_cell(&format!("BAS(#TOOL,1)\nBAS(#BASE,1)\n{set}\nLIN XP1"));
        assert_eq!(reported(&program), ["moving-frame"], "{set}");
        assert_eq!(blocked(&program), ["XP1"], "{set}");
    }
}

#[test]
fn bases_on_a_kinematic_are_those_of_the_unit() {
    let program = in_cell(
        "BAS(#TOOL,1)\n$BASE=EK(MACHINE_DEF[2].ROOT,MACHINE_DEF[2].MECH_TYPE,{X 30,Y 0,Z 0,A 0,B \
         0,C 0})\nLIN XP1",
    );
    let frame = &program.frames[program.moves[0].frame];
    assert!(frame.is_carried());
    assert_eq!(frame.on[1], "2".into());
    assert_eq!(
        frame.world_from_frame.map(|pose| pose.translation[0]),
        Some(0.03)
    );
}

#[test]
fn what_one_of_several_programs_writes_reaches_no_other() {
    let writes = "DEF a()\nBASE_DATA[2]={X 9,Y 0.0,Z 0,A 90,B 0,C \
        -0.0}\nBAS(#TOOL,1)\nBAS(#BASE,2)\nLIN {X 1,Y 2,Z 3,A 0,B 0,C 0}\nEND\n";
    let other = "DEF b()\nBAS(#TOOL,1)\nBAS(#BASE,2)\nLIN {X 1,Y 2,Z 3,A 0,B 0,C 0}\nEND\n";
    for (others, expected, ids) in [
        (
            other,
            vec![Some(0.009), Some(0.5)],
            vec!["write-not-called"],
        ),
        ("DEF b()\nEND\n", vec![Some(0.009)], vec![]),
    ] {
        let files = [
            ("$config.dat", CONFIG),
            ("a.src", writes),
            ("b.src", others),
        ];
        let program = read_files(&files);
        assert_eq!(translations(&program), expected);
        assert_eq!(reported(&program), ids);
    }
}

#[test]
fn two_configs_that_disagree_are_refused() {
    let other = CONFIG.replace("X 500.0", "X 501.0");
    let text = "DEF M()\nBAS(#TOOL,1)\nBAS(#BASE,2)\nLIN {X 1,Y 2,Z 3,A 0,B 0,C 0}\nEND\n";
    let files = [
        ("a/$config.dat", CONFIG),
        ("b/$config.dat", &*other),
        ("m.src", text),
    ];
    assert_eq!(reported(&read_files(&files)), ["frame-name-ambiguous"]);
}

#[test]
fn a_target_that_is_a_base_too_is_refused() {
    let program = in_cell("BAS(#TOOL,1)\n$BASE=XP3\nLIN XP1\nBAS(#BASE,1)\nLIN XP3");
    assert_eq!(blocked(&program), ["XP3"]);
    assert_eq!(reported(&program), ["target-used-as-frame"]);
}

#[test]
fn numbers_that_choose_are_followed_through_parameters_of_other_names() {
    let tools = |text: &str| {
        let program = path(text);
        let tools = program.moves.iter().map(|used| used.tool);
        let mut names: Vec<_> = tools.map(|at| program.tools[at].name.clone()).collect();
        names.sort_unstable();
        (names, reported(&program).join(" "))
    };
    let set = "DEF setn(q:OUT)\nINT q\nq=2";
    let get = "DEFFCT BOOL setn(q:OUT)\nINT q\nq=2\nRETURN TRUE\nENDFCT\nDEF z()";
    for (call, routine) in [
        ("setn(n)", set),
        ("IF setn(n)==TRUE THEN\nHALT\nENDIF", get),
    ] {
        let text = format!("DECL INT n\nn=1\n{call}\n$TOOL=TOOL_DATA[n]\nLIN XP1\nEND\n{routine}");
        let (names, ids) = tools(&text);
        assert_eq!((names, &*ids), (vec!["TOOL_DATA[2]".into()], ""), "{call}");
    }
    // the other direction: what is given chooses in the routine
    let (names, ids) =
        tools("DECL INT k\nk=3\nuse(k)\nEND\nDEF use(t:IN)\nINT t\n$TOOL=TOOL_DATA[t]\nLIN XP1");
    assert_eq!((names, &*ids), (vec!["TOOL_DATA[3]".into()], ""));
}

#[test]
fn a_kept_orientation_is_refused_where_the_target_has_another() {
    let points = "PTP {X 1,Y 2,Z 3,A 0,B 90,C 0,S 2,T 2}\n";
    let (same, other) = (
        "LIN {X 9,Y 2,Z 3,A 0,B 90,C 0}",
        "LIN {X 9,Y 2,Z 3,A 10,B 90,C 0}",
    );
    let keeps = "$ORI_TYPE=#CONSTANT";
    let kept: &[&str] = &["orientation-kept"];
    for (text, expected) in [
        (
            format!("{keeps}\n{points}{same}"),
            &["orientation-not-corrected"][..],
        ),
        (format!("{keeps}\n{points}{other}"), kept),
        (format!("{points}{other}"), &[]),
        (format!("{keeps}\n{points}$ORI_TYPE=#VAR\n{other}"), &[]),
        (
            format!("{keeps}\nBAS(#INITMOV,0)\nBAS(#TOOL,1)\nBAS(#BASE,2)\n{points}{other}"),
            &[],
        ),
        (format!("{points}S{other} WITH {keeps}"), kept),
        (
            format!("{keeps}\n{points}S{other} WITH $ORI_TYPE=#VAR"),
            &[],
        ),
        // where the move starts is not known
        (
            format!("{keeps}\n{points}IF $IN[1] THEN\nPTP XHOME\nENDIF\n{same}"),
            kept,
        ),
        // the inline form
        (
            format!(
                "LDAT_ACT=LCPDAT1\nFDAT_ACT=FP1\nBAS(#CP_PARAMS,2)\nBAS(#TOOL,1)\nBAS(#BASE,2)\nPTP XP1\n{other}"
            ),
            kept,
        ),
        (
            format!("$ORI_TYPE=SORI_TYP(LCPDAT1)\n{points}{other}"),
            kept,
        ),
        (format!("$ORI_TYPE=SORI_TYP(LCPDAT2)\n{points}{other}"), &[]),
    ] {
        let text = format!("DEF M()\nBAS(#INITMOV,0)\nBAS(#TOOL,1)\nBAS(#BASE,2)\n{text}\nEND\n");
        let data = "DEFDAT M\nDECL LDAT LCPDAT1={VEL 2.0,ACC 100.0,APO_DIST 100.0,APO_FAC 50.0,ORI_TYP \
            #CONSTANT}\nDECL LDAT LCPDAT2={VEL 2.0,ACC 100.0,APO_DIST 100.0,APO_FAC 50.0,ORI_TYP #VAR}\n\
            DECL FDAT FP1={TOOL_NO 1,BASE_NO 2,IPO_FRAME #BASE,POINT2[] \" \"}\n\
            DECL E6AXIS XHOME={A1 0.0,A2 -90.0,A3 90.0,A4 0.0,A5 0.0,A6 0.0,E1 0.0}\n\
            DECL E6POS XP1={X 1,Y 2,Z 3,A 0,B 90,C 0,S 2,T 2}\nENDDAT\n";
        let program = read_files(&[("m.src", &text), ("m.dat", data)]);
        assert_eq!(reported(&program), expected, "{text}");
    }
}

#[test]
fn a_base_that_is_computed_from_a_copy_is_no_computed_target() {
    for (declared, given) in [("F", "$BASE=F"), ("F", "BASE_DATA[3]=F\nBAS(#BASE,3)")] {
        let program = path(&format!(
            "DECL FRAME {declared}\n{declared}=BASE_DATA[1]\n{declared}.Z={declared}.Z+30\n{given}\nLIN XP1"
        ));
        let found = reported(&program);
        assert!(
            found.contains(&"frame-chosen-at-run-time"),
            "{given}: {found:?}"
        );
        assert!(!found.contains(&"computed-target"), "{given}: {found:?}");
    }
}

#[test]
fn commands_of_bas_that_set_a_base_are_not_passed_over() {
    let program = path("BAS(#EX_BASE,1)\nLIN XP1");
    assert_eq!(reported(&program), ["moving-frame"]);
    let program = path("BAS(#FOO,1)\nLIN XP1");
    assert_eq!(reported(&program), ["frame-chosen-at-run-time"]);
    for command in [
        "ACC_CP,20",
        "VEL_PTP,100",
        "PTP_DAT",
        "CP_DAT",
        "OUT_SYNC,2",
        "GROUP,1",
    ] {
        let program = path(&format!("BAS(#{command})\nLIN XP1"));
        assert_eq!(reported(&program), [""; 0], "{command}");
    }
}

#[test]
fn a_move_to_which_a_trigger_counts_is_not_repeated() {
    for (before, may_be_repeated) in [
        ("TRIGGER WHEN DISTANCE=1 DELAY=0 DO $OUT[67]=TRUE", false),
        (
            "TRIGGER WHEN DISTANCE=1 DELAY=0 DO $OUT[67]=TRUE\n;comment\nWAIT SEC 0",
            false,
        ),
        ("TRIGGER WHEN PATH=-50 DELAY=0 DO $OUT[67]=TRUE", false),
        ("STOP WHEN PATH=-50 IF $IN[1]", false),
        ("CONST_VEL END=0", false),
        ("TRIGGER WHEN DISTANCE=0 DELAY=0 DO $OUT[67]=TRUE", true),
        ("$OUT[67]=TRUE", true),
        (
            "TRIGGER WHEN DISTANCE=1 DELAY=0 DO $OUT[67]=TRUE\nLIN XP2",
            true,
        ),
    ] {
        let program = path(&format!("{before}\nLIN XP1"));
        let used = program.moves.last().expect("a move");
        let span = program.instructions[used.instruction as usize].target_span;
        assert_eq!(span.range().is_some(), may_be_repeated, "{before}");
    }
}

#[test]
fn data_that_are_not_in_the_files_are_asked_for_by_name_and_file() {
    for set in [
        "FDAT_ACT=FHOME\nBAS(#PTP_PARAMS,100)",
        "$TOOL=STOOL2(FHOME)\n$BASE=SBASE(FHOME.BASE_NO)",
    ] {
        let program = in_cell(&format!("{set}\nPTP XP1"));
        let id = "frame-chosen-at-run-time";
        let found = program.findings.iter().find(|found| found.id == id);
        let found = found.expect(set);
        assert!(
            found.message.contains("FHOME is not in the files"),
            "{found:?}"
        );
        for part in ["--with", "$config.dat", ".dat"] {
            assert!(found.hint.contains(part), "{found:?}");
        }
    }
}

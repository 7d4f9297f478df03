//! How the tool turns on straight moves and arcs.

use super::frames::CONFIG;
use super::*;

fn reported_in(statements: &str, data: &str) -> Vec<&'static str> {
    let text = format!("DEF M()\nBAS(#INITMOV,0)\nBAS(#TOOL,1)\nBAS(#BASE,2)\n{statements}\nEND\n");
    let data = format!(
        "DEFDAT M\nDECL FDAT FP1={{TOOL_NO 1,BASE_NO 2,IPO_FRAME #BASE,POINT2[] \" \"}}\n\
         DECL FDAT FP2={{TOOL_NO 1,BASE_NO 2,IPO_FRAME #BASE,POINT2[] \" \"}}\n\
         DECL FDAT FP3={{TOOL_NO 1,BASE_NO 3,IPO_FRAME #BASE,POINT2[] \" \"}}\n\
         DECL E6POS XP1={{X 1,Y 2,Z 3,A 0,B 90,C 0,S 2,T 2}}\n\
         DECL E6POS XP2={{X 9,Y 2,Z 3,A 0,B 90,C 0,S 2,T 2}}\n\
         DECL E6POS XP3={{X 9,Y 8,Z 3,A 0,B 90,C 0,S 2,T 2}}\n{data}\nENDDAT\n"
    );
    let files = [
        ("$config.dat", CONFIG),
        ("m.src", &*text),
        ("m.dat", &*data),
    ];
    let mut ids = reported(&read_files(&files));
    // the points of one arc
    ids.dedup();
    ids
}

/// An LDAT with these members behind the speeds.
fn ldat(members: &str) -> String {
    format!(
        "DECL LDAT LCPDAT1={{VEL 2.0,ACC 100.0,APO_DIST 100.0,APO_FAC 50.0,{members},JERK_FAC 50.0}}"
    )
}

const OTHER: &[&str] = &["move-not-supported"];

#[test]
fn arcs_have_the_type_that_their_ldat_says() {
    let form = "LDAT_ACT=LCPDAT1\nFDAT_ACT=FP1\nBAS(#CP_PARAMS,2)\nCIRC XP2,XP3";
    let spline = "SCIRC XP2,XP3 WITH $VEL=SVEL_CP(2.0, , LCPDAT1), $TOOL=STOOL2(FP1), \
        $BASE=SBASE(FP1.BASE_NO), $IPO_MODE=SIPO_MODE(FP1.IPO_FRAME), $LOAD=SLOAD(FP1.TOOL_NO), \
        $ORI_TYPE=SORI_TYP(LCPDAT1), $CIRC_TYPE=SCIRC_TYP(LCPDAT1), \
        $CIRC_MODE=SCIRC_M(LCPDAT1), $JERK=SJERK(LCPDAT1), \
        $COLLMON_TOL_PRO[1]=USE_CM_PRO_VALUES(0) C_Spl";
    let modes = |between: &str, end: &str| {
        let point = |ori: &str| format!("{{ORI #{ori},E1 #CONSIDER,E2 #CONSIDER}}");
        let (between, end) = (point(between), point(end));
        ldat(&format!(
            "ORI_TYP #VAR,CIRC_TYP #BASE,CB {{AUX_PT {between},TARGET_PT {end}}}"
        ))
    };
    for (form, data, expected) in [
        (form, ldat("ORI_TYP #VAR,CIRC_TYP #BASE"), &[][..]),
        (form, ldat("ORI_TYP #VAR,CIRC_TYP #PATH"), OTHER),
        (form, ldat("ORI_TYP #VAR"), &[]),
        (spline, ldat("ORI_TYP #VAR,CIRC_TYP #BASE"), &[]),
        (spline, ldat("ORI_TYP #VAR,CIRC_TYP #PATH"), OTHER),
        (spline, modes("CONSIDER", "INTERPOLATE"), &[]),
        (spline, modes("IGNORE", "INTERPOLATE"), &[]),
        (spline, modes("INTERPOLATE", "INTERPOLATE"), OTHER),
        (spline, modes("CONSIDER", "EXTRAPOLATE"), OTHER),
        // data of a file that is not here
        (spline, String::new(), &[]),
    ] {
        assert_eq!(
            reported_in(&format!("PTP XP1\n{form}"), &data),
            expected,
            "{data}: {form}"
        );
    }
    for (change, expected) in [
        ("LCPDAT1.VEL=1.0", &[][..]),
        ("LCPDAT1.CIRC_TYP=#PATH", OTHER),
        ("LDAT_ACT.CIRC_TYP=#PATH", &[]),
    ] {
        let data = ldat("ORI_TYP #VAR,CIRC_TYP #BASE");
        let text = format!("PTP XP1\n{change}\n{form}");
        let found = reported_in(&text, &data);
        assert!(
            expected.iter().all(|id| found.contains(id)),
            "{change}: {found:?}"
        );
        assert_eq!(found.is_empty(), expected.is_empty(), "{change}: {found:?}");
    }
    let active = "LDAT_ACT=LCPDAT1\nLDAT_ACT.CIRC_TYP=#PATH\nBAS(#CP_DAT)\nCIRC XP2,XP3";
    assert_eq!(
        reported_in(&format!("PTP XP1\n{active}"), &ldat("ORI_TYP #VAR")),
        OTHER
    );
}

#[test]
fn what_arcs_have_is_set_in_parts() {
    let usual = "$CIRC_TYPE=#BASE";
    for (text, expected) in [
        ("$CIRC_TYPE=#PATH", OTHER),
        ("$CIRC_TYPE=#PATH\n$CIRC_MODE.AUX_PT.ORI=#CONSIDER", OTHER),
        (
            "$CIRC_TYPE=#PATH\n$CIRC_MODE.AUX_PT.ORI=#IGNORE\n$CIRC_TYPE=#BASE",
            &[],
        ),
        (
            "$CIRC_MODE.TARGET_PT.ORI=#EXTRAPOLATE\n$CIRC_MODE.AUX_PT.ORI=#CONSIDER",
            OTHER,
        ),
        (
            "$CIRC_MODE.AUX_PT.ORI=#INTERPOLATE\n$CIRC_TYPE=#BASE",
            OTHER,
        ),
        (
            "$CIRC_MODE={AUX_PT {ORI #CONSIDER},TARGET_PT {ORI #INTERPOLATE}}",
            &[],
        ),
        ("$CIRC_MODE={AUX_PT {ORI #INTERPOLATE}}", OTHER),
        ("$CIRC_MODE.AUX_PT.E1=#INTERPOLATE", &[]),
        (usual, &[]),
    ] {
        let text = format!("PTP XP1\n{text}\nSCIRC XP2,XP3");
        assert_eq!(reported_in(&text, ""), expected, "{text}");
    }
    for (text, expected) in [
        (
            "SPLINE WITH $CIRC_TYPE=#PATH\nSCIRC XP2,XP3\nENDSPLINE",
            OTHER,
        ),
        (
            "SPLINE WITH $CIRC_TYPE=#PATH\nSCIRC XP2,XP3 WITH $CIRC_TYPE=#BASE\nENDSPLINE",
            &[],
        ),
        (
            "SCIRC XP2,XP3 WITH $CIRC_MODE.AUX_PT.ORI=#CONSIDER, $CIRC_TYPE=#PATH",
            OTHER,
        ),
        (
            "SCIRC XP2,XP3 WITH $CIRC_TYPE=#PATH, $CIRC_MODE.AUX_PT.ORI=#CONSIDER",
            OTHER,
        ),
    ] {
        assert_eq!(
            reported_in(&format!("PTP XP1\n{text}"), ""),
            expected,
            "{text}"
        );
    }
}

#[test]
fn a_kept_orientation_is_that_in_the_same_base_for_the_same_tool() {
    let kept: &[&str] = &["orientation-kept"];
    let same: &[&str] = &["orientation-not-corrected"];
    let spline = |fdat: &str, data: &str| {
        format!(
            " WITH $TOOL=STOOL2({fdat}), $BASE=SBASE({fdat}.BASE_NO), $ORI_TYPE=SORI_TYP({data})"
        )
    };
    let constant = ldat("ORI_TYP #CONSTANT");
    let form = |point: &str, fdat: &str| {
        format!("LDAT_ACT=LCPDAT1\nFDAT_ACT={fdat}\nBAS(#CP_PARAMS,2)\nLIN {point}")
    };
    for (text, expected) in [
        (
            format!(
                "SLIN XP1{}\nSLIN XP2{}",
                spline("FP1", "LX"),
                spline("FP2", "LCPDAT1")
            ),
            same,
        ),
        (
            format!(
                "SLIN XP1{}\nSLIN XP2{}",
                spline("FP1", "LX"),
                spline("FP3", "LCPDAT1")
            ),
            kept,
        ),
        (
            "SLIN XP1\nSLIN XP2 WITH $TOOL=TOOL_DATA[2], $ORI_TYPE=#CONSTANT".to_owned(),
            kept,
        ),
        (
            format!(
                "SLIN XP1{}\nBASE_DATA[2]={{X 0,Y 0,Z 0,A 9,B 0,C 0}}\nSLIN XP2{}",
                spline("FP1", "LX"),
                spline("FP1", "LCPDAT1")
            ),
            kept,
        ),
        // inline forms set tool and base for each move
        (
            format!(
                "FDAT_ACT=FP1\nBAS(#PTP_PARAMS,100)\nPTP XP1\n{}",
                form("XP2", "FP2")
            ),
            same,
        ),
        (
            format!(
                "FDAT_ACT=FP1\nBAS(#PTP_PARAMS,100)\nPTP XP1\n{}",
                form("XP2", "FP3")
            ),
            kept,
        ),
        (
            format!(
                "FDAT_ACT=FP1\nBAS(#PTP_PARAMS,100)\nPTP XP1\nIF $IN[1] THEN\nHALT\nENDIF\n{}",
                form("XP2", "FP2")
            ),
            kept,
        ),
    ] {
        assert_eq!(reported_in(&text, &constant), expected, "{text}");
    }
    let written = "XP2={X 9,Y 2,Z 3,A 9,B 90,C 0}\nPTP XP1\nSLIN XP2 WITH $ORI_TYPE=#CONSTANT";
    assert_eq!(reported_in(written, &constant), kept);
    // what is not understood hides nothing behind it
    for with in [
        "$ORI_TYPE=turn[1]",
        "$CIRC_TYPE=kind(2)",
        "$IPO_MODE=mode[k]",
        "$LOAD=loads[k]",
    ] {
        let program = path(&format!("SLIN XP2 WITH {with}, $BASE=BASE_DATA[3] C_SPL"));
        assert_eq!(
            program.frames[program.moves[0].frame].name, "BASE_DATA[3]",
            "{with}"
        );
    }
    // what the program writes into data is followed no further
    for (change, expected) in [
        ("LCPDAT1.VEL=1.0", &[][..]),
        ("LCPDAT1.ORI_TYP=#CONSTANT", kept),
    ] {
        let text = format!(
            "{change}\nPTP XP1\n$ORI_TYPE=SORI_TYP(LCPDAT1)\nLIN {{X 1,Y 2,Z 3,A 9,B 90,C 0}}"
        );
        assert_eq!(
            reported_in(&text, &ldat("ORI_TYP #VAR")),
            expected,
            "{change}"
        );
    }
}

#[test]
fn a_target_whose_orientation_is_ignored_is_refused() {
    let ignored: &[&str] = &["orientation-kept"];
    let data = ldat("ORI_TYP #IGNORE");
    for (text, expected) in [
        (
            "SPLINE\nSPL XP2 WITH $ORI_TYPE=#IGNORE\nSPL XP3\nENDSPLINE",
            ignored,
        ),
        (
            "SPLINE\nSPL XP2 WITH $ORI_TYPE=SORI_TYP(LCPDAT1)\nSPL XP3\nENDSPLINE",
            ignored,
        ),
        (
            "SPLINE WITH $ORI_TYPE=#IGNORE\nSPL XP2\nSPL XP3 WITH $ORI_TYPE=#VAR\nENDSPLINE",
            ignored,
        ),
        ("$ORI_TYPE=#IGNORE\nSPLINE\nSPL XP2\nENDSPLINE", ignored),
        (
            "$ORI_TYPE=#IGNORE\n$ORI_TYPE=#VAR\nSPLINE\nSPL XP2\nENDSPLINE",
            &[],
        ),
        ("$ORI_TYPE=#IGNORE\nPTP XP2", &[]),
        ("SPLINE\nSPL XP2\nSPL XP3\nENDSPLINE", &[]),
    ] {
        let text = format!("PTP XP1\n{text}");
        assert_eq!(reported_in(&text, &data), expected, "{text}");
    }
}

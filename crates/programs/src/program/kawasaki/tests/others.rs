//! Moves of other kinds, and statements that change what moves go to.

use super::*;

/// The findings of lines behind a move to joints and one to `p1`.
fn found(code: &str) -> Vec<String> {
    let program = read(&format!(
        "TOOL grip\nBASE NULL\nJMOVE #home\nLMOVE p1\n{code}"
    ));
    let mut found: Vec<_> = ids(&program).into_iter().map(str::to_owned).collect();
    found.sort_unstable();
    found.dedup();
    found
}

#[test]
fn moves_of_arc_welding_are_refused() {
    for verb in ["JWS", "LWS", "LWC", "lwe", "C1WC", "C2WC", "C2WE"] {
        let found = found(&format!("{verb} p[1]\nLDEPART 50"));
        assert_eq!(found, ["move-not-supported", "relative-move"], "{verb}");
    }
    // variables of these names
    assert!(found("lws = 1\nlwc[2] = 3\nLDEPART 50").is_empty());
}

#[test]
fn taught_steps_go_to_named_joints() {
    const STEP: &str = "SPEED9 ACCU1 TIMER0 TOOL1 WORK0 CLAMP1 (OFF,0,0,O) OX= WX=";
    for joints in ["#home", "#[0,20,-80,0,-80,0]"] {
        let program = read(&format!("JOINT {STEP} {joints}"));
        let found: Vec<_> = (program.moves.iter())
            .map(|m| (m.motion, target(&program, m).is_some()))
            .collect();
        assert_eq!(found, [(Motion::Joint, true)], "{joints}");
    }
    for verb in ["FLIN", "FJOINT", "FCIR1", "FCIR2", "XLIN"] {
        let found = found(&format!("{verb} {STEP} #[0,20,-80,0,-80,0]\nLDEPART 50"));
        assert!(found.contains(&"move-not-supported".to_owned()), "{verb}");
        assert!(found.contains(&"relative-move".to_owned()), "{verb}");
    }
    for verb in ["JOINT", "LINEAR", "LIN2", "CIR1", "CIR2"] {
        let found = found(&format!("{verb} {STEP} p1"));
        assert!(found.contains(&"move-not-supported".to_owned()), "{verb}");
    }
    assert!(found("joint = 3\nlinear[1] = 2\nLDEPART 50").is_empty());
}

#[test]
fn departures_leave_from_what_the_name_held_at_the_move() {
    for code in [
        "POINT p1 = p[2]",
        "POINT/X p1 = p[2]",
        "HERE p1",
        "LMOVE p[1]+off\nPOINT p[i] = p[2]",
        "JMOVE #home\nHSENSE 1 r,s,#home,e,m",
    ] {
        let found = found(&format!("{code}\nLDEPART 50"));
        assert!(
            found.contains(&"relative-move".to_owned()),
            "{code}: {found:?}"
        );
    }
    assert!(found("POINT p[1] = p[2]\nLDEPART 50").is_empty());
}

#[test]
fn joints_of_poses_and_poses_of_joints_are_computed() {
    for code in [
        "POINT #x = p1\nTOOL off\nLMOVE #x",
        "POINT .#x = p1+off\nLMOVE .#x",
        "POINT x = #home\nLMOVE x",
        "POINT x = #[0,20,-80,0,-80,0]\nLMOVE x",
    ] {
        assert_eq!(found(code), ["computed-target"], "{code}");
    }
    assert!(found("POINT #x = #home\nJMOVE #x\nPOINT x = p[2]\nLMOVE x").is_empty());
    for code in ["POINT #x = HERE\nJMOVE #x", "POINT x = HERE\nLMOVE x"] {
        assert_eq!(found(code), ["run-time-position"], "{code}");
    }
}

#[test]
fn what_a_sensor_latches_is_written() {
    let code = "HSENSE 1 r,s,#home,e,m\nJMOVE #home";
    assert_eq!(found(code), ["computed-target"]);
    assert!(found("HSENSE 1 r,s,#other,e,m\nJMOVE #home").is_empty());
}

#[test]
fn a_tool_of_an_array_is_each_of_its_elements() {
    let program = read("BASE NULL\nTOOL p[i]\nLMOVE p1");
    assert_eq!(ids(&program), [""; 0], "{:?}", program.findings);
    assert_eq!(program.moves.len(), 2);
    // what the running program writes is none of them
    let program = read("BASE NULL\nPOINT p[i] = FRAME(a,b,c,d)\nTOOL p[i]\nLMOVE p1");
    assert!(
        program
            .findings
            .iter()
            .any(|f| f.severity == Severity::Error),
        "{:?}",
        program.findings
    );
}

#[test]
fn a_shift_in_front_of_a_target_is_along_the_axes_of_the_base() {
    for (line, z_m) in [
        ("LMOVE TRANS(0,0,50,0,0,0)+p1", 0.05),
        ("LMOVE TRANS(0,0,50)+p1", 0.05),
        ("LMOVE NULL+p1", 0.0),
        ("POINT q = NULL+TRANS(0,0,-20)+p1\nLMOVE q", -0.02),
    ] {
        let program = read(&format!("TOOL NULL\nBASE NULL\n{line}"));
        assert_eq!(ids(&program), [""; 0], "{line}: {:?}", program.findings);
        let [motion] = &program.moves[..] else {
            panic!("{line}: {:?}", program.moves);
        };
        assert_eq!(target(&program, motion), Some("p1"));
        let expected = if z_m == 0.0 {
            Displacement::None
        } else {
            Displacement::By(Box::new(crate::program::Shift::along([0.0, 0.0, z_m])))
        };
        assert_eq!(motion.displacement, expected, "{line}");
    }
    // a target that is written out, with a step in the tool
    let program = read("TOOL NULL\nBASE NULL\nLMOVE TRANS(100,900,200,10,180,0)+off");
    assert_eq!(target(&program, &program.moves[0]), Some("here"));
}

#[test]
fn numbers_of_a_target_that_are_only_shown_do_not_refuse_it() {
    let of = |line: &str| {
        let code = format!("TOOL NULL\nBASE NULL\nDECOMPOSE x[0]=p1\n{line}\nLMOVE p1");
        ids(&read(&code)).join(" ")
    };
    assert_eq!(of("PRINT \"z\",x[2]"), "");
    assert_eq!(of("TYPE x[2]"), "");
    assert_eq!(of("h = x[2]"), "target-used-as-frame");
    assert_eq!(of("CALL sub(x[])"), "target-used-as-frame");
}

#[test]
fn what_a_process_gives_the_monitor_to_set_is_set() {
    let frames = |line: &str| -> Vec<String> {
        let text = format!(
            ".PROGRAM main()\nTOOL grip\nBASE NULL\nPCEXECUTE 1: other\nJMOVE #home\nLMOVE p1\n.END\n.PROGRAM \
             other()\n{line}\n.END\n{POINTS}"
        );
        let program = read_files(&[&text]).expect("programs");
        let moves = program
            .moves
            .iter()
            .filter(|of| target(&program, of) == Some("p1"));
        moves
            .map(|of| program.frames[of.frame].name.clone())
            .collect()
    };
    assert_eq!(frames("MC BASE off"), frames("BASE off"));
    assert_ne!(frames("MC BASE off"), frames("MC STATUS"));
}

//! What programs have in common with others, or have of their own, and does not count.

use crate::support::{poseshift, repository, scratch};
use std::path::Path;

const HEAD: &str = "$BASE={X 350,Y -100,Z 200,A 10,B 0,C 0}\n";
const POINT: &str = "LIN {X 50,Y 20,Z 195,A 180,B 10,C 175}\n";
const TOOL: &str = "{X 10,Y -5,Z 120,A 0,B 20,C 0}";

/// Compensates the folder `in` with the declarations of `with`: status and what is said.
fn compensated(at: &Path, more: &[&str]) -> (Option<i32>, String) {
    let command = [
        "compensate",
        "in",
        "--with",
        "with",
        "-o",
        "out",
        "--profile",
        "p.yaml",
    ];
    let run = poseshift()
        .current_dir(at)
        .args(command)
        .args(more)
        .output();
    let run = run.expect("the program starts");
    let said = [run.stderr, run.stdout].concat();
    let said = String::from_utf8_lossy(&said).into_owned();
    let flat = said.split_whitespace().collect::<Vec<_>>().join(" ");
    (run.status.code(), flat)
}

/// A folder of programs, each with its body, declarations of a controller, and a profile.
fn world(
    programs: &[(&str, &str)],
    declared: &str,
    effects: &str,
    tools: &str,
) -> tempfile::TempDir {
    let folder = scratch();
    let at = folder.path();
    for name in ["in", "with"] {
        std::fs::create_dir(at.join(name)).expect("scratch");
    }
    let profile = std::fs::read_to_string(repository("robots/kuka_kr6_r900.yaml"));
    let profile = profile.expect("a profile");
    let changed = profile.replacen("effects: []", &format!("effects: [{effects}]"), 1);
    let changed = changed.replacen("tools: {}", &format!("tools: {{{tools}}}"), 1);
    assert_ne!(changed, profile);
    std::fs::write(at.join("p.yaml"), changed).expect("scratch");
    let config = format!("DEFDAT $CONFIG\n{declared}ENDDAT\n");
    std::fs::write(at.join("with/$config.dat"), config).expect("scratch");
    for (name, body) in programs {
        let text = format!("DEF {name}()\n{body}END\n");
        std::fs::write(at.join(format!("in/{name}.src")), text).expect("scratch");
    }
    folder
}

#[test]
fn a_home_of_the_controller_does_not_join_programs() {
    let home = "DECL E6AXIS XHOME={A1 0,A2 -90,A3 90,A4 0,A5 45,A6 0}\n";
    let body = |point: &str| format!("$TOOL={TOOL}\n{HEAD}PTP XHOME\n{point}");
    let programs = [("good", &*body(POINT)), ("bad", &*body("LIN {X 50}\n"))];
    let effect = "{effect: link_geometry, link: 3, theta_deg: 0.1}";
    let folder = world(&programs, home, effect, "");
    let (status, said) = compensated(folder.path(), &["--write-good"]);
    assert_eq!(status, Some(1), "{said}");
    assert!(
        said.contains("written in/good.src refused in/bad.src"),
        "{said}"
    );
    let written = std::fs::read_to_string(folder.path().join("out/good.src"));
    let written = written.expect("the good program");
    assert!(!written.contains(POINT), "{written}");
}

#[test]
fn a_tool_that_is_written_out_and_has_an_effect_by_name_is_said_at_its_own_move() {
    let named = format!("TOOL_DATA[1]={TOOL}\n");
    let (by_name, by_numbers) = ("$TOOL=TOOL_DATA[1]\n", format!("$TOOL={TOOL}\n"));
    let home = "PTP {A1 0,A2 -90,A3 90,A4 0,A5 45,A6 0}\n";
    let effect = "{effect: tool_frame, tool: \"TOOL_DATA[1]\", x_mm: 1.0}";
    let tools = "\"TOOL_DATA[1]\": {frame: {x_mm: 10, y_mm: -5, z_mm: 120, rx_deg: 0, ry_deg: 20, rz_deg: 0}}";
    for (behind, is_said) in [("", false), (&*by_numbers, true)] {
        let body = format!("{by_name}{HEAD}{home}{POINT}{behind}{POINT}");
        let declared = format!("FRAME TOOL_DATA[16]\n{named}");
        let folder = world(&[("t", &*body)], &declared, effect, tools);
        let (status, said) = compensated(folder.path(), &[]);
        assert_eq!(status, Some(0), "{said}");
        assert_eq!(said.contains("effect-unused"), is_said, "{said}");
        assert_eq!(
            said.contains("does not apply to this move"),
            is_said,
            "{said}"
        );
    }
}

/// A function within another that nothing calls: nothing else can start it.
#[test]
fn an_inner_function_that_nothing_calls_needs_no_tool() {
    let folder = scratch();
    let at = folder.path();
    let profile = std::fs::read_to_string(repository("robots/universal_robots_ur5.yaml"));
    let effect = "effects: [{effect: link_geometry, link: 3, theta_deg: 0.1}]";
    let profile = profile
        .expect("a profile")
        .replacen("effects: []", effect, 1);
    std::fs::write(at.join("p.yaml"), profile).expect("scratch");
    let idle = "movel(p[0.4,0.2,0.35,0.0,3.14159,0.0],a=1,v=0.1)";
    let go = "movel(p[0.43,0.1,0.3,0.0,3.14159,0.0],a=1,v=0.1)";
    let home = "movej([0,-1.2,1.5,-1.8,-1.5,0])";
    let body = format!("set_tcp(p[0,0,0.1,0,0,0])\n{home}\n{go}\n");
    let park = format!("def park():\n{idle}\nend\n");
    for (call, is_left) in [("", true), ("park()\n", false)] {
        let text = format!("def t():\n{park}{body}{call}end\n");
        std::fs::write(at.join("a.script"), text).expect("scratch");
        let command = [
            "compensate",
            "a.script",
            "--profile",
            "p.yaml",
            "-o",
            "o.script",
        ];
        let run = poseshift().current_dir(at).args(command).output();
        let run = run.expect("the program starts");
        let said = String::from_utf8_lossy(&run.stderr);
        assert_eq!(run.status.code(), Some(0), "{said}");
        let written = std::fs::read_to_string(at.join("o.script")).expect("a program");
        assert_eq!(written.contains(idle), is_left, "{written}");
        assert!(!written.contains(go), "{written}");
        std::fs::remove_file(at.join("o.script")).expect("it is there");
    }
}

//! Targets between those of a program where an instruction is several moves, or one on which the
//! tool rotates as the wrist does.

use crate::support::{poseshift, repository, run, scratch};

/// Status, what was reported and the written program of `compensate --max-path-error`.
fn refined(profile: &str, (name, text): (&str, &str)) -> (i32, String, Option<String>) {
    let folder = scratch();
    let (given, out) = (
        folder.path().join(name),
        folder.path().join("out").join(name),
    );
    std::fs::create_dir(folder.path().join("out")).expect("a writable folder");
    std::fs::write(&given, text).expect("a writable folder");
    let output = poseshift()
        .current_dir(repository(""))
        .arg("compensate")
        .arg(&given)
        .args(["--profile", profile, "--max-path-error", "0.04", "-o"])
        .arg(&out)
        .output()
        .expect("the program starts");
    let reported = String::from_utf8_lossy(&output.stdout).into_owned()
        + &String::from_utf8_lossy(&output.stderr);
    let status = output.status.code().expect("it ended");
    (status, reported, std::fs::read_to_string(&out).ok())
}

const KRL: &str = "programs/krl/profile.yaml";
const A: &str = "LIN {X 1600.500,Y -600.250,Z 900.125,A 0.0001,B 0.0001,C 180.0}\n";
const D: &str = "LIN {X 1500.500,Y -300.250,Z 1000.125,A 0.0001,B 0.0001,C 180.0}\n";
/// From where its caller left it to one place, and on to another.
const SUB: &str = "DEF sub()
LIN {X 1600.500,Y 600.250,Z 900.125,A 0.0001,B 0.0001,C 180.0}
LIN {X 1450.001,Y -300.001,Z 900.001,A 0.0001,B 0.0001,C 180.0}
END
";

fn krl(body: &str) -> String {
    format!(
        "DEF t()\n$TOOL={{X 0,Y 0,Z 300,A 0,B 0,C 0}}\n$BASE=$WORLD\n\
         PTP {{A1 25,A2 -80,A3 90,A4 0,A5 80,A6 -155}}\n{body}END\n{SUB}"
    )
}

/// Straight moves of `sub`.
fn lines_of_sub(program: &str) -> Vec<&str> {
    let from = program.find("DEF sub").expect("the routine");
    program[from..]
        .lines()
        .filter(|line| line.starts_with("LIN"))
        .collect()
}

#[test]
fn a_routine_that_is_called_from_one_place_gets_its_targets_once() {
    let (status, reported, once) = refined(KRL, ("t.src", &krl(&format!("{A}sub()\n"))));
    assert_eq!(status, 0, "{reported}");
    let (status, reported, twice) = refined(KRL, ("t.src", &krl(&format!("{A}sub()\n{A}sub()\n"))));
    assert_eq!(status, 0, "{reported}");
    let [once, twice] = [once, twice].map(|text| text.expect("written"));
    assert!(lines_of_sub(&once).len() > 4, "{once}");
    assert_eq!(lines_of_sub(&twice), lines_of_sub(&once));
}

#[test]
fn a_routine_that_is_called_from_two_places_gets_none_at_its_beginning() {
    let text = krl(&format!("{A}sub()\n{D}sub()\n"));
    let (status, reported, written) = refined(KRL, ("t.src", &text));
    assert_eq!((status, written), (1, None), "{reported}");
    let line = text
        .lines()
        .position(|line| line.contains("Y 600.250"))
        .expect("the move");
    let place = format!("t.src:{}:1: error[path-not-refined]", line + 1);
    assert!(reported.contains(&place), "{reported}");
    assert!(reported.contains("from several moves"), "{reported}");
    assert_eq!(
        reported.matches("error[path-not-refined]").count(),
        1,
        "{reported}"
    );
}

#[test]
fn a_loop_gets_none_where_it_begins_elsewhere_at_first() {
    let text = krl(&format!(
        "{A}LOOP\n{D}LIN {{X 1600.500,Y 600.250,Z 900.125,A 0.0001,B 0.0001,C 180.0}}\nENDLOOP\n"
    ));
    let text = text.replace(SUB, "");
    let (status, reported, _) = refined(KRL, ("t.src", &text));
    assert_eq!(status, 1, "{reported}");
    assert!(reported.contains("from several moves"), "{reported}");
}

#[test]
fn no_targets_lead_the_robot_back_behind_a_routine_that_is_not_in_the_files() {
    let line = "LIN {X 1600.500,Y 600.250,Z 900.125,A 0.0001,B 0.0001,C 180.0}\n";
    let text = |call: &str| krl(&format!("{A}{call}{line}")).replace(SUB, "");
    let (status, reported, _) = refined(KRL, ("t.src", &text("")));
    assert_eq!(status, 0, "{reported}");
    let (status, reported, written) = refined(KRL, ("t.src", &text("pick()\n")));
    assert_eq!((status, written), (1, None), "{reported}");
    let said = "error[path-not-refined]";
    assert!(
        reported.contains(said) && reported.contains("`pick`"),
        "{reported}"
    );
}

/// Long moves that get targets, and words in them (to be found, to put in their place) with which
/// the wrist's joints lead the tool.
const LED: [(&str, &str, &str, [&str; 2]); 3] = [
    (
        KRL,
        "t.src",
        "DEF t()\n$TOOL={X 0,Y 0,Z 300,A 0,B 0,C 0}\n$BASE=$WORLD\n\
         PTP {A1 25,A2 -80,A3 90,A4 0,A5 80,A6 -155}\n$ORI_TYPE=#VAR\n\
         LIN {X 1600.500,Y -600.250,Z 900.125,A 0.0001,B 0.0001,C 180.0}\n\
         LIN {X 1600.500,Y 600.250,Z 900.125,A 20.0001,B 0.0001,C 180.0}\nEND\n",
        ["#VAR", "#JOINT"],
    ),
    (
        "programs/fanuc/profile.yaml",
        "t.ls",
        "/PROG  T\n/ATTR\nLINE_COUNT = 5;\n/MN\n   1:  UTOOL_NUM=1 ;\n   2:  UFRAME_NUM=0 ;\n\
         \x20  3:J P[1] 20% FINE    ;\n   4:J P[1] 20% FINE    ;\n\
         \x20  5:L P[2] 250mm/sec CNT50 ACC80    ;\n/POS\nP[1]{\n   GP1:\n\
         \tUF : 0, UT : 1,\t\tCONFIG : 'N U T, 0, 0, 0',\n\
         \tX =  1900.125  mm,\tY =  -600.250  mm,\tZ =   500.500  mm,\n\
         \tW =   180.000 deg,\tP =     0.000 deg,\tR =     0.000 deg\n};\nP[2]{\n   GP1:\n\
         \tUF : 0, UT : 1,\t\tCONFIG : 'N U T, 0, 0, 0',\n\
         \tX =  1900.125  mm,\tY =   600.250  mm,\tZ =   500.500  mm,\n\
         \tW =   180.000 deg,\tP =     0.000 deg,\tR =     0.000 deg\n};\n/END\n",
        ["ACC80", "Wjnt"],
    ),
    (
        "robots/abb_irb120_thesis.yaml",
        "t.mod",
        "MODULE t\nPROC main()\nConfL\\Off;\n\
         MoveAbsJ [[-35,30,5,0,50,-35],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;\n\
         MoveL [[350,-250,300],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;\n\
         SingArea\\Off;\n\
         MoveL [[350,250,300],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,z1,tool0;\n\
         ENDPROC\nENDMODULE\n",
        ["SingArea\\Off", "SingArea\\Wrist"],
    ),
];

#[test]
fn a_move_on_which_the_wrist_leads_the_tool_gets_none() {
    for (profile, name, text, [evenly, as_wrist]) in LED {
        let (status, reported, _) = refined(profile, (name, text));
        assert!(
            status == 0 && reported.contains("moves inserted"),
            "{name}: {reported}"
        );
        assert!(text.contains(evenly));
        let led = text.replace(evenly, as_wrist);
        let (status, reported, written) = refined(profile, (name, &led));
        assert_eq!((status, written), (1, None), "{name}: {reported}");
        assert!(
            reported.contains("error[path-not-refined]"),
            "{name}: {reported}"
        );
        assert!(
            reported.contains("as the joints of the wrist do"),
            "{name}: {reported}"
        );
    }
}

#[test]
fn a_path_on_which_the_wrist_leads_the_tool_is_not_certified() {
    let folder = scratch();
    for (profile, name, text, [evenly, as_wrist]) in LED {
        for (text, is_led) in [
            (text.to_owned(), false),
            (text.replace(evenly, as_wrist), true),
        ] {
            let path = folder.path().join(name);
            std::fs::write(&path, text).expect("a writable folder");
            let mut command = poseshift();
            command.current_dir(repository("")).arg("check").arg(&path);
            let done = command
                .args(["--profile", profile])
                .output()
                .expect("it starts");
            let reported = String::from_utf8_lossy(&done.stdout);
            let is_said = reported.contains("warning[path-uncertified]: the tool rotates");
            assert_eq!(is_said, is_led, "{name}: {reported}");
        }
    }
}

/// A first move to joints before a tool is set, as most posts of KRL write it.
#[test]
fn moves_to_joints_before_any_tool_is_set_are_those_of_the_flange() {
    let folder = scratch();
    let program = "DEF home()\nPTP {A1 0,A2 -90,A3 90,A4 0,A5 10,A6 0}\n$TOOL={X 0,Y 0,Z 200,A 0,B 0,C 0}\n\
        $BASE={X 1500,Y 0,Z 600,A 0,B 0,C 0}\nPTP {X 0,Y 0,Z 300,A 0,B 0,C 180,S 2,T 2}\n\
        LIN {X 0,Y 100,Z 300,A 0,B 0,C 180}\nEND\n";
    let (file, out) = (
        folder.path().join("home.src"),
        folder.path().join("out.src"),
    );
    std::fs::write(&file, program).expect("scratch");
    let robot = crate::support::text("robots/kuka_kr210_r2700.yaml");
    let robot = robot.replace(
        "effects: []",
        "effects: [{effect: link_geometry, link: 3, theta_deg: 0.1}]",
    );
    let profile = folder.path().join("p.yaml");
    std::fs::write(&profile, robot).expect("scratch");
    let [file, out, profile] = [&file, &out, &profile].map(|path| path.to_str().expect("UTF-8"));
    let (status, said, error) = run(&["check", file, "--profile", profile]);
    assert_eq!(status, 0, "{said}{error}");
    assert!((said + &error).contains("warning[tool-not-set]"));
    let compensate = ["compensate", file, "--profile", profile, "-o", out];
    let (status, said, error) = run(&[&compensate[..], &["--max-path-error", "0.2"]].concat());
    assert_eq!(status, 0, "{said}{error}");
    // a move to a pose needs its tool, also where it carries something else by then
    for loaded in [
        "",
        "$LOAD={M 5,CM {X 0,Y 0,Z 50,A 0,B 0,C 0},J {X 0,Y 0,Z 0}}\n",
    ] {
        let program = program.replace("$TOOL={X 0,Y 0,Z 200,A 0,B 0,C 0}\n", loaded);
        std::fs::write(file, program).expect("scratch");
        let (status, said, error) = run(&["check", file, "--profile", profile]);
        assert_eq!(status, 2, "{loaded}");
        assert!(
            (said + &error).contains("where tool `$TOOL` is"),
            "{loaded}"
        );
    }
}

//! `--max-path-error` together with what else `compensate` does to the same moves: targets that are
//! split, points that only the running program knows.

use crate::support::{poseshift, repository, scratch};
use serde_json::Value;

const HARMONIC: &str = "{effect: link_geometry, link: 3, theta_deg: 0.2, a_mm: 0.5}, \
    {effect: joint_harmonic, joint: 1, order: 9, cos_deg: 0.1, sin_deg: 0}";
/// The upper arm is longer.
const LONG: &str = "{effect: link_geometry, link: 3, a_mm: 0.3, theta_deg: 0.1}";
const AXES: &str = "[9E9,9E9,9E9,9E9,9E9,9E9]]";

/// A robot, its effects, and the files of a program.
struct Given<'a> {
    robot: &'a str,
    effects: &'a str,
    files: &'a [(&'a str, String)],
}

/// What a run gave: the status, what it printed, the report, and the text of the first file written.
struct Run {
    status: Option<i32>,
    printed: String,
    report: Value,
    written: String,
    /// Of `check` with the original: each move that is no joint target.
    checked: Vec<Value>,
}

impl Run {
    fn of(given: &Given, options: &[&str]) -> Self {
        let folder = scratch();
        let at = |name: &str| folder.path().join(name).display().to_string();
        let text = std::fs::read_to_string(repository(given.robot)).expect("a profile");
        let plain = &text[..text.find("calibration:").expect("a list of effects")];
        let profile = format!("{plain}calibration: {{effects: [{}]}}\n", given.effects);
        std::fs::write(at("p.yaml"), profile).expect("scratch");
        std::fs::create_dir(at("in")).expect("scratch");
        for (name, text) in given.files {
            std::fs::write(at("in") + "/" + name, text).expect("scratch");
        }
        let run = |arguments: &[&str]| {
            let mut command = poseshift();
            let done = command.current_dir(folder.path()).args(arguments).output();
            let done = done.expect("it starts");
            let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
            (done.status.code(), text(&done.stdout), text(&done.stderr))
        };
        let compensate = ["compensate", "in", "--profile", "p.yaml", "-o", "out"];
        let (status, out, error) = run(&[&compensate[..], options, &["--json"]].concat());
        let written = std::fs::read_to_string(at("out") + "/" + given.files[0].0);
        let check = ["check", "out", "--nominal", "in", "--profile", "p.yaml"];
        let (_, found, _) = run(&[&check[..], &["--json"]].concat());
        let found: Value = serde_json::from_str(&found).unwrap_or_default();
        let moves = found["moves"].as_array().cloned().unwrap_or_default();
        Self {
            status,
            report: serde_json::from_str(&out).unwrap_or_default(),
            printed: format!("{out}{error}"),
            written: written.unwrap_or_default(),
            checked: moves
                .into_iter()
                .filter(|one| one["joint_target"] == false)
                .collect(),
        }
    }

    /// The lines of the findings of one id.
    fn lines(&self, id: &str) -> Vec<u64> {
        let all = self.report["findings"].as_array().into_iter().flatten();
        let of = all.filter(|finding| finding["id"] == id);
        of.filter_map(|finding| finding["line"].as_u64()).collect()
    }
}

fn krl(body: &str) -> [(&'static str, String); 2] {
    let src = format!(
        "DEF t()\nINT I\nDECL E6POS PL\n$TOOL={{X 12.5,Y -4,Z 110,A 0,B 30,C 0}}\n$BASE=$WORLD\nPTP \
         {{A1 0,A2 -90,A3 90,A4 0,A5 40,A6 0}}\nPTP XA\n{body}END\n"
    );
    let dat = "DEFDAT t\nDECL E6POS XA={X 600.0,Y -150.0,Z 600.0,A 180.0,B 0.0,C \
               180.0}\nDECL E6POS XB={X 680.0,Y 0.0,Z 600.0,A 150.0,B 10.0,C 170.0}\nDECL E6POS \
               XC={X 600.0,Y 150.0,Z 600.0,A 180.0,B 0.0,C 180.0}\nENDDAT\n";
    [("t.src", src), ("t.dat", dat.into())]
}

fn rapid(body: &str) -> [(&'static str, String); 1] {
    let target = |name: &str, position: &str, rotation: &str| {
        format!("CONST robtarget {name}:=[[{position}],[{rotation}],[0,0,0,0],{AXES};\n")
    };
    let data = [
        target("pA", "350.000,-150.000,350.000", "0,0,1,0"),
        target("pB", "430.000,0.000,350.000", "0.08715574,0,0.99619470,0"),
        target("pC", "350.000,150.000,350.000", "0,0,1,0"),
    ];
    let text = format!(
        "MODULE t\nVAR robtarget q;\nPERS tooldata t1:=[TRUE,[[10,-5,90],[1,0,0,0]],[1.2,[5,0,50],\
         [1,0,0,0],0,0,0]];\n{}PROC main()\nConfJ\\Off;\nConfL\\Off;\nMoveAbsJ [[0,0,0,0,60,0],{AXES},\
         v100,fine,t1;\nMoveJ pA,v100,fine,t1;\n{body}ENDPROC\nENDMODULE\n",
        data.concat()
    );
    [("t.mod", text)]
}

const KUKA: &str = "robots/kuka_kr6_r900.yaml";
const ABB: &str = "robots/abb_irb120.yaml";

#[test]
fn an_arc_with_new_targets_needs_no_target_of_its_own_for_the_point_on_its_way() {
    let in_krl = krl("CIRC XB,XC\nLIN XB\n");
    let in_rapid = rapid("MoveC pB,pC,v100,fine,t1;\nMoveL pB,v100,fine,t1;\n");
    for (robot, files, arc, middle) in [
        (KUKA, &in_krl[..], "CIRC", "XB"),
        (ABB, &in_rapid[..], "MoveC", "pB"),
    ] {
        let given = Given {
            robot,
            effects: HARMONIC,
            files,
        };
        // the point on the way of the arc is the end of a line, too
        let limit = ["--max-path-error", "0.05"];
        let whole = Run::of(&given, &limit);
        assert_eq!(whole.lines("target-shared").len(), 1, "{}", whole.printed);
        let split = Run::of(&given, &["--split-targets"]);
        assert_eq!(split.status, Some(0), "{}", split.printed);
        assert_eq!(split.written.matches(arc).count(), 1, "{}", split.written);
        let both = Run::of(&given, &[&["--split-targets"][..], &limit].concat());
        assert_eq!(both.status, Some(0), "{}", both.printed);
        let arcs: Vec<&str> = (both.written.lines())
            .filter(|line| line.contains(arc))
            .collect();
        assert!(arcs.len() > 1, "{}", both.written);
        assert!(arcs.iter().all(|line| !line.contains(middle)), "{arcs:?}");
        let far = |one: &Value, key: &str| one[key].as_f64().expect("a number");
        assert!(both.checked.len() > 3, "{:?}", both.checked);
        for one in &both.checked {
            assert!(far(one, "target_error_mm") < 0.002, "{one}");
            let is_path = one["kind"] == "linear" || one["kind"] == "arc";
            let off = one["max_path_error_mm"].as_f64().filter(|_| is_path);
            assert!(off.is_none_or(|off| off < 0.05), "{one}");
        }
    }
}

#[test]
fn an_arc_that_cannot_have_new_targets_keeps_the_own_one_of_the_point_on_its_way() {
    // a time for the whole arc: it is not repeated
    let files = rapid("MoveC pB,pC,v100\\T:=5,fine,t1;\nMoveL pB,v100,fine,t1;\n");
    let given = Given {
        robot: ABB,
        effects: HARMONIC,
        files: &files,
    };
    let options = ["--split-targets", "--max-path-error", "0.05"];
    let refused = Run::of(&given, &options);
    let lines = refused.lines("path-not-refined");
    assert_eq!(lines.len(), 1, "{}", refused.printed);
    let accepted = ["--accept", "path-not-refined"];
    let kept = Run::of(&given, &[&options[..], &accepted].concat());
    assert_eq!(kept.status, Some(0), "{}", kept.printed);
    assert_eq!(
        kept.written.matches("MoveC [[").count(),
        1,
        "{}",
        kept.written
    );
}

#[test]
fn moves_to_and_from_a_point_that_a_counter_displaces_are_named() {
    let in_krl = krl("FOR I=1 TO 3\nLIN XA\nPL=XC\nPL.Z=PL.Z+I*18\nLIN PL\nENDFOR\nCIRC XB,XA\n");
    let in_rapid = rapid(
        "FOR i FROM 1 TO 3 DO\nMoveL pA,v100,fine,t1;\nq:=Offs(pC,0,0,i*18);\nMoveL q,v100,fine,t1;\n\
         ENDFOR\nMoveC pB,pA,v100,fine,t1;\n",
    );
    for (robot, files, lines) in [
        (KUKA, &in_krl[..], [9, 12, 14]),
        (ABB, &in_rapid[..], [13, 15, 17]),
    ] {
        let given = Given {
            robot,
            effects: LONG,
            files,
        };
        let options = ["--max-derived-error", "1", "--max-path-error"];
        let named = Run::of(&given, &[&options[..], &["0.01", "--keep-going"]].concat());
        let said = named.lines("path-from-kept-target");
        assert!(
            lines.iter().all(|line| said.contains(line)),
            "{said:?}{}",
            named.printed
        );
        // each once, and not where the points are near enough
        let mut once = said.clone();
        once.dedup();
        assert_eq!(said, once);
        let near = Run::of(&given, &[&options[..], &["5"]].concat());
        assert_eq!(
            near.lines("path-from-kept-target"),
            [0; 0],
            "{}",
            near.printed
        );
    }
}

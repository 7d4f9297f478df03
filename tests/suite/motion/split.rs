//! Targets written out at each of their moves: only where the text of a move names the target itself.

use super::{P, PLAIN, checked, done, errors, given, profile, rapid, try_with};
use poseshift::compensate::{Compensation, Options, compensate};
use poseshift::finding::Severity;
use poseshift::program::{self, Motion, Source};

const TOOLS: &str = "PERS tooldata t:=[TRUE,[[0,0,100],[1,0,0,0]],[1,[0,0,50],[1,0,0,0],0,0,0]];
PERS tooldata u:=[TRUE,[[30,0,60],[1,0,0,0]],[1,[0,0,50],[1,0,0,0],0,0,0]];";

fn split(files: &[(&str, &str)]) -> Compensation {
    let options = Options {
        split_targets: true,
        ..given()
    };
    try_with(options, &[PLAIN], files).expect("read")
}

fn hint<'a>(done: &'a Compensation, id: &str) -> &'a str {
    let found = done.findings.iter().find(|f| f.id == id);
    &found
        .unwrap_or_else(|| panic!("{id} in {:?}", done.findings))
        .hint
}

/// A routine that goes to a target with one tool, and a move to it with another.
fn with_two_tools(data: &str, body: &str, routines: &str) -> String {
    let data = format!("{TOOLS}\nCONST robtarget p1:=[[400,0,350],{P};\n{data}");
    let start = "MoveAbsJ [[0,10,10,0,60,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,t;";
    let text = rapid(&data, &format!("{start}\n{body}\nMoveL p1,v100,fine,u;"));
    text.replace("ENDMODULE", &format!("{routines}\nENDMODULE"))
}

#[test]
fn moves_that_name_their_target_get_one_of_their_own() {
    for (data, body) in [
        ("", "MoveL p1,v100,fine,t;"),
        ("", "MoveL P1,v100,fine,t;"),
        // a copy is this target alone
        ("VAR robtarget q;", "q:=p1;\nMoveL q,v100,fine,t;"),
    ] {
        let done = split(&[("t.mod", &with_two_tools(data, body, ""))]);
        assert_eq!(errors(&done), [""; 0], "{body}: {:?}", done.findings);
    }
}

#[test]
fn a_target_with_comments_between_its_numbers_is_written_out_on_one_line() {
    let text = with_two_tools("", "MoveL p1,v100,fine,t;", "");
    let text = text.replace("[[400,0,350],", "[[400, ! x, [1,2]\r\n0,350], ! here\n");
    let done = split(&[("t.mod", &text)]);
    assert_eq!(errors(&done), [""; 0], "{:?}", done.findings);
    let written = String::from_utf8(done.edits[0].apply(text.as_bytes())).expect("text");
    let moves = written.lines().filter(|line| line.starts_with("MoveL [[4"));
    assert_eq!(moves.clone().count(), 2, "{written}");
    assert!(
        moves
            .clone()
            .all(|line| !line.contains('!') && line.ends_with(';')),
        "{written}"
    );
    let again = split(&[("t.mod", &written)]);
    assert_eq!(errors(&again), [""; 0], "{:?}", again.findings);
}

#[test]
fn a_copy_that_each_routine_makes_for_itself_is_written_out() {
    let other = "PROC other()\nq:=p1;\nMoveL q,v100,fine,t;\nENDPROC";
    let text = with_two_tools(
        "VAR robtarget q;",
        "q:=p1;\nMoveL q,v100,fine,t;\nother;",
        other,
    );
    let done = split(&[("t.mod", &text)]);
    assert_eq!(errors(&done), [""; 0], "{:?}", done.findings);
}

#[test]
fn moves_by_parameters_and_indices_stay_as_they_are() {
    let go = "PROC go(robtarget p)\nMoveL p,v100,fine,t;\nENDPROC";
    // a parameter that has the name of the target is no other matter
    let copied = "PROC go(robtarget p)\nVAR robtarget q;\nq:=p;\nMoveL q,v100,fine,t;\nENDPROC";
    let global = "PROC go()\nMoveL q,v100,fine,t;\nENDPROC";
    let alike = "PROC go(robtarget p1)\nMoveL p1,v100,fine,t;\nENDPROC";
    for (data, body, routines) in [
        ("", "go p1;", go),
        ("", "go p1;", alike),
        ("", "go p1;", copied),
        ("VAR robtarget q;", "q:=p1;\ngo;", global),
        (
            "CONST robtarget a{2}:=[[[400,0,350],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],[[400,40,350],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]];\nVAR num n;",
            "n:=GInput(g1);\nMoveL a{n},v100,fine,t;\nMoveL a{1},v100,fine,u;",
            "",
        ),
    ] {
        let text = with_two_tools(data, body, routines);
        let done = split(&[("t.mod", &text)]);
        assert_eq!(errors(&done), ["target-shared"], "{:?}", done.findings);
        let hint = hint(&done, "target-shared");
        assert!(hint.contains("by a parameter or an index"), "{hint}");
    }
}

#[test]
fn moves_in_files_that_are_only_read_are_an_error() {
    let text = with_two_tools("", "sub;", "");
    let sub = "MODULE s\nPROC sub()\nMoveL p1,v100,fine,t;\nENDPROC\nENDMODULE\n";
    let run = |is_context: bool| {
        let mut sources = vec![
            Source::new("t.mod", text.as_bytes().to_vec()),
            Source::new("s.mod", sub.as_bytes().to_vec()),
        ];
        sources[1].is_context = is_context;
        let language = program::language_of(&sources[0]).expect("a language");
        let options = Options {
            split_targets: true,
            ..given()
        };
        compensate(language, &sources, &profile(&[PLAIN]), &options).expect("read")
    };
    assert_eq!(errors(&run(false)), [""; 0]);
    let done = run(true);
    assert_eq!(errors(&done), ["target-shared"], "{:?}", done.findings);
    assert!(hint(&done, "target-shared").contains("only read"));
}

#[test]
fn numbers_of_a_target_that_is_written_out_are_the_programmed_ones() {
    let read = "IF p1.trans.z>300 THEN\nWaitTime 1;\nENDIF\nMoveL p1,v100,fine,t;";
    let text = with_two_tools("", read, "");
    let done = split(&[("t.mod", &text)]);
    assert_eq!(errors(&done), [""; 0], "{:?}", done.findings);
    let is_read = |done: &Compensation| done.findings.iter().any(|f| f.id == "numbers-read");
    assert!(!is_read(&done), "{:?}", done.findings);
    // where the target itself is corrected, the finding stays
    let alone = text.replace("MoveL p1,v100,fine,u;", "");
    assert!(is_read(&split(&[("t.mod", &alone)])));
}

/// Where the robot comes to an arc from two places.
fn arc(before: &str) -> String {
    let at = |x: f64, y: f64| format!("[[{x},{y},350],{P}");
    let [start, other, via, end] =
        [(350.0, -80.0), (300.0, 20.0), (400.0, -30.0), (380.0, 60.0)].map(|(x, y)| at(x, y));
    let joints = "MoveAbsJ [[-10,10,10,5,60,10],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;";
    let to = |target: &str| format!("MoveL {target},v100,fine,tool0;\n");
    let before = before
        .replace("START", &to(&start))
        .replace("OTHER", &to(&other));
    rapid(
        "",
        &format!("{joints}\n{before}MoveC {via},{end},v100,fine,tool0;"),
    )
}

#[test]
fn an_arc_is_followed_from_each_of_its_beginnings() {
    let bounds = |before: &str| {
        let sources = [Source::new("t.mod", arc(before).into_bytes())];
        let done = checked(&profile(&[PLAIN]), &sources, None);
        let arcs = done
            .moves
            .iter()
            .filter(|report| done.program.moves[report.motion].motion == Motion::ArcEnd);
        let arcs = arcs.map(|report| report.path.expect("a path").bound.distance_m);
        let mut arcs: Vec<f64> = arcs.collect();
        arcs.sort_by(f64::total_cmp);
        arcs
    };
    let mut each = [bounds("START"), bounds("START\nOTHER")].concat();
    each.sort_by(f64::total_cmp);
    assert!(each[1] - each[0] > 1e-7, "{each:?}");
    let near = |found: Vec<f64>| {
        assert_eq!(found.len(), each.len(), "{found:?}");
        for (found, of) in found.iter().zip(&each) {
            assert!((found - of).abs() < 1e-9, "{found:e} {of:e}");
        }
    };
    near(bounds("START\nIF DInput(di1)=1 THEN\nOTHER\nENDIF\n"));
    near(bounds("IF DInput(di1)=1 THEN\nOTHER\nELSE\nSTART\nENDIF\n"));
}

#[test]
fn arcs_through_elements_of_arrays_are_followed_from_one_beginning() {
    let list = |name: &str, x: f64, y: f64| {
        let element = |i: i32| {
            let by = 3.0 * f64::from(i);
            format!("[[{},{},350],{P}", x + by, y + by)
        };
        let all: Vec<String> = (0..16).map(element).collect();
        format!("CONST robtarget {name}{{16}}:=[{}];\n", all.join(","))
    };
    let data = list("a", 380.0, -60.0) + &list("b", 370.0, 10.0) + "VAR num i;";
    let start = format!("[[350,-60,350],{P}");
    let body = format!(
        "MoveAbsJ [[0,10,10,0,60,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;\nMoveL \
         {start},v100,fine,tool0;\nFOR i FROM 1 TO 16 DO\nMoveC \
         a{{i}},b{{i}},v100,fine,tool0;\nENDFOR"
    );
    let done = done(&[PLAIN], &[("t.mod", &rapid(&data, &body))]);
    assert_eq!(errors(&done), [""; 0], "{:?}", done.findings);
}

#[test]
fn another_tool_than_the_originals_is_an_error() {
    let text = with_two_tools(
        "",
        "MoveL [[380,40,350],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,t;",
        "",
    );
    let text = text.replace("MoveL p1,v100,fine,u;", "");
    let source = |text: &str| vec![Source::new("t.mod", text.as_bytes().to_vec())];
    let found = |written: &str| {
        let done = checked(&profile(&[PLAIN]), &source(written), Some(&source(&text)));
        let of = done.findings.iter().filter(|f| f.id == "tool-not-original");
        let of: Vec<(Severity, usize)> = of.map(|f| (f.severity, f.line)).collect();
        of
    };
    assert_eq!(found(&text), []);
    let other = text.replace("v100,fine,t;", "v100,fine,u;");
    assert_eq!(found(&other).len(), 2);
    assert!(found(&other).iter().all(|(of, _)| *of == Severity::Error));
    // the same name with other numbers
    assert_eq!(
        found(&text.replace("t:=[TRUE,[[0,0,100]", "t:=[TRUE,[[0,0,101]")).len(),
        2
    );
    assert_eq!(done(&[PLAIN], &[("t.mod", &text)]).refused, [false]);
}

#[test]
fn files_that_share_what_they_read_or_write_are_refused_together() {
    let c = format!(
        "MODULE C\n{TOOLS}\nCONST robtarget pa:=[[400,0,350],{P};\nPERS robtarget pc:=[[380,40,400],{P};\nPERS robtarget \
         pe{{2}}:=[[[380,40,410],{P},[[380,50,400],{P}];\nPROC \
         c()\nMoveAbsJ [[0,10,10,0,60,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,t;\nMoveL pa,v100,fine,t;\nMoveL \
         pc,v100,fine,t;\nENDPROC\nENDMODULE\n"
    );
    let b = |body: &str| {
        format!(
            "MODULE B\nVAR num n;\nCONST robtarget pd:=[[400,-40,350],{P};\nCONST robtarget \
             far:=[[4000,0,350],{P};\nPERS tooldata v:=[TRUE,[[0,0,90],[1,0,0,0]],[1,[0,0,50],[1,0,0,0],0,0,0]];\nPROC \
             b()\nMoveAbsJ [[0,10,10,0,60,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,v;\n{body}\nMoveL \
             pd,v100,fine,v;\nMoveL far,v100,fine,v;\nENDPROC\nPROC turn(INOUT robtarget \
             p)\np.trans.z:=410;\nENDPROC\nENDMODULE\n"
        )
    };
    let refused = |body: &str| {
        let done = done(&[PLAIN], &[("b.mod", &b(body)), ("c.mod", &c)]);
        assert!(
            errors(&done).contains(&"out-of-reach"),
            "{:?}",
            done.findings
        );
        done.refused
    };
    assert_eq!(refused(""), [true, false]);
    for body in [
        "n:=pc.trans.z;\nMoveL Offs(pd,0,0,n-400),v100,fine,v;",
        "pc.trans.z:=410;",
        "t.tframe.trans.z:=110;",
        "n:=GInput(g1);\npe{n}.trans.z:=410;",
        "turn pc;",
        "IF pc.trans.z>300 THEN\nWaitTime 1;\nENDIF",
    ] {
        assert_eq!(refused(body), [true, true], "{body}");
    }
}

/// Of many approaches the message names those that miss most: who accepts it decides by them.
#[test]
fn the_approaches_that_miss_most_are_named() {
    let lengths = [100, 104, 108, 112, 116, 120, 124, 128, 160];
    let tool = |mm: &i32| {
        format!("PERS tooldata t{mm}:=[TRUE,[[0,0,{mm}],[1,0,0,0]],[1,[0,0,50],[1,0,0,0],0,0,0]];")
    };
    let data = lengths.iter().map(tool).collect::<Vec<_>>().join("\n");
    let data = format!("{data}\nCONST robtarget p1:=[[400,0,350],{P};");
    let start = "MoveAbsJ [[0,10,10,0,60,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,t100;\n";
    let to = |mm: &i32| format!("MoveL p1,v100,fine,t{mm};\n");
    let body = start.to_owned() + &lengths.iter().map(to).collect::<String>();
    let done = try_with(given(), &[PLAIN], &[("t.mod", &rapid(&data, &body))]).expect("read");
    let shared = done.findings.iter().find(|f| f.id == "target-shared");
    let message = &shared.expect("it is of several tools").message;
    let misses: Vec<f64> = message
        .split(" mm, ")
        .filter_map(|before| before.rsplit(' ').next()?.parse().ok())
        .collect();
    assert_eq!(misses.len(), 6, "{message}");
    assert!(misses.is_sorted_by(|a, b| a >= b), "{message}");
    assert!(message.ends_with("and 3 more, by less"), "{message}");
}

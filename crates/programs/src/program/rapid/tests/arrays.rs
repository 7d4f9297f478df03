//! Elements of arrays: which are distinguished, and what is written into them.

use super::*;

/// Behind the statements of a routine: an array with values, and a routine that nothing calls.
const ARRAY: &str = "ENDPROC\nPERS robtarget a{2}:=[[[11,0,0],[1,0,0,0],CONF,[[12,0,0],[1,0,0,0],\
                     CONF];\nPROC last()";

fn both(statements: &str) -> (Vec<String>, Vec<&'static str>) {
    let program = path(statements);
    let names = to(&program).into_iter().map(str::to_owned).collect();
    (names, ids(&program))
}

#[test]
fn elements_without_values_are_variables_each() {
    for declaration in ["VAR robtarget q{2};\n", "VAR robtarget q{2}:=other;\n", ""] {
        let (names, said) = both(&format!(
            "{declaration}q{{1}}:=p1;\nq{{2}}:=p2;\nMoveL q{{1}},v5,z5,t;\nMoveL \
             q{{2}},v5,z5,t;\nq{{1}}:=p3;\nMoveL q{{1}},v5,z5,t;"
        ));
        assert_eq!(names, ["p1", "p2", "p3"], "{declaration}");
        assert_eq!(said, [""; 0], "{declaration}");
    }
    let (names, said) = both(
        "VAR robtarget q{2,2};\nq{1,1}:=p1;\nq{2,1}:=p2;\nMoveL q{1,1},v5,z5,t;\nFOR i FROM 1 TO \
         2 DO\nMoveL q{i,1},v5,z5,t;\nENDFOR",
    );
    assert_eq!((names, said), (strings(&["p1", "p1", "p2"]), vec![]));
}

fn strings(names: &[&str]) -> Vec<String> {
    names.iter().map(|&name| name.to_owned()).collect()
}

#[test]
fn elements_of_a_large_array_are_one_for_an_index_that_only_the_program_knows() {
    let filled: String = (1..=100)
        .map(|i| format!("q{{{i}}}:=p{};\n", 1 + i % 2))
        .collect();
    let (names, said) = both(&format!(
        "VAR robtarget q{{100}};\n{filled}MoveL q{{7}},v5,z5,t;\nMoveL q{{k}},v5,z5,t;"
    ));
    assert_eq!((names, said), (strings(&["p2", "p1", "p2"]), vec![]));
    let many: String = (1..=70)
        .map(|i| format!("q{{{i}}}:=[[{i},0,0],[1,0,0,0],CONF;\n"))
        .collect();
    let moves = "MoveL q{k},v5,z5,t;\n".repeat(50);
    let program = path(&format!(
        "VAR robtarget q{{70}};\n{many}{moves}MoveL q{{7}},v5,z5,t;"
    ));
    assert!(ids(&program).contains(&"too-many-uses"));
    assert!(
        program.moves.len() < 50 * 70,
        "each move once for each element"
    );
}

#[test]
fn an_element_that_only_the_program_knows_may_be_any() {
    let (names, said) =
        both("VAR robtarget q{3};\nq{1}:=p1;\nq{k}:=p2;\nMoveL q{1},v5,z5,t;\nMoveL q{j},v5,z5,t;");
    assert_eq!(
        (names[..2].to_vec(), said),
        (strings(&["p1", "p2"]), vec![])
    );
    assert!(names[2..].contains(&"p1".into()) && names[2..].contains(&"p2".into()));
    let (names, said) = both("VAR robtarget q{3};\nq{k}:=p2;\nMoveL q{2},v5,z5,t;");
    assert_eq!(
        (names, said),
        (strings(&["p2", "?"]), vec!["computed-target"]),
        "nothing may have written it"
    );
    let (names, said) = both(
        "VAR robtarget q{3};\nFOR i FROM 1 TO 3 DO\nq{i}:=p1;\nENDFOR\nq{k}:=p2;\nMoveL \
         q{j},v5,z5,t;",
    );
    assert_eq!((names, said), (strings(&["p1", "p2"]), vec![]));
    let (names, said) = both("VAR robtarget q{3};\nMoveL q{j},v5,z5,t;\nq{j}:=p1;");
    assert_eq!(
        (names, said),
        (strings(&["?"]), vec!["computed-target"]),
        "nothing has written it"
    );
}

#[test]
fn an_element_of_an_array_that_is_given_leaves_the_others() {
    let (names, said) = both(
        "CONST robtarget all{2}:=[p1,p3];\ngo all;\nENDPROC\nPROC go(robtarget \
         a{*})\na{2}:=p2;\nMoveL a{1},v5,z5,t;",
    );
    assert_eq!((names, said), (strings(&["p1", "p2", "p3"]), vec![]));
}

#[test]
fn what_a_routine_writes_into_an_element_by_reference_is_written() {
    for call in ["set a{k};", "ok:=ask(a{k});"] {
        let program = path(&format!(
            "{call}\nMoveL a{{2}},v5,z5,t;\nENDPROC\nPROC set(INOUT robtarget r)\nr:=p1;\nENDPROC\n\
             FUNC bool ask(INOUT robtarget r)\nr:=p1;\nRETURN TRUE;\nENDFUNC\nPROC more()\n{ARRAY}"
        ));
        let mut names = to(&program);
        names.dedup();
        assert_eq!(names, ["p1", "a{2}"], "{call}");
        assert_eq!(ids(&program), [""; 0], "{call}");
    }
    let program = path(&format!(
        "lift a{{k}};\nMoveL a{{2}},v5,z5,t;\nENDPROC\nPROC lift(INOUT robtarget \
         r)\nlift_it r;\nENDPROC\nPROC lift_it(INOUT robtarget r)\nr.trans.z:=5;\nENDPROC\nPROC \
         more()\n{ARRAY}"
    ));
    assert!(ids(&program).contains(&"target-assigned-at-run-time"));
    for call in ["set a{2};", "ok:=ask(a{2});", "ok:=ask(a{ 2 });"] {
        let program = path(&format!(
            "{call}\nMoveL a{{2}},v5,z5,t;\nMoveL a{{1}},v5,z5,t;\nENDPROC\nPROC set(INOUT \
             robtarget r)\nr.trans.z:=5;\nENDPROC\nFUNC bool ask(INOUT robtarget \
             r)\nr.trans.z:=5;\nRETURN TRUE;\nENDFUNC\nPROC more()\n{ARRAY}"
        ));
        assert_eq!(to(&program), ["?", "a{1}"], "{call}");
        assert_eq!(ids(&program), ["target-assigned-at-run-time"], "{call}");
    }
}

#[test]
fn what_a_routine_fills_is_what_it_writes() {
    let (names, said) = both(
        "VAR robtarget arr{2};\nfill arr;\nMoveL arr{1},v5,z5,t;\nENDPROC\nPROC fill(INOUT robtarget \
         p{*})\np{1}:=p1;\np{2}:=p2;",
    );
    assert_eq!((names, said), (strings(&["p1", "p2"]), vec![]));
}

#[test]
fn what_a_routine_writes_into_a_part_by_reference_is_written() {
    let program =
        path("lift p3.trans.z;\nMoveL p3,v5,z5,t;\nENDPROC\nPROC lift(INOUT num x)\nx:=x+1;");
    assert_eq!(to(&program), ["?"]);
    assert_eq!(ids(&program), ["target-assigned-at-run-time"]);
    let program = path(
        "look p3.trans.z;\nMoveL p3,v5,z5,t;\nENDPROC\nPROC look(INOUT num x)\nTPWrite \
         \"x\"\\Num:=x;",
    );
    assert_eq!((to(&program), ids(&program)), (vec!["p3"], vec![]));
}

#[test]
fn a_parameter_by_reference_is_the_variable_that_it_is_given() {
    for (sub, expected) in [
        // the routine writes the variable by its own name
        (
            "q:=p1;\nsub q;\nENDPROC\nPROC sub(INOUT robtarget p)\nq:=p2;\nMoveJ p,v5,z5,t;",
            "p2",
        ),
        (
            "a{1}:=p1;\nsub a{1};\nENDPROC\nPROC sub(INOUT robtarget p)\na{1}:=p2;\nMoveJ p,v5,z5,t;",
            "p2",
        ),
        // or through another parameter
        (
            "q:=p1;\nsub q,q;\nENDPROC\nPROC sub(INOUT robtarget p,INOUT robtarget r)\np:=p2;\nMoveJ r,v5,z5,t;",
            "p2",
        ),
        // or it is handed on
        (
            "q:=p1;\nouter q;\nENDPROC\nPROC outer(INOUT robtarget a)\nsub a;\nENDPROC\nPROC sub(INOUT robtarget p)\n\
             q:=p2;\nMoveJ p,v5,z5,t;",
            "p2",
        ),
        // a parameter by value is what it was
        (
            "q:=p1;\nsub q;\nENDPROC\nPROC sub(robtarget p)\nq:=p2;\nMoveJ p,v5,z5,t;",
            "p1",
        ),
    ] {
        let text = sub.replacen(
            "\nENDPROC",
            "\nENDPROC\nVAR robtarget q;\nVAR robtarget a{2};",
            1,
        );
        let program = path(&text);
        assert_eq!(to(&program), [expected], "{sub}");
    }
    let program = path(
        "q:=p1;\nsub q;\nENDPROC\nVAR robtarget q;\nPROC sub(INOUT robtarget p)\nq.trans.z:=q.trans.z+60;\n\
         MoveL p,v5,z5,t;",
    );
    assert!(matches!(program.moves[0].displacement, Displacement::By(_)));
}

#[test]
fn an_array_by_reference_that_the_routine_names_itself_is_refused() {
    for inside in [
        // what one name writes is gone to by the other
        "q{2}.trans.z:=60;\nMoveL a{2},v5,z5,t;",
        "a{2}:=p2;\nMoveL q{2},v5,z5,t;",
        "q{2}:=p2;\ndeeper;\nENDPROC\nPROC deeper()\nMoveL a{2},v5,z5,t;",
    ] {
        let program = path(&format!(
            "run a;\nENDPROC\nPROC run(INOUT robtarget q{{*}})\n{inside}\n{ARRAY}"
        ));
        assert!(
            ids(&program).contains(&"target-assigned-at-run-time"),
            "{inside}: {:?}",
            program.findings
        );
    }
    // by the parameter alone it is followed
    let program = path(&format!(
        "run a;\nENDPROC\nPROC run(INOUT robtarget q{{*}})\nMoveL q{{2}},v5,z5,t;\n{ARRAY}"
    ));
    assert_eq!(ids(&program), [""; 0], "{:?}", program.findings);
}

#[test]
fn a_tool_of_an_array_is_each_that_is_written_out() {
    let tool = |x: u32| format!("[TRUE,[[{x},0,100],[1,0,0,0]],[1.5,[0,0,50],[1,0,0,0],0,0,0]]");
    let of = |write: &str| {
        let tools = format!("PERS tooldata ta{{2}}:=[{},{}];", tool(1), tool(2));
        path(&format!(
            "{write}MoveL p1,v5,z5,ta{{i}};\nENDPROC\n{tools}\nPROC last()"
        ))
    };
    let program = of("");
    assert_eq!(ids(&program), [""; 0], "{:?}", program.findings);
    assert_eq!(program.moves.len(), 2);
    let program = of("ta{1}:=t;\n");
    assert!(ids(&program).iter().any(|id| id.starts_with("frame-")));
}

#[test]
fn what_a_loop_writes_anew_is_displaced_as_often_as_it_counts() {
    let counted = |statements: &str| {
        let program = read(&format!(
            "MODULE m\nCONST robtarget p1:=[[1,2,3],[1,0,0,0],CONF;\nVAR robtarget \
             a{{3}};\nVAR robtarget q;\nPROC main()\n{statements}\nENDPROC\nENDMODULE\n"
        ));
        let strides = program.moves.iter().filter_map(|motion| {
            let Displacement::Within(strides) = &motion.displacement else {
                return None;
            };
            let is_counted = |of: &Stride| matches!(of, Stride::By { most: Some(_), .. });
            Some(strides.iter().all(is_counted))
        });
        strides.collect::<Vec<_>>()
    };
    let fill = "FOR i FROM 1 TO 3 DO\na{i}:=Offs(p1,0,0,i*10);\nENDFOR\n";
    let go = "MoveL a{2},v5,z5,tool0;\n";
    // in another loop, and in one run after another
    for text in [
        format!("WHILE go DO\n{fill}{go}ENDWHILE"),
        format!("{fill}{go}"),
        format!("{go}{fill}"),
    ] {
        assert_eq!(counted(&text), [true], "{text}");
    }
    // what grows goes on growing
    let grows = "FOR i FROM 1 TO 3 DO\nq:=Offs(q,0,0,10);\nENDFOR\n";
    let text = format!("q:=p1;\nWHILE go DO\n{grows}MoveL q,v5,z5,tool0;\nENDWHILE");
    assert_eq!(counted(&text).last(), Some(&false));
}

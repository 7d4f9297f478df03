//! What built-in instructions write, wherever they stand.

use super::*;

/// The findings of code with two points and two joints.
fn found(code: &str) -> Vec<String> {
    let data = data("pA", "pointRx", &["key=\"0\" x=\"1\" fatherId=\"fA[0]\""])
        + &data("jA", "jointRx", &["key=\"0\" j3=\"90\""])
        + &data("jB", "jointRx", &["key=\"0\" j3=\"80\""]);
    // the controller keeps data from run to run
    let program = project(&data, &format!("jB=jA\n{code}"));
    let found = ids(&program).into_iter();
    // the point is there to be solved
    let found = found.filter(|id| *id != "target-unused-here");
    found.map(str::to_owned).collect()
}

#[test]
fn heads_of_blocks_write_what_they_solve() {
    const SOLVE: &str = "pointToJoint(tA,jA,pA,jB)";
    const GO: &str = "movej(jB,tA,m)";
    for code in [
        format!("while !{SOLVE}\ndelay(0)\nendWhile\n{GO}"),
        format!("while {SOLVE}\n{GO}\nendWhile"),
        format!("for n=solved({SOLVE}) to 3\n{GO}\nendFor"),
        format!("if n==1\nn=2\nelseIf {SOLVE}\n{GO}\nendIf"),
        format!("if n==1\nn=2\nelseIf {SOLVE}\nn=3\nelse\n{GO}\nendIf"),
        format!("if n==1\nn=2\nelseIf {SOLVE}\nn=3\nelseIf n==4\n{GO}\nendIf"),
        format!("if n==1\nn=2\nelseIf {SOLVE}\nn=3\nendIf\n{GO}"),
        format!("switch solved({SOLVE})\ncase 1\n{GO}\nbreak\nendSwitch"),
        format!("switch n\ncase 1\nbreak\ncase solved({SOLVE})\nbreak\ndefault\n{GO}\nendSwitch"),
        format!("call go(solved({SOLVE}))\n{GO}"),
    ] {
        assert!(
            found(&code).contains(&"computed-target".to_owned()),
            "{code}"
        );
    }
    // the heads of other branches come later
    for code in [
        format!("if n==1\n{GO}\nelseIf {SOLVE}\nn=3\nendIf"),
        format!("switch n\ncase 1\n{GO}\nbreak\ncase solved({SOLVE})\nbreak\nendSwitch"),
        format!("{GO}\nwhile !{SOLVE}\nendWhile"),
    ] {
        assert_eq!(found(&code), [""; 0], "{code}");
    }
}

#[test]
fn blocks_end_where_their_words_say() {
    // behind each block jB is what it was, or jA
    let code = "if n==1\nif n==2\nelseIf n==3\nelseIf n==4\nendIf\njB=jA\nelseIf n==5\nn=6\nelse\n\
        n=7\nendIf\nwhile n==8\nif n==9\nbreak\nendIf\nendWhile\nmovej(jB,tA,m)";
    let data = data("jA", "jointRx", &["key=\"0\" j3=\"90\""])
        + &data("jB", "jointRx", &["key=\"0\" j3=\"80\""]);
    let program = project(&data, code);
    let mut found: Vec<_> = program.moves.iter().map(|m| target(&program, m)).collect();
    found.sort_unstable();
    assert_eq!(found, [Some("jA"), Some("jB")]);
}

#[test]
fn parts_that_a_program_may_write_are_computed() {
    let all = data("tA", "tool", &[TOOL]) + &data("pA", "pointRx", &["key=\"0\" x=\"1\""]);
    for (by, expected) in [("reference", &["computed-target"][..]), ("value", &[])] {
        let parameter = format!(
            "<Parameters><Parameter name=\"x_t\" type=\"trsf\" use=\"{by}\" \
             xsi:type=\"element\" /></Parameters>"
        );
        let code = "call up(pA.trsf)\nmovel(pA,tA,m)";
        let files = [
            ("m.dtx", dtx(&all)),
            ("start.pgx", pgx("start", "", code)),
            ("up.pgx", pgx("up", &parameter, "x_t.z=x_t.z+nZ")),
        ];
        assert_eq!(
            ids(&read_files(&files).expect("a project")),
            expected,
            "{by}"
        );
    }
}

#[test]
fn latched_joints_are_computed() {
    assert_eq!(
        found("bOk=getLatch(jB)\nmovej(jB,tA,m)"),
        ["computed-target"]
    );
}

//! Branches that calls choose.

use super::*;

/// The x of the tools, in millimetres, with which the moves of a program run that calls `setup`.
fn set_up(lines: &str, setup: &str) -> Vec<String> {
    let program = read(&format!(
        "def main():\nGRIP=1\nk=get_standard_analog_in(0)\n{setup}\nset_tcp(p[0,0,0,0,0,0])\n{lines}\n\
         movel(p[.1,.2,.3,0,0,1])\nend\nmain()\n"
    ));
    let tools = program.moves.iter().map(|of| tool_x(&program, of.tool));
    let mut tools: Vec<String> = tools
        .map(|x| x.map_or(String::new(), |x| format!("{:.0}", x * 1000.0)))
        .collect();
    tools.sort_unstable();
    tools.dedup();
    tools
}

const BY_IF: &str = "def setup(n):\nif n==GRIP:\nset_tcp(p[.1,0,0,0,0,0])\nelif (n != 3):\n\
    set_tcp(p[.2,0,0,0,0,0])\nend\nend";
const BY_SWITCH: &str = "def setup(n):\nswitch n:\ncase 1:\nset_tcp(p[.1,0,0,0,0,0])\ncase 2:\n\
    set_tcp(p[.2,0,0,0,0,0])\nend\nend";

#[test]
fn numbers_and_constants_choose_their_branch() {
    for (call, text, tool) in [
        ("setup(1)", BY_IF, "100"),
        ("setup(GRIP)", BY_IF, "100"),
        ("setup(n=2)", BY_IF, "200"),
        ("setup( -1 )", BY_IF, "200"),
        ("setup(3)", BY_IF, "0"),
        ("setup(2)\nsetup(1)", BY_IF, "100"),
        ("setup(1)", BY_SWITCH, "100"),
        ("setup(2)", BY_SWITCH, "200"),
        ("setup(4)", BY_SWITCH, "0"),
    ] {
        assert_eq!(set_up(call, text), [tool], "{call} {text}");
    }
}

#[test]
fn what_words_join_chooses_the_branch() {
    let text = "def setup(n, far):\nif n==1 or n==GRIP+1 or (n==3 and not far):\n\
        set_tcp(p[.1,0,0,0,0,0])\nelif n!=1 and n!=3:\nset_tcp(p[.2,0,0,0,0,0])\nend\nend";
    for (call, tool) in [("setup(1, True)", "100"), ("setup(3, False)", "100")] {
        assert_eq!(set_up(call, text), [tool], "{call}");
    }
    // of the sum nothing is known
    for (call, tools) in [
        ("setup(3, True)", ["0", "100"]),
        ("setup(5, True)", ["100", "200"]),
    ] {
        let mut found = set_up(call, text);
        found.sort();
        assert_eq!(found, tools, "{call}");
    }
}

#[test]
fn flags_and_defaults_choose_their_branch() {
    let text = "def setup(far=True):\nif not far:\nset_tcp(p[.1,0,0,0,0,0])\nelse:\n\
        set_tcp(p[.2,0,0,0,0,0])\nend\nend";
    for (call, tool) in [
        ("setup(False)", "100"),
        ("setup(True)", "200"),
        ("setup(far=False)", "100"),
        ("setup()", "200"),
    ] {
        assert_eq!(set_up(call, text), [tool], "{call}");
    }
}

#[test]
fn what_chooses_may_be_handed_on() {
    let text = format!("def cell(m):\nsetup(m)\nend\n{BY_IF}");
    assert_eq!(set_up("cell(1)", &text), ["100"]);
    assert_eq!(set_up("cell(3)", &text), ["0"]);
}

/// What the text does not tell is not decided.
#[test]
fn branches_that_calls_do_not_choose_are_all_taken() {
    let before = |line: &str| BY_IF.replace("if n==GRIP", &format!("{line}\nif n==GRIP"));
    for (call, text) in [
        ("setup(k)", BY_IF.to_owned()),
        ("setup(GRIP+1)", BY_IF.to_owned()),
        ("if k>1:\nsetup(1)\nelse:\nsetup(2)\nend", BY_IF.to_owned()),
        ("setup(1)", before("n=n+1")),
        ("GRIP=2\nsetup(1)", BY_IF.to_owned()),
    ] {
        let tools = set_up(call, &text);
        assert!(tools.len() > 1, "{call} {text}: {tools:?}");
    }
}

/// What a name means where a function and what is around it have one is either.
#[test]
fn local_and_global_variables_of_one_name_are_both_meant() {
    let go =
        "def go(n):\nif n==1:\nset_tcp(p[.1,0,0,0,0,0])\nelse:\nset_tcp(p[.2,0,0,0,0,0])\nend\nend";
    let global = format!("global m=1\ndef f(m):\nglobal m=2\nend\nf(1)\n{go}");
    assert_eq!(set_up("go(m)", &global), ["100", "200"]);
    let written = format!("local A=1\ndef out():\nA=2\nend\n{go}\nout()");
    assert_eq!(set_up("go(A)", &written), ["100", "200"]);
    let around = format!("global A=1\n{go}\ndef o():\nlocal A=2\ndef a():\ngo(A)\nend\na()\nend");
    assert_eq!(set_up("o()", &around), ["100", "200"]);
    let later = format!("global A=1\n{go}\ndef f():\ngo(A)\nlocal A=2\nend");
    assert_eq!(set_up("f()", &later), ["100", "200"]);
    let branch = format!("global A=1\n{go}\ndef f():\nif k>1:\nlocal A=2\nend\ngo(A)\nend");
    assert_eq!(set_up("f()", &branch), ["100", "200"]);
    // one that is assigned first hides the global one, which stays as it is
    let hides = format!("global A=1\n{go}\ndef f():\nlocal A=2\nsleep(A)\nend\nf()");
    assert_eq!(set_up("go(A)", &hides), ["100"]);
    // behind its declaration, an assignment without a word is of the local one
    let again = format!("global A=1\n{go}\ndef f():\nlocal A=3\nA=2\ngo(A)\nend");
    assert_eq!(set_up("f()\ngo(A)", &again), ["100"]);
}

//! Branches that calls choose.

use super::frames::{CONFIG, used};
use super::*;

const NULL: &str = "$NULLFRAME";

/// The tool and base of each move of a program that calls `setup`, of which this is the text.
fn set_up(main: &str, setup: &str) -> (Vec<(String, String)>, Vec<&'static str>) {
    let main = format!("DEF M()\n$TOOL=$NULLFRAME\n$BASE=$NULLFRAME\n{main}\nEND\n");
    let files = [
        ("System/$config.dat", CONFIG),
        ("m.src", &*main),
        ("m.dat", DATA),
        ("setup.src", setup),
    ];
    let program = read_files(&files);
    let owned = |(tool, base): &(&str, &str)| ((*tool).to_owned(), (*base).to_owned());
    let mut of: Vec<_> = used(&program).iter().map(owned).collect();
    of.sort();
    of.dedup();
    (of, reported(&program))
}

fn with(tool: &str, base: &str) -> (Vec<(String, String)>, Vec<&'static str>) {
    (vec![(tool.to_owned(), base.to_owned())], vec![])
}

const BY_ENUM: &str = "DEF setup(b:IN,t:IN)\nDECL BASETYPE b\nDECL TOOLTYPE t\n\
    SWITCH t\nCASE #Cutter8\n$TOOL=TOOL_DATA[1]\nCASE #Cutter10,#Cutter12\n$TOOL=TOOL_DATA[2]\n\
    ENDSWITCH\nIF (b==#Table) THEN\n$BASE=BASE_DATA[1]\nELSE\n$BASE=BASE_DATA[2]\nENDIF\nEND\n";

#[test]
fn values_of_enum_choose_their_branch() {
    for (given, tool, base) in [
        ("#Table,#Cutter8", "TOOL_DATA[1]", "BASE_DATA[1]"),
        ("#TABLE, #cutter10", "TOOL_DATA[2]", "BASE_DATA[1]"),
        ("#Jig,#Cutter12", "TOOL_DATA[2]", "BASE_DATA[2]"),
        ("#Jig,#Drill", NULL, "BASE_DATA[2]"),
    ] {
        let found = set_up(&format!("setup({given})\nPTP XP1"), BY_ENUM);
        assert_eq!(found, with(tool, base), "{given}");
    }
}

#[test]
fn each_call_has_its_own_branch() {
    let (used, reported) = set_up(
        "setup(#Table,#Cutter8)\nPTP XP1\nsetup(#Jig,#Cutter10)\nPTP XP2",
        BY_ENUM,
    );
    let of = |tool: &str, base: &str| (tool.to_owned(), base.to_owned());
    let both = [
        of("TOOL_DATA[1]", "BASE_DATA[1]"),
        of("TOOL_DATA[2]", "BASE_DATA[2]"),
    ];
    assert_eq!((used, reported), (both.to_vec(), vec![]));
}

#[test]
fn numbers_and_flags_choose_their_branch() {
    let by_number = "DEF setup(n:IN,far:IN)\nINT n\nBOOL far\n$TOOL=TOOL_DATA[1]\n\
        IF n<>2 THEN\n$TOOL=TOOL_DATA[2]\nENDIF\n\
        IF NOT far THEN\n$BASE=BASE_DATA[1]\nELSE\n$BASE=BASE_DATA[2]\nENDIF\nEND\n";
    for (given, tool, base) in [
        ("2,TRUE", "TOOL_DATA[1]", "BASE_DATA[2]"),
        ("-2,FALSE", "TOOL_DATA[2]", "BASE_DATA[1]"),
        ("+2,false", "TOOL_DATA[1]", "BASE_DATA[1]"),
    ] {
        let found = set_up(&format!("setup({given})\nPTP XP1"), by_number);
        assert_eq!(found, with(tool, base), "{given}");
    }
}

#[test]
fn what_words_join_chooses_the_branch() {
    let setup = "DEF setup(n:IN,far:IN)\nINT n\nBOOL far\n$TOOL=TOOL_DATA[1]\n\
        IF (n==2) OR ((n==3) AND far) THEN\n$TOOL=TOOL_DATA[2]\nENDIF\n\
        IF NOT (far AND (n==2)) THEN\n$BASE=BASE_DATA[1]\nELSE\n$BASE=BASE_DATA[2]\nENDIF\nEND\n";
    for (given, tool, base) in [
        ("2,TRUE", "TOOL_DATA[2]", "BASE_DATA[2]"),
        ("2,FALSE", "TOOL_DATA[2]", "BASE_DATA[1]"),
        ("3,TRUE", "TOOL_DATA[2]", "BASE_DATA[1]"),
        ("3,FALSE", "TOOL_DATA[1]", "BASE_DATA[1]"),
    ] {
        let found = set_up(&format!("setup({given})\nPTP XP1"), setup);
        assert_eq!(found, with(tool, base), "{given}");
    }
}

#[test]
fn what_chooses_may_be_handed_on() {
    let text = format!(
        "DEF cell(b:IN)\nDECL BASETYPE b\nsetup(b,#Cutter8)\nEND\n\
         GLOBAL {BY_ENUM}"
    );
    for (given, base) in [("#Table", "BASE_DATA[1]"), ("#Jig", "BASE_DATA[2]")] {
        let found = set_up(&format!("cell({given})\nPTP XP1"), &text);
        assert_eq!(found, with("TOOL_DATA[1]", base), "{given}");
    }
}

#[test]
fn a_number_that_also_chooses_an_entry_chooses_its_branch() {
    let both = "DEF setup(n:IN)\nINT n\n$TOOL=TOOL_DATA[n]\nIF n==1 THEN\n$BASE=BASE_DATA[1]\n\
        ELSE\n$BASE=BASE_DATA[2]\nENDIF\nEND\n";
    for (given, tool, base) in [
        ("1", "TOOL_DATA[1]", "BASE_DATA[1]"),
        ("2", "TOOL_DATA[2]", "BASE_DATA[2]"),
    ] {
        let found = set_up(&format!("setup({given})\nPTP XP1"), both);
        assert_eq!(found, with(tool, base), "{given}");
    }
}

/// What the text does not tell is not decided.
#[test]
fn branches_that_calls_do_not_choose_are_both_taken() {
    let branches = "IF n==1 THEN\n$BASE=BASE_DATA[1]\nELSE\n$BASE=BASE_DATA[2]\nENDIF\n";
    let setup = |head: &str, before: &str| format!("DEF {head}\nINT n\n{before}{branches}END\n");
    let mine = setup("setup(n:IN)", "");
    let written = "DEF other(m:OUT)\nINT m\nm=2\nEND\n";
    let read = "DEF other(m:OUT)\nINT m\nWAIT SEC m\nEND\n";
    for (call, text) in [
        ("setup(k)", mine.clone()),
        ("setup(1+k)", mine.clone()),
        ("IF $IN[1] THEN\nsetup(1)\nELSE\nsetup(2)\nENDIF", mine),
        ("setup(1)", setup("setup(n:IN)", "n=n+1\n")),
        ("setup(1)", setup("setup(n:IN)", "FOR n=1 TO 2\nENDFOR\n")),
        ("setup(1)", setup("setup(n:IN)", "outside(n)\n")),
        ("setup(1)", setup("setup(n:IN)", "COPEN(:SER_1,n)\n")),
        ("setup(1)", setup("setup(n:IN)", "k=INVERSE(XP1,XHOME,n)\n")),
        (
            "setup(1)",
            format!("{}{written}", setup("setup(n:IN)", "other(n)\n")),
        ),
        (
            "setup(1)",
            setup("setup(n:IN)", "INTERRUPT DECL 3 WHEN $IN[1]==TRUE DO n=2\n"),
        ),
    ] {
        let (used, _) = set_up(&format!("INT k\nk=$ANIN[1]\n{call}\nPTP XP1"), &text);
        let bases: Vec<&str> = used.iter().map(|(_, base)| base.as_str()).collect();
        assert_eq!(bases, ["BASE_DATA[1]", "BASE_DATA[2]"], "{call} {text}");
    }
    let only_read = format!("{}{read}", setup("setup(n:IN)", "other(n)\n"));
    let found = set_up("setup(1)\nPTP XP1", &only_read);
    assert_eq!(found, with(NULL, "BASE_DATA[1]"));
}

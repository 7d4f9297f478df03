//! Moves between those of a program, and where the marker stands.

use super::projects::pjx;
use super::*;
use crate::program::{Between, Insertion};

/// What is put before each move of a file, one target each.
fn inserted(files: &[(&str, String)], file: usize) -> (Vec<Source>, Inserted) {
    let source = |(name, text): &(&str, String)| Source::new(*name, text.as_bytes().to_vec());
    let sources: Vec<_> = files.iter().map(source).collect();
    let program = crate::motion::read(&Val3, &sources, &Settings::default()).expect("a project");
    let numbers: Vec<Vec<u8>> = (1..=6).map(|number| vec![b'0' + number]).collect();
    let each = (0..program.moves.len()).map(|motion| Insertion {
        motion,
        between: vec![Between {
            via: None,
            end: numbers.clone(),
        }],
        own: None,
    });
    let list: Vec<_> = each.collect();
    let inserted = Val3.insert(&Insertions {
        sources: &sources,
        program: &program,
        file,
        list: &list,
    });
    (sources, inserted)
}

fn point(name: &str) -> String {
    data(name, "pointRx", &["key=\"0\" x=\"1\""])
}

#[test]
fn nothing_is_inserted_where_the_point_is_of_another_project() {
    let local = "<Locals><Local name=\"l_p\" type=\"pointRx\" xsi:type=\"array\" size=\"1\" \
        /></Locals>";
    let code = "movel(pB,flange,m)\nl_p=a:pA\nmovel(l_p,flange,m)\nmovel(a:pA,flange,m)";
    let files = [
        ("Main/Main.pjx", pjx("Main.dtx", "../Rack/Rack.pjx")),
        ("Main/Main.dtx", dtx(&point("pB"))),
        ("Main/start.pgx", pgx("start", local, code)),
        ("Rack/Rack.pjx", pjx("Rack.dtx", "")),
        ("Rack/Rack.dtx", dtx(&point("pA"))),
    ];
    let (_, inserted) = inserted(&files, 2);
    let is_inserted: Vec<_> = inserted.moves.iter().map(Option::is_some).collect();
    assert_eq!(is_inserted, [true, false, false]);
    let elsewhere: Vec<_> = inserted.elsewhere.iter().map(|(file, _)| *file).collect();
    assert_eq!(elsewhere, [1]);
}

#[test]
fn new_points_have_names_that_nothing_else_has() {
    let local = "<Locals><Local name=\"pShift2_0\" type=\"num\" xsi:type=\"array\" size=\"1\" \
        /></Locals>";
    let code = "movel(pA,flange,m)\nmovel(pB,flange,m)";
    let files = [
        ("m/a.dtx", dtx(&point("pA"))),
        ("m/b.dtx", dtx(&point("pB"))),
        ("m/start.pgx", pgx("start", local, code)),
    ];
    let (sources, inserted) = inserted(&files, 2);
    let declared = inserted.elsewhere.iter().map(|(_, changes)| {
        let text = Source::text(&changes[0].1).into_owned();
        let name = text.split("name=\"").nth(1).expect("a declaration");
        name.split('"').next().expect("a name").to_owned()
    });
    let declared: Vec<String> = declared.collect();
    assert_eq!(declared.len(), 2);
    assert_ne!(declared[0], declared[1]);
    for (name, changes) in declared.iter().zip(inserted.moves) {
        let changes = changes.expect("a move");
        let text = Source::text(&changes[0].1).into_owned();
        assert!(text.contains(&format!("movel({name},")), "{name} {text}");
        let mut all = sources.iter().map(|source| Source::text(&source.bytes));
        assert!(all.all(|text| !text.contains(name.as_str())), "{name}");
    }
}

#[test]
fn the_marker_stands_behind_the_begin_of_the_code() {
    let local = "<Locals><Local name=\"beginAt\" type=\"num\" xsi:type=\"array\" size=\"1\" \
        /></Locals>";
    let marker = Marker {
        version: "1".into(),
        profile_sha256: "a".into(),
        source_sha256: "b".into(),
        decided: Vec::new(),
    };
    let text = pgx("beginCycle", local, "beginAt=1");
    let code = text.find("[begin\n").expect("the code") + "[begin\n".len();
    let (at, comment) = Val3.mark(&Source::new("a.pgx", text.clone().into()), &marker);
    assert_eq!((at, comment.starts_with(b"// ")), (code, true));
    // no line of code follows it
    let text = text.replace("begin\nbeginAt=1\nend", "begin");
    let (at, comment) = Val3.mark(&Source::new("a.pgx", text.clone().into()), &marker);
    assert!(at >= text.find("</Program>").expect("the end"), "{at}");
    assert!(Source::text(&comment).contains("<!--"));
}

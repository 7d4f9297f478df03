//! What functions of `URScript` do wherever they are called: in conditions, threads and other files,
//! as parameters and as results.

use super::displaced::{misses, of_language, of_urscript};
use super::{P, PLAIN, done, errors, fakes, rapid};
use poseshift::compensate::Compensation;

const ARM: &str = "robots/universal_robots_ur5.yaml";
const HOME: &str = "movej([0,-1.2,1.5,-1.8,-1.5,0])\n";
const GO: &str = "movel(p[0.43,0.1,0.3,0.0,3.14159,0.0])\n";
const ONE: &str = "set_tcp(p[0,0,0.1,0,0,0])\n";
const OTHER: &str = "set_tcp(p[0.02,0,0.2,0,0.3,0])\n";

fn read(files: &[(&str, &str)]) -> Compensation {
    of_language(ARM, &[PLAIN], files)
}

/// A program that has come home with the first tool, functions before it.
fn program(functions: &str, body: &str) -> String {
    format!("def t():\n{functions}{ONE}{HOME}{body}end\n")
}

fn of(functions: &str, body: &str) -> Compensation {
    read(&[("t.script", &program(functions, body))])
}

#[test]
fn what_stands_behind_and_or_or_may_not_be_called() {
    let functions = format!("def s():\n{OTHER}return True\nend\ndef g(a, b):\nreturn a\nend\n");
    let plain = fakes(&of("", &format!("{OTHER}{GO}")));
    assert_ne!(plain, fakes(&of("", GO)));
    for open in [
        "if x and s():\nsync()\nend\n",
        "if x or s():\nsync()\nend\n",
        "if (x and (y == s())):\nsync()\nend\n",
        "while x and s():\nsync()\nend\n",
        "if x:\nsync()\nelif y and s():\nsync()\nend\n",
        "if x:\nsync()\nelif s():\nsync()\nend\n",
        "y = x and s()\n",
        "y = [1, x or s()]\n",
        "g(x and s(), y)\n",
        "set_digital_out(1, x and s())\n",
    ] {
        let done = of(&functions, &format!("{open}{GO}"));
        assert_eq!(
            errors(&done),
            ["target-shared"],
            "{open}: {:?}",
            done.findings
        );
        // --split-targets cannot help
        let mut shared = done.findings.iter().filter(|f| f.id == "target-shared");
        let hint = shared.next().map(|f| f.hint.as_str());
        assert!(hint.is_some_and(|hint| hint.starts_with("the approaches of one line are unlike")));
    }
    for certain in [
        "if s() and x:\nsync()\nend\n",
        "if not s():\nsync()\nend\n",
        "while s() or x:\nsync()\nend\n",
        // the first condition is never true: the second is always asked
        "if False:\nsync()\nelif s():\nsync()\nend\n",
        "y = g(x and y, s())\n",
        "y = [x and y, s()]\n",
        "y = x and y\ns()\n",
    ] {
        let done = of(&functions, &format!("{certain}{GO}"));
        assert_eq!(fakes(&done), plain, "{certain}");
    }
}

#[test]
fn a_load_that_may_not_be_set_is_not_certain() {
    let soft = "{effect: joint_compliance, joint: 2, rad_per_n_m: 3e-5}";
    let with = |functions: &str, body: &str| {
        let text = program(functions, &format!("{body}{GO}"));
        errors(&of_language(ARM, &[soft], &[("t.script", &text)]))
    };
    let load = "set_payload(4, [0, 0, 0.1])\n";
    let thread = format!("thread h():\n{load}end\n");
    assert_eq!(with("", load), [""; 0]);
    assert_eq!(with(&thread, "run h()\n"), ["target-shared"]);
    let maybe = format!("if x:\n{load}end\n");
    assert_eq!(with("", &maybe), ["target-shared"]);
    let same = format!("{load}if x:\n{load}end\n");
    assert_eq!(with(&thread, &format!("{load}run h()\n")), [""; 0]);
    assert_eq!(with("", &same), [""; 0]);
}

#[test]
fn functions_of_another_file_are_followed() {
    let function = format!("def f():\n{OTHER}end\n");
    let given = "def f(t):\nset_tcp(t)\nend\n";
    for (functions, call) in [
        (&*function, "f()\n"),
        (given, "f(p[0.02,0,0.2,0,0.3,0])\n"),
        (&format!("{ONE}{function}"), "f()\n"),
    ] {
        let body = format!("{call}{GO}");
        let main = program("", &body);
        let alone = fakes(&of("", &format!("{OTHER}{GO}")));
        for files in [
            [("a.script", &*main), ("b.script", functions)],
            [("a.script", functions), ("b.script", &*main)],
        ] {
            assert_eq!(fakes(&read(&files)), alone, "{functions}");
        }
    }
}

#[test]
fn positions_of_another_file_are_rewritten_in_it() {
    let library = format!("\u{feff}# moves\r\ndef f():\r\n{GO}end\r\n");
    let main = program("", &format!("{OTHER}f()\n"));
    let alone = of("", &format!("{OTHER}{GO}"));
    let done = read(&[("a.script", &main), ("b.script", &library)]);
    assert_eq!(fakes(&done), fakes(&alone));
    assert!(done.edits[0].is_empty());
    let written = |done: &Compensation, file: usize, text: &str| {
        let bytes = done.edits[file].apply(text.as_bytes());
        let text = String::from_utf8(bytes).expect("UTF-8");
        let line = text.lines().find(|line| line.starts_with("movel"));
        line.expect("a move").to_owned()
    };
    let inside = program("", &format!("{OTHER}{GO}"));
    let line = written(&alone, 0, &inside);
    assert_ne!(line, GO.trim_end());
    assert_eq!(written(&done, 1, &library), line);
}

#[test]
fn each_of_several_files_has_its_own_functions_and_state() {
    let one = fakes(&of("", GO));
    let other = fakes(&of("", &format!("{OTHER}{GO}")));
    let library = format!("def f():\n{OTHER}end\ndef h():\nf()\nend\n");
    let own = format!("def f():\n{ONE}end\n");
    let files = |body: &str| {
        let main = program(&own, body);
        fakes(&read(&[("a.script", &main), ("b.script", &library)]))
    };
    assert_eq!(files(&format!("h()\n{GO}")), other);
    assert_eq!(files(&format!("h()\nf()\n{GO}")), one);
    // text outside functions begins anew in each file, whichever was there before
    let calls = format!("{ONE}{HOME}h()\n{GO}");
    let bare = format!("{ONE}{HOME}g()\n{GO}");
    let library = format!("{library}def g():\nsync()\nend\n");
    let all = [
        ("a.script", &*calls),
        ("b.script", &library),
        ("c.script", &bare),
    ];
    assert_eq!(fakes(&read(&all)), [other, one].concat());
}

#[test]
fn joints_that_an_inverse_starts_from_are_those_of_every_call() {
    let near = "[0,-1.2,1.5,-1.8,-1.5,0]";
    let far = "[0,0.3,-1.5,-1.8,-1.5,0]";
    let go = |near: &str| {
        format!("movej(get_inverse_kin(p[0.43,0.1,0.3,0.0,3.14159,0.0], qnear={near}))\n")
    };
    let function = format!("def f(q):\n{}end\n", go("q"));
    let plain = fakes(&of("", &go(far)));
    assert_ne!(plain, fakes(&of("", &go(near))));
    for (functions, body) in [
        (&*function, format!("f({far})\n")),
        (&function, format!("f({far})\nf({far})\n")),
        (&function, format!("k={far}\nf(k)\n")),
        ("", format!("k=[{near},{far}]\n{}", go("k[1]"))),
    ] {
        assert_eq!(fakes(&of(functions, &body)), plain, "{body}");
    }
    for (functions, body) in [
        (&*function, format!("f({far})\nf({near})\n")),
        (&function, "f(read())\n".to_owned()),
        ("", format!("k={far}\nif x:\nk={near}\nend\n{}", go("k"))),
        ("", format!("k={far}\nk[1]=x\n{}", go("k"))),
    ] {
        let done = of(functions, &body);
        assert_eq!(errors(&done), ["inverse-start-unknown"], "{body}");
    }
}

#[test]
fn poses_made_of_known_ones_are_worked_out() {
    let by = "p[0,0,-0.1,0,0,0]";
    let goes = format!("movel(pose_trans(w,{by}))\n");
    let truth = misses(&of_urscript("", &goes));
    assert!(truth[0] > 0.05);
    let function = format!("def back(p0):\nreturn pose_trans(p0,{by})\nend\n");
    let half = "p[0,0,-0.05,0,0,0]";
    for (functions, body) in [
        (
            "",
            format!("movel(pose_trans(pose_trans(w,{half}),{half}))\n"),
        ),
        ("", format!("l=[w]\nmovel(pose_trans(l[i],{by}))\n")),
        ("", format!("l=[w,{half}]\nmovel(pose_trans(l[0],{by}))\n")),
        (&*function, "movel(back(w))\n".into()),
    ] {
        assert_eq!(misses(&of_urscript(functions, &body)), truth, "{body}");
    }
    let other = fakes(&of("", &format!("{OTHER}{GO}")));
    let tool = "p[0.02,0,0.2,0,0.3,0]";
    for (functions, body) in [
        ("", format!("l=[p[0,0,0.1,0,0,0],{tool}]\nset_tcp(l[1])\n")),
        ("", format!("l=[{tool}]\nset_tcp(l[i])\n")),
        ("", format!("a={tool}\nl=[a]\nset_tcp(l[0])\n")),
        (
            &format!("def f():\nreturn {tool}\nend\n"),
            "set_tcp(f())\n".into(),
        ),
    ] {
        assert_eq!(
            fakes(&of(functions, &format!("{body}{GO}"))),
            other,
            "{body}"
        );
    }
    // which of several, or what of one that changes, only the running program knows
    for body in [
        format!("l=[p[0,0,0.1,0,0,0],{tool}]\nset_tcp(l[i])\n"),
        format!("l=[{tool}]\nl[0]=p[0,0,0.1,0,0,0]\nset_tcp(l[0])\n"),
        format!("a={tool}\nl=[a]\na=p[0,0,0.1,0,0,0]\nset_tcp(l[0])\n"),
    ] {
        let done = of("", &format!("{body}{GO}"));
        assert_eq!(errors(&done), ["frame-chosen-at-run-time"], "{body}");
    }
}

#[test]
fn what_neither_moves_nor_sets_anything_is_called_as_often_as_you_like() {
    // followed call by call these would be sixteen million statements
    let idle = "def a():\nx = 1\nsync()\nend\n".to_owned();
    let chain = |idle: String, (inner, outer): (&str, &str)| {
        let calls = format!("{inner}()\n").repeat(20);
        format!("{idle}def {outer}():\n{calls}end\n")
    };
    let names = ["a", "b", "c", "d", "e"];
    let functions = names
        .windows(2)
        .fold(idle, |idle, pair| chain(idle, (pair[0], pair[1])));
    let busy = format!("def tool():\n{OTHER}end\n");
    let body = format!("tool()\n{}{GO}", "e()\n".repeat(20));
    let found = of(&format!("{functions}{busy}"), &body);
    assert_eq!(fakes(&found), fakes(&of("", &format!("{OTHER}{GO}"))));
}

/// The operator may start a routine that only text calls that nothing reaches.
#[test]
fn routines_that_only_dead_text_calls_are_corrected() {
    let data = format!("CONST robtarget p := [[400,0,300],{P};\n");
    let moves = |dead: &str| {
        let main = format!("WHILE TRUE DO\nWaitTime 1;\nENDWHILE\n{dead}");
        let clean = "PROC clean()\nwipe;\nENDPROC\nPROC wipe()\nMoveJ p,v100,fine,tool0;";
        rapid(&data, &format!("{main}\nENDPROC\n{clean}"))
    };
    let uncalled = done(&[PLAIN], &[("t.mod", &moves(""))]);
    let called = done(&[PLAIN], &[("t.mod", &moves("clean;"))]);
    assert_eq!(fakes(&called), fakes(&uncalled), "{:?}", called.findings);
    assert_eq!(fakes(&called).len(), 1);
}

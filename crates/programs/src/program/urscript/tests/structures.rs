//! Members of structures, copies by elements, displacements backwards, names of inner functions.

use super::*;
use crate::program::{Displacement, Shift, Stride};

const W: &str = "w=p[.1,.2,.3,0,0,1]\n";

/// What all moves go to, and what is found.
fn gone_to(program: &Program) -> (String, String) {
    (to(program).join(" "), ids(program).join(" "))
}

/// By what the last move is displaced.
fn shift(program: &Program) -> &Shift {
    match &program.moves.last().expect("a move").displacement {
        Displacement::By(shift) => shift,
        other => panic!("{other:?}"),
    }
}

#[test]
fn members_of_structures_are_what_they_are_made_of() {
    let s = format!("{W}s=struct(a=w,b=2)\n");
    for go in [
        "movel(s.a)",
        "t=s\nmovel(t.a)",
        "x=s.a\nmovel(x)",
        "def f(t):\nmovel(t.a)\nend\nf(s)",
        "def f(t):\nmovel(t.a)\nend\nf(struct(a=w,b=3))",
        "movel(s.a)\ns.b=3",
    ] {
        let program = path(&format!("{s}{go}"));
        assert_eq!(gone_to(&program), ("w".into(), String::new()), "{go}");
        assert_eq!(program.moves[0].displacement, Displacement::None, "{go}");
    }
    // the tool of the move, the displacement of the member
    let program = path(&format!(
        "movel(w)\n{s}movel(pose_add(s.a,p[0,0,0.2,0,0,0]))"
    ));
    assert_eq!(shift(&program).in_frame.translation, [0.0, 0.0, 0.2]);
    // one of several
    let v = "v=p[.1,.2,.4,0,0,1]\n";
    for more in ["s.a=v", "s=struct(a=v)", "if c:\ns=struct(b=1,a=v)\nend"] {
        let program = path(&format!("{s}{v}{more}\nmovel(s.a)"));
        assert_eq!(to(&program), ["w", "v"], "{more}");
    }
    let program = path(&format!("{s}{v}s.b=v\nmovel(s.a)"));
    assert_eq!(to(&program), ["w"]);
}

#[test]
fn a_member_is_also_what_another_member_was() {
    let s = format!("{W}v=p[.1,.2,.4,0,0,1]\ns=struct(a=w,b=v)\n");
    let set = "s.a=s.b\n";
    for go in [
        "s.a=s.b\nmovel(s.a)",
        "t=s\nt.a=t.b\nmovel(t.a)",
        "def f():\ns.a=s.b\nend\nf()\nmovel(s.a)",
        "def f(t):\nmovel(t.a)\nend\ns.a=s.b\nf(s)",
        "s.c=s.b\ns.a=s.c\nmovel(s.a)",
        "s.a=s.b\ns.b=s.a\nmovel(s.a)",
        "x=s.b\ns.a=x\nmovel(s.a)",
    ] {
        let program = path(&format!("{s}{go}"));
        assert_eq!(to(&program), ["w", "v"], "{go}");
        let displacement = &program.moves.last().expect("a move").displacement;
        assert_eq!(*displacement, Displacement::None, "{go}");
    }
    // neither the first value alone is the tool or the feature
    let move_with = |more: &str| path(&format!("{s}{set}{more}"));
    for more in [
        "set_tcp(s.a)\nmovel(p[.3,.2,.4,0,0,1])",
        "movel(pose_trans(s.a,p[.3,.2,.4,0,0,1]))",
    ] {
        let program = move_with(more);
        assert!(program.targets.iter().any(|t| t.blocked), "{more}");
        let plain = more.replace("s.a", "s.b");
        let plain = path(&format!("{s}{plain}"));
        assert!(!plain.targets.iter().any(|t| t.blocked), "{more}");
    }
}

#[test]
fn numbers_of_a_call_are_given_by_place_by_name_or_by_default() {
    for (default, given) in [
        ("", "f(w, 0.15)"),
        ("", "f(w, d=0.15)"),
        ("", "f(d=0.15, x=w)"),
        ("=0.15", "f(w)"),
        ("=0.15", "f(x=w)"),
        ("=0.02", "f(w, d=0.15)"),
    ] {
        let program = path(&format!(
            "{W}def f(x, d{default}):\nmovel(pose_trans(x,p[0,0,-d,0,0,0]))\nend\nmovel(w)\n{given}"
        ));
        let all = program.moves.iter().map(|motion| &motion.displacement);
        let known: Vec<&Displacement> = all.filter(|by| **by != Displacement::None).collect();
        let by = match known[..] {
            [Displacement::By(shift)] => &**shift,
            [Displacement::Within(strides)] => match &**strides {
                [Stride::By { shift, .. }] => shift,
                _ => panic!("{given}: {strides:?}"),
            },
            _ => panic!("{given}: {known:?}"),
        };
        assert_eq!(by.in_tool.translation, [0.0, 0.0, -0.15], "{given}");
    }
}

#[test]
fn what_is_made_of_a_structure_somehow_takes_its_correction_along() {
    let s = format!("{W}movel(w)\ns=struct(a=w,b=2)\n");
    for go in [
        "s.a[2]=.5\nmovel(s.a)",
        "movel(p[s.a[0],s.a[1],s.b,0,0,0])",
        "r=struct(t=s)\nmovel(r.t.a)",
        "x=interpolate_pose(s.a,s.a,0.5)\nmovel(x)",
        "h=s.a[2]+0.1\nmovel(p[h,h,h,0,0,0])",
    ] {
        let program = path(&format!("{s}{go}"));
        let last = program.moves.last().expect("a move");
        assert_eq!(to(&program), ["w", "w"], "{go}");
        assert!(
            matches!(
                last.displacement,
                Displacement::Unbounded | Displacement::Overwritten
            ),
            "{go}: {:?}",
            last.displacement
        );
    }
    // what is written into a structure in a structure by its name counts behind that, and not before
    for go in [
        "r=struct(b=struct(c=w))\nmovel(r.b.c)\nr.b.c=p[.1,.2,.4,0,0,1]",
        "r=struct(t=s)\nmovel(r.t.a)\nr.t.a=p[.1,.2,.4,0,0,1]",
    ] {
        let program = path(&format!("{s}{go}"));
        let last = program.moves.last().expect("a move");
        assert!(
            ids(&program).contains(&"computed-target")
                || last.displacement == Displacement::Unbounded,
            "{go}: {last:?}"
        );
    }
    // no structure of the file
    for go in ["movel(s.a)", "s=rpc_factory(\"x\",\"y\")\nmovel(s.pose)"] {
        let program = path(&format!("{W}movel(w)\n{go}"));
        let found = ("w ?".into(), "computed-target".into());
        assert_eq!(gone_to(&program), found, "{go}");
    }
}

#[test]
fn a_copy_by_elements_goes_to_what_it_copies() {
    for go in [
        "movel(p[w[0],w[1],w[2],w[3],w[4],w[5]])",
        "y=p[w[0],w[1],w[2],w[3],w[4],w[5]]\nmovel(y)",
    ] {
        let program = path(&format!("{W}{go}"));
        assert_eq!(gone_to(&program), ("w".into(), String::new()), "{go}");
    }
    let program = path(&format!("{W}movel(p[w[0],w[1],w[2]+0.04,w[3],w[4],w[5]])"));
    assert_eq!(to(&program), ["w"]);
    assert_eq!(shift(&program).in_frame.translation, [0.0, 0.0, 0.04]);
    // where the robot is
    let program = path("w=get_actual_tcp_pose()\nmovel(p[w[0],w[1],w[2],w[3],w[4],w[5]])");
    assert_eq!(to(&program), ["?"]);
}

#[test]
fn what_an_inner_function_assigns_without_global_may_be_its_own() {
    let lines = |reach: &str| {
        format!(
            "{W}v=p[.1,.2,.4,0,0,1]\n{reach}c=w\ndef f():\n{reach}c=v\nmovel(c)\nend\nf()\nmovel(c)"
        )
    };
    let mut found = to(&path(&lines("")));
    found.sort_unstable();
    found.dedup();
    assert_eq!(found, ["v", "w"]);
    let program = path(&lines("global "));
    assert_eq!(to(&program), ["v", "v"]);
    // what stands outside functions is shared, also next to other files
    let own = Source::new("a.script", lines("").into_bytes());
    let other = Source::new(
        "b.script",
        b"def g():\nmovel(p[.1,.2,.5,0,0,1])\nend\n".to_vec(),
    );
    for sources in [vec![own.clone()], vec![own, other]] {
        let program = read_sources(&sources).expect("a program");
        assert_eq!(to(&program)[..2], ["v", "v"]);
    }
}

#[test]
fn what_is_displaced_by_an_inverse_is_the_target() {
    for by in ["pose_inv(p[0,0,0.1,0,0,0])", "n"] {
        let program = path(&format!(
            "n=pose_inv(p[0,0,0.1,0,0,0])\n{W}movel(pose_trans(w,{by}))"
        ));
        assert_eq!(to(&program), ["w"], "{by}");
        assert_eq!(shift(&program).in_tool.translation, [0.0, 0.0, -0.1]);
    }
}

#[test]
fn what_calls_make_of_a_target_takes_its_correction_along() {
    let functions = "def pair(x):\nreturn struct(at=x,above=pose_trans(x,p[0,0,-.1,0,0,0]))\nend\n\
                     def list(x):\nreturn [x,pose_trans(x,p[0,0,-.1,0,0,0])]\nend\n\
                     def off(h):\nreturn p[0,0,h,0,0,0]\nend\n\
                     def up(x,h):\nreturn pose_trans(x,off(h))\nend\n";
    for go in [
        "movel(pair(w).above)",
        "movel(list(w)[1],a=1)",
        "l=list(w)\nmovel(l[1])",
        "movel(pose_trans(up(w,-.1),off(-.05)))",
        "movej(get_inverse_kin(list(w)[1]))",
        "q=pair(w)\nmovel(q.above)",
    ] {
        let program = path(&format!("{functions}{W}movel(w)\n{go}"));
        assert_eq!(to(&program)[..2], ["w", "w"], "{go}");
        assert_eq!(
            program.moves[1].displacement,
            Displacement::Unbounded,
            "{go}"
        );
    }
    // how fast is not where
    let program = path(&format!(
        "{functions}{W}movel(w)\nmovel(list(sensor())[1],a=w[0])"
    ));
    assert_eq!(to(&program), ["w", "?"]);
}

#[test]
fn members_that_a_called_function_writes_are_what_its_calls_give() {
    let s = format!("{W}v=p[.1,.2,.4,0,0,1]\ns=struct(a=v,b=2)\nl=[v,v]\n");
    let put = "def put(x):\ns.a=x\nl[0]=x\nend\n";
    for go in [
        "put(w)\nmovel(s.a)",
        "put(x=w)\nmovel(s.a)",
        "def twice(y):\nput(y)\nend\ntwice(w)\nmovel(s.a)",
    ] {
        let program = path(&format!("{s}{put}{go}"));
        assert_eq!(
            gone_to(&program),
            ("v w".into(), String::new()),
            "{go} {:?}",
            program.findings
        );
    }
    let program = path(&format!("{s}{put}put(w)\nmovel(l[0])"));
    assert!(to(&program).contains(&"w".into()), "{:?}", to(&program));
    let above = put.replace("=x", "=pose_trans(x,p[0,0,-.1,0,0,0])");
    let program = path(&format!("{s}{above}movel(w)\nput(w)\nmovel(s.a)"));
    assert_eq!(to(&program), ["w", "v", "w"]);
    assert_eq!(shift(&program).in_tool.translation, [0.0, 0.0, -0.1]);
    // nothing calls it, or with what nobody knows
    for go in ["movel(s.a)", "put(sensor())\nmovel(s.a)"] {
        let program = path(&format!("{s}{put}{go}"));
        assert_eq!(ids(&program), ["computed-target"], "{go}");
    }
}

#[test]
fn coordinates_that_a_called_function_computes_from_a_target_are_reported() {
    let put = "def put(x):\nv[2]=x[2]+0.02\nend\n";
    let is_said = |given: &str| {
        let text = format!("{W}v=p[.1,.2,.4,0,0,1]\n{put}movel(w)\nput({given})\nmovel(v)");
        ids(&path(&text)).contains(&"target-copied")
    };
    assert!(is_said("w"));
    assert!(!is_said("p[.1,.2,.5,0,0,0]"));
}

#[test]
fn a_list_holds_what_a_variable_was_when_it_was_made() {
    let later = format!("{W}l=[w,p[.1,.2,.5,0,0,1]]\nw=p[.1,.2,.4,0,0,1]\n");
    for go in ["movel(l[0])", "def f(m):\nmovel(m[0])\nend\nf(l)"] {
        let program = path(&format!("{later}{go}"));
        let heights: Vec<f64> = program
            .moves
            .iter()
            .map(|of| program.numbers_of(&program.targets[of.target.expect("known")])[2].value)
            .collect();
        assert_eq!(heights, [0.3, 0.4], "{go} {:?}", program.findings);
    }
    // what is computed from a variable keeps the value that it had
    let composed = format!("{W}b=p[w[0],w[1],w[2]+.01,w[3],w[4],w[5]]\nw=p[.1,.2,.4,0,0,1]\n");
    let program = path(&format!("{composed}movel(b)"));
    let first = program.moves[0].target.expect("known");
    assert_eq!(program.numbers_of(&program.targets[first])[2].value, 0.3);
    // one element may stand in a feature
    let program = path(&format!(
        "f=p[1,0,0,0,0,0]\n{W}l=[pose_trans(f,w),w]\nmovel(l[0])"
    ));
    let frame = &program.frames[program.moves[0].frame];
    let origin = frame.world_from_frame.expect("known").translation;
    assert_eq!(to(&program), ["w"]);
    assert_eq!(origin, [1.0, 0.0, 0.0]);
}

//! Variables, parameters, tools and the moves before, followed through the program.

use super::*;

fn severities(program: &Program) -> Vec<(&str, Severity)> {
    program
        .findings
        .iter()
        .map(|f| (f.id, f.severity))
        .collect()
}

#[test]
fn each_value_of_a_variable_is_a_target_of_its_own() {
    let program = path("x=p[1,2,3,0,0,0]\nmovel(x)\nx=p[1,2,3,0,0,1]\nmovel(x)");
    assert_eq!(program.findings, []);
    assert_eq!(to(&program), ["x", "x"]);
    assert_ne!(program.moves[0].target, program.moves[1].target);
    let program = path("if a:\nx=p[1,2,3,0,0,0]\nelse:\nx=p[1,2,3,0,0,1]\nend\nmovel(x)");
    assert_eq!((to(&program).len(), program.findings.len()), (2, 0));
    let program = path("global x=p[1,2,3,0,0,0]\nlocal i=0\nx=foo()\nmovel(x)");
    assert_eq!(ids(&program), ["computed-target"]);
}

#[test]
fn parameters_are_what_calls_give_by_position_and_by_name() {
    let program = path(
        "def go(x, y, z=p[1,2,5,0,0,0]):\nmovel(x)\nmovej(y)\nmovel(z)\nend\nw=p[1,2,3,0,0,0]\ngo(w, [0,1,2,3,4,5])\ngo(y=[0,1,2,3,4,6], x=p[1,2,4,0,0,0])",
    );
    assert_eq!(program.findings, []);
    assert_eq!(program.targets.len(), 5);
    let mut found = to(&program);
    found.sort_unstable();
    assert_eq!(found, ["-", "-", "-", "-", "-", "w"]);
    // nothing in the file calls it
    let program = path("def go(x):\nmovel(x)\nend\nmovel(p[1,2,3,0,0,0])");
    assert_eq!(
        severities(&program),
        [("computed-target", Severity::Warning)]
    );
    // in a feature, with a tool of the call's place
    let program = path(
        "def go(x, t):\nset_tcp(t)\nmovel(x)\nend\nset_tcp(p[3,0,0,0,0,0])\nq=get_inverse_kin(p[1,2,4,0,0,0])\n\
         go(pose_trans(p[7,0,0,0,0,0],p[1,2,3,0,0,0]), p[1,0,0,0,0,0])\ngo(p[1,2,5,0,0,0], \
             p[2,0,0,0,0,0])\nmovej(q)",
    );
    assert_eq!(program.findings, []);
    let mut reported: Vec<_> = program
        .moves
        .iter()
        .map(|m| {
            let x = |pose: Option<Pose>| pose.expect("a pose").translation[0];
            let frame = program.frames[m.frame].world_from_frame;
            (x(program.tools[m.tool].flange_from_tool), x(frame))
        })
        .map(|(tool, frame)| format!("{tool} {frame}"))
        .collect();
    reported.sort_unstable();
    assert_eq!(reported, ["1 7", "2 0", "3 0"]);
}

#[test]
fn results_of_functions_are_what_they_return() {
    let program = path(
        "def home():\nreturn [0,1,2,3,4,5]\nend\ndef place(n):\nif n==1:\nreturn \
         p[1,2,3,0,0,0]\nend\nreturn p[1,2,4,0,0,0]\nend\nmovej(home())\nx=place(i)\nmovel(x)",
    );
    assert_eq!((to(&program).len(), program.findings.len()), (3, 0));
}

#[test]
fn elements_of_lists_are_any_of_them() {
    let program = path(
        "w=p[1,2,3,0,0,1]\nway=[p[1,2,3,0,0,0], w, p[1,2,4,0,0,0]]\nmovel(way[2])\ni=0\nwhile \
         i<3:\nmovel(way[i])\ni=i+1\nend",
    );
    assert_eq!(program.findings, []);
    let mut found = to(&program);
    found.sort_unstable();
    assert_eq!(found, ["-", "-", "-", "w"]);
    // by their numbers: what the list has there, and what is put there
    let blank = "p[0,0,0,0,0,0]";
    for (lines, wanted) in [
        (
            format!("l=[{blank},{blank}]\nl[0]=w\nl[1]=v\nmovel(l[1])"),
            &["-", "v"][..],
        ),
        (
            format!("l=[{blank},w]\nl[0]=v\nmovel(l[i])"),
            &["-", "w", "v"],
        ),
        (
            "l=[w,v]\nt=l[0]\nl[0]=l[1]\nl[1]=t\nmovel(l[0])".to_owned(),
            &["w", "v"],
        ),
        ("l=[w,v]\nm=[]\nm[0]=l[1]\nmovel(m[0])".to_owned(), &["v"]),
        (format!("l=[{blank}]\nmovel(l[0])"), &["-"]),
        (
            format!(
                "l=[{}]\nl[1199]=w\nl[1198]=v\nmovel(l[1199])",
                vec![blank; 1200].join(",")
            ),
            &["-", "w"],
        ),
    ] {
        let program = path(&format!("w=p[1,2,3,0,0,1]\nv=p[1,2,4,0,0,1]\n{lines}"));
        let mut found = to(&program);
        found.sort_unstable();
        let mut wanted = wanted.to_vec();
        wanted.sort_unstable();
        assert_eq!(found, wanted, "{lines}");
        let by = &program.moves[0].displacement;
        assert_eq!(*by, Displacement::None, "{lines}");
    }
    // a list that the program fills
    let program = path("way=[]\nway[0]=p[1,2,3,0,0,0]\nway[1]=vision()\nmovel(way[i])");
    assert_eq!(ids(&program), ["computed-target"]);
    assert_eq!(to(&program).len(), 2);
    // joints by their names are none
    let program = path("movej([j1,j2,j3,j4,j5,j6])");
    assert_eq!(
        severities(&program),
        [("target-has-expressions", Severity::Warning)]
    );
}

/// An assignment behind `local` in its function is of that variable.
#[test]
fn targets_of_local_variables_are_apart_from_the_global_one_of_their_name() {
    for outside in ["global t", "t", "local t"] {
        let program = path(&format!(
            "w=p[1,2,3,0,0,1]\n{outside}=p[1,2,4,0,0,1]\ndef f(x):\nlocal t=pose_add(x,p[0,0,1,0,0,0])\n\
             movel(t)\nt=p[1,2,5,0,0,1]\nif k:\nt=w\nend\nmovel(t)\nend\nf(p[1,2,6,0,0,1])\nmovel(t)"
        ));
        assert_eq!(to(&program), ["-", "w", "t", "t"], "{outside}");
        let target = |at: usize| program.moves[at].target;
        assert_ne!(target(2), target(3), "{outside}");
        assert_eq!(program.targets.iter().filter(|t| t.blocked).count(), 0);
    }
}

#[test]
fn poses_with_expressions_stay_or_stand_next_to_the_targets_that_flow_into_them() {
    let displaced = |lines: &str| {
        let program = path(lines);
        let last = program.moves.last().expect("a move");
        let reported = program.findings.first().map(|f| (f.id, f.severity));
        (to(&program).pop(), last.displacement.clone(), reported)
    };
    let warned = Some(("target-has-expressions", Severity::Warning));
    for lines in [
        "movel(p[q[0], q[1], 0,0,0,0])",
        "movel(p[.1,.2,f(3),0,0,0])",
        // nothing goes to x itself: its numbers stay
        "x=p[.1,.2,.3,0,0,1]\ny=p[x[0],x[2],x[1]+0.05,x[3],x[4],x[5]]\nmovel(y)",
    ] {
        let found = displaced(lines);
        assert_eq!(
            (found.0.as_deref(), found.2),
            (Some("?"), warned),
            "{lines}"
        );
    }
    let x = "x=p[.1,.2,.3,0,0,1]\nmovel(x)\n";
    let along = |z| Displacement::By(Box::new(Shift::along([0.0, 0.0, z])));
    for (lines, z) in [
        ("movel(p[x[0],x[1],x[2]+0.05,x[3],x[4],x[5]])", 0.05),
        (
            "y=p[x[0], x[1] ,x[2] - .05,x[3],x[4],x[5]]\nmovel(y)",
            -0.05,
        ),
    ] {
        let (to, by, _) = displaced(&format!("{x}{lines}"));
        let Displacement::By(shift) = by else {
            panic!("{lines}")
        };
        assert_eq!(
            (to.as_deref(), shift.in_frame.translation),
            (Some("x"), [0.0, 0.0, z])
        );
    }
    for lines in [
        "movel(p[x[1],x[0],x[2],x[3],x[4],x[5]])",
        "movel(p[x[0],x[1],x[2],x[3]+1,x[4],x[5]])",
        // through other variables, a list, a function
        "a=x[0]+1\nb=a\nmovel(p[b,b,b,0,0,0])",
        "w=[x[0],x[1]]\nmovel(p[w[0],w[1],w[0],0,0,0])",
        "def f(a):\nb=a[2]\nmovel(p[b,b,b,0,0,0])\nend\nf(x)",
        "y=p[x[0],0,h,0,0,0]\nz=p[y[0],y[1],y[2],0,0,0]\nmovel(z)",
        // functions of the language
        "movel(pose_sub(x,p[0,0,-0.1,0,0,0]))",
        "y=interpolate_pose(x,p[0,0,-0.1,0,0,0],0.5)\nmovel(y)",
        "y=pose_add(x,p[0,0,0.1,0,0,0])\nmovel(pose_sub(y,p[0,0,-0.1,0,0,0]))",
    ] {
        let (to, by, _) = displaced(&format!("{x}{lines}"));
        assert_eq!(
            (to.as_deref(), by),
            (Some("x"), Displacement::Unbounded),
            "{lines}"
        );
    }
    for (lines, by) in [
        // of another file, of a sensor
        ("", Displacement::Unknown),
        ("h=read_input_float_register(24)\n", Displacement::Unknown),
        ("h=0.05\n", along(0.05)),
    ] {
        let go = "movel(p[x[0],x[1],x[2]+h,x[3],x[4],x[5]])";
        let (to, found, _) = displaced(&format!("{x}{lines}{go}"));
        assert_eq!((to.as_deref(), found), (Some("x"), by), "{lines}");
    }
    let two = path(&format!(
        "{x}w=p[.2,.2,.3,0,0,1]\nmovel(w)\nmovel(p[x[0],w[1],0,0,0,0])"
    ));
    assert_eq!(to(&two)[2..], ["x", "w"]);
    let two = path(&format!(
        "{x}w=p[.2,.2,.3,0,0,1]\nmovel(w)\nmovel(interpolate_pose(x,w,0.5))"
    ));
    assert_eq!(to(&two)[2..], ["x", "w"]);
    // nothing goes to x itself
    let alone = path("x=p[.1,.2,.3,0,0,1]\nmovel(pose_sub(x,p[0,0,-0.1,0,0,0]))");
    assert_eq!(
        (to(&alone), ids(&alone)),
        (vec!["?".to_owned()], vec!["computed-target"])
    );
}

#[test]
fn coordinates_that_come_from_no_target_lose_its_correction() {
    let x = "x=p[.1,.2,.3,0,0,1]\nmovel(x)\n";
    let with = |z: &str| format!("movel(p[x[0],x[1],{z},x[3],x[4],x[5]])");
    let written = |z: &str| format!("y=x\ny[2]={z}\nmovel(y)");
    for (before, z) in [
        ("", ".25"),
        ("", "0.2+5/100"),
        ("h=.25\n", "h"),
        ("h=.25\n", "-h"),
        ("", "read_input_float_register(24)"),
        ("def f():\nreturn 0.25\nend\n", "f()"),
    ] {
        for go in [with(z), written(z)] {
            let program = path(&format!("{x}{before}{go}"));
            let last = program.moves.last().expect("a move");
            assert_eq!(to(&program).last().map(String::as_str), Some("x"), "{go}");
            assert_eq!(last.displacement, Displacement::Overwritten, "{before}{go}");
        }
    }
    let program = path(&format!("{x}movel(p[.1,.25,.3,x[3],x[4],x[5]])"));
    assert_eq!(program.moves[1].displacement, Displacement::Overwritten);
    for (before, z, by) in [
        ("", "x[2]+h", Displacement::Unknown),
        ("h=x[2]+0.1\n", "h", Displacement::Unbounded),
        (
            "now=get_actual_tcp_pose()\n",
            "now[2]+0.1",
            Displacement::Unbounded,
        ),
        (
            "def f():\nreturn x[2]+0.1\nend\n",
            "f()",
            Displacement::Unbounded,
        ),
    ] {
        for go in [with(z), written(z)] {
            let program = path(&format!("{x}{before}{go}"));
            let last = program.moves.last().expect("a move");
            assert_eq!(last.displacement, by, "{before}{go}");
        }
    }
    // an angle
    for (go, by) in [
        (
            "y=x\ny[5]=h\nmovel(y)",
            Displacement::Within(Box::new([Stride::Turned(None)])),
        ),
        ("movel(p[x[0],x[1],x[2],0,0,h])", Displacement::Unbounded),
    ] {
        let program = path(&format!("{x}h=.25\n{go}"));
        assert_eq!(program.moves[1].displacement, by, "{go}");
    }
    // of the copy itself, and of what it is a copy of
    for go in [
        "y=x\ny[2] = 0.1 + y[2] # up\nmovel(y)",
        "y=x\ny[2]=x[2]+0.1\nmovel(y)",
    ] {
        let program = path(&format!("{x}{go}"));
        let by = Displacement::By(Box::new(Shift::along([0.0, 0.0, 0.1])));
        assert_eq!(program.moves[1].displacement, by, "{go}");
    }
}

#[test]
fn an_offset_from_a_waypoint_in_a_feature_is_displaced_from_it() {
    let pallet = "pallet=p[.02,.01,0,0,0,.1]\n";
    let offset = "p[0,0,-.05,0,0,0]";
    for lines in [
        format!(
            "at=pose_trans(pallet,p[.4,.5,.6,0,0,0])\nmovel(pose_trans(at,{offset}))\nmovel(at)"
        ),
        format!(
            "at=pose_trans(pallet,p[.4,.5,.6,0,0,0])\nto=at\nmovel(pose_trans(to,{offset}))\nmovel(to)"
        ),
        format!(
            "a=p[.4,.5,.6,0,0,0]\nmovel(pose_trans(pallet,a))\nmovel(pose_trans(pose_trans(pallet,a),{offset}))"
        ),
    ] {
        let program = path(&format!("{pallet}{lines}"));
        assert_eq!(program.findings, [], "{lines}");
        assert_eq!(program.targets.len(), 1, "{lines}");
        let mut shifts = 0;
        for used in &program.moves {
            assert_eq!(program.frames[used.frame].name, "pallet", "{lines}");
            if let Displacement::By(shift) = &used.displacement {
                assert!((shift.in_tool.translation[2] + 0.05).abs() < 1e-15);
                shifts += 1;
            }
        }
        assert_eq!((program.moves.len(), shifts), (2, 1), "{lines}");
    }
}

/// Id, severity and line of a finding.
type Said = (&'static str, Severity, usize);
/// A mass and its centre of gravity.
type Carried = (f64, [f64; 3]);

/// The loads of the last move, by mass, behind a tool of 0.2 m; and what is found.
fn loads(lines: &str) -> (Vec<Option<Carried>>, Vec<Said>) {
    let program = path(&format!(
        "set_tcp(p[0,0,0.2,0,0,0])\n{lines}\nmovel(p[.1,.2,.3,0,0,1])"
    ));
    let tools = program.moves.iter().map(|m| &program.tools[m.tool]);
    let mut loads: Vec<_> = tools
        .map(|tool| tool.load.map(|load| (load.mass_kg, load.cog_m)))
        .collect();
    loads.sort_by(|a, b| a.partial_cmp(b).expect("numbers"));
    let findings = program.findings.iter();
    let findings = findings.map(|f| (f.id, f.severity, f.line)).collect();
    (loads, findings)
}

#[test]
fn a_load_is_what_the_calls_before_say() {
    for (lines, mass_kg, z_m) in [
        ("set_payload(5,[0,0,0.1])", 5.0, 0.1),
        ("set_payload(cog=[0,0,0.1], m=5)", 5.0, 0.1),
        ("set_target_payload(5, [0,0,0.1], [0,0,0,0,0,0])", 5.0, 0.1),
        ("m=5\nc=[0,0,0.1]\nset_payload(m,c)", 5.0, 0.1),
        ("set_payload(1,[0,0,0.1])\nset_payload_mass(5)", 5.0, 0.1),
        (
            "set_payload(5,[0,0,0.3])\nset_payload_cog([0,0,0.1])",
            5.0,
            0.1,
        ),
        (
            "set_payload(1,[0,0,0.1])\nsync()\nset_payload(5,get_target_payload_cog())",
            5.0,
            0.1,
        ),
        ("set_payload(0,[0,0,0.1])", 0.0, 0.1),
        // the tool's origin, of a later tool too
        ("set_payload(5)", 5.0, 0.2),
        ("set_payload(5)\nset_tcp(p[0,0,0.1,0,0,0])", 5.0, 0.1),
        (
            "set_payload(5,[0,0,0.3])\nset_tcp(p[0,0,0.1,0,0,0])",
            5.0,
            0.3,
        ),
        ("set_payload_cog([0,0,0.1])\nset_payload_mass(5)", 5.0, 0.1),
        ("set_payload_mass(5)\nset_payload_cog([0,0,0.1])", 5.0, 0.1),
        // what nobody knows is replaced
        (
            "set_payload(m,[0,0,0.1])\nset_payload(5,[0,0,0.1])",
            5.0,
            0.1,
        ),
    ] {
        let known = (mass_kg, [0.0, 0.0, z_m]);
        assert_eq!(loads(lines), (vec![Some(known)], vec![]), "{lines}");
    }
    assert_eq!(loads(""), (vec![None], vec![]));
    // of a tool that is set first behind it
    let program = path("set_payload(5)\nset_tcp(p[0,0,0.1,0,0,0])\nmovel(p[.1,.2,.3,0,0,1])");
    let last = program.moves.last().expect("a move");
    let load = program.tools[last.tool].load.expect("a load");
    assert_eq!((load.mass_kg, load.cog_m), (5.0, [0.0, 0.0, 0.1]));
    assert!(!ids(&program).contains(&"load-chosen-at-run-time"));
}

#[test]
fn a_load_that_the_text_does_not_say_is_reported_where_it_is_set() {
    let reported = |line| vec![("load-chosen-at-run-time", Severity::Warning, line)];
    for (lines, line) in [
        ("set_payload(m,[0,0,0.1])", 3),
        ("m=5\nm=m+1\nset_payload(m,[0,0,0.1])", 5),
        ("set_payload(5,[0,0,100/1000])", 3),
        ("set_payload(-5,[0,0,0.1])", 3),
        ("set_payload()", 3),
        // of the installation
        ("set_payload_mass(5)", 3),
        ("set_payload_cog([0,0,0.1])", 3),
        ("set_tcp(tools[i])\nset_payload(5)", 4),
    ] {
        let (loads, findings) = loads(lines);
        let findings: Vec<_> = findings
            .into_iter()
            .filter(|found| found.0 == "load-chosen-at-run-time")
            .collect();
        assert_eq!((loads, findings), (vec![None], reported(line)), "{lines}");
    }
    // in one branch of two
    let one = "if a:\nset_payload(1,[0,0,0.1])\nelse:\nset_payload(2,[0,0,0.1])\nend\n";
    let two = Some((1.0, [0.0, 0.0, 0.1]));
    let (both, findings) = loads(one);
    assert_eq!((both.len(), both[0], findings), (2, two, vec![]));
    assert_eq!(
        loads(&format!("{one}set_payload_mass(5)")),
        (vec![None], reported(8))
    );
}

#[test]
fn joints_keep_the_tool_that_is_set_where_they_are_computed() {
    let text = "set_tcp(p[1,0,0,0,0,0])\nq=get_inverse_kin(p[.1,.2,.3,0,0,0], \
        [0,1,2,3,4,5])\nset_tcp(p[2,0,0,0,0,0])\nmovej(q)\nmovej(get_inverse_kin(p[.1,.2,.4,0,0,0], tcp=p[3,0,0,0,0,0]))\nmovej(p[.1,.2,.5,0,0,0])";
    let program = path(text);
    assert_eq!(program.findings, []);
    let tools: Vec<_> = (0..3).map(|k| tool_x(&program, k)).collect();
    assert_eq!(tools, [Some(1.0), Some(3.0), Some(2.0)]);
    // configuration is not stated: the inverse starts from the present joints
    assert!(program.moves.iter().all(|m| !m.configured));
    // in a branch: the tool of either
    let program = path(&text.replace("q=get", "if a:\nset_tcp(p[4,0,0,0,0,0])\nend\nq=get"));
    let mut tools: Vec<_> = (0..2).map(|k| tool_x(&program, k)).collect();
    tools.sort_by(|a, b| a.partial_cmp(b).expect("numbers"));
    assert_eq!(tools, [Some(1.0), Some(4.0)]);
}

#[test]
fn a_sum_of_a_pose_in_a_feature_is_in_the_base() {
    let program = path(
        "movel(pose_add(pose_trans(p[0,0,0,0,0,1.5707963267948966],p[1,2,3,0,0,0]),p[.1,0,0,0,0,0]))",
    );
    let Displacement::By(shift) = &program.moves[0].displacement else {
        panic!("a shift")
    };
    assert!(
        (shift.in_frame.translation[1] + 0.1).abs() < 1e-12
            && shift.in_frame.translation[0].abs() < 1e-12
    );
}

#[test]
fn what_is_given_to_functions_that_are_not_in_the_file() {
    for (lines, found) in [
        ("foo(x)", vec!["target-passed-to-routine"]),
        (
            "y=foo(pose_trans(x,p[0,0,.1,0,0,0]))",
            vec!["target-passed-to-routine"],
        ),
        // functions of the language move nothing, and servers are none of the robot
        ("y=pose_dist(x,get_actual_tcp_pose())", vec![]),
        ("socket_send_string(x)", vec![]),
        ("server.look(x)", vec![]),
        // nothing that moves go to
        (
            "foo(p[1,2,3,0,0,0], [1,2,3,4,5,6], z)",
            vec!["pose-passed-to-routine"],
        ),
        ("foo([1,2,3,4,5,6], z)", vec![]),
        // in lists and structures
        ("l=[x,x]\nfoo(l)", vec!["target-passed-to-routine"]),
        ("foo([x])", vec!["target-passed-to-routine"]),
        (
            "s=struct(a=1,p=x)\nfoo(s)",
            vec!["target-passed-to-routine"],
        ),
        ("l=[p[1,2,4,0,0,0]]\nfoo(l)", vec!["pose-passed-to-routine"]),
        (
            "s=struct(p=p[1,2,4,0,0,0])\nfoo(s.p)",
            vec!["pose-passed-to-routine"],
        ),
    ] {
        let program = path(&format!("x=p[1,2,3,0,0,0]\n{lines}\nmovel(x)"));
        assert_eq!(ids(&program), found, "{lines}");
        assert_eq!(program.targets.len(), 1);
    }
}

#[test]
fn a_function_that_is_not_in_the_file_may_set_another_tool() {
    let text = "set_tcp(p[1,0,0,0,0,0])\nmovel(p[.1,.2,.3,0,0,0])\nset_tcp(p[2,0,0,0,0,0])\ngrip()\nmovel(pose_trans(p[1,0,0,0,0,0],p[.1,.2,.4,0,0,0]))";
    assert_eq!(ids(&path(text)), ["frame-chosen-at-run-time"]);
    assert_eq!(path(text).targets.iter().filter(|t| t.blocked).count(), 1);
    // with one tool there is none to take; features are named by the moves
    assert_eq!(path(&text.replace("p[2,", "p[1,")).findings, []);
    // a function of the file tells, and so does one of the language
    for known in [
        "textmsg()",
        "set_gravity([0,0,9])",
        "def grip():\nend\ngrip()",
    ] {
        assert_eq!(path(&text.replace("grip()", known)).findings, [], "{known}");
    }
}

#[test]
fn the_moves_before_are_those_that_run_before() {
    let program = path(
        "def sub():\nmovel(p[1,2,3,0,0,0])\nend\nmovel(p[1,2,4,0,0,0])\nsub()\nspeedl([0,0,1,0,0,0])\nmovel(p[1,2,5,0,0,0])\nif a:\nmovej(get_actual_joint_positions())\nend\nmovel(p[1,2,6,0,0,0])",
    );
    let before: Vec<_> = program
        .moves
        .iter()
        .map(|m| program.before(m).to_vec())
        .collect();
    assert_eq!(
        before,
        [
            vec![Before::One(1)],
            vec![Before::Start],
            vec![Before::One(0)],
            vec![Before::One(2)],
            vec![Before::One(3)],
            vec![Before::One(3), Before::One(4)],
        ]
    );
}

#[test]
fn tracking_refuses_until_it_ends() {
    let program = path(
        "movel(p[1,2,3,0,0,0])\ntrack_conveyor_linear(p[1,0,0,0,0,0],500)\nmovel(p[1,2,4,0,0,0])\nstop_conveyor_tracking()\nmovel(p[1,2,5,0,0,0])",
    );
    assert_eq!(ids(&program), ["moving-frame"]);
    let blocked: Vec<_> = program.targets.iter().map(|t| t.blocked).collect();
    assert_eq!(blocked, [false, true, false]);
}

#[test]
fn a_tool_that_the_file_does_not_assign_has_its_name() {
    let program = path("set_tcp(gripper)\nmovel(p[1,2,3,0,0,0])");
    let tool = &program.tools[program.moves[0].tool];
    assert_eq!(
        (tool.name.as_str(), tool.flange_from_tool),
        ("gripper", None)
    );
    assert_eq!(program.findings, []);
}

#[test]
fn speed_and_radius_are_arguments_by_place_or_name() {
    let of = |text: &str| {
        let program = path(text);
        program.speed_zone(program.moves.last().expect("a move"))
    };
    let named = of("movel(p[1,2,3,0,0,0], a=1.2, r=0.005, v=0.25)");
    assert_eq!((named.speed_m_s, named.zone_m), (Some(0.25), Some(0.005)));
    let placed = of("movec(p[1,2,3,0,0,0], p[1,2,4,0,0,0], 1.2, 0.1, 0.02, 0)");
    assert_eq!((placed.speed_m_s, placed.zone_m), (Some(0.1), Some(0.02)));
    let joint = of("movej([0,1,2,3,4,5], 1.4, 1.05)");
    assert_eq!((joint.speed_m_s, joint.zone_m), (None, Some(0.0)));
    let variable = of("movel(p[1,2,3,0,0,0], a, v, 0, radius)");
    assert!(variable.cuts_corner() && variable.speed_m_s.is_none());
}

#[test]
fn with_a_time_a_move_has_no_speed() {
    for (behind, speed_m_s) in [
        ("a=1.2, v=0.25, t=2", None),
        ("a=1.2, v=0.25, t=seconds", None),
        ("1.2, 0.25, 2, 0.01", None),
        ("1.2, 0.25, 0, 0.01", Some(0.25)),
        ("a=1.2, v=0.25, t=0", Some(0.25)),
    ] {
        let program = path(&format!("movel(p[1,2,3,0,0,0], {behind})"));
        let speed_zone = program.speed_zone(&program.moves[0]);
        assert_eq!(speed_zone.speed_m_s, speed_m_s, "{behind}");
    }
}

#[test]
fn threads_begin_with_what_is_set_where_they_are_run() {
    let tools = |lines: &str| {
        let program = path(lines);
        let mut tools: Vec<_> = (0..program.moves.len())
            .map(|k| tool_x(&program, k))
            .collect();
        tools.sort_by(|a, b| a.partial_cmp(b).expect("numbers"));
        (tools, program.findings.len())
    };
    let thread =
        "thread t():\nmovel(x)\nend\nset_tcp(p[1,0,0,0,0,0])\nglobal x=p[1,2,3,0,0,0]\nrun t()\n";
    assert_eq!(tools(thread), (vec![Some(1.0)], 0));
    // what the others set while it runs
    let more = format!("{thread}set_tcp(p[2,0,0,0,0,0])\n");
    assert_eq!(tools(&more), (vec![Some(1.0), Some(2.0)], 0));
    // what the thread writes, others may find at any place
    let program =
        path("global x=p[1,2,3,0,0,0]\nthread t():\nx=p[1,2,4,0,0,0]\nend\nrun t()\nmovel(x)");
    assert_eq!(to(&program), ["x", "x"]);
    let program = path("thread t():\nmovel(p[1,2,3,0,0,0])\nend\nrun t()\nmovel(p[1,2,4,0,0,0])");
    assert_eq!(program.before(&program.moves[0]), [Before::Anywhere]);
    assert_eq!(program.before(&program.moves[1]), [Before::Start]);
}

#[test]
fn what_a_condition_never_lets_run_moves_nothing() {
    let text = |condition: &str| {
        format!(
            "x=p[1,2,3,0,0,0]\nif {condition}:\nwhile a:\nif \
             b:\nmovel(x)\nend\nend\nelse:\nmovel(p[1,2,4,0,0,0])\nend\nmovel(p[1,2,5,0,0,0])"
        )
    };
    for (condition, runs) in [
        ("(1 == 2)", false),
        ("1==2", false),
        ("False", false),
        ("(1 == 1.0)", true),
        ("(1 == 2 or a)", true),
        ("(a == 2)", true),
        ("(1 == a)", true),
        ("2 > 1", true),
        ("not False", true),
    ] {
        let program = path(&text(condition));
        assert_eq!(to(&program).contains(&"x".to_owned()), runs, "{condition}");
        assert_eq!(program.targets.len(), 3);
        assert_eq!(
            ids(&program),
            if runs {
                vec![]
            } else {
                vec!["target-unused-here"]
            }
        );
    }
    // what follows the whole `if` runs
    let program =
        path("x=p[1,2,3,0,0,0]\nif 1==2:\nmovel(x)\nelif a:\nmovej(x)\nend\nmovel(p[1,2,5,0,0,0])");
    assert_eq!(to(&program), ["x", "-"]);
}

#[test]
fn a_robot_that_is_mounted_otherwise_than_the_profile_has_it_is_refused() {
    let found = |gravity: &str, of_profile: Option<[f64; 3]>| {
        let text =
            format!("def t():\nset_gravity({gravity})\nmovel(p[.1,.2,.3,0,0,0])\nend\nt()\n");
        let settings = Settings {
            gravity_m_s2: of_profile,
            ..Settings::default()
        };
        let sources = [Source::new("t.script", text.into_bytes())];
        let program = crate::motion::read(&UrScript, &sources, &settings).expect("a script");
        ids(&program).contains(&"gravity-differs")
    };
    let floor = Some([0.0, 0.0, -9.81]);
    assert!(!found("[0.0, 0.0, 9.82]", floor));
    assert!(found("[0.0, 0.0, -9.82]", floor));
    assert!(found("[9.82, 0, 0]", floor));
    assert!(!found("[9.82, 0, 0]", Some([-9.82, 0.0, 0.0])));
    // nothing of the profile hangs on it; only the running program knows it
    assert!(!found("[9.82, 0, 0]", None));
    assert!(!found("g", floor));
}

//! Steps from positions that no move goes to itself.

use super::*;

const BASE: &str = "base=p[.4,.1,.3,0,3.1,0]\n";
const TWO: &str = "a=p[.4,.1,.3,0,3.1,0]\nb=p[.4,.2,.3,0,3.1,0]\n";

/// What each move goes to, with its displacement.
fn steps(program: &Program) -> Vec<(String, Displacement)> {
    let displaced = program.moves.iter().map(|m| m.displacement.clone());
    to(program).into_iter().zip(displaced).collect()
}

/// So far along an axis of the tool, up to so often.
fn within(axis: usize, by: f64, most: u32) -> Displacement {
    let mut along = [0.0; 3];
    along[axis] = by;
    let [x, y, z] = along;
    let shift = Shift {
        in_tool: Pose::from_translation(x, y, z),
        ..Shift::none()
    };
    let most = Some(most);
    Displacement::Within(Box::new([Stride::By { shift, most }]))
}

fn by(axis: usize, by: f64) -> Displacement {
    match within(axis, by, 1) {
        Displacement::Within(strides) => match &strides[0] {
            Stride::By { shift, .. } => Displacement::By(Box::new(*shift)),
            _ => panic!("a shift"),
        },
        _ => panic!("strides"),
    }
}

#[test]
fn counters_step_from_a_position_as_far_as_the_loop_lets_them() {
    let go = "movel(pose_trans(base,p[i*0.05,0,0,0,0,0]))";
    for (condition, most) in [
        ("i<5", 5),
        ("(i <= 4)", 5),
        ("5>i and ready", 5),
        ("i<n", 5),
    ] {
        let program = path(&format!(
            "{BASE}n=5\ni=0\nwhile {condition}:\n{go}\ni=i+1\nend"
        ));
        let found = steps(&program);
        assert_eq!(found.len(), 1, "{condition}");
        assert_eq!(found[0].0, "base", "{condition}");
        let Displacement::Within(strides) = &found[0].1 else {
            panic!("{condition}: {:?}", found[0].1);
        };
        let [Stride::By { shift, most: of }] = **strides else {
            panic!("{condition}: {strides:?}");
        };
        assert_eq!(of, Some(most), "{condition}");
        assert_eq!(shift.in_tool.translation, [0.05, 0.0, 0.0], "{condition}");
        assert_eq!(program.findings, [], "{condition}");
    }
    // in two directions, in the posture of the joints that a move computes
    let program = path(&format!(
        "{BASE}i=0\nwhile i<3:\nj=0\nwhile j<2:\nmovej(get_inverse_kin(pose_trans(base,\
         p[i*0.05,j*0.1,0,0,0,0])))\nj=j+1\nend\ni=i+1\nend"
    ));
    let found = steps(&program);
    assert!(
        matches!(&found[..], [(name, Displacement::Within(of))] if name == "base" && of.len() == 2),
        "{found:?}"
    );
}

#[test]
fn what_nothing_bounds_stays_as_it_was() {
    for (lines, id) in [
        // for ever
        (
            "i=0\nwhile True:\nmovel(pose_trans(base,p[i*0.05,0,0,0,0,0]))\ni=i+1\nend",
            "target-has-expressions",
        ),
        // until a sensor says so
        (
            "i=0\nwhile busy():\nmovel(pose_trans(base,p[i*0.05,0,0,0,0,0]))\ni=i+1\nend",
            "target-has-expressions",
        ),
        (
            "h=read_input_float_register(24)\nmovel(pose_trans(base,p[0,0,h,0,0,0]))",
            "target-has-expressions",
        ),
    ] {
        let program = path(&format!("{BASE}{lines}"));
        assert_eq!(
            (to(&program), ids(&program)),
            (vec!["?".to_owned()], vec![id]),
            "{lines}"
        );
    }
}

#[test]
fn a_function_that_steps_from_what_it_is_given() {
    let above = "def above(at):\nreturn pose_trans(at,p[0,0,-.1,0,0,0])\nend\n";
    let variable = "def above(at):\nlocal q=pose_trans(at,p[0,0,-.1,0,0,0])\nreturn q\nend\n";
    for above in [above, variable] {
        for (goes, named) in [
            ("movel(above(a))\nmovel(above(b))", vec!["a", "b"]),
            (
                "movel(above(a))\nmovel(a)\nmovel(above(b))\nmovel(b)",
                vec!["a", "a", "b", "b"],
            ),
            ("movel(above(a))\nmovel(a)", vec!["a", "a"]),
        ] {
            let program = path(&format!("{TWO}{above}{goes}"));
            assert_eq!(program.findings, [], "{above}{goes}");
            let found = steps(&program);
            let names: Vec<&str> = found.iter().map(|(name, _)| name.as_str()).collect();
            assert_eq!(names, named, "{above}{goes}");
            for (at, (_, displacement)) in found.iter().enumerate() {
                let is_direct = named.len() > 1 && named.get(at.wrapping_sub(1)) == named.get(at);
                let expected = if is_direct {
                    Displacement::None
                } else {
                    by(2, -0.1)
                };
                assert_eq!(*displacement, expected, "{above}{goes}");
            }
        }
    }
    // moves inside, and how far is given too
    let program = path(&format!(
        "{TWO}def pick(at,h):\nmovel(pose_trans(at,p[0,0,-h,0,0,0]))\nend\npick(a,.1)\npick(b,.05)"
    ));
    let mut found = to(&program);
    found.sort_unstable();
    assert_eq!(
        (found, ids(&program)),
        (vec!["a".to_owned(), "b".to_owned()], vec![])
    );
}

#[test]
fn a_list_has_positions_that_are_worked_out() {
    let above = "def above(at):\nreturn pose_trans(at,p[0,0,-.1,0,0,0])\nend\n";
    for list in ["ls=[a,pose_trans(a,p[0,0,-.1,0,0,0])]", "ls=[a,above(a),b]"] {
        let program = path(&format!("{TWO}{above}{list}\nmovel(a)\nmovel(ls[1])"));
        assert_eq!(program.findings, [], "{list}");
        let expected = [Displacement::None, by(2, -0.1)].map(|by| ("a".to_owned(), by));
        assert_eq!(steps(&program), expected, "{list}");
    }
}

#[test]
fn features_stay_features() {
    let tool_down = "p[.1,.2,0,0,3.1,0]";
    // of a target, and of one pallet or the other
    let program = path(&format!(
        "{TWO}def on(pallet):\nmovel(pose_trans(pallet,{tool_down}))\nend\non(a)\non(b)"
    ));
    assert_eq!(to(&program), ["-", "-"]);
    let frames: Vec<_> = program
        .moves
        .iter()
        .map(|m| program.frames[m.frame].name.clone())
        .collect();
    assert!(frames.iter().all(|name| name != "base"), "{frames:?}");
    // a feature of a target, and steps in it
    let program = path(&format!(
        "{BASE}movel(pose_trans(base,{tool_down}))\ni=0\nwhile i<3:\nmovel(pose_trans(base,p[i*0.05,0,0,0,0,0]))\ni=i+1\nend"
    ));
    assert_eq!(
        (to(&program), ids(&program)),
        (
            vec!["-".to_owned(), "?".to_owned()],
            vec!["target-has-expressions"]
        )
    );
    // from one position alone the step is the target
    let program = path(&format!("{BASE}movel(pose_trans(base,p[0,0,-.1,0,0,0]))"));
    assert_eq!(
        (to(&program), ids(&program)),
        (vec!["-".to_owned()], vec![])
    );
}

#[test]
fn taught_joints_of_waypoints_stay_known_where_a_thread_leads_the_robot() {
    let named = |thread: &str| {
        let program = read(&format!(
            "def P():\n  global W_p=p[.4,.1,.5,0,2.2,2.2]\n  global W_q=[0,-1.5,1.5,0,1,0]\n  thread \
             T():\n    {thread}\n  end\n  h=run T()\n  movel(W_p)\nend\n"
        ));
        let of =
            |(target, joints): &(usize, [f64; 6])| (program.targets[*target].name.clone(), *joints);
        program.named.iter().map(of).collect::<Vec<_>>()
    };
    let joints = [0.0, -1.5, 1.5, 0.0, 1.0, 0.0];
    let expected = [(Some("W_p".into()), joints)];
    for thread in [
        "sync()",
        "freedrive_mode()\n    sleep(1)\n    end_freedrive_mode()",
    ] {
        assert_eq!(named(thread), expected, "{thread}");
    }
}

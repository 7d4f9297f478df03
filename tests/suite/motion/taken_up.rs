//! A joint that turns back comes from its new side once it has gone by the width of its backlash.

use super::displaced::miss_mm;
use super::{BACKLASH, P, checked, done, errors, given, message, rapid};
use poseshift::compensate::{Compensation, compensate};
use poseshift::geometry::Pose;
use poseshift::model::profile::Profile;
use poseshift::program::{self, Source};

/// Joint 2 runs ahead: between the two sides is what the correction takes away from the way back.
const AHEAD: &str = "{effect: backlash, joint: 2, width_deg: 0.1}";

/// Straight moves past the base, on which joint 2 falls and from the middle on rises.
fn past(ends: &[f64]) -> String {
    let target = |(at, y): (usize, &f64)| format!("CONST robtarget p{at} := [[400,{y},200],{P};\n");
    let data: String = ends.iter().enumerate().map(target).collect();
    let moves = (1..ends.len()).map(|at| format!("MoveL p{at},v100,fine,tool0;\n"));
    let start = "MoveAbsJ [[0,-20,0,0,60,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;\nMoveJ \
        p0,v100,fine,tool0;\n";
    rapid(&data, &format!("{start}{}", moves.collect::<String>()))
}

fn along(effect: &str, ends: &[f64]) -> Compensation {
    done(&[effect], &[("t.mod", &past(ends))])
}

/// The lines of targets to which a joint does not come wholly from its new side, and how far off the
/// tool would be from the other.
fn uncertain(done: &Compensation) -> Vec<(usize, f64)> {
    assert_eq!(errors(done), [""; 0], "{:?}", done.findings);
    let found = done.findings.iter();
    let found = found.filter(|f| f.id == "direction-uncertain");
    found.map(|f| (f.line, miss_mm(&f.message))).collect()
}

#[test]
fn a_joint_that_turns_back_by_less_than_its_backlash_is_reported() {
    let short = along(AHEAD, &[-250.0, 20.0]);
    let found = uncertain(&short);
    assert_eq!(found.len(), 1, "{:?}", short.findings);
    let (line, off) = found[0];
    // 0.1 deg of joint 2, some 0.4 m from the tool
    assert!(line == 3 && (0.5..0.9).contains(&off), "{found:?}");
    let said = message(&short, "direction-uncertain");
    assert!(
        said.contains("joint 2") && said.contains("of 0.100 deg"),
        "{said}"
    );
    assert_eq!(uncertain(&along(AHEAD, &[-250.0, 90.0])), []);
    // where the joint lags, the correction takes its backlash up
    assert_eq!(uncertain(&along(BACKLASH, &[-250.0, 90.0])), []);
}

#[test]
fn what_a_joint_goes_adds_up_over_short_moves() {
    // the first takes it up, less by the correction
    let mut one_way = vec![-254.0];
    one_way.extend((0..120).map(|k| -250.0 + 2.0 * f64::from(k)));
    for effect in [AHEAD, BACKLASH] {
        assert_eq!(uncertain(&along(effect, &one_way)), [], "{effect}");
    }
    // of the moves behind the turn those that come before its backlash is taken up
    let mut on = vec![-250.0, 20.0];
    on.extend((0..40).map(|k| 22.0 + 2.0 * f64::from(k)));
    let found = uncertain(&along(AHEAD, &on));
    let lines: Vec<usize> = found.iter().map(|(line, _)| *line).collect();
    let first: Vec<usize> = (3..3 + lines.len()).collect();
    assert!(
        lines == first && (2..30).contains(&lines.len()),
        "{found:?}"
    );
}

/// On the second line joint 2 turns back twice behind its middle, and goes 0.042 deg from there.
#[test]
fn a_joint_may_turn_back_twice_in_one_half_of_a_long_path() {
    let frame = "[[200,50,100],[0.96592583,0,0,0.25881905]]";
    let data = format!(
        "PERS tooldata t:=[TRUE,[[20,-30,100],[0.97638259,0.17216259,0.12854321,-0.02266564]],[1,[0,0,50],\
         [1,0,0,0],0,0,0]];\nTASK PERS wobjdata w:=[FALSE,TRUE,\"\",{frame},[[0,0,0],[1,0,0,0]]];\nCONST \
         robtarget a:=[[14.99305,-285.56269,319.27863],[0.18993278,0.63338960,0.62739656,-0.41123803],\
         [-1,1,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\nCONST robtarget b:=[[273.50903,-177.03958,248.79246],\
         [0.09292323,-0.83291091,0.33431674,-0.43111136],[0,0,2,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\n"
    );
    let start = "ConfL\\Off;\nMoveAbsJ [[12.86,10.27,5.96,6.9,60.41,7.16],[9E9,9E9,9E9,9E9,9E9,9E9]],\
        v100,fine,t;\n";
    let moves = "MoveL a,v100,fine,t\\WObj:=w;\nMoveL b,v100,fine,t\\WObj:=w;";
    let found = done(
        &[BACKLASH],
        &[("t.mod", &rapid(&data, &format!("{start}{moves}")))],
    );
    let said = message(&found, "direction-uncertain");
    assert!(
        said.contains("`b`") && said.contains("of 0.100 deg"),
        "{said}"
    );
}

#[test]
fn a_move_in_a_work_frame_that_nobody_knows_has_no_side() {
    let data = format!(
        "CONST robtarget p := [[400,0,300],{P};\nPERS wobjdata w:=[FALSE,TRUE,\"\",[[0,0,0],\
         [1,0,0,0]],[[0,0,0],[1,0,0,0]]];"
    );
    let text = rapid(&data, "SetFrame w;\nMoveJ p,v100,fine,tool0\\WObj:=w;");
    let refused = done(&[BACKLASH], &[("t.mod", &text)]);
    assert_eq!(errors(&refused), ["frame-chosen-at-run-time"]);
}

#[test]
fn behind_a_move_in_one_of_several_work_frames_no_side_is_taken_for_sure() {
    let data = format!(
        "CONST robtarget p := [[400,0,300],{P};\nCONST robtarget q := [[400,10,200],{P};\nPERS wobjdata \
         w:=[FALSE,TRUE,\"\",[[0,0,0],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];"
    );
    let found = |set: &str| {
        let moves = format!("{set}\nMoveJ p,v100,fine,tool0\\WObj:=w;\nMoveJ q,v100,fine,tool0;");
        let done = done(&[BACKLASH], &[("t.mod", &rapid(&data, &moves))]);
        let of_q = |f: &&poseshift::finding::Finding| f.message.contains("`q`");
        let ids: Vec<&str> = done.findings.iter().filter(of_q).map(|f| f.id).collect();
        (errors(&done), ids)
    };
    assert_eq!(found(""), (vec![], vec![]));
    let (refused, of_q) = found("IF DInput(di1)=1 THEN\nSetFrame w;\nENDIF");
    assert_eq!(refused, ["frame-chosen-at-run-time", "target-shared"]);
    assert_eq!(of_q, ["direction-uncertain", "target-shared"]);
}

/// An arc near whose end joint 1 turns back slowly: at less than a thousandth of a radian a metre of
/// its long way, by three hundredths of a degree altogether.
fn slow_end(effect: &str) -> Compensation {
    let text = "DEF t()\n$TOOL={X -12.5,Y 3,Z 418.25,A 0,B 60,C 0}\n$BASE={X 1480,Y -310.5,Z 520,A \
        14.25,B 0,C 0}\nPTP {A1 24.9750,A2 -71.6825,A3 109.4669,A4 23.5313,A5 51.8052,A6 \
        -5.6330}\nPTP {X 164.73178,Y -572.58651,Z 104.83525,A 132.29462,B -44.47573,C \
        -159.68286,S 2,T 34}\nLIN {X 95.03084,Y -625.69107,Z 213.81423,A 129.73004,B -41.55730,C \
        -155.23686,S 2,T 34}\nCIRC {X 15.67292,Y -573.28958,Z 188.65709,A 128.15214,B \
        -46.78571,C -159.67615},{X 19.21642,Y -558.14449,Z 91.52549,A 128.15214,B -46.78571,C \
        -159.67615,S 2,T 34}\nEND\n";
    let sources = [Source::new("t.src", text.as_bytes().to_vec())];
    let language = program::language_of(&sources[0]).expect("a language");
    let profile = super::profile_of("robots/kuka_kr210_r2700.yaml", &[effect]);
    let done = compensate(language, &sources, &profile, &given()).expect("read");
    assert_eq!(errors(&done), [""; 0], "{:?}", done.findings);
    done
}

#[test]
fn a_joint_that_turns_back_slowly_at_the_end_of_an_arc_comes_from_its_new_side() {
    let ends = |effect: &str| {
        let fakes: Vec<Pose> = slow_end(effect)
            .targets
            .iter()
            .filter_map(|of| of.fake)
            .collect();
        // the second arrives with joint 1 on its way up, the last behind its turn
        [fakes[1], fakes[3]]
    };
    let with_backlash = ends("{effect: backlash, joint: 1, width_deg: 0.012}");
    let offsets = ["-0.006", "0.006"];
    let of_offset = offsets.map(|deg| {
        ends(&format!(
            "{{effect: link_geometry, link: 1, theta_deg: {deg}}}"
        ))
    });
    // joint 1 stands on one side where it comes from there all along
    let side = |at: usize| {
        let gaps = of_offset.map(|of| of[at].separation(&with_backlash[at]).distance_m);
        assert!(gaps[0].min(gaps[1]) < 1e-6, "{at} {gaps:?}");
        gaps[0] < gaps[1]
    };
    assert_ne!(side(0), side(1));
}

/// Joint 1 goes 0.0003 deg to one side and back, on an arc of 40 mm: that slowly it goes on both halves.
#[test]
fn the_bound_of_a_path_holds_on_both_sides_of_a_slow_joint() {
    let data: String = [("a", 400.0, 0.0), ("b", 420.0, 0.002), ("c", 440.0, 0.0)]
        .map(|(name, x, y)| format!("CONST robtarget {name} := [[{x},{y},300],{P};\n"))
        .concat();
    let text = rapid(
        &data,
        "MoveJ a,v100,fine,tool0;\nMoveC b,c,v100,fine,tool0;",
    );
    let sources = [Source::new("t.mod", text.into_bytes())];
    let bound_mm = |theta_deg: f64| {
        let zero = format!("{{effect: link_geometry, link: 1, theta_deg: {theta_deg}}}");
        let profile = super::profile(&["{effect: backlash, joint: 1, width_deg: 0.1}", &zero]);
        let checked = checked(&profile, &sources, None);
        let paths = checked.moves.iter().filter_map(|m| m.path.as_ref());
        1e3 * paths.map(|path| path.bound.distance_m).fold(0.0, f64::max)
    };
    // the zero takes the backlash of one side away and doubles that of the other: 0.1 deg in 0.42 m
    for theta_deg in [0.05, -0.05] {
        let bound = bound_mm(theta_deg);
        assert!((0.7..0.8).contains(&bound), "{theta_deg}: {bound} mm");
    }
}

/// At the first of all passes nobody knows from which side joint 2 comes, at the others it is known.
#[test]
fn the_passes_of_a_loop_behind_the_first_decide() {
    let data: String = [("p1", 100, 400, "0,0,0,0"), ("p2", -100, 300, "-1,0,-1,0")]
        .map(|(name, y, z, conf)| {
            format!(
                "CONST robtarget {name}:=[[400,{y},{z}],[0,0,1,0],[{conf}],[9E9,9E9,9E9,9E9,9E9,9E9]];\n"
            )
        })
        .concat();
    let moves = "MoveJ p1,v100,fine,tool0;\nMoveL p2,v100,fine,tool0;\n";
    let of = |body: &str, split_targets| {
        let sources = [Source::new("t.mod", rapid(&data, body).into_bytes())];
        let language = program::language_of(&sources[0]).expect("a language");
        let options = poseshift::compensate::Options {
            split_targets,
            ..given()
        };
        compensate(language, &sources, &super::profile(&[BACKLASH]), &options).expect("read")
    };
    for split in [false, true] {
        let done = of(&format!("WHILE TRUE DO\n{moves}ENDWHILE"), split);
        let found = uncertain(&done);
        assert_eq!(found.len(), 1, "{:?}", done.findings);
        let said = message(&done, "direction-uncertain");
        assert!(said.contains("as it does at other times"), "{said}");
        // 0.1 deg of joint 2 lands 0.5 to 1 mm off
        assert!((0.3..1.5).contains(&found[0].1), "{found:?}");
        assert!(
            done.targets.iter().all(|target| target.fake.is_some()),
            "both are written"
        );
    }
}

/// The path to the middle of an arc is that between the fake targets, its end among them: the circle
/// through where the end is without its correction is another, on which these joints turn back less.
#[test]
fn a_joint_that_turns_back_before_the_middle_of_an_arc_has_come_as_far_as_it_does_there() {
    let read = |name: &str| {
        let path = crate::support::repository(&format!("tests/data/arcs/{name}"));
        std::fs::read_to_string(path).expect(name)
    };
    let profile = Profile::from_yaml(&read("profile.yaml")).expect("a profile");
    for name in ["first.as", "second.as"] {
        let sources = [Source::new(name, read(name).into_bytes())];
        let language = program::language_of(&sources[0]).expect("a language");
        let done = compensate(language, &sources, &profile, &given()).expect("read");
        assert_eq!(errors(&done), [""; 0], "{name}: {:?}", done.findings);
        let mut said = done.findings.iter();
        let is_it = |f: &&poseshift::finding::Finding| f.id == "direction-uncertain";
        assert_eq!(said.find(is_it), None, "{name}");
    }
}

//! What is found of programs as a whole.

use super::*;
use crate::profile::Mounted;
use crate::program::language_of;

const PLAIN: &str = "{effect: link_geometry, link: 3, theta_deg: 0.1, a_mm: 0.3}";
const BACKLASH: &str = "{effect: backlash, joint: 2, width_deg: -0.1}";

/// What is done with a file for an arm with these effects.
fn done(effects: &[&str], name: &str, text: &str) -> Compensation {
    let robot = concat!(env!("CARGO_MANIFEST_DIR"), "/../../robots/abb_irb120.yaml");
    let robot = std::fs::read_to_string(robot).expect("a profile");
    let plain = &robot[..robot.find("calibration:").expect("a list of effects")];
    let effects = effects.join(", ");
    let profile = format!("{plain}calibration: {{effects: [{effects}]}}\n");
    let profile = Profile::from_yaml(&profile).expect("a profile");
    let mut given = Given::default();
    given.tools.insert(None, Mounted::flange());
    given.frames.insert(None, Pose::identity());
    let options = Options {
        given,
        ..Options::default()
    };
    let sources = [Source::new(name, text.as_bytes().to_vec())];
    let language = language_of(&sources[0]).expect("a language");
    compensate(language, &sources, &profile, &options).expect("read")
}

/// Findings of an id: severity and message.
fn found<'a>(done: &'a Compensation, id: &str) -> Vec<(Severity, &'a str)> {
    let all = done.findings.iter().filter(|found| found.id == id);
    all.map(|found| (found.severity, &*found.message)).collect()
}

#[test]
fn a_joint_with_backlash_comes_back_to_where_it_was_from_the_other_side() {
    let joints = ".JOINTS\n#h 0 0 0 0 60 0\n#low 0 20 0 0 60 0\n#high 0 40 0 0 60 0\n.END\n";
    let read = |effects: &[&str], there: &str, from: &str, back: &str| {
        let text = format!(
            ".PROGRAM main()\nTOOL NULL\nBASE NULL\nJMOVE #h\nLMOVE p\nJMOVE #h\nJMOVE #low\nHERE \
             {there}\nJMOVE {from}\n{back} {there}\n.END\n.TRANS\np 430 0 400 0 180 0\n.END\n{joints}"
        );
        done(effects, "t.as", &text)
    };
    for (there, back) in [("a", "JMOVE"), ("a", "LMOVE"), ("#a", "JMOVE")] {
        let other = read(&[PLAIN, BACKLASH], there, "#high", back);
        let [(Severity::Warning, message)] = found(&other, "run-time-position")[..] else {
            panic!("{there} {back}: {:?}", other.findings);
        };
        // joint 2 turns about an axis that is 0.44 m from the tool
        let off = message.split("may be ").nth(1).expect("how far");
        let off_mm: f64 = off[..off.find(' ').expect("a unit")].parse().expect("mm");
        assert!((0.65..0.9).contains(&off_mm), "{message}");
        assert!(message.contains("joint 2 with backlash"), "{message}");
        // from the same side, or without backlash, it is right as it is
        for right in [
            read(&[PLAIN, BACKLASH], there, "#h", back),
            read(&[PLAIN], there, "#high", back),
        ] {
            let [(Severity::Note, message)] = found(&right, "run-time-position")[..] else {
                panic!("{there} {back}: {:?}", right.findings);
            };
            assert!(message.contains("right as it is"), "{message}");
        }
    }
}

#[test]
fn behind_many_elements_that_stand_alike_the_posture_is_known() {
    let program = |most: usize, first: &str| {
        let points: String = (1..=most)
            .map(|i| format!("p[{i}] {} {} 400 60 130 0\n", 380 + 3 * i, 2 * i))
            .collect();
        let text = format!(
            ".PROGRAM main()\nTOOL NULL\nBASE NULL\n{first}\nFOR .i = 1 TO {most}\nLAPPRO p[.i],50\nLMOVE \
             p[.i]\nLDEPART 50\nEND\nJMOVE #h\n.END\n.TRANS\n{points}.END\n.JOINTS\n#h 0 0 0 0 60 \
             0\n.END\n"
        );
        done(&[PLAIN], "t.as", &text)
    };
    for most in [16, 17, 20] {
        let known = program(most, "JMOVE #h");
        assert_eq!(found(&known, "posture-assumed"), [], "{most}");
        let open = program(most, "");
        let said = found(&open, "posture-assumed");
        assert!(!said.is_empty(), "{most}: {:?}", open.findings);
    }
    // the same numbers, however many come before
    let fake = |of: &Compensation| of.targets[0].fake.expect("a fake target");
    let apart = fake(&program(16, "JMOVE #h")).separation(&fake(&program(17, "JMOVE #h")));
    assert!(
        apart.distance_m < 1e-9 && apart.angle_rad < 1e-7,
        "{apart:?}"
    );
}

#[test]
fn of_an_object_on_two_plates_the_one_out_of_reach_is_named() {
    let program = |far: u32| {
        let text = format!(
            ".PROGRAM main()\nTOOL NULL\nBASE NULL\nJMOVE #h\nBASE near\nLMOVE p\nJMOVE #h\nBASE \
             far\nJMOVE p\n.END\n.TRANS\np 130 0 400 0 180 0\nnear 300 0 0 0 0 0\nfar {far} 0 0 0 0 \
             0\n.END\n.JOINTS\n#h 0 0 0 0 60 0\n.END\n"
        );
        done(&[PLAIN], "t.as", &text)
    };
    let beyond = program(900);
    let [(Severity::Error, message)] = found(&beyond, "out-of-reach")[..] else {
        panic!("{:?}", beyond.findings);
    };
    let named = ["in work frame far (line 9)", "in work frame near (line 6)"];
    let places = named.map(|name| message.find(name));
    assert!(
        matches!(places, [Some(far), Some(near)] if far < near),
        "{message}"
    );
    // with one use nothing is added
    let one = done(
        &[PLAIN],
        "t.as",
        ".PROGRAM main()\nTOOL NULL\nBASE NULL\nJMOVE #h\nJMOVE p\nJMOVE q\n.END\n.TRANS\np 430 0 400 0 \
         180 0\nq 1430 0 400 0 180 0\n.END\n.JOINTS\n#h 0 0 0 0 60 0\n.END\n",
    );
    let [(Severity::Error, message)] = found(&one, "out-of-reach")[..] else {
        panic!("{:?}", one.findings);
    };
    assert!(!message.contains("other moves"), "{message}");
}

//! Straight moves on which the joints of the wrist lead the tool: they come to the target from the side
//! on which they began, whatever an even rotation of the tool would make of them.

use crate::support::{poseshift, repository, scratch, text};
use poseshift::compensate::{Options, compensate};
use poseshift::model::profile::Profile;
use poseshift::program::Source;
use poseshift::program::krl::Krl;

/// The numbers of the last move.
fn last(profile: &Profile, program: &str) -> Vec<f64> {
    let sources = [Source::new("t.src", program.as_bytes().to_vec())];
    let done = compensate(&Krl, &sources, profile, &Options::default()).expect("read");
    assert!(!done.is_refused(), "{:?}", done.findings);
    let written = done.written(&Krl, &sources, "", false).expect("written");
    let text = String::from_utf8(written.sources[0].bytes.clone()).expect("ASCII");
    let line = text
        .lines()
        .rfind(|line| line.contains("{X"))
        .expect("a move")
        .to_owned();
    let inside = line
        .split(['{', '}'])
        .nth(1)
        .expect("a position")
        .to_owned();
    let numbers = inside
        .split(',')
        .map(|part| part[1..].trim().parse().expect("a number"));
    numbers.collect()
}

fn apart(a: &[f64], b: &[f64]) -> f64 {
    a.iter()
        .zip(b)
        .map(|(a, b)| (a - b).abs())
        .fold(0.0, f64::max)
}

#[test]
fn joints_of_the_wrist_come_as_on_a_joint_move() {
    let plain = text("programs/krl/profile.yaml");
    let effects = "effects:\n    - {effect: backlash, joint: JOINT, width_deg: 0.05}\n";
    let (mut other, mut all) = (0, 0);
    for joint in ["4", "5", "6"] {
        let profile = plain.replacen("effects:\n", &effects.replace("JOINT", joint), 1);
        let profile = Profile::from_yaml(&profile).expect("a profile");
        for (from, to) in [
            (
                "X 1481.0,Y 59.8,Z 1169.7,A -4.1,B 0.6,C 188.7",
                "X 1373.9,Y 11.9,Z 1052.0,A 35.2,B -32.5,C 160.3",
            ),
            (
                "X 1376.1,Y -258.1,Z 812.0,A -4.3,B -4.8,C 214.2",
                "X 1507.6,Y 140.3,Z 999.9,A 19.5,B -3.4,C 157.8",
            ),
            (
                "X 1699.1,Y 495.7,Z 1136.1,A 24.9,B -14.8,C 153.0",
                "X 1415.6,Y -429.8,Z 1106.5,A -12.0,B 27.7,C 168.7",
            ),
            (
                "X 1528.9,Y -368.4,Z 944.9,A 46.9,B 38.4,C 195.7",
                "X 1576.5,Y 84.4,Z 856.1,A -55.8,B -38.6,C 221.0",
            ),
        ] {
            let program = |how: &str, verb: &str| {
                format!(
                    "DEF t()\n$TOOL={{X 0,Y 0,Z 300,A 0,B 0,C 0}}\n$BASE=$WORLD\n\
                     PTP {{A1 25,A2 -80,A3 90,A4 0,A5 80,A6 25}}\n$ORI_TYPE={how}\n\
                     PTP {{{from}}}\n{verb} {{{to}}}\nEND\n"
                )
            };
            let ptp = last(&profile, &program("#VAR", "PTP"));
            let led = last(&profile, &program("#JOINT", "LIN"));
            let even = last(&profile, &program("#VAR", "LIN"));
            assert!(apart(&ptp, &led) < 2e-3, "{joint}: {ptp:?} {led:?}");
            other += u32::from(apart(&ptp, &even) > 0.02);
            all += 1;
        }
    }
    // an even rotation makes some of them turn back
    assert!(other > 0 && other < all, "{other} of {all}");
}

/// Two straight moves, the first to a target at the wrist's singularity.
const SINGULAR: &str = "/JOB
//NAME T1
//POS
///NPOS 3,0,0,0,0,0
///TOOL 9
///POSTYPE ANGLE
///ANGLE
C00000=5.0000,10.0000,-10.0000,20.0000,-2.0000,5.0000
///POSTYPE BASE
///RECTAN
///RCONF 0,0,0,0,0,0,0,0
C00001=723.419,80.873,273.416,105.1853,-69.8971,97.7758
C00002=716.438,71.120,249.628,125.5832,-67.8887,76.1427
//INST
///DATE 2023/11/08 06:41
///ATTR SC,RW
///GROUP1 RB1
NOP
MOVJ C00000 VJ=25.00
MOVL C00001 V=100.0
MOVL C00002 V=100.0
END
";

#[test]
fn a_path_that_goes_on_otherwise_behind_a_singular_target_is_an_error() {
    let folder = scratch();
    let given = folder.path().join("T1.JBI");
    std::fs::write(&given, SINGULAR).expect("a writable folder");
    for how in ["flip", "nearest"] {
        let output = poseshift()
            .arg("compensate")
            .arg(&given)
            .arg("--profile")
            .arg(repository("programs/inform/profile.yaml"))
            .args(["--tool", "9=20,-10,110,10,20,0"])
            .args(["--start-joints", "5,10,-10,20,-2,5"])
            .args(["--at-singularity", how, "-o"])
            .arg(folder.path().join("out.JBI"))
            .output()
            .expect("the program starts");
        let reported = String::from_utf8_lossy(&output.stdout);
        assert_eq!(output.status.code(), Some(1), "{how}: {reported}");
        assert!(
            reported.contains("error[several-postures]"),
            "{how}: {reported}"
        );
        assert!(!folder.path().join("out.JBI").exists());
    }
}

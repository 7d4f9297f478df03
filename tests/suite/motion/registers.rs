//! What FANUC programs write into registers displaces points as far as the text tells.

use super::displaced::{misses, unknown};
use super::{PLAIN, checked, errors, given, message, profile_of};
use poseshift::compensate::{Compensation, compensate};
use poseshift::geometry::units::{DEG, mm_from_m};
use poseshift::geometry::{Pose, Rotation};
use poseshift::program::{Source, language_of};

const ARM: &str = "robots/fanuc_lrmate200ic.yaml";
pub(super) const AT: [f64; 6] = [450.0, 60.0, 250.0, 180.0, 0.0, 20.0];

pub(super) fn point(number: u32, n: [f64; 6]) -> String {
    let [x, y, z, w, p, r] = n;
    format!(
        "P[{number}]{{\n GP1:\n UF : 0, UT : 1, CONFIG : 'N U T, 0, 0, 0',\n X = {x:.6} mm, Y = \
         {y:.6} mm, Z = {z:.6} mm,\n W = {w:.6} deg, P = {p:.6} deg, R = {r:.6} deg\n}};\n"
    )
}

pub(super) fn listing(name: &str, lines: &str, points: &str) -> String {
    let lines = lines.lines().map(|line| format!(" : {line} ;\n"));
    let lines: String = lines.collect();
    format!("/PROG {name}\n/MN\n{lines}/POS\n{points}/END\n")
}

fn program(lines: &str) -> String {
    let lines = format!("UFRAME_NUM=0\nUTOOL_NUM=1\nJ P[1] 10% FINE\n{lines}");
    listing("T", &lines, &(point(1, AT) + &point(9, [0.0; 6])))
}

fn read(files: &[&str]) -> Compensation {
    let names = ["a.ls", "b.ls", "c.ls"].into_iter();
    let files: Vec<(&str, &str)> = names.zip(files.iter().copied()).collect();
    read_named(&files)
}

pub(super) fn read_named(files: &[(&str, &str)]) -> Compensation {
    let sources = files.iter();
    let sources = sources.map(|(name, text)| Source::new(*name, text.as_bytes().to_vec()));
    let sources: Vec<Source> = sources.collect();
    let language = language_of(&sources[0]).expect("FANUC");
    compensate(language, &sources, &profile_of(ARM, &[PLAIN]), &given()).expect("read")
}

fn of(lines: &str) -> Compensation {
    read(&[&program(lines)])
}

fn numbers(pose: &Pose) -> [f64; 6] {
    let [x, y, z] = pose.translation.map(mm_from_m);
    let [r, p, w] = pose.rotation.rzryrx(AT[3] * DEG).map(|angle| angle / DEG);
    [x, y, z, w, p, r]
}

/// How far from the point and `by` lands what goes to its rewritten numbers and `by`, millimetres: a
/// program with both written out, on the real arm.
fn truth(by: &Pose, in_tool: bool) -> f64 {
    let moved = |pose: Pose| if in_tool { pose * *by } else { *by * pose };
    let plain = of("");
    let fake = plain.targets[0].fake.expect("a target that is rewritten");
    let [x, y, z, w, p, r] = AT;
    let original = Pose {
        rotation: Rotation::from_rzryrx([r * DEG, p * DEG, w * DEG]),
        translation: [x, y, z].map(|mm| mm / 1000.0),
    };
    let source = |there: Pose| {
        let points = point(1, AT) + &point(2, numbers(&there));
        let lines = "UFRAME_NUM=0\nUTOOL_NUM=1\nJ P[1] 10% FINE\nL P[2] 100mm/sec FINE";
        [Source::new(
            "a.ls",
            listing("T", lines, &points).into_bytes(),
        )]
    };
    let (written, nominal) = (source(moved(fake)), source(moved(original)));
    let profile = profile_of(ARM, &[PLAIN]);
    let checked = checked(&profile, &written, Some(&nominal));
    mm_from_m(checked.moves[1].target_error.distance_m)
}

fn up(mm: f64) -> f64 {
    truth(&Pose::from_translation(0.0, 0.0, mm / 1000.0), false)
}

fn is_about(found: &[f64], wanted: f64, case: &str) {
    assert!(wanted > 0.05, "{case}: {wanted}");
    let [found] = found else {
        panic!("{case}: {found:?}");
    };
    assert!((found - wanted).abs() < 0.003, "{case}: {found}, {wanted}");
}

const ZERO: &str = "PR[10]=LPOS\nPR[10]=PR[10]-PR[10]\n";
const GO: &str = "L P[1] 100mm/sec FINE Offset,PR[10]\n";

#[test]
fn an_offset_whose_numbers_the_text_tells_is_judged_by_them() {
    let wanted = up(-200.0);
    let each = "PR[10,1]=0\nPR[10,2]=0\nPR[10,4]=0\nPR[10,5]=0\nPR[10,6]=0\n";
    for lines in [
        format!("{ZERO}PR[10,3]=(-200)\n{GO}"),
        format!("{ZERO}R[5:down]=200\nPR[10,3:z, down]=R[5:down]*(-1)\n{GO}"),
        format!("{ZERO}PR[10,3]=R[5]\nL P[1] 9mm/sec FINE Offset,PR[10]\n")
            .replace("PR[10,3]", "R[5]=0-200\nPR[10,3]"),
        format!("{each}PR[10,3]=(-200)\n{GO}"),
        // a point that nothing rewrites
        format!("PR[10]=P[9]\nPR[10,3]=(-200)\n{GO}"),
        format!(
            "PR[11]=P[9]\nPR[11,3]=(-150)\nPR[12]=PR[11]-P[9]\nPR[12,3]=0-50\nPR[10]=PR[11]+PR[12]\n{GO}"
        ),
        // behind a label, a call
        format!("{ZERO}PR[10,3]=(-200)\nLBL[1]\n{GO}"),
        format!("{ZERO}PR[10,3]=(-200)\nCALL GRIP\nIF DI[1]=ON,JMP LBL[9]\n{GO}LBL[9]"),
        // a copy of the point
        "PR[1]=P[1]\nPR[1,3]=PR[1,3]-200\nL PR[1] 9mm/sec FINE".into(),
        "R[5]=200\nPR[1]=P[1]\nPR[1,3]=PR[1,3]-R[5]\nL PR[1] 9mm/sec FINE".into(),
        "PR[1]=P[1]\nR[5]=PR[1,3]\nR[5]=R[5]-200\nPR[1,3]=R[5]\nL PR[1] 9mm/sec FINE".into(),
        format!("{ZERO}PR[10,3]=(-200)\nPR[1]=P[1]+PR[10]\nL PR[1] 9mm/sec FINE"),
        format!(
            "{ZERO}PR[10,3]=200\nPR[1]=P[1]\nCALL GRIP\nPR[1]=PR[1]-PR[10]\nL PR[1] 9mm/sec FINE"
        ),
        format!("{ZERO}PR[10,3]=(-200)\nOFFSET CONDITION PR[10]\nL P[1] 9mm/sec FINE Offset"),
        format!("{ZERO}PR[10,3]=(-200)\nR[1]=10\nL P[1] 9mm/sec FINE Offset,PR[R[1]]"),
    ] {
        let done = of(&lines);
        assert_eq!(unknown(&done), [0.0; 0], "{lines}: {:?}", done.findings);
        is_about(&misses(&done), wanted, &lines);
    }
}

#[test]
fn each_move_has_what_was_written_last() {
    let lines = format!("{ZERO}PR[10,3]=(-200)\n{GO}PR[10,3]=(-100)\n{GO}");
    let found = misses(&of(&lines));
    assert_eq!(found.len(), 2);
    is_about(&found[..1], up(-200.0), "first");
    assert!((found[1] - up(-100.0)).abs() < 0.003);
}

#[test]
fn an_offset_in_the_tool_counts_along_and_about_its_axes() {
    let go = GO.replace("Offset", "Tool_Offset");
    let lines = |numbers: &str| format!("{ZERO}{numbers}{go}");
    let along = truth(&Pose::from_translation(0.0, 0.05, 0.2), true);
    is_about(
        &misses(&of(&lines("PR[10,2]=50\nPR[10,3]=200\n"))),
        along,
        "along",
    );
    let turned = Pose {
        rotation: Rotation::from_rzryrx([20.0, 10.0, 30.0].map(|angle| angle * DEG)),
        translation: [0.0, 0.0, 0.2],
    };
    let numbers = "PR[10,3]=200\nPR[10,4]=30\nPR[10,5]=10\nPR[10,6]=20\n";
    is_about(
        &misses(&of(&lines(numbers))),
        truth(&turned, true),
        "turned",
    );
}

#[test]
fn one_of_several_counts_as_the_worst_of_them() {
    let wanted = up(-200.0);
    let counted = format!("{ZERO}FOR R[1]=1 TO 5\nPR[10,3]=R[1]*(-40)\n{GO}ENDFOR");
    let grown = format!("{ZERO}R[2]=0\nFOR R[1]=1 TO 5\nR[2]=R[2]-40\nPR[10,3]=R[2]\n{GO}ENDFOR");
    let either = format!("{ZERO}IF (DI[1]=ON) THEN\nPR[10,3]=(-200)\nENDIF\n{GO}");
    let copy = "PR[1]=P[1]\nFOR R[1]=1 TO 5\nPR[1,3]=PR[1,3]-40\nL PR[1] 9mm/sec FINE\nENDFOR";
    // loops of jumps: the condition behind or before what is repeated, the number itself, another one
    // that counts along
    let below =
        format!("{ZERO}R[2]=0\nLBL[1]\nPR[10,3]=R[2]\n{GO}R[2]=R[2]-40\nIF R[2]>(-200),JMP LBL[1]");
    let above = format!(
        "{ZERO}R[1]=0\nLBL[1]\nIF (R[1]>=5 OR DI[1]),JMP LBL[2]\nPR[10,3]=R[1]*(-40)\n{GO}R[1]=R[1]+1\nJMP \
         LBL[1]\nLBL[2]"
    );
    let along = format!(
        "{ZERO}R[1]=0\nLBL[1]\n{GO}PR[10,3]=PR[10,3]-40\nR[1]=R[1]+1\nIF R[1]<>5,JMP LBL[1]"
    );
    let turned_back = format!(
        "{ZERO}R[1]=0\nLBL[1]\nPR[10,3]=R[1]*(-40)\n{GO}R[1]=R[1]+1\nIF (R[1]>=5) THEN\nR[1]=0\nENDIF\nJMP \
         LBL[1]"
    );
    let jumping = [&below, &above, &along, &turned_back].map(String::as_str);
    for lines in [&counted, &grown, &either, copy].into_iter().chain(jumping) {
        let done = of(lines);
        let most = unknown(&done).into_iter().fold(0.0, f64::max);
        let misses = misses(&done).into_iter().fold(most, f64::max);
        assert!(
            (misses - wanted).abs() < 0.003,
            "{lines}: {:?}",
            done.findings
        );
        assert_eq!(errors(&done), ["displacement-unknown"], "{lines}");
    }
    // a counter that is set back, a loop by a jump
    let back = grown.replace("PR[10,3]=R[2]", "IF DI[1]=ON,R[1]=R[1]-1\nPR[10,3]=R[2]");
    let jump = format!("{ZERO}R[2]=0\nLBL[1]\nR[2]=R[2]-40\nPR[10,3]=R[2]\n{GO}JMP LBL[1]");
    // the counter begins anew inside the loop, or is another one
    let anew = along.replace("R[1]=0\nLBL[1]", "LBL[1]\nR[1]=0");
    let other = along.replace("IF R[1]<>5", "IF R[3]<>5");
    let any = along.replace("IF R[1]<>5,JMP LBL[1]", "IF R[1]<5,JMP LBL[R[9]]");
    let sensor = format!("{ZERO}R[2]=0\nLBL[1]\nR[2]=R[2]-AI[1]\nPR[10,3]=R[2]\n{GO}JMP LBL[1]");
    for lines in [&back, &jump, &sensor, &anew, &other, &any] {
        let done = of(lines);
        let said = unknown(&done).into_iter().fold(0.0, f64::max);
        let has_no_bound = done
            .findings
            .iter()
            .any(|f| f.message.contains("not bound"));
        assert!(
            has_no_bound || said > 0.9 * wanted,
            "{lines}: {:?}",
            done.findings
        );
        assert_eq!(errors(&done), ["displacement-unknown"], "{lines}");
    }
}

#[test]
fn programs_of_one_run_share_registers_and_have_what_calls_give() {
    let main = "R[7]=3\nCALL SET(200)\nCALL GO";
    let set = listing("SET", &format!("{ZERO}PR[10,3]=AR[1]*(-1)"), "");
    let lines = format!("UFRAME_NUM=0\nUTOOL_NUM=1\nJ P[1] 10% FINE\n{GO}");
    let go = listing("GO", &lines, &point(1, AT));
    let done = read(&[&go, &listing("MAIN", main, ""), &set]);
    is_about(&misses(&done), up(-200.0), "by a call");
    let twice = main.replace("CALL SET(200)", "CALL SET(10)\nCALL GO\nCALL SET(200)");
    let done = read(&[&go, &listing("MAIN", &twice, ""), &set]);
    let most = unknown(&done).into_iter().fold(0.0, f64::max);
    assert!((most - up(-200.0)).abs() < 0.003, "{:?}", done.findings);
    assert_eq!(errors(&done), ["displacement-unknown"]);
}

#[test]
fn what_only_the_robot_knows_counts_as_what_a_sensor_says() {
    for lines in [
        GO.to_owned(),
        format!("PR[10]=VR[1].OFFSET\n{GO}"),
        format!("{ZERO}PR[10,3]=AI[1]\n{GO}"),
        format!("PR[10]=PR[11]-PR[12]\n{GO}"),
        "L P[1] 9mm/sec FINE VOFFSET,VR[1]".into(),
        "PR[1]=P[1]\nPR[1,3]=PR[1,3]+R[5]\nL PR[1] 9mm/sec FINE".into(),
        "PR[1]=P[1]+PR[11]\nL PR[1] 9mm/sec FINE".into(),
    ] {
        let done = of(&lines);
        let message = message(&done, "displacement-unknown");
        assert!(message.contains("up to 5 mm"), "{lines}: {message}");
        assert_eq!(errors(&done), [""; 0], "{lines}");
    }
    // what the text alone tells comes to more
    let far = of(&format!("PR[10,3]=(-200)\n{GO}"));
    assert!(unknown(&far)[0] > up(-200.0) - 0.003, "{:?}", far.findings);
    assert_eq!(errors(&far), ["displacement-unknown"]);
}

#[test]
fn what_is_not_followed_has_no_bound() {
    for lines in [
        format!("{ZERO}PR[10,3]=200\nPR[10,6]=90\n{GO}"),
        format!("{ZERO}R[1]=200\nPR[10,3]=ABS[R[1]]\n{GO}"),
        // where the robot is may be anywhere
        format!("PR[10]=LPOS\n{GO}"),
        format!("PR[11]=P[1]\nPR[10]=PR[11]-P[9]\n{GO}"),
        format!("PR[10]=JPOS\nPR[10]=PR[10]-PR[10]\nPR[10,3]=20\n{GO}"),
        format!("{ZERO}PR[10,7]=300\n{GO}"),
        format!(
            "{ZERO}PR[10,3]=200\nOFFSET CONDITION PR[10],UFRAME[2]\nL P[1] 9mm/sec FINE Offset"
        ),
        format!("{ZERO}PR[10,3]=200\nR[1]=GI[1]\nL P[1] 9mm/sec FINE Offset,PR[R[1]]"),
        format!(
            "{ZERO}PR[11]=PR[10]\nPR[11,3]=200\nPR[1]=MATRIX[P[1],PR[11]]\nL PR[1] 9mm/sec FINE"
        ),
        "PR[1]=P[1]\nR[1]=GI[1]\nPR[R[1],3]=PR[R[1],3]+200\nL PR[1] 9mm/sec FINE".into(),
    ] {
        let done = of(&lines);
        assert!(
            message(&done, "displacement-unknown").contains("not bound"),
            "{lines}: {:?}",
            done.findings
        );
        assert_eq!(errors(&done), ["displacement-unknown"], "{lines}");
    }
}

#[test]
fn a_register_that_no_program_writes_is_what_posreg_va_shows() {
    let text = program("L P[1] 100mm/sec FINE Offset,PR[7]");
    let shown = "[*POSREG*]$POSREG  Storage: CMOS  Access: RW  : ARRAY[1,100] OF Position Reg\n    [1,7] \
                 =   '' \n  Group: 1   Config: N U T, 0, 0, 0\n  X:     0.000   Y:     0.000   Z:   \
                 150.000\n  W:     0.000   P:     0.000   R:     0.000\n";
    let without = of("L P[1] 100mm/sec FINE Offset,PR[7]");
    assert_eq!(unknown(&without).len(), 1, "{:?}", without.findings);
    let with = read_named(&[("a.ls", &text), ("posreg.va", shown)]);
    is_about(&misses(&with), up(150.0), "POSREG.VA");
}

#[test]
fn where_the_robot_was_displaced_is_a_note() {
    let found = of("PR[91]=LPOS\nPR[91,2]=PR[91,2]-100\nL PR[91] 100mm/sec FINE");
    assert!(message(&found, "run-time-position").contains("displaced"));
    assert_eq!(errors(&found), [""; 0]);
}

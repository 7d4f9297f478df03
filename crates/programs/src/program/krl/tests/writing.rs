//! What becomes of the numbers, and the marker.

use super::*;
use crate::program::number::Style;

fn posture(degrees: [f64; 6]) -> Posture {
    Posture {
        joints_rad: degrees.map(|d| d * DEG),
        behind_axis_1: false,
        behind_lower_arm: false,
    }
}

#[test]
fn orientation_is_a_about_z_then_b_about_y_then_c_about_x() {
    let decoded = Krl.decode(
        POSE,
        &[1000.0, 0.0, 0.0, 90.0, 0.0, 90.0],
        &Settings::default(),
    );
    let Value::Pose(pose) = decoded.value else {
        panic!("{decoded:?}")
    };
    let expected = [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    for (row, known) in pose.rotation.0.iter().zip(expected) {
        for (a, b) in row.iter().zip(known) {
            assert!((a - b).abs() < 1e-12, "{pose:?}");
        }
    }
    assert_eq!(decoded.configuration, Configuration::default());
}

#[test]
fn encoding_what_was_decoded_gives_the_same_numbers() {
    let at = posture([-1.0, -90.0, 90.0, 0.0, 30.0, -1.0]);
    for angles in [
        [10.0, 20.0, 30.0],
        [-180.0, 0.0, 180.0],
        [180.0, 0.0, -180.0],
        [0.0, 90.0, 0.0],
        [35.0, -90.0, 20.0],
        [170.0, 100.0, 170.0],
        [400.0, 0.0, 0.0],
        [0.0, 179.0, 0.0],
    ] {
        let [a, b, c] = angles;
        let mut numbers = [1.0, 2.0, 3.0, a, b, c, 2.0, 35.0];
        let before = numbers;
        let decoded = Krl.decode(CONFIGURED, &numbers, &Settings::default());
        Krl.encode(
            CONFIGURED,
            &decoded.value,
            &at,
            &at,
            &Settings::default(),
            &mut numbers,
        );
        let known = Krl.decode(CONFIGURED, &before, &Settings::default());
        let (Value::Pose(new), Value::Pose(old)) = (
            Krl.decode(CONFIGURED, &numbers, &Settings::default()).value,
            known.value,
        ) else {
            panic!("poses")
        };
        let gap = new.separation(&old);
        assert!(
            gap.distance_m < 1e-12 && gap.angle_rad < 1e-7,
            "{angles:?} {numbers:?}"
        );
        if b.abs() != 90.0 {
            for (is, was) in numbers.iter().zip(before) {
                assert!((is - was).abs() < 1e-9, "{angles:?} {numbers:?}");
            }
        }
    }
}

#[test]
fn axes_at_zero_change_their_bit_of_turn_only_when_they_cross() {
    let before = posture([0.4, -90.0, 90.0, 12.0, 30.0, -1.0]);
    let after = posture([-0.4, -90.2, 90.1, 12.1, 30.1, -1.2]);
    let value = Krl
        .decode(CONFIGURED, &[1.0; 8], &Settings::default())
        .value;
    for (turn, expected) in [(34.0, 35.0), (35.0, 35.0), (32.0, 33.0)] {
        let mut numbers = [1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 2.0, turn];
        Krl.encode(
            CONFIGURED,
            &value,
            &before,
            &after,
            &Settings::default(),
            &mut numbers,
        );
        assert_eq!(numbers[6..], [2.0, expected]);
    }
}

#[test]
fn bits_are_written_as_bits_and_numbers_as_numbers() {
    let text = "DEF M()\n$TOOL=$NULLFRAME\n$BASE=$WORLD\nPTP {X 1,Y 2,Z 3,A 0,B 0,C 0,T \
        'B100000',S 'B010'}\nEND\n";
    let program = read(text);
    let numbers = program.numbers_of(&program.targets[0]);
    let spelled: Vec<_> = numbers[6..]
        .iter()
        .map(|n| &text[n.start as usize..n.start as usize + usize::from(n.length)])
        .collect();
    assert_eq!(
        spelled,
        ["'B010'", "'B100000'"],
        "S before T, whatever the text has"
    );
    let mut out = Vec::new();
    Krl.write_configuration(CONFIGURED, 7, 33.0, spelled[1].as_bytes(), &mut out);
    assert_eq!(out, b"'B100001'");
}

#[test]
fn numbers_keep_their_decimals() {
    for (old, value, new) in [
        ("161.000", 161.0524, "161.052"),
        ("-90.0643234", -90.1, "-90.1000000"),
        ("-0.0000", 0.00001, "0.0000"),
    ] {
        let style = Style::of_group(
            [old.as_bytes()].into_iter(),
            0,
            crate::program::number::Fraction::Zero,
        );
        let mut out = Vec::new();
        style.write(old.as_bytes(), value, &mut out);
        assert_eq!(String::from_utf8_lossy(&out), new, "{old}");
    }
}

#[test]
fn decimals_of_angles_are_two_more_than_of_lengths() {
    let decimals = |role| Krl.decimals(role, 3);
    assert_eq!(decimals(Role::Position), 3);
    assert_eq!((decimals(Role::Orientation), decimals(Role::Joint)), (5, 5));
}

#[test]
fn the_marker_is_a_comment_behind_the_line_that_opens_the_file() {
    let marker = Marker {
        version: "1".into(),
        profile_sha256: "a".repeat(64),
        source_sha256: "b".repeat(64),
        decided: Vec::new(),
    };
    for (text, behind) in [
        (
            "&ACCESS RVP\r\n&REL 1\r\nDEF  M( )\r\nEND\r\n",
            "DEF  M( )\r\n",
        ),
        ("&ACCESS RVP\n&REL 1\nDEFDAT  M\nENDDAT", "DEFDAT  M\n"),
        ("; a\nGLOBAL DEF m()\nEND\n", "GLOBAL DEF m()\n"),
        ("&ACCESS RVP\nLIN {X 1}\n", "&ACCESS RVP\n"),
        ("DEF m()\rEND\r", "DEF m()\r"),
        ("PTP XHOME\n", ""),
    ] {
        let source = Source::new("m.src", text.as_bytes().to_vec());
        let (at, inserted) = Krl.mark(&source, &marker);
        assert!(text[..at].ends_with(behind), "{text:?} {at}");
        let inserted = String::from_utf8(inserted).expect("ASCII");
        assert!(
            inserted
                .split_inclusive(['\n', '\r'])
                .all(|line| line.starts_with("; ") || line == "\n")
        );
        let mut new = source.bytes.clone();
        new.splice(at..at, inserted.bytes());
        assert!(Marker::find(&new).is_some());
        let read_again =
            crate::motion::read(&Krl, &[Source::new("m.src", new)], &Settings::default());
        let read_before = crate::motion::read(&Krl, &[source], &Settings::default());
        assert_eq!(read_again.is_ok(), read_before.is_ok());
    }
}

#[test]
fn status_and_turn_in_bits_with_blanks_are_read() {
    for (text, status, turn) in [
        ("S 'B 010',T 'B 001010'", 2.0, 10.0),
        ("S 'H 2',T 'H 0A'", 2.0, 10.0),
        ("S'B010',T'HA'", 2.0, 10.0),
    ] {
        let program = path(&format!("PTP {{X 1,Y 2,Z 3,A 0,B 0,C 0,{text}}}"));
        let target = program.moves[0].target.expect("a target");
        assert_eq!(program.targets[target].layout, CONFIGURED, "{text}");
        assert_eq!(values(&program, target)[6..], [status, turn], "{text}");
        assert_eq!(reported(&program), [""; 0], "{text}");
    }
}

/// Points of a data list behind joints in the text, which come first.
#[test]
fn parts_of_points_are_those_of_the_points_that_are_named() {
    let last = |write: &str| {
        let text = format!("PTP {{A1 0,A2 -90,A3 90,A4 0,A5 45,A6 0}}\nq=XP2\n{write}\nLIN q");
        let program = path(&format!("DECL E6POS q\nREAL r\n{text}"));
        let last = program.moves.last().expect("a move").clone();
        let name = program.targets[last.target.expect("known")].name.clone();
        assert_eq!(name.as_deref(), Some("XP2"), "{write}");
        (program, last.displacement)
    };
    assert_eq!(last("q.X=XP1.X").1, Displacement::Overwritten);
    assert_eq!(last("q.X=XP3.X+5").1, Displacement::Overwritten);
    let along = Shift::along([0.005, 0.0, 0.0]);
    for write in [
        "q.X=XP2.X+5",
        "q.X=5+XP2.X",
        "q.X=(XP2.X)+5",
        "q.X=2+XP2.X+3",
        "q.X=+XP2.X+5",
    ] {
        assert_eq!(last(write).1, Displacement::By(Box::new(along)), "{write}");
    }
    // a copy of what is displaced itself
    let both = Shift::along([0.005, 0.0, 0.08]);
    for write in [
        "q.X=XP2.X+5\nu=q\nu.Z=q.Z+80\nq=u",
        "q.X=XP2.X+5\nu=q\nu.Z=80+XP2.Z\nq=u",
        "u=XP2\nu.Z=u.Z+50\nq.X=q.X+5\nq.Z=u.Z+30",
        "u=XP2\nu.Y=u.Y+9\nq.X=q.X+5\nq.Z=u.Z+80",
    ] {
        let write = format!("DECL E6POS u\n{write}");
        assert_eq!(last(&write).1, Displacement::By(Box::new(both)), "{write}");
    }
    // as far as the rounds of a loop lead
    let by = |round: &str| last(&format!("DECL INT i\n{round}")).1;
    let grown = |most| {
        let shift = Shift::along([0.012, 0.0, 0.0]);
        Displacement::Within(Box::new([Stride::By { shift, most }]))
    };
    let step = "q.X=q.X+12\nLIN q\nENDFOR";
    assert_eq!(by(&format!("FOR i=1 TO 3\n{step}")), grown(Some(3)));
    assert_eq!(by(&format!("FOR i=9 TO 1 STEP -4\n{step}")), grown(Some(3)));
    assert_eq!(by(&format!("FOR i=1 TO n\n{step}")), grown(None));
    assert_eq!(
        by(&format!("FOR i=1 TO 3\nIF a THEN\ni=1\nENDIF\n{step}")),
        grown(None)
    );
    assert_eq!(
        by(&format!(
            "FOR i=1 TO 3\nagain:\nIF a THEN\nGOTO again\nENDIF\n{step}"
        )),
        grown(None)
    );
    // a coordinate that is read of one of them
    let (program, by) = last("r=XP3.Z/4\nq.Z=q.Z+r");
    let Displacement::Within(strides) = by else {
        panic!("{by:?}");
    };
    let read = strides.iter().flat_map(|stride| match stride {
        Stride::Read { of, .. } => of.targets().collect(),
        _ => Vec::new(),
    });
    let names: Vec<_> = read.map(|at| program.targets[at].name.as_deref()).collect();
    assert_eq!(names, [Some("XP3")]);
}

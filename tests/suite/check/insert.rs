//! Targets between those of a program, in every language that has them: what is written reads back
//! as the same program with more moves, each like the one it stands before, and the path is within
//! the limit.

use crate::support::{poseshift, repository, scratch};
use serde_json::Value;
use std::path::{Path, PathBuf};

/// A program with a straight way and an arc, long enough to leave their paths.
struct Case {
    language: &'static str,
    /// Names and texts of its files; the first holds the moves.
    files: &'static [(&'static str, &'static str)],
    /// What every line of a straight move to a new target has, and how many lines have it at
    /// first.
    straight: &'static [&'static str],
    /// Likewise of arcs.
    arc: &'static [&'static str],
}

const KRL: Case = Case {
    language: "krl",
    files: &[
        (
            "t.src",
            "DEF t ( )
BAS(#INITMOV,0)
$TOOL={X 0,Y 0,Z 300,A 0,B 0,C 0}
$BASE={X 0,Y 0,Z 0,A 0,B 0,C 0}
PTP {A1 25,A2 -80,A3 90,A4 0,A5 80,A6 25}
PTP XP1
;FOLD LIN P2 Vel=0.25 m/s CPDAT1 ;%{PE}
  LIN XP2 C_DIS ; seam
;ENDFOLD
CIRC {X 1450.001,Y 300.001,Z 900.001,A 0.0001,B 0.0001,C 180.0001}, {X 1600.001,Y -600.001,Z 900.001,A 0.0001,B 0.0001,C 180.0001}
END
",
        ),
        (
            "t.dat",
            "DEFDAT t
DECL E6POS XP1={X 1600.500,Y -600.250,Z 900.125,A 0.0001,B 0.0001,C 180.0000,S 2,T 2,E1 0.0}
DECL E6POS XP2={X 1600.500,Y 600.250,Z 900.125,A 0.0001,B 0.0001,C 180.0000,S 2,T 2,E1 0.0}
ENDDAT
",
        ),
    ],
    straight: &["  LIN ", "C_DIS"],
    arc: &["CIRC {", "}, {"],
};

const FANUC: Case = Case {
    language: "fanuc",
    files: &[(
        "t.ls",
        "/PROG  T
/ATTR
LINE_COUNT = 6;
/MN
   1:  UTOOL_NUM=1 ;
   2:  UFRAME_NUM=0 ;
   3:J P[1] 20% FINE    ;
   4:J P[1] 20% FINE    ;
   5:L P[2:seam] 250mm/sec CNT50 ACC80    ;
   6:C P[3]
    :  P[4] 100mm/sec FINE    ;
/POS
P[1]{
   GP1:
	UF : 0, UT : 1,		CONFIG : 'N U T, 0, 0, 0',
	X =  1900.125  mm,	Y =  -600.250  mm,	Z =   500.500  mm,
	W =   180.000 deg,	P =     0.000 deg,	R =     0.000 deg
};
P[2:\"seam\"]{
   GP1:
	UF : 0, UT : 1,		CONFIG : 'N U T, 0, 0, 0',
	X =  1900.125  mm,	Y =   600.250  mm,	Z =   500.500  mm,
	W =   180.000 deg,	P =     0.000 deg,	R =     0.000 deg
};
P[3]{
   GP1:
	UF : 0, UT : 1,		CONFIG : 'N U T, 0, 0, 0',
	X =  1650.000  mm,	Y =   200.000  mm,	Z =   500.500  mm,
	W =   180.000 deg,	P =     0.000 deg,	R =     0.000 deg
};
P[4]{
   GP1:
	UF : 0, UT : 1,		CONFIG : 'N U T, 0, 0, 0',
	X =  1900.125  mm,	Y =  -600.250  mm,	Z =   500.500  mm,
	W =   180.000 deg,	P =     0.000 deg,	R =     0.000 deg
};
/END
",
    )],
    straight: &["L P[", " 250mm/sec CNT50 ACC80    ;"],
    arc: &[":  P[", " 100mm/sec FINE    ;"],
};

const URSCRIPT: Case = Case {
    language: "urscript",
    files: &[(
        "t.script",
        "def t():
  seam = p[0.200000,-0.400000,0.200000,0.000000,3.141592,0.000001]
  set_tcp(p[0,0,0.1,0,0,0])
  movej([-1.2,-1.6,-1.6,-1.5,1.57,0.2],1.2,0.75)
  movel(p[-0.550000,-0.400000,0.200000,0.000000,3.141592,0.000001], a=1.2, v=0.25, r=0.005)
  movel(seam, a=1.2, v=0.1)
  movec(p[-0.100000,-0.550000,0.250000,0.000000,3.141592,0.000001],p[-0.400000,-0.300000,0.200000,0.000000,3.141592,0.000001],1.2,0.25,0.0,0)
end
",
    )],
    straight: &["  movel(", ", a=1.2, v=0.1)"],
    arc: &["  movec(p[", ",1.2,0.25,0.0,0)"],
};

const INFORM: Case = Case {
    language: "inform",
    files: &[(
        "T.JBI",
        "/JOB\r
//NAME T\r
//POS\r
///NPOS 5,0,0,1,0,0\r
///TOOL 0\r
///POSTYPE PULSE\r
///PULSE\r
C00000=-20000,30000,-10000,0,-60000,3000\r
///POSTYPE BASE\r
///RECTAN\r
///RCONF 1,0,0,0,0,0,0,0\r
C00001=450.000,-350.000,100.000,180.0000,0.0000,0.0000\r
C00002=450.000,350.000,100.000,180.0000,0.0000,0.0000\r
C00003=350.000,100.000,100.000,180.0000,0.0000,0.0000\r
C00004=450.000,-350.000,100.000,180.0000,0.0000,0.0000\r
///POSTYPE PULSE\r
///PULSE\r
P00000=0,0,0,0,0,0\r
//INST\r
///DATE 2024/03/02 09:15\r
///ATTR SC,RW\r
///GROUP1 RB1\r
NOP\r
MOVJ C00000 VJ=20.00\r
MOVJ C00001 VJ=5.00\r
MOVL C00002 V=30.0 PL=1\r
MOVC C00002 V=30.0 PL=0\r
MOVC C00003 V=30.0 PL=0\r
MOVC C00004 V=30.0 PL=0\r
END\r
",
    )],
    straight: &["MOVL C0", " V=30.0 PL=1"],
    arc: &["MOVC C0", " V=30.0 PL=0"],
};

const VAL3: Case = Case {
    language: "val3",
    files: &[
        (
            "start.pgx",
            "<?xml version=\"1.0\" encoding=\"utf-8\"?>
<Programs xmlns=\"http://www.staubli.com/robotics/VAL3/Program/2\">
  <Program name=\"start\" access=\"public\">
    <Code><![CDATA[
begin
  movej(jA,tA,mA)
  movej(pA,tA,mA)
  nId=movel(pB[1],tA,mA) // seam
  movec(pB[2],pA,tA,mA)
end
]]></Code>
  </Program>
</Programs>
",
        ),
        (
            "t.dtx",
            "<?xml version=\"1.0\" encoding=\"utf-8\"?>
<Database xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\" \
    xmlns=\"http://www.staubli.com/robotics/VAL3/Data/2\">
  <Datas>
    <Data name=\"jA\" access=\"private\" xsi:type=\"array\" type=\"jointRx\" size=\"1\">
      <Value key=\"0\" j1=\"-35\" j2=\"30\" j3=\"80\" j5=\"70\" />
    </Data>
    <Data name=\"pA\" access=\"private\" xsi:type=\"array\" type=\"pointRx\" size=\"1\">
      <Value key=\"0\" x=\"600\" y=\"-400.5\" z=\"-150\" rx=\"180\" shoulder=\"lefty\" \
          elbow=\"epositive\" wrist=\"wpositive\" fatherId=\"world[0]\" />
    </Data>
    <Data name=\"pB\" access=\"private\" xsi:type=\"array\" type=\"pointRx\" size=\"3\">
      <Value key=\"1\" x=\"600\" y=\"400.5\" z=\"-150\" rx=\"180\" fatherId=\"world[0]\" />
      <Value key=\"2\" x=\"450\" z=\"-150\" rx=\"180\" fatherId=\"world[0]\" />
    </Data>
    <Data name=\"tA\" access=\"private\" xsi:type=\"array\" type=\"tool\" size=\"1\">
      <Value key=\"0\" z=\"120\" fatherId=\"flange[0]\" ioLink=\"valve1\" />
    </Data>
  </Datas>
</Database>
",
        ),
    ],
    straight: &["  nId=movel(p", ",tA,mA)"],
    arc: &["  movec(p", ",tA,mA)"],
};

const KAWASAKI: Case = Case {
    language: "kawasaki",
    files: &[(
        "t.as",
        ".PROGRAM t()\r
  TOOL TRANS(0,0,100,0,0,0)\r
  BASE NULL\r
  JMOVE #[-40,30,-90,0,-60,-40]\r
  JMOVE corner\r
  LMOVE TRANS(350.000,450.000,100.000,90.0000,180.0000,0.0000)  ; seam\r
  C1MOVE TRANS(150.000,350.000,150.000,90.0000,180.0000,0.0000)\r
  C2MOVE TRANS(-350.000,450.000,100.000,90.0000,180.0000,0.0000)\r
.END\r
.TRANS\r
corner -350.000000 450.000000 100.000000 90.000000 180.000000 0.000000\r
.END\r
",
    )],
    straight: &["  LMOVE TRANS("],
    arc: &["  C2MOVE TRANS("],
};

/// Beyond this the path may not be, mm.
const LIMIT_MM: f64 = 0.04;

fn command(arguments: &[String]) -> (i32, String) {
    let output = poseshift()
        .current_dir(repository(""))
        .args(arguments)
        .output()
        .expect("the program starts");
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let error = String::from_utf8_lossy(&output.stderr);
    let status = output.status.code().expect("it ended");
    let reported = if text.starts_with('{') {
        text
    } else {
        format!("{text}{error}")
    };
    (status, reported)
}

impl Case {
    fn profile(&self) -> String {
        format!("programs/{}/profile.yaml", self.language)
    }

    fn write(&self, folder: &Path) -> Vec<PathBuf> {
        let files = self.files.iter().map(|(name, text)| {
            let path = folder.join(name);
            std::fs::write(&path, text).expect("a writable folder");
            path
        });
        files.collect()
    }

    /// Compensates the files of a folder into another.
    fn compensate(&self, from: &Path, to: &Path, more: &[&str]) -> (i32, String) {
        let mut all = vec!["compensate".to_owned(), from.display().to_string()];
        all.extend(["--profile".to_owned(), self.profile()]);
        all.extend(["-o".to_owned(), to.display().to_string()]);
        all.extend(more.iter().map(|m| (*m).to_owned()));
        command(&all)
    }

    fn check(&self, folder: &Path, nominal: Option<&Path>) -> Value {
        let mut all = vec!["check".to_owned(), folder.display().to_string()];
        all.extend(["--profile".to_owned(), self.profile(), "--json".to_owned()]);
        all.extend(
            nominal
                .iter()
                .flat_map(|n| ["--nominal".to_owned(), n.display().to_string()]),
        );
        let (_, text) = command(&all);
        serde_json::from_str(&text).unwrap_or_else(|_| panic!("{text}"))
    }
}

/// Largest bound of a path of one kind, mm.
fn worst(report: &Value, kind: &str) -> f64 {
    let moves = report["moves"].as_array().expect("moves");
    // the first move comes from a joint target, which stays off where it is wanted
    let others = moves[2..].iter().filter(|m| m["kind"] == kind);
    others
        .filter_map(|m| m["max_path_error_mm"].as_f64())
        .fold(0.0, f64::max)
}

fn lines_with<'a>(text: &'a str, words: &[&str]) -> Vec<&'a str> {
    text.lines()
        .filter(|line| words.iter().all(|word| line.contains(word)))
        .collect()
}

fn try_case(case: &Case) {
    let folder = scratch();
    let at = |name: &str| {
        let path = folder.path().join(name);
        std::fs::create_dir(&path).expect("a writable folder");
        path
    };
    let (original, plain, fine) = (at("in"), at("plain"), at("fine"));
    case.write(&original);
    let (status, reported) = case.compensate(&original, &plain, &[]);
    assert_eq!(status, 0, "{}: {reported}", case.language);
    let limit = format!("{LIMIT_MM}");
    let (status, reported) = case.compensate(&original, &fine, &["--max-path-error", &limit]);
    assert_eq!(status, 0, "{}: {reported}", case.language);
    assert!(
        reported.contains("moves inserted"),
        "{}: {reported}",
        case.language
    );
    // the moves of the two written programs, by what the original wants
    let before = case.check(&plain, Some(&original));
    let after = case.check(&fine, Some(&original));
    for kind in ["linear", "arc"] {
        let (off, within) = (worst(&before, kind), worst(&after, kind));
        assert!(off > LIMIT_MM, "{} {kind}: {off}", case.language);
        assert!(within <= LIMIT_MM, "{} {kind}: {within}", case.language);
    }
    // new moves are like the ones they stand before
    let name = case.files[0].0;
    let text = |folder: &Path| std::fs::read(folder.join(name)).expect("it was written");
    let [first, old, new] = [&original, &plain, &fine].map(|f| text(f));
    let [first, old, new] =
        [first, old, new].map(|bytes| String::from_utf8(bytes).expect("plain text"));
    let (was, is) = (
        before["moves"].as_array().expect("moves").len(),
        after["moves"].as_array().expect("moves").len(),
    );
    for words in [case.straight, case.arc] {
        let (few, many) = (lines_with(&old, words).len(), lines_with(&new, words).len());
        assert!(few > 0 && many > few, "{}: {new}", case.language);
    }
    assert!(is > was, "{}", case.language);
    // every line that was there is there still, in its order, but for numbers; those of positions
    // are compared above
    let crlf = first.contains("\r\n");
    assert_eq!(
        new.matches('\n').count(),
        if crlf {
            new.matches("\r\n").count()
        } else {
            new.matches('\n').count()
        },
        "{}: line ends stay as they are",
        case.language
    );
    // the same again
    let again = at("again");
    case.compensate(&original, &again, &["--max-path-error", &limit]);
    assert_eq!(text(&again), new.into_bytes(), "{}", case.language);
}

#[test]
fn krl_gets_moves_to_positions_written_out() {
    try_case(&KRL);
}

#[test]
fn fanuc_gets_points_behind_the_highest() {
    try_case(&FANUC);
    let folder = scratch();
    FANUC.write(folder.path());
    let out = folder.path().join("out.ls");
    let input = folder.path().join("t.ls");
    FANUC.compensate(&input, &out, &["--max-path-error", "0.05"]);
    let text = std::fs::read_to_string(&out).expect("it was written");
    let points: Vec<u32> = text
        .lines()
        .filter(|line| line.starts_with("P[") && line.ends_with('{'))
        .filter_map(|line| line[2..].split([':', ']']).next()?.parse().ok())
        .collect();
    // 1, 2, 3, 4, then the new ones, each once
    let wanted: Vec<u32> = (1..=u32::try_from(points.len()).expect("few")).collect();
    assert!(points.len() > 4 && points == wanted, "{points:?}");
    // the lines of the original keep their numbers
    for number in 1..=6 {
        assert!(text.contains(&format!("   {number}:")), "{text}");
    }
}

#[test]
fn urscript_gets_calls_with_the_same_arguments() {
    try_case(&URSCRIPT);
}

#[test]
fn inform_gets_positions_behind_the_highest_and_counts_them() {
    try_case(&INFORM);
    let folder = scratch();
    INFORM.write(folder.path());
    let out = folder.path().join("OUT.JBI");
    let input = folder.path().join("T.JBI");
    INFORM.compensate(&input, &out, &["--max-path-error", "0.05"]);
    let text = std::fs::read_to_string(&out).expect("it was written");
    let count = text
        .lines()
        .filter(|line| line.starts_with("C0") && line.contains('='))
        .count();
    assert!(
        count > 5 && text.contains(&format!("///NPOS {count},0,0,1,0,0\r\n")),
        "{text}"
    );
    // what stands behind the new positions is under its own header lines again
    let pulses = text.find("P00000=").expect("it stays");
    let above = text[..pulses].rfind("///P").expect("a header line");
    assert!(text[above..].starts_with("///PULSE"), "{text}");
}

#[test]
fn val3_gets_points_in_the_data() {
    try_case(&VAL3);
    let folder = scratch();
    let (from, to) = (folder.path().join("in"), folder.path().join("out"));
    std::fs::create_dir(&from).expect("a writable folder");
    VAL3.write(&from);
    VAL3.compensate(&from, &to, &["--max-path-error", "0.04"]);
    let text = |name: &str| std::fs::read_to_string(to.join(name)).expect("it was written");
    let (data, code) = (text("t.dtx"), text("start.pgx"));
    let new = data.matches("<Data name=\"pShift").count();
    assert!(
        new > 0 && code.matches("pShift").count() == new,
        "{data}{code}"
    );
    // each has the frame of the point that it stands before
    assert_eq!(data.matches("fatherId=\"world[0]\"").count(), new + 3);
}

#[test]
fn kawasaki_gets_moves_to_positions_written_out() {
    try_case(&KAWASAKI);
}

#[test]
fn the_path_to_a_derived_point_ends_there() {
    let folder = scratch();
    let files = KAWASAKI.write(folder.path());
    let text = std::fs::read_to_string(&files[0]).expect("it was written");
    let text = text.replace(
        "  JMOVE corner",
        "  JMOVE corner\r\n  LAPPRO corner,50\r\n  LMOVE corner",
    );
    std::fs::write(&files[0], text).expect("a writable folder");
    let out = folder.path().join("out-t.as");
    let (_, reported) = KAWASAKI.compensate(&files[0], &out, &["--max-path-error", "0.05", "-v"]);
    for said in reported.split("begins or ends ").skip(1) {
        let off = said.split(' ').next().expect("a number");
        let off: f64 = off.parse().expect("millimetres");
        assert!(off < 10.0, "{reported}");
    }
}

#[test]
fn a_move_that_does_more_than_go_is_not_repeated() {
    // an output switched before the point, a time for the whole way, a tag that waits
    let cases = [
        (&FANUC, "ACC80", "TB .10sec,DO[1]=ON"),
        (
            &URSCRIPT,
            "movel(seam, a=1.2, v=0.1)",
            "movel(seam, a=1.2, t=20)",
        ),
        (
            &INFORM,
            "MOVL C00002 V=30.0 PL=1",
            "MOVL C00002 V=30.0 UNTIL IN#(1)=ON",
        ),
    ];
    for (case, from, to) in cases {
        let folder = scratch();
        let files = case.write(folder.path());
        let text = std::fs::read_to_string(&files[0]).expect("it was written");
        assert!(text.contains(from));
        std::fs::write(&files[0], text.replace(from, to)).expect("a writable folder");
        let out = folder.path().join(format!("out-{}", case.files[0].0));
        let (status, reported) = case.compensate(&files[0], &out, &["--max-path-error", "0.05"]);
        assert_eq!(status, 1, "{}: {reported}", case.language);
        assert!(
            reported.contains("path-not-refined") && reported.contains("cannot be repeated"),
            "{}: {reported}",
            case.language
        );
        assert!(!out.exists(), "{}", case.language);
    }
}

/// RAPID, where a process counts on its targets, or an output is switched at them.
#[test]
fn rapid_repeats_plain_moves_alone() {
    let text = "MODULE t
  PERS tooldata artifact := [TRUE,[[50,25,100],[1,0,0,0]],[2.6,[-23,0,100],[1,0,0,0],0,0,0]];
  CONST robtarget p1 := [[430.123,-200.456,300.789],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget p2 := [[430.123,200.456,300.789],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  PROC main()
    MoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v1000,fine,artifact;
    MoveJ p1,v200,fine,artifact;
    MoveL p2,v100,z10,artifact;
  ENDPROC
ENDMODULE
";
    for (line, status, because) in [
        ("MoveL p2,v100,z10,artifact;", 0, ""),
        ("MoveL p2,v100\\V:=90,z10,artifact\\TLoad:=l;", 0, ""),
        ("MoveLDO p2,v100,z10,artifact,do1,1;", 1, "does more"),
        ("TriggL p2,v100,trig1,z10,artifact;", 1, "does more"),
        ("MoveL p2,v100\\T:=5,z10,artifact;", 1, "\\T"),
        ("MoveL p2 \\ID:=10,v100,z10,artifact;", 1, "\\ID"),
        ("MoveL\\Conc,p2,v100,z10,artifact;", 1, "\\Conc"),
    ] {
        let folder = scratch();
        let (input, out) = (folder.path().join("t.mod"), folder.path().join("o.mod"));
        std::fs::write(&input, text.replace("MoveL p2,v100,z10,artifact;", line))
            .expect("a writable folder");
        let (got, reported) = command(
            &[
                "compensate",
                &input.display().to_string(),
                "--profile",
                "robots/abb_irb120_thesis.yaml",
                "--max-path-error",
                "0.05",
                "-o",
                &out.display().to_string(),
            ]
            .map(str::to_owned),
        );
        assert_eq!(got, status, "{line}: {reported}");
        assert_eq!(
            reported.contains("cannot be repeated"),
            status == 1,
            "{reported}"
        );
        assert!(reported.contains(because), "{line}: {reported}");
    }
}

/// Where moves end in an exact stop their pieces do so, too.
#[test]
fn stops_that_come_in_are_reported_once_a_file() {
    // what ends in a corner then, and what marks lines that stop the robot
    let cases: [(&Case, [&str; 2], &[&str]); 3] = [
        (
            &KRL,
            ["C 180.0001}\nEND", "C 180.0001} C_DIS\nEND"],
            KRL.arc,
        ),
        (&FANUC, ["100mm/sec FINE", "100mm/sec CNT50"], FANUC.arc),
        (
            &URSCRIPT,
            ["0.25,0.0,0)\nend", "0.25,0.01,0)\nend"],
            URSCRIPT.arc,
        ),
    ];
    for (case, [from, to], stopping) in cases {
        let refined = |text: &str| {
            let folder = scratch();
            let files = case.write(folder.path());
            std::fs::write(&files[0], text).expect("a writable folder");
            let out = folder.path().join("out");
            let options = ["--max-path-error", "0.04", "--json", "--keep-going"];
            let (_, report) = case.compensate(folder.path(), &out, &options);
            let report: Value =
                serde_json::from_str(&report).unwrap_or_else(|_| panic!("{report}"));
            let written = std::fs::read_to_string(out.join(case.files[0].0)).expect("a file");
            let found = |id: &str| -> Vec<String> {
                let all = report["findings"].as_array().expect("findings").iter();
                let of = all.filter(|finding| finding["id"] == id);
                of.map(|finding| finding["message"].to_string()).collect()
            };
            (written, found("stops-inserted"), found("form-overwritten"))
        };
        // straight moves of URScript stop anyway
        let text = case.files[0].1.replace("v=0.1)", "v=0.1, r=0.01)");
        let (written, stops, forms) = refined(&text);
        let added = lines_with(&written, stopping).len() - lines_with(&text, stopping).len();
        assert_eq!(stops.len(), 1, "{}{stops:?}", case.language);
        let said = match added {
            1 => "the target that comes in".to_owned(),
            _ => format!("{added} of the targets that come in"),
        };
        assert!(added > 0 && stops[0].contains(&said), "{added}{stops:?}");
        assert_eq!(
            forms.len(),
            usize::from(case.language == "krl"),
            "{forms:?}"
        );
        let (_, stops, _) = refined(&text.replace(from, to));
        assert_eq!(stops, [""; 0], "{}", case.language);
    }
}

#[test]
fn an_arc_through_a_frame_of_the_data_list_is_divided() {
    let text = std::fs::read_to_string(repository("robots/kuka_kr6_r900.yaml"));
    let text = text.expect("a profile");
    let plain = &text[..text.find("calibration:").expect("a list of effects")];
    let profile = format!(
        "{plain}calibration: {{effects: [{{effect: link_geometry, link: 3, theta_deg: 0.2, a_mm: \
         0.5}}, {{effect: joint_harmonic, joint: 1, order: 9, cos_deg: 0.1, sin_deg: 0}}]}}\n"
    );
    let dat = "DEFDAT t\nDECL E6POS XP1={X 600,Y -150,Z 600,A 180,B 0,C 180}\nDECL FRAME V1={X \
        680,Y 0,Z 600,A 180,B 0,C 180}\nDECL E6POS XP2={X 600,Y 150,Z 600,A 180,B 0,C 180}\nENDDAT\n";
    let src = "DEF t()\n$TOOL=$NULLFRAME\n$BASE=$WORLD\nPTP {A1 0,A2 -90,A3 90,A4 0,A5 45,A6 0}\nLIN \
        XP1\nCIRC V1,XP2\nEND\n";
    for dat in [dat.to_owned(), dat.replace("FRAME", "E6POS")] {
        let folder = scratch();
        let file = |name: &str| folder.path().join(name);
        std::fs::write(file("t.src"), src).expect("scratch");
        std::fs::write(file("t.dat"), &dat).expect("scratch");
        std::fs::write(file("p.yaml"), &profile).expect("scratch");
        let mut command = poseshift();
        command
            .arg("compensate")
            .arg(file("t.src"))
            .arg(file("t.dat"));
        command
            .arg("--profile")
            .arg(file("p.yaml"))
            .arg("-o")
            .arg(file("out"));
        let done = command
            .args(["--max-path-error", "0.02"])
            .output()
            .expect("it starts");
        let said = String::from_utf8_lossy(&done.stderr).into_owned();
        assert_eq!(done.status.code(), Some(0), "{dat}{said}");
        let text = std::fs::read_to_string(file("out/t.src")).expect("written");
        assert!(text.matches("CIRC").count() > 2, "{text}");
    }
}

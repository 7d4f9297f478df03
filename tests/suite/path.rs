//! One path of the thesis's IRB 120 written in every language: for tests and benchmarks.
//!
//! The tool is asked from the command line in all of them (`--tool artifact`), poses are in the
//! robot's base.

use poseshift::compensate::{Given, Options};
use poseshift::geometry::Pose;
use poseshift::model::Conditions;
use poseshift::model::profile::Profile;
use poseshift::program::{LANGUAGES, Language, Settings, Source};
use std::fmt::Write;

/// Every language the path can be written in, and the ending of its files.
pub const WRITTEN: &[(&str, &str)] = &[
    ("rapid", "mod"),
    ("krl", "src"),
    ("fanuc", "ls"),
    ("urscript", "script"),
    ("inform", "jbi"),
    ("val3", "dtx"),
    ("kawasaki", "as"),
    ("csv", "csv"),
];

/// What belongs to the program of that many points besides its first file: the code, where that
/// holds the data alone.
pub fn given(language: &str, count: u32) -> Option<(&'static str, String)> {
    let moves: String = (0..count)
        .map(|n| format!("  movel(pPath[{n}],artifact,mPath)\r\n"))
        .collect();
    (language == "val3").then(|| {
        let head = "<?xml version=\"1.0\" encoding=\"utf-8\"?>\r\n<Programs \
            xmlns=\"http://www.staubli.com/robotics/VAL3/Program/2\">\r\n  <Program name=\"start\" \
            access=\"public\">\r\n    <Code><![CDATA[\r\nbegin\r\n  \
            movej(jStart,artifact,mPath)\r\n";
        let tail = "end\r\n]]></Code>\r\n  </Program>\r\n</Programs>";
        ("start.pgx", format!("{head}{moves}{tail}"))
    })
}

/// A path that is read, and what it is compensated with.
pub struct Prepared {
    pub language: &'static dyn Language,
    pub sources: Vec<Source>,
    pub profile: Profile,
    pub settings: Settings,
    pub options: Options,
}

/// The path of that many points in a language, for its arm and the tool of that.
pub fn prepared((id, ending): (&str, &str), count: u32, every: u32) -> Prepared {
    let language = LANGUAGES.iter().find(|of| of.about().id == id);
    let text = program(id, count, every).into_bytes();
    let mut sources = vec![Source::new(format!("path.{ending}"), text)];
    let more = given(id, count);
    sources.extend(more.map(|(name, text)| Source::new(name, text.into_bytes())));
    let profile = Profile::from_yaml(&profile(id)).expect("a valid profile");
    let settings = Settings {
        pulses_per_deg: profile.pulses_per_deg,
        ..Settings::default()
    };
    let mut given = Given::default();
    let tool = profile.tool("artifact").expect("its tool");
    given.tools.insert(None, tool);
    Prepared {
        language: *language.expect("a language"),
        sources,
        profile,
        settings,
        options: Options {
            given,
            ..Options::default()
        },
    }
}

/// The text of the arm's profile, for a controller of another language.
pub fn profile(language: &str) -> String {
    let text = include_str!("../../robots/abb_irb120_thesis.yaml");
    let own = "controller: {language: rapid, model: nominal}";
    assert!(text.contains(own));
    text.replace(
        own,
        &format!(
            "controller: {{language: {language}, model: nominal, pulses_per_deg: [1000, 1000, \
            1000, 1000, 1000, 1000]}}"
        ),
    )
}

/// Joints along a smooth path through the work space, wrist and elbow clear of their singularities,
/// no joint across zero but the first, the fourth and the sixth.
fn joints(n: u32) -> [f64; 6] {
    let t = f64::from(n) * 1e-3;
    [
        0.6 * t.sin(),
        0.2 + 0.2 * (0.7 * t).sin(),
        0.2 * (1.1 * t).cos(),
        0.3 * (0.9 * t).sin(),
        1.0 + 0.2 * t.cos(),
        0.5 * t.sin(),
    ]
}

/// Position in mm, quaternion with its scalar first, angles of `Rz · Ry · Rx`, `Rx · Ry · Rz` and
/// `Rz · Ry · Rz` in degrees, rotation vector in radians.
struct Numbers {
    position: [f64; 3],
    quaternion: [f64; 4],
    zyx: [f64; 3],
    xyz: [f64; 3],
    zyz: [f64; 3],
    vector: [f64; 3],
}

fn numbers(pose: &Pose) -> Numbers {
    let m = pose.rotation.0;
    let quaternion = pose.rotation.quaternion().0;
    let [w, x, y, z] = quaternion;
    let sine = (x * x + y * y + z * z).sqrt();
    let by = if sine > 0.0 {
        2.0 * sine.atan2(w) / sine
    } else {
        2.0
    };
    Numbers {
        position: pose.translation.map(|metres| metres * 1e3),
        quaternion,
        zyx: [
            m[1][0].atan2(m[0][0]),
            (-m[2][0]).atan2(m[0][0].hypot(m[1][0])),
            m[2][1].atan2(m[2][2]),
        ]
        .map(f64::to_degrees),
        xyz: [
            (-m[1][2]).atan2(m[2][2]),
            m[0][2].atan2(m[0][0].hypot(m[0][1])),
            (-m[0][1]).atan2(m[0][0]),
        ]
        .map(f64::to_degrees),
        zyz: [
            m[1][2].atan2(m[0][2]),
            m[0][2].hypot(m[1][2]).atan2(m[2][2]),
            m[2][1].atan2(-m[2][0]),
        ]
        .map(f64::to_degrees),
        vector: [x * by, y * by, z * by],
    }
}

/// A program with every `every`-th point of the path, `count` of them, straight moves behind one
/// joint move.
pub fn program(language: &str, count: u32, every: u32) -> String {
    let profile = Profile::from_yaml(&profile(language)).expect("a valid profile");
    let tool = profile.tool("artifact").expect("its tool");
    let controller = profile.controller_model(&tool);
    let start = joints(0).map(f64::to_degrees);
    let mut text = String::new();
    let mut moves = String::new();
    let [q1, q2, q3, q4, q5, q6] = start;
    let head = match language {
        "rapid" => format!(
            "MODULE Path\r\n  PROC main()\r\n    MoveAbsJ \
         [[{q1:.4},{q2:.4},{q3:.4},{q4:.4},{q5:.4},{q6:.4}],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,artifact;\r\n"
        ),
        "krl" => format!(
            "&ACCESS RVP\r\nDEF path ( )\r\nBAS (#TOOL,1)\r\n$BASE={{X 0,Y 0,Z 0,A \
         0,B 0,C 0}}\r\nPTP {{A1 {q1:.4},A2 {q2:.4},A3 {q3:.4},A4 {q4:.4},A5 {q5:.4},A6 \
         {q6:.4}}}\r\n"
        ),
        "fanuc" => "/PROG  PATH\r\n/MN\r\n   1:  UFRAME_NUM=0 ;\r\n   2:  UTOOL_NUM=1 ;\r\n   3:J \
         P[1] 20% FINE ;\r\n"
            .into(),
        "urscript" => {
            let [q1, q2, q3, q4, q5, q6] = joints(0);
            format!(
                "def path():\n  movej([{q1:.6},{q2:.6},{q3:.6},{q4:.6},{q5:.6},{q6:.6}], \
                a=1.2, v=0.25)\n"
            )
        }
        "inform" => {
            let [q1, q2, q3, q4, q5, q6] = start.map(|q| (q * 1000.0).round());
            format!(
                "/JOB\r\n//NAME PATH\r\n//POS\r\n///NPOS {},0,0,0,0,0\r\n///TOOL \
                1\r\n///POSTYPE PULSE\r\n///PULSE\r\nC00000={q1},{q2},{q3},{q4},{q5},{q6}\r\n///POSTYPE BASE\r\n///RECTAN\r\n///RCONF 0,0,0,0,0,0,0,0\r\n",
                count + 1
            )
        }
        "val3" => format!(
            "<?xml version=\"1.0\" encoding=\"utf-8\"?>\r\n<Database \
         xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\" \
         xmlns=\"http://www.staubli.com/robotics/VAL3/Data/2\">\r\n  <Datas>\r\n    <Data \
         name=\"jStart\" access=\"private\" xsi:type=\"array\" type=\"jointRx\" \
         size=\"1\">\r\n      <Value key=\"0\" j1=\"{q1:.4}\" j2=\"{q2:.4}\" j3=\"{q3:.4}\" \
         j4=\"{q4:.4}\" j5=\"{q5:.4}\" j6=\"{q6:.4}\" />\r\n    </Data>\r\n    <Data \
         name=\"pPath\" access=\"private\" xsi:type=\"array\" type=\"pointRx\" \
         size=\"{count}\">\r\n"
        ),
        "kawasaki" => format!(
            ".PROGRAM path()\n  BASE NULL\n  JMOVE \
         #[{q1:.4},{q2:.4},{q3:.4},{q4:.4},{q5:.4},{q6:.4}]\n"
        ),
        "csv" => "id,x_mm,y_mm,z_mm,qw,qx,qy,qz\n".into(),
        _ => panic!("the path is not written in {language}"),
    };
    text += &head;
    if language == "fanuc" {
        let _ = write!(
            moves,
            "P[1]{{\r\n   GP1:\r\n    UF : 0, UT : 1,\r\n\tJ1= {q1:10.3} deg,\tJ2= {q2:10.3} \
             deg,\tJ3= {q3:10.3} deg,\r\n\tJ4= {q4:10.3} deg,\tJ5= {q5:10.3} deg,\tJ6= {q6:10.3} \
             deg\r\n}};\r\n"
        );
    }
    if language == "inform" {
        moves += "MOVJ C00000 VJ=10.00\r\n";
    }
    for n in 0..count {
        let q = joints(n * every);
        let numbers = numbers(&controller.forward(&q, &Conditions::default()));
        let ([x, y, z], [w, i, j, k], [rz, ry, rx]) =
            (numbers.position, numbers.quaternion, numbers.zyx);
        let _ = match language {
            "rapid" => {
                let quadrant = |angle: f64| if angle < 0.0 { -1 } else { 0 };
                let (cf1, cf4, cf6) = (quadrant(q[0]), quadrant(q[3]), quadrant(q[5]));
                write!(
                    text,
                    "    MoveL [[{x:.3},{y:.3},{z:.3}],[{w:.8},{i:.8},{j:.8},{k:.8}],[{cf1},{cf4},{cf6},0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,z1,artifact;\r\n"
                )
            }
            "krl" => write!(
                text,
                "LIN {{X {x:.3},Y {y:.3},Z {z:.3},A {rz:.4},B {ry:.4},C {rx:.4}}} C_DIS\r\n"
            ),
            "fanuc" => {
                let _ = write!(
                    moves,
                    "P[{}]{{\r\n   GP1:\r\n    UF : 0, UT : 1,        CONFIG : 'F U T, 0, 0, \
                     0',\r\n\tX ={x:10.3}  mm,\tY ={y:10.3}  mm,\tZ ={z:10.3}  mm,\r\n\tW \
                     ={rx:10.3} deg,\tP ={ry:10.3} deg,\tR ={rz:10.3} deg\r\n}};\r\n",
                    n + 2
                );
                write!(text, "{:4}:L P[{}] 250mm/sec CNT50 ;\r\n", n + 4, n + 2)
            }
            "urscript" => {
                let ([x, y, z], [rx, ry, rz]) = ([x, y, z].map(|mm| mm * 1e-3), numbers.vector);
                writeln!(
                    text,
                    "  movel(p[{x:.6},{y:.6},{z:.6},{rx:.6},{ry:.6},{rz:.6}], a=1.2, v=0.1, \
                     r=0.001)"
                )
            }
            "inform" => {
                let _ = write!(moves, "MOVL C{:05} V=100.0\r\n", n + 1);
                write!(
                    text,
                    "C{:05}={x:.3},{y:.3},{z:.3},{rx:.4},{ry:.4},{rz:.4}\r\n",
                    n + 1
                )
            }
            "val3" => {
                let [rx, ry, rz] = numbers.xyz;
                write!(
                    text,
                    "      <Value key=\"{n}\" x=\"{x:.3}\" y=\"{y:.3}\" z=\"{z:.3}\" \
                     rx=\"{rx:.4}\" ry=\"{ry:.4}\" rz=\"{rz:.4}\" fatherId=\"world[0]\" />\r\n"
                )
            }
            "kawasaki" => {
                let [o, a, t] = numbers.zyz;
                writeln!(
                    text,
                    "  LMOVE TRANS({x:.3},{y:.3},{z:.3},{o:.4},{a:.4},{t:.4})"
                )
            }
            _ => writeln!(text, "{n},{x:.3},{y:.3},{z:.3},{w:.8},{i:.8},{j:.8},{k:.8}"),
        };
    }
    text += match language {
        "rapid" => "  ENDPROC\r\nENDMODULE\r\n",
        "krl" => "END\r\n",
        "fanuc" => "/POS\r\n",
        "urscript" => "end\n",
        "inform" => {
            "//INST\r\n///DATE 2026/11/21 10:00\r\n///ATTR SC,RW\r\n///GROUP1 RB1\r\nNOP\r\n"
        }
        "val3" => "    </Data>\r\n  </Datas>\r\n</Database>",
        "kawasaki" => ".END\n",
        _ => "",
    };
    text += &moves;
    text += match language {
        "fanuc" => "/END\r\n",
        "inform" => "END\r\n",
        _ => "",
    };
    text
}

//! The same straight moves in every language, and how they are read again without the product.

use super::{At, Case};
use nalgebra::{Rotation3, UnitQuaternion, Vector3};
use poseshift::program::Source;
use std::fmt::Write;

/// Where a straight move begins, where that is a target, too, and where it ends.
type Ends = (Option<At>, At);

/// One way to write joint moves with a straight move behind each, and to read the straight moves
/// again.
pub(super) struct Form {
    /// The files of a program.
    pub files: fn(&[Case]) -> Vec<Source>,
    /// The straight moves of these files.
    pub read: fn(&[Source]) -> Vec<Ends>,
}

fn one(name: &str, text: String) -> Vec<Source> {
    vec![Source::new(name, text.into_bytes())]
}

fn text(source: &Source) -> &str {
    std::str::from_utf8(&source.bytes).expect("text")
}

/// The targets in those lines of a file that hold a word.
fn in_lines(files: &[Source], word: &str, read: impl Fn(&str) -> At) -> Vec<Ends> {
    let lines = text(&files[0]).lines().filter(|line| line.contains(word));
    lines.map(|line| (None, read(line))).collect()
}

/// What stands behind a word.
fn behind<'a>(text: &'a str, word: &str) -> &'a str {
    text.split_once(word).expect("the word").1
}

/// Numbers in a text, in their order.
fn numbers(text: &str) -> Vec<f64> {
    let is_part = |c: char| c.is_ascii_digit() || matches!(c, '.' | '-' | '+' | 'e' | 'E');
    text.split(|c| !is_part(c))
        .filter_map(|word| word.parse().ok())
        .collect()
}

/// Angles about z, y, x in degrees.
fn zyx(rotation: &UnitQuaternion<f64>) -> [f64; 3] {
    let (x, y, z) = rotation.euler_angles();
    [z, y, x].map(f64::to_degrees)
}

fn from_zyx([z, y, x]: [f64; 3]) -> UnitQuaternion<f64> {
    let [z, y, x] = [z, y, x].map(f64::to_radians);
    UnitQuaternion::from_rotation_matrix(&Rotation3::from_euler_angles(x, y, z))
}

fn mm(at: &At) -> [f64; 3] {
    [
        at.position.x * 1e3,
        at.position.y * 1e3,
        at.position.z * 1e3,
    ]
}

fn metres(n: &[f64]) -> Vector3<f64> {
    Vector3::new(n[0], n[1], n[2]) * 1e-3
}

fn quaternion(n: &[f64]) -> UnitQuaternion<f64> {
    UnitQuaternion::from_quaternion(nalgebra::Quaternion::new(n[0], n[1], n[2], n[3]))
}

/// x, y, z and angles about x, y, z.
fn xyz_angles(n: &[f64]) -> At {
    At {
        position: metres(n),
        rotation: from_zyx([n[5], n[4], n[3]]),
    }
}

pub(super) const FORMS: [Form; 6] = [
    Form {
        files: |cases| {
            let mut text = "MODULE t\nPROC main()\nConfL\\Off;\n".to_owned();
            for Case { start, to, .. } in cases {
                let [a, b, c, d, e, f] = start.map(f64::to_degrees);
                let [x, y, z] = mm(to);
                let r = to.rotation.quaternion();
                let _ = write!(
                    text,
                    "MoveAbsJ [[{a:.9},{b:.9},{c:.9},{d:.9},{e:.9},{f:.9}],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;\n\
                     MoveL [[{x:.6},{y:.6},{z:.6}],[{:.10},{:.10},{:.10},{:.10}],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;\n",
                    r.w, r.i, r.j, r.k
                );
            }
            one("t.mod", text + "ENDPROC\nENDMODULE\n")
        },
        read: |files| {
            in_lines(files, "MoveL", |line| {
                let n = numbers(behind(line, "[["));
                At {
                    position: metres(&n),
                    rotation: quaternion(&n[3..]),
                }
            })
        },
    },
    Form {
        files: |cases| {
            let mut text = "DEF t()\n$TOOL=$NULLFRAME\n$BASE=$WORLD\n".to_owned();
            for Case { start, to, .. } in cases {
                let [a, b, c, d, e, f] = start.map(f64::to_degrees);
                let [x, y, z] = mm(to);
                let [rz, ry, rx] = zyx(&to.rotation);
                let _ = write!(
                    text,
                    "PTP {{A1 {a:.9},A2 {b:.9},A3 {c:.9},A4 {d:.9},A5 {e:.9},A6 {f:.9}}}\n\
                     LIN {{X {x:.6},Y {y:.6},Z {z:.6},A {rz:.8},B {ry:.8},C {rx:.8}}}\n"
                );
            }
            one("t.src", text + "END\n")
        },
        read: |files| {
            in_lines(files, "LIN ", |line| {
                let value = |key: &str| numbers(behind(line, key))[0];
                xyz_angles(&["X ", "Y ", "Z ", "C ", "B ", "A "].map(value))
            })
        },
    },
    Form {
        files: |cases| {
            let mut text =
                "/PROG  T\n/ATTR\nOWNER = MNEDITOR;\n/MN\n   1:  UFRAME_NUM=0 ;\n   2:  \
                UTOOL_NUM=0 ;\n"
                    .to_owned();
            let mut points = String::new();
            for (at, Case { start, to, .. }) in cases.iter().enumerate() {
                let (first, line) = (2 * at + 1, 2 * at + 3);
                let [a, b, c, d, e, f] = start.map(f64::to_degrees);
                let [x, y, z] = mm(to);
                let [r, p, w] = zyx(&to.rotation);
                let _ = write!(
                    text,
                    "{line:4}:J P[{first}] 100% FINE    ;\n{:4}:L P[{}] 100mm/sec FINE    ;\n",
                    line + 1,
                    first + 1
                );
                let _ = write!(
                    points,
                    "P[{first}]{{\n   GP1:\n\tUF : 0, UT : 0,\t\n\tJ1= {a:.9} deg,\tJ2= {b:.9} \
                     deg,\tJ3= {c:.9} deg,\n\tJ4= {d:.9} deg,\tJ5= {e:.9} deg,\tJ6= {f:.9} \
                     deg\n}};\n\
                     P[{}]{{\n   GP1:\n\tUF : 0, UT : 0,\t\tCONFIG : '',\n\tX = {x:.6}  mm,\tY = \
                         {y:.6}  mm,\tZ = {z:.6}  mm,\n\tW = {w:.8} deg,\tP = {p:.8} deg,\tR = \
                         {r:.8} deg\n}};\n",
                    first + 1
                );
            }
            one("t.ls", text + "/POS\n" + &points + "/END\n")
        },
        read: |files| {
            let points = text(&files[0]).split("X =").skip(1);
            points
                .map(|point| (None, xyz_angles(&numbers(point))))
                .collect()
        },
    },
    Form {
        files: |cases| {
            let mut text = "def t():\n  set_tcp(p[0,0,0,0,0,0])\n".to_owned();
            for Case { start, to, .. } in cases {
                let [a, b, c, d, e, f] = *start;
                let [x, y, z] = [to.position.x, to.position.y, to.position.z];
                let v = to.rotation.scaled_axis();
                let _ = write!(
                    text,
                    "  movej([{a:.11},{b:.11},{c:.11},{d:.11},{e:.11},{f:.11}])\n  \
                     movel(p[{x:.9},{y:.9},{z:.9},{:.10},{:.10},{:.10}])\n",
                    v.x, v.y, v.z
                );
            }
            one("t.script", text + "end\nt()\n")
        },
        read: |files| {
            in_lines(files, "movel(p[", |line| {
                let n = numbers(behind(line, "p["));
                At {
                    position: Vector3::new(n[0], n[1], n[2]),
                    rotation: UnitQuaternion::from_scaled_axis(Vector3::new(n[3], n[4], n[5])),
                }
            })
        },
    },
    Form {
        files: |cases| {
            let count = cases.len();
            let mut text = format!(
                "/JOB\n//NAME T\n//POS\n///NPOS {},0,0,0,0,0\n///TOOL 0\n///POSTYPE \
                 ANGLE\n///ANGLE\n",
                2 * count
            );
            let (mut poses, mut moves) = (String::new(), String::new());
            for (at, Case { start, to, .. }) in cases.iter().enumerate() {
                let [a, b, c, d, e, f] = start.map(f64::to_degrees);
                let [x, y, z] = mm(to);
                let [rz, ry, rx] = zyx(&to.rotation);
                let end = count + at;
                let _ = writeln!(text, "C{at:05}={a:.9},{b:.9},{c:.9},{d:.9},{e:.9},{f:.9}");
                let _ = writeln!(
                    poses,
                    "C{end:05}={x:.6},{y:.6},{z:.6},{rx:.8},{ry:.8},{rz:.8}"
                );
                let _ = write!(moves, "MOVJ C{at:05} VJ=20.00\nMOVL C{end:05} V=100.0\n");
            }
            text += "///POSTYPE BASE\n///RECTAN\n///RCONF 0,0,0,0,0,0,0,0\n";
            text += &poses;
            text += "//INST\n///DATE 2024/03/02 09:15\n///ATTR SC,RW\n///GROUP1 RB1\nNOP\n";
            one("t.jbi", text + &moves + "END\n")
        },
        read: |files| {
            let rectangular = behind(text(&files[0]), "///RECTAN");
            let lines = rectangular.lines().filter(|line| line.starts_with('C'));
            let of = |line: &str| (None, xyz_angles(&numbers(behind(line, "="))));
            lines.map(of).collect()
        },
    },
    // a table has no joint moves between poses: each pair is a table of its own, which begins with
    // a pose
    Form {
        files: |cases| {
            let row = |at: &At, branch: u8| {
                let [x, y, z] = mm(at);
                let r = at.rotation.quaternion();
                format!(
                    "{x:.6},{y:.6},{z:.6},{:.10},{:.10},{:.10},{:.10},{branch}\n",
                    r.w, r.i, r.j, r.k
                )
            };
            let tables = cases.iter().enumerate().map(|(at, case)| {
                let branch = case.branch();
                let rows = row(&case.from, branch) + &row(&case.to, branch);
                let text = format!("x_mm,y_mm,z_mm,qw,qx,qy,qz,branch\n{rows}");
                Source::new(format!("t{at}.csv"), text.into_bytes())
            });
            tables.collect()
        },
        read: |files| {
            let of = |file: &Source| {
                let rows = text(file)
                    .lines()
                    .filter(|line| !line.starts_with(['#', 'x']));
                let rows: Vec<At> = rows
                    .map(|row| {
                        let n = numbers(row);
                        At {
                            position: metres(&n),
                            rotation: quaternion(&n[3..]),
                        }
                    })
                    .collect();
                (Some(rows[0]), rows[1])
            };
            files.iter().map(of).collect()
        },
    },
];

//! The targets of a cell as programs of four languages, and the numbers of what was written.

use super::landing::Cell;
use super::rapid;
use crate::physics::matrix::{M4, times, turn_x, turn_y, turn_z};

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Said {
    Rapid,
    Krl,
    Fanuc,
    Inform,
}

/// One target: joints to come from, the numbers of the pose, the values of the axes in mm and
/// degrees.
pub(super) struct Line {
    pub q_deg: [f64; 6],
    pub numbers: Vec<f64>,
    pub e: Vec<f64>,
}

/// Rz(a) · Ry(b) · Rx(c), or a quaternion.
pub(super) fn numbers_of(said: Said, pose: &M4) -> Vec<f64> {
    let mm = |i: usize| pose[i][3] * 1e3;
    let deg = |rad: f64| rad.to_degrees();
    let b = (-pose[2][0]).atan2(pose[0][0].hypot(pose[1][0]));
    let a = pose[1][0].atan2(pose[0][0]);
    let c = pose[2][1].atan2(pose[2][2]);
    match said {
        Said::Krl => vec![mm(0), mm(1), mm(2), deg(a), deg(b), deg(c)],
        Said::Fanuc | Said::Inform => vec![mm(0), mm(1), mm(2), deg(c), deg(b), deg(a)],
        Said::Rapid => {
            let [(sa, ca), (sb, cb), (sc, cc)] = [a, b, c].map(|x| (x / 2.0).sin_cos());
            vec![
                mm(0),
                mm(1),
                mm(2),
                ca * cb * cc + sa * sb * sc,
                ca * cb * sc - sa * sb * cc,
                ca * sb * cc + sa * cb * sc,
                sa * cb * cc - ca * sb * sc,
            ]
        }
    }
}

pub(super) fn pose_of(said: Said, n: &[f64]) -> M4 {
    let turned = match said {
        Said::Krl => [n[3], n[4], n[5]].map(f64::to_radians),
        Said::Fanuc | Said::Inform => [n[5], n[4], n[3]].map(f64::to_radians),
        Said::Rapid => {
            let length = n[3..7].iter().map(|x| x * x).sum::<f64>().sqrt();
            let [w, x, y, z] = std::array::from_fn(|i| n[3 + i] / length);
            return [
                [
                    1.0 - 2.0 * (y * y + z * z),
                    2.0 * (x * y - w * z),
                    2.0 * (x * z + w * y),
                    n[0] * 1e-3,
                ],
                [
                    2.0 * (x * y + w * z),
                    1.0 - 2.0 * (x * x + z * z),
                    2.0 * (y * z - w * x),
                    n[1] * 1e-3,
                ],
                [
                    2.0 * (x * z - w * y),
                    2.0 * (y * z + w * x),
                    1.0 - 2.0 * (x * x + y * y),
                    n[2] * 1e-3,
                ],
                [0.0, 0.0, 0.0, 1.0],
            ];
        }
    };
    let [a, b, c] = turned;
    let mut pose = times(&turn_z(a), &times(&turn_y(b), &turn_x(c)));
    for i in 0..3 {
        pose[i][3] = n[i] * 1e-3;
    }
    pose
}

/// The numbers as a program has them: what is rounded is the wanted pose.
pub(super) fn round(said: Said, numbers: &mut [f64]) {
    for (i, x) in numbers.iter_mut().enumerate() {
        let digits = if said == Said::Rapid && i > 2 {
            1e9
        } else {
            1e5
        };
        *x = (*x * digits).round() / digits;
    }
}

fn list(numbers: &[f64]) -> String {
    let texts: Vec<String> = numbers.iter().map(|x| format!("{x:.9}")).collect();
    texts.join(",")
}

pub(super) fn program(said: Said, cell: &Cell, lines: &[Line]) -> (&'static str, String) {
    let tables = !cell.tables.is_empty();
    let mut body = String::new();
    match said {
        Said::Rapid => {
            for line in lines {
                let mut eax = ["9E9".to_owned(), "9E9".into(), "9E9".into()];
                for (name, e) in cell.names[0].iter().zip(&line.e) {
                    eax[usize::from(name.as_bytes()[4] - b'a')] = e.to_string();
                }
                let eax = format!("[{},9E9,9E9,9E9]", eax.join(","));
                let n = &line.numbers;
                let wobj = if tables { "\\WObj:=w" } else { "" };
                body += &format!(
                    "MoveAbsJ [[{}],{eax}],v100,fine,t;\nMoveJ \
                     [[{}],[{}],[0,0,0,0],{eax}],v100,fine,t{wobj};\n",
                    list(&line.q_deg),
                    list(&n[..3]),
                    list(&n[3..])
                );
            }
            // the user frame of a frame on a unit is not used
            let data = "PERS wobjdata w:=[FALSE,FALSE,\"STN1\",[[1701.5,-720.4,649.1],[1,0,0,0]],[[15,-25,35],[1,0,0,0]]];";
            ("t.mod", rapid(if tables { data } else { "" }, &body))
        }
        Said::Krl => {
            for line in lines {
                let e: String = cell.names[1]
                    .iter()
                    .zip(&line.e)
                    .map(|(name, e)| format!(",{name} {e}"))
                    .collect();
                let axes: Vec<String> = (1..)
                    .zip(line.q_deg)
                    .map(|(i, q)| format!("A{i} {q:.9}"))
                    .collect();
                let n = &line.numbers;
                body += &format!(
                    "PTP {{{}{e}}}\nPTP {{X {:.5},Y {:.5},Z {:.5},A {:.5},B {:.5},C {:.5}{e}}}\n",
                    axes.join(","),
                    n[0],
                    n[1],
                    n[2],
                    n[3],
                    n[4],
                    n[5]
                );
            }
            let base = if tables {
                "$BASE=EK(MACHINE_DEF[2].ROOT,MACHINE_DEF[2].MECH_TYPE,{X 15,Y -25,Z 35,A 0,B 0,C \
                 0})"
            } else {
                "$BASE=$WORLD"
            };
            (
                "t.src",
                format!("DEF t()\n$TOOL=TOOL_DATA[1]\n{base}\n{body}END\n"),
            )
        }
        Said::Fanuc => {
            let (mut moves, mut points) = (String::new(), String::new());
            for (k, line) in lines.iter().enumerate() {
                let (first, second) = (2 * k + 1, 2 * k + 2);
                moves += &format!(
                    "   {first}:J P[{first}] 10% FINE    ;\n   {second}:J P[{second}] 10% FINE    \
                     ;\n"
                );
                let (mut rail, mut group) = (String::new(), String::new());
                for (name, e) in cell.names[2].iter().zip(&line.e) {
                    match name.strip_prefix("G2") {
                        None => rail += &format!(",\n\t{name}= {e:.5}  mm"),
                        Some(axis) => group += &format!(",\n\t{axis}= {e:.5} deg"),
                    }
                }
                let group = match group.strip_prefix(",\n\t") {
                    None => String::new(),
                    Some(axes) => format!("\n   GP2:\n\tUF : 1, UT : 1,\t\n\t{axes}"),
                };
                let q: Vec<String> = (1..)
                    .zip(line.q_deg)
                    .map(|(i, q)| format!("J{i}= {q:.9} deg"))
                    .collect();
                let n = &line.numbers;
                points += &format!(
                    "P[{first}]{{\n   GP1:\n\tUF : 1, UT : 1,\t\n\t{}{rail}{group}\n}};\n",
                    q.join(",\t")
                );
                points += &format!(
                    "P[{second}]{{\n   GP1:\n\tUF : 1, UT : 1,\t\t\n\tX = {:.5}  mm,\tY = {:.5}  \
                     mm,\tZ = {:.5}  mm,\n\tW = {:.5} deg,\tP = {:.5} deg,\tR = {:.5} \
                     deg{rail}{group}\n}};\n",
                    n[0], n[1], n[2], n[3], n[4], n[5]
                );
            }
            (
                "t.ls",
                format!("/PROG  TEST\n/ATTR\nLINE_COUNT = 1;\n/MN\n{moves}/POS\n{points}/END\n"),
            )
        }
        Said::Inform => {
            let (mut moves, mut points) = (String::new(), String::new());
            let stations = if tables { "EC" } else { "BC" };
            for (k, line) in lines.iter().enumerate() {
                let (first, second) = (2 * k, 2 * k + 1);
                points += &format!(
                    "///TOOL 1\n///POSTYPE ANGLE\n///ANGLE\nC{first:05}={}\n{stations}{first:05}={}\n",
                    list(&line.q_deg),
                    list(&line.e)
                );
                points += &format!(
                    "///TOOL 1\n///POSTYPE BASE\n///RECTAN\n///RCONF \
                     0,0,0,0,0,0,0,0\nC{second:05}={}\n{stations}{second:05}={}\n",
                    line.numbers
                        .iter()
                        .map(|x| format!("{x:.5}"))
                        .collect::<Vec<_>>()
                        .join(","),
                    list(&line.e)
                );
                moves += &format!(
                    "MOVJ C{first:05} {stations}{first:05} VJ=5.00\nMOVL C{second:05} \
                     {stations}{second:05} V=30.0\n"
                );
            }
            (
                "t.JBI",
                format!(
                    "/JOB\n//NAME T\n//POS\n{points}//INST\n///DATE 2024/01/01 10:00\n///ATTR \
                     SC,RW\n///GROUP1 RB1\nNOP\n{moves}END\n"
                ),
            )
        }
    }
}

/// The numbers behind these marks of a text, as many as there are of each.
fn behind(text: &str, mark: &str, count: usize) -> Vec<Vec<f64>> {
    let parts = text.split(mark).skip(1);
    let numbers = parts.map(|part| {
        let fields = part.split(|c: char| !(c.is_ascii_digit() || "+-.eE".contains(c)));
        let found = fields.filter_map(|field| field.parse::<f64>().ok());
        found.take(count).collect()
    });
    numbers.collect()
}

pub(super) fn written_numbers(said: Said, text: &str) -> Vec<Vec<f64>> {
    match said {
        Said::Rapid => behind(text, "MoveJ [[", 7),
        Said::Krl => behind(text, "PTP {X", 6),
        Said::Fanuc => behind(text, "\tX =", 6),
        Said::Inform => {
            let rows = text.split("///RCONF 0,0,0,0,0,0,0,0").skip(1);
            rows.map(|row| behind(row, "=", 6)[0].clone()).collect()
        }
    }
}

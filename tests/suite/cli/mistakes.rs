//! What people get wrong first: each ends with the file, the line where there is one, what was
//! meant, and the way out.
//!
//! The cases are in `tests/data/mistakes.txt`: what is changed in files that are right, the
//! command, and what must be said.

use crate::support::{poseshift, repository, scratch, text};
use std::fmt::Write;
use std::path::Path;

const HEADER: &str = "id,q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg,x_mm,y_mm,z_mm";
const ROWS: usize = 60;

/// Files that are right: a profile, measurements in one file and in two, a program, a cell.
fn world(folder: &Path) {
    let copy = |from: &str, to: &str| {
        std::fs::copy(repository(from), folder.join(to)).expect("scratch");
    };
    copy("robots/abb_irb120_thesis.yaml", "p.yaml");
    copy("robots/kuka_kr6_r900.yaml", "other.yaml");
    copy("programs/rapid/olp/in/Deburr.mod", "in.mod");
    let cell = "poseshift: cell/1\nclearance_mm: 5\nbodies:\n  - {name: post, cylinder_mm: \
        {radius: 40, height: 900}, \
                at: {x_mm: 5000, y_mm: 0, z_mm: 0, rx_deg: 0, ry_deg: 0, rz_deg: 0}}\n";
    std::fs::write(folder.join("cell.yaml"), cell).expect("scratch");
    let mut random: u64 = 7;
    let mut drawn = || {
        random = random
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (random >> 11) as f64 / (1u64 << 53) as f64
    };
    let wide = [150.0, 90.0, 80.0, 140.0, 100.0, 170.0];
    let mut joints = String::from("q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg\n");
    for _ in 0..ROWS {
        let q = wide.map(|wide| format!("{:.3}", (2.0 * drawn() - 1.0) * wide));
        writeln!(joints, "{}", q.join(",")).expect("text");
    }
    std::fs::write(folder.join("poses.csv"), joints).expect("scratch");
    let simulate = "simulate --profile p.yaml --joints poses.csv --noise-mm 0.02 -o made.csv";
    let made = poseshift()
        .current_dir(folder)
        .args(simulate.split(' '))
        .output();
    assert!(made.expect("the program starts").status.success());
    let made = std::fs::read_to_string(folder.join("made.csv")).expect("measurements");
    let (mut all, mut j, mut t) = (
        format!("{HEADER}\n"),
        String::new(),
        String::from("id,x_mm,y_mm,z_mm\n"),
    );
    writeln!(
        j,
        "{}",
        HEADER.split(',').take(7).collect::<Vec<_>>().join(",")
    )
    .expect("text");
    for line in made.lines().skip(1) {
        let cells: Vec<&str> = line.split(',').take(10).collect();
        writeln!(all, "{}", cells.join(",")).expect("text");
        writeln!(j, "{}", cells[..7].join(",")).expect("text");
        writeln!(t, "{},{}", cells[0], cells[7..].join(",")).expect("text");
    }
    for (name, content) in [("m.csv", all), ("J.csv", j), ("T.csv", t)] {
        std::fs::write(folder.join(name), content).expect("scratch");
    }
}

/// Changes a file: `edit FILE LINE old => new`, `scale FILE COLUMNS FACTOR`, `roll FILE COLUMNS`
/// (one row down), `drop FILE LINE`, `repeat FILE LINE`, `append FILE text` (to every line), `write
/// FILE text`.
fn change(folder: &Path, words: &str) {
    let mut parts = words.splitn(3, ' ');
    let (what, file) = (parts.next().expect("a verb"), parts.next().expect("a file"));
    let rest = parts
        .next()
        .unwrap_or_default()
        .replace("\\n", "\n")
        .replace("\\0", "\0");
    let path = folder.join(file);
    if what == "write" {
        std::fs::write(path, rest).expect("scratch");
        return;
    }
    let before = std::fs::read_to_string(&path).unwrap_or_else(|_| panic!("{words}"));
    let mut lines: Vec<String> = before.lines().map(str::to_owned).collect();
    let columns = |names: &str| -> Vec<usize> {
        let header: Vec<&str> = before
            .lines()
            .next()
            .expect("a header")
            .split(',')
            .collect();
        let at = |name: &str| {
            header
                .iter()
                .position(|own| *own == name)
                .unwrap_or_else(|| panic!("{words}"))
        };
        names.split(',').map(at).collect()
    };
    match what {
        "edit" => {
            let (line, rest) = rest.split_once(' ').expect("a line");
            let (old, new) = rest.split_once(" => ").expect("old => new");
            let every = line == "all";
            let mut done = 0;
            for (number, text) in lines.iter_mut().enumerate() {
                if (every || line == (number + 1).to_string()) && text.contains(old) {
                    *text = text.replace(old, new);
                    done += 1;
                }
            }
            assert!(done > 0, "{words}");
        }
        "scale" => {
            let (names, factor) = rest.split_once(' ').expect("a factor");
            let (at, factor): (_, f64) = (columns(names), factor.parse().expect("a number"));
            for text in &mut lines[1..] {
                let mut cells: Vec<String> = text.split(',').map(str::to_owned).collect();
                for column in &at {
                    cells[*column] =
                        (cells[*column].parse::<f64>().expect("a number") * factor).to_string();
                }
                *text = cells.join(",");
            }
        }
        "roll" => {
            let at = columns(&rest);
            let rows: Vec<Vec<String>> = lines[1..]
                .iter()
                .map(|l| l.split(',').map(str::to_owned).collect())
                .collect();
            for (number, text) in lines[1..].iter_mut().enumerate() {
                let mut cells = rows[number].clone();
                for column in &at {
                    cells[*column]
                        .clone_from(&rows[(number + rows.len() - 1) % rows.len()][*column]);
                }
                *text = cells.join(",");
            }
        }
        "append" => lines.iter_mut().for_each(|line| line.push_str(&rest)),
        "drop" => drop(lines.remove(rest.parse::<usize>().expect("a line") - 1)),
        "repeat" => {
            let at = rest.parse::<usize>().expect("a line") - 1;
            lines.insert(at, lines[at].clone());
        }
        other => panic!("{other}: {words}"),
    }
    std::fs::write(path, lines.join("\n") + "\n").expect("scratch");
}

#[test]
fn typical_mistakes_are_reported_with_the_place_what_was_meant_and_the_way_out() {
    let right = scratch();
    world(right.path());
    let cases = text("tests/data/mistakes.txt");
    let (mut count, mut wrong) = (0, String::new());
    for case in cases.split("\n## ").skip(1) {
        count += 1;
        let mut lines = case.lines();
        let name = lines.next().expect("a name");
        let folder = scratch();
        for entry in std::fs::read_dir(right.path()).expect("files") {
            let entry = entry.expect("a file");
            std::fs::copy(entry.path(), folder.path().join(entry.file_name())).expect("scratch");
        }
        let (mut said, mut command, mut wanted) = (String::new(), "", 0);
        for line in lines.filter(|line| !line.trim().is_empty()) {
            if let Some(words) = line.strip_prefix("$ ") {
                command = words;
                let output = poseshift()
                    .current_dir(folder.path())
                    .args(split(words))
                    .output();
                let output = output.expect("the program starts");
                let both = [output.stderr.as_slice(), &output.stdout].concat();
                let both = String::from_utf8_lossy(&both).into_owned();
                said = both.split_whitespace().collect::<Vec<_>>().join(" ");
                if output.status.success() {
                    said.insert_str(0, "status 0 ");
                }
            } else if let Some(fragment) = line.strip_prefix("+ ") {
                wanted += 1;
                if !said.contains(fragment) {
                    writeln!(wrong, "{name}: no `{fragment}`\n  {command}\n  {said}\n")
                        .expect("text");
                }
            } else {
                change(folder.path(), line);
            }
        }
        assert!(
            wanted >= 3,
            "{name}: the place, what was meant, the way out"
        );
    }
    assert!(wrong.is_empty(), "{wrong}");
    assert!(count >= 40, "{count} mistakes");
}

/// Words of a command; those in double quotes are one.
fn split(words: &str) -> Vec<String> {
    let parts = words.split('"').enumerate();
    parts
        .flat_map(|(i, part)| {
            if i % 2 == 1 {
                vec![part.to_owned()]
            } else {
                part.split_whitespace().map(str::to_owned).collect()
            }
        })
        .collect()
}

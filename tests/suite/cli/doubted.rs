//! Tables of joints, lengths and touches that cannot be meant so: refused or reported with file, line,
//! value and limit.

use crate::support::{repository, run_in, scratch, text};
use std::path::Path;

const THESIS: &str = "robots/abb_irb120_thesis.yaml";
const JOINTS: &str = "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg";

/// A folder with the thesis's robot and the tables of the documentation.
fn world() -> tempfile::TempDir {
    let folder = scratch();
    let copy = |from: &str, to: &str| {
        std::fs::copy(repository(from), folder.path().join(to)).expect("scratch");
    };
    copy(THESIS, "p.yaml");
    for name in [
        "lengths", "taught", "sweeps", "robot", "board", "features", "touches", "nominal", "probed",
    ] {
        copy(
            &format!("docs/measuring/{name}.csv"),
            &format!("{name}.csv"),
        );
    }
    folder
}

fn write(folder: &Path, name: &str, text: &str) {
    std::fs::write(folder.join(name), text).expect("scratch");
}

/// Asserts that a command ends with status 2 and says all of this, and prints nothing.
fn refused(folder: &Path, command: &str, said: &[&str]) {
    let (status, out, reported) = run_in(folder, command);
    assert_eq!(status, Some(2), "{command}: {reported}{out}");
    assert!(out.is_empty(), "{command}: {out}");
    for word in said {
        assert!(reported.contains(word), "{command}: {word}: {reported}");
    }
}

/// Asserts that a command ends with status 0 and says all of this on standard error.
fn reported(folder: &Path, command: &str, said: &[&str]) {
    let (status, out, reported) = run_in(folder, command);
    assert_eq!(status, Some(0), "{command}: {reported}{out}");
    for word in said {
        assert!(reported.contains(word), "{command}: {word}: {reported}");
    }
}

/// The columns of a table that are named, in the order of the table.
fn columns(table: &str, kept: &dyn Fn(&str) -> bool) -> String {
    let header: Vec<&str> = table.lines().next().expect("a header").split(',').collect();
    let line = |line: &str| {
        let cells = line.split(',').zip(&header);
        let cells = cells.filter(|(_, name)| kept(name)).map(|(cell, _)| cell);
        cells.collect::<Vec<_>>().join(",")
    };
    table.lines().map(|l| line(l) + "\n").collect()
}

/// A table with another number in one cell; rows from 1, as the lines below the header.
fn with_cell(table: &str, row: usize, column: &str, cell: &str) -> String {
    let header = table.lines().next().expect("a header");
    let at = header.split(',').position(|name| name == column);
    let at = at.expect("a column of the table");
    let line = |(number, line): (usize, &str)| {
        let mut cells: Vec<&str> = line.split(',').collect();
        if number == row {
            cells[at] = cell;
        }
        cells.join(",") + "\n"
    };
    table.lines().enumerate().map(line).collect()
}

#[test]
fn a_table_without_rows_is_no_result_without_rows() {
    let folder = world();
    let at = folder.path();
    write(at, "q.csv", &format!("{JOINTS}\n"));
    let pose = "x_mm,y_mm,z_mm,qw,qx,qy,qz";
    write(at, "x.csv", &format!("{pose},branch\n# none\n"));
    write(at, "f.csv", "id,x_mm,y_mm,z_mm\n");
    let lengths = text("docs/measuring/lengths.csv");
    write(
        at,
        "l.csv",
        &columns(&lengths, &|_| true)[..=lengths.find('\n').expect("a line")],
    );
    for command in [
        "fk --profile p.yaml --joints q.csv",
        "fk --profile p.yaml --joints q.csv --json",
        "simulate --profile p.yaml --joints q.csv",
        "ik --profile p.yaml --poses x.csv",
        "ik --profile p.yaml --poses x.csv --all",
        "hexapod l.csv",
        "hexapod --taught f.csv --base-mm 300,300,300",
        "register f.csv f.csv",
        "register nominal.csv f.csv",
        "register nominal.csv f.csv --icp",
        "handeye x.csv board.csv --setup eye-in-hand",
        "axes f.csv --profile p.yaml",
        "plan --profile p.yaml --count 20 --given q.csv",
    ] {
        refused(at, command, &["no rows", ".csv: "]);
    }
    // the header that was forgotten
    write(at, "n.csv", "10,20,30,0,30,0\n20,20,30,0,30,0\n");
    refused(
        at,
        "fk --profile p.yaml --joints n.csv",
        &[
            "columns are missing: q1_deg",
            "the first line holds numbers",
        ],
    );
}

#[test]
fn joints_beyond_the_limits_are_reported_with_line_and_limits() {
    let folder = world();
    let at = folder.path();
    // columns of another order: joint 3 of the IRB 120 goes to 70 degrees
    write(
        at,
        "q.csv",
        &format!("{JOINTS}\n10,20,30,0,30,0\n0,30,105,0,30,0\n0,30,120,0,30,0\n"),
    );
    let said = [
        "q.csv:3:1: warning[beyond-limit]",
        "joint 3 stands at 105.000 deg, its limits are -110.000 and 70.000 deg",
        "rows beyond limits: 2",
    ];
    reported(at, "fk --profile p.yaml --joints q.csv", &said);
    reported(at, "simulate --profile p.yaml --joints q.csv", &said);
    reported(
        at,
        "simulate --profile p.yaml --joints q.csv -o m.csv",
        &said,
    );
    let (_, out, _) = run_in(at, "fk --profile p.yaml --joints q.csv --json");
    let report: serde_json::Value = serde_json::from_str(&out).expect("a report");
    assert_eq!(report["findings"][0]["line"], 3);
    write(at, "q.csv", &format!("{JOINTS}\n10,20,30,0,30,0\n"));
    let (_, _, nothing) = run_in(at, "fk --profile p.yaml --joints q.csv");
    assert_eq!(nothing, "");
}

#[test]
fn columns_of_which_some_are_there_are_never_left_aside() {
    let folder = world();
    let at = folder.path();
    let features = text("docs/measuring/features.csv");
    write(
        at,
        "features.csv",
        &columns(&features, &|name| name != "nz"),
    );
    refused(
        at,
        "register features.csv touches.csv",
        &["features.csv: columns are missing: nz"],
    );
    let nominal = text("docs/measuring/nominal.csv");
    let twice = |line: &str| format!("{line},{}\n", line.rsplit(',').next().expect("a cell"));
    let sigma = nominal.lines().map(|line| line.to_owned() + ",0.05");
    let sigma: Vec<String> = sigma.collect();
    let mut sigma = sigma.join("\n").replacen(",0.05", ",sigma_mm", 1);
    sigma = sigma.lines().map(twice).collect();
    write(at, "nominal.csv", &sigma);
    refused(
        at,
        "register nominal.csv probed.csv",
        &["the column sigma_mm stands twice"],
    );
    let pose = "400,0,500,0.7071068,0,0.7071068,0";
    let near = "near1_deg,near2_deg,near3_deg,near4_deg,near5_deg";
    let header = "x_mm,y_mm,z_mm,qw,qx,qy,qz,branch";
    write(
        at,
        "x.csv",
        &format!("{header},{near}\n{pose},0,0,0,0,0,30\n"),
    );
    for all in ["", " --all"] {
        let command = format!("ik --profile p.yaml --poses x.csv{all}");
        refused(at, &command, &["x.csv: columns are missing: near6_deg"]);
    }
    let sweeps = text("docs/measuring/sweeps.csv");
    let rows = sweeps.lines().map(|line| format!("{line},0\n"));
    let rows: String = rows.collect();
    write(at, "sweeps.csv", &rows.replacen(",0\n", ",qx\n", 1));
    refused(
        at,
        "axes sweeps.csv --profile p.yaml",
        &["columns are missing: qw, qy, qz"],
    );
    let lengths = text("docs/measuring/lengths.csv");
    let more = |name: &str| {
        let rows = lengths.lines().map(|line| format!("{line},1\n"));
        rows.collect::<String>()
            .replacen(",1\n", &format!(",{name}\n"), 1)
    };
    for (name, said) in [
        ("mode", "the column mode stands twice"),
        ("q4_deg", "columns are missing: q1_deg"),
        ("qw", "columns are missing: x_mm"),
    ] {
        write(at, "l.csv", &more(name));
        refused(at, "hexapod l.csv", &["l.csv: ", said]);
    }
}

#[test]
fn a_misspelt_column_does_not_count_as_none() {
    let folder = world();
    let at = folder.path();
    let joints = |column: &str, cell: &str| {
        write(
            at,
            "j.csv",
            &format!("{JOINTS},{column}\n0,0,0,0,30,0,{cell}\n"),
        );
    };
    let pose = "400,0,500,0.7071068,0,0.7071068,0";
    let poses = |column: &str, cell: &str| {
        let header = "x_mm,y_mm,z_mm,qw,qx,qy,qz,branch";
        write(
            at,
            "x.csv",
            &format!("{header},{column}\n{pose},0,{cell}\n"),
        );
    };
    let refuses = |command: &str, column: &str, meant: &str| {
        let said = [
            format!("the column `{column}` is not read"),
            format!("is `{meant}` meant? rename the column, or leave it out"),
        ];
        refused(at, command, &said.each_ref().map(String::as_str));
    };
    for (column, meant) in [
        ("temperature", "temperature_c"),
        ("tempreature_c", "temperature_c"),
        ("Time_s", "time_s"),
    ] {
        joints(column, "30");
        refuses("fk --profile p.yaml --joints j.csv", column, meant);
        refuses("simulate --profile p.yaml --joints j.csv", column, meant);
        poses(column, "30");
        refuses("ik --profile p.yaml --poses x.csv", column, meant);
    }
    let probed = text("docs/measuring/probed.csv");
    let rows = probed.lines().map(|line| format!("{line},0.05\n"));
    let rows: String = rows.collect();
    write(at, "probed.csv", &rows.replacen(",0.05\n", ",sigma\n", 1));
    refuses("register nominal.csv probed.csv", "sigma", "sigma_mm");
    // the controller's arm knows nothing of these columns, and takes the same tables
    joints("tempreature_c", "30");
    let controller = "fk --profile p.yaml --joints j.csv --model controller";
    refuses(controller, "tempreature_c", "temperature_c");
    // other columns of a logger are left aside
    joints("operator", "7");
    let (status, ..) = run_in(at, "fk --profile p.yaml --joints j.csv");
    assert_eq!(status, Some(0));
}

#[test]
fn lengths_of_a_ballbar_are_doubted_where_balls_would_have_moved() {
    let folder = world();
    let at = folder.path();
    let lengths = text("docs/measuring/lengths.csv");
    let micrometres = |line: &str| {
        let cells = line
            .split(',')
            .enumerate()
            .map(|(at, cell)| match cell.parse::<f64>() {
                Ok(mm) if (1..13).contains(&at) => (mm * 1e3).to_string(),
                _ => cell.to_owned(),
            });
        cells.collect::<Vec<_>>().join(",") + "\n"
    };
    write(
        at,
        "l.csv",
        &lengths.lines().map(micrometres).collect::<String>(),
    );
    refused(
        at,
        "hexapod l.csv",
        &["l.csv:2:1", "in micrometres?", "limit 20000 mm"],
    );
    write(at, "l.csv", &with_cell(&lengths, 2, "b23_mm", "309.9800"));
    let said = [
        "l.csv:3:1: warning[balls-moved]",
        "b23 is 309.9800 mm, and 299.9800 mm in most rows (limit 0.1 mm)",
    ];
    reported(at, "hexapod l.csv", &said);
    let (_, _, nothing) = run_in(at, "hexapod lengths.csv");
    assert_eq!(nothing, "");

    let taught = text("docs/measuring/taught.csv");
    write(at, "t.csv", &with_cell(&taught, 1, "x_mm", "230.0663"));
    let command = "hexapod --taught t.csv --base-mm 300.01,299.98,300.02";
    let said = ["t.csv: warning[taught-off]", "limit 1 mm"];
    reported(at, command, &said);
    reported(at, &format!("{command} -o f.yaml --quiet"), &[]);
    let (_, out, _) = run_in(at, &format!("{command} --json"));
    let report: serde_json::Value = serde_json::from_str(&out).expect("a report");
    assert_eq!(report["findings"][0]["id"], "taught-off");
    let (_, _, nothing) = run_in(at, &command.replace("t.csv", "taught.csv"));
    assert_eq!(nothing, "");
}

#[test]
fn a_ball_of_a_few_micrometres_or_metres_is_none() {
    let folder = world();
    let at = folder.path();
    for radius in ["0.002", "-2", "2000", "NaN"] {
        let command = format!("register features.csv touches.csv --probe-radius-mm={radius}");
        refused(at, &command, &[radius, "from 0.05 to 100 mm"]);
    }
    let command = "register features.csv touches.csv --probe-radius-mm 2";
    reported(at, command, &[]);
}

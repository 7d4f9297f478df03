//! `fk`, `ik`, `profile`, `robots`, `effects`, `languages`, `completions`, `man`.

use crate::support::{poseshift, repository, scratch};

const PROFILE: &str = "robots/abb_irb120_thesis.yaml";

fn stdout(arguments: &[&str]) -> String {
    let output = poseshift()
        .current_dir(repository(""))
        .args(arguments)
        .output()
        .expect("the program starts");
    assert!(
        output.status.success(),
        "{arguments:?}: {}",
        String::from_utf8_lossy(&output.stderr)
    );
    String::from_utf8(output.stdout).expect("UTF-8")
}

/// Runs and returns the exit status and standard error; standard output must be empty.
fn refused(arguments: &[&str]) -> String {
    let output = poseshift()
        .current_dir(repository(""))
        .args(arguments)
        .output()
        .expect("the program starts");
    assert_eq!(output.status.code(), Some(2), "{arguments:?}");
    assert!(output.stdout.is_empty());
    String::from_utf8(output.stderr).expect("UTF-8")
}

#[test]
fn joints_go_to_poses_and_back() {
    let folder = scratch();
    let joints = folder.path().join("joints with space.csv");
    std::fs::write(
        &joints,
        "# a \
        comment\nid,note,q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg\nA,x,10,-20,30,40,50,-300\n",
    )
    .expect("scratch");
    let poses = stdout(&[
        "fk",
        "--profile",
        PROFILE,
        "--joints",
        joints.to_str().expect("UTF-8"),
    ]);
    assert!(poses.starts_with("id,x_mm,y_mm,z_mm,qw,qx,qy,qz\nA,"));
    let (header, row) = poses.trim_end().split_once('\n').expect("two lines");
    let file = folder.path().join("poses.csv");
    let near = "near1_deg,near2_deg,near3_deg,near4_deg,near5_deg,near6_deg";
    std::fs::write(
        &file,
        format!("{header},{near}\n{row},9,-19,29,39,49,-299\n"),
    )
    .expect("scratch");
    let solved = stdout(&[
        "ik",
        "--profile",
        PROFILE,
        "--poses",
        file.to_str().expect("UTF-8"),
    ]);
    let cells: Vec<&str> = solved.lines().nth(1).expect("a row").split(',').collect();
    for (cell, want) in cells[2..8]
        .iter()
        .zip([10.0, -20.0, 30.0, 40.0, 50.0, -300.0])
    {
        assert!(
            (cell.parse::<f64>().expect("a number") - want).abs() < 1e-6,
            "{solved}"
        );
    }
    assert!(solved.trim_end().ends_with("converged"));
}

#[test]
fn the_solution_near_joints_is_the_nearest_of_all_branches() {
    let folder = scratch();
    let file = |name: &str, text: String| {
        let path = folder.path().join(name);
        std::fs::write(&path, text).expect("scratch");
        path.to_str().expect("UTF-8").to_owned()
    };
    // on the other side of joint 5; a whole rotation that is beyond the limit of joint 4
    for (joints, near, branch) in [
        ("0,0,0,0,-40,0", "0,0,0,0,40,0", ["", ""]),
        ("0,0,0,0,2,0", "0,0,0,0,-1,0", ["", ""]),
        ("0,0,0,-155,40,0", "0,0,0,150,40,0", [",branch", ",0"]),
        // the nominal arm has joint 5 on the other side there
        (
            "-49,12,-50.5,-2,-0.002,5",
            "-49,12,-50.5,-2,-0.002,5",
            ["", ""],
        ),
    ] {
        let header = "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg";
        let joints_file = file("j.csv", format!("{header}\n{joints}\n"));
        let poses = stdout(&["fk", "--profile", PROFILE, "--joints", &joints_file]);
        let (pose_header, row) = poses.trim_end().split_once('\n').expect("two lines");
        let near_header = header.replace('q', "near");
        let poses = file(
            "p.csv",
            format!(
                "{pose_header},{near_header}{}\n{row},{near}{}\n",
                branch[0], branch[1]
            ),
        );
        let solved = stdout(&["ik", "--profile", PROFILE, "--poses", &poses]);
        let cells: Vec<&str> = solved.lines().nth(1).expect("a row").split(',').collect();
        let want: Vec<f64> = joints.split(',').map(|q| q.parse().expect("q")).collect();
        for (cell, want) in cells[2..8].iter().zip(want) {
            let q: f64 = cell.parse().expect("a number");
            assert!((q - want).abs() < 1e-5, "{solved}");
        }
        assert!(solved.trim_end().ends_with("converged"), "{solved}");
    }
}

#[test]
fn a_bad_cell_names_line_and_column() {
    let folder = scratch();
    let joints = folder.path().join("j.csv");
    for (row, column) in [
        ("1,2,3,4,5,x", "2:11"),
        ("1,2,,4,5,6", "2:5"),
        ("1,2,inf,4,5,6", "2:5"),
    ] {
        std::fs::write(
            &joints,
            format!("q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg\n{row}\n"),
        )
        .expect("scratch");
        let reported = refused(&[
            "fk",
            "--profile",
            PROFILE,
            "--joints",
            joints.to_str().expect("UTF-8"),
        ]);
        assert!(reported.contains(&format!("j.csv:{column}")), "{reported}");
    }
    std::fs::write(&joints, "q1_deg,q2_deg\n1,2\n").expect("scratch");
    let reported = refused(&[
        "fk",
        "--profile",
        PROFILE,
        "--joints",
        joints.to_str().expect("UTF-8"),
    ]);
    assert!(
        reported.contains("q3_deg, q4_deg, q5_deg, q6_deg"),
        "{reported}"
    );
}

#[test]
fn profile_faults_name_the_place_and_the_way_out() {
    let good = std::fs::read_to_string(repository(PROFILE)).expect("a profile");
    let folder = scratch();
    let file = folder.path().join("bad.yaml");
    let cases: &[(&str, &str, &str)] = &[
        ("d_mm: 290", "d_mm: .nan", "not a finite number"),
        ("d_mm: 290", "d_mm: .inf", "not a finite number"),
        ("d_mm: 290", "d_mm: 290 mm", "a number is expected"),
        ("d_mm: 290, ", "", "missing field"),
        ("d_mm: 290", "d_m: 0.290", "unknown field"),
        ("poseshift: profile/1", "poseshift: profile/2", "profile/1"),
        (
            "joint: 2, rad_per_n_m",
            "joint: 7, rad_per_n_m",
            "whole number from 1 to 6",
        ),
        ("joint: 3, rad_per_n_m", "joint: 2, rad_per_n_m", "twice"),
        ("effect: base_frame", "effect: base_shift", "`base_frame`"),
        (
            "effect: joint_compliance, joint: 2, rad_per_n_m",
            "effect: joint_compliance, joint: 2, rad_per_nm",
            "keys of",
        ),
        (
            "min_deg: -165, max_deg: 165",
            "min_deg: 165, max_deg: -165",
            "not below",
        ),
        ("mass_kg: 2.6", "mass_kg: -2.6", "mass_kg is -2.6"),
    ];
    for (from, to, reported) in cases {
        assert!(good.contains(from), "{from}");
        std::fs::write(&file, good.replacen(from, to, 1)).expect("scratch");
        let stderr = refused(&["profile", "show", file.to_str().expect("UTF-8")]);
        assert!(
            stderr.contains(reported) && stderr.contains("bad.yaml:"),
            "{to}: {stderr}"
        );
    }
    let five = good
        .lines()
        .filter(|line| !line.contains("d_mm: 72"))
        .collect::<Vec<_>>()
        .join("\n");
    std::fs::write(&file, five).expect("scratch");
    assert!(refused(&["profile", "show", file.to_str().expect("UTF-8")]).contains("5 joints"));
}

#[test]
fn a_new_profile_is_the_built_in_one_and_is_not_written_over() {
    let folder = scratch();
    let file = folder.path().join("new.yaml");
    let path = file.to_str().expect("UTF-8");
    stdout(&["profile", "new", "--robot", "abb_irb120", "-o", path]);
    assert!(refused(&["profile", "new", "--robot", "abb_irb120", "-o", path]).contains("exists"));
    assert_eq!(
        stdout(&["profile", "diff", path, "robots/abb_irb120.yaml"]),
        ""
    );
    assert!(refused(&["profile", "new", "--robot", "r2d2"]).contains("robots --search"));
    let output = poseshift()
        .current_dir(repository(""))
        .args(["profile", "diff", path, PROFILE])
        .output()
        .expect("starts");
    assert_eq!(output.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&output.stdout).contains("link_geometry link 4"));
}

#[test]
fn catalogues_list_everything_and_json_is_json() {
    for (command, word) in [
        ("robots", "abb_irb120_thesis"),
        ("effects", "joint_compliance"),
        ("languages", "ABB RAPID"),
    ] {
        assert!(stdout(&[command]).contains(word));
        let json: serde_json::Value =
            serde_json::from_str(&stdout(&[command, "--json"])).expect("JSON");
        assert_eq!(json["poseshift"], format!("{command}/1"));
    }
    let schema: serde_json::Value =
        serde_json::from_str(&stdout(&["profile", "schema"])).expect("JSON");
    assert!(schema.to_string().contains("joint_harmonic"));
    assert!(stdout(&["profile", "show", PROFILE]).contains("the real tool is"));
    assert!(stdout(&["completions", "bash"]).contains("compensate"));
    assert!(stdout(&["man"]).contains("poseshift"));
}

#[test]
fn rows_behind_windows_line_ends_and_directions_that_are_none_are_named() {
    let folder = scratch();
    let file = folder.path().join("q.csv");
    let path = file.to_str().expect("UTF-8");
    let joints = "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg";
    let refusal = |command: &str, text: &str| {
        std::fs::write(&file, text).expect("scratch");
        refused(&[command, "--profile", PROFILE, "--joints", path])
    };
    for end in ["\n", "\r\n"] {
        let rows = ["1,2,3,4,5,6", "", "# seen", "1,2,x,4,5,6"].join(end);
        let reported = refusal("fk", &format!("{joints}{end}{rows}{end}"));
        assert!(reported.contains("q.csv:5:"), "{reported}");
    }
    let reported = refusal("simulate", &format!("{joints},dir1\n1,2,3,4,5,6,1\n"));
    assert!(reported.contains("dir2"), "{reported}");
    let all = "dir1,dir2,dir3,dir4,dir5,dir6";
    let row = "1,2,3,4,5,6,1,1,7,1,0,-1";
    let reported = refusal("simulate", &format!("{joints},{all}\n{row}\n"));
    assert!(reported.contains("dir3: 7 is no direction"), "{reported}");
}

#[test]
fn some_of_the_columns_of_a_force_or_of_directions_are_refused() {
    let folder = scratch();
    let file = folder.path().join("q.csv");
    let path = file.to_str().expect("UTF-8");
    let joints = "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg";
    for command in ["fk", "simulate"] {
        for (column, missing) in [("fz_n", "fx_n, fy_n"), ("dir2", "dir1, dir3, dir4")] {
            let text = format!("{joints},{column}\n1,2,3,4,5,6,1\n");
            std::fs::write(&file, text).expect("scratch");
            let reported = refused(&[command, "--profile", PROFILE, "--joints", path]);
            let named = format!("columns are missing: {missing}");
            assert!(reported.contains(&named), "{command}: {reported}");
        }
    }
    // the controller's model knows neither: what it does not use it does not ask for
    std::fs::write(&file, format!("{joints},fz_n\n1,2,3,4,5,6,1\n")).expect("scratch");
    let model = ["--model", "controller"];
    stdout(&[&["fk", "--profile", PROFILE, "--joints", path][..], &model].concat());
}

#[test]
fn forces_of_zero_leave_the_directions_to_the_order_of_the_rows() {
    let folder = scratch();
    let file = folder.path().join("q.csv");
    let path = file.to_str().expect("UTF-8");
    let measured = |force: [&str; 2]| -> Vec<Vec<String>> {
        let [columns, zeros] = force;
        let joints = "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg";
        let rows = format!("1,2,3,4,5,6{zeros}\n2,1,4,3,6,6{zeros}\n");
        std::fs::write(&file, format!("{joints}{columns}\n{rows}")).expect("scratch");
        let text = stdout(&["simulate", "--profile", PROFILE, "--joints", path]);
        let cells = |line: &str| line.split(',').take(16).map(str::to_owned).collect();
        text.lines().map(cells).collect()
    };
    let (without, with) = (measured(["", ""]), measured([",fx_n,fy_n,fz_n", ",0,0,0"]));
    assert_eq!(
        without[0][10..],
        ["dir1", "dir2", "dir3", "dir4", "dir5", "dir6"]
    );
    assert_eq!(without[2][10..], ["1", "-1", "1", "-1", "1", "0"]);
    assert_eq!(without, with);
}

#[test]
fn a_plan_of_too_few_configurations_names_its_own_options() {
    let profile = repository("robots/abb_irb120.yaml");
    let profile = profile.to_str().expect("UTF-8");
    let reported = refused(&[
        "plan",
        "--profile",
        profile,
        "--count",
        "2",
        "--starts",
        "1",
    ]);
    assert!(
        reported.contains("--count") && !reported.contains("poseshift calibrate"),
        "{reported}"
    );
}

#[test]
fn tables_of_more_columns_than_any_has_are_refused_with_their_number() {
    let folder = scratch();
    let path = folder.path().join("wide.csv");
    let name = path.to_str().expect("a plain name");
    let commas = ",".repeat(2_000_000);
    let different: Vec<String> = (0..200_000).map(|n| format!("c{n}")).collect();
    for (text, columns) in [
        (format!("{commas}\n{commas}\n"), "2000001 columns"),
        (different.join(",") + "\n", "200000 columns"),
    ] {
        std::fs::write(&path, text).expect("scratch");
        for command in [
            &["validate", "--measurements", name][..],
            &["calibrate", "--measurements", name],
            &["diagnose", "--measurements", name],
            &["fk", "--joints", name],
        ] {
            let said = refused(&[command, &["--profile", PROFILE]].concat());
            assert!(
                said.contains(columns) && said.contains("at most 1000"),
                "{command:?}: {said}"
            );
        }
    }
}

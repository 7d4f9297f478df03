//! Plans of poses along a rail.

use super::*;

#[test]
fn a_plan_has_places_of_the_rail_and_tells_its_errors_apart() {
    let folder = scratch();
    let (arm, _) = arm();
    let arm: Vec<&str> = arm.iter().map(String::as_str).collect();
    let profile = put(folder.path(), "p.yaml", &with_tool(TRACK, &arm));
    let table = folder.path().join("plan.csv");
    let arguments = [
        "plan",
        "--json",
        "--count",
        "44",
        "--candidates",
        "600",
        "--level",
        "0",
        "--identify",
        "track",
        "--fix",
        "tool_frame",
        "--sigma-mm",
        "0.03",
        "--starts",
        "2",
    ];
    let files = [("--profile", profile.as_path()), ("-o", &table)];
    let found = json(&arguments, &files);
    let text = std::fs::read_to_string(&table).expect("written");
    let head: Vec<&str> = text.lines().next().expect("a header").split(',').collect();
    let column = head
        .iter()
        .position(|name| *name == "e1_mm")
        .expect("a column");
    let mut places: Vec<&str> = text
        .lines()
        .skip(1)
        .map(|line| line.split(',').nth(column).expect("a cell"))
        .collect();
    assert_eq!(places.len(), 44);
    places.sort_unstable();
    places.dedup();
    // the ends tell most, and powers need places between
    assert!(
        places.contains(&"0") && places.contains(&"3000"),
        "{places:?}"
    );
    assert!(places.len() >= 5, "{places:?}");
    let sigmas = found["expected_sigma"].as_array().expect("a list");
    let of_track = |id: &str| -> Vec<f64> {
        let own = sigmas
            .iter()
            .filter(|s| s["key"].as_str().is_some_and(|k| k.starts_with(id)));
        own.map(|s| s["sigma"].as_f64().expect("a number"))
            .collect()
    };
    assert_eq!(
        (
            of_track("track_").len(),
            found["not_determined"].as_array().map(Vec::len)
        ),
        (13, Some(0))
    );
    // four postures at eleven places give this
    assert!(
        of_track("track_rotation").iter().all(|deg| *deg < 0.005),
        "{found:#}"
    );
    assert!(
        of_track("track_straightness").iter().all(|mm| *mm < 0.03),
        "{found:#}"
    );
    for (more, says) in [
        (["--program", "drive.mod"], "external axes"),
        (["--stations", "1"], "at least 2 places"),
    ] {
        let none = folder.path().join("none.csv");
        let words = ["plan", "--count", "44", "--candidates", "200"];
        let reported = refused(
            &[&words[..], &more[..]].concat(),
            &[("-o", none.as_path()), ("--profile", &profile)],
        );
        assert!(reported.contains(says), "{reported}");
        assert!(!none.exists());
    }
}

#[test]
fn a_plan_keeps_boxes_of_the_world_wherever_the_base_is() {
    let folder = scratch();
    let (effects, faults) = arm();
    let effects: Vec<&str> = effects.iter().map(String::as_str).collect();
    let profile = put(folder.path(), "p.yaml", &with_tool(TRACK, &effects));
    let table = folder.path().join("plan.csv");
    // a box along a part of the rail, and one in it that is kept out of; seen from a device
    let inside = [[300.0, 400.0, 500.0], [2400.0, 2600.0, 1500.0]];
    let out = [[1100.0, 1200.0, 800.0], [1500.0, 1700.0, 1100.0]];
    let device = [1500.0, 4500.0, 900.0];
    let words = |corners: &[[f64; 3]]| {
        let numbers = corners.iter().flatten().map(f64::to_string);
        numbers.collect::<Vec<_>>().join(",")
    };
    let [inside_words, out_words, device_words] = [words(&inside), words(&out), words(&[device])];
    let arguments = [
        "plan",
        "--json",
        "--count",
        "30",
        "--candidates",
        "300",
        "--level",
        "0",
        "--identify",
        "track",
        "--fix",
        "tool_frame",
        "--starts",
        "1",
        "--inside-mm",
        &inside_words,
        "--keep-out-mm",
        &out_words,
        "--device-mm",
        &device_words,
        "--cone-deg",
        "70",
    ];
    let files = [("--profile", profile.as_path()), ("-o", &table)];
    json(&arguments, &files);
    let text = std::fs::read_to_string(&table).expect("written");
    let head: Vec<&str> = text.lines().next().expect("a header").split(',').collect();
    let at = |name: &str| head.iter().position(|own| *own == name).expect(name);
    let nominal = Profile::from_yaml(&with_tool(TRACK, &[])).expect("a profile");
    let plain = robot_of(&nominal, &tool());
    let mut places = Vec::new();
    for line in text.lines().skip(1) {
        let cells: Vec<f64> = line
            .split(',')
            .map(|cell| cell.parse().expect(line))
            .collect();
        let e = 1e-3 * cells[at("e1_mm")];
        places.push(e);
        let mut robot = plain.clone();
        robot.base = carried(&rail(Vec::new()), &plain.base, e, 0.0);
        for below in [0.0, 5.0] {
            let q: [f64; 6] =
                std::array::from_fn(|i| (cells[at("q1_deg") + i] - below).to_radians());
            let pose = tool_pose(&robot, &faults, &q, &Moment::default());
            let tip: [f64; 3] = std::array::from_fn(|i| 1e3 * pose[i][3]);
            let is_in = |corners: &[[f64; 3]; 2]| {
                (0..3).all(|i| (corners[0][i]..=corners[1][i]).contains(&tip[i]))
            };
            assert!(is_in(&inside) && !is_in(&out), "{tip:?} at {e}");
            if below == 0.0 {
                let toward: [f64; 3] = std::array::from_fn(|i| device[i] - tip[i]);
                let along: f64 = (0..3).map(|i| toward[i] * pose[i][2]).sum();
                let length = toward.iter().map(|x| x * x).sum::<f64>().sqrt();
                assert!(along >= length * 70_f64.to_radians().cos() - 1e-6, "{line}");
            }
        }
    }
    places.sort_by(f64::total_cmp);
    assert!(
        places.len() == 30 && places[29] - places[0] > 0.8,
        "{places:?}"
    );
}

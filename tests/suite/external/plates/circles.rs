//! The axes of a positioner by the circles of one reflector.

use super::*;
use poseshift::geometry::{Pose, Rotation};
use poseshift::register::axes::positioner::{Row, Sweep, find};

/// A line along z of a frame.
fn line(m: &M4) -> ([f64; 3], [f64; 3]) {
    ([m[0][3], m[1][3], m[2][3]], [m[0][2], m[1][2], m[2][2]])
}

/// Distance of a point from a line, and the angle between two directions.
fn apart(point: [f64; 3], direction: [f64; 3], (on, along): ([f64; 3], [f64; 3])) -> [f64; 2] {
    let to: [f64; 3] = std::array::from_fn(|i| point[i] - on[i]);
    let far = cross(to, along);
    let turned = cross(direction, along);
    [dot(far, far).sqrt(), dot(turned, turned).sqrt()]
}

#[test]
fn circles_of_a_reflector_give_the_axes_of_a_positioner() {
    let rad = f64::to_radians;
    let folder = scratch();
    let (mut tables, fault) = hidden(2);
    for (table, [x, y, rx, ry]) in tables
        .iter_mut()
        .zip([[1.1, -0.7, 0.08, -0.06], [-0.5, 0.4, -0.03, 0.05]])
    {
        table.faults = vec![TableFault::Axis([1e-3 * x, 1e-3 * y, rad(rx), rad(ry)])];
    }
    let cell = Cell {
        tables,
        fault,
        ..Cell::new(2)
    };
    let still = 25.0;
    let mut swept = Vec::new();
    for k in 0..19 {
        swept.push(("e1", vec![f64::from(15 * k - 135), 0.0]));
    }
    for k in 0..19 {
        swept.push(("e2", vec![still, f64::from(15 * k - 135)]));
    }
    let profile = put(folder.path(), "p.yaml", &in_world(&section(2)));
    let truth_of = |tables: &[Table], e1: f64| -> [M4; 2] {
        let bare = |table: &Table| Table {
            faults: table.faults.clone(),
            ..table.clone()
        };
        let none = [0.0; 6];
        let zero = frame(&none);
        let of = |tables: &[Table], e: &[f64]| plate(tables, &zero, &none, e);
        // the axis itself is where its frame is, whatever its angle
        let one = of(&[bare(&tables[0])], &[rad(10.0)]);
        let two = of(&[bare(&tables[0]), bare(&tables[1])], &[rad(e1), 0.0]);
        [one, two]
    };
    let truth = truth_of(&cell.tables, still);
    for (noise_mm, near_mm, near_deg) in [(0.0, 1e-4, 1e-5), (0.03, 0.05, 0.01)] {
        let mut random = StdRng::seed_from_u64(21);
        let mut text = "id,sweep,point,e1_deg,e2_deg,x_mm,y_mm,z_mm\n".to_owned();
        for (row, (axis, e)) in swept.iter().enumerate() {
            let angles: Vec<f64> = e.iter().map(|e| e.to_radians()).collect();
            let pose = plate(&cell.tables, &frame(&ON_AXIS), &cell.fault, &angles);
            let seen = cell.cells(point(&pose, REFLECTORS[0]), noise_mm, &mut random);
            let place = seen.rsplit_once(',').expect("a sigma").0;
            text += &format!("{row},{axis},r0,{},{},{place}\n", e[0], e[1]);
        }
        let csv = put(folder.path(), "s.csv", &text);
        let page = folder.path().join("page.html");
        let done = poseshift()
            .args(["axes", "--json"])
            .arg(&csv)
            .arg("--profile")
            .arg(&profile)
            .arg("--report")
            .arg(&page)
            .output()
            .expect("the program starts");
        let reported = String::from_utf8_lossy(&done.stderr).into_owned();
        assert_eq!(done.status.code(), Some(0), "{reported}");
        let found: Value = serde_json::from_slice(&done.stdout).expect("JSON");
        let axes = found["positioner_axes"].as_array().expect("a list");
        assert_eq!(axes.len(), 2, "{found:#}");
        assert!(
            std::fs::read_to_string(&page)
                .expect("a page")
                .contains("Axes of positioners")
        );
        let three = |value: &Value| -> [f64; 3] {
            std::array::from_fn(|i| value[i].as_f64().expect("a number"))
        };
        for (found, truth) in axes.iter().zip(&truth) {
            let centre = three(&found["centre_mm"]).map(|mm| 1e-3 * mm);
            let [far, turned] = apart(centre, three(&found["direction"]), line(truth));
            assert!(
                1e3 * far < near_mm && turned.to_degrees() < near_deg,
                "{far} {turned} {found:#}"
            );
        }
        // as the profile would have them, one in the frame of the other
        let pose = |value: &Value| -> M4 {
            let n = |key: &str| value[key].as_f64().expect("a number");
            frame(&[
                1e-3 * n("x_mm"),
                1e-3 * n("y_mm"),
                1e-3 * n("z_mm"),
                rad(n("rx_deg")),
                rad(n("ry_deg")),
                rad(n("rz_deg")),
            ])
        };
        let first = pose(&axes[0]["at"]);
        let second = times(
            &times(&first, &turn_z(rad(-(still - 10.0)))),
            &pose(&axes[1]["at"]),
        );
        for (mine, truth) in [first, second].iter().zip(&truth) {
            let (on, along) = line(mine);
            let [far, turned] = apart(on, along, line(truth));
            assert!(
                1e3 * far < near_mm && turned.to_degrees() < near_deg,
                "{far} {turned}"
            );
        }
        let sigma = axes[0]["at_sigma"]["x_mm"].as_f64().expect("a number");
        assert!(sigma < near_mm.max(1e-3), "{sigma}");
    }
    for (from, to, says) in [
        ("e1,r0,-135,0", "e1,r0,-135,0.5", "E2 moves too"),
        (",e2,r0,", ",e3,r0,", "e1 (E1), e2 (E2)"),
        (",e2,r0,", ",e2,r1,", "choose one with --point"),
    ] {
        let good = std::fs::read_to_string(folder.path().join("s.csv")).expect("written");
        assert!(good.contains(from), "{from}");
        let csv = put(folder.path(), "bad.csv", &good.replace(from, to));
        let sweeps = csv.to_string_lossy();
        let reported = refused(&["axes", &sweeps], &[("--profile", &profile)]);
        assert!(reported.contains(says), "{reported}");
    }
}

#[test]
fn uncertainties_of_axes_are_the_scatter_of_what_is_found_again_and_again() {
    let external = "external_axes:\n  positioners:\n    - name: s\n      axes:\n        \
        - {axis: E1, at: {x_mm: 900, y_mm: 100, z_mm: 400, rx_deg: -90, ry_deg: 0, rz_deg: 20}, \
        min_deg: -180, max_deg: 180}\n        \
        - {axis: E2, at: {x_mm: 20, y_mm: -300, z_mm: 50, rx_deg: 90, ry_deg: 0, rz_deg: 0}, \
        min_deg: -360, max_deg: 360}\n";
    let axes = super::super::profile(external, &[]).external;
    let (first, second) = (
        axes.positioners[0].axes[0].at,
        axes.positioners[0].axes[1].at,
    );
    let point = [0.25, 0.0, 0.1];
    let mut random = StdRng::seed_from_u64(31);
    let mut normal = move || (0..12).map(|_| random.random_range(-0.5..0.5)).sum::<f64>();
    let mut sweep = |axis: usize| {
        let rows = (0..25).map(|k| {
            let turned = (-120.0 + 10.0 * f64::from(k)).to_radians();
            let values = if axis == 0 {
                vec![turned, 0.3]
            } else {
                vec![-0.4, turned]
            };
            let on_first = first * Pose::from_rotation(Rotation::about_z(values[0]));
            let on_second = on_first * second * Pose::from_rotation(Rotation::about_z(values[1]));
            let point_m = on_second.transform(point).map(|x| x + 3e-5 * normal());
            Row { values, point_m }
        });
        let rows = rows.collect();
        Sweep { axis, rows }
    };
    // by axis: three of the place, three of the rotation about its own axes
    let mut squares = [[0.0; 6]; 2];
    let mut stated = [[0.0; 6]; 2];
    let count = 150;
    for _ in 0..count {
        let found = find(&axes, &[sweep(0), sweep(1)]).expect("axes");
        for (k, (found, truth)) in found.iter().zip([first, second]).enumerate() {
            let covariance = found.covariance.as_ref().expect("noise");
            let place = covariance.sigma_at_m(covariance.centre_m);
            let turned = (truth.inverse() * found.at).rotation.vector();
            for i in 0..3 {
                let off = found.at.translation[i] - truth.translation[i];
                let about = covariance.rotation_sigma_about_rad(found.at.rotation.axis(i));
                squares[k][i] += off * off;
                squares[k][3 + i] += turned[i] * turned[i];
                stated[k][i] += place[i] * place[i];
                stated[k][3 + i] += about * about;
            }
        }
    }
    for (k, (squares, stated)) in squares.iter().zip(&stated).enumerate() {
        for (i, (is, said)) in squares.iter().zip(stated).enumerate() {
            let [is, said] = [is, said].map(|x| (x / f64::from(count)).sqrt());
            if is < 1e-7 {
                assert!(said < 1e-7, "{k} {i}: {said}");
            } else {
                let ratio = said / is;
                assert!((0.8..1.25).contains(&ratio), "{k} {i}: {said} for {is}");
            }
        }
    }
}

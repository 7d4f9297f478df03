//! Tables as trackers, their software and controllers write them.

use crate::support::text;
use poseshift::geometry::Rotation;
use poseshift::identify::measurements::{Measurements, Observed};
use poseshift::identify::table::{Euler, Grid, Mapping, Table, Units};
use poseshift::model::Coupling;
use poseshift::model::profile::Profile;

const JOINTS: &str = "id,q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg\n1,10,20,30,40,50,60\n2,11,19,30,40,50,60\n3,12,20,30,40,50,60\n";

fn mapping(columns: &str, units: &str) -> Mapping {
    let mut mapping = Mapping::default();
    mapping.add_text(columns).expect("a mapping");
    mapping.add_units(Units::parse(units.split(',').filter(|u| !u.is_empty())).expect("units"));
    mapping
}

fn joined(points: &[u8], mapping: &Mapping) -> (Measurements, Vec<&'static str>) {
    let grids = [JOINTS.as_bytes(), points].map(|bytes| Grid::read("T", bytes).expect("a table"));
    let [joints, points] = grids;
    let table =
        Table::joined(joints, points, mapping).unwrap_or_else(|e| panic!("{e}: {}", e.hint()));
    // exports have columns that nothing is read from
    let all = table.remarks.iter().map(|remark| remark.id);
    let reported = all.filter(|id| *id != "columns-not-read").collect();
    (
        Measurements::from_table(&table).unwrap_or_else(|e| panic!("{e}: {}", e.hint())),
        reported,
    )
}

fn refused(points: &str, mapping: &Mapping) -> String {
    let grids = [JOINTS, points].map(|text| Grid::read("T", text.as_bytes()).expect("a table"));
    let [joints, points] = grids;
    let found =
        Table::joined(joints, points, mapping).and_then(|table| Measurements::from_table(&table));
    let error = found.expect_err("it should be refused");
    format!("{error}; {}", error.hint())
}

fn places(of: &Measurements) -> Vec<[f64; 3]> {
    of.rows
        .iter()
        .map(|row| row.observed.point_m().expect("a place"))
        .collect()
}

/// Equal but for rounding of the last digit.
fn near(a: &[[f64; 3]], b: &[[f64; 3]]) {
    assert_eq!(a.len(), b.len());
    for (a, b) in a.iter().flatten().zip(b.iter().flatten()) {
        assert!((a - b).abs() < 1e-12, "{a} {b}");
    }
}

#[test]
fn columns_that_nothing_is_read_from_are_listed() {
    let remarks = |header: &str, mapping: &Mapping| {
        let text = format!(
            "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg,x_mm,y_mm,z_mm,{header}\n\
             1,2,3,4,5,6,7,8,9,10,20,30\n"
        );
        let table = Table::of(Grid::read("T", text.as_bytes()).expect("a table"), mapping);
        let remarks = table.expect("a table").remarks;
        let all = remarks
            .iter()
            .map(|r| format!("{} {} {}", r.id, r.warning, r.message));
        all.collect::<Vec<_>>().join("; ")
    };
    let plain = Mapping::default();
    let angles = remarks("rx_deg,ry_deg,rz_deg", &plain);
    assert!(angles.starts_with("orientation-not-read true"), "{angles}");
    assert!(angles.contains("rx_deg, ry_deg, rz_deg"), "{angles}");
    let mut named = mapping("", "");
    named.euler = Some((Euler::named("xyz").expect("a name"), true));
    assert_eq!(remarks("rx_deg,ry_deg,rz_deg", &named), "");
    let others = remarks("operator,temp,time_s", &plain);
    assert!(others.starts_with("columns-not-read false"), "{others}");
    assert!(others.ends_with("`operator`, `temp`"), "{others}");
    assert_eq!(remarks("time_s,temperature_c,sigma_mm", &plain), "");
    assert_eq!(remarks("time_s,sigma_deg,sigma_mm", &plain), "");
}

#[test]
fn exports_of_measuring_software_are_read_as_they_are() {
    // the header and two rows of a file of Leica Tracker Pilot, in Latin-1
    let leica = b"X  [mm],Y  [mm],Z  [mm],U(95)  [mm],U(95) X  [mm],Q0 ,Q1 ,Image RMS  \
        [\xb5m],Temperature  [\xb0C],Time Stamp,Delete\n\
        754,-3193.366,303.745,0.004,0.003,0.227782,-0.114534,0.22,22.8,'11.10.2022 15:06:48.043,\n\
        835.44,-3148.711,256.682,0.01,0.008,0.37518,-0.170711,0.35,22.8,'11.10.2022 15:06:55.562,\n\
        394.456,-3200.746,-664.155,0.01,0.006,0.388994,-0.204948,0.35,22.8,'11.10.2022 \
            15:07:07.502,\n";
    let (read, reported) = joined(leica, &Mapping::default());
    near(&places(&read)[..1], &[[0.754, -3.193_366, 0.303_745]]);
    assert_eq!(
        reported,
        ["export-recognised", "encoding", "joined-in-order"]
    );
    // SpatialAnalyzer: commas, blanks, comments, with and without collection and group
    for list in [
        "// frame: A::WORLD\n3,  1975.5,  -310.25,  -257.0\n1,  1.0, 2.0, 3.0\n2, 4, 5, 6\n",
        "3   1975.5   -310.25   -257.0\n1 1.0 2.0 3.0\n2 4 5 6\n",
        "A,points,3,1975.5,-310.25,-257\nA,points,1,1,2,3\nA,points,2,4,5,6\n",
    ] {
        let (read, reported) = joined(list.as_bytes(), &Mapping::default());
        assert_eq!(reported, ["export-recognised"], "{list}");
        near(
            &places(&read),
            &[
                [1.9755, -0.31025, -0.257],
                [0.001, 0.002, 0.003],
                [0.004, 0.005, 0.006],
            ],
        );
        assert!(
            (read.rows[0].q[0].to_degrees() - 12.0).abs() < 1e-12,
            "joined by id"
        );
    }
    // one row a coordinate, a unit in the name of the column
    let long = "Name;Control;Nom;Meas \
        [in];Tol;Dev;Test\n1;X;1;1,5;0,1;0,5;Fail\n;Y;2;2;0,1;0;Pass\n;Z;3;3;0,1;0;Pass\n\
        2;X;1;1;;0;\n2;Y;1;1;;0;\n2;Z;1;1;;0;\n";
    let (read, reported) = joined(long.as_bytes(), &Mapping::default());
    assert_eq!(reported, ["export-recognised", "not-measured"]);
    near(&places(&read)[..1], &[[0.0381, 0.0508, 0.0762]]);
    let lacking = "Name;Control;Nom;Meas\n1;X;1;1,5\n1;Y;2;2\n";
    let error = Table::of(
        Grid::read("T", lacking.as_bytes()).expect("a table"),
        &Mapping::default(),
    );
    assert!(
        error
            .expect_err("no Z")
            .to_string()
            .contains("not all of X, Y and Z")
    );
    // one row a point: measured ones count, else nominal ones and deviations
    let wide = "Name\tNom X\tNom Y\tNom Z\tMeas X\tMeas Y\tMeas \
        Z\n1\t1\t2\t3\t4\t5\t6\n2\t1\t2\t3\t4\t5\t6\n3\t1\t2\t3\t7\t8\t9\n";
    let (read, _) = joined(wide.as_bytes(), &Mapping::default());
    near(&places(&read)[2..], &[[0.007, 0.008, 0.009]]);
    let sums = "Name,X nominal,Y nominal,Z \
        nominal,dX,dY,dZ\n1,100,200,300,0.5,-0.5,0.25\n2,1,1,1,0,0,0\n3,1,1,1,0,0,0\n";
    let (read, _) = joined(sums.as_bytes(), &Mapping::default());
    near(&places(&read)[..1], &[[0.1005, 0.1995, 0.30025]]);
}

#[test]
fn an_unknown_header_is_answered_with_a_mapping() {
    let reported = refused(
        "Punkt;Ost (m);Nord (m);H\n1;1;2;3\n2;1;2;3\n3;1;2;3\n",
        &Mapping::default(),
    );
    assert!(
        reported.contains("columns are missing: x_mm, y_mm, z_mm"),
        "{reported}"
    );
    assert!(
        reported.contains("--columns id=Punkt") && reported.contains("Nord (m)"),
        "{reported}"
    );
    let own = mapping("id=punkt,x=Ost (m),y=Nord (m),z=#4", "");
    let (read, _) = joined(
        "Punkt;Ost (m);Nord (m);H\n1;1;2;3\n2;1;2;3\n3;1;2;3\n".as_bytes(),
        &own,
    );
    near(&places(&read)[..1], &[[1.0, 2.0, 0.003]]);
    // the unit of what does not say it
    let metres = mapping("x=Ost (m),y=Nord (m),z=H", "m");
    let (read, reported) = joined(
        "Ost (m);Nord (m);H\n1;1;2\n1;1;2\n1;1;2\n".as_bytes(),
        &metres,
    );
    near(&places(&read)[..1], &[[1.0, 1.0, 2.0]]);
    assert_eq!(reported, ["joined-in-order"]);
    // units of the format's own names need no option
    let (read, _) = joined(
        b"id,x_m,y_m,z_in\n1,1,2,1\n2,1,2,1\n3,1,2,1\n",
        &Mapping::default(),
    );
    near(&places(&read)[..1], &[[1.0, 2.0, 0.0254]]);
}

#[test]
fn several_reflectors_stand_in_columns_or_rows() {
    let columns = mapping("a.x=X1,a.y=Y1,a.z=Z1,b.x=X2,b.y=Y2,b.z=Z2", "");
    let wide = "id,X1,Y1,Z1,X2,Y2,Z2\n1,1,2,3,4,5,6\n2,,,,7,8,9\n3,1,1,1,,,\n";
    let (read, _) = joined(wide.as_bytes(), &columns);
    let names: Vec<_> = read
        .rows
        .iter()
        .map(|row| row.point.as_deref().expect("a name"))
        .collect();
    assert_eq!(names, ["a", "b", "b", "a"]);
    near(
        &places(&read)[1..3],
        &[[0.004, 0.005, 0.006], [0.007, 0.008, 0.009]],
    );
    assert!(read.has(&["point", "x_mm"]));
    let stacked = "id,point,x_mm,y_mm,z_mm\n1,a,1,2,3\n2,a,7,8,9\n1,b,4,5,6\n2,b,1,1,1\n";
    let (read, reported) = joined(stacked.as_bytes(), &Mapping::default());
    assert_eq!(
        (read.rows.len(), reported.as_slice()),
        (4, ["not-measured"].as_slice())
    );
    assert_eq!(read.rows[2].q, read.rows[0].q);
    let reported = refused(
        "id,X1,Y1,Z1,X2,Y2,Z2\n1,1,2,3,4,5,6\n2,,,,,,\n3,1,1,1,,,\n",
        &columns,
    );
    assert!(reported.contains("no point was measured"), "{reported}");
    let reported = refused("id,x_mm,y_mm,z_mm\n1,1,2,3\n1,4,5,6\n", &Mapping::default());
    assert!(
        reported.contains("stands in line 2, too") && reported.contains("column point"),
        "{reported}"
    );
}

#[test]
fn directions_follow_from_the_order_in_which_the_robot_drove() {
    let mut order = Mapping::default();
    let mut arm = Profile::from_yaml(&text("robots/abb_irb120_thesis.yaml"))
        .expect("a profile")
        .mechanism;
    order.driven = Some(arm.clone());
    // the pose between was driven to, though it was not measured
    let (read, _) = joined(b"id,x_mm,y_mm,z_mm\n1,1,2,3\n3,4,5,6\n", &order);
    let directions: Vec<[f64; 6]> = read
        .rows
        .iter()
        .map(|row| row.conditions.direction)
        .collect();
    assert_eq!(directions, [[0.0; 6], [1.0, 1.0, 0.0, 0.0, 0.0, 0.0]]);
    assert!(read.has(&["dir1", "dir6"]));
    // a tracker's file in another order: rows, directions and moves are in that of the joints
    let (sorted, _) = joined(b"id,x_mm,y_mm,z_mm\n3,4,5,6\n1,1,2,3\n", &order);
    assert_eq!(places(&sorted), places(&read));
    for rows in [&sorted.rows, &read.rows] {
        let moved = rows[1].conditions.moved.map(f64::to_degrees);
        near(&[[moved[0], moved[1], moved[2]]], &[[1.0, 1.0, 0.0]]);
        assert_eq!(rows[1].conditions.direction, directions[1]);
    }
    // readings that differ in the last digits have not moved
    let still = "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg,x_mm,y_mm,z_mm\n0,0,0,0,0,0,1,2,3\n5,0,0,0,0,0,1,2,3\n4.999,-1,0,0,0,0,1,2,3\n";
    let table =
        Table::of(Grid::read("M", still.as_bytes()).expect("a table"), &order).expect("columns");
    let read = Measurements::from_table(&table).expect("rows");
    assert_eq!(
        read.rows[2].conditions.direction,
        [1.0, -1.0, 0.0, 0.0, 0.0, 0.0]
    );
    // where joint 3 counts together with joint 2, the angle that turns it is their sum
    arm.couple(Coupling {
        joint: 2,
        on: 1,
        ratio: 1.0,
    });
    order.driven = Some(arm);
    let coupled = "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg,x_mm,y_mm,z_mm\n0,0,0,0,0,0,1,2,3\n0,20,-10,0,0,0,1,2,3\n";
    let table = Table::of(
        Grid::read("M", coupled.as_bytes()).expect("a table"),
        &order,
    )
    .expect("columns");
    let read = Measurements::from_table(&table).expect("rows");
    assert_eq!(
        read.rows[1].conditions.direction,
        [0.0, 1.0, 1.0, 0.0, 0.0, 0.0]
    );
}

#[test]
fn angles_are_rotations_by_the_name_of_their_convention() {
    let mut kuka = mapping("rz=A,ry=B,rx=C", "");
    kuka.euler = Some((Euler::named("kuka").expect("a name"), true));
    let (read, _) = joined(
        b"id,x_mm,y_mm,z_mm,A,B,C\n1,1,2,3,30,-20,50\n2,1,2,3,0,0,0\n3,1,2,3,,,\n",
        &kuka,
    );
    let Observed::Pose(pose) = read.rows[0].observed else {
        panic!("a pose")
    };
    let [a, b, c] = [30_f64, -20.0, 50.0].map(f64::to_radians);
    let wanted = Rotation::about_z(a) * Rotation::about_y(b) * Rotation::about_x(c);
    assert!((pose.rotation.transpose() * wanted).angle() < 1e-12);
    // a row without angles is a position
    assert!(matches!(read.rows[2].observed, Observed::Position(_)));
    let reported = refused("id,x_mm,y_mm,z_mm\n1,1,2,3\n", &kuka);
    assert!(reported.contains("no column `A` for rz_deg"), "{reported}");
}

#[test]
fn what_cannot_be_joined_is_refused_with_both_files() {
    let reported = refused("id,x_mm,y_mm,z_mm\n1,1,2,3\n9,4,5,6\n", &Mapping::default());
    assert!(
        reported.contains("the id `9` is not in T, whose ids are 1, 2, 3"),
        "{reported}"
    );
    let reported = refused("x_mm,y_mm,z_mm\n1,2,3\n4,5,6\n", &Mapping::default());
    assert!(reported.contains("T has 3 rows, T has 2"), "{reported}");
    let reported = refused("id,x_mm,y_mm,z_mm,q1_deg\n1,2,3,4,5\n", &Mapping::default());
    assert!(
        reported.contains("the column q1_deg stands in"),
        "{reported}"
    );
}

//! `simulate`: measurements of the robot that a profile describes.

use super::Document;
use super::circumstances::{directions as direction_of, temperature_c, time_s};
use super::failure::Failure;
use super::fk::BeyondLimits;
use super::profile_file::ProfileFile;
use super::table::{JOINTS, Row, Table, cell, text_cell};
use crate::finding::Finding;
use crate::geometry::units::{DEG, mm_from_m};
use crate::identify::external::{agree, column_of, from_files, in_files};
use crate::identify::measurements::{
    DIRECTION_COLUMNS, DISTANCE_COLUMNS, EXTERNAL_DIRECTION_COLUMNS, FORCE_COLUMNS, Measurement,
    Measurements, Observed, POSITION_COLUMNS, QUATERNION_COLUMNS,
};
use crate::identify::simulate::{Command, Device, Given, Session, simulate_given as measure};
use crate::model::external::{Listed, Stand};
use crate::model::profile::{Mounted, Profile};
use crate::program::Source;
use schemars::JsonSchema;
use serde::Serialize;

/// Measurements that were made.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Simulation {
    /// How many.
    pub rows: usize,
    /// The file written.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub output: Option<String>,
    /// The measurements (CSV), where no file is written.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub csv: Option<String>,
    /// What should be looked at.
    pub findings: Vec<Finding>,
}

impl Document for Simulation {
    const KIND: &'static str = "simulation/1";
}

/// Measures the real arm of a profile in each row's joint angles, every named point of it, in the
/// frame of the profile's device.
///
/// # Errors
/// A table without joints, or with some of the columns of directions or forces only; a tool that
/// the profile does not have.
pub fn simulate(
    file: &ProfileFile,
    joints: &Source,
    tool: Option<&str>,
    session: &Session,
) -> Result<Simulation, Failure> {
    let tool = file.tool(tool)?;
    let table = Table::read(joints)?;
    if !table.has("on") {
        table.require(&JOINTS)?;
    }
    let directions = table.group(&DIRECTION_COLUMNS)?;
    let forces = table.group(&FORCE_COLUMNS)?;
    let mut beyond = BeyondLimits::default();
    let command = |row: Row| {
        let plate = plate(&file.profile, &row)?;
        if plate.is_some() {
            return Ok(Command {
                q: [0.0; 6],
                stand: stand(&file.profile, &row)?,
                plate,
                direction: None,
                force_n: [0.0; 3],
            });
        }
        table.require(&JOINTS)?;
        let mut direction = None;
        if directions {
            direction = Some(direction_of(&row)?);
        }
        let mut force_n = [0.0; 3];
        if forces {
            force_n = row.numbers(FORCE_COLUMNS)?;
        }
        let q = row.joints()?;
        beyond.look(&file.profile.mechanism, row.line, &q);
        Ok(Command {
            q,
            stand: stand(&file.profile, &row)?,
            plate,
            direction,
            force_n,
        })
    };
    let commands: Vec<Command> = table.rows().map(command).collect::<Result<_, Failure>>()?;
    let given = given(&table, session)?;
    table.refuse_misspelt()?;
    let found = simulated(file, &commands, &given, forces, &tool, session)?;
    Ok(Simulation {
        findings: beyond.findings(&file.profile.mechanism, &joints.name),
        ..found
    })
}

/// What each row says of itself: its id, temperature and time.
fn given(table: &Table, session: &Session) -> Result<Vec<Given>, Failure> {
    let given = table.rows().enumerate().map(|(number, row)| {
        let (temperature_c, time_s) = (temperature_c(&row)?, time_s(&row)?);
        let twice = [
            (
                "--temperature-c",
                "temperature_c",
                session.temperature_c.is_some() && temperature_c.is_some(),
            ),
            (
                "--interval-s",
                "time_s",
                session.interval_s.is_some() && time_s.is_some(),
            ),
        ];
        if let Some((option, column, _)) = twice.iter().find(|(.., twice)| *twice) {
            return Err(row.failure(format!(
                "the column {column} and {option} cannot both be given"
            )));
        }
        Ok(Given {
            id: Some(row.id(number + 1)).filter(|_| table.has("id")),
            temperature_c,
            time_s,
        })
    });
    given.collect()
}

/// The positioner whose plate is measured in a row of a table; none where it is the tool.
fn plate(profile: &Profile, row: &Row) -> Result<Option<usize>, Failure> {
    let on = row.text("on").unwrap_or("tool");
    let Some(name) = on.strip_prefix("plate:") else {
        return match on {
            "tool" => Ok(None),
            _ => Err(row.failure(format!(
                "`{on}` is neither tool nor plate:NAME of a positioner"
            ))),
        };
    };
    let all = &profile.external.positioners;
    let known = all
        .iter()
        .position(|own| own.name.eq_ignore_ascii_case(name));
    match known {
        None => Err(row.failure(format!("the profile has no positioner `{name}`"))),
        Some(plate) if all[plate].points.is_empty() => Err(row.failure(format!(
            "positioner {name} of the profile has no `points` to measure"
        ))),
        Some(plate) => Ok(Some(plate)),
    }
}

/// Where the external axes of a profile stand in a row of a table.
///
/// # Errors
/// A cell that is no number.
pub(super) fn stand(profile: &Profile, row: &Row) -> Result<Stand, Failure> {
    let mut stand = Stand::default();
    for (k, axis) in profile.external.listed().enumerate() {
        let column = column_of(&axis, k);
        // an axis that does not carry the point may be left empty
        let there = row.text(column).is_some_and(|text| !text.is_empty());
        stand.values.push(if there {
            from_files(&axis, row.number(column)?)
        } else {
            f64::NAN
        });
        let direction = EXTERNAL_DIRECTION_COLUMNS[k];
        if row.text(direction).is_some_and(|text| !text.is_empty()) {
            stand.directions.resize(k, 0.0);
            stand.directions.push(row.number(direction)?);
        }
    }
    Ok(stand)
}

/// As [`simulate`], in these configurations; `forces` of them stand in the table.
///
/// # Errors
/// Noise or outliers that are none.
pub fn simulate_at(
    file: &ProfileFile,
    commands: &[Command],
    forces: bool,
    tool: &Mounted,
    session: &Session,
) -> Result<Simulation, Failure> {
    simulated(file, commands, &[], forces, tool, session)
}

fn simulated(
    file: &ProfileFile,
    commands: &[Command],
    given: &[Given],
    forces: bool,
    tool: &Mounted,
    session: &Session,
) -> Result<Simulation, Failure> {
    refuse_nonsense(session)?;
    let profile = &file.profile;
    let mut points: Vec<(Option<String>, [f64; 3])> = profile
        .points
        .iter()
        .map(|(name, p)| (Some(name.clone()), *p))
        .collect();
    if points.is_empty() {
        points.push((None, [0.0; 3]));
    }
    let rows = measure(profile, tool, &points, (commands, given), session);
    let seen = Measurements {
        rows,
        columns: Vec::new(),
    };
    agree(&seen, profile).map_err(|error| Failure::with_hint(error.to_string(), error.hint()))?;
    let rows = seen.moved(&profile.world_from_device().inverse()).rows;
    refuse_no_place(&rows)?;
    let named_tool = profile.tools.contains_key(&tool.name);
    let axes: Vec<Listed> = profile.external.listed().collect();
    let csv = measurements_csv(&rows, (true, forces), &axes, named_tool);
    Ok(Simulation {
        rows: rows.len(),
        output: None,
        csv: Some(csv),
        findings: Vec::new(),
    })
}

/// The standard deviation of an orientation, where one was read.
fn sigma_rad(row: &Measurement) -> Option<f64> {
    let is_pose = matches!(row.observed, Observed::Pose(_));
    row.sigma_rad.filter(|_| is_pose)
}

/// Rows that the model puts nowhere: a value of the profile is beyond any arm.
fn refuse_no_place(rows: &[Measurement]) -> Result<(), Failure> {
    let is_finite = |p: [f64; 3]| p.iter().all(|x| x.is_finite());
    let is_somewhere = |row: &Measurement| match row.observed {
        Observed::Position(p) => is_finite(p),
        Observed::Pose(pose) => pose.is_finite(),
        Observed::Distance { distance_m, from_m } => distance_m.is_finite() && is_finite(from_m),
        Observed::Contact(_) => true,
    };
    match rows.iter().position(|row| !is_somewhere(row)) {
        Some(row) => Err(Failure::with_hint(
            format!("measurement {} has no finite position", row + 1),
            "a value of the profile is beyond any arm: `poseshift profile show` lists them",
        )),
        None => Ok(()),
    }
}

/// The largest error that is simulated, mm.
const MOST_MM: f64 = 1e6;
/// Coordinates that `calibrate` reads, mm.
const FARTHEST_MM: f64 = 1e8;
/// Seconds from row to row, and degrees Celsius, that somebody may mean.
const MOST_S: f64 = 1e6;
const COLDEST_C: f64 = -273.15;
const HOTTEST_C: f64 = 1000.0;

/// What the device does within what it can be.
fn refuse_nonsense(session: &Session) -> Result<(), Failure> {
    let mut sizes = vec![
        ("--noise-mm", mm_from_m(session.noise_m), 0.0, MOST_MM),
        ("--noise-deg", session.noise_rad / DEG, 0.0, 180.0),
        ("--outliers", session.outliers, 0.0, 1.0),
        ("--outlier-mm", mm_from_m(session.outlier_m), 0.0, MOST_MM),
    ];
    let interval = session.interval_s;
    sizes.extend(interval.map(|s| ("--interval-s", s, 0.0, MOST_S)));
    let temperatures = session.temperature_c.into_iter().flatten();
    sizes.extend(temperatures.map(|c| ("--temperature-c", c, COLDEST_C, HOTTEST_C)));
    if let Device::Distance(from) = &session.device {
        let from = from.iter().flatten().map(|x| mm_from_m(*x));
        sizes.extend(from.map(|x| ("--from", x, -FARTHEST_MM, FARTHEST_MM)));
    }
    for (option, value, least, most) in sizes {
        if !(least..=most).contains(&value) {
            return Err(Failure::new(format!(
                "{option} is {value}; it must be from {least} to {most}"
            )));
        }
    }
    Ok(())
}

/// A file of measurements; every number is read back as it is. Directions, forces and tools stand
/// in it where they are asked for, and where these external axes stood, of those that the rows
/// tell.
#[must_use]
pub fn measurements_csv(
    rows: &[Measurement],
    (directions, forces): (bool, bool),
    axes: &[Listed],
    named_tool: bool,
) -> String {
    let Some(first) = rows.first() else {
        return format!("{}\n", JOINTS.join(","));
    };
    let of_tool = rows.iter().any(|row| row.plate.is_none());
    let on_plates = rows.iter().any(|row| row.plate.is_some());
    let mut header: Vec<&str> = vec!["id"];
    header.extend(JOINTS.iter().filter(|_| of_tool));
    match first.observed {
        Observed::Position(_) => header.extend(POSITION_COLUMNS),
        Observed::Pose(_) => header.extend(POSITION_COLUMNS.iter().chain(&QUATERNION_COLUMNS)),
        Observed::Distance { .. } => header.extend(DISTANCE_COLUMNS),
        Observed::Contact(_) => {}
    }
    let value = |row: &Measurement, k: usize| {
        let value = row.stand.values.get(k).copied();
        value.filter(|value| value.is_finite())
    };
    let given: Vec<usize> = (0..axes.len())
        .filter(|k| rows.iter().any(|row| value(row, *k).is_some()))
        .collect();
    header.extend(given.iter().map(|k| column_of(&axes[*k], *k)));
    let came: Vec<usize> = (0..first.stand.directions.len().min(axes.len())).collect();
    let came = if directions { came } else { Vec::new() };
    header.extend(came.iter().map(|k| EXTERNAL_DIRECTION_COLUMNS[*k]));
    let (directions, forces) = (directions && of_tool, forces && of_tool);
    let named_tool = named_tool && of_tool;
    header.extend(DIRECTION_COLUMNS.iter().filter(|_| directions));
    header.extend(FORCE_COLUMNS.iter().filter(|_| forces));
    let named = rows.iter().any(|row| row.point.is_some());
    let optional = [
        (named_tool, "tool"),
        (on_plates, "on"),
        (named, "point"),
        (first.conditions.temperature_c.is_some(), "temperature_c"),
        (first.conditions.time_s.is_some(), "time_s"),
        (first.sigma_m.is_some(), "sigma_mm"),
        (sigma_rad(first).is_some(), "sigma_deg"),
    ];
    header.extend(
        optional
            .iter()
            .filter(|(there, _)| *there)
            .map(|(_, name)| *name),
    );
    let mut out = header.join(",") + "\n";
    let text = |text: &str| text_cell(text).into_owned();
    for row in rows {
        let mut cells = vec![text_cell(&row.id).into_owned()];
        // of a point on a plate the arm's joints say nothing
        let of_arm = |number: f64| match row.plate {
            None => cell(number),
            Some(_) => String::new(),
        };
        cells.extend(row.q.iter().filter(|_| of_tool).map(|q| of_arm(q / DEG)));
        match row.observed {
            Observed::Position(p) => cells.extend(p.map(|x| cell(mm_from_m(x)))),
            Observed::Pose(pose) => {
                cells.extend(pose.translation.map(|x| cell(mm_from_m(x))));
                cells.extend(pose.rotation.quaternion().0.map(cell));
            }
            Observed::Distance { distance_m, from_m } => {
                cells.push(cell(mm_from_m(distance_m)));
                cells.extend(from_m.map(|x| cell(mm_from_m(x))));
            }
            // no simulated device touches
            Observed::Contact(_) => {}
        }
        for k in &given {
            let there = value(row, *k).map(|value| cell(in_files(&axes[*k], value)));
            cells.push(there.unwrap_or_default());
        }
        for k in &came {
            cells.push(cell(row.stand.directions.get(*k).copied().unwrap_or(0.0)));
        }
        if directions {
            cells.extend(row.conditions.direction.map(of_arm));
        }
        if forces {
            cells.extend(row.conditions.force_n.map(of_arm));
        }
        if named_tool {
            cells.push(row.tool.as_deref().map(text).unwrap_or_default());
        }
        if on_plates {
            let plate = row
                .plate
                .as_ref()
                .map(|name| text(&format!("plate:{name}")));
            cells.push(plate.unwrap_or_else(|| "tool".into()));
        }
        if named {
            cells.push(row.point.as_deref().map(text).unwrap_or_default());
        }
        cells.extend(row.conditions.temperature_c.map(cell));
        cells.extend(row.conditions.time_s.map(cell));
        cells.extend(row.sigma_m.map(|s| cell(mm_from_m(s))));
        cells.extend(sigma_rad(row).map(|s| cell(s / DEG)));
        out += &(cells.join(",") + "\n");
    }
    out
}

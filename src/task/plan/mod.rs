//! `plan`: which configurations to measure, and a program that drives there.

mod approach;
mod driving;

use super::Document;
use super::failure::Failure;
use super::measurements::identify_failure;
use super::meshes::Reader;
use super::parts::Observability;
use super::profile_file::ProfileFile;
use super::simulate::stand;
use super::table::{JOINTS, Table, cell, text_cell};
use crate::finding::Finding;
use crate::geometry::units::{DEG, mm_from_m};
use crate::identify::IdentifyError;
use crate::identify::external::{column_of, track_columns};
use crate::identify::measurements::{DIRECTION_COLUMNS, EXTERNAL_MM_COLUMNS};
use crate::identify::parameters::Selection;
use crate::identify::plan::{Plan as Found, Request, plan_telling};
use crate::identify::plates::plan_plates;
use crate::model::Conditions;
use crate::model::external::Stand;
use crate::model::profile::{Mounted, Profile};
use crate::nearest;
use crate::program::{Settings, Source};
use approach::Stop;
use driving::Driving;
use schemars::JsonSchema;
use serde::Serialize;

/// A program that is asked for.
pub struct Wanted<'a> {
    /// Its file, as findings name it.
    pub name: &'a str,
    /// Its language; `None` is that of the profile.
    pub language: Option<&'a str>,
}

/// The standard deviation that a parameter will have.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Expected {
    /// The parameter.
    pub key: String,
    /// Its standard deviation.
    pub sigma: f64,
    /// The unit of it.
    pub unit: &'static str,
}

/// A parameter that these configurations do not determine.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct NotDetermined {
    /// The parameter.
    pub key: String,
    /// What it cannot be separated from.
    pub confounded_with: Vec<String>,
}

/// Angles at which a plate is measured.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct PlateAngles {
    /// The positioner.
    pub positioner: String,
    /// The columns of its axes in measurements, `e1_deg`, ….
    pub columns: Vec<&'static str>,
    /// The angles at each configuration.
    pub angles_deg: Vec<Vec<f64>>,
}

/// Configurations to measure.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Plan {
    /// How well they show the parameters.
    #[serde(flatten)]
    pub observability: Observability,
    /// Standard deviations to expect.
    pub expected_sigma: Vec<Expected>,
    /// Parameters that stay undetermined.
    pub not_determined: Vec<NotDetermined>,
    /// The controller's joint angles, those given first.
    pub joints_deg: Vec<[f64; 6]>,
    /// Where the axes of a track stand at each, mm.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub track_mm: Vec<Vec<f64>>,
    /// The positioner whose plate is measured, and the angles of its axes at each; then there are
    /// no joint angles.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub plate: Option<PlateAngles>,
    /// Where the tool is at each, in the world, by the controller's model; of a plate, its first
    /// reflector.
    pub places_mm: Vec<[f64; 3]>,
    /// O1 of each start.
    pub starts_o1: Vec<f64>,
    /// Exchanges of the best start.
    pub exchanges: usize,
    /// Part of the random configurations that met the constraints.
    pub admitted: f64,
    /// Standard deviation of a coordinate of the device.
    pub device_sigma_mm: f64,
    /// The files written.
    pub output: Vec<String>,
    /// Poses that the program goes over and that are not measured.
    pub poses_between: usize,
    /// What a person should look at.
    pub findings: Vec<Finding>,
    /// The program's text, where one was asked for.
    #[serde(skip)]
    pub program: Option<String>,
    /// Whether each configuration is approached from below.
    #[serde(skip)]
    pub approached: bool,
    /// The robot and its tool, which the page draws.
    #[serde(skip)]
    pub drawn: (Profile, Mounted),
    /// How the profile is named.
    #[serde(skip)]
    pub name: String,
}

impl Document for Plan {
    const KIND: &'static str = "plan/1";
}

/// Rows of joint angles that are in the set already, radians, and where external axes stand there;
/// nothing without a track.
///
/// # Errors
/// A table without joints, or without a track's places.
pub fn given(source: &Source, profile: &Profile) -> Result<(Vec<[f64; 6]>, Vec<Stand>), Failure> {
    let table = Table::read(source)?;
    table.require(&JOINTS)?;
    let joints = table.rows().map(|row| row.joints());
    let joints = joints.collect::<Result<_, _>>()?;
    let columns = track_columns(&profile.external);
    if columns.is_empty() {
        return Ok((joints, Vec::new()));
    }
    table.require(&columns)?;
    let stands = table.rows().map(|row| stand(profile, &row));
    let stands = stands.collect::<Result<_, _>>()?;
    table.refuse_misspelt()?;
    Ok((joints, stands))
}

/// Chooses configurations by observability; `read` reads meshes, `hear` is called with how many of
/// how many starts are done.
///
/// # Errors
/// Constraints that cannot be met, fewer numbers than parameters, a language that no program is
/// written in.
pub fn plan(
    file: &ProfileFile,
    tool: Option<&str>,
    selection: &Selection,
    request: &Request,
    wanted: Option<&Wanted>,
    read: Reader,
    hear: &mut dyn FnMut(usize, usize),
) -> Result<Plan, Failure> {
    refuse_nonsense(request)?;
    let profile = &file.profile;
    let tool = file.tool(tool)?;
    let driving = Driving::new(file, &tool, &request.constraints, read)?;
    let admits = |q: &[f64; 6]| driving.admits(q);
    let mut found = plan_telling(profile, &tool, selection, request, &admits, hear)
        .map_err(|error| failed(&file.name, &error))?;
    let given = request.given.len();
    let chosen = found.joints.split_off(given);
    let order = driving.order(&chosen);
    found.joints.extend(order.iter().map(|from| chosen[*from]));
    let chosen = found.stands.split_off(given);
    found
        .stands
        .extend(order.iter().map(|from| chosen[*from].clone()));
    let on_track = !profile.external.track.is_empty();
    if let Some(wanted) = wanted.filter(|_| on_track) {
        return Err(Failure::with_hint(
            format!(
                "{}: no program is written that moves external axes",
                wanted.name
            ),
            "leave --program out: the table says where the axes stand at each configuration",
        ));
    }
    let (mut program, mut poses_between, mut findings) = (None, 0, Vec::new());
    if let Some(wanted) = wanted {
        let language = wanted.language.or(profile.language.as_deref());
        let language = language.unwrap_or_default();
        let over = driving.over(&found.joints);
        let stops = found.joints.iter().zip(over);
        let stop = |(q, over): (&[f64; 6], Vec<[f64; 6]>)| Stop {
            over,
            from: driving.approach(q),
            q: *q,
        };
        let stops: Vec<Stop> = stops.map(stop).collect();
        poses_between = stops.iter().map(|stop| stop.over.len()).sum();
        let settings = Settings {
            pulses_per_deg: profile.pulses_per_deg,
            ..Settings::default()
        };
        let text =
            approach::program(language, &stops, &settings).ok_or_else(|| no_program(language))?;
        findings = driving.findings(language, wanted.name, &text, &stops);
        program = Some(text);
    }
    drop(driving);
    let controller = profile.controller_model(&tool);
    let place = |(q, stand): (&[f64; 6], &Stand)| {
        let carried = profile.external.base_nominal(&stand.values);
        let pose = carried * controller.forward(q, &Conditions::default());
        pose.translation.map(mm_from_m)
    };
    let mut track_mm = Vec::new();
    if on_track {
        let each = found
            .stands
            .iter()
            .map(|stand| stand.values.iter().map(|e| decimals(mm_from_m(*e))));
        track_mm.extend(each.map(Iterator::collect));
    }
    let mut plan = of_found(&found, request, (profile, tool, &file.name));
    plan.joints_deg = found.joints.iter().map(|q| q.map(|q| q / DEG)).collect();
    plan.places_mm = found.joints.iter().zip(&found.stands).map(place).collect();
    plan.track_mm = track_mm;
    plan.poses_between = poses_between;
    plan.findings = findings;
    plan.program = program;
    plan.approached = request.constraints.approach_rad > 0.0;
    Ok(plan)
}

/// Chooses angles of a positioner at which reflectors on its plate are measured: roughly there on
/// it, metres, or the profile's points; `hear` as [`plan`].
///
/// # Errors
/// No such positioner, no reflectors, fewer numbers than parameters.
pub fn plan_plate(
    file: &ProfileFile,
    (name, reflectors): (&str, &[[f64; 3]]),
    selection: &Selection,
    request: &Request,
    hear: &mut dyn FnMut(usize, usize),
) -> Result<Plan, Failure> {
    refuse_nonsense(request)?;
    let axes = &file.profile.external;
    let all = &axes.positioners;
    let known = all
        .iter()
        .position(|own| own.name.eq_ignore_ascii_case(name));
    let Some(positioner) = known else {
        let names = all.iter().map(|own| own.name.as_str());
        return Err(Failure::with_hint(
            format!("--plate {name}: the profile has no such positioner"),
            nearest::hint(name, "positioners of the profile", names),
        ));
    };
    let mut heard = |done, of| hear(done, of);
    let found = plan_plates(
        &file.profile,
        positioner,
        reflectors,
        selection,
        request,
        &mut heard,
    )
    .map_err(|error| failed(&file.name, &error))?;
    let own = &all[positioner];
    let range = axes.first_of(positioner)..axes.first_of(positioner) + own.axes.len();
    let listed: Vec<_> = axes.listed().collect();
    let first = reflectors.first().or_else(|| own.points.values().next());
    let first = first.copied().unwrap_or_default();
    let mut plan = of_found(
        &found,
        request,
        (&file.profile, Mounted::flange(), &file.name),
    );
    plan.places_mm = (found.stands.iter())
        .map(|stand| {
            axes.plate(positioner, stand.at(), &[])
                .transform(first)
                .map(mm_from_m)
        })
        .collect();
    plan.plate = Some(PlateAngles {
        positioner: own.name.clone(),
        columns: range.clone().map(|k| column_of(&listed[k], k)).collect(),
        angles_deg: (found.stands.iter())
            .map(|stand| {
                stand.values[range.clone()]
                    .iter()
                    .map(|e| decimals(e / DEG))
                    .collect()
            })
            .collect(),
    });
    Ok(plan)
}

/// What is the same of a plan for an arm and of one for a plate.
fn of_found(
    found: &Found,
    request: &Request,
    (profile, tool, name): (&Profile, Mounted, &str),
) -> Plan {
    Plan {
        observability: (&found.observability).into(),
        expected_sigma: expected(found),
        not_determined: not_determined(found),
        joints_deg: Vec::new(),
        places_mm: Vec::new(),
        track_mm: Vec::new(),
        plate: None,
        starts_o1: found.starts_o1.clone(),
        exchanges: found.exchanges,
        admitted: found.admitted,
        device_sigma_mm: mm_from_m(request.sigma_m),
        output: Vec::new(),
        poses_between: 0,
        findings: Vec::new(),
        program: None,
        approached: false,
        drawn: (profile.clone(), tool),
        name: name.to_owned(),
    }
}

/// A place of an axis without the rounding of its unit.
fn decimals(value: f64) -> f64 {
    (value * 1e6).round() / 1e6
}

/// Numbers within what they can be.
fn refuse_nonsense(request: &Request) -> Result<(), Failure> {
    let constraints = &request.constraints;
    let cone_deg = constraints.sight.map(|(_, cone_rad)| cone_rad / DEG);
    for (option, value, most) in [
        ("--sigma-mm", mm_from_m(request.sigma_m), 1e6),
        ("--cone-deg", cone_deg.unwrap_or(1.0), 180.0),
    ] {
        // a unit and back is a rounding more
        if !(0.999e-9..=most * 1.001).contains(&value) {
            return Err(Failure::new(format!(
                "{option} is {value:e}; it must be greater than 0 (1e-9 or more), and at most \
                 {most:e}"
            )));
        }
    }
    for (option, value) in [
        ("--margin-deg", constraints.margin_rad / DEG),
        ("--approach-deg", constraints.approach_rad / DEG),
    ] {
        if !(0.0..=90.001).contains(&value) {
            // a unit and back is a rounding more
            let value = (value * 1e9).round() / 1e9;
            return Err(Failure::new(format!(
                "{option} is {value}; it must be from 0 to 90"
            )));
        }
    }
    let (count, candidates) = (request.count, request.candidates);
    if count == 0 || candidates < count || candidates > 1_000_000 {
        return Err(Failure::with_hint(
            format!("--count is {count}; it must be from 1 to {candidates}, the --candidates"),
            "--candidates may be from --count to 1000000",
        ));
    }
    Ok(())
}

fn no_program(language: &str) -> Failure {
    let any = Settings {
        pulses_per_deg: Some([1.0; 6]),
        ..Settings::default()
    };
    Failure::with_hint(
        format!("no program can be written in `{language}`"),
        format!(
            "--language is one of: {}; inform needs controller.pulses_per_deg in the profile",
            approach::languages(&any).join(", ")
        ),
    )
}

fn expected(found: &Found) -> Vec<Expected> {
    let kept = found.identifiable.kept.iter().zip(&found.sigma);
    kept.map(|(i, sigma)| {
        let p = &found.parameters[*i];
        Expected {
            key: p.key.clone(),
            sigma: sigma / p.unit.in_si(),
            unit: p.unit.symbol(),
        }
    })
    .collect()
}

fn not_determined(found: &Found) -> Vec<NotDetermined> {
    let key = |i: &usize| found.parameters[*i].key.clone();
    let dropped = &found.identifiable.dropped;
    dropped
        .iter()
        .map(|d| NotDetermined {
            key: key(&d.parameter),
            confounded_with: d.confounded_with.iter().map(key).collect(),
        })
        .collect()
}

impl Plan {
    /// How many configurations.
    #[must_use]
    pub fn count(&self) -> usize {
        self.places_mm.len()
    }

    /// Joint angles and, where each configuration is approached from below, the directions that the
    /// joints arrive in.
    #[must_use]
    pub fn csv(&self) -> String {
        if let Some(plate) = &self.plate {
            let mut table = format!("id,{},on\n", plate.columns.join(","));
            for (angles, n) in plate.angles_deg.iter().zip(1..) {
                let angles: Vec<String> = angles.iter().map(|e| cell(*e)).collect();
                let on = text_cell(&format!("plate:{}", plate.positioner)).into_owned();
                table += &format!("{n},{},{on}\n", angles.join(","));
            }
            return table;
        }
        let mut header = vec!["id"];
        header.extend(JOINTS);
        let axes = self.track_mm.first().map_or(0, Vec::len);
        header.extend(&EXTERNAL_MM_COLUMNS[..axes]);
        header.extend(DIRECTION_COLUMNS.iter().filter(|_| self.approached));
        let mut table = header.join(",") + "\n";
        for (i, q) in self.joints_deg.iter().enumerate() {
            let mut cells = vec![(i + 1).to_string()];
            cells.extend(q.map(cell));
            cells.extend(self.track_mm.get(i).into_iter().flatten().map(|e| cell(*e)));
            cells.extend((0..6).filter(|_| self.approached).map(|_| "1".to_owned()));
            table += &(cells.join(",") + "\n");
        }
        table
    }
}

/// Of too few configurations the hint is this command's own.
fn failed(name: &str, error: &IdentifyError) -> Failure {
    let failure = identify_failure(name, error);
    match error {
        IdentifyError::TooFew { .. } => Failure {
            hint: "plan more configurations (`--count`), or for fewer parameters (`--level 1`)"
                .into(),
            ..failure
        },
        _ => failure,
    }
}

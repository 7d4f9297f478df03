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
use super::table::{JOINTS, Table, cell};
use crate::finding::Finding;
use crate::geometry::units::{DEG, mm_from_m};
use crate::identify::external::track_columns;
use crate::identify::measurements::{DIRECTION_COLUMNS, EXTERNAL_MM_COLUMNS};
use crate::identify::parameters::Selection;
use crate::identify::plan::{Plan as Found, Request, plan_telling};
use crate::model::Conditions;
use crate::model::external::Stand;
use crate::model::profile::{Mounted, Profile};
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
    /// Where the tool is at each, in the world, by the controller's model.
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
    let stands = table.rows().map(|row| stand(profile, &table, &row));
    Ok((joints, stands.collect::<Result<_, _>>()?))
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
        .map_err(|error| identify_failure(&file.name, &error))?;
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
    let approach_rad = request.constraints.approach_rad;
    let (mut program, mut poses_between, mut findings) = (None, 0, Vec::new());
    if let Some(wanted) = wanted {
        let language = wanted.language.or(profile.language.as_deref());
        let language = language.unwrap_or_default();
        let over = driving.over(&found.joints);
        let stops = found.joints.iter().zip(over);
        let stops: Vec<Stop> = stops.map(|(q, over)| Stop { over, q: *q }).collect();
        poses_between = stops.iter().map(|stop| stop.over.len()).sum();
        let settings = Settings {
            pulses_per_deg: profile.pulses_per_deg,
            ..Settings::default()
        };
        let text = approach::program(language, &stops, approach_rad, &settings)
            .ok_or_else(|| no_program(language))?;
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
            .map(|stand| stand.values.iter().map(|e| mm_from_m(*e)));
        track_mm.extend(each.map(Iterator::collect));
    }
    Ok(Plan {
        observability: (&found.observability).into(),
        expected_sigma: expected(&found),
        not_determined: not_determined(&found),
        joints_deg: found.joints.iter().map(|q| q.map(|q| q / DEG)).collect(),
        places_mm: found.joints.iter().zip(&found.stands).map(place).collect(),
        track_mm,
        starts_o1: found.starts_o1,
        exchanges: found.exchanges,
        admitted: found.admitted,
        device_sigma_mm: mm_from_m(request.sigma_m),
        output: Vec::new(),
        poses_between,
        findings,
        program,
        approached: approach_rad > 0.0,
        drawn: (profile.clone(), tool),
        name: file.name.clone(),
    })
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
            return Err(Failure::new(format!(
                "{option} is {value}; it must be from 0 to 90"
            )));
        }
    }
    let (count, candidates) = (request.count, request.candidates);
    if count == 0 || candidates < count || candidates > 1_000_000 {
        return Err(Failure::new(format!(
            "{count} of {candidates} candidates: at least 1, and at most 1000000 to choose from"
        )));
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
    /// Joint angles and, where each configuration is approached from below, the directions that the
    /// joints arrive in.
    #[must_use]
    pub fn csv(&self) -> String {
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

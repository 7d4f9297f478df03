//! JSON Schemas of the files and reports, by name.

use super::{
    Document, axes, calibrate, catalogue, check, compensate, diagnose, explain, fk, handeye,
    hexapod, ik, plan, profile, register, shell, simulate, validate,
};
use crate::check::cell::Cell;
use crate::model::profile::Profile;
use crate::register::frame_file::Frame;
use schemars::JsonSchema;
use schemars::generate::SchemaSettings;
use serde::Serialize;
use serde_json::{Map, Value};

/// A format with a schema.
pub struct Format {
    /// Its name: what stands before the `/` of its first key.
    pub name: &'static str,
    /// Which files or reports have it.
    pub what: &'static str,
    /// Its JSON Schema.
    pub schema: fn() -> Value,
}

const fn format(name: &'static str, what: &'static str, schema: fn() -> Value) -> Format {
    Format { name, what, schema }
}

/// Every format, files before reports.
pub const SCHEMAS: &[Format] = &[
    format("profile", "robot profile (YAML)", Profile::schema),
    format("cell", "cell (YAML)", Cell::schema),
    format("frame", "frame file (YAML)", Frame::schema),
    format(
        "compensation",
        "compensate --json",
        of::<compensate::Compensated>,
    ),
    format(
        "check",
        "check --json, and the baseline that it stores",
        of::<check::Checked>,
    ),
    format(
        "calibration",
        "calibrate --json",
        of::<calibrate::Calibration>,
    ),
    format("validation", "validate --json", of::<validate::Validation>),
    format("diagnosis", "diagnose --json", of::<diagnose::Diagnosis>),
    format("plan", "plan --json", of::<plan::Plan>),
    format("simulation", "simulate --json", of::<simulate::Simulation>),
    format(
        "registration",
        "register --json",
        of::<register::Registration>,
    ),
    format("handeye", "handeye --json", of::<handeye::HandEye>),
    format("hexapod", "hexapod --json", hexapod),
    format("axes", "axes --json", of::<axes::Axes>),
    format("poses", "fk --json", of::<fk::Poses>),
    format("solutions", "ik --json", of::<ik::Solutions>),
    format(
        "new-profile",
        "profile new and profile from-urdf --json",
        new_profile,
    ),
    format(
        "import-ur",
        "profile import-ur --json",
        of::<profile::Imported>,
    ),
    format(
        "changed-profile",
        "profile set, add-tool, add-track, add-positioner, import-moc and import-krc --json",
        of::<profile::Changed>,
    ),
    format(
        "exported-profile",
        "profile export --json",
        of::<profile::Exported>,
    ),
    format("profile-facts", "profile show --json", of::<profile::Facts>),
    format("profile-diff", "profile diff --json", of::<profile::Diff>),
    format("robots", "robots --json", of::<catalogue::Robots>),
    format("effects", "effects --json", of::<catalogue::Effects>),
    format("languages", "languages --json", of::<catalogue::Languages>),
    format("findings", "explain --json", of::<explain::Explanations>),
    format("schemas", "schema --json", of::<Schemas>),
    format(
        "completions",
        "completions --json",
        of::<shell::Completions>,
    ),
    format("manual", "man --json", of::<shell::Manual>),
];

/// Which formats have a schema.
#[derive(Clone, Debug, Serialize, JsonSchema)]
pub struct Schemas {
    /// Files before reports.
    pub schemas: Vec<Named>,
}

/// A format by its name.
#[derive(Clone, Copy, Debug, Serialize, JsonSchema)]
pub struct Named {
    /// What stands before the `/` of its first key.
    pub name: &'static str,
    /// Which files or reports have it.
    pub what: &'static str,
}

impl Document for Schemas {
    const KIND: &'static str = "schemas/1";
}

/// The names of all formats.
#[must_use]
pub fn schemas() -> Schemas {
    let named = SCHEMAS.iter().map(|format| Named {
        name: format.name,
        what: format.what,
    });
    Schemas {
        schemas: named.collect(),
    }
}

/// The JSON Schema of a report, its kind in the first key.
#[must_use]
pub fn schema<D: Document>() -> Value {
    let settings = SchemaSettings::draft2020_12().for_serialize();
    let mut schema = settings
        .into_generator()
        .into_root_schema_for::<D>()
        .to_value();
    schema["title"] = format!("poseshift {}", D::KIND).into();
    let kind = Map::from_iter([("const".to_owned(), Value::from(D::KIND))]);
    let mut properties = Map::from_iter([("poseshift".to_owned(), Value::from(kind))]);
    if let Some(Value::Object(own)) = schema.get_mut("properties").map(Value::take) {
        properties.extend(own);
    }
    schema["properties"] = properties.into();
    let mut required = vec![Value::from("poseshift")];
    if let Some(Value::Array(own)) = schema.get_mut("required").map(Value::take) {
        required.extend(own);
    }
    schema["required"] = required.into();
    schema
}

fn of<D: Document>() -> Value {
    schema::<D>()
}

fn hexapod() -> Value {
    either([
        of::<hexapod::Poses>(),
        of::<hexapod::Base>(),
        of::<hexapod::Reach>(),
    ])
}

fn new_profile() -> Value {
    either([
        of::<profile::NewProfile>(),
        #[cfg(feature = "urdf")]
        of::<profile::FromUrdf>(),
    ])
}

/// One of several documents of a kind.
fn either<const N: usize>(schemas: [Value; N]) -> Value {
    let mut whole = Map::new();
    let mut parts = Map::new();
    for key in ["$schema", "title"] {
        whole.insert(key.into(), schemas[0][key].clone());
    }
    let list = schemas.into_iter().map(|mut schema| {
        if let Some(Value::Object(own)) = schema.get_mut("$defs").map(Value::take) {
            parts.extend(own);
        }
        if let Value::Object(schema) = &mut schema {
            schema.retain(|key, _| !["$schema", "title", "$defs"].contains(&key.as_str()));
        }
        schema
    });
    let list: Vec<Value> = list.collect();
    whole.insert("anyOf".into(), list.into());
    whole.insert("$defs".into(), parts.into());
    whole.into()
}

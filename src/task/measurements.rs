//! Several files of measurements as one, and what the user says of their columns.

use super::failure::Failure;
use super::parts;
use crate::finding::Finding;
use crate::identify::IdentifyError;
use crate::identify::measurements::{MeasurementError, Measurements};
use crate::identify::table::{Euler, Grid, Mapping, Table, Units};
use crate::model::profile::{Profile, Tables, Theirs};
use crate::program::Source;
use crate::program::sha256;
use std::collections::BTreeMap;
use std::sync::Arc;

/// Rows of one or several files, in their order.
#[derive(Clone, Debug)]
pub struct Rows {
    /// The rows.
    pub all: Measurements,
    /// How reports name the files.
    pub name: String,
    /// SHA-256 of each file.
    pub sha256: Vec<String>,
    /// How the files were read, where a person should know it.
    pub findings: Vec<Finding>,
    /// What a profile keeps of how they were read.
    pub tables: Option<Tables>,
}

/// What the user says of the columns of measurements.
#[derive(Clone, Debug, Default)]
pub struct Said {
    /// `name=Their name,…`.
    pub columns: Option<String>,
    /// `m,rad`.
    pub units: Option<String>,
    /// Convention of angles.
    pub euler: Option<String>,
    /// Whether rows are in the order in which the robot drove to them.
    pub in_order: bool,
}

impl Said {
    /// The mapping of this and what a profile keeps.
    fn mapping(&self, profile: &Profile) -> Result<Mapping, Failure> {
        let of = |option: &'static str| {
            move |(message, hint): (String, String)| {
                Failure::with_hint(format!("{option}: {message}"), hint)
            }
        };
        let mut mapping = Mapping::default();
        mapping.driven = self.in_order.then(|| profile.mechanism.clone());
        if let Some(columns) = &self.columns {
            mapping.add_text(columns).map_err(of("--columns"))?;
        }
        if let Some(units) = &self.units {
            mapping.add_units(Units::parse(units.split(',')).map_err(of("--units"))?);
        }
        if let Some(name) = &self.euler {
            mapping.euler = Some((Euler::named(name).map_err(of("--euler"))?, true));
        }
        let kept = &profile.tables;
        let names = |(key, theirs): (&'_ String, &'_ Theirs)| {
            let names = theirs.names().iter();
            names
                .map(|name| (key.clone(), name.clone()))
                .collect::<Vec<_>>()
        };
        let pairs: Vec<(String, String)> = kept.columns.iter().flat_map(names).collect();
        let pairs = pairs
            .iter()
            .map(|(key, name)| (key.as_str(), name.as_str()));
        mapping
            .add(pairs, false)
            .map_err(of("measurement.columns of the profile"))?;
        let units = Units::parse(kept.units.iter().map(String::as_str));
        mapping.add_units(units.map_err(of("measurement.units of the profile"))?);
        if let (None, Some(name)) = (mapping.euler, &kept.euler) {
            let named = Euler::named(name).map_err(of("measurement.euler of the profile"))?;
            mapping.euler = Some((named, false));
        }
        Ok(mapping)
    }

    /// What a profile should keep of it: what was said this time, and what it has.
    fn kept(&self, mapping: &Mapping, profile: &Profile) -> Option<Tables> {
        let said = self.columns.is_some() || self.units.is_some() || self.euler.is_some();
        let (pairs, units) = mapping.kept();
        let mut columns: BTreeMap<String, Theirs> = BTreeMap::new();
        for (key, name) in pairs {
            let own = columns.remove(key);
            let mut names = own.map_or_else(Vec::new, |own| own.names().to_vec());
            names.push(name.to_owned());
            let names = match names.as_slice() {
                [one] => Theirs::One(one.clone()),
                _ => Theirs::Many(names),
            };
            columns.insert(key.to_owned(), names);
        }
        said.then(|| Tables {
            columns,
            units: units.into_iter().map(str::to_owned).collect(),
            euler: self.euler.clone().or_else(|| profile.tables.euler.clone()),
        })
    }
}

/// A fault at its place in one of some files.
fn failure(sources: &[&Source], error: &MeasurementError) -> Failure {
    let source = sources[error.file.min(sources.len() - 1)];
    let length = (error.length > 0).then_some(error.length);
    let place = |source: &Source| {
        let (line, column, message) = (error.line, error.column, error.to_string());
        Failure::at(source, line, column, length, message, error.hint())
    };
    // places are those of the text that was read
    match Grid::read(&source.name, &source.bytes) {
        Ok(grid) if grid.encoding.is_some() => {
            place(&Source::new(source.name.as_str(), grid.text.into_bytes()))
        }
        _ => place(source),
    }
}

fn grid(source: &Source) -> Result<Grid, Failure> {
    Grid::read(&source.name, &source.bytes).map_err(|error| failure(&[source], &error.into()))
}

impl Rows {
    /// Reads the files; rows of several are distinguished by their names and lines.
    ///
    /// # Errors
    /// A row that is no measurement, with line and column; no file; columns that are not known.
    pub fn read(sources: &[Source], said: &Said, profile: &Profile) -> Result<Self, Failure> {
        let mapping = said.mapping(profile)?;
        let mut all: Option<Measurements> = None;
        let mut findings = Vec::new();
        for source in sources {
            let table = Table::of(grid(source)?, &mapping);
            let table = table.map_err(|error| failure(&[source], &error))?;
            let mut read =
                Measurements::from_table(&table).map_err(|error| failure(&[source], &error))?;
            findings.extend(parts::findings(&table.remarks, &source.name));
            if sources.len() > 1 {
                let file: Arc<str> = source.name.as_str().into();
                for row in &mut read.rows {
                    row.id = format!("{file}:{}", row.id);
                    row.line.file = Some(Arc::clone(&file));
                }
            }
            match &mut all {
                None => all = Some(read),
                Some(all) => {
                    all.rows.append(&mut read.rows);
                    all.columns.retain(|column| read.columns.contains(column));
                }
            }
        }
        let names: Vec<&str> = sources.iter().map(|source| source.name.as_str()).collect();
        Ok(Self {
            all: all.ok_or_else(|| Failure::new("no file of measurements"))?,
            name: names.join(", "),
            sha256: sources.iter().map(|source| sha256(&source.bytes)).collect(),
            findings,
            tables: said.kept(&mapping, profile),
        })
    }

    /// Reads joints and points of two files, joined by `id`, else in their order. Lines are those
    /// of the points.
    ///
    /// # Errors
    /// As [`Rows::read`]; rows without a partner.
    pub fn joined(
        joints: &Source,
        points: &Source,
        said: &Said,
        profile: &Profile,
    ) -> Result<Self, Failure> {
        let mapping = said.mapping(profile)?;
        let both = [joints, points];
        let table = Table::joined(grid(joints)?, grid(points)?, &mapping);
        let table = table.map_err(|error| failure(&both, &error))?;
        let all = Measurements::from_table(&table).map_err(|error| failure(&both, &error))?;
        Ok(Self {
            all,
            name: points.name.clone(),
            sha256: both.iter().map(|source| sha256(&source.bytes)).collect(),
            findings: parts::findings(&table.remarks, &points.name),
            tables: said.kept(&mapping, profile),
        })
    }
}

/// A failed identification with its way out.
pub(super) fn identify_failure(name: &str, error: &IdentifyError) -> Failure {
    let several = matches!(error, IdentifyError::Missing { .. }) && name.contains(", ");
    let hint = if several {
        "of several files, each must have the columns that an effect needs".into()
    } else {
        error.hint()
    };
    Failure::with_hint(format!("{name}: {error}"), hint)
}

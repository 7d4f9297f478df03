//! Measurements of one robot ready to be compared with a model of it.

use super::contact::{self, Feature, MOST_VALUES};
use super::error::IdentifyError;
use super::external;
use super::holder::{Holder, Plate};
use super::measurements::{Measurement, Measurements, Observed, numbered};
use super::needs::{check_needs, loaded, refuse_others_axes};
use super::observation::Observation;
use super::parameters::{Parameter, Seen, Selection, Subject, choose};
use super::plates::PlateRows;
use crate::geometry::{Pose, Vector};
use crate::model::effects::{Effect, Need};
use crate::model::external::Stand;
use crate::model::{Conditions, Geometry, Mechanism, Sensitivity, Slot};
use crate::profile::{Mounted, Profile};
use std::collections::BTreeMap;
use std::sync::Arc;

/// The standard deviation of a row that gives none, metres.
pub const DEFAULT_SIGMA_M: f64 = 1e-4;
/// An orientation weighs as much as a position at this distance from the tool, metres.
pub const LEVER_M: f64 = 0.3;
/// Where the measured point of a row is in the tool frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PointRef {
    /// Given, metres.
    Known(Vector),
    /// By index in [`Estimate::points_m`].
    Named(usize),
}

/// One row to compare.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// Index of the measurement.
    pub measurement: usize,
    /// Commanded joint angles, radians.
    pub q: [f64; 6],
    /// What was measured.
    pub observed: Observed,
    /// Index of the tool.
    pub tool: usize,
    /// Where the point is in the tool frame.
    pub point: PointRef,
    /// Direction, force, temperature, time.
    pub conditions: Conditions,
    /// Where external axes stood.
    pub stand: Stand,
    /// Standard deviation of a length, metres.
    pub sigma_m: f64,
    /// Standard deviation of an orientation about an axis, radians.
    pub sigma_rad: f64,
    /// Index of the arm's geometry among [`Problem::rigs`].
    pub rig: usize,
    /// Index of the positioner on whose plate the point is; else it is on the tool.
    pub plate: Option<usize>,
    /// Index of what was touched among [`Problem::features`] and the radius of the probe's ball,
    /// metres.
    pub touched: Option<(usize, f64)>,
}

/// A named point on a tool or a plate.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedPoint {
    /// Its name.
    pub name: String,
    /// Index of the positioner on whose plate it is; else it is on the tool.
    pub plate: Option<usize>,
    /// Whether its coordinates are given.
    pub known: bool,
}

/// Values of everything that may be identified.
#[derive(Clone, Debug, PartialEq)]
pub struct Estimate {
    /// Where the base stands, without its `base_frame` effect.
    pub world_from_base: Pose,
    /// Effects with their parameters.
    pub effects: Vec<Effect>,
    /// Coordinates of the named points in the tool frame, metres.
    pub points_m: Vec<Vector>,
    /// Numbers of each feature in [`Problem::features`], metres and radians.
    pub features: Vec<[f64; MOST_VALUES]>,
}

impl Estimate {
    /// The value of a parameter in SI units.
    #[must_use]
    pub fn value(&self, subject: Subject) -> f64 {
        match subject {
            Subject::Effect(slot) => self.effects[slot.effect].parameters[slot.parameter],
            Subject::Point { point, axis } => self.points_m[point][axis],
            Subject::Feature { feature, value } => self.features[feature][value],
        }
    }

    /// The place of that value.
    pub fn value_mut(&mut self, subject: Subject) -> &mut f64 {
        match subject {
            Subject::Effect(slot) => &mut self.effects[slot.effect].parameters[slot.parameter],
            Subject::Point { point, axis } => &mut self.points_m[point][axis],
            Subject::Feature { feature, value } => &mut self.features[feature][value],
        }
    }
}

/// Which arm a row is measured with: rows with the same tool, the base carried to the same place,
/// and the same temperature and time where these matter.
#[derive(Clone, Debug, PartialEq)]
pub struct Rig {
    /// Index of the tool.
    pub tool: usize,
    /// Conditions that change the geometry.
    pub conditions: Conditions,
    /// Where external axes stand that carry the base, or the plate.
    pub stand: Stand,
    /// Index of the positioner on whose plate the points are, where they are not on the tool.
    pub plate: Option<usize>,
}

/// Measurements of one robot, its effects, and which parameters are identified.
#[derive(Clone, Debug)]
pub struct Problem {
    /// The robot.
    pub profile: Profile,
    /// Its tools in use.
    pub tools: Vec<Mounted>,
    /// Named points.
    pub points: Vec<NamedPoint>,
    /// What the probe touched and is not wholly known.
    pub features: Vec<Feature>,
    /// Rows to compare.
    pub rows: Arc<Vec<Row>>,
    /// Geometries in use.
    pub rigs: Vec<Rig>,
    /// What is identified, in the order in which parameters are kept.
    pub parameters: Vec<Parameter>,
    /// Whether some row has no standard deviation of its own.
    pub sigma_assumed: bool,
    /// Whether the estimated base stands in the frame of a device that may be tilted: gravity is
    /// then along the axes of the base as the profile has them, wherever the device sees the
    /// base; so is the track that carries it.
    pub gravity_by_base: bool,
}

pub(super) fn tool_of(profile: &Profile, row: &Measurement) -> Result<Mounted, IdentifyError> {
    let known = || profile.tools.keys().cloned().collect::<Vec<_>>();
    match &row.tool {
        Some(name) => profile
            .tool(name)
            .ok_or_else(|| IdentifyError::UnknownTool {
                line: row.line.clone(),
                tool: name.clone(),
                known: known(),
            }),
        None => match profile.tools.len() {
            0 => Ok(Mounted::flange()),
            1 => Ok(profile.tool(&known()[0]).expect("a key of the map")),
            _ => Err(IdentifyError::AmbiguousTool {
                line: row.line.clone(),
                known: known(),
            }),
        },
    }
}

/// The named points of the measurements with their coordinates, where the rows or the profile give
/// them.
fn named_points(
    profile: &Profile,
    measurements: &Measurements,
    free: bool,
) -> (Vec<NamedPoint>, Vec<Vector>) {
    let mut found: BTreeMap<&str, Option<Vector>> = BTreeMap::new();
    for row in &measurements.rows {
        if let Some(name) = &row.point {
            let known = found.entry(name).or_insert(None);
            *known = known.or(row.point_in_tool_m);
        }
    }
    let (mut points, mut coordinates) = (Vec::new(), Vec::new());
    for (name, given) in found {
        let known = given.or_else(|| profile.points.get(name).copied());
        points.push(NamedPoint {
            name: name.to_owned(),
            plate: None,
            known: known.is_some() && !free,
        });
        coordinates.push(known.unwrap_or_default());
    }
    (points, coordinates)
}

impl Problem {
    /// Makes rows of measurements and chooses what is identified. The second value is where to
    /// start: the profile's own values, with the base at `world_from_base`.
    ///
    /// # Errors
    /// Unknown tools; an effect asked for that lacks a column or masses; no parameter.
    #[allow(
        clippy::missing_panics_doc,
        reason = "what is expected holds by construction"
    )]
    pub fn new(
        profile: &Profile,
        measurements: &Measurements,
        selection: &Selection,
        world_from_base: Pose,
    ) -> Result<(Self, Estimate), IdentifyError> {
        // what the controller knows of its own arm stays where nothing better is found
        let profile = &Profile {
            effects: profile.real_effects(),
            ..profile.clone()
        };
        let (points, points_m) = named_points(profile, measurements, selection.wants_points());
        let features = contact::gather(&measurements.rows)?;
        let mut tools: Vec<Mounted> = Vec::new();
        let mut rows = Vec::with_capacity(measurements.rows.len());
        let mut sigma_assumed = false;
        for (index, m) in measurements.rows.iter().enumerate() {
            let tool = tool_of(profile, m)?;
            let known = tools.iter().position(|t| t.name == tool.name);
            let tool = known.unwrap_or_else(|| {
                tools.push(tool);
                tools.len() - 1
            });
            let at = m.point.as_ref().map(|name| {
                let at = points.iter().position(|p| p.name == *name);
                at.expect("every name was gathered")
            });
            let named = at.map(PointRef::Named);
            sigma_assumed |= m.sigma_m.is_none();
            let sigma_m = m.sigma_m.unwrap_or(DEFAULT_SIGMA_M);
            rows.push(Row {
                measurement: index,
                q: m.q,
                observed: m.observed,
                tool,
                point: named.unwrap_or(PointRef::Known(m.point_in_tool_m.unwrap_or_default())),
                conditions: Conditions {
                    row: u32::try_from(index + 1).ok(),
                    point: at.and_then(|at| u32::try_from(at).ok()),
                    rows: u32::try_from(measurements.rows.len()).unwrap_or(u32::MAX),
                    ..m.conditions
                },
                stand: m.stand.clone(),
                sigma_m,
                sigma_rad: m.sigma_rad.unwrap_or(sigma_m / LEVER_M),
                rig: 0,
                plate: None,
                touched: m.contact.as_ref().and_then(|contact| {
                    let at = features.iter().position(|f| f.name == contact.feature);
                    at.map(|at| (at, contact.probe_radius_m))
                }),
            });
        }
        let mut placed = profile.clone();
        placed.world_from_base = world_from_base;
        // about a single point of it a tool may be turned as it likes
        let turning = |tool: usize| {
            let own = || rows.iter().filter(|row| row.tool == tool);
            let has_pose = own().any(|row| matches!(row.observed, Observed::Pose(_)));
            let first = own().next().map(|row| row.point);
            has_pose || own().any(|row| Some(row.point) != first)
        };
        let all_points_unknown = rows.iter().all(|row| match row.point {
            PointRef::Named(i) => !points[i].known,
            PointRef::Known(_) => false,
        });
        let pose = rows
            .iter()
            .any(|row| matches!(row.observed, Observed::Pose(_)));
        let temperatures = || rows.iter().filter_map(|row| row.conditions.temperature_c);
        let warm = temperatures().count();
        let seen = Seen {
            mean_c: (warm > 0).then(|| temperatures().sum::<f64>() / warm as f64),
            tools: tools
                .iter()
                .enumerate()
                .map(|(i, tool)| (tool.name.clone(), turning(i)))
                .collect(),
            tool_frame: !all_points_unknown || pose,
            unknown_points: points
                .iter()
                .enumerate()
                .filter(|(_, p)| !p.known)
                .map(|(i, p)| (i, p.name.clone()))
                .collect(),
            loaded: loaded(&placed, &tools, &rows, true),
            features: contact::parameters(&features),
            places: external::places(&profile.external, measurements),
        };
        refuse_others_axes(profile, measurements, &selection.identify)?;
        let (effects, parameters) = choose(profile, selection, &seen);
        if parameters.is_empty() {
            return Err(IdentifyError::NoParameters);
        }
        let mut problem = Self {
            profile: profile.clone(),
            tools,
            points,
            features,
            rows: Arc::new(rows),
            rigs: Vec::new(),
            parameters,
            sigma_assumed,
            gravity_by_base: false,
        };
        check_needs(&problem, measurements, &effects, selection)?;
        problem.sort_rigs(&effects);
        let mut start = Estimate {
            world_from_base,
            effects,
            points_m,
            features: vec![[0.0; MOST_VALUES]; problem.features.len()],
        };
        contact::start(&mut problem, &mut start)?;
        Ok((problem, start))
    }

    /// As [`Problem::new`], of points on plates alone, in the controller's world: what is
    /// identified is of their positioners. `of` says what the measurements show of them.
    pub(super) fn on_plates(
        profile: &Profile,
        measurements: &Measurements,
        selection: &Selection,
        of: PlateRows,
    ) -> (Self, Estimate) {
        let (effects, parameters) = of.choose(profile, selection);
        let rows = measurements.rows.iter().enumerate();
        let rows = rows.zip(&of.rows).map(|((index, m), (plate, point))| {
            let sigma_m = m.sigma_m.unwrap_or(DEFAULT_SIGMA_M);
            Row {
                measurement: index,
                q: m.q,
                observed: m.observed,
                tool: 0,
                point: *point,
                conditions: m.conditions,
                stand: m.stand.clone(),
                sigma_m,
                sigma_rad: m.sigma_rad.unwrap_or(sigma_m / LEVER_M),
                rig: 0,
                plate: Some(*plate),
                touched: None,
            }
        });
        let mut problem = Self {
            profile: profile.clone(),
            tools: vec![Mounted::flange()],
            rows: Arc::new(rows.collect()),
            points: of.points,
            features: Vec::new(),
            rigs: Vec::new(),
            parameters,
            sigma_assumed: measurements.rows.iter().any(|m| m.sigma_m.is_none()),
            gravity_by_base: false,
        };
        problem.sort_rigs(&effects);
        let start = Estimate {
            world_from_base: profile.world_from_base,
            effects,
            points_m: of.points_m,
            features: Vec::new(),
        };
        (problem, start)
    }

    /// Gives every row its geometry; one a tool unless an effect changes the geometry with the
    /// row's conditions.
    pub fn sort_rigs(&mut self, effects: &[Effect]) {
        let plain = |need: &Need| {
            matches!(
                need,
                Need::Masses | Need::Directions | Need::ExternalDirections
            )
        };
        let varies = effects.iter().any(|effect| {
            let definition = effect.definition();
            !definition.deflects && !definition.needs.iter().all(plain)
        });
        self.rigs.clear();
        let on_track = !self.profile.external.track.is_empty();
        let mut known = BTreeMap::new();
        let mut rig_of = |row: &Row| {
            let conditions = if varies {
                Conditions {
                    temperature_c: row.conditions.temperature_c,
                    time_s: row.conditions.time_s,
                    ..Conditions::default()
                }
            } else {
                Conditions::default()
            };
            let bits = |value: Option<f64>| value.map_or(u64::MAX, f64::to_bits);
            let key = (
                (row.tool, row.plate),
                bits(conditions.temperature_c),
                bits(conditions.time_s),
                if on_track || row.plate.is_some() {
                    row.stand.bits()
                } else {
                    Vec::new()
                },
            );
            *known.entry(key).or_insert_with(|| {
                self.rigs.push(Rig {
                    tool: row.tool,
                    conditions,
                    stand: row.stand.clone(),
                    plate: row.plate,
                });
                self.rigs.len() - 1
            })
        };
        let found: Vec<usize> = self.rows.iter().map(&mut rig_of).collect();
        // rows that others have, too, stay theirs
        if self
            .rows
            .iter()
            .zip(&found)
            .any(|(row, rig)| row.rig != *rig)
        {
            for (row, rig) in Arc::make_mut(&mut self.rows).iter_mut().zip(found) {
                row.rig = rig;
            }
        }
    }

    /// How the controller counts joints.
    #[must_use]
    pub fn mechanism(&self) -> &Mechanism {
        &self.profile.mechanism
    }

    /// What holds the points of every rig with the derivatives by these parameters; only effects
    /// count, points need none.
    #[must_use]
    pub fn models(&self, estimate: &Estimate, parameters: &[Parameter]) -> Vec<Holder> {
        let slots: Vec<Slot> = parameters
            .iter()
            .filter_map(|p| match p.subject {
                Subject::Effect(slot) => Some(slot),
                Subject::Point { .. } | Subject::Feature { .. } => None,
            })
            .collect();
        let real = self.profile.world_from_real_base().rotation.transpose();
        let tilt = (self.gravity_by_base).then(|| estimate.world_from_base.rotation * real);
        self.rigs
            .iter()
            .map(|rig| {
                if let Some(positioner) = rig.plate {
                    let on = (positioner, &rig.stand);
                    let axes = &self.profile.external;
                    return Holder::Plate(Plate::of(axes, on, estimate, &slots));
                }
                let mut geometry = Geometry {
                    world_from_base: estimate.world_from_base,
                    carried: self.profile.carried(&rig.stand, self.gravity_by_base),
                    ..self.profile.geometry(&self.tools[rig.tool])
                };
                if let Some(tilt) = tilt {
                    geometry.gravity_m_s2 = tilt * geometry.gravity_m_s2;
                }
                Holder::Arm(Box::new(Sensitivity::build(
                    &geometry,
                    &self.profile.mechanism,
                    &estimate.effects,
                    &slots,
                    &rig.conditions,
                )))
            })
            .collect()
    }

    /// The measured point of a row in the tool frame, metres.
    #[must_use]
    pub fn point_in_tool_m(&self, estimate: &Estimate, row: &Row) -> Vector {
        match row.point {
            PointRef::Known(point) => point,
            PointRef::Named(index) => estimate.points_m[index],
        }
    }

    /// What the model with its tool at this pose expects of a row.
    #[must_use]
    pub fn observe<'a>(
        &self,
        estimate: &Estimate,
        row: &'a Row,
        world_from_tool: Pose,
    ) -> Observation<'a> {
        let point = self.point_in_tool_m(estimate, row);
        let mut seen = Observation::new(row, world_from_tool, point);
        if matches!(row.observed, Observed::Contact(_)) {
            seen.touch(self.touch(estimate, row, seen.expected_m()));
        }
        seen
    }

    /// How many numbers were measured.
    #[must_use]
    pub fn numbers(&self) -> usize {
        self.rows.iter().map(|row| row.observed.count()).sum()
    }

    /// How many configurations the rows have.
    #[must_use]
    pub fn configurations(&self) -> usize {
        let numbers = numbered(self.rows.iter().map(|row| (&row.q, &row.stand)));
        numbers.iter().max().map_or(0, |last| last + 1)
    }

    /// How many numbers were measured in different ways: what is repeated tells of the noise, not
    /// of the arm.
    #[must_use]
    pub fn distinct_numbers(&self) -> usize {
        let mut known = std::collections::HashSet::new();
        let each = self.rows.iter().map(|row| {
            let c = &row.conditions;
            let from = match row.observed {
                Observed::Distance { from_m, .. } => from_m,
                _ => [0.0; 3],
            };
            let other = [c.temperature_c, c.time_s].map(|x| x.unwrap_or(0.0));
            let numbers = row.q.iter().chain(&c.direction).chain(&c.force_n);
            let key: Vec<u64> = numbers
                .chain(&other)
                .chain(&from)
                .chain(&row.stand.values)
                .chain(&row.stand.directions)
                .map(|x| x.to_bits())
                .collect();
            let point = match row.point {
                PointRef::Known(p) => p.map(f64::to_bits),
                PointRef::Named(point) => [point as u64, 0, 0],
            };
            let is_new = known.insert((key, row.tool, point, row.touched.map(|(at, _)| at)));
            if is_new || row.touched.is_some() {
                row.observed.count()
            } else {
                0
            }
        });
        each.sum()
    }

    /// The same problem with some of its rows.
    #[must_use]
    pub fn with_rows(&self, keep: impl Fn(usize) -> bool) -> Self {
        let mut other = self.clone();
        if !(0..self.rows.len()).all(&keep) {
            let kept = self.rows.iter().enumerate().filter(|(i, _)| keep(*i));
            other.rows = Arc::new(kept.map(|(_, row)| row.clone()).collect());
        }
        other
    }
}

//! Contacts of a probe's ball with spheres, planes and points: closed-loop measurements, whose
//! features may be unknown.
//!
//! The measured point of the row is the centre of the ball. With `p` where it is expected, `r` the
//! ball's radius: a sphere (centre `c`, radius `R`) leaves `R + r − |p − c|`; a plane (normal `n`,
//! point `a`, offset `d`) `d + r − n·(p − a)`; a repeated point `c − p`.
//!
//! # Source
//! The loop closed by a constraint instead of a measuring device: J. M. Hollerbach, C. W. Wampler,
//! "The calibration index and taxonomy for robot kinematic calibration methods" (1996).

use super::error::IdentifyError;
use super::line::Line;
use super::measurements::{Measurement, Observed};
use super::parameters::{Parameter, Subject};
use super::problem::{Estimate, Problem, Row};
use crate::geometry::{Vector, add, cross, dot, norm, scale, sub};
use crate::model::Motion;
use crate::model::effects::Unit;
use crate::register::features::{plane, sphere};

/// Most numbers a feature has.
pub const MOST_VALUES: usize = 4;
/// How far a feature's place may be from where its touches put it at first, metres.
const PLACE_SIGMA_M: f64 = 0.01;
/// The same of the normal of a plane, radians.
const TILT_SIGMA_RAD: f64 = 0.01;

/// What is touched.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ContactKind {
    /// A sphere from outside.
    Sphere,
    /// A plane from the side its normal points to.
    Plane,
    /// A point in which the ball sits: the same place again with other joint angles.
    Point,
}

impl ContactKind {
    /// All kinds.
    pub const ALL: [Self; 3] = [Self::Sphere, Self::Plane, Self::Point];

    /// Its name in the column `contact`.
    #[must_use]
    pub const fn id(self) -> &'static str {
        match self {
            Self::Sphere => "sphere",
            Self::Plane => "plane",
            Self::Point => "point",
        }
    }

    /// How many numbers a contact gives.
    #[must_use]
    pub const fn count(self) -> usize {
        match self {
            Self::Sphere | Self::Plane => 1,
            Self::Point => 3,
        }
    }

    /// Names, units and typical sizes of its numbers.
    const fn values(self) -> &'static [(&'static str, Unit, f64)] {
        const PLACE: f64 = PLACE_SIGMA_M;
        match self {
            Self::Sphere => &[
                ("x_mm", Unit::Millimetre, PLACE),
                ("y_mm", Unit::Millimetre, PLACE),
                ("z_mm", Unit::Millimetre, PLACE),
                ("radius_mm", Unit::Millimetre, PLACE),
            ],
            Self::Plane => &[
                ("offset_mm", Unit::Millimetre, PLACE),
                ("tilt1_deg", Unit::Degree, TILT_SIGMA_RAD),
                ("tilt2_deg", Unit::Degree, TILT_SIGMA_RAD),
            ],
            Self::Point => &[
                ("x_mm", Unit::Millimetre, PLACE),
                ("y_mm", Unit::Millimetre, PLACE),
                ("z_mm", Unit::Millimetre, PLACE),
            ],
        }
    }
}

/// The contact of a row.
#[derive(Clone, Debug, PartialEq)]
pub struct Contact {
    /// Name of what is touched.
    pub feature: String,
    /// What it is.
    pub kind: ContactKind,
    /// Centre of the sphere, a point of the plane, or the point, in the world, metres; none: to be
    /// identified.
    pub centre_m: Option<Vector>,
    /// Radius of the sphere, metres; none: to be identified.
    pub radius_m: Option<f64>,
    /// Outward unit normal of the plane; none: to be identified.
    pub normal: Option<Vector>,
    /// Radius of the probe's ball, metres; its centre is the measured point.
    pub probe_radius_m: f64,
}

impl Contact {
    /// What is compared: a known sphere is a distance, a known point a position.
    #[must_use]
    pub fn observed(&self) -> Observed {
        match (self.kind, self.centre_m, self.radius_m) {
            (ContactKind::Sphere, Some(from_m), Some(radius_m)) => Observed::Distance {
                distance_m: radius_m + self.probe_radius_m,
                from_m,
            },
            (ContactKind::Point, Some(place), _) => Observed::Position(place),
            _ => Observed::Contact(self.kind),
        }
    }
}

/// Two contacts that say different things of one feature.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Conflict {
    /// Name of the feature.
    pub feature: String,
    /// Line of the later row.
    pub line: usize,
    /// Line of the earlier row.
    pub earlier: usize,
}

fn merged<T: Copy + PartialEq>(known: &mut Option<T>, given: Option<T>) -> bool {
    match (*known, given) {
        (Some(a), Some(b)) => a == b,
        (None, Some(b)) => {
            *known = Some(b);
            true
        }
        _ => true,
    }
}

/// Numbers of a feature that stand in some rows hold in all, and settles what is compared.
///
/// # Errors
/// Rows that contradict each other.
pub fn settle(rows: &mut [Measurement]) -> Result<(), Conflict> {
    let mut known: Vec<(usize, Contact)> = Vec::new();
    for row in rows.iter() {
        let Some(contact) = &row.contact else {
            continue;
        };
        let Some((earlier, all)) = known.iter_mut().find(|(_, k)| k.feature == contact.feature)
        else {
            known.push((row.line.number, contact.clone()));
            continue;
        };
        let agrees = all.kind == contact.kind
            && merged(&mut all.centre_m, contact.centre_m)
            && merged(&mut all.radius_m, contact.radius_m)
            && merged(&mut all.normal, contact.normal);
        if !agrees {
            return Err(Conflict {
                feature: contact.feature.clone(),
                line: row.line.number,
                earlier: *earlier,
            });
        }
    }
    for row in rows {
        if let Some(contact) = &mut row.contact {
            let same = known.iter().find(|(_, k)| k.feature == contact.feature);
            if let Some((_, all)) = same {
                contact.centre_m = all.centre_m;
                contact.radius_m = all.radius_m;
                contact.normal = all.normal;
            }
            row.observed = contact.observed();
        }
    }
    Ok(())
}

/// Something touched of which not all is known, with the frame in which its numbers are counted.
#[derive(Clone, Debug, PartialEq)]
pub struct Feature {
    /// Its name.
    pub name: String,
    /// What it is.
    pub kind: ContactKind,
    /// Which of its numbers are given: x, y, z, radius of a sphere; offset and two tilts of a
    /// plane; x, y, z of a point.
    pub known: [bool; MOST_VALUES],
    /// What was given.
    pub given: Contact,
    /// A point of the plane, metres.
    pub origin_m: Vector,
    /// Normal of the plane at no tilt, and the two directions in which it tilts.
    pub axes: [Vector; 3],
    /// Its first row.
    pub line: Line,
}

/// Where a feature is, in the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fitted {
    /// Centre of a sphere, a point of a plane, or the point, metres.
    pub centre_m: Vector,
    /// Radius of a sphere, metres.
    pub radius_m: Option<f64>,
    /// Outward unit normal of a plane.
    pub normal: Option<Vector>,
}

/// Two unit vectors that make a right-handed frame with a unit normal.
fn frame(normal: Vector) -> [Vector; 3] {
    let least = (0..3)
        .min_by(|a, b| normal[*a].abs().total_cmp(&normal[*b].abs()))
        .unwrap_or(0);
    let axis = std::array::from_fn(|i| f64::from(u8::from(i == least)));
    let first = cross(normal, axis);
    let first = scale(1.0 / norm(first), first);
    [normal, first, cross(normal, first)]
}

impl Feature {
    fn new(contact: &Contact, line: &Line) -> Self {
        let (centre, radius, normal) = (
            contact.centre_m.is_some(),
            contact.radius_m.is_some(),
            contact.normal.is_some(),
        );
        Self {
            name: contact.feature.clone(),
            kind: contact.kind,
            known: match contact.kind {
                ContactKind::Sphere => [centre, centre, centre, radius],
                ContactKind::Plane => [centre, normal, normal, true],
                ContactKind::Point => [centre, centre, centre, true],
            },
            given: contact.clone(),
            origin_m: contact.centre_m.unwrap_or_default(),
            axes: frame(contact.normal.unwrap_or([0.0, 0.0, 1.0])),
            line: line.clone(),
        }
    }

    /// How many numbers are to be identified.
    #[must_use]
    pub fn unknowns(&self) -> usize {
        let all = self.kind.values().len();
        self.known[..all].iter().filter(|known| !**known).count()
    }

    /// The normal of a plane with these numbers before it is normalised.
    fn tilted(&self, values: &[f64; MOST_VALUES]) -> Vector {
        let [normal, first, second] = self.axes;
        add(
            normal,
            add(scale(values[1], first), scale(values[2], second)),
        )
    }

    /// Where it is with these numbers.
    #[must_use]
    pub fn place(&self, values: &[f64; MOST_VALUES]) -> Fitted {
        let [x, y, z, radius] = *values;
        match self.kind {
            ContactKind::Plane => {
                let long = self.tilted(values);
                let normal = scale(1.0 / norm(long), long);
                Fitted {
                    centre_m: add(self.origin_m, scale(values[0], normal)),
                    radius_m: None,
                    normal: Some(normal),
                }
            }
            kind => Fitted {
                centre_m: [x, y, z],
                radius_m: (kind == ContactKind::Sphere).then_some(radius),
                normal: None,
            },
        }
    }

    /// The numbers that put it there: the inverse of [`Feature::place`].
    #[must_use]
    pub fn numbers_of(&self, place: &Fitted) -> [f64; MOST_VALUES] {
        let [x, y, z] = place.centre_m;
        let radius = place.radius_m.unwrap_or_default();
        let Some(normal) = place.normal else {
            return [x, y, z, radius];
        };
        let [upright, first, second] = self.axes.map(|axis| dot(normal, axis));
        let offset = dot(normal, sub(place.centre_m, self.origin_m));
        [offset, first / upright, second / upright, 0.0]
    }

    /// A first guess from where the ball is believed at its touches.
    fn start(&mut self, balls_m: &[Vector]) -> Result<[f64; MOST_VALUES], String> {
        let probe = self.given.probe_radius_m;
        let count = balls_m.len() as f64;
        let sum = balls_m.iter().fold([0.0; 3], |sum, p| add(sum, *p));
        let middle = scale(1.0 / count, sum);
        match self.kind {
            ContactKind::Point => {
                let [x, y, z] = self.given.centre_m.unwrap_or(middle);
                Ok([x, y, z, 0.0])
            }
            ContactKind::Sphere => {
                let centre = match self.given.centre_m {
                    Some(centre) => centre,
                    None => sphere(balls_m).map_err(|e| e.to_string())?.centre_m,
                };
                let far: f64 = balls_m.iter().map(|p| norm(sub(*p, centre))).sum();
                let [x, y, z] = centre;
                let radius = self.given.radius_m.unwrap_or(far / count - probe);
                Ok([x, y, z, radius])
            }
            ContactKind::Plane => {
                let normal = match self.given.normal {
                    Some(normal) => normal,
                    None => plane(balls_m).map_err(|e| e.to_string())?.normal,
                };
                // the side on which the balls are; of an unknown plane the side of the world's
                // origin
                let height = match self.given.centre_m {
                    Some(point) => dot(normal, sub(middle, point)),
                    None => -dot(normal, middle),
                };
                let flip = self.given.normal.is_none() && height < 0.0;
                self.axes = frame(scale(if flip { -1.0 } else { 1.0 }, normal));
                self.origin_m = self.given.centre_m.unwrap_or(middle);
                let offset = if self.given.centre_m.is_some() {
                    0.0
                } else {
                    -probe
                };
                Ok([offset, 0.0, 0.0, 0.0])
            }
        }
    }

    /// Residual and derivatives of a contact with the ball's centre at `ball_m`.
    pub(super) fn touch(
        &self,
        values: &[f64; MOST_VALUES],
        probe_radius_m: f64,
        ball_m: Vector,
    ) -> Touch {
        let [x, y, z, radius] = *values;
        match self.kind {
            ContactKind::Point => Touch {
                gap: sub([x, y, z], ball_m),
                ..Touch::default()
            },
            ContactKind::Sphere => {
                let away = sub(ball_m, [x, y, z]);
                let length = norm(away);
                let toward = scale(1.0 / length.max(f64::MIN_POSITIVE), away);
                Touch {
                    gap: [radius + probe_radius_m - length, 0.0, 0.0],
                    toward,
                    by_feature: [-toward[0], -toward[1], -toward[2], -1.0],
                }
            }
            ContactKind::Plane => {
                let long = self.tilted(values);
                let length = norm(long);
                let normal = scale(1.0 / length, long);
                let at = sub(ball_m, self.origin_m);
                let height = dot(normal, at);
                let by_tilt = |axis: Vector| (dot(axis, at) - dot(axis, normal) * height) / length;
                Touch {
                    gap: [values[0] + probe_radius_m - height, 0.0, 0.0],
                    toward: normal,
                    by_feature: [-1.0, by_tilt(self.axes[1]), by_tilt(self.axes[2]), 0.0],
                }
            }
        }
    }
}

/// What a contact leaves and what changes it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Touch {
    /// Residual; three numbers of a point, else the first.
    pub gap: Vector,
    /// Direction in which a shift of the ball counts; of no use for a point.
    pub toward: Vector,
    /// What the numbers of the feature do to the expectation.
    pub by_feature: [f64; MOST_VALUES],
}

/// The features of rows that are not wholly known, and the index of each row's.
pub(super) fn gather(rows: &[Measurement]) -> Result<Vec<Feature>, IdentifyError> {
    let mut features: Vec<Feature> = Vec::new();
    for row in rows {
        let (Some(contact), Observed::Contact(_)) = (&row.contact, row.observed) else {
            continue;
        };
        match features.iter().find(|f| f.name == contact.feature) {
            None => features.push(Feature::new(contact, &row.line)),
            Some(feature) => {
                let same = Feature::new(contact, &row.line);
                if same.known != feature.known || same.kind != feature.kind {
                    return Err(IdentifyError::Feature {
                        line: row.line.clone(),
                        feature: contact.feature.clone(),
                        reason: format!("{} says something else of it", feature.line),
                    });
                }
            }
        }
    }
    Ok(features)
}

/// The parameters of the unknown features. They come first: where nothing known is touched the base
/// is what stays.
pub(super) fn parameters(features: &[Feature]) -> Vec<Parameter> {
    let mut all = Vec::new();
    for (index, feature) in features.iter().enumerate() {
        for (value, (key, unit, size)) in feature.kind.values().iter().enumerate() {
            if feature.known[value] {
                continue;
            }
            all.push(Parameter {
                key: format!("{} {} {key}", feature.kind.id(), feature.name),
                subject: Subject::Feature {
                    feature: index,
                    value,
                },
                unit: *unit,
                scale: *size,
                rank: 0,
                prior: None,
                asked: false,
            });
        }
    }
    all
}

/// Sets the unknown features to where the model puts their touches.
///
/// # Errors
/// Too few touches, or touches that do not tell the feature.
pub(super) fn start(problem: &mut Problem, estimate: &mut Estimate) -> Result<(), IdentifyError> {
    if problem.features.is_empty() {
        return Ok(());
    }
    let models = problem.models(estimate, &[]);
    let mut none: [Motion; 0] = [];
    let mut balls: Vec<Vec<Vector>> = vec![Vec::new(); problem.features.len()];
    for row in problem.rows.iter() {
        if let (Observed::Contact(_), Some((feature, _))) = (row.observed, row.touched) {
            let pose = models[row.rig].evaluate(&row.q, &row.conditions, &mut none);
            balls[feature].push(pose.transform(problem.point_in_tool_m(estimate, row)));
        }
    }
    for (index, feature) in problem.features.iter_mut().enumerate() {
        let fault = |line: &Line, name: &str, reason| IdentifyError::Feature {
            line: line.clone(),
            feature: name.to_owned(),
            reason,
        };
        let (numbers, unknown) = (
            balls[index].len() * feature.kind.count(),
            feature.unknowns(),
        );
        if numbers <= unknown {
            let reason = format!(
                "{} touches give {numbers} numbers for {unknown} unknown ones; {} are needed",
                balls[index].len(),
                unknown / feature.kind.count() + 1
            );
            return Err(fault(&feature.line, &feature.name, reason));
        }
        let (line, name) = (feature.line.clone(), feature.name.clone());
        estimate.features[index] = feature
            .start(&balls[index])
            .map_err(|reason| fault(&line, &name, reason))?;
    }
    Ok(())
}

/// The same features in rows of another purpose, as they were found.
///
/// # Errors
/// A feature that no row for the fit touched.
pub(super) fn carry(
    found: (&Problem, &Estimate),
    problem: &mut Problem,
    estimate: &mut Estimate,
) -> Result<(), IdentifyError> {
    for (index, feature) in problem.features.iter_mut().enumerate() {
        let same = found.0.features.iter().position(|f| f.name == feature.name);
        let same = same.ok_or_else(|| IdentifyError::Feature {
            line: feature.line.clone(),
            feature: feature.name.clone(),
            reason: "no row for the fit touches it: its place is unknown".into(),
        })?;
        feature.clone_from(&found.0.features[same]);
        estimate.features[index] = found.1.features[same];
    }
    Ok(())
}

impl Problem {
    /// What the row's contact leaves with the ball's centre here; nothing of a row without contact.
    pub(super) fn touch(&self, estimate: &Estimate, row: &Row, ball_m: Vector) -> Touch {
        match row.touched {
            Some((feature, probe_radius_m)) => {
                self.features[feature].touch(&estimate.features[feature], probe_radius_m, ball_m)
            }
            None => Touch::default(),
        }
    }
}

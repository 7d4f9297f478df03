//! What reports of several commands have in common: poses, statistics, uncertainties in the units
//! of files.

use crate::finding::{Finding, Severity};
use crate::geometry::units::{DEG, m_from_mm, mm_from_m};
use crate::geometry::{Pose as Motion, Quaternion, Vector};
use crate::identify::Line;
use crate::identify::identifiability::Observability as Indices;
use crate::identify::input_checks::Remark;
use crate::identify::measurements::Measurements;
use crate::identify::off::Off;
use crate::identify::problem;
use crate::identify::statistics as of;
use crate::register::frame_file::Sigma as Six;
use crate::register::uncertainty::PoseCovariance;
use schemars::JsonSchema;
use serde::Serialize;

/// A number that may not be finite; such a one is none.
#[must_use]
pub fn finite(value: f64) -> Option<f64> {
    value.is_finite().then_some(value)
}

/// Nothing, a name, or a list of names.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum Names {
    /// Nothing.
    Nothing(()),
    /// One.
    One(String),
    /// Several.
    Many(Vec<String>),
}

impl Names {
    /// All of them.
    #[must_use]
    pub fn list(&self) -> &[String] {
        match self {
            Self::Nothing(()) => &[],
            Self::One(one) => std::slice::from_ref(one),
            Self::Many(many) => many,
        }
    }
}

impl From<&[String]> for Names {
    fn from(names: &[String]) -> Self {
        match names {
            [] => Self::Nothing(()),
            [one] => Self::One(one.clone()),
            many => Self::Many(many.to_vec()),
        }
    }
}

/// A pose: position, angles of `Rx · Ry · Rz`, and the same rotation as a quaternion w, x, y, z.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Pose {
    /// x, mm.
    pub x_mm: f64,
    /// y, mm.
    pub y_mm: f64,
    /// z, mm.
    pub z_mm: f64,
    /// Angle about x, degrees.
    pub rx_deg: f64,
    /// Angle about the new y, degrees.
    pub ry_deg: f64,
    /// Angle about the newest z, degrees.
    pub rz_deg: f64,
    /// w, x, y, z.
    pub quaternion: [f64; 4],
}

impl From<&Pose> for Motion {
    fn from(pose: &Pose) -> Self {
        Self::from_parts(pose.xyz_mm().map(m_from_mm), Quaternion(pose.quaternion))
    }
}

impl From<&Motion> for Pose {
    fn from(pose: &Motion) -> Self {
        let [x, y, z, rx, ry, rz] = pose.xyz_rxryrz();
        Self {
            x_mm: mm_from_m(x),
            y_mm: mm_from_m(y),
            z_mm: mm_from_m(z),
            rx_deg: rx / DEG,
            ry_deg: ry / DEG,
            rz_deg: rz / DEG,
            quaternion: pose.rotation.quaternion().0,
        }
    }
}

impl Pose {
    /// x, y, z in mm.
    #[must_use]
    pub fn xyz_mm(&self) -> [f64; 3] {
        [self.x_mm, self.y_mm, self.z_mm]
    }

    /// Angles in degrees.
    #[must_use]
    pub fn rxryrz_deg(&self) -> [f64; 3] {
        [self.rx_deg, self.ry_deg, self.rz_deg]
    }
}

/// Standard uncertainties of a pose.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Sigma {
    /// Along x, mm.
    pub x_mm: f64,
    /// Along y, mm.
    pub y_mm: f64,
    /// Along z, mm.
    pub z_mm: f64,
    /// Of a rotation about x, degrees.
    pub rx_deg: f64,
    /// Of a rotation about y, degrees.
    pub ry_deg: f64,
    /// Of a rotation about z, degrees.
    pub rz_deg: f64,
}

impl From<&Six> for Sigma {
    fn from(sigma: &Six) -> Self {
        let [x_mm, y_mm, z_mm] = sigma.position_m.map(mm_from_m);
        let [rx_deg, ry_deg, rz_deg] = sigma.rotation_rad.map(|r| r / DEG);
        Self {
            x_mm,
            y_mm,
            z_mm,
            rx_deg,
            ry_deg,
            rz_deg,
        }
    }
}

impl From<[f64; 6]> for Sigma {
    /// Of `x, y, z, rx, ry, rz` in metres and radians.
    fn from([x, y, z, rx, ry, rz]: [f64; 6]) -> Self {
        let [x_mm, y_mm, z_mm] = [x, y, z].map(mm_from_m);
        let [rx_deg, ry_deg, rz_deg] = [rx, ry, rz].map(|angle| angle / DEG);
        Self {
            x_mm,
            y_mm,
            z_mm,
            rx_deg,
            ry_deg,
            rz_deg,
        }
    }
}

impl Sigma {
    /// Of the position, mm.
    #[must_use]
    pub fn xyz_mm(&self) -> [f64; 3] {
        [self.x_mm, self.y_mm, self.z_mm]
    }

    /// Of the rotation, degrees.
    #[must_use]
    pub fn rxryrz_deg(&self) -> [f64; 3] {
        [self.rx_deg, self.ry_deg, self.rz_deg]
    }
}

/// The error ellipsoid of one standard deviation.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Ellipsoid {
    /// What it is of.
    pub of: String,
    /// Its middle.
    pub place_mm: [f64; 3],
    /// Half axes, the longest first.
    pub half_axes_mm: [f64; 3],
    /// Their directions.
    pub axes: [[f64; 3]; 3],
}

impl Ellipsoid {
    /// Of a place in a frame known this well.
    #[must_use]
    pub fn new(of: impl Into<String>, covariance: &PoseCovariance, place_m: Vector) -> Self {
        let found = covariance.ellipsoid(place_m);
        Self {
            of: of.into(),
            place_mm: place_m.map(mm_from_m),
            half_axes_mm: found.half_axes_m.map(mm_from_m),
            axes: std::array::from_fn(|i| found.axes.axis(i)),
        }
    }
}

/// Statistics of the size of an error.
///
/// A trait, so that the unit stands in the names of the keys and what prints them need not care.
pub trait Statistics {
    /// The numbers, in the unit of the keys.
    fn numbers(&self) -> of::Spread;
}

macro_rules! spread {
    ($name:ident, $unit:literal, $mean:ident $std:ident $three:ident $rms:ident $p95:ident $p997:ident $max:ident) => {
        #[doc = concat!("Statistics of the size of an error, ", $unit, ".")]
        #[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
        pub struct $name {
            /// How many.
            pub n: usize,
            /// Mean.
            pub $mean: Option<f64>,
            /// Standard deviation about the mean (n − 1).
            pub $std: Option<f64>,
            /// Mean and three standard deviations.
            pub $three: Option<f64>,
            /// Root mean square.
            pub $rms: Option<f64>,
            /// 95 % are not larger.
            pub $p95: Option<f64>,
            /// 99.7 % are not larger.
            pub $p997: Option<f64>,
            /// Largest.
            pub $max: Option<f64>,
        }

        impl From<of::Spread> for $name {
            fn from(s: of::Spread) -> Self {
                Self {
                    n: s.n,
                    $mean: finite(s.mean),
                    $std: finite(s.std),
                    $three: finite(s.mean_plus_3std()),
                    $rms: finite(s.rms),
                    $p95: finite(s.p95),
                    $p997: finite(s.p997),
                    $max: finite(s.max),
                }
            }
        }

        impl Statistics for $name {
            fn numbers(&self) -> of::Spread {
                let or_none = |value: Option<f64>| value.unwrap_or(f64::NAN);
                of::Spread {
                    n: self.n,
                    mean: or_none(self.$mean),
                    std: or_none(self.$std),
                    rms: or_none(self.$rms),
                    p95: or_none(self.$p95),
                    p997: or_none(self.$p997),
                    max: or_none(self.$max),
                }
            }
        }
    };
}

spread!(SpreadMm, "mm", mean_mm std_mm mean_plus_3std_mm rms_mm p95_mm p997_mm max_mm);
spread!(SpreadDeg, "degrees", mean_deg std_deg mean_plus_3std_deg rms_deg p95_deg p997_deg max_deg);

/// Errors of distances between all pairs of points; of more than 20 000 points, between a fixed
/// sample of them.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Pairs {
    /// How many.
    pub pairs: u64,
    /// Mean, mm.
    pub mean_mm: f64,
    /// Standard deviation, mm.
    pub std_mm: f64,
    /// Mean and three standard deviations, mm.
    pub mean_plus_3std_mm: f64,
    /// Largest, mm.
    pub max_mm: f64,
}

impl From<of::Pairs> for Pairs {
    fn from(p: of::Pairs) -> Self {
        Self {
            pairs: p.pairs,
            mean_mm: p.mean,
            std_mm: p.std,
            mean_plus_3std_mm: p.mean_plus_3std(),
            max_mm: p.max,
        }
    }
}

/// Errors of one model; what was not measured is not there.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Quality {
    /// Of positions.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub position: Option<SpreadMm>,
    /// Of orientations.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub orientation: Option<SpreadDeg>,
    /// Of distances from fixed points, or between a ball and the surface it touches.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub range: Option<SpreadMm>,
}

impl From<&of::Quality> for Quality {
    fn from(quality: &of::Quality) -> Self {
        Self {
            position: quality.position.map(Into::into),
            orientation: quality.orientation.map(Into::into),
            range: quality.range.map(Into::into),
        }
    }
}

impl Quality {
    /// The one that says most: position where it was measured, else distances.
    #[must_use]
    pub fn main(&self) -> Option<SpreadMm> {
        self.position.or(self.range)
    }
}

/// The row that a model misses by most.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct WorstRow {
    /// Line, from 1.
    pub line: usize,
    /// Measured minus expected, of the place.
    pub residual_mm: f64,
    /// Of the orientation, of a pose.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub residual_deg: Option<f64>,
    /// The part that is wrong in words.
    #[serde(skip)]
    pub off: String,
    /// Its file.
    #[serde(flatten)]
    pub file: File,
}

impl WorstRow {
    /// Whether it is its place that is wrong.
    #[must_use]
    pub fn is_of_place(&self) -> bool {
        self.off.ends_with(" mm")
    }

    /// Of a problem's rows and how far each is off; `None` of no rows.
    #[must_use]
    pub fn of(
        rows: &[problem::Row],
        measurements: &Measurements,
        offs: impl IntoIterator<Item = Off>,
    ) -> Option<Self> {
        let each = rows.iter().zip(offs);
        let each = each.filter(|(_, off)| off.size_m().is_finite());
        let (row, off) = each.max_by(|a, b| a.1.size_m().total_cmp(&b.1.size_m()))?;
        let line = &measurements.rows[row.measurement].line;
        Some(Self {
            line: line.number,
            residual_mm: mm_from_m(off.length_m),
            residual_deg: off.angle_rad.map(|angle| angle / DEG),
            off: off.words(),
            file: line.into(),
        })
    }
}

/// How well configurations show the parameters; larger is better for O1 to O5.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Observability {
    /// `(σ1·…·σm)^(1/m) / √n` (Borm and Menq).
    pub o1: Option<f64>,
    /// `σmin / σmax` (Driels and Pathre).
    pub o2: Option<f64>,
    /// `σmin` (Nahvi, Hollerbach and Hayward).
    pub o3: Option<f64>,
    /// `σmin² / σmax` (Nahvi and Hollerbach).
    pub o4: Option<f64>,
    /// `1 / Σ 1/σ` (Sun and Hollerbach).
    pub o5: Option<f64>,
    /// `σmax / σmin`.
    pub condition_number: Option<f64>,
    /// Parameters determined.
    pub rank: usize,
    /// `σmin`.
    pub min_singular_value: Option<f64>,
}

impl From<&Indices> for Observability {
    fn from(o: &Indices) -> Self {
        Self {
            o1: finite(o.o1),
            o2: finite(o.o2),
            o3: finite(o.o3),
            o4: finite(o.o4),
            o5: finite(o.o5),
            condition_number: finite(o.condition_number),
            rank: o.rank,
            min_singular_value: finite(o.min_singular_value),
        }
    }
}

/// A line of measurements, and the file where several are read as one.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, JsonSchema)]
pub struct File {
    /// The file, where several are read as one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub file: Option<String>,
}

impl From<&Line> for File {
    fn from(line: &Line) -> Self {
        Self {
            file: line.file.as_deref().map(str::to_owned),
        }
    }
}

impl File {
    /// A line of it as a cell of a table: `7`, or `b.csv:7` of several files.
    #[must_use]
    pub fn line(&self, number: usize) -> String {
        let file = self.file.as_ref();
        file.map_or_else(|| number.to_string(), |file| format!("{file}:{number}"))
    }

    /// A line of it in words.
    #[must_use]
    pub fn words(&self, number: usize) -> String {
        let of = self.file.as_ref().map(|file| format!(" of {file}"));
        format!("line {number}{}", of.unwrap_or_default())
    }
}

/// Remarks on measurements as findings.
#[must_use]
pub fn findings(remarks: &[Remark], file: &str) -> Vec<Finding> {
    let one = |r: &Remark| Finding {
        id: r.id,
        severity: if r.warning {
            Severity::Warning
        } else {
            Severity::Note
        },
        file: r.line.file.as_deref().unwrap_or(file).into(),
        line: r.line.number,
        column: usize::from(r.line.number > 0),
        message: r.message.clone(),
        hint: r.hint.clone(),
        accepted: false,
    };
    remarks.iter().map(one).collect()
}

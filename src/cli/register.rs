//! `register`: the rigid motion between two sets of points, or a frame from probe touches.

use super::ending::{Ending, Pendant, ReportFile, finish};
use super::files::Files;
use super::progress::Progress;
use super::{Answer, Output, values};
use crate::geometry::units::m_from_mm;
use crate::printable::name_of;
use crate::register::icp::{self, Metric};
use crate::task::Failure;
use crate::task::register::{self, Options, Pairing, register};
use clap::{Args, ValueEnum};
use std::path::PathBuf;

/// Find the rigid transform that maps the points of FROM into TO
#[derive(Args)]
#[command(
    after_help = "Points: CSV with x_mm,y_mm,z_mm; optional id (rows are matched by it), weight or \
        sigma_mm, nx,ny,nz \
(outward normal).\nFeatures: FROM with feature (point, sphere, hole, plane), several rows of TO \
    with the same id are its \
touches.\nWith --frame one file of touches is enough; 3-2-1 takes a column datum (1, 2, 3)."
)]
pub(super) struct Register {
    /// Points as they should be (simulation, drawing), or touches with --frame
    #[arg(value_name = "FROM.csv")]
    from: PathBuf,
    /// Points as measured
    #[arg(
        value_name = "TO.csv",
        required_unless_present = "frame",
        conflicts_with = "frame"
    )]
    to: Option<PathBuf>,
    /// Make a frame from touches of one file
    #[arg(long, value_enum)]
    frame: Option<Construction>,
    /// Write the frame file (for `compensate --work-offset` or --wobj)
    #[arg(short, long, value_name = "FRAME.yaml")]
    output: Option<PathBuf>,
    /// Standard deviation of one coordinate of a point, both sets together (default: from the
    /// residuals)
    #[arg(long, value_name = "MM")]
    sigma_mm: Option<f64>,
    /// Leave out touches that disagree with the others, and say why
    #[arg(long)]
    robust: bool,
    /// Radius of the probe's ball: TO holds the centres of the ball
    #[arg(long, value_name = "MM", default_value_t = 0.0)]
    probe_radius_mm: f64,
    /// Print the error ellipsoid at this point of FROM (may be given several times)
    #[arg(long = "at", value_name = "X,Y,Z", allow_hyphen_values = true)]
    at: Vec<String>,
    /// Leave out rows whose id the other file does not have
    #[arg(long)]
    drop_unmatched: bool,
    /// Match points by nearness (unknown correspondence) instead of by id or order
    #[command(flatten)]
    icp: IcpOptions,
    #[command(flatten)]
    pendant: Pendant,
    #[command(flatten)]
    report: ReportFile,
}

/// How touches make a frame
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Construction {
    /// Origin, a point on x, a point in the xy plane
    #[value(name = "3-point")]
    ThreePoints,
    /// Three touches on the primary datum, two on the secondary, one on the tertiary, or more
    #[value(name = "3-2-1")]
    ThreeTwoOne,
}

/// How clouds are matched.
#[derive(Args)]
pub(super) struct IcpOptions {
    /// Match points by nearness (iterative closest point): correspondence is unknown
    #[arg(long)]
    icp: bool,
    /// What is made small; normals are TO's nx,ny,nz or estimated
    #[arg(long, value_enum, default_value = "plane", requires = "icp")]
    icp_metric: IcpMetric,
    /// First guess x,y,z,rx,ry,rz of the transform in mm and degrees (default: a search)
    #[arg(
        long,
        value_name = "POSE",
        allow_hyphen_values = true,
        requires = "icp"
    )]
    start: Option<String>,
    /// Share of the nearest pairs that is kept in each step
    #[arg(long, value_name = "SHARE", default_value_t = 0.9, requires = "icp")]
    keep: f64,
    /// Share of FROM that must lie on TO
    #[arg(long, value_name = "SHARE", default_value_t = 0.6, requires = "icp")]
    min_overlap: f64,
}

/// What ICP makes small
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum IcpMetric {
    /// Distance from the tangent plane at the nearest point
    Plane,
    /// Distance from the nearest point
    Point,
}

impl IcpOptions {
    fn options(&self, sigma_mm: Option<f64>) -> Result<icp::Options, Failure> {
        for (name, value) in [("--keep", self.keep), ("--min-overlap", self.min_overlap)] {
            if !(value > 0.0 && value <= 1.0) {
                return Err(Failure::new(format!(
                    "{name} {value}: it must be above 0 and at most 1"
                )));
            }
        }
        let start = self
            .start
            .as_deref()
            .map(|text| {
                values::pose(text).ok_or_else(|| {
                    Failure::new(format!(
                        "--start {text}: it must be x,y,z,rx,ry,rz in mm and degrees"
                    ))
                })
            })
            .transpose()?;
        Ok(icp::Options {
            metric: match self.icp_metric {
                IcpMetric::Plane => Metric::PointToPlane,
                IcpMetric::Point => Metric::PointToPoint,
            },
            start,
            kept: self.keep,
            min_overlap: self.min_overlap,
            sigma_m: sigma_mm.map(m_from_mm),
        })
    }
}

/// The balls of touch probes and of reflectors.
const SMALLEST_BALL_MM: f64 = 0.05;
const LARGEST_BALL_MM: f64 = 100.0;

impl Register {
    fn options(&self) -> Result<Options, Failure> {
        let radius = self.probe_radius_mm;
        let is_ball = (SMALLEST_BALL_MM..=LARGEST_BALL_MM).contains(&radius);
        if radius != 0.0 && !is_ball {
            return Err(Failure::with_hint(
                format!(
                    "--probe-radius-mm {radius}: balls have a radius from {SMALLEST_BALL_MM} to \
                     {LARGEST_BALL_MM} mm"
                ),
                "it is in mm, and half of the diameter; 0 where the points themselves are touched",
            ));
        }
        if let Some(sigma) = self.sigma_mm.filter(|s| !s.is_finite() || *s <= 0.0) {
            return Err(Failure::new(format!(
                "--sigma-mm {sigma}: it must be above 0"
            )));
        }
        let at = self.at.iter().map(|text| {
            values::point(text).ok_or_else(|| {
                Failure::new(format!(
                    "--at {text}: it must be x,y,z in mm, at most 1e6 each"
                ))
            })
        });
        Ok(Options {
            sigma_m: self.sigma_mm.map(m_from_mm),
            robust: self.robust,
            probe_radius_m: m_from_mm(self.probe_radius_mm),
            at_m: at.collect::<Result<_, _>>()?,
            drop_unmatched: self.drop_unmatched,
        })
    }

    pub(super) fn run(&self, output: Output) -> Result<Answer, Failure> {
        let options = self.options()?;
        let files = Files::default();
        let progress = Progress::new(output, "reading");
        let from = files.source(&self.from)?;
        let to = self.to.as_deref();
        let to = to.map(|path| files.source(path)).transpose()?;
        self.report.refuse_over(&files, self.output.as_deref())?;
        let pairing = match (&to, self.frame) {
            (_, Some(Construction::ThreePoints)) => {
                Pairing::Frame(register::Construction::ThreePoints)
            }
            (_, Some(Construction::ThreeTwoOne)) => {
                Pairing::Frame(register::Construction::ThreeTwoOne)
            }
            (Some(to), None) if self.icp.icp => {
                Pairing::Nearness(to, self.icp.options(self.sigma_mm)?)
            }
            (Some(to), None) => Pairing::Rows(to),
            (None, None) => unreachable!("clap asks for TO where there is no --frame"),
        };
        progress.say("registering");
        let mut found = register(&from, &pairing, &options)?;
        let refused = found.is_refused();
        let mut written = Vec::new();
        if let Some(path) = self.output.as_ref().filter(|_| !refused) {
            written.push((path.clone(), found.frame_text().into_bytes().into()));
            found.output = Some(name_of(path));
        }
        let ending = Ending {
            written,
            report: Some(&self.report),
            pendant: self.pendant,
            answer: if refused { Answer::No } else { Answer::Yes },
            progress: Some(progress),
            ..Ending::default()
        };
        finish(&files, &found, ending, output)
    }
}

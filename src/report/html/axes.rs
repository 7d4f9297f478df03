//! The page of `axes`: how round each joint's sweep is.

use super::frames::pose_text;
use super::numbers::{Column, Table, significant};
use super::page::{Axis, Chart, Kind, Level, Page, Section, Series, Tone};
use crate::finding::Finding;
use crate::geometry::Pose;
use crate::geometry::units::{DEG, mm_from_m};

/// One joint's sweep and what its circle leaves of each row, metres and radians.
#[derive(Clone, Debug)]
pub struct Sweep {
    /// The joint, from 1.
    pub joint: usize,
    /// Its commanded angles.
    pub angle_rad: Vec<f64>,
    /// Beside the commanded angle.
    pub tangential_rad: Vec<f64>,
    /// Out from the circle.
    pub radial_m: Vec<f64>,
    /// Out of its plane.
    pub axial_m: Vec<f64>,
    /// Of the circle.
    pub radius_m: f64,
    /// Backlash and its standard deviation.
    pub backlash_rad: Option<(f64, f64)>,
}

/// A frame that sweeps give.
#[derive(Clone, Debug)]
pub struct Frame {
    /// What it is.
    pub name: &'static str,
    /// The joints whose sweeps give it.
    pub joints: &'static str,
    /// Where it is; `None` without those sweeps.
    pub pose: Option<Pose>,
    /// Its standard deviations, or why they are not known.
    pub sigma: String,
    /// The part of the arm's sag in them; `None` where it is not known.
    pub sag: Option<String>,
}

/// The page.
#[must_use]
pub fn page(sweeps: &[Sweep], frames: &[Frame], file: &str, findings: &[Finding]) -> Page {
    let answer = format!("{} joints were swept", sweeps.len());
    let mut page = Page::new("Axes".into(), Level::of(findings), answer);
    page.lead.push(file.to_owned());
    for frame in frames {
        let Some(pose) = &frame.pose else {
            page.fact(
                frame.name,
                format!("needs the sweeps of joints {}", frame.joints),
            );
            continue;
        };
        page.fact(frame.name, pose_text(pose));
        page.fact(&format!("{}, sigma", frame.name), frame.sigma.clone());
        if let Some(sag) = &frame.sag {
            page.fact(&format!("{}, of it sag", frame.name), sag.clone());
        }
    }
    let rms = |values: &[f64]| {
        let sum: f64 = values.iter().map(|v| v * v).sum();
        (sum / values.len().max(1) as f64).sqrt()
    };
    let mm = |of: &dyn Fn(&Sweep) -> f64| -> Vec<_> {
        let of = |sweep| significant(mm_from_m(of(sweep)), 4);
        sweeps.iter().map(of).collect()
    };
    let backlash = |sweep: &Sweep| sweep.backlash_rad.map(|b| significant(b.0 / DEG, 4));
    let tangential = |sweep: &Sweep| significant(rms(&sweep.tangential_rad) / DEG, 4);
    let table = Table {
        columns: vec![
            Column::counts("joint", sweeps.iter().map(|s| s.joint)),
            Column::numbers("radius", "mm", mm(&|s| s.radius_m)),
            Column::numbers("tangential, rms", "deg", sweeps.iter().map(tangential)),
            Column::numbers("radial, rms", "mm", mm(&|s| rms(&s.radial_m))),
            Column::numbers("axial, rms", "mm", mm(&|s| rms(&s.axial_m))),
            Column::numbers("backlash", "deg", sweeps.iter().map(backlash)),
        ],
    };
    page.show("joints", "Joints", "", table);
    for sweep in sweeps {
        show_sweep(&mut page, sweep);
    }
    page.findings(findings);
    page
}

fn show_sweep(page: &mut Page, sweep: &Sweep) {
    let name = format!("joint-{}", sweep.joint);
    let deg =
        |values: &[f64]| -> Vec<_> { values.iter().map(|v| significant(v / DEG, 5)).collect() };
    let mm = |values: &[f64]| -> Vec<_> {
        values
            .iter()
            .map(|v| significant(mm_from_m(*v), 4))
            .collect()
    };
    let table = Table {
        columns: vec![
            Column::numbers("joint angle", "deg", deg(&sweep.angle_rad)),
            Column::numbers("tangential", "deg", deg(&sweep.tangential_rad)),
            Column::numbers("radial", "mm", mm(&sweep.radial_m)),
            Column::numbers("axial", "mm", mm(&sweep.axial_m)),
        ],
    };
    page.tables.insert(name.clone(), table);
    let angle = || Axis::new("joint angle", "deg");
    let mut turned = Chart::new(
        &format!("Joint {}: angle", sweep.joint),
        &name,
        angle(),
        Axis::new("measured minus commanded", "deg"),
    );
    turned
        .series
        .push(Series::new(Kind::Dots, 0, 1, "", Tone::One));
    let mut round = Chart::new(
        &format!("Joint {}: beside the circle", sweep.joint),
        &name,
        angle(),
        Axis::new("residual", "mm"),
    );
    for (column, label, tone) in [(2, "radial", Tone::Before), (3, "axial", Tone::After)] {
        round
            .series
            .push(Series::new(Kind::Dots, 0, column, label, tone));
    }
    page.sections
        .extend([Section::Chart(turned), Section::Chart(round)]);
}

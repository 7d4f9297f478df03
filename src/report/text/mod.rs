//! Texts for people, one file a command.

mod axes;
mod calibrate;
mod catalogue;
mod diagnose;
mod handeye;
mod hexapod;
mod plan;
mod profile;
mod register;
mod tables;
mod validate;

pub(super) use axes::{frames, world as axes_world};
pub(super) use diagnose::{labelled, residual, together};
pub(super) use register::{noise, search};

use super::html::{
    axes as axes_page, diagnosis, frames as frame_pages, measurements, plan as plan_page, reach,
};
use super::{Report, Style};
use crate::finding::Finding;
use crate::report::html::page::Page;
use crate::task;
use crate::task::parts::Pose;
use crate::task::programs::LeftOut;

/// Files that a line lists.
const LISTED: usize = 5;

/// What of folders is no program of the run, as lines of a summary.
pub(super) fn left_out(found: &LeftOut) -> Vec<String> {
    let line = |what: &str, names: &[String], why: &str| {
        let shown = names[..names.len().min(LISTED)].join(", ");
        let more = if names.len() > LISTED { ", …" } else { "" };
        let line = format!("  {what} {} ({why}): {shown}{more}", names.len());
        (!names.is_empty()).then_some(line)
    };
    let ignored = line("ignored  ", &found.ignored, "--ignore");
    let other = line("others   ", &found.other, "no programs, by their names");
    ignored.into_iter().chain(other).collect()
}

/// Of a last decimal, by what numbers are off that are written with it.
const ROUNDED: f64 = 1e-6;

/// The least number with so many decimals that a bound from above is not beyond.
pub(crate) fn at_most(bound: f64, decimals: i32) -> f64 {
    let unit = 10.0_f64.powi(decimals);
    // what is such a number already stays; a zero has no sign
    (bound * unit - ROUNDED).ceil() / unit + 0.0
}

/// The largest number with so many decimals that a bound from below is not below.
pub(crate) fn at_least(bound: f64, decimals: i32) -> f64 {
    -at_most(-bound, decimals) + 0.0
}

/// A number that may be none with so many decimals.
pub(super) fn fixed(value: Option<f64>, decimals: usize) -> String {
    value.map_or_else(|| "-".into(), |x| format!("{x:.decimals$}"))
}

/// A number that may be none with three decimals and an exponent.
pub(super) fn scientific(value: Option<f64>) -> String {
    value.map_or_else(|| "-".into(), |x| format!("{x:.3e}"))
}

/// A number with the digits that matter: five decimals, four digits of a small one.
fn digits(value: f64) -> String {
    if value.abs() < 1e-2 && value != 0.0 {
        format!("{value:.3e}")
    } else {
        format!("{value:.5}")
    }
}

macro_rules! reports {
    ($($document:ty: $text:path $(, $page:path $(, $findings:ident $(, $frames:path)?)?)?;)+) => {$(
        impl Report for $document {
            fn text(&self, style: Style) -> String {
                $text(self, style)
            }
            $(
                fn page(&self) -> Option<Page> {
                    Some($page(self))
                }
                $(
                    fn findings(&self) -> &[Finding] {
                        &self.$findings
                    }
                    $(
                        fn frames(&self) -> Vec<(String, Pose)> {
                            $frames(self)
                        }
                    )?
                )?
            )?
        }
    )+};
}

// what is said of each result: its text, its page, its findings, its frames
reports! {
    task::calibrate::Calibration: calibrate::text, measurements::calibrate_page, findings, calibrate::poses;
    task::validate::Validation: validate::text, measurements::validate_page, findings;
    task::diagnose::Diagnosis: diagnose::text, diagnosis::page, findings;
    task::plan::Plan: plan::text, plan_page::plan_page, findings;
    task::register::Registration: register::text, frame_pages::registration_page, findings, register::poses;
    task::handeye::HandEye: handeye::text, frame_pages::hand_eye_page, findings, handeye::poses;
    task::axes::Axes: axes::text, axes_page::page, findings, axes::poses;
    task::hexapod::Poses: hexapod::poses, frame_pages::hexapod_page, findings;
    task::hexapod::Base: hexapod::base, frame_pages::base_page, findings;
    task::hexapod::Reach: hexapod::reach, reach::page;
    task::ik::Solutions: tables::solutions;
    task::profile::NewProfile: profile::new;
    task::profile::FromUrdf: profile::from_urdf;
    task::profile::Imported: profile::imported;
    task::profile::Changed: profile::changed;
    task::profile::Exported: profile::exported;
    task::profile::Facts: profile::facts;
    task::profile::Diff: profile::diff;
    task::catalogue::Robots: catalogue::robots;
    task::catalogue::Effects: catalogue::effects;
    task::catalogue::Languages: catalogue::languages;
    task::explain::Explanations: catalogue::explanations;
}

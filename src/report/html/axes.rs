//! The page of `axes`: how round each joint's sweep is.

use super::chart::{Axis, Chart, Kind, Series, Tone};
use super::frames::{pose_text, sigma_text};
use super::numbers::{Column, DIGITS, Number, Table, significant};
use super::page::{Level, Page, Section};
use crate::report::text::{axes_world, frames};
use crate::task::axes::positioner::PositionerAxis;
use crate::task::axes::{Axes, Joint, Rows};

/// The page.
#[must_use]
pub(crate) fn page(found: &Axes) -> Page {
    let list = &found.joints;
    let plates = &found.positioner_axes;
    let mut answer = format!("{} joints were swept", list.len());
    if !plates.is_empty() {
        answer = format!("{} axes of positioners were swept", plates.len());
    }
    let worst_axis = plates
        .iter()
        .max_by(|a, b| a.moved_mm.total_cmp(&b.moved_mm));
    if let Some(axis) = worst_axis {
        answer += &format!(
            "; {} is {:.3} mm and {:.4} deg from where the profile has it",
            axis.axis, axis.moved_mm, axis.rotated_deg
        );
    }
    let of_joints = !list.is_empty();
    for (what, pose, sigma) in [
        ("the base", &found.base, &found.base_sigma),
        ("the tool", &found.tool, &found.tool_sigma),
    ] {
        answer += &match (pose, sigma) {
            (Some(_), Some(sigma)) => {
                let along = sigma.xyz_mm().into_iter().zip(["x", "y", "z"]);
                let most = along.reduce(|a, b| if b.0 > a.0 { b } else { a });
                let (mm, axis) = most.unwrap_or_default();
                format!("; {what} is known to {mm:.4} mm (sigma along {axis}, the largest)")
            }
            (Some(_), None) => format!("; {what} is found"),
            (None, _) if of_joints => format!("; {what} is not determined"),
            (None, _) => String::new(),
        };
    }
    let worst = |of: &dyn Fn(&Joint) -> f64| {
        let each = list.iter().map(|joint| (of(joint), joint.joint));
        let each = each.filter(|(size, _)| size.is_finite());
        each.max_by(|a, b| a.0.total_cmp(&b.0))
    };
    if let Some((size, joint)) = worst(&|joint| joint.circle.tangential_deg) {
        answer += &format!("; the largest angular residual is {size:.4} deg rms (joint {joint})");
    }
    if let Some((size, joint)) = worst(&|joint| joint.backlash_deg.unwrap_or(f64::NAN)) {
        answer += &format!(", the largest backlash {size:.4} deg (joint {joint})");
    }
    let mut page = Page::new("Axes".into(), Level::of(&found.findings), answer);
    page.lead.push(found.name.clone());
    page.lead.push(axes_world(found).to_owned());
    for (frame, name) in frames(found)
        .iter()
        .zip(["base in the world", "tool in the flange"])
    {
        let Some(pose) = frame.pose else {
            if !of_joints {
                continue;
            }
            page.fact(name, format!("needs the sweeps of joints {}", frame.joints));
            continue;
        };
        page.fact(name, pose_text(pose));
        let sigma = "sigma along x, y, z and about them";
        page.fact(&format!("{name}, {sigma}"), frame.sigma.clone());
        if let Some((_, sag)) = &frame.sag {
            page.fact(&format!("{name}, {sigma}: of it sag"), sag.clone());
        }
    }
    for axis in plates {
        let name = format!(
            "axis {} of {}, `at` in the profile",
            axis.axis, axis.positioner
        );
        page.fact(&name, pose_text(&axis.at));
        if let Some(sigma) = &axis.at_sigma {
            page.fact(&format!("{}, sigma", axis.axis), sigma_text(sigma));
        }
    }
    let numbers = |of: &dyn Fn(&Joint) -> f64| -> Vec<Number> {
        list.iter()
            .map(|joint| significant(of(joint), DIGITS))
            .collect()
    };
    let table = Table {
        columns: vec![
            Column::counts("joint", list.iter().map(|s| s.joint)),
            Column::numbers("radius", "mm", numbers(&|s| s.circle.radius_mm)).to(3),
            Column::numbers(
                "tangential, rms",
                "deg",
                numbers(&|s| s.circle.tangential_deg),
            )
            .to(5)
            .worst_first(),
            Column::numbers("radial, rms", "mm", numbers(&|s| s.circle.radial_mm)).to(4),
            Column::numbers("axial, rms", "mm", numbers(&|s| s.circle.axial_mm)).to(4),
            Column::numbers(
                "backlash",
                "deg",
                list.iter()
                    .map(|s| s.backlash_deg.map(|b| significant(b, DIGITS))),
            )
            .to(5),
        ],
    };
    if of_joints {
        page.show("joints", "Joints", "", table);
    }
    for joint in list {
        let (name, title) = (
            format!("joint-{}", joint.joint),
            format!("Joint {}", joint.joint),
        );
        show_sweep(&mut page, (name, title, "joint angle"), &joint.circle.rows);
    }
    if !plates.is_empty() {
        show_positioners(&mut page, plates);
    }
    page.findings(&found.findings);
    page
}

fn show_positioners(page: &mut Page, list: &[PositionerAxis]) {
    let numbers = |of: &dyn Fn(&PositionerAxis) -> f64| -> Vec<Number> {
        list.iter()
            .map(|axis| significant(of(axis), DIGITS))
            .collect()
    };
    let table = Table {
        columns: vec![
            Column::texts("axis", list.iter().map(|axis| axis.axis.clone())),
            Column::numbers("from the profile", "mm", numbers(&|s| s.moved_mm))
                .to(4)
                .worst_first(),
            Column::numbers("from the profile", "deg", numbers(&|s| s.rotated_deg)).to(5),
            Column::numbers("radius", "mm", numbers(&|s| s.circle.radius_mm)).to(3),
            Column::numbers(
                "tangential, rms",
                "deg",
                numbers(&|s| s.circle.tangential_deg),
            )
            .to(5),
            Column::numbers("radial, rms", "mm", numbers(&|s| s.circle.radial_mm)).to(4),
            Column::numbers("axial, rms", "mm", numbers(&|s| s.circle.axial_mm)).to(4),
        ],
    };
    page.show("positioners", "Axes of positioners", "", table);
    for axis in list {
        let name = format!("axis-e{}", axis.external_axis);
        let title = format!("Axis {}", axis.axis);
        show_sweep(page, (name, title, "angle of the axis"), &axis.circle.rows);
    }
}

/// The residuals of one sweep, by the name of their table, a title and what goes along.
fn show_sweep(page: &mut Page, (name, title, along): (String, String, &'static str), rows: &Rows) {
    let rounded = |values: &[f64], digits: usize| -> Vec<Number> {
        values.iter().map(|v| significant(*v, digits)).collect()
    };
    let table = Table {
        columns: vec![
            Column::numbers(along, "deg", rounded(&rows.angle_deg, 5)),
            Column::numbers("tangential", "deg", rounded(&rows.tangential_deg, 5)),
            Column::numbers("radial", "mm", rounded(&rows.radial_mm, 4)),
            Column::numbers("axial", "mm", rounded(&rows.axial_mm, 4)),
        ],
    };
    page.tables.insert(name.clone(), table);
    let angle = || Axis::new(along, "deg");
    let mut angular = Chart::new(
        &format!("{title}: angle"),
        &name,
        angle(),
        Axis::new("measured minus commanded", "deg"),
    );
    angular
        .series
        .push(Series::new(Kind::Dots, 0, 1, "", Tone::One));
    let mut round = Chart::new(
        &format!("{title}: off the circle"),
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
        .extend([Section::Chart(angular), Section::Chart(round)]);
}

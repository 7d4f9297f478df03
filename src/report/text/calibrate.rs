//! The text of `calibrate`.

use super::{digits, fixed, scientific};
use crate::identify::calibration::STRONG_CORRELATION;
use crate::report::Style;
use crate::report::layout::{SPREAD_HEADER, aligned, spread_row};
use crate::task::calibrate::Calibration;
use crate::task::parts::{Pose, Statistics};

/// Where the device and the base stand, as frames.
pub(super) fn poses(found: &Calibration) -> Vec<(String, Pose)> {
    let base = found
        .base_replaced
        .then_some(("world_from_base", found.base));
    let device = found.world_from_device;
    let device = device.map(|device| ("world_from_device", device));
    let both = base.into_iter().chain(device);
    both.map(|(name, pose)| (name.to_owned(), pose)).collect()
}

/// The report for people.
pub(super) fn text(found: &Calibration, style: Style) -> String {
    let determined = found.parameters.iter().filter(|p| p.identifiable);
    let mut out = format!(
        "{} rows, {} numbers, {} of {} parameters determined\n",
        found.rows,
        found.numbers,
        determined.clone().count(),
        found.parameters.len(),
    );
    out += &format!(
        "stopped after {} passes: {}\n\n",
        found.passes, found.stopped
    );
    let mut rows = vec![SPREAD_HEADER.map(str::to_owned).to_vec()];
    let mut models = vec![
        ("before", &found.before),
        ("frames only", &found.frames_only),
        ("after", &found.after),
    ];
    if let Some(held) = &found.held_out {
        models.extend([
            ("held out, frames only", &held.frames_only),
            ("held out, after", &held.after),
        ]);
    }
    for (name, quality) in models {
        let row = |what: &str, s: &dyn Statistics| spread_row(&format!("{name}, {what}"), s);
        rows.extend(quality.position.map(|s| row("mm", &s)));
        rows.extend(quality.orientation.map(|s| row("deg", &s)));
        rows.extend(quality.range.map(|s| row("distance mm", &s)));
    }
    out += &aligned(&rows, style.width);
    let given = if found.sigma_assumed {
        "assumed"
    } else {
        "given"
    };
    out += &format!(
        "\nresiduals are {:.2} times the {given} standard deviations; sigmas below are scaled by \
         {:.2}\n",
        found.sigma_factor, found.applied_factor
    );
    if found.shared_factor > 1.0 {
        out += &format!(
            "rows of one configuration miss alike: sigmas count each configuration once, which \
             makes them about {:.2} times larger\n",
            found.shared_factor
        );
    }
    if let Some(lever_mm) = found.orientation_lever_mm {
        out += &format!(
            "orientations without sigma_deg weigh by what they scatter, as positions {lever_mm:.0} mm \
             away\n"
        );
    }
    if let Some(expected_mm) = found.expected_error_mm {
        out += &format!(
            "expected error over the joint limits, by these sigmas: {expected_mm:.4} mm rms\n"
        );
    }
    let o = &found.observability;
    out += &format!(
        "O1 {}, condition number {}, rank {}\n\n",
        fixed(o.o1, 4),
        scientific(o.condition_number),
        o.rank
    );
    let mut rows = vec![
        ["parameter", "value", "sigma", "unit"]
            .map(str::to_owned)
            .to_vec(),
    ];
    for p in determined {
        rows.push(vec![
            p.key.clone(),
            digits(p.value),
            p.sigma.map_or_else(String::new, digits),
            p.unit.into(),
        ]);
    }
    out += &aligned(&rows, style.width);
    for f in &found.features {
        let [x, y, z] = f.centre_mm;
        out += &format!("{} {} at ({x:.3}, {y:.3}, {z:.3}) mm", f.contact, f.feature);
        if let Some(radius_mm) = f.radius_mm {
            out += &format!(", radius {radius_mm:.4} mm");
        }
        if let Some([x, y, z]) = f.normal {
            out += &format!(", normal ({x:.6}, {y:.6}, {z:.6})");
        }
        out.push('\n');
    }
    let as_prior: Vec<&str> = found
        .parameters
        .iter()
        .filter(|p| p.is_prior)
        .map(|p| p.key.as_str())
        .collect();
    if !as_prior.is_empty() {
        out += &format!(
            "\nthe data say hardly more than the prior of {} of these: {}\n",
            as_prior.len(),
            as_prior.join(", ")
        );
    }
    let mut dropped = found
        .parameters
        .iter()
        .filter(|p| !p.identifiable)
        .peekable();
    if dropped.peek().is_some() {
        out += "\nnot determined by these data, kept as they were\n";
    }
    for p in dropped {
        let weak = p.sigma_if_identified.map_or_else(String::new, |w| {
            format!("sigma would be {} {}; ", digits(w), p.unit)
        });
        let with = &p.confounded_with;
        let why = if with.is_empty() {
            "does not show in what was measured".to_owned()
        } else {
            format!("like {}", with[..with.len().min(3)].join(", "))
        };
        out += &format!("  {}: {weak}{why}\n", p.key);
    }
    let strong = &found.correlations;
    if !strong.is_empty() {
        out += &format!(
            "\n{} pairs of parameters are correlated by more than {STRONG_CORRELATION}\n",
            strong.len()
        );
        let shown = if style.every { strong.len() } else { 5 };
        for c in strong.iter().take(shown) {
            out += &format!("  {:+.3}  {} / {}\n", c.correlation, c.a, c.b);
        }
    }
    if found.base_replaced {
        let ([x, y, z], [rx, ry, rz]) = (found.base.xyz_mm(), found.base.rxryrz_deg());
        out += &format!(
            "\nthe base stands at ({x:.3}, {y:.3}, {z:.3}) mm,\n  rotated by ({rx:.5}, {ry:.5}, \
             {rz:.5}) deg (Rx·Ry·Rz) in the device's frame\n"
        );
    }
    if let Some(device) = &found.world_from_device {
        let ([x, y, z], [rx, ry, rz]) = (device.xyz_mm(), device.rxryrz_deg());
        out += &format!(
            "\nthe device stands at ({x:.3}, {y:.3}, {z:.3}) mm,\n  rotated by ({rx:.5}, {ry:.5}, \
             {rz:.5}) deg (Rx·Ry·Rz) in the controller's world\n"
        );
        if let Some(sigma) = &found.world_from_device_sigma {
            let ([x, y, z], [rx, ry, rz]) = (sigma.xyz_mm(), sigma.rxryrz_deg());
            out += &format!("  sigma {x:.3}, {y:.3}, {z:.3} mm, {rx:.5}, {ry:.5}, {rz:.5} deg\n");
        }
    }
    if !found.outliers.is_empty() {
        out += &format!("\n{} rows do not fit the others\n", found.outliers.len());
        let shown = if style.every {
            found.outliers.len()
        } else {
            10
        };
        let mut rows = vec![
            ["line", "id", "residual", "times typical", "weight"]
                .map(str::to_owned)
                .to_vec(),
        ];
        for o in found.outliers.iter().take(shown) {
            rows.push(vec![
                o.file.line(o.line),
                o.id.clone(),
                o.off.clone(),
                format!("{:.1} (limit {:.1})", o.times_typical, o.limit),
                format!("{:.2}", o.weight),
            ]);
        }
        out += &aligned(&rows, style.width);
    }
    if let Some(plates) = &found.plates {
        out += "\nPoints on plates\n";
        out += &text(plates, style);
    }
    out
}

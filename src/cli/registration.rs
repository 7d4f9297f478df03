//! What `register` tells and writes.

use super::failure::Failure;
use super::layout::{aligned, print_findings, print_text};
use super::page::ReportFile;
use super::{Answer, Output, files, print, print_json};
use crate::finding::{Finding, Severity};
use crate::geometry::units::{DEG, mm_from_m};
use crate::geometry::{Pose, Vector, norm};
use crate::register::frame_file::{Frame, Sigma};
use crate::register::uncertainty::PoseCovariance;
use crate::report;
use crate::report::html::frames::{Left, Uncertain, frame_page, pose_text};
use crate::report::html::page::Page;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::Path;

/// A point of both sets.
pub struct Touched {
    pub id: String,
    pub from_m: Vector,
    pub to_m: Vector,
    pub variance_m2: Option<f64>,
    pub weight: Option<f64>,
}

/// What is left of one point.
pub struct Measured {
    pub id: String,
    pub left_m: Vector,
    pub rejected: Option<String>,
    /// Where it is in TO.
    pub place_m: Option<Vector>,
}

impl Measured {
    pub fn new(id: &str, left_m: Vector) -> Self {
        Self {
            id: id.into(),
            left_m,
            rejected: None,
            place_m: None,
        }
    }

    /// It is here in TO.
    pub fn at(mut self, place_m: Vector) -> Self {
        self.place_m = Some(place_m);
        self
    }
}

/// A motion found, and how well.
pub struct Registration {
    pub method: &'static str,
    pub from: String,
    pub to: String,
    pub to_from_from: Pose,
    pub covariance: Option<PoseCovariance>,
    pub sigma_m: Option<f64>,
    pub sigma_given: bool,
    pub rmsd_m: Option<f64>,
    pub scale: Option<(f64, f64)>,
    pub rows: Vec<Measured>,
    /// Points of the page alone: some of very many.
    pub drawn: Vec<Measured>,
    pub features: Vec<Value>,
    /// More keys for the report, and lines for people.
    pub more: Vec<(&'static str, Value, String)>,
    pub findings: Vec<Finding>,
}

impl Default for Registration {
    fn default() -> Self {
        Self {
            method: "",
            from: String::new(),
            to: String::new(),
            to_from_from: Pose::identity(),
            covariance: None,
            sigma_m: None,
            sigma_given: false,
            rmsd_m: None,
            scale: None,
            rows: Vec::new(),
            drawn: Vec::new(),
            features: Vec::new(),
            more: Vec::new(),
            findings: Vec::new(),
        }
    }
}

/// Residuals shown to a person, largest first.
const SHOWN: usize = 12;

/// Writes the frame file unless the answer is no, and tells the result.
pub fn tell(
    found: &Registration,
    at: &[Vector],
    file: Option<&Path>,
    page: &ReportFile,
    output: Output,
) -> Result<Answer, Failure> {
    let refused = found
        .findings
        .iter()
        .any(|finding| finding.severity == Severity::Error);
    let mut outputs = Vec::new();
    if let Some(path) = file.filter(|_| !refused) {
        let text = frame(found).to_yaml();
        outputs.push((path.to_owned(), text.into_bytes()));
    }
    if page.is_wanted() {
        outputs.extend(page.output(Some(&drawn(found, at))));
    }
    files::write_all(&outputs)?;
    let written = file.filter(|_| !refused);
    if output.json {
        print_json(&as_json(found, at, written))?;
    } else {
        print_findings(&found.findings, output.verbose);
        if !output.quiet {
            print_text(&as_text(found, at, written, output.verbose))?;
            print(&page.told())?;
        }
    }
    Ok(if refused { Answer::No } else { Answer::Yes })
}

/// The page: residuals where points are known, ellipsoids where they were asked for and at FROM's origin.
fn drawn(found: &Registration, at: &[Vector]) -> Page {
    let mut facts = vec![("TO from FROM".to_owned(), pose_text(&found.to_from_from))];
    if let Some(rmsd) = found.rmsd_m {
        facts.push(("rmsd".into(), format!("{:.4} mm", mm_from_m(rmsd))));
    }
    if let Some(sigma) = found.sigma_m {
        let source = if found.sigma_given {
            "given"
        } else {
            "from the residuals"
        };
        facts.push((
            format!("noise of a coordinate, {source}"),
            format!("{:.4} mm", mm_from_m(sigma)),
        ));
    }
    if let Some((scale, sigma)) = found.scale {
        facts.push(("scale".into(), format!("{scale:.6} \u{b1} {sigma:.6}")));
    }
    for (_, _, told) in &found.more {
        if let Some((what, value)) = told.split_once(": ") {
            facts.push((what.to_owned(), value.to_owned()));
        }
    }
    let points = found.rows.iter().chain(&found.drawn).filter_map(|row| {
        Some(Left {
            id: row.id.clone(),
            place_m: row.place_m?,
            left_m: row.left_m,
            rejected: row.rejected.clone(),
        })
    });
    let named = std::iter::once(("FROM's origin".to_owned(), [0.0; 3])).chain(at.iter().map(|p| {
        let [x, y, z] = p.map(mm_from_m);
        (format!("{x} {y} {z} of FROM"), *p)
    }));
    let ellipsoids = found.covariance.iter().flat_map(|covariance| {
        named.clone().map(|(name, p)| {
            let place_m = found.to_from_from.transform(p);
            let ellipsoid = covariance.ellipsoid(place_m);
            Uncertain {
                name,
                place_m,
                half_axes_m: ellipsoid.half_axes_m,
                axes: std::array::from_fn(|i| ellipsoid.axes.axis(i)),
            }
        })
    });
    frame_page(&report::html::frames::Frame {
        title: "Registration".into(),
        lead: vec![format!(
            "{} \u{2192} {} ({})",
            found.from, found.to, found.method
        )],
        answer: found.rmsd_m.map_or_else(
            || "The frame is constructed".into(),
            |rmsd| format!("The points agree to {:.4} mm (rmsd)", mm_from_m(rmsd)),
        ),
        facts,
        points: points.collect(),
        ellipsoids: ellipsoids.collect(),
        findings: found.findings.clone(),
    })
}

fn frame(found: &Registration) -> Frame {
    let provenance = BTreeMap::from([
        ("method".to_owned(), found.method.to_owned()),
        ("from".to_owned(), found.from.clone()),
        ("to".to_owned(), found.to.clone()),
        ("version".to_owned(), env!("CARGO_PKG_VERSION").to_owned()),
    ]);
    let used = found.rows.iter().filter(|row| row.rejected.is_none());
    Frame {
        to_from_from: found.to_from_from,
        sigma: found.covariance.map(|c| Sigma::of(&c, &found.to_from_from)),
        rmsd_m: found.rmsd_m,
        points: (!found.rows.is_empty()).then(|| used.count()),
        provenance,
    }
}

/// The six standard uncertainties for reports.
pub fn sigma_json(sigma: &Sigma) -> Value {
    let p = sigma.position_m.map(mm_from_m);
    let r = sigma.rotation_rad.map(|r| r / DEG);
    json!({"x_mm": p[0], "y_mm": p[1], "z_mm": p[2], "rx_deg": r[0], "ry_deg": r[1], "rz_deg": r[2]})
}

fn as_json(found: &Registration, at: &[Vector], written: Option<&Path>) -> Value {
    let pose = &found.to_from_from;
    let [c, b, a] = pose.rotation.rzryrx(0.0);
    let distances: Vec<f64> = found
        .rows
        .iter()
        .map(|row| mm_from_m(norm(row.left_m)))
        .collect();
    let points: Vec<Value> = found
        .rows
        .iter()
        .map(|row| {
            json!({"id": row.id, "residual_mm": row.left_m.map(mm_from_m), "distance_mm": mm_from_m(norm(row.left_m)),
                   "rejected": row.rejected})
        })
        .collect();
    let mut value = json!({
        "poseshift": "registration/1",
        "method": found.method, "from": found.from, "to": found.to,
        "rotation": pose.rotation.0, "quaternion": pose.rotation.quaternion().0,
        "euler_xyz_deg": [a / DEG, b / DEG, c / DEG], "translation_mm": pose.translation.map(mm_from_m),
        "rmsd_mm": found.rmsd_m.map(mm_from_m), "residuals_mm": distances, "points": points,
        "sigma": found.covariance.map(|c| sigma_json(&Sigma::of(&c, pose))),
        "noise_mm": found.sigma_m.map(mm_from_m),
        "noise_from": if found.sigma_given { "given" } else { "residuals" },
        "findings": found.findings,
        "output": written.map(|path| path.display().to_string()),
    });
    if let Some((scale, sigma)) = found.scale {
        value["scale"] = json!({"value": scale, "sigma": sigma});
    }
    if !found.features.is_empty() {
        value["features"] = json!(found.features);
    }
    if let Some(covariance) = &found.covariance {
        let ellipsoids = at.iter().map(|p| {
            let there = pose.transform(*p);
            let ellipsoid = covariance.ellipsoid(there);
            let axes: Vec<Vector> = (0..3).map(|i| ellipsoid.axes.axis(i)).collect();
            json!({"from_mm": p.map(mm_from_m), "to_mm": there.map(mm_from_m),
                   "sigma_mm": covariance.sigma_at_m(there).map(mm_from_m),
                   "half_axes_mm": ellipsoid.half_axes_m.map(mm_from_m),
                   "axes": axes})
        });
        value["at"] = ellipsoids.collect();
    }
    for (key, more, _) in &found.more {
        value[*key] = more.clone();
    }
    value
}

fn as_text(found: &Registration, at: &[Vector], written: Option<&Path>, every: bool) -> String {
    let pose = &found.to_from_from;
    let t = pose.translation.map(mm_from_m);
    let q = pose.rotation.quaternion().0;
    let [c, b, a] = pose.rotation.rzryrx(0.0).map(|angle| angle / DEG);
    let mut text = format!("{} -> {} ({})\n", found.from, found.to, found.method);
    let ok = "a string takes all text";
    let mut line = |what: &str, value: String| {
        writeln!(text, "  {what:<22} {value}").expect(ok);
    };
    line(
        "translation",
        format!("{:.4} {:.4} {:.4} mm", t[0], t[1], t[2]),
    );
    line("extrinsic xyz angles", format!("{a:.5} {b:.5} {c:.5} deg"));
    line(
        "quaternion w x y z",
        format!("{:.8} {:.8} {:.8} {:.8}", q[0], q[1], q[2], q[3]),
    );
    if let Some(covariance) = &found.covariance {
        let sigma = Sigma::of(covariance, pose);
        let p = sigma.position_m.map(mm_from_m);
        let r = sigma.rotation_rad.map(|r| r / DEG);
        line(
            "sigma of FROM's origin",
            format!("{:.4} {:.4} {:.4} mm", p[0], p[1], p[2]),
        );
        line(
            "sigma of the turn",
            format!("{:.5} {:.5} {:.5} deg about TO's axes", r[0], r[1], r[2]),
        );
    }
    if let Some(rmsd) = found.rmsd_m {
        let over = match found.rows.len() {
            0 => String::new(),
            count => format!(" over {count} points"),
        };
        line("rmsd", format!("{:.4} mm{over}", mm_from_m(rmsd)));
    }
    if let Some(sigma) = found.sigma_m {
        let source = if found.sigma_given {
            "given"
        } else {
            "from the residuals"
        };
        line(
            "noise of a coordinate",
            format!("{:.4} mm, {source}", mm_from_m(sigma)),
        );
    }
    if let Some((scale, sigma)) = found.scale {
        line("scale", format!("{scale:.6} +/- {sigma:.6}"));
    }
    for (_, _, told) in &found.more {
        if let Some((what, value)) = told.split_once(": ") {
            line(what, value.to_owned());
        }
    }
    if let Some(covariance) = &found.covariance {
        for p in at {
            let there = pose.transform(*p);
            let ellipsoid = covariance.ellipsoid(there);
            let [x, y, z] = p.map(mm_from_m);
            let h = ellipsoid.half_axes_m.map(mm_from_m);
            let d = ellipsoid.axes.axis(0);
            line(
                "error ellipsoid",
                format!(
                    "at {x} {y} {z}: {:.4} {:.4} {:.4} mm, longest along ({:.2} {:.2} {:.2})",
                    h[0], h[1], h[2], d[0], d[1], d[2]
                ),
            );
        }
    }
    let mut order: Vec<&Measured> = found.rows.iter().collect();
    if order.len() > SHOWN && !every {
        order.sort_by(|a, b| norm(b.left_m).total_cmp(&norm(a.left_m)));
        writeln!(
            text,
            "  largest {SHOWN} of {} residuals (-v shows all)",
            order.len()
        )
        .expect(ok);
        order.truncate(SHOWN);
    }
    if !order.is_empty() {
        let mut rows = vec![
            ["  point", "dx", "dy", "dz", "distance mm"]
                .map(str::to_owned)
                .to_vec(),
        ];
        let some_left_out = order.iter().any(|row| row.rejected.is_some());
        rows[0].extend(some_left_out.then(|| "left out".to_owned()));
        for row in order {
            let mut cells = vec![format!("  {}", row.id)];
            cells.extend(row.left_m.map(|d| format!("{:.4}", mm_from_m(d))));
            cells.push(format!("{:.4}", mm_from_m(norm(row.left_m))));
            cells.extend(row.rejected.clone());
            rows.push(cells);
        }
        text += &aligned(&rows);
    }
    if let Some(path) = written {
        writeln!(text, "  wrote {}", path.display()).expect(ok);
    }
    text
}

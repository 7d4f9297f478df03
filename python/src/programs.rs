//! `compensate` and `check`.

use crate::arrays::{Numbers, fixed, one_pose};
use crate::document::{Document, Reported};
use crate::errors::Kind;
use crate::profile::Profile;
use crate::threads::{Stop, long};
use poseshift::check as following;
use poseshift::compensate::{AtSingularity, Given, Methods, Options};
use poseshift::finding::Acceptance;
use poseshift::geometry::Separation;
use poseshift::geometry::units::{DEG, MM, m_from_mm};
use poseshift::model::profile::Mounted;
use poseshift::motion::ToolRotation;
use poseshift::program::{Language, Source};
use poseshift::task::check as checking;
use poseshift::task::compensate::{Compensated, DespiteErrors, Header, Prepared, Request, prepare};
use poseshift::task::programs::{LeftOut, acceptance, language_by_id};
use poseshift::task::{Document as _, Failure, ProfileFile, reading};
use poseshift::{Drawing, check_html, check_junit, check_words, compensation_words};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::pybacked::PyBackedBytes;
use pyo3::types::PyBytes;
use std::path::Path;
use std::sync::Arc;

/// Names and bytes.
pub(crate) type Files = Vec<(String, PyBackedBytes)>;

/// Bytes by name.
type Written<'py> = Vec<(String, Bound<'py, PyBytes>)>;

pub(crate) fn sources(files: &Files) -> Vec<Source> {
    let source =
        |(name, bytes): &(String, PyBackedBytes)| Source::new(name.as_str(), bytes.to_vec());
    files.iter().map(source).collect()
}

fn with_context(files: &Files, context: &Files) -> Vec<Source> {
    let mut all = sources(files);
    let declared =
        |(name, bytes): &(String, PyBackedBytes)| Source::context(name.as_str(), bytes.to_vec());
    all.extend(context.iter().map(declared));
    all
}

/// Tools and frames by name; `None` is every name that the files do not tell.
type Named<'py> = Vec<(Option<String>, Bound<'py, PyAny>)>;

fn given(profile: &Profile, tools: Named<'_>, frames: Named<'_>) -> PyResult<Given> {
    let mut given = Given {
        is_needed: true,
        ..Given::default()
    };
    for (name, value) in tools {
        let tool = if let Ok(known) = value.extract::<String>() {
            let tool = profile.file.tool(Some(&known));
            tool.map_err(|failure| Kind::Profile.raise(value.py(), &failure))?
        } else {
            Mounted {
                name: name.clone().unwrap_or_default(),
                flange_from_tool: one_pose("tool", &value.extract::<Numbers<'_>>()?)?,
                load: None,
            }
        };
        given.tools.insert(name, tool);
    }
    for (name, value) in frames {
        let frame = one_pose("frame", &value.extract::<Numbers<'_>>()?)?;
        given.frames.insert(name, frame);
    }
    Ok(given)
}

fn accepted(py: Python<'_>, texts: &[String]) -> PyResult<Vec<Acceptance>> {
    let all = texts.iter().map(|text| acceptance(text));
    all.collect::<Result<_, _>>()
        .map_err(|failure| Kind::Program.raise(py, &failure))
}

fn language(py: Python<'_>, id: Option<&str>) -> PyResult<Option<&'static dyn Language>> {
    id.map(language_by_id)
        .transpose()
        .map_err(|failure| Kind::Program.raise(py, &failure))
}

fn start_joints(array: Option<&Numbers<'_>>) -> PyResult<Option<[f64; 6]>> {
    array
        .map(|array| fixed("start_joints_rad", array))
        .transpose()
}

/// One of some words.
pub(crate) fn word<T: Copy>(option: &str, found: &str, words: &[(&str, T)]) -> PyResult<T> {
    let meant = words.iter().find(|(word, _)| *word == found);
    meant.map(|(_, value)| *value).ok_or_else(|| {
        let words: Vec<&str> = words.iter().map(|(word, _)| *word).collect();
        PyValueError::new_err(format!(
            "{option} is \"{found}\"; it is one of: {}",
            words.join(", ")
        ))
    })
}

fn read(path: &Path) -> std::io::Result<Vec<u8>> {
    std::fs::read(path)
}

/// A compensation that can be reported again.
struct Compensating {
    sources: Vec<Source>,
    profile: Arc<ProfileFile>,
    language: Option<&'static dyn Language>,
    options: Options,
    force: bool,
    max_path_error_mm: Option<f64>,
    despite_errors: DespiteErrors,
    json: String,
    words: String,
}

impl Compensating {
    fn request(&self) -> Request<'_> {
        Request {
            sources: &self.sources,
            language: self.language,
            profile: &self.profile,
            options: self.options.clone(),
            force: self.force,
            max_path_error_mm: self.max_path_error_mm,
            despite_errors: self.despite_errors,
        }
    }

    fn header<'a>(&'a self, prepared: &Prepared<'_>, left_out: &'a LeftOut) -> Header<'a> {
        Header {
            inputs: self
                .sources
                .iter()
                .map(|source| source.name.clone())
                .collect(),
            outputs: Vec::new(),
            written: prepared.will_write(),
            sources: &self.sources,
            language: prepared.language,
            profile_sha256: &self.profile.sha256,
            left_out,
        }
    }

    fn page(&self, made: &str) -> Result<String, Failure> {
        let (request, left_out) = (self.request(), LeftOut::default());
        let prepared = prepare(&request)?;
        let header = self.header(&prepared, &left_out);
        let (compensation, options) = (&prepared.compensation, &request.options);
        let inserted = compensation.added.moves;
        let mut drawing = Drawing::begin(&header, compensation, &self.profile, options, &read);
        if header.written.contains(&true) {
            let language = prepared.language;
            let written = prepared.written()?;
            drawing.say_inserted(inserted);
            let (after, profile) = (&written.sources, &self.profile.profile);
            drawing.add_written(language, after, &self.sources, profile, options);
        }
        Ok(drawing.html(made))
    }
}

impl Reported for Compensating {
    fn json(&self) -> String {
        self.json.clone()
    }

    fn words(&self) -> String {
        self.words.clone()
    }

    fn html(&self, made: &str) -> Option<String> {
        // what was computed once is computed again
        self.page(made).ok()
    }
}

/// Programs with fake targets: the document, whether it is refused, and the files that are written.
#[pyfunction]
#[pyo3(signature = (files, context, profile, *, tools, frames, work_offset=None, joint_targets="keep", decimals=None,
    max_path_error_mm=None, max_derived_error_mm=None, max_shift=None, language=None, force=false, accept=vec![],
    split_targets=false, at_singularity="refuse", method="auto", start_joints_rad=None, despite_errors="nothing"))]
pub(crate) fn compensate<'py>(
    py: Python<'py>,
    files: Files,
    context: Files,
    profile: &Profile,
    tools: Named<'py>,
    frames: Named<'py>,
    work_offset: Option<Numbers<'py>>,
    joint_targets: &str,
    decimals: Option<u8>,
    max_path_error_mm: Option<f64>,
    max_derived_error_mm: Option<f64>,
    max_shift: Option<(f64, f64)>,
    language: Option<&str>,
    force: bool,
    accept: Vec<String>,
    split_targets: bool,
    at_singularity: &str,
    method: &str,
    start_joints_rad: Option<Numbers<'py>>,
    despite_errors: &str,
) -> PyResult<(Document, bool, Written<'py>)> {
    if decimals.is_some_and(|decimals| decimals > 9) {
        return Err(PyValueError::new_err("decimals must be from 0 to 9"));
    }
    if max_shift
        .is_some_and(|(mm, deg)| !(mm > 0.0 && deg > 0.0 && mm.is_finite() && deg.is_finite()))
    {
        return Err(PyValueError::new_err(
            "max_shift must be two finite numbers above 0: mm and degrees",
        ));
    }
    if max_derived_error_mm.is_some_and(|mm| !(mm.is_finite() && mm > 0.0)) {
        let message = "max_derived_error_mm must be a finite number above 0";
        return Err(PyValueError::new_err(message));
    }
    let work_offset = work_offset.map(|array| one_pose("work_offset", &array));
    let options = Options {
        given: given(profile, tools, frames)?,
        work_offset: work_offset.transpose()?,
        correct_joint_targets: word(
            "joint_targets",
            joint_targets,
            &[("keep", false), ("correct", true)],
        )?,
        decimals: decimals.map(usize::from),
        max_derived_error_m: max_derived_error_mm.map(m_from_mm),
        max_shift: max_shift.map(|(mm, deg)| Separation {
            distance_m: m_from_mm(mm),
            angle_rad: deg * DEG,
        }),
        split_targets,
        at_singularity: word(
            "at_singularity",
            at_singularity,
            &[
                ("refuse", AtSingularity::Refuse),
                ("flip", AtSingularity::Flip),
                ("nearest", AtSingularity::Nearest),
            ],
        )?,
        methods: word(
            "method",
            method,
            &[("auto", Methods::Auto), ("pose-shift", Methods::PoseShift)],
        )?,
        accepted: accepted(py, &accept)?,
        start_joints: start_joints(start_joints_rad.as_ref())?,
        ..Options::default()
    };
    let despite_errors = word(
        "despite_errors",
        despite_errors,
        &[
            ("nothing", DespiteErrors::Nothing),
            ("good", DespiteErrors::Good),
            ("all", DespiteErrors::All),
        ],
    )?;
    let mut all = Compensating {
        sources: with_context(&files, &context),
        profile: Arc::clone(&profile.file),
        language: self::language(py, language)?,
        options,
        force,
        max_path_error_mm,
        despite_errors,
        json: String::new(),
        words: String::new(),
    };
    let found = long(py, move |_| -> Result<_, Failure> {
        let (reported, refused, made) = {
            let (request, left_out) = (all.request(), LeftOut::default());
            let prepared = prepare(&request)?;
            let refused = prepared.is_refused();
            let header = all.header(&prepared, &left_out);
            let document = Compensated::new(&header, &prepared.compensation);
            let reported = (
                document.json(),
                compensation_words(&document, prepared.language),
            );
            let mut made = Vec::new();
            if header.written.contains(&true) {
                let written = prepared.written()?;
                let files = written.sources.into_iter().zip(written.is_written);
                made.extend(
                    files
                        .filter(|(_, is_written)| *is_written)
                        .map(|(source, _)| source),
                );
            }
            (reported, refused, made)
        };
        (all.json, all.words) = reported;
        Ok((all, refused, made))
    })?;
    let (all, refused, made) = found.map_err(|failure| Kind::Program.raise(py, &failure))?;
    let made = made
        .into_iter()
        .map(|source| (source.name, PyBytes::new(py, &source.bytes)));
    Ok((Document::new(all), refused, made.collect()))
}

/// A check that can be reported again.
struct Followed {
    sources: Vec<Source>,
    nominal: Option<Vec<Source>>,
    language: Option<&'static dyn Language>,
    profile: Arc<ProfileFile>,
    cell: Option<Source>,
    options: following::Options,
    accepted: Vec<Acceptance>,
    force: bool,
    json: String,
    words: String,
}

impl Followed {
    fn request(&self) -> checking::Request<'_> {
        checking::Request {
            sources: &self.sources,
            nominal: self.nominal.as_deref(),
            language: self.language,
            profile: &self.profile,
            cell: self.cell.as_ref(),
            read: &read,
            options: self.options.clone(),
            accepted: &self.accepted,
            force: self.force,
        }
    }
}

impl Reported for Followed {
    fn json(&self) -> String {
        self.json.clone()
    }

    fn words(&self) -> String {
        self.words.clone()
    }

    fn html(&self, made: &str) -> Option<String> {
        // what was followed once is followed again
        let request = self.request();
        let found = checking::check(&request, &mut |_, _| ()).ok()?;
        Some(check_html(&found, made))
    }
}

/// Where the real robot goes: the document, whether the answer is no, and `JUnit` XML.
#[pyfunction]
#[pyo3(signature = (files, context, profile, *, nominal=None, cell=None, baseline=None, tolerance=0.0005, max_path_error_mm=None,
    orientation="slerp", horizon_mm=100.0, limit_margin_deg=1.0, tools, frames, accept=vec![], start_joints_rad=None, language=None,
    force=false))]
pub(crate) fn check(
    py: Python<'_>,
    files: Files,
    context: Files,
    profile: &Profile,
    nominal: Option<Files>,
    cell: Option<(String, PyBackedBytes)>,
    baseline: Option<(String, String)>,
    tolerance: f64,
    max_path_error_mm: Option<f64>,
    orientation: &str,
    horizon_mm: f64,
    limit_margin_deg: f64,
    tools: Named<'_>,
    frames: Named<'_>,
    accept: Vec<String>,
    start_joints_rad: Option<Numbers<'_>>,
    language: Option<&str>,
    force: bool,
) -> PyResult<(Document, bool, String)> {
    let least = [
        (
            "max_path_error_mm",
            max_path_error_mm.unwrap_or(1.0),
            f64::MIN_POSITIVE,
        ),
        ("horizon_mm", horizon_mm, 0.0),
        ("limit_margin_deg", limit_margin_deg, 0.0),
        ("tolerance", tolerance, 0.0),
    ];
    for (name, value, least) in least {
        if !(value >= least && value.is_finite()) {
            let message = format!("{name} is {value}; it must be a finite number, not negative");
            return Err(PyValueError::new_err(message));
        }
    }
    let mut all = Followed {
        sources: with_context(&files, &context),
        nominal: nominal.map(|nominal| with_context(&nominal, &context)),
        language: self::language(py, language)?,
        profile: Arc::clone(&profile.file),
        cell: cell.map(|(name, bytes)| Source::new(name, bytes.to_vec())),
        options: following::Options {
            given: given(profile, tools, frames)?,
            turning: word(
                "orientation",
                orientation,
                &[
                    ("slerp", ToolRotation::Slerp),
                    ("euler", ToolRotation::Euler),
                ],
            )?,
            max_path_error_m: max_path_error_mm.map(|mm| mm * MM),
            horizon_m: horizon_mm * MM,
            limit_margin_rad: limit_margin_deg * DEG,
            start_joints: start_joints(start_joints_rad.as_ref())?,
            ..following::Options::default()
        },
        accepted: accepted(py, &accept)?,
        force,
        json: String::new(),
        words: String::new(),
    };
    let found = long(py, move |stop: &Stop| -> Result<_, Failure> {
        let (reported, refused, junit) = {
            let request = all.request();
            let found = checking::check(&request, &mut |_, _| stop.here())?;
            let left_out = LeftOut::default();
            let header = found.header(&left_out);
            let run = checking::Checked::new(&header, &found.check, None);
            let comparison = baseline.map(|(name, text)| {
                let compared = run.compare(&text, tolerance);
                compared.map_err(|error| Failure::new(format!("{name}: {error}")))
            });
            let comparison = comparison.transpose()?;
            let worse = comparison.as_ref().is_some_and(|c| !c.worse.is_empty());
            let run = checking::Checked::new(&header, &found.check, comparison.as_ref());
            let reported = (run.json(), check_words(&run));
            (
                reported,
                found.check.is_refused() || worse,
                check_junit(&run),
            )
        };
        (all.json, all.words) = reported;
        Ok((all, refused, junit))
    })?;
    let (all, refused, junit) = found.map_err(|failure| Kind::Check.raise(py, &failure))?;
    Ok((Document::new(all), refused, junit))
}

/// What programs say: the document's text.
#[pyfunction]
#[pyo3(signature = (files, context, profile, *, language=None))]
pub(crate) fn read_program(
    py: Python<'_>,
    files: Files,
    context: Files,
    profile: Option<&Profile>,
    language: Option<&str>,
) -> PyResult<String> {
    let sources = with_context(&files, &context);
    let language = self::language(py, language)?;
    let robot = profile.map(|profile| &profile.file.profile);
    let found = py.detach(|| reading::read(&sources, robot, language).map(|found| found.json()));
    found.map_err(|failure| Kind::Program.raise(py, &failure))
}

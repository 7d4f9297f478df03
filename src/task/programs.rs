//! Programs of one call: their language, what may not be compensated, and why they cannot be read.

use super::failure::Failure;
use super::profile_file::ProfileFile;
use crate::compensate::CompensateError;
use crate::finding::{Acceptance, AcceptanceError, Finding, Severity, TABLE};
use crate::model::effects::Effect;
use crate::model::profile::{ControllerModel, Profile};
use crate::nearest;
use crate::program::{Found, LANGUAGES, Language, Marker, Source, language_of, sha256};
use schemars::JsonSchema;
use serde::Serialize;
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::ffi::OsStr;
use std::path::Path;

/// Files in folders that are no programs of the run.
#[derive(Clone, Debug, Default, Serialize, JsonSchema)]
pub struct LeftOut {
    /// Those that `--ignore` means.
    pub ignored: Vec<String>,
    /// Those whose names end as programs of no language do, or of another than `--language`.
    pub other: Vec<String>,
}

/// The language of this id.
///
/// # Errors
/// There is none.
pub fn language_by_id(id: &str) -> Result<&'static dyn Language, Failure> {
    let found = LANGUAGES.iter().find(|language| language.about().id == id);
    found.copied().ok_or_else(|| {
        let ids = LANGUAGES.iter().map(|known| known.about().id);
        Failure::with_hint(
            format!("no language is called `{id}`"),
            nearest::hint(id, "languages", ids),
        )
    })
}

/// What `--accept` says.
///
/// # Errors
/// No finding has this id, or it is not for the user to take.
pub fn acceptance(text: &str) -> Result<Acceptance, Failure> {
    let lists = "`poseshift explain` lists the findings, and which can be accepted";
    if text.trim().is_empty() {
        return Err(Failure::with_hint("--accept is empty", lists));
    }
    text.parse().map_err(|error: AcceptanceError| {
        let meant = match &error {
            AcceptanceError::Unknown(id) => {
                nearest::hint(id, "findings", TABLE.iter().map(|k| k.id))
            }
            AcceptanceError::Never(..) | AcceptanceError::Line(_) => String::new(),
        };
        Failure::with_hint(
            format!("--accept {text}: {error}"),
            format!("{meant} {lists}").trim_start(),
        )
    })
}

/// The language of all these files, by name and content.
///
/// # Errors
/// A file of no language, files of several, another language than the profile's controller speaks;
/// no file.
pub fn common_language(
    sources: &[Source],
    profile: Option<&Profile>,
) -> Result<&'static dyn Language, Failure> {
    let mut common: Option<(&'static dyn Language, &str)> = None;
    for source in sources {
        let Some(language) = language_of(source) else {
            let hint = "`poseshift languages` lists what is recognised; --language says what it is";
            return Err(Failure::with_hint(
                format!("{}: not a robot program of a known language", source.name),
                hint,
            ));
        };
        match common {
            Some((first, name)) if first.about().id != language.about().id => {
                return Err(Failure::new(format!(
                    "{name} is {} and {} is {}: programs of one call have one language",
                    first.about().name,
                    source.name,
                    language.about().name
                )));
            }
            _ => common = Some((language, &source.name)),
        }
    }
    let (language, name) = common.ok_or_else(|| Failure::new("no program files"))?;
    match profile.and_then(|profile| profile.language.as_ref()) {
        Some(of_profile)
            if of_profile != language.about().id
                && of_profile != "csv"
                && language.about().id != "csv" =>
        {
            language_by_id(of_profile).map_err(|error| {
                Failure::with_hint(
                    format!("controller.language of the profile: {}", error.message),
                    error.hint,
                )
            })?;
            Err(Failure::with_hint(
                format!(
                    "{name} is {}, and the profile's controller speaks {of_profile}",
                    language.about().name
                ),
                "is it the profile of this robot? --language overrides",
            ))
        }
        _ => Ok(language),
    }
}

/// A profile whose calibration cannot be meant.
///
/// # Errors
/// A calibrated controller without the effects that it applies.
pub fn refuse_unlikely(file: &ProfileFile) -> Result<(), Failure> {
    let profile = &file.profile;
    let nothing = profile.effects.iter().all(Effect::is_zero);
    // with its own effects the real arm is taken as the controller's: nothing changes
    if profile.controller == ControllerModel::Calibrated && profile.own_effects.is_none() && nothing
    {
        let message = format!(
            "{}: the controller is calibrated itself, and the profile has no effects to apply",
            file.name
        );
        let hint = "a calibrated controller needs the effects that it applies \
            (`controller.effects`; of a UR, `poseshift profile \
                    import-ur`) and those of the real arm";
        return Err(Failure::with_hint(message, hint));
    }
    Ok(())
}

/// Programs that are compensated already.
///
/// # Errors
/// One of them is.
pub fn refuse_marked(sources: &[Source]) -> Result<(), Failure> {
    for source in sources.iter().filter(|source| !source.is_context) {
        if let Some(offset) = Marker::find(&source.bytes) {
            let (line, column) = source.line_column(offset);
            let hint = "compensate the original instead; --force compensates once more";
            return Err(Failure::at(
                source,
                line,
                column,
                None,
                "this file is already compensated",
                hint,
            ));
        }
    }
    Ok(())
}

/// Digits of a hash that a message shows.
const SHOWN: usize = 16;

/// That compensated programs were made with this profile from these originals, as their markers
/// say: each from the one that it is compared with.
///
/// # Errors
/// A marker names another profile or another original.
pub fn refuse_other_origin(
    sources: &[Source],
    originals: &[Source],
    profile: &ProfileFile,
) -> Result<(), Failure> {
    let short = |digits: &str| digits[..digits.len().min(SHOWN)].to_owned();
    let hashes: Vec<String> = originals.iter().map(|of| sha256(&of.bytes)).collect();
    let own = |all: &[Source]| -> Vec<usize> {
        (0..all.len()).filter(|at| !all[*at].is_context).collect()
    };
    let (ours, theirs) = (own(sources), own(originals));
    for (at, source) in ours.iter().map(|at| &sources[*at]).enumerate() {
        let found = Found::of(&source.bytes);
        let Some(offset) = found.offset else {
            continue;
        };
        let (line, column) = source.line_column(offset);
        let fail = |message: String, what: &str| {
            let hint =
                format!("give the {what} that it was made with; --force compares all the same");
            Err(Failure::at(source, line, column, None, message, &hint))
        };
        let begins = |hash: &str, all: &[String]| {
            let mut all = all.iter();
            all.any(|digits| hash.starts_with(digits.as_str()))
        };
        for (hashes, what) in [
            (&found.profiles, "profile"),
            (&found.sources, "original program"),
        ] {
            if hashes.is_empty() {
                let message = format!(
                    "this file is compensated, and the line of its marker with the SHA-256 of its \
                     {what} is missing: nothing tells whether that is the one given"
                );
                return fail(message, what);
            }
        }
        if !begins(&profile.sha256, &found.profiles) {
            let message = format!(
                "this file was compensated with a profile of SHA-256 {}…; {} has {}…",
                short(&found.profiles[0]),
                profile.name,
                short(&profile.sha256)
            );
            return fail(message, "profile");
        }
        let compared = if ours.len() == theirs.len() {
            vec![theirs[at]]
        } else {
            of_name(&source.name, originals)
        };
        let known = |of: &usize| begins(&hashes[*of], &found.sources);
        if !compared.iter().any(known) {
            let each = compared.iter().take(3);
            let each: Vec<String> = each
                .map(|of| format!("{} has {}…", originals[*of].name, short(&hashes[*of])))
                .collect();
            let message = format!(
                "this file was made from a program of SHA-256 {}…; {}",
                short(&found.sources[0]),
                each.join(", ")
            );
            return fail(message, "original program");
        }
    }
    Ok(())
}

/// Originals in the order of the programs that are compared with them: of each the one that its
/// marker names, else the one whose path ends most alike. Other numbers of files stay as they are.
///
/// # Errors
/// Nothing tells which original is that of a program, or two programs have the same.
pub fn paired<'a>(
    sources: &[Source],
    originals: &'a [Source],
) -> Result<Cow<'a, [Source]>, Failure> {
    let own = |all: &[Source]| -> Vec<usize> {
        (0..all.len()).filter(|at| !all[*at].is_context).collect()
    };
    let (ours, theirs) = (own(sources), own(originals));
    if ours.len() < 2 || ours.len() != theirs.len() {
        return Ok(Cow::Borrowed(originals));
    }
    let hashes: Vec<String> = originals.iter().map(|of| sha256(&of.bytes)).collect();
    let mut order: Vec<usize> = Vec::with_capacity(originals.len());
    let mut taken: BTreeMap<usize, usize> = BTreeMap::new();
    for &at in &ours {
        let source = &sources[at];
        let found = Found::of(&source.bytes);
        let is_named = |of: &usize| {
            let mut named = found.sources.iter();
            named.any(|digits| hashes[*of].starts_with(digits.as_str()))
        };
        let named: Vec<usize> = theirs.iter().copied().filter(is_named).collect();
        let among = if named.is_empty() { &theirs } else { &named };
        let likeness = |of: &&usize| alike_at_the_end(&originals[**of].name, &source.name);
        let most = among.iter().map(|of| likeness(&of)).max().unwrap_or(0);
        let is_called = |of: &&usize| most > 0 && likeness(of) == most;
        let mut fitting: Vec<usize> = among.iter().filter(is_called).copied().collect();
        if let [only] = named[..] {
            fitting = vec![only];
        }
        let hint = "give each original the file name of its program, or check one program at a time; \
            --force compares them in their order";
        let [original] = fitting[..] else {
            let named = if fitting.is_empty() {
                &theirs
            } else {
                &fitting
            };
            let named = named.iter().take(3).map(|of| originals[*of].name.as_str());
            let message = format!(
                "{}: nothing tells which program of --nominal is its original: {}",
                source.name,
                named.collect::<Vec<_>>().join(", ")
            );
            return Err(Failure::with_hint(message, hint));
        };
        if let Some(other) = taken.insert(original, at) {
            let message = format!(
                "{} and {} have the same original, {}",
                sources[other].name, source.name, originals[original].name
            );
            return Err(Failure::with_hint(message, hint));
        }
        order.push(original);
    }
    order.extend((0..originals.len()).filter(|at| !taken.contains_key(at)));
    Ok(order.into_iter().map(|at| originals[at].clone()).collect())
}

/// How many of the last parts of two paths are the same.
fn alike_at_the_end(a: &str, b: &str) -> usize {
    let parts = |path| Path::new(path).components().rev();
    let both = parts(a).zip(parts(b));
    both.take_while(|(a, b)| a == b).count()
}

/// That originals are not compensated programs, and what is compared with them the originals.
///
/// # Errors
/// One is.
pub fn refuse_swapped(sources: &[Source], originals: &[Source]) -> Result<(), Failure> {
    let own = |all: &&Source| !all.is_context;
    let marked = |source: &&Source| Marker::find(&source.bytes).is_some();
    if sources.iter().filter(own).any(|source| marked(&source)) {
        return Ok(());
    }
    match originals.iter().filter(own).find(marked) {
        Some(original) => Err(Failure::with_hint(
            format!(
                "{}: --nominal takes original programs, and this one is compensated",
                original.name
            ),
            "give the compensated program first and the original behind --nominal; --force \
             compares all the same",
        )),
        None => Ok(()),
    }
}

/// A warning for each compensated program that is compared with nothing but itself: its targets are
/// fake ones.
pub fn compared_with_itself(sources: &[Source]) -> Vec<Finding> {
    let own = sources.iter().filter(|source| !source.is_context);
    let found = own.filter_map(|source| {
        let offset = Marker::find(&source.bytes)?;
        let message = "this program is compensated: its targets are not where the tool is wanted, \
            and the errors below are those from its own targets";
        Some(source.finding(
            offset,
            "nominal-missing",
            Severity::Warning,
            message.into(),
            "--nominal ORIGINAL compares with the program that it was made from",
        ))
    });
    found.collect()
}

/// That programs for a part that was moved are compared with where it was.
#[must_use]
pub fn compared_where_it_was(sources: &[Source]) -> Vec<Finding> {
    let own = sources.iter().filter(|source| !source.is_context);
    let found = own.filter_map(|source| {
        let found = Found::of(&source.bytes);
        let (offset, by) = (found.offset?, found.moved?);
        let message = format!(
            "this program was compensated for a part that was moved by {by} (--work-offset), and is \
             compared with where the original has it: that is in the errors below"
        );
        Some(source.finding(
            offset,
            "part-moved",
            Severity::Warning,
            message,
            "compare a file that was compensated without --work-offset",
        ))
    });
    found.collect()
}

/// The programs whose files are called so, in whatever folder; all of them where there is none.
fn of_name(name: &str, programs: &[Source]) -> Vec<usize> {
    let file = |name: &str| Path::new(name).file_name().map(OsStr::to_owned);
    let alike = |at: &usize| file(&programs[*at].name) == file(name);
    let found: Vec<usize> = (0..programs.len()).filter(alike).collect();
    if found.is_empty() {
        (0..programs.len()).collect()
    } else {
        found
    }
}

/// Why programs cannot be compensated, with the place in their text.
pub fn explain(error: &CompensateError, sources: &[Source]) -> Failure {
    let source_of = |file: &str| sources.iter().find(|source| source.name == file);
    match error {
        CompensateError::Read(read) => {
            let (file, line, column) = read.place();
            match source_of(file) {
                Some(source) if line > 0 => {
                    Failure::at(source, line, column, None, read.message(), "")
                }
                _ => Failure::new(read.to_string()),
            }
        }
        CompensateError::Placement(unknown) => match source_of(&unknown.missing[0].file) {
            Some(source) => Failure::at(
                source,
                unknown.missing[0].line,
                unknown.missing[0].column,
                None,
                unknown.message(),
                unknown.hint(),
            ),
            None => Failure::with_hint(unknown.to_string(), unknown.hint()),
        },
        CompensateError::Refused(finding) => match source_of(&finding.file) {
            Some(source) => Failure::at(
                source,
                finding.line,
                finding.column,
                None,
                &finding.message,
                &finding.hint,
            ),
            None => Failure::with_hint(error.to_string(), &finding.hint),
        },
        CompensateError::MeasuredFrame(error) => {
            Failure::with_hint(format!("--wobj: {error}"), error.hint())
        }
        CompensateError::Given(error) => Failure::with_hint(error.to_string(), error.hint()),
        CompensateError::OutOfBounds(error) => Failure::with_hint(
            error.to_string(),
            "is it in the unit of the language (metres in URScript, else millimetres; kg)?",
        ),
        CompensateError::Arm(unsupported) => Failure::new(unsupported.to_string()),
        CompensateError::NothingToCorrect => Failure::with_hint(
            error.to_string(),
            "`poseshift calibrate` identifies effects; with --work-offset the part is moved \
             without any",
        ),
        CompensateError::OffsetOnPositioner { .. } => Failure::with_hint(
            error.to_string(),
            "correct the work frame on the plate, in program and controller; or compensate the \
             moves of each angle as a program of their own, with the offset at that angle",
        ),
        CompensateError::BaseElsewhere { .. } => Failure::with_hint(
            error.to_string(),
            "kinematics.base is where the controller has the robot, not where a measuring device \
             saw it: write the controller's there \
             (`poseshift profile set`), or calibrate again with --base controller; nothing is \
                 written",
        ),
        CompensateError::RailElsewhere { .. } => Failure::with_hint(
            error.to_string(),
            "correct `direction` of the track, or `kinematics.base`, in the profile",
        ),
        CompensateError::NothingInReach { .. } => Failure::with_hint(
            error.to_string(),
            "check the tool and the work frame, too; nothing is written",
        ),
    }
}

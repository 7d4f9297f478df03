//! `profile import-ur`: the factory calibration of a Universal Robots arm into its profile.

use super::failure::Failure;
use super::layout::print_text;
use super::{Answer, Output, files, print_json};
use crate::model::effects::Kind;
use crate::model::profile::{Profile, universal_robots, with_controller};
use crate::program::Source;
use crate::report::profile::typical_deviation_of;
use clap::Args;
use serde_json::json;
use std::path::{Path, PathBuf};

/// Put the factory calibration of a Universal Robots arm into its profile, as what the controller computes with
#[derive(Args)]
pub struct ImportUr {
    /// The controller's calibration.conf, or the `kinematics:` file that the ROS driver's package for it writes
    calibration: PathBuf,
    /// The nominal profile of this type of arm
    #[arg(long, value_name = "NOMINAL")]
    profile: PathBuf,
    /// Where to write the profile
    #[arg(short, long, value_name = "OUT")]
    output: PathBuf,
}

impl ImportUr {
    pub fn run(&self, output: Output) -> Result<Answer, Failure> {
        if self.output.exists() {
            return Err(Failure::new(format!(
                "{} exists; profiles are not written over",
                self.output.display()
            )));
        }
        let profile_text = files::read_text(&self.profile)?;
        let (profile, _) = files::read_profile(&self.profile)?;
        let geometry_missing = !profile.effects.is_empty()
            && profile
                .effects
                .iter()
                .all(|effect| effect.kind != Kind::LinkGeometry);
        if geometry_missing {
            return Err(Failure::with_hint(
                format!(
                    "{}: its calibration has effects, but no link geometry; compensation would undo the controller's own",
                    self.profile.display()
                ),
                "import into a profile without a calibration, then calibrate",
            ));
        }
        let text = files::read_text(&self.calibration)?;
        let effects = universal_robots::link_geometry(&text, &profile)
            .map_err(|error| failure(&self.calibration, &text, &error))?;
        let bytes = text.as_bytes();
        let note = format!(
            "factory calibration, imported from a file with SHA-256 {}",
            files::sha256(bytes)
        );
        let written =
            with_controller(&profile_text, &profile, &effects, &note).ok_or_else(|| {
                Failure::with_hint(
                    format!(
                        "{}: cannot tell where `controller` starts and ends",
                        self.profile.display()
                    ),
                    "write it as a block of its own lines, as the built-in profiles have it",
                )
            })?;
        let imported = Profile::from_yaml(&written)
            .map_err(|error| Failure::profile(&self.output, &written, &error))?;
        let nominal = Profile {
            effects: Vec::new(),
            own_effects: None,
            ..profile
        };
        let deviation = typical_deviation_of(&imported, &nominal);
        files::write_all(&[(self.output.clone(), written.into_bytes())])?;
        if output.json {
            print_json(&json!({
                "poseshift": "import-ur/1", "output": self.output.display().to_string(),
                "effects": effects.iter().map(|e| e.to_entry().into_iter().collect::<std::collections::BTreeMap<_, _>>())
                    .collect::<Vec<_>>(),
                "deviation": {"mean_mm": deviation.mean_mm, "max_mm": deviation.max_mm, "postures": deviation.postures},
            }))?;
        } else if !output.quiet {
            print_text(&format!(
                "written to {}: the controller's chain is {:.3} mm (mean), at most {:.3} mm, beside the nominal one over {} \
                 random postures\n",
                self.output.display(),
                deviation.mean_mm,
                deviation.max_mm,
                deviation.postures
            ))?;
        }
        Ok(Answer::Yes)
    }
}

fn failure(path: &Path, text: &str, error: &universal_robots::UrError) -> Failure {
    let source = Source::new(path.display().to_string(), text.as_bytes().to_vec());
    let length = source.line(error.line().saturating_sub(1)).map(<[u8]>::len);
    Failure::at(
        &source,
        error.line(),
        1,
        length,
        error.to_string(),
        error.hint().into(),
    )
}

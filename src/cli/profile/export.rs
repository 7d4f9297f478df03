//! `profile export`.

use super::super::ending::{Ending, finish, print_table};
use super::super::files::Files;
use super::super::{Answer, Output};
use super::{Over, make};
use crate::printable::name_of;
use crate::task::Failure;
use crate::task::profile::{Form, export};
use clap::Args;
use std::path::PathBuf;

/// Write the real arm as other programs read it, with what the form does not carry and how large
/// that is
#[derive(Args)]
#[command(
    after_help = "With --json and no form, the JSON has the geometry with what was identified of \
        it, and every effect."
)]
pub(super) struct Export {
    /// The profile
    profile: PathBuf,
    #[command(flatten)]
    form: Forms,
    /// Where to write it (default: standard output)
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    #[command(flatten)]
    over: Over,
}

#[derive(Args)]
#[group(multiple = false)]
struct Forms {
    /// A URDF
    #[arg(long)]
    urdf: bool,
    /// Classic Denavit-Hartenberg parameters: Rz(theta) Tz(d) Tx(a) Rx(alpha)
    #[arg(long)]
    dh_csv: bool,
    /// Modified ones: Rx(alpha) Tx(a) Ry(beta) Rz(theta) Tz(d)
    #[arg(long)]
    mdh_csv: bool,
    /// The kinematics file of the ROS driver of Universal Robots
    #[arg(long)]
    ur_kinematics: bool,
}

impl Forms {
    fn chosen(&self) -> Option<Form> {
        let forms = [
            (self.urdf, Form::Urdf),
            (self.dh_csv, Form::DhCsv),
            (self.mdh_csv, Form::MdhCsv),
            (self.ur_kinematics, Form::UrKinematics),
        ];
        let chosen = forms.into_iter().find(|(is_given, _)| *is_given);
        chosen.map(|(_, form)| form)
    }
}

impl Export {
    pub(super) fn run(&self, files: &Files, output: Output) -> Result<Answer, Failure> {
        let form = self.form.chosen();
        if form.is_none() && (self.output.is_some() || !output.json) {
            return Err(Failure::with_hint(
                "no form is given",
                "--urdf, --dh-csv, --mdh-csv or --ur-kinematics; --json alone prints the geometry",
            ));
        }
        let mut found = export(&files.profile(&self.profile)?, form)?;
        let Some(path) = &self.output else {
            return if form.is_none() {
                finish(files, &found, Ending::default(), output)
            } else {
                print_table(&found, output, Answer::Yes)
            };
        };
        found.output = Some(name_of(path));
        let text = found.text.take().unwrap_or_default();
        make(files, (path, self.over), &text, &found, output)
    }
}

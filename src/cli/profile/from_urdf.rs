//! `profile from-urdf`.

use super::super::ending::print_table;
use super::super::files::Files;
use super::super::progress::Progress;
use super::super::{Answer, Output};
use super::{Over, make};
use crate::printable::name_of;
use crate::program::Source;
use crate::task::profile::{Inputs, from_urdf, tool};
use crate::task::{Failure, text};
use crate::urdf::{Choice, is_xacro};
use clap::Args;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Make a profile of a URDF: its six axes, limits, masses and collision shapes
#[derive(Args)]
pub(super) struct FromUrdf {
    /// The URDF, or a xacro file where xacro is installed
    file: PathBuf,
    /// The link where the world is (default: base, where the controller counts from, else the link
    /// without a parent)
    #[arg(long, value_name = "LINK")]
    base: Option<String>,
    /// The link that tools are mounted on (default: tool0, flange as the maker names it, or the
    /// only end)
    #[arg(long, value_name = "LINK")]
    tip: Option<String>,
    /// The maker (default: the one whose name stands in the file); FANUC's J3 is counted together
    /// with J2
    #[arg(long, value_name = "MAKER")]
    maker: Option<String>,
    /// The language of the controller (default: that of the maker's controllers)
    #[arg(long, value_name = "LANGUAGE")]
    language: Option<String>,
    /// The serial number
    #[arg(long, value_name = "NUMBER")]
    serial: Option<String>,
    /// A tool on the flange in mm, degrees, kg, and mm of the centre of gravity; several times for
    /// several
    #[arg(
        long = "tool",
        value_name = "NAME=X,Y,Z,RX,RY,RZ[,KG[,CX,CY,CZ]]",
        allow_hyphen_values = true
    )]
    tools: Vec<String>,
    /// Take angles near a multiple of 45 degrees, and axes that are nearly parallel, as they are
    /// written: files with three decimals write 1.571
    #[arg(long)]
    exact_angles: bool,
    /// What xacro is given with a xacro file
    #[arg(long = "xacro-arg", value_name = "NAME:=VALUE")]
    xacro_arguments: Vec<String>,
    /// Where packages are: a folder that holds them, or NAME=FOLDER of one
    #[arg(long, value_name = "[NAME=]FOLDER")]
    package_path: Vec<String>,
    /// Leave the collision shapes out
    #[arg(long)]
    no_shapes: bool,
    /// Where to write it (default: standard output)
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    #[command(flatten)]
    over: Over,
}

impl FromUrdf {
    pub(super) fn run(&self, files: &Files, output: Output) -> Result<Answer, Failure> {
        let origin = self.file.file_name().unwrap_or_default().to_string_lossy();
        let mut tools = BTreeMap::new();
        for text in &self.tools {
            let (name, tool) = tool(text)?;
            if tools.insert(name.clone(), tool).is_some() {
                return Err(Failure::new(format!("--tool {name} is given twice")));
            }
        }
        let progress = Progress::new(output, "reading");
        let mut found = from_urdf(&Inputs {
            urdf: &self.urdf(files)?,
            origin: &origin,
            choice: Choice {
                base: self.base.clone(),
                tip: self.tip.clone(),
                shapes: !self.no_shapes,
                exact: self.exact_angles,
            },
            meshes: &|file| self.mesh(file),
            about: [&self.maker, &self.language, &self.serial].map(Option::as_deref),
            tools,
        })?;
        drop(progress);
        let Some(path) = &self.output else {
            return print_table(&found, output, Answer::Yes);
        };
        found.output = Some(name_of(path));
        make(files, (path, self.over), &found.profile, &found, output)
    }

    /// The URDF, macros expanded where there is a program for it.
    fn urdf(&self, files: &Files) -> Result<Source, Failure> {
        let file = files.source(&self.file)?;
        if !text(&file).is_ok_and(|text| is_xacro(&text)) {
            return Ok(file);
        }
        let run = Command::new("xacro")
            .arg(&self.file)
            .args(&self.xacro_arguments)
            .output();
        let run = match run {
            Ok(run) => run,
            // without the program it is what it is: a xacro file
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(file),
            Err(error) => return Err(Failure::new(format!("cannot start xacro: {error}"))),
        };
        if !run.status.success() {
            let said = String::from_utf8_lossy(&run.stderr);
            let said: Vec<&str> = said
                .lines()
                .filter(|line| !line.trim().is_empty())
                .collect();
            let last = &said[said.len().saturating_sub(4)..];
            return Err(Failure::with_hint(
                format!("xacro cannot expand {}: {}", file.name, last.join("; ")),
                "--xacro-arg NAME:=VALUE gives what the file asks for; packages are found where \
                 ROS_PACKAGE_PATH or a sourced ROS has them",
            ));
        }
        Ok(Source::new(file.name, run.stdout))
    }

    /// Where a mesh is, seen from the profile; `None` where it is not.
    fn mesh(&self, file: &str) -> Option<String> {
        let folder = self.file.parent().unwrap_or(Path::new(""));
        let candidates: Vec<PathBuf> = if let Some(rest) = file.strip_prefix("package://") {
            let (package, inside) = rest.split_once('/')?;
            let place = |given: &String| match given.split_once('=') {
                Some((name, folder)) if name == package => Some(Path::new(folder).join(inside)),
                Some(_) => None,
                None => Some(Path::new(given).join(rest)),
            };
            // the package that the file itself is in, and those next to it
            let whole = std::fs::canonicalize(&self.file).ok()?;
            let own = whole.ancestors().skip(1).map(|above| above.join(rest));
            let given = self.package_path.iter().filter_map(place);
            given.chain(own).collect()
        } else {
            let plain = file.strip_prefix("file://").unwrap_or(file);
            vec![folder.join(plain)]
        };
        let found = candidates.into_iter().find(|path| path.is_file())?;
        let found = std::fs::canonicalize(&found).ok()?;
        // profiles name meshes relative to themselves
        let profile = self.output.as_deref().and_then(Path::parent);
        let profile = profile.filter(|folder| !folder.as_os_str().is_empty());
        let profile = std::fs::canonicalize(profile.unwrap_or(Path::new("."))).ok()?;
        let seen = pathdiff::diff_paths(&found, &profile).unwrap_or(found);
        Some(seen.display().to_string())
    }
}

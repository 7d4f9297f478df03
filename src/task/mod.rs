//! What a command does, without its arguments, its printing, and where its files are: plain options
//! and bytes in, one structure out. One file a command; whatever shows the result (text, JSON, a
//! page) reads that one structure.
//!
//! A structure is a [`Document`]: it serialises to the JSON of `--json`, and [`schema()`] is the
//! JSON Schema of it. Lengths in it are mm and angles degrees, as in files.
//!
//! # Example
//!
//! ```
//! use poseshift::program::Source;
//! use poseshift::task::{ProfileFile, fk};
//!
//! let yaml = include_bytes!("../../robots/abb_irb120_thesis.yaml");
//! let profile = ProfileFile::read(&Source::new("irb120.yaml", yaml.to_vec()))?;
//! let joints = Source::new("joints.csv", b"q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg\n0,10,20,0,30,0\n".to_vec());
//! let poses = fk::fk(&profile, &joints, &fk::Options::default())?;
//! assert_eq!(poses.poses.len(), 1);
//! # Ok::<(), poseshift::task::Failure>(())
//! ```

pub mod axes;
pub mod calibrate;
pub mod catalogue;
pub mod check;
mod circumstances;
mod clock;
pub mod compensate;
mod copies;
pub mod diagnose;
pub mod drift;
pub mod explain;
mod failure;
pub mod fk;
pub mod handeye;
pub mod hexapod;
pub mod ik;
mod measurements;
pub mod meshes;
pub mod parts;
pub mod plan;
pub mod profile;
mod profile_file;
pub mod programs;
pub mod reading;
pub mod register;
mod schema;
pub mod shell;
pub mod simulate;
mod table;
pub mod validate;

pub use failure::{Blame, Excerpt, Failure};
pub use measurements::{Rows, Said};
pub use profile_file::{ProfileFile, frame, text};
pub use schema::{SCHEMAS, schema, schemas};

use schemars::JsonSchema;
use serde::Serialize;
use std::io::{self, Write};

/// The program and its version, as provenance names it.
pub(crate) const PROGRAM: &str = concat!("poseshift ", env!("CARGO_PKG_VERSION"));

/// What a command found: one JSON document.
pub trait Document: Serialize + JsonSchema + Sized {
    /// Name and version of the format: the value of the first key, `poseshift`.
    const KIND: &'static str;

    /// The document as JSON text, its kind first.
    fn json(&self) -> String {
        let mut text = Vec::new();
        self.write_json(&mut text)
            .expect("a report holds only finite numbers and text keys");
        String::from_utf8(text).expect("JSON is UTF-8")
    }

    /// Writes that text row by row: of a long program it is not in memory at once.
    ///
    /// # Errors
    /// Where nothing more can be written.
    fn write_json(&self, mut out: &mut dyn Write) -> io::Result<()> {
        #[derive(Serialize)]
        struct Kinded<'a, D> {
            poseshift: &'static str,
            #[serde(flatten)]
            document: &'a D,
        }
        let kinded = Kinded {
            poseshift: Self::KIND,
            document: self,
        };
        serde_json::to_writer_pretty(&mut out, &kinded)?;
        writeln!(out)
    }
}

//! `schema`: the JSON Schema of a file or a report.

use super::ending::{Said, deliver, print_schema};
use super::files::Files;
use super::{Answer, Output, layout, screen};
use crate::nearest;
use crate::task::{Failure, SCHEMAS, schemas};
use clap::Args;

/// Print the JSON Schema of a file or a report; without a name, the names
#[derive(Args)]
pub(super) struct Schema {
    /// A format: what stands before the `/` of its first key, `poseshift`
    name: Option<String>,
}

impl Schema {
    pub(super) fn run(&self, output: Output) -> Result<Answer, Failure> {
        let Some(name) = &self.name else {
            if output.json {
                let said = Said::json(&schemas())?;
                return deliver(&Files::default(), &[], said, Answer::Yes);
            }
            let lines = SCHEMAS
                .iter()
                .map(|format| format!("{:14} {}\n", format.name, format.what));
            screen::print(&layout::fitted(&lines.collect::<String>()))?;
            return Ok(Answer::Yes);
        };
        let name = name.split('/').next().unwrap_or_default();
        let format = SCHEMAS.iter().find(|format| format.name == name);
        let format = format.ok_or_else(|| {
            let names = SCHEMAS.iter().map(|format| format.name);
            Failure::with_hint(
                format!("no format is called `{name}`"),
                nearest::hint(name, "formats", names),
            )
        })?;
        print_schema(&(format.schema)())
    }
}

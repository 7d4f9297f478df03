//! What is wrong with targets, moves and frames, in words.

use crate::finding::{Finding, Severity};
use crate::program::{Program, Source, TargetId};
use std::collections::HashSet;

/// Why a target has to stay as it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Cause {
    Assigned,
    Expressions,
    JointExpressions,
    Computed,
    Passed,
    NotInFile,
    FrameAssigned,
    FrameComputed,
    ToolSeveral,
    Offset,
    Streamed,
}

impl Cause {
    /// Stable name, severity, what is wrong, and the way out.
    pub fn words(self) -> (&'static str, Severity, &'static str, &'static str) {
        match self {
            Self::Assigned => (
                "target-assigned-at-run-time",
                Severity::Error,
                "this variable is assigned more than once",
                "give each position a variable of its own",
            ),
            Self::Expressions => (
                "target-has-expressions",
                Severity::Error,
                "parts of this target are expressions, not numbers",
                "write the target with numbers in the offline system",
            ),
            Self::JointExpressions => (
                "joints-have-expressions",
                Severity::Warning,
                "parts of these joints are expressions, not numbers: they stay as they are",
                "",
            ),
            Self::Computed => (
                "computed-target",
                Severity::Error,
                "where this move goes is known at run time only; it is not compensated",
                "write the target with numbers, or as pose_trans or pose_add of them",
            ),
            Self::Passed => (
                "target-passed-to-function",
                Severity::Error,
                "this move goes to a parameter of its function; it is not compensated",
                "write the target in the move",
            ),
            Self::NotInFile => (
                "target-not-in-file",
                Severity::Error,
                "the file does not assign this variable; the move is not compensated",
                "save the program together with the installation's variables",
            ),
            Self::FrameAssigned => (
                "frame-assigned-at-run-time",
                Severity::Error,
                "the feature of this target is assigned more than once",
                "assign it once, with numbers",
            ),
            Self::FrameComputed => (
                "frame-known-at-run-time",
                Severity::Error,
                "only the running program knows the feature of this target",
                "assign the feature once, with numbers",
            ),
            Self::ToolSeveral => (
                "tool-known-at-run-time",
                Severity::Error,
                "more than one tool may be set here, or one that only the running program knows",
                "call set_tcp with numbers in the same function before the move",
            ),
            Self::Offset => (
                "target-used-as-offset",
                Severity::Error,
                "this target is the offset of another one too; compensating it would change that one",
                "give the offset a variable of its own",
            ),
            Self::Streamed => (
                "streamed-motion",
                Severity::Error,
                "servoing to poses is not compensated",
                "use movel or movej, or servoj with joints",
            ),
        }
    }
}

/// Collects findings of one file.
#[derive(Debug)]
pub struct Report<'a> {
    source: &'a Source,
    said: HashSet<(TargetId, Cause)>,
}

impl<'a> Report<'a> {
    pub fn new(source: &'a Source) -> Self {
        Self {
            source,
            said: HashSet::new(),
        }
    }

    /// The target has to stay as it is; `because` is where the program says so.
    pub fn block(&mut self, program: &mut Program, target: TargetId, cause: Cause, because: u32) {
        if !self.said.insert((target, cause)) {
            return;
        }
        let blocked = &mut program.targets[target];
        blocked.blocked = true;
        let at = blocked.offset;
        let (id, severity, wrong, hint) = cause.words();
        let see = if because == at {
            String::new()
        } else {
            let (line, _) = self.source.line_column(because as usize);
            format!(" (see line {line})")
        };
        let name = blocked.name.as_ref().map(|name| format!("`{name}`: "));
        let message = format!("{}{wrong}{see}", name.unwrap_or_default());
        self.say(program, id, severity, at, message, hint);
    }

    pub fn say(
        &self,
        program: &mut Program,
        id: &'static str,
        severity: Severity,
        offset: u32,
        message: String,
        hint: &str,
    ) {
        let (line, column) = self.source.line_column(offset as usize);
        program.findings.push(Finding {
            id,
            severity,
            file: self.source.name.clone(),
            line,
            column,
            message,
            hint: hint.to_owned(),
        });
    }
}

//! What people read of results: texts and pages, made of the structures of [`task`](crate::task)
//! whose JSON is for programs.

pub(crate) mod check;
pub(crate) mod compensation;
pub(crate) mod findings;
pub(crate) mod html;
mod junit;
pub(crate) mod layout;
mod text;

pub use html::programs::Drawing;

use crate::finding::Finding;
use crate::program::Language;
use crate::task::Document;
use crate::task::check::{Checked, Checking};
use crate::task::compensate::Compensated;
use crate::task::parts::Pose;
use crate::task::programs::LeftOut;
use html::page::Page;

/// What people read of a result.
pub trait Readable: Document {
    /// The text, without the findings.
    fn words(&self) -> String;

    /// The page as one HTML file that needs no network; `None` of a result that there is nothing to
    /// look at of. `made` says at its foot when and by what it was made.
    fn html(&self, made: &str) -> Option<String>;
}

impl<R: Report> Readable for R {
    fn words(&self) -> String {
        self.text(Style {
            width: usize::MAX,
            every: true,
        })
    }

    fn html(&self, made: &str) -> Option<String> {
        Some(self.page()?.html(made))
    }
}

/// The page of a check, as [`Readable::html`].
#[must_use]
pub fn check_html(of: &Checking, made: &str) -> String {
    let left_out = LeftOut::default();
    html::programs::check_page(of, &of.header(&left_out), 0).html(made)
}

/// The text of a check, as [`Readable::words`].
#[must_use]
pub fn check_words(of: &Checked) -> String {
    check::text(of)
}

/// The text of a compensation, as [`Readable::words`].
#[must_use]
pub fn compensation_words(of: &Compensated, language: &dyn Language) -> String {
    compensation::text(of, language)
}

/// `JUnit` XML of a check, for build servers.
#[must_use]
pub fn check_junit(of: &Checked) -> String {
    check::junit(of, of.baseline)
}

/// How a text is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Style {
    /// Columns that a line may have.
    pub width: usize,
    /// Everything, not only the first of many.
    pub every: bool,
}

/// A result that people read: its text and, where there is something to look at, its page.
pub(crate) trait Report: Document {
    /// The text.
    fn text(&self, style: Style) -> String;

    /// The page; `None` of a result that there is nothing to look at of.
    fn page(&self) -> Option<Page> {
        None
    }

    /// The frames that it found, by name, for a teach pendant.
    fn frames(&self) -> Vec<(String, Pose)> {
        Vec::new()
    }

    /// What a person should look at.
    fn findings(&self) -> &[Finding] {
        &[]
    }
}

/// Probabilities below this are said to be so: a number may be too small to be held.
pub(crate) const LEAST_PROBABILITY: f64 = 1e-300;

/// Text between the tags of HTML and XML, or in the quotes of an attribute; signs that neither has
/// are left out.
fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '<' => out += "&lt;",
            '>' => out += "&gt;",
            '&' => out += "&amp;",
            '"' => out += "&quot;",
            '\'' => out += "&#39;",
            '\t' | '\n' | '\r' => out.push(letter),
            c if c.is_control() => {}
            c => out.push(c),
        }
    }
    out
}

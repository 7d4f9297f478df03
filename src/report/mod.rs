//! What commands tell people: texts and pages, made of the structures of [`task`](crate::task) whose JSON is for programs.

pub(crate) mod check;
pub(crate) mod compensation;
pub(crate) mod findings;
pub(crate) mod html;
mod junit;
pub(crate) mod layout;
mod text;

use crate::finding::Finding;
use crate::task::Document;
use crate::task::parts::Pose;
use html::page::Page;

/// How a text is told.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Style {
    /// Columns that a line may have.
    pub width: usize,
    /// Tell everything, not only the first of many.
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

/// Text between the tags of HTML and XML, or in the quotes of an attribute; signs that neither has are left out.
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

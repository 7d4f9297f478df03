//! The text of a file: whether it may be a robot's, and what of it says where links are.

use super::UrdfError;
use crate::xml;

/// Links of a file: several arms with their grippers have some hundred.
const MOST_LINKS: usize = 2_000;

/// Refuses what no robot is: elements that nest too deep, or too many of them, before anything is
/// built of it.
pub(super) fn judge_size(text: &str) -> Result<(), UrdfError> {
    let root = xml::read(text).map_err(|error| UrdfError::Unreadable {
        message: error.to_string(),
    })?;
    if root.name != "robot" {
        let message = root.fault(format!("the file is a <{}>, not a <robot>", root.name));
        return Err(UrdfError::Unreadable {
            message: message.to_string(),
        });
    }
    let found = root.all("link").count().max(root.all("joint").count());
    if found > MOST_LINKS {
        return Err(UrdfError::TooMany {
            found,
            most: MOST_LINKS,
        });
    }
    Ok(())
}

/// Whether a text is a xacro file whose macros nobody has expanded.
#[cfg(feature = "cli")]
pub(crate) fn is_xacro(text: &str) -> bool {
    has_macros(&without_comments(text))
}

pub(super) fn has_macros(code: &str) -> bool {
    code.contains("<xacro:") || (code.contains("xmlns:xacro") && code.contains("${"))
}

/// XML without its comments.
pub(super) fn without_comments(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    let mut rest = text;
    while let Some((before, after)) = rest.split_once("<!--") {
        out.push_str(before);
        rest = after.split_once("-->").map_or("", |(_, behind)| behind);
    }
    out + rest
}

/// XML without what robots look like: a colour that stands there twice is none of an arm's
/// business.
pub(super) fn without_looks(code: &str) -> String {
    let mut out = code.to_owned();
    for name in ["visual", "material"] {
        let (open, close) = (format!("<{name}"), format!("</{name}>"));
        let mut kept = String::with_capacity(out.len());
        let mut rest = out.as_str();
        while let Some(at) = rest.find(&open) {
            let behind = &rest[at + open.len()..];
            let is_whole = behind.starts_with(|c: char| c.is_whitespace() || c == '>' || c == '/');
            let end = behind.find('>').filter(|_| is_whole);
            let Some(end) = end else {
                let next = at + open.len();
                kept.push_str(&rest[..next]);
                rest = &rest[next..];
                continue;
            };
            kept.push_str(&rest[..at]);
            rest = &behind[end + 1..];
            if !behind[..end].ends_with('/') {
                rest = rest.split_once(&close).map_or("", |(_, behind)| behind);
            }
        }
        kept.push_str(rest);
        out = kept;
    }
    out
}

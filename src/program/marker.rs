//! The comment that says a file is compensated.

use memchr::memmem;
use sha2::{Digest, Sha256};

/// The word that a marker starts with; no program that was not compensated holds it.
const WORD: &str = "poseshift compensated this file";

/// What a compensated file says about itself.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Marker {
    /// Program version.
    pub version: String,
    /// SHA-256 of the profile, 64 hexadecimal digits.
    pub profile_sha256: String,
    /// SHA-256 of the file it was made from.
    pub source_sha256: String,
    /// What was decided against a default, in short words: findings that were accepted, limits that were raised.
    pub decided: Vec<String>,
}

impl Marker {
    /// The marker as short lines without comment signs.
    #[must_use]
    pub fn lines(&self) -> Vec<String> {
        let mut lines = vec![
            format!("{WORD} (version {})", self.version),
            format!("profile {}", self.profile_sha256),
            format!("source {}", self.source_sha256),
        ];
        lines.extend(self.decided.iter().cloned());
        lines
    }

    /// Offset of a marker in a file, where there is one.
    #[must_use]
    pub fn find(bytes: &[u8]) -> Option<usize> {
        memmem::find(bytes, WORD.as_bytes())
    }
}

/// The SHA-256 of bytes, 64 hexadecimal digits.
#[must_use]
pub fn sha256(bytes: &[u8]) -> String {
    Sha256::digest(bytes)
        .iter()
        .map(|b| format!("{b:02x}"))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_written_marker_is_found_again() {
        let marker = Marker {
            version: "1.2".into(),
            profile_sha256: "a".repeat(64),
            source_sha256: "b".repeat(64),
            decided: vec!["accepted target-shared".into()],
        };
        let text = format!("MODULE m\n! {}\n", marker.lines().join("\n! "));
        assert_eq!(Marker::find(text.as_bytes()), Some(11));
        assert!(text.ends_with("! accepted target-shared\n"));
        assert_eq!(Marker::find(b"! made by poseshift"), None);
    }
}

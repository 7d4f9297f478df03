//! The comment that says a file is compensated.

use memchr::memmem;

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
}

impl Marker {
    /// The marker as short lines without comment signs.
    #[must_use]
    pub fn lines(&self) -> [String; 3] {
        [
            format!("{WORD} (version {})", self.version),
            format!("profile {}", self.profile_sha256),
            format!("source {}", self.source_sha256),
        ]
    }

    /// Offset of a marker in a file, where there is one.
    #[must_use]
    pub fn find(bytes: &[u8]) -> Option<usize> {
        memmem::find(bytes, WORD.as_bytes())
    }
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
        };
        let text = format!("MODULE m\n! {}\n", marker.lines().join("\n! "));
        assert_eq!(Marker::find(text.as_bytes()), Some(11));
        assert_eq!(Marker::find(b"! made by poseshift"), None);
    }
}

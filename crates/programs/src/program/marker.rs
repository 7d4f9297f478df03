//! The comment that says a file is compensated.

use crate::finding::kind;
use sha2::{Digest, Sha256};
use std::io::{self, BufReader, Read};

/// The word that a marker starts with; no program that was not compensated holds it.
const WORD: &str = "poseshift compensated this file";
/// The fewest digits of a hash that a language keeps.
const LEAST_DIGITS: usize = 16;
/// Characters of a comment that short lines have at most.
pub(super) const WIDEST_COMMENT: usize = 32;
/// Digits of a hash in one comment of INFORM in files of version 0.1.
const HALF_HASH: usize = 32;
/// Bytes between the words of a marker, at most.
const WIDEST_GAP: usize = 24;
/// Bytes of a line that tells what was decided, at most.
const WIDEST_DECISION: usize = 80;

/// Bytes of a file that are hashed at once.
const READ_AT_ONCE: usize = 1 << 16;

/// What a compensated file says about itself.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Marker {
    /// Program version.
    pub version: String,
    /// SHA-256 of the profile, 64 hexadecimal digits.
    pub profile_sha256: String,
    /// SHA-256 of the file it was made from.
    pub source_sha256: String,
    /// What was decided against a default, in short words: findings that were accepted, limits
    /// that were raised.
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

    /// The marker as lines of at most `WIDEST_COMMENT` characters, for languages whose controllers
    /// keep no longer comments: the first 24 and 16 digits of the hashes.
    #[must_use]
    pub fn short_lines(&self) -> Vec<String> {
        let profile = format!("profile {:.24}", self.profile_sha256);
        let source = format!("source {:.16} v{}", self.source_sha256, self.version);
        // a finding with a long name is named alone
        let short = |text: &String| match text.split_once(' ') {
            Some(("accepted", id)) if text.len() > WIDEST_COMMENT => id.to_owned(),
            _ => text.clone(),
        };
        let mut lines = vec![WORD.to_owned(), profile, source];
        lines.extend(self.decided.iter().map(short));
        for line in &mut lines {
            line.truncate(WIDEST_COMMENT);
        }
        lines
    }

    /// Offset of a marker in a file, where there is one: any of its lines is enough, in any case
    /// and spacing.
    #[must_use]
    pub fn find(bytes: &[u8]) -> Option<usize> {
        let found = Found::of(bytes);
        found.offset
    }
}

/// What markers in a file say.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Found {
    /// Where the first begins.
    pub offset: Option<usize>,
    /// Hashes of profiles, lower case, as many digits as the language keeps.
    pub profiles: Vec<String>,
    /// Hashes of the files that this one was made from, likewise.
    pub sources: Vec<String>,
    /// By how much the part was moved, as `34.852mm,1.2deg`.
    pub moved: Option<String>,
}

impl Found {
    /// Looks for markers in a file.
    #[must_use]
    pub fn of(bytes: &[u8]) -> Self {
        let mut found = Self::default();
        for at in memchr::memchr2_iter(b'p', b'P', bytes) {
            if sentence(bytes, at) {
                found.see(at);
                break;
            }
        }
        let mut start = 0;
        for end in memchr::memchr2_iter(b'\n', b'\r', bytes).chain([bytes.len()]) {
            found.line(bytes, start, end);
            start = end + 1;
        }
        found
    }

    fn see(&mut self, at: usize) {
        self.offset = Some(self.offset.map_or(at, |before| before.min(at)));
    }

    /// One line.
    fn line(&mut self, bytes: &[u8], start: usize, end: usize) {
        let at = start + comment_sign(&bytes[start..end]);
        if let Some(digest) = digest(bytes, at, b"profile") {
            self.see(at);
            self.profiles.push(digest);
        } else if let Some(digest) = digest(bytes, at, b"source") {
            self.see(at);
            self.sources.push(digest);
        } else if decided(&bytes[at.min(end)..end]) || is_rest(&bytes[start..end]) {
            self.see(at);
            let text = String::from_utf8_lossy(&bytes[at.min(end)..end]).to_ascii_lowercase();
            let moved = text
                .strip_prefix("work-offset")
                .map(|by| by.trim_matches([' ', ';']));
            self.moved = moved.map(str::to_owned).or(self.moved.take());
        }
    }
}

/// Bytes before the text of a comment: signs, blanks, the number of a line.
fn comment_sign(line: &[u8]) -> usize {
    let sign = |line: &[u8]| {
        let letters = line.iter().take_while(|b| !b.is_ascii_alphanumeric());
        letters.count()
    };
    let signs = sign(line);
    let digits = line[signs..].iter().take_while(|b| b.is_ascii_digit());
    let digits = digits.count();
    if digits > 0 && line.get(signs + digits) == Some(&b':') {
        let behind = signs + digits;
        return behind + sign(&line[behind..]);
    }
    signs
}

/// The byte behind a word at a place, in any case.
fn word(bytes: &[u8], at: usize, word: &[u8]) -> Option<usize> {
    let text = bytes.get(at..at + word.len())?;
    text.eq_ignore_ascii_case(word).then_some(at + word.len())
}

/// Whether the words of a marker's first line stand here, whatever is between them.
fn sentence(bytes: &[u8], at: usize) -> bool {
    let mut at = Some(at);
    for part in WORD.split(' ') {
        at = at
            .map(|at| at + gap(&bytes[at.min(bytes.len())..]))
            .and_then(|at| word(bytes, at, part.as_bytes()));
    }
    at.is_some()
}

/// Bytes that are neither letters nor digits: blanks, the end of a line and the sign of the next
/// comment.
fn gap(bytes: &[u8]) -> usize {
    let gap = bytes.iter().take(WIDEST_GAP);
    gap.take_while(|b| !b.is_ascii_alphanumeric()).count()
}

/// The digits of a hash behind its name.
fn digest(bytes: &[u8], at: usize, name: &[u8]) -> Option<String> {
    let behind = word(bytes, at, name)?;
    let between = gap(&bytes[behind..]);
    let digits = &bytes[behind + between..];
    let count = digits.iter().take_while(|b| b.is_ascii_hexdigit()).count();
    let (digits, rest) = digits.split_at(count);
    // short lines have the version behind
    let ends =
        (rest.first()).is_none_or(|b| !b.is_ascii_alphanumeric() || matches!(b, b'v' | b'V'));
    let is_hash = ends && (LEAST_DIGITS..=64).contains(&digits.len());
    is_hash.then(|| String::from_utf8_lossy(digits).to_ascii_lowercase())
}

/// Whether a line is half a hash, as comments of INFORM held it.
fn is_rest(line: &[u8]) -> bool {
    let digits = line.trim_ascii().strip_prefix(b"'");
    let digits = digits.map(<[u8]>::trim_ascii_start);
    digits.is_some_and(|text| text.len() == HALF_HASH && text.iter().all(u8::is_ascii_hexdigit))
}

/// Whether a comment's text is a line of what was decided.
fn decided(text: &[u8]) -> bool {
    let Some(text) = text.get(..text.len().min(WIDEST_DECISION)) else {
        return false;
    };
    let first = text
        .iter()
        .take_while(|b| b.is_ascii_alphanumeric() || **b == b'-');
    let first = &text[..first.count()];
    if word(first, 0, b"accepted").is_none() && !first.contains(&b'-') {
        return false;
    }
    let text = String::from_utf8_lossy(text).to_ascii_lowercase();
    let text = text.replace(|c: char| c.is_ascii_whitespace() || c == ';', "");
    let is_number = |text: &str| text.parse::<f64>().is_ok();
    if let Some(id) = text.strip_prefix("accepted") {
        kind(id).is_some()
    } else if let Some(limit) =
        (text.strip_prefix("max-shift")).or_else(|| text.strip_prefix("work-offset"))
    {
        limit.split_once("mm,").is_some_and(|(mm, _)| is_number(mm))
    } else if let Some(limit) = text.strip_prefix("max-derived-error") {
        is_number(limit)
    } else if let Some(side) = text.strip_prefix("at-singularity") {
        matches!(side, "flip" | "nearest")
    } else {
        // named alone where both are too long for a line
        text.contains('-') && kind(&text).is_some()
    }
}

/// The SHA-256 of bytes, 64 hexadecimal digits.
#[must_use]
pub fn sha256(bytes: &[u8]) -> String {
    digits(&Sha256::digest(bytes))
}

/// The same of all that a stream gives.
///
/// # Errors
/// Those of the stream.
pub fn sha256_of(stream: &mut impl Read) -> io::Result<String> {
    let mut hasher = Sha256::new();
    io::copy(
        &mut BufReader::with_capacity(READ_AT_ONCE, stream),
        &mut hasher,
    )?;
    Ok(digits(&hasher.finalize()))
}

fn digits(hash: &[u8]) -> String {
    hash.iter().map(|b| format!("{b:02x}")).collect()
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

    #[test]
    fn any_line_in_any_case_and_spacing_is_a_marker() {
        let profile = format!("profile {}", "a1".repeat(32));
        let remark = format!("   4:  !SOURCE   {} v1.2 ;", "B2".repeat(8));
        for text in [
            "!PoseShift  Compensated\tthis file",
            "poseshiftCOMPENSATEDthisfile",
            "  # accepted target-shared",
            "; MAX-SHIFT 30mm,3deg",
            "// max-shift 19mm, 1.9deg",
            "' max-shift19mm,1.9deg",
            "! WORK-OFFSET 34.852mm, 1.2deg ;",
            "; at-singularity flip",
            "! AT-SINGULARITY  NEAREST ;",
            "# max-derived-error 1",
            "  7:  !max-derived-error0.3 ;",
            "! acceptedtarget-shared",
            profile.as_str(),
            &profile.replace(' ', ""),
            &remark.replace(' ', ""),
            remark.as_str(),
        ] {
            let inside = format!("MODULE m\r\n{text}\r\nENDMODULE\r\n");
            assert!(Marker::find(inside.as_bytes()).is_some(), "{text}");
        }
        for text in [
            "! profile of the part: abcdef",
            "! source code 0123",
            "! accepted by the customer",
            "! accepted rounding errors",
            "PROFILE := 1234;",
            "! poseshift did not compensate this file",
            "! max-derived-error is 1",
            "! at-singularity of the wrist",
            "! max-shift is 30mm,3deg",
            "! work-offset of the part: 3mm,2deg",
            "sourcecode0123456789abcdef",
        ] {
            assert_eq!(Marker::find(text.as_bytes()), None, "{text}");
        }
    }

    #[test]
    fn each_short_line_is_a_marker() {
        let longest = crate::finding::TABLE
            .iter()
            .max_by_key(|kind| kind.id.len());
        let longest = longest.expect("a finding").id;
        assert!(longest.len() <= WIDEST_COMMENT, "{longest} does not fit");
        let marker = Marker {
            version: "0.1.0".into(),
            profile_sha256: "a".repeat(64),
            source_sha256: "b".repeat(64),
            decided: vec![
                "accepted target-shared".into(),
                format!("accepted {longest}"),
                "max-shift 123.456mm,12.5deg".into(),
                "max-shift 1123.456789mm,112.543211deg".into(),
                "max-derived-error 123456.123456".into(),
                "at-singularity nearest".into(),
                "work-offset 1234.567891mm,179.123456deg".into(),
            ],
        };
        let lines = marker.short_lines();
        assert_eq!(lines.len(), 10);
        for line in lines {
            assert!(line.len() <= WIDEST_COMMENT, "{line}");
            for text in [
                format!("'{line}\r\n"),
                format!("  12:  !{} ;\n", line.to_uppercase()),
            ] {
                assert!(Marker::find(text.as_bytes()).is_some(), "{text}");
            }
        }
    }

    #[test]
    fn the_hashes_are_read_over_the_lines_of_comments() {
        let text = format!(
            "'profile\r\n'{}\r\n'{}\r\n//source {}\r\n",
            "a".repeat(32),
            "b".repeat(32),
            "C".repeat(64)
        );
        let found = Found::of(text.as_bytes());
        assert_eq!(found.profiles, ["a".repeat(32)]);
        assert_eq!(found.offset, Some(1));
        assert_eq!(found.sources, ["c".repeat(64)]);
    }
}

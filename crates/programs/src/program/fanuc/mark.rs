//! The marker: remarks at the end of `/MN`.
//!
//! A listing has no comments but remarks in numbered lines, and COMMENT of 16 characters in
//! `/ATTR`, which is the user's. So the marker stands behind the last instruction, where it
//! renumbers nothing, as three remarks of at most 32 characters (what a controller keeps).
//! `LINE_COUNT` stays: controllers count the lines themselves when they load a listing, and
//! post-processors write any number there. Of the hashes the first 24 and 16 of 64 digits fit.

use super::sections::{Sections, line_end};
use crate::program::{Marker, Source};

/// Where the marker goes, and its text.
pub fn mark(source: &Source, marker: &Marker) -> (usize, Vec<u8>) {
    let bytes = &source.bytes;
    let Some(sections) = Sections::of(bytes) else {
        return (bytes.len(), Vec::new());
    };
    let end = source.line_end();
    let mut number = last_number(&bytes[sections.lines.clone()]);
    let at = sections.lines.end;
    let mut text = Vec::new();
    if !matches!(bytes[..at].last(), Some(b'\n' | b'\r')) {
        text.extend_from_slice(end);
    }
    for remark in marker.short_lines() {
        number = number.map(|number| number + 1);
        let line = number.map_or_else(|| "    ".into(), |number| format!("{number:4}"));
        text.extend_from_slice(format!("{line}:  !{remark} ;").as_bytes());
        text.extend_from_slice(end);
    }
    (at, text)
}

/// The number of the last line; `None` where lines have no numbers. Blocks inside moves number
/// their own lines.
fn last_number(lines: &[u8]) -> Option<u64> {
    let (mut at, mut last, mut block) = (0, Some(0), false);
    while at < lines.len() {
        let end = line_end(lines, at);
        let line = lines[at..end].trim_ascii();
        at = end;
        if block {
            block = !line.starts_with(b"---");
            continue;
        }
        let digits = line.iter().take_while(|b| b.is_ascii_digit()).count();
        let colon = line[digits..].trim_ascii_start().first() == Some(&b':');
        if colon && digits > 0 {
            let number = std::str::from_utf8(&line[..digits]).ok();
            last = number
                .and_then(|n| n.parse().ok())
                .filter(|&n: &u64| n < 1_000_000);
        }
        let text = line.strip_suffix(b";").unwrap_or(line).trim_ascii_end();
        block = text.ends_with(b"P-SPS");
    }
    last.filter(|&last| last > 0 || lines.trim_ascii().is_empty())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn marked(text: &str) -> String {
        let marker = Marker {
            version: "1.2".into(),
            profile_sha256: "a".repeat(64),
            source_sha256: "b".repeat(64),
            decided: Vec::new(),
        };
        let source = Source::new("a.ls", text.as_bytes().to_vec());
        let (at, text) = mark(&source, &marker);
        let mut bytes = source.bytes;
        bytes.splice(at..at, text);
        String::from_utf8(bytes).expect("UTF-8")
    }

    #[test]
    fn remarks_go_behind_the_last_line_with_the_next_numbers() {
        let text = "/PROG A\r\n/MN\r\n   1:J P[1] 100% FINE TB .10sec,P-SPS ;\r\n      1:  X \
            ;\r\n      9:  Y ;\r\n       ------ ;\r\n   2:  END ;\r\n/POS\r\n/END\r\n";
        let found = marked(text);
        let lines: Vec<&str> = found.split("\r\n").collect();
        assert_eq!(lines[7], "   3:  !poseshift compensated this file ;");
        assert_eq!(
            lines[9],
            format!("   5:  !source {} v1.2 ;", "b".repeat(16))
        );
        assert_eq!(lines[10], "/POS");
        assert!(lines[7..10].iter().all(|line| line.len() <= 9 + 32 + 2));
        assert!(Marker::find(found.as_bytes()).is_some());
    }

    #[test]
    fn lines_without_numbers_get_none() {
        let found = marked("/PROG A\n/MN\n:J P[1] 100% FINE ;\n/END");
        assert!(found.contains("FINE ;\n    :  !poseshift compensated this file ;\n"));
        assert!(found.ends_with(";\n/END"));
    }
}

//! Errors that the user takes: `--accept ID[:FILE[:LINE]]`.

use super::{Finding, Kind, Severity, kind};
use std::path::Path;
use std::str::FromStr;

/// An error that is taken wherever it is found, in one file, or at one line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Acceptance {
    kind: &'static Kind,
    file: Option<String>,
    line: Option<usize>,
}

/// Why an acceptance cannot be meant.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum AcceptanceError {
    /// No finding has this id.
    #[error("no finding is called `{0}`")]
    Unknown(String),
    /// It is not for the user to take.
    #[error("`{0}` cannot be accepted: {1}")]
    Never(&'static str, &'static str),
    /// Something behind the second colon that is no line.
    #[error("`{0}` is no line number")]
    Line(String),
}

impl FromStr for Acceptance {
    type Err = AcceptanceError;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let (id, place) = match text.split_once(':') {
            Some((id, place)) => (id, Some(place)),
            None => (text, None),
        };
        let kind = kind(id).ok_or_else(|| AcceptanceError::Unknown(id.into()))?;
        if kind.never_accepted {
            return Err(AcceptanceError::Never(kind.id, kind.meaning));
        }
        // a drive letter is no file
        let cut = place.and_then(|place| place.rsplit_once(':').filter(|(file, _)| file.len() > 1));
        let (file, line) = match (cut, place) {
            (Some((file, line)), _) => (Some(file), Some(line)),
            (None, place) => (place, None),
        };
        let line = match line {
            None => None,
            Some(line) => Some(
                line.parse()
                    .map_err(|_| AcceptanceError::Line(line.into()))?,
            ),
        };
        Ok(Self {
            kind,
            file: file
                .map(|file| file.trim_start_matches("./"))
                .filter(|file| !file.is_empty())
                .map(str::to_owned),
            line,
        })
    }
}

impl std::fmt::Display for Acceptance {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}", self.kind.id)?;
        for part in [self.file.clone(), self.line.map(|line| line.to_string())]
            .into_iter()
            .flatten()
        {
            write!(f, ":{part}")?;
        }
        Ok(())
    }
}

impl Acceptance {
    /// The finding's id.
    #[must_use]
    pub fn id(&self) -> &'static str {
        self.kind.id
    }

    /// That it took nothing, at the first file.
    pub(crate) fn idle(&self, file: &str) -> Finding {
        let text = format!("--accept {self} takes no error: there is none");
        Finding::of_file("acceptance-unused", Severity::Warning, file, text).hint("leave it out")
    }

    /// Whether it takes a finding; a file is named by its path as the user gave it, or by its end.
    #[must_use]
    pub fn takes(&self, finding: &Finding) -> bool {
        let in_file = |file: &String| {
            let (asked, found) = (Path::new(file), Path::new(&finding.file));
            found.ends_with(asked) || asked.is_absolute() && asked.ends_with(found)
        };
        finding.id == self.kind.id
            && finding.severity == Severity::Error
            && self.file.as_ref().is_none_or(in_file)
            && self.line.is_none_or(|line| line == finding.line)
    }
}

/// Makes warnings of the errors that are taken; gives back the acceptances that took none, and the
/// ids of what was taken.
pub fn accept<'a>(
    findings: &mut [Finding],
    acceptances: &'a [Acceptance],
) -> (Vec<&'a Acceptance>, Vec<&'static str>) {
    let (mut idle, mut taken) = (Vec::new(), Vec::new());
    for acceptance in acceptances {
        let mut took = false;
        for finding in findings.iter_mut() {
            if acceptance.takes(finding) {
                finding.severity = Severity::Warning;
                finding.accepted = true;
                took = true;
            }
        }
        if took {
            taken.push(acceptance.kind.id);
        } else {
            idle.push(acceptance);
        }
    }
    taken.sort_unstable();
    taken.dedup();
    (idle, taken)
}

/// [`accept`], and a finding at the first file of each acceptance that took nothing.
pub fn accept_errors(
    findings: &mut Vec<Finding>,
    acceptances: &[Acceptance],
    file: &str,
) -> Vec<&'static str> {
    let (idle, taken) = accept(findings, acceptances);
    findings.extend(idle.into_iter().map(|acceptance| acceptance.idle(file)));
    taken
}

#[cfg(test)]
mod tests {
    use super::*;

    fn finding(id: &'static str, file: &str, line: usize) -> Finding {
        Finding {
            line,
            ..Finding::of_file(id, Severity::Error, file, "")
        }
    }

    #[test]
    fn an_acceptance_is_a_name_a_file_and_a_line() {
        let accept = |text: &str| text.parse::<Acceptance>();
        let one = accept("target-shared:cell/a.mod:12").expect("one");
        assert!(one.takes(&finding("target-shared", "x/cell/a.mod", 12)));
        assert!(!one.takes(&finding("target-shared", "x/cell/a.mod", 13)));
        assert!(!one.takes(&finding("target-shared", "cell/ba.mod", 12)));
        assert_eq!(one.to_string(), "target-shared:cell/a.mod:12");
        let found = finding("target-shared", "cell/a.mod", 12);
        for whole in ["./cell/a.mod", "/cell/a.mod", "a.mod"] {
            let one = accept(&format!("target-shared:{whole}:12")).expect("one");
            assert!(one.takes(&found), "{whole}");
        }
        let other = accept("target-shared:other/cell/a.mod").expect("one");
        assert!(!other.takes(&found));
        // a name of an earlier version
        let old = accept("target-passed-to-function").expect("an earlier name");
        assert!(old.takes(&finding("target-passed-to-routine", "a", 1)));
        assert_eq!(
            accept("out-of-reach").map_err(|e| matches!(e, AcceptanceError::Never(..))),
            Err(true)
        );
        assert!(accept("no-such").is_err() && accept("target-shared:a.mod:x").is_err());
    }

    #[test]
    fn what_is_taken_is_a_warning_and_what_takes_nothing_is_known() {
        let mut findings = [
            finding("target-shared", "a", 1),
            finding("rounding", "a", 2),
        ];
        let both: Vec<Acceptance> = ["target-shared", "rounding:b"]
            .iter()
            .map(|text| text.parse().expect("an acceptance"))
            .collect();
        let (idle, taken) = accept(&mut findings, &both);
        assert_eq!((idle, taken), (vec![&both[1]], vec!["target-shared"]));
        assert!(findings[0].accepted && findings[0].severity == Severity::Warning);
        assert!(!findings[1].accepted && findings[1].severity == Severity::Error);
    }
}

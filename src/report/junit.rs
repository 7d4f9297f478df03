//! `JUnit` XML, for build servers.
//!
//! # Source
//! The schema of Jenkins' xUnit plugin: `testsuites`, `testsuite`, `testcase`, `failure`.

use super::escaped;
use std::fmt::Write;

/// The cases of one file.
pub(super) struct Suite<'a> {
    /// The file.
    pub name: &'a str,
    /// Name of each case, and why it failed: nothing where it did not.
    pub cases: Vec<(String, Vec<String>)>,
}

fn failed(suite: &Suite) -> usize {
    let failed = suite.cases.iter().filter(|(_, why)| !why.is_empty());
    failed.count()
}

/// The document.
pub(super) fn xml(name: &str, suites: &[Suite]) -> String {
    let ok = "a string takes all text";
    let tests: usize = suites.iter().map(|suite| suite.cases.len()).sum();
    let failures: usize = suites.iter().map(failed).sum();
    let mut out = String::from("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
    let name = escaped(name);
    writeln!(
        out,
        r#"<testsuites name="{name}" tests="{tests}" skipped="0" failures="{failures}" errors="0">"#
    )
    .expect(ok);
    for suite in suites {
        let (file, tests, failures) = (escaped(suite.name), suite.cases.len(), failed(suite));
        writeln!(
            out,
            r#"    <testsuite name="{file}" tests="{tests}" skipped="0" errors="0" failures="{failures}">"#
        )
        .expect(ok);
        for (case, why) in &suite.cases {
            let case = escaped(case);
            write!(out, r#"        <testcase name="{case}" classname="{file}""#).expect(ok);
            let Some(first) = why.first() else {
                out += "/>\n";
                continue;
            };
            let (first, all) = (escaped(first), escaped(&why.join("\n")));
            out += ">\n";
            writeln!(
                out,
                r#"            <failure message="{first}">{all}</failure>"#
            )
            .expect(ok);
            out += "        </testcase>\n";
        }
        out += "    </testsuite>\n";
    }
    out + "</testsuites>\n"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_and_messages_that_are_markup_stay_text_and_failures_are_counted() {
        let cases = vec![
            ("line 1".to_owned(), Vec::new()),
            (
                "a<b>\"&\u{1}".to_owned(),
                vec!["<x>".to_owned(), "y".to_owned()],
            ),
        ];
        let xml = xml(
            "all",
            &[Suite {
                name: "f.mod",
                cases,
            }],
        );
        assert!(xml.contains(r#"name="all" tests="2" skipped="0" failures="1" errors="0">"#));
        assert!(xml.contains(r#"<testcase name="line 1" classname="f.mod"/>"#));
        assert!(xml.contains(r#"<testcase name="a&lt;b&gt;&quot;&amp;" classname="f.mod">"#));
        assert!(xml.contains("<failure message=\"&lt;x&gt;\">&lt;x&gt;\ny</failure>"));
    }
}

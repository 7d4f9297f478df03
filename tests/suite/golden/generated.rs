//! A generated path in one language, compensated by the command.

use crate::path;
use crate::support::{poseshift, report, scratch};
use serde_json::Value;

/// The folder with `in/` and `out/`, and the targets that were rewritten.
pub struct Generated {
    pub folder: tempfile::TempDir,
    pub targets: Vec<Value>,
}

/// A path of so many points, every so many of a longer one, in a language with this ending.
pub fn compensated((language, ending): (&str, &str), points: u32, every: u32) -> Generated {
    let folder = scratch();
    let at = |name: &str| folder.path().join(name);
    std::fs::write(at("profile.yaml"), path::profile(language)).expect("scratch");
    std::fs::create_dir(at("in")).expect("scratch");
    let text = path::program(language, points, every);
    std::fs::write(at("in").join(format!("path.{ending}")), text).expect("scratch");
    if let Some((name, text)) = path::given(language, points) {
        std::fs::write(at("in").join(name), text).expect("scratch");
    }
    let report = report(
        poseshift()
            .arg("compensate")
            .arg(at("in"))
            .args(["--tool", "artifact", "--json", "--profile"])
            .arg(at("profile.yaml"))
            .arg("-o")
            .arg(at("out")),
    );
    assert_eq!(report["language"], language);
    let targets = report["targets"].as_array().expect("a list").iter();
    let rewritten = targets.filter(|target| !target["fake"].is_null());
    Generated {
        targets: rewritten.cloned().collect(),
        folder,
    }
}

//! The journal of a run that was stopped, which the next run in its folder reads: any bytes in its place.

use std::ffi::OsStr;
use std::path::PathBuf;
use std::sync::OnceLock;

/// What another file of the folder holds.
const KEPT: &[u8] = b"kept";

/// Reads a journal.
///
/// # Panics
/// Where the program fails by itself, or changes another file.
pub fn journal(bytes: &[u8]) {
    static FOLDER: OnceLock<PathBuf> = OnceLock::new();
    let folder = FOLDER.get_or_init(|| {
        let name = format!("poseshift-fuzz-{}", std::process::id());
        let folder = std::env::temp_dir().join(name);
        std::fs::create_dir_all(&folder).expect("a folder for the journal");
        folder
    });
    let write = |name: &str, bytes: &[u8]| {
        std::fs::write(folder.join(name), bytes).expect("a writable folder");
    };
    write("kept.mod", KEPT);
    write(".poseshift-journal", bytes);
    let profile = folder.join("none.yaml");
    let words = ["poseshift", "profile", "show"].map(OsStr::new);
    let status = poseshift::run_with(words.into_iter().chain([profile.as_os_str()]));
    assert_eq!(status, 2, "there is no such profile");
    let kept = std::fs::read(folder.join("kept.mod"));
    assert!(
        kept.is_ok_and(|bytes| bytes == KEPT),
        "another file is changed"
    );
}

//! Reading test data, and comparing poses without the code under test.

use std::collections::BTreeMap;
use std::io::Write;
use std::path::{Path, PathBuf};

/// Says that a test was not made, and why: past the harness, which keeps what a test prints and
/// shows it of failures only.
pub fn skipped(why: &str) {
    let thread = std::thread::current();
    let test = thread.name().unwrap_or("a test");
    let line = format!("\nSKIPPED {test}: {why}\n");
    // nobody to hear it is no failure
    let _ = std::io::stderr().write_all(line.as_bytes());
}

/// A path below the repository's top.
pub fn repository(path: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join(path)
}

/// The text of a file below the repository's top.
pub fn text(path: &str) -> String {
    std::fs::read_to_string(repository(path)).unwrap_or_else(|error| panic!("{path}: {error}"))
}

/// One row of a table by column name.
pub struct Row(BTreeMap<String, String>);

impl Row {
    pub fn text(&self, column: &str) -> &str {
        self.0
            .get(column)
            .unwrap_or_else(|| panic!("no column {column}"))
    }

    pub fn number(&self, column: &str) -> f64 {
        self.text(column)
            .parse()
            .unwrap_or_else(|_| panic!("{column}: {}", self.text(column)))
    }

    /// The number, 0 where there is no such column.
    pub fn number_or_zero(&self, column: &str) -> f64 {
        if self.0.contains_key(column) {
            self.number(column)
        } else {
            0.0
        }
    }

    pub fn numbers<const N: usize>(&self, columns: [&str; N]) -> [f64; N] {
        columns.map(|column| self.number(column))
    }

    /// Six columns named with `{}` in place of the joint number, degrees, in radians.
    pub fn joints(&self, pattern: &str) -> [f64; 6] {
        std::array::from_fn(|i| {
            self.number(&pattern.replace("{}", &(i + 1).to_string()))
                .to_radians()
        })
    }
}

/// The rows of a CSV file below the repository's top.
pub fn table(path: &str) -> Vec<Row> {
    let mut reader = csv::ReaderBuilder::new()
        .comment(Some(b'#'))
        .from_path(repository(path))
        .expect(path);
    let header: Vec<String> = reader
        .headers()
        .expect(path)
        .iter()
        .map(str::to_owned)
        .collect();
    let rows = reader.records().map(|record| {
        let record = record.expect(path);
        Row(header
            .iter()
            .cloned()
            .zip(record.iter().map(str::to_owned))
            .collect())
    });
    rows.collect()
}

/// Distance in mm and angle in rad between two poses given as `x y z qw qx qy qz`.
pub fn gap(a: [f64; 7], b: [f64; 7]) -> (f64, f64) {
    let distance = (0..3).map(|i| (a[i] - b[i]).powi(2)).sum::<f64>().sqrt();
    let (p, q) = (&a[3..], &b[3..]);
    let sign = if (0..4).map(|i| p[i] * q[i]).sum::<f64>() < 0.0 {
        -1.0
    } else {
        1.0
    };
    let chord = (0..4)
        .map(|i| (p[i] - sign * q[i]).powi(2))
        .sum::<f64>()
        .sqrt();
    (distance, 4.0 * (0.5 * chord).min(1.0).asin())
}

/// A pose of the product as `x y z` in mm and a quaternion.
pub fn numbers_of(pose: &poseshift::geometry::Pose) -> [f64; 7] {
    let t = pose.translation;
    let q = pose.rotation.quaternion().0;
    [t[0] * 1e3, t[1] * 1e3, t[2] * 1e3, q[0], q[1], q[2], q[3]]
}

/// Every shipped profile: file name and profile, in the order of their names.
pub fn shipped_profiles() -> Vec<(String, poseshift::model::profile::Profile)> {
    let mut names: Vec<_> = std::fs::read_dir(repository("robots"))
        .expect("the shipped robots")
        .map(|entry| {
            entry
                .expect("a file")
                .file_name()
                .into_string()
                .expect("a plain name")
        })
        .filter(|name| Path::new(name).extension().is_some_and(|e| e == "yaml"))
        .collect();
    names.sort();
    let read = |name: String| {
        let profile =
            poseshift::model::profile::Profile::from_yaml(&text(&format!("robots/{name}")));
        let profile = profile.unwrap_or_else(|error| panic!("{name}: {error}"));
        (name, profile)
    };
    names.into_iter().map(read).collect()
}

/// Joint angles drawn evenly within the limits of a mechanism, radians.
pub fn random_joints(
    random: &mut rand::rngs::StdRng,
    profile: &poseshift::model::profile::Profile,
) -> [f64; 6] {
    use rand::RngExt;
    profile
        .mechanism
        .joints
        .map(|joint| random.random_range(joint.min_rad..joint.max_rad))
}

/// The program under test.
pub fn poseshift() -> assert_cmd::Command {
    let mut command = assert_cmd::Command::new(env!("CARGO_BIN_EXE_poseshift"));
    // as wide as where nobody looks
    command.env_remove("COLUMNS");
    command
}

/// The program as somebody for whom permissions count.
#[cfg(unix)]
pub struct WithoutRights(Vec<std::ffi::OsString>);

#[cfg(unix)]
impl WithoutRights {
    /// As who runs the tests; root without the capabilities that let it past permissions. None,
    /// which is said, where permissions count for nobody.
    pub fn new() -> Option<Self> {
        use std::os::unix::fs::MetadataExt;
        let folder = scratch();
        let closed = folder.path().join("closed");
        std::fs::write(&closed, "").expect("scratch");
        permit(&closed, 0o000);
        let mut before = Vec::new();
        if std::fs::metadata(&closed).expect("a file").uid() == 0 {
            before.extend(["setpriv", "--inh-caps=-all", "--bounding-set=-all"].map(Into::into));
        }
        let made = Self(before);
        let succeeds = |program: &str, file: &Path| {
            let output = made.command(program.as_ref()).arg(file).output();
            output.is_ok_and(|output| output.status.success())
        };
        if succeeds("ls", folder.path()) && !succeeds("cat", &closed) {
            return Some(made);
        }
        skipped("everybody may read everything here, and setpriv does not change it");
        None
    }

    fn command(&self, program: &std::ffi::OsStr) -> std::process::Command {
        let mut words = self.0.iter().map(AsRef::as_ref).chain([program]);
        let mut command = std::process::Command::new(words.next().expect("the program"));
        command.args(words);
        command
    }

    /// Runs it in a folder.
    pub fn run(&self, folder: &Path, arguments: &[&str]) -> std::process::Output {
        let mut command = self.command(env!("CARGO_BIN_EXE_poseshift").as_ref());
        let command = command.current_dir(folder).args(arguments);
        // as wide as where nobody looks
        let output = command.env_remove("COLUMNS").output();
        output.expect("the program starts")
    }
}

/// Gives a file or folder other permissions.
#[cfg(unix)]
pub fn permit(path: &Path, mode: u32) {
    use std::os::unix::fs::PermissionsExt;
    let permissions = std::fs::Permissions::from_mode(mode);
    std::fs::set_permissions(path, permissions).expect("scratch");
}

/// What a command that succeeds prints with `--json`.
pub fn report(command: &mut assert_cmd::Command) -> serde_json::Value {
    let run = command.output().expect("the program starts");
    assert_eq!(
        run.status.code(),
        Some(0),
        "{command:?}: {}{}",
        String::from_utf8_lossy(&run.stderr),
        String::from_utf8_lossy(&run.stdout)
    );
    serde_json::from_slice(&run.stdout).expect("JSON")
}

/// A new empty folder that is gone at the end of the test.
pub fn scratch() -> tempfile::TempDir {
    tempfile::tempdir().expect("a folder for scratch files")
}

/// Every file below a folder, relative to it, in order.
pub fn files_below(folder: &Path) -> Vec<PathBuf> {
    let below = |entry: Result<walkdir::DirEntry, walkdir::Error>| {
        let entry = entry.expect("a readable folder");
        let relative = entry.path().strip_prefix(folder).expect("below").to_owned();
        entry.file_type().is_file().then_some(relative)
    };
    walkdir::WalkDir::new(folder)
        .sort_by_file_name()
        .into_iter()
        .filter_map(below)
        .collect()
}

/// The source files of the program and of its crates: place below `src`, text.
pub fn sources() -> Vec<(PathBuf, String)> {
    let crates = repository("crates");
    let mut folders: Vec<PathBuf> = std::fs::read_dir(&crates)
        .expect("the crates")
        .map(|entry| entry.expect("a crate").path().join("src"))
        .collect();
    folders.push(repository("src"));
    folders.sort();
    let of_folder = |folder: PathBuf| {
        // a crate that is one module has no folder of its name
        let is_module = folder.ends_with("profile/src");
        let module = PathBuf::from(if is_module { "profile" } else { "" });
        files_below(&folder)
            .into_iter()
            .filter(|file| file.extension().is_some_and(|ending| ending == "rs"))
            .map(move |file| {
                let text = std::fs::read_to_string(folder.join(&file)).expect("source");
                (module.join(file), text)
            })
    };
    folders.into_iter().flat_map(of_folder).collect()
}

/// Runs the program at the top of the repository: status, standard output, standard error.
pub fn run(arguments: &[&str]) -> (i32, String, String) {
    let output = poseshift()
        .current_dir(repository(""))
        .args(arguments)
        .output()
        .expect("the program starts");
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("UTF-8");
    (
        output.status.code().expect("it ended"),
        text(output.stdout),
        text(output.stderr),
    )
}

/// Runs a command in a folder: status, standard output, and standard error in one line.
pub fn run_in(folder: &Path, command: &str) -> (Option<i32>, String, String) {
    let output = poseshift()
        .current_dir(folder)
        .args(command.split(' '))
        .output()
        .expect("the program starts");
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    let words = |text: String| text.split_whitespace().collect::<Vec<_>>().join(" ");
    let out = text(&output.stdout);
    (output.status.code(), out, words(text(&output.stderr)))
}

/// The files of the repository as git has them, relative to its top: what lies about besides is
/// none of them. Of an archive without git, every file that is there.
pub fn tracked() -> &'static std::collections::BTreeSet<PathBuf> {
    static FILES: std::sync::OnceLock<std::collections::BTreeSet<PathBuf>> =
        std::sync::OnceLock::new();
    FILES.get_or_init(|| {
        let listed = std::process::Command::new("git")
            .args(["ls-files", "-z"])
            .current_dir(repository(""))
            .output()
            .ok()
            .filter(|output| output.status.success() && !output.stdout.is_empty());
        match listed {
            Some(output) => String::from_utf8(output.stdout)
                .expect("plain names")
                .split_terminator('\0')
                .map(PathBuf::from)
                .collect(),
            None => files_below(&repository("")).into_iter().collect(),
        }
    })
}

/// Whether a word names a file of the repository or a folder of such.
pub fn is_tracked(word: &str) -> bool {
    let path = Path::new(word.trim_end_matches('/'));
    !word.is_empty() && tracked().iter().any(|file| file.starts_with(path))
}

/// Arms of `tests/data/inverse_general/arms.csv`, whose axes 4 and 5 meet offset from axis 6: name,
/// nominal geometry without a tool, mechanism.
pub fn offset_wrist_arms() -> Vec<(
    String,
    poseshift::model::Geometry,
    poseshift::model::Mechanism,
)> {
    use poseshift::geometry::Pose;
    use poseshift::model::{Geometry, JointSense, Link, Mechanism};
    let arm = |row: &Row| {
        let number =
            |key: &str, i: usize, unit: &str| row.number(&format!("{key}{}_{unit}", i + 1));
        let links = std::array::from_fn(|i| Link {
            alpha_rad: number("alpha", i, "deg").to_radians(),
            a_m: number("a", i, "mm") / 1e3,
            beta_rad: 0.0,
            theta_rad: number("theta", i, "deg").to_radians(),
            d_m: number("d", i, "mm") / 1e3,
        });
        let joints = std::array::from_fn(|i| JointSense {
            sign: 1.0,
            offset_rad: 0.0,
            min_rad: number("min", i, "deg").to_radians(),
            max_rad: number("max", i, "deg").to_radians(),
        });
        let geometry = Geometry {
            world_from_base: Pose::identity(),
            links,
            link6_from_flange: Pose::identity(),
            flange_from_tool: Pose::identity(),
            flange_from_nominal_tool: Pose::identity(),
            bodies: Vec::new(),
            load: None,
            gravity_m_s2: [0.0, 0.0, -9.81],
            tool_name: String::new(),
            carried: None,
        };
        let coupling = Vec::new();
        (
            row.text("arm").to_owned(),
            geometry,
            Mechanism { joints, coupling },
        )
    };
    table("tests/data/inverse_general/arms.csv")
        .iter()
        .map(arm)
        .collect()
}

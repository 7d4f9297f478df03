//! `plan`: which configurations to measure.

use super::ending::{Ending, ReportFile, finish, finish_with_data};
use super::files::Files;
use super::measurements::{level, picks};
use super::progress::Progress;
use super::{Answer, Output, values};
use crate::geometry::units::{DEG, m_from_mm};
use crate::identify::parameters::Selection;
use crate::identify::plan::{Constraints, Request};
use crate::printable::name_of;
use crate::task::plan::{Wanted, given, plan, plan_plate};
use crate::task::{Failure, ProfileFile};
use clap::Args;
use std::path::PathBuf;

/// Choose configurations to measure by observability
#[derive(Args)]
pub(super) struct PlanCommand {
    /// Robot profile (YAML)
    #[arg(long, value_name = "FILE")]
    profile: PathBuf,
    /// How many configurations
    #[arg(long, value_name = "N")]
    count: usize,
    /// Joint angles to write (CSV); without it they are printed
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// A program that drives there, every gearbox arriving from below
    #[arg(long, value_name = "FILE")]
    program: Option<PathBuf>,
    /// Language of the program (default: that of the profile)
    #[arg(long, value_name = "NAME", requires = "program")]
    language: Option<String>,
    /// Random configurations to choose from
    #[arg(long, value_name = "N", default_value_t = 5000)]
    candidates: usize,
    /// Random sets to start from; the best set found is improved once more
    #[arg(long, value_name = "N", default_value_t = 4)]
    starts: usize,
    /// Seed of the random numbers
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// 0 frames alone; 1 and joint offsets and scales; 2 and link geometry; 3 and joint compliance
    #[arg(long, value_name = "0..3", default_value_t = 3, value_parser = clap::value_parser!(u8).range(0..=3))]
    level: u8,
    /// Effects to identify as well
    #[arg(long, value_name = "LIST")]
    identify: Option<String>,
    /// Effects that are known
    #[arg(long, value_name = "LIST")]
    fix: Option<String>,
    /// Tool of the profile (default: its only one)
    #[arg(long, value_name = "NAME")]
    tool: Option<String>,
    /// Standard deviation of a coordinate of the device
    #[arg(long, value_name = "MM", default_value_t = 0.05)]
    sigma_mm: f64,
    /// The device measures orientations too
    #[arg(long)]
    poses: bool,
    /// Configurations that are in the set already (CSV)
    #[arg(long, value_name = "FILE")]
    given: Option<PathBuf>,
    /// Places along each axis of a track that configurations are chosen at, evenly over its limits
    #[arg(long, value_name = "N", default_value_t = 11)]
    stations: usize,
    /// Choose angles of this positioner at which reflectors on its plate are measured
    #[arg(long, value_name = "NAME", conflicts_with_all = ["program", "language", "tool", "given", "inside_mm", "keep_out_mm", "device_mm"])]
    plate: Option<String>,
    /// Roughly where a reflector is on the plate: x,y,z in mm; may be given again (default: the
    /// profile's points there)
    #[arg(
        long,
        value_name = "X,Y,Z",
        allow_hyphen_values = true,
        requires = "plate"
    )]
    reflector: Vec<String>,
    /// Distance from the joint limits
    #[arg(long, value_name = "DEG", default_value_t = 1.0)]
    margin_deg: f64,
    /// Every gearbox arrives from so far below
    #[arg(long, value_name = "DEG", default_value_t = 5.0)]
    approach_deg: f64,
    /// The tool is inside this box of the world wherever it is measured and approached from:
    /// x0,y0,z0,x1,y1,z1 in mm
    #[arg(long, value_name = "BOX", allow_hyphen_values = true)]
    inside_mm: Option<String>,
    /// Tool, wrist and elbow are outside this box wherever it is measured and approached from; may
    /// be given again
    #[arg(long, value_name = "BOX", allow_hyphen_values = true)]
    keep_out_mm: Vec<String>,
    /// Where the device stands: x,y,z in mm; the tool's z axis points to it within --cone-deg
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true)]
    device_mm: Option<String>,
    /// Half angle in which the reflector is seen
    #[arg(
        long,
        value_name = "DEG",
        default_value_t = 30.0,
        requires = "device_mm"
    )]
    cone_deg: f64,
    #[command(flatten)]
    report: ReportFile,
}

fn metres_box(option: &str, text: &str) -> Result<[[f64; 3]; 2], Failure> {
    let [a, b, c, d, e, f] = values::numbers::<6>(option, text)?.map(m_from_mm);
    Ok([
        [a.min(d), b.min(e), c.min(f)],
        [a.max(d), b.max(e), c.max(f)],
    ])
}

impl PlanCommand {
    fn request(&self, files: &Files, profile: &ProfileFile) -> Result<Request, Failure> {
        let (given, given_stands) = match &self.given {
            None => (Vec::new(), Vec::new()),
            Some(path) => given(&files.source(path)?, &profile.profile)?,
        };
        let keep_out = self
            .keep_out_mm
            .iter()
            .map(|t| metres_box("--keep-out-mm", t));
        let device = self
            .device_mm
            .as_deref()
            .map(|t| values::numbers::<3>("--device-mm", t))
            .transpose()?;
        Ok(Request {
            count: self.count,
            candidates: self.candidates,
            starts: self.starts,
            seed: self.seed,
            sigma_m: m_from_mm(self.sigma_mm),
            poses: self.poses,
            given,
            given_stands,
            stations: self.stations,
            constraints: Constraints {
                margin_rad: self.margin_deg * DEG,
                approach_rad: self.approach_deg * DEG,
                inside: self
                    .inside_mm
                    .as_deref()
                    .map(|t| metres_box("--inside-mm", t))
                    .transpose()?,
                keep_out: keep_out.collect::<Result<_, _>>()?,
                sight: device.map(|at| (at.map(m_from_mm), self.cone_deg * DEG)),
            },
        })
    }

    pub(super) fn run(&self, output: Output) -> Result<Answer, Failure> {
        let files = Files::default();
        let profile = files.profile(&self.profile)?;
        let progress = Progress::new(output, "reading");
        let request = self.request(&files, &profile)?;
        let outputs = self.output.iter().chain(&self.program);
        self.report
            .refuse_over(&files, outputs.map(PathBuf::as_path))?;
        let selection = Selection {
            level: level(self.level),
            identify: picks("--identify", self.identify.as_deref())?,
            fix: picks("--fix", self.fix.as_deref())?,
            priors: false,
        };
        let name = self.program.as_deref().map(name_of);
        let wanted = name.as_deref().map(|name| Wanted {
            name,
            language: self.language.as_deref(),
        });
        progress.say("choosing");
        let mut hear = |done, of| progress.tell(done, of);
        let mut found = match &self.plate {
            Some(name) => {
                let each = self.reflector.iter();
                let each = each.map(|t| values::numbers::<3>("--reflector", t));
                let reflectors: Vec<[f64; 3]> = each.collect::<Result<_, _>>()?;
                let reflectors: Vec<[f64; 3]> =
                    reflectors.iter().map(|p| p.map(m_from_mm)).collect();
                let on = (name.as_str(), reflectors.as_slice());
                plan_plate(&profile, on, &selection, &request, &mut hear)?
            }
            None => plan(
                &profile,
                self.tool.as_deref(),
                &selection,
                &request,
                wanted.as_ref(),
                &|path| files.mesh(path),
                &mut hear,
            )?,
        };
        let mut written = Vec::new();
        let table = self.output.iter().zip([found.csv()]);
        let program = self.program.iter().zip(found.program.clone());
        for (path, text) in table.chain(program) {
            written.push((path.clone(), text.into_bytes().into()));
            found.output.push(name_of(path));
        }
        found.output.extend(self.report.name());
        let ending = Ending {
            written,
            report: Some(&self.report),
            progress: Some(progress),
            ..Ending::default()
        };
        if self.output.is_some() || output.json {
            return finish(&files, &found, ending, output);
        }
        // the table is the answer; what it is worth stands next to it
        finish_with_data(&files, &found, found.csv(), ending, output)
    }
}

//! Which parameters are identified, in which order they are kept where the data cannot tell them
//! apart.

use super::pick::Pick;
use crate::model::effects::{Effect, Kind, List, MOST_PARAMETERS, Site, Unit};
use crate::model::{JOINTS, Slot};
use crate::profile::Profile;

/// Axes are parallel where the sine of the angle between them is below this: there β stands for the
/// d it makes redundant.
const PARALLEL: f64 = 0.1;
/// Parameters of this rank and above have a typical size; base, tool and points may be anywhere.
pub const FIRST_PHYSICAL: u32 = 2;
/// How far a measured point may be from where it is believed, one standard deviation, metres.
const POINT_SIGMA_M: f64 = 0.01;

/// What a parameter is a number of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Subject {
    /// An effect.
    Effect(Slot),
    /// A coordinate of a measured point.
    Point {
        /// Index of the point.
        point: usize,
        /// Which coordinate.
        axis: usize,
    },
    /// A number of something that the probe touched.
    Feature {
        /// Index of the feature.
        feature: usize,
        /// Which of its numbers.
        value: usize,
    },
}

/// One number that is identified.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// Its name: `link_geometry link 2 a_mm`, `point smr1 x_mm`.
    pub key: String,
    /// What it is a number of.
    pub subject: Subject,
    /// The unit of the report.
    pub unit: Unit,
    /// How large it typically is, SI: the scale in which columns are compared.
    pub scale: f64,
    /// Which is kept where the data cannot tell two apart: the smaller.
    pub rank: u32,
    /// Its expectation and standard deviation in SI, where they count as one more measurement.
    pub prior: Option<(f64, f64)>,
    /// A person asked for it by name: it is kept however little is known of it.
    pub asked: bool,
}

impl Parameter {
    /// A value of it in the unit of reports, with digits enough to tell it from none.
    #[must_use]
    pub fn digits(&self, si: f64) -> String {
        let x = si / self.unit.in_si();
        if x.abs() < 1e-2 && x != 0.0 {
            format!("{x:.3e}")
        } else {
            format!("{x:.5}")
        }
    }
}

/// How much of the arm is identified.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Level {
    /// Where base, tool and points are.
    Frames,
    /// And joint offsets and scales.
    Joints,
    /// And the geometry of links 2 to 6, with β where axes are nearly parallel; no scales.
    Geometry,
    /// And the compliance of the joints.
    Compliance,
}

/// What is identified.
#[derive(Clone, Debug, PartialEq)]
pub struct Selection {
    /// How much of the arm.
    pub level: Level,
    /// More than that.
    pub identify: Vec<Pick>,
    /// Left as they are.
    pub fix: Vec<Pick>,
    /// Whether each parameter's typical size counts as one more measurement.
    pub priors: bool,
}

impl Selection {
    /// A level alone.
    #[must_use]
    pub const fn level(level: Level) -> Self {
        Self {
            level,
            identify: Vec::new(),
            fix: Vec::new(),
            priors: false,
        }
    }

    /// What of it concerns the arm, in a file with points on plates.
    #[must_use]
    pub fn of_tool(&self) -> Self {
        self.with(|kind| !kind.definition().of_positioner())
    }

    /// What of it concerns positioners.
    #[must_use]
    pub fn of_plates(&self) -> Self {
        self.with(|kind| kind.definition().of_positioner())
    }

    fn with(&self, keep: impl Fn(Kind) -> bool) -> Self {
        let mut kept = self.clone();
        kept.identify.retain(|pick| pick.kind.is_none_or(&keep));
        kept
    }

    pub(super) fn wants_points(&self) -> bool {
        self.identify.iter().any(|pick| pick.kind.is_none())
    }
}

/// What the measurements can show of the tool.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Seen {
    /// Names of the tools, and whether their turning shows.
    pub tools: Vec<(String, bool)>,
    /// Whether the tool's place is sought in the tool frame: it is not where the measured points
    /// are.
    pub tool_frame: bool,
    /// Names of points with unknown coordinates, by index.
    pub unknown_points: Vec<(usize, String)>,
    /// Joints that carry a torque that changes.
    pub loaded: [bool; JOINTS],
    /// At how many places each external axis stood.
    pub places: Vec<usize>,
    /// Parameters of unknown features, which are kept first.
    pub features: Vec<Parameter>,
    /// Mean temperature of the rows that have one, °C.
    pub mean_c: Option<f64>,
}

fn nearly_parallel(profile: &Profile, link: usize) -> bool {
    profile.links[link].alpha_rad.sin().abs() < PARALLEL
}

pub(super) fn at(kind: Kind, index: usize) -> Effect {
    Effect {
        kind,
        site: Site {
            index,
            ..Site::default()
        },
        parameters: [0.0; MOST_PARAMETERS],
    }
}

/// The keys of one link's geometry that a complete and minimal model has.
#[must_use]
pub fn minimal(profile: &Profile, link: usize, key: &str) -> bool {
    match key {
        "beta_deg" => nearly_parallel(profile, link),
        "d_mm" => link == 5 || !nearly_parallel(profile, link + 1),
        _ => true,
    }
}

/// The order in which parameters are kept.
fn rank(profile: &Profile, effect: &Effect, key: &str) -> u32 {
    match effect.kind {
        Kind::BaseFrame => 0,
        Kind::ToolFrame => 1,
        Kind::LinkGeometry if effect.site.index == 0 => 9,
        Kind::LinkGeometry if !minimal(profile, effect.site.index, key) => 8,
        Kind::LinkGeometry => match key {
            "theta_deg" => 2,
            "a_mm" => 3,
            "alpha_deg" => 4,
            "beta_deg" => 5,
            _ => 6,
        },
        Kind::PositionerPlate => 1,
        Kind::PositionerAxis => 2,
        _ if effect.definition().of_positioner() && !effect.definition().has_periods() => 3,
        _ => 7,
    }
}

/// Effects, and which of their parameters are sought.
pub(super) struct Wanted {
    effects: Vec<Effect>,
    keys: Vec<(usize, &'static str)>,
}

impl Wanted {
    /// Nothing but what the profile has.
    pub(super) fn of(profile: &Profile) -> Self {
        Self {
            effects: profile.effects.clone(),
            keys: Vec::new(),
        }
    }

    /// Those parameters of an effect that `keep` names.
    pub(super) fn add(&mut self, effect: &Effect, keep: &dyn Fn(&str) -> bool) {
        let known = self.effects.iter().position(|e| e.same_place(effect));
        let index = known.unwrap_or_else(|| {
            self.effects.push(effect.clone());
            self.effects.len() - 1
        });
        for parameter in effect.definition().parameters {
            if keep(parameter.key) && !self.keys.contains(&(index, parameter.key)) {
                self.keys.push((index, parameter.key));
            }
        }
    }

    /// The effects, and the parameters in the order in which they are kept: features first, then
    /// these without what is fixed, and the coordinates of unknown points, by rank.
    pub(super) fn parameters(
        mut self,
        profile: &Profile,
        selection: &Selection,
        features: Vec<Parameter>,
        unknown_points: &[(usize, String)],
    ) -> (Vec<Effect>, Vec<Parameter>) {
        self.keys.retain(|(index, key)| {
            !selection
                .fix
                .iter()
                .any(|pick| pick.holds(&self.effects[*index], key))
        });
        let mut parameters = features;
        for (index, key) in self.keys {
            let effect = &self.effects[index];
            let all = effect.definition().parameters;
            let number = all.iter().position(|p| p.key == key).expect("its own key");
            let scale = all[number].prior_sigma * all[number].unit.in_si();
            parameters.push(Parameter {
                key: format!("{} {key}", effect.label()),
                subject: Subject::Effect(Slot {
                    effect: index,
                    parameter: number,
                }),
                unit: all[number].unit,
                scale,
                rank: rank(profile, effect, key),
                prior: (selection.priors && effect.kind != Kind::BaseFrame).then_some((0.0, scale)),
                asked: (selection.identify.iter())
                    .any(|pick| !pick.together && pick.holds(effect, key)),
            });
        }
        let fixed = selection.fix.iter().any(|pick| pick.kind.is_none());
        for (point, name) in unknown_points.iter().filter(|_| !fixed) {
            for (axis, key) in ["x_mm", "y_mm", "z_mm"].into_iter().enumerate() {
                parameters.push(Parameter {
                    key: format!("point {name} {key}"),
                    subject: Subject::Point {
                        point: *point,
                        axis,
                    },
                    unit: Unit::Millimetre,
                    scale: POINT_SIGMA_M,
                    rank: 0,
                    prior: None,
                    asked: false,
                });
            }
        }
        parameters.sort_by_key(|p| p.rank);
        (self.effects, parameters)
    }
}

/// The temperature at which an effect counts for nothing, by its number and key, where lengths are
/// identified along: at another one they are others, and nothing else differs. It stays where the
/// profile has it, or at the mean of the rows, unless it is asked for by its own key.
fn gauge(effect: &Effect, pick: &Pick, level: Level) -> Option<(usize, &'static str)> {
    let with_lengths = matches!(level, Level::Geometry | Level::Compliance);
    let (number, list) = effect.definition().listed()?;
    (with_lengths && list == List::Temperatures && pick.key.is_none())
        .then(|| (number, effect.definition().parameters[number].key))
}

/// The effects of a problem and the parameters that are identified, in the order in which they are
/// kept.
pub(super) fn choose(
    profile: &Profile,
    selection: &Selection,
    seen: &Seen,
) -> (Vec<Effect>, Vec<Parameter>) {
    let mut wanted = Wanted::of(profile);
    wanted.add(&at(Kind::BaseFrame, 0), &|_| true);
    for (tool, turning) in seen.tools.iter().filter(|_| seen.tool_frame) {
        let mut effect = at(Kind::ToolFrame, 0);
        if !wanted.effects.iter().any(|e| e.same_place(&effect)) || seen.tools.len() > 1 {
            effect.site.tool = Some(tool.clone());
        }
        wanted.add(&effect, &|key| *turning || key.ends_with("_mm"));
    }
    if selection.level == Level::Joints {
        for joint in 0..JOINTS {
            wanted.add(&at(Kind::LinkGeometry, joint), &|key| {
                key == "theta_deg" && joint > 0
            });
            wanted.add(&at(Kind::JointScale, joint), &|_| true);
        }
    }
    if matches!(selection.level, Level::Geometry | Level::Compliance) {
        for link in 1..JOINTS {
            wanted.add(&at(Kind::LinkGeometry, link), &|key| {
                minimal(profile, link, key)
            });
        }
    }
    if selection.level == Level::Compliance {
        for joint in (0..JOINTS).filter(|joint| seen.loaded[*joint]) {
            wanted.add(&at(Kind::JointCompliance, joint), &|_| true);
        }
    }
    let of_track = matches!(selection.level, Level::Geometry | Level::Compliance);
    let of_track = if of_track && !profile.external.track.is_empty() {
        Pick::track()
    } else {
        Vec::new()
    };
    for pick in of_track.iter().chain(&selection.identify) {
        for effect in pick.effects() {
            if !pick.is_shown(&effect, profile, &seen.places) {
                continue;
            }
            let mut effect = effect;
            if effect.kind == Kind::ToolFrame {
                effect.site.tool = seen.tools.first().map(|(name, _)| name.clone());
            }
            let gauge = gauge(&effect, pick, selection.level);
            if let (Some((number, _)), Some(mean)) = (gauge, seen.mean_c) {
                effect.parameters[number] = mean;
            }
            let is_gauge = |key: &str| gauge.is_some_and(|(_, own)| own == key);
            wanted.add(&effect, &|key| {
                pick.holds(&effect, key) && effect.has(key) && !is_gauge(key)
            });
        }
    }
    let features = seen.features.clone();
    wanted.parameters(profile, selection, features, &seen.unknown_points)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::identify::measurements::Measurements;
    use crate::identify::problem::Problem;

    #[test]
    fn the_temperature_of_lengths_is_held_where_lengths_are_identified() {
        let text = include_str!("../../../../robots/abb_irb120_thesis.yaml");
        let profile = Profile::from_yaml(text).expect("a shipped profile");
        let rows = "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg,x_mm,y_mm,z_mm,temperature_c\n\
                    0,0,0,0,30,0,400,0,600,18\n10,20,-30,40,50,60,300,100,500,28\n\
                    -20,10,5,-40,60,90,350,-90,550,26\n";
        let rows = Measurements::from_csv(rows.as_bytes()).expect("rows");
        let chosen = |profile: &Profile, level, word: &str| {
            let mut selection = Selection::level(level);
            selection.identify = Pick::parse_list(word).expect("a word");
            let (problem, start) =
                Problem::new(profile, &rows, &selection, profile.world_from_base).expect("rows");
            let growth = start.effects.iter().find(|e| e.label() == "thermal_growth");
            let reference = growth.expect("it is asked for").parameters[1];
            let mut keys = problem.parameters.iter().map(|p| p.key.as_str());
            let is_sought = keys.any(|key| key == "thermal_growth reference_c");
            let mut keys = problem.parameters.iter().map(|p| p.key.as_str());
            assert!(word.contains('.') || keys.any(|key| key == "thermal_growth per_k"));
            (is_sought, reference)
        };
        let whole = "thermal_growth";
        assert_eq!(chosen(&profile, Level::Geometry, whole), (false, 24.0));
        // with all lengths as they are it says at which temperature they are so
        assert!(chosen(&profile, Level::Frames, whole).0);
        assert!(chosen(&profile, Level::Geometry, "thermal_growth.reference_c").0);
        let mut known = profile.clone();
        let mut growth = at(Kind::by_id(whole).expect("an effect"), 0);
        growth.parameters[..2].copy_from_slice(&[1.2e-5, 20.0]);
        known.effects.push(growth);
        assert_eq!(chosen(&known, Level::Geometry, whole), (false, 20.0));
    }
}

//! What every language does.

use super::deciding::Deciding;
use super::insert::{Inserted, Insertions};
use super::script::{self, Script};
use super::{
    Configuration, Decoded, Layout, Marker, Posture, ReadError, Role, Settings, Shape, Source,
    Step, Value,
};
use crate::geometry::Pose;
use crate::geometry::units::DEG;

/// No target, tool or work frame has a larger angle, degrees: two whole rotations.
pub(crate) const MOST_ANGLE_DEG: f64 = 720.0;

/// What a language is called and does; the text of `poseshift languages`.
#[derive(Debug)]
pub struct About {
    /// Name in profiles and on the command line.
    pub id: &'static str,
    /// Name for people.
    pub name: &'static str,
    /// File name endings, lower case, without the dot.
    pub extensions: &'static [&'static str],
    /// What is rewritten.
    pub rewrites: &'static [&'static str],
    /// What is seen and left as it is.
    pub leaves: &'static [&'static str],
    /// What is reported and blocks the file.
    pub refuses: &'static [&'static str],
    /// What a file of it has at least; said of one that has not.
    pub has: &'static str,
}

/// One programming language of robots.
pub trait Language: Sync {
    /// Its names and what it handles.
    fn about(&self) -> &'static About;

    /// Whether lengths are in metres in its text; millimetres elsewhere.
    fn is_in_metres(&self) -> bool {
        false
    }

    /// Whether the content looks like a program of this language (for files whose ending does not
    /// tell).
    fn recognises(&self, source: &Source) -> bool;

    /// Whether a file whose name ends as programs of this language do is one: also one that has nothing
    /// of this language alone, such as a function that moves nothing.
    fn accepts(&self, source: &Source) -> bool {
        self.recognises(source)
    }

    /// Whether a file may be one of another controller's own: its name ends as files of others do, too,
    /// and nothing in it is of this language.
    fn may_be_foreign(&self, source: &Source) -> bool {
        let _ = source;
        false
    }

    /// Translates program files that belong together into statements: data in one may be used in
    /// another. The files are texts of at most 4 GiB.
    ///
    /// # Errors
    /// Where the text is not a program of this language or is broken.
    fn script(&self, sources: &[Source], settings: &Settings) -> Result<Script, ReadError>;

    /// A tool (`is_tool`) or a work frame of its parts; where it cannot be one a remark says why.
    ///
    /// # Errors
    /// Where a part is a number that no robot can use.
    fn frame_of(
        &self,
        is_tool: bool,
        name: &str,
        parts: &[script::Part],
        sources: &[Source],
    ) -> Result<Result<script::NamedFrame, script::Remark>, ReadError> {
        let _ = (is_tool, parts, sources);
        Ok(Ok(script::NamedFrame::still(name, None)))
    }

    /// Name of the work frame that targets without one stand in: the world unless the command line
    /// gives another for it.
    fn frame_of_unframed(&self) -> Option<&'static str> {
        None
    }

    /// What each number of a pose is, in the order of [`super::Target::numbers`].
    fn pose_roles(&self, layout: Layout) -> &'static [Role];

    /// What each number of a target is, in the order of [`super::Target::numbers`].
    fn roles(&self, layout: Layout) -> &'static [Role] {
        match layout.shape {
            Shape::Pose => self.pose_roles(layout),
            Shape::Joints => &[Role::Joint; 6],
        }
    }

    /// The largest number that a target's orientation can have: beyond it none is meant.
    fn most_orientation(&self, layout: Layout) -> f64 {
        let _ = layout;
        MOST_ANGLE_DEG
    }

    /// Whether a file of this name is a record of the controller that ends as programs do: a log in a
    /// backup, conditions that no target depends on.
    fn is_record(&self, file: &str) -> bool {
        let _ = file;
        false
    }

    /// Whether positions say in which work frame they are: then none is given to those that no move
    /// goes to.
    fn has_framed_positions(&self) -> bool {
        false
    }

    /// Whether the controller takes up the orientation that is written for the point in the middle
    /// of an arc; else it rotates the tool from the beginning of the arc to its end and looks at the
    /// point's position alone.
    fn turns_through_middle(&self) -> bool {
        false
    }

    /// Whether the tool turns on arcs as seen from the path, and not in the work frame.
    fn turns_with_path(&self) -> bool {
        false
    }

    /// Decimals of a number that are worth `millimetre_decimals` of a millimetre, for a tool a
    /// metre away where it is an angle or part of a quaternion. Most languages write
    /// millimetres and degrees: a thousandth of a millimetre is 6e-5 degrees there.
    fn decimals(&self, role: Role, millimetre_decimals: usize) -> usize {
        match role {
            Role::Position => millimetre_decimals,
            Role::Orientation | Role::Joint => millimetre_decimals + 2,
            Role::Configuration => 0,
        }
    }

    /// Decimals that a number gets at least, so that rounding stays below a thousandth of a
    /// millimetre and of a degree where the controller takes as many.
    fn least_decimals(&self, role: Role) -> usize {
        self.decimals(role, 3)
    }

    /// How fast the tool rotates at most on a move whose speed in millimetres is read; `None` where
    /// programs or controllers say it otherwise.
    fn rotation_speed_rad_s(&self) -> Option<f64> {
        None
    }

    /// The pose of a target's numbers: `frame_from_tool`, metres.
    fn pose_of(&self, layout: Layout, numbers: &[f64]) -> Pose;

    /// Writes a pose into the numbers of a target, which hold the present ones: signs and turns
    /// that the pose leaves open stay as near to these as they can.
    fn write_pose(&self, layout: Layout, pose: &Pose, numbers: &mut [f64]);

    /// How many radians one of each joint's numbers is.
    fn joint_units(&self, layout: Layout, settings: &Settings) -> [f64; 6] {
        let _ = (layout, settings);
        [DEG; 6]
    }

    /// The inverse solutions that the configuration data of a pose allow.
    fn configuration(&self, layout: Layout, numbers: &[f64]) -> Configuration {
        let _ = (layout, numbers);
        Configuration::default()
    }

    /// Changes the configuration data among the numbers of a pose where `before` and `after` (the
    /// controller's joints for the old and the new pose) truly differ in them.
    fn update_configuration(
        &self,
        layout: Layout,
        before: &Posture,
        after: &Posture,
        numbers: &mut [f64],
    ) {
        let _ = (layout, before, after, numbers);
    }

    /// The meaning of a target's numbers, as many as it has roles.
    fn decode(&self, layout: Layout, numbers: &[f64], settings: &Settings) -> Decoded {
        Decoded {
            value: self.value(layout, numbers, settings),
            configuration: match layout.shape {
                Shape::Pose => self.configuration(layout, numbers),
                Shape::Joints => Configuration::default(),
            },
        }
    }

    /// The pose or the joints alone that a target's numbers mean.
    fn value(&self, layout: Layout, numbers: &[f64], settings: &Settings) -> Value {
        match layout.shape {
            Shape::Pose => Value::Pose(self.pose_of(layout, numbers)),
            Shape::Joints => {
                let unit = self.joint_units(layout, settings);
                Value::Joints(std::array::from_fn(|i| numbers[i] * unit[i]))
            }
        }
    }

    /// Writes `value` into `numbers`, which hold the target's present ones; see
    /// [`Self::write_pose`] and [`Self::update_configuration`].
    ///
    /// # Panics
    /// If the value is of another shape than the target.
    fn encode(
        &self,
        layout: Layout,
        value: &Value,
        before: &Posture,
        after: &Posture,
        settings: &Settings,
        numbers: &mut [f64],
    ) {
        match (layout.shape, value) {
            (Shape::Pose, Value::Pose(pose)) => {
                self.write_pose(layout, pose, numbers);
                self.update_configuration(layout, before, after, numbers);
            }
            (Shape::Joints, Value::Joints(joints)) => {
                let unit = self.joint_units(layout, settings);
                for (i, number) in numbers.iter_mut().enumerate() {
                    *number = joints[i] / unit[i];
                }
            }
            _ => panic!("a value of the other shape"),
        }
    }

    /// Writes one of a target's configuration data, the `index`-th of its numbers, in the manner of
    /// the text it replaces. Most languages write whole numbers.
    fn write_configuration(
        &self,
        layout: Layout,
        index: usize,
        value: f64,
        old: &[u8],
        out: &mut Vec<u8>,
    ) {
        let _ = (layout, index, old);
        out.extend_from_slice(format!("{value}").as_bytes());
    }

    /// What stands before and behind the `index`-th number of a target where it is put into a text
    /// that leaves it out.
    fn around_missing(&self, layout: Layout, index: usize) -> (String, &'static str) {
        let _ = (layout, index);
        (String::new(), "")
    }

    /// Whether numbers that a text leaves out are known by their place alone: one that is put in has
    /// those before it in front.
    fn has_missing_in_order(&self) -> bool {
        false
    }

    /// Text that puts moves between those of one file. A move that cannot be repeated, because its
    /// text does more than go to its target, is refused; by default all are.
    fn insert(&self, into: &Insertions) -> Inserted {
        Inserted::none(into.list)
    }

    /// Why the text of a move cannot be repeated, where the language tells.
    fn forbids_repeating(&self, text: &[u8]) -> Option<&'static str> {
        let _ = text;
        None
    }

    /// Whether a byte stands in lines that the pendant writes again from what it has in a form.
    fn is_in_form(&self, bytes: &[u8], at: usize) -> bool {
        let _ = (bytes, at);
        false
    }

    /// How statements read numbers of targets, and decide.
    fn deciding(&self) -> Option<&'static Deciding> {
        None
    }

    /// The names of external axes in the order of their offsets, see
    /// [`crate::program::ExternalState::offset`].
    fn external_names(&self) -> [&'static str; 6] {
        ["E1", "E2", "E3", "E4", "E5", "E6"]
    }

    /// A program that drives through configurations; `None` where none can be written in this
    /// language, or not with these settings.
    fn drive(&self, steps: &[Step], settings: &Settings) -> Option<String> {
        let _ = (steps, settings);
        None
    }

    /// Where the marker goes and its text in the file's own line ends.
    fn mark(&self, source: &Source, marker: &Marker) -> (usize, Vec<u8>);
}

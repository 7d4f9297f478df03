//! A program with all that is known of its tools, work frames and arm.

use super::arms::Equipped;
use super::posture::{self, Asked};
use super::setting::{Given, Missing, PlacementError, Setting};
use crate::finding::{Finding, Severity};
use crate::geometry::Pose;
use crate::inverse::{Arm, Branch, Unsupported};
use crate::model::Conditions;
use crate::model::profile::Profile;
use crate::program::{
    Configuration, FrameId, Language, Move, Program, Settings, Shape, Source, TargetId, ToolId,
    Value,
};

/// A program with all that is known of its tools, work frames and arm.
pub(crate) struct Ground<'a> {
    pub language: &'a dyn Language,
    pub settings: &'a Settings,
    pub program: &'a Program,
    pub sources: &'a [Source],
    pub profile: &'a Profile,
    pub setting: Setting,
    /// The arm with each tool of the setting that a move needs.
    pub arms: Vec<Option<Equipped>>,
    /// Where the part really stands: moves every wanted pose in the world.
    pub work_offset: Option<Pose>,
}

impl<'a> Ground<'a> {
    /// Of a program; `needs` tells which moves need a known tool and work frame.
    ///
    /// # Errors
    /// All tools and frames that are needed and that nobody knows; an arm without an inverse.
    pub(crate) fn new<E: From<PlacementError> + From<Unsupported>>(
        language: &'a dyn Language,
        settings: &'a Settings,
        program: &'a Program,
        sources: &'a [Source],
        profile: &'a Profile,
        given: &Given,
        needs: impl Fn(&Move) -> bool,
    ) -> Result<Self, E> {
        let setting = Setting::of(language, program, profile, given);
        let mut ground = Self {
            language,
            settings,
            program,
            sources,
            profile,
            setting,
            arms: Vec::new(),
            work_offset: None,
        };
        ground.check_known(&needs)?;
        ground.equip(&needs)?;
        Ok(ground)
    }

    fn check_known(&self, needs: &impl Fn(&Move) -> bool) -> Result<(), PlacementError> {
        let mut missing: Vec<Missing> = Vec::new();
        for motion in self.program.moves.iter().filter(|motion| needs(motion)) {
            for (what, name) in self.setting.unknown(self.program, motion) {
                let is_same = |known: &Missing| known.what == what && known.name == name;
                if !missing.iter().any(is_same) {
                    let source = &self.sources[motion.file as usize];
                    missing.push(Missing::at(source, motion, what, name));
                }
            }
        }
        if missing.is_empty() {
            Ok(())
        } else {
            Err(PlacementError { missing })
        }
    }

    fn equip(&mut self, needs: &impl Fn(&Move) -> bool) -> Result<(), Unsupported> {
        let mut needed = vec![false; self.setting.tools.len()];
        for motion in self.program.moves.iter().filter(|motion| needs(motion)) {
            needed[motion.tool] = true;
        }
        // what the user gave for targets that no move uses
        let unused = needed.len() - 1;
        needed[unused] = self.setting.tools[unused].is_some();
        for needed in needed {
            let tool = self.setting.tools[self.arms.len()].as_ref();
            let arm = match tool.filter(|_| needed) {
                Some(tool) => Some(Equipped::of(self.profile, tool)?),
                None => None,
            };
            self.arms.push(arm);
        }
        Ok(())
    }

    /// The work frame of a move; joints stand in the world.
    pub(crate) fn frame_of(&self, motion: &Move) -> FrameId {
        if self.program.goes_to_pose(motion) {
            motion.frame
        } else {
            self.setting.world()
        }
    }

    pub(crate) fn equipped(&self, tool: ToolId) -> Option<&Equipped> {
        self.arms[tool].as_ref()
    }

    /// The arm with a tool that a move needs.
    pub(crate) fn arm_with(&self, tool: ToolId) -> &Equipped {
        self.arms[tool]
            .as_ref()
            .expect("an arm was made for each tool that a move needs")
    }

    pub(crate) fn world_from_frame(&self, frame: FrameId) -> &Pose {
        self.setting.frames[frame]
            .as_ref()
            .expect("the work frame of a move that needs it is known")
    }

    /// A pose that the program means, where the part as it stands has it.
    pub(crate) fn on_part(&self, wanted: Pose) -> Pose {
        self.work_offset.map_or(wanted, |offset| offset * wanted)
    }

    /// The reverse of [`Self::on_part`].
    pub(crate) fn off_part(&self, wanted: Pose) -> Pose {
        self.work_offset
            .map_or(wanted, |offset| offset.inverse() * wanted)
    }

    /// Where a target's numbers want the tool, in the world.
    pub(crate) fn wanted(&self, value: &Value, tool: ToolId, frame: FrameId) -> Pose {
        let controller = &self.arm_with(tool).controller;
        self.on_part(match value {
            Value::Joints(q) => controller.forward(q, &Conditions::default()),
            Value::Pose(frame_from_tool) => *self.world_from_frame(frame) * *frame_from_tool,
        })
    }

    /// The posture at a target that the robot comes to from nowhere.
    pub(crate) fn posture_alone(
        &self,
        arm: &Arm,
        target: TargetId,
        wanted: &Pose,
        configuration: &Configuration,
        findings: &mut Vec<Finding>,
    ) -> Option<(Branch, [f64; 6])> {
        let asked = Asked {
            target,
            arm,
            wanted: *wanted,
            configuration: *configuration,
            honoured: true,
            start: None,
        };
        posture::choose(self, &asked, findings).map(|posture| (posture.branch, posture.q))
    }

    /// Whether a target is given in joints.
    pub(crate) fn is_joints(&self, target: TargetId) -> bool {
        self.program.targets[target].layout.shape == Shape::Joints
    }

    /// A target's name for messages.
    pub(crate) fn name_of(&self, target: TargetId) -> String {
        let target = &self.program.targets[target];
        target
            .name
            .as_ref()
            .map_or_else(|| "this target".into(), |name| format!("`{name}`"))
    }

    /// The line of a move.
    pub(crate) fn line_of(&self, motion: &Move) -> usize {
        let source = &self.sources[motion.file as usize];
        source.line_column(motion.offset as usize).0
    }

    /// A finding at a byte of a source.
    pub(crate) fn finding(
        &self,
        id: &'static str,
        severity: Severity,
        file: u32,
        offset: u32,
        message: String,
        hint: &str,
    ) -> Finding {
        let source = &self.sources[file as usize];
        source.finding(offset as usize, id, severity, message, hint)
    }

    /// A finding at a move.
    pub(crate) fn at_move(
        &self,
        id: &'static str,
        severity: Severity,
        motion: &Move,
        message: String,
        hint: &str,
    ) -> Finding {
        self.finding(id, severity, motion.file, motion.offset, message, hint)
    }

    /// A finding at a target.
    pub(crate) fn at_target(
        &self,
        id: &'static str,
        severity: Severity,
        target: TargetId,
        message: String,
        hint: &str,
    ) -> Finding {
        let target = &self.program.targets[target];
        self.finding(id, severity, target.file, target.offset, message, hint)
    }
}

//! A program with all that is known of its tools, work frames and arm.

use super::arms::Equipped;
use super::placed::Placed;
use super::posture::{self, Asked};
use super::ride::Ride;
use super::setting::{Given, Missing, PlacementError, Setting};
use crate::finding::{Finding, Severity};
use crate::geometry::Pose;
use crate::inverse::{Arm, Branch, Unsupported};
use crate::model::Conditions;
use crate::profile::Profile;
use crate::program::{
    Before, Configuration, Displacement, FrameId, Language, Move, Program, Settings, Shape, Source,
    Stand, TargetId, ToolId, Value,
};
use std::sync::Arc;

/// Where a move goes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Goal {
    /// As its target's numbers say, displaced as the text says.
    pub value: Value,
    pub configuration: Configuration,
    /// Only the running program knows how far from there it goes.
    pub is_near: bool,
}

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
    /// The part stands elsewhere than the program has it.
    pub part_moved: bool,
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
            part_moved: false,
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
        let moves = self.program.moves.iter();
        for motion in moves.filter(|motion| needs(motion) || motion.step().is_some()) {
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

    /// The work frame of a move; joints stand in the world, which external axes move.
    pub(crate) fn frame_of(&self, motion: &Move) -> FrameId {
        let stand = self.stand_in(motion.frame);
        if self.program.goes_to_pose(motion) || stand.is_some_and(|stand| stand.of_joints) {
            motion.frame
        } else {
            self.setting.world()
        }
    }

    /// Where external axes stand in a work frame; `None` too of frames that are not the program's.
    pub(crate) fn stand_in(&self, frame: FrameId) -> Option<&Stand> {
        self.program.frames.get(frame)?.stand.as_ref()
    }

    /// Whether nobody knows where external axes carry the arm or the work piece at a move to a
    /// pose.
    pub(crate) fn is_adrift(&self, motion: &Move) -> bool {
        let frame = &self.program.frames[motion.frame];
        let carried = frame.is_carried() || !self.profile.external.track.is_empty();
        carried && frame.stand.is_none()
    }

    /// What external axes do on the way to the end of a move from that of another one; from where
    /// the program starts, where there is none.
    pub(crate) fn ride(&self, from: Option<u32>, to: &Move) -> Option<Arc<Ride>> {
        let starts = || self.program.before(to).contains(&Before::Start);
        let from = match from {
            Some(from) => self.program.stands_at(from as usize),
            None if starts() => &self.program.stands_at_start,
            None => &[],
        };
        let stand = self.stand_in(to.frame);
        stand.map(|stand| Ride::of(self.profile, from, stand, to.coordinated))
    }

    /// Moves the part in the world: every wanted pose with it.
    pub(crate) fn move_part(&mut self, offset: &Pose) {
        self.part_moved = true;
        for placed in self.setting.frames.iter_mut().flatten() {
            *placed = placed.moved(offset);
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

    /// A work frame in the world of an arm at home.
    pub(crate) fn placed(&self, frame: FrameId) -> &Placed {
        self.setting.frames[frame]
            .as_ref()
            .expect("the work frame of a move that needs it is known")
    }

    /// What the target of a move means where the move goes; `None` where it has no numbers.
    pub(crate) fn goal(&self, motion: &Move) -> Option<Goal> {
        let decoded =
            crate::program::meaning(self.language, self.program, self.settings, motion.target?)?;
        let (value, is_near) = match (decoded.value, &motion.displacement) {
            (Value::Pose(pose), Displacement::By(shift)) => {
                (Value::Pose(shift.apply(&pose)), false)
            }
            (value, displacement) => (value, *displacement != Displacement::None),
        };
        Some(Goal {
            value,
            configuration: decoded.configuration,
            is_near,
        })
    }

    /// What a target's numbers mean in its work frame; joints in that of the arm at home.
    pub(crate) fn in_frame(&self, value: &Value, tool: ToolId) -> Pose {
        match value {
            Value::Joints(q) => self
                .arm_with(tool)
                .controller
                .forward(q, &Conditions::default()),
            Value::Pose(frame_from_tool) => *frame_from_tool,
        }
    }

    /// Where a target's numbers want the tool of the controller's arm at home, on the part as it
    /// stands.
    pub(crate) fn meant(&self, value: &Value, tool: ToolId, frame: FrameId) -> Pose {
        self.placed(frame).meant * self.in_frame(value, tool)
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
            elsewhere: None,
            goes_on: false,
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

    /// With which tool and work frame a move goes to its target, and with which others do, in words;
    /// `None` where all go there with the same.
    pub(crate) fn among_uses(&self, motion: &Move) -> Option<String> {
        let program = self.program;
        let with = |of: &Move| {
            let (tool, frame) = (&program.tools[of.tool].name, &program.frames[of.frame].name);
            format!(
                "tool {tool} in work frame {frame} (line {})",
                self.line_of(of)
            )
        };
        let all = program.moves.iter().filter(|of| of.target == motion.target);
        let mut seen = vec![(motion.tool, motion.frame)];
        let mut others = Vec::new();
        for other in all {
            if !seen.contains(&(other.tool, other.frame)) {
                seen.push((other.tool, other.frame));
                others.push(with(other));
            }
        }
        let others = (!others.is_empty()).then(|| others.join(", "))?;
        Some(format!(
            "; that is with {}; other moves go to it with {others}",
            with(motion)
        ))
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

    /// A finding of what a move makes of its target: at the target where the move is in a file that is
    /// read for its declarations only, of which nothing is reported.
    pub(crate) fn at_use(
        &self,
        id: &'static str,
        severity: Severity,
        motion: &Move,
        message: String,
        hint: &str,
    ) -> Finding {
        let of_move = &self.sources[motion.file as usize];
        let target = motion.target.filter(|_| of_move.is_context);
        let Some(target) = target else {
            return self.at_move(id, severity, motion, message, hint);
        };
        let line = self.line_of(motion);
        let message = format!("line {line} of {}: {message}", of_move.name);
        self.at_target(id, severity, target, message, hint)
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

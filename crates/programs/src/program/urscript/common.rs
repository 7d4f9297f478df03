//! Values and remarks that several places of a file name.

use crate::geometry::{Pose, Quaternion, Vector};
use crate::program::script::{self, Held, Remark, RemarkId, Script, ValueId};
use foldhash::{HashMap, HashMapExt};

/// The name of every tool that `set_tcp` sets.
pub(super) const TOOL: &str = "tcp";
/// The name of the frame of poses without a feature.
const BASE: &str = "base";

/// Values and remarks that several places name.
pub(super) struct Common {
    pub base: ValueId,
    pub computed: RemarkId,
    pub expressions: RemarkId,
    not_called: RemarkId,
    pub frame_computed: RemarkId,
    pub frame_changes: RemarkId,
    pub somewhere: RemarkId,
    /// Gravity as the profile has it, where it matters.
    pub gravity_m_s2: Option<Vector>,
    own_load: ValueId,
    frames: HashMap<(String, [u64; 7]), ValueId>,
}

impl Common {
    pub(super) fn new(script: &mut Script, gravity_m_s2: Option<Vector>) -> Self {
        let base = script.frame(BASE, Some(Pose::identity()));
        let computed = script.remark(Remark::warning(
            "computed-target",
            "where this move goes is known at run time only; the move stays as it is",
            "write the target with numbers, or as pose_trans or pose_add of them",
        ));
        let expressions = script.remark(Remark::warning(
            "target-has-expressions",
            "parts of the pose that this move goes to are expressions, not numbers; the move stays \
             as it is",
            "write the target with numbers in the offline system",
        ));
        let not_called = script.remark(Remark::warning(
            "computed-target",
            "this move goes to a parameter of a function that the file does not call; the move \
             stays as it is",
            "give the call too, or write the target in the move",
        ));
        let frame_computed = script.remark(Remark::error(
            "frame-chosen-at-run-time",
            "only the running program knows its feature or tool",
            "assign the feature once, with numbers; call set_tcp with numbers before the move",
        ));
        let frame_changes = script.remark(Remark::error(
            "frame-assigned-at-run-time",
            "a part of its feature or tool is assigned",
            "assign it as a whole, with numbers",
        ));
        let somewhere = script.remark(Remark::note(
            "motion-without-target",
            "the robot moves by speed, force or hand here; this is not compensated",
            "",
        ));
        Self {
            base,
            computed,
            expressions,
            not_called,
            frame_computed,
            frame_changes,
            somewhere,
            gravity_m_s2,
            own_load: script.value(Held::Flag(false)),
            frames: HashMap::new(),
        }
    }

    /// What the parameters of a function hold that nothing in the file calls.
    pub(super) fn given_outside(&self) -> script::Expr {
        script::Expr::Unknown(self.not_called)
    }

    /// The load before a file sets one: that of the tool, if any.
    pub(super) fn own_load(&self) -> script::Expr {
        script::Expr::Value(self.own_load)
    }

    /// A tool or feature, the same for the same name and pose.
    pub(super) fn frame(
        &mut self,
        script: &mut Script,
        name: &str,
        pose: Option<Pose>,
    ) -> script::Expr {
        let key = (name.to_owned(), pose.as_ref().map_or([u64::MAX; 7], bits));
        let value = *self
            .frames
            .entry(key)
            .or_insert_with(|| script.frame(name, pose));
        script::Expr::Value(value)
    }

    /// The tool of a file that sets none.
    pub(super) fn no_tool(&mut self, script: &mut Script) -> script::Expr {
        self.frame(script, TOOL, None)
    }
}

/// The same pose as numbers that tell poses apart.
fn bits(pose: &Pose) -> [u64; 7] {
    let Quaternion([w, x, y, z]) = pose.rotation.quaternion();
    let [a, b, c] = pose.translation;
    // -0 is 0
    [a, b, c, w, x, y, z].map(|number| (number + 0.0).to_bits())
}

/// What speaks against moves: streams, arcs with which the tool rotates, joints that are computed
/// from unknown ones.
pub(super) fn refusals() -> [Remark; 3] {
    [
        Remark::error(
            "streamed-motion",
            "servoing to poses is not compensated",
            "use movel or movej, or servoj with joints",
        ),
        Remark::error(
            "move-not-supported",
            "the tool rotates with the arc (movec with another mode than 0) and does not \
                 arrive in the orientation of pose_to",
            "write mode=0, or the arc as movel or movep through points on it",
        ),
        Remark::error(
            "inverse-start-unknown",
            "only the running program knows the joints that the inverse starts from, or they \
                 are not the same each time: which posture the robot comes in is not known",
            "write qnear with numbers, or as a variable that is assigned once",
        ),
    ]
}

//! Which of the up to eight solutions of the inverse is meant.

/// One of eight ways to reach a pose.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Default)]
pub struct Branch {
    /// The wrist centre lies behind axis 1.
    pub behind_axis_1: bool,
    /// The wrist centre lies behind the lower arm.
    pub behind_lower_arm: bool,
    /// Joint 5 is on its negative side in the controller's sense.
    pub joint_5_negative: bool,
}

impl Branch {
    /// All eight.
    pub const ALL: [Self; 8] = {
        let mut all = [Self {
            behind_axis_1: false,
            behind_lower_arm: false,
            joint_5_negative: false,
        }; 8];
        let mut i = 0;
        while i < 8 {
            all[i] = Self {
                behind_axis_1: i & 4 != 0,
                behind_lower_arm: i & 2 != 0,
                joint_5_negative: i & 1 != 0,
            };
            i += 1;
        }
        all
    };

    /// A number from 0 to 7: 4 behind axis 1, 2 behind the lower arm, 1 joint 5 negative.
    #[must_use]
    pub fn number(self) -> u8 {
        4 * u8::from(self.behind_axis_1)
            + 2 * u8::from(self.behind_lower_arm)
            + u8::from(self.joint_5_negative)
    }

    /// The three signs: wrist centre in front of axis 1, in front of the lower arm, joint 5
    /// positive.
    #[must_use]
    pub fn signs(self) -> [f64; 3] {
        [
            self.behind_axis_1,
            self.behind_lower_arm,
            self.joint_5_negative,
        ]
        .map(|flag| if flag { -1.0 } else { 1.0 })
    }
}

impl std::fmt::Display for Branch {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let word = |flag, yes, no| if flag { yes } else { no };
        write!(
            f,
            "{}-{}-{}",
            word(self.behind_axis_1, "back", "front"),
            word(self.behind_lower_arm, "behind", "before"),
            word(self.joint_5_negative, "negative", "positive"),
        )
    }
}

//! What a URDF can have that no profile has.

use crate::nearest;

/// Why no profile can be made of a URDF.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum UrdfError {
    /// Not XML, or not a URDF.
    #[error("not a readable URDF: {message}")]
    Unreadable {
        /// What the parser says.
        message: String,
    },
    /// More links than any robot has.
    #[error("the file has {found} links or joints; at most {most} are read")]
    TooMany {
        /// How many.
        found: usize,
        /// The limit.
        most: usize,
    },
    /// Macros that nobody has expanded.
    #[error("this is a xacro file, with macros in it; a URDF is what `xacro` makes of it")]
    Xacro,
    /// A link with two parents, or a chain that comes back to itself.
    #[error("link `{link}` has two parents (joints `{first}` and `{second}`): a loop is no chain")]
    Loop {
        /// The link.
        link: String,
        /// The one joint.
        first: String,
        /// The other.
        second: String,
    },
    /// A name that is none, or that steers a terminal.
    #[error("the name of {what} is `{shown}`, which {why}")]
    Name {
        /// Of what.
        what: String,
        /// The name, printable.
        shown: String,
        /// What is wrong with it.
        why: &'static str,
    },
    /// No joint that moves.
    #[error("no joint of the file moves a link; a profile has 6 axes")]
    NoAxes,
    /// A mesh outside of its package.
    #[error("the mesh `{file}` of link `{link}` leads out of its package")]
    Outside {
        /// As written.
        file: String,
        /// Its link.
        link: String,
    },
    /// A link that is not there.
    #[error("there is no link `{link}`")]
    NoLink {
        /// Its name.
        link: String,
        /// Those there are.
        known: Vec<String>,
    },
    /// Several links that nothing hangs on.
    #[error("the chain has several ends: {ends}")]
    SeveralTips {
        /// Their names.
        ends: String,
    },
    /// Several links that hang on nothing, or none.
    #[error("{count} links have no parent: {roots}")]
    Roots {
        /// How many.
        count: usize,
        /// Their names.
        roots: String,
    },
    /// No way from one to the other.
    #[error("link `{tip}` does not hang on link `{base}`")]
    NoWay {
        /// From.
        base: String,
        /// To.
        tip: String,
    },
    /// A base that moves against the arm.
    #[error(
        "joint `{joint}` moves link `{base}` against the arm that ends in `{tip}`: the world \
         stands still"
    )]
    MovingBase {
        /// The base.
        base: String,
        /// The tip.
        tip: String,
        /// The joint between the base and where the two meet.
        joint: String,
    },
    /// A joint that does not turn.
    #[error("joint `{joint}` is {kind}; only joints that rotate are supported")]
    Kind {
        /// The joint.
        joint: String,
        /// Its type.
        kind: String,
    },
    /// A joint that another one drives.
    #[error("joint `{joint}` mimics `{by}`: it is no axis of its own")]
    Mimic {
        /// The joint.
        joint: String,
        /// Its leader.
        by: String,
    },
    /// More or fewer than six.
    #[error("{found} axes between `{base}` and `{tip}` ({names}); a profile has 6")]
    NotSix {
        /// How many.
        found: usize,
        /// From.
        base: String,
        /// To.
        tip: String,
        /// Their joints.
        names: String,
    },
    /// A number that cannot be meant.
    #[error("{what} of `{name}` is {found}")]
    Number {
        /// Which number.
        what: &'static str,
        /// Of which joint or link.
        name: String,
        /// What the file says.
        found: String,
    },
    /// Two axes on one line.
    #[error(
        "the axes of `{first}` and `{second}` are one line: such an arm has no rows of a chain"
    )]
    SameAxis {
        /// The one joint.
        first: String,
        /// The other.
        second: String,
    },
    /// Two axes that are parallel but for so little that their common normal is out of reach.
    #[error(
        "the axes of `{first}` and `{second}` are {apart_rad:.1e} rad from parallel: their common \
         normal is {far_m:.0} m away (limit {limit_m} m)"
    )]
    FarNormal {
        /// The one joint.
        first: String,
        /// The other.
        second: String,
        /// Angle between them, radians.
        apart_rad: f64,
        /// How far, metres.
        far_m: f64,
        /// The largest that a profile has, metres.
        limit_m: f64,
    },
    /// A package that nobody said where it is.
    #[error("cannot find the mesh `{file}` of link `{link}`")]
    Mesh {
        /// As written.
        file: String,
        /// Its link.
        link: String,
    },
    /// A mesh scaled differently along its axes, or turned inside out.
    #[error(
        "the mesh of link `{link}` has the scale {scale:?}; the same positive scale on each axis \
         is needed"
    )]
    Scale {
        /// The link.
        link: String,
        /// As written.
        scale: [f64; 3],
    },
    /// The chain does not do what the URDF does.
    #[error(
        "the chain differs from the URDF by {gap_m:e} m and {gap_rad:e} rad; at most 1e-9 is \
         allowed"
    )]
    Differs {
        /// Largest distance, metres.
        gap_m: f64,
        /// Largest angle, radians.
        gap_rad: f64,
    },
}

impl UrdfError {
    /// The way out; empty where there is none.
    #[must_use]
    pub fn hint(&self) -> String {
        match self {
            Self::Xacro => {
                "install xacro (`pip install xacro`, or ROS), then it is expanded here; \
                or run `xacro FILE > robot.urdf` elsewhere and give that"
                    .into()
            }
            Self::NoLink { link, known } => {
                nearest::hint(link, "links", known.iter().map(String::as_str))
            }
            Self::MovingBase { .. } => "--base names a link that is fixed to the foot of the \
                arm"
            .into(),
            Self::SeveralTips { .. } => "--tip names the link that the tool is mounted on".into(),
            Self::Roots { .. } => "--base names the link that stands still".into(),
            Self::NotSix { found, .. } if *found > 6 => {
                "an arm of more than six axes has endlessly many postures at a pose, and no \
                 program tells which: --base and --tip choose six axes where the others stand \
                 still"
                    .into()
            }
            Self::NotSix { .. } => "--base and --tip choose a part of the robot".into(),
            Self::Mesh { .. } => {
                "--package-path FOLDER (the folder that holds the package, or NAME=FOLDER), or \
                 --no-shapes"
                    .into()
            }
            Self::FarNormal { .. } => {
                "write the file with more decimals, or leave --exact-angles out: axes that are \
                 parallel but for the rounding of its numbers are then taken as parallel"
                    .into()
            }
            Self::Name { .. } => "give it another name in the file".into(),
            Self::NoAxes => "a URDF of the whole arm is needed, with its revolute joints".into(),
            Self::Number { .. } => {
                "correct it in the file: lengths are in metres, angles in radians, masses in kg"
                    .into()
            }
            Self::Outside { .. } => {
                "correct the path in the file, or leave the shapes out with --no-shapes".into()
            }
            Self::Scale { .. } => "--no-shapes leaves the shapes out".into(),
            _ => String::new(),
        }
    }
}

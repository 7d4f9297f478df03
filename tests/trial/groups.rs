//! The groups of the trial.

/// Where a diagnosis starts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Start {
    /// The profile has the true geometry and compliance.
    Calibrated,
    /// The profile is a drawing.
    Nominal,
    /// The profile was calibrated with 50 to 150 noisy rows of the same robot.
    Measured,
}

/// What a group of cases has.
#[derive(Clone, Debug)]
pub struct Group {
    pub name: &'static str,
    pub start: Start,
    /// So many of the robots, in turn.
    pub robots: usize,
    /// Effects hidden in each case.
    pub hidden: usize,
    /// Root mean square of what they do, in that of the noise: smallest and largest.
    pub size: (f64, f64),
    /// Heavy tails, gross errors in 3 % of the rows, no column `sigma_mm`.
    pub rough: bool,
    /// Reflectors, distances, poses, missing columns and unknown noise in turn; else positions
    /// with all columns.
    pub devices: bool,
    /// Something the registry does not have.
    pub unregistered: bool,
    /// Part of the cases that must be right.
    pub goal: f64,
}

/// Positions of a calibrated robot, one of two, with one effect hidden.
const PLAIN: Group = Group {
    name: "calibrated",
    start: Start::Calibrated,
    robots: 2,
    hidden: 1,
    size: (2.0, 15.0),
    rough: false,
    devices: false,
    unregistered: false,
    goal: 0.98,
};

/// One of eight robots, calibrated from measurements.
const HARD: Group = Group {
    name: "measured",
    start: Start::Measured,
    robots: 8,
    goal: 0.97,
    ..PLAIN
};

/// Every group of the trial.
pub const GROUPS: [Group; 14] = [
    PLAIN,
    Group {
        name: "nominal",
        start: Start::Nominal,
        goal: 0.95,
        ..PLAIN
    },
    Group {
        name: "small",
        size: (0.5, 1.0),
        goal: 0.90,
        ..PLAIN
    },
    Group {
        name: "rough",
        rough: true,
        goal: 0.95,
        ..PLAIN
    },
    Group {
        name: "pairs",
        hidden: 2,
        goal: 0.90,
        ..PLAIN
    },
    Group {
        name: "clean",
        hidden: 0,
        size: (0.0, 0.0),
        goal: 0.99,
        ..PLAIN
    },
    Group {
        name: "unregistered",
        hidden: 0,
        unregistered: true,
        goal: 0.90,
        ..PLAIN
    },
    HARD,
    Group {
        name: "measured-small",
        size: (0.3, 1.0),
        goal: 0.90,
        ..HARD
    },
    Group {
        name: "measured-pairs",
        hidden: 2,
        goal: 0.95,
        ..HARD
    },
    Group {
        name: "measured-triples",
        hidden: 3,
        goal: 0.85,
        ..HARD
    },
    Group {
        name: "measured-clean",
        hidden: 0,
        size: (0.0, 0.0),
        goal: 1.0,
        ..HARD
    },
    Group {
        name: "devices",
        devices: true,
        ..HARD
    },
    Group {
        name: "outside",
        hidden: 0,
        unregistered: true,
        goal: 0.98,
        ..HARD
    },
];

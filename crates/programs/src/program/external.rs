//! External axes in programs.

/// Where an external axis stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct External {
    /// Index in [`ExternalNames::listed`].
    pub axis: u8,
    /// The value in the file's unit; not a number where the text does not tell.
    pub value: f64,
}

/// External axes by their names in programs.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct ExternalNames {
    /// Those of which it is known what they carry.
    pub listed: Vec<String>,
    /// Which of these are linear: programs give them in millimetres, others in degrees.
    pub linear: Vec<bool>,
    /// Encoder pulses of one millimetre or degree of each of these, for programs that count in
    /// pulses.
    pub pulses: Vec<Option<f64>>,
    /// Those that carry nothing a pose depends on, and units of such.
    pub ignored: Vec<String>,
    /// Units by their names, with their axes bit by bit by the index in [`ExternalNames::listed`].
    pub units: Vec<(String, u16)>,
    /// A positioner carries every work frame, also those of which programs do not say so.
    pub carries_every_frame: bool,
}

/// What a program does to external axes besides its targets, while a move runs.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct ExternalState {
    /// What is added, in the units and the order of the language.
    pub offset: [f64; 6],
    /// Axes, bit by bit by their index in [`ExternalNames::listed`], that stand elsewhere than
    /// targets say.
    pub off: u16,
    /// Where the program says so: file and byte.
    pub since: Option<(u32, u32)>,
}

/// What is known of an external axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ExternalUse {
    /// What it carries; the index in [`ExternalNames::listed`].
    Listed(u8),
    /// That it carries nothing.
    Ignored,
    /// Nothing.
    Unknown,
}

impl ExternalNames {
    /// What is known of the axis of a name.
    #[must_use]
    pub fn meaning(&self, name: &str) -> ExternalUse {
        let is = |known: &String| known.eq_ignore_ascii_case(name);
        let listed = self.listed.iter().position(is).map(u8::try_from);
        match listed {
            Some(Ok(at)) => ExternalUse::Listed(at),
            _ if self.ignored.iter().any(is) => ExternalUse::Ignored,
            _ => ExternalUse::Unknown,
        }
    }

    /// Whether another axis of the group of `G2J1` has a meaning.
    #[must_use]
    pub fn knows_group_of(&self, name: &str) -> bool {
        let group = |name: &str| {
            name.split_once(['J', 'j'])
                .map(|(group, _)| group.to_owned())
        };
        let own = group(name).filter(|group| !group.is_empty());
        let mut others = self.listed.iter().filter_map(|listed| group(listed));
        own.is_some_and(|own| others.any(|other| other.eq_ignore_ascii_case(&own)))
    }

    /// The axes of a unit, bit by bit: all where the profile does not know the name.
    #[must_use]
    pub fn axes_of_unit(&self, name: &str) -> u16 {
        let is = |known: &str| known.eq_ignore_ascii_case(name);
        let known = self.units.iter().find(|(unit, _)| is(unit));
        match known {
            Some((_, axes)) => *axes,
            None if self.ignored.iter().any(|unit| is(unit)) => 0,
            None => self.every_axis(),
        }
    }

    /// All listed axes, bit by bit.
    #[must_use]
    pub fn every_axis(&self) -> u16 {
        (0..self.listed.len()).fold(0, |axes, at| axes | 1 << at)
    }
}

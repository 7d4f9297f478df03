//! Conditions of parts that AND and OR join.

use super::Test;

/// A condition of parts that are one `T` each.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Logic<T> {
    /// Not joined.
    One(T),
    /// By AND.
    All(Vec<Self>),
    /// By OR.
    Any(Vec<Self>),
}

impl<T> Logic<T> {
    /// The same with other parts.
    pub fn map<U>(&self, of: &mut dyn FnMut(&T) -> U) -> Logic<U> {
        let mut each = |all: &[Self]| all.iter().map(|part| part.map(of)).collect();
        match self {
            Self::One(part) => Logic::One(of(part)),
            Self::All(all) => Logic::All(each(all)),
            Self::Any(all) => Logic::Any(each(all)),
        }
    }

    /// Every part, in the order of the text.
    pub fn parts(&self) -> Vec<&T> {
        match self {
            Self::One(part) => vec![part],
            Self::All(all) | Self::Any(all) => all.iter().flat_map(Self::parts).collect(),
        }
    }

    /// The parts that hold where all of it does.
    pub fn conjuncts(&self) -> Vec<&T> {
        match self {
            Self::One(part) => vec![part],
            Self::All(all) => all.iter().flat_map(Self::conjuncts).collect(),
            Self::Any(_) => Vec::new(),
        }
    }
}

/// On what a branch depends: parts that are `None` depend on what only the running program knows.
pub type Tests = Logic<Option<Test>>;

impl From<Option<Test>> for Tests {
    fn from(test: Option<Test>) -> Self {
        Self::One(test)
    }
}

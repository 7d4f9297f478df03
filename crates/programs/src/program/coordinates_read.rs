//! Coordinates of targets that a number is worked out from: rewritten, they are those of the fake
//! targets, and the number is another.

use super::TargetId;

/// How strongly a coordinate of a target stands in a number.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Reading {
    target: TargetId,
    /// Which of x, y, z, and the three angles.
    part: u8,
    /// What the number grows by with it, in its unit for each mm or degree.
    by: f64,
}

/// All coordinates of targets that stand in a number.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Readings {
    /// What they do together is their sum.
    together: Vec<Reading>,
    /// Sums that are made in part, each for itself.
    varied: Vec<Vec<Reading>>,
}

impl Readings {
    pub(super) fn of(target: TargetId, part: u8) -> Self {
        Self {
            together: vec![Reading {
                target,
                part,
                by: 1.0,
            }],
            varied: Vec::new(),
        }
    }

    pub(super) fn is_empty(&self) -> bool {
        self.together.is_empty() && self.varied.is_empty()
    }

    /// All of them, with how the numbers grow.
    fn all(&mut self) -> impl Iterator<Item = &mut Reading> {
        self.varied.iter_mut().flatten().chain(&mut self.together)
    }

    pub(super) fn times(mut self, factor: f64) -> Self {
        for reading in self.all() {
            reading.by *= factor;
        }
        self
    }

    /// Times something up to a number either way.
    pub(super) fn times_up_to(self, most: f64) -> Self {
        let mut all = self.times(most);
        let together = std::mem::take(&mut all.together);
        all.varied
            .extend((!together.is_empty()).then_some(together));
        all
    }

    pub(super) fn plus(mut self, other: Self) -> Self {
        for reading in other.together {
            let is_same =
                |of: &&mut Reading| (of.target, of.part) == (reading.target, reading.part);
            match self.together.iter_mut().find(is_same) {
                Some(known) => known.by += reading.by,
                None => self.together.push(reading),
            }
        }
        self.together.retain(|reading| reading.by != 0.0);
        self.varied.extend(other.varied);
        self
    }

    /// Gives the targets their new numbers; those without one have no moves, and stay as they are.
    pub(super) fn renumber(&mut self, new: impl Fn(TargetId) -> Option<TargetId>) {
        for all in self.varied.iter_mut().chain([&mut self.together]) {
            all.retain_mut(|reading| {
                let number = new(reading.target);
                reading.target = number.unwrap_or_default();
                number.is_some()
            });
        }
    }

    /// The targets.
    pub(crate) fn targets(&self) -> impl Iterator<Item = TargetId> {
        let all = self.varied.iter().flatten().chain(&self.together);
        all.map(|reading| reading.target)
    }

    /// What the number changes by at most where coordinates change by so much, mm and degrees.
    pub(crate) fn most(&self, by: &dyn Fn(TargetId, u8) -> f64) -> f64 {
        let sum = |all: &[Reading]| {
            let each = all.iter().map(|of| of.by * by(of.target, of.part));
            each.sum::<f64>().abs()
        };
        sum(&self.together) + self.varied.iter().map(|all| sum(all)).sum::<f64>()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_added_up_cancels_and_what_varies_does_not() {
        let by = |target, _| [3.0, 2.0][target];
        let of = |target| Readings::of(target, 0);
        let between = of(1).plus(of(0).times(-1.0)).times(0.5);
        assert_eq!(between.most(&by), 0.5);
        assert_eq!(between.clone().times_up_to(3.0).most(&by), 1.5);
        let both = of(0)
            .times_up_to(1.0)
            .plus(of(1).times(-1.0).times_up_to(1.0));
        assert_eq!(both.most(&by), 5.0);
        assert!(of(0).plus(of(0).times(-1.0)).is_empty());
        assert_eq!(both.targets().collect::<Vec<_>>(), [0, 1]);
    }
}

//! What amounts add to a target: a displacement of the text as far as it tells them.

use super::notation::grown_by;
use super::quantity::Quantity;
use super::{Displacement, Shift, Stride};
use crate::geometry::units::{DEG, MM};
use crate::geometry::{Pose, Rotation, Vector, norm};

/// How far a sensor or a register usually displaces a point, metres.
pub(crate) const SOMEHOW_M: f64 = 0.005;

/// A displacement in the making.
#[derive(Clone, Debug)]
pub(super) struct Displacing {
    exact: Shift,
    strides: Vec<Stride>,
    /// Only the running program knows some of it, and adds it again and again.
    is_unknown: bool,
    is_endless: bool,
}

impl Displacing {
    pub(super) fn new() -> Self {
        Self {
            exact: Shift::none(),
            strides: Vec::new(),
            is_unknown: false,
            is_endless: false,
        }
    }

    /// Along the axes of the work frame, metres.
    pub(super) fn along_frame(&mut self, by: &[Quantity; 3]) {
        self.exact = self
            .exact
            .then(&Shift::along([by[0].first, by[1].first, by[2].first]));
        for (axis, by) in by.iter().enumerate() {
            self.vary(by, &|by| Shift::along(along(axis, by)));
        }
    }

    /// Along the axes of the tool, metres, and then about its x, the new y, the new z, radians.
    pub(super) fn in_tool(&mut self, by: &[Quantity; 6]) {
        let first: [f64; 6] = std::array::from_fn(|at| by[at].first);
        let step = Pose::from_xyz_rxryrz(first);
        self.in_tool_exactly(step);
        let turned = step.rotation.transpose();
        for (axis, by) in by[..3].iter().enumerate() {
            self.vary(by, &|by| {
                let [x, y, z] = turned * along(axis, by);
                tool(Pose::from_translation(x, y, z))
            });
        }
        for (axis, by) in by[3..].iter().enumerate() {
            if by.exact().is_some() {
                continue;
            }
            self.is_endless |= !by.readings.is_empty();
            // about an axis that the others turn nothing is known
            let is_alone = (3..6).all(|other| other == axis + 3 || first[other] == 0.0);
            if is_alone && by.unknown.is_none() {
                self.vary(by, &|by| {
                    tool(Pose::from_rotation(Rotation::from_vector(along(axis, by))))
                });
            } else {
                self.is_unknown = true;
                self.is_endless |= by.is_endless();
                let angle = by.of_text();
                if angle > 0.0 || by.unknown.is_none() {
                    self.strides
                        .push(Stride::Turned((angle > 0.0).then_some(angle)));
                }
            }
        }
    }

    /// By angles, degrees, about axes of which nothing is known but that they go through the tool's
    /// origin.
    pub(super) fn turned_by_any(&mut self, angles: &[Quantity]) {
        let mut most = 0.0;
        for angle in angles {
            if let Some((least, greatest)) = angle.ends() {
                most += least.abs().max(greatest.abs());
            } else {
                self.is_unknown = true;
                self.is_endless |= angle.is_of_program();
            }
        }
        if most > 0.0 {
            self.turned_up_to(most * DEG);
        }
    }

    /// By no more than an angle, radians, about an axis that the text does not tell.
    pub(super) fn turned_up_to(&mut self, angle: f64) {
        self.strides.push(Stride::Turned(Some(angle)));
    }

    /// A motion in the tool.
    pub(super) fn in_tool_exactly(&mut self, step: Pose) {
        let back = step.inverse();
        // what varies so far stands before this
        for stride in &mut self.strides {
            if let Stride::By { shift, .. } | Stride::Read { shift, .. } = stride {
                shift.in_tool = back * shift.in_tool * step;
            }
        }
        self.exact.in_tool = self.exact.in_tool * step;
    }

    fn vary(&mut self, by: &Quantity, shift: &dyn Fn(f64) -> Shift) {
        self.is_unknown |= by.unknown.is_some();
        self.is_endless |= by.is_endless();
        let steps = by.steps.iter().map(|step| (step.by, step.most));
        let of_text = by.of_text();
        let of_text = [of_text, -of_text].map(|by| (by, Some(1)));
        let of_text = of_text.into_iter().filter(|(by, _)| *by != 0.0);
        for (by, most) in steps.chain(of_text) {
            let shift = shift(by);
            self.strides.push(Stride::By { shift, most });
        }
        if !by.readings.is_empty() {
            self.strides.push(Stride::Read {
                shift: shift(1.0),
                of: by.readings.clone(),
            });
        }
    }

    pub(super) fn displacement(self) -> Displacement {
        let is_none = self.exact == Shift::none();
        if self.is_endless {
            return Displacement::Unbounded;
        }
        if self.strides.is_empty() && !self.is_unknown {
            return if is_none {
                Displacement::None
            } else {
                Displacement::By(Box::new(self.exact))
            };
        }
        let once = (!is_none).then_some(Stride::By {
            shift: self.exact,
            most: Some(1),
        });
        let strides: Box<[Stride]> = once.into_iter().chain(self.strides).collect();
        if !self.is_unknown {
            return Displacement::Within(strides);
        }
        if is_small(&strides) {
            return Displacement::Unknown;
        }
        Displacement::AtLeast(strides)
    }
}

/// What a position is displaced by whose coordinate `at`, in mm, grows by a number; `None` where
/// the text does not say that, or not of that coordinate.
pub(super) fn grown_by_any(at: usize, by: Quantity) -> Option<Displacement> {
    if let Some(by) = by.exact() {
        return grown_by(at, by);
    }
    if at > 2 {
        return None;
    }
    let mut along = [0.0; 3].map(Quantity::exactly);
    along[at] = by.in_unit(MM);
    let mut displacing = Displacing::new();
    displacing.along_frame(&along);
    Some(displacing.displacement())
}

/// Whether strides lead no farther than what is taken for any displacement that nobody knows.
fn is_small(strides: &[Stride]) -> bool {
    let far = strides.iter().map(|stride| match stride {
        Stride::By { shift, most } => {
            let turns = [&shift.in_frame, &shift.in_tool].map(|pose| pose.rotation.angle());
            let along = norm(shift.in_frame.translation) + norm(shift.in_tool.translation);
            match most {
                Some(most) if turns == [0.0; 2] => along * f64::from(*most),
                _ => f64::INFINITY,
            }
        }
        Stride::Turned(_) | Stride::Read { .. } => f64::INFINITY,
    });
    far.sum::<f64>() <= SOMEHOW_M
}

fn along(axis: usize, by: f64) -> Vector {
    let mut along = [0.0; 3];
    along[axis] = by;
    along
}

fn tool(in_tool: Pose) -> Shift {
    Shift {
        in_tool,
        ..Shift::none()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_2;

    fn exactly(values: [f64; 6]) -> [Quantity; 6] {
        values.map(Quantity::exactly)
    }

    #[test]
    fn what_varies_in_the_tool_is_turned_with_what_follows() {
        // 0, 1 or 2 times 0.1 along x, then a quarter turn about z, then 0.3 along x
        let mut by = Displacing::new();
        let mut first = exactly([0.0, 0.0, 0.0, 0.0, 0.0, FRAC_PI_2]);
        first[0] = Quantity::counted(0.5, 0.1, Some(2));
        by.in_tool(&first);
        by.in_tool(&exactly([0.3, 0.0, 0.0, 0.0, 0.0, 0.0]));
        let Displacement::Within(strides) = by.displacement() else {
            panic!("the text tells it");
        };
        let at = |count: f64| {
            let quarter = Pose::from_rotation(Rotation::about_z(FRAC_PI_2));
            Pose::from_translation(0.5 + 0.1 * count, 0.0, 0.0)
                * quarter
                * Pose::from_translation(0.3, 0.0, 0.0)
        };
        let [Stride::By { shift: exact, .. }, Stride::By { shift, most }] = *strides else {
            panic!("{strides:?}");
        };
        assert_eq!(most, Some(2));
        let twice = exact.then(&shift).then(&shift);
        assert!(twice.in_tool.separation(&at(2.0)).distance_m < 1e-12);
        assert!(twice.in_tool.separation(&at(2.0)).angle_rad < 1e-7);
    }

    #[test]
    fn what_nobody_knows_is_as_large_as_the_text_or_as_anything() {
        let along = |by: Quantity| {
            let mut displacing = Displacing::new();
            displacing.along_frame(&[by, Quantity::exactly(0.0), Quantity::exactly(0.0)]);
            displacing.displacement()
        };
        assert_eq!(along(Quantity::unknown()), Displacement::Unknown);
        assert_eq!(
            along(Quantity::unknown().times(0.002)),
            Displacement::Unknown
        );
        let by = |by: f64| Stride::By {
            shift: Shift::along([by, 0.0, 0.0]),
            most: Some(1),
        };
        assert_eq!(
            along(Quantity::unknown().times(0.04)),
            Displacement::AtLeast(Box::new([by(0.04), by(-0.04)]))
        );
        assert_eq!(along(Quantity::endless()), Displacement::Unbounded);
        assert_eq!(along(Quantity::exactly(0.0)), Displacement::None);
    }
}

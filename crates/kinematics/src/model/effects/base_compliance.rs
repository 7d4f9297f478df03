//! Tilting of the pedestal.

use super::definition::{Definition, Need, Parameter, Unit};
use super::search::{Search, Shown};
use super::words::{deg, largest};
use super::{Deflection, Effect, Equation, MOST_PARAMETERS, Seen, Site, State};
use crate::geometry::{Rotation, Scalar, add, cross, sub};

/// The base rotates about x and y of its frame in proportion to the moment of the arm about its origin.
pub(super) struct BaseCompliance;

impl Equation for BaseCompliance {
    const DEFINITION: Definition = Definition {
        id: "base_compliance",
        summary: "the pedestal or its bolts give way: the base tilts under the arm's moment",
        equation: "rotation of the base about its x axis = x_rad_per_n_m · M_x, about y = \
            y_rad_per_n_m · M_y, M the arm's moment about the base's origin",
        source: "A. Nubiola, thesis, eqs. I.5–I.10, with the base as one more link",
        site: &[],
        parameters: &[
            Parameter { key: "x_rad_per_n_m", unit: Unit::RadPerNm, prior_sigma: 2e-5 },
            Parameter { key: "y_rad_per_n_m", unit: Unit::RadPerNm, prior_sigma: 2e-5 },
        ],
        needs: &[Need::Masses],
        deflects: true,
        bends: true,
        of_data: false,
        shown_against: Shown::Torque(Some(1)),
        search: Search {
            ..Search::BENDING
        },
    };
    const READS_ANGLES: bool = false;

    #[inline(always)]
    fn deflect<S: Scalar>(_: &Site, p: &[S; MOST_PARAMETERS], state: &State<S>, deflection: &mut Deflection<S>) {
        let Some(frames) = state.frames else { return };
        let base = &frames.base;
        // the moment about the base: that about the first link's origin and the force's lever
        let lever = sub(frames.links[0].translation, base.translation);
        let moment = add(frames.moments[0], cross(lever, frames.force));
        let own = base.rotation.transpose() * moment;
        let turn = base.rotation * [p[0] * own[0], p[1] * own[1], S::zero()];
        // about the base's origin, which may be metres from the world's: to all orders
        let by = Rotation::about_x(turn[0]) * Rotation::about_y(turn[1]) * Rotation::about_z(turn[2]);
        let shift = sub(base.translation, by * base.translation);
        for k in 0..3 {
            deflection.world[k] += shift[k];
            deflection.world[3 + k] += turn[k];
        }
    }

    fn sentence(effect: &Effect, _: &Seen) -> String {
        format!("The pedestal tilts: {}° at most under 100 N m", deg(100.0 * largest(&effect.parameters[..2])))
    }
}

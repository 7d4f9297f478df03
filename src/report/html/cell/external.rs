//! Rails and positioners of a view in space, as the controller has them.

use super::{Solid, length, matrix};
use crate::check::Meshes;
use crate::check::cell::Cell as CellFile;
use crate::geometry::units::DEG;
use crate::model::profile::Profile;
use crate::report::html::numbers::{Number, fixed};
use serde::Serialize;

/// Rails and positioners.
#[derive(Clone, Debug, Serialize)]
pub(super) struct External {
    /// What carries the base, from the floor up.
    track: Vec<Rail>,
    /// What carries work pieces.
    positioners: Vec<Station>,
}

/// A linear axis, mm.
#[derive(Clone, Debug, Serialize)]
struct Rail {
    direction: [Number; 3],
    zero: Number,
    min: Number,
    max: Number,
}

/// A positioner.
#[derive(Clone, Debug, Serialize)]
struct Station {
    name: String,
    /// Index of its first axis in the list of all.
    first: usize,
    axes: Vec<Rotary>,
    /// On the last axis.
    plate: Vec<Number>,
    /// What rides on the plate.
    shapes: Vec<Solid>,
}

/// A rotary axis, in the frame of the one before.
#[derive(Clone, Debug, Serialize)]
struct Rotary {
    at: Vec<Number>,
    sign: Number,
    /// Degrees.
    zero: Number,
}

impl External {
    /// Those of a profile, with what a cell attaches to them; `None` where there are none.
    pub(super) fn of(profile: &Profile, cell: Option<&CellFile>, meshes: &Meshes) -> Option<Self> {
        let external = &profile.external;
        let track = external.track.iter().map(|axis| Rail {
            direction: axis.direction.map(|x| fixed(x, 9)),
            zero: length(axis.zero_m),
            min: length(axis.min_m),
            max: length(axis.max_m),
        });
        let stations = external.positioners.iter().enumerate();
        let stations = stations.map(|(at, positioner)| {
            let axes = positioner.axes.iter().map(|axis| Rotary {
                at: matrix(&axis.at),
                sign: Number(axis.sign),
                zero: fixed(axis.zero_rad / DEG, 6),
            });
            let attached = cell.iter().flat_map(|cell| &cell.attached);
            let riding = attached.filter(|body| body.positioner(external) == Ok(Some(at)));
            let shapes = riding.filter_map(|body| Solid::of(&body.name, None, &body.shape, meshes));
            Station {
                name: positioner.name.clone(),
                first: external.first_of(at),
                axes: axes.collect(),
                plate: matrix(&positioner.plate),
                shapes: shapes.collect(),
            }
        });
        let all = Self {
            track: track.collect(),
            positioners: stations.collect(),
        };
        (!(all.track.is_empty() && all.positioners.is_empty())).then_some(all)
    }
}

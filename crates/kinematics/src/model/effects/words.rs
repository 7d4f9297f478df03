//! Sizes and places as sentences have them.

use super::Effect;
use crate::geometry::Scalar;
use crate::geometry::units::{DEG, mm_from_m};

/// Shorter constants count as this, rows.
const SHORTEST: f64 = 0.1;

/// Behind what says that a joint or axis runs ahead of its command.
pub(super) const LAGS: &str = " (gears lag: is the sign of the directions right?)";

/// The part of its last size that what grows exponentially with the row number has reached.
#[inline(always)]
pub(super) fn gone<S: Scalar>(row: f64, constant_rows: S) -> S {
    let constant = constant_rows.max(S::constant(SHORTEST));
    S::one() - (S::constant(-row) / constant).exp()
}

/// How fast it does so.
pub(super) fn pace(constant_rows: f64, all: f64) -> String {
    if constant_rows < all {
        format!("most of it in {constant_rows:.0} rows")
    } else {
        "about evenly".to_owned()
    }
}

/// Three decimals, or two digits where these say nothing.
pub(super) fn digits(value: f64) -> String {
    let size = value.abs();
    if size == 0.0 || (0.01..1000.0).contains(&size) {
        format!("{value:.3}")
    } else {
        format!("{value:.1e}")
    }
}

/// Radians, in degrees.
pub(super) fn deg(value_rad: f64) -> String {
    digits(value_rad / DEG)
}

/// Metres, in millimetres.
pub(super) fn mm(value_m: f64) -> String {
    digits(mm_from_m(value_m))
}

/// Which way something goes beyond what was commanded, or not as far.
pub(super) fn too(value: f64) -> &'static str {
    if value < 0.0 { "little" } else { "far" }
}

/// The length of a vector.
pub(super) fn length(components: &[f64]) -> f64 {
    components.iter().map(|v| v * v).sum::<f64>().sqrt()
}

/// The largest size of the components: of a bending about two axes that which a moment makes at most.
pub(super) fn largest(components: &[f64]) -> f64 {
    components.iter().fold(0.0, |most, v| v.abs().max(most))
}

/// The joint an effect belongs to: `J2`.
pub(super) fn joint(effect: &Effect) -> String {
    format!("J{}", effect.site.index + 1)
}

/// The external axis an effect belongs to.
pub(super) fn axis(effect: &Effect) -> String {
    format!("external axis {}", effect.site.index + 1)
}

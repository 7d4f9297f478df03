//! The units of files and printed text, besides the SI units inside.

/// One millimetre in metres.
pub const MM: f64 = 1e-3;
/// One degree in radians.
pub const DEG: f64 = std::f64::consts::PI / 180.0;

/// Millimetres to metres, so that the printed decimal is met exactly on the way back where that is
/// possible.
#[inline]
#[must_use]
pub fn m_from_mm(mm: f64) -> f64 {
    mm / 1000.0
}

/// Metres to millimetres.
#[inline]
#[must_use]
pub fn mm_from_m(m: f64) -> f64 {
    m * 1000.0
}

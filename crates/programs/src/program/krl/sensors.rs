//! Sensors that correct moves while they run (KUKA.RobotSensorInterface).
//!
//! # Source
//! KUKA.RobotSensorInterface 2.3 (`ST_ON1`, `ST_OFF`) and 3.1 (`RSI_ON`, `RSI_OFF`, `RSI_MOVECORR`), "Programming".

use super::reader::Reader;
use super::remarks::SENSED;
use crate::program::script::{Expr, Held, Place};

/// Whether a routine switches corrections on or off.
fn switches(word: &[u8]) -> Option<bool> {
    match word {
        b"RSI_ON" | b"ST_ON" | b"ST_ON1" => Some(true),
        b"RSI_OFF" | b"ST_OFF" => Some(false),
        _ => None,
    }
}

/// Whether a text may name a routine that switches a sensor on.
pub(super) fn are_in(bytes: &[u8]) -> bool {
    let is_before = |at: usize, name: &[u8]| {
        let before = at.checked_sub(name.len()).map(|from| &bytes[from..at]);
        before.is_some_and(|before| before.eq_ignore_ascii_case(name))
    };
    memchr::memchr_iter(b'_', bytes).any(|at| {
        let behind = bytes.get(at + 1..at + 3);
        behind.is_some_and(|behind| behind.eq_ignore_ascii_case(b"ON"))
            && (is_before(at, b"RSI") || is_before(at, b"ST"))
    })
}

/// Whether the sensor alone moves the robot there, and leaves it where only the running program knows.
pub(super) fn leads(name: &[u8]) -> bool {
    name.eq_ignore_ascii_case(b"RSI_MOVECORR")
}

impl Reader {
    /// From `RSI_ON` to `RSI_OFF` moves go where the sensor has them go.
    pub(super) fn switch_sensor(&mut self, place: Place, word: &[u8]) {
        let Some(is_on) = switches(word) else { return };
        let value = if is_on {
            let remark = self.builder.script.remark(SENSED);
            Expr::Value(self.builder.script.value(Held::Remark(remark)))
        } else {
            Expr::Absent
        };
        self.put(place, self.states.sensor, value);
    }
}

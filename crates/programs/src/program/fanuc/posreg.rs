//! The numbers of position registers in a file of the controller: `POSREG.VA`.

use super::frames::{BadNumber, LARGEST, coordinates, index, lines, value};
use super::numbers::ELEMENTS;
use std::collections::BTreeMap;

/// Numbers of the arm.
const OF_ARM: usize = 6;

/// A register: X Y Z W P R and other axes, mm and degrees.
pub(super) type Shown = [f64; ELEMENTS as usize];

/// The Cartesian registers of group 1, by number: `[*POSREG*]$POSREG … ARRAY[1,100] OF Position
/// Reg`, then for each `[1,2] =   'comment'`, `X: … Y: … Z: …`, `W: … P: … R: …`, `EXT1: … mm`. What
/// is in joints, or not taught, is not there.
pub(super) fn read(bytes: &[u8]) -> Result<BTreeMap<u32, Shown>, BadNumber> {
    let mut registers = BTreeMap::new();
    let mut is_inside = false;
    let mut of = None;
    let mut values = [None; OF_ARM];
    for (start, line) in lines(bytes) {
        let text = line.trim_ascii_start();
        if text.starts_with(b"[*") {
            is_inside = memchr::memmem::find(text, b"]$POSREG ").is_some();
            of = None;
        } else if !is_inside {
            continue;
        } else if text.starts_with(b"[") {
            of = index(text).filter(|(group, _)| *group == 1);
            values = [None; OF_ARM];
        }
        let Some((_, number)) = of else { continue };
        // behind a comment in quotes
        let text = memchr::memrchr(b'\'', text).map_or(text, |quote| &text[quote + 1..]);
        let at = start + line.len() - text.len();
        if let Some(rest) = text.trim_ascii_start().strip_prefix(b"EXT") {
            external(
                rest,
                start + line.len() - rest.len(),
                number,
                &mut registers,
            )?;
            continue;
        }
        coordinates(text, at, &mut values)?;
        if let [Some(x), Some(y), Some(z), Some(w), Some(p), Some(r)] = values {
            registers.insert(number, [x, y, z, w, p, r, 0.0, 0.0, 0.0]);
            values = [None; OF_ARM];
        }
    }
    Ok(registers)
}

/// `1:  40.492 mm` behind EXT; of a register with an axis that nobody knows nothing is known.
fn external(
    text: &[u8],
    start: usize,
    number: u32,
    registers: &mut BTreeMap<u32, Shown>,
) -> Result<(), BadNumber> {
    let Some(colon) = memchr::memchr(b':', text) else {
        return Ok(());
    };
    let axis = crate::program::number::whole(text[..colon].trim_ascii());
    let value = value(&text[colon + 1..], start + colon + 1, LARGEST)?;
    let place = axis.and_then(|axis| OF_ARM.checked_add(axis as usize)?.checked_sub(1));
    let register = registers.get_mut(&number);
    match (register, place.filter(|at| *at >= OF_ARM), value) {
        (Some(register), Some(at), Some(value)) if at < register.len() => register[at] = value,
        (None, ..) => {}
        _ => _ = registers.remove(&number),
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cartesian_registers_of_group_1_are_known() {
        let text = "[*POSREG*]$POSREG  Storage: CMOS  Access: RW  : ARRAY[2,8] OF Position Reg\r\n\
                        [1,1] =   'Home: X: 5'   Group: 1\r\n  J1 =     0.000 deg   J2 =   -60.000 deg   \
                    J3 =     0.000 deg \r\n  J4 =     0.000 deg   J5 =    90.000 deg   J6 =      .000 \
                    deg \r\n  EXT1:     0.000 mm  \r\n\r\n    [1,2] =   '' Uninitialized\r\n    [1,6] = \
                      'up' \r\n  Group: 1   Config: F U T, 0, 0, 0\r\n  X:     0.000   Y:     -.500   Z: \
                      100.000\r\n  W:  -179.786   P:     -.649   R:   -58.819\r\n  EXT1:    40.492 mm  \r\n \
                       [1,7] =   '' \r\n  Group: 1   Config: N U T, 0, 0, 0\r\n  X:     1.000   Y:     \
                    2.000   Z:     3.000\r\n  W:     4.000   P:     5.000   R:     6.000\r\n  EXT1:  \
                    ******** mm  \r\n    [1,8] =   '' \r\n  Group: 1   Config: N U T, 0, 0, 0\r\n  X:  \
                    ********   Y:     2.000   Z:     3.000\r\n  W:     4.000   P:     5.000   R:     \
                    6.000\r\n    [2,6] =   '' \r\n  Group: 2   Config: N U T, 0, 0, 0\r\n  X:     1.000   \
                    Y:     2.000   Z:     3.000\r\n  W:     4.000   P:     5.000   R:     \
                    6.000\r\n[*POSREG*]$MAXPREGNUM  Storage: CMOS  Access: RW  : INTEGER = 100\r\n";
        let found = read(text.as_bytes()).expect("registers");
        let up = [
            0.0, -0.5, 100.0, -179.786, -0.649, -58.819, 40.492, 0.0, 0.0,
        ];
        assert_eq!(found.into_iter().collect::<Vec<_>>(), [(6, up)]);
        let bad = text.replace("-.500", "1e9");
        assert!(read(bad.as_bytes()).is_err());
    }
}

//! How fast a move is and how near it must come to its target, where its arguments are numbers.

use super::insert::value;
use crate::program::insert::{arguments, bracketed};
use crate::program::{Pace, number};

/// Places of speed and blend radius among the arguments.
fn places(verb: &[u8]) -> Option<(Option<usize>, usize)> {
    Some(match verb {
        b"movel" => (Some(2), 4),
        b"movep" => (Some(2), 3),
        b"movec" => (Some(3), 4),
        // the speed is that of a joint
        b"movej" => (None, 4),
        _ => return None,
    })
}

fn read(bytes: &[u8], offset: usize) -> Option<Pace> {
    let open = offset + memchr::memchr(b'(', &bytes[offset..])?;
    let (speed_at, radius_at) = places(bytes[offset..open].trim_ascii_end())?;
    let call = bracketed(bytes, open)?;
    let all = arguments(bytes, open + 1, call.end - 1);
    // not given is none: the robot stops
    let (mut speed_m_s, mut zone_m) = (None, Some(0.0));
    for (at, span) in all.iter().enumerate() {
        let (name, inside) = value(bytes, span);
        let name = name.map(|name| &bytes[name]);
        let told = number::parse(&bytes[inside]);
        let is = |place: Option<usize>, word: &[u8]| match name {
            Some(name) => name == word,
            None => Some(at) == place,
        };
        if speed_at.is_some() && is(speed_at, b"v") {
            speed_m_s = told;
        } else if is(Some(radius_at), b"r") {
            zone_m = told;
        }
    }
    Some(Pace {
        speed_m_s,
        zone_m,
        // a variable says how far
        blends: zone_m.is_none(),
    })
}

/// See [`crate::program::Language::pace`].
pub(super) fn pace(bytes: &[u8], offset: usize) -> Pace {
    read(bytes, offset).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn speed_and_radius_are_arguments_by_place_or_name() {
        let of = |text: &str| pace(text.as_bytes(), 0);
        let named = of("movel(p[1,2,3,0,0,0], a=1.2, r=0.005, v=0.25)");
        assert_eq!((named.speed_m_s, named.zone_m), (Some(0.25), Some(0.005)));
        let placed = of("movec(p[1,2,3,0,0,0], b, 1.2, 0.1, 0.02, 0)");
        assert_eq!((placed.speed_m_s, placed.zone_m), (Some(0.1), Some(0.02)));
        let joint = of("movej(q, 1.4, 1.05)");
        assert_eq!((joint.speed_m_s, joint.zone_m), (None, Some(0.0)));
        let variable = of("movel(q, a, v, 0, radius)");
        assert!(variable.cuts_corner() && variable.speed_m_s.is_none());
    }
}

//! Condition files of a controller backup: TOOL.CND and UFRAME.CND. They are read and never
//! changed.
//!
//! A tool is `//TOOL n`, its name, `x,y,z,Rx,Ry,Rz` on the flange, the centre of gravity, the mass.
//! A user frame is `//UFRAME n` and, among the positions it was taught with, `BUSER x,y,z,Rx,Ry,Rz`
//! in the base frame.

use super::lines::{Lines, after, numbers, unexpected, words};
use crate::geometry::Pose;
use crate::geometry::units::m_from_mm;
use crate::program::kit::Fault;
use crate::program::notation::pose_of_angles;
use crate::program::{Load, MOST_ANGLE_DEG, Number, ReadError, Source, number};
use foldhash::HashMap;

/// What condition files tell, by number; `None` where files differ.
#[derive(Debug, Default)]
pub(super) struct Conditions {
    pub tools: HashMap<u32, Option<(Pose, Option<Load>)>>,
    pub frames: HashMap<u32, Option<Pose>>,
}

/// Whether a file is one of these.
pub(super) fn recognises(bytes: &[u8]) -> bool {
    let mut lines = Lines::of(bytes).filter(|line| !line.text.is_empty());
    lines.next().is_some_and(|line| {
        let number = after(line.text, b"//TOOL").or_else(|| after(line.text, b"//UFRAME"));
        number.is_some_and(|number| words(number).next().and_then(number::whole).is_some())
    })
}

enum Open {
    None,
    /// The number, the pose, the centre of gravity, in the order of the lines.
    Tool(u32, Option<Pose>, Option<[f64; 3]>),
    Frame(u32),
}

/// Reads such a file.
pub(super) fn read(source: &Source, conditions: &mut Conditions) -> Result<(), ReadError> {
    let mut open = Open::None;
    for line in Lines::of(&source.bytes) {
        let number = |text| {
            words(text).next().and_then(number::whole).ok_or_else(|| {
                unexpected(
                    source,
                    line.start,
                    line.text,
                    "the number of a tool or frame",
                )
            })
        };
        let values = |skip: usize, count: usize| {
            let from = line.start + skip;
            let found = numbers(source, from, line.start + line.text.len())?;
            if found.len() < count {
                let expected = "x, y, z (and Rx, Ry, Rz)";
                return Err(unexpected(source, line.start, line.text, expected));
            }
            let endless = |n: &Number| n.value.abs() > MOST_ANGLE_DEG;
            if let Some(angle) = found.iter().skip(3).find(|n| count == 6 && endless(n)) {
                let start = angle.start as usize;
                let fault = Fault::bad_value(
                    start..start + usize::from(angle.length),
                    "angle of a tool or frame in degrees",
                    "the limit is 720 deg; write it between -360 and 360",
                );
                return Err(fault.in_source(source));
            }
            let mut values = [0.0; 6];
            for (value, number) in values.iter_mut().zip(&found) {
                *value = number.value;
            }
            Ok(values)
        };
        if let Some(text) = after(line.text, b"//TOOL") {
            open = Open::Tool(number(text)?, None, None);
        } else if let Some(text) = after(line.text, b"//UFRAME") {
            open = Open::Frame(number(text)?);
        } else if let Some(at) = memchr::memmem::find(line.text, b"/BUSER") {
            if let Open::Frame(frame) = open {
                let skip = at + b"/BUSER".len();
                let equals = memchr::memchr(b'=', &line.text[skip..]).map_or(0, |at| at + 1);
                let pose = pose_of_angles(values(skip + equals, 6)?);
                keep(&mut conditions.frames, frame, pose, |a, b| a == b);
            }
        } else if line.text.is_empty() || line.text[0] == b'/' {
        } else if let Open::Tool(tool, pose, cog) = &mut open {
            match (*pose, *cog) {
                (None, _) => *pose = Some(pose_of_angles(values(0, 6)?)),
                (Some(_), None) => {
                    let v = values(0, 3)?;
                    *cog = Some([v[0], v[1], v[2]].map(m_from_mm));
                }
                (Some(pose), Some(cog_m)) => {
                    let mass_kg = values(0, 1)?[0];
                    let load = (mass_kg > 0.0).then_some(Load { mass_kg, cog_m });
                    keep(&mut conditions.tools, *tool, (pose, load), |a, b| a == b);
                    open = Open::None;
                }
            }
        }
    }
    if let Open::Tool(tool, Some(pose), _) = open {
        keep(&mut conditions.tools, tool, (pose, None), |a, b| a == b);
    }
    Ok(())
}

/// Keeps a value, or that there is more than one.
fn keep<T>(
    all: &mut HashMap<u32, Option<T>>,
    number: u32,
    value: T,
    same: impl Fn(&T, &T) -> bool,
) {
    match all.entry(number) {
        std::collections::hash_map::Entry::Vacant(place) => {
            place.insert(Some(value));
        }
        std::collections::hash_map::Entry::Occupied(mut place) => {
            if !place.get().as_ref().is_some_and(|old| same(old, &value)) {
                place.insert(None);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tools_have_pose_and_load_and_frames_their_place_in_the_base_frame() {
        let tools = "//TOOL 0\r\n///NAME TORCH\r\n10.000,0.000,305.500,0.0000,90.0000,0.0000\r\n\
                     -16.5,0.0,36.0\r\n4.011\r\n0.0,0.0,0.0\r\n0.000,0,3\r\n//TOOL 1\r\n///NAME\r\n\
                     0.000,0.000,0.000,0.0000,0.0000,0.0000\r\n0.000,0.000,0.000\r\n0.000\r\n";
        let frames = "//UFRAME 12\n///NAME BENCH\n///TOOL 1\n////RORG C000=0,0,0,0,0,0\n\
                      ////BUSER 100.000,200.000,-30.000,0.0000,0.0000,90.0000\n";
        let mut found = Conditions::default();
        for text in [tools, frames] {
            let source = Source::new("x.CND", text.into());
            assert!(recognises(&source.bytes));
            read(&source, &mut found).expect("conditions");
        }
        let (pose, load) = found.tools[&0].expect("one tool");
        assert!((pose.translation[2] - 0.3055).abs() < 1e-12);
        assert!(load.is_some_and(|load| (load.mass_kg - 4.011).abs() < 1e-12));
        assert_eq!(found.tools[&1], Some((Pose::identity(), None)));
        let frame = found.frames[&12].expect("one frame");
        assert!((frame.rotation.0[1][0] - 1.0).abs() < 1e-12);
        // the same number with another value is not known
        let other = Source::new("y.CND", tools.replace("305.500", "300").into());
        read(&other, &mut found).expect("conditions");
        assert_eq!(found.tools[&0], None);
        assert!(!recognises(b"//TOOLS 5\n"));
    }
}

//! `$machine.dat` and `$config.dat` of a KUKA controller: what carries the base, and what carries
//! the part.
//!
//! ```text
//! ET(e) = TA1KR · M1 · TA2A1 · M2 · TA3A2 · M3 · TFLA3        M: along or about z of its frame
//! base(e) = $ERSYSROOT · ET(e)                                frame(e) = root of the machine · ET(e)
//! ```
//!
//! # Source
//! KUKA, KR C2 "Machine data" 2.1.9; the chain from users who computed with it. Not verified on a
//! controller.

use super::external::Read;
use crate::geometry::units::{DEG, m_from_mm};
use crate::geometry::{Pose, Rotation, cross, norm};
use crate::model::external::{
    Coordinates, ExternalAxes, Follows, Positioner, RotaryAxis, TrackAxis,
};
use crate::program::Source;
use crate::task::{Failure, text};
use std::collections::BTreeMap;

/// Kinematics of the controller.
const KINEMATICS: usize = 6;
/// The frames of one, from its root.
const FRAMES: [&str; 4] = ["TA1KR", "TA2A1", "TA3A2", "TFLA3"];
/// A track nearer to the vertical has its up along the world's x.
const STEEP: f64 = 0.1;

/// A value with its place.
struct Value {
    file: usize,
    line: usize,
    text: String,
}

struct Data<'a> {
    sources: &'a [Source],
    /// By name in capitals, an index with it.
    values: BTreeMap<String, Value>,
}

impl<'a> Data<'a> {
    fn read(sources: &'a [Source]) -> Result<Self, Failure> {
        let mut values = BTreeMap::new();
        for (file, source) in sources.iter().enumerate() {
            for (line, number) in text(source)?.lines().zip(1..) {
                let content = line.split(';').next().unwrap_or_default();
                let Some((left, right)) = content.split_once('=') else {
                    continue;
                };
                let Some(name) = left.split_whitespace().last() else {
                    continue;
                };
                let value = Value {
                    file,
                    line: number,
                    text: right.trim().to_owned(),
                };
                values.insert(name.to_ascii_uppercase(), value);
            }
        }
        Ok(Self { sources, values })
    }

    fn refuse(&self, value: &Value, message: String, hint: &str) -> Failure {
        Failure::at(
            &self.sources[value.file],
            value.line,
            1,
            None,
            message,
            hint,
        )
    }

    fn get(&self, name: &str) -> Result<&Value, Failure> {
        self.values.get(name).ok_or_else(|| {
            let names: Vec<&str> = self.sources.iter().map(|s| s.name.as_str()).collect();
            let message = format!("{}: there is no {name}", names.join(", "));
            let hint = "$machine.dat has the chains, $config.dat the roots (MACHINE_DEF): give the \
                folder of both";
            Failure::with_hint(message, hint)
        })
    }

    fn number(&self, name: &str) -> Result<f64, Failure> {
        let value = self.get(name)?;
        let number = value.text.parse().ok().filter(|n: &f64| n.is_finite());
        number
            .ok_or_else(|| self.refuse(value, format!("{name} is `{}`: no number", value.text), ""))
    }

    fn frame(&self, name: &str) -> Result<Pose, Failure> {
        let value = self.get(name)?;
        frame(&value.text)
            .ok_or_else(|| self.refuse(value, format!("{name} is `{}`: no frame", value.text), ""))
    }

    fn from(&self, value: &Value) -> String {
        format!("{}:{}", self.sources[value.file].name, value.line)
    }
}

/// The field of an aggregate: `ET1` of `{ET1 #ERSYS,ET2 #NONE}`.
fn field<'t>(aggregate: &'t str, name: &str) -> Option<&'t str> {
    let inside = aggregate.strip_prefix('{')?;
    let (mut depth, mut start) = (0_usize, 0);
    let mut fields = Vec::new();
    for (at, c) in inside.char_indices() {
        match c {
            '{' => depth += 1,
            '}' if depth == 0 => {
                fields.push(&inside[start..at]);
                break;
            }
            '}' => depth -= 1,
            ',' if depth == 0 => {
                fields.push(&inside[start..at]);
                start = at + 1;
            }
            _ => {}
        }
    }
    fields.into_iter().find_map(|field| {
        let field = field.trim();
        let (own, value) = field.split_at(field.find([' ', '[', '{'])?);
        let value = value.trim_start_matches("[]").trim();
        own.eq_ignore_ascii_case(name).then_some(value)
    })
}

/// `{X 0.0,Y 0.0,Z 450.0,A 0.0,B 90.0,C 0.0}`
fn frame(aggregate: &str) -> Option<Pose> {
    let mut numbers = [0.0; 6];
    for (slot, name) in numbers.iter_mut().zip(["X", "Y", "Z", "A", "B", "C"]) {
        *slot = field(aggregate, name)?
            .parse()
            .ok()
            .filter(|n: &f64| n.is_finite())?;
    }
    let [x, y, z, a, b, c] = numbers;
    let [a, b, c] = [a, b, c].map(|angle| angle * DEG);
    Some(Pose {
        rotation: Rotation::about_z(a) * Rotation::about_y(b) * Rotation::about_x(c),
        translation: [x, y, z].map(m_from_mm),
    })
}

/// The number of an axis, from 1: `#E2`.
fn axis_number(text: &str) -> Option<usize> {
    let number = text.strip_prefix('#')?.strip_prefix(['E', 'e'])?;
    number.parse().ok().filter(|n| (1..=6).contains(n))
}

/// Reads what carries the base and the part.
///
/// # Errors
/// Data that are missing or no numbers, a turntable under the robot, more than two axes of a
/// positioner, a machine that stands on another one, by file and line.
pub(super) fn read(sources: &[Source]) -> Result<Read, Failure> {
    let data = Data::read(sources)?;
    let kinds = data.get("$EX_KIN")?;
    let mut read = Read {
        base: None,
        axes: ExternalAxes::default(),
        notes: Vec::new(),
    };
    let used: Vec<(usize, &str)> = (1..=KINEMATICS)
        .filter_map(|n| Some((n, field(&kinds.text, &format!("ET{n}"))?)))
        .filter(|(_, kind)| !kind.eq_ignore_ascii_case("#NONE"))
        .collect();
    if used.is_empty() {
        let message = "$EX_KIN: every kinematic is #NONE: external axes carry nothing".to_owned();
        let hint = "values of E1 to E6 in programs are those of axes that carry nothing: name them \
            in `other:`";
        return Err(data.refuse(kinds, message, hint));
    }
    for (number, kind) in used {
        let list = data.get(&format!("$ET{number}_AX"))?;
        let axes: Vec<usize> = (1..=3)
            .filter_map(|k| axis_number(field(&list.text, &format!("TR_A{k}"))?))
            .collect();
        if axes.is_empty() {
            let message = format!("$ET{number}_AX names no axis of {kind}");
            return Err(data.refuse(list, message, ""));
        }
        if kind.eq_ignore_ascii_case("#ERSYS") {
            track(&data, number, &axes, &mut read)?;
        } else {
            positioner(&data, (number, kind), &axes, &mut read)?;
        }
    }
    Ok(read)
}

/// Smallest and largest value of an axis, and whether it is linear.
fn limits(data: &Data, axis: usize) -> Result<([f64; 2], bool), Failure> {
    let kind = data.get(&format!("$AXIS_TYPE[{}]", axis + 6))?;
    let is_linear = match kind.text.as_str() {
        "1" => true,
        "3" | "5" => false,
        other => {
            let message =
                format!("$AXIS_TYPE of E{axis} is {other}: 1 is linear, 3 and 5 are rotary");
            return Err(data.refuse(kind, message, "describe the axis by hand"));
        }
    };
    let ends = [
        data.number(&format!("$SOFTN_END[{}]", axis + 6))?,
        data.number(&format!("$SOFTP_END[{}]", axis + 6))?,
    ];
    Ok((ends, is_linear))
}

/// The frames of a kinematic, from its root.
fn chain(data: &Data, number: usize) -> Result<[Pose; 4], Failure> {
    let mut frames = [Pose::identity(); 4];
    for (slot, name) in frames.iter_mut().zip(FRAMES) {
        *slot = data.frame(&format!("$ET{number}_{name}"))?;
    }
    Ok(frames)
}

fn track(data: &Data, number: usize, axes: &[usize], read: &mut Read) -> Result<(), Failure> {
    let root = data.get("$ERSYSROOT")?;
    let frames = chain(data, number)?;
    let mut at = data.frame("$ERSYSROOT")?;
    for (k, frame) in frames.iter().enumerate() {
        at = at * *frame;
        let Some(axis) = axes.get(k) else {
            continue;
        };
        let ([min, max], is_linear) = limits(data, *axis)?;
        if !is_linear {
            let kind = data.get(&format!("$AXIS_TYPE[{}]", axis + 6))?;
            let message = format!("E{axis} rotates the base: a turntable under the robot");
            let hint = "only linear axes under the robot are compensated";
            return Err(data.refuse(kind, message, hint));
        }
        let direction = at.rotation.axis(2);
        let up = [0.0, 0.0, 1.0];
        let up = if norm(cross(up, direction)) < STEEP {
            [1.0, 0.0, 0.0]
        } else {
            up
        };
        read.axes.track.push(TrackAxis {
            axis: format!("E{axis}"),
            direction,
            up,
            zero_m: 0.0,
            min_m: m_from_mm(min),
            max_m: m_from_mm(max),
            coordinates: Coordinates::World,
            pulses_per_mm: None,
        });
        read.notes.push(format!(
            "E{axis}: z of $ERSYSROOT ({}) · $ET{number}_TA1KR …, limits of $SOFTN_END and \
             $SOFTP_END",
            data.from(root)
        ));
    }
    read.base = Some(at);
    read.notes.push(format!(
        "kinematics.base: $ERSYSROOT · the chain of ET{number} at zero; $ROBROOT is not used"
    ));
    Ok(())
}

fn positioner(
    data: &Data,
    (number, kind): (usize, &str),
    axes: &[usize],
    read: &mut Read,
) -> Result<(), Failure> {
    let list = data.get(&format!("$ET{number}_AX"))?;
    if axes.len() > 2 {
        let message = format!(
            "{kind} has {} axes; a positioner has one or two",
            axes.len()
        );
        return Err(data.refuse(list, message, "describe what it carries by hand"));
    }
    let machine = (1..=16).find_map(|n| {
        let value = data.values.get(&format!("MACHINE_DEF[{n}]"))?;
        let is_own = field(&value.text, "MECH_TYPE")?.eq_ignore_ascii_case(kind);
        is_own.then_some((n, value))
    });
    let Some((machine, value)) = machine else {
        let message =
            format!("nothing says where {kind} stands: no MACHINE_DEF has it as its MECH_TYPE");
        let hint = "MACHINE_DEF is in $config.dat: give the folder of both files";
        return Err(data.refuse(list, message, hint));
    };
    let parent = field(&value.text, "PARENT")
        .unwrap_or_default()
        .trim_matches('"');
    if !parent.is_empty() && !parent.eq_ignore_ascii_case("WORLD") {
        let message =
            format!("MACHINE_DEF[{machine}] stands on {parent}: a station that is carried itself");
        return Err(data.refuse(value, message, "stations on tracks are not compensated"));
    }
    let root = field(&value.text, "ROOT").and_then(frame).ok_or_else(|| {
        data.refuse(
            value,
            format!("MACHINE_DEF[{machine}] has no frame ROOT"),
            "",
        )
    })?;
    let [first, second, third, last] = chain(data, number)?;
    let at = match axes {
        [_] => vec![root * first],
        _ => vec![root * first, second],
    };
    let plate = match axes {
        [_] => second * third * last,
        _ => third * last,
    };
    let mut rotary = Vec::new();
    for (axis, at) in axes.iter().zip(at) {
        let ([min, max], is_linear) = limits(data, *axis)?;
        if is_linear {
            let message = format!("E{axis} of {kind} is linear: a positioner turns");
            return Err(data.refuse(list, message, "describe what it carries by hand"));
        }
        rotary.push(RotaryAxis {
            axis: format!("E{axis}"),
            at,
            sign: 1.0,
            zero_rad: 0.0,
            min_rad: min * DEG,
            max_rad: max * DEG,
            pulses_per_deg: None,
        });
    }
    read.notes.push(format!(
        "positioner {machine}: ROOT of MACHINE_DEF[{machine}] ({}) · the chain of ET{number}",
        data.from(value)
    ));
    read.axes.positioners.push(Positioner {
        name: machine.to_string(),
        follows: Follows::Frame,
        axes: rotary,
        plate,
        points: BTreeMap::new(),
    });
    Ok(())
}

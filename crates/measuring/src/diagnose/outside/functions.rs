//! Functions of the posture, the load, the motion and the time that an error may follow, whether or
//! not an effect of the registry does.

use crate::identify::problem::{Estimate, Problem};
use crate::model::JOINTS;
use std::f64::consts::FRAC_PI_2;
use std::fmt;

/// What effects of the registry do already.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Registered {
    /// At this joint.
    Of(usize),
    /// At every joint.
    OfAll,
}

/// What functions are of, of one row.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Facts {
    angles: [f64; JOINTS],
    torques: [f64; JOINTS],
    direction: [f64; JOINTS],
    /// Above the mean temperature, °C.
    warmer: f64,
    /// Its place among the rows and in time, from -1 to 1.
    clocks: [f64; 2],
}

/// What runs from the first row to the last, by its place in [`Facts::clocks`].
const CLOCKS: [&str; 2] = ["row", "time"];
/// Parts of a range at whose borders a function may jump or bend.
const PARTS: usize = 10;
/// Half periods of a wave over the session.
const MOST_HALVES: u32 = 12;

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Wave {
    Cos,
    Sin,
}

impl Wave {
    fn of(self, angle: f64) -> f64 {
        match self {
            Self::Cos => angle.cos(),
            Self::Sin => angle.sin(),
        }
    }

    const fn name(self) -> &'static str {
        match self {
            Self::Cos => "cos",
            Self::Sin => "sin",
        }
    }
}

const WAVES: [Wave; 2] = [Wave::Cos, Wave::Sin];

/// What the direction of a joint is multiplied with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum By {
    Load,
    Torque,
    Angle(Wave),
}

/// A function of a row. Joints count from 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Function {
    Power(usize, i32),
    /// Of a joint's angle, so many half periods a revolution.
    Periodic(Wave, u32, usize),
    Beyond(usize, f64),
    BentAt(usize, f64),
    Product(usize, usize),
    OfSum(Wave, usize, usize),
    OfDifference(Wave, usize, usize),
    Torque(usize, i32),
    SignOfTorque(usize),
    Direction(usize),
    DirectionTimes(usize, By),
    Directions(usize, usize),
    Temperature(i32),
    /// Of a clock.
    ClockPower(usize, i32),
    /// Of a clock, in half periods of the session.
    ClockWave(Wave, u32, usize),
}

impl Function {
    /// Whether it is one of the row or the time.
    pub(crate) const fn of_session(self) -> bool {
        matches!(self, Self::ClockPower(..) | Self::ClockWave(..))
    }
}

impl fmt::Display for Function {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let order = |halves: u32| f64::from(halves) / 2.0;
        match *self {
            Self::Power(i, power) => write!(f, "q{}^{power}", i + 1),
            Self::Periodic(wave, halves, i) => {
                write!(f, "{} {} q{}", wave.name(), order(halves), i + 1)
            }
            Self::Beyond(i, at) => write!(f, "q{} beyond {:.0} deg", i + 1, at.to_degrees()),
            Self::BentAt(i, at) => write!(f, "q{} bent at {:.0} deg", i + 1, at.to_degrees()),
            Self::Product(i, k) => write!(f, "q{} q{}", i + 1, k + 1),
            Self::OfSum(wave, i, k) => write!(f, "{} (q{}+q{})", wave.name(), i + 1, k + 1),
            Self::OfDifference(wave, i, k) => {
                write!(f, "{} (q{}-q{})", wave.name(), i + 1, k + 1)
            }
            Self::Torque(i, 1) => write!(f, "torque {}", i + 1),
            Self::Torque(i, power) => write!(f, "torque {}^{power}", i + 1),
            Self::SignOfTorque(i) => write!(f, "sign of torque {}", i + 1),
            Self::Direction(i) => write!(f, "dir{}", i + 1),
            Self::DirectionTimes(i, By::Load) => write!(f, "dir{0} |torque {0}|", i + 1),
            Self::DirectionTimes(i, By::Torque) => write!(f, "dir{0} torque {0}", i + 1),
            Self::DirectionTimes(i, By::Angle(wave)) => {
                write!(f, "dir{0} {1} q{0}", i + 1, wave.name())
            }
            Self::Directions(i, k) => write!(f, "dir{} dir{}", i + 1, k + 1),
            Self::Temperature(1) => f.write_str("temperature"),
            Self::Temperature(power) => write!(f, "temperature^{power}"),
            Self::ClockPower(clock, power) => write!(f, "{}^{power}", CLOCKS[clock]),
            Self::ClockWave(wave, halves, clock) => {
                write!(f, "{} {halves}/2 {}", wave.name(), CLOCKS[clock])
            }
        }
    }
}

impl Function {
    /// Its value at a row.
    pub(crate) fn at(&self, row: &Facts) -> f64 {
        let (q, torque, direction) = (&row.angles, &row.torques, &row.direction);
        match *self {
            Self::Power(i, power) => q[i].powi(power),
            Self::Periodic(wave, halves, i) => wave.of(f64::from(halves) / 2.0 * q[i]),
            Self::Beyond(i, at) => f64::from(u8::from(q[i] > at)),
            Self::BentAt(i, at) => (q[i] - at).max(0.0),
            Self::Product(i, k) => q[i] * q[k],
            Self::OfSum(wave, i, k) => wave.of(q[i] + q[k]),
            Self::OfDifference(wave, i, k) => wave.of(q[i] - q[k]),
            Self::Torque(i, power) => torque[i].powi(power),
            Self::SignOfTorque(i) => torque[i].signum(),
            Self::Direction(i) => direction[i],
            Self::DirectionTimes(i, by) => {
                direction[i]
                    * match by {
                        By::Load => torque[i].abs(),
                        By::Torque => torque[i],
                        By::Angle(wave) => wave.of(q[i]),
                    }
            }
            Self::Directions(i, k) => direction[i] * direction[k],
            Self::Temperature(power) => row.warmer.powi(power),
            Self::ClockPower(clock, power) => row.clocks[clock].powi(power),
            Self::ClockWave(wave, halves, clock) => {
                wave.of(f64::from(halves) * FRAC_PI_2 * (row.clocks[clock] + 1.0))
            }
        }
    }

    /// What effects of the registry do already: a joint's scale, coupling, harmonic, compliance or
    /// backlash.
    pub(crate) const fn registered(&self) -> Option<Registered> {
        match *self {
            Self::Power(_, 1) => Some(Registered::OfAll),
            Self::Periodic(_, halves, i) if halves % 2 == 0 => Some(Registered::Of(i)),
            Self::Torque(i, 1) | Self::Direction(i) | Self::DirectionTimes(i, By::Load) => {
                Some(Registered::Of(i))
            }
            _ => None,
        }
    }

    /// The joint that it may turn alone; all where none.
    pub(crate) const fn joint(&self) -> Option<usize> {
        match *self {
            Self::Periodic(_, halves, i) if halves % 2 == 1 => Some(i),
            Self::Beyond(i, _) | Self::BentAt(i, _) | Self::DirectionTimes(i, _) => Some(i),
            _ => None,
        }
    }

    /// Whether it may move the base and the tool as well.
    pub(crate) const fn moves_frames(&self) -> bool {
        match *self {
            Self::Power(_, power) | Self::Torque(_, power) => power < 3,
            Self::Periodic(_, halves, _) => halves % 2 == 0 && halves < 6,
            Self::Direction(_)
            | Self::Temperature(_)
            | Self::ClockPower(..)
            | Self::ClockWave(..) => true,
            _ => false,
        }
    }
}

/// What functions are of, of each row.
pub(crate) fn facts(problem: &Problem, estimate: &Estimate) -> Vec<Facts> {
    let rows = &problem.rows;
    let mechanism = problem.mechanism();
    let models = problem.models(estimate, &[]);
    let temperature = |row: usize| rows[row].conditions.temperature_c.unwrap_or(0.0);
    let mean = (0..rows.len()).map(temperature).sum::<f64>() / rows.len().max(1) as f64;
    let last = (rows.len() as f64 - 1.0).max(1.0);
    let times = rows.iter().filter_map(|row| row.conditions.time_s);
    let (low, high) = times.fold((f64::MAX, f64::MIN), |(l, h), t| (l.min(t), h.max(t)));
    let fact = |(number, row): (usize, &crate::identify::problem::Row)| Facts {
        angles: mechanism.commanded(&row.q),
        torques: models[row.rig].torques(&row.q, &row.conditions),
        direction: row.conditions.direction,
        warmer: temperature(number) - mean,
        clocks: [
            2.0 * (number as f64) / last - 1.0,
            row.conditions
                .time_s
                .map_or(0.0, |t| 2.0 * (t - low) / (high - low) - 1.0),
        ],
    };
    rows.iter().enumerate().map(fact).collect()
}

/// All functions of these rows, whether or not they differ from row to row.
pub(crate) fn functions(problem: &Problem, rows: &[Facts]) -> Vec<Function> {
    let mut all = Vec::new();
    for i in 0..JOINTS {
        all.extend((1..=4).map(|power| Function::Power(i, power)));
        let periodic = |halves| WAVES.map(|wave| Function::Periodic(wave, halves, i));
        all.extend([2, 4, 6, 8].into_iter().flat_map(periodic));
        all.extend([1, 3, 5].into_iter().flat_map(periodic));
        let mut sorted: Vec<f64> = rows.iter().map(|row| row.angles[i]).collect();
        sorted.sort_by(f64::total_cmp);
        for part in 1..PARTS {
            let at = sorted[sorted.len() * part / PARTS];
            all.extend([Function::Beyond(i, at), Function::BentAt(i, at)]);
        }
        for k in i + 1..JOINTS {
            all.push(Function::Product(i, k));
            all.extend(WAVES.map(|wave| Function::OfSum(wave, i, k)));
            all.extend(WAVES.map(|wave| Function::OfDifference(wave, i, k)));
        }
        all.extend((1..=3).map(|power| Function::Torque(i, power)));
        all.extend([Function::SignOfTorque(i), Function::Direction(i)]);
        let by = [By::Load, By::Torque].into_iter();
        let by = by.chain(WAVES.map(By::Angle));
        all.extend(by.map(|by| Function::DirectionTimes(i, by)));
        all.extend((i + 1..JOINTS).map(|k| Function::Directions(i, k)));
    }
    all.extend((1..=2).map(Function::Temperature));
    let has_time = problem
        .rows
        .iter()
        .all(|row| row.conditions.time_s.is_some());
    let ends = rows.iter().map(|row| row.clocks[1]);
    let runs = has_time && ends.fold(f64::MIN, f64::max) > -1.0;
    for clock in 0..=usize::from(runs) {
        all.extend((1..=3).map(|power| Function::ClockPower(clock, power)));
        let waves = |halves| WAVES.map(|wave| Function::ClockWave(wave, halves, clock));
        all.extend((1..=MOST_HALVES).flat_map(waves));
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_the_registry_has_is_known_by_its_function() {
        let of = Registered::Of;
        for (function, name, registered) in [
            (Function::Power(2, 1), "q3^1", Some(Registered::OfAll)),
            (Function::Power(2, 2), "q3^2", None),
            (Function::Periodic(Wave::Cos, 4, 1), "cos 2 q2", Some(of(1))),
            (Function::Periodic(Wave::Sin, 3, 1), "sin 1.5 q2", None),
            (Function::Torque(4, 1), "torque 5", Some(of(4))),
            (Function::Torque(4, 2), "torque 5^2", None),
            (Function::Direction(0), "dir1", Some(of(0))),
            (
                Function::DirectionTimes(0, By::Load),
                "dir1 |torque 1|",
                Some(of(0)),
            ),
            (
                Function::DirectionTimes(0, By::Torque),
                "dir1 torque 1",
                None,
            ),
            (Function::Directions(0, 1), "dir1 dir2", None),
            (Function::ClockWave(Wave::Cos, 3, 0), "cos 3/2 row", None),
        ] {
            assert_eq!(function.to_string(), name);
            assert_eq!(function.registered(), registered, "{name}");
        }
    }
}

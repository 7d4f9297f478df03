//! What `time_s` counts from: switching the cold robot on, or something else.

use super::measurements::{Measurement, Measurements};
use std::ops::Range;

/// A clock that counts from longer before the first row than this part of the rows' time: of a
/// warm-up with the shortest constant that is sought (a twentieth of it) 63 % is over by then, and
/// what the rows show would be enlarged by 2.7.
const LATE: f64 = 0.05;
/// A clock may begin so many rows before the first.
const ROWS_BEFORE: f64 = 2.0;

/// Times that begin late, or before the robot was switched on.
#[derive(Clone, Debug, PartialEq)]
pub struct Late {
    /// `time_s` of the first row by the clock, seconds.
    pub first_s: f64,
    /// From there to the last, seconds.
    pub length_s: f64,
    /// The file, where several are read as one.
    pub file: Option<String>,
}

/// Rows in which a clock runs on.
struct Session {
    rows: Range<usize>,
    first_s: f64,
    last_s: f64,
    count: f64,
}

impl Session {
    fn length_s(&self) -> f64 {
        self.last_s - self.first_s
    }

    fn is_late(&self) -> bool {
        let part = LATE.max(ROWS_BEFORE / f64::max(self.count - 1.0, 1.0));
        self.length_s() > 0.0 && self.first_s.abs() > part * self.length_s()
    }

    /// Whether another begins behind it by no more than it took.
    fn goes_on(&self, next: &Self) -> bool {
        let pause_s = next.first_s - self.last_s;
        self.length_s() > 0.0 && (0.0..=self.length_s()).contains(&pause_s)
    }
}

/// Sessions of the files: one that begins where the one before ended has the same clock.
fn sessions(rows: &[Measurement]) -> Vec<Session> {
    let mut all: Vec<Session> = Vec::new();
    let mut start = 0;
    for file in rows.chunk_by(|a, b| a.line.file == b.line.file) {
        let own = start..start + file.len();
        start = own.end;
        let times = file.iter().filter_map(|row| row.conditions.time_s);
        let mut session = Session {
            rows: own,
            first_s: f64::INFINITY,
            last_s: f64::NEG_INFINITY,
            count: 0.0,
        };
        for time_s in times {
            session.first_s = session.first_s.min(time_s);
            session.last_s = session.last_s.max(time_s);
            session.count += 1.0;
        }
        match all.last_mut().filter(|before| before.goes_on(&session)) {
            Some(before) => {
                before.rows.end = session.rows.end;
                before.last_s = session.last_s;
                before.count += session.count;
            }
            None => all.push(session),
        }
    }
    all
}

impl Late {
    /// Of rows whose clock, if it counts from switching the robot on, had run for long before the
    /// first of them, against how far they reach; or that counts from anything else. Each file has a
    /// clock of its own, unless it goes on where the one before ended.
    #[must_use]
    pub fn of(rows: &[Measurement]) -> Option<Self> {
        let found = sessions(rows).into_iter().find(Session::is_late)?;
        let file = rows[found.rows.start].line.file.as_deref();
        Some(Self {
            first_s: found.first_s,
            length_s: found.length_s(),
            file: file.map(str::to_owned),
        })
    }
}

/// The same rows by clocks that count from the first row where they are late.
#[must_use]
pub fn from_first_row(measurements: &Measurements) -> Measurements {
    let mut other = measurements.clone();
    for session in sessions(&measurements.rows) {
        if !session.is_late() {
            continue;
        }
        for row in &mut other.rows[session.rows] {
            if let Some(time_s) = &mut row.conditions.time_s {
                *time_s -= session.first_s;
            }
        }
    }
    other
}

impl std::fmt::Display for Late {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(
            f,
            "time_s begins at {:.0} s, and the rows take {:.0} s",
            self.first_s, self.length_s
        )?;
        (self.file.as_ref()).map_or(Ok(()), |file| write!(f, " ({file})"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::Arc;

    /// Rows of files by their times, each from, to and how many.
    fn rows(files: &[(f64, f64, usize)]) -> Measurements {
        let header = "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg,x_mm,y_mm,z_mm,time_s\n";
        let mut csv = header.to_owned();
        for (from, to, count) in files {
            for k in 0..*count {
                let time_s = from + (to - from) * k as f64 / (count - 1) as f64;
                csv += &format!("{k},0,0,0,0,0,{k},0,0,{time_s}\n");
            }
        }
        let mut all = Measurements::from_csv(csv.as_bytes()).expect("a table");
        let names = files.iter().enumerate();
        let names = names.flat_map(|(n, (.., count))| std::iter::repeat_n(n, *count));
        for (row, name) in all.rows.iter_mut().zip(names) {
            row.line.file = Some(Arc::from(format!("{name}.csv")));
        }
        all
    }

    #[test]
    fn a_clock_is_late_in_any_file_and_on_either_side_of_zero() {
        for (files, late) in [
            (&[(0.0, 3000.0, 60)][..], None),
            (&[(-40.0, 3000.0, 60)], None),
            (&[(-600.0, 3000.0, 60)], Some("0.csv")),
            (&[(600.0, 3000.0, 60)], Some("0.csv")),
            // switched on anew, or running on
            (&[(0.0, 3000.0, 60), (0.0, 3000.0, 60)], None),
            (&[(0.0, 3000.0, 60), (3600.0, 6000.0, 60)], None),
            (&[(0.0, 3000.0, 60), (36e3, 39e3, 60)], Some("1.csv")),
            (&[(0.0, 3000.0, 60), (900.0, 3900.0, 60)], Some("1.csv")),
        ] {
            let all = rows(files);
            let found = Late::of(&all.rows).and_then(|late| late.file);
            assert_eq!(found.as_deref(), late, "{files:?}");
            assert_eq!(Late::of(&from_first_row(&all).rows), None, "{files:?}");
        }
    }
}

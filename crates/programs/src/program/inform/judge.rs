//! What is said of positions once it is known which of them moves name.

use super::job::{Coordinates, Letter};
use super::reader::Reader;
use super::remarks::Cause;
use crate::program::TargetId;
use crate::program::script::{Place, Remark};
use foldhash::{HashMap, HashMapExt, HashSet};

impl Reader<'_> {
    pub(super) fn say(&mut self, place: Place, remark: Remark) {
        self.builder.script.say(self.sources, place, remark);
    }

    /// The target has to stay as it is; `because` is where the files say so.
    fn refuse(&mut self, target: TargetId, cause: Cause, because: Option<Place>) {
        let place = self.positions.targets[target].place();
        let (id, wrong, hint) = cause.words();
        let see = because.map_or_else(String::new, |because| {
            let source = &self.sources[because.file as usize];
            let (line, _) = source.line_column(because.offset as usize);
            format!(" (see {} line {line})", source.name)
        });
        let target = &mut self.positions.targets[target];
        target.blocked = true;
        let name = target.name.as_deref().unwrap_or("target");
        let message = format!("{name}: {wrong}{see}");
        self.say(place, Remark::error_about(id, message, hint));
    }

    /// Positions that moves name and that cannot be understood, and what each job has of them.
    pub(super) fn judge_positions(&mut self) {
        let differing = self.differing();
        for at in 0..self.positions.jobs.len() {
            let (mut unknown_pulses, mut variables, mut positions) = (None, 0, 0);
            for target in self.positions.jobs[at].targets.clone() {
                let point = self.positions.points[target];
                positions += usize::from(point.letter == Letter::C);
                if !self.named[target] {
                    continue;
                }
                variables += usize::from(point.letter == Letter::P);
                if self.positions.targets[target].numbers.is_empty() {
                    let coordinates = self.positions.header(target).coordinates();
                    if coordinates == Some(Coordinates::Pulses) && !self.positions.pulses_known {
                        unknown_pulses.get_or_insert(target);
                    } else {
                        self.refuse(target, Cause::AxisCount, None);
                    }
                }
                let job = &self.positions.jobs[at];
                if job.twice.contains(&(point.letter, point.number)) {
                    self.refuse(target, Cause::Ambiguous, None);
                } else if point.letter == Letter::P
                    && let Some(&first) = differing.get(&point.number)
                {
                    let because = self.positions.targets[first].place();
                    self.refuse(target, Cause::Ambiguous, Some(because));
                }
            }
            if let Some(target) = unknown_pulses {
                let (id, wrong, hint) = Cause::Pulses.words();
                let place = self.positions.targets[target].place();
                self.say(place, Remark::warning(id, wrong, hint));
            }
            if variables > 0 {
                let message = format!(
                    "moves go to {variables} position variable(s) of this job; other jobs of the \
                     controller may change them"
                );
                let hint = "make sure that only the jobs given here set them";
                let job = &self.positions.jobs[at];
                let place = Place::new(job.file, job.offset);
                self.say(
                    place,
                    Remark::note_about("position-variable", message, hint),
                );
            }
            self.check_count(at, positions);
        }
    }

    /// The first place of each P variable of which the files tell more than one value.
    fn differing(&self) -> HashMap<u32, TargetId> {
        let positions = &self.positions;
        let mut first: HashMap<u32, TargetId> = HashMap::new();
        let mut differing = HashMap::new();
        for (target, point) in positions.points.iter().enumerate() {
            if point.letter != Letter::P {
                continue;
            }
            let known = *first.entry(point.number).or_insert(target);
            let numbers = |target: TargetId| {
                let range = positions.targets[target].numbers.clone();
                let numbers = &positions.numbers[range.start as usize..range.end as usize];
                numbers.iter().map(|number| number.value)
            };
            let same = positions
                .header(known)
                .means_the_same(positions.header(target))
                && numbers(known).eq(numbers(target));
            if !same {
                differing.insert(point.number, known);
            }
        }
        differing
    }

    /// The header announces as many positions as there are; the controller refuses others.
    fn check_count(&mut self, job: usize, count: usize) {
        let job = &self.positions.jobs[job];
        let Some((announced, span)) = job.announced else {
            return;
        };
        if count != announced as usize {
            let place = Place::new(job.file, span.start);
            let message = format!(
                "the header announces {announced} C positions (NPOS), and there are {count}"
            );
            let hint = "is the file complete?";
            self.say(
                place,
                Remark::warning_about("position-count", message, hint),
            );
        }
    }

    /// Jobs that no other calls begin where nobody knows: a pose without its wrist may be reached
    /// in two ways.
    pub(super) fn say_starts(&mut self) {
        for (routine, place) in std::mem::take(&mut self.starts) {
            if self.called.contains(&routine) {
                continue;
            }
            let message = "the job starts with a rectangular position, and RCONF does not tell its \
                wrist: the solution with the \
                           joints nearest to zero is taken";
            let hint = "start with a joint position (PULSE or ANGLE)";
            self.say(place, Remark::warning("wrist-not-told", message, hint));
        }
    }

    /// Values that are computed from positions to which moves go.
    pub(super) fn say_copied(&mut self) {
        let points = self.positions.points.iter().zip(&self.named);
        let named: HashSet<u32> = points
            .filter(|(point, named)| **named && point.letter == Letter::P)
            .map(|(point, _)| point.number)
            .collect();
        for (place, number) in std::mem::take(&mut self.copied) {
            if named.contains(&number) {
                let message = format!(
                    "a position is computed from P{number:03}, which may be compensated for other \
                     moves"
                );
                let hint = "look where the new position is used";
                self.say(place, Remark::warning_about("target-copied", message, hint));
            }
        }
    }
}

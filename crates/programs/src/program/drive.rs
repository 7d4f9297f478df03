//! Programs that drive through configurations, as measuring asks for them.

use crate::geometry::units::DEG;

/// One move in joints.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    /// Number of the configuration, from 1, before its first move.
    pub begins: Option<usize>,
    /// The controller's joints, radians.
    pub q: [f64; 6],
    /// The arm comes slowly and stays, to be measured.
    pub measured: bool,
}

impl Step {
    /// The joints in degrees, as text.
    fn degrees(&self) -> [String; 6] {
        self.q.map(|angle| format!("{:.4}", angle / DEG))
    }
}

/// Adds the moves of a program: a comment where a configuration begins, a move in degrees, slow
/// where the arm is measured, and a pause there.
pub(super) fn add(
    out: &mut String,
    steps: &[Step],
    comment: &str,
    pause: &str,
    go: impl Fn([String; 6], bool) -> String,
) {
    for step in steps {
        if let Some(number) = step.begins {
            *out += &format!("{comment}configuration {number}\n");
        }
        *out += &go(step.degrees(), step.measured);
        if step.measured {
            *out += pause;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::program::{LANGUAGES, Motion, Settings, Source, Value, meaning};

    #[test]
    fn every_language_reads_the_program_that_it_writes() {
        let postures = [
            [0.0, -20.0, 110.0, 0.0, 90.5, -180.25],
            [-0.0625, 1.0, 2.0, -3.0, -45.0, 6.0],
        ];
        let steps: Vec<Step> = (postures.iter().enumerate())
            .flat_map(|(number, q)| {
                let q = q.map(|degrees| degrees * DEG);
                let step = |begins, measured| Step {
                    begins,
                    q,
                    measured,
                };
                [step(Some(number + 1), false), step(None, true)]
            })
            .collect();
        let settings = Settings {
            pulses_per_deg: Some([1000.0; 6]),
            ..Settings::default()
        };
        let mut written = 0;
        for language in LANGUAGES {
            let Some(text) = language.drive(&steps, &settings) else {
                continue;
            };
            written += 1;
            let id = language.about().id;
            let sources = [Source::new("measure", text.clone().into_bytes())];
            assert!(language.recognises(&sources[0]), "{id}: {text}");
            let program = crate::motion::read(*language, &sources, &settings).expect(id);
            assert_eq!(program.moves.len(), steps.len(), "{id}: {text}");
            for (step, motion) in steps.iter().zip(&program.moves) {
                assert_eq!(motion.motion, Motion::Joint, "{id}");
                let target = motion.target.expect(id);
                let value = meaning(*language, &program, &settings, target)
                    .expect(id)
                    .value;
                let Value::Joints(q) = value else {
                    panic!("{id}: a pose");
                };
                let near = |(a, b): (&f64, &f64)| (a - b).abs() < 6e-4 * DEG;
                assert!(q.iter().zip(&step.q).all(near), "{id}: {q:?}");
            }
        }
        // CSV tells no robot what to do
        assert_eq!(written, LANGUAGES.len() - 1);
    }
}

//! What Offs and `RelTool` add to a target.

use super::names::{Context, Meaning};
use super::syntax::{Amount, Part, Step, Stored, indices};
use super::world::World;
use crate::geometry::units::{DEG, m_from_mm};
use crate::geometry::{Pose, add};
use crate::program::{Displacement, Shift};

impl World {
    /// What these steps add; Offs shifts in the work object and `RelTool` in the tool, so their order among each other does not
    /// matter.
    pub fn displacement(&self, steps: Part, context: Context) -> Displacement {
        let steps = &self.notes.steps[indices(steps)];
        let mut frame_mm = [0.0; 3];
        let mut tool: Option<Pose> = None;
        for step in steps {
            match step {
                Step::Offs(amounts) => {
                    let Some(by) = self.amounts(amounts, context) else {
                        return Displacement::Unknown;
                    };
                    frame_mm = add(frame_mm, by);
                }
                Step::RelTool(amounts) => {
                    let Some([x, y, z, rx, ry, rz]) = self.amounts(amounts, context) else {
                        return Displacement::Unknown;
                    };
                    let [x, y, z] = [x, y, z].map(m_from_mm);
                    let by = Pose::from_xyz_rxryrz([x, y, z, rx * DEG, ry * DEG, rz * DEG]);
                    tool = Some(tool.map_or(by, |tool| tool * by));
                }
            }
        }
        let frame = frame_mm.map(m_from_mm);
        if frame == [0.0; 3] && tool.is_none() {
            return Displacement::None;
        }
        let in_tool = tool.unwrap_or_else(Pose::identity);
        Displacement::By(Box::new(Shift {
            in_frame_m: frame,
            in_tool,
        }))
    }

    fn amounts<const N: usize>(&self, amounts: &[Amount; N], context: Context) -> Option<[f64; N]> {
        let mut values = [0.0; N];
        for (value, amount) in values.iter_mut().zip(amounts) {
            *value = match *amount {
                Amount::Number(number) => number,
                Amount::Named(name, sign) => match self.meaning(name, context) {
                    Meaning::One(datum) => match self.datum(datum) {
                        datum if !datum.constant => return None,
                        datum => match datum.value {
                            Stored::Number(number) => sign * number,
                            _ => return None,
                        },
                    },
                    _ => return None,
                },
                Amount::Computed => return None,
            };
        }
        values.iter().all(|v| v.is_finite()).then_some(values)
    }
}

//! Text that never runs: behind `if (1 == 2)`, where `PolyScope` programs keep taught points.

use crate::program::urscript::syntax::Event;

/// The blocks around the present text that never run, from the outermost such `if` on.
#[derive(Default)]
pub(super) struct Dead(u32);

impl Dead {
    /// Whether a statement never runs, or is not more than the bounds of what never does.
    pub(super) fn takes(&mut self, event: &Event) -> bool {
        let dead = &mut self.0;
        match event {
            Event::Never if *dead == 0 => {
                *dead = 1;
                false
            }
            Event::Branch { .. } if *dead == 1 => {
                *dead = 0;
                false
            }
            Event::If | Event::Never | Event::Switch | Event::Loop if *dead > 0 => {
                *dead += 1;
                true
            }
            Event::EndIf | Event::EndLoop { .. } if *dead > 0 => {
                *dead -= 1;
                *dead > 0
            }
            _ => *dead > 0,
        }
    }
}

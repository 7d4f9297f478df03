//! The load that a program says: `WEIGHT`.

use super::reader::Reader;
use super::remarks::LOAD;
use crate::geometry::units::m_from_mm;
use crate::program::Load;
use crate::program::script::{Expr, Held, How, Written};
use crate::program::words::Words;

impl<'a> Reader<'a> {
    /// `WEIGHT mass,x,y,z`, kg and mm: what the flange carries, in its axes; moments of inertia may
    /// follow.
    ///
    /// # Source
    /// Kawasaki AS Language Reference Manual (90209-1022DED): the mass of tool and workpiece
    /// together. *Not verified on a controller*: that the centre counts from the flange.
    pub(super) fn weight(&mut self, words: Words<'a, '_>) {
        let list = words.list();
        let said = list.iter().take(4).filter(|part| !part.is_empty());
        let said: Vec<f64> = said.filter_map(|one| self.quantity(*one).exact()).collect();
        let load = match said[..] {
            [mass_kg, x, y, z] if mass_kg >= 0.0 => {
                let cog_m = [x, y, z].map(m_from_mm);
                self.held_load(Load { mass_kg, cog_m })
            }
            _ => self.unknown(LOAD),
        };
        self.write(Written::One(self.load), How::Whole(load));
    }

    fn held_load(&mut self, load: Load) -> Expr {
        let known = self.loads.iter().find(|(known, _)| *known == load);
        if let Some((_, held)) = known {
            return *held;
        }
        let held = self.builder.script.held(Held::Load(Some(load)));
        self.loads.push((load, held));
        held
    }
}

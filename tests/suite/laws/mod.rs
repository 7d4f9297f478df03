//! What must hold for every input.

mod inverse;
mod offset_wrist;

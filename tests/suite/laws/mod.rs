//! What must hold for every input.

mod every_arm;
mod inverse;
mod offset_wrist;

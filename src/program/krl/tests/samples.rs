//! The sample programs.

//! Numbers that come from elsewhere: each data folder says from where in its ORIGIN.md.

mod catalogue;
mod every_answer;
mod forward;
mod inverse;
mod ur_calibration;

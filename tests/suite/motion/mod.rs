//! What a program makes the robot do: where straight moves end, from which side joints come, which tool holds.

mod krl;
mod rows;
mod straight;

//! The examples run, and judge their own results.

#[path = "../../../examples/calibrate.rs"]
mod calibrate;
#[path = "../../../examples/compensate_program.rs"]
mod compensate_program;
#[path = "../../../examples/diagnose.rs"]
mod diagnose;
#[path = "../../../examples/inverse_of_an_array.rs"]
mod inverse_of_an_array;

#[test]
fn each_example_ends_well() {
    compensate_program::main().expect("compensate_program");
    calibrate::main().expect("calibrate");
    diagnose::main().expect("diagnose");
    inverse_of_an_array::main().expect("inverse_of_an_array");
}

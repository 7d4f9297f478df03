//! What functions of the language do, by their names.

use super::syntax::Oddity;
use crate::program::Motion;

/// What a call does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verb {
    /// `movej`, `movel`, `movep`
    Move(Motion),
    /// `movec`
    Arc,
    /// Set points at a high rate.
    Stream,
    /// `set_tcp`
    Tool,
    /// `set_payload`
    Load,
    /// Moves in another way.
    Odd(Oddity),
    /// Of the language, and of no matter here.
    Known,
    /// A function of the file, or any other of the language.
    Other,
}

/// Calls that give poses or joints.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PoseCall {
    Trans,
    Add,
    Inverse,
    Kinematics,
}

/// What a function of this name does.
pub fn verb(name: &[u8]) -> Verb {
    match name {
        b"movej" | b"optimovej" => Verb::Move(Motion::Joint),
        b"movel" | b"movep" | b"optimovel" | b"mc_add_linear" => Verb::Move(Motion::Linear),
        b"movec" | b"mc_add_circular" => Verb::Arc,
        b"servoj" | b"servoc" | b"servop" | b"servol" | b"moves" => Verb::Stream,
        b"set_tcp" => Verb::Tool,
        b"set_payload" | b"set_target_payload" | b"set_payload_mass" | b"set_payload_cog" => {
            Verb::Load
        }
        b"speedj"
        | b"speedl"
        | b"force_mode"
        | b"freedrive_mode"
        | b"teach_mode"
        | b"screw_driving"
        | b"move_until_contact" => Verb::Odd(Oddity::NoTarget),
        b"track_conveyor_linear"
        | b"track_conveyor_circular"
        | b"path_offset_enable"
        | b"path_offset_set"
        | b"mc_set_pcs"
        | b"set_conveyor_tick_count" => Verb::Odd(Oddity::MovingFrame),
        b"textmsg"
        | b"sleep"
        | b"sync"
        | b"popup"
        | b"set_digital_out"
        | b"set_standard_digital_out"
        | b"set_gravity"
        | b"stopj"
        | b"stopl"
        | b"pose_trans" => Verb::Known,
        _ => Verb::Other,
    }
}

/// Calls whose values are looked into.
pub fn value_of(name: &[u8]) -> Option<PoseCall> {
    match name {
        b"pose_trans" => Some(PoseCall::Trans),
        b"pose_add" => Some(PoseCall::Add),
        b"pose_inv" => Some(PoseCall::Inverse),
        b"get_inverse_kin" => Some(PoseCall::Kinematics),
        _ => None,
    }
}

/// Words before brackets that are no calls.
pub fn is_operator(name: &[u8]) -> bool {
    matches!(
        name,
        b"and"
            | b"or"
            | b"xor"
            | b"not"
            | b"if"
            | b"elif"
            | b"while"
            | b"return"
            | b"run"
            | b"switch"
            | b"case"
            | b"True"
            | b"False"
    )
}

/// Words that start a statement wherever they stand outside brackets.
pub fn starts_statement(name: &[u8]) -> bool {
    starts_block(name)
        || matches!(
            name,
            b"elif"
                | b"else"
                | b"end"
                | b"break"
                | b"continue"
                | b"return"
                | b"halt"
                | b"global"
                | b"local"
        )
}

/// Words that open a block, which none of the language's expressions holds.
pub fn starts_block(name: &[u8]) -> bool {
    matches!(name, b"def" | b"thread" | b"if" | b"while")
}

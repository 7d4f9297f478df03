//! What functions of the language do, by their names.
//!
//! # Source
//! Universal Robots, "The `URScript` Programming Language", the chapters on its modules (motion,
//! internals, urmath, interfaces, dynamic force control, process path).

use crate::program::Motion;

/// What a call does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Verb {
    /// `movej`, `movel`, `movep`
    Move(Motion, Places),
    /// `movec`
    Arc(Places),
    /// Set points at a high rate.
    Stream,
    /// By speed or by hand: there is no target.
    Somewhere,
    /// The robot gives way to forces.
    Force,
    /// Moves go along a frame that moves, or offset from the path; or no longer.
    Tracking(bool),
    /// `set_tcp`
    Tool,
    /// `set_payload`
    Load(LoadParts),
    /// `set_gravity`
    Gravity,
    /// Of the language, and of no matter here.
    Known,
    /// A function of the file, or one that is not known.
    Other,
}

/// What a call that sets the load is given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum LoadParts {
    Both,
    Mass,
    Cog,
}

/// Places of speed, blend radius and time among the arguments of a move.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Places {
    pub speed: Option<usize>,
    pub radius: Option<usize>,
    pub time: Option<usize>,
}

impl Places {
    pub(super) const NONE: Self = Self {
        speed: None,
        radius: None,
        time: None,
    };
    // the speed is that of a joint
    const JOINT: Self = Self {
        speed: None,
        radius: Some(4),
        time: Some(3),
    };
    const LINE: Self = Self {
        speed: Some(2),
        radius: Some(4),
        time: Some(3),
    };
    const PROCESS: Self = Self {
        speed: Some(2),
        radius: Some(3),
        time: None,
    };
    const ARC: Self = Self {
        speed: Some(3),
        radius: Some(4),
        time: None,
    };
}

/// Calls that give poses or joints.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum PoseCall {
    Trans,
    Add,
    Inverse,
    Kinematics,
    Actual { is_pose: bool },
}

/// What a function of this name does.
pub(super) fn verb(name: &[u8]) -> Verb {
    match name {
        b"movej" => Verb::Move(Motion::Joint, Places::JOINT),
        b"movel" => Verb::Move(Motion::Linear, Places::LINE),
        b"movep" => Verb::Move(Motion::Linear, Places::PROCESS),
        b"movec" => Verb::Arc(Places::ARC),
        b"optimovej" => Verb::Move(Motion::Joint, Places::NONE),
        b"optimovel" | b"mc_add_linear" => Verb::Move(Motion::Linear, Places::NONE),
        b"mc_add_circular" => Verb::Arc(Places::NONE),
        b"servoj" | b"servoc" | b"servop" | b"servol" | b"moves" => Verb::Stream,
        b"set_tcp" => Verb::Tool,
        b"set_payload" | b"set_target_payload" => Verb::Load(LoadParts::Both),
        b"set_payload_mass" => Verb::Load(LoadParts::Mass),
        b"set_payload_cog" => Verb::Load(LoadParts::Cog),
        b"set_gravity" => Verb::Gravity,
        b"force_mode" => Verb::Force,
        // what force has moved stands elsewhere
        b"end_force_mode"
        | b"speedj"
        | b"speedl"
        | b"freedrive_mode"
        | b"teach_mode"
        | b"screw_driving"
        | b"move_until_contact"
        | b"direct_torque"
        | b"torque_command"
        | b"jog" => Verb::Somewhere,
        b"track_conveyor_linear"
        | b"track_conveyor_circular"
        | b"path_offset_enable"
        | b"mc_set_pcs" => Verb::Tracking(true),
        b"stop_conveyor_tracking" | b"path_offset_disable" | b"mc_initialize" => {
            Verb::Tracking(false)
        }
        b"textmsg"
        | b"sleep"
        | b"sync"
        | b"popup"
        | b"set_digital_out"
        | b"set_standard_digital_out"
        | b"stopj"
        | b"stopl"
        | b"pose_trans" => Verb::Known,
        _ => Verb::Other,
    }
}

/// Whether a function that the file does not define is one of the language that takes the robot
/// nowhere and sets no tool.
pub(super) fn is_of_language(name: &[u8]) -> bool {
    let is_known = KNOWN.split(' ').any(|known| known.as_bytes() == name);
    is_known
        || FAMILIES
            .split(' ')
            .any(|family| name.starts_with(family.as_bytes()))
}

/// Beginnings of names of which there are many: inputs, outputs, registers, sockets, states.
const FAMILIES: &str = "\
    get_actual_ get_analog_ get_configurable_ get_digital_ get_euromap_ get_flag get_standard_ \
        get_target_ get_tool_ modbus_ \
    read_input_ read_output_ read_port_ rtde_ set_analog_ set_configurable_ set_digital_ \
        set_euromap_ set_flag set_runstate_ \
    set_standard_ set_tool_ socket_ write_";

/// Other functions of the language.
const KNOWN: &str = "\
    abs acos asin assert atan atan2 binary_list_to_integer bool ceil clear_teach_axes \
        conveyor_pulse_decode cos \
    cross d2r dot enable_external_ft_sensor encoder_enable_pulse_decode \
        encoder_enable_set_tick_count \
    encoder_get_tick_count encoder_set_tick_count encoder_unwind_delta_tick_count \
    end_freedrive_mode end_screw_driving end_teach_mode enter_critical exit_critical float floor \
        force \
    force_mode_set_damping force_mode_set_gain_scaling ft_rtde_input_enable get_base_acceleration \
    get_controller_temp get_conveyor_tick_count get_coriolis_and_centrifugal_torques \
        get_forward_kin \
    get_freedrive_status get_gravity get_inverse_kin get_inverse_kin_has_solution get_jacobian \
    get_jacobian_time_derivative get_joint_temp get_joint_torques get_list_length get_mass_matrix \
    get_path_statistics get_payload get_payload_cog get_payload_inertia get_payload_mass \
        get_robot_id get_sim_mode \
    get_steptime get_tcp_force get_tcp_offset get_tcp_speed get_vibration_damping halt \
        high_holding_torque_disable \
    high_holding_torque_enable int integer_to_binary_list interpolate_pose inv is_steady \
        is_within_safety_limits \
    join kill length log low_holding_torque_disable low_holding_torque_enable make_list max \
    mc_get_target_rtcp_speed mc_run_motion mc_set_speed_factor min modf norm normalize open_popup \
        path_offset_get \
    path_offset_set path_offset_set_alpha_filter path_offset_set_max_offset point_dist popup \
        pose_add pose_dist \
    pose_inv pose_sub pose_trans position_deviation_warning pow powerdown protective_stop r2d \
        random \
    request_boolean_from_primary_client request_float_from_primary_client \
        request_integer_from_primary_client \
    request_string_from_primary_client reset_revolution_counter reset_world_model rotvec2rpy round \
        rpc_factory \
    rpy2rotvec set_base_acceleration set_conveyor_tick_count set_gravity \
        set_input_actions_to_default \
    set_max_joint_speed set_max_payload set_safety_mode_transition_hardness set_vibration_damping \
        set_watchdog \
    sign sin size sleep sqrt stopj stopl str str_at str_cat str_empty str_find str_len str_sub struct \
        sync tan textmsg \
    time time_get_raw to_num to_str tool_contact tool_contact_examples tool_wrench_limit_disable \
    tool_wrench_limit_set transpose unlock_protective_stop varmsg wrench_trans xmlrpc \
        zero_ftsensor zero_wrench";

/// Calls whose values are looked into.
pub(super) fn value_of(name: &[u8]) -> Option<PoseCall> {
    match name {
        b"pose_trans" => Some(PoseCall::Trans),
        b"pose_add" => Some(PoseCall::Add),
        b"pose_inv" => Some(PoseCall::Inverse),
        b"get_inverse_kin" => Some(PoseCall::Kinematics),
        b"get_actual_tcp_pose" | b"get_target_tcp_pose" | b"get_forward_kin" => {
            Some(PoseCall::Actual { is_pose: true })
        }
        b"get_actual_joint_positions" | b"get_target_joint_positions" => {
            Some(PoseCall::Actual { is_pose: false })
        }
        _ => None,
    }
}

/// Words behind which a condition is read only where it is still open.
pub(super) fn may_pass(name: &[u8]) -> bool {
    matches!(name, b"and" | b"or")
}

/// Words before brackets that are no calls.
pub(super) fn is_operator(name: &[u8]) -> bool {
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
pub(super) fn starts_statement(name: &[u8]) -> bool {
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

/// Words of numbers that the text tells, such as `pi/2` and `d2r(90)`.
pub(super) fn is_constant(name: &[u8]) -> bool {
    matches!(
        name,
        b"pi"
            | b"d2r"
            | b"r2d"
            | b"sqrt"
            | b"pow"
            | b"sin"
            | b"cos"
            | b"tan"
            | b"asin"
            | b"acos"
            | b"atan"
            | b"atan2"
    )
}

/// Words that open a block, which none of the language's expressions holds.
pub(super) fn starts_block(name: &[u8]) -> bool {
    matches!(name, b"def" | b"thread" | b"if" | b"while")
}

//! The controller's own effects, and what import writes.

use super::universal_robots::{UrError, link_geometry};
use super::*;
use crate::model::RowsError;

const UR5: &str = include_str!("../../../robots/universal_robots_ur5.yaml");
const CONF: &str = include_str!("../../../tests/data/ur_calibration/ur5_usual.calibration.conf");

fn ur5(controller: &str, calibration: &str) -> Result<Profile, ProfileError> {
    let text = UR5.replace("{language: urscript, model: nominal}", controller);
    let start = text.find("calibration:\n").expect("the last block");
    Profile::from_yaml(&(text[..start].to_owned() + calibration))
}

const ONE: &str = "{effect: link_geometry, link: 3, a_mm: 0.5}";
const OTHER: &str = "{effect: link_geometry, link: 4, a_mm: 0.25}";

#[test]
fn a_calibrated_controller_has_its_own_effects_or_the_geometry_of_the_calibration() {
    let spring = "{effect: joint_compliance, joint: 2, rad_per_n_m: 1.0e-6}";
    let calibration = format!("calibration: {{effects: [{ONE}, {spring}]}}\n");
    let labels =
        |effects: Vec<Effect>| -> Vec<String> { effects.iter().map(Effect::label).collect() };
    for (controller, computes) in [
        ("{model: nominal}".to_owned(), vec![]),
        (
            "{model: calibrated}".to_owned(),
            vec!["link_geometry link 3"],
        ),
        (
            format!("{{model: calibrated, effects: [{OTHER}]}}"),
            vec!["link_geometry link 4"],
        ),
        ("{model: calibrated, effects: []}".to_owned(), vec![]),
    ] {
        let profile = ur5(&controller, &calibration).expect(&controller);
        assert_eq!(
            labels(profile.controller_effects()),
            computes,
            "{controller}"
        );
        assert_eq!(profile.real_effects(), profile.effects, "{controller}");
    }
    // nothing was identified: the arm is as the controller computes it
    let profile = ur5(
        &format!("{{model: calibrated, effects: [{OTHER}]}}"),
        "calibration: {}\n",
    );
    assert_eq!(
        labels(profile.expect("valid").real_effects()),
        ["link_geometry link 4"]
    );
}

#[test]
fn effects_that_no_controller_has_are_faults_with_their_place() {
    let backlash = "{effect: backlash, joint: 1, width_deg: 0.01}";
    for (controller, wanted) in [
        (
            format!("{{model: nominal, effects: [{ONE}]}}"),
            "computes with the nominal chain",
        ),
        (
            format!("{{model: calibrated, effects: [{backlash}]}}"),
            "cannot be part",
        ),
        (
            format!("{{model: calibrated, effects: [{ONE}, {ONE}]}}"),
            "stands twice",
        ),
    ] {
        let error = ur5(&controller, "calibration: {}\n").expect_err(&controller);
        assert!(error.to_string().contains(wanted), "{error}");
        assert!(!error.hint().is_empty() && error.line > 10, "{error:?}");
    }
}

#[test]
fn the_controller_of_a_text_is_replaced_and_nothing_else() {
    let profile = Profile::from_yaml(UR5).expect("a shipped profile");
    let effects = link_geometry(CONF, &profile).expect("a calibration");
    let block = UR5.replace(
        "controller: {language: urscript, model: nominal}",
        "controller:   # of the cell\n  language: urscript\n\n  # still\n  model: nominal\n\n# the \
         arm",
    );
    let crlf = UR5.replace('\n', "\r\n");
    for text in [UR5, &block, &crlf] {
        let written = with_controller(text, &profile, &effects, "note").expect("a block");
        let read = Profile::from_yaml(&written).expect("a profile");
        assert_eq!(read.own_effects.map(|own| own.len()), Some(6));
        let (start, end) = (
            text.find("controller:").expect("a key"),
            text.find("kinematics:").expect("a key"),
        );
        assert!(written.starts_with(&text[..start]) && written.ends_with(&text[end..]));
        assert_eq!(written.contains("\r\n"), text.contains("\r\n"));
        assert_eq!(written.matches('\n').count(), written.lines().count());
        assert!(text.contains("# the arm") == written.contains("# the arm"));
    }
    // one long line has no block
    let flow = "{poseshift: profile/1}";
    assert_eq!(with_controller(flow, &profile, &effects, "note"), None);
}

#[test]
fn what_is_no_calibration_of_this_arm_is_reported() {
    let profile = Profile::from_yaml(UR5).expect("a shipped profile");
    let refusal = |text: &str| link_geometry(text, &profile).expect_err(text);
    assert_eq!(refusal("a: 1"), UrError::Unknown);
    let without = CONF.replace("delta_d ", "delta_x ");
    assert_eq!(refusal(&without), UrError::Missing { key: "delta_d" });
    let twice = format!("{CONF}delta_a = [0, 0, 0, 0, 0, 0]\n");
    assert!(matches!(
        refusal(&twice),
        UrError::Twice {
            key: "delta_a",
            line: 8
        }
    ));
    let five = CONF.replacen(", 0]", "]", 1);
    assert!(matches!(
        refusal(&five),
        UrError::NotSix {
            key: "delta_a",
            line: 3
        }
    ));
    let wild = CONF.replacen(", 0]", ", 1e999]", 1);
    assert!(matches!(
        refusal(&wild),
        UrError::NotSix {
            key: "delta_a",
            line: 3
        }
    ));
    let off = CONF.replace("calibration_status = 2", "calibration_status = 0");
    assert!(matches!(refusal(&off), UrError::NotCalibrated { line: 7 }));
    let moved = CONF.replacen(", 0]", ", 0.001]", 1);
    assert!(matches!(
        refusal(&moved),
        UrError::Rows(RowsError::Flange { .. })
    ));
    let far = CONF.replace("439.846", "439.946");
    assert!(matches!(
        refusal(&far),
        UrError::Rows(RowsError::TooDifferent { .. })
    ));
    assert!(matches!(
        refusal("kinematics:\n  shoulder: {x: 0}\n"),
        UrError::Yaml { line: 2, .. }
    ));
    let other = Profile::from_yaml(include_str!("../../../robots/abb_irb120.yaml"));
    let error = link_geometry(CONF, &other.expect("a shipped profile")).expect_err("an ABB");
    assert!(matches!(error, UrError::NotTheTable { .. }), "{error}");
}

#[test]
fn an_effect_beyond_the_usual_says_that_it_is_meant_and_why() {
    let with = |entry: &str| {
        ur5(
            "{model: nominal}",
            &format!("calibration:\n  effects:\n    - {entry}\n"),
        )
    };
    for (entry, key) in [
        (
            "{effect: link_geometry, link: 3, theta_deg: 2.1}",
            "theta_deg",
        ),
        ("{effect: link_geometry, link: 3, a_mm: -20.5}", "a_mm"),
        (
            "{effect: joint_compliance, joint: 2, rad_per_n_m: 5e-3}",
            "rad_per_n_m",
        ),
        ("{effect: base_frame, x_mm: 75}", "x_mm"),
        ("{effect: backlash, joint: 2, width_deg: 3}", "width_deg"),
        ("{effect: payload_error, mass_kg: -3001}", "mass_kg"),
        ("{effect: thermal_growth, per_k: 1.1e-4}", "per_k"),
        ("{effect: settling, joint: 2, share: -1.1}", "share"),
        ("{effect: joint_scale, joint: 2, ratio: 0.006}", "ratio"),
        (
            "{effect: joint_coupling, joint: 2, on: 3, ratio: -0.006}",
            "ratio",
        ),
        (
            "{effect: warm_up_drift, x_mm: 1, time_constant_s: 2e7}",
            "time_constant_s",
        ),
    ] {
        let error = with(entry).expect_err(entry);
        assert!(
            matches!(&error.fault, Fault::Large { key: of, .. } if *of == key),
            "{error}"
        );
        assert!(
            error.line > 0 && error.hint().contains("large: true"),
            "{error}"
        );
        let said = error.to_string();
        assert!(
            key != "ratio" || said.ends_with("6; more than 0.005556 is no error of an arm"),
            "{said}"
        );
        let meant = entry.replace('}', ", large: true, reason: \"measured\"}");
        let profile = with(&meant).expect(&meant);
        assert_eq!(
            profile.large.calibration.values().collect::<Vec<_>>(),
            ["measured"]
        );
        // both stay when the profile is written again
        let text = ur5_text(&format!("calibration:\n  effects:\n    - {meant}\n"));
        let again = rewritten(&text, &profile).expect("a plain layout");
        assert!(
            again.contains("large: true, reason: \"measured\"}"),
            "{again}"
        );
        assert_eq!(
            Profile::from_yaml(&again).expect("read back").large,
            profile.large
        );
    }
    for entry in [
        "{effect: base_frame, x_mm: 75, large: true}",
        "{effect: base_frame, x_mm: 75, large: true, reason: \" \"}",
        "{effect: base_frame, x_mm: 75, large: 1, reason: a}",
        "{effect: base_frame, x_mm: 1, reason: a}",
    ] {
        let error = with(entry).expect_err(entry);
        assert!(
            matches!(error.fault, Fault::LargeWithoutReason { .. }),
            "{error}"
        );
    }
    for entry in [
        "{effect: link_geometry, link: 3, theta_deg: 2, a_mm: 20}",
        "{effect: joint_compliance, joint: 2, rad_per_n_m: 4.9e-3}",
        "{effect: payload_error, mass_kg: 1, cog_x_mm: 50}",
        "{effect: base_frame, x_mm: 1, large: false}",
        "{effect: joint_scale, joint: 2, ratio: 0.005}",
        "{effect: settling, joint: 2, share: 1}",
        "{effect: warm_up_drift, x_mm: 1, time_constant_s: 1800}",
    ] {
        assert!(with(entry).is_ok(), "{entry}: {:?}", with(entry));
    }
    assert!(with("{effect: base_frame, x_mm: .inf}").is_err());
    for time in ["0", "-1800"] {
        let entry = format!("{{effect: warm_up_drift, x_mm: 1, time_constant_s: {time}}}");
        let error = with(&entry).expect_err(&entry).to_string();
        assert!(error.contains("above 0 in s"), "{error}");
    }
    let schema = Profile::schema().to_string();
    assert!(schema.contains("\"reason\"") && schema.contains("\"payload_kg\""));
}

fn ur5_text(calibration: &str) -> String {
    let start = UR5.find("calibration:\n").expect("the last block");
    UR5[..start].to_owned() + calibration
}

#[test]
fn tools_and_frames_in_other_units_are_faults_with_their_place() {
    let tools = |tool: &str| {
        let start = UR5.find("calibration:\n").expect("the last block");
        let text = UR5[..start].replace("tools: {}\n", "");
        let text = text.replace("robot: {", "robot: {payload_kg: 5, ");
        Profile::from_yaml(&format!("{text}tools:\n  t: {tool}\n"))
    };
    let frame = |z: &str, rz: &str| {
        format!("{{frame: {{x_mm: 0, y_mm: 0, z_mm: {z}, rx_deg: 0, ry_deg: 0, rz_deg: {rz}}}")
    };
    for good in [
        frame("0", "0") + "}",
        frame("1.5", "-360") + ", mass_kg: 5}",
    ] {
        assert!(tools(&good).is_ok(), "{good}: {:?}", tools(&good));
    }
    let fault = |tool: String| tools(&tool).expect_err(&tool).fault;
    assert!(matches!(
        fault(frame("0.1", "0") + "}"),
        Fault::TinyTool { .. }
    ));
    assert!(matches!(
        fault(frame("100", "721") + "}"),
        Fault::EndlessAngle { .. }
    ));
    let twice = frame("100", "0") + "}\n  T: " + &frame("90", "0") + "}";
    assert!(matches!(fault(twice), Fault::SameTool { .. }));
    let heavy = frame("100", "0") + ", mass_kg: 5.1}";
    assert!(matches!(fault(heavy), Fault::BeyondPayload { .. }));
}

#[test]
fn an_effect_that_makes_a_load_heavier_than_the_payload_says_that_it_is_meant() {
    let tool =
        "{frame: {x_mm: 0, y_mm: 0, z_mm: 100, rx_deg: 0, ry_deg: 0, rz_deg: 0}, mass_kg: 2.5}";
    let with = |entry: &str| {
        let text = ur5_text(&format!("calibration:\n  effects:\n    - {entry}\n"));
        let text = text.replace("robot: {", "robot: {payload_kg: 5, ");
        let text = text.replace("tools: {}", &format!("tools:\n  gun: {tool}"));
        (Profile::from_yaml(&text), text)
    };
    for (entry, load) in [
        ("{effect: payload_error, tool: gun, mass_kg: 2.6}", 5.1),
        ("{effect: payload_error, tool: other, mass_kg: 140}", 140.0),
        ("{effect: payload_error, mass_kg: 3}", 5.5),
    ] {
        let (read, text) = with(entry);
        let error = read.expect_err(entry);
        assert!(
            matches!(error.fault, Fault::LoadBeyondPayload { found, payload: 5.0, .. } if found == load),
            "{error}"
        );
        let line = text.lines().position(|line| line.contains(entry));
        assert_eq!(Some(error.line - 1), line, "{error}");
        // one that was identified is written so that it can be read
        let meant = entry.replace('}', ", large: true, reason: \"weighed\"}");
        let (read, text) = with(&meant);
        let mut profile = read.expect("meant");
        profile.large = Reasons::default();
        let again = rewritten(&text, &profile).expect("written");
        assert!(again.contains("identified from measurements"), "{again}");
    }
    for entry in [
        "{effect: payload_error, tool: gun, mass_kg: 2.5}",
        "{effect: payload_error, tool: other, mass_kg: 4}",
        "{effect: payload_error, mass_kg: -9}",
    ] {
        let (read, _) = with(entry);
        assert!(read.is_ok(), "{entry}: {read:?}");
    }
}

#[test]
fn masses_and_centres_of_gravity_that_no_link_has_are_faults() {
    let with = |mass: &str, cog: &str| {
        let at = UR5.find("bodies:").expect("bodies");
        let end = at + UR5[at..].find("gravity").expect("gravity");
        let bodies = format!("bodies:\n  - {{link: 2, mass_kg: {mass}, cog_mm: [{cog}, 0, 0]}}\n");
        Profile::from_yaml(&(UR5[..at].to_owned() + &bodies + &UR5[end..]))
    };
    assert!(with("400", "900").is_ok(), "{:?}", with("400", "900"));
    for (mass, cog, key) in [
        ("-1", "900", "mass_kg"),
        ("1e5", "900", "mass_kg"),
        ("400", "-1.1e6", "cog_mm"),
        ("400", "3000", "cog_mm"),
    ] {
        let error = with(mass, cog).expect_err(key);
        assert!(
            matches!(error.fault, Fault::OutOfRange { key: of, .. } if of == key),
            "{error}"
        );
        assert!(error.line > 0 && !error.hint().is_empty(), "{error}");
    }
}

#[test]
fn numbers_of_the_chain_in_other_units_are_faults() {
    let changed = |old: &str, new: &str| {
        assert!(UR5.contains(old), "{old}");
        Profile::from_yaml(&UR5.replacen(old, new, 1))
    };
    let gravity = "gravity_m_s2: [0, 0, -9.81]";
    for good in [
        "[0, 0, 9.81]",
        "[9.81, 0, 0]",
        "[0, 6.94, -6.94]",
        "[0, 0, 0]",
    ] {
        let profile = changed(gravity, &format!("gravity_m_s2: {good}"));
        assert!(profile.is_ok(), "{good}: {profile:?}");
    }
    for bad in ["[0, 0, -1]", "[0, 0, -9810]", "[0, 9.81, -9.81]"] {
        let error = changed(gravity, &format!("gravity_m_s2: {bad}")).expect_err(bad);
        assert!(
            matches!(error.fault, Fault::Gravity { .. }),
            "{bad}: {error}"
        );
        assert!(error.line > 0 && error.hint().contains("m/s²"), "{bad}");
    }
    for (old, new, wanted) in [
        ("theta_deg: 0", "theta_deg: 1e12", "theta_deg"),
        ("alpha_deg: 90", "alpha_deg: 9e5", "alpha_deg"),
        ("d_mm: 0", "d_mm: 1e300", "d_mm"),
        ("base: {x_mm: 0", "base: {x_mm: 1e308", "x_mm"),
        ("radius: 78", "radius: 1e308", "radius"),
        ("from: [0,", "from: [1e308,", "from"),
        (
            "model: nominal",
            "model: nominal, pulses_per_deg: [1e308, 1, 1, 1, 1, 1]",
            "pulses_per_deg",
        ),
    ] {
        let error = changed(old, new).expect_err(new);
        assert!(
            matches!(error.fault, Fault::OutOfRange { key, .. } if key == wanted),
            "{new}: {error}"
        );
    }
    let limits = changed("max_deg: 360", "max_deg: 9190").expect_err("limits");
    assert!(matches!(
        limits.fault,
        Fault::OutOfRange { key: "max_deg", .. }
    ));
    assert!(limits.hint().contains("degrees"));
    let tools = |tool: &str| changed("tools: {}\n", &format!("tools:\n  t: {tool}\n"));
    let frame = |z: &str| {
        format!("{{frame: {{x_mm: 0, y_mm: 0, z_mm: {z}, rx_deg: 0, ry_deg: 0, rz_deg: 0}}")
    };
    let far = tools(&(frame("1e9") + "}")).expect_err("far").fault;
    assert!(matches!(far, Fault::OutOfRange { key: "z_mm", .. }));
    let metres = frame("100") + ", mass_kg: 2, cog_mm: [0, 0, 0.08]}";
    let metres = tools(&metres).expect_err("metres").fault;
    assert!(matches!(metres, Fault::TinyCog { .. }));
    let none = frame("100") + ", mass_kg: 2, cog_mm: [0, 0, 0]}";
    assert!(tools(&none).is_ok());
}

#[test]
fn an_arm_in_metres_is_refused() {
    let mut text = include_str!("../../../robots/abb_irb120.yaml").to_owned();
    for (mm, metres) in [
        ("d_mm: 290", "d_mm: 0.29"),
        ("a_mm: 270", "a_mm: 0.27"),
        ("a_mm: 70", "a_mm: 0.07"),
        ("d_mm: 302", "d_mm: 0.302"),
        ("d_mm: 72", "d_mm: 0.072"),
    ] {
        assert!(text.contains(mm), "{mm}");
        text = text.replace(mm, metres);
    }
    let error = Profile::from_yaml(&text).expect_err("a millimetre of an arm");
    assert!(matches!(error.fault, Fault::TinyArm { .. }), "{error}");
    assert!(error.to_string().contains("1.004 mm"), "{error}");
}

/// Universal Robots, "DH parameters for calculations of kinematics and dynamics": a of rows 2 and
/// 3, d of rows 1, 4, 5 and 6, metres.
const TABLES: [(&str, [f64; 2], [f64; 4]); 9] = [
    (
        "universal_robots_ur3",
        [-0.24365, -0.21325],
        [0.1519, 0.11235, 0.08535, 0.0819],
    ),
    (
        "universal_robots_ur5",
        [-0.425, -0.39225],
        [0.089_159, 0.10915, 0.09465, 0.0823],
    ),
    (
        "universal_robots_ur10",
        [-0.612, -0.5723],
        [0.1273, 0.163_941, 0.1157, 0.0922],
    ),
    (
        "universal_robots_ur3e",
        [-0.24355, -0.2132],
        [0.15185, 0.13105, 0.08535, 0.0921],
    ),
    (
        "universal_robots_ur5e",
        [-0.425, -0.3922],
        [0.1625, 0.1333, 0.0997, 0.0996],
    ),
    (
        "universal_robots_ur10e",
        [-0.6127, -0.57155],
        [0.1807, 0.17415, 0.11985, 0.11655],
    ),
    (
        "universal_robots_ur16e",
        [-0.4784, -0.36],
        [0.1807, 0.17415, 0.11985, 0.11655],
    ),
    (
        "universal_robots_ur20",
        [-0.862, -0.7287],
        [0.2363, 0.201, 0.1593, 0.1543],
    ),
    (
        "universal_robots_ur30",
        [-0.637, -0.5037],
        [0.2363, 0.201, 0.1593, 0.1543],
    ),
];
/// Differences of an arm that is made up: theta, a, d, alpha.
const DELTAS: [[f64; 6]; 4] = [
    [1.1e-3, -0.9e-3, 1.4e-3, 2.2e-3, -2.1e-3, 0.7e-3],
    [2.1e-4, -3.3e-4, 1.9e-4, -0.8e-4, 2.6e-4, 0.0],
    [-1.7e-4, 0.8e-4, -2.4e-4, 1.2e-4, 2.2e-4, -3.1e-4],
    [0.9e-3, -1.2e-3, 0.6e-3, -0.4e-3, 1.5e-3, 0.0],
];

/// Rows of a homogeneous matrix, `Rz(theta) Tz(d) Tx(a) Rx(alpha)` multiplied out.
fn maker_s_step([theta, d, a, alpha]: [f64; 4]) -> [[f64; 4]; 3] {
    let ((st, ct), (sa, ca)) = (theta.sin_cos(), alpha.sin_cos());
    [
        [ct, -st * ca, st * sa, a * ct],
        [st, ct * ca, -ct * sa, a * st],
        [0.0, sa, ca, d],
    ]
}

fn product(a: [[f64; 4]; 3], b: [[f64; 4]; 3]) -> [[f64; 4]; 3] {
    std::array::from_fn(|i| {
        std::array::from_fn(|j| {
            let own = if j == 3 { a[i][3] } else { 0.0 };
            (0..3).map(|k| a[i][k] * b[k][j]).sum::<f64>() + own
        })
    })
}

#[test]
fn every_built_in_arm_of_universal_robots_takes_its_factory_calibration() {
    let quarter = std::f64::consts::FRAC_PI_2;
    let names = ["delta_theta", "delta_a", "delta_d", "delta_alpha"];
    for (name, [a2, a3], [d1, d4, d5, d6]) in TABLES {
        let built_in = catalogue().into_iter().find(|arm| arm.name == name);
        let nominal = match (built_in, name) {
            (Some(arm), _) => Profile::from_yaml(&arm.text()).expect(name),
            (None, "universal_robots_ur5") => Profile::from_yaml(UR5).expect(name),
            (None, _) => {
                let ur10 = include_str!("../../../robots/universal_robots_ur10.yaml");
                Profile::from_yaml(ur10).expect(name)
            }
        };
        for is_far in [false, true] {
            let mut deltas = DELTAS;
            if is_far {
                // along axes that are exactly parallel lengths that cancel say nothing
                deltas[2][1..4].copy_from_slice(&[412.123, -398.7, -13.4229]);
                deltas[3][1..3].fill(0.0);
            }
            let mut conf = String::from("[mounting]\n");
            for (key, list) in names.iter().zip(deltas) {
                conf += &format!("{key} = {list:?}\n");
            }
            conf += "calibration_status = 2\n";
            let effects = link_geometry(&conf, &nominal).expect(name);
            let profile = Profile {
                controller: ControllerModel::Calibrated,
                own_effects: Some(effects),
                ..nominal.clone()
            };
            let controller = profile.controller_model(&Mounted::flange());
            let table = [
                [d1, 0.0, quarter],
                [0.0, a2, 0.0],
                [0.0, a3, 0.0],
                [d4, 0.0, quarter],
                [d5, 0.0, -quarter],
                [d6, 0.0, 0.0],
            ];
            for k in 0..50 {
                let q: [f64; 6] =
                    std::array::from_fn(|i| 2.6 * (f64::from(k) * (i as f64 + 1.3) + 0.4).sin());
                let steps = (0..6).map(|i| {
                    let [d, a, alpha] = table[i];
                    let [dt, da, dd, dalpha] = deltas.map(|list| list[i]);
                    maker_s_step([q[i] + dt, d + dd, a + da, alpha + dalpha])
                });
                let there = steps.reduce(product).expect("six");
                let found = controller.forward(&q, &Conditions::default());
                for i in 0..3 {
                    let off = found.translation[i] - there[i][3];
                    // lengths of the catalogue are rounded to 1e-10 m
                    assert!(off.abs() < 5e-10, "{name} {q:?}: {off}");
                    for j in 0..3 {
                        let off = found.rotation.0[i][j] - there[i][j];
                        assert!(off.abs() < 1e-10, "{name} {q:?}: {off}");
                    }
                }
            }
        }
    }
}

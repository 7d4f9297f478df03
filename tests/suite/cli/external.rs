//! `profile add-track`, `add-positioner`, `import-moc`, `import-krc` from outside.

use crate::support::{poseshift, repository, scratch};
use poseshift::model::Conditions;
use poseshift::model::profile::{Mounted, Profile};
use std::path::Path;

/// Runs a command in a folder; status, and what was printed to both.
fn run(folder: &Path, arguments: &[&str]) -> (i32, String) {
    let done = poseshift()
        .current_dir(folder)
        .args(arguments)
        .output()
        .expect("the program starts");
    let reported = [done.stdout, done.stderr].concat();
    let reported = String::from_utf8_lossy(&reported).into_owned();
    (done.status.code().expect("a status"), reported)
}

fn read(path: &Path) -> (String, Profile) {
    let text = std::fs::read_to_string(path).expect("written");
    let profile = Profile::from_yaml(&text).expect("a profile");
    (text, profile)
}

#[test]
fn axes_are_added_and_every_other_line_stays() {
    let folder = scratch();
    let plain = std::fs::read_to_string(repository("robots/abb_irb120.yaml")).expect("shipped");
    let path = folder.path().join("p.yaml");
    std::fs::write(&path, &plain).expect("a writable folder");
    let track = [
        "profile",
        "add-track",
        "p.yaml",
        "eax_a",
        "--direction",
        "0,-2,0",
        "--min-mm=-100",
        "--max-mm",
        "3000",
        "--zero-mm",
        "500",
        "-o",
        "q.yaml",
    ];
    let (status, reported) = run(folder.path(), &track);
    assert_eq!(status, 0, "{reported}");
    assert!(reported.contains("external axis eax_a"), "{reported}");
    let (text, found) = read(&folder.path().join("q.yaml"));
    let axis = &found.external.track[0];
    assert_eq!((axis.direction, axis.zero_m), ([0.0, -1.0, 0.0], 0.5));
    assert_eq!((axis.min_m, axis.max_m), (-0.1, 3.0));
    // what was there is there still
    let kept: Vec<&str> = plain.lines().collect();
    assert!(kept.iter().all(|line| text.lines().any(|own| own == *line)));
    let table = [
        "profile",
        "add-positioner",
        "q.yaml",
        "STN1",
        "--axis",
        "eax_b=900,-250,300,0,90,180,-90,90,-1,5",
        "--axis",
        "eax_c=0,0,120,90,0,0,-180,180",
        "--plate",
        "0,0,50,0,0,0",
        "--in-place",
    ];
    let (status, reported) = run(folder.path(), &table);
    assert_eq!(status, 0, "{reported}");
    let (_, found) = read(&folder.path().join("q.yaml"));
    let station = &found.external.positioners[0];
    assert_eq!((station.name.as_str(), station.axes.len()), ("STN1", 2));
    assert_eq!(station.axes[0].sign, -1.0);
    assert!((station.axes[0].zero_rad.to_degrees() - 5.0).abs() < 1e-12);
    assert_eq!(found.external.track.len(), 1);
    // nothing is written over, nothing half, and the fault is named
    let (status, reported) = run(folder.path(), &track);
    assert_eq!(status, 2, "{reported}");
    for (option, value, says) in [
        ("--direction", "0,0,0", "no direction"),
        ("--direction", "0,0,1", "up is nearly along"),
        ("--direction", "1,0", "expected 3 numbers"),
        ("--max-mm", "-200", "not below"),
    ] {
        let mut bad = track;
        let at = bad
            .iter()
            .position(|word| *word == option)
            .expect("an option");
        bad[at + 1] = value;
        bad[12] = "bad.yaml";
        if option == "--max-mm" {
            bad[at] = "--max-mm=-200";
            bad[at + 1] = "--coordinates=base";
        }
        let (status, reported) = run(folder.path(), &bad);
        assert_eq!(status, 2, "{value} {reported}");
        assert!(reported.contains(says), "{value} {reported}");
        assert!(!folder.path().join("bad.yaml").exists());
    }
}

const MOC: &str = r#"MOC:CFG_1.0:6:0::
#
MECHANICAL_UNIT:

      -name "TRACK_1" -use_activation_relay "" -use_brake_relay "rob1_brake"\
      -use_single_0 "TRACK_1" -allow_move_of_user_frame  -activate_at_start_up \
      -deactivation_forbidden 

      -name "STN1" -use_single_0 "STN1" -allow_move_of_user_frame 

      -name "GUN" -use_single_0 "GUN"
#
ROBOT:

      -name "ROB_1" -use_robot_type "ROB1_4600"\
      -base_frame_pos_x 3.5 -base_frame_pos_y -0.25\
      -base_frame_pos_z 0.0175 -base_frame_orient_u0 0.707106781\
      -base_frame_orient_u3 -0.707106781 -base_frame_coordinated "TRACK_1"
#
SINGLE:

      -name "TRACK_1" -use_single_type "T4004" -use_joint "track1"\
      -base_frame_pos_x 3.5 -base_frame_pos_y -0.25 -base_frame_orient_u0 0\
      -base_frame_orient_u3 1

      -name "STN1" -use_single_type "STN" -use_joint "stn1"\
      -base_frame_pos_y 1.5 -base_frame_pos_z 0.8

      -name "GUN" -use_single_type "GUN" -use_joint "gun"
#
SINGLE_TYPE:

      -name "T4004" -mechanics "TRACK"

      -name "STN" -mechanics "FREE_ROT"
#
JOINT:

      -name "stn1" -logical_axis 9
#
ARM:

      -name "T4004_3.9_1" -use_arm_type "track1" -upper_joint_bound 3.901\
      -lower_joint_bound -0.001 -upper_joint_bound_max 3.905

      -name "stn1" -upper_joint_bound 3.14159265359 -lower_joint_bound -3.14159265359
"#;

#[test]
fn a_backup_of_an_abb_controller_says_where_the_base_goes() {
    let folder = scratch();
    let put = |name: &str, text: &str| {
        std::fs::write(folder.path().join(name), text).expect("a writable folder");
    };
    put("MOC.cfg", MOC);
    let profile = repository("robots/abb_irb120.yaml");
    let profile = profile.to_str().expect("a plain path");
    let import = |more: &[&str]| {
        let mut all = vec!["profile", "import-moc", "MOC.cfg", "--profile", profile];
        all.extend(more);
        run(folder.path(), &all)
    };
    let (status, reported) = import(&["-o", "p.yaml"]);
    assert_eq!(status, 2, "{reported}");
    assert!(
        reported.contains("logical axis") && reported.contains("--axis"),
        "{reported}"
    );
    let (status, reported) = import(&["-o", "p.yaml", "--axis", "eax_a"]);
    assert_eq!(status, 0, "{reported}");
    assert!(
        reported.contains("MOC.cfg:15") && reported.contains("left out: the unit GUN"),
        "{reported}"
    );
    let (_, found) = read(&folder.path().join("p.yaml"));
    let base = &found.world_from_base;
    let near = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-8);
    assert!(near(&base.translation, &[3.5, -0.25, 0.0175]), "{base:?}");
    assert!(near(&base.rotation.axis(0), &[0.0, -1.0, 0.0]), "{base:?}");
    let track = &found.external.track[0];
    assert!(near(&track.direction, &[-1.0, 0.0, 0.0]), "{track:?}");
    assert!(near(&[track.min_m, track.max_m], &[-0.001, 3.901]));
    let station = &found.external.positioners[0];
    assert_eq!(
        (station.name.as_str(), station.axes[0].axis.as_str()),
        ("STN1", "eax_c")
    );
    assert!(near(&station.axes[0].at.translation, &[0.0, 1.5, 0.8]));
    assert!(near(&[station.axes[0].max_rad], &[std::f64::consts::PI]));
    for (from, to, says) in [
        ("MOC:CFG_1.0:6:0::", "EIO:CFG_1.0:6:0::", "no MOC.cfg"),
        ("u3 -0.707106781", "u3 0.1", "has the length"),
        (
            "pos_x 3.5 -base_frame_pos_y -0.25\\",
            "pos_x abc\\",
            "`abc`",
        ),
        (
            "\"track1\" -upper",
            "\"other\" -upper",
            "how far TRACK_1 goes",
        ),
    ] {
        assert!(MOC.contains(from), "{from}");
        put("MOC.cfg", &MOC.replacen(from, to, 1));
        let (status, reported) = import(&["-o", "bad.yaml", "--axis", "eax_a"]);
        assert_eq!(status, 2, "{to} {reported}");
        assert!(reported.contains(says), "{to} {reported}");
        assert!(!folder.path().join("bad.yaml").exists());
    }
}

#[test]
fn a_backup_that_is_cut_off_is_refused() {
    let folder = scratch();
    let profile = repository("robots/abb_irb120.yaml");
    let profile = profile.to_str().expect("a plain path");
    let refused = |text: &str, says: &str| {
        std::fs::write(folder.path().join("MOC.cfg"), text).expect("a writable folder");
        let all = ["profile", "import-moc", "MOC.cfg", "--profile", profile];
        let more = ["-o", "bad.yaml", "--axis", "eax_a"];
        let (status, reported) = run(folder.path(), &[&all[..], &more[..]].concat());
        assert_eq!(status, 2, "{says}: {reported}");
        assert!(reported.contains(says), "{says}: {reported}");
        assert!(!folder.path().join("bad.yaml").exists());
    };
    let (goes_on, z) = ("pos_y -0.25\\\n", "      -base_frame_pos_z 0.0175");
    let at = MOC.find(z).expect("a line of the robot");
    assert!(MOC[..at].ends_with(goes_on));
    // behind a line that goes on: with and without its line break, then an empty line or a section
    refused(&MOC[..at], "MOC.cfg:16");
    refused(&MOC[..at - 1], "MOC.cfg:16");
    refused(&format!("{}\n#\nSINGLE:\n", &MOC[..at]), "goes on");
    refused(&format!("{}SINGLE:\n", &MOC[..at]), "goes on");
    // within a line: a number, a key, a quoted word
    refused(&MOC[..at + z.len() - 2], "the line has no end");
    refused(
        &MOC[..at + "      -base_frame_pos_z".len()],
        "the line has no end",
    );
    let key = format!("{}      -base_frame_pos_z\n", &MOC[..at]);
    refused(&key, "base_frame_pos_z of ROB_1 has no value");
    let quoted = MOC.find("ROB1_4600").expect("its type");
    refused(&format!("{}\n", &MOC[..quoted + 4]), "quoted word");
}

const MACHINE: &str = "&ACCESS RV\nDEFDAT  $MACHINE PUBLIC\nINT $EX_AX_NUM=2 ;number\nINT \
    $AXIS_TYPE[12]\n$AXIS_TYPE[7]=1\n$AXIS_TYPE[8]=3\n$SOFTN_END[7]=-50.0\n$SOFTP_END[7]=4500.0\n$SOFTN_END[8]=-90.0\n$SOFTP_END[8]=90.0\nDECL EX_KIN $EX_KIN={ET1 #ERSYS,ET2 #EASYS,ET3 #NONE,ET4 #NONE,ET5 #NONE,ET6 #NONE}\nDECL ET_AX $ET1_AX={TR_A1 #E1,TR_A2 #NONE,TR_A3 #NONE}\nET1_NAME[]=\"KL\"\nDECL FRAME $ET1_TA1KR={X 0.0,Y 0.0,Z 450.0,A 0.0,B 90.0,C 0.0}\nDECL FRAME $ET1_TA2A1={X 0.0,Y 0.0,Z 0.0,A 0.0,B 0.0,C 0.0}\nDECL FRAME $ET1_TA3A2={X 0.0,Y 0.0,Z 0.0,A 0.0,B 0.0,C 0.0}\nDECL FRAME $ET1_TFLA3={X 0.0,Y 0.0,Z 0.0,A 0.0,B -90.0,C 0.0}\nDECL ET_AX $ET2_AX={TR_A1 #E2,TR_A2 #NONE,TR_A3 #NONE}\nDECL FRAME $ET2_TA1KR={X 0.0,Y 0.0,Z 700.0,A 0.0,B 0.0,C 90.0}\nDECL FRAME $ET2_TA2A1={X 0.0,Y 0.0,Z 0.0,A 0.0,B 0.0,C 0.0}\nDECL FRAME $ET2_TA3A2={X 0.0,Y 0.0,Z 0.0,A 0.0,B 0.0,C 0.0}\nDECL FRAME $ET2_TFLA3={X 0.0,Y 0.0,Z 25.0,A 0.0,B 0.0,C 0.0}\nFRAME $ERSYSROOT={X 100.0,Y 200.0,Z 0.0,A 90.0,B 0.0,C 0.0}\nENDDAT\n";
const CONFIG: &str = "DEFDAT  $CONFIG\nDECL MACHINE_DEF_STRUC \
    MACHINE_DEF[16]\nMACHINE_DEF[1]={NAME[] \"KR\",COOP_KRC_INDEX 1,PARENT[] \"WORLD\",ROOT {X \
    0.0,Y 0.0,Z 0.0,A 0.0,B 0.0,C 0.0},MECH_TYPE #ROBOT,GEOMETRY[] \"\"}\nMACHINE_DEF[2]={NAME[] \
    \"DKP\",COOP_KRC_INDEX 1,PARENT[] \"WORLD\",ROOT {X 1500.0,Y 0.0,Z 0.0,A 180.0,B 0.0,C \
    0.0},MECH_TYPE #EASYS,GEOMETRY[] \"\"}\nENDDAT\n";

#[test]
fn an_archive_of_a_kuka_controller_says_what_its_axes_carry() {
    let folder = scratch();
    let mada = folder.path().join("KRC/R1/Mada");
    let system = folder.path().join("KRC/R1/System");
    for path in [&mada, &system] {
        std::fs::create_dir_all(path).expect("a writable folder");
    }
    let put = |machine: &str, config: &str| {
        std::fs::write(mada.join("$machine.dat"), machine).expect("a writable folder");
        std::fs::write(system.join("$config.dat"), config).expect("a writable folder");
    };
    put(MACHINE, CONFIG);
    let profile = repository("robots/kuka_kr6_r900.yaml");
    let profile = profile.to_str().expect("a plain path").to_owned();
    let import = |out: &str| {
        run(
            folder.path(),
            &[
                "profile",
                "import-krc",
                "KRC",
                "--profile",
                &profile,
                "-o",
                out,
            ],
        )
    };
    let (status, reported) = import("p.yaml");
    assert_eq!(status, 0, "{reported}");
    let (_, found) = read(&folder.path().join("p.yaml"));
    let near = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-9);
    // z of TA1KR is the root's x, which points along the world's y
    let track = &found.external.track[0];
    assert_eq!(track.axis, "E1");
    assert!(near(&track.direction, &[0.0, 1.0, 0.0]), "{track:?}");
    assert!(near(&[track.min_m, track.max_m], &[-0.05, 4.5]));
    assert!(near(&found.world_from_base.translation, &[0.1, 0.2, 0.45]));
    assert!(near(
        &found.world_from_base.rotation.axis(0),
        &[0.0, 1.0, 0.0]
    ));
    // where the chain begins upside down the base is turned over, and the arm stands as upright
    let shipped =
        std::fs::read_to_string(repository("robots/kuka_kr6_r900.yaml")).expect("shipped");
    let over = |text: &str| {
        let lines = text.lines().map(|line| {
            let first = line.contains("d_mm: 400");
            let line = match line.trim_start() {
                base if base.starts_with("base:") => line.replace("rx_deg: 0", "rx_deg: 180"),
                _ if first => line.replace("400", "-400").replace("sign: -1", "sign: 1"),
                _ => line.replace("{alpha_deg: -90, a_mm: 25", "{alpha_deg: 90, a_mm: 25"),
            };
            line + "\n"
        });
        lines.collect::<String>()
    };
    std::fs::write(folder.path().join("over.yaml"), over(&shipped)).expect("a writable folder");
    let turned = [
        "profile",
        "import-krc",
        "KRC",
        "--profile",
        "over.yaml",
        "-o",
        "o.yaml",
    ];
    let (status, reported) = run(folder.path(), &turned);
    assert_eq!(status, 0, "{reported}");
    let (_, other) = read(&folder.path().join("o.yaml"));
    assert_ne!(other.world_from_base, found.world_from_base);
    let flange = |profile: &Profile| {
        let mounted = Mounted::flange();
        let model = profile.real_model(&mounted, &Conditions::default());
        model.forward(&[0.3, -1.2, 1.4, 0.5, 0.6, 0.7], &Conditions::default())
    };
    let gap = flange(&found).separation(&flange(&other));
    assert!(gap.distance_m < 1e-9 && gap.angle_rad < 1e-9, "{gap:?}");
    let station = &found.external.positioners[0];
    assert_eq!(
        (station.name.as_str(), station.axes[0].axis.as_str()),
        ("2", "E2")
    );
    let at = &station.axes[0].at;
    assert!(near(&at.translation, &[1.5, 0.0, 0.7]), "{at:?}");
    // about x by 90 degrees of a root that is turned round: z of the axis points along +y
    assert!(near(&at.rotation.axis(2), &[0.0, 1.0, 0.0]), "{at:?}");
    assert!(near(&station.plate.translation, &[0.0, 0.0, 0.025]));
    for (machine, config, says) in [
        (
            MACHINE.replace("#ERSYS,ET2 #EASYS", "#NONE,ET2 #NONE"),
            CONFIG.to_owned(),
            "carry nothing",
        ),
        (
            MACHINE.replace("$AXIS_TYPE[7]=1", "$AXIS_TYPE[7]=3"),
            CONFIG.to_owned(),
            "turntable",
        ),
        (
            MACHINE.replace("Z 450.0", "Z 4x"),
            CONFIG.to_owned(),
            "no frame",
        ),
        (
            MACHINE.to_owned(),
            CONFIG.replace("#EASYS", "#EBSYS"),
            "MACHINE_DEF",
        ),
        (
            MACHINE.to_owned(),
            CONFIG.replace(
                "\"DKP\",COOP_KRC_INDEX 1,PARENT[] \"WORLD\"",
                "\"DKP\",COOP_KRC_INDEX 1,PARENT[] \"KL\"",
            ),
            "stands on KL",
        ),
    ] {
        put(&machine, &config);
        let (status, reported) = import("bad.yaml");
        assert_eq!(status, 2, "{says} {reported}");
        assert!(reported.contains(says), "{says} {reported}");
        assert!(!folder.path().join("bad.yaml").exists());
    }
}

#[test]
fn a_profile_that_is_there_is_written_over_only_by_force() {
    let folder = scratch();
    let put = |name: &str, text: &str| {
        let path = folder.path().join(name);
        let parent = path.parent().expect("a folder");
        std::fs::create_dir_all(parent).expect("a writable folder");
        std::fs::write(path, text).expect("a writable folder");
    };
    put("MOC.cfg", MOC);
    put("KRC/R1/Mada/$machine.dat", MACHINE);
    put("KRC/R1/System/$config.dat", CONFIG);
    let shipped = |name: &str| std::fs::read_to_string(repository(name)).expect("shipped");
    put("abb.yaml", &shipped("robots/abb_irb120.yaml"));
    put("kuka.yaml", &shipped("robots/kuka_kr6_r900.yaml"));
    let table = "E2=900,-250,300,0,90,180,-90,90";
    for command in [
        &[
            "add-track",
            "abb.yaml",
            "E1",
            "--direction",
            "1,0,0",
            "--min-mm",
            "0",
            "--max-mm",
            "3000",
        ][..],
        &["add-positioner", "abb.yaml", "STN1", "--axis", table],
        &[
            "import-moc",
            "MOC.cfg",
            "--profile",
            "abb.yaml",
            "--axis",
            "eax_a",
        ],
        &["import-krc", "KRC", "--profile", "kuka.yaml"],
    ] {
        put("there.yaml", "mine\n");
        let mut all = vec!["profile"];
        all.extend(command);
        all.extend(["-o", "there.yaml"]);
        let (status, reported) = run(folder.path(), &all);
        let kept = std::fs::read_to_string(folder.path().join("there.yaml")).expect("there");
        assert!(
            status == 2 && kept == "mine\n" && reported.contains("--force"),
            "{command:?}: {status} {reported}"
        );
        all.push("--force");
        let (status, reported) = run(folder.path(), &all);
        assert_eq!(status, 0, "{command:?}: {reported}");
        let (_, found) = read(&folder.path().join("there.yaml"));
        assert!(!found.external.is_empty(), "{command:?}");
    }
}

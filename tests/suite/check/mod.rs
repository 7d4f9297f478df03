//! `check`: laws of the bounds, known cases, the command, URDF.

mod command;
mod findings;
mod insert;
mod kept;
mod laws;
mod meshes;
mod mutated;
mod reach;
mod rooms;
mod several;
mod together;
mod urdf;

use poseshift::check::cell::Cell;
use poseshift::check::{Check, Meshes, Options, Scene, Subject, check};
use poseshift::model::profile::Profile;
use poseshift::program::Source;
use poseshift::program::rapid::Rapid;

/// A deterministic number in [0, 1).
pub fn part(state: &mut u64) -> f64 {
    *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let mut z = *state;
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
}

pub fn profile(text: &str) -> Profile {
    Profile::from_yaml(text).expect("a profile")
}

pub const THESIS: &str = include_str!("../../../robots/abb_irb120_thesis.yaml");

/// A RAPID program with the tool of the thesis.
pub fn rapid(lines: &str) -> Vec<Source> {
    let text = format!(
        "MODULE t\n  PERS tooldata artifact := \
         [TRUE,[[50,25,100],[1,0,0,0]],[2.6,[-23,0,100],[1,0,0,0],0,0,0]];\n  PROC \
         main()\n{lines}  ENDPROC\nENDMODULE\n"
    );
    vec![Source::new("t.mod", text.into_bytes())]
}

/// A joint move, degrees.
pub fn joint_move(q: [f64; 6]) -> String {
    let q = q.map(|q| format!("{q:.6}")).join(",");
    format!("    MoveAbsJ [[{q}],[9E9,9E9,9E9,9E9,9E9,9E9]],v1000,fine,artifact;\n")
}

pub fn run(
    profile: &Profile,
    cell: Option<&Cell>,
    sources: &[Source],
    nominal: Option<&[Source]>,
    options: &Options,
) -> Check {
    let scene = Scene::new(profile, cell, &Meshes::new()).expect("no meshes");
    let subject = Subject {
        language: &Rapid,
        sources,
        nominal,
        profile,
        scene: &scene,
    };
    check(&subject, options).expect("a check")
}

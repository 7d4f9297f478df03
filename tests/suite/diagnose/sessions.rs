//! Sessions of an independent simulation: what has not changed, and what moved slowly.

use crate::support::repository;
use poseshift::diagnose::{Diagnosis, Options, Standing, Verdict, diagnose};
use poseshift::identify::measurements::Measurements;
use poseshift::model::profile::Profile;

fn diagnosed(folder: &str) -> Diagnosis {
    let file = |name: &str| {
        let path = repository(&format!("tests/data/sessions/{folder}/{name}"));
        std::fs::read_to_string(path).expect("a file of the repository")
    };
    let profile = Profile::from_yaml(&file("calibrated.yaml")).expect("a profile");
    let rows = Measurements::from_csv(file("measured.csv").as_bytes()).expect("rows");
    diagnose(&profile, &rows, &Options::default(), &mut |_| {}).expect("enough rows")
}

#[test]
fn an_arm_is_as_it_was_calibrated_though_soft_or_measured_in_one_part_of_its_workspace() {
    for folder in ["local_rows", "soft_arm"] {
        let found = diagnosed(folder);
        let reasons = &found.reasons;
        assert_eq!(
            found.verdict,
            Verdict::NothingMissing,
            "{folder}: {reasons:?}"
        );
    }
}

/// A lighter load and a link that bends more multiply: of the product, which a linear model lacks, no
/// change of geometry is made.
#[test]
fn what_two_effects_do_together_is_no_third_one() {
    let found = diagnosed("lighter_load");
    assert_eq!(found.verdict, Verdict::Explained, "{:?}", found.reasons);
    let labels = found.found.iter().map(|f| f.effect.label());
    let labels: Vec<String> = labels.collect();
    assert!(
        matches!(&labels[..], [load, bends]
            if load.starts_with("payload_error") && bends.starts_with("link_compliance")),
        "{labels:?}"
    );
    assert_eq!(found.found[0].standing, Standing::Certain);
}

#[test]
fn a_device_that_moves_slowly_did_not_certainly_move_at_a_row() {
    for folder in ["slow_device", "slow_device_again"] {
        let found = diagnosed(folder);
        let steps = found.found.iter();
        let steps = steps.filter(|f| f.effect.definition().begins_at_a_row());
        let steps: Vec<_> = steps.map(|f| (f.effect.label(), f.standing)).collect();
        assert!(!steps.is_empty(), "{folder}");
        for (label, standing) in steps {
            assert_ne!(standing, Standing::Certain, "{folder}: {label}");
        }
        assert_ne!(found.verdict, Verdict::Explained, "{folder}");
    }
}

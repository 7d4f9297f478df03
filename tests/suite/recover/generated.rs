//! Measurements in the shape of real ones, generated: what the real sets show is shown where they
//! are not there, and the truth is known.

use super::real::{mark, three};
use crate::shapes::{SHAPES, set};
use poseshift::identify::measurements::Measurements;
use poseshift::model::profile::Profile;

#[test]
fn held_out_errors_come_down_to_what_level_3_lacks() {
    for shape in &SHAPES {
        let set = set(shape, 7);
        let profile = Profile::from_yaml(&set.profile).expect("a profile");
        let mut rows = Measurements::from_csv(set.csv.as_bytes()).expect("measurements");
        assert_eq!(
            rows.configurations().last(),
            Some(&(shape.configurations - 1)),
            "{}",
            shape.name
        );
        mark(&mut rows, |number| number.is_multiple_of(2));
        let [frames, geometry, compliance] = three(&profile, &rows);
        println!(
            "{}: {frames:.3} {geometry:.3} {compliance:.3} mm; with what level 3 lacks {:.3}, \
             noise \
             and what nobody knows {:.3}",
            shape.name, set.level_3_mm, set.floor_mm
        );
        assert!(frames > 1.3 * geometry, "{}", shape.name);
        assert!(geometry > 1.2 * compliance, "{}", shape.name);
        assert!(compliance < 1.1 * set.level_3_mm, "{}", shape.name);
    }
}

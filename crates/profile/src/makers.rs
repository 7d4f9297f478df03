//! What controllers of a maker do alike, whatever the arm.

use crate::model::Coupling;

/// A maker of robots whose programs are read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Maker {
    /// Its name in profiles.
    pub name: &'static str,
    /// The language of its controllers.
    pub language: &'static str,
    /// Words in names of robots and packages of this maker alone, in lower case: whole, before a
    /// number, or at the start of a longer word where they have four letters.
    pub marks: &'static [&'static str],
    /// The joint that its controllers count together with another one.
    pub coupling: Option<Coupling>,
    /// What is to be known of some of its arms; nothing where it is empty.
    pub remark: &'static str,
}

/// The makers.
///
/// # Source
/// FANUC's J3 is counted from the horizontal: ros-industrial/fanuc, `J23_factor` 1 in its launch
/// files, issues 22 and 186 there, also for the collaborative CR arms; of the CRX no document was
/// found. ABB's arms with a rod: ros-industrial/abb_driver, `J23_coupled`.
pub const MAKERS: &[Maker] = &[
    Maker {
        remark: "ABB's controllers count axis 3 of arms with a parallel rod (IRB 2400, 4400) \
            together with axis 2: `profile set` with kinematics.coupling=[{joint: 3, \"on\": 2, \
            ratio: -1}]",
        ..maker("ABB", "rapid", &["abb", "irb"])
    },
    maker("KUKA", "krl", &["kuka"]),
    Maker {
        coupling: Some(Coupling {
            joint: 2,
            on: 1,
            ratio: 1.0,
        }),
        ..maker("FANUC", "fanuc", &["fanuc"])
    },
    maker("Yaskawa", "inform", &["yaskawa", "motoman"]),
    maker("Universal Robots", "urscript", &["ur"]),
    maker("Staubli", "val3", &["staubli"]),
    maker("Kawasaki", "kawasaki", &["kawasaki"]),
];

const fn maker(
    name: &'static str,
    language: &'static str,
    marks: &'static [&'static str],
) -> Maker {
    Maker {
        name,
        language,
        marks,
        coupling: None,
        remark: "",
    }
}

impl Maker {
    /// The maker of this name, in any case.
    #[must_use]
    pub fn by_name(name: &str) -> Option<&'static Self> {
        MAKERS.iter().find(|maker| {
            maker.name.eq_ignore_ascii_case(name.trim())
                || maker
                    .marks
                    .iter()
                    .any(|mark| mark.eq_ignore_ascii_case(name.trim()))
        })
    }

    /// The one maker whose marks stand in a text.
    #[must_use]
    pub fn marked_in(text: &str) -> Option<&'static Self> {
        let text = text.to_lowercase();
        let words: Vec<&str> = text.split(|c: char| !c.is_alphanumeric()).collect();
        let stands = |mark: &&str| {
            words.iter().any(|word| {
                word.strip_prefix(mark).is_some_and(|rest| {
                    let numbered = rest.starts_with(|c: char| c.is_ascii_digit());
                    rest.is_empty() || numbered || mark.len() >= 4
                })
            })
        };
        let mut found = MAKERS.iter().filter(|maker| maker.marks.iter().any(stands));
        found.next().filter(|_| found.next().is_none())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_maker_is_known_by_its_name_and_by_its_marks() {
        let name = |maker: Option<&Maker>| maker.map(|maker| maker.name);
        assert_eq!(name(Maker::by_name("fanuc")), Some("FANUC"));
        assert_eq!(name(Maker::by_name("Motoman")), Some("Yaskawa"));
        assert_eq!(name(Maker::by_name("fanuk")), None);
        let mesh = "package://fanuc_crx_description/meshes/crx10ia/base.stl";
        assert_eq!(name(Maker::marked_in(mesh)), Some("FANUC"));
        assert_eq!(
            name(Maker::marked_in("ur5e_robot")),
            Some("Universal Robots")
        );
        assert_eq!(name(Maker::marked_in("abb_irb120_3_58")), Some("ABB"));
        assert_eq!(name(Maker::marked_in("nachi_mz07, our tourist")), None);
        assert_eq!(name(Maker::marked_in("kuka_and_abb")), None);
    }
}

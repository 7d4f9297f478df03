//! What is written is read again, number by number: a digit that is not the one that was meant
//! stops it.

use crate::path::{self, Prepared};
use poseshift::compensate::compensate;

const POINTS: u32 = 12;

#[test]
fn every_digit_of_a_target_that_is_not_what_was_meant_is_found() {
    for &(id, ending) in path::WRITTEN {
        let Prepared {
            language,
            sources,
            profile,
            settings,
            options,
        } = path::prepared((id, ending), POINTS, 130);
        let draft = || {
            let made = compensate(language, &sources, &profile, &options).expect("compensated");
            made.draft(language, &sources, &"0".repeat(64), false)
        };
        let (written, check) = draft();
        check
            .read_again(&written, language)
            .expect("what was meant");
        let program = poseshift::motion::read(language, &written.sources, &settings);
        let program = program.expect("a program");
        let mut tried = 0;
        for target in &program.targets {
            for number in program.numbers_of(target).iter().filter(|n| n.length > 0) {
                let (mut written, check) = draft();
                let bytes = &mut written.sources[target.file as usize].bytes;
                let field =
                    number.start as usize..number.start as usize + usize::from(number.length);
                let digit = bytes[field.clone()].iter().rposition(u8::is_ascii_digit);
                // words of a configuration have none
                let Some(digit) = digit else { continue };
                let at = field.start + digit;
                bytes[at] = if bytes[at] == b'9' {
                    b'8'
                } else {
                    bytes[at] + 1
                };
                let differs = check
                    .read_again(&written, language)
                    .expect_err("another number");
                assert_eq!(
                    differs.file, written.sources[target.file as usize].name,
                    "{id}"
                );
                assert!(!differs.what.is_empty());
                tried += 1;
            }
        }
        assert!(tried >= 6 * POINTS, "{id}: {tried}");
    }
}

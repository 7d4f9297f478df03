//! Rows that repeat an earlier one to the last digit: copies, which say nothing new.

use crate::finding::{Finding, Severity};
use crate::geometry::Pose;
use std::collections::HashMap;

/// A row and the earlier one that it repeats.
pub(super) type Copy = [usize; 2];

/// Rows whose numbers are those of an earlier one.
pub(super) fn copies<I: IntoIterator<Item = f64>>(rows: impl Iterator<Item = I>) -> Vec<Copy> {
    let mut first: HashMap<Vec<u64>, usize> = HashMap::new();
    let mut found = Vec::new();
    for (row, numbers) in rows.enumerate() {
        // a zero has no sign
        let key = numbers.into_iter().map(|x| (x + 0.0).to_bits()).collect();
        let earlier = *first.entry(key).or_insert(row);
        if earlier != row {
            found.push([row, earlier]);
        }
    }
    found
}

/// All numbers of a pose.
pub(super) fn numbers(pose: &Pose) -> impl Iterator<Item = f64> + use<> {
    let turn = pose.rotation.0.into_iter().flatten();
    turn.chain(pose.translation)
}

/// Takes out of a list what stands at the places of copies.
pub(super) fn without<T>(list: Vec<T>, copies: &[Copy]) -> Vec<T> {
    let mut left_out = copies.iter().map(|copy| copy[0]).peekable();
    let kept = list.into_iter().enumerate();
    kept.filter(|(row, _)| left_out.next_if_eq(row).is_none())
        .map(|(_, one)| one)
        .collect()
}

/// That they count once; rows are named by `named`.
pub(super) fn finding(
    copies: &[Copy],
    file: &str,
    named: impl Fn(usize) -> String,
) -> Option<Finding> {
    let [row, earlier] = *copies.first()?;
    let message = format!(
        "{} row(s) repeat an earlier one to the last digit, the first ({}) that of {}: they count \
         once",
        copies.len(),
        named(row),
        named(earlier)
    );
    let finding = Finding::of_file("duplicate-rows", Severity::Warning, file, message);
    Some(finding.hint("a device never repeats itself exactly: leave copies out"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn copies_are_found_wherever_they_stand() {
        let rows = [
            [1.0, 0.0],
            [2.0, 0.0],
            [1.0, -0.0],
            [1.0, 1e-16],
            [2.0, 0.0],
        ];
        let found = copies(rows.into_iter());
        assert_eq!(found, [[2, 0], [4, 1]]);
        assert_eq!(
            without(vec!['a', 'b', 'c', 'd', 'e'], &found),
            ['a', 'b', 'd']
        );
        assert!(finding(&[], "f", |row| row.to_string()).is_none());
    }
}

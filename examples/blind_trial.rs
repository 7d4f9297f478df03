//! How often `diagnose` names what is hidden in a robot: seeded cases, diagnosed without the answer.
//!
//! `cargo run --release --example blind_trial -- [--only GROUP] [--count N] [--seed K] [--rows N] [--list]`

#[path = "../tests/physics/mod.rs"]
#[allow(dead_code)]
mod physics;
#[path = "../tests/trial/mod.rs"]
#[allow(dead_code)]
mod trial;

use poseshift::diagnose::{Options, Verdict, diagnose};
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::time::Instant;
use trial::{GROUPS, Group, NOISE_MM, case, label};

struct Told {
    what: String,
    size: f64,
    independent: bool,
    answer: Vec<String>,
    named: Vec<String>,
    verdict: Option<Verdict>,
    reason: String,
    /// Held-out rms after, over that of the noise; of rough data what 95 % of the rows stay below.
    floor: Option<f64>,
    seconds: f64,
    number: usize,
}

impl Told {
    fn right(&self, group: &Group) -> bool {
        if group.unregistered {
            return self.verdict != Some(Verdict::Explained);
        }
        self.verdict.is_some()
            && self.named == self.answer
            && (self.verdict == Some(Verdict::NothingMissing)) == self.answer.is_empty()
            && self.verdict != Some(Verdict::Undetermined)
    }
}

fn percentile_95(sizes: &[f64]) -> f64 {
    let mut sorted = sizes.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted[sorted.len() * 95 / 100]
}

fn run(group: &Group, number: usize, seed: u64, rows: usize) -> Told {
    let case = case(group, number, seed, rows);
    let start = Instant::now();
    let result = diagnose(
        &case.profile,
        &case.measurements,
        &Options::default(),
        &mut |_| {},
    );
    let seconds = start.elapsed().as_secs_f64();
    let mut told = Told {
        what: case.what,
        size: case.size,
        independent: case.independent,
        answer: case.answer,
        named: Vec::new(),
        verdict: None,
        reason: String::new(),
        floor: None,
        seconds,
        number,
    };
    match result {
        Ok(found) => {
            told.named = found.found.iter().map(|f| label(&f.effect)).collect();
            told.named.sort();
            told.named.dedup();
            told.verdict = Some(found.verdict);
            told.reason = found.reasons.join("; ");
            told.floor = found.held_out.map(|(_, after)| {
                if group.rough {
                    // heavy tails: the root mean square is that of a few rows
                    after.p95 / percentile_95(&case.noise_mm)
                } else {
                    after.rms / (NOISE_MM * 3.0_f64.sqrt())
                }
            });
        }
        Err(error) => told.reason = error.to_string(),
    }
    told
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let value = |name: &str| {
        arguments
            .iter()
            .position(|a| a == name)
            .and_then(|i| arguments.get(i + 1))
    };
    let number =
        |name: &str, default: usize| value(name).and_then(|v| v.parse().ok()).unwrap_or(default);
    let (count, seed, rows) = (
        number("--count", 192),
        number("--seed", 1) as u64,
        number("--rows", 150),
    );
    let (first, list) = (
        number("--first", 0),
        arguments.iter().any(|a| a == "--list"),
    );
    for group in &GROUPS {
        if value("--only").is_some_and(|only| !only.split(',').any(|o| o == group.name)) {
            continue;
        }
        let all: Vec<Told> = (first..first + count)
            .into_par_iter()
            .map(|n| run(group, n, seed, rows))
            .collect();
        let right = all.iter().filter(|t| t.right(group)).count();
        let part = right as f64 / all.len() as f64;
        let floors: Vec<f64> = all
            .iter()
            .filter(|t| t.right(group))
            .filter_map(|t| t.floor)
            .collect();
        let mut sorted = floors.clone();
        sorted.sort_by(f64::total_cmp);
        let mean = sorted.get(sorted.len() / 2).copied().unwrap_or(0.0);
        let tail = sorted.get(sorted.len() * 9 / 10).copied().unwrap_or(0.0);
        let slow = all.iter().map(|t| t.seconds).fold(0.0, f64::max);
        let typical = all.iter().map(|t| t.seconds).sum::<f64>() / all.len() as f64;
        println!(
            "{:13} {right:4} of {:4} = {:5.1} % (goal {:.0} %)  held-out / noise {mean:.3} (90 %: {tail:.3})  {typical:.2} s, at most {slow:.2} s",
            group.name,
            all.len(),
            100.0 * part,
            100.0 * group.goal
        );
        let undetermined = all
            .iter()
            .filter(|t| t.verdict == Some(Verdict::Undetermined))
            .count();
        let failed = all.iter().filter(|t| t.verdict.is_none()).count();
        let second = all.iter().filter(|t| t.independent).count();
        let second_right = all
            .iter()
            .filter(|t| t.independent && t.right(group))
            .count();
        println!(
            "              undetermined {undetermined}, errors {failed}; from the independent simulator {second_right} of {second}"
        );
        let mut table: BTreeMap<&str, (usize, usize, BTreeMap<String, usize>)> = BTreeMap::new();
        for told in &all {
            let row = table.entry(&told.what).or_default();
            row.1 += 1;
            if told.right(group) {
                row.0 += 1;
            } else {
                let plain = |labels: &[String]| {
                    let names: Vec<&str> = labels
                        .iter()
                        .map(|l| l.split(' ').next().unwrap_or(""))
                        .collect();
                    names.join("+")
                };
                let words = match told.verdict {
                    Some(Verdict::Undetermined) => format!("undetermined ({})", plain(&told.named)),
                    Some(v) => format!("{} ({})", v.id(), plain(&told.named)),
                    None => "error".into(),
                };
                *row.2.entry(words).or_default() += 1;
            }
        }
        for (what, (right, of, wrong)) in &table {
            if group.hidden < 2 || list {
                let wrong: Vec<String> = wrong.iter().map(|(w, n)| format!("{n} {w}")).collect();
                println!("  {what:40} {right:3} of {of:3}  {}", wrong.join(", "));
            }
        }
        if group.hidden == 1 {
            let edges = [0.5, 0.75, 1.0, 2.0, 4.0, 8.0, 16.0];
            for pair in edges.windows(2) {
                let inside: Vec<&Told> = all
                    .iter()
                    .filter(|t| t.size >= pair[0] && t.size < pair[1])
                    .collect();
                if !inside.is_empty() {
                    let right = inside.iter().filter(|t| t.right(group)).count();
                    println!(
                        "  size {:4} to {:4} x noise: {right} of {}",
                        pair[0],
                        pair[1],
                        inside.len()
                    );
                }
            }
        }
        if list {
            for told in all.iter().filter(|t| !t.right(group)) {
                println!(
                    "  #{:3} {:.1} x {}{}: named {} [{}] {}",
                    told.number,
                    told.size,
                    told.answer.join(" + "),
                    if told.independent {
                        " (independent)"
                    } else {
                        ""
                    },
                    told.named.join(" + "),
                    told.verdict.map_or("error", Verdict::id),
                    told.reason
                );
            }
        }
    }
}

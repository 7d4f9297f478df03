//! How often `diagnose` names what is hidden in a robot: seeded cases, diagnosed without the
//! answer.
//!
//! `cargo run --release --example blind_trial -- --help` lists what can be asked.

#[path = "../tests/physics/mod.rs"]
#[allow(dead_code)]
mod physics;
#[path = "../tests/trial/mod.rs"]
#[allow(dead_code)]
mod trial;

use clap::Parser;
use poseshift::diagnose::{Diagnosis, Found, Options, Standing, Verdict, diagnose};
use poseshift::identify::pick::Pick;
use poseshift::model::effects::Effect;
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::time::Instant;
use trial::{Case, GROUPS, Group, NOISE_MM, Start, case, label};

/// Hide effects in robots, diagnose without the answer, and count how often it is right
#[derive(Parser)]
#[allow(clippy::struct_excessive_bools, reason = "switches of a command")]
struct Trial {
    /// Groups of cases, by their names; all without
    #[arg(long, value_name = "GROUP", value_delimiter = ',', value_parser = GROUPS.map(|group| group.name))]
    only: Vec<String>,
    /// Number of the first case
    #[arg(long, default_value_t = 0)]
    first: usize,
    /// How many cases of each group
    #[arg(long, default_value_t = 192, value_parser = at_least_one)]
    count: usize,
    /// Seed
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Poses of each case
    #[arg(long, default_value_t = 150)]
    rows: usize,
    /// Count by effect where two are hidden, too
    #[arg(long)]
    list: bool,
    /// Print each case
    #[arg(long)]
    cases: bool,
    /// Fit the effects that are hidden, known by name, too: no method does better but by chance
    #[arg(long)]
    oracle: bool,
    /// Run one case after another, so that their times are those of one diagnosis on all cores
    #[arg(long)]
    in_turn: bool,
}

fn at_least_one(text: &str) -> Result<usize, String> {
    match text.parse() {
        Ok(0) => Err("no cases tell nothing".into()),
        Ok(count) => Ok(count),
        Err(error) => Err(error.to_string()),
    }
}

struct Reported {
    what: String,
    size: f64,
    independent: bool,
    answer: Vec<String>,
    named: Vec<String>,
    /// What the calibration did not determine is named, too.
    more: bool,
    /// Effects named that are certain.
    certain: usize,
    verdict: Option<Verdict>,
    reason: String,
    /// Held-out rms after, over that of the noise; of rough data what 95 % of the rows stay below.
    floor: Option<f64>,
    /// The same with the effects that are hidden and no others.
    oracle: Option<f64>,
    seconds: f64,
    number: usize,
}

impl Reported {
    fn right(&self, group: &Group) -> bool {
        if group.unregistered {
            // on a robot that was calibrated from measurements no effect may be certain, either
            let is_sure = self.certain > 0 && group.start == Start::Measured;
            return self.verdict != Some(Verdict::Explained) && !is_sure;
        }
        self.verdict.is_some()
            && self.named == self.answer
            && (self.verdict == Some(Verdict::NothingMissing))
                == (self.answer.is_empty() && !self.more)
            && self.verdict != Some(Verdict::Undetermined)
    }
}

fn percentile_95(sizes: &[f64]) -> f64 {
    let mut sorted = sizes.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted[sorted.len() * 95 / 100]
}

/// Options that leave no choice but these effects; a step is sought in every row.
fn only(effects: &[Effect]) -> Options {
    let pick = |effect: &Effect| {
        let mut pick = Pick::of(effect);
        if effect.definition().begins_at_a_row() {
            pick.places.clear();
        }
        pick
    };
    Options {
        accept: effects.iter().map(pick).collect(),
        ..Options::default()
    }
}

/// Held-out error over that of the noise.
fn floor_of(found: &Diagnosis, group: &Group, case: &Case) -> Option<f64> {
    let held = found.held_out.filter(|_| case.reads_positions);
    held.map(|(_, after)| {
        if group.rough {
            // heavy tails: the root mean square is that of a few rows
            after.p95 / percentile_95(&case.noise_mm)
        } else {
            after.rms / (NOISE_MM * 3.0_f64.sqrt())
        }
    })
}

fn run(group: &Group, number: usize, seed: u64, rows: usize, oracle: bool) -> Reported {
    let case = case(group, number, seed, rows);
    let start = Instant::now();
    let asked =
        |options: &Options| diagnose(&case.profile, &case.measurements, options, &mut |_| {});
    let result = asked(&Options::default());
    let seconds = start.elapsed().as_secs_f64();
    let known = (oracle && !group.unregistered).then(|| asked(&only(&case.effects)));
    let known = known.and_then(Result::ok);
    let mut reported = Reported {
        oracle: known.and_then(|found| floor_of(&found, group, &case)),
        what: case.what.clone(),
        size: case.size,
        independent: case.independent,
        answer: case.answer.clone(),
        named: Vec::new(),
        certain: 0,
        more: false,
        verdict: None,
        reason: String::new(),
        floor: None,
        seconds,
        number,
    };
    match result {
        Ok(found) => {
            let counts = |f: &&Found| {
                let name = label(&f.effect);
                case.answer.contains(&name) || !case.undetermined.contains(&name)
            };
            let all = || found.found.iter().filter(counts);
            reported.named = all().map(|f| label(&f.effect)).collect();
            reported.named.sort();
            reported.named.dedup();
            let is_certain = |f: &&Found| f.standing == Standing::Certain;
            reported.certain = all().filter(is_certain).count();
            reported.more = found.found.len() > all().count();
            reported.verdict = Some(found.verdict);
            reported.reason = found.reasons.join("; ");
            reported.floor = floor_of(&found, group, &case);
        }
        Err(error) => reported.reason = error.to_string(),
    }
    reported
}

/// Median, and what 90 % stay below.
fn middle_and_tail(values: impl Iterator<Item = f64>) -> (f64, f64) {
    let mut sorted: Vec<f64> = values.collect();
    sorted.sort_by(f64::total_cmp);
    let at = |index: usize| sorted.get(index).copied().unwrap_or(0.0);
    (at(sorted.len() / 2), at(sorted.len() * 9 / 10))
}

/// One line: answer, size of what is left, time.
fn print_case(group: &Group, reported: &Reported) {
    println!(
        "  {} #{}: {} [{}] {:.3}{} {:.2} s",
        group.name,
        reported.number,
        reported.named.join(" + "),
        reported.verdict.map_or("error", Verdict::id),
        reported.floor.unwrap_or(0.0),
        reported
            .oracle
            .map_or(String::new(), |o| format!(" oracle {o:.3}")),
        reported.seconds
    );
}

fn main() {
    let asked = Trial::parse();
    let cases = asked.first..asked.first + asked.count;
    for group in &GROUPS {
        if !asked.only.is_empty() && !asked.only.iter().any(|only| only == group.name) {
            continue;
        }
        let one = |n| run(group, n, asked.seed, asked.rows, asked.oracle);
        let all: Vec<Reported> = if asked.in_turn {
            cases.clone().map(one).collect()
        } else {
            cases.clone().into_par_iter().map(one).collect()
        };
        if asked.cases {
            for reported in &all {
                print_case(group, reported);
            }
        }
        let right = all.iter().filter(|t| t.right(group)).count();
        let part = right as f64 / all.len() as f64;
        let right_ones = || all.iter().filter(|t| t.right(group));
        let (mean, tail) = middle_and_tail(right_ones().filter_map(|t| t.floor));
        let slow = all.iter().map(|t| t.seconds).fold(0.0, f64::max);
        let typical = all.iter().map(|t| t.seconds).sum::<f64>() / all.len() as f64;
        println!(
            "{:13} {right:4} of {:4} = {:5.1} % (goal {:.0} %)  held-out / noise {mean:.3} (90 %: \
             {tail:.3})  {typical:.2} s, at most {slow:.2} s",
            group.name,
            all.len(),
            100.0 * part,
            100.0 * group.goal
        );
        if right_ones().any(|t| t.oracle.is_some()) {
            let (mean, tail) = middle_and_tail(right_ones().filter_map(|t| t.oracle));
            println!(
                "              held-out / noise with the effects known {mean:.3} (90 %: {tail:.3})"
            );
        }
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
            "              undetermined {undetermined}, errors {failed}; from the independent \
             simulator {second_right} of {second}"
        );
        let mut table: BTreeMap<&str, (usize, usize, BTreeMap<String, usize>)> = BTreeMap::new();
        for reported in &all {
            let row = table.entry(&reported.what).or_default();
            row.1 += 1;
            if reported.right(group) {
                row.0 += 1;
            } else {
                let plain = |labels: &[String]| {
                    let names: Vec<&str> = labels
                        .iter()
                        .map(|l| l.split(' ').next().unwrap_or(""))
                        .collect();
                    names.join("+")
                };
                let words = match reported.verdict {
                    Some(Verdict::Undetermined) => {
                        format!("undetermined ({})", plain(&reported.named))
                    }
                    Some(v) => format!("{} ({})", v.id(), plain(&reported.named)),
                    None => "error".into(),
                };
                *row.2.entry(words).or_default() += 1;
            }
        }
        for (what, (right, of, wrong)) in &table {
            if group.hidden < 2 || asked.list {
                let wrong: Vec<String> = wrong.iter().map(|(w, n)| format!("{n} {w}")).collect();
                println!("  {what:40} {right:3} of {of:3}  {}", wrong.join(", "));
            }
        }
        if group.hidden == 1 {
            let edges = [0.5, 0.75, 1.0, 2.0, 4.0, 8.0, 16.0];
            for pair in edges.windows(2) {
                let inside: Vec<&Reported> = all
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
        if asked.list {
            for reported in all.iter().filter(|t| !t.right(group)) {
                println!(
                    "  #{:3} {:.1} x {}{}: named {} [{}] {}",
                    reported.number,
                    reported.size,
                    reported.answer.join(" + "),
                    if reported.independent {
                        " (independent)"
                    } else {
                        ""
                    },
                    reported.named.join(" + "),
                    reported.verdict.map_or("error", Verdict::id),
                    reported.reason
                );
            }
        }
    }
}

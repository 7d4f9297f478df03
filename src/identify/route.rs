//! In which order configurations are driven to.

use std::collections::HashMap;

/// Configurations that are tried as the first one.
const STARTS: usize = 8;
/// Turns of looking for a better place of what cannot be reached.
const REPAIRS: usize = 4;

fn far(a: &[f64; 6], b: &[f64; 6]) -> f64 {
    a.iter()
        .zip(b)
        .map(|(x, y)| (x - y).abs())
        .fold(0.0, f64::max)
}

/// An order of configurations, each left for where the next one is approached from by a move that is `free`, as far as there is
/// one: always on to the nearest that can be reached, and what is left over is put in between where it fits; the best of some
/// beginnings.
#[must_use]
pub fn order(
    joints: &[[f64; 6]],
    approach: &dyn Fn(&[f64; 6]) -> [f64; 6],
    free: &dyn Fn(&[f64; 6], &[f64; 6]) -> bool,
) -> Vec<usize> {
    let mut known: HashMap<(usize, usize), bool> = HashMap::new();
    let mut leads = |from: usize, to: usize| {
        *known
            .entry((from, to))
            .or_insert_with(|| free(&joints[from], &approach(&joints[to])))
    };
    let zero = [0.0; 6];
    let mut starts: Vec<usize> = (0..joints.len()).collect();
    starts.sort_by(|a, b| far(&joints[*a], &zero).total_cmp(&far(&joints[*b], &zero)));
    let mut best: Option<(usize, Vec<usize>)> = None;
    for start in starts.into_iter().take(STARTS) {
        let (mut order, mut over) = onward(joints, start, &mut leads);
        for _ in 0..REPAIRS {
            over = put_between(&mut order, over, &mut leads);
        }
        // what no move leads to comes last, and is told
        let missed = over.len();
        order.extend(over);
        if best.as_ref().is_none_or(|(least, _)| missed < *least) {
            best = Some((missed, order));
        }
        if missed == 0 {
            break;
        }
    }
    best.map_or_else(Vec::new, |(_, order)| order)
}

/// From one configuration always on to the nearest that can be reached; and what is left over.
fn onward(
    joints: &[[f64; 6]],
    start: usize,
    leads: &mut dyn FnMut(usize, usize) -> bool,
) -> (Vec<usize>, Vec<usize>) {
    let mut left: Vec<usize> = (0..joints.len()).filter(|i| *i != start).collect();
    let mut order = vec![start];
    let mut at = start;
    loop {
        left.sort_by(|a, b| {
            far(&joints[*a], &joints[at]).total_cmp(&far(&joints[*b], &joints[at]))
        });
        let Some(next) = left.iter().position(|to| leads(at, *to)) else {
            return (order, left);
        };
        at = left.remove(next);
        order.push(at);
    }
}

/// Puts what is left over where free moves lead to it and on; what fits nowhere is given back.
fn put_between(
    order: &mut Vec<usize>,
    over: Vec<usize>,
    leads: &mut dyn FnMut(usize, usize) -> bool,
) -> Vec<usize> {
    let mut again = Vec::new();
    for one in over {
        if leads(one, order[0]) {
            order.insert(0, one);
            continue;
        }
        let behind = (0..order.len()).find(|k| {
            let next = order.get(k + 1).copied();
            leads(order[*k], one) && next.is_none_or(|next| leads(one, next))
        });
        match behind {
            Some(k) => order.insert(k + 1, one),
            None => again.push(one),
        }
    }
    again
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_configuration_comes_once_and_moves_are_free_where_there_is_a_way() {
        // a wall at 0 of joint 1 that is open where joint 2 is above 1
        let joints: Vec<[f64; 6]> = (0..20)
            .map(|i| {
                let side = if i % 2 == 0 { 1.0 } else { -1.0 };
                let height = if i < 4 { 1.5 } else { 0.05 * f64::from(i) };
                [
                    side * (0.2 + 0.01 * f64::from(i)),
                    height,
                    0.0,
                    0.0,
                    0.0,
                    0.0,
                ]
            })
            .collect();
        let free = |a: &[f64; 6], b: &[f64; 6]| a[0] * b[0] > 0.0 || (a[1] > 1.0 && b[1] > 1.0);
        let order = order(&joints, &|q| *q, &free);
        let mut sorted = order.clone();
        sorted.sort_unstable();
        assert_eq!(sorted, (0..20).collect::<Vec<_>>());
        let blocked = order
            .windows(2)
            .filter(|pair| !free(&joints[pair[0]], &joints[pair[1]]));
        assert_eq!(blocked.count(), 0, "{order:?}");
    }
}

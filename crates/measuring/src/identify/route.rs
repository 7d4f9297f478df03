//! In which order configurations are driven to.

use std::collections::{HashMap, VecDeque};

/// Configurations that are tried as the first one.
const STARTS: usize = 8;
/// Rounds of looking for a better place of what cannot be reached.
const REPAIRS: usize = 4;

fn far(a: &[f64; 6], b: &[f64; 6]) -> f64 {
    a.iter()
        .zip(b)
        .map(|(x, y)| (x - y).abs())
        .fold(0.0, f64::max)
}

/// An order of configurations, each left for where the next one is approached from by a move that
/// is `free`, as far as there is one: always on to the nearest that can be reached, and what is
/// left over is put in between where it fits; the best of some beginnings.
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
        // what no move leads to comes last, and is reported
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

/// Groups of joints that are laid at home on a detour, the likeliest first.
const TUCKED: [&[usize]; 7] = [
    &[1, 2, 3, 4, 5],
    &[0, 1, 2, 3, 4, 5],
    &[3, 4, 5],
    &[1, 2],
    &[4],
    &[2],
    &[1],
];

/// Poses to go over from one place to another, as few as do, where the straight path of the joints
/// is not free: with some joints of either end at `home`, or over some of `others`. None where the
/// straight path is free, or where nothing helps.
#[must_use]
pub fn detour(
    from: &[f64; 6],
    to: &[f64; 6],
    home: &[f64; 6],
    others: &[[f64; 6]],
    free: &dyn Fn(&[f64; 6], &[f64; 6]) -> bool,
) -> Vec<[f64; 6]> {
    if free(from, to) {
        return Vec::new();
    }
    let tucked = |q: &[f64; 6], joints: &[usize]| {
        let mut tucked = *q;
        for joint in joints {
            tucked[*joint] = home[*joint];
        }
        tucked
    };
    let mut places: Vec<[f64; 6]> = TUCKED
        .iter()
        .flat_map(|joints| [tucked(to, joints), tucked(from, joints)])
        .collect();
    let mut nearest: Vec<[f64; 6]> = others.to_vec();
    nearest.sort_by(|a, b| (far(from, a) + far(a, to)).total_cmp(&(far(from, b) + far(b, to))));
    places.extend(nearest);
    places.retain(|place| place != from && place != to);
    // breadth first: where each place is come to from
    let mut come_from: Vec<Option<Option<usize>>> = vec![None; places.len()];
    let mut open: VecDeque<Option<usize>> = VecDeque::from([None]);
    while let Some(at) = open.pop_front() {
        let here = at.map_or(from, |at| &places[at]);
        if at.is_some() && free(here, to) {
            let mut over: Vec<[f64; 6]> = std::iter::successors(at, |at| come_from[*at].flatten())
                .map(|at| places[at])
                .collect();
            over.reverse();
            return over;
        }
        for next in 0..places.len() {
            if come_from[next].is_none() && free(here, &places[next]) {
                come_from[next] = Some(at);
                open.push_back(Some(next));
            }
        }
    }
    Vec::new()
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
    fn a_way_that_is_not_free_goes_over_a_pose_between() {
        // a wall at 0 of joint 1 that is open where joint 2 is below 0.1 or above 1
        let free = |a: &[f64; 6], b: &[f64; 6]| {
            let open = |q: &[f64; 6]| q[1] < 0.1 || q[1] > 1.0;
            a[0] * b[0] > 0.0 || (open(a) && open(b))
        };
        let at = |first: f64, second: f64| [first, second, 0.3, 0.0, 0.0, 0.0];
        let home = [0.0; 6];
        let is_way = |from: &[f64; 6], over: &[[f64; 6]], to: &[f64; 6]| {
            let places = [&[*from], over, &[*to]].concat();
            places.windows(2).all(|ends| free(&ends[0], &ends[1]))
        };
        for (from, to, poses) in [
            (at(1.0, 0.5), at(2.0, 0.5), 0),
            (at(1.0, 0.0), at(-1.0, 0.5), 1),
            (at(1.0, 0.5), at(-1.0, 0.5), 2),
        ] {
            let over = detour(&from, &to, &home, &[], &free);
            assert_eq!(over.len(), poses, "{over:?}");
            assert!(is_way(&from, &over, &to), "{over:?}");
        }
        // where home is no help, over another configuration
        let narrow = |a: &[f64; 6], b: &[f64; 6]| a[0] * b[0] > 0.0 || (a[1] > 1.0 || b[1] > 1.0);
        let others = [at(1.5, 0.2), at(1.2, 1.4)];
        let found = detour(&at(1.0, 0.5), &at(-1.0, 0.5), &home, &others, &narrow);
        assert_eq!(found, [at(1.2, 1.4)]);
        assert!(detour(&at(1.0, 0.5), &at(-1.0, 0.5), &home, &[], &narrow).is_empty());
    }

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

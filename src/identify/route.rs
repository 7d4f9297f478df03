//! In which order configurations are driven to.

/// Turns of looking for a better place of what cannot be reached.
const REPAIRS: usize = 4;

fn far(a: &[f64; 6], b: &[f64; 6]) -> f64 {
    a.iter()
        .zip(b)
        .map(|(x, y)| (x - y).abs())
        .fold(0.0, f64::max)
}

/// An order of configurations, each left for where the next one is approached from by a move that is `free`, as far as there is
/// one: always on to the nearest that can be reached, and what is left over is put in between where it fits.
#[must_use]
pub fn order(
    joints: &[[f64; 6]],
    approach: &dyn Fn(&[f64; 6]) -> [f64; 6],
    free: &dyn Fn(&[f64; 6], &[f64; 6]) -> bool,
) -> Vec<usize> {
    let mut known: std::collections::HashMap<(usize, usize), bool> =
        std::collections::HashMap::new();
    let mut leads = |from: usize, to: usize| {
        *known
            .entry((from, to))
            .or_insert_with(|| free(&joints[from], &approach(&joints[to])))
    };
    let mut left: Vec<usize> = (0..joints.len()).collect();
    let zero = [0.0; 6];
    let Some(first) = left
        .iter()
        .copied()
        .min_by(|a, b| far(&joints[*a], &zero).total_cmp(&far(&joints[*b], &zero)))
    else {
        return Vec::new();
    };
    left.retain(|i| *i != first);
    let mut order = vec![first];
    let mut over = Vec::new();
    while !left.is_empty() {
        let at = *order.last().expect("it has the first");
        left.sort_by(|a, b| {
            far(&joints[*a], &joints[at]).total_cmp(&far(&joints[*b], &joints[at]))
        });
        if let Some(next) = left.iter().position(|to| leads(at, *to)) {
            order.push(left.remove(next));
        } else {
            over = std::mem::take(&mut left);
        }
    }
    for _ in 0..REPAIRS {
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
        over = again;
        if over.is_empty() {
            break;
        }
    }
    // what no move leads to comes last, and is told
    order.extend(over);
    order
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

//! How near bodies come anywhere along a move: conservative advancement by halving.
//!
//! Over an interval of a move with bounds V of a body's speed and K of its acceleration by s, seen
//! from the other body, and the two bodies' distance d at the middle with unit normal n between
//! them, their distance is nowhere less than
//!
//! ```text
//! d − V h/2                                                     no point moves farther
//! the gap along n, at the ends and the middle, less K (h/2)²/8   no point leaves its chord by more
//! ```
//!
//! The interval with the least bound is halved until it is within a tolerance of the nearest
//! sample; pairs that cannot be the nearest are dropped on the way. What is reported is the bound:
//! never more than the true clearance.
//!
//! # Source
//! B. Mirtich, J. Canny, "Impulse-based simulation" (1995) (conservative advancement); S. Piyavskii
//! (1972) (the search).

use super::mover::Mover;
use super::query::{Body, Nearest};
use super::scene::{FixedForm, Other, Scene, Watched};
use super::sweep::{Frames, Rates};
use crate::geometry::{Pose, Vector, norm};
use crate::motion::leg::{Leg, Piece};
use std::collections::BinaryHeap;

/// The bound is within this of the nearest sample, metres.
const CLOSE_M: f64 = 5e-6;
/// Intervals are not halved below this part of the move.
const SHORTEST: f64 = 1e-7;
/// Intervals looked at in one move before its bound is reported as it is.
const MOST: usize = 20_000;
/// Nothing nearer than this is beyond any horizon, metres: it must be far above [`CLOSE_M`].
const LEAST_HORIZON_M: f64 = 1e-4;
/// Intervals that are sampled where the search gives up.
const SAMPLED: usize = 2_000;
/// More triangles than this stay in their tree.
const FEW: usize = 48;

/// How near a pair comes: the nearest, or the one with the least room.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clearance {
    /// Nowhere along the move are they nearer than this, metres.
    pub clearance_m: f64,
    /// The nearest sample, metres.
    pub sampled_m: f64,
    /// What is required of the pair, metres.
    pub required_m: f64,
    /// Index of the pair; `None` where nothing comes within the horizon.
    pub pair: Option<usize>,
    /// Where along the move, 0 to 1.
    pub at: f64,
    /// The controller's joints there, radians.
    pub joints: [f64; 6],
    /// The nearest points in the world, on the moving body and on the other.
    pub points: [Vector; 2],
    /// The bound is guaranteed; else only samples were looked at somewhere.
    pub certified: bool,
}

impl Clearance {
    /// Nowhere along the move has the pair less room than this, metres: what is required of it is
    /// taken off.
    #[must_use]
    pub fn room_m(&self) -> f64 {
        self.clearance_m - self.required_m
    }
}

/// A pair that is still in question in an interval; of a mesh one triangle, or all of them.
#[derive(Clone, Copy)]
struct Item {
    pair: u32,
    triangle: Option<u32>,
}

struct Node {
    /// Least margin that anything in it can have.
    bound: f64,
    from: f64,
    to: f64,
    piece: u32,
    items: Vec<Item>,
    joints: [f64; 6],
}

impl PartialEq for Node {
    fn eq(&self, other: &Self) -> bool {
        self.bound == other.bound
    }
}
impl Eq for Node {}
impl PartialOrd for Node {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}
impl Ord for Node {
    // the heap gives the greatest: the least bound
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        other.bound.total_cmp(&self.bound)
    }
}

struct Search<'a> {
    /// What is required of pairs counts; else their distance alone.
    rooms: bool,
    scene: &'a Scene,
    mover: &'a Mover<'a>,
    leg: &'a Leg<'a>,
    horizon_m: f64,
    pieces: &'a [Piece],
    rates: Vec<Rates>,
    best: Clearance,
    /// Least margin of a sample: clearance less what is required.
    margin: f64,
    /// Least bound of what was not looked at closer.
    settled: f64,
}

/// What comes near along one move.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Near {
    /// The pair that is the nearest, whatever is required of it.
    pub nearest: Clearance,
    /// The pair that has the least room: distance less what is required of it.
    pub least_room: Clearance,
}

/// What comes near along one move, as far as anything comes within `horizon_m` of what is required
/// of it. Where all bodies are is known: see [`Scene::is_known`].
pub(crate) fn near(
    scene: &Scene,
    mover: &Mover,
    leg: &Leg,
    pieces: &[Piece],
    horizon_m: f64,
) -> Near {
    let room = least_room(scene, mover, leg, pieces, horizon_m);
    let alike = |one: Clearance| Near {
        nearest: one,
        least_room: one,
    };
    // where nothing is near, all pairs are looked for as far as those of which most is required
    let required_m = scene.watched.iter().map(|pair| pair.required_m);
    let most_required_m = required_m.fold(0.0, f64::max);
    let is_none = room.pair.is_none();
    let (below_m, farthest_m) = if is_none {
        let horizon_m = horizon_m.max(LEAST_HORIZON_M);
        (most_required_m, horizon_m + most_required_m)
    } else {
        (room.required_m, room.sampled_m.max(LEAST_HORIZON_M))
    };
    // each pair has so much room, so that those of which most is required are so far apart
    let room_m = if is_none {
        room.clearance_m + most_required_m
    } else {
        room.clearance_m
    };
    // as more room is left to it, only a pair of which less is required can be nearer
    let is_less = |pair: &Watched| pair.required_m < below_m;
    if room.sampled_m <= 0.0 || !scene.watched.iter().any(is_less) {
        let nearest = Clearance {
            clearance_m: room_m,
            ..room
        };
        return Near {
            nearest,
            least_room: room,
        };
    }
    let asked = Asked {
        horizon_m: farthest_m,
        rooms: false,
        below_m,
    };
    let others = searched(scene, mover, leg, pieces, asked);
    if others.sampled_m <= 0.0 {
        return alike(others);
    }
    let is_nearer = others.sampled_m < room.sampled_m;
    Near {
        nearest: Clearance {
            clearance_m: room_m.min(others.clearance_m),
            certified: room.certified && others.certified,
            ..if is_nearer { others } else { room }
        },
        least_room: room,
    }
}

/// The pair with the least room along one move, within `horizon_m` as [`near`].
///
/// What touches comes before what only has too little room, whatever is required of it.
pub(crate) fn least_room(
    scene: &Scene,
    mover: &Mover,
    leg: &Leg,
    pieces: &[Piece],
    horizon_m: f64,
) -> Clearance {
    let horizon_m = horizon_m.max(LEAST_HORIZON_M);
    let search = |horizon_m, rooms| {
        let asked = Asked {
            horizon_m,
            rooms,
            below_m: f64::INFINITY,
        };
        searched(scene, mover, leg, pieces, asked)
    };
    let found = search(horizon_m, true);
    // a pair with too little room has ended the search for others
    if found.sampled_m > 0.0 && found.clearance_m < found.required_m {
        let touching = search(LEAST_HORIZON_M, false);
        if touching.sampled_m <= 0.0 {
            return touching;
        }
        let certified = found.certified && touching.certified;
        return Clearance { certified, ..found };
    }
    found
}

/// What one search is for.
#[derive(Clone, Copy)]
struct Asked {
    horizon_m: f64,
    /// What is required of pairs counts; else their distance alone.
    rooms: bool,
    /// Only pairs of which less is required than this, metres.
    below_m: f64,
}

/// The pair with the least room, or (`rooms` is false) the nearest one, by one search.
fn searched(scene: &Scene, mover: &Mover, leg: &Leg, pieces: &[Piece], asked: Asked) -> Clearance {
    let horizon_m = asked.horizon_m;
    let mut search = Search {
        rooms: asked.rooms,
        scene,
        mover,
        leg,
        horizon_m,
        pieces,
        rates: pieces
            .iter()
            .map(|piece| mover.rates(&scene.plates, leg, piece))
            .collect(),
        best: Clearance {
            clearance_m: horizon_m,
            sampled_m: f64::INFINITY,
            required_m: 0.0,
            pair: None,
            at: 0.0,
            joints: leg.start,
            points: [[0.0; 3]; 2],
            certified: true,
        },
        margin: horizon_m,
        settled: f64::INFINITY,
    };
    let all: Vec<Item> = (0..scene.watched.len())
        .filter(|pair| scene.watched[*pair].required_m < asked.below_m)
        .map(|pair| Item {
            pair: u32::try_from(pair).unwrap_or(u32::MAX),
            triangle: None,
        })
        .collect();
    let mut open = BinaryHeap::new();
    for (index, piece) in pieces.iter().enumerate() {
        search.best.certified &= piece.certified;
        let (from, to) = (piece.from, piece.to);
        let node = Node {
            bound: f64::NEG_INFINITY,
            from,
            to,
            piece: u32::try_from(index).unwrap_or(u32::MAX),
            items: all.clone(),
            joints: piece.start,
        };
        // rates without bound: all that is known is samples
        let rates = &search.rates[index];
        let known = rates.turn.iter().chain(&rates.gain).all(|x| x.is_finite());
        if known {
            open.push(node);
        } else {
            search.sample_all(&node, &all);
        }
    }
    let mut looked = 0;
    while let Some(node) = open.pop() {
        if node.bound >= search.margin - CLOSE_M {
            search.settled = search.settled.min(node.bound);
            break;
        }
        looked += 1;
        if node.to - node.from < SHORTEST {
            search.give_up(&node);
            continue;
        }
        if looked > MOST {
            search.give_up(&node);
            let rest = std::mem::take(&mut open).into_sorted_vec();
            for node in rest.iter().rev().take(SAMPLED) {
                search.give_up(node);
            }
            break;
        }
        let (middle, bound, items) = search.look(&node);
        if items.is_empty() {
            continue;
        }
        let half = 0.5 * (node.from + node.to);
        for (from, to, joints) in [(node.from, half, node.joints), (half, node.to, middle)] {
            open.push(Node {
                bound,
                from,
                to,
                piece: node.piece,
                items: items.clone(),
                joints,
            });
        }
        // nothing can be nearer than touching
        if search.best.sampled_m <= 0.0 {
            search.best.clearance_m = 0.0;
            return search.best;
        }
    }
    let least = search.settled.min(search.margin);
    search.best.clearance_m = (least + search.best.required_m).max(0.0);
    if search.best.pair.is_none() {
        search.best.clearance_m = search.best.clearance_m.min(horizon_m);
    }
    search.best
}

impl Search<'_> {
    fn frames(&self, s: f64, joints: &[f64; 6], node: &Node) -> Frames {
        let conditions = &self.pieces[node.piece as usize].conditions;
        let (plates, ride) = (&self.scene.plates, self.leg.ride.as_deref());
        self.mover.frames(plates, ride, s, joints, conditions)
    }

    /// The first body's pose seen from the second's frame.
    fn relative(&self, frames: &Frames, pair: &Watched) -> Pose {
        let world_from_a = *frames.of(self.scene.moving[pair.a].on);
        match pair.b {
            Other::Fixed(_) => world_from_a,
            Other::Moving(b) => frames.of(self.scene.moving[b].on).inverse() * world_from_a,
        }
    }

    /// What counts as required of a pair, metres.
    fn required_m(&self, pair: &Watched) -> f64 {
        if self.rooms { pair.required_m } else { 0.0 }
    }

    /// Leaves an interval whose bound is not near its samples: the bound is reported as it is.
    fn give_up(&mut self, node: &Node) {
        self.best.certified = false;
        if node.bound.is_finite() {
            self.settled = self.settled.min(node.bound);
        }
        self.sample_all(node, &node.items);
    }

    fn note(&mut self, item: Item, found: &Nearest, frames: &Frames, at: f64, joints: &[f64; 6]) {
        let pair = &self.scene.watched[item.pair as usize];
        let margin = found.distance_m - self.required_m(pair);
        if margin < self.margin {
            let place = match pair.b {
                Other::Fixed(_) => Pose::identity(),
                Other::Moving(b) => *frames.of(self.scene.moving[b].on),
            };
            self.margin = margin;
            self.best = Clearance {
                sampled_m: found.distance_m,
                required_m: pair.required_m,
                pair: Some(item.pair as usize),
                at,
                joints: *joints,
                points: [place.transform(found.on_a), place.transform(found.on_b)],
                ..self.best
            };
        }
    }

    /// Where rates have no bound, the ends and some places between.
    fn sample_all(&mut self, node: &Node, all: &[Item]) {
        let mut near = node.joints;
        for k in 0..=4 {
            let s = node.from + (node.to - node.from) * f64::from(k) / 4.0;
            near = self.leg.joints(s, &near);
            let frames = self.frames(s, &near, node);
            for item in all {
                let pair = &self.scene.watched[item.pair as usize];
                let relative = self.relative(&frames, pair);
                let body = &self.scene.moving[pair.a].body;
                match pair.b {
                    Other::Moving(b) => {
                        let found = body.nearest(&relative, &self.scene.moving[b].body);
                        self.note(*item, &found, &frames, s, &near);
                    }
                    Other::Fixed(k) => match &self.scene.fixed[k].form {
                        FixedForm::Convex(other) => {
                            let found = body.nearest(&relative, other);
                            self.note(*item, &found, &frames, s, &near);
                        }
                        FixedForm::Mesh { triangles, .. } => {
                            if let Some(t) = item.triangle {
                                let found = body.nearest(&relative, &triangles.bodies[t as usize]);
                                self.note(*item, &found, &frames, s, &near);
                                continue;
                            }
                            let (centre, radius) = body.ball();
                            let reach = radius + self.margin + self.required_m(pair);
                            let mut found = Vec::new();
                            triangles.near(relative.transform(centre), reach, |t| {
                                found.push(body.nearest(&relative, &triangles.bodies[t as usize]));
                            });
                            for found in found {
                                self.note(*item, &found, &frames, s, &near);
                            }
                        }
                    },
                }
            }
        }
    }

    /// Samples an interval in its middle; returns the joints there, what remains in question, and
    /// the least margin that it can have.
    fn look(&mut self, node: &Node) -> ([f64; 6], f64, Vec<Item>) {
        let at = 0.5 * (node.from + node.to);
        let half = 0.5 * (node.to - node.from);
        let middle = self.leg.joints(at, &node.joints);
        let end = self.leg.joints(node.to, &middle);
        let begin = self.leg.joints(node.from, &node.joints);
        let ends = [(node.from, begin), (at, middle), (node.to, end)];
        let frames = ends.map(|(s, joints)| self.frames(s, &joints, node));
        let rates = self.rates[node.piece as usize].clone();
        let (mut bound, mut settled, mut items) = (f64::INFINITY, f64::INFINITY, Vec::new());
        for item in &node.items {
            let pair = self.scene.watched[item.pair as usize];
            let required_m = self.required_m(&pair);
            let moving = &self.scene.moving[pair.a];
            let base = norm(frames[0].links[0].translation);
            let [speed, gain] = self.mover.speed(&rates, self.scene, &pair, base);
            let poses = [0, 1, 2].map(|i| self.relative(&frames[i], &pair));
            let (moved, sag) = (speed * half, gain * half * half / 8.0);
            // what is farther than this adds nothing; it falls with every sample
            let cutoff_of =
                |search: &Self| search.margin.min(search.horizon_m) - CLOSE_M + required_m;
            let (centre, radius) = moving.body.ball();
            let centre = poses[1].transform(centre);
            let into_body = poses[1].inverse();
            let apart_from = |other: &Body| {
                let (centre_b, radius_b) = other.ball();
                if radius_b.is_finite() {
                    moving.body.least_distance(into_body.transform(centre_b)) - radius_b - moved
                } else {
                    f64::NEG_INFINITY
                }
            };
            let judge = |search: &mut Self, other: &Body, item: Item, apart: f64| {
                let cutoff = cutoff_of(search);
                if apart >= cutoff {
                    return (apart - required_m, false);
                }
                let found = moving.body.nearest(&poses[1], other);
                search.note(item, &found, &frames[1], at, &middle);
                let mut least = found.distance_m - moved;
                if found.distance_m > 0.0 {
                    let n = found.normal;
                    let far = poses
                        .iter()
                        .map(|pose| moving.body.support_placed(pose, n))
                        .fold(f64::NEG_INFINITY, f64::max);
                    let stays = -other.support(n.map(|x| -x));
                    least = least.max(stays - far - sag);
                }
                (least - required_m, least < cutoff_of(search))
            };
            let mut keep = |item: Item, (least, open): (f64, bool)| {
                if open {
                    bound = bound.min(least);
                    items.push(item);
                } else {
                    settled = settled.min(least);
                }
            };
            match pair.b {
                Other::Moving(b) => {
                    let other = &self.scene.moving[b].body;
                    let judged = judge(self, other, *item, apart_from(other));
                    keep(*item, judged);
                }
                Other::Fixed(k) => match &self.scene.fixed[k].form {
                    FixedForm::Convex(other) => {
                        let judged = judge(self, other, *item, apart_from(other));
                        keep(*item, judged);
                    }
                    FixedForm::Mesh { triangles, .. } => {
                        if let Some(t) = item.triangle {
                            let body = &triangles.bodies[t as usize];
                            let judged = judge(self, body, *item, apart_from(body));
                            keep(*item, judged);
                            continue;
                        }
                        let cutoff = cutoff_of(self);
                        let reach = radius + moved + cutoff.max(0.0);
                        let mut near = Vec::new();
                        triangles.near(centre, reach, |t| {
                            let apart = apart_from(&triangles.bodies[t as usize]);
                            if apart < cutoff {
                                near.push((apart, t));
                            }
                        });
                        // the nearest first: what is found there settles most others
                        near.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
                        // what is not near is at least so far
                        keep(*item, (cutoff - required_m, false));
                        let mut some = Vec::new();
                        let mut least = f64::INFINITY;
                        for (apart, t) in near {
                            let item = Item {
                                triangle: Some(t),
                                ..*item
                            };
                            let judged = judge(self, &triangles.bodies[t as usize], item, apart);
                            if judged.1 {
                                least = least.min(judged.0);
                                some.push(item);
                            } else {
                                keep(item, judged);
                            }
                        }
                        if some.len() <= FEW {
                            for item in some {
                                keep(item, (least, true));
                            }
                        } else {
                            keep(*item, (least, true));
                        }
                    }
                },
            }
        }
        self.settled = self.settled.min(settled);
        (middle, bound, items)
    }
}

/// Names of closed meshes, each with a body that is inside it at these joints.
pub(crate) fn inside(scene: &Scene, mover: &Mover, leg: &Leg, joints: &[f64; 6]) -> Vec<usize> {
    let ride = leg.ride.as_deref();
    let frames = mover.frames(&scene.plates, ride, 0.0, joints, &leg.conditions);
    let mut pairs = Vec::new();
    for (index, pair) in scene.watched.iter().enumerate() {
        let Other::Fixed(k) = pair.b else { continue };
        if let FixedForm::Mesh { mesh, .. } = &scene.fixed[k].form
            && mesh.open_edges == 0
        {
            let moving = &scene.moving[pair.a];
            let point = frames.of(moving.on).transform(moving.body.some_point());
            if mesh.contains(point) {
                pairs.push(index);
            }
        }
    }
    pairs
}

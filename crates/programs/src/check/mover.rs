//! One model of the arm along a move: where its bodies are, and bounds of how fast they go.

use super::scene::{On, Other, Scene, Watched};
use super::sweep::{Frames, Rates, Sweep};
use crate::geometry::{Jet, Pose, Scalar};
use crate::model::effects::Deflection;
use crate::model::{Conditions, Model};
use crate::motion::leg::{Leg, Piece};
use crate::motion::ride::Ride;

/// One model of the arm that goes along the moves.
pub(crate) struct Mover<'a> {
    pub model: &'a Model,
    pub jet: &'a Model<Jet>,
    /// Lengths from frame to frame.
    pub reaches: [f64; 6],
    /// It is the real arm.
    pub is_real: bool,
}

impl Mover<'_> {
    /// Where the world of this arm at home is.
    fn carried<S: Scalar>(&self, ride: &Ride, s: S) -> Pose<S> {
        if self.is_real {
            ride.world_from_real_home(s)
        } else {
            ride.world_from_nominal_home(s)
        }
    }

    /// All frames in the world.
    pub(super) fn frames(
        &self,
        plates: &[usize],
        ride: Option<&Ride>,
        s: f64,
        joints: &[f64; 6],
        conditions: &Conditions,
    ) -> Frames {
        let links = self.model.link_frames(joints, conditions);
        let Some(ride) = ride else {
            let plates = Vec::new();
            return Frames { links, plates };
        };
        let carried = self.carried(ride, s);
        let plates = plates.iter();
        Frames {
            links: links.map(|link| carried * link),
            plates: plates
                .map(|plate| ride.world_from_plate(*plate, s, self.is_real))
                .collect(),
        }
    }

    pub(super) fn rates(&self, plates: &[usize], leg: &Leg, piece: &Piece) -> Rates {
        let mechanism = self.model.mechanism();
        let commanded = mechanism.commanded(&piece.joints);
        let deflection: Deflection<Jet> = self.jet.deflection(&piece.joints, &piece.conditions);
        let mut rates = Rates {
            turn: [0.0; 6],
            gain: [0.0; 6],
            world: [[0.0; 2]; 2],
            carried: 0.0,
            plates: Vec::new(),
        };
        for i in 0..6 {
            let real = commanded[i] + deflection.joints[i];
            rates.turn[i] = real.slope.magnitude();
            rates.gain[i] = real.bend.magnitude();
            for bend in deflection.links[i] {
                rates.turn[i] += bend.slope.magnitude();
                rates.gain[i] += bend.bend.magnitude() + bend.slope.magnitude().powi(2);
            }
        }
        if let Some(ride) = &leg.ride {
            let s = Jet::variable(piece.from, piece.to);
            let carried = Sweep::of(&self.carried(ride, s));
            rates.world = [[carried.turn, carried.gain], carried.at(carried.far)];
            rates.carried = carried.far;
            let frames = plates.iter();
            let frames = frames.map(|plate| ride.world_from_plate(*plate, s, self.is_real));
            rates.plates = frames.map(|frame| Sweep::of(&frame)).collect();
        }
        for (i, part) in deflection.world.iter().enumerate() {
            let kind = usize::from(i < 3);
            rates.world[kind][0] += part.slope.magnitude();
            rates.world[kind][1] += part.bend.magnitude() + part.slope.magnitude().powi(2);
        }
        rates
    }

    /// Bounds of speed and acceleration of the first body of a pair seen from the second, by s; the
    /// base is so far from the origin of the world.
    ///
    /// Seen from a frame that turns, `v' = v − v_o − ω × r` and `a' = a − a_o − α × r − ω × (ω × r) −
    /// 2 ω × v'` with r from its origin.
    pub(super) fn speed(
        &self,
        rates: &Rates,
        scene: &Scene,
        pair: &Watched,
        base: f64,
    ) -> [f64; 2] {
        let moving = &scene.moving[pair.a];
        let extent = moving.body.extent();
        let from = match pair.b {
            Other::Moving(b) => Some(scene.moving[b].on),
            Other::Fixed(_) => None,
        };
        let ([speed, gain], far) = match (moving.on, from) {
            (On::Link(on), Some(On::Link(from))) => {
                return self.along(rates, Some(from), on, extent, base);
            }
            (On::Link(on), _) => {
                let reach = self.reaches[..on].iter().sum::<f64>() + extent;
                // the base at home is no farther than where it is carried to, and so far back
                let far = base + 2.0 * rates.carried + reach;
                (self.along(rates, None, on, extent, base), far)
            }
            (On::Plate(plate), _) => {
                let plate = rates.plates[plate];
                (plate.at(extent), plate.far + extent)
            }
        };
        let Some(On::Plate(plate)) = from else {
            return [speed, gain];
        };
        let plate = rates.plates[plate];
        let [by, bent] = plate.at(far + plate.far);
        let speed = speed + by;
        [speed, gain + bent + 2.0 * plate.turn * speed]
    }

    /// The same of a body on link `on` seen from link `from`, or from the world.
    fn along(
        &self,
        rates: &Rates,
        from: Option<usize>,
        on: usize,
        extent: f64,
        base: f64,
    ) -> [f64; 2] {
        let (mut speed, mut gain, mut before) = (0.0, 0.0, 0.0);
        if from.is_none() {
            let far = base + self.reaches[..on].iter().sum::<f64>() + extent;
            let [turning, moving] = rates.world;
            speed += turning[0] * far + moving[0];
            gain += far * (turning[1] + turning[0] * turning[0]) + moving[1];
            before += turning[0];
        }
        for joint in from.unwrap_or(0)..on {
            // from the axis of this joint to the body's farthest point
            let far = self.reaches[joint + 1..on].iter().sum::<f64>() + extent;
            let turn = rates.turn[joint];
            speed += far * turn;
            gain += far * (turn * (turn + 2.0 * before) + rates.gain[joint]);
            before += turn;
        }
        [speed, gain]
    }
}

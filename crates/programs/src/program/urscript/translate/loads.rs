//! The load that the robot carries: mass and centre of gravity, as far as the text says them.

use super::super::syntax::{Cog, Event, Expr, ExprId, FunctionId, Payload};
use super::Translator;
use crate::geometry::units::DEG;
use crate::geometry::{Pose, Vector, dot, norm};
use crate::program::script::{self, Held, How, Remark};
use crate::program::{Load, number};

/// A profile whose gravity is farther from that of the file is of a robot that is mounted otherwise.
const MOST_TILT_DEG: f64 = 5.0;

/// What is set where the text is read from top to bottom: behind branches, loops and calls nothing
/// is known of it.
#[derive(Default)]
pub(super) struct Present {
    pub tool: Option<Pose>,
    /// Of the load, each as far as it is said.
    pub mass_kg: Option<f64>,
    pub cog_m: Option<Vector>,
    /// The load goes along with the tool.
    pub in_tool: Option<bool>,
}

impl Translator<'_, '_, '_> {
    /// Of each event, whether it is one of a branch or loop in which nothing sets a tool or a load,
    /// nor calls what may.
    pub(super) fn calm(&self, events: &[Event]) -> Vec<bool> {
        let parsed = self.goals.parsed;
        let sets = |event: &Event| match event {
            Event::Tool(..) | Event::Load(..) => true,
            Event::Call(call) => {
                let call = &parsed.calls[*call as usize];
                !self.goals.variables.is_of_language(call)
            }
            _ => false,
        };
        let mut calm = vec![false; events.len()];
        // of each open block its events and whether something in it sets
        let mut open: Vec<(Vec<usize>, bool)> = Vec::new();
        for (at, event) in events.iter().enumerate() {
            match event {
                Event::If | Event::Never | Event::Switch | Event::Loop => {
                    open.push((vec![at], false));
                }
                Event::Branch { .. } => {
                    if let Some((own, _)) = open.last_mut() {
                        own.push(at);
                    }
                }
                Event::EndIf | Event::EndLoop { .. } => {
                    let Some((own, is_set)) = open.pop() else {
                        continue;
                    };
                    for at in own.into_iter().chain([at]) {
                        calm[at] = !is_set;
                    }
                    if let Some((_, around)) = open.last_mut() {
                        *around |= is_set;
                    }
                }
                _ if sets(event) => {
                    if let Some((_, is_set)) = open.last_mut() {
                        *is_set = true;
                    }
                }
                _ => {}
            }
        }
        calm
    }

    /// The load becomes another.
    pub(super) fn load(&mut self, payload: Payload, function: FunctionId, offset: u32) {
        if payload.mass.is_none() && payload.cog == Cog::Stays {
            // it is what it was
            return;
        }
        let load = self.load_of(payload, function);
        self.present.in_tool = match payload.cog {
            Cog::Stays => self.present.in_tool,
            cog => Some(cog == Cog::Tool),
        };
        let (load, remark) = match load {
            Some(load) => (self.load_value(load), script::Expr::Absent),
            None => (self.unknown_load, self.unknown_load),
        };
        self.write(Some(self.load), How::Whole(load), offset);
        self.write(Some(self.load_remark), How::Whole(remark), offset);
    }

    /// The load behind a call, where the text says it; mass and centre of gravity may be said one
    /// by one.
    fn load_of(&mut self, payload: Payload, function: FunctionId) -> Option<Load> {
        let said = |mass| match self.goals.variables.follow(mass, function).0 {
            Expr::Number(mass_kg) => Some(mass_kg),
            _ => None,
        };
        let mass_kg = payload.mass.map_or(self.present.mass_kg, said);
        let cog_m = match payload.cog {
            Cog::Stays => self.present.cog_m,
            Cog::Tool => self.present.tool.map(|tool| tool.translation),
            Cog::At(cog) => self.three_numbers(cog, function),
        };
        (self.present.mass_kg, self.present.cog_m) = (mass_kg, cog_m);
        let (mass_kg, cog_m) = mass_kg.zip(cog_m)?;
        (mass_kg >= 0.0).then_some(Load { mass_kg, cog_m })
    }

    /// Refuses a profile of a robot that is mounted otherwise than the file says.
    ///
    /// # Source
    /// Universal Robots, "The `URScript` Programming Language", `set_gravity`: the acceleration away
    /// from the earth, along the axes of the base.
    pub(super) fn judge_gravity(&mut self) {
        let Some(of_profile) = self.goals.common.gravity_m_s2 else {
            return;
        };
        let parsed = self.goals.parsed;
        for &(value, function, offset) in &parsed.gravities {
            let Some(up) = self.three_numbers(value, function) else {
                continue;
            };
            let long = norm(up) * norm(of_profile);
            let cosine = -dot(up, of_profile) / long;
            let angle = cosine.clamp(-1.0, 1.0).acos() / DEG;
            // of nothing there is no direction
            if angle.is_nan() || angle <= MOST_TILT_DEG {
                continue;
            }
            let message = format!(
                "the robot is mounted with gravity along ({}), and `gravity_m_s2` of the profile is \
                 {angle:.0} deg from it",
                up.map(|x| format!("{}", 0.0 - x)).join(", ")
            );
            let hint = "write how this robot is mounted into `gravity_m_s2` of its profile, along \
                the axes of its base, or correct set_gravity";
            self.say(
                offset,
                Remark::error_about("gravity-differs", message, hint),
            );
        }
    }

    /// `[0, 0, 0.05]`
    fn three_numbers(&self, value: ExprId, function: FunctionId) -> Option<Vector> {
        let (Expr::Literal(id), _) = self.goals.variables.follow(value, function) else {
            return None;
        };
        let literal = self.goals.parsed.literal(id);
        if literal.elements != 3 || literal.pose {
            return None;
        }
        let (start, end) = (literal.offset as usize + 1, literal.end as usize - 1);
        let inside = self.goals.parsed.text.get(start..end)?;
        let mut values = inside
            .split(|b| *b == b',')
            .map(|text| number::parse(text.trim_ascii()));
        Some([values.next()??, values.next()??, values.next()??])
    }

    fn load_value(&mut self, load: Load) -> script::Expr {
        let [x, y, z] = load.cog_m;
        let key = [load.mass_kg, x, y, z].map(f64::to_bits);
        let script = &mut self.goals.builder.script;
        let value = *self
            .loads
            .entry(key)
            .or_insert_with(|| script.value(Held::Load(Some(load))));
        script::Expr::Value(value)
    }
}

//! Tools and frames: where they are, as far as the files tell.

use super::code::Reference;
use super::data::{Element, Father, Kind};
use super::reader::{Reader, functions};
use super::remarks::{
    FRAME_CHOSEN, FRAME_OF_POINTS_UNUSED, endless_fathers, frame_assigned, frame_of_points,
};
use super::targets::{Of, pose_of};
use crate::geometry::Pose;
use crate::program::displacing::Displacing;
use crate::program::kit;
use crate::program::script::{
    DISPLACED_SOMEHOW, DisplacementId, Expr, Held, NamedFrame, Place, Remark, UNBOUNDED, VariableId,
};
use crate::program::transformations::Steps;
use crate::program::words::Words;
use crate::program::{Displacement, MOST_ANGLE_DEG, Shape, Shift, Source};

/// A `compose` of the code.
#[derive(Debug)]
pub(super) struct Composed<'a> {
    displacement: DisplacementId,
    base: Expr,
    /// The frame that it names, and the project that does.
    asked: (u32, Father<'a>),
    by: Steps,
}

/// A `setFrame(origin,x,xy,frame)` of the code.
#[derive(Debug)]
pub(super) struct Framing {
    points: Vec<VariableId>,
    /// Index in [`super::project::World::data`]; `None` where it is no frame of a project.
    frame: Option<u32>,
    place: Place,
}

/// Frames on frames.
const LONGEST_CHAIN: u32 = 32;

impl<'a> Reader<'a> {
    /// What `compose` does to a position, known once all copies are.
    pub(super) fn compose(
        &mut self,
        base: Expr,
        frame: Words<'a, '_>,
        by: Steps,
    ) -> DisplacementId {
        let name = Reference::whole(frame).and_then(|name| Some((name, name.key?)));
        // what a program's own frame is, is not followed
        let name = name.filter(|(name, _)| {
            let known = self.meaning(name);
            known.is_none_or(|known| matches!(known.of, Of::Project(_)))
        });
        if by.is_unknown() {
            return DISPLACED_SOMEHOW;
        }
        let Some((name, index)) = name else {
            return UNBOUNDED;
        };
        let asked = Father {
            alias: name.alias,
            name: name.name,
            index,
        };
        let nothing = Displacement::By(Box::new(Shift::none()));
        let displacement = self.builder.script.displacement(nothing);
        self.composed.push(Composed {
            displacement,
            base,
            asked: (self.here.project, asked),
            by,
        });
        displacement
    }

    /// Finds the displacements of all `compose`.
    pub(super) fn settle_composed(&mut self) {
        for composed in std::mem::take(&mut self.composed) {
            let at = composed.displacement as usize;
            // of what the text tells and is not followed nothing is known
            let by = self.composed_by(composed);
            self.builder.script.displacements[at] = by.unwrap_or(Displacement::Unbounded);
        }
    }

    /// What a `compose` does to a position, in its own frame.
    fn composed_by(&self, composed: Composed<'a>) -> Option<Displacement> {
        let [only] = self.fathers(composed.base)[..] else {
            return None;
        };
        let (own, asked) = (self.variables.fathers[only as usize], composed.asked);
        let datum = |(project, of): (u32, Father<'a>)| {
            let datum = self.world.datum(project, of.alias, of.name)?;
            Some((datum, of.index))
        };
        let place = |(project, father)| self.chain(project, father, Kind::Frame, 0).ok().flatten();
        let own_from_asked = if datum(own).is_some_and(|own| Some(own) == datum(asked)) {
            Pose::identity()
        } else {
            place(own)?.inverse() * place(asked)?
        };
        if let Some(by) = composed.by.exact() {
            return Some(Displacement::By(Box::new(Shift {
                in_frame: own_from_asked * by * own_from_asked.inverse(),
                in_tool: Pose::identity(),
            })));
        }
        let mut by = Displacing::new();
        let is_followed = composed.by.in_frame(&own_from_asked.rotation, &mut by);
        is_followed.then(|| by.displacement())
    }

    /// `setFrame(origin,x,xy,frame)`
    pub(super) fn set_frame(&mut self, line: Words<'a, '_>, at: usize) {
        let given = line.inside(at + 1).0.list();
        let Some((frame, points)) = given.split_last() else {
            return;
        };
        let mut all = Vec::new();
        for point in points {
            let point = self.position(*point);
            all.extend(self.roots(point));
        }
        self.framing.push(Framing {
            points: all,
            frame: Reference::of(*frame).and_then(|name| self.project_frame(&name)),
            place: self.place(line.span().start),
        });
    }

    fn project_frame(&self, name: &Reference) -> Option<u32> {
        match self.meaning(name)?.of {
            Of::Project(datum) if self.world.data[datum as usize].kind == Kind::Frame => {
                Some(datum)
            }
            _ => None,
        }
    }

    /// Notes the frames that a statement names, but for those that `setFrame` makes, where programs
    /// change any.
    pub(super) fn note_frames(&mut self, line: Words<'a, '_>) {
        if self.assigned.is_empty() {
            return;
        }
        let sets = functions(line).find(|at| line.text(*at) == b"setFrame");
        let names = (0..sets.unwrap_or(line.len())).filter_map(|at| {
            let is_inside = at > 0 && (line.is(at - 1, b'.') || line.is(at - 1, b':'));
            Reference::of(line.behind(at)).filter(|_| !is_inside)
        });
        let frames: Vec<u32> = names.filter_map(|name| self.project_frame(&name)).collect();
        self.named_frames.extend(frames);
    }

    /// Points that a frame is made of stay as they are where something uses that frame.
    pub(super) fn settle_framing(&mut self) {
        for framing in std::mem::take(&mut self.framing) {
            let targets = self.declared_targets(framing.points);
            let source = &self.sources[framing.place.file as usize];
            let (line, _) = source.line_column(framing.place.offset as usize);
            let is_used = framing.frame.is_none_or(|frame| self.is_used(frame));
            for &target in targets.iter().filter(|_| is_used) {
                let remark = frame_of_points(&source.name, line);
                self.builder.script.refuse(target, remark);
            }
            if !is_used && !targets.is_empty() {
                let script = &mut self.builder.script;
                script.say(self.sources, framing.place, FRAME_OF_POINTS_UNUSED);
            }
        }
    }

    /// Whether programs name a frame, or points that hang on it.
    fn is_used(&self, frame: u32) -> bool {
        let fathers = self.variables.named().into_iter();
        let mut fathers = fathers.map(|target| self.variables.father_of[target] as usize);
        let on_it = |father: usize| {
            let mut next: Option<(u32, Father)> = Some(self.variables.fathers[father]);
            for _ in 0..LONGEST_CHAIN {
                let Some((project, of)) = next else {
                    return false;
                };
                let Some(datum) = self.world.datum(project, of.alias, of.name) else {
                    return false;
                };
                if datum == frame {
                    return true;
                }
                let data = &self.world.data[datum as usize];
                let at = data.element(of.index);
                next = at.map(|at| (data.project, data.elements[at].father));
            }
            true
        };
        self.named_frames.contains(&frame) || fathers.any(on_it)
    }

    /// The tool that an argument is.
    pub(super) fn tool(&mut self, words: Words<'a, '_>) -> Expr {
        let Some(name) = Reference::whole(words) else {
            return self.unknown(FRAME_CHOSEN);
        };
        match self.meaning(&name) {
            Some(known) if known.kind == Kind::Tool => self.named(&name),
            Some(_) => self.unknown(FRAME_CHOSEN),
            None => {
                let words = (self.here.project, (name.alias, name.name, name.key));
                if let Some(known) = self.variables.tools_by_words.get(&words) {
                    return *known;
                }
                let is_flange = name.name == b"flange";
                let asked = match name.key {
                    _ if is_flange => "flange".to_owned(),
                    Some(key) => asked_name(name.alias, name.name, key),
                    None => return self.unknown(FRAME_CHOSEN),
                };
                let meant = self.world.meant_by(self.here.project, name.alias);
                let asked = (asked, meant);
                let known = self.variables.tools.get(&asked).copied();
                let tool = known.unwrap_or_else(|| {
                    let made = self.frame_value(&asked.0, is_flange.then(Pose::identity));
                    if !is_flange {
                        self.asked.push((made, asked.clone(), self.here.project));
                    }
                    self.variables.tools.insert(asked, made);
                    made
                });
                self.variables.tools_by_words.insert(words, tool);
                tool
            }
        }
    }

    pub(super) fn frame_value(&mut self, name: &str, pose: Option<Pose>) -> Expr {
        Expr::Value(self.builder.script.frame(name, pose))
    }

    /// A tool as it is declared: on the flange, or on other tools.
    pub(super) fn tool_value(&mut self, datum: u32, at: usize, name: &str) -> Expr {
        let pose = match self.placed(datum, at, name, 0) {
            Ok(pose) => pose,
            Err(remark) => return self.unknown(remark),
        };
        let element = &self.world.data[datum as usize].elements[at];
        let is_on_tool = !matches!(element.father.name, b"flange" | b"");
        let made = NamedFrame {
            on_tool: is_on_tool.then(|| pose_of(&element.numbers).translation),
            ..NamedFrame::still(name, pose)
        };
        Expr::Value(self.builder.script.value(Held::Frame(made)))
    }

    /// Where a frame is in the world, or a tool on the flange: the product of its fathers and
    /// itself; `None` where the files do not tell.
    fn placed(
        &self,
        datum: u32,
        at: usize,
        name: &str,
        depth: u32,
    ) -> Result<Option<Pose>, Remark> {
        let of = &self.world.data[datum as usize];
        let own = own_pose(&of.elements[at], name)?;
        let father = self.chain(of.project, of.elements[at].father, of.kind, depth)?;
        Ok(father.map(|father| father * own))
    }

    /// Where a father is.
    fn chain(
        &self,
        project: u32,
        father: Father<'a>,
        kind: Kind,
        depth: u32,
    ) -> Result<Option<Pose>, Remark> {
        let is_last = match kind {
            Kind::Tool => father.name == b"flange",
            _ => father.name == b"world",
        };
        if is_last || father.name.is_empty() {
            return Ok(Some(Pose::identity()));
        }
        let Some(datum) = self.world.datum(project, father.alias, father.name) else {
            return Ok(None);
        };
        let of = &self.world.data[datum as usize];
        let name = Source::text(of.name);
        if let Some(place) = self.assigned.get(&datum) {
            let source = &self.sources[place.file as usize];
            let (line, _) = source.line_column(place.offset as usize);
            return Err(frame_assigned(&name, Some((&source.name, line))));
        }
        match of.element(father.index) {
            Some(at) if of.kind == kind && depth < LONGEST_CHAIN => {
                self.placed(datum, at, &name, depth + 1)
            }
            Some(_) if of.kind == kind => Err(endless_fathers(&name)),
            _ => Ok(None),
        }
    }

    /// What the point of a variable hangs on, an index in [`super::targets::Variables::fathers`];
    /// `None` where it is declared as no point.
    fn father(&self, variable: VariableId) -> Option<u32> {
        let script = &self.builder.script;
        match script.variables[variable as usize].declared {
            Expr::Target(target) => {
                let is_point = script.targets[target].layout.shape == Shape::Pose;
                let father = self.variables.father_of.get(target);
                father.filter(|_| is_point).copied()
            }
            _ => None,
        }
    }

    /// What the points hang on that a position may be declared with or a copy of.
    fn fathers(&self, position: Expr) -> Vec<u32> {
        let mut open = self.roots(position);
        let (mut seen, mut found) = (foldhash::HashSet::default(), Vec::new());
        while let Some(variable) = open.pop() {
            if let Some(copies) = self.copies.get(&variable) {
                if !seen.insert(variable) {
                    continue;
                }
                open.extend(copies);
            }
            if let Some(father) = self.father(variable)
                && !found.contains(&father)
            {
                found.push(father);
            }
        }
        found
    }

    /// The work frames of all points that the programs name: a copy of a point is in its frame, too.
    pub(super) fn frame_points(&mut self) {
        for target in self.variables.named() {
            let father = self.variables.father_of[target];
            if self.builder.script.targets[target].layout.shape == Shape::Pose {
                let frame = self.frame(father);
                self.builder.script.own_frames.push((target, frame));
            }
        }
    }

    /// Tools and frames that several projects ask for by one name, and do not mean the same, have
    /// that of the project in front.
    pub(super) fn tell_apart(&mut self) {
        let all = std::mem::take(&mut self.asked);
        for (made, (name, meant), project) in &all {
            let mut others = all
                .iter()
                .filter(|(_, (other, of), _)| other == name && of != meant);
            let Some(_) = others.next() else { continue };
            let label = self.world.label(*project);
            if let Expr::Value(value) = made
                && let Held::Frame(frame) = &mut self.builder.script.values[*value as usize]
            {
                frame.name = format!("{label}/{name}").into();
            }
        }
    }

    fn frame(&mut self, place: u32) -> Expr {
        if let Some(known) = self.variables.frames[place as usize] {
            return known;
        }
        let (project, father) = self.variables.fathers[place as usize];
        let declared = self.world.datum(project, father.alias, father.name);
        let named = declared.filter(|_| !father.is_world()).and_then(|datum| {
            let of = &self.world.data[datum as usize];
            Some(of.name_of(of.element(father.index)?))
        });
        let mut asked = None;
        let name = match named {
            Some(name) => name,
            None if father.is_world() => "world".to_owned(),
            None => {
                let name = asked_name(father.alias, father.name, father.index);
                asked = Some((name.clone(), self.world.meant_by(project, father.alias)));
                name
            }
        };
        let made = match self.chain(project, father, Kind::Frame, 0) {
            Ok(pose) => self.frame_value(&name, pose),
            Err(remark) => self.unknown(remark),
        };
        self.asked.extend(asked.map(|asked| (made, asked, project)));
        self.variables.frames[place as usize] = Some(made);
        made
    }
}

/// What a tool or frame that the files do not have is asked for by: `alias:name[index]`, without
/// what is not said and the first index.
fn asked_name(alias: &[u8], name: &[u8], index: &[u8]) -> String {
    let mut asked = [alias, b":", name].concat();
    if alias.is_empty() {
        asked.remove(0);
    }
    if !matches!(index, b"" | b"0") {
        asked.extend([b"[", index, b"]"].concat());
    }
    Source::text(&asked).into_owned()
}

/// The pose of a tool or frame on its father.
fn own_pose(element: &Element, name: &str) -> Result<Pose, Remark> {
    let angles = element.numbers[3..].iter().map(|number| number.value);
    match angles
        .into_iter()
        .find(|angle| angle.abs() > MOST_ANGLE_DEG)
    {
        None => Ok(pose_of(&element.numbers)),
        Some(angle) => {
            let hint = "rx, ry and rz are in degrees: write them between -360 and 360";
            Err(kit::angle_too_large(name, angle, hint))
        }
    }
}

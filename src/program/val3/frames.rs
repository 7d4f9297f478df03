//! Tools and frames: where they are, as far as the files tell.

use super::data::{Element, Father, Kind};
use super::line::{Index, Line};
use super::reader::Reader;
use super::remarks::{frame_assigned, frame_chosen};
use super::targets::{Place, pose_of};
use crate::geometry::Pose;
use crate::program::script::{Expr, Held, NamedFrame, Remark, VariableId};
use crate::program::{Shift, Source};

/// No tool or frame is rotated by more, degrees.
const MOST_ANGLE: f64 = 720.0;
/// Frames on frames.
const LONGEST_CHAIN: u32 = 32;

impl<'a> Reader<'a> {
    /// What `compose` does to points of these variables, in their own frame.
    pub(super) fn composed(
        &self,
        of: &[VariableId],
        frame: &Line<'a, '_>,
        by: Pose,
    ) -> Option<Shift> {
        let fathers: Option<Vec<(u32, Father)>> = of.iter().map(|one| self.father(*one)).collect();
        let fathers = fathers?;
        let (first, rest) = fathers.split_first()?;
        if rest.iter().any(|other| other != first) {
            return None;
        }
        let name = frame.reference(0).filter(|name| !name.has_field)?;
        let index = match name.index {
            Index::None => b"0",
            Index::Key(key) => key,
            Index::Any => return None,
        };
        let asked = Father {
            alias: name.alias,
            name: name.name,
            index,
        };
        let place = |project, father| self.chain(project, father, Kind::Frame, 0).ok().flatten();
        let world_from_own = place(first.0, first.1)?;
        let world_from_asked = place(self.here.project, asked)?;
        let own_from_asked = world_from_own.inverse() * world_from_asked;
        Some(Shift {
            in_frame: own_from_asked * by * own_from_asked.inverse(),
            in_tool: Pose::identity(),
        })
    }

    /// The tool that an argument is.
    pub(super) fn tool(&mut self, text: &Line<'a, '_>) -> (Expr, Vec<VariableId>) {
        let name = text
            .reference(0)
            .filter(|name| name.words == text.tokens.len() && !name.has_field);
        let Some(name) = name else {
            return (self.unknown(frame_chosen()), Vec::new());
        };
        let kind = self.kind_of(&name);
        match self.meaning(&name) {
            Place::Missing if name.name == b"flange" => {
                let pose = Some(Pose::identity());
                (self.frame_value("flange".to_owned(), pose), Vec::new())
            }
            Place::Missing => {
                let name = Source::text(name.name).into_owned();
                (self.unknown_frame(&name), Vec::new())
            }
            _ if kind == Kind::Tool => self.named(&name),
            _ => (self.unknown(frame_chosen()), Vec::new()),
        }
    }

    fn frame_value(&mut self, name: String, pose: Option<Pose>) -> Expr {
        self.value(Held::Frame(NamedFrame {
            on: Box::default(),
            name: name.into(),
            pose,
            load: None,
        }))
    }

    pub(super) fn unknown_frame(&mut self, name: &str) -> Expr {
        self.frame_value(name.to_owned(), None)
    }

    /// A tool as it is declared: on the flange, or on other tools.
    pub(super) fn tool_value(&mut self, datum: u32, at: usize, name: &str) -> Expr {
        let element = &self.world.data[datum as usize].elements[at];
        let project = self.world.project_of_data[datum as usize];
        let own = own_pose(element, name);
        let father = self.chain(project, element.father, Kind::Tool, 0);
        match father.and_then(|father| Ok((father, own?))) {
            Ok((father, own)) => self.frame_value(name.to_owned(), father.map(|f| f * own)),
            Err(remark) => self.unknown(remark),
        }
    }

    /// Where a frame is in the world, or a tool on the flange: the product of its fathers and
    /// itself; `None` where the files do not tell.
    fn chain(
        &self,
        project: u32,
        father: Father<'a>,
        kind: Kind,
        depth: u32,
    ) -> Result<Option<Pose>, Remark> {
        let last: &[u8] = if kind == Kind::Tool {
            b"flange"
        } else {
            b"world"
        };
        if father.name.is_empty() || father.name == last {
            return Ok(Some(Pose::identity()));
        }
        let Some((project, datum)) = self.datum_of(project, father) else {
            return Ok(None);
        };
        let of = &self.world.data[datum as usize];
        let name = Source::text(of.name);
        if self.assigned.contains(&datum) {
            return Err(frame_assigned(&name));
        }
        let Some(at) = of.element(father.index) else {
            return Ok(None);
        };
        if of.kind != kind || depth == LONGEST_CHAIN {
            return Ok(None);
        }
        let element = &of.elements[at];
        let own = own_pose(element, &name)?;
        let father = self.chain(project, element.father, kind, depth + 1)?;
        Ok(father.map(|father| father * own))
    }

    fn datum_of(&self, project: u32, name: Father<'a>) -> Option<(u32, u32)> {
        let project = match name.alias {
            b"" => project,
            alias => self.world.library(project, alias)?,
        };
        let data = &self.world.projects[project as usize].data;
        data.get(name.name).map(|datum| (project, *datum))
    }

    /// The frame that the point of a variable hangs on; `None` where it is declared as no point.
    fn father(&self, variable: VariableId) -> Option<(u32, Father<'a>)> {
        let (datum, at) = *self.variables.declared.get(&variable)?;
        let of = &self.world.data[datum as usize];
        let project = self.world.project_of_data[datum as usize];
        let is_point = of.kind == Kind::Point && of.elements[at].is_given;
        is_point.then(|| (project, of.elements[at].father))
    }

    /// The work frame of the points that variables are declared with or may be copies of.
    pub(super) fn frame_of(&mut self, roots: &[VariableId]) -> Expr {
        let (mut seen, mut open) = (foldhash::HashSet::default(), roots.to_vec());
        let mut found: Option<Expr> = None;
        while let Some(variable) = open.pop() {
            if !seen.insert(variable) {
                continue;
            }
            open.extend(self.copies.get(&variable).into_iter().flatten());
            let Some((project, father)) = self.father(variable) else {
                continue;
            };
            let frame = self.frame(project, father);
            if found.is_some_and(|other| other != frame) {
                return self.unknown(frame_chosen());
            }
            found = Some(frame);
        }
        found.unwrap_or(Expr::Absent)
    }

    fn frame(&mut self, project: u32, father: Father<'a>) -> Expr {
        // the world is the same for all
        let key = match father.name {
            b"" | b"world" => (0, Father::default()),
            _ => (project, father),
        };
        if let Some(known) = self.variables.frames.get(&key) {
            return *known;
        }
        let name = match self.datum_of(project, father) {
            _ if father.name.is_empty() || father.name == b"world" => "world".to_owned(),
            Some((_, datum)) => {
                let of = &self.world.data[datum as usize];
                let at = of.element(father.index);
                at.map_or_else(
                    || Source::text(father.name).into_owned(),
                    |at| of.name_of(at),
                )
            }
            None => Source::text(father.name).into_owned(),
        };
        let made = match self.chain(project, father, Kind::Frame, 0) {
            Ok(pose) => self.frame_value(name, pose),
            Err(remark) => self.unknown(remark),
        };
        self.variables.frames.insert(key, made);
        made
    }
}

/// The pose of a tool or frame on its father.
fn own_pose(element: &Element, name: &str) -> Result<Pose, Remark> {
    let angles = element.numbers[3..].iter().map(|number| number.value);
    match angles.into_iter().find(|angle| angle.abs() > MOST_ANGLE) {
        None => Ok(pose_of(&element.numbers)),
        Some(angle) => Err(Remark::error(
            "angle-too-large",
            format!("`{name}` has an angle of {angle} deg; the limit is {MOST_ANGLE} deg"),
            "rx, ry and rz are in degrees: write them between -360 and 360",
        )),
    }
}

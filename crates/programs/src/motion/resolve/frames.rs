//! Tools and frames of moves.

use super::{Refused, Resolver};
use crate::geometry::Pose;
use crate::motion::holding::Atom;
use crate::program::script::{
    Expr, Factor, Held, NOT_DISPLACED, NamedFrame, Place, Remark, ValueId,
};
use crate::program::{
    Frame, FrameId, Load, MOST_ANGLE_DEG, ReadError, Role, TargetId, Tool, ToolId, Value as Meaning,
};

impl Resolver<'_, '_> {
    /// The pose, name and load of what a move has as a tool or frame.
    pub(super) fn named(
        &mut self,
        atom: Atom,
        is_tool: bool,
    ) -> Result<Result<NamedFrame, Refused>, ReadError> {
        let nameless = NamedFrame::still("", None);
        Ok(match atom {
            Atom::Value(ValueId::MAX) => Ok(nameless),
            Atom::Value(value) => match self.flow.value(value).clone() {
                Held::Frame(frame) => Ok(frame),
                Held::Record { name, parts, on } => {
                    let parts = self.flow.parts_of(&parts);
                    let found = self
                        .language
                        .frame_of(is_tool, &name, &parts, self.sources)?;
                    match found {
                        Ok(mut frame) => {
                            frame.on = if on.is_empty() { frame.on } else { on };
                            Ok(frame)
                        }
                        Err(remark) => {
                            let known = self.report.remark(remark);
                            Err(Refused::Said(known))
                        }
                    }
                }
                Held::Product {
                    name,
                    of,
                    otherwise,
                } => match self.product(&of, is_tool)? {
                    Some(pose) => Ok(NamedFrame::still(name, Some(pose))),
                    None => Err(Refused::Said(otherwise)),
                },
                Held::Number(number) => Ok(NamedFrame {
                    name: number.to_string().into(),
                    ..nameless
                }),
                Held::Remark(remark) => Err(Refused::Said(remark)),
                Held::Actual
                | Held::ActualWith { .. }
                | Held::NearActual
                | Held::Shift(_)
                | Held::Load(_)
                | Held::LoadOf { .. }
                | Held::Carried(_)
                | Held::Flag(_)
                | Held::ExternalOffset(_)
                | Held::AxesOff(_) => Err(Refused::NoFrame),
            },
            Atom::Target {
                target,
                displacement: NOT_DISPLACED,
            } => self.target_as_frame(target as usize),
            Atom::Target { .. } | Atom::Changed { .. } | Atom::Anything | Atom::Uncertain => {
                Err(Refused::Chosen)
            }
            Atom::Unknown(remark) => Err(Refused::Said(remark)),
        })
    }

    /// The product of frames, where they stand still and are known.
    fn product(&mut self, of: &[Factor], is_tool: bool) -> Result<Option<Pose>, ReadError> {
        let mut product = Pose::identity();
        for factor in of {
            let atom = match *factor {
                Factor::Value(value) => Atom::Value(value),
                Factor::Target(target) => Atom::Target {
                    target,
                    displacement: NOT_DISPLACED,
                },
            };
            let found = self.named(atom, is_tool)?.ok();
            let still = found.filter(|frame| frame.on.is_empty());
            let Some(pose) = still.and_then(|frame| frame.pose) else {
                return Ok(None);
            };
            product = product * pose;
        }
        Ok(Some(product))
    }

    /// A position that stands for a tool or frame.
    pub(super) fn target_as_frame(&mut self, target: TargetId) -> Result<NamedFrame, Refused> {
        let program = &*self.report.program;
        let found = &program.targets[target];
        let place = Place {
            file: found.file,
            offset: found.offset,
        };
        let name = found.name.clone().unwrap_or_default();
        let numbers = program.numbers_of(found).iter();
        let mut angles = numbers
            .zip(self.language.roles(found.layout))
            .filter(|(_, role)| **role == Role::Orientation)
            .map(|(number, _)| number.value);
        if let Some(angle) = angles.find(|angle| angle.abs() > MOST_ANGLE_DEG) {
            let remark = Remark::error_about(
                "angle-too-large",
                format!(
                    "tool or frame `{name}` has an angle of {angle}; the limit is {MOST_ANGLE_DEG}"
                ),
                "is it in the unit of the language? write angles of a few rotations at most",
            );
            return Err(Refused::Said(self.report.remark(remark)));
        }
        let meaning = crate::program::meaning(self.language, program, self.settings, target);
        self.as_frames.entry(target).or_insert(place);
        match meaning.map(|decoded| decoded.value) {
            Some(Meaning::Pose(pose)) => Ok(NamedFrame::still(name, Some(pose))),
            _ => Err(Refused::NoFrame),
        }
    }

    pub(super) fn tool(
        &mut self,
        atom: Atom,
        (load, set): (Option<ValueId>, Place),
    ) -> Result<Result<ToolId, Refused>, ReadError> {
        if let Some(known) = self.tools.get(&(atom, load)) {
            return Ok(*known);
        }
        let named = self.named(atom, true)?;
        if let (Ok(frame), Some(load)) = (&named, load)
            && let Held::LoadOf { tool, otherwise } = self.flow.value(load)
            && frame.name != *tool
        {
            let remark = &self.script.remarks[*otherwise as usize];
            self.report.say_once(remark, set);
        }
        let (own_load, carried) = match load.map(|load| self.flow.value(load)) {
            Some(Held::Load(load)) => (Some(*load), None),
            Some(Held::Carried(part)) => (None, *part),
            _ => (None, None),
        };
        let made = named.map(|frame| {
            let load: Option<Load> = own_load.unwrap_or(frame.load);
            let tools = &mut self.report.program.tools;
            tools.push(Tool {
                name: frame.name.into(),
                flange_from_tool: frame.pose,
                load,
                carried,
                on_tool: frame.on_tool,
            });
            tools.len() - 1
        });
        self.tools.insert((atom, load), made);
        Ok(made)
    }

    /// The work frames that targets have of their own.
    pub(super) fn find_own_frames(&mut self) -> Result<(), ReadError> {
        for &(target, frame) in &self.script.own_frames {
            let atom = match frame {
                Expr::Value(value) => Atom::Value(value),
                Expr::Unknown(remark) => Atom::Unknown(remark),
                _ => Atom::Anything,
            };
            let frame = self.frame(atom)?;
            self.own_frames.insert(target, frame);
        }
        Ok(())
    }

    pub(super) fn frame(&mut self, atom: Atom) -> Result<Result<FrameId, Refused>, ReadError> {
        if let Some(known) = self.frames.get(&atom) {
            return Ok(*known);
        }
        let named = self.named(atom, false)?;
        let made = named.map(|frame| {
            let frames = &mut self.report.program.frames;
            frames.push(Frame {
                name: frame.name.into(),
                world_from_frame: frame.pose,
                on: frame.on,
                stand: None,
            });
            frames.len() - 1
        });
        self.frames.insert(atom, made);
        Ok(made)
    }
}

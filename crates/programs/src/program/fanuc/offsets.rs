//! What `Offset` and `Tool_Offset` add to the points of moves.
//!
//! `Offset,PR[n]` adds along the axes of the user frame, `Tool_Offset,PR[n]` along and about those
//! of the tool. About what `Offset` rotates is *not verified on a controller*: where the text tells
//! a rotation, nothing is taken for known.

use super::content::{Entered, canonical};
use super::numbers::{ELEMENTS, Known, OF_ARM, of_position};
use super::reader::{Listing, Reader};
use super::words::{Named, each_position, position, register, whole};
use crate::geometry::Pose;
use crate::geometry::units::MM;
use crate::program::displacing::Displacing;
use crate::program::notation::pose_of_angles;
use crate::program::quantity::Quantity;
use crate::program::script::{DISPLACED_SOMEHOW, Expr, RoutineId, UNBOUNDED, VariableId, short};
use crate::program::{Displacement, External, ExternalUse, Shape, TargetId};
use foldhash::{HashMap, HashSet};
use std::ops::Range;
use std::rc::Rc;

/// The external axes of group 1, whose numbers stand behind those of the arm.
pub(super) const EXTENDED: [&str; 3] = ["E1", "E2", "E3"];

/// In which axes an offset counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Axes {
    /// Those of the user frame.
    Frame,
    Tool,
    /// What a camera sees.
    Vision,
    /// A word of another dictionary.
    Other,
}

impl Axes {
    /// `OFFSET`, `WKZ_OFFSET`; `None` where the word, in capitals, is none such.
    pub(super) fn of(word: &[u8]) -> Option<Self> {
        let before = word.strip_suffix(b"OFFSET")?;
        Some(match before {
            b"" => Self::Frame,
            b"TOOL_" | b"WKZ_" => Self::Tool,
            b"V" => Self::Vision,
            _ => Self::Other,
        })
    }
}

/// Which register has the numbers.
#[derive(Clone, Debug)]
enum Which {
    One(u32),
    /// One of a few, as another register says.
    Few(Vec<u32>),
    /// Another register says it.
    Index(Box<[u8]>),
    /// The condition of the program.
    Condition,
}

/// An offset of a move.
#[derive(Debug)]
struct Amount {
    axes: Axes,
    of: Which,
    /// What the program has just written.
    now: Vec<Option<Rc<Entered>>>,
}

/// A move with offsets.
#[derive(Debug)]
pub(super) struct Offset {
    instructions: Range<usize>,
    routine: RoutineId,
    amounts: Vec<Amount>,
    /// The tool and the frame that its points were taught with.
    numbers: [Option<u32>; 2],
}

/// `OFFSET CONDITION PR[1],UFRAME[2]`
#[derive(Debug)]
pub(super) struct Condition {
    routine: RoutineId,
    axes: Axes,
    of: Which,
    /// The tool or frame, where it is named.
    #[allow(clippy::option_option)]
    number: Option<Option<u32>>,
}

/// Which registers points are copied into.
#[derive(Debug, Default)]
pub(super) struct Copied {
    /// From a register, or any; into one, or any.
    from: Vec<(Option<u32>, Option<u32>)>,
    /// Likewise, with what is added and subtracted again: that is joints or none.
    pub forms: Vec<(Option<u32>, Option<u32>)>,
    points: Vec<(TargetId, bool, Option<u32>)>,
    /// Registers with joints.
    joints: HashSet<Option<u32>>,
    held: HashSet<Option<u32>>,
}

impl Copied {
    /// A register becomes a position, which `text` says, and `whole` with what leaves nothing.
    pub(super) fn copy(&mut self, listing: &Listing, to: Option<u32>, text: &[u8], whole: &[u8]) {
        if memchr::memmem::find(whole, b"JPOS").is_some() {
            self.joints.insert(to);
        }
        each_position(whole, |named| {
            if let Named::Register(register) = named {
                self.forms.push((register.number, to));
            }
        });
        each_position(text, |named| match named {
            Named::Register(register) => self.from.push((register.number, to)),
            Named::Point(number) => {
                let index = listing.by_number.get(&number);
                let point = index.map(|index| listing.points[*index as usize]);
                if let Some((target, point)) = point.and_then(|p| Some((p.target?, p))) {
                    self.points.push((target, point.is_joints, to));
                }
            }
            Named::AnyPoint => {
                let all = listing.points.iter();
                let all = all.filter_map(|point| Some((point.target?, point.is_joints, to)));
                self.points.extend(all);
            }
            Named::Computed => {}
        });
    }

    /// Whether a register may hold a point.
    pub(super) fn holds(&self, register: u32) -> bool {
        is_in(&self.held, Some(register))
    }

    /// Whether a register may hold joints.
    pub(super) fn is_joints(&self, register: Option<u32>) -> bool {
        is_in(&self.joints, register)
    }

    /// All registers that these flow into.
    pub(super) fn spread(
        edges: impl Iterator<Item = (Option<u32>, Option<u32>)>,
        first: &HashSet<Option<u32>>,
    ) -> HashSet<Option<u32>> {
        let mut next: HashMap<Option<u32>, Vec<Option<u32>>> = HashMap::default();
        for (from, to) in edges {
            next.entry(from).or_default().push(to);
        }
        let mut all = first.clone();
        let mut open: Vec<_> = first.iter().copied().collect();
        while let Some(one) = open.pop() {
            // any may be this one, and this one any
            let reached: Vec<_> = match one {
                Some(_) => [one, None]
                    .iter()
                    .flat_map(|of| next.get(of).into_iter().flatten().copied())
                    .collect(),
                None => next.values().flatten().copied().collect(),
            };
            open.extend(reached.into_iter().filter(|to| all.insert(*to)));
        }
        all
    }

    /// All programs are read. The points that something rewrites.
    fn finish(&mut self, gone_to: &HashSet<Option<u32>>) -> HashSet<TargetId> {
        let held = self.points.iter().map(|(.., to)| *to).collect();
        self.held = Self::spread(self.from.iter().copied(), &held);
        let of_joints = self.points.iter().filter(|(_, is_joints, _)| *is_joints);
        self.joints.extend(of_joints.map(|(.., to)| *to));
        self.joints = Self::spread(self.forms.iter().copied(), &self.joints);
        let back = self.from.iter().map(|(from, to)| (*to, *from));
        let leading = Self::spread(back, gone_to);
        let rewritten = self.points.iter();
        let rewritten = rewritten.filter(|(.., to)| is_in(&leading, *to));
        rewritten.map(|(target, ..)| *target).collect()
    }
}

/// Whether a register is one of these, or may be.
pub(super) fn is_in(all: &HashSet<Option<u32>>, register: Option<u32>) -> bool {
    all.contains(&register) || all.contains(&None) || register.is_none() && !all.is_empty()
}

impl Reader<'_> {
    /// The offsets of a move that has just been read: each with the text of its register.
    pub(super) fn displace(
        &mut self,
        instructions: Range<usize>,
        offsets: &[(Axes, Option<&[u8]>)],
        points: &[Named],
    ) {
        let mut amounts = Vec::with_capacity(offsets.len());
        for (axes, text) in offsets {
            let of = text.map_or(Which::Condition, |text| self.which(text));
            self.reads_offset(&of);
            let now = if let Which::One(number) = of {
                let all = (0..ELEMENTS).map(|at| self.known.now(of_position(number, at)));
                all.collect()
            } else {
                self.known.settle();
                Vec::new()
            };
            amounts.push(Amount {
                axes: *axes,
                of,
                now,
            });
        }
        let mut taught = points.iter().map(|named| match named {
            Named::Point(number) => {
                let index = self.listing.by_number.get(number);
                let point = index.map(|index| self.listing.points[*index as usize]);
                point.map_or([None; 2], |point| [point.tool, point.frame])
            }
            _ => [None; 2],
        });
        let first = taught.next().unwrap_or_default();
        let is_same = taught.all(|other| other == first);
        self.offsets.push(Offset {
            instructions,
            routine: self.listing.routine,
            amounts,
            numbers: if is_same { first } else { [None; 2] },
        });
    }

    /// `OFFSET CONDITION PR[1],UFRAME[2]`
    pub(super) fn condition(&mut self, axes: Axes, text: &[u8]) {
        let Some(at) = memchr::memmem::find(text, b"PR[") else {
            return;
        };
        let at = at - usize::from(text[..at].ends_with(b"L"));
        self.known.settle();
        let mut number = None;
        for word in [&b"UFRAME["[..], b"UTOOL["] {
            let at = memchr::memmem::find(text, word);
            let inside = at.map(|at| &text[at + word.len()..]);
            let inside = inside.and_then(|rest| rest.split(|b| *b == b']').next());
            number = number.or(inside.map(whole));
        }
        let of = self.which(&text[at..]);
        self.reads_offset(&of);
        self.conditions.push(Condition {
            routine: self.listing.routine,
            axes,
            of,
            number,
        });
    }

    /// `PR[4]`, `PR[R[1]]`
    fn which(&mut self, text: &[u8]) -> Which {
        let Some((Named::Register(_), length)) = position(text) else {
            return Which::Condition;
        };
        let text = canonical(&text[..length]);
        let index = &text[3..text.len() - 1];
        if let Some(number) = register(index).number {
            return Which::One(number);
        }
        match self.meant(index).all() {
            Some(few) if few.len() == 1 => Which::One(few[0]),
            Some(few) if !few.is_empty() => Which::Few(few),
            _ => Which::Index(index.into()),
        }
    }

    fn reads_offset(&mut self, of: &Which) {
        match of {
            Which::One(number) => self.known.reads_position(*number),
            Which::Few(numbers) => {
                for number in numbers {
                    self.known.reads_position(*number);
                }
            }
            Which::Index(index) => self.known.reads_any_position(index),
            Which::Condition => {}
        }
    }

    // ---- when all programs are read

    /// What the numbers of all programs displace; hands over which registers hold points.
    pub(super) fn finish_offsets(&mut self) -> Copied {
        let mut copied = std::mem::take(&mut self.copied);
        let (targets, variables) = self.gone_to();
        let registers = &self.builder.script.tables[self.controller.registers as usize].entries;
        let numbers: HashMap<VariableId, u32> = registers
            .iter()
            .filter_map(|(number, variable)| Some((*variable, u32::try_from(*number).ok()?)))
            .collect();
        let mut gone_to: HashSet<Option<u32>> = variables
            .iter()
            .filter_map(|variable| numbers.get(variable).copied().map(Some))
            .collect();
        if !self.to_any_register.is_empty() {
            gone_to.insert(None);
        }
        let mut rewritten = copied.finish(&gone_to);
        rewritten.extend(targets);
        rewritten.extend(self.written_points.iter().copied());
        let script = &self.builder.script;
        let points = self.known.points.values().copied();
        let left = points.filter(|target| !rewritten.contains(target));
        let mut values = HashMap::default();
        for target in left {
            let of = &script.targets[target];
            let range = of.numbers.start as usize..of.numbers.end as usize;
            let numbers = script.numbers.get(range).unwrap_or_default();
            let first = numbers.first_chunk::<{ OF_ARM as usize }>();
            if let Some(first) = first.filter(|_| of.layout.shape == Shape::Pose && !of.blocked) {
                values.insert(target, first.each_ref().map(|number| number.value));
            }
        }
        self.known.values = values;
        for number in self.known.finish() {
            self.builder.script.loops[number].most = None;
        }
        for condition in &self.conditions {
            let routine = condition.routine;
            let reached = || self.builder.script.reached_from(&[routine]);
            self.conditioned.entry(routine).or_insert_with(reached);
        }
        for offset in std::mem::take(&mut self.offsets) {
            let (by, axes) = self.of_offset(&offset, &copied);
            let in_joints = match by {
                Displacement::None | Displacement::Unknown => DISPLACED_SOMEHOW,
                _ => UNBOUNDED,
            };
            let by = self.builder.script.displacement(by);
            for at in offset.instructions {
                let is_joints = self.is_joints(self.builder.script.instructions[at].target);
                let by = if is_joints { in_joints } else { by };
                self.builder.script.instructions[at].displacement = by;
                let shifts = axes.iter().map(|&axis| {
                    let value = f64::NAN;
                    (short(at), External { axis, value })
                });
                self.builder.script.external_shifts.extend(shifts);
            }
        }
        self.finish_rides(&copied);
        copied
    }

    pub(super) fn is_joints(&self, target: Expr) -> bool {
        let script = &self.builder.script;
        match target {
            Expr::Target(target) => script.targets[target].layout.shape == Shape::Joints,
            Expr::Any { first, end } => {
                let all = &script.lists[first as usize..end as usize];
                all.iter().any(|one| {
                    matches!(one, Expr::Target(target)
                        if script.targets[*target].layout.shape == Shape::Joints)
                })
            }
            _ => false,
        }
    }

    /// What an offset displaces by, and the external axes that it shifts by what only the running
    /// program knows.
    fn of_offset(&self, offset: &Offset, copied: &Copied) -> (Displacement, Vec<u8>) {
        let mut by = Displacing::new();
        let mut is_known = true;
        let mut axes = Vec::new();
        for amount in &offset.amounts {
            let (values, is_followed) = self.amount(amount, offset, copied);
            axes.extend(self.shifted(&amount.of, &values));
            is_known &= add(&mut by, amount.axes, values, is_followed);
        }
        let displacement = if is_known {
            by.displacement()
        } else {
            Displacement::Unbounded
        };
        (displacement, axes)
    }

    /// The external axes that an offset shifts so.
    fn shifted(&self, of: &Which, values: &[Quantity]) -> Vec<u8> {
        self.open_axes(values, &|number, _| match of {
            Which::One(one) => number == *one,
            Which::Few(few) => few.contains(&number),
            Which::Index(_) | Which::Condition => true,
        })
    }

    /// The external axes among these numbers that the text does not tell, and of which the program
    /// writes the number of such a register for itself. What a register holds otherwise is taken to
    /// be nothing.
    pub(super) fn open_axes(
        &self,
        values: &[Quantity],
        is_of: &dyn Fn(u32, u32) -> bool,
    ) -> Vec<u8> {
        let mut axes = Vec::new();
        for (at, name) in (OF_ARM..).zip(EXTENDED) {
            let written = |(number, element): &(Option<u32>, u32)| {
                *element == at && number.is_none_or(|number| is_of(number, at))
            };
            if let ExternalUse::Listed(axis) = self.names.meaning(name)
                && values[at as usize].exact().is_none()
                && self.known.axes.iter().any(written)
            {
                axes.push(axis);
            }
        }
        axes
    }

    /// The numbers of an offset, and whether they count as they are.
    fn amount(&self, amount: &Amount, offset: &Offset, copied: &Copied) -> (Vec<Quantity>, bool) {
        let nothing = || (vec![Quantity::unknown(); ELEMENTS as usize], true);
        if amount.axes == Axes::Vision {
            return nothing();
        }
        match &amount.of {
            Which::One(number) => {
                let values = amount.now.iter().zip(0..).map(|(now, at)| match now {
                    Some(entered) => self.known.value(entered, None),
                    None => self.known.anywhere(of_position(*number, at)),
                });
                (values.collect(), !copied.is_joints(Some(*number)))
            }
            Which::Few(_) | Which::Index(_) => {
                let (values, numbers) = self.of_register(&amount.of, offset.routine);
                (
                    values,
                    !numbers.iter().any(|number| copied.is_joints(*number)),
                )
            }
            Which::Condition => {
                let is_one = |of: &&Condition| of.axes == amount.axes;
                let all: Vec<_> = self.conditions.iter().filter(is_one).collect();
                // whether the condition of a program that was called stays is not known: both count
                let all = match self.conditioned.get(&offset.routine) {
                    Some(reached) if all.iter().any(|of| of.routine == offset.routine) => {
                        let of_reached = all.iter().filter(|of| reached.contains(&of.routine));
                        of_reached.copied().collect()
                    }
                    _ => all,
                };
                let mut is_followed = true;
                let mut values: Vec<Vec<Quantity>> = Vec::new();
                for of in all {
                    let taught = offset.numbers[usize::from(of.axes == Axes::Frame)];
                    is_followed &= of
                        .number
                        .is_none_or(|number| number.is_some() && number == taught);
                    let (of, numbers) = self.of_register(&of.of, of.routine);
                    is_followed &= !numbers.iter().any(|number| copied.is_joints(*number));
                    values.push(of);
                }
                if values.is_empty() {
                    return nothing();
                }
                let any = (0..ELEMENTS as usize).map(|at| {
                    let all: Vec<_> = values.iter().map(|of| of[at].clone()).collect();
                    Quantity::any(&all)
                });
                (any.collect(), is_followed)
            }
        }
    }

    /// The numbers of a register anywhere, and which it may be; `None` for any.
    fn of_register(&self, of: &Which, routine: RoutineId) -> (Vec<Quantity>, Vec<Option<u32>>) {
        let all = |value: &dyn Fn(u32) -> Quantity| (0..ELEMENTS).map(value).collect();
        let known: &Known = &self.known;
        match of {
            Which::One(number) => {
                let number = *number;
                let values = all(&|at| known.anywhere(of_position(number, at)));
                (values, vec![Some(number)])
            }
            Which::Few(few) => {
                let each = |at| few.iter().map(move |number| of_position(*number, at));
                let of = |at| each(at).map(|number| known.anywhere(number));
                let values = all(&|at| Quantity::any(&of(at).collect::<Vec<_>>()));
                (values, few.iter().copied().map(Some).collect())
            }
            Which::Index(index) => {
                let of = &mut |number| known.anywhere(number);
                let range = known.range(index, (0, routine), of);
                let values = all(&|at| match range.clone() {
                    Some(range) => {
                        let each = range.map(|number| known.anywhere(of_position(number, at)));
                        Quantity::any(&each.collect::<Vec<_>>())
                    }
                    None if known.writes_positions() => Quantity::endless(),
                    None => Quantity::unknown(),
                });
                (values, vec![None])
            }
            Which::Condition => unreachable!("a condition names a register"),
        }
    }
}

/// Whether the text tells some of a number that is not nothing.
fn is_something(value: &Quantity) -> bool {
    value.exact() != Some(0.0) && value.is_of_program()
}

/// Adds an offset; whether it is known by what it adds.
fn add(by: &mut Displacing, axes: Axes, values: Vec<Quantity>, is_followed: bool) -> bool {
    if values[OF_ARM as usize..].iter().any(is_something) {
        return false;
    }
    let is_of_program = values.iter().any(is_something);
    if axes == Axes::Vision || axes == Axes::Other || !is_followed {
        somehow(by);
        return !is_of_program;
    }
    let Ok([x, y, z, angles @ ..]) = <[Quantity; 9]>::try_from(values) else {
        return false;
    };
    let along = [x, y, z].map(|by| by.in_unit(MM));
    let [w, p, r, ..] = angles;
    let angles = [w, p, r];
    if axes == Axes::Frame {
        by.along_frame(&along);
        let has_known = |of: &Quantity| is_something(of) && of.of_text() == 0.0;
        turn(by, &angles);
        return !angles.iter().any(has_known);
    }
    let none = || Quantity::exactly(0.0);
    let [x, y, z] = along;
    by.in_tool(&[x, y, z, none(), none(), none()]);
    turn(by, &angles);
    true
}

/// About the axes of the tool by W, P and R.
fn turn(by: &mut Displacing, angles: &[Quantity; 3]) {
    if let [Some(w), Some(p), Some(r)] = angles.each_ref().map(Quantity::exact) {
        let pose = pose_of_angles([0.0, 0.0, 0.0, w, p, r]);
        by.in_tool_exactly(Pose::from_rotation(pose.rotation));
        return;
    }
    by.turned_by_any(angles);
}

/// By what only the running program knows.
fn somehow(by: &mut Displacing) {
    let none = || Quantity::exactly(0.0);
    by.along_frame(&[Quantity::unknown(), none(), none()]);
}

/// What the numbers of one position added to another's displace that by.
pub(super) fn of_sum(values: &[Quantity]) -> Displacement {
    let [x, y, z, w, p, r, others @ ..] = values else {
        return Displacement::Unbounded;
    };
    if others.iter().any(is_something) {
        return Displacement::Unbounded;
    }
    let mut by = Displacing::new();
    by.along_frame(&[x, y, z].map(|of| of.clone().in_unit(MM)));
    let angles = [w, p, r].map(Clone::clone);
    let exact = angles.each_ref().map(Quantity::exact);
    match exact {
        // about the tool's x
        [Some(w), Some(0.0), Some(0.0)] => {
            let pose = pose_of_angles([0.0, 0.0, 0.0, w, 0.0, 0.0]);
            by.in_tool_exactly(Pose::from_rotation(pose.rotation));
        }
        _ => by.turned_by_any(&angles),
    }
    by.displacement()
}

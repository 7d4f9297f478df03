//! Positions: names of `.TRANS` and `.JOINTS`, `TRANS(…)`, `#[…]`, and what is added to them.

use super::plates::Object;
use super::reader::Reader;
use super::remarks::{ASSIGNED, AXES, COMPUTED, PARTIAL, TOO_LARGE, not_in_files};
use super::sections::Entry;
use crate::geometry::Pose;
use crate::program::contexts::{Varied, nothing};
use crate::program::displacing::Displacing;
use crate::program::kit::angle_too_large;
use crate::program::quantity::Quantity;
use crate::program::script::{
    Expr, Held, Place, Remark, RoutineId, TableId, Variable, VariableId, short,
};
use crate::program::transformations::{Steps, along};
use crate::program::words::{Kind, Word, Words, six};
use crate::program::{Layout, MOST_ANGLE_DEG, Number, Shape, Source, Target, TargetId};
use foldhash::HashMap;
use std::ops::Range;

/// A name as the text uses it.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) struct Name {
    /// In small letters, `#` of joints in front.
    pub stem: Vec<u8>,
    /// What stands in the brackets, without blanks; `None` where only the running program knows.
    pub key: Option<Vec<u8>>,
}

impl Name {
    /// The name of an entry: `cnc.point[1,2]`.
    pub(super) fn of_entry(text: &[u8]) -> Self {
        let open = memchr::memchr(b'[', text).unwrap_or(text.len());
        Self {
            stem: text[..open].to_ascii_lowercase(),
            key: Some(text[open..].to_ascii_lowercase()),
        }
    }

    /// The name that words begin with, and how many it has.
    pub(super) fn of(part: Words) -> Option<(Self, usize)> {
        // a name of the program's own has its dot before the sign: `.#p` is joints, `.&p` a pose
        let dot = usize::from(part.is_word(0, b"."));
        let is_joints = part.is(dot, b'#');
        let mut at = dot + usize::from(is_joints || part.is(dot, b'&'));
        let mut stem = [&b"#"[..usize::from(is_joints)], &b"."[..dot]].concat();
        if !part.is_name(at) {
            return None;
        }
        stem.extend(part.text(at).to_ascii_lowercase());
        at += 1;
        let mut key = Some(Vec::new());
        if part.is(at, b'[') {
            let (inside, words) = part.inside(at);
            let is_literal =
                |word: &Word| matches!(word.kind, Kind::Number | Kind::Sign(b',' | b'-'));
            let text: Vec<&[u8]> = (0..inside.len()).map(|at| inside.text(at)).collect();
            let is_known = inside.all.iter().all(is_literal);
            key = is_known.then(|| [b"[", &text.concat()[..], b"]"].concat());
            at += words;
        }
        Some((Self { stem, key }, at))
    }

    /// The name that `HERE` or the left of `POINT` defines: the last of those that are added up,
    /// and whether others stand before it.
    pub(super) fn defined(part: Words) -> Option<(Self, bool)> {
        let terms = part.terms();
        let (_, last) = terms.last()?;
        let (name, _) = Self::of(*last)?;
        Some((name, terms.len() > 1))
    }

    pub(super) fn is_joints(&self) -> bool {
        self.stem.first() == Some(&b'#')
    }

    /// Without the sign of joints.
    pub(super) fn plain(&self) -> &[u8] {
        self.stem.strip_prefix(b"#").unwrap_or(&self.stem)
    }

    pub(super) fn text(&self) -> String {
        let key = self.key.as_deref().unwrap_or(b"[...]");
        Source::text(&[&self.stem, key].concat()).into_owned()
    }
}

/// What the elements of one name are.
#[derive(Debug)]
pub(super) struct Elements {
    pub table: TableId,
    /// By key.
    pub variables: HashMap<Vec<u8>, VariableId>,
}

/// A position before it is put into the script.
#[derive(Clone, Debug)]
pub(super) struct Position {
    pub base: Expr,
    /// What is added, call by call of the program.
    by: Varied<Displacing>,
    /// The plate that it is on: the work frame, and where that is on the base.
    pub on: Option<(VariableId, Pose)>,
}

impl Position {
    pub(super) fn plain(base: Expr) -> Self {
        Self {
            base,
            by: nothing(),
            on: None,
        }
    }

    /// With steps in the tool frame added.
    pub(super) fn in_tool(mut self, steps: Varied<Steps>) -> Self {
        self.by.with(steps, |by, steps| steps.in_tool(by));
        self
    }

    /// With angles added, degrees, about axes through the tool's origin that the text does not tell.
    pub(super) fn turned(mut self, angles: Varied<[Quantity; 3]>) -> Self {
        self.by.with(angles, |by, angles| by.turned_by_any(&angles));
        self
    }

    /// With a way in the base frame added, mm.
    pub(super) fn along(mut self, way: Varied<[Quantity; 3]>) -> Self {
        let plate = self.on.map_or(Pose::identity(), |(_, plate)| plate);
        let turned = plate.rotation.transpose();
        self.by.with(way, |by, way| along(&way, &turned, by));
        self
    }
}

/// What `SHIFT(p BY x,y,z)` shifts, in whichever brackets, and its way; `None` of another term.
pub(super) fn shifted<'a, 'w>(term: Words<'a, 'w>) -> Option<(Words<'a, 'w>, Words<'a, 'w>)> {
    let is_shift = term.is_word(0, b"SHIFT") && term.is(1, b'(');
    if !is_shift || term.closing(1) + 1 != term.len() {
        return None;
    }
    let (inside, _) = term.inside(1);
    // that of a shift inside stands before it
    let by = (0..inside.len()).rfind(|at| inside.is_word(*at, b"BY"))?;
    Some((inside.part(0..by), inside.behind(by + 1)))
}

/// The numbers of `TRANS(x,y,z)`: those that are left out at its end are 0.
///
/// # Source
/// Kawasaki AS Language Reference Manual (90209-1022DED), TRANS.
fn six_or_fewer(list: &[Words]) -> Option<[Number; 6]> {
    let end = list.last().filter(|_| list.len() < 6)?.span().end;
    let mut numbers = [Number {
        start: short(end),
        length: 0,
        value: 0.0,
    }; 6];
    for (number, part) in numbers.iter_mut().zip(list) {
        *number = part.number()?;
    }
    Some(numbers)
}

/// An angle of a transformation that is written out which turns a tool or base many times.
fn endless_angle(part: Words) -> Option<f64> {
    let terms = part.terms();
    let written = terms.iter().filter(|(_, term)| term.is_word(0, b"TRANS"));
    let mut angles = written.flat_map(|(_, term)| {
        let list = term.rest_list(1).unwrap_or_default();
        let angles = list.iter().skip(3);
        let angles = angles.filter_map(|angle| Some(angle.number()?.value));
        angles.collect::<Vec<_>>()
    });
    angles.find(|angle| angle.abs() > MOST_ANGLE_DEG)
}

/// The first six numbers of a target, where the others, of axes besides the arm's, are zero.
fn of_arm<T>(all: &[T], value: impl Fn(&T) -> Option<f64>) -> &[T] {
    match all.split_at_checked(6) {
        Some((arm, others)) if others.iter().all(|other| value(other) == Some(0.0)) => arm,
        _ => all,
    }
}

impl<'a> Reader<'a> {
    pub(super) fn unknown(&mut self, remark: Remark) -> Expr {
        self.builder.script.unknown(remark)
    }

    /// Where the robot itself is.
    pub(super) fn robot(&mut self, is_joints: bool) -> Expr {
        if is_joints {
            return self.builder.script.held(Held::Actual);
        }
        self.robot_in(self.base)
    }

    /// Likewise in a base, or on a plate.
    pub(super) fn robot_in(&mut self, frame: VariableId) -> Expr {
        let [tool, frame] = [self.tool, frame].map(Expr::Variable);
        self.builder.script.held(Held::ActualWith { tool, frame })
    }

    // ---- what is declared

    /// A name of `.TRANS` or `.JOINTS`.
    pub(super) fn declare(&mut self, entry: &Entry) {
        let name = Name::of_entry(entry.name);
        let shape = if name.is_joints() {
            Shape::Joints
        } else {
            Shape::Pose
        };
        let place = entry.place;
        let numbers = of_arm(&entry.numbers, |number| Some(number.value));
        let declared = if let Ok(numbers) = <[Number; 6]>::try_from(numbers) {
            let target = self.add_target(Some(&name.text()), place, entry.end, shape, numbers);
            Expr::Target(target)
        } else {
            self.unknown(AXES)
        };
        let known = self
            .names
            .get(&None)
            .and_then(|names| names.get(&name.stem));
        let key = name.key.as_deref().unwrap_or_default();
        if let Some(&variable) = known.and_then(|known| known.variables.get(key)) {
            // each of the files may be the one that was loaded last
            let script = &mut self.builder.script;
            let before = script.variables[variable as usize].declared;
            let both = script.any([before, declared]);
            script.variables[variable as usize].declared = both;
            let remark = script.remark(Remark::error(
                "target-name-ambiguous",
                "this name has different values",
                "pass only the files that are loaded together, with one value for each name",
            ));
            let values = |target| script.numbers_of(target).iter().map(|number| number.value);
            if let (Expr::Target(a), Expr::Target(b)) = (before, declared)
                && !values(a).eq(values(b))
            {
                script.refused.extend([(a, remark), (b, remark)]);
            }
            return;
        }
        self.add_variable(&name, place, declared);
    }

    fn add_target(
        &mut self,
        name: Option<&str>,
        place: Place,
        end: u32,
        shape: Shape,
        numbers: [Number; 6],
    ) -> TargetId {
        let target = Target {
            name: name.map(Into::into),
            ..Target::new(place, end, Layout::of(shape))
        };
        self.builder.script.target(target, numbers)
    }

    fn add_variable(&mut self, name: &Name, place: Place, declared: Expr) -> VariableId {
        let routine = self.owner(name);
        let script = &mut self.builder.script;
        let made = script.variable(Variable {
            kept: routine.is_none(),
            routine,
            ..Variable::new(name.text(), place, declared)
        });
        let names = self.names.entry(routine).or_default();
        let elements = names.entry(name.stem.clone()).or_insert_with(|| Elements {
            table: script.table(name.text()),
            variables: HashMap::default(),
        });
        script.enter(elements.table, made);
        let key = name.key.clone().unwrap_or_default();
        elements.variables.insert(key, made);
        made
    }

    /// A name that a program writes is one of its array, wherever that stands in the text.
    pub(super) fn assign(&mut self, name: &Name, place: Place, routine: RoutineId) {
        if name.key.is_some() {
            let before = std::mem::take(&mut self.here);
            self.here.file = place.file;
            self.here.at = place.offset as usize;
            self.here.routine = routine;
            self.variable(name);
            self.here = before;
        }
    }

    /// Names of the program's own begin with a dot; parameters are its own, too.
    fn is_local(&self, name: &Name) -> bool {
        self.owner(name).is_some()
    }

    fn is_parameter(&self, name: &Name) -> bool {
        let own = self.parameters.get(self.here.routine as usize);
        own.is_some_and(|own| own.iter().any(|own| own == name.plain()))
    }

    /// The program that a name belongs to where one uses it; none where it is of all.
    pub(super) fn owner_in(&self, name: &Name, routine: RoutineId) -> Option<RoutineId> {
        let own = self.parameters.get(routine as usize);
        let is_parameter = own.is_some_and(|own| own.iter().any(|own| own == name.plain()));
        (is_parameter || name.plain().starts_with(b".")).then_some(routine)
    }

    /// Whether a statement writes a name that means here what it means there.
    pub(super) fn is_assigned(&self, name: &Name, routine: RoutineId) -> bool {
        let owned = (self.owner_in(name, routine), name.stem.clone());
        self.assigned.contains(&owned)
    }

    fn owner(&self, name: &Name) -> Option<RoutineId> {
        self.owner_in(name, self.here.routine)
    }

    pub(super) fn elements_in(&self, name: &Name, routine: RoutineId) -> Option<&Elements> {
        self.names
            .get(&self.owner_in(name, routine))?
            .get(&name.stem)
    }

    fn elements(&self, name: &Name) -> Option<&Elements> {
        self.elements_in(name, self.here.routine)
    }

    /// Whether a name is one of the files' positions.
    pub(super) fn is_known(&self, name: &Name) -> bool {
        self.is_local(name) || self.elements(name).is_some()
    }

    /// The variable of a name; one that the files do not have is unknown until it is written.
    pub(super) fn variable(&mut self, name: &Name) -> VariableId {
        let key = name.key.as_deref().unwrap_or_default();
        let known = self.elements(name);
        if let Some(&known) = known.and_then(|elements| elements.variables.get(key)) {
            return known;
        }
        let remark = if self.is_local(name) {
            COMPUTED
        } else {
            not_in_files(&name.text())
        };
        let declared = self.unknown(remark);
        let place = self.place(self.here.at);
        self.add_variable(name, place, declared)
    }

    /// All elements of a name, of which only the running program knows the one. Where statements write
    /// such elements alone one variable stands for all of them.
    pub(super) fn table(&mut self, name: &Name) -> Option<TableId> {
        let is_written = name.key.is_none() && self.is_assigned(name, self.here.routine);
        if is_written && self.elements(name).is_none() {
            let declared = self.unknown(COMPUTED);
            let place = self.place(self.here.at);
            let whole = Name {
                stem: name.stem.clone(),
                key: Some(Vec::new()),
            };
            self.add_variable(&whole, place, declared);
        }
        self.elements(name).map(|elements| elements.table)
    }

    /// What a name holds.
    fn named(&mut self, name: &Name) -> Expr {
        if name.key.is_some() {
            return Expr::Variable(self.variable(name));
        }
        let is_local = self.is_local(name);
        match self.table(name) {
            None if is_local => self.unknown(COMPUTED),
            None => self.unknown(not_in_files(&name.text())),
            Some(table) => {
                // others of the program's own may follow in the text
                let computed = is_local && !self.is_parameter(name);
                let computed = computed.then(|| self.unknown(COMPUTED));
                let script = &mut self.builder.script;
                let entries = script.tables[table as usize].entries.values();
                let all = entries.map(|one| Expr::Variable(*one)).chain(computed);
                let all: Vec<Expr> = all.collect();
                script.any(all)
            }
        }
    }

    // ---- what the text says

    /// The position that words are: `p`, `#p[1]`, `TRANS(…)`, `#[…]`, `p+q-r`, `SHIFT(p BY x,y,z)`.
    pub(super) fn position(&mut self, part: Words<'a, '_>) -> Position {
        if let Some((way, behind)) = self.in_front(part) {
            return self.position(behind).along(way);
        }
        let terms = part.terms();
        let Some(((_, first), mut others)) = terms.split_first() else {
            return Position::plain(self.unknown(COMPUTED));
        };
        let mut found = if let Some((plate, object, words)) = self.on_plate(part) {
            let (frame, pose, names) = plate;
            others = &others[names..];
            let base = match object {
                Object::Named(name) => self.named(&name),
                Object::Literal => self.literal(words, 1, Shape::Pose),
            };
            Position {
                on: Some((frame, pose)),
                ..Position::plain(base)
            }
        } else {
            self.term(*first)
        };
        for (sign, term) in others {
            let steps = self.steps(*term);
            let is_back = *sign == b'-';
            found = found.in_tool(if is_back {
                steps.map(Steps::inverse)
            } else {
                steps
            });
        }
        found
    }

    /// What stands in front of a named position and only shifts it in the axes of the base: `NULL`,
    /// `TRANS(x,y,z)`; and that position.
    fn in_front<'w>(&self, part: Words<'a, 'w>) -> Option<(Varied<[Quantity; 3]>, Words<'a, 'w>)> {
        let is_transformation = part.is_word(0, b"TRANS") && part.is(1, b'(');
        let is_alone = is_transformation && part.closing(1) + 1 == part.len();
        if is_alone || !is_transformation && !part.is_word(0, b"NULL") {
            return None;
        }
        let terms = part.terms();
        let [(0, first), (b'+', second), ..] = terms[..] else {
            return None;
        };
        let behind = part.behind(first.len() + 1);
        let named = |part: Words<'a, 'w>| {
            let (name, words) = Name::of(part)?;
            (words == part.len() && self.is_known(&name)).then_some(())
        };
        let is_shift = shifted(second).is_some();
        if !is_shift && named(second).is_none() && self.in_front(behind).is_none() {
            return None;
        }
        let list = first.rest_list(1).unwrap_or_default();
        let is_null = first.len() == 1;
        let is_zero = |angle: &Words| angle.is_empty() || angle.value() == Some(0.0);
        let is_straight = list.iter().skip(3).all(is_zero);
        let way = self.quantities(&list).map(|[x, y, z, ..]| [x, y, z]);
        let is_only = is_null || is_transformation && is_straight;
        is_only.then_some((way, behind))
    }

    fn term(&mut self, part: Words<'a, '_>) -> Position {
        if part.is(0, b'#') && part.is(1, b'[') {
            return Position::plain(self.literal(part, 1, Shape::Joints));
        }
        if part.is(0, b'#') && part.is_word(1, b"PPOINT") && part.is(2, b'(') {
            return Position::plain(self.literal(part, 2, Shape::Joints));
        }
        if part.is_word(0, b"TRANS") && part.is(1, b'(') {
            return Position::plain(self.literal(part, 1, Shape::Pose));
        }
        if let Some((shifted, way)) = shifted(part) {
            let way = self.quantities(&way.list());
            let way = way.map(|[x, y, z, ..]| [x, y, z]);
            return self.position(shifted).along(way);
        }
        let is_joints = part.is(0, b'#');
        if part.is_word(usize::from(is_joints), b"HERE") {
            return Position::plain(self.robot(is_joints));
        }
        match Name::of(part) {
            Some((name, words)) if words == part.len() => Position::plain(self.named(&name)),
            _ => Position::plain(self.unknown(COMPUTED)),
        }
    }

    /// A target that is written out, in the brackets that open at a word.
    fn literal(&mut self, whole: Words<'a, '_>, open: usize, shape: Shape) -> Expr {
        let list = whole.rest_list(open).unwrap_or_default();
        let list = of_arm(&list, Words::value);
        let partial = (shape == Shape::Pose).then(|| six_or_fewer(list)).flatten();
        if let Some(numbers) = six(list).or(partial) {
            let Range { start, end } = whole.span();
            let place = self.place(start);
            return Expr::Target(self.add_target(None, place, short(end), shape, numbers));
        }
        let is_partial = shape == Shape::Pose && list.len() < 6;
        let remark = match list.iter().find(|part| part.number().is_none()) {
            None if is_partial => PARTIAL,
            None => AXES,
            Some(part) if part.is_empty() => PARTIAL,
            Some(part) if part.is_numeral() => TOO_LARGE,
            Some(_) => COMPUTED,
        };
        self.unknown(remark)
    }

    /// A position as the script has it.
    pub(super) fn expr(&mut self, position: &Position) -> Expr {
        let (routine, by) = (self.here.routine, position.by.clone());
        let script = &mut self.builder.script;
        (self.by_calls).displaced(position.base, by, routine, script)
    }

    // ---- tools and bases

    /// What `TOOL` or `BASE` is set to; behind a comma stands the number of the tool's shape.
    pub(super) fn frame(&mut self, part: Words<'a, '_>) -> Expr {
        let first = part.list().first().copied();
        let part = first.filter(|first| !first.is_empty()).unwrap_or(part);
        if part.is_empty() || part.is_word(0, b"NULL") && part.len() == 1 {
            return self.frame_value("NULL", Some(Pose::identity()));
        }
        if let Some(angle) = endless_angle(part) {
            let hint = "O, A and T are in degrees: write them between -360 and 360";
            let name = Source::text(part.whole());
            return self.unknown(angle_too_large(&name, angle, hint));
        }
        match Name::of(part) {
            // one of several that are written out
            Some((name, words))
                if words == part.len() && name.key.is_none() && self.table(&name).is_some() =>
            {
                self.named(&name)
            }
            Some((name, words)) if words == part.len() && name.key.is_some() => {
                if self.is_known(&name) || self.is_assigned(&name, self.here.routine) {
                    Expr::Variable(self.variable(&name))
                } else {
                    self.frame_value(&name.text(), None)
                }
            }
            _ => match self.steps(part).all.exact() {
                Some(pose) => self.frame_value(&Source::text(part.whole()), Some(pose)),
                None => self.unknown(ASSIGNED),
            },
        }
    }

    /// A tool or base of this name.
    pub(super) fn frame_value(&mut self, name: &str, pose: Option<Pose>) -> Expr {
        Expr::Value(self.builder.script.frame(name, pose))
    }
}

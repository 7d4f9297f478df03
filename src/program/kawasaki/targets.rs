//! Positions: names of `.TRANS` and `.JOINTS`, `TRANS(…)`, `#[…]`, and what is added to them.

use super::pose_of;
use super::reader::Reader;
use super::remarks::{Cause, not_in_files};
use super::sections::Entry;
use super::words::{Kind, Part};
use crate::geometry::Pose;
use crate::geometry::units::{DEG, MM};
use crate::program::script::{
    Expr, Held, NamedFrame, Place, Remark, Table, TableId, Variable, VariableId, short,
};
use crate::program::{
    Displacement, Layout, Number, Shape, Shift, Source, Target, TargetId, number,
};
use foldhash::HashMap;

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
    pub(super) fn of(part: Part) -> Option<(Self, usize)> {
        let mut at = 0;
        let mut stem = Vec::new();
        if part.is(0, b'#') {
            stem.push(b'#');
            at = 1;
        } else if part.is_word(0, b".") && part.is(1, b'#') {
            // joints of the program's own
            stem.extend(b"#.");
            at = 2;
        }
        let word = part.0.get(at).filter(|word| word.kind == Kind::Name)?;
        stem.extend(word.text.to_ascii_lowercase());
        at += 1;
        let mut key = Some(Vec::new());
        if part.is(at, b'[') {
            let (inside, words) = part.behind(at).inside(0);
            let is_literal = |word: &super::words::Word| {
                word.kind == Kind::Number || word.is(b',') || word.is(b'-')
            };
            let text = inside.0.iter().flat_map(|word| word.text);
            let text: Vec<u8> = [b"["]
                .into_iter()
                .flatten()
                .chain(text)
                .chain(b"]")
                .copied()
                .collect();
            key = inside.0.iter().all(is_literal).then_some(text);
            at += words;
        }
        Some((Self { stem, key }, at))
    }

    fn is_joints(&self) -> bool {
        self.stem.first() == Some(&b'#')
    }

    fn text(&self) -> String {
        let key = self.key.as_deref().unwrap_or(b"[...]");
        Source::text(&[&self.stem, key].concat()).into_owned()
    }
}

/// What the elements of one name are.
#[derive(Debug)]
pub(super) struct Elements {
    table: TableId,
    /// By key.
    variables: HashMap<Vec<u8>, VariableId>,
}

/// A position before it is put into the script.
#[derive(Clone, Copy, Debug)]
pub(super) struct Position {
    pub base: Expr,
    /// What is added; `None` where only the running program knows.
    pub by: Option<Shift>,
}

impl Position {
    fn plain(base: Expr) -> Self {
        let nothing = Shift {
            in_frame: Pose::identity(),
            in_tool: Pose::identity(),
        };
        Self {
            base,
            by: Some(nothing),
        }
    }

    /// With a motion in the tool frame added.
    pub(super) fn in_tool(mut self, by: Option<Pose>) -> Self {
        self.by = self.by.zip(by).map(|(own, by)| Shift {
            in_tool: own.in_tool * by,
            ..own
        });
        self
    }

    /// With a translation in the base frame added, mm.
    pub(super) fn along(mut self, by: Option<[f64; 3]>) -> Self {
        self.by = self.by.zip(by).map(|(own, by)| Shift {
            in_frame: Shift::along(by.map(|mm| mm * MM)).in_frame * own.in_frame,
            ..own
        });
        self
    }
}

/// The numbers of a list, blanks as 0; `None` where one is computed.
pub(super) fn literals<const COUNT: usize>(list: &[Part]) -> Option<[f64; COUNT]> {
    let mut found = [0.0; COUNT];
    if list.len() > COUNT {
        return None;
    }
    for (value, part) in found.iter_mut().zip(list) {
        if !part.0.is_empty() {
            *value = part.number()?;
        }
    }
    Some(found)
}

impl<'a> Reader<'a> {
    pub(super) fn unknown(&mut self, remark: Remark) -> Expr {
        Expr::Unknown(self.builder.script.remark(remark))
    }

    // ---- what is declared

    /// A name of `.TRANS` or `.JOINTS`.
    pub(super) fn declare(&mut self, entry: &Entry, file: u32) {
        let name = Name::of_entry(entry.name);
        let shape = if name.is_joints() {
            Shape::Joints
        } else {
            Shape::Pose
        };
        let place = Place {
            file,
            offset: entry.at,
        };
        let declared = if let Ok(numbers) = <[Number; 6]>::try_from(&entry.numbers[..]) {
            let target = self.add_target(Some(&name.text()), place, entry.end, shape, numbers);
            Expr::Target(target)
        } else {
            self.unknown(Cause::Axes.remark())
        };
        let known = self.names.get(&name.stem);
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
            let numbers = |target: TargetId| {
                let range = script.targets[target].numbers.clone();
                let numbers = &script.numbers[range.start as usize..range.end as usize];
                numbers
                    .iter()
                    .map(|number| number.value)
                    .collect::<Vec<_>>()
            };
            if let (Expr::Target(a), Expr::Target(b)) = (before, declared)
                && numbers(a) != numbers(b)
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
            file: place.file,
            offset: place.offset,
            end,
            layout: Layout { shape, variant: 0 },
            numbers: 0..0,
            blocked: false,
        };
        self.builder.script.target(target, numbers)
    }

    fn add_variable(&mut self, name: &Name, place: Place, declared: Expr) -> VariableId {
        let is_local = self.is_local(name);
        let routine = is_local.then_some(self.here.routine);
        let script = &mut self.builder.script;
        let made = script.variable(Variable {
            kept: !is_local,
            routine,
            ..Variable::new(name.text(), place, declared)
        });
        let names = match routine {
            Some(routine) => self.locals.entry(routine).or_default(),
            None => &mut self.names,
        };
        let elements = names.entry(name.stem.clone()).or_insert_with(|| {
            script.tables.push(Table {
                name: name.text().into(),
                ..Table::default()
            });
            Elements {
                table: short(script.tables.len() - 1),
                variables: HashMap::default(),
            }
        });
        let entries = &mut script.tables[elements.table as usize].entries;
        entries.insert(i64::try_from(entries.len()).expect("few"), made);
        let key = name.key.clone().unwrap_or_default();
        elements.variables.insert(key, made);
        made
    }

    /// Names of the program's own begin with a dot; parameters are its own, too.
    fn is_local(&self, name: &Name) -> bool {
        let plain = name.stem.strip_prefix(b"#").unwrap_or(&name.stem);
        plain.starts_with(b".") || self.here.parameters.iter().any(|own| own == plain)
    }

    fn elements(&self, name: &Name) -> Option<&Elements> {
        if self.is_local(name) {
            return self.locals.get(&self.here.routine)?.get(&name.stem);
        }
        self.names.get(&name.stem)
    }

    /// Whether a name is one of the files' positions.
    pub(super) fn is_known(&self, name: &Name) -> bool {
        self.is_local(name) || self.names.contains_key(&name.stem)
    }

    /// The variable of a name; one that the files do not have is unknown until it is written.
    pub(super) fn variable(&mut self, name: &Name) -> VariableId {
        let key = name.key.as_deref().unwrap_or_default();
        let known = self.elements(name);
        if let Some(&known) = known.and_then(|elements| elements.variables.get(key)) {
            return known;
        }
        let remark = if self.is_local(name) {
            Cause::Computed.remark()
        } else {
            not_in_files(&name.text())
        };
        let declared = self.unknown(remark);
        let place = self.place(self.here.at);
        self.add_variable(name, place, declared)
    }

    /// All elements of a name, of which only the running program knows the one.
    pub(super) fn table(&mut self, name: &Name) -> Option<TableId> {
        self.elements(name).map(|elements| elements.table)
    }

    /// What a name holds.
    fn named(&mut self, name: &Name) -> Expr {
        if name.key.is_some() {
            return Expr::Variable(self.variable(name));
        }
        let is_local = self.is_local(name);
        match self.table(name).filter(|_| !is_local) {
            None if is_local => self.unknown(Cause::Computed.remark()),
            None => self.unknown(not_in_files(&name.text())),
            Some(table) => {
                let script = &mut self.builder.script;
                let entries = script.tables[table as usize].entries.values();
                let all: Vec<Expr> = entries.map(|one| Expr::Variable(*one)).collect();
                script.any(all)
            }
        }
    }

    // ---- what the text says

    /// The position that words are: `p`, `#p[1]`, `TRANS(…)`, `#[…]`, `p+q-r`, `SHIFT(p BY x,y,z)`.
    pub(super) fn position(&mut self, part: Part<'a, '_>) -> Position {
        let terms = terms(part);
        let Some(((_, first), others)) = terms.split_first() else {
            return Position::plain(self.unknown(Cause::Computed.remark()));
        };
        let mut found = self.term(*first);
        for (is_minus, term) in others {
            let by = self.known_pose(*term);
            found = found.in_tool(by.map(|by| if *is_minus { by.inverse() } else { by }));
        }
        found
    }

    fn term(&mut self, part: Part<'a, '_>) -> Position {
        if part.is(0, b'#') && part.is(1, b'[') {
            let (inside, words) = part.behind(1).inside(0);
            let list = if words + 1 == part.0.len() {
                inside.list()
            } else {
                Vec::new()
            };
            return Position::plain(self.literal(part, &list, Shape::Joints));
        }
        if part.is_word(0, b"TRANS") && part.is(1, b'(') {
            let (inside, words) = part.behind(1).inside(0);
            let list = if words + 1 == part.0.len() {
                inside.list()
            } else {
                Vec::new()
            };
            return Position::plain(self.literal(part, &list, Shape::Pose));
        }
        if part.is_word(0, b"SHIFT") && part.is(1, b'(') {
            let (inside, _) = part.behind(1).inside(0);
            let by = inside.0.iter().position(|word| word.is_word(b"BY"));
            if let Some(by) = by {
                let moved = literals(&inside.behind(by + 1).list());
                return self.position(Part(&inside.0[..by])).along(moved);
            }
        }
        if part.is_word(0, b"HERE") || part.is(0, b'#') && part.is_word(1, b"HERE") {
            let here = Expr::Value(self.builder.script.value(Held::Actual));
            return Position::plain(here);
        }
        match Name::of(part) {
            Some((name, words)) if words == part.0.len() => Position::plain(self.named(&name)),
            _ => Position::plain(self.unknown(Cause::Computed.remark())),
        }
    }

    /// A target that is written out.
    fn literal(&mut self, whole: Part<'a, '_>, list: &[Part<'a, '_>], shape: Shape) -> Expr {
        let mut numbers = Vec::with_capacity(6);
        for part in list {
            let bytes = part.bytes();
            let (Some(value), Some((start, end))) = (part.number(), bytes) else {
                let cause = if part.0.is_empty() {
                    Cause::Partial
                } else {
                    Cause::Computed
                };
                return self.unknown(cause.remark());
            };
            // a sign and blanks before its digits
            let text = &self.sources[self.here.file as usize].bytes[start..end];
            if number::parse(text).is_none() {
                return self.unknown(Cause::Computed.remark());
            }
            numbers.push(Number {
                start: short(start),
                length: u16::try_from(end - start).expect("a number is short"),
                value,
            });
        }
        let count = numbers.len();
        match <[Number; 6]>::try_from(numbers) {
            Ok(numbers) => {
                let (start, end) = whole.bytes().expect("it has words");
                let place = self.place(start);
                Expr::Target(self.add_target(None, place, short(end), shape, numbers))
            }
            Err(_) if shape == Shape::Pose && count < 6 => self.unknown(Cause::Partial.remark()),
            Err(_) => self.unknown(Cause::Axes.remark()),
        }
    }

    /// What is added to a position, where the text tells it.
    fn known_pose(&self, part: Part<'a, '_>) -> Option<Pose> {
        if part.is(1, b'(') {
            let (inside, words) = part.behind(1).inside(0);
            let list = inside.list();
            if words + 1 != part.0.len() {
                return None;
            }
            let turn = |turn: fn(f64) -> crate::geometry::Rotation| {
                let [angle] = literals(&list)?;
                Some(Pose {
                    rotation: turn(angle * DEG),
                    ..Pose::identity()
                })
            };
            let word = part.0[0];
            return match () {
                () if word.is_word(b"TRANS") => literals(&list).map(pose_of),
                () if word.is_word(b"RX") => turn(crate::geometry::Rotation::about_x),
                () if word.is_word(b"RY") => turn(crate::geometry::Rotation::about_y),
                () if word.is_word(b"RZ") => turn(crate::geometry::Rotation::about_z),
                () => None,
            };
        }
        if part.is_word(0, b"NULL") && part.0.len() == 1 {
            return Some(Pose::identity());
        }
        let (name, words) = Name::of(part)?;
        let is_constant = words == part.0.len() && !self.assigned.contains(&name.stem);
        let key = name
            .key
            .as_ref()
            .filter(|_| is_constant && !name.is_joints())?;
        let variable = *self.elements(&name)?.variables.get(key)?;
        let script = &self.builder.script;
        let Expr::Target(target) = script.variables[variable as usize].declared else {
            return None;
        };
        let range = script.targets[target].numbers.clone();
        let numbers = &script.numbers[range.start as usize..range.end as usize];
        Some(pose_of(std::array::from_fn(|i| numbers[i].value)))
    }

    /// A position as the script has it.
    pub(super) fn expr(&mut self, position: Position) -> Expr {
        let nothing = Pose::identity();
        let script = &mut self.builder.script;
        let by = match position.by {
            Some(by) if by.in_frame == nothing && by.in_tool == nothing => return position.base,
            Some(by) => Displacement::By(Box::new(by)),
            None => Displacement::Unknown,
        };
        let by = script.displacement(by);
        script.displaced(position.base, by)
    }

    // ---- tools and bases

    /// What `TOOL` or `BASE` is set to.
    pub(super) fn frame(&mut self, part: Part<'a, '_>) -> Expr {
        if part.0.is_empty() || part.is_word(0, b"NULL") && part.0.len() == 1 {
            return self.frame_value("NULL", Some(Pose::identity()));
        }
        if part.is_word(0, b"TRANS")
            && let Some(pose) = self.known_pose(part)
        {
            let (start, end) = part.bytes().expect("it has words");
            let text = &self.sources[self.here.file as usize].bytes[start..end];
            return self.frame_value(&Source::text(text), Some(pose));
        }
        match Name::of(part) {
            Some((name, words)) if words == part.0.len() && name.key.is_some() => {
                if self.is_known(&name) || self.assigned.contains(&name.stem) {
                    Expr::Variable(self.variable(&name))
                } else {
                    self.frame_value(&name.text(), None)
                }
            }
            _ => self.unknown(Cause::Assigned.remark()),
        }
    }

    /// A tool or base of this name.
    pub(super) fn frame_value(&mut self, name: &str, pose: Option<Pose>) -> Expr {
        let frame = Held::Frame(NamedFrame {
            on: Box::default(),
            name: name.into(),
            pose,
            load: None,
        });
        Expr::Value(self.builder.script.value(frame))
    }
}

/// The parts between `+` and `-` outside brackets, and whether `-` stands before each.
fn terms<'a, 'w>(part: Part<'a, 'w>) -> Vec<(bool, Part<'a, 'w>)> {
    let (mut found, mut start, mut at, mut minus) = (Vec::new(), 0, 0, false);
    while at < part.0.len() {
        match part.0[at].kind {
            Kind::Sign(b'(' | b'[') => at = part.closing(at),
            Kind::Sign(sign @ (b'+' | b'-')) if at > start => {
                found.push((minus, Part(&part.0[start..at])));
                (start, minus) = (at + 1, sign == b'-');
            }
            _ => {}
        }
        at += 1;
    }
    if start < part.0.len() {
        found.push((minus, Part(&part.0[start..])));
    }
    found
}

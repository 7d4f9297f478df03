//! What data lists and declarations give: targets, numbers, FDAT, entries of the controller's
//! tables.

use super::aggregate::{self, Aggregate, STATUS, TURN, WHOLE};
use super::frames::{Table, pose_of, write_pose};
use super::names::{DataKind, Datum, Fdat, Index, Ldat, Stored, Turning, whole};
use super::reader::{AsDeclared, Reader};
use super::remarks;
use super::tokens::{Cursor, Kind, Read, Token, capitals};
use super::turning::Arc;
use crate::finding::{Finding, Severity};
use crate::geometry::Pose;
use crate::geometry::units::{DEG, MM, m_from_mm, mm_from_m};
use crate::program::script::{Place, Remark, short};
use crate::program::{External, ExternalUse, Layout, Load, Shape, Source, Target, TargetId};
use std::ops::Range;

/// So far, and so far rotated, `$ROBROOT` may be from the profile's base.
const MOST_ROOT_GAP_M: f64 = 0.1 * MM;
const MOST_ROOT_TURN_RAD: f64 = 0.01 * DEG;

impl Reader {
    /// The names behind a type, each with sizes and a value or without.
    pub(super) fn declared(
        &mut self,
        kind: DataKind,
        AsDeclared { global, constant }: AsDeclared,
        mut cursor: Cursor,
    ) -> Read<()> {
        let in_data = self.in_data.is_some();
        let is_table = kind == DataKind::Frame || kind == DataKind::Other;
        if kind == DataKind::Other && in_data {
            // data of other types cannot be targets; their names do not matter
            return Ok(());
        }
        loop {
            let name = cursor.next();
            if name.kind != Kind::Name {
                return Ok(());
            }
            let system = self.names.modules[self.module as usize].is_system;
            let datum = Datum {
                name: self.symbol(&cursor, name),
                context: self.context(),
                kind,
                place: self.place(name),
                kept: in_data,
                constant,
            };
            let is_global = in_data && (global || system);
            let of = datum;
            let datum = self.names.declare(of, is_global);
            self.declare_members(of, is_global);
            let sizes = cursor.brackets()?;
            if cursor.take(b'=') {
                if is_table && self.table(name, sizes, &mut cursor)? {
                    return Ok(());
                }
                let index = Index::of(sizes, &cursor);
                self.initialised((datum, index), name, &mut cursor)?;
            }
            if !cursor.take(b',') {
                return Ok(());
            }
        }
    }

    /// `name[1,2]={...}` in a data list.
    pub(super) fn initial(&mut self, name: Token, mut cursor: Cursor) -> Read<()> {
        let at = cursor.brackets()?;
        let symbol = self.symbol(&cursor, name);
        let (symbol, index) = self.member(symbol, at, &mut cursor)?;
        if !cursor.take(b'=') || self.table(name, at, &mut cursor)? {
            return Ok(());
        }
        match self.names.last_of(symbol, self.module) {
            Some(datum) => self.initialised((datum, index), name, &mut cursor),
            None => Ok(()),
        }
    }

    /// A value of a variable or of an element; the cursor stands behind `=`.
    fn initialised(
        &mut self,
        (datum, index): (u32, Index),
        name: Token,
        cursor: &mut Cursor,
    ) -> Read<()> {
        let Datum {
            kind, name: symbol, ..
        } = self.names.data[datum as usize];
        if matches!(kind, DataKind::Structure(_)) {
            return match cursor.blanks() {
                b'{' => self.member_values(symbol, kind, index, cursor),
                _ => Ok(()),
            };
        }
        if let Some(value) = self.stored(kind, name, cursor)? {
            self.names.values.push((datum, index, value));
        }
        Ok(())
    }

    /// The value behind `=`; `None` where it does not matter.
    fn stored(&mut self, kind: DataKind, name: Token, cursor: &mut Cursor) -> Read<Option<Stored>> {
        if kind == DataKind::Other {
            return Ok(None);
        }
        if kind == DataKind::Number {
            let token = cursor.next();
            let value = crate::program::number::parse(cursor.text(token));
            return Ok(Some(whole(value).map_or(Stored::Computed, Stored::Number)));
        }
        if cursor.blanks() != b'{' {
            return Ok(Some(Stored::Computed));
        }
        if kind == DataKind::Fdat {
            return Ok(Some(Stored::Fdat(fdat(cursor)?)));
        }
        if kind == DataKind::Ldat {
            return Ok(Some(Stored::Ldat(ldat(cursor)?)));
        }
        let start = cursor.at;
        let aggregate = aggregate::read(cursor)?;
        let text = &cursor.bytes[name.start as usize..start];
        let text = text.split(|&b| b == b'=').next().unwrap_or(text);
        let name = Source::text(text.trim_ascii());
        let target = self.add(&aggregate, start..cursor.at, Some(name.into()));
        Ok(Some(Stored::Target(target)))
    }

    /// A target with the numbers of an aggregate; one that cannot be rewritten has none.
    pub(super) fn add(
        &mut self,
        aggregate: &Aggregate,
        span: Range<usize>,
        name: Option<Box<str>>,
    ) -> TargetId {
        let script = &mut self.builder.script;
        let first = short(script.numbers.len());
        let id = script.targets.len();
        let is_axes = aggregate.is_axes();
        let is_whole = if is_axes {
            aggregate.has_axes == WHOLE && aggregate.has == 0
        } else {
            aggregate.has & WHOLE == WHOLE
        };
        let flaw = if aggregate.computed {
            Some(remarks::EXPRESSIONS)
        } else if is_whole {
            None
        } else {
            Some(remarks::PARTIAL)
        };
        let shape = if is_axes { Shape::Joints } else { Shape::Pose };
        let mut variant = 0;
        if flaw.is_none() && is_axes {
            script.numbers.extend_from_slice(&aggregate.axes);
        } else if flaw.is_none() {
            variant = aggregate.has >> 6;
            script.numbers.extend_from_slice(&aggregate.position[..6]);
            for (bit, at) in [(STATUS, 6), (TURN, 7)] {
                if aggregate.has & bit != 0 {
                    script.numbers.push(aggregate.position[at]);
                }
            }
        }
        let place = Place::new(self.file, short(span.start));
        script.targets.push(Target {
            name,
            numbers: first..short(script.numbers.len()),
            blocked: flaw.is_some(),
            ..Target::new(place, short(span.end), Layout { shape, variant })
        });
        if let Some(flaw) = flaw {
            script.refuse(id, flaw);
        }
        for (name, value) in aggregate.driven() {
            match self.external.meaning(name) {
                ExternalUse::Listed(axis) => {
                    script.externals.push((id, External { axis, value }));
                }
                // what stands at zero is mostly not there
                ExternalUse::Unknown if value != 0.0 => {
                    // the same is rarely said twice
                    script.remarks.push(Remark::external_unknown(name, value));
                    let remark = short(script.remarks.len() - 1);
                    script.refused.push((id, remark));
                }
                _ => {}
            }
        }
        id
    }

    /// Values of the controller's tables in data lists; whether it is one of them.
    fn table(
        &mut self,
        name: Token,
        at: Option<(usize, usize)>,
        cursor: &mut Cursor,
    ) -> Read<bool> {
        let mut buffer = [0; 24];
        let word = capitals(cursor.text(name), &mut buffer);
        if word == b"$ROBROOT" {
            let place = self.place(name);
            let frame = (cursor.blanks() == b'{').then(|| aggregate::read(cursor));
            let numbers = frame.transpose()?.and_then(|frame| frame.frame());
            let root = numbers.map(|numbers| pose_of(numbers.map(|number| number.value)));
            self.declared.roots.extend(root.map(|root| (place, root)));
            return Ok(true);
        }
        let table = Table::named(word);
        if table.is_none() && word != b"MACHINE_FRAME_DAT" {
            return Ok(false);
        }
        let Index::At([element, 0, 0]) = Index::of(at, cursor) else {
            return Ok(true);
        };
        let is_aggregate = cursor.blanks() == b'{';
        match table {
            Some(Table::Load) if is_aggregate => match load(cursor)? {
                Carried::Load(load) => self.declared.add_load(element, Some(load)),
                Carried::OfTool => self.declared.add_load(element, None),
                Carried::Unknown => {}
            },
            Some(Table::Load) => {}
            Some(table) => {
                let frame = if is_aggregate {
                    aggregate::read(cursor)?.frame()
                } else {
                    None
                };
                self.declared.add(table, element, frame, self.file);
            }
            None if is_aggregate => {
                let (mut machine, mut controller) = (None, None);
                aggregate::each(cursor, |key, _, field| {
                    let found = match field {
                        aggregate::Field::Number(number) => whole(Some(number.value)),
                        _ => None,
                    };
                    match key {
                        b"MACH_DEF_INDEX" => machine = found.filter(|number| *number > 0),
                        b"COOP_KRC_INDEX" => controller = found.filter(|number| *number > 1),
                        _ => {}
                    }
                    Ok(())
                })?;
                if controller.is_some() {
                    self.declared.of_others.insert(element);
                }
                if let Some(machine) = machine {
                    self.declared.moving.insert(element, machine);
                }
            }
            None => {}
        }
        Ok(true)
    }
}

/// Machine data have the base elsewhere than the profile.
pub(super) fn root_differs(
    (place, root): &(Place, Pose),
    base: &Pose,
    sources: &[Source],
) -> Option<Finding> {
    let gap = root.separation(base);
    if gap.distance_m <= MOST_ROOT_GAP_M && gap.angle_rad <= MOST_ROOT_TURN_RAD {
        return None;
    }
    let shown = |pose: &Pose| {
        let mut n = [0.0; 6];
        write_pose(pose, &mut n);
        let [x, y, z, a, b, c] = n;
        format!("X {x:.3}, Y {y:.3}, Z {z:.3}, A {a:.3}, B {b:.3}, C {c:.3}")
    };
    let message = format!(
        "$ROBROOT is {}, and `kinematics.base` of the profile is {}: {:.3} mm and {:.3} deg from \
         it (the limit is {:.1} mm and {:.2} deg)",
        shown(root),
        shown(base),
        mm_from_m(gap.distance_m),
        gap.angle_rad / DEG,
        mm_from_m(MOST_ROOT_GAP_M),
        MOST_ROOT_TURN_RAD / DEG
    );
    let hint = "write $ROBROOT into `kinematics.base`; every tool and base of the program counts \
        from there";
    let source = &sources[place.file as usize];
    let (at, id) = (place.offset as usize, "robot-root-differs");
    Some(source.finding(at, id, Severity::Error, message, hint))
}

/// `{VEL 2.0,…,ORI_TYP #CONSTANT,CIRC_TYP #BASE,CB {AUX_PT {ORI #CONSIDER,…},…}}`
pub(super) fn ldat(cursor: &mut Cursor) -> Read<Ldat> {
    let bytes = cursor.bytes;
    let mut found = Ldat::default();
    let mut modes = None;
    aggregate::each(cursor, |key, _, field| {
        match (key, field) {
            (b"ORI_TYP", aggregate::Field::Enum(name)) => {
                let name = &bytes[name.start as usize..name.end as usize];
                found.turning = match Turning::named(capitals(name, &mut [0; 24])) {
                    // what the controller does not know leaves the orientation to the targets
                    Turning::Kept if !name.eq_ignore_ascii_case(b"CONSTANT") => Turning::Evenly,
                    known => known,
                };
            }
            (b"CIRC_TYP", aggregate::Field::Enum(name)) => {
                let name = &bytes[name.start as usize..name.end as usize];
                found.arcs[0] = is_usual_arc(Arc::Type, name);
            }
            (b"CB", aggregate::Field::Nested(start)) => modes = Some(start),
            _ => {}
        }
        Ok(())
    })?;
    if let Some(start) = modes {
        let set = arcs(&mut cursor.part(start, cursor.end), Arc::Between)?;
        for (arc, set) in found.arcs.iter_mut().zip(set) {
            *arc &= set.unwrap_or(true);
        }
    }
    Ok(found)
}

/// Which arcs are usual by `{AUX_PT {ORI #CONSIDER,E1 #CONSIDER},TARGET_PT {ORI #INTERPOLATE}}`,
/// where it says so; an orientation outside is that of `part`.
pub(super) fn arcs(cursor: &mut Cursor, part: Arc) -> Read<[Option<bool>; 3]> {
    let bytes = cursor.bytes;
    let mut found = [None; 3];
    let mut inner = Vec::new();
    aggregate::each(cursor, |key, _, field| {
        match (key, field) {
            (b"ORI", aggregate::Field::Enum(name)) => {
                let name = &bytes[name.start as usize..name.end as usize];
                found[part as usize] = Some(is_usual_arc(part, name));
            }
            (b"ORI", _) => found[part as usize] = Some(false),
            (b"AUX_PT", aggregate::Field::Nested(start)) => inner.push((Arc::Between, start)),
            (b"TARGET_PT", aggregate::Field::Nested(start)) => inner.push((Arc::End, start)),
            _ => {}
        }
        Ok(())
    })?;
    // no deeper: a point has no points
    for (of, start) in inner {
        let mut point = cursor.part(start, cursor.end);
        aggregate::each(&mut point, |key, _, field| {
            if let (b"ORI", aggregate::Field::Enum(name)) = (key, field) {
                let name = &bytes[name.start as usize..name.end as usize];
                found[of as usize] = Some(is_usual_arc(of, name));
            }
            Ok(())
        })?;
    }
    Ok(found)
}

/// Whether an arc turns the tool from its beginning to its end in the base: the orientation of the
/// point between is not to be reached, nor to choose the side.
pub(super) fn is_usual_arc(of: Arc, name: &[u8]) -> bool {
    let usual: &[&[u8]] = match of {
        Arc::Type => &[b"BASE"],
        Arc::Between => &[b"CONSIDER", b"IGNORE"],
        Arc::End => &[b"INTERPOLATE"],
    };
    usual.iter().any(|usual| name.eq_ignore_ascii_case(usual))
}

/// What a load says.
pub(super) enum Carried {
    Load(Load),
    /// That of the tool: its mass is below zero, as that of an entry that nobody has filled in.
    OfTool,
    /// Only the running program knows it.
    Unknown,
}

/// `{M 10.0,CM {X 0,Y 0,Z 100,...},J {...}}`
pub(super) fn load(cursor: &mut Cursor) -> Read<Carried> {
    let (mut mass, mut inside) = (None, None);
    aggregate::each(cursor, |key, _, field| {
        match (key, field) {
            (b"M", aggregate::Field::Number(number)) => mass = Some(number.value),
            (b"CM", aggregate::Field::Nested(start)) => inside = Some(start),
            _ => {}
        }
        Ok(())
    })?;
    let (mass_kg, start) = match (mass, inside) {
        (Some(mass_kg), _) if mass_kg < 0.0 => return Ok(Carried::OfTool),
        (Some(mass_kg), Some(start)) => (mass_kg, start),
        _ => return Ok(Carried::Unknown),
    };
    let centre = aggregate::read(&mut cursor.part(start, cursor.end))?;
    if centre.has & 0b111 != 0b111 || centre.computed {
        return Ok(Carried::Unknown);
    }
    Ok(Carried::Load(Load {
        mass_kg,
        cog_m: std::array::from_fn(|i| m_from_mm(centre.position[i].value)),
    }))
}

/// `{TOOL_NO 1,BASE_NO 2,IPO_FRAME #BASE,...}`
pub(super) fn fdat(cursor: &mut Cursor) -> Read<Fdat> {
    let bytes = cursor.bytes;
    let mut found = Fdat {
        is_external: Some(false),
        ..Fdat::default()
    };
    aggregate::each(cursor, |key, _, field| {
        let number = match field {
            aggregate::Field::Number(number) => whole(Some(number.value)),
            _ => None,
        };
        match (key, field) {
            (b"TOOL_NO", _) => found.tool = number,
            (b"BASE_NO", _) => found.base = number,
            (b"IPO_FRAME", aggregate::Field::Enum(name)) => {
                found.is_external = is_external(&bytes[name.start as usize..name.end as usize]);
            }
            (b"IPO_FRAME", _) => found.is_external = None,
            _ => {}
        }
        Ok(())
    })?;
    Ok(found)
}

/// Whether the robot holds the work piece in the mode of a name behind `#`.
pub(super) fn is_external(name: &[u8]) -> Option<bool> {
    match name.to_ascii_uppercase().as_slice() {
        b"BASE" | b"NONE" => Some(false),
        b"TCP" => Some(true),
        _ => None,
    }
}

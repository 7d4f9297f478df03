//! Poses or joints as CSV, for controllers without a language here.
//!
//! A header names the columns, in any order: `x_mm,y_mm,z_mm,qw,qx,qy,qz` for poses, `q1_deg …
//! q6_deg` for joints. Each row is a target and a move to it: a line to a pose, joints interpolated
//! to joints. Optional columns:
//!
//! | column | meaning |
//! |---|---|
//! | `id` | the target's name in messages |
//! | `branch` | which solution of the inverse, 0 to 7: 4 behind axis 1, 2 behind the lower arm, 1 joint 5 negative |
//! | `near1_deg` … `near6_deg` | joints that the solution is near to |
//! | `tool` | the tool's name; without it the tool is the nameless one |
//! | `frame` | the work frame's name; `world` is the world |
//! | `e1_mm`, `e2_deg` … | where external axes stand, numbered as the profile lists them |
//!
//! Without `frame`, or where its cell is empty, poses are in the frame that `--frame` gives, and in
//! the world without it.
//!
//! Names of columns may have capitals. Other columns are kept, and named once a file; those that are
//! one of the format by another name (`wobj`, `ext1`) are refused. `#` starts a comment line.
//!
//! # Limits
//! Cells are separated by commas, and numbers have a point. `GOTO` lines of APT and CL files are
//! not read: they give a position and the axis of the tool, and a robot's pose has one revolution
//! more, on which the joints depend.

mod header;
mod records;

use super::kit::{Fault, comments, content_start, not_this_language};
use super::notation;
use super::script::{
    Builder, Expr, Held, Instruction, Modal, Place, Remark, Script, Span, Start, ValueId, short,
};
use super::{
    About, Configuration, External, ExternalNames, Language, Layout, Marker, Motion, Number,
    ReadError, Role, Settings, Shape, Source, Target, TargetId, number,
};
use crate::geometry::units::DEG;
use crate::geometry::{Pose, Quaternion};
use foldhash::HashMap;
use header::{Header, Wrong};
use records::{Cell, Records};
use std::borrow::Cow;

/// Poses or joints as CSV.
#[derive(Debug)]
pub struct Csv;

static ABOUT: About = About {
    id: "csv",
    name: "CSV of poses or joints",
    extensions: &["csv"],
    rewrites: &[
        "poses: columns x_mm, y_mm, z_mm, qw, qx, qy, qz",
        "joints: columns q1_deg to q6_deg",
    ],
    leaves: &[
        "other columns, comment lines, quotes, blanks, line ends, encoding",
        "branch and near1_deg to near6_deg, which choose the solution; tool and frame",
    ],
    refuses: &[
        "tables with poses and joints: they are measurements",
        "cells separated by semicolons or tabs, numbers with a decimal comma",
        "GOTO lines of APT and CL files: they do not tell the turn about the tool's axis",
    ],
    has: "header with x_mm, y_mm, z_mm, qw, qx, qy, qz or with q1_deg to q6_deg",
};

/// The frame that poses are in which name none, unless the command line gives another.
const WORLD: &str = "world";
/// So many columns are named that nothing is read from.
const MOST_NAMED: usize = 8;
/// Farther from 1 the length of a quaternion is a mistake.
const LENGTH: std::ops::RangeInclusive<f64> = 0.99..=1.01;

impl Language for Csv {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn recognises(&self, source: &Source) -> bool {
        header::recognises(source)
    }

    fn script(&self, sources: &[Source], settings: &Settings) -> Result<Script, ReadError> {
        script(sources, &settings.external)
    }

    fn frame_of_unframed(&self) -> Option<&'static str> {
        Some(WORLD)
    }

    fn pose_roles(&self, _: Layout) -> &'static [Role] {
        &notation::WITH_QUATERNION[..7]
    }

    fn decimals(&self, role: Role, millimetre_decimals: usize) -> usize {
        match role {
            Role::Position => millimetre_decimals,
            // a thousandth of a millimetre is a millionth of a quaternion part at one metre, 6e-5
            // degrees
            Role::Orientation => millimetre_decimals + 3,
            Role::Joint => millimetre_decimals + 2,
            Role::Configuration => 0,
        }
    }

    fn pose_of(&self, _: Layout, numbers: &[f64]) -> Pose {
        notation::pose_of_quaternion(numbers)
    }

    fn write_pose(&self, _: Layout, pose: &Pose, numbers: &mut [f64]) {
        notation::write_quaternion(pose, numbers);
    }

    fn configuration(&self, layout: Layout, _: &[f64]) -> Configuration {
        header::configuration(layout.variant)
    }

    /// Comment lines at the top.
    fn mark(&self, source: &Source, marker: &Marker) -> (usize, Vec<u8>) {
        let at = content_start(&source.bytes);
        (at, comments(source, marker, "# "))
    }
}

/// Each file is a routine, each row a move.
fn script(sources: &[Source], axes: &ExternalNames) -> Result<Script, ReadError> {
    let mut reader = Reader {
        axes: axes.clone(),
        ..Reader::default()
    };
    let flag = Held::Flag(true);
    reader.honoured = reader.builder.script.value(flag);
    for (file, source) in sources.iter().enumerate() {
        reader.table(source, short(file))?;
    }
    Ok(reader.builder.finish())
}

/// Reads tables into one script.
#[derive(Default)]
struct Reader {
    builder: Builder,
    tools: HashMap<String, ValueId>,
    /// By what the cells say.
    frames: HashMap<String, ValueId>,
    /// Tool and frame of rows that name none: to find empty names among others takes longer.
    nameless: (Option<ValueId>, Option<ValueId>),
    /// Branches are honoured where there are any.
    honoured: ValueId,
    /// External axes that the profile describes.
    axes: ExternalNames,
}

impl Reader {
    fn table(&mut self, source: &Source, file: u32) -> Result<(), ReadError> {
        let mut records = Records::of(&source.bytes);
        let mut cells = Vec::new();
        let unclosed = |at| Fault::unclosed(at, "a quoted cell").in_source(source);
        if !records.next(&mut cells).map_err(unclosed)? {
            return Err(not_this_language(&ABOUT, source));
        }
        let header = read_header(source, &cells)?;
        self.say_unread(source, &header, &cells);
        // one line a row: lists that grow leave holes in the memory
        let rows = memchr::memchr_iter(b'\n', &source.bytes).count();
        let script = &mut self.builder.script;
        script.targets.reserve(rows);
        script.instructions.reserve(rows);
        script.statements.reserve(rows);
        script.numbers.reserve(rows * header.numbers.len());
        let place = Place::new(file, 0);
        let routine = self.builder.declare("", place, Start::Called);
        self.builder.open(routine);
        while records.next(&mut cells).map_err(unclosed)? {
            self.row(source, file, &header, &cells)?;
        }
        Ok(())
    }

    /// Names the columns that nothing is read from.
    fn say_unread(&mut self, source: &Source, header: &Header, cells: &[Cell]) {
        let remarks = [not_counted, not_of_format];
        for (columns, remark) in header.unread.iter().zip(remarks) {
            let Some(&first) = columns.first() else {
                continue;
            };
            let shown = |at: &usize| format!("`{}`", cell_text(source, cells[*at]));
            let mut names: Vec<String> = columns.iter().take(MOST_NAMED).map(shown).collect();
            if let Some(more) = columns.len().checked_sub(MOST_NAMED + 1) {
                names.push(format!("{} more", more + 1));
            }
            let found = remark(&names.join(", ")).found_in(source, short(cells[first].start));
            self.builder.script.findings.push(found);
        }
    }

    fn row(
        &mut self,
        source: &Source,
        file: u32,
        header: &Header,
        cells: &[Cell],
    ) -> Result<(), ReadError> {
        if cells.len() != header.count {
            let last = cells.last().expect("a record has a cell");
            let found = format!("a row of {} cells", cells.len());
            let expected = "as many cells as the header has";
            return Err(unexpected(source, last.end, found, expected));
        }
        let offset = short(cells[0].start - usize::from(cells[0].quoted));
        let start = short(self.builder.script.numbers.len());
        for &column in &header.numbers {
            let found = read_number(source, cells[column])?;
            self.builder.script.numbers.push(found);
        }
        let values = &self.builder.script.numbers[start as usize..];
        if header.shape == Shape::Pose {
            let length = Quaternion(std::array::from_fn(|i| values[3 + i].value)).norm();
            if !LENGTH.contains(&length) {
                let cell = cells[header.numbers[3]];
                let (line, column) = source.line_column(cell.start);
                return Err(ReadError::BadValue {
                    file: source.name.clone(),
                    line,
                    column,
                    value: format!("the quaternion of length {length}"),
                    meaning: "rotation",
                    limit: "the length must be 1",
                });
            }
        }
        let branch = header
            .branch
            .map(|column| read_branch(source, cells[column]));
        let near = match header.near {
            None => None,
            Some(columns) => {
                let mut near = [0.0; 6];
                for (angle, column) in near.iter_mut().zip(columns) {
                    *angle = read_number(source, cells[column])?.value * DEG;
                }
                Some(Box::new(near))
            }
        };
        let text = |column: Option<usize>| column.map(|column| cell_text(source, cells[column]));
        let name = text(header.id).filter(|name| !name.is_empty());
        let tool = self.tool(&text(header.tool).unwrap_or_default());
        let frame = self.frame(&text(header.frame).unwrap_or_default());
        let end = short(cells.last().expect("a record has a cell").end);
        let script = &mut self.builder.script;
        let place = Place::new(file, offset);
        script.targets.push(Target {
            name: name.map(|name| (&*name).into()),
            numbers: start..short(script.numbers.len()),
            ..Target::new(place, end, header.layout(branch.transpose()?))
        });
        let target = script.targets.len() - 1;
        self.external(source, target, header, cells)?;
        let instruction = Instruction {
            end,
            motion: match header.shape {
                Shape::Pose => Motion::Linear,
                Shape::Joints => Motion::Joint,
            },
            target: Expr::Target(target),
            near,
            target_span: Span { start: offset, end },
            ..Instruction::at(Place::new(file, offset))
        };
        let modal = Modal {
            tool: Expr::Value(tool),
            frame: Expr::Value(frame),
            configured: match header.branch {
                Some(_) => Expr::Value(self.honoured),
                None => Expr::Absent,
            },
            ..Modal::default()
        };
        self.builder.go(instruction, modal);
        Ok(())
    }

    /// Where external axes stand at a target.
    fn external(
        &mut self,
        source: &Source,
        target: TargetId,
        header: &Header,
        cells: &[Cell],
    ) -> Result<(), ReadError> {
        for axis in &header.external {
            let cell = cells[axis.column];
            let value = read_number(source, cell)?.value;
            let (is_linear, script) = (
                self.axes.linear.get(usize::from(axis.number)),
                &mut self.builder.script,
            );
            match is_linear {
                Some(is_linear) if *is_linear != axis.is_linear => {
                    let found = shown(&source.bytes[cell.start..cell.end]);
                    let expected = if *is_linear {
                        "a value in mm (the column with `_mm`; the axis is linear)"
                    } else {
                        "a value in degrees (the column with `_deg`; the axis is rotary)"
                    };
                    return Err(unexpected(source, cell.start, found, expected));
                }
                Some(_) => {
                    let axis = axis.number;
                    script.externals.push((target, External { axis, value }));
                }
                // what stands at zero is mostly not there
                None if value != 0.0 => {
                    let unit = if axis.is_linear { "mm" } else { "deg" };
                    let name = format!("e{}_{unit}", u16::from(axis.number) + 1);
                    script.refuse(target, Remark::external_unknown(&name, value));
                }
                None => {}
            }
        }
        Ok(())
    }

    fn tool(&mut self, name: &str) -> ValueId {
        if name.is_empty() {
            let script = &mut self.builder.script;
            return *self
                .nameless
                .0
                .get_or_insert_with(|| script.frame(name, None));
        }
        if let Some(&known) = self.tools.get(name) {
            return known;
        }
        let tool = self.builder.script.frame(name, None);
        self.tools.insert(name.to_owned(), tool);
        tool
    }

    /// A frame by its name; without one it is the world, wherever that is said to be.
    fn frame(&mut self, name: &str) -> ValueId {
        if name.is_empty() {
            let script = &mut self.builder.script;
            return *self
                .nameless
                .1
                .get_or_insert_with(|| script.frame(WORLD, None));
        }
        if let Some(&known) = self.frames.get(name) {
            return known;
        }
        let is_world = (name == WORLD).then(Pose::identity);
        let frame = self.builder.script.frame(name, is_world);
        self.frames.insert(name.to_owned(), frame);
        frame
    }
}

/// Columns that say of measurements how the arm came to stand there, or the like.
fn not_counted(columns: &str) -> Remark {
    Remark::warning_about(
        "columns-not-read",
        format!(
            "{columns}: no correction follows from these columns; the robot is taken to come from \
             the row before, and to carry the load of its tool"
        ),
        "leave them out where that is meant",
    )
}

/// Columns of other names.
fn not_of_format(columns: &str) -> Remark {
    Remark::note_about(
        "columns-not-read",
        format!("no columns of the format: {columns}"),
        "where one is, call it as docs/formats.md does",
    )
}

fn read_header(source: &Source, cells: &[Cell]) -> Result<Header, ReadError> {
    Header::of(&header::names(source, cells)).map_err(|wrong| {
        let shown = |cell: Cell| format!("`{}`", cell_text(source, cell));
        match wrong {
            Wrong::Missing => not_this_language(&ABOUT, source),
            Wrong::Both => {
                let found = "a header with poses and joints".to_owned();
                let expected = "a table of poses or one of joints";
                unexpected(source, cells[0].start, found, expected)
            }
            Wrong::Twice(at) => {
                let found = format!("{} once more", shown(cells[at]));
                unexpected(source, cells[at].start, found, "another column")
            }
            Wrong::Branch(at) => {
                let found = format!("{} next to near1_deg … near6_deg", shown(cells[at]));
                let expected = "one of the two, which both choose the solution,";
                unexpected(source, cells[at].start, found, expected)
            }
            Wrong::Meant(at, expected) => {
                unexpected(source, cells[at].start, shown(cells[at]), expected)
            }
            Wrong::Separator => {
                let found = "a semicolon or a tab between cells".to_owned();
                unexpected(source, cells[0].start, found, "a comma")
            }
            Wrong::Without(column) => {
                let found = format!("a header without `{column}`");
                unexpected(source, cells[0].start, found, "one of poses or of joints")
            }
            Wrong::Near => {
                let found = "some of them".to_owned();
                unexpected(
                    source,
                    cells[0].start,
                    found,
                    "near1_deg to near6_deg or none of them",
                )
            }
        }
    })
}

fn read_number(source: &Source, cell: Cell) -> Result<Number, ReadError> {
    let text = &source.bytes[cell.start..cell.end];
    let fault = || unexpected(source, cell.start, shown(text), "a finite number");
    number::placed(text, cell.start).ok_or_else(fault)
}

fn read_branch(source: &Source, cell: Cell) -> Result<u8, ReadError> {
    let value = read_number(source, cell)?.value;
    let branch = (0..8).find(|&branch| f64::from(branch) == value);
    branch.ok_or_else(|| {
        let found = shown(&source.bytes[cell.start..cell.end]);
        unexpected(
            source,
            cell.start,
            found,
            "a branch, a whole number from 0 to 7,",
        )
    })
}

/// A cell for messages.
fn shown(text: &[u8]) -> String {
    match text {
        [] => "an empty cell".to_owned(),
        _ => format!("`{}`", Source::text(&text[..text.len().min(40)])),
    }
}

/// The text that a cell stands for.
fn cell_text(source: &Source, cell: Cell) -> Cow<'_, str> {
    let text = Source::text(&source.bytes[cell.start..cell.end]);
    if cell.quoted {
        text.replace("\"\"", "\"").into()
    } else {
        text
    }
}

fn unexpected(source: &Source, at: usize, found: String, expected: &'static str) -> ReadError {
    let (line, column) = source.line_column(at);
    ReadError::Unexpected {
        file: source.name.clone(),
        line,
        column,
        found,
        expected,
    }
}

#[cfg(test)]
mod tests;

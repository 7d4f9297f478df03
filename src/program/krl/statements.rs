//! Statements of a routine into [`Notes`].

use super::aggregate;
use super::notes::{
    Action, Assigned, Bas, Flow, Given, Index, NO_WITH, Operand, Part, Passed, Path, Point, Read,
    Statement, Variable, With,
};
use super::reader::{Reader, fdat, ipo};
use super::tokens::{Cursor, Fault, Kind, Place, Token, capitals, index};

/// A motion keyword.
fn motion(word: &[u8]) -> Option<(Path, bool)> {
    Some(match word {
        b"PTP" | b"SPTP" => (Path::Joint, false),
        b"LIN" | b"SLIN" | b"SPL" => (Path::Linear, false),
        b"CIRC" | b"SCIRC" => (Path::Arc, false),
        b"PTP_REL" | b"SPTP_REL" => (Path::Joint, true),
        b"LIN_REL" | b"SLIN_REL" | b"SPL_REL" => (Path::Linear, true),
        b"CIRC_REL" | b"SCIRC_REL" => (Path::Arc, true),
        _ => return None,
    })
}

/// Whether a word in capitals starts a move.
pub fn is_motion(word: &[u8]) -> bool {
    motion(word).is_some()
}

impl<'a> Reader<'a, '_> {
    /// One line of a routine; `word` is its first token in capitals.
    pub(super) fn statement(
        &mut self,
        first: Token,
        word: &[u8],
        mut cursor: Cursor<'a>,
    ) -> Read<()> {
        if let Some((path, relative)) = motion(word) {
            let next = cursor.peek();
            // a variable or label may have such a name
            if !next.is(b'=') && !next.is(b':') && !next.is(b'.') {
                return if relative {
                    self.relative(first, path, cursor)
                } else {
                    self.motion(first, path, cursor)
                };
            }
        }
        let flow = match word {
            b"IF" => Some(Flow::If),
            b"ELSE" => Some(Flow::Else),
            b"ENDIF" => Some(Flow::EndIf),
            b"SWITCH" => Some(Flow::Switch),
            b"CASE" => Some(Flow::Case),
            b"DEFAULT" => Some(Flow::Default),
            b"ENDSWITCH" => Some(Flow::EndSwitch),
            b"LOOP" | b"WHILE" | b"FOR" | b"REPEAT" => Some(Flow::Repeat),
            b"ENDLOOP" => Some(Flow::EndEndless),
            b"ENDWHILE" | b"ENDFOR" => Some(Flow::EndCounted),
            b"UNTIL" => Some(Flow::Until),
            b"EXIT" => Some(Flow::Exit),
            b"RETURN" => Some(Flow::Return),
            b"GOTO" => {
                let label = cursor.next();
                Some(Flow::Goto(self.symbol(&cursor, label)))
            }
            _ => None,
        };
        if let Some(flow) = flow
            && !cursor.peek().is(b'=')
        {
            self.push(first, Action::Flow(flow));
            return Ok(());
        }
        match word {
            b"SPLINE" | b"PTP_SPLINE" => {
                let with = self.with(cursor)?;
                self.push(first, Action::Spline(with));
                return Ok(());
            }
            b"ENDSPLINE" => {
                self.push(first, Action::EndSpline);
                return Ok(());
            }
            b"BAS" if cursor.peek().is(b'(') => {
                self.bas(first, cursor);
                return Ok(());
            }
            b"WAIT" | b"HALT" | b"INTERRUPT" | b"TRIGGER" | b"BRAKE" | b"RESUME" | b"CONTINUE"
            | b"ANIN" | b"ANOUT" | b"PULSE" => return Ok(()),
            _ => {}
        }
        let at = cursor.brackets()?;
        let mut component = false;
        while cursor.take(b'.') {
            cursor.next();
            cursor.brackets()?;
            component = true;
        }
        let next = cursor.next();
        match next.kind {
            Kind::Sign(b'=') => self.assignment(first, word, at, component, cursor),
            Kind::Sign(b':') if cursor.peek().kind == Kind::End => {
                let label = self.symbol(&cursor, first);
                self.push(first, Action::Flow(Flow::Label(label)));
                Ok(())
            }
            Kind::Sign(b'(') => {
                self.call(first, cursor);
                Ok(())
            }
            _ => Ok(()),
        }
    }

    fn set(&mut self, first: Token, variable: Variable, given: Given) {
        self.notes.given.push(given);
        let given = index(self.notes.given.len() - 1);
        self.push(first, Action::Set(variable, given));
    }

    fn push(&mut self, first: Token, action: Action) {
        let routine = self.routine();
        let place = self.place(first);
        self.notes.statements.push(Statement {
            place,
            routine,
            action,
        });
    }

    /// `LIN target C_DIS WITH ...`, `CIRC via, end, CA 90`
    fn motion(&mut self, first: Token, path: Path, mut cursor: Cursor<'a>) -> Read<()> {
        let mut points = [Point::Computed; 2];
        points[0] = self.point(&mut cursor)?;
        let mut count = 1;
        if path == Path::Arc && cursor.take(b',') {
            points[1] = self.point(&mut cursor)?;
            count = 2;
        }
        let start = index(self.notes.points.len());
        self.notes.points.extend_from_slice(&points[..count]);
        let part = (start, index(self.notes.points.len()));
        let with = self.with(cursor)?;
        self.push(
            first,
            Action::Move {
                path,
                points: part,
                with,
            },
        );
        Ok(())
    }

    fn point(&mut self, cursor: &mut Cursor<'a>) -> Read<Point> {
        let mut operands = [Operand::Other; 8];
        let mut count = 0;
        let mut present = false;
        loop {
            let operand = match cursor.blanks() {
                b'{' => {
                    let start = cursor.at;
                    let aggregate = aggregate::read(cursor)?;
                    Operand::Inline(self.add(&aggregate, start, None))
                }
                0 | b';' => {
                    return Err(Fault::unexpected(cursor.next(), "a position"));
                }
                _ => {
                    let name = cursor.next();
                    let mut buffer = [0; 24];
                    if name.kind == Kind::Name {
                        present |= is_present(capitals(cursor.text(name), &mut buffer));
                        let at = cursor.brackets()?;
                        if matches!(cursor.blanks(), b'.' | b'(') {
                            cursor.skip();
                            Operand::Other
                        } else {
                            let symbol = self.symbol(cursor, name);
                            Operand::Named(symbol, self.element(at, cursor))
                        }
                    } else {
                        cursor.skip();
                        Operand::Other
                    }
                }
            };
            if let Some(slot) = operands.get_mut(count) {
                *slot = operand;
            }
            count += 1;
            if !cursor.take(b':') {
                break;
            }
        }
        if count > operands.len() {
            return Ok(Point::Computed);
        }
        Ok(match (count, operands[0]) {
            (1, _) if present => Point::Present,
            (1, Operand::Inline(target)) => Point::Inline(target),
            (1, Operand::Named(name, index)) => Point::Named(name, index),
            (1, Operand::Other) => Point::Computed,
            _ => Point::Product(self.push_operands(&operands[..count])),
        })
    }

    /// `LIN_REL {Z 100} #BASE`
    fn relative(&mut self, first: Token, path: Path, mut cursor: Cursor<'a>) -> Read<()> {
        let (mut axes, mut by) = (false, None);
        if cursor.blanks() == b'{' {
            let found = aggregate::read(&mut cursor)?;
            axes = found.is_axes();
            let next = cursor.next();
            let word = cursor.next();
            let mut buffer = [0; 24];
            let frame = match (next.is(b'#'), capitals(cursor.text(word), &mut buffer)) {
                (true, b"TOOL") => Some(true),
                (true, b"BASE") | (false, _) => Some(false),
                _ => None,
            };
            // turns are added to the angles, which is no motion of its own
            if let (Some(in_tool), false, 0) = (frame, found.computed, found.has & !0b111)
                && !axes
            {
                let part = |i: usize| {
                    if found.has & 1 << i == 0 {
                        0.0
                    } else {
                        found.position[i].value
                    }
                };
                by = Some((std::array::from_fn(part), in_tool));
            }
        }
        let action = if path == Path::Arc {
            Action::Relative {
                path,
                axes: false,
                by: None,
            }
        } else {
            let by = by.map(|by| {
                self.notes.offsets.push(by);
                index(self.notes.offsets.len() - 1)
            });
            Action::Relative { path, axes, by }
        };
        self.push(first, action);
        Ok(())
    }

    /// What stands behind WITH.
    fn with(&mut self, mut cursor: Cursor<'a>) -> Read<u32> {
        let mut buffer = [0; 24];
        loop {
            let token = cursor.next();
            match token.kind {
                Kind::End => return Ok(NO_WITH),
                Kind::Name if capitals(cursor.text(token), &mut buffer) == b"WITH" => break,
                _ => {}
            }
        }
        let mut with = With::default();
        loop {
            let name = cursor.next();
            cursor.brackets()?;
            while cursor.take(b'.') {
                cursor.next();
            }
            if name.kind != Kind::Name || !cursor.take(b'=') {
                break;
            }
            let mut buffer = [0; 24];
            match capitals(cursor.text(name), &mut buffer) {
                b"$TOOL" => with.tool = Some(self.given(Variable::Tool, &mut cursor)?),
                b"$BASE" => with.base = Some(self.given(Variable::Base, &mut cursor)?),
                b"$IPO_MODE" => with.ipo = Some(self.given(Variable::Ipo, &mut cursor)?),
                _ => cursor.skip(),
            }
            if !cursor.take(b',') {
                break;
            }
        }
        if with.tool.is_none() && with.base.is_none() && with.ipo.is_none() {
            return Ok(NO_WITH);
        }
        self.notes.withs.push(with);
        Ok(index(self.notes.withs.len() - 1))
    }

    /// The value given to a variable of the controller, up to a comma or the end of the line.
    fn given(&mut self, variable: Variable, cursor: &mut Cursor<'a>) -> Read<Given> {
        let given = self.simple(variable, cursor)?;
        match cursor.blanks() {
            0 | b',' | b';' => Ok(given),
            // C_DIS behind the last WITH
            _ if cursor.peek().kind == Kind::Name => Ok(given),
            _ => {
                cursor.skip();
                Ok(Given::Computed)
            }
        }
    }

    fn simple(&mut self, variable: Variable, cursor: &mut Cursor<'a>) -> Read<Given> {
        if cursor.blanks() == b'{' {
            if variable == Variable::Fdat {
                return Ok(Given::Fdat(fdat(cursor)?));
            }
            let found = aggregate::read(cursor)?;
            return Ok(found.frame().map_or(Given::Computed, Given::Literal));
        }
        if cursor.take(b'#') {
            let name = cursor.next();
            return Ok(if variable == Variable::Ipo {
                Given::Ipo(ipo(cursor.text(name)))
            } else {
                Given::Computed
            });
        }
        let name = cursor.next();
        if name.kind != Kind::Name {
            return Ok(Given::Computed);
        }
        let at = cursor.brackets()?;
        let mut buffer = [0; 24];
        let word = capitals(cursor.text(name), &mut buffer);
        let element = self.element(at, cursor);
        let table = matches!(
            (variable, word),
            (Variable::Tool, b"TOOL_DATA") | (Variable::Base, b"BASE_DATA")
        );
        if table {
            return Ok(match element {
                Index::At([element, 0, 0]) => Given::Entry(element),
                _ => Given::Computed,
            });
        }
        if matches!(word, b"STOOL" | b"STOOL2" | b"SBASE" | b"SIPO_MODE") && cursor.take(b'(') {
            return Ok(self.of_fdat(variable, cursor));
        }
        if matches!(cursor.blanks(), b'.' | b'(') {
            cursor.skip();
            let moving = (variable, word) == (Variable::Base, b"EK");
            return Ok(if moving {
                Given::Moving
            } else {
                Given::Computed
            });
        }
        Ok(match (variable, word) {
            (Variable::Tool | Variable::Base, b"$NULLFRAME") | (Variable::Base, b"$WORLD") => {
                Given::Zero
            }
            (Variable::Ipo, _) => Given::Computed,
            (Variable::Fdat, _) => Given::OfFdat(self.symbol(cursor, name), element),
            _ => Given::Named(self.symbol(cursor, name), element),
        })
    }

    /// `FP1)`, `FP1.BASE_NO)`, `2)`, `#BASE)` behind the opening bracket.
    fn of_fdat(&mut self, variable: Variable, cursor: &mut Cursor<'a>) -> Given {
        let token = cursor.next();
        let mut given = Given::Computed;
        match token.kind {
            Kind::Name => {
                let symbol = self.symbol(cursor, token);
                if cursor.take(b'.') {
                    let mut buffer = [0; 24];
                    let part = cursor.next();
                    let part = capitals(cursor.text(part), &mut buffer);
                    let fits = matches!(
                        (variable, part),
                        (Variable::Tool, b"TOOL_NO")
                            | (Variable::Base, b"BASE_NO")
                            | (Variable::Ipo, b"IPO_FRAME")
                    );
                    if fits {
                        given = Given::OfFdat(symbol, Index::Whole);
                    }
                } else {
                    given = Given::OfFdat(symbol, Index::Whole);
                }
            }
            Kind::Number => {
                if let Some(element) = number_of(cursor.text(token)) {
                    given = Given::Entry(element);
                }
            }
            Kind::Sign(b'#') => {
                let name = cursor.next();
                given = Given::Ipo(ipo(cursor.text(name)));
            }
            _ => {}
        }
        if cursor.take(b')') {
            return given;
        }
        cursor.skip();
        cursor.take(b')');
        Given::Computed
    }

    /// `BAS(#TOOL,1)`
    fn bas(&mut self, first: Token, mut cursor: Cursor<'a>) {
        cursor.take(b'(');
        if !cursor.take(b'#') {
            // a command that only the running program knows
            for variable in [Variable::Tool, Variable::Base] {
                self.set(first, variable, Given::Computed);
            }
            return;
        }
        let command = cursor.next();
        let mut buffer = [0; 24];
        let word = capitals(cursor.text(command), &mut buffer);
        let mut argument = || {
            let token = if cursor.take(b',') {
                cursor.next()
            } else {
                return Some(0);
            };
            let alone = cursor.peek().is(b')');
            number_of(cursor.text(token)).filter(|_| alone)
        };
        let bas = match word {
            b"INITMOV" => Bas::Init,
            b"FRAMES" | b"PTP_PARAMS" | b"CP_PARAMS" | b"PARAMS" => Bas::Frames,
            b"TOOL" => Bas::Tool(argument()),
            b"BASE" => Bas::Base(argument()),
            _ => return,
        };
        self.push(first, Action::Bas(bas));
    }

    /// An assignment; the cursor stands behind `=`.
    fn assignment(
        &mut self,
        first: Token,
        word: &[u8],
        at: Option<(usize, usize)>,
        component: bool,
        mut cursor: Cursor<'a>,
    ) -> Read<()> {
        if cursor.take(b'=') {
            return Ok(());
        }
        let variable = match word {
            b"$TOOL" => Some(Variable::Tool),
            b"$BASE" => Some(Variable::Base),
            b"$IPO_MODE" => Some(Variable::Ipo),
            b"FDAT_ACT" => Some(Variable::Fdat),
            _ => None,
        };
        if let Some(variable) = variable {
            let given = if component {
                Given::Computed
            } else {
                self.given(variable, &mut cursor)?
            };
            self.set(first, variable, given);
            return Ok(());
        }
        if matches!(word, b"TOOL_DATA" | b"BASE_DATA") {
            let mut value = cursor;
            if component {
                // a part of it
                value.at = value.end;
            }
            self.table(first, at, &mut value)?;
            return Ok(());
        }
        if word.first() == Some(&b'$') {
            return Ok(());
        }
        let name = self.symbol(&cursor, first);
        let mentions = if component {
            (0, 0)
        } else {
            self.mentions(cursor)
        };
        let assigned = Assigned {
            name,
            index: self.element(at, &cursor),
            context: self.context(),
            place: self.place(first),
            mentions,
        };
        self.notes.assigned.push(assigned);
        Ok(())
    }

    /// The names in the rest of the line that are no components.
    fn mentions(&mut self, mut cursor: Cursor<'a>) -> Part {
        let start = index(self.notes.mentions.len());
        let mut before = b' ';
        let mut open = 0_u32;
        loop {
            let token = cursor.next();
            match token.kind {
                Kind::End => break,
                // in an aggregate it is a number that is taken, not a position
                Kind::Sign(b'{') => open += 1,
                Kind::Sign(b'}') => open = open.saturating_sub(1),
                Kind::Name if open == 0 && before != b'.' && before != b'#' => {
                    let is_whole = !cursor.peek().is(b'.');
                    if is_whole {
                        let name = self.symbol(&cursor, token);
                        self.notes.mentions.push(name);
                    }
                }
                _ => {}
            }
            before = self.byte(token);
        }
        (start, index(self.notes.mentions.len()))
    }

    fn byte(&self, token: Token) -> u8 {
        match token.kind {
            Kind::Sign(sign) => sign,
            _ => b' ',
        }
    }

    /// `routine(a, b)`; the cursor stands behind the bracket.
    fn call(&mut self, first: Token, mut cursor: Cursor<'a>) {
        let callee = self.symbol(&cursor, first);
        let place: Place = self.place(first);
        let mut fresh = true;
        loop {
            let token = cursor.next();
            match token.kind {
                Kind::End => break,
                Kind::Name if fresh => {
                    let mut after = cursor;
                    let at = after.brackets().unwrap_or(None);
                    let ends = after.peek();
                    if ends.is(b',') || ends.is(b')') {
                        let name = self.symbol(&cursor, token);
                        let passed = Passed {
                            name,
                            index: self.element(at, &cursor),
                            context: self.context(),
                            place,
                            callee,
                        };
                        self.notes.passed.push(passed);
                        cursor = after;
                    }
                    fresh = false;
                }
                Kind::Sign(b'(' | b',' | b':') => fresh = true,
                _ => fresh = false,
            }
        }
        self.push(first, Action::Call(callee));
    }
}

/// Where the robot is or was: a move there goes back to a place that was reached before.
fn is_present(word: &[u8]) -> bool {
    matches!(
        word,
        b"$AXIS_ACT"
            | b"$AXIS_INT"
            | b"$AXIS_RET"
            | b"$AXIS_BACK"
            | b"$AXIS_FOR"
            | b"$POS_ACT"
            | b"$POS_INT"
            | b"$POS_RET"
            | b"$POS_BACK"
            | b"$POS_FOR"
            | b"$H_POS"
    )
}

/// A whole number of a table.
fn number_of(text: &[u8]) -> Option<u32> {
    std::str::from_utf8(text).ok()?.parse().ok()
}

//! `/MN`: the instructions of a program, as far as they concern points, tools and frames.

use super::meaning::{motion, understand};
use super::points::offset;
use super::sections::line_end;
use std::ops::Range;

/// Which point an instruction names.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Named {
    /// `P[3]`, `P[3:name]`
    Point(u32),
    /// `P[R[1]]`: any point of the program.
    Any,
    /// `PR[..]`: a position register.
    Register,
}

/// How the robot gets to a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Way {
    Joint,
    Linear,
    ArcVia,
    ArcEnd,
    /// `A`: a point of a row that arcs are laid through.
    ArcRow,
}

/// What follows the point in a move, as far as it matters.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[allow(clippy::struct_excessive_bools)]
pub struct Extras {
    /// `Offset`, `Tool_Offset`, `VOFFSET` and the like.
    pub displaced: bool,
    /// `INC`
    pub incremental: bool,
    /// `RTCP`
    pub remote: bool,
    /// `COORD`
    pub coordinated: bool,
    /// `Wjnt`
    pub wrist_joint: bool,
}

/// Tool or work frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Which {
    Tool,
    Frame,
    /// A word of another dictionary that may be either.
    Either,
}

/// What one instruction does.
#[derive(Clone, Debug, PartialEq)]
pub enum Event {
    /// A move to a point.
    Move { way: Way, to: Named, extras: Extras },
    /// `UTOOL_NUM=1`; `None` where a register says which.
    Select { which: Which, number: Option<u32> },
    /// `UFRAME[6]=PR[60]`; `None` where a register says which.
    Assign { which: Which, number: Option<u32> },
    /// A place that the program may come to from elsewhere, or a block that it may pass over.
    Join,
    /// A call of this program, in capitals.
    Call(Box<[u8]>),
    /// `PR[4]=P[2]`
    Copy(Named),
    /// A point in an instruction that is not known.
    Mention(Named),
}

/// Reads the instructions of a section.
pub struct Instructions<'a> {
    bytes: &'a [u8],
    at: usize,
    end: usize,
    text: Vec<u8>,
}

impl<'a> Instructions<'a> {
    /// The instructions in this range.
    pub fn new(bytes: &'a [u8], range: Range<usize>) -> Self {
        Self {
            bytes,
            at: range.start,
            end: range.end,
            text: Vec::new(),
        }
    }

    /// Hands over what each instruction does, with its first byte.
    pub fn each(mut self, mut take: impl FnMut(u32, Event)) {
        while let Some(start) = self.next() {
            let text = std::mem::take(&mut self.text);
            understand(&text, |event| take(offset(start), event));
            self.text = text;
        }
    }

    /// Brings the next instruction's text, its lines joined, into `self.text`; returns its first byte.
    fn next(&mut self) -> Option<usize> {
        self.text.clear();
        loop {
            let (start, _) = self.line_start()?;
            let rest = &self.bytes[start..self.end];
            if rest.starts_with(b"!") || rest.starts_with(b"--") {
                self.at = line_end(self.bytes, start).min(self.end);
                continue;
            }
            self.at = start;
            self.collect();
            return Some(start);
        }
    }

    /// The first byte of what stands behind blanks, empty lines, line number and colon, and whether there was a number.
    fn line_start(&self) -> Option<(usize, bool)> {
        let bytes = &self.bytes[..self.end];
        let mut at = self.at;
        let skip = |at: &mut usize| {
            while bytes
                .get(*at)
                .is_some_and(|b| b.is_ascii_whitespace() || *b == b';')
            {
                *at += 1;
            }
        };
        skip(&mut at);
        let digits = bytes[at..]
            .iter()
            .take_while(|b| b.is_ascii_digit())
            .count();
        let mut behind = at + digits;
        while matches!(bytes.get(behind), Some(b' ' | b'\t')) {
            behind += 1;
        }
        let colon = bytes.get(behind) == Some(&b':');
        if colon {
            at = behind + 1;
            while matches!(bytes.get(at), Some(b' ' | b'\t')) {
                at += 1;
            }
        }
        (at < bytes.len()).then_some((at, colon && digits > 0))
    }

    /// Joins lines up to the `;`. A line with a number of its own, or that starts a move, is another instruction.
    fn collect(&mut self) {
        loop {
            let line = line_end(self.bytes, self.at).min(self.end);
            let rest = &self.bytes[self.at..line];
            if let Some(semicolon) = semicolon(rest) {
                self.text.extend_from_slice(&rest[..semicolon]);
                self.at += semicolon + 1;
                return;
            }
            self.text.extend_from_slice(rest.trim_ascii_end());
            self.text.push(b' ');
            self.at = line;
            let Some((start, numbered)) = self.line_start() else {
                self.at = self.end;
                return;
            };
            let ahead = &self.bytes[start..self.end];
            let other = numbered || motion(ahead).is_some() || ahead.starts_with(b"!");
            if other || self.text.len() > MOST_TEXT {
                return;
            }
            self.at = start;
        }
    }
}

/// Bytes of an instruction; what is longer is none.
const MOST_TEXT: usize = 1 << 16;

/// The `;` that ends an instruction: not one in a string.
fn semicolon(line: &[u8]) -> Option<usize> {
    let found = memchr::memchr(b';', line)?;
    if memchr::memchr(b'\'', &line[..found]).is_none() {
        return Some(found);
    }
    let mut inside = false;
    let outside = line.iter().position(|&b| {
        inside ^= b == b'\'';
        b == b';' && !inside
    });
    outside.or(Some(found))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn events(text: &str) -> Vec<Event> {
        let mut all = Vec::new();
        let bytes = text.as_bytes();
        Instructions::new(bytes, 0..bytes.len()).each(|_, event| all.push(event));
        all
    }

    fn goes(text: &str) -> Vec<(Way, Named)> {
        let moves = events(text).into_iter().filter_map(|event| match event {
            Event::Move { way, to, .. } => Some((way, to)),
            _ => None,
        });
        moves.collect()
    }

    fn extras_of(text: &str) -> Extras {
        match events(text).first() {
            Some(Event::Move { extras, .. }) => *extras,
            other => panic!("{other:?}"),
        }
    }

    use Named::{Any, Point, Register};

    #[test]
    fn moves_are_read_with_and_without_numbers_and_blanks() {
        for text in [
            "   5:J P[1] 100% FINE    ;\n",
            "5: J P[1:a name] 100% CNT100 ;",
            "    :J P[1] 100% FINE ;",
            "J P[1:\"x\"] 5% CNT2 ;\r",
            "\t5:J   P[ 1 : n ] R[5:INC]% CNT R[1] ;",
        ] {
            assert_eq!(goes(text), [(Way::Joint, Point(1))], "{text}");
        }
        let two = "1:L P[1] 100mm/sec FINE\n2:L P[2] 100mm/sec FINE ;\n";
        assert_eq!(
            goes(two),
            [(Way::Linear, Point(1)), (Way::Linear, Point(2))]
        );
        let unnumbered = ":L P[1] 100mm/sec FINE\n:J P[2] 100% FINE ;\n";
        assert_eq!(goes(unnumbered).len(), 2);
        let one_line = "1:L P[1] 9mm/sec FINE ; ! then L P[9] ;\n2:S P[2] 9mm/sec CNT5 ; L P[3] 9mm/sec FINE ;";
        assert_eq!(goes(one_line).len(), 3);
    }

    #[test]
    fn arcs_have_two_points_on_one_line_or_two() {
        for text in [
            "  31:C P[23] \n       P[24] 250mm/sec CNT2 ;\n",
            "  31:C P[23]    \r\n    :  P[24:end] 250mm/sec CNT2 ;\r\n",
            "  31:C P[23] P[24] 250mm/sec CNT2 ;",
        ] {
            assert_eq!(
                goes(text),
                [(Way::ArcVia, Point(23)), (Way::ArcEnd, Point(24))],
                "{text}"
            );
        }
        assert_eq!(goes("1:A P[2] 9mm/sec FINE ;"), [(Way::ArcRow, Point(2))]);
        assert_eq!(
            goes("1:C P[R[1]]\n : PR[2:x] 9mm/sec FINE ;"),
            [(Way::ArcVia, Any), (Way::ArcEnd, Register)]
        );
    }

    #[test]
    fn comments_remarks_and_strings_are_no_instructions() {
        for text in [
            "  1:  !L P[1] 40mm/sec FINE ;\n",
            "  1:  --eg:L P[1] 40mm/sec FINE ;\n",
            "  1:  //L P[1] 40mm/sec FINE ;\n",
            "  1:  MESSAGE[L P[1] now] ;\n",
            "  1:  CALL LOG('P[1]') ;\n  2:   ;\n   : ;\n",
            "  1:  ! no end\n",
        ] {
            let moving = events(text)
                .into_iter()
                .filter(|event| !matches!(event, Event::Call(_)));
            assert_eq!(moving.count(), 0, "{text}");
        }
    }

    #[test]
    fn blocks_inside_moves_are_read_as_instructions() {
        let text = "   5:J P[1] 100% CNT0 ACC100 TB    .10sec,P-SPS    ;\n      1:  TC_ONLINE (ON) ;\n      2:  UFRAME_NUM=3 ;\n       ------ ;\n   6:J P[2] 100% CNT100 ;\n";
        let select = Event::Select {
            which: Which::Frame,
            number: Some(3),
        };
        assert!(events(text).contains(&select));
        assert_eq!(goes(text).len(), 2);
    }

    #[test]
    fn what_follows_a_point_is_told() {
        let plain =
            "L P[1] R[25:INC Offset]mm/sec FINE ACC100 TB .10sec,CALL RTCP(1) Skip,LBL[3:COORD] ;";
        assert_eq!(extras_of(plain), Extras::default());
        assert!(extras_of("J P[1] 100% FINE Tool_Offset,PR[2] ;").displaced);
        assert!(extras_of("J P[1] 100% FINE Offset,PR[60:Corr] ;").displaced);
        assert!(extras_of("J P[1] 100% FINE WKZ_Offset ;").displaced);
        assert!(extras_of("L P[1] 9mm/sec FINE VOFFSET,VR[1] ;").displaced);
        assert!(extras_of("L P[1] 9mm/sec FINE INC ;").incremental);
        assert!(extras_of("L P[1] 9mm/sec FINE RTCP ;").remote);
        assert!(extras_of("L P[1] WELD_SPEED CNT100 COORD PTH ;").coordinated);
        assert!(extras_of("L P[1] 9mm/sec FINE Wjnt ;").wrist_joint);
    }

    #[test]
    fn tools_and_frames_are_selected_and_assigned() {
        use Which::{Either, Frame, Tool};
        let select = |which, number| vec![Event::Select { which, number }];
        let assign = |which, number| vec![Event::Assign { which, number }];
        for (text, wanted) in [
            ("UTOOL_NUM=5 ;", select(Tool, Some(5))),
            ("UFRAME_NUM=R[20:Rack] ;", select(Frame, None)),
            ("WKZ_NUM=24 ;", select(Tool, Some(24))),
            ("BENUTZER_NUM=0 ;", select(Frame, Some(0))),
            ("$MNUTOOLNUM[1]= 1;", select(Tool, Some(1))),
            ("$MNUTOOLNUM[2]= 1;", vec![]),
            ("UFRAME[6]=PR[60] ;", assign(Frame, Some(6))),
            ("UTOOL[R[1]]=PR[60] ;", assign(Tool, None)),
            ("$MNUTOOL[1,3]=PR[2] ;", assign(Tool, Some(3))),
            ("XYZ[6]=PR[60] ;", assign(Either, Some(6))),
            ("R[6]=PR[60,3] ;", vec![]),
            ("PR[4]=P[2:x] ;", vec![Event::Copy(Point(2))]),
            ("P[2]=PR[4] ;", vec![Event::Mention(Point(2))]),
            ("GOTO_P P[7],5 ;", vec![Event::Mention(Point(7))]),
            ("LBL[3:P[1]] ;", vec![Event::Join]),
        ] {
            assert_eq!(events(text), wanted, "{text}");
        }
    }
}

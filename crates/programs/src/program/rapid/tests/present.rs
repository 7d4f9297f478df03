//! What numbers are at a statement.

use super::*;

/// How far up moves lead from p1, mm; `None` where several writes may be the last.
fn up(statements: &str, more: &str) -> Vec<Option<f64>> {
    let text = format!(
        "MODULE m\n CONST robtarget p1:=[[1,2,3],[1,0,0,0],CONF;\n VAR num h;\n VAR num k:=7;\n\
         VAR intnum i1;\n\
         PERS tooldata t:=[TRUE,[[0,0,100],[1,0,0,0]],[1.5,[0,0,50],[1,0,0,0],0,0,0]];\n\
         PROC main()\n{statements}\nENDPROC\n{more}\nENDMODULE\n"
    );
    let program = read(&text);
    let by = program.moves.iter().map(|used| match &used.displacement {
        Displacement::None => Some(0.0),
        Displacement::By(shift) => Some((shift.in_frame.translation[2] * 1e6).round() / 1e3),
        _ => None,
    });
    by.collect()
}

const GO: &str = "MoveL Offs(p1,0,0,h),v5,z5,t;";

#[test]
fn what_was_written_last_counts() {
    for (statements, expected) in [
        (format!("h:=20;\n{GO}\nh:=60;\n{GO}"), vec![20.0, 60.0]),
        (
            format!("h:=20;\nh:=h+h;\n{GO}\nh:=h-k;\n{GO}"),
            vec![40.0, 33.0],
        ),
        (
            format!("h:=5;\nIncr h;\nAdd h,k;\n{GO}\nClear h;\n{GO}"),
            vec![13.0, 0.0],
        ),
        (
            format!("h:=20;\nIF di1=1 THEN\n{GO}\nELSE\nh:=30;\n{GO}\nENDIF"),
            vec![20.0, 30.0],
        ),
        (
            format!("WHILE di1=1 DO\nh:=20;\n{GO}\nh:=60;\nENDWHILE\nh:=5;\n{GO}"),
            vec![20.0, 5.0],
        ),
        (
            format!("h:=20;\nFOR i FROM 1 TO 3 DO\n{GO}\nENDFOR\nh:=60;"),
            vec![20.0],
        ),
        (format!("h:=20;\nreads;\n{GO}\nh:=60;"), vec![20.0]),
    ] {
        let found = up(
            &statements,
            "PROC reads()\nTPWrite \"h=\"\\Num:=h;\nENDPROC",
        );
        let expected: Vec<_> = expected.into_iter().map(Some).collect();
        assert_eq!(found, expected, "{statements}");
    }
}

#[test]
fn what_may_have_been_written_since_counts_too() {
    let to_h = "PROC other()\nh:=60;\nENDPROC";
    for (statements, more) in [
        (format!("h:=20;\nIF di1=1 h:=60;\n{GO}"), ""),
        (
            format!("h:=20;\nWHILE di1=1 DO\n{GO}\nh:=60;\nENDWHILE"),
            "",
        ),
        (
            format!("h:=20;\nWHILE di1=1 DO\nh:=h+20;\n{GO}\nENDWHILE"),
            "",
        ),
        (
            format!("h:=20;\nagain:\n{GO}\nh:=60;\nIF di1=1 GOTO again;"),
            "",
        ),
        (format!("h:=20;\nother;\n{GO}"), to_h),
        (format!("h:=20;\n{GO}\nERROR\nh:=60;\nRETRY;"), ""),
        (
            format!("CONNECT i1 WITH other;\nh:=20;\n{GO}"),
            "TRAP other\nh:=60;\nENDTRAP",
        ),
        (
            format!("h:=20;\nback h;\n{GO}"),
            "PROC back(INOUT num x)\nx:=60;\nENDPROC",
        ),
        (format!("h:=20;\nIF di1=1 main;\n{GO}\nh:=60;"), ""),
        (format!("h:=20;\noutside h;\n{GO}"), ""),
        (format!("h:=20;\nCallByVar \"ma\",k;\n{GO}\nh:=60;"), ""),
        (
            format!("CONNECT i1 WITH other;\nh:=20;\n{GO}\nh:=60;"),
            "TRAP other\nmain;\nENDTRAP",
        ),
    ] {
        let found = up(&statements, more);
        assert!(found.contains(&None), "{statements}: {found:?}");
    }
}

/// Statements of a routine by chance, and what its number is at each move in runs of it.
struct Chance {
    state: u64,
    text: String,
    moves: usize,
}

/// A statement as it is run.
enum Run {
    Set(i64),
    Add(i64),
    Go(usize),
    Other,
    Either(Vec<Run>, Vec<Run>),
    While(Vec<Run>),
}

impl Chance {
    fn next(&mut self, below: u64) -> u64 {
        self.state = self
            .state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        (self.state >> 33) % below
    }

    fn block(&mut self, depth: u32) -> Vec<Run> {
        let count = 1 + self.next(4);
        (0..count).map(|_| self.statement(depth)).collect()
    }

    fn statement(&mut self, depth: u32) -> Run {
        let kinds = if depth == 0 { 7 } else { 10 };
        let by = i64::try_from(self.next(9)).expect("small") + 1;
        match self.next(kinds) {
            0 | 1 => {
                self.text += &format!("h:={by};\n");
                Run::Set(by)
            }
            2 => {
                self.text += &format!("h:=h+{by};\n");
                Run::Add(by)
            }
            3..=5 => {
                self.text += GO;
                self.text.push('\n');
                self.moves += 1;
                Run::Go(self.moves - 1)
            }
            6 => {
                self.text += "other;\n";
                Run::Other
            }
            7 | 8 => {
                self.text += "IF di1=1 THEN\n";
                let one = self.block(depth - 1);
                self.text += "ELSE\n";
                let other = self.block(depth - 1);
                self.text += "ENDIF\n";
                Run::Either(one, other)
            }
            _ => {
                self.text += "WHILE di1=1 DO\n";
                let inside = self.block(depth - 1);
                self.text += "ENDWHILE\n";
                Run::While(inside)
            }
        }
    }

    fn run(&mut self, statements: &[Run], h: &mut i64, other: Option<i64>, seen: &mut [Vec<i64>]) {
        for statement in statements {
            match statement {
                Run::Set(value) => *h = *value,
                Run::Add(by) => *h += by,
                Run::Go(at) => seen[*at].push(*h),
                Run::Other => *h = other.unwrap_or(*h),
                Run::Either(one, other_branch) => {
                    let taken = if self.next(2) == 0 { one } else { other_branch };
                    self.run(taken, h, other, seen);
                }
                Run::While(inside) => {
                    for _ in 0..self.next(3) {
                        self.run(inside, h, other, seen);
                    }
                }
            }
        }
    }
}

#[test]
fn what_is_said_to_be_the_number_is_it_in_every_run() {
    let (mut known, mut all) = (0, 0);
    for seed in 0..600 {
        let mut chance = Chance {
            state: seed * 7_919 + 1,
            text: "h:=3;\n".to_owned(),
            moves: 0,
        };
        let statements = chance.block(3);
        let writes = chance.next(4) == 0;
        let more = if writes {
            "PROC other()\nh:=77;\nENDPROC"
        } else {
            "PROC other()\nk:=h;\nENDPROC"
        };
        let text = std::mem::take(&mut chance.text);
        let found = up(&text, more);
        let mut seen = vec![Vec::new(); chance.moves];
        for _ in 0..60 {
            let mut h = 3;
            chance.run(&statements, &mut h, writes.then_some(77), &mut seen);
        }
        if found.len() != seen.len() {
            continue;
        }
        for (found, seen) in found.iter().zip(&seen) {
            all += 1;
            if let Some(found) = found {
                known += 1;
                #[allow(clippy::cast_precision_loss)]
                let is_it = seen.iter().all(|seen| (*seen as f64 - found).abs() < 1e-6);
                assert!(is_it, "{text}: {found}, {seen:?}");
            }
        }
    }
    assert!(known * 4 > all && all > 600, "{known} of {all}");
}

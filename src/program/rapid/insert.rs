//! Moves between those of a program.

use crate::program::{Between, Program, Source, Target};
use std::ops::Range;

/// The text of an instruction up to its semicolon; strings and comments do not stand in one that moves.
fn instruction(bytes: &[u8], offset: usize) -> Option<Range<usize>> {
    let end = bytes[offset..].iter().position(|b| *b == b';')? + offset;
    let text = &bytes[offset..end];
    (!text.contains(&b'!') && !text.contains(&b'"')).then_some(offset..end + 1)
}

/// The positional arguments of an instruction, without the blanks about them.
fn arguments(bytes: &[u8], span: &Range<usize>) -> Vec<Range<usize>> {
    let text = &bytes[span.clone()];
    let named = text
        .iter()
        .position(|b| !(b.is_ascii_alphanumeric() || *b == b'_'))
        .unwrap_or(0);
    let (mut depth, mut start, mut found) = (0, named, Vec::new());
    for (at, byte) in text.iter().enumerate().skip(named) {
        match byte {
            b'[' | b'(' | b'{' => depth += 1,
            b']' | b')' | b'}' => depth -= 1,
            b',' | b';' if depth == 0 => {
                found.push(start..at);
                start = at + 1;
            }
            _ => {}
        }
    }
    let trimmed = |range: Range<usize>| {
        let part = &text[range.clone()];
        let before = part.iter().take_while(|b| b.is_ascii_whitespace()).count();
        let behind = part
            .iter()
            .rev()
            .take_while(|b| b.is_ascii_whitespace())
            .count();
        let end = (range.end - behind).max(range.start + before);
        span.start + range.start + before..span.start + end
    };
    found.into_iter().map(trimmed).collect()
}

/// The argument that is a target: its literal, or its name.
fn argument(bytes: &[u8], all: &[Range<usize>], target: &Target) -> Option<Range<usize>> {
    let offset = target.offset as usize;
    if let Some(found) = all.iter().find(|range| range.start == offset) {
        return Some(found.clone());
    }
    let name = target.name.as_ref()?.as_bytes();
    all.iter()
        .find(|range| bytes[(*range).clone()].eq_ignore_ascii_case(name))
        .cloned()
}

/// The text of a target's aggregate.
fn literal(bytes: &[u8], target: &Target) -> Option<Range<usize>> {
    let start = target.offset as usize;
    let (mut depth, mut end) = (0, None);
    for (at, byte) in bytes.iter().enumerate().skip(start) {
        match byte {
            b'[' => depth += 1,
            b']' => {
                depth -= 1;
                if depth == 0 {
                    end = Some(at + 1);
                    break;
                }
            }
            b';' => break,
            _ if depth == 0 => break,
            _ => {}
        }
    }
    Some(start..end?)
}

/// The aggregate of a target with other numbers.
fn with_numbers(
    bytes: &[u8],
    program: &Program,
    target: &Target,
    texts: &[Vec<u8>],
) -> Option<Vec<u8>> {
    let span = literal(bytes, target)?;
    let mut out = Vec::new();
    let mut done = span.start;
    for (number, text) in program.numbers_of(target).iter().zip(texts) {
        let start = number.start as usize;
        if start < done || start >= span.end {
            return None;
        }
        out.extend_from_slice(&bytes[done..start]);
        out.extend_from_slice(text);
        done = start + usize::from(number.length);
    }
    out.extend_from_slice(&bytes[done..span.end]);
    // what was broken over lines stays one line
    out.retain(|b| !matches!(b, b'\n' | b'\r'));
    Some(out)
}

/// External axes of a target, as they are written.
fn external<'a>(bytes: &'a [u8], program: &Program, target: &Target) -> Option<&'a [u8]> {
    let last = program.numbers_of(target).last()?;
    let span = literal(bytes, target)?;
    bytes.get(last.start as usize + usize::from(last.length)..span.end)
}

/// See [`crate::program::Language::insert`].
pub(super) fn insert(
    source: &Source,
    program: &Program,
    index: usize,
    between: &[Between],
) -> Option<Vec<(Range<usize>, Vec<u8>)>> {
    let bytes = &source.bytes;
    let motion = &program.moves[index];
    let target = &program.targets[motion.target];
    // a target declared in another file is written with that file's numbers
    if target.file != motion.file {
        return None;
    }
    let span = instruction(bytes, motion.offset as usize)?;
    let all = arguments(bytes, &span);
    let end = argument(bytes, &all, target)?;
    let is_arc = between.iter().any(|b| b.via.is_some());
    let mut via = None;
    if is_arc {
        let before = &program.moves[index.checked_sub(1)?];
        let through = &program.targets[before.target];
        via = Some(argument(bytes, &all, through)?);
    }
    // external axes do not move on the way
    let before = index.checked_sub(if is_arc { 2 } else { 1 })?;
    let before = &program.targets[program.moves[before].target];
    if before.layout == target.layout
        && before.file == target.file
        && external(bytes, program, before) != external(bytes, program, target)
    {
        return None;
    }
    let start = span.start;
    let line = bytes[..start]
        .iter()
        .rposition(|b| matches!(b, b'\n' | b'\r'))
        .map_or(0, |at| at + 1);
    let indent: Vec<u8> = bytes[line..start]
        .iter()
        .copied()
        .take_while(|b| b" \t".contains(b))
        .collect();
    let put = |at: &Range<usize>, with: &[u8], text: &mut Vec<u8>, done: &mut usize| {
        text.extend_from_slice(&bytes[*done..at.start]);
        text.extend_from_slice(with);
        *done = at.end;
    };
    let mut text = Vec::new();
    let mut spans = Vec::new();
    for (number, step) in between.iter().enumerate() {
        let through = match &step.via {
            Some(numbers) => Some(with_numbers(bytes, program, target, numbers)?),
            None => None,
        };
        // the last part of an arc is the move itself with another point
        if is_arc && number + 1 == between.len() {
            spans.push((via.clone()?, through?));
            continue;
        }
        let here = with_numbers(bytes, program, target, &step.end)?;
        let mut done = start;
        if let (Some(at), Some(through)) = (&via, &through) {
            put(at, through, &mut text, &mut done);
        }
        put(&end, &here, &mut text, &mut done);
        text.extend_from_slice(&bytes[done..span.end]);
        text.extend_from_slice(source.line_end());
        text.extend_from_slice(&indent);
    }
    spans.push((start..start, text));
    Some(spans)
}

//! What readers of all languages share.

use super::{ReadError, Source};

/// No text has a zero byte, and places are kept in 32 bits.
///
/// # Errors
/// Where the file is none that a program can be in.
pub(super) fn check_bytes(source: &Source) -> Result<(), ReadError> {
    let limit = u32::MAX as usize;
    let (file, size) = (source.name.clone(), source.bytes.len());
    if size >= limit {
        return Err(ReadError::TooLarge { file, size, limit });
    }
    match memchr::memchr(0, &source.bytes) {
        Some(offset) => Err(ReadError::Binary {
            file,
            byte: 0,
            offset,
        }),
        None => Ok(()),
    }
}

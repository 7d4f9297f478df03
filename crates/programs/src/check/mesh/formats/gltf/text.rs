//! The text of a glTF file as values, looked at before gltf-json makes anything of them.
//!
//! # Limits
//! 10 million values, in each other as `serde_json` allows (128).

use gltf_json::Value;
use serde::de::DeserializeOwned;

/// Values of the JSON text, each of which takes up to 300 bytes.
pub(super) const MOST_VALUES: usize = 10_000_000;
/// How fields begin whose whole numbers may have more than 32 bits.
const LONG: [&str; 3] = ["byte", "count", "ext"];

/// The values of a file, and the binary chunk of a GLB.
pub(super) fn values(bytes: &[u8]) -> Result<(Value, Option<&[u8]>), String> {
    let (json, binary) = if bytes.starts_with(b"glTF") {
        chunks(bytes)?
    } else {
        (bytes, None)
    };
    // each value stands behind one of these
    if memchr::memchr3_iter(b',', b':', b'[', json).count() > MOST_VALUES {
        return Err(format!("more than {MOST_VALUES} values in its JSON"));
    }
    let values = serde_json::from_slice(json).map_err(|error| error.to_string())?;
    Ok((values, binary))
}

/// What a file lists. Of materials, animations and others nothing is read, and nothing refused.
pub(super) fn list<T: DeserializeOwned>(file: &mut Value, name: &str) -> Result<Vec<T>, String> {
    let items = match file.get_mut(name).map(Value::take) {
        None => Vec::new(),
        Some(Value::Array(items)) => items,
        Some(_) => return Err(format!("its {name} are no list")),
    };
    let read = |(index, item)| {
        let item =
            short(&item).and_then(|()| serde_json::from_value(item).map_err(|e| e.to_string()));
        item.map_err(|error| format!("{name}[{index}]: {error}"))
    };
    items.into_iter().enumerate().map(read).collect()
}

/// That no index or type has more than 32 bits: the crate takes the lower ones of it.
fn short(value: &Value) -> Result<(), String> {
    match value {
        Value::Number(number) if number.as_u64() > Some(u32::MAX.into()) => {
            Err(format!("{number} is named, larger than any index"))
        }
        Value::Array(values) => values.iter().try_for_each(short),
        Value::Object(fields) => {
            let is_long = |key: &str| LONG.iter().any(|start| key.starts_with(start));
            let mut fields = fields.iter().filter(|(key, _)| !is_long(key));
            fields.try_for_each(|(_, value)| short(value))
        }
        _ => Ok(()),
    }
}

/// The JSON and the binary chunk of a GLB file.
fn chunks(bytes: &[u8]) -> Result<(&[u8], Option<&[u8]>), String> {
    let mut rest = bytes.get(12..).ok_or("the header is cut off")?;
    if bytes[4..8] != 2u32.to_le_bytes() {
        return Err("a GLB of another version than 2".into());
    }
    let (mut json, mut binary) = (None, None);
    while let Some((head, data)) = rest.split_first_chunk::<8>() {
        let [l0, l1, l2, l3, kind @ ..] = *head;
        let length = u32::from_le_bytes([l0, l1, l2, l3]) as usize;
        let (data, others) = data.split_at_checked(length).ok_or("a chunk is cut off")?;
        match &kind {
            b"JSON" => json = Some(data),
            b"BIN\0" => binary = Some(data),
            _ => {}
        }
        rest = others;
    }
    Ok((json.ok_or("no JSON chunk")?, binary))
}

//! As much of JSON Schema as the schemas of the program use.

use serde_json::Value;

/// Where a document is not what a schema says.
pub fn faults(schema: &Value, document: &Value) -> Vec<String> {
    let mut faults = Vec::new();
    look(schema, schema, document, "", &mut faults);
    faults
}

fn is_of_type(name: &str, value: &Value) -> bool {
    match name {
        "null" => value.is_null(),
        "boolean" => value.is_boolean(),
        "integer" => value.is_i64() || value.is_u64(),
        "number" => value.is_number(),
        "string" => value.is_string(),
        "array" => value.is_array(),
        "object" => value.is_object(),
        other => panic!("type {other}"),
    }
}

fn look(root: &Value, schema: &Value, value: &Value, at: &str, faults: &mut Vec<String>) {
    let Value::Object(keys) = schema else {
        // `true` takes everything
        assert_eq!(schema, &Value::Bool(true), "{at}");
        return;
    };
    for (key, rule) in keys {
        match key.as_str() {
            "$ref" => {
                let path = rule.as_str().and_then(|path| path.strip_prefix('#'));
                let part = root.pointer(path.expect("a reference inside"));
                look(root, part.expect("a definition"), value, at, faults);
            }
            "type" => {
                let names: Vec<&str> = match rule {
                    Value::Array(list) => list.iter().filter_map(Value::as_str).collect(),
                    one => one.as_str().into_iter().collect(),
                };
                if !names.iter().any(|name| is_of_type(name, value)) {
                    faults.push(format!("{at}: {value} is no {names:?}"));
                }
            }
            "const" if rule != value => faults.push(format!("{at}: {value} is not {rule}")),
            "enum" if !rule.as_array().is_some_and(|list| list.contains(value)) => {
                faults.push(format!("{at}: {value} is none of {rule}"));
            }
            "anyOf" | "oneOf" => {
                let fits = |one: &&Value| {
                    let mut inside = Vec::new();
                    look(root, one, value, at, &mut inside);
                    inside.is_empty()
                };
                let list = rule.as_array().expect("a list");
                if !list.iter().any(|one| fits(&one)) {
                    faults.push(format!("{at}: {value} fits none of {}", list.len()));
                }
            }
            "allOf" => {
                for one in rule.as_array().expect("a list") {
                    look(root, one, value, at, faults);
                }
            }
            "required" => {
                let Some(map) = value.as_object() else {
                    continue;
                };
                let names = rule.as_array().into_iter().flatten();
                for name in names.filter_map(Value::as_str) {
                    if !map.contains_key(name) {
                        faults.push(format!("{at}: no {name}"));
                    }
                }
            }
            "properties" => {
                let Some(map) = value.as_object() else {
                    continue;
                };
                for (name, part) in rule.as_object().expect("properties") {
                    if let Some(one) = map.get(name) {
                        look(root, part, one, &format!("{at}/{name}"), faults);
                    }
                }
            }
            "additionalProperties" => {
                let Some(map) = value.as_object() else {
                    continue;
                };
                let known = keys.get("properties").and_then(Value::as_object);
                for (name, one) in map {
                    if known.is_some_and(|known| known.contains_key(name)) {
                        continue;
                    }
                    if *rule == Value::Bool(false) {
                        faults.push(format!("{at}: {name} is not known"));
                    } else {
                        look(root, rule, one, &format!("{at}/{name}"), faults);
                    }
                }
            }
            "items" => {
                for (n, one) in value.as_array().into_iter().flatten().enumerate() {
                    look(root, rule, one, &format!("{at}/{n}"), faults);
                }
            }
            "minItems" | "maxItems" => {
                let Some(list) = value.as_array() else {
                    continue;
                };
                let (count, limit) = (list.len() as u64, rule.as_u64().expect("a count"));
                if (key == "minItems" && count < limit) || (key == "maxItems" && count > limit) {
                    faults.push(format!("{at}: {count} items"));
                }
            }
            "minimum" if value.as_f64() < rule.as_f64() && value.is_number() => {
                faults.push(format!("{at}: {value} is below {rule}"));
            }
            "maximum" if value.as_f64() > rule.as_f64() && value.is_number() => {
                faults.push(format!("{at}: {value} is above {rule}"));
            }
            _ => {}
        }
    }
}

//! Fields of a file that this version does not know: kept, and written back where they were.

use std::collections::HashMap;

use serde_json::{Map, Value};

/// Fields of a value that its known form lacks, in the same nesting; items of lists are told apart by `name`.
pub(super) fn of(value: &Value, known: &Value) -> Option<Value> {
    let mut rest = Map::new();
    match (value, known) {
        (Value::Object(fields), Value::Object(known)) => {
            for (key, field) in fields {
                let unknown = known.get(key).map_or_else(|| Some(field.clone()), |known| of(field, known));
                rest.extend(unknown.map(|unknown| (key.clone(), unknown)));
            }
        }
        (Value::Array(items), Value::Array(known)) => {
            let by_name: HashMap<&str, &Value> =
                known.iter().rev().filter_map(|known| name(known).map(|name| (name, known))).collect();
            for item in items {
                let Some(name) = name(item) else { continue };
                let known = by_name.get(name);
                rest.extend(known.and_then(|known| of(item, known)).map(|unknown| (name.to_owned(), unknown)));
            }
        }
        _ => {}
    }
    (!rest.is_empty()).then_some(Value::Object(rest))
}

/// Writes unknown fields back. Known ones stay as they are.
pub(super) fn put_back(value: &mut Value, unknown: &Map<String, Value>) {
    match value {
        Value::Object(fields) => {
            for (key, rest) in unknown {
                match (fields.get_mut(key), rest) {
                    (None, _) => drop(fields.insert(key.clone(), rest.clone())),
                    (Some(field), Value::Object(rest)) => put_back(field, rest),
                    (Some(_), _) => {}
                }
            }
        }
        Value::Array(items) => {
            for item in items {
                let rest = name(item).and_then(|name| unknown.get(name)).and_then(Value::as_object);
                if let Some(rest) = rest.cloned() {
                    put_back(item, &rest);
                }
            }
        }
        _ => {}
    }
}

fn name(value: &Value) -> Option<&str> {
    value.get("name")?.as_str()
}

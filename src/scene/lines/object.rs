//! One JSON object as its members, in order and unread.

use std::fmt;

use serde::de::{Deserialize, Deserializer, MapAccess, Visitor};
use serde_json::value::RawValue;

use super::{Fault, Part};

/// A key and its value as it was written.
type Member<'a> = (String, &'a RawValue);

/// A map that forgets nothing: duplicates stay, and values stay text.
struct Members<'a>(Vec<Member<'a>>);

impl<'de> Deserialize<'de> for Members<'de> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Collect;
        impl<'de> Visitor<'de> for Collect {
            type Value = Members<'de>;

            fn expecting(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
                out.write_str("a JSON object")
            }

            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Self::Value, A::Error> {
                let mut members = Vec::with_capacity(2);
                while let Some(member) = map.next_entry()? {
                    members.push(member);
                }
                Ok(Members(members))
            }
        }
        deserializer.deserialize_map(Collect)
    }
}

/// The members of the object that `text` is; the error's place is final, not a field.
pub(super) fn members(text: &str) -> Part<Vec<Member<'_>>> {
    let text = text.trim();
    serde_json::from_str(text).map(|Members(members)| members).map_err(|error| {
        if error.is_data() {
            return ("line".to_owned(), super::number::kind("a JSON object", text));
        }
        let message = error.to_string();
        // One line is read at a time: "at line 1" would contradict the caller's line number.
        let reason = message.split(" at line ").next().unwrap_or_default().to_owned();
        (format!("column {}", error.column()), Fault::Syntax(reason))
    })
}

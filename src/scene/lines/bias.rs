//! The depth bias of a draw call. Spec clause `Z-7`.

use serde_json::value::RawValue;

use super::number::{integer, kind};
use super::{Fault, Part, object};
use crate::value::DepthBias;

/// `"bias": {"constant": 2, "slope": 256, "clamp": 9, "unit": 1}`, each key at most once; nothing where none is
/// given. `key` is what the line draws.
pub(super) fn bias(members: &[(String, &RawValue)], key: &str) -> Part<Option<DepthBias>> {
    let Some((_, raw)) = members.iter().find(|(key, _)| key == "bias") else { return Ok(None) };
    let place = || "bias".to_owned();
    if !matches!(key, "v" | "f" | "position" | "clip") {
        return Err((place(), Fault::NoBias));
    }
    let terms = object::members(raw.get()).map_err(|(_, fault)| (place(), fault))?;
    let mut bias = DepthBias::default();
    for (index, (name, raw)) in terms.iter().enumerate() {
        let field = format!("bias.{name}");
        if terms[..index].iter().any(|(before, _)| before == name) {
            return Err((field, Fault::Duplicate));
        }
        let value = integer(raw, &field)?;
        let range = || kind("a whole number of at most 64 bits, with its sign", raw.get());
        let term = i64::try_from(value).map_err(|_| (field.clone(), range()));
        match name.as_str() {
            "constant" => bias.constant = term?,
            "slope" => bias.slope = term?,
            "clamp" => bias.clamp = term?,
            "unit" => {
                let range = || kind("a whole number from 1 to 2^32 - 1", raw.get());
                bias.unit = u32::try_from(value).map_err(|_| (field.clone(), range()))?;
            }
            _ => return Err((field, Fault::UnknownTerm)),
        }
    }
    Ok(Some(bias))
}

//! Channels of a triangle, and the w of its vertices.

use serde_json::value::RawValue;

use super::number::{integer, list, real};
use super::{Fault, Part, count, object};
use crate::scene::Shading;

/// `channels`, and `q` beside integers or `w` beside reals; nothing where none is given.
pub(super) fn shading(members: &[(String, &RawValue)], key: &str) -> Part<Option<Shading>> {
    let find = |name: &str| members.iter().find(|(key, _)| key == name).map(|(_, raw)| *raw);
    let (channels, q, w) = (find("channels"), find("q"), find("w"));
    let other = |name: &str, fault: Fault| Err((name.to_owned(), fault));
    match key {
        "v" if w.is_some() => other("w", Fault::OtherW { need: "q", key: "v" }),
        "f" if q.is_some() => other("q", Fault::OtherW { need: "w", key: "f" }),
        "position" if q.is_some() || w.is_some() => {
            other(if q.is_some() { "q" } else { "w" }, Fault::OwnW)
        }
        "v" | "f" if channels.is_none() && (q.is_some() || w.is_some()) => {
            other(if q.is_some() { "q" } else { "w" }, Fault::OnlyW)
        }
        "v" => {
            let Some(raw) = channels else { return Ok(None) };
            let channels = named(raw, integer)?;
            let inverse_w = q.map(|raw| three(raw, "q", integer)).transpose()?;
            Ok(Some(Shading::Codes { channels, inverse_w }))
        }
        "f" | "position" => {
            let Some(raw) = channels else { return Ok(None) };
            let channels = named(raw, real)?;
            let w = w.map(|raw| three(raw, "w", real)).transpose()?;
            Ok(Some(Shading::Reals { channels, w }))
        }
        _ => {
            match [("channels", channels), ("q", q), ("w", w)].iter().find(|(_, raw)| raw.is_some())
            {
                Some((name, _)) => other(name, Fault::NoVertices),
                None => Ok(None),
            }
        }
    }
}

type Read<T> = fn(&RawValue, &str) -> Part<T>;

fn three<T>(raw: &RawValue, field: &str, number: Read<T>) -> Part<[T; 3]> {
    match list(raw, field)?.as_slice() {
        [a, b, c] => {
            let read = |raw, n| number(raw, &format!("{field}[{n}]"));
            Ok([read(a, 0)?, read(b, 1)?, read(c, 2)?])
        }
        other => Err(count(field, "3 values are needed, one for each vertex", other.len())),
    }
}

/// `{"color": [[r,g,b], [r,g,b], [r,g,b]]}`, turned to one list a component.
fn named<T: Copy>(raw: &RawValue, number: Read<T>) -> Part<Vec<(String, Vec<[T; 3]>)>> {
    let members =
        object::members(raw.get()).map_err(|(_, fault)| ("channels".to_owned(), fault))?;
    let mut channels: Vec<(String, Vec<[T; 3]>)> = Vec::new();
    for (name, raw) in members {
        let field = format!("channels.{name}");
        if channels.iter().any(|(before, _)| *before == name) {
            return Err((field, Fault::Duplicate));
        }
        let mut by_vertex: Vec<Vec<T>> = Vec::new();
        let vertices = list(raw, &field)?;
        if vertices.len() != 3 {
            return Err(count(&field, "3 vertices are needed", vertices.len()));
        }
        for (n, raw) in vertices.into_iter().enumerate() {
            let field = format!("{field}[{n}]");
            let values = list(raw, &field)?.into_iter().enumerate();
            let values = values.map(|(k, raw)| number(raw, &format!("{field}[{k}]")));
            by_vertex.push(values.collect::<Part<_>>()?);
            let (got, first) = (by_vertex[n].len(), by_vertex[0].len());
            if got != first {
                return Err((field, Fault::MixedComponents { got, first }));
            }
        }
        let at = |k: usize| [by_vertex[0][k], by_vertex[1][k], by_vertex[2][k]];
        channels.push((name, (0..by_vertex[0].len()).map(at).collect()));
    }
    Ok(channels)
}

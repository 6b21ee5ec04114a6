//! Triangles back into lines.

use super::{Shading, Triangle};
use serde_json::Value;
use std::fmt::Write;

/// The line that [`super::parse_line`] reads back to the same triangle and channels, without a line end.
///
/// Reals are written as the shortest decimal that gives the same double, NaN and infinities as
/// their 16-digit pattern.
pub fn to_line(id: u64, triangle: &Triangle, shading: Option<&Shading>) -> String {
    let (key, vertices) = match triangle {
        Triangle::Lattice { xy, z } => ("v", join(xy, z.as_ref(), i128::to_string)),
        Triangle::Real { xy, z } => ("f", join(xy, z.as_ref(), real)),
    };
    let beside = match shading {
        None => String::new(),
        Some(Shading::Codes { channels, inverse_w }) => {
            given("q", inverse_w.as_ref(), channels, i128::to_string)
        }
        Some(Shading::Reals { channels, w }) => given("w", w.as_ref(), channels, real),
    };
    format!(r#"{{"id":{id},"{key}":[{vertices}]{beside}}}"#)
}

fn join<T>(xy: &[[T; 2]; 3], z: Option<&[T; 3]>, number: impl Fn(&T) -> String) -> String {
    let vertex = |(index, [x, y]): (usize, &[T; 2])| {
        let mut text = format!("[{},{}", number(x), number(y));
        if let Some(z) = z.and_then(|z| z.get(index)) {
            text.push(',');
            text.push_str(&number(z));
        }
        text.push(']');
        text
    };
    xy.iter().enumerate().map(vertex).collect::<Vec<_>>().join(",")
}

/// The members for channels, each after a comma.
fn given<T>(
    key: &str,
    w: Option<&[T; 3]>,
    channels: &[(String, Vec<[T; 3]>)],
    number: impl Fn(&T) -> String,
) -> String {
    let list = |numbers: &mut dyn Iterator<Item = &T>| {
        format!("[{}]", numbers.map(&number).collect::<Vec<_>>().join(","))
    };
    let mut text = String::new();
    if let Some(w) = w {
        let _ = write!(text, r#","{key}":{}"#, list(&mut w.iter()));
    }
    let channels = channels.iter().map(|(name, components)| {
        let vertices = [0, 1, 2].map(|n| list(&mut components.iter().map(|values| &values[n])));
        format!("{}:[{}]", Value::from(name.as_str()), vertices.join(","))
    });
    let _ = write!(text, r#","channels":{{{}}}"#, channels.collect::<Vec<_>>().join(","));
    text
}

#[expect(
    clippy::trivially_copy_pass_by_ref,
    reason = "the shape `join` calls, as `i128::to_string`"
)]
fn real(value: &f64) -> String {
    if value.is_finite() {
        format!("{value:?}")
    } else {
        format!(r#"{{"bits":"{:016x}"}}"#, value.to_bits())
    }
}

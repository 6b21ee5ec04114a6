//! Primitives that few machines draw: polygons, homogeneous triangles.

use serde_json::value::RawValue;

use super::number::{integer, list, real, triple};
use super::{Fault, Part, count};
use crate::scene::Positioned;
use crate::setup::{ClipTriangle, Polygon};

/// Three or more vertices, z for all or none.
pub(super) fn polygon(raw: &RawValue) -> Part<Polygon> {
    let corners = list(raw, "polygon")?;
    if corners.len() < 3 {
        return Err(count("polygon", "3 vertices or more are needed", corners.len()));
    }
    let mut polygon = Polygon { xy: Vec::with_capacity(corners.len()), z: None };
    let mut depths = Vec::new();
    for (n, corner) in corners.into_iter().enumerate() {
        let field = format!("polygon[{n}]");
        let (xy, z) = triple(corner, &field, integer)?;
        let has_depth = n == 0 || !depths.is_empty();
        if n > 0 && z.is_some() != has_depth {
            let (got, first) = if has_depth { (2, 3) } else { (3, 2) };
            return Err((field, Fault::MixedDepth { got, first }));
        }
        polygon.xy.push(xy);
        depths.extend(z);
    }
    polygon.z = (!depths.is_empty()).then_some(depths);
    Ok(polygon)
}

/// Three vertices `[x, y, z, w]` of reals, rounded to binary32.
pub(super) fn position(raw: &RawValue) -> Part<Positioned> {
    let corners = list(raw, "position")?;
    if corners.len() != 3 {
        return Err(count("position", "3 vertices are needed", corners.len()));
    }
    let mut positions = [[0.0; 4]; 3];
    for (n, corner) in corners.into_iter().enumerate() {
        let field = format!("position[{n}]");
        let values = list(corner, &field)?;
        if values.len() != 4 {
            return Err(count(&field, "4 coordinates x, y, z, w are needed", values.len()));
        }
        for (k, raw) in values.into_iter().enumerate() {
            let value = real(raw, &format!("{field}[{k}]"))?;
            #[expect(clippy::cast_possible_truncation, reason = "a position is binary32")]
            let value = value as f32;
            positions[n][k] = value;
        }
    }
    Ok(Positioned(positions))
}

/// Three vertices `[X, Y, W]` or `[X, Y, Z, W]`, alike.
pub(super) fn clip(raw: &RawValue) -> Part<ClipTriangle> {
    let corners = list(raw, "clip")?;
    if corners.len() != 3 {
        return Err(count("clip", "3 vertices are needed", corners.len()));
    }
    let mut triangle = ClipTriangle { xyw: [[0; 3]; 3], z: None };
    let mut depths = Vec::new();
    for (n, corner) in corners.into_iter().enumerate() {
        let field = format!("clip[{n}]");
        let values = list(corner, &field)?
            .into_iter()
            .enumerate()
            .map(|(k, raw)| integer(raw, &format!("{field}[{k}]")))
            .collect::<Part<Vec<i128>>>()?;
        triangle.xyw[n] = match values[..] {
            [x, y, w] if depths.is_empty() => [x, y, w],
            [x, y, z, w] if depths.len() == n => {
                depths.push(z);
                [x, y, w]
            }
            _ => {
                let need = "X, Y, W or X, Y, Z, W are needed, the same for all three vertices";
                return Err(count(&field, need, values.len()));
            }
        };
    }
    triangle.z = <[i128; 3]>::try_from(depths).ok();
    Ok(triangle)
}

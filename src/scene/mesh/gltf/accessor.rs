//! The numbers of accessors.

use gltf_json::Root;
use gltf_json::accessor::{ComponentType, Type};
use gltf_json::validation::Checked;

use super::GltfError;
use super::buffer::Buffers;
use super::node::look_up;

/// What an accessor is read for.
pub(super) struct Wanted {
    /// The name of the attribute.
    pub(super) name: &'static str,
    /// Shapes that it may have.
    pub(super) shapes: &'static [Type],
    /// Kinds of numbers that it may have.
    pub(super) kinds: &'static [ComponentType],
    /// Shapes and kinds, in words.
    pub(super) need: &'static str,
    /// Whether whole numbers are parts of their largest value, whatever the accessor says.
    pub(super) parts: bool,
}

const REALS: &[ComponentType] = &[
    ComponentType::F32,
    ComponentType::I8,
    ComponentType::U8,
    ComponentType::I16,
    ComponentType::U16,
];

pub(super) const POSITION: Wanted = Wanted {
    name: "POSITION",
    shapes: &[Type::Vec3],
    kinds: REALS,
    need: "VEC3 of float",
    parts: false,
};
pub(super) const TEXCOORD: Wanted = Wanted {
    name: "TEXCOORD_0",
    shapes: &[Type::Vec2],
    kinds: REALS,
    need: "VEC2 of float, unsigned byte or unsigned short",
    parts: false,
};
pub(super) const NORMAL: Wanted = Wanted { name: "NORMAL", ..POSITION };
pub(super) const COLOR: Wanted = Wanted {
    name: "COLOR_0",
    shapes: &[Type::Vec3, Type::Vec4],
    kinds: &[ComponentType::F32, ComponentType::U8, ComponentType::U16],
    need: "VEC3 or VEC4 of float, unsigned byte or unsigned short",
    parts: true,
};
pub(super) const INDICES: Wanted = Wanted {
    name: "indices",
    shapes: &[Type::Scalar],
    kinds: &[ComponentType::U8, ComponentType::U16, ComponentType::U32],
    need: "SCALAR of unsigned byte, unsigned short or unsigned int",
    parts: false,
};

/// The numbers of an accessor, element by element.
pub(super) struct Numbers {
    pub(super) components: usize,
    pub(super) values: Vec<f64>,
}

impl Numbers {
    pub(super) fn count(&self) -> usize {
        self.values.len() / self.components
    }

    pub(super) fn element(&self, n: usize) -> &[f64] {
        &self.values[n * self.components..][..self.components]
    }
}

/// How many elements an accessor says it has.
pub(super) fn count(
    root: &Root,
    accessor: usize,
    place: impl Fn() -> String,
) -> Result<u64, GltfError> {
    look_up(&root.accessors, accessor, "accessors", place).map(|found| found.count.0)
}

/// Reads an accessor; `place` says who asks.
pub(super) fn read(
    root: &Root,
    buffers: &mut Buffers,
    accessor: usize,
    wanted: &Wanted,
    place: impl Fn() -> String,
) -> Result<Numbers, GltfError> {
    let place = || format!("{}: {}", place(), wanted.name);
    let found = look_up(&root.accessors, accessor, "accessors", place)?;
    let unread = |why| GltfError::Unread { accessor, why };
    let (Checked::Valid(shape), Checked::Valid(kind)) = (found.type_, found.component_type) else {
        return Err(unread("`type` or `componentType` is none of glTF 2.0"));
    };
    let kind = kind.0;
    if !(wanted.shapes.contains(&shape) && wanted.kinds.contains(&kind)) {
        let got = format!("{shape:?} of {kind:?}").to_uppercase();
        return Err(GltfError::Shape { place: place(), accessor, got, need: wanted.need });
    }
    if found.sparse.is_some() {
        return Err(unread(
            "it is sparse, which is not read; export the mesh without sparse accessors",
        ));
    }
    let view = found
        .buffer_view
        .ok_or_else(|| unread("it has no bufferView, so it has no numbers"))?
        .value();
    let (bytes, stride) = buffers.view(view, || format!("accessors[{accessor}].bufferView"))?;
    let components = shape.multiplicity();
    let size = kind.size() * components;
    let stride = stride.unwrap_or(size);
    if stride < size {
        return Err(unread("byteStride of its bufferView is less than one element"));
    }
    let (count, start) = (found.count.0, found.byte_offset.unwrap_or_default().0);
    let end = match count {
        0 => 0,
        _ => u128::from(start) + stride as u128 * u128::from(count - 1) + size as u128,
    };
    if end > bytes.len() as u128 {
        return Err(GltfError::Accessor { accessor, count, end, view, length: bytes.len() });
    }
    // Inside the view, so that nothing is too large for memory.
    let start = usize::try_from(start).unwrap_or(bytes.len()).min(bytes.len());
    let elements = bytes[start..].chunks(stride).take(usize::try_from(count).unwrap_or(usize::MAX));
    let mut values = Vec::new();
    for (element, bytes) in elements.enumerate() {
        for word in bytes[..size].chunks_exact(kind.size()) {
            let value = number(kind, word, found.normalized || wanted.parts);
            if !value.is_finite() {
                return Err(GltfError::NotFinite { place: place(), accessor, element, value });
            }
            values.push(value);
        }
    }
    Ok(Numbers { components, values })
}

/// A number from its bytes; a whole number may be a part of the largest one.
fn number(kind: ComponentType, bytes: &[u8], part: bool) -> f64 {
    let mut word = [0; 4];
    word[..bytes.len()].copy_from_slice(bytes);
    let [a, b, ..] = word;
    let (value, largest) = match kind {
        ComponentType::I8 => (f64::from(i8::from_le_bytes([a])), 127.0),
        ComponentType::U8 => (f64::from(a), 255.0),
        ComponentType::I16 => (f64::from(i16::from_le_bytes([a, b])), 32_767.0),
        ComponentType::U16 => (f64::from(u16::from_le_bytes([a, b])), 65_535.0),
        ComponentType::U32 => (f64::from(u32::from_le_bytes(word)), 4_294_967_295.0),
        ComponentType::F32 => return f64::from(f32::from_le_bytes(word)),
    };
    // The lowest signed number is beyond -1, and counts as -1.
    if part { (value / largest).max(-1.0) } else { value }
}

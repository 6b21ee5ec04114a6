//! glTF 2.0, as text and as binary: the triangles of the default scene, and its camera.
//!
//! The crate `gltf-json` reads the JSON. Every index is looked up here: what the crate `gltf` adds panics on some
//! that are out of range.

mod accessor;
mod buffer;
mod error;
mod node;
mod primitive;
mod transform;

use std::path::Path;

use gltf_json::Root;

use super::Mesh;
use buffer::Buffers;
pub use error::GltfError;

/// Extensions that a file may require: they leave the triangles as the core format says, or loosen the kinds of
/// numbers, which are read anyhow. Those of materials follow, by how their names begin.
const EXTENSIONS: [&str; 5] = [
    "KHR_mesh_quantization",
    "KHR_lights_punctual",
    "KHR_texture_basisu",
    "EXT_texture_webp",
    "EXT_texture_avif",
];
const MATERIALS: &str = "KHR_materials_";

/// Reads a glTF file whose other files lie in a folder.
///
/// Positions are in the units of the file, in world space. Normals go through the inverse transpose of their node,
/// to length 1.
///
/// # Errors
/// [`GltfError`], with the place in the file as a path of the JSON.
pub fn parse(bytes: &[u8], folder: &Path) -> Result<Mesh, GltfError> {
    let (json, blob) = if bytes.starts_with(b"glTF") { chunks(bytes)? } else { (bytes, None) };
    let json = json.strip_prefix(b"\xef\xbb\xbf").unwrap_or(json);
    let root: Root = gltf_json::deserialize::from_slice(json)
        .map_err(|error| GltfError::Json { message: error.to_string() })?;
    let version = &root.asset.version;
    if !version.starts_with("2.") {
        return Err(GltfError::Version { version: version.clone() });
    }
    let known = |name: &str| EXTENSIONS.contains(&name) || name.starts_with(MATERIALS);
    if let Some(name) = root.extensions_required.iter().find(|name| !known(name)) {
        return Err(GltfError::Extension { name: name.clone() });
    }
    let (drawn, camera) = node::walk(&root)?;
    let mut buffers = Buffers::new(&root, blob, folder);
    let mut mesh = primitive::read(&root, &mut buffers, &drawn)?;
    mesh.camera = camera;
    Ok(mesh)
}

/// The JSON and the binary chunk of a binary glTF file.
fn chunks(bytes: &[u8]) -> Result<(&[u8], Option<&[u8]>), GltfError> {
    let word = |at: usize| {
        let word = bytes
            .get(at..at + 4)
            .ok_or(GltfError::Short { need: at as u64 + 4, got: bytes.len() })?;
        Ok(u32::from_le_bytes([word[0], word[1], word[2], word[3]]))
    };
    let (version, whole) = (word(4)?, word(8)?);
    if version != 2 {
        return Err(GltfError::Version { version: version.to_string() });
    }
    let whole_size = usize::try_from(whole).unwrap_or(usize::MAX);
    let bytes =
        bytes.get(..whole_size).ok_or(GltfError::Short { need: whole.into(), got: bytes.len() })?;
    let (mut at, mut json, mut blob) = (12, None, None);
    while at < bytes.len() {
        let (length, kind) = (word(at)?, word(at + 4)?);
        let need = at as u64 + 8 + u64::from(length);
        let size = usize::try_from(length).unwrap_or(usize::MAX);
        let chunk = bytes[(at + 8).min(bytes.len())..].get(..size);
        let chunk = chunk.ok_or(GltfError::Short { need, got: bytes.len() })?;
        match &kind.to_le_bytes() {
            b"JSON" => json = json.or(Some(chunk)),
            b"BIN\0" => blob = blob.or(Some(chunk)),
            // Chunks of other kinds are passed over, as the format asks.
            _ => {}
        }
        at += 8 + size;
    }
    Ok((json.ok_or(GltfError::NoJson)?, blob))
}

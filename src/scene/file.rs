//! Files of scenes: which format a file has, and its way to triangles in the window.

use std::path::Path;

#[cfg(feature = "verification")]
use super::mesh::gltf;
use super::mesh::{Mesh, MeshError, obj, ply, stl};
use super::{Attributes, LARGEST, Scene, SceneError, Viewport, camera};
#[cfg(feature = "verification")]
use super::{Place, lines};
use crate::profile::read_at_most;

/// A format that is read.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Format {
    Obj,
    Gltf,
    Ply,
    Stl,
}

/// How files of meshes end, and how such a file begins whatever its name is.
const MESHES: [(Format, &str, &[&str], &str); 4] = [
    (Format::Obj, "an OBJ mesh", &["obj"], ".obj"),
    (Format::Gltf, "glTF", &["gltf", "glb"], ".gltf or .glb"),
    (Format::Ply, "a PLY mesh", &["ply"], ".ply"),
    (Format::Stl, "an STL mesh", &["stl"], ".stl"),
];

/// Formats that are not read, by their first bytes and their endings.
const FOREIGN: [(&str, &[u8], &[&str]); 6] = [
    ("FBX", b"Kaydara FBX", &["fbx"]),
    ("COLLADA", b"<?xml", &["dae"]),
    ("PNG", b"\x89PNG", &["png"]),
    ("ZIP", b"PK\x03\x04", &["zip", "3mf", "usdz"]),
    ("USD", b"PXR-USDC", &["usd", "usda", "usdc"]),
    ("Blender", b"BLENDER", &["blend"]),
];

/// Loads the scene of a file.
pub(super) fn load(source: &str, viewport: &Viewport) -> Result<Scene, SceneError> {
    let path = || source.to_owned();
    let bytes = read(source)?;
    let named = MESHES.iter().find(|(.., ends, _)| has_extension(source, ends));
    if let Some((format, ..)) = named {
        if bytes.is_empty() {
            return Err(SceneError::NoBytes { path: path() });
        }
        let mesh = mesh(*format, source, &bytes)?;
        return seen(source, &mesh, viewport);
    }
    if let Some((format, ..)) = FOREIGN
        .iter()
        .find(|(_, first, ends)| bytes.starts_with(first) || has_extension(source, ends))
    {
        return Err(SceneError::Format { path: path(), format });
    }
    let contains = looks_like(&bytes);
    if let Some((_, format, _, ending)) =
        MESHES.iter().find(|(format, ..)| Some(*format) == contains)
    {
        return Err(SceneError::NamedOtherwise { path: path(), format, ending });
    }
    let text = std::str::from_utf8(&bytes).map_err(|error| SceneError::Encoding {
        path: path(),
        line: 1 + bytes.iter().take(error.valid_up_to()).filter(|&&b| b == b'\n').count(),
    })?;
    json_lines(text, source)
}

/// What a mesh file holds.
fn mesh(format: Format, source: &str, bytes: &[u8]) -> Result<Mesh, SceneError> {
    let failed = |source: &str, error: MeshError| SceneError::Mesh {
        path: source.to_owned(),
        source: error,
    };
    let read = match format {
        // Comments and material names may be in any encoding; numbers never are.
        Format::Obj => obj::parse(&String::from_utf8_lossy(bytes)).map_err(MeshError::from),
        Format::Stl => stl::parse(bytes).map_err(MeshError::from),
        Format::Ply => ply::parse(bytes).map_err(MeshError::from),
        #[cfg(feature = "verification")]
        Format::Gltf => {
            let folder = Path::new(source).parent().unwrap_or(Path::new(""));
            gltf::parse(bytes, folder).map_err(MeshError::from)
        }
        #[cfg(not(feature = "verification"))]
        Format::Gltf => {
            return Err(SceneError::NoReader { path: source.to_owned() });
        }
    };
    read.map_err(|error| failed(source, error))
}

/// A mesh as its camera sees it.
fn seen(source: &str, mesh: &Mesh, viewport: &Viewport) -> Result<Scene, SceneError> {
    let seen = camera::view(mesh, viewport)
        .ok_or_else(|| SceneError::Mesh { path: source.to_owned(), source: MeshError::NoExtent })?;
    let first_dropped = seen.dropped.map(|(n, why)| format!("{}: {why}", mesh.places[n]));
    let sets = mesh.sets.iter().map(|set| set.of(&seen.kept)).collect();
    Ok(Scene {
        name: source.to_owned(),
        triangles: seen.triangles,
        places: seen.kept.iter().map(|n| mesh.places[*n]).collect(),
        dropped: mesh.triangles.len() - seen.kept.len(),
        first_dropped,
        lens: seen.lens,
        attributes: Attributes::Mesh { w: seen.w, sets },
    })
}

#[cfg(feature = "verification")]
fn json_lines(text: &str, path: &str) -> Result<Scene, SceneError> {
    let read = lines::parse_scene(text).map_err(|(line, source)| SceneError::Line {
        path: path.to_owned(),
        line,
        source,
    })?;
    if read.is_empty() {
        return Err(SceneError::Empty { path: path.to_owned() });
    }
    let places = read.iter().map(|line| Place::Line(line.line)).collect();
    let (triangles, shading) = read.into_iter().map(|line| (line.triangle, line.shading)).unzip();
    Ok(Scene { places, attributes: Attributes::Lines(shading), ..Scene::new(path, triangles) })
}

#[cfg(not(feature = "verification"))]
fn json_lines(_: &str, path: &str) -> Result<Scene, SceneError> {
    Err(SceneError::NoReader { path: path.to_owned() })
}

/// The file's bytes; a missing file whose name does not look like one is an unknown scene.
fn read(source: &str) -> Result<Vec<u8>, SceneError> {
    read_at_most(Path::new(source), LARGEST).map_err(|error| {
        let looks_like_file = MESHES.iter().any(|(.., ends, _)| has_extension(source, ends))
            || has_extension(source, &["jsonl", "ndjson", "json"])
            || source.contains(std::path::is_separator);
        if error.kind() == std::io::ErrorKind::NotFound && !looks_like_file {
            SceneError::Unknown { name: source.to_owned() }
        } else {
            SceneError::Io { path: source.to_owned(), source: error }
        }
    })
}

/// The format of a mesh under a name that does not tell, by what the file begins with.
fn looks_like(bytes: &[u8]) -> Option<Format> {
    let lines = || bytes.split(|byte| *byte == b'\n').take(1 << 16);
    let start = bytes.trim_ascii_start();
    let start = &start[..start.len().min(1 << 10)];
    let has = |word: &[u8]| start.windows(word.len()).any(|found| found == word);
    if bytes.starts_with(b"ply\n") || bytes.starts_with(b"ply\r") {
        Some(Format::Ply)
    } else if bytes.starts_with(b"glTF") || (start.starts_with(b"{") && has(b"\"asset\"")) {
        Some(Format::Gltf)
    } else if start.starts_with(b"solid") {
        Some(Format::Stl)
    } else {
        let obj = lines().any(|line| line.starts_with(b"v "))
            && lines().any(|line| line.starts_with(b"f "));
        obj.then_some(Format::Obj)
    }
}

fn has_extension(source: &str, known: &[&str]) -> bool {
    Path::new(source)
        .extension()
        .is_some_and(|got| known.iter().any(|want| got.eq_ignore_ascii_case(want)))
}

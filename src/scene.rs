//! Scenes: the geometry to draw. A scene does not configure how it is drawn.
//!
//! A scene is a list of triangles in window coordinates: y down, the origin at the window's top
//! left corner. It comes from one of three places: the program itself ([`builtin`]), an OBJ mesh
//! seen by a fixed camera ([`mesh`], [`camera`]), or a JSON Lines file in the form that
//! `guardbit eval` reads ([`lines`]).
//!
//! Floating point is allowed here, because a profile snaps every coordinate before a bit is
//! decided; but only `+ - * /`, `sqrt` and `floor`, which IEEE 754 rounds alike everywhere, so that
//! a scene is the same on every machine.

mod attributes;
pub mod builtin;
pub mod camera;
mod lens;
#[cfg(feature = "verification")]
pub mod lines;
pub mod mesh;
mod primitive;
mod shading;
mod sine;

use std::path::Path;

pub use attributes::{AttributeSet, Attributes};
pub use builtin::builtin_names;
pub use lens::Lens;
#[cfg(feature = "verification")]
use lines::LineError;
use mesh::MeshError;
pub use primitive::Primitive;
pub use shading::Shading;

/// Where a scene lands.
///
/// Units: pixels for the window, depth ULPs for the depth.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Viewport {
    /// Width of the window in pixels, at least 1.
    pub width: u32,
    /// Height of the window in pixels, at least 1.
    pub height: u32,
    /// The largest depth code, 2^d - 1 for a depth of d bits.
    pub depth_max: u64,
}

impl Viewport {
    /// The window's width and height in pixels, exactly.
    pub fn size(&self) -> [f64; 2] {
        [f64::from(self.width), f64::from(self.height)]
    }

    /// The largest double that is not above `depth_max`; equal to it up to 2^53.
    ///
    /// Rounded down rather than to nearest: 2^64 - 1 would become 2^64, a code that does not exist.
    pub fn depth_max_real(&self) -> f64 {
        let spare =
            (u64::BITS - self.depth_max.leading_zeros()).saturating_sub(f64::MANTISSA_DIGITS);
        #[expect(
            clippy::cast_precision_loss,
            reason = "exact: at most 53 significant bits are left"
        )]
        let real = (self.depth_max >> spare << spare) as f64;
        real
    }

    /// The depth code at `part / whole` of the range, rounded down: 0 at 0, the maximum at `whole`.
    ///
    /// A part beyond the whole counts as the whole.
    pub(crate) fn depth(&self, part: u16, whole: u16) -> f64 {
        if part >= whole {
            return self.depth_max_real();
        }
        (self.depth_max_real() * f64::from(part) / f64::from(whole)).floor()
    }
}

/// One triangle, in the two kinds of coordinates that a profile takes.
#[derive(Debug, Clone, PartialEq)]
pub enum Triangle {
    /// Exact integers on the profile's input lattice.
    Lattice {
        /// x, y of each vertex in sub-pixels of the profile's input lattice.
        xy: [[i128; 2]; 3],
        /// z of each vertex in depth ULPs, where depth is given.
        z: Option<[i128; 3]>,
    },
    /// Real numbers, to be snapped by the profile.
    Real {
        /// x, y of each vertex in pixels.
        xy: [[f64; 2]; 3],
        /// z of each vertex in depth ULPs, where depth is given.
        z: Option<[f64; 3]>,
    },
}

impl Triangle {
    /// A triangle of real numbers from its vertices `[x, y, z]`.
    pub fn real(v: [[f64; 3]; 3]) -> Self {
        Self::Real { xy: v.map(|[x, y, _]| [x, y]), z: Some(v.map(|[_, _, z]| z)) }
    }
}

/// A named list of triangles, in the order they are drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    /// The built-in name, or the path it was read from.
    pub name: String,
    /// The triangles in drawing order.
    pub triangles: Vec<Triangle>,
    /// How many triangles of a mesh were left out because a vertex was at or behind the near plane.
    pub dropped: usize,
    /// The camera's planes, where the scene was seen through one.
    pub lens: Option<Lens>,
    /// What its vertices carry.
    pub attributes: Attributes,
}

/// Why a scene could not be loaded.
#[derive(Debug, thiserror::Error)]
pub enum SceneError {
    /// The window has no pixels.
    #[error("viewport {width} x {height}: width >= 1 and height >= 1 are needed")]
    Viewport {
        /// The width asked for.
        width: u32,
        /// The height asked for.
        height: u32,
    },
    /// Neither a built-in name nor a file.
    #[error(
        "no scene `{name}`: it is not a file and not a built-in scene; give one of the built-in scenes ({}), \
         an .obj mesh, or a JSON Lines file of triangles",
        builtin::name_list()
    )]
    Unknown {
        /// What was asked for.
        name: String,
    },
    /// The file could not be read.
    #[error("{path}: the file cannot be read: {source}")]
    Io {
        /// The path as it was given.
        path: String,
        /// What the system said.
        source: std::io::Error,
    },
    /// A file of a format that is not read.
    #[error("{path}: this is a {format} file, which is not read; export it as an OBJ mesh")]
    Format {
        /// The path as it was given.
        path: String,
        /// The format by its name.
        format: &'static str,
    },
    /// An OBJ mesh under another name.
    #[error("{path}: this is an OBJ mesh; meshes are read from files that end in .obj: rename it")]
    NamedOtherwise {
        /// The path as it was given.
        path: String,
    },
    /// The file is not text.
    #[error(
        "{path}: line {line}: the text is not UTF-8; a scene is an .obj mesh or JSON Lines; save the file as UTF-8"
    )]
    Encoding {
        /// The path as it was given.
        path: String,
        /// Line of the first byte that is not UTF-8, from 1.
        line: usize,
    },
    /// JSON Lines, in a build that does not read them.
    #[cfg(not(feature = "verification"))]
    #[error(
        "{path}: this build reads .obj meshes; build with the feature `verification` for JSON Lines"
    )]
    NoLines {
        /// The path as it was given.
        path: String,
    },
    /// A line of a JSON Lines file is wrong.
    #[cfg(feature = "verification")]
    #[error("{path}: line {line}: {source}")]
    Line {
        /// The path as it was given.
        path: String,
        /// Line number, from 1.
        line: usize,
        /// What is wrong with the line, with its field.
        source: LineError,
    },
    /// A JSON Lines file without a triangle.
    #[error(
        "{path}: the file has no triangles; write one triangle on each line, for example {{\"v\": [[0,0],[64,0],[0,64]]}}"
    )]
    Empty {
        /// The path as it was given.
        path: String,
    },
    /// A mesh is wrong.
    #[error("{path}: {source}")]
    Mesh {
        /// The path as it was given.
        path: String,
        /// What is wrong with it, with line and field.
        source: MeshError,
    },
}

/// Loads a scene: a built-in name, the path of an .obj mesh, or the path of a JSON Lines file.
///
/// A built-in name wins over a file of the same name; write `./knot` for the file.
///
/// # Errors
/// [`SceneError`], naming file, line and field; for a name that is neither, the built-in names.
pub fn load(source: &str, viewport: &Viewport) -> Result<Scene, SceneError> {
    let Viewport { width, height, .. } = *viewport;
    if width == 0 || height == 0 {
        return Err(SceneError::Viewport { width, height });
    }
    if let Some(scene) = builtin::make(source, viewport) {
        return Ok(scene);
    }
    let path = || source.to_owned();
    let bytes = read(source)?;
    let (triangles, dropped, lens, attributes) = if has_extension(source, &["obj"]) {
        // Comments and material names may be in any encoding; numbers never are.
        let failed = |source| SceneError::Mesh { path: path(), source };
        let mesh = mesh::parse(&String::from_utf8_lossy(&bytes)).map_err(failed)?;
        let seen = camera::view(&mesh.triangles, viewport);
        let seen = seen.ok_or_else(|| failed(MeshError::NoExtent))?;
        let sets = mesh.sets.iter().map(|set| set.of(&seen.kept)).collect();
        let dropped = mesh.triangles.len() - seen.kept.len();
        (seen.triangles, dropped, Some(seen.lens), Attributes { w: seen.w, sets })
    } else {
        if let Some(format) = foreign(source, &bytes) {
            return Err(SceneError::Format { path: path(), format });
        }
        if is_obj(&bytes) {
            return Err(SceneError::NamedOtherwise { path: path() });
        }
        let text = std::str::from_utf8(&bytes).map_err(|error| SceneError::Encoding {
            path: path(),
            line: 1 + bytes.iter().take(error.valid_up_to()).filter(|&&b| b == b'\n').count(),
        })?;
        (json_lines(text, source)?, 0, None, Attributes::default())
    };
    if triangles.is_empty() && dropped == 0 {
        return Err(SceneError::Empty { path: path() });
    }
    Ok(Scene { name: path(), triangles, dropped, lens, attributes })
}

#[cfg(feature = "verification")]
fn json_lines(text: &str, path: &str) -> Result<Vec<Triangle>, SceneError> {
    lines::parse_scene(text).map_err(|(line, source)| SceneError::Line {
        path: path.to_owned(),
        line,
        source,
    })
}

#[cfg(not(feature = "verification"))]
fn json_lines(_: &str, path: &str) -> Result<Vec<Triangle>, SceneError> {
    Err(SceneError::NoLines { path: path.to_owned() })
}

/// The file's bytes; a missing file whose name does not look like one is an unknown scene.
fn read(source: &str) -> Result<Vec<u8>, SceneError> {
    std::fs::read(source).map_err(|error| {
        let looks_like_file = has_extension(source, &["obj", "jsonl", "ndjson", "json"])
            || source.contains(std::path::is_separator);
        if error.kind() == std::io::ErrorKind::NotFound && !looks_like_file {
            SceneError::Unknown { name: source.to_owned() }
        } else {
            SceneError::Io { path: source.to_owned(), source: error }
        }
    })
}

/// Formats of geometry and pictures by their first bytes and their endings.
const FOREIGN: [(&str, &[u8], &[&str]); 8] = [
    ("binary glTF", b"glTF", &["glb"]),
    ("glTF", b"{\"asset\"", &["gltf"]),
    ("PLY", b"ply", &["ply"]),
    ("STL", b"solid ", &["stl"]),
    ("FBX", b"Kaydara FBX", &["fbx"]),
    ("COLLADA", b"<?xml", &["dae"]),
    ("PNG", b"\x89PNG", &["png"]),
    ("ZIP", b"PK\x03\x04", &["zip", "3mf", "usdz"]),
];

/// The format of a file that is not read.
fn foreign(source: &str, bytes: &[u8]) -> Option<&'static str> {
    let found = FOREIGN
        .iter()
        .find(|(_, first, ends)| bytes.starts_with(first) || has_extension(source, ends));
    found.map(|(name, ..)| *name)
}

/// Whether a text has the statements of an OBJ mesh.
fn is_obj(bytes: &[u8]) -> bool {
    let lines = || bytes.split(|byte| *byte == b'\n').take(1 << 16);
    lines().any(|line| line.starts_with(b"v ")) && lines().any(|line| line.starts_with(b"f "))
}

fn has_extension(source: &str, known: &[&str]) -> bool {
    Path::new(source)
        .extension()
        .is_some_and(|got| known.iter().any(|want| got.eq_ignore_ascii_case(want)))
}

#[cfg(test)]
#[allow(
    clippy::unwrap_used,
    clippy::float_cmp,
    reason = "a test may panic, and means the very bits"
)]
mod tests {
    use super::*;

    const VIEW: Viewport = Viewport { width: 64, height: 48, depth_max: 0xff_ffff };

    fn file(name: &str, content: &[u8]) -> (tempfile::TempDir, String) {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(name);
        std::fs::write(&path, content).unwrap();
        let path = path.to_str().unwrap().to_owned();
        (folder, path)
    }

    #[test]
    fn an_unknown_name_lists_the_builtins() {
        let message = load("knott", &VIEW).unwrap_err().to_string();
        for (name, _) in builtin_names() {
            assert!(message.contains(name), "{message}");
        }
        assert!(message.contains("`knott`"));
    }

    #[test]
    fn a_missing_file_is_a_read_error() {
        for name in ["missing.obj", "missing.jsonl", "./missing"] {
            assert!(matches!(load(name, &VIEW), Err(SceneError::Io { .. })), "{name}");
        }
    }

    #[test]
    fn a_window_without_pixels_is_refused() {
        let view = Viewport { width: 0, ..VIEW };
        let message = load("triangle", &view).unwrap_err().to_string();
        assert!(message.contains("0 x 48") && message.contains("width >= 1"));
    }

    #[test]
    fn json_lines_load_in_order_with_blank_lines_and_crlf() {
        let text = b"{\"v\": [[0,0],[64,0],[0,64]]}\r\n\r\n{\"f\": [[0,0,1],[1,0,2],[0,1,3]]}";
        let (_keep, path) = file("a.jsonl", text);
        let scene = load(&path, &VIEW).unwrap();
        assert_eq!(scene.name, path);
        assert_eq!(
            scene.triangles,
            [
                Triangle::Lattice { xy: [[0, 0], [64, 0], [0, 64]], z: None },
                Triangle::real([[0.0, 0.0, 1.0], [1.0, 0.0, 2.0], [0.0, 1.0, 3.0]]),
            ]
        );
    }

    #[test]
    fn json_lines_errors_name_file_line_and_field() {
        let (_keep, path) =
            file("a.txt", b"{\"v\": [[0,0],[64,0],[0,64]]}\n{\"v\": [[0,0],[1.5,0],[0,1]]}\n");
        let message = load(&path, &VIEW).unwrap_err().to_string();
        assert!(message.starts_with(&path), "{message}");
        assert!(
            message.contains("line 2") && message.contains("v[1][0]") && message.contains("1.5")
        );

        let (_keep, path) = file("b.jsonl", b"\n\xff\n");
        assert!(load(&path, &VIEW).unwrap_err().to_string().contains("line 2"));

        let (_keep, path) = file("c.jsonl", b"\n\n");
        assert!(matches!(load(&path, &VIEW), Err(SceneError::Empty { .. })));
    }

    #[test]
    fn a_mesh_loads_and_its_errors_name_file_and_line() {
        let (_keep, path) = file("a.OBJ", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
        assert_eq!(load(&path, &VIEW).unwrap().triangles.len(), 1);
        let (_keep, path) = file("b.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n");
        let message = load(&path, &VIEW).unwrap_err().to_string();
        assert!(message.starts_with(&path) && message.contains("line 4"), "{message}");
        let (_keep, path) = file("c.obj", b"v 1 1 1\nf 1 1 1\n");
        let message = load(&path, &VIEW).unwrap_err().to_string();
        assert!(message.contains("same point"), "{message}");
    }

    #[test]
    fn other_formats_are_named() {
        for (name, content, want) in [
            ("a.ply", &b"ply\nformat ascii 1.0\n"[..], "PLY file"),
            ("a.mesh", b"glTF\x02\0\0\0", "binary glTF file"),
            ("a.gltf", b"{\n  \"asset\": {}}", "glTF file"),
            ("a.stl", &[0; 84], "STL file"),
            ("a.jsonl", b"\x89PNG\r\n", "PNG file"),
            ("mesh", b"# a mesh\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "end in .obj: rename it"),
        ] {
            let (_keep, path) = file(name, content);
            let message = load(&path, &VIEW).unwrap_err().to_string();
            assert!(message.starts_with(&path) && message.contains(want), "{message}");
        }
    }

    #[test]
    fn the_largest_depth_never_rounds_up() {
        for d in 0..=64 {
            let depth_max = u64::MAX.checked_shr(64 - d).unwrap_or(0);
            let view = Viewport { depth_max, ..VIEW };
            let real = view.depth_max_real();
            assert!(real < 2f64.powi(64), "{d}");
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "an integer below 2^64"
            )]
            let back = real as u64;
            assert!(back <= depth_max && depth_max - back < 1 << 11, "{d}");
            assert!(d > 53 || back == depth_max, "{d}");
        }
    }
}

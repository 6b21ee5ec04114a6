//! Scenes: the geometry to draw. A scene does not configure how it is drawn.
//!
//! A scene is a list of triangles in window coordinates: y down, the origin at the window's top
//! left corner. It comes from one of three places: the program itself ([`builtin`]), a mesh seen by
//! a camera ([`mesh`], [`camera`]), or a JSON Lines file in the form that `guardbit eval` reads
//! ([`lines`]).
//!
//! Floating point is allowed here, because a profile snaps every coordinate before a bit is
//! decided; but only `+ - * /`, `sqrt` and `floor`, which IEEE 754 rounds alike everywhere, so that
//! a scene is the same on every machine.

mod attributes;
pub mod builtin;
pub mod camera;
mod error;
mod file;
mod lens;
#[cfg(feature = "verification")]
pub mod lines;
pub mod mesh;
mod place;
mod primitive;
mod shading;
mod sine;

pub use attributes::{AttributeSet, Attributes};
pub use builtin::builtin_names;
pub use error::SceneError;
pub use lens::Lens;
pub use place::Place;
pub use primitive::{Positioned, Primitive};
pub use shading::{Named, Shading};

/// The most bytes of a file of a scene that are read: 1 GiB.
pub const LARGEST: u64 = 1 << 30;

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
    /// Where each of them stands in its file; empty where there is none.
    pub places: Vec<Place>,
    /// How many triangles of a mesh were left out because a vertex was not between the near and the far
    /// plane.
    pub dropped: usize,
    /// The first of them, and why.
    pub first_dropped: Option<String>,
    /// The camera's planes, where the scene was seen through one.
    pub lens: Option<Lens>,
    /// What its vertices carry.
    pub attributes: Attributes,
}

impl Scene {
    /// A scene of these triangles alone.
    pub fn new(name: &str, triangles: Vec<Triangle>) -> Self {
        Self {
            name: name.to_owned(),
            triangles,
            places: Vec::new(),
            dropped: 0,
            first_dropped: None,
            lens: None,
            attributes: Attributes::default(),
        }
    }

    /// A triangle in words for a message: its place in the file, or its number.
    pub fn place(&self, triangle: usize) -> String {
        let place = self.places.get(triangle);
        place.map_or_else(|| format!("triangle {triangle}"), Place::to_string)
    }
}

/// Loads a scene: a built-in name, the path of a mesh, or the path of a JSON Lines file. The ending of the
/// path decides how it is read: `.obj`, `.gltf`, `.glb`, `.ply` and `.stl` are meshes.
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
    builtin::make(source, viewport).map_or_else(|| file::load(source, viewport), Ok)
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
        for name in ["missing.obj", "missing.glb", "missing.jsonl", "./missing"] {
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
    fn other_formats_and_other_names_are_named() {
        for (name, content, want) in [
            (
                "mesh",
                &b"ply\nformat ascii 1.0\n"[..],
                "a PLY mesh, which is read from files that end in .ply",
            ),
            (
                "a.mesh",
                b"glTF\x02\0\0\0",
                "glTF, which is read from files that end in .gltf or .glb: rename it",
            ),
            ("a.json", b"{\n  \"asset\": {}}", "glTF, which is read from"),
            ("a.txt", b"solid cube\n", "an STL mesh, which is read from files that end in .stl"),
            ("a.jsonl", b"\x89PNG\r\n", "PNG file, which is not read"),
            ("a.fbx", b"anything", "FBX file, which is not read; export it as glTF"),
            ("mesh", b"# a mesh\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "end in .obj: rename it"),
            ("a.ply", b"", "the file is empty"),
            ("a.glb", b"", "the file is empty"),
            ("a.jsonl", b"", "the file has no triangles"),
            ("a.STL", &[0; 84], "no facets"),
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

//! Cameras: the one of a file, or else one that frames a mesh in a three-quarter view.
//!
//! Only `+ - * /` and `sqrt` on doubles, each rounded as IEEE 754 says, so that a mesh lands on the
//! same coordinates on every machine. A vertex that two triangles share gives the same doubles in
//! both.

use std::cmp::Ordering;

use super::mesh::{Mesh, Point};
use super::sine::tangent;
use super::{Lens, Triangle, Viewport};

/// Towards the eye: from the front, the right and above.
const VIEW: Point = [4.0, 4.0, 7.0];

/// The eye's distance from the centre of a mesh scaled into the cube -1..=1, whose corners are at
/// sqrt(3) < 4, so that nothing reaches the eye.
const DISTANCE: f64 = 4.0;

/// The part of the window's shorter side left free along each side.
const MARGIN: f64 = 1.0 / 16.0;

/// A camera as a file places it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Placed {
    /// The eye, in the units of the mesh.
    pub eye: Point,
    /// Orthonormal, towards the right, the top, and backwards.
    pub axes: [Point; 3],
    /// What it sees of the space before it.
    pub projection: Projection,
    /// Distance of the near plane, at least 0; above 0 in perspective.
    pub near: f64,
    /// Distance of the far plane, above that of the near one; in perspective it may be infinite.
    pub far: f64,
}

/// How a placed camera sees.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Projection {
    /// Lines meet in the eye.
    Perspective {
        /// The angle between the lower and the upper side, in radians, between 0 and pi.
        fov: f64,
        /// Width over height, above 0, where the camera has a width of its own.
        aspect: Option<f64>,
    },
    /// Lines are parallel.
    Orthographic {
        /// Half of what it sees from left to right and from top to bottom, in the units of the mesh, above 0.
        half: [f64; 2],
    },
}

/// A camera and the viewport it draws to.
#[derive(Debug, Clone, PartialEq)]
pub struct Camera {
    /// Centre of the mesh's bounding box, and half of its longest side; or the eye, and 1.
    centre: Point,
    size: f64,
    /// The eye's distance from the centre, in sizes.
    distance: f64,
    /// Orthonormal, towards the right, the top, and the eye.
    axes: [Point; 3],
    perspective: bool,
    /// Distances from the eye, in sizes.
    near: f64,
    far: f64,
    /// Pixels to one unit, at distance 1 in perspective, and what lands in the middle of the window.
    scale: f64,
    middle: [f64; 2],
    window: [f64; 2],
    depth_max: f64,
}

/// Smallest and largest value along each axis.
fn bounds<const N: usize>(points: impl Iterator<Item = [f64; N]>) -> [[f64; N]; 2] {
    points.fold([[f64::INFINITY; N], [f64::NEG_INFINITY; N]], |[mut low, mut high], point| {
        for ((low, high), value) in low.iter_mut().zip(&mut high).zip(point) {
            *low = low.min(value);
            *high = high.max(value);
        }
        [low, high]
    })
}

impl Camera {
    /// The camera that shows the whole of a mesh, as large as the viewport allows with a margin of
    /// 1/16 of the shorter side; nothing where all points are one, or there are none.
    pub fn frame(mesh: &[[Point; 3]], viewport: &Viewport) -> Option<Self> {
        let points = || mesh.iter().flatten().copied();
        // Halves first: the sum or difference of two large doubles may be infinite.
        let [low, high] = bounds(points().map(|point| point.map(|value| value / 2.0)));
        let size = sub(high, low).into_iter().fold(0.0, f64::max);
        if !(size > 0.0 && size.is_finite()) {
            return None;
        }
        let [vx, _, vz] = VIEW;
        let back = unit(VIEW);
        let right = unit([vz, 0.0, -vx]);
        let mut camera = Self {
            centre: add(low, high),
            size,
            distance: DISTANCE,
            axes: [right, cross(back, right), back],
            perspective: true,
            near: 0.0,
            far: 0.0,
            scale: 1.0,
            middle: [0.0; 2],
            window: viewport.size(),
            depth_max: viewport.depth_max_real(),
        };
        let [[.., nearest], [.., farthest]] = bounds(points().map(|point| camera.seen(point)));
        // A little beyond the mesh, so that no vertex is on a plane. Every distance is above
        // 4 - sqrt(3) = 2.26, the range below 3.47: near >= 2.26 - 3.47/16 - 1/64 > 2.
        let beyond = (farthest - nearest) / 16.0 + 1.0 / 64.0;
        camera.near = nearest - beyond;
        camera.far = farthest + beyond;
        let [low, high] = bounds(points().map(|point| flat(camera.seen(point))));
        let [width, height] = camera.window;
        let free = width.min(height) * MARGIN * 2.0;
        camera.scale = [(width, low[0], high[0]), (height, low[1], high[1])]
            .map(|(side, low, high)| (side - free) / (high - low))
            .into_iter()
            .fold(f64::INFINITY, f64::min);
        if !camera.scale.is_finite() {
            // A line seen end on: a point, in the middle at any scale.
            camera.scale = 0.0;
        }
        camera.middle = [f64::midpoint(low[0], high[0]), f64::midpoint(low[1], high[1])];
        Some(camera)
    }

    /// The camera of a file. What it sees fills the viewport as far as its proportions allow.
    pub fn placed(placed: &Placed, viewport: &Viewport) -> Self {
        let halves = viewport.size().map(|side| side / 2.0);
        let [across, up] = match placed.projection {
            Projection::Perspective { fov, aspect } => {
                let up = tangent(fov / 2.0);
                [aspect.map_or(0.0, |aspect| aspect * up), up]
            }
            Projection::Orthographic { half } => half,
        };
        // A camera without a width of its own shows as much of it as the window has: x / 0 is infinite.
        let scale = (halves[0] / across).min(halves[1] / up);
        Self {
            centre: placed.eye,
            size: 1.0,
            distance: 0.0,
            axes: placed.axes,
            perspective: matches!(placed.projection, Projection::Perspective { .. }),
            near: placed.near,
            far: placed.far,
            scale,
            middle: [0.0; 2],
            window: viewport.size(),
            depth_max: viewport.depth_max_real(),
        }
    }

    /// Right, up and forward from the eye.
    fn seen(&self, point: Point) -> Point {
        let [right, up, back] = self.axes;
        let place = sub(point, self.centre).map(|value| value / self.size);
        [dot(right, place), dot(up, place), self.distance - dot(back, place)]
    }

    /// Where a point lands: x, y in pixels, z in depth ULPs, 0 at the near plane and the largest
    /// code at the far one; nothing for a point at or behind the near plane, or behind the far one.
    ///
    /// At distance d, z in perspective is far (d - near) / (d (far - near)) of the range: what z/w comes
    /// to, linear in the window. Otherwise it is (d - near) / (far - near).
    pub fn project(&self, point: Point) -> Option<Point> {
        let seen = self.seen(point);
        let [x, y, distance] = seen;
        // A NaN is nothing, too.
        let nearer = distance.partial_cmp(&self.near) != Some(Ordering::Greater);
        if nearer || distance > self.far {
            return None;
        }
        let (near, far) = (self.near, self.far);
        let ([x, y], depth) = if !self.perspective {
            ([x, y], (distance - near) / (far - near))
        } else if far.is_infinite() {
            (flat(seen), (distance - near) / distance)
        } else {
            (flat(seen), far * (distance - near) / (distance * (far - near)))
        };
        let [width, height] = self.window;
        let landed = [
            width / 2.0 + (x - self.middle[0]) * self.scale,
            height / 2.0 - (y - self.middle[1]) * self.scale,
            depth.clamp(0.0, 1.0) * self.depth_max,
        ];
        Some(landed)
    }

    /// The near and far plane, in the units of the mesh; nothing without perspective, where depth is
    /// linear in space.
    pub fn lens(&self) -> Option<Lens> {
        let lens = Lens { near: self.near * self.size, far: self.far * self.size };
        self.perspective.then_some(lens)
    }

    /// What w is at a point: its distance from the eye in perspective, otherwise 1.
    fn w(&self, point: Point) -> f64 {
        if self.perspective { self.seen(point)[2] } else { 1.0 }
    }

    /// The triangles that lie between the planes, and their numbers in the mesh.
    pub fn draw(&self, mesh: &[[Point; 3]]) -> (Vec<Triangle>, Vec<usize>) {
        let seen = mesh.iter().enumerate().filter_map(|(n, &[a, b, c])| {
            Some((Triangle::real([self.project(a)?, self.project(b)?, self.project(c)?]), n))
        });
        seen.unzip()
    }

    /// Why a triangle is not drawn.
    fn reason(&self, triangle: &[Point; 3]) -> String {
        let hidden = triangle.iter().position(|point| self.project(*point).is_none());
        let vertex = hidden.unwrap_or_default();
        let distance = self.seen(triangle[vertex])[2];
        let (near, far) = (self.near, self.far);
        format!(
            "vertex {vertex} is {distance} before the eye: {near} < distance <= {far} is needed, the near and \
             the far plane; clip the triangle, or move the camera"
        )
    }
}

/// A mesh as a camera sees it.
#[derive(Debug, Clone, PartialEq)]
pub struct View {
    /// The triangles between the near and the far plane.
    pub triangles: Vec<Triangle>,
    /// Their numbers in the mesh.
    pub kept: Vec<usize>,
    /// The first triangle that is not, and why.
    pub dropped: Option<(usize, String)>,
    /// The distance of each vertex from the eye, in any one unit; 1 without perspective.
    pub w: Vec<[f64; 3]>,
    /// The camera's planes, in perspective.
    pub lens: Option<Lens>,
}

/// A mesh in the window, by its own camera or framed; nothing where it has no extent to be framed. See
/// [`Camera::draw`].
pub fn view(mesh: &Mesh, viewport: &Viewport) -> Option<View> {
    let triangles = &mesh.triangles;
    let camera = match &mesh.camera {
        Some(placed) => Camera::placed(placed, viewport),
        None => Camera::frame(triangles, viewport)?,
    };
    let (drawn, kept) = camera.draw(triangles);
    let w = kept.iter().map(|n| triangles[*n].map(|point| camera.w(point))).collect();
    let first = (0..triangles.len()).find(|n| kept.get(*n) != Some(n));
    let dropped = first.map(|n| (n, camera.reason(&triangles[n])));
    Some(View { triangles: drawn, kept, dropped, w, lens: camera.lens() })
}

/// On the plane at distance 1.
fn flat([x, y, distance]: Point) -> [f64; 2] {
    [x / distance, y / distance]
}

/// a + b.
pub(crate) fn add(a: Point, b: Point) -> Point {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

/// a - b.
pub(crate) fn sub(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// s a.
pub(crate) fn times(s: f64, a: Point) -> Point {
    a.map(|value| s * value)
}

/// a . b.
pub(crate) fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// a x b.
pub(crate) fn cross(a: Point, b: Point) -> Point {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// a / |a|.
pub(crate) fn unit(a: Point) -> Point {
    times(1.0 / dot(a, a).sqrt(), a)
}

#[cfg(test)]
#[allow(
    clippy::unwrap_used,
    clippy::float_cmp,
    reason = "a test may panic, and means the very bits"
)]
mod tests {
    use super::*;

    const WINDOW: Viewport = Viewport { width: 640, height: 480, depth_max: 0xffff };

    /// The twelve triangles of a box from `low` to `high`, wound anyhow.
    fn cuboid(low: Point, high: Point) -> Vec<[Point; 3]> {
        let corner = |bits: usize| {
            [0, 1, 2].map(|axis| if bits >> axis & 1 == 1 { high[axis] } else { low[axis] })
        };
        [[0, 1, 3, 2], [4, 5, 7, 6], [0, 1, 5, 4], [2, 3, 7, 6], [0, 2, 6, 4], [1, 3, 7, 5]]
            .into_iter()
            .flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]])
            .map(|corners| corners.map(corner))
            .collect()
    }

    fn landed(mesh: &[[Point; 3]], viewport: &Viewport) -> Vec<Point> {
        let camera = Camera::frame(mesh, viewport).unwrap();
        mesh.iter().flatten().map(|&point| camera.project(point).unwrap()).collect()
    }

    #[test]
    fn every_mesh_fills_the_window_up_to_the_margin() {
        let boxes = [
            ([-1.0; 3], [1.0; 3]),
            ([1e6, 1e6, 1e6], [1e6 + 1.0, 1e6 + 2.0, 1e6 + 3.0]),
            ([0.0; 3], [1e-300, 0.0, 1e-290]),
            ([-f64::MAX; 3], [f64::MAX; 3]),
            ([0.0; 3], [5.0, 0.0, 0.0]),
        ];
        for (low, high) in boxes {
            for (width, height) in [(2, 2), (640, 480), (3, 65536), (65536, 65536), (1, 1)] {
                let viewport = Viewport { width, height, depth_max: 0xffff_ffff };
                let [[x0, y0, z0], [x1, y1, z1]] =
                    bounds(landed(&cuboid(low, high), &viewport).into_iter());
                let [w, h] = viewport.size();
                let margin = w.min(h) / 16.0;
                let slack = 1e-9 * w.max(h);
                assert!(x0 >= margin - slack && x1 <= w - margin + slack, "{x0} {x1}");
                assert!(y0 >= margin - slack && y1 <= h - margin + slack, "{y0} {y1}");
                let touches = |got: f64, side: f64| (got - (side - 2.0 * margin)).abs() <= slack;
                assert!(touches(x1 - x0, w) || touches(y1 - y0, h));
                assert!(0.0 < z0 && z0 <= z1 && z1 < viewport.depth_max_real());
            }
        }
    }

    #[test]
    fn up_is_up_right_is_right_and_far_is_deep() {
        let camera = Camera::frame(&cuboid([-1.0; 3], [1.0; 3]), &WINDOW).unwrap();
        let at = |point| camera.project(point).unwrap();
        let origin = at([0.0; 3]);
        assert!(at([0.0, 1.0, 0.0])[1] < origin[1], "y is down in the window");
        assert!(at([1.0, 0.0, 0.0])[0] > origin[0]);
        for axis in 0..3 {
            let mut point = [0.0; 3];
            point[axis] = 0.5;
            assert!(at(point)[2] < origin[2], "towards the eye is nearer");
        }
    }

    #[test]
    fn depth_is_linear_in_the_window() {
        // z/w of points of one plane is an affine function of x, y: the fourth follows from three.
        let camera = Camera::frame(&cuboid([-1.0; 3], [1.0; 3]), &WINDOW).unwrap();
        let plane = |s: f64, t: f64| camera.project([s, t, 0.3 * s - 0.6 * t]).unwrap();
        let [o, a, b, p] = [plane(0., 0.), plane(0.9, 0.1), plane(-0.2, 0.8), plane(-0.7, -0.9)];
        let [u, v, w] = [sub(a, o), sub(b, o), sub(p, o)];
        let area = u[0] * v[1] - u[1] * v[0];
        let s = (w[0] * v[1] - w[1] * v[0]) / area;
        let t = (u[0] * w[1] - u[1] * w[0]) / area;
        assert!((w[2] - s * u[2] - t * v[2]).abs() < 1e-6);
    }

    #[test]
    fn what_is_behind_the_near_plane_is_dropped_and_counted() {
        let mesh = cuboid([-1.0; 3], [1.0; 3]);
        let camera = Camera::frame(&mesh, &WINDOW).unwrap();
        assert_eq!(camera.draw(&mesh).1.len(), mesh.len());
        let eye = times(DISTANCE, unit(VIEW));
        let behind = times(2.0, eye);
        let odd =
            [[[0.0; 3], [1.0; 3], behind], [[0.0; 3], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]], [eye; 3]];
        let (triangles, kept) = camera.draw(&odd);
        assert_eq!((triangles.len(), kept.len()), (1, 1));
        assert_eq!(camera.project([f64::NAN; 3]), None);
    }

    const PLACED: Placed = Placed {
        eye: [0.0, 0.0, 5.0],
        axes: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        projection: Projection::Perspective { fov: std::f64::consts::FRAC_PI_2, aspect: None },
        near: 1.0,
        far: 9.0,
    };

    /// By hand: at distance 5 half of a right angle sees 5 up and down.
    #[test]
    fn a_placed_camera_sees_by_its_angle() {
        let at = |placed: &Placed, point| Camera::placed(placed, &WINDOW).project(point);
        let depth = 9.0 * 4.0 / (5.0 * 8.0) * 65535.0;
        let near = |got: Option<Point>, want: Point| {
            let off = sub(got.unwrap(), want).map(f64::abs);
            assert!(off.iter().all(|off| *off < 1e-9), "{got:?} {want:?}");
        };
        near(at(&PLACED, [5.0, 5.0, 0.0]), [320.0 + 240.0, 0.0, depth]);
        assert_eq!(at(&PLACED, [0.0, 0.0, 4.0]), None);
        assert_eq!(at(&PLACED, [0.0, 0.0, -5.0]), None);
        // Twice as wide as high: the width of the window decides.
        let projection =
            Projection::Perspective { fov: std::f64::consts::FRAC_PI_2, aspect: Some(2.0) };
        near(at(&Placed { projection, ..PLACED }, [5.0, 5.0, 0.0]), [320.0 + 160.0, 80.0, depth]);
        let far = Placed { far: f64::INFINITY, ..PLACED };
        near(at(&far, [0.0, 0.0, -95.0]), [320.0, 240.0, 0.99 * 65535.0]);
        let lens = Camera::placed(&far, &WINDOW).lens().unwrap();
        assert_eq!([lens.distance(0.0), lens.distance(0.5), lens.steepness(0.5)], [1.0, 2.0, 4.0]);
    }

    #[test]
    fn parallel_lines_have_one_w_and_linear_depth() {
        let projection = Projection::Orthographic { half: [4.0, 2.0] };
        let placed = Placed { projection, near: 0.0, ..PLACED };
        let triangles = vec![[[4.0, 2.0, 0.5], [0.0; 3], [0.0, -1.0, -4.0]], [[0.0, 0.0, 6.0]; 3]];
        let mesh = Mesh { triangles, camera: Some(placed), ..Mesh::default() };
        let view = view(&mesh, &WINDOW).unwrap();
        // 80 pixels a unit, as 320 / 4 < 240 / 2.
        let want = [
            [640.0, 80.0, 0.5 * 65535.0],
            [320.0, 240.0, 5.0 / 9.0 * 65535.0],
            [320.0, 320.0, 65535.0],
        ];
        assert_eq!(view.triangles, [Triangle::real(want)]);
        assert_eq!((view.w, view.lens), (vec![[1.0; 3]], None));
        let (n, why) = view.dropped.unwrap();
        assert!(
            n == 1 && why.contains("vertex 0 is -1 before the eye: 0 < distance <= 9"),
            "{why}"
        );
    }

    #[test]
    fn a_point_has_no_frame_and_a_line_seen_end_on_has() {
        assert_eq!(Camera::frame(&[[[1.0; 3]; 3]], &WINDOW), None);
        assert_eq!(Camera::frame(&[], &WINDOW), None);
        let mesh = [[[0.0; 3], VIEW, times(0.5, VIEW)]];
        for [x, y, _] in landed(&mesh, &WINDOW) {
            assert!((0.0..=640.0).contains(&x) && (0.0..=480.0).contains(&y));
        }
    }
}

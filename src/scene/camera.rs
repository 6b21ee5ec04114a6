//! A camera that frames a mesh: three-quarter view, perspective, viewport.
//!
//! Only `+ - * /` and `sqrt` on doubles, each rounded as IEEE 754 says, so that a mesh lands on the
//! same coordinates on every machine. A vertex that two triangles share gives the same doubles in
//! both.

use std::cmp::Ordering;

use super::mesh::Point;
use super::{Lens, Triangle, Viewport};

/// Towards the eye: from the front, the right and above.
const VIEW: Point = [4.0, 4.0, 7.0];

/// The eye's distance from the centre of a mesh scaled into the cube -1..=1, whose corners are at
/// sqrt(3) < 4, so that nothing reaches the eye.
const DISTANCE: f64 = 4.0;

/// The part of the window's shorter side left free along each side.
const MARGIN: f64 = 1.0 / 16.0;

/// A camera and the viewport it draws to.
#[derive(Debug, Clone, PartialEq)]
pub struct Camera {
    /// Centre of the mesh's bounding box, and half of its longest side.
    centre: Point,
    size: f64,
    /// Orthonormal, towards the right, the top, and the eye.
    axes: [Point; 3],
    /// Distances from the eye, in half sides of the bounding box.
    near: f64,
    far: f64,
    /// Pixels to one unit at distance 1, and what lands in the middle of the window.
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
            axes: [right, cross(back, right), back],
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

    /// Right, up and forward from the eye.
    fn seen(&self, point: Point) -> Point {
        let [right, up, back] = self.axes;
        let place = sub(point, self.centre).map(|value| value / self.size);
        [dot(right, place), dot(up, place), DISTANCE - dot(back, place)]
    }

    /// Where a point lands: x, y in pixels, z in depth ULPs, 0 at the near plane and the largest
    /// code at the far one; nothing for a point at or behind the near plane.
    ///
    /// z is far (d - near) / (d (far - near)) of the range at distance d: what z/w comes to, linear
    /// in the window.
    pub fn project(&self, point: Point) -> Option<Point> {
        let seen = self.seen(point);
        let [.., distance] = seen;
        // A NaN is nothing, too.
        if distance.partial_cmp(&self.near) != Some(Ordering::Greater) {
            return None;
        }
        let [x, y] = flat(seen);
        let [width, height] = self.window;
        let depth = self.far * (distance - self.near) / (distance * (self.far - self.near));
        Some([
            width / 2.0 + (x - self.middle[0]) * self.scale,
            height / 2.0 - (y - self.middle[1]) * self.scale,
            depth.clamp(0.0, 1.0) * self.depth_max,
        ])
    }

    /// The near and far plane, in the units of the mesh.
    pub fn lens(&self) -> Lens {
        Lens { near: self.near * self.size, far: self.far * self.size }
    }

    /// The triangles that lie in front of the near plane, and their numbers in the mesh.
    pub fn draw(&self, mesh: &[[Point; 3]]) -> (Vec<Triangle>, Vec<usize>) {
        let seen = mesh.iter().enumerate().filter_map(|(n, &[a, b, c])| {
            Some((Triangle::real([self.project(a)?, self.project(b)?, self.project(c)?]), n))
        });
        seen.unzip()
    }
}

/// A mesh as a camera sees it.
#[derive(Debug, Clone, PartialEq)]
pub struct View {
    /// The triangles in front of the near plane.
    pub triangles: Vec<Triangle>,
    /// Their numbers in the mesh.
    pub kept: Vec<usize>,
    /// The distance of each of their vertices from the eye, in half sides of the bounding box.
    pub w: Vec<[f64; 3]>,
    /// The camera's planes.
    pub lens: Lens,
}

/// A mesh in the window, framed; nothing where it has no extent. See [`Camera::draw`].
pub fn view(mesh: &[[Point; 3]], viewport: &Viewport) -> Option<View> {
    let camera = Camera::frame(mesh, viewport)?;
    let (triangles, kept) = camera.draw(mesh);
    let w = kept.iter().map(|n| mesh[*n].map(|point| camera.seen(point)[2])).collect();
    Some(View { triangles, kept, w, lens: camera.lens() })
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
fn dot(a: Point, b: Point) -> f64 {
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

//! Transforms of nodes.

use gltf_json::Node;

use crate::scene::camera::{add, cross, dot, times};
use crate::scene::mesh::Point;

/// An affine transform: what x, y and z go to, and where the origin goes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Transform {
    pub(super) axes: [Point; 3],
    pub(super) origin: Point,
}

impl Transform {
    pub(super) const IDENTITY: Self =
        Self { axes: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], origin: [0.0; 3] };

    /// That of a node to its parent: its matrix, or scale, then rotation, then translation. Nothing for what is
    /// not affine, or not finite.
    pub(super) fn of(node: &Node) -> Option<Self> {
        let real = |values: [f32; 3]| values.map(f64::from);
        let found = if let Some(m) = node.matrix {
            let column = |n: usize| real([m[4 * n], m[4 * n + 1], m[4 * n + 2]]);
            let last = [m[3], m[7], m[11], m[15] - 1.0];
            if last.iter().any(|value| *value != 0.0) {
                return None;
            }
            Self { axes: [column(0), column(1), column(2)], origin: column(3) }
        } else {
            let scale = real(node.scale.unwrap_or([1.0; 3]));
            let turned = rotation(node.rotation.unwrap_or_default().0.map(f64::from));
            let axes = [0, 1, 2].map(|n| times(scale[n], turned[n]));
            Self { axes, origin: real(node.translation.unwrap_or_default()) }
        };
        found.is_finite().then_some(found)
    }

    pub(super) fn is_finite(&self) -> bool {
        self.axes.iter().flatten().chain(&self.origin).all(|value| value.is_finite())
    }

    pub(super) fn point(&self, point: Point) -> Point {
        add(self.direction(point), self.origin)
    }

    pub(super) fn direction(&self, [x, y, z]: Point) -> Point {
        let [a, b, c] = self.axes;
        add(add(times(x, a), times(y, b)), times(z, c))
    }

    /// This transform after that one.
    pub(super) fn after(&self, inner: &Self) -> Self {
        Self { axes: inner.axes.map(|axis| self.direction(axis)), origin: self.point(inner.origin) }
    }

    /// A normal by the inverse transpose, to length 1; one of no length, or flattened, stays as it is.
    ///
    /// The inverse transpose is the matrix of cofactors over the determinant. Only its sign matters for a direction.
    pub(super) fn normal(&self, normal: Point) -> Point {
        let [a, b, c] = self.axes;
        let cofactors = Self { axes: [cross(b, c), cross(c, a), cross(a, b)], origin: [0.0; 3] };
        let sign = if dot(a, cross(b, c)) < 0.0 { -1.0 } else { 1.0 };
        let turned = times(sign, cofactors.direction(normal));
        let length = dot(turned, turned).sqrt();
        if length > 0.0 && length.is_finite() { turned.map(|value| value / length) } else { normal }
    }
}

/// The axes that a quaternion x, y, z, w turns x, y and z to. It need not have length 1.
fn rotation(q: [f64; 4]) -> [Point; 3] {
    let [x, y, z, w] = q;
    let s = 2.0 / (x * x + y * y + z * z + w * w);
    [
        [1.0 - s * (y * y + z * z), s * (x * y + z * w), s * (x * z - y * w)],
        [s * (x * y - z * w), 1.0 - s * (x * x + z * z), s * (y * z + x * w)],
        [s * (x * z + y * w), s * (y * z - x * w), 1.0 - s * (x * x + y * y)],
    ]
}

#[cfg(test)]
#[allow(clippy::float_cmp, reason = "a test means the very bits")]
mod tests {
    use super::*;
    use gltf_json::scene::UnitQuaternion;

    /// A quarter turn about z takes x to y; then everything moves by 10.
    #[test]
    fn scale_goes_first_then_rotation_then_translation() {
        let node = Node {
            scale: Some([2.0, 1.0, 1.0]),
            rotation: Some(UnitQuaternion([0.0, 0.0, 1.0, 1.0])),
            translation: Some([10.0, 0.0, 0.0]),
            ..Node::default()
        };
        let found = Transform::of(&node);
        let matrix = Node {
            matrix: Some([0., 2., 0., 0., -1., 0., 0., 0., 0., 0., 1., 0., 10., 0., 0., 1.]),
            ..Node::default()
        };
        assert_eq!(found, Transform::of(&matrix));
        let Some(found) = found else { unreachable!("finite") };
        assert_eq!(found.point([1.0, 0.0, 5.0]), [10.0, 2.0, 5.0]);
        // The outer transform comes last.
        let twice = found.after(&found);
        assert_eq!(twice.point([1.0, 0.0, 0.0]), found.point(found.point([1.0, 0.0, 0.0])));
        // The plane x + y = c is -x + 2y ... after a turn: its normal by hand.
        let [x, y, z] = found.normal([1.0, 0.0, 0.0]);
        assert_eq!([x.abs(), y, z.abs()], [0.0, 1.0, 0.0]);
    }

    #[test]
    fn a_normal_stays_upright_on_its_plane() {
        // Stretched by 2 in x, mirrored in z: the plane through (1, 0, 0), (0, 1, 0) and along z.
        let stretched = Transform {
            axes: [[2.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, -1.0]],
            origin: [7.0; 3],
        };
        let normal = stretched.normal([1.0, 1.0, 0.0]);
        let along = stretched.direction([1.0, -1.0, 0.0]);
        assert!(dot(normal, along).abs() < 1e-15);
        assert!(normal[0] > 0.0 && normal[1] > 0.0 && (dot(normal, normal) - 1.0).abs() < 1e-15);
        assert_eq!(stretched.normal([0.0, 0.0, 1.0]), [0.0, 0.0, -1.0]);
        assert_eq!(stretched.normal([0.0; 3]), [0.0; 3]);
    }

    #[test]
    fn no_transform_of_space_is_refused() {
        let quaternion = Node { rotation: Some(UnitQuaternion([0.0; 4])), ..Node::default() };
        assert_eq!(Transform::of(&quaternion), None);
        let mut matrix = [0.0; 16];
        matrix[15] = 0.5;
        assert_eq!(Transform::of(&Node { matrix: Some(matrix), ..Node::default() }), None);
        let wide = Node { translation: Some([f32::INFINITY, 0.0, 0.0]), ..Node::default() };
        assert_eq!(Transform::of(&wide), None);
    }
}

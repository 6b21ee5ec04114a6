//! The nodes of the default scene: which meshes they draw, and the first camera.

use std::f64::consts::PI;

use gltf_json::camera::Type;
use gltf_json::validation::Checked;
use gltf_json::{Camera, Root};

use super::GltfError;
use super::transform::Transform;
use crate::scene::camera::{Placed, Projection, cross, unit};

/// A mesh, drawn by a node.
pub(super) struct Drawn {
    pub(super) node: usize,
    pub(super) mesh: usize,
    pub(super) world: Transform,
}

/// One of a list of the file, by its index.
pub(super) fn look_up<'a, T>(
    list: &'a [T],
    index: usize,
    what: &'static str,
    place: impl Fn() -> String,
) -> Result<&'a T, GltfError> {
    let count = list.len();
    list.get(index).ok_or_else(|| GltfError::Index { place: place(), what, index, count })
}

/// The meshes of the default scene, or else of the first one, a node before its children; and the first camera.
pub(super) fn walk(root: &Root) -> Result<(Vec<Drawn>, Option<Placed>), GltfError> {
    if root.scenes.is_empty() {
        return Err(GltfError::NoScene);
    }
    let scene = root.scene.map_or(0, |scene| scene.value());
    let roots = &look_up(&root.scenes, scene, "scenes", || "scene".to_owned())?.nodes;
    // A list of what is left, rather than recursion: a chain of nodes may be as long as the file.
    let mut left = Vec::new();
    for (n, node) in roots.iter().enumerate().rev() {
        left.push((node.value(), Transform::IDENTITY, (None, n)));
    }
    let (mut drawn, mut camera) = (Vec::new(), None);
    let mut seen = vec![false; root.nodes.len()];
    while let Some((index, outer, (parent, n))) = left.pop() {
        let node = look_up(&root.nodes, index, "nodes", || match parent {
            Some(parent) => format!("nodes[{parent}].children[{n}]"),
            None => format!("scenes[{scene}].nodes[{n}]"),
        })?;
        if std::mem::replace(&mut seen[index], true) {
            return Err(GltfError::Twice { node: index });
        }
        let own = Transform::of(node).ok_or(GltfError::Transform { node: index })?;
        let world = outer.after(&own);
        if !world.is_finite() {
            return Err(GltfError::Transform { node: index });
        }
        if let (Some(found), None) = (node.camera, camera) {
            let place = || format!("nodes[{index}].camera");
            let found = (look_up(&root.cameras, found.value(), "cameras", place)?, found.value());
            camera = Some(placed(found, &world, index)?);
        }
        if let Some(mesh) = node.mesh {
            let mesh = mesh.value();
            let found = look_up(&root.meshes, mesh, "meshes", || format!("nodes[{index}].mesh"))?;
            if node.skin.is_some() {
                return Err(GltfError::Skin { node: index });
            }
            let weights = node.weights.as_ref().or(found.weights.as_ref());
            if weights.is_some_and(|weights| weights.iter().any(|weight| *weight != 0.0)) {
                return Err(GltfError::Morph { node: index, mesh });
            }
            drawn.push(Drawn { node: index, mesh, world });
        }
        for (n, child) in node.children.as_deref().unwrap_or_default().iter().enumerate().rev() {
            left.push((child.value(), world, (Some(index), n)));
        }
    }
    Ok((drawn, camera))
}

/// A camera of a node: at its origin, looking along its -z, with y upwards. A scale does not matter.
fn placed(
    (camera, index): (&Camera, usize),
    world: &Transform,
    node: usize,
) -> Result<Placed, GltfError> {
    let refused = |need| GltfError::Camera { camera: index, need };
    let above = |value: f64, least: f64, need| {
        // A NaN is not above, either.
        if value > least && value.is_finite() { Ok(value) } else { Err(refused(need)) }
    };
    let (projection, near, far) = match (camera.type_, &camera.perspective, &camera.orthographic) {
        (Checked::Valid(Type::Perspective), Some(found), _) => {
            let fov = above(found.yfov.into(), 0.0, "0 < yfov < pi")?;
            if fov >= PI {
                return Err(refused("0 < yfov < pi"));
            }
            let aspect = found.aspect_ratio.map(f64::from);
            let aspect =
                aspect.map(|aspect| above(aspect, 0.0, "0 < aspectRatio < 2^128")).transpose()?;
            let near = above(found.znear.into(), 0.0, "0 < znear")?;
            let far = found.zfar.map(|far| above(far.into(), near, "znear < zfar")).transpose()?;
            (Projection::Perspective { fov, aspect }, near, far.unwrap_or(f64::INFINITY))
        }
        (Checked::Valid(Type::Orthographic), _, Some(found)) => {
            let half = |value: f32| above(value.into(), 0.0, "0 < xmag and 0 < ymag");
            let half = [half(found.xmag)?, half(found.ymag)?];
            let near = f64::from(found.znear);
            if !(near >= 0.0 && near.is_finite()) {
                return Err(refused("0 <= znear"));
            }
            let far = above(found.zfar.into(), near, "znear < zfar")?;
            (Projection::Orthographic { half }, near, far)
        }
        _ => return Err(refused("`perspective` or `orthographic`, as `type` says,")),
    };
    let [_, y, z] = world.axes;
    let back = unit(z);
    let right = unit(cross(y, back));
    let axes = [right, cross(back, right), back];
    if !axes.iter().flatten().all(|value| value.is_finite()) {
        return Err(GltfError::Direction { node });
    }
    Ok(Placed { eye: world.origin, axes, projection, near, far })
}

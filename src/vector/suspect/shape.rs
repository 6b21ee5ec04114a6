//! Suspects of lines, points, quadrilaterals and homogeneous triangles: other rules.

use super::{Suspect, Suspects};
use crate::bits::Rounding;
use crate::cover::{LineConfig, LineRule, PointConfig, PointRule, Start, Tie};
use crate::model::Model;
use crate::profile::{Profile, neighbours};
use crate::vector::bench::{ShapeBench, ShapeKind};
use std::sync::Arc;

impl Suspects for ShapeBench {
    fn suspects(&self) -> Vec<Suspect<'_>> {
        let suspect = |(change, profile): (String, Profile)| {
            let model = Arc::new(Model::new(&profile).ok()?);
            Some(Suspect::new(self, change, self.drawer(model)))
        };
        other_rules(self.kind(), self.profile()).into_iter().filter_map(suspect).collect()
    }
}

/// Profiles with another line or point rule, or with another decision of the profile's, and what
/// that is.
fn other_rules(kind: ShapeKind, profile: &Profile) -> Vec<(String, Profile)> {
    let mut changed = Vec::new();
    match kind {
        ShapeKind::Point => {
            let rules = [("pixel", PointRule::Pixel), ("pixel-d3d", PointRule::PixelD3d)];
            changed.extend(rules.map(|(name, rule)| {
                let point = Some(PointConfig { rule });
                (format!("point.rule is {name}"), Profile { point, ..profile.clone() })
            }));
        }
        ShapeKind::Line => {
            let rules = [
                ("diamond-d3d", LineRule::DiamondD3d),
                ("diamond-vulkan", LineRule::DiamondVulkan),
                ("bresenham", LineRule::Bresenham),
                ("midpoint with ties north-east", LineRule::Midpoint { tie: Tie::NorthEast }),
                (
                    "integer-incremental from zero",
                    LineRule::IntegerIncremental { start: Start::Zero },
                ),
                ("naive, floored", LineRule::Naive { rounding: Rounding::Floor }),
            ];
            let stipple = profile.line.and_then(|line| line.stipple);
            changed.extend(rules.map(|(name, rule)| {
                let line = Some(LineConfig { rule, stipple });
                (format!("line.rule is {name}"), Profile { line, ..profile.clone() })
            }));
        }
        ShapeKind::Quad | ShapeKind::Clip => {
            changed.extend(neighbours(profile).into_iter().map(|n| (n.change, n.profile)));
        }
    }
    changed.retain(|(_, changed)| changed != profile);
    changed
}

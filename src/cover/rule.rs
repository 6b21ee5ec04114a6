//! Who owns a sample that lies on an edge. Spec clauses `C-2` and `C-3`.

#[cfg(feature = "verification")]
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A fill rule: exactly one of two triangles sharing an edge owns the samples on it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum FillRule {
    /// Left edges and horizontal top edges own their samples.
    TopLeft,
    /// The lectures' shadow rule: edges facing right own, facing left do not; on a tie, facing up
    /// owns. Facing is the direction of the outward normal, y down.
    Shadow,
}

impl FillRule {
    /// Both rules.
    pub const ALL: [Self; 2] = [Self::TopLeft, Self::Shadow];

    /// Whether an edge of a normalised triangle, travelling by `[dx, dy]`, owns its samples.
    ///
    /// ```
    /// use guardbit::cover::FillRule;
    /// assert!(FillRule::TopLeft.owns([0, -1]) && FillRule::TopLeft.owns([1, 0]));
    /// assert!(FillRule::Shadow.owns([0, 1]) && !FillRule::Shadow.owns([-1, 0]));
    /// ```
    pub const fn owns(self, [dx, dy]: [i128; 2]) -> bool {
        match self {
            Self::TopLeft => dy < 0 || (dy == 0 && dx > 0),
            Self::Shadow => dy > 0 || (dy == 0 && dx > 0),
        }
    }
}

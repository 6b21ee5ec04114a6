//! What the vertices of one triangle bring for channels, before any profile has seen it.

/// Values by name: each component at the three vertices.
pub type Named<T> = Vec<(String, Vec<[T; 3]>)>;

/// Values of three vertices by the name of their channel, one list a component, and w where it is given.
#[derive(Debug, Clone, PartialEq)]
pub enum Shading {
    /// Codes, beside `v`.
    Codes {
        /// By channel.
        channels: Named<i128>,
        /// Codes of 1/w.
        inverse_w: Option<[i128; 3]>,
    },
    /// Reals, beside `f`: the profile's `unit` is what 1 comes to.
    Reals {
        /// By channel.
        channels: Named<f64>,
        /// Distances from the eye, in any unit.
        w: Option<[f64; 3]>,
    },
}

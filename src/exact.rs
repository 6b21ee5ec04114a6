//! Exact results from rationals and big integers. This code shares nothing with the code that it checks.
//!
//! Coordinates of triangles are integers in sub-pixels, y down; a sample is a [`Point`] in the same
//! units, rational where it has to be. Nothing here normalises, orients, shifts or wraps: coverage
//! is decided by where a triangle's outline crosses a row, a plane by the areas opposite its
//! vertices, and a rounding by its two neighbours.
//!
//! ```
//! use guardbit::bits::Rounding;
//! use guardbit::exact::{Rule, covers, edge_x, plane_at, round};
//! // One sub-pixel bit: the centre of pixel (0, 0) is the lattice point (1, 1).
//! let triangle = [[1, 1], [2, 1], [1, 2]];
//! assert!(covers(triangle, [1, 1], Rule::TopLeft));
//! let x = edge_x([0, 1], [2, 13], 7).ok_or("horizontal")?;
//! assert_eq!(round(&x, Rounding::Floor), 1.into());
//! let z = plane_at([[0, 0], [4, 0], [0, 4]], [0, 10, 3], [1, 1]).ok_or("no area")?;
//! assert_eq!(round(&z, Rounding::NearestEven), 3.into()); // 13/4
//! # Ok::<(), &str>(())
//! ```

mod cover;
mod diamond;
mod edge;
mod number;
mod outline;
mod perspective;
mod plane;
mod round;
mod square;

pub use cover::{Position, Rule, classify, covered_row, covers};
pub use diamond::{Diamond, exits};
pub use edge::{Row, edge_value, edge_x, first_pixel};
pub use number::{Point, Rational, dyadic, integer, ratio};
pub use outline::Outline;
pub use perspective::perspective_at;
pub use plane::{PlaneNumerator, plane_at, plane_slopes, plane_word};
pub use round::{divide, round, round_dyadic};
pub use square::Square;

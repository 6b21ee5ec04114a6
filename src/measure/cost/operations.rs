//! How many arithmetic operations the model's formulas take. Spec clause `H-4`.

mod machine;

use crate::cover::FillRule;
use crate::format::Clamp;
use crate::profile::{Form, Profile};
use crate::setup::Division;
use crate::value::{DepthConfig, StartBias};
use serde::Serialize;
use std::ops::Add;

/// Operations by kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Count {
    /// Additions and subtractions.
    pub add: u64,
    /// Multiplications of two variables.
    pub multiply: u64,
    /// Divisions, reciprocals included.
    pub divide: u64,
    /// Comparisons and sign tests; a minimum or maximum of two is one.
    pub compare: u64,
}

impl Count {
    const fn new(add: u64, multiply: u64, divide: u64, compare: u64) -> Self {
        Self { add, multiply, divide, compare }
    }

    /// The same work `n` times over.
    #[must_use]
    pub const fn times(self, n: u64) -> Self {
        Self::new(self.add * n, self.multiply * n, self.divide * n, self.compare * n)
    }
}

impl Add for Count {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self::new(
            self.add + other.add,
            self.multiply + other.multiply,
            self.divide + other.divide,
            self.compare + other.compare,
        )
    }
}

/// Operations by how often they are done.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Operations {
    /// Once a triangle: set-up.
    pub triangle: Count,
    /// Once a row of the bounding box.
    pub row: Count,
    /// Once a tile or block tested as a whole.
    pub tile: Count,
    /// Once a run of covered samples: finding its depth.
    pub run: Count,
    /// Once a visited sample, covered or not. An edge walk visits none in vain.
    pub visit: Count,
    /// Once a covered sample.
    pub fragment: Count,
}

/// The sign of twice the area, and whether there is one: clause `T-3`.
const AREA: Count = Count::new(5, 2, 0, 2);
/// Lowest and highest of three, on one axis.
const EXTENT: Count = Count::new(0, 0, 0, 4);
/// Pixels of an interval, on one axis: both ends from the sample's offset, one past the last.
const PIXELS: Count = Count::new(3, 0, 0, 0);
/// An interval cut by the window: two ends between two bounds, and not reversed.
const CLIP: Count = Count::new(0, 0, 0, 5);
/// start + x dx + y dy.
const JUMP: Count = Count::new(2, 2, 0, 0);
/// One step of a DDA.
const STEP: Count = Count::new(1, 0, 0, 0);
/// A comparison.
const TEST: Count = Count::new(0, 0, 0, 1);

/// The operations of a valid profile.
pub(super) fn count(profile: &Profile) -> Operations {
    let mut operations = match profile.form {
        Form::EdgeFunction(edges) => match profile.traversal {
            None => edge_function(edges.rule),
            Some(_) => machine::traversed(edges.rule),
        },
        Form::EdgeWalk(_) | Form::Gouraud(_) => edge_walk(),
        Form::EnginePerPixel(edges) => machine::engine_per_pixel(edges.rule),
        Form::Barycentric(form) => machine::barycentric(form.edge.rule),
        Form::Tiles(form) => machine::tiles(form.edge.rule),
        Form::Homogeneous(form) => machine::homogeneous(form.rule),
        Form::Scanline(_) => machine::scanline(),
        // Their engines are hardware that is described, not a budget that is chosen.
        Form::Registers(_) => return Operations::default(),
    };
    let Some(depth) = profile.depth else { return operations };
    match profile.form {
        Form::Gouraud(_) => machine::walked_depth(&mut operations),
        Form::Barycentric(_) => machine::weighted_depth(&mut operations),
        Form::EnginePerPixel(_) => {
            // Every engine evaluates the plane, as part of the same tree.
            operations.triangle = operations.triangle + plane(&depth);
            operations.visit = operations.visit + STEP;
        }
        _ => {
            operations.triangle = operations.triangle + plane(&depth);
            // A sticky accumulator cannot jump: it walks to the run, however far that is.
            if depth.clamp != Clamp::Saturate {
                operations.run = JUMP;
            }
            operations.fragment = STEP;
        }
    }
    operations.fragment = operations.fragment + read_out(depth.clamp);
    operations
}

/// One edge function at the first sample, biased.
fn edge_setup(rule: FillRule) -> Count {
    let owns = match rule {
        // Both rules ask for the sign of dy, whether it is zero, and the sign of dx.
        FillRule::TopLeft | FillRule::Shadow => TEST.times(3),
    };
    let differences = Count::new(2, 0, 0, 0);
    let constant = Count::new(1, 2, 0, 0);
    let at_first_sample = Count::new(2, 2, 0, 0);
    let bias = Count::new(1, 0, 0, 0);
    differences + constant + at_first_sample + bias + owns
}

fn edge_function(rule: FillRule) -> Operations {
    let edge = edge_setup(rule) + JUMP;
    Operations {
        triangle: AREA + (EXTENT + PIXELS + CLIP).times(2) + TEST + edge.times(3),
        row: STEP.times(3),
        visit: (STEP + TEST).times(3),
        ..Operations::default()
    }
}

fn edge_walk() -> Operations {
    let direction = TEST;
    let differences = Count::new(2, 0, 0, 0);
    // The lower end is left out, so a subtraction before; none left is no edge.
    let rows = Count::new(1, 0, 0, 0) + PIXELS + TEST;
    let below_top = Count::new(2, 0, 0, 0);
    let start_and_slope = Count::new(1, 2, 2, 0);
    let edge = direction + differences + rows + below_top + start_and_slope;
    // Whether the edge crosses the row, its step, the sample's offset taken off.
    let side = TEST.times(2) + STEP + Count::new(1, 0, 0, 0);
    Operations {
        triangle: AREA + EXTENT + PIXELS + CLIP + edge.times(3),
        row: side.times(2) + CLIP + TEST,
        ..Operations::default()
    }
}

/// Clauses `P-1` to `P-4`.
fn plane(depth: &DepthConfig) -> Count {
    let gradient = Count::new(8, 4, 0, 0);
    let offset = Count::new(3, 2, 0, 0);
    let divided = match depth.division {
        // z0 A2 joins the dividend; start and two slopes are divided.
        Division::Quotient => Count::new(1, 1, 3, 0),
        // One reciprocal, three products, and z0 joins the first.
        Division::Reciprocal { .. } => Count::new(1, 3, 1, 0),
    };
    let bias = match (depth.start_bias, depth.interpolation) {
        (StartBias::Half, 1..) => Count::new(1, 0, 0, 0),
        _ => Count::default(),
    };
    gradient + offset + divided + bias
}

/// Clause `G-6`; a sticky accumulator is held at two ends instead (`G-5`).
fn read_out(clamp: Clamp) -> Count {
    match clamp {
        Clamp::Wrap => Count::default(),
        Clamp::Sign | Clamp::Saturate => TEST.times(2),
        Clamp::Guard | Clamp::Error => TEST.times(2) + Count::new(1, 0, 0, 0),
    }
}

//! The trait of a machine as a profile configures it: everything that the rest of the house asks a
//! machine. Nothing here has a default that would be wrong for a machine nobody knows yet: what a machine
//! does not say is "no" or "not stated", and is reported so.

use super::{Datapath, Form, Machine, RasterState, RegisterDevice, Site, Word, rounding_error};
use crate::bits::Rounding;
use crate::cover::{EdgeWordConfig, FillRule, SampleGrid};
use crate::exact::{PlaneNumerator, Rational, integer};
use crate::format::{Decision, ReadOut, Refused, Value};
use crate::setup::Triangle;
use crate::value::ChannelConfig;
use std::fmt::Display;

/// What is known of a machine before it is configured.
#[derive(Clone, Copy, Debug)]
pub struct Kind {
    /// The name that profiles use: lower case, words joined by `-`.
    pub name: &'static str,
    /// The name that a lecture or a paper knows it by.
    pub known_as: &'static str,
    /// The clause or document that says what it does.
    pub clause: &'static str,
    /// What it takes.
    pub intake: Intake,
    /// Whether it draws polygons of more than three vertices.
    pub polygons: Polygons,
    /// The decisions that a search may vary.
    pub decisions: &'static [Decision],
    /// The configuration that replaces another machine's: the same fill rule, and words of the same width
    /// where there are such words. `None` where a profile does not say enough to choose one.
    pub adopt: fn(&Form, &RasterState) -> Option<Form>,
}

/// What a machine takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Intake {
    /// Triangles of any profile, so that machines can be set beside each other on one scene.
    Triangles,
    /// The registers of one piece of hardware; triangles by way of its host alone.
    Registers,
}

/// Where a machine can evaluate channels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Carries {
    /// Nowhere.
    Nothing,
    /// Where it samples coverage, and nowhere else.
    AtItsSample,
    /// At any place of a pixel.
    Anywhere,
}

/// What a machine draws of a polygon with more than three vertices.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Polygons {
    /// Nothing.
    Refused,
    /// Its coverage. More than three points need not lie on one plane, so there is no depth.
    Coverage,
    /// Its coverage and depth.
    Depth,
}

/// A machine that a profile cannot have, and the table or key that says so.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{message}")]
pub struct FormError {
    /// The table or key, from the profile's root.
    pub field: Vec<&'static str>,
    /// The violated inequality, with its numbers and what to do.
    pub message: String,
}

impl FormError {
    /// A fault in a machine's own table: in `[form.NAME]`, or the key of it that `field` leads to.
    pub fn own(kind: &Kind, field: &[&'static str], message: impl Display) -> Self {
        let root = ["form", kind.name].into_iter();
        Self { field: root.chain(field.iter().copied()).collect(), message: message.to_string() }
    }
}

/// A change of one decision of a machine, or of its engine.
#[derive(Clone, Debug)]
pub struct Step<T = Form> {
    /// The decision, from the machine's table: `width`, `edge.rule`.
    pub field: String,
    /// What it is set to.
    pub got: String,
    /// What it was.
    pub was: String,
    /// The changed machine; it need not be valid.
    pub form: T,
}

/// A triangle on the profile's grid, for the bounds that machines state.
#[derive(Clone, Copy, Debug)]
pub struct Face<'a> {
    /// The triangle.
    pub triangle: &'a Triangle,
    /// The sample grid.
    pub grid: &'a SampleGrid,
    /// The pixels `[x0, y0, x1, y1]` whose samples it could cover, inside the window.
    pub bounds: [u32; 4],
}

/// Every value that is linear in the window and has such words: for bounds over a whole window.
#[derive(Clone, Debug)]
pub struct EveryLinear {
    /// Columns and rows of the window.
    pub window: [i128; 2],
    /// Lowest and highest vertex coordinates in sub-pixels of the window, each axis.
    pub vertices: [[i128; 2]; 2],
    /// Sub-pixel bits.
    pub sub_pixel: u32,
    /// The largest difference of the values of two vertices.
    pub rise: Rational,
    /// The largest change from a pixel to the next in its row.
    pub steepest: Rational,
    /// Rounding of what set-up makes.
    pub rounding: Rounding,
    /// Fraction bits of the accumulator.
    pub fraction: u32,
}

/// A machine as a profile configures it.
pub trait Rasterizer: std::fmt::Debug + Send + Sync {
    /// What is known of every machine of this kind.
    fn kind(&self) -> &'static Kind;

    /// Checks that the configuration is well-formed, and goes with the rest of a valid profile.
    ///
    /// # Errors
    /// [`FormError`] names the violated inequality and its place.
    fn check(&self, state: &RasterState) -> Result<(), FormError>;

    /// The machine, ready to draw.
    ///
    /// # Errors
    /// [`FormError`] as for [`Rasterizer::check`].
    fn build(&self, state: &RasterState, site: Site) -> Result<Box<dyn Machine>, FormError>;

    /// Who owns samples on an edge.
    fn rule(&self) -> FillRule;

    /// Whether coverage is exact by construction: words that hold every value, or none at all.
    fn covers_exactly(&self, state: &RasterState) -> bool;

    /// Whether depth is a plane walked on the sample grid; otherwise it is made of the machine's own means
    /// and has an error of its own.
    fn walks_a_plane(&self) -> bool;

    /// The words that a budget lists between those of the vertices and those of depth.
    fn words(&self, state: &RasterState) -> Vec<Word>;

    /// Units, set-up and operations; `None` for a machine whose cost is not estimated. Spec clause `H-1`.
    fn datapath(&self, state: &RasterState) -> Option<Datapath>;

    /// The bound of the depth error of a face in ULP, over all samples of its bounding box, under an exact
    /// division and the guard clamp; `None` if no bound is stated. `exact` is the plane that depth should be.
    fn depth_bound(
        &self,
        state: &RasterState,
        face: &Face<'_>,
        exact: &PlaneNumerator,
    ) -> Option<Rational>;

    /// The bound of the error of the accumulator of every such value, at every sample of the window that a triangle
    /// covers, under an exact division; `None` if no bound is stated. Spec clauses `B-5` and `CH-22`.
    fn window_bound(&self, value: &EveryLinear) -> Option<Rational> {
        let planes = self.walks_a_plane() && self.carries() != Carries::Nothing;
        planes.then(|| {
            integer(value.window[0] + value.window[1] - 1)
                * rounding_error(value.rounding, value.fraction)
        })
    }

    /// Whether the stated bound of coverage leaves room for the sample at this position, in sub-pixels, to
    /// be misplaced; `None` if no bound is stated.
    fn may_misplace(&self, face: &Face<'_>, at: [i128; 2]) -> Option<bool>;

    /// Every configuration one decision away, likeliest defects first: what `verify` tries when a dump
    /// disagrees. A machine that lists none is diagnosed by its depth and vertices alone.
    fn neighbours(&self) -> Vec<Step> {
        Vec::new()
    }

    /// What one of the kind's decisions is set to; `None` for a decision of another owner.
    fn decision(&self, name: &str) -> Option<Value>;

    /// Sets one of the kind's decisions.
    ///
    /// # Errors
    /// [`Refused`] for a decision of another owner, or a value that it does not take.
    fn decide(&mut self, name: &str, value: &Value, state: &RasterState) -> Result<(), Refused>;

    /// Three edge words that decide coverage, of a machine that has them.
    fn edge(&self) -> Option<&EdgeWordConfig> {
        None
    }

    /// The same, to be changed.
    fn edge_mut(&mut self) -> Option<&mut EdgeWordConfig> {
        None
    }

    /// The edge width that holds every edge value that the machine can meet; `None` without edge words, or
    /// where the rest of the profile is malformed.
    fn exact_edge_width(&self, _state: &RasterState) -> Option<u32> {
        None
    }

    /// Whether the machine evaluates the edge words at the samples of the bounding box and nowhere else,
    /// row by row or in the order of a `[traversal]`.
    fn visits_the_box(&self) -> bool {
        false
    }

    /// The side of a tile in pixels, of a machine that chooses tiles by tests at their corners before it
    /// evaluates edge words, by the clause `A-7`.
    fn tile(&self) -> Option<u32> {
        None
    }

    /// The walked x, of a machine that walks x down the edges by the clauses `K-1` to `K-5`.
    fn walk(&self) -> Option<&super::EdgeWalkConfig> {
        None
    }

    /// The same, to be changed.
    fn walk_mut(&mut self) -> Option<&mut super::EdgeWalkConfig> {
        None
    }

    /// Bits of W without its sign, of a machine that takes homogeneous vertices.
    fn w_bits(&self) -> Option<u32> {
        None
    }

    /// What draws, by name: the machine, or the engine behind registers.
    fn engine(&self) -> &'static str {
        self.kind().name
    }

    /// The device that a machine of registers asks for.
    fn register_device(&self) -> Option<RegisterDevice> {
        None
    }

    /// Where the machine can evaluate channels.
    fn carries(&self) -> Carries {
        Carries::Nothing
    }

    /// Checks the growth of a linear value of this format, whose vertex values have `scale` bits below the
    /// binary point. `channel` is its name.
    ///
    /// # Errors
    /// [`FormError`] names the violated inequality.
    fn check_carried(
        &self,
        _state: &RasterState,
        _channel: &str,
        _read: ReadOut,
        _scale: u32,
    ) -> Result<(), FormError> {
        Ok(())
    }

    /// The channels of a machine that begins at registers.
    fn channels(&self) -> &[ChannelConfig] {
        &[]
    }
}

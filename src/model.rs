//! A profile made ready: validated once, lane, processor level and machine picked once. The only
//! door for `eval`, vectors, rendering and bindings.

mod fill;
mod record;
mod walk;

pub use fill::Raster;
pub use record::{Drawing, Records, Span};
pub use walk::Walk;

use crate::cover::{Rect, SampleGrid, Segment};
use crate::dda::Processor;
use crate::machine::{
    DrawError, Input, Lines, Machine, Multisampled, Ports, Registers, Sink, Site, Target,
};
use crate::profile::{InvalidProfile, Profile};
use crate::scene;
use crate::setup::{ClipTriangle, Polygon, Triangle, VertexError};
use crate::value::Depth;

/// The version of the model: raised by any change of an emitted bit, and named in the CHANGELOG.
pub const MODEL_VERSION: u32 = 1;

/// A profile, ready to draw.
#[derive(Debug)]
pub struct Model {
    profile: Profile,
    clip: Rect,
    machine: Box<dyn Machine>,
    lines: Lines,
    depth: Option<Depth>,
    grid: SampleGrid,
    quick: Option<fill::Quick>,
}

/// What a caller may set beside the profile; nothing here changes the bits of a sample.
#[derive(Clone, Copy, Debug, Default)]
pub struct View {
    /// Window size instead of the profile's.
    pub window: Option<(u32, u32)>,
    /// Draw only here.
    pub scissor: Option<Rect>,
    /// Processor level; the best by default.
    pub processor: Processor,
}

/// Why a primitive was not drawn.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum PrimitiveError {
    /// A vertex lies outside its field.
    #[error(transparent)]
    Vertex(#[from] VertexError),
    /// The machine refused it.
    #[error(transparent)]
    Draw(#[from] DrawError),
}

impl Model {
    /// The model of a profile, in the profile's window.
    ///
    /// # Errors
    /// [`InvalidProfile`] names the violated inequality.
    pub fn new(profile: &Profile) -> Result<Self, InvalidProfile> {
        Self::with_view(profile, View::default())
    }

    /// The model of a profile, seen through `view`.
    ///
    /// # Errors
    /// [`InvalidProfile`] names the violated inequality.
    pub fn with_view(profile: &Profile, view: View) -> Result<Self, InvalidProfile> {
        let mut profile = profile.clone();
        if let Some((width, height)) = view.window {
            profile.window = crate::profile::WindowConfig { width, height };
        }
        profile.validate()?;
        let vertex = profile.vertex;
        let window = profile.window()?;
        let clip = view.scissor.map_or(window, |scissor| window.intersect(scissor));
        let target = Target { grid: profile.grid()?, clip };
        let processor = view.processor;
        let depth =
            profile.depth.map(|config| Depth::new(config, &vertex, processor)).transpose()?;
        let machine: Box<dyn Machine> = match profile.multisample {
            None => build(&profile, depth, target, processor)?,
            Some(config) => {
                let grids = config.grids(vertex.sub_pixel).into_iter();
                let samples =
                    grids.map(|grid| build(&profile, None, Target { grid, ..target }, processor));
                let samples = samples.collect::<Result<Vec<_>, _>>()?;
                Box::new(Multisampled::new(config, samples, depth, &vertex, target))
            }
        };
        let (line, point) = (profile.line.unwrap_or_default(), profile.point.unwrap_or_default());
        let lines = Lines::new(line, point, &vertex, target);
        let quick = fill::Quick::new(&profile, depth);
        Ok(Self { profile, clip, machine, lines, depth, grid: target.grid, quick })
    }

    /// The profile, with the window in force.
    pub fn profile(&self) -> &Profile {
        &self.profile
    }

    /// The pixels drawn to.
    pub fn clip(&self) -> Rect {
        self.clip
    }

    /// The machine's words.
    pub fn ports(&self) -> &Ports {
        self.machine.ports()
    }

    /// The depth evaluator, if the profile has depth.
    pub fn depth(&self) -> Option<&Depth> {
        self.depth.as_ref()
    }

    /// The viewport that scenes land in. Its largest depth is a number that the profile's source holds:
    /// a code of more than 24 bits would be rounded up to one beyond the range.
    pub fn viewport(&self) -> scene::Viewport {
        let depth_max = self.profile.depth_max();
        let beyond = match self.profile.vertex.source {
            crate::setup::Source::F32 => (u64::BITS - depth_max.leading_zeros()).saturating_sub(24),
            crate::setup::Source::F64 => (u64::BITS - depth_max.leading_zeros()).saturating_sub(53),
        };
        scene::Viewport {
            width: self.profile.window.width,
            height: self.profile.window.height,
            depth_max: depth_max >> beyond << beyond,
        }
    }

    /// Brings a scene's triangle to the profile's grid: integers are checked, reals are snapped.
    /// Depth is dropped where the profile has none.
    ///
    /// # Errors
    /// [`PrimitiveError`] for a vertex outside the field: never a wrap.
    pub fn snap(&self, triangle: &scene::Triangle) -> Result<Triangle, PrimitiveError> {
        let vertex = &self.profile.vertex;
        let depth_range = (0, i128::from(self.profile.depth_max()));
        let mut xy = [[0; 2]; 3];
        let mut depths = [0; 3];
        let has_depth = match triangle {
            scene::Triangle::Lattice { xy: from, z } => {
                for (n, point) in from.iter().enumerate() {
                    for (axis, value) in point.iter().enumerate() {
                        xy[n][axis] = vertex.accept(n, axis, *value)?;
                    }
                }
                let z = z.filter(|_| self.profile.depth.is_some());
                for (n, value) in z.iter().flatten().enumerate() {
                    depths[n] = in_depth(n, *value, depth_range)?;
                }
                z.is_some()
            }
            scene::Triangle::Real { xy: from, z } => {
                for (n, point) in from.iter().enumerate() {
                    for (axis, value) in point.iter().enumerate() {
                        xy[n][axis] =
                            vertex.snap((n, axis), *value, vertex.sub_pixel, vertex.range())?;
                    }
                }
                let z = z.filter(|_| self.profile.depth.is_some());
                for (n, value) in z.iter().flatten().enumerate() {
                    depths[n] = vertex.snap((n, 2), *value, 0, depth_range)?;
                }
                z.is_some()
            }
        };
        Ok(Triangle { xy, z: has_depth.then_some(depths) })
    }

    /// Draws a triangle of the profile's grid.
    ///
    /// # Errors
    /// [`DrawError`] if the profile refuses what happened.
    pub fn draw(&self, triangle: &Triangle, out: &mut dyn Sink) -> Result<(), DrawError> {
        self.machine.draw(&Input::Triangle(triangle), out)
    }

    /// Draws a triangle of homogeneous vertices, on a machine that takes them.
    ///
    /// # Errors
    /// [`DrawError`] if the machine does not, or refuses what happened.
    pub fn draw_clip(&self, triangle: &ClipTriangle, out: &mut dyn Sink) -> Result<(), DrawError> {
        self.machine.draw(&Input::Clip(triangle), out)
    }

    /// Integer coordinates in sub-pixels, snapped in their place where the profile's lattice is finer.
    ///
    /// # Errors
    /// [`PrimitiveError`] for a coordinate outside the field: never a wrap.
    pub fn accept(&self, points: &mut [[i128; 2]]) -> Result<(), PrimitiveError> {
        for (n, point) in points.iter_mut().enumerate() {
            for (axis, value) in point.iter_mut().enumerate() {
                *value = self.profile.vertex.accept(n, axis, *value)?;
            }
        }
        Ok(())
    }

    /// Draws a line by the profile's rule.
    ///
    /// # Errors
    /// None today; as the other primitives.
    pub fn draw_line(&self, line: &Segment, out: &mut dyn Sink) -> Result<(), DrawError> {
        self.lines.draw(&Input::Line(line), out)
    }

    /// Draws a point by the profile's rule.
    ///
    /// # Errors
    /// None today; as the other primitives.
    pub fn draw_point(&self, point: &[i128; 2], out: &mut dyn Sink) -> Result<(), DrawError> {
        self.lines.draw(&Input::Point(point), out)
    }

    /// The words of lines and points.
    pub fn line_ports(&self) -> &Ports {
        self.lines.ports()
    }

    /// The words of a machine that begins at registers.
    pub fn registers(&self) -> Option<&Registers> {
        self.ports().registers.as_ref()
    }

    /// The words that a host would write for a triangle, on a machine that begins at registers: one list
    /// or more, none for what is not drawn.
    pub fn host(&self, triangle: &Triangle) -> Vec<Vec<u32>> {
        self.machine.host(triangle)
    }

    /// Draws what registers say, on a machine that begins there: records go to [`Sink::record`].
    ///
    /// # Errors
    /// [`DrawError`] if the machine does not, or takes another number of words.
    pub fn draw_words(&self, words: &[u32], out: &mut dyn Sink) -> Result<(), DrawError> {
        self.machine.draw(&Input::Words(words), out)
    }

    /// Draws a polygon, on a machine that takes polygons.
    ///
    /// # Errors
    /// [`DrawError`] if the machine does not, or refuses what happened.
    pub fn draw_polygon(&self, polygon: &Polygon, out: &mut dyn Sink) -> Result<(), DrawError> {
        self.machine.draw(&Input::Polygon(polygon), out)
    }
}

/// The machine of a valid profile.
fn build(
    profile: &Profile,
    depth: Option<Depth>,
    target: Target,
    processor: Processor,
) -> Result<Box<dyn Machine>, InvalidProfile> {
    Ok(profile.form.build(&profile.state(), Site { depth, target, processor })?)
}

fn in_depth(vertex: usize, value: i128, (low, high): (i128, i128)) -> Result<i128, VertexError> {
    if (low..=high).contains(&value) {
        Ok(value)
    } else {
        Err(VertexError::Outside { form: 'v', vertex, axis: 2, value, low, high })
    }
}

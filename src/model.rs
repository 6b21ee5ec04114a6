//! A profile that is ready to draw: it is validated once, and lane, processor level and machine are
//! selected once. `eval`, vectors, rendering and bindings all draw through this module.

mod fill;
mod primitive;
mod quads;
mod record;
mod shading;
mod walk;

pub use fill::Raster;
pub use primitive::{Primitive, PrimitiveError};
pub use quads::{PixelDetail, QuadError};
pub use record::{Drawing, Records, Span};
pub use walk::Walk;

use crate::cover::{Rect, SampleGrid};
use crate::dda::Processor;
use crate::machine::{
    Channels, ComponentWords, DrawError, Input, Lines, Machine, Multisampled, Ports, Registers,
    Sink, Site, Target,
};
use crate::profile::{InvalidProfile, Profile};
use crate::scene;
use crate::setup::{Snapped, Triangle, VertexField, Viewport};
use crate::value::{Depth, ValueError, VertexValues};

/// The version of the model. Any change of an output bit raises it, and the CHANGELOG names the change.
pub const MODEL_VERSION: u32 = 2;

/// A profile, ready to draw.
#[derive(Debug)]
pub struct Model {
    profile: Profile,
    field: VertexField,
    clip: Rect,
    machine: Box<dyn Machine>,
    lines: Lines,
    depth: Option<Depth>,
    grid: SampleGrid,
    quick: Option<fill::Quick>,
    /// From clip space to the window.
    transform: Option<Viewport>,
    /// The channels, and the ports of the machine with theirs.
    channels: Option<(Channels, Ports)>,
}

/// Settings of a caller in addition to the profile. No setting changes the bits of a sample.
#[derive(Clone, Copy, Debug, Default)]
pub struct View {
    /// Window size; replaces the window of the profile.
    pub window: Option<(u32, u32)>,
    /// Draw only pixels in this rectangle.
    pub scissor: Option<Rect>,
    /// Processor level; by default the best level of this computer.
    pub processor: Processor,
}

impl Model {
    /// Makes the model of a profile, in the window of the profile.
    ///
    /// # Errors
    /// [`InvalidProfile`] names the violated inequality.
    pub fn new(profile: &Profile) -> Result<Self, InvalidProfile> {
        Self::with_view(profile, View::default())
    }

    /// Makes the model of a profile, with the settings of `view`.
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
        let target = Target { grid: profile.grid()?, clip, reach: profile.box_reach() };
        let processor = view.processor;
        let depth = profile.evaluator(processor)?;
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
        let channels = channels(&profile, &*machine, target.grid, processor)?;
        let field = VertexField::new(&vertex, profile.depth_max())?;
        let grid = target.grid;
        let size = (profile.window.width, profile.window.height);
        let transform = profile.viewport.map(|viewport| viewport.viewport(size)).transpose()?;
        Ok(Self { profile, field, clip, machine, lines, depth, grid, quick, transform, channels })
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
        self.channels.as_ref().map_or_else(|| self.machine.ports(), |(_, ports)| ports)
    }

    /// The channels of the profile; none where it has none.
    pub fn channels(&self) -> Option<&Channels> {
        self.channels.as_ref().map(|(channels, _)| channels)
    }

    /// Values of vertices for the channels of the profile, checked: by name of the channel, three vertices for
    /// each component, in codes; and codes of 1/w.
    ///
    /// # Errors
    /// [`ValueError`] names the channel, the vertex and the inequality.
    pub fn values(
        &self,
        given: &[(String, Vec<[i128; 3]>)],
        inverse_w: Option<[i128; 3]>,
    ) -> Result<VertexValues, ValueError> {
        VertexValues::check(&self.profile.channel, self.profile.w.as_ref(), given, inverse_w)
    }

    /// The same for codes in the order of the profile: channel, then component.
    ///
    /// # Errors
    /// As for [`Model::values`].
    pub fn values_in_order(
        &self,
        codes: &[[i128; 3]],
        inverse_w: Option<[i128; 3]>,
    ) -> Result<VertexValues, ValueError> {
        let mut codes = codes.iter().copied();
        let channels = self.profile.channel.iter().map(|channel| {
            (channel.name.clone(), codes.by_ref().take(channel.components.len()).collect())
        });
        self.values(&channels.collect::<Vec<_>>(), inverse_w)
    }

    /// The words behind the codes of channel `number` at a covered sample: [`Channels::words`].
    pub fn channel_words(
        &self,
        triangle: &Snapped<Triangle>,
        values: &VertexValues,
        number: usize,
        sample: ([u32; 2], Option<u32>),
    ) -> Option<Vec<ComponentWords>> {
        self.channels()?.words((&*self.machine, triangle), values, number, sample)
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

    /// Draws a primitive that this model made ready, by whichever machine draws its kind.
    ///
    /// # Errors
    /// [`DrawError`] if it was made for another vertex field, if the machine does not draw its kind,
    /// or if the profile refuses what happened.
    pub fn draw<'a>(
        &self,
        primitive: impl Into<Input<'a>>,
        out: &mut dyn Sink,
    ) -> Result<(), DrawError> {
        let input = primitive.into();
        self.check(input.field())?;
        if let Some(cull) = &self.profile.cull
            && let Ok(triangle) = input.triangle()
            && cull.culls(triangle, self.profile.vertex.sub_pixel)
        {
            out.culled();
            return Ok(());
        }
        match (input, &self.channels) {
            (Input::Triangle(triangle), Some((channels, _))) => {
                channels.draw(&*self.machine, triangle, None, out)
            }
            (Input::Shaded(triangle, values), Some((channels, _))) => {
                channels.draw(&*self.machine, triangle, Some(values), out)
            }
            (Input::Line(_) | Input::Point(_), _) => self.lines.draw(&input, out),
            _ => self.machine.draw(&input, out),
        }
    }

    /// Draws a primitive of our own making, which only its numbers can make the profile refuse: then
    /// nothing is drawn, and that is the answer. Returns whether it was drawn.
    pub(crate) fn draw_own<'a>(&self, primitive: impl Into<Input<'a>>, out: &mut dyn Sink) -> bool {
        match self.draw(primitive, out) {
            Ok(()) => true,
            Err(DrawError::GuardRange { .. } | DrawError::Range { .. }) => false,
            Err(error) => unreachable!("a primitive made for this model: {error}"),
        }
    }

    /// Refuses what was checked against another field.
    #[inline]
    fn check(&self, field: Option<&VertexField>) -> Result<(), DrawError> {
        match field {
            Some(got) if !self.field.takes(got) => {
                Err(DrawError::Foreign { need: self.field, got: *got })
            }
            _ => Ok(()),
        }
    }

    /// What coordinates of this model's primitives may be.
    pub fn field(&self) -> &VertexField {
        &self.field
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
}

/// The channels of a valid profile on its machine.
fn channels(
    profile: &Profile,
    machine: &dyn Machine,
    grid: SampleGrid,
    processor: Processor,
) -> Result<Option<(Channels, Ports)>, InvalidProfile> {
    if profile.channel.is_empty() {
        return Ok(None);
    }
    let carrier = machine.carrier().ok_or(InvalidProfile::NoChannels(profile.form.name()))?;
    let (w, vertex) = (profile.w.as_ref(), &profile.vertex);
    let means = (carrier, processor);
    let channels = Channels::new(&profile.channel, w, vertex, grid, profile.multisample, means);
    let channels = channels.map_err(Box::new)?;
    let mut ports = machine.ports().clone();
    ports.setup.extend_from_slice(channels.columns());
    ports.channels = channels.ports().to_vec();
    Ok(Some((channels, ports)))
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

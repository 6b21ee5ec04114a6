//! Profiles: the complete configuration of a rasterizer, composed of the configurations of other modules.
//! Spec clauses `F-4` and `F-5`; the file format is TOML with a published JSON schema.

mod builtin;
mod file;
mod form;
mod load;
mod neighbour;
mod samples;

pub use crate::machine::{Form, FormError, triangle_machines};
pub use builtin::{BUILTIN, builtin};
pub use file::{read_at_most, read_text_at_most};
pub use load::{ProfileError, load, parse};
pub use neighbour::{Neighbour, neighbours};

use crate::cover::{
    Degenerate, LineConfig, LineError, MultisampleConfig, MultisampleError, PointConfig,
    PointError, Rect, RectError, SampleConfig, SampleError, TraversalConfig,
};
use crate::format::ReadOutError;
use crate::machine::Carries;
use crate::setup::{CullConfig, VertexConfig, VertexError, ViewportConfig, ViewportError};
use crate::value::{
    AttributeConfig, AttributeError, Correction, DepthConfig, DepthError, EvaluatedAt,
    InverseWConfig, validate_channels,
};
#[cfg(feature = "verification")]
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The schema version this build reads and writes.
pub const SCHEMA: u32 = 1;

/// A rasterizer, described.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct Profile {
    /// Schema version, 1.
    pub schema: u32,
    /// Short name: letters, digits, `-`, `_` and `.`; vector folders are named after it.
    pub name: String,
    /// One sentence on what it models.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub about: String,
    /// Pixels drawn to.
    pub window: WindowConfig,
    /// The vertex field.
    pub vertex: VertexConfig,
    /// From clip space to the window; positions are refused when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub viewport: Option<ViewportConfig>,
    /// Triangles that are not drawn; all are when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cull: Option<CullConfig>,
    /// Sample position; pixel centres when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sample: Option<SampleConfig>,
    /// Several samples a pixel; one when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub multisample: Option<MultisampleConfig>,
    /// How a primitive becomes coverage.
    pub form: Form,
    /// The order in which samples are visited; the bounding box row by row when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub traversal: Option<TraversalConfig>,
    /// How lines are drawn; by Vulkan's diamond rule when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub line: Option<LineConfig>,
    /// How points are drawn; the pixel that holds them when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub point: Option<PointConfig>,
    /// The depth plane; no depth when absent.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub depth: Option<DepthConfig>,
    /// The words of 1/w, for channels that are corrected for perspective.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub w: Option<InverseWConfig>,
    /// What triangles carry beside depth; nothing when absent.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub channel: Vec<AttributeConfig>,
}

/// Window size in pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct WindowConfig {
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
}

/// A profile that fails validation.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum InvalidProfile {
    /// Another schema version.
    #[error("schema = {0}: this version of guardbit reads schema 1; write schema = 1")]
    Schema(u32),
    /// A name that cannot name a folder.
    #[error(
        "name = {0:?}: a name has 1 to 64 characters from a-z A-Z 0-9 - _ . and does not begin with a point or a hyphen"
    )]
    Name(String),
    /// The window.
    #[error(transparent)]
    Window(#[from] RectError),
    /// The vertex field.
    #[error(transparent)]
    Vertex(#[from] VertexError),
    /// The viewport.
    #[error(transparent)]
    Viewport(#[from] ViewportError),
    /// Triangles that are left out where all are measured.
    #[error(
        "[cull] leaves triangles out, and this command measures every triangle of a scene; leave [cull] out, or \
         use eval, render --show image, vectors, verify or trace"
    )]
    Culled,
    /// The sample position.
    #[error(transparent)]
    Sample(#[from] SampleError),
    /// The line rule.
    #[error(transparent)]
    Line(#[from] LineError),
    /// The point rule.
    #[error(transparent)]
    Point(#[from] PointError),
    /// Several samples a pixel.
    #[error(transparent)]
    Multisample(#[from] MultisampleError),
    /// Depth that is no plane cannot be taken at another place than the machine's own.
    #[error(
        "[multisample] needs a depth plane, but the machine {0} has none; choose another machine, or leave [multisample] out"
    )]
    MultisampleDepth(&'static str),
    /// The machine.
    #[error(transparent)]
    Form(#[from] FormError),
    /// A cost was asked for, and the machine states none.
    #[error(
        "the machine {0} has no cost model, so its units, set-up and operations cannot be estimated; choose \
         another machine"
    )]
    NoCost(&'static str),
    /// Squares where samples are asked about.
    #[error(
        "coverage is conservative, and this command holds coverage against the samples of clause C-2; leave the \
         table `conservative` out, or use render --show image, vectors, verify or prove"
    )]
    Squares,
    /// Samples between the sub-pixels on a machine that has no means for them.
    #[error(
        "the samples lie between the sub-pixels of the vertices, and {0}; place them on the grid of the \
         vertices, or {1}"
    )]
    BetweenSubPixels(String, &'static str),
    /// An order of visits for a machine that has its own.
    #[error(
        "[traversal] works only with [form.edge-function]; the machine {0} has a fixed order of visits; leave \
         [traversal] out"
    )]
    Traversal(&'static str),
    /// The depth plane.
    #[error(transparent)]
    Depth(#[from] DepthError),
    /// A channel, or the plane of 1/w.
    #[error(transparent)]
    Channel(#[from] Box<AttributeError>),
    /// 1/w of its own fault.
    #[error(transparent)]
    W(Box<AttributeError>),
    /// A machine that carries no channels.
    #[error(
        "the machine {0} has no means for [[channel]]; choose another machine, or leave the channels out"
    )]
    NoChannels(&'static str),
    /// Coordinates of a triangle that may have no area.
    #[error(
        "channel {0:?}: correction = \"barycentric\" divides by the area of the triangle, and degenerate = \"draw\" \
         draws triangles that have none; choose another correction, or write degenerate = \"cull\""
    )]
    NoCoordinates(String),
    /// A place that the machine does not evaluate.
    #[error(
        "channel {channel:?}: the machine {machine} evaluates channels at its own sample only: leave `at` and \
         [multisample] out, or choose another machine"
    )]
    ChannelAt {
        /// The channel.
        channel: String,
        /// The machine.
        machine: &'static str,
    },
}

impl InvalidProfile {
    /// The table or key the fault lies in, from the profile's root.
    pub fn field(&self) -> &[&'static str] {
        match self {
            Self::Schema(_) => &["schema"],
            Self::Name(_) => &["name"],
            Self::Window(_) => &["window"],
            Self::Vertex(_) => &["vertex"],
            Self::Viewport(error) => match error.key() {
                "width" => &["viewport", "width"],
                "height" => &["viewport", "height"],
                "x" => &["viewport", "x"],
                "y" => &["viewport", "y"],
                "near" => &["viewport", "near"],
                "far" => &["viewport", "far"],
                _ => &["viewport", "transform"],
            },
            Self::Culled => &["cull"],
            Self::Sample(error) => match error.key() {
                Some("x") => &["sample", "x"],
                Some("y") => &["sample", "y"],
                Some(_) => &["sample", "of"],
                None => &["sample"],
            },
            Self::BetweenSubPixels(..) => &["sample"],
            Self::Line(_) => &["line"],
            Self::Point(_) => &["point"],
            Self::Multisample(error) => match error.key() {
                Some("samples") => &["multisample", "samples"],
                Some("positions") => &["multisample", "positions"],
                Some("of") => &["multisample", "of"],
                Some(_) => &["multisample", "mask"],
                None => &["multisample"],
            },
            Self::MultisampleDepth(_) => &["multisample"],
            Self::Form(error) => &error.field,
            Self::NoCost(_) | Self::Squares => &["form"],
            Self::Traversal(_) => &["traversal"],
            Self::Depth(DepthError::ReadOut(ReadOutError::Integer { .. })) => &["depth", "integer"],
            Self::Depth(DepthError::ReadOut(ReadOutError::Width { .. })) => &["depth"],
            Self::Depth(DepthError::Division(_)) => &["depth", "division"],
            Self::Depth(DepthError::Growth { .. }) => &["depth", "interpolation"],
            Self::Depth(DepthError::Format(_)) => &["depth", "format"],
            Self::Depth(DepthError::Bias(error)) => match error.field() {
                "unit" => &["depth", "bias", "unit"],
                "constant" => &["depth", "bias", "constant"],
                "clamp" => &["depth", "bias", "clamp"],
                _ => &["depth", "bias", "slope"],
            },
            Self::W(_) => &["w"],
            Self::Channel(_)
            | Self::NoChannels(_)
            | Self::NoCoordinates(_)
            | Self::ChannelAt { .. } => &["channel"],
        }
    }
}

impl Profile {
    /// Checks every part, and the inequalities between the parts.
    ///
    /// # Errors
    /// [`InvalidProfile`] names the violated inequality with its numbers.
    pub fn validate(&self) -> Result<(), InvalidProfile> {
        if self.schema != SCHEMA {
            return Err(InvalidProfile::Schema(self.schema));
        }
        let legal = |c: char| c.is_ascii_alphanumeric() || matches!(c, '-' | '_' | '.');
        let name = &self.name;
        if !(1..=64).contains(&name.len())
            || !name.chars().all(legal)
            || name.starts_with(['.', '-'])
        {
            return Err(InvalidProfile::Name(name.clone()));
        }
        self.vertex.validate()?;
        self.window()?;
        self.check_samples()?;
        let size = (self.window.width, self.window.height);
        self.viewport.map(|viewport| viewport.viewport(size)).transpose()?;
        self.depth.map(|depth| depth.validate(&self.finest_vertex())).transpose()?;
        self.form.check(&self.state())?;
        if let Some(line) = &self.line {
            line.validate(self.vertex.difference_bits())?;
        }
        if let Some(point) = &self.point {
            point.validate()?;
        }
        if let Some(multisample) = &self.multisample {
            multisample.validate(self.vertex.sub_pixel, self.sample.is_some())?;
            if self.depth.is_some() && !self.form.walks_a_plane() {
                return Err(InvalidProfile::MultisampleDepth(self.form.name()));
            }
        }
        self.check_channels()?;
        if self.traversal.is_some() && !self.form.visits_the_box() {
            return Err(InvalidProfile::Traversal(self.form.name()));
        }
        Ok(())
    }

    /// Checks the channels, and that the machine carries them.
    fn check_channels(&self) -> Result<(), InvalidProfile> {
        if let Some(w) = &self.w {
            w.validate(&self.vertex).map_err(|error| InvalidProfile::W(Box::new(error)))?;
            if !self.channel.iter().any(|channel| channel.correction.needs_w()) {
                return Err(InvalidProfile::W(Box::new(AttributeError::UnusedW)));
            }
        }
        let formats = validate_channels(&self.channel, self.w.as_ref(), &self.finest_vertex());
        let formats = formats.map_err(Box::new)?;
        let machine = self.form.name();
        for (channel, read) in self.channel.iter().zip(formats) {
            match self.form.carries() {
                Carries::Nothing => return Err(InvalidProfile::NoChannels(machine)),
                Carries::AtItsSample
                    if channel.at != EvaluatedAt::Sample || self.multisample.is_some() =>
                {
                    return Err(InvalidProfile::ChannelAt {
                        channel: channel.name.clone(),
                        machine,
                    });
                }
                _ => {}
            }
            let draws_degenerate =
                self.conservative().is_some_and(|config| config.degenerate == Degenerate::Draw);
            if draws_degenerate && matches!(channel.correction, Correction::Barycentric { .. }) {
                return Err(InvalidProfile::NoCoordinates(channel.name.clone()));
            }
            let over = self.w.filter(|_| channel.correction.walks_w());
            let scale = over.map_or(0, |w| w.integer);
            self.form.check_carried(&self.state(), &channel.name, read, scale)?;
        }
        Ok(())
    }

    /// The window.
    ///
    /// # Errors
    /// [`RectError`] if a side is 0 or above 65536.
    pub fn window(&self) -> Result<Rect, RectError> {
        Rect::window(self.window.width, self.window.height)
    }

    /// The largest depth code, or 0 without depth.
    pub fn depth_max(&self) -> u64 {
        self.depth.map_or(0, |depth| u64::MAX >> 64u32.saturating_sub(depth.integer).min(63))
    }

    /// The profile as TOML, a fixed point of [`parse`].
    pub fn to_toml(&self) -> String {
        toml::to_string(self)
            .unwrap_or_else(|error| unreachable!("tables of strings and integers: {error}"))
    }
}

/// The JSON schema of profile files.
#[cfg(feature = "verification")]
pub fn schema() -> String {
    let schema = schemars::schema_for!(Profile);
    serde_json::to_string_pretty(&schema).unwrap_or_else(|error| unreachable!("{error}")) + "\n"
}

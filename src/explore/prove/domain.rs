//! What a question ranges over: a window, a box of vertices, a grid of samples. Spec clause `B-1`.

use crate::cover::{EdgeStorage, EdgeWordConfig, FillRule, Rect, SampleConfig, SampleGrid};
use crate::explore::corner::Area;
use crate::machine::EdgeFunctionConfig;
use crate::profile::{InvalidProfile, Profile, SCHEMA, WindowConfig};
use crate::setup::{Endless, Source, VertexConfig, VertexError};

/// A profile, and the window and vertex box that its words must serve.
#[derive(Clone, Debug)]
pub struct Question {
    /// The profile asked about, overrides included. Its window starts at (0, 0).
    pub profile: Profile,
    /// The column and row of the window's top left pixel in the question's own coordinates.
    pub origin: [i128; 2],
    /// Lowest and highest vertex coordinates in sub-pixels, per axis, both included.
    pub vertices: [[i128; 2]; 2],
    /// The largest w of a triangle is at most so many times its smallest.
    pub w_ratio: u32,
    grid: SampleGrid,
}

/// What may be asked instead of what the profile says.
#[derive(Clone, Copy, Debug, Default)]
pub struct Overrides {
    /// Window size in pixels.
    pub window: Option<(u32, u32)>,
    /// Vertices lie in the closed window, widened by this many pixels on each side.
    pub guard_band: Option<u32>,
    /// Sub-pixel bits of the vertex field.
    pub sub_pixel: Option<u32>,
    /// Depth bits.
    pub depth_bits: Option<u32>,
    /// How many times its smallest w the largest w of a triangle may be; [`W_RATIO`] when absent.
    pub w_ratio: Option<u32>,
}

/// The w ratio that is asked about when nothing else is.
pub const W_RATIO: u32 = 16;

/// A question that cannot be asked.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum QuestionError {
    /// The vertex field would outgrow its 32 bits.
    #[error(
        "{field} = {value}: integer + sub-pixel = {integer} + {sub_pixel} = {} > 32 bits of a \
         vertex field; the largest possible value is {nearest}", u64::from(*integer) + u64::from(*sub_pixel)
    )]
    Field {
        /// The override at fault.
        field: &'static str,
        /// What was asked for.
        value: u32,
        /// Integer bits that it takes.
        integer: u32,
        /// Sub-pixel bits.
        sub_pixel: u32,
        /// The nearest value that fits.
        nearest: u64,
    },
    /// The depth word cannot have so many bits.
    #[error("depth-bits = {value}: {source}; the nearest possible value is {nearest}")]
    Depth {
        /// What was asked for.
        value: u32,
        /// The violated inequality.
        source: Box<InvalidProfile>,
        /// The nearest width that the profile can have.
        nearest: u32,
    },
    /// There is no depth to widen.
    #[error("depth-bits = {0}: the profile has no [depth]")]
    NoDepth(u32),
    /// A window of a table row that is not from `low` to a greater `high`.
    #[error(
        "low = {low}, high = {high}: a window needs 1 <= high - low <= 65536 pixels and \
         -2^31 <= low, high < 2^31"
    )]
    Window {
        /// First column and row.
        low: i64,
        /// One past the last.
        high: i64,
    },
    /// A depth bias, which the bounds leave out.
    #[error(
        "[depth.bias]: the bounds are those of planes without a depth bias; leave [depth.bias] out. Edge and \
         interpolation bits are the same with it, but a biased depth can need more guard bits: \
         `guardbit fit` measures them"
    )]
    Bias,
    /// The profile fails validation.
    #[error(transparent)]
    Profile(#[from] InvalidProfile),
}

/// The fewest integer bits of a closed vertex field from `low` to `high` pixels, and whether it
/// has a sign.
fn field([low, high]: [i128; 2]) -> (u32, bool) {
    let reach = high.max(-low).max(1);
    // The least n with 2^n >= reach; a signed field reaches 2^(n-1).
    let bits = i128::BITS - (reach - 1).leading_zeros();
    if low < 0 { (bits + 1, true) } else { (bits.max(1), false) }
}

impl Question {
    /// What the profile itself promises, with overrides.
    ///
    /// # Errors
    /// [`QuestionError`] names the violated inequality and the nearest possible value.
    pub fn new(profile: &Profile, overrides: Overrides) -> Result<Self, QuestionError> {
        let mut profile = profile.clone();
        if let Some((width, height)) = overrides.window {
            profile.window = WindowConfig { width, height };
            profile.window().map_err(InvalidProfile::from)?;
        }
        if let Some(sub_pixel) = overrides.sub_pixel {
            set_sub_pixel(&mut profile, sub_pixel)?;
        }
        let mut within = None;
        if let Some(band) = overrides.guard_band {
            within = Some(set_guard_band(&mut profile, band)?);
        }
        if let Some(bits) = overrides.depth_bits {
            set_depth_bits(&mut profile, bits)?;
        }
        profile.validate()?;
        if profile.depth.is_some_and(|depth| depth.bias.is_some()) {
            return Err(QuestionError::Bias);
        }
        let (low, high) = profile.vertex.range();
        let vertices = within.unwrap_or([[low; 2], [high; 2]]);
        let grid = profile.whole_grid()?;
        let w_ratio = overrides.w_ratio.unwrap_or(W_RATIO).max(1);
        Ok(Self { profile, origin: [0; 2], vertices, w_ratio, grid })
    }

    /// A square window of columns and rows `low` to `high`, vertices in it or within a guard band
    /// of `band` pixels around it, `sub_pixel` bits, samples at centres, a top-left rule, an edge
    /// word of `width` bits and no depth.
    ///
    /// # Errors
    /// [`QuestionError`] names the violated inequality.
    pub fn square(
        (low, high): (i64, i64),
        band: u32,
        sub_pixel: u32,
        width: u32,
    ) -> Result<Self, QuestionError> {
        let side = u32::try_from(i128::from(high) - i128::from(low)).unwrap_or(0);
        let near = i32::try_from(low).is_ok() && i32::try_from(high).is_ok();
        if Rect::window(side, side).is_err() || !near {
            return Err(QuestionError::Window { low, high });
        }
        let (integer, signed) = field([0, i128::from(side)]);
        let vertex = VertexConfig {
            integer,
            sub_pixel,
            signed,
            closed: true,
            snap: crate::bits::Rounding::NearestEven,
            source: Source::F64,
            endless: Endless::Refuse,
            lattice: None,
        };
        let profile = Profile {
            schema: SCHEMA,
            name: "window".to_owned(),
            about: String::new(),
            window: WindowConfig { width: side, height: side },
            vertex,
            viewport: None,
            cull: None,
            sample: None,
            multisample: None,
            form: EdgeFunctionConfig(EdgeWordConfig {
                rule: FillRule::TopLeft,
                storage: EdgeStorage::Shifted,
                width,
                conservative: None,
            })
            .into(),
            traversal: None,
            line: None,
            point: None,
            depth: None,
            w: None,
            channel: Vec::new(),
        };
        let guard_band = Some(band);
        let mut question = Self::new(&profile, Overrides { guard_band, ..Overrides::default() })?;
        question.origin = [i128::from(low); 2];
        for end in &mut question.vertices {
            *end = end.map(|at| at + (i128::from(low) << sub_pixel));
        }
        Ok(question)
    }

    /// Sub-pixel bits.
    pub fn sub_pixel(&self) -> u32 {
        self.grid.sub_pixel
    }

    /// The first and last sample of the window, in sub-pixels.
    pub fn samples(&self) -> [[i128; 2]; 2] {
        let [w, h] = self.size();
        [[0, 0], [w - 1, h - 1]].map(|[x, y]| self.sample([self.origin[0] + x, self.origin[1] + y]))
    }

    /// The sample of a pixel, in the question's own coordinates.
    pub fn sample(&self, [x, y]: [i128; 2]) -> [i128; 2] {
        self.grid.position(x, y)
    }

    /// One line on window, grid and vertices.
    pub fn place(&self) -> String {
        let [w, h] = self.size();
        let s = self.sub_pixel();
        let from = match self.origin {
            [0, 0] => String::new(),
            [x, y] => format!(" from ({x}, {y})"),
        };
        let range = |axis: usize| {
            let [low, high] = self.vertices.map(|end| super::text::pixels(end[axis], s));
            format!("{low} to {high}")
        };
        let (x, y) = (range(0), range(1));
        let vertices = if x == y { x } else { format!("x {x}, y {y}") };
        let ratio = if self.profile.channel.iter().any(|channel| channel.correction.walks_w()) {
            format!(", w ratio at most {}", self.w_ratio)
        } else {
            String::new()
        };
        format!("window {w} x {h}{from}, s = {s}, vertices {vertices} pixels{ratio}")
    }

    /// The same question of a profile that carries nothing beside depth.
    pub(super) fn without_channels(&self) -> Self {
        let mut question = self.clone();
        question.profile.w = None;
        question.profile.channel.clear();
        question
    }

    /// The smallest code of 1/w of a vertex, of so many bits: the nearest vertex has the largest one (`CH-4`).
    pub(super) fn least_w(&self, bits: u32) -> i128 {
        (((1 << bits) - 1) / i128::from(self.w_ratio)).max(1)
    }

    pub(super) fn size(&self) -> [i128; 2] {
        [self.profile.window.width, self.profile.window.height].map(i128::from)
    }

    /// The fill rule; an edge walk owns as top-left does.
    pub(super) fn rule(&self) -> FillRule {
        self.profile.form.rule()
    }

    pub(super) fn vertex_area(&self) -> Area {
        Area { low: self.vertices[0], high: self.vertices[1] }
    }

    pub(super) fn sample_area(&self) -> Area {
        let [low, high] = self.samples();
        Area { low, high }
    }

    /// From the question's coordinates to the model's, whose window starts at (0, 0).
    pub(super) fn to_model(&self, [x, y]: [i128; 2]) -> [i128; 2] {
        let s = self.sub_pixel();
        [x - (self.origin[0] << s), y - (self.origin[1] << s)]
    }

    /// The same question with the vertex box wider by so many sub-pixels on each side.
    pub(super) fn widened(&self, by: i128) -> Area {
        let Area { low, high } = self.vertex_area();
        Area { low: low.map(|at| at - by), high: high.map(|at| at + by) }
    }
}

fn set_sub_pixel(profile: &mut Profile, sub_pixel: u32) -> Result<(), QuestionError> {
    let (integer, before) = (profile.vertex.integer, profile.vertex.sub_pixel);
    profile.vertex.sub_pixel = sub_pixel;
    if let Err(VertexError::Field { .. }) = profile.vertex.validate() {
        let nearest = u64::from(32_u32.saturating_sub(integer));
        let (field, value) = ("sub-pixel", sub_pixel);
        return Err(QuestionError::Field { field, value, integer, sub_pixel, nearest });
    }
    // A named sample keeps its place in the pixel; one that is not on the new grid is refused by
    // the profile's own check.
    if let Some(SampleConfig { x, y, of: None }) = profile.sample {
        let moved = |at: u32| (u64::from(at) << sub_pixel >> before, u64::from(at) << sub_pixel);
        let exact = [x, y].iter().all(|at| moved(*at).0 << before == moved(*at).1);
        let to = |at| if exact { u32::try_from(moved(at).0).unwrap_or(u32::MAX) } else { u32::MAX };
        profile.sample = Some(SampleConfig::sub_pixels(to(x), to(y)));
    }
    Ok(())
}

/// The smallest closed vertex field that holds the window and its guard band; returns the box.
fn set_guard_band(profile: &mut Profile, band: u32) -> Result<[[i128; 2]; 2], QuestionError> {
    let size = [profile.window.width, profile.window.height].map(i128::from);
    let (s, reach) = (profile.vertex.sub_pixel, i128::from(band));
    let longest = size[0].max(size[1]);
    let (integer, signed) = field([-reach, longest + reach]);
    if integer + s > 32 {
        // A signed field of 32 bits reaches 2^(31-s) pixels.
        let most = (1_i128 << 31_u32.saturating_sub(s)) - longest;
        let nearest = u64::try_from(most).unwrap_or(0);
        let (field, value) = ("guard-band", band);
        return Err(QuestionError::Field { field, value, integer, sub_pixel: s, nearest });
    }
    profile.vertex.integer = integer;
    profile.vertex.signed = signed;
    profile.vertex.closed = true;
    Ok([[-reach << s; 2], size.map(|side| (side + reach) << s)])
}

fn set_depth_bits(profile: &mut Profile, value: u32) -> Result<(), QuestionError> {
    let Some(depth) = &mut profile.depth else { return Err(QuestionError::NoDepth(value)) };
    let vertex = profile.vertex;
    depth.integer = value;
    if let Err(source) = depth.validate(&vertex) {
        let fits = |bits: &u32| {
            let mut narrower = *depth;
            narrower.integer = *bits;
            narrower.validate(&vertex).is_ok()
        };
        let nearest = (1..=value.min(64)).rev().find(fits).unwrap_or(1);
        let source = Box::new(InvalidProfile::from(source));
        return Err(QuestionError::Depth { value, source, nearest });
    }
    Ok(())
}

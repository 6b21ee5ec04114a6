//! `guardbit render`: a scene as a PNG.
#![allow(clippy::cast_precision_loss, reason = "colours need no more than a few digits")]

mod channel;

use super::Outcome;
use super::failure::Failure;
use super::heat::{self, BACKGROUND, Colour, LEGEND_LEAST, Scale, Seen};
use super::output::Output;
use super::pixels;
use super::sets;
use clap::ValueEnum;
use guardbit::bits::{Event, SpanEvents};
use guardbit::machine::Sink;
use guardbit::measure::error::{SampleError, Tally, triangle_error};
use guardbit::model::{Model, View};
use guardbit::profile;
use guardbit::setup::{Snapped, Triangle};
use std::path::PathBuf;

/// Draw a scene with a profile as PNG: image, depth, coverage, or error against the exact result.
#[derive(Debug, clap::Args)]
pub(crate) struct Arguments {
    /// The profile: a built-in name or a TOML file.
    #[arg(default_value = "sgi-4k")]
    profile: String,
    /// The scene: a built-in name, a mesh (OBJ, glTF, PLY, STL), or a JSON Lines file of triangles.
    #[arg(long, default_value = "knot")]
    scene: String,
    /// What the picture shows.
    #[arg(long, value_enum, default_value_t = Show::Image)]
    show: Show,
    /// The channel that --show channel and --show checker show, by default the first one; or the channel whose
    /// errors --show error shows, instead of those of depth.
    #[arg(long, value_name = "NAME")]
    channel: Option<String>,
    /// Squares of --show checker.
    #[arg(long, default_value_t = 8, value_parser = clap::value_parser!(u32).range(1..=4096))]
    squares: u32,
    /// The PNG file.
    #[arg(long, value_name = "FILE", default_value = "guardbit.png")]
    out: PathBuf,
    /// Window as WIDTHxHEIGHT; by default the window of the profile, but at most 1024 x 1024.
    #[arg(long, value_parser = super::parse_size)]
    window: Option<(u32, u32)>,
    /// Draw only the pixels with X0 <= x < X1 and Y0 <= y < Y1, given as X0,Y0,X1,Y1.
    #[arg(long, value_parser = super::parse_rect)]
    scissor: Option<guardbit::cover::Rect>,
    /// Size of one window pixel in pixels of the picture; by default, small windows are enlarged to
    /// about 256 pixels.
    #[arg(long, value_parser = clap::value_parser!(u32).range(1..=256))]
    zoom: Option<u32>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Show {
    /// The nearest surface, with shading from its depth gradient.
    Image,
    /// The nearest depth; near surfaces are bright.
    Depth,
    /// How often each sample is drawn: once is green, twice is yellow, more is closer to red.
    Coverage,
    /// The worst error of depth in each pixel, or of a channel with --channel, with the scale below the
    /// picture. A missing sample is white, an extra sample is magenta.
    Error,
    /// A channel of the nearest surface: one component is grey, others are red, green and blue.
    Channel,
    /// A checkerboard by the first two components of a channel: --squares on the way from code 0 to the unit.
    Checker,
}

/// Pixels of a picture, with the nearest depth of each.
struct Canvas {
    width: u32,
    colour: Vec<Colour>,
    depth: Vec<Option<u64>>,
    hits: Vec<u32>,
    seen: Vec<Seen>,
}

impl Canvas {
    fn at(&self, x: u32, y: u32) -> usize {
        (y as usize) * self.width as usize + x as usize
    }

    /// Notes how wrong a sample is, if nothing in its pixel is worse.
    fn wrong(&mut self, x: u32, y: u32, error: SampleError) {
        let (at, error) = (self.at(x, y), Seen::from(error));
        if error > self.seen[at] {
            self.seen[at] = error;
        }
    }

    /// Where the scale of its errors ends.
    fn scale(&self) -> Scale {
        Scale::of(self.seen.iter().filter_map(|seen| match seen {
            Seen::Error(ulp) => Some(*ulp),
            _ => None,
        }))
    }

    /// Counts a run of samples, and lists those that are nearer than what was drawn before: their number in
    /// the run and their place here.
    fn nearer(&mut self, y: u32, x0: u32, x1: u32, depth: &[u64]) -> Vec<(usize, usize)> {
        let mut seen = Vec::new();
        for (n, x) in (x0..x1).enumerate() {
            let at = self.at(x, y);
            self.hits[at] += 1;
            let near = depth.get(n).copied().unwrap_or(0);
            if self.depth[at].is_none_or(|before| near < before) {
                self.depth[at] = Some(near);
                seen.push((n, at));
            }
        }
        seen
    }
}

/// Draws one triangle into a canvas, nearest depth in front.
struct Brush<'a> {
    canvas: &'a mut Canvas,
    colour: Colour,
    wraps: u64,
}

impl Sink for Brush<'_> {
    fn span(&mut self, y: u32, x0: u32, x1: u32, depth: &[u64]) {
        for (_, at) in self.canvas.nearer(y, x0, x1, depth) {
            self.canvas.colour[at] = self.colour;
        }
    }

    fn wants_events(&self) -> bool {
        true
    }

    fn events(&mut self, events: &SpanEvents) {
        self.wraps += events.count(Event::Wrap);
    }
}

pub(crate) fn run(arguments: &Arguments) -> Result<Outcome, Failure> {
    let mut profile = profile::load(&arguments.profile)?;
    let window = &mut profile.window;
    (window.width, window.height) =
        arguments.window.unwrap_or((window.width.min(1024), window.height.min(1024)));
    // A picture has one depth a pixel; errors are those of its centre.
    if matches!(arguments.show, Show::Error | Show::Channel | Show::Checker) {
        profile.multisample = None;
    } else if let Some(multisample) = &mut profile.multisample {
        multisample.depth = guardbit::cover::DepthAt::Centre;
    }
    profile.validate().map_err(Failure::input)?;
    if arguments.show == Show::Error && profile.conservative().is_some() {
        // The error is that against samples.
        return Err(Failure::input(profile::InvalidProfile::Squares));
    }
    let (width, height) = (profile.window.width, profile.window.height);
    let zoom = arguments.zoom.unwrap_or_else(|| (256 / width.max(height)).max(1));
    if u64::from(width) * u64::from(height) * u64::from(zoom).pow(2) > 1 << 26 {
        let hint = "choose a smaller --window or --zoom";
        return Err(Failure::input("a picture has at most 2^26 pixels").hint(hint));
    }
    let view = View { scissor: arguments.scissor, ..View::default() };
    let model = Model::with_view(&profile, view).map_err(Failure::input)?;
    let paint = channel::Paint::new(&profile, arguments)?;
    let area = width as usize * height as usize;
    let mut canvas = Canvas {
        width,
        colour: vec![BACKGROUND; area],
        depth: vec![None; area],
        hits: vec![0; area],
        seen: vec![Seen::Nothing; area],
    };
    let scene = sets::snap_scene(&profile, &arguments.scene)?;
    let summary = match paint {
        Some(paint) => paint.draw(&model, &scene, &mut canvas)?,
        None if arguments.show == Show::Error => match &arguments.channel {
            None => draw_errors(&model, &scene.triangles, &mut canvas),
            Some(name) => {
                let channel = channel::find(&profile, Some(name))?;
                channel::draw_errors(&model, &arguments.scene, channel, &mut canvas)?
            }
        },
        None => draw(&model, &scene.triangles, &mut canvas),
    };
    colour(arguments.show, &mut canvas);
    // A picture too narrow for the marks has no legend; its scale stands in what is printed.
    let wide = width * zoom;
    let legend = match arguments.show {
        Show::Error if wide >= LEGEND_LEAST => heat::legend(canvas.scale(), wide as usize),
        _ => Vec::new(),
    };
    pixels::write(&arguments.out, (&canvas.colour, width), zoom, &legend)?;
    let scale = match arguments.show {
        Show::Error => format!("; {}", canvas.scale().words()),
        _ => String::new(),
    };
    let mut output = Output::new();
    output.line(format!(
        "{}: {} x {}, {} triangles of {}, {summary}{scale}",
        arguments.out.display(),
        width * zoom,
        height * zoom,
        scene.triangles.len(),
        scene.name
    ))?;
    output.flush()?;
    Ok(Outcome::Good)
}

fn draw(model: &Model, triangles: &[Snapped<Triangle>], canvas: &mut Canvas) -> String {
    let (mut wraps, mut refused) = (0, 0);
    for triangle in triangles {
        let colour = lit(model, triangle);
        let mut brush = Brush { canvas, colour, wraps: 0 };
        refused += u64::from(model.draw(triangle, &mut brush).is_err());
        wraps += brush.wraps;
    }
    let samples: u64 = canvas.hits.iter().map(|hits| u64::from(*hits)).sum();
    let refused =
        if refused > 0 { format!(", {refused} triangles refused") } else { String::new() };
    format!("{samples} samples, {wraps} wraps{refused}")
}

fn draw_errors(model: &Model, triangles: &[Snapped<Triangle>], canvas: &mut Canvas) -> String {
    let mut total = Tally::default();
    for triangle in triangles {
        let tally = triangle_error(model, triangle, |x, y, error| {
            canvas.wrong(x, y, error);
        });
        total.samples += tally.samples;
        total.missing += tally.missing;
        total.extra += tally.extra;
        total.worst = total.worst.max(tally.worst);
        total.sum += tally.sum;
    }
    format!(
        "{} samples, {} missing, {} extra, depth error worst {:.3} mean {:+.3} ULP",
        total.samples,
        total.missing,
        total.extra,
        total.worst,
        total.mean()
    )
}

/// A grey-blue by how much the triangle's depth gradient faces a light over the left shoulder.
fn lit(model: &Model, triangle: &Triangle) -> Colour {
    let [a, b, c] = triangle.xy.map(|vertex| vertex.map(|value| value as f64));
    let z = triangle.z.unwrap_or_default().map(|value| value as f64);
    let area = (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]);
    // Depth in the same units as x: the whole range is as deep as the window is wide.
    let profile = model.profile();
    let pixel = f64::from(1u32 << profile.vertex.sub_pixel.min(31));
    let deep = profile.depth_max().max(1) as f64 / (f64::from(profile.window.width) * pixel);
    let slope_x = ((z[1] - z[0]) * (c[1] - a[1]) - (z[2] - z[0]) * (b[1] - a[1])) / area / deep;
    let slope_y = ((z[2] - z[0]) * (b[0] - a[0]) - (z[1] - z[0]) * (c[0] - a[0])) / area / deep;
    // Window depth flattens far slopes; bring them out again.
    let (x, y) = (slope_x * 6.0, slope_y * 6.0);
    let facing = (1.0 + 0.5 * x + 0.7 * y) / ((x * x + y * y + 1.0).sqrt() * 1.32);
    // Half of the light comes from everywhere, so that no side drowns.
    let light = if facing.is_finite() { 0.5 + 0.5 * facing.clamp(-1.0, 1.0) } else { 0.5 };
    [[70.0, 150.0], [84.0, 150.0], [104.0, 145.0]]
        .map(|[dark, range]| part(dark * 0.6 + range * light))
}

/// A part of a colour; the clamp makes the conversion exact.
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to 0..=255")]
fn part(value: f64) -> u8 {
    value.clamp(0.0, 255.0) as u8
}

fn colour(show: Show, canvas: &mut Canvas) {
    match show {
        Show::Image | Show::Channel | Show::Checker => {}
        Show::Depth => {
            let seen = || canvas.depth.iter().flatten().copied();
            let (low, high) = (seen().min().unwrap_or(0), seen().max().unwrap_or(0));
            let range = (high - low).max(1) as f64;
            for (pixel, depth) in canvas.colour.iter_mut().zip(&canvas.depth) {
                if let Some(depth) = depth {
                    let far = (depth - low) as f64 / range;
                    *pixel = [part(255.0 - 225.0 * far); 3];
                }
            }
        }
        Show::Coverage => {
            for (pixel, hits) in canvas.colour.iter_mut().zip(&canvas.hits) {
                *pixel = match hits {
                    0 => BACKGROUND,
                    1 => [60, 160, 90],
                    2 => [225, 190, 60],
                    3 => [230, 140, 50],
                    _ => [215, 60, 50],
                };
            }
        }
        Show::Error => {
            let (scale, palette) = (canvas.scale(), heat::palette().collect::<Vec<_>>());
            for (pixel, seen) in canvas.colour.iter_mut().zip(&canvas.seen) {
                *pixel = palette[usize::from(scale.level(*seen))];
            }
        }
    }
}

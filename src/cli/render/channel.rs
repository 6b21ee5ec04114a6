//! A channel of the nearest surface as a picture.

use super::{Arguments, Canvas, Colour, Show, part};
use crate::cli::failure::Failure;
use crate::cli::sets::short_name;
use guardbit::machine::{Input, Sink};
use guardbit::model::Model;
use guardbit::profile::Profile;
use guardbit::scene;
use guardbit::value::AttributeConfig;

/// What is painted, and how.
pub(super) struct Paint {
    number: usize,
    config: AttributeConfig,
    /// Squares from code 0 to the unit, of a checkerboard.
    squares: Option<u32>,
}

impl Paint {
    /// What the arguments ask for; nothing where they ask for another picture.
    pub(super) fn new(profile: &Profile, arguments: &Arguments) -> Result<Option<Self>, Failure> {
        let squares = match arguments.show {
            Show::Channel => None,
            Show::Checker => Some(arguments.squares),
            _ => return Ok(None),
        };
        let known: Vec<&str> =
            profile.channel.iter().map(|channel| channel.name.as_str()).collect();
        if known.is_empty() {
            return Err(Failure::input(format!(
                "{}: the profile has no channels; describe one with [[channel]]",
                profile.name
            )));
        }
        let number = match &arguments.channel {
            None => 0,
            Some(name) => known.iter().position(|known| known == name).ok_or_else(|| {
                let known = known.join(", ");
                Failure::input(format!("--channel {name}: the channels of the profile are {known}"))
            })?,
        };
        let config = profile.channel[number].clone();
        if squares.is_some() && config.components.len() < 2 {
            return Err(Failure::input(format!(
                "--show checker takes a channel of two components or more, but {} has one",
                config.name
            )));
        }
        Ok(Some(Self { number, config, squares }))
    }

    /// Draws a scene; returns its name, the triangles drawn, and a summary.
    pub(super) fn draw(
        &self,
        model: &Model,
        source: &str,
        canvas: &mut Canvas,
    ) -> Result<(String, usize, String), Failure> {
        let scene = scene::load(source, &model.viewport())?;
        let (mut drawn, mut refused, mut first) = (0, 0u64, None);
        for (n, triangle) in scene.triangles.iter().enumerate() {
            // What the whole scene lacks is no matter of one triangle.
            let values = model
                .scene_values(&scene.attributes, n)
                .map_err(|error| Failure::input(format!("{source}: triangle {n}: {error}")))?;
            let placed = model.snap(triangle).map_err(|error| error.to_string());
            let done = placed.and_then(|placed| {
                let mut brush = Brush { paint: self, canvas, span: None };
                let input = Input::Shaded(&placed, &values);
                model.draw(input, &mut brush).map_err(|error| error.to_string())
            });
            match done {
                Ok(()) => drawn += 1,
                Err(error) => {
                    refused += 1;
                    first.get_or_insert_with(|| format!("triangle {n}: {error}"));
                }
            }
        }
        if let Some(first) = first {
            eprintln!(
                "note: {source}: {refused} triangles are left out; the first reason: {first}"
            );
        }
        let samples: u64 = canvas.hits.iter().map(|hits| u64::from(*hits)).sum();
        let (low, high) = self.config.range();
        let name = &self.config.name;
        let summary = format!("{samples} samples, channel {name}, codes {low} to {high}");
        Ok((short_name(source), drawn, summary))
    }

    /// The colour of one place.
    fn colour(&self, codes: &[i64]) -> Colour {
        let (low, high) = self.config.range();
        if let Some(squares) = self.squares {
            let unit = self.config.unit().max(1);
            let square = |code: i64| (i128::from(code) * i128::from(squares)).div_euclid(unit);
            let odd = (square(codes[0]) + square(codes[1])).rem_euclid(2) == 1;
            return if odd { [40, 44, 60] } else { [222, 214, 190] };
        }
        let share = |code: i64| {
            let whole = (high - low).max(1) as f64;
            part((i128::from(code) - low) as f64 / whole * 255.0 + 0.5)
        };
        match codes {
            [grey] => [share(*grey); 3],
            [red, green] => [share(*red), share(*green), 0],
            [red, green, blue, ..] => [share(*red), share(*green), share(*blue)],
            [] => [0; 3],
        }
    }
}

/// Paints one triangle into a canvas, nearest depth in front.
struct Brush<'a> {
    paint: &'a Paint,
    canvas: &'a mut Canvas,
    /// The places of the run that are nearest so far.
    span: Option<Vec<usize>>,
}

impl Sink for Brush<'_> {
    fn span(&mut self, y: u32, x0: u32, x1: u32, depth: &[u64]) {
        let mut seen = Vec::new();
        for (n, x) in (x0..x1).enumerate() {
            let at = self.canvas.at(x, y);
            self.canvas.hits[at] += 1;
            let near = depth.get(n).copied().unwrap_or(0);
            if self.canvas.depth[at].is_none_or(|before| near < before) {
                self.canvas.depth[at] = Some(near);
                seen.push(n);
            }
        }
        self.span = Some(seen);
    }

    fn channel(&mut self, channel: usize, y: u32, x0: u32, values: &[i64]) {
        if channel != self.paint.number {
            return;
        }
        let width = self.paint.config.components.len();
        for n in self.span.take().unwrap_or_default() {
            let x = x0 + u32::try_from(n).unwrap_or_default();
            let at = self.canvas.at(x, y);
            self.canvas.colour[at] = self.paint.colour(&values[n * width..][..width]);
        }
    }
}

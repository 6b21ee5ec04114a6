//! A channel of the nearest surface as a picture.

use super::{Arguments, Canvas, Colour, Show, part};
use crate::cli::failure::Failure;
use crate::cli::sets::SnappedScene;
use guardbit::machine::{Input, Sink};
use guardbit::measure::accuracy::{Inspector, Reference, Stage, Truth};
use guardbit::measure::error::{Tally, exact_rule};
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
        let number = find(profile, arguments.channel.as_deref())?;
        let config = profile.channel[number].clone();
        if squares.is_some() && config.components.len() < 2 {
            return Err(Failure::input(format!(
                "--show checker takes a channel of two components or more, but {} has one",
                config.name
            )));
        }
        Ok(Some(Self { number, config, squares }))
    }

    /// Draws a scene; returns a summary.
    pub(super) fn draw(
        &self,
        model: &Model,
        scene: &SnappedScene,
        canvas: &mut Canvas,
    ) -> Result<String, Failure> {
        let mut refused = 0u64;
        for (triangle, values) in scene.triangles.iter().zip(&scene.values(model)?) {
            let mut brush = Brush { paint: self, canvas, seen: Vec::new() };
            refused += u64::from(model.draw(Input::Shaded(triangle, values), &mut brush).is_err());
        }
        let samples: u64 = canvas.hits.iter().map(|hits| u64::from(*hits)).sum();
        let ((low, high), name) = (self.config.range(), &self.config.name);
        let refused =
            if refused > 0 { format!(", {refused} triangles refused") } else { String::new() };
        Ok(format!("{samples} samples, channel {name}, codes {low} to {high}{refused}"))
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

/// The number of the channel of a name; the first without a name.
pub(super) fn find(profile: &Profile, name: Option<&str>) -> Result<usize, Failure> {
    let known: Vec<&str> = profile.channel.iter().map(|channel| channel.name.as_str()).collect();
    if known.is_empty() {
        return Err(Failure::input(format!(
            "{}: the profile has no channels; describe one with [[channel]]",
            profile.name
        )));
    }
    let Some(name) = name else { return Ok(0) };
    known.iter().position(|known| *known == name).ok_or_else(|| {
        let known = known.join(", ");
        Failure::input(format!("--channel {name}: the channels of the profile are {known}"))
    })
}

/// The errors of a channel over a scene, against exact interpolation on the profile's grid.
pub(super) fn draw_errors(
    model: &Model,
    source: &str,
    channel: usize,
    canvas: &mut Canvas,
) -> Result<String, Failure> {
    let profile = model.profile();
    let reference = Reference::new(scene::load(source, &model.viewport())?, profile);
    let (grid, clip) = (profile.whole_grid().map_err(Failure::input)?, model.clip());
    let truth = Truth::new(&reference, &grid, clip, exact_rule(&profile.form));
    let stage = Stage::new(&reference, &truth, profile).map_err(Failure::input)?;
    let inspector = Inspector::new(&stage, profile).map_err(Failure::input)?;
    let mut total = Tally::default();
    for face in 0..stage.faces.len() {
        let measured = inspector.channel(face, channel, |x, y, error| {
            total.note(error);
            canvas.wrong(x, y, error);
        });
        if !measured {
            return Err(Failure::input(format!(
                "{source}: {} has no errors to show: the scene has no values for the channels of the \
                 profile, or a value has no code in them",
                profile.channel[channel].name
            )));
        }
    }
    Ok(format!(
        "{} samples, {} missing, {} extra, error of {} worst {:.3} mean {:.3} ULP",
        total.samples,
        total.missing,
        total.extra,
        profile.channel[channel].name,
        total.worst,
        total.mean()
    ))
}

/// Paints one triangle into a canvas, nearest depth in front.
struct Brush<'a> {
    paint: &'a Paint,
    canvas: &'a mut Canvas,
    /// The samples of the run that are nearest so far.
    seen: Vec<(usize, usize)>,
}

impl Sink for Brush<'_> {
    fn span(&mut self, y: u32, x0: u32, x1: u32, depth: &[u64]) {
        self.seen = self.canvas.nearer(y, x0, x1, depth);
    }

    fn channel(&mut self, channel: usize, _: u32, _: u32, components: &[Vec<i64>]) {
        if channel != self.paint.number {
            return;
        }
        for (n, at) in &self.seen {
            let codes: Vec<i64> = components.iter().map(|codes| codes[*n]).collect();
            self.canvas.colour[*at] = self.paint.colour(&codes);
        }
    }
}

//! Error maps: where on the scene a budget's arithmetic goes wrong.

use crate::cli::failure::Failure;
use crate::cli::render::{BACKGROUND, Colour, EXTRA_COLOUR, MISSING_COLOUR, heat};
use base64::Engine as _;
use guardbit::explore::metric::Metric;
use guardbit::explore::record::Record;
use guardbit::explore::space::Point;
use guardbit::explore::sweep::Sweep;
use guardbit::measure::accuracy::{Inspected, Inspector, Stage};
use guardbit::measure::error::SampleError;
use guardbit::profile::Profile;

/// The longer side of a map, in picture pixels, where there is one scene. More share its area.
const SIDE: f64 = 384.0;
/// Colours of the scale; few enough that a map packs well, more than an eye tells apart.
const LEVELS: u8 = 64;
/// Octaves of the scale below the most accurate budget's worst error.
const BELOW: f64 = 16.0;

/// What a picture pixel shows: the worst of its samples, by this order.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
enum Seen {
    Nothing,
    /// A depth error's size in ULP.
    Depth(f64),
    Extra,
    Missing,
}

/// One scene through one budget.
#[derive(Debug)]
pub(super) struct Map {
    /// The budget's number.
    pub(super) index: u64,
    /// The scene's name.
    pub(super) scene: String,
    /// Picture size in picture pixels.
    pub(super) size: [u32; 2],
    /// Pixels that a picture pixel stands for, on a side.
    pub(super) block: u32,
    /// Largest depth error in ULP.
    pub(super) worst: f64,
    /// Missing and extra samples.
    pub(super) wrong: [u64; 2],
    seen: Vec<Seen>,
}

/// The colours' meaning, the same for all maps of a page.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Scale {
    low: f64,
    high: f64,
}

/// The budgets to map: so many of the front, evenly spread over it by its first objective.
pub(super) fn chosen<'a>(
    records: &'a [Record],
    objectives: &[Metric],
    count: usize,
) -> Vec<&'a Record> {
    let weight = |record: &Record| objectives.first().and_then(|m| m.of(record)).unwrap_or(0.0);
    let mut front: Vec<&Record> = records.iter().filter(|record| record.pareto).collect();
    front.sort_by(|a, b| weight(a).total_cmp(&weight(b)).then(a.index.cmp(&b.index)));
    let count = count.min(front.len());
    let at = |n: usize| match count {
        // One alone stands in the middle; more of them hold both ends.
        1 => (front.len() - 1) / 2,
        _ => n * (front.len() - 1) / (count - 1),
    };
    (0..count).map(|n| front[at(n)]).collect()
}

/// All maps of one budget.
pub(super) fn draw(sweep: &Sweep, index: u64) -> Result<Vec<Map>, Failure> {
    let Ok(Point::Budget(profile)) = sweep.space.point(index) else { return Ok(Vec::new()) };
    let stages = sweep.stages(&profile).map_err(Failure::input)?;
    #[allow(clippy::cast_precision_loss, reason = "a handful of scenes")]
    let side = SIDE / (stages.len() as f64).sqrt();
    let scenes = stages.iter().zip(&sweep.scenes);
    scenes.map(|(stage, scene)| one(stage, &profile, index, &scene.name, side)).collect()
}

fn one(
    stage: &Stage,
    profile: &Profile,
    index: u64,
    scene: &str,
    side: f64,
) -> Result<Map, Failure> {
    let window = [profile.window.width, profile.window.height];
    let longer = window[0].max(window[1]);
    let block = (1..=longer).find(|block| f64::from(longer.div_ceil(*block)) <= side).unwrap_or(1);
    let size = window.map(|pixels| pixels.div_ceil(block));
    let mut map = Map {
        index,
        scene: scene.to_owned(),
        size,
        block,
        worst: 0.0,
        wrong: [0; 2],
        seen: vec![Seen::Nothing; size[0] as usize * size[1] as usize],
    };
    let inspector = Inspector::new(stage, profile).map_err(Failure::input)?;
    for face in &stage.faces {
        inspector.face(face, Inspected::Depth, |x, y, error| {
            let seen = match error {
                SampleError::Depth(ulp) => {
                    map.worst = map.worst.max(ulp.abs());
                    Seen::Depth(ulp.abs())
                }
                SampleError::Missing => {
                    map.wrong[0] += 1;
                    Seen::Missing
                }
                SampleError::Extra => {
                    map.wrong[1] += 1;
                    Seen::Extra
                }
            };
            let at = (y / block) as usize * size[0] as usize + (x / block) as usize;
            if seen > map.seen[at] {
                map.seen[at] = seen;
            }
        });
    }
    Ok(map)
}

impl Scale {
    /// A scale that tells the errors of all maps apart; `None` where there is no depth error.
    ///
    /// It is logarithmic, because a bit halves the error: on one linear scale the better half of
    /// the budgets would all be the same blue.
    pub(super) fn new(maps: &[Map]) -> Option<Self> {
        let worst = || maps.iter().map(|map| map.worst).filter(|worst| *worst > 0.0);
        let high = worst().reduce(f64::max)?;
        Some(Self { low: worst().fold(high, f64::min) / BELOW, high })
    }

    /// The error at a part of the scale, from 0 to 1.
    pub(super) fn error(self, part: f64) -> f64 {
        self.low * (self.high / self.low).powf(part)
    }

    /// The part of the scale that an error is at.
    fn part(self, error: f64) -> f64 {
        ((error / self.low).ln() / (self.high / self.low).ln()).clamp(0.0, 1.0)
    }
}

/// The colours of the scale, in order.
pub(super) fn colours() -> impl Iterator<Item = Colour> {
    (0..LEVELS).map(|level| heat(f64::from(level) / f64::from(LEVELS - 1)))
}

impl Map {
    /// The picture as a data URI.
    pub(super) fn uri(&self, scale: Option<Scale>) -> Result<String, Failure> {
        let level = |ulp: f64| {
            let part = scale.map_or(0.0, |scale| scale.part(ulp));
            #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a level")]
            let level = (part * f64::from(LEVELS - 1)).round() as u8;
            level
        };
        let pixels: Vec<u8> = self
            .seen
            .iter()
            .map(|seen| match seen {
                Seen::Depth(ulp) => level(*ulp),
                Seen::Nothing => LEVELS,
                Seen::Missing => LEVELS + 1,
                Seen::Extra => LEVELS + 2,
            })
            .collect();
        let palette: Vec<u8> =
            colours().chain([BACKGROUND, MISSING_COLOUR, EXTRA_COLOUR]).flatten().collect();
        let mut file = Vec::new();
        let mut encoder = png::Encoder::new(&mut file, self.size[0], self.size[1]);
        encoder.set_color(png::ColorType::Indexed);
        encoder.set_palette(palette);
        encoder.set_compression(png::Compression::High);
        encoder
            .write_header()
            .and_then(|mut writer| {
                writer.write_image_data(&pixels)?;
                writer.finish()
            })
            .map_err(Failure::input)?;
        let text = base64::engine::general_purpose::STANDARD.encode(file);
        Ok(format!("data:image/png;base64,{text}"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn map(worst: f64) -> Map {
        let (scene, seen) = (String::new(), vec![Seen::Nothing]);
        Map { index: 0, scene, size: [1, 1], block: 1, worst, wrong: [0; 2], seen }
    }

    #[test]
    fn the_scale_holds_every_worst_error() {
        assert_eq!(Scale::new(&[map(0.0)]), None);
        let scale = Scale::new(&[map(0.0), map(2.0), map(64.0)]).unwrap();
        assert_eq!((scale.low, scale.high), (0.125, 64.0));
        for (error, part) in [(0.0, 0.0), (0.125, 0.0), (1.0, 1.0 / 3.0), (64.0, 1.0)] {
            assert!((scale.part(error) - part).abs() < 1e-12, "{error}");
        }
        assert!((scale.error(1.0 / 3.0) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn worse_wins_a_pixel() {
        let order = [Seen::Nothing, Seen::Depth(0.0), Seen::Depth(1.5), Seen::Extra, Seen::Missing];
        assert!(order.windows(2).all(|pair| pair[0] < pair[1]));
    }
}

//! Error maps: where on the scene a budget's arithmetic goes wrong.

use crate::cli::failure::Failure;
use crate::cli::render::{BACKGROUND, Colour, EXTRA_COLOUR, MISSING_COLOUR};
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
/// From a map's worst error down to where its scale begins: six octaves.
const BELOW: f64 = 64.0;
/// Blue to red, of about even lightness, so that white and magenta stand out everywhere.
const HEAT: [Colour; 5] =
    [[44, 84, 190], [38, 156, 178], [132, 186, 92], [236, 168, 60], [206, 44, 40]];

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
pub(crate) struct Map {
    /// The budget's number.
    pub(crate) index: u64,
    /// The scene's name.
    pub(crate) scene: String,
    /// Picture size in picture pixels.
    pub(crate) size: [u32; 2],
    /// Pixels that a picture pixel stands for, on a side.
    pub(crate) block: u32,
    /// Largest depth error in ULP.
    pub(crate) worst: f64,
    /// Missing and extra samples.
    pub(crate) wrong: [u64; 2],
    seen: Vec<Seen>,
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
    scenes.map(|(stage, scene)| Map::draw(stage, &profile, index, &scene.name, side)).collect()
}

/// The colours of the scale, in order.
pub(super) fn colours() -> impl Iterator<Item = Colour> {
    let last = usize::from(LEVELS) - 1;
    (0..=last).map(move |level| {
        let at = level * (HEAT.len() - 1);
        let (below, part) = (at / last, at % last);
        let above = (below + 1).min(HEAT.len() - 1);
        std::array::from_fn(|channel| {
            let [from, to] = [below, above].map(|n| usize::from(HEAT[n][channel]));
            u8::try_from((from * (last - part) + to * part) / last).unwrap_or(u8::MAX)
        })
    })
}

impl Map {
    /// Draws one; `side` is the longest that its sides may be, in picture pixels.
    pub(crate) fn draw(
        stage: &Stage,
        profile: &Profile,
        index: u64,
        scene: &str,
        side: f64,
    ) -> Result<Self, Failure> {
        let window = [profile.window.width, profile.window.height];
        let longer = window[0].max(window[1]);
        let block =
            (1..=longer).find(|block| f64::from(longer.div_ceil(*block)) <= side).unwrap_or(1);
        let size = window.map(|pixels| pixels.div_ceil(block));
        let mut map = Self {
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

    /// The error at a part of the scale, from 0 to 1.
    ///
    /// Each map has a scale of its own, which ends at its worst error: it shows where the errors
    /// are, and its numbers say how large. It is logarithmic, because one sliver that is worse than
    /// all the rest would leave nothing but blue on a linear one.
    pub(super) fn error(&self, part: f64) -> f64 {
        self.worst * BELOW.powf(part - 1.0)
    }

    /// The part of the scale that an error is at.
    fn part(&self, error: f64) -> f64 {
        let part = 1.0 + (error / self.worst).ln() / BELOW.ln();
        if part.is_nan() { 0.0 } else { part.clamp(0.0, 1.0) }
    }

    /// The picture as a data URI.
    pub(crate) fn uri(&self) -> Result<String, Failure> {
        let last = LEVELS - 1;
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "few levels")]
        let level = |ulp: f64| (self.part(ulp) * f64::from(last)).round() as u8;
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
        data_uri(self.size, &pixels, palette)
    }
}

/// An indexed picture as the data URI of a PNG.
pub(crate) fn data_uri(size: [u32; 2], pixels: &[u8], palette: Vec<u8>) -> Result<String, Failure> {
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, size[0], size[1]);
    encoder.set_color(png::ColorType::Indexed);
    encoder.set_palette(palette);
    encoder.set_compression(png::Compression::High);
    encoder
        .write_header()
        .and_then(|mut writer| {
            writer.write_image_data(pixels)?;
            writer.finish()
        })
        .map_err(Failure::input)?;
    let text = base64::engine::general_purpose::STANDARD.encode(file);
    Ok(format!("data:image/png;base64,{text}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn map(worst: f64) -> Map {
        let (scene, seen) = (String::new(), vec![Seen::Nothing]);
        Map { index: 0, scene, size: [1, 1], block: 1, worst, wrong: [0; 2], seen }
    }

    #[test]
    fn a_scale_ends_at_the_worst_error() {
        let some = map(64.0);
        for (error, part) in [(0.0, 0.0), (0.5, 0.0), (1.0, 0.0), (8.0, 0.5), (64.0, 1.0)] {
            assert!((some.part(error) - part).abs() < 1e-12, "{error}");
        }
        assert!((some.error(0.5) - 8.0).abs() < 1e-12);
        assert_eq!(map(0.0).part(0.0).to_bits(), 0, "without an error all is blue");
        let colours: Vec<Colour> = colours().collect();
        assert_eq!((colours[0], colours[63], colours.len()), (HEAT[0], HEAT[4], 64));
    }

    #[test]
    fn worse_wins_a_pixel() {
        let order = [Seen::Nothing, Seen::Depth(0.0), Seen::Depth(1.5), Seen::Extra, Seen::Missing];
        assert!(order.windows(2).all(|pair| pair[0] < pair[1]));
    }
}

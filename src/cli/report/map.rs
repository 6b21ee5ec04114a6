//! Error maps: where on the scene a budget's arithmetic goes wrong.

use crate::cli::failure::Failure;
use crate::cli::heat::{self, Scale, Seen};
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
                match error {
                    SampleError::Depth(ulp) => map.worst = map.worst.max(ulp.abs()),
                    SampleError::Missing => map.wrong[0] += 1,
                    SampleError::Extra => map.wrong[1] += 1,
                }
                let seen = Seen::from(error);
                let at = (y / block) as usize * size[0] as usize + (x / block) as usize;
                if seen > map.seen[at] {
                    map.seen[at] = seen;
                }
            });
        }
        Ok(map)
    }

    /// The picture as a data URI.
    pub(crate) fn uri(&self, scale: Scale) -> Result<String, Failure> {
        let pixels: Vec<u8> = self.seen.iter().map(|seen| scale.level(*seen)).collect();
        data_uri(self.size, &pixels, heat::palette().flatten().collect())
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

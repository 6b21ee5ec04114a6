//! How far apart neighbouring depth codes lie, over the distance from the eye, and which surfaces of a
//! scene come to one code. Spec clauses `Z-8` and `Z-9`.
#![allow(clippy::cast_precision_loss, reason = "resolutions are reported as real numbers")]

use crate::bits::Rounding;
use crate::measure::accuracy::Stage;
use crate::scene::Lens;
use crate::value::DepthFormat;
use serde::Serialize;

/// A format at one distance.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Step {
    /// Distance from the eye.
    pub distance: f64,
    /// The nearest code there.
    pub code: u64,
    /// From it to the next code, in distance.
    pub step: f64,
    /// Part of all codes that stand for something nearer, in percent.
    pub codes_nearer: f64,
}

/// A format between two planes.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FormatRow {
    /// The format.
    pub format: &'static str,
    /// Bits of a code.
    pub bits: u32,
    /// Whether larger codes are nearer.
    pub reversed: bool,
    /// Mean step over the distances, as a ratio to even steps.
    pub mean_step: f64,
    /// Distance at which a step reaches a thousandth of the range; absent if it never does.
    pub coarse_from: Option<f64>,
    /// Steps at a few distances.
    pub steps: Vec<Step>,
    /// Neighbours in depth on the scene that come to one code; absent without a scene.
    pub ties: Option<u64>,
}

/// Distances and codes of a format between the planes of a lens.
#[derive(Clone, Copy, Debug)]
pub struct Scale {
    format: DepthFormat,
    lens: Lens,
}

/// A part of [0, 1] as a fraction of this many.
const WHOLE: i128 = 1 << 53;

impl Scale {
    /// A format seen through a lens, whose ratio it ought to have.
    pub const fn new(format: DepthFormat, lens: Lens) -> Self {
        Self { format, lens }
    }

    /// The stored quantity at a distance, in [0, 1].
    fn quantity(&self, distance: f64) -> f64 {
        let Lens { near, far } = self.lens;
        let plain = far * (distance - near) / (distance * (far - near));
        match self.format {
            DepthFormat::ZOverW { .. } => plain,
            DepthFormat::InverseZ { .. } | DepthFormat::FloatFarZero { .. } => {
                near * (far - distance) / (distance * (far - near))
            }
            DepthFormat::OneOverW { .. } => near / distance,
            DepthFormat::ObjectZ { .. } | DepthFormat::FloatNearZero { .. } => {
                (distance - near) / (far - near)
            }
        }
    }

    /// The distance of a stored quantity.
    fn distance(&self, quantity: f64) -> f64 {
        let Lens { near, far } = self.lens;
        match self.format {
            DepthFormat::ZOverW { .. } => self.lens.distance(quantity),
            DepthFormat::InverseZ { .. } | DepthFormat::FloatFarZero { .. } => {
                near * far / (near + quantity * (far - near))
            }
            DepthFormat::OneOverW { .. } => near / quantity,
            DepthFormat::ObjectZ { .. } | DepthFormat::FloatNearZero { .. } => {
                near + quantity * (far - near)
            }
        }
    }

    /// The code at a distance between the planes.
    pub fn code(&self, distance: f64) -> u64 {
        let quantity = self.quantity(distance).clamp(0.0, 1.0);
        #[allow(clippy::cast_possible_truncation, reason = "at most 2^53")]
        let part = (quantity * WHOLE as f64) as i128;
        self.format.encode((part, WHOLE), Rounding::Floor)
    }

    /// The distance that a code stands for.
    pub fn of_code(&self, code: u64) -> f64 {
        let (numerator, denominator) = self.format.decode(code);
        self.distance(numerator as f64 / denominator as f64)
    }

    /// What the codes are at a distance.
    pub fn step(&self, distance: f64) -> Step {
        let code = self.code(distance).min(self.format.maximum() - 1);
        let step = (self.of_code(code + 1) - self.of_code(code)).abs();
        let all = self.format.maximum() as f64 + 1.0;
        let nearer = if self.format.is_reversed() { all - 1.0 - code as f64 } else { code as f64 };
        Step { distance, code, step, codes_nearer: 100.0 * nearer / all }
    }

    /// Mean step over the distances between the planes, over that of as many even steps.
    pub fn mean_step(&self) -> f64 {
        const SAMPLES: u32 = 20_000;
        let Lens { near, far } = self.lens;
        let range = far - near;
        let sum: f64 = (0..SAMPLES)
            .map(|n| {
                let at = near + range * (f64::from(n) + 0.5) / f64::from(SAMPLES);
                self.step(at).step
            })
            .sum();
        sum / f64::from(SAMPLES) * self.format.maximum() as f64 / range
    }

    /// The smallest distance from which a step is at least `size`, by bisection; `None` where steps
    /// stay smaller, or are that large everywhere.
    pub fn reaches(&self, size: f64) -> Option<f64> {
        let Lens { near, far } = self.lens;
        let large = |distance: f64| self.step(distance).step >= size;
        if large(near) || !large(far * (1.0 - 1e-9)) {
            return None;
        }
        let (mut low, mut high) = (near, far);
        for _ in 0..80 {
            let middle = f64::midpoint(low, high);
            if large(middle) { high = middle } else { low = middle }
        }
        Some(high)
    }
}

/// Every format of so many bits between the planes of a lens, and the ties that it makes among the
/// neighbours in depth of a scene.
pub fn resolutions(bits: u32, lens: Lens, stage: Option<&Stage>) -> Vec<FormatRow> {
    let lens = lens.finite();
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped")]
    let ratio = (lens.far / lens.near).round().clamp(2.0, 1_048_576.0) as u32;
    let formats =
        DepthFormat::NAMES.iter().filter_map(|name| DepthFormat::named(name, bits, ratio));
    formats
        .map(|format| {
            let scale = Scale::new(format, lens);
            let decades = (lens.far / lens.near).log10().ceil().clamp(1.0, 12.0);
            #[allow(clippy::cast_possible_truncation, reason = "at most 12")]
            let count = decades as i32;
            let places = (0..=count).map(|n| (lens.near * 10f64.powi(n)).min(lens.far));
            FormatRow {
                format: format.name(),
                bits,
                reversed: format.is_reversed(),
                mean_step: scale.mean_step(),
                coarse_from: scale.reaches((lens.far - lens.near) / 1000.0),
                steps: places.map(|distance| scale.step(distance)).collect(),
                ties: stage.map(|stage| ties(stage, &scale)),
            }
        })
        .collect()
}

/// Neighbours in depth at a sample, apart as exact planes, that come to one code.
fn ties(stage: &Stage, scale: &Scale) -> u64 {
    let code = |face: u32, x: u32, y: u32| {
        let surface = stage.faces[face as usize].depth.as_ref()?;
        let part = (surface.code.at(x, y) / stage.world.top).clamp(0.0, 1.0);
        Some(scale.code(scale.lens.distance(part)))
    };
    let tied = stage.pairs.iter().filter(|pair| {
        code(pair.near, pair.x, pair.y)
            .is_some_and(|near| code(pair.far, pair.x, pair.y) == Some(near))
    });
    tied.count() as u64
}

/// What a sub-pixel grid does to depth: the mean change of depth that snapping vertices to `s` bits
/// makes on a scene, in codes of so many bits.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SnapRow {
    /// Sub-pixel bits.
    pub sub_pixel: u32,
    /// RMS change of depth in parts of the range.
    pub part: f64,
    /// The same in codes of 16, 24 and 32 bits.
    pub codes: [f64; 3],
}

impl SnapRow {
    /// The row of a scene on a grid, from its RMS snap error in ULP of `top + 1` codes.
    pub fn new(sub_pixel: u32, rms_ulp: f64, top: f64) -> Self {
        let part = rms_ulp / top;
        Self {
            sub_pixel,
            part,
            codes: [16, 24, 32].map(|bits| part * (f64::from(bits).exp2() - 1.0)),
        }
    }
}

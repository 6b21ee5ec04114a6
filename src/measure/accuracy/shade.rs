//! The errors of channels: what their codes should be at each sample of a stage, and how far off those of
//! a profile are. Spec clause `M-9`.

use super::channel_tally::{ChannelTally, WorstCode};
use super::drawn::Drawn;
use super::reference::{Reference, real};
use super::stage::{Face, Stage};
use crate::cover::SampleGrid;
use crate::model::{Model, Span};
use crate::scene::Shading;
use crate::setup::edges;
use crate::value::{AttributeConfig, Correction, EvaluatedAt, Provoking};
use std::ops::Range;

/// What the channels of a profile should be on a stage.
#[derive(Clone, Debug, Default)]
pub struct Shades {
    /// For each exact run of the stage: samples before it.
    before: Vec<usize>,
    /// By channel, then component: the real number at each sample.
    exact: Vec<Vec<Vec<f64>>>,
    /// By face: what its vertices bring.
    given: Vec<Shading>,
}

/// How a channel changes over triangles, in units of its code's last place.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Change {
    /// The largest difference of a component between vertices of one triangle, and the triangle.
    pub over_a_face: (f64, usize),
    /// The farthest that a value in perspective lies from the affine one, with triangle and pixel.
    pub from_affine: (f64, usize, [u32; 2]),
}

/// Where a channel is evaluated, where a pixel has one sample.
fn grid(stage: &Stage, at: EvaluatedAt) -> SampleGrid {
    let sub_pixel = stage.grid.sub_pixel;
    match at {
        EvaluatedAt::Sample => stage.grid,
        EvaluatedAt::Centre | EvaluatedAt::Centroid => {
            SampleGrid::at([1 << sub_pixel >> 1; 2], sub_pixel)
        }
        EvaluatedAt::Corner => SampleGrid::at([0; 2], sub_pixel),
    }
}

/// The reals of a channel at the vertices of a triangle in the order given, for each component, and w.
fn reals(shading: &Shading, config: &AttributeConfig) -> (Vec<[f64; 3]>, Option<[f64; 3]>) {
    let named = |name: &String| *name == config.name;
    match shading {
        Shading::Reals { channels, w } => {
            let own = channels.iter().find(|(name, _)| named(name));
            (own.map_or_else(Vec::new, |(_, values)| values.clone()), *w)
        }
        Shading::Codes { channels, inverse_w } => {
            let (own, unit) = (channels.iter().find(|(name, _)| named(name)), real(config.unit()));
            let values = own.map_or_else(Vec::new, |(_, values)| {
                values.iter().map(|codes| codes.map(|code| real(code) / unit)).collect()
            });
            (values, inverse_w.map(|q| q.map(|q| 1.0 / real(q))))
        }
    }
}

impl Shades {
    /// The channels of a model on a stage; none where the model has no channels, a pixel has several
    /// samples, or a triangle of the scene has no values for them.
    pub(super) fn new(reference: &Reference, stage: &Stage, model: &Model) -> Option<Self> {
        let profile = model.profile();
        if profile.channel.is_empty() || profile.multisample.is_some() {
            return None;
        }
        let shading = |face: &Face| {
            let shading = model.scene_shading(&reference.attributes, face.source).ok()?;
            model.shading(&shading).is_ok().then_some(shading)
        };
        let given: Vec<Shading> = stage.faces.iter().map(shading).collect::<Option<_>>()?;
        let mut samples = 0;
        let before = stage.runs.iter().map(|run| {
            samples += (run.x1 - run.x0) as usize;
            samples - (run.x1 - run.x0) as usize
        });
        let before = before.collect();
        let exact = profile.channel.iter().map(|config| {
            let mut exact = vec![Vec::with_capacity(samples); config.components.len()];
            for (face, given) in stage.faces.iter().zip(&given) {
                let (values, w) = reals(given, config);
                let over = Interpolated::new(stage, face, config, w);
                for (values, exact) in values.iter().zip(&mut exact) {
                    over.add(&stage.runs[face.runs.clone()], *values, exact);
                }
            }
            exact
        });
        Some(Self { exact: exact.collect(), before, given })
    }

    /// How a channel changes over the faces of a scene, on their grid.
    pub fn change(&self, stage: &Stage, config: &AttributeConfig) -> Change {
        let mut change = Change::default();
        let unit = real(config.unit());
        // The exact values of a channel that is held flat are not what is asked here.
        let plain = AttributeConfig { correction: Correction::Affine, ..config.clone() };
        let (mut exact, mut affine) = (Vec::new(), Vec::new());
        for (face, given) in stage.faces.iter().zip(&self.given) {
            let runs = &stage.runs[face.runs.clone()];
            let (values, w) = reals(given, config);
            let over = Interpolated::new(stage, face, &plain, w);
            let linear = Interpolated { inverse: [1.0; 3], ..over };
            for values in values.iter().filter(|_| !runs.is_empty()) {
                let [low, high] =
                    [f64::min, f64::max].map(|end| end(end(values[0], values[1]), values[2]));
                if (high - low) * unit > change.over_a_face.0 {
                    change.over_a_face = ((high - low) * unit, face.source);
                }
                exact.clear();
                affine.clear();
                over.add(runs, *values, &mut exact);
                linear.add(runs, *values, &mut affine);
                let pixels = runs.iter().flat_map(|run| (run.x0..run.x1).map(|x| [x, run.y]));
                for ((exact, affine), at) in exact.iter().zip(&affine).zip(pixels) {
                    let gap = (exact - affine).abs() * unit;
                    if gap > change.from_affine.0 {
                        change.from_affine = (gap, face.source, at);
                    }
                }
            }
        }
        change
    }

    /// Measures the wanted channels of a face over runs of it that are drawn; whether one is farther off than
    /// any before.
    pub fn face(
        &self,
        (stage, model): (&Stage, &Model),
        (number, runs): (usize, &[Span]),
        wanted: &[bool],
        tally: &mut ChannelTally,
    ) -> bool {
        let channels = &model.profile().channel;
        let mut worse = false;
        let drawn =
            self.codes((stage, model), (number, runs), wanted, &mut |found, codes, exact| {
                let Codes { channel, component, y, x0 } = found;
                let unit = real(channels[channel].unit());
                let moments = &mut tally.moments[channel];
                for (n, (code, exact)) in codes.iter().zip(exact).enumerate() {
                    #[allow(clippy::cast_precision_loss, reason = "a code has at most 32 bits")]
                    let error = *code as f64 - exact * unit;
                    if error.abs() > moments.worst {
                        worse = true;
                        let x = x0 + u32::try_from(n).unwrap_or(0);
                        let (face, code, exact) = (number, *code, exact * unit);
                        tally.worst[channel] = WorstCode { component, face, x, y, code, exact };
                    }
                    moments.note(error);
                }
            });
        if !drawn {
            // A vertex has no code in these words: nothing is right.
            for (moments, _) in tally.moments.iter_mut().zip(wanted).filter(|(_, wanted)| **wanted)
            {
                moments.note(f64::INFINITY);
            }
        }
        worse || !drawn
    }

    /// Calls `each` with the codes of wanted channels along runs of a face that are drawn, and the real
    /// numbers that they stand for; false, and no call, where a vertex has no code in the channel's words.
    pub(super) fn codes(
        &self,
        (stage, model): (&Stage, &Model),
        (number, runs): (usize, &[Span]),
        wanted: &[bool],
        each: &mut CodesSeen<'_>,
    ) -> bool {
        let face = &stage.faces[number];
        let Ok(values) = model.shading(&self.given[number]) else { return false };
        let mut exact_runs = ExactRuns { stage, rest: face.runs.clone() };
        let mut last = None;
        let triangle = (&*face.triangle, face.turned);
        model.codes_along(triangle, &values, (wanted, runs), &mut |channel, [y, x0, x1], codes| {
            let run = Span { y, x0, x1 };
            let first = match last {
                Some((known, first)) if known == run => first,
                _ => exact_runs.find(&self.before, &run),
            };
            last = Some((run, first));
            for (component, codes) in codes.iter().enumerate() {
                let exact = &self.exact[channel][component][first..];
                each(Codes { channel, component, y, x0 }, codes, exact);
            }
        });
        true
    }
}

/// Takes codes along a run and what they should be, as real numbers before the unit.
pub(super) type CodesSeen<'a> = dyn FnMut(Codes, &[i64], &[f64]) + 'a;

/// Where codes along a run stand.
#[derive(Clone, Copy, Debug)]
pub(super) struct Codes {
    pub(super) channel: usize,
    pub(super) component: usize,
    pub(super) y: u32,
    pub(super) x0: u32,
}

/// Finds exact runs, in order.
struct ExactRuns<'a> {
    stage: &'a Stage,
    rest: Range<usize>,
}

impl ExactRuns<'_> {
    /// Samples of the stage before the first one of a run that lies in an exact one.
    fn find(&mut self, before: &[usize], run: &Span) -> usize {
        let ends = |n: &usize| {
            let exact = &self.stage.runs[*n];
            (exact.y, exact.x1) >= (run.y, run.x1)
        };
        let own = self.rest.clone().find(ends).unwrap_or(self.rest.start);
        self.rest.start = own;
        before[own] + (run.x0 - self.stage.runs[own].x0) as usize
    }
}

/// A face over which a channel is interpolated exactly, in real numbers.
#[derive(Clone, Copy)]
struct Interpolated {
    /// The edge function opposite each vertex of the normalised triangle: at pixel (0, 0), and its changes.
    weights: [[f64; 3]; 3],
    /// 1/w of each vertex.
    inverse: [f64; 3],
    turned: bool,
    flat: Option<usize>,
}

impl Interpolated {
    fn new(stage: &Stage, face: &Face, config: &AttributeConfig, w: Option<[f64; 3]>) -> Self {
        let grid = grid(stage, config.at);
        let edges = edges(&face.triangle);
        let at = |k: usize, x, y| {
            let [x, y] = grid.position(x, y);
            edges[k].at(x, y)
        };
        let weights = [1, 2, 0].map(|k| {
            let first = at(k, 0, 0);
            [first, at(k, 1, 0) - first, at(k, 0, 1) - first].map(real)
        });
        let flat = match config.correction {
            Correction::Flat { provoking: Provoking::First } => Some(0),
            Correction::Flat { provoking: Provoking::Last } => Some(2),
            _ => None,
        };
        let mut inverse = w.map_or([1.0; 3], |w| w.map(|w| 1.0 / w));
        if face.turned {
            inverse.swap(1, 2);
        }
        Self { weights, inverse, turned: face.turned, flat }
    }

    /// Adds the values at the samples of runs.
    fn add(&self, runs: &[Span], mut values: [f64; 3], out: &mut Vec<f64>) {
        if let Some(vertex) = self.flat {
            let samples = runs.iter().map(|run| (run.x1 - run.x0) as usize).sum::<usize>();
            out.extend(std::iter::repeat_n(values[vertex], samples));
            return;
        }
        if self.turned {
            values.swap(1, 2);
        }
        for run in runs {
            for x in run.x0..run.x1 {
                let (mut above, mut below) = (0.0, 0.0);
                let vertices = self.weights.iter().zip(&self.inverse).zip(&values);
                for (([first, dx, dy], inverse), value) in vertices {
                    let share = (first + f64::from(x) * dx + f64::from(run.y) * dy) * inverse;
                    below += share;
                    above += share * value;
                }
                out.push(above / below);
            }
        }
    }
}

/// What the channels of a profile come to on a stage, over what is drawn.
pub fn measure_channels(
    stage: &Stage,
    drawn: &Drawn,
    model: &Model,
    wanted: &[bool],
) -> Option<ChannelTally> {
    let shades = stage.shades.as_ref()?;
    let mut tally = ChannelTally::of(wanted.len());
    for number in 0..stage.faces.len() {
        shades.face((stage, model), (number, drawn.runs(stage, number)), wanted, &mut tally);
    }
    Some(tally)
}

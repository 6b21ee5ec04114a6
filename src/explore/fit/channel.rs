//! Whether the codes of channels meet their tolerances, with as little measuring as proves it.
//! Spec clause `Q-8`.

use crate::explore::field::Level;
use crate::explore::tolerance::{Tolerance, exceeded};
use crate::measure::accuracy::{Accuracy, ChannelError, ChannelTally, Drawn, Moments, Stage};
use crate::model::Model;
use crate::profile::{InvalidProfile, Profile};
use crate::value::{AttributeConfig, InverseWConfig};

/// Faces that are tried first, at most.
const HOT: usize = 32;

/// What is known about channels on a coverage.
#[derive(Default)]
pub(super) struct Channels {
    measured: Vec<(Words, Vec<ChannelError>)>,
    /// Scene and face of those that refuted a budget, the last one first.
    hot: Vec<(usize, usize)>,
    /// Samples that are drawn and right, once they have been counted.
    samples: Option<u64>,
}

/// What decides the codes of channels, on a coverage.
#[derive(Clone, PartialEq)]
struct Words {
    channel: Vec<AttributeConfig>,
    w: Option<InverseWConfig>,
    /// Those that were measured.
    wanted: Vec<bool>,
}

/// The answer for the channels of a budget.
pub(super) enum Outcome {
    /// They meet every tolerance: measured, or the figures of a budget that was.
    Measured(Vec<ChannelError>),
    /// They fail one at least.
    Fails,
}

impl Channels {
    /// Judges the channels that tolerances are about.
    pub(super) fn judge(
        &mut self,
        stages: &[Stage],
        drawn: &[Drawn],
        profile: &Profile,
        tolerances: &[Tolerance],
    ) -> Result<Outcome, InvalidProfile> {
        let about = |name: &str| tolerances.iter().any(|t| t.metric.channel() == Some(name));
        let wanted: Vec<bool> = profile.channel.iter().map(|own| about(&own.name)).collect();
        if wanted.iter().all(|wanted| !wanted) {
            return Ok(Outcome::Measured(Vec::new()));
        }
        let words = Words { channel: profile.channel.clone(), w: profile.w, wanted };
        if let Some((_, errors)) = self.measured.iter().find(|(known, _)| *known == words) {
            return Ok(conclude(tolerances, errors.clone()));
        }
        let samples = *self.samples.get_or_insert_with(|| samples(stages, drawn));
        let part = Part { profile, tolerances, samples };
        let (model, wanted) = (Model::new(profile)?, &words.wanted);
        let measure = |scene: usize, face: usize, tally: &mut ChannelTally| {
            let stage = &stages[scene];
            stage.shades.as_ref().is_some_and(|shades| {
                let runs = drawn[scene].runs(stage, face);
                shades.face((stage, &model), (face, runs), wanted, tally)
            })
        };
        let hot = self.hot.iter().position(|(scene, face)| {
            let mut own = ChannelTally::of(wanted.len());
            measure(*scene, *face, &mut own);
            part.fails(&own)
        });
        if let Some(hot) = hot {
            self.hot[..=hot].rotate_right(1);
            return Ok(Outcome::Fails);
        }
        let mut all = ChannelTally::of(wanted.len());
        for (scene, stage) in stages.iter().enumerate() {
            for face in 0..stage.faces.len() {
                let worse = measure(scene, face, &mut all);
                if (worse || face % 256 == 255) && part.fails(&all) {
                    self.hot.insert(0, (scene, face));
                    self.hot.truncate(HOT);
                    return Ok(Outcome::Fails);
                }
            }
        }
        let errors = all.report(profile);
        self.measured.push((words, errors.clone()));
        Ok(conclude(tolerances, errors))
    }
}

/// Samples that are drawn and right.
fn samples(stages: &[Stage], drawn: &[Drawn]) -> u64 {
    let runs = stages.iter().zip(drawn).flat_map(|(stage, drawn)| {
        (0..stage.faces.len()).flat_map(move |face| drawn.runs(stage, face))
    });
    runs.map(|run| u64::from(run.x1 - run.x0)).sum()
}

fn conclude(tolerances: &[Tolerance], channels: Vec<ChannelError>) -> Outcome {
    let accuracy = Accuracy { channels, ..Accuracy::default() };
    match exceeded(tolerances, &accuracy, Level::Value) {
        Some(_) => Outcome::Fails,
        None => Outcome::Measured(accuracy.channels),
    }
}

/// What a part of a measurement proves: figures that only grow as more is measured.
struct Part<'a> {
    profile: &'a Profile,
    tolerances: &'a [Tolerance],
    /// Samples of the whole.
    samples: u64,
}

impl Part<'_> {
    /// Whether these alone exceed a tolerance, whatever the rest is.
    fn fails(&self, tally: &ChannelTally) -> bool {
        // The rest can raise a worst error and a sum of squares; the mean says nothing yet.
        let at_least = |(channel, moments): (&AttributeConfig, &Moments)| Moments {
            count: (self.samples * channel.components.len() as u64).max(moments.count),
            sum: 0.0,
            // Sums of squares are formed in another order in the end.
            squares: moments.squares * (1.0 - 1e-12),
            worst: moments.worst,
        };
        let measured = self.profile.channel.iter().zip(&tally.moments);
        let moments = measured
            .map(
                |(channel, moments)| {
                    if moments.count == 0 { *moments } else { at_least((channel, moments)) }
                },
            )
            .collect();
        let part = ChannelTally { moments, ..ChannelTally::default() };
        matches!(conclude(self.tolerances, part.report(self.profile)), Outcome::Fails)
    }
}

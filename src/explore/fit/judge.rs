//! Whether a budget meets the tolerances, with as little measuring as proves it. Spec clause `Q-8`.

use super::channel::Outcome;
use super::group::{Coverage, Group, StageKey};
use super::partly::Partly;
use super::{Effort, bound};
use crate::explore::field::Level;
use crate::explore::metric::Subject;
use crate::explore::sweep::Sweep;
use crate::explore::tolerance::{Tolerance, exceeded};
use crate::format::Clamp;
use crate::measure::accuracy::{Accuracy, Reach, Tally, Values, depth_of, face_values, finish};
use crate::profile::{InvalidProfile, Profile};

/// What the answer for a budget is.
#[derive(Clone, Debug)]
pub(super) enum Verdict {
    /// It meets every tolerance; measured, or the figures of one that was.
    Meets(Box<Accuracy>),
    /// It is proved to meet every tolerance; its figures are not known.
    Proved,
    /// It fails one at least.
    Fails,
}

pub(super) struct Judge<'a> {
    pub(super) sweep: &'a Sweep,
    pub(super) tolerances: Vec<Tolerance>,
    pub(super) effort: Effort,
    /// Whether a proof will do where nobody asks for the figures.
    pub(super) by_bound: bool,
    group: Option<Group>,
}

/// Faces that are tried first, at most.
const HOT: usize = 32;

impl<'a> Judge<'a> {
    pub(super) fn new(sweep: &'a Sweep, tolerances: &[Tolerance]) -> Self {
        let tolerances = tolerances.to_vec();
        Self { sweep, tolerances, effort: Effort::default(), by_bound: false, group: None }
    }

    /// The scenes on the grid of a profile, and what is known there.
    pub(super) fn group(&mut self, profile: &Profile) -> Result<&mut Group, InvalidProfile> {
        let key = StageKey::new(profile);
        let group = match self.group.take() {
            Some(group) if group.key == key => group,
            _ => Group::new(key, self.sweep.stages(profile)?),
        };
        Ok(self.group.insert(group))
    }

    /// Whether a profile meets the tolerances.
    pub(super) fn judge(&mut self, profile: &Profile) -> Result<Verdict, InvalidProfile> {
        self.group(profile)?;
        let Some(mut group) = self.group.take() else { return Ok(Verdict::Fails) };
        let verdict = self.on_group(&mut group, profile);
        self.group = Some(group);
        verdict
    }

    fn on_group(
        &mut self,
        group: &mut Group,
        profile: &Profile,
    ) -> Result<Verdict, InvalidProfile> {
        let snapped = group.report(&Tally::default());
        if exceeded(&self.tolerances, &snapped, Level::Stage).is_some() {
            self.effort.by_snap += 1;
            return Ok(Verdict::Fails);
        }
        let at = group.coverage(profile, &self.tolerances)?;
        let coverage = &group.coverages[at];
        if coverage.drawn.is_none() {
            self.effort.by_coverage += 1;
            return Ok(Verdict::Fails);
        }
        let before = self.effort;
        let verdict = if profile.depth.is_none() {
            self.effort.evaluated += 1;
            self.conclude(group.report(&coverage.tally))
        } else {
            self.values(group, at, profile)
        };
        if matches!(verdict, Verdict::Fails) {
            return Ok(verdict);
        }
        let Coverage { drawn, channels, .. } = &mut group.coverages[at];
        let Some(drawn) = drawn else { return Ok(Verdict::Fails) };
        Ok(match channels.judge(&group.stages, drawn, profile, &self.tolerances)? {
            Outcome::Fails => {
                self.effort = Effort { by_channel: before.by_channel + 1, ..before };
                Verdict::Fails
            }
            Outcome::Measured(channels) => match verdict {
                Verdict::Meets(accuracy) => {
                    Verdict::Meets(Box::new(Accuracy { channels, ..*accuracy }))
                }
                proved => proved,
            },
        })
    }

    /// Depth and attribute, on a coverage that meets its tolerances.
    fn values(&mut self, group: &mut Group, at: usize, profile: &Profile) -> Verdict {
        let (Some(depth), Some(config)) = (depth_of(profile), profile.depth) else {
            return Verdict::Fails;
        };
        let read = depth.read_out();
        let plane = group.coverages[at].plane(config);
        let held = plane.depth.within(read.range());
        let no_wrap = |t: &Tolerance| t.metric.subject == Subject::Wraps && t.limit < 1.0;
        if !held && self.tolerances.iter().any(no_wrap) {
            self.effort.by_range += 1;
            return Verdict::Fails;
        }
        if let Some(tally) = plane.whole
            && plane.held_by(read)
        {
            self.effort.by_sameness += 1;
            return self.conclude(group.report(&tally));
        }
        let coverage = &group.coverages[at];
        let Some(drawn) = &coverage.drawn else { return Verdict::Fails };
        if self.by_bound && bound::meets(&group.stages, drawn, profile, &self.tolerances) {
            self.effort.by_bound += 1;
            return Verdict::Proved;
        }
        let mut partly = Partly::new(&self.tolerances, group, coverage);
        let mut seen = Values::default();
        let hot = group.hot.iter().position(|(scene, face)| {
            let (stage, mut own) = (&group.stages[*scene], Values::default());
            let runs = drawn[*scene].runs(stage, *face);
            face_values(stage, &depth, &stage.faces[*face], runs, &mut own);
            seen.merge(&own);
            partly.fails(&own)
        });
        if let Some(hot) = hot {
            group.coverages[at].plane(config).widen(&seen);
            group.hot[..=hot].rotate_right(1);
            self.effort.by_witness += 1;
            return Verdict::Fails;
        }
        let (mut all, mut arithmetic) = (Values::default(), Tally::default());
        let mut order = Reach::default();
        for (scene, (stage, drawn)) in group.stages.iter().zip(drawn).enumerate() {
            let mut values = Values::default();
            for (n, face) in stage.faces.iter().enumerate() {
                let mut own = Values::default();
                face_values(stage, &depth, face, drawn.runs(stage, n), &mut own);
                values.merge(&own);
                let mut so_far = all;
                if partly.is_due(&own, n) && {
                    so_far.merge(&values);
                    partly.fails(&so_far)
                } {
                    group.coverages[at].plane(config).widen(&so_far);
                    group.hot.insert(0, (scene, n));
                    group.hot.truncate(HOT);
                    self.effort.by_part += 1;
                    return Verdict::Fails;
                }
            }
            let mut tally = drawn.tally;
            order.widen(finish(stage, &depth, &values, &mut tally));
            arithmetic.merge(&tally);
            all.merge(&values);
        }
        self.effort.evaluated += 1;
        let plane = group.coverages[at].plane(config);
        plane.widen(&all);
        plane.order.widen(order);
        if plane.held_by(read) && read.clamp() != Clamp::Saturate {
            plane.whole = Some(arithmetic);
        }
        self.conclude(group.report(&arithmetic))
    }

    fn conclude(&self, accuracy: Accuracy) -> Verdict {
        let mut levels = [Level::Stage, Level::Coverage, Level::Value].into_iter();
        if levels.any(|level| exceeded(&self.tolerances, &accuracy, level).is_some()) {
            Verdict::Fails
        } else {
            Verdict::Meets(Box::new(accuracy))
        }
    }
}

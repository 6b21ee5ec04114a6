//! One face at a time, sample by sample: for pictures of errors and for witnesses.

use super::drawn::Runs;
use super::own::Held;
use super::reference::real;
use super::run::{Side, compare};
use super::shade::Codes;
use super::stage::{Face, Stage, Surface};
use super::value::Walk;
use crate::measure::error::SampleError;
use crate::model::Model;
use crate::profile::{InvalidProfile, Profile};

/// Looks at the samples of a stage through one profile.
#[derive(Debug)]
pub struct Inspector<'a> {
    stage: &'a Stage,
    model: Model,
    /// What evaluates the attribute, where depth has a bias.
    plain: Option<Model>,
}

/// Which value to look at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Value {
    /// Depth.
    Depth,
    /// The attribute.
    Attribute,
}

impl<'a> Inspector<'a> {
    /// An inspector of a stage that was made for this profile's grid.
    ///
    /// # Errors
    /// [`InvalidProfile`] names the violated inequality.
    pub fn new(stage: &'a Stage, profile: &Profile) -> Result<Self, InvalidProfile> {
        let profile = Profile { multisample: None, ..profile.clone() };
        let biased = profile.depth.is_some_and(|depth| depth.bias.is_some());
        let plain = biased.then(|| Model::new(&profile.unbiased())).transpose()?;
        Ok(Self { stage, model: Model::new(&profile)?, plain })
    }

    /// Calls `each` with column, row and error of every sample of a face that is covered or should
    /// be; the error of a sample that is both is that of `value`, in ULP.
    pub fn face(&self, face: &Face, value: Value, mut each: impl FnMut(u32, u32, SampleError)) {
        let model = match value {
            Value::Depth => &self.model,
            Value::Attribute => self.plain.as_ref().unwrap_or(&self.model),
        };
        let mut drawn = Runs::default();
        // A triangle that the profile refuses is missing as a whole.
        model.draw_own(&face.triangle, &mut drawn);
        let surface: Option<&Surface> = match value {
            Value::Depth => face.depth.as_ref(),
            Value::Attribute => face.attribute.as_ref(),
        };
        let depth = model.depth().zip(surface);
        let planar = model.profile().form.walks_a_plane();
        let walk = depth.filter(|_| planar);
        let walk = walk.map(|(depth, surface)| Walk::new(self.stage, depth, face, surface));
        let own = depth.filter(|_| !planar);
        let own = own.map(|(_, surface)| (Held::draw(self.stage, model, face, surface), surface));
        let ulp = |x, y| match (&walk, &own, model.depth()) {
            (Some(walk), ..) => walk.held_ulp(self.stage, x, y),
            (_, Some((held, surface)), Some(depth)) => {
                held.ulp(self.stage, depth, surface, x, y).unwrap_or(0.0)
            }
            _ => 0.0,
        };
        compare(&self.stage.runs[face.runs.clone()], &drawn.0, |side, run| {
            for x in run.x0..run.x1 {
                let error = match side {
                    Side::Missing => SampleError::Missing,
                    Side::Extra => SampleError::Extra,
                    Side::Both => SampleError::Depth(ulp(x, run.y)),
                };
                each(x, run.y, error);
            }
        });
    }

    /// The same for a channel of the profile: the error of a sample that is covered and should be is that
    /// of the channel's worst component, in units of its code's last place. False, and no call, where the
    /// scene has no values for the channel.
    pub fn channel(
        &self,
        number: usize,
        channel: usize,
        mut each: impl FnMut(u32, u32, SampleError),
    ) -> bool {
        let Some(shades) = &self.stage.shades else { return false };
        let (stage, face) = (self.stage, &self.stage.faces[number]);
        let (mut drawn, mut both) = (Runs::default(), Vec::new());
        self.model.draw_own(&face.triangle, &mut drawn);
        compare(&stage.runs[face.runs.clone()], &drawn.0, |side, run| {
            let error = match side {
                Side::Missing => SampleError::Missing,
                Side::Extra => SampleError::Extra,
                Side::Both => return both.push(run),
            };
            (run.x0..run.x1).for_each(|x| each(x, run.y, error));
        });
        let channels = &self.model.profile().channel;
        let wanted: Vec<bool> = (0..channels.len()).map(|n| n == channel).collect();
        let unit = real(channels[channel].unit());
        let mut worst = Vec::new();
        let last = channels[channel].components.len() - 1;
        let found = &mut |at: Codes, codes: &[i64], exact: &[f64]| {
            let errors = codes.iter().zip(exact);
            let errors = errors.map(|(code, exact)| (real(i128::from(*code)) - exact * unit).abs());
            if at.component == 0 {
                worst.clear();
                worst.extend(errors);
            } else {
                worst.iter_mut().zip(errors).for_each(|(worst, error)| *worst = worst.max(error));
            }
            if at.component == last {
                for (x, error) in (at.x0..).zip(&worst) {
                    each(x, at.y, SampleError::Depth(*error));
                }
            }
        };
        shades.codes((stage, &self.model), (number, &both), &wanted, found)
    }
}

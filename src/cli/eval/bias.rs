//! The models of a profile under the depth biases that lines ask for. Spec clause `Z-7`.

use guardbit::model::{Model, View};
use guardbit::profile::Profile;
use guardbit::value::DepthBias;

/// The model of a profile, and the model of the last bias that a line gave instead of the profile's.
pub(super) struct Models {
    own: Model,
    view: View,
    other: Option<(DepthBias, Model)>,
}

impl Models {
    /// With the model of the profile alone.
    pub(super) fn new(own: Model, view: View) -> Self {
        Self { own, view, other: None }
    }

    /// The model that draws a line with this bias, or with that of the profile where it gives none.
    pub(super) fn of(&mut self, bias: Option<DepthBias>) -> Result<&Model, String> {
        let Some(bias) = bias else { return Ok(&self.own) };
        // Lines of one draw call follow each other, and share a model.
        let other = match self.other.take().filter(|(before, _)| *before == bias) {
            Some(same) => same,
            None => (bias, biased(self.own.profile(), self.view, bias)?),
        };
        Ok(&self.other.insert(other).1)
    }
}

fn biased(profile: &Profile, view: View, bias: DepthBias) -> Result<Model, String> {
    let mut profile = profile.clone();
    let Some(depth) = &mut profile.depth else {
        let message = "field `bias`: the profile has no [depth], so a draw call has no depth bias; leave bias out";
        return Err(message.to_owned());
    };
    depth.bias = Some(bias);
    Model::with_view(&profile, view).map_err(|error| {
        // From the bias on: a line has no tables above it.
        let path: Vec<&str> =
            error.field().iter().copied().skip_while(|key| *key != "bias").collect();
        let field = if path.is_empty() { "bias".to_owned() } else { path.join(".") };
        format!("field `{field}`: {error}")
    })
}

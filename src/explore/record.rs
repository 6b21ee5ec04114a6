//! One measured budget. Spec clause `Q-3`.

use super::field::Value;
use crate::measure::accuracy::Accuracy;
use crate::measure::cost::{Cost, Synthesis};
use serde::{Deserialize, Serialize, Serializer};

/// A budget, what it costs and what it does.
#[derive(Clone, Debug, Serialize)]
pub struct Record {
    /// Its number in the space.
    pub index: u64,
    /// Fields and words, by name.
    #[serde(serialize_with = "as_map")]
    pub budget: Vec<(&'static str, Value)>,
    /// Errors, both causes apart.
    pub accuracy: Accuracy,
    /// Hardware, from the bits.
    pub cost: Cost,
    /// Operations a covered sample, set-up and wasted visits shared out over the scene.
    pub operations_per_fragment: f64,
    /// Software, measured; absent when not asked for.
    pub speed: Option<Speed>,
    /// Hardware, by a synthesis tool; absent when not asked for.
    pub synthesis: Option<Synthesis>,
    /// Whether no other budget of the sweep is better in one objective and as good in the rest.
    pub pareto: bool,
}

/// How quickly the model draws through a budget.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Speed {
    /// Nanoseconds a covered sample, on one thread.
    pub ns_per_sample: f64,
    /// Median ratio to the profile that the sweep varies, timed in turn with it.
    pub ratio: f64,
}

fn as_map<S: Serializer>(
    budget: &[(&'static str, Value)],
    serializer: S,
) -> Result<S::Ok, S::Error> {
    serializer.collect_map(budget.iter().map(|(name, value)| (name, value)))
}

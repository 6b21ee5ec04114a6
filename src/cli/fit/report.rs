//! What a fit found, as JSON and as text.

use super::{Request, Shard};
use guardbit::explore::field::Value;
use guardbit::explore::fit::{Best, Effort, Fit, Lesser};
use guardbit::explore::store::Header;
use guardbit::explore::tolerance::Tolerance;
use guardbit::explore::witness::Witness;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// A field's value, as a file has it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub(super) enum Setting {
    Bits(u32),
    Number(i64),
    Name(String),
}

/// The answer to a request, or to a part of it.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Report {
    /// Fields and words; null when nothing meets the tolerances.
    pub(super) budget: Option<BTreeMap<String, Setting>>,
    pub(super) index: Option<u64>,
    pub(super) cost: Option<f64>,
    pub(super) cost_metric: String,
    /// Each tolerance: the limit, and what the budget comes to.
    pub(super) within: BTreeMap<String, Limit>,
    /// By field: what fails with one bit less.
    pub(super) witness: BTreeMap<String, Failing>,
    /// What kind of answer it is, in words.
    pub(super) answer: String,
    pub(super) larger: Option<Upward>,
    pub(super) evaluated: u64,
    pub(super) pruned: u64,
    pub(super) effort: Effort,
    pub(super) budgets: u64,
    pub(super) part: Option<[u64; 2]>,
    pub(super) request: String,
}

#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Limit {
    #[serde(rename = "limit")]
    pub(super) most: f64,
    pub(super) value: Option<f64>,
    pub(super) unit: String,
}

#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Upward {
    pub(super) checked: u64,
    /// A larger budget that fails, if one does.
    pub(super) fails: Option<BTreeMap<String, Setting>>,
}

#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Failing {
    /// The value with one bit less; absent when there is none.
    pub(super) value: Option<u32>,
    /// Whether that budget fails.
    pub(super) fails: bool,
    pub(super) finding: String,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) metric: Option<String>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) limit: Option<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) figure: Option<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) scene: Option<String>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) triangle: Option<usize>,
    /// In sub-pixels of the lesser budget's grid.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) vertices: Option<[[i128; 2]; 3]>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) depths: Option<[i128; 3]>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) pixel: Option<[u32; 2]>,
}

/// A budget for a file.
pub(super) fn as_map(budget: &[(&'static str, Value)]) -> BTreeMap<String, Setting> {
    let setting = |value: &Value| match value {
        Value::Bits(bits) => Setting::Bits(*bits),
        Value::Number(number) => Setting::Number(*number),
        Value::Name(name) => Setting::Name((*name).to_owned()),
    };
    budget.iter().map(|(name, value)| ((*name).to_owned(), setting(value))).collect()
}

/// Names the request: its space and scenes, tolerances, cost and kind, and the model that answers.
pub(super) fn digest(request: &Request<'_>) -> String {
    let tolerances: Vec<String> =
        request.tolerances.iter().map(|t| format!("{}={}", t.metric.name, t.limit)).collect();
    let header = Header::new(request.sweep);
    format!(
        "{} model {} {} {} {}",
        header.request,
        header.model,
        tolerances.join(","),
        request.cost.name,
        if request.robust { "robust" } else { "cheapest" }
    )
}

impl Report {
    pub(super) fn new(
        request: &Request<'_>,
        scenes: &[String],
        part: Option<Shard>,
        fit: &Fit,
    ) -> Self {
        let best = fit.best.as_deref();
        let limit = |tolerance: &Tolerance| {
            let value = best.and_then(|best| tolerance.metric.of_accuracy(&best.accuracy));
            let unit = tolerance.metric.unit.to_owned();
            (tolerance.metric.name.to_owned(), Limit { most: tolerance.limit, value, unit })
        };
        let failing = |best: &Best| best.lesser.iter().map(|l| lesser(l, scenes)).collect();
        let answer = match best {
            _ if request.robust => {
                "the cheapest budget for which every larger budget also meets the tolerances"
            }
            Some(best) if best.larger.failed.is_none() => {
                "the cheapest budget; every larger budget also meets the tolerances"
            }
            _ => "the cheapest budget; not every larger budget meets the tolerances",
        };
        Self {
            budget: best.map(|best| as_map(&best.budget())),
            index: best.map(|best| best.index),
            cost: best.map(|best| best.cost),
            cost_metric: request.cost.name.to_owned(),
            within: request.tolerances.iter().map(limit).collect(),
            witness: best.map(failing).unwrap_or_default(),
            answer: answer.to_owned(),
            larger: best.map(|best| Upward {
                checked: best.larger.checked,
                fails: best.larger.failed.as_ref().map(|failed| as_map(&failed.budget)),
            }),
            evaluated: fit.effort.evaluated,
            pruned: fit.effort.pruned(),
            effort: fit.effort,
            budgets: fit.budgets,
            part: part.map(|part| [part.index, part.parts]),
            request: digest(request),
        }
    }
}

fn lesser(lesser: &Lesser, scenes: &[String]) -> (String, Failing) {
    let bare = |fails, finding: String| Failing {
        value: None,
        fails,
        finding,
        metric: None,
        limit: None,
        figure: None,
        scene: None,
        triangle: None,
        vertices: None,
        depths: None,
        pixel: None,
    };
    match lesser {
        Lesser::Impossible(field, why) => (field.name().to_owned(), bare(false, why.clone())),
        Lesser::Meets(field) => {
            let why = "one bit fewer also meets the tolerances, but is not in the space or not \
                       cheaper";
            (field.name().to_owned(), bare(false, why.to_owned()))
        }
        Lesser::Fails(field, witness) => {
            let Witness { value, tolerance, figure, scene, place, vertices, depths, finding } =
                &**witness;
            let failing = Failing {
                value: match value {
                    Value::Bits(bits) => Some(*bits),
                    Value::Number(_) | Value::Name(_) => None,
                },
                fails: true,
                finding: finding.clone(),
                metric: Some(tolerance.metric.name.to_owned()),
                limit: Some(tolerance.limit),
                figure: Some(*figure),
                scene: scenes.get(*scene).cloned(),
                triangle: place.map(|place| place.triangle),
                vertices: *vertices,
                depths: *depths,
                pixel: place.map(|place| [place.x, place.y]),
            };
            (field.name().to_owned(), failing)
        }
    }
}

//! What a fit found, as JSON and as text.

use super::{Failure, Output, PathBuf, Request, Shard};
use crate::cli::explore::{figure, in_words_budget};
use guardbit::explore::field::Value;
use guardbit::explore::fit::{Best, Effort, Fit, Lesser};
use guardbit::explore::store::Header;
use guardbit::explore::sweep::Sweep;
use guardbit::explore::tolerance::Tolerance;
use guardbit::explore::witness::Witness;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// A field's value, as a file has it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub(super) enum Setting {
    Bits(u32),
    Name(String),
}

/// The answer to a request, or to a part of it.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Report {
    /// Fields and words; null when nothing meets the tolerances.
    pub(super) budget: Option<BTreeMap<String, Setting>>,
    pub(super) index: Option<u64>,
    cost: Option<f64>,
    cost_metric: String,
    /// Each tolerance: the limit, and what the budget comes to.
    within: BTreeMap<String, Limit>,
    /// By field: what fails with one bit less.
    witness: BTreeMap<String, Failing>,
    /// `cheapest`, or `cheapest that every larger one also meets`.
    answer: String,
    larger: Option<Upward>,
    evaluated: u64,
    pruned: u64,
    effort: Effort,
    budgets: u64,
    part: Option<[u64; 2]>,
    request: String,
}

#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Limit {
    limit: f64,
    value: Option<f64>,
    unit: String,
}

#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Upward {
    checked: u64,
    /// A larger budget that fails, if one does.
    fails: Option<BTreeMap<String, Setting>>,
}

#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Failing {
    /// The value with one bit less; absent when there is none.
    value: Option<u32>,
    /// Whether that budget fails.
    fails: bool,
    finding: String,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    metric: Option<String>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    limit: Option<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    figure: Option<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    scene: Option<String>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    triangle: Option<usize>,
    /// In sub-pixels of the lesser budget's grid.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    vertices: Option<[[i128; 2]; 3]>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    depths: Option<[i128; 3]>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pixel: Option<[u32; 2]>,
}

/// A budget for a file.
pub(super) fn as_map(budget: &[(&'static str, Value)]) -> BTreeMap<String, Setting> {
    let setting = |value: &Value| match value {
        Value::Bits(bits) => Setting::Bits(*bits),
        Value::Name(name) => Setting::Name((*name).to_owned()),
    };
    budget.iter().map(|(name, value)| ((*name).to_owned(), setting(value))).collect()
}

/// Names the request: its space and scenes, tolerances, cost and kind, and the model that answers.
fn digest(request: &Request<'_>) -> String {
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
            (tolerance.metric.name.to_owned(), Limit { limit: tolerance.limit, value, unit })
        };
        let failing = |best: &Best| best.lesser.iter().map(|l| lesser(l, scenes)).collect();
        let answer = match best {
            _ if request.robust => "cheapest that every larger one also meets",
            Some(best) if best.larger.failed.is_none() => {
                "cheapest, and every larger one also meets the tolerances"
            }
            _ => "cheapest",
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

    pub(super) fn print(&self, output: &mut Output, sweep: &Sweep) -> Result<(), Failure> {
        let profile = &sweep.space.base().name;
        let window = sweep.space.base().window;
        let names: Vec<&str> = sweep.scenes.iter().map(|scene| scene.name.as_str()).collect();
        output.line(format!(
            "{profile} on {}, {} x {}",
            names.join(", "),
            window.width,
            window.height
        ))?;
        let (Some(budget), Some(cost)) = (&self.budget, self.cost) else {
            output.line("no budget of this part meets the tolerances")?;
            return self.print_effort(output);
        };
        let varied: Vec<String> = sweep
            .space
            .axes()
            .iter()
            .map(|axis| axis.field.name())
            .chain(["edge-bits", "depth-bits"])
            .filter_map(|name| Some(in_words_budget(name, setting(budget.get(name)?))))
            .collect();
        output.line(format!("budget    {}", varied.join(" ")))?;
        output.line(format!("cost      {} {}", self.cost_metric, figure(cost)))?;
        for (name, Limit { limit, value, unit }) in &self.within {
            let value = value.map_or("none".to_owned(), figure);
            output.line(format!("meets     {name} {value} <= {} {unit}", figure(*limit)))?;
        }
        output.line(format!("answer    the {} of the space", self.answer))?;
        if let Some(Upward { checked, fails }) = &self.larger {
            match fails {
                None => output.line(format!("larger    all {checked} larger budgets meet them"))?,
                Some(budget) => {
                    let parts: Vec<String> = budget
                        .iter()
                        .map(|(name, value)| in_words_budget(name, setting(value)))
                        .collect();
                    output.line(format!("larger    this one fails: {}", parts.join(" ")))?;
                }
            }
        }
        output.line("one bit less:")?;
        for (field, failing) in &self.witness {
            failing.print(output, field)?;
        }
        self.print_effort(output)
    }

    fn print_effort(&self, output: &mut Output) -> Result<(), Failure> {
        let e = self.effort;
        let reasons = [
            (e.by_cost, "cost more than one that meets all"),
            (e.by_coverage, "by what they draw"),
            (e.by_snap, "by snapping alone"),
            (e.by_range, "by values beyond their guard bits"),
            (e.by_witness, "by a triangle that refuted another"),
            (e.by_part, "by a part of the scene"),
            (e.by_sameness, "proved equal to one measured"),
            (e.by_bound, "proved by bounds"),
            (e.by_larger, "smaller than one that fails"),
        ];
        let named: Vec<String> = reasons
            .iter()
            .filter(|(count, _)| *count > 0)
            .map(|(count, reason)| format!("{count} {reason}"))
            .collect();
        output.line(format!(
            "searched  {} budgets: {} measured as a whole, {} settled without ({})",
            self.budgets,
            self.evaluated,
            self.pruned,
            named.join(", ")
        ))
    }
}

fn setting(setting: &Setting) -> String {
    match setting {
        Setting::Bits(bits) => bits.to_string(),
        Setting::Name(name) => name.clone(),
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
            let why = "one bit less also meets the tolerances: it is not in the space, or not \
                       cheaper";
            (field.name().to_owned(), bare(false, why.to_owned()))
        }
        Lesser::Fails(field, witness) => {
            let Witness { value, tolerance, figure, scene, place, vertices, depths, finding } =
                &**witness;
            let failing = Failing {
                value: match value {
                    Value::Bits(bits) => Some(*bits),
                    Value::Name(_) => None,
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

impl Failing {
    fn print(&self, output: &mut Output, field: &str) -> Result<(), Failure> {
        let (Some(value), Some(metric), Some(limit), Some(got)) =
            (self.value, &self.metric, self.limit, self.figure)
        else {
            return output.line(format!("  {field}: {}", self.finding));
        };
        output.line(format!(
            "  {field}={value} fails: {metric} {} > {}: {}",
            figure(got),
            figure(limit),
            self.finding
        ))?;
        if let (Some(triangle), Some([x, y])) = (self.triangle, self.pixel) {
            let scene = self.scene.as_deref().unwrap_or("");
            let corner = |n: usize| {
                let xy =
                    self.vertices.map_or(String::new(), |v| format!("{},{}", v[n][0], v[n][1]));
                let z = self.depths.map_or(String::new(), |z| format!(",{}", z[n]));
                format!("[{xy}{z}]")
            };
            let corners = [0, 1, 2].map(corner).join(",");
            output.line(format!(
                "    triangle {triangle} of {scene}, {{\"v\": [{corners}]}}, at pixel ({x}, {y})"
            ))?;
        }
        Ok(())
    }
}

/// Joins the answers of all parts: the cheapest of them is the cheapest of the whole.
pub(super) fn merge(request: &Request<'_>, files: &[PathBuf]) -> Result<Report, Failure> {
    let mut parts: Vec<Report> = Vec::new();
    for path in files {
        let name = path.display().to_string();
        let text = std::fs::read_to_string(path).map_err(|error| Failure::io(&name, &error))?;
        let report: Report = serde_json::from_str(&text).map_err(|error| {
            Failure::input(format!("{name}:{}: {error}", error.line()))
                .hint("an answer is written by `fit --save`")
        })?;
        if report.request != digest(request) {
            return Err(Failure::input(format!(
                "{name}: the answer to another request: profile, axes, scenes, tolerances and cost \
                 have to be the same"
            )));
        }
        parts.push(report);
    }
    let count = parts.first().and_then(|part| part.part).map_or(1, |[_, parts]| parts);
    for index in 0..count {
        let of = parts.iter().filter(|p| p.part.unwrap_or([0, 1]) == [index, count]).count();
        if of != 1 {
            return Err(Failure::input(format!("part {index}/{count} is in {of} of the files"))
                .hint("name the answer of each part once"));
        }
    }
    if parts.len() as u64 != count {
        let message = format!("{} files for {count} parts", parts.len());
        return Err(Failure::input(message).hint("name the answer of each part once"));
    }
    let key =
        |report: &Report| (report.cost.unwrap_or(f64::INFINITY), report.index.unwrap_or(u64::MAX));
    let mut whole = parts
        .iter()
        .min_by(|a, b| key(a).0.total_cmp(&key(b).0).then(key(a).1.cmp(&key(b).1)))
        .cloned()
        .ok_or_else(|| Failure::input("no parts to join"))?;
    whole.effort = Effort::default();
    parts.iter().for_each(|part| whole.effort.add(&part.effort));
    whole.evaluated = whole.effort.evaluated;
    whole.pruned = whole.effort.pruned();
    whole.budgets = parts.iter().map(|part| part.budgets).sum();
    whole.part = None;
    Ok(whole)
}

//! What a fit found, as text.

use super::report::{Failing, Limit, Report, Setting, Upward};
use super::{Failure, Output};
use crate::cli::explore::{figure, in_words_budget};
use guardbit::explore::sweep::Sweep;

impl Report {
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
        for (name, Limit { most, value, unit }) in &self.within {
            let value = value.map_or("none".to_owned(), figure);
            output.line(format!("meets     {name} {value} <= {} {unit}", figure(*most)))?;
        }
        output.line(format!("answer    {}", self.answer))?;
        if let Some(Upward { checked, fails }) = &self.larger {
            match fails {
                None => output.line(format!("larger    all {checked} larger budgets meet them"))?,
                Some(budget) => {
                    let parts: Vec<String> = budget
                        .iter()
                        .map(|(name, value)| in_words_budget(name, setting(value)))
                        .collect();
                    output
                        .line(format!("larger    this larger budget fails: {}", parts.join(" ")))?;
                }
            }
        }
        output.line("one bit fewer:")?;
        for (field, failing) in &self.witness {
            failing.print(output, field)?;
        }
        self.print_effort(output)
    }

    fn print_effort(&self, output: &mut Output) -> Result<(), Failure> {
        let e = self.effort;
        let reasons = [
            (e.by_cost, "cost more than a budget that meets all tolerances"),
            (e.by_coverage, "by their coverage"),
            (e.by_snap, "by the snap error alone"),
            (e.by_range, "by values outside the range of their guard bits"),
            (e.by_witness, "by a triangle that failed with another budget"),
            (e.by_part, "by a part of the scene"),
            (e.by_channel, "by the codes of a channel"),
            (e.by_sameness, "proved equal to a measured budget"),
            (e.by_bound, "proved by bounds"),
            (e.by_larger, "smaller than a budget that fails"),
        ];
        let named: Vec<String> = reasons
            .iter()
            .filter(|(count, _)| *count > 0)
            .map(|(count, reason)| format!("{count} {reason}"))
            .collect();
        output.line(format!(
            "searched  {} budgets: {} measured in full, {} decided without a full measurement ({})",
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
        Setting::Number(number) => number.to_string(),
        Setting::Name(name) => name.clone(),
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

//! A sweep as one HTML page: interactive charts, a table, error maps. The page needs no network.

mod data;
mod map;
mod shell;

use super::explore::figure;
use super::failure::Failure;
use super::heat::{self, Scale};
use super::progress;
pub(crate) use data::unit;
use guardbit::explore::metric::Metric;
use guardbit::explore::record::Record;
use guardbit::explore::sweep::Sweep;
use guardbit::model::MODEL_VERSION;
pub(crate) use map::{Map, data_uri};
pub(crate) use shell::{command_line, quoted};
use std::fmt::Write as _;
use std::sync::atomic::{AtomicU64, Ordering};

const PAGE: &str = include_str!("report/page.html.in");
const STYLE: &str = include_str!("report/page.css.in");
/// One closure: the page has no global names.
const SCRIPT: &str = concat!(
    "(() => {\n'use strict';\n",
    include_str!("report/base.js.in"),
    include_str!("report/scale.js.in"),
    include_str!("report/chart.js.in"),
    include_str!("report/scatter.js.in"),
    include_str!("report/panels.js.in"),
    include_str!("report/detail.js.in"),
    include_str!("report/table.js.in"),
    include_str!("report/selftest.js.in"),
    include_str!("report/main.js.in"),
    "})();\n"
);

/// A page about to be written.
pub(crate) struct Page<'a> {
    pub(crate) sweep: &'a Sweep,
    pub(crate) records: &'a [Record],
    pub(crate) objectives: &'a [Metric],
    /// What the first chart begins with.
    pub(crate) axes: [Metric; 2],
    /// Budgets of the front that get a map.
    pub(crate) maps: usize,
    /// What the user typed.
    pub(crate) command: String,
    /// What measures one budget of this sweep, before its fields are named.
    pub(crate) single: String,
}

/// Text inside an element or an attribute.
fn escaped(text: &str) -> String {
    let text = text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;");
    text.replace('"', "&quot;")
}

/// So many of something.
pub(crate) fn counted(count: usize, what: &str) -> String {
    format!("{count} {what}{}", if count == 1 { "" } else { "s" })
}

/// The template with each `@KEY@` replaced, in one pass: what was put in is not searched again.
fn fill(template: &str, values: &[(&str, &str)]) -> String {
    let mut out = String::new();
    // Keys are capitals between two at-signs, which stand nowhere else in the template.
    for (n, part) in template.split('@').enumerate() {
        let value = values.iter().find(|(key, _)| *key == part).filter(|_| n % 2 == 1);
        out.push_str(value.map_or(part, |(_, value)| value));
    }
    out
}

impl Page<'_> {
    /// The page. Maps take a while, and Ctrl-C ends that.
    pub(crate) fn html(&self) -> Result<String, Failure> {
        let maps = self.maps()?;
        let scale = Scale::of(maps.iter().map(|map| map.worst));
        let legend = if maps.is_empty() { String::new() } else { scale_bar(scale) };
        let title = format!(
            "{} on {}",
            self.sweep.space.base().name,
            self.sweep.scenes.iter().map(|scene| &*scene.name).collect::<Vec<_>>().join(", ")
        );
        let values = [
            ("TITLE", &*escaped(&title)),
            ("STYLE", STYLE),
            ("ABOUT", &escaped(&self.sweep.space.base().about)),
            ("FACTS", &self.facts()),
            ("COMMAND", &escaped(&self.command)),
            ("TABLE", &self.table()),
            ("SCALE", &legend),
            ("MAPS", &self.figures(&maps, scale)?),
            ("DATA", &data::block(self)),
            ("SCRIPT", SCRIPT),
        ];
        Ok(fill(PAGE, &values))
    }

    /// Names of the fields that differ between budgets.
    fn varied(&self) -> Vec<&'static str> {
        self.sweep.space.axes().iter().map(|axis| axis.field.name()).collect()
    }

    /// Figures of the table, in groups.
    fn columns(&self) -> Vec<&'static str> {
        let wanted = |name: &str| {
            self.objectives.iter().any(|objective| objective.name == name)
                || super::explore::FIGURES.contains(&name)
                || ["luts", "flip-flops", "longest-path"].contains(&name)
        };
        let groups = ["cost", "synthesis", "snap", "arithmetic", "software"];
        let figures = data::figures(self.records);
        let of = |group: &str| {
            let figures = figures.iter().filter(move |f| f.group == group && wanted(f.name));
            figures.map(|figure| figure.name).collect::<Vec<_>>()
        };
        groups.into_iter().flat_map(of).collect()
    }

    /// What was measured, as terms and their descriptions.
    fn facts(&self) -> String {
        let Self { sweep, records, .. } = self;
        let base = sweep.space.base();
        let scenes: Vec<String> = sweep
            .scenes
            .iter()
            .map(|scene| format!("{} ({})", scene.name, counted(scene.triangles.len(), "triangle")))
            .collect();
        let samples = || records.iter().map(|record| record.accuracy.samples);
        let (least, most) = (samples().min().unwrap_or(0), samples().max().unwrap_or(0));
        let samples = if least == most {
            format!("{most}")
        } else {
            format!("{least} to {most}, depending on the grid")
        };
        let axes = sweep.space.axes().iter().map(|axis| {
            let values: Vec<String> = axis.values.iter().map(ToString::to_string).collect();
            format!("{} = {}", axis.field.name(), values.join(", "))
        });
        let front = records.iter().filter(|record| record.pareto).count();
        let numbers = sweep.space.len();
        let of = if numbers == records.len() as u64 {
            String::new()
        } else {
            format!(" of {numbers} combinations")
        };
        let objectives: Vec<&str> = self.objectives.iter().map(|metric| metric.name).collect();
        let facts = [
            ("Profile", base.name.clone()),
            ("Scenes", scenes.join(", ")),
            ("Samples covered", samples),
            ("Window", format!("{} × {} pixels", base.window.width, base.window.height)),
            ("Varied", axes.collect::<Vec<_>>().join("; ")),
            ("Budgets", format!("{}{of}", records.len())),
            ("On the Pareto front", front.to_string()),
            ("Pareto objectives", objectives.join(", ")),
            ("Model", format!("version {MODEL_VERSION}, guardbit {}", env!("CARGO_PKG_VERSION"))),
        ];
        let mut out = String::new();
        for (term, text) in facts.iter().filter(|(_, text)| !text.is_empty()) {
            let _ = writeln!(out, "<div><dt>{term}</dt><dd>{}</dd></div>", escaped(text));
        }
        out
    }

    /// The Pareto front, for readers without a script; a script makes the whole table of it.
    fn table(&self) -> String {
        let (figures, columns) = (data::figures(self.records), self.columns());
        let mut out = "<thead><tr><th>budget</th>".to_owned();
        for name in self.varied() {
            let _ = write!(out, "<th>{name}</th>");
        }
        for name in &columns {
            if let Some(f) = figures.iter().find(|figure| figure.name == *name) {
                let _ =
                    write!(out, "<th class=\"{}\">{name}<small>{}</small></th>", f.group, f.unit);
            }
        }
        out.push_str("</tr></thead>\n<tbody>\n");
        for record in self.records.iter().filter(|record| record.pareto) {
            let _ = write!(out, "<tr><td>{}</td>", record.index);
            for name in self.varied() {
                let found = record.budget.iter().find(|(known, _)| *known == name);
                let text = found.map_or("–".to_owned(), |(_, value)| value.to_string());
                let _ = write!(out, "<td>{text}</td>");
            }
            for name in &columns {
                let text = data::read(record, name).map_or("–".to_owned(), figure);
                let _ = write!(out, "<td>{text}</td>");
            }
            out.push_str("</tr>\n");
        }
        out + "</tbody>"
    }

    /// The maps of the chosen budgets.
    fn maps(&self) -> Result<Vec<Map>, Failure> {
        let chosen = map::chosen(self.records, self.objectives, self.maps);
        let (monitor, done) = (progress::monitor(), AtomicU64::new(0));
        progress::count(chosen.len() as u64, &done, || {
            let mut maps = Vec::new();
            for record in chosen {
                if monitor.cancel.load(Ordering::Relaxed) {
                    return Err(Failure::interrupted(
                        "interrupted while the error maps were drawn",
                    ));
                }
                maps.extend(map::draw(self.sweep, record.index)?);
                done.fetch_add(1, Ordering::Relaxed);
            }
            Ok(maps)
        })
    }

    fn figures(&self, maps: &[Map], scale: Scale) -> Result<String, Failure> {
        let mut out = String::new();
        for map in maps {
            let record = self.records.iter().find(|record| record.index == map.index);
            let fields = record.map_or(String::new(), |record| self.in_words(record));
            let [missing, extra] = map.wrong;
            let pooled = match map.block {
                1 => String::new(),
                block => format!("; each dot shows the worst of {block} × {block} pixels"),
            };
            let [width, height] = map.size;
            let caption = format!(
                "Budget {}: {fields}. {}: worst depth error {} ULP, {missing} missing, {extra} \
                 extra samples{pooled}.",
                map.index,
                map.scene,
                figure(map.worst)
            );
            let caption = escaped(&caption);
            let _ = writeln!(
                out,
                "<figure data-index=\"{}\"><img alt=\"Error map. {caption}\" width=\"{width}\" \
                 height=\"{height}\" src=\"{}\"><figcaption>{caption}</figcaption></figure>",
                map.index,
                map.uri(scale)?
            );
        }
        if maps.is_empty() {
            out.push_str("<p>This page has no error maps; use --maps N to draw N maps.</p>\n");
        }
        Ok(out)
    }

    /// The varied fields of a budget.
    fn in_words(&self, record: &Record) -> String {
        let varied = self.varied();
        let fields = record.budget.iter().filter(|(name, _)| varied.contains(name));
        let words: Vec<String> = fields.map(|(name, value)| format!("{name} {value}")).collect();
        if words.is_empty() { "the profile without changes".to_owned() } else { words.join(", ") }
    }
}

/// What the colours of the maps stand for.
fn scale_bar(scale: Scale) -> String {
    let mut out = format!("<div class=\"scale\"><i style=\"background:{}\"></i>", heat::gradient());
    for mark in scale.marks() {
        let _ = write!(out, "<span>{mark}</span>");
    }
    out + "<b>ULP</b></div>\n"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_filled_in_is_not_searched() {
        assert_eq!(fill("<@A@ @B@>", &[("A", "@B@"), ("B", "x")]), "<@B@ x>");
    }

    #[test]
    fn every_key_of_the_page_is_known() {
        let keys: Vec<&str> = PAGE.split('@').skip(1).step_by(2).collect();
        let known = [
            "TITLE", "STYLE", "TITLE", "ABOUT", "FACTS", "COMMAND", "SCALE", "MAPS", "TABLE",
            "DATA", "SCRIPT",
        ];
        for key in keys {
            assert!(known.contains(&key), "{key}");
        }
    }

    #[test]
    fn text_cannot_leave_its_element() {
        assert_eq!(escaped("<a b=\"&\">"), "&lt;a b=&quot;&amp;&quot;&gt;");
    }
}

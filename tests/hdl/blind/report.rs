//! What `verify --dut` says of a dump, and whether a second dump of the same device agrees.

use serde::Serialize;

/// A report on one dump.
#[derive(Clone, Debug, Default, Serialize)]
pub(super) struct Report {
    /// The exp file that the dump answers.
    pub(super) file: String,
    /// Causes that explain the whole dump. One is said with confidence, several are a choice.
    pub(super) causes: Vec<String>,
    /// The single cause in other words: no row of the set tells them apart.
    pub(super) rivals: Vec<String>,
    /// Where the report places the defect: a unit, and the columns that differ.
    pub(super) placed: Option<(String, String)>,
    /// Classes of tests that differ.
    pub(super) classes: Vec<String>,
    /// The end of the report, as a person reads it.
    pub(super) text: String,
}

impl Report {
    /// Takes a report apart; the only place that knows its form.
    pub(super) fn read(file: &str, text: &str) -> Self {
        let after = |head: &'static str| {
            text.lines().filter_map(move |line| line.trim().strip_prefix(head))
        };
        let mut causes: Vec<String> = after("likely cause: ").map(str::to_owned).collect();
        if let Some((_, list)) = text.split_once("each of which explains the whole dump:\n") {
            let list = list.lines().take_while(|line| line.starts_with(' '));
            causes.extend(list.map(|line| line.trim().to_owned()));
        }
        let same = text.split_once("it is the same as:\n").map_or("", |(_, list)| list);
        let same = same.lines().take_while(|line| line.starts_with(' '));
        let rivals = same.map(|line| line.trim().to_owned()).collect();
        let placed = after("placed: ").next().map(|line| {
            let (unit, columns) = line.split_once(", columns ").unwrap_or((line, ""));
            (unit.to_owned(), columns.to_owned())
        });
        // The head of a mismatch ends with the test: bench, class and index.
        let heads = text.lines().filter(|line| line.contains(".dut.tv"));
        let mut classes: Vec<String> = heads
            .filter_map(|line| Some(line.split(' ').next_back()?.rsplit_once('/')?.0.to_owned()))
            .collect();
        classes.sort_unstable();
        classes.dedup();
        let lines: Vec<&str> = text.lines().collect();
        let end = lines.iter().rposition(|line| line.starts_with("FAIL")).unwrap_or(0);
        let text =
            lines[..lines.len().min(12)].iter().chain(&lines[end.max(12).min(lines.len())..]);
        let text = text.copied().collect::<Vec<_>>().join("\n");
        Self { file: file.to_owned(), causes, rivals, placed, classes, text }
    }

    /// Whether the first unit named is the module.
    pub(super) fn places(&self, module: &str) -> bool {
        self.placed.as_ref().is_some_and(|(unit, columns)| {
            !columns.is_empty() && unit.split(" or ").next() == Some(module)
        })
    }
}

/// What a second set, with another seed and scene, says of a cause.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Trust {
    /// No single cause was named.
    None,
    /// The second dump has nothing to say.
    Open,
    /// The cause explains the second dump, too.
    Confirmed,
    /// The second dump differs, and the cause does not explain it.
    Wrong,
}

/// Files that one device answers share its diagnosis, which stands in the first that differs.
fn device(file: &str) -> &str {
    if ["span", "depth", "triangle"].contains(&file) { "engine" } else { file }
}

/// Holds single causes of the first set's dumps against the dumps of the second.
pub(super) fn trust(first: &[Report], second: &[Report]) -> Trust {
    let verdicts = first.iter().filter(|report| report.causes.len() == 1).map(|report| {
        let mut again =
            second.iter().filter(|other| device(&other.file) == device(&report.file)).peekable();
        if again.peek().is_none() {
            return Trust::Open;
        }
        let named = again.flat_map(|other| other.causes.iter().chain(&other.rivals));
        if named.into_iter().any(|cause| *cause == report.causes[0]) {
            Trust::Confirmed
        } else {
            Trust::Wrong
        }
    });
    verdicts.max().unwrap_or(Trust::None)
}

//! What was found, for people and programs.

use crate::cli::failure::Failure;
use crate::cli::output::Output;
use guardbit::explore::identify::{Case, Decided, Identifier, Next};
use serde_json::json;

/// Profiles that a report lists.
const MOST: usize = 64;
/// Values of a decision that are printed one by one.
const FEW: usize = 6;

/// A finished search.
pub(super) struct Report<'a> {
    pub(super) identifier: &'a Identifier,
    pub(super) cases: &'a [Case],
    /// Places of cases that contradict each other.
    pub(super) conflict: Vec<usize>,
    pub(super) next: Option<Next>,
    /// Why the device was asked no more.
    pub(super) stopped: Option<String>,
}

/// Values in a row as people write them: a range where they are numbers one after another.
fn listed(values: &[String]) -> String {
    let numbers: Option<Vec<u32>> = values.iter().map(|value| value.parse().ok()).collect();
    if let Some(mut numbers) = numbers.filter(|numbers| numbers.len() > 2) {
        numbers.sort_unstable();
        let (low, high) = (numbers[0], numbers[numbers.len() - 1]);
        if (high - low) as usize + 1 == numbers.len() {
            return format!("{low} to {high}");
        }
    }
    match values.get(FEW..).filter(|more| !more.is_empty()) {
        None => values.join(", "),
        Some(more) => format!("{} and {} more", values[..FEW].join(", "), more.len()),
    }
}

impl Report<'_> {
    fn names(&self, places: &[usize]) -> Vec<&str> {
        places.iter().map(|place| self.cases[*place].name.as_str()).collect()
    }

    pub(super) fn print(&self, output: &mut Output) -> Result<(), Failure> {
        let identifier = self.identifier;
        let [machines, depths] = identifier.counts();
        let machines = match identifier.captures() {
            1 => format!("{machines} machines"),
            captures => format!("{} pairs of a machine and a capture", machines * captures as u64),
        };
        let of = match depths {
            0 => machines,
            _ => format!("{machines} with {depths} words of depth each"),
        };
        let (left, cases) = (identifier.left(), self.cases.len());
        if let Some(why) = &self.stopped {
            output.line(format!("stopped: {why}; what was learned so far:"))?;
        }
        if left == 0 {
            output.line(format!("nothing fits: none of {of} agrees with all {cases} cases"))?;
            if !self.conflict.is_empty() {
                let these = match self.conflict.len() {
                    1 => "this case alone".to_owned(),
                    count => format!("these {count} cases together"),
                };
                output.line(format!(
                    "no machine agrees with {these}; leave out any one of this list, and some machine agrees with the rest of it:"
                ))?;
                for name in self.names(&self.conflict) {
                    output.line(format!("  {name}"))?;
                }
            }
            return output.line(
                "the machine decides something else, a case is wrong (--wrong N), or the pictures were moved or mirrored (--shift, --mirror); \
                 --vary and --base try other machines",
            );
        }
        let words = match identifier.depths_left() {
            0 => String::new(),
            words => format!(", with {words} words of depth"),
        };
        let but = match identifier.wrong() {
            0 => String::new(),
            wrong => format!(", of which at most {wrong} may be wrong"),
        };
        output.line(format!("{left} of {of} agree with {cases} cases{but}{words}"))?;
        output.line("")?;
        for Decided { name, values } in identifier.decided() {
            let open = if values.len() > 1 { "   not decided" } else { "" };
            output.line(format!("{name:<20} {}{open}", listed(&values)))?;
        }
        let wrong = identifier.disagreeing(self.cases);
        if !wrong.is_empty() {
            output.line("")?;
            output
                .line(format!("wrong, if it is this machine: {}", self.names(&wrong).join(", ")))?;
        }
        if identifier.depth_waits() {
            output.line("")?;
            output.line("depth was not looked at: too many machines are left; more pictures are needed first")?;
        }
        match &self.next {
            None => {}
            Some(Next::Same { tried }) => {
                output.line("")?;
                output.line(format!(
                    "nothing more to draw: none of {tried} triangles in this window tells what is left apart"
                ))?;
            }
            Some(Next::Draw(probe)) => {
                output.line("")?;
                output.line(format!(
                    "draw next: of {} that were tried, {} answers, and {:.1} left on average",
                    probe.tried, probe.answers, probe.expected
                ))?;
                output.line(probe.line(cases as u64 + 1))?;
            }
        }
        if let Some(found) = identifier.found(1).first() {
            output.line("")?;
            output.line("one of them as a profile, with the widest words that are left:")?;
            output.line("")?;
            output.text(found.profile.to_toml())?;
        }
        Ok(())
    }

    pub(super) fn json(&self, output: &mut Output) -> Result<(), Failure> {
        let identifier = self.identifier;
        let [machines, depths] = identifier.counts();
        let profiles: Vec<String> =
            identifier.found(MOST).iter().map(|found| found.profile.to_toml()).collect();
        let decided: serde_json::Map<String, serde_json::Value> = identifier
            .decided()
            .into_iter()
            .map(|Decided { name, values }| (name, json!(values)))
            .collect();
        let next = match &self.next {
            Some(Next::Draw(probe)) => json!({
                "f": probe.vertices,
                "z": probe.depth,
                "tried": probe.tried,
                "answers": probe.answers,
                "expected": probe.expected,
            }),
            _ => serde_json::Value::Null,
        };
        output.json(&json!({
            "machines": machines,
            "depths": depths,
            "cases": self.cases.len(),
            "left": identifier.left(),
            "depths_left": identifier.depths_left(),
            "decided": decided,
            "wrong": self.names(&identifier.disagreeing(self.cases)),
            "conflict": self.names(&self.conflict),
            "stopped": self.stopped,
            "next": next,
            "profiles": profiles,
        }))
    }
}

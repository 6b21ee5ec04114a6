//! Results of a sweep in a file. Each result is saved at once, so an interrupted sweep can continue, and
//! parts from several computers can be joined. Spec clause `Q-6`.
//!
//! JSON Lines: the first line names the request, each further line one number of its space, with a digest
//! of request and line. What follows from the request alone, such as a budget's cost, is not kept but made
//! again.

use super::record::{Record, Speed};
use super::space::{Point, describe};
use super::sweep::{Found, Sweep};
use crate::measure::accuracy::Accuracy;
use crate::measure::cost::estimate;
use crate::model::MODEL_VERSION;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;

/// The first line of a file.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Header {
    /// `explore`.
    pub guardbit: String,
    /// Version of the model that measured.
    pub model: u32,
    /// SHA-256 of profile, axes and scenes.
    pub request: String,
    /// Numbers in the space.
    pub budgets: u64,
}

/// A further line.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Line {
    index: u64,
    /// Absent for a number that is no budget.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    accuracy: Option<Accuracy>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    operations: Option<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    speed: Option<Speed>,
}

/// What stands before the check of a line.
const CHECK: &str = ",\"check\":\"";

/// The check of a line: the first digits of the SHA-256 of the request and of the line without its check.
fn check(request: &str, line: &str) -> String {
    hex(&Sha256::new().chain_update(request).chain_update(line).finalize()[..8])
}

/// A line with its check.
fn sealed(request: &str, line: &str) -> String {
    let open = line.strip_suffix('}').unwrap_or(line);
    format!("{open}{CHECK}{}\"}}\n", check(request, line))
}

/// A line without its check; what is wrong with it if that does not fit.
fn opened(request: &str, line: &str) -> Result<String, &'static str> {
    let Some((open, _)) = line.rsplit_once(CHECK) else {
        return Err("the line has no check: it was cut, or an older version of guardbit wrote it");
    };
    let text = format!("{open}}}");
    if sealed(request, &text).trim_end() != line {
        return Err("the line was edited: its check does not fit");
    }
    Ok(text)
}

/// A file of results that cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum StoreError {
    /// Not such a file.
    #[error("{path}:{line}: {message}; only `explore --save` writes files of results")]
    Syntax {
        /// The file.
        path: String,
        /// Line, from 1.
        line: usize,
        /// What is wrong.
        message: String,
    },
    /// A line that was edited or cut, or written before lines had a check.
    #[error("{path}:{line}: {what}; delete the line, or the file, and measure again")]
    Edited {
        /// The file.
        path: String,
        /// Line, from 1.
        line: usize,
        /// What is wrong.
        what: &'static str,
    },
    /// Another sweep's results.
    #[error(
        "{path}: the file has the results of another request ({what}); profile, axes, scenes and model \
         version must be the same"
    )]
    Other {
        /// The file.
        path: String,
        /// What differs.
        what: String,
    },
}

impl Header {
    /// The header of a sweep.
    pub fn new(sweep: &Sweep) -> Self {
        let mut hash = Sha256::new();
        hash.update(sweep.space.base().to_toml());
        for axis in sweep.space.axes() {
            let values: Vec<String> = axis.values.iter().map(ToString::to_string).collect();
            hash.update(format!("\n{}={}", axis.field.name(), values.join(",")));
        }
        for scene in &sweep.scenes {
            hash.update(format!("\n{:?}", scene.lens));
            scene.digest(&mut |bytes| hash.update(bytes));
        }
        Self {
            guardbit: "explore".to_owned(),
            model: MODEL_VERSION,
            request: hex(&hash.finalize()),
            budgets: sweep.space.len(),
        }
    }

    /// The first line of a file.
    pub fn line(&self) -> String {
        serde_json::to_string(self).unwrap_or_default() + "\n"
    }

    fn differs(&self, other: &Self) -> Option<String> {
        if self.guardbit != other.guardbit {
            Some(format!("made by `{}`", other.guardbit))
        } else if self.model != other.model {
            Some(format!("model version {}, not {}", other.model, self.model))
        } else if self.budgets != other.budgets {
            Some(format!("{} budgets, not {}", other.budgets, self.budgets))
        } else {
            (self.request != other.request).then(|| "same size, but different contents".to_owned())
        }
    }
}

/// Bytes as hexadecimal digits.
fn hex(bytes: &[u8]) -> String {
    let digit = |nibble: u8| char::from_digit(nibble.into(), 16).unwrap_or('0');
    bytes.iter().flat_map(|byte| [digit(byte >> 4), digit(byte & 15)]).collect()
}

/// The line of a result of a request.
pub fn line(header: &Header, found: &Found) -> String {
    let line = match found {
        Found::Measured(record) => Line {
            index: record.index,
            accuracy: Some(record.accuracy.clone()),
            operations: Some(record.operations_per_fragment),
            speed: record.speed,
        },
        Found::Skipped(index) => {
            Line { index: *index, accuracy: None, operations: None, speed: None }
        }
    };
    sealed(&header.request, &serde_json::to_string(&line).unwrap_or_default())
}

/// Results by number; of two for one number the later counts.
pub type Results = BTreeMap<u64, Found>;

/// Reads a file's results into those of a sweep. A last line that was cut short is passed over:
/// whoever wrote it was interrupted. Returns how many bytes are whole lines.
///
/// # Errors
/// [`StoreError`] with file and line.
pub fn read(
    sweep: &Sweep,
    path: &str,
    text: &str,
    results: &mut Results,
) -> Result<usize, StoreError> {
    let syntax =
        |line, message: String| StoreError::Syntax { path: path.to_owned(), line, message };
    let whole = text.rfind('\n').map_or(0, |end| end + 1);
    let mut lines = (1..).zip(text[..whole].lines());
    let Some((_, first)) = lines.next() else {
        return Err(syntax(1, "the first line must describe the request".to_owned()));
    };
    let header: Header =
        serde_json::from_str(first).map_err(|error| syntax(1, error.to_string()))?;
    if let Some(what) = Header::new(sweep).differs(&header) {
        return Err(StoreError::Other { path: path.to_owned(), what });
    }
    for (number, text) in lines {
        let text = opened(&header.request, text).map_err(|what| {
            let path = path.to_owned();
            StoreError::Edited { path, line: number, what }
        })?;
        let line: Line =
            serde_json::from_str(&text).map_err(|error| syntax(number, error.to_string()))?;
        let index = line.index;
        if index >= sweep.space.len() {
            return Err(syntax(number, format!("index = {index} >= {}", sweep.space.len())));
        }
        let found = restore(sweep, line).ok_or_else(|| {
            syntax(number, format!("number {index} is not a valid budget, but has results"))
        })?;
        results.insert(index, found);
    }
    Ok(whole)
}

fn restore(sweep: &Sweep, line: Line) -> Option<Found> {
    let Line { index, accuracy, operations, speed } = line;
    let (Some(accuracy), Some(operations_per_fragment)) = (accuracy, operations) else {
        return Some(Found::Skipped(index));
    };
    let Ok(Point::Budget(profile)) = sweep.space.point(index) else { return None };
    Some(Found::Measured(Box::new(Record {
        index,
        budget: describe(&profile),
        accuracy,
        cost: estimate(&profile).ok()?,
        operations_per_fragment,
        speed,
        synthesis: None,
        pareto: false,
    })))
}

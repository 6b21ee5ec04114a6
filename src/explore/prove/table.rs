//! Edge widths of the windows that hardware is built for. Spec clause `B-3`.

use super::domain::{Question, QuestionError};
use super::{Proof, edge};
use crate::cover::EdgeStorage;
use crate::explore::corner::widths;
use serde::Serialize;

/// One window: the widths that hold its edge functions whole, and without their low bits.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    /// Stable name.
    pub name: String,
    /// What the window is.
    pub about: String,
    /// The claim `edge.full`.
    pub full: Proof,
    /// The claim `edge.stored`.
    pub stored: Proof,
}

/// Low and high end in pixels, guard band, sub-pixel bits.
type Window = (i64, i64, u32, u32);

const WINDOWS: [(&str, &str, Window); 8] = [
    ("4096-s10", "4096 wide, s = 10", (0, 4096, 0, 10)),
    ("4096-s10-g2048", "4096 wide, s = 10, guard band 2048", (0, 4096, 2048, 10)),
    ("4096-s10-g4096", "4096 wide, s = 10, guard band 4096", (0, 4096, 4096, 10)),
    ("4096-s8", "4096 wide, s = 8", (0, 4096, 0, 8)),
    ("d3d", "Direct3D: -32768 to 32768, s = 8", (-32768, 32768, 0, 8)),
    ("16k", "-16384 to 16384, s = 8", (-16384, 16384, 0, 8)),
    ("2048-s8", "2048 wide, s = 8", (0, 2048, 0, 8)),
    ("8192-s4", "8192 wide, s = 4", (0, 8192, 0, 4)),
];

/// Every row, proved and with its witnesses. The last two rows are the finest grids whose stored
/// word fits 32 bits, found by trying.
///
/// # Errors
/// [`QuestionError`] if a row cannot be; every row of this table can.
pub fn table() -> Result<Vec<Row>, QuestionError> {
    let mut rows = Vec::new();
    for (name, about, window) in WINDOWS {
        rows.push(row(name.to_owned(), about.to_owned(), window)?);
    }
    for high in [2048, 8192] {
        let mut finest = None;
        for s in 1..=16 {
            let question = square((0, high, 0, s))?;
            let (vertices, samples) = (question.vertex_area(), question.sample_area());
            let (_, stored) = widths(vertices, samples, s, question.rule());
            finest = if stored <= 32 { Some(s) } else { finest };
        }
        if let Some(s) = finest {
            let about = format!("{high} wide, s = {s}: the finest grid stored in 32 bits");
            rows.push(row(format!("{high}-s{s}"), about, (0, high, 0, s))?);
        }
    }
    Ok(rows)
}

fn square((low, high, band, s): Window) -> Result<Question, QuestionError> {
    Question::square((low, high), band, s, 64)
}

fn row(name: String, about: String, window: Window) -> Result<Row, QuestionError> {
    let question = square(window)?;
    // A window has no word of its own: the claim is that `bits` are enough.
    let [full, stored] = [EdgeStorage::Full, EdgeStorage::Shifted].map(|storage| Proof {
        row: Some(name.clone()),
        given: None,
        sufficient: true,
        ..edge::word(&question, storage)
    });
    Ok(Row { name, about, full, stored })
}

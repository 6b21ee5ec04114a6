//! Speed measurements, as ratios within one run.
//!
//! Absolute times on shared machines mean little; a ratio of medians of interleaved repeats does.
//! Six sections: the kernels against plain loops, the depth walk by lane and width, the machines
//! by triangle size, speed against accuracy over a ladder of budgets, the quickest way to memory, and
//! the machines that begin at registers.

mod fill;
mod form;
mod lane;
mod ratio;
mod register;
mod timing;
mod trade;

pub use fill::FillRow;
pub use form::{FormRow, SIZES};
pub use lane::LaneRow;
pub use ratio::{Ratios, Row};
pub use register::RegisterRow;
pub use trade::TradeRow;

use serde::Serialize;

/// A part of the measurement.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Section {
    /// The kernels against plain loops, at every processor level.
    Ratios,
    /// The depth walk by lane and width.
    Lanes,
    /// The machines by triangle size, event log off and on.
    Forms,
    /// Speed against accuracy.
    Trade,
    /// Coverage and depth written to memory by the quickest exact path.
    Fill,
    /// Machines that begin at registers.
    Registers,
}

impl Section {
    /// Every section, in the order they are run.
    pub const ALL: [Self; 6] =
        [Self::Ratios, Self::Lanes, Self::Forms, Self::Trade, Self::Fill, Self::Registers];

    /// The name arguments and reports use.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Ratios => "ratios",
            Self::Lanes => "lanes",
            Self::Forms => "forms",
            Self::Trade => "trade",
            Self::Fill => "fill",
            Self::Registers => "registers",
        }
    }
}

/// A whole measurement; a section that was not asked for is empty and left out of JSON.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Report {
    /// Ratios at the best level.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ratios: Option<Ratios>,
    /// Every kernel at every level this machine has.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub rows: Vec<Row>,
    /// The depth walk by lane and width.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub lanes: Vec<LaneRow>,
    /// The machines by triangle size.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub forms: Vec<FormRow>,
    /// Speed against accuracy.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub trade: Vec<TradeRow>,
    /// The quickest exact path.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub fill: Vec<FillRow>,
    /// Machines that begin at registers.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub registers: Vec<RegisterRow>,
    /// What stands out, one line a section.
    pub findings: Vec<Finding>,
}

/// What stands out in a section.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Finding {
    /// Where.
    pub section: Section,
    /// What, in one line.
    pub text: String,
}

/// Measures these sections on one thread, each figure the median of `repeats` interleaved pairs.
pub fn measure(repeats: usize, sections: &[Section]) -> Report {
    let mut report = Report::default();
    for section in Section::ALL.into_iter().filter(|section| sections.contains(section)) {
        let text = match section {
            Section::Ratios => {
                let (ratios, rows) = ratio::measure(repeats);
                report.ratios = Some(ratios);
                report.rows = rows;
                ratio::finding(&report.rows)
            }
            Section::Lanes => {
                report.lanes = lane::measure(repeats);
                lane::finding(&report.lanes)
            }
            Section::Forms => {
                report.forms = form::measure(repeats);
                form::finding(&report.forms)
            }
            Section::Trade => {
                report.trade = trade::measure(repeats);
                trade::finding(&report.trade)
            }
            Section::Fill => {
                report.fill = fill::measure(repeats);
                fill::finding(&report.fill)
            }
            Section::Registers => {
                report.registers = register::measure(repeats);
                register::finding(&report.registers)
            }
        };
        report.findings.push(Finding { section, text });
    }
    report
}

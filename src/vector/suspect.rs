//! Devices that differ from the reference in one thing: what a diagnosis tries on the stimulus of a
//! set. A one-change neighbour of the profile is one, a slip that no profile describes is one. Spec
//! clauses `N-14` and `J-5`.

mod channel;
mod divider;
mod engine;
mod fault;
mod interpolator;
mod reciprocal;
mod register;
mod setup;
mod shape;
mod stepper;
mod triangle;
mod unit;
mod walk;

use super::bench::{Rig, Run, TestBench};
use super::device::Device;
use super::table::RowFormat;

/// The suspects of a bench.
pub trait Suspects {
    /// Each at the bench after a reset, likeliest first, its rows in the form `bin`.
    fn suspects(&self) -> Vec<Suspect<'_>>;
}

/// A device that may be behind a dump.
pub struct Suspect<'b> {
    /// What is different about it, in words.
    pub change: String,
    /// Rows at the very start of a file that the change leaves open: what such a device shows
    /// before its first clock depends on its reset.
    pub unsettled: u64,
    /// How simple the change is: of two that explain a dump alike, the lower is named.
    pub rank: u8,
    /// Whether what it answers in a test depends on no test before it.
    pub forgets: bool,
    /// The module and the part of it that are wrong, if a single part is.
    pub place: Option<(&'static str, &'static str)>,
    /// The device, taken through the tests of the bench.
    pub run: Box<dyn Run + 'b>,
}

impl std::fmt::Debug for Suspect<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.change)
    }
}

impl<'b> Suspect<'b> {
    fn new<B: TestBench>(
        bench: &'b B,
        change: impl Into<String>,
        device: impl Device<B::Test> + 'b,
    ) -> Self {
        let run = Box::new(Rig::new(bench, Box::new(device), RowFormat::Bin));
        Self { change: change.into(), unsettled: 0, rank: 0, forgets: true, place: None, run }
    }

    /// A device with a fault in one part.
    fn at<B: TestBench>(
        bench: &'b B,
        fault: &fault::Fault,
        device: impl Device<B::Test> + 'b,
    ) -> Self {
        let place = Some((fault.module, fault.site));
        let unsettled = fault.unsettled();
        Self {
            place,
            unsettled,
            rank: fault.rank(),
            forgets: !fault.remembers(),
            ..Self::new(bench, fault.text.clone(), device)
        }
    }
}

//! How few bits are enough for a whole window and guard band, and how that is known.
//! Spec clauses `B-1` to `B-11`.
//!
//! Each claim comes in two halves. That `bits` are enough follows from a growth inequality of the
//! specification, evaluated with the question's numbers. That one bit fewer is not enough is shown
//! by a witness: a triangle and a sample that [`crate::model`] draws wrong with one bit fewer and
//! right with `bits`, judged by [`crate::exact`]. Where no witness is known, none is given.
//!
//! ```
//! use guardbit::{explore::prove, profile};
//! let question = prove::Question::new(&profile::load("sgi-4k")?, prove::Overrides::default())?;
//! let stored = &prove::prove(&question)[0];
//! assert_eq!((&*stored.claim, stored.bits, stored.sufficient), ("edge.stored", Some(35), true));
//! assert_eq!(stored.witness.as_ref().map(|witness| witness.bits), Some(34));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod carried;
mod channel;
mod channel_formal;
mod conservative;
mod corrected;
mod correction;
mod depth;
mod domain;
mod edge;
mod edge_coefficient;
mod edge_formal;
mod formal;
mod gappa;
mod guard;
mod plane;
mod plane_witness;
mod slope;
mod smt;
mod snap_witness;
mod solver;
mod table;
mod text;
mod trial;
mod walk;
mod walk_coverage;
mod walk_range;

pub use domain::{Overrides, Question, QuestionError, W_RATIO};
pub use gappa::script as gappa;
pub use smt::script as smt;
pub use solver::{Answer, Check, Solver, check};
pub use table::{Row, table};

use crate::setup::Triangle;
use serde::Serialize;

/// A claim on a number of bits, and what it rests on.
#[derive(Clone, Debug, Serialize)]
pub struct Proof {
    /// Stable name, `topic.fact`.
    pub claim: String,
    /// The row of [`table()`] it belongs to.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub row: Option<String>,
    /// What is counted, where it is not bits.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unit: Option<&'static str>,
    /// Window, grid and vertex box that it is made for.
    pub place: String,
    /// What is claimed, in a few sentences.
    pub statement: String,
    /// How far a code of a channel is off at most with the bits that the profile has, in ULP; a fraction such as
    /// `577/512`. None where no bound is proved, and in claims that are not about codes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub error: Option<String>,
    /// The fewest bits proved to suffice; none where no number of bits is.
    pub bits: Option<u32>,
    /// The bits that the profile has, where it has such a word.
    pub given: Option<u32>,
    /// Whether the profile's bits are proved enough; without `given`, whether `bits` are.
    pub sufficient: bool,
    /// The inequality, with its numbers.
    pub bound: String,
    /// The clause of the specification it is an instance of.
    pub clause: &'static str,
    /// What goes wrong with one bit fewer; without one the bound is not known to be tight.
    pub witness: Option<Witness>,
    /// The same claim for other provers.
    #[serde(skip)]
    pub(in crate::explore) formal: formal::Formal,
}

/// A case that fails with too few bits. Coordinates are the question's own, in sub-pixels.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Witness {
    /// The bits at which it fails.
    pub bits: u32,
    /// What drew it: `model`, or `word` for a register that the model has no width for.
    pub by: &'static str,
    /// The vertices of the triangle.
    pub triangle: Vec<[i128; 2]>,
    /// Their depths, if it is about depth.
    pub depths: Option<[i128; 3]>,
    /// Their codes, if it is about a channel.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub codes: Option<[i128; 3]>,
    /// The edge at fault, from vertex to vertex.
    pub edge: Option<[[i128; 2]; 2]>,
    /// The pixel.
    pub pixel: Option<[i128; 2]>,
    /// The sample of that pixel.
    pub sample: Option<[i128; 2]>,
    /// The exact truth.
    pub expected: String,
    /// What came out.
    pub got: String,
}

impl Witness {
    /// A triangle, with its depths, that the model draws with so many bits: what is true and what came out.
    fn drawn(bits: u32, triangle: &Triangle, expected: String, got: String) -> Self {
        Self {
            bits,
            by: "model",
            triangle: triangle.xy.to_vec(),
            depths: triangle.z,
            codes: None,
            edge: None,
            pixel: None,
            sample: None,
            expected,
            got,
        }
    }
}

impl Proof {
    /// `enough`, `TOO FEW`, or what else is known.
    pub fn verdict(&self) -> &'static str {
        match (self.sufficient, self.witness.is_some()) {
            (true, _) => "enough",
            (false, true) => "TOO FEW",
            (false, false) => "NOT PROVED",
        }
    }
}

/// Every claim that the question's profile calls for; the stored edge width comes first.
pub fn prove(question: &Question) -> Vec<Proof> {
    // Counterexamples of coverage and depth are drawn without channels.
    let plain = question.without_channels();
    let mut proofs = if let Some(config) = plain.profile.conservative() {
        conservative::proofs(&plain, config)
    } else {
        let mut proofs = edge::proofs(&plain);
        proofs.extend(walk::proofs(&plain));
        proofs.extend(depth::proofs(&plain));
        proofs
    };
    proofs.extend(channel::proofs(question));
    proofs
}

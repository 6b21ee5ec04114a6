//! Bit-exact fixed-point reference model for triangle rasterization hardware.
//!
//! A [`profile::Profile`] is the configuration of a rasterizer: bits, rounding, overflow, fill rule,
//! algorithm. A [`scene::Scene`] is the geometry to draw. Nothing else has an effect on the output: the
//! same profile and scene give the same bytes on any computer, with any number of threads.
//!
//! ```
//! use guardbit::{model::{Drawing, Model}, profile, scene};
//! let model = Model::new(&profile::load("sgi-4k")?)?;
//! // Two pixels on a side, in sub-pixels of 1/1024; depths in codes.
//! let xy = [[0, 0], [2048, 0], [0, 2048]];
//! let triangle = model.snap(&scene::Triangle::Lattice { xy, z: Some([0, 40, 80]) })?;
//! let mut drawing = Drawing::default();
//! model.draw(&triangle, &mut drawing)?;
//! // The centre of pixel (0, 0) lies a quarter along both edges: 0 + 10 + 20. The centres of
//! // (1, 0) and (0, 1) lie on the long edge, which faces right and owns nothing.
//! assert_eq!((drawing.samples(), drawing.depth[0]), (1, 30));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Which type do I need?
//!
//! | I want to | types |
//! | --- | --- |
//! | add words as a register does | [`bits::Word`] with [`bits::Bits`], [`format::Q`] or [`format::QFormat`] |
//! | round a shift or a quotient | [`bits::Rounding`] |
//! | walk a line or a plane | [`dda::Linear`], [`dda::Planar`], [`dda::Walker`] for one operation a clock |
//! | decode guard bits | [`format::ReadOut`], [`format::Clamp`] |
//! | keep an exact value and its units | [`format::Unreduced`] |
//! | load a rasterizer | [`profile::load`], [`profile::Profile`] |
//! | draw | [`model::Model`], [`scene::Primitive`], [`model::Drawing`] or a [`machine::Sink`] of your own |
//! | draw coverage and depth into memory, quickly | [`model::Raster`] |
//! | describe a rasterizer of my own | [`machine::Rasterizer`], [`machine::Machine`] |
//! | compare with exact arithmetic | [`exact::Rational`], [`exact::covers`] |
//!
//! With the feature `verification`: golden sets (`vector`), accuracy and cost (`measure`), sweeps and proofs
//! (`explore`), JSON Lines (`scene::lines`). With `laboratory`: the claims and the speed measurements. With
//! `cli`, the default: the command.
//!
//! # The modules
//!
//! The modules, from the lowest to the highest; each imports only from the modules before it:
//!
//! 1. [`bits`]: words, rounding, numeric events, hexadecimal text
//! 2. [`mod@format`]: Q-formats, the guard clamp, budgets, conversions from and to the `fixed` crate
//! 3. [`exact`]: exact rational arithmetic and big integers, with which all results are compared
//! 4. [`dda`]: accumulators and slopes: closed forms, fast kernels, and their naive references
//! 5. [`setup`]: snapping, exact edges, planes, division
//! 6. [`cover`]: fill rules, samples, edge words, runs
//! 7. [`value`]: the depth plane
//! 8. [`machine`]: rasterizers: one folder for each, one list of them, and the trait that all higher modules use
//! 9. [`profile`]: the configurations of the modules above in one TOML file
//! 10. [`scene`]: triangles, meshes, a camera, built-in scenes
//! 11. [`model`]: a validated profile that draws; the entry point to all modules before it
//! 12. `case`: test stimulus by class, determined by seed, class and index
//! 13. `measure`: error, cost, speed, budgets
//! 14. `vector`: golden sets, their verification, diagnosis of device dumps, references in one file, proofs of a
//!     module's equivalence
//! 15. `explore`: sweeps and searches over budgets, proofs of how few bits are enough, known facts recomputed
//!
//! The feature `cli` adds the command. Your own program can call `cli::main` with your own machines; it is
//! then the same command with these machines in addition.
//!
//! The specification in `spec/` is normative; documentation cites its clauses as `G-2`.

#![cfg_attr(
    not(feature = "verification"),
    allow(dead_code, reason = "the floors above drawing use what drawing alone does not")
)]

// The command's files name the library as any other program does.
#[cfg(feature = "cli")]
extern crate self as guardbit;

pub mod bits;
#[cfg(feature = "verification")]
pub mod case;
#[cfg(feature = "cli")]
#[allow(
    rustdoc::broken_intra_doc_links,
    rustdoc::invalid_html_tags,
    reason = "comments of arguments are help texts, whose brackets are no links"
)]
pub mod cli;
pub mod cover;
pub mod dda;
pub mod exact;
#[cfg(feature = "verification")]
pub mod explore;
pub mod format;
pub mod machine;
#[cfg(feature = "verification")]
pub mod measure;
pub mod model;
pub mod profile;
pub mod scene;
pub mod setup;
pub mod value;
#[cfg(feature = "verification")]
pub mod vector;

/// The Rust examples of the specification, run as documentation tests.
#[cfg(doctest)]
mod spec {
    macro_rules! texts {
        ($($name:ident $file:literal),*) => {$(
            #[doc = include_str!(concat!("../spec/", $file))]
            struct $name;
        )*};
    }
    texts!(
        Words "01-words.md", Events "02-events.md", Formats "03-formats.md",
        Setup "04-setup.md", Coverage "05-coverage.md", Values "06-values.md",
        EdgeWalk "07-edge-walk.md", Stimulus "08-stimulus.md",
        Bounds "10-bounds.md", Cost "11-cost.md",
        Measures "12-measures.md", Search "13-search.md",
        Lines "14-lines.md", Polygons "15-polygons.md", Depth "16-depth.md",
        Interpolation "17-interpolation.md",
        Multisample "18-multisample.md", Machines "19-machines.md", Traversal "20-traversal.md",
        Hardware "21-hardware.md", Registers "22-registers.md", Describe "23-describe.md",
        Channels "24-channels.md",
        Identify "25-identify.md",
        Envelope "26-envelope.md",
        Conservative "27-conservative.md",
        EdgeRegisters "28-edge-registers.md",
        LineRegisters "29-line-registers.md",
        Front "30-front.md"
    );
}

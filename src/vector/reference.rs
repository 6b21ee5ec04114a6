//! A profile as a reference in one file, for those who build their own: C, C++, Python, SystemVerilog. Spec
//! clause `J-8`.

mod choose;
mod parts;
mod register;
mod shape;
mod stimulus;

use super::package::identifier;
use super::write::{self, Devices};
use crate::bits::Rounding;
use crate::profile::Profile;
use crate::setup::Triangle;
use parts::Parts;
use register::RegisterText;
use shape::Shape;

/// The language of a reference.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "cli", derive(clap::ValueEnum))]
pub enum Language {
    /// SystemVerilog, synthesizable: a package of functions, and modules.
    Sv,
    /// C99 with integers of 128 bits.
    C,
    /// A header in C++17, all of it `constexpr`.
    Cpp,
    /// Python 3, without any package.
    Python,
}

/// Why a profile has no reference.
#[derive(Clone, Debug, thiserror::Error, PartialEq, Eq)]
#[error("{profile}: no reference can be written of it: {reason}")]
pub struct ReferenceError {
    /// The profile's name.
    pub profile: String,
    /// What stands in the way.
    pub reason: String,
}

/// Random cases of the self test.
const CASES: u64 = 1000;

/// The text of a profile's reference: the same for the same profile.
///
/// # Errors
/// [`ReferenceError`] where the machine is none of those that a reference can be written of (clause `J-8`), or
/// depth asks for what no reference does.
///
/// ```
/// use guardbit::vector::reference::{Language, reference};
/// let text = reference(&guardbit::profile::load("sgi-4k")?, Language::Python)?;
/// assert!(text.contains("\nEDGE_BITS, EDGE_SHIFT = 35, 10 "));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn reference(profile: &Profile, language: Language) -> Result<String, ReferenceError> {
    if let Some(registers) = registers(profile)? {
        return registers.text(language).map_err(|reason| refused(profile, reason));
    }
    let parts = Parts::of(profile, shape(profile)?);
    Ok(match language {
        Language::C | Language::Cpp => parts.c(language == Language::Cpp),
        Language::Python => parts.python(),
        Language::Sv => parts.systemverilog(),
    })
}

/// The digests of random cases, as every exported reference works them out: of the DDA if there is depth, the
/// edge stepper or the walked x, the set-up and the samples. A machine that begins at registers has one digest, of
/// its records.
///
/// # Errors
/// [`ReferenceError`] as [`reference()`] has them.
pub fn digests(profile: &Profile, seed: u64, cases: u64) -> Result<Vec<u64>, ReferenceError> {
    if let Some(registers) = registers(profile)? {
        return Ok(vec![registers.digest(seed, cases)]);
    }
    Ok(stimulus::digests(profile, &shape(profile)?, seed, cases))
}

/// The triangles of the self test, and more of them.
pub(super) fn triangles(profile: &Profile, devices: &Devices, count: u64) -> Vec<Triangle> {
    stimulus::triangles(profile, devices.depth.integer, count)
}

fn refused(profile: &Profile, reason: String) -> ReferenceError {
    ReferenceError { profile: profile.name.clone(), reason }
}

/// What a reference of a profile with registers is written of.
fn registers(profile: &Profile) -> Result<Option<RegisterText<'_>>, ReferenceError> {
    RegisterText::of(profile).map_err(|reason| refused(profile, reason))
}

/// What a reference of a profile is written of.
fn shape(profile: &Profile) -> Result<Shape, ReferenceError> {
    Shape::of(profile).map_err(|reason| refused(profile, reason))
}

/// What draws a profile whose units can be proved, or why there is none.
pub(super) fn devices(profile: &Profile) -> Result<Devices, ReferenceError> {
    write::devices(profile).map_err(|reason| refused(profile, reason))
}

/// The SystemVerilog package of a profile; its modules begin with this name.
pub(super) fn package(profile: &Profile) -> String {
    format!("{}_reference", identifier(&profile.name))
}

/// When the magnitude of a quotient is raised, in C and SystemVerilog. Clause `R-1`.
pub(super) const fn rounds_up(rounding: Rounding) -> &'static str {
    match rounding {
        Rounding::Floor => "inexact && negative",
        Rounding::Ceiling => "inexact && !negative",
        Rounding::TowardZero => "0",
        Rounding::AwayFromZero => "inexact",
        Rounding::NearestEven => "over || (tie && odd)",
        Rounding::NearestUp => "over || (tie && !negative)",
        Rounding::NearestDown => "over || (tie && negative)",
        Rounding::NearestAway => "over || tie",
        Rounding::NearestTowardZero => "over",
        Rounding::Odd => "inexact && !odd",
    }
}

//! A profile as a reference in one file, for those who build their own: C, C++, Python, SystemVerilog. Spec
//! clause `J-8`.

mod stimulus;

use super::manifest::sha256;
use super::package::{comment, fill, identifier};
use super::write::{self, Devices};
use crate::bits::Rounding;
use crate::cover::EdgeWordConfig;
use crate::format::{Clamp, ReadOut};
use crate::model::MODEL_VERSION;
use crate::profile::Profile;
use crate::setup::Triangle;

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

/// What the texts are filled in with.
struct Parts<'a> {
    profile: &'a Profile,
    read: ReadOut,
    edge: EdgeWordConfig,
    digests: [u64; 4],
    values: Vec<(&'static str, String)>,
}

/// The text of a profile's reference: the same for the same profile.
///
/// # Errors
/// [`ReferenceError`] where the profile is none of edge functions and a depth plane over a box, one sample a
/// pixel.
///
/// ```
/// use guardbit::vector::reference::{Language, reference};
/// let text = reference(&guardbit::profile::load("sgi-4k")?, Language::Python)?;
/// assert!(text.contains("\nEDGE_BITS, EDGE_SHIFT = 35, 10 "));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn reference(profile: &Profile, language: Language) -> Result<String, ReferenceError> {
    let parts = Parts::of(profile)?;
    Ok(match language {
        Language::C | Language::Cpp => parts.c(language == Language::Cpp),
        Language::Python => parts.python(),
        Language::Sv => parts.systemverilog(),
    })
}

/// The digests of random cases, as every exported reference works them out: of the DDA, the edge stepper, the
/// set-up and the samples.
///
/// # Errors
/// [`ReferenceError`] as [`reference()`] has them.
pub fn digests(profile: &Profile, seed: u64, cases: u64) -> Result<[u64; 4], ReferenceError> {
    Ok(stimulus::digests(profile, devices(profile)?.registers(), seed, cases))
}

/// The triangles of the self test, and more of them.
pub(super) fn triangles(profile: &Profile, devices: &Devices, count: u64) -> Vec<Triangle> {
    stimulus::triangles(profile, devices.depth.integer, count)
}

/// What draws a profile, or why it has no reference.
pub(super) fn devices(profile: &Profile) -> Result<Devices, ReferenceError> {
    write::devices(profile)
        .map_err(|reason| ReferenceError { profile: profile.name.clone(), reason })
}

/// The SystemVerilog package of a profile; its modules begin with this name.
pub(super) fn package(profile: &Profile) -> String {
    format!("{}_reference", identifier(&profile.name))
}

impl<'a> Parts<'a> {
    fn of(profile: &'a Profile) -> Result<Self, ReferenceError> {
        let devices = devices(profile)?;
        let registers = devices.registers();
        let Devices { edge, depth, setup } = devices;
        let digests = stimulus::digests(profile, registers, 1, CASES);
        let side = if setup.shadow { "ey > 0" } else { "ey < 0" };
        let (low, high) = profile.vertex.range();
        let mut values = vec![
            ("SET", comment(&profile.name)),
            ("GUARDBIT", env!("CARGO_PKG_VERSION").to_owned()),
            ("VERSION", MODEL_VERSION.to_string()),
            ("DIGEST", sha256(profile.to_toml().as_bytes())),
            ("ROUNDING", depth.rounding.to_string()),
            ("CLAMP", depth.clamp.name().to_owned()),
            ("OWNS", format!("{side} || (ey == 0 && ex > 0)")),
            ("UP", rounds_up(depth.rounding).to_owned()),
        ];
        let mut number = |key, value: i128| values.push((key, value.to_string()));
        number("WIDTH", profile.window.width.into());
        number("HEIGHT", profile.window.height.into());
        number("S", setup.sub_pixel.into());
        number("SAMPLE_X", setup.sample[0]);
        number("SAMPLE_Y", setup.sample[1]);
        number("LOW", low);
        number("HIGH", high);
        number("D", profile.vertex.difference_bits().into());
        number("M", edge.width.into());
        number("SHIFT", setup.shift.into());
        number("G", depth.guard.into());
        number("I", depth.integer.into());
        number("F", depth.interpolation.into());
        number("N", registers[0].width().into());
        number("HALF", depth.start_gain());
        number("CASES", CASES.into());
        Ok(Self { profile, read: registers[0], edge, digests, values })
    }

    fn fill(&self, template: &str, own: &[(&str, &str)]) -> String {
        let shared = self.values.iter().map(|(key, value)| (*key, value.as_str()));
        // What is filled in has keys of its own.
        let values: Vec<(&str, &str)> = own.iter().copied().chain(shared).collect();
        fill(template, &values)
    }

    /// Every word and product of a valid profile fits 128 bits (clause `P-5`).
    fn c(&self, plus: bool) -> String {
        let id = identifier(&self.profile.name);
        let upper = format!("{}_", id.to_uppercase());
        let prefix = if plus { String::new() } else { format!("{id}_") };
        let scope = if plus { format!("{id}::") } else { prefix.clone() };
        let word = |width| if width > 64 { format!("{prefix}bits") } else { "uint64_t".to_owned() };
        let digests = self.digests.map(|digest| format!("0x{digest:016x}u"));
        let read = match self.read.clamp() {
            Clamp::Guard | Clamp::Error => {
                "    const @P@bits middle = ((@P@bits)1 << (@K@GUARD + @K@INTEGER - 1)) + (whole >> 1);\n    \
                 if (u >= whole) return u >= middle ? 0 : (uint64_t)(whole - 1);"
            }
            Clamp::Sign => {
                "    if ((acc >> (@K@DEPTH_BITS - 1) & 1) != 0) return 0;\n    \
                 if (u >= whole) return (uint64_t)(whole - 1);"
            }
            Clamp::Wrap | Clamp::Saturate => "",
        };
        self.fill(
            include_str!("reference/c.in"),
            &[
                ("OPEN", &if plus { format!("namespace {id} {{") } else { String::new() }),
                ("CLOSE", if plus { "}" } else { "" }),
                ("FN", if plus { "constexpr" } else { "static inline" }),
                ("READ_OUT", read),
                ("EDGE", &word(self.edge.width)),
                ("WORD", &word(self.read.width())),
                ("EXPECTED", &digests.join(", ")),
                ("P", &prefix),
                ("K", &upper),
                ("Q", &scope),
            ],
        )
    }

    fn python(&self) -> String {
        let read = match self.read.clamp() {
            Clamp::Guard | Clamp::Error => {
                "    if u >= whole:\n        \
                 return 0 if u >= (1 << GUARD + INTEGER >> 1) + (whole >> 1) else whole - 1"
            }
            Clamp::Sign => {
                "    if acc >> (DEPTH_BITS - 1):\n        return 0\n    \
                 if u >= whole:\n        return whole - 1"
            }
            Clamp::Wrap | Clamp::Saturate => "",
        };
        let digests = self.digests.map(|digest| format!("0x{digest:016X}"));
        let words = |key: &str| {
            let (_, text) =
                self.values.iter().find(|(known, _)| *known == key).cloned().unwrap_or_default();
            text.replace("||", "or").replace("&&", "and").replace('!', "not ")
        };
        self.fill(
            include_str!("reference/py.in"),
            &[
                ("READ_OUT", read),
                ("EXPECTED", &digests.join(", ")),
                ("UP", &words("UP")),
                ("OWNS", &words("OWNS")),
            ],
        )
    }

    fn systemverilog(&self) -> String {
        let read = match self.read.clamp() {
            Clamp::Guard | Clamp::Error => {
                "            \
                 if (u >= WHOLE) read_out = u >= (WHOLE << G >> 1) + (WHOLE >> 1) ? {I{1'b0}} : {I{1'b1}};"
            }
            Clamp::Sign => {
                "            if (acc[N-1]) read_out = {I{1'b0}};\n            \
                 else if (u >= WHOLE) read_out = {I{1'b1}};"
            }
            Clamp::Wrap | Clamp::Saturate => "",
        };
        let [e0, e1, e2, e3] = self.digests.map(|digest| format!("{digest:016x}"));
        let package = package(self.profile);
        self.fill(
            include_str!("reference/sv.in"),
            &[
                ("READ_OUT", read),
                ("E0", &e0),
                ("E1", &e1),
                ("E2", &e2),
                ("E3", &e3),
                ("P", &package),
            ],
        )
    }
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

//! The words of a profile and their fields.

pub use crate::machine::{Fact, Word, WordField as Field};

use crate::machine::steps_below_half;
use crate::profile::{InvalidProfile, Profile};
use serde::Serialize;

/// A profile's words.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// Profile name.
    pub profile: String,
    /// Its one-line description.
    pub about: String,
    /// Vertex, edge and depth words.
    pub words: Vec<Word>,
}

fn fact(name: &'static str, value: &(impl ToString + ?Sized)) -> Fact {
    Fact { name, value: value.to_string() }
}

fn field(name: &'static str, bits: u32) -> Field {
    Field { name, bits }
}

/// `numerator / 2^shift` as an exact decimal fraction of at most three digits, or a power.
fn dyadic(numerator: i128, shift: u32) -> String {
    if shift == 0 {
        return numerator.to_string();
    }
    let whole = numerator >> shift;
    let rest = numerator - (whole << shift);
    if rest == 0 { whole.to_string() } else { format!("{numerator}/2^{shift}") }
}

/// Takes a profile's words apart.
///
/// # Errors
/// [`InvalidProfile`] names the violated inequality.
pub fn report(profile: &Profile) -> Result<Report, InvalidProfile> {
    profile.validate()?;
    let vertex = profile.vertex;
    let size = (profile.window.width, profile.window.height);
    let (low, high) = vertex.range();
    let mut words = vec![Word {
        name: "vertex".to_owned(),
        width: vertex.integer + vertex.sub_pixel,
        fields: vec![field("integer", vertex.integer), field("sub-pixel", vertex.sub_pixel)],
        facts: vec![
            fact(
                "range",
                &format!(
                    "{} to {} pixels",
                    dyadic(low, vertex.sub_pixel),
                    dyadic(high, vertex.sub_pixel)
                ),
            ),
            fact("resolution", &format!("1/{} pixel", 1u64 << vertex.sub_pixel)),
            fact("snap", &vertex.snap),
            fact("difference", &format!("{} bits", vertex.difference_bits())),
        ],
    }];
    words.extend(profile.form.words(&profile.state()));
    if let Some(depth) = profile.depth {
        let read = depth.validate(&vertex)?;
        let (lowest, limit) = read.range();
        let longest = u64::from(size.0 - 1) + u64::from(size.1 - 1);
        let mut facts = vec![
            fact("codes", &format!("0 to {}", read.maximum())),
            fact("clamp", depth.clamp.name()),
        ];
        if !matches!(depth.clamp, crate::format::Clamp::Saturate) {
            let [from, to] = [lowest, limit].map(|end| dyadic(end, read.fraction()));
            facts.push(fact("range", &format!("[{from}, {to}) ULP")));
        }
        facts.extend([
            fact("resolution", &format!("2^-{} ULP", depth.interpolation)),
            fact("rounding", &depth.rounding),
        ]);
        if profile.form.walks_a_plane() {
            let steps = steps_below_half(depth.interpolation, depth.rounding);
            facts.push(fact("below half an ULP", &format!("for {steps} steps")));
            facts.push(fact("longest walk", &format!("{longest} steps")));
        } else {
            let own = "no plane is walked: compare and explore measure this machine's own error";
            facts.push(fact("half an ULP", &own));
        }
        words.push(Word {
            name: "depth".to_owned(),
            width: read.width(),
            fields: vec![
                field("guard", depth.guard),
                field("integer", depth.integer),
                field("interpolation", depth.interpolation),
            ],
            facts,
        });
    }
    Ok(Report { profile: profile.name.clone(), about: profile.about.clone(), words })
}

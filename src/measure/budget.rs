//! The words of a profile, taken apart.

use crate::cover::SampleGrid;
use crate::machine::{EngineConfig, RegisterConfig, ScanlineConfig, SlopeEdges};
use crate::profile::{Form, InvalidProfile, Profile};
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

/// One word.
#[derive(Clone, Debug, Serialize)]
pub struct Word {
    /// `vertex`, `edge`, `share`, `depth`, or the channels that share it.
    pub name: String,
    /// Bits in all.
    pub width: u32,
    /// Bits by purpose, most significant first.
    pub fields: Vec<Field>,
    /// Range, resolution and the like.
    pub facts: Vec<Fact>,
}

/// Bits of one purpose.
#[derive(Clone, Debug, Serialize)]
pub struct Field {
    /// Purpose.
    pub name: &'static str,
    /// Bits.
    pub bits: u32,
}

/// A property of a word.
#[derive(Clone, Debug, Serialize)]
pub struct Fact {
    /// What.
    pub name: &'static str,
    /// How much, with its unit.
    pub value: String,
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
/// [`InvalidProfile`] if its parts do not go together.
pub fn report(profile: &Profile) -> Result<Report, InvalidProfile> {
    profile.validate()?;
    let (grid, vertex) = (profile.grid()?, profile.vertex);
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
    if let Form::Registers(machine) = &profile.form {
        words.extend(register_words(machine));
        return Ok(Report { profile: profile.name.clone(), about: profile.about.clone(), words });
    }
    words.push(coverage_word(profile, &grid));
    if let Form::Barycentric(machine) = profile.form {
        let width = machine.coordinate_width();
        words.push(Word {
            name: "share".to_owned(),
            width,
            fields: vec![field("integer", 2), field("fraction", machine.coordinate)],
            facts: vec![
                fact("resolution", &format!("2^-{}", machine.coordinate)),
                fact("rounding", &machine.rounding),
            ],
        });
    }
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
            fact(
                "below half an ULP",
                &format!("for {} steps", steps(depth.interpolation, depth.rounding)),
            ),
            fact("longest walk", &format!("{longest} steps")),
        ]);
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

/// The edge word of an engine, if it has one, and those of its channels.
fn register_words(machine: &RegisterConfig) -> Vec<Word> {
    let edge = |fields: Vec<Field>, facts| {
        let width = fields.iter().map(|field| field.bits).sum();
        Word { name: "edge".to_owned(), width, fields, facts }
    };
    let fraction = |bits: u32| fact("resolution", &format!("2^-{bits} pixel"));
    let mut words = match &machine.engine {
        EngineConfig::Quads(quads) => {
            vec![edge(vec![field("edge", quads.width)], vec![fact("beyond its range", "wraps")])]
        }
        EngineConfig::Slopes(slopes) => {
            let (SlopeEdges::Divided { fraction: bits, .. }
            | SlopeEdges::Given { fraction: bits, .. }) = slopes.edges;
            vec![edge(
                vec![field("integer", 32 - bits), field("fraction", bits)],
                vec![fraction(bits)],
            )]
        }
        EngineConfig::SubScanlines(_) => vec![edge(
            vec![field("guard", 2), field("integer", 10), field("fraction", 16)],
            vec![fraction(16), fact("rows", "four sub-scanlines each")],
        )],
        // Its sides are exact.
        EngineConfig::Anchored(_) => Vec::new(),
    };
    words.extend(machine.channels.iter().map(|channel| {
        let (guard, integer, interpolation) =
            (channel.guard, channel.integer, channel.interpolation);
        let read = guard + integer + interpolation;
        let width = channel.width.unwrap_or(read);
        let bits = [
            ("above", width - read),
            ("guard", guard),
            ("integer", integer),
            ("interpolation", interpolation),
        ];
        let fields = bits.into_iter().filter(|(_, bits)| *bits > 0);
        Word {
            name: channel.names.join(", "),
            width,
            fields: fields.map(|(name, bits)| field(name, bits)).collect(),
            facts: vec![
                fact("clamp", channel.clamp.name()),
                fact("resolution", &format!("2^-{interpolation} of a code")),
            ],
        }
    }));
    words
}

/// How many steps after a rounded start keep the accumulated error below half a result unit:
/// the most n with (n + 1) e < 1/2, e the bound of one rounding.
fn steps(fraction: u32, rounding: crate::bits::Rounding) -> u128 {
    // A nearest rounding errs by at most 2^-(F+1), reached, so the sum must be strictly less; any
    // other errs by strictly less than 2^-F, so the sum of the bounds may reach one half.
    if rounding.is_nearest() {
        (1u128 << fraction).saturating_sub(2)
    } else {
        (1u128 << fraction >> 1).saturating_sub(1)
    }
}

/// The word that decides coverage; a scanline machine's is as wide as its vertices ask.
fn coverage_word(profile: &Profile, grid: &SampleGrid) -> Word {
    let vertex = &profile.vertex;
    let size = (profile.window.width, profile.window.height);
    if let Some(edges) = profile.form.edge() {
        let exact = edges.exact_width(vertex, grid, size);
        let verdict = match edges.width.cmp(&exact) {
            std::cmp::Ordering::Less => "too narrow: edge words can wrap",
            std::cmp::Ordering::Equal => "exactly enough",
            std::cmp::Ordering::Greater => "more than enough",
        };
        return Word {
            name: "edge".to_owned(),
            width: edges.width,
            fields: vec![field("edge", edges.width)],
            facts: vec![
                fact("range", &format!("-2^{0} to 2^{0} - 1", edges.width - 1)),
                fact("exact in this window", &format!("{exact} bits: {verdict}")),
            ],
        };
    }
    if let Some(walk) = profile.form.walk() {
        let rows = steps(walk.fraction.saturating_sub(vertex.sub_pixel), walk.rounding);
        return Word {
            name: "edge".to_owned(),
            width: walk.guard + walk.integer + walk.fraction,
            fields: vec![
                field("guard", walk.guard),
                field("integer", walk.integer),
                field("fraction", walk.fraction),
            ],
            facts: vec![
                fact("resolution", &format!("2^-{} pixel", walk.fraction)),
                fact("rounding", &walk.rounding),
                fact("half a sub-pixel", &format!("after {rows} rows")),
            ],
        };
    }
    let width = match &profile.form {
        Form::Homogeneous(machine) => machine.edge_width(vertex),
        _ => ScanlineConfig::width(vertex),
    };
    Word {
        name: "edge".to_owned(),
        width,
        fields: vec![field("edge", width)],
        facts: vec![fact("exact", "as wide as the vertex field asks")],
    }
}

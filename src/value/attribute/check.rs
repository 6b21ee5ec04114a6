//! What is checked of channels, each by itself and all together. Spec clauses `CH-1`, `CH-2` and `CH-8`.

use super::{AttributeConfig, AttributeError, COMPONENTS, Correction, InverseWConfig};
use crate::format::{Clamp, ReadOut};
use crate::setup::{Division, VertexConfig};
use crate::value::channel::is_name;
use crate::value::{EvaluatedAt, StartBias};

/// The names of the file of the set-up words, `channel-setup.exp`, and of 1/w in the fields of a search.
const RESERVED: [&str; 2] = ["setup", "w"];

fn check_name(name: &str) -> Result<(), AttributeError> {
    if is_name(name) { Ok(()) } else { Err(AttributeError::Name(name.to_owned())) }
}

fn once(names: &[String]) -> Result<(), AttributeError> {
    for (n, name) in names.iter().enumerate() {
        check_name(name)?;
        if names[..n].contains(name) {
            return Err(AttributeError::Twice(name.clone()));
        }
    }
    Ok(())
}

fn read_out(
    what: &str,
    (guard, integer, interpolation): (u32, u32, u32),
    clamp: Clamp,
) -> Result<ReadOut, AttributeError> {
    if !(1..=32).contains(&integer) {
        return Err(AttributeError::Integer(what.to_owned(), integer));
    }
    if matches!(clamp, Clamp::Saturate | Clamp::Error) {
        return Err(AttributeError::Clamp(what.to_owned(), clamp.name()));
    }
    ReadOut::new(guard, integer, interpolation, clamp)
        .map_err(|error| AttributeError::ReadOut(what.to_owned(), error))
}

/// Refuses sums that exact arithmetic does not hold. Spec clause `CH-8`.
fn growth(
    what: &str,
    clause: &'static str,
    most: u32,
    parts: &[(&str, u32)],
) -> Result<(), AttributeError> {
    let sum = parts.iter().fold(0u32, |sum, (_, bits)| sum.saturating_add(*bits));
    if sum <= most {
        return Ok(());
    }
    let side =
        |of: &dyn Fn(&(&str, u32)) -> String| parts.iter().map(of).collect::<Vec<_>>().join(" + ");
    let formula = format!(
        "{} = {}",
        side(&|(name, _)| (*name).to_owned()),
        side(&|(_, bits)| bits.to_string())
    );
    Err(AttributeError::Growth { what: what.to_owned(), sum, most, clause, formula })
}

impl InverseWConfig {
    /// The accumulator's format.
    ///
    /// # Errors
    /// [`AttributeError`] names the violated inequality.
    pub fn validate(&self, vertex: &VertexConfig) -> Result<ReadOut, AttributeError> {
        let Self { guard, integer, interpolation, clamp, .. } = *self;
        let read = read_out("[w]", (guard, integer, interpolation), clamp)?;
        let parts = [
            ("integer", integer),
            ("2 * vertex difference bits", 2 * vertex.difference_bits()),
            ("interpolation", interpolation),
            ("4", 4),
        ];
        growth("[w]", "CH-8", 126, &parts)?;
        Ok(read)
    }
}

impl AttributeConfig {
    /// Checks the channel by itself, and returns the accumulator's format.
    ///
    /// # Errors
    /// [`AttributeError`] names the violated inequality.
    pub fn validate(
        &self,
        vertex: &VertexConfig,
        w: Option<&InverseWConfig>,
    ) -> Result<ReadOut, AttributeError> {
        let (name, got) = (self.name.clone(), self.components.len());
        check_name(&name)?;
        if RESERVED.contains(&name.as_str()) {
            return Err(AttributeError::Reserved(name));
        }
        if !(1..=4).contains(&got) {
            return Err(AttributeError::Components { name, got });
        }
        once(&self.components)?;
        let at_centre = matches!(self.at, EvaluatedAt::Centre | EvaluatedAt::Centroid);
        if at_centre && vertex.sub_pixel == 0 {
            return Err(AttributeError::NoCentre(name));
        }
        let what = format!("channel {name:?}");
        let bits = (self.guard, self.integer, self.interpolation);
        let read = read_out(&what, bits, self.clamp)?;
        let most = bounded_most(self.range().1);
        if let Some(unit) = self.unit.filter(|unit| *unit == 0 || u64::from(*unit) > most) {
            return Err(AttributeError::Unit { name, unit, most });
        }
        self.check_detail()?;
        self.division.validate().map_err(|error| AttributeError::Division(name.clone(), error))?;
        let affine = matches!(self.correction, Correction::Affine);
        if !affine && self.division != Division::Quotient {
            return Err(AttributeError::DividedTwice(name));
        }
        if !affine && self.start_bias != StartBias::None {
            return Err(AttributeError::Bias(name));
        }
        let over = match w {
            Some(w) if self.correction.needs_w() => Some(w),
            None if self.correction.needs_w() => return Err(AttributeError::NoW(name)),
            _ => None,
        };
        let inverse = over.map_or(0, |w| w.integer);
        let parts = [
            ("integer", self.integer),
            ("w.integer", inverse),
            ("2 * vertex difference bits", 2 * vertex.difference_bits()),
            ("interpolation", self.interpolation),
            ("reciprocal bits", self.division.growth()),
            ("4", 4),
        ];
        growth(&what, "CH-8", 126, &parts)?;
        if let Some(w) = over {
            self.correction.validate(self, w, vertex)?;
        }
        Ok(read)
    }
}

impl AttributeConfig {
    /// The level of detail as far as the channel itself decides. Spec clauses `CH-20` and `CH-21`.
    fn check_detail(&self) -> Result<(), AttributeError> {
        let Some(detail) = self.detail else { return Ok(()) };
        let (name, got) = (self.name.clone(), self.components.len());
        if got != 2 {
            return Err(AttributeError::DetailComponents { name, got });
        }
        if matches!(self.correction, Correction::Flat { .. } | Correction::ConstantW { .. }) {
            return Err(AttributeError::DetailPlace(name));
        }
        detail.unit().map_err(|error| AttributeError::Detail(name, error))?;
        Ok(())
    }
}

fn bounded_most(value: i128) -> u64 {
    crate::bits::bounded(value)
}

impl Correction {
    fn validate(
        &self,
        channel: &AttributeConfig,
        w: &InverseWConfig,
        vertex: &VertexConfig,
    ) -> Result<(), AttributeError> {
        let what = format!("channel {:?}", channel.name);
        let value = ("integer", channel.integer);
        let fractions = [("w.integer", w.integer), ("w.interpolation", w.interpolation)];
        match self {
            Self::Affine | Self::Flat { .. } => Ok(()),
            Self::Quotient { .. } | Self::ConstantW { .. } => {
                let own = [value, ("interpolation", channel.interpolation), ("1", 1)];
                growth(&what, "CH-8", 126, &[&own[..], &fractions[..]].concat())
            }
            Self::Reciprocal { unit, .. } => {
                let ready = unit
                    .unit()
                    .map_err(|error| AttributeError::Reciprocal(channel.name.clone(), error))?;
                let own = [
                    value,
                    ("interpolation", channel.interpolation),
                    ("reciprocal bits", ready.bits()),
                    ("1", 1),
                ];
                growth(&what, "CH-8", 126, &[&own[..], &fractions[..]].concat())
            }
            Self::Barycentric { bits, .. } => {
                if !(1..=40).contains(bits) {
                    return Err(AttributeError::Coordinate {
                        name: channel.name.clone(),
                        bits: *bits,
                    });
                }
                growth(&what, "CH-8", 126, &[value, ("bits", *bits), ("3", 3)])?;
                let difference = 2 * vertex.difference_bits();
                let parts = [
                    ("w.integer", w.integer),
                    ("2 * vertex difference bits", difference),
                    ("bits", *bits),
                    ("4", 4),
                ];
                growth(&what, "CH-8", 126, &parts)
            }
        }
    }
}

/// Checks the channels of a profile, and returns the formats of their accumulators.
///
/// # Errors
/// [`AttributeError`] names the violated inequality.
pub fn validate_channels(
    channels: &[AttributeConfig],
    w: Option<&InverseWConfig>,
    vertex: &VertexConfig,
) -> Result<Vec<ReadOut>, AttributeError> {
    let mut formats = Vec::new();
    for (n, channel) in channels.iter().enumerate() {
        formats.push(channel.validate(vertex, w)?);
        if channels[..n].iter().any(|before| before.name == channel.name) {
            return Err(AttributeError::Twice(channel.name.clone()));
        }
    }
    let total = channels.iter().map(|channel| channel.components.len()).sum();
    if total > COMPONENTS {
        return Err(AttributeError::Total(total));
    }
    Ok(formats)
}

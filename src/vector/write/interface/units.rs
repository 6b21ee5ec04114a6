//! The devices of the units of channels, and their parameters. Spec clause `CH-19`.

use crate::format::ReadOut;
use crate::profile::Profile;
use crate::value::InterpolatorUnit;
use crate::value::{Correction, Corrector, ReciprocalUnit, Refine};
use crate::vector::package::UnitDevice;
use crate::vector::units::{ReciprocalPort, Units};
use std::fmt::Write as _;

/// The most bits of an index of a table of one's own that a device takes as a parameter.
const OWN_TABLE: u32 = 10;

type Values = Vec<(&'static str, String)>;

/// The devices of a profile's channels.
pub(super) fn units(profile: &Profile) -> Vec<UnitDevice> {
    let Units { interpolators, reciprocals, dividers } = Units::of(profile);
    let mut list = Vec::new();
    let mut add = |bench: String, module, values: Option<Values>| {
        list.extend(values.map(|values| UnitDevice { bench, module, values }));
    };
    for named in interpolators {
        add(named.bench, "interpolator", Some(interpolator(&named.unit)));
    }
    for named in reciprocals {
        add(named.bench, "reciprocal_unit", reciprocal(&named.unit));
    }
    for named in dividers {
        add(named.bench, "perspective_divider", divider(&named.unit));
    }
    list
}

fn number(name: &'static str, value: impl Into<u64>) -> (&'static str, String) {
    (name, value.into().to_string())
}

fn interpolator(unit: &InterpolatorUnit) -> Values {
    let read = unit.read;
    vec![
        number("G", read.guard()),
        number("I", read.integer()),
        number("F", read.fraction()),
        number("MODE", read.clamp().code()),
        number("SIGNED", unit.signed),
    ]
}

/// What a reciprocal unit is told, beside the width of q.
fn parameters(unit: &ReciprocalUnit) -> Option<Values> {
    let config = unit.config();
    let (refine, steps) = match &config.refine {
        Refine::None => (0u32, [2, 2]),
        Refine::Linear => (1, [2, 2]),
        Refine::Newton { bits } => match bits[..] {
            [first] => (2, [first, 2]),
            [first, second] => (3, [first, second]),
            _ => return None,
        },
    };
    let mut values = vec![
        number("P", config.operand),
        number("K", config.index),
        number("M", config.entry),
        number("REFINE", refine),
        number("N1", steps[0]),
        number("N2", steps[1]),
    ];
    if let Some(table) = &config.table {
        if config.index > OWN_TABLE {
            return None;
        }
        values.push(number("OWN", 1u32));
        values.push(("ENTRIES", entries(table, config.entry, (1 << config.index) + 1)));
    }
    Some(values)
}

/// A table as one constant, entry j in the bits from j m on.
fn entries(table: &[u32], m: u32, count: usize) -> String {
    let bits = m as usize * count;
    let mut nibbles = vec![0u8; bits.div_ceil(4)];
    for (j, entry) in table.iter().enumerate() {
        for bit in (0..m as usize).filter(|bit| entry >> bit & 1 == 1) {
            let at = j * m as usize + bit;
            nibbles[at / 4] |= 1 << (at % 4);
        }
    }
    let mut text = format!("{bits}'h");
    for nibble in nibbles.iter().rev() {
        // Writing to a String cannot fail.
        let _ = write!(text, "{nibble:x}");
    }
    text
}

fn reciprocal(port: &ReciprocalPort) -> Option<Values> {
    let mut values = vec![number("W", port.width)];
    values.extend(parameters(&port.unit)?);
    Some(values)
}

fn divider(corrector: &Corrector) -> Option<Values> {
    let (config, read) = (corrector.config(), corrector.read_out());
    let w = corrector.w_read_out()?;
    let words = |read: ReadOut, [guard, integer, fraction, mode]: [&'static str; 4]| {
        [
            number(guard, read.guard()),
            number(integer, read.integer()),
            number(fraction, read.fraction()),
            number(mode, read.clamp().code()),
        ]
    };
    let mut values = words(read, ["G", "I", "F", "MODE"]).to_vec();
    values.push(number("SIGNED", config.signed));
    values.extend(words(w, ["GW", "B", "FW", "MODE_W"]));
    let rounding = match &config.correction {
        Correction::Quotient { rounding }
        | Correction::ConstantW { rounding }
        | Correction::Reciprocal { rounding, .. } => *rounding,
        _ => return None,
    };
    values.push(number("METHOD", corrector.unit().is_some()));
    values.push(number("ROUNDING", rounding.names().code));
    if let Some(unit) = corrector.unit() {
        values.extend(parameters(unit)?);
    }
    Some(values)
}

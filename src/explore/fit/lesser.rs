//! One bit less in each field: it fails, and here is why. Spec clause `Q-8`.

use super::judge::{Judge, Verdict};
use crate::explore::field::{Field, Value};
use crate::explore::sweep::Sweep;
use crate::explore::witness::{Witness, witness};
use crate::profile::{InvalidProfile, Profile};

/// What comes of one bit less in one field.
#[derive(Clone, Debug)]
pub enum Lesser {
    /// It fails: here is why.
    Fails(Field, Box<Witness>),
    /// There is no bit to take away, or no such profile.
    Impossible(Field, String),
    /// It meets the tolerances, too: the cost does not count the field, or its value is not
    /// in the space.
    Meets(Field),
}

/// Takes a bit away from each field of the space that counts bits.
pub(super) fn lesser(
    judge: &mut Judge<'_>,
    sweep: &Sweep,
    profile: &Profile,
) -> Result<Vec<Lesser>, InvalidProfile> {
    let mut found = Vec::new();
    for axis in sweep.space.axes().iter().filter(|axis| axis.field.is_bits()) {
        let field = axis.field;
        let Some(Value::Bits(bits)) = field.read(profile) else { continue };
        let Some(less) = bits.checked_sub(1) else {
            found.push(Lesser::Impossible(field, "already 0 bits".to_owned()));
            continue;
        };
        let changed = match sweep.space.with(profile, field, &Value::Bits(less)) {
            Ok(changed) => changed,
            Err(error) => {
                found.push(Lesser::Impossible(field, error.to_string()));
                continue;
            }
        };
        if let Err(error) = changed.validate() {
            found.push(Lesser::Impossible(field, error.to_string()));
            continue;
        }
        found.push(match judge.judge(&changed)? {
            Verdict::Fails => {
                let (tolerances, value) = (judge.tolerances.clone(), Value::Bits(less));
                let stages = &judge.group(&changed)?.stages;
                match witness(sweep, stages, &tolerances, &changed, value)? {
                    Some(witness) => Lesser::Fails(field, Box::new(witness)),
                    None => Lesser::Meets(field),
                }
            }
            _ => Lesser::Meets(field),
        });
    }
    Ok(found)
}

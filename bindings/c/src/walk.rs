//! Walks: an accumulator with a read-out, or an edge word with its sign test, clock by clock.

use crate::model::MODELS;
use crate::table::Table;
use crate::{Failure, GUARDBIT_ARGUMENT, answer, null, word_in, word_out};
use guardbit::dda::Op;
use guardbit::model::Walk;

pub(crate) static WALKS: Table<Walk> = Table::new("walk", 1);

/// One clock edge of an open walk: the accumulator, and what is read from it.
pub(crate) fn clock(walk: &mut Walk, op: u32, inputs: [u128; 3]) -> Result<[u128; 2], Failure> {
    if op > 3 {
        let text = format!("op = {op}: 0 load, 1 step by dx, 2 step by dy, 3 hold");
        return Err(Failure::new(GUARDBIT_ARGUMENT, text));
    }
    let (word, read) = walk.clock(Op::from_code(op.into()), inputs.map(u128::cast_signed));
    Ok([word, read.into()])
}

/// The kind of walk of channel 0: a component, or the component over w. Channel n is n more.
pub const GUARDBIT_CHANNEL_WALK: u32 = 16;

/// Opens a walk of a model, all zeros: kind 0 is its depth accumulator, 1 its edge word, 2 its 1/w,
/// `GUARDBIT_CHANNEL_WALK` + n an accumulator of channel n (clause CH-16). Returns the walk's handle;
/// `guardbit_close` closes it.
#[unsafe(no_mangle)]
pub extern "C" fn guardbit_walk(model: i32, kind: u32) -> i32 {
    answer(|| {
        let walk = MODELS.with(model, |open| {
            let (walk, what) = match kind {
                0 => (open.model.depth_walk(), "depth".to_owned()),
                1 => (open.model.edge_walk(), "edge words".to_owned()),
                2 => (open.model.interpolator_walk(None), "1/w that is walked".to_owned()),
                GUARDBIT_CHANNEL_WALK.. => {
                    let number = kind - GUARDBIT_CHANNEL_WALK;
                    let walk = open.model.interpolator_walk(Some(number as usize));
                    (walk, format!("channel {number} that is walked"))
                }
                _ => {
                    let text = format!("kind = {kind}: 0 depth, 1 edge, 2 1/w, 16 + n channel n");
                    return Err(Failure::new(GUARDBIT_ARGUMENT, text));
                }
            };
            let none = || format!("profile {} has no {what}", open.model.profile().name);
            walk.ok_or_else(|| Failure::new(GUARDBIT_ARGUMENT, none()))
        })?;
        WALKS.open(walk)
    })
}

/// One clock edge of a walk: op 0 loads `init`, 1 adds `dx`, 2 adds `dy`, 3 holds. `acc` and `out`
/// take the state after it: the accumulator, and the bits of its read-out or 1 for inside.
///
/// # Safety
/// Each pointer is null or leads to four parts.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn guardbit_clock(
    walk: i32,
    op: u32,
    init: *const u32,
    dx: *const u32,
    dy: *const u32,
    acc: *mut u32,
    out: *mut u32,
) -> i32 {
    answer(|| {
        // SAFETY: as the caller promises.
        let init = unsafe { word_in(init, "init") }?;
        // SAFETY: as the caller promises.
        let dx = unsafe { word_in(dx, "dx") }?;
        // SAFETY: as the caller promises.
        let dy = unsafe { word_in(dy, "dy") }?;
        let [state, read] = WALKS.with(walk, |walk| clock(walk, op, [init, dx, dy]))?;
        // SAFETY: as the caller promises.
        unsafe { word_out(acc, "acc", state) }?;
        // SAFETY: as the caller promises.
        unsafe { word_out(out, "out", read) }?;
        Ok(0)
    })
}

/// The same for words of at most 64 bits.
///
/// # Safety
/// Each pointer is null or leads to one word.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn guardbit_clock64(
    walk: i32,
    op: u32,
    init: u64,
    dx: u64,
    dy: u64,
    acc: *mut u64,
    out: *mut u64,
) -> i32 {
    answer(|| {
        let [state, read] = WALKS.with(walk, |walk| {
            if walk.width() > 64 {
                let text = format!("words have {} bits: use guardbit_clock", walk.width());
                return Err(Failure::new(GUARDBIT_ARGUMENT, text));
            }
            clock(walk, op, [init, dx, dy].map(u128::from))
        })?;
        if acc.is_null() || out.is_null() {
            return Err(null(if acc.is_null() { "acc" } else { "out" }));
        }
        // SAFETY: not null, and the caller gives one word.
        unsafe { acc.write(u64::try_from(state).unwrap_or(0)) };
        // SAFETY: not null, and the caller gives one word.
        unsafe { out.write(u64::try_from(read).unwrap_or(0)) };
        Ok(0)
    })
}

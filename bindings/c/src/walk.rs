//! Walks: an accumulator with a read-out, or an edge word with its sign test, clock by clock.

use crate::model::MODELS;
use crate::table::Table;
use crate::{Failure, GUARDBIT_ARGUMENT, answer, null, word_in, word_out};
use guardbit::dda::{Op, Walker};
use guardbit::format::{Clamp, ReadOut};

/// A walk and its words.
pub(crate) struct Walk {
    walker: Walker,
    width: u32,
    edge: bool,
    inputs: [u128; 3],
}

pub(crate) static WALKS: Table<Walk> = Table::new("walk", 1);

impl Walk {
    /// One clock edge; the accumulator and what is read from it.
    pub(crate) fn clock(&mut self, op: u32, inputs: [u128; 3]) -> Result<[u128; 2], Failure> {
        if op > 3 {
            let text = format!("op = {op}: 0 load, 1 step by dx, 2 step by dy, 3 hold");
            return Err(Failure::new(GUARDBIT_ARGUMENT, text));
        }
        if inputs != self.inputs {
            let [init, dx, dy] = inputs.map(u128::cast_signed);
            self.walker.rewire(init, dx, dy);
            self.inputs = inputs;
        }
        self.walker.clock(Op::from_code(op.into()));
        let pattern = self.walker.pattern();
        let out = if self.edge {
            u128::from(pattern >> (self.width - 1) == 0)
        } else {
            u128::from(self.walker.out())
        };
        Ok([pattern, out])
    }
}

/// Opens a walk of a model, all zeros: kind 0 is its depth accumulator, 1 its edge word. Returns
/// the walk's handle; `guardbit_close` closes it.
#[unsafe(no_mangle)]
pub extern "C" fn guardbit_walk(model: i32, kind: u32) -> i32 {
    answer(|| {
        let read = MODELS.with(model, |model| {
            let profile = model.model.profile();
            let read = match kind {
                0 => model.model.depth().map(guardbit::value::Depth::read_out),
                1 => profile.form.edge().and_then(|edge| {
                    let integer = edge.width.min(64);
                    ReadOut::new(edge.width - integer, integer, 0, Clamp::Wrap).ok()
                }),
                _ => {
                    let text = format!("kind = {kind}: 0 depth, 1 edge");
                    return Err(Failure::new(GUARDBIT_ARGUMENT, text));
                }
            };
            let what = if kind == 0 { "depth" } else { "edge words" };
            let none = || format!("profile {} has no {what}", profile.name);
            read.ok_or_else(|| Failure::new(GUARDBIT_ARGUMENT, none()))
        })?;
        let walker = Walker::new(read, 0, 0, 0);
        WALKS.open(Walk { walker, width: read.width(), edge: kind == 1, inputs: [0; 3] })
    })
}

/// One clock edge of a walk: op 0 loads `init`, 1 adds `dx`, 2 adds `dy`, 3 holds. `acc` and `out`
/// take the state after it: the accumulator, and its read-out or 1 for inside.
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
        let [state, read] = WALKS.with(walk, |walk| walk.clock(op, [init, dx, dy]))?;
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
            if walk.width > 64 {
                let text = format!("words have {} bits: use guardbit_clock", walk.width);
                return Err(Failure::new(GUARDBIT_ARGUMENT, text));
            }
            walk.clock(op, [init, dx, dy].map(u128::from))
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

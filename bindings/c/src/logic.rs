//! Words as arrays of VHDL's `std_ulogic`, for VHPIDIRECT.

use crate::channel::divide;
use crate::walk::{WALKS, clock};
use crate::{Failure, GUARDBIT_ARGUMENT, answer, null};

/// Bits of such a word.
const BITS: usize = 128;
/// Positions of '0' and '1' among the values of `std_ulogic`.
const ZERO: u8 = 2;
const ONE: u8 = 3;

/// # Safety
/// The pointer is null or leads to 128 bytes.
unsafe fn logic_in(pointer: *const u8, name: &str) -> Result<u128, Failure> {
    if pointer.is_null() {
        return Err(null(name));
    }
    // SAFETY: not null, and the caller gives 128 bytes.
    let bytes = unsafe { std::slice::from_raw_parts(pointer, BITS) };
    bytes.iter().try_fold(0, |word, byte| match *byte {
        ZERO => Ok(word << 1),
        ONE => Ok(word << 1 | 1),
        _ => Err(Failure::new(
            GUARDBIT_ARGUMENT,
            format!("{name} has a bit that is neither 0 nor 1"),
        )),
    })
}

/// # Safety
/// The pointer is null or leads to 128 bytes.
unsafe fn logic_out(pointer: *mut u8, name: &str, word: u128) -> Result<(), Failure> {
    if pointer.is_null() {
        return Err(null(name));
    }
    // SAFETY: not null, and the caller gives 128 bytes.
    let bytes = unsafe { std::slice::from_raw_parts_mut(pointer, BITS) };
    for (n, byte) in bytes.iter_mut().rev().enumerate() {
        *byte = if word >> n & 1 == 1 { ONE } else { ZERO };
    }
    Ok(())
}

/// `guardbit_clock` for words as `std_logic_vector(127 downto 0)`, one byte a bit, the highest
/// first; a bit that is neither 0 nor 1 is an error.
///
/// # Safety
/// Each pointer is null or leads to 128 bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn guardbit_clock_logic(
    walk: i32,
    op: i32,
    init: *const u8,
    dx: *const u8,
    dy: *const u8,
    acc: *mut u8,
    out: *mut u8,
) -> i32 {
    answer(|| {
        // SAFETY: as the caller promises.
        let init = unsafe { logic_in(init, "init") }?;
        // SAFETY: as the caller promises.
        let dx = unsafe { logic_in(dx, "dx") }?;
        // SAFETY: as the caller promises.
        let dy = unsafe { logic_in(dy, "dy") }?;
        let op = u32::try_from(op).unwrap_or(u32::MAX);
        let [state, read] = WALKS.with(walk, |walk| clock(walk, op, [init, dx, dy]))?;
        // SAFETY: as the caller promises.
        unsafe { logic_out(acc, "acc", state) }?;
        // SAFETY: as the caller promises.
        unsafe { logic_out(out, "out", read) }?;
        Ok(0)
    })
}

/// `guardbit_divide` for the same words.
///
/// # Safety
/// Each pointer is null or leads to 128 bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn guardbit_divide_logic(
    model: i32,
    channel: i32,
    acc: *const u8,
    acc_w: *const u8,
    code: *mut u8,
) -> i32 {
    answer(|| {
        // SAFETY: as the caller promises.
        let acc = unsafe { logic_in(acc, "acc") }?;
        // SAFETY: as the caller promises.
        let acc_w = unsafe { logic_in(acc_w, "acc_w") }?;
        let word = divide(model, u32::try_from(channel).unwrap_or(u32::MAX), [acc, acc_w])?;
        // SAFETY: as the caller promises.
        unsafe { logic_out(code, "code", word) }?;
        Ok(0)
    })
}

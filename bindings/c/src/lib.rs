//! The live model for simulators, by handles: no pointer to the model ever leaves this library.
//!
//! Every function returns a number of at least 0 where it went well and one of the negative
//! `GUARDBIT_` codes where not; [`guardbit_message`] then says what was wrong. A handle that was
//! never given, or was closed, is an error, and so is a null pointer. What cannot be told from here
//! is whether a pointer that is not null leads to as many words as its parameter says.
//!
//! Words are 128 bits wide, as four 32-bit parts from the low end: what DPI passes for
//! `bit [127:0]`. The bits above a word's width are ignored on the way in and zero on the way out.

mod channel;
mod logic;
mod model;
mod primitive;
mod table;
mod walk;

use std::cell::RefCell;
use std::ffi::c_char;
use std::panic::{AssertUnwindSafe, catch_unwind};

pub use channel::{
    guardbit_channel, guardbit_channels, guardbit_code_count, guardbit_codes, guardbit_component,
    guardbit_divide, guardbit_draw_shaded,
};
pub use logic::{guardbit_clock_logic, guardbit_divide_logic};
pub use model::{
    guardbit_close, guardbit_column, guardbit_depth, guardbit_draw, guardbit_draw_primitive,
    guardbit_open, guardbit_record, guardbit_setup, guardbit_span,
};
pub use primitive::{
    GUARDBIT_CLIP, GUARDBIT_LINE, GUARDBIT_POINT, GUARDBIT_POLYGON, GUARDBIT_POLYGON_DEPTH,
    GUARDBIT_TRIANGLE, GUARDBIT_WORDS,
};
pub use walk::{GUARDBIT_CHANNEL_WALK, guardbit_clock, guardbit_clock64, guardbit_walk};

/// The handle is of nothing that is open, or of something of another kind.
pub const GUARDBIT_HANDLE: i32 = -1;
/// A pointer is null.
pub const GUARDBIT_NULL: i32 = -2;
/// An argument is outside its range.
pub const GUARDBIT_ARGUMENT: i32 = -3;
/// The profile cannot be read, or is refused.
pub const GUARDBIT_PROFILE: i32 = -4;
/// The profile refuses what is to be drawn.
pub const GUARDBIT_REFUSED: i32 = -5;
/// A defect of this library.
pub const GUARDBIT_INTERNAL: i32 = -6;

/// What went wrong, as a code and in words.
pub(crate) struct Failure {
    code: i32,
    message: String,
}

impl Failure {
    pub(crate) fn new(code: i32, message: impl Into<String>) -> Self {
        Self { code, message: message.into() }
    }
}

thread_local! {
    static MESSAGE: RefCell<String> = const { RefCell::new(String::new()) };
}

/// Runs a call, keeps its message, and gives its code; a panic does not leave the library.
pub(crate) fn answer(call: impl FnOnce() -> Result<i32, Failure>) -> i32 {
    let failure = match catch_unwind(AssertUnwindSafe(call)) {
        Ok(Ok(value)) => return value,
        Ok(Err(failure)) => failure,
        Err(_) => Failure::new(GUARDBIT_INTERNAL, "guardbit failed: please report this call"),
    };
    MESSAGE.with(|message| *message.borrow_mut() = failure.message);
    failure.code
}

/// Version of this interface; it grows when a function changes its meaning.
#[unsafe(no_mangle)]
pub extern "C" fn guardbit_interface() -> i32 {
    1
}

/// Copies what this thread's last failed call said, ended by a zero and cut to `size` bytes, and
/// returns the bytes that the whole message has without its zero.
///
/// # Safety
/// `buffer` is null or leads to `size` bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn guardbit_message(buffer: *mut c_char, size: usize) -> i32 {
    MESSAGE.with(|message| {
        let message = message.borrow();
        let bytes = message.as_bytes();
        if !buffer.is_null() && size > 0 {
            let length = bytes.len().min(size - 1);
            // SAFETY: the caller gives `size` bytes, of which `length + 1` are written.
            let buffer = unsafe { std::slice::from_raw_parts_mut(buffer.cast::<u8>(), length + 1) };
            buffer[..length].copy_from_slice(&bytes[..length]);
            buffer[length] = 0;
        }
        i32::try_from(bytes.len()).unwrap_or(i32::MAX)
    })
}

/// Numbers, or a failure naming the parameter.
///
/// # Safety
/// The pointer is null or leads to `count` numbers that stay as they are.
pub(crate) unsafe fn numbers_in<'a>(
    pointer: *const i64,
    count: usize,
    name: &str,
) -> Result<&'a [i64], Failure> {
    if pointer.is_null() {
        return Err(null(name));
    }
    // SAFETY: not null, and the caller gives so many numbers.
    Ok(unsafe { std::slice::from_raw_parts(pointer, count) })
}

/// A word in four parts, or a failure naming the parameter.
///
/// # Safety
/// The pointer is null or leads to four parts.
pub(crate) unsafe fn word_in(pointer: *const u32, name: &str) -> Result<u128, Failure> {
    if pointer.is_null() {
        return Err(null(name));
    }
    // SAFETY: not null, and the caller gives four parts.
    let parts = unsafe { std::slice::from_raw_parts(pointer, 4) };
    Ok(parts.iter().rev().fold(0, |word, part| word << 32 | u128::from(*part)))
}

/// Writes a word in four parts.
///
/// # Safety
/// The pointer is null or leads to four parts.
pub(crate) unsafe fn word_out(pointer: *mut u32, name: &str, word: u128) -> Result<(), Failure> {
    if pointer.is_null() {
        return Err(null(name));
    }
    // SAFETY: not null, and the caller gives four parts.
    let parts = unsafe { std::slice::from_raw_parts_mut(pointer, 4) };
    for (n, part) in parts.iter_mut().enumerate() {
        let bytes = (word >> (32 * n)).to_le_bytes();
        *part = u32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]);
    }
    Ok(())
}

/// Copies a name, ended by a zero and cut to `size` bytes.
///
/// # Safety
/// The pointer is null or leads to `size` bytes.
pub(crate) unsafe fn name_out(
    pointer: *mut c_char,
    size: usize,
    name: &str,
) -> Result<(), Failure> {
    if pointer.is_null() || size == 0 {
        return Err(null("name"));
    }
    let length = name.len().min(size - 1);
    // SAFETY: not null, and the caller gives `size` bytes, of which `length + 1` are written.
    let to = unsafe { std::slice::from_raw_parts_mut(pointer.cast::<u8>(), length + 1) };
    to[..length].copy_from_slice(&name.as_bytes()[..length]);
    to[length] = 0;
    Ok(())
}

pub(crate) fn null(name: &str) -> Failure {
    Failure::new(GUARDBIT_NULL, format!("{name} is a null pointer"))
}

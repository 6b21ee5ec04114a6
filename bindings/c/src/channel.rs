//! Channels: what the vertices of a triangle bring beside depth, and the codes that are drawn of it.

use crate::model::{MODELS, Open, count, few, part_out};
use crate::primitive::{GUARDBIT_TRIANGLE, given};
use crate::{Failure, GUARDBIT_ARGUMENT, answer, name_out, numbers_in, word_in, word_out};
use guardbit::machine::ChannelPort;
use guardbit::scene::{Named, Shading};
use std::ffi::c_char;

/// Draws a triangle with channels. `numbers` has x, y of three vertices (`count` is 6) or x, y, z (9),
/// as `guardbit_draw_primitive` takes them. `codes` has the codes of the vertices in the order of
/// channel, component, vertex: r0 r1 r2 g0 g1 g2 and so on, `code_count` numbers, 3 for each component
/// of the profile (clause CH-2). A code of an unsigned channel of i bits is 0 to 2^i - 1, of a signed
/// one -2^(i-1) to 2^(i-1) - 1. `q` has the three codes of 1/w, 1 to 2^B - 1, where B is the `integer`
/// of `[w]` (clause CH-4). It may be null if no channel is corrected by it, and is ignored by a
/// profile without `[w]`. Returns the number of covered runs.
///
/// Another number of codes is `GUARDBIT_ARGUMENT`. A code outside its range, a q that is missing and
/// a profile without channels are `GUARDBIT_REFUSED`.
///
/// # Safety
/// `numbers` is null or leads to `count` numbers, `codes` is null or leads to `code_count` numbers,
/// `q` is null or leads to three numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn guardbit_draw_shaded(
    model: i32,
    numbers: *const i64,
    count: u32,
    codes: *const i64,
    code_count: u32,
    q: *const i64,
) -> i32 {
    answer(|| {
        // SAFETY: as the caller promises.
        let numbers = unsafe { numbers_in(numbers, count as usize, "numbers") }?;
        // SAFETY: as the caller promises.
        let codes = unsafe { numbers_in(codes, code_count as usize, "codes") }?;
        let inverse_w = if q.is_null() {
            None
        } else {
            // SAFETY: as the caller promises.
            let q = unsafe { numbers_in(q, 3, "q") }?;
            Some([q[0], q[1], q[2]].map(i128::from))
        };
        let given = given(GUARDBIT_TRIANGLE, numbers)?;
        MODELS.with(model, |open| {
            let shading = Shading::Codes { channels: named(open, codes)?, inverse_w };
            open.draw(&given, Some(&shading))
        })
    })
}

/// Flat codes by the channels of the profile. The model itself refuses a profile without channels.
fn named(open: &Open, codes: &[i64]) -> Result<Named<i128>, Failure> {
    let ports = &open.model.ports().channels;
    let components: usize = ports.iter().map(|port| port.components.len()).sum();
    let (need, got) = (3 * components, codes.len());
    if need != got && !ports.is_empty() {
        let text = format!(
            "code_count = {got}: {need} codes are needed, 3 for each of {components} components"
        );
        return Err(Failure::new(GUARDBIT_ARGUMENT, text));
    }
    let mut vertices = codes.chunks_exact(3).map(|v| [v[0], v[1], v[2]].map(i128::from));
    let channel = |port: &ChannelPort| {
        (port.name.clone(), vertices.by_ref().take(port.components.len()).collect())
    };
    Ok(ports.iter().map(channel).collect())
}

/// How many channels the profile of a model has.
#[unsafe(no_mangle)]
pub extern "C" fn guardbit_channels(model: i32) -> i32 {
    answer(|| MODELS.with(model, |open| count(open.model.ports().channels.len(), "channels")))
}

/// Copies the name of channel `index`, in the order of the profile, ended by a zero and cut to `size`
/// bytes; returns the number of its components.
///
/// # Safety
/// `name` is null or leads to `size` bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn guardbit_channel(
    model: i32,
    index: u32,
    name: *mut c_char,
    size: usize,
) -> i32 {
    answer(|| {
        MODELS.with(model, |open| {
            let port = port(open, "index", index)?;
            // SAFETY: as the caller promises.
            unsafe { name_out(name, size, &port.name) }?;
            count(port.components.len(), "components")
        })
    })
}

/// Copies the name of component `index` of a channel, ended by a zero and cut to `size` bytes.
///
/// # Safety
/// `name` is null or leads to `size` bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn guardbit_component(
    model: i32,
    channel: u32,
    index: u32,
    name: *mut c_char,
    size: usize,
) -> i32 {
    answer(|| {
        MODELS.with(model, |open| {
            port(open, "channel", channel)?;
            let components = &open.model.profile().channel[channel as usize].components;
            let none = || few("index", index.into(), components.len(), "components");
            let component = components.get(index as usize).ok_or_else(none)?;
            // SAFETY: as the caller promises.
            unsafe { name_out(name, size, component) }?;
            Ok(0)
        })
    })
}

/// The division of a channel at a sample (clause CH-5): the accumulators of u/w and 1/w in, the code
/// out, as a word of four parts each; a code of a signed channel is sign-extended. A channel that is
/// not divided by 1/w is `GUARDBIT_ARGUMENT`.
///
/// # Safety
/// Each pointer is null or leads to four parts.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn guardbit_divide(
    model: i32,
    channel: u32,
    acc: *const u32,
    acc_w: *const u32,
    code: *mut u32,
) -> i32 {
    answer(|| {
        // SAFETY: as the caller promises.
        let acc = unsafe { word_in(acc, "acc") }?;
        // SAFETY: as the caller promises.
        let acc_w = unsafe { word_in(acc_w, "acc_w") }?;
        let word = divide(model, channel, [acc, acc_w])?;
        // SAFETY: as the caller promises.
        unsafe { word_out(code, "code", word) }?;
        Ok(0)
    })
}

/// The code for the accumulators of u/w and 1/w.
pub(crate) fn divide(model: i32, channel: u32, words: [u128; 2]) -> Result<u128, Failure> {
    MODELS.with(model, |open| {
        port(open, "channel", channel)?;
        let divided = open.model.divide(channel as usize, words.map(u128::cast_signed));
        let divided = divided.ok_or_else(|| {
            let text = format!("channel = {channel}: it is not divided by 1/w");
            Failure::new(GUARDBIT_ARGUMENT, text)
        })?;
        Ok(i128::from(divided.code).cast_unsigned())
    })
}

/// How many codes of a channel the last drawing has: 0 if it was drawn without channels.
#[unsafe(no_mangle)]
pub extern "C" fn guardbit_code_count(model: i32, channel: u32) -> i32 {
    answer(|| MODELS.with(model, |open| count(drawn(open, channel)?.len(), "codes")))
}

/// Copies `count` codes of a channel of the last drawing from code `first` on: run by run, in the
/// order of pixel, sample, component (clause CH-7).
///
/// # Safety
/// `codes` is null or leads to `count` numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn guardbit_codes(
    model: i32,
    channel: u32,
    first: u64,
    count: u32,
    codes: *mut i64,
) -> i32 {
    answer(|| {
        MODELS.with(model, |open| {
            // SAFETY: as the caller promises.
            unsafe { part_out(codes, "codes", (first, count), drawn(open, channel)?) }
        })
    })
}

/// A channel of the profile, or a failure naming the parameter.
fn port<'a>(open: &'a Open, name: &str, index: u32) -> Result<&'a ChannelPort, Failure> {
    let ports = &open.model.ports().channels;
    let none = || few(name, index.into(), ports.len(), "channels");
    ports.get(index as usize).ok_or_else(none)
}

/// The codes of a channel in the last drawing; none where nothing was covered.
fn drawn(open: &Open, channel: u32) -> Result<&[i64], Failure> {
    port(open, "channel", channel)?;
    Ok(open.drawing.channels.get(channel as usize).map_or(&[], Vec::as_slice))
}

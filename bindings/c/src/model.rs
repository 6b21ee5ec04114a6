//! Models: a profile ready to draw, and what it drew last.

use crate::primitive::{GUARDBIT_TRIANGLE, Given, given};
use crate::table::Table;
use crate::walk::WALKS;
use crate::{
    Failure, GUARDBIT_ARGUMENT, GUARDBIT_INTERNAL, GUARDBIT_PROFILE, GUARDBIT_REFUSED, answer,
    name_out, null, numbers_in, word_out,
};
use guardbit::bits::Width as _;
use guardbit::model::{Drawing, Model, PrimitiveError, Records};
use guardbit::profile;
use guardbit::scene::{Primitive, Shading, Triangle};
use std::ffi::{CStr, c_char};

/// A model and its last drawing.
pub(crate) struct Open {
    pub(crate) model: Model,
    pub(crate) drawing: Drawing,
    records: Records,
}

pub(crate) static MODELS: Table<Open> = Table::new("model", 0);

/// Opens a model by the name of a built-in profile or the path of a TOML file, and returns its
/// handle.
///
/// # Safety
/// `profile` is null or leads to bytes that a zero ends.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn guardbit_open(profile: *const c_char) -> i32 {
    answer(|| {
        if profile.is_null() {
            return Err(null("profile"));
        }
        // SAFETY: not null, and the caller ends it by a zero.
        let name = unsafe { CStr::from_ptr(profile) };
        let name = name.to_str().map_err(|error| {
            Failure::new(GUARDBIT_ARGUMENT, format!("the profile's name is not UTF-8: {error}"))
        })?;
        let refuse =
            |error: &dyn std::fmt::Display| Failure::new(GUARDBIT_PROFILE, error.to_string());
        let profile = profile::load(name).map_err(|error| refuse(&error))?;
        let model = Model::new(&profile).map_err(|error| refuse(&error))?;
        let records = Records::up_to(Records::MOST);
        MODELS.open(Open { model, drawing: Drawing::default(), records })
    })
}

/// Closes a model or a walk.
#[unsafe(no_mangle)]
pub extern "C" fn guardbit_close(handle: i32) -> i32 {
    answer(|| match MODELS.close(handle) {
        Ok(()) => Ok(0),
        Err(failure) => WALKS.close(handle).map_or(Err(failure), |()| Ok(0)),
    })
}

/// Draws a triangle: x, y and z of each vertex on the profile's grid and in depth codes; z is
/// ignored by a profile without depth. Returns the number of covered runs.
///
/// # Safety
/// `vertices` is null or leads to nine numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn guardbit_draw(model: i32, vertices: *const i64) -> i32 {
    answer(|| {
        // SAFETY: as the caller promises.
        let numbers = unsafe { numbers_in(vertices, 9, "vertices") }?;
        MODELS.with(model, |open| {
            let Given::Primitive(primitive) = given(GUARDBIT_TRIANGLE, numbers)? else {
                unreachable!("a triangle is no list of words");
            };
            let flat = |primitive| match primitive {
                Primitive::Triangle(Triangle::Lattice { xy, .. }) => {
                    Primitive::Triangle(Triangle::Lattice { xy, z: None })
                }
                other => other,
            };
            let has_depth = open.model.depth().is_some();
            open.draw(&Given::Primitive(if has_depth { primitive } else { flat(primitive) }), None)
        })
    })
}

/// Draws one primitive of any kind that the profile's machine takes: `kind` is `GUARDBIT_TRIANGLE`
/// to `GUARDBIT_WORDS`, `numbers` its coordinates on the profile's input lattice and in depth codes,
/// or its words. Returns the number of covered runs, or of records where words were drawn.
///
/// # Safety
/// `numbers` is null or leads to `count` numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn guardbit_draw_primitive(
    model: i32,
    kind: u32,
    numbers: *const i64,
    count: u32,
) -> i32 {
    answer(|| {
        // SAFETY: as the caller promises.
        let numbers = unsafe { numbers_in(numbers, count as usize, "numbers") }?;
        let given = given(kind, numbers)?;
        MODELS.with(model, |open| open.draw(&given, None))
    })
}

/// Record `index` of the last words drawn: up to `size` of its words; returns how many it has. Its
/// letter goes to `letter`.
///
/// # Safety
/// `letter` is null or leads to one byte; `words` is null or leads to `size` words.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn guardbit_record(
    model: i32,
    index: u32,
    letter: *mut u8,
    words: *mut u32,
    size: u32,
) -> i32 {
    answer(|| {
        if letter.is_null() {
            return Err(null("letter"));
        }
        if words.is_null() {
            return Err(null("words"));
        }
        MODELS.with(model, |open| {
            let kept = &open.records.kept;
            let none = || few("index", index.into(), kept.len(), "records");
            let (kind, values) = kept.get(index as usize).ok_or_else(none)?;
            let Some(registers) = open.model.registers() else { return Err(none()) };
            let record = &registers.records[*kind];
            let made: Vec<u32> = record.words(values).collect();
            // SAFETY: not null, and the caller gives one byte and `size` words.
            let words = unsafe { std::slice::from_raw_parts_mut(words, size as usize) };
            for (to, from) in words.iter_mut().zip(&made) {
                *to = *from;
            }
            // SAFETY: not null, and the caller gives one byte. A letter is ASCII.
            unsafe { letter.write(u8::try_from(record.letter).unwrap_or(b'?')) };
            count(made.len(), "words")
        })
    })
}

impl Open {
    /// Draws, with what the vertices bring for channels, and keeps what was drawn; nothing is kept of
    /// what is refused.
    pub(crate) fn draw(
        &mut self,
        given: &Given,
        shading: Option<&Shading>,
    ) -> Result<i32, Failure> {
        self.drawing.clear();
        self.records = Records::up_to(Records::MOST);
        let drawn = match given {
            Given::Primitive(primitive) => self
                .model
                .prepare(primitive)
                .and_then(|primitive| match shading {
                    Some(shading) => self.model.shade(primitive, shading),
                    None => Ok(primitive),
                })
                .and_then(|primitive| Ok(self.model.draw(&primitive, &mut self.drawing)?)),
            Given::Words(_) if self.model.registers().is_none() => Err(PrimitiveError::NoRegisters),
            Given::Words(words) => {
                let drawn = self.model.draw(words.as_slice(), &mut self.records);
                drawn.map_err(PrimitiveError::from)
            }
        };
        if let Err(error) = drawn {
            self.drawing.clear();
            return Err(Failure::new(GUARDBIT_REFUSED, error.to_string()));
        }
        if !self.records.is_whole() {
            let (total, most) = (self.records.total, Records::MOST);
            self.records = Records::up_to(Records::MOST);
            let text = format!("{total} records are drawn, and an answer has at most {most}");
            return Err(Failure::new(GUARDBIT_REFUSED, text));
        }
        match given {
            Given::Primitive(_) => count(self.drawing.spans.len(), "runs"),
            Given::Words(_) => count(self.records.kept.len(), "records"),
        }
    }
}

/// A number of things as an answer.
pub(crate) fn count(length: usize, what: &str) -> Result<i32, Failure> {
    let most = i32::MAX;
    i32::try_from(length).map_err(|_| {
        let text = format!("{length} {what} are more than the {most} that can be answered");
        Failure::new(GUARDBIT_REFUSED, text)
    })
}

/// Run `index` of the last drawing as y, x0, x1, half open.
///
/// # Safety
/// `run` is null or leads to three numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn guardbit_span(model: i32, index: u32, run: *mut u32) -> i32 {
    answer(|| {
        if run.is_null() {
            return Err(null("run"));
        }
        let span = MODELS.with(model, |open| {
            let spans = &open.drawing.spans;
            let span = spans.get(index as usize).copied();
            span.ok_or_else(|| few("index", index.into(), spans.len(), "runs"))
        })?;
        // SAFETY: not null, and the caller gives three numbers.
        let run = unsafe { std::slice::from_raw_parts_mut(run, 3) };
        run.copy_from_slice(&[span.y, span.x0, span.x1]);
        Ok(0)
    })
}

/// Copies `count` depths of the last drawing from covered sample `first` on, run by run.
///
/// # Safety
/// `depths` is null or leads to `count` numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn guardbit_depth(
    model: i32,
    first: u64,
    count: u32,
    depths: *mut u64,
) -> i32 {
    answer(|| {
        MODELS.with(model, |open| {
            // SAFETY: as the caller promises.
            unsafe { part_out(depths, "depths", (first, count), &open.drawing.depth) }
        })
    })
}

/// Word `index` of the last drawing's set-up, reduced to its column; returns the column's width.
///
/// # Safety
/// `word` is null or leads to four parts.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn guardbit_setup(model: i32, index: u32, word: *mut u32) -> i32 {
    answer(|| {
        let (width, value) = MODELS.with(model, |open| {
            let setup = &open.drawing.setup;
            // A primitive without area has no words.
            let words =
                if setup.is_empty() { Ok(Vec::new()) } else { open.model.ports().words(setup) };
            let words =
                words.map_err(|error| Failure::new(GUARDBIT_INTERNAL, error.to_string()))?;
            let none = || few("index", index.into(), words.len(), "set-up words");
            let word = words.get(index as usize).ok_or_else(none)?;
            Ok((word.width().bits(), word.to_bits()))
        })?;
        // SAFETY: as the caller promises.
        unsafe { word_out(word, "word", value) }?;
        count(width as usize, "bits")
    })
}

/// Copies the name of set-up column `index`, ended by a zero and cut to `size` bytes; returns the
/// column's width.
///
/// # Safety
/// `name` is null or leads to `size` bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn guardbit_column(
    model: i32,
    index: u32,
    name: *mut c_char,
    size: usize,
) -> i32 {
    answer(|| {
        MODELS.with(model, |open| {
            let columns = &open.model.ports().setup;
            let none = || few("index", index.into(), columns.len(), "set-up columns");
            let column = columns.get(index as usize).ok_or_else(none)?;
            // SAFETY: as the caller promises.
            unsafe { name_out(name, size, &column.name) }?;
            count(column.width as usize, "bits")
        })
    })
}

pub(crate) fn few(name: &str, got: u64, have: usize, what: &str) -> Failure {
    let text = format!("{name} = {got}: there are {have} {what}");
    Failure::new(GUARDBIT_ARGUMENT, text)
}

/// Copies `count` numbers of a drawing from number `first` on, or a failure naming the parameter.
///
/// # Safety
/// `pointer` is null or leads to `count` numbers.
pub(crate) unsafe fn part_out<T: Copy>(
    pointer: *mut T,
    name: &str,
    (first, count): (u64, u32),
    held: &[T],
) -> Result<i32, Failure> {
    if pointer.is_null() {
        return Err(null(name));
    }
    let begin = usize::try_from(first).unwrap_or(usize::MAX);
    let end = begin.saturating_add(count as usize);
    let Some(part) = held.get(begin..end) else {
        return Err(few("first + count", end as u64, held.len(), name));
    };
    // SAFETY: not null, and the caller gives `count` numbers.
    let to = unsafe { std::slice::from_raw_parts_mut(pointer, count as usize) };
    to.copy_from_slice(part);
    Ok(0)
}

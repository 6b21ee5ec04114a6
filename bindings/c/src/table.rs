//! Handles: a place and how often it was taken, so that a closed handle stays closed.

use crate::{Failure, GUARDBIT_ARGUMENT, GUARDBIT_HANDLE};
use std::sync::{Arc, Mutex, PoisonError, RwLock};

/// How often a place was taken, and what is there.
type Place<T> = (u16, Option<Arc<Mutex<T>>>);

/// What handles of one kind stand for.
pub(crate) struct Table<T> {
    kind: &'static str,
    /// The first place's number, so that no handle is one of another kind.
    first: i32,
    places: RwLock<Vec<Place<T>>>,
}

/// Handles of one kind that can be open.
const PLACES: usize = 1 << 14;

impl<T> Table<T> {
    /// The table of kind number `n`, 0 to 3.
    pub(crate) const fn new(kind: &'static str, n: i32) -> Self {
        Self { kind, first: n << 14, places: RwLock::new(Vec::new()) }
    }

    /// Keeps a value and gives its handle, which is positive.
    pub(crate) fn open(&self, value: T) -> Result<i32, Failure> {
        let mut places = self.places.write().unwrap_or_else(PoisonError::into_inner);
        let value = Some(Arc::new(Mutex::new(value)));
        let free = places.iter().position(|(times, held)| held.is_none() && *times < 0x7fff);
        let place = free.unwrap_or(places.len());
        if place >= PLACES {
            let text = format!("{PLACES} handles of one kind are the most, and as many were given");
            return Err(Failure::new(GUARDBIT_ARGUMENT, text));
        }
        if free.is_none() {
            places.push((0, None));
        }
        let (times, held) = &mut places[place];
        *times += 1;
        *held = value;
        let place = i32::try_from(place).unwrap_or(i32::MAX);
        Ok(i32::from(*times) << 16 | self.first | place)
    }

    /// The place that a handle of this kind names.
    fn place(&self, handle: i32) -> Option<usize> {
        usize::try_from((handle & 0xffff) - self.first).ok()
    }

    pub(crate) fn close(&self, handle: i32) -> Result<(), Failure> {
        let mut places = self.places.write().unwrap_or_else(PoisonError::into_inner);
        let slot = self.place(handle).and_then(|place| places.get_mut(place));
        match slot {
            Some((times, held)) if i32::from(*times) == handle >> 16 && held.is_some() => {
                *held = None;
                Ok(())
            }
            _ => Err(self.unknown(handle)),
        }
    }

    /// Does something with what a handle stands for.
    pub(crate) fn with<R>(
        &self,
        handle: i32,
        work: impl FnOnce(&mut T) -> Result<R, Failure>,
    ) -> Result<R, Failure> {
        let places = self.places.read().unwrap_or_else(PoisonError::into_inner);
        let slot = self.place(handle).and_then(|place| places.get(place));
        let held = match slot {
            Some((times, Some(held))) if i32::from(*times) == handle >> 16 => held,
            _ => return Err(self.unknown(handle)),
        };
        let mut value = held.lock().unwrap_or_else(PoisonError::into_inner);
        work(&mut value)
    }

    fn unknown(&self, handle: i32) -> Failure {
        let text = format!("{handle} is no handle of an open {}", self.kind);
        Failure::new(GUARDBIT_HANDLE, text)
    }
}

//! Words that wrap, and a DDA clock by clock.
#![allow(clippy::print_stdout, reason = "an example shows what it found")]

use guardbit::bits::{Bits, Event, RunTime, Word};
use guardbit::dda::{Op, Walker};
use guardbit::format::{Clamp, ReadOut};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // A width in the type, and the sum of two words with its event.
    let (a, b) = (Word::wrapping(Bits::<8>, 100), Word::wrapping(Bits::<8>, 100));
    let (sum, status) = a.overflowing_add(b);
    println!("8 bits: 100 + 100 = {}, wraps: {}", sum.to_i128(), status.has(Event::Wrap));

    // The same width chosen at run time.
    let width = RunTime::new(12)?;
    let word = Word::wrapping(width, 3000);
    println!("12 bits: 3000 is {:#05x} and reads as {}", word.to_bits(), word.to_i128());

    // A depth DDA of 1 guard bit, 4 integer bits and 4 interpolation bits: it starts at 14, gains 3/4 a
    // pixel, and leaves its range. The guard clamp decodes the guard half next to the top as the maximum.
    let read = ReadOut::new(1, 4, 4, Clamp::Guard)?;
    let mut walker = Walker::new(read, 14 << 4, 12, 0);
    for clock in 0..5 {
        walker.clock(if clock == 0 { Op::Load } else { Op::StepX });
        println!("clock {clock}: accumulator {:09b}, depth {}", walker.pattern(), walker.out());
    }
    Ok(())
}

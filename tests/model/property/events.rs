//! Read-outs, their lanes, and events in closed form.

use crate::property::cases;
use guardbit::bits::{Event, Lane, Place, SpanEvents};
use guardbit::dda::{Line, Op, Walker, twin};
use guardbit::format::{Clamp, ReadOut};
use num_bigint::BigInt;
use num_integer::Integer;
use proptest::prelude::*;

pub(crate) fn clamps() -> impl Strategy<Value = Clamp> {
    prop::sample::select(&Clamp::ALL[..])
}

/// Read-outs, small ones above all.
pub(crate) fn read_outs() -> impl Strategy<Value = ReadOut> {
    let small = (0..=4u32, 1..=4u32, 0..=4u32);
    let bits = |most: u32| prop_oneof![Just(0), 0..=most];
    let integer = prop_oneof![1..=64u32, prop::sample::select(&[31, 32, 33, 63, 64][..])];
    let large = (bits(8), integer, bits(48));
    (prop_oneof![small, large], clamps())
        .prop_map(|((g, i, f), clamp)| ReadOut::new(g, i, f, clamp).unwrap())
}

/// Accumulators about every boundary of a read-out, and anywhere.
pub(crate) fn accumulators(read: ReadOut) -> impl Strategy<Value = i128> {
    let width = read.width();
    let marks: Vec<i128> = vec![
        0,
        read.top(),
        read.top() / 2,
        1 << (width - 1),
        -(1 << (width - 1)),
        read.top() / 2 - (1 << (width - 1)),
        read.top() / 2 + (1 << (width - 1)),
        1 << width,
    ];
    prop_oneof![
        (prop::sample::select(marks), -3..=3i128).prop_map(|(mark, by)| mark + by),
        (any::<i64>(), 0..60u32).prop_map(|(v, shift)| i128::from(v) << shift >> 30),
        any::<i16>().prop_map(i128::from),
    ]
}

/// The result by the lecture's table, in unsigned patterns and big integers.
pub(crate) fn by_pattern(read: ReadOut, accumulator: i128) -> BigInt {
    let one = BigInt::from(1);
    let (g, i, f) = (read.guard(), read.integer(), read.fraction());
    let maximum = (&one << i) - 1;
    let unclamped = BigInt::from(accumulator).div_floor(&(&one << f));
    let top = unclamped.mod_floor(&(&one << (g + i)));
    match read.clamp() {
        Clamp::Wrap => unclamped.mod_floor(&(&one << i)),
        Clamp::Saturate => unclamped.clamp(BigInt::ZERO, maximum),
        Clamp::Sign => {
            let negative = top >= (&one << (g + i - 1));
            if negative { BigInt::ZERO } else { top.min(maximum) }
        }
        Clamp::Guard | Clamp::Error => {
            let pass = &one << i;
            let above: BigInt = ((&one << (g + i)) - &pass) / 2;
            if top < pass {
                top
            } else if top < pass + above {
                maximum
            } else {
                BigInt::ZERO
            }
        }
    }
}

/// The events of one sample, from the texts of the clauses.
pub(crate) fn by_definition(read: ReadOut, unwrapped: i128) -> [bool; 4] {
    let one = BigInt::from(1);
    let u = BigInt::from(unwrapped);
    let (n, i, f) = (read.width(), read.integer(), read.fraction());
    let half_word: BigInt = &one << (n - 1);
    let half_result: BigInt = &one << (i + f - 1);
    let (low, high) = match read.clamp() {
        Clamp::Guard | Clamp::Error => (&half_result - &half_word, &half_result + &half_word),
        Clamp::Sign => (-&half_word, half_word),
        Clamp::Wrap => (BigInt::ZERO, &one << (i + f)),
        Clamp::Saturate => (u.clone(), &u + 1),
    };
    let clamps = read.clamp() != Clamp::Wrap;
    [
        u < low || u >= high,
        clamps && u >= (&one << (i + f)),
        clamps && u < BigInt::ZERO,
        u.mod_floor(&(&one << f)) != BigInt::ZERO,
    ]
}

/// A lane reads what the format reads, or is refused for a reason.
fn lane_reads_alike<L: Lane>(read: ReadOut, accumulator: i128) -> Result<(), TestCaseError> {
    let needed = match read.clamp() {
        Clamp::Wrap => read.integer() + read.fraction(),
        _ => read.width(),
    };
    let sticky = read.clamp() == Clamp::Saturate;
    let Some(decode) = read.decode::<L>() else {
        // A result of all 32 bits has no room beside a 32-bit lane's sign.
        let unsigned = read.integer() == L::BITS && L::BITS < 64;
        prop_assert!(sticky || needed > L::BITS || unsigned, "{read:?} fits {}", L::BITS);
        return Ok(());
    };
    prop_assert!(!sticky && needed <= L::BITS);
    let value: u64 = decode.read(decode.load(accumulator)).as_();
    prop_assert_eq!(BigInt::from(value), by_pattern(read, accumulator), "{} bits", L::BITS);
    Ok(())
}

fn line(read: ReadOut) -> impl Strategy<Value = Line> {
    let slope = prop_oneof![
        accumulators(read),
        -9..=9i128,
        // Multiples of powers of two, for which only some samples are inexact.
        (-5..=5i128, 0..=read.fraction()).prop_map(|(slope, shift)| slope << shift),
    ];
    (accumulators(read), slope, 0..90u64).prop_map(|(start, slope, count)| Line {
        start,
        slope,
        count,
    })
}

proptest! {
    #![proptest_config(cases(3000))]

    // Clauses G-1, G-2, G-3, G-4
    #[test]
    fn a_read_out_is_the_table(
        (read, accumulator) in read_outs().prop_flat_map(|r| (Just(r), accumulators(r))),
    ) {
        prop_assert_eq!(BigInt::from(read.read(accumulator)), by_pattern(read, accumulator));
    }

    // Clauses G-6, W-3
    #[test]
    fn lanes_read_like_the_format(
        (read, accumulator) in read_outs().prop_flat_map(|r| (Just(r), accumulators(r))),
    ) {
        lane_reads_alike::<i32>(read, accumulator)?;
        lane_reads_alike::<i64>(read, accumulator)?;
        lane_reads_alike::<i128>(read, accumulator)?;
    }

    // Clauses V-1, V-2, G-3
    #[test]
    fn events_follow_their_definition(
        (read, accumulator) in read_outs().prop_flat_map(|r| (Just(r), accumulators(r))),
    ) {
        let status = read.status(accumulator);
        let got = Event::ALL.map(|event| status.has(event));
        prop_assert_eq!(got, by_definition(read, accumulator));
        prop_assert_eq!(status.is_none(), got == [false; 4]);
    }

    // Clauses V-3, V-4
    #[test]
    fn closed_form_events_are_those_of_every_sample(
        (read, line) in read_outs().prop_flat_map(|r| (Just(r), line(r))), x in -5..5i64,
    ) {
        let place = Place { y: 7, x };
        let closed = line.events(read, place);
        prop_assert_eq!(closed, twin::span_events(read, line, place));
        // And the twin itself, from the definition.
        let mut counts = [0u64; 4];
        let mut first = [None; 4];
        let mut values = Vec::new();
        for n in 0..line.count {
            let value = line.start + line.slope * i128::from(n);
            values.push(value);
            for (event, happened) in by_definition(read, value).into_iter().enumerate() {
                counts[event] += u64::from(happened);
                if happened && first[event].is_none() {
                    first[event] = Some(Place { y: 7, x: x + n.cast_signed() });
                }
            }
        }
        prop_assert_eq!((closed.counts, closed.first), (counts, first));
        let extent = closed.extent.map(|e| (e.minimum, e.maximum));
        prop_assert_eq!(extent, values.iter().min().copied().zip(values.iter().max().copied()));
    }

    // Clause V-3
    #[test]
    fn logs_join_like_one_long_run(
        (read, line) in read_outs().prop_flat_map(|r| (Just(r), line(r))), cut in 0..90u64,
    ) {
        let cut = cut.min(line.count);
        let place = Place { y: 0, x: 0 };
        let mut joined = SpanEvents::default();
        joined.append(&Line { count: cut, ..line }.events(read, place));
        let rest = Line { start: line.at(cut), count: line.count - cut, ..line };
        joined.append(&rest.events(read, Place { x: cut.cast_signed(), ..place }));
        prop_assert_eq!(joined, line.events(read, place));
    }

    // Clauses D-4, G-5
    #[test]
    fn the_register_view_is_plain_arithmetic(
        (read, start, dx, dy) in read_outs().prop_flat_map(|r| {
            (Just(r), accumulators(r), accumulators(r), accumulators(r))
        }),
        codes in prop::collection::vec(any::<u64>(), 0..24),
    ) {
        let n = read.width();
        let modulus = BigInt::from(1) << n;
        let signed = |value: i128| {
            let pattern = BigInt::from(value).mod_floor(&modulus);
            if pattern.clone() * 2 >= modulus { pattern - &modulus } else { pattern }
        };
        let sticky = read.clamp() == Clamp::Saturate;
        let top: BigInt = BigInt::from(read.top()) - 1;
        let hold = |value: BigInt| if sticky { value.clamp(BigInt::ZERO, top.clone()) } else { value };
        let loaded = match (sticky, read.guard()) {
            (false, _) => BigInt::from(start),
            (true, 0) => BigInt::from(start).mod_floor(&modulus),
            (true, _) => hold(signed(start)),
        };
        let mut walker = Walker::new(read, start, dx, dy);
        let mut expected = loaded.clone();
        for code in codes {
            walker.clock(Op::from_code(code));
            expected = match code % 4 {
                0 => loaded.clone(),
                1 => hold(expected + signed(dx)),
                2 => hold(expected + signed(dy)),
                _ => expected,
            };
            prop_assert_eq!(BigInt::from(walker.pattern()), expected.mod_floor(&modulus));
            let value = i128::try_from(expected.clone()).unwrap();
            prop_assert_eq!(BigInt::from(walker.out()), by_pattern(read, value));
            let status = walker.status();
            prop_assert_eq!(Event::ALL.map(|e| status.has(e)), by_definition(read, value));
        }
    }
}

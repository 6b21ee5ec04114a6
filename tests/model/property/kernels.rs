//! Every dispatched kernel against its twin, at every processor level this machine has.

use crate::property::cases;
use crate::property::events::{accumulators, read_outs};
use guardbit::bits::Lane;
use guardbit::dda::{Edges, Processor, count_inside, row_inside, row_values, twin, walk_checksum};
use guardbit::format::ReadOut;
use proptest::prelude::*;

fn row_values_alike<L: Lane>(
    read: ReadOut,
    start: i128,
    slope: i128,
    count: usize,
) -> Result<(), TestCaseError> {
    let Some(decode) = read.decode::<L>() else { return Ok(()) };
    let mut expected = vec![0; count];
    twin::row_values(read, start, slope, &mut expected);
    for processor in Processor::available() {
        let mut got = vec![u64::MAX; count];
        row_values(processor, decode, decode.load(start), decode.slope(slope), &mut got);
        prop_assert_eq!(&got, &expected, "{} {} bits", processor.name(), L::BITS);
    }
    Ok(())
}

fn checksum_alike<L: Lane>(
    read: ReadOut,
    plane: [i128; 3],
    size: (u32, u32),
) -> Result<(), TestCaseError> {
    let Some(decode) = read.decode::<L>() else { return Ok(()) };
    let mut expected = 0u64;
    for y in 0..size.1 {
        for x in 0..size.0 {
            let value = plane[0] + plane[1] * i128::from(x) + plane[2] * i128::from(y);
            expected = expected.wrapping_add(read.read(value) ^ u64::from(x));
        }
    }
    let words = [decode.load(plane[0]), decode.slope(plane[1]), decode.slope(plane[2])];
    for processor in Processor::available() {
        let mut rows = Vec::new();
        let got = walk_checksum(processor, decode, words, size, |y| rows.push(y));
        prop_assert_eq!(got, expected, "{} {} bits", processor.name(), L::BITS);
        prop_assert_eq!(rows, (0..size.1).collect::<Vec<_>>());
    }
    Ok(())
}

fn edges_alike<L: Lane>(
    width: u32,
    exact: Edges<i128>,
    size: (u32, u32),
) -> Result<(), TestCaseError> {
    if width > L::BITS {
        return Ok(());
    }
    let justify = |words: [i128; 3]| words.map(|word| L::justify(word, width));
    let lanes = Edges {
        value: justify(exact.value),
        step_x: justify(exact.step_x),
        step_y: justify(exact.step_y),
    };
    let expected = twin::row_inside(exact, width, size.0);
    let mut total = 0;
    for y in 0..i128::from(size.1) {
        let mut row = exact;
        for k in 0..3 {
            row.value[k] += exact.step_y[k] * y;
        }
        total +=
            twin::row_inside(row, width, size.0).iter().filter(|inside| **inside).count() as u64;
    }
    for processor in Processor::available() {
        let mut mask = vec![u64::MAX; 3];
        row_inside(processor, lanes, size.0, &mut mask);
        let bit = |n: u32| mask[n as usize / 64] >> (n % 64) & 1 == 1;
        let got: Vec<bool> = (0..size.0).map(bit).collect();
        prop_assert_eq!(&got, &expected, "{} {} bits", processor.name(), L::BITS);
        // Nothing is set beyond the row.
        let set: u32 = mask.iter().map(|word| word.count_ones()).sum();
        prop_assert_eq!(set as usize, expected.iter().filter(|inside| **inside).count());
        prop_assert_eq!(count_inside(processor, lanes, size), total, "{}", processor.name());
    }
    Ok(())
}

fn edge_words() -> impl Strategy<Value = [i128; 3]> {
    let word = prop_oneof![-3..=3i128, -1000..=1000i128, any::<i64>().prop_map(i128::from)];
    [word.clone(), word.clone(), word]
}

proptest! {
    #![proptest_config(cases(400))]

    // Clauses W-3, G-6, P-2
    #[test]
    fn row_values_equal_their_twin(
        (read, start, slope) in read_outs()
            .prop_flat_map(|r| (Just(r), accumulators(r), accumulators(r))),
        count in 0..200usize,
    ) {
        row_values_alike::<i32>(read, start, slope, count)?;
        row_values_alike::<i64>(read, start, slope, count)?;
        row_values_alike::<i128>(read, start, slope, count)?;
    }

    // Clauses W-3, D-3
    #[test]
    fn checksums_equal_a_plain_walk(
        (read, plane) in read_outs().prop_flat_map(|r| {
            (Just(r), [accumulators(r), accumulators(r), accumulators(r)])
        }),
        size in (0..100u32, 0..4u32),
    ) {
        checksum_alike::<i32>(read, plane, size)?;
        checksum_alike::<i64>(read, plane, size)?;
        checksum_alike::<i128>(read, plane, size)?;
    }

    // Clauses W-3, C-5
    #[test]
    fn edge_rows_equal_their_twin(
        width in 2..=120u32,
        value in edge_words(), step_x in edge_words(), step_y in edge_words(),
        size in (0..200u32, 0..4u32),
    ) {
        let exact = Edges { value, step_x, step_y };
        edges_alike::<i32>(width, exact, size)?;
        edges_alike::<i64>(width, exact, size)?;
        edges_alike::<i128>(width, exact, size)?;
        // Narrow words too, which wrap all the time.
        edges_alike::<i32>(2 + width % 12, exact, size)?;
    }
}

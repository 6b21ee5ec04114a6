//! Generated cases, made again from the text of the specification.

use crate::property::cases;
use guardbit::case::{Words, mix64, triangle::Stimulus, walk};
use guardbit::dda::Op;
use guardbit::profile::load;
use proptest::prelude::*;

/// mix and absorb in 128-bit arithmetic with explicit reduction.
fn word(seed: u64, class: u64, index: u64, n: u64) -> u64 {
    const MODULUS: u128 = 1 << 64;
    let mut state = 0u128;
    for part in [seed, class, index, n] {
        let mut w = ((state ^ u128::from(part)) + 0x9e37_79b9_7f4a_7c15) % MODULUS;
        w = (w ^ (w >> 30)) * 0xbf58_476d_1ce4_e5b9 % MODULUS;
        w = (w ^ (w >> 27)) * 0x94d0_49bb_1331_11eb % MODULUS;
        state = w ^ (w >> 31);
    }
    u64::try_from(state).unwrap()
}

/// The words of a case in turn, as bounded integers.
struct Draws {
    key: [u64; 3],
    next: u64,
}

impl Draws {
    fn between(&mut self, low: i128, high: i128) -> i128 {
        let word = word(self.key[0], self.key[1], self.key[2], self.next);
        self.next += 1;
        if high < low {
            return low;
        }
        // floor(word * count / 2^64)
        let count = u128::try_from(high - low + 1).unwrap();
        low + i128::try_from((u128::from(word) * count) >> 64).unwrap()
    }
}

proptest! {
    #![proptest_config(cases(500))]

    // Clauses
    #[test]
    fn words_are_the_written_function(key in any::<[u64; 4]>(), low in any::<i32>(), count in 0..1000i64) {
        let [seed, class, index, n] = key;
        prop_assert_eq!(mix64(seed, class, index, n), word(seed, class, index, n));
        let mut words = Words::new(seed, class, index);
        prop_assert_eq!(words.word(n), word(seed, class, index, n));
        let mut draws = Draws { key: [seed, class, index], next: 0 };
        for more in 0..4 {
            let (low, high) = (i64::from(low), i64::from(low) + count - 1 + more);
            prop_assert_eq!(words.between(low, high), draws.between(low.into(), high.into()));
        }
    }

    // Clause X-2
    #[test]
    fn random_walks_are_as_written(width in 1..=120u32, key in any::<[u64; 3]>()) {
        let w = |n: u64| word(key[0], key[1], key[2], n);
        let wide = |n: u64| {
            let top = (u128::from(w(2 * n)) << 64 | u128::from(w(2 * n + 1))) >> (128 - width);
            let signed = i128::try_from(top).unwrap();
            if top >> (width - 1) == 1 { signed - (1 << width) } else { signed }
        };
        let scale = |n: u32| u32::try_from((w(6) >> (16 * n)) % 65536).unwrap() % width;
        let half = |value: i128, times: u32| value.div_euclid(1i128 << times);
        let got = walk::random(width, Words::new(key[0], key[1], key[2]));
        let shift = if w(6) >= 1 << 63 { scale(0) } else { 0 };
        prop_assert_eq!((got.init, got.rows), (half(wide(0), shift), 64));
        prop_assert_eq!((got.dx, got.dy), (half(wide(1), scale(1)), half(wide(2), scale(2))));
        prop_assert_eq!(got.op(0), Op::Load);
        for row in 1..64u32 {
            let m = row - 1;
            let expected = match (w(8 + u64::from(m / 16)) >> (4 * (m % 16))) % 16 {
                0..=7 => Op::StepX,
                8..=12 => Op::StepY,
                _ => Op::Hold,
            };
            prop_assert_eq!(got.op(row), expected);
        }
    }

    // Clause X-3
    #[test]
    fn random_triangles_are_as_written(
        name in prop::sample::select(&["sgi-4k", "d3d11", "tiny"][..]),
        key in any::<[u64; 3]>(), reach in prop::option::of(1..64i128),
    ) {
        let profile = load(name).unwrap();
        let (low, high) = profile.vertex.range();
        let pixel = 1i128 << profile.vertex.sub_pixel;
        let mut draws = Draws { key, next: 0 };
        let largest = reach.map_or(high - low, |reach| reach * pixel);
        let bits = i128::from(128 - largest.leading_zeros());
        let size = largest >> draws.between(0, bits - 1);
        let corner = [profile.window.width, profile.window.height]
            .map(|side| draws.between(0, (i128::from(side) * pixel - size).max(0)));
        let xy = [(); 3].map(|()| {
            corner.map(|at| (at + draws.between(0, size.max(1))).clamp(low, high))
        });
        let top = i128::from(profile.depth_max());
        let z = [(); 3].map(|()| match draws.between(0, 7) {
            0 => 0,
            1 => top,
            _ => draws.between(0, top),
        });
        let got = Stimulus::new(&profile).random(Words::new(key[0], key[1], key[2]), reach);
        prop_assert_eq!((got.xy, got.z), (xy, Some(z)));
    }
}

//! Runs of set bits in a row mask.

/// Calls `run(start, end)` for each maximal run of set bits, 64 a word, least significant first.
pub fn for_each_run(mask: &[u64], mut run: impl FnMut(u32, u32)) {
    let mut open: Option<u32> = None;
    let mut base = 0;
    for &word in mask {
        let mut at = 0;
        while at < 64 {
            let rest = if open.is_some() { !word >> at } else { word >> at };
            // Shifted-in zeros of an inverted word would read as set bits of the mask: cap them.
            let skip = rest.trailing_zeros().min(64 - at);
            at += skip;
            if at < 64 {
                match open.take() {
                    Some(start) => run(start, base + at),
                    None => open = Some(base + at),
                }
            }
        }
        base += 64;
    }
    if let Some(start) = open {
        run(start, base);
    }
}

#[cfg(test)]
mod tests {
    use super::for_each_run;

    #[test]
    fn runs_join_across_words_and_cover_exactly_the_set_bits() {
        let masks: [&[u64]; 6] = [
            &[0],
            &[u64::MAX],
            &[1 << 63, 1],
            &[0b1011_0110, u64::MAX, 0, 5 << 60],
            &[],
            &[6, 1 << 63, 3],
        ];
        for mask in masks {
            let mut seen = vec![0; mask.len()];
            let mut last_end = None;
            for_each_run(mask, |start, end| {
                assert!(
                    start < end && last_end.is_none_or(|last| last < start),
                    "maximal and in order"
                );
                last_end = Some(end);
                for bit in start..end {
                    seen[bit as usize / 64] |= 1 << (bit % 64);
                }
            });
            assert_eq!(seen, mask);
        }
    }
}

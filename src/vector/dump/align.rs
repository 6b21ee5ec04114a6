//! Rows of one test in their order, lined up: one row too much or too little is one mismatch.

/// The most pairs of rows that are tried; beyond that, rows are taken one by one.
const MOST: usize = 1 << 22;

/// Which of a dump's rows belongs to each of `count` rows, and which are too much. As many rows as possible agree,
/// in order; between them, rows that differ are taken one by one.
pub(super) fn aligned(
    count: usize,
    theirs: &[usize],
    agrees: impl Fn(usize, usize) -> bool,
) -> (Vec<Option<usize>>, Vec<usize>) {
    let pairs = count.min(theirs.len());
    let first = (0..pairs).take_while(|n| agrees(*n, theirs[*n])).count();
    let last = (1..=pairs - first).take_while(|n| agrees(count - n, theirs[theirs.len() - n]));
    let last = last.count();
    let mut found: Vec<Option<usize>> = theirs[..first].iter().copied().map(Some).collect();
    let mut extra = Vec::new();
    let (middle, own) = (&theirs[first..theirs.len() - last], first..count - last);
    let mut gap = Gap::default();
    for step in steps(own.clone(), middle, &agrees) {
        match step {
            Step::Both(row) => {
                gap.close(&mut found, &mut extra);
                found.push(Some(row));
            }
            Step::Own => gap.own += 1,
            Step::Theirs(row) => gap.theirs.push(row),
        }
    }
    gap.close(&mut found, &mut extra);
    found.extend(theirs[theirs.len() - last..].iter().copied().map(Some));
    (found, extra)
}

enum Step {
    Both(usize),
    Own,
    Theirs(usize),
}

/// Rows between two that agree.
#[derive(Default)]
struct Gap {
    own: usize,
    theirs: Vec<usize>,
}

impl Gap {
    /// Takes rows that differ one by one; what is left over is missing or too much.
    fn close(&mut self, found: &mut Vec<Option<usize>>, extra: &mut Vec<usize>) {
        let mut theirs = std::mem::take(&mut self.theirs).into_iter();
        found.extend((0..std::mem::take(&mut self.own)).map(|_| theirs.next()));
        extra.extend(theirs);
    }
}

/// A longest common subsequence, as steps; without one where there are too many pairs.
fn steps(
    own: std::ops::Range<usize>,
    theirs: &[usize],
    agrees: &impl Fn(usize, usize) -> bool,
) -> Vec<Step> {
    let (height, width) = (own.len(), theirs.len());
    if height.saturating_mul(width) > MOST {
        let own = own.map(|_| Step::Own);
        return own.chain(theirs.iter().map(|row| Step::Theirs(*row))).collect();
    }
    // The longest from (n, m) on, row by row from the end.
    let mut longest = vec![0u32; (height + 1) * (width + 1)];
    let at = |n: usize, m: usize| n * (width + 1) + m;
    for n in (0..height).rev() {
        for m in (0..width).rev() {
            longest[at(n, m)] = if agrees(own.start + n, theirs[m]) {
                longest[at(n + 1, m + 1)] + 1
            } else {
                longest[at(n + 1, m)].max(longest[at(n, m + 1)])
            };
        }
    }
    let (mut n, mut m, mut steps) = (0, 0, Vec::new());
    while n < height || m < width {
        if n < height && m < width && agrees(own.start + n, theirs[m]) {
            steps.push(Step::Both(theirs[m]));
            (n, m) = (n + 1, m + 1);
        } else if m == width || n < height && longest[at(n + 1, m)] >= longest[at(n, m + 1)] {
            steps.push(Step::Own);
            n += 1;
        } else {
            steps.push(Step::Theirs(theirs[m]));
            m += 1;
        }
    }
    steps
}

#[cfg(test)]
mod tests {
    use super::aligned;

    /// What is missing and too much, of letters.
    fn lined_up(want: &str, got: &str) -> (usize, usize, usize) {
        let (want, got): (Vec<char>, Vec<char>) = (want.chars().collect(), got.chars().collect());
        let rows: Vec<usize> = (0..got.len()).collect();
        let (found, extra) = aligned(want.len(), &rows, |n, row| want[n] == got[row]);
        assert_eq!(found.len(), want.len());
        // Each row is used once.
        let mut used: Vec<usize> = found.iter().flatten().chain(&extra).copied().collect();
        used.sort_unstable();
        assert_eq!(used, (0..got.len()).collect::<Vec<_>>());
        let differ = (0..want.len()).filter(|n| found[*n].is_some_and(|row| got[row] != want[*n]));
        (found.iter().filter(|row| row.is_none()).count(), extra.len(), differ.count())
    }

    #[test]
    fn one_row_too_much_or_too_little_is_one_mismatch() {
        assert_eq!(lined_up("abcdef", "abcdef"), (0, 0, 0));
        assert_eq!(lined_up("abcdef", "abxcdef"), (0, 1, 0));
        assert_eq!(lined_up("abcdef", "abdef"), (1, 0, 0));
        assert_eq!(lined_up("abcdef", "abxdef"), (0, 0, 1));
        assert_eq!(lined_up("abcdef", "xabcdy"), (1, 1, 1));
        assert_eq!(lined_up("aaaa", "aaa"), (1, 0, 0));
        assert_eq!(lined_up("", "ab"), (0, 2, 0));
        assert_eq!(lined_up("ab", ""), (2, 0, 0));
    }
}

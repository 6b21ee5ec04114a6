//! Random registers of an engine with anchored planes, answered by the model.

use super::rich::Cases;
use super::{Digest, Stimulus};
use crate::format::Layout;
use crate::model::Model;
use crate::profile::Profile;
use crate::value::Channel;
use crate::vector::device::records;

/// Records that are looked at.
const MOST: u64 = 1024;

/// The digest of what random registers draw: the number of the records, and their words. `largest` is the longest
/// edge that is drawn.
pub(in crate::vector::reference) fn digest(
    profile: &Profile,
    model: &Model,
    (channels, largest): (&[Channel], [i128; 2]),
    seed: u64,
    cases: u64,
) -> u64 {
    let registers = model.registers().unwrap_or_else(|| unreachable!("it begins at registers"));
    let mut given = Cases::new(Stimulus::new(profile, seed), None);
    let mut digest = Digest(0xcbf2_9ce4_8422_2325);
    for n in 0..cases {
        let words = words(&registers.input, &mut given, n & 7, (channels, largest));
        let drawn = records(model, &words, MOST);
        digest.number(drawn.total);
        for (kind, values) in drawn.kept {
            for word in registers.records[kind].words(&values) {
                digest.number(word);
            }
        }
    }
    digest.0
}

/// The words of a case: anything, but for vertices, some values, and a rectangle that no large triangle fills.
fn words(
    input: &Layout,
    given: &mut Cases<'_>,
    kind: u64,
    (channels, largest): (&[Channel], [i128; 2]),
) -> Vec<u32> {
    let any = |given: &mut Cases<'_>| {
        let high = given.random().next() << 31;
        u32::try_from((high | given.random().next()) & u64::from(u32::MAX)).unwrap_or(0)
    };
    let mut words: Vec<u32> = (0..input.len()).map(|_| any(given)).collect();
    let mut put = |name: &str, value: i128| {
        if let Some(gather) = input.find(name) {
            gather.scatter(value, &mut words);
        }
    };
    let mut triangle = given.triangle(kind);
    if matches!(kind, 0 | 3) {
        triangle.xy = triangle.xy.map(|[x, y]| [x >> 1, y >> 2]);
    }
    if kind == 3 {
        // An edge as long as one may be, or longer by one.
        let (low, high) = given.profile().vertex.range();
        let xy = &mut triangle.xy;
        let side = if xy[0][0] < 0 { 1 } else { -1 };
        let more = given.random().below(2);
        let axis = usize::from(given.random().below(2) == 1);
        xy[1][axis] = (xy[0][axis] + side * (largest[axis] + more)).clamp(low, high);
        xy[2][axis] = (xy[0][axis] + xy[1][axis]) >> 1;
    }
    for (n, [x, y]) in triangle.xy.into_iter().enumerate() {
        put(&format!("x{n}"), x);
        put(&format!("y{n}"), y);
    }
    if kind & 3 == 3 {
        for channel in channels {
            for n in 0..3 {
                let end = if given.random().next() & 1 == 1 { -1 } else { 0 };
                put(&format!("{}{n}", channel.name), end);
            }
        }
    }
    let [width, height] = given.size();
    let mut ends = [0, 0, width - 1, height - 1];
    if matches!(kind, 0 | 3 | 7) || given.random().below(2) == 0 {
        let [x, y] = given.pixel(2, &triangle).map(i128::from);
        let left = (x - given.random().below(8)).clamp(0, x);
        let top = (y - given.random().below(8)).clamp(0, y);
        let right = (left + given.random().below(24)).clamp(0, width - 1);
        let bottom = (top + given.random().below(24)).clamp(0, height - 1);
        ends = [left, top, right, bottom];
    }
    for (name, end) in ["left", "top", "right", "bottom"].into_iter().zip(ends) {
        put(name, end);
    }
    words
}

//! A triangle as spans between lines. Spec clauses `RL-8` and `RL-9`.

use super::{Lines, Pen, Pixel};
#[cfg(feature = "verification")]
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Which pixel of a line ends a span, of those that the line has in the row.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum SpanEnd {
    /// The one on which the line enters the row.
    First,
    /// The one on which it leaves the row.
    Last,
    /// The one that makes the span longest.
    Outermost,
}

/// What is drawn in the row of the middle vertex.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum MiddleRow {
    /// The span to the upper short line.
    Upper,
    /// The span to the lower short line.
    Lower,
    /// Both.
    Both,
    /// The span to the upper short line, then one from the middle vertex to where the long line enters the
    /// next row.
    BothAhead,
}

/// How a triangle is filled.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct FillConfig {
    /// The exchanges that sort the vertices by y, in order: two vertices change places if the first of them
    /// is lower.
    pub sort: Vec<[u8; 2]>,
    /// Which pixel of a line ends a span.
    pub span_end: SpanEnd,
    /// What is drawn in the row of the middle vertex.
    pub middle: MiddleRow,
}

/// The most exchanges.
const EXCHANGES: usize = 8;

impl FillConfig {
    /// The vertices from top to bottom.
    fn sorted<T: Copy>(&self, mut v: [T; 3], y: impl Fn(T) -> i128) -> [T; 3] {
        for [i, j] in self.sort.iter().map(|pair| pair.map(usize::from)) {
            if y(v[i]) > y(v[j]) {
                v.swap(i, j);
            }
        }
        v
    }

    /// Refuses exchanges that do not sort.
    pub(super) fn check(&self) -> Result<(), String> {
        let sort = &self.sort;
        if sort.len() > EXCHANGES || sort.iter().any(|[i, j]| *i > 2 || *j > 2 || i == j) {
            return Err(format!(
                "draws.fill.sort = {sort:?}: at most {EXCHANGES} pairs of different vertices 0 to 2 are needed"
            ));
        }
        // Exchanges that sort all lists of zeros and ones sort every list.
        for n in 0..8 {
            let given = [n & 1, n >> 1 & 1, n >> 2];
            let [a, b, c] = self.sorted(given, |y| y);
            if a > b || b > c {
                return Err(format!(
                    "draws.fill.sort = {sort:?}: vertices with y = {given:?} are left in the order {:?}; add the \
                     exchange that is missing",
                    [a, b, c]
                ));
            }
        }
        Ok(())
    }
}

/// What a line has in a row.
#[derive(Clone, Copy, Debug)]
struct RowPart {
    y: i128,
    first: i128,
    last: i128,
}

/// The rows of a line.
#[derive(Debug, Default)]
struct Rows(Vec<RowPart>);

impl Rows {
    fn add(&mut self, [x, y]: Pixel) {
        match self.0.last_mut() {
            Some(part) if part.y == y => part.last = x,
            _ => self.0.push(RowPart { y, first: x, last: x }),
        }
    }

    /// The part in a row. The line runs down, so its rows follow each other.
    fn at(&self, y: i128) -> Option<RowPart> {
        let place = usize::try_from(y - self.0.first()?.y).ok()?;
        self.0.get(place).copied()
    }
}

impl Lines {
    /// The rows of a line from an upper to a lower vertex.
    fn rows(&self, from: Pixel, to: Pixel) -> Rows {
        let mut pixels = Vec::new();
        self.steps([from, to], &mut |at| pixels.push(at));
        if from[1] > pixels.first().map_or(from[1], |at| at[1]) {
            pixels.reverse();
        }
        let mut rows = Rows::default();
        for at in pixels {
            rows.add(at);
        }
        rows
    }

    pub(super) fn fill(&self, fill: &FillConfig, corners: [Pixel; 3], pen: &mut Pen<'_>) {
        let [top, middle, bottom] = fill.sorted(corners, |at| at[1]);
        let long = self.rows(top, bottom);
        let (upper, lower) = (self.rows(top, middle), self.rows(middle, bottom));
        let mut span = |y: i128, ends: [RowPart; 2]| {
            let [a, b] = match fill.span_end {
                SpanEnd::First => ends.map(|part| [part.first; 2]),
                SpanEnd::Last => ends.map(|part| [part.last; 2]),
                SpanEnd::Outermost => ends.map(|part| [part.first, part.last]),
            };
            let all = [a[0], a[1], b[0], b[1]];
            let (from, to) =
                all.iter().fold((a[0], a[0]), |(from, to), x| (from.min(*x), to.max(*x)));
            (from..=to).for_each(|x| pen.plot([x, y], false));
            pen.line += 1;
        };
        for y in top[1]..=bottom[1] {
            // A stepper that misses its end leaves rows without a pixel.
            let Some(side) = long.at(y) else { continue };
            let has = |rows: &Rows, drawn: bool| rows.at(y).filter(|_| drawn);
            let at_middle = y == middle[1];
            let shorts = [
                has(&upper, y < middle[1] || (at_middle && fill.middle != MiddleRow::Lower)),
                has(
                    &lower,
                    y > middle[1]
                        || (at_middle && matches!(fill.middle, MiddleRow::Lower | MiddleRow::Both)),
                ),
            ];
            for short in shorts.into_iter().flatten() {
                span(y, [side, short]);
            }
            if at_middle
                && fill.middle == MiddleRow::BothAhead
                && let Some(next) = long.at(y + 1)
            {
                let vertex = RowPart { y, first: middle[0], last: middle[0] };
                span(y, [next, vertex]);
            }
        }
    }
}

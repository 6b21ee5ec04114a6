//! The diamond exit rule, exactly. Spec clause `L-4`.
//!
//! In u = x + y and v = x - y a pixel's diamond is an upright square, so a segment is cut by it as by
//! a clip rectangle: four bounds on the part of the way, compared as fractions.

use super::Segment;
use crate::bits::bounded;
use crate::cover::rect::Rect;
use crate::cover::sample::SampleGrid;
use std::cmp::Ordering;

/// Whose diamond.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// u in (low, high], v in [low, high): the lower edges and the bottom corner; for y-major lines
    /// the right corner as well.
    D3d,
    /// Open, the line moved by -(e, e^2).
    Vulkan,
}

/// A part of the way from start to end: (numerator + first e + second e^2) / denominator, with a
/// positive denominator.
#[derive(Clone, Copy, Debug)]
struct Part {
    numerator: i128,
    first: i128,
    second: i128,
    denominator: i128,
    closed: bool,
}

impl Part {
    fn compare(&self, other: &Self) -> Ordering {
        let terms = [
            (self.numerator, other.numerator),
            (self.first, other.first),
            (self.second, other.second),
        ];
        let sides = terms.map(|(a, b)| (a * other.denominator).cmp(&(b * self.denominator)));
        sides[0].then(sides[1]).then(sides[2])
    }

    fn whole(value: i128) -> Self {
        Self { numerator: value, first: 0, second: 0, denominator: 1, closed: true }
    }
}

/// What the segment does on one rotated axis between two bounds: the part of the way inside.
///
/// `shift` is what the perturbation takes off the coordinate, in e and e^2; `closed` says which bounds
/// are themselves inside.
fn inside(
    from: i128,
    by: i128,
    [low, high]: [i128; 2],
    shift: [i128; 2],
    closed: [bool; 2],
) -> Option<[Part; 2]> {
    // from + t by - shift > low, and the same below high.
    let part = |bound: i128, closed| {
        let sign = by.signum();
        Part {
            numerator: (bound - from) * sign,
            first: shift[0] * sign,
            second: shift[1] * sign,
            denominator: by.abs(),
            closed,
        }
    };
    if by == 0 {
        let beyond = |bound: i128, closed: bool, wanted: Ordering| {
            let first = (from - bound).cmp(&0);
            let order = first.then((-shift[0]).cmp(&0)).then((-shift[1]).cmp(&0));
            order == wanted || (order == Ordering::Equal && closed)
        };
        let always =
            beyond(low, closed[0], Ordering::Greater) && beyond(high, closed[1], Ordering::Less);
        return always.then(|| [Part::whole(0), Part::whole(1)]);
    }
    let bounds = [part(low, closed[0]), part(high, closed[1])];
    Some(if by > 0 { bounds } else { [bounds[1], bounds[0]] })
}

/// The later of two beginnings; where they agree, the open one.
fn later(a: Part, b: Part) -> Part {
    match a.compare(&b) {
        Ordering::Less => b,
        Ordering::Equal => Part { closed: a.closed && b.closed, ..a },
        Ordering::Greater => a,
    }
}

fn earlier(a: Part, b: Part) -> Part {
    match a.compare(&b) {
        Ordering::Greater => b,
        Ordering::Equal => Part { closed: a.closed && b.closed, ..a },
        Ordering::Less => a,
    }
}

/// A line in rotated coordinates.
struct Rotated {
    kind: Kind,
    from: [i128; 2],
    by: [i128; 2],
    y_major: bool,
    /// Half a pixel.
    half: i128,
}

impl Rotated {
    /// The part of the way inside the diamond around a rotated centre.
    fn cut(&self, centre: [i128; 2]) -> bool {
        let bounds = centre.map(|c| [c - self.half, c + self.half]);
        let (shift, closed) = match self.kind {
            Kind::D3d => ([[0, 0], [0, 0]], [[false, true], [true, false]]),
            Kind::Vulkan => ([[1, 1], [1, -1]], [[false; 2]; 2]),
        };
        let axis = |k: usize| inside(self.from[k], self.by[k], bounds[k], shift[k], closed[k]);
        if let (Some([u0, u1]), Some([v0, v1])) = (axis(0), axis(1)) {
            let begin = later(later(u0, v0), Part::whole(0));
            let end = earlier(earlier(u1, v1), Part::whole(1));
            match begin.compare(&end) {
                Ordering::Less => return true,
                Ordering::Equal if begin.closed && end.closed => return true,
                _ => {}
            }
        }
        self.has_right_corner(centre, [self.from, self.to()])
    }

    fn to(&self) -> [i128; 2] {
        [self.from[0] + self.by[0], self.from[1] + self.by[1]]
    }

    /// Whether a y-major line of Direct3D passes through the right corner, within its ends.
    fn has_right_corner(&self, centre: [i128; 2], ends: [[i128; 2]; 2]) -> bool {
        let corner = centre.map(|c| c + self.half);
        let d = [corner[0] - self.from[0], corner[1] - self.from[1]];
        let within = (0..2).all(|k| {
            let [a, b] = [ends[0][k], ends[1][k]];
            (a.min(b)..=a.max(b)).contains(&corner[k])
        });
        self.kind == Kind::D3d && self.y_major && within && d[0] * self.by[1] == d[1] * self.by[0]
    }

    /// Whether the line ends inside the diamond, and so does not leave it.
    fn ends_in(&self, centre: [i128; 2]) -> bool {
        let [u, v] = self.to();
        let ([cu, cv], h) = (centre, self.half);
        match self.kind {
            // Moved down by less than anything: the low bounds are left, the high ones reached.
            Kind::Vulkan => cu - h < u && u <= cu + h && cv - h < v && v <= cv + h,
            Kind::D3d => {
                let square = cu - h < u && u <= cu + h && cv - h <= v && v < cv + h;
                square || (self.y_major && u == cu + h && v == cv + h)
            }
        }
    }
}

/// The pixels whose diamond a line enters and leaves, in walking order, with their number among
/// those of the whole line that the window's major axis holds.
pub(super) fn walk(
    kind: Kind,
    [from, to]: Segment,
    grid: &SampleGrid,
    clip: Rect,
    plot: &mut dyn FnMut(u64, i128, i128),
) {
    // Twice the sub-pixel, so that half a pixel is whole on any grid.
    let double = |p: [i128; 2]| p.map(|value| 2 * value);
    let (from, to) = (double(from), double(to));
    let (d, pixel) = ([to[0] - from[0], to[1] - from[1]], 2i128 << grid.sub_pixel);
    let y_major = d[1].abs() > d[0].abs();
    let (major, minor) = if y_major { (1, 0) } else { (0, 1) };
    let rotate = |[x, y]: [i128; 2]| [x + y, x - y];
    let line = Rotated { kind, from: rotate(from), by: rotate(d), y_major, half: pixel / 2 };
    let (low, end) = if y_major { (clip.y0, clip.y1) } else { (clip.x0, clip.x1) };
    let (low, end) = (i128::from(low), i128::from(end));
    let column = |value: i128| value.div_euclid(pixel);
    let (first, last) = (column(from[major]), column(to[major]));
    let sign = if last < first || d[major] < 0 { -1 } else { 1 };
    // A diamond reaches to its pixel's borders and no further; an end on a border meets two pixels.
    let (begin, stop) = (first - sign, last + sign);
    let (skip, until) = if sign > 0 {
        (begin.max(low), stop.min(end - 1))
    } else {
        (begin.min(end - 1), stop.max(low))
    };
    let mut at = skip;
    while (until - at) * sign >= 0 {
        let centre = at * pixel + pixel / 2;
        // Where the line meets the middle of this column, or its nearer end.
        let along = (centre - from[major]) * sign;
        let whole = d[major].abs();
        let height = if whole == 0 {
            from[minor]
        } else {
            from[minor] + (d[minor] * along.clamp(0, whole)).div_euclid(whole)
        };
        let near = column(height);
        let step = if d[minor] < 0 { -1 } else { 1 };
        for across in [near - step, near, near + step] {
            let mut p = [0; 2];
            (p[major], p[minor]) = (centre, across * pixel + pixel / 2);
            let place = rotate(p);
            if line.cut(place) && !line.ends_in(place) {
                // A pixel before the first column, which only a point-like end cuts, counts as the first.
                let number: u64 = bounded(((at - first) * sign).max(0));
                if y_major { plot(number, across, at) } else { plot(number, at, across) }
            }
        }
        at += sign;
    }
}

//! The one colour scale of errors, and its legend: `render`, `compare` and the page of `explore` share it.
//!
//! It is logarithmic, because one sliver that is worse than all the rest would leave nothing but blue on
//! a linear one. It ends at a power of two, so that its marks are exact, and pictures that are compared
//! with each other have the same one.

use guardbit::measure::error::SampleError;

pub(crate) type Colour = [u8; 3];

pub(crate) const BACKGROUND: Colour = [24, 26, 32];
/// A sample that only the exact triangle covers.
const MISSING: Colour = [255, 255, 255];
/// A sample that only the model covers.
const EXTRA: Colour = [255, 0, 255];
/// Colours of the scale; few enough that a map packs well, more than an eye tells apart.
const LEVELS: u8 = 64;
/// From the end of the scale down to its beginning.
const OCTAVES: i32 = 8;
/// From one mark of the legend to the next.
const STEP: i32 = 2;
/// Blue to red, of about even lightness, so that white and magenta stand out everywhere.
const HEAT: [Colour; 5] =
    [[44, 84, 190], [38, 156, 178], [132, 186, 92], [236, 168, 60], [206, 44, 40]];
/// What white and magenta mean.
pub(crate) const WRONG: &str = "White: a missing sample. Magenta: an extra sample.";

/// What a picture pixel shows: the worst of its samples, by this order.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub(crate) enum Seen {
    Nothing,
    /// An error's size in ULP.
    Error(f64),
    Extra,
    Missing,
}

impl From<SampleError> for Seen {
    fn from(error: SampleError) -> Self {
        match error {
            SampleError::Depth(ulp) => Self::Error(ulp.abs()),
            SampleError::Extra => Self::Extra,
            SampleError::Missing => Self::Missing,
        }
    }
}

/// A scale by its end: 2 to this power, in ULP.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Scale(i32);

impl Scale {
    /// The scale on which the worst of some errors still has a place.
    pub(crate) fn of(errors: impl IntoIterator<Item = f64>) -> Self {
        let worst = errors.into_iter().filter(|error| error.is_finite()).fold(0.0, f64::max);
        // Where nothing is wrong, it ends at 1 ULP.
        #[allow(clippy::cast_possible_truncation, reason = "an exponent of f64 has 11 bits")]
        let end = if worst > 0.0 { worst.log2().ceil() as i32 } else { 0 };
        Self(end)
    }

    /// The part of the scale that an error is at, from 0 to 1.
    fn part(self, error: f64) -> f64 {
        let part = 1.0 + (error.log2() - f64::from(self.0)) / f64::from(OCTAVES);
        if part.is_nan() { 0.0 } else { part.clamp(0.0, 1.0) }
    }

    /// The place in [`palette`] of what a pixel shows.
    pub(crate) fn level(self, seen: Seen) -> u8 {
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "few levels")]
        match seen {
            Seen::Error(ulp) => (self.part(ulp) * f64::from(LEVELS - 1)).round() as u8,
            Seen::Nothing => LEVELS,
            Seen::Missing => LEVELS + 1,
            Seen::Extra => LEVELS + 2,
        }
    }

    /// The marks of the legend, from the beginning to the end.
    pub(crate) fn marks(self) -> impl Iterator<Item = String> {
        (0..=OCTAVES / STEP).map(move |n| power(self.0 - OCTAVES + n * STEP))
    }

    /// The legend in words.
    pub(crate) fn words(self) -> String {
        format!("blue: {} ULP or less, red: {} ULP", power(self.0 - OCTAVES), power(self.0))
    }
}

/// A power of two as people write it.
fn power(exponent: i32) -> String {
    match exponent {
        // Beyond this, digits say less.
        31.. => format!("2^{exponent}"),
        0..31 => (1u32 << exponent).to_string(),
        -16..0 => format!("1/{}", 1u32 << -exponent),
        _ => format!("2^{exponent}"),
    }
}

/// The colours of the scale, in order.
pub(crate) fn colours() -> impl Iterator<Item = Colour> {
    let last = usize::from(LEVELS) - 1;
    (0..=last).map(move |level| {
        let at = level * (HEAT.len() - 1);
        let (below, part) = (at / last, at % last);
        let above = (below + 1).min(HEAT.len() - 1);
        std::array::from_fn(|channel| {
            let [from, to] = [below, above].map(|n| usize::from(HEAT[n][channel]));
            u8::try_from((from * (last - part) + to * part) / last).unwrap_or(u8::MAX)
        })
    })
}

/// The colours that [`Scale::level`] counts.
pub(crate) fn palette() -> impl Iterator<Item = Colour> {
    colours().chain([BACKGROUND, MISSING, EXTRA])
}

/// The scale as a gradient of CSS.
pub(crate) fn gradient() -> String {
    let stops: Vec<String> =
        colours().step_by(9).map(|[r, g, b]| format!("rgb({r} {g} {b})")).collect();
    format!("linear-gradient(to right,{})", stops.join(","))
}

/// Rows of a legend in pixels.
const LEGEND_ROWS: u32 = 32;
/// Pixels of a picture in which the marks do not touch each other.
pub(crate) const LEGEND_LEAST: u32 = 192;
const MARGIN: usize = 12;
const GLYPH: [usize; 2] = [3, 5];

/// The legend in pixels, as wide as a picture: the scale, and its marks below in digits of 3 x 5 dots.
pub(crate) fn legend(scale: Scale, width: usize) -> Vec<Colour> {
    let mut pixels = vec![BACKGROUND; width * LEGEND_ROWS as usize];
    let colours: Vec<Colour> = colours().collect();
    let bar = width.saturating_sub(2 * MARGIN).max(1);
    for (x, y) in (0..bar).flat_map(|x| (6..14).map(move |y| (x, y))) {
        pixels[y * width + (MARGIN + x).min(width - 1)] = colours[x * colours.len() / bar];
    }
    let marks: Vec<String> = scale.marks().collect();
    let last = marks.len() - 1;
    // Pixels of a dot, on a side.
    let dot = if width < 512 { 1 } else { 2 };
    for (n, mark) in marks.iter().enumerate() {
        let text = if n == last { format!("{mark} ulp") } else { mark.clone() };
        let at = MARGIN + n * (bar - 1) / last;
        for y in 14..17 {
            pixels[y * width + at.min(width - 1)] = [200; 3];
        }
        // The middle of a text is below its mark, and the ends stay inside.
        let wide = text.len() * (GLYPH[0] + 1) * dot;
        let from = at.saturating_sub(wide / 2).min(width.saturating_sub(wide + 1)).max(1);
        for (n, letter) in text.bytes().enumerate() {
            for (x, y) in lit(letter) {
                let x = from + (n * (GLYPH[0] + 1) + x) * dot;
                for (x, y) in (0..dot * dot).map(|k| (x + k % dot, 19 + y * dot + k / dot)) {
                    if x < width {
                        pixels[y * width + x] = [200; 3];
                    }
                }
            }
        }
    }
    pixels
}

/// The lit pixels of a digit or sign; other signs are blank.
fn lit(letter: u8) -> impl Iterator<Item = (usize, usize)> {
    // Three bits a row, the top row first.
    let rows: u16 = match letter {
        b'0' => 0b111_101_101_101_111,
        b'1' => 0b010_110_010_010_111,
        b'2' => 0b111_001_111_100_111,
        b'3' => 0b111_001_111_001_111,
        b'4' => 0b101_101_111_001_001,
        b'5' => 0b111_100_111_001_111,
        b'6' => 0b111_100_111_101_111,
        b'7' => 0b111_001_010_010_010,
        b'8' => 0b111_101_111_101_111,
        b'9' => 0b111_101_111_001_111,
        b'/' => 0b001_001_010_100_100,
        b'^' => 0b010_101_000_000_000,
        b'-' => 0b000_000_111_000_000,
        b'u' => 0b000_101_101_101_111,
        b'l' => 0b100_100_100_100_111,
        b'p' => 0b111_101_111_100_100,
        _ => 0,
    };
    let [wide, high] = GLYPH;
    (0..wide * high)
        .filter(move |bit| rows >> (wide * high - 1 - bit) & 1 == 1)
        .map(move |bit| (bit % wide, bit / wide))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_scale_ends_at_the_power_of_two_above_the_worst_error() {
        let some = Scale::of([3.0, 50.0, f64::INFINITY]);
        assert_eq!(some, Scale(6));
        // Eight octaves below 64 is 1/4.
        for (error, part) in [(0.0, 0.0), (0.25, 0.0), (4.0, 0.5), (64.0, 1.0), (1e9, 1.0)] {
            assert!((some.part(error) - part).abs() < 1e-12, "{error}");
        }
        assert_eq!(some.marks().collect::<Vec<_>>(), ["1/4", "1", "4", "16", "64"]);
        assert_eq!((Scale::of([]), Scale::of([0.0])), (Scale(0), Scale(0)));
        assert_eq!(Scale::of([1.0]), Scale(0), "a power of two is its own end");
        let colours: Vec<Colour> = colours().collect();
        assert_eq!((colours[0], colours[63], colours.len()), (HEAT[0], HEAT[4], 64));
        assert_eq!(palette().nth(usize::from(some.level(Seen::Missing))), Some(MISSING));
        assert_eq!(palette().nth(usize::from(some.level(Seen::Extra))), Some(EXTRA));
    }

    #[test]
    fn worse_wins_a_pixel() {
        let order = [Seen::Nothing, Seen::Error(0.0), Seen::Error(1.5), Seen::Extra, Seen::Missing];
        assert!(order.windows(2).all(|pair| pair[0] < pair[1]));
    }

    #[test]
    fn a_legend_has_every_colour_in_order_and_fits_any_width() {
        for width in 1..300 {
            assert_eq!(legend(Scale(40), width).len(), width * LEGEND_ROWS as usize, "{width}");
        }
        let wide = legend(Scale(0), 256);
        let bar: Vec<Colour> = wide[10 * 256..11 * 256].to_vec();
        let mut seen: Vec<Colour> = bar.into_iter().filter(|seen| *seen != BACKGROUND).collect();
        seen.dedup();
        assert_eq!(seen, colours().collect::<Vec<_>>());
    }
}

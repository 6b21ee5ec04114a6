//! The depth plane of a set-up unit: numerators, three quotients, and their rounding.

use super::{Three, Unit, determinant, difference};
use crate::bits::Rounding;
use crate::vector::suspect::fault::{Operator, Path, Relation};

const NUMERATORS: Three =
    ["numerator of depth_init", "numerator of depth_dx", "numerator of depth_dy"];
const SHIFTS: Three = [
    "direction of the shift of the numerator of depth_init",
    "direction of the shift of the numerator of depth_dx",
    "direction of the shift of the numerator of depth_dy",
];
const SCALES: Three = [
    "left shift of the numerator of depth_init",
    "left shift of the numerator of depth_dx",
    "left shift of the numerator of depth_dy",
];

impl Unit<'_> {
    /// The plane at the sample of pixel (0, 0), and its slopes.
    pub(super) fn plane(&self, path: &Path, [x, y, z]: [[i128; 3]; 3], area: i128) -> [i128; 3] {
        let bits = self.coordinate + 2;
        let minus = |name, a, b| path.sum(name, Operator::Subtract, [a, b], bits);
        let side = |names: [&'static str; 3], v: [i128; 3], from: usize, other: i128| {
            difference(path, names, v, [from, 0], other, bits)
        };
        let zab = side(["zb - za", "zb in zb - za", "za in zb - za"], z, 1, x[1]);
        let zac = side(["zc - za", "zc in zc - za", "za in zc - za"], z, 2, x[2]);
        let xab = side(["xb - xa", "xb in xb - xa", "xa in xb - xa"], x, 1, y[1]);
        let yab = side(["yb - ya", "yb in yb - ya", "ya in yb - ya"], y, 1, x[1]);
        let xac = side(["xc - xa", "xc in xc - xa", "xa in xc - xa"], x, 2, y[2]);
        let yac = side(["yc - ya", "yc in yc - ya", "ya in yc - ya"], y, 2, x[2]);
        let wide = 2 * bits;
        let names = ["the numerator dz/dx", "(zb - za) (yc - ya)", "(zc - za) (yb - ya)"];
        let gx = determinant(path, names, [zab, yac, zac, yab], wide);
        let names = ["the numerator dz/dy", "(xb - xa) (zc - za)", "(xc - xa) (zb - za)"];
        let gy = determinant(path, names, [xab, zac, xac, zab], wide);
        let [sx, sy] = self.grid.offset;
        let (sx, sy) = (
            path.number("x of the sample in the plane", sx),
            path.number("y of the sample in the plane", sy),
        );
        let right = path.product("dz/dx (sample x - xa)", gx, minus("sample x - xa", sx, x[0]));
        let down = path.product("dz/dy (sample y - ya)", gy, minus("sample y - ya", sy, y[0]));
        let base = path.product("za times the area", z[0], area);
        let gz = path.sum("the start's first sum", Operator::Add, [base, right], wide);
        let gz = path.sum("the start's second sum", Operator::Add, [gz, down], wide);
        let fraction = i128::from(self.depth.read_out().fraction());
        let slope = fraction + i128::from(self.grid.sub_pixel);
        let numerators = [("the start's", gz), ("dz/dx", gx), ("dz/dy", gy)];
        let [start, dx, dy] = [0, 1, 2].map(|k| {
            let near = [numerators[(k + 1) % 3], numerators[(k + 2) % 3]];
            let numerator = path.only(NUMERATORS[k], numerators[k], near);
            let scale = path.number(SCALES[k], if k == 0 { fraction } else { slope });
            let slopes = if k == 0 {
                scale
            } else {
                path.number("left shift of the numerators of both slopes", scale)
            };
            path.within("setup_divider", || {
                let (left, right) =
                    (numerator << slopes.clamp(0, 64), numerator >> slopes.clamp(0, 64));
                let numerator = path.only(SHIFTS[k], ("left", left), [("right", right)]);
                self.divide(path, numerator, area)
            })
        });
        let bias = path.number("the start's half step", self.depth.start_bias());
        [path.sum("the start's bias", Operator::Add, [start, bias], 64), dx, dy]
    }

    /// Division of magnitudes, rounded by sign, remainder and the quotient's lowest bit.
    fn divide(&self, path: &Path, numerator: i128, divisor: i128) -> i128 {
        let negative = path.compare("the divider's sign: numerator", numerator, Relation::Less, 0);
        let n = path
            .choose(
                "the divider's magnitude",
                usize::from(negative),
                [("the numerator", numerator), ("minus the numerator", numerator.wrapping_neg())],
            )
            .cast_unsigned();
        let d = divisor.cast_unsigned();
        if d == 0 {
            // Nobody reads that quotient.
            return -1;
        }
        let (mut q, mut r) = (n / d, n % d);
        let name = "the divider subtracts where remainder";
        let strict = path.only(name, (">= divisor", false), [("> divisor", true)]);
        if strict && r == 0 && q > 0 {
            // An exact quotient leaves the whole divisor as its remainder.
            (q, r) = (q - 1, d);
        }
        if path.when("the divider stops one bit early", false) {
            (q, r) = (q >> 1, (q & 1) * d + r);
        }
        let near = [("zero", 0), ("twice the remainder", 2 * r), ("half the remainder", r >> 1)];
        let r = path.only("the divider's remainder", ("the remainder", r), near).cast_signed();
        let q = path.sum("the quotient", Operator::Add, [q.cast_signed(), 0], 2);
        let d = d.cast_signed();
        let twice = r.wrapping_mul(2);
        let inexact = path.compare("inexact: remainder", r, Relation::Unequal, 0);
        let over = path.compare(
            "more than half: twice the remainder against the divisor",
            twice,
            Relation::Greater,
            d,
        );
        let tie = path.compare(
            "a tie: twice the remainder against the divisor",
            twice,
            Relation::Equal,
            d,
        );
        let near = [("its second bit", q >> 1 & 1), ("its third bit", q >> 2 & 1)];
        let odd =
            path.only("the bit that decides a tie", ("the quotient's lowest bit", q & 1), near)
                == 1;
        let odd = path.when("an odd quotient", odd);
        let minus = path.when("a negative quotient, for its rounding", negative);
        let up = match self.depth.config().rounding {
            Rounding::Floor => inexact && minus,
            Rounding::Ceiling => inexact && !minus,
            Rounding::TowardZero => false,
            Rounding::AwayFromZero => inexact,
            Rounding::NearestEven => over || path.all("rounded up in a tie (tie, odd)", [tie, odd]),
            Rounding::NearestUp => {
                over || path.all("rounded up in a tie (tie, not negative)", [tie, !minus])
            }
            Rounding::NearestDown => {
                over || path.all("rounded up in a tie (tie, negative)", [tie, minus])
            }
            Rounding::NearestAway => over || tie,
            Rounding::NearestTowardZero => over,
            Rounding::Odd => path.all("rounded up (inexact, even)", [inexact, !odd]),
        };
        let up = path.when("the quotient is rounded up", up);
        let magnitude =
            path.sum("the sum that rounds the quotient", Operator::Add, [q, i128::from(up)], 8);
        let near = [("its complement", !magnitude)];
        let minus = ("two's complement", magnitude.wrapping_neg());
        let negated = path.only("the negative quotient", minus, near);
        path.choose(
            "the quotient's sign",
            usize::from(negative),
            [("plus", magnitude), ("minus", negated)],
        )
    }
}

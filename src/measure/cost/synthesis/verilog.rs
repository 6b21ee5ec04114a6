//! The walked units as plain Verilog-2001, for a synthesis tool: what clause `H-1` counts and
//! nothing else.

use crate::format::{Clamp, ReadOut};
use crate::machine::Dda;
use crate::measure::cost::{Unit, datapath};
use crate::profile::{InvalidProfile, Profile};

/// One distinct unit of a profile.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Source {
    /// `edge` or `depth`.
    pub name: &'static str,
    /// How many of them the profile has.
    pub copies: u32,
    /// Flip-flops that one copy should come to.
    pub register_bits: u32,
    /// The text; its module is called `unit`.
    pub verilog: String,
}

/// The distinct units of a profile.
///
/// Every module has a clock and a two-bit `op`: 0 loads, 1 steps right, 2 steps down to the next
/// row, 3 holds. A step down starts from the row start, which it moves.
///
/// # Errors
/// [`InvalidProfile`] if the profile fails validation, or if its machine has no cost model.
pub fn sources(profile: &Profile) -> Result<Vec<Source>, InvalidProfile> {
    profile.validate()?;
    let depth = profile.depth.map(|depth| depth.validate(&profile.vertex)).transpose()?;
    let source = |unit: &Unit| {
        let verilog = match (unit.dda, depth) {
            (Dda::Depth, Some(read)) => {
                let port = format!("[{}:0] value", read.integer() - 1);
                planar(unit.width, &port, &read_out(read), Some(read))
            }
            (Dda::Linear, _) => linear(unit.width),
            // An edge's read-out: inside is a clear sign bit.
            (Dda::Planar | Dda::Depth, _) => {
                planar(unit.width, "value", "    assign value = ~acc[N-1];\n", None)
            }
        };
        let register_bits = unit.register_bits / unit.copies;
        Source { name: unit.name, copies: unit.copies, register_bits, verilog }
    };
    Ok(datapath(profile)?.units.iter().map(source).collect())
}

/// The linear DDA of a walked edge.
fn linear(width: u32) -> String {
    format!(
        "module unit (
    input wire clk,
    input wire [1:0] op,
    input wire [{top}:0] init,
    input wire [{top}:0] dy,
    output wire [{top}:0] value
);
    reg [{top}:0] acc, slope;
    assign value = acc;
    always @(posedge clk)
        if (op == 0) begin acc <= init; slope <= dy; end
        else if (op == 2) acc <= acc + slope;
endmodule
",
        top = width - 1
    )
}

/// A planar DDA; `read_out` makes the output `port` of `acc`.
fn planar(width: u32, port: &str, read_out: &str, sticky: Option<ReadOut>) -> String {
    let sum = match sticky.filter(|read| read.clamp() == Clamp::Saturate) {
        Some(read) => saturated(read),
        None => "    wire [N-1:0] next = (down ? row : acc) + (down ? sy : sx);
    wire [N-1:0] first = init;
"
        .to_owned(),
    };
    format!(
        "module unit (
    input wire clk,
    input wire [1:0] op,
    input wire [{top}:0] init,
    input wire [{top}:0] dx,
    input wire [{top}:0] dy,
    output wire {port}
);
    localparam N = {width};
    reg [N-1:0] acc, row, sx, sy;
    wire down = op == 2;
{sum}    always @(posedge clk)
        if (op == 0) begin acc <= first; row <= first; sx <= dx; sy <= dy; end
        else if (op != 3) begin
            acc <= next;
            if (down) row <= next;
        end
{read_out}endmodule
",
        top = width - 1
    )
}

/// Clause `G-5`: what a sticky accumulator loads and adds is held between 0 and the maximum.
fn saturated(read: ReadOut) -> String {
    let top = read.integer() + read.fraction();
    // Without guard bits a start is unsigned, and none is out of range.
    let first = if read.guard() == 0 {
        "init".to_owned()
    } else {
        format!("init[N-1] ? {{N{{1'b0}}}} : |init[N-1:{top}] ? MAXIMUM : init")
    };
    format!(
        "    localparam [N-1:0] MAXIMUM = {{N{{1'b1}}}} >> {guard};
    wire [N-1:0] slope = down ? sy : sx;
    wire [N+1:0] sum = {{2'b00, down ? row : acc}} + {{{{2{{slope[N-1]}}}}, slope}};
    wire [N-1:0] next = sum[N+1] ? {{N{{1'b0}}}} : |sum[N:{top}] ? MAXIMUM : sum[N-1:0];
    wire [N-1:0] first = {first};
",
        guard = read.guard()
    )
}

/// Clauses `G-2` and `G-4` on the guard and integer bits, as two thresholds.
fn read_out(read: ReadOut) -> String {
    let (guard, integer, fraction) = (read.guard(), read.integer(), read.fraction());
    let whole = format!("acc[{}:{fraction}]", integer + fraction - 1);
    let clamped = |low: String| {
        let high = if guard == 0 {
            "1'b0".to_owned()
        } else {
            format!("|u[{}:{integer}]", guard + integer - 1)
        };
        format!(
            "    wire [{top}:0] u = acc[N-1:{fraction}];
    wire low = {low};
    wire high = {high};
    assign value = low ? {{{integer}{{1'b0}}}} : high ? {{{integer}{{1'b1}}}} : {whole};
",
            top = guard + integer - 1
        )
    };
    match read.clamp() {
        Clamp::Guard | Clamp::Error if guard > 0 => {
            let bits = guard + integer;
            // The upper half of the guard range, 2^i + (2^(g+i) - 2^i) / 2 and above.
            let middle = (1u128 << (bits - 1)) + (1 << (integer - 1));
            clamped(format!("u >= {bits}'h{middle:x}"))
        }
        Clamp::Sign => clamped(format!("u[{}]", guard + integer - 1)),
        Clamp::Guard | Clamp::Error | Clamp::Wrap | Clamp::Saturate => {
            format!("    assign value = {whole};\n")
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::profile::load;

    #[test]
    fn one_module_a_distinct_unit() {
        let names = |name: &str| -> Vec<_> {
            let sources = sources(&load(name).unwrap()).unwrap();
            for source in &sources {
                let text = &source.verilog;
                assert_eq!(text.matches("\nendmodule\n").count(), 1);
                assert!(text.starts_with("module unit ("));
                assert!(text.matches('(').count() == text.matches(')').count(), "{text}");
            }
            sources.iter().map(|s| (s.name, s.copies, s.register_bits)).collect()
        };
        assert_eq!(names("sgi-4k"), [("edge", 3, 140), ("depth", 1, 156)]);
        assert_eq!(names("sgi-4k-walk"), [("edge", 2, 70), ("depth", 1, 156)]);
    }

    /// The thresholds written are those of the split: every pattern of a toy word, read as the
    /// text says, gives what the read-out gives.
    #[test]
    fn the_middle_of_the_guard_range() {
        for (guard, integer) in [(1, 2), (2, 1), (2, 3), (3, 2), (4, 4)] {
            let read = ReadOut::new(guard, integer, 0, Clamp::Guard).unwrap();
            let text = read_out(read);
            let digits = text.split_once("'h").unwrap().1.split(';').next().unwrap();
            let middle = u64::from_str_radix(digits, 16).unwrap();
            for u in 0..1u64 << (guard + integer) {
                let expected = read.read(i128::from(u));
                let (low, high) = (u >= middle, u >> integer != 0);
                let maximum = (1 << integer) - 1;
                assert_eq!(
                    if low {
                        0
                    } else if high {
                        maximum
                    } else {
                        u & maximum
                    },
                    expected
                );
            }
        }
    }
}

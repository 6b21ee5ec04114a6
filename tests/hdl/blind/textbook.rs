//! The mutants of a small module, written by hand, and weeks of the calendar.

use super::operator::mutants;
use super::sample::week;
use super::source::Module;
use std::collections::BTreeSet;
use std::time::{Duration, UNIX_EPOCH};

const SMALL: &str = "module small (
    input  logic clk,
    input  logic rst,
    input  logic [3:0] a, b, // not a `<` b
    output logic [3:0] q
);
    wire less = a < b;
    always_ff @(posedge clk)
        if (rst) q <= 4'd0;
        else if (less) q <= a;
endmodule";

/// What each operator makes of a line, as `line: text`.
fn made(operator: &str) -> BTreeSet<String> {
    let module = Module::read(SMALL);
    let places = mutants(&module);
    let mutants = places.get(operator).into_iter().flat_map(|places| places.values()).flatten();
    let lines = mutants.map(|mutant| {
        let mut text = SMALL.to_owned();
        for (at, new) in mutant.edits.iter().rev() {
            text.replace_range(at.clone(), new);
        }
        format!("{}: {}", mutant.line, text.lines().nth(mutant.line - 1).unwrap().trim())
    });
    lines.collect()
}

pub(crate) fn mutants_of_a_small_module(_: &str) {
    let expected: [(&str, &[&str]); 12] = [
        (
            "relation",
            &["7: wire less = a <= b;", "7: wire less = a > b;", "7: wire less = a >= b;"],
        ),
        ("exchange", &["7: wire less = b < a;"]),
        (
            "operand",
            &[
                "10: else if (clk) q <= a;",
                "10: else if (less) q <= b;",
                "10: else if (less) q <= q;",
                "10: else if (rst) q <= a;",
                "7: wire less = a < a;",
                "7: wire less = a < q;",
                "7: wire less = b < b;",
                "7: wire less = q < b;",
                "9: if (clk) q <= 4'd0;",
                "9: if (less) q <= 4'd0;",
            ],
        ),
        (
            "condition",
            &[
                "10: else if (!(less)) q <= a;",
                "10: else if (1'b0) q <= a;",
                "10: else if (1'b1) q <= a;",
                "7: wire less = !(a < b);",
                "7: wire less = 1'b0;",
                "7: wire less = 1'b1;",
            ],
        ),
        ("constant", &["9: if (rst) q <= 4'd1;", "9: if (rst) q <= 4'd15;"]),
        ("enable", &["10: else if (1'b1) q <= a;"]),
        ("drop", &["10: else if (less) ;"]),
        ("reset", &["9: if (!rst) q <= 4'd0;", "9: if (1'b0) q <= 4'd0;", "9: if (rst) ;"]),
        ("sign", &["7: wire less = $signed(a) < b;", "7: wire less = a < $signed(b);"]),
        ("delay", &["7: logic  less; always_ff @(posedge clk) less <= a < b;"]),
        ("arithmetic", &[]),
        ("width", &[]),
    ];
    for (operator, texts) in expected {
        let texts: BTreeSet<String> = texts.iter().map(|text| (*text).to_owned()).collect();
        assert_eq!(made(operator), texts, "{operator}");
    }
    // `date +%G%V` of 1970-01-01, 2021-01-03, 2021-01-04, 2024-12-29 and 2024-12-30.
    for (day, expected) in
        [(0, 197_001), (18_630, 202_053), (18_631, 202_101), (20_086, 202_452), (20_087, 202_501)]
    {
        assert_eq!(week(UNIX_EPOCH + Duration::from_hours(24 * day)), expected, "day {day}");
    }
}

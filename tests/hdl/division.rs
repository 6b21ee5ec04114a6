//! `prove --rtl` for dividers: ours and foreign ones, and nothing that differs.

// Clause J-11.
use crate::equivalence::ask;
use crate::run::Ran;
use std::path::Path;

const HDL: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/hdl");
const FOREIGN: [&str; 2] = [
    include_str!("../../examples/equivalence/non_restoring.sv"),
    include_str!("../../examples/equivalence/non_restoring.toml"),
];
/// Two bits a clock, the quotient shifted into the numerator's register; busy as ours.
const RADIX_4: [&str; 2] =
    [include_str!("designs/radix_4.sv"), include_str!("designs/radix_4.toml")];

fn divides(home: &Path, [text, map]: [&str; 2]) -> Ran {
    std::fs::write(home.join("own.sv"), text).unwrap();
    std::fs::write(home.join("own.toml"), map).unwrap();
    ask(home, "sgi-4k --rtl own.sv --block divider --map own.toml")
}

/// At fewer bits, for those who wait.
fn narrow([text, map]: [&str; 2]) -> [String; 2] {
    let set = "[parameters]\nNW = 20\nDW = 9\n\n[division]";
    [text.to_owned(), map.replace("[division]", set).replace("r[53]", "r[10]")]
}

pub(crate) fn equal(_: &str) {
    let home = tempfile::tempdir().unwrap();
    let home = home.path();
    let by_induction = "PROVED by yosys-abc scorr and induction over 2 clocks in ";
    for profile in ["sgi-4k", "tiny"] {
        let ran =
            ask(home, &format!("{profile} --rtl {HDL}/setup_divider.sv --block divider")).ends(0);
        assert!(ran.out.starts_with("PROVED by yosys-abc scorr and "), "{}", ran.out);
    }
    for design in [FOREIGN, RADIX_4] {
        let ran = divides(home, design).ends(0);
        assert!(ran.out.starts_with(by_induction), "{}", ran.out);
        let log = std::fs::read_to_string(home.join("guardbit-proof/bad.log")).unwrap();
        assert!(
            log.contains("Networks are equivalent.")
                && log.contains("No output asserted in 4 frames")
        );
    }
}

pub(crate) fn differences(_: &str) {
    let home = tempfile::tempdir().unwrap();
    let home = home.path();
    for (design, old, new) in [
        (FOREIGN, "&& q[0]", "&& !q[0]"),
        (FOREIGN, "{2'b00, d} || (", "{2'b01, d} || ("),
        (FOREIGN, "neg <= num[NW-1]", "neg <= num[NW-2]"),
        (FOREIGN, "~next[DW+1]}", "next[DW+1]}"),
        (FOREIGN, "cnt <= 8'(NW)", "cnt <= 8'(NW - 1)"),
        (FOREIGN, "r <= '0;\n                cnt", "cnt"),
        (RADIX_4, "twice_fits ? ", "fits ? "),
        (RADIX_4, "tie && q[0]", "tie"),
    ] {
        let [text, map] = narrow(design);
        assert_eq!(text.matches(old).count(), 1, "{old}");
        // The lemmas say what the registers of the right one mean, and do not matter to a wrong quotient.
        let ran = divides(home, [&text.replace(old, new), &without_lemmas(&map)]);
        assert!(
            ran.status == Some(1)
                && ran.out.starts_with("REFUTED in ")
                && ran.out.contains(": quotient got "),
            "{new}: {}{}",
            ran.out,
            ran.err
        );
    }
    // A lemma that does not hold is named; one that is missing leaves the question open.
    let [text, map] = narrow(FOREIGN);
    let wrong = map.replace("\"n == ref_rest\"", "\"n == ref_quotient\"");
    let ran = divides(home, [&text, &wrong]).ends(1);
    assert!(
        ran.out.starts_with("UNDECIDED after ")
            && ran.out.contains("the lemma \"n == ref_quotient\" does not hold "),
        "{}",
        ran.out
    );
    for (old, new, says) in [
        ("done = \"done\"", "", "one of busy and done"),
        ("bits-per-clock = 1", "bits-per-clock = 0", "bits-per-clock = 0: 1 to 20"),
        ("\"n == ref_rest\"", "\"n == ref_rest; assign bad = 0\"", "is no expression"),
        ("\"n == ref_rest\"", "\"n == ref_rset\"", "ref_rset"),
        ("n = \"n\"", "n = \"nn\"", "nn"),
        ("n = \"n\"", "bad = \"n\"", "bad: the reference has this name"),
        ("n = \"n\"", "n = \"num\"", "num is a port"),
        ("[reset]\nport = \"rst\"", "[constants]\nrst = 0", "a divider needs [reset]"),
    ] {
        assert_eq!(map.matches(old).count(), 1, "{old}");
        let ran = divides(home, [&text, &map.replace(old, new)]);
        assert!(ran.status == Some(2) && ran.err.contains(says), "{new}: {}{}", ran.out, ran.err);
    }
    // A register that takes what cannot be read here holds nothing known: that shows no difference.
    let power = text.replace("r <= next;", "r <= next ** d[0];");
    assert_ne!(power, text);
    let ran = divides(home, [&power, &without_lemmas(&map)]);
    assert!(
        ran.status == Some(2) && ran.err.contains("no plain reading"),
        "{}{}",
        ran.out,
        ran.err
    );
    // A module that never ends says nothing.
    let ran = divides(home, [&text.replace("done <= 1'b1", "done <= 1'b0"), &map]);
    assert!(
        ran.status == Some(1) && ran.out.starts_with("UNDECIDED after "),
        "{}{}",
        ran.out,
        ran.err
    );
}

fn without_lemmas(map: &str) -> String {
    let Some((before, rest)) = map.split_once("lemmas = [") else { return map.to_owned() };
    let (_, after) = rest.split_once("\n]").unwrap();
    format!("{before}lemmas = []{after}")
}

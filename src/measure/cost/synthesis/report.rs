//! Figures out of what yosys writes.

use super::verilog::Source;
use super::{SynthesisError, UnitSynthesis};

/// The figures of `stat` and `ltp` on a flattened design mapped to look-up tables.
pub(super) fn parse(text: &str, source: &Source) -> Result<UnitSynthesis, SynthesisError> {
    let missing = |figure| SynthesisError::Report { unit: source.name, figure };
    // What synthesis prints on its way, and what it counted before mapping, is not the result.
    let last = text.rfind("Number of cells:").ok_or_else(|| missing("number of cells"))?;
    let (mut luts, mut flip_flops) = (0, 0);
    for line in text[last..].lines().skip(1) {
        let words: Vec<&str> = line.split_whitespace().collect();
        let &[cell, count] = &words[..] else { break };
        let Ok(count) = count.parse::<u32>() else { break };
        if cell == "$lut" {
            luts += count;
        } else if cell.contains("DFF") {
            // $_DFF_P_ and those with enable or reset: one bit each.
            flip_flops += count;
        }
    }
    let longest_path = text[last..]
        .split_once("(length=")
        .and_then(|(_, rest)| rest.split(')').next()?.parse().ok())
        .ok_or_else(|| missing("longest path"))?;
    if luts == 0 {
        return Err(missing("look-up table"));
    }
    Ok(UnitSynthesis { name: source.name, copies: source.copies, luts, flip_flops, longest_path })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What yosys 0.23 wrote for the depth unit of the profile sgi-4k, with the path cut short.
    const SAMPLE: &str = include_str!("yosys-0.23.txt");

    fn depth() -> Source {
        Source { name: "depth", copies: 1, register_bits: 156, verilog: String::new() }
    }

    #[test]
    fn figures_of_a_captured_report() {
        let unit = parse(SAMPLE, &depth()).unwrap();
        // Of the last `stat`; the one inside `synth` counts gates before they are mapped.
        let line = |what: &str| {
            let at = SAMPLE.rfind(what).unwrap();
            SAMPLE[at..].split_whitespace().nth(1).unwrap().parse::<u32>().unwrap()
        };
        assert_eq!(unit.luts, line("$lut "));
        assert_eq!(unit.flip_flops, line("$_DFFE_PN_ ") + line("$_DFFE_PP_ "));
        assert_eq!(unit.flip_flops, depth().register_bits);
        assert!(SAMPLE.contains(&format!("(length={})", unit.longest_path)));
    }

    #[test]
    fn a_report_without_a_figure_is_refused() {
        let cut = |what: &str| SAMPLE.replace(what, "");
        for (text, figure) in [
            (cut("Number of cells:"), "number of cells"),
            (cut("(length="), "longest path"),
            (cut("$lut "), "look-up table"),
            (String::new(), "number of cells"),
        ] {
            let error = parse(&text, &depth()).unwrap_err().to_string();
            assert!(error.contains(figure), "{error}");
        }
    }
}

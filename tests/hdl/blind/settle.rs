//! Whether a mutant that no bench catches is the same device: yosys proves it by induction, or finds
//! inputs that tell the two apart, or runs out of time.

use crate::set::limited;
use serde::Serialize;
use std::path::Path;
use std::time::Duration;

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Settled {
    Equivalent,
    Different,
    Open,
}

/// What both scripts begin with: `gold` and `gate`, flat, registers under their names.
fn both(top: &str) -> String {
    let side = |file: &str, name: &str| {
        format!(
            "read_verilog -sv {file}; hierarchy -top {top}; proc; flatten; opt -full; memory_map; opt -full; \
             rename {top} {name}; design -stash {name}; "
        )
    };
    let copy = "design -copy-from gold -as gold gold; design -copy-from gate -as gate gate; ";
    side("gold.sv", "gold") + &side("gate.sv", "gate") + copy
}

/// Proves that one module of `gold.sv` and `gate.sv` in the folder is the same in both.
pub(super) fn same(folder: &Path, module: &str, limit: Duration) -> bool {
    // Registers and wires of the same name are held to be equal, and each is proved from the
    // others. What is the same on both sides, multipliers for one, merges before that.
    let prove = both(module)
        + "equiv_make gold gate equiv; hierarchy -top equiv; opt_clean; opt_merge; \
           equiv_struct; opt_merge; equiv_struct; opt_merge; opt_clean; equiv_simple -short; \
           equiv_induct -seq 2; equiv_status -assert";
    limited(folder, "yosys", &["-q", "-p", &prove], limit).is_some_and(|(good, _)| good)
}

/// Finds inputs on which one module of `gold.sv` and `gate.sv` answers differently.
pub(super) fn differ(folder: &Path, module: &str, limit: Duration) -> bool {
    // One clock of reset from any state, then anything.
    let refute = both(module)
        + "miter -equiv -make_outputs -flatten gold gate miter; hierarchy -top miter; \
           sat -seq 8 -prove-skip 1 -set-at 1 in_rst 1 -prove trigger 0 miter";
    limited(folder, "yosys", &["-p", &refute], limit)
        .is_some_and(|(_, text)| text.contains("model found: FAIL!"))
}

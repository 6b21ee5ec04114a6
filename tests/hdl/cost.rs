//! The devices cost what `explore --synth` says of their profile.

use guardbit::measure::cost::{sources, synthesise_unit};
use guardbit::profile::{self, Profile};
use std::path::Path;
use std::time::Duration;

use crate::set::good;

/// Look-up tables and flip-flops of a device with its parameters.
fn cells(module: &str, parameters: &str) -> [u32; 2] {
    let home = tempfile::tempdir().unwrap();
    let device = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("hdl/{module}.sv"));
    let script = format!(
        "read_verilog -sv {}; chparam {parameters} {module}; synth -flatten -noabc -top {module}; \
         abc -lut 4; opt_clean; stat",
        device.display()
    );
    let text = good(home.path(), "yosys", &["-p", &script]);
    let last = text.rsplit("Number of cells").next().unwrap();
    let count = |kind: &str| -> u32 {
        let lines = last.lines().filter_map(|line| {
            let (name, count) = line.trim().split_once(' ')?;
            name.starts_with(kind).then(|| count.trim().parse::<u32>().ok()).flatten()
        });
        lines.sum()
    };
    [count("$lut"), count("$_SDFF") + count("$_DFF")]
}

pub(crate) fn as_explored(_: &str) {
    let wide = |guard: u32, interpolation: u32| -> Profile {
        let mut profile = profile::load("sgi-4k").unwrap();
        let depth = profile.depth.as_mut().unwrap();
        (depth.guard, depth.interpolation) = (guard, interpolation);
        profile
    };
    let mut before = [0; 2];
    for (guard, interpolation) in [(1, 4), (2, 13), (4, 24)] {
        let profile = wide(guard, interpolation);
        let sources = sources(&profile).unwrap();
        let source = sources.iter().find(|source| source.name == "depth").unwrap();
        let unit = synthesise_unit(source, Path::new("yosys"), Duration::from_mins(2)).unwrap();
        let parameters = format!("-set G {guard} -set I 24 -set F {interpolation}");
        let [luts, flip_flops] = cells("dda", &parameters);
        // The unit of a budget holds its slopes as well; the device takes them from outside.
        let width = guard + 24 + interpolation;
        assert_eq!(flip_flops, width, "an accumulator");
        assert_eq!(unit.flip_flops, 4 * width, "start and two slopes beside it");
        assert!((luts..luts + luts / 4).contains(&unit.luts), "{luts} {unit:?}");
        assert!(luts > before[0] && flip_flops > before[1], "wider costs more");
        eprintln!("{width} bits: device {luts} LUT4, {flip_flops} FF; explore {unit:?}");
        before = [luts, flip_flops];
    }
}

//! The devices of `hdl` and the generated benches in real simulators. A trial whose
//! simulator is missing counts as ignored.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

#[path = "hdl/bench.rs"]
mod bench;
#[path = "hdl/blind.rs"]
mod blind;
#[path = "hdl/cost.rs"]
mod cost;
#[path = "hdl/division.rs"]
mod division;
#[path = "hdl/engine.rs"]
mod engine;
#[path = "hdl/equivalence.rs"]
mod equivalence;
#[path = "hdl/folder.rs"]
mod folder;
#[path = "hdl/foreign.rs"]
mod foreign;
#[path = "hdl/formal.rs"]
mod formal;
#[path = "hdl/mutant.rs"]
mod mutant;
#[path = "hdl/readme.rs"]
mod readme;
#[path = "hdl/recipe.rs"]
mod recipe;
#[path = "hdl/register.rs"]
mod register;
#[path = "support/run.rs"]
mod run;
#[path = "hdl/scoreboard.rs"]
mod scoreboard;
#[path = "hdl/set.rs"]
mod set;
#[path = "hdl/spoiled.rs"]
mod spoiled;
#[path = "support/tool.rs"]
mod tool;
#[path = "hdl/units.rs"]
mod units;
#[path = "hdl/vhdl.rs"]
mod vhdl;
#[path = "hdl/wave.rs"]
mod wave;
#[path = "hdl/words.rs"]
mod words;

// Clause J-7 is tested beside the C interface: bindings/c/tests.
use libtest_mimic::Arguments;
use tool::{GHDL, ICARUS, Tool, VERILATOR, YOSYS, Z3};

const COCOTB: Tool = Tool {
    name: "cocotb",
    programs: &["cocotb-config"],
    version: "--version",
    hardware: true,
    package: "pip install cocotb, apt-get install iverilog",
};

fn main() {
    // A trial that needs two programs is ignored for want of the first that is missing.
    let both = |first: Tool, second| if first.program().is_none() { first } else { second };
    let (solver, cocotb) = (both(YOSYS, Z3), both(ICARUS, COCOTB));
    let settler = || both(ICARUS, YOSYS);
    let trials = vec![
        // Those that take longest come first: nothing waits for them at the end.
        ICARUS.soak_trial("mutants_are_caught_and_named", mutant::caught_and_named),
        ICARUS.trial("devices_of_built_in_registers_pass", register::wired),
        solver.trial("dividers_are_proved_equal", division::equal),
        solver.trial("engines_are_proved_equal", engine::equal),
        solver.trial("engines_that_differ_are_refuted", engine::differences),
        solver.trial("engines_that_cannot_be_proved_are_refused", engine::refused),
        solver.trial("foreign_set_ups_are_proved_equal", words::foreign),
        solver.trial("set_ups_that_differ_are_refuted", words::differences),
        VERILATOR.trial("the_devices_are_lint_clean", bench::lint_clean),
        ICARUS.trial("icarus_runs_every_bench", bench::icarus),
        ICARUS.trial("icarus_rounds_in_every_way", bench::icarus_rounds),
        ICARUS.trial("units_of_channels_pass", units::pass),
        ICARUS.trial("faults_of_units_are_named", units::faults),
        GHDL.trial("ghdl_runs_walks_and_streams", bench::ghdl),
        GHDL.trial("ghdl_takes_late_outputs", vhdl::late_outputs),
        GHDL.trial("ghdl_takes_answers_in_any_order", vhdl::other_orders),
        GHDL.trial("ghdl_sees_defects_of_vhdl_devices", vhdl::defects),
        ICARUS.trial("icarus_refuses_spoiled_files", spoiled::icarus),
        VERILATOR.trial("verilator_refuses_spoiled_files", spoiled::verilator),
        GHDL.trial("ghdl_refuses_spoiled_files", spoiled::ghdl),
        ICARUS.trial("outputs_may_come_late", foreign::latency),
        ICARUS.trial("parameters_come_from_the_package", foreign::parameters),
        ICARUS.trial("answers_may_come_in_any_order", foreign::order),
        ICARUS.trial("what_is_not_checked_is_named", foreign::left_out),
        ICARUS.trial("an_engine_of_registers_passes", register::quads),
        VERILATOR.trial("a_dump_is_whole_when_the_bench_stops", foreign::dump_before_the_end),
        ICARUS.trial("waves_line_up_with_the_trace", wave::lines_up),
        cocotb.soak_trial("the_cocotb_scoreboard_passes_and_fails", scoreboard::cocotb),
        YOSYS.trial("scripts_of_a_set_prove_its_devices", folder::scripts),
        VERILATOR.soak_trial("assertions_of_a_set_see_defects", folder::assertions),
        solver.trial("words_wrap_as_proved", formal::words_wrap),
        solver.trial("the_guard_clamp_holds_as_proved", formal::guard_clamps),
        solver.trial("edge_words_fit_as_proved", formal::edges_fit),
        solver.trial("shipped_devices_are_proved_equal", equivalence::shipped_devices),
        solver.trial("a_foreign_device_is_proved_equal", equivalence::foreign_device),
        solver.trial("shipped_set_ups_are_proved_equal", words::shipped),
        solver.trial("set_ups_that_cannot_be_read_are_refused", words::refused),
        solver.trial("dividers_that_differ_are_refuted", division::differences),
        solver.trial("a_device_that_holds_its_slopes_is_proved_equal", equivalence::latched_device),
        solver.trial("only_the_solvers_words_prove", equivalence::only_the_solvers_words_prove),
        solver.trial("a_proof_refuses_nonsense", equivalence::bad_input),
        settler().soak_trial("no_proof_of_a_blind_mutant_is_wrong", blind::proof::sampled),
        both(GHDL, YOSYS).trial("vhdl_devices_are_proved_equal", equivalence::vhdl_devices),
        YOSYS.trial("devices_cost_what_explore_says", cost::as_explored),
        YOSYS.trial("units_of_channels_cost_about_what_is_estimated", cost::of_channels),
        ICARUS.trial("the_readmes_buggy_adder_is_named", readme::buggy_adder),
        settler().trial("the_mutation_recipe_says_what_is_missing", recipe::says_what_is_missing),
        settler().soak_trial("the_mutation_recipe_scores_our_devices", recipe::scores_our_devices),
        ICARUS.trial("mutants_are_the_textbooks", blind::textbook::mutants_of_a_small_module),
        // Minutes each: for who changes what they try.
        settler().soak_trial("long_blind_sample_of_mutants", blind::sampled),
        ICARUS.soak_trial("long_defects_of_register_devices", register::wired_defects),
        VERILATOR.soak_trial("long_verilator_runs_a_million_vectors", bench::verilator),
        ICARUS.soak_trial("long_defects_of_units_of_channels", mutant::of_channels),
        settler().soak_trial("long_blind_sample_of_units", blind::units::sampled),
        YOSYS.soak_trial("long_cost_of_units_of_channels", cost::of_larger_channels),
        solver.soak_trial("long_bits_agree_with_polynomials", words::bits_agree),
        solver.soak_trial("long_defects_of_steppers", blind::proof::defects),
        solver.soak_trial("long_defects_of_larger_units", blind::proof::defects_of_larger_units),
        solver.soak_trial("long_engine_of_tiny", engine::tiny),
        solver.soak_trial("long_engine_of_another_kind", engine::other_kind),
        solver.soak_trial("long_faults_of_engines", engine::all_differences),
        solver.soak_trial("long_rare_faults_of_engines", engine::rare),
    ];
    libtest_mimic::run(&Arguments::from_args(), trials).exit();
}

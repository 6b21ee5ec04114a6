//! The `guardbit` command, with the built-in machines.

fn main() -> std::process::ExitCode {
    guardbit::cli::main(&[])
}

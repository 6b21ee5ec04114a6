//! The `guardbit` command. It sees only the crate's public API; one file a command.

mod cli;

fn main() -> std::process::ExitCode {
    cli::run()
}

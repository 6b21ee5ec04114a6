//! The `guardbit` command.
fn main() {}

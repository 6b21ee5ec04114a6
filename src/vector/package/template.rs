//! Filling in templates.

use super::{Interface, rtl};
use crate::format::Clamp;

/// The template with each `@KEY@` replaced by its value. Values are not searched again for keys
/// that come before them in the list.
pub(in crate::vector) fn fill(template: &str, values: &[(&str, &str)]) -> String {
    values
        .iter()
        .fold(template.to_owned(), |text, (key, value)| text.replace(&format!("@{key}@"), value))
}

/// Text for a comment in any target language: printable ASCII on one line that neither opens nor
/// closes a block comment.
pub(in crate::vector) fn comment(text: &str) -> String {
    let plain: String = text
        .trim()
        .chars()
        .map(|c| if c.is_control() { ' ' } else { c })
        .map(|c| if c.is_ascii() { c } else { '?' })
        .collect();
    plain.replace("*/", "* /").replace("/*", "/ *").replace(['"', '`', '\\', '@'], "'")
}

/// Fills in the set's name and the model's version.
pub(super) fn head(interface: &Interface, text: &str) -> String {
    let version = interface.model_version.to_string();
    fill(text, &[("SET", &comment(&interface.set)), ("VERSION", &version)])
}

/// Fills in a package: what describes each file, and everything about the set itself.
/// `comment` opens a comment of one line, `constant` is a constant of set-up or engine: `@NAME@ @VALUE@`.
pub(super) fn package(
    interface: &Interface,
    template: &str,
    (comment, constant): (&str, &str),
    files: &[String],
) -> String {
    let clamp = &interface.clamp;
    let mut setup = String::new();
    for (name, value, what) in rtl::constants(interface) {
        // A line free before the first.
        setup += if setup.is_empty() { "\n" } else { "" };
        setup += &fill(comment, &[("TEXT", &what)]);
        setup += &fill(constant, &[("NAME", name), ("VALUE", &value.to_string())]);
    }
    let text = fill(
        template,
        &[
            ("GUARD", &clamp.guard.to_string()),
            ("INTEGER", &clamp.integer.to_string()),
            ("FRACTION", &clamp.fraction.to_string()),
            ("MODE", &mode(clamp.mode)),
            ("SETUP", &setup),
            ("FILES", &files.join("\n")),
        ],
    );
    head(interface, &text)
}

/// The read-out's name as the packages spell it: that of the mode with the device's code.
fn mode(clamp: Clamp) -> String {
    let spelled = if clamp == Clamp::Error { Clamp::Guard } else { clamp };
    spelled.name().to_uppercase()
}

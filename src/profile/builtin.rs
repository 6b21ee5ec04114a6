//! The built-in profiles: the TOML files of `spec/profiles`, compiled in.

use super::Profile;
use super::load::{ProfileError, parse};

/// Name and text of each built-in profile; the first is the default.
pub const BUILTIN: [(&str, &str); 4] = [
    ("sgi-4k", include_str!("../../spec/profiles/sgi-4k.toml")),
    ("sgi-4k-walk", include_str!("../../spec/profiles/sgi-4k-walk.toml")),
    ("d3d11", include_str!("../../spec/profiles/d3d11.toml")),
    ("tiny", include_str!("../../spec/profiles/tiny.toml")),
];

/// The built-in profile of this name.
///
/// # Errors
/// [`ProfileError`] if the compiled-in text is at fault; the tests load each of them.
pub fn builtin(name: &str) -> Option<Result<Profile, ProfileError>> {
    let (name, text) = BUILTIN.iter().find(|(known, _)| *known == name)?;
    Some(parse(text, name))
}

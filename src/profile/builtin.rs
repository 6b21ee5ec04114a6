//! The built-in profiles: the TOML files of `profiles`, compiled in.

use super::Profile;
use super::load::{ProfileError, parse};

/// Name and text of each built-in profile; the first is the default.
pub const BUILTIN: [(&str, &str); 30] = [
    ("sgi-4k", include_str!("../../profiles/sgi-4k.toml")),
    ("sgi-4k-walk", include_str!("../../profiles/sgi-4k-walk.toml")),
    ("d3d11", include_str!("../../profiles/d3d11.toml")),
    ("tiny", include_str!("../../profiles/tiny.toml")),
    ("d3d12-outer", include_str!("../../profiles/d3d12-outer.toml")),
    ("d3d12-inner", include_str!("../../profiles/d3d12-inner.toml")),
    ("larrabee", include_str!("../../profiles/larrabee.toml")),
    ("vulkan-8bit", include_str!("../../profiles/vulkan-8bit.toml")),
    ("vulkan-8bit-4x", include_str!("../../profiles/vulkan-8bit-4x.toml")),
    ("vulkan-4bit", include_str!("../../profiles/vulkan-4bit.toml")),
    ("vulkan-4bit-4x", include_str!("../../profiles/vulkan-4bit-4x.toml")),
    ("nv2a", include_str!("../../profiles/nv2a.toml")),
    ("gamecube", include_str!("../../profiles/gamecube.toml")),
    ("ps1", include_str!("../../profiles/ps1.toml")),
    ("ps1-rtl", include_str!("../../profiles/ps1-rtl.toml")),
    ("vortex", include_str!("../../profiles/vortex.toml")),
    ("psp", include_str!("../../profiles/psp.toml")),
    ("voodoo", include_str!("../../profiles/voodoo.toml")),
    ("virge", include_str!("../../profiles/virge.toml")),
    ("n64", include_str!("../../profiles/n64.toml")),
    ("n64-rtl", include_str!("../../profiles/n64-rtl.toml")),
    ("rasterix", include_str!("../../profiles/rasterix.toml")),
    ("picogs", include_str!("../../profiles/picogs.toml")),
    ("graphite", include_str!("../../profiles/graphite.toml")),
    ("projf-line", include_str!("../../profiles/projf-line.toml")),
    ("projf-fill", include_str!("../../profiles/projf-fill.toml")),
    ("saturn-line", include_str!("../../profiles/saturn-line.toml")),
    ("saturn-quad", include_str!("../../profiles/saturn-quad.toml")),
    ("ps1-line", include_str!("../../profiles/ps1-line.toml")),
    ("gplgpu", include_str!("../../profiles/gplgpu.toml")),
];

/// The built-in profile of this name.
///
/// # Errors
/// [`ProfileError`] if the compiled-in text is at fault; the tests load each of them.
pub fn builtin(name: &str) -> Option<Result<Profile, ProfileError>> {
    let (name, text) = BUILTIN.iter().find(|(known, _)| *known == name)?;
    Some(parse(text, name))
}

//! A machine small enough to try everything on.

/// 8 x 8 pixels with four sub-pixel bits, covered by exact edge functions; the rest of a profile follows.
pub(crate) const TOY: &str = r#"
schema = 1
name = "toy"
[window]
width = 8
height = 8
[vertex]
integer = 3
sub-pixel = 4
signed = false
closed = true
snap = "nearest-even"
source = "f64"
endless = "refuse"
[form.edge-function]
rule = "top-left"
storage = "shifted"
width = 24
"#;

/// A profile of text.
pub(crate) fn parse(
    text: &str,
) -> Result<guardbit::profile::Profile, guardbit::profile::ProfileError> {
    guardbit::profile::parse(text, "toy.toml")
}

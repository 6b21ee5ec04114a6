//! guardbit
pub mod bits;
pub mod case;
pub mod cover;
pub mod dda;
pub mod format;
pub mod machine;
pub mod measure;
pub mod model;
pub mod profile;
pub mod scene;
pub mod setup;
pub mod value;
pub mod vector;

/// The Rust examples of the specification, run as documentation tests.
#[cfg(doctest)]
mod spec {
    macro_rules! texts {
        ($($name:ident $file:literal),*) => {$(
            #[doc = include_str!(concat!("../spec/", $file))]
            struct $name;
        )*};
    }
    texts!(
        Words "01-words.md", Events "02-events.md", Formats "03-formats.md",
        Setup "04-setup.md", Coverage "05-coverage.md", Values "06-values.md",
        EdgeWalk "07-edge-walk.md", Stimulus "08-stimulus.md"
    );
}

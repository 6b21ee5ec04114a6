//! `guardbit.h` is what the sources say.

use std::path::Path;

/// With `GUARDBIT_WRITE=1` the header is written anew.
#[test]
fn the_header_is_generated_from_the_sources() {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let config = cbindgen::Config::from_file(here.join("cbindgen.toml")).expect("it is there");
    let builder = cbindgen::Builder::new().with_crate(here).with_config(config);
    let mut text = Vec::new();
    builder.generate().expect("the sources parse").write(&mut text);
    let path = here.join("guardbit.h");
    if std::env::var_os("GUARDBIT_WRITE").is_some() {
        std::fs::write(&path, &text).expect("it can be written");
    }
    let kept = std::fs::read(&path).expect("it is there");
    assert!(kept == text, "guardbit.h is out of date: GUARDBIT_WRITE=1 cargo test -p guardbit-c");
}

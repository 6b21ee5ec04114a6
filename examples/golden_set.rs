//! A golden set written from Rust, and a device's dump held against it: a correct one, and one of a device
//! that rounds depth the wrong way.
#![allow(clippy::print_stdout, reason = "an example shows what it found")]

use guardbit::bits::Rounding;
use guardbit::profile::{self, Profile};
use guardbit::vector::plan::Shard;
use guardbit::vector::table::RowFormat;
use guardbit::vector::write::{Monitor, Options, SetRequest, write};
use guardbit::vector::{check, dump};
use std::error::Error;
use std::path::Path;
use std::sync::Arc;

/// Writes a small set of a profile.
fn set(profile: Profile, folder: &Path) -> Result<(), Box<dyn Error>> {
    let request = SetRequest {
        name: profile.name.clone(),
        profile,
        scene_name: "none".to_owned(),
        scene: Arc::default(),
        values: Arc::default(),
        refused: 0,
    };
    let options = Options {
        count: 2000,
        seed: 1,
        shard: Shard::WHOLE,
        format: RowFormat::Tv,
        zstd: false,
        threads: 1,
        force: true,
    };
    write(&[request], folder, false, &options, &Monitor::default())?;
    Ok(())
}

fn main() -> Result<(), Box<dyn Error>> {
    let home = std::env::temp_dir().join(format!("guardbit-golden-set-{}", std::process::id()));
    let (golden, device) = (home.join("golden"), home.join("device"));
    std::fs::create_dir_all(&home)?;
    let mut profile = profile::load("sgi-4k")?;
    set(profile.clone(), &golden)?;
    // A device with a defect, played by a profile: its answers are in the same form.
    if let Some(depth) = &mut profile.depth {
        depth.rounding = Rounding::Floor;
    }
    set(profile, &device)?;

    let (sets, findings) = check::open(&golden)?;
    let set = sets.first().ok_or("no set was written")?;
    println!(
        "{}: {} files, {} findings",
        set.manifest.set,
        set.manifest.files.len(),
        findings.len()
    );
    for (who, folder) in [("correct", &golden), ("floored", &device)] {
        let report = dump::compare(set, &folder.join("triangle.exp.tv"), None, 3)?;
        println!("{who} device: {} rows, {} mismatches", report.rows, report.total);
        for mismatch in report.mismatches.iter().take(1) {
            println!("  {}: {}", mismatch.test, mismatch.text.replace('\n', "; "));
        }
        for cause in &report.causes {
            println!("  likely cause: {cause}");
        }
    }
    std::fs::remove_dir_all(&home)?;
    Ok(())
}

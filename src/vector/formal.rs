//! `formal/` of a set: the reference, what its devices have to answer as assertions, and scripts of SymbiYosys.
//! Spec clause `J-13`.

use super::package::{comment, fill};
use super::reference::{Language, package, reference};
use super::write::devices;
use crate::profile::Profile;

/// The folder in a set.
pub(super) const FOLDER: &str = "formal";

/// A map for yosys by which a product is one cell on both sides, however its operands are ordered: no solver tells two
/// multipliers equal by their gates.
pub(super) const WIDER_FIRST: &str = include_str!("formal/products.v");

/// The devices that a solver of bits proves.
const PROVED: [&str; 4] = ["dda", "edge_stepper", "edge_evaluator", "depth_evaluator"];

/// Names and texts of the files; none where the set's devices do not draw the profile.
pub(super) fn files(set: &str, profile: &Profile) -> Vec<(String, String)> {
    let (Ok(_), Ok(reference)) = (devices(profile), reference(profile, Language::Sv)) else {
        return Vec::new();
    };
    let vertex = &profile.vertex;
    let bits = vertex.bits();
    let (set, package, bits) = (comment(set), package(profile), bits.to_string());
    let filled = |template: &str, device: &str| {
        let values = [
            ("SET", set.as_str()),
            ("P", &package),
            ("DEVICE", device),
            ("VERTEX", &bits),
            ("SIGN", if vertex.signed { "v[VERTEX-1]" } else { "1'b0" }),
            ("PRODUCTS", WIDER_FIRST),
            ("ANY_ORDER", if profile.traversal.is_some() { "1'b1 || " } else { "" }),
        ];
        fill(template, &values)
    };
    let mut list = vec![
        ("reference.sv".to_owned(), reference),
        ("properties.sv".to_owned(), filled(include_str!("formal/properties.sv.in"), "")),
        ("bind.sv".to_owned(), filled(include_str!("formal/bind.sv.in"), "")),
    ];
    list.extend(PROVED.map(|device| {
        (format!("{device}.sby"), filled(include_str!("formal/unit.sby.in"), device))
    }));
    list.into_iter().map(|(name, text)| (format!("{FOLDER}/{name}"), text)).collect()
}

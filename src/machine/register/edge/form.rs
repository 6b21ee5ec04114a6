//! The engine `edge-functions` as a profile configures it.

use super::part::{
    BoxEnds, EdgeBox, EdgeOrder, EdgeRule, EdgeSense, EdgeSource, Origin, TilePlace, Winding,
    WithoutArea,
};
use super::value::{Division, PlaneStart, ValueSource};
use super::wire::ENDS;
use super::{EdgeEngineConfig, NAME};
use crate::bits::Rounding;
use crate::machine::register::engine::{ClipNames, EngineForm};
use crate::machine::{
    EngineConfig, RegisterConfig, RegisterDevice, Step, Steps, Word, near, near_or_none,
};

/// The steps of this engine.
type Found<'a> = Steps<'a, EdgeEngineConfig, EngineConfig>;

/// Adds every other choice of a part.
macro_rules! others {
    ($steps:expr, $field:literal, $kind:ident, $was:expr, $change:expr) => {
        let was: $kind = $was;
        for other in $kind::ALL.iter().copied().filter(|other| *other != was) {
            $steps.add($field, &other.name(), &was.name(), |config| $change(config, other));
        }
    };
}

impl EngineForm for EdgeEngineConfig {
    fn name(&self) -> &'static str {
        NAME
    }

    fn clip(&self) -> Option<ClipNames> {
        self.rectangle().map(|_| ClipNames { ends: ENDS, sub_pixels: false, on: None })
    }

    fn cuts_slopes(&self) -> bool {
        true
    }

    fn edge_word(&self) -> Option<Word> {
        let facts = [("beyond its range", "wraps".to_owned())];
        Some(Word::new("edge", [("edge", self.width)], facts))
    }

    /// It is described, and no device is written for it.
    fn device(&self, _: &RegisterConfig) -> Option<RegisterDevice> {
        None
    }

    fn neighbours(&self) -> Vec<Step<EngineConfig>> {
        let mut steps = Steps::of(self, EngineConfig::from);
        for width in near(self.width) {
            steps.add("width", &width, &self.width, |config| config.width = width);
        }
        others!(steps, "winding", Winding, self.winding, |c: &mut Self, it| c.winding = it);
        others!(steps, "rule", EdgeRule, self.rule, |c: &mut Self, it| c.rule = it);
        others!(steps, "without-area", WithoutArea, self.without_area, |c: &mut Self, it| {
            c.without_area = it;
        });
        edge_steps(&mut steps, self.edges);
        box_steps(&mut steps, self.r#box);
        order_steps(&mut steps, self.order);
        if let Some(values) = self.values {
            value_steps(&mut steps, values);
        }
        steps.found()
    }
}

fn edge_steps(steps: &mut Found<'_>, edges: EdgeSource) {
    match edges {
        EdgeSource::Given { at } => {
            others!(steps, "edges.at", Origin, at, |c: &mut EdgeEngineConfig, at| {
                c.edges = EdgeSource::Given { at };
            });
        }
        EdgeSource::Vertices { sense, product_cut, cut } => {
            others!(steps, "edges.sense", EdgeSense, sense, |c: &mut EdgeEngineConfig, sense| {
                c.edges = EdgeSource::Vertices { sense, product_cut, cut };
            });
            for got in near_or_none(product_cut) {
                steps.add("edges.product-cut", &got, &product_cut, |c| {
                    c.edges = EdgeSource::Vertices { sense, product_cut: got, cut };
                });
            }
            for got in near_or_none(cut) {
                steps.add("edges.cut", &got, &cut, |c| {
                    c.edges = EdgeSource::Vertices { sense, product_cut, cut: got };
                });
            }
        }
    }
}

fn box_steps(steps: &mut Found<'_>, was: EdgeBox) {
    match was {
        EdgeBox::Given(ends) => {
            others!(steps, "box.given", BoxEnds, ends, |c: &mut EdgeEngineConfig, ends| {
                c.r#box = EdgeBox::Given(ends);
            });
        }
        EdgeBox::Vertices { bits, limit, hold_both, try_first } => {
            steps.add("box.hold-both", &!hold_both, &hold_both, |c| {
                c.r#box = EdgeBox::Vertices { bits, limit, hold_both: !hold_both, try_first };
            });
            steps.add("box.try-first", &!try_first, &try_first, |c| {
                c.r#box = EdgeBox::Vertices { bits, limit, hold_both, try_first: !try_first };
            });
            for got in bits.into_iter().flat_map(near) {
                steps.add("box.bits", &got, &bits.unwrap_or(0), |c| {
                    c.r#box = EdgeBox::Vertices { bits: Some(got), limit, hold_both, try_first };
                });
            }
        }
    }
}

fn order_steps(steps: &mut Found<'_>, was: EdgeOrder) {
    let plain = [
        (EdgeOrder::Rows, "rows"),
        (EdgeOrder::Serpentine, "serpentine"),
        (EdgeOrder::Zigzag, "zigzag"),
    ];
    let known = plain.iter().find(|(order, _)| *order == was);
    let was_name = known.map_or("tiles", |(_, name)| name);
    for (order, name) in plain.iter().filter(|(order, _)| *order != was) {
        steps.add("order", name, &was_name, |c| c.order = *order);
    }
    let EdgeOrder::Tiles { width, height, place, reject_corners, beyond_box } = was else { return };
    let tiles = |place, reject_corners, beyond_box| EdgeOrder::Tiles {
        width,
        height,
        place,
        reject_corners,
        beyond_box,
    };
    others!(steps, "order.place", TilePlace, place, |c: &mut EdgeEngineConfig, place| {
        c.order = tiles(place, reject_corners, beyond_box);
    });
    steps.add("order.reject-corners", &!reject_corners, &reject_corners, |c| {
        c.order = tiles(place, !reject_corners, beyond_box);
    });
    steps.add("order.beyond-box", &!beyond_box, &beyond_box, |c| {
        c.order = tiles(place, reject_corners, !beyond_box);
    });
}

/// Another division by the area.
fn divisions(was: Division) -> Vec<(&'static str, String, String, Division)> {
    let number = |name, got: u32, was: u32, to| (name, got.to_string(), was.to_string(), to);
    let mut found = Vec::new();
    match was {
        Division::Quotient(rounding) => {
            for other in Rounding::ALL.into_iter().filter(|other| *other != rounding) {
                let to = Division::Quotient(other);
                found.push(("quotient", other.to_string(), rounding.to_string(), to));
            }
        }
        Division::Reciprocal { numerator, drop, zero } => {
            found.extend(near(drop).map(|got| {
                number("drop", got, drop, Division::Reciprocal { numerator, drop: got, zero })
            }));
            found.extend(near(numerator).map(|got| {
                let to = Division::Reciprocal { numerator: got, drop, zero };
                number("numerator", got, numerator, to)
            }));
        }
        Division::Table { index, between, seed } => {
            found.extend(near(index).map(|got| {
                number("index", got, index, Division::Table { index: got, between, seed })
            }));
            found.extend(near_or_none(between).map(|got| {
                number("between", got, between, Division::Table { index, between: got, seed })
            }));
            found.extend(near(seed).map(|got| {
                number("seed", got, seed, Division::Table { index, between, seed: got })
            }));
        }
    }
    found
}

fn value_steps(steps: &mut Found<'_>, was: ValueSource) {
    let set = |to: ValueSource| move |c: &mut EdgeEngineConfig| c.values = Some(to);
    match was {
        ValueSource::Given { at } => {
            others!(steps, "values.at", Origin, at, |c: &mut EdgeEngineConfig, at| {
                c.values = Some(ValueSource::Given { at });
            });
        }
        ValueSource::Planes { divide, start, fraction, width, product, half } => {
            let planes = |divide, start, fraction, half| ValueSource::Planes {
                divide,
                start,
                fraction,
                width,
                product,
                half,
            };
            for (name, got, was, to) in divisions(divide) {
                let to = planes(to, start, fraction, half);
                steps.add(&format!("values.divide.{name}"), &got, &was, set(to));
            }
            others!(steps, "values.start", PlaneStart, start, |c: &mut EdgeEngineConfig, start| {
                c.values = Some(planes(divide, start, fraction, half));
            });
            for got in fraction.into_iter().flat_map(near) {
                let to = planes(divide, start, Some(got), half);
                steps.add("values.fraction", &got, &fraction.unwrap_or(0), set(to));
            }
            steps.add("values.half", &!half, &half, set(planes(divide, start, fraction, !half)));
            let words = |width, product| ValueSource::Planes {
                divide,
                start,
                fraction,
                width,
                product,
                half,
            };
            for got in product.into_iter().flat_map(near) {
                let was = product.unwrap_or_default();
                steps.add("values.product", &got, &was, set(words(width, Some(got))));
            }
            for got in width.into_iter().flat_map(near) {
                let was = width.unwrap_or_default();
                steps.add("values.width", &got, &was, set(words(Some(got), product)));
            }
        }
        ValueSource::Weights { divide, fraction, product_cut, product } => {
            let weights = |divide, fraction, product_cut| ValueSource::Weights {
                divide,
                fraction,
                product_cut,
                product,
            };
            for (name, got, was, to) in divisions(divide) {
                let to = weights(to, fraction, product_cut);
                steps.add(&format!("values.divide.{name}"), &got, &was, set(to));
            }
            for got in near(fraction) {
                let to = weights(divide, got, product_cut);
                steps.add("values.fraction", &got, &fraction, set(to));
            }
            for got in near_or_none(product_cut) {
                let to = weights(divide, fraction, got);
                steps.add("values.product-cut", &got, &product_cut, set(to));
            }
        }
    }
}

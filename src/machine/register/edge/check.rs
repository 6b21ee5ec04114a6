//! What goes together, and what has no meaning. Spec clause `RE-10`.

use super::part::{BoxLimit, EdgeBox, EdgeOrder, EdgeRule, EdgeSource, Winding, WithoutArea};
use super::setup::EdgeFunctions;
use super::value::{Division, PlaneStart, ValueSource};
use super::wire::{EdgeWires, LimitWires, Wires};
use super::{EdgeEngineConfig, NAME};
use crate::format::Gather;
use crate::machine::Target;
use crate::machine::register::Built;
use crate::machine::register::input::{Inputs, RegisterError};
use crate::setup::VertexConfig;
use crate::value::Channel;

/// Values of a record that are no channel.
const OWN: [&str; 5] = ["x", "y", "e0", "e1", "e2"];
/// Bits of a pixel number at most.
const PIXEL: u32 = 17;

/// Bits of the widest register.
fn widest(wires: &[Gather]) -> u32 {
    wires.iter().map(Gather::bits).max().unwrap_or(0)
}

/// Whether a condition holds, else the reason.
fn need(holds: bool, reason: impl FnOnce() -> String) -> Result<(), RegisterError> {
    let together = || RegisterError::Together { engine: NAME, reason: reason() };
    if holds { Ok(()) } else { Err(together()) }
}

impl EdgeEngineConfig {
    pub(in crate::machine::register) fn engine(
        &self,
        inputs: &Inputs<'_>,
        channels: &[Channel],
        vertex: &VertexConfig,
        target: Target,
    ) -> Result<Built, RegisterError> {
        self.check_coverage(vertex)?;
        self.check_order()?;
        self.check_channels(channels)?;
        let wires = self.wires(inputs, channels)?;
        wires.check(vertex)?;
        if let Some(values) = self.values {
            for (channel, wires) in channels.iter().zip(&wires.values) {
                self.check_values(values, channel, widest(wires), vertex)?;
            }
        }
        let own = OWN.map(str::to_owned).into_iter();
        let names = own.chain(channels.iter().map(|channel| channel.name.clone())).collect();
        let (config, signed) = (self.clone(), vertex.signed);
        let engine = EdgeFunctions { config, wires, channels: channels.to_vec(), target, signed };
        Ok((Box::new(engine), vec![names]))
    }

    fn check_coverage(&self, vertex: &VertexConfig) -> Result<(), RegisterError> {
        let width = self.width;
        need((2..=64).contains(&width), || {
            format!("width = {width}: an edge word has 2 to 64 bits")
        })?;
        let given = matches!(self.edges, EdgeSource::Given { .. });
        let winding = self.winding.name();
        need(!given || matches!(self.winding, Winding::One | Winding::Either), || {
            format!(
                "winding = {winding:?} looks at the area, and given edges have none; use one or either"
            )
        })?;
        need(!given || self.rule != EdgeRule::TruncatedSide, || {
            "rule = \"truncated-side\" looks at vertices, and edges are given".to_owned()
        })?;
        need(!given || self.without_area == WithoutArea::Draw, || {
            "without-area = \"skip\" looks at the area, and given edges have none".to_owned()
        })?;
        let EdgeBox::Vertices { bits, limit, .. } = self.r#box else { return self.check_cuts() };
        need(!given, || {
            "box = { vertices = ... } looks at vertices, and edges are given; use box = { given = ... }".to_owned()
        })?;
        let held = bits.unwrap_or(vertex.integer);
        need((1..=PIXEL).contains(&held), || {
            format!(
                "box: bits (else the integer bits of a vertex) = {held}: a pixel number has 1 to {PIXEL} bits; \
                 give `bits`"
            )
        })?;
        if let BoxLimit::Size(size) = limit {
            need(size.iter().all(|side| (1..=1 << 16).contains(side)), || {
                format!("box: limit size = {size:?}: a target has 1 to 65536 pixels on each side")
            })?;
        }
        let EdgeBox::Vertices { hold_both, .. } = self.r#box else { return Ok(()) };
        need(!hold_both || limit != BoxLimit::None, || {
            "box: hold-both = true has no effect without a limit".to_owned()
        })?;
        self.check_cuts()
    }

    fn check_cuts(&self) -> Result<(), RegisterError> {
        let EdgeSource::Vertices { product_cut, cut, .. } = self.edges else { return Ok(()) };
        let both = product_cut.saturating_add(cut);
        need(both <= 40, || format!("edges: product-cut + cut = {both} <= 40 is needed"))
    }

    fn check_order(&self) -> Result<(), RegisterError> {
        let EdgeOrder::Tiles { width, height, .. } = self.order else { return Ok(()) };
        need((1..=1024).contains(&width) && (1..=1024).contains(&height), || {
            format!("order: tiles of {width} x {height}: a tile has 1 to 1024 pixels on each side")
        })
    }

    fn check_channels(&self, channels: &[Channel]) -> Result<(), RegisterError> {
        need(self.values.is_none() || !channels.is_empty(), || {
            "`values` says where channels come from, and there are no channels".to_owned()
        })?;
        let Some(first) = channels.first() else { return Ok(()) };
        let Some(values) = self.values else {
            return need(false, || {
                format!("channel {:?}: say where channels come from with `values`", first.name)
            });
        };
        let of_vertices = !matches!(values, ValueSource::Given { .. });
        need(!of_vertices || matches!(self.edges, EdgeSource::Vertices { .. }), || {
            "values are set up from vertices, and edges are given; use values = { given = {} }"
                .to_owned()
        })?;
        for channel in channels {
            let name = &channel.name;
            need(!OWN.contains(&name.as_str()), || {
                format!("channel {name:?}: the engine has a value of this name; choose another one")
            })?;
            need(channel.correction == 0, || {
                format!("channel {name:?}: correction has no effect without sub-scanlines")
            })?;
            let slopes = channel.drop == 0 && channel.shift_along == channel.shift;
            need(!of_vertices || slopes, || {
                format!("channel {name:?}: drop and shift-along are for slopes that are given")
            })?;
            let planes = !matches!(values, ValueSource::Weights { .. });
            need(planes || channel.slope_width == channel.width, || {
                format!("channel {name:?}: slope-width has no effect on weighted values")
            })?;
        }
        Ok(())
    }

    /// Whether every number of a channel fits, with `bits` in its widest register.
    fn check_values(
        &self,
        values: ValueSource,
        channel: &Channel,
        bits: u32,
        vertex: &VertexConfig,
    ) -> Result<(), RegisterError> {
        let (name, of_channel) = (&channel.name, channel.read.fraction());
        let difference = vertex.difference_bits();
        let divide = match values {
            ValueSource::Given { .. } => return Ok(()),
            ValueSource::Planes { divide, .. } | ValueSource::Weights { divide, .. } => divide,
        };
        check_division(divide)?;
        match values {
            ValueSource::Given { .. } => Ok(()),
            ValueSource::Planes { fraction, width, product, start, .. } => {
                let fraction = fraction.unwrap_or(of_channel);
                need(fraction >= of_channel, || {
                    format!(
                        "channel {name:?}: interpolation = {of_channel} <= fraction = {fraction} is needed"
                    )
                })?;
                need(width.is_none_or(|width| (2..=64).contains(&width)), || {
                    "values: 2 <= width <= 64 is needed".to_owned()
                })?;
                let (cut, held) = (fraction - of_channel, width.unwrap_or(64));
                need(cut < held, || {
                    format!(
                        "channel {name:?}: fraction - interpolation = {cut} < width = {held} is needed"
                    )
                })?;
                need(product.is_none_or(|product| (2..=128).contains(&product)), || {
                    "values: 2 <= product <= 128 is needed".to_owned()
                })?;
                need(start == PlaneStart::Box || channel.slope_width == channel.width, || {
                    format!(
                        "channel {name:?}: slope-width needs start = \"box\": from a vertex slopes are not cut"
                    )
                })?;
                let need_bits = bits + difference + channel.shift + cut + vertex.sub_pixel + 3;
                need(need_bits <= 126, || {
                    format!(
                        "channel {name:?}: register + difference + shift + (fraction - interpolation) + sub-pixel \
                         + 3 = {need_bits} <= 126 bits is needed"
                    )
                })
            }
            ValueSource::Weights { fraction, product_cut, product, .. } => {
                let product = product.unwrap_or(64);
                need((1..=64).contains(&product) && product_cut <= 64, || {
                    format!(
                        "values: 1 <= product = {product} <= 64 and product-cut = {product_cut} <= 64 are needed"
                    )
                })?;
                need(fraction <= 100, || {
                    format!("values: fraction = {fraction} <= 100 is needed")
                })?;
                let quotient = matches!(divide, Division::Quotient(_));
                need(!quotient || product_cut == 0, || {
                    "values: product-cut has no effect on an exact quotient".to_owned()
                })?;
                let (words, places) = match divide {
                    Division::Quotient(_) => (self.width + fraction, fraction),
                    Division::Reciprocal { numerator, drop, .. } => (product, numerator + drop),
                    Division::Table { seed, .. } => (product, seed),
                };
                let up = (fraction + product_cut).saturating_sub(places);
                let need_bits = words + up + bits + channel.shift + 1;
                need(need_bits <= 126, || {
                    format!(
                        "channel {name:?}: weight + register + shift + 1 = {need_bits} <= 126 bits is needed"
                    )
                })
            }
        }
    }
}

fn check_division(divide: Division) -> Result<(), RegisterError> {
    match divide {
        Division::Quotient(_) => Ok(()),
        Division::Reciprocal { numerator, drop, zero } => {
            need(numerator <= 60 && drop < 64 && zero < 1 << 61, || {
                format!(
                    "values: reciprocal numerator = {numerator} <= 60, drop = {drop} <= 63 and zero = {zero} < 2^61 \
                     are needed"
                )
            })
        }
        Division::Table { index, between, seed } => {
            need((1..=16).contains(&index) && between <= 32 && (1..=40).contains(&seed), || {
                format!(
                    "values: table index = {index} from 1 to 16, between = {between} <= 32 and seed = {seed} from 1 \
                     to 40 are needed"
                )
            })
        }
    }
}

impl Wires {
    /// Whether a pixel number fits its registers, and a register of a vertex holds no more than a vertex.
    fn check(&self, vertex: &VertexConfig) -> Result<(), RegisterError> {
        if let EdgeWires::Vertices(wires) = &self.edges {
            let (bits, most) = (widest(wires.as_flattened()), vertex.integer + vertex.sub_pixel);
            need(bits <= most, || {
                format!(
                    "a register of a vertex has {bits} bits, and a vertex integer + sub-pixel = {most} bits"
                )
            })?;
        }
        let gathers: &[_] = match &self.limit {
            LimitWires::Rectangle(ends, _) => ends,
            LimitWires::Size2 { size, .. } => size,
            LimitWires::None | LimitWires::Size(_) => &[],
        };
        let bits = widest(gathers);
        need(bits < PIXEL, || {
            format!(
                "the box or its limit has a register of {bits} bits; at most {} are possible",
                PIXEL - 1
            )
        })
    }
}

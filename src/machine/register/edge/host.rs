//! What a host writes: vertices and their values, or exact edge words and planes. Spec clause `RG-4`.

use super::part::{BoxEnds, EdgeBox, EdgeSense, EdgeSource, Origin, Winding};
use super::setup::EdgeFunctions;
use super::value::ValueSource;
use super::wire::{EdgeWires, LimitWires};
use crate::format::Gather;
use crate::machine::register::host::{attributes, gradient, held, target_ends};
use crate::setup::Triangle;

/// Writes a value into its register.
type Put<'a> = &'a mut dyn FnMut(&Gather, i128);

impl EdgeFunctions {
    /// Which vertex is written first, second and third: machines of one winding are given theirs.
    fn order(&self, triangle: &Triangle) -> [usize; 3] {
        let area = triangle.area2();
        let below = match self.config.edges {
            EdgeSource::Vertices { sense: EdgeSense::Negative, .. } => area > 0,
            EdgeSource::Vertices { .. } | EdgeSource::Given { .. } => area < 0,
        };
        if below && self.config.winding == Winding::One { [0, 2, 1] } else { [0, 1, 2] }
    }

    /// The words of a triangle: one list, or none without a pixel.
    pub(super) fn host_words(&self, triangle: &Triangle, count: usize) -> Vec<Vec<u32>> {
        let order = self.order(triangle);
        let xy = order.map(|n| triangle.xy[n]);
        let bounds = self.target.bounds(triangle);
        let [x0, y0, x1, y1] = bounds.map(i64::from);
        if x0 >= x1 || y0 >= y1 {
            return Vec::new();
        }
        let mut words = vec![0; count];
        let mut put = |gather: &Gather, value: i128| gather.scatter(value, &mut words);
        match &self.wires.edges {
            EdgeWires::Vertices(wires) => {
                for (wires, at) in wires.iter().zip(xy) {
                    wires.iter().zip(at).for_each(|(gather, value)| put(gather, value));
                }
            }
            EdgeWires::Given(wires) => self.host_edges(wires, xy, [x0, y0], &mut put),
        }
        self.host_limit([x0, y0, x1, y1], &mut put);
        self.host_values(triangle, order, [x0, y0], &mut put);
        vec![words]
    }

    /// Edge words in sub-pixels squared, positive inside.
    fn host_edges(
        &self,
        wires: &[[Gather; 3]; 3],
        xy: [[i128; 2]; 3],
        first: [i64; 2],
        put: Put<'_>,
    ) {
        let at = match self.config.edges {
            EdgeSource::Given { at: Origin::Window } => [0; 2],
            _ => first,
        };
        let grid = &self.target.grid;
        let sample = grid.position(at[0].into(), at[1].into());
        let edges = crate::setup::edges(&Triangle { xy, z: None });
        for (wires, edge) in wires.iter().zip(edges) {
            let steps = [edge.a, edge.b].map(|step| step << grid.sub_pixel);
            let values = [edge.at(sample[0], sample[1]), steps[0], steps[1]];
            wires.iter().zip(values).for_each(|(gather, value)| put(gather, value));
        }
    }

    /// The box, or what it is cut to: the target.
    fn host_limit(&self, bounds: [i64; 4], put: Put<'_>) {
        match &self.wires.limit {
            LimitWires::None | LimitWires::Size(_) => {}
            LimitWires::Size2 { size, exponents } => {
                for (axis, gather) in size.iter().enumerate() {
                    let (_, end) = self.target.clip.clip(axis, (0, i128::MAX >> 1));
                    let end = if *exponents { end.next_power_of_two().ilog2() } else { end };
                    put(gather, held(gather, end.into()));
                }
            }
            LimitWires::Rectangle(wires, kind) => {
                let closed = *kind == BoxEnds::Closed;
                let mut ends = target_ends(&self.target, closed, wires.each_ref());
                if matches!(self.config.r#box, EdgeBox::Given(_)) {
                    let past = i128::from(closed);
                    let [x0, y0, x1, y1] = bounds.map(i128::from);
                    let bounds = [x0, y0, x1 - past, y1 - past];
                    ends = std::array::from_fn(|n| held(&wires[n], bounds[n]));
                }
                wires.iter().zip(ends).for_each(|(gather, end)| put(gather, end));
            }
        }
    }

    /// Starts and slopes of the channels, or their values at the vertices.
    fn host_values(&self, triangle: &Triangle, order: [usize; 3], first: [i64; 2], put: Put<'_>) {
        let grid = &self.target.grid;
        let one = 1i128 << grid.sub_pixel;
        for (n, (channel, wires)) in self.channels.iter().zip(&self.wires.values).enumerate() {
            let values = attributes(channel, n);
            let Some(ValueSource::Given { at }) = self.config.values else {
                for (gather, from) in wires.iter().zip(order) {
                    put(gather, channel.register(values[from], 1, channel.shift).into());
                }
                continue;
            };
            let Some(([dx, dy], area)) = gradient(triangle, values) else { continue };
            let at = if at == Origin::Box { first } else { [0; 2] };
            let [x, y] = grid.position(at[0].into(), at[1].into());
            let p = triangle.xy[0];
            let start = values[0] * area + dx * (x - p[0]) + dy * (y - p[1]);
            let mut register = |gather, numerator, shift| {
                put(gather, channel.register(numerator, area, shift).into());
            };
            register(&wires[0], start, channel.shift);
            register(&wires[1], dx * one, channel.shift_along);
            register(&wires[2], dy * one, channel.shift);
        }
    }
}

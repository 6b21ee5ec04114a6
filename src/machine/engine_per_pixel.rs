//! An engine at every pixel: all of them evaluate every primitive, fed by a tree of bit-serial
//! adders that multiplies a coefficient with every column at once. Spec clauses `A-2` and `A-4`.

mod form;

pub use form::EnginePerPixelConfig;
pub(super) use form::KIND;

use super::carry::Planes;
use super::edge_function::{edge_columns, setup_words};
use super::painter::{Painter, drawable};
use super::{Carrier, DrawError, EdgeFunction, Input, Machine, Ports, Sink, Target, Work};
use crate::cover::EdgeWordConfig;
use crate::dda::Processor;
use crate::setup::VertexConfig;
use crate::value::Depth;

/// The machine of `[form.engine-per-pixel]`.
#[derive(Clone, Debug)]
pub struct EnginePerPixel {
    engines: EdgeFunction,
    edges: EdgeWordConfig,
    depth: Option<Depth>,
    target: Target,
    /// Words that hold every value over the window: engines outside the bounding box stay dark.
    exact: bool,
    ports: Ports,
}

impl EnginePerPixel {
    /// A machine of validated parts; `exact_width` holds every edge value of the window.
    pub fn new(
        edges: EdgeWordConfig,
        exact_width: u32,
        depth: Option<Depth>,
        vertex: &VertexConfig,
        target: Target,
        processor: Processor,
    ) -> Self {
        let setup = edge_columns(edges, vertex);
        let ports = Ports::triangle(vertex, setup, depth);
        let engines = EdgeFunction::new(edges, depth, vertex, target, processor);
        Self { engines, edges, depth, target, exact: edges.width >= exact_width, ports }
    }
}

impl Machine for EnginePerPixel {
    fn ports(&self) -> &Ports {
        &self.ports
    }

    fn carrier(&self) -> Option<&dyn Carrier> {
        Some(&Planes)
    }

    fn draw(&self, input: &Input<'_>, out: &mut dyn Sink) -> Result<(), DrawError> {
        let Some(triangle) = drawable(input.triangle()?, out) else { return Ok(()) };
        let Target { grid, clip, .. } = self.target;
        let words = self.edges.words(&triangle, &grid);
        let mut painter = Painter::new(self.depth.as_ref(), &triangle, &self.target);
        painter.announce(|| setup_words(&words), out);
        // A word that wraps lights engines far away; one that does not leaves them dark, and the
        // model need not look.
        let everywhere = [clip.x0, clip.y0, clip.x1, clip.y1];
        let looked_at = if self.exact { self.target.bounds(&triangle) } else { everywhere };
        self.engines.runs(&words, looked_at, &mut |y, x0, x1| painter.span(y, x0, x1, out))?;
        let (columns, rows) = (u64::from(clip.x1 - clip.x0), u64::from(clip.y1 - clip.y0));
        out.work(&Work { visits: columns * rows, ..Work::default() });
        Ok(())
    }
}

/// A one-bit adder with its carry, least significant bits first.
#[derive(Clone, Copy, Debug, Default)]
struct SerialAdder {
    carry: bool,
}

impl SerialAdder {
    fn clock(&mut self, a: bool, b: bool) -> bool {
        let sum = a ^ b ^ self.carry;
        self.carry = (a && b) || (self.carry && (a ^ b));
        sum
    }
}

/// `a x + b y + c` mod 2^width as the engine at pixel (x, y) receives it: c enters a tree of serial
/// adders bit by bit, and at each level the branch of a set bit of x (then of y) adds the
/// coefficient, delayed by that bit's weight. The plain twin of every plane of this machine.
///
/// Range: `width` of 1 to 128, x and y below 2^16.
///
/// ```
/// use guardbit::machine::serial_plane;
/// assert_eq!(serial_plane([-3, 5, 7], [6, 2], 8), 256 + 7 - 18 + 10);
/// ```
pub fn serial_plane([a, b, c]: [i128; 3], [x, y]: [u32; 2], width: u32) -> u128 {
    const LEVELS: u32 = 16;
    let mut adders = [[SerialAdder::default(); LEVELS as usize]; 2];
    let bit = |value: i128, at: u32| value >> at & 1 == 1;
    let mut word = 0;
    for clock in 0..width.min(128) {
        let mut stream = bit(c, clock);
        for (axis, (coefficient, place)) in [(a, x), (b, y)].into_iter().enumerate() {
            for level in (0..LEVELS).rev().filter(|level| place >> level & 1 == 1) {
                let delayed = clock >= level && bit(coefficient, clock - level);
                stream = adders[axis][level as usize].clock(stream, delayed);
            }
        }
        word |= u128::from(stream) << clock;
    }
    word
}

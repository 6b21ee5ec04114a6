//! The edge-function machine: three exact (or deliberately narrow) edge words over the bounding
//! box, row by row, and a depth plane. Spec clauses `C-4` to `C-7`.

use super::{DrawError, Input, Machine, Ports, Sink, Target};
use crate::bits::{Event, Lane};
use crate::cover::{EdgeWordConfig, EdgeWords, for_each_run};
use crate::dda::{Processor, row_inside};
use crate::format::{Clamp, Column};
use crate::setup::{Plane, Triangle, VertexConfig};
use crate::value::Depth;

/// The machine of `[form.edge-function]`.
#[derive(Clone, Debug)]
pub struct EdgeFunction {
    edges: EdgeWordConfig,
    depth: Option<Depth>,
    target: Target,
    processor: Processor,
    ports: Ports,
}

impl EdgeFunction {
    /// A machine of validated parts.
    pub fn new(
        edges: EdgeWordConfig,
        depth: Option<Depth>,
        vertex: &VertexConfig,
        target: Target,
        processor: Processor,
    ) -> Self {
        let fraction = match edges.storage {
            crate::cover::EdgeStorage::Full => 2 * vertex.sub_pixel,
            crate::cover::EdgeStorage::Shifted => vertex.sub_pixel,
        };
        let setup = (0..3)
            .flat_map(|k| {
                let names = [
                    (format!("e{k}"), format!("Edge {k} at pixel (0, 0), biased and stored.")),
                    (format!("a{k}"), format!("Edge {k}, step per pixel to the right.")),
                    (format!("b{k}"), format!("Edge {k}, step per row downward.")),
                ];
                names.map(|(name, meaning)| {
                    Column::new(&name, edges.width, true, fraction, &meaning)
                })
            })
            .collect();
        let ports = Ports::triangle(vertex, setup, depth.map(|depth| depth.read_out()));
        Self { edges, depth, target, processor, ports }
    }

    fn rows<L: Lane>(
        &self,
        words: &EdgeWords,
        [x0, y0, x1, y1]: [u32; 4],
        out: &mut dyn FnMut(u32, u32, u32) -> Result<(), DrawError>,
    ) -> Result<(), DrawError> {
        let mut row = words.lanes::<L>(self.edges.width, x0, y0);
        let mut mask = Vec::new();
        for y in y0..y1 {
            row_inside(self.processor, row, x1 - x0, &mut mask);
            let mut done = Ok(());
            for_each_run(&mask, |start, end| {
                if done.is_ok() {
                    done = out(y, x0 + start, x0 + end);
                }
            });
            done?;
            row = row.rows_down(L::one());
        }
        Ok(())
    }
}

impl Machine for EdgeFunction {
    fn ports(&self) -> &Ports {
        &self.ports
    }

    fn draw(&self, input: &Input<'_>, out: &mut dyn Sink) -> Result<(), DrawError> {
        let Input::Triangle(triangle) = *input;
        let Some(triangle) = drawable(triangle, out) else { return Ok(()) };
        let Target { grid, clip } = self.target;
        let words = self.edges.words(&triangle, &grid);
        let mut painter = Painter::new(self.depth, &triangle, &self.target);
        let mut setup = Vec::with_capacity(12);
        for k in 0..3 {
            setup.extend([words.value[k], words.step_x[k], words.step_y[k]]);
        }
        painter.announce(setup, self.depth.is_some(), out);
        let (x0, x1) = clip.clip(0, grid.pixels(0, triangle.extent(0)));
        let (y0, y1) = clip.clip(1, grid.pixels(1, triangle.extent(1)));
        if x0 == x1 {
            return Ok(());
        }
        let mut paint = |y, x0, x1| painter.span(y, x0, x1, out);
        if self.edges.width <= 64 {
            self.rows::<i64>(&words, [x0, y0, x1, y1], &mut paint)
        } else {
            self.rows::<i128>(&words, [x0, y0, x1, y1], &mut paint)
        }
    }
}

/// The normalised triangle, or `None` after reporting that it has no area. Spec clause `T-3`.
pub(super) fn drawable(triangle: &Triangle, out: &mut dyn Sink) -> Option<Triangle> {
    let triangle = triangle.normalised();
    if triangle.area2() == 0 {
        out.zero_area();
        return None;
    }
    Some(triangle)
}

/// Values and events of the spans of one triangle.
pub(super) struct Painter {
    depth: Option<(Depth, Plane)>,
    values: Vec<u64>,
}

impl Painter {
    pub(super) fn new(depth: Option<Depth>, triangle: &Triangle, target: &Target) -> Self {
        let depth =
            depth.zip(triangle.z).map(|(depth, z)| (depth, depth.plane(triangle, z, &target.grid)));
        Self { depth, values: Vec::new() }
    }

    /// Hands the set-up words to the sink; a triangle without depth has zeros there.
    pub(super) fn announce(&self, mut words: Vec<i128>, has_depth: bool, out: &mut dyn Sink) {
        if has_depth {
            let plane = self.depth.map(|(_, plane)| plane).unwrap_or_default();
            words.extend([plane.start, plane.dx, plane.dy]);
        }
        out.setup(&words);
    }

    pub(super) fn span(
        &mut self,
        y: u32,
        x0: u32,
        x1: u32,
        out: &mut dyn Sink,
    ) -> Result<(), DrawError> {
        let Some((depth, plane)) = &self.depth else {
            out.span(y, x0, x1, &[]);
            return Ok(());
        };
        let strict = depth.read_out().clamp() == Clamp::Error;
        if strict || out.wants_events() {
            let events = depth.events(plane, y, x0, x1 - x0);
            if let (true, Some(place)) = (strict, events.first[Event::Wrap as usize]) {
                return Err(DrawError::GuardRange { x: place.x, y: place.y });
            }
            out.events(&events);
        }
        self.values.resize((x1 - x0) as usize, 0);
        depth.span(plane, y, x0, &mut self.values);
        out.span(y, x0, x1, &self.values);
        Ok(())
    }
}

//! Any machine at several samples a pixel: coverage masks, depth at the centre or at the samples.
//! Spec clauses `U-1` to `U-4`.

use super::painter::report;
use super::{Carrier, DrawError, Input, Machine, Ports, Sink, Target, Work};
use crate::bits::{Place, SpanEvents, bounded};
use crate::cover::{DepthAt, MultisampleConfig, Rect};
use crate::format::{Column, Role, Unreduced, WordFormat};
use crate::setup::{Plane, Triangle, VertexConfig};
use crate::value::Depth;

/// One machine a sample, and depth planes over them.
#[derive(Debug)]
pub struct Multisampled {
    config: MultisampleConfig,
    /// Without depth, each on the grid of its sample.
    samples: Vec<Box<dyn Machine>>,
    depth: Option<Depth>,
    target: Target,
    ports: Ports,
}

/// Runs of one sample.
#[derive(Default)]
struct Kept {
    setup: Vec<Unreduced>,
    runs: Vec<[u32; 3]>,
    zero_area: bool,
    work: Work,
}

impl Sink for Kept {
    fn wants_setup(&self) -> bool {
        true
    }

    fn setup(&mut self, words: &[Unreduced]) {
        self.setup.extend_from_slice(words);
    }

    fn zero_area(&mut self) {
        self.zero_area = true;
    }

    fn span(&mut self, y: u32, x0: u32, x1: u32, _: &[u64]) {
        self.runs.push([y, x0, x1]);
    }

    fn work(&mut self, work: &Work) {
        self.work.add(work);
    }
}

impl Multisampled {
    /// A machine of validated parts: `samples` draw coverage alone, each on the grid of its sample;
    /// `target` has the grid of pixel centres.
    pub fn new(
        config: MultisampleConfig,
        samples: Vec<Box<dyn Machine>>,
        depth: Option<Depth>,
        vertex: &VertexConfig,
        target: Target,
    ) -> Self {
        let mut setup = Vec::new();
        for (n, machine) in samples.iter().enumerate() {
            setup.extend(machine.ports().setup.iter().map(|column| Column {
                name: format!("{}_{n}", column.name),
                meaning: format!("Sample {n}: {}", column.meaning),
                ..column.clone()
            }));
        }
        let read = depth.map(|depth| depth.read_out());
        if let Some(read) = read {
            let word = WordFormat::signed(read.width()).fraction(read.fraction());
            let init = Role::DEPTH_INIT.column(word);
            match config.depth {
                DepthAt::Centre => {
                    let meaning = "Depth accumulator at the centre of pixel (0, 0).".to_owned();
                    setup.push(Column { meaning, ..init });
                }
                DepthAt::Sample => setup.extend((0..config.samples).map(|n| Column {
                    name: format!("{}_{n}", init.name),
                    meaning: format!("Depth accumulator at sample {n} of pixel (0, 0)."),
                    ..init.clone()
                })),
            }
            setup.extend([Role::DEPTH_DX, Role::DEPTH_DY].map(|role| role.column(word)));
        }
        let mut ports = Ports::valued(vertex, setup, depth);
        ports.mask = Some(Role::MASK.column(WordFormat::unsigned(config.samples)));
        ports.by_sample = config.depth == DepthAt::Sample && depth.is_some();
        Self { config, samples, depth, target, ports }
    }

    /// One run of pixels: depth of the covered samples in pixel and then sample order, or of the
    /// centres; then the masks.
    fn run(
        &self,
        planes: Option<&(Depth, Vec<Plane>)>,
        (y, x0): (u32, u32),
        masks: &[u32],
        out: &mut dyn Sink,
    ) -> Result<(), DrawError> {
        let x1 = x0 + bounded::<_, u32>(masks.len());
        let Some((depth, planes)) = planes else {
            out.span(y, x0, x1, &[]);
            out.masks(y, x0, masks);
            return Ok(());
        };
        let (read, mut events) = (depth.read_out(), SpanEvents::default());
        let (mut values, mut held) = (Vec::new(), Vec::new());
        for (mask, x) in masks.iter().zip(x0..) {
            for (n, plane) in planes.iter().enumerate() {
                if self.config.depth == DepthAt::Centre || mask >> n & 1 == 1 {
                    let value = depth.accumulator(plane, x, y);
                    let place = Place { y: i64::from(y), x: i64::from(x) };
                    events.note(place, read.status(value), value);
                    let kept = read.reduce(value).clamp(0, read.top() - 1);
                    values.push(depth.code(kept));
                    held.push(kept);
                }
            }
        }
        report(read, events, out)?;
        out.span(y, x0, x1, &values);
        if out.wants_held() {
            out.held(y, x0, &held);
        }
        out.masks(y, x0, masks);
        Ok(())
    }

    fn planes(&self, triangle: &Triangle) -> Option<(Depth, Vec<Plane>)> {
        let triangle = triangle.normalised();
        let (depth, z) = self.depth.zip(triangle.z)?;
        let grids = match self.config.depth {
            DepthAt::Centre => vec![self.target.grid],
            DepthAt::Sample => self.config.grids(self.target.grid.sub_pixel),
        };
        Some((depth, grids.iter().map(|grid| depth.plane(&triangle, z, grid)).collect()))
    }
}

impl Machine for Multisampled {
    fn ports(&self) -> &Ports {
        &self.ports
    }

    fn carrier(&self) -> Option<&dyn Carrier> {
        self.samples.first()?.carrier()
    }

    fn draw(&self, input: &Input<'_>, out: &mut dyn Sink) -> Result<(), DrawError> {
        let triangle = *input.triangle()?;
        let mut work = Work::default();
        let mut setup = Vec::new();
        let mut samples = Vec::with_capacity(self.samples.len());
        for machine in &self.samples {
            let mut kept = Kept::default();
            machine.draw(&Input::Triangle(&triangle.without_depth()), &mut kept)?;
            if kept.zero_area {
                out.zero_area();
                return Ok(());
            }
            setup.append(&mut kept.setup);
            work.add(&kept.work);
            // What the mask of the profile leaves out is covered by nothing. Clause `FP-5`.
            let drawn = self.config.drawn() >> samples.len() & 1 == 1;
            samples.push(if drawn { kept.runs } else { Vec::new() });
        }
        let planes = self.planes(&triangle);
        if let Some(depth) = &self.depth {
            let zero = Plane::zero(depth.read_out().fraction());
            let starts = if self.config.depth == DepthAt::Centre { 1 } else { self.samples.len() };
            let planes = planes.as_ref().map_or(&[][..], |(_, planes)| planes);
            let words = |n: usize| planes.get(n).unwrap_or(&zero).values();
            setup.extend((0..starts).map(|n| words(n)[0]));
            setup.extend_from_slice(&words(0)[1..]);
        }
        out.setup(&setup);
        let Some(bounds) = bounds(&samples) else { return Ok(()) };
        let width = (bounds.x1 - bounds.x0) as usize;
        let mut masks = vec![0u32; width];
        let mut next = vec![0; samples.len()];
        for y in bounds.y0..bounds.y1 {
            masks.fill(0);
            for (n, runs) in samples.iter().enumerate() {
                while let Some([_, x0, x1]) = runs.get(next[n]).filter(|run| run[0] == y) {
                    let row = &mut masks[(x0 - bounds.x0) as usize..(x1 - bounds.x0) as usize];
                    for mask in row {
                        *mask |= 1 << n;
                    }
                    next[n] += 1;
                }
            }
            let mut from = 0;
            for run in masks.chunk_by(|a, b| (*a == 0) == (*b == 0)) {
                let x0 = bounds.x0 + from;
                let length = bounded::<_, u32>(run.len());
                from += length;
                if run[0] == 0 {
                    continue;
                }
                self.run(planes.as_ref(), (y, x0), run, out)?;
            }
        }
        out.work(&work);
        Ok(())
    }
}

/// The box around all runs.
fn bounds(samples: &[Vec<[u32; 3]>]) -> Option<Rect> {
    samples.iter().flatten().fold(None, |found: Option<Rect>, [y, x0, x1]| {
        let run = Rect { x0: *x0, y0: *y, x1: *x1, y1: y + 1 };
        Some(found.map_or(run, |all| Rect {
            x0: all.x0.min(run.x0),
            y0: all.y0.min(run.y0),
            x1: all.x1.max(run.x1),
            y1: all.y1.max(run.y1),
        }))
    })
}

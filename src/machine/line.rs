//! Lines and points, by the rules of a profile: no set-up words, spans without values.
//! Spec clauses `L-1` to `L-9`.

use super::{DrawError, Input, Machine, Ports, Sink, Target};
use crate::cover::{LineConfig, PointConfig};
use crate::format::Column;
use crate::setup::VertexConfig;

/// Draws lines and points.
#[derive(Clone, Debug)]
pub struct Lines {
    line: LineConfig,
    point: PointConfig,
    target: Target,
    ports: Ports,
}

impl Lines {
    /// A machine of validated parts.
    pub fn new(
        line: LineConfig,
        point: PointConfig,
        vertex: &VertexConfig,
        target: Target,
    ) -> Self {
        let mut ports = Ports::valued(vertex, Vec::new(), None);
        // The two ends of a line are its inputs; a point is the first of them.
        ports.input.truncate(4);
        for (column, (end, axis)) in
            ports.input.iter_mut().zip([("From", "x"), ("From", "y"), ("To", "x"), ("To", "y")])
        {
            *column = Column { meaning: format!("{end}, {axis} in sub-pixels."), ..column.clone() };
        }
        Self { line, point, target, ports }
    }
}

impl Machine for Lines {
    fn ports(&self) -> &Ports {
        &self.ports
    }

    fn draw(&self, input: &Input<'_>, out: &mut dyn Sink) -> Result<(), DrawError> {
        let Target { grid, clip, .. } = self.target;
        match input {
            Input::Line(line) => {
                let mut pixels = Vec::new();
                self.line.pixels(***line, &grid, clip, &mut |x, y| pixels.push([y, x]));
                pixels.sort_unstable();
                pixels.dedup();
                for run in pixels.chunk_by(|a, b| a[0] == b[0] && a[1] + 1 == b[1]) {
                    let [y, x0] = run[0];
                    out.span(y, x0, run[run.len() - 1][1] + 1, &[]);
                }
            }
            Input::Point(point) => {
                self.point.rows(***point, &grid, clip, &mut |y, x0, x1| out.span(y, x0, x1, &[]));
            }
            other => return Err(DrawError::Primitive(other.name())),
        }
        Ok(())
    }
}

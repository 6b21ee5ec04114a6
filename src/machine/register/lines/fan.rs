//! A quadrilateral as lines between two of its edges. Spec clause `RL-10`.

use super::{Lines, Pen, Pixel};
use crate::cover::{ErrorWord, Measures, Stepper, StepperError};
use crate::machine::register::RegisterError;
#[cfg(feature = "verification")]
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How a quadrilateral becomes lines.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "verification", derive(JsonSchema))]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub struct FanConfig {
    /// The two edges, by the numbers of their vertices: a line goes from the first edge to the second one.
    pub edges: [[u8; 2]; 2],
    /// When an edge goes on, between two lines: the shorter edge waits.
    pub pace: ErrorWord,
    /// How an edge goes from pixel to pixel.
    pub edge: Stepper,
}

impl FanConfig {
    pub(super) fn check(
        &self,
        part: impl Fn(&str, StepperError) -> RegisterError,
        fault: impl Fn(String) -> RegisterError,
    ) -> Result<(), RegisterError> {
        let mut all = self.edges.concat();
        all.sort_unstable();
        if all != [0, 1, 2, 3] {
            return Err(fault(format!(
                "draws.fan.edges = {:?}: each of the vertices 0 to 3 is needed once",
                self.edges
            )));
        }
        self.pace.check(true).map_err(|error| part("pace", error))?;
        self.edge.check().map_err(|error| part("edge", error))
    }

    /// A triangle as four vertices: the third one ends both edges.
    pub(super) fn corners(&self, [a, b, c]: [Pixel; 3]) -> Vec<Pixel> {
        let mut corners = vec![c; 4];
        for (edge, start) in self.edges.iter().zip([a, b]) {
            corners[usize::from(edge[0])] = start;
        }
        corners
    }
}

impl Lines {
    pub(super) fn fan(&self, fan: &FanConfig, corners: [Pixel; 4], pen: &mut Pen<'_>) {
        let edges = fan.edges.map(|edge| edge.map(|n| corners[usize::from(n)]));
        let lengths = edges.map(|edge| Measures::of(edge, 0).length());
        let max = lengths[0].max(lengths[1]);
        let mut sides = edges.map(|edge| {
            let mut pixels = Vec::new();
            fan.edge.walk(edge, &mut |at| pixels.push(at));
            (fan.pace.begin(Measures::of(edge, max)), pixels, 0usize)
        });
        for _ in 0..=max {
            // A stepper starts with a pixel, so no edge is empty.
            let ends = sides.each_ref().map(|(_, pixels, at)| pixels[*at]);
            self.line(ends, pen);
            pen.line += 1;
            for (pace, pixels, at) in &mut sides {
                if pace.step() && *at + 1 < pixels.len() {
                    *at += 1;
                }
            }
        }
    }
}

//! Channels down the edges and along the spans. Spec clause `CH-13`.

use super::{Gouraud, descend};
use crate::format::{Column, Unreduced};
use crate::machine::{Accumulators, Carried, CarriedWords, Carrier, LinearValue, WalkedEdge};

/// A value walked down three edges.
#[derive(Debug)]
struct Walked {
    machine: Gouraud,
    words: CarriedWords,
    edges: [Option<(WalkedEdge, [i128; 2])>; 3],
}

impl Carrier for Gouraud {
    fn columns(&self, name: &str, words: &CarriedWords, _: u32) -> Vec<Column> {
        let word = words.format();
        let edge = |k: usize| {
            [
                ("init", format!("{name} at the first row of edge {k}.")),
                ("dy", format!("{name}, change per row down edge {k}.")),
            ]
            .map(|(what, meaning)| word.column(format!("edge{k}_{name}_{what}"), meaning))
        };
        (0..3).flat_map(edge).collect()
    }

    fn carry(&self, value: &LinearValue<'_>, words: &CarriedWords) -> Box<dyn Carried> {
        let (v, grid) = (value.triangle.xy, &self.target.grid);
        let edges = std::array::from_fn(|k| {
            let next = (k + 1) % 3;
            let x = self.config.edge(v[k], v[next], grid)?;
            let ends = ([value.values[k], value.values[next]], value.scale);
            let format = (words.rounding, words.read.fraction());
            let [start, slope] = descend(grid, &x, [v[k], v[next]], ends, format);
            Some((x, [start + words.gain, slope]))
        });
        Box::new(Walked { machine: self.clone(), words: *words, edges })
    }
}

impl Carried for Walked {
    fn setup(&self) -> Vec<Unreduced> {
        let fraction = self.words.read.fraction();
        let edge = |edge: &Option<(WalkedEdge, [i128; 2])>| {
            edge.map_or([0; 2], |(_, words)| words).map(|raw| Unreduced::new(raw, fraction))
        };
        self.edges.iter().flat_map(edge).collect()
    }

    fn run(&self, y: u32, x: u32, _: usize) -> Accumulators {
        let row = i128::from(y);
        let crossed =
            self.edges.iter().flatten().filter(|(x, _)| (x.first_row..x.end_row).contains(&row));
        let mut cuts: Vec<(i128, i128)> = crossed
            .map(|(x, [start, slope])| {
                let down = row - x.first_row;
                (self.machine.word.reduce(x.start + x.slope * down), start + slope * down)
            })
            .collect();
        cuts.sort_unstable();
        let [left, right] = cuts[..] else { unreachable!("a covered row has two cuts") };
        Accumulators::Line(self.machine.along(self.words.rounding, x, [left, right]))
    }
}

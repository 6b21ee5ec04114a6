//! The reference model of the channels of a triangle.

use super::Device;
use crate::machine::Input;
use crate::model::{Drawing, Model, PixelDetail};
use crate::vector::bench::{ChannelAnswers, ChannelTest, Coverage};
use crate::vector::table::Table;
use std::sync::Arc;

/// Draws triangles with the channels of a model.
pub(in crate::vector) struct ChannelDrawer {
    model: Arc<Model>,
}

impl ChannelDrawer {
    /// The channels of a model.
    pub(in crate::vector) fn new(model: Arc<Model>) -> Self {
        Self { model }
    }

    /// What is drawn, and the levels of detail; nothing where a device of another profile does not take the
    /// codes.
    fn drawn(&self, test: &ChannelTest) -> (Drawing, Vec<Vec<PixelDetail>>) {
        let mut drawing = Drawing::default();
        let Ok(values) = self.model.values_in_order(&test.codes, test.inverse_w) else {
            return (drawing, Vec::new());
        };
        let details = self.model.place(test.triangle).ok().and_then(|triangle| {
            let drawn = self.model.draw_own(Input::Shaded(&triangle, &values), &mut drawing);
            drawn.then(|| self.model.details(&triangle, &values, &drawing).ok())?
        });
        let Some(details) = details else { return (Drawing::default(), Vec::new()) };
        (drawing, details)
    }
}

impl Device<ChannelTest> for ChannelDrawer {
    fn answer(&mut self, test: &ChannelTest, rows: &mut ChannelAnswers<Table>, _: &mut Coverage) {
        let (drawing, details) = self.drawn(test);
        let number = i128::from(test.test);
        let own = self.model.channels().map_or(0, |channels| channels.columns().len());
        let mut words = drawing.raw_setup();
        // A triangle without area has zeros.
        words.resize(self.model.ports().setup.len(), 0);
        let mut row = vec![number];
        row.extend(&words[words.len() - own..]);
        // A device of another profile may have more words or fewer; the file has those of the set.
        row.resize(rows.setup.columns().len(), 0);
        rows.setup.push(&row);
        let pixels = || drawing.spans.iter().flat_map(|run| (run.x0..run.x1).map(|x| (run.y, x)));
        let samples = |(n, place): (usize, (u32, u32))| {
            let mask = drawing.masks.get(n).copied().unwrap_or(1);
            (0..32).filter(move |sample| mask >> sample & 1 == 1).map(move |sample| (place, sample))
        };
        let ports = &self.model.ports().channels;
        for ((port, values), table) in ports.iter().zip(&drawing.channels).zip(&mut rows.codes) {
            let mut values = values.chunks(port.components.len());
            let mut push = |y: u32, x: u32, sample: Option<i128>| {
                let codes = values.next().unwrap_or_else(|| unreachable!("codes at each place"));
                let mut row = vec![number, y.into(), x.into()];
                row.extend(sample);
                row.extend(codes.iter().map(|code| i128::from(*code)));
                table.push(&row);
            };
            if port.by_sample {
                for ((y, x), sample) in pixels().enumerate().flat_map(samples) {
                    push(y, x, Some(sample));
                }
            } else {
                pixels().for_each(|(y, x)| push(y, x, None));
            }
        }
        for (pixels, table) in details.iter().zip(&mut rows.details) {
            for PixelDetail { x, y, differences: [u, v], level } in pixels {
                let differences = [u[0], v[0], u[1], v[1]].map(i128::from);
                let mut row = vec![number, (*y).into(), (*x).into()];
                row.extend(differences);
                row.push((*level).into());
                table.push(&row);
            }
        }
    }
}

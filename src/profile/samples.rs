//! Where a profile places its samples, and which machines can. Spec clauses `C-1` and `FP-1`.

use super::{InvalidProfile, Profile};
use crate::cover::{SampleError, SampleGrid};
use crate::setup::{Division, VertexConfig};

impl Profile {
    /// The sample grid.
    ///
    /// # Errors
    /// [`SampleError`] if the position is not in the pixel.
    pub fn grid(&self) -> Result<SampleGrid, SampleError> {
        SampleGrid::new(self.sample, self.vertex.sub_pixel)
    }

    /// The same for what is measured and proved on the sub-pixel grid alone.
    ///
    /// # Errors
    /// [`InvalidProfile`] if the position is not in the pixel, or between the sub-pixels.
    pub fn whole_grid(&self) -> Result<SampleGrid, InvalidProfile> {
        let grid = self.grid()?;
        if grid.is_on_the_grid() {
            return Ok(grid);
        }
        Err(InvalidProfile::BetweenSubPixels(
            "this command knows samples on their grid only".to_owned(),
            "use eval, render --show image, vectors, verify or trace",
        ))
    }

    /// The vertex field with the bits that parts of a sub-pixel add: what exact set-up has to hold.
    pub(super) fn finest_vertex(&self) -> VertexConfig {
        let sub_pixel = self.vertex.sub_pixel;
        let several = self.multisample.map_or_else(Vec::new, |config| config.grids(sub_pixel));
        let grids = several.into_iter().chain(self.grid());
        let parts = grids.map(|grid| grid.parts).max().unwrap_or(1);
        // The smallest n with parts <= 2^n.
        let bits = i128::BITS - (parts - 1).leading_zeros();
        VertexConfig { sub_pixel: sub_pixel + bits, ..self.vertex }
    }

    /// Checks the samples, and that the machine has the means for samples between the sub-pixels: the offset of
    /// an edge word, and planes of a quotient.
    pub(super) fn check_samples(&self) -> Result<(), InvalidProfile> {
        let grid = self.grid()?;
        let several = self.multisample.map_or_else(Vec::new, |config| config.grids(grid.sub_pixel));
        if several.iter().chain([&grid]).all(SampleGrid::is_on_the_grid) {
            return Ok(());
        }
        let fault = |reason: String, help| Err(InvalidProfile::BetweenSubPixels(reason, help));
        let form = &self.form;
        if form.edge().is_none() || !(form.visits_the_box() || form.tile().is_some()) {
            let reason = format!("the machine {} has no means for that", form.name());
            return fault(reason, "use [form.edge-function] or [form.tiles]");
        }
        if form.edge().is_some_and(|edge| edge.conservative.is_some()) {
            return fault(
                "squares have no samples".to_owned(),
                "leave the table `conservative` out",
            );
        }
        let depth = self.depth.iter().map(|depth| ("[depth]".to_owned(), depth.division));
        let channels = self
            .channel
            .iter()
            .map(|channel| (format!("channel {:?}", channel.name), channel.division));
        let mut by_reciprocal =
            depth.chain(channels).filter(|(_, division)| *division != Division::Quotient);
        if let Some((what, _)) = by_reciprocal.next() {
            let reason =
                format!("{what} is divided by a reciprocal, which is that of the area alone");
            return fault(reason, "write division = \"quotient\"");
        }
        Ok(())
    }
}

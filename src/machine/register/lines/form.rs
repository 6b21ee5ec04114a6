//! The engine `lines` as a profile configures it.

use super::change::{Change, stepper_changes, word_changes};
use super::{
    CLIP, Corner, EndOrder, Filler, FillerPlace, LastPixel, LineDraws, LinesConfig, MiddleRow,
    NAME, SpanEnd,
};
use crate::cover::Stepper;
use crate::machine::register::engine::{ClipNames, EngineForm};
use crate::machine::register::slope::ClipEnds;
use crate::machine::{EngineConfig, RegisterConfig, RegisterDevice, Step, Steps, Word};

type Lines<'a> = Steps<'a, LinesConfig, EngineConfig>;

impl EngineForm for LinesConfig {
    fn name(&self) -> &'static str {
        NAME
    }

    fn clip(&self) -> Option<ClipNames> {
        let names = ClipNames { ends: CLIP, sub_pixels: false, on: None };
        self.clip.map(|_| names)
    }

    fn edge_word(&self) -> Option<Word> {
        let bits = match &self.stepper {
            Stepper::Major(word) => word.bits,
            Stepper::Shared(shared) => shared.bits,
            Stepper::Own(own) => own.x.bits,
            Stepper::Slope(_) => None,
        };
        let facts = [("beyond its range", "wraps".to_owned())];
        bits.map(|bits| Word::new("error", [("error", bits)], facts))
    }

    fn device(&self, _: &RegisterConfig) -> Option<RegisterDevice> {
        None
    }

    fn neighbours(&self) -> Vec<Step<EngineConfig>> {
        let mut steps = Steps::of(self, EngineConfig::from);
        self.of_ends(&mut steps);
        self.of_fillers(&mut steps);
        for change in stepper_changes(&self.stepper) {
            let Change { field, got, was, part } = change.of("stepper");
            steps.add(&field, &got, &was, |lines| lines.stepper = part);
        }
        self.of_shape(&mut steps);
        steps.found()
    }
}

impl LinesConfig {
    fn of_ends(&self, steps: &mut Lines<'_>) {
        let name = |ends: EndOrder| match ends {
            EndOrder::AsGiven => "as-given",
            EndOrder::ByX => "by-x",
            EndOrder::ByY => "by-y",
        };
        for ends in [EndOrder::AsGiven, EndOrder::ByX, EndOrder::ByY] {
            steps.add("ends", &name(ends), &name(self.ends), |lines| lines.ends = ends);
        }
        if self.draws == LineDraws::Line {
            let (last, got, was) = match self.last {
                LastPixel::Drawn => (LastPixel::LeftOut, "left-out", "drawn"),
                LastPixel::LeftOut => (LastPixel::Drawn, "drawn", "left-out"),
            };
            steps.add("last", &got, &was, |lines| lines.last = last);
        }
        let clip = match self.clip {
            None => return,
            Some(ClipEnds::Closed) => (ClipEnds::HalfOpen, "half-open", "closed"),
            Some(ClipEnds::HalfOpen) => (ClipEnds::Closed, "closed", "half-open"),
        };
        steps.add("clip", &clip.1, &clip.2, |lines| lines.clip = Some(clip.0));
    }

    fn of_fillers(&self, steps: &mut Lines<'_>) {
        if matches!(self.draws, LineDraws::Fill(_)) {
            return;
        }
        let Some(was) = self.filler else {
            for (alike, unlike, name) in [
                (Corner::X, Corner::Y, "alike x, unlike y"),
                (Corner::Y, Corner::X, "alike y, unlike x"),
            ] {
                let filler = Filler { alike, unlike, place: FillerPlace::After };
                steps.add("filler", &name, &"none", |lines| lines.filler = Some(filler));
            }
            return;
        };
        steps.add("filler", &"none", &"one more pixel", |lines| lines.filler = None);
        let other = |corner: Corner| match corner {
            Corner::X => (Corner::Y, "y", "x"),
            Corner::Y => (Corner::X, "x", "y"),
        };
        let (alike, got, old) = other(was.alike);
        let changed = Filler { alike, ..was };
        steps.add("filler.alike", &got, &old, |lines| lines.filler = Some(changed));
        let (unlike, got, old) = other(was.unlike);
        let changed = Filler { unlike, ..was };
        steps.add("filler.unlike", &got, &old, |lines| lines.filler = Some(changed));
        let (place, got, old) = match was.place {
            FillerPlace::After => (FillerPlace::Before, "before", "after"),
            FillerPlace::Before => (FillerPlace::After, "after", "before"),
        };
        let changed = Filler { place, ..was };
        steps.add("filler.place", &got, &old, |lines| lines.filler = Some(changed));
    }

    fn of_shape(&self, steps: &mut Lines<'_>) {
        match &self.draws {
            LineDraws::Line => {}
            LineDraws::Fill(fill) => {
                let ends = [
                    (SpanEnd::First, "first"),
                    (SpanEnd::Last, "last"),
                    (SpanEnd::Outermost, "outermost"),
                ];
                let was =
                    ends.iter().find(|(end, _)| *end == fill.span_end).map_or("", |end| end.1);
                for (end, name) in ends {
                    steps.add("draws.fill.span-end", &name, &was, |lines| {
                        if let LineDraws::Fill(fill) = &mut lines.draws {
                            fill.span_end = end;
                        }
                    });
                }
                let rows = [
                    (MiddleRow::Upper, "upper"),
                    (MiddleRow::Lower, "lower"),
                    (MiddleRow::Both, "both"),
                    (MiddleRow::BothAhead, "both-ahead"),
                ];
                let was = rows.iter().find(|(row, _)| *row == fill.middle).map_or("", |row| row.1);
                for (row, name) in rows {
                    steps.add("draws.fill.middle", &name, &was, |lines| {
                        if let LineDraws::Fill(fill) = &mut lines.draws {
                            fill.middle = row;
                        }
                    });
                }
                let text = |sort: &[[u8; 2]]| format!("{sort:?}");
                for sort in
                    [[[0, 1], [1, 2], [0, 1]], [[1, 2], [0, 1], [1, 2]], [[0, 2], [0, 1], [1, 2]]]
                {
                    steps.add("draws.fill.sort", &text(&sort), &text(&fill.sort), |lines| {
                        if let LineDraws::Fill(fill) = &mut lines.draws {
                            fill.sort = sort.to_vec();
                        }
                    });
                }
            }
            LineDraws::Fan(fan) => {
                for change in word_changes(&fan.pace) {
                    let Change { field, got, was, part } = change.of("draws.fan.pace");
                    steps.add(&field, &got, &was, |lines| {
                        if let LineDraws::Fan(fan) = &mut lines.draws {
                            fan.pace = part;
                        }
                    });
                }
                for change in stepper_changes(&fan.edge) {
                    let Change { field, got, was, part } = change.of("draws.fan.edge");
                    steps.add(&field, &got, &was, |lines| {
                        if let LineDraws::Fan(fan) = &mut lines.draws {
                            fan.edge = part;
                        }
                    });
                }
            }
        }
    }
}

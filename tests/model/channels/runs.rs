//! Codes along a run, against those of one sample at a time.

use super::{toy, unit};
use guardbit::bits::Rounding;
use guardbit::case::Words;
use guardbit::dda::Processor;
use guardbit::format::Clamp;
use guardbit::profile::Profile;
use guardbit::value::{Correction, Corrector, InverseRun, Line, ReciprocalConfig, Refine};

/// What a run gives and what each sample by itself does.
fn both(profile: &Profile, over: &[Line], inverse: Line, length: usize) -> [Vec<Vec<i64>>; 2] {
    let channel = &profile.channel[0];
    let corrector = Corrector::new(channel, profile.w.as_ref(), &profile.vertex).unwrap();
    let at = |[start, step]: Line, n: usize| start + step * i128::try_from(n).unwrap();
    let w = corrector.w_read_out();
    let plain = |line: &Line| {
        let code = |n| match w {
            Some(_) => corrector.divided(at(*line, n), at(inverse, n)),
            None => corrector.affine(at(*line, n)),
        };
        (0..length).map(code).collect()
    };
    let plain: Vec<Vec<i64>> = over.iter().map(plain).collect();
    let mut quick = vec![vec![0; length]; over.len()];
    for processor in Processor::available() {
        if let Some(w) = w {
            let mut run = InverseRun::default();
            run.begin(processor, w, inverse, length);
            corrector.divided_run(processor, over, &mut run, &mut quick);
        } else {
            let lines = over.iter().zip(&mut quick);
            lines.for_each(|(line, out)| corrector.affine_run(processor, *line, out));
        }
        assert_eq!(quick, plain, "{}: {over:?} over {inverse:?}", processor.name());
    }
    [quick, plain]
}

/// Clauses CH-2 and CH-5: every pair of accumulators of a toy, under every rounding: ties, ends and wraps.
#[test]
fn every_pair_of_a_toy_is_divided_as_one_sample_is() {
    let mut profile = toy();
    let w = profile.w.as_mut().unwrap();
    (w.integer, w.interpolation) = (3, 1);
    for rounding in Rounding::ALL {
        for signed in [false, true] {
            let channel = &mut profile.channel[0];
            (channel.integer, channel.interpolation, channel.signed) = (3, 2, signed);
            channel.correction = Correction::Quotient { rounding };
            for inverse in 0..32 {
                // A guard bit above five bits: once around the word, and on.
                both(&profile, &[[-32, 1], [40, -1], [inverse, 0]], [inverse, 0], 80);
            }
        }
    }
}

fn correction(words: &mut Words) -> Correction {
    let rounding = Rounding::ALL[usize::try_from(words.below(10)).unwrap()];
    match words.below(4) {
        0 => Correction::Affine,
        1 => Correction::ConstantW { rounding },
        2 => Correction::Quotient { rounding },
        _ => {
            let refine = match words.below(3) {
                0 => Refine::None,
                1 => Refine::Linear,
                _ => Refine::Newton { bits: vec![12, 20] },
            };
            let operand = 8 + u32::try_from(words.below(24)).unwrap();
            let unit = ReciprocalConfig { operand, refine, ..unit() };
            Correction::Reciprocal { unit, rounding }
        }
    }
}

/// Clauses CH-3, CH-4 and CH-5, in any words that a profile may have.
#[test]
fn runs_are_their_samples() {
    let mut wide = 0;
    for number in 0..3000 {
        let mut words = Words::new(15, 40, number);
        let mut below = |n: u64| u32::try_from(words.below(n)).unwrap();
        let mut profile = toy();
        let w = profile.w.as_mut().unwrap();
        (w.guard, w.integer, w.interpolation) = (below(3), 1 + below(24), below(20));
        let channel = &mut profile.channel[0];
        (channel.guard, channel.integer) = (below(3), 1 + below(32));
        channel.interpolation = below(30);
        channel.signed = below(2) == 1;
        channel.clamp = [Clamp::Guard, Clamp::Sign, Clamp::Wrap][below(3) as usize];
        channel.correction = correction(&mut words);
        if !channel.correction.needs_w() {
            profile.w = None;
        }
        if profile.validate().is_err() {
            continue;
        }
        let channel = &profile.channel[0];
        let bits = channel.guard + channel.integer + channel.interpolation;
        wide += u32::from(bits > 52);
        let mut word = |bits: u32| i128::from(words.below(1 << bits.min(60))) - (1 << bits >> 2);
        let lines = [0, 1, 2].map(|_| [word(bits), word(bits.saturating_sub(5))]);
        let inverse = profile.w.map_or([1, 0], |w| {
            let bits = w.integer + w.interpolation;
            [word(bits).abs(), word(bits.saturating_sub(4))]
        });
        both(&profile, &lines, inverse, 1 + usize::try_from(number % 70).unwrap());
    }
    assert!(wide > 20, "{wide} of more bits than a fraction in floating point");
}

/// Clause CH-5: a colour that is the same everywhere stays the same under every rounding.
#[test]
fn one_code_divided_by_any_w_is_itself() {
    let mut profile = toy();
    for rounding in Rounding::ALL {
        profile.channel[0].correction = Correction::Quotient { rounding };
        let (fraction, below) =
            (profile.channel[0].interpolation, 5 + profile.w.unwrap().interpolation);
        for code in 1..15 {
            // q as the plane has it, and code q / 2^5 with its own fraction.
            let inverse = [3 << (below - 5), 1 << (below - 5)];
            let over = inverse.map(|q: i128| (q * code) << fraction >> below);
            let [quick, _] = both(&profile, &[over], inverse, 20);
            assert_eq!(quick[0], [i64::try_from(code).unwrap(); 20], "{rounding}");
        }
    }
}

//! A sample of the problems whose nature is known by construction; `examples/constructed.rs` judges any number of them.

#[path = "support/constructed/mod.rs"]
mod constructed;

use constructed::{Fault, Nature, Tally, construct};

/// Flat points whose fall only a multiplier that may be 0 explained, and strict minima with weak limits of functions that fall
/// without end elsewhere; and one that falls by a fourth power beside a direction that hardly bends.
const MORE: [u64; 5] = [78303, 900_821, 77571, 78755, 15457];

#[test]
fn no_point_is_certified_that_is_no_minimum_and_strict_minima_are() {
    let mut tally = Tally::default();
    for seed in (1..=3000).chain(MORE) {
        tally.add(&construct(seed, 3));
    }
    assert!(tally.calls > 10_000 && tally.minima.0 > 1000 && tally.compared > 2500);
    assert_eq!(tally.count(Fault::Error), 0);
    for fault in [Fault::WronglyCertified, Fault::TestsDisagree] {
        let found: Vec<_> = tally.faults.iter().filter(|found| found.0 == fault).collect();
        assert!(found.is_empty(), "{fault:?}: {found:?}");
    }
    // A strict minimum beside a lower place, along a direction that hardly bends, may be refused: one in a thousand at the most.
    let missed: Vec<_> = tally.faults.iter().filter(|found| found.0 == Fault::MinimumNotCertified).collect();
    assert!(1000 * missed.len() <= tally.minima.0, "{missed:?} of {}", tally.minima.0);
}

#[test]
fn every_nature_is_among_them() {
    let natures: Vec<Nature> = (1..=800).map(|seed| construct(seed, 0).nature).collect();
    for nature in [Nature::StrictMinimum, Nature::DegenerateMinimum, Nature::DegenerateNoMinimum, Nature::Saddle] {
        assert!(natures.contains(&nature), "{nature:?}");
    }
    assert!((1..=5).all(|face| natures.contains(&Nature::FallsOnFace(face))));
    assert!((0..8).all(|power| natures.contains(&Nature::Infeasible(-power))));
    assert!(natures.contains(&Nature::Maximum) && natures.contains(&Nature::Unbounded));
}

//! Reading: from the file to the assembled model with its sparsity patterns.

mod support;

use divan::Bencher;
use divan::counter::ItemsCount;

fn main() {
    divan::main();
}

#[divan::bench(args = support::problems())]
fn shipped(bencher: Bencher, file: &str) {
    bencher.bench(|| support::read(file));
}

#[divan::bench(args = [1_000, 10_000], sample_count = 5)]
fn rectangles_from_tables(bencher: Bencher, ribs: usize) {
    let (_folder, path) = support::row_of_ribs(ribs, support::RECTANGLE);
    bencher.counter(ItemsCount::new(ribs)).bench(|| support::read(&path));
}

#[divan::bench(args = [1_000, 10_000], sample_count = 5)]
fn h_beams_from_tables(bencher: Bencher, ribs: usize) {
    let (_folder, path) = support::row_of_ribs(ribs, support::H_BEAM);
    bencher.counter(ItemsCount::new(ribs)).bench(|| support::read(&path));
}

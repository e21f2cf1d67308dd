//! Volume with gradient, and the Hessian of the Lagrangian, per rib.

mod support;

use divan::Bencher;
use divan::counter::ItemsCount;
use ribopt::model::Model;
use support::Kind;

const RIBS: [usize; 2] = [1_000, 100_000];

fn main() {
    divan::main();
}

#[divan::bench(args = RIBS)]
fn gradient_rectangles(bencher: Bencher, ribs: usize) {
    gradient(bencher, ribs, support::RECTANGLE);
}

#[divan::bench(args = RIBS)]
fn gradient_h_beams(bencher: Bencher, ribs: usize) {
    gradient(bencher, ribs, support::H_BEAM);
}

#[divan::bench(args = RIBS)]
fn hessian_rectangles(bencher: Bencher, ribs: usize) {
    hessian(bencher, ribs, support::RECTANGLE);
}

#[divan::bench(args = RIBS)]
fn hessian_h_beams(bencher: Bencher, ribs: usize) {
    hessian(bencher, ribs, support::H_BEAM);
}

fn gradient(bencher: Bencher, ribs: usize, kind: Kind) {
    measured(bencher, ribs, kind, |model, values| {
        let start = &model.meta().start;
        values.resize(start.len(), 0.0);
        model.gradient(start, values).expect("a volume at the start");
    });
}

fn hessian(bencher: Bencher, ribs: usize, kind: Kind) {
    let multipliers = vec![1.0; ribs + 1];
    measured(bencher, ribs, kind, |model, values| {
        values.resize(model.meta().hessian.len(), 0.0);
        model.hessian(&model.meta().start, 1.0, &multipliers, values).expect("a Hessian at the start");
    });
}

fn measured(bencher: Bencher, ribs: usize, kind: Kind, evaluate: impl Fn(&dyn Model, &mut Vec<f64>)) {
    let (_folder, path) = support::row_of_ribs(ribs, kind);
    let subject = support::read(path);
    let mut values = Vec::new();
    bencher.counter(ItemsCount::new(ribs)).bench_local(|| evaluate(subject.model(), &mut values));
}

//! Volume with gradient, and the Hessian of the Lagrangian, per rib; for a million ribs as a share of the memory's bandwidth.

mod support;

use std::time::Instant;

use divan::Bencher;
use divan::counter::ItemsCount;
use rayon::prelude::*;
use ribopt::model::Model;
use support::Kind;

const RIBS: [usize; 2] = [1_000, 100_000];

fn main() {
    divan::main();
    // `cargo test` builds benches too and runs them with --test: nothing to measure then.
    if std::env::args().any(|argument| argument == "--bench") {
        bandwidth();
    }
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

/// A million rectangular ribs in a row against a triad a = b + s·c over arrays far larger than all caches, as in STREAM:
/// both on all cores, least time of many, bytes that are stored and read by the algorithm (nothing for write-allocation).
fn bandwidth() {
    const MILLION: usize = 1_000_000;
    let (_folder, path) = support::row_of_ribs(MILLION, support::RECTANGLE);
    let subject = support::read(path);
    let (model, meta) = (subject.model(), subject.model().meta());
    let (n, doubles) = (meta.variables(), size_of::<f64>());
    let (mut gradient, mut hessian, idle) = (vec![0.0; n], vec![0.0; meta.hessian.len()], vec![0.0; meta.rows()]);
    let mut triad = Triad::new(1 << 22);
    let [once, first, second] = least([
        &mut || triad.run(),
        &mut || assert!(model.gradient(&meta.start, &mut gradient).expect("a volume at the start") > 0.0),
        &mut || model.hessian(&meta.start, 1.0, &idle, &mut hessian).expect("a Hessian at the start"),
    ]);
    let rate = triad.bytes() as f64 / once;
    // Four variables' numbers and a length per rib; x and ∇f once.
    let of_gradient = MILLION * (4 * size_of::<u32>() + doubles) + 2 * n * doubles;
    println!("\ntriad {:.1} GB/s on {} threads", rate / 1e9, rayon::current_num_threads());
    shown("volume + gradient", MILLION, of_gradient, first, rate);
    // Besides, ten positions per rib, a weight, a row number and a multiplier per idle row, and the values once.
    let of_hessian = MILLION * (14 * size_of::<u32>() + doubles) + n * doubles + meta.hessian.len() * doubles;
    let of_rows = meta.rows() * (size_of::<u32>() + 2 * doubles);
    shown("volume + gradient + Hessian", MILLION, of_gradient + of_hessian + of_rows, first + second, rate);
}

fn shown(what: &str, ribs: usize, bytes: usize, seconds: f64, triad: f64) {
    let (nanoseconds, rate) = (1e9 * seconds / ribs as f64, bytes as f64 / seconds);
    let share = 100.0 * rate / triad;
    println!("{what}: {nanoseconds:.2} ns and {} bytes per rib, {:.1} GB/s, {share:.0} % of the triad", bytes / ribs, rate / 1e9);
}

/// Three arrays and what is done to them.
struct Triad {
    a: Vec<f64>,
    b: Vec<f64>,
    c: Vec<f64>,
}

impl Triad {
    fn new(length: usize) -> Triad {
        Triad { a: vec![0.0; length], b: vec![1.0; length], c: vec![2.0; length] }
    }

    fn bytes(&self) -> usize {
        3 * size_of_val(&*self.a)
    }

    fn run(&mut self) {
        const CHUNK: usize = 1 << 14;
        let Triad { a, b, c } = self;
        a.par_chunks_mut(CHUNK).zip(b.par_chunks(CHUNK).zip(c.par_chunks(CHUNK))).for_each(|(a, (b, c))| {
            a.iter_mut().zip(b.iter().zip(c)).for_each(|(a, (b, c))| *a = b + 3.0 * c);
        });
        assert_eq!(a.last(), Some(&7.0));
    }
}

/// The least of many times of each, in seconds. They take turns, so that what else the machine does slows all alike, and none
/// finds in the caches what it left there.
fn least<const N: usize>(mut works: [&mut dyn FnMut(); N]) -> [f64; N] {
    let mut least = [f64::INFINITY; N];
    for _ in 0..200 {
        for (least, work) in least.iter_mut().zip(&mut works) {
            let begun = Instant::now();
            work();
            *least = least.min(begun.elapsed().as_secs_f64());
        }
    }
    least
}

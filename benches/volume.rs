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
    let triad = triad(1 << 22);
    let (_folder, path) = support::row_of_ribs(MILLION, support::RECTANGLE);
    let subject = support::read(path);
    let (model, meta) = (subject.model(), subject.model().meta());
    let (n, doubles) = (meta.variables(), size_of::<f64>());
    let mut gradient = vec![0.0; n];
    let seconds = least(|| {
        model.gradient(&meta.start, &mut gradient).expect("a volume at the start");
    });
    // Four variables' numbers and a length per rib; x and ∇f once.
    let of_gradient = MILLION * (4 * size_of::<u32>() + doubles) + 2 * n * doubles;
    println!("\ntriad {:.1} GB/s on {} threads", triad / 1e9, rayon::current_num_threads());
    shown("volume + gradient", MILLION, of_gradient, seconds, triad);
    let (mut hessian, idle) = (vec![0.0; meta.hessian.len()], vec![0.0; meta.rows()]);
    let more = least(|| model.hessian(&meta.start, 1.0, &idle, &mut hessian).expect("a Hessian at the start"));
    // Besides, ten positions per rib, a row number and a multiplier per idle row, and the values once.
    let of_hessian = MILLION * (14 * size_of::<u32>() + doubles) + n * doubles + meta.hessian.len() * doubles;
    let of_rows = meta.rows() * (size_of::<u32>() + 2 * doubles);
    shown("volume + gradient + Hessian", MILLION, of_gradient + of_hessian + of_rows, seconds + more, triad);
}

fn shown(what: &str, ribs: usize, bytes: usize, seconds: f64, triad: f64) {
    let (nanoseconds, rate) = (1e9 * seconds / ribs as f64, bytes as f64 / seconds);
    let share = 100.0 * rate / triad;
    println!("{what}: {nanoseconds:.2} ns and {} bytes per rib, {:.1} GB/s, {share:.0} % of the triad", bytes / ribs, rate / 1e9);
}

/// Bytes per second.
fn triad(length: usize) -> f64 {
    const CHUNK: usize = 1 << 14;
    let (mut a, b, c) = (vec![0.0_f64; length], vec![1.0_f64; length], vec![2.0_f64; length]);
    let seconds = least(|| {
        a.par_chunks_mut(CHUNK).zip(b.par_chunks(CHUNK).zip(c.par_chunks(CHUNK))).for_each(|(a, (b, c))| {
            a.iter_mut().zip(b.iter().zip(c)).for_each(|(a, (b, c))| *a = b + 3.0 * c);
        });
    });
    assert!(a.iter().all(|&a| a == 7.0));
    (3 * length * size_of::<f64>()) as f64 / seconds
}

/// The least of many times, in seconds.
fn least(mut work: impl FnMut()) -> f64 {
    let once = |_| {
        let begun = Instant::now();
        work();
        begun.elapsed().as_secs_f64()
    };
    (0..200).map(once).fold(f64::INFINITY, f64::min)
}

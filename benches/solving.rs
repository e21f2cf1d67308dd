//! One certified solve of each shipped problem by each backend, from the assembled model to the verdict.

mod support;

use std::fmt;

use divan::Bencher;
use ribopt::backends::Iteration;
use ribopt::crosscheck::{self, Task};
use ribopt::run::choice::built_in;

fn main() {
    divan::main();
}

#[derive(Clone, Copy)]
struct Solve {
    backend: usize,
    file: &'static str,
}

impl fmt::Display for Solve {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "{} {}", built_in()[self.backend].name(), self.file)
    }
}

fn solves() -> Vec<Solve> {
    let of_one = |backend| support::problems().into_iter().map(move |file| Solve { backend, file });
    (0..built_in().len()).flat_map(of_one).collect()
}

#[divan::bench(args = solves(), sample_count = 20, sample_size = 1, max_time = 2)]
fn problem(bencher: Bencher, solve: Solve) {
    let subject = support::read(solve.file);
    let task = Task {
        model: subject.model(),
        substitution: subject.substitution(),
        class: subject.class(),
        settings: &subject.settings,
        start: &subject.model().meta().start,
        start_multipliers: None,
        starts: 1,
        interrupt: None,
    };
    let backends = [(built_in()[solve.backend], "auto")];
    bencher.bench_local(|| {
        let mut unobserved = |_: usize, _: &str| -> Box<dyn FnMut(&Iteration<'_>)> { Box::new(|_: &Iteration<'_>| {}) };
        crosscheck::run(&task, &backends, &mut unobserved)
    });
}

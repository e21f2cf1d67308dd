//! Any number of metamorphic tests: problem files rewritten such that the verdict must stay (docs/testing.md).
//!
//! `cargo run --release --example metamorphic -- problems tests/extra --seed 1 --count 200`

mod campaign;

use std::path::PathBuf;
use std::process::ExitCode;

use campaign::judge::Grade;
use campaign::kinds::{KINDS, MIXED};
use campaign::{Plan, report};
use clap::Parser;

/// Rewrites problem files such that the verdict must stay, solves them and prints what changed.
#[derive(Parser)]
struct Arguments {
    /// Folders of problem files.
    #[arg(required = true)]
    folders: Vec<PathBuf>,
    /// Decides, with a run's number, what is done in it.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// How many runs.
    #[arg(long, default_value_t = 200)]
    count: usize,
    /// The number of the first run, to repeat or to go on.
    #[arg(long, default_value_t = 0)]
    first: usize,
    /// One kind of transformation.
    #[arg(long, value_parser = kind)]
    only: Option<String>,
    /// Runs at the same time.
    #[arg(long, default_value_t = 2)]
    jobs: usize,
    /// Limit of one run.
    #[arg(long, default_value_t = 10.0)]
    max_seconds: f64,
    /// Where the files of findings are kept.
    #[arg(long)]
    keep: Option<PathBuf>,
    /// Leaves out files whose path contains this.
    #[arg(long)]
    without: Vec<String>,
}

fn kind(name: &str) -> Result<String, String> {
    let names: Vec<&str> = KINDS.iter().map(|kind| kind.name).chain([MIXED]).collect();
    if names.contains(&name) { Ok(name.into()) } else { Err(format!("the kinds are {}", names.join(", "))) }
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let plan = Plan {
        folders: arguments.folders,
        seed: arguments.seed,
        first: arguments.first,
        count: arguments.count,
        only: arguments.only,
        jobs: arguments.jobs,
        seconds: arguments.max_seconds,
        folder: arguments.keep.unwrap_or_else(|| std::env::temp_dir().join(format!("metamorphic-{}", std::process::id()))),
        without: arguments.without,
        quiet: false,
    };
    match campaign::run(&plan) {
        Err(why) => {
            eprintln!("{why}");
            ExitCode::from(2)
        }
        Ok(found) => {
            print!("{}", report::text(&found));
            let grave = found.count(Grade::WronglyCertified) + found.count(Grade::WronglyInfeasible);
            ExitCode::from(u8::from(grave > 0))
        }
    }
}

//! Certificates of problems whose nature is known by construction:
//! `cargo run --release --example constructed -- --seed S --count N [--near K] [--out FOLDER] [--only SEED]`.
//!
//! Prints how many points were judged and what was wrong; problem files of the offenders go to FOLDER.

use std::error::Error;
use std::fs;
use std::path::PathBuf;
use std::time::Instant;

#[path = "../tests/support/constructed/mod.rs"]
mod constructed;

use constructed::{Constructed, Fault, Tally, construct};
use ribopt::certificate::{Certifier, Tolerances};
use ribopt::model::Class;

fn main() -> Result<(), Box<dyn Error>> {
    let (mut seed, mut count, mut near, mut out) = (1u64, 1000u64, 3usize, None::<PathBuf>);
    let mut arguments = std::env::args().skip(1);
    while let Some(name) = arguments.next() {
        let value = arguments.next().ok_or_else(|| format!("{name} needs a value"))?;
        match name.as_str() {
            "--seed" => seed = value.parse()?,
            "--count" => count = value.parse()?,
            "--near" => near = value.parse()?,
            "--out" => out = Some(value.into()),
            "--only" => (seed, count) = (value.parse()?, 1),
            _ => return Err(format!("{name} is no option").into()),
        }
    }
    let (began, mut tally) = (Instant::now(), Tally::default());
    for one in seed..seed + count {
        tally.add(&construct(one, near));
    }
    let share = |(all, good): (usize, usize)| 100.0 * good as f64 / all.max(1) as f64;
    println!("{} points of {count} problems in {:.1} s", tally.calls, began.elapsed().as_secs_f64());
    println!("wrongly certified: {}", tally.count(Fault::WronglyCertified));
    println!("strict minima certified: {:.3} % of {}", share(tally.minima), tally.minima.0);
    println!("degenerate minima certified: {:.2} % of {}", share(tally.degenerate), tally.degenerate.0);
    println!("second-order tests disagree: {} of {}", tally.count(Fault::TestsDisagree), tally.compared);
    println!("no value: {}", tally.count(Fault::Error));
    tally.faults.sort_by_key(|fault| (fault.0, fault.1, fault.2));
    for (fault, seed, at, nature) in &tally.faults {
        println!("{fault:?}: seed {seed}, point {at}, {nature:?}");
        explain(&construct(*seed, near), *at)?;
        if let Some(folder) = &out {
            let all = construct(*seed, near);
            fs::create_dir_all(folder)?;
            let remark = format!("{fault:?}: seed {seed}, point {at} (0: x*), {nature:?}");
            fs::write(folder.join(format!("{seed}-{at}.toml")), all.problem.toml(&all.points[*at], &remark))?;
        }
    }
    Ok(())
}

/// What the certificate says of a point.
fn explain(all: &Constructed, at: usize) -> Result<(), Box<dyn Error>> {
    let found = Certifier::new(&all.problem, Class::Nonlinear, Tolerances::default()).certify(&all.points[at], None)?;
    let (primal, dual, gap) = (found.primal_infeasibility, found.dual_infeasibility, found.complementarity);
    println!("  primal {primal:.1e}, dual {dual:.1e}, complementarity {gap:.1e}, flat {}", found.minimiser_may_not_be_unique);
    println!("  sigma {:.1e}, sizes {:.2?}", found.sigma, found.variable_scales);
    println!("  rows {:?}, bounds {:?}", found.row_sides, found.bound_sides);
    let short = |values: &[f64]| values.iter().map(|value| format!("{value:.1e}")).collect::<Vec<_>>().join(", ");
    println!("  multipliers of rows [{}], of bounds [{}]", short(&found.row_multipliers), short(&found.bound_multipliers));
    found.messages.iter().for_each(|text| println!("  {text}"));
    Ok(())
}

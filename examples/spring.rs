//! A coil spring and a curve through data: the library used without ribs, once by formulas and once by closures.
//! `cargo run --release --example spring`

use ribopt::model::closures::{Closures, Function};
use ribopt::{Problem, Value};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    lightest_spring()?;
    decay_through_points()
}

/// The lightest compression spring (Arora, *Introduction to Optimum Design*, §2.9): wire d, coil D, n active coils.
fn lightest_spring() -> Result<(), ribopt::Error> {
    let spring = Problem::new("Compression spring")
        .variable("d", Value::from(0.05..=0.20).start(0.1))
        .variable("D", Value::from(0.25..=1.30).start(0.5))
        .variable("n", Value::from(2.0..=15.0).start(10.0))
        .minimize("(n + 2)*D*d^2")
        .require("deflection", "D^3*n/(71785*d^4) >= 1")
        .require("shear", "(4*D^2 - D*d)/(12566*(D*d^3 - d^4)) + 1/(5108*d^2) <= 1")
        .require("surge", "140.45*d/(D^2*n) >= 1")
        .require("diameter", "(D + d)/1.5 <= 1");
    let answer = spring.solve()?;
    println!("{}", answer.message());
    for (name, value) in answer.values() {
        println!("{name} = {value:.6}");
    }
    for row in ["deflection", "shear", "surge", "diameter"] {
        println!("multiplier of {row}: {:.4}", answer.multiplier(row).unwrap_or(f64::NAN));
    }
    Ok(())
}

/// y = a·exp(−k·t) through four points, by least squares: objective and derivatives as closures.
fn decay_through_points() -> Result<(), Box<dyn std::error::Error>> {
    const POINTS: [(f64, f64); 4] = [(0.0, 2.1), (1.0, 1.2), (2.0, 0.8), (3.0, 0.4)];
    let squares = |x: &[f64]| POINTS.iter().map(|(t, y)| (x[0] * (-x[1] * t).exp() - y).powi(2)).sum::<f64>();
    let gradient = |x: &[f64], out: &mut [f64]| {
        for (t, y) in POINTS {
            let decay = (-x[1] * t).exp();
            let residual = x[0] * decay - y;
            out[0] += 2.0 * residual * decay;
            out[1] -= 2.0 * residual * x[0] * t * decay;
        }
    };
    let hessian = |x: &[f64], out: &mut [f64]| {
        for (t, y) in POINTS {
            let decay = (-x[1] * t).exp();
            let residual = x[0] * decay - y;
            out[0] += 2.0 * decay * decay;
            out[1] -= 2.0 * t * decay * (x[0] * decay + residual);
            out[2] += 2.0 * x[0] * t * t * decay * (x[0] * decay + residual);
        }
    };
    let model = Closures::new(&["a", "k"], &[1.0, 1.0], &[0.0, 0.0], &[10.0, 10.0])
        .minimise(Function::dense(2, squares, gradient, hessian));
    let outcome = ribopt::solve(&model, &Default::default())?;
    println!("{} a = {:.4}, k = {:.4}", outcome.message, outcome.x[0], outcome.x[1]);
    Ok(())
}

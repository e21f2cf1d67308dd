//! Cuts: their values, and their derivatives against differences.

use super::clusters::clusters;
use super::*;
use crate::model::derivative_check::derivative_check;
use crate::problem::modes::{Level, eigenvalues};

/// A column in space, clamped at both ends, of six pieces whose stiffnesses about the two axes differ by 0.4 %, every second one turned: its two
/// lowest factors are as near, whatever the design, and their modes couple.
fn column(objective: &str, row: &str) -> Subject {
    let mut text =
        format!("{objective}\n[structure]\nbuckling_pieces = 1\n[materials]\ns = {{ E = 12, nu = 0.3 }}\n[variables]\n");
    for (at, area) in [1.2, 1.0, 0.8].iter().enumerate() {
        text += &format!("A{at} = {{ lower = 0.01, start = {area} }}\n");
    }
    text += "[nodes]\n";
    (0..=6).for_each(|at| text += &format!("n{at} = [0, 0, {}]\n", f64::from(at) / 6.0));
    text += "[supports]\nn0 = \"fixed\"\nn6 = [\"x\", \"y\", \"rx\", \"ry\", \"rz\"]\n";
    for at in 0..6 {
        let (area, roll) = ([0, 1, 2, 2, 1, 0][at], 30 * (at % 2));
        text += &format!(
            "[sections.s{at}]\nkind = \"general\"\nA = \"A{area}\"\nIx = \"A{area}^2/12\"\nIy = \"1.004*A{area}^2/12\"\nJ = 10\n"
        );
        text += &format!(
            "[[ribs]]\nname = \"m{at}\"\nstart = \"n{at}\"\nend = \"n{}\"\nsection = \"s{at}\"\nroll = {roll}\n",
            at + 1
        );
    }
    text += &format!(
        "[[loads]]\ncase = \"P\"\nnodes = [\"n6\"]\nforce = [0, 0, -1]\n[[constraints]]\nname = \"row\"\nrequire = \"{row}\"\n"
    );
    Subject::of_text("column", &text).unwrap_or_else(|error| panic!("{error}"))
}

fn refined_at_start(subject: &Subject, near: f64) -> Subject {
    let x = subject.shown().meta().start.clone();
    let found = clusters(subject, &x).unwrap();
    assert_eq!(found.len(), 1, "nothing comes together at {near}");
    refined_by(subject, &found, &mut Cuts::new()).unwrap()
}

fn lowest(subject: &Subject, x: &[f64]) -> f64 {
    let model = subject.analysis().unwrap();
    let values = model.lifted().modes().unwrap().values(&model.solved(x).unwrap()).unwrap();
    values.into_iter().fold(f64::INFINITY, f64::min)
}

#[test]
fn cuts_at_themselves_are_the_eigenvalues_where_they_were_taken_and_above_the_lowest_elsewhere() {
    let subject = column("maximize = \"buckling(P)\"", "volume <= 1");
    let x = subject.shown().meta().start.clone();
    let refined = refined_at_start(&subject, lowest(&subject, &x));
    assert!(refined.problem().cuts.iter().all(|cut| matches!(cut.level, Level::Itself(_))));
    assert!((lowest(&refined, &x) / lowest(&subject, &x) - 1.0).abs() < 1e-12);
    for shift in [[0.01, 0.0, 0.0, -0.01], [-0.02, 0.01, 0.0, 0.01], [0.0, 0.0, 0.03, 0.0]] {
        let moved: Vec<f64> = x.iter().zip(shift).map(|(x, by)| x + by).collect();
        let (cut, own) = (lowest(&refined, &moved), lowest(&subject, &moved));
        assert!(cut >= own * (1.0 - 1e-12) && cut < 1.05 * own, "{cut} {own}");
    }
}

#[test]
fn derivatives_of_cuts_agree_with_differences() {
    for (objective, row) in [
        ("maximize = \"buckling(P)\"", "volume <= 1"),
        ("minimize = \"volume\"", "buckling(P) >= 3*A0 + 20"),
        ("minimize = \"volume\"", "buckling(P) >= LIMIT"),
    ] {
        let free = column("maximize = \"buckling(P)\"", "volume <= 1");
        let near = lowest(&free, &free.shown().meta().start);
        let refined = refined_at_start(&column(objective, &row.replace("LIMIT", &format!("{near:?}"))), near);
        assert!(eigenvalues(refined.problem()).len() >= 4, "{:?}", eigenvalues(refined.problem()));
        let model = refined.model();
        for scale in [1.0, 1.01] {
            let x: Vec<f64> = model.meta().start.iter().map(|x| scale * x).collect();
            let check = derivative_check(model, &x).unwrap();
            assert!(check.compared > 10 && check.disagreements == 0, "{objective}, {row}: {:?}", check.worst);
        }
    }
}

/// Two bars at right angles hold a mass, turned by 30°: with equal areas both frequencies are the same, and the two modes any pair of directions.
fn cross() -> Subject {
    let (c, s) = (30f64.to_radians().cos(), 30f64.to_radians().sin());
    let text = format!(
        "maximize = \"frequency(1)\"\n[structure]\nplane = \"xy\"\njoints = \"pinned\"\n[materials]\ns = {{ E = 7e10, density = 2700 }}\n[masses]\no = 450\n\
         [nodes]\no = [0, 0]\na = [{c}, {s}]\nb = [{}, {c}]\n[supports]\na = \"pinned\"\nb = \"pinned\"\n\
         [sections.p]\nkind = \"general\"\nA = {{ lower = 1e-6, start = 1e-3 }}\n[sections.q]\nkind = \"general\"\nA = {{ lower = 1e-6, start = 1e-3 }}\n\
         [[ribs]]\nname = \"rp\"\nstart = \"o\"\nend = \"a\"\nsection = \"p\"\n[[ribs]]\nname = \"rq\"\nstart = \"o\"\nend = \"b\"\nsection = \"q\"\n",
        -s
    );
    Subject::of_text("cross", &text).unwrap_or_else(|error| panic!("{error}"))
}

/// The lowest of coinciding eigenvalues falls along a direction by the lowest eigenvalue of the matrix that the slopes of its cuts make.
#[test]
fn slopes_of_cuts_make_the_directional_derivative_of_a_double_eigenvalue() {
    let subject = cross();
    let x = subject.shown().meta().start.clone();
    let refined = refined_at_start(&subject, lowest(&subject, &x));
    let model = refined.analysis().unwrap();
    let cuts = |x: &[f64]| model.lifted().modes().unwrap().values(&model.solved(x).unwrap()).unwrap();
    assert_eq!(cuts(&x).len(), 4, "two modes, their sum and their difference");
    let step = 1e-9;
    for direction in [[1.0, 0.0], [0.0, 1.0], [1.0, -1.0], [0.6, 0.8], [-0.6, -0.1]] {
        let moved = |by: f64| -> Vec<f64> { x.iter().zip(direction).map(|(x, d)| x + by * d).collect() };
        let slopes: Vec<f64> =
            cuts(&moved(step)).iter().zip(cuts(&moved(-step))).map(|(up, down)| (up - down) / (2.0 * step)).collect();
        let (first, second, mixed) = (slopes[0], slopes[1], 0.5 * (slopes[2] - slopes[3]));
        let least = 0.5 * (first + second) - (0.5 * (first - second)).hypot(mixed);
        let difference = (lowest(&subject, &moved(step)) - lowest(&subject, &x)) / step;
        let size = slopes.iter().fold(0.0_f64, |most, slope| most.max(slope.abs()));
        assert!((least - difference).abs() < 1e-5 * size, "{direction:?}: {least} {difference}");
    }
}

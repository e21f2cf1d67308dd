use super::*;

fn matrix(order: usize, rows: &[f64]) -> Matrix {
    let lower = (0..order).flat_map(|i| (0..=i).map(move |j| (i, j)));
    let entries: Vec<_> = lower.map(|(i, j)| (i as u32, j as u32, rows[i * order + j])).collect();
    Matrix::of(order, &entries)
}

#[test]
fn vectors_solve_the_pencil_and_are_normal() {
    let k = matrix(3, &[4.0, 1.0, 0.0, 1.0, 3.0, 0.5, 0.0, 0.5, 2e6]);
    let b = matrix(3, &[1.0, -0.3, 0.2, -0.3, 0.5, 0.1, 0.2, 0.1, -1.0]);
    let found = spectrum(&k, &b, 3).unwrap();
    assert_eq!(found.values.len(), 2);
    for (mu, phi) in found.values.iter().zip(&found.vectors) {
        let (left, right) = (b.times(phi), k.times(phi));
        assert!((dot(phi, &right) - 1.0).abs() < 1e-13);
        assert!(left.iter().zip(&right).all(|(left, right)| (left - mu * right).abs() < 1e-12));
    }
    assert!(found.values.is_sorted_by(|a, b| a >= b));
}

/// Chains of springs beside one another: every eigenvalue occurs `chains` times.
fn chains(chains: usize, links: usize) -> Matrix {
    let mut entries = Vec::new();
    for chain in 0..chains {
        for link in 0..links {
            let at = (chain * links + link) as u32;
            entries.push((at, at, 2.0 + 1e-3 * link as f64));
            if link > 0 {
                entries.push((at, at - 1, -1.0));
            }
        }
    }
    Matrix::of(chains * links, &entries)
}

#[test]
fn few_by_sparse_factors_are_those_of_all() {
    let k = chains(7, 60);
    let mut b = Matrix::zeros(std::sync::Arc::clone(&k.pattern));
    let diagonal: Vec<usize> = (0..k.order()).map(|at| k.pattern.position(at, at as u32).unwrap()).collect();
    for (at, &place) in diagonal.iter().enumerate() {
        b.values[place] = if at % 60 < 20 { -3.0 } else { 1.0 + (at % 60) as f64 / 60.0 };
    }
    let all = full::spectrum(&k, &b).unwrap();
    for count in [1, 6, 7, 8, 21] {
        let few = lanczos::spectrum(&k, &b, count).unwrap();
        assert!(few.values.len() >= count && few.values.len().is_multiple_of(7), "{count}: {}", few.values.len());
        for ((few, all), phi) in few.values.iter().zip(&all.values).zip(&few.vectors) {
            assert!((few / all - 1.0).abs() < 1e-13);
            let (left, right) = (b.times(phi), k.times(phi));
            assert!(left.iter().zip(&right).all(|(left, right)| (left - few * right).abs() < 1e-12 * all));
        }
    }
}

/// Of a matrix of rank 2 there are two, of a negative one none.
#[test]
fn there_are_no_more_than_there_are() {
    let k = chains(1, 300);
    let mut b = Matrix::zeros(std::sync::Arc::clone(&k.pattern));
    assert_eq!(lanczos::spectrum(&k, &b, 3).unwrap().values.len(), 0);
    for at in [50u32, 250] {
        let place = b.pattern.position(at as usize, at).unwrap();
        b.values[place] = 0.1 * f64::from(at);
    }
    assert_eq!(lanczos::spectrum(&k, &b, 3).unwrap().values.len(), 2);
    b.values.iter_mut().for_each(|value| *value = -*value);
    assert_eq!(lanczos::spectrum(&k, &b, 3).unwrap().values.len(), 0);
    let mut loose = k.clone();
    loose.values.iter_mut().for_each(|value| *value = -*value);
    assert!(lanczos::spectrum(&loose, &b, 3).is_err() && full::spectrum(&loose, &b).is_err());
}

/// Of diag(1, 2, 5) the part seen over the first two directions is itself.
#[test]
fn complements_see_the_rest() {
    let s = matrix(3, &[1.0, 0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 5.0]);
    let columns = vec![vec![1.0, 0.0, 0.0], vec![0.0, 1.0, 0.0]];
    let complement = Complement::new(&s, &columns, &s).unwrap();
    let stationary = complement.stationary(&[0.6, 0.8]).unwrap();
    assert!(stationary.iter().zip([0.6, 0.8, 0.0]).all(|(own, right)| (own - right).abs() < 1e-15));
    let projected = complement.project(&[1.0, 1.0, 1.0]).unwrap();
    assert!((projected[2] - 0.2).abs() < 1e-15 && projected[0].abs() < 1e-15);
}

//! Factors of small matrices whose inertia and solutions are known.

use super::super::Pattern;
use super::*;

/// The lower triangle of a dense symmetric matrix, zeros left out.
fn sparse(rows: &[&[f64]]) -> (Vec<usize>, Vec<u32>, Vec<f64>) {
    let (mut offsets, mut columns, mut values) = (vec![0], Vec::new(), Vec::new());
    for (i, row) in rows.iter().enumerate() {
        for (j, &value) in row.iter().enumerate().take(i + 1).filter(|(_, value)| **value != 0.0) {
            columns.push(j as u32);
            values.push(value);
        }
        offsets.push(columns.len());
    }
    (offsets, columns, values)
}

#[test]
fn a_kkt_matrix_has_the_inertia_of_its_blocks() {
    let (offsets, columns, values) = sparse(&[&[4.0], &[1.0, 3.0], &[0.0, 0.0, 5.0], &[1.0, 1.0, 1.0, 0.0]]);
    let mut solver = SymmetricSolver::new(&offsets, &columns).unwrap();
    assert_eq!(solver.factor(&values).unwrap(), Inertia { positive: 3, negative: 1, zero: 0 });
    let mut x = vec![0.0; 4];
    solver.solve(&[1.0, 2.0, 3.0, 4.0], &mut x).unwrap();
    let residual = [4.0 * x[0] + x[1] + x[3] - 1.0, x[0] + 3.0 * x[1] + x[3] - 2.0, 5.0 * x[2] + x[3] - 3.0];
    assert!(residual.iter().all(|r| r.abs() < 1e-14), "{residual:?}");
    assert!((x[0] + x[1] + x[2] - 4.0).abs() < 1e-14);
}

#[test]
fn dependent_rows_are_seen_as_zero_eigenvalues_or_singular() {
    let (offsets, columns, values) = sparse(&[&[1.0], &[0.0, 1.0], &[1.0, 1.0, 0.0], &[1.0, 1.0, 0.0, 0.0]]);
    let mut solver = SymmetricSolver::new(&offsets, &columns).unwrap();
    match solver.factor(&values) {
        Ok(inertia) => assert!(inertia.zero >= 1, "{inertia:?}"),
        Err(error) => assert_eq!(error, FactorizationError::Singular),
    }
}

#[test]
fn new_values_replace_the_old_ones() {
    let mut solver = SymmetricSolver::new(&[0, 1, 3], &[0, 0, 1]).unwrap();
    for scale in [1.0, -2.0, 1e-9] {
        solver.factor(&[2.0 * scale, scale, 3.0 * scale]).unwrap();
        let mut x = [0.0; 2];
        solver.solve(&[3.0 * scale, 4.0 * scale], &mut x).unwrap();
        assert!((x[0] - 1.0).abs() < 1e-14 && (x[1] - 1.0).abs() < 1e-14, "{x:?}");
    }
}

#[test]
fn larger_matrices_are_analysed_once() {
    let n = dense::LARGEST_ORDER + 5;
    // An arrow: diagonal and last row.
    let mut offsets: Vec<usize> = (0..n).collect();
    offsets.push(2 * n - 1);
    let columns: Vec<u32> = (0..n as u32 - 1).chain(0..n as u32).collect();
    let mut solver = SymmetricSolver::new(&offsets, &columns).unwrap();
    for scale in [1.0, -3.0, 1e-7] {
        let values: Vec<f64> = (0..2 * n - 1).map(|at| scale * if at < n - 1 { 2.0 } else { 1.0 }).collect();
        let inertia = solver.factor(&values).unwrap();
        let (more, fewer) = (n - 1, 1);
        let expected = if scale > 0.0 { (more, fewer) } else { (fewer, more) };
        assert_eq!((inertia.positive, inertia.negative), expected);
        let right: Vec<f64> = (0..n).map(|i| scale * if i < n - 1 { 3.0 } else { n as f64 }).collect();
        let mut x = vec![0.0; n];
        solver.solve(&right, &mut x).unwrap();
        assert!(x.iter().all(|x| (x - 1.0).abs() < 1e-13), "{x:?}");
    }
    match &solver.method {
        Method::Sparse(sparse) => assert_eq!(sparse.analyses(), 1),
        _ => panic!("order {n} is for the sparse method"),
    }
}

#[test]
fn pivots_as_they_come_serve_quasi_definite_matrices_and_give_way_to_others() {
    let n = dense::LARGEST_ORDER + 1;
    // A chain, every second unknown with the other sign on the diagonal.
    let offsets: Vec<usize> = (0..=n).map(|row| if row == 0 { 0 } else { 2 * row - 1 }).collect();
    let columns: Vec<u32> = (0..n as u32).flat_map(|row| row.saturating_sub(1)..=row).collect();
    let mut solver = SymmetricSolver::for_quasi_definite(&offsets, &columns).unwrap();
    let values = |size: f64| -> Vec<f64> {
        let diagonal = |row: usize| if row.is_multiple_of(2) { size } else { -size };
        (0..2 * n - 1).map(|at| if at % 2 == 0 { diagonal(at / 2) } else { 1.0 }).collect()
    };
    // Without a diagonal the first pivot is missing.
    for size in [2.0, 0.0, 3.0] {
        let mut values = values(size);
        values[2 * n - 2] = 1.0;
        let inertia = solver.factor(&values).unwrap();
        assert_eq!((inertia.positive, inertia.negative), (n - n / 2, n / 2), "{size}");
        let mut x = vec![0.0; n];
        let right: Vec<f64> = (0..n)
            .map(|row| {
                let beside = f64::from(u8::from(row > 0)) + f64::from(u8::from(row + 1 < n));
                beside + values[2 * row]
            })
            .collect();
        solver.solve(&right, &mut x).unwrap();
        assert!(x.iter().all(|x| (x - 1.0).abs() < 1e-12), "{x:?}");
    }
}

#[test]
fn no_number_and_wrong_shapes_are_errors() {
    assert!(matches!(SymmetricSolver::new(&[0, 1], &[1]), Err(FactorizationError::Pattern(_))));
    assert!(matches!(SymmetricSolver::new(&[0, 2, 1], &[0]), Err(FactorizationError::Pattern(_))));
    assert!(matches!(SymmetricSolver::new(&[], &[]), Err(FactorizationError::Pattern(_))));
    let mut solver = SymmetricSolver::new(&[0, 1], &[0]).unwrap();
    assert!(matches!(solver.factor(&[f64::NAN]), Err(FactorizationError::Library(_))));
    assert!(matches!(solver.factor(&[]), Err(FactorizationError::Pattern(_))));
}

#[test]
fn the_empty_matrix_is_fine() {
    let mut solver = SymmetricSolver::new(&[0], &[]).unwrap();
    assert_eq!(solver.factor(&[]).unwrap(), Inertia { positive: 0, negative: 0, zero: 0 });
    solver.solve(&[], &mut []).unwrap();
}

/// Rows that occur twice leave eigenvalues of −δ beside those of one.
#[test]
fn a_certain_inertia_is_that_of_dependent_rows_or_none() {
    let (p, m) = (60, 40);
    let entry = |row: usize, k: usize| 1.0 / (1.0 + ((row % (m / 2)) * 7 + k * 13) as f64 % 11.0);
    let mut positions: Vec<(u32, u32)> = (0..(p + m) as u32).map(|k| (k, k)).collect();
    let columns = |row: usize| (0..6).map(move |k| ((row % (m / 2)) * 3 + 11 * k) % p);
    (0..m).for_each(|row| positions.extend(columns(row).map(|column| ((p + row) as u32, column as u32))));
    let pattern = Pattern::from_positions(p + m, &mut positions);
    let mut solver = SymmetricSolver::new(&pattern.offsets, &pattern.columns).unwrap();
    let values = |dual: f64| -> Vec<f64> {
        let value = |(row, column): (usize, u32)| match row.checked_sub(p) {
            None => 1.0,
            Some(_) if row == column as usize => -dual,
            Some(row) => entry(row, column as usize),
        };
        pattern.iter().map(|(row, column)| value((row, column as u32))).collect()
    };
    for dual in [1e-3, 1e-11] {
        let expected = Inertia { positive: p, negative: m, zero: 0 };
        assert_eq!(solver.certain_inertia(&values(dual), Effort::Any), Ok(expected), "{dual}");
    }
    let singular = solver.certain_inertia(&values(0.0), Effort::Any);
    assert!(matches!(singular, Err(FactorizationError::Uncertain | FactorizationError::Singular)), "{singular:?}");
}

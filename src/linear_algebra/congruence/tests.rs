use super::*;

/// A ring of pairs (p, q): ring elements feel p + q of neighbours only, each pair has a block of its own; two long last rows.
fn ring(pairs: usize, coupled_by: impl Fn(usize) -> f64) -> (Vec<usize>, Vec<u32>, Vec<f64>) {
    let n = 2 * pairs;
    let mut dense = vec![std::collections::BTreeMap::new(); n + 2];
    let mut add = |i: usize, j: usize, value: f64| *dense[i.max(j)].entry(i.min(j) as u32).or_insert(0.0) += value;
    for k in 0..pairs {
        let next = (k + 1) % pairs;
        let (own, other) = ([2 * k, 2 * k + 1], [2 * next, 2 * next + 1]);
        add(own[0], own[0], 4.0);
        add(own[1], own[1], 5.0 + k as f64 / 7.0);
        add(own[0], own[1], 0.5);
        for a in own {
            for b in other {
                add(a, b, -coupled_by(a + b));
            }
        }
        add(n + k % 2, own[0], 0.3);
        add(n + k % 2, own[1], 0.9);
    }
    add(n, n, -1.0);
    add(n + 1, n + 1, -1.0);
    let (mut offsets, mut columns, mut values) = (vec![0], Vec::new(), Vec::new());
    for row in dense {
        for (column, value) in row {
            columns.push(column);
            values.push(value);
        }
        offsets.push(columns.len());
    }
    (offsets, columns, values)
}

fn residual(offsets: &[usize], columns: &[u32], values: &[f64], x: &[f64], right: &[f64]) -> f64 {
    let mut rest = right.to_vec();
    for row in 0..x.len() {
        for at in offsets[row]..offsets[row + 1] {
            let column = columns[at] as usize;
            rest[row] -= values[at] * x[column];
            if column != row {
                rest[column] -= values[at] * x[row];
            }
        }
    }
    rest.iter().fold(0.0, |most: f64, rest| most.max(rest.abs()))
}

#[test]
fn proportional_columns_are_found_and_the_solution_is_that_of_the_plain_matrix() {
    let (offsets, columns, values) = ring(40, |_| 0.25);
    let mut solver = CongruentSolver::new(offsets.clone(), columns.clone()).unwrap();
    let inertia = solver.factor(&values).unwrap();
    assert!(matches!(&solver.basis, Basis::Changed { transformed, .. } if transformed.pattern().1.len() < columns.len() - 80));
    assert_eq!(inertia, SymmetricSolver::new(&offsets, &columns).unwrap().factor(&values).unwrap());
    let right: Vec<f64> = (0..82).map(|k| (k as f64).sin()).collect();
    let mut x = vec![0.0; 82];
    solver.solve(&right, &mut x).unwrap();
    assert!(residual(&offsets, &columns, &values, &x, &right) < 1e-13);
}

#[test]
fn values_that_are_not_proportional_any_more_are_solved_in_the_plain_basis() {
    let (offsets, columns, values) = ring(40, |_| 0.25);
    let mut solver = CongruentSolver::new(offsets.clone(), columns.clone()).unwrap();
    solver.factor(&values).unwrap();
    let (_, _, others) = ring(40, |k| 0.1 + 0.01 * k as f64 / 40.0);
    solver.factor(&others).unwrap();
    assert!(matches!(solver.basis, Basis::Plain(_)));
    let right = vec![1.0; 82];
    let mut x = vec![0.0; 82];
    solver.solve(&right, &mut x).unwrap();
    assert!(residual(&offsets, &columns, &others, &x, &right) < 1e-13);
}

#[test]
fn a_matrix_without_couplings_tells_nothing() {
    let (offsets, columns, values) = ring(40, |_| 0.25);
    let diagonal: Vec<f64> = (0..82)
        .flat_map(|row| (offsets[row]..offsets[row + 1]).map(move |at| (row, at)))
        .map(|(row, at)| if columns[at] as usize == row { values[at] } else { 0.0 })
        .collect();
    let mut solver = CongruentSolver::new(offsets, columns).unwrap();
    solver.factor(&diagonal).unwrap();
    assert!(matches!(solver.basis, Basis::Unknown(_)));
    solver.factor(&values).unwrap();
    assert!(matches!(solver.basis, Basis::Changed { .. }));
}

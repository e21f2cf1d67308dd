//! Variables that have no row and no second derivative in common.

use crate::model::Meta;

/// An even selection of at most so many of n variables.
pub(super) fn even(n: usize, most: usize) -> Vec<u32> {
    (0..n as u32).step_by(n.div_ceil(most).max(1)).collect()
}

/// Some variables, ascending, in at most so many groups whose variables stand apart.
pub(super) fn apart(meta: &Meta, selected: &[u32], groups: usize) -> Vec<Vec<u32>> {
    let reached = Reached::by(meta, selected);
    let mut found: Vec<(Vec<u32>, Vec<bool>)> = Vec::new();
    for (at, &j) in selected.iter().enumerate() {
        let own = &reached.of[at];
        let is_free = |(_, taken): &(Vec<u32>, Vec<bool>)| own.iter().all(|&place| !taken[place as usize]);
        let free = found.iter().position(is_free).or_else(|| {
            let another = found.len() < groups;
            found.extend(another.then(|| (Vec::new(), vec![false; reached.places])));
            another.then(|| found.len() - 1)
        });
        let Some((group, taken)) = free.map(|free| &mut found[free]) else { continue };
        group.push(j);
        own.iter().for_each(|&place| taken[place as usize] = true);
    }
    found.into_iter().map(|(group, _)| group).collect()
}

/// Which rows, and behind them which variables by second derivatives, the variables selected reach.
struct Reached {
    of: Vec<Vec<u32>>,
    places: usize,
}

impl Reached {
    fn by(meta: &Meta, selected: &[u32]) -> Self {
        let (n, m) = (meta.variables(), meta.rows());
        let mut of = vec![Vec::new(); selected.len()];
        let mut places = vec![None; n];
        selected.iter().enumerate().for_each(|(at, &j)| places[j as usize] = Some(at));
        let mut add = |j: usize, place: usize| {
            if let Some(at) = places[j] {
                of[at].push(place as u32);
            }
        };
        meta.jacobian.iter().for_each(|(row, column)| add(column, row));
        for (row, column) in meta.hessian.iter() {
            add(row, m + column);
            add(column, m + row);
        }
        Reached { of, places: m + n }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Pattern;

    #[test]
    fn variables_of_one_row_or_one_second_derivative_are_of_different_groups() {
        let meta = Meta {
            lower: vec![0.0; 4],
            row_lower: vec![0.0],
            jacobian: Pattern::from_positions(1, &mut vec![(0, 0), (0, 1)]),
            hessian: Pattern::from_positions(4, &mut vec![(2, 1), (3, 3)]),
            ..Meta::default()
        };
        assert_eq!(apart(&meta, &even(4, 4), 9), [vec![0, 2, 3], vec![1]]);
        assert_eq!(apart(&meta, &even(4, 4), 1), [vec![0, 2, 3]]);
        assert_eq!(apart(&meta, &even(4, 2), 9), [vec![0, 2]]);
    }
}

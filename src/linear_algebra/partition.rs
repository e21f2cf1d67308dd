//! Union–find over what couples variables.

use super::Pattern;

/// Variables and rows by component; components are numbered by their smallest variable.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Partition {
    variable_offsets: Vec<u32>,
    variables: Vec<u32>,
    row_offsets: Vec<u32>,
    rows: Vec<u32>,
    component: Vec<u32>,
    place: Vec<u32>,
    row_place: Vec<u32>,
}

impl Partition {
    /// The finest partition of `variables` in which the members of every one of `couplings` stay together, with the rows
    /// where their first variable is. `None` where a row has no variables.
    pub fn new<'a>(
        variables: usize,
        rows: impl Iterator<Item = &'a [u32]> + Clone,
        couplings: impl Iterator<Item = &'a [u32]>,
    ) -> Option<Partition> {
        let mut sets = Sets::new(variables);
        couplings.for_each(|members| sets.join(members));
        sets.partition(rows)
    }

    /// The finest partition in which every row of the Jacobian and every entry of the Hessian stays within one component.
    pub fn of_patterns(jacobian: &Pattern, hessian: &Pattern) -> Option<Partition> {
        let mut sets = Sets::new(hessian.rows());
        hessian.iter().for_each(|(i, j)| sets.join(&[i as u32, j as u32]));
        sets.partition((0..jacobian.rows()).map(|i| jacobian.row(i)))
    }

    /// Number of components.
    pub fn len(&self) -> usize {
        self.variable_offsets.len().saturating_sub(1)
    }

    /// True without variables.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Variables of the largest component.
    pub fn largest(&self) -> usize {
        self.variable_offsets.windows(2).map(|pair| (pair[1] - pair[0]) as usize).max().unwrap_or(0)
    }

    /// The variables of component k, ascending.
    pub fn variables(&self, k: usize) -> &[u32] {
        &self.variables[self.variable_offsets[k] as usize..self.variable_offsets[k + 1] as usize]
    }

    /// The rows of component k, ascending.
    pub fn rows(&self, k: usize) -> &[u32] {
        &self.rows[self.row_offsets[k] as usize..self.row_offsets[k + 1] as usize]
    }

    /// The component of variable j.
    pub fn component(&self, j: u32) -> u32 {
        self.component[j as usize]
    }

    /// Where variable j stands among the variables of its component.
    pub fn place(&self, j: u32) -> u32 {
        self.place[j as usize]
    }

    /// Where row i stands among the rows of its component.
    pub fn row_place(&self, i: u32) -> u32 {
        self.row_place[i as usize]
    }
}

/// Items by component: offsets, items in order, and where each stands in its component.
fn sorted(component: &[u32], count: u32) -> (Vec<u32>, Vec<u32>, Vec<u32>) {
    let mut offsets = vec![0; count as usize + 1];
    component.iter().for_each(|&k| offsets[k as usize + 1] += 1);
    for k in 0..count as usize {
        offsets[k + 1] += offsets[k];
    }
    let mut next = offsets.clone();
    let (mut items, mut place) = (vec![0; component.len()], vec![0; component.len()]);
    for (item, &k) in component.iter().enumerate() {
        let at = &mut next[k as usize];
        items[*at as usize] = item as u32;
        place[item] = *at - offsets[k as usize];
        *at += 1;
    }
    (offsets, items, place)
}

/// Disjoint sets of variables; the smallest member stands for its set.
struct Sets {
    parent: Vec<u32>,
}

impl Sets {
    fn new(variables: usize) -> Self {
        Sets { parent: (0..variables as u32).collect() }
    }

    fn find(&mut self, mut j: u32) -> u32 {
        while self.parent[j as usize] != j {
            // Halving the path keeps later walks short.
            let above = self.parent[self.parent[j as usize] as usize];
            self.parent[j as usize] = above;
            j = above;
        }
        j
    }

    fn join(&mut self, members: &[u32]) {
        let Some((&first, others)) = members.split_first() else { return };
        let mut kept = self.find(first);
        for &other in others {
            let root = self.find(other);
            let (low, high) = (kept.min(root), kept.max(root));
            self.parent[high as usize] = low;
            kept = low;
        }
    }

    /// The sets, those joined that rows hold together. `None` where a row has no variables.
    fn partition<'a>(mut self, rows: impl Iterator<Item = &'a [u32]> + Clone) -> Option<Partition> {
        rows.clone().for_each(|members| self.join(members));
        let (component, count) = self.numbered();
        let of_rows = rows.map(|members| members.first().map(|&j| component[j as usize]));
        let of_rows: Vec<u32> = of_rows.collect::<Option<_>>()?;
        let (variable_offsets, variables, place) = sorted(&component, count);
        let (row_offsets, rows, row_place) = sorted(&of_rows, count);
        Some(Partition { variable_offsets, variables, row_offsets, rows, component, place, row_place })
    }

    /// The number of each variable's set, in order of smallest members, and how many there are.
    fn numbered(mut self) -> (Vec<u32>, u32) {
        let (mut numbers, mut count) = (vec![0; self.parent.len()], 0);
        for j in 0..self.parent.len() as u32 {
            let root = self.find(j);
            numbers[j as usize] = if root == j { count } else { numbers[root as usize] };
            count += u32::from(root == j);
        }
        (numbers, count)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_and_couplings_hold_variables_together() {
        let rows: [&[u32]; 2] = [&[1, 4], &[2]];
        let couplings: [&[u32]; 2] = [&[5, 4], &[0]];
        let partition = Partition::new(6, rows.into_iter(), couplings.into_iter()).unwrap();
        let all: Vec<_> = (0..partition.len()).map(|k| (partition.variables(k), partition.rows(k))).collect();
        assert_eq!(all, [(&[0][..], &[][..]), (&[1, 4, 5], &[0]), (&[2], &[1]), (&[3], &[])]);
        assert_eq!((partition.place(5), partition.component(5), partition.row_place(1)), (2, 1, 0));
    }

    #[test]
    fn a_row_without_variables_belongs_nowhere() {
        assert_eq!(Partition::new(1, [[0_u32; 0].as_slice()].into_iter(), std::iter::empty()), None);
    }
}

//! Lists of sizes, in an order in which neighbours are alike.

/// Variables that take the numbers of one row of a list together: one variable and its values, or the dimensions of a catalogue's section.
#[derive(Debug, Clone, PartialEq)]
pub struct List {
    /// The variables, by number.
    pub variables: Vec<usize>,
    /// The rows, each a number per variable, from small to large.
    pub rows: Vec<Vec<f64>>,
    /// How large each row is: what rows are sorted by.
    sizes: Vec<f64>,
    /// Where each row stood before.
    pub places: Vec<usize>,
}

/// Rows `first` to `last` of a list.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(missing_docs)]
pub struct Range {
    pub first: usize,
    pub last: usize,
}

impl Range {
    /// Whether one row is left.
    pub fn is_single(self) -> bool {
        self.first == self.last
    }
}

/// How large a row is: a single number itself, several by the product of their magnitudes.
fn size(row: &[f64]) -> f64 {
    match row {
        [one] => *one,
        several => several.iter().map(|value| value.abs().max(f64::MIN_POSITIVE).ln()).sum(),
    }
}

impl List {
    /// The list of these rows.
    pub fn new(variables: Vec<usize>, rows: Vec<Vec<f64>>) -> List {
        let mut order: Vec<(f64, usize)> = rows.iter().enumerate().map(|(at, row)| (size(row), at)).collect();
        order.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let sizes = order.iter().map(|(size, _)| *size).collect();
        let places: Vec<usize> = order.into_iter().map(|(_, at)| at).collect();
        List { variables, rows: places.iter().map(|&at| rows[at].clone()).collect(), sizes, places }
    }

    /// All rows.
    pub fn whole(&self) -> Range {
        Range { first: 0, last: self.rows.len().saturating_sub(1) }
    }

    /// The least and the largest number of variable `k` of the list within a range.
    pub fn extent(&self, range: Range, k: usize) -> (f64, f64) {
        let column = self.rows[range.first..=range.last].iter().map(|row| row[k]);
        column.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(value), high.max(value)))
    }

    /// The numbers that a point has for the list's variables.
    fn of<'x>(&'x self, x: &'x [f64]) -> impl Iterator<Item = f64> + 'x {
        self.variables.iter().map(|&j| x[j])
    }

    /// How far a point is from a row, each variable by its slope.
    pub fn distance(&self, row: usize, x: &[f64], slopes: &[f64]) -> f64 {
        let pairs = self.variables.iter().zip(&self.rows[row]);
        pairs.map(|(&j, value)| (slopes[j].abs() * (x[j] - value)).abs()).sum()
    }

    /// The row of a range that is nearest to a point, in shares of the range's extents.
    pub fn nearest(&self, range: Range, x: &[f64]) -> usize {
        let widths: Vec<f64> = (0..self.variables.len())
            .map(|k| {
                let (low, high) = self.extent(range, k);
                if high > low { high - low } else { 1.0 }
            })
            .collect();
        let away = |row: usize| -> f64 {
            let parts = self.of(x).zip(&self.rows[row]).zip(&widths);
            parts.map(|((x, value), width)| ((x - value) / width).abs()).sum()
        };
        (range.first..=range.last).min_by(|&a, &b| away(a).total_cmp(&away(b))).unwrap_or(range.first)
    }

    /// The first row of a range none of whose numbers is below the point's; the last row where there is none.
    pub fn above(&self, range: Range, x: &[f64]) -> usize {
        let covers = |row: &usize| self.of(x).zip(&self.rows[*row]).all(|(x, value)| *value >= x - 1e-9 * x.abs());
        (range.first..=range.last).find(covers).unwrap_or(range.last)
    }

    /// A range in two, where the point is.
    pub fn halves(&self, range: Range, x: &[f64]) -> [Range; 2] {
        let numbers: Vec<f64> = self.of(x).collect();
        let here = size(&numbers);
        let below = self.sizes[range.first..=range.last].partition_point(|size| *size <= here + 1e-9 * here.abs());
        // Both halves have a row; a point on a row has it as the end of one.
        let middle = range.first + below.clamp(1, range.last - range.first) - 1;
        [Range { first: range.first, last: middle }, Range { first: middle + 1, last: range.last }]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_are_halved_where_the_point_is() {
        let list = List::new(vec![0], vec![vec![3.0], vec![1.0], vec![2.0], vec![5.0]]);
        assert_eq!((list.rows.concat(), list.places.clone()), (vec![1.0, 2.0, 3.0, 5.0], vec![1, 2, 0, 3]));
        let halves = |x: f64| list.halves(list.whole(), &[x]).map(|range| (range.first, range.last));
        assert_eq!(halves(2.4), [(0, 1), (2, 3)]);
        assert_eq!(halves(2.0), [(0, 1), (2, 3)]);
        assert_eq!(halves(0.5), [(0, 0), (1, 3)]);
        assert_eq!(halves(9.0), [(0, 2), (3, 3)]);
        assert_eq!((list.nearest(list.whole(), &[2.6]), list.above(list.whole(), &[2.1])), (2, 2));
    }

    #[test]
    fn rows_of_several_numbers_are_sorted_by_their_product() {
        let list = List::new(vec![1, 0], vec![vec![4.0, 4.0], vec![1.0, 2.0], vec![3.0, 1.0]]);
        assert_eq!(list.rows, [vec![1.0, 2.0], vec![3.0, 1.0], vec![4.0, 4.0]]);
        assert_eq!(list.extent(list.whole(), 0), (1.0, 4.0));
        assert_eq!(list.nearest(list.whole(), &[1.1, 2.9]), 1);
        assert_eq!([list.above(list.whole(), &[2.0, 1.0]), list.above(list.whole(), &[1.5, 3.5])], [0, 2]);
    }
}

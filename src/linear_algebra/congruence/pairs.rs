//! Pairs of unknowns whose columns are proportional but for a few entries.

/// Columns with more entries than this are nobody's partner.
const LONGEST: usize = 100;
/// Entries that differ by less than this, relative, are the same.
pub(super) const SAME: f64 = 1e-10;
/// Proportional entries a pair needs at the least, and how many times as many as others.
const LEAST: usize = 3;
const MAJORITY: usize = 1;
/// Entries whose ratio is tried as that of all.
const TRIED: usize = 2;
/// Ratios beyond this, or below its inverse, would spoil the numbers.
const EXTREME: f64 = 1e3;

/// Who leaves its place to a direction of its own: i to e_i − ratio·e_partner.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Partner {
    pub place: u32,
    pub ratio: f64,
}

/// Whether most entries off the diagonal are there.
pub(super) fn is_telling(offsets: &[usize], columns: &[u32], values: &[f64]) -> bool {
    let (mut there, mut missing) = (0usize, 0usize);
    for (row, range) in offsets.windows(2).enumerate() {
        for at in range[0]..range[1] {
            if columns[at] as usize != row {
                *(if values[at] == 0.0 { &mut missing } else { &mut there }) += 1;
            }
        }
    }
    there > missing
}

/// The partner of every unknown that has one. Nobody is in two pairs.
pub(super) fn find(offsets: &[usize], columns: &[u32], values: &[f64]) -> Vec<Option<Partner>> {
    let columns = Columns::of(offsets, columns);
    let order = offsets.len() - 1;
    let mut partners = vec![None; order];
    let mut taken = vec![false; order];
    for i in (0..order).filter(|&i| columns.of_one(i).len() <= LONGEST) {
        let own = columns.of_one(i).len();
        // As many rows as the longer column has are looked at, and no more than the shorter one has are alike.
        let fits = |other: usize| other <= LONGEST && own.max(other) <= 2 * own.min(other) + 2;
        let free = |&&(k, _): &&(u32, u32)| k as usize != i && !taken[k as usize] && fits(columns.of_one(k as usize).len());
        let found = columns.of_one(i).iter().filter(free).find_map(|&(j, _)| {
            let ratio = proportion(&columns, values, (i, j as usize))?;
            Some(Partner { place: j, ratio })
        });
        if let Some(partner) = found.filter(|_| !taken[i]) {
            partners[i] = Some(partner);
            taken[i] = true;
            taken[partner.place as usize] = true;
        }
    }
    partners
}

/// The ratio of column i to column j, if most of their entries share one.
fn proportion(columns: &Columns, values: &[f64], pair: (usize, usize)) -> Option<f64> {
    let mut shared: Vec<(f64, f64)> = Vec::new();
    columns.side_by_side(values, pair, |own, partner| shared.push((own, partner)));
    let candidates = shared.iter().filter(|(own, partner)| *own != 0.0 && *partner != 0.0).take(TRIED);
    candidates.map(|(own, partner)| own / partner).find(|ratio| {
        let same = shared.iter().filter(|(own, partner)| (own - ratio * partner).abs() <= SAME * own.abs()).count();
        same >= LEAST && same > MAJORITY * (shared.len() - same) && (1.0 / EXTREME..EXTREME).contains(&ratio.abs())
    })
}

/// The whole columns of a symmetric matrix given by its lower triangle: (row, place of the value), ascending.
struct Columns {
    starts: Vec<usize>,
    entries: Vec<(u32, u32)>,
}

impl Columns {
    fn of(offsets: &[usize], columns: &[u32]) -> Self {
        let order = offsets.len() - 1;
        let mut starts = vec![0; order + 1];
        let each = |visit: &mut dyn FnMut(usize, usize, usize)| {
            for row in 0..order {
                let own = offsets[row]..offsets[row + 1];
                own.clone().zip(&columns[own]).for_each(|(at, &column)| visit(row, column as usize, at));
            }
        };
        each(&mut |row, column, _| {
            starts[column + 1] += 1;
            starts[row + 1] += usize::from(row != column);
        });
        for k in 0..order {
            starts[k + 1] += starts[k];
        }
        let (mut next, mut entries) = (starts.clone(), vec![(0, 0); starts[order]]);
        let mut put = |of: usize, other: usize, at: usize| {
            entries[next[of]] = (other as u32, at as u32);
            next[of] += 1;
        };
        each(&mut |row, column, at| {
            // Row by row, a column meets its lower part in order after its upper part.
            put(row, column, at);
            if row != column {
                put(column, row, at);
            }
        });
        Columns { starts, entries }
    }

    fn of_one(&self, k: usize) -> &[(u32, u32)] {
        &self.entries[self.starts[k]..self.starts[k + 1]]
    }

    /// Calls `visit` with the values of two columns, row by row, where either is not zero; the rows of the pair itself left out.
    fn side_by_side(&self, values: &[f64], (i, j): (usize, usize), mut visit: impl FnMut(f64, f64)) {
        let (mut of_i, mut of_j) = (self.of_one(i).iter().peekable(), self.of_one(j).iter().peekable());
        loop {
            let next = |entry: Option<&&(u32, u32)>| entry.map_or(u32::MAX, |entry| entry.0);
            let row = next(of_i.peek()).min(next(of_j.peek()));
            if row == u32::MAX {
                return;
            }
            let value = |entry: Option<&(u32, u32)>| entry.map_or(0.0, |&(_, at)| values[at as usize]);
            let (own, partner) = (value(of_i.next_if(|entry| entry.0 == row)), value(of_j.next_if(|entry| entry.0 == row)));
            if row as usize != i && row as usize != j && (own != 0.0 || partner != 0.0) {
                visit(own, partner);
            }
        }
    }
}

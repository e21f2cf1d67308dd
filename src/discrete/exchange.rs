//! Good designs where nothing is proved: rows near the continuous optimum, list by list, and exchanges as long as they are better.

use super::{Design, List, Range, Rest};

/// Rounds of exchanges: each ends with a better design, and lists are finite; this many are enough for any that was met.
const ROUNDS: usize = 1000;

/// Up to so many lists are exchanged in pairs.
const PAIRS: usize = 40;

/// The best design found from a point between rows; `None` where no design tried meets the limits.
///
/// The list whose point is nearest to a row is put there first, the rest solved anew for the next one; where the limits cannot be met so,
/// all lists take the first row that is nowhere below the point, then their largest one. From there, every list tries its smaller rows, and
/// pairs one smaller and one larger.
pub fn best(rest: &Rest<'_>, start: &[f64]) -> Option<Design> {
    let lists = rest.lists;
    let rows =
        |choose: &dyn Fn(&List, Range) -> usize| -> Vec<usize> { lists.iter().map(|list| choose(list, list.whole())).collect() };
    let nearest = rows(&|list, range| list.nearest(range, start));
    let above = rows(&|list, range| list.above(range, start));
    let largest = rows(&|_, range| range.last);
    let designs = [nearest, above, largest].into_iter().filter_map(|rows| rest.design(&rows, start));
    let first = designs.min_by(|a, b| a.objective.total_cmp(&b.objective))?;
    Some(improved(rest, first))
}

/// A design exchanged for better ones as long as there are any among its neighbours.
pub fn improved(rest: &Rest<'_>, mut design: Design) -> Design {
    for _ in 0..ROUNDS {
        if rest.budget.check(0).is_err() {
            break;
        }
        match step(rest, &design) {
            Some(better) => design = better,
            None => break,
        }
    }
    design
}

/// The best neighbour that is better: one list smaller or larger by one row, or by half of what is left; or two lists, one each way.
fn step(rest: &Rest<'_>, design: &Design) -> Option<Design> {
    let tried = |moves: &[(usize, usize)]| {
        let mut rows = design.rows.clone();
        moves.iter().for_each(|&(list, row)| rows[list] = row);
        rest.design(&rows, &design.x).filter(|other| other.objective < design.objective)
    };
    let count = rest.lists.len();
    let singles = (0..count).flat_map(|list| neighbours(rest, design, list).into_iter().map(move |row| (list, row)));
    let best = singles.filter_map(|one| tried(&[one])).min_by(|a, b| a.objective.total_cmp(&b.objective));
    if best.is_some() || count > PAIRS {
        return best;
    }
    let beside = |list: usize, up: bool| {
        let row = design.rows[list];
        if up { (row + 1 < rest.lists[list].rows.len()).then_some(row + 1) } else { row.checked_sub(1) }
    };
    let pairs = (0..count).flat_map(|down| (0..count).filter(move |up| *up != down).map(move |up| (down, up)));
    let both = pairs.filter_map(|(down, up)| Some([(down, beside(down, false)?), (up, beside(up, true)?)]));
    both.filter_map(|moves| if rest.budget.check(0).is_err() { None } else { tried(&moves) }).next()
}

fn neighbours(rest: &Rest<'_>, design: &Design, list: usize) -> Vec<usize> {
    let (row, last) = (design.rows[list], rest.lists[list].rows.len() - 1);
    let mut rows = vec![row.saturating_sub(1), row / 2, (row + 1).min(last)];
    rows.retain(|&other| other != row);
    rows.dedup();
    rows
}

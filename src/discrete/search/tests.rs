use super::*;
use crate::math::split_mix::SplitMix;

/// Least cost·x with every row of `demands` met: demands[i]·x ≥ 1; all numbers positive, so that the relaxation may take its bound from the
/// lower ends, and nothing is met where the upper ends do not.
struct Covering {
    lists: Vec<List>,
    cost: Vec<f64>,
    demands: Vec<Vec<f64>>,
}

impl Covering {
    fn random(seed: u64) -> Covering {
        let mut random = SplitMix::new(seed);
        let lists = 2 + (random.uniform() * 3.0) as usize;
        let mut rows = |_| {
            let count = 1 + (random.uniform() * 5.0) as usize;
            (0..count).map(|_| vec![0.1 + random.uniform()]).collect()
        };
        let lists: Vec<List> = (0..lists).map(|at| List::new(vec![at], rows(at))).collect();
        let mut positive = || lists.iter().map(|_| random.uniform()).collect::<Vec<f64>>();
        let (cost, demands) = (positive(), vec![positive(), positive()]);
        Covering { lists, cost, demands }
    }

    fn value(weights: &[f64], x: &[f64]) -> f64 {
        weights.iter().zip(x).map(|(weight, x)| weight * x).sum()
    }

    fn exhaustive(&self) -> Option<f64> {
        let mut all = vec![Vec::new()];
        for list in &self.lists {
            all = all.iter().flat_map(|rows: &Vec<usize>| (0..list.rows.len()).map(|row| [&rows[..], &[row]].concat())).collect();
        }
        all.iter().filter_map(|rows| self.design(rows, &[])).map(|design| design.objective).reduce(f64::min)
    }
}

impl Relaxation for Covering {
    fn relax(&self, ranges: &[Range], _: &[f64]) -> Bounded {
        let ends: Vec<(f64, f64)> = self.lists.iter().zip(ranges).map(|(list, range)| list.extent(*range, 0)).collect();
        let most: Vec<f64> = ends.iter().map(|(_, high)| *high).collect();
        if self.demands.iter().any(|demand| Covering::value(demand, &most) < 1.0) {
            return Bounded::Empty;
        }
        let x: Vec<f64> = ends.iter().map(|(low, high)| 0.5 * (low + high)).collect();
        let least: Vec<f64> = ends.iter().map(|(low, _)| *low).collect();
        Bounded::Below(Relaxed { bound: Covering::value(&self.cost, &least), x, slopes: self.cost.clone() })
    }

    fn design(&self, rows: &[usize], _: &[f64]) -> Option<Design> {
        let x: Vec<f64> = self.lists.iter().zip(rows).map(|(list, row)| list.rows[*row][0]).collect();
        let holds = self.demands.iter().all(|demand| Covering::value(demand, &x) >= 1.0);
        holds.then(|| Design { rows: rows.to_vec(), objective: Covering::value(&self.cost, &x), x })
    }
}

#[test]
fn the_best_of_random_lists_is_that_of_all_designs_one_by_one() {
    let mut solvable = 0;
    for seed in 0..200 {
        let covering = Covering::random(seed);
        let start = vec![1.0; covering.lists.len()];
        let found = search(&covering, &covering.lists, None, &start, &Budget::default());
        let best = covering.exhaustive();
        assert!(found.proved, "seed {seed}");
        assert_eq!(found.best.as_ref().map(|best| best.objective), best, "seed {seed}");
        solvable += usize::from(best.is_some());
    }
    assert!((50..200).contains(&solvable), "{solvable} of 200 have a design");
}

#[test]
fn a_search_that_ends_early_keeps_what_it_has() {
    let covering = (0..).map(Covering::random).find(|covering| covering.exhaustive().is_some()).unwrap();
    let over = Budget { deadline: Some(std::time::Instant::now()), ..Budget::default() };
    let found = search(&covering, &covering.lists, None, &vec![1.0; covering.lists.len()], &over);
    assert!(found.relaxations <= 1);
    let best = covering.exhaustive().unwrap();
    assert!(found.bound <= best && found.best.is_none_or(|design| design.objective >= best));
}

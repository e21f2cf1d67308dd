//! Which sections are one: at places that mirror or turn into one another, along lines, everywhere.

use std::collections::{BTreeMap, BTreeSet};

use crate::mesh::Vector;
use crate::mesh::network::{Network, Rib};

/// Which sections are shared.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Sharing {
    /// None but where lines end at one vertex.
    Station,
    /// Those at places of the same height and distance from the middle on plan, and as far along lines of the same length.
    Symmetric,
    /// Those of a line, and of lines of the same length, height and distance from the middle.
    #[default]
    Line,
    /// All.
    One,
}

impl Sharing {
    /// All of them, by name.
    pub const NAMED: [(&'static str, Sharing); 4] =
        [("station", Sharing::Station), ("symmetric", Sharing::Symmetric), ("line", Sharing::Line), ("one", Sharing::One)];

    /// Whether a rib's ends may differ.
    pub fn tapers(self) -> bool {
        matches!(self, Sharing::Station | Sharing::Symmetric)
    }
}

/// Lengths nearer than this part of the largest are the same.
const SAME: f64 = 1e-6;

/// The name of the section at either end of every rib.
pub fn sections(network: &Network, sharing: Sharing) -> Vec<[String; 2]> {
    let own = |rib: &Rib, end: usize| network.sections[rib.sections[end] as usize].clone();
    let keys: Vec<[Key; 2]> = match sharing {
        Sharing::Station => return network.ribs.iter().map(|rib| [own(rib, 0), own(rib, 1)]).collect(),
        Sharing::One => return network.ribs.iter().map(|_| ["rib", "rib"].map(String::from)).collect(),
        Sharing::Symmetric => by_place(network),
        Sharing::Line => by_line(network),
    };
    // Called as the first of them.
    let mut names: BTreeMap<Key, String> = BTreeMap::new();
    let mut name = |key: &Key, rib: &Rib, end: usize| {
        let first = if sharing == Sharing::Line { rib.geometry.line.clone() } else { own(rib, end) };
        names.entry(key.clone()).or_insert(first).clone()
    };
    let both = network.ribs.iter().zip(&keys);
    both.map(|(rib, [from, to])| [name(from, rib, 0), name(to, rib, 1)]).collect()
}

/// What places have in common.
type Key = Vec<usize>;

fn by_place(network: &Network) -> Vec<[Key; 2]> {
    let middle = middle(network);
    let ends = || network.ribs.iter().flat_map(|rib| [0, 1].map(|end| (rib, end)));
    let heights = Steps::of(ends().map(|(rib, end)| rib.geometry.ends[end].z));
    let distances = Steps::of(ends().map(|(rib, end)| on_plan(rib.geometry.ends[end], middle)));
    let lengths = Steps::of(network.ribs.iter().map(|rib| rib.line_length));
    let along = |rib: &Rib, end: usize| if rib.closed { 0.0 } else { rib.s[end].min(rib.line_length - rib.s[end]) };
    let alongs = Steps::of(ends().map(|(rib, end)| along(rib, end)));
    // A section where several lines end has all their places.
    let mut lines: BTreeMap<u32, BTreeSet<[usize; 3]>> = BTreeMap::new();
    for (rib, end) in ends() {
        let place = [lengths.step(rib.line_length), alongs.step(along(rib, end)), usize::from(rib.closed)];
        lines.entry(rib.sections[end]).or_default().insert(place);
    }
    let key = |rib: &Rib, end: usize| {
        let place = rib.geometry.ends[end];
        let head = [heights.step(place.z), distances.step(on_plan(place, middle))];
        let lines = lines.get(&rib.sections[end]).into_iter().flatten().flatten().copied();
        head.into_iter().chain(lines).collect()
    };
    network.ribs.iter().map(|rib| [key(rib, 0), key(rib, 1)]).collect()
}

fn by_line(network: &Network) -> Vec<[Key; 2]> {
    let middle = middle(network);
    // Means over a line, weighted by length.
    let mut means: BTreeMap<&str, [f64; 3]> = BTreeMap::new();
    for rib in &network.ribs {
        let [length, half] = [rib.geometry.length(), 0.5 * rib.geometry.length()];
        let sum = means.entry(rib.geometry.line.as_str()).or_default();
        for end in rib.geometry.ends {
            sum[0] += half * end.z;
            sum[1] += half * on_plan(end, middle);
        }
        sum[2] += length;
    }
    let mean = |line: &str, at: usize| means.get(line).map_or(0.0, |sum| sum[at] / sum[2]);
    let lengths = Steps::of(network.ribs.iter().map(|rib| rib.line_length));
    let [heights, distances] = [0, 1].map(|at| Steps::of(means.keys().map(|line| mean(line, at))));
    let key = |rib: &Rib| {
        let line = rib.geometry.line.as_str();
        vec![lengths.step(rib.line_length), usize::from(rib.closed), heights.step(mean(line, 0)), distances.step(mean(line, 1))]
    };
    network.ribs.iter().map(|rib| [key(rib), key(rib)]).collect()
}

/// The ribs' centre of gravity on plan: every mirror and turn of the structure leaves it where it is.
fn middle(network: &Network) -> [f64; 2] {
    let mut sums = [0.0; 3];
    for rib in &network.ribs {
        let (length, half) = (rib.geometry.length(), 0.5 * rib.geometry.length());
        for end in rib.geometry.ends {
            sums[0] += half * end.x;
            sums[1] += half * end.y;
        }
        sums[2] += length;
    }
    [sums[0] / sums[2], sums[1] / sums[2]]
}

fn on_plan(place: Vector, middle: [f64; 2]) -> f64 {
    (place.x - middle[0]).hypot(place.y - middle[1])
}

/// Numbers in steps: those that differ by less than [`SAME`] of the largest are one.
struct Steps(Vec<f64>);

impl Steps {
    fn of(values: impl Iterator<Item = f64>) -> Steps {
        let mut all: Vec<f64> = values.collect();
        all.sort_by(f64::total_cmp);
        let apart = SAME * all.iter().map(|value| value.abs()).fold(0.0, f64::max);
        // Every number begins a step that is farther than that from the one before.
        let begins: Vec<f64> = (0..all.len()).filter(|&at| at == 0 || all[at] - all[at - 1] > apart).map(|at| all[at]).collect();
        Steps(begins)
    }

    fn step(&self, value: f64) -> usize {
        self.0.partition_point(|begin| *begin <= value)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{QuadMesh, generate, stations, trace};

    fn count(sharing: Sharing) -> usize {
        let mesh = QuadMesh::new(generate::vault(6, 8, 10.0, 12.0, 3.0)).unwrap();
        let network = Network::new(&stations::slice(&mesh, &trace::trace(&mesh), f64::INFINITY).unwrap()).unwrap();
        sections(&network, sharing).into_iter().flatten().collect::<BTreeSet<_>>().len()
    }

    #[test]
    fn a_vault_mirrored_twice_needs_a_quarter_of_the_sections() {
        let [own, quarter, lines, one] = Sharing::NAMED.map(|(_, sharing)| count(sharing));
        assert!(quarter < own / 3 && lines < quarter && one == 1, "{own} {quarter} {lines} {one}");
        // Nine arches in five places, and seven lines along the vault at four heights.
        assert_eq!(lines, 5 + 4);
    }

    #[test]
    fn numbers_that_differ_by_rounding_are_one_step() {
        let steps = Steps::of([1.0, 1.0 + 1e-12, 2.0, 1.0 - 1e-12].into_iter());
        assert_eq!(steps.step(1.0 - 1e-12), steps.step(1.0 + 1e-12));
        assert_ne!(steps.step(1.0), steps.step(2.0));
    }
}

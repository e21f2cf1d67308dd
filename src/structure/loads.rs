//! Loads on a member, and what they do to it while it is simply supported.
//!
//! With q a load per length, M'' = q, V = M', N' = −q_x, T' = −m_x; the supports of the simply supported member hold it axially and
//! against torsion at its start. ξ is the fraction of the length.

use super::algebra::Algebra;

/// How a load is spread over the member. Its moment is `value · m(ξ)` and its shear force `value/L · m'(ξ)`, where `value` is L²·q for
/// a load per length, L·P for a force, and the moment itself for a moment; its axial force or torque is `value · n(ξ)` with L·q, P, m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Spread {
    /// q grows with ξ^k over the whole member.
    Power(u32),
    /// From 0 at the first fraction to q at the second.
    Rising(f64, f64),
    /// From q at the first fraction to 0 at the second.
    Falling(f64, f64),
    /// A force at a fraction.
    Force(f64),
    /// A moment at a fraction (about the axis for which M'' = q holds with its sign).
    Moment(f64),
}

impl Spread {
    /// Q' = ∫q and Q = ∫∫q from the start on.
    fn integrals(self, x: f64) -> (f64, f64) {
        let after = |from: f64| (x - from).max(0.0);
        match self {
            Spread::Power(k) => {
                let k = f64::from(k);
                (x.powf(k + 1.0) / (k + 1.0), x.powf(k + 2.0) / ((k + 1.0) * (k + 2.0)))
            }
            Spread::Rising(from, to) => {
                let (inside, beyond, width) = (after(from).min(to - from), after(to), to - from);
                let total = 0.5 * width;
                (inside * inside / (2.0 * width), inside.powi(3) / (6.0 * width) + total * beyond)
            }
            Spread::Falling(from, to) => {
                let (inside, beyond) = (after(from).min(to - from), after(to));
                let (slope, rising) = Spread::Rising(from, to).integrals(x);
                (inside - slope, 0.5 * inside * inside + (to - from) * beyond - rising)
            }
            Spread::Force(at) => (if x > at { 1.0 } else { 0.0 }, after(at)),
            Spread::Moment(at) => (0.0, if x > at { -1.0 } else { 0.0 }),
        }
    }

    /// m(ξ), zero at both ends.
    ///
    /// ```
    /// use ribopt::structure::loads::Spread;
    /// assert_eq!(Spread::Power(0).moment(0.5), -0.125);
    /// assert_eq!(Spread::Force(0.25).moment(0.5), -0.125);
    /// ```
    pub fn moment(self, x: f64) -> f64 {
        match self {
            Spread::Moment(at) => x + if x > at { -1.0 } else { 0.0 },
            _ => self.integrals(x).1 - x * self.integrals(1.0).1,
        }
    }

    /// m'(ξ)
    pub fn shear(self, x: f64) -> f64 {
        match self {
            Spread::Moment(_) => 1.0,
            _ => self.integrals(x).0 - self.integrals(1.0).1,
        }
    }

    /// n(ξ), zero at the end.
    pub fn axial(self, x: f64) -> f64 {
        match self {
            Spread::Moment(at) | Spread::Force(at) => {
                if x > at {
                    0.0
                } else {
                    1.0
                }
            }
            _ => self.integrals(1.0).0 - self.integrals(x).0,
        }
    }

    /// Where it is not smooth inside the member.
    pub fn breaks(self) -> impl Iterator<Item = f64> {
        let both = match self {
            Spread::Power(_) => [0.0, 1.0],
            Spread::Rising(from, to) | Spread::Falling(from, to) => [from, to],
            Spread::Force(at) | Spread::Moment(at) => [at, 1.0],
        };
        both.into_iter().filter(|&at| at > 0.0 && at < 1.0)
    }

    /// By which two spreads are told apart.
    pub fn key(self) -> [u64; 3] {
        match self {
            Spread::Power(k) => [0, k.into(), 0],
            Spread::Rising(from, to) => [1, from.to_bits(), to.to_bits()],
            Spread::Falling(from, to) => [2, from.to_bits(), to.to_bits()],
            Spread::Force(at) => [3, at.to_bits(), 0],
            Spread::Moment(at) => [4, at.to_bits(), 0],
        }
    }
}

/// What a load works on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Way {
    /// N.
    Axial,
    /// T.
    Torque,
    /// Mz and Vy: the plane x–y.
    Lateral,
    /// My and Vz: the plane x–z.
    Vertical,
}

/// One load on a member: how it is spread, and its value (see [`Spread`]).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Term<N> {
    /// What it works on.
    pub way: Way,
    /// How it is spread.
    pub spread: Spread,
    /// L·q, L²·q, P, L·P or m.
    pub value: N,
}

/// Everything that loads a member in one case or combination.
#[derive(Debug, Clone, PartialEq)]
pub struct MemberLoads<N> {
    /// Forces and moments.
    pub terms: Vec<Term<N>>,
    /// Density times gravity in member axes: its own weight per volume, where it counts.
    pub weight: Option<[N; 3]>,
    /// Stress-free strain along the axis: α·ΔT.
    pub strain: Option<N>,
    /// α·(T(top) − T(bottom)): the stress-free curvature w'' is −this/height.
    pub gradient: Option<N>,
    /// The axial force between locked ends.
    pub pretension: Option<N>,
}

impl<N> Default for MemberLoads<N> {
    fn default() -> Self {
        MemberLoads { terms: Vec::new(), weight: None, strain: None, gradient: None, pretension: None }
    }
}

impl<N: Copy> MemberLoads<N> {
    /// The same with every value replaced, in a fixed order.
    pub fn map<M>(&self, mut value: impl FnMut(N) -> M) -> MemberLoads<M> {
        let terms = self.terms.iter().map(|term| Term { way: term.way, spread: term.spread, value: value(term.value) }).collect();
        MemberLoads {
            terms,
            weight: self.weight.map(|weight| weight.map(&mut value)),
            strain: self.strain.map(&mut value),
            gradient: self.gradient.map(&mut value),
            pretension: self.pretension.map(&mut value),
        }
    }

    /// Adds a load; one that is spread alike takes it up.
    pub fn add<A: Algebra<Number = N>>(&mut self, algebra: &mut A, way: Way, spread: Spread, value: N) {
        match self.terms.iter_mut().find(|term| term.way == way && term.spread == spread) {
            Some(term) => term.value = algebra.add(term.value, value),
            None => self.terms.push(Term { way, spread, value }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: [Spread; 7] = [
        Spread::Power(0),
        Spread::Power(1),
        Spread::Power(2),
        Spread::Rising(0.2, 0.7),
        Spread::Falling(0.2, 0.7),
        Spread::Force(0.3),
        Spread::Moment(0.6),
    ];

    #[test]
    fn moments_vanish_at_the_supports_and_shear_is_their_slope() {
        for spread in ALL {
            assert!(spread.moment(0.0).abs() < 1e-15 && spread.moment(1.0).abs() < 1e-15, "{spread:?}");
            for x in [0.1, 0.25, 0.5, 0.65, 0.9] {
                let slope = (spread.moment(x + 1e-6) - spread.moment(x - 1e-6)) / 2e-6;
                assert!((slope - spread.shear(x)).abs() < 1e-8, "{spread:?} at {x}");
            }
        }
    }

    /// Rising and falling loads add up to uniform ones.
    #[test]
    fn a_uniform_load_is_the_sum_of_its_halves() {
        for x in [0.1, 0.4, 0.8] {
            let sum = Spread::Rising(0.0, 1.0).moment(x) + Spread::Falling(0.0, 1.0).moment(x);
            assert!((sum - Spread::Power(0).moment(x)).abs() < 1e-16);
            let axial = Spread::Rising(0.0, 1.0).axial(x) + Spread::Falling(0.0, 1.0).axial(x);
            assert!((axial - Spread::Power(0).axial(x)).abs() < 1e-16);
        }
    }
}

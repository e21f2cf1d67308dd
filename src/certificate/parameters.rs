//! What the certificate measures by: every number that decides a verdict, with the inequality it stands in (docs/certificate.md has
//! the definitions: ε, d_j, σ, S). Accepted residuals are [`Tolerances`](super::Tolerances), which the user sets.
//!
//! Each group is the test of the same name. Those of the ways outwards are `recession::parameters`.

use crate::math::parameters::parameters;

parameters! {
    /// Sizes of variables and slopes about the point.
    sizes {
        /// Places about a point lie this share of the variables away; the first at which the model has a value counts.
        ABOUT: [f64; 3] = [0.1, 1e-2, 1e-3];
        /// A size d_j a bent row has told holds where |∂c_i/∂x_j(x + d)|·d_j ≤ BENT·|limit_i|.
        BENT: f64 = 4.0;
        /// One that does not is multiplied by excess^(−1/4), which overshoots for no power up to the fourth, and by no less than this.
        SHRUNK: f64 = 1e-3;
        /// So often at the most.
        SHRINKINGS: usize = 24;
        /// Where no slope tells a size, shrinking begins here: beyond what a model means.
        UNTOLD: f64 = 1e30;
        /// Entries of a row below this share of its largest determine no multiplier.
        SIGNIFICANT: f64 = 1e-2;
        /// Curvature changes a size by this factor at the most: more would be a guess about rounding.
        RESIZED: f64 = 1e8;
        /// Variables resized at the most, each for one gradient.
        RESIZABLE: usize = 64;
        /// σ ≤ PROPORTION·(slope at the point), however steep the objective is about it: x⁶⁰ has any slope about 1.
        PROPORTION: f64 = 1e3;
    }

    /// Whether a point meets its limits.
    feasibility {
        /// A violation ≤ ROUNDED·(|limit| + terms) is rounding of the row's own sum.
        ROUNDED: f64 = 4.0 * f64::EPSILON;
        /// The same of a row's value at other points and beside known sizes: ROUNDINGS·(|limit| + Σ terms).
        ROUNDINGS: f64 = 64.0 * f64::EPSILON;
        /// d_j > FAR·(known size): far away; the row is measured by FAR times the known sizes.
        FAR: f64 = 10.0;
        /// |x_j| > GONE·(the size it is measured by there) has left what is known of it behind: a row that misses TOLD of its limit there is not met.
        GONE: f64 = 1e5;
        /// Rounding beyond TOLD·max(|limit|, slope beside known sizes) explains no violation.
        TOLD: f64 = 1e-2;
        /// A point that meets the rows beside one far away lies within BESIDE·d_j.
        BESIDE: f64 = 1e-3;
        /// Newton steps back to the rows.
        STEPS: usize = 6;
        /// How often one is computed anew without variables that bounds hold.
        PASSES: usize = 4;
        /// violation > WORTH_A_LOOK·tolerance·max(|limit|, slope) has no feasible point within the tolerance.
        WORTH_A_LOOK: f64 = 10.0;
        /// Variables and rows up to which places are led back to the rows: a few sparse factorisations each.
        LARGEST: usize = 2_000;
    }

    /// Which limits may carry a multiplier, and what a witness must be worth.
    multipliers {
        /// Scaled distance > REACH: with complementarity ≤ 1e−6 the multiplier would be < 1e−3.
        REACH: f64 = 1e-3;
        /// A refined multiplier of the wrong sign that is ≤ ROUNDINGS·(the largest), in units of σ, is none.
        ROUNDINGS: f64 = 1e3 * f64::EPSILON;
        /// A witness that leaves more than this share of σ is no start for a refinement.
        REFINABLE: f64 = 1e-2;
    }

    /// Slopes that do not hold on the way to the limits.
    gap {
        /// gap ≤ ROUNDINGS·|f|: none.
        ROUNDINGS: f64 = 1e3 * f64::EPSILON;
        /// Distances ≤ ROUNDED·(terms or |limit|) are rounding.
        ROUNDED: f64 = 32.0 * f64::EPSILON;
        /// f falls on half the way by more than HONEST·gap/2: its slope grows there. A power p < 1 of the distance falls by
        /// (1 − 2^−p)/(p/2) times as much, 1.17 for a square root, 1.05 for p = 0.85.
        HONEST: f64 = 1.05;
    }

    /// Small slopes that lead far.
    far_slopes {
        /// A way that leads too far is shortened to this share while its slope promises enough.
        SHORTER: f64 = 0.1;
    }

    /// Active rows that push nowhere.
    idle_rows {
        /// Such rows looked at.
        MOST: usize = 8;
        /// Multipliers tried, in units of what bends the row as much as the objective: −4xy beside xy ≤ 0 needs one of 2 such units.
        TRIED: [f64; 4] = [1.0, 4.0, 16.0, 256.0];
    }

    /// Curvature on the critical cone.
    second_order {
        /// |curvature| ≤ ROUNDING·(row sums of |S| + FLOOR): rounding; positive beyond +, negative beyond −.
        ROUNDING: f64 = 1e-7;
        /// The least scale of a row of S, in units of σ.
        FLOOR: f64 = 1e-5;
        /// |y_i|·slope_i/σ ≤ WEAK, the accepted residual of ∂L/∂x_j: weakly active.
        WEAK: f64 = 1e-6;
        /// ≤ CONDITION·(the slope that is left), or √(multiplier·distance): nearly so. A slope of 1e−6 makes up to 1e−4 of a
        /// multiplier where L bends by a hundredth, 1e−3 in a chain of two.
        CONDITION: f64 = 1e3;
        /// … but no more than this.
        NEARLY_WEAK: f64 = 1e-3;
        /// … and ≤ NEARLY_FLAT times the curvature about the limit.
        NEARLY_FLAT: f64 = 1e-2;
        /// 2·∇f·v/|vᵀSv| ≤ NEAREST: a minimum only this near, because nearly weakly active limits push, is refused.
        NEAREST: f64 = 1e-3;
        /// δ of the cone's matrix: |S|²·δ/4 < ROUNDING and ε/δ < ROUNDING, |S| being 1.
        DELTA: f64 = 1e-7;
        /// Faces of the cone looked at: all of thirteen weakly active limits that are all tied to one another.
        FACES: usize = 8192;
        /// Weakly active limits at the most: M is dense.
        MOST: usize = 512;
        /// Solutions, one per weakly active limit, times the order of the matrix.
        WORK: usize = 20_000_000;
        /// Faces whose curvature is < LOW times that of their edges are looked at beyond second order …
        LOW: f64 = 1e-3;
        /// … so many of them.
        LOW_FACES: usize = 12;
        /// A simplified Newton step ≤ CONTRACTION·(the one before it): h ≤ 2·CONTRACTION, far below Kantorovich's ½, as one direction's
        /// h may hide behind a longer step in another.
        CONTRACTION: f64 = 1e-2;
        /// Newton's step moves no variable by more than REACH of its size.
        REACH: f64 = 0.1;
        /// Steps of inverse iteration towards the lowest curvature.
        POWER_STEPS: usize = 60;
        /// For flat directions: the shift that keeps the matrix regular …
        FLAT_SHIFT: f64 = 1e-6;
        /// … and the steps of inverse iteration.
        FLAT_STEPS: usize = 4;
        /// A flat direction is another than those found where > INDEPENDENT of it is beyond their span.
        INDEPENDENT: f64 = 1e-3;
        /// Rows of more free variables than this are not narrow.
        WIDEST: usize = 8;
        /// Fewer variables and rows are tested as a whole.
        FEWEST: usize = 2000;
    }

    /// Finite steps along flat directions.
    higher_order {
        /// |vᵀSv| ≤ FLAT·√(r/ε)·|v|²: followed beyond second order, r being the slope that is left of what is accepted, ε, and no less than NOISE: an
        /// inflection of f''' ≤ 50 hides where f''² ≤ 2·50·r.
        FLAT: f64 = 1e-2;
        /// Lengths in sizes; those beyond one where all is level to the last digits up to there.
        STEPS: [f64; 15] = [1e-4, 3e-4, 1e-3, 3e-3, 1e-2, 3e-2, 0.1, 0.3, 1.0, 10.0, 1e2, 1e3, 1e4, 1e5, 1e6];
        /// Chord steps back to the limits at each.
        CORRECTIONS: usize = 8;
        /// … until they are ≤ SETTLED sizes …
        SETTLED: f64 = 1e-12;
        /// … or > SHRINKING times the one before.
        SHRINKING: f64 = 0.5;
        /// Directions followed at the most …
        DIRECTIONS: usize = 24;
        /// … and the sum of orders of the systems solved for them.
        WORK: usize = 20_000;
        /// κ·step ≤ NEAR·optimality, else another valley's: an inflection r that hides within the accepted slope, ½r·δ² ≤ optimality,
        /// shows κ = r·δ and falls from 3δ on, κ·step ≤ 6·optimality; steps grow 3⅓-fold.
        NEAR: f64 = 20.0;
        /// Where a nearly weakly active limit pushes back, falls beyond this many sizes are another valley's.
        BEYOND_A_LIMIT: f64 = 1e-3;
        /// Limits nearer than this are left or kept by a step, and corrections do not run against them.
        BESIDE: f64 = 1e-3;
        /// Rounding of the objective and of rows on their limits, in units of σ.
        NOISE: f64 = 1e-10;
        /// What corrections towards the rows leave, in units of their slopes.
        CORRECTED: f64 = 1e-10;
        /// Directions told are so many times the way found: second tries start at a tenth of them.
        STRETCH: f64 = 10.0;
    }

    /// Newton's own steps from a point that a deceptive measure calls stationary.
    newton {
        /// Steps taken.
        STEPS: usize = 40;
        /// ln(length(k)/length(k + 1)) > SHORTENING on average where they end: towards x^p = 0 it is 1/(p − 1), towards exp(−x) → 0 nothing.
        SHORTENING: f64 = 5.7e-3;
        /// … and half as much, or SOON_SHORTENING, among the first SOON steps where they lead nowhere else.
        SOON: usize = 8;
        /// See SOON.
        SOON_SHORTENING: f64 = 2.8e-2;
        /// Steps ≤ LENGTH sizes are what the accepted slope and rounding make.
        LENGTH: f64 = 1e-14;
        /// A variable seen at the point has moved where it changed by > MOVED·d_j: the accepted slope leaves 1e−4.
        MOVED: f64 = 1e-3;
        /// f has fallen by more than LOWER·|f| …
        LOWER: f64 = 1e-3;
        /// … and by more than NOISE times what the last digits of x make of it: lower.
        NOISE: f64 = 100.0;
        /// A fall ≥ NEARLY_ALL·|f|: the minimum may be 0, and the share says nothing.
        NEARLY_ALL: f64 = 0.99;
    }

    /// Variables that run away.
    runaway {
        /// Level to the last digit BESIDE·d_j about the point, both ways, all derivatives 0: an asymptote (x^p is so for p > 107 only).
        BESIDE: f64 = 1e-3;
        /// … or so about one that is far from where its variables come from.
        NEARER: [f64; 3] = [1e-6, 1e-9, 1e-12];
        /// Level, beside last digits, at all of x + ONWARDS·(x − start): a minimum of even order bends up there as much as it did at the start.
        ONWARDS: [f64; 4] = [0.25, 0.5, 0.75, 1.0];
        /// |vᵀSv| ≤ FLAT·|v|²: followed outwards.
        FLAT: f64 = 1e-3;
        /// Flat directions looked at.
        DIRECTIONS: usize = 12;
        /// Variables followed at the most.
        FOLLOWED: usize = 12;
        /// Variables followed because they are so far from the start …
        OUTWARDS: usize = 3;
        /// … |x_j − start_j| > FAR·size.
        FAR: f64 = 1e3;
        /// Gradients, largest entry 1, that differ by ≤ PARALLEL are parallel.
        PARALLEL: f64 = 1e-9;
        /// Variables and rows up to which the others follow: thousands of dense steps of order N, N³ operations each.
        LARGEST: usize = 120;
        /// Above this order flat directions are those of single variables.
        LARGEST_FOR_DIRECTIONS: usize = 2_000;
    }

    /// Variables that linear rows keep from going on for ever.
    bounded {
        /// Coefficients ≤ LEAST·(the largest of the row) may be what rounding has left of 0.
        LEAST: f64 = 1e-12;
    }

    /// Proofs that no point is feasible.
    infeasibility {
        /// Farkas: variables are followed to REACH·size, where the tolerance of the rows' terms hides what those at x could show.
        REACH: f64 = 1e7;
        /// A variable within TOUCH·size of a bound rests on it.
        TOUCH: f64 = 1e-6;
        /// Steps of conjugate gradients towards multipliers that balance.
        STEPS: usize = 60;
        /// Rows and variables up to which contradicting multipliers are sought without a solver: one sparse factorisation for some changes of the active set each.
        LARGEST: usize = 2_000;
        /// Propagation: limits and bounds give way by EASE·tolerance of the magnitudes around them, so that no point within it is ruled out.
        EASE: f64 = 4.0;
        /// Sweeps over all rows.
        SWEEPS: usize = 10;
        /// Boxes implied by linear rows: sweeps, …
        BOX_SWEEPS: usize = 12;
        /// … and the slack of every row, relative to the magnitudes it is summed from: far more than rounding.
        SLACK: f64 = 1e-9;
    }

    /// Rounding of the objective.
    rounding {
        /// Last digits by which x is moved to see what rounding makes of f.
        DIGITS: [f64; 4] = [-5.0, -2.0, 3.0, 7.0];
    }
}

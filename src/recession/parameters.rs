//! The numbers of the ways outwards, with the inequality each stands in (docs/certificate.md, «Does the objective fall for ever?»).

use crate::math::parameters::parameters;

parameters! {
    /// Values and what rounding makes of them.
    height {
        /// A change ≤ ROUNDINGS·|f| is rounding.
        ROUNDINGS: f64 = 64.0 * f64::EPSILON;
        /// Last digits by which a place is moved to see what rounding makes of a value.
        DIGITS: [f64; 8] = [-7.0, -5.0, -3.0, -2.0, 2.0, 3.0, 5.0, 7.0];
        /// fall(k + 1) ≥ EVEN·fall(k), decade by decade: without end. −ln t falls alike, tᵖ by 10ᵖ times as much; 1/ln t by less up to the tenth.
        EVEN: f64 = 0.9;
        /// Falls at the end of a way that must be even or growing.
        LAST: usize = 4;
    }

    /// Newton steps to the floor of a valley.
    floor {
        /// Steps at each place.
        CORRECTIONS: usize = 12;
        /// A step ≤ SETTLED, relative to the variables, ends the corrections.
        SETTLED: f64 = 1e-10;
        /// Regularisation of the Hessian's diagonal, relative to the magnitudes of its row in units of the sizes …
        PROXIMAL: f64 = 1e-10;
        /// … and of rows that are dependent.
        DUAL: f64 = 1e-14;
        /// The same where the steps are to stay at a stationary point: the accepted slope of 1e−6 moves it by 1e−3 at the most.
        DAMPED: f64 = 1e-3;
        /// Curvature ≤ LEAST is what an underflow has left of it.
        LEAST: f64 = f64::MIN_POSITIVE / f64::EPSILON;
    }

    /// Valleys, followed by doubling distances.
    valley {
        /// Doublings of the distance: a rise within a thousandth of a size is a minimum's own, 2^100 sizes are beyond what a model means.
        DOUBLINGS: std::ops::Range<i32> = -10..100;
        /// Doublings beyond what is known of a variable's size that must go well before the model may end in an overflow, or be lost in
        /// rounding.
        ENOUGH: i32 = 24;
        /// The same of a point that is out there already: to four times its distance, 2^LEFT_BEHIND·FIRST = 4.
        LEFT_BEHIND: i32 = 4;
        /// The first step, in sizes of the variable.
        FIRST: f64 = 0.25;
        /// Halvings and doublings of the first step in which an asymptote must have risen on the other side.
        BACK: std::ops::Range<i32> = -6..40;
        /// Decades towards zero, down from the largest numbers there are.
        DECADES: i32 = 310;
        /// Halvings of the way back to where a variable comes from: all that numbers tell apart.
        HALVES: i32 = 54;
        /// Halvings between a place with a value and one without.
        BISECTIONS: usize = 60;
        /// A place within BESIDE·d_j of the point is the same but for rounding and what is accepted of rows.
        BESIDE: f64 = 1e-3;
        /// Halvings of the way to a floor at which it must not rise: at a strict minimum it does however near.
        HALVINGS: std::ops::RangeInclusive<i32> = 1..=10;
        /// Doublings between heights that are compared for endlessness: nearly a decade.
        DECADE: usize = 3;
    }

    /// Straight ways, power curves, ways to an edge.
    ways {
        /// Decades a way is followed: a minimum within 10^DECADES sizes is found on it.
        DECADES: i32 = 30;
        /// Decades that must go well before the model may end in an overflow, or be lost in rounding.
        ENOUGH: usize = 7;
        /// Rounding > LOST·|limit| leaves nothing of a row's limit.
        LOST: f64 = 1e-2;
        /// Places on the way back to where the variables come from.
        BACK: i32 = 12;
        /// Decades of a way towards an edge.
        EDGE_DECADES: i32 = 14;
        /// How far beyond the point an edge is looked for.
        BEYOND: f64 = 1e-3;
        /// Halvings between a place with a value and one without.
        BISECTIONS: usize = 60;
        /// Variables tried one by one at the most.
        TRIED: usize = 200;
        /// Components ≤ NOISE·(the largest) of a direction are none.
        NOISE: f64 = 1e-6;
        /// |x_j|/size ≤ CHANGED: no power; …
        CHANGED: f64 = 10.0;
        /// … one must be > FAR.
        FAR: f64 = 1e3;
    }
}

//! Member axes: where a section's height points.

use super::algebra::Algebra;

/// Members whose horizontal part is smaller than this share of their length count as vertical: there «up» is x, not z.
const VERTICAL: f64 = 1e-3;

/// A direction for the section's height is parallel to the member where |e1 × up| is below this share of |up|.
const PARALLEL: f64 = 1e-6;

/// Which rule gives a member's axes; chosen once, at the starting coordinates, so that the axes are smooth functions of them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Rule {
    /// The section's height points as nearly as it can in this direction.
    Towards([f64; 3]),
    /// In the plane x–z: the member's left normal.
    LeftInXz,
    /// In the plane x–y: the member's left normal.
    LeftInXy,
}

impl Rule {
    /// The default of a member in space along this vector: z up; x for vertical members.
    ///
    /// ```
    /// use ribopt::structure::axes::Rule;
    /// assert_eq!(Rule::in_space([0.0, 0.0, 2.0]), Rule::Towards([1.0, 0.0, 0.0]));
    /// assert_eq!(Rule::in_space([1.0, 0.0, 1.0]), Rule::Towards([0.0, 0.0, 1.0]));
    /// ```
    pub fn in_space(along: [f64; 3]) -> Rule {
        let length = along.iter().map(|value| value * value).sum::<f64>().sqrt();
        match along[0].hypot(along[1]) < VERTICAL * length {
            true => Rule::Towards([1.0, 0.0, 0.0]),
            false => Rule::Towards([0.0, 0.0, 1.0]),
        }
    }

    /// Whether the rule gives no axes to a member along this vector.
    pub fn is_parallel(self, along: [f64; 3]) -> bool {
        let Rule::Towards(up) = self else { return false };
        let size = |v: [f64; 3]| v.iter().map(|value| value * value).sum::<f64>().sqrt();
        let normal = super::algebra::Numbers.cross(along, up);
        size(normal) < PARALLEL * size(along) * size(up)
    }
}

/// A member's length and its unit vectors x, y, z in global axes.
#[derive(Debug, Clone, Copy)]
pub struct Frame<N> {
    /// Length.
    pub length: N,
    /// e1, e2, e3.
    pub axes: [[N; 3]; 3],
}

/// The frame of a member along a vector, turned by `roll` degrees about itself: e3 = up − (up·e1)e1 normalised, e2 = e3 × e1, then
/// e2' = c·e2 + s·e3, e3' = −s·e2 + c·e3.
pub fn frame<A: Algebra>(algebra: &mut A, along: [A::Number; 3], rule: Rule, roll: f64) -> Frame<A::Number> {
    let (e1, length) = algebra.normalised(along);
    let e3 = match rule {
        Rule::Towards(up) => {
            let up = up.map(|component| algebra.constant(component));
            let (minus, share) = (algebra.constant(-1.0), algebra.dot(up, e1));
            let share = algebra.multiply(minus, share);
            let normal = algebra.plus_scaled(up, share, e1);
            algebra.normalised(normal).0
        }
        Rule::LeftInXz => [algebra.scale(-1.0, e1[2]), algebra.constant(0.0), e1[0]],
        Rule::LeftInXy => [algebra.scale(-1.0, e1[1]), e1[0], algebra.constant(0.0)],
    };
    let e2 = algebra.cross(e3, e1);
    if roll == 0.0 {
        return Frame { length, axes: [e1, e2, e3] };
    }
    let (s, c) = roll.to_radians().sin_cos();
    let zero = [algebra.constant(0.0); 3];
    let mut turned = |first: f64, second: f64| {
        let (first, second) = (algebra.constant(first), algebra.constant(second));
        let part = algebra.plus_scaled(zero, first, e2);
        algebra.plus_scaled(part, second, e3)
    };
    Frame { length, axes: [e1, turned(c, s), turned(-s, c)] }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::structure::algebra::Numbers;

    #[test]
    fn axes_are_orthonormal_and_right_handed() {
        for (along, rule, roll) in [
            ([3.0, -1.0, 2.0], Rule::in_space([3.0, -1.0, 2.0]), 0.0),
            ([0.0, 0.0, 2.0], Rule::in_space([0.0, 0.0, 2.0]), 30.0),
            ([1.0, 0.0, 2.0], Rule::LeftInXz, 0.0),
            ([1.0, 2.0, 0.0], Rule::LeftInXy, 90.0),
        ] {
            let frame = frame(&mut Numbers, along, rule, roll);
            for i in 0..3 {
                for j in 0..3 {
                    let product = Numbers.dot(frame.axes[i], frame.axes[j]);
                    assert!((product - f64::from(u8::from(i == j))).abs() < 1e-15, "{i} {j} {product}");
                }
            }
            let third = Numbers.cross(frame.axes[0], frame.axes[1]);
            assert!(third.iter().zip(frame.axes[2]).all(|(a, b)| (a - b).abs() < 1e-15));
        }
    }

    #[test]
    fn a_level_member_has_its_height_up() {
        let frame = frame(&mut Numbers, [2.0, 0.0, 0.0], Rule::in_space([2.0, 0.0, 0.0]), 0.0);
        assert_eq!((frame.length, frame.axes[1], frame.axes[2]), (2.0, [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]));
    }
}

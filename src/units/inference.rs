//! Dimensions of what is written without a unit: linear equations over ℚ.
//!
//! The dimension of a product is a linear form in the exponents of what it is made of; sums and comparisons equate two forms. Forms are
//! eliminated as they come; the first equation that cannot hold beside the earlier ones is told at its place.

use std::collections::BTreeMap;

use num_traits::{CheckedAdd, CheckedMul, CheckedSub, Zero};

use super::dimension::Dimension;
use super::ratio::Ratio;

/// A dimension that may depend on unknown ones: Σ power·unknown, times what is known.
#[derive(Debug, Clone, PartialEq)]
pub struct Form {
    powers: BTreeMap<usize, Ratio>,
    known: Dimension,
}

/// The equations so far.
#[derive(Debug, Default)]
pub struct Inference {
    count: usize,
    /// An unknown in terms of others of lower number.
    solved: BTreeMap<usize, Form>,
}

impl From<Dimension> for Form {
    fn from(known: Dimension) -> Form {
        Form { powers: BTreeMap::new(), known }
    }
}

impl Form {
    /// Of a product with `other` raised to a power; `None` where exponents do not fit.
    pub fn times(&self, other: &Form, power: Ratio) -> Option<Form> {
        let known = self.known.times(other.known.power(power)?)?;
        let mut powers = self.powers.clone();
        for (unknown, exponent) in &other.powers {
            let raised = exponent.checked_mul(&power)?;
            let sum = powers.get(unknown).map_or(Some(raised), |own| own.checked_add(&raised))?;
            if sum.is_zero() {
                powers.remove(unknown)
            } else {
                powers.insert(*unknown, sum)
            };
        }
        Some(Form { powers, known })
    }

    /// The dimension, where nothing unknown is left.
    pub fn dimension(&self) -> Option<Dimension> {
        self.powers.is_empty().then_some(self.known)
    }
}

impl Inference {
    /// Another unknown.
    pub fn unknown(&mut self) -> Form {
        self.count += 1;
        Form { powers: BTreeMap::from([(self.count - 1, Ratio::ONE)]), known: Dimension::NONE }
    }

    /// The form with everything put in that is known by now.
    pub fn reduced(&self, form: &Form) -> Option<Form> {
        let mut form = form.clone();
        // Solved forms name lower numbers only: from the highest down, each is met once.
        let mut below = usize::MAX;
        while let Some((&unknown, &power)) = form.powers.range(..below).next_back() {
            below = unknown;
            if let Some(solved) = self.solved.get(&unknown) {
                form.powers.remove(&unknown);
                form = form.times(solved, power)?;
            }
        }
        Some(form)
    }

    /// Adds the equation that both are the same; by what they differ where that cannot be.
    ///
    /// # Errors
    /// The dimension of left/right.
    pub fn equal(&mut self, left: &Form, right: &Form) -> Result<(), Dimension> {
        // Exponents that do not fit belong to no formula of this world: nothing is said of them.
        let difference = left.times(right, Ratio::from_integer(-1)).and_then(|form| self.reduced(&form));
        let Some(mut form) = difference else { return Ok(()) };
        let Some((unknown, power)) = form.powers.pop_last() else {
            return if form.known.is_none() { Ok(()) } else { Err(form.known) };
        };
        // power·unknown + rest = 0
        let factor = Ratio::ZERO.checked_sub(&power).filter(|power| !power.is_zero()).map(|power| power.recip());
        let solved = factor.and_then(|factor| Form::from(Dimension::NONE).times(&form, factor));
        if let Some(solved) = solved {
            self.solved.insert(unknown, solved);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn unknown_dimensions_follow_from_equations() {
        let mut inference = Inference::default();
        let (force, area, stress) = (inference.unknown(), inference.unknown(), inference.unknown());
        let minus = Ratio::from_integer(-1);
        // force/area = stress; area = length²; stress·length = 2 forces per length
        inference.equal(&force.times(&area, minus).unwrap(), &stress).unwrap();
        inference.equal(&area, &Dimension::whole([2, 0, 0, 0]).into()).unwrap();
        inference.equal(&stress, &Dimension::STRESS.into()).unwrap();
        assert_eq!(inference.reduced(&force).unwrap().dimension(), Some(Dimension::FORCE));
        assert_eq!(inference.equal(&force, &Dimension::MOMENT.into()), Err(Dimension::whole([-1, 0, 0, 0])));
    }

    #[test]
    fn roots_are_over_the_rationals() {
        let mut inference = Inference::default();
        let side = inference.unknown();
        let cube = Form::from(Dimension::NONE).times(&side, Ratio::from_integer(3)).unwrap();
        inference.equal(&cube, &Dimension::LENGTH.into()).unwrap();
        let third = Dimension::LENGTH.power(Ratio::new(1, 3)).unwrap();
        assert_eq!(inference.reduced(&side).unwrap().dimension(), Some(third));
    }
}

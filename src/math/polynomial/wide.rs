//! Complex numbers of many bits, just enough of them for roots.

use dashu_float::FBig;
use dashu_float::round::mode::HalfEven;

/// A binary float of as many bits as asked for.
pub(super) type Wide = FBig<HalfEven, 2>;

/// A complex number of two [`Wide`]s.
#[derive(Debug, Clone)]
pub(super) struct WideComplex {
    pub(super) re: Wide,
    pub(super) im: Wide,
}

/// A finite number with `bits` bits; zero for what is not finite (callers have refused that).
pub(super) fn wide(value: f64, bits: usize) -> Wide {
    Wide::try_from(value).unwrap_or(Wide::ZERO).with_precision(bits).value()
}

/// 2 to the power of a whole number.
pub(super) fn power_of_two(exponent: isize, bits: usize) -> Wide {
    Wide::from_parts(1.into(), exponent).with_precision(bits).value()
}

impl WideComplex {
    pub(super) fn add_real(&self, real: &Wide) -> Self {
        WideComplex { re: &self.re + real, im: self.im.clone() }
    }

    pub(super) fn add(&self, other: &Self) -> Self {
        WideComplex { re: &self.re + &other.re, im: &self.im + &other.im }
    }

    pub(super) fn subtract(&self, other: &Self) -> Self {
        WideComplex { re: &self.re - &other.re, im: &self.im - &other.im }
    }

    pub(super) fn multiply(&self, other: &Self) -> Self {
        WideComplex { re: &self.re * &other.re - &self.im * &other.im, im: &self.re * &other.im + &self.im * &other.re }
    }

    /// The quotient; `None` where the divisor is zero.
    pub(super) fn divide(&self, other: &Self) -> Option<Self> {
        let square = other.square();
        if square == Wide::ZERO {
            return None;
        }
        let conjugate = WideComplex { re: other.re.clone(), im: -other.im.clone() };
        let product = self.multiply(&conjugate);
        Some(WideComplex { re: product.re / &square, im: product.im / &square })
    }

    /// |z|²
    pub(super) fn square(&self) -> Wide {
        &self.re * &self.re + &self.im * &self.im
    }
}

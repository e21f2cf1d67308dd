//! Lengths of which the parts of sections are products.

/// A length made of a form's dimensions d: `scale · (d[plus] − factor · d[minus])`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Length {
    /// What the whole is multiplied by.
    pub scale: f64,
    /// Position of the first dimension.
    pub plus: usize,
    /// Factor and position of the dimension taken off. Only the second length of a part may have one.
    pub minus: Option<(f64, usize)>,
}

impl Length {
    /// The dimension at this position.
    pub const fn of(plus: usize) -> Length {
        Length { scale: 1.0, plus, minus: None }
    }

    /// Twice the dimension at this position.
    pub const fn twice(plus: usize) -> Length {
        Length { scale: 2.0, plus, minus: None }
    }

    /// The dimension at `plus` less `factor` times the one at `minus`.
    pub const fn difference(plus: usize, factor: f64, minus: usize) -> Length {
        Length { scale: 1.0, plus, minus: Some((factor, minus)) }
    }
}

//! A panel with two axes, each linear or logarithmic.

use super::canvas::{Canvas, Ink};
use crate::report::number::significant;

/// Values from one end of an axis to the other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Scale {
    from: f64,
    to: f64,
    logarithmic: bool,
    /// The ends are given, not chosen for the values.
    exact: bool,
}

impl Scale {
    /// From the least to the greatest of these values, with some room; from 0 to 1 without any.
    pub fn linear(values: impl Iterator<Item = f64>) -> Scale {
        let (low, high) = range(values).unwrap_or((0.0, 1.0));
        let room = if high > low { 0.05 * (high - low) } else { 0.5 * high.abs().max(1e-12) };
        Scale { from: low - room, to: high + room, logarithmic: false, exact: false }
    }

    /// From exactly here to there.
    pub fn between(from: f64, to: f64) -> Scale {
        Scale { from, to: if to > from { to } else { from + 1.0 }, logarithmic: false, exact: true }
    }

    /// Whole powers of ten around these values.
    pub fn logarithmic(values: impl Iterator<Item = f64>) -> Scale {
        let (low, high) = range(values.filter(|value| *value > 0.0)).unwrap_or((0.1, 1.0));
        let (from, to) = (low.log10().floor(), high.log10().ceil());
        Scale { from, to: if to > from { to } else { from + 1.0 }, logarithmic: true, exact: false }
    }

    /// Where a value stands, from 0 to 1; what lies beyond the axis stands at its end, NaN nowhere.
    pub fn share(&self, value: f64) -> f64 {
        if value.is_nan() {
            return value;
        }
        let value = if self.logarithmic { value.max(f64::MIN_POSITIVE).log10() } else { value };
        ((value - self.from) / (self.to - self.from)).clamp(0.0, 1.0)
    }

    /// Round values, five or so.
    fn ticks(&self) -> Vec<f64> {
        if self.logarithmic {
            let step = ((self.to - self.from) / 6.0).ceil().max(1.0);
            let count = ((self.to - self.from) / step).floor() as i32;
            return (0..=count).map(|k| 10f64.powf(self.from + f64::from(k) * step)).collect();
        }
        let rough = (self.to - self.from) / 5.0;
        let power = 10f64.powf(rough.log10().floor());
        let step = [1.0, 2.0, 5.0, 10.0].into_iter().map(|m| m * power).find(|step| *step >= rough).unwrap_or(power);
        let first = (self.from / step).ceil();
        let round = (0..20).map(|k| (first + f64::from(k)) * step).take_while(|tick| *tick <= self.to + 1e-9 * step);
        let mut ticks: Vec<f64> = round.collect();
        if self.exact {
            // The ends are what the axis is about; a round number too near to one gives way.
            ticks.retain(|tick| *tick - self.from > 0.4 * step && self.to - *tick > 0.4 * step);
            ticks.insert(0, self.from);
            ticks.push(self.to);
        }
        ticks
    }

    /// Units of the axis.
    fn span(&self) -> f64 {
        self.to - self.from
    }
}

/// The least and the greatest of the values that are finite.
pub(super) fn range(values: impl Iterator<Item = f64>) -> Option<(f64, f64)> {
    values.filter(|value| value.is_finite()).fold(None, |found, value| match found {
        None => Some((value, value)),
        Some((low, high)) => Some((low.min(value), high.max(value))),
    })
}

/// A panel on the sheet.
pub(super) struct Panel {
    pub left: f64,
    pub top: f64,
    pub width: f64,
    pub height: f64,
    pub x: Scale,
    pub y: Scale,
}

impl Panel {
    /// Where a point stands on the sheet; NaN stays NaN.
    pub fn at(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [self.left + self.width * self.x.share(x), self.top + self.height * (1.0 - self.y.share(y))]
    }

    /// How many times as large as along the panel things are drawn across it.
    pub fn exaggeration(&self) -> f64 {
        (self.height / self.y.span()) / (self.width / self.x.span())
    }

    /// As [`Panel::draw`], with the whole extent on the vertical axis, half of which lies on either side of 0.
    pub fn draw_extent(&self, canvas: &mut Canvas, x_name: &str, y_name: &str) {
        self.drawn(canvas, x_name, y_name, |value| significant(2.0 * value.abs(), 3));
    }

    /// Grid, ticks and names of the axes.
    pub fn draw(&self, canvas: &mut Canvas, x_name: &str, y_name: &str) {
        self.drawn(canvas, x_name, y_name, |value| significant(value, 3));
    }

    /// Grid, ticks and name of the horizontal axis alone.
    pub fn draw_along(&self, canvas: &mut Canvas, x_name: &str) {
        let (right, bottom) = (self.left + self.width, self.top + self.height);
        for tick in self.x.ticks() {
            let x = self.left + self.width * self.x.share(tick);
            canvas.line([x, self.top, x, bottom], Ink::Faint);
            canvas.note(x, bottom + 15.0, "middle", &significant(tick, 3));
        }
        canvas.line([self.left, bottom, right, bottom], Ink::Middle);
        canvas.text((self.left + right) / 2.0, bottom + 31.0, "middle", x_name);
    }

    fn drawn(&self, canvas: &mut Canvas, x_name: &str, y_name: &str, label: impl Fn(f64) -> String) {
        let (right, bottom) = (self.left + self.width, self.top + self.height);
        for tick in self.y.ticks() {
            let y = self.top + self.height * (1.0 - self.y.share(tick));
            canvas.line([self.left, y, right, y], Ink::Faint);
            canvas.note(self.left - 6.0, y + 4.0, "end", &label(tick));
        }
        self.draw_along(canvas, x_name);
        canvas.line([self.left, self.top, self.left, bottom], Ink::Middle);
        canvas.upright(self.left - 52.0, (self.top + bottom) / 2.0, y_name);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_inside() {
        assert_eq!(Scale::between(0.0, 1.0).ticks(), [0.0, 0.2, 0.4, 0.6000000000000001, 0.8, 1.0]);
        assert_eq!(Scale::between(0.0, 12_000.0).ticks(), [0.0, 5000.0, 12_000.0]);
        assert_eq!(Scale::between(1.0, 17.0).ticks(), [1.0, 5.0, 10.0, 17.0]);
        let decades = Scale::logarithmic([3e-9, 40.0].into_iter());
        assert_eq!(decades.ticks().len(), 6);
        assert_eq!((decades.share(1e-9), decades.share(100.0), decades.share(0.0)), (0.0, 1.0, 0.0));
        assert!(decades.share(f64::NAN).is_nan());
    }

    #[test]
    fn no_values_and_one_value_still_make_an_axis() {
        for scale in [Scale::linear([].into_iter()), Scale::linear([2.0].into_iter()), Scale::logarithmic([0.0].into_iter())] {
            assert!(scale.to > scale.from && !scale.ticks().is_empty(), "{scale:?}");
        }
    }
}

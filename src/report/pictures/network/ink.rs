//! What the colours of a network say.

use std::fmt::Write as _;

use super::super::canvas::Ink;
use super::Load;
use crate::mesh::shade::{GREY, shade};
use crate::mesh::solids::SizedRib;
use crate::report::About;
use crate::report::number::with_unit_power;

/// Steps of the scale.
pub const STEPS: usize = 20;
/// Shares within this range of one another look the same.
const ALIKE: f64 = 0.05;
/// More limits than colours of curves cannot be told apart.
const KINDS: usize = 8;
/// Dark grounds swallow the dark end of the scale.
const DARKEST: f64 = 0.85;

/// What colours show.
pub enum Coloured {
    /// How far each rib is used.
    Share,
    /// Which of these limits uses it most.
    Limits(Vec<String>),
    /// Areas of sections between these two.
    Area([f64; 2]),
}

/// One colour, on white and on a dark ground.
#[derive(Debug, Clone, Copy)]
pub enum Tint {
    /// Of the scale.
    Step(usize),
    /// Of the limits.
    Kind(usize),
    /// Above 1.
    Over,
    /// No number.
    Unknown,
}

impl Coloured {
    /// What tells most of these ribs.
    pub fn of(ribs: &[SizedRib], loads: &[Load]) -> Coloured {
        let [least, most] = range(loads.iter().filter_map(|load| load.share));
        // Above 1 something is wrong, and red must show it.
        if most - least > ALIKE || most > 1.0 + 1e-6 {
            return Coloured::Share;
        }
        let mut names: Vec<String> = Vec::new();
        for load in loads.iter().filter(|load| load.share.is_some()) {
            if names.len() <= KINDS && !names.contains(&load.limit) {
                names.push(load.limit.clone());
            }
        }
        if (2..=KINDS).contains(&names.len()) {
            return Coloured::Limits(names);
        }
        let areas = range(ribs.iter().map(SizedRib::mean_area));
        if areas[1] > areas[0] * (1.0 + 1e-9) { Coloured::Area(areas) } else { Coloured::Share }
    }

    /// For the heading.
    pub fn what(&self) -> &'static str {
        match self {
            Coloured::Share => "how far their limits are used",
            Coloured::Limits(_) => "the limit that governs (all are used alike)",
            Coloured::Area(_) => "the area of their sections (all are used alike)",
        }
    }

    /// Both ends of the scale.
    pub fn scale(&self, about: &About) -> String {
        match self {
            Coloured::Area(ends) => {
                let [low, high] = ends.map(|area| with_unit_power(area, about.unit("length"), 2));
                format!("section area {low} to {high}")
            }
            _ => "used 0 to 100 %".into(),
        }
    }

    /// Of a rib.
    pub fn tint(&self, rib: &SizedRib, load: &Load) -> Tint {
        match self {
            Coloured::Share => load.share.map_or(Tint::Unknown, step),
            Coloured::Limits(names) => {
                let at = load.share.and_then(|_| names.iter().position(|name| *name == load.limit));
                at.map_or(Tint::Unknown, Tint::Kind)
            }
            Coloured::Area([low, high]) => step(((rib.mean_area() - low) / (high - low)).min(1.0)),
        }
    }
}

fn range(values: impl Iterator<Item = f64>) -> [f64; 2] {
    let finite = values.filter(|value| value.is_finite());
    finite.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| [low.min(value), high.max(value)])
}

fn step(value: f64) -> Tint {
    match value {
        value if value.is_nan() => Tint::Unknown,
        value if value > 1.0 + 1e-6 => Tint::Over,
        value => Tint::Step(((value.clamp(0.0, 1.0) * STEPS as f64) as usize).min(STEPS - 1)),
    }
}

impl Tint {
    /// On white.
    pub fn colour(self) -> String {
        match self {
            Tint::Step(k) => hexadecimal(shade(middle(k))),
            Tint::Kind(k) => Ink::Curve(k).colours()[0].into(),
            Tint::Over => hexadecimal(shade(2.0)),
            Tint::Unknown => hexadecimal(GREY),
        }
    }

    /// The class that dark grounds recolour.
    pub fn class(self) -> String {
        match self {
            Tint::Step(k) => format!("u{k}"),
            Tint::Kind(k) => format!("{} a", Ink::Curve(k).class()),
            Tint::Over => "over".into(),
            Tint::Unknown => "grey".into(),
        }
    }
}

/// On dark grounds the scale runs the other way, so that what is used fully stands out on these too.
pub fn styles() -> String {
    let mut css = String::from("@media (prefers-color-scheme: dark) {\n.over { fill: #ff6b6b }\n");
    for k in 0..STEPS {
        let colour = hexadecimal(shade(DARKEST * (1.0 - middle(k))));
        // Writing to a string cannot fail.
        let _ = writeln!(css, ".u{k} {{ fill: {colour} }}");
    }
    css.push_str("}\n");
    css
}

fn middle(k: usize) -> f64 {
    (k as f64 + 0.5) / STEPS as f64
}

fn hexadecimal([r, g, b]: [u8; 3]) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

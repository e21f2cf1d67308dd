//! SciPy's values, see tests/data/make_reference.py.

use serde::Deserialize;
use std::collections::BTreeMap;

#[derive(Deserialize)]
pub(super) struct Interpolation {
    pub x: Vec<f64>,
    pub y: Vec<f64>,
    pub at: Vec<f64>,
    pub interpolation: BTreeMap<String, Spline>,
    /// Values and three derivatives by end condition.
    pub cubic: BTreeMap<String, Vec<Vec<f64>>>,
    /// By number of points and end condition: values at seven points.
    pub few: BTreeMap<String, BTreeMap<String, Vec<f64>>>,
    pub fit: Fit,
    pub bicubic: Bicubic,
}

#[derive(Deserialize)]
pub(super) struct Spline {
    pub knots: Vec<f64>,
    pub coefficients: Vec<f64>,
    pub values: Vec<f64>,
}

#[derive(Deserialize)]
pub(super) struct Fit {
    pub x: Vec<f64>,
    pub y: Vec<f64>,
    pub knots: Vec<f64>,
    pub coefficients: Vec<f64>,
}

#[derive(Deserialize)]
pub(super) struct Bicubic {
    pub x: Vec<f64>,
    pub y: Vec<f64>,
    pub z: Vec<Vec<f64>>,
    pub px: Vec<f64>,
    pub py: Vec<f64>,
    pub value: Vec<f64>,
    pub dx: Vec<f64>,
    pub dy: Vec<f64>,
}

pub(super) fn reference() -> Interpolation {
    serde_json::from_str(include_str!("../../tests/data/interpolation.json")).unwrap()
}

//! The study file as it is written.

use std::collections::BTreeMap;

use serde::Deserialize;
use serde::de::{Deserializer, Error as _};
use toml::Spanned;

/// A study file.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Declaration {
    pub problem: Spanned<String>,
    #[serde(default)]
    pub vary: BTreeMap<Spanned<String>, Axis>,
    #[serde(default)]
    pub design: Design,
    #[serde(default)]
    pub report: Report,
    pub pareto: Option<Spanned<Pareto>>,
    #[serde(default)]
    pub run: Run,
}

/// What one name takes on.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Axis {
    pub from: Option<Spanned<Number>>,
    pub to: Option<Spanned<Number>>,
    pub count: Option<Spanned<u32>>,
    pub values: Option<Vec<Spanned<Number>>>,
    #[serde(default)]
    pub scale: Scale,
}

/// A number, or a constant expression of the problem.
#[derive(Debug, Clone, Deserialize)]
#[serde(untagged)]
pub(super) enum Number {
    Given(f64),
    Text(String),
}

/// How values between two ends are spaced.
#[derive(Debug, Clone, Copy, Default, PartialEq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Scale {
    #[default]
    Linear,
    Log,
}

/// `[design]`
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Design {
    #[serde(default)]
    pub method: Method,
    pub samples: Option<Spanned<u32>>,
    #[serde(default)]
    pub seed: u64,
    pub table: Option<Spanned<String>>,
}

/// How points are chosen.
#[derive(Debug, Clone, Copy, Default, PartialEq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum Method {
    #[default]
    Grid,
    Zip,
    List,
    Centered,
    LatinHypercube,
    Sobol,
    Random,
}

impl Method {
    /// Whether it draws as many points as are asked for.
    pub fn draws(self) -> bool {
        matches!(self, Method::LatinHypercube | Method::Sobol | Method::Random)
    }
}

/// `[report]`
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Report {
    #[serde(default)]
    pub quantities: BTreeMap<Spanned<String>, Spanned<String>>,
}

/// `[pareto]`
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Pareto {
    pub minimize: Spanned<Vec<Spanned<String>>>,
    #[serde(default = "usual_points")]
    pub points: Spanned<u32>,
}

fn usual_points() -> Spanned<u32> {
    Spanned::new(0..0, 20)
}

/// `[run]`
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Run {
    pub chain: Option<Spanned<String>>,
    #[serde(default)]
    pub on_failure: OnFailure,
    #[serde(default, deserialize_with = "seconds")]
    pub max_seconds: Option<f64>,
    pub cold_every: Option<Spanned<u32>>,
}

/// What follows a point without a certified answer or a proof that there is none.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum OnFailure {
    /// Its row says so, and the study goes on.
    #[default]
    Record,
    /// After a warm start it is solved once more from the file's start.
    RetryCold,
    /// The study ends.
    Stop,
}

fn seconds<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<f64>, D::Error> {
    let seconds = f64::deserialize(deserializer)?;
    if seconds >= 0.0 { Ok(Some(seconds)) } else { Err(D::Error::custom("seconds are 0 or more")) }
}

//! The reported point: values, bounds, rows.

use std::io::{self, Write};

use serde::{Serialize, Serializer};

use super::super::utilisation::{Place, Table};
use super::super::{Findings, Held, blocks};

/// Values by variable name.
pub(super) struct NamedValues<'a> {
    /// For the names.
    pub findings: &'a Findings<'a>,
    /// The values.
    pub x: &'a [f64],
}

impl Serialize for NamedValues<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.x.iter().enumerate().map(|(j, value)| (self.findings.model.variable_name(j), value)))
    }
}

pub(super) struct BoundsPart<'a>(pub &'a Findings<'a>);

impl Serialize for BoundsPart<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq((0..self.0.model.meta().variables()).map(|j| Bound::of(self.0, j)))
    }
}

pub(super) struct ConstraintsPart<'a>(pub &'a Findings<'a>);

impl Serialize for ConstraintsPart<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq((0..self.0.model.meta().rows()).map(|i| Row::of(self.0, i)))
    }
}

#[derive(Serialize)]
struct Bound {
    name: String,
    /// Of the variable's own numbers.
    #[serde(skip_serializing_if = "Option::is_none")]
    unit: Option<String>,
    active: &'static str,
    multiplier: f64,
    sensitivity: f64,
}

impl Bound {
    fn of(findings: &Findings<'_>, j: usize) -> Bound {
        let Held { side, multiplier, sensitivity } = findings.bound(j);
        let name = findings.model.variable_name(j);
        let unit = findings.about.shown.own_of_variable(&name);
        Bound { name, unit, active: side.as_str(), multiplier, sensitivity }
    }
}

#[derive(Serialize)]
struct Row {
    name: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    unit: Option<String>,
    value: f64,
    lower: f64,
    upper: f64,
    active: &'static str,
    multiplier: f64,
    sensitivity: f64,
    #[serde(flatten)]
    place: PlacePart,
}

/// Where a row looks at the structure; left out where it does not.
#[derive(Serialize, Default)]
pub(super) struct PlacePart {
    #[serde(skip_serializing_if = "Option::is_none")]
    case: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    station: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    point: Option<String>,
}

impl PlacePart {
    pub(super) fn of(place: &Place) -> PlacePart {
        let text = |text: &String| (!text.is_empty()).then(|| text.clone());
        PlacePart { case: text(&place.case), station: place.station, point: text(&place.point) }
    }
}

impl Row {
    fn of(findings: &Findings<'_>, i: usize) -> Row {
        let (meta, held) = (findings.model.meta(), findings.row(i));
        let name = findings.model.row_name(i);
        Row {
            unit: findings.about.shown.own_of_row(&name),
            name,
            value: findings.row_value(i),
            lower: meta.row_lower[i],
            upper: meta.row_upper[i],
            active: held.side.as_str(),
            multiplier: held.multiplier,
            sensitivity: held.sensitivity,
            place: findings.utilisation.and_then(|table| table.place(i)).map(PlacePart::of).unwrap_or_default(),
        }
    }
}

/// What uses every rib of a structure most.
pub(super) struct RibsPart<'a>(pub &'a Table);

impl Serialize for RibsPart<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.0.ribs.iter().map(|(name, most)| RibUse::of(self.0, name, *most)))
    }
}

#[derive(Serialize)]
struct RibUse<'a> {
    rib: &'a str,
    utilisation: Option<f64>,
    governs: Option<&'a str>,
    #[serde(flatten)]
    place: PlacePart,
}

impl<'a> RibUse<'a> {
    fn of(table: &'a Table, rib: &'a str, most: Option<(usize, f64)>) -> RibUse<'a> {
        let declared = most.and_then(|(at, _)| table.constraints.get(table.uses.get(at)?.constraint));
        RibUse {
            rib,
            utilisation: most.map(|(_, share)| share),
            governs: declared.map(|declared| declared.written()),
            place: declared.map(|declared| PlacePart::of(&declared.place)).unwrap_or_default(),
        }
    }
}

/// The three lists as further entries of an object, block by block: `,"variables":{…},"bounds":[…],"constraints":[…]`.
///
/// # Errors
/// Whatever the writer says.
pub(super) fn write_lists(findings: &Findings<'_>, out: &mut dyn Write) -> io::Result<()> {
    let (meta, x) = (findings.model.meta(), &findings.outcome.x);
    out.write_all(b",\"variables\":{")?;
    list(out, x.len(), |j, block| {
        serde_json::to_writer(&mut *block, &findings.model.variable_name(j))?;
        block.push(b':');
        serde_json::to_writer(block, &x[j])
    })?;
    out.write_all(b"},\"bounds\":[")?;
    list(out, meta.variables(), |j, block| serde_json::to_writer(block, &Bound::of(findings, j)))?;
    out.write_all(b"],\"constraints\":[")?;
    list(out, meta.rows(), |i, block| serde_json::to_writer(block, &Row::of(findings, i)))?;
    out.write_all(b"]")
}

fn list(
    out: &mut dyn Write,
    count: usize,
    entry: impl Fn(usize, &mut Vec<u8>) -> serde_json::Result<()> + Sync,
) -> io::Result<()> {
    blocks::write(out, count, |range| {
        let mut block = Vec::new();
        for at in range {
            if at > 0 {
                block.push(b',');
            }
            entry(at, &mut block)?;
        }
        Ok(block)
    })
}

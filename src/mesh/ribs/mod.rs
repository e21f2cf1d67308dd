//! From a rib network to a problem folder: `problem.toml`, `sections.csv`, `ribs.csv` (`[tables]`) and
//! `geometry.csv` (where the ribs lie, for solids and pictures).
//!
//! Every line counts as a simply supported beam under a line load q: its sag at midspan, by the unit-load method
//! ∫ M·m/(E·I) ds, may be at most span/sag_ratio. The integral is `sag` per rib, with 1/I by the trapezoidal rule between
//! its sections. Slenderness, taper and thickness limits come on top.
//!
//! A closed line has no ends to be held at, so it is held at any two opposite points: two beams of half its length S. Where these points are
//! is nobody's choice, so the limit is on the mean over all of them and over both halves: every point of the ring has the
//! mean weight (1/S)·∫ M·m ds = 5S³/384, and the sag is ½·q·5S³/384·∮ ds/(E·I), which does not depend on where the file begins the
//! ring. A uniform ring sags by exactly what each of its halves does as a beam: 5qS⁴/(384EI).

mod folder;
mod kinds;
pub mod structure;
mod text;
mod unit;
mod warnings;

use std::collections::BTreeMap;
use std::io::Write;
use std::path::Path;

use serde::Serialize;

pub use kinds::SectionKind;
pub use unit::Unit;

use super::PolygonMesh;
use super::formats::FormatError;
use super::network::{Network, Rib, write_geometry};
use crate::ribs::law::VolumeLaw;

/// Bounds and start of one dimension, the same at all sections.
#[derive(Debug, Clone, PartialEq)]
pub struct Bounds {
    /// Its name.
    pub dimension: String,
    /// Lower bound.
    pub lower: f64,
    /// Upper bound.
    pub upper: f64,
    /// Start.
    pub start: f64,
}

/// What the problem is to be. Defaults are steel, in kilonewtons and the unit of length; all numbers are in these.
#[derive(Debug, Clone, PartialEq)]
pub struct Options {
    /// The section kind.
    pub kind: SectionKind,
    /// The unit of length; `None`: not said, the defaults are for metres.
    pub unit: Option<Unit>,
    /// Bounds that replace the kind's own.
    pub bounds: Vec<Bounds>,
    /// The volume law of all ribs.
    pub volume: VolumeLaw,
    /// Young's modulus E.
    pub elastic_modulus: f64,
    /// Line load q.
    pub load: f64,
    /// Largest sag is span over this.
    pub sag_ratio: f64,
    /// Rectangle: h ≤ this·b; superellipse alike. Webs of H beams and walls of boxes at most 5 × this, flanges 4 × (of boxes 5 ×), webs of
    /// tees 2 ×, diameters of tubes 10 × this, of their thickness; heights of H beams, tees and boxes half this, of their width.
    pub slenderness: f64,
    /// Largest change of height per length of rib.
    pub taper_slope: f64,
    /// The width of solid kinds, the walls of others are at least this.
    pub thickness: f64,
    /// The title.
    pub title: String,
    /// Overwrite files that were edited.
    pub force: bool,
    /// The ribs as a structure, analysed as a whole; `None`: every line as a beam of its own.
    pub structure: Option<structure::Structure>,
}

/// What the folder holds.
pub const FILES: [&str; 4] = ["problem.toml", "sections.csv", "ribs.csv", "geometry.csv"];

impl Options {
    /// The defaults for a kind, in metres.
    pub fn of(kind: SectionKind) -> Self {
        Options::with_unit(kind, None)
    }

    /// The defaults for a kind: the same steel and loads, in this unit.
    pub fn with_unit(kind: SectionKind, unit: Option<Unit>) -> Self {
        let metres = unit.unwrap_or(Unit::Metre).metres();
        Options {
            kind,
            unit,
            bounds: Vec::new(),
            volume: VolumeLaw::Prismatoid,
            elastic_modulus: 210e6 * (metres * metres),
            load: 5.0 * metres,
            sag_ratio: 300.0,
            slenderness: 8.0,
            taper_slope: 0.1,
            thickness: kind.thickness() / metres,
            title: "Ribs of a quad mesh".into(),
            force: false,
            structure: None,
        }
    }
}

impl Default for Options {
    fn default() -> Self {
        Options::of(SectionKind::default())
    }
}

/// Why no problem was written.
#[derive(Debug, thiserror::Error)]
#[allow(missing_docs)]
pub enum RibsError {
    #[error("{name} must be a positive number, not {value}; choose another one")]
    NotPositive { name: String, value: f64 },
    #[error("{kind} has no dimension '{dimension}'; it has {known}")]
    UnknownDimension { kind: &'static str, dimension: String, known: String },
    #[error("bounds of {dimension}: lower {lower} is above upper {upper}; exchange them")]
    Crossed { dimension: String, lower: f64, upper: f64 },
    #[error("{name} must be a number of at least 0, not {value}; choose another one")]
    Negative { name: String, value: f64 },
    #[error("Poisson's ratio must lie between -1 and 0.5, not at {value}; steel has 0.3")]
    Poisson { value: f64 },
    #[error(
        "nothing holds the structure: the surface has no boundary; say which nodes do: --supports lowest, or by name, --supports v1,v7"
    )]
    NoSupports,
    #[error("no node is called '{name}'; nodes are called as the mesh's vertices, {some}, …; a name with * or ? is a pattern")]
    UnknownNode { name: String, some: String },
    #[error("there are no ribs: the mesh has no edges that carry any; flag some as l elements, or none for all")]
    NoRibs,
    #[error("{0} was edited since `mesh ribs` wrote it; choose another folder, or give --force to overwrite it")]
    Edited(String),
    #[error(transparent)]
    Write(#[from] FormatError),
}

/// What was written.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Report {
    /// Ribs.
    pub ribs: usize,
    /// Sections, and those shared by ribs of several lines.
    pub sections: usize,
    /// Variables of the problem.
    pub variables: usize,
    /// Lines.
    pub lines: usize,
    /// Length of all ribs: the length of all rib edges.
    pub length: f64,
    /// SHA-256 of every file, by which edited ones are known.
    pub written: BTreeMap<String, String>,
    /// Bounds that do not fit the spans.
    pub warnings: Vec<String>,
    /// Supports and loads, where the ribs are a structure.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub structure: Option<structure::StructureReport>,
}

/// Writes the folder. The mesh is what a structure's loads act on, and what its boundary is of.
///
/// # Errors
/// Limits or bounds that make no sense; files that cannot be written.
pub fn write_problem(network: &Network, mesh: &PolygonMesh, options: &Options, folder: &Path) -> Result<Report, RibsError> {
    if network.ribs.is_empty() {
        return Err(RibsError::NoRibs);
    }
    let bounds = checked_bounds(options)?;
    let (all, structure, sections) = match &options.structure {
        Some(own) => {
            let (files, report, sections) = structure::files(network, mesh, options, own, &bounds)?;
            (files, Some(report), sections)
        }
        None => (beams(network, options, &bounds, folder)?, None, network.sections.len()),
    };
    let written = folder::leave(folder, &all, options.force)?;
    let mut lines: Vec<&str> = network.ribs.iter().map(|rib| rib.geometry.line.as_str()).collect();
    lines.dedup();
    Ok(Report {
        ribs: network.ribs.len(),
        sections,
        variables: sections * bounds.iter().filter(|b| b.lower < b.upper).count(),
        lines: lines.len(),
        length: network.ribs.iter().map(|rib| rib.geometry.length()).sum(),
        written,
        warnings: warnings::find(network, options, &bounds),
        structure,
    })
}

/// The files of a problem in which every line is a beam.
fn beams(
    network: &Network,
    options: &Options,
    bounds: &[Bounds],
    folder: &Path,
) -> Result<Vec<(&'static str, Vec<u8>)>, RibsError> {
    let mut all: Vec<(&'static str, Vec<u8>)> = Vec::new();
    let mut save = |name: &'static str, write: &dyn Fn(&mut dyn Write) -> Result<(), csv::Error>| {
        let mut content = Vec::new();
        let failed = |cause: csv::Error| FormatError::io(&folder.join(name), std::io::Error::other(cause));
        write(&mut content).map_err(failed)?;
        all.push((name, content));
        Ok::<(), RibsError>(())
    };
    let [problem, sections, ribs, geometry] = FILES;
    save(problem, &|out| Ok(out.write_all(text::problem(options).as_bytes())?))?;
    save(sections, &|out| write_sections(out, network, options.kind, bounds))?;
    save(ribs, &|out| write_ribs(out, network, options))?;
    save(geometry, &|out| write_geometry(out, network.ribs.iter().map(|rib| &rib.geometry)))?;
    Ok(all)
}

/// An error unless the number is positive.
fn positive(name: &str, value: f64) -> Result<(), RibsError> {
    let good = value > 0.0 && value.is_finite();
    if good { Ok(()) } else { Err(RibsError::NotPositive { name: name.into(), value }) }
}

fn checked_bounds(options: &Options) -> Result<Vec<Bounds>, RibsError> {
    positive("the elastic modulus", options.elastic_modulus)?;
    positive("the load", options.load)?;
    positive("the sag ratio", options.sag_ratio)?;
    positive("the slenderness", options.slenderness)?;
    positive("the taper slope", options.taper_slope)?;
    positive("the thickness", options.thickness)?;
    let mut bounds = options.kind.dimensions(options.unit.unwrap_or(Unit::Metre));
    for own in &options.bounds {
        positive(&format!("the lower bound of {}", own.dimension), own.lower)?;
        positive(&format!("the upper bound of {}", own.dimension), own.upper)?;
        if own.lower > own.upper {
            return Err(RibsError::Crossed { dimension: own.dimension.clone(), lower: own.lower, upper: own.upper });
        }
        let known = bounds.iter().map(|b| b.dimension.clone()).collect::<Vec<_>>().join(", ");
        let slot = bounds.iter_mut().find(|b| b.dimension == own.dimension);
        *slot.ok_or_else(|| unknown(options.kind, own, known))? = own.clone();
    }
    Ok(bounds)
}

fn unknown(kind: SectionKind, own: &Bounds, known: String) -> RibsError {
    RibsError::UnknownDimension { kind: kind.name(), dimension: own.dimension.clone(), known }
}

fn write_sections(out: &mut dyn Write, network: &Network, kind: SectionKind, bounds: &[Bounds]) -> Result<(), csv::Error> {
    let mut table = csv::Writer::from_writer(out);
    let columns = bounds.iter().flat_map(|b| ["lower", "upper", "start"].map(|part| format!("{}.{part}", b.dimension)));
    table.write_record(["name".into(), "kind".into()].into_iter().chain(columns))?;
    for name in &network.sections {
        let cells = bounds.iter().flat_map(|b| [b.lower, b.upper, b.start].map(|value| value.to_string()));
        table.write_record([name.clone(), kind.name().into()].into_iter().chain(cells))?;
    }
    Ok(table.flush()?)
}

fn write_ribs(out: &mut dyn Write, network: &Network, options: &Options) -> Result<(), csv::Error> {
    let mut table = csv::Writer::from_writer(out);
    table.write_record(["name", "from", "to", "length", "volume", "line", "span", "sag"])?;
    let law = options.volume.name();
    for rib in &network.ribs {
        let section = |end: usize| network.sections[rib.sections[end] as usize].as_str();
        let (length, span, sag) = (rib.geometry.length().to_string(), span(rib).to_string(), sag(rib).to_string());
        let (name, line) = (rib.geometry.name.as_str(), rib.geometry.line.as_str());
        table.write_record([name, section(0), section(1), &length, law, line, &span, &sag])?;
    }
    Ok(table.flush()?)
}

/// The span of the rib's line as a beam; half of a closed one.
fn span(rib: &Rib) -> f64 {
    if rib.closed { rib.line_length / 2.0 } else { rib.line_length }
}

/// ∫ M·m ds over the rib, with M = s(S−s)/2 under a unit line load and m = min(s, S−s)/2 under a unit load at midspan;
/// Simpson's rule over eight parts. On a closed line the mean of that over all positions, for one of its two halves.
fn sag(rib: &Rib) -> f64 {
    let span = span(rib);
    let length = rib.s[1] - rib.s[0];
    if rib.closed {
        return 5.0 * span.powi(3) / 384.0 * (length / 2.0);
    }
    let product = |s: f64| {
        let s = s.clamp(0.0, span);
        s * (span - s) / 2.0 * s.min(span - s) / 2.0
    };
    let (from, step) = (rib.s[0], length / 8.0);
    let weight = |k: u32| if k == 0 || k == 8 { 1.0 } else { 2.0 + 2.0 * f64::from(k % 2) };
    (0..=8).map(|k| weight(k) * product(from + step * f64::from(k))).sum::<f64>() * step / 3.0
}

#[cfg(test)]
mod tests;

//! `ribopt mesh …`: the stages from a quad mesh to a problem folder.

mod arguments;
mod show;
mod spare;
mod values;

use serde::Serialize;
use std::io::{self, Write};

pub use arguments::Stage;
use arguments::{Check, Joined, Mesh, Method, New, Reconstruct, RibLimits, RibStructure, Ribs, Shown, Slice, Smooth, Trace};

use super::failure::Failure;
use super::output;
use ribopt::mesh::commands::{self, Source};
use ribopt::mesh::features::FeatureOptions;
use ribopt::mesh::{reconstruct, ribs, smooth};
use ribopt::report::result::write_value;
use ribopt::run::RunError;

/// Does one stage and returns the exit code.
pub fn run(stage: &Stage) -> Result<u8, Failure> {
    spare::spare(stage).map_err(RunError::from)?;
    match stage {
        Stage::Check(arguments) => check(arguments),
        Stage::Reconstruct(arguments) => reconstruct(arguments),
        Stage::Smooth(arguments) => smooth(arguments),
        Stage::Trace(arguments) => trace(arguments),
        Stage::Slice(arguments) => slice(arguments),
        Stage::Ribs(arguments) => ribs(arguments),
        Stage::New(arguments) => new(arguments),
    }
}

/// The report as JSON or in words.
fn tell<T: Serialize>(
    shown: &Shown,
    report: &T,
    words: impl FnOnce(&T, &mut dyn Write) -> io::Result<()>,
) -> Result<(), Failure> {
    output::print(|out| if shown.json { write_value(report, out) } else { words(report, out) })
}

fn check(arguments: &Check) -> Result<u8, Failure> {
    let report = commands::check(&arguments.mesh.source())?;
    tell(&arguments.shown, &report, show::check)?;
    Ok(u8::from(!report.sound))
}

fn reconstruct(arguments: &Reconstruct) -> Result<u8, Failure> {
    let options = reconstruct::Options { tolerance: arguments.tolerance, fill: !arguments.no_fill, snap: !arguments.no_snap };
    let report = commands::reconstruct_file(&arguments.mesh.source(), &arguments.original, options, &arguments.out)?;
    tell(&arguments.shown, &report, |report, out| show::reconstruct(report, &arguments.out, out))?;
    Ok(u8::from(!report.stage.open.is_empty()))
}

fn smooth(arguments: &Smooth) -> Result<u8, Failure> {
    let method = match arguments.method {
        Method::Laplacian => smooth::Method::Laplacian,
        Method::GaussSeidel => smooth::Method::GaussSeidel,
        Method::Taubin => smooth::Method::taubin(arguments.relaxation, arguments.mu),
    };
    let options = smooth::Options {
        method,
        relaxation: arguments.relaxation,
        iterations: arguments.iterations as usize,
        curves: if arguments.slide { smooth::Curves::Slide } else { smooth::Curves::Keep },
        features: FeatureOptions { crease: arguments.features.map(f64::to_radians), ..FeatureOptions::default() },
    };
    let report = commands::smooth_file(&arguments.mesh.source(), options, arguments.project.as_deref(), &arguments.out)?;
    tell(&arguments.shown, &report, |report, out| show::smooth(report, &arguments.out, out))?;
    Ok(u8::from(!report.stage.flipped.is_empty()))
}

fn lines_of(mesh: &Mesh, joined: &Joined) -> Source {
    Source { rule: joined.lines, ..mesh.source() }
}

fn trace(arguments: &Trace) -> Result<u8, Failure> {
    let report = commands::trace_file(&lines_of(&arguments.mesh, &arguments.joined), &arguments.out)?;
    tell(&arguments.shown, &report, |report, out| show::trace(report, &arguments.out, out))?;
    Ok(0)
}

fn slice(arguments: &Slice) -> Result<u8, Failure> {
    let (source, out) = (lines_of(&arguments.mesh, &arguments.joined), &arguments.out);
    match (&arguments.plane, arguments.segments) {
        (Some(plane), _) => {
            let report = commands::section_file(&source, plane, out)?;
            tell(&arguments.shown, &report, |report, to| show::section(report, out, to))?;
        }
        // The parser lets one of the two through; no length at all is told by the library.
        (None, segments) => {
            let report = commands::slice_file(&source, segments.unwrap_or(f64::NAN), out)?;
            tell(&arguments.shown, &report, |report, to| show::stations(report, out, to))?;
        }
    }
    Ok(0)
}

fn ribs(arguments: &Ribs) -> Result<u8, Failure> {
    let defaults = ribs::Options::with_unit(arguments.kind, arguments.unit);
    let options = ribs::Options {
        bounds: arguments.bounds.clone(),
        volume: arguments.volume,
        force: arguments.force,
        title: arguments.title.clone().unwrap_or(defaults.title.clone()),
        structure: arguments.structure.structure.then(|| structure(&arguments.structure, arguments.unit)),
        ..with_limits(defaults, &arguments.limits)
    };
    let report =
        commands::ribs_folder(&lines_of(&arguments.mesh, &arguments.joined), arguments.segments, &options, &arguments.out)?;
    tell(&arguments.shown, &report, |report, out| show::ribs(report, &arguments.out, out))?;
    Ok(0)
}

fn structure(own: &RibStructure, unit: Option<ribs::Unit>) -> ribs::structure::Structure {
    let defaults = ribs::structure::Structure::with_unit(unit);
    ribs::structure::Structure {
        held: own.supports.clone().unwrap_or(defaults.held),
        fixed: own.fixed,
        dead: own.dead.unwrap_or(defaults.dead),
        snow: own.snow.unwrap_or(defaults.snow),
        density: own.density.unwrap_or(defaults.density),
        poisson: own.poisson.unwrap_or(defaults.poisson),
        strength: own.strength.unwrap_or(defaults.strength),
        sharing: own.sections.unwrap_or(defaults.sharing),
    }
}

fn with_limits(defaults: ribs::Options, limits: &RibLimits) -> ribs::Options {
    ribs::Options {
        elastic_modulus: limits.elastic_modulus.unwrap_or(defaults.elastic_modulus),
        load: limits.load.unwrap_or(defaults.load),
        sag_ratio: limits.sag_ratio.unwrap_or(defaults.sag_ratio),
        slenderness: limits.slenderness.unwrap_or(defaults.slenderness),
        taper_slope: limits.taper_slope.unwrap_or(defaults.taper_slope),
        thickness: limits.thickness.unwrap_or(defaults.thickness),
        ..defaults
    }
}

fn new(arguments: &New) -> Result<u8, Failure> {
    let report = commands::new_file(&arguments.name, &arguments.out)?;
    tell(&arguments.shown, &report, |report, out| {
        writeln!(out, "{}: {}", arguments.out.display(), arguments.name)?;
        show::invariants(report, out)
    })?;
    Ok(0)
}

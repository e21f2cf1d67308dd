//! Reports of the mesh stages in words.

use std::io::{self, Write};
use std::path::Path;

use ribopt::mesh::commands::{CheckReport, RibsReport, SectionReport, Staged};
use ribopt::mesh::graph::Rule;
use ribopt::mesh::invariants::Invariants;
use ribopt::mesh::quality::Range;
use ribopt::mesh::stations::StationReport;
use ribopt::mesh::trace::TraceReport;
use ribopt::mesh::weld::WeldReport;
use ribopt::mesh::{reconstruct as rebuilt, smooth as smoothed};
use ribopt::report::number::short;
use ribopt::report::text::{count, listing};

type Words = io::Result<()>;
type Out<'a> = &'a mut dyn Write;

/// Numbers of one kind that are spelled out.
const SHOWN: usize = 10;

pub fn check(report: &CheckReport, out: Out) -> Words {
    writeln!(out, "{}: {}", report.file, report.message)?;
    if let Some(weld) = &report.weld {
        welded(weld, out)?;
    }
    notes(&report.notes, out)?;
    invariants(&report.invariants, out)
}

fn notes(notes: &[String], out: Out) -> Words {
    notes.iter().try_for_each(|note| writeln!(out, "note: {note}"))
}

fn vertices(number: usize) -> String {
    if number == 1 { "1 vertex".into() } else { format!("{number} vertices") }
}

fn welded(weld: &WeldReport, out: Out) -> Words {
    writeln!(out, "welded: {} joined, moved by up to {}", vertices(weld.joined), short(weld.largest_move))
}

pub fn invariants(numbers: &Invariants, out: Out) -> Words {
    let Invariants { vertices, edges, faces, rib_edges, components, .. } = numbers;
    let (edges, faces, points) = (count(*edges, "edge"), count(*faces, "face"), self::vertices(*vertices));
    writeln!(out, "{points}, {edges} ({rib_edges} with ribs), {faces}, {components} connected")?;
    if numbers.quads < numbers.faces {
        let Invariants { triangles, quads, larger, .. } = numbers;
        let ends = if *quads > 0 { "; lines end where they break the grid" } else { "" };
        writeln!(out, "{triangles} triangles, {quads} quads, {larger} larger faces{ends}")?;
    }
    if numbers.faces == 0 {
        writeln!(out, "lines without a surface")?;
        return range("edge lengths", &numbers.edge_lengths, out);
    }
    let loops = listing(numbers.boundary_loops.iter().map(usize::to_string), SHOWN);
    let loops = if loops.is_empty() { "none".into() } else { format!("of {loops} vertices") };
    writeln!(out, "Euler characteristic {}, boundary loops: {loops}", numbers.euler_characteristic)?;
    irregular("inside (valence not 4)", &numbers.irregular_interior, out)?;
    irregular("on the boundary (valence not 3)", &numbers.irregular_boundary, out)?;
    let agrees = if numbers.valence_identity { "as it must be" } else { "which it must not be" };
    let corners = match numbers.corner_sum {
        0 => String::new(),
        sum => format!(" {} {} for the faces' corners", if sum < 0 { "−" } else { "+" }, sum.abs()),
    };
    let (sum, euler) = (numbers.valence_sum, numbers.euler_characteristic);
    writeln!(out, "valences add up to {sum}, 4 × {euler}{corners}: {agrees}")?;
    range("edge lengths", &numbers.edge_lengths, out)?;
    range("angles", &numbers.angles, out)?;
    range("planarity (0 is planar)", &numbers.planarity, out)?;
    writeln!(out, "area {}", short(numbers.area))
}

fn irregular(place: &str, vertices: &[[u32; 2]], out: Out) -> Words {
    let words = vertices.iter().map(|[vertex, valence]| format!("{vertex} ({valence})"));
    match vertices.len() {
        0 => writeln!(out, "irregular {place}: none"),
        many => writeln!(out, "irregular {place}: {many}: {}", listing(words, SHOWN)),
    }
}

fn range(name: &str, range: &Range, out: Out) -> Words {
    writeln!(out, "{name} {} to {}, mean {}", short(range.least), short(range.most), short(range.mean))
}

pub fn reconstruct(report: &Staged<rebuilt::Report>, file: &Path, out: Out) -> Words {
    let stage = &report.stage;
    writeln!(
        out,
        "{}: {} and {} added, {} snapped to vertices and {} to the surface, {} taken back",
        file.display(),
        count(stage.faces_added, "face"),
        vertices(stage.vertices_added),
        vertices(stage.snapped_to_vertices),
        stage.snapped_to_surface,
        count(stage.undone, "move")
    )?;
    let [before, after] = stage.euler_characteristic;
    writeln!(out, "Euler characteristic {before} before, {after} after; holes left: {}", stage.unfilled_loops)?;
    for run in stage.open.iter().take(SHOWN) {
        let vertices = listing(run.iter().map(u32::to_string), SHOWN);
        writeln!(out, "left open, though the original goes on beyond the edges of vertices {vertices}: no rule fits there")?;
    }
    let (most, apart) = (short(stage.largest_move), short(stage.hausdorff.distance));
    writeln!(out, "tolerance {}, longest move {most}, Hausdorff distance {apart}", short(stage.tolerance))?;
    invariants(&report.invariants, out)
}

pub fn smooth(report: &Staged<smoothed::Report>, file: &Path, out: Out) -> Words {
    let stage = &report.stage;
    let smoothed::Report { free, sliding, fixed, .. } = stage;
    writeln!(out, "{}: {free} vertices free, {sliding} sliding, {fixed} fixed", file.display())?;
    let before_after = |[before, after]: [f64; 2]| format!("{} before, {} after", short(before), short(after));
    writeln!(out, "longest move {}", short(stage.largest_move))?;
    writeln!(out, "roughness {}", before_after(stage.roughness))?;
    writeln!(out, "area {}", before_after(stage.area))?;
    if let Some(volume) = stage.volume {
        writeln!(out, "volume {}", before_after(volume))?;
    }
    if !stage.flipped.is_empty() {
        writeln!(out, "turned over: faces {}", listing(stage.flipped.iter().map(u32::to_string), SHOWN))?;
    }
    invariants(&report.invariants, out)
}

pub fn trace(report: &TraceReport, file: &Path, out: Out) -> Words {
    writeln!(out, "{}: {}, {} of them closed", file.display(), count(report.lines, "line"), report.closed)?;
    let which = if report.flagged_only { "flagged " } else { "" };
    let rule = match report.rule {
        Rule::Topology => "straight on where the mesh is regular",
        Rule::Given => "as the file gives them",
        Rule::Edges => "one per edge",
        _ => "by straightest continuation, and as the file gives them",
    };
    writeln!(
        out,
        "{}, length {}; {rule}, ending at {}",
        count(report.edges, &format!("{which}edge")),
        short(report.length),
        places(report.ends)
    )?;
    notes(&report.notes, out)?;
    for crossing in report.self_crossings.iter().take(SHOWN) {
        let vertices = listing(crossing.vertices.iter().map(u32::to_string), SHOWN);
        writeln!(out, "line {} meets itself at vertex {vertices}", crossing.line)?;
    }
    match report.self_crossings.len().saturating_sub(SHOWN) {
        0 => Ok(()),
        more => writeln!(out, "… and {more} more lines meet themselves"),
    }
}

fn places(ends: usize) -> String {
    if ends == 1 { "1 vertex".into() } else { format!("{ends} vertices") }
}

pub fn stations(report: &StationReport, file: &Path, out: Out) -> Words {
    let StationReport { lines, stations, segments, .. } = report;
    writeln!(out, "{}: {lines} lines, {stations} stations, {segments} segments", file.display())?;
    let (length, longest) = (short(report.length), short(report.longest));
    writeln!(out, "length {length}, longest segment {longest}, frames turn by up to {} degrees", short(report.largest_turn))
}

pub fn section(report: &SectionReport, file: &Path, out: Out) -> Words {
    let pieces = count(report.pieces.len(), "piece");
    writeln!(out, "{}: {pieces}, area {}", file.display(), short(report.area))?;
    for (at, piece) in report.pieces.iter().enumerate().take(SHOWN) {
        let [x, y] = piece.centroid.map(short);
        let (area, ix, iy) = (short(piece.area), short(piece.ix), short(piece.iy));
        let holes = count(piece.holes, "hole");
        writeln!(out, "piece {}: area {area}, centroid ({x}, {y}), Ix {ix}, Iy {iy}, {holes}", at + 1)?;
    }
    notes(&report.notes, out)
}

pub fn ribs(report: &RibsReport, folder: &Path, out: Out) -> Words {
    let problem = &report.problem;
    writeln!(
        out,
        "{}: {} on {}, {}, {}, length {}",
        folder.display(),
        count(problem.ribs, "rib"),
        count(problem.lines, "line"),
        count(problem.sections, "section"),
        count(problem.variables, "variable"),
        short(problem.length)
    )?;
    if let Some(structure) = &problem.structure {
        let (nodes, supports) = (count(structure.nodes, "node"), count(structure.supports, "support"));
        let loads = match (structure.dead, structure.snow) {
            (Some(dead), Some(snow)) => format!(
                "area {}, on plan {}; dead load {} besides the ribs, snow {}",
                short(structure.area),
                short(structure.plan_area),
                short(dead),
                short(snow)
            ),
            _ => "no surface: loads act along the ribs".into(),
        };
        writeln!(out, "structure: {nodes}, {supports}; {loads}")?;
    }
    notes(&report.trace.notes, out)?;
    problem.warnings.iter().try_for_each(|warning| writeln!(out, "warning: {warning}"))?;
    writeln!(out, "solve it: ribopt solve {}", folder.join("problem.toml").display())
}

//! What can be typed after `ribopt mesh`.

use std::path::PathBuf;

use clap::{ArgGroup, Args, Subcommand, ValueEnum};

use super::values;
use ribopt::mesh::commands::Source;
use ribopt::mesh::graph::Rule;
use ribopt::mesh::ribs::{self, structure};
use ribopt::mesh::section::Plane;
use ribopt::ribs::law::VolumeLaw;

const CHECK_CODES: &str =
    "Exit codes:\n  0  a clean quad mesh, polygon mesh or network of lines\n  1  it has defects\n  2  no mesh could be read";
const RECONSTRUCT_CODES: &str = "Exit codes:\n  0  done\n  1  done, but holes or notches are left that no rule could fill\n  2  nothing was written, for the reason told";
const SMOOTH_CODES: &str =
    "Exit codes:\n  0  done\n  1  done, but faces were turned over\n  2  nothing was written, for the reason told";
const CODES: &str = "Exit codes:\n  0  done\n  2  nothing was written, for the reason told";

#[derive(Debug, Subcommand)]
pub enum Stage {
    /// Count, measure, and name every defect with its faces
    #[command(after_help = CHECK_CODES)]
    Check(Check),
    /// Fill concave notches and holes with quads and snap to the original surface
    #[command(after_help = RECONSTRUCT_CODES)]
    Reconstruct(Reconstruct),
    /// Smooth the mesh
    #[command(after_help = SMOOTH_CODES)]
    Smooth(Smooth),
    /// Trace the edges to rib lines
    #[command(after_help = CODES)]
    Trace(Trace),
    /// Stations with frames along the rib lines, or the section of a solid with a plane
    #[command(after_help = CODES)]
    Slice(Slice),
    /// A ready problem folder: problem.toml, sections.csv, ribs.csv, geometry.csv
    #[command(after_help = CODES)]
    Ribs(Ribs),
    /// Write one of the meshes made by formula: grid, cube, small-vault, vault, dome, shell
    #[command(after_help = CODES)]
    New(New),
}

/// The mesh every stage starts from.
#[derive(Debug, Args)]
pub struct Mesh {
    /// The mesh or lines: .obj (l elements and curves flag rib edges), .ply, .off, .stl, or lines alone as .csv or .dxf
    mesh: PathBuf,
    /// Join vertices within this distance first
    #[arg(long, value_name = "TOL", allow_negative_numbers = true)]
    weld: Option<f64>,
}

impl Mesh {
    pub fn source(&self) -> Source {
        Source { path: self.mesh.clone(), weld: self.weld, ..Source::default() }
    }
}

/// How edges become lines.
#[derive(Debug, Args)]
pub struct Joined {
    /// How edges are joined to lines: auto (quads by topology, triangles and lines by straightest continuation, polylines of
    /// the file as given), topology, straight, given, edges (one line each)
    #[arg(long, value_name = "RULE", default_value = "auto", value_parser = values::rule)]
    pub lines: Rule,
}

/// How the finding is shown.
#[derive(Debug, Args)]
pub struct Shown {
    /// Print the report as JSON on standard output, and nothing else there
    #[arg(long)]
    pub json: bool,
}

#[derive(Debug, Args)]
pub struct Check {
    #[command(flatten)]
    pub mesh: Mesh,
    #[command(flatten)]
    pub shown: Shown,
}

#[derive(Debug, Args)]
pub struct Reconstruct {
    #[command(flatten)]
    pub mesh: Mesh,
    /// The original surface, a mesh of any polygons
    #[arg(long, value_name = "REF")]
    pub original: PathBuf,
    /// The new mesh (.obj, .stl or .vtu); what was done goes to the same name with .json
    #[arg(long, short, value_name = "OUT")]
    pub out: PathBuf,
    /// How far new faces may lie off the original and vertices may be moved; default: a tenth of the original's mean edge
    #[arg(long, value_name = "T", allow_negative_numbers = true)]
    pub tolerance: Option<f64>,
    /// Do not fill notches and holes
    #[arg(long)]
    pub no_fill: bool,
    /// Do not snap
    #[arg(long)]
    pub no_snap: bool,
    #[command(flatten)]
    pub shown: Shown,
}

/// How vertices are moved.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Method {
    /// All at once
    Laplacian,
    /// One after the other
    GaussSeidel,
    /// A step inwards, then one outwards: little shrinkage
    Taubin,
}

#[derive(Debug, Args)]
pub struct Smooth {
    #[command(flatten)]
    pub mesh: Mesh,
    /// The new mesh (.obj, .stl or .vtu); what was done goes to the same name with .json
    #[arg(long, short, value_name = "OUT")]
    pub out: PathBuf,
    /// How vertices are moved
    #[arg(long, value_enum, default_value_t = Method::Laplacian)]
    pub method: Method,
    /// The part of the way to the neighbours' mean, in (0, 1]; 1 is the note's step, which keeps checkerboards
    #[arg(long, value_name = "L", default_value_t = 0.5, allow_negative_numbers = true)]
    pub relaxation: f64,
    /// Taubin's outward step, below minus the relaxation; default: -1.06 times the relaxation
    #[arg(long, value_name = "M", allow_negative_numbers = true)]
    pub mu: Option<f64>,
    /// How often
    #[arg(long, value_name = "N", default_value_t = 10, value_parser = clap::value_parser!(u32).range(..=1_000_000))]
    pub iterations: u32,
    /// Boundaries and creases stay where they are (the default)
    #[arg(long, conflicts_with = "slide")]
    pub keep_boundary: bool,
    /// Vertices of boundaries and creases move along them; corners stay
    #[arg(long)]
    pub slide: bool,
    /// Edges whose faces meet at more than this angle (degrees) are creases; without it only boundaries count
    #[arg(long, value_name = "ANGLE", value_parser = values::angle)]
    pub features: Option<f64>,
    /// Put vertices back onto this surface after every iteration
    #[arg(long, value_name = "REF")]
    pub project: Option<PathBuf>,
    #[command(flatten)]
    pub shown: Shown,
}

#[derive(Debug, Args)]
pub struct Trace {
    #[command(flatten)]
    pub mesh: Mesh,
    #[command(flatten)]
    pub joined: Joined,
    /// The lines: .obj (l elements), .csv or .dxf; the report goes to the same name with .json
    #[arg(long, short, value_name = "LINES", value_parser = values::lines_file)]
    pub out: PathBuf,
    #[command(flatten)]
    pub shown: Shown,
}

#[derive(Debug, Args)]
#[command(group = ArgGroup::new("what").required(true))]
pub struct Slice {
    #[command(flatten)]
    pub mesh: Mesh,
    #[command(flatten)]
    pub joined: Joined,
    /// Longest segment between stations
    #[arg(long, value_name = "LENGTH", group = "what", allow_negative_numbers = true)]
    pub segments: Option<f64>,
    /// Cut a solid: x=C, y=C, z=C, or a point and a normal as px,py,pz:nx,ny,nz
    #[arg(long, value_name = "PLANE", group = "what", value_parser = values::plane, allow_hyphen_values = true)]
    pub plane: Option<Plane>,
    /// Stations (.csv), or the section (.csv or .svg); the report goes to the same name with .json
    #[arg(long, short, value_name = "OUT", value_parser = values::section_file)]
    pub out: PathBuf,
    #[command(flatten)]
    pub shown: Shown,
}

#[derive(Debug, Args)]
pub struct Ribs {
    #[command(flatten)]
    pub mesh: Mesh,
    #[command(flatten)]
    pub joined: Joined,
    /// Kind of section
    #[arg(long, value_name = "KIND", default_value = "rectangle", value_parser = values::kind)]
    pub kind: ribs::SectionKind,
    /// The folder to write
    #[arg(long, short, value_name = "DIR")]
    pub out: PathBuf,
    /// Longest rib; default: one rib per mesh edge
    #[arg(long, value_name = "LENGTH", default_value_t = f64::INFINITY, hide_default_value = true, allow_negative_numbers = true)]
    pub segments: f64,
    /// The unit of length of the mesh, and of all numbers of this command and of the problem; forces are kilonewtons
    #[arg(long, value_name = "mm|cm|m|in", value_parser = values::unit)]
    pub unit: Option<ribs::Unit>,
    /// Bounds of a dimension at all sections (repeatable); the start is their geometric mean where it is left out
    #[arg(long = "bounds", value_name = "DIM=LOWER:UPPER[:START]", value_parser = values::bounds)]
    pub bounds: Vec<ribs::Bounds>,
    /// Volume law of the ribs
    #[arg(long, default_value = "prismatoid", value_parser = values::volume_law())]
    pub volume: VolumeLaw,
    #[command(flatten)]
    pub limits: RibLimits,
    #[command(flatten)]
    pub structure: RibStructure,
    /// Overwrite files of the folder that were edited
    #[arg(long)]
    pub force: bool,
    /// Title of the problem
    #[arg(long, value_name = "TEXT")]
    pub title: Option<String>,
    #[command(flatten)]
    pub shown: Shown,
}

/// Loads and limits; the defaults are steel, in kilonewtons and the unit (metres where none is said).
#[derive(Debug, Args)]
pub struct RibLimits {
    /// Young's modulus
    #[arg(long, value_name = "E", allow_negative_numbers = true)]
    pub elastic_modulus: Option<f64>,
    /// Line load
    #[arg(long, value_name = "Q", allow_negative_numbers = true, conflicts_with = "structure")]
    pub load: Option<f64>,
    /// Stiffness: each line, as a beam between its ends, may sag by its span over this; every node of a structure by the span of the supports
    /// over this
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    pub sag_ratio: Option<f64>,
    /// Slenderness: h over b of rectangles and superellipses; of webs of H beams and walls of boxes 5 times, of flanges 4
    /// times (boxes: 5), of webs of tees 2 times, of diameters of tubes 10 times this; h over b of H beams, tees and boxes half
    /// of it
    #[arg(long, value_name = "N", allow_negative_numbers = true)]
    pub slenderness: Option<f64>,
    /// Largest change of height per length of rib
    #[arg(long, value_name = "SLOPE", allow_negative_numbers = true)]
    pub taper_slope: Option<f64>,
    /// Least thickness: of walls, webs and flanges, or the width of solid sections
    #[arg(long, value_name = "T", allow_negative_numbers = true)]
    pub thickness: Option<f64>,
}

/// The ribs as a structure.
#[derive(Debug, Args)]
pub struct RibStructure {
    /// One structure, analysed as a whole under dead load and snow, instead of a beam per line: nodes where ribs meet, sections upright on
    /// the surface, loads by the area each node carries
    #[arg(long)]
    pub structure: bool,
    /// What holds it: boundary (of lines: ends where no other rib meets), lowest, or names and patterns of nodes as in v1,v7
    #[arg(long, value_name = "boundary|lowest|NODES", requires = "structure", value_parser = values::held)]
    pub supports: Option<structure::Held>,
    /// The supports hold rotations, too
    #[arg(long, requires = "structure")]
    pub fixed: bool,
    /// Weight of what lies on the ribs, per area of the surface [default: 0.5 kN/m²]; of lines without a surface per length
    #[arg(long, value_name = "P", requires = "structure", allow_negative_numbers = true)]
    pub dead: Option<f64>,
    /// Snow per area on plan [default: 1 kN/m²]; of lines without a surface per length on plan
    #[arg(long, value_name = "P", requires = "structure", allow_negative_numbers = true)]
    pub snow: Option<f64>,
    /// Weight of the ribs per volume [default: 77 kN/m³]
    #[arg(long, value_name = "W", requires = "structure", allow_negative_numbers = true)]
    pub density: Option<f64>,
    /// Poisson's ratio [default: 0.3]
    #[arg(long, value_name = "NU", requires = "structure", allow_negative_numbers = true)]
    pub poisson: Option<f64>,
    /// What stresses may reach under 1.35 times the dead load and 1.5 times snow [default: 141 N/mm², six tenths of 235]
    #[arg(long, value_name = "F", requires = "structure", allow_negative_numbers = true)]
    pub strength: Option<f64>,
    /// Which sections are one: those at a station, at symmetric places, of a line, or all
    #[arg(long, value_name = "station|symmetric|line|one", requires = "structure", value_parser = values::sharing)]
    pub sections: Option<structure::Sharing>,
}

#[derive(Debug, Args)]
pub struct New {
    /// grid, cube, small-vault, vault, dome or shell
    pub name: String,
    /// The file: .obj, .stl or .vtu
    #[arg(long, short, value_name = "FILE")]
    pub out: PathBuf,
    #[command(flatten)]
    pub shown: Shown,
}

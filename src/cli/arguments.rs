//! What can be typed.

mod examples;
mod section;
mod sweep;
mod values;

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand};

use super::mesh::Stage;
use examples::{BEGINNING, EXAMPLES, EXIT_CODES, SECTION_EXAMPLES};
pub use section::Section;
pub use sweep::Sweep;
use values::{backend_names, seconds, tolerance};

/// What `--version` says: the features this program was built with.
const LONG_VERSION: &str = if cfg!(feature = "nlopt") {
    concat!(env!("CARGO_PKG_VERSION"), "\nfeatures: nlopt\nbackends: nlopt, argmin")
} else {
    concat!(env!("CARGO_PKG_VERSION"), "\nfeatures: none\nbackends: argmin")
};

/// Sizes structural ribs: the lightest rectangular ribs and H beams that still meet their limits, with a proof.
#[derive(Debug, Parser)]
#[command(name = "ribopt", version, long_version = LONG_VERSION, max_term_width = 110, after_help = BEGINNING)]
pub struct Arguments {
    #[command(subcommand)]
    pub command: Command,
}

#[derive(Debug, Subcommand)]
pub enum Command {
    /// Solve a problem with every backend, certify and compare the answers
    #[command(after_help = EXIT_CODES)]
    Solve(Solve),
    /// Solve with every backend and algorithm that accepts the problem, side by side
    Compare(Compare),
    /// The bound-convergence test: only bounds remain; where does every variable go?
    Bounds(Bounds),
    /// Read and validate, check the derivatives, tell class and sizes; solve nothing
    Check(Check),
    /// What the structure does at the start or at an answer: displacements, reactions, forces, stresses; solve nothing
    Analyse(Analyse),
    /// The certificate for a point found elsewhere
    Verify(Verify),
    /// Many runs of one problem: spans, loads, limits, trade-offs; on all cores, or on a cluster
    Sweep(Sweep),
    /// One HTML page about a run, several, or a study, from the files they left: verdict, what governs, utilisation, sizes, pictures, input
    Report {
        /// The folders of runs, or their result.json; or the folder of a study
        #[arg(required = true, value_name = "RESULT")]
        results: Vec<PathBuf>,
        /// The page; default, of one run: report.html beside the result
        #[arg(long, short, value_name = "FILE")]
        output: Option<PathBuf>,
    },
    /// Properties of cross-sections, and a picture of them
    #[command(after_help = SECTION_EXAMPLES)]
    Section(Section),
    /// A commented example file on standard output
    #[command(after_help = EXAMPLES)]
    New {
        /// What the example is about; without it, an example that shows most of the file
        kind: Option<String>,
    },
    /// From a quad rib mesh to a problem folder: check, reconstruct, smooth, trace, slice, ribs, new
    Mesh {
        #[command(subcommand)]
        stage: Stage,
    },
    /// What a mistake means, by the code told with it, with an example that is wrong and one that is right
    Explain {
        /// The code, as in mistake[unknown-key]; without it, all of them
        code: Option<String>,
    },
    /// JSON Schema of the problem file, for completion in editors
    Schema,
    /// Completions for a shell, on standard output
    Completions {
        /// The shell
        shell: clap_complete::Shell,
    },
    /// Manual pages, one per command, into a folder
    Man {
        /// The folder
        folder: PathBuf,
    },
}

#[derive(Debug, Args)]
pub struct Solve {
    /// The problem file (TOML), or - for standard input
    pub file: PathBuf,
    /// Use this backend only (repeat for several); default: those of the file, or all that are built in
    #[arg(long = "backend", value_name = "NAME", value_parser = backend_names())]
    pub backends: Vec<String>,
    /// The algorithm of the backends that know it by this name, `auto` for the others
    #[arg(long, value_name = "NAME")]
    pub algorithm: Option<String>,
    /// Folder for logs and results; default: results/<file stem>
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    #[command(flatten)]
    pub changes: Changes,
    /// Begin at an earlier answer: a result.json or a CSV with the columns name,value
    #[arg(long, value_name = "ANSWER")]
    pub start: Option<PathBuf>,
    /// Solve from N starting points (the file's and N - 1 others, the same every time) and keep the best answer [default: 1; of structures
    /// with up to 10 design variables, which have many minima, 4]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pub starts: Option<u32>,
    /// Print the result as one JSON object on standard output, and nothing else there
    #[arg(long)]
    pub json: bool,
    /// Write the sized ribs as closed solids (.obj, .stl or .vtu; repeatable), with a report as JSON beside them; places
    /// the ribs by geometry.csv beside the problem file
    #[arg(long, value_name = "OUT")]
    pub solids: Vec<PathBuf>,
    /// Write the schedule of ribs into this workbook (.xlsx): sizes at both ends, volume, mass, utilisation
    #[arg(long, value_name = "OUT")]
    pub schedule: Option<PathBuf>,
    /// Write the sized structure in the Structural Analysis Format (SAF) into this workbook (.xlsx), for other programs
    #[arg(long, value_name = "OUT")]
    pub saf: Option<PathBuf>,
    #[command(flatten)]
    pub limits: Limits,
    /// Leave SVG pictures as well: convergence, sections before and after, the ribs and profiles along the line, the
    /// ribs in space where geometry.csv beside the problem file or the nodes of a structure place them; of a structure the displaced
    /// shape and the courses of its forces, too (also as VTU)
    #[arg(long)]
    pub plot: bool,
    /// Leave report.html as well, with all pictures: one page to read, print and hand on
    #[arg(long)]
    pub report: bool,
    /// No table and no summary; errors and warnings only
    #[arg(long, short)]
    pub quiet: bool,
}

/// Changes to the file's numbers for this run.
#[derive(Debug, Args, Default)]
pub struct Changes {
    /// Change a number of the file for this run (repeatable): PARAMETER=, VARIABLE= (fixes it), VARIABLE.lower=, .upper=, .start=
    #[arg(long = "set", value_name = "NAME=VALUE")]
    pub set: Vec<String>,
}

/// What is accepted and when to give up; default: the file's `[solver]`.
#[derive(Debug, Args, Default)]
pub struct Limits {
    /// Largest accepted dual infeasibility and complementarity (fmincon's TolFun)
    #[arg(long, value_name = "T", value_parser = tolerance, allow_negative_numbers = true)]
    pub optimality_tolerance: Option<f64>,
    /// Relative step below which a run has stopped moving (TolX)
    #[arg(long, value_name = "T", value_parser = tolerance, allow_negative_numbers = true)]
    pub step_tolerance: Option<f64>,
    /// Largest accepted relative violation of rows and bounds (TolCon)
    #[arg(long, value_name = "T", value_parser = tolerance, allow_negative_numbers = true)]
    pub constraint_tolerance: Option<f64>,
    /// Iterations per backend
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    pub max_iterations: Option<u64>,
    /// Evaluations per backend
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    pub max_evaluations: Option<u64>,
    /// Seconds for the whole command, all backends together
    #[arg(long, value_name = "S", value_parser = seconds, allow_negative_numbers = true)]
    pub max_seconds: Option<f64>,
}

#[derive(Debug, Args)]
pub struct Compare {
    /// Problem files (TOML)
    #[arg(required = true)]
    pub files: Vec<PathBuf>,
    /// Write the table and Dolan-Moré performance profiles (CSV and SVG) into this folder
    #[arg(long, value_name = "DIR")]
    pub profile: Option<PathBuf>,
    /// Print the table as JSON
    #[arg(long)]
    pub json: bool,
    #[command(flatten)]
    pub changes: Changes,
    #[command(flatten)]
    pub limits: Limits,
}

#[derive(Debug, Args)]
pub struct Bounds {
    /// The problem file (TOML); its constraints are left out
    pub file: PathBuf,
    /// Exit code 1 if any variable ends elsewhere than at its lower bound
    #[arg(long)]
    pub strict: bool,
    #[command(flatten)]
    pub changes: Changes,
    #[command(flatten)]
    pub limits: Limits,
}

#[derive(Debug, Args)]
pub struct Check {
    /// The problem file (TOML)
    pub file: PathBuf,
    #[command(flatten)]
    pub changes: Changes,
    /// Print what was found as one JSON object
    #[arg(long)]
    pub json: bool,
    /// Print the rows that `[[checks]]` state, with what they assume
    #[arg(long, conflicts_with = "json")]
    pub rows: bool,
    /// Print what the file's numbers measure, and what does not agree
    #[arg(long, conflicts_with_all = ["json", "rows"])]
    pub units: bool,
}

#[derive(Debug, Args)]
pub struct Verify {
    /// The problem file (TOML)
    pub file: PathBuf,
    /// The point: a result.json, or a CSV with the columns name,value
    pub answer: PathBuf,
    /// Print the result as one JSON object on standard output
    #[arg(long)]
    pub json: bool,
    /// After it, the numbers the certificate measures by, each with its inequality
    #[arg(long, conflicts_with = "json")]
    pub parameters: bool,
    #[command(flatten)]
    pub changes: Changes,
    #[command(flatten)]
    pub limits: Limits,
}

#[derive(Debug, Args)]
pub struct Analyse {
    /// The problem file (TOML)
    pub file: PathBuf,
    /// Where: a result.json, or a CSV with the columns name,value; the start without it
    pub answer: Option<PathBuf>,
    /// Print everything as one JSON object on standard output
    #[arg(long)]
    pub json: bool,
    /// The derivative of every definition by every variable, too
    #[arg(long)]
    pub gradient: bool,
    /// Leave tables (displacements, reactions, forces, utilisation) and pictures (displaced shape, courses of forces, VTU) in this folder
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    #[command(flatten)]
    pub changes: Changes,
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn the_definition_holds_together() {
        Arguments::command().debug_assert();
    }
}

//! What can be typed after `ribopt sweep`.

use std::path::PathBuf;

use clap::Args;
use ribopt::study::Share;

#[derive(Debug, Args)]
pub struct Sweep {
    /// The study file (TOML)
    pub study: PathBuf,
    /// The study's folder; default: results/<file stem>
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Chains worked on at a time [default: as many as there are cores]
    #[arg(long, short, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub jobs: Option<u16>,
    /// Forget what an earlier study left in the folder
    #[arg(long)]
    pub fresh: bool,
    /// Tell how far the study is; work on nothing
    #[arg(long, group = "what")]
    pub status: bool,
    /// Put the finished chains together; work on nothing
    #[arg(long, group = "what")]
    pub merge: bool,
    /// Forget the chains with such points, and work on them anew: failed, limit, crashed, mistake or any status
    #[arg(long, value_name = "STATUS,…", value_delimiter = ',', conflicts_with_all = ["what", "fresh"])]
    pub retry: Vec<String>,
    /// Work on one of several shares, as in 3/64, and merge nothing
    #[arg(long, value_name = "K/N", group = "what", value_parser = Share::parse)]
    pub shard: Option<Share>,
    /// Work on the share that a launcher's environment names (Slurm, MPI, HyperQueue), on everything without one; merge nothing
    #[arg(long, group = "what")]
    pub worker: bool,
    /// Hand the study to Slurm: an array of workers and a job that merges after it; what follows -- goes to sbatch
    #[arg(long, group = "what")]
    pub slurm: bool,
    /// Workers of --slurm; shares of a --worker whose launcher does not say how many there are
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=100_000))]
    pub shards: Option<u32>,
    /// Print the summary as one JSON object on standard output
    #[arg(long)]
    pub json: bool,
    /// No progress and no summary; errors only
    #[arg(long, short)]
    pub quiet: bool,
    /// For sbatch, after --
    #[arg(last = true, value_name = "SBATCH")]
    pub sbatch: Vec<String>,
}

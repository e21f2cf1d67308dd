//! What can be typed after `ribopt section`.

use std::path::PathBuf;

use clap::Args;

use super::Changes;

#[derive(Debug, Args)]
pub struct Section {
    /// The problem file (TOML)
    #[arg(required_unless_present = "kind", conflicts_with = "kind")]
    pub file: Option<PathBuf>,
    /// Sections of the file; default: all (the first thousand)
    pub sections: Vec<String>,
    /// The variables' values: a result.json or a CSV with the columns name,value; default: the file's starts
    #[arg(long, value_name = "ANSWER", requires = "file")]
    pub answer: Option<PathBuf>,
    /// Instead of a file: a kind of section
    #[arg(long, value_name = "KIND", requires = "dims")]
    pub kind: Option<String>,
    /// Its dimensions, as in b=0.2,h=0.5
    #[arg(long, value_name = "NAME=NUMBER,…", requires = "kind")]
    pub dims: Option<String>,
    /// Points of a kind drawn by points, as in "0 0; 0.4 0; 0.4 0.3"; holes of a polygon after a bar: "… | 0.1 0.1; …"
    #[arg(long, value_name = "X Y; … | …", requires = "kind", allow_hyphen_values = true)]
    pub points: Option<String>,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
    /// Draw the sections into this file
    #[arg(long, value_name = "FILE")]
    pub svg: Option<PathBuf>,
    #[command(flatten)]
    pub changes: Changes,
}

//! Checks by design codes: worked examples, every clause governing once, what is printed, and derivatives.

mod examples;
mod governing;
mod printed;
mod system;

use std::path::PathBuf;

use ribopt::run::Subject;

/// A bar from a fixed end along x: an axial force −N and moments at its free end are those of every station.
pub struct Bar<'a> {
    pub length: f64,
    /// Compression, My and Mz.
    pub forces: [f64; 3],
    pub kind: &'a str,
    /// Dimensions of the section, in mm.
    pub dimensions: &'a str,
    /// The rest of `[[checks]]`, in N and mm.
    pub check: &'a str,
    pub minimize: &'a str,
}

impl Bar<'_> {
    pub fn text(&self) -> String {
        let Bar { length, forces: [n, my, mz], kind, dimensions, check, minimize } = self;
        format!(
            "minimize = \"{minimize}\"\n[structure]\n[materials.S]\nE = 210e3\nnu = 0.3\nfy = 355\nfy235 = 235\n\
             [nodes]\na = [0, 0, 0]\nb = [{length}, 0, 0]\n[supports]\na = \"fixed\"\n\
             [sections.s]\nkind = \"{kind}\"\n{dimensions}\n\
             [[ribs]]\nname = \"bar\"\nstart = \"a\"\nend = \"b\"\nsection = \"s\"\n\
             [[loads]]\ncase = \"P\"\nnodes = [\"b\"]\nforce = [-{n}, 0, 0]\nmoment = [0, {my}, {mz}]\n\
             [[checks]]\nname = \"k\"\nribs = \"bar\"\ncases = \"P\"\n{check}\n"
        )
    }

    pub fn subject(&self) -> Subject {
        let text = self.text();
        Subject::of_text("bar.toml", &text).unwrap_or_else(|error| panic!("{error}\n{text}"))
    }
}

pub fn in_repository(path: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join(path)
}

/// Names and values of all rows at the start.
pub fn rows(subject: &Subject) -> Vec<(String, f64)> {
    let model = subject.shown();
    let mut values = vec![0.0; model.meta().rows()];
    model.constraints(&model.meta().start, &mut values).unwrap();
    (0..values.len()).map(|i| (model.row_name(i), values[i])).collect()
}

/// The largest value of the rows that state a clause.
pub fn largest(subject: &Subject, clause: &str) -> f64 {
    let wanted = format!("k {clause}[");
    let of_clause = rows(subject).into_iter().filter(|(name, _)| name.starts_with(&wanted)).map(|(_, value)| value);
    let found = of_clause.fold(f64::NEG_INFINITY, f64::max);
    assert!(found.is_finite(), "no row states {clause}");
    found
}

//! What keeps a command from doing its work: told on standard error, and as JSON where that was asked for. Exit code 2.

use std::io;

use thiserror::Error;

use super::output;
use ribopt::mesh::commands::CommandError;
use ribopt::report::result::{Mistake, write_mistakes};
use ribopt::run::RunError;
use ribopt::study::StudyError;

/// The exit code of a wrong command line or problem file.
const EXIT_WRONG: u8 = 2;

/// Why a command did not do its work.
#[derive(Debug, Error)]
pub enum Failure {
    /// The arguments are wrong.
    #[error("{}", .0.render())]
    Arguments(clap::Error),
    /// The run could not begin, or leave its files.
    #[error(transparent)]
    Run(#[from] RunError),
    /// A stage of the mesh could not be done.
    #[error(transparent)]
    Mesh(#[from] CommandError),
    /// A study could not be worked on.
    #[error(transparent)]
    Study(StudyError),
    /// Standard output cannot be written to.
    #[error("cannot write to standard output: {0}; make room there or send it elsewhere")]
    Output(io::Error),
    /// Anything else that was asked for and cannot be.
    #[error("{0}")]
    Request(String),
}

impl From<StudyError> for Failure {
    fn from(error: StudyError) -> Self {
        match error {
            StudyError::Run(error) => Failure::Run(error),
            other => Failure::Study(other),
        }
    }
}

impl Failure {
    /// Tells the user and returns the exit code.
    pub fn tell(self, json: bool) -> u8 {
        match &self {
            // These come with a headline of their own.
            Failure::Arguments(_) | Failure::Run(RunError::Input(..)) => output::note(self.to_string().trim_end()),
            _ => output::note(&format!("error: {self}")),
        }
        if json && !matches!(self, Failure::Output(_)) {
            let (message, mistakes) = self.parts();
            // Where even this cannot be written, the exit code still tells.
            let _ = output::print(|out| write_mistakes(&message, &mistakes, out));
        }
        EXIT_WRONG
    }

    fn parts(&self) -> (String, Vec<Mistake>) {
        match self {
            Failure::Run(error) => {
                let message =
                    if matches!(error, RunError::Input(..)) { "the problem file is wrong".into() } else { error.to_string() };
                (message, error.mistakes())
            }
            Failure::Arguments(error) => {
                // The headline says what is wrong; what follows it is how to use the command.
                let text = error.render().to_string();
                let (headline, usage) = text.split_once("\n\n").unwrap_or((&text, ""));
                let message = headline.trim_start_matches("error: ").trim_end().to_string();
                let help = (!usage.is_empty()).then(|| usage.trim().to_string());
                (message.clone(), vec![Mistake { help, ..Mistake::of_command(message) }])
            }
            other => (other.to_string(), vec![Mistake::of_command(other.to_string())]),
        }
    }
}

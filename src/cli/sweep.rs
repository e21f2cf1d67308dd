//! `ribopt sweep`

use std::io::{self, IsTerminal};
use std::path::Path;
use std::sync::Mutex;

use serde::Serialize;

use super::arguments::Sweep;
use super::failure::Failure;
use super::progress::{Line, bar};
use super::{interrupt, output};
use ribopt::report::result::write_value;
use ribopt::report::text::count;
use ribopt::run::folder::default_folder;
use ribopt::study::{self, Ended, Request, Seen, Share, Store, Study, StudyError, TABLE, Table, retry, submit, work};

/// Works on a study, or does with it what was asked for.
pub fn run(arguments: &Sweep) -> Result<u8, Failure> {
    let study = Study::read(&arguments.study)?;
    let default = default_folder(&arguments.study);
    let folder = arguments.out.as_deref().unwrap_or(&default);
    if arguments.slurm {
        return hand_over(arguments, &study, folder);
    }
    if !arguments.sbatch.is_empty() {
        return Err(Failure::Request("what follows -- goes to sbatch: add --slurm, or leave it out".into()));
    }
    if arguments.status || arguments.merge {
        let store = Store::existing(&study, folder).map_err(StudyError::from)?;
        return told(arguments, &study, &store, arguments.merge);
    }
    let store = Store::open(&study, folder, arguments.fresh).map_err(StudyError::from)?;
    retry(&study, &store, &arguments.retry)?;
    let shards = arguments.shards.map(|shards| shards as usize);
    let environment = || Share::of_environment(|name| std::env::var(name).ok(), shards);
    let share = arguments.shard.unwrap_or_else(|| if arguments.worker { environment() } else { Share::default() });
    let ended = match worked(arguments, &study, &store, share) {
        // An answer, and not a certified one.
        Err(Failure::Study(stopped @ StudyError::Stopped { .. })) => {
            output::note(&format!("error: {stopped}"));
            return Ok(1);
        }
        ended => ended?,
    };
    if ended == Ended::Interrupted {
        output::note("interrupted: finished chains stay, and the same command goes on from there");
        return Ok(interrupt::code(5));
    }
    if arguments.worker || arguments.shard.is_some() {
        return Ok(0);
    }
    told(arguments, &study, &store, true)
}

fn worked(arguments: &Sweep, study: &Study, store: &Store, share: Share) -> Result<Ended, Failure> {
    let line = Mutex::new((!arguments.quiet && io::stderr().is_terminal()).then(|| Line::new(io::stderr())));
    let watch = |seen: Seen| {
        let mut line = line.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
        line.iter_mut().for_each(|line| line.show(|| bar(&study.title, seen.done as u64, seen.of as u64)));
    };
    let jobs = arguments.jobs.map_or(0, usize::from);
    let request = Request { jobs, share, interrupt: Some(interrupt::flag()), watch: &watch };
    let ended = work(study, store, &request);
    line.into_inner().unwrap_or_else(|poisoned| poisoned.into_inner()).iter_mut().for_each(Line::clear);
    let ended = ended?;
    interrupt::release();
    Ok(ended)
}

/// What `--json` prints.
#[derive(Serialize)]
struct Summary<'a> {
    format: &'static str,
    study: String,
    folder: String,
    points: usize,
    missing: usize,
    claimed: usize,
    status: Vec<(&'a str, usize)>,
    table: Option<String>,
}

/// Merges where that is wanted, and says how far the study is. Exit code 1 where a point is missing or brought no answer.
fn told(arguments: &Sweep, study: &Study, store: &Store, merge: bool) -> Result<u8, Failure> {
    let table = if merge { study::merge(study, store).map_err(StudyError::from)? } else { Table::of(study, store) };
    let place = store.folder().join(TABLE);
    let summary = Summary {
        format: "ribopt-sweep/1",
        study: study.file.display().to_string(),
        folder: store.folder().display().to_string(),
        points: table.rows.len() + table.missing,
        missing: table.missing,
        claimed: store.claims(),
        status: table.counts(),
        table: merge.then(|| place.display().to_string()),
    };
    if arguments.json {
        output::print(|out| write_value(&summary, out))?;
    } else if !arguments.quiet {
        output::print(|out| {
            let counts: Vec<String> = summary.status.iter().map(|(status, count)| format!("{count} {status}")).collect();
            let counts = if counts.is_empty() { "nothing is finished yet".into() } else { counts.join(", ") };
            writeln!(out, "{}: {}: {counts}", study.title, count(summary.points, "point"))?;
            if table.missing > 0 {
                let claimed =
                    if summary.claimed > 0 { format!("; {} at work", count(summary.claimed, "chain")) } else { String::new() };
                writeln!(out, "{} missing{claimed}", table.missing)?;
            }
            if merge { writeln!(out, "table: {}", place.display()) } else { Ok(()) }
        })?;
    }
    Ok(u8::from(table.missing > 0 || table.rows.iter().any(ribopt::study::Row::has_failed)))
}

fn hand_over(arguments: &Sweep, study: &Study, folder: &Path) -> Result<u8, Failure> {
    let Some(shards) = arguments.shards else {
        return Err(Failure::Request("how many workers? as in --slurm --shards 64".into()));
    };
    // Workers find the folder made, so that none of them begins it anew.
    Store::open(study, folder, arguments.fresh).map_err(StudyError::from)?;
    let submission = submit(&study.file, folder, shards as usize, &arguments.sbatch)?;
    if !arguments.quiet {
        output::print(|out| {
            writeln!(out, "workers: job {}, {}", submission.array, count(shards as usize, "task"))?;
            writeln!(out, "merge: job {}; table: {}", submission.merge, folder.join(TABLE).display())
        })?;
    }
    Ok(0)
}

//! Points per second of a study beside the bare solves of the same points: `cargo run --release --example study_rate`.
//!
//! The bare solves read the problem with the point's numbers and solve it from its start, on as many threads as the study has, without chains,
//! sensitivities, claims and files.

use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

use ribopt::run::Subject;
use ribopt::run::solve::outcome;
use ribopt::study::{Request, Share, Store, Study, Table, work};

const STUDY: &str = r#"
problem = "rib.toml"
[vary]
sag_limit = { from = "9.0/500", to = "9.0/200", count = 100 }
"support.b.upper" = { from = 0.2, to = 0.4, count = 100 }
"#;

fn main() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let problem = folder.path().join("rib.toml");
    std::fs::copy("problems/haunched-floor-rib.toml", &problem).expect("the problem");
    let file = folder.path().join("study.toml");
    std::fs::write(&file, STUDY).expect("the study");
    for jobs in [1, 2] {
        let bare = bare(&problem, jobs);
        println!("{jobs} thread(s): bare solves {bare:.0} per second");
        let studied = studied(&file, folder.path(), jobs);
        println!("{jobs} thread(s): the study  {studied:.0} per second, {:.0} %", 100.0 * studied / bare);
    }
}

/// A tenth of the points, every tenth of either name.
fn bare(problem: &Path, jobs: usize) -> f64 {
    let points: Vec<[f64; 2]> =
        (0..1000).map(|at| [0.018 + 0.027 * f64::from(at % 100) / 99.0, 0.2 + 0.2 * f64::from(at / 100) / 9.0]).collect();
    let (next, begun) = (AtomicUsize::new(0), Instant::now());
    std::thread::scope(|scope| {
        for _ in 0..jobs {
            scope.spawn(|| {
                let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
                pool.install(|| {
                    while let Some([sag, width]) = points.get(next.fetch_add(1, Ordering::Relaxed)) {
                        let changes = [format!("sag_limit={sag:?}"), format!("support.b.upper={width:?}")];
                        let subject = Subject::read(problem, &changes).unwrap_or_else(|error| panic!("{error}"));
                        outcome(&subject).unwrap_or_else(|error| panic!("{error}"));
                    }
                });
            });
        }
    });
    points.len() as f64 / begun.elapsed().as_secs_f64()
}

fn studied(file: &Path, folder: &Path, jobs: usize) -> f64 {
    let study = Study::read(file).unwrap_or_else(|error| panic!("{error}"));
    let store = Store::open(&study, &folder.join(format!("out-{jobs}")), false).unwrap_or_else(|error| panic!("{error}"));
    let begun = Instant::now();
    let request = Request { jobs, share: Share::default(), interrupt: None, watch: &|_| {} };
    work(&study, &store, &request).unwrap_or_else(|error| panic!("{error}"));
    let rate = study.points() as f64 / begun.elapsed().as_secs_f64();
    let table = Table::of(&study, &store);
    assert!(table.rows.iter().all(|row| row.is_certified()), "{:?}", table.counts());
    rate
}

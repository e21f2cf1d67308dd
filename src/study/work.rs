//! Works on a study's chains, on all cores, until none is left.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Condvar, Mutex};
use std::time::Duration;

use super::layout::Layout;
use super::store::{BEAT, Store};
use super::{OnFailure, Point, Row, Share, Study, StudyError, point};

/// How long a worker waits before it looks again at what others are at work on.
const WAIT: Duration = Duration::from_millis(200);

/// Bytes of a worker's stack: that of a process' first thread, where solvers run otherwise.
const STACK: usize = 8 << 20;

/// How a study is worked on.
pub struct Request<'a> {
    /// Chains worked on at a time; 0: as many as there are cores.
    pub jobs: usize,
    /// Which chains are this worker's.
    pub share: Share,
    /// Set by Ctrl-C.
    pub interrupt: Option<&'a AtomicBool>,
    /// Sees every finished chain.
    pub watch: &'a (dyn Fn(Seen) + Sync),
}

/// How far the work has come.
#[derive(Debug, Clone, Copy)]
pub struct Seen {
    /// Chains this worker has looked at, done by itself or by others.
    pub done: usize,
    /// Chains that are known by now, of this worker's share.
    pub of: usize,
}

/// How the work ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ended {
    /// Nothing of this worker's share is left.
    Done,
    /// Ctrl-C: finished chains stay.
    Interrupted,
}

/// A chain: its number and its points.
type Chain = (usize, Vec<Point>);

impl Study {
    /// The chains that can be worked on once these rows are known; none at the end.
    pub(super) fn next(&self, known: &[Row]) -> Vec<Chain> {
        match &self.layout {
            Layout::Points(points) if known.is_empty() => {
                let of = |chain: &Vec<usize>| chain.iter().map(|&number| points.points[number].clone()).collect();
                points.chains.iter().map(of).enumerate().collect()
            }
            Layout::Points(_) => Vec::new(),
            Layout::Front(front) => front.next(known).into_iter().map(|point| (point.number, vec![point])).collect(),
        }
    }

    /// Whether points start at the answers before them.
    fn is_warm(&self) -> bool {
        matches!(&self.layout, Layout::Points(points) if points.warm)
    }
}

/// Works until nothing is left of the share, or Ctrl-C. The rounds of a front are everybody's: each waits for the one before.
///
/// # Errors
/// A folder that cannot be written to, a problem that has changed, a failure where the study stops at failures.
pub fn work(study: &Study, store: &Store, request: &Request<'_>) -> Result<Ended, StudyError> {
    let is_known = matches!(study.layout, Layout::Points(_));
    let mut known: Vec<Row> = Vec::new();
    loop {
        let mut chains = study.next(&known);
        if chains.is_empty() {
            return Ok(Ended::Done);
        }
        if is_known {
            chains.retain(|(number, _)| request.share.holds(*number));
        } else {
            let first = request.share.index % chains.len();
            chains.rotate_left(first);
        }
        let round = Round { study, store, request, chains: &chains, ended: AtomicBool::new(false), done: AtomicUsize::new(0) };
        round.run()?;
        if round.is_interrupted() {
            return Ok(Ended::Interrupted);
        }
        if is_known {
            return Ok(Ended::Done);
        }
        let mut found: Vec<Row> = chains.iter().filter_map(|(number, points)| store.rows_of(*number, points)).flatten().collect();
        found.sort_by_key(|row| row.point);
        known.extend(found);
    }
}

/// Chains that depend on nothing that is not known.
struct Round<'a> {
    study: &'a Study,
    store: &'a Store,
    request: &'a Request<'a>,
    chains: &'a [Chain],
    /// Set where a worker has failed: the others end too.
    ended: AtomicBool,
    done: AtomicUsize,
}

impl Round<'_> {
    fn is_interrupted(&self) -> bool {
        self.request.interrupt.is_some_and(|flag| flag.load(Ordering::Relaxed))
    }

    fn is_over(&self) -> bool {
        self.is_interrupted() || self.ended.load(Ordering::Relaxed)
    }

    /// Works with as many threads as are wanted, each with its share of the cores.
    fn run(&self) -> Result<(), StudyError> {
        let cores = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
        let jobs = if self.request.jobs == 0 { cores } else { self.request.jobs }.clamp(1, self.chains.len().max(1));
        let (next, bell) = (AtomicUsize::new(0), Bell::default());
        std::thread::scope(|scope| {
            scope.spawn(|| {
                while !bell.rings_within(BEAT) {
                    self.store.beat();
                }
            });
            let worker = || {
                let pool = rayon::ThreadPoolBuilder::new().num_threads((cores / jobs).max(1)).stack_size(STACK).build();
                let result = match pool {
                    Ok(pool) => pool.install(|| self.worker(&next)),
                    Err(error) => {
                        Err(StudyError::Request(format!("no further thread can be started: {error}; try fewer --jobs")))
                    }
                };
                if result.is_err() {
                    self.ended.store(true, Ordering::Relaxed);
                }
                result
            };
            let workers: Vec<_> = (0..jobs).map(|_| scope.spawn(worker)).collect();
            let results: Vec<Result<(), StudyError>> = workers
                .into_iter()
                .map(|worker| worker.join().unwrap_or_else(|_| Err(StudyError::Request("a worker ended unexpectedly".into()))))
                .collect();
            bell.ring();
            results.into_iter().collect()
        })
    }

    /// Takes chain after chain; then waits for those that others have claimed, and takes over what they leave.
    fn worker(&self, next: &AtomicUsize) -> Result<(), StudyError> {
        let mut left = Vec::new();
        while !self.is_over() {
            let Some(chain) = self.chains.get(next.fetch_add(1, Ordering::Relaxed)) else { break };
            if !self.attempt(chain)? {
                left.push(chain);
            }
        }
        while !left.is_empty() && !self.is_over() {
            std::thread::sleep(WAIT);
            let mut still = Vec::new();
            for chain in left {
                if !self.attempt(chain)? {
                    still.push(chain);
                }
            }
            left = still;
        }
        Ok(())
    }

    /// Works on a chain; `false` where somebody else does.
    fn attempt(&self, (number, points): &Chain) -> Result<bool, StudyError> {
        let is_done = || self.store.rows_of(*number, points).is_some();
        if is_done() {
            self.store.clear(*number)?;
            self.seen();
            return Ok(true);
        }
        let Some(claim) = self.store.claim(*number)? else { return Ok(false) };
        // It may have been finished between the look and the claim.
        if !is_done()
            && let Some(rows) = self.rows(points, &|point| Ok(claim.begin(point)?))?
        {
            self.store.finish(*number, rows)?;
        }
        self.seen();
        Ok(true)
    }

    fn seen(&self) {
        let done = self.done.fetch_add(1, Ordering::Relaxed) + 1;
        (self.request.watch)(Seen { done, of: self.chains.len() });
    }

    /// The rows of a chain; `None` where it was interrupted.
    fn rows(&self, points: &[Point], begin: &dyn Fn(usize) -> Result<bool, StudyError>) -> Result<Option<Vec<Row>>, StudyError> {
        let (mut rows, mut warm) = (Vec::with_capacity(points.len()), None);
        for (at, point) in points.iter().enumerate() {
            if self.is_over() {
                return Ok(None);
            }
            if !begin(point.number)? {
                let message = "its worker ended twice while it was at work on this point".to_owned();
                rows.push(Row::without_numbers(point, "crashed", None, message));
                continue;
            }
            let also_cold = at % self.study.options.cold_every as usize == 0;
            let from = warm.as_ref().filter(|_| self.study.is_warm());
            let solve = || point::solve(self.study, point, (from, also_cold), self.request.interrupt);
            // One panic is one row: the other points are as good as ever.
            let solved = catch_unwind(AssertUnwindSafe(solve)).unwrap_or_else(|panic| Ok(Some((panicked(point, &*panic), None))));
            let Some((row, next)) = solved? else { return Ok(None) };
            if row.has_failed() && self.study.options.on_failure == OnFailure::Stop {
                return Err(StudyError::Stopped { point: row.point, message: row.message });
            }
            rows.push(row);
            warm = next.or(warm);
        }
        Ok(Some(rows))
    }
}

fn panicked(point: &Point, panic: &(dyn std::any::Any + Send)) -> Row {
    let said = panic.downcast_ref::<String>().map(String::as_str).or_else(|| panic.downcast_ref::<&str>().copied());
    let message = format!("ribopt failed at this point; please report it: {}", said.unwrap_or("no more is known"));
    Row::without_numbers(point, "crashed", None, message)
}

/// Ends a thread that waits.
#[derive(Default)]
struct Bell {
    rung: Mutex<bool>,
    changed: Condvar,
}

impl Bell {
    fn ring(&self) {
        *self.rung.lock().unwrap_or_else(|poisoned| poisoned.into_inner()) = true;
        self.changed.notify_all();
    }

    /// Whether it rings within this time.
    fn rings_within(&self, time: Duration) -> bool {
        let rung = self.rung.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
        let waited = self.changed.wait_timeout_while(rung, time, |rung| !*rung);
        *waited.unwrap_or_else(|poisoned| poisoned.into_inner()).0
    }
}

//! NLopt on a thread of its own, the model on the thread that called: whatever NLopt does, the caller can leave it.
//!
//! NLopt ends a run only between two calls of the model's functions. Its C code has loops that may never reach the next one:
//! COBYLA's `trstlp` on data whose differences overflow, a dense factorisation that takes longer than the time left. Nothing
//! inside this process can stop such a loop, and a function called from it cannot either, since it is not called.
//! Therefore the loop runs on a thread that owns all it touches (bounds, start, buffers: plain numbers), and asks for values
//! through a channel. The calling thread, which borrows the model, answers until the run is over, until NLopt has been silent
//! for [`GRACE`] past a deadline or an interrupt, or for [`SILENCE`] without either; then it drops its ends of the channels and
//! goes on. A thread left in that way reaches nothing that is borrowed (the compiler checks it: the closure is `'static`), is
//! told to stop by the closed channel should it ever ask again, and ends with the process, which does not wait for it.
//!
//! The cost is two changes of thread for each point (20 to 90 µs, more on a busy machine), for objective, rows and derivatives
//! together. SLSQP alone runs on the calling thread (`Algorithm::is_bounded`): between two calls its source does a bounded amount
//! of work whatever the numbers are, at most 5 resets of at most 6 subproblems, in each of which NNLS makes at most 3(m + 2n)
//! exchanges, and `algorithms` lets it through only where one of them takes a fraction of a second.

use std::sync::mpsc::{Receiver, RecvTimeoutError, SyncSender, sync_channel};
use std::thread;
use std::time::{Duration, Instant};

use super::ffi::{self, Functions, Halt, Outcome, Setup};

/// How long NLopt may go on without a call after a deadline or an interrupt: orderly ends take microseconds.
const GRACE: Duration = Duration::from_millis(300);
/// The longest silence where nobody set a deadline. The steps of the shapes that `algorithms` lets through take seconds, so
/// that only a loop without end reaches it.
const SILENCE: Duration = Duration::from_secs(600);
/// Between two looks at deadline and interrupt while NLopt is silent.
const LOOK: Duration = Duration::from_millis(20);

/// One point, what is asked about it, and the answer.
#[derive(Debug, Default)]
pub(super) struct Exchange {
    /// The point, length n.
    pub w: Vec<f64>,
    /// Whether derivatives are wanted.
    pub derivatives: bool,
    /// f(w)
    pub objective: f64,
    /// ∇f(w), length n.
    pub gradient: Vec<f64>,
    /// g(w) ≤ 0 and its Jacobian by rows.
    pub inequalities: Rows,
    /// h(w) = 0 and its Jacobian by rows.
    pub equalities: Rows,
}

/// Values and dense derivatives of rows of one kind.
#[derive(Debug, Default)]
pub(super) struct Rows {
    /// One for each row.
    pub values: Vec<f64>,
    /// m·n numbers.
    pub jacobian: Vec<f64>,
}

impl Rows {
    fn sized(n: usize, m: usize) -> Self {
        Rows { values: vec![0.0; m], jacobian: vec![0.0; m * n] }
    }

    fn copy_to(&self, values: &mut [f64], jacobian: Option<&mut [f64]>) {
        copy(&self.values, values);
        if let Some(jacobian) = jacobian {
            copy(&self.jacobian, jacobian);
        }
    }
}

/// Never panics: a panic must not cross NLopt's frames.
fn copy(from: &[f64], to: &mut [f64]) {
    to.iter_mut().zip(from).for_each(|(to, from)| *to = *from);
}

enum Message {
    Asks(Box<Exchange>),
    Ended(Option<Outcome>, Vec<f64>),
}

/// The functions as NLopt sees them: one question for each point.
struct Asker<'a> {
    /// Gives the exchange back with its answer, or `None` where the run must end.
    ask: &'a mut dyn FnMut(Box<Exchange>) -> Option<Box<Exchange>>,
    /// The last point answered; `None` after the end.
    at: Option<Box<Exchange>>,
    is_known: bool,
}

impl<'a> Asker<'a> {
    fn new(setup: &Setup, n: usize, ask: &'a mut dyn FnMut(Box<Exchange>) -> Option<Box<Exchange>>) -> Self {
        let exchange = Exchange {
            w: vec![0.0; n],
            gradient: vec![0.0; n],
            inequalities: Rows::sized(n, setup.inequalities),
            equalities: Rows::sized(n, setup.equalities),
            ..Exchange::default()
        };
        Asker { ask, at: Some(Box::new(exchange)), is_known: false }
    }

    /// What is known at w; asked for where it is new, or was asked without derivatives.
    fn at(&mut self, w: &[f64], derivatives: bool) -> Result<&Exchange, Halt> {
        let mut exchange = self.at.take().ok_or(Halt)?;
        if !(self.is_known && exchange.w == w && (exchange.derivatives || !derivatives)) {
            copy(w, &mut exchange.w);
            exchange.derivatives = derivatives;
            exchange = (self.ask)(exchange).ok_or(Halt)?;
            self.is_known = true;
        }
        Ok(self.at.insert(exchange))
    }
}

impl Functions for Asker<'_> {
    fn objective(&mut self, w: &[f64], gradient: Option<&mut [f64]>) -> Result<f64, Halt> {
        // Every call counts as an evaluation and is seen by the watch.
        self.is_known = false;
        let exchange = self.at(w, gradient.is_some())?;
        if let Some(gradient) = gradient {
            copy(&exchange.gradient, gradient);
        }
        Ok(exchange.objective)
    }

    fn inequalities(&mut self, w: &[f64], values: &mut [f64], jacobian: Option<&mut [f64]>) -> Result<(), Halt> {
        self.at(w, jacobian.is_some())?.inequalities.copy_to(values, jacobian);
        Ok(())
    }

    fn equalities(&mut self, w: &[f64], values: &mut [f64], jacobian: Option<&mut [f64]>) -> Result<(), Halt> {
        self.at(w, jacobian.is_some())?.equalities.copy_to(values, jacobian);
        Ok(())
    }
}

/// How a run ended.
pub(super) enum End {
    /// NLopt returned, with this point.
    Returned(Outcome, Vec<f64>),
    /// NLopt could not be set up.
    Unable,
    /// NLopt was silent for too long, and was left.
    Left,
}

/// What runs on the thread: [`ffi::minimise`], or a stand-in of the tests.
type Run = fn(&Setup, &mut dyn Functions, &mut [f64]) -> Option<Outcome>;

/// Answers the questions of a run.
pub(super) type Answer<'a> = &'a mut dyn FnMut(&mut Exchange) -> Result<(), Halt>;

/// Runs NLopt from `start` on this thread: for algorithms that are bounded between two calls.
pub(super) fn minimise_here(setup: &Setup, mut start: Vec<f64>, answer: Answer<'_>) -> End {
    let mut ask = |mut exchange: Box<Exchange>| answer(&mut exchange).is_ok().then_some(exchange);
    let mut asker = Asker::new(setup, start.len(), &mut ask);
    match ffi::minimise(setup, &mut asker, &mut start) {
        Some(outcome) => End::Returned(outcome, start),
        None => End::Unable,
    }
}

/// Runs NLopt from `start` on a thread of its own. `is_over` says whether a deadline has passed or an interrupt came.
pub(super) fn minimise(setup: Setup, start: Vec<f64>, answer: Answer<'_>, is_over: &dyn Fn() -> bool) -> End {
    spawn(ffi::minimise, setup, start, answer, is_over)
}

fn spawn(run: Run, setup: Setup, start: Vec<f64>, answer: Answer<'_>, is_over: &dyn Fn() -> bool) -> End {
    let (to_caller, asked) = sync_channel(1);
    let (reply, replies) = sync_channel(1);
    let thread = thread::Builder::new().name("nlopt".into()).spawn(move || {
        let mut ask = |exchange| {
            to_caller.send(Message::Asks(exchange)).ok()?;
            replies.recv().ok().flatten()
        };
        let mut x = start;
        let outcome = run(&setup, &mut Asker::new(&setup, x.len(), &mut ask), &mut x);
        // Nobody listens any more where the run was left.
        let _ = to_caller.send(Message::Ended(outcome, x));
    });
    let Ok(thread) = thread else { return End::Unable };
    let end = serve(&asked, &reply, answer, is_over);
    if !matches!(end, End::Left) {
        // It has sent its last message; a panic in it would have closed the channel, which reads as `Unable`.
        let _ = thread.join();
    }
    end
}

fn serve(
    asked: &Receiver<Message>,
    reply: &SyncSender<Option<Box<Exchange>>>,
    answer: Answer<'_>,
    is_over: &dyn Fn() -> bool,
) -> End {
    loop {
        match next(asked, is_over) {
            Some(Message::Asks(mut exchange)) => {
                let answered = answer(&mut exchange).is_ok();
                let _ = reply.send(answered.then_some(exchange));
            }
            Some(Message::Ended(Some(outcome), x)) => return End::Returned(outcome, x),
            Some(Message::Ended(None, _)) => return End::Unable,
            None => return End::Left,
        }
    }
}

/// The next message; `None` where it does not come in time.
fn next(asked: &Receiver<Message>, is_over: &dyn Fn() -> bool) -> Option<Message> {
    let silent_since = Instant::now();
    let mut over_since: Option<Instant> = None;
    loop {
        match asked.recv_timeout(LOOK) {
            Ok(message) => return Some(message),
            Err(RecvTimeoutError::Disconnected) => return Some(Message::Ended(None, Vec::new())),
            Err(RecvTimeoutError::Timeout) => {}
        }
        if is_over() {
            over_since.get_or_insert_with(Instant::now);
        }
        if over_since.is_some_and(|moment| moment.elapsed() >= GRACE) || silent_since.elapsed() >= SILENCE {
            return None;
        }
    }
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicUsize, Ordering};

    use super::*;

    fn setup(n: usize) -> Setup {
        Setup {
            algorithm: "LD_SLSQP",
            inner: None,
            lower: vec![-1.0; n],
            upper: vec![1.0; n],
            inequalities: 0,
            equalities: 0,
            most_equalities: None,
            violation: 0.0,
            tolerance: 1e-10,
            evaluations: 100,
            seconds: None,
            seed: 1,
        }
    }

    fn bowl(exchange: &mut Exchange) -> Result<(), Halt> {
        exchange.objective = exchange.w.iter().map(|w| w * w).sum();
        exchange.gradient = exchange.w.iter().map(|w| 2.0 * w).collect();
        Ok(())
    }

    #[test]
    fn nlopt_on_its_own_thread_finds_the_bottom_of_a_bowl() {
        let End::Returned(outcome, x) = minimise(setup(2), vec![0.5, -0.3], &mut bowl, &|| false) else { panic!("no answer") };
        assert!(outcome.code > 0, "{}", outcome.message);
        assert!(x.iter().all(|x| x.abs() < 1e-6), "{x:?}");
    }

    /// What COBYLA's `trstlp` does on numbers that overflow: a loop in which no function is called. It ends here only so that
    /// the test's process does not go on calculating.
    fn loops(_: &Setup, functions: &mut dyn Functions, x: &mut [f64]) -> Option<Outcome> {
        let _ = functions.objective(x, None);
        thread::sleep(Duration::from_secs(20));
        ASKED_AFTER.store(if functions.objective(x, None).is_err() { 1 } else { 2 }, Ordering::Relaxed);
        None
    }

    static ASKED_AFTER: AtomicUsize = AtomicUsize::new(0);

    #[test]
    fn a_loop_that_never_calls_back_is_left_after_the_deadline() {
        let began = Instant::now();
        let deadline = began + Duration::from_millis(100);
        let end = spawn(loops, setup(1), vec![0.5], &mut bowl, &|| Instant::now() >= deadline);
        assert!(matches!(end, End::Left));
        assert!(began.elapsed() < Duration::from_secs(10), "{:?}", began.elapsed());
        assert_eq!(ASKED_AFTER.load(Ordering::Relaxed), 0, "the loop is still on");
    }

    fn panics(_: &Setup, _: &mut dyn Functions, _: &mut [f64]) -> Option<Outcome> {
        panic!("a bug on the other thread")
    }

    #[test]
    fn a_thread_that_dies_is_an_answer() {
        assert!(matches!(spawn(panics, setup(1), vec![0.5], &mut bowl, &|| false), End::Unable));
    }

    #[test]
    fn more_equalities_than_slsqp_has_memory_for_never_reach_it() {
        let surplus = Setup { equalities: 8, most_equalities: Some(3), ..setup(3) };
        assert!(matches!(minimise(surplus, vec![0.5; 3], &mut bowl, &|| false), End::Unable));
        let without_room = Setup { upper: vec![-1.0, 1.0], ..setup(2) };
        assert!(matches!(minimise(without_room, vec![-1.0, 0.5], &mut bowl, &|| false), End::Unable));
    }
}

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
//! The cost is two changes of thread for each point, 5 to 20 µs, for objective, rows and derivatives together; one rule for
//! all algorithms is worth that: gradient algorithms cannot loop for ever as far as their sources show, but one step of
//! theirs can take minutes.

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

/// The functions as NLopt's thread sees them.
struct Remote {
    ask: SyncSender<Message>,
    answer: Receiver<Option<Box<Exchange>>>,
    /// The last point answered; `None` while it is away or after the end.
    at: Option<Box<Exchange>>,
    known: bool,
}

impl Remote {
    /// What is known at w; asked for where it is new, or was asked without derivatives.
    fn at(&mut self, w: &[f64], derivatives: bool) -> Result<&Exchange, Halt> {
        let mut exchange = self.at.take().ok_or(Halt)?;
        if !(self.known && exchange.w == w && (exchange.derivatives || !derivatives)) {
            copy(w, &mut exchange.w);
            exchange.derivatives = derivatives;
            self.ask.send(Message::Asks(exchange)).map_err(|_| Halt)?;
            exchange = self.answer.recv().ok().flatten().ok_or(Halt)?;
            self.known = true;
        }
        Ok(self.at.insert(exchange))
    }
}

impl Functions for Remote {
    fn objective(&mut self, w: &[f64], gradient: Option<&mut [f64]>) -> Result<f64, Halt> {
        // Every call counts as an evaluation and is seen by the watch.
        self.known = false;
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

/// Runs NLopt from `start`. `answer` fills in the exchange, `is_over` says whether a deadline has passed or an interrupt came.
pub(super) fn minimise(
    setup: Setup,
    start: Vec<f64>,
    answer: &mut dyn FnMut(&mut Exchange) -> Result<(), Halt>,
    is_over: &dyn Fn() -> bool,
) -> End {
    let (ask, asked) = sync_channel(1);
    let (reply, replies) = sync_channel(1);
    let thread = thread::Builder::new().name("nlopt".into()).spawn(move || {
        let n = start.len();
        let exchange = Exchange {
            w: vec![0.0; n],
            gradient: vec![0.0; n],
            inequalities: Rows::sized(n, setup.inequalities),
            equalities: Rows::sized(n, setup.equalities),
            ..Exchange::default()
        };
        let mut remote = Remote { ask, answer: replies, at: Some(Box::new(exchange)), known: false };
        let mut x = start;
        let outcome = ffi::minimise(&setup, &mut remote, &mut x);
        // Nobody listens any more where the run was left.
        let _ = remote.ask.send(Message::Ended(outcome, x));
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
    answer: &mut dyn FnMut(&mut Exchange) -> Result<(), Halt>,
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

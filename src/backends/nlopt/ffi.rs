//! The one file that speaks to NLopt's C library, and the only `unsafe` of the crate.
//!
//! The crate `nlopt` is linked for its static library alone: its safe interface lets closures outlive what they borrow,
//! aborts when one panics, and hides `force_stop` and `errmsg`.

#![allow(unsafe_code)]

use std::ffi::{CStr, CString, c_char, c_int, c_uint, c_ulong, c_void};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::slice;

use nlopt as _;

/// An NLopt optimiser, seen from outside.
#[repr(C)]
struct Opaque([u8; 0]);

type Handle = *mut Opaque;
type ObjectiveFn = extern "C" fn(c_uint, *const f64, *mut f64, *mut c_void) -> f64;
type RowsFn = extern "C" fn(c_uint, *mut f64, c_uint, *const f64, *mut f64, *mut c_void);

unsafe extern "C" {
    fn nlopt_algorithm_from_string(name: *const c_char) -> c_int;
    fn nlopt_result_to_string(result: c_int) -> *const c_char;
    fn nlopt_srand(seed: c_ulong);
    fn nlopt_create(algorithm: c_int, n: c_uint) -> Handle;
    fn nlopt_destroy(opt: Handle);
    fn nlopt_optimize(opt: Handle, x: *mut f64, value: *mut f64) -> c_int;
    fn nlopt_set_min_objective(opt: Handle, f: ObjectiveFn, data: *mut c_void) -> c_int;
    fn nlopt_add_inequality_mconstraint(opt: Handle, m: c_uint, f: RowsFn, data: *mut c_void, tol: *const f64) -> c_int;
    fn nlopt_add_equality_mconstraint(opt: Handle, m: c_uint, f: RowsFn, data: *mut c_void, tol: *const f64) -> c_int;
    fn nlopt_set_lower_bounds(opt: Handle, lower: *const f64) -> c_int;
    fn nlopt_set_upper_bounds(opt: Handle, upper: *const f64) -> c_int;
    fn nlopt_set_ftol_rel(opt: Handle, tolerance: f64) -> c_int;
    fn nlopt_set_xtol_rel(opt: Handle, tolerance: f64) -> c_int;
    fn nlopt_set_maxeval(opt: Handle, count: c_int) -> c_int;
    fn nlopt_set_maxtime(opt: Handle, seconds: f64) -> c_int;
    fn nlopt_set_param(opt: Handle, name: *const c_char, value: f64) -> c_int;
    fn nlopt_set_local_optimizer(opt: Handle, local: Handle) -> c_int;
    fn nlopt_force_stop(opt: Handle) -> c_int;
    fn nlopt_get_errmsg(opt: Handle) -> *const c_char;
}

/// What a callback answers when the run must end.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Halt;

/// The functions NLopt calls. Slices have n entries for points and gradients, m for values, m·n (by rows) for Jacobians.
pub(super) trait Functions {
    /// f(x), with ∇f(x) where asked for.
    fn objective(&mut self, x: &[f64], gradient: Option<&mut [f64]>) -> Result<f64, Halt>;
    /// g(x) ≤ 0; the Jacobian comes zeroed.
    fn inequalities(&mut self, x: &[f64], values: &mut [f64], jacobian: Option<&mut [f64]>) -> Result<(), Halt>;
    /// h(x) = 0; the Jacobian comes zeroed.
    fn equalities(&mut self, x: &[f64], values: &mut [f64], jacobian: Option<&mut [f64]>) -> Result<(), Halt>;
}

/// One run, as NLopt wants it told.
pub(super) struct Setup {
    /// NLopt's name, `LD_SLSQP`.
    pub algorithm: &'static str,
    /// The inner algorithm of AUGLAG and MLSL.
    pub inner: Option<&'static str>,
    /// Lower bounds, length n.
    pub lower: Vec<f64>,
    /// Upper bounds, length n, each above its lower bound by a normal number.
    pub upper: Vec<f64>,
    /// Number of inequalities.
    pub inequalities: usize,
    /// Number of equalities.
    pub equalities: usize,
    /// Equalities beyond which the algorithm is not memory-safe.
    pub most_equalities: Option<usize>,
    /// Violation NLopt may overlook.
    pub violation: f64,
    /// Relative change below which NLopt stops.
    pub tolerance: f64,
    /// Evaluations at the most.
    pub evaluations: u64,
    /// Seconds left, where there is a deadline.
    pub seconds: Option<f64>,
    /// Seed of the random algorithms.
    pub seed: u32,
}

/// What came back.
pub(super) struct Outcome {
    /// NLopt's number: positive for its successes.
    pub code: i32,
    /// NLopt's words.
    pub message: String,
}

/// Steps of the dual problem, in one variable per row, inside one iteration of MMA and CCSAQ: NLopt's own limit of 100 000 can
/// take minutes without a single evaluation, in which nothing could stop it; where rows conflict the dual has no end.
fn dual_steps(rows: usize) -> f64 {
    (100.0 * (rows as f64 + 1.0)).clamp(200.0, 2_000.0)
}

struct Optimizer(Handle);

impl Optimizer {
    fn new(name: &str, n: usize) -> Option<Self> {
        let name = CString::new(name).ok()?;
        let n = c_uint::try_from(n).ok()?;
        // SAFETY: `name` is a terminated string that outlives the call.
        let algorithm = unsafe { nlopt_algorithm_from_string(name.as_ptr()) };
        if algorithm < 0 {
            return None;
        }
        // SAFETY: the algorithm's number comes from NLopt itself; a null answer is handled below.
        let handle = unsafe { nlopt_create(algorithm, n) };
        (!handle.is_null()).then_some(Optimizer(handle))
    }

    fn set_tolerance(&self, tolerance: f64) {
        // SAFETY: the handle is live until `drop`.
        unsafe {
            nlopt_set_ftol_rel(self.0, tolerance);
            nlopt_set_xtol_rel(self.0, tolerance);
        }
    }

    fn words(&self, code: c_int) -> String {
        // SAFETY: both functions answer null or a terminated string that lives as long as the handle; it is copied here.
        let texts = unsafe { [nlopt_result_to_string(code), nlopt_get_errmsg(self.0)].map(|text| copied(text)) };
        texts.into_iter().flatten().collect::<Vec<_>>().join(": ")
    }
}

impl Drop for Optimizer {
    fn drop(&mut self) {
        // SAFETY: created by `nlopt_create`, destroyed once.
        unsafe { nlopt_destroy(self.0) }
    }
}

/// # Safety
/// `text` is null or a terminated string.
unsafe fn copied(text: *const c_char) -> Option<String> {
    // SAFETY: the caller's promise.
    (!text.is_null()).then(|| unsafe { CStr::from_ptr(text) }.to_string_lossy().into_owned())
}

/// What travels through NLopt's `void *`.
struct Bridge<'a> {
    functions: &'a mut dyn Functions,
    handle: Handle,
    halted: bool,
}

impl Bridge<'_> {
    /// Calls back unless the run is to end; a halt ends it, and so would a panic: neither crosses the C frames.
    fn call<T>(&mut self, body: impl FnOnce(&mut dyn Functions) -> Result<T, Halt>) -> Option<T> {
        if self.halted {
            return None;
        }
        if let Ok(Ok(value)) = catch_unwind(AssertUnwindSafe(|| body(self.functions))) {
            return Some(value);
        }
        self.halted = true;
        // SAFETY: the handle lives during the run this is called from.
        unsafe { nlopt_force_stop(self.handle) };
        None
    }
}

/// # Safety
/// `pointer` is null or leads to `length` writable numbers, used by nobody else while the slice lives.
unsafe fn zeroed<'a>(pointer: *mut f64, length: usize) -> Option<&'a mut [f64]> {
    if pointer.is_null() {
        return None;
    }
    // SAFETY: the caller's promise; all-zero bytes are the number 0, so the memory is initialised before the slice is made.
    unsafe {
        pointer.write_bytes(0, length);
        Some(slice::from_raw_parts_mut(pointer, length))
    }
}

extern "C" fn objective(n: c_uint, x: *const f64, gradient: *mut f64, data: *mut c_void) -> f64 {
    // SAFETY: `data` is the bridge of `minimise`, whose only use during the run is by these callbacks, one at a time;
    // NLopt passes n numbers in `x` and room for n in `gradient`, or null.
    let (bridge, x, gradient) =
        unsafe { (&mut *data.cast::<Bridge>(), slice::from_raw_parts(x, n as usize), zeroed(gradient, n as usize)) };
    bridge.call(|functions| functions.objective(x, gradient)).unwrap_or(0.0)
}

extern "C" fn inequalities(m: c_uint, values: *mut f64, n: c_uint, x: *const f64, jacobian: *mut f64, data: *mut c_void) {
    // SAFETY: as `rows` asks; NLopt keeps these promises for a vector-valued constraint.
    unsafe { rows(m, values, n, x, jacobian, data, |functions, x, values, jacobian| functions.inequalities(x, values, jacobian)) }
}

extern "C" fn equalities(m: c_uint, values: *mut f64, n: c_uint, x: *const f64, jacobian: *mut f64, data: *mut c_void) {
    // SAFETY: as above.
    unsafe { rows(m, values, n, x, jacobian, data, |functions, x, values, jacobian| functions.equalities(x, values, jacobian)) }
}

type RowsBody = fn(&mut dyn Functions, &[f64], &mut [f64], Option<&mut [f64]>) -> Result<(), Halt>;

/// # Safety
/// `data` is the bridge of `minimise`; `values` has room for m numbers, `x` has n, `jacobian` is null or has room for m·n.
unsafe fn rows(m: c_uint, values: *mut f64, n: c_uint, x: *const f64, jacobian: *mut f64, data: *mut c_void, body: RowsBody) {
    let (m, n) = (m as usize, n as usize);
    // SAFETY: the caller's promise; the bridge is used by one callback at a time.
    let (bridge, x, values, jacobian) =
        unsafe { (&mut *data.cast::<Bridge>(), slice::from_raw_parts(x, n), zeroed(values, m), zeroed(jacobian, m * n)) };
    if let Some(values) = values {
        bridge.call(|functions| body(functions, x, values, jacobian));
    }
}

/// Whether the setup has the shape for which NLopt's C code is memory-safe: the last look, whatever was promised before.
fn is_sound(setup: &Setup, n: usize) -> bool {
    // A variable without room is taken out by NLopt, and its inner optimisers keep the old dimension.
    let has_room = setup.lower.iter().zip(&setup.upper).all(|(lower, upper)| upper - lower >= f64::MIN_POSITIVE);
    let fits = setup.most_equalities.is_none_or(|most| setup.equalities <= most);
    n > 0 && setup.lower.len() == n && setup.upper.len() == n && has_room && fits
}

/// Runs NLopt from `x`, which ends at NLopt's best point. `None` where NLopt cannot even be set up.
pub(super) fn minimise(setup: &Setup, functions: &mut dyn Functions, x: &mut [f64]) -> Option<Outcome> {
    let n = x.len();
    if !is_sound(setup, n) {
        return None;
    }
    let optimizer = Optimizer::new(setup.algorithm, n)?;
    let mut bridge = Bridge { functions, handle: optimizer.0, halted: false };
    let data = (&raw mut bridge).cast::<c_void>();
    let tolerances = vec![setup.violation; setup.inequalities.max(setup.equalities)];
    optimizer.set_tolerance(setup.tolerance);
    let inner = setup.inner.and_then(|name| Optimizer::new(name, n));
    let mut value = 0.0;
    // SAFETY: the handle is live; bounds and x have n entries (checked above), tolerances at least as many as there are
    // rows (NLopt copies them, and the parameter's name); `data` outlives the run, and the callbacks have the types NLopt declares.
    let code = unsafe {
        nlopt_srand(c_ulong::from(setup.seed));
        if let Some(inner) = &inner {
            inner.set_tolerance(setup.tolerance);
            nlopt_set_local_optimizer(optimizer.0, inner.0);
        }
        nlopt_set_param(optimizer.0, c"dual_maxeval".as_ptr(), dual_steps(setup.inequalities));
        nlopt_set_maxeval(optimizer.0, c_int::try_from(setup.evaluations).unwrap_or(c_int::MAX));
        nlopt_set_maxtime(optimizer.0, setup.seconds.unwrap_or(0.0));
        let steps = [
            nlopt_set_lower_bounds(optimizer.0, setup.lower.as_ptr()),
            nlopt_set_upper_bounds(optimizer.0, setup.upper.as_ptr()),
            nlopt_set_min_objective(optimizer.0, objective, data),
            add(setup.inequalities, |m| {
                nlopt_add_inequality_mconstraint(optimizer.0, m, inequalities, data, tolerances.as_ptr())
            }),
            add(setup.equalities, |m| nlopt_add_equality_mconstraint(optimizer.0, m, equalities, data, tolerances.as_ptr())),
        ];
        match steps.into_iter().find(|&code| code < 0) {
            Some(code) => code,
            None => nlopt_optimize(optimizer.0, x.as_mut_ptr(), &raw mut value),
        }
    };
    Some(Outcome { code, message: optimizer.words(code) })
}

fn add(rows: usize, register: impl FnOnce(c_uint) -> c_int) -> c_int {
    match c_uint::try_from(rows) {
        Ok(0) => 1,
        Ok(rows) => register(rows),
        Err(_) => -3,
    }
}

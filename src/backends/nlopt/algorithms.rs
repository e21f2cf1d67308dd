//! What NLopt's algorithms accept: one table, and the refusals that follow from it.

use crate::model::Meta;

/// The rows an algorithm can take.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Rows {
    /// Bounds only.
    None,
    /// Inequalities, but no equalities.
    Inequalities,
    /// Both.
    All,
}

/// One algorithm.
#[derive(Debug, Clone, Copy)]
pub(super) struct Algorithm {
    /// Our name.
    pub name: &'static str,
    /// NLopt's.
    pub code: &'static str,
    /// The gradient algorithm it runs inside itself.
    pub inner: Option<&'static str>,
    /// The rows it accepts.
    pub rows: Rows,
    /// Every variable needs two finite bounds.
    pub finite_bounds: bool,
    /// Uses gradients.
    pub gradients: bool,
    /// Fewest variables.
    pub least_variables: usize,
    /// Most equalities for n variables at which it stays inside its memory; those beyond are left out, see `independent`.
    pub most_equalities: Option<fn(usize) -> usize>,
    /// Between two calls of the model it does a bounded amount of work, whatever the numbers; see `worker`.
    pub is_bounded: bool,
    /// It steps back from a point whose objective is +∞.
    pub steps_back: bool,
    /// The numbers it stores for n variables and m rows, beside some for each variable and row.
    pub storage: fn(f64, f64) -> f64,
    /// Operations of one evaluation for n variables and m rows, those of the step that leads to it included.
    pub work: fn(f64, f64) -> f64,
    /// Evaluations of one iteration.
    pub evaluations_per_iteration: f64,
    /// Evaluations per variable after which it is stopped, where it would not stop by itself.
    pub evaluations_per_variable: Option<u64>,
}

const LOCAL: Algorithm = Algorithm {
    name: "",
    code: "",
    inner: None,
    rows: Rows::None,
    finite_bounds: false,
    gradients: true,
    least_variables: 1,
    most_equalities: None,
    is_bounded: false,
    steps_back: false,
    storage: |n, m| n + m,
    // luksan: ten pairs of vectors, each used twice.
    work: |n, _| 40.0 * n,
    evaluations_per_iteration: 1.0,
    evaluations_per_variable: None,
};

/// MMA and its sibling (mma.c, ccsa_quadratic.c): a dual problem in every step.
const CONSERVATIVE: Algorithm =
    Algorithm { rows: Rows::Inequalities, storage: |n, m| 2.0 * n * m, work: |n, m| DUAL_STEPS * n * m, ..LOCAL };

/// All of them, in the order users see. Storage, work and limits are read off NLopt 2.9.1's sources, which the comments name;
/// `examples/nlopt_battery.rs` runs each of them on each kind of shape, under valgrind (docs/nlopt.md).
pub(super) const TABLE: [Algorithm; 11] = [
    Algorithm {
        name: "slsqp",
        code: "LD_SLSQP",
        rows: Rows::All,
        // slsqp.c, `length_work`: with d = m_eq − (n + 1) the workspace lacks (5d − 16)(n + 1) − 2 − d numbers (where there are no
        // inequalities) of what `lsq_` writes before `lsei_` refuses m_eq > n: an overflow from m_eq = n + 5. Below that every call
        // fails anyhow.
        most_equalities: Some(|n| n),
        is_bounded: true,
        // slsqp.c, line search (label L200).
        steps_back: true,
        // slsqp.c, `length_work`, with a finite bound on each side of every variable.
        storage: |n, m| n * (12.0 * n + 5.0 * m),
        // `lsei_` and `nnls_`: a QR factorisation, and a column in or out for about each variable.
        work: |n, m| n * n * (n + m),
        ..LOCAL
    },
    Algorithm { name: "mma", code: "LD_MMA", ..CONSERVATIVE },
    Algorithm { name: "ccsaq", code: "LD_CCSAQ", ..CONSERVATIVE },
    Algorithm {
        name: "auglag",
        code: "AUGLAG",
        inner: Some("LD_LBFGS"),
        rows: Rows::All,
        // auglag.c, `gradtmp`.
        storage: |n, m| n * m,
        // The dense Jacobian is made, copied and used; an iteration is a minimisation of its own.
        work: |n, m| n * (40.0 + 4.0 * m),
        evaluations_per_iteration: 200.0,
        ..LOCAL
    },
    Algorithm { name: "lbfgs", code: "LD_LBFGS", ..LOCAL },
    Algorithm { name: "tnewton", code: "LD_TNEWTON_PRECOND_RESTART", ..LOCAL },
    Algorithm { name: "var2", code: "LD_VAR2", ..LOCAL },
    Algorithm {
        name: "cobyla",
        code: "LN_COBYLA",
        rows: Rows::All,
        gradients: false,
        // cobyla.c, `w`: n·(3n + 2m + 11), where two bounds count as rows and an equality as two.
        storage: |n, m| n * (7.0 * n + 4.0 * m),
        // `trstlp`: about n changes of the active set, each a pass over rows and an n × n basis.
        work: |n, m| n * n * (3.0 * n + 2.0 * m),
        evaluations_per_variable: Some(5_000),
        ..LOCAL
    },
    Algorithm {
        name: "bobyqa",
        code: "LN_BOBYQA",
        gradients: false,
        least_variables: 2,
        // bobyqa.c, `w0` with npt = 2n + 1.
        storage: |n, _| 20.0 * n * n,
        work: |n, _| 50.0 * n * n,
        evaluations_per_variable: Some(5_000),
        ..LOCAL
    },
    Algorithm {
        name: "isres",
        code: "GN_ISRES",
        rows: Rows::All,
        finite_bounds: true,
        gradients: false,
        // isres.c: a population of 20(n + 1).
        storage: |n, _| 40.0 * n * n,
        work: |n, m| 40.0 * n + m,
        evaluations_per_variable: Some(10_000),
        ..LOCAL
    },
    Algorithm {
        name: "mlsl",
        code: "G_MLSL_LDS",
        inner: Some("LD_LBFGS"),
        finite_bounds: true,
        evaluations_per_variable: Some(2_000),
        ..LOCAL
    },
];

/// The names of [`TABLE`].
pub(super) const NAMES: [&str; TABLE.len()] = {
    let mut names = [""; TABLE.len()];
    let mut at = 0;
    while at < TABLE.len() {
        names[at] = TABLE[at].name;
        at += 1;
    }
    names
};

/// Numbers a dense algorithm may store: 400 MB.
const STORAGE: f64 = 5e7;
/// Operations one run may take, in and between the evaluations of the model: about ten seconds of one processor.
const WORK: f64 = 1e10;
/// Iterations below which a run is not worth beginning: quasi-Newton methods need about as many to learn a curvature.
const LEAST_ITERATIONS: f64 = 100.0;
/// Steps in which MMA and CCSAQ solve the dual of one subproblem, in m variables.
const DUAL_STEPS: f64 = 1e3;

/// The algorithm of this name.
pub(super) fn find(name: &str) -> Option<&'static Algorithm> {
    TABLE.iter().find(|algorithm| algorithm.name == name)
}

/// The algorithms of [`TABLE`] that can take the problem.
pub(super) fn able(meta: &Meta) -> Vec<&'static str> {
    TABLE.iter().filter(|algorithm| algorithm.obstacle(meta).is_none()).map(|algorithm| algorithm.name).collect()
}

/// Whether bounds leave nothing to vary.
pub(super) fn is_fixed(meta: &Meta) -> bool {
    meta.lower == meta.upper
}

impl Algorithm {
    /// Why this algorithm cannot take the problem.
    pub fn obstacle(&self, meta: &Meta) -> Option<String> {
        let size = Size::of(meta);
        if size.crossed > 0 {
            return Some(format!("needs bounds that do not cross, and {} variables have lower above upper", size.crossed));
        }
        match self.rows {
            Rows::None if size.rows() > 0 => return Some(format!("takes bounds only, and there are {} rows", size.rows())),
            Rows::Inequalities if size.equalities > 0 => {
                return Some(format!("takes no equalities, and there are {}", size.equalities));
            }
            _ => {}
        }
        if size.variables < self.least_variables {
            return Some(format!("needs at least {} variables that are not fixed", self.least_variables));
        }
        if self.finite_bounds && size.open > 0 {
            return Some(format!("needs finite bounds, and {} variables are open on one side", size.open));
        }
        if !self.fits(&size) {
            return Some(format!("is dense: {} variables and {} rows are more than it can hold", size.variables, size.rows()));
        }
        None
    }

    fn fits(&self, size: &Size) -> bool {
        (self.storage)(size.variables as f64, size.rows() as f64) <= STORAGE
    }

    /// Evaluations that fit into [`WORK`], at most `wanted`; 0 where the algorithm cannot take the problem or too few fit.
    pub fn affordable(&self, meta: &Meta, wanted: u64) -> u64 {
        let size = Size::of(meta);
        let fitting = WORK / (self.work)(size.variables as f64, size.rows() as f64).max(1.0);
        let least = LEAST_ITERATIONS * self.evaluations_per_iteration;
        if self.obstacle(meta).is_some() || fitting < least { 0 } else { wanted.min(fitting as u64) }
    }
}

/// The sizes NLopt sees: free variables, and one row per finite limit.
struct Size {
    variables: usize,
    open: usize,
    crossed: usize,
    inequalities: usize,
    equalities: usize,
}

impl Size {
    fn of(meta: &Meta) -> Self {
        let mut size = Size { variables: 0, open: 0, crossed: 0, inequalities: 0, equalities: 0 };
        for (&lower, &upper) in meta.lower.iter().zip(&meta.upper) {
            size.variables += usize::from(lower < upper);
            size.open += usize::from(!(lower.is_finite() && upper.is_finite()));
            size.crossed += usize::from(lower > upper);
        }
        for (&lower, &upper) in meta.row_lower.iter().zip(&meta.row_upper) {
            let equality = lower == upper;
            size.equalities += usize::from(equality);
            size.inequalities += if equality { 0 } else { usize::from(lower.is_finite()) + usize::from(upper.is_finite()) };
        }
        size
    }

    fn rows(&self) -> usize {
        self.inequalities + self.equalities
    }
}

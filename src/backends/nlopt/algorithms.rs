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
    /// The numbers it stores for n variables and m rows, where that grows faster than n + m.
    pub storage: Option<fn(f64, f64) -> f64>,
    /// Operations of one iteration for n variables and m rows, where they are more than the numbers stored.
    pub work: Option<fn(f64, f64) -> f64>,
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
    storage: None,
    work: None,
    evaluations_per_variable: None,
};

/// MMA and its sibling: a dual problem in every step.
const CONSERVATIVE: Algorithm =
    Algorithm { rows: Rows::Inequalities, storage: Some(|n, m| 2.0 * n * m), work: Some(|n, m| DUAL_STEPS * n * m), ..LOCAL };

/// All of them, in the order users see. Storage is read off NLopt 2.9.1's sources.
pub(super) const TABLE: [Algorithm; 11] = [
    Algorithm {
        name: "slsqp",
        code: "LD_SLSQP",
        rows: Rows::All,
        storage: Some(|n, m| n * (6.0 * n + 4.0 * m)),
        work: Some(|n, m| n * n * (n + m)),
        ..LOCAL
    },
    Algorithm { name: "mma", code: "LD_MMA", ..CONSERVATIVE },
    Algorithm { name: "ccsaq", code: "LD_CCSAQ", ..CONSERVATIVE },
    Algorithm { name: "auglag", code: "AUGLAG", inner: Some("LD_LBFGS"), rows: Rows::All, storage: Some(|n, m| n * m), ..LOCAL },
    Algorithm { name: "lbfgs", code: "LD_LBFGS", ..LOCAL },
    Algorithm { name: "tnewton", code: "LD_TNEWTON_PRECOND_RESTART", ..LOCAL },
    Algorithm { name: "var2", code: "LD_VAR2", ..LOCAL },
    Algorithm {
        name: "cobyla",
        code: "LN_COBYLA",
        rows: Rows::All,
        gradients: false,
        storage: Some(|n, m| n * (4.0 * n + 2.0 * m)),
        evaluations_per_variable: Some(5_000),
        ..LOCAL
    },
    Algorithm {
        name: "bobyqa",
        code: "LN_BOBYQA",
        gradients: false,
        least_variables: 2,
        storage: Some(|n, _| 8.0 * n * n),
        evaluations_per_variable: Some(5_000),
        ..LOCAL
    },
    Algorithm {
        name: "isres",
        code: "GN_ISRES",
        rows: Rows::All,
        finite_bounds: true,
        gradients: false,
        storage: Some(|n, _| 40.0 * n * n),
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
/// Operations of one iteration of an algorithm that is still quick.
const WORK: f64 = 1e8;
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
        if !self.fits(&size, STORAGE) {
            return Some(format!("is dense: {} variables and {} rows are more than it can hold", size.variables, size.rows()));
        }
        None
    }

    fn fits(&self, size: &Size, storage: f64) -> bool {
        self.storage.is_none_or(|needed| needed(size.variables as f64, size.rows() as f64) <= storage)
    }

    /// Whether the problem is so small that this algorithm is quick on it.
    pub fn is_quick(&self, meta: &Meta) -> bool {
        let size = Size::of(meta);
        let is_quick = match self.work {
            Some(work) => work(size.variables as f64, size.rows() as f64) <= WORK,
            None => self.fits(&size, STORAGE / 50.0),
        };
        self.obstacle(meta).is_none() && is_quick
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

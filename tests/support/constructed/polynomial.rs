//! Polynomials about a known point, as a model and as the text of a problem file.

use std::fmt::Write as _;

use nalgebra::DMatrix;
use ribopt::model::{EvaluationError, Meta, Model, Pattern};

/// c·(d·w)^p
#[derive(Debug, Clone)]
pub struct Power {
    pub factor: f64,
    pub direction: Vec<f64>,
    pub exponent: i32,
}

/// scale·(g·w + Σ powers) + constant, w = x/s − centre.
#[derive(Debug, Clone)]
pub struct Polynomial {
    pub scale: f64,
    pub linear: Vec<f64>,
    pub powers: Vec<Power>,
    pub constant: f64,
    /// The sum of all squares among the powers as a matrix, once [`Problem::finish`] has made it; before that, empty.
    pub squares: Vec<f64>,
}

/// Minimise a polynomial within bounds and rows of polynomials.
#[derive(Debug, Clone, Default)]
pub struct Problem {
    pub meta: Meta,
    /// s and u* = x*/s
    pub sizes: Vec<f64>,
    pub centre: Vec<f64>,
    pub objective: Vec<Polynomial>,
    pub rows: Vec<Polynomial>,
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

impl Polynomial {
    pub fn new(scale: f64, linear: Vec<f64>, powers: Vec<Power>, constant: f64) -> Polynomial {
        Polynomial { scale, linear, powers, constant, squares: Vec::new() }
    }

    /// The powers not in the matrix.
    fn others(&self) -> impl Iterator<Item = &Power> {
        self.powers.iter().filter(|power| self.squares.is_empty() || power.exponent != 2)
    }

    fn merge_squares(&mut self) {
        let n = self.linear.len();
        let mut squares = vec![0.0; n * n];
        for power in self.powers.iter().filter(|power| power.exponent == 2) {
            for (i, a) in power.direction.iter().enumerate() {
                squares[i * n..(i + 1) * n].iter_mut().zip(&power.direction).for_each(|(to, b)| *to += power.factor * a * b);
            }
        }
        self.squares = squares;
    }

    /// Half the derivative of the squares.
    fn half_slopes(&self, w: &[f64]) -> Vec<f64> {
        self.squares.chunks_exact(w.len().max(1)).map(|row| dot(row, w)).collect()
    }

    pub fn value(&self, w: &[f64]) -> f64 {
        let power = |power: &Power| power.factor * dot(&power.direction, w).powi(power.exponent);
        let squares = dot(&self.half_slopes(w), w);
        self.scale * (dot(&self.linear, w) + squares + self.others().map(power).sum::<f64>()) + self.constant
    }

    /// The derivative by w.
    pub fn gradient(&self, w: &[f64]) -> Vec<f64> {
        let mut total = self.linear.clone();
        total.iter_mut().zip(self.half_slopes(w)).for_each(|(total, half)| *total += 2.0 * half);
        for power in self.others() {
            let slope = power.factor * f64::from(power.exponent) * dot(&power.direction, w).powi(power.exponent - 1);
            total.iter_mut().zip(&power.direction).for_each(|(total, d)| *total += slope * d);
        }
        total.iter_mut().for_each(|total| *total *= self.scale);
        total
    }

    /// Adds weight times the second derivatives by w, full and row by row.
    fn add_hessian(&self, w: &[f64], weight: f64, total: &mut [f64]) {
        let n = w.len();
        total.iter_mut().zip(&self.squares).for_each(|(to, square)| *to += 2.0 * weight * self.scale * square);
        for power in self.others() {
            let p = power.exponent;
            let bend = self.scale * power.factor * f64::from(p * (p - 1)) * dot(&power.direction, w).powi(p - 2);
            for (i, a) in power.direction.iter().enumerate().filter(|(_, a)| **a != 0.0) {
                total[i * n..=i * n + i].iter_mut().zip(&power.direction).for_each(|(t, b)| *t += weight * bend * a * b);
            }
        }
    }

    fn text(&self, problem: &Problem) -> String {
        let sum = |factors: &[f64]| {
            let mut text = String::new();
            for (j, factor) in factors.iter().enumerate().filter(|(_, factor)| **factor != 0.0) {
                let _ = write!(text, " + ({factor:?})*(x{j}/{:?} - ({:?}))", problem.sizes[j], problem.centre[j]);
            }
            if text.is_empty() { "0".into() } else { text[3..].to_string() }
        };
        let mut text = sum(&self.linear);
        for power in &self.powers {
            let _ = write!(text, " + ({:?})*({})^{}", power.factor, sum(&power.direction), power.exponent);
        }
        format!("({:?})*({text})", self.scale)
    }
}

impl Problem {
    pub fn deviation(&self, x: &[f64]) -> Vec<f64> {
        x.iter().zip(&self.sizes).zip(&self.centre).map(|((x, s), c)| x / s - c).collect()
    }

    pub fn place(&self, w: &[f64]) -> Vec<f64> {
        w.iter().zip(&self.sizes).zip(&self.centre).map(|((w, s), c)| (w + c) * s).collect()
    }

    /// Merges squares and sets the patterns from what the polynomials contain.
    pub fn finish(mut self) -> Problem {
        self.objective.iter_mut().chain(&mut self.rows).for_each(Polynomial::merge_squares);
        let n = self.sizes.len();
        let used = |polynomial: &Polynomial, j: usize| {
            polynomial.linear[j] != 0.0 || polynomial.powers.iter().any(|power| power.direction[j] != 0.0)
        };
        let mut jacobian = Vec::new();
        for (i, row) in self.rows.iter().enumerate() {
            jacobian.extend((0..n).filter(|&j| used(row, j)).map(|j| (i as u32, j as u32)));
        }
        let mut hessian = Vec::new();
        for power in self.objective.iter().chain(&self.rows).flat_map(|polynomial| &polynomial.powers) {
            let own: Vec<usize> = (0..n).filter(|&j| power.direction[j] != 0.0).collect();
            hessian.extend(own.iter().flat_map(|&i| own.iter().filter(move |&&j| j <= i).map(move |&j| (i as u32, j as u32))));
        }
        self.meta.jacobian = Pattern::from_positions(self.rows.len(), &mut jacobian);
        self.meta.hessian = Pattern::from_positions(n, &mut hessian);
        self.meta.typical = self.meta.start.iter().map(|start| start.abs()).collect();
        self.meta.row_is_linear = self.rows.iter().map(|row| row.powers.is_empty()).collect();
        self
    }

    /// A problem file with this problem and the point in question.
    pub fn toml(&self, x: &[f64], remark: &str) -> String {
        let mut text = String::new();
        remark.lines().for_each(|line| text += &format!("# {line}\n"));
        let point: Vec<String> = x.iter().enumerate().map(|(j, x)| format!("x{j} = {x:?}")).collect();
        let _ = writeln!(text, "# the point: {}", point.join(", "));
        let objective: Vec<String> = self.objective.iter().map(|part| part.text(self)).collect();
        let _ = writeln!(text, "minimize = \"{}\"\n[variables]", objective.join(" + "));
        for j in 0..x.len() {
            let mut limits = String::new();
            for (key, value) in [("lower", self.meta.lower[j]), ("upper", self.meta.upper[j])] {
                if value.is_finite() {
                    let _ = write!(limits, "{key} = {value:?}, ");
                }
            }
            let _ = writeln!(text, "x{j} = {{ {limits}start = {:?} }}", self.meta.start[j]);
        }
        for (i, row) in self.rows.iter().enumerate() {
            let (lower, upper) = (self.meta.row_lower[i] - row.constant, self.meta.row_upper[i] - row.constant);
            let limit = match (lower.is_finite(), upper.is_finite()) {
                (true, true) => format!("== {lower:?}"),
                (true, false) => format!(">= {lower:?}"),
                _ => format!("<= {upper:?}"),
            };
            let _ = writeln!(text, "[[constraints]]\nname = \"r{i}\"\nrequire = \"{} {limit}\"", row.text(self));
        }
        text
    }
}

fn finite(values: &[f64]) -> Result<(), EvaluationError> {
    let overflow = || EvaluationError::Invalid { term: "a polynomial".into(), cause: "the value overflows".into() };
    if values.iter().all(|value| value.is_finite()) { Ok(()) } else { Err(overflow()) }
}

impl Model for Problem {
    fn meta(&self) -> &Meta {
        &self.meta
    }

    fn objective(&self, x: &[f64]) -> Result<f64, EvaluationError> {
        let w = self.deviation(x);
        let value = self.objective.iter().map(|part| part.value(&w)).sum();
        finite(&[value]).map(|()| value)
    }

    fn gradient(&self, x: &[f64], gradient: &mut [f64]) -> Result<f64, EvaluationError> {
        let w = self.deviation(x);
        gradient.fill(0.0);
        for part in &self.objective {
            gradient.iter_mut().zip(part.gradient(&w)).zip(&self.sizes).for_each(|((to, by_w), s)| *to += by_w / s);
        }
        finite(gradient)?;
        self.objective(x)
    }

    fn constraints(&self, x: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        let w = self.deviation(x);
        values.iter_mut().zip(&self.rows).for_each(|(value, row)| *value = row.value(&w));
        finite(values)
    }

    fn jacobian(&self, x: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        let w = self.deviation(x);
        for (i, row) in self.rows.iter().enumerate() {
            let gradient = row.gradient(&w);
            for at in self.meta.jacobian.range(i) {
                let j = self.meta.jacobian.columns[at] as usize;
                values[at] = gradient[j] / self.sizes[j];
            }
        }
        finite(values)
    }

    fn hessian(&self, x: &[f64], weight: f64, y: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        let (w, n) = (self.deviation(x), x.len());
        let mut total = vec![0.0; n * n];
        self.objective.iter().filter(|_| weight != 0.0).for_each(|part| part.add_hessian(&w, weight, &mut total));
        for (row, y) in self.rows.iter().zip(y).filter(|(_, y)| **y != 0.0) {
            row.add_hessian(&w, *y, &mut total);
        }
        for (value, (i, j)) in values.iter_mut().zip(self.meta.hessian.iter()) {
            *value = total[i * n + j] / (self.sizes[i] * self.sizes[j]);
        }
        finite(values)
    }
}

/// ½tᵀKt as squares of (t_i ± t_j).
pub fn quadratic(k: &DMatrix<f64>, coordinates: &[Vec<f64>]) -> Vec<Power> {
    let n = coordinates.len();
    let mut powers = Vec::new();
    for i in 0..n {
        let mut own = k[(i, i)];
        for j in (0..n).filter(|&j| j != i) {
            own -= k[(i, j)];
            if j < i && k[(i, j)] != 0.0 {
                let direction = coordinates[i].iter().zip(&coordinates[j]).map(|(a, b)| a + b).collect();
                powers.push(Power { factor: 0.5 * k[(i, j)], direction, exponent: 2 });
            }
        }
        if own != 0.0 {
            powers.push(Power { factor: 0.5 * own, direction: coordinates[i].clone(), exponent: 2 });
        }
    }
    powers
}

//! The error function, and Gamma's relatives for superellipses: doors to `spec_math` (Cephes), values checked against SciPy's.

use spec_math::cephes64;

/// The error function erf(x) = 2/√π·∫₀ˣ exp(−t²) dt (DLMF 7.2.1).
///
/// ```
/// assert!((ribopt::math::special::erf(0.5) - 0.520_499_877_813_046_5).abs() < 1e-15);
/// ```
pub fn erf(x: f64) -> f64 {
    cephes64::erf(x)
}

/// Its derivative, 2/√π·exp(−x²) (DLMF 7.10.1); the second one is −2·x times this.
pub fn erf_slope(x: f64) -> f64 {
    std::f64::consts::FRAC_2_SQRT_PI * (-x * x).exp()
}

/// ln Γ(x) for x > 0; NaN elsewhere (there ln |Γ| would hide a sign no section needs).
///
/// ```
/// assert!((ribopt::math::special::ln_gamma(5.0) - 24f64.ln()).abs() < 1e-15);
/// ```
pub fn ln_gamma(x: f64) -> f64 {
    if x > 0.0 { cephes64::lgam(x) } else { f64::NAN }
}

/// Digamma ψ(x) = d ln Γ/dx for x > 0; NaN elsewhere.
///
/// ```
/// let euler = 0.577_215_664_901_532_9;
/// assert!((ribopt::math::special::digamma(1.0) + euler).abs() < 1e-15);
/// ```
pub fn digamma(x: f64) -> f64 {
    if x > 0.0 { cephes64::psi(x) } else { f64::NAN }
}

/// Polygamma ψ⁽ⁿ⁾(x), the n-th derivative of the digamma function, for x > 0 (NaN elsewhere):
/// (−1)ⁿ⁺¹·n!·ζ(n+1, x) with Hurwitz's zeta (DLMF 5.15.1 and 25.11.12).
///
/// ```
/// use ribopt::math::special::polygamma;
/// assert!((polygamma(1, 1.0) - std::f64::consts::PI.powi(2) / 6.0).abs() < 1e-15);
/// ```
pub fn polygamma(n: u32, x: f64) -> f64 {
    if n == 0 {
        return digamma(x);
    }
    if !(x > 0.0 && x.is_finite()) {
        return if x == f64::INFINITY { 0.0 } else { f64::NAN };
    }
    let factorial: f64 = (1..=n).map(f64::from).product();
    let sign = if n % 2 == 1 { 1.0 } else { -1.0 };
    sign * factorial * cephes64::zeta(f64::from(n) + 1.0, x)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn as_scipy() {
        // scipy.special: x, gammaln(x), psi(x), polygamma(1, x), polygamma(2, x)
        #[rustfmt::skip]
        let table = [
            [0.05, 2.968879201051731, -20.49784499129987, 401.53235734211506, -16002.108158021943],
            [0.3, 1.0957979948180756, -3.502524222200133, 12.245364546107734, -75.27253658872601],
            [1.5, -0.12078223763524526, 0.03648997397857652, 0.9348022005446793, -0.8287966442343201],
            [3.3, 0.9870985778947343, 1.0348224890596216, 0.3535015418410618, -0.12375118526494273],
            [300.0, 1409.2020674704117, 5.702114882064637, 0.0033388950617146773, -1.1148209876314589e-05],
        ];
        let close = |ours: f64, scipy: f64| assert!((ours - scipy).abs() <= 4e-15 * scipy.abs(), "{ours} {scipy}");
        for [x, ln, psi, one, two] in table {
            close(ln_gamma(x), ln);
            close(digamma(x), psi);
            close(polygamma(1, x), one);
            close(polygamma(2, x), two);
        }
    }

    #[test]
    fn outside_the_domain_no_number() {
        for x in [0.0, -1.5, f64::NAN] {
            assert!(ln_gamma(x).is_nan() && digamma(x).is_nan() && polygamma(1, x).is_nan());
        }
    }
}

"""Reference values for src/math and src/splines from SciPy and mpmath, written once beside this script.

pip install scipy==1.17.1 mpmath; python tests/data/make_reference.py
"""
import json
import pathlib

import mpmath
import numpy as np
from scipy import interpolate

HERE = pathlib.Path(__file__).parent
mpmath.mp.dps = 80


def write(name, data):
    text = json.dumps(data, default=lambda a: np.asarray(a).tolist(), indent=1)
    (HERE / name).write_text(text + "\n")


def polynomials():
    """Roots of polynomials with double coefficients as they are, in 80 digits, sorted, [re, im]."""
    cases = [
        [1.0, -0.4, 0.06, -0.004, 0.0001],
        [1.0, -3.0000001, 3.0000002, -1.0000001],
        [1.0, -4.6, 7.935, -6.08355, 1.74900625],
        [3.0, 1e-3, -2e5, 7.0, 1e-9],
        [2.0, -3.0, 5.0, -7.0, 11.0],
        [1.0, 0.0, -2.0000000000000004, 0.0, 1.0],
    ]
    out = []
    for case in cases:
        roots = mpmath.polyroots([mpmath.mpf(c) for c in case], maxsteps=5000, extraprec=3000)
        rounded = [(float(z.real) if abs(z.real) > 1e-30 * abs(z) else 0.0,
                    float(z.imag) if abs(z.imag) > 1e-30 * abs(z) else 0.0) for z in roots]
        out.append({"coefficients": case, "roots": sorted(rounded)})
    write("polynomials.json", out)


def bases():
    """Basis functions and all their derivatives as matrices [order][point][function]."""
    cases = [
        (3, [0, 0, 0, 0, 0.3, 0.5, 0.5, 1.2, 2, 2, 2, 2]),
        (2, [0, 0, 0, 1, 1, 2.5, 4, 4, 4]),
        (4, [-1, -1, -1, -1, -1, 0.1, 0.2, 0.2, 0.2, 0.7, 1, 1, 1, 1, 1]),
        (3, [0, 1, 2, 3, 4, 5, 6, 7, 8]),
        (1, [0, 0, 0.4, 1, 1]),
    ]
    out = []
    for k, t in cases:
        t = np.array(t, float)
        n = len(t) - k - 1
        a, b = t[k], t[n]
        x = a + (b - a) * np.array([0, 0.017, 0.11, 0.29, 0.333, 0.5, 0.61, 0.775, 0.93, 1.0])
        values = []
        for order in range(k + 1):
            columns = []
            for i in range(n):
                spline = interpolate.BSpline(t, np.eye(n)[i], k)
                columns.append(spline(x, nu=order))
            values.append(np.array(columns).T)
        out.append({"degree": k, "knots": t, "x": x, "values": values})
    write("bspline_basis.json", out)


def interpolants():
    """B-spline interpolation (not-a-knot), least squares, cubic splines of every end condition, bicubic interpolation."""
    rng = np.random.default_rng(7)
    x = np.sort(np.concatenate([[0, 3], rng.uniform(0, 3, 9)]))
    y = np.sin(2 * x) + x
    at = np.linspace(0, 3, 25)
    out = {"x": x, "y": y, "at": at, "interpolation": {}, "cubic": {}}
    for k in (1, 2, 3, 4, 5):
        spline = interpolate.make_interp_spline(x, y, k=k)
        out["interpolation"][str(k)] = {"knots": spline.t, "coefficients": spline.c, "values": spline(at)}
    for name, condition in {
        "natural": "natural",
        "not-a-knot": "not-a-knot",
        "clamped": ((1, 0.7), (1, -0.4)),
    }.items():
        spline = interpolate.CubicSpline(x, y, bc_type=condition)
        out["cubic"][name] = [spline(at, order) for order in range(4)]
    few = {}
    for n in (2, 3, 4):
        few[str(n)] = {name: interpolate.CubicSpline(x[:n], y[:n], bc_type=condition)(np.linspace(x[0], x[n - 1], 7))
                       for name, condition in {"natural": "natural", "not-a-knot": "not-a-knot",
                                               "clamped": ((1, 0.7), (1, -0.4))}.items()}
    out["few"] = few
    many = np.linspace(0, 3, 60)
    noisy = np.sin(2 * many) + many + 0.1 * rng.standard_normal(60)
    t = np.array([0, 0, 0, 0, 0.6, 1.1, 1.9, 2.2, 3, 3, 3, 3], float)
    fit = interpolate.make_lsq_spline(many, noisy, t, k=3)
    out["fit"] = {"x": many, "y": noisy, "knots": t, "coefficients": fit.c}
    gx, gy = np.array([0, 0.5, 1.1, 2, 2.4, 3.5]), np.array([-1, 0, 0.4, 1.5, 2.5])
    z = np.sin(gx)[:, None] * np.cos(gy)[None, :] + 0.1 * gx[:, None] * gy[None, :]
    bicubic = interpolate.RectBivariateSpline(gx, gy, z, kx=3, ky=3, s=0)
    px, py = rng.uniform(0, 3.5, 20), rng.uniform(-1, 2.5, 20)
    out["bicubic"] = {"x": gx, "y": gy, "z": z, "px": px, "py": py, "value": bicubic.ev(px, py),
                      "dx": bicubic.ev(px, py, dx=1), "dy": bicubic.ev(px, py, dy=1)}
    write("interpolation.json", out)


if __name__ == "__main__":
    polynomials()
    bases()
    interpolants()

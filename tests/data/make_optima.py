"""Optima of the problems with further kinds of section and profiles, independent of ribopt: own formulas, Ipopt (CasADi), closed forms.

pip install casadi numpy scipy; python tests/data/make_optima.py. It also writes the tables of problems/bspline-haunch.
"""
import csv
import math
import sys

import casadi as ca
import numpy as np
from scipy.interpolate import BSpline
from scipy.special import gamma

OPTIONS = {"ipopt.tol": 1e-13, "ipopt.acceptable_tol": 1e-13, "ipopt.constr_viol_tol": 1e-13, "ipopt.print_level": 0,
           "print_time": 0, "ipopt.bound_relax_factor": 0.0, "ipopt.sb": "yes"}


def solve(name, x, objective, rows, lower, upper, start):
    """Minimises subject to rows <= 0; prints objective, point and rows."""
    scale = abs(float(ca.Function("f", [x], [objective])(start))) or 1.0
    problem = {"x": x, "f": objective / scale, "g": ca.vertcat(*rows)}
    solver = ca.nlpsol("s", "ipopt", problem, OPTIONS)
    found = solver(x0=start, lbx=lower, ubx=upper, lbg=-math.inf, ubg=0)
    print(name, solver.stats()["return_status"], repr(float(found["f"]) * scale))
    print("  x", found["x"].full().ravel().tolist())
    print("  rows", np.round(found["g"].full().ravel(), 9).tolist())


def bspline_haunch(folder):
    stations, length, width, point, load, young, sigma, sag = 13, 6.0, 0.2, 20.0, 8.0, 30e6, 10e3, 0.017
    s = np.linspace(0, 1, stations)
    arm = length * (1 - s)
    moment = point * arm + load * arm**2 / 2
    simpson = np.array([1] + [4, 2] * ((stations - 3) // 2) + [4, 1]) * (length / (stations - 1)) / 3
    knots = np.array([0, 0, 0, 0, 0.5, 1, 1, 1, 1])
    basis = BSpline.design_matrix(s, knots, 3).toarray()
    x = ca.SX.sym("x", 5)
    depth = ca.DM(basis) @ x
    inertia = width * depth**3 / 12
    area = width * depth
    step = length / (stations - 1)
    volume = sum(step / 3 * (area[i] + area[i + 1] + ca.sqrt(area[i] * area[i + 1])) for i in range(stations - 1))
    rows = [moment[i] / (width * depth[i] ** 2 / 6) / sigma - 1 for i in range(stations)]
    rows.append(sum(simpson[i] * moment[i] * arm[i] / (young * inertia[i]) for i in range(stations)) / sag - 1)
    rows.append((depth[0] - 4.5 * width) / width)
    solve("bspline-haunch", x, volume, rows, [0.1] * 5, [1.5] * 5, [0.8] * 5)
    with open(f"{folder}/sections.csv", "w", newline="") as file:
        out = csv.writer(file, lineterminator="\n")
        out.writerow(["name", "kind", "b", "h", "s", "weight"])
        for i in range(stations):
            out.writerow([f"x{i}", "rectangle", "width", "profile(depth, s)", repr(float(i / (stations - 1))), repr(float(simpson[i]))])
    with open(f"{folder}/ribs.csv", "w", newline="") as file:
        out = csv.writer(file, lineterminator="\n")
        out.writerow(["name", "from", "to", "length"])
        for i in range(stations - 1):
            out.writerow([f"r{i + 1}", f"x{i}", f"x{i + 1}", repr(step)])


def superellipse_rib():
    r, length, load, young, sigma, tau, sag = 2.5, 4.0, 30.0, 210e6, 100e3, 4e3, 0.03
    area = 4 * gamma(1 + 1 / r) ** 2 / gamma(1 + 2 / r)
    inertia = 4 / 3 * gamma(1 + 1 / r) * gamma(1 + 3 / r) / gamma(1 + 4 / r)
    x = ca.SX.sym("x", 4)  # root a, b; tip a, b
    s1, s2 = area * x[0] * x[1], area * x[2] * x[3]
    volume = length / 3 * (s1 + s2 + ca.sqrt(s1 * s2))
    i1, i2 = inertia * x[0] * x[1] ** 3, inertia * x[2] * x[3] ** 3
    deflection = load * length**3 / young * (1 / (4 * i1) + 1 / (12 * i2))
    rows = [load * length / (inertia * x[0] * x[1] ** 2) / sigma - 1, deflection / sag - 1, load / s2 / tau - 1,
            x[1] / (3 * x[0]) - 1, x[3] / (3 * x[2]) - 1]
    solve("superellipse-rib", x, volume, rows, [0.005] * 4, [0.5] * 4, [0.08] * 4)


def tubular_column():
    length, load, young, ratio = 6.0, 500.0, 210e6, 50.0
    t = (64 * load * length**2 / (math.pi**3 * young * (ratio**4 - (ratio - 2) ** 4))) ** 0.25
    d = ratio * t
    print("tubular-column (closed form)", repr(length * math.pi * t * (d - t)), "d", d, "t", t)
    x = ca.SX.sym("x", 2)
    inertia = math.pi / 64 * (x[0] ** 4 - (x[0] - 2 * x[1]) ** 4)
    area = math.pi / 4 * (x[0] ** 2 - (x[0] - 2 * x[1]) ** 2)
    rows = [load / (math.pi**2 * young * inertia / length**2) - 1, x[0] / (ratio * x[1]) - 1, load / area / 355e3 - 1]
    solve("tubular-column", x, length * area, rows, [0.05, 0.002], [0.5, 0.02], [0.25, 0.01])


def lipped_channel():
    length, moment, shear, sigma, tau, lateral = 5000.0, 14e6, 40e3, 235.0, 135.0, 1.6e6
    points = [[70, 22], [70, 0], [0, 0], [0, 200], [70, 200], [70, 178]]
    x = ca.SX.sym("x", 3)  # lip, flange, web
    lip, flange, web = x[0], x[1], x[2]

    # Rectangles: x from, x to, y from, y to; corners belong to the flanges (upper half by symmetry).
    def rectangles():
        for sign in (1, -1):
            yield (-web / 2, 70 + lip / 2, 100 - flange / 2, 100 + flange / 2, sign)
            yield (70 - lip / 2, 70 + lip / 2, 78, 100 - flange / 2, sign)
        yield (-web / 2, web / 2, -(100 - flange / 2), 100 - flange / 2, 1)

    area = first = 0
    for x0, x1, y0, y1, _ in rectangles():
        area += (x1 - x0) * (y1 - y0)
        first += (x1 - x0) * (y1 - y0) * (x0 + x1) / 2
    centroid = first / area
    ix = iy = 0
    for x0, x1, y0, y1, _ in rectangles():
        w, h = x1 - x0, y1 - y0
        ix += w * h**3 / 12 + w * h * ((y0 + y1) / 2) ** 2
        iy += h * w**3 / 12 + w * h * ((x0 + x1) / 2 - centroid) ** 2
    wx = ix / (100 + flange / 2)
    wy_right = iy / (70 + lip / 2 - centroid)
    rows = [moment / wx / sigma - 1, lateral / wy_right / sigma - 1, shear / (200 * web) / tau - 1, 70 / (60 * flange) - 1,
            22 / (12 * lip) - 1]
    assert len(points) == 6
    solve("lipped-channel", x, length * area, rows, [1] * 3, [12] * 3, [4] * 3)


def tee_girder():
    length, moment, shear, sigma, tau = 6000.0, 60e6, 200e3, 235.0, 135.0
    x = ca.SX.sym("x", 4)  # tw, hw, b, tf
    tw, hw, b, tf = x[0], x[1], x[2], x[3]
    area = tw * hw + b * tf
    bottom = (tw * hw * hw / 2 + b * tf * (hw + tf / 2)) / area
    ix = tw * hw**3 / 12 + tw * hw * (bottom - hw / 2) ** 2 + b * tf**3 / 12 + b * tf * (hw + tf / 2 - bottom) ** 2
    rows = [moment / (ix / (hw + tf - bottom)) / sigma - 1, moment / (ix / bottom) / sigma - 1, hw / (30 * tw) - 1,
            b / (28 * tf) - 1, 1.5e7 / ((hw * tw**3 + tf * b**3) / 12) - 1, shear / (tw * hw) / tau - 1, (hw + tf) / 400 - 1]
    solve("tee-girder", x, length * area, rows, [3, 50, 40, 3], [30, 500, 400, 40], [12, 300, 200, 15])


if __name__ == "__main__":
    bspline_haunch(sys.argv[1] if len(sys.argv) > 1 else "problems/bspline-haunch")
    superellipse_rib()
    tubular_column()
    lipped_channel()
    tee_girder()

"""The optimum of problems/bspline-haunch.toml, independent of ribopt: formulas of its own, SciPy's B-splines, Ipopt (CasADi).

pip install casadi numpy scipy; python tests/data/make_haunch.py. It also writes the problem's tables.
"""
import csv
import math
import sys

import casadi as ca
import numpy as np
from scipy.interpolate import BSpline

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


if __name__ == "__main__":
    bspline_haunch(sys.argv[1] if len(sys.argv) > 1 else "problems/bspline-haunch")

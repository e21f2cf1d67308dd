#!/usr/bin/env python3
"""One large family solved by Ipopt through CasADi's wheel (MUMPS, exact sparse Hessian); prints one JSON line.

usage: large_ipopt.py P0|P1|P2|P3|lattice|grillage SIZE GENERATORS [--limit SECONDS] [--tolerance T]       (pip install casadi numpy scipy)

SIZE is the number of ribs, of P3 the nodes along an edge, of structures the cells along one. GENERATORS holds ribs.py and grid.py, whose
data are used. P3 is stated in the logarithms of its variables, as ribopt solves it; the others in the variables themselves, structures
with their displacements beside their sizes.
"""
import argparse
import json
import sys
import time

import casadi as ca
import numpy as np

from structure_families import FAMILIES


def frusta(length, first, second):
    return ca.sum1(ca.DM(length) / 3 * (first + second + ca.sqrt(first * second)))


def sections(model):
    """P0, P1: every rib has sections of its own. Variables field by field, as in ribs.py."""
    x = ca.SX.sym("x", model.n)
    volume, rows = ca.SX(0), []
    if model.nr:
        b1, h1, b2, h2 = (x[field] for field in model.R)
        volume += frusta(model.lr, b1 * h1, b2 * h2)
    if model.nh:
        p, q, r, t, P, Q, S, T = (x[field] for field in model.H)
        volume += frusta(model.lh, p * q, P * Q) + frusta(model.lh, r * (t - q), S * (T - Q))
    if model.rs:
        b, h = (ca.vertcat(*[x[part[k]] for part in model.rs["parts"]]) for k in range(2))
        rows += [1 - b * h**3 / ca.DM(12 * model.rs["I"]), h - 8 * b]
    if model.hs and model.nh:
        p, q, r, t = (ca.vertcat(*[x[part[k]] for part in model.hs["parts"]]) for k in range(4))
        rows += [1 - (p * q + r * (t - q)) / ca.DM(model.hs["A"]),
                 1 - (r * t**3 - (r - p) * q**3) / ca.DM(12 * model.hs["I"]), 0.01 - (t - q)]
    return x, volume, rows


def lines(model):
    """P2: lines of ten ribs, one row over each."""
    x = ca.SX.sym("x", model.n)
    nodes = model.n // 2
    b, h = x[:nodes], x[nodes:]
    inertia = b * h**3 / 12
    i, j = model.R[0].tolist(), model.R[2].tolist()
    sag = ca.DM(model.coef.ravel() / np.repeat(model.dmax, 10)) / (0.5 * (inertia[i] + inertia[j]))
    rows = [1 - inertia / ca.DM(model.rs["I"]), h - 8 * b, ca.sum1(ca.reshape(sag, 10, -1)).T - 1]
    return x, frusta(model.lr, (b * h)[i], (b * h)[j]), rows


def grid(model):
    """P3 in logarithms."""
    y = ca.SX.sym("y", 2 * model.nodes)
    b, h = y[: model.nodes], y[model.nodes :]
    area, inertia = b + h, b + 3 * h - np.log(12)
    i, j = model.i.tolist(), model.j.tolist()
    volume = ca.sum1(ca.DM(model.length) / 3 * (ca.exp(area[i]) + ca.exp(area[j]) + ca.exp((area[i] + area[j]) / 2)))
    sag = ca.DM(model.coef / model.d_max[model.line] / 2) * (ca.exp(-inertia[i]) + ca.exp(-inertia[j]))
    rows = [np.log(model.I_req) - inertia, h - b - np.log(8.0), ca.sum1(ca.reshape(sag, model.k - 1, -1)).T - 1]
    return y, volume, rows


def problem(family, size):
    """Variables, objective, rows and their limits, start and bounds."""
    if family in FAMILIES:
        return FAMILIES[family](size).statement()
    x, objective, rows, start, lower, upper = stated(family, size)
    g = ca.vertcat(*rows) if rows else ca.SX(0, 1)
    return x, objective, g, -np.inf, 0, start, lower, upper


def stated(family, size):
    """Variables, objective, rows ≤ 0, start and bounds of a rib network."""
    if family == "P3":
        from grid import Grid, LOWER, UPPER
        model = Grid(size)
        return grid(model) + (np.log(model.start.ravel()), np.log(LOWER), np.log(UPPER))
    from ribs import Ribs
    model = Ribs(family, size)
    own = lines(model) if family == "P2" else sections(model)
    return own + (model.x0, model.lb, model.ub)


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("family", choices=["P0", "P1", "P2", "P3", *FAMILIES])
    arguments.add_argument("size", type=int)
    arguments.add_argument("generators")
    arguments.add_argument("--limit", type=float, default=300)
    arguments.add_argument("--tolerance", type=float, default=1e-6)
    given = arguments.parse_args()
    sys.path.insert(0, given.generators)
    begun = time.time()
    x, objective, rows, row_lower, row_upper, start, lower, upper = problem(given.family, given.size)
    options = {"print_time": False, "ipopt": {"tol": given.tolerance, "print_level": 0, "sb": "yes",
                                              "max_wall_time": given.limit, "max_iter": 5000}}
    solver = ca.nlpsol("solver", "ipopt", {"x": x, "f": objective, "g": rows}, options)
    built, used = time.time(), time.process_time()
    found = solver(x0=start, lbx=lower, ubx=upper, lbg=row_lower, ubg=row_upper)
    seconds, processor, statistics = time.time() - built, time.process_time() - used, solver.stats()
    values = np.array(found["g"]).ravel()
    violation = float(np.max(np.concatenate([values - row_upper, row_lower - values]), initial=0.0))
    print(json.dumps({"build": built - begun, "seconds": seconds, "processor": processor, "iterations": statistics["iter_count"],
                      "status": statistics["return_status"], "objective": float(found["f"]), "violation": violation}))


if __name__ == "__main__":
    main()

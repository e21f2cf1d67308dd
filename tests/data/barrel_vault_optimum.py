"""The optimum of problems/barrel-vault by Ipopt through CasADi, written from the tables alone.

    pip install casadi && python3 tests/data/barrel_vault_optimum.py problems/barrel-vault
"""

import csv
import pathlib
import sys
import tomllib
from collections import defaultdict

import casadi as ca

folder = pathlib.Path(sys.argv[1])
p = tomllib.loads((folder / "problem.toml").read_text())["parameters"]
sections = list(csv.DictReader((folder / "sections.csv").open()))
ribs = list(csv.DictReader((folder / "ribs.csv").open()))

variables, lower, upper, start = [], [], [], []
b, h = {}, {}
for section in sections:
    for dimension, store in (("b", b), ("h", h)):
        symbol = ca.SX.sym(f"{section['name']}.{dimension}")
        store[section["name"]] = symbol
        variables.append(symbol)
        lower.append(float(section[f"{dimension}.lower"]))
        upper.append(float(section[f"{dimension}.upper"]))
        start.append(float(section[f"{dimension}.start"]))

volume, rows = 0, []
sag, spans = defaultdict(lambda: 0), {}
for rib in ribs:
    i, j, length = rib["from"], rib["to"], float(rib["length"])
    assert rib["volume"] == "prismatoid"
    volume += length / 6 * (2 * b[i] * h[i] + 2 * b[j] * h[j] + b[i] * h[j] + b[j] * h[i])
    inverse = 12 / (b[i] * h[i] ** 3) + 12 / (b[j] * h[j] ** 3)
    sag[rib["line"]] += p["load"] * float(rib["sag"]) / p["E"] * 0.5 * inverse / (float(rib["span"]) / p["sag_ratio"])
    rows += [h[j] - h[i] - p["taper_slope"] * length, h[i] - h[j] - p["taper_slope"] * length]
rows += [used - 1 for used in sag.values()]
for name in b:
    rows += [h[name] - p["slenderness"] * b[name], p["thickness"] - b[name]]

problem = {"x": ca.vertcat(*variables), "f": volume, "g": ca.vertcat(*rows)}
options = {"ipopt.tol": 1e-12, "ipopt.bound_relax_factor": 0, "ipopt.print_level": 3, "print_time": False}
solver = ca.nlpsol("solver", "ipopt", problem, options)
answer = solver(x0=start, lbx=lower, ubx=upper, lbg=-ca.inf, ubg=0)
print(solver.stats()["return_status"], "objective", repr(float(answer["f"])))

#!/usr/bin/env python3
"""ribopt beside SciPy, Ipopt and NLopt's own package, on the algebraic problems of a benchmarks JSON file.

usage: outside.py BENCHMARKS.json RIBOPT [--out FILE.md] [--only ID ...]      (pip install scipy casadi nlopt)

Every solver begins at the problem's start, with exact derivatives (CasADi's) and its default settings (SETTINGS below).
One rule judges all, from the statement of the JSON file and the returned point alone: an optimum is found where the objective
is within 1e-6*max(1, |f*|) of the verified one and every row and bound holds to 1e-8 of its scale.
"""
import argparse
import datetime
import importlib.metadata
import math
import os
import platform
import subprocess
import sys
import tempfile
import time
import warnings
from collections import Counter
from dataclasses import dataclass

import casadi as ca
import nlopt
import numpy
from scipy import optimize

import collection
from statement import INFINITY, from_json

FEASIBLE, LOOSELY_FEASIBLE, SECONDS = 1e-8, 1e-6, 30.0

SETTINGS = """\
- ribopt: the problem file, no options; success is exit code 0. The two lines below it use one backend each.
- Ipopt: CasADi's `nlpsol` defaults (tol 1e-8, exact Hessian); success is `stats()["success"]`. By default it
  relaxes bounds by 1e-8*max(1, |bound|), more than the rule allows where variables are small; a second line has `bound_relax_factor` 0.
- SciPy SLSQP and trust-constr: defaults (ftol 1e-6, 100 iterations; gtol and xtol 1e-8, BFGS, 1000 iterations); success is `result.success`.
- NLopt: it has no default tolerances; xtol_rel 1e-8, constraint tolerance 1e-8, 10 000 evaluations; starts outside the bounds are
  moved to them, for it refuses them; success is a positive status other than an evaluation or time limit. MMA takes no equalities.
- Everything: at most 30 s (ribopt: 120 s) for a problem."""


@dataclass
class Answer:
    """What a solver brought: its point, whether it calls that a success, its own words."""
    x: list | None
    success: bool
    words: str
    seconds: float = 0.0


def ipopt_with(**own):
    quiet = {"print_time": False, "ipopt.print_level": 0, "ipopt.sb": "yes", "ipopt.max_wall_time": SECONDS, "show_eval_warnings": False}
    options = quiet | {f"ipopt.{key}": value for key, value in own.items()}

    def solve(statement):
        solver = ca.nlpsol("solver", "ipopt", statement.nlp, options)
        answer = solver(x0=statement.start, lbx=statement.lower, ubx=statement.upper, lbg=statement.row_lower, ubg=statement.row_upper)
        return Answer(list(answer["x"].full().ravel()), solver.stats()["success"], solver.stats()["return_status"])
    return solve


def numeric(statement):
    """f, its gradient, g, its Jacobian over NumPy arrays."""
    return (lambda x: float(statement.f(x)), lambda x: statement.gradient(x).full().ravel(),
            lambda x: statement.g(x).full().ravel(), lambda x: statement.jacobian(x).full())


def one_sided(statement):
    """(row, sign, limit, is equality) with sign*(g - limit) >= 0."""
    for i, (low, high) in enumerate(zip(statement.row_lower, statement.row_upper)):
        if low == high:
            yield i, 1.0, low, True
            continue
        if math.isfinite(low):
            yield i, 1.0, low, False
        if math.isfinite(high):
            yield i, -1.0, high, False


def slsqp(statement):
    f, gradient, g, jacobian = numeric(statement)
    rows = [{"type": "eq" if equal else "ineq", "fun": lambda x, i=i, s=s, limit=limit: s * (g(x)[i] - limit),
             "jac": lambda x, i=i, s=s: s * jacobian(x)[i]} for i, s, limit, equal in one_sided(statement)]
    bounds = list(zip(statement.lower, statement.upper))
    result = optimize.minimize(f, statement.start, jac=gradient, bounds=bounds, constraints=rows, method="SLSQP")
    return Answer(list(result.x), bool(result.success), result.message)


def trust_constr(statement):
    f, gradient, g, jacobian = numeric(statement)
    rows = []
    if statement.rows:
        rows = [optimize.NonlinearConstraint(g, statement.row_lower, statement.row_upper, jac=jacobian)]
    begin = time.time()

    def in_time(_x, _state):
        if time.time() - begin > SECONDS:
            raise StopIteration
    bounds = optimize.Bounds(statement.lower, statement.upper)
    result = optimize.minimize(f, statement.start, jac=gradient, bounds=bounds, constraints=rows, method="trust-constr", callback=in_time)
    return Answer(list(result.x), bool(result.success), result.message)


def nlopt_with(name):
    def solve(statement):
        f, gradient, g, jacobian = numeric(statement)
        solver = nlopt.opt(getattr(nlopt, name), len(statement.start))
        solver.set_lower_bounds(statement.lower)
        solver.set_upper_bounds(statement.upper)

        def value(function, slope):
            def both(x, out):
                if out.size:
                    out[:] = slope(x)
                return float(function(x))
            return both
        solver.set_min_objective(value(f, gradient))
        for i, s, limit, equal in one_sided(statement):
            add = solver.add_equality_constraint if equal else solver.add_inequality_constraint
            add(value(lambda x, i=i, s=s, limit=limit: -s * (g(x)[i] - limit), lambda x, i=i, s=s: -s * jacobian(x)[i]), FEASIBLE)
        solver.set_xtol_rel(1e-8)
        solver.set_maxeval(10_000)
        solver.set_maxtime(SECONDS)
        start = numpy.clip(statement.start, statement.lower, statement.upper)
        try:
            x = list(solver.optimize(start))
            status = solver.last_optimize_result()
        except nlopt.RoundoffLimited:
            return Answer(None, False, "ROUNDOFF_LIMITED")
        return Answer(x, status > 0 and status not in (nlopt.MAXEVAL_REACHED, nlopt.MAXTIME_REACHED), f"status {status}")
    return solve


def ribopt_with(binary, folder, *options):
    def solve(statement):
        code, result, _ = collection.solve(binary, os.path.join(folder, statement.name + ".toml"), *options)
        values = list((result.get("variables") or {}).values())
        return Answer(values or None, code == 0, f"exit code {code}, {result.get('status')}")
    return solve


def solvers(binary, folder):
    return {"ribopt": ribopt_with(binary, folder), "ribopt, nlopt alone": ribopt_with(binary, folder, "--backend", "nlopt"),
            "ribopt, argmin alone": ribopt_with(binary, folder, "--backend", "argmin"), "Ipopt": ipopt_with(),
            "Ipopt, bounds not relaxed": ipopt_with(bound_relax_factor=0.0), "SciPy SLSQP": slsqp,
            "SciPy trust-constr": trust_constr, "NLopt SLSQP": nlopt_with("LD_SLSQP"), "NLopt MMA": nlopt_with("LD_MMA"),
            "NLopt COBYLA": nlopt_with("LN_COBYLA")}


def attempt(solve, statement):
    begin = time.time()
    try:
        answer = solve(statement)
    except Exception as error:  # a solver that throws has no answer; its words are kept
        answer = Answer(None, False, f"{type(error).__name__}: {error}".splitlines()[0])
    answer.seconds = time.time() - begin
    return answer


def judge(problem, statement, answer, feasible_to=FEASIBLE):
    """One word: found, local, missed, false success; refrained where there is no optimum and none is claimed."""
    verified = problem.get("verified") or {}
    if verified.get("f") is None:
        return "false success" if answer.success else "refrained"
    feasible, objective = False, None
    if answer.x is not None and all(math.isfinite(value) for value in answer.x):
        feasible, objective = statement.violation(answer.x) <= feasible_to, statement.sign * float(statement.f(answer.x))
    minima = [d["f"] for d in (verified.get("multistart") or {}).get("distinct", [])]
    if feasible and collection.near(objective, float(verified["f"])):
        return "found"
    if feasible and any(collection.near(objective, f) for f in minima):
        return "local"
    return "false success" if answer.success else "missed"


def table(records, names):
    lines = ["| solver | optimum found | the same, rows held to 1e-6 | another known minimum | missed | success claimed at a wrong or infeasible point | no optimum, none claimed | seconds in all |",
             "|---|---|---|---|---|---|---|---|"]
    for name in names:
        own = [record for record in records if record[1] == name]
        counts = Counter(record[4] for record in own)
        optima, none = (sum(record[2] is wanted for record in own) for wanted in (True, False))
        lines.append(f"| {name} | {counts['found']} of {optima} ({100 * counts['found'] / max(1, optima):.0f} %) | "
                     f"{sum(record[5] == 'found' for record in own)} | {counts['local']} | {counts['missed']} | "
                     f"{counts['false success']} | {counts['refrained']} of {none} | {sum(record[3].seconds for record in own):.0f} |")
    return lines


def failures(records, names):
    lines = []
    for name in names:
        own = [record for record in records if record[1] == name and record[4] not in ("found", "refrained")]
        lines += ["", f"**{name}**: " + ("none" if not own else "; ".join(f"{problem} {word} ({answer.words[:60]})" for problem, _, _, answer, word, _ in own))]
    return lines


def report(records, names, command, binary):
    versions = ", ".join(f"{package} {importlib.metadata.version(package)}" for package in ("scipy", "casadi", "nlopt", "numpy"))
    version = subprocess.run([binary, "--version"], capture_output=True, text=True).stdout.strip()
    head = ["# ribopt beside other solvers", "", f"Written by `{command}` on {datetime.date.today()}: {version}, {versions}, Python {platform.python_version()}.", "",
            f"{len({record[0] for record in records})} algebraic problems. {' '.join(__doc__.split('One rule', 1)[1].split()).join(['One rule ', ''])}", "", SETTINGS, ""]
    return "\n".join(head + table(records, names) + ["", "What was not found:"] + failures(records, names)) + "\n"


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("source")
    arguments.add_argument("ribopt")
    arguments.add_argument("--out", default=os.path.join(os.path.dirname(__file__), "results", "outside.md"))
    arguments.add_argument("--only", nargs="*", default=[])
    arguments = arguments.parse_args()
    warnings.simplefilter("ignore")
    binary, records = os.path.abspath(arguments.ribopt), []
    with tempfile.TemporaryDirectory() as folder:
        converter = os.path.join(os.path.dirname(arguments.source), "to_toml.py")
        subprocess.run([sys.executable, converter, arguments.source, folder], check=True, stdout=subprocess.DEVNULL)
        contestants = solvers(binary, folder)
        for problem in collection.algebraic(arguments.source):
            if arguments.only and problem["id"] not in arguments.only:
                continue
            statement = from_json(problem)
            has_optimum = (problem.get("verified") or {}).get("f") is not None
            for name, solve in contestants.items():
                answer = attempt(solve, statement)
                word = judge(problem, statement, answer)
                loosely = judge(problem, statement, answer, LOOSELY_FEASIBLE)
                records.append((problem["id"], name, has_optimum, answer, word, loosely))
            print(problem["id"], {record[1]: record[4] for record in records[-len(contestants):] if record[4] not in ("found", "refrained")}, flush=True)
    text = report(records, list(contestants), "python3 " + " ".join([os.path.relpath(sys.argv[0]), *sys.argv[1:]]), binary)
    os.makedirs(os.path.dirname(arguments.out) or ".", exist_ok=True)
    with open(arguments.out, "w") as out:
        out.write(text)
    print(text)


if __name__ == "__main__":
    main()

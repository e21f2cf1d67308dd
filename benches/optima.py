#!/usr/bin/env python3
"""The optima that problem files promise (`# optimum:`), computed again by Ipopt (CasADi) from many starts.

usage: optima.py [--starts N] FILE ...      exit code 1 where a file promises something else than the best point found
"""
import argparse
import math
import random
import re
import sys

import casadi as ca

from statement import from_toml

OPTIONS = {"print_time": False, "ipopt.print_level": 0, "ipopt.sb": "yes", "ipopt.tol": 1e-12, "ipopt.acceptable_tol": 1e-12,
           "ipopt.constr_viol_tol": 1e-11, "ipopt.bound_relax_factor": 0.0, "ipopt.max_iter": 2000, "ipopt.max_wall_time": 5.0}


def random_start(statement, generator):
    point = []
    for low, high, start in zip(statement.lower, statement.upper, statement.start):
        low = low if math.isfinite(low) else min(start, high) - 5 * max(1.0, abs(start))
        high = high if math.isfinite(high) else max(start, low) + 5 * max(1.0, abs(start))
        if low > 0 and high / low > 100:
            point.append(math.exp(generator.uniform(math.log(low), math.log(high))))
        else:
            point.append(generator.uniform(low, high))
    return point


def minima(statement, starts):
    """Objectives of the feasible points that Ipopt calls solved, the one from the file's own start first."""
    solver, generator, found = ca.nlpsol("s", "ipopt", statement.nlp, OPTIONS), random.Random(1), []
    for k in range(starts):
        start = statement.start if k == 0 else random_start(statement, generator)
        answer = solver(x0=start, lbx=statement.lower, ubx=statement.upper, lbg=statement.row_lower, ubg=statement.row_upper)
        x = [float(v) for v in answer["x"].full().ravel()]
        solved = solver.stats()["success"] and statement.violation(x) <= 1e-8
        found.append((statement.sign * float(answer["f"]) if solved else None, solver.stats()["return_status"]))
    return found


def main():
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--starts", type=int, default=30)
    arguments.add_argument("files", nargs="+")
    arguments = arguments.parse_args()
    wrong = 0
    for path in arguments.files:
        text, statement = open(path).read(), from_toml(path)
        found = minima(statement, arguments.starts)
        values = sorted((statement.sign * f for f, _ in found if f is not None))
        best = statement.sign * values[0] if values else None
        promised = re.search(r"^# optimum: (\S+)", text, re.MULTILINE)
        promised = None if promised is None or promised[1] == "?" else float(promised[1])
        same = best is not None and promised is not None and abs(best - promised) <= 1e-7 * max(1.0, abs(promised))
        wrong += promised is not None and not same
        distinct = list({f"{v:.6g}": statement.sign * v for v in reversed(values)}.values())[::-1]
        print(f"{path:45} promised {promised!r:22} best {best!r:22} {'' if same else 'DIFFERS' if promised is not None else ''} "
              f"from start {found[0][0]!r} ({found[0][1]}); {len(values)}/{len(found)} solved, values {distinct[:6]}", flush=True)
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()

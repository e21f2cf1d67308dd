#!/usr/bin/env python3
"""Coupled families with known optima, as problem files with CSV tables.

usage: families.py svanberg|stress-only|capped N FOLDER      writes FOLDER/problem.toml and its tables, prints the optimum
       families.py --check RIBOPT N [FOLDER]                 writes and solves all three, compares with the optima

svanberg     Svanberg's cantilever with N segments: one row over all variables. Closed form.
stress-only  Vanderplaats's cantilever with N segments, stress and aspect limits alone. Closed form.
capped       N square ribs, the most compliant ones to be made stiff, under one volume limit over all of them. Closed form.
"""
import argparse
import csv
import json
import math
import os
import subprocess
import sys

LOAD, LENGTH, STRENGTH = 50000.0, 500.0, 14000.0
AGREEMENT = 1e-8


def write(folder, toml, **tables):
    os.makedirs(folder, exist_ok=True)
    for name, (header, rows) in tables.items():
        with open(os.path.join(folder, name + ".csv"), "w", newline="", encoding="utf-8") as out:
            writer = csv.writer(out)
            writer.writerow(header)
            writer.writerows(rows)
    names = "".join(f'{name} = "{name}.csv"\n' for name in tables)
    with open(os.path.join(folder, "problem.toml"), "w", encoding="utf-8") as out:
        out.write(f"{toml}\n[tables]\n{names}")


def svanberg(n, folder):
    """x_i = c_i^(1/4)·(Σc^(1/4))^(1/3) with c = 3k² − 3k + 1, k = N + 1 − i (Svanberg 1987, any N)."""
    coefficients = [3 * k * k - 3 * k + 1 for k in range(n, 0, -1)]
    rows = [(f"s{i}", "rectangle", 0.01, float(n), 1, c) for i, c in enumerate(coefficients)]
    write(folder, f'''title = "Svanberg's cantilever with {n} segments"
minimize = "0.0624*sum(sections: b)"

[[constraints]]
name = "tip deflection"
require = "sum(sections: c/b^3) <= 1"
''', sections=(["name", "kind", "b.lower", "b.start", "h", "c"], rows))
    return 0.0624 * math.fsum(c**0.25 for c in coefficients) ** (4 / 3)


def stress_only(n, folder):
    """b_i = (6·P·X_i/(400·σ))^(1/3), h_i = 20·b_i (Vanderplaats 2002, NASA/CR-2002-211768)."""
    arms = [(n - i) * LENGTH / n for i in range(n)]
    rows = [(f"s{i}", "rectangle", 0.01, 5, 0.1, 40, arm) for i, arm in enumerate(arms)]
    write(folder, f'''title = "Cantilever with {n} segments, stress and aspect limits"
minimize = "{LENGTH / n!r}*sum(sections: b*h)"

[[constraints]]
name = "stress"
for = "sections"
require = "6*{LOAD!r}*arm/(b*h^2)/{STRENGTH!r} <= 1"

[[constraints]]
name = "aspect"
for = "sections"
require = "h <= 20*b"
''', sections=(["name", "kind", "b.lower", "b.start", "h.lower", "h.start", "arm"], rows))
    return 20 * (6 * LOAD / (400 * STRENGTH)) ** (2 / 3) * math.fsum(arm ** (2 / 3) for arm in arms) * LENGTH / n


def capped(n, folder):
    """Least Σ c/a⁴ under Σ l·a² ≤ V: a² = (2c/(l·λ))^(1/3), which meets the limit for one λ."""
    ribs = [(1.0 + (k * 0.618033988749895) % 1.0, 1.0 + 3.0 * ((k * 0.754877666246693) % 1.0)) for k in range(n)]
    limit = 0.04 * math.fsum(length for length, _ in ribs)
    shares = [length * (c / length) ** (1 / 3) for length, c in ribs]
    factor = limit / math.fsum(shares)
    sections = [(f"s{k}", "rectangle", 0.01, 10, 0.15, "b", c) for k, (_, c) in enumerate(ribs)]
    table = [(f"r{k}", f"s{k}", length) for k, (length, _) in enumerate(ribs)]
    write(folder, f'''title = "{n} square ribs under one volume limit"
minimize = "sum(sections: c/b^4)"

[[constraints]]
name = "material"
require = "sum(ribs: length*from.A)/{limit!r} <= 1"
''', sections=(["name", "kind", "b.lower", "b.upper", "b.start", "h", "c"], sections), ribs=(["name", "section", "length"], table))
    return math.fsum(c / (factor * (c / length) ** (1 / 3)) ** 2 for length, c in ribs)


FAMILIES = {"svanberg": svanberg, "stress-only": stress_only, "capped": capped}


def check(ribopt, n, folder):
    """Solves all three; the number of those that miss their optimum or are not certified."""
    missed = 0
    for name, family in FAMILIES.items():
        own = os.path.join(folder, f"{name}-{n}")
        optimum = family(n, own)
        command = [ribopt, "solve", os.path.join(own, "problem.toml"), "--backend", "argmin", "--out", os.path.join(own, "out"), "--quiet"]
        subprocess.run(command, check=False, stdout=subprocess.DEVNULL)
        with open(os.path.join(own, "out", "result.json"), encoding="utf-8") as file:
            result = json.load(file)
        solution = result["solutions"][0]
        objective = result["objective"]
        error = abs(objective - optimum) / optimum if objective is not None else math.inf
        missed += not (error <= AGREEMENT and result["status"] == "certified")
        print(f'{name:12} N {n:>8} {result["status"]} ({result["scope"]}) {objective!r}, closed form {optimum!r}, '
              f'off by {error:.1e}; {solution["iterations"]} iterations, {solution["seconds"]:.2f} s', flush=True)
    return missed


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--check", metavar="RIBOPT")
    arguments.add_argument("words", nargs="+")
    given = arguments.parse_args()
    if given.check:
        folder = given.words[1] if len(given.words) > 1 else "families"
        sys.exit(1 if check(given.check, int(given.words[0]), folder) else 0)
    if len(given.words) != 3 or given.words[0] not in FAMILIES:
        arguments.error("a family, N and a folder are needed")
    print(repr(FAMILIES[given.words[0]](int(given.words[1]), given.words[2])))


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""Large structures solved by ribopt (backend argmin, whole process with its certificate) and by Ipopt (solve alone) from the same start.

usage: structures_large.py RIBOPT [--lattices N …] [--grillages N …] [--analyse N …] [--cap SECONDS] [--table FILE.md]
       (pip install casadi numpy scipy)

A lattice of N × N cells has 4N² + N bars and two load cases, a grillage of N × N cells 2N(N − 1) ribs with a width and a height each;
structure_families.py says what is asked of them. Ipopt runs with MUMPS, exact sparse Hessians and its tolerance of 1e-8 on the same
lifted problem: sizes and displacements. With --analyse lattices are read, analysed and differentiated, and their derivatives checked.
"""
import argparse
import json
import os
import resource
import subprocess
import sys
import tempfile
import time

from structure_families import FAMILIES


def run(command):
    """Output, seconds by the wall and of the processor, and megabytes of a process."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    begun = time.time()
    done = subprocess.run(["/usr/bin/time", "-f", "%M", *command], capture_output=True, text=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    processor = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return done.stdout, time.time() - begun, processor, int(done.stderr.strip().splitlines()[-1]) / 1024


def ribopt(binary, folder, cap):
    command = [binary, "solve", f"{folder}/problem.toml", "--backend", "argmin", "--starts", "1", "--max-seconds", str(cap),
               "--out", f"{folder}/results", "--json"]
    text, wall, processor, megabytes = run(command)
    result = json.loads(text)
    solution = result["solutions"][0]
    return {"status": result["status"], "objective": solution["objective"], "iterations": solution["iterations"],
            "solve": solution["seconds"], "wall": wall, "processor": processor, "megabytes": megabytes}


IPOPT = """
import json, sys, time
import casadi as ca
from structure_families import FAMILIES
x, f, g, lower, upper, start, least, most = FAMILIES[sys.argv[1]](int(sys.argv[2])).statement()
options = {"ipopt.print_level": 0, "ipopt.sb": "yes", "print_time": 0, "ipopt.tol": 1e-8, "ipopt.max_cpu_time": float(sys.argv[3])}
solver = ca.nlpsol("solver", "ipopt", {"x": x, "f": f, "g": g}, options)
wall, processor = time.time(), time.process_time()
found = solver(x0=start, lbx=least, ubx=most, lbg=lower, ubg=upper)
print(json.dumps({"status": solver.stats()["return_status"], "objective": float(found["f"]), "iterations": solver.stats()["iter_count"],
                  "wall": time.time() - wall, "processor": time.process_time() - processor}))
"""


def ipopt(family, n, cap):
    here = os.path.dirname(os.path.abspath(__file__))
    done = subprocess.run([sys.executable, "-c", IPOPT, family, str(n), str(cap)], cwd=here, capture_output=True, text=True)
    return json.loads(done.stdout.splitlines()[-1]) if done.returncode == 0 else None


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("ribopt")
    arguments.add_argument("--lattices", type=int, nargs="*", default=[5, 10, 16, 50])
    arguments.add_argument("--grillages", type=int, nargs="*", default=[6, 10, 20])
    arguments.add_argument("--analyse", type=int, nargs="*", default=[158])
    arguments.add_argument("--cap", type=float, default=600.0)
    arguments.add_argument("--table")
    options = arguments.parse_args()
    work = tempfile.mkdtemp()
    lines = ["| structure | ribs | ribopt: status, objective | iterations | whole, s (processor) | MB | Ipopt: objective | iterations | solve, s (processor) |",
             "|---|---|---|---|---|---|---|---|---|"]
    for family, sizes in (("lattice", options.lattices), ("grillage", options.grillages)):
        for n in sizes:
            structure, folder = FAMILIES[family](n), f"{work}/{family}{n}"
            structure.write(folder)
            own, other = ribopt(options.ribopt, folder, options.cap), ipopt(family, n, options.cap)
            told = "| – | – | – |" if other is None else \
                f"| {other['status']}, {other['objective']:.8g} | {other['iterations']} | {other['wall']:.1f} ({other['processor']:.1f}) |"
            lines.append(f"| {family} {n} | {structure.ribs} | {own['status']}, {own['objective']:.8g} | {own['iterations']} "
                         f"| {own['wall']:.1f} ({own['processor']:.1f}) | {own['megabytes']:.0f} {told}")
            print(lines[-1], flush=True)
    for n in options.analyse:
        structure, folder = FAMILIES["lattice"](n), f"{work}/lattice{n}"
        structure.write(folder)
        for words in (["analyse", f"{folder}/problem.toml", "--json"], ["check", f"{folder}/problem.toml"]):
            _, wall, processor, megabytes = run([options.ribopt, *words])
            lines.append(f"\n{words[0]} of {structure.ribs} bars with two cases: {wall:.1f} s ({processor:.1f} of the processor), {megabytes:.0f} MB")
            print(lines[-1], flush=True)
    if options.table:
        with open(options.table, "w", encoding="utf-8") as out:
            out.write("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()

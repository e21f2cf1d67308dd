#!/usr/bin/env python3
"""ribopt and Ipopt side by side on large rib networks: families P0 (bounds only), P1 (limits per section), P2 (lines of ten ribs
with a sag limit), P3 (a coupled grid; Ipopt in logarithms), and structures: S (lattices of bars, two load cases) and G (grillages).

usage: large.py RIBOPT GENERATORS [--families P0 P1 P2 P3 S G] [--sizes 1000 10000 100000 1000000] [--runs 3] [--cap 300]
                [--total MINUTES] [--work FOLDER] [--table FILE.md] [--plot FILE.svg]          (pip install casadi numpy scipy)

GENERATORS is the folder with write_tables.py, ribs.py and grid.py; structures come from structure_families.py. Every time is the median
of --runs runs, of a single one where the first took longer than a minute; processor times are of both cores together. A run ends after
--cap seconds; a solver that met the cap is not asked for larger sizes of that family. With --total nothing is begun that is not expected
to end in time: sizes ascend, and a size is taken for twelve times the one before. Files are written where --table and --plot say; the
repository's own are benches/results/large.md and docs/large.svg.
"""
import argparse
import datetime
import json
import os
import platform
import resource
import signal
import statistics
import subprocess
import sys
import time
from dataclasses import dataclass, field

from loglog import Line, draw
from structure_families import FAMILIES

HERE = os.path.dirname(os.path.abspath(__file__))
ONE_RUN_FROM = 60.0
GROWTH = 12.0
BUILDING = 600.0
STRUCTURES = {"S": "lattice", "G": "grillage"}


@dataclass
class Run:
    """What a solver came to, in seconds: the whole process, what of the processor it took, and the solve alone; of Ipopt `processor` is
    the solve's."""

    whole: float
    processor: float
    solve: float
    iterations: int
    status: str
    objective: float | None
    megabytes: float
    solved: bool
    runs: int = 1


@dataclass
class Cell:
    """One family at one size."""

    family: str
    ribs: int
    ribopt: Run | None = None
    ipopt: Run | None = None
    notes: dict = field(default_factory=dict)


def edge(ribs):
    """Nodes along an edge of the grid with about so many ribs, 2k(k − 1)."""
    return round((1 + (1 + 2 * ribs) ** 0.5) / 2)


def cells(family, ribs):
    """Cells along an edge of the structure with about so many ribs: 4n² + n of a lattice, 2n(n − 1) of a grillage."""
    return max(2, round((ribs / 4) ** 0.5 if family == "S" else edge(ribs)))


def tables(family, size, generators, work):
    """The problem's folder, its number of ribs and its size; written if it is not there."""
    if family in STRUCTURES:
        count = cells(family, size)
        structure = FAMILIES[STRUCTURES[family]](count)
        folder = os.path.join(work, f"{family}_{structure.ribs}")
        if not os.path.exists(os.path.join(folder, "problem.toml")):
            structure.write(folder)
        return folder, structure.ribs, count
    count = edge(size) if family == "P3" else size
    ribs = 2 * count * (count - 1) if family == "P3" else size
    folder = os.path.join(work, f"{family}_{ribs}")
    if not os.path.exists(os.path.join(folder, "problem.toml")):
        script = ["grid.py", "tables", str(count)] if family == "P3" else ["write_tables.py", family, str(count)]
        subprocess.run([sys.executable, *script, folder], cwd=generators, check=True)
    return folder, ribs, count


def measured(command, limit):
    """Seconds by the wall and of the processor, and standard output; None for the output where the limit was met."""
    begun, before = time.monotonic(), resource.getrusage(resource.RUSAGE_CHILDREN)
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, start_new_session=True)
    try:
        output, _ = process.communicate(timeout=limit)
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        process.communicate()
        output = None
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    processor = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return time.monotonic() - begun, processor, output


def peak(command):
    """The command under GNU time, which tells its peak memory in a file of its own, where that is installed."""
    report = os.path.join(os.environ.get("TMPDIR", "/tmp"), f"large-{os.getpid()}.peak")
    return (["/usr/bin/time", "-f", "%M", "-o", report, *command], report) if os.path.exists("/usr/bin/time") else (command, None)


def megabytes(report):
    try:
        with open(report, encoding="utf-8") as file:
            return float(file.read().split()[-1]) / 1024
    except (OSError, TypeError, ValueError, IndexError):
        return 0.0


def run_ribopt(ribopt, folder, cap):
    out = os.path.join(folder, "out")
    command = [ribopt, "solve", os.path.join(folder, "problem.toml"), "--backend", "argmin", "--starts", "1", "--out", out, "--quiet",
               "--max-seconds", str(cap)]
    command, report = peak(command)
    whole, processor, output = measured(command, cap + BUILDING)
    if output is None:
        return None
    with open(os.path.join(out, "result.json"), encoding="utf-8") as file:
        result = json.load(file)
    solution = result["solutions"][0]
    status = f'{result["status"]}, {result["scope"]}'
    return Run(whole, processor, solution["seconds"], solution["iterations"], status, result["objective"], megabytes(report),
               result["status"] == "certified")


def run_ipopt(family, count, generators, cap):
    command = [sys.executable, os.path.join(HERE, "large_ipopt.py"), STRUCTURES.get(family, family), str(count), generators, "--limit", str(cap)]
    command, report = peak(command)
    whole, _, output = measured(command, cap + BUILDING)
    if not output:
        return None
    found = json.loads(output.splitlines()[-1])
    return Run(whole, found["processor"], found["seconds"], found["iterations"], found["status"], found["objective"], megabytes(report),
               found["status"] == "Solve_Succeeded")


class Clock:
    """What is left of the whole time."""

    def __init__(self, minutes):
        self.end = time.monotonic() + 60 * minutes if minutes else float("inf")

    def allows(self, seconds):
        return time.monotonic() + seconds < self.end


def repeated(solve, runs, expected, clock):
    """The median run, or None where nothing came of it, and a note why."""
    if not clock.allows(expected):
        return None, "left out for want of time"
    begun = time.monotonic()
    found = [solve()]
    took = time.monotonic() - begun
    if found[0] is None:
        return None, "not in time"
    while len(found) < runs and took < ONE_RUN_FROM and found[0].solved and clock.allows(took):
        found.append(solve())
    found = [run for run in found if run is not None]
    median = sorted(found, key=lambda run: run.whole)[len(found) // 2]
    median.whole = statistics.median(run.whole for run in found)
    median.processor = statistics.median(run.processor for run in found)
    median.solve = statistics.median(run.solve for run in found)
    median.runs = len(found)
    return median, "" if median.solved else median.status


def bench(given):
    """All cells, sizes ascending so that the cheap ones are there first."""
    clock, found, last, given_up = Clock(given.total), [], {}, set()
    for size in given.sizes:
        for family in given.families:
            folder, ribs, count = tables(family, size, given.generators, given.work)
            cell = Cell(family, ribs)
            solvers = {"ribopt": lambda: run_ribopt(given.ribopt, folder, given.cap),
                       "ipopt": lambda: run_ipopt(family, count, given.generators, given.cap)}
            for name, solve in solvers.items():
                key = (family, name)
                if key in given_up:
                    cell.notes[name] = "–"
                    continue
                run, note = repeated(solve, given.runs, GROWTH * last.get(key, 0.0), clock)
                setattr(cell, name, run)
                cell.notes[name] = note
                if note:
                    given_up.add(key)
                if run:
                    last[key] = run.whole
            print(row(cell), flush=True)
            found.append(cell)
    return found


HEAD = """\
| family | ribs | ribopt: whole s (processor) | solve s | iterations | MB | verdict | Ipopt: solve s (processor) | iterations | verdict | objective over Ipopt's | Ipopt's solve over ribopt's | over its whole run | processor: over its whole run |
|---|---|---|---|---|---|---|---|---|---|---|---|---|---|"""


def number(value):
    return f"{value:.3g}" if value < 1000 else f"{value:.0f}"


def row(cell):
    """One line of the table."""
    ours, theirs = cell.ribopt, cell.ipopt
    first = [cell.notes["ribopt"] or "–"] + [""] * 4
    if ours:
        once = ", one run" if ours.runs == 1 else ""
        first = [f"{number(ours.whole)} ({number(ours.processor)}{once})", number(ours.solve), str(ours.iterations),
                 number(ours.megabytes), ours.status]
    second = [cell.notes["ipopt"] or "–", "", ""]
    if theirs:
        once = ", one run" if theirs.runs == 1 else ""
        second = [f"{number(theirs.solve)} ({number(theirs.processor)}{once})", str(theirs.iterations), theirs.status]
    third = [""] * 4
    if ours and theirs and ours.solved and theirs.solved:
        difference = (ours.objective - theirs.objective) / abs(theirs.objective)
        third = [f"{difference:+.1e}", number(theirs.solve / ours.solve), number(theirs.solve / ours.whole),
                 number(theirs.processor / ours.processor)]
    return "| " + " | ".join([cell.family, str(cell.ribs), *first, *second, *third]) + " |"


def page(found, given):
    """The table with what it was measured on."""
    import casadi
    processor = platform.processor() or platform.machine()
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as file:
            processor = next(line.split(":")[1].strip() for line in file if line.startswith("model name"))
    except (OSError, StopIteration):
        pass
    load = ", load {:.1f} at the end".format(os.getloadavg()[0])
    return f"""# Large networks: ribopt and Ipopt side by side

Measured {datetime.date.today()} by `benches/large.py` on {os.cpu_count()} cores ({processor}{load}); medians of {given.runs} runs, of one
where a run takes more than {ONE_RUN_FROM:.0f} s; a run ends after {given.cap:.0f} s. Ipopt (CasADi {casadi.__version__}, MUMPS, exact Hessian, its
tolerance 1e-6) is timed for the solve alone; ribopt for the solve, and for the whole run: tables read, solved, certified, files
written. Processor times, in brackets, are of all cores together. Both begin at the same points. P2 has many local minima: there the solvers may end in different ones.

{HEAD}
""" + "\n".join(row(cell) for cell in found) + "\n"


def lines(found, families):
    """Time over ribs: ribopt's whole run and Ipopt's solve of each family."""
    for family in families:
        own = [cell for cell in found if cell.family == family]
        yield Line(f"{family} ribopt", family, [(c.ribs, c.ribopt.whole) for c in own if c.ribopt and c.ribopt.solved])
        yield Line(f"{family} Ipopt", family, [(c.ribs, c.ipopt.solve) for c in own if c.ipopt and c.ipopt.solved], dashed=True)


def save(path, text):
    os.makedirs(os.path.dirname(os.path.abspath(path)), exist_ok=True)
    with open(path, "w", encoding="utf-8") as out:
        out.write(text)


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("ribopt")
    arguments.add_argument("generators")
    arguments.add_argument("--families", nargs="+", choices=["P0", "P1", "P2", "P3", *STRUCTURES],
                           default=["P0", "P1", "P2", "P3", *STRUCTURES])
    arguments.add_argument("--sizes", nargs="+", type=int, default=[10**3, 10**4, 10**5, 10**6])
    arguments.add_argument("--runs", type=int, default=3)
    arguments.add_argument("--cap", type=float, default=300)
    arguments.add_argument("--total", type=float, help="minutes for the whole, for example 20")
    arguments.add_argument("--work", default="large-work")
    arguments.add_argument("--table", help="where to write the table, for example benches/results/large.md")
    arguments.add_argument("--plot", help="where to write the plot, for example docs/large.svg")
    given = arguments.parse_args()
    given.ribopt, given.generators, given.work = (os.path.abspath(path) for path in (given.ribopt, given.generators, given.work))
    given.sizes.sort()
    print(HEAD, flush=True)
    found = bench(given)
    if given.table:
        save(given.table, page(found, given))
    if given.plot:
        title = "Whole run of ribopt (read, solve, certify, write), solve alone of Ipopt"
        save(given.plot, draw(list(lines(found, given.families)), title, "ribs", "seconds"))


if __name__ == "__main__":
    main()

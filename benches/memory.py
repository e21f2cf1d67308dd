#!/usr/bin/env python3
"""Resident memory of `ribopt solve --backend argmin` by phase, in megabytes and in bytes per rib.

usage: memory.py RIBOPT PROBLEM.toml… [--work FOLDER]          (Linux)

Phases are told apart by what a run leaves while it goes on: its folder's lock (the problem is read and assembled), the lines of its log
(an iteration each), and the first file written. The most of each phase is shown, of samples every five milliseconds.
"""
import argparse
import glob
import os
import subprocess
import tempfile
import time

PHASES = ["read, assembled", "solved", "certified", "written"]


def resident(process):
    """Bytes, 0 once the process has ended."""
    try:
        with open(f"/proc/{process.pid}/statm", encoding="ascii") as file:
            return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")
    except (OSError, IndexError, ValueError):
        return 0


def samples(ribopt, problem, out):
    """Seconds, bytes, size of the log and whether a file is being written."""
    log = os.path.join(out, "log-argmin.csv")
    command = [ribopt, "solve", problem, "--backend", "argmin", "--starts", "1", "--quiet", "--out", out]
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    begun, found = time.monotonic(), []
    while process.poll() is None:
        logged = os.path.getsize(log) if os.path.exists(log) else -1
        written = bool(glob.glob(os.path.join(out, "*.unfinished"))) or os.path.exists(os.path.join(out, "result.json"))
        found.append((time.monotonic() - begun, resident(process), logged, written))
        time.sleep(0.005)
    return found


def most(found):
    """The most of every phase, and when each ended."""
    locked = [logged >= 0 for _, _, logged, _ in found]
    first = locked.index(True) if True in locked else len(found)
    write = next((k for k, sample in enumerate(found) if sample[3]), len(found))
    longest = max((sample[2] for sample in found), default=0)
    last = next((k for k, sample in enumerate(found) if sample[2] == longest), write)
    ends = [first, max(first, min(last, write)), write, len(found)]
    for phase, begin, end in zip(PHASES, [0, *ends], ends):
        part = found[begin:end]
        yield phase, max((sample[1] for sample in part), default=0), found[end - 1][0] if part else None


def ribs(problem):
    with open(os.path.join(os.path.dirname(problem), "ribs.csv"), encoding="utf-8") as file:
        return sum(1 for _ in file) - 1


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("ribopt")
    arguments.add_argument("problems", nargs="+")
    arguments.add_argument("--work")
    given = arguments.parse_args()
    print("| problem | ribs | " + " | ".join(PHASES) + " |\n|---|---|" + "---|" * len(PHASES), flush=True)
    for problem in given.problems:
        count, name = ribs(problem), os.path.basename(os.path.dirname(os.path.abspath(problem)))
        with tempfile.TemporaryDirectory(dir=given.work) as out:
            cells = []
            for _, size, end in most(samples(given.ribopt, problem, os.path.join(out, name))):
                cells.append(f"{size / 1e6:.0f} MB, {size / count:.0f} B per rib" if end is not None else "–")
        print(f"| {name} | {count} | " + " | ".join(cells) + " |", flush=True)


if __name__ == "__main__":
    main()

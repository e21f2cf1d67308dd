#!/usr/bin/env python3
"""Signals at random moments of a solve, for a bounded time: what is left must be whole.

usage: signals.py RIBOPT [--seconds 60] [--seed 1] [--problem FILE]

A certified answer is put into a folder first. Then runs into the same folder are sent SIGINT, SIGTERM, SIGHUP or SIGKILL after a
random time. A finding is: an exit code other than 5 (or that of a run that had ended), more than two seconds of processor time after the
signal (a busy machine may take longer), or no end in thirty, result.json that is no JSON or lost its certified answer, a CSV that is not rectangular or does not end with a newline
(of a killed run: the logs may be the killed run's, the tables may not), a folder that stays locked. Exit code 1 if there are any.
"""
import argparse
import csv
import glob
import json
import os
import random
import resource
import signal
import subprocess
import sys
import tempfile
import time

# Takes seconds to solve to the end, and has a certified answer within a few of them.
LONG = """minimize = "sum((x - 0.3)^2) - 0.1*sum(cos(25*x))"
[variables]
x = { size = 40, lower = -5, upper = 5, start = 2.5 }
"""


def ragged(path):
    with open(path, encoding="utf-8", newline="") as file:
        text = file.read()
    widths = {len(row) for row in csv.reader(text.splitlines())}
    return not text.endswith("\n") or len(widths) > 1


def wrong(out, killed):
    """What is wrong with a folder after a run was stopped, or None."""
    try:
        with open(os.path.join(out, "result.json"), encoding="utf-8") as file:
            status = json.load(file)["status"]
    except (OSError, ValueError) as error:
        return f"result.json: {error}"
    if status != "certified":
        return f"the certified answer gave way to one that is {status}"
    for path in glob.glob(os.path.join(out, "**", "*.csv"), recursive=True):
        if ragged(path):
            return f"{path} is not whole"
    left = glob.glob(os.path.join(out, "*.unfinished"))
    return f"{left[0]} is left" if left and not killed else None


def used_by_children():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def used_by(pid):
    """Processor seconds of a running process; none where the system does not tell."""
    try:
        with open(f"/proc/{pid}/stat", encoding="utf-8") as file:
            fields = file.read().rsplit(")", 1)[1].split()
    except OSError:
        return 0.0
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("ribopt")
    parser.add_argument("--seconds", type=float, default=60.0)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--problem")
    options = parser.parse_args()
    ribopt, rng = os.path.abspath(options.ribopt), random.Random(options.seed)
    until, runs, found = time.monotonic() + options.seconds, 0, 0
    with tempfile.TemporaryDirectory() as folder:
        problem = os.path.abspath(options.problem) if options.problem else os.path.join(folder, "long.toml")
        if not options.problem:
            with open(problem, "w", encoding="utf-8") as file:
                file.write(LONG)
        out = os.path.join(folder, "out")
        first = [ribopt, "solve", problem, "--quiet", "--out", out, "--backend", "argmin"]
        if subprocess.run(first, check=False).returncode != 0:
            sys.exit("the problem has no certified answer")
        long = [ribopt, "solve", problem, "--quiet", "--out", out, "--starts", "100000"]
        while time.monotonic() < until:
            one = rng.choice([signal.SIGINT, signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGKILL])
            child = subprocess.Popen(long, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
            time.sleep(rng.uniform(0.0, 1.5))
            before, others = used_by(child.pid), used_by_children()
            child.send_signal(one)
            sent, runs = time.monotonic(), runs + 1
            try:
                _, told = child.communicate(timeout=30)
            except subprocess.TimeoutExpired:
                child.kill()
                child.communicate()
                told = b""
            late, killed = time.monotonic() - sent, one == signal.SIGKILL
            worked = used_by_children() - others - before
            complaint = wrong(out, killed)
            if (late > 29.0 or worked > 2.0) and not killed:
                complaint = complaint or f"ended {late:.1f} s and {worked:.1f} s of processor time after the signal"
            if not killed and child.returncode not in (0, 5, -one):
                complaint = complaint or f"exit code {child.returncode}: {told.decode(errors='replace')}"
            if complaint:
                found += 1
                print(f"run {runs}, {one.name}: {complaint}", flush=True)
        if subprocess.run(first, check=False).returncode != 0:
            found += 1
            print("after all signals the folder does not take a run")
    print(f"{runs} signals, {found} findings")
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()

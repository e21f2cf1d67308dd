#!/usr/bin/env python3
"""Solve the algebraic problems of a benchmarks JSON file with ribopt and score the answers against the verified optima.

usage: collection.py BENCHMARKS.json FOLDER_WITH_TOML RIBOPT [ID ...]     (see benchmarks/to_toml.py for the folder)
"""
import json
import os
import subprocess
import sys
import tempfile
import time

EXIT = {"optimal": 0, "infeasible": 3, "unbounded": 4, "infimum_not_attained": 4}


def near(value, best):
    return value is not None and abs(value - best) <= 1e-6 * max(1.0, abs(best))


def judge(problem, code, result):
    """(verdict, per-backend hits) of one run."""
    expected, verified = problem["expected"], problem.get("verified") or {}
    if verified.get("f") is None:
        wanted = 2 if problem["id"] == "inf_bounds" else EXIT[expected]
        return ("ok" if code == wanted else f"exit {code}, wanted {wanted}"), {}
    best = float(verified["f"])
    minima = [d["f"] for d in (verified.get("multistart") or {}).get("distinct", [])]
    hits = {s["backend"]: near(s["objective"], best) and bool(s["certificate"] and s["certificate"]["certified"])
            for s in result.get("solutions", [])}
    objective = result.get("objective")
    if near(objective, best) and (code == 0 or expected == "optimal_no_kkt"):
        return "ok", hits
    if code == 0 and any(near(objective, f) for f in minima):
        return "local", hits
    return f"exit {code} {result.get('status')} f {objective} for {best}", hits


def algebraic(source):
    """The problems that are stated by expressions."""
    with open(source) as file:
        return [problem for problem in json.load(file)["problems"] if problem.get("analysis") == "algebraic"]


def solve(ribopt, path, *options):
    """(exit code, result, seconds) of one run; exit code -1 where it did not end."""
    with tempfile.TemporaryDirectory() as out:
        begin = time.time()
        try:
            command = [ribopt, "solve", path, "--json", "--out", out, *options]
            run = subprocess.run(command, capture_output=True, text=True, timeout=120)
            code, text = run.returncode, run.stdout
        except subprocess.TimeoutExpired:
            code, text = -1, ""
    return code, json.loads(text or "{}"), time.time() - begin


def main():
    source, folder, ribopt, wanted = sys.argv[1], sys.argv[2], os.path.abspath(sys.argv[3]), set(sys.argv[4:])
    counts, hits, total, slow = {}, {}, 0, []
    for problem in algebraic(source):
        path = os.path.join(folder, problem["id"] + ".toml")
        if not os.path.exists(path) or (wanted and problem["id"] not in wanted):
            continue
        code, result, seconds = solve(ribopt, path)
        verdict, by_backend = judge(problem, code, result)
        kind = verdict if verdict in ("ok", "local") else "FAIL"
        counts[kind] = counts.get(kind, 0) + 1
        if by_backend:
            total += 1
            for backend, hit in by_backend.items():
                hits[backend] = hits.get(backend, 0) + hit
        missed = [backend for backend, hit in by_backend.items() if not hit]
        if seconds > 2:
            slow.append((problem["id"], round(seconds, 1)))
        if kind == "FAIL" or missed or wanted:
            print(f"{problem['id']:32} {verdict:60} {seconds:6.2f} s  missed by {', '.join(missed) or '-'}", flush=True)
    print(counts, {backend: f"{hit}/{total}" for backend, hit in hits.items()}, "slow:", slow)


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""Mutates problem files, tables and geometry files and runs ribopt on them, for a bounded time.

usage: mutate.py RIBOPT [--seconds 60] [--seed 1] [--keep FOLDER] [FILE...]

Seeds are the problem files given (default: problems and the examples), with the tables they name, answers, and meshes and lines of every
format. Every mutant is solved, checked, compared, drawn or put through a stage of `mesh` with a short --max-seconds. A finding is: an
exit code outside 0 to 6, a panic, a run that takes the processor several times as long, standard output that is not one JSON object
where --json was given, or an input file that has changed. Findings are kept with their command. Exit code 1 if there are any. The same seed gives the same mutants.
"""
import argparse
import glob
import hashlib
import json
import os
import random
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time

HERE = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
MESHES = (".obj", ".stl", ".ply", ".off", ".csv", ".dxf")
PLY = """ply
format ascii 1.0
element vertex 4
property float x
property float y
property float z
element face 1
property list uchar int vertex_indices
element edge 1
property int vertex1
property int vertex2
end_header
0 0 0
1 0 0
1 1 0
0 1 0
4 0 1 2 3
0 1
"""
NUMBERS = ["0", "-1", "1e308", "1e309", "-1e309", "1e-320", "nan", "inf", "-inf", "1e306", "0.1", "1_000", "0x10", "1e8", "99999999999999999999"]
WORDS = ["sum(", ")", "max(", "^", "/0", "\"", "'", "[", "]", "{", "}", "=", "<=", ">=", "==", "#", "\\", "\n", "\r\n", "\t", ";", ",", "\u0000",
         "\u001b[2J", "\ufeff", "\u202e", "volume", "ribs:", "sections:", "from.", "[[ribs]]", "[variables]", "size = ", "log(", "sqrt(", "-"]
TABLE = re.compile(r'^\s*(?:sections|ribs)\s*=\s*"([^"]+)"', re.M)
NUMBER = re.compile(r"-?\d+\.?\d*(?:[eE][-+]?\d+)?")


def mutated(text, rng):
    """The text with one to four changes."""
    for _ in range(rng.randint(1, 4)):
        way = rng.randrange(8)
        lines = text.split("\n")
        found = list(NUMBER.finditer(text))
        if way <= 2 and found:
            spot = rng.choice(found)
            text = text[:spot.start()] + rng.choice(NUMBERS) + text[spot.end():]
        elif way == 3 and len(lines) > 1:
            del lines[rng.randrange(len(lines))]
            text = "\n".join(lines)
        elif way == 4:
            at = rng.randrange(len(lines))
            lines.insert(rng.randrange(len(lines) + 1), lines[at])
            text = "\n".join(lines)
        elif way == 5 and text:
            at = rng.randrange(len(text))
            text = text[:at] + text[at + rng.randint(1, 20):]
        elif way == 6:
            text = text[:rng.randrange(len(text) + 1)]
        else:
            at = rng.randrange(len(text) + 1)
            text = text[:at] + rng.choice(WORDS) + text[at:]
    return text


def seeds(files):
    """Each problem as a list of (name, text): the problem file first, then its tables and geometry."""
    for path in files:
        with open(path, encoding="utf-8") as file:
            text = file.read()
        parts = [("p.toml", text)]
        for table in TABLE.findall(text):
            where = os.path.join(os.path.dirname(path), table)
            if os.path.exists(where) and os.path.getsize(where) < 200_000:
                with open(where, encoding="utf-8") as file:
                    parts.append((os.path.basename(table), file.read()))
        geometry = os.path.join(os.path.dirname(path), "geometry.csv")
        if len(parts) > 1 and os.path.exists(geometry):
            with open(geometry, encoding="utf-8") as file:
                parts.append(("geometry.csv", file.read()))
        yield parts


def mesh_seeds(ribopt, folder):
    """Meshes and a problem folder made by ribopt itself."""
    made = []
    paths = sorted(glob.glob(os.path.join(HERE, "tests", "data", "mesh", "*.*")))
    for name, ending in [("grid", "obj"), ("cube", "stl"), ("small-vault", "obj")]:
        paths.append(os.path.join(folder, f"{name}.{ending}"))
        subprocess.run([ribopt, "mesh", "new", name, "-o", paths[-1]], check=True, capture_output=True)
    paths.append(os.path.join(folder, "cube.ply"))
    with open(paths[-1], "w", encoding="utf-8") as file:
        file.write(PLY)
    for ending in ["csv", "dxf"]:
        paths.append(os.path.join(folder, f"lines.{ending}"))
        subprocess.run([ribopt, "mesh", "trace", os.path.join(folder, "grid.obj"), "-o", paths[-1]], check=True, capture_output=True)
    for path in paths:
        ending = os.path.splitext(path)[1]
        if ending in MESHES and os.path.getsize(path) < 200_000:
            with open(path, "rb") as file:
                made.append((f"m{ending}", file.read().decode("latin-1")))
    vault = os.path.join(folder, "vault")
    subprocess.run([ribopt, "mesh", "ribs", os.path.join(folder, "small-vault.obj"), "-o", vault], check=True, capture_output=True)
    return made, os.path.join(vault, "problem.toml")


def answers(ribopt, folder, files):
    """Small problems with an answer beside them."""
    made = []
    for path in files[:4]:
        if os.path.getsize(path) > 4000 or TABLE.search(open(path, encoding="utf-8").read()):
            continue
        out = os.path.join(folder, "answer")
        subprocess.run([ribopt, "solve", path, "--quiet", "--out", out, "--max-seconds", "5"], check=False, capture_output=True)
        with open(path, encoding="utf-8") as file, open(os.path.join(out, "result.json"), encoding="utf-8") as answer:
            made.append([("p.toml", file.read()), ("answer.json", answer.read())])
        shutil.rmtree(out)
    return made


def command(parts, rng, seconds):
    """What is run on a mutant."""
    name = parts[0][0]
    if name.startswith("m."):
        return rng.choice([["mesh", "check", name], ["mesh", "trace", name, "-o", "lines.obj"], ["mesh", "ribs", name, "-o", "out"],
                           ["mesh", "smooth", name, "-o", "smooth.obj", "--iterations", "3"], ["mesh", "trace", name, "-o", "lines.dxf"],
                           ["mesh", "reconstruct", name, "--original", name, "-o", "whole.obj"],
                           ["mesh", "slice", name, "--segments", "0.5", "-o", "cut.csv"],
                           ["mesh", "slice", name, "--plane", "0.5,0.5,0.5:0,0,1", "-o", "cut.svg"]]), False
    solve = ["solve", name, "--json", "--max-seconds", str(seconds), "--out", "out"]
    if any(part == "geometry.csv" for part, _ in parts):
        solve += rng.choice([[], ["--plot"], ["--solids", "solids.obj"]])
    if any(part == "answer.json" for part, _ in parts):
        return rng.choice([(solve + ["--start", "answer.json"], True), (["verify", name, "answer.json", "--json"], True),
                           (["section", name, "--answer", "answer.json"], False)])
    return rng.choice([(solve, True), (solve, True), (["check", name, "--json"], True), (["section", name], False),
                       (["compare", name, "--max-seconds", "0.2", "--json"], True),
                       (["bounds", name, "--max-seconds", str(seconds)], False)])


def sums(folder, parts):
    return [hashlib.sha256(open(os.path.join(folder, name), "rb").read()).hexdigest() for name, _ in parts]


def finding(ribopt, folder, parts, arguments, is_json, seconds):
    """What is wrong with a run, or None."""
    before = sums(folder, parts)
    # Of the processor: a busy machine takes longer.
    most = int(4.0 * seconds) + 6
    try:
        done = subprocess.run([ribopt] + arguments, cwd=folder, capture_output=True, timeout=20.0 * most, stdin=subprocess.DEVNULL,
                              preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (most, most + 2)))
    except subprocess.TimeoutExpired:
        return "no end"
    if done.returncode in (-signal.SIGXCPU, -signal.SIGKILL):
        return "no end"
    if done.returncode not in range(7):
        return f"exit code {done.returncode}"
    if b"panicked" in done.stderr:
        return "panic"
    if sums(folder, parts) != before:
        return "an input was changed"
    if is_json:
        try:
            json.loads(done.stdout)
        except ValueError:
            return "no JSON"
    if b"\x1b" in done.stdout or b"\x1b" in done.stderr:
        return "an escape code"
    return None


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("ribopt")
    parser.add_argument("files", nargs="*")
    parser.add_argument("--seconds", type=float, default=60.0)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--keep", default="fuzz-findings")
    options = parser.parse_args()
    ribopt, rng, limit = os.path.abspath(options.ribopt), random.Random(options.seed), 2.0
    files = options.files or sorted(glob.glob(os.path.join(HERE, "problems", "*.toml")) + glob.glob(os.path.join(HERE, "src/input/examples/*.toml")))
    until, runs, found = time.monotonic() + options.seconds, 0, 0
    with tempfile.TemporaryDirectory() as scratch:
        meshes, vault = mesh_seeds(ribopt, scratch)
        pool = list(seeds(files + [vault])) + [[mesh] for mesh in meshes] + answers(ribopt, scratch, files)
        while time.monotonic() < until:
            parts = list(rng.choice(pool))
            at = rng.randrange(len(parts))
            parts[at] = (parts[at][0], mutated(parts[at][1], rng))
            arguments, is_json = command(parts, rng, limit)
            folder = os.path.join(scratch, "run")
            os.mkdir(folder)
            for name, text in parts:
                with open(os.path.join(folder, name), "wb") as file:
                    file.write(text.encode("latin-1" if name.startswith("m.") else "utf-8", "replace"))
            wrong = finding(ribopt, folder, parts, arguments, is_json, limit)
            runs += 1
            if wrong:
                found += 1
                kept = os.path.join(options.keep, f"{options.seed}-{runs}")
                shutil.rmtree(os.path.join(folder, "out"), ignore_errors=True)
                shutil.copytree(folder, kept, dirs_exist_ok=True)
                print(f"{wrong}: cd {kept} && ribopt {' '.join(arguments)}", flush=True)
            shutil.rmtree(folder)
    print(f"{runs} mutants, {found} findings")
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()

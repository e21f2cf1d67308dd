#!/usr/bin/env python3
"""Draws docs/portal-frame.svg: problems/portal-frame.toml as sized, with moments and displacements as `ribopt analyse --json` tells them.

usage: portal-frame.py BINARY      (from the root of the repository)
"""
import json
import os
import subprocess
import sys
import tempfile

BINARY, FILE, OUT = sys.argv[1], "problems/portal-frame.toml", "docs/portal-frame.svg"
CASE, SERVICE, STEPS, MAGNIFIED = "ULS snow", "SLS", 24, 20
NODES = {"foot1": (0, 0), "eaves1": (0, 6), "ridge": (9, 7.5), "eaves2": (18, 6), "foot2": (18, 0)}
RIBS = {"column1": ("foot1", "eaves1", "foot", "knee"), "rafter1": ("eaves1", "ridge", "knee", "top"),
        "rafter2": ("ridge", "eaves2", "top", "knee"), "column2": ("eaves2", "foot2", "knee", "foot")}
COLOURS = ["#3b528b", "#21918c", "#5ec962", "#fde725"]


def run(*arguments):
    done = subprocess.run([BINARY, *arguments], capture_output=True, text=True)
    if done.returncode:
        raise SystemExit(done.stderr or done.stdout)
    return json.loads(done.stdout)


def at(s, start, end):
    return tuple((1 - s) * a + s * b for a, b in zip(start, end))


def screen(point):
    return f"{90 + 38 * point[0]:.1f},{330 - 38 * point[1]:.1f}"


def line(points, style):
    return f'<polyline points="{" ".join(map(screen, points))}" fill="none" {style}/>'


with tempfile.TemporaryDirectory() as folder:
    answer = run("solve", FILE, "--out", folder, "--json")
    result = os.path.join(folder, "result.json")
    # Definitions that ask for moments, deflections and stresses along every rib.
    text = open(FILE, encoding="utf-8").read()
    text = text.replace("[[constraints]]", "[definitions]\n" + "".join(
        f"\"{kind} {rib} {k}\" = \"{response}\"\n" for rib in RIBS for k in range(STEPS + 1)
        for kind, response in (("M", f"force('{CASE}', {rib}, My, {k}/{STEPS})"), ("w", f"deflection({SERVICE}, {rib}, z, {k}/{STEPS})"),
                               *((p, f"stress('{CASE}', {rib}, {k}/{STEPS}, {p})") for p in ("top", "bottom")))
    ) + "\n[[constraints]]", 1)
    asked = os.path.join(folder, "asked.toml")
    with open(asked, "w", encoding="utf-8") as file:
        file.write(text)
    found = run("analyse", asked, result, "--json")
value, moved = found["definitions"], found["cases"][SERVICE]["displacements"]
sizes = answer["variables"]
depth = {name: sizes[f"{name}.hw"] + 2 * sizes["foot.tf"] for name in ("foot", "knee", "top")}
limit = 0.6 * 355e3
largest = max(abs(value[f"M {rib} {k}"]) for rib in RIBS for k in range(STEPS + 1))
solids, moments, shape = [], [], []
for rib, (start, end, first, last) in RIBS.items():
    a, b = NODES[start], NODES[end]
    length = ((b[0] - a[0]) ** 2 + (b[1] - a[1]) ** 2) ** 0.5
    up = (-(b[1] - a[1]) / length, (b[0] - a[0]) / length)
    beside = lambda s, far: tuple(x + far * n for x, n in zip(at(s, a, b), up))
    high = lambda s: 0.5 * ((1 - s) * depth[first] + s * depth[last])
    for k in range(STEPS):
        s, t = k / STEPS, (k + 1) / STEPS
        used = max(abs(value[f"{p} {rib} {j}"]) for p in ("top", "bottom") for j in (k, k + 1)) / limit
        corners = [beside(s, high(s)), beside(t, high(t)), beside(t, -high(t)), beside(s, -high(s))]
        solids.append(f'<polygon points="{" ".join(map(screen, corners))}" fill="{COLOURS[min(int(4 * used), 3)]}">'
                      f'<title>{rib}: {100 * used:.0f} %</title></polygon>')
    # Moments on the tension side: My > 0 pulls the bottom.
    moments.append(line([a] + [beside(k / STEPS, -1.6 * value[f"M {rib} {k}"] / largest) for k in range(STEPS + 1)] + [b],
                        'stroke="#b5367a" stroke-width="1.2"'))
    u, v = ((moved[n]["x"], moved[n]["z"]) for n in (start, end))
    points = []
    for k in range(STEPS + 1):
        s = k / STEPS
        chord, across = at(s, u, v), value[f"w {rib} {k}"]
        points.append(tuple(x + MAGNIFIED * (c + across * n) for x, c, n in zip(at(s, a, b), chord, up)))
    shape.append(line(points, 'stroke="#777" stroke-width="1" stroke-dasharray="5 3"'))
legend = "".join(f'<rect x="{290 + 110 * k}" y="362" width="20" height="10" fill="{colour}"/><text x="{316 + 110 * k}" y="371">'
                 f'{25 * k}–{25 * (k + 1)} %</text>' for k, colour in enumerate(COLOURS))
with open(OUT, "w", encoding="utf-8") as file:
    file.write('<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 860 420" font-family="sans-serif" font-size="12">\n'
               '<rect width="100%" height="100%" fill="white"/>\n' + "\n".join(solids + moments + shape) + "\n"
               f'<text x="90" y="371">stress, {CASE}, of its limit:</text>{legend}\n'
               f'<text x="90" y="390" fill="#b5367a">My, {CASE}, on the tension side; largest {largest:.0f} kNm</text>\n'
               f'<text x="90" y="408" fill="#555">displaced shape, {SERVICE}, {MAGNIFIED} times</text>\n</svg>\n')

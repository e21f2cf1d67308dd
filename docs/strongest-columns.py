#!/usr/bin/env python3
"""Draws docs/strongest-columns.svg: problems/strongest-pinned-column.toml and problems/strongest-column.toml as sized, with their lowest modes.

usage: strongest-columns.py BINARY      (from the root of the repository)
"""
import json
import math
import subprocess
import sys
import tempfile

BINARY, OUT = sys.argv[1], "docs/strongest-columns.svg"
HEIGHT, WIDTH, TOP = 380, 60, 40


def areas(file):
    """The areas of the pieces from below, as solved."""
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run([BINARY, "solve", file, "--out", folder, "--json"], capture_output=True, text=True)
    answer = json.loads(done.stdout)
    half = [answer["variables"][f"A{k}"] for k in range(1, len(answer["variables"]) + 1)]
    return half + half[::-1], answer


def solved(matrix, right):
    """Gaussian elimination with partial pivoting."""
    n, rows = len(right), [row[:] + [value] for row, value in zip(matrix, right)]
    for k in range(n):
        pivot = max(range(k, n), key=lambda i: abs(rows[i][k]))
        rows[k], rows[pivot] = rows[pivot], rows[k]
        for i in range(k + 1, n):
            share = rows[i][k] / rows[k][k]
            if share:
                for j in range(k, n + 1):
                    rows[i][j] -= share * rows[k][j]
    x = [0.0] * n
    for k in reversed(range(n)):
        x[k] = (rows[k][n] - sum(rows[k][j] * x[j] for j in range(k + 1, n))) / rows[k][k]
    return x


def modes(pieces, clamped, count):
    """The lowest factors and shapes (deflections at the pieces' ends) of K w = λ G w under a unit load, EI = A², by subspace iteration."""
    n, h = len(pieces), 1 / len(pieces)
    size = 2 * (n + 1)
    k, g = ([[0.0] * size for _ in range(size)] for _ in range(2))
    stiff = [[12, 6 * h, -12, 6 * h], [6 * h, 4 * h * h, -6 * h, 2 * h * h], [-12, -6 * h, 12, -6 * h], [6 * h, 2 * h * h, -6 * h, 4 * h * h]]
    turned = [[36, 3 * h, -36, 3 * h], [3 * h, 4 * h * h, -3 * h, -h * h], [-36, -3 * h, 36, -3 * h], [3 * h, -h * h, -3 * h, 4 * h * h]]
    for piece, area in enumerate(pieces):
        for i in range(4):
            for j in range(4):
                k[2 * piece + i][2 * piece + j] += area**2 / h**3 * stiff[i][j]
                g[2 * piece + i][2 * piece + j] += turned[i][j] / (30 * h)
    held = {0, 2 * n} | ({1, 2 * n + 1} if clamped else set())
    free = [i for i in range(size) if i not in held]
    k, g = ([[m[i][j] for j in free] for i in free] for m in (k, g))
    times = lambda v: [sum(a * b for a, b in zip(row, v)) for row in g]
    dot = lambda a, b: sum(x * y for x, y in zip(a, b))
    vectors = [[math.sin((i + 1) * (c + 1) * 0.7) for i in range(len(free))] for c in range(count + 2)]
    for _ in range(15):
        images = [solved(k, times(v)) for v in vectors]
        vectors = []
        for image in images:
            for other in vectors:
                share = dot(image, times(other))
                image = [a - share * b for a, b in zip(image, other)]
            length = math.sqrt(dot(image, times(image)))
            vectors.append([a / length for a in image])
    found = []
    for v in vectors[:count]:
        whole = [0.0] * size
        for place, value in zip(free, v):
            whole[place] = value
        factor = sum(a * dot(row, v) for a, row in zip(v, k))
        found.append((factor, whole[0::2]))
    return found


def column(x, pieces, answer, clamped):
    """Outline, prismatic column of the same load, modes, and words."""
    size, h = HEIGHT / len(pieces), 1 / len(pieces)
    parts = [f'<rect x="{x - WIDTH / 2}" y="{TOP}" width="{WIDTH}" height="{HEIGHT}" fill="none" stroke="#999" stroke-dasharray="4 3"/>']
    for piece, area in enumerate(pieces):
        width, y = WIDTH * math.sqrt(area), TOP + HEIGHT - (piece + 1) * size
        parts.append(f'<rect x="{x - width / 2:.1f}" y="{y:.1f}" width="{width:.1f}" height="{size:.1f}" fill="#3b528b" stroke="white" stroke-width="0.4"/>')
    found = modes(pieces, clamped, 2)
    for number, (factor, shape) in enumerate(found):
        largest = max(map(abs, shape))
        along = [(x + 90 + 50 * number + 18 * w / largest, TOP + HEIGHT * (1 - i * h)) for i, w in enumerate(shape)]
        points = " ".join(f"{a:.1f},{b:.1f}" for a, b in along)
        parts.append(f'<polyline points="{points}" fill="none" stroke="#21918c" stroke-width="2"/>')
        parts.append(f'<text x="{x + 90 + 50 * number}" y="{TOP + HEIGHT + 20}" text-anchor="middle">{factor:.4g}</text>')
    ends = "clamped" if clamped else "pinned"
    parts.append(f'<text x="{x}" y="{TOP - 14}" text-anchor="middle">{ends}: volume {answer["objective"]:.5g}</text>')
    return "\n".join(parts)


drawn = [column(110, *areas("problems/strongest-pinned-column.toml"), False), column(390, *areas("problems/strongest-column.toml"), True)]
with open(OUT, "w", encoding="utf-8") as file:
    file.write(f'''<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 600 {TOP + HEIGHT + 80}" font-family="sans-serif" font-size="13">
<rect width="100%" height="100%" fill="white"/>
{chr(10).join(drawn)}
<text x="300" y="{TOP + HEIGHT + 48}" text-anchor="middle">dashed: the prismatic column of the same buckling load and of volume 1</text>
<text x="300" y="{TOP + HEIGHT + 66}" text-anchor="middle">green: the two lowest modes and their factors</text>
</svg>
''')

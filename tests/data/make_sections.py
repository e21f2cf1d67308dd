"""Section properties from sectionproperties (finite elements) and validity from shapely (GEOS), written once beside this script.

pip install sectionproperties==3.10.2; python tests/data/make_sections.py
"""
import json
import math
import pathlib

import numpy as np
from sectionproperties.analysis import Section
from sectionproperties.pre import Geometry
from shapely.geometry import Polygon

HERE = pathlib.Path(__file__).parent


def section(outer, holes, mesh, warping):
    geometry = Geometry(Polygon(outer, holes))
    geometry.create_mesh(mesh_sizes=[mesh])
    s = Section(geometry)
    s.calculate_geometric_properties()
    out = {"area": s.get_area(), "centroid": s.get_c(), "moments": s.get_ic(), "principal": s.get_ip(), "moduli": s.get_z()}
    if warping:
        s.calculate_warping_properties()
        out |= {"torsion": s.get_j(), "shear_areas": s.get_as()}
    return out


def polygons():
    angle = [(0, 0), (6, 0), (6, 1), (1, 1), (1, 10), (0, 10)]
    plate = [(0, 0), (8, -1), (10, 4), (6, 9), (1, 7)]
    cases = [
        (angle, []),
        (plate, [[(2, 1), (4, 1), (4, 3)], [(5, 4), (7, 4), (7, 6), (5, 7)]]),
        ([(1000 + x, -2000 + y) for x, y in angle], []),
    ]
    return [{"outer": outer, "holes": holes, "expected": section(outer, holes, 0.5, False)} for outer, holes in cases]


def ring(d, n=180):
    return [(d / 2 * math.cos(2 * math.pi * k / n), d / 2 * math.sin(2 * math.pi * k / n)) for k in range(n)]


def superellipse(a, b, r, n=240):
    def bend(value):
        return math.copysign(abs(value) ** (2 / r), value)
    return [(a * bend(math.cos(2 * math.pi * k / n)), b * bend(math.sin(2 * math.pi * k / n))) for k in range(n)]


def h_beam(tw, hw, b, tf):
    x, w, y, t = b / 2, tw / 2, hw / 2, hw / 2 + tf
    return [(-x, -t), (x, -t), (x, -y), (w, -y), (w, y), (x, y), (x, t), (-x, t), (-x, y), (-w, y), (-w, -y), (-x, -y)]


def tee(tw, hw, b, tf):
    x, w = b / 2, tw / 2
    return [(-w, 0), (w, 0), (w, hw), (x, hw), (x, hw + tf), (-x, hw + tf), (-x, hw), (-w, hw)]


def box(b, h, tw, tf):
    x, y = b / 2, h / 2
    outer = [(-x, -y), (x, -y), (x, y), (-x, y)]
    return outer, [[(-x + tw, -y + tf), (x - tw, -y + tf), (x - tw, y - tf), (-x + tw, y - tf)]]


def kinds():
    """Torsion constant and shear areas (Poisson's ratio 0) of the section kinds."""
    out = []
    for b, h in [(1, 1), (1, 3), (3, 1), (10, 1)]:
        out.append(("rectangle", [b, h], [(0, 0), (b, 0), (b, h), (0, h)], [], min(b, h) ** 2 / 300))
    for d in [(8, 280, 150, 12), (10, 180, 200, 15), (20, 150, 180, 30)]:
        out.append(("h-beam", d, h_beam(*d), [], d[0] ** 2 / 6))
    for d in [(8, 150, 120, 12), (10, 60, 100, 10), (20, 200, 300, 40)]:
        out.append(("tee", d, tee(*d), [], d[0] ** 2 / 6))
    for d in [(100, 200, 6, 8), (150, 150, 10, 10), (200, 100, 5, 5), (100, 200, 20, 25)]:
        out.append(("box", d, *box(*d), d[2] ** 2 / 6))
    out.append(("circle", [100], ring(100), [], 15))
    for d, t in [(100, 5), (100, 25), (100, 40)]:
        out.append(("tube", [d, t], ring(d), [ring(d - 2 * t)], min(t * t / 4, 15)))
    for a, b, r in [(1, 2, 2), (1, 1, 1), (1, 1, 1.5), (1, 4, 4), (1, 1, 10)]:
        out.append(("superellipse", [a, b, r], superellipse(a, b, r), [], a * a / 200))
    found = []
    for kind, given, outer, holes, mesh in out:
        values = section(outer, holes, mesh, True)
        found.append({"kind": kind, "given": given, "torsion": values["torsion"], "shear_areas": values["shear_areas"]})
    return found


def validity():
    rng = np.random.default_rng(11)
    rings = [np.round(rng.uniform(-1, 1, (int(rng.integers(3, 8)), 2)), 1) for _ in range(120)]
    return [{"ring": ring.tolist(), "valid": bool(Polygon(ring).is_valid and Polygon(ring).area > 1e-12)} for ring in rings]


data = {"polygons": polygons(), "kinds": kinds(), "validity": validity()}
text = json.dumps(data, default=lambda a: np.asarray(a, dtype=float).tolist())
(HERE / "sections.json").write_text(text.replace("}, {", "},\n{") + "\n")

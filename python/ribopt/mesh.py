"""Rib meshes on arrays: what ``ribopt mesh`` does with files (docs/meshes.md).

In arrays vertices and faces are counted from 0; in reports and messages from 1, as OBJ files count them. Every function that cannot
take a mesh raises :class:`ribopt.MeshError` with its defects.

>>> import ribopt.mesh as mesh
>>> shell = mesh.new("vault")
>>> mesh.check(shell)["sound"]
True
>>> lines, report = mesh.trace(shell)
>>> report["lines"], len(lines)
(28, 28)
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from os import PathLike
from typing import Any, Literal, TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from . import _native
from ._arrays import FloatArray, IntArray, integers, of_bytes

#: How edges are joined to lines: quads by topology and others by straightest continuation (auto), or one of these; edges: a line each.
Rule: TypeAlias = Literal["auto", "topology", "straight", "given", "edges"]

#: A report, as ``ribopt mesh … --json`` prints it.
Report: TypeAlias = dict[str, Any]


@dataclass(frozen=True, eq=False)
class Mesh:
    """Points and polygons, and the edges that carry ribs where not all do."""

    #: V × 3
    vertices: FloatArray
    #: Vertices of all faces, one face after the other.
    corners: IntArray
    #: Number of corners of each face.
    sizes: IntArray
    #: Edges flagged as ribs, E × 2; none flagged: all edges carry ribs.
    edges: IntArray

    @classmethod
    def of(cls, vertices: ArrayLike, faces: ArrayLike | Sequence[Sequence[int]] = (), edges: ArrayLike = ()) -> Mesh:
        """Of points (V × 3), faces (F × k, or a list of lists of different lengths) and edges that carry ribs (E × 2)."""
        lists = [np.asarray(face, dtype=np.int64) for face in faces]  # type: ignore[union-attr]
        return cls(
            np.ascontiguousarray(vertices, dtype=np.float64).reshape(-1, 3),
            np.concatenate(lists) if lists else np.empty(0, dtype=np.int64),
            np.array([len(one) for one in lists], dtype=np.int64),
            np.ascontiguousarray(edges, dtype=np.int64).reshape(-1, 2),
        )

    @property
    def faces(self) -> list[IntArray]:
        """The vertices of each face."""
        return np.split(self.corners, np.cumsum(self.sizes)[:-1]) if len(self.sizes) > 0 else []

    @property
    def quads(self) -> IntArray:
        """F × 4, where all faces have four corners."""
        if np.any(self.sizes != 4):
            raise ValueError("not all faces are quads")
        return self.corners.reshape(-1, 4)

    @classmethod
    def _of(cls, parts: tuple[bytes, bytes, bytes, bytes]) -> Mesh:
        vertices, corners, sizes, edges = parts
        return cls(of_bytes(vertices).reshape(-1, 3), integers(corners), integers(sizes), integers(edges).reshape(-1, 2))

    def _parts(self) -> tuple[FloatArray, IntArray, IntArray, IntArray]:
        vertices = np.ascontiguousarray(self.vertices, dtype=np.float64).reshape(-1)
        return vertices, _integers(self.corners), _integers(self.sizes), _integers(self.edges)


@dataclass(frozen=True, eq=False)
class Lines(Sequence[IntArray]):
    """Rib lines: each the vertices it runs through; a closed line repeats its first at the end."""

    vertices: tuple[IntArray, ...]
    closed: tuple[bool, ...]

    def __getitem__(self, at: Any) -> Any:
        return self.vertices[at]

    def __iter__(self) -> Iterator[IntArray]:
        return iter(self.vertices)

    def __len__(self) -> int:
        return len(self.vertices)


@dataclass(frozen=True, eq=False)
class Stations:
    """Stations along a rib line."""

    name: str
    closed: bool
    #: The mesh vertex at each station, −1 between vertices.
    vertices: IntArray
    #: Arc length from the line's beginning.
    s: FloatArray
    #: S × 3
    positions: FloatArray
    #: S × 3 × 3: the rows of each are the axes x (along the line), y (across it, in the surface), z (out of the surface).
    frames: FloatArray


@dataclass(frozen=True, eq=False)
class Piece:
    """A connected piece of a plane section, in the plane's coordinates."""

    #: The outline, anticlockwise, N × 2.
    outer: FloatArray
    #: Holes, clockwise.
    holes: tuple[FloatArray, ...]
    #: Area, centroid, second moments about it, principal ones and their angle.
    properties: dict[str, Any]


def read(path: str | PathLike[str]) -> Mesh:
    """A mesh or lines from a file: .obj, .ply, .off, .stl, .csv, .dxf."""
    return Mesh._of(_native.mesh_read(path))


def write(mesh: Mesh, path: str | PathLike[str]) -> None:
    """Writes a mesh as .obj, .stl or .vtu."""
    _native.mesh_write(mesh._parts(), path)


def new(name: str) -> Mesh:
    """One of the meshes made by formula: grid, cube, small-vault, vault, dome, shell."""
    return Mesh._of(_native.mesh_new(name))


def check(mesh: Mesh, *, rule: Rule = "auto") -> Report:
    """Counts, measures, and every defect; defects are the finding here, no error."""
    report: Report = json.loads(_native.mesh_check(mesh._parts(), rule))
    return report


def weld(mesh: Mesh, tolerance: float) -> tuple[Mesh, Report]:
    """Joins vertices within the tolerance."""
    parts, report = _native.mesh_weld(mesh._parts(), tolerance)
    return Mesh._of(parts), json.loads(report)


def reconstruct(
    mesh: Mesh, original: Mesh, *, tolerance: float | None = None, fill: bool = True, snap: bool = True
) -> tuple[Mesh, Report]:
    """Fills concave notches and holes of a quad mesh with quads and snaps it to the original surface."""
    parts, report = _native.mesh_reconstruct(mesh._parts(), original._parts(), tolerance, fill, snap)
    return Mesh._of(parts), json.loads(report)


def smooth(
    mesh: Mesh,
    *,
    method: Literal["laplacian", "gauss-seidel", "taubin"] = "laplacian",
    relaxation: float = 0.5,
    mu: float | None = None,
    iterations: int = 10,
    slide: bool = False,
    features: float | None = None,
    project: Mesh | None = None,
) -> tuple[Mesh, Report]:
    """Smooths a quad mesh. The options are those of ``ribopt mesh smooth``; ``features`` is an angle in degrees."""
    surface = None if project is None else project._parts()
    parts, report = _native.mesh_smooth(mesh._parts(), method, relaxation, mu, iterations, slide, features, surface)
    return Mesh._of(parts), json.loads(report)


def trace(mesh: Mesh, *, rule: Rule = "auto") -> tuple[Lines, Report]:
    """The rib lines."""
    sizes, vertices, closed, report = _native.mesh_trace(mesh._parts(), rule)
    return Lines(_cut(integers(vertices), integers(sizes)), tuple(closed)), json.loads(report)


def slice(mesh: Mesh, segments: float, *, rule: Rule = "auto") -> tuple[tuple[Stations, ...], Report]:
    """Stations along the rib lines, no farther apart than ``segments``, with frames."""
    lines, report = _native.mesh_slice(mesh._parts(), rule, segments)
    return tuple(map(_stations, lines)), json.loads(report)


def _stations(line: tuple[str, bool, bytes, bytes]) -> Stations:
    name, closed, vertices, numbers = line
    table = of_bytes(numbers).reshape(-1, 13)
    return Stations(name, closed, integers(vertices), table[:, 0], table[:, 1:4], table[:, 4:].reshape(-1, 3, 3))


def section(solid: Mesh, origin: ArrayLike, normal: ArrayLike) -> tuple[tuple[Piece, ...], Report]:
    """The section of a closed mesh with the plane through ``origin`` with this normal."""
    points = [np.ascontiguousarray(point, dtype=np.float64).reshape(3) for point in (origin, normal)]
    pieces, report = _native.mesh_section(solid._parts(), points[0], points[1])
    read = json.loads(report)
    rings = ([of_bytes(ring).reshape(-1, 2) for ring in piece] for piece in pieces)
    found = zip(rings, read["pieces"], strict=True)
    return tuple(Piece(ring[0], tuple(ring[1:]), properties) for ring, properties in found), read


def closest(mesh: Mesh, points: ArrayLike) -> FloatArray:
    """The nearest points of the faces, P × 3."""
    return of_bytes(_native.mesh_closest(mesh._parts(), np.ascontiguousarray(points, dtype=np.float64).reshape(-1))).reshape(-1, 3)


def hausdorff(first: Mesh, second: Mesh) -> Report:
    """How far two surfaces lie apart, from samples: ``from_first``, ``from_second``, and the larger of the two as ``distance``."""
    report: Report = json.loads(_native.mesh_hausdorff(first._parts(), second._parts()))
    return report


def _integers(numbers: IntArray) -> IntArray:
    return np.ascontiguousarray(numbers, dtype=np.int64).reshape(-1)


def _cut(numbers: IntArray, sizes: IntArray) -> tuple[IntArray, ...]:
    return tuple(np.split(numbers, np.cumsum(sizes)[:-1])) if len(sizes) > 0 else ()

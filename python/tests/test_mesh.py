"""The stages of `ribopt mesh` on arrays."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import ribopt
from ribopt import mesh


def grid() -> mesh.Mesh:
    """Two by two unit squares."""
    vertices = [[x, y, 0] for y in range(3) for x in range(3)]
    return mesh.Mesh.of(vertices, [[v, v + 1, v + 4, v + 3] for v in (0, 1, 3, 4)])


def test_arrays_come_back_as_they_went(tmp_path: Path) -> None:
    shell = mesh.new("shell")
    mesh.write(shell, tmp_path / "shell.obj")
    again = mesh.read(tmp_path / "shell.obj")
    assert np.array_equal(again.vertices, shell.vertices) and np.array_equal(again.quads, shell.quads)
    assert all(np.array_equal(a, b) for a, b in zip(shell.faces, shell.quads, strict=True))
    mixed = mesh.Mesh.of(np.zeros((5, 3)), [[0, 1, 2], [0, 1, 2, 3]])
    assert [len(face) for face in mixed.faces] == [3, 4]
    with pytest.raises(ValueError, match="not all faces are quads"):
        _ = mixed.quads
    with pytest.raises(ValueError, match="read-only"):
        shell.vertices[0, 0] = 1.0


@pytest.mark.parametrize("name", ["grid", "cube", "small-vault", "vault", "dome", "shell"])
def test_reports_are_the_command_lines(name: str, tmp_path: Path) -> None:
    file, made = tmp_path / f"{name}.obj", mesh.new(name)
    mesh.write(made, file)

    def printed(*arguments: str) -> dict:
        command = [sys.executable, "-m", "ribopt", "mesh", *arguments, "--json"]
        return json.loads(subprocess.run(command, capture_output=True, text=True, check=True).stdout)

    assert mesh.check(made) == {**printed("check", str(file)), "file": "the mesh"}
    lines, report = mesh.trace(made)
    assert report == printed("trace", str(file), "-o", str(tmp_path / "lines.csv"))
    assert len(lines) == report["lines"] and sum(lines.closed) == report["closed"]
    stations, report = mesh.slice(made, 0.7)
    assert report == printed("slice", str(file), "--segments", "0.7", "-o", str(tmp_path / "stations.csv"))
    smoother, report = mesh.smooth(made, iterations=3, slide=True)
    staged = printed("smooth", str(file), "--iterations", "3", "--slide", "-o", str(tmp_path / "smoother.obj"))
    assert report == staged["stage"]
    assert np.array_equal(smoother.vertices, mesh.read(tmp_path / "smoother.obj").vertices)


def test_lines_and_stations_of_a_grid() -> None:
    lines, _ = mesh.trace(grid())
    assert sorted(map(tuple, lines)) == [(0, 1, 2), (0, 3, 6), (1, 4, 7), (2, 5, 8), (3, 4, 5), (6, 7, 8)]
    stations, report = mesh.slice(grid(), 0.5)
    assert report["stations"] == 30 and all(len(line.s) == 5 for line in stations)
    for line in stations:
        assert np.allclose(line.s, [0, 0.5, 1, 1.5, 2]) and list(line.vertices[1::2]) == [-1, -1]
        assert np.allclose(line.frames @ line.frames.transpose(0, 2, 1), np.eye(3))
        along = np.diff(line.positions, axis=0) / 0.5
        assert np.allclose(line.frames[:-1, 0], along) and np.allclose(line.frames[:, 2], [0, 0, 1])


def test_flagged_edges_alone_are_traced() -> None:
    flagged = mesh.Mesh.of(grid().vertices, grid().quads, [[3, 4], [4, 5]])
    lines, report = mesh.trace(flagged)
    assert report["flagged_only"] and [list(line) for line in lines] == [[3, 4, 5]]


def test_a_notch_is_filled_and_distances_are_measured() -> None:
    whole = grid()
    notched = mesh.Mesh.of(whole.vertices[:8], whole.quads[:3])
    filled, report = mesh.reconstruct(notched, whole)
    assert report["faces_added"] == 1 and np.array_equal(filled.vertices[-1], [2, 2, 0])
    assert mesh.hausdorff(filled, whole)["distance"] == 0.0
    assert mesh.hausdorff(notched, whole)["distance"] == pytest.approx(np.sqrt(0.5), abs=0.5)
    near = mesh.closest(whole, [[0.3, 0.4, 5.0], [7.0, 1.0, 0.0]])
    assert np.allclose(near, [[0.3, 0.4, 0.0], [2.0, 1.0, 0.0]])


def test_sections_of_a_cube() -> None:
    cube = mesh.new("cube")
    low, high = cube.vertices.min(axis=0), cube.vertices.max(axis=0)
    side, middle = high[0] - low[0], (low + high) / 2 + [0, 0, 0.01]
    pieces, report = mesh.section(cube, middle, [0, 0, 1])
    assert len(pieces) == 1 and report["area"] == pytest.approx(side**2)
    assert pieces[0].properties["ix"] == pytest.approx(side**4 / 12) and not pieces[0].holes
    assert np.ptp(pieces[0].outer, axis=0) == pytest.approx([side, side])


def test_duplicates_are_welded() -> None:
    doubled = mesh.Mesh.of(np.vstack([grid().vertices, [[1, 0, 1e-9]]]), [[0, 1, 4, 3], [9, 2, 5, 4]])
    assert not mesh.check(doubled)["sound"]
    welded, report = mesh.weld(doubled, 1e-6)
    assert report["joined"] == 1 and mesh.check(welded)["sound"]
    with pytest.raises(ribopt.MeshError, match="weld tolerance"):
        mesh.weld(doubled, -1.0)


def test_what_no_stage_can_take() -> None:
    folded = mesh.Mesh.of(grid().vertices, [[0, 1, 4, 3], [1, 2, 5, 4], [0, 1, 2, 5]])
    with pytest.raises(ribopt.MeshError) as caught:
        mesh.smooth(folded)
    assert {defect["kind"] for defect in caught.value.defects} and all(defect["faces"] for defect in caught.value.defects)
    with pytest.raises(ValueError, match="no vertex 9: the mesh has 9, counted from 0"):
        mesh.check(mesh.Mesh.of(grid().vertices, [[0, 1, 9]]))
    with pytest.raises(ValueError, match="no vertex -1"):
        mesh.check(mesh.Mesh.of(grid().vertices, [[0, 1, -1]]))
    with pytest.raises(ValueError, match="three corners"):
        mesh.check(mesh.Mesh.of(grid().vertices, [[0, 1]]))
    with pytest.raises(ValueError, match="at most"):
        mesh.check(mesh.Mesh.of([[np.nan, 0, 0]]))
    with pytest.raises(ribopt.MeshError, match="there is no mesh 'tube'"):
        mesh.new("tube")
    with pytest.raises(ribopt.MeshError, match="cannot tell the format"):
        mesh.read("shell.xyz")
    with pytest.raises(ribopt.MeshError, match="relaxation"):
        mesh.smooth(grid(), relaxation=2.0)

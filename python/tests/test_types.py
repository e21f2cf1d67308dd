"""The types hold: of the package itself, and of a program that uses it."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

pytest.importorskip("mypy")

PROGRAM = """
import ribopt
problem: ribopt.Problem = ribopt.from_dict({"minimize": "x", "variables": {"x": {"lower": 1.0}}})
result: ribopt.Result = problem.solve(max_seconds=3.0, on_iteration=lambda iteration: print(iteration.objective))
width: float = result["x"]
total: float = problem.model.objective(result.x)
reveal_type(result.variables.multipliers)
width = result.status
problem.solve(max_secnds=3)
"""


def mypy(*arguments: str, cwd: Path) -> tuple[int, str]:
    done = subprocess.run([sys.executable, "-m", "mypy", *arguments], cwd=cwd, capture_output=True, text=True)
    return done.returncode, done.stdout + done.stderr


def test_the_package_is_typed_throughout() -> None:
    assert mypy("ribopt", cwd=Path(__file__).parents[1])[0] == 0


def test_the_stubs_say_what_the_native_half_has() -> None:
    command = [sys.executable, "-m", "mypy.stubtest", "ribopt._native", "--ignore-disjoint-bases"]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr


def test_a_program_is_checked_against_the_installed_package(tmp_path: Path) -> None:
    (tmp_path / "program.py").write_text(PROGRAM)
    code, told = mypy("--strict", "program.py", cwd=tmp_path)
    assert code == 1 and "Found 2 errors" in told, told
    assert 'program.py:8: error: Incompatible types in assignment (expression has type "str"' in told
    assert 'program.py:9: error: Unexpected keyword argument "max_secnds"' in told
    assert "float64" in told

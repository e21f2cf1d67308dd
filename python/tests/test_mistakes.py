"""Mistakes are data."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import ribopt
from conftest import PROBLEMS
from ribopt import InputError, Mistake


def test_every_mistake_has_its_place_and_a_remedy() -> None:
    text = 'minimize = "b*hh"\n[variables]\nb = { lowr = 0.1, upper = 1 }\nh = { lower = 2, upper = 1 }\n'
    with pytest.raises(InputError) as caught:
        ribopt.loads(text, name="rib.toml")
    first, *others = caught.value.mistakes
    assert first == Mistake("unknown name `hh`", first.help, "rib.toml", 1, 15, "unknown-name")
    assert "did you mean `h`?" in first.help
    assert ("rib.toml", 3, 7, "unknown-key") in [(one.file, one.line, one.column, one.code) for one in others]
    assert "rib.toml:3:7" in str(caught.value) and "^^^^" in str(caught.value)
    assert all(one.code is None or ribopt.explain(one.code) for one in caught.value.mistakes)


def test_files_changes_and_tables_that_are_wrong(rib: str, tmp_path: Path) -> None:
    with pytest.raises(InputError, match="there is no such file") as caught:
        ribopt.load(tmp_path / "none.toml")
    assert caught.value.mistakes[0].code == "file" and isinstance(caught.value, ValueError)
    with pytest.raises(InputError) as caught:
        ribopt.loads(rib, set={"MM": 3})
    assert caught.value.mistakes[0].file == "--set" and caught.value.mistakes[0].code == "set"
    with pytest.raises(InputError, match=r"sections\.csv"):
        ribopt.loads('[tables]\nsections = "sections.csv"\n', folder=tmp_path)
    with pytest.raises(KeyError, match="unknown-kay"):
        ribopt.explain("unknown-kay")


def test_what_cannot_be_asked_of_a_run(rib: str, tmp_path: Path) -> None:
    problem = ribopt.loads(rib)
    for wrong in (
        {"backends": ["simplex"]},
        {"algorithm": "magic"},
        {"start": tmp_path / "none.json"},
        {"start": {"left.b": np.nan}},
        {"optimality_tolerance": 2.0},
        {"constraint_tolerance": 0.0},
        {"max_seconds": -1.0},
        {"max_iterations": 0},
        {"starts": 0},
    ):
        with pytest.raises(InputError) as caught:
            problem.solve(**wrong)
        assert caught.value.mistakes and caught.value.mistakes[0].file is None, wrong
    (tmp_path / "file").write_text("in the way")
    with pytest.raises(InputError, match="cannot write"):
        problem.solve(out=tmp_path / "file" / "out")


def test_answers_to_another_problem(rib: str) -> None:
    problem = ribopt.loads(rib)
    with pytest.raises(InputError, match="no value for right.h"):
        problem.verify({"left.b": 0.2, "left.h": 0.4})
    with pytest.raises(InputError, match="which the problem does not have"):
        problem.verify({"left.b": 0.2, "left.h": 0.4, "right.h": 0.4, "depth": 1.0})
    with pytest.raises(InputError, match="has no value"):
        problem.verify({"left.b": 0.2, "left.h": 0.4, "right.h": np.inf})


def test_a_point_without_a_value() -> None:
    model = ribopt.loads('minimize = "sqrt(x - 1)"\n[variables]\nx = { lower = 0, upper = 4, start = 3 }\n').model
    with pytest.raises(ribopt.EvaluationError, match="square root") as caught:
        model.objective([0.5])
    assert caught.value.cause.startswith("square root of -0.5") and isinstance(caught.value, ArithmeticError)
    with pytest.raises(ValueError, match="x has 2 numbers, and must have 1"):
        model.objective([1.0, 2.0])


def test_warnings_of_the_reader_are_kept() -> None:
    assert all(isinstance(text, str) for path in PROBLEMS.glob("*.toml") for text in ribopt.load(path).warnings)

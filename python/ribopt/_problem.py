"""Problems: read, solved, verified, analysed."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from os import PathLike, fspath
from typing import Any, TypeAlias

import numpy as np

from . import _html, _native, _toml
from ._analysis import Analysis
from ._arrays import FloatArray, of_bytes
from ._errors import Interrupted, UnwrittenError
from ._model import Model
from ._result import Result

StrPath: TypeAlias = str | PathLike[str]

#: A point: a result, values by name, an array in the order of the variables, or the path of a ``result.json`` or a CSV with the
#: columns name,value.
AnswerLike: TypeAlias = Result | Mapping[str, float] | FloatArray | Sequence[float] | StrPath

#: Changes to the file's numbers, as ``--set`` takes them: ``{"load": 3.0, "depth.upper": 0.4}`` or ``["load=3.0"]``.
Changes: TypeAlias = Mapping[str, float | str] | Sequence[str]


@dataclass(frozen=True, eq=False)
class Iteration:
    """One iteration of a backend, in the user's sense and variables."""

    backend: str
    algorithm: str
    iteration: int
    evaluations: int
    objective: float
    #: Largest relative violation of a row or bound.
    feasibility: float
    optimality: float
    step_norm: float
    x: FloatArray


class Problem:
    """A problem, checked and assembled. Made by :func:`load`, :func:`loads` and :func:`from_dict`; it never changes."""

    def __init__(self, native: _native.Problem, text: str | None = None) -> None:
        self._native = native
        #: The problem file's text, where it was not read from a file.
        self.text = text

    @property
    def title(self) -> str:
        """The title."""
        return self._native.title

    @property
    def file(self) -> str:
        """The file it was read from, or the name it was given."""
        return self._native.file

    @property
    def problem_class(self) -> str:
        """What is proved of it: linear, geometric program, convex, nonlinear."""
        return self._native.problem_class

    @property
    def sense(self) -> str:
        """minimize or maximize."""
        return "maximize" if self._native.sign < 0 else "minimize"

    @property
    def objective(self) -> str:
        """The objective as written."""
        return self._native.objective

    @property
    def units(self) -> dict[str, str]:
        """Units of the file's numbers."""
        return dict(self._native.units)

    @property
    def has_structure(self) -> bool:
        """Whether the ribs make up a structure."""
        return self._native.has_structure

    @property
    def warnings(self) -> tuple[str, ...]:
        """What the reader wants said."""
        return tuple(self._native.warnings)

    @cached_property
    def model(self) -> Model:
        """Values and exact derivatives in the problem's own variables, kinks and all."""
        return Model(self._native.model(False))

    @cached_property
    def restated_model(self) -> Model:
        """What ribopt itself solves: smooth, with auxiliary variables after the problem's own in the place of kinks (``max``,
        ``min``, ``abs``), and with the states of large structures, whose derivatives are sparse then. Otherwise the same as
        :attr:`model`."""
        return Model(self._native.model(True))

    def solve(
        self,
        *,
        backends: Sequence[str] = (),
        algorithm: str | None = None,
        start: AnswerLike | None = None,
        starts: int | None = None,
        out: StrPath | None = None,
        plot: bool = False,
        on_iteration: Callable[[Iteration], Any] | None = None,
        optimality_tolerance: float | None = None,
        step_tolerance: float | None = None,
        constraint_tolerance: float | None = None,
        max_iterations: int | None = None,
        max_evaluations: int | None = None,
        max_seconds: float | None = None,
    ) -> Result:
        """Solves with every backend (or these), certifies and compares the answers. What every option means is told by
        ``ribopt solve --help``.

        No files are left unless ``out`` names a folder. The interpreter's lock is released meanwhile, so that threads solve side by
        side. ``on_iteration`` is called from another thread; an exception it raises stops the run and comes out of here.

        Raises :class:`ribopt.InputError` where the run cannot begin, :class:`ribopt.Interrupted` (a ``KeyboardInterrupt`` with the
        result) at Ctrl-C, :class:`ribopt.UnwrittenError` (with the result) where files could not be written.
        """
        limits = _limits(
            optimality_tolerance=optimality_tolerance,
            step_tolerance=step_tolerance,
            constraint_tolerance=constraint_tolerance,
            max_iterations=max_iterations,
            max_evaluations=max_evaluations,
            max_seconds=max_seconds,
        )
        asked: _native.Asked = {
            "backends": list(backends),
            "algorithm": algorithm,
            "start": None if start is None else self._answer(start),
            "starts": starts,
            "out": out,
            "plot": plot,
            "limits": limits,
            "watch": None if on_iteration is None else _watching(on_iteration),
        }
        text, folder, unwritten, raised = self._native.solve(asked)
        result = Result.of_json(text, folder)
        if isinstance(raised, KeyboardInterrupt):
            raise Interrupted(result) from None
        if raised is not None:
            raise raised
        if unwritten is not None:
            raise UnwrittenError(unwritten, result)
        return result

    def verify(
        self,
        answer: AnswerLike,
        *,
        optimality_tolerance: float | None = None,
        constraint_tolerance: float | None = None,
    ) -> Result:
        """The certificate of a point found elsewhere, which must give every variable a value."""
        limits = _limits(optimality_tolerance=optimality_tolerance, constraint_tolerance=constraint_tolerance)
        return Result.of_json(self._native.verify(self._answer(answer), limits))

    def analyse(self, answer: AnswerLike | None = None, *, gradient: bool = False) -> Analysis:
        """What the structure does at an answer, or at the start; with the derivatives of the definitions, if asked.

        Raises :class:`ribopt.AnalysisError` for a mechanism, :class:`ribopt.EvaluationError` where there is no value.
        """
        text, remarks = self._native.analyse(None if answer is None else self._answer(answer), gradient)
        return Analysis.of_json(text, self.model.variable_names, remarks)

    def _answer(self, answer: AnswerLike) -> _native.Answer:
        if isinstance(answer, (str, PathLike)):
            return {"path": fspath(answer), "text": None}
        if isinstance(answer, Result):
            return {"path": None, "text": json.dumps(answer.raw)}
        if not isinstance(answer, Mapping):
            answer = self.model.named(np.asarray(answer, dtype=np.float64))
        # JSON has no NaN; the reader says which name has no value.
        values = {name: float(value) if math.isfinite(value) else None for name, value in answer.items()}
        return {"path": None, "text": json.dumps({"variables": values})}

    def __repr__(self) -> str:
        return f"<ribopt.Problem {self.title!r}: {self.problem_class}, {len(self.model.variable_names)} variables>"

    def _repr_html_(self) -> str:
        return _html.of_problem(self)


def _limits(
    *,
    optimality_tolerance: float | None = None,
    step_tolerance: float | None = None,
    constraint_tolerance: float | None = None,
    max_iterations: int | None = None,
    max_evaluations: int | None = None,
    max_seconds: float | None = None,
) -> _native.Limits:
    return {
        "optimality_tolerance": optimality_tolerance,
        "step_tolerance": step_tolerance,
        "constraint_tolerance": constraint_tolerance,
        "max_iterations": max_iterations,
        "max_evaluations": max_evaluations,
        "max_seconds": max_seconds,
    }


def _watching(function: Callable[[Iteration], Any]) -> Callable[[str, str, tuple[int, int], list[float], bytes], Any]:
    def called(backend: str, algorithm: str, counts: tuple[int, int], numbers: list[float], x: bytes) -> None:
        objective, feasibility, optimality, step_norm = numbers
        function(Iteration(backend, algorithm, *counts, objective, feasibility, optimality, step_norm, of_bytes(x)))

    return called


def _changes(changes: Changes | None) -> list[str]:
    if changes is None:
        return []
    if isinstance(changes, Mapping):
        return [f"{name}={value if isinstance(value, str) else repr(float(value))}" for name, value in changes.items()]
    return list(changes)


def load(file: StrPath, *, set: Changes | None = None) -> Problem:
    """Reads a problem file and its tables. Raises :class:`ribopt.InputError` with every mistake."""
    return Problem(_native.Problem.read(file, _changes(set)))


def loads(text: str, *, name: str = "problem.toml", folder: StrPath = "", set: Changes | None = None) -> Problem:
    """Reads a problem from the text of a problem file. ``name`` is what mistakes call it; tables it names are looked for in
    ``folder``. Raises :class:`ribopt.InputError` with every mistake."""
    return Problem(_native.Problem.of_text(name, text, folder, _changes(set)), text)


def from_dict(
    problem: Mapping[str, Any], *, name: str = "problem.toml", folder: StrPath = "", set: Changes | None = None
) -> Problem:
    """A problem put together in Python: what the problem file says (docs/problem-file.md), as dictionaries, lists, texts and numbers.
    Places of mistakes are those in :attr:`Problem.text`, which :class:`ribopt.InputError` shows."""
    return loads(_toml.written(problem), name=name, folder=folder, set=set)


def _problem(problem: Problem | StrPath) -> Problem:
    return problem if isinstance(problem, Problem) else load(problem)


def solve(problem: Problem | StrPath, **options: Any) -> Result:
    """Solves a problem or a problem file; the options are those of :meth:`Problem.solve`."""
    return _problem(problem).solve(**options)


def verify(problem: Problem | StrPath, answer: AnswerLike, **options: Any) -> Result:
    """The certificate of a point found elsewhere; see :meth:`Problem.verify`."""
    return _problem(problem).verify(answer, **options)


def analyse(problem: Problem | StrPath, answer: AnswerLike | None = None, *, gradient: bool = False) -> Analysis:
    """What a structure does; see :meth:`Problem.analyse`."""
    return _problem(problem).analyse(answer, gradient=gradient)

"""What goes wrong, as data."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from ._result import Result


@dataclass(frozen=True)
class Mistake:
    """One mistake of a problem file, its tables, or of what was asked for."""

    #: What is wrong.
    message: str
    #: What was expected, the nearest known name, the remedy.
    help: str | None = None
    #: The file it is in; None where it is in none.
    file: str | None = None
    #: Line, counted from 1; None where the file as a whole is meant.
    line: int | None = None
    #: Column, counted from 1 in characters.
    column: int | None = None
    #: What :func:`ribopt.explain` explains it by, where it is one of reading.
    code: str | None = None


class RiboptError(Exception):
    """Whatever ribopt cannot do."""


class InputError(RiboptError, ValueError):
    """A wrong problem, or a run that cannot begin. The message shows every mistake with its line and a caret under it."""

    #: Every mistake (the first hundred).
    mistakes: tuple[Mistake, ...]

    def __init__(self, message: str, mistakes: tuple[Mistake, ...] = ()) -> None:
        super().__init__(message)
        self.mistakes = mistakes


class EvaluationError(RiboptError, ArithmeticError):
    """A term has no value at a point."""

    #: The rib, row or objective term.
    term: str
    #: Why: ``square root of -0.2``, ``division by zero``, ``the value overflows``.
    cause: str

    def __init__(self, message: str, term: str = "", cause: str = "") -> None:
        super().__init__(message)
        self.term = term
        self.cause = cause


class AnalysisError(RiboptError):
    """A structure that cannot be analysed: a mechanism, or too large."""


class MeshError(RiboptError, ValueError):
    """A mesh that a stage cannot take, with its defects."""

    #: ``kind``, ``faces`` and ``vertices`` of each, counted from 1.
    defects: tuple[dict[str, Any], ...]

    def __init__(self, message: str, defects: tuple[dict[str, Any], ...] = ()) -> None:
        super().__init__(message)
        self.defects = defects


class StudyError(RiboptError):
    """A study that cannot go on: another study's folder, a problem changed meanwhile, a failure where it stops at failures."""


class UnwrittenError(RiboptError, OSError):
    """A run whose files could not be written; its result is here all the same."""

    result: Result

    def __init__(self, message: str, result: Result) -> None:
        super().__init__(message)
        self.result = result


class Interrupted(KeyboardInterrupt):
    """Ctrl-C ended a run; what it had found until then is here."""

    result: Result

    def __init__(self, result: Result) -> None:
        super().__init__(result.message)
        self.result = result


def made(name: str, message: str, details: str) -> Exception:
    """The exception of this name; the native half calls this."""
    data = json.loads(details)
    match name:
        case "InputError":
            return InputError(message, tuple(Mistake(**mistake) for mistake in data))
        case "EvaluationError":
            return EvaluationError(message, *data)
        case "MeshError":
            return MeshError(message, tuple(data))
        case "StudyError":
            return StudyError(message)
        case "AnalysisError":
            return AnalysisError(message)
    return RiboptError(message)

"""Studies: many runs of one problem (docs/studies.md)."""

from __future__ import annotations

import csv
import json
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

from . import _html, _native
from ._arrays import FloatArray, floats

if TYPE_CHECKING:
    import pandas as pd

#: Columns that hold words.
_WORDS = frozenset({"status", "scope", "governs", "start", "message"})


@dataclass(frozen=True, eq=False)
class Study:
    """The table of a study: a row per point, in the order of the points."""

    #: The problem's title.
    title: str
    #: The varied names.
    names: tuple[str, ...]
    #: Where table and pictures are.
    folder: Path
    #: How many points have which status.
    status: dict[str, int]
    #: By title: arrays of numbers, NaN where a point has none, and of words tuples.
    columns: dict[str, FloatArray | tuple[str, ...]] = field(repr=False)

    def __len__(self) -> int:
        return len(self.columns["point"])

    def __getitem__(self, title: str) -> FloatArray | tuple[str, ...]:
        return self.columns[title]

    def numbers(self, title: str) -> FloatArray:
        """A column of numbers: a varied name, ``objective``, ``volume``, a quantity, a variable, ``sensitivity:NAME``, …"""
        column = self.columns[title]
        if isinstance(column, tuple):
            raise TypeError(f"the column {title} holds words")
        return column

    def to_pandas(self) -> pd.DataFrame:
        """A row per point, indexed by its number."""
        import pandas as pd

        return pd.DataFrame(self.columns).set_index("point")

    def _repr_html_(self) -> str:
        return _html.of_study(self)


def _read(table: Path) -> dict[str, FloatArray | tuple[str, ...]]:
    with table.open(newline="", encoding="utf-8") as file:
        titles, *rows = csv.reader(file)
    columns = zip(*rows, strict=True) if rows else ((),) * len(titles)
    return {
        title: cells if title in _WORDS else floats(float(cell) if cell else None for cell in cells)
        for title, cells in zip(titles, columns, strict=True)
    }


def sweep(
    study: str | PathLike[str],
    *,
    out: str | PathLike[str] | None = None,
    jobs: int = 0,
    fresh: bool = False,
    retry: Sequence[str] = (),
    on_progress: Callable[[int, int], Any] | None = None,
) -> Study:
    """Works on a study file, on all cores (or ``jobs`` of them), and reads its table. What is finished in its folder already is not
    done again; ``fresh`` forgets it, ``retry`` forgets points of such a status. ``on_progress`` is called with how many chains are
    done, of how many, from another thread. Clusters are the command line's business: ``ribopt sweep --slurm``.

    At Ctrl-C finished chains stay, and the same call goes on from there. Raises :class:`ribopt.InputError` for a wrong study or
    problem, :class:`ribopt.StudyError` where it cannot go on.
    """
    asked: _native.Swept = {
        "study": study,
        "out": out,
        "jobs": jobs,
        "fresh": fresh,
        "retry": list(retry),
        "watch": on_progress,
    }
    table, text, raised = _native.sweep(asked)
    if raised is not None:
        raise raised
    summary = json.loads(text)
    place = Path(table)
    return Study(summary["title"], tuple(summary["names"]), place.parent, dict(summary["status"]), _read(place))

"""What notebooks show."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from html import escape
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ._problem import Problem
    from ._result import Result
    from ._study import Study

#: Lines of a table; data frames have all.
MOST = 30


def _number(value: float | None) -> str:
    return "" if value is None or value != value else f"{value:.6g}"


def _table(header: Sequence[str], rows: Iterable[Sequence[str]], count: int) -> str:
    head = "".join(f"<th>{escape(title)}</th>" for title in header)
    lines = "".join("<tr>" + "".join(f"<td>{escape(cell)}</td>" for cell in row) + "</tr>" for row in rows)
    more = f"<p>… and {count - MOST} more</p>" if count > MOST else ""
    return f"<table><thead><tr>{head}</tr></thead><tbody>{lines}</tbody></table>{more}"


def of_result(result: Result) -> str:
    """Verdict, objective, variables, rows that hold."""
    variables, rows = result.variables, result.constraints
    values = zip(variables.names[:MOST], variables.values, variables.units, variables.active)  # noqa: B905
    holding = [at for at, active in enumerate(rows.active) if active != "none"]
    held = [
        (rows.names[at], _number(rows.values[at]), rows.active[at], _number(rows.sensitivities[at])) for at in holding[:MOST]
    ]
    parts = [
        f"<h4>{escape(result.title)}</h4>",
        f"<p><b>{escape(result.status)}</b> ({escape(result.scope)}): {escape(result.message)}</p>",
        f"<p>{escape(result.remedy)}</p>" if result.remedy else "",
        f"<p>objective {_number(result.objective)}</p>" if result.objective is not None else "",
        _table(
            ("variable", "value", "unit", "active bound"),
            ((name, _number(value), unit or "", active) for name, value, unit, active in values),
            len(variables),
        ),
        _table(("active constraint", "value", "side", "sensitivity"), held, len(holding)) if held else "",
    ]
    return "".join(parts)


def of_problem(problem: Problem) -> str:
    """Title, class, sizes, variables with their bounds."""
    model = problem.model
    rows = zip(model.variable_names[:MOST], model.lower, model.start, model.upper)  # noqa: B905
    counts = f"{len(model.variable_names)} variables, {len(model.row_names)} constraint rows"
    return (
        f"<h4>{escape(problem.title)}</h4><p>{escape(problem.sense)} {escape(problem.objective)}: "
        f"{escape(problem.problem_class)}, {counts}</p>"
        + _table(
            ("variable", "lower", "start", "upper"),
            ((name, *map(_number, numbers)) for name, *numbers in rows),
            len(model.variable_names),
        )
    )


def of_study(study: Study) -> str:
    """What varied, status and objective of the first points."""
    titles = ["point", *study.names, "status", "objective"]
    cells = [
        column[:MOST] if isinstance(column, tuple) else [_number(value) for value in column[:MOST]]
        for column in (study.columns[title] for title in titles if title in study.columns)
    ]
    titles = [title for title in titles if title in study.columns]
    counts = ", ".join(f"{count} {status}" for status, count in study.status.items())
    return f"<h4>{escape(study.title)}</h4><p>{escape(counts)}</p>" + _table(titles, zip(*cells, strict=True), len(study))

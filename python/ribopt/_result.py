"""What a run found: the parts of ``result.json`` (docs/outputs.md), with arrays and names."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cached_property
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _html
from ._arrays import FloatArray, data_frame, floats

if TYPE_CHECKING:
    import pandas as pd


@dataclass(frozen=True, eq=False)
class Variables:
    """The variables at the reported point; all columns in the order of ``names``."""

    names: tuple[str, ...]
    values: FloatArray
    #: Of the values, where it follows from the file.
    units: tuple[str | None, ...]
    #: Which bound holds: lower, upper, equal, none.
    active: tuple[str, ...]
    #: Multipliers of the bounds.
    multipliers: FloatArray
    #: d(objective)/d(bound).
    sensitivities: FloatArray

    @classmethod
    def _of(cls, raw: dict[str, Any]) -> Variables:
        bounds = raw["bounds"]
        return cls(
            names=tuple(raw["variables"]),
            values=floats(raw["variables"].values()),
            units=tuple(bound.get("unit") for bound in bounds),
            active=tuple(bound["active"] for bound in bounds),
            multipliers=floats(bound["multiplier"] for bound in bounds),
            sensitivities=floats(bound["sensitivity"] for bound in bounds),
        )

    @cached_property
    def _places(self) -> dict[str, int]:
        return {name: at for at, name in enumerate(self.names)}

    def __getitem__(self, name: str) -> float:
        return float(self.values[self._places[name]])

    def __iter__(self) -> Iterator[str]:
        return iter(self.names)

    def __len__(self) -> int:
        return len(self.names)

    def to_dict(self) -> dict[str, float]:
        """Values by name."""
        return dict(zip(self.names, self.values.tolist(), strict=True))

    def to_pandas(self) -> pd.DataFrame:
        """A row per variable."""
        columns = {
            "value": self.values,
            "unit": self.units,
            "active": self.active,
            "multiplier": self.multipliers,
            "sensitivity": self.sensitivities,
        }
        return data_frame(columns, self.names, "variable")


@dataclass(frozen=True, eq=False)
class Constraints:
    """The rows at the reported point; all columns in the order of ``names``."""

    names: tuple[str, ...]
    values: FloatArray
    #: −inf where open.
    lower: FloatArray
    #: inf where open.
    upper: FloatArray
    units: tuple[str | None, ...]
    #: Which limit holds: lower, upper, equal, none.
    active: tuple[str, ...]
    multipliers: FloatArray
    #: d(objective)/d(limit).
    sensitivities: FloatArray
    #: Load case, where a row looks at a structure in one.
    cases: tuple[str | None, ...]
    #: Station along the rib, as a part of its length; NaN where there is none.
    stations: FloatArray
    #: Point of the section.
    points: tuple[str | None, ...]

    @classmethod
    def _of(cls, raw: dict[str, Any]) -> Constraints:
        rows = raw["constraints"]
        return cls(
            names=tuple(row["name"] for row in rows),
            values=floats(row["value"] for row in rows),
            lower=floats((row["lower"] for row in rows), -np.inf),
            upper=floats((row["upper"] for row in rows), np.inf),
            units=tuple(row.get("unit") for row in rows),
            active=tuple(row["active"] for row in rows),
            multipliers=floats(row["multiplier"] for row in rows),
            sensitivities=floats(row["sensitivity"] for row in rows),
            cases=tuple(row.get("case") for row in rows),
            stations=floats(row.get("station") for row in rows),
            points=tuple(row.get("point") for row in rows),
        )

    @cached_property
    def _places(self) -> dict[str, int]:
        return {name: at for at, name in enumerate(self.names)}

    def __getitem__(self, name: str) -> float:
        return float(self.values[self._places[name]])

    def __iter__(self) -> Iterator[str]:
        return iter(self.names)

    def __len__(self) -> int:
        return len(self.names)

    def to_pandas(self) -> pd.DataFrame:
        """A row per constraint row."""
        columns = {
            "value": self.values,
            "lower": self.lower,
            "upper": self.upper,
            "unit": self.units,
            "active": self.active,
            "multiplier": self.multipliers,
            "sensitivity": self.sensitivities,
            "case": self.cases,
            "station": self.stations,
            "point": self.points,
        }
        return data_frame(columns, self.names, "constraint")


@dataclass(frozen=True, eq=False)
class RibUses:
    """What uses every rib of a structure most; 1 where a limit is met exactly."""

    names: tuple[str, ...]
    #: NaN where no limit speaks of the rib.
    utilisation: FloatArray
    governs: tuple[str | None, ...]
    cases: tuple[str | None, ...]
    stations: FloatArray
    points: tuple[str | None, ...]

    @classmethod
    def _of(cls, ribs: list[dict[str, Any]]) -> RibUses:
        return cls(
            names=tuple(rib["rib"] for rib in ribs),
            utilisation=floats(rib["utilisation"] for rib in ribs),
            governs=tuple(rib["governs"] for rib in ribs),
            cases=tuple(rib.get("case") for rib in ribs),
            stations=floats(rib.get("station") for rib in ribs),
            points=tuple(rib.get("point") for rib in ribs),
        )

    def to_pandas(self) -> pd.DataFrame:
        """A row per rib."""
        columns = {
            "utilisation": self.utilisation,
            "governs": self.governs,
            "case": self.cases,
            "station": self.stations,
            "point": self.points,
        }
        return data_frame(columns, self.names, "rib")


@dataclass(frozen=True)
class Volumes:
    """Volume of all ribs: each by its own law, all as frusta, all as prismatoids."""

    total: float
    frustum: float
    prismatoid: float


@dataclass(frozen=True)
class Certificate:
    """What the certificate measured at a backend's point (docs/certificate.md)."""

    certified: bool
    scope: str
    primal_infeasibility: float | None
    dual_infeasibility: float | None
    complementarity: float | None
    negative_curvature: float | None
    messages: tuple[str, ...]


@dataclass(frozen=True)
class Solution:
    """What one backend brought back."""

    backend: str
    attempt: int
    algorithm: str
    #: converged, limit-reached, interrupted, failed, refused
    termination: str
    message: str
    objective: float | None
    iterations: int | None
    evaluations: int
    seconds: float
    certificate: Certificate | None
    remarks: tuple[str, ...]

    @classmethod
    def _of(cls, raw: dict[str, Any]) -> Solution:
        certificate = raw["certificate"]
        if certificate is not None:
            certificate = Certificate(**{**certificate, "messages": tuple(certificate["messages"])})
        return cls(**{**raw, "certificate": certificate, "remarks": tuple(raw["remarks"])})


@dataclass(frozen=True)
class Agreement:
    """Whether the backends agree."""

    agree: bool
    #: Absolute.
    objective_difference: float
    #: Relative.
    variable_difference: float


@dataclass(frozen=True, eq=False)
class Minimum:
    """One of several minima that starts led to."""

    objective: float
    count: int
    names: tuple[str, ...]
    values: FloatArray

    @classmethod
    def _of(cls, raw: dict[str, Any]) -> Minimum:
        variables = raw["variables"]
        return cls(raw["objective"], raw["count"], tuple(variables), floats(variables.values()))


@dataclass(frozen=True, eq=False)
class Result:
    """A verdict and the point it is of."""

    #: The whole ``result.json``, as docs/outputs.md describes it.
    raw: dict[str, Any] = field(repr=False)
    #: certified, uncertified, infeasible, unbounded, not-attained, limit-reached, interrupted, invalid-value
    status: str
    #: global where the class proves it, else local
    scope: str
    #: The verdict in sentences.
    message: str
    #: What to do about it.
    remedy: str | None
    #: In the user's sense.
    objective: float | None
    #: A proved bound of the objective on the other side.
    lower_bound: float | None
    volume: Volumes | None
    mass: float | None
    #: Rows of catalogues by section.
    chosen: dict[str, str]
    variables: Variables = field(repr=False)
    constraints: Constraints = field(repr=False)
    #: Of structures.
    ribs: RibUses | None = field(repr=False)
    solutions: tuple[Solution, ...] = field(repr=False)
    agreement: Agreement | None = field(repr=False)
    #: Of an infeasible problem: what is violated, what conflicts, what would help.
    conflict: dict[str, Any] | None = field(repr=False)
    #: Of an unbounded problem: the way on which the objective falls for ever, by variable.
    direction: dict[str, float] | None = field(repr=False)
    minima: tuple[Minimum, ...] = field(repr=False)
    warnings: tuple[str, ...] = field(repr=False)
    #: Where files were left, if any.
    folder: Path | None = field(default=None, repr=False)

    @classmethod
    def of_json(cls, text: str, folder: str | PathLike[str] | None = None) -> Result:
        """The result of a ``result.json``, or of what ``--json`` prints."""
        raw = json.loads(text)
        if raw.get("format") != "ribopt-result/1" or "variables" not in raw:
            raise ValueError("this is no result of the format ribopt-result/1")
        return cls(
            raw=raw,
            **{key: raw[key] for key in ("status", "scope", "message", "remedy", "objective", "lower_bound", "mass")},
            volume=Volumes(**raw["volume"]) if raw["volume"] else None,
            chosen=raw.get("chosen", {}),
            variables=Variables._of(raw),
            constraints=Constraints._of(raw),
            ribs=RibUses._of(raw["ribs"]) if "ribs" in raw else None,
            solutions=tuple(map(Solution._of, raw["solutions"])),
            agreement=Agreement(**raw["agreement"]) if raw["agreement"] else None,
            conflict=raw["conflict"],
            direction=raw["direction"],
            minima=tuple(map(Minimum._of, raw["minima"])),
            warnings=tuple(raw["warnings"]),
            folder=Path(folder) if folder is not None else None,
        )

    @classmethod
    def read(cls, path: str | PathLike[str]) -> Result:
        """The result of a run's folder, or of its ``result.json``."""
        path = Path(path)
        file = path / "result.json" if path.is_dir() else path
        return cls.of_json(file.read_text(encoding="utf-8"), file.parent)

    @property
    def is_certified(self) -> bool:
        """Whether the point is proved to be a minimum (a maximum, where that is asked for)."""
        return self.status == "certified"

    @property
    def title(self) -> str:
        """The problem's title."""
        return str(self.raw["problem"]["title"])

    @property
    def x(self) -> FloatArray:
        """The variables' values."""
        return self.variables.values

    def __getitem__(self, name: str) -> float:
        """The value of a variable: ``depth``, ``x[2]``, ``support.b``."""
        return self.variables[name]

    def to_pandas(self) -> dict[str, pd.DataFrame]:
        """Data frames by name: variables, constraints, of structures ribs."""
        frames = {"variables": self.variables.to_pandas(), "constraints": self.constraints.to_pandas()}
        if self.ribs is not None:
            frames["ribs"] = self.ribs.to_pandas()
        return frames

    def _repr_html_(self) -> str:
        return _html.of_result(self)

"""What a structure does at a point: what ``ribopt analyse --json`` prints, with arrays and names."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from ._arrays import FloatArray, data_frame, floats, frozen

if TYPE_CHECKING:
    import pandas as pd

#: Directions of displacements and reactions: along the axes, then about them.
DIRECTIONS = ("x", "y", "z", "rx", "ry", "rz")


@dataclass(frozen=True, eq=False)
class NodeTable:
    """Displacements or reactions of nodes."""

    names: tuple[str, ...]
    #: A row per node, a column per direction (x, y, z, rx, ry, rz); NaN in directions a node does not have.
    values: FloatArray

    @classmethod
    def _of(cls, nodes: dict[str, dict[str, float]]) -> NodeTable:
        values = np.array([[node.get(way, np.nan) for way in DIRECTIONS] for node in nodes.values()])
        return cls(tuple(nodes), frozen(values.reshape(len(nodes), len(DIRECTIONS))))

    def __getitem__(self, place: tuple[str, str]) -> float:
        """By node and direction."""
        node, direction = place
        return float(self.values[self.names.index(node), DIRECTIONS.index(direction)])

    def to_pandas(self) -> pd.DataFrame:
        """A row per node."""
        return data_frame({way: self.values[:, at] for at, way in enumerate(DIRECTIONS)}, self.names, "node")


@dataclass(frozen=True, eq=False)
class RibExtremes:
    """Least and largest forces and stresses, a line per rib and quantity."""

    ribs: tuple[str, ...]
    #: N, Vy, Vz, T, My, Mz, stress
    quantities: tuple[str, ...]
    least: FloatArray
    #: Stations as parts of the rib's length.
    least_at: FloatArray
    most: FloatArray
    most_at: FloatArray

    @classmethod
    def _of(cls, ribs: dict[str, dict[str, dict[str, Any]]]) -> RibExtremes:
        lines = [(rib, of, extreme) for rib, all_of_it in ribs.items() for of, extreme in all_of_it.items()]

        def column(key: str) -> FloatArray:
            return floats(extreme[key] for _, _, extreme in lines)

        return cls(
            tuple(rib for rib, _, _ in lines),
            tuple(of for _, of, _ in lines),
            column("min"),
            column("min_at"),
            column("max"),
            column("max_at"),
        )

    def to_pandas(self) -> pd.DataFrame:
        """A row per rib and quantity."""
        columns = {
            "quantity": self.quantities,
            "least": self.least,
            "least_at": self.least_at,
            "most": self.most,
            "most_at": self.most_at,
        }
        return data_frame(columns, self.ribs, "rib")


@dataclass(frozen=True, eq=False)
class Case:
    """What a structure does in one load case or combination."""

    displacements: NodeTable
    reactions: NodeTable
    ribs: RibExtremes

    @classmethod
    def _of(cls, raw: dict[str, Any]) -> Case:
        displacements, reactions = NodeTable._of(raw["displacements"]), NodeTable._of(raw["reactions"])
        return cls(displacements, reactions, RibExtremes._of(raw["ribs"]))


@dataclass(frozen=True, eq=False)
class Modes:
    """The lowest buckling factors or frequencies."""

    #: Pieces a rib was divided into.
    pieces: int
    values: FloatArray
    #: The same with twice as many pieces: the difference is about three times what is left of the error.
    with_twice_the_pieces: FloatArray

    @classmethod
    def _of(cls, raw: dict[str, Any]) -> Modes:
        return cls(raw["pieces"], floats(raw["values"]), floats(raw["with_twice_the_pieces"]))


@dataclass(frozen=True, eq=False)
class Analysis:
    """What a structure does at a point."""

    #: Everything, as ``ribopt analyse --json`` prints it.
    raw: dict[str, Any] = field(repr=False)
    #: Values of the file's definitions.
    definitions: dict[str, float]
    cases: dict[str, Case] = field(repr=False)
    #: Lowest buckling factors by case.
    buckling: dict[str, Modes] = field(repr=False)
    frequencies: Modes | None = field(repr=False)
    #: ∂definition/∂variable, a row per definition and a column per variable, in the order of ``definitions`` and
    #: ``variable_names``; None where it was not asked for.
    gradient: FloatArray | None = field(repr=False)
    variable_names: tuple[str, ...] = field(repr=False)
    #: The largest residual of an equilibrium equation over the largest sum of its terms.
    equilibrium_residual: float
    remarks: tuple[str, ...]

    @classmethod
    def of_json(cls, text: str, variable_names: Sequence[str], remarks: Sequence[str] = ()) -> Analysis:
        """The analysis of what ``ribopt analyse --json`` prints."""
        raw = json.loads(text)
        gradient = None
        if "gradient" in raw:
            lists = [[raw["gradient"][name][variable] for variable in variable_names] for name in raw["definitions"]]
            gradient = frozen(np.array(lists, dtype=np.float64).reshape(len(lists), len(variable_names)))
        return cls(
            raw=raw,
            definitions=raw["definitions"],
            cases={name: Case._of(one) for name, one in raw.get("cases", {}).items()},
            buckling={name: Modes._of(one) for name, one in raw["buckling"].items()},
            frequencies=Modes._of(raw["frequencies"]) if "frequencies" in raw else None,
            gradient=gradient,
            variable_names=tuple(variable_names),
            equilibrium_residual=raw["equilibrium_residual"],
            remarks=tuple(remarks),
        )

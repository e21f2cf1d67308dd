"""Arrays that cannot be written to, and what JSON leaves out of numbers."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    import pandas as pd

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]


def frozen(array: FloatArray) -> FloatArray:
    """The same array, read only."""
    array.flags.writeable = False
    return array


def floats(numbers: Iterable[float | None], otherwise: float = np.nan) -> FloatArray:
    """An array of numbers; JSON writes what is none (an open limit, an unknown number) as null."""
    return frozen(np.array([otherwise if number is None else number for number in numbers], dtype=np.float64))


def of_bytes(data: bytes) -> FloatArray:
    """The native half's numbers, read only."""
    return np.frombuffer(data, dtype=np.float64)


def integers(data: bytes) -> IntArray:
    """The native half's whole numbers, read only."""
    return np.frombuffer(data, dtype=np.int64)


def data_frame(columns: dict[str, Any], index: Iterable[str], name: str) -> pd.DataFrame:
    """A data frame with the names as its index."""
    import pandas as pd

    return pd.DataFrame(columns, index=pd.Index(list(index), name=name))

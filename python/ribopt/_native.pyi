"""The native half: buffers of float64 in, bytes and JSON out. The public half is `ribopt` itself."""

from collections.abc import Callable, Sequence
from os import PathLike
from typing import Any, TypedDict, final, type_check_only

from ._arrays import FloatArray, IntArray


__all__ = [
    "Model",
    "Problem",
    "__version__",
    "explain",
    "main",
    "mesh_check",
    "mesh_closest",
    "mesh_hausdorff",
    "mesh_new",
    "mesh_read",
    "mesh_reconstruct",
    "mesh_section",
    "mesh_slice",
    "mesh_smooth",
    "mesh_trace",
    "mesh_weld",
    "mesh_write",
    "sweep",
]

__version__: str

@type_check_only
class Swept(TypedDict):
    study: str | PathLike[str]
    out: str | PathLike[str] | None
    jobs: int
    fresh: bool
    retry: list[str]
    watch: Callable[[int, int], Any] | None

def sweep(asked: Swept) -> tuple[str, str, BaseException | None]: ...
def main(arguments: Sequence[str]) -> int: ...
def explain(code: str | None = None) -> str:
    """What a kind of mistake means, by the code told with it; all kinds without one."""

@type_check_only
class Answer(TypedDict):
    path: str | PathLike[str] | None
    text: str | None

@type_check_only
class Limits(TypedDict):
    optimality_tolerance: float | None
    step_tolerance: float | None
    constraint_tolerance: float | None
    max_iterations: int | None
    max_evaluations: int | None
    max_seconds: float | None

@type_check_only
class Asked(TypedDict):
    backends: list[str]
    algorithm: str | None
    start: Answer | None
    starts: int | None
    out: str | PathLike[str] | None
    plot: bool
    limits: Limits
    watch: Callable[[str, str, tuple[int, int], list[float], bytes], Any] | None

@final
class Problem:
    @staticmethod
    def read(file: str | PathLike[str], changes: list[str]) -> Problem: ...
    @staticmethod
    def of_text(name: str, text: str, folder: str | PathLike[str], changes: list[str]) -> Problem: ...
    @property
    def title(self) -> str: ...
    @property
    def file(self) -> str: ...
    @property
    def problem_class(self) -> str: ...
    @property
    def sign(self) -> float: ...
    @property
    def objective(self) -> str: ...
    @property
    def units(self) -> list[tuple[str, str]]: ...
    @property
    def has_structure(self) -> bool: ...
    @property
    def warnings(self) -> list[str]: ...
    def model(self, restated: bool) -> Model: ...
    def solve(self, asked: Asked) -> tuple[str, str | None, str | None, BaseException | None]: ...
    def verify(self, answer: Answer, limits: Limits) -> str: ...
    def analyse(self, answer: Answer | None, gradient: bool) -> tuple[str, list[str]]: ...

@final
class Model:
    def names(self) -> tuple[list[str], list[str]]: ...
    def limits(self) -> list[bytes]: ...
    def linear(self) -> tuple[bool, list[bool]]: ...
    def jacobian_structure(self) -> tuple[bytes, bytes]: ...
    def hessian_structure(self) -> tuple[bytes, bytes]: ...
    def objective(self, x: FloatArray) -> float: ...
    def gradient(self, x: FloatArray, out: FloatArray) -> None: ...
    def constraints(self, x: FloatArray, out: FloatArray) -> None: ...
    def jacobian(self, x: FloatArray, out: FloatArray) -> None: ...
    def hessian(self, x: FloatArray, multipliers: FloatArray, weight: float, out: FloatArray) -> None: ...
    def hessian_product(self, x: FloatArray, multipliers: FloatArray, weight: float, direction: FloatArray, out: FloatArray) -> None: ...

_Parts = tuple[bytes, bytes, bytes, bytes]
_Mesh = tuple[FloatArray, IntArray, IntArray, IntArray]

def mesh_read(path: str | PathLike[str]) -> _Parts: ...
def mesh_write(mesh: _Mesh, path: str | PathLike[str]) -> None: ...
def mesh_new(name: str) -> _Parts: ...
def mesh_check(mesh: _Mesh, rule: str) -> str: ...
def mesh_weld(mesh: _Mesh, tolerance: float) -> tuple[_Parts, str]: ...
def mesh_reconstruct(mesh: _Mesh, original: _Mesh, tolerance: float | None, fill: bool, snap: bool) -> tuple[_Parts, str]: ...
def mesh_smooth(
    mesh: _Mesh,
    method: str,
    relaxation: float,
    mu: float | None,
    iterations: int,
    slide: bool,
    features: float | None,
    project: _Mesh | None,
) -> tuple[_Parts, str]: ...
def mesh_trace(mesh: _Mesh, rule: str) -> tuple[bytes, bytes, list[bool], str]: ...
def mesh_slice(mesh: _Mesh, rule: str, segments: float) -> tuple[list[tuple[str, bool, bytes, bytes]], str]: ...
def mesh_section(mesh: _Mesh, origin: FloatArray, normal: FloatArray) -> tuple[list[list[bytes]], str]: ...
def mesh_closest(mesh: _Mesh, points: FloatArray) -> bytes: ...
def mesh_hausdorff(first: _Mesh, second: _Mesh) -> str: ...

"""A problem as functions of a point, in the shape that cyipopt takes."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import ArrayLike

from . import _native
from ._arrays import FloatArray, IntArray, integers, of_bytes


class Model:
    """Minimise ``objective(x)`` subject to ``lower <= x <= upper`` and ``row_lower <= constraints(x) <= row_upper``.

    All derivatives are exact. Of a problem that maximises, the objective is the negative of what the file says: a model is
    always to be minimised. ``x`` is an array in the order of ``variable_names``. Any method raises :class:`ribopt.EvaluationError`
    where a term has no value. The interpreter's lock is released while a method computes.
    """

    #: Names of the variables, n of them.
    variable_names: tuple[str, ...]
    #: Names of the rows, m of them.
    row_names: tuple[str, ...]
    #: Lower bounds of the variables, −inf where open.
    lower: FloatArray
    #: Upper bounds, inf where open.
    upper: FloatArray
    #: Lower limits of the rows, −inf where open; equal to the upper ones of equalities.
    row_lower: FloatArray
    #: Upper limits, inf where open.
    row_upper: FloatArray
    #: Where the file says to begin, inside the bounds.
    start: FloatArray
    #: Whether the objective is affine.
    objective_is_linear: bool
    #: Which rows are affine.
    row_is_linear: tuple[bool, ...]

    def __init__(self, native: _native.Model) -> None:
        self._native = native
        variables, rows = native.names()
        self.variable_names, self.row_names = tuple(variables), tuple(rows)
        self.lower, self.upper, self.row_lower, self.row_upper, self.start = map(of_bytes, native.limits())
        self.objective_is_linear, linear = native.linear()
        self.row_is_linear = tuple(linear)
        self._jacobian = tuple(map(integers, native.jacobian_structure()))
        self._hessian: tuple[IntArray, IntArray] | None = None

    def __repr__(self) -> str:
        return f"<ribopt.Model: {len(self.variable_names)} variables, {len(self.row_names)} rows>"

    def named(self, x: ArrayLike) -> dict[str, float]:
        """Values by variable name."""
        return dict(zip(self.variable_names, self._point(x).tolist(), strict=True))

    def point(self, values: Mapping[str, float]) -> FloatArray:
        """The point with these values; variables that are not named are at their start."""
        point, places = self.start.copy(), {name: at for at, name in enumerate(self.variable_names)}
        for name, value in values.items():
            point[places[name]] = value
        return point

    def objective(self, x: ArrayLike) -> float:
        """f(x)"""
        return self._native.objective(self._point(x))

    def gradient(self, x: ArrayLike) -> FloatArray:
        """∇f(x), length n"""
        out = np.empty(len(self.variable_names))
        self._native.gradient(self._point(x), out)
        return out

    def constraints(self, x: ArrayLike) -> FloatArray:
        """c(x), length m"""
        out = np.empty(len(self.row_names))
        self._native.constraints(self._point(x), out)
        return out

    def jacobian(self, x: ArrayLike) -> FloatArray:
        """∂c_i/∂x_j along :meth:`jacobianstructure`"""
        out = np.empty(len(self._jacobian[0]))
        self._native.jacobian(self._point(x), out)
        return out

    def jacobianstructure(self) -> tuple[IntArray, IntArray]:
        """Rows and columns where the Jacobian can be other than zero."""
        return self._jacobian[0], self._jacobian[1]

    def hessian(self, x: ArrayLike, lagrange: ArrayLike, obj_factor: float) -> FloatArray:
        """obj_factor·∇²f + Σ lagrange_i·∇²c_i along :meth:`hessianstructure`"""
        out = np.empty(len(self.hessianstructure()[0]))
        self._native.hessian(self._point(x), self._multipliers(lagrange), obj_factor, out)
        return out

    def hessianstructure(self) -> tuple[IntArray, IntArray]:
        """Rows and columns of the lower triangle where the Hessian of the Lagrangian can be other than zero.

        Of a structure that is solved at every point that is the whole triangle, had by n products: there
        :meth:`hessianproduct` costs less.
        """
        if self._hessian is None:
            rows, columns = map(integers, self._native.hessian_structure())
            self._hessian = (rows, columns)
        return self._hessian

    def hessianproduct(self, x: ArrayLike, lagrange: ArrayLike, obj_factor: float, direction: ArrayLike) -> FloatArray:
        """(obj_factor·∇²f + Σ lagrange_i·∇²c_i)·direction, length n"""
        out = np.empty(len(self.variable_names))
        self._native.hessian_product(self._point(x), self._multipliers(lagrange), obj_factor, _floats(direction), out)
        return out

    def jacobian_matrix(self, x: ArrayLike) -> FloatArray:
        """The Jacobian as a dense matrix, m × n."""
        matrix = np.zeros((len(self.row_names), len(self.variable_names)))
        matrix[self._jacobian[0], self._jacobian[1]] = self.jacobian(x)
        return matrix

    def hessian_matrix(self, x: ArrayLike, lagrange: ArrayLike, obj_factor: float) -> FloatArray:
        """The Hessian of the Lagrangian as a dense symmetric matrix, n × n."""
        (rows, columns), n = self.hessianstructure(), len(self.variable_names)
        matrix = np.zeros((n, n))
        matrix[rows, columns] = self.hessian(x, lagrange, obj_factor)
        matrix[columns, rows] = matrix[rows, columns]
        return matrix

    def _point(self, x: ArrayLike) -> FloatArray:
        return _floats(x)

    def _multipliers(self, lagrange: ArrayLike) -> FloatArray:
        return _floats(lagrange)


def _floats(numbers: ArrayLike) -> FloatArray:
    return np.ascontiguousarray(numbers, dtype=np.float64).reshape(-1)

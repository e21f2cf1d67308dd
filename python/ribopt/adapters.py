"""A problem for other solvers: SciPy, OpenMDAO, pyOptSparse. Each is imported when it is asked for.

All of them minimise: of a problem that maximises, they see the negative of its objective. What they find is judged by
:meth:`ribopt.Problem.verify`.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ._arrays import FloatArray
from ._errors import EvaluationError
from ._model import Model
from ._problem import Problem


def _model(problem: Problem | Model) -> Model:
    return problem.model if isinstance(problem, Problem) else problem


def scipy_arguments(problem: Problem | Model, method: str = "SLSQP") -> dict[str, Any]:
    """The arguments of ``scipy.optimize.minimize``: ``minimize(**scipy_arguments(problem))``.

    ``trust-constr`` is given exact second derivatives and sparse Jacobians, and keeps within the bounds of all variables that start
    inside them; the other methods with constraints (SLSQP, COBYLA, COBYQA) take no second derivatives and dense Jacobians. A point
    without a value ends the run with :class:`ribopt.EvaluationError`: SciPy's methods know no way back.
    """
    from scipy.optimize import Bounds, NonlinearConstraint
    from scipy.sparse import coo_array

    model = _model(problem)
    second, none = method == "trust-constr", np.zeros(len(model.row_names))
    rows, columns = model.jacobianstructure()

    def jacobian(x: ArrayLike) -> Any:
        if second:
            return coo_array((model.jacobian(x), (rows, columns)), shape=(len(none), len(model.lower))).tocsr()
        return model.jacobian_matrix(x)

    arguments: dict[str, Any] = {
        "fun": model.objective,
        "x0": model.start.copy(),
        "jac": model.gradient,
        "bounds": Bounds(model.lower, model.upper, keep_feasible=second & (model.lower < model.start) & (model.start < model.upper)),
        "method": method,
    }
    if second:
        arguments["hess"] = lambda x: model.hessian_matrix(x, none, 1.0)
    if len(none) > 0:
        rows_of_model: dict[str, Any] = {"fun": model.constraints, "lb": model.row_lower, "ub": model.row_upper, "jac": jacobian}
        if second:
            rows_of_model["hess"] = lambda x, v: model.hessian_matrix(x, v, 0.0)
        arguments["constraints"] = NonlinearConstraint(**rows_of_model)
    return arguments


def openmdao_component(problem: Problem | Model) -> Any:
    """An ``openmdao.api.ExplicitComponent`` with the input ``x`` (the variables, in their order) and the outputs ``objective`` and,
    where there are rows, ``constraints``; all partial derivatives are exact and sparse. A point without a value raises OpenMDAO's
    ``AnalysisError``, from which its drivers step back."""
    import openmdao.api as om

    model = _model(problem)

    class RiboptComponent(om.ExplicitComponent):  # type: ignore[misc]
        def setup(self) -> None:
            self.add_input("x", val=model.start)
            self.add_output("objective", val=1.0)
            self.declare_partials("objective", "x")
            if model.row_names:
                rows, columns = model.jacobianstructure()
                self.add_output("constraints", shape=len(model.row_names))
                self.declare_partials("constraints", "x", rows=rows, cols=columns)

        def compute(self, inputs: Any, outputs: Any) -> None:
            try:
                outputs["objective"] = model.objective(inputs["x"])
                if model.row_names:
                    outputs["constraints"] = model.constraints(inputs["x"])
            except EvaluationError as error:
                raise om.AnalysisError(str(error)) from error

        def compute_partials(self, inputs: Any, partials: Any) -> None:
            try:
                partials["objective", "x"] = model.gradient(inputs["x"])
                if model.row_names:
                    partials["constraints", "x"] = model.jacobian(inputs["x"])
            except EvaluationError as error:
                raise om.AnalysisError(str(error)) from error

    return RiboptComponent()


def openmdao_problem(problem: Problem | Model, driver: Any = None) -> Any:
    """An ``openmdao.api.Problem`` around :func:`openmdao_component`: design variable ``x``, objective ``ribs.objective``, and the rows
    with their limits; set up, at the start. The driver is SciPy's SLSQP by default."""
    import openmdao.api as om

    model = _model(problem)
    whole = om.Problem(driver=driver or om.ScipyOptimizeDriver(optimizer="SLSQP", disp=False))
    whole.model.add_subsystem("ribs", openmdao_component(model), promotes_inputs=["x"])
    whole.model.add_design_var("x", lower=model.lower, upper=model.upper)
    whole.model.add_objective("ribs.objective")
    equal = np.flatnonzero(model.row_lower == model.row_upper)
    between = np.flatnonzero(model.row_lower != model.row_upper)
    if len(equal) > 0:
        whole.model.add_constraint("ribs.constraints", equals=model.row_lower[equal], indices=equal, alias="equalities")
    if len(between) > 0:
        lower, upper = model.row_lower[between], model.row_upper[between]
        whole.model.add_constraint("ribs.constraints", lower=lower, upper=upper, indices=between, alias="limits")
    whole.setup()
    whole.set_val("x", model.start)
    return whole


def pyoptsparse_problem(problem: Problem | Model, name: str = "ribopt") -> tuple[Any, Any]:
    """A ``pyoptsparse.Optimization`` and its function of derivatives: ``optimization, sens = pyoptsparse_problem(problem)``, then
    ``SLSQP()(optimization, sens=sens)``. Variable group ``x``, constraint group ``constraints``, objective ``objective``."""
    from pyoptsparse import Optimization

    model = _model(problem)
    rows, columns = model.jacobianstructure()
    shape = [len(model.row_names), len(model.variable_names)]

    def coordinates(values: Any) -> dict[str, Any]:
        return {"coo": [rows, columns, values], "shape": shape}

    def either(function: Any, otherwise: Any) -> tuple[Any, bool]:
        try:
            return function(), False
        except EvaluationError:
            return otherwise, True

    def functions(point: dict[str, Any]) -> tuple[dict[str, Any], bool]:
        objective, failed = either(lambda: model.objective(point["x"]), np.nan)
        constraints, also_failed = either(lambda: model.constraints(point["x"]), np.full(shape[0], np.nan))
        return {"objective": objective, **({"constraints": constraints} if shape[0] else {})}, failed or also_failed

    def derivatives(point: dict[str, Any], _: dict[str, Any]) -> tuple[dict[str, Any], bool]:
        gradient, failed = either(lambda: model.gradient(point["x"]), np.full(shape[1], np.nan))
        jacobian, also_failed = either(lambda: model.jacobian(point["x"]), np.full(len(rows), np.nan))
        rows_of_it = {"constraints": {"x": coordinates(jacobian)}} if shape[0] else {}
        return {"objective": {"x": gradient}, **rows_of_it}, failed or also_failed

    optimization = Optimization(name, functions)
    lower, upper = _open(model.lower), _open(model.upper)
    optimization.addVarGroup("x", shape[1], "c", lower=lower, upper=upper, value=model.start)
    if model.row_names:
        pattern = {"x": coordinates(np.ones(len(rows)))}
        lower, upper = _open(model.row_lower), _open(model.row_upper)
        optimization.addConGroup("constraints", shape[0], lower=lower, upper=upper, wrt=["x"], jac=pattern)
    optimization.addObj("objective")
    return optimization, derivatives


def _open(limits: FloatArray) -> list[float | None]:
    """pyOptSparse wants None where there is no limit."""
    return [limit if np.isfinite(limit) else None for limit in limits.tolist()]

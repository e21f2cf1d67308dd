"""Values and derivatives of every bundled problem, against differences."""

from __future__ import annotations

import numpy as np
import pytest
import ribopt
from conftest import PROBLEMS
from ribopt import Model

#: Differences of the fourth order at this part of a variable's size: what the fifth derivative adds, its fourth power, and what
#: rounding loses, 1e-16 over it, are both small.
STEP = 1e-5
#: Of gradients, which hold the rounding of a structure's solution, some 1e-12: a longer step loses less of it.
STEP_OF_GRADIENTS = 1e-4


def inside(model: Model) -> np.ndarray:
    """A point off the start and off kinks, inside the bounds."""
    factor = 1 + 0.03 * np.sin(1 + np.arange(len(model.start)))
    return np.clip(model.start * factor + 1e-3 * (model.start == 0), model.lower, model.upper)


def differences(function, x: np.ndarray, columns, part: float = STEP) -> dict[int, np.ndarray]:
    slopes = {}
    for j in columns:
        step = np.zeros_like(x)
        step[j] = size(x[j], part)
        near, far = (np.asarray(function(x + k * step)) - function(x - k * step) for k in (1, 2))
        slopes[j] = (8 * near - far) / (12 * step[j])
    return slopes


def alike(names: tuple[str, ...], terms: np.ndarray) -> np.ndarray:
    """The largest of all rows of a constraint: a stress that vanishes is computed from others that do not."""
    constraints = [name.split("[")[0] for name in names]
    largest = {one: max(term for other, term in zip(constraints, terms, strict=True) if other == one) for one in set(constraints)}
    return np.array([largest[one] for one in constraints])


def size(x: float, part: float = STEP) -> float:
    return part * max(abs(x), 1e-3)


@pytest.mark.parametrize("restated", [False, True])
@pytest.mark.parametrize("name", sorted(path.stem for path in PROBLEMS.glob("*.toml")))
def test_derivatives_agree_with_differences(name: str, restated: bool) -> None:
    problem = ribopt.load(PROBLEMS / f"{name}.toml")
    model = problem.restated_model if restated else problem.model
    x = inside(model)
    # Up to a dozen variables, spread over all.
    columns = np.unique(np.linspace(0, len(x) - 1, 12).astype(int))
    gradient, jacobian = model.gradient(x), model.jacobian_matrix(x)
    y = np.cos(np.arange(len(model.row_names)))
    y /= 1 + np.abs(model.constraints(x))
    # A difference of values loses what is below the rounding of their terms.
    terms = abs(model.objective(x)) + np.abs(gradient) @ np.abs(x)
    for j, slope in differences(model.objective, x, columns).items():
        assert abs(gradient[j] - slope) <= 1e-6 * abs(slope) + 1e-14 * terms / size(x[j]), model.variable_names[j]
    if len(y) > 0:
        terms = alike(model.row_names, np.abs(model.constraints(x)) + np.abs(jacobian) @ np.abs(x))
        for j, slope in differences(model.constraints, x, columns).items():
            lost = 1e-14 * terms / size(x[j])
            assert np.all(np.abs(jacobian[:, j] - slope) <= 1e-6 * np.abs(slope) + lost), model.variable_names[j]

    def slope_of_lagrangian(point: np.ndarray) -> np.ndarray:
        return 0.7 * model.gradient(point) + model.jacobian_matrix(point).T @ y

    hessian = model.hessian_matrix(x, y, 0.7)
    scale = np.abs(hessian).max()
    for j, slope in differences(slope_of_lagrangian, x, columns, STEP_OF_GRADIENTS).items():
        assert np.all(np.abs(hessian[:, j] - slope) <= 1e-5 * np.abs(slope) + 1e-6 * scale), model.variable_names[j]
        axis = np.eye(1, len(x), j)[0]
        assert np.allclose(model.hessianproduct(x, y, 0.7, axis), hessian[:, j], rtol=1e-8, atol=1e-10 * scale)


def test_the_shape_is_that_of_cyipopt(rib: str) -> None:
    model = ribopt.loads(rib).model
    n, m = len(model.variable_names), len(model.row_names)
    assert (n, m) == (3, 3) and isinstance(model.objective(model.start), float)
    rows, columns = model.jacobianstructure()
    assert rows.dtype == np.int64 and model.jacobian(model.start).shape == rows.shape == columns.shape
    rows, columns = model.hessianstructure()
    assert np.all(columns <= rows) and model.hessian(model.start, np.zeros(m), 1.0).shape == rows.shape
    assert model.named(model.point({"left.b": 0.3}))["left.b"] == 0.3


def test_of_a_maximum_the_negative_is_minimised() -> None:
    problem = ribopt.loads('maximize = "x*(4 - x)"\n[variables]\nx = { lower = 0, upper = 4 }\n')
    assert problem.sense == "maximize" and problem.model.objective([2.0]) == -4.0 and problem.solve().objective == 4.0


def test_kinks_are_restated() -> None:
    problem = ribopt.loads('minimize = "max(x, 1/x)"\n[variables]\nx = { lower = 0.1, upper = 4 }\n')
    assert problem.model.variable_names == ("x",) and problem.model.objective([2.0]) == 2.0
    restated = problem.restated_model
    assert restated.variable_names[0] == "x" and len(restated.variable_names) > 1 and len(restated.row_names) == 2

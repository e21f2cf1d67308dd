"""Other solvers find what ribopt finds, and ribopt certifies it."""

from __future__ import annotations

import numpy as np
import pytest
import ribopt
from conftest import PROBLEMS
from ribopt import adapters

TWO = ["haunched-floor-rib", "ten-bar-truss"]
#: Methods that end away from minima of badly scaled rows are given rows of one size.
WELL_SCALED = ["svanberg-cantilever", "vanderplaats-cantilever"]

OPTIONS = {"SLSQP": {"ftol": 1e-6, "maxiter": 500}, "trust-constr": {"gtol": 1e-8, "xtol": 1e-10, "maxiter": 3000}}


def judged(problem: ribopt.Problem, x: np.ndarray) -> None:
    """The optimum, and the certificate says so within the tolerances that other solvers stop at."""
    best = problem.solve()
    assert problem.model.objective(x) == pytest.approx(problem.model.objective(best.x), rel=1e-5)
    assert problem.verify(x, optimality_tolerance=1e-2, constraint_tolerance=1e-4).is_certified


@pytest.mark.parametrize(
    "name, method", [(name, "SLSQP") for name in TWO] + [(name, "trust-constr") for name in WELL_SCALED]
)
def test_scipy(name: str, method: str) -> None:
    optimize = pytest.importorskip("scipy.optimize")
    problem = ribopt.load(PROBLEMS / f"{name}.toml")
    found = optimize.minimize(**adapters.scipy_arguments(problem, method), options=OPTIONS[method])
    assert found.success, found.message
    judged(problem, found.x)


@pytest.mark.parametrize("name", TWO)
def test_openmdao(name: str, tmp_path, monkeypatch: pytest.MonkeyPatch) -> None:
    om = pytest.importorskip("openmdao.api")
    monkeypatch.chdir(tmp_path)  # it leaves a folder of reports
    problem = ribopt.load(PROBLEMS / f"{name}.toml")
    driver = om.ScipyOptimizeDriver(optimizer="SLSQP", tol=1e-6, maxiter=500, disp=False)
    whole = adapters.openmdao_problem(problem, driver)
    whole.run_model()
    checked = whole.check_partials(method="fd", form="central", step=1e-6, step_calc="rel", out_stream=None)
    for pairs in checked.values():
        for error in pairs.values():
            exact = error["J_fwd"]
            assert np.all(np.abs(exact - error["J_fd"]) <= 1e-5 * (np.abs(exact).max() + 1e-9))
    assert whole.run_driver().success
    judged(problem, whole.get_val("x"))


def test_openmdao_steps_back_where_there_is_no_value(tmp_path, monkeypatch: pytest.MonkeyPatch) -> None:
    om = pytest.importorskip("openmdao.api")
    monkeypatch.chdir(tmp_path)
    problem = ribopt.loads('minimize = "sqrt(x)"\n[variables]\nx = { lower = -1, upper = 4, start = 3 }\n')
    whole = adapters.openmdao_problem(problem)
    whole.set_val("x", -0.5)
    with pytest.raises(om.AnalysisError, match="square root"):
        whole.run_model()


@pytest.mark.parametrize("name", TWO)
def test_pyoptsparse(name: str, tmp_path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)  # it leaves a file
    pyoptsparse = pytest.importorskip("pyoptsparse", reason="pyOptSparse is on no package index; it is built from source")
    problem = ribopt.load(PROBLEMS / f"{name}.toml")
    optimization, sens = adapters.pyoptsparse_problem(problem)
    found = pyoptsparse.SLSQP(options={"ACC": 1e-10, "MAXIT": 500})(optimization, sens=sens)
    judged(problem, found.xStar["x"])


@pytest.mark.parametrize("name", ["grillage", "vanderplaats-cantilever", "rocket"])
def test_cyipopt_takes_a_model_as_it_is(name: str) -> None:
    cyipopt = pytest.importorskip("cyipopt", reason="cyipopt is built against an Ipopt of the system")
    problem = ribopt.load(PROBLEMS / f"{name}.toml")
    m = problem.model
    sizes, limits = (len(m.lower), len(m.row_lower)), {"lb": m.lower, "ub": m.upper, "cl": m.row_lower, "cu": m.row_upper}
    ipopt = cyipopt.Problem(*sizes, problem_obj=m, **limits)
    ipopt.add_option("print_level", 0)
    x, info = ipopt.solve(m.start.copy())
    assert info["status"] == 0
    judged(problem, np.clip(x, m.lower, m.upper))

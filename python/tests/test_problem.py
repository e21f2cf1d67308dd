"""Reading, solving, verifying, analysing; names, arrays, data frames."""

from __future__ import annotations

import dataclasses
from pathlib import Path

import numpy as np
import pytest
import ribopt
from conftest import PROBLEMS


TWO_BARS = """
minimize = "volume"
[structure]
plane = "xy"
joints = "pinned"
[materials]
steel = { E = 210e6 }
[nodes]
left = [0.0, 0.0]
right = [2.0, 0.0]
top = [1.0, 2.0]
[supports]
left = "pinned"
right = "pinned"
[sections]
a = { kind = "general", A = { lower = 1e-4, upper = 1e-2, start = 1e-3 } }
b = { kind = "general", A = { lower = 1e-4, upper = 1e-2, start = 2e-3 } }
[[ribs]]
name = "one"
start = "left"
end = "top"
section = "a"
[[ribs]]
name = "other"
start = "right"
end = "top"
section = "b"
[[loads]]
case = "P"
nodes = ["top"]
force = [30.0, -100.0]
[definitions]
down = "disp(P, top, y)"
pulled = "stress(P, one, 0.5, centre)"
[[constraints]]
name = "sag"
require = "down >= -1e-3"
"""


def test_a_rib_by_names(rib: str) -> None:
    problem = ribopt.loads(rib)
    assert (problem.title, problem.sense, problem.problem_class) == ("A haunched rib", "minimize", "geometric program")
    result = problem.solve()
    assert result.is_certified and result.scope == "global" and result.folder is None
    # Ix = b·h³/12 of the right end is just what is asked of it.
    assert result["left.b"] * result["right.h"] ** 3 / 12 == pytest.approx(2e-4, rel=1e-7)
    assert result.constraints["stiff"] == pytest.approx(2e-4, rel=1e-7)
    assert result.objective == result.volume.total == pytest.approx(result.lower_bound, rel=1e-6)
    assert result.variables.to_dict() == dict(zip(result.variables.names, result.x, strict=True))
    stiff = result.constraints.names.index("stiff")
    assert result.constraints.active[stiff] == "lower" and result.constraints.upper[stiff] == np.inf
    assert {solution.backend for solution in result.solutions} == {"nlopt", "argmin"} and result.agreement.agree
    assert all(solution.certificate.certified for solution in result.solutions)


def test_sensitivities_are_derivatives_of_the_optimum(rib: str) -> None:
    problem = ribopt.loads(rib)
    result, step = problem.solve(), 1e-3
    more, less = (
        ribopt.loads(rib.replace("2e-4", repr(2e-4 * (1 + sign * step)))).solve().objective for sign in (1, -1)
    )
    slope = (more - less) / (2 * 2e-4 * step)
    assert result.constraints.sensitivities[result.constraints.names.index("stiff")] == pytest.approx(slope, rel=1e-3)


def test_results_are_frozen(rib: str) -> None:
    result = ribopt.loads(rib).solve()
    with pytest.raises(dataclasses.FrozenInstanceError):
        result.status = "certified"  # type: ignore[misc]
    with pytest.raises(ValueError, match="read-only"):
        result.x[0] = 1.0


def test_dictionaries_say_what_files_say(rib: str) -> None:
    section = {"kind": "rectangle", "h": {"lower": 0.2, "upper": np.float64(1.0)}}
    problem = ribopt.from_dict(
        {
            "title": "A \"haunched\" rib, 3 m\x7f\n",
            "parameters": {"M": 40},
            "sections": {"left": {**section, "b": {"lower": 0.1, "upper": 0.4}}, "right": {**section, "b": "left.b"}},
            "ribs": [{"name": "only", "from": "left", "to": "right", "length": 3.0}],
            "constraints": [
                {"name": "bending", "require": "M/left.Wx <= 8e3"},
                {"name": "stiff", "require": "right.Ix >= 2e-4"},
                {"name": "upright", "require": "left.h <= 4*left.b"},
            ],
        }
    )
    assert problem.title == "A \"haunched\" rib, 3 m\x7f\n"
    # Dimensions are listed in another order; the optimum is the same.
    assert problem.solve().objective == pytest.approx(ribopt.loads(rib).solve().objective, rel=1e-9)
    assert ribopt.loads(problem.text).solve().x == pytest.approx(problem.solve().x, abs=0)
    with pytest.raises(TypeError, match=r"parameters\.M"):
        ribopt.from_dict({"parameters": {"M": None}})


def test_numbers_are_changed_as_by_set(rib: str) -> None:
    lighter = ribopt.loads(rib, set={"M": 20, "left.b.upper": 0.3})
    assert lighter.solve().raw["problem"]["changes"] == ["M=20.0", "left.b.upper=0.3"]
    assert lighter.solve().objective < ribopt.loads(rib).solve().objective
    assert lighter.model.upper[lighter.model.variable_names.index("left.b")] == 0.3
    file = PROBLEMS / "portal-frame.toml"
    name = ribopt.load(file).model.variable_names[0]
    assert ribopt.load(file, set=[f"{name}.upper=0.5"]).model.upper[0] == 0.5


def test_answers_of_all_kinds_are_verified(rib: str, tmp_path: Path) -> None:
    problem = ribopt.loads(rib)
    result = problem.solve(out=tmp_path / "out")
    assert result.folder == tmp_path / "out" and (result.folder / "variables.csv").exists()
    answers = [result, result.variables.to_dict(), result.x, list(result.x), tmp_path / "out" / "variables.csv"]
    for answer in answers:
        assert problem.verify(answer).is_certified
    verdict = problem.verify(problem.model.start)
    assert verdict.status == "uncertified" and not verdict.solutions
    assert not problem.verify(result.x * (1 + 1e-5)).is_certified
    assert problem.verify(result.x * (1 + 1e-5), optimality_tolerance=1e-2, constraint_tolerance=1e-2).is_certified


def test_a_run_starts_at_an_answer_and_keeps_within_limits(rib: str) -> None:
    problem = ribopt.loads(rib)
    cold = problem.solve(backends=["argmin"])
    warm = problem.solve(backends=["argmin"], start=cold)
    assert warm.solutions[0].evaluations < cold.solutions[0].evaluations
    assert problem.solve(max_evaluations=1).status == "limit-reached"
    assert problem.solve(max_seconds=0).status == "limit-reached"


def test_iterations_are_seen_and_may_stop_the_run(rib: str) -> None:
    problem, seen = ribopt.loads(rib), []
    result = problem.solve(on_iteration=seen.append)
    assert {one.backend for one in seen} == {"nlopt", "argmin"}
    assert seen[-1].objective == pytest.approx(result.objective, rel=1e-6) and seen[-1].x.shape == result.x.shape

    def stop(iteration: ribopt.Iteration) -> None:
        raise LookupError(iteration.backend)

    with pytest.raises(LookupError, match="nlopt"):
        problem.solve(on_iteration=stop)


def test_a_structure_is_analysed() -> None:
    problem = ribopt.load(PROBLEMS / "portal-frame.toml")
    assert problem.has_structure
    analysis = problem.analyse()
    for case in analysis.cases.values():
        assert case.displacements.values.shape == (len(case.displacements.names), 6)
        assert case.ribs.least.shape == (len(case.ribs.ribs),)
    assert analysis.equilibrium_residual < 1e-9
    assert analysis.gradient is None
    with pytest.raises(ribopt.InputError, match="has no structure"):
        ribopt.analyse(PROBLEMS / "haunched-floor-rib.toml")


def test_definitions_slope_as_differences_say() -> None:
    problem = ribopt.loads(TWO_BARS)
    analysis, x = problem.analyse(gradient=True), problem.model.start
    assert analysis.gradient.shape == (2, 2) and analysis.cases["P"].displacements["top", "y"] < 0
    for j in range(len(x)):
        step = np.zeros_like(x)
        step[j] = 1e-6 * x[j]
        more, less = problem.analyse(x + step), problem.analyse(x - step)
        for i, name in enumerate(analysis.definitions):
            slope = (more.definitions[name] - less.definitions[name]) / (2 * step[j])
            assert analysis.gradient[i, j] == pytest.approx(slope, rel=1e-5, abs=1e-7 * abs(analysis.definitions[name]) / x[j])


def test_a_mechanism_is_told() -> None:
    with pytest.raises(ribopt.InputError, match="can move in y") as caught:
        ribopt.loads(TWO_BARS.replace("top = [1.0, 2.0]", "top = [1.0, 0.0]"))
    assert caught.value.mistakes[0].code == "mechanism"


def test_data_frames_and_pages(rib: str) -> None:
    pd = pytest.importorskip("pandas")
    result = ribopt.loads(rib.replace("A haunched rib", "<b>")).solve()
    frames = result.to_pandas()
    assert frames["variables"].loc["left.b", "value"] == result["left.b"]
    assert isinstance(frames["constraints"], pd.DataFrame) and list(frames["constraints"].index) == list(result.constraints)
    page = result._repr_html_()
    assert "&lt;b&gt;" in page and "<b>certified</b>" in page and page.count("<table>") == page.count("</table>") == 2
    assert "left.b" in ribopt.loads(rib)._repr_html_()
    truss = ribopt.load(PROBLEMS / "ten-bar-truss.toml")
    frames = truss.solve().to_pandas()
    assert 0.999 < frames["ribs"]["utilisation"].max() < 1.001
    case = next(iter(truss.analyse().cases.values()))
    assert list(case.displacements.to_pandas().columns) == ["x", "y", "z", "rx", "ry", "rz"]

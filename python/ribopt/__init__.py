"""ribopt sizes structural ribs and structures, and proves its answers.

>>> import ribopt
>>> problem = ribopt.loads('minimize = "b*h"\\n[variables]\\nb = { lower = 0.1, upper = 1 }\\nh = { lower = 0.2, upper = 1 }')
>>> result = problem.solve()
>>> result.is_certified, result["h"]
(True, 0.2)

The problem file says what a problem is (docs/problem-file.md), and ``docs/python.md`` what this package offers.
"""

from __future__ import annotations

from . import adapters, mesh
from ._analysis import Analysis, Case, Modes, NodeTable, RibExtremes
from ._errors import (
    AnalysisError,
    EvaluationError,
    InputError,
    Interrupted,
    MeshError,
    Mistake,
    RiboptError,
    StudyError,
    UnwrittenError,
)
from ._model import Model
from ._native import __version__, explain
from ._problem import Iteration, Problem, analyse, from_dict, load, loads, solve, verify
from ._result import (
    Agreement,
    Certificate,
    Constraints,
    Minimum,
    Result,
    RibUses,
    Solution,
    Variables,
    Volumes,
)
from ._study import Study, sweep

__all__ = [
    "Agreement",
    "Analysis",
    "AnalysisError",
    "Case",
    "Certificate",
    "Constraints",
    "EvaluationError",
    "InputError",
    "Interrupted",
    "Iteration",
    "MeshError",
    "Minimum",
    "Mistake",
    "Model",
    "Modes",
    "NodeTable",
    "Problem",
    "Result",
    "RibExtremes",
    "RibUses",
    "RiboptError",
    "Solution",
    "Study",
    "StudyError",
    "UnwrittenError",
    "Variables",
    "Volumes",
    "__version__",
    "adapters",
    "analyse",
    "explain",
    "from_dict",
    "load",
    "loads",
    "mesh",
    "solve",
    "sweep",
    "verify",
]

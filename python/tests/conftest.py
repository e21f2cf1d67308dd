"""What all tests share: the repository's problems, and one run of each by the package beside one by the command line."""

from __future__ import annotations

from pathlib import Path

import pytest

PROBLEMS = Path(__file__).parents[2] / "problems"

RIB = """
title = "A haunched rib"
[parameters]
M = 40.0
[sections.left]
kind = "rectangle"
b = { lower = 0.1, upper = 0.4 }
h = { lower = 0.2, upper = 1.0 }
[sections.right]
kind = "rectangle"
b = "left.b"
h = { lower = 0.2, upper = 1.0 }
[[ribs]]
name = "only"
from = "left"
to = "right"
length = 3.0
[[constraints]]
name = "bending"
require = "M/left.Wx <= 8e3"
[[constraints]]
name = "stiff"
require = "right.Ix >= 2e-4"
[[constraints]]
name = "upright"
require = "left.h <= 4*left.b"
"""


@pytest.fixture
def rib() -> str:
    return RIB

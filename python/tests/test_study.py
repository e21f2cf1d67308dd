"""Studies from Python are those of the command line."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import ribopt
from conftest import PROBLEMS

STUDY = f"""
problem = "{(PROBLEMS / "haunched-floor-rib.toml").as_posix()}"
[vary]
sag_limit = {{ from = "9.0/500", to = "9.0/200", count = 5 }}
"support.b.upper" = {{ values = [0.08, 0.12] }}
[report]
quantities = {{ weight = "7.85*volume" }}
"""


@pytest.fixture
def study(tmp_path: Path) -> Path:
    file = tmp_path / "sags.toml"
    file.write_text(STUDY)
    return file


def test_a_table_is_that_of_the_command_line(study: Path, tmp_path: Path) -> None:
    seen: list[tuple[int, int]] = []
    found = ribopt.sweep(study, out=tmp_path / "out", on_progress=lambda done, of: seen.append((done, of)))
    assert found.names == ("sag_limit", "support.b.upper") and len(found) == 10
    # Under the narrower rib stricter limits cannot be met.
    assert found.status == {"infeasible": 4, "certified": 6}
    assert seen and seen[-1][0] == seen[-1][1]
    assert np.allclose(np.unique(found["sag_limit"]), np.linspace(9 / 500, 9 / 200, 5))
    certified = np.array(found["status"]) == "certified"
    assert np.array_equal(np.isnan(found.numbers("objective")), ~certified) and (found.folder / "map.svg").exists()
    assert np.allclose(found.numbers("weight")[certified], 7.85 * found.numbers("volume")[certified])
    # A looser limit never costs.
    assert np.all(found.numbers("sensitivity:sag_limit")[certified] <= 1e-9)
    command = [sys.executable, "-m", "ribopt", "sweep", study, "--quiet", "--out", tmp_path / "other"]
    subprocess.run(command, check=True)

    def without_seconds(table: Path) -> list[list[str]]:
        lines = [line.split(",") for line in table.read_text().splitlines()]
        at = lines[0].index("seconds")
        return [line[:at] + line[at + 1 :] for line in lines]

    assert without_seconds(found.folder / "table.csv") == without_seconds(tmp_path / "other" / "table.csv")
    # What is finished is not done again: the seconds are those of the first time.
    assert np.array_equal(ribopt.sweep(study, out=tmp_path / "out").numbers("seconds"), found.numbers("seconds"))
    assert isinstance(found["message"], tuple) and found.folder == tmp_path / "out"


def test_a_study_as_data_frame_and_page(study: Path, tmp_path: Path) -> None:
    pytest.importorskip("pandas")
    found = ribopt.sweep(study, out=tmp_path / "out", jobs=1)
    frame = found.to_pandas()
    assert frame.groupby("support.b.upper")["objective"].count().to_dict() == {0.08: 1, 0.12: 5}
    assert "6 certified" in found._repr_html_() and "sag_limit" in found._repr_html_()
    with pytest.raises(TypeError, match="words"):
        found.numbers("status")


def test_studies_that_cannot_be_worked_on(study: Path, tmp_path: Path) -> None:
    ribopt.sweep(study, out=tmp_path / "out")
    study.write_text(STUDY.replace("count = 5", "count = 4"))
    with pytest.raises(ribopt.StudyError, match="--fresh"):
        ribopt.sweep(study, out=tmp_path / "out")
    assert len(ribopt.sweep(study, out=tmp_path / "out", fresh=True)) == 8
    study.write_text(STUDY.replace("sag_limit", "sag_limits"))
    with pytest.raises(ribopt.InputError) as caught:
        ribopt.sweep(study, out=tmp_path / "third")
    assert caught.value.mistakes[0].help

    def stop(done: int, of: int) -> None:
        raise LookupError(f"{done} of {of}")

    study.write_text(STUDY)
    with pytest.raises(LookupError):
        ribopt.sweep(study, out=tmp_path / "stopped", jobs=1, on_progress=stop)
    assert len(ribopt.sweep(study, out=tmp_path / "stopped")) == 10 and os.listdir(tmp_path / "stopped")

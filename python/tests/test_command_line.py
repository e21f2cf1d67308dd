"""Every bundled problem: the package finds what the command line prints. And the command line comes along."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
import ribopt
from conftest import PROBLEMS


def without_times(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: without_times(item) for key, item in value.items() if key != "seconds"}
    return [without_times(item) for item in value] if isinstance(value, list) else value


@pytest.mark.parametrize("name", sorted(path.name for path in PROBLEMS.glob("*.toml")))
def test_the_package_finds_what_the_command_line_prints(name: str, tmp_path: Path) -> None:
    file = str(PROBLEMS / name)
    command = [sys.executable, "-m", "ribopt", "solve", file, "--json", "--quiet", "--out", str(tmp_path / "out")]
    # Side by side: some take long.
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        result = ribopt.load(file).solve()
        printed, told = process.communicate()
    assert process.returncode == 0, told
    assert result.is_certified
    assert without_times(json.loads(printed)) == without_times(result.raw)
    assert ribopt.Result.read(tmp_path / "out").raw == json.loads(printed)


def test_an_analysis_is_what_the_command_line_prints() -> None:
    file = str(PROBLEMS / "ten-bar-truss.toml")
    command = [sys.executable, "-m", "ribopt", "analyse", file, "--json", "--gradient"]
    printed = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    assert ribopt.analyse(file, gradient=True).raw == json.loads(printed)


def test_exit_codes_and_mistakes_are_the_programs(tmp_path: Path) -> None:
    bad = tmp_path / "bad.toml"
    bad.write_text('minimize = "x"\n')
    script = Path(sys.executable).with_name("ribopt")
    done = subprocess.run([script, "check", bad, "--json"], capture_output=True, text=True)
    assert done.returncode == 2 and "unknown name `x`" in done.stderr
    assert json.loads(done.stdout)["status"] == "invalid-input"
    version = subprocess.run([sys.executable, "-m", "ribopt", "--version"], capture_output=True, text=True, check=True)
    assert version.stdout.startswith(f"ribopt {ribopt.__version__}\n")

"""Two runs at once, and Ctrl-C."""

from __future__ import annotations

import signal
import subprocess
import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor

import pytest
import ribopt
from conftest import PROBLEMS


def test_two_threads_solve_at_once_and_find_the_same() -> None:
    problem = ribopt.load(PROBLEMS / "ten-bar-truss.toml")
    alone = problem.solve()
    together = threading.Barrier(2, timeout=60)

    def solve() -> ribopt.Result:
        first = iter([together.wait])
        # Both runs are within their first iteration at the same time, or this would time out.
        return problem.solve(on_iteration=lambda _: next(first, lambda: None)())

    with ThreadPoolExecutor(2) as pool:
        found = [run.result() for run in [pool.submit(solve), pool.submit(solve)]]
    for result in found:
        assert result.objective == alone.objective and (result.x == alone.x).all()


def test_the_interpreter_goes_on_while_a_run_does() -> None:
    problem, count, done = ribopt.load(PROBLEMS / "vault.toml"), 0, threading.Event()

    def run() -> None:
        problem.solve(max_seconds=2)
        done.set()

    thread = threading.Thread(target=run)
    thread.start()
    while not done.wait(0.01):
        count += 1
    thread.join()
    assert count >= 10


LONG = f"""
import sys, time, ribopt
problem = ribopt.load({str(PROBLEMS / "ten-bar-truss.toml")!r})
begun = []
def seen(iteration):
    if not begun:
        begun.append(True)
        print("running", flush=True)
try:
    problem.solve(on_iteration=seen, starts=1_000_000)
except ribopt.Interrupted as interrupted:
    assert isinstance(interrupted, KeyboardInterrupt)
    print(interrupted.result.status, len(interrupted.result.x), flush=True)
    sys.exit(7)
"""


@pytest.mark.skipif(sys.platform == "win32", reason="signals to other processes are POSIX's")
def test_ctrl_c_ends_a_run_with_what_it_has_found() -> None:
    with subprocess.Popen([sys.executable, "-c", LONG], stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None and process.stdout.readline() == "running\n"
        sent = time.monotonic()
        process.send_signal(signal.SIGINT)
        told, _ = process.communicate(timeout=60)
    assert process.returncode == 7 and told.split()[1] == "10", told
    assert time.monotonic() - sent < 20


def test_ctrl_c_ends_the_command_line_as_the_program() -> None:
    command = [sys.executable, "-m", "ribopt", "solve", "-", "--json"]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as process:
        time.sleep(1.0)  # it waits for the file
        process.send_signal(signal.SIGINT)
        assert process.wait(timeout=30) == 5

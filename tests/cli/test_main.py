import os
import subprocess
import sys
from collections.abc import Callable
from importlib.metadata import version
from pathlib import Path
from typing import Any

import pytest

HEAVY = ("cv2", "matplotlib", "numba", "numpy", "rosbags", "scipy", "yaml")


def run_ial(code: str, *arguments: str) -> "subprocess.CompletedProcess[str]":
    """Run the command in a process of its own, after some code."""
    program = f"{code}\nimport sys\nfrom ial.cli.entry import main\nsys.argv = ['ial', *sys.argv[1:]]\nmain()"
    return subprocess.run(
        [sys.executable, "-c", program, *arguments], capture_output=True, text=True, check=False, env={**os.environ, "TERM": "dumb"}
    )


def test_version(ial: Callable[..., Any]) -> None:
    result = ial("--version")
    assert (result.exit_code, result.stdout) == (0, f"ial {version('ial')}\n")


@pytest.mark.parametrize(
    "command",
    [
        [],
        ["localize"],
        ["info"],
        ["convert"],
        ["kidnap"],
        ["bounds"],
        ["where"],
        ["simulate"],
        ["replay"],
        ["stream"],
        ["warm"],
        ["map"],
        ["map", "info"],
    ],
)
def test_help(ial: Callable[..., Any], command: list[str]) -> None:
    result = ial(*command, "--help")
    assert (result.exit_code, result.stderr) == (0, "")
    assert " ".join(["ial", *command])[4:] in result.stdout


def test_help_imports_nothing_heavy() -> None:
    code = f"""
import atexit, sys
atexit.register(lambda: print('heavy:', *(name for name in {HEAVY} if name in sys.modules)))
"""
    done = run_ial(code, "localize", "--help")
    assert (done.returncode, done.stdout.splitlines()[-1]) == (0, "heavy:")


@pytest.mark.parametrize(
    "arguments", [["nonsense"], ["localize", "--nonsense"], ["localize", "--every", "0"], ["map", "nonsense"], ["info"]]
)
def test_wrong_usage_is_status_2(ial: Callable[..., Any], arguments: list[str]) -> None:
    result = ial(*arguments)
    assert result.exit_code == 2
    assert "Usage: " in result.stderr
    assert "Traceback" not in result.stderr


def test_an_interruption_is_status_130_and_leaves_nothing(ial: Callable[..., Any], monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    from ial.results.lidar.enclosures import EnclosuresFile

    def interrupted(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(EnclosuresFile, "add", interrupted)
    result = ial("localize", "--out", "run", "--to", "3")
    assert (result.exit_code, result.stdout) == (130, "")
    assert result.stderr.splitlines()[-1] == "interrupted: nothing was written"
    assert list(tmp_path.iterdir()) == []


@pytest.mark.slow
def test_another_rounding_mode_is_refused(tmp_path: Path) -> None:
    upward = 0x800  # FE_UPWARD, in which codac leaves the processor
    code = f"""
import ctypes, ctypes.util, platform
import ial.contractors.rounding
assert platform.machine() == 'x86_64'
assert ctypes.CDLL(ctypes.util.find_library('m')).fesetround({upward}) == 0
"""
    if os.uname().machine != "x86_64":
        pytest.skip("the numbers of the rounding modes are those of x86-64")
    done = run_ial(code, "localize", "--out", str(tmp_path / "run"))
    lines = [line for line in done.stderr.splitlines() if not line.startswith("kernels: ")]
    assert (done.returncode, done.stdout, len(lines)) == (2, "", 1)
    assert lines[0].startswith("error: the processor does not round to nearest")
    assert not (tmp_path / "run").exists()

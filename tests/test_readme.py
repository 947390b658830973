"""The README's Python and a robot of one's own, as a user would check them: against the types that ial carries (``py.typed``)."""

import os
import re
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path

import pytest

README = Path(__file__).resolve().parent.parent / "README.md"
OWN_ROBOT = (README.parent / "tests" / "active" / "own_robot.py").read_text(encoding="utf-8")
SNIPPETS = re.findall(r"^```python\n(.*?)^```$", README.read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL)

needs_mypy = pytest.mark.skipif(find_spec("mypy") is None, reason="mypy is not installed; it comes with `make .venv/.lint`")


# As this project has it: what Numba's own annotations say is not true in compiled code.
SETTINGS = """[mypy]
strict = True
[mypy-numba.*,llvmlite.*]
follow_imports = skip
ignore_missing_imports = True
"""


def checked(folder: Path, code: str) -> str:
    """Return what mypy says of a program that lies outside of this project and finds ial as it finds any installed package."""
    (folder / "program.py").write_text(code, encoding="utf-8")
    (folder / "mypy.ini").write_text(SETTINGS, encoding="utf-8")
    command = [sys.executable, "-m", "mypy", "--config-file", "mypy.ini", "--cache-dir", "cache", "program.py"]
    environment = os.environ | {"PYTHONPATH": str(README.parent)}  # as site-packages: only with py.typed are its types believed
    return subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, check=False).stdout


def test_the_readme_has_snippets() -> None:
    assert len(SNIPPETS) == 2


@pytest.mark.slow
@needs_mypy
def test_the_snippets_are_well_typed_and_mypy_knows_the_types(tmp_path: Path) -> None:
    wrong = ["estimate.hypotheses[0].nonsense", "pave(ring, 3, precision=0.02)", "explore(OdometerBelief({}), own, planner)"]
    other = "from ial.odometer import OdometerBelief\nown: OwnRobot\nplanner: TwoStagePlanner\n"
    lines = "\n".join([OWN_ROBOT, *SNIPPETS, other, *wrong]).splitlines()
    said = [line for line in checked(tmp_path, "\n".join(lines) + "\n").splitlines() if line.startswith("program.py:")]
    errors = [line for line in said if ": error:" in line]
    errors = list({line.split(":")[1]: line for line in reversed(errors)}.values())[::-1]  # the first of each line
    assert [line.split(":")[1] for line in errors] == [str(len(lines) - 2), str(len(lines) - 1), str(len(lines))], said
    assert '"Hypothesis" has no attribute "nonsense"' in errors[0]
    assert "[arg-type]" in errors[1]
    assert 'of "explore"' in errors[2], "a lidar is no odometer"

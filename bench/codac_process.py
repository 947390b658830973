"""codac in a process of its own: the rounding mode that it leaves behind must not reach the process that ial computes in."""

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

VERSION = "2.1.2"
FOLDER = Path(sys.prefix) / f"codac-{VERSION}"
# Its one dependency is a viewer that nothing here draws with.
INSTALL = [
    sys.executable,
    "-m",
    "pip",
    "install",
    "--quiet",
    "--no-deps",
    "--only-binary",
    ":all:",
    "--target",
    str(FOLDER),
    f"codac=={VERSION}",
]


class CodacMissingError(Exception):
    """codac could not be installed; the text says why, and what to do."""


def install() -> None:
    """Install codac into a folder of its own beside the environment, where no other program finds it, unless it is there.

    Raises
    ------
    CodacMissingError
        If it cannot be had.
    """
    if (FOLDER / f"codac-{VERSION}.dist-info").is_dir():
        return
    done = subprocess.run(INSTALL, capture_output=True, text=True, check=False)
    if done.returncode:
        reason = (done.stderr.strip() or "pip failed").splitlines()[-1]
        raise CodacMissingError(f"codac {VERSION} cannot be installed ({reason}). Install it by hand: {' '.join(INSTALL)}")


def codac(task: str, **arguments: Any) -> dict[str, Any]:
    """Run a task of `codac_side.py` in a new process that alone sees codac; return what it measured.

    Raises
    ------
    CodacMissingError
        If codac does not run.
    """
    command = [sys.executable, str(Path(__file__).with_name("codac_side.py")), task]
    environment = os.environ | {"PYTHONPATH": str(FOLDER)}
    done = subprocess.run(command, input=json.dumps(arguments), capture_output=True, text=True, check=False, env=environment)
    if done.returncode:
        reason = (done.stderr.strip() or f"it ended with status {done.returncode}").splitlines()[-1]
        raise CodacMissingError(f"codac {VERSION} fails at {task!r}: {reason}. To install it anew, delete {FOLDER}")
    result: dict[str, Any] = json.loads(done.stdout)
    return result

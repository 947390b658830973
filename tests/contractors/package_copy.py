"""`PackageCopy`: what kernels need of ial, copied to where a test may change it, with a small module of kernels."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
_KERNELS = (
    "interpreter",
    "kernels",
    "kernel_cache",
    "kernel_compiler",
    "kernel_folder",
    "kernel_sources",
    "prebuilt_kernels",
    "private_folder",
)
_NEEDED = ("__init__.py", *(f"{name}.py" for name in _KERNELS))
_TINY = """
from numba import types

from ial.constant import STEP
from ial.contractors.kernels import callback, kernel


@kernel
def step(x):
    return x + STEP


@kernel
def twice(x):
    return step(step(x))


def double(x, result):
    result[0] = 2.0 * twice(x)


loop = callback(double, types.float64, types.CPointer(types.float64))
"""
USE = """
import ctypes
from ial.tiny import loop, step, twice
doubled = ctypes.c_double()
loop.ctypes(1.0, ctypes.byref(doubled))
print(step(1.0), twice(1.0), doubled.value)
"""
RESULT = "2.0 3.0 6.0"


class PackageCopy:
    """The module ``ial.tiny``, its step in ``ial.constant``, and processes that use it."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.package = folder / "ial"
        self.home = folder / "home"
        self.constant = self.package / "constant.py"
        for inner in (self.home, self.package, self.package / "contractors"):
            inner.mkdir(0o755)
        for name in _NEEDED:
            shutil.copy(ROOT / "contractors" / name, self.package / "contractors")
        for name in ("__init__.py", "lazy.py"):
            shutil.copy(ROOT / "ial" / name, self.package)
        self.constant.write_text("STEP = 1.0\n")
        (self.package / "tiny.py").write_text(_TINY)

    @property
    def kept(self) -> list[Path]:
        """The files of the compiled kernels, wherever they are."""
        return sorted(self.folder.rglob("*.kernel"))

    def start(self, script: str = USE, **variables: str) -> "subprocess.Popen[str]":
        others = ("IAL_CACHE_DIR", "XDG_CACHE_HOME", "NUMBA_DISABLE_JIT", "COVERAGE_PROCESS_CONFIG")  # a copy is not what coverage measures
        environment = {name: value for name, value in os.environ.items() if name not in others}
        environment |= {"PYTHONPATH": str(self.folder), "HOME": str(self.home), **variables}
        lines = f"import ial\nassert ial.__file__.startswith({str(self.folder)!r})\n{script}"
        command = [sys.executable, "-c", lines]
        return subprocess.Popen(command, env=environment, cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)

    def use(self, script: str = USE, **variables: str) -> tuple[str, list[str]]:
        """Return what a process printed, by default what it computed, and the lines of its complaints."""
        process = self.start(script, **variables)
        out, complaints = process.communicate(timeout=100)
        assert process.returncode == 0, complaints
        return out.strip(), complaints.splitlines()

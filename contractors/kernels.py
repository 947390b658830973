"""Compilation of kernels with Numba, and the folder in which compiled code is kept.

Numba notices a change in the file of a kernel, but not in a kernel that it calls from another file. Compiled code is therefore kept in a
folder that is named after a hash of all of ial's kernel sources: any change moves to a fresh folder, and nothing stale is ever run.
"""

import functools
import hashlib
import logging
import os
import shutil
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numba
from numba.core.caching import FunctionCache, _CacheLocator
from numba.core.ccallback import CFunc

logger = logging.getLogger("ial.kernels")

_PACKAGE = Path(__file__).resolve().parent
_MARK = b"ial.contractors.kernels import"  # every file that defines a kernel has this
_KEPT = 4  # folders of earlier sources that stay, so that two checkouts or branches do not evict each other


def source_files() -> list[Path]:
    """Return the files of ial that define kernels, sorted by path."""
    import ial

    roots = {_PACKAGE, *(Path(ial.__path__[0]) / name for name in ("contractors", "maps", "datasets", ""))}
    files = {file.resolve() for root in roots for file in root.rglob("*.py")}
    return sorted(file for file in files if _MARK in file.read_bytes() or file == Path(__file__).resolve())


@functools.cache
def source_hash() -> str:
    """Return a hash of the text of all kernel sources."""
    digest = hashlib.sha256()
    for file in source_files():
        digest.update(file.name.encode())
        digest.update(file.read_bytes())
    return digest.hexdigest()[:16]


def _writable(folder: Path) -> bool:
    try:
        folder.mkdir(parents=True, exist_ok=True)
        tempfile.TemporaryFile(dir=folder).close()
    except OSError:
        return False
    return True


@functools.cache
def cache_folder() -> Path:
    """Return the folder of the compiled kernels: ``$IAL_CACHE_DIR``, else beside the code, else the user's cache folder."""
    home = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache")
    chosen = os.environ.get("IAL_CACHE_DIR")
    roots = [Path(chosen)] if chosen else [_PACKAGE / "__pycache__", home / "ial"]
    for root in roots:
        folder = root / f"kernels-{source_hash()}"
        if _writable(folder):
            _discard_old(root, folder)
            return folder
    return Path(tempfile.mkdtemp(prefix="ial-kernels-"))


def _discard_old(root: Path, current: Path) -> None:
    current.touch()
    folders = sorted(root.glob("kernels-*"), key=lambda folder: folder.stat().st_mtime)
    for folder in folders[:-_KEPT]:
        shutil.rmtree(folder, ignore_errors=True)


class _Locator(_CacheLocator):  # type: ignore[misc]
    """Places the code of one file in a subfolder of its own, since two files may share a name."""

    def __init__(self, file: str, line: int) -> None:
        self._file = Path(file).resolve()
        self._line = line

    def get_cache_path(self) -> str:
        name = hashlib.sha256(str(self._file).encode()).hexdigest()[:8]
        return str(cache_folder() / f"{self._file.stem}-{name}")

    def get_source_stamp(self) -> str:
        return hashlib.sha256(self._file.read_bytes()).hexdigest()

    def get_disambiguator(self) -> str:
        return str(self._line)

    @classmethod
    def from_function(cls, py_func: Callable[..., Any], py_file: str) -> "_Locator":
        locator = cls(py_file, py_func.__code__.co_firstlineno)
        locator.ensure_cache_path()
        return locator


class _Implementation(FunctionCache._impl_class):  # type: ignore[misc]
    _locator_classes = [_Locator]


class _Cache(FunctionCache):  # type: ignore[misc]
    _impl_class = _Implementation

    def _index_key(self, sig: Any, codegen: Any) -> Any:
        # The kernels that a function closes over are told apart by name; their code is part of the name of the folder.
        cells = tuple(f"{cell.cell_contents.__module__}.{cell.cell_contents.__qualname__}" for cell in self._py_func.__closure__ or ())
        return sig, codegen.magic_tuple(), cells

    def load_overload(self, sig: Any, target_context: Any) -> Any:
        found = super().load_overload(sig, target_context)
        if found is None:
            _announce()
        return found


@functools.cache
def _announce() -> None:
    logger.warning("compiling kernels, once (kept in %s)", cache_folder())


def callback(function: Callable[..., Any], *arguments: Any, keep: bool = True) -> Any:
    """Compile a function without a result, so that kernels can call it by its ``address`` without being compiled together with it.

    Parameters
    ----------
    function
        May close over kernels. Its ``__qualname__`` names it in the cache, so it must differ from those of the file's other callbacks.
    *arguments
        Numba's types of its arguments.
    keep
        Whether the compiled code is kept; only where all of it is ial's own, since only that is watched for changes.
    """
    compiled: Any = CFunc(function, (arguments, numba.types.void), {}, {"error_model": "numpy", "fastmath": False})
    if keep:
        compiled._cache = _Cache(function)
    compiled.compile()
    return compiled


def kernel(function: Callable[..., Any]) -> Any:
    """Compile a function of numbers and arrays; it runs without Python's lock, so threads can share the work.

    Floating-point semantics stay those of IEEE 754: no fastmath, and a division by zero gives an infinity.
    """
    dispatcher = compile_users(function)
    dispatcher._cache = _Cache(function)
    return dispatcher


def compile_users(function: Callable[..., Any]) -> Any:
    """Compile a function of a user, as `kernel` does; it is not kept, since its source is not watched for changes."""
    return numba.njit(nogil=True, error_model="numpy", fastmath=False, forceinline=True)(function)

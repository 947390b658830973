"""`KernelCache`: finds the compiled code of one kernel and keeps it, in the place of Numba's own cache.

Numba's has an index and numbered files for each function, all of them pickles that are read without a look at who wrote them or whether
they are whole, and two processes that compile at once can give one number to two codes. Here each file is named after what is in it.
"""

import hashlib
import logging
import pickle
from collections.abc import Callable
from typing import Any

from numba.core.caching import _Cache
from numba.core.compiler import CompileResult
from numba.core.serialize import dumps

from ial.contractors.kernel_folder import kernel_folder
from ial.contractors.kernel_sources import kernel_sources

logger = logging.getLogger("ial.kernels")

_announced = False


def _announce(text: str, *details: object) -> None:
    """Log once in a process that and why kernels are compiled: it takes minutes, and one line says enough."""
    global _announced
    if not _announced:
        _announced = True
        logger.warning(text, *details)


def _identity(function: Callable[..., Any]) -> tuple[object, ...]:
    """Return what tells a function from all others of these sources: where it stands, and the kernels that it closes over."""
    code = function.__code__
    cells = (cell.cell_contents.py_func for cell in function.__closure__ or ())
    return function.__module__, function.__qualname__, code.co_firstlineno, tuple(map(_identity, cells))


class KernelCache(_Cache):  # type: ignore[misc]
    """The compiled code of one function of ial, by the types of its arguments; Numba's interface of a cache.

    Parameters
    ----------
    function
        What is compiled. It may close over kernels, and over nothing else. Code of a function that is no part of ial is not kept, since
        nothing watches its source for changes.
    """

    def __init__(self, function: Callable[..., Any]) -> None:
        self._function = function
        self._watched = function.__module__ in kernel_sources().files
        self._reads = True

    @property
    def cache_path(self) -> str | None:
        """Where the code is kept."""
        path = kernel_folder().path
        return str(path) if self._watched and path else None

    def enable(self) -> None:
        """Do as by default."""
        self._reads = True

    def disable(self) -> None:
        """Compile anew from now on."""
        self._reads = False

    flush = disable

    def _name(self, types: Any) -> str:
        key = hashlib.sha256(repr((_identity(self._function), str(types))).encode()).hexdigest()
        return f"{self._function.__name__}-{key[:32]}.kernel"

    def load_overload(self, types: Any, target_context: Any) -> Any:
        """Return the code for arguments of such types, None if it has to be compiled."""
        target_context.refresh()
        if not self._watched or not self._reads:
            return None
        folder = kernel_folder()
        try:
            kept = folder.read(self._name(types))
            found = None if kept is None else _rebuild(kept, types, target_context)
        except Exception as error:  # whatever is wrong with what was kept: the source is there
            _announce("compiling kernels again, for what was kept cannot be used: %s", error)
            return None
        if found is None:
            nowhere = "at every start: no folder can keep them, IAL_CACHE_DIR may name one"
            _announce("compiling kernels, %s", f"once, that were not used before (to be kept in {folder.path})" if folder.path else nowhere)
        return found

    def save_overload(self, types: Any, result: Any) -> None:
        """Keep the code that was compiled for arguments of such types."""
        if not self._watched:
            return
        if result.library.has_dynamic_globals:
            raise TypeError(f"{self._function.__qualname__} was compiled to addresses of this process: give it large arrays as arguments")
        folder = kernel_folder()
        if kernel_sources().have_changed():
            folder.stop("the source of ial has changed since this program was started")
        if folder.keeps:
            folder.write(self._name(types), dumps((types, result._reduce())))


def _rebuild(kept: bytes, types: Any, target_context: Any) -> Any:
    kept_types, result = pickle.loads(kept)
    return CompileResult._rebuild(target_context, *result) if kept_types == types else None

"""`KernelCache`: finds the compiled code of one kernel and keeps it, in the place of Numba's own cache.

Numba's has an index and numbered files for each function, all of them pickles that are read without a look at who wrote them or whether
they are whole, and two processes that compile at once can give one number to two codes. Here each file is named after what its code follows
from: the function, the types of its arguments, and the text of every file of ial that can end in it.
"""

import hashlib
import logging
import pickle
from collections.abc import Callable, Iterator
from typing import Any

from numba import types
from numba.core.caching import _Cache
from numba.core.compiler import CompileResult
from numba.core.serialize import dumps
from numba.core.typing.templates import Signature

from ial.contractors.kernel_folder import kernel_folder
from ial.contractors.kernel_sources import kernel_sources
from ial.contractors.prebuilt_kernels import prebuilt_kernels

logger = logging.getLogger("ial.kernels")

# Types of arguments whose text tells all that code for them follows from.
_PLAIN = (types.Number, types.Boolean, types.Array, types.CPointer, types.Literal, types.Omitted, types.NoneType)

_announced = False


def _announce(text: str, *details: object) -> None:
    """Log once in a process that and why kernels are compiled: it takes minutes, and one line says enough."""
    global _announced
    if not _announced:
        _announced = True
        logger.warning(text, *details)


def _functions(function: Callable[..., Any]) -> Iterator[Callable[..., Any]]:
    """Yield a function and those of the kernels that it closes over, however deep."""
    yield function
    for cell in function.__closure__ or ():
        yield from _functions(cell.cell_contents.py_func)


def _identity(function: Callable[..., Any]) -> tuple[object, ...]:
    """Return what tells a function from all others of its sources: where it stands, and the kernels that it closes over."""
    code = function.__code__
    cells = (cell.cell_contents.py_func for cell in function.__closure__ or ())
    return function.__module__, function.__qualname__, code.co_firstlineno, tuple(map(_identity, cells))


def _origins(kind: Any) -> Iterator[str]:
    """Yield the modules, besides that of the function, that the code for arguments of a type follows from."""
    if isinstance(kind, types.BaseTuple):
        if isinstance(kind, types.BaseNamedTuple):
            yield kind.instance_class.__module__  # which says where its fields stand
        for part in kind:
            yield from _origins(part)
    elif not isinstance(kind, _PLAIN):
        yield str(kind)  # a function, say: nobody watches what it is made of


class KernelCache(_Cache):  # type: ignore[misc]
    """The compiled code of one function of ial, by the types of its arguments; Numba's interface of a cache.

    Parameters
    ----------
    function
        What is compiled. It may close over kernels, and over nothing else. Code is not kept if any of these is no part of ial, since
        nothing watches its source for changes.
    """

    def __init__(self, function: Callable[..., Any]) -> None:
        self._function = function
        self._modules = {part.__module__ for part in _functions(function)}
        self._watched = self._modules <= kernel_sources().files.keys()
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

    def _name(self, signature: Any) -> str:
        """Return what the code for such types is kept under."""
        arguments = signature.args if isinstance(signature, Signature) else signature
        modules = self._modules.union(*map(_origins, arguments))
        if unwatched := modules - kernel_sources().files.keys():
            raise TypeError(f"{self._function.__qualname__} was given {signature}: nothing watches the source of {', '.join(unwatched)}")
        decisive = _identity(self._function), str(signature), kernel_sources().hash(modules)
        return f"{self._function.__name__}-{hashlib.sha256(repr(decisive).encode()).hexdigest()[:32]}.kernel"

    def load_overload(self, signature: Any, target_context: Any) -> Any:
        """Return the code for arguments of such types, None if it has to be compiled."""
        target_context.refresh()
        if not self._watched or not self._reads:
            return None
        name = self._name(signature)
        try:
            for folder in (kernel_folder(), *prebuilt_kernels()):
                if (kept := folder.read(name)) is not None and (rebuilt := _rebuild(kept, signature, target_context)) is not None:
                    return rebuilt
        except Exception as error:  # whatever is wrong with what was kept: the source is there
            _announce("compiling kernels again, for what was kept cannot be used: %s", error)
            return None
        path = kernel_folder().path
        nowhere = "at every start: no folder can keep them, IAL_CACHE_DIR may name one"
        _announce("compiling kernels, %s", f"once, that were not used before (to be kept in {path})" if path else nowhere)
        return None

    def save_overload(self, signature: Any, result: Any) -> None:
        """Keep the code that was compiled for arguments of such types."""
        if not self._watched:
            return
        if result.library.has_dynamic_globals:
            raise TypeError(f"{self._function.__qualname__} was compiled to addresses of this process: give it large arrays as arguments")
        folder = kernel_folder()
        if kernel_sources().have_changed():
            folder.stop("the source of ial has changed since this program was started")
        if folder.keeps:
            result = result._replace(type_annotation="")  # long, and it names the folders of this machine
            folder.write(self._name(signature), dumps((signature, result._reduce())))


def _rebuild(kept: bytes, signature: Any, target_context: Any) -> Any:
    kept_signature, result = pickle.loads(kept)
    return CompileResult._rebuild(target_context, *result) if kept_signature == signature else None

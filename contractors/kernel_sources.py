"""`KernelSources`: the files that compiled kernels follow from, and the hash that names the folder of what was compiled from them.

Numba notices a change in the file of a kernel, but not in what that file takes from others: kernels, intrinsics, constants. So a change in
any file that can end in machine code must change the hash. A kernel sees nothing but the names of its own module, which are made there or
imported, and what it closes over, which is part of its key in the cache. Hence these files are all of them: every module that imports Numba
or llvmlite or ial's decorators of kernels, and every module of ial that one of these imports, directly or through others.

That is more than needed (the text of an error counts as well), but it needs no judgement. To take all of ial would be simpler still, but
then a change of the command line would cost a compilation of minutes.
"""

import functools
import hashlib
import os
import re
import sys
from collections.abc import Set
from pathlib import Path

import llvmlite
import numba
import numpy as np
from numba.core import config
from numba.core.registry import cpu_target

# Imports are found by their look: syntax trees of all files cost 0.2 s, this 0.01 s, and every start pays it. A test compares the two. A
# newline to begin with lets the search skip from line to line, three times as fast as one for the beginning of a line.
_COMPILES = re.compile(rb"\n[ \t]*(?:from|import)[ \t]+(?:numba|llvmlite|ial\.contractors\.kernels)\b")
_IMPORT = re.compile(rb"\n[ \t]*(?:from|import)[ \t]+(ial(?:\.\w+)+)(?:[ \t]+import[ \t]+(\([^)]*\)|[^\n#]*))?")


class KernelSources:
    """The files of ial that can end in machine code.

    Parameters
    ----------
    package
        The folder of the package.

    Attributes
    ----------
    files
        The files, by the names of their modules.
    hash
        16 digits that follow from all that decides what the kernels become: the text of the files, the versions of Python, NumPy, Numba and
        llvmlite, Numba's settings, and the processor's name and features.
    """

    def __init__(self, package: Path) -> None:
        texts = _texts(package)
        self.files = {module: texts[module][0] for module in sorted(_closure({module: text for module, (_, text) in texts.items()}))}
        digest = hashlib.sha256(repr(_compiler()).encode())
        for module in self.files:
            text = texts[module][1]
            digest.update(f"\0{module} {len(text)}\0".encode() + text)
        self.hash = digest.hexdigest()[:16]
        self._written = self._last_written()

    def _last_written(self) -> list[tuple[int, int]]:
        states = (file.stat() for file in self.files.values())
        return [(state.st_mtime_ns, state.st_size) for state in states]

    def have_changed(self) -> bool:
        """Return whether a file was written to since it was hashed: a module that is imported later is then not the one of the hash."""
        try:
            return self._last_written() != self._written
        except OSError:
            return True


def _texts(package: Path) -> dict[str, tuple[Path, bytes]]:
    """Return the file and the text of every module of ial, also of those in folders that are links, as in a checkout."""
    found = {}
    for folder, _, names in os.walk(package, followlinks=True):
        parts = ("ial", *Path(folder).relative_to(package).parts)
        for file in (Path(folder, name) for name in names if name.endswith(".py")):
            module = parts if file.stem == "__init__" else (*parts, file.stem)
            found[".".join(module)] = file, file.read_bytes()
    return found


def imported(text: bytes, modules: Set[str]) -> set[str]:
    """Return which of the modules a source imports, anywhere in it; ``from a import b`` imports module a.b if there is one, else a."""
    found = set()
    for source, names in _IMPORT.findall(b"\n" + text):
        deeper = [b".".join((source, name)).decode() for name in re.findall(rb"\w+", names)] or [source.decode()]
        found |= {name if name in modules else source.decode() for name in deeper}
    return found & modules


def _closure(texts: dict[str, bytes]) -> set[str]:
    reached = {module for module, text in texts.items() if _COMPILES.search(b"\n" + text)}
    todo = list(reached)
    while todo:
        new = imported(texts[todo.pop()], texts.keys()) - reached
        reached |= new
        todo += new
    return reached


def _compiler() -> tuple[object, ...]:
    """Return what decides, besides the sources, what they are compiled to."""
    settings = sorted((name, value) for name, value in os.environ.items() if name.startswith("NUMBA_"))
    processor = cpu_target.target_context.codegen().magic_tuple()  # what LLVM compiles for: the system, the processor, its features
    return sys.version, np.__version__, numba.__version__, llvmlite.__version__, processor, config.USING_SVML, settings


@functools.cache
def kernel_sources() -> KernelSources:
    """Return the sources of the running ial, as they were when the first kernel was declared."""
    return KernelSources(Path(sys.modules["ial"].__path__[0]))

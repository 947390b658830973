"""`KernelSources`: the files that compiled kernels follow from, and for each kernel a hash of those that it can follow from.

Numba notices a change in the file of a kernel, but not in what that file takes from others: kernels, intrinsics, constants, all of which it
compiles into the caller. So a change in any file that can end in the machine code of a kernel must change its hash. A kernel sees nothing
but the names of its own module, which are made there or imported, what it closes over, and the types of its arguments. Hence these files
are: the module of the kernel, those of the kernels that it closes over and of the classes of its arguments, and every module of ial that
one of these imports, directly or through others, anywhere in its text.

That is more than needed (the text of an error counts as well), but it needs no judgement. To take all of ial would be simpler still, but
then a comment in one file would cost a compilation of minutes.
"""

import functools
import hashlib
import os
import re
import sys
from collections.abc import Iterable, Set
from pathlib import Path

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
        The files, by the names of their modules: every module that imports Numba or llvmlite or ial's decorators of kernels, and every
        module of ial that one of these imports, directly or through others.
    """

    def __init__(self, package: Path) -> None:
        texts = _texts(package)
        self._imports: dict[str, set[str]] = {}
        todo = {module for module, (_, text) in texts.items() if _COMPILES.search(b"\n" + text)}
        while todo:
            module = todo.pop()
            self._imports[module] = imported(texts[module][1], texts.keys())
            todo |= self._imports[module] - self._imports.keys()
        self.files = {module: texts[module][0] for module in sorted(self._imports)}
        self._digests = {module: hashlib.sha256(texts[module][1]).hexdigest() for module in self._imports}
        self._written = self._last_written()

    def closure(self, modules: Iterable[str]) -> set[str]:
        """Return some of `files` with all that they import, directly or through others, by the names of their modules."""
        reached: set[str] = set()
        todo = set(modules)
        while todo:
            module = todo.pop()
            reached.add(module)
            todo |= self._imports[module] - reached
        return reached

    def hash(self, modules: Iterable[str]) -> str:
        """Return 64 digits that follow from the names and texts of the `closure` of some modules."""
        return _hash(self, frozenset(modules))

    def _last_written(self) -> list[tuple[int, int]]:
        states = (file.stat() for file in self.files.values())
        return [(state.st_mtime_ns, state.st_size) for state in states]

    def have_changed(self) -> bool:
        """Return whether a file was written to since it was hashed: a module that is imported later is then not the one of the hash."""
        try:
            return self._last_written() != self._written
        except OSError:
            return True


@functools.cache
def _hash(sources: KernelSources, modules: frozenset[str]) -> str:
    digests = [(module, sources._digests[module]) for module in sorted(sources.closure(modules))]
    return hashlib.sha256(repr(digests).encode()).hexdigest()


def _texts(package: Path) -> dict[str, tuple[Path, bytes]]:
    """Return the file and the text of every module of ial, also of those in folders that are links, as in a checkout."""
    texts = {}
    for folder, _, names in os.walk(package, followlinks=True):
        parts = ("ial", *Path(folder).relative_to(package).parts)
        for file in (Path(folder, name) for name in names if name.endswith(".py")):
            module = parts if file.stem == "__init__" else (*parts, file.stem)
            texts[".".join(module)] = file, file.read_bytes()
    return texts


def imported(text: bytes, modules: Set[str]) -> set[str]:
    """Return which of the modules a source imports, anywhere in it; ``from a import b`` imports module a.b if there is one, else a."""
    reached = set()
    for source, names in _IMPORT.findall(b"\n" + text):
        deeper = [b".".join((source, name)).decode() for name in re.findall(rb"\w+", names)] or [source.decode()]
        reached |= {name if name in modules else source.decode() for name in deeper}
    return reached & modules


@functools.cache
def kernel_sources() -> KernelSources:
    """Return the sources of the running ial, as they were when the first kernel was declared."""
    return KernelSources(Path(sys.modules["ial"].__path__[0]))

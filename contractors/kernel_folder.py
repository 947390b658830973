"""`KernelFolder`: where compiled kernels are kept, one file each.

It is named after the compiler, and its files after what they were compiled from (see `KernelCache`), so that nothing stale is ever run.
Nothing is read that another user could have written. It is never in the way: what cannot be read is compiled, and what cannot be written is
not kept.
"""

import contextlib
import functools
import hashlib
import logging
import os
import re
import shutil
import tempfile
from collections.abc import Iterator
from pathlib import Path

from ial.contractors.kernel_compiler import compiler_hash
from ial.contractors.private_folder import NotPrivateError, is_own, make_private, read_private

logger = logging.getLogger("ial.kernels")

_CHOSEN = "IAL_CACHE_DIR"
_NAME = re.compile(r"kernels-[0-9a-f]{16}")
_KEPT = 8  # folders of other compilers that stay: environments and processors that share a place must not evict each other
_KEPT_FILES = 4096  # in a folder: all kernels eight times, since checkouts and branches that share it must not evict each other either
_CHECKSUM = hashlib.sha256().digest_size


class KernelFolder:
    """A folder of compiled kernels.

    Parameters
    ----------
    path
        A private folder; None if there is none, then nothing is read and nothing kept.
    read_only
        Whether nothing is kept there.

    Attributes
    ----------
    keeps
        Whether all that was compiled is kept, as far as is known.
    """

    def __init__(self, path: Path | None, read_only: bool = False) -> None:
        self.path = path
        self.keeps = path is not None and not read_only
        self._is_tidy = False

    def read(self, name: str) -> bytes | None:
        """Return what was written under a name, None if nothing was.

        Raises
        ------
        OSError
            If it cannot be read, or others could have written it.
        ValueError
            If it is not what was written: a power cut tears files.
        """
        if self.path is None:
            return None
        try:
            kept = read_private(self.path / name)
        except FileNotFoundError:
            return None
        if kept[:_CHECKSUM] != hashlib.sha256(kept[_CHECKSUM:]).digest():
            raise ValueError(f"damaged: {self.path / name}")
        if self.keeps:
            with contextlib.suppress(OSError):  # what can only be read is good enough
                os.utime(self.path / name, follow_symlinks=False)
        return kept[_CHECKSUM:]

    def write(self, name: str, content: bytes) -> None:
        """Keep something under a name, in place of what was there; other processes see all of it or nothing. If it fails, `stop`."""
        if self.path is None or not self.keeps:
            return
        try:
            _replace(self.path / name, hashlib.sha256(content).digest() + content)
            if not self._is_tidy:  # once in a process
                self._is_tidy = True
                _discard_unused(self.path)
        except OSError as error:
            self.stop(f"{error.strerror}; {_CHOSEN} may name another folder")

    def stop(self, reason: str) -> None:
        """Keep nothing more in this process, and say so once."""
        if self.keeps:
            self.keeps = False
            logger.warning("compiled kernels are no longer kept in %s: %s", self.path, reason)


def _replace(file: Path, content: bytes) -> None:
    with tempfile.NamedTemporaryFile(dir=file.parent, delete=False) as temporary:  # its mode is 0600
        try:
            temporary.write(content)
            temporary.close()  # a full disk may show only now
            Path(temporary.name).replace(file)
        except BaseException:
            Path(temporary.name).unlink(missing_ok=True)
            raise


@functools.cache
def kernel_folder() -> KernelFolder:
    """Return the folder of this process: in ``$IAL_CACHE_DIR``, else beside the code if it is the user's own, else in the user's cache."""
    for place, was_asked_for in _places():
        try:
            return KernelFolder(_open(place))
        except OSError as error:
            # That a usual place cannot be written to is no news: the next one serves as well. That others can write to it is.
            if was_asked_for or isinstance(error, NotPrivateError):
                logger.warning("compiled kernels are not kept in %s: %s; %s may name a folder of your own", place, error, _CHOSEN)
    return KernelFolder(None)


def _places() -> Iterator[tuple[Path, bool]]:
    """Yield where the folder may be, and whether the user said so."""
    if chosen := os.environ.get(_CHOSEN):
        yield Path(chosen), True
    code = Path(os.path.realpath(__file__)).parent
    if is_own(code):
        yield code / "__pycache__", False
    if cache := _user_cache():
        yield cache / "ial", False


def _user_cache() -> Path | None:
    """Return the folder in which programs of this user keep what they can make anew; None if the user has no home."""
    chosen = Path(os.environ.get("XDG_CACHE_HOME", ""))
    if chosen.is_absolute():
        return chosen
    try:
        home = Path.home()
    except RuntimeError:  # neither HOME nor an entry in the list of users
        return None
    return home / ".cache" if home.is_absolute() else None


def _open(place: Path) -> Path:
    folder = Path(os.path.realpath(place), f"kernels-{compiler_hash()}")
    is_new = not folder.exists()
    make_private(folder)
    with contextlib.suppress(OSError):  # what can only be read is good enough
        folder.touch()
        if is_new:
            _discard_old(folder)
    return folder


def _discard_old(current: Path) -> None:
    """Remove the folders beside this one that were not used for longest; only such as this user made, for the place may be anywhere."""
    others = (entry for entry in os.scandir(current.parent) if _NAME.fullmatch(entry.name) and entry.is_dir(follow_symlinks=False))
    states = ((entry.stat(follow_symlinks=False), entry.path) for entry in others)
    old = sorted((state.st_mtime, path) for state, path in states if state.st_uid == os.geteuid() and path != str(current))
    for _, path in old[:-_KEPT]:
        shutil.rmtree(path, ignore_errors=True)


def _discard_unused(folder: Path) -> None:
    """Remove the files that were not used for longest: kernels of sources that are no more, and what a killed process left half-written."""
    used = []
    for entry in os.scandir(folder):
        with contextlib.suppress(FileNotFoundError):  # another process tidies up as well
            if entry.is_file(follow_symlinks=False):
                used.append((entry.stat(follow_symlinks=False).st_mtime_ns, entry.path))
    for _, path in sorted(used)[:-_KEPT_FILES]:
        Path(path).unlink(missing_ok=True)

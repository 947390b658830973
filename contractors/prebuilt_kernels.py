"""Compiled kernels that came with ial: in a wheel that ``make wheel`` has made, for the `PORTABLE` processors.

They are looked up, checked and loaded as those that ial keeps itself (see `KernelCache`), and only if none of these is there.
"""

import functools
import logging
import os
from pathlib import Path

from ial.contractors.kernel_compiler import portable_hash, usable_processors
from ial.contractors.kernel_folder import KernelFolder
from ial.contractors.private_folder import make_private

logger = logging.getLogger("ial.kernels")

_ignored = False


def ignore_prebuilt() -> None:
    """Use none of them from now on, so that kernels are compiled for the very processor that runs."""
    global _ignored
    _ignored = True


def prebuilt_kernels() -> tuple[KernelFolder, ...]:
    """Return the folders that came with ial and that this Python and this processor can use, the best first."""
    return () if _ignored else _folders()


@functools.cache
def _folders() -> tuple[KernelFolder, ...]:
    place = Path(os.path.realpath(__file__)).parent / "prebuilt-kernels"
    if not place.is_dir():
        return ()
    paths = [place / f"kernels-{portable_hash(processor)}" for processor in usable_processors()]
    paths = [path for path in paths if path.exists()]
    try:
        for path in paths:
            make_private(path)  # which checks one that exists
    except OSError as error:
        logger.warning("compiled kernels that came with ial are not used: %s", error)
        return ()
    return tuple(KernelFolder(path, read_only=True) for path in paths)

"""Folders and files that nobody but this user can change, judged as SSH judges those of its keys (``StrictModes`` of sshd).

Compiled code is run, and it is kept in pickles, which run what they say: whoever can write them can do anything as this user.
"""

import errno
import os
import stat
from pathlib import Path

_OTHERS = stat.S_IWGRP | stat.S_IWOTH


class NotPrivateError(PermissionError):
    """Another user could have changed a file or a folder, or can; ``filename`` and ``strerror`` say which and why."""

    def __init__(self, path: Path, reason: str) -> None:
        super().__init__(errno.EPERM, reason, str(path))

    def __str__(self) -> str:
        return f"{self.filename} {self.strerror}"


def _check(path: Path, state: os.stat_result, sticky: bool = False) -> None:
    """Raise unless a file or folder belongs to this user or root, and neither group nor others may write to it."""
    if state.st_uid not in (os.geteuid(), 0):
        raise NotPrivateError(path, f"belongs to another user (number {state.st_uid})")
    # In a sticky folder such as /tmp others can make new names, but neither rename nor remove what is ours.
    if state.st_mode & _OTHERS and not (sticky and state.st_mode & stat.S_ISVTX):
        raise NotPrivateError(path, f"can be written to by others (mode {stat.S_IMODE(state.st_mode):04o}; `chmod go-w` ends that)")


def _check_folder(folder: Path, sticky: bool = False) -> None:
    for place in (folder, *folder.parents):
        state = place.lstat()
        if not stat.S_ISDIR(state.st_mode):
            raise NotADirectoryError(errno.ENOTDIR, "not a folder", str(place))
        _check(place, state, sticky or place != folder)


def _make(folder: Path) -> None:
    if not os.path.lexists(folder):
        _make(folder.parent)
        _check_folder(folder.parent, sticky=True)
        folder.mkdir(mode=0o700, exist_ok=True)


def make_private(folder: Path) -> None:
    """Make a folder that only this user and root can change or replace; if it exists, check that it is one.

    Parameters
    ----------
    folder
        Absolute and without links. Where it and folders around it are missing, they are made with mode 0700.

    Raises
    ------
    OSError
        If it cannot be made. If it or a folder around it belongs to another user or can be written to by others, `NotPrivateError`; a
        sticky folder around it, such as ``/tmp``, is allowed.
    """
    _make(folder)
    _check_folder(folder)


def is_own(folder: Path) -> bool:
    """Return whether a folder, absolute and without links, belongs to this user and only this user and root can change or replace it."""
    try:
        _check_folder(folder)
    except OSError:
        return False
    return folder.lstat().st_uid == os.geteuid()


def read_private(file: Path) -> bytes:
    """Return what a file in a private folder holds.

    Raises
    ------
    OSError
        If there is none; if it is a link, or no file. If it belongs to another user or can be written to by others, `NotPrivateError`.
    """
    # Opened first and judged then, so that what is judged is what is read; a pipe must not make the opening wait.
    with open(file, "rb", opener=lambda name, flags: os.open(name, flags | os.O_NOFOLLOW | os.O_NONBLOCK)) as opened:
        state = os.fstat(opened.fileno())
        if not stat.S_ISREG(state.st_mode):
            raise NotPrivateError(file, "is not a file")
        _check(file, state)
        return opened.read()

"""Where a run writes when nobody says where: a stamped folder, and a link to the latest one."""

import contextlib
import os
import re
from datetime import datetime
from itertools import count
from pathlib import Path

from ial.cli.shell.terminal import remark, shown

_HOME = Path("out")
_LATEST = "latest"


def stamped_folder(recording: str) -> Path:
    """Return a folder that does not exist yet, named after a recording and the time."""
    name = re.sub(r"[^\w.-]+", "-", Path(recording).name.split(".")[0]).strip("-") or "run"
    stem = f"{name}-{datetime.now():%Y%m%d-%H%M%S}"
    candidates = (_HOME / (stem if number == 1 else f"{stem}-{number}") for number in count(1))
    return next(each for each in candidates if not each.exists())


def tell_replaced(folder: Path) -> None:
    """Say that results are in the place of those of an earlier run."""
    remark("note", f"{shown(folder)}: these results are in the place of those of an earlier run", "cyan")


def point_latest(folder: Path) -> None:
    """Let the link `latest` beside a folder lead to it; anything of that name that is no link to a neighbour is left alone."""
    link = folder.with_name(_LATEST)
    fresh = folder.with_name(f".{_LATEST}-{os.getpid()}")
    with contextlib.suppress(OSError):  # a file system without links has no latest
        if (link.is_symlink() and len(link.readlink().parts) == 1) or not os.path.lexists(link):
            fresh.symlink_to(folder.name)
            fresh.replace(link)

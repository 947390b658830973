"""What people see: results on stdout, everything else as single lines on stderr."""

import json
import logging
import os
import re
import warnings
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, TypeVar

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, SpinnerColumn, TextColumn, TimeElapsedColumn

Item = TypeVar("Item")

_CONTROL = re.compile(r"[\x00-\x08\x0b-\x1f\x7f-\x9f]")

out = Console(highlight=False, soft_wrap=True)
err = Console(stderr=True, highlight=False, soft_wrap=True)


def say(text: str = "") -> None:
    """Print a line of the result."""
    out.print(visible(text), markup=False)


def say_json(record: Any) -> None:
    """Print one JSON object."""
    print(json.dumps(record, indent=2, allow_nan=False, ensure_ascii=False))


def say_json_line(record: Any) -> None:
    """Print one JSON object in a line of its own, at once."""
    print(json.dumps(record, allow_nan=False, ensure_ascii=False), flush=True)


def remark(kind: str, text: str, style: str) -> None:
    """Print one line about the work, such as a warning."""
    err.print(f"[{style}]{kind}:[/{style}]", end=" ")
    err.print(visible(" ".join(text.split())), markup=False)


def visible(text: str) -> str:
    """Return a text with its control characters written out: names in files that come from elsewhere must not steer the terminal."""
    return _CONTROL.sub(lambda found: repr(found.group())[1:-1], text)


class _Remarks(logging.Handler):
    """Shows what ial logs."""

    def emit(self, record: logging.LogRecord) -> None:
        remark("note" if record.levelno < logging.WARNING else record.name.rpartition(".")[2], record.getMessage(), "cyan")


@contextmanager
def remarks() -> Iterator[None]:
    """Show warnings and log messages of ial as single lines while the block runs."""
    handler = _Remarks()
    logger = logging.getLogger("ial")
    propagate = logger.propagate
    logger.addHandler(handler)
    logger.propagate = False
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("always", UserWarning)
            warnings.showwarning = lambda message, *_, **__: remark("warning", str(message), "yellow")
            yield
    finally:
        logger.removeHandler(handler)
        logger.propagate = propagate


def _bar() -> Progress:
    columns = (SpinnerColumn(), TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn())
    return Progress(*columns, console=err, transient=True)


def progress(items: Iterable[Item], total: int | None, label: str) -> Iterator[Item]:
    """Yield the items, with a bar on stderr if that is a terminal."""
    if not err.is_terminal:
        yield from items
        return
    with _bar() as bar:
        yield from bar.track(items, total=total, description=label)


@contextmanager
def counting(label: str) -> Iterator[Callable[..., None]]:
    """Give a function that shows how many are done, and of how many if that is known, as a bar on stderr if that is a terminal."""
    if not err.is_terminal:
        yield lambda done, total=None: None
        return
    with _bar() as bar:
        task = bar.add_task(label, total=None)
        yield lambda done, total=None: bar.update(task, completed=done, total=total)


def shown(path: Path) -> str:
    """Return a path as short as it can be said from here."""
    relative = os.path.relpath(path)
    return str(path) if relative.startswith("..") else relative

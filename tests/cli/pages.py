"""Blocks of a page of the documentation, and whether its commands and its examples print what it says."""

import contextlib
import io
import re
import shlex
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

DOCS = Path(__file__).resolve().parents[2] / "docs"


def blocks(name: str, kind: str) -> list[str]:
    """The blocks of a page that are marked so."""
    return re.findall(rf"```{kind}\n(.*?)```", (DOCS / name).read_text(encoding="utf-8"), re.DOTALL)


def commands(name: str) -> Iterator[tuple[str, str]]:
    """The commands of a page, each with what the page says that it prints."""
    for entry in "".join(blocks(name, "console")).split("$ ")[1:]:
        command, _, printed = entry.partition("\n")
        yield command, printed


def check(name: str, ial: Callable[..., Any]) -> None:
    """Run the commands of a page, then its examples, one after the other."""
    for command, printed in commands(name):
        words = shlex.split(command)
        assert words[0] == "ial"
        assert ial(*words[1:]).stdout == printed, command
    names: dict[str, Any] = {}
    for code, printed in zip(blocks(name, "python"), blocks(name, "text"), strict=True):
        with contextlib.redirect_stdout(io.StringIO()) as output:
            exec(code, names)
        assert output.getvalue() == printed

"""The examples of a page: blocks of Python, each with the text that it prints. The documentation and the tests run the same ones."""

import contextlib
import io
import re
from pathlib import Path
from typing import Any, NamedTuple

PAGES = ("tutorial.md", "contractors.md", "robots.md", "developing/kernels.md", "developing/adding.md")

_HEADING = re.compile(r"^## .*$", re.MULTILINE)
_BLOCK = re.compile(r"^```python\n(?P<code>.*?)^```\n(?:\n(?:[^\n`][^\n]*\n\n)?```text\n(?P<printed>.*?)^```\n)?", re.MULTILINE | re.DOTALL)


class Example(NamedTuple):
    """A block of Python, and what the page says that it prints."""

    code: str
    printed: str
    line: int


def sections(page: Path) -> dict[str, list[Example]]:
    """Return the examples under each heading of the second level. Those of one section belong together; each section stands alone."""
    text = page.read_text(encoding="utf-8")
    headings = list(_HEADING.finditer(text))
    ends = [heading.start() for heading in headings[1:]] + [len(text)]
    pages: dict[str, list[Example]] = {}
    for heading, end in zip(headings, ends, strict=True):
        blocks = _BLOCK.finditer(text, heading.end(), end)
        examples = [Example(block["code"], block["printed"] or "", text.count("\n", 0, block.start("code"))) for block in blocks]
        if examples:
            pages[heading[0].removeprefix("## ")] = examples
    return pages


def run(page: Path, section: list[Example]) -> list[str]:
    """Run the examples of a section one after the other, in the current folder, and return what each prints."""
    names: dict[str, Any] = {}
    printed = []
    for example in section:
        code = compile("\n" * example.line + example.code, str(page), "exec")  # so that a traceback names the line of the page
        with contextlib.redirect_stdout(io.StringIO()) as output:
            exec(code, names)
        printed.append(output.getvalue())
    return printed

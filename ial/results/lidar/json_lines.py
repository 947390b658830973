"""`JsonLines`: a text file with one JSON object per line, each about one scan."""

import json
from collections.abc import Iterator
from contextlib import AbstractContextManager
from decimal import Decimal
from pathlib import Path
from types import TracebackType
from typing import Any

from ial.datasets.recording import Step
from ial.datasets.stamps import format_stamp


class JsonLines(AbstractContextManager["JsonLines"]):
    """An open file of JSON lines.

    Each line begins with the scan's ``stamp``, in seconds with nine decimals: more digits than a double holds, so read it as a decimal. All
    other numbers are written to their last bit.

    Parameters
    ----------
    path
        The file.
    """

    def __init__(self, path: Path) -> None:
        self._file = path.open("w", encoding="utf-8")

    def __repr__(self) -> str:
        return f"<{type(self).__name__}: {self._file.name}>"

    def write(self, step: Step, **record: Any) -> None:
        """Write what is to be said about a scan."""
        self._file.write(json_line(step, **record))

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        self._file.close()


def json_line(step: Step, **record: Any) -> str:
    """Return the line, with its end, of what is to be said about a scan."""
    rest = json.dumps({"index": step.index, **record}, allow_nan=False, ensure_ascii=False)
    return f'{{"stamp": {format_stamp(step.stamp_ns)}, {rest[1:]}\n'


def read_lines(path: str | Path) -> Iterator[dict[str, Any]]:
    """Yield the objects of a file of JSON lines; numbers with a decimal point are `Decimal`."""
    with Path(path).open(encoding="utf-8") as file:
        for line in file:
            yield json.loads(line, parse_float=Decimal)

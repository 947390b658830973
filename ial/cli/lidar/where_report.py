"""What `ial where` writes and says."""

from collections import Counter
from collections.abc import Iterator, Sequence
from contextlib import AbstractContextManager
from pathlib import Path
from types import TracebackType
from typing import Any

from ial.datasets.recording import Step
from ial.errors import ConfigError
from ial.lidar.atlas import Whereabouts
from ial.results.lidar.enclosures import hypothesis_record
from ial.results.lidar.json_lines import json_line
from ial.whole_file import whole_files


def named(paths: Sequence[Path]) -> dict[str, Path]:
    """Return the maps by names that tell them apart: that of the file where it does, else the whole path.

    Raises
    ------
    ConfigError
        If a map is given twice.
    """
    stems = Counter(path.stem for path in paths)
    by_name = {path.stem if stems[path.stem] == 1 else str(path): path for path in paths}
    if len(by_name) < len(paths):
        raise ConfigError("a map is given twice; give every map once")
    return by_name


class Lines(AbstractContextManager["Lines"]):
    """One line for each scan in a file, if one is wanted, and the outcome.

    Parameters
    ----------
    path
        The file, which appears when it is complete; None for none.
    """

    def __init__(self, path: Path | None) -> None:
        self._path = path
        self._text: list[str] = []
        self._since: dict[str, int | None] = {}
        self._scans = 0
        self.last: Whereabouts | None = None

    def add(self, step: Step, whereabouts: Whereabouts) -> None:
        """Take the answer to one scan."""
        self._scans += 1
        self.last = whereabouts
        for name, hypotheses in whereabouts.hypotheses.items():
            if hypotheses:
                self._since[name] = None
            elif self._since.get(name) is None:
                self._since[name] = step.index
        if self._path is not None:
            pose = whereabouts.pose
            self._text.append(
                json_line(
                    step,
                    status=whereabouts.status,
                    map=whereabouts.map,
                    pose=None if pose is None else {"x": pose.x, "y": pose.y, "theta": pose.theta},
                    outliers_allowed=whereabouts.outliers_allowed,
                    **({"vanishing": True} if whereabouts.vanishing else {}),
                    maps={name: [hypothesis_record(each) for each in hypotheses] for name, hypotheses in whereabouts.hypotheses.items()},
                    elapsed_s=whereabouts.elapsed_s,
                )
            )

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None) -> None:
        if kind is not None or self._path is None:
            return
        with whole_files(self._path) as (lent,):
            lent.write_text("".join(self._text), encoding="utf-8")

    def record(self) -> dict[str, Any]:
        """Return the outcome as plain values that JSON can hold."""
        last = self.last
        if last is None:
            return {"scans": 0}
        return {
            "scans": self._scans,
            "status": last.status,
            "map": last.map,
            "pose": None if last.pose is None else {"x": last.pose.x, "y": last.pose.y, "theta": last.pose.theta},
            "maps": {name: {"hypotheses": len(each), "impossible_since": self._since[name]} for name, each in last.hypotheses.items()},
        }

    def report(self) -> Iterator[str]:
        """Yield the outcome in words."""
        record = self.record()
        if record["map"] is not None:
            pose = record["pose"]
            yield f"in {record['map']}, at x {pose['x']:.2f} m, y {pose['y']:.2f} m, θ {pose['theta']:.2f} rad"
        else:
            yield f"after {record['scans']} scans: {record['status']}"
        for name, entry in record["maps"].items():
            count = entry["hypotheses"]
            words = (
                f"{count} {'hypothesis' if count == 1 else 'hypotheses'}" if count else f"impossible since scan {entry['impossible_since']}"
            )
            yield f"{name}: {words}"

"""`Enclosure`: what one scan left of the possible poses, as one line of ``enclosures.jsonl``."""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ial.datasets.recording import Step
from ial.datasets.stamps import parse_stamp
from ial.lidar.estimate import Estimate, Status
from ial.lidar.hypothesis import Hypothesis
from ial.pose import Pose
from ial.results.lidar.json_lines import JsonLines, json_line, read_lines


@dataclass(frozen=True)
class Enclosure:
    """One processed scan, in the map frame: an `Estimate` without its boxes.

    Parameters
    ----------
    stamp_ns
        Time of the scan, nanoseconds.
    index
        Number of the scan in the recording, from 0.
    status, hypotheses, pose, beams, outliers_allowed, uninformative, elapsed_s, radius_m, vanishing
        As in `Estimate`.
    limited
        Which limit made the answer coarser than asked for, "boxes" or "time"; None for none.
    """

    stamp_ns: int
    index: int
    status: Status
    hypotheses: tuple[Hypothesis, ...]
    pose: Pose | None
    beams: int
    outliers_allowed: int
    uninformative: bool
    limited: str | None
    elapsed_s: float
    radius_m: float | None = None
    vanishing: bool = False

    def __repr__(self) -> str:
        count = len(self.hypotheses)
        at = "" if self.pose is None else f" around {self.pose}"
        return f"<Enclosure of scan {self.index}: {self.status}, {count} {'hypothesis' if count == 1 else 'hypotheses'}{at}>"

    @classmethod
    def of(cls, step: Step, estimate: Estimate) -> "Enclosure":
        """Return what is kept of an estimate."""
        return cls(
            stamp_ns=step.stamp_ns,
            index=step.index,
            status=estimate.status,
            hypotheses=estimate.hypotheses,
            pose=estimate.pose,
            beams=estimate.beams,
            outliers_allowed=estimate.outliers_allowed,
            uninformative=estimate.uninformative,
            limited=estimate.limited or None,
            elapsed_s=estimate.elapsed_s,
            radius_m=estimate.radius_m,
            vanishing=estimate.vanishing,
        )


class EnclosuresFile(JsonLines):
    """``enclosures.jsonl``, one line per processed scan.

    A line holds ``stamp``, ``index``, ``status``, ``hypotheses``, ``pose`` (null unless localized), ``beams``, ``outliers_allowed``,
    ``uninformative`` and ``vanishing`` where they are true, ``limited`` (null, "boxes" or "time"), ``radius_m`` (null unless localized) and
    ``elapsed_s``. A hypothesis has its bounds ``x``, ``y``, ``theta`` as [lower, upper], ``boxes``, ``volume``, ``spare_beams`` where they
    are known, and ``prediction`` where it is true.

    Parameters
    ----------
    path
        The file.
    """

    def add(self, step: Step, estimate: Estimate) -> None:
        """Write the line of one scan."""
        self._file.write(enclosure_line(step, estimate))


def enclosure_line(step: Step, estimate: Estimate, *, timed: bool = True) -> str:
    """Return the line of one scan; without ``elapsed_s`` if it shall be the same each time."""
    pose = estimate.pose
    return json_line(
        step,
        status=estimate.status,
        hypotheses=[hypothesis_record(each) for each in estimate.hypotheses],
        pose=None if pose is None else {"x": pose.x, "y": pose.y, "theta": pose.theta},
        beams=estimate.beams,
        outliers_allowed=estimate.outliers_allowed,
        **({"uninformative": True} if estimate.uninformative else {}),
        **({"vanishing": True} if estimate.vanishing else {}),
        limited=estimate.limited or None,
        radius_m=estimate.radius_m,
        **({"elapsed_s": estimate.elapsed_s} if timed else {}),
    )


def hypothesis_record(hypothesis: Hypothesis) -> dict[str, Any]:
    """Return a hypothesis as plain values that JSON can hold."""
    record = {name: getattr(hypothesis, name) for name in ("x", "y", "theta", "boxes", "volume")}
    if hypothesis.spare_beams is not None:
        record["spare_beams"] = hypothesis.spare_beams
    return {**record, "prediction": True} if hypothesis.prediction else record


def read_enclosures(path: str | Path) -> Iterator[Enclosure]:
    """Yield the lines of an ``enclosures.jsonl``, with every number as it was written, to the last bit."""
    for line in read_lines(path):
        at = line["pose"]
        yield Enclosure(
            stamp_ns=parse_stamp(str(line["stamp"])),
            index=line["index"],
            status=line["status"],
            hypotheses=tuple(_parsed(each) for each in line["hypotheses"]),
            pose=None if at is None else Pose(float(at["x"]), float(at["y"]), float(at["theta"])),
            beams=line["beams"],
            outliers_allowed=line["outliers_allowed"],
            uninformative=line.get("uninformative", False),
            limited=line["limited"],
            elapsed_s=float(line["elapsed_s"]),
            radius_m=None if line.get("radius_m") is None else float(line["radius_m"]),
            vanishing=line.get("vanishing", False),
        )


def _parsed(record: dict[str, Any]) -> Hypothesis:
    x, y, theta = ((float(record[name][0]), float(record[name][1])) for name in ("x", "y", "theta"))
    return Hypothesis(x, y, theta, record["boxes"], float(record["volume"]), record.get("prediction", False), record.get("spare_beams"))

"""`Checkpoint`: all that a localizer has learned, in a file, so that a run that was stopped goes on as if it had not been."""

import hashlib
import io
import json
import zipfile
import zlib
from dataclasses import asdict, dataclass
from importlib.metadata import version
from pathlib import Path
from typing import get_args

import numpy as np

from ial.contractors.boxes import Boxes
from ial.contractors.paving.limits import Limit
from ial.datasets.mark import Mark
from ial.datasets.odometry import Odometry
from ial.errors import RecordingError
from ial.lidar.localizer import Localizer
from ial.lidar.output_end import OutputEnd
from ial.lidar.pose_set import PoseSet
from ial.whole_file import rewrite

_FORM = "ial checkpoint 4"


@dataclass(frozen=True, eq=False)
class Checkpoint:
    """What is needed to go on after a scan.

    Parameters
    ----------
    mark
        The last processed scan.
    poses
        The set of poses after it, in the grid's frame.
    output
        The file of the answers and the line of that scan, which may be missing there; None if there is no such file.
    fingerprint
        Of the localizer; see `fingerprint`.
    """

    mark: Mark
    poses: PoseSet
    output: OutputEnd | None
    fingerprint: str

    def save(self, path: Path) -> None:
        """Write the file; a process that dies meanwhile leaves the one before.

        Raises
        ------
        OutputError
            If it cannot be written.
        """
        poses = self.poses
        about = {
            "form": _FORM,
            "index": self.mark.index,
            "stamp_ns": self.mark.stamp_ns,
            "odometry": asdict(self.mark.odometry),
            "raised_ns": self.mark.raised_ns,
            "behind_ns": self.mark.behind_ns,
            "output": None if self.output is None else asdict(self.output),
            "fingerprint": self.fingerprint,
            "limited": poses.limited,
            "outliers": poses.outliers,
            "accepted": poses.accepted,
        }
        content = io.BytesIO()
        text = np.frombuffer(json.dumps(about).encode(), dtype=np.uint8)
        np.savez(content, about=text, lower=poses.boxes.lower, upper=poses.boxes.upper, unconfirmed=poses.unconfirmed, bad=poses.bad)
        rewrite(path, content.getbuffer(), "the state")

    @classmethod
    def load(cls, path: Path, localizer: Localizer) -> "Checkpoint | None":
        """Read the file; None if there is none.

        Raises
        ------
        RecordingError
            If it is damaged, or belongs to another map, start or configuration.
        """
        try:
            with path.open("rb") as file, np.load(file, allow_pickle=False) as content:
                about = json.loads(content["about"].tobytes())
                if about["form"] != _FORM or about["limited"] not in get_args(Limit):
                    raise ValueError("not this form")
                boxes, unconfirmed, bad = Boxes(content["lower"], content["upper"]), content["unconfirmed"], content["bad"]
                if unconfirmed.dtype != np.bool_ or bad.dtype != np.int16 or not unconfirmed.shape == bad.shape == (len(boxes),):
                    raise ValueError("not this form")
                poses = PoseSet(
                    boxes,
                    unconfirmed,
                    limited=about["limited"],
                    bad=bad,
                    outliers=int(about["outliers"]),
                    accepted=None if about["accepted"] is None else int(about["accepted"]),
                ).checked()
            clock = int(about["raised_ns"]), int(about["behind_ns"])
            mark = Mark(int(about["index"]), int(about["stamp_ns"]), Odometry(**about["odometry"]), *clock)
            output = None if about["output"] is None else OutputEnd(**about["output"])
            checkpoint = cls(mark, poses, output, str(about["fingerprint"]))
        except FileNotFoundError:
            return None
        except OSError as error:
            raise RecordingError(f"{path}: the state cannot be read ({error.strerror or error}); check the path") from None
        except (ValueError, KeyError, TypeError, EOFError, OverflowError, NotImplementedError, zipfile.BadZipFile, zlib.error):
            raise RecordingError(
                f"{path}: no state that this version of ial has written, or a damaged one; give another file, or remove it to begin anew"
            ) from None
        if checkpoint.fingerprint != fingerprint(localizer):
            raise RecordingError(
                f"{path}: this state belongs to another map, configuration, start or version of ial; use those, or remove it to begin anew"
            )
        return checkpoint


def fingerprint(localizer: Localizer) -> str:
    """Return a text that differs where the map, the start, the configuration, or the version of ial differs."""
    grid, start = localizer.grid, localizer.start.boxes
    digest = hashlib.sha256(grid.cells.data)
    for bounds in (start.lower, start.upper):
        digest.update(bounds.data)
    digest.update(repr((grid.cells.shape, grid.resolution, grid.origin, localizer.config, version("ial"))).encode())
    return digest.hexdigest()[:32]

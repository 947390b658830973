"""`Checkpoint`: all that a localizer has learned, in a file, so that a run that was stopped goes on as if it had not been."""

import hashlib
import io
import json
import zipfile
from dataclasses import asdict, dataclass
from importlib.metadata import version
from pathlib import Path
from typing import get_args

import numpy as np

from ial.contractors.boxes import Boxes
from ial.contractors.paving.limits import Limit
from ial.datasets.odometry import Odometry
from ial.datasets.recording import Mark
from ial.errors import OutputError, RecordingError
from ial.lidar.localizer import Localizer
from ial.lidar.pose_set import PoseSet

_FORM = "ial checkpoint 2"


@dataclass(frozen=True, eq=False)
class Checkpoint:
    """What is needed to go on behind a scan.

    Parameters
    ----------
    mark
        The last processed scan.
    poses
        The set of poses behind it, in the grid's frame.
    written
        How many bytes of results had been written then.
    fingerprint
        Of the localizer; see `fingerprint`.
    """

    mark: Mark
    poses: PoseSet
    written: int
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
            "written": self.written,
            "fingerprint": self.fingerprint,
            "limited": poses.limited,
            "outliers": poses.outliers,
            "accepted": poses.accepted,
        }
        content = io.BytesIO()
        text = np.frombuffer(json.dumps(about).encode(), dtype=np.uint8)
        np.savez(content, about=text, lower=poses.boxes.lower, upper=poses.boxes.upper, carried=poses.carried, bad=poses.bad)
        temporary = path.with_name(f".{path.name}.part")
        try:
            temporary.write_bytes(content.getbuffer())
            temporary.replace(path)
        except OSError as error:
            temporary.unlink(missing_ok=True)
            raise OutputError(f"{path}: the state cannot be written ({error.strerror or error}); is the disk full?") from None

    @classmethod
    def load(cls, path: Path, localizer: Localizer) -> "Checkpoint | None":
        """Read the file; None if there is none.

        Raises
        ------
        RecordingError
            If it is damaged, or belongs to another map or configuration.
        """
        try:
            with path.open("rb") as file, np.load(file, allow_pickle=False) as content:
                about = json.loads(content["about"].tobytes())
                if about["form"] != _FORM or about["limited"] not in get_args(Limit):
                    raise ValueError("not this form")
                poses = PoseSet(
                    Boxes(content["lower"], content["upper"]),
                    content["carried"],
                    limited=about["limited"],
                    bad=content["bad"],
                    outliers=int(about["outliers"]),
                    accepted=None if about["accepted"] is None else int(about["accepted"]),
                )
            mark = Mark(int(about["index"]), int(about["stamp_ns"]), Odometry(**about["odometry"]))
            found = cls(mark, poses, int(about["written"]), str(about["fingerprint"]))
        except FileNotFoundError:
            return None
        except OSError as error:
            raise RecordingError(f"{path}: the state cannot be read ({error.strerror or error}); check the path") from None
        except (ValueError, KeyError, TypeError, EOFError, zipfile.BadZipFile):
            raise RecordingError(f"{path}: no state that ial has written, or a damaged one; remove it to begin anew") from None
        if found.fingerprint != fingerprint(localizer):
            raise RecordingError(
                f"{path}: this state belongs to another map, configuration or version of ial; use those, or remove it to begin anew"
            )
        return found


def fingerprint(localizer: Localizer) -> str:
    """Return a text that differs where the map, the configuration, or the version of ial differs."""
    grid = localizer.grid
    digest = hashlib.sha256(grid.cells.data)
    digest.update(repr((grid.cells.shape, grid.resolution, grid.origin, localizer.config, version("ial"))).encode())
    return digest.hexdigest()[:32]

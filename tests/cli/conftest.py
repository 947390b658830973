"""The command line, called in this process, and bad inputs made on the spot."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from typer.testing import CliRunner

from ial.cli.main import app
from ial.datasets.bag_writer import BagWriter
from ial.datasets.sample import sample_map_path, sample_recording_path
from ial.maps.grids.map_file import write_map
from ial.maps.grids.occupancy_grid import OCCUPIED, OccupancyGrid

SECOND = 10**9
SCAN = "sensor_msgs/msg/LaserScan"
TF = "tf2_msgs/msg/TFMessage"


@pytest.fixture(autouse=True)
def _alone(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """Run in an empty folder, without settings from outside."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("TERM", "dumb")
    monkeypatch.delenv("IAL_THREADS", raising=False)


@pytest.fixture
def ial() -> Callable[..., Any]:
    """Return a function that runs a command and gives its outcome."""

    def run(*arguments: object) -> Any:
        return CliRunner().invoke(app, [str(argument) for argument in arguments], catch_exceptions=False)

    return run


@pytest.fixture
def refused(ial: Callable[..., Any]) -> Callable[..., str]:
    """Return a function that runs a command which must end with exit status 2 and one line, and gives that line."""

    def run(*arguments: object) -> str:
        before = set(Path.cwd().rglob("*"))
        result = ial(*arguments)
        assert result.exit_code == 2
        assert result.stdout == ""
        (line,) = [line for line in result.stderr.splitlines() if not line.startswith(("warning: ", "kernels: "))]
        assert line.startswith("error: ")
        assert set(Path.cwd().rglob("*")) == before, "a refused run leaves nothing behind"
        return str(line.removeprefix("error: "))

    return run


@pytest.fixture
def sample() -> Path:
    return sample_recording_path()


@pytest.fixture
def sample_map() -> Path:
    return sample_map_path()


@pytest.fixture
def room(tmp_path: Path) -> Path:
    """The map of a room of 8 × 6 m, with something in it that tells its corners apart."""
    cells = np.zeros((60, 80), dtype=np.uint8)
    cells[[0, -1], :] = OCCUPIED
    cells[:, [0, -1]] = OCCUPIED
    cells[40:60, 60] = OCCUPIED
    cells[10:14, 20:30] = OCCUPIED
    path = tmp_path / "room.yaml"
    write_map(OccupancyGrid(cells, 0.1), path)
    return path


class Bag:
    """Writes a bag of a robot that drives straight on."""

    def __init__(self, path: Path, scans: int = 3) -> None:
        self.path = path
        self.scans = scans

    def write(
        self, topics: tuple[str, ...] = ("/scan",), odometry: bool = True, ranges: Any = (1.0, 2.0, 3.0), blank: Any = (), **changes: Any
    ) -> Path:
        """Write a scan and its odometry each second; the ranges of `blank` scans are NaN, and `changes` are fields of every scan."""
        with BagWriter(self.path) as bag:
            make = bag.message
            zero = make("geometry_msgs/msg/Vector3", x=0.0, y=0.0, z=0.0)
            turn = make("geometry_msgs/msg/Quaternion", x=0.0, y=0.0, z=0.0, w=1.0)
            at = make("geometry_msgs/msg/Transform", translation=zero, rotation=turn)
            fields = {"transform": at, "header": bag.header(SECOND, "base_link"), "child_frame_id": "laser"}
            mounting = make(TF, transforms=[make("geometry_msgs/msg/TransformStamped", **fields)])
            bag.write("/tf_static", TF, SECOND, mounting)
            for index in range(self.scans):
                stamp = (1 + index) * SECOND
                for topic in topics:
                    measured = np.full(len(ranges), np.nan if index in blank else 1.0, dtype=np.float32) * ranges
                    bag.write(topic, SCAN, stamp, self._scan(bag, stamp, measured, changes))
                if odometry:
                    self._odometry(bag, stamp, turn, zero)
        return self.path

    def _scan(self, bag: BagWriter, stamp: int, ranges: Any, changes: dict[str, Any]) -> Any:
        fields: dict[str, Any] = {
            "angle_min": -0.5,
            "angle_max": 0.5,
            "angle_increment": 0.5,
            "time_increment": 0.0,
            "scan_time": 0.0,
            "range_min": 0.1,
            "range_max": 10.0,
            "ranges": ranges.astype(np.float32),
            "intensities": np.empty(0, dtype=np.float32),
            **changes,
        }
        return bag.message(SCAN, header=bag.header(stamp, "laser"), **fields)

    def _odometry(self, bag: BagWriter, stamp: int, turn: Any, zero: Any) -> None:
        make, kind = bag.message, "nav_msgs/msg/Odometry"
        pose = make("geometry_msgs/msg/Pose", position=make("geometry_msgs/msg/Point", x=stamp / SECOND, y=0.0, z=0.0), orientation=turn)
        message = make(
            kind,
            header=bag.header(stamp, "odom"),
            child_frame_id="base_link",
            pose=make("geometry_msgs/msg/PoseWithCovariance", pose=pose, covariance=np.zeros(36)),
            twist=make(
                "geometry_msgs/msg/TwistWithCovariance",
                twist=make("geometry_msgs/msg/Twist", linear=zero, angular=zero),
                covariance=np.zeros(36),
            ),
        )
        bag.write("/odom", kind, stamp, message)


@pytest.fixture
def bag(tmp_path: Path) -> Bag:
    """A bag to write, with scans, odometry and mounting as a localizer wants them."""
    return Bag(tmp_path / "run.mcap")

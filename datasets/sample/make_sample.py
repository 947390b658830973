"""Makes the embedded sample from the MRPT demo: ``IAL_DATA=<folder> python -m ial.datasets.sample.make_sample``.

The result is the same, byte for byte, whenever the same versions of rosbags and OpenCV make it.
"""

import math
import os
import sys
from collections.abc import Iterator
from pathlib import Path

import cv2
import numpy as np

from ial.datasets.conversion import convert
from ial.datasets.in_memory import InMemoryRecording
from ial.datasets.odometry import Odometry
from ial.datasets.recording import Reading
from ial.datasets.sample import sample_map_path, sample_recording_path
from ial.datasets.scan import LaserScan, Mounting
from ial.datasets.stamps import parse_stamp
from ial.pose import Pose

_RANGE_MAX_M = 80.0
_BASIS = "Made from MRPT's localization demo (University of Málaga, 19 January 2006), BSD-3: see LICENSE-MRPT."


def _readings(log: Path) -> Iterator[Reading]:
    """Yield the scans; a beam without a return becomes +inf (REP-117)."""
    with np.load(log) as data:
        x, y, yaw = data["lidar_in_robot"].tolist()
        angles, mounting = data["angles"], Mounting(x, y, yaw)
        ranges = np.where(data["invalid"], np.float32(math.inf), data["ranges"])
        for index, (seconds, pose) in enumerate(zip(data["t"].tolist(), data["odom"].tolist(), strict=True)):
            stamp = parse_stamp(f"{seconds:.6f}")
            increment = (angles[-1] - angles[0]) / (len(angles) - 1)
            scan = LaserScan(stamp, ranges[index], angles[0], increment, range_max=_RANGE_MAX_M, mounting=mounting)
            yield Reading(index, stamp, Odometry.of(Pose(*pose)), scan)


def _make_map(yaml: Path) -> None:
    """Write the map's image as PNG and its YAML file beside it."""
    target = sample_map_path()
    source = yaml.with_suffix(".pgm")
    image = cv2.imread(str(source), cv2.IMREAD_UNCHANGED)
    if image is None:
        sys.exit(f"{source} cannot be read")
    cv2.imwrite(str(target.with_suffix(".png")), image, [cv2.IMWRITE_PNG_COMPRESSION, 9])
    text = yaml.read_text().replace(source.name, target.with_suffix(".png").name)
    target.write_text(f"# {_BASIS}\n{text}", encoding="utf-8")


def main() -> None:
    """Write sample.mcap, map.yaml and map.png into this folder."""
    if "IAL_DATA" not in os.environ:
        sys.exit("IAL_DATA is not set; set it to the folder of the test data")
    folder = Path(os.environ["IAL_DATA"]) / "mrpt_malaga"
    recording = InMemoryRecording("MRPT localization demo", _readings(folder / "log_for_map_demo.npz"))
    convert(recording, sample_recording_path())
    _make_map(folder / "map_demo.yaml")


if __name__ == "__main__":
    main()

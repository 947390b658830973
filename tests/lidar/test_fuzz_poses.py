"""No consistent pose is lost, whatever the robot undergoes; `bench/fuzz_poses.py` tries a hundred times as many.

What the fuzzer must see is planted here: a fuzzer that finds nothing has to be able to find something.
"""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

import ial.lidar.beams
from ial.contractors.boxes import Boxes
from ial.lidar import Localizer
from ial.lidar.beams import Beams
from ial.lidar.localizer import Estimate  # type: ignore[attr-defined]
from tests.lidar.box_index import BoxIndex
from tests.lidar.fuzz_drives import MODES
from tests.lidar.pose_fuzzer import ALL_MODES, Tally, fuzz

SLOW = {"sheets"}  # tables of a large map; in bench/fuzz_poses.py


@pytest.mark.parametrize("mode", [mode for mode in ALL_MODES if mode not in SLOW])
def test_no_consistent_pose_is_lost(mode: str) -> None:
    tally = Tally()
    seed = 0
    while tally.tried < 1200:
        fuzz(mode, seed, tally, effort=60)
        seed += 1
    assert not tally.losses, (len(tally.losses), tally.losses[:3])

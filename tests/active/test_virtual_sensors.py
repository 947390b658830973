import math

import numpy as np

from ial.active.virtual_sensors import VirtualSensors, directions
from ial.contractors.boxes import Boxes
from tests.active.scenes import room

GRID = room()
SENSORS = VirtualSensors(GRID)


def test_readings_are_those_of_the_room() -> None:
    (ahead, left, behind, right) = SENSORS.readings(np.array([[1.0, 1.0, 0.0]]), directions(4))[0].tolist()
    assert np.allclose([ahead, left, behind, right], [4.95, 2.95, 0.95, 0.95])
    turned = SENSORS.readings(np.array([[1.0, 1.0, 0.5 * math.pi]]), directions(4))[0]
    assert np.allclose(turned, [left, behind, right, ahead])


def test_bounds_hold_what_is_read_from_anywhere_in_a_box() -> None:
    random = np.random.default_rng(1)
    turns = directions(24)
    boxes = Boxes.around([(1.0, 1.0, 0.3), (4.5, 3.0, -2.0), (2.0, 2.6, 1.0)], [0.06, 0.05, 0.03])
    low, high = SENSORS.bounds(boxes, turns)
    for row in range(len(boxes)):
        read = SENSORS.readings(random.uniform(boxes.lower[row], boxes.upper[row], (200, 3)), turns)
        assert (low[row] <= read).all()
        assert (read <= high[row]).all()
    assert np.median(high - low) < 0.6
    assert (high < SENSORS.diameter_m).mean() > 0.8


def test_a_fan_that_is_too_wide_has_no_upper_bound() -> None:
    _, high = SENSORS.bounds(Boxes.around([(1.0, 1.0, 0.0)], [0.01, 0.01, 1.0]), directions(4))
    assert (high == SENSORS.diameter_m).all()

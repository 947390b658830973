import numpy as np

from ial.active.telling_apart import SENSORS, told_apart


def test_a_pair_is_told_apart_if_more_of_its_readings_differ_than_may_be_bad() -> None:
    readings = np.full((3, SENSORS), 2.0)
    readings[1, 10:20] = 3.0  # eight of these have no neighbour like the others'
    assert told_apart(readings, 0.2, 7.9 / SENSORS) == 2
    assert told_apart(readings, 0.2, 8.0 / SENSORS) == 0
    assert told_apart(readings, 1.0, 0.0) == 0


def test_the_same_edge_seen_a_little_aside_is_no_difference() -> None:
    one = np.where(np.arange(SENSORS) < 30, 1.0, 4.0)
    assert told_apart(np.stack([one, np.roll(one, 1)]), 0.2, 0.0) == 0
    assert told_apart(np.stack([one, np.roll(one, 4)]), 0.2, 0.0) == 1

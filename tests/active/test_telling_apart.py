import numpy as np

from ial.active.telling_apart import SENSORS, told_apart

ONES = np.ones((3, 3))


def test_a_pair_is_told_apart_if_more_of_its_readings_differ_than_may_be_bad() -> None:
    readings = np.full((2, 3, SENSORS), 2.0)
    readings[1, 1, 10:20] = 3.0  # eight of these have no neighbour like the others'
    assert told_apart(readings, ONES, 0.2, 7.9 / SENSORS).tolist() == [0, 2]
    assert told_apart(readings, ONES, 0.2, 8.0 / SENSORS).tolist() == [0, 0]
    assert told_apart(readings, np.array([[0.0, 0.5, 9.0], [0.0, 0.0, 0.25], [0.0, 0.0, 0.0]]), 0.2, 0.0).tolist() == [0.0, 0.75]
    assert told_apart(readings, ONES, 1.0, 0.0).tolist() == [0, 0]


def test_the_same_edge_seen_a_little_aside_is_no_difference() -> None:
    one = np.where(np.arange(SENSORS) < 30, 1.0, 4.0)
    both = np.stack([np.stack([one, np.roll(one, 1)]), np.stack([one, np.roll(one, 4)])])
    assert told_apart(both, ONES[:2, :2], 0.2, 0.0).tolist() == [0, 1]

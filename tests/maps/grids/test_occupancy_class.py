"""Thresholds, with and without their own values."""

import numpy as np

from ial.maps.grids.occupancy_class import classify_occupancy
from ial.maps.grids.occupancy_grid import FREE, OCCUPIED, UNKNOWN


def test_thresholds_themselves() -> None:
    occupancy = np.array([0.0, 0.2, 0.3, 0.6, 1.0])
    assert classify_occupancy(occupancy, 0.2, 0.6).tolist() == [FREE, FREE, UNKNOWN, OCCUPIED, OCCUPIED]
    assert classify_occupancy(occupancy, 0.2, 0.6, strict=True).tolist() == [FREE, UNKNOWN, UNKNOWN, UNKNOWN, OCCUPIED]


def test_quotients_of_pixels_meet_decimal_thresholds() -> None:
    assert classify_occupancy(np.array([51, 153]) / 255, 0.2, 0.6).tolist() == [FREE, OCCUPIED]
    assert classify_occupancy(np.array([29, 57]) / 100, 0.29, 0.57).tolist() == [FREE, OCCUPIED]

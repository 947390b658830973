"""Ray casting against a twin that intersects the ray with every occupied cell."""

import math

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from ial.contractors import threads
from ial.errors import MapError
from ial.maps.grids.ray_casting import cast_rays


def distance_to_cells(mask: np.ndarray, resolution: float, x: float, y: float, angle: float, widen: float) -> float:
    """Return where a ray first meets a closed occupied cell that is widened on all sides, in metres."""
    row, column = np.argwhere(mask).T
    if not len(row):
        return math.inf
    enter, leave = np.full(len(row), -math.inf), np.full(len(row), math.inf)
    for at, direction, low in ((x, math.cos(angle), column * resolution), (y, math.sin(angle), row * resolution)):
        low, high = low - widen, low + resolution + widen
        if direction == 0.0:
            outside = (at < low) | (at > high)
            enter[outside], leave[outside] = math.inf, -math.inf
        else:
            with np.errstate(over="ignore"):
                first, second = (low - at) / direction, (high - at) / direction
            enter, leave = np.maximum(enter, np.minimum(first, second)), np.minimum(leave, np.maximum(first, second))
    hit = (enter <= leave) & (leave >= 0.0)
    return float(np.maximum(enter[hit], 0.0).min()) if hit.any() else math.inf


@pytest.mark.slow
@settings(max_examples=1000)
@given(
    bits=st.integers(0, 2**35 - 1),
    sparse=st.integers(0, 2**35 - 1),
    resolution=st.sampled_from([0.05, 0.1, 1.0, 0.03]),
    u=st.floats(-4, 11) | st.integers(-1, 8).map(float) | st.integers(-2, 16).map(lambda i: i / 2),
    v=st.floats(-4, 9) | st.integers(-1, 6).map(float),
    angle=st.floats(-7, 7) | st.integers(-8, 8).map(lambda i: i * math.pi / 4) | st.floats(-1e-8, 1e-8),
)
@example(8, 8, 0.05, 2.0, 3.2167053469134934e-112, -4.3432995622678494e-10)  # leaves the row of a cell that it touches farther on
def test_against_all_cells(bits: int, sparse: int, resolution: float, u: float, v: float, angle: float) -> None:
    mask = np.array([(bits & sparse) >> i & 1 for i in range(35)], dtype=np.bool_).reshape(5, 7)
    x, y = u * resolution, v * resolution
    distances = float(cast_rays(mask, resolution, x, y, angle))
    margin = 1e-8 * resolution
    earliest = distance_to_cells(mask, resolution, x, y, angle, margin)
    latest = distance_to_cells(mask, resolution, x, y, angle, -margin)
    assert earliest - margin <= distances <= latest + margin


@pytest.mark.slow
@settings(max_examples=300)
@given(
    u=st.integers(-1, 8),
    v=st.integers(-1, 6),
    sparse=st.integers(0, 2**35 - 1),
    other=st.integers(0, 2**35 - 1),
    turn=st.integers(0, 7),
)
def test_rays_that_touch_corners_and_edges_hit(u: int, v: int, sparse: int, other: int, turn: int) -> None:
    mask = np.array([(sparse & other) >> i & 1 for i in range(35)], dtype=np.bool_).reshape(5, 7)
    distances = float(cast_rays(mask, 1.0, u, v, turn * math.pi / 4))
    closed = distance_to_cells(mask, 1.0, u, v, turn * math.pi / 4, 1e-12)  # what a step of rounding could hide
    assert distances == pytest.approx(closed, abs=1e-9)


def test_a_room_by_hand() -> None:
    mask = np.ones((10, 20), np.bool_)
    mask[1:9, 1:19] = False
    angles = np.array([0.0, math.pi / 2, math.pi, -math.pi / 2, math.atan2(3.0, 4.0)])
    distances = cast_rays(mask, 0.5, 5.0, 2.5, angles)
    assert distances == pytest.approx([4.5, 2.0, 4.5, 2.0, 2.0 * 5 / 3])


def test_corner_edge_and_inside() -> None:
    mask = np.zeros((4, 4), np.bool_)
    mask[2, 2] = True
    assert cast_rays(mask, 1.0, 1.0, 1.0, math.pi / 4) == pytest.approx(math.sqrt(2))  # straight into a corner
    assert cast_rays(mask, 1.0, 1.0, 3.0, -math.pi / 4) == pytest.approx(math.sqrt(2))  # past the lower left corner
    assert cast_rays(mask, 1.0, 2.0, 4.0, -math.pi / 4) == pytest.approx(math.sqrt(2))  # past the upper right corner
    assert cast_rays(mask, 1.0, 2.001, 4.0, -math.pi / 4) == np.inf
    assert cast_rays(mask, 1.0, 1.0, 3.0, math.pi / 4) == np.inf
    assert cast_rays(mask, 1.0, 0.0, 3.0, 0.0) == pytest.approx(2.0)  # along the upper edge
    assert cast_rays(mask, 1.0, 0.0, 2.0, 0.0) == pytest.approx(2.0)  # along the lower edge
    assert cast_rays(mask, 1.0, 3.0, 0.0, math.pi / 2) == pytest.approx(2.0)  # along the right edge
    assert cast_rays(mask, 1.0, 2.5, 2.5, 1.0) == 0.0
    assert cast_rays(mask, 1.0, 3.0, 3.0, 1.0) == 0.0  # on its corner


def test_range_ends_the_search() -> None:
    mask = np.zeros((3, 100), np.bool_)
    mask[:, 99] = True
    distances = [float(cast_rays(mask, 0.1, 0.05, 0.15, 0.001, max_range)) for max_range in (9.0, 9.84, 9.86, math.inf, 0.0, -1.0)]
    assert distances[0] == distances[1] == distances[4] == distances[5] == math.inf
    assert distances[2] == distances[3] == pytest.approx(9.85, abs=1e-4)


def test_starts_far_outside_do_not_hang() -> None:
    mask = np.zeros((3, 3), np.bool_)
    mask[1, 1] = True
    assert cast_rays(mask, 1.0, -1e9, 1.5, 0.0) == pytest.approx(1e9 + 1.0)
    assert cast_rays(mask, 1.0, -1e9, 1.5, math.pi) == np.inf
    assert cast_rays(mask, 1.0, -1000.0, -1000.0, math.pi / 4) == pytest.approx(1001 * math.sqrt(2))
    assert cast_rays(mask, 1.0, 1e12, 1.5, math.pi) == pytest.approx(1e12 - 2.0)


def test_shapes_and_threads() -> None:
    mask = np.random.default_rng(8).random((60, 80)) < 0.05
    x, y = np.linspace(0.1, 3.9, 30)[:, None], np.linspace(0.1, 2.9, 30)[:, None]
    angles = np.linspace(-math.pi, math.pi, 50)
    results = []
    try:
        for number in (1, 2):
            threads.set_threads(number)
            results.append(cast_rays(mask, 0.05, x, y, angles, 5.0))
    finally:
        threads.set_threads(None)
    assert results[0].shape == (30, 50)
    assert (results[0] == results[1]).all()
    assert results[0][3, 7] == cast_rays(mask, 0.05, x[3, 0], y[3, 0], angles[7], 5.0)
    assert cast_rays(mask, 0.05, 1.0, 1.0, np.empty(0)).shape == (0,)


def test_bad_input_is_refused() -> None:
    mask = np.zeros((2, 2), np.bool_)
    with pytest.raises(MapError, match="resolution"):
        cast_rays(mask, 0.0, 0, 0, 0)
    for x, angle, reach in ((math.nan, 0, 1), (math.inf, 0, 1), (1e300, 0, 1), (0, math.nan, 1), (0, math.inf, 1), (0, 0, math.nan)):
        with pytest.raises(ValueError, match=r"no point within|NaN"):
            cast_rays(mask, 0.05, x, 0, angle, reach)

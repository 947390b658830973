import math
from fractions import Fraction
from typing import Any

import mpmath
import numpy as np
import pytest

from ial.datasets.odometry import Odometry
from ial.datasets.odometry_path import OdometryPath
from ial.datasets.scan import LaserScan, Mounting
from ial.lidar.configuration.config import Bounds, FreeSpace, LocalizerConfig
from ial.lidar.evidence.beams import Beams, scan_beams, select_beams
from ial.pose import Pose
from tests.cases import cases

mpmath.mp.prec = 200


def scan(ranges: list[float] | np.ndarray, mounting: Mounting = Mounting(), **limits: Any) -> LaserScan:  # noqa: B008  (frozen)
    return LaserScan(0, np.asarray(ranges, dtype=np.float32), -1.0, 0.01, mounting=mounting, **limits)


def float32_neighbourhood(value: float) -> tuple[mpmath.mpf, mpmath.mpf]:
    """Return the ends of the real numbers that round to a float32."""
    below, above = (float(np.nextafter(np.float32(value), np.float32(side))) for side in (-np.inf, np.inf))
    return (mpmath.mpf(below) + mpmath.mpf(value)) / 2, (mpmath.mpf(above) + mpmath.mpf(value)) / 2


def mix(low: mpmath.mpf, high: mpmath.mpf, share: float) -> mpmath.mpf:
    return low + (high - low) * mpmath.mpf(share)


def offsets(beams: Beams, i: int, x: mpmath.mpf, y: mpmath.mpf) -> tuple[mpmath.mpf, mpmath.mpf]:
    """Return how far a point is from the nominal end of a beam, along it and across it."""
    dx, dy = x - mpmath.mpf(float(beams.ends[i, 0])), y - mpmath.mpf(float(beams.ends[i, 1]))
    cx, cy = (mpmath.mpf(float(value)) for value in beams.directions[i])
    return abs(cx * dx + cy * dy), abs(cx * dy - cy * dx)


def test_every_true_end_point_lies_in_the_error_region() -> None:
    for seed in range(cases(120, 20)):
        random = np.random.default_rng(seed)
        arm = (10.0 ** random.choice([0, 0, 6]) * random.uniform(-1.0, 1.0, 2)).tolist()
        mounting = Mounting(*arm, float(random.uniform(-4.0, 4.0)), bool(random.integers(2)))
        bounds = Bounds(float(random.choice([0.0, 0.03, 0.5])), float(random.choice([0.0, 1e-3, 0.1])))
        increment = float(random.choice([-0.02, 1e-3, 0.3]))
        size = int(random.integers(1, 400))
        recorded = LaserScan(0, random.uniform(0.01, 80.0, size), float(random.uniform(-3.0, 3.0)), increment, mounting=mounting)
        beams = select_beams(recorded, bounds, 0, size, FreeSpace(max_rays=size))
        assert len(beams) == size
        assert beams.rays is not None
        starts, increments = float32_neighbourhood(recorded.angle_min), float32_neighbourhood(recorded.angle_increment)
        for i in random.integers(0, size, 5).tolist():
            s = random.choice([0.0, 1.0, 0.3], 5).tolist()
            bearing = mix(*starts, s[0]) + i * mix(*increments, s[1]) + mpmath.mpf(bounds.bearing_error_rad) * (2 * s[2] - 1)
            reading = mix(*float32_neighbourhood(float(recorded.ranges[i])), s[3]) + mpmath.mpf(bounds.range_error_m) * (2 * s[4] - 1)
            angle = mpmath.mpf(mounting.yaw) + (-bearing if mounting.upside_down else bearing)
            x = mpmath.mpf(mounting.x) + reading * mpmath.cos(angle)
            y = mpmath.mpf(mounting.y) + reading * mpmath.sin(angle)
            along, across = offsets(beams, i, x, y)
            assert along <= float(beams.errors[i, 0]), (seed, i)
            assert across <= float(beams.errors[i, 1]), (seed, i)
            assert abs(angle - mpmath.mpf(float(beams.rays.angles[i]))) <= float(beams.rays.turns[i]), (seed, i)


def test_the_error_region_is_hardly_larger_than_the_bounds() -> None:
    beams = select_beams(scan([1.0, 5.0, 20.0]), Bounds(0.05, 0.0), 0, 10)
    assert (beams.errors[:, 0] - 0.05 < 1e-5).all()
    assert (beams.errors[:, 1] < 1e-5).all()
    turned = select_beams(scan([1.0, 5.0, 20.0]), Bounds(0.05, 0.01), 0, 10)
    assert turned.errors[:, 1] == pytest.approx([0.0105, 0.0505, 0.2005], rel=1e-3)
    assert turned.errors[:, 0] == pytest.approx([0.05 + 0.5e-4 * (reach + 0.05) for reach in (1.0, 5.0, 20.0)], rel=1e-3)


def test_ends_and_directions_are_in_the_frame_of_the_base() -> None:
    forward = select_beams(LaserScan(0, [2.0], 0.0, 0.1, mounting=Mounting(1.0, -0.5, 0.5 * math.pi)), Bounds(), 0, 1)
    assert forward.ends[0] == pytest.approx([1.0, 1.5], abs=1e-12)
    assert forward.directions[0] == pytest.approx([0.0, 1.0], abs=1e-12)
    left = LaserScan(0, [2.0], 0.5 * math.pi, 0.1, mounting=Mounting(0.0, 0.0, 0.0, upside_down=True))
    assert select_beams(left, Bounds(), 0, 1).ends[0] == pytest.approx([0.0, -2.0], abs=1e-6)


def test_only_hits_are_used() -> None:
    ranges = [1.0, np.nan, np.inf, -np.inf, 0.0, -1.0, 0.2, 3.0, 10.0, 12.0, 9.5]
    beams = select_beams(scan(ranges, range_min=0.5, range_max=10.0), Bounds(), 0, 100)
    assert np.hypot(*beams.ends.T) == pytest.approx([1.0, 3.0, 9.5])


@pytest.mark.parametrize(
    ("hits", "most", "used"), [(10, 180, 10), (10, 10, 10), (10, 3, 3), (181, 180, 180), (1000, 7, 7), (5, 1, 1), (0, 5, 0)]
)
def test_at_most_max_beams_are_used_spread_evenly_and_none_twice(hits: int, most: int, used: int) -> None:
    ranges = np.full(2 * hits + 1, np.nan)
    ranges[1::2] = 1.0 + np.arange(hits)
    chosen = np.rint(np.hypot(*select_beams(scan(ranges), Bounds(), 0, most).ends.T)) - 1.0
    assert len(chosen) == used
    assert len(np.unique(chosen)) == used
    if used > 1:
        gaps = np.diff(chosen)
        assert gaps.min() >= hits // used
        assert gaps.max() <= -(-hits // used)


@pytest.mark.parametrize(
    ("outliers", "hits", "q"),
    [(0, 10, 0), (3, 10, 3), (30, 10, 30), (0.0, 10, 0), (0.25, 10, 2), (0.99, 10, 9), (1.0, 10, 10), (0.5, 0, 0), (0.5, 1, 0)],
)
def test_q_is_a_number_of_beams_or_a_fraction_of_the_used_ones(outliers: int | float, hits: int, q: int) -> None:
    beams = select_beams(scan([1.0] * hits + [np.nan] * 20), Bounds(), outliers, 180)
    assert beams.outliers == q
    assert beams.informative == (q < hits)


def test_a_fraction_is_of_the_used_beams_not_of_all_hits() -> None:
    assert select_beams(scan([1.0] * 100), Bounds(), 0.5, 10).outliers == 5


def test_without_deskewing_the_motion_during_a_scan_is_ignored() -> None:
    plain = scan([1.0, 2.0, 3.0])
    sweep = OdometryPath.of([(0, Odometry(0.0, 0.0)), (10**8, Odometry.of(Pose(0.1, 0.0, 0.2)))])
    moving = LaserScan(0, plain.ranges, -1.0, 0.01, sweep=sweep)
    config = LocalizerConfig()
    assert np.array_equal(scan_beams(moving, config).ends, scan_beams(plain, config).ends)
    assert not np.array_equal(scan_beams(moving, LocalizerConfig(deskew=True)).ends, scan_beams(plain, config).ends)


def test_a_ray_is_shorter_than_any_way_to_what_a_good_beam_may_have_met() -> None:
    """Exactly: the reading, less its rounding, less its error, less the margin; in the tests of whole scenes the margin hides the error."""
    random = np.random.default_rng(0)
    for range_error, margin in ((0.0, 0.02), (0.4, 0.02), (0.4, 0.0), (0.1, 0.3), (1.0 / 3.0, 0.1), (0.7, 0.7)):
        far = random.uniform(2.0, 30.0, 200).astype(np.float32)
        far[::5] = np.inf
        recorded = scan(far, range_max=40.0)
        rays = select_beams(recorded, Bounds(range_error), 0, 500, FreeSpace(True, margin, 500, 35.3)).rays
        assert rays is not None
        readings = [(float(each), True) for each in far[np.isfinite(far)]] + [(35.3, False)] * int(np.isinf(far).sum())
        for (reading, rounded), length, aside in zip(readings, rays.lengths.tolist(), rays.margins.tolist(), strict=True):
            least = (Fraction(reading) + Fraction(float(np.nextafter(np.float32(reading), np.float32(0))))) / 2 if rounded else reading
            most = Fraction(least) - Fraction(range_error) - Fraction(margin)
            assert most - Fraction(1, 10**5) <= Fraction(length) <= most
            assert Fraction(margin) <= Fraction(aside) <= Fraction(margin) + Fraction(1, 10**9)

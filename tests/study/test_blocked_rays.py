"""Blocked rays and open strips against many single rays, each clipped with every cell."""

import numpy as np
import pytest

from ial.study.blocked_rays import blocked_rays
from ial.study.obstacles import Obstacles
from ial.study.used_beams import UsedBeams
from tests.study.scans import Case

ASIDE = np.linspace(-1.0, 1.0, 41)


@pytest.mark.slow
def test_a_ray_is_blocked_if_all_its_neighbours_are() -> None:
    counts = {False: 0, True: 0}
    for seed in range(300):
        case = Case.random(seed)
        beams, margin = UsedBeams.of(case.scan, case.config), case.config.free_space.margin_m
        (blocked,) = blocked_rays(beams, np.array([case.pose]), Obstacles(case.grid))
        for i, (row, length) in enumerate(zip(beams.rays.tolist(), beams.lengths.tolist(), strict=True)):
            beside = ASIDE * margin if margin else [0.0]
            some = list(case.rays(int(beams.numbers[row]), 3))
            free = any(case.entered(laser, along, each) > length + 1e-7 for laser, along in some for each in beside)
            assert not (free and blocked[i]), (seed, i)
            if not blocked[i] and not free:  # the gap is narrower than what was sampled
                some = list(case.rays(int(beams.numbers[row]), 15))
                finer = np.linspace(-margin, margin, 401) if margin else [0.0]
                assert any(case.entered(laser, along, each) > length - 1e-7 for laser, along in some for each in finer), (seed, i)
            counts[bool(blocked[i])] += 1
    assert min(counts.values()) > 60, counts

from dataclasses import astuple

import numpy as np
import pytest

from ial.datasets.motion import ErrorBound, MotionBounds
from ial.datasets.recording import steps
from ial.datasets.simulator import Lidar, SensorErrors, simulate
from ial.datasets.walk import random_walk
from ial.maps.grids.floor_plan import floor_plan
from ial.study.motion_fit import RecordedStep, fitted


@pytest.mark.slow
@pytest.mark.parametrize("every", [1, 4])
def test_bounds_are_fitted_over_every_message(every: int) -> None:
    grid = floor_plan(12.0, 10.0, 0.05, 4)
    path = random_walk(grid, 80, 5)
    wheels = MotionBounds(ErrorBound(0.01, 0.1, 0.0, 0.02, 0.05), ErrorBound(0.01, 0.0, 0.1, 0.02, 0.05))
    recording = simulate(grid, path, Lidar(beams=2), SensorErrors(), wheels, 5, messages=6).recording
    for start in (0.3, 5.0):
        first = MotionBounds(*(ErrorBound(*(start * part for part in astuple(bound))) for bound in (wheels.translation, wheels.rotation)))
        chosen = [
            RecordedStep(step.recorded, path[step.index - every].inverse() @ path[step.index])
            for step in steps(recording, first, every=every)
            if step.motion is not None
        ]
        assert {step.messages for step in chosen} == {6 * every}
        fitted_bounds = fitted(first, chosen, 0.99)
        held = [np.mean([step.held(bounds) for step in chosen], axis=0) for bounds in (fitted_bounds, first)]
        assert (held[0] >= 0.99).all()
        assert (start > 1.0) == (held[1] >= 0.99).all()
        ratios = [sum(astuple(bound)) / sum(astuple(other)) for bound, other in zip(_both(fitted_bounds), _both(wheels), strict=True)]
        assert max(ratios) < 1.3  # two digits are rounded up


def _both(bounds: MotionBounds) -> tuple[ErrorBound, ErrorBound]:
    return bounds.translation, bounds.rotation

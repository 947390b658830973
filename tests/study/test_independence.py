"""What measures the search must not share an error with it."""

import ast
import math
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import ial.lidar.evidence.beams
from ial.datasets.motion import ErrorBound, MotionBounds
from ial.datasets.simulator import Lidar, SensorErrors, simulate
from ial.datasets.walk import random_walk
from ial.lidar.configuration.config import Bounds, FreeSpace, LocalizerConfig
from ial.lidar.evidence.beams import Beams
from ial.lidar.localizer import Localizer
from ial.lidar.run import localize
from ial.maps.grids.floor_plan import floor_plan
from ial.study.containment import Containment

ROOT = Path(__file__).resolve().parents[2]
TWIN = ("used_beams", "obstacles", "open_strips", "good_beams", "blocked_rays", "domain", "possible_motions")
RECORDS = {
    "ial.datasets.motion",
    "ial.datasets.odometry_path",
    "ial.datasets.scan",
    "ial.lidar.configuration.config",
    "ial.maps.grids.occupancy_grid",
}
MOTION = MotionBounds(ErrorBound(0.05), ErrorBound(0.05))


@pytest.mark.parametrize("name", TWIN)
def test_the_twin_imports_plain_records_and_itself(name: str) -> None:
    tree = ast.parse((ROOT / "ial" / "study" / f"{name}.py").read_text())
    names = {str(node.module) for node in ast.walk(tree) if isinstance(node, ast.ImportFrom)}
    names |= {alias.name for node in ast.walk(tree) if isinstance(node, ast.Import) for alias in node.names}
    assert {each for each in names if each.split(".")[0] == "ial"} - {f"ial.study.{each}" for each in TWIN} <= RECORDS


def right(beams: Beams) -> Beams:
    return beams


def shifted(beams: Beams) -> Beams:
    return replace(beams, ends=beams.ends + np.array([0.3, 0.0]))


def turned(beams: Beams) -> Beams:
    c, s = math.cos(0.3), math.sin(0.3)
    turn = np.array([[c, s], [-s, c]])
    return replace(beams, ends=beams.ends @ turn, directions=beams.directions @ turn)


@pytest.mark.parametrize("change", [right, shifted, turned])
def test_an_error_in_the_evidence_of_the_search_is_seen(monkeypatch: pytest.MonkeyPatch, change: Callable[[Beams], Beams]) -> None:
    grid = floor_plan(8.0, 6.0, 0.05, 3)
    lidar = Lidar(beams=90, angle_min=-2.0, angle_increment=0.04, range_max=20.0)
    run = simulate(grid, random_walk(grid, 8, 1), lidar, SensorErrors(0.02, 0.0), MOTION, 1)
    config = LocalizerConfig(bounds=Bounds(0.02, 0.0, 0.01, MOTION), outliers=3, free_space=FreeSpace(use=False))
    select = ial.lidar.evidence.beams.select_beams
    monkeypatch.setattr(ial.lidar.evidence.beams, "select_beams", lambda *given: change(select(*given)))
    localizer = Localizer(grid, config=config)
    measured = Containment(localizer, run.truth)
    for step, estimate in localize(run.recording, localizer):
        measured.add(step, estimate)
    summary = measured.summary()
    assert summary["scans_where_assumptions_hold"] > 0
    assert (summary["contained_when_assumptions_hold"] == 1.0) == (change is right)

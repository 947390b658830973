"""What people see when they look at an object: one line that says what it is, never an address or an array."""

import dataclasses
import importlib
from fractions import Fraction
from pathlib import Path
from typing import Any, get_args

import numpy as np
import pytest

from ial.bouncing import Automaton, FilterTable, Headings, build_filter
from ial.contractors import Boxes, Clusters, Distance, Paving
from ial.datasets import LaserScan, Motion, Trajectory, sample_recording
from ial.lidar import Localizer, LocalizerConfig, PoseSet
from ial.maps import Environment, OccupancyGrid, Polygon
from ial.pose import Pose
from ial.results import Enclosure, EnclosuresFile, EventsFile, Picture, RecordingFile, ResultFolder, Summary, TrajectoryFile
from ial.study import Containment, Domain, Obstacles

ROOMS = (
    "active",
    "contractors",
    "maps",
    "datasets",
    "lidar",
    "bouncing",
    "compass",
    "membership",
    "odometer",
    "particles",
    "results",
    "study",
)


def classes() -> list[type]:
    """The public classes of the rooms that people look at; protocols and exceptions have no objects to look at."""
    packages = [importlib.import_module(f"ial.{room}") for room in ROOMS]
    named = [getattr(package, name) for package in packages for name in package.__all__]
    kinds = [each for each in named if isinstance(each, type) and not issubclass(each, Exception)]
    return [each for each in kinds if not getattr(each, "_is_protocol", False)]


def holds_array(kind: Any) -> bool:
    return "ndarray" in str(kind) or any(map(holds_array, get_args(kind)))


@pytest.mark.parametrize("kind", classes(), ids=lambda kind: f"{kind.__module__}.{kind.__name__}")
def test_no_public_object_shows_an_address_or_an_array(kind: type) -> None:
    assert kind.__repr__ is not object.__repr__
    if dataclasses.is_dataclass(kind) and hasattr(kind.__repr__, "__wrapped__"):  # made from the fields
        assert [each.name for each in dataclasses.fields(kind) if each.repr and holds_array(each.type)] == []


SQUARE = Polygon(((Fraction(0), Fraction(0)), (Fraction(9), Fraction(0)), (Fraction(9), Fraction(9)), (Fraction(0), Fraction(9))))
CELLS = np.zeros((3, 4), dtype=np.uint8)
CELLS[0, 0] = 1
FILTER = build_filter({"room": Environment((SQUARE,), Fraction(1))}, Headings(8, 3, Fraction(1)))


@pytest.mark.parametrize(
    ("thing", "shown"),
    [
        (OccupancyGrid(CELLS, 0.5), "<OccupancyGrid: 4 × 3 cells of 0.5 m, lower left corner at Pose(x=0.0, y=0.0, theta=0.0)>"),
        (SQUARE, "<Polygon: 4 corners, 0 holes>"),
        (Environment((SQUARE,), Fraction(1)), "<Environment: 1 polygon, cells of 1 m>"),
        (
            Paving(Boxes.of([(0, 1), (2, 3)]), Boxes.none(2), "time"),
            "<Paving in 2 dimensions: 0 inner boxes, 1 of the boundary, hull [0.0, 1.0] × [2.0, 3.0], stopped early by time>",
        ),
        (Paving(Boxes.none(2), Boxes.none(2)), "<Paving in 2 dimensions: 0 inner boxes, 0 of the boundary>"),
        (Clusters(np.zeros(3, dtype=np.int64), Boxes.of([(0, 1)])), "<Clusters: 1 of 3 boxes>"),
        (Distance(), "<Distance of dimension 5>"),
        (PoseSet(Boxes.none(3)), "<PoseSet of 0 boxes in the grid's frame>"),
        (Motion.around(Pose(1.0, 0.0, 0.5)), "<Motion: x [1.0, 1.0] m, y [0.0, 0.0] m, θ [0.5, 0.5] rad>"),
        (Trajectory.of([(0, Pose()), (2_500_000_000, Pose())]), "<Trajectory of 2 poses, 2.50 s>"),
        (
            LaserScan(7, np.ones(5, dtype=np.float32), -1.0, 0.5, 0.0, 80.0),
            "<LaserScan at 7 ns: 5 beams from -1 by 0.5 rad, ranges 0 to 80 m>",
        ),
    ],
    ids=lambda value: type(value).__name__,
)
def test_what_is_shown(thing: object, shown: str) -> None:
    assert repr(thing) == shown


def test_a_filter_and_a_localizer_say_in_one_line_what_they_are() -> None:
    assert repr(FILTER).startswith(f"<BounceFilter of {len(FILTER.table) - 1} states and {FILTER.table.cycles} knowledge cycles for room")
    localizer = repr(Localizer(OccupancyGrid(CELLS, 0.5)))
    assert localizer.startswith("<Localizer in <OccupancyGrid: 4 × 3 cells")
    assert "\n" not in localizer
    assert {Automaton, FilterTable} <= set(classes())


def test_what_a_run_leaves_and_what_judges_it_say_what_they_are(tmp_path: Path) -> None:
    grid, config = OccupancyGrid(CELLS, 0.5), LocalizerConfig()
    with ResultFolder(tmp_path) as folder:
        sinks = [EnclosuresFile(tmp_path / "e"), EventsFile(tmp_path / "v"), TrajectoryFile(tmp_path / "t")]
        folder.attach(*sinks, Picture(tmp_path / "p", grid, "run"), RecordingFile(tmp_path / "r.mcap", grid))
        assert [repr(each) for each in sinks] == [
            f"<EnclosuresFile: {tmp_path / 'e'}>",
            f"<EventsFile: {tmp_path / 'v'}>",
            f"<TrajectoryFile: {tmp_path / 't'}>",
        ]
        assert repr(folder) == f"<ResultFolder: {tmp_path}, 5 files fed scan by scan>"
    assert repr(Picture(tmp_path / "p", grid, "run")) == f"<Picture of 0 scans: {tmp_path / 'p'}>"
    with RecordingFile(tmp_path / "r.mcap", grid) as recording:
        assert repr(recording) == f"<RecordingFile: {tmp_path / 'r.mcap'}>"
    sample = sample_recording()
    assert repr(Summary(sample, grid, config, {})) == f"<Summary of 0 scans of {sample.name}: {{}}>"
    assert repr(Enclosure(7, 3, "localized", (), Pose(), 180, 20, False, None, 0.1)) == (
        "<Enclosure of scan 3: localized, 0 hypotheses around Pose(x=0.0, y=0.0, theta=0.0)>"
    )
    obstacles = Obstacles(grid)
    assert repr(obstacles) == "<Obstacles: 1 occupied cells of 0.5 m>"
    assert repr(Domain(grid, config, obstacles)) == "<Domain of 11 cells of 0.5 m>"
    truth = Trajectory.of([(0, Pose())])
    assert repr(Containment(Localizer(grid), truth)) == "<Containment of 0 scans: the reference is missed in 0>"

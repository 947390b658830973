import json
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from ial.datasets.sample import sample_map_path
from ial.maps.grids.map_file import write_map
from ial.maps.grids.occupancy_grid import FREE, OCCUPIED, OccupancyGrid
from ial.maps.polygons.environment import load_environment
from ial.maps.polygons.simplification import simplified
from tests.cli.bounce.hall import Cli


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("POLYGON ((0 0, 4 4, 4 0, 0 3, 0 0))", "the outer ring crosses or touches itself"),
        ("POLYGON ((0 0, 4 0, 4 4))", "is open"),
        ("POLYGON ((0 0, 4 0, 4 4, 0 0), (7 7, 8 7, 8 8, 7 7))", "hole 1 does not lie inside"),
    ],
)
def test_bad_environments_are_refused(refused: Callable[..., str], text: str, message: str) -> None:
    Path("bad.wkt").write_text(text)
    assert message in refused("bounce", "build", "bad.wkt", "--out", "f.npz")


def test_a_picture_is_the_environment_that_it_shows(ial: Cli, hall: Path, plan: Path) -> None:
    options = ("--angle", 90, "--cell", 1, "--json")
    drawn = json.loads(ial("bounce", "build", plan, "--resolution", "1/2", *options, "--out", "plan.npz").stdout)
    written = json.loads(ial("bounce", "build", hall, *options, "--out", "hall.npz").stdout)
    assert {**drawn, "environments": []}["states"] == written["states"]
    assert drawn["configurations"] == written["configurations"]
    both = json.loads(ial("bounce", "build", plan, hall, "--resolution", "1/2", *options, "--out", "both.npz").stdout)
    assert both["environments"] == ["plan", "hall"]
    assert (
        ial("bounce", "build", plan, "--resolution", 0.5, "--out", "small.npz")
        .stdout.splitlines()[0]
        .endswith("cells of 0.5 m, bouncing angle 90°")
    )
    assert (
        "note: cells are 0.5 m wide, as those of the map; ial bounce advise"
        in ial("bounce", "build", plan, "--resolution", 0.5, "--out", "small.npz", "--overwrite").stderr
    )
    assert ial("bounce", "simulate", plan, "--resolution", "1/2", "--steps", 5, "--out", "stream.txt").exit_code == 0
    assert ial("bounce", "search-angle", plan, "--resolution", "1/2", "--headings", 4).exit_code == 0
    assert ial("bounce", "show", plan, "--resolution", "1/2", "--cell", 1, "--out", "a.png").exit_code == 0
    assert ial("bounce", "show", "small.npz", plan, "--resolution", "1/2", "--what", "basins", "--out", "b.png").exit_code == 0
    assert ial("bounce", "advise", plan, "--resolution", "1/2", "--radius", "1/2", "--most-states", 500).exit_code == 0


@pytest.mark.parametrize("command", ["build", "simulate", "search-angle", "show", "advise"])
def test_a_resolution_is_asked_for_where_it_is_needed_and_nowhere_else(
    refused: Callable[..., str], hall: Path, plan: Path, command: str
) -> None:
    out = () if command in ("search-angle", "advise") else ("--out", "out.png")
    assert "plan.png: a picture does not say how large it is; give its resolution" in refused("bounce", command, plan, *out)
    assert "no environment is a picture; leave it out" in refused("bounce", command, hall, "--resolution", "0.1", *out)
    assert "--resolution: 'wide' is no number" in refused("bounce", command, plan, "--resolution", "wide", *out)
    assert "tolerance of a simplification is -1 m" in refused("bounce", command, hall, "--simplify=-1", *out)
    assert "hall: every part of the free space is narrower than 9 m" in refused("bounce", command, hall, "--simplify", "9", *out)


def test_the_embedded_map_has_a_name(ial: Cli, refused: Callable[..., str]) -> None:
    record = json.loads(ial("bounce", "build", "sample", "--cell", "1/2", "--radius", "1/4", "--out", "f.npz", "--json").stdout)
    assert record["environments"] == ["sample"]
    written = json.loads(ial("bounce", "build", sample_map_path(), "--cell", "1/2", "--radius", "1/4", "--out", "g.npz", "--json").stdout)
    assert {**written, "environments": ["sample"]} == {**record, "knowledge_cycles": written["knowledge_cycles"]}
    Path("sample").mkdir()
    assert "sample is the name of the embedded map, and a file or folder here has it, too" in refused("bounce", "advise", "sample")


def test_fewer_walls_are_told_and_a_filter_is_drawn_on_them(ial: Cli, refused: Callable[..., str]) -> None:
    y, x = np.mgrid[:60, :80]
    cells = np.where((x + 2 * y > 30) & (x > 2) & (x < 78) & (y > 2) & (y < 58), FREE, OCCUPIED).astype(np.uint8)
    cells[30, 40] = OCCUPIED
    cells[0, 0] = FREE
    write_map(OccupancyGrid(cells, 0.1), Path("slope.yaml"))
    command = ("bounce", "build", "slope.yaml", "--cell", "1/2", "--radius", "1/4", "--simplify", "0.2")
    first, second = ial(*command, "--out", "f.npz").stdout.splitlines()[:2]
    record = json.loads(ial(*command, "--out", "g.npz", "--json").stdout)["simplified"]["slope"]
    expected = simplified(load_environment("slope.yaml"), Fraction(1, 5))
    assert (record["walls_before"], record["walls"]) == expected.walls
    assert record["moved_m"] == float(expected.moved_m)
    before, left = expected.walls
    assert first == f"slope: simplified by 0.2 m, {left} of {before} walls are left, moved by up to {float(expected.moved_m):.9g} m"
    assert second == "slope: left out 1 narrow part of the free space (0.01 m²) and 1 small obstacle (0.01 m²)"
    assert ial("bounce", "show", "f.npz", "slope.yaml", "--simplify", "0.2", "--what", "basins", "--out", "a.png").exit_code == 0
    message = refused("bounce", "show", "f.npz", "slope.yaml", "--what", "basins", "--out", "b.png")
    assert "the environment is not the one the filter was built from" in message
    # A disk does not fit into a part that is wider than the tolerance, and a point does.
    cells[20:24, :2] = FREE
    write_map(OccupancyGrid(cells, 0.1), Path("slot.yaml"))
    for radius, parts in (("0", 1), ("1/4", 2)):
        made = ial(
            "bounce", "build", "slot.yaml", "--cell", "1/2", "--radius", radius, "--simplify", "0.1", "--out", f"{parts}.npz", "--json"
        )
        assert json.loads(made.stdout)["simplified"]["slot"]["left_out_parts"] == parts

import io
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from rich.console import Console
from rich.progress import Progress

from ial.cli.shell import terminal
from ial.maps.grids.map_file import write_map
from ial.maps.grids.occupancy_grid import OccupancyGrid
from tests.cli.bounce.hall import REAL, ROOMS, Cli, stream_of


def test_build_says_what_it_has_built(ial: Cli, hall: Path) -> None:
    result = ial("bounce", "build", hall, "--out", "f.npz")
    assert result.exit_code == 0
    assert "hall: 196 configurations, 4 headings, cells of 1 m, bouncing angle 90°" in result.stdout
    assert "177 states, 2 knowledge cycles" in result.stdout
    assert "a localized robot is in 1 to 2 configurations" in result.stdout
    record = json.loads(ial("bounce", "build", hall, "--out", "f.npz", "--angle", "45/2", "--cell", "1/2", "--json", "--overwrite").stdout)
    assert (record["headings"], record["bounce_deg"], record["cell_m"]) == (16, 22.5, 0.5)
    assert record["configurations"] == 16 * 4 * 49


def test_several_environments(ial: Cli, hall: Path) -> None:
    Path("room.svg").write_text('<svg><polygon points="0,0 6,0 6,5 0,5"/></svg>')
    cells = np.zeros((5, 7), dtype=np.uint8)
    cells[2, 3] = 1
    write_map(OccupancyGrid(cells, 1.0), Path("office.yaml"))
    record = json.loads(ial("bounce", "build", hall, "room.svg", "office.yaml", "--out", "all.npz", "--json").stdout)
    assert record["environments"] == ["hall", "room", "office"]
    assert record["configurations"] == 4 * (49 + 30 + 34)
    result = ial("bounce", "run", "all.npz", "--stream", "00000000")
    assert "in hall" in result.stdout
    assert "room" not in result.stdout


def test_merged_headings_are_told(ial: Cli, hall: Path) -> None:
    ial("bounce", "build", hall, "--headings", 360, "--out", "f.npz")
    result = ial("bounce", "run", "f.npz", "--stream", stream_of(Path("f.npz"), count=200))
    assert "heading one of " in result.stdout
    assert "more; --json lists all" in result.stdout or result.stdout.count("hall: x") <= 12


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--angle", "50", "--headings", "8"], "bouncing angle 50° is not a multiple of 45°"),
        (["--angle", "360"], "multiple of 360°"),
        (["--angle", "right"], "--angle: 'right' is no number"),
        (["--angle", "45", "--step", "1/2"], "rounds to offset (0, 0)"),
        (["--radius", "9"], "no cell is free for a robot of radius 9 m"),
        (["--radius=-1"], "radius of the robot is -1"),
        (["--cell", "0"], "--cell is 0"),
        (["--cell", "1e-9"], "too small"),
        (["--max-states", "0"], None),
        (["--most-states", "5"], "more than 5 states"),
        (["--headings", "0"], "number of headings is 0"),
    ],
)
def test_bad_options_are_refused(refused: Callable[..., str], ial: Cli, hall: Path, options: list[str], message: str | None) -> None:
    if message is None:  # an option that does not exist is refused by the command line itself
        assert ial("bounce", "build", hall, "--out", "f.npz", *options).exit_code == 2
    else:
        assert message in refused("bounce", "build", hall, "--out", "f.npz", *options)


def test_a_filter_with_a_space_in_its_name_is_quoted(ial: Cli, hall: Path) -> None:
    assert "ial bounce run 'my filter.npz' --stream" in ial("bounce", "build", hall, "--out", "my filter.npz").stdout


def test_steps_beside_those_of_a_robot_are_told(ial: Cli, hall: Path) -> None:
    said = "steps of the cell map are not those of a robot: "
    assert said not in ial("bounce", "build", hall, "--angle", 90, "--out", "a.npz").stdout
    result = ial("bounce", "build", hall, "--angle", 22.5, "--out", "b.npz")
    assert said + "up to 22.5° aside, lengths up to 41.5 % off\n" in result.stdout
    record = json.loads(ial("bounce", "build", hall, "--angle", 22.5, "--out", "c.npz", "--json").stdout)
    assert record["offset_error_deg"] == 22.5
    assert record["offset_error"] == pytest.approx(2**0.5 - 1)
    finer = ial("bounce", "build", hall, "--angle", 22.5, "--cell", "1/16", "--step", 1, "--out", "d.npz").stdout
    # 16 cells at 22.5° are (14.78, 6.12), rounded (15, 6), 21.8°; at 45° (11.3, 11.3), rounded (11, 11), 15.56 cells.
    assert said + "up to 0.7° aside, lengths up to 2.8 % off\n" in finer


def test_progress_is_shown_on_a_terminal_alone(ial: Cli, hall: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    assert "states" not in ial("bounce", "build", hall, "--out", "a.npz").stderr
    seen: list[tuple[float, float | None]] = []
    update = Progress.update

    def watched(bar: Progress, task: Any, **how: Any) -> None:
        seen.append((how["completed"], how["total"]))
        update(bar, task, **how)

    monkeypatch.setattr(Progress, "update", watched)
    monkeypatch.setattr(terminal, "err", Console(file=io.StringIO(), force_terminal=True))
    record = json.loads(ial("bounce", "build", hall, "--out", "b.npz", "--json").stdout)
    assert seen == [(record["states"], None)]
    seen.clear()
    ial("bounce", "build", hall, "--rays", "--out", "c.npz")
    assert len(seen) > 1
    assert seen == [(done, len(seen)) for done in range(1, len(seen) + 1)]


def test_a_start_of_which_something_is_known_is_used(ial: Cli, hall: Path, refused: Callable[..., str]) -> None:
    known = ("--region", "7,1,8,2", "--heading", "80,100")
    cells = ("--angle", 90, "--cell", 1, "--out", "c.npz")
    anywhere = ial("bounce", "build", hall, *cells).stdout
    assert ial("bounce", "build", hall, *cells, *known, "--overwrite").exit_code == 0
    record = json.loads(ial("bounce", "build", hall, *cells, *known, "--overwrite", "--json").stdout)
    assert record["configurations"] == 1
    assert "196 configurations" in anywhere
    assert "the filter knows where the robot started" in refused("bounce", "run", "c.npz", "--stream", "0001", "--restart")
    assert "the filter knows where the robot started" in refused("bounce", "export", "c.npz", "--restart", "--out", "c.h")
    assert ial("bounce", "export", "c.npz", "--out", "c.h").exit_code == 0
    assert "something is known" in Path("c.h").read_text()

    assert ial("bounce", "build", hall, *REAL, *ROOMS, *known, "--out", "p.npz").exit_code == 0
    told = json.loads(ial("bounce", "run", "p.npz", "--stream", "0" * 9 + "1", "--json").stdout)
    assert (told["room"], told["localized_at"]) == ("right", 10)
    gone = ial("bounce", "run", "p.npz", "--stream", "0" * 20)
    assert "rejected at observation" in gone.stdout
    carried = json.loads(ial("bounce", "run", "p.npz", "--stream", "0" * 20 + "1", "--restart", "--json").stdout)
    assert carried["pieces"] == 10944, "it may be anywhere then"
    assert ial("bounce", "export", "p.npz", "--out", "p.h").exit_code == 0
    assert "is where it was said to start" in Path("p.h").read_text()
    assert "can start in no configuration" in refused("bounce", "build", hall, "--cell", 1, "--region", "20,1,21,2", "--out", "n.npz")
    assert "can have started nowhere" in refused("bounce", "build", hall, "--rays", "--region", "20,1,21,2", "--out", "n.npz")
    assert "X0,Y0,X1,Y1" in refused("bounce", "build", hall, "--region", "20,1", "--out", "n.npz")
    assert "FROM,TO" in refused("bounce", "build", hall, "--heading", "20", "--out", "n.npz")
    assert "ends before it begins" in refused("bounce", "build", hall, "--heading", "20,10", "--out", "n.npz")

"""`ial explore`, as a user runs it: what it prints, what it leaves, and what it refuses."""

import json
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any, get_args

import cv2
import numpy as np
import pytest
import yaml

from ial.cli.active.job import FILES
from ial.cli.active.options import MapChoice
from ial.datasets.trajectory import read_tum
from ial.maps.grids.alike_plans import alike_plan, plan_names
from ial.maps.grids.map_file import write_map
from ial.maps.grids.occupancy_grid import FREE, OCCUPIED, OccupancyGrid
from ial.results.lidar.enclosures import read_enclosures
from ial.results.lidar.json_lines import read_lines

Cli = Callable[..., Any]
Refused = Callable[..., str]

ROOMS = ("explore", "--map", "plan:rooms", "--start", 7, 5.5, 1.0)


def closets() -> Path:
    """Two closets that are alike, and a hall: a robot in a closet cannot drive anywhere, for it has no door but a slit."""
    cells = np.full((40, 60), OCCUPIED, dtype=np.uint8)
    for left in (6, 28):
        cells[4:19, left : left + 16] = FREE
        cells[12:18, left - 3 : left] = FREE
    cells[24:36, 4:56] = FREE
    path = Path("closets.yaml")
    write_map(OccupancyGrid(cells, 0.05), path)
    return path


@pytest.mark.slow
def test_a_robot_in_one_of_four_rooms_is_localized(ial: Cli) -> None:
    result = ial(*ROOMS, "--out", "run")
    assert result.exit_code == 0
    first, *_, contained, holds, last = result.stdout.splitlines()
    assert re.fullmatch(r" +0  first look: [2-9] places, ambiguous", first)
    assert "\nlocalized after " in result.stdout
    assert contained.startswith("reference contained in 100 % of ")
    assert holds.endswith("contained in 100 %")
    assert last == "results in run"
    run = Path("run")
    assert sorted(file.name for file in run.iterdir()) == sorted(FILES)
    decisions, truth = list(read_lines(run / "decisions.jsonl")), read_tum(run / "truth.tum")
    scans = list(read_enclosures(run / "enclosures.jsonl"))
    assert len(truth) == len(scans) == len(decisions) + 1
    assert [each["number"] for each in decisions] == list(range(1, len(scans)))
    assert [each["hypotheses_before"] for each in decisions] == [len(scan.hypotheses) for scan in scans[:-1]]
    assert [each["hypotheses"] for each in decisions] == [len(scan.hypotheses) for scan in scans[1:]]
    begun = [each for each in decisions if not each["goes_on"]]
    assert begun[0]["number"] == 1
    assert {each["stage"] for each in begun if each["since"] is not None} == {"frontier"}
    assert all(1 <= each["since"] <= each["number"] for each in begun if each["since"] is not None)
    assert any(each["open"] for each in decisions)
    assert [each.stamp_ns for each in scans] == truth.stamps_ns.tolist()
    for row, scan in enumerate(scans):
        at = truth[row]
        assert any(each.x[0] <= at.x <= each.x[1] and each.y[0] <= at.y <= each.y[1] for each in scan.hypotheses)
    *_, end = read_lines(run / "events.jsonl")
    assert (end["event"], end["by"], end["drives"]) == ("ended", "localized", len(decisions))
    record = json.loads((run / "summary.json").read_text())
    assert record["exploration"]["drives"] == len(decisions)
    assert record["options"]["planner"] == "direction"
    way = np.hypot(*np.diff(truth.poses[:, :2], axis=0).T).sum()
    assert abs(record["exploration"]["way_m"] - way) < 1e-9
    assert cv2.imread(str(run / "tree.png")) is not None


@pytest.mark.slow
def test_the_embedded_start_needs_both_stages_and_a_few_drives(ial: Cli) -> None:
    record = json.loads(ial("explore", "--json", "--out", "run").stdout)
    assert record == json.loads(Path("run/summary.json").read_text())
    assert record["exploration"]["ended_by"] == "localized"
    assert record["exploration"]["drives"] <= 20
    assert {"direction", "frontier"} <= {each["stage"] for each in read_lines("run/decisions.jsonl")}


@pytest.mark.slow
def test_the_same_seed_gives_the_same_run_and_another_one_another_start(ial: Cli) -> None:
    starts = []
    for name, seed in (("one", 4), ("again", 4), ("other", 5)):
        ial("explore", "--map", "plan:rooms", "--planner", "random", "--drives", 1, "--seed", seed, "--out", name)
        starts.append(Path(name, "truth.tum").read_text())
    assert starts[0] == starts[1]
    assert starts[0].splitlines()[0] != starts[2].splitlines()[0]


@pytest.mark.slow
@pytest.mark.parametrize("planner", ["entropy", "target", "random", "frontier"])
def test_every_planner_drives(ial: Cli, planner: str) -> None:
    result = ial(*ROOMS, "--planner", planner, "--drives", 1, "--out", "run", "--bad-beams", 2, "--adversarial")
    assert result.exit_code in (0, 3)
    (decision,) = read_lines("run/decisions.jsonl")
    assert decision["stage"] == planner
    assert decision["distance_m"] > 0


@pytest.mark.slow
def test_without_a_drive_it_gives_up_with_status_3(ial: Cli) -> None:
    result = ial(*ROOMS, "--drives", 0, "--out", "run")
    assert result.exit_code == 3
    assert re.search(r"\ngave up after 0 drives, 0\.00 m: ambiguous, [2-9] places\n", result.stdout)
    assert Path("run/decisions.jsonl").read_text() == ""


@pytest.mark.slow
def test_where_the_map_is_symmetric_that_is_an_end(ial: Cli) -> None:
    result = ial("explore", "--map", "plan:ring", "--start", 1.1, 7.5, 0.3, "--out", "run")
    assert result.exit_code == 0
    assert "\nlocalized up to symmetry after 0 drives, 0.00 m: 4 places," in result.stdout


@pytest.mark.slow
@pytest.mark.parametrize("planner", ["direction", "random"])
def test_where_nothing_is_left_to_do_that_is_an_end_too(ial: Cli, planner: str) -> None:
    result = ial("explore", "--map", closets(), "--start", 0.7, 0.575, 0.3, "--planner", planner, "--animate", "film.gif", "--out", "run")
    assert result.exit_code == 3
    (decision,) = read_lines("run/decisions.jsonl")
    assert (decision["stage"], decision["distance_m"]) == ("exhausted", None)
    assert f"\nambiguous after 0 drives, 0.00 m, 2 places: {decision['reason']}\n" in result.stdout
    *_, end = read_lines("run/events.jsonl")
    assert (end["event"], end["by"]) == ("ended", "exhausted")
    assert len(list(read_enclosures("run/enclosures.jsonl"))) == 1


@pytest.mark.slow
def test_a_collision_in_another_world_than_the_map_is_an_event(ial: Cli) -> None:
    cells = alike_plan("rooms").cells.copy()
    cells[79:81, 115:117] = OCCUPIED  # a post that the map does not know, half a metre ahead of the robot
    write_map(OccupancyGrid(cells, 0.05), Path("world.yaml"))
    words = ("--world", "world.yaml", "--start", 5.8, 4.5, -1.57, "--planner", "random", "--drives", 1)
    result = ial("explore", "--map", "plan:rooms", *words, "--animate", "film.mp4", "--out", "run")
    assert result.exit_code in (0, 3)
    (decision,) = read_lines("run/decisions.jsonl")
    assert decision["collided"]
    assert ", collided\n" in result.stdout
    assert "\ncollided: " in result.stdout
    assert [each["decision"] for each in read_lines("run/events.jsonl") if each["event"] == "collision"] == [1]
    record = json.loads(Path("run/summary.json").read_text())
    assert record["exploration"]["collisions"] == 1
    assert record["exploration"]["way_m"] < 0.4
    assert cv2.VideoCapture("film.mp4").get(cv2.CAP_PROP_FRAME_COUNT) > 1


@pytest.mark.slow
def test_scans_that_contradict_the_map_make_what_is_said_doubtful(ial: Cli) -> None:
    words = ("--world", "plan:office", "--seed", 2, "--outliers", 0, "--drives", 0)
    result = ial("explore", "--map", "plan:ring", *words, "--out", "run")
    assert result.exit_code == 3
    assert "\ngave up after 0 drives, 0.00 m: blind, 1 place\n" in result.stdout
    assert "\ndoubtful: 1 of 1 scans contradict what was known before" in result.stdout


@pytest.mark.slow
def test_bounds_follow_from_simulated_errors_unless_they_are_said(ial: Cli) -> None:
    def config(*options: object) -> Any:
        ial(*ROOMS, "--drives", 0, "--out", "run", "--overwrite", "--range-error-m", 0.05, "--bad-beams", 3, *options)
        return yaml.safe_load(Path("run/config.yaml").read_text())

    plain = config("--radius", 0.1)
    assert (plain["range_error_m"], plain["outliers"], plain["robot_radius_m"]) == (0.05, 3, 0.25)
    said = config("--set", "range_error_m=0.06", "--world", "plan:rooms", "--clearance", 0.3)
    assert (said["range_error_m"], said["outliers"], said["robot_radius_m"]) == (0.06, "auto", 0.3)


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (["--start", 0.1, 0.1, 0], "lies in something that is not free"),
        (["--start", 0.4, 5.9, 0], "is nearer than the clearance, 0.35 m"),
        (["--start", 99, 1, 0], "lies outside of the map"),
        (["--start", "nan", 1, 0], "is no pose; give finite numbers"),
        (["--radius", 5], "fits nowhere in this map"),
        (["--radius", "nan"], "--radius is nan"),
        (["--clearance", 0.1], "at least the radius of the robot, 0.2 m"),
        (["--alpha", -1], "alpha is -1"),
        (["--beta", -0.5], "beta -0.5"),
        (["--alpha", 0.5, "--planner", "random"], "--alpha: not an option of the planner random"),
        (["--map", "plan:palace"], "there is no plan called 'palace'; give one of rooms, office"),
        (["--world", "plan:palace"], "there is no plan called 'palace'"),
        (["--map", "missing.yaml"], "missing.yaml: the map does not exist"),
        (["--animate", "film.avi"], "give a name that ends in .gif or .mp4"),
        (["--beams", 0], "needs at least 1 beam"),
        (["--range", 0], "--range is 0"),
        (["--range", 0.06], "no usable beam"),
        (["--fov", 0], "--fov is 0; give an angle above 0 and up to 360 degrees"),
        (["--fov", 361], "--fov is 361"),
        (["--drives", -1], "--drives is -1"),
        (["--bad-beams", -1], "--bad-beams is -1"),
        (["--bad-beams", 91], "--bad-beams is 91; give a number from 0 to --beams, 90"),
        (["--clearance", 0.3, "--set", "robot_radius_m=0.5"], "--clearance and --set robot_radius_m say the same; give one of them"),
        (["--range-error-m", -0.1], "range_error_m is -0.1"),
        (["--set", "nonsense=1"], "unknown key 'nonsense'"),
    ],
)
def test_bad_input_is_refused_in_one_line(refused: Refused, options: list[object], words: str) -> None:
    assert words in refused("explore", "--out", "run", *options)


def test_the_help_names_every_plan() -> None:
    (plans,) = re.findall(r"floor plan: ([\w, ]+)\.", get_args(MapChoice)[1].help)
    assert tuple(plans.split(", ")) == plan_names()


def test_an_unknown_planner_is_a_wrong_usage(ial: Cli) -> None:
    result = ial("explore", "--planner", "luck")
    assert result.exit_code == 2
    assert "'direction'" in result.stderr


def test_no_start_is_free_in_two_worlds_that_do_not_meet(refused: Refused) -> None:
    write_map(OccupancyGrid(np.full((40, 40), OCCUPIED, dtype=np.uint8), 0.05), Path("full.yaml"))
    assert "no start was found" in refused("explore", "--map", "plan:ring", "--world", "full.yaml", "--out", "run")
    assert "cannot start at" in refused("explore", "--world", "full.yaml", "--out", "run")

import json
from fractions import Fraction
from itertools import islice
from pathlib import Path

import pytest

from ial.bouncing.filters.filter_file import read_filter
from ial.bouncing.filters.piece_filter import PieceFilter
from ial.bouncing.rays.real_robot import RealRobot
from ial.cli.bounce.piece_outcome import outcome
from ial.maps.polygons.environment import load_environment
from tests.cli.bounce.hall import REAL, ROOMS, Cli


@pytest.mark.slow
@pytest.mark.parametrize("radius", ["0", "1/5"])
def test_a_robot_with_errors_is_localized_in_a_room_from_two_commands(ial: Cli, hall: Path, sets: Path, radius: str) -> None:
    built = ial("bounce", "build", hall, *REAL, *ROOMS, "--radius", radius, "--out", sets, "--overwrite")
    assert ("a disk of radius 0.2 m" if radius != "0" else "a point") + " with real geometry" in built.stdout
    noise = ("--turn-error", 2, "--step-error", "0.02", "--count-error", 1, "--step", "1/4", "--angle", 100)
    told = set()
    for seed in range(6):
        more = ("--radius", radius, "--seed", seed, "--steps", 300, "--out", "s.txt", "--truth", "t.csv", "--overwrite")
        assert ial("bounce", "simulate", hall, *noise, *more).exit_code == 0
        record = json.loads(ial("bounce", "run", sets, "--file", "s.txt", "--json").stdout)
        assert record["rejected_at"] == []
        assert record["observations"] == 300
        poses = [line.split(",") for line in Path("t.csv").read_text().splitlines()[1:]]
        x, y = next((float(pose[1]), float(pose[2])) for pose in reversed(poses) if pose[0] == "1")
        box = record["last_bump_m"]
        assert box["x0"] <= x <= box["x1"]
        assert box["y0"] <= y <= box["y1"]
        if record["localized"]:
            assert (x <= 5) if record["room"] == "left" else (x >= 5)
            told.add(record["room"])
            words = ial("bounce", "run", sets, "--file", "s.txt").stdout
            assert f"after 300 observations: localized in {record['room']}, {record['pieces']} pieces of walls in hall" in words
            assert "the last bump was at x " in words
    assert told == {"left", "right"}


@pytest.mark.slow
def test_a_robot_may_be_localized_by_a_step_without_a_bump(ial: Cli, hall: Path) -> None:
    """What is told of the first time agrees with what every shorter stream tells."""
    assert ial("bounce", "build", hall, *REAL, "--headings", 36, "--part", "1/2", "--within", 4, "--out", "f.npz").exit_code == 0
    made = read_filter(Path("f.npz"))
    assert isinstance(made, PieceFilter)
    by_steps = 0
    for seed in range(12):
        robot = RealRobot(load_environment(hall), Fraction(100), Fraction(1, 4), bounds=made.bounds, seed=seed)
        stream = [pose.observation for pose in islice(robot.run(), 120)]
        first = outcome(made, stream, False)["localized_at"]
        told = next((at for at in range(1, len(stream) + 1) if outcome(made, stream[:at], False)["localized"]), None)
        assert first == told
        by_steps += first is not None and not stream[first - 1]
    assert by_steps > 0


def test_run_with_a_set_filter_says_what_it_does_not_know(ial: Cli, sets: Path) -> None:
    result = ial("bounce", "run", sets, "--stream", "000")
    assert (result.exit_code, result.stdout) == (3, "after 3 observations: no bump yet\n")
    result = ial("bounce", "run", sets, "--stream", "0001")
    assert result.exit_code == 3
    assert "after 4 observations: not localized, 10944 pieces of walls in hall" in result.stdout
    result = ial("bounce", "run", sets, "--stream", "0" * 60)
    assert result.exit_code == 3
    assert "rejected at observation 48: no place in the environment fits" in result.stdout
    assert "after 60 observations: not in the environment" in result.stdout
    assert "no bump yet" in ial("bounce", "run", sets, "--stream", "0" * 60, "--restart").stdout
    result = ial("bounce", "run", sets, "--stream", "0" * 60, "--world", "closed")
    assert result.exit_code == 2
    assert "observation 48 of the stream fits no place" in result.stderr

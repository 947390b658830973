from pathlib import Path

from ial.active.decision import Decision
from ial.results.active.decisions import DecisionsFile
from ial.results.lidar.json_lines import read_lines
from tests.results.active.legs import driven, leg


def test_a_line_says_what_was_decided_and_what_came_of_it(tmp_path: Path) -> None:
    path = tmp_path / "decisions.jsonl"
    with DecisionsFile(path) as file:
        file.add(leg(0))
        file.add(leg(1, driven("backtrack", target=(1.5, -0.25), since=1, open=(1, 2)), collided=True))
        file.add(leg(2, Decision(None, "exhausted", "nothing is left")))
    first, second = read_lines(path)
    assert {name: first[name] for name in ("number", "stage", "reason", "since", "open", "goes_on", "collided")} == {
        "number": 1,
        "stage": "backtrack",
        "reason": "because",
        "since": 1,
        "open": [1, 2],
        "goes_on": False,
        "collided": True,
    }
    assert [float(first["turn_rad"]), float(first["distance_m"]), *map(float, first["target"])] == [0.5, 0.4, 1.5, -0.25]
    assert (first["hypotheses_before"], first["hypotheses"]) == (3, leg(0).hypotheses)
    assert first["status"] == leg(0).estimate.status
    assert (second["turn_rad"], second["distance_m"], second["target"], second["stage"]) == (None, None, None, "exhausted")


def test_a_decision_can_be_said_in_words() -> None:
    assert leg(0).words == "first look"
    assert leg(1, driven("view")).words == "view: because; turn 29°, drive 0.40 m"
    assert leg(1, Decision(None, "exhausted", "nothing is left")).words == "exhausted: nothing is left"

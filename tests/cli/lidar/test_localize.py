import json
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
import yaml

from ial.datasets.trajectory import read_tum
from ial.results.lidar.enclosures import read_enclosures

FILES = ["config.yaml", "enclosures.jsonl", "events.jsonl", "picture.png", "result.mcap", "summary.json", "trajectory.tum"]


def bounds_of(folder: Path) -> list[Any]:
    """What must not differ between runs: everything but the time that a scan took."""
    return [(each.stamp_ns, each.index, each.status, each.hypotheses, each.pose) for each in read_enclosures(folder / "enclosures.jsonl")]


@pytest.mark.slow
def test_the_sample_ends_localized_where_it_should(ial: Callable[..., Any], tmp_path: Path) -> None:
    result = ial("localize", "--out", "run")
    assert result.exit_code == 0
    assert result.stdout.startswith("localized, at scan 36: x 15.")
    assert result.stdout.splitlines()[-1] == "results in run"
    assert sorted(file.name for file in (tmp_path / "run").iterdir()) == FILES
    *_, last = read_enclosures(tmp_path / "run" / "enclosures.jsonl")
    (hypothesis,) = last.hypotheses
    for x in hypothesis.x:
        for y in hypothesis.y:
            assert math.dist((x, y), (15.89, -10.0)) <= 0.5


@pytest.mark.slow
def test_json_is_the_summary_and_nothing_else(ial: Callable[..., Any], tmp_path: Path) -> None:
    result = ial("localize", "--out", "run", "--every", 3, "--json")
    record = json.loads(result.stdout)
    assert record == json.loads((tmp_path / "run" / "summary.json").read_text())
    assert (result.exit_code, record["localized"], record["scans"]["processed"]) == (0, True, 13)
    assert record["options"]["every"] == 3


@pytest.mark.slow
def test_never_localized_is_status_3_and_writes_results(ial: Callable[..., Any], tmp_path: Path) -> None:
    result = ial("localize", "--out", "run", "--to", 2, "--outliers", 0.5)
    assert result.exit_code == 3
    assert result.stdout.startswith("never localized")
    assert sorted(file.name for file in (tmp_path / "run").iterdir()) == FILES
    assert (tmp_path / "run" / "trajectory.tum").read_text() == ""


@pytest.mark.slow
def test_without_out_a_stamped_folder_and_a_link_to_the_latest(ial: Callable[..., Any], tmp_path: Path) -> None:
    for _ in range(2):
        assert ial("localize", "--to", 1).exit_code == 0
    latest = tmp_path / "out" / "latest"
    runs = [each for each in latest.parent.iterdir() if each != latest]
    assert len(runs) == 2
    assert all(run.name.startswith("sample-") for run in runs)
    assert latest.is_symlink()
    assert (latest / "summary.json").exists()


@pytest.mark.slow
def test_from_every_and_to_choose_raw_scans(ial: Callable[..., Any], tmp_path: Path) -> None:
    ial("localize", "--out", "run", "--from", 1, "--every", 4, "--to", 10)
    assert [each.index for each in read_enclosures(tmp_path / "run" / "enclosures.jsonl")] == [1, 5, 9]


@pytest.mark.slow
def test_static_scans_do_not_depend_on_each_other(ial: Callable[..., Any], tmp_path: Path) -> None:
    ial("localize", "--out", "both", "--static", "--from", 30, "--every", 6)
    ial("localize", "--out", "one", "--static", "--from", 36)
    assert bounds_of(tmp_path / "both")[1:] == bounds_of(tmp_path / "one")


@pytest.mark.slow
def test_threads_change_nothing(ial: Callable[..., Any], tmp_path: Path) -> None:
    for threads in (1, 2):
        ial("localize", "--out", threads, "--to", 3, "--threads", threads)
        assert json.loads((tmp_path / str(threads) / "summary.json").read_text())["options"]["threads"] == threads
    assert bounds_of(tmp_path / "1") == bounds_of(tmp_path / "2")


@pytest.mark.slow
def test_a_known_start_narrows_the_first_answer(ial: Callable[..., Any], tmp_path: Path) -> None:
    ial("localize", "--out", "all", "--to", 1)
    first = bounds_of(tmp_path / "all")[0][3][0]
    at = [0.5 * sum(first.x), 0.5 * sum(first.y), 0.5 * sum(first.theta)]
    for turns in (0, -1, 100):
        start = (*at[:2], at[2] + 2.0 * math.pi * turns)
        ial("localize", "--out", f"near{turns}", "--to", 1, "--initial", *start, "--initial-radius", 0.4, 0.3)
        (near,) = (scan[3] for scan in bounds_of(tmp_path / f"near{turns}"))
        assert len(near) >= 1
        assert all(abs(0.5 * sum(each.x) - at[0]) < 0.6 and abs(0.5 * sum(each.y) - at[1]) < 0.6 for each in near)


@pytest.mark.slow
def test_the_report_names_the_measures(ial: Callable[..., Any], tmp_path: Path) -> None:
    (tmp_path / "truth.tum").write_text("1137772793.094853 0 0 0 0 0 0 1\n")
    lines = ial("localize", "--out", "run", "--to", 1, "--truth", "truth.tum").stdout.splitlines()
    assert "reference contained in 0.00 % of 1 scans, in a hull in 0.00 %" in lines
    assert "where the assumptions hold (0 scans): contained in none" in lines
    assert "what breaks them elsewhere: beams in 1 scan, domain in 1 scan" in lines


@pytest.mark.slow
def test_its_own_trajectory_as_truth(ial: Callable[..., Any], tmp_path: Path) -> None:
    ial("localize", "--out", "first", "--every", 3)
    truth = tmp_path / "first" / "trajectory.tum"
    record = json.loads(ial("localize", "--out", "second", "--every", 3, "--truth", truth, "--json").stdout)
    measures = record["measures"]
    assert measures["scans_with_reference"] == len(read_tum(truth))
    assert measures["contained"] == measures["contained_hull"] == 1.0
    assert measures["truth_frame"] == "base"


@pytest.mark.slow
def test_a_truth_of_another_time_is_pointed_out(ial: Callable[..., Any], tmp_path: Path) -> None:
    (tmp_path / "truth.tum").write_text("5.0 1 2 0 0 0 0 1\n")
    result = ial("localize", "--out", "run", "--to", 1, "--truth", "truth.tum")
    assert "no scan has a reference" in result.stdout
    assert json.loads((tmp_path / "run" / "summary.json").read_text())["measures"]["contained"] is None


@pytest.mark.slow
def test_the_written_configuration_is_the_one_that_was_used(ial: Callable[..., Any], tmp_path: Path) -> None:
    ial("localize", "--out", "first", "--to", 1, "--outliers", 11, "--set", "precision.position_m=0.2")
    config = yaml.safe_load((tmp_path / "first" / "config.yaml").read_text())
    assert (config["outliers"], config["precision"]["position_m"]) == (11, 0.2)
    ial("localize", "--out", "second", "--to", 1, "--config", "first/config.yaml")
    assert bounds_of(tmp_path / "first") == bounds_of(tmp_path / "second")


@pytest.mark.slow
def test_the_map_may_come_out_of_a_recording(ial: Callable[..., Any], sample: Path, tmp_path: Path) -> None:
    ial("localize", "--out", "first", "--to", 2)
    ial("localize", sample, "--map", "first/result.mcap", "--out", "second", "--to", 2)
    first, second = (read_enclosures(tmp_path / run / "enclosures.jsonl") for run in ("first", "second"))
    assert [len(each.hypotheses) for each in first] == [len(each.hypotheses) for each in second]  # 0.05 is rounded to float32 there


@pytest.mark.slow
def test_a_scan_without_a_beam_is_counted_and_the_prediction_carried_on(
    ial: Callable[..., Any], bag: Any, room: Path, tmp_path: Path
) -> None:
    record = json.loads(ial("localize", bag.write(blank=[1]), "--map", room, "--out", "run", "--json").stdout)
    assert (record["scans"]["processed"], record["scans"]["uninformative"]) == (3, 1)
    _, second, _ = read_enclosures(tmp_path / "run" / "enclosures.jsonl")
    assert (second.beams, second.uninformative, second.status) == (0, True, "ambiguous")
    assert second.hypotheses
    events = [json.loads(line) for line in (tmp_path / "run" / "events.jsonl").read_text().splitlines()]
    assert [event["index"] for event in events if event["event"] == "uninformative"] == [1]


@pytest.mark.slow
def test_as_many_outliers_as_beams_say_nothing(ial: Callable[..., Any], bag: Any, room: Path) -> None:
    result = ial("localize", bag.write(), "--map", room, "--out", "run", "--outliers", 3)
    assert (result.exit_code, "uninformative: 3 scans" in result.stdout) == (3, True)


def test_dump_config_needs_no_recording(ial: Callable[..., Any], tmp_path: Path) -> None:
    result = ial("localize", "missing.bag", "--dump-config", "--outliers", "0.3")
    assert (result.exit_code, yaml.safe_load(result.stdout)["outliers"]) == (0, 0.3)
    assert list(tmp_path.iterdir()) == []

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

Cli = Callable[..., Any]


def test_the_sample(ial: Cli, sample: Path) -> None:
    result = ial("info", sample)
    assert (result.exit_code, result.stderr) == (0, "")
    for part in ("/scan", "sensor_msgs/msg/LaserScan", "37 in 9.28 s", "361 per scan", "12.8 m travelled", "x 0.780 m"):
        assert part in result.stdout


def test_json(ial: Cli, sample: Path) -> None:
    record = json.loads(ial("info", sample, "--json").stdout)
    assert (record["scans"], record["beams"], record["missing"]) == (37, [361], [])


def test_two_scan_topics_are_listed_with_what_to_do(ial: Cli, bag: Any) -> None:
    path = bag.write(topics=("/front", "/rear"))
    result = ial("info", path)
    assert result.exit_code == 2
    assert "/front" in result.stdout
    assert result.stderr.startswith("missing: ")
    assert "--scan-topic /front" in result.stderr
    assert ial("info", path, "--scan-topic", "/rear").exit_code == 0


def test_skipped_scans_are_counted_with_the_reason(ial: Cli, bag: Any) -> None:
    result = ial("info", bag.write(angle_increment=0.0))
    assert result.exit_code == 2
    assert "skipped     3 × scan with an angle increment of zero" in result.stdout


def test_a_missing_file(ial: Cli) -> None:
    result = ial("info", "missing.bag")
    assert (result.exit_code, result.stdout) == (2, "")
    assert result.stderr.startswith("error: missing.bag: ")


def test_names_of_topics_are_shown_as_they_are_and_steer_no_terminal(ial: Cli, bag: Any) -> None:
    shown = ial("info", bag.write(topics=("/front[bold]", "/rear\x1b[31m"))).stdout
    assert "/front[bold] " in shown
    assert "/rear\\x1b[31m " in shown
    assert "\x1b" not in shown

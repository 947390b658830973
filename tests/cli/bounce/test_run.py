import json
from collections.abc import Callable
from pathlib import Path

from typer.testing import CliRunner

from ial.cli.main import app
from tests.cli.bounce.hall import Cli, stream_of


def test_run_localizes(ial: Cli, built: Path) -> None:
    stream = stream_of(built)
    result = ial("bounce", "run", built, "--stream", stream)
    assert result.exit_code == 0
    assert "after 60 observations: localized (colour" in result.stdout
    assert "hall: x " in result.stdout
    Path("stream.txt").write_text(stream[:30] + "\n" + stream[30:] + "\n")
    record = json.loads(ial("bounce", "run", built, "--file", "stream.txt", "--json").stdout)
    assert record["localized"]
    assert record["configurations"] == sum(len(place["headings_deg"]) for place in record["places"])
    assert record["rejected_at"] == []
    assert ial("bounce", "run", built, "--file", "stream.txt", "--world", "closed").stdout == result.stdout


def test_run_reads_standard_input(ial: Cli, built: Path) -> None:
    stream = stream_of(built)
    result = CliRunner().invoke(app, ["bounce", "run", str(built), "--file", "-"], input=f"{stream[:9]}\n{stream[9:]}\n")
    assert result.exit_code == 0
    assert result.stdout == ial("bounce", "run", built, "--stream", stream).stdout


def test_a_robot_that_is_not_localized_or_elsewhere(ial: Cli, built: Path) -> None:
    result = ial("bounce", "run", built, "--stream", "0")
    assert result.exit_code == 3
    assert "not localized yet" in result.stdout
    elsewhere = ial("bounce", "run", built, "--stream", "0" * 12)
    assert elsewhere.exit_code == 3
    assert "rejected at observation 9" in elsewhere.stdout
    assert "in none of the environments" in elsewhere.stdout
    carried = ial("bounce", "run", built, "--restart", "--stream", "0" * 9 + stream_of(built))
    assert carried.exit_code == 0
    assert "rejected at observation 9" in carried.stdout
    assert "localized (colour" in carried.stdout


def test_bad_filters_and_streams_are_refused(refused: Callable[..., str], built: Path, hall: Path) -> None:
    assert "symbol 3 of the stream is '2'" in refused("bounce", "run", built, "--stream", "012")
    assert "one of --stream BITS, --file FILE and --log FILE" in refused("bounce", "run", built)
    assert "one of --stream BITS, --file FILE and --log FILE" in refused("bounce", "run", built, "--stream", "0", "--file", "x")
    assert "cannot be read" in refused("bounce", "run", built, "--file", "nowhere.txt")
    assert "fits no place of the environment" in refused("bounce", "run", built, "--world", "closed", "--stream", "0" * 12)
    assert "two environments have the same name" in refused("bounce", "build", hall, hall, "--out", "f.npz")
    Path("cut.npz").write_bytes(built.read_bytes()[:500])
    assert "truncated" in refused("bounce", "run", "cut.npz", "--stream", "0")
    Path("bad.txt").write_bytes(b"\xff")
    assert "no text" in refused("bounce", "run", built, "--file", "bad.txt")

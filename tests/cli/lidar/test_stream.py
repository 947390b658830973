"""`ial stream` as a process: what goes in, what comes out, and what is left when it is killed."""

import contextlib
import json
import random
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from ial.datasets.conversion import convert_to_lines
from ial.datasets.opening import open_recording
from ial.datasets.sample import sample_map_path, sample_recording, sample_recording_path

Starter = Callable[..., subprocess.Popen[bytes]]

MAP = str(sample_map_path())
COMMAND = [sys.executable, "-c", "from ial.cli.entry import main; main()", "stream", "--map", MAP]


@pytest.fixture(scope="module")
def lines(tmp_path_factory: pytest.TempPathFactory) -> list[bytes]:
    path = tmp_path_factory.mktemp("lines") / "sample.jsonl"
    convert_to_lines(sample_recording(), path)
    return path.read_bytes().splitlines(keepends=True)


def stream(lines: list[bytes], *options: object) -> subprocess.CompletedProcess[bytes]:
    return subprocess.run([*COMMAND, *map(str, options)], input=b"".join(lines), capture_output=True, timeout=120, check=False)


@pytest.fixture(scope="module")
def expected(lines: list[bytes]) -> bytes:
    """What an uninterrupted run writes."""
    result = stream(lines)
    assert result.returncode == 0, result.stderr
    return result.stdout


@pytest.fixture
def process() -> Iterator[Starter]:
    """Return a function that starts a stream, which does not outlive the test."""
    running: list[subprocess.Popen[bytes]] = []

    def start(*options: object) -> subprocess.Popen[bytes]:
        pipe = subprocess.PIPE
        running.append(subprocess.Popen([*COMMAND, *map(str, options)], stdin=pipe, stdout=pipe, stderr=pipe))
        return running[-1]

    yield start
    for each in running:
        each.kill()
        for file in (each.stdin, each.stdout, each.stderr):
            if file is not None:
                with contextlib.suppress(BrokenPipeError):
                    file.close()
        each.wait()


@pytest.mark.slow
def test_one_line_for_each_scan_with_the_enclosures_of_localize(ial: Callable[..., Any], expected: bytes) -> None:
    ial("localize", "--out", "whole")
    whole = [json.loads(line) for line in Path("whole/enclosures.jsonl").read_text().splitlines()]
    for line in whole:
        del line["elapsed_s"]
    assert [json.loads(line) for line in expected.splitlines()] == whole


@pytest.mark.slow
def test_a_recording_in_place_of_standard_input(expected: bytes) -> None:
    assert stream([], sample_recording_path()).stdout == expected


@pytest.mark.slow
def test_a_line_is_out_before_the_next_scan_is_in(lines: list[bytes], process: Starter, expected: bytes) -> None:
    running = process()
    assert running.stdin is not None
    assert running.stdout is not None
    for number in range(3):
        running.stdin.writelines(lines[2 * number : 2 * number + 2])
        running.stdin.flush()
        assert running.stdout.readline() == expected.splitlines(keepends=True)[number]


@pytest.mark.slow
@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGINT])
def test_a_signal_ends_it_cleanly_while_it_waits(number: int, lines: list[bytes], process: Starter, expected: bytes) -> None:
    running = process()
    assert running.stdin is not None
    assert running.stdout is not None
    running.stdin.writelines(lines[:2])
    running.stdin.flush()
    assert running.stdout.readline() == expected.splitlines(keepends=True)[0]
    running.send_signal(number)
    rest, said = running.communicate(timeout=30)
    assert (running.returncode, rest) == (0, b"")
    assert b"1 scans: 1 localized" in said


@pytest.mark.slow
def test_killed_at_random_moments_nothing_is_missing_repeated_or_different(lines: list[bytes], process: Starter, expected: bytes) -> None:
    chance = random.Random(7)
    out, state = Path("out.jsonl"), Path("state")
    for kill in range(5):
        running = process("--out", out, "--state", state)
        assert running.stdin is not None
        fed = 3 + 6 * kill
        running.stdin.writelines(lines[: 2 * fed])  # from the beginning, as `cat` would
        running.stdin.flush()
        deadline = time.monotonic() + 60.0
        while (out.read_bytes().count(b"\n") if out.exists() else 0) < fed - 2 and time.monotonic() < deadline:
            time.sleep(0.0005)
        time.sleep(chance.uniform(0.0, 0.005))
        running.kill()
        running.wait()
        assert 0 < out.stat().st_size < len(expected)
    result = stream(lines, "--out", out, "--state", state)
    assert result.returncode == 0
    assert b"goes on after scan" in result.stderr
    assert out.read_bytes() == expected


@pytest.mark.slow
def test_a_live_source_that_went_on_is_followed_from_where_it_is(lines: list[bytes]) -> None:
    state = Path("state")
    first = stream(lines[:20], "--state", state).stdout.splitlines()
    second = stream(lines[26:40], "--state", state).stdout.splitlines()
    assert [json.loads(line)["index"] for line in [*first, *second]] == list(range(17))
    assert {json.loads(line)["status"] for line in second} == {"localized"}


@pytest.mark.slow
def test_a_deadline_marks_the_answers_that_it_made_coarser(lines: list[bytes]) -> None:
    result = stream(lines, "--deadline", 0.001)
    assert result.returncode == 0
    answers = [json.loads(line) for line in result.stdout.splitlines()]
    assert len(answers) == 37
    assert answers[0]["limited"] == "time"


@pytest.mark.slow
def test_neither_plotting_nor_bags_nor_the_checker_of_configurations_is_imported(lines: list[bytes], ial: Callable[..., Any]) -> None:
    Path("config.yaml").write_text(ial("localize", "--outliers", "0.2", "--dump-config").stdout)
    script = (
        "import atexit, sys\n"
        "atexit.register(lambda: print(*sys.modules, file=sys.stderr))\n"
        f"sys.argv = ['ial', 'stream', '--map', {MAP!r}, '--config', 'config.yaml', '--deadline', '0.5', '--state', 'state']\n"
        "from ial.cli.entry import main\n"
        "main()\n"
    )
    result = subprocess.run([sys.executable, "-c", script], input=b"".join(lines[:4]), capture_output=True, timeout=120, check=True)
    assert result.stdout.count(b"\n") == 2
    imported = {name.partition(".")[0] for name in result.stderr.decode().split()}
    assert "numba" in imported
    assert imported & {"matplotlib", "pydantic", "rosbags", "shapely"} == set()


@pytest.mark.slow
def test_what_is_refused(lines: list[bytes], refused: Callable[..., str]) -> None:
    assert "give --map" in refused("stream")
    assert MAP in refused("stream")
    for content, fault in ((b"", "damaged"), (b"nonsense", "damaged"), (Path(MAP).read_bytes(), "damaged")):
        Path("state").write_bytes(content)
        assert fault in refused("stream", "--map", MAP, "--state", "state")
    Path("state").unlink()
    assert stream(lines[:8], "--state", "state", "--out", "out.jsonl").returncode == 0
    assert "another map, configuration" in refused("stream", "--map", MAP, "--state", "state", "--set", "max_beams=90")
    assert "exists already" in refused("stream", "--map", MAP, "--out", "out.jsonl")
    assert "cannot be written" in refused("stream", "--map", MAP, "--out", "nowhere/out.jsonl")


@pytest.mark.slow
def test_a_reader_that_goes_away_ends_it_with_a_message(lines: list[bytes], process: Starter) -> None:
    running = process()
    assert running.stdin is not None
    assert running.stdout is not None
    running.stdout.close()
    try:
        running.stdin.writelines(lines)
        running.stdin.close()
    except BrokenPipeError:
        pass
    assert running.stderr is not None
    said = running.stderr.read()
    assert running.wait(30) == 2
    assert b"nobody reads the lines" in said
    assert b"Traceback" not in said


def test_convert_writes_the_lines_of_the_embedded_recording(
    ial: Callable[..., Any], refused: Callable[..., str], lines: list[bytes]
) -> None:
    assert ial("convert", "--jsonl", "sample.jsonl").exit_code == 0
    assert Path("sample.jsonl").read_bytes() == b"".join(lines)
    assert ial("convert", "--jsonl", "-").stdout == b"".join(lines).decode()
    assert len(list(open_recording(Path("sample.jsonl")).readings())) == 37
    assert "one file is written" in refused("convert", "sample.jsonl", "a.mcap", "--jsonl", "b.jsonl")
    assert "one file is written" in refused("convert", "sample.jsonl")
    assert "an input of the command" in refused("convert", "sample.jsonl", "--jsonl", "sample.jsonl", "--overwrite")
    assert "cannot be written" in refused("convert", "--jsonl", "nowhere/sample.jsonl")
    assert [path.name for path in Path().iterdir()] == ["sample.jsonl"]


@pytest.mark.parametrize("deadline", ["0", "nan", "-1", "inf"])
def test_a_deadline_that_is_none_is_refused_by_its_name(lines: list[bytes], deadline: str) -> None:
    result = stream(lines[:2], "--deadline", deadline)
    assert result.returncode == 2
    assert f"--deadline {deadline}: give a number of seconds above 0" in result.stderr.decode()


@pytest.mark.slow
def test_a_state_without_a_folder_and_lines_into_a_folder_are_refused_before_any_work(lines: list[bytes], tmp_path: Path) -> None:
    for options, message in ((("--state", tmp_path / "no" / "state"), "there is no folder"), (("--out", tmp_path), "is a folder")):
        result = stream(lines[:2], *options)
        assert result.returncode == 2
        assert message in result.stderr.decode()
        assert result.stdout == b""


@pytest.mark.slow
def test_its_own_input_is_not_written_to(lines: list[bytes]) -> None:
    path = Path("fed.jsonl")
    path.write_bytes(b"".join(lines))
    for options, appended in ((("--out", path, "--overwrite"), False), (("--state", path), False), ((), True)):
        with path.open("rb") as source, path.open("ab") as target:
            result = subprocess.run(
                [*COMMAND, *map(str, options)],
                stdin=source,
                stdout=target if appended else subprocess.DEVNULL,
                stderr=subprocess.PIPE,
                timeout=120,
                check=False,
            )
        assert result.returncode == 2
        assert b"this is an input of the command" in result.stderr
        assert path.read_bytes() == b"".join(lines)

"""The file of `ial stream --out` and the state it belongs to: wherever a run is killed, nothing is lost and nothing foreign is touched."""

import os
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from ial.cli.lidar.answer_file import AnswerFile
from ial.cli.lidar.streaming import Streaming
from ial.cli.shell.inputs import Inputs
from ial.datasets.conversion import convert_to_lines
from ial.datasets.sample import sample_map_path, sample_recording
from ial.errors import OutputError
from ial.lidar.configuration.config import LocalizerConfig
from ial.lidar.output_end import KEPT, OutputEnd

Cli = Callable[..., Any]
Refused = Callable[..., str]

OUT, STATE, PART = Path("out.jsonl"), Path("state"), Path(".state.ial-part")
OPTIONS = ("--map", sample_map_path(), "--out", OUT, "--state", STATE)


@pytest.fixture(scope="module")
def lines(tmp_path_factory: pytest.TempPathFactory) -> list[bytes]:
    """The odometry and the scans of the sample."""
    path = tmp_path_factory.mktemp("lines") / "sample.jsonl"
    convert_to_lines(sample_recording(), path)
    return path.read_bytes().splitlines(keepends=True)


@pytest.fixture(scope="module")
def expected(lines: list[bytes], tmp_path_factory: pytest.TempPathFactory) -> list[bytes]:
    """What an uninterrupted run over four scans writes."""
    fed, out = (tmp_path_factory.mktemp("whole") / name for name in ("fed.jsonl", "out.jsonl"))
    fed.write_bytes(b"".join(lines[:8]))
    Streaming(Inputs(fed, sample_map_path()), LocalizerConfig(), out).run()
    written = out.read_bytes().splitlines(keepends=True)
    assert len(written) == 4
    return written


@pytest.fixture
def feed(ial: Cli, lines: list[bytes]) -> Callable[..., Any]:
    """Return a function that runs a stream over the first scans, with other options if any are given."""

    def run(scans: int, *options: object) -> Any:
        Path("fed.jsonl").write_bytes(b"".join(lines[: 2 * scans]))
        return ial("stream", "fed.jsonl", *(options or OPTIONS))

    return run


class _KilledError(BaseException):
    """No handler of the program sees it."""


class _Killer:
    """Ends a run at its nth touch of a file of the given names: when it opens, renames or removes one."""

    def __init__(self) -> None:
        self.names: tuple[str, ...] = ()
        self.left = -1

    def __call__(self, event: str, arguments: tuple[Any, ...]) -> None:
        if self.names and event in ("open", "os.rename", "os.remove"):
            paths = [Path(os.fsdecode(each)) for each in arguments[:2] if isinstance(each, str | bytes | os.PathLike)]
            if any(path.name in self.names for path in paths):
                self.left -= 1
                if not self.left:
                    raise _KilledError


_killer = _Killer()
sys.addaudithook(_killer)  # for good: there is no way to take it off


@pytest.fixture
def killed(feed: Callable[..., Any]) -> Iterator[Callable[[int, int], bool]]:
    """Return a function that runs a stream and kills it at a touch of its files; it tells whether there was one."""

    def run(touch: int, scans: int) -> bool:
        _killer.names, _killer.left = (OUT.name, STATE.name, PART.name), touch
        try:
            assert feed(scans).exit_code == 0
        except _KilledError:
            return True
        finally:
            _killer.names = ()
        return False

    yield run
    _killer.names = ()


@pytest.mark.slow
def test_killed_at_any_touch_of_a_file_it_goes_on(
    killed: Callable[[int, int], bool], feed: Callable[..., Any], expected: list[bytes]
) -> None:
    touches = 0
    while killed(touches + 1, 2):
        touches += 1
        assert feed(3).exit_code == 0
        assert OUT.read_bytes() == b"".join(expected[:3])
        assert not PART.exists()
        for path in (OUT, STATE):
            path.unlink()
    assert touches == 1 + 2 * 3 + 1  # the state is looked for, twice replaced in three steps, and the file of the answers is made


@pytest.mark.slow
@pytest.mark.parametrize(("scans", "share"), [(1, 0.0), (1, 0.01), (1, 1.0), (3, 0.0), (3, 0.5), (3, 0.99)])
def test_killed_in_the_middle_of_a_line_it_writes_the_rest(
    feed: Callable[..., Any], expected: list[bytes], scans: int, share: float
) -> None:
    assert feed(scans).exit_code == 0
    last = len(expected[scans - 1])
    os.truncate(OUT, OUT.stat().st_size - last + int(share * last))
    assert feed(scans).exit_code == 0  # no new scan comes
    assert OUT.read_bytes() == b"".join(expected[:scans])


@pytest.mark.slow
def test_a_state_knows_its_file_and_refuses_any_other(feed: Callable[..., Any], refused: Refused, expected: list[bytes]) -> None:
    assert feed(3).exit_code == 0
    state, whole = STATE.read_bytes(), OUT.read_bytes()
    for held in (
        b"x" * 1000,
        b"x" * len(whole),
        b"".join(expected),  # of a run that went on: longer
        whole[: -len(expected[2]) - 1],  # shorter
        whole[:-2] + b"x\n",
        whole[:1] + b"x" + whole[2:],
        whole + b"\n",
        b"",
    ):
        OUT.write_bytes(held)
        assert "is not, or not any more, what the run of the state has written" in refused("stream", "fed.jsonl", *OPTIONS, "--overwrite")
        assert (OUT.read_bytes(), STATE.read_bytes()) == (held, state)
    OUT.unlink()
    assert "is not, or not any more," in refused("stream", "fed.jsonl", *OPTIONS, "--overwrite")
    assert not OUT.exists()
    OUT.write_bytes(whole)
    copy = Path("copy.jsonl")
    copy.write_bytes(whole)
    assert f"belongs to {OUT.resolve()}" in refused("stream", "fed.jsonl", *OPTIONS[:2], "--out", copy, "--state", STATE)
    assert f"wrote to {OUT.resolve()}" in refused("stream", "fed.jsonl", *OPTIONS[:2], "--state", STATE)
    assert (copy.read_bytes(), OUT.read_bytes(), STATE.read_bytes()) == (whole, whole, state)
    assert feed(4).exit_code == 0
    assert OUT.read_bytes() == b"".join(expected)


@pytest.mark.slow
def test_a_state_of_standard_output_is_none_of_a_file(feed: Callable[..., Any], refused: Refused, expected: list[bytes]) -> None:
    result = feed(2, *OPTIONS[:2], "--state", STATE)
    assert result.stdout == b"".join(expected[:2]).decode()
    assert "wrote to standard output" in refused("stream", "fed.jsonl", *OPTIONS)
    assert feed(4, *OPTIONS[:2], "--state", STATE).stdout == b"".join(expected[2:]).decode()


@pytest.mark.slow
def test_a_file_that_looks_like_the_first_line_is_not_taken_for_it(
    feed: Callable[..., Any], refused: Refused, expected: list[bytes]
) -> None:
    for held in (b"", b'{"stamp": ', expected[0][:-200], expected[0]):
        OUT.write_bytes(held)
        assert "exists already" in refused("stream", *OPTIONS)
        assert OUT.read_bytes() == held
    OUT.unlink()
    assert feed(1).exit_code == 0
    for held in (b'{"stamp": 2', b'{"stamp": 1137772793.094853001', expected[0][:-2] + b" }\n"):  # killed, and then somebody wrote there
        OUT.write_bytes(held)
        assert "is not, or not any more," in refused("stream", "fed.jsonl", *OPTIONS)
        assert OUT.read_bytes() == held
    assert feed(4, *OPTIONS, "--overwrite").exit_code == 0, "there is no line yet that could be lost"
    assert OUT.read_bytes() == b"".join(expected)


@pytest.mark.slow
def test_what_belongs_to_one_file_is_not_written_to_another(feed: Callable[..., Any], refused: Refused, tmp_path: Path) -> None:
    options = ("stream", "fed.jsonl", *OPTIONS[:2])
    assert feed(1).exit_code == 0
    state = STATE.read_bytes()
    Path("link").symlink_to(STATE)
    Path("hard").hardlink_to(STATE)
    for out in (STATE, PART, "link", "hard", Path("..") / tmp_path.name / STATE):
        assert "written twice" in refused(*options, "--out", out, "--state", STATE, "--overwrite")
        assert STATE.read_bytes() == state
    assert "written twice" in refused(*options, "--out", "new", "--state", "new")
    assert "written twice" in refused(*options, "--out", ".new.ial-part", "--state", "new")


@pytest.mark.slow
def test_a_state_behind_a_link_stays_there(feed: Callable[..., Any], expected: list[bytes]) -> None:
    STATE.symlink_to("far")
    for scans in (2, 4):
        assert feed(scans).exit_code == 0
        assert STATE.is_symlink()
    assert OUT.read_bytes() == b"".join(expected)


@pytest.mark.slow
def test_nothing_is_written_through_a_link(feed: Callable[..., Any], expected: list[bytes]) -> None:
    Path("mine").write_bytes(b"mine")
    PART.symlink_to("mine")
    assert feed(4).exit_code == 0
    assert OUT.read_bytes() == b"".join(expected)
    assert Path("mine").read_bytes() == b"mine"


def test_a_file_that_something_else_changes_is_left_alone() -> None:
    with AnswerFile(OUT, None, overwrite=False) as file:
        file.append(b"first\n")
        OUT.write_bytes(b"mine")
        with pytest.raises(OutputError, match="holds 4 bytes, and this run has written 6"):
            file.append(b"second\n")
    assert OUT.read_bytes() == b"mine"
    with AnswerFile(OUT, None, overwrite=False) as file, pytest.raises(OutputError, match="File exists"):
        file.append(b"first\n")


@pytest.mark.parametrize("before", [0, 1, KEPT - 1, KEPT, KEPT + 1, 3 * KEPT])
def test_a_file_of_any_length_is_known_again(before: int) -> None:
    with AnswerFile(OUT, None, overwrite=False) as file:
        for size in (before // 2, before - before // 2):
            file.append(b"a" * size)
        known = file.before("é\n")
    for held in (before, before + 1, before + 3):
        OUT.write_bytes(b"a" * before + "é\n".encode()[: held - before])
        with AnswerFile(OUT, known, overwrite=False) as file:
            assert file.before("x") == OutputEnd.of(str(OUT.resolve()), before + 3, b"a" * before + "é\n".encode(), "x")
        assert OUT.read_bytes() == b"a" * before + "é\n".encode()
    if before:
        OUT.write_bytes(b"a" * (before - 1) + "bé\n".encode())
        with pytest.raises(OutputError, match="not any more"):
            AnswerFile(OUT, known, overwrite=True)

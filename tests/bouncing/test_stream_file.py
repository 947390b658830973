from fractions import Fraction
from pathlib import Path

import pytest

from ial.bouncing.rays.real_robot import RealPose
from ial.bouncing.stream import parse_stream
from ial.bouncing.stream_file import read_truth, write_stream, write_truth
from ial.errors import OutputError, StreamError


def test_a_stream_is_read_back(tmp_path: Path) -> None:
    stream = [at % 3 == 0 for at in range(201)]
    write_stream(map(int, stream), tmp_path / "stream.txt")
    text = (tmp_path / "stream.txt").read_text()
    assert parse_stream(text) == stream
    assert max(map(len, text.splitlines())) == 80


def test_the_truth_is_written(tmp_path: Path) -> None:
    write_truth([RealPose(1, Fraction(1, 3), Fraction(-2), Fraction(1, 8))], tmp_path / "truth.csv")
    assert (tmp_path / "truth.csv").read_text() == f"observation,x_m,y_m,heading_deg\n1,{1 / 3!r},-2.0,45.0\n"
    assert [path.name for path in tmp_path.iterdir()] == ["truth.csv"], "no part is left"


def test_a_file_that_cannot_be_written_is_an_error(tmp_path: Path) -> None:
    with pytest.raises(OutputError, match="cannot be written"):
        write_stream([0], tmp_path / "nowhere" / "stream.txt")


def test_the_truth_is_read_back(tmp_path: Path) -> None:
    poses = [RealPose(0, Fraction(1, 4), Fraction(-2), Fraction(1, 8)), RealPose(1, Fraction(3), Fraction(5, 2), Fraction(0))]
    write_truth(poses, tmp_path / "truth.csv")
    assert read_truth(tmp_path / "truth.csv") == poses


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (b"", "the first line is no observation,x_m,y_m,heading_deg"),
        (b"observation,x,y\n", "the first line is no observation,x_m,y_m,heading_deg"),
        (b"observation,x_m,y_m,heading_deg\n0,1,2,3\n1,2,3\n", "truth.csv:3: '1,2,3' is no pose"),
        (b"observation,x_m,y_m,heading_deg\n0,1,2,left\n", "truth.csv:2: '0,1,2,left' is no pose"),
        (b"observation,x_m,y_m,heading_deg\n2,1,2,3\n", "truth.csv:2: the observation is '2'"),
        (b"\xff", "the poses are no text"),
    ],
)
def test_a_truth_that_cannot_be_meant_is_refused(tmp_path: Path, text: bytes, message: str) -> None:
    (tmp_path / "truth.csv").write_bytes(text)
    with pytest.raises(StreamError, match=message):
        read_truth(tmp_path / "truth.csv")


def test_a_truth_that_is_not_there(tmp_path: Path) -> None:
    with pytest.raises(StreamError, match="cannot be read"):
        read_truth(tmp_path / "truth.csv")

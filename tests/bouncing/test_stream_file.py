from fractions import Fraction
from pathlib import Path

import pytest

from ial.bouncing.rays.real_robot import RealPose
from ial.bouncing.stream import parse_stream
from ial.bouncing.stream_file import write_stream, write_truth
from ial.errors import OutputError


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

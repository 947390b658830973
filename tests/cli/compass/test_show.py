from collections.abc import Callable
from pathlib import Path
from typing import Any

import cv2
import pytest

Cli = Callable[..., Any]


@pytest.mark.slow
def test_pictures_of_states_and_of_traces(ial: Cli, sequence: Path) -> None:
    heights = []
    for name, options in [("s", ()), ("t", ("--what", "traces")), ("u", ("--what", "traces", "--start", "1,1", "--start", "1/2,3"))]:
        result = ial("compass", "show", sequence, "--out", f"{name}.png", *options)
        assert result.exit_code == 0
        assert result.stdout == f"picture in {name}.png\n"
        heights.append(cv2.imread(f"{name}.png").shape[:2])
    assert len(set(heights)) == 3


def test_wrong_usage_is_refused(refused: Callable[..., str], sequence: Path) -> None:
    assert "ends in .png" in refused("compass", "show", sequence, "--out", "s.svg")
    assert "--start is for --what traces" in refused("compass", "show", sequence, "--out", "s.png", "--start", "1,1")
    assert "give X,Y in metres" in refused("compass", "show", sequence, "--out", "s.png", "--what", "traces", "--start", "1;1")
    assert "outside of the environment" in refused("compass", "show", sequence, "--out", "s.png", "--what", "traces", "--start", "9,9")
    assert "an input of the command" in refused("compass", "show", sequence, "--out", sequence)

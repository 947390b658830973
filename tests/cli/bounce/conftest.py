"""Filters of the hall, and a picture of it."""

import re
from pathlib import Path

import cv2
import numpy as np
import pytest

from tests.cli.bounce.hall import REAL, ROOMS, WKT, Cli


@pytest.fixture
def hall() -> Path:
    path = Path("hall.wkt")
    path.write_text(WKT)
    return path


@pytest.fixture
def built(ial: Cli, hall: Path) -> Path:
    assert ial("bounce", "build", hall, "--angle", "90", "--cell", 1, "--headings", 4, "--radius", 0, "--out", "hall.npz").exit_code == 0
    return Path("hall.npz")


@pytest.fixture
def sets(ial: Cli, hall: Path) -> Path:
    result = ial("bounce", "build", hall, *REAL, *ROOMS, "--out", "sets.npz")
    assert result.exit_code == 0
    assert "hall: 10944 pieces (152 parts of walls, 72 headings), 42182 arcs" in result.stdout
    assert "turns of 100° ± 2°, steps of 0.25 m ± 2 %, counts ± 1" in result.stdout
    assert "localized is a robot whose last bump was in left or right" in result.stdout
    assert re.search(r"as a C header: 1\d\d,\d\d\d bytes of flash, 2,740 of RAM", result.stdout)
    return Path("sets.npz")


@pytest.fixture
def plan() -> Path:
    """A picture of the hall, a pixel for each half a metre, dark where the wall is, in the frame of the polygons."""
    pixels = np.zeros((14, 18), dtype=np.uint8)
    pixels[:, :10] = pixels[6:, :] = 255
    pixels[6:10, 4:6] = 0  # rows count from the top
    path = Path("plan.png")
    assert cv2.imwrite(str(path), pixels)
    return path

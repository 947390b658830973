"""An L, and a sequence of it."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest


@pytest.fixture
def room_l() -> Path:
    path = Path("l.wkt")
    path.write_text("POLYGON ((0 0, 5 0, 5 2, 2 3, 1 4, 0 4, 0 0))")
    return path


@pytest.fixture
def sequence(ial: Callable[..., Any], room_l: Path) -> Path:
    assert ial("compass", "plan", room_l, "--out", "l.json").exit_code == 0
    return Path("l.json")

"""The package itself: every public name is there, and importing it costs nothing."""

import subprocess
import sys

import pytest

import ial.maps


@pytest.mark.parametrize("name", ial.maps.__all__)
def test_public_names(name: str) -> None:
    assert getattr(ial.maps, name) is not None
    assert name in dir(ial.maps)


def test_unknown_names() -> None:
    with pytest.raises(AttributeError, match="no attribute 'no_such_name'"):
        ial.maps.no_such_name  # noqa: B018


def test_the_import_alone_loads_no_library() -> None:
    code = "import sys, ial.maps; print([n for n in ('numpy', 'numba', 'cv2', 'yaml', 'rosbags') if n in sys.modules])"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


@pytest.mark.slow
def test_a_grid_loads_no_image_or_bag_library() -> None:
    code = "import sys, ial.maps; ial.maps.OccupancyGrid; print([n for n in ('cv2', 'rosbags') if n in sys.modules])"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"

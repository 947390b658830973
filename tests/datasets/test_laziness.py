"""Tests of what `import ial.datasets` costs and offers."""

import subprocess
import sys

import pytest

import ial.datasets


def test_the_package_loads_nothing_heavy() -> None:
    program = "import ial.datasets, sys; print([name for name in ('rosbags', 'numba', 'numpy', 'scipy', 'cv2') if name in sys.modules])"
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


@pytest.mark.slow
def test_a_carmen_log_does_not_need_rosbags() -> None:
    program = "import ial.datasets as d, sys; d.open_recording, d.steps; import ial.datasets.carmen; print('rosbags' in sys.modules)"
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "False"


def test_every_public_name_exists() -> None:
    for name in ial.datasets.__all__:
        assert callable(getattr(ial.datasets, name))
    with pytest.raises(AttributeError, match="no attribute"):
        _ = ial.datasets.nothing

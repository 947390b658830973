"""Where the test data lies: outside the repository, named by two variables."""

import os
from inspect import isfunction
from pathlib import Path

import pytest
from hypothesis import settings
from numba.extending import is_jitted

settings.register_profile("ial", deadline=None, derandomize=True)
settings.load_profile("ial")


def _folder(variable: str) -> Path:
    value = os.environ.get(variable)
    if not value:
        pytest.skip(f"{variable} is not set; set it to the folder of the test data")
    return Path(value)


@pytest.fixture(scope="session")
def data_folder() -> Path:
    """The folder of real recordings and maps."""
    return _folder("IAL_DATA")


@pytest.fixture(scope="session")
def itf1788_folder() -> Path:
    """The folder of the ITF1788 interval test vectors."""
    return _folder("IAL_ITF1788")


def pytest_make_parametrize_id(val: object) -> str | None:
    """Name a function or a kernel by its name: the text of a kernel holds an address, which each worker has its own of."""
    return val.__name__ if is_jitted(val) or isfunction(val) else None

"""Where the test data lies: outside the repository, named by two variables."""

import os
from inspect import isfunction
from pathlib import Path

import pytest
from hypothesis import settings
from numba.extending import is_jitted

from ial.contractors.interpreter import INTERPRETED

settings.register_profile("ial", deadline=None, derandomize=True)
settings.register_profile("interpreted", settings.get_profile("ial"), max_examples=10)  # a kernel takes a hundred times as long then
settings.load_profile("interpreted" if INTERPRETED else "ial")


@pytest.hookimpl(tryfirst=True)  # before pytest itself chooses by marks
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Mark tests by what they need: those of recordings with `data`; those of machine code are skipped where there is none."""
    for item in items:
        if {"data_folder", "itf1788_folder"}.intersection(getattr(item, "fixturenames", ())):
            item.add_marker("data")
        if INTERPRETED and item.get_closest_marker("compiled"):
            item.add_marker(pytest.mark.skip(reason="NUMBA_DISABLE_JIT is set, so nothing is compiled"))


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

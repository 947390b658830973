import doctest
import importlib
import pkgutil

import pytest

import ial

MODULES = [name for _, name, _ in pkgutil.walk_packages(ial.__path__, "ial.") if not name.startswith("ial.cli")]


@pytest.mark.slow
def test_examples_in_docstrings_print_what_they_say() -> None:
    results = {name: doctest.testmod(importlib.import_module(name)) for name in MODULES}
    assert [name for name, result in results.items() if result.failed] == []
    assert sum(result.attempted > 0 for result in results.values()) >= 5

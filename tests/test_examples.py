import doctest
import importlib
import pkgutil

import pytest

import ial

MODULES = [name for _, name, _ in pkgutil.walk_packages(ial.__path__, "ial.") if not name.startswith("ial.cli")]


@pytest.mark.parametrize("name", MODULES)
def test_examples_in_docstrings_print_what_they_say(name: str) -> None:
    assert doctest.testmod(importlib.import_module(name)).failed == 0


def test_there_are_examples() -> None:
    finder = doctest.DocTestFinder()
    modules = map(importlib.import_module, MODULES)
    assert sum(bool(example.examples) for module in modules for example in finder.find(module)) >= 5

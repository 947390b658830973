import importlib
import sys
from fractions import Fraction

import pytest

from ial.maps.polygons.exact import rational as module


def test_numbers_of_either_kind_are_the_same_fraction() -> None:
    assert module.fraction(module.rational(6, 4)) == Fraction(3, 2)
    assert type(module.fraction(module.rational(6, 4))) is Fraction
    assert hash(module.rational(6, 4)) == hash(Fraction(3, 2))


def test_fractions_serve_where_gmpy2_is_missing(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "gmpy2", None)
    try:
        assert importlib.reload(module).rational is Fraction
    finally:
        monkeypatch.undo()
        importlib.reload(module)

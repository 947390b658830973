from fractions import Fraction

import pytest

from ial.compass.sequence import Sequence
from ial.errors import ConfigError
from tests.maps.polygons.known_polygons import SQUARE

SIZES = ((4, 4), (1, 2), (0, 1))
END = (Fraction(4), Fraction(4))


def test_directions_are_kept_as_whole_numbers() -> None:
    sequence = Sequence(SQUARE, ((Fraction(1, 2), 0), (0, 6)), SIZES, END)  # type: ignore[arg-type]
    assert sequence.directions == ((1, 0), (0, 1))
    assert (len(sequence), sequence.bits) == (2, 1)
    assert repr(sequence) == "<Sequence of 2 motions in <Polygon: 4 corners, 0 holes>, ends at (4, 4)>"


def test_floats_are_refused() -> None:
    with pytest.raises(ConfigError, match="give whole numbers or fractions"):
        Sequence(SQUARE, ((1.0, 0.0), (0.0, 1.0)), SIZES, END)  # type: ignore[arg-type]

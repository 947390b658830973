import math
from decimal import Decimal
from fractions import Fraction
from typing import Any

import numpy as np
import pytest

from ial.keys.kind import Kind, Maybe, Number, Truth, Whole, Word, shown

BOUND = Number(least=0.0)
SIZE = Number(above=0.0)


@pytest.mark.parametrize(
    ("kind", "value", "plain"),
    [
        (BOUND, 0, 0.0),
        (BOUND, np.float32(0.1), float(np.float32(0.1))),
        (BOUND, np.int8(3), 3.0),
        (BOUND, Fraction(1, 4), 0.25),
        (SIZE, 5e-324, 5e-324),
        (Number(least=0.5), 0.5, 0.5),
        (Number(above=0.5, most=2.0), 2, 2.0),
        (Number(above=-2.0), -1, -1.0),
        (Whole(1, 9), np.uint8(9), 9),
        (Whole(1), 2**70, 2**70),
        (Truth(), np.bool_(False), False),
        (Word(("a", "b")), "b", "b"),
        (Word(("a", "b")), np.str_("b"), "b"),
        (Maybe(SIZE), None, None),
        (Maybe(SIZE), 3, 3.0),
    ],
)
def test_a_value_is_kept_in_the_plain_types_of_python(kind: Kind, value: Any, plain: Any) -> None:
    kept = kind.checked(value)
    assert kept == plain
    assert type(kept) is type(plain)


@pytest.mark.parametrize(
    ("kind", "value", "said"),
    [
        (BOUND, -5e-324, "give a finite number greater than or equal to 0"),
        (BOUND, math.nan, "finite"),
        (BOUND, 10**400, "finite"),
        (BOUND, True, "give a number, not a truth value"),
        (BOUND, "1", "give a finite number"),
        (BOUND, Decimal(1), "give a finite number"),
        (BOUND, 1j, "give a finite number"),
        (BOUND, None, "give a finite number"),
        (SIZE, 0, "give a finite number greater than 0"),
        (Number(least=0.5, because="so it is"), 0.4, "greater than or equal to 0.5: so it is"),
        (Number(least=0.5, most=2.0), 2.1, "give a finite number greater than or equal to 0.5 and at most 2"),
        (Number(above=0.5, most=2.0), 0.5, "give a finite number greater than 0.5 and at most 2"),
        (Whole(1, 9), 0, "give a whole number from 1 to 9"),
        (Whole(1, 9), 10, "from 1 to 9"),
        (Whole(1), 0, "give a whole number greater than or equal to 1"),
        (Whole(1), 3.0, "give a whole number"),
        (Whole(1), True, "not a truth value"),
        (Truth(), 1, "give true or false"),
        (Truth(), "false", "give true or false"),
        (Word(("a", "b")), "c", "give 'a' or 'b'"),
        (Word(("a", "b")), ["a"], "give 'a' or 'b'"),
        (Maybe(SIZE), -1, "give a finite number greater than 0, or null"),
    ],
)
def test_what_may_not_be_given_is_refused_with_what_may(kind: Kind, value: Any, said: str) -> None:
    with pytest.raises(ValueError, match=said):
        kind.checked(value)


@pytest.mark.parametrize("value", [Fraction(1, 10), 2**53 + 1, np.longdouble(1) / 10])
def test_a_bound_that_would_be_rounded_is_refused(value: Any) -> None:
    """As a double each of these may be smaller than what was said."""
    with pytest.raises(ValueError, match="would be rounded to"):
        BOUND.checked(value)


@pytest.mark.parametrize(
    ("kind", "text", "meant"),
    [
        (BOUND, "1e-3", 1e-3),
        (BOUND, "many", "many"),
        (Whole(1), "3", 3),
        (Whole(1), "9007199254740993", 2**53 + 1),
        (Whole(1), "3.0", 3),
        (Whole(1), 3.0, 3),
        (Whole(1), 3.5, 3.5),
        (Whole(1), "3.5", "3.5"),
        (Whole(1), math.inf, math.inf),
        (Whole(1), "many", "many"),
        (Truth(), "y", True),
        (Truth(), "Off", False),
        (Truth(), 1, True),
        (Truth(), 2, 2),
        (Maybe(BOUND), None, None),
        (Maybe(BOUND), "1e-3", 1e-3),
    ],
)
def test_a_text_may_stand_for_a_value(kind: Kind, text: Any, meant: Any) -> None:
    kept = kind.meant(text)
    assert kept == meant
    assert type(kept) is type(meant)


def test_a_long_value_is_shown_by_how_it_begins() -> None:
    assert shown("ab") == "'ab'"
    assert shown("a" * 500) == "'" + 99 * "a" + "…"
    assert shown(10**5000) == "a number of thousands of digits"


def test_a_number_that_no_file_can_hold_is_refused() -> None:
    with pytest.raises(ValueError, match="at most 300 digits"):
        Whole(1).checked(10**5000)

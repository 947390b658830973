"""`rational`: exact numbers, those of gmpy2 where it is installed and fractions elsewhere; both give the same results."""

from fractions import Fraction
from typing import TYPE_CHECKING, TypeAlias

if TYPE_CHECKING:
    Rational: TypeAlias = Fraction
    rational = Fraction
else:
    try:
        from gmpy2 import mpq as rational
    except ImportError:
        rational = Fraction
    Rational = Fraction | type(rational(0))


def fraction(number: Rational) -> Fraction:
    """Return a number of either kind as a fraction of the standard library."""
    return Fraction(int(number.numerator), int(number.denominator))

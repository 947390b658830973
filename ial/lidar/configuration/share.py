"""`Share`: so many of some beams, as a whole number of them or as a part of all; and `ShareKind`, the keys that have one."""

import functools
import math
from dataclasses import dataclass
from decimal import Decimal
from fractions import Fraction
from numbers import Integral
from typing import Any

import numpy as np

from ial.errors import ConfigError
from ial.keys.kind import LARGEST, Kind, shown

Share = int | float | Fraction


@dataclass(frozen=True)
class ShareKind(Kind):
    """A key that has a share: 1 is one beam, and 1.0 or 1/1 all of them.

    Parameters
    ----------
    auto
        Whether it may also be the word `auto`.
    """

    auto: bool = False

    @property
    def allowed(self) -> str:
        """What may be given."""
        return "a whole number of beams, or a fraction from 0.0 to 1.0 or such as 1/3" + (", or 'auto'" if self.auto else "")

    @property
    def brief(self) -> str:
        """The same, short."""
        return "whole, 0.0 to 1.0, 1/3" + (", `auto`" if self.auto else "")

    def checked(self, value: Any) -> Any:
        """Return a share in the plain types of Python."""
        if self.auto and isinstance(value, str) and value == "auto":
            return str(value)
        share = share_of(value)
        if share is None:
            raise ValueError(f"give {self.allowed}")
        return share

    def meant(self, value: Any) -> Any:
        """Return the share that a text holds."""
        if not isinstance(value, str):
            return value
        text = value.strip()
        try:
            return Fraction(text) if "/" in text else int(text) if text.isdigit() else float(text)
        except (ValueError, ZeroDivisionError):
            return value

    def written(self, value: Any) -> Any:
        """Return a fraction as a text, "1/1" too: 1 would be one beam."""
        return f"{value.numerator}/{value.denominator}" if isinstance(value, Fraction) else value


def share_of(value: object) -> Share | None:
    """Return a share in the plain types of Python; None for what is neither a whole number of beams nor a part from 0 to 1.

    Parameters
    ----------
    value
        An integer of Python or NumPy; or a part, as a float of either, a `Decimal` or a `Fraction`. A float means the decimal that it is
        printed as, so that ``np.float32(0.35)`` is 0.35.
    """
    if isinstance(value, bool | np.bool_):
        return None
    if isinstance(value, Integral):
        return int(value) if 0 <= int(value) <= LARGEST else None
    if isinstance(value, Decimal) and not value.is_finite():
        return None
    if isinstance(value, Decimal | Fraction):
        return Fraction(value) if 0 <= value <= 1 else None
    if isinstance(value, float | np.floating):
        part = float(str(value))
        return part if 0.0 <= part <= 1.0 else None
    return None


def number_of(share: Share, beams: int) -> int:
    """Return how many of some beams a share is: a whole number as it is, the whole part of the product for a part.

    The product is that of the decimal that was written and not of the double next to it: 0.35 of 180 beams are 63, while
    ``0.35 * 180`` is 62.99999999999999.

    Raises
    ------
    ConfigError
        If it is no share; see `share_of`.
    """
    exact = share_of(share)
    if exact is None:
        raise ConfigError(f"{shown(share)} is no share of the beams; give a whole number of them, or a part from 0.0 to 1.0")
    return exact if isinstance(exact, int) else _whole_part(exact, beams)


@functools.lru_cache(maxsize=64, typed=True)  # every scan asks the same; a fraction may equal the double of another decimal
def _whole_part(part: float | Fraction, beams: int) -> int:
    return math.floor(Fraction(str(part)) * beams)

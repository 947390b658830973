"""`Kind`: which values a key may have, and how files write them."""

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass
from numbers import Integral, Real
from typing import Any

import numpy as np

_TRUE = ("true", "yes", "on", "y", "t", "1", "1.0")
_FALSE = ("false", "no", "off", "n", "f", "0", "0.0")


_LONGEST = 100  # characters of a value in a message
LARGEST = 10**300  # what a whole number without a limit of its own may be: no text holds one of thousands of digits


def shown(value: object) -> str:
    """Return how a value looks, for a message; of a long one, how it begins."""
    try:
        text = repr(value)
    except ValueError:  # Python writes out no integer of more than 4300 digits
        return "a number of thousands of digits"
    return text if len(text) <= _LONGEST else f"{text[:_LONGEST]}…"


class Kind(ABC):
    """Which values a key may have."""

    @property
    @abstractmethod
    def allowed(self) -> str:
        """What may be given, as the end of a sentence."""

    @property
    @abstractmethod
    def brief(self) -> str:
        """What may be given, for a column of a table."""

    @abstractmethod
    def checked(self, value: Any) -> Any:
        """Return a value in the plain types of Python.

        Raises
        ------
        ValueError
            If it may not be given; the text says what may.
        """

    def meant(self, value: Any) -> Any:
        """Return what is meant by a value that a file or a variable holds, where that is another one; it may still be wrong."""
        return value

    def written(self, value: Any) -> Any:
        """Return a checked value as files hold it: `checked` of `meant` of that is the same again."""
        return value


@dataclass(frozen=True)
class Number(Kind):
    """A finite number.

    Parameters
    ----------
    least
        It is not below this.
    above
        It is above this, where it is given.
    most
        It is not above this.
    because
        Why, where that is not plain.
    """

    least: float = 0.0
    above: float | None = None
    most: float = math.inf
    because: str = ""

    @property
    def allowed(self) -> str:
        """What may be given."""
        limit = f"greater than or equal to {self.least:g}" if self.above is None else f"greater than {self.above:g}"
        limit += "" if self.most == math.inf else f" and at most {self.most:g}"
        return f"a finite number {limit}" + (f": {self.because}" if self.because else "")

    @property
    def brief(self) -> str:
        """The same, short."""
        limit = f"≥ {self.least:g}" if self.above is None else f"> {self.above:g}"
        return limit if self.most == math.inf else f"{limit}, ≤ {self.most:g}"

    def checked(self, value: Any) -> float:
        """Return a real number as a float that is no other number: a bound must not change by being kept."""
        if isinstance(value, bool):
            raise ValueError("give a number, not a truth value")
        if not isinstance(value, Real):
            raise ValueError(f"give {self.allowed}")
        try:
            number = float(value)
        except OverflowError:
            number = math.inf
        enough = number >= self.least if self.above is None else number > self.above
        if not (math.isfinite(number) and enough and number <= self.most):
            raise ValueError(f"give {self.allowed}")
        if number != value:
            raise ValueError(f"give a float: as one, this would be rounded to {number!r}")
        return number

    def meant(self, value: Any) -> Any:
        """Return the number that a text holds: YAML leaves 1e-3 a text."""
        if not isinstance(value, str):
            return value
        try:
            return float(value)
        except ValueError:
            return value


@dataclass(frozen=True)
class Whole(Kind):
    """A whole number from `least` to `most`, which may be open."""

    least: int
    most: int | None = None

    @property
    def allowed(self) -> str:
        """What may be given."""
        limit = f"greater than or equal to {self.least}" if self.most is None else f"from {self.least} to {self.most}"
        return f"a whole number {limit}"

    @property
    def brief(self) -> str:
        """The same, short."""
        return f"whole, ≥ {self.least}" if self.most is None else f"whole, {self.least} to {self.most}"

    def checked(self, value: Any) -> int:
        """Return an integer as one of Python."""
        if isinstance(value, bool):
            raise ValueError("give a whole number, not a truth value")
        number = int(value) if isinstance(value, Integral) else None
        if number is None or number < self.least or (self.most is not None and number > self.most):
            raise ValueError(f"give {self.allowed}")
        if number > LARGEST:
            raise ValueError("give a number of at most 300 digits")
        return number

    def meant(self, value: Any) -> Any:
        """Return the whole number that a text or a float holds."""
        try:
            if isinstance(value, str):
                return int(value)
        except ValueError:
            pass
        number = Number().meant(value)
        return int(number) if isinstance(number, float) and number.is_integer() else value


class Truth(Kind):
    """True or false."""

    allowed = "true or false"
    brief = "true, false"

    def checked(self, value: Any) -> bool:
        """Return a truth value as one of Python."""
        if not isinstance(value, bool | np.bool_):
            raise ValueError(f"give {self.allowed}")
        return bool(value)

    def meant(self, value: Any) -> Any:
        """Return the truth value that a word or a digit stands for."""
        word = str(value).strip().lower()
        return True if word in _TRUE else False if word in _FALSE else value


@dataclass(frozen=True)
class Word(Kind):
    """One of some words."""

    words: tuple[str, ...]

    @property
    def allowed(self) -> str:
        """What may be given."""
        return " or ".join(map(repr, self.words))

    @property
    def brief(self) -> str:
        """The same, short."""
        return ", ".join(f"`{word}`" for word in self.words)

    def checked(self, value: Any) -> str:
        """Return one of the words as a text of Python."""
        if not isinstance(value, str) or value not in self.words:
            raise ValueError(f"give {self.allowed}")
        return str(value)  # NumPy has texts of its own


@dataclass(frozen=True)
class Maybe(Kind):
    """What another kind allows, or nothing: None, which files write as null."""

    of: Kind

    @property
    def allowed(self) -> str:
        """What may be given."""
        return f"{self.of.allowed}, or null"

    @property
    def brief(self) -> str:
        """The same, short."""
        return ", ".join(filter(None, (self.of.brief, "null")))

    def checked(self, value: Any) -> Any:
        """Return None, or what the other kind makes of it."""
        if value is None:
            return None
        try:
            return self.of.checked(value)
        except ValueError as fault:
            raise ValueError(f"{fault}, or null") from None

    def meant(self, value: Any) -> Any:
        """Return None, or what the other kind takes it for."""
        return None if value is None else self.of.meant(value)

    def written(self, value: Any) -> Any:
        """Return None, or how the other kind writes it."""
        return None if value is None else self.of.written(value)

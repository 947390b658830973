"""`Start`: what is known of where a robot begins to drive."""

from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from ial.errors import ConfigError

_FULL_DEG = 360


@dataclass(frozen=True)
class Start:
    """A place and headings; everything is possible by default.

    Parameters
    ----------
    region
        A rectangle that holds the place: least x and y, greatest x and y, in metres; None for everywhere.
    headings_deg
        Intervals that hold the heading, (from, to) counter-clockwise in degrees; none for every heading.

    Raises
    ------
    ConfigError
        If the region or an interval is empty.
    """

    region: tuple[Fraction, Fraction, Fraction, Fraction] | None = None
    headings_deg: tuple[tuple[Fraction, Fraction], ...] = ()

    def __post_init__(self) -> None:
        if any(low > high for low, high in self.headings_deg):
            raise ConfigError("an interval of headings ends before it begins; give (from, to) in degrees, counter-clockwise")
        if self.region is not None and (self.region[0] > self.region[2] or self.region[1] > self.region[3]):
            raise ConfigError("the region at the start is empty; give the least x and y, then the greatest")

    def holds_heading(self, low_deg: Fraction, high_deg: Fraction) -> bool:
        """Return whether one of the headings from low to high, both included, is possible."""
        if not self.headings_deg:
            return True
        wide = high_deg - low_deg
        return any((low_deg - low) % _FULL_DEG <= high - low or (low - low_deg) % _FULL_DEG <= wide for low, high in self.headings_deg)

    def holds_place(self, x_m: Fraction, y_m: Fraction) -> bool:
        """Return whether a place is possible."""
        if self.region is None:
            return True
        x0, y0, x1, y1 = self.region
        return x0 <= x_m <= x1 and y0 <= y_m <= y1

    def record(self) -> dict[str, Any]:
        """Return plain values that JSON can hold; `of_record` gives the start back."""
        region = None if self.region is None else [str(each) for each in self.region]
        return {"region": region, "headings_deg": [[str(low), str(high)] for low, high in self.headings_deg]}

    @classmethod
    def of_record(cls, record: dict[str, Any]) -> "Start":
        """Return the start of a record."""
        region = None
        if record["region"] is not None:
            x0, y0, x1, y1 = (Fraction(each) for each in record["region"])
            region = (x0, y0, x1, y1)
        return cls(region, tuple((Fraction(low), Fraction(high)) for low, high in record["headings_deg"]))


ANYWHERE = Start()

"""`ExecutionBounds`: by how much a real robot may differ from what it was told to do."""

from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from ial.errors import ConfigError

MOST_COUNT = 2**20


@dataclass(frozen=True)
class ExecutionBounds:
    """Bounds of the errors of a bouncing robot; all are 0 for a robot without errors.

    Parameters
    ----------
    turn_deg
        A bump turns the robot by the bouncing angle ± so many degrees.
    step
        A step is as long as it should be, ± so large a part of it: 1/50 for 2 %.
    count
        The clock counts the steps between two bumps with an error of at most so many.

    Raises
    ------
    ConfigError
        If a bound is negative, steps could have no length, or turns are not known at all.
    """

    turn_deg: Fraction = Fraction(0)
    step: Fraction = Fraction(0)
    count: int = 0

    def __post_init__(self) -> None:
        if not 0 <= self.turn_deg < 180:
            raise ConfigError(f"the bound of the error of a turn is {float(self.turn_deg):g}°; give 0 or more, and less than 180")
        if not 0 <= self.step < 1:
            raise ConfigError(f"the bound of the error of a step is {float(self.step):g} of its length; give 0 or more, and less than 1")
        if not 0 <= self.count <= MOST_COUNT:
            raise ConfigError(f"the bound of the error of a count is {self.count} steps; give 0 or more, and at most {MOST_COUNT}")

    def record(self) -> dict[str, Any]:
        """Return plain values that JSON can hold; `of_record` gives the bounds back."""
        return {"turn_deg": str(self.turn_deg), "step": str(self.step), "count": self.count}

    @classmethod
    def of_record(cls, record: dict[str, Any]) -> "ExecutionBounds":
        """Return the bounds of a record."""
        return cls(Fraction(record["turn_deg"]), Fraction(record["step"]), record["count"])

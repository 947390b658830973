"""`Space`: the variables that a formula may use."""

from collections.abc import Iterable
from dataclasses import dataclass


@dataclass(frozen=True)
class Space:
    """The variables that were declared together; a box has one side for each, in this order. Spaces of the same names are the same.

    Parameters
    ----------
    names
        The names of the variables.
    """

    names: tuple[str, ...]

    @property
    def dimension(self) -> int:
        """The number of variables."""
        return len(self.names)


def common_space(holders: Iterable[object]) -> Space | None:
    """Return the space of all that have one, such as formulas and constraints; None if none has.

    Raises
    ------
    ValueError
        If they have different ones.
    """
    spaces = {space for holder in holders if isinstance(space := getattr(holder, "space", None), Space)}
    if len(spaces) > 1:
        names = " and ".join(sorted(" ".join(space.names) for space in spaces))
        raise ValueError(f"the variables {names} were declared apart; declare all variables of a problem in one variables(...) call")
    return spaces.pop() if spaces else None


def required_space(formulas: Iterable[object]) -> Space:
    """Return the space of several formulas.

    Raises
    ------
    ValueError
        If no variable occurs in them, or variables that were declared apart.
    """
    space = common_space(formulas)
    if space is None:
        raise ValueError("there is no variable in the formulas; give formulas over the variables of a variables(...) call")
    return space

"""`Space`: the variables that a formula may use."""

from collections.abc import Sequence


class Space:
    """The variables that were declared together; a box has one side for each, in this order.

    Parameters
    ----------
    names
        The names of the variables.
    """

    def __init__(self, names: Sequence[str]) -> None:
        self.names = tuple(names)

    @property
    def dimension(self) -> int:
        """The number of variables."""
        return len(self.names)

    def __repr__(self) -> str:
        return f"Space({' '.join(self.names)})"

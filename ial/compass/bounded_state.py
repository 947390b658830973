"""`BoundedState`: where on the boundary a robot with an inexact compass can be, as closed intervals of walls."""

from collections.abc import Iterable
from dataclasses import dataclass
from fractions import Fraction

Span = tuple[int, float, float]


@dataclass(frozen=True)
class BoundedState:
    """Closed intervals of edges, rounded outward, so that every possible place is in one of them; some other places may be, too.

    Parameters
    ----------
    spans
        The number of an edge, and the parts of it that lie before the ends of the interval; sorted, and no two of one edge touch.
    """

    spans: tuple[Span, ...]

    def __repr__(self) -> str:
        return f"<BoundedState of {len(self.spans)} intervals>"

    def __len__(self) -> int:
        return len(self.spans)

    @classmethod
    def of(cls, spans: Iterable[Span]) -> "BoundedState":
        """Return the union of intervals in any order; those that overlap or touch are joined."""
        joined: list[Span] = []
        for edge, low, high in sorted(spans):
            if joined and joined[-1][0] == edge and low <= joined[-1][2]:
                joined[-1] = edge, joined[-1][1], max(high, joined[-1][2])
            else:
                joined.append((edge, low, high))
        return cls(tuple(joined))

    def holds(self, edge: int, part: float | Fraction) -> bool:
        """Return whether a part of an edge belongs to the state; a corner is part 0 of one edge and part 1 of another."""
        return any(each == edge and low <= part <= high for each, low, high in self.spans)

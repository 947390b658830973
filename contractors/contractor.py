"""What a contractor is, and the operators ``&``, ``|`` and ``~`` between contractors."""

from abc import ABC, abstractmethod
from collections.abc import Iterable
from typing import Protocol

from ial.contractors.boxes import Boxes
from ial.contractors.space import Space


class Dimensioned(Protocol):
    """What has a number of variables."""

    @property
    def dimension(self) -> int:
        """The number of variables d."""
        ...


class ContractorLike(Dimensioned, Protocol):
    """What every combinator and paver accepts: a dimension and `contract`, with the meaning that `Contractor` gives them.

    A class need not inherit from `Contractor` to be combined; it then only lacks the operators.
    """

    def contract(self, boxes: Boxes) -> Boxes:
        """Return the narrowed boxes."""
        ...


class Contractor(ABC):
    """Narrows boxes without losing a solution: every point of an input box that satisfies the constraint is in its output box.

    Output rows correspond to input rows in the same order; an emptied row is ``lower = +inf, upper = -inf`` in every dimension; the input
    is not modified. A row is narrowed by itself, whatever other rows come with it. A subclass sets `dimension` and defines `contract`.

    Contractors of one dimension combine: ``a & b`` stands for points that satisfy both constraints, ``a | b`` for points that satisfy at
    least one, ``~a`` for points that do not satisfy one, where a contractor for these is known. See `algebra.intersection`,
    `algebra.union` and `complement`.
    """

    dimension: int
    space: Space | None = None
    """The variables that the constraint was written with; those of different spaces do not combine. None where axes have no names."""

    def __repr__(self) -> str:
        return f"<{type(self).__name__} of dimension {self.dimension}>"

    @abstractmethod
    def contract(self, boxes: Boxes) -> Boxes:
        """Return the narrowed boxes."""

    def complement(self) -> "ContractorLike":
        """Return a contractor of the points that do not satisfy the constraint, or of these and the boundary.

        Raises
        ------
        TypeError
            If none is known, as for most constraints: a subclass that knows one overrides this.
        """
        raise TypeError(_unknown_complement(self))

    def __and__(self, other: ContractorLike) -> "Contractor":
        return _intersection(self, other)

    def __rand__(self, other: ContractorLike) -> "Contractor":
        return _intersection(other, self)

    def __or__(self, other: ContractorLike) -> "Contractor":
        return _union(self, other)

    def __ror__(self, other: ContractorLike) -> "Contractor":
        return _union(other, self)

    def __invert__(self) -> ContractorLike:
        return self.complement()


def _intersection(a: ContractorLike, b: ContractorLike) -> Contractor:
    from ial.contractors.combinators.combination import Intersection  # is built on this class

    return Intersection(a, b)


def _union(a: ContractorLike, b: ContractorLike) -> Contractor:
    from ial.contractors.combinators.combination import Union  # is built on this class

    return Union(a, b)


def complement(contractor: Dimensioned) -> ContractorLike:
    """Return a contractor of the points that do not satisfy a constraint, or of these and the boundary.

    Raises
    ------
    TypeError
        If none is known.
    """
    own = getattr(contractor, "complement", None)
    if own is None:
        raise TypeError(_unknown_complement(contractor))
    opposite: ContractorLike = own()
    return opposite


def _unknown_complement(contractor: object) -> str:
    return (
        f"no contractor is known for the points outside of {type(contractor).__name__}; "
        "give its class a method complement(), or use a Separator(inner, outer), which holds both contractors"
    )


def require_dimension(contractor: Dimensioned, boxes: Boxes) -> None:
    """Raise unless the boxes have the dimension of a contractor.

    Raises
    ------
    TypeError
        If something is no contractor, or no boxes.
    ValueError
        If the dimensions differ.
    """
    if not hasattr(contractor, "dimension"):
        raise TypeError(f"{contractor!r} is no constraint; give a contractor or a separator")
    if not isinstance(boxes, Boxes):
        raise TypeError(f"{boxes!r} are no boxes; write Boxes.of([(lower, upper), …])")
    if boxes.dimension != contractor.dimension:
        raise ValueError(f"the boxes have {boxes.dimension} dimensions; {type(contractor).__name__} needs {contractor.dimension}")


def common_dimension(contractors: Iterable[Dimensioned]) -> int:
    """Return the dimension that all of several contractors have.

    Raises
    ------
    ValueError
        If there is no contractor, or if they differ.
    """
    dimensions = {contractor.dimension for contractor in contractors}
    if len(dimensions) != 1:
        raise ValueError(f"the contractors have dimensions {sorted(dimensions)}; give at least one contractor, all of one dimension")
    return dimensions.pop()

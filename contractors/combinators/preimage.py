"""Preimages: a set given in other coordinates."""

from typing import Protocol, overload

from ial.contractors.boxes import Boxes
from ial.contractors.checked_contractor import CheckedContractor
from ial.contractors.contractor import Contractor, ContractorLike, complement
from ial.contractors.separator import Separator


class BoxFunction(Protocol):
    """A function of points, as what it does to boxes."""

    def image(self, boxes: Boxes) -> Boxes:
        """Return, for each box, a box that contains the value at every point of it; an empty row gives an empty row."""
        ...


class Preimage(CheckedContractor):
    """The points x with f(x) in a set, for a bijection f with a known inverse. See `transform`.

    Parameters
    ----------
    contractor
        The constraint on f(x).
    forward, inverse
        The function f and its inverse.
    """

    def __init__(self, contractor: ContractorLike, forward: BoxFunction, inverse: BoxFunction) -> None:
        self.dimension = contractor.dimension
        self.contractor = contractor
        self.forward = forward
        self.inverse = inverse

    def complement(self) -> "Preimage":
        """Return the preimage of the complement.

        Raises
        ------
        TypeError
            If it is not known.
        """
        return Preimage(complement(self.contractor), self.forward, self.inverse)

    def _narrow(self, boxes: Boxes) -> Boxes:
        values = self.contractor.contract(self.forward.image(boxes))
        return (boxes & self.inverse.image(values)).where(~values.empty)


@overload
def transform(contractor: Separator, forward: BoxFunction, inverse: BoxFunction) -> Separator: ...
@overload
def transform(contractor: ContractorLike, forward: BoxFunction, inverse: BoxFunction) -> Contractor: ...
def transform(contractor: Separator | ContractorLike, forward: BoxFunction, inverse: BoxFunction) -> Contractor | Separator:
    """Return the constraint that f(x) satisfies a constraint, for a bijection f with a known inverse.

    A box is mapped forward, its image is narrowed, and what is left is mapped back. What a separator removes so is proved: a point x of the
    box whose f(x) is not removed comes back.

    Parameters
    ----------
    contractor
        The constraint on f(x): a contractor or a separator.
    forward
        The function f. It must be defined at every point of the boxes that are contracted: a point without a value would be
        removed by both contractors of a separator, and would so be counted as inside.
    inverse
        The inverse of f: its image of a box must contain *every* x with f(x) in the box.

    See Also
    --------
    affine.Affine : shifts, rotations and other affine maps, with their inverses.
    """
    if isinstance(contractor, Separator):
        return Separator(*(Preimage(part, forward, inverse) for part in (contractor.inner, contractor.outer)))
    return Preimage(contractor, forward, inverse)

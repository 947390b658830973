"""The zeros of a square system: which boxes hold exactly one, none, or perhaps some; and all zeros in a box."""

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from ial.contractors.boxes import Boxes
from ial.contractors.combinators.fixed_point import fixpoint
from ial.contractors.contractor import require_dimension
from ial.contractors.expressions.function import Function
from ial.contractors.paving.limits import Limit
from ial.contractors.paving.paver import pave
from ial.contractors.rounding import check_rounding
from ial.contractors.solving.newton import Newton

_STEPS = 50  # of Newton's method on one box; near a zero a handful is enough
_PAYS = 0.9  # another step is made if some side shrank to less than this share
_TRIES = 5  # how often a box is widened in search of a proof
_GROWTH = 8.0
_ROUNDING = 2.0**-48  # relative width of the first box that is tried around a zero that is known to the last bit
_SMALLEST = 2.0**-500


@dataclass(frozen=True, eq=False)
class Certificate:
    """What Newton's method proves of n boxes.

    Parameters
    ----------
    boxes
        The boxes narrowed: they hold the same zeros. Empty ones held none.
    unique
        Which boxes are proved to hold exactly one zero, bool of shape (n,).
    """

    boxes: Boxes
    unique: npt.NDArray[np.bool_]

    def __repr__(self) -> str:
        zeros = f"one zero in {self.unique.sum()}, none in {self.none.sum()}, unknown of {self.unknown.sum()}"
        return f"<Certificate of {len(self.boxes)} boxes: {zeros}>"

    @property
    def none(self) -> npt.NDArray[np.bool_]:
        """Which boxes are proved to hold no zero, shape (n,)."""
        return self.boxes.empty

    @property
    def unknown(self) -> npt.NDArray[np.bool_]:
        """Of which boxes nothing is proved, shape (n,)."""
        return ~(self.unique | self.none)


@dataclass(frozen=True, eq=False)
class Zeros:
    """All zeros of a function in a box.

    Parameters
    ----------
    unique
        Boxes that hold exactly one zero each, and no two the same.
    undecided
        Boxes that hold every other zero of the searched box, if there are any: zeros at which the derivative is singular, zeros on the
        border of the searched box, and nothing at all in boxes that could not be excluded.
    limited
        What stopped the search early: see `Paving`.
    nodes
        How many boxes the search contracted.
    """

    unique: Boxes
    undecided: Boxes
    limited: Limit = ""
    nodes: int = 0


def certify(function: Function, boxes: Boxes) -> Certificate:
    """Return which boxes hold exactly one zero of a function, and which none; narrowed by Newton's method as far as it goes.

    A zero is proved to exist only in the interior of a box, at a regular derivative. A zero on the face of a box, or one that is multiple,
    leaves it unknown.

    Parameters
    ----------
    function
        A function f with as many values as variables.
    boxes
        Boxes of its variables.

    Raises
    ------
    TypeError
        If a formula holds an operation without a known derivative.
    ValueError
        If the function has not as many values as variables, or the boxes are of another dimension.

    References
    ----------
    Krawczyk: Newton-Algorithmen zur Bestimmung von Nullstellen mit Fehlerschranken, Computing 4 (1969). Moore: A test for existence of
    solutions to nonlinear systems, SIAM Journal on Numerical Analysis 14 (1977).

    Examples
    --------
    >>> from ial.contractors import Boxes, Function, certify, variables
    >>> x = variables("x")
    >>> certificate = certify(Function(x**2 - 2), Boxes.of([(1, 2)], [(2, 3)], [(-2, 2)]))
    >>> certificate.unique.tolist(), certificate.none.tolist()
    ([True, False, False], [False, True, False])
    """
    newton = Newton(function)
    require_dimension(newton, boxes)
    check_rounding()
    narrowed = Boxes(boxes.lower.copy(), boxes.upper.copy()).where(~boxes.empty)
    unique = np.zeros(len(boxes), dtype=np.bool_)
    rows = np.flatnonzero(~narrowed.empty)
    for _ in range(_STEPS):
        if not len(rows):
            break
        before = narrowed[rows]
        after, proved = newton.step(before)
        narrowed.lower[rows], narrowed.upper[rows] = after.lower, after.upper
        unique[rows] |= proved  # what was cut off before holds no zero, so the proof is one for the whole box
        with np.errstate(invalid="ignore"):
            pays = ((after.width() < _PAYS * before.width()) | (np.isfinite(after.width()) & ~np.isfinite(before.width()))).any(axis=1)
        rows = rows[pays & ~after.empty]
    return Certificate(narrowed, unique)


def zeros(function: Function, box: Boxes, precision: npt.ArrayLike, **options: Any) -> Zeros:
    """Return all zeros of a function in a box, those with a regular derivative as boxes that are proved to hold exactly one.

    Boxes are narrowed and bisected; around each one that is left, a slightly larger box is tried for a proof, so that a zero on the
    border between two boxes is found all the same, and once.

    Parameters
    ----------
    function
        A function f with as many values as variables. Small systems only: the work grows quickly with their number.
    box
        Where to search: one box.
    precision
        The width at which boxes are no longer bisected: one number, or one for each variable. Zeros that are nearer to each other than
        this are told apart only if Newton's method can prove them.
    **options
        Those of `ial.contractors.pave`.

    Raises
    ------
    TypeError
        If a formula holds an operation without a known derivative.
    ValueError
        If the function has not as many values as variables, there is not one box, or an option cannot be used.

    References
    ----------
    Neumaier: Interval Methods for Systems of Equations, Cambridge 1990, section 5.6; Rump: Verification methods, Acta Numerica 19 (2010),
    section 13, for the widening.

    Examples
    --------
    >>> from ial.contractors import Boxes, Function, variables, zeros
    >>> x, y = variables("x y")
    >>> found = zeros(Function(x**2 + y**2 - 1, x - y), Boxes.of([(-2, 2), (-2, 2)]), 0.1)
    >>> len(found.unique), len(found.undecided)
    (2, 0)
    """
    if len(box) != 1:
        raise ValueError(f"zeros are searched in {len(box)} boxes; give one")
    paving = pave(fixpoint(Newton(function), ratio=0.5, max_rounds=10), box, precision, **options)
    regions, around, open_ = _verified(function, paving.boxes)
    unique, others = _distinct(regions, around, box)
    # What lies in a region holds no zero but the one that is known.
    covered = (regions.lower <= open_.lower[:, None]) & (open_.upper[:, None] <= regions.upper)
    known = np.any(np.all(covered, axis=2), axis=1)
    return Zeros(unique, Boxes.concatenate([open_[~known], others]), paving.limited, paving.nodes)


def _verified(function: Function, boxes: Boxes) -> tuple[Boxes, Boxes, Boxes]:
    """Return regions proved to hold exactly one zero, tight boxes around these zeros, and the boxes that lie in no such region."""
    regions, around = [Boxes.none(boxes.dimension)], [Boxes.none(boxes.dimension)]
    middle = boxes.midpoint()
    radius = 0.5 * boxes.width() + _ROUNDING * np.abs(middle) + _SMALLEST
    for _ in range(_TRIES):
        radius *= 2.0
        region = Boxes(middle - radius, middle + radius) | boxes
        certificate = certify(function, region)
        regions.append(region[certificate.unique])
        around.append(certificate.boxes[certificate.unique])
        unknown = certificate.unknown
        boxes, middle, radius = boxes[unknown], middle[unknown], 0.5 * _GROWTH * radius[unknown]
    return Boxes.concatenate(regions), Boxes.concatenate(around), boxes


def _distinct(regions: Boxes, around: Boxes, box: Boxes) -> tuple[Boxes, Boxes]:
    """Return boxes of zeros that certainly differ and lie in the searched box, and boxes of others that perhaps do.

    Two zeros are the same if the box around one lies in the region that holds only the other; they differ if the boxes are disjoint.
    """
    sure: list[int] = []
    unsure: list[int] = []
    inside = around & box
    for at in np.flatnonzero(~inside.empty).tolist():
        low, high = around.lower[at], around.upper[at]
        same = (regions.lower[sure] <= low).all(axis=1) & (high <= regions.upper[sure]).all(axis=1)
        same |= ((regions.lower[at] <= around.lower[sure]) & (around.upper[sure] <= regions.upper[at])).all(axis=1)
        if same.any():
            continue
        apart = ((around.upper[sure] < low) | (high < around.lower[sure])).any(axis=1).all()
        within = (box.lower[0] <= low).all() and (high <= box.upper[0]).all()
        (sure if apart and within else unsure).append(at)
    return inside[sure], inside[unsure]

"""The algebra of constraints: functions that combine contractors into one, and separators into one."""

from collections.abc import Iterable
from typing import overload

from ial.contractors.combinators.combination import Intersection, Union
from ial.contractors.combinators.family import Members, members_of, several
from ial.contractors.combinators.lazy_intersection import LazyIntersection
from ial.contractors.combinators.relaxation import Relaxed
from ial.contractors.combinators.trivial_sets import EmptySet
from ial.contractors.contractor import Contractor, ContractorLike, complement
from ial.contractors.separator import Separator, are_separators, intersect, unite


@overload
def intersection(contractors: Iterable[Separator]) -> Separator: ...
@overload
def intersection(contractors: Members) -> Contractor: ...
def intersection(contractors: Iterable[Separator] | Members) -> Contractor | Separator:
    """Return the constraint that all of several constraints hold: ``a & b`` of many.

    Parameters
    ----------
    contractors
        Contractors and families, or separators; all of one dimension. A family alone need not be put into a list.

    Returns
    -------
    Contractor or Separator
        The contractors are applied one after the other. For separators, the outer contractors are, and the hull of what each inner
        contractor leaves is taken.

    Raises
    ------
    TypeError
        If contractors and separators are mixed.
    ValueError
        If there is none, or the dimensions differ.

    References
    ----------
    Chabert, Jaulin: Contractor programming, Artificial Intelligence 173 (2009), section 3.
    """
    members = several(contractors)
    if are_separators(members):
        return intersect(members)
    return Intersection(*members_of(members))


@overload
def union(contractors: Iterable[Separator]) -> Separator: ...
@overload
def union(contractors: Members) -> Contractor: ...
def union(contractors: Iterable[Separator] | Members) -> Contractor | Separator:
    """Return the constraint that at least one of several constraints holds: ``a | b`` of many.

    Parameters
    ----------
    contractors
        Contractors and families, or separators; all of one dimension. A family alone need not be put into a list.

    Returns
    -------
    Contractor or Separator
        Of each box, the hull of what the contractors leave. For separators, the hull of what the outer contractors leave, and the inner
        contractors one after the other.

    Raises
    ------
    TypeError
        If contractors and separators are mixed.
    ValueError
        If there is none, or the dimensions differ.

    References
    ----------
    Chabert, Jaulin: Contractor programming, Artificial Intelligence 173 (2009), section 3.
    """
    members = several(contractors)
    if are_separators(members):
        return unite(members)
    return Union(*members_of(members))


@overload
def negation(contractor: Separator) -> Separator: ...
@overload
def negation(contractor: ContractorLike) -> ContractorLike: ...
def negation(contractor: Separator | ContractorLike) -> ContractorLike | Separator:
    """Return the constraint that a constraint does not hold, its boundary included: ``~a``.

    For a separator the two contractors change places. For a contractor its complement is returned where its class knows one; combinators
    know theirs if their members do: an intersection becomes a union of complements, a relaxed intersection of n constraints of which q may
    fail becomes one of n complements of which n − q − 1 may fail.

    Raises
    ------
    TypeError
        If the complement is not known.
    """
    return ~contractor if isinstance(contractor, Separator) else complement(contractor)


@overload
def relaxed(contractors: Iterable[Separator], outliers: int, *, exact: bool = ...) -> Separator: ...
@overload
def relaxed(contractors: Members, outliers: int, *, exact: bool = ...) -> Contractor: ...
def relaxed(contractors: Iterable[Separator] | Members, outliers: int, *, exact: bool = False) -> Contractor | Separator:
    """Return the constraint that all of several constraints hold but at most q.

    Parameters
    ----------
    contractors
        Contractors and families, or separators; all of one dimension. A family alone need not be put into a list.
    outliers
        The number of constraints that may fail, q >= 0. With q >= their number nothing is required.
    exact
        By default each axis is handled by itself, which is exact in one dimension. ``exact=True`` takes the hull of the points in enough of
        the narrowed boxes in d dimensions too; it is never larger, and meant for few constraints: see `relaxed_intersection`.

    Returns
    -------
    Contractor or Separator
        For n separators the outer contractors are relaxed by q, and the inner ones by n − q − 1: a point is outside where at least q + 1
        constraints fail.

    Raises
    ------
    TypeError
        If contractors and separators are mixed.
    ValueError
        If there is none, the dimensions differ, `outliers` is negative, or the exact hull could take too long.

    References
    ----------
    Jaulin: Robust set-membership state estimation; application to underwater robotics, Automatica 45 (2009).
    """
    members = several(contractors)
    if not are_separators(members):
        return Relaxed(*members_of(members), outliers=outliers, exact=exact)
    outer = Relaxed(*(member.outer for member in members), outliers=outliers, exact=exact)
    if outliers >= len(members):
        return Separator(inner=EmptySet(outer.dimension), outer=outer)
    inner = Relaxed(*(member.inner for member in members), outliers=len(members) - outliers - 1, exact=exact)
    return Separator(inner=inner, outer=outer)


@overload
def lazy(contractors: Iterable[Separator]) -> Separator: ...
@overload
def lazy(contractors: Members) -> Contractor: ...
def lazy(contractors: Iterable[Separator] | Members) -> Contractor | Separator:
    """Return the intersection of several constraints, which learns their order: those that emptied the largest share of rows come first.

    The set of solutions is that of `intersection`. The boxes on the way may differ, since contractors that are applied in another
    order narrow differently; they depend on the batches that this object has seen before, and on nothing else: rows are counted, no
    time is measured. A new object starts anew, in the order given.

    Parameters
    ----------
    contractors
        Contractors and families, or separators (whose outer contractors are ordered); all of one dimension.

    Raises
    ------
    TypeError
        If contractors and separators are mixed.
    ValueError
        If there is none, or the dimensions differ.
    """
    members = several(contractors)
    if are_separators(members):
        outer = LazyIntersection(*(member.outer for member in members))
        return Separator(inner=Union(*(member.inner for member in members)), outer=outer)
    return LazyIntersection(*members_of(members))
